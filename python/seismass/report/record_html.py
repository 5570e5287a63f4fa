"""A record as a notebook shows it: a sketch of its accelerations in SVG and a line of measures, on any background."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Final

import numpy as np

from seismass.records.intensity import drift_remarks

if TYPE_CHECKING:
    from seismass.records.record import Record

WIDTH: Final = 600
HEIGHT: Final = 110
COLOUR: Final = "#0072B2"
"""Legible on white and on dark grey; everything else has the colour of the text around it."""


def record_html(record: Record) -> str:
    """Return HTML with its style in place: no scripts, nothing from elsewhere, text of the record escaped."""
    title = " ".join(part for part in (record.name or "(unnamed record)", "(synthetic)" * record.synthetic) if part)
    said = [record.event, record.station, record.component]
    if record.azimuth is not None:
        said.append(f"azimuth {record.azimuth:g}\N{DEGREE SIGN}")
    about = ", ".join(escape(part) for part in said if part)
    measures = (
        ("PGA", f"{record.pga_g:.4f} g"),
        ("PGV", f"{record.pgv:.3f} m/s"),
        ("PGD", f"{record.pgd:.3f} m"),
        ("Arias", f"{record.arias:.3f} m/s"),
        ("D5-95", f"{record.d5_95:.2f} s"),
        ("CAV", f"{record.cav:.2f} m/s"),
    )
    cells = "".join(
        f'<span style="margin-right:1.2em;white-space:nowrap">{name}&nbsp;<b>{value}</b></span>'
        for name, value in measures
    )
    notes = [*record.history, *record.remarks, *drift_remarks(record)]
    listed = "".join(f"<li>{escape(note)}</li>" for note in notes)
    return (
        '<div style="max-width:640px;color:inherit;font-size:90%">'
        f"<div><b>{escape(title)}</b>{': ' if about else ''}{about}</div>"
        f"{_sketch(record)}<div>{cells}</div>"
        f"<div>{record.samples} samples at {record.dt:g} s, {record.duration:g} s</div>"
        + (f'<ul style="margin:0.3em 0">{listed}</ul>' if notes else "")
        + "</div>"
    )


def _sketch(record: Record) -> str:
    """The accelerations with their peak marked: a line, or their range in each column of pixels where they are many."""
    peak = record.pga or 1.0
    middle, reach = 0.5 * HEIGHT, 0.5 * HEIGHT - 6.0
    width = WIDTH / record.samples
    y = middle - reach / peak * record.acceleration
    if record.samples <= WIDTH:
        points = " ".join(f"{(number + 0.5) * width:.1f},{at:.1f}" for number, at in enumerate(y))
        curve = f'<polyline points="{points}" stroke="{COLOUR}" fill="none"/>'
    else:
        starts = np.linspace(0, record.samples, WIDTH, endpoint=False).astype(int)
        # Columns share their border samples, so that the curve has no gaps.
        ends = np.minimum(np.append(starts[1:], record.samples) + 1, record.samples)
        parts = [y[start:end] for start, end in zip(starts, ends, strict=True)]
        path = "".join(f"M{x}.5 {part.min():.1f}V{part.max() + 0.1:.1f}" for x, part in enumerate(parts))
        curve = f'<path d="{path}" stroke="{COLOUR}" fill="none"/>'
    where = int(np.argmax(np.abs(record.acceleration)))
    label = f"accelerations, peak {record.pga_g:.4f} g at {where * record.dt:.2f} s"
    return (
        f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" width="100%" style="max-width:{WIDTH}px;display:block" role="img" '
        f'aria-label="{label}"><title>{label}</title>'
        f'<line x1="0" y1="{middle}" x2="{WIDTH}" y2="{middle}" stroke="currentColor" stroke-opacity="0.4"/>{curve}'
        f'<circle cx="{(where + 0.5) * width:.1f}" cy="{y[where]:.1f}" r="3.5" '
        'fill="none" stroke="currentColor"/></svg>'
    )
