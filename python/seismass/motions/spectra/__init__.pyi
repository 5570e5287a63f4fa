"""Names of the module, imported when they are first used; `__init__.py` reads them here."""

from .codes import DEFAULT_SD1_G, DEFAULT_SDS_G, DEFAULT_TL, MULTI_PERIODS
from .elastic import GroundMotion, Kind, as_motions, mean_spectrum, response_spectrum
from .inelastic import InelasticSpectrum, inelastic_spectrum
from .tables import corner_period
from .target import TargetSpectrum

__all__ = [
    "DEFAULT_SD1_G",
    "DEFAULT_SDS_G",
    "DEFAULT_TL",
    "MULTI_PERIODS",
    "GroundMotion",
    "InelasticSpectrum",
    "Kind",
    "TargetSpectrum",
    "as_motions",
    "corner_period",
    "inelastic_spectrum",
    "mean_spectrum",
    "response_spectrum",
]
