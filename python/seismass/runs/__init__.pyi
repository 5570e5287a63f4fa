"""Names of the module, imported when they are first used; `__init__.py` reads them here."""

from .batch import simulate_many, stream_many, write_many
from .grid.columns import GridAxis
from .grid.grid import Grid
from .grid.sample import StrengthDesign
from .long_table import history_table, long_table
from .opensees_export import SpringPath, spring_forces, write_opensees
from .peak_digits import digits, digits_of_batch
from .plane import PlaneResponse
from .response import Response
from .scene_file import SceneFile, read_scene
from .scene_product import SceneProduct
from .simulate import instruction_set, simulate

__all__ = [
    "Grid",
    "GridAxis",
    "PlaneResponse",
    "Response",
    "SceneFile",
    "SceneProduct",
    "SpringPath",
    "StrengthDesign",
    "digits",
    "digits_of_batch",
    "history_table",
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
