"""The effective fraction by hand, in one line, and how rules are compared with runs.

    lambda = 1.35 mu/C1 - 0.15, from 0 to 1,     C1 = S_a/R_y^(2/3),     R_y = S_a W_g/V_y, at least 1.

mu is the mean of the static and the kinetic friction coefficient of the goods, since goods that are held do not slide;
S_a (in g) is the spectral acceleration at the first period of the building without goods, W_g the weight of the
building with all goods on its floors, V_y the yield shear of storey 1. An elastic building has R_y = 1. 0.10 stands in
place of 0.15 where the overstrength is below 1.5 or there is no second slope, where the second slope is above 0.1, and
where a floor carries goods of more than twice its mass.

C1 is the geometric mean of S_a (once) and V_y/W_g (twice) where the building yields: what a floor feels
grows beyond V_y with S_a. 1.35 and 0.15 are rounded, and were fitted on the FEMA P-695 far-field recordings and the
built-in forty; docs/effective_mass.md judges them on other motions.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any, Final, TypeAlias

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.statistics import quantile
from seismass.base.units import STANDARD_GRAVITY, UNITS, Units
from seismass.base.values import FloatArray
from seismass.effective_mass.models import building_of, frame_mass, friction, full_weight, goods_mass
from seismass.model.building import Building
from seismass.model.scene import Scene
from seismass.motions.spectra import TargetSpectrum, mean_spectrum
from seismass.runs.peaks import LARGER, DriftMeasure, NamedMotions

SLOPE: Final = 1.35
"""Factor of mu/C1."""
OFFSET: Final = 0.15
"""What is taken off in an ordinary building."""
SMALL_OFFSET: Final = 0.10
"""What is taken off where `exceptions` names a reason."""
POWER: Final = 2.0 / 3.0
"""Power of R_y in C1."""
LEAST_OVERSTRENGTH: Final = 1.5
LARGEST_SECOND_SLOPE: Final = 0.1
LARGEST_LOAD: Final = 2.0
"""Goods over the mass of their floor."""

RULE: Final = f"{SLOPE:g} mu/C1 - {OFFSET:.2f}"
"""The rule, as texts and tables name it."""
RULE_IN_WORDS: Final = (
    "mu the mean of static and kinetic friction; C1 = S_a/R_y^(2/3), R_y = S_a W_g/V_y, at least 1; S_a in g at the "
    "period without goods, W_g with all goods on the floors, V_y of storey 1; "
    f"- {SMALL_OFFSET:.2f} with Omega below {LEAST_OVERSTRENGTH:g}, without a second slope, with r2 above "
    f"{LARGEST_SECOND_SLOPE:g} or goods above {LARGEST_LOAD:g} times their floor"
)
"""What its letters stand for."""


def yield_reduction(spectral_acceleration_g: ArrayLike, yield_coefficient: ArrayLike) -> FloatArray:
    """Return R_y = S_a W_g/V_y, at least 1; `yield_coefficient` is V_y/W_g, infinite where a building is elastic."""
    reduction: FloatArray = np.maximum(np.asarray(spectral_acceleration_g) / np.asarray(yield_coefficient), 1.0)
    return reduction


def floor_coefficient(spectral_acceleration_g: ArrayLike, yield_coefficient: ArrayLike) -> FloatArray:
    """Return C1 = S_a/R_y^(2/3), arguments as of `yield_reduction`."""
    reduction = yield_reduction(spectral_acceleration_g, yield_coefficient)
    coefficient: FloatArray = np.asarray(spectral_acceleration_g) / reduction**POWER
    return coefficient


def share_by_hand(mu: ArrayLike, coefficient: ArrayLike, offset: ArrayLike = OFFSET) -> FloatArray:
    """Return lambda of the rule for friction, C1 and what is taken off."""
    share: FloatArray = np.clip(SLOPE * np.asarray(mu) / np.asarray(coefficient) - np.asarray(offset), 0.0, 1.0)
    return share


def exceptions(building: Building, load_ratio: float) -> tuple[str, ...]:
    """Return why 0.10 stands in place of 0.15; `load_ratio` is the largest mass of goods over that of their floor."""
    yields = bool(np.isfinite(building.yield_shear).any())
    reasons = {
        f"Omega below {LEAST_OVERSTRENGTH:g}": yields and bool((building.overstrength < LEAST_OVERSTRENGTH).any()),
        "no second slope": yields and bool((building.second_slope <= 0.0).any()),
        f"r2 above {LARGEST_SECOND_SLOPE:g}": yields and bool((building.second_slope > LARGEST_SECOND_SLOPE).any()),
        f"goods above {LARGEST_LOAD:g} times their floor": load_ratio > LARGEST_LOAD * (1.0 + 1e-12),
    }
    return tuple(reason for reason, holds in reasons.items() if holds)


REDUCED_FRICTION: Final = 0.8
"""Factor of mu in the rule for two directions, between 1/sqrt(2), which two equal directions share, and 1."""
SLIP_IN_EACH: Final = (1.25, 1.1, 3.0)
"""Peak slip in a direction over that of the direction alone: of all cases in sum, the smallest and the largest case."""
SLIP_LENGTH: Final = 1.8
"""The same in sum of the length of the peak slip."""


def one_direction_of_slip() -> str:
    """Return the sentence on slip that stands where there is one direction."""
    total, low, high = SLIP_IN_EACH
    return (
        "one direction underestimates slip: with the second component of recorded pairs peak slips in each direction "
        f"are {total:g} times those of one in sum ({low:g} to {high:g} by case, most where goods hardly slide; "
        f"docs/two_directions.md), their length {SLIP_LENGTH:g} times; give two directions and pairs where there are"
    )


@dataclass(frozen=True, slots=True)
class ByHand:
    """The rule for one building, without a run.

    Attributes
    ----------
    friction : float
        mu: the mean of static and kinetic friction of the goods, averaged by mass.
    friction_factor : float
        By which it counts: 1, in two directions 0.8.
    period : float
        First period of the building without goods (s).
    spectral_acceleration_g : float
        S_a at that period (g): of the target spectrum where one is given, else of the mean spectrum of the motions.
    of_target : bool
        Whether it is of a target spectrum.
    weight : float
        W_g: building, racks and all goods on the floors (N).
    yield_shear : float or None
        V_y of storey 1 (N); None where the building is elastic or has walls.
    yield_reduction : float
        R_y = S_a W_g/V_y, at least 1.
    coefficient : float
        C1 = S_a/R_y^(2/3).
    staying : float
        Part of the goods that is fixed to its floor (`Scene.fixed_goods`) and counts whole; the line is of the rest.
    exceptions : tuple of str
        Why 0.10 is taken off in place of 0.15; empty where 0.15 is.
    estimate : float
        lambda.
    """

    friction: float
    friction_factor: float
    period: float
    spectral_acceleration_g: float
    of_target: bool
    weight: float
    yield_shear: float | None
    yield_reduction: float
    coefficient: float
    staying: float
    exceptions: tuple[str, ...]
    estimate: float

    @property
    def offset(self) -> float:
        """What is taken off: 0.15, or 0.10."""
        return SMALL_OFFSET if self.exceptions else OFFSET

    @property
    def formula(self) -> str:
        """The rule of this building in letters."""
        factor = "" if self.friction_factor == 1.0 else f"{self.friction_factor:g} "
        line = f"{SLOPE:g} {factor}mu/C1 - {self.offset:.2f}"
        return line if self.staying == 0.0 else f"{self.staying:.2f} + {1.0 - self.staying:.2f} ({line})"

    @property
    def words(self) -> str:
        """The rule in letters and numbers, in one sentence, in SI units."""
        return self.words_in(UNITS["si"])

    def words_in(self, units: Units, factor: float = 1.0) -> str:
        """Return the rule in letters and numbers, in a system of units; `factor` is that of the stated friction."""
        friction = f"{factor:g} " * (factor != 1.0) + "(mu_s + mu_k)/2"
        if not np.isfinite(self.friction):
            return "1, as all goods are fixed"
        source = "target spectrum" if self.of_target else "mean spectrum of the motions"
        if self.yield_shear is None:
            strength = "R_y = 1, as no strength limits the base shear"
        else:
            forces = (self.weight, self.yield_shear)
            weight, force = (units.text("force", value, "" if value >= 1e6 else ".4f") for value in forces)
            strength = f"R_y = S_a W_g/V_y = {self.yield_reduction:.2f}, W_g = {weight}, V_y = {force}"
        why = f"; - {SMALL_OFFSET:.2f}: {', '.join(self.exceptions)}" if self.exceptions else ""
        return (
            f"{self.formula} = {self.estimate:.2f}; mu = {friction} = {self.friction:.3g}, C1 = S_a/R_y^(2/3) = "
            f"{self.coefficient:.3f}, S_a = {self.spectral_acceleration_g:.3f} g at {self.period:.3f} s ({source}), "
            f"{strength}{why}"
        )


def by_hand(
    scene: Scene, motions: NamedMotions | None, target: TargetSpectrum | None, drift: DriftMeasure = LARGER
) -> ByHand:
    """Return what the rule says of the building of a scene, with S_a of a target or of motions. Goods on racks count on
    the floor of the rack; in two directions it is the building in y if `drift` is, else in x.
    """
    if drift == "y" and isinstance(scene.other_direction, Building):
        scene = scene.replace(building=scene.other_direction, other_direction=True)
    building, goods = building_of(scene), goods_mass(scene)
    period, weight = float(building.periods[0]), full_weight(scene)
    mu = friction(scene, with_static=True)
    components = [] if motions is None else motions.components
    values = mean_spectrum(components, np.ones(len(components)), [period]) if target is None else target([period])
    acceleration = float(np.asarray(values)[0]) / STANDARD_GRAVITY
    # Elastic walls set no limit to the base shear.
    strength = float(building.yield_shear[0]) if building.stiffness_matrix is None else np.inf
    coefficient = float(floor_coefficient(acceleration, strength / weight))
    factor = 1.0 if scene.other_direction is False else REDUCED_FRICTION
    reasons = exceptions(building, float((goods / (building.mass + frame_mass(scene))).max()))
    result = ByHand(
        friction=mu,
        friction_factor=factor,
        period=period,
        spectral_acceleration_g=acceleration,
        of_target=target is not None,
        weight=weight,
        yield_shear=strength if np.isfinite(strength) else None,
        yield_reduction=float(yield_reduction(acceleration, strength / weight)),
        coefficient=coefficient,
        staying=0.0 if scene.fixed_goods is None else float(scene.fixed_goods.sum() / goods.sum()),
        exceptions=reasons,
        estimate=0.0,
    )
    line = float(share_by_hand(factor * mu, coefficient, result.offset))
    return replace(result, estimate=result.staying + (1.0 - result.staying) * line)


Rule: TypeAlias = Callable[[pl.DataFrame], FloatArray]
"""Takes the table of cases of a map, returns a share of the live load for each."""


def _constant(share: float) -> Rule:
    return lambda cases: np.full(cases.height, share)


RULES: Final[Mapping[str, Rule]] = {
    RULE: lambda cases: cases["by_hand"].to_numpy(),
    "none, 0": _constant(0.0),
    "ASCE 61, 0.10": _constant(0.10),
    "ASCE 7 storage, 0.25": _constant(0.25),
    "IS 1893, 0.5": _constant(0.50),
    "NBC and NZS 1170.5, 0.6": _constant(0.60),
    "MH16.1 racks, 0.67": _constant(0.67),
    "Eurocode 8, 0.8": _constant(0.80),
    "all, 1": _constant(1.0),
}
"""Rules that are compared."""

UNSAFE: Final = 1.05
"""A rule counts as unsafe for a case where the real building drifts more than so many times its model."""
PERIOD_EDGES: Final = (0.0, 0.225, 0.435, 0.7, 0.9, np.inf)
"""Edges of the classes of the bare building's period (s): on the default grid 0.2; 0.25 to 0.4; 0.47 to 0.6; 0.8; 1.0
to 1.6."""


def compared(ratio: FloatArray) -> dict[str, Any]:
    """Return how model over real drift is distributed: geometric mean (bias), standard deviation of the logarithm,
    share of cases below 1/1.05 (unsafe), 5 and 95 %, and the least (worst).
    """
    logarithm = np.log(ratio)
    return {
        "cases": len(ratio),
        "bias": float(np.exp(logarithm.mean())),
        "log_scatter": float(logarithm.std()),
        "unsafe": float(np.mean(1.0 / ratio > UNSAFE)),
        "low": float(quantile(ratio, 0.05)),
        "high": float(quantile(ratio, 0.95)),
        "worst": float(ratio.min()),
    }


def by_period(name: str, ratio: FloatArray, period: FloatArray) -> list[dict[str, Any]]:
    """Return a row of `compared` for each class of period that has cases; the last class is open (null)."""
    rows = []
    for low, high in pairwise(PERIOD_EDGES):
        inside = ratio[(low <= period) & (period < high)]
        if len(inside):
            upper = None if np.isinf(high) else high
            rows.append({"period_from": low, "period_to": upper, "rule": name, **compared(inside)})
    return rows


RULE_UNKNOWN: Final = "the rule by hand knows no"
"""How a remark begins that the rule does not hold."""


def remarks_of_structure(scene: Scene) -> tuple[str, ...]:
    """Return where the rule does not hold for a scene, as sentences; none for goods on floors of a shear building."""
    remarks = []
    if any(rack.floor > 0 for rack in scene.racks):
        remarks.append(
            f"{RULE_UNKNOWN} racks: under a yielding building stiff ones give up to 1.1 with pallets (mu 0.37) and up "
            "to 1.3 with fixed goods, those of 1 to 2 s 0 to 0.4, where pallets on the floor give 0.8 to 1"
        )
    if scene.building is not None and scene.building.stiffness_matrix is not None:
        remarks.append(
            f"{RULE_UNKNOWN} walls: an elastic wall beside a frame with R = 4 gives 0.5 where the friction is half of "
            "the mean peak base shear over the weight"
        )
    if any(block.stops is not None for block in scene.goods):
        remarks.append(
            f"{RULE_UNKNOWN} stops: at 5 cm they raise the share of slippery goods (mu 0.1) by 0.2 to 0.3, and single "
            "records reach 3 times the drift without them"
        )
    if scene.base is not None:
        remarks.append(
            f"{RULE_UNKNOWN} sliding base: it takes C1 of the building on the ground, and a base that slides limits "
            "what the floors feel to about its friction"
        )
    return tuple(remarks)
