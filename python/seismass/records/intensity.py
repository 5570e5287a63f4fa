"""Measures of a ground motion whose acceleration is linear between samples, each exact for that motion.

Velocity is then quadratic and displacement cubic between samples, so that peaks, integrals and crossings have closed
forms within every step. The motion starts from rest at its first sample and ends at its last.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import polars as pl

from seismass._values import FloatArray, as_number, brief, refusal
from seismass.errors import InvalidMotion, InvalidOption
from seismass.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    from seismass.records.record import Record

BRACKET_G: Final = 0.05
"""Threshold of the bracketed duration (g), Bolt (1973)."""

END_VELOCITY: Final = 0.05
"""Share of PGV above which the velocity at the end of a record is remarked."""
END_DISPLACEMENT: Final = 0.25
"""Share of PGD above which the displacement at the end of a record is remarked."""

MEASURES: Final = (
    "pga_g",
    "pgv",
    "pgd",
    "arias",
    "d5_75",
    "d5_95",
    "cav",
    "bracketed",
    "end_velocity",
    "end_displacement",
)
"""Columns of measures: g, m/s, m, m/s, s, s, m/s, s, m/s and m."""


def integrals(acceleration: FloatArray, dt: float) -> tuple[FloatArray, FloatArray]:
    """Return velocity (m/s) and displacement (m) at the samples, from rest.

    Parameters
    ----------
    acceleration : ndarray, shape (..., samples)
        Samples (m/s2); linear between them.
    dt : float
        Time step (s).
    """
    before, after = acceleration[..., :-1], acceleration[..., 1:]
    velocity = np.zeros(acceleration.shape)
    np.cumsum(0.5 * dt * (before + after), axis=-1, out=velocity[..., 1:])
    displacement = np.zeros(acceleration.shape)
    steps = dt * velocity[..., :-1] + dt * dt / 6.0 * (2.0 * before + after)
    np.cumsum(steps, axis=-1, out=displacement[..., 1:])
    return velocity, displacement


def peak_velocity(acceleration: FloatArray, dt: float, velocity: FloatArray) -> FloatArray:
    """Return the largest absolute velocity in continuous time (m/s): at a sample, or where acceleration is zero."""
    before, after = acceleration[..., :-1], acceleration[..., 1:]
    within = before * after < 0.0
    first, last = before[within], after[within]
    turns = np.zeros(within.shape)
    turns[within] = velocity[..., :-1][within] + 0.5 * dt * first * (first / (first - last))
    return _largest(velocity, turns)


def peak_displacement(
    acceleration: FloatArray, dt: float, velocity: FloatArray, displacement: FloatArray
) -> FloatArray:
    """Return the largest absolute displacement in continuous time (m): at a sample, or where velocity is zero."""
    before, after = acceleration[..., :-1], acceleration[..., 1:]
    # Velocity may be zero within a step if it changes sign or turns there.
    within = (velocity[..., :-1] * velocity[..., 1:] < 0.0) | (before * after < 0.0)
    start, slope = velocity[..., :-1][within], dt * before[within]
    bend = 0.5 * dt * (after[within] - before[within])
    # It is start + slope s + bend s^2 for s from 0 to 1; both roots without cancellation, 0 for those outside.
    discriminant = slope * slope - 4.0 * bend * start
    real = discriminant >= 0.0
    w = -0.5 * (slope + np.copysign(np.sqrt(np.where(real, discriminant, 0.0)), slope))
    turns = np.zeros((2, *within.shape))
    for turn, above, below in zip(turns, (w, start), (bend, w), strict=True):
        inside = real & (np.abs(above) < np.abs(below)) & ((above > 0.0) == (below > 0.0))
        s = np.divide(above, below, out=np.zeros(w.shape), where=inside)
        moved = dt * s * (start + s * (0.5 * slope + s * bend / 3.0))
        turn[within] = displacement[..., :-1][within] + moved
    return _largest(displacement, *turns)


def _largest(*values: FloatArray) -> FloatArray:
    """Largest absolute value over the last axes."""
    largest = [np.max(np.abs(part), axis=-1, initial=0.0) for part in values]
    return np.asarray(np.max(largest, axis=0), dtype=np.float64)


def build_up(acceleration: FloatArray, dt: float) -> FloatArray:
    """Return the Arias intensity up to each sample (m/s): pi/(2 g) times the integral of a^2, cubic within a step.

    Arias (1970), A measure of earthquake intensity.
    """
    before, after = acceleration[..., :-1], acceleration[..., 1:]
    built = np.zeros(acceleration.shape)
    np.cumsum((before * before + before * after + after * after) * (dt / 3.0), axis=-1, out=built[..., 1:])
    return built * (math.pi / (2.0 * STANDARD_GRAVITY))


def time_of_share(acceleration: FloatArray, dt: float, share: float) -> float:
    """Return the first time (s) at which the Arias build-up reaches a share of its end; 0 for a motion of zeros."""
    built = build_up(acceleration, dt)
    level = min(share * float(built[-1]), float(built[-1]))
    last = int(np.searchsorted(built, level))  # the first sample at which it is reached
    if last == 0:
        return 0.0
    first, end = float(acceleration[last - 1]), float(acceleration[last])
    rest = (level - float(built[last - 1])) * (2.0 * STANDARD_GRAVITY / math.pi) / dt
    # The integral of a^2 from a = first to a = x is (x^3 - first^3) / (3 (end - first)) of a step.
    x = math.cbrt(first**3 + 3.0 * (end - first) * rest)
    below = x * x + x * first + first * first
    return dt * (last - 1 + min(3.0 * rest / below if below > 0.0 else 1.0, 1.0))


def significant_duration(acceleration: FloatArray, dt: float, start: float, end: float) -> float:
    """Return the time (s) between two shares of the Arias intensity; Trifunac and Brady (1975) take 0.05 and 0.95.

    Raises
    ------
    InvalidOption
        The shares are not in order between 0 and 1.
    """
    first = as_number(start, "start", "significant duration", InvalidOption)
    last = as_number(end, "end", "significant duration", InvalidOption)
    if not 0.0 <= first <= 1.0:
        raise refusal(InvalidOption, "start", "significant duration", "a share from 0 to 1", brief(start))
    if not first <= last <= 1.0:
        raise refusal(InvalidOption, "end", "significant duration", f"a share from {first:g} to 1", brief(end))
    return time_of_share(acceleration, dt, last) - time_of_share(acceleration, dt, first)


def cumulative_absolute_velocity(acceleration: FloatArray, dt: float) -> float:
    """Return the integral of abs(a) (m/s), with the changes of sign within steps; EPRI NP-5930 (1988), unfiltered."""
    size = np.abs(acceleration)
    before, after = size[:-1], size[1:]
    both = before + after
    crossing = acceleration[:-1] * acceleration[1:] < 0.0
    # Two triangles over a step where the sign changes, a trapezium elsewhere.
    triangles = np.divide(before * before + after * after, both, out=np.zeros(both.shape), where=crossing)
    return float(0.5 * dt * np.sum(np.where(crossing, triangles, both)))


def bracketed_duration(acceleration: FloatArray, dt: float, threshold_g: float) -> float:
    """Return the time (s) from the first to the last crossing of a threshold of abs(a); 0 where it is not reached.

    Raises
    ------
    InvalidOption
        The threshold is not a positive number.
    """
    threshold = as_number(threshold_g, "threshold_g", "bracketed duration", InvalidOption)
    if not (math.isfinite(threshold) and threshold > 0.0):
        raise refusal(InvalidOption, "threshold_g", "bracketed duration", "a positive number", brief(threshold_g))
    size, level = np.abs(acceleration), threshold * STANDARD_GRAVITY
    above = np.flatnonzero(size >= level)
    if len(above) == 0:
        return 0.0

    def crossing(inside: int, outside: int) -> float:
        """Time from the sample at which the threshold is reached to its crossing towards the one beside it."""
        if not 0 <= outside < len(size):
            return 0.0
        beside = float(acceleration[outside]) * math.copysign(1.0, acceleration[inside])
        return dt * (float(size[inside]) - level) / (float(size[inside]) - beside)

    first, last = int(above[0]), int(above[-1])
    return (last - first) * dt + crossing(first, first - 1) + crossing(last, last + 1)


def drift_remarks(record: Record) -> tuple[str, ...]:
    """Return what the ends of velocity and displacement say about the baseline of a record; nothing for most.

    A recording ends nearly at rest: a velocity at its end above `END_VELOCITY` of PGV, or a displacement above
    `END_DISPLACEMENT` of PGD, is more often an error of the baseline, or a record cut short, than motion of the
    ground. Permanent displacement near a fault is the exception.
    """
    velocity, displacement = float(record.velocity[-1]), float(record.displacement[-1])
    remarks = []
    if abs(velocity) > END_VELOCITY * record.pgv:
        share = 100.0 * abs(velocity) / record.pgv
        remarks.append(
            f"ends with a velocity of {velocity:.3g} m/s, {share:.0f} % of PGV: baseline doubtful or cut off"
        )
    if abs(displacement) > END_DISPLACEMENT * record.pgd:
        share = 100.0 * abs(displacement) / record.pgd
        remarks.append(
            f"ends with a displacement of {displacement:.3g} m, {share:.0f} % of PGD: a drift of the baseline or a "
            "permanent displacement"
        )
    return tuple(remarks)


def measures(record: Record) -> dict[str, float]:
    """Return the measures of `MEASURES` of one record by name."""
    return {
        "pga_g": record.pga_g,
        "pgv": record.pgv,
        "pgd": record.pgd,
        "arias": record.arias,
        "d5_75": record.d5_75,
        "d5_95": record.d5_95,
        "cav": record.cav,
        "bracketed": record.bracketed_duration(),
        "end_velocity": float(record.velocity[-1]),
        "end_displacement": float(record.displacement[-1]),
    }


def intensity_table(records: Iterable[Record]) -> pl.DataFrame:
    """Return the measures of records, one row each.

    Parameters
    ----------
    records : iterable of Record
        A suite, a pair or a list.

    Returns
    -------
    polars.DataFrame
        `motion` (from 1), name, event, station, component, samples, dt and duration (s), then `pga_g` (g), `pgv` (m/s),
        `pgd` (m), `arias` (m/s), `d5_75` and `d5_95` (s), `cav` (m/s), `bracketed` (s, at 0.05 g), `end_velocity` (m/s)
        and `end_displacement` (m), and `remarks` on a baseline that drifts.

    Raises
    ------
    InvalidMotion
        Something else than records.

    Examples
    --------
    >>> import seismass as sm
    >>> table = sm.intensity_table(sm.builtin_suite())
    >>> table.columns[7:12]
    ['duration', 'pga_g', 'pgv', 'pgd', 'arias']
    """
    from seismass.records.record import Record  # which imports this module

    try:
        given: list[Any] = [records] if isinstance(records, Record) else list(records)
    except TypeError:
        raise refusal(InvalidMotion, "records", "intensity table", "Records", brief(records)) from None
    rows = []
    for number, record in enumerate(given, start=1):
        if not isinstance(record, Record):
            raise refusal(InvalidMotion, f"record {number}", "intensity table", "a Record", brief(record))
        labels = {name: getattr(record, name) for name in ("name", "event", "station", "component")}
        size = {"samples": record.samples, "dt": record.dt, "duration": record.duration}
        rows.append({"motion": number} | labels | size | measures(record) | {"remarks": list(drift_remarks(record))})
    schema: dict[str, Any] = {"motion": pl.UInt32} | dict.fromkeys(("name", "event", "station", "component"), pl.String)
    schema |= {"samples": pl.UInt32, "dt": pl.Float64, "duration": pl.Float64}
    schema |= dict.fromkeys(MEASURES, pl.Float64) | {"remarks": pl.List(pl.String)}
    return pl.DataFrame(rows, schema=schema)
