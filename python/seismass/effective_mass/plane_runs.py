"""Peaks in two directions: of the vector, of one direction, or of the larger of both."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from seismass import _kernel
from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, brief, is_one_of, refusal
from seismass.model.motion import Motion
from seismass.model.scene import Scene

DriftMeasure: TypeAlias = Literal["larger", "vector", "x", "y"]
"""What counts as the drift of a storey in two directions: the larger of its peaks in x and in y, the peak length of its
vector, or the peak in one direction."""
LARGER: Final[DriftMeasure] = "larger"

Progress: TypeAlias = Callable[[int, int], object]
"""Called with (runs done, runs in all)."""
Solved: TypeAlias = tuple[_kernel.Batch, FloatArray, FloatArray]
"""A batch whose lists of blocks and whose ends hold for all directions, peak drifts and peak base shears (runs,)."""


def check_drift(drift: Any, owner: str) -> DriftMeasure:
    """Return a measure of drift in two directions."""
    if not is_one_of(drift, get_args(DriftMeasure)):
        raise refusal(InvalidOption, "drift", owner, "larger, vector, x or y", brief(drift))
    checked: DriftMeasure = drift
    return checked


def solve_plane(
    scenes: Sequence[Scene],
    pairs: tuple[Sequence[Motion], Sequence[Motion]],
    runs: NDArray[np.int64],
    measure: DriftMeasure,
    threads: int | None,
    progress: Progress | None,
) -> Solved:
    """Solve scenes in two directions, with friction on the circle; `runs` has rows of scene and motion. The base shear
    is that of the direction `measure`; of "larger" and "vector" the mean of both.
    """
    (vector, _), (x, of_x), (y, of_y) = _kernel.simulate_many_plane(
        [scene._plane for scene in scenes if scene._plane is not None],
        [motion._kernel for motion in pairs[0]],
        [motion.acceleration for motion in pairs[1]],
        runs,
        threads=threads,
        progress=progress,
    )
    shear = {"x": of_x.peak_base_shear, "y": of_y.peak_base_shear}
    both = 0.5 * (of_x.peak_base_shear + of_y.peak_base_shear)
    drift = {"x": x.peak_drift, "y": y.peak_drift, "vector": vector.peak_drift}
    drift["larger"] = np.maximum(x.peak_drift, y.peak_drift)
    return vector, drift[measure], shear.get(measure, both)


def are_uncoupled(scenes: Sequence[Scene], measure: DriftMeasure) -> bool:
    """Whether each direction can be solved by itself: no goods couple them, and no drift is of the vector."""
    return measure != "vector" and not any(scene.goods for scene in scenes)


def in_directions(scenes: Sequence[Scene]) -> tuple[list[Scene], list[Scene]]:
    """Return scenes in two directions as those in x and those in y."""
    both = [scene._directions() for scene in scenes]
    return [x for x, _ in both], [y for _, y in both]
