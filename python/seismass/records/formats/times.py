"""Columns of times: their unit, their step, and a step that the caller gives beside times that are rounded."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.records.formats.headers import LONGEST_STEP, SHORTEST_STEP
from seismass.records.formats.labels import PER_SECOND, Label
from seismass.records.formats.numbers import last_digits
from seismass.records.formats.pairs import uniform_step

FIRST_TIME: Final = 1.5
"""A first time is 0 or one step, or there was something before it."""

_PLAIN_UNITS: Final = {1000.0: "ms", 60.0: "minutes", 1e6: "us"}


@dataclass(frozen=True)
class Times:
    """A column of times: values and as written, its label where it has one, and where it stands."""

    values: NDArray[np.float64]
    written: Sequence[str]
    label: Label | None
    file: str
    line_number: Callable[[int], int]


def step_of_times(times: Times, dt: float | None, remarks: list[str]) -> float | None:
    """Return the step (s) of a column of times, which must be uniform or those of `dt` rounded; None where it only
    counts the samples and no `dt` is given. `remarks` gets what was interpreted.
    """
    unit = times.label.unit.strip().lower() if times.label and times.label.kind == "times" else ""
    if unit and unit not in PER_SECOND:
        raise RecordFormatError(f"unit of the times of {times.file} must be s, ms, us, min or h; got {unit!r}")
    scaled = times.values / PER_SECOND.get(unit, 1.0)
    counts = _is_index(times, unit)
    if counts:
        remarks.append("the first column counts the samples" if dt else "the first column counts the samples: no times")
        return None
    try:
        step = uniform_step(times.values, times.written, times.file, times.line_number, rounding=False)
        step = step / PER_SECOND.get(unit, 1.0)
    except RecordFormatError as error:
        return _step_of_rounded(times, PER_SECOND.get(unit, 1.0), dt, error, remarks)
    if abs(scaled[0]) > FIRST_TIME * step:
        remarks.append(f"the first time is {scaled[0]:g} s: a beginning may be missing; it is taken as zero")
    if dt is not None and not unit and not np.isclose(step, dt, rtol=1e-3):
        factor = next((per for per in _PLAIN_UNITS if np.isclose(step / dt, per, rtol=1e-6)), None)
        if factor is None and np.isclose(step * 60.0, dt, rtol=1e-4):
            factor = 1.0 / 60.0
        if factor is not None:
            remarks.append(f"the times are {_PLAIN_UNITS.get(factor, 'minutes')} by the step that was given")
            return dt
    if not SHORTEST_STEP <= step <= LONGEST_STEP:
        said = f"in {unit}" if unit else "whose unit no label states"
        raise RecordFormatError(
            f"step of {times.file} must be between {SHORTEST_STEP:g} and {LONGEST_STEP:g} s; got {step:g} s from times "
            f"{said}: ms, minutes or a count of samples? Say dt"
        )
    return step


def _is_index(times: Times, unit: str) -> bool:
    """Whether a column counts the samples: by its label, or by whole numbers one apart without a unit."""
    differences = np.diff(times.values)
    ones = len(differences) > 0 and bool(np.all(differences == 1.0))
    if times.label is not None and times.label.kind == "index":
        if not ones:
            raise RecordFormatError(f"index of {times.file} must count by ones; got {times.label.text}")
        return True
    return ones and not unit and not any("." in token for token in times.written)


def _step_of_rounded(
    times: Times, per_second: float, dt: float | None, error: RecordFormatError, remarks: list[str]
) -> float:
    """Return the step that is given where the times are its multiples, rounded to their last digit."""
    half = 0.5 * last_digits([token.strip() for token in times.written])
    half[0] = half.min()
    count = np.arange(len(times.values))
    if dt is not None:
        off = np.abs(times.values - times.values[0] - dt * per_second * count)
        if np.all(off <= (half + half[0]) * (1.0 + 1e-6)):
            remarks.append(f"times are rounded; they agree with the step that was given, {dt!r} s")
            return dt
        raise error
    digit = 2.0 * float(half.max())
    span = float(times.values[-1] - times.values[0])
    rising = len(times.values) > 1 and bool(np.all(np.diff(times.values) >= 0.0)) and span > 0.0
    mean = span / max(len(times.values) - 1, 1)
    allowed = digit if mean < 0.9 * digit else 0.75 * digit
    near = np.abs(times.values - times.values[0] - mean * count) <= allowed * (1.0 + 1e-9)
    if rising and mean < 10.0 * digit and np.all(near):
        least, most = (span - digit) / (len(count) - 1), (span + digit) / (len(count) - 1)
        raise RecordFormatError(
            f"times of {times.file} must be uniform; got times rounded to {digit / per_second:g} s: give dt, which is "
            f"between {least / per_second:.7g} and {most / per_second:.7g} s"
        ) from error
    raise error
