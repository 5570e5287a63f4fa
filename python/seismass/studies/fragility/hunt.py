"""Hunt and fill: each motion under each model is scaled up until the limits are exceeded, then near where they are.

Vamvatsikos and Cornell (2002), Earthquake Eng. Struct. Dyn. 31:491-514; (2004), Earthquake Spectra 20:523-553.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from typing import Any, Final, Literal, NamedTuple, TypeAlias

import numpy as np
import polars as pl

from seismass.base.arguments import ProgressLike
from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_count, as_number, as_positive, refusal
from seismass.studies.fragility.limits import LimitState
from seismass.studies.fragility.run import IndexArray, Setting, solve_runs

CapacityRule: TypeAlias = Literal["first", "last"]
"""Which crossing of a limit is the capacity, where there are several: the lowest intensity or the highest."""


class Crossing(NamedTuple):
    """The capacity of a motion for a limit: interpolated intensity and its bracket (both infinite where the limit is
    not exceeded), and how often the demand rises above the limit along the curve.
    """

    lower: float
    upper: float
    value: float
    crossings: int


def crossing_of(intensities: FloatArray, demand: FloatArray, limit: LimitState, rule: CapacityRule) -> Crossing:
    """Return where a curve crosses a limit, by the first or the last crossing. Intensities increase, from no demand at
    zero; a demand is infinite where the run collapsed.
    """
    exceeds = np.append(False, demand > limit.value)
    rises = np.flatnonzero(exceeds[1:] & ~exceeds[:-1])
    if not len(rises):
        return Crossing(float(intensities[-1]) if len(intensities) else 0.0, np.inf, np.inf, 0)
    k = int(rises[0 if rule == "first" else -1])
    lower, below = (float(intensities[k - 1]), float(demand[k - 1])) if k else (0.0, 0.0)
    upper, above = float(intensities[k]), float(demand[k])
    if np.isfinite(above) and limit.quantity != "collapse":
        value = lower + (limit.value - below) / (above - below) * (upper - lower)
    else:
        value = 0.5 * (lower + upper)
    return Crossing(lower, upper, value, len(rises))


def demand_at(intensities: FloatArray, demand: FloatArray, levels: FloatArray, largest: float) -> FloatArray:
    """Return the demand of a curve at intensities, linear between points. Before a collapse it is infinite from the
    middle on; past the end infinite if the curve ends above `largest` (limit), NaN (unknown) if below.
    """
    points, values = np.append(0.0, intensities), np.append(0.0, demand)
    place = np.searchsorted(points, levels, side="left")
    inside = place < len(points)
    above = np.minimum(place, len(points) - 1)
    below = np.maximum(above - 1, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        weight = np.where(above > below, (levels - points[below]) / (points[above] - points[below]), 1.0)
        interpolated = values[below] + weight * (values[above] - values[below])
    nearer = np.where(weight > 0.5, values[above], values[below])
    finite = np.isfinite(values[below]) & np.isfinite(values[above])
    values_at = np.where(weight == 1.0, values[above], np.where(finite, interpolated, nearer))
    return np.where(inside, values_at, np.inf if values[-1] > largest else np.nan)


def intensity_at(intensities: FloatArray, demand: FloatArray, levels: FloatArray) -> FloatArray:
    """Return the intensity at which a curve first reaches each demand, linear between its points; infinite where it
    does not. Towards a collapse it is the middle of the two points.
    """
    points, values = np.append(0.0, intensities), np.append(0.0, demand)
    reached = np.maximum.accumulate(values)
    k = np.searchsorted(reached, levels, side="left")
    inside = k < len(points)
    above = np.minimum(k, len(points) - 1)
    below = np.maximum(above - 1, 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        weight = (levels - values[below]) / (values[above] - values[below])
    weight = np.where(np.isfinite(values[above]), weight, 0.5)
    intensity = points[below] + np.where(above > below, weight, 0.0) * (points[above] - points[below])
    return np.where(inside, intensity, np.inf)


STEPS_TO_LIMIT: Final = 4.0
"""First step of a hunt that finds its own: so many of them make the capacity that one run of each motion suggests."""
_ROUNDS: Final = 60
"""Most halvings of a bracket."""


@dataclass(frozen=True)
class HuntAndFill:
    """How intensities are chosen.

    Attributes
    ----------
    tolerance : float
        Relative width to which the bracket of a capacity is halved.
    step : float or None
        First intensity. None: a quarter of the capacity that demand proportional to intensity would give, the median
        over motions and models, found by one run of each at the geometric mean of the intensities of the suite as it
        is.
    increment : float or None
        By how much each step of the hunt is longer than the one before; None: half of the first.
    fill : int
        Points put into the largest gaps below the first crossing of a motion, to find narrow crossings that the hunt
        stepped over.
    beyond : float
        The hunt goes on to so many times the largest first crossing of a motion, at least 1: curves may fall again.
    highest : float or None
        Largest intensity; None: only `steps` ends the hunt of a motion that does not exceed the limits.
    steps : int
        Most steps of a hunt; with the defaults the last one reaches some 40 times the capacity that is expected.

    Raises
    ------
    InvalidOption
        An attribute is not what it must be.
    """

    tolerance: float = 1e-3
    step: float | None = None
    increment: float | None = None
    fill: int = 4
    beyond: float = 1.5
    highest: float | None = None
    steps: int = 24

    def __post_init__(self) -> None:
        owner = "hunt and fill"
        if not 1e-14 <= as_number(self.tolerance, "tolerance", owner, InvalidOption) < 1.0:
            raise refusal(InvalidOption, "tolerance", owner, "from 1e-14 to below 1", f"{self.tolerance:g}")
        for name in ("step", "highest"):
            if getattr(self, name) is not None:
                as_positive(getattr(self, name), name, owner, InvalidOption)
        if (
            self.increment is not None
            and not 0.0 <= as_number(self.increment, "increment", owner, InvalidOption) < np.inf
        ):
            raise refusal(InvalidOption, "increment", owner, "zero or positive", f"{self.increment:g}")
        as_count(self.fill, "fill", owner, InvalidOption)
        as_count(self.steps, "steps", owner, InvalidOption, least=1)
        if not 1.0 <= as_number(self.beyond, "beyond", owner, InvalidOption) < np.inf:
            raise refusal(InvalidOption, "beyond", owner, "at least 1", f"{self.beyond:g}")

    def to_dict(self) -> dict[str, Any]:
        """Return the options as plain values."""
        return asdict(self)


class _Curve:
    """Points of one motion under one model."""

    __slots__ = ("at", "demand", "limits", "model", "motion", "rule")

    def __init__(self, model: int, motion: int, limits: list[tuple[LimitState, int]], rule: CapacityRule) -> None:
        self.model, self.motion, self.limits, self.rule = model, motion, limits, rule
        self.at: FloatArray = np.empty(0)
        self.demand: FloatArray = np.empty((0, 0))

    def add(self, intensity: FloatArray, demand: FloatArray) -> None:
        """Add points: intensities, and rows of demands."""
        every = np.append(self.at, intensity)
        rows = np.concatenate([self.demand, demand]) if len(self.at) else demand
        self.at, first = np.unique(every, return_index=True)
        self.demand = rows[first]

    def crossing(self, limit: LimitState, column: int, rule: CapacityRule) -> Crossing:
        """Return where it crosses a limit."""
        return crossing_of(self.at, self.demand[:, column], limit, rule)

    def reached(self) -> float:
        """Return the largest first crossing of all limits; infinite where one is not exceeded."""
        if not len(self.at):
            return np.inf
        return max(self.crossing(limit, column, "first").upper for limit, column in self.limits)

    def is_done(self, options: HuntAndFill) -> bool:
        """Whether the hunt has gone far enough."""
        far = float(self.at[-1]) if len(self.at) else 0.0
        return far >= options.beyond * self.reached() or (options.highest is not None and far >= options.highest)

    def gaps(self, count: int) -> FloatArray:
        """Return so many intensities that halve the largest gaps below the first crossings."""
        uppers = [self.crossing(limit, column, "first").upper for limit, column in self.limits]
        finite = [upper for upper in uppers if np.isfinite(upper)]
        top = max(finite, default=float(self.at[-1]))
        points = np.append(0.0, self.at[self.at <= top])
        added = []
        for _ in range(count):
            k = int(np.argmax(np.diff(points)))
            middle = 0.5 * (points[k] + points[k + 1])
            added.append(middle)
            points = np.insert(points, k + 1, middle)
        return np.array(added)

    def halves(self, tolerance: float) -> FloatArray:
        """Return the middles of the brackets of capacities that are wider than the tolerance."""
        middles = set()
        for limit, column in self.limits:
            crossing = self.crossing(limit, column, self.rule)
            if np.isfinite(crossing.upper) and crossing.upper - crossing.lower > tolerance * crossing.upper:
                middle = 0.5 * (crossing.lower + crossing.upper)
                if crossing.lower < middle < crossing.upper:
                    middles.add(middle)
        return np.array(sorted(middles))


def hunt_and_fill(
    setting: Setting,
    options: HuntAndFill,
    rule: CapacityRule,
    *,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> tuple[pl.DataFrame, dict[str, float]]:
    """Return the runs of all motions under all models, sorted by model, motion and intensity, and the steps of the
    hunt. Every round solves one batch for all that are not done; `rule` is the crossing refined.
    """
    hunt = _Hunt(setting, options, rule, threads, progress)
    step, increment = hunt.steps()
    level = 0.0
    for number in range(options.steps):
        level += step + number * increment
        if options.highest is not None:
            level = min(level, options.highest)
        active = [curve for curve in hunt.curves if not curve.is_done(options)]
        if not active:
            break
        hunt.solve((curve, np.array([level])) for curve in active)
    hunt.solve((curve, curve.gaps(options.fill)) for curve in hunt.curves)
    for _ in range(_ROUNDS):
        wanted = [(curve, curve.halves(options.tolerance)) for curve in hunt.curves]
        if not any(len(points) for _, points in wanted):
            break
        hunt.solve(wanted)
    return hunt.table(), {"step": step, "increment": increment}


class _Hunt:
    """Curves of all motions and models, and the runs that they are made of."""

    def __init__(
        self, setting: Setting, options: HuntAndFill, rule: CapacityRule, threads: int | None, progress: ProgressLike
    ) -> None:
        self._setting, self._options, self._threads, self._progress = setting, options, threads, progress
        self._frames: list[pl.DataFrame] = []
        self._done = 0
        columns = setting.columns
        self.curves = [
            _Curve(model, motion, limits, rule)
            for model, scene in enumerate(setting.models.values())
            if (limits := [(each, columns.index(each.column)) for each in setting.limits if each.applies(scene)])
            for motion in range(len(setting.motions))
        ]
        halvings = len(setting.limits) * max(1.0, -np.log2(STEPS_TO_LIMIT * options.tolerance))
        self._expected = int(len(self.curves) * (1.0 + 2.0 * STEPS_TO_LIMIT + options.fill + halvings))

    def solve(self, wanted: Iterable[tuple[_Curve, FloatArray]]) -> None:
        """Solve points of curves and add them."""
        points_of = [(curve, points) for curve, points in wanted if len(points)]
        if not points_of:
            return
        model, motion = (
            np.concatenate([np.full(len(points), getattr(curve, name)) for curve, points in points_of])
            for name in ("model", "motion")
        )
        intensities = np.concatenate([points for _, points in points_of])
        table = solve_runs(self._setting, model, motion, intensities, threads=self._threads, progress=self._since())
        self._done += len(intensities)
        self._frames.append(table)
        demand = table.select(self._setting.columns).to_numpy().astype(np.float64)
        first = 0
        for curve, points in points_of:
            curve.add(points, demand[first : first + len(points)])
            first += len(points)

    def steps(self) -> tuple[float, float]:
        """Return first step and increment, for which each motion is run once where they are not given."""
        step = self._options.step
        if step is None:
            step = self._expected_capacity() / STEPS_TO_LIMIT
        if self._options.highest is not None:
            step = min(step, self._options.highest)
        return step, 0.5 * step if self._options.increment is None else self._options.increment

    def _expected_capacity(self) -> float:
        pilot = float(np.exp(np.log(self._setting.unit).mean()))
        if self._options.highest is not None:
            pilot = min(pilot, self._options.highest)
        self.solve((curve, np.array([pilot])) for curve in self.curves)
        expected = []
        for curve in self.curves:
            capacities = [
                pilot * limit.value / demand if np.isfinite(demand) else 0.5 * pilot
                for limit, column in curve.limits
                if (demand := float(curve.demand[0, column])) > 0.0 and limit.value > 0.0
            ]
            if capacities:
                expected.append(min(capacities))
        return float(np.median(expected)) if expected else pilot

    def table(self) -> pl.DataFrame:
        """Return all runs, sorted, each once."""
        order = pl.Enum(list(self._setting.models))
        if self._progress is not None:
            self._progress(self._done, self._done)
        return (
            pl.concat(self._frames)
            .unique(("model", "motion", "intensity"), keep="first")
            .sort(pl.col("model").cast(order), "motion", "intensity")
        )

    def _since(self) -> ProgressLike:
        progress, first = self._progress, self._done
        if progress is None:
            return None
        # One run is always left, as how many there will be is not known before the end.
        return lambda done, _: progress(first + done, max(self._expected, first + done + 1))


STEP: Final = 1.2
"""Ratio of neighbouring intensities of the ladder. A demand that rises above the limit and falls below it again between
two of them is not seen."""
START: Final = 0.125
"""Where the ladder begins, over the intensity at which the elastic building with goods that stick reaches the limit."""
HIGHEST: Final = 100.0
"""Where it ends, over the same intensity: a capacity above counts as infinite."""
TOLERANCE: Final = 1e-9
"""To which capacities are found, relative to themselves."""
_TINY: Final = 1e-6
"""Factor of a motion under which nothing yields or slides."""
_EXACT: Final = 1e-12
"""Demands that differ from the limit by less, relative to it, are at it."""
_ROUNDS_EXACT_CAPACITIES: Final = 80

Demand: TypeAlias = Callable[[IndexArray, FloatArray], FloatArray]
"""Demands of runs, given by their numbers, at intensities."""


def exact_capacities(setting: Setting, limit: LimitState, *, threads: int | None = None) -> FloatArray:
    """Return the capacity of every model under every motion, shape (models, motions): the intensity at which the demand
    first exceeds the limit; infinite where none up to `HIGHEST` times that of the elastic building.
    """
    if limit.quantity not in ("drift", "drift_ratio"):
        raise refusal(InvalidOption, "limit", "capacities", "one of drift or drift_ratio", limit.quantity)
    model, motion = (part.ravel() for part in np.indices((len(setting.models), len(setting.motions))))

    def demand(which: IndexArray, intensity: FloatArray) -> FloatArray:
        table = solve_runs(setting, model[which], motion[which], intensity, threads=threads)
        return table[limit.column].to_numpy()

    every = np.arange(len(model))
    tiny = _TINY * setting.unit[motion]
    elastic = tiny * limit.value / demand(every, tiny)
    rung = np.floor(np.log(START * elastic) / np.log(STEP))
    top = np.ceil(np.log(HIGHEST * elastic) / np.log(STEP))
    low, high = np.zeros(len(model)), np.full(len(model), np.inf)
    below, above = np.zeros(len(model)), np.full(len(model), np.inf)
    climbing = every
    while len(climbing):
        intensities = STEP ** rung[climbing]
        demands = demand(climbing, intensities)
        exceeds = demands > limit.value
        low[climbing[~exceeds]], below[climbing[~exceeds]] = intensities[~exceeds], demands[~exceeds]
        high[climbing[exceeds]], above[climbing[exceeds]] = intensities[exceeds], demands[exceeds]
        rung[climbing] += 1.0
        climbing = climbing[~exceeds & (rung[climbing] <= top[climbing])]
    demands = _refined(demand, limit.value, low, high, below, above)
    return demands.reshape(len(setting.models), len(setting.motions))


def _refined(
    demand: Demand, limit: float, low: FloatArray, high: FloatArray, below: FloatArray, above: FloatArray
) -> FloatArray:
    """Crossings between `low` and `high` with demands `below` and `above`, all together by the Illinois variant of
    false position; the bracket is halved at a collapse or where it shrinks slowly, as at a jump.
    """
    # Weights that the Illinois method halves for an end that stays.
    lower, upper = below - limit, above - limit
    value = np.where(np.isfinite(high), 0.5 * (low + high), np.inf)
    last = np.zeros(len(low))
    width = high - low
    active = np.flatnonzero(np.isfinite(high))
    for count in range(_ROUNDS_EXACT_CAPACITIES):
        active = active[high[active] - low[active] > TOLERANCE * high[active]]
        if not len(active):
            break
        a, b, fa, fb = low[active], high[active], lower[active], upper[active]
        with np.errstate(invalid="ignore"):
            secant = a - fa * (b - a) / (fb - fa)
        slow = (count % 2 == 1) & (b - a > 0.5 * width[active])
        trial = np.where(np.isfinite(secant) & ~slow & (secant > a) & (secant < b), secant, 0.5 * (a + b))
        if count % 2 == 1:
            width[active] = b - a
        excess = demand(active, trial) - limit
        exceeds = excess > 0.0
        value[active] = trial
        exceeding, others = active[exceeds], active[~exceeds]
        high[exceeding], upper[exceeding] = trial[exceeds], excess[exceeds]
        low[others], lower[others] = trial[~exceeds], excess[~exceeds]
        lower[exceeding[last[exceeding] == 1.0]] *= 0.5
        upper[others[last[others] == -1.0]] *= 0.5
        last[exceeding], last[others] = 1.0, -1.0
        exact = active[np.abs(excess) <= _EXACT * limit]
        low[exact] = high[exact] = value[exact]
    return value
