"""Suites of records and target spectra as a notebook shows them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import counted
from seismass.media.card import card, curve, history, rows, stroke, svg, text
from seismass.media.text_table import column_texts

if TYPE_CHECKING:
    from seismass.records.record import Record
    from seismass.records.suite import Suite
    from seismass.spectra import TargetSpectrum

MOST_ROWS: Final = 12
"""Most records that are listed."""
LONGEST_PERIOD: Final = 4.0
"""Period up to which a spectrum is drawn (s)."""


def suite_html(suite: Suite) -> str:
    """Return a card of a suite: a row and a small curve for each record."""
    shown = suite.records[:MOST_ROWS]
    labels = [
        (record.name or "(unnamed)", ", ".join(part for part in (record.event, record.station) if part))
        for record in shown
    ]
    columns = [
        column_texts([record.pga_g for record in shown], unit=" g"),
        column_texts([record.duration for record in shown], digits=4, unit=" s"),
        column_texts([record.dt for record in shown], digits=2, unit=" s"),
    ]
    body = [(*label, *cells) for label, *cells in zip(labels, *columns, strict=True)]
    table = rows(("record", "event, station", "PGA", "duration", "step"), body, markup=[_curve(one) for one in shown])
    notes = [f"and {len(suite) - MOST_ROWS} more records"] if len(suite) > MOST_ROWS else []
    if suite.excluded:
        notes.append(f"{counted(len(suite.excluded), 'file')} left out")
    return card(suite.name or "Suite", counted(len(suite), "record"), table, notes=[*notes, *suite.remarks])


def _curve(record: Record) -> str:
    peak = record.pga or 1.0
    return svg(
        120.0,
        24.0,
        f"accelerations of {record.name}",
        history(12.0 - 11.0 / peak * record.acceleration, 120),
        stretch=False,
    )


def target_html(target: TargetSpectrum) -> str:
    """Return a card of a target spectrum: its ordinates over the period."""
    longest = min(target.longest, LONGEST_PERIOD)
    periods = np.linspace(target.shortest, longest, 201)
    ordinates = target(periods) / STANDARD_GRAVITY
    left, right, top, bottom = 46.0, 440.0, 10.0, 130.0
    highest = float(ordinates.max()) or 1.0
    x = left + (right - left) * periods / longest
    y = bottom - (bottom - top) * ordinates / highest
    parts = [stroke(left, bottom, right, bottom, opacity=0.5), stroke(left, top, left, bottom, opacity=0.5)]
    for share in (0.0, 0.25, 0.5, 0.75, 1.0):
        at = left + share * (right - left)
        parts += [stroke(at, bottom, at, bottom + 3.0, opacity=0.5)]
        parts.append(text(at, bottom + 15.0, f"{share * longest:.3g}", anchor="middle"))
    parts.append(text(right + 8.0, bottom + 15.0, "s"))
    parts += [text(left - 6.0, at + 4.0, said, anchor="end") for at, said in ((bottom, "0"), (top, f"{highest:.3g} g"))]
    label = f"pseudo-acceleration up to {highest:.3g} g, from {target.shortest:g} to {longest:g} s"
    facts = [(f"Sa({period:g} s)", f"{target([period])[0] / STANDARD_GRAVITY:.3g} g") for period in _within(target)]
    return card("Target spectrum", target.label, svg(470.0, 150.0, label, *parts, curve(x, y, width=1.8)), facts=facts)


def _within(target: TargetSpectrum) -> list[float]:
    """Periods that are named (s)."""
    return [period for period in (0.2, 0.5, 1.0, 2.0) if target.shortest <= period <= target.longest]
