"""Names of the module, imported when they are first used; `__init__.py` reads them here."""

from .answer import effective_mass, effective_mass_of_design
from .design_map import EffectiveMassMap, EffectiveMassParameters, effective_mass_map
from .live_load import LiveLoadUncertainty, live_load_uncertainty
from .models import attached_scene
from .result import EffectiveMass
from .rule import ByHand

__all__ = [
    "ByHand",
    "EffectiveMass",
    "EffectiveMassMap",
    "EffectiveMassParameters",
    "LiveLoadUncertainty",
    "attached_scene",
    "effective_mass",
    "effective_mass_map",
    "effective_mass_of_design",
    "live_load_uncertainty",
]
