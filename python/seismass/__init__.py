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
    RecordFormatError,
    SeismassError,
    SimulationError,
)
from seismass.friction import FrictionPair, friction_pair, friction_table
from seismass.grid import Grid
from seismass.long_table import long_table
from seismass.own_building import OwnBuilding
from seismass.records import Record, Suite, builtin_suite, read_record, read_suite
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
from seismass.scene import Block, Building, Rayleigh, Scene, blocks_on_floors
from seismass.scene_file import SceneFile, read_scene
from seismass.simulate import Motion, Response, instruction_set, simulate
from seismass.spectra import InelasticSpectrum, TargetSpectrum, inelastic_spectrum, mean_spectrum, response_spectrum
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
    "FirstModeOscillator",
    "FrictionPair",
    "Grid",
    "InelasticSpectrum",
    "InvalidBuildingFile",
    "InvalidMotion",
    "InvalidOption",
    "InvalidScene",
    "InvalidSceneFile",
    "LiveLoadUncertainty",
    "Motion",
    "OwnBuilding",
    "PushoverScaling",
    "Rayleigh",
    "Record",
    "RecordFormatError",
    "Response",
    "ScalingResult",
    "Scene",
    "SceneFile",
    "SeismassError",
    "Selection",
    "SimulationError",
    "Suite",
    "TargetSpectrum",
    "__version__",
    "assess",
    "attached_scene",
    "beta",
    "blocks_on_floors",
    "builtin_suite",
    "code_fraction",
    "code_table",
    "effective_mass",
    "effective_mass_map",
    "effective_mass_of_design",
    "first_mode_oscillator",
    "friction_pair",
    "friction_table",
    "inelastic_spectrum",
    "instruction_set",
    "live_load_uncertainty",
    "lognormal",
    "long_table",
    "mean_spectrum",
    "read_building",
    "read_record",
    "read_scene",
    "read_suite",
    "response_spectrum",
    "scale_asce7_10",
    "scale_asce7_16",
    "scale_least_squares",
    "scale_modal_pushover",
    "scale_sa_t1",
    "select_records",
    "simulate",
    "simulate_many",
    "stream_many",
    "write_many",
]
