"""The effective fraction by hand: from friction, base shear, period, and where the goods stand.

    lambda = min(1, eta_h^p),     eta_h = mu_k / (C1 sqrt(h_g/h_m))

    p = 1 + x/2                   where the building stays elastic,
    p = 1.2 (1 + x)               where it yields,             x = T/T_c, at most 1.5.

C1 is the base shear coefficient with all goods attached, h_g the mean height of the goods by mass, h_m that of
building and goods together, T the first period of the bare building, T_c the corner period of the motions.

Each constant has its reason. A step of ground acceleration has the fraction eta - eta^2/4 in closed form, so that p
goes to 1 as T/T_c goes to 0 in an elastic building. By dimensions p can depend on T only over a period of the motions:
the same recordings scaled in amplitude to targets with T_S of 0.3, 0.57 and 1.0 s have the same p, and halves of them
with short and with long T_c differ as T/T_c says. A floor accelerates about as its height in the first mode, so that
goods below the mean height slide less than C1 says; its square root, since the modes above the first and yielding make
accelerations more even. Beyond 1.5 T_c drift hardly depends on the share, and what the exponent would be differs from
suite to suite. 1/2, 1.2 and 1.5 were fitted, by eye and to one or two digits; 1/2 and 1.2 on the FEMA P-695 far-field
suite alone, 1.5 on all suites that were tried. Tables on several suites are in docs/effective_mass.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Any, Final, TypeAlias

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.values import FloatArray
from seismass.design import response_spectrum_analysis
from seismass.effective_mass.models import building_of, frame_mass, friction, full_weight, goods_mass
from seismass.effective_mass.runs import LARGER, DriftMeasure, NamedMotions, Peaks
from seismass.model.building import Building
from seismass.model.scene import Scene
from seismass.motions.motion import Motion
from seismass.motions.spectra import corner_period, mean_spectrum

ELASTIC_GROWTH: Final = 0.5
"""Growth of the exponent with T/T_c while the building stays elastic."""
YIELDING_FACTOR: Final = 1.2
"""Exponent over 1 + T/T_c where the building yields."""
LONGEST_RATIO: Final = 1.5
"""Largest T/T_c that counts."""
RULE: Final = "min(1, eta_h^p)"
"""The best estimate, as texts and tables name it."""
SAFE_RULE: Final = "min(1, eta_h)"
"""The conservative estimate, in the same form."""
RULE_IN_WORDS: Final = (
    "eta_h = mu_k/(C1 sqrt(h_g/h_m)); p = 1.2 (1 + x) where the building yields, 1 + x/2 where it is elastic, "
    "x = T/T_c, at most 1.5"
)
"""What the names of the two stand for, in one line."""

DYNAMIC_SHEAR: Final = 1.07
"""Mean peak base shear of elastic buildings in runs over that of a response spectrum analysis with the same motions."""
SHORT_PERIOD_DUCTILITY: Final = 0.6
"""Growth of ductility demand beyond equal displacement with T_c over the period."""


def _numbers(values: ArrayLike) -> FloatArray:
    return np.asarray(values, dtype=np.float64)


def exponent(period: ArrayLike, corner_period: ArrayLike, yields: ArrayLike) -> FloatArray:
    """Return the exponent p of the rule. `corner_period` is T_c of the motions (s), or T_S = S_D1/S_DS of a site;
    `yields` says whether the building yields with all goods attached.
    """
    ratio = np.minimum(_numbers(period) / _numbers(corner_period), LONGEST_RATIO)
    powers: FloatArray = np.where(yields, YIELDING_FACTOR * (1.0 + ratio), 1.0 + ELASTIC_GROWTH * ratio)
    return powers


def height_ratio(load_mass: ArrayLike, mass: ArrayLike, heights: ArrayLike | None = None) -> float:
    """Return h_g/h_m, the mean height by mass of the goods over that of building and goods together; 1 without goods.
    Masses in kg, lowest floor first; storey heights are equal where left out.
    """
    loads, floors = _numbers(load_mass), _numbers(mass)
    if not loads.any():
        return 1.0
    level = np.cumsum(np.ones(len(floors)) if heights is None else _numbers(heights))
    return float((loads @ level / loads.sum()) / ((floors + loads) @ level / (floors + loads).sum()))


def best_estimate(eta: ArrayLike, power: ArrayLike, heights: ArrayLike = 1.0) -> FloatArray:
    """Return the best estimate min(1, eta_h^p) of the effective fraction; eta is mu_k over the base shear coefficient
    with all goods attached, `power` from `exponent`, `heights` from `height_ratio`.
    """
    fraction: FloatArray = np.minimum(1.0, (_numbers(eta) / np.sqrt(_numbers(heights))) ** _numbers(power))
    return fraction


def conservative_estimate(eta: ArrayLike, heights: ArrayLike = 1.0) -> FloatArray:
    """Return the conservative estimate min(1, eta_h): the exponent of a step input, at every period."""
    return best_estimate(eta, 1.0, heights)


def base_shear_by_hand(
    yield_coefficient: ArrayLike,
    elastic_coefficient: ArrayLike,
    period: ArrayLike,
    corner_period: ArrayLike,
    second_slope: ArrayLike,
    overstrength: ArrayLike,
) -> FloatArray:
    """Return C1, the smaller of 1.07 V_e/W and (V_y/W) min(Omega, 1 + r2 (m - 1)) with the ductility demand m = 1 +
    (V_e/V_y - 1)(1 + 0.6 T_c/T), similar to Newmark and Hall's and Eurocode 8's rules.
    """
    strength, elastic = _numbers(yield_coefficient), _numbers(elastic_coefficient)
    beyond_yield = np.maximum(elastic / strength - 1.0, 0.0)
    ductility = beyond_yield * (1.0 + SHORT_PERIOD_DUCTILITY * _numbers(corner_period) / _numbers(period))
    yielding = strength * np.minimum(_numbers(overstrength), 1.0 + _numbers(second_slope) * ductility)
    shear: FloatArray = np.minimum(DYNAMIC_SHEAR * elastic, yielding)
    return shear


REDUCED_FRICTION: Final = 0.8
"""Factor of mu_k in the rule for two directions, between 1/sqrt(2), which two equal directions share, and 1."""
SLIP_IN_EACH: Final = (1.25, 1.1, 3.0)
"""Peak slip in a direction over that of the direction alone: of all cases in sum, the smallest and the largest case."""
SLIP_LENGTH: Final = 1.8
"""The same in sum of the length of the peak slip."""


def friction_factor(scene: Scene) -> float:
    """Return the factor of mu_k in the rule for a scene: 1 in one direction."""
    return 1.0 if scene.other_direction is False else REDUCED_FRICTION


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
    """The rule for one building and one suite.

    Attributes
    ----------
    period : float
        First period of the building without goods (s).
    corner_period : float
        T_c of the motions (s), see `seismass.spectra.corner_period`.
    yields : bool
        Whether a storey of the building with all goods attached yields: its mean peak drift over the motions is above
        that of its yield force.
    height_ratio : float
        Mean height of the goods by mass, over that of building and goods together.
    exponent : float
        p of the rule.
    base_shear_coefficient : float
        C1 without a run, see `seismass.effective_mass.estimate.base_shear_by_hand`.
    eta : float
        mu_k over that coefficient.
    estimate : float
        The best estimate with that eta.
    """

    period: float
    corner_period: float
    yields: bool
    height_ratio: float
    exponent: float
    base_shear_coefficient: float
    eta: float
    estimate: float


def by_hand(scene: Scene, motions: NamedMotions, full: Peaks, drift: DriftMeasure = LARGER) -> ByHand:
    """Return what the rule says of the building of a scene; `full` has the peaks of the fully attached model. Goods on
    racks count on the floor of the rack; in two directions it is that in y if `drift` is, else in x.
    """
    if drift == "y" and isinstance(scene.other_direction, Building):
        scene = scene.replace(building=scene.other_direction, other_direction=True)
    yields = bool((full.capped.mean(axis=1)[-1] > yield_drift(building_of(scene))).any())
    return rule_by_hand(scene, motions, yields)


def rule_by_hand(scene: Scene, motions: NamedMotions, yields: bool) -> ByHand:
    """Return what the rule says of the building of a scene that yields, or does not, with all goods attached."""
    building, load_mass = building_of(scene), goods_mass(scene)
    mass, walls = building.mass + frame_mass(scene), building.stiffness_matrix

    components = motions.components

    def spectrum(periods: FloatArray) -> FloatArray:
        return mean_spectrum(components, np.ones(len(components)), periods)

    elastic = response_spectrum_analysis(mass + load_mass, building.stiffness, spectrum, stiffness_matrix=walls)
    weight = full_weight(scene)
    corner, period = _corner_period(tuple(components)), float(building.periods[0])
    heights = height_ratio(load_mass, mass, building.heights)
    # Elastic walls set no limit to the base shear.
    strength = building.yield_shear[0] if walls is None else np.inf
    power = float(exponent(period, corner, yields))
    coefficient = float(
        base_shear_by_hand(
            strength / weight,
            elastic.storey_shear[0] / weight,
            elastic.modes.periods[0],
            corner,
            building.second_slope[0],
            building.overstrength[0],
        )
    )
    eta = friction(scene) / coefficient
    estimate = float(best_estimate(friction_factor(scene) * eta, power, heights))
    return ByHand(period, corner, yields, heights, power, coefficient, eta, estimate)


@lru_cache(maxsize=1)
def _corner_period(motions: tuple[Motion, ...]) -> float:
    """T_c of the mean spectrum of a suite, of which an assessment asks several times."""
    return corner_period(lambda periods: mean_spectrum(motions, np.ones(len(motions)), periods))


def yield_drift(building: Building) -> FloatArray:
    """Return the drift of each storey at V_y, in the measure of `Peaks.drift`: a ratio where heights are known."""
    with np.errstate(divide="ignore"):  # beside walls a storey may be without a spring
        drift = building.yield_shear / building.stiffness
    ratio: FloatArray = drift if building.heights is None else drift / building.heights
    return ratio


Rule: TypeAlias = Callable[[pl.DataFrame], FloatArray]
"""Takes the table of cases of a map, returns a share of the live load for each."""

BY_HAND: Final = f"{RULE}, C1 by hand"
"""The rule with the base shear coefficient of `base_shear_by_hand`."""


def _constant(share: float) -> Rule:
    return lambda cases: np.full(cases.height, share)


def _numbers_rules(cases: pl.DataFrame, *names: str) -> Iterator[FloatArray]:
    return (cases[name].to_numpy() for name in names)


def _best(cases: pl.DataFrame) -> FloatArray:
    return best_estimate(*_numbers_rules(cases, "eta", "exponent", "height_ratio"))


def _safe(cases: pl.DataFrame) -> FloatArray:
    return conservative_estimate(*_numbers_rules(cases, "eta", "height_ratio"))


def _by_hand(cases: pl.DataFrame) -> FloatArray:
    mu, coefficient, power, heights = _numbers_rules(
        cases, "mu", "base_shear_coefficient_by_hand", "exponent", "height_ratio"
    )
    return best_estimate(mu / coefficient, power, heights)


def _power_of_eta(power: float) -> Rule:
    return lambda cases: np.minimum(1.0, cases["eta"].to_numpy() ** power)


RULES: Final[Mapping[str, Rule]] = {
    RULE: _best,
    SAFE_RULE: _safe,
    BY_HAND: _by_hand,
    "min(1, eta^2), earlier": _power_of_eta(2.0),
    "min(1, eta), earlier": _power_of_eta(1.0),
    "none, 0": _constant(0.0),
    "ASCE 61, 0.10": _constant(0.10),
    "ASCE 7 storage, 0.25": _constant(0.25),
    "IS 1893, 0.5": _constant(0.50),
    "NBC and NZS 1170.5, 0.6": _constant(0.60),
    "MH16.1 racks, 0.67": _constant(0.67),
    "Eurocode 8, 0.8": _constant(0.80),
    "all, 1": _constant(1.0),
}
"""Rules that are compared. The two of earlier versions of this project know neither period nor place of the goods."""

CLOSED_FORMS: Final = tuple(RULES)[:5]
"""Those of them that depend on friction."""

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
        "low": float(np.percentile(ratio, 5.0)),
        "high": float(np.percentile(ratio, 95.0)),
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


RULE_UNKNOWN: Final = "the rule by period knows no"
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
            f"{RULE_UNKNOWN} walls: an elastic wall beside a frame with R = 4 gives 0.5 at eta = 0.5, where its "
            "estimate says 0.24 and its conservative form 0.55"
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
