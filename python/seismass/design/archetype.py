"""A building designed by a code from its loads, system and site alone: an archetype, as studies of codes need many."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FieldValue, FloatArray, as_array, as_number, brief, frozen, refusal
from seismass.base.views import Card
from seismass.design.code_design import CodeDesign, Procedure, design_by_code
from seismass.design.lateral_force import DISTRIBUTION_CODES, code_period, equivalent_lateral_forces
from seismass.design.modes import positive_of_length, vibration_modes
from seismass.design.rules import known_category, rule_of, storey_checks
from seismass.model.building import Building
from seismass.motions.scaling.suite import as_target
from seismass.motions.spectra import TargetSpectrum

OWNER: Final = "designed building"
LEAST_DRIFT: Final = 1e-4
"""Least drift limit for which stiffnesses are sought."""


@dataclass(frozen=True, eq=False, repr=False)
class DesignedBuilding(FieldValue, Card):
    """A building as a code designs it, with the numbers of the design.

    Attributes
    ----------
    building : Building
        The building with its dead load alone, V_y of the design, P-Delta.
    design : CodeDesign
        W, T (the first period with W), C_s, V and storey shears with their clauses.
    approximate_period : float
        T_a of the code (s).
    checks : polars.DataFrame
        Drift and stability of each storey, as `storey_checks` has them.
    floors, load_ratio
        Floors with live load, from 1; design live load over dead load there, as `mass_ratio` of a grid.
    """

    building: Building
    design: CodeDesign
    approximate_period: float
    checks: pl.DataFrame
    floors: tuple[int, ...]
    load_ratio: FloatArray


def designed_building(
    dead_load: ArrayLike,
    live_load: ArrayLike,
    target: TargetSpectrum | str,
    reduction: float,
    *,
    heights: ArrayLike,
    fraction: float,
    area: float = 1000.0,
    system: str = "other",
    deflection: float | None = None,
    drift_limit: float = 0.02,
    code_id: str = "asce7-10",
    risk_category: str = "II",
    procedure: Procedure = "lateral-force",
    **building: Any,
) -> DesignedBuilding:
    """Return a building that a code designs for loads, a structural system and a site.

    Parameters
    ----------
    dead_load, live_load : array_like, shape (storeys,)
        Dead load and design live load of each floor (N/m2), floor 1 first; no live load where a floor carries none.
    target, reduction, code_id, risk_category, procedure
        As for `design_by_code`.
    heights : array_like
        Storey heights (m); one number stands for all storeys.
    fraction : float
        Fraction of the design live load in the weight of the design.
    area : float, default 1000
        Area of a floor (m2).
    system : str, default "other"
        System of `period_table`, whose largest period C_u T_a is that of the building.
    deflection, drift_limit
        C_d (default `reduction`) and the largest drift of the design over the height, for which it is made stiffer.
    **building
        Other arguments of `Building`: `overstrength`, ...; `gravity_load=None` leaves P-Delta out.

    Raises
    ------
    InvalidScene, InvalidOption
        An argument is out of its range, or the code has no approximate period or no lateral forces here.

    Notes
    -----
    Stiffnesses are in proportion to (V_i + V_1)/2, V_i the storey shears of lateral forces: between equal storeys and
    equal drifts. V_y is that of `design_by_code`, which building files use: real first yields are higher.

    Examples
    --------
    One storey of 4.5 m, 4.5 kPa dead and 6 kPa live load, R = 3.25: T = 1.4 x 0.0488 x 4.5^0.75 s.

    >>> import seismass as sm
    >>> site = sm.TargetSpectrum.asce7(1.0, 0.6)
    >>> found = sm.design.designed_building([4.5e3], [6e3], site, 3.25, heights=4.5, fraction=0.25)
    >>> round(found.design.period, 4), round(float(found.building.yield_shear[0] / found.design.weight), 4)
    (0.2111, 0.3077)
    """
    dead, live = (as_array(loads, "loads", OWNER, InvalidOption) for loads in (dead_load, live_load))
    if len(live) != len(dead) or not (dead > 0.0).all() or not (live >= 0.0).all():
        requirement = f"{len(dead)} numbers of at least 0, and dead loads positive"
        raise refusal(InvalidOption, "live_load", OWNER, requirement, brief(live.tolist()))
    share, size, limit = (
        as_number(value, name, OWNER, InvalidOption)
        for value, name in ((fraction, "fraction"), (area, "area"), (drift_limit, "drift_limit"))
    )
    if not (0.0 <= share <= 1.0 and size > 0.0 and limit >= LEAST_DRIFT):
        got = f"{share:g}, {size:g} and {limit:g}"
        requirement = f"between 0 and 1, area positive and drift_limit at least {LEAST_DRIFT:g}"
        raise refusal(InvalidOption, "fraction", OWNER, requirement, got)
    target = as_target(target, OWNER)
    h = positive_of_length(heights, "heights", len(dead))
    how: dict[str, Any] = {"code_id": code_id, "system": system, "height": float(h.sum())}
    period = code_period(**how, storeys=len(dead), s_d1=float(target(1.0)) / STANDARD_GRAVITY)
    how |= {"risk_category": risk_category, "procedure": procedure, "heights": h}
    rule = rule_of(code_id, "importance", "strength")
    drifts: dict[str, Any] = {
        "c_d": reduction if deflection is None else deflection,
        "importance": 1.0 if rule is None else rule.of(known_category(risk_category)),
        "limit": limit,
        "load": np.cumsum((dead + live)[::-1])[::-1] * size,
    }
    seconds = period.limit if np.isfinite(period.limit) else period.approximate
    weight = (dead + share * live) * size
    shape_code = code_id if code_id in DISTRIBUTION_CODES else "asce7-10"
    excess = np.inf
    while excess > 1.001:  # stiffer, until the drift limit holds
        # Drifts fall with T^2 C_s: a little less than T^2 of what is too much leads to the limit from above.
        seconds *= max(0.5, excess**-0.35) if np.isfinite(excess) else 1.0
        shear = equivalent_lateral_forces(weight, h, 1.0, seconds, code_id=shape_code).shear
        shape = 0.5 * (shear + shear[0])
        mass = weight / STANDARD_GRAVITY
        stiffness = shape * (vibration_modes(mass, shape).periods[0] / seconds) ** 2
        design = design_by_code(mass, stiffness, target, reduction, **how)
        checks = storey_checks(design.yield_shear, design.yield_shear / stiffness, h, **drifts)
        excess = float((checks["design_drift"].to_numpy() / h).max()) / limit
    arguments = {"yield_shear": design.yield_shear, "heights": h, "gravity_load": dead * size} | building
    loaded = np.flatnonzero(live > 0.0)
    return DesignedBuilding(
        Building(dead * size / STANDARD_GRAVITY, stiffness, **arguments),
        design,
        period.approximate,
        checks,
        tuple((loaded + 1).tolist()),
        frozen(live[loaded] / dead[loaded]),
    )
