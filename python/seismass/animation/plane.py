"""Animation of a run in two directions: a floor and its goods from above, beside the building from the side."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from seismass.animation.shown import DRAWN_STOREY, FACTORS, LARGEST_SWAY, ROWS_PER_SECOND
from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.values import FloatArray, as_count, brief, content_hash, refusal, same_content
from seismass.base.views import Card, view
from seismass.model.scene import Scene
from seismass.runs.plane_motion import MotionPair, motions_in_plane
from seismass.runs.plane_response import PlaneResponse
from seismass.runs.simulate import simulate

OWNER: Final = "animation"
_SIDE: Final = 6.0
"""Side (m) of the drawn floor: enlarged displacements are at most a part of it."""


@dataclass(frozen=True, eq=False)
class PlaneAnimation(Card):
    """An animation of one scene in two directions under one pair of motions, as `animate_plane` makes it.

    Attributes
    ----------
    title, note : str
        What it is called, and a line below.
    response : PlaneResponse
        The run, with histories of drifts and slips at the rows.
    floor : int
        The floor that is seen from above; 0 is the ground.
    step : float
        Time from row to row (s).
    rows : int
        Rows up to its end, or to a collapse.
    factor : float
        By which displacements are enlarged.
    """

    title: str
    note: str
    response: PlaneResponse
    floor: int
    step: float
    rows: int
    factor: float

    __eq__ = same_content
    __hash__ = content_hash

    @property
    def floor_displacement(self) -> FloatArray:
        """Displacement of each floor over the ground (m), shape (rows, storeys, 2)."""
        return np.cumsum(self.response.drift[: self.rows], axis=1)

    @property
    def heights(self) -> FloatArray:
        """Storey heights as drawn (m)."""
        building = self.response.scene.building
        if building is None or building.heights is None:
            return np.full(self.response.scene.storeys, DRAWN_STOREY)
        return building.heights

    @property
    def sentences(self) -> tuple[str, ...]:
        """What happens, in sentences."""
        peaks = self.response
        parts = []
        if len(peaks.peak_drift):
            storey = int(np.argmax(peaks.peak_drift[:, 2] / self.heights))
            parts.append(f"largest drift {1e3 * peaks.peak_drift[storey, 2]:.3g} mm in storey {storey + 1}")
        if len(peaks.peak_slip):
            block = int(np.argmax(peaks.peak_slip[:, 2]))
            path = f"after a path of {peaks.slip_path[block]:.2f} m"
            parts.append(f"largest slip {1e3 * peaks.peak_slip[block, 2]:.3g} mm of block {block + 1} {path}")
        if peaks.collapsed_storey is not None:
            parts.append(f"storey {peaks.collapsed_storey} collapses at {peaks.end_time:.2f} s")
        return (f"Two directions: {', '.join(parts) or 'nothing moves'}.",)

    @view
    def write(self, path: str | Path, *, frames_per_second: float | None = None, speed: float = 1.0) -> None:
        """Write a GIF (.gif) or a film (.mp4, which needs ffmpeg).

        Parameters
        ----------
        path : path-like
            The file; its suffix decides.
        frames_per_second : float, optional
            Of a GIF (default 12.5, at most 50) or a film (default 25).
        speed : float, default 1
            Time that passes in a second.

        Raises
        ------
        InvalidOption
            Another suffix, or a number that is out of range.
        MissingPackage
            There is no ffmpeg to make a film with.
        OSError
            The file cannot be written.
        """
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"PlaneAnimation({self.title!r}, floor {self.floor}, {(self.rows - 1) * self.step:g} s)"


def animate_plane(
    scene: Scene, motions: MotionPair, *, floor: int | None = None, title: str | None = None, note: str = ""
) -> PlaneAnimation:
    """Solve a scene in two directions and return its animation: a floor from above beside the building from the side.

    Parameters
    ----------
    scene : Scene
        A scene in two directions.
    motions : Pair, or two of Motion or Record
        The ground motions.
    floor : int, optional
        The floor that is seen from above; by default that under the block that slides farthest.
    title, note : str, optional
        What it is called, and a line below; by default the names of scene and pair.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption
        An argument is not what it must be, or the scene has one direction.
    SimulationError
        The run could not be carried to its end.

    Examples
    --------
    >>> import seismass as sm
    >>> crate = sm.Scene(None, [sm.Block(0, mass=100.0, mu=0.1)], other_direction=True)
    >>> pair = (sm.Motion([3.0] * 50, dt=0.02), sm.Motion([2.0] * 50, dt=0.02))
    >>> sm.animation.animate_plane(crate, pair).floor
    0
    """
    if not isinstance(scene, Scene):
        raise refusal(InvalidScene, "scene", OWNER, "a Scene", brief(scene))
    if scene.other_direction is False:
        raise refusal(InvalidScene, "other_direction", "scene", "given (animate takes one direction)", "False")
    both = motions_in_plane(motions, "motions", OWNER)
    every = max(1, round(1.0 / (ROWS_PER_SECOND * both[0].dt)))
    response = simulate(scene, both, histories=every, displacements_only=True, events=False)
    chosen = _floor(response) if floor is None else as_count(floor, "floor", OWNER, InvalidOption)
    if chosen > scene.storeys:
        raise refusal(InvalidOption, "floor", OWNER, f"at most {scene.storeys}", str(chosen))
    moved = np.concatenate([response.drift, response.slip], axis=1)
    rows = max(1, int(np.isfinite(moved).all(axis=(1, 2)).sum()))
    sway = np.cumsum(response.drift[:rows], axis=1)
    largest = max((float(np.abs(each).max()) for each in (sway, response.slip[:rows]) if each.size), default=0.0)
    fitting = [factor for factor in FACTORS if factor * largest <= LARGEST_SWAY * _SIDE]
    source: Any = getattr(motions, "name", "")
    return PlaneAnimation(
        title=scene.name or "Two directions" if title is None else title,
        note=note or ", ".join(part for part in (scene.note, str(source)) if part),
        response=response,
        floor=chosen,
        step=every * both[0].dt,
        rows=rows,
        factor=float(fitting[-1] if fitting else FACTORS[0]),
    )


def _floor(response: PlaneResponse) -> int:
    """The floor under the block that slides farthest; the uppermost without goods."""
    floors = response.scene.block_floor
    if not floors:
        return response.scene.storeys
    return floors[int(np.argmax(response.peak_slip[: len(floors), 2]))]
