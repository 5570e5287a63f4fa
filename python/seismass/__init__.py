"""How much of a building's live load acts as mass in an earthquake: exact sliding-block shear-building simulation."""

from seismass import _kernel
from seismass.errors import (
    InvalidMotion,
    InvalidOption,
    InvalidScene,
    InvalidSceneFile,
    RecordFormatError,
    SeismassError,
    SimulationError,
)
from seismass.records import Record, Suite, builtin_suite, read_record, read_suite
from seismass.scene import Block, Building, Rayleigh, Scene, blocks_on_floors
from seismass.scene_file import SceneFile, read_scene
from seismass.simulate import Motion, Response, simulate, simulate_many
from seismass.units import STANDARD_GRAVITY

__version__ = _kernel.VERSION

__all__ = [
    "STANDARD_GRAVITY",
    "Block",
    "Building",
    "InvalidMotion",
    "InvalidOption",
    "InvalidScene",
    "InvalidSceneFile",
    "Motion",
    "Rayleigh",
    "Record",
    "RecordFormatError",
    "Response",
    "Scene",
    "SceneFile",
    "SeismassError",
    "SimulationError",
    "Suite",
    "__version__",
    "blocks_on_floors",
    "builtin_suite",
    "read_record",
    "read_scene",
    "read_suite",
    "simulate",
    "simulate_many",
]
