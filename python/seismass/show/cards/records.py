"""A record as a notebook shows it: a sketch of its accelerations in SVG and a line of measures, on any background."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from seismass.media.card import card, history, line, stroke, svg
from seismass.records.measures import drift_remarks

if TYPE_CHECKING:
    from seismass.records.record import Record

WIDTH: Final = 600
RECORD_HEIGHT: Final = 110


def record_html(record: Record) -> str:
    """Return HTML with its style in place: no scripts, nothing from elsewhere, text of the record escaped."""
    title = " ".join(part for part in (record.name or "(unnamed record)", "(synthetic)" * record.synthetic) if part)
    said = [record.event, record.station, record.component]
    if record.azimuth is not None:
        said.append(f"azimuth {record.azimuth:g}\N{DEGREE SIGN}")
    measures = (
        ("PGA", f"{record.pga_g:.4f} g"),
        ("PGV", f"{record.pgv:.3f} m/s"),
        ("PGD", f"{record.pgd:.3f} m"),
        ("Arias", f"{record.arias:.3f} m/s"),
        ("D5-95", f"{record.d5_95:.2f} s"),
        ("CAV", f"{record.cav:.2f} m/s"),
    )
    size = line(f"{record.samples} samples at {record.dt:g} s, {record.duration:g} s")
    notes = [*record.history, *record.remarks, *drift_remarks(record)]
    return card(title, ", ".join(part for part in said if part), _sketch(record), size, facts=measures, notes=notes)


def _sketch(record: Record) -> str:
    """The accelerations with their peak marked."""
    peak = record.pga or 1.0
    middle, reach = 0.5 * RECORD_HEIGHT, 0.5 * RECORD_HEIGHT - 6.0
    y = middle - reach / peak * record.acceleration
    where = int(np.argmax(np.abs(record.acceleration)))
    label = f"accelerations, peak {record.pga_g:.4f} g at {where * record.dt:.2f} s"
    mark = f'<circle cx="{(where + 0.5) * WIDTH / record.samples:.1f}" cy="{y[where]:.1f}" r="3.5" '
    mark += 'fill="none" stroke="currentColor"/>'
    return svg(WIDTH, RECORD_HEIGHT, label, stroke(0.0, middle, WIDTH, middle, opacity=0.4), history(y, WIDTH), mark)
