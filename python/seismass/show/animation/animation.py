"""`animate` and what it returns."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from seismass.base.arguments import as_share
from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FieldValue, FloatArray, as_count, as_number, brief, refusal
from seismass.base.views import Card, view
from seismass.effective_mass.models import attached_scene
from seismass.media.roles import SLIDE
from seismass.model.codes import Use, code_fraction
from seismass.model.scene import Scene, rack_levels, spring_names
from seismass.motions.motion import Motion, MotionLike, as_motion
from seismass.runs.plane import MotionPair, PlaneResponse, motions_in_plane
from seismass.runs.response import Response
from seismass.runs.simulate import simulate

if TYPE_CHECKING:
    from markupsafe import Markup


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
STRONG, BEFORE = 0.1, 1.0
"""Share of the peak of the ground acceleration from which it is strong, and how long before (s) an animation begins."""


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
    def base_slip(self) -> FloatArray:
        """Slip of the sliding base (m), zero without one, shape (rows,)."""
        return np.zeros(self.rows) if self.response.scene.base is None else self.response.base_slip[: self.rows]

    @property
    def floor_displacement(self) -> FloatArray:
        """Displacement of each floor over the ground (m), shape (rows, storeys)."""
        return self.base_slip[:, None] + np.cumsum(self.response.drift[: self.rows], axis=1)

    @property
    def level_drift(self) -> FloatArray:
        """Drift of the levels of all racks (m), rack by rack, shape (rows, levels)."""
        racks = [drift[: self.rows] for drift in self.response.rack_drift]
        return np.hstack(racks) if racks else np.zeros((self.rows, 0))

    @property
    def rack_displacement(self) -> FloatArray:
        """Displacement of each level of each rack over the ground (m), shape (rows, levels)."""
        floors = np.column_stack([self.base_slip, self.floor_displacement])
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
    played : tuple of float
        First and last time that are played (s).
    """

    runs: tuple[Run, ...]
    step: float
    rows: int
    ground_low: FloatArray
    ground_high: FloatArray
    heights: FloatArray
    factor: float
    storey: int
    played: tuple[float, float]

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
        if response.scene.base is not None:
            parts.append(f"the slab slides by up to {1e3 * response.peak_base_slip:.3g} mm on the ground")
        fastest = float(response.peak_contact_velocity.max(initial=0.0))
        if fastest > 0.0:
            parts.append(f"stops hit at up to {fastest:.3g} m/s")
        if response.collapsed_storey is not None:
            parts.append(f"storey {response.collapsed_storey} collapses at {response.end_time:.2f} s")
        return f"{name}: {', '.join(parts) or 'nothing moves'}."


def seconds_played(start: float | None, end: float | None, ground: FloatArray, step: float) -> tuple[float, float]:
    """Return the first and the last time that are played (s) of the size of a ground acceleration."""
    last = step * (len(ground) - 1)
    before = max(0.0, step * float(np.argmax(ground >= STRONG * ground.max())) - BEFORE)
    stop = last if end is None else min(as_number(end, "end", OWNER, InvalidOption), last)
    shortly = before if before < stop else 0.0
    first = shortly if start is None else as_number(start, "start", OWNER, InvalidOption)
    if not 0.0 <= first < max(stop, 1e-9):
        raise refusal(InvalidOption, "start", OWNER, "from 0 and before its end", f"{first:g} to {stop:g} s")
    return first, stop


def shown(
    scenes: list[tuple[str, float | None, Scene]], motion: Motion, start: float | None = None, end: float | None = None
) -> Shown:
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
    sliding, building = runs[0].response, scenes[0][2].building
    rows = len(sliding.drift)
    heights = np.full(scenes[0][2].storeys, DRAWN_STOREY)
    if building is not None and building.heights is not None:
        heights = np.array(building.heights)
    low, high = _ranges(motion.acceleration / STANDARD_GRAVITY, every, rows)
    ratio = sliding.peak_drift / heights
    storey = int(np.argmax(ratio)) if len(ratio) else 0
    room = LARGEST_SWAY * float(heights.sum()) if len(heights) else LARGEST_SLIDE * GROUND_HEIGHT
    factor = _factor(runs, room)
    played = seconds_played(start, end, np.maximum(-low, high), every * motion.dt)
    return Shown(tuple(runs), every * motion.dt, rows, low, high, heights, factor, storey, played)


def _ranges(values: FloatArray, every: int, rows: int) -> tuple[FloatArray, FloatArray]:
    """Smallest and largest value from each row to the next, both included."""
    padded = np.pad(values, (0, max(0, rows * every + 1 - len(values))), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, every + 1)[: rows * every : every]
    return windows.min(axis=1), windows.max(axis=1)


def _factor(runs: list[Run], room: float) -> float:
    """The largest factor with which no floor, level or block goes farther than there is room in the picture (m)."""
    largest = 0.0
    for run in runs:
        for moved in (run.base_slip, run.floor_displacement, run.rack_displacement, run.response.slip[: run.rows]):
            if moved.size:
                largest = max(largest, float(np.abs(moved).max()))
    if largest == 0.0:
        return 1.0
    fitting = [factor for factor in FACTORS if factor * largest <= room]
    return float(fitting[-1] if fitting else FACTORS[0])


DEFAULT_CODE: Final = "asce7-10"
"""Code whose share of the live load is attached where none is chosen."""


@dataclass(frozen=True, eq=False)
class Animation(FieldValue):
    """An animation of one scene under one motion, as `animate` makes it.

    Attributes
    ----------
    title, note : str
        What it is called, and a line below.
    scene : Scene
        The real building.
    shown : Shown
        What is drawn.
    """

    title: str
    note: str
    scene: Scene
    shown: Shown

    @property
    def response(self) -> Response:
        """The run of the real building."""
        return self.shown.runs[0].response

    @property
    def sentences(self) -> tuple[str, ...]:
        """What happens, a sentence for each run."""
        return self.shown.sentences

    @view
    def fragment(self) -> Markup:
        """Return a part of a page, with its style and script; any number of them may be in one page.

        Its style applies to it alone, and its script to the element that the script stands in. `page_html` of
        `seismass.media.page` names the script in the policy of the page.
        """
        raise NotImplementedError

    @view
    def html(self) -> str:
        """Return a page that needs no other file: play, pause, scrub, speed, and the same by keys."""
        raise NotImplementedError

    @view
    def write(self, path: str | Path, *, frames_per_second: float | None = None, speed: float = 1.0) -> None:
        """Write a page (.html), a GIF (.gif) or a film (.mp4, which needs ffmpeg).

        Parameters
        ----------
        path : path-like
            The file; its suffix decides.
        frames_per_second : float, optional
            Of a GIF (default 12.5, at most 50) or a film (default 25). A page draws as often as its screen.
        speed : float, default 1
            Time that passes in a GIF or film in a second.

        Raises
        ------
        InvalidOption
            Another suffix, or numbers that are out of range or have no meaning for a page.
        MissingPackage
            There is no ffmpeg to make a film with.
        OSError
            The file cannot be written.
        """
        raise NotImplementedError

    @view
    def _repr_html_(self) -> str:
        """A frame of its own, so that a notebook's style and script and those of the page do not meet."""
        raise NotImplementedError

    def __repr__(self) -> str:
        runs = " and ".join(run.label for run in self.shown.runs)
        seconds = (self.shown.rows - 1) * self.shown.step
        return f"Animation({self.title!r}, {runs}, {seconds:g} s, {self.shown.rows} rows)"


def _label(scene: Scene) -> str:
    """What the run of the scene itself is called."""
    if scene.building is None:
        place = "ground" if scene.base is None else "slab"
        return f"{'racks' if scene.racks else 'blocks'} on the {place}"
    return SLIDE.name if scene.goods else "no goods"


def animate(
    scene: Scene,
    motion: MotionLike,
    *,
    code: str = DEFAULT_CODE,
    use: Use = "storage",
    fraction: float | None = None,
    code_name: str = "",
    title: str | None = None,
    note: str | None = None,
    start: float | None = None,
    end: float | None = None,
) -> Animation:
    """Solve a scene, and the model of a code beside it, and return their animation.

    The model has a share of the goods attached to the floors as mass and nothing that slides; stiffness, strength,
    damping and gravity load are those of the real building (`attached_scene`); racks are lumped on their floors. A
    scene without goods on a floor is shown alone.

    Parameters
    ----------
    scene : Scene
        Building and blocks, or blocks on the ground.
    motion : Motion or Record
        Ground motion.
    code : str, default "asce7-10"
        Code whose share of the live load the model has, as `code_fraction` takes it.
    use : {"storage", "ordinary", "archive", "shop", "garage"}, default "storage"
        Use of the floors, for the code.
    fraction : float, optional
        A share in place of the code's, from 0 to 1. Blocks are taken as the whole live load.
    code_name : str, optional
        What the code of that share is called.
    title, note : str, optional
        What it is called, and a line below; by default the names of scene and record.
    start, end : float, optional
        Times between which it plays (s); by default from 1 s before the ground shakes strongly, to the end.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption
        An argument is not what it must be.
    SimulationError
        A run could not be carried to its end.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(2, 0.4, yield_shear_over_weight=[0.3, 0.2])
    >>> scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0], mu=0.2))
    >>> animation = sm.animate(scene, sm.builtin_record("synthetic-1"), fraction=0.25)
    >>> len(animation.html()) < 150_000
    True
    """
    if not isinstance(scene, Scene):
        raise refusal(InvalidScene, "scene", "animation", "a Scene", brief(scene))
    motion_shown = as_motion(motion, "motion", "animation")
    scenes: list[tuple[str, float | None, Scene]] = [(_label(scene), None, scene)]
    if any(floor > 0 for floor in (*scene.block_floor, *(rack.floor for rack in scene.racks if rack.blocks))):
        if fraction is None:
            row = code_fraction(code, use)
            share, label = row.fraction, f"{row.code} model"
        else:
            share, label = as_share(fraction, "fraction", "animation"), f"{code_name} model".lstrip()
        scenes.append((label, share, attached_scene(scene, share)))
    source: Any = getattr(motion, "name", "")
    return Animation(
        title=title if title is not None else scene.name or "Animation of a building",
        note=note if note is not None else ", ".join(part for part in (scene.note, str(source)) if part),
        scene=scene,
        shown=shown(scenes, motion_shown, start, end),
    )


def animation_of(
    response: Response,
    *,
    code: str = DEFAULT_CODE,
    use: Use = "storage",
    fraction: float | None = None,
    title: str | None = None,
) -> Animation:
    """Return the animation of a run, with the name of its record; see `Response.animate`."""
    name = "" if response.record is None else response.record.name
    note = ", ".join(part for part in (response.scene.note, name) if part)
    return animate(response.scene, response.motion, code=code, use=use, fraction=fraction, title=title, note=note)


OWNER: Final = "animation"
_SIDE: Final = 6.0
"""Side (m) of the drawn floor: enlarged displacements are at most a part of it."""


@dataclass(frozen=True, eq=False)
class PlaneAnimation(FieldValue, Card):
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
    played : tuple of float
        First and last time that are played (s).
    """

    title: str
    note: str
    response: PlaneResponse
    floor: int
    step: float
    rows: int
    factor: float
    played: tuple[float, float]

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
    scene: Scene,
    motions: MotionPair,
    *,
    floor: int | None = None,
    title: str | None = None,
    note: str = "",
    start: float | None = None,
    end: float | None = None,
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
    start, end : float, optional
        Times between which it plays (s), as of `animate`.

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
    level = _floor(response) if floor is None else as_count(floor, "floor", OWNER, InvalidOption)
    if level > scene.storeys:
        raise refusal(InvalidOption, "floor", OWNER, f"at most {scene.storeys}", str(level))
    moved = np.concatenate([response.drift, response.slip], axis=1)
    rows = max(1, int(np.isfinite(moved).all(axis=(1, 2)).sum()))
    sway = np.cumsum(response.drift[:rows], axis=1)
    largest = max((float(np.abs(each).max()) for each in (sway, response.slip[:rows]) if each.size), default=0.0)
    fitting = [factor for factor in FACTORS if factor * largest <= LARGEST_SWAY * _SIDE]
    source: Any = getattr(motions, "name", "")
    ground = np.hypot(*(motion.acceleration for motion in both))
    return PlaneAnimation(
        title=scene.name or "Two directions" if title is None else title,
        note=note or ", ".join(part for part in (scene.note, str(source)) if part),
        response=response,
        floor=level,
        step=every * both[0].dt,
        rows=rows,
        factor=float(fitting[-1] if fitting else FACTORS[0]),
        played=seconds_played(start, end, ground[: every * rows : every], every * both[0].dt),
    )


def _floor(response: PlaneResponse) -> int:
    """The floor under the block that slides farthest; the uppermost without goods."""
    floors = response.scene.block_floor
    if not floors:
        return response.scene.storeys
    return floors[int(np.argmax(response.peak_slip[: len(floors), 2]))]


@dataclass(frozen=True)
class Good:
    """Goods as drawn: rack (from 1; 0 is the building) and level (0 is the ground), size over the largest (square root
    of the masses), whether they are attached, and clearances of stops towards minus and plus (m).
    """

    rack: int
    level: int
    size: float
    fixed: bool
    stops: tuple[float, float] | None


def standing_goods(scene: Scene) -> tuple[Good, ...]:
    """Return all goods: those that may slide in the order of results, and fixed ones among those of their rack."""
    goods = []
    for block, mass in zip(scene.blocks, scene.block_mass.tolist(), strict=True):
        stops = None if block.stops is None else block.stops.clearance
        goods.append((0, block.floor, mass, False, stops))
    for number, rack in enumerate(scene.racks, start=1):
        for good, mass in zip(rack.blocks, rack.masses(scene.building), strict=True):
            stops = None if good.fixed or good.block.stops is None else good.block.stops.clearance
            goods.append((number, good.level, mass, good.fixed, stops))
    largest = max((mass for _, _, mass, _, _ in goods), default=1.0)
    return tuple(
        Good(rack, level, float(np.sqrt(mass / largest)), fixed, stops) for rack, level, mass, fixed, stops in goods
    )
