"""Names of the module, imported when they are first used; `__init__.py` reads them here."""

from .building import OwnBuilding
from .building_file import read_building
from .pushover_file import PushoverCurves, read_pushover
from .result import Assessment
from .run import assess
from .storey_table import StoreyTable, read_storey_table

__all__ = [
    "Assessment",
    "OwnBuilding",
    "PushoverCurves",
    "StoreyTable",
    "assess",
    "read_building",
    "read_pushover",
    "read_storey_table",
]
