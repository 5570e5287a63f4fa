"""The parametric study of the 16WCEE paper, section 5: drift with sliding live load against drift by a code's rule.

Each building is solved three times under each motion: as it is, with rigid blocks that may slide ("real"); as the code
models it, with the fraction lambda of the blocks' mass attached and no block ("code"); and with all of their mass
attached ("attached"). Attached against code is what the rest of the mass does, real against attached what sliding does.
"""

from seismass.studies.study.parameters import (
    KEYS,
    MODELS,
    DampingBase,
    Model,
    StudyBuilding,
    StudyParameters,
    study_buildings,
)
from seismass.studies.study.run import SCHEMA_VERSION, StudyResult, run_study
from seismass.studies.study.sensitivity import Sensitivity, study_sensitivity
from seismass.studies.study.tables import TABLES

__all__ = [
    "KEYS",
    "MODELS",
    "SCHEMA_VERSION",
    "TABLES",
    "DampingBase",
    "Model",
    "Sensitivity",
    "StudyBuilding",
    "StudyParameters",
    "StudyResult",
    "run_study",
    "study_buildings",
    "study_sensitivity",
]

__dir__ = __all__.copy  # for completion
