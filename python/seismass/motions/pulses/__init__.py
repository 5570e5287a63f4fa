"""Velocity pulses of near-fault motions: Baker (2007) on one component, Shahi and Baker (2014) on two.

Needs PyWavelets for the db4 wavelet: pip install PyWavelets.
"""

from seismass.motions.pulses.baker2007 import baker2007, baker2007_orientations, pulse_indicator_2007
from seismass.motions.pulses.result import Candidate, OrientationScan, PulseResult
from seismass.motions.pulses.shahi_baker2014 import pulse_indicator_2014, shahi_baker2014

__all__ = [
    "Candidate",
    "OrientationScan",
    "PulseResult",
    "baker2007",
    "baker2007_orientations",
    "pulse_indicator_2007",
    "pulse_indicator_2014",
    "shahi_baker2014",
]

__dir__ = __all__.copy  # for completion
