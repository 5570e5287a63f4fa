"""A building designed by a code from its loads, system and site alone: an archetype, as studies of codes need many."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import (
    FloatArray,
    as_array,
    as_flag,
    as_number,
    as_positive,
    brief,
    content_hash,
    frozen,
    refusal,
    same_content,
    short_repr,
)
from seismass.base.views import Card
from seismass.design.code_design import CodeDesign, Procedure, design_by_code
from seismass.design.lateral_force import DISTRIBUTION_CODES, equivalent_lateral_forces
from seismass.design.limits import storey_checks
from seismass.design.modes import vibration_modes
from seismass.design.periods import code_period
from seismass.design.rules import known_category, rule_of
from seismass.model.building import DEFAULT_DAMPING, Building
from seismass.motions.spectra import TargetSpectrum

OWNER: Final = "designed building"


@dataclass(frozen=True, eq=False)
class DesignedBuilding(Card):
    """A building as a code designs it, with the numbers of the design.

    Attributes
    ----------
    building : Building
        The building with its dead load alone: masses, stiffnesses, V_y of the design, springs, P-Delta.
    design : CodeDesign
        Weight, period, C_s, base shear and storey shears with their clauses.
    approximate_period : float
        T_a of the code (s).
    checks : polars.DataFrame
        Drift and stability of each storey, as `storey_checks` has them.
    floors : tuple of int
        Floors with live load, from 1.
    dead_load, live_load : ndarray, shape (storeys,)
        Of each floor (N/m2).
    """

    building: Building
    design: CodeDesign
    approximate_period: float
    checks: pl.DataFrame
    floors: tuple[int, ...]
    dead_load: FloatArray
    live_load: FloatArray

    __repr__ = short_repr
    __eq__ = same_content
    __hash__ = content_hash

    @property
    def period(self) -> float:
        """T of the design (s), which is the first period with the weight of the design."""
        return self.design.period

    @property
    def load_ratio(self) -> FloatArray:
        """Design live load over dead load of the loaded floors, as `mass_ratio` of a grid."""
        floors = np.array(self.floors) - 1
        return frozen(self.live_load[floors] / self.dead_load[floors])


def designed_building(
    dead_load: ArrayLike,
    live_load: ArrayLike,
    target: TargetSpectrum,
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
    p_delta: bool = True,
    damping: float = DEFAULT_DAMPING,
    **springs: Any,
) -> DesignedBuilding:
    """Return a building that a code designs for loads, a structural system and a site.

    Parameters
    ----------
    dead_load, live_load : array_like, shape (storeys,)
        Dead load and design live load of each floor (N/m2), floor 1 first; 0 where a floor carries none.
    target : TargetSpectrum
        Elastic design spectrum of the site.
    reduction : float
        R, or what the code has for it.
    heights : array_like
        Storey heights (m); one number stands for all storeys.
    fraction : float
        Fraction of the design live load in the weight of the design.
    area : float, default 1000
        Area of a floor (m2).
    system : str, default "other"
        System of `period_table`, whose largest period C_u T_a is that of the building.
    deflection : float, optional
        C_d of drifts; default `reduction`.
    drift_limit : float, default 0.02
        Largest drift of the design over the storey height; the building is made stiffer until it holds.
    code_id, risk_category, procedure, damping
        As for `design_by_code`.
    p_delta : bool, default True
        Second-order effect of the dead load; that of goods comes with them.
    **springs
        What shapes the springs: `overstrength`, `second_slope`, ... of `Building`.

    Raises
    ------
    InvalidScene, InvalidOption
        An argument is out of its range, or the code has no approximate period or no rule of lateral forces here.

    Notes
    -----
    Stiffnesses are in proportion to (V_i + V_1)/2, V_i the storey shears of the code's lateral forces: between equal
    storeys and equal drifts. The first period with the weight of the design is C_u T_a, or shorter by the drift limit.
    V_y is the storey shear of `design_by_code`, which building files use: real first yields are higher.

    Examples
    --------
    One storey of 4.5 m, 4.5 kPa dead and 6 kPa live load, R = 3.25: T = 1.4 x 0.0488 x 4.5^0.75 s.

    >>> import seismass as sm
    >>> site = sm.TargetSpectrum.asce7(1.0, 0.6)
    >>> found = sm.design.designed_building([4.5e3], [6e3], site, 3.25, heights=4.5, fraction=0.25)
    >>> round(found.period, 4), round(float(found.building.yield_shear[0] / found.design.weight), 4)
    (0.2111, 0.3077)
    """
    dead, live = (as_array(value, name, OWNER, InvalidOption) for name, value in _loads(dead_load, live_load))
    storeys = len(dead)
    if len(live) != storeys or not (dead > 0.0).all() or not (live >= 0.0).all():
        requirement = f"{storeys} numbers of at least 0, and dead loads positive"
        raise refusal(InvalidOption, "live_load", OWNER, requirement, brief(live.tolist()))
    share = as_number(fraction, "fraction", OWNER, InvalidOption)
    if not 0.0 <= share <= 1.0:
        raise refusal(InvalidOption, "fraction", OWNER, "between 0 and 1", f"{share:g}")
    size, limit = (
        as_positive(value, name, OWNER, InvalidOption) for name, value in (("area", area), ("drift_limit", drift_limit))
    )
    h = np.broadcast_to(as_array(heights, "heights", OWNER, InvalidOption, or_number=True), storeys)
    mass = (dead + share * live) * size / STANDARD_GRAVITY
    period = code_period(
        code_id, system, height=float(h.sum()), storeys=storeys, s_d1=float(target(1.0)) / STANDARD_GRAVITY
    )
    seconds = period.limit if np.isfinite(period.limit) else period.approximate
    rule = rule_of(code_id, "importance", "strength")
    importance = 1.0 if rule is None else rule.of(known_category(risk_category))
    while True:  # stiffer, until the drift limit holds
        shape_code = code_id if code_id in DISTRIBUTION_CODES else "asce7-10"
        forces = equivalent_lateral_forces(STANDARD_GRAVITY * mass, h, 1.0, seconds, code_id=shape_code)
        shape = 0.5 * (forces.shear + forces.shear[0])
        stiffness = shape * (vibration_modes(mass, shape).periods[0] / seconds) ** 2
        design = design_by_code(
            mass,
            stiffness,
            target,
            reduction,
            code_id=code_id,
            risk_category=risk_category,
            system=system,
            height=float(h.sum()),
            damping=damping,
            procedure=procedure,
            heights=h,
        )
        checks = storey_checks(
            design.yield_shear,
            design.yield_shear / stiffness,
            h,
            c_d=reduction if deflection is None else deflection,
            importance=importance,
            limit=limit,
            load=np.cumsum((dead + live)[::-1])[::-1] * size,
        )
        # Drifts fall with T^2 C_s: a little less than T^2 of what is too much leads to the limit from above.
        excess = float((checks["design_drift"].to_numpy() / h).max()) / limit
        if excess <= 1.001:
            break
        seconds *= max(0.5, excess**-0.35)
    building = Building(
        dead * size / STANDARD_GRAVITY,
        stiffness,
        yield_shear=design.yield_shear,
        heights=h,
        damping=damping,
        gravity_load=dead * size if as_flag(p_delta, "p_delta", OWNER, InvalidOption) else None,
        **springs,
    )
    floors = tuple((np.flatnonzero(live > 0.0) + 1).tolist())
    return DesignedBuilding(building, design, period.approximate, checks, floors, frozen(dead), frozen(live))


def _loads(dead: Any, live: Any) -> tuple[tuple[str, Any], tuple[str, Any]]:
    return ("dead_load", dead), ("live_load", live)
