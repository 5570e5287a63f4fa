"""Amplitude scaling of ground motions to a target spectrum, and selection of those whose shape is closest to it."""

from seismass.design.scaling.asce7 import scale_asce7_10, scale_asce7_16
from seismass.design.scaling.by_code import GEOMETRIC_MEAN, SCALING_CODES, scale_by_code
from seismass.design.scaling.oscillator import FirstModeOscillator, first_mode_oscillator
from seismass.design.scaling.pushover import PushoverScaling, scale_modal_pushover
from seismass.motions.scaling.selection import Selection, select_records
from seismass.motions.scaling.suite import ScalingResult, scale_least_squares, scale_sa_t1

__all__ = [
    "GEOMETRIC_MEAN",
    "SCALING_CODES",
    "FirstModeOscillator",
    "PushoverScaling",
    "ScalingResult",
    "Selection",
    "first_mode_oscillator",
    "scale_asce7_10",
    "scale_asce7_16",
    "scale_by_code",
    "scale_least_squares",
    "scale_modal_pushover",
    "scale_sa_t1",
    "select_records",
]

__dir__ = __all__.copy  # for completion
