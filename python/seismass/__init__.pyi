"""Names of the package, imported when they are first used; `__init__.py` reads them here."""

from . import design, intensity, plots, slip
from .animation import Animation, animate
from .assessment import Assessment, assess
from .batch import simulate_many, stream_many, write_many
from .block import Block, blocks_on_floors
from .building import Building
from .building_file import read_building
from .campaign import Campaign, CampaignFolder, CampaignProgress, read_campaign
from .codes import CodeFraction, code_fraction, code_table
from .damping import Rayleigh
from .distributions import beta, lognormal
from .effective_mass import (
    EffectiveMass,
    EffectiveMassMap,
    EffectiveMassParameters,
    LiveLoadUncertainty,
    attached_scene,
    effective_mass,
    effective_mass_map,
    effective_mass_of_design,
    live_load_uncertainty,
)
from .errors import (
    InvalidBuildingFile,
    InvalidCampaignFile,
    InvalidMotion,
    InvalidOption,
    InvalidScene,
    InvalidSceneFile,
    MissingPackage,
    RecordFormatError,
    SeismassError,
    SimulationError,
)
from .friction import FrictionPair, friction_pair, friction_table
from .grid import Grid
from .grid_axes import GridAxis
from .grid_design import StrengthDesign
from .intensity import IntensityAnalysis, LimitState, incremental_dynamic_analysis
from .intensity.annual_rate import AnnualRate, annual_rate
from .intensity.hazard import HazardCurve
from .intensity.risk import risk_targeted_share
from .intensity.risk_result import RiskTargetedShare
from .long_table import long_table
from .matching import MatchedRecord, MatchedSuite, match_spectrum, match_suite
from .motion import Motion
from .own_building import OwnBuilding
from .pulses import OrientationScan, PulseResult, baker2007, baker2007_orientations, shahi_baker2014
from .records import (
    NearFaultPulse,
    Pair,
    Pairs,
    Record,
    RotD,
    Suite,
    SyntheticParameters,
    builtin_record,
    builtin_suite,
    catalogue,
    find_catalogue,
    find_pairs,
    intensity_table,
    read_pair,
    read_record,
    read_records,
    read_suite,
    rotd,
    synthetic_motion,
)
from .response import Response
from .scaling import (
    FirstModeOscillator,
    PushoverScaling,
    ScalingResult,
    Selection,
    first_mode_oscillator,
    scale_asce7_10,
    scale_asce7_16,
    scale_least_squares,
    scale_modal_pushover,
    scale_sa_t1,
    select_records,
)
from .scene import Scene
from .scene_file import SceneFile, read_scene
from .simulate import instruction_set, simulate
from .slip import BlockSize, Clearance, SlipDemand, slip_demand
from .spectra import InelasticSpectrum, TargetSpectrum, inelastic_spectrum, mean_spectrum, response_spectrum
from .spring_path import SpringPath, spring_forces
from .units import STANDARD_GRAVITY

__version__: str

__all__ = [
    "STANDARD_GRAVITY",
    "Animation",
    "AnnualRate",
    "Assessment",
    "Block",
    "BlockSize",
    "Building",
    "Campaign",
    "CampaignFolder",
    "CampaignProgress",
    "Clearance",
    "CodeFraction",
    "EffectiveMass",
    "EffectiveMassMap",
    "EffectiveMassParameters",
    "FirstModeOscillator",
    "FrictionPair",
    "Grid",
    "GridAxis",
    "HazardCurve",
    "InelasticSpectrum",
    "IntensityAnalysis",
    "InvalidBuildingFile",
    "InvalidCampaignFile",
    "InvalidMotion",
    "InvalidOption",
    "InvalidScene",
    "InvalidSceneFile",
    "LimitState",
    "LiveLoadUncertainty",
    "MatchedRecord",
    "MatchedSuite",
    "MissingPackage",
    "Motion",
    "NearFaultPulse",
    "OrientationScan",
    "OwnBuilding",
    "Pair",
    "Pairs",
    "PulseResult",
    "PushoverScaling",
    "Rayleigh",
    "Record",
    "RecordFormatError",
    "Response",
    "RiskTargetedShare",
    "RotD",
    "ScalingResult",
    "Scene",
    "SceneFile",
    "SeismassError",
    "Selection",
    "SimulationError",
    "SlipDemand",
    "SpringPath",
    "StrengthDesign",
    "Suite",
    "SyntheticParameters",
    "TargetSpectrum",
    "__version__",
    "animate",
    "annual_rate",
    "assess",
    "attached_scene",
    "baker2007",
    "baker2007_orientations",
    "beta",
    "blocks_on_floors",
    "builtin_record",
    "builtin_suite",
    "catalogue",
    "code_fraction",
    "code_table",
    "design",
    "effective_mass",
    "effective_mass_map",
    "effective_mass_of_design",
    "find_catalogue",
    "find_pairs",
    "first_mode_oscillator",
    "friction_pair",
    "friction_table",
    "incremental_dynamic_analysis",
    "inelastic_spectrum",
    "instruction_set",
    "intensity",
    "intensity_table",
    "live_load_uncertainty",
    "lognormal",
    "long_table",
    "match_spectrum",
    "match_suite",
    "mean_spectrum",
    "plots",
    "read_building",
    "read_campaign",
    "read_pair",
    "read_record",
    "read_records",
    "read_scene",
    "read_suite",
    "response_spectrum",
    "risk_targeted_share",
    "rotd",
    "scale_asce7_10",
    "scale_asce7_16",
    "scale_least_squares",
    "scale_modal_pushover",
    "scale_sa_t1",
    "select_records",
    "shahi_baker2014",
    "simulate",
    "simulate_many",
    "slip",
    "slip_demand",
    "spring_forces",
    "stream_many",
    "synthetic_motion",
    "write_many",
]
