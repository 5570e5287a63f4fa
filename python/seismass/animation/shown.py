"""What an animation shows: both runs at the rows that it draws, and the scale and layout that its drawings share."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.media.roles import SLIDE
from seismass.model.motion import Motion
from seismass.model.places import rack_levels, spring_names
from seismass.model.scene import Scene
from seismass.runs.response import Response
from seismass.runs.simulate import simulate

ROWS_PER_SECOND: Final = 30.0
"""Rows that are kept of a second; a player draws between them."""
MOST_VALUES: Final = 100_000
"""Most values that are kept of a run: 0.2 MB. A long motion of a tall building has fewer rows a second."""
DRAWN_STOREY: Final = 3.0
"""Height (m) of storeys as drawn where heights are not known."""
GROUND_HEIGHT: Final = 1.2
"""Height (m) of the picture of blocks on the ground alone."""
FACTORS: Final = (1, 2, 3, 5, 7, 10, 15, 20, 30, 50, 70, 100, 150, 200, 300, 500, 700, 1000)
"""By which displacements may be enlarged."""
LARGEST_SWAY: Final = 0.15
"""Largest displacement of a floor or block as drawn, over the height of the building."""
LARGEST_SLIDE: Final = 0.4
"""The same of blocks on the ground alone, over the height of their picture."""


@dataclass(frozen=True, eq=False)
class Run:
    """One of the buildings that are shown.

    Attributes
    ----------
    label : str
        What it is.
    attached : float or None
        Share of the goods that is attached to the floors as mass; None: goods slide.
    response : Response
        The run, with its true peaks, events, and histories of drifts and slips at the rows.
    rows : int
        Rows up to its end; fewer than those of the animation after a collapse.
    """

    label: str
    attached: float | None
    response: Response
    rows: int

    @property
    def what(self) -> str:
        """What becomes of its goods, where the label does not say it; empty where there are none."""
        if self.attached is not None:
            return f"{100.0 * self.attached:g} % of the goods attached"
        return SLIDE.name if self.response.scene.goods and self.label != SLIDE.name else ""

    @property
    def floor_displacement(self) -> FloatArray:
        """Displacement of each floor over the ground (m), shape (rows, storeys)."""
        return np.cumsum(self.response.drift[: self.rows], axis=1)

    @property
    def level_drift(self) -> FloatArray:
        """Drift of the levels of all racks (m), rack by rack, shape (rows, levels)."""
        racks = [drift[: self.rows] for drift in self.response.rack_drift]
        return np.hstack(racks) if racks else np.zeros((self.rows, 0))

    @property
    def rack_displacement(self) -> FloatArray:
        """Displacement of each level of each rack over the ground (m), shape (rows, levels)."""
        floors = np.hstack([np.zeros((self.rows, 1)), self.floor_displacement])
        moved = [
            floors[:, [rack.floor]] + np.cumsum(drift[: self.rows], axis=1)
            for rack, drift in zip(self.response.scene.racks, self.response.rack_drift, strict=True)
        ]
        return np.hstack(moved) if moved else np.zeros((self.rows, 0))


@dataclass(frozen=True, eq=False)
class Shown:
    """Both runs with what their drawings share.

    Attributes
    ----------
    runs : tuple of Run
        The building with goods that slide, and the model of the code where there is one.
    step : float
        Time from row to row (s).
    rows : int
        Number of rows.
    ground_low, ground_high : ndarray, shape (rows,)
        Range of the ground acceleration around each row (g).
    heights : ndarray, shape (storeys,)
        Storey heights as drawn (m).
    factor : float
        By which displacements are enlarged as a rule.
    storey : int
        Index of the storey whose drifts are compared: the one that drifts most.
    """

    runs: tuple[Run, ...]
    step: float
    rows: int
    ground_low: FloatArray
    ground_high: FloatArray
    heights: FloatArray
    factor: float
    storey: int

    @property
    def sentences(self) -> tuple[str, ...]:
        """What happens, a sentence for each run."""
        return tuple(self._sentence(run) for run in self.runs)

    def _sentence(self, run: Run) -> str:
        response = run.response
        name = f"{run.label[:1].upper()}{run.label[1:]}" + (f" ({run.what})" if run.what else "")
        parts = []
        if len(response.peak_drift):
            storey = int(np.argmax(response.peak_drift / self.heights))
            parts.append(f"largest drift {1e3 * response.peak_drift[storey]:.3g} mm in storey {storey + 1}")
        if response.peak_rack_drift:
            names, drifts = rack_levels(response.scene), np.concatenate(response.peak_rack_drift)
            rack, level = names[int(np.argmax(drifts))]
            parts.append(f"largest rack drift {1e3 * drifts.max():.3g} mm in level {level} of rack {rack}")
        if len(response.peak_slip):
            block = int(np.argmax(response.peak_slip))
            parts.append(f"largest slip {1e3 * response.peak_slip[block]:.3g} mm of block {block + 1}")
        fastest = float(response.peak_contact_velocity.max(initial=0.0))
        if fastest > 0.0:
            parts.append(f"stops hit at up to {fastest:.3g} m/s")
        if response.collapsed_storey is not None:
            parts.append(f"storey {response.collapsed_storey} collapses at {response.end_time:.2f} s")
        return f"{name}: {', '.join(parts) or 'nothing moves'}."


def shown(scenes: list[tuple[str, float | None, Scene]], motion: Motion) -> Shown:
    """Solve scenes under one motion and return what an animation shows of them; the first is the real building."""
    values = max(len(spring_names(scene)) + len(scene.goods) for _, _, scene in scenes) or 1
    every = max(1, round(1.0 / (ROWS_PER_SECOND * motion.dt)), math.ceil(motion.samples * values / MOST_VALUES))
    runs = []
    for label, attached, scene in scenes:
        response = simulate(scene, motion, histories=every, displacements_only=True)
        # Rows after a collapse are NaN.
        moved = np.hstack([response.drift, response.slip, *response.rack_drift])
        rows = int(np.isfinite(moved).all(axis=1).sum())
        runs.append(Run(label, attached, response, max(rows, 1)))
    real, building = runs[0].response, scenes[0][2].building
    rows = len(real.drift)
    heights = np.full(scenes[0][2].storeys, DRAWN_STOREY)
    if building is not None and building.heights is not None:
        heights = np.array(building.heights)
    low, high = _ranges(motion.acceleration / STANDARD_GRAVITY, every, rows)
    ratio = real.peak_drift / heights
    storey = int(np.argmax(ratio)) if len(ratio) else 0
    room = LARGEST_SWAY * float(heights.sum()) if len(heights) else LARGEST_SLIDE * GROUND_HEIGHT
    factor = _factor(runs, room)
    return Shown(tuple(runs), every * motion.dt, rows, low, high, heights, factor, storey)


def _ranges(values: FloatArray, every: int, rows: int) -> tuple[FloatArray, FloatArray]:
    """Smallest and largest value from each row to the next, both included."""
    padded = np.pad(values, (0, max(0, rows * every + 1 - len(values))), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, every + 1)[: rows * every : every]
    return windows.min(axis=1), windows.max(axis=1)


def _factor(runs: list[Run], room: float) -> float:
    """The largest factor with which no floor, level or block goes farther than there is room in the picture (m)."""
    largest = 0.0
    for run in runs:
        for moved in (run.floor_displacement, run.rack_displacement, run.response.slip[: run.rows]):
            if moved.size:
                largest = max(largest, float(np.abs(moved).max()))
    if largest == 0.0:
        return 1.0
    fitting = [factor for factor in FACTORS if factor * largest <= room]
    return float(fitting[-1] if fitting else FACTORS[0])
