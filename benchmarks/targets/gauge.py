"""How busy the machine was besides: the same run, timed between the sections."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Final

import numpy as np

import seismass as sm
from targets.base import RUNS, Section, median_time, section4_scenes, table

SECONDS: Final = 0.3
TEXT: Final = """\
The load of the machine during the measurements: the same run ({scene}, {motion}, peaks only), timed for {seconds:g} s
before the first section and after each. Where it takes much longer than its fastest time, other processes have affected
the times of the sections on both sides.

{table}"""


class Gauge:
    """Times the same run whenever it is read."""

    def __init__(self) -> None:
        """Choose the run."""
        self._bench = section4_scenes()[0]
        self._times: list[float] = []

    def read(self) -> None:
        """Time it."""
        work = partial(sm.simulate, self._bench.scene, self._bench.motion, **RUNS)
        self._times.append(median_time(work, SECONDS))

    def section(self, titles: Sequence[str]) -> Section:
        """Return what was read, the first time before the sections of these titles and then after each."""
        times = np.array(self._times)
        places = ["before", *(f"after: {title}" for title in titles)]
        rows = [
            [place, f"{1e6 * time:.0f}", f"{time / times.min():.2f}"] for place, time in zip(places, times, strict=True)
        ]
        text = TEXT.format(
            scene=self._bench.title,
            motion=self._bench.motion_name.replace("_", r"\_"),
            seconds=SECONDS,
            table=table(("", "us", "over the fastest"), rows),
        )
        return Section("How busy the machine was", [], text)
