"""The motion under which a building is shown: of those under which goods slide the one with the median drift."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.base.values import FloatArray
from seismass.effective_mass.runs import named_motions, solve
from seismass.model.scene import Scene


class Shown(NamedTuple):
    """What is shown of a building.

    Attributes
    ----------
    scene : Scene
        The building with its goods.
    motion : Record or Pair
        The motion, scaled.
    number : int
        Its number in the suite, from 1.
    factor : float
        By which it is scaled.
    """

    scene: Scene
    motion: Any
    number: int
    factor: float


def motion_of_runs(runs: pl.DataFrame) -> int:
    """Return the number (from 0) of the motion of median drift among those under which goods slide without a collapse,
    or among all where there are none, by the first model of the table of runs.
    """
    of = runs.filter(pl.col("model") == runs["model"][0])
    by_motion = of.group_by("motion", maintain_order=True).agg(
        pl.col("collapsed").any(), pl.col("peak_drift").max(), slides=(pl.col("peak_slip") > 0.0).any()
    )
    drift = np.where(by_motion["collapsed"].to_numpy(), np.inf, by_motion["peak_drift"].to_numpy())
    slides = by_motion["slides"].fill_null(value=False).to_numpy() & np.isfinite(drift)
    return _median(drift, np.flatnonzero(slides) if slides.any() else np.arange(len(drift)))


def _median(drift: FloatArray, among: NDArray[np.int64]) -> int:
    """Place of the median drift among some."""
    ordered = among[np.argsort(drift[among], kind="stable")]
    return int(ordered[(len(ordered) - 1) // 2])


def shown_motion(scene: Scene, scaled: list[Any], factors: FloatArray) -> Shown:
    """Return a motion for the scene of a building: the median by largest drift of those under which goods slide.

    Where none slide it is the median of all. `factors` are those by which the motions are scaled already.
    """
    peaks = solve([scene], named_motions(scaled, "animation", scene))
    among = np.flatnonzero(peaks.slides[0]) if peaks.slides.any() else np.arange(len(scaled))
    place = _median(peaks.largest[0], among)
    return Shown(scene, scaled[place], place + 1, float(factors[place]))
