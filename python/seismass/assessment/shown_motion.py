"""The motion under which a building is shown: of those under which goods slide the one with the median drift."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.assessment.own_building import OwnBuilding
from seismass.base.values import FloatArray
from seismass.effective_mass.runs import named_motions, solve
from seismass.model.scene import Scene
from seismass.records import Pairs, Suite
from seismass.scaling import scale_asce7_10
from seismass.spectra import TargetSpectrum


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


def shown_motion(building: OwnBuilding, suite: Suite | Pairs, target: TargetSpectrum | None = None) -> Shown:
    """Return the building with its goods and the motion of median largest drift among those under which goods slide, or
    among all where none slide. Motions are scaled as in `assess`.
    """
    spectrum = building.site_spectrum(target)
    period = building.scaling_period or building.period(building.goods)
    factors = scale_asce7_10(suite, spectrum, period, between=False).factors
    listed: list[Any] = list(suite)
    scaled = [record.scaled(float(factor)) for record, factor in zip(listed, factors, strict=True)]
    scene = building.scene(spectrum)
    peaks = solve([scene], named_motions(scaled, "animation", scene))
    among = np.flatnonzero(peaks.slides[0]) if peaks.slides.any() else np.arange(len(scaled))
    place = _median(peaks.largest[0], among)
    return Shown(scene, scaled[place], place + 1, float(factors[place]))
