"""Cards of values and results in notebooks."""

from __future__ import annotations

import numbers
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import polars as pl

from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, brief, counted
from seismass.base.views import Card
from seismass.effective_mass.rule import RULE
from seismass.media.result import COLOUR, SECOND, Result, card, curve, history, line, pre, rows, stroke, svg, text
from seismass.media.text_table import column_texts
from seismass.model.scene import floor_name, goods_names, spring_names
from seismass.motions.records.rotd import drift_remarks
from seismass.show.assessment.text import storey_bars
from seismass.show.response_text import base_line

if TYPE_CHECKING:
    from seismass.assessment.result import Assessment
    from seismass.effective_mass.result import EffectiveMass
    from seismass.model.block import Block
    from seismass.model.building import Building
    from seismass.model.scene import Scene
    from seismass.motions.records.record import Record
    from seismass.motions.records.suite import Suite
    from seismass.motions.spectra import TargetSpectrum
    from seismass.runs.response import Response


MOST_BARS: Final = 16
"""Most lines of the drifts of an assessment."""
MOST_ROWS: Final = 12
"""Most storeys that are listed, from the ground."""


def assessment_html(result: Assessment) -> str:
    """Return a card of an assessment."""
    answer = result.answer
    pair = [line(f"{number}  {words}") for number, words in enumerate(answer.pair, start=1)]
    pair = [line(answer.opening), *pair, *map(line, answer.goods[1:])] if pair else []
    facts = [("tables", ", ".join(result.tables)), ("figures", ", ".join(result.figure_names))]
    lines = [answer.why and f"why: {answer.why}", answer.motions and f"motions: {answer.motions}"]
    return card(
        result.name or "Assessment",
        answer.headline,
        *pair,
        pre("\n".join(storey_bars(result)), most=MOST_BARS),
        facts=facts,
        notes=[*(sentence for sentence in lines if sentence), *result.remarks],
    )


BUILDING_WIDTH: Final = 420.0
BAY: Final = 150.0
"""Width of the building (px)."""
LEFT: Final = 40.0


def building_html(building: Building) -> str:
    """Return a card of a building."""
    return card("Building", _building_words(building), building_sketch(building, ()), facts=_facts(building))


def scene_html(scene: Scene) -> str:
    """Return a card of a scene: its building, its blocks, and what is unlikely about them."""
    building = scene.building
    words = "on the ground alone" if building is None else _building_words(building)
    blocks = counted(len(scene.blocks), "block") if scene.blocks else "no blocks"
    return card(
        scene.name or "Scene",
        f"{words}, {blocks}",
        building_sketch(building, scene.blocks),
        _blocks(scene),
        facts=() if building is None else _facts(building),
        notes=([scene.note] if scene.note else []) + list(scene.remarks),
    )


def building_sketch(building: Building | None, blocks: tuple[Block, ...]) -> str:
    """Return storeys by their heights, and goods whose areas are as their mass over that of their floor."""
    storeys = 0 if building is None else building.storeys
    heights = np.ones(storeys) if building is None or building.heights is None else building.heights
    tall = float(min(max(46.0 * storeys, 60.0), 300.0))
    up = np.append(0.0, np.cumsum(heights)) / (heights.sum() if storeys else 1.0)
    head = 34.0 if any(block.floor == storeys for block in blocks) else 12.0
    levels = tall * (1.0 - up) + head if storeys else np.array([head])
    parts = [stroke(LEFT - 25.0, levels[0], LEFT + BAY + 25.0, levels[0], width=2.5)]
    for storey in range(storeys):
        bottom, top = levels[storey], levels[storey + 1]
        parts += [stroke(x, bottom, x, top, width=1.6) for x in (LEFT + 6.0, LEFT + BAY - 6.0)]
        parts.append(stroke(LEFT, top, LEFT + BAY, top, width=min(4.0, 0.25 * (bottom - top))))
    if building is not None and storeys <= MOST_ROWS:
        parts += _labels(building, levels)
    parts += _goods(building, blocks, levels)
    words = "ground" if building is None else counted(storeys, "storey")
    return svg(
        BUILDING_WIDTH, levels[0] + 6.0, f"{words} with {counted(len(blocks), 'block')}" if blocks else words, *parts
    )


def _labels(building: Building, levels: FloatArray) -> list[str]:
    """What stands beside each storey: its height and its strength over the weight."""
    parts = []
    strength = building.yield_shear / building.weight
    for storey in range(building.storeys):
        middle = 0.5 * (levels[storey] + levels[storey + 1]) + 4.0
        words = [] if building.heights is None else [f"{building.heights[storey]:.3g} m"]
        words.append("elastic" if np.isinf(strength[storey]) else f"V_y/W = {strength[storey]:.3g}")
        parts.append(text(LEFT + BAY + 32.0, middle, ", ".join(words)))
        parts.append(text(LEFT - 8.0, levels[storey + 1] + 4.0, str(storey + 1), anchor="end"))
    return parts


def _goods(building: Building | None, blocks: tuple[Block, ...], levels: FloatArray) -> list[str]:
    parts = []
    for floor in sorted({block.floor for block in blocks}):
        here = [block for block in blocks if block.floor == floor]
        above = levels[floor] - levels[floor + 1] if floor + 1 < len(levels) else 46.0
        most = min((BAY - 30.0) / len(here) - 4.0, 60.0)
        for place, block in enumerate(here):
            side = np.sqrt(min(_ratio(building, block), 3.0) / 3.0)
            width, height = max(most * side, 3.0), max(min(0.62 * above, 30.0) * side, 2.0)
            x = LEFT + BAY * (place + 1) / (len(here) + 1) - 0.5 * width
            parts.append(
                f'<rect x="{x:.1f}" y="{levels[floor] - height - 2.0:.1f}" width="{width:.1f}" height="{height:.1f}" '
                f'fill="{COLOUR}" fill-opacity="0.55" stroke="{COLOUR}"/>'
            )
    return parts


def _ratio(building: Building | None, block: Block) -> float:
    """Mass of a block over that of its floor; 1 on the ground."""
    if block.mass_ratio is not None:
        return block.mass_ratio
    if building is None or block.floor == 0 or block.mass is None:
        return 1.0
    return float(block.mass / building.mass[block.floor - 1])


def _blocks(scene: Scene) -> str:
    if not scene.blocks:
        return ""
    body = []
    for number, block in enumerate(scene.blocks[:MOST_ROWS], start=1):
        mass = f"{block.mass:g} kg" if block.mass is not None else f"{block.mass_ratio:g} of the floor's"
        friction = f"{block.mu_s:g}" if block.mu_s == block.mu_k else f"{block.mu_s:g}, kinetic {block.mu_k:g}"
        body.append((f"block {number}", str(block.floor) if block.floor else "ground", mass, friction))
    if len(scene.blocks) > MOST_ROWS:
        body.append((f"and {len(scene.blocks) - MOST_ROWS} more", "", "", ""))
    return rows(("", "floor", "mass", "friction"), body)


def _building_words(building: Building) -> str:
    return f"{counted(building.storeys, 'storey')}, T1 = {building.periods[0]:.4g} s"


def _facts(building: Building) -> list[tuple[str, str]]:
    facts = []
    if building.mass_is_stated:
        facts.append(("mass", f"{1e-3 * building.mass.sum():.4g} t"))
    for symbol, values in building.spring_summary().items():
        if not np.isinf(values).all():
            facts.append((symbol, _span(values)))
    if np.isinf(building.yield_shear).all() and not building.laws:
        facts = [fact for fact in facts if fact[0] == "mass"] + [("springs", "elastic")]
    facts += [("springs", law) for law in building.laws]
    damping = building.damping
    facts.append(("damping", f"{100.0 * damping:g} %" if isinstance(damping, float) else type(damping).__name__))
    if building.gravity_load is not None or building.geometric_stiffness is not None:
        facts.append(("P-Delta", "yes"))
    return facts


def _span(values: FloatArray) -> str:
    """One number, or the least and the largest."""
    low, high = float(values.min()), float(values.max())
    return f"{low:.3g}" if low == high else f"{low:.3g} to {high:.3g}"


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
        mark = left + share * (right - left)
        parts += [stroke(mark, bottom, mark, bottom + 3.0, opacity=0.5)]
        parts.append(text(mark, bottom + 15.0, f"{share * longest:.3g}", anchor="middle"))
    parts.append(text(right + 8.0, bottom + 15.0, "s"))
    parts.append(text(left - 6.0, bottom + 4.0, "0", anchor="end"))
    parts.append(text(left - 6.0, top + 4.0, f"{highest:.3g} g", anchor="end"))
    label = f"pseudo-acceleration up to {highest:.3g} g, from {target.shortest:g} to {longest:g} s"
    facts = [(f"Sa({period:g} s)", f"{target([period])[0] / STANDARD_GRAVITY:.3g} g") for period in _within(target)]
    return card("Target spectrum", target.label, svg(470.0, 150.0, label, *parts, curve(x, y, width=1.8)), facts=facts)


def _within(target: TargetSpectrum) -> list[float]:
    """Periods that are named (s)."""
    return [period for period in (0.2, 0.5, 1.0, 2.0) if target.shortest <= period <= target.longest]


WIDTH: Final = 600
RECORD_HEIGHT: Final = 110


def record_html(record: Record) -> str:
    """Return HTML with its style in place: no scripts, nothing from elsewhere, text of the record escaped."""
    title = " ".join(part for part in (record.name or "(unnamed record)", "(synthetic)" * record.synthetic) if part)
    words = [record.event, record.station, record.component]
    if record.azimuth is not None:
        words.append(f"azimuth {record.azimuth:g}\N{DEGREE SIGN}")
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
    return card(title, ", ".join(part for part in words if part), _sketch(record), size, facts=measures, notes=notes)


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


HEIGHT: Final = 90.0


def response_html(response: Response) -> str:
    """Return a card of a response: the history that drifts or slips most, where it has any, and peaks."""
    scene = response.scene
    fell = response.collapsed_storey
    where = "" if fell is None else f" in {spring_names(scene)[fell - 1]}"
    ended = f"{response.status}{where} at {response.end_time:g} s"
    motion = response.record.name if response.record is not None else repr(response.motion)
    words = ", ".join(part for part in (scene.name, motion) if part)
    facts = [(name, str(count)) for name, count in response.counts.items() if count]
    base = line(base_line(scene, response)) if scene.base is not None else ""
    tables = (_storeys(response), base, _racks(response), _blocks_results(response))
    return card(f"Response, {ended}", words, _largest(response), *tables, facts=facts)


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
    unit_words = [] if ratio is None else ["over height"]
    left_out = line(f"the {MOST_ROWS} that drift most of {len(drift)}") if len(drift) > MOST_ROWS else ""
    return rows(("", "peak drift", *unit_words, "residual", "acceleration above"), body) + left_out


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


def _blocks_results(response: Response) -> str:
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
    x = at(result.by_hand.estimate)
    parts.append(f'<path d="M{x:.1f} {middle + 9.0:.1f}l-5 9h10z" fill="none" stroke="{SECOND}" stroke-width="1.5"/>')
    if np.isfinite(result.value):
        x = at(result.value)
        parts.append(f'<circle cx="{x:.1f}" cy="{middle:.1f}" r="6" fill="{COLOUR}"/>')
        anchor = "start" if result.value < 0.1 else "end" if result.value > 0.9 else "middle"
        parts.append(text(x, middle - 16.0, f"{result.value:.2f}", anchor=anchor, size=14.0))
    label = f"effective fraction {result.value_text} on a line from 0 to 1, with its interval and the rule by hand"
    return card(
        f"Effective fraction {result.value_text}",
        f"of the live load, under {result.records.height} motions",
        svg(580.0, 84.0, label, *parts),
        line(f"filled: value and interval; triangle: {RULE}, by hand"),
        "".join(line(row) for row in result.text.splitlines()[:6]),
        notes=result.remarks,
    )


def result_html(result: Result) -> str:
    """Return a card of a result: the first lines of its text, and the names of its tables and figures."""
    facts = [("tables", ", ".join(result.tables)), ("figures", ", ".join(result.figure_names))]
    return card(type(result).__name__, "", pre(result.text), facts=facts)


MOST_COLUMNS: Final = 8
"""Most columns, likewise."""
MOST_VALUES: Final = 6
"""Longest list whose numbers are shown one by one."""
MOST_LETTERS: Final = 300
"""Most letters of what a value says of itself."""
LONGEST_TEXT: Final = 60
"""Longest text of a fact."""


def value_html(value: Any) -> str:
    """Return a card of a value."""
    kind = type(value)
    title, words = kind.__name__, _name_of(value)
    if isinstance(getattr(kind, "text", None), property):
        return card(title, words, pre(value.text, more=f"print(the {kind.__name__}.text)"))
    if callable(getattr(kind, "axes", None)):
        body = [(axis.name, str(axis.length), str(axis.each)) for axis in value.axes()]
        size = f"{len(value):,} scenes" if isinstance(value, Sequence) or hasattr(kind, "__len__") else ""
        return card(title, size, rows(("axis", "values", "numbers each"), body))
    table = getattr(value, "table", None)
    shown = table if isinstance(table, pl.DataFrame) else table() if callable(table) else None
    facts, notes = _facts_values(value, with_lists=shown is None)
    # A one-line repr says more than the fields, where it is not a list of them.
    listed = is_dataclass(value) and (shown is not None or len(facts) > 1)
    content = "" if listed else line(repr(value)[:MOST_LETTERS])
    facts = facts if is_dataclass(value) else []
    return card(title, words, content, "" if shown is None else frame_html(shown), facts=facts, notes=notes)


def frame_html(frame: pl.DataFrame) -> str:
    """Return the first rows of a table, numbers of a column with the same decimals, and how large it is."""
    names, columns = frame.columns[:MOST_COLUMNS], []
    for name in names:
        values = frame[name].head(MOST_ROWS).to_list()
        if frame[name].dtype.is_float():
            columns.append(column_texts(values, digits=4))
        else:
            columns.append(["" if one is None else _fact(one)[:LONGEST_TEXT] for one in values])
    whole = frame.height <= MOST_ROWS and frame.width <= MOST_COLUMNS
    size = f"of {counted(frame.height, 'row')} and {counted(frame.width, 'column')}"
    return rows(names, list(zip(*columns, strict=True))) + ("" if whole else line(size))


def _name_of(value: Any) -> str:
    texts = [getattr(value, name, "") for name in ("name", "label")]
    return next((text[:LONGEST_TEXT] for text in texts if isinstance(text, str) and text), "")


def _items(value: Any) -> Iterator[tuple[str, Any]]:
    """What the value is made of, by name."""
    if is_dataclass(value):
        for each in fields(value):
            if not each.name.startswith("_") and each.name not in ("name", "label", "table"):
                yield each.name, getattr(value, each.name)


def _facts_values(value: Any, *, with_lists: bool) -> tuple[list[tuple[str, str]], list[str]]:
    """Names with their values, and the remarks; lists and tables where a table does not show them."""
    facts, notes = [], []
    for name, item in _items(value):
        if name in ("remarks", "notes", "assumptions") and isinstance(item, tuple):
            notes += [str(one) for one in item]
        elif not _is_nothing(item) and (with_lists or not isinstance(item, np.ndarray | pl.DataFrame | tuple | list)):
            facts.append((name, _fact(item)))
    return facts, notes


def _is_nothing(item: Any) -> bool:
    """Whether a value is empty."""
    return item is None or (isinstance(item, str | tuple | list) and not any(item))


def _fact(item: Any) -> str:
    """A value in a few words."""
    if isinstance(item, bool | np.bool_):
        return "yes" if item else "no"
    if isinstance(item, numbers.Integral):
        return str(int(item))
    if isinstance(item, numbers.Real):
        return f"{float(item):.4g}"
    if isinstance(item, str):
        return item if len(item) <= LONGEST_TEXT else item[: LONGEST_TEXT - 3] + "..."
    if isinstance(item, Path):
        return _fact(item.name)
    if isinstance(item, np.ndarray):
        return _array(item)
    if isinstance(item, pl.DataFrame):
        return f"table of {counted(item.height, 'row')}"
    if is_dataclass(item) or isinstance(item, Card):
        return type(item).__name__
    if isinstance(item, Mapping):
        return f"{counted(len(item), 'entry', 'entries')}: {', '.join(map(str, item))}"[:LONGEST_TEXT]
    if isinstance(item, tuple | list):
        if item and len(item) <= MOST_VALUES and all(isinstance(one, numbers.Real) for one in item):
            return ", ".join(f"{float(one):.4g}" for one in item)
        if item and len(item) <= MOST_VALUES and all(isinstance(one, str) for one in item):
            return _fact(", ".join(item))
        return f"{len(item)} {type(item[0]).__name__}" if item else "none"
    return brief(item)


def _array(item: FloatArray) -> str:
    """Numbers of an array: each of them where they are few, else their range."""
    if item.dtype.kind not in "fiu":
        return f"{item.size} values"
    if item.ndim <= 1 and item.size <= MOST_VALUES:
        return ", ".join(column_texts([float(one) for one in np.atleast_1d(item)], digits=4)) or "none"
    shape = " by ".join(map(str, item.shape))
    known = item[np.isfinite(item)]
    ends = f", {known.min():.4g} to {known.max():.4g}" if known.size else ""
    return f"{shape} values{ends}"
