"""Hunt and fill: each motion under each model is scaled up until the limits are exceeded, then near where they are.

Vamvatsikos and Cornell (2002), Earthquake Eng. Struct. Dyn. 31:491-514; (2004), Earthquake Spectra 20:523-553.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any, Final

import numpy as np
import polars as pl

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_count, as_number, as_positive, refusal
from seismass.fragility.limits import LimitState
from seismass.fragility.run import Progress, Setting, solve_runs
from seismass.fragility.trace import CapacityRule, Crossing, crossing_of

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

    def add(self, at: FloatArray, demand: FloatArray) -> None:
        """Add points: intensities, and rows of demands."""
        every = np.append(self.at, at)
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
            found = self.crossing(limit, column, self.rule)
            if np.isfinite(found.upper) and found.upper - found.lower > tolerance * found.upper:
                middle = 0.5 * (found.lower + found.upper)
                if found.lower < middle < found.upper:
                    middles.add(middle)
        return np.array(sorted(middles))


def hunt_and_fill(
    setting: Setting,
    options: HuntAndFill,
    rule: CapacityRule,
    *,
    threads: int | None = None,
    progress: Progress | None = None,
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
        self, setting: Setting, options: HuntAndFill, rule: CapacityRule, threads: int | None, progress: Progress | None
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
        chosen = [(curve, points) for curve, points in wanted if len(points)]
        if not chosen:
            return
        model, motion = (
            np.concatenate([np.full(len(points), getattr(curve, name)) for curve, points in chosen])
            for name in ("model", "motion")
        )
        at = np.concatenate([points for _, points in chosen])
        table = solve_runs(self._setting, model, motion, at, threads=self._threads, progress=self._since())
        self._done += len(at)
        self._frames.append(table)
        demand = table.select(self._setting.columns).to_numpy().astype(np.float64)
        first = 0
        for curve, points in chosen:
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
            found = [
                pilot * limit.value / demand if np.isfinite(demand) else 0.5 * pilot
                for limit, column in curve.limits
                if (demand := float(curve.demand[0, column])) > 0.0 and limit.value > 0.0
            ]
            if found:
                expected.append(min(found))
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

    def _since(self) -> Progress | None:
        progress, first = self._progress, self._done
        if progress is None:
            return None
        # One run is always left, as how many there will be is not known before the end.
        return lambda done, _: progress(first + done, max(self._expected, first + done + 1))
