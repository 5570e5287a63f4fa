"""Response spectra of ground motions, elastic and inelastic, and target spectra to scale them to."""

from seismass.spectra.asce7 import DEFAULT_SD1_G, DEFAULT_SDS_G, DEFAULT_TL, MULTI_PERIODS
from seismass.spectra.elastic import Kind, mean_spectrum, response_spectrum
from seismass.spectra.inelastic import InelasticSpectrum, inelastic_spectrum
from seismass.spectra.motions import GroundMotion, as_motions
from seismass.spectra.suite_mean import corner_period
from seismass.spectra.target import TargetSpectrum

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
