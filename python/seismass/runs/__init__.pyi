"""Names of the module, imported when they are first used; `__init__.py` reads them here."""

from .batch import simulate_many, stream_many, write_many
from .grid.axes import GridAxis
from .grid.design import StrengthDesign
from .grid.grid import Grid
from .long_table import long_table
from .opensees_export import write_opensees
from .plane_response import PlaneResponse
from .response import Response
from .scene_file import SceneFile, read_scene
from .simulate import instruction_set, simulate
from .spring_path import SpringPath, spring_forces

__all__ = [
    "Grid",
    "GridAxis",
    "PlaneResponse",
    "Response",
    "SceneFile",
    "SpringPath",
    "StrengthDesign",
    "instruction_set",
    "long_table",
    "read_scene",
    "simulate",
    "simulate_many",
    "spring_forces",
    "stream_many",
    "write_many",
    "write_opensees",
]
