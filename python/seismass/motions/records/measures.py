"""The measures of records as a table, and what the ends of velocity and displacement say of a baseline."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Final

import polars as pl

from seismass.base.errors import InvalidMotion
from seismass.base.values import brief, refusal
from seismass.motions.records.record import Record

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
