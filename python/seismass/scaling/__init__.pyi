"""Names of the module, imported when they are first used; `__init__.py` reads them here."""

from .asce7 import scale_asce7_10, scale_asce7_16
from .least_squares import scale_least_squares
from .oscillator import FirstModeOscillator, first_mode_oscillator
from .pushover import PushoverScaling, scale_modal_pushover
from .result import ScalingResult
from .selection import Selection, select_records
from .single_period import scale_sa_t1

__all__ = [
    "FirstModeOscillator",
    "PushoverScaling",
    "ScalingResult",
    "Selection",
    "first_mode_oscillator",
    "scale_asce7_10",
    "scale_asce7_16",
    "scale_least_squares",
    "scale_modal_pushover",
    "scale_sa_t1",
    "select_records",
]
