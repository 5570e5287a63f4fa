"""Assessment of your own building: how much of its live load to count as mass, and what its drifts and slips are."""

from seismass.assessment.building import OwnBuilding
from seismass.assessment.building_file import read_building
from seismass.assessment.pushover_file import PushoverCurves, read_pushover
from seismass.assessment.result import Assessment
from seismass.assessment.run import assess
from seismass.assessment.storey_table import StoreyTable, read_storey_table

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
