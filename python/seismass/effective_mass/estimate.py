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

from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from seismass.base.values import FloatArray

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
    found: FloatArray = np.where(yields, YIELDING_FACTOR * (1.0 + ratio), 1.0 + ELASTIC_GROWTH * ratio)
    return found


def height_ratio(goods: ArrayLike, mass: ArrayLike, heights: ArrayLike | None = None) -> float:
    """Return h_g/h_m, the mean height by mass of the goods over that of building and goods together; 1 without goods.
    Masses in kg, lowest floor first; storey heights are equal where left out.
    """
    loads, floors = _numbers(goods), _numbers(mass)
    if not loads.any():
        return 1.0
    level = np.cumsum(np.ones(len(floors)) if heights is None else _numbers(heights))
    return float((loads @ level / loads.sum()) / ((floors + loads) @ level / (floors + loads).sum()))


def best_estimate(eta: ArrayLike, power: ArrayLike, heights: ArrayLike = 1.0) -> FloatArray:
    """Return the best estimate min(1, eta_h^p) of the effective fraction; eta is mu_k over the base shear coefficient
    with all goods attached, `power` from `exponent`, `heights` from `height_ratio`.
    """
    found: FloatArray = np.minimum(1.0, (_numbers(eta) / np.sqrt(_numbers(heights))) ** _numbers(power))
    return found


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
    found: FloatArray = np.minimum(DYNAMIC_SHEAR * elastic, yielding)
    return found
