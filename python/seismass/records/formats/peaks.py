"""The peak that a header states, held against the samples: a damaged, cut or mixed-up file seldom passes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.records.formats.numbers import is_number, last_digit, to_float

RELATIVE: Final = 2e-6
"""Peaks agree to this beside the rounding of the header: networks compute in single precision."""

SAMPLES_OFF: Final = 1.5
"""The time of a peak agrees to so many steps: networks count the first sample as 0 or as one step."""


@dataclass(frozen=True)
class StatedPeak:
    """A peak as a header writes it: value and time (s) as text, in units of the samples times `factor`."""

    value: str
    time: str = ""
    factor: float = 1.0
    signed: bool = True


def check_peak(
    samples: NDArray[np.float64], peak: StatedPeak, dt: float, resolution: float, file: str, remarks: list[str]
) -> None:
    """Refuse samples whose peak is not the one that the header states; 0 and NaN are not compared. Remark where only
    its time differs (some networks count from another start), or the sign (some give the size).
    """
    written = peak.value.strip()
    if not is_number(written) or to_float(written) == 0.0:
        return
    stated = to_float(written) * peak.factor
    tolerance = 0.5 * last_digit(written) * peak.factor + 0.5 * resolution + RELATIVE * abs(stated)
    tolerance *= 1.0 + 1e-9
    where = int(np.argmax(np.abs(samples)))
    largest = float(samples[where])
    time = to_float(peak.time.strip()) if is_number(peak.time.strip()) else None
    said = f"{written}" + (f" at {time:g} s" if time is not None else "")
    if abs(abs(largest) - abs(stated)) > tolerance:
        raise RecordFormatError(
            f"peak of {file} must be {said}, as its header says; got {largest / peak.factor:.7g} at {where * dt:.6g} s"
        )
    near = np.abs(np.abs(samples) - abs(stated)) <= tolerance
    if peak.signed and not np.any(near & (np.sign(samples) == np.sign(stated))):
        if stated < 0.0:
            raise RecordFormatError(
                f"peak of {file} must be {said}, as its header says; got {largest / peak.factor:.7g}, of the other sign"
            )
        remarks.append(f"the peak is negative, {largest / peak.factor:.6g}; the header gives {written}")
    if time is not None and time > 0.0:
        allowed = SAMPLES_OFF * dt + 0.5 * last_digit(peak.time.strip())
        if np.min(np.abs(np.flatnonzero(near) * dt - time)) > allowed:
            remarks.append(f"the peak is at {where * dt:.6g} s; the header gives {time:g} s")


def digit_of_peak(samples: NDArray[np.float64], fields: Sequence[str]) -> float:
    """Return the unit of the last digit of the largest sample, as the file writes it."""
    return last_digit(fields[int(np.argmax(np.abs(samples)))].strip())
