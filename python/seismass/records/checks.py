"""What looks wrong in samples that were read without contradiction: remarks, since none of it is proof."""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.records.record import Record

LARGEST_PGA_G: Final = 5.0
"""The largest ground acceleration recorded is about 4 g (KiK-net IWTH25, 2008, sum of the three components)."""

SMALLEST_PGA_G: Final = 5e-4
"""A smaller peak is of no engineering use; most such files are in another unit than said."""

LARGEST_MEAN: Final = 0.1
"""A mean above this part of the peak is an offset that was not removed."""

SLOWEST: Final = 1.0
"""Mean frequency (Hz, rms of the slope by rms) below which samples look like velocity or displacement.

The 57 horizontals of the NGA-West2 records tried have 2.3 to 8.0 Hz, their velocities 0.3 to 2.0 Hz and their
displacements 0.1 to 0.8 Hz. Accelerations on very soft sites can be below 1 Hz.
"""

SPIKE: Final = 5.0
"""A sample that stands out from its neighbours by so many times any other, and by half the peak, is a spike."""


FEWEST_OF_ONE_SIGN: Final = 50
"""So many samples of a motion have both signs: the ground comes to rest, so that its velocity returns to zero."""

UNUSUAL_STEP: Final = (0.0005, 0.1)
"""Steps (s) of strong-motion records: 2000 to 10 samples a second."""

LARGE_PGA_G: Final = 2.0
"""Few records are larger; one in m/s2 that is called g mostly is."""

LARGE_PGV: Final = 3.5
"""PGV (m/s) above which a unit is doubtful: TCU068 of Chi-Chi, among the largest recorded, has about 3 m/s."""


def no_motion(record: Record) -> str | None:
    """Return why samples are those of no motion: none of the other sign, as in a spectrum; else None."""
    samples = record.acceleration
    if record.samples < FEWEST_OF_ONE_SIGN or np.any(samples > 0.0) == np.any(samples < 0.0):
        return None
    return "its samples have one sign, as those of a spectrum or of absolute values, and no motion's have"


def suspicions(record: Record, *, unit_given: bool) -> tuple[str, ...]:
    """Return remarks on samples that look wrong: the peak at the last sample, a doubtful unit (unless the caller stated
    it: `unit_given`), an offset, a spike.
    """
    samples = record.acceleration
    size = np.abs(samples)
    where = int(np.argmax(size))
    peak = float(size[where])
    remarks: list[str] = []
    if peak == 0.0:
        return ("every sample is zero",)
    if record.samples > 2 and where == record.samples - 1:
        remarks.append("the largest acceleration is the last sample: the file may be cut off")
    if record.pga_g > LARGEST_PGA_G:
        remarks.append(
            f"PGA {record.pga_g:.3g} g is above {LARGEST_PGA_G:g} g: the unit, {record.file_unit}, is doubtful"
        )
    elif record.pga_g > LARGE_PGA_G:
        remarks.append(
            f"PGA {record.pga_g:.3g} g is above {LARGE_PGA_G:g} g, as few records are: is the unit {record.file_unit}?"
        )
    elif record.samples >= FEWEST_OF_ONE_SIGN and record.pgv > LARGE_PGV:
        remarks.append(
            f"PGV {record.pgv:.3g} m/s is above {LARGE_PGV:g} m/s: the unit, {record.file_unit}, or the step, "
            f"{record.dt:g} s, is doubtful, or an offset was not removed"
        )
    elif record.pga_g < SMALLEST_PGA_G and unit_given:
        remarks.append(f"PGA {record.pga_g:.2g} g is very small: the unit, {record.file_unit}, is doubtful")
    one_sign = no_motion(record)
    if one_sign:
        remarks.append(one_sign)
    usual = UNUSUAL_STEP[0] <= record.dt <= UNUSUAL_STEP[1]
    if not usual:
        remarks.append(
            f"step {record.dt:g} s is outside {UNUSUAL_STEP[0]:g} to {UNUSUAL_STEP[1]:g} s, those of strong-motion "
            "records: the unit of the times may be another"
        )
    if record.samples >= 100:
        mean = abs(float(np.mean(samples / peak)))
        if mean > LARGEST_MEAN:
            remarks.append(f"mean is {100.0 * mean:.0f} % of the peak: an offset was not removed")
        frequency = _mean_frequency(record)
        if frequency < SLOWEST and usual:
            remarks.append(
                f"mean frequency {frequency:.2g} Hz is low: velocity or displacement in place of acceleration, "
                "or a very soft site"
            )
        spike = _spike(record)
        if spike is not None:
            remarks.append(spike)
    return tuple(remarks)


def _mean_frequency(record: Record) -> float:
    """Return the rms slope over the rms of a record about its mean, by 2 pi (Hz); infinite for a constant one."""
    samples = record.acceleration / record.pga
    samples = samples - np.mean(samples)
    rms = float(np.sqrt(np.mean(np.square(samples))))
    slope = float(np.sqrt(np.mean(np.square(np.diff(samples))))) / record.dt
    return slope / (2.0 * np.pi * rms) if rms > 0.0 else float("inf")


def _spike(record: Record) -> str | None:
    """Return a remark on the one sample that stands out from its neighbours."""
    samples = record.acceleration / record.pga
    out = np.abs(samples[1:-1] - 0.5 * (samples[:-2] + samples[2:]))
    at = int(np.argmax(out))
    others = out.copy()
    others[max(at - 1, 0) : at + 2] = 0.0
    next_largest = float(np.max(others))
    if out[at] > SPIKE * next_largest and out[at] > 0.5:
        return (
            f"sample {at + 2} (t = {(at + 1) * record.dt:.6g} s) stands out from its neighbours as no other does: "
            "a spike, or a damaged number"
        )
    return None
