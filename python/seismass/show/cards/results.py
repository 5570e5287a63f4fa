"""A response and an effective mass as a notebook shows them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from seismass.base.units import STANDARD_GRAVITY
from seismass.effective_mass.estimate import RULE, SAFE_RULE
from seismass.media.card import COLOUR, SECOND, card, history, line, pre, rows, stroke, svg, text
from seismass.media.result import Result
from seismass.media.text_table import column_texts
from seismass.model.places import floor_name, goods_names, spring_names
from seismass.show.rack_text import base_line

if TYPE_CHECKING:
    from seismass.effective_mass.result import EffectiveMass
    from seismass.runs.response import Response

WIDTH: Final = 600
HEIGHT: Final = 90.0
MOST_ROWS: Final = 12
"""Most storeys and most blocks that are listed."""


def response_html(response: Response) -> str:
    """Return a card of a response: the history that drifts or slips most, where it has any, and peaks."""
    scene = response.scene
    fell = response.collapsed_storey
    where = "" if fell is None else f" in {spring_names(scene)[fell - 1]}"
    ended = f"{response.status}{where} at {response.end_time:g} s"
    motion = response.record.name if response.record is not None else repr(response.motion)
    about = ", ".join(part for part in (scene.name, motion) if part)
    facts = [(name, str(count)) for name, count in response.counts.items() if count]
    base = line(base_line(scene, response)) if scene.base is not None else ""
    tables = (_storeys(response), base, _racks(response), _blocks(response))
    return card(f"Response, {ended}", about, _largest(response), *tables, facts=facts)


def _largest(response: Response) -> str:
    """The history of the storey that drifts most; on the ground alone of the block that slips most."""
    if response._get("drift") is None:
        return ""
    kind, values, peaks = (
        ("drift of storey", response.drift, response.peak_drift)
        if len(response.peak_drift)
        else ("slip of block", response.slip, response.peak_slip)
    )
    if not len(peaks):
        return ""
    number = int(np.argmax(peaks))
    known = values[:, number][np.isfinite(values[:, number])]
    peak = float(np.abs(known).max(initial=0.0)) or 1.0
    middle = 0.5 * HEIGHT
    label = f"{kind} {number + 1} over {response.end_time:g} s, peak {1e3 * peaks[number]:.3g} mm"
    curve = history(middle - (middle - 14.0) / peak * known, WIDTH) if len(known) else ""
    zero = stroke(0.0, middle, WIDTH, middle, opacity=0.4)
    return svg(WIDTH, HEIGHT, label, zero, curve, text(WIDTH, 11.0, label, anchor="end"))


def _storeys(response: Response) -> str:
    drift, ratio = response.peak_drift, response.peak_drift_ratio
    if not len(drift):
        return ""
    residual, acceleration = response.residual_drift, response.peak_floor_acceleration / STANDARD_GRAVITY
    order = np.sort(np.argsort(-drift, kind="stable")[:MOST_ROWS])
    columns = [
        column_texts(drift[order].tolist(), digits=4, scale=1e3, unit=" mm"),
        *([] if ratio is None else [column_texts(ratio[order].tolist(), scale=100.0, unit=" %")]),
        column_texts(residual[order].tolist(), scale=1e3, unit=" mm"),
        column_texts(acceleration[order].tolist(), unit=" g"),
    ]
    body = list(zip([f"storey {number + 1}" for number in order], *columns, strict=True))
    over = [] if ratio is None else ["over height"]
    left_out = line(f"the {MOST_ROWS} that drift most of {len(drift)}") if len(drift) > MOST_ROWS else ""
    return rows(("", "peak drift", *over, "residual", "acceleration above"), body) + left_out


def _racks(response: Response) -> str:
    """Peaks of each rack: of the level that drifts most, and the largest acceleration of any."""
    racks = response.scene.racks
    if not racks:
        return ""
    drifts = column_texts([float(drift.max()) for drift in response.peak_rack_drift], digits=4, scale=1e3, unit=" mm")
    peaks = [float(peak.max()) / STANDARD_GRAVITY for peak in response.peak_rack_acceleration]
    levels = [str(int(np.argmax(drift)) + 1) for drift in response.peak_rack_drift]
    names = [f"rack {number}, {floor_name(rack.floor)}" for number, rack in enumerate(racks, start=1)]
    body = list(zip(names, drifts, levels, column_texts(peaks, unit=" g"), strict=True))
    return rows(("", "peak drift", "of level", "acceleration"), body)


def _blocks(response: Response) -> str:
    slip, path, places = response.peak_slip, response.slip_path, goods_names(response.scene)
    if not len(slip):
        return ""
    order = np.sort(np.argsort(-slip, kind="stable")[:MOST_ROWS])
    columns = [
        column_texts(values[order].tolist(), digits=4, scale=1e3, unit=" mm")
        for values in (slip, response.residual_slip, path)
    ]
    labels = [(f"block {number + 1}", places[number].removeprefix("floor ")) for number in order]
    body = [(*label, *cells) for label, *cells in zip(labels, *columns, strict=True)]
    left_out = line(f"the {MOST_ROWS} that slip most of {len(slip)}") if len(slip) > MOST_ROWS else ""
    return rows(("", "floor", "peak slip", "residual", "path"), body) + left_out


def effective_mass_html(result: EffectiveMass) -> str:
    """Return a card of an effective fraction: where it lies between 0 and 1, with its interval and the estimates."""
    left, right, middle = 20.0, 560.0, 42.0

    def at(share: float) -> float:
        return left + (right - left) * share

    parts = [stroke(left, middle, right, middle, width=1.5, opacity=0.5)]
    for share in (0.0, 0.25, 0.5, 0.75, 1.0):
        parts.append(stroke(at(share), middle - 4.0, at(share), middle + 4.0, opacity=0.5))
        parts.append(text(at(share), middle + 34.0, f"{share:g}", anchor="middle"))
    if result.interval is not None:
        low, high = (at(share) for share in result.interval)
        parts.append(
            f'<rect x="{low:.1f}" y="{middle - 7.0:.1f}" width="{max(high - low, 1.0):.1f}" height="14" '
            f'fill="{COLOUR}" fill-opacity="0.35"/>'
        )
    for share in (result.estimate, result.conservative):
        x = at(share)
        parts.append(
            f'<path d="M{x:.1f} {middle + 9.0:.1f}l-5 9h10z" fill="none" stroke="{SECOND}" stroke-width="1.5"/>'
        )
    if np.isfinite(result.value):
        x = at(result.value)
        parts.append(f'<circle cx="{x:.1f}" cy="{middle:.1f}" r="6" fill="{COLOUR}"/>')
        anchor = "start" if result.value < 0.1 else "end" if result.value > 0.9 else "middle"
        parts.append(text(x, middle - 16.0, f"{result.value:.2f}", anchor=anchor, size=14.0))
    label = f"effective fraction {result.value_text} on a line from 0 to 1, with its interval and both estimates"
    return card(
        f"Effective fraction {result.value_text}",
        f"of the live load, under {result.records.height} motions",
        svg(580.0, 84.0, label, *parts),
        line(f"filled: value and interval; triangles: estimates {RULE} and {SAFE_RULE}"),
        "".join(line(said) for said in result.text.splitlines()[:6]),
        notes=result.remarks,
    )


def result_html(result: Result) -> str:
    """Return a card of a result: the first lines of its text, and the names of its tables and figures."""
    facts = [("tables", ", ".join(result.tables)), ("figures", ", ".join(result.figure_names))]
    return card(type(result).__name__, "", pre(result.text), facts=facts)
