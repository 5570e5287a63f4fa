"""Capacities of many models at once: the intensity at which each motion first brings each model to a drift limit.

All models climb the same ladder of intensities, so that their capacities can be compared, and each crossing is then
found on the exact model, not by interpolation.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, TypeAlias

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, refusal
from seismass.fragility.limits import LimitState
from seismass.fragility.run import IndexArray, Setting, solve_runs

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
_ROUNDS: Final = 80

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
        at = STEP ** rung[climbing]
        found = demand(climbing, at)
        exceeds = found > limit.value
        low[climbing[~exceeds]], below[climbing[~exceeds]] = at[~exceeds], found[~exceeds]
        high[climbing[exceeds]], above[climbing[exceeds]] = at[exceeds], found[exceeds]
        rung[climbing] += 1.0
        climbing = climbing[~exceeds & (rung[climbing] <= top[climbing])]
    found = _refined(demand, limit.value, low, high, below, above)
    return found.reshape(len(setting.models), len(setting.motions))


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
    for count in range(_ROUNDS):
        active = active[high[active] - low[active] > TOLERANCE * high[active]]
        if not len(active):
            break
        a, b, fa, fb = low[active], high[active], lower[active], upper[active]
        with np.errstate(invalid="ignore"):
            secant = a - fa * (b - a) / (fb - fa)
        slow = (count % 2 == 1) & (b - a > 0.5 * width[active])
        at = np.where(np.isfinite(secant) & ~slow & (secant > a) & (secant < b), secant, 0.5 * (a + b))
        if count % 2 == 1:
            width[active] = b - a
        found = demand(active, at) - limit
        exceeds = found > 0.0
        value[active] = at
        over, under = active[exceeds], active[~exceeds]
        high[over], upper[over] = at[exceeds], found[exceeds]
        low[under], lower[under] = at[~exceeds], found[~exceeds]
        lower[over[last[over] == 1.0]] *= 0.5
        upper[under[last[under] == -1.0]] *= 0.5
        last[over], last[under] = 1.0, -1.0
        exact = active[np.abs(found) <= _EXACT * limit]
        low[exact] = high[exact] = value[exact]
    return value
