"""Plausibility of inputs that are valid but unlikely: remarks in plain sentences, never errors.

A wrong unit is the usual cause. The limits are far outside what buildings and records have; they judge no design.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from seismass.base.units import STANDARD_GRAVITY

if TYPE_CHECKING:
    from seismass.model.block import Block, SlidingBase
    from seismass.model.building import Building
    from seismass.model.rack import Rack

MAX_FRICTION: Final = 1.5
"""Friction coefficient; that of rubber on concrete is about 1."""
MAX_RADIUS: Final = 100.0
"""Effective radius of a friction pendulum (m); its period is then 20 s."""
MAX_HEIGHT: Final = 20.0
"""Storey height (m); heights in ft or mm are above it."""
MAX_STRENGTH: Final = 5.0
"""Yield shear over the weight of the building without blocks."""
MIN_STRENGTH: Final = 1e-4
"""Yield shear over the same weight; that of kN beside kg is a thousandth of what was meant."""
GRAVITY_LOAD_RANGE: Final = (0.01, 100.0)
"""Gravity load of a floor over the weight of its mass, where it is not zero."""
PERIOD_RANGE: Final = (0.01, 10.0)
"""First period (s)."""
PERIODS_BY_HEIGHT: Final = ((0.1, 0.0488, 0.75), (12.0, 0.0724, 0.8))
"""Shortest and longest first period: a factor of C_t h^x of ASCE 7 (Table 12.8-2, from memory) with the height h (m),
of all other structures and of steel frames. A thousandth of the stiffness gives 32 times the period.
"""
LEAST_RECORD: Final = 5.0
"""Duration (s) from which a motion is a record and no pulse of a test."""
MIN_PGA: Final = 0.04
"""Peak ground acceleration of a record as it is used (g); numbers in g that are read as m/s2 are a tenth."""
MAX_DT: Final = 0.1
"""Time step of a record (s); those of networks have 0.02 s at most."""
MAX_PGA: Final = 5.0
"""Peak ground acceleration (g); the largest recorded one is about 4 g."""
MAX_MEAN_PGA: Final = 3.0
"""Mean of the peak ground accelerations of a suite as it is used (g); no site has such a hazard."""
MAX_RATIO_LIMIT: Final = 0.2
"""Limit of a drift over the height in an analysis of fragility or risk."""
MAX_DRIFT_LIMIT: Final = 2.0
"""Limit of a drift (m)."""
MAX_SLIP_LIMIT: Final = 10.0
"""Limit of a slip, or a clearance (m)."""
MAX_ACCELERATION_LIMIT: Final = 5.0
"""Limit of a floor acceleration (g)."""
LIMITS: Final = {
    "drift_ratio": (MAX_RATIO_LIMIT, " of the height", "limits are ratios, not per cent"),
    "residual_drift_ratio": (MAX_RATIO_LIMIT, " of the height", "limits are ratios, not per cent"),
    "drift": (MAX_DRIFT_LIMIT, " m", "is it in m, not mm or per cent?"),
    "residual_drift": (MAX_DRIFT_LIMIT, " m", "is it in m, not mm or per cent?"),
    "slip": (MAX_SLIP_LIMIT, " m", "is it in m, not mm?"),
    "residual_slip": (MAX_SLIP_LIMIT, " m", "is it in m, not mm?"),
    "clearance": (MAX_SLIP_LIMIT, " m", "is it in m, not mm?"),
    "floor_acceleration_g": (MAX_ACCELERATION_LIMIT, " g", "is it in g, not m/s2?"),
}
"""Largest usual limit of each quantity, its unit, and what is doubted above."""


def limit_remarks(limits: Iterable[tuple[str, float]]) -> tuple[str, ...]:
    """Return what is unlikely about limits, pairs of a quantity of `LimitState` and its value; quantities that are not
    in `LIMITS` are left out.
    """
    remarks = []
    for quantity, value in limits:
        most, unit, asked = LIMITS.get(quantity, (np.inf, "", ""))
        if value > most:
            remarks.append(f"the limit of {quantity} is {value:.4g}{unit}, above {most:g}: {asked}")
    return tuple(dict.fromkeys(remarks))


def usage_remarks(scene_remarks: Iterable[str], motions: Any, limits: Iterable[tuple[str, float]] = ()) -> list[str]:
    """Return what is unlikely about a study: remarks of its scenes, of limits, and of motions as they are used the
    first, with a count. No motions are given where they are scaled to many intensities.
    """
    strong = motion_remarks(motions)
    if len(strong) > 1:
        strong = (f"{strong[0]} (and {len(strong) - 1} more motions)",)
    return list(dict.fromkeys([*scene_remarks, *limit_remarks(limits), *strong, *mean_motion_remarks(motions)]))


def model_remarks(
    building: Building | None, blocks: Sequence[Block], racks: Sequence[Rack] = (), base: SlidingBase | None = None
) -> tuple[str, ...]:
    """Return what is unlikely about a building, its blocks, racks and base, a sentence per kind, which names the
    first storey, block or rack concerned and counts the others.
    """
    remarks = [] if building is None else list(_building_remarks(building))
    remarks += _numbered(
        [block.mu_s for block in blocks],
        np.array([block.mu_s for block in blocks]) > MAX_FRICTION,
        "mu_s of block {number} is {value:.4g}, above 1.5{others}: friction coefficients are ratios, not per cent",
    )
    sides = [(block.stop_numbers or ())[:2] for block in blocks]
    clearances = [max(filter(np.isfinite, clearance), default=0.0) for clearance in sides]
    remarks += _numbered(
        clearances,
        np.array(clearances) > MAX_SLIP_LIMIT,
        "the clearance of stops of block {number} is {value:.4g} m, above 10{others}: is it in m, not mm?",
    )
    periods = np.array([np.nan if rack.period is None else rack.period for rack in racks])
    remarks += _numbered(
        periods,
        (periods < PERIOD_RANGE[0]) | (periods > PERIOD_RANGE[1]),
        "the period of rack {number} is {value:.4g} s, not between 0.01 and 10{others}: is it in s?",
    )
    if base is not None and base.mu_s > MAX_FRICTION:
        remarks.append(
            f"mu_s of the base is {base.mu_s:.4g}, above 1.5: friction coefficients are ratios, not per cent"
        )
    if base is not None and base.radius is not None and base.radius > MAX_RADIUS:
        remarks.append(f"the radius of the base is {base.radius:.4g} m, above {MAX_RADIUS:g}: is it in m, not mm?")
    return tuple(remarks)


def _building_remarks(building: Building) -> Iterator[str]:
    period = float(building.periods[0])
    shortest, longest = PERIOD_RANGE
    of_height = ""
    if building.heights is not None:
        height = float(building.heights.sum())
        low, high = (factor * c * height**x for factor, c, x in PERIODS_BY_HEIGHT)
        shortest, longest = max(shortest, low), min(longest, high)
        of_height = f" for {height:.3g} m of height"
    if period > longest:
        yield (
            f"first period is {period:.4g} s, above {longest:.3g} s{of_height}: are stiffnesses in N/m and masses in "
            "kg (kN/m beside kg gives 32 times the period)?"
        )
    elif period < shortest:
        yield (
            f"first period is {period:.4g} s, below {shortest:.2g} s{of_height}: are stiffnesses in N/m and masses "
            "in kg (N/m beside t gives a thirty-second of the period)?"
        )
    if building.heights is not None:
        yield from _numbered(
            building.heights,
            building.heights > MAX_HEIGHT,
            "height of storey {number} is {value:.4g} m, above 20 m{others}: heights are in m",
        )
    strength = building.yield_shear / building.weight
    yield from _numbered(
        strength,
        np.isfinite(strength) & (strength > MAX_STRENGTH),
        "V_y of storey {number} is {value:.4g} of the weight W of the building, above 5{others}: "
        "it hardly yields; are forces in N and masses in kg?",
    )
    yield from _numbered(
        strength,
        strength < MIN_STRENGTH,
        "V_y of storey {number} is {value:.3g} of the weight W of the building, below 0.0001{others}: "
        "forces are in N and masses in kg; kN beside kg give a thousandth",
    )
    if building.gravity_load is not None:
        load = building.gravity_load / (STANDARD_GRAVITY * building.mass)
        low, high = GRAVITY_LOAD_RANGE
        yield from _numbered(
            load,
            (load > 0.0) & ((load < low) | (load > high)),
            "gravity load of floor {number} is {value:.3g} of the weight of its mass{others}: "
            "forces are in N and masses in kg; kN beside kg give a thousandth",
        )


def motion_remarks(motions: Any) -> tuple[str, ...]:
    """Return what is unlikely about ground motions as they are used, scale factors included: a sentence per motion,
    counted from 1 and named where it has a name.
    """
    listed: Iterable[Any] = [motions] if hasattr(motions, "acceleration") else motions
    remarks = []
    for number, motion in enumerate(listed, start=1):
        pga = float(np.abs(motion.acceleration).max()) / STANDARD_GRAVITY
        is_record = len(motion.acceleration) * motion.dt >= LEAST_RECORD
        name = getattr(motion, "name", "")
        called = f"motion {number}, {name}," if name else f"motion {number}"
        if pga > MAX_PGA:
            remarks.append(f"{called} has a PGA of {pga:.4g} g, above {MAX_PGA:g} g: are its accelerations in m/s2?")
        elif is_record and motion.dt > MAX_DT:
            remarks.append(f"{called} has a time step of {motion.dt:g} s, above {MAX_DT:g} s: is it in s?")
        elif is_record and 0.0 < pga < MIN_PGA:
            asked = "are its accelerations in g, and read as m/s2?"
            remarks.append(f"{called} has a PGA of {pga:.4g} g, below {MIN_PGA:g} g: {asked}")
    return tuple(remarks)


def mean_motion_remarks(motions: Any) -> tuple[str, ...]:
    """Return what is unlikely about the mean PGA of a suite, scale factors included: at most one sentence."""
    listed: Iterable[Any] = [motions] if hasattr(motions, "acceleration") else motions
    peaks = [float(np.abs(motion.acceleration).max()) / STANDARD_GRAVITY for motion in listed]
    mean = float(np.mean(peaks)) if peaks else 0.0
    if mean <= MAX_MEAN_PGA:
        return ()
    return (
        f"the mean PGA of the motions is {mean:.4g} g, above {MAX_MEAN_PGA:g} g: are site spectrum and accelerations "
        "in their units?",
    )


def _numbered(values: Any, wrong: Any, sentence: str) -> list[str]:
    """A sentence about the first value that is wrong, with the number of the others."""
    places = np.flatnonzero(wrong)
    if not len(places):
        return []
    others = f" (and {len(places) - 1} more)" if len(places) > 1 else ""
    return [sentence.format(number=places[0] + 1, value=values[places[0]], others=others)]
