"""Response spectra of ground motions, elastic and inelastic, and target spectra to scale them to."""

from seismass.motions.spectra.codes import DEFAULT_SD1_G, DEFAULT_SDS_G, DEFAULT_TL, MULTI_PERIODS
from seismass.motions.spectra.elastic import GroundMotion, Kind, as_motions, mean_spectrum, response_spectrum
from seismass.motions.spectra.inelastic import InelasticSpectrum, inelastic_spectrum
from seismass.motions.spectra.tables import corner_period
from seismass.motions.spectra.target import TargetSpectrum

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


def __dir__() -> list[str]:
    """Return the public names, for completion."""
    return list(__all__)
