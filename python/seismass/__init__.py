"""How much of a building's live load acts as mass in an earthquake: exact sliding-block shear-building simulation."""

import importlib
from typing import TYPE_CHECKING

from seismass import _kernel, design, intensity
from seismass.animation import Animation, animate
from seismass.assessment import Assessment, assess
from seismass.batch import simulate_many, stream_many, write_many
from seismass.block import Block, blocks_on_floors
from seismass.building import Building
from seismass.building_file import read_building
from seismass.codes import CodeFraction, code_fraction, code_table
from seismass.damping import Rayleigh
from seismass.effective_mass import (
    EffectiveMass,
    EffectiveMassMap,
    EffectiveMassParameters,
    LiveLoadUncertainty,
    attached_scene,
    beta,
    effective_mass,
    effective_mass_map,
    effective_mass_of_design,
    live_load_uncertainty,
    lognormal,
)
from seismass.errors import (
    InvalidBuildingFile,
    InvalidMotion,
    InvalidOption,
    InvalidScene,
    InvalidSceneFile,
    MissingPackage,
    RecordFormatError,
    SeismassError,
    SimulationError,
)
from seismass.friction import FrictionPair, friction_pair, friction_table
from seismass.grid import Grid
from seismass.intensity import IntensityAnalysis, LimitState, incremental_dynamic_analysis
from seismass.intensity.annual_rate import AnnualRate, annual_rate
from seismass.intensity.hazard import HazardCurve
from seismass.intensity.risk import risk_targeted_share
from seismass.intensity.risk_result import RiskTargetedShare
from seismass.long_table import long_table
from seismass.matching import MatchedRecord, MatchedSuite, match_spectrum, match_suite
from seismass.motion import Motion
from seismass.own_building import OwnBuilding
from seismass.pulses import OrientationScan, PulseResult, baker2007, baker2007_orientations, shahi_baker2014
from seismass.records import (
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
from seismass.response import Response
from seismass.scaling import (
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
from seismass.scene import Scene
from seismass.scene_file import SceneFile, read_scene
from seismass.simulate import instruction_set, simulate
from seismass.slip import BlockSize, Clearance, SlipDemand, slip_demand
from seismass.spectra import InelasticSpectrum, TargetSpectrum, inelastic_spectrum, mean_spectrum, response_spectrum
from seismass.spring_path import SpringPath, spring_forces
from seismass.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    from seismass import plots
else:

    def __getattr__(name):
        """Return the module of figures, which is imported when it is first used: matplotlib is slow to import."""
        if name == "plots":
            return importlib.import_module("seismass.plots")
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


__version__ = _kernel.VERSION

__all__ = [
    "STANDARD_GRAVITY",
    "Animation",
    "AnnualRate",
    "Assessment",
    "Block",
    "BlockSize",
    "Building",
    "Clearance",
    "CodeFraction",
    "EffectiveMass",
    "EffectiveMassMap",
    "EffectiveMassParameters",
    "FirstModeOscillator",
    "FrictionPair",
    "Grid",
    "HazardCurve",
    "InelasticSpectrum",
    "IntensityAnalysis",
    "InvalidBuildingFile",
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
    "slip_demand",
    "spring_forces",
    "stream_many",
    "synthetic_motion",
    "write_many",
]
