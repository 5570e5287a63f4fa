"""How much of a building's live load acts as mass in an earthquake: exact sliding-block shear-building simulation."""

from seismass import _kernel
from seismass.assessment import Assessment, assess
from seismass.batch import simulate_many, stream_many, write_many
from seismass.building_file import read_building
from seismass.codes import CodeFraction, code_fraction, code_table
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
from seismass.long_table import long_table
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
from seismass.scaling import ScalingResult, scale_asce7_10
from seismass.scene import Block, Building, Rayleigh, Scene, blocks_on_floors
from seismass.scene_file import SceneFile, read_scene
from seismass.simulate import Motion, Response, instruction_set, simulate
from seismass.spectra import TargetSpectrum, response_spectrum
from seismass.units import STANDARD_GRAVITY

__version__ = _kernel.VERSION

__all__ = [
    "STANDARD_GRAVITY",
    "Assessment",
    "Block",
    "Building",
    "CodeFraction",
    "EffectiveMass",
    "EffectiveMassMap",
    "EffectiveMassParameters",
    "FrictionPair",
    "Grid",
    "InvalidBuildingFile",
    "InvalidMotion",
    "InvalidOption",
    "InvalidScene",
    "InvalidSceneFile",
    "LiveLoadUncertainty",
    "MissingPackage",
    "Motion",
    "NearFaultPulse",
    "OrientationScan",
    "OwnBuilding",
    "Pair",
    "Pairs",
    "PulseResult",
    "Rayleigh",
    "Record",
    "RecordFormatError",
    "Response",
    "RotD",
    "ScalingResult",
    "Scene",
    "SceneFile",
    "SeismassError",
    "SimulationError",
    "Suite",
    "SyntheticParameters",
    "TargetSpectrum",
    "__version__",
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
    "effective_mass",
    "effective_mass_map",
    "effective_mass_of_design",
    "find_catalogue",
    "find_pairs",
    "friction_pair",
    "friction_table",
    "instruction_set",
    "intensity_table",
    "live_load_uncertainty",
    "lognormal",
    "long_table",
    "read_building",
    "read_pair",
    "read_record",
    "read_records",
    "read_scene",
    "read_suite",
    "response_spectrum",
    "rotd",
    "scale_asce7_10",
    "shahi_baker2014",
    "simulate",
    "simulate_many",
    "stream_many",
    "synthetic_motion",
    "write_many",
]
