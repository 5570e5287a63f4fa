"""The step of printed times: uniform within their rounding, and the shortest decimal that gives them all back."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.records.formats.numbers import last_digits

UNIFORMITY: Final = 0.05
"""Largest departure of a time from uniform sampling, in steps, beside the rounding of the times."""


def uniform_step(
    times: NDArray[np.float64],
    written: Sequence[str],
    file: str,
    line_number: Callable[[int], int] | None = None,
    *,
    rounding: bool = True,
) -> float:
    """Return the step (s) of times that are uniform; `written` are the times as in the file. With `rounding` half the
    last digit of a time is allowed beside `UNIFORMITY`, as for steps of 5 ms printed in ms.
    """
    if len(times) < 2:
        raise RecordFormatError(f"times of {file} must be at least two, to give a step; got {len(times)}")
    span = float(times[-1] - times[0])
    step = span / (len(times) - 1)
    if not step > 0.0:
        raise RecordFormatError(f"times of {file} must increase; got {times[0]:g} s first, {times[-1]:g} s last")
    half_digit = 0.5 * last_digits([token.strip() for token in written])
    half_digit[0] = half_digit.min()  # a first time of "0" is as exact as the others
    off = np.abs(times - (times[0] + step * np.arange(len(times))))
    excess = off - UNIFORMITY * step - (2.0 * half_digit if rounding else 0.0)
    worst = int(np.argmax(excess))
    if excess[worst] > 1e-9 * span:
        where = f"line {line_number(worst)}" if line_number is not None else f"sample {worst + 1}"
        raise RecordFormatError(
            f"times of {file} must be uniform, here {step:.6g} s apart; "
            f"got {times[worst]:g} s in {where}, {off[worst]:.3g} s off"
        )
    # The shortest step that gives every time back to its last printed digit: 0.01, not 0.010000000000000002.
    margin = half_digit + 1e-12 * span
    for digits in range(1, 17):
        short = float(f"{step:.{digits}g}")
        start = times - short * np.arange(len(times))
        if np.max(start - margin) <= np.min(start + margin):
            return short
    return step
