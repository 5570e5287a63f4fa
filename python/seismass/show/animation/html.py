"""An animation as HTML: the data as 16-bit numbers in base64, a style for one element, and a script of its own."""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Iterable
from html import escape
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from markupsafe import Markup
from numpy.typing import ArrayLike, NDArray

from seismass.base.values import FloatArray, counted
from seismass.media.page import page_html, templates
from seismass.model.scene import Scene
from seismass.runs.response import EVENT_KINDS
from seismass.show.animation.animation import Good, Run, standing_goods

if TYPE_CHECKING:
    from seismass.show.animation.animation import Animation

SPEEDS: Final = (0.1, 0.25, 0.5, 1.0, 2.0, 4.0)
"""Choices of speed."""
FACTORS: Final = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0)
"""Choices by which displacements are enlarged, beside the one that fits."""


def page(animation: Animation) -> str:
    """Return a page with one animation, which plays when it is opened unless the reader prefers less motion."""
    lead = [_element(animation, autoplay=True)]
    return page_html(animation.title, [], subtitle=animation.note, description=description(animation), lead=lead)


def fragment(animation: Animation) -> Markup:
    """Return the animation as a figure that waits to be played."""
    return _element(animation, autoplay=False)


def _element(animation: Animation, *, autoplay: bool) -> Markup:
    return element_html(element_content(animation), autoplay=autoplay)


def element_content(animation: Animation) -> dict[str, Any]:
    """Return all that the element shows, as values that JSON has: what is drawn, and the words around it."""
    shown, scene = animation.shown, animation.scene
    return {
        "data": _data(animation),
        "alt": description(animation),
        "caption": caption(animation),
        "blocks": bool(scene.goods),
        "racks": bool(scene.racks),
        "walls": _has_walls(scene),
        "fixed": any(block.fixed for rack in scene.racks for block in rack.blocks),
        "stops": any(block.stops is not None for block in scene.goods),
        "building": bool(scene.storeys),
        "attached": any(run.attached for run in shown.runs),
        "factor": shown.factor,
        "last": (shown.rows - 1) * shown.step,
        "step": shown.step,
        **({"base": True} if scene.base is not None else {}),
    }


def element_html(
    content: dict[str, Any],
    *,
    autoplay: bool = False,
    speeds: Iterable[float] = SPEEDS,
    factors: Iterable[tuple[float, str]] | None = None,
) -> Markup:
    """Return the element of what `element_content` gives; without data (None) it waits for them, by its `show`. Of
    `factors` that enlarge displacements 0 is that of the data; default round ones and the content's.
    """
    times = "\N{MULTIPLICATION SIGN}"
    choices = factors or [(factor, f"{factor:g} {times}") for factor in sorted({content["factor"], *FACTORS})]
    flags = dict.fromkeys(("racks", "base", "walls", "fixed", "stops"), False) | content
    data = json.dumps(content["data"], separators=(",", ":")).replace("<", "\\u003c")
    html: str = (
        templates()
        .get_template("animation.html.jinja")
        .render(
            **{name: value for name, value in flags.items() if name != "data"},
            identifier="animation-" + hashlib.sha256(data.encode()).hexdigest()[:10],
            data=Markup(data),
            autoplay=autoplay,
            speeds=[(speed, f"{speed:g} {times}") for speed in speeds],
            factors=list(choices),
        )
    )
    return Markup(html)


def description(animation: Animation) -> str:
    """Return what happens in words, for screen readers."""
    return " ".join(animation.shown.sentences)


def caption(animation: Animation) -> str:
    """Return the peaks, and how true the picture is."""
    shown = animation.shown
    building = animation.scene.building
    drawn = "" if building is None or building.heights is not None else " Storeys are drawn 3 m high."
    return (
        f"{description(animation)} Peaks are those of the exact run; what is drawn has {counted(shown.rows, 'row')} "
        f"{1e3 * shown.step:g} ms apart, as 16-bit numbers, and ground acceleration as its range between rows. "
        f"Displacements are over the ground.{drawn}"
    )


def _data(animation: Animation) -> dict[str, Any]:
    shown, scene = animation.shown, animation.scene
    peak = float(max(abs(shown.ground_low).max(), abs(shown.ground_high).max()))
    known = scene.building is not None and scene.building.heights is not None
    goods = standing_goods(scene)
    return {
        "step": shown.step,
        "rows": shown.rows,
        "played": [round(time, 3) for time in shown.played],
        "heights": [round(float(height), 4) for height in shown.heights],
        "known": known,
        "factor": shown.factor,
        "storey": shown.storey,
        "walls": _has_walls(scene),
        "kinds": list(EVENT_KINDS),
        "ground": {"peak": peak, "low": _packed(shown.ground_low, peak), "high": _packed(shown.ground_high, peak)},
        "blocks": [_block(good) for good in goods if not good.fixed],
        "racks": [
            {
                "floor": rack.floor,
                "levels": rack.levels,
                "fixed": [
                    {"level": good.level, "size": round(good.size, 3)}
                    for good in goods
                    if good.fixed and good.rack == number
                ],
            }
            for number, rack in enumerate(scene.racks, start=1)
        ],
        "runs": [_run(run, shown.step) for run in shown.runs],
    }


def _has_walls(scene: Scene) -> bool:
    return scene.building is not None and scene.building.stiffness_matrix is not None


def _block(good: Good) -> dict[str, Any]:
    """A block that may slide: where it stands, how large it is drawn, and its stops where it has some."""
    place = {"rack": good.rack, "level": good.level} if good.rack else {"floor": good.level}
    stops = {} if good.stops is None else {"stops": [None if np.isinf(side) else side for side in good.stops]}
    return {**place, "size": round(good.size, 3), **stops}


def _run(run: Run, step: float) -> dict[str, Any]:
    response = run.response
    drift, slip = response.drift[: run.rows], response.slip[: run.rows]
    levels, base = run.level_drift, run.base_slip
    peaks = [float(abs(moved).max()) if moved.size else 0.0 for moved in (drift, slip, levels, base)]
    of_base = {"base": {"peak": peaks[3], "values": _packed(base, peaks[3])}} if response.scene.base is not None else {}
    return {
        "label": run.label,
        "what": run.what,
        "attached": run.attached,
        "rows": run.rows,
        "collapsed": response.collapsed_storey,
        "end": response.end_time,
        "drift": {"peak": peaks[0], "values": _packed(drift, peaks[0])},
        "slip": {"peak": peaks[1], "values": _packed(slip, peaks[1])},
        "racks": {"peak": peaks[2], "values": _packed(levels, peaks[2])},
        **of_base,
        "events": _events(run, step),
    }


def _events(run: Run, step: float) -> dict[str, str]:
    """Events by the row at which they are drawn; of equal ones in one row the last is kept. Those of a sliding base
    have the number 0, by which the script takes them for those of all blocks, and are left out.
    """
    log = run.response.event_log
    log = log[(log["number"] > 0) | ~np.isin(log["kind"], ("slip", "stick", "reverse"))]
    row = np.minimum(np.ceil(log["time"] / step), run.rows - 1).astype(np.uint32)
    kind = np.array([EVENT_KINDS.index(name) for name in log["kind"]], dtype=np.uint8)
    number = log["number"].astype(np.uint16)
    backwards = np.rec.fromarrays([part[::-1] for part in (row, kind, number)])
    rows = np.sort(len(log) - 1 - np.unique(backwards, return_index=True)[1]) if len(log) else np.arange(0)
    return {"row": _base64(row[rows], "<u4"), "kind": _base64(kind[rows], "u1"), "number": _base64(number[rows], "<u2")}


def _packed(values: FloatArray, peak: float) -> str:
    """Values over their peak as 16-bit integers."""
    return _base64(np.rint(values * (32767.0 / peak)) if peak > 0.0 else np.zeros(values.shape), "<i2")


def _base64(values: ArrayLike, dtype: str) -> str:
    array: NDArray[Any] = np.ascontiguousarray(values).astype(dtype)
    return base64.b64encode(array.tobytes()).decode()


def frame(animation: Animation) -> str:
    """Return the page in a frame of its own, for a notebook."""
    return (
        f'<iframe srcdoc="{escape(page(animation))}" sandbox="allow-scripts" title="{escape(animation.title)}" '
        'style="width:100%;height:56rem;border:0"></iframe>'
    )
