"""What a section of the page is: targets with what was measured, and tables; and how things are timed."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, Literal

import numpy as np

import seismass as sm
from scenes import BenchmarkScene, FloatArray, section4, suite

Verdict = Literal["met", "missed", "not measured"]
PEAK_G: Final = 0.7
"""Peak of the motions outside the study (g)."""
RUNS: Final[dict[str, bool]] = {"events": False, "energy": False}
"""Options of a single run with peaks only."""


@dataclass(frozen=True)
class Target:
    """A bound and what was measured; `value` is None where nothing was, and `note` says why.

    `scatter`: quartiles of the value, where it was measured many times. `later`: added when others had been measured.
    """

    what: str
    value: float | None
    bound: float
    unit: str = ""
    at_most: bool = True
    note: str = ""
    scatter: tuple[float, float] | None = None
    later: bool = False

    @property
    def verdict(self) -> Verdict:
        """Whether the bound holds."""
        if self.value is None:
            return "not measured"
        holds = self.value <= self.bound if self.at_most else self.value >= self.bound
        return "met" if holds else "missed"

    @property
    def within_scatter(self) -> bool:
        """Whether the bound lies between the quartiles: another measurement may decide otherwise."""
        return self.scatter is not None and self.scatter[0] <= self.bound <= self.scatter[1]


@dataclass(frozen=True)
class Section:
    """A section of the page: its targets, its text in Markdown, and numbers for the figures."""

    title: str
    targets: Sequence[Target]
    text: str
    data: dict[str, Any] = field(default_factory=dict)


def table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table in Markdown."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def median_time(work: Callable[[], Any], seconds: float, least: int = 3) -> float:
    """Return the median wall time of repeats that take so many seconds in all, after one that does not count (s)."""
    return alternating([work], seconds, least)[0]


def alternating(works: Sequence[Callable[[], Any]], seconds: float, least: int = 3) -> list[float]:
    """Return the median wall time of each work (s), taking turns."""
    return [statistics.median(spent) for spent in turns(works, seconds, least)]


def turns(works: Sequence[Callable[[], Any]], seconds: float, least: int = 3) -> list[list[float]]:
    """Return the wall times of each work (s); they take turns, so that what disturbs one disturbs all."""
    times: list[list[float]] = [[] for _ in works]
    for work in works:
        work()
    began = time.perf_counter()
    while len(times[0]) < least or time.perf_counter() - began < seconds:
        for work, spent in zip(works, times, strict=True):
            before = time.perf_counter()
            work()
            spent.append(time.perf_counter() - before)
    return times


@dataclass(frozen=True)
class Repeated:
    """Median and quartiles of what was measured many times."""

    median: float
    quartiles: tuple[float, float]


def repeated(values: Sequence[float] | FloatArray) -> Repeated:
    """Return median and quartiles; of a ratio they are taken over the ratios of the turns."""
    low, middle, high = np.percentile(values, (25.0, 50.0, 75.0)).tolist()
    return Repeated(middle, (low, high))


def strong_motions() -> list[tuple[str, sm.Motion]]:
    """Return two motions scaled to `PEAK_G`: Brawley and El Centro where the recordings are at hand."""
    motions = list(suite())
    chosen = [record for record in motions if any(word in record.name for word in ("BRA", "ELC"))] or motions[2:4]
    return [(record.name, record.scaled(PEAK_G / record.pga_g).motion) for record in chosen[:2]]


def four_storeys(motion: sm.Motion, name: str) -> BenchmarkScene:
    """Return a building of four storeys with a block of the floor's mass on each floor."""
    building = sm.Building.uniform(4, 0.57, yield_shear_over_weight=[0.24, 0.21, 0.16, 0.09], damping=0.05)
    scene = sm.Scene(building, sm.blocks_on_floors([1.0] * 4, mu=0.3))
    return BenchmarkScene("four-storeys", "4 storeys with blocks", scene, motion, name)


def section4_scenes() -> list[BenchmarkScene]:
    """Return the building of section 4 with both second slopes under each strong motion."""
    return [
        BenchmarkScene(f"section4-{slope:g}-{place}", f"section 4, r2 = {slope:g}", section4(slope), motion, name)
        for slope in (0.05, 0.5)
        for place, (name, motion) in enumerate(strong_motions())
    ]


def exponent(sizes: Sequence[float], times: Sequence[float]) -> float:
    """Return the slope of the straight line through the points in log-log."""
    return float(np.polyfit(np.log(sizes), np.log(times), 1)[0])
