"""Evidence for a code: the share of the design live load that acts as mass, over archetypes that the code designs."""

from seismass.effective_mass.answer import effective_mass_table
from seismass.effective_mass.share import EqualShare, equal_share
from seismass.studies.evidence.archetypes import Archetype, Occupancy, Setting, System, example_file, read_archetypes
from seismass.studies.evidence.table import Evidence, default_hazard, evidence

__all__ = [
    "Archetype",
    "EqualShare",
    "Evidence",
    "Occupancy",
    "Setting",
    "System",
    "default_hazard",
    "effective_mass_table",
    "equal_share",
    "evidence",
    "example_file",
    "read_archetypes",
]

__dir__ = __all__.copy  # for completion
