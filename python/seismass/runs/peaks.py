"""Peaks of several scenes of one building under all motions, as arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import NDArray

from seismass import _kernel
from seismass.base.arguments import Progress, ProgressLike, as_progress, as_threads, as_word
from seismass.base.errors import InvalidMotion, SimulationError
from seismass.base.statistics import DRIFT_CAP, capped
from seismass.base.values import FloatArray, as_list, refusal
from seismass.model.scene import Scene
from seismass.motions.motion import HasMotion, Motion, as_motion, motion_names
from seismass.motions.records.pair import Pair
from seismass.runs.batch import EngineRuns, solve_engine
from seismass.runs.plane import PlaneMotion, motions_in_plane

DriftMeasure: TypeAlias = Literal["larger", "vector", "x", "y"]
"""What counts as the drift of a storey in two directions: the larger of its peaks in x and in y, the peak length of its
vector, or the peak in one direction."""
LARGER: Final[DriftMeasure] = "larger"


def check_drift(drift: Any, owner: str) -> DriftMeasure:
    """Return a measure of drift in two directions."""
    checked: DriftMeasure = as_word(drift, get_args(DriftMeasure), "drift", owner)
    return checked


_STATUS = _kernel.Batch.status_names()


@dataclass(frozen=True, slots=True)
class NamedMotions:
    """Motions as the kernel takes them with names and events of their records ("motion 3" without a name, empty for an
    unknown event); `others` are those in y of pairs, whose motions in x are `motions`.
    """

    motions: list[Motion]
    names: list[str]
    events: list[str]
    others: list[Motion] | None = None

    def __len__(self) -> int:
        return len(self.motions)

    @property
    def components(self) -> list[Motion]:
        """All motions, those in y after those in x."""
        return [*self.motions, *(self.others or ())]

    @property
    def of_runs(self) -> Sequence[Motion | PlaneMotion]:
        """The motions as runs take them: of pairs both."""
        return self.motions if self.others is None else list(zip(self.motions, self.others, strict=True))

    def direction(self, axis: int) -> NamedMotions:
        """Return the motions of pairs in one direction: 0, in x; 1, in y."""
        return replace(self, motions=self.motions if axis == 0 or self.others is None else self.others, others=None)

    @property
    def cluster_of(self) -> NDArray[np.int64]:
        """Number of the earthquake of each motion, from 0; a motion without a known one has its own number."""
        names = [event or number for number, event in enumerate(self.events)]
        numbers = {name: number for number, name in enumerate(dict.fromkeys(names))}
        return np.array([numbers[name] for name in names])

    @property
    def clusters(self) -> int:
        """Number of different earthquakes."""
        return int(self.cluster_of.max()) + 1


def named_motions(motions: Any, owner: str, scene: Scene | None = None) -> NamedMotions:
    """Return motions given as one, or as a list of Motions or Records; of Pairs for a scene in two directions."""
    several = [motions] if isinstance(motions, Motion | HasMotion | Pair) else motions
    in_plane = scene is not None and scene.engine == "plane"
    kinds = "Pairs, or tuples of two motions" if in_plane else "Motions or Records"
    listed = as_list(several, "motions", owner, InvalidMotion, f"a list of {kinds}")
    if not listed:
        raise refusal(InvalidMotion, "motions", owner, f"at least one of {kinds}" if in_plane else _LEAST, "none")
    others = None
    if in_plane:
        pairs = [motions_in_plane(pair, f"motion {number}", owner) for number, pair in enumerate(listed, start=1)]
        taken, others = [x for x, _ in pairs], [y for _, y in pairs]
    else:
        taken = [as_motion(motion, f"motion {number}", owner) for number, motion in enumerate(listed, start=1)]
    if not any(motion.acceleration.any() for motion in [*taken, *(others or ())]):
        raise refusal(InvalidMotion, "motions", owner, "other than zero somewhere", "zero throughout")
    return NamedMotions(taken, motion_names(listed), [_event(motion) for motion in listed], others)


_LEAST = "at least one Motion or Record"


def _event(motion: Any) -> str:
    """Earthquake of a record or a pair; empty where it is not known, and of a synthetic motion."""
    first = motion.first if isinstance(motion, Pair) else motion[0] if isinstance(motion, tuple) else motion
    return "" if getattr(first, "synthetic", False) else str(getattr(motion, "event", ""))


@dataclass(frozen=True, slots=True)
class Peaks:
    """Peaks of scenes under motions up to a collapse: drift (m, or ratio where heights are known), base shear (N, with
    the share of walls), whether goods slid and the run collapsed; `cap` is the drift cap in the unit of drift.
    """

    drift: FloatArray
    base_shear: FloatArray
    slides: NDArray[np.bool_]
    collapsed: NDArray[np.bool_]
    cap: float

    @property
    def scenes(self) -> int:
        """Number of scenes."""
        return len(self.drift)

    def one(self, index: int) -> Peaks:
        """Return the peaks of one scene; a negative index counts from the last."""
        return self.part(index % self.scenes, 1)

    def part(self, first: int, count: int) -> Peaks:
        """Return the peaks of `count` scenes from `first` on."""
        part = slice(first, first + count)
        return Peaks(self.drift[part], self.base_shear[part], self.slides[part], self.collapsed[part], self.cap)

    @property
    def capped(self) -> FloatArray:
        """Drifts of which a statistic is taken, each at most the cap, shape (scenes, motions, storeys)."""
        return capped(self.drift, self.cap)

    @property
    def largest(self) -> FloatArray:
        """Largest of them over the storeys, shape (scenes, motions)."""
        largest: FloatArray = self.capped.max(axis=2)
        return largest


def solve(
    scenes: Sequence[Scene],
    motions: NamedMotions,
    *,
    drift: DriftMeasure = LARGER,
    drift_cap: float = DRIFT_CAP,
    threads: int | None = None,
    progress: ProgressLike = None,
    keep: list[EngineRuns] | None = None,
) -> Peaks:
    """Solve scenes of equal number of storeys, all of one engine, under all motions; in two directions `drift` says
    which counts, and without goods each is solved alone. Runs that do not end early go to `keep`. No heights, no cap.
    """
    threads, progress = as_threads(threads, "runs"), as_progress(progress, "runs")
    if scenes[0].engine == "plane" and drift != "vector" and not any(scene.goods for scene in scenes):
        return _directions_apart(scenes, motions, drift, drift_cap, threads, progress)
    count, storeys = len(motions), scenes[0].storeys
    rows = np.stack(np.divmod(np.arange(len(scenes) * count), count), axis=1)
    solved = solve_engine(scenes, motions.of_runs, rows, peaks_only=True, threads=threads, progress=progress)
    if keep is not None and scenes[0].engine != "chain":
        keep.append(solved)
    batch, peak_drift, base_shear = solved[0][0], *_of_measure(solved, drift)
    for run, reason in batch.failures:
        name = motions.names[run % count]
        raise SimulationError(f"run under motion {run % count + 1} ({name}) must reach its end; got: {reason}")
    shape = (len(scenes), count)
    collapsed = (batch.status == _STATUS.index("collapsed")).reshape(shape)
    ratio = peak_drift.reshape(*shape, storeys)
    heights = None if scenes[0].building is None else scenes[0].building.heights
    if heights is not None:
        ratio = ratio / heights
    return Peaks(
        drift=ratio,
        base_shear=base_shear.reshape(shape),
        slides=_slides(scenes, batch, count),
        collapsed=collapsed,
        cap=np.inf if heights is None else drift_cap,
    )


def _directions_apart(
    scenes: Sequence[Scene],
    motions: NamedMotions,
    drift: DriftMeasure,
    drift_cap: float,
    threads: int | None,
    progress: ProgressLike,
) -> Peaks:
    """Peaks of scenes in two directions without goods, of one direction or of the larger of both."""
    axes = {"x": (0,), "y": (1,)}.get(drift, (0, 1))
    pairs = [[scene._directions()[axis] for scene in scenes] for axis in axes]
    call = None if progress is None else lambda done, total: progress(done // len(axes), total // len(axes))
    whole = Progress(call, len(axes) * len(scenes) * len(motions), "runs")
    parts = [
        solve(
            of_axis,
            motions.direction(axis),
            drift_cap=drift_cap,
            threads=threads,
            progress=whole.part(len(scenes) * len(motions)),
        )
        for of_axis, axis in zip(pairs, axes, strict=True)
    ]
    if len(parts) == 1:
        return parts[0]
    x, y = parts
    return Peaks(
        drift=np.maximum(x.drift, y.drift),
        base_shear=0.5 * (x.base_shear + y.base_shear),
        slides=x.slides,
        collapsed=x.collapsed | y.collapsed,
        cap=x.cap,
    )


def _of_measure(solved: EngineRuns, measure: DriftMeasure) -> tuple[FloatArray, FloatArray]:
    """Peak drifts and base shears of runs. In two directions the base shear is that of the direction `measure`; of
    "larger" and "vector" the mean of both.
    """
    drifts, shears = [one.peak_drift for one, _ in solved], [_base_shear(*one) for one in solved]
    if len(solved) == 1:
        return drifts[0], shears[0]
    (vector, x, y), (_, of_x, of_y) = drifts, shears
    drift = {"x": x, "y": y, "vector": vector, "larger": np.maximum(x, y)}
    return drift[measure], {"x": of_x, "y": of_y}.get(measure, 0.5 * (of_x + of_y))


def _base_shear(batch: _kernel.Batch, racks: _kernel.RackColumns | None) -> FloatArray:
    """Peak base shear of each run (N): of the chain that of storey 1."""
    if racks is not None:
        return racks.peak_base_shear
    shear = np.zeros(len(batch.storeys))
    solved = batch.storeys > 0
    shear[solved] = batch.peak_storey_shear[(np.cumsum(batch.storeys) - batch.storeys)[solved]]
    return shear


def _slides(scenes: Sequence[Scene], batch: _kernel.Batch, count: int) -> NDArray[np.bool_]:
    """Whether a block that stands on a floor of the building, or on a rack there, slid, by scene and motion."""
    slid = batch.peak_slip > 0.0
    slides = np.zeros((len(scenes), count), dtype=np.bool_)
    first = 0
    for number, scene in enumerate(scenes):
        on_floor = np.array(scene.goods_floor, dtype=np.int64) > 0
        blocks = len(on_floor)
        if blocks:
            flags = slid[first : first + count * blocks].reshape(count, blocks)
            slides[number] = flags[:, on_floor].any(axis=1)
        first += count * blocks
    return slides
