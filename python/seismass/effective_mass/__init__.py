"""The effective fraction of live load: the share of a building's goods that acts as mass in an earthquake."""

from seismass.effective_mass.answer import effective_mass, effective_mass_of_design
from seismass.effective_mass.design_map import EffectiveMassMap, EffectiveMassParameters, effective_mass_map
from seismass.effective_mass.estimate import ByHand
from seismass.effective_mass.live_load import LiveLoadUncertainty, live_load_uncertainty
from seismass.effective_mass.models import attached_scene
from seismass.effective_mass.result import EffectiveMass

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
