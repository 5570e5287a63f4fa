"""RotDnn: percentiles over all directions in plan of peaks and spectral ordinates (Boore, 2010), by exact spectra;
and the measures of records as a table.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.values import FieldValue, FloatArray, as_array, as_count, as_number, brief, frozen, refusal
from seismass.base.views import Card
from seismass.motions.records.intensity import integrals, peak_displacement, peak_velocity
from seismass.motions.records.pair import Pair
from seismass.motions.records.record import Record

if TYPE_CHECKING:
    from seismass.motions.spectra import Kind


ANGLES: Final = 180
"""Directions over half a turn: every degree, as in Boore (2010)."""


@dataclass(frozen=True, eq=False)
class RotD(FieldValue, Card):
    """Percentiles over directions, and the direction of the largest.

    Attributes
    ----------
    periods : ndarray, shape (periods,)
        Natural periods (s).
    percentiles : ndarray, shape (percentiles,)
        0 is the least over all directions, 50 the median, 100 the largest.
    values : ndarray, shape (percentiles, periods)
        Spectral ordinates in the unit of their kind.
    angle : ndarray, shape (periods,)
        Angle of the largest (degrees from the first component towards the second, 0 to below 180).
    azimuth : ndarray, shape (periods,), or None
        The same as an azimuth (degrees from north, below 180), where the directions of the pair are stated.
    peaks : dict of str to ndarray, shape (percentiles,)
        Percentiles of "pga" (m/s2), "pgv" (m/s) and "pgd" (m), each in continuous time.
    peak_angle : dict of str to float
        Angle of the largest of each of these (degrees).
    damping : float
        Ratio of critical damping.
    kind : str
        Ordinate, as in `response_spectrum`.
    """

    periods: FloatArray
    percentiles: FloatArray
    values: FloatArray
    angle: FloatArray
    azimuth: FloatArray | None
    peaks: dict[str, FloatArray]
    peak_angle: dict[str, float]
    damping: float
    kind: str

    def __getitem__(self, percentile: float) -> FloatArray:
        """Return the spectrum of one of the percentiles, shape (periods,)."""
        indices = np.flatnonzero(self.percentiles == percentile)
        if len(indices) == 0:
            known = "one of " + ", ".join(f"{value:g}" for value in self.percentiles)
            raise refusal(InvalidOption, "percentile", "RotD", known, brief(percentile))
        row: FloatArray = self.values[indices[0]]
        return row

    def table(self) -> pl.DataFrame:
        """Return one row per period: period, a column `rotdNN` for each percentile, `angle`, and `azimuth` if known."""
        columns: dict[str, Any] = {"period": self.periods}
        for percentile, row in zip(self.percentiles, self.values, strict=True):
            columns[f"rotd{percentile:02g}"] = row
        columns["angle"] = self.angle
        if self.azimuth is not None:
            columns["azimuth"] = self.azimuth
        return pl.DataFrame(columns)


def rotd(
    pair: Pair,
    periods: ArrayLike,
    percentiles: Sequence[float] = (0, 50, 100),
    damping: float = 0.05,
    *,
    angles: int = ANGLES,
    kind: Kind = "pseudo_acceleration",
    threads: int | None = None,
) -> RotD:
    """Return percentiles over directions of peak ordinates of a pair, independent of how its sensors stood.

    The two components are combined at every angle and each combination is solved exactly, as a motion of its own: its
    peaks are those in continuous time.

    Parameters
    ----------
    pair : Pair
        Two horizontal components.
    periods : array_like, shape (periods,)
        Natural periods (s).
    percentiles : sequence of float, optional
        From 0 to 100; interpolated linearly between the sorted values over the angles.
    damping : float, default 0.05
        Ratio of critical damping.
    angles : int, default 180
        Directions, evenly over half a turn from the first component on; the other half has the same peaks.
    kind : {"pseudo_acceleration", "displacement", "pseudo_velocity", "acceleration"}, default "pseudo_acceleration"
        Ordinate, as in `response_spectrum`, in m/s2, m, m/s or m/s2.
    threads : int, optional
        As in `response_spectrum`.

    Raises
    ------
    InvalidMotion
        `pair` is not a Pair.
    InvalidOption
        An option out of its range.

    Notes
    -----
    Boore (2010), Bull. Seism. Soc. Am. 100:1830-1835. The largest over whole degrees is at most 1 - cos(0.5 degrees),
    0.004 %, below that over all directions.

    Examples
    --------
    >>> import seismass as sm
    >>> record = sm.builtin_suite()[0]
    >>> diagonal = sm.Pair.from_records(record, record.scaled(-1.0))
    >>> sm.records.rotd(diagonal, [0.5, 1.0]).angle
    array([135., 135.])
    """
    from seismass.motions.motion import Motion  # reading records needs no kernel
    from seismass.motions.spectra import response_spectrum

    if not isinstance(pair, Pair):
        raise refusal(InvalidMotion, "pair", "RotD", "a Pair", brief(pair))
    shares = as_array(percentiles, "percentiles", "RotD", InvalidOption)
    if len(shares) == 0 or not np.all((shares >= 0.0) & (shares <= 100.0)):
        raise refusal(InvalidOption, "percentiles", "RotD", "a list of numbers from 0 to 100", brief(percentiles))
    count = as_count(angles, "angles", "RotD", InvalidOption, least=2)
    ratio = as_number(damping, "damping", "RotD", InvalidOption)
    grid = as_array(periods, "periods", "RotD", InvalidOption)
    turns = frozen(np.arange(count) * (180.0 / count))
    rotated = pair.at_angles(turns)
    ordinates = response_spectrum([Motion(row, pair.dt) for row in rotated], grid, ratio, kind, threads=threads)
    angle = turns[np.argmax(ordinates, axis=0)]
    azimuth = None
    if pair.azimuths is not None:
        azimuth = frozen((pair.azimuths[0] + np.copysign(1.0, pair.apart) * angle) % 180.0)
    peaks = _peaks(rotated, pair.dt)
    return RotD(
        periods=grid,
        percentiles=shares,
        values=frozen(np.percentile(ordinates, shares, axis=0)),
        angle=frozen(angle),
        azimuth=azimuth,
        peaks={name: frozen(np.percentile(values, shares)) for name, values in peaks.items()},
        peak_angle={name: float(turns[np.argmax(values)]) for name, values in peaks.items()},
        damping=ratio,
        kind=kind,
    )


def _peaks(rotated: FloatArray, dt: float) -> dict[str, FloatArray]:
    """Peaks of each rotated motion in continuous time."""
    velocity, displacement = integrals(rotated, dt)
    return {
        "pga": np.max(np.abs(rotated), axis=-1),
        "pgv": peak_velocity(rotated, dt, velocity),
        "pgd": peak_displacement(rotated, dt, velocity, displacement),
    }


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


def drift_remarks(record: Record) -> tuple[str, ...]:
    """Return remarks on the baseline: a velocity at the end above `END_VELOCITY` of PGV or a displacement above
    `END_DISPLACEMENT` of PGD is mostly an error or a cut, except for permanent displacement near a fault.
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
        Something other than records.

    Examples
    --------
    >>> import seismass as sm
    >>> table = sm.records.intensity_table(sm.builtin_suite())
    >>> table.columns[7:12]
    ['duration', 'pga_g', 'pgv', 'pgd', 'arias']
    """
    try:
        listed: list[Any] = [records] if isinstance(records, Record) else list(records)
    except TypeError:
        raise refusal(InvalidMotion, "records", "intensity table", "Records", brief(records)) from None
    rows = []
    for number, record in enumerate(listed, start=1):
        if not isinstance(record, Record):
            raise refusal(InvalidMotion, f"record {number}", "intensity table", "a Record", brief(record))
        labels = {name: getattr(record, name) for name in ("name", "event", "station", "component")}
        size = {"samples": record.samples, "dt": record.dt, "duration": record.duration}
        rows.append({"motion": number} | labels | size | record.measures() | {"remarks": list(drift_remarks(record))})
    schema: dict[str, Any] = {"motion": pl.UInt32} | dict.fromkeys(("name", "event", "station", "component"), pl.String)
    schema |= {"samples": pl.UInt32, "dt": pl.Float64, "duration": pl.Float64}
    schema |= dict.fromkeys(MEASURES, pl.Float64) | {"remarks": pl.List(pl.String)}
    return pl.DataFrame(rows, schema=schema)
