"""Lateral forces of codes: approximate periods with their upper limits, the seismic response coefficient, and the
distribution of the base shear over height. Each row has its clause and how it was checked.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final, Literal, TypeAlias

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.arguments import known_id
from seismass.base.errors import InvalidOption
from seismass.base.files import stored_rows
from seismass.base.values import FloatArray, as_count, as_flag, as_number, as_positive, brief, frozen, refusal
from seismass.base.views import Card
from seismass.design.modes import moments, positive, positive_of_length
from seismass.model.codes import CODE_NAMES, FROM_MEMORY, SECOND_HAND, VERIFIED

Variable: TypeAlias = Literal["height", "storeys"]
"""What a formula takes: the height above the base (m), or the number of storeys."""


@dataclass(frozen=True)
class PeriodRule:
    """Approximate period C_t h^x of a code for one structural system.

    Attributes
    ----------
    code_id, code : str
        Short name of the code, as options take it, and its full name.
    system : str
        Structural system, as options take it: "steel-moment-frame", "other", ...
    coefficient, exponent : float
        C_t, for heights in metres, and x.
    variable : {"height", "storeys"}
        Whether h is the height (m) or the number of storeys.
    upper : float or None
        Calculated periods may be at most this multiple of the approximate one; None: the code has a coefficient C_u
        that depends on S_D1, or no limit that is known here (see `note`).
    clause : str
        Where the code says so.
    status : {"verified", "second-hand", "from memory, unverified"}
        How the row was checked, as in `code_table`.
    note : str
        Conditions.
    """

    code_id: str
    code: str
    system: str
    coefficient: float
    exponent: float
    variable: Variable
    upper: float | None
    clause: str
    status: str
    note: str


def _rule(row: dict[str, str]) -> PeriodRule:
    numbers = (float(row["coefficient"]), float(row["exponent"]))
    variable: Variable = row["variable"]  # type: ignore[assignment]
    upper = float(row["upper"]) if row["upper"] else None
    texts = (row["clause"], row["status"], row["note"])
    return PeriodRule(row["id"], CODE_NAMES[row["id"]], row["system"], *numbers, variable, upper, *texts)


_PERIODS: Final = tuple(_rule(row) for row in stored_rows("periods"))

PERIOD_CODES: Final = tuple(dict.fromkeys(rule.code_id for rule in _PERIODS))
"""Short names of the codes whose approximate period is known here."""

# ASCE/SEI 7, table 12.8-1: C_u over S_D1 (g), linear between (7-22 says so, 7-10 has a row for each).
_S_D1: Final = (0.1, 0.15, 0.2, 0.3, 0.4)
_C_U: Final = (1.7, 1.6, 1.5, 1.4, 1.4)
_C_U_STATUS: Final = {"asce7-10": VERIFIED, "asce7-16": FROM_MEMORY, "asce7-22": SECOND_HAND}


@dataclass(frozen=True)
class CodePeriod(Card):
    """Approximate period of a building by a code, and the upper limit of calculated ones.

    Attributes
    ----------
    approximate : float
        T_a (s).
    upper_factor : float or None
        Multiple of T_a that a calculated period must not exceed, C_u in ASCE 7; None where none is known.
    rule : PeriodRule
        The row of the code, with its clause and how it was checked.
    upper_clause, upper_status : str
        The same of the upper limit; empty where there is none.
    """

    approximate: float
    upper_factor: float | None
    rule: PeriodRule
    upper_clause: str
    upper_status: str

    @property
    def limit(self) -> float:
        """Largest period that may be used (s), C_u T_a; infinite where no limit is known."""
        return np.inf if self.upper_factor is None else self.upper_factor * self.approximate

    def design_period(self, calculated: float | None = None) -> float:
        """Return the period of the design (s): a calculated one, at most the limit; without one the approximate one.

        Parameters
        ----------
        calculated : float, optional
            Period of an analysis of the structure (s).
        """
        if calculated is None:
            return self.approximate
        value = as_number(calculated, "calculated", "period", InvalidOption)
        if not 0.0 < value < np.inf:
            raise refusal(InvalidOption, "calculated", "period", "a positive number of seconds", f"{value:g}")
        return min(value, self.limit)


def code_period(
    code_id: str,
    system: str,
    *,
    height: float | None = None,
    storeys: int | None = None,
    s_d1: float | None = None,
) -> CodePeriod:
    """Return the approximate period of a code and the upper limit of calculated periods.

    Parameters
    ----------
    code_id : str
        One of `PERIOD_CODES`, in any case.
    system : str
        Structural system of that code; `period_table` lists them.
    height : float, optional
        Height above the base (m); for all systems but "moment-frame-by-storeys".
    storeys : int, optional
        Number of storeys; for "moment-frame-by-storeys".
    s_d1 : float, optional
        Design spectral acceleration at 1 s (g), on which C_u of ASCE 7 depends; without it there is no upper limit.

    Raises
    ------
    InvalidOption
        The code or its system is not in the table, or what the formula takes is missing or out of range.

    Examples
    --------
    A steel moment frame of 12 m:

    >>> import seismass as sm
    >>> found = sm.design.code_period("asce7-10", "steel-moment-frame", height=12.0, s_d1=0.6)
    >>> round(found.approximate, 3), found.upper_factor, round(found.design_period(0.9), 3)
    (0.529, 1.4, 0.74)
    >>> found.rule.status
    'verified'
    """
    code = known_id(code_id, PERIOD_CODES, "code")
    of_code = {rule.system: rule for rule in _PERIODS if rule.code_id == code}
    if system not in of_code:
        raise refusal(InvalidOption, "system", f"code {code}", f"one of {', '.join(of_code)}", brief(system))
    rule = of_code[system]
    sizes = {"height": height, "storeys": storeys}
    if sizes[rule.variable] is None:
        raise refusal(InvalidOption, rule.variable, f"system {system}", "given", "none")
    if rule.variable == "storeys":
        size = float(as_count(storeys, "storeys", f"system {system}", InvalidOption, least=1))
    else:
        size = as_number(height, "height", f"system {system}", InvalidOption)
        if not 0.0 < size < np.inf:
            raise refusal(InvalidOption, "height", f"system {system}", "a positive number of metres", f"{size:g}")
    approximate = rule.coefficient * size**rule.exponent
    if code in _C_U_STATUS and s_d1 is not None:
        return CodePeriod(approximate, upper_limit_coefficient(s_d1), rule, "table 12.8-1", _C_U_STATUS[code])
    limited = rule.upper is not None
    return CodePeriod(approximate, rule.upper, rule, rule.clause if limited else "", rule.status if limited else "")


def upper_limit_coefficient(s_d1: float) -> float:
    """Return C_u, by which a calculated period may exceed the approximate one.

    Parameters
    ----------
    s_d1 : float
        Design spectral acceleration at 1 s (g).

    Raises
    ------
    InvalidOption
        S_D1 is negative or no number.

    Notes
    -----
    ASCE/SEI 7-10, table 12.8-1 (verified), linear between its rows: 1.7 up to 0.1 g, 1.6 at 0.15, 1.5 at 0.2, 1.4 from
    0.3.
    """
    value = as_number(s_d1, "s_d1", "period", InvalidOption)
    if not 0.0 <= value < np.inf:
        raise refusal(InvalidOption, "s_d1", "period", "at least 0 (g)", f"{value:g}")
    return float(np.interp(value, _S_D1, _C_U))


def period_table() -> pl.DataFrame:
    """Return one row per code and structural system.

    Returns
    -------
    polars.DataFrame
        Columns as `PeriodRule` has them.
    """
    return pl.DataFrame([asdict(rule) for rule in _PERIODS], schema_overrides={"upper": pl.Float64})


Exponent: TypeAlias = Literal["period", "one", "two"]
Top: TypeAlias = Literal["none", "period", "eight-percent"]


_OWNER: Final = "lateral forces"


@dataclass(frozen=True)
class DistributionRule:
    """How a code distributes the base shear over height: F_x = F_top + (V - F_top) w_x h_x^k / sum of w_i h_i^k.

    Attributes
    ----------
    code_id, code : str
        Short name of the code, as options take it, and its full name.
    exponent : {"period", "one", "two"}
        k: 1 up to 0.5 s and 2 from 2.5 s with a line between, or always 1 or 2.
    top : {"none", "period", "eight-percent"}
        F_top at the roof alone: none; 0.07 T V above 0.7 s, at most 0.25 V; or 0.08 V.
    clause : str
        Where the code says so.
    status : {"verified", "second-hand", "from memory, unverified"}
        How the row was checked, as in `code_table`.
    """

    code_id: str
    code: str
    exponent: Exponent
    top: Top
    clause: str
    status: str


_DISTRIBUTIONS: Final = tuple(
    DistributionRule(
        row["id"],
        CODE_NAMES[row["id"]],
        row["exponent"],  # type: ignore[arg-type]
        row["top"],  # type: ignore[arg-type]
        row["clause"],
        row["status"],
    )
    for row in stored_rows("forces")
)
DISTRIBUTION_CODES: Final = tuple(rule.code_id for rule in _DISTRIBUTIONS)
"""Short names of the codes whose distribution is known here."""


@dataclass(frozen=True, eq=False)
class LateralForces(Card):
    """Equivalent lateral forces of a building.

    Attributes
    ----------
    rule : DistributionRule
        The code, with its clause and how it was checked.
    base_shear : float
        V (N).
    exponent : float
        k.
    top_force : float
        Part of the force at the roof that acts there alone (N).
    weight : ndarray, shape (floors,)
        Seismic weights (N).
    heights : ndarray, shape (storeys,)
        Storey heights (m).
    force : ndarray, shape (floors,)
        Lateral forces F_x (N); they add up to V.
    shear : ndarray, shape (storeys,)
        Storey shears (N).
    overturning : ndarray, shape (storeys,)
        Overturning moments at the foot of each storey (N m).
    """

    rule: DistributionRule
    base_shear: float
    exponent: float
    top_force: float
    weight: FloatArray
    heights: FloatArray
    force: FloatArray
    shear: FloatArray
    overturning: FloatArray

    def drift(self, stiffness: ArrayLike) -> FloatArray:
        """Return the elastic storey drifts (m) under the forces, shape (storeys,).

        Parameters
        ----------
        stiffness : array_like, shape (storeys,)
            Storey stiffnesses (N/m).

        Raises
        ------
        InvalidScene
            A stiffness is not positive, or there are not as many as storeys.
        """
        return frozen(self.shear / positive_of_length(stiffness, "stiffness", len(self.shear)))

    def table(self) -> pl.DataFrame:
        """Return one row per storey.

        Returns
        -------
        polars.DataFrame
            storey, from 1; level, the height of its floor above the base (m); weight of that floor (N); share, F_x/V;
            force (N); shear of the storey (N); overturning at its foot (N m).
        """
        return pl.DataFrame(
            {
                "storey": list(range(1, len(self.force) + 1)),
                "level": np.cumsum(self.heights),
                "weight": self.weight,
                "share": self.force / self.base_shear,
                "force": self.force,
                "shear": self.shear,
                "overturning": self.overturning,
            },
            schema_overrides={"storey": pl.UInt32},
        )


def equivalent_lateral_forces(
    weight: ArrayLike, heights: ArrayLike, base_shear: float, period: float, *, code_id: str = "asce7-10"
) -> LateralForces:
    """Return the distribution of a base shear over height by a code.

    Parameters
    ----------
    weight : array_like, shape (floors,)
        Seismic weight of each floor (N), floor 1 first.
    heights : array_like
        Storey heights (m); one number stands for all storeys.
    base_shear : float
        V (N).
    period : float
        Period of the design (s), on which k and the force at the roof depend.
    code_id : str, default "asce7-10"
        One of `DISTRIBUTION_CODES`, in any case.

    Raises
    ------
    InvalidScene, InvalidOption
        An argument is out of its range.

    Examples
    --------
    Equal weights and heights, T up to 0.5 s: a triangle, with storey shears as 6 : 5 : 3.

    >>> import seismass as sm
    >>> found = sm.design.equivalent_lateral_forces([1e6, 1e6, 1e6], 3.5, 0.24 * 3e6, 0.5)
    >>> (found.shear / 3e6).round(3).tolist()
    [0.24, 0.2, 0.12]
    """
    code = known_id(code_id, DISTRIBUTION_CODES, "code")
    rule = next(row for row in _DISTRIBUTIONS if row.code_id == code)
    w = positive(weight, "weight")
    h = positive_of_length(heights, "heights", len(w))
    total = as_positive(base_shear, "base_shear", _OWNER, InvalidOption)
    seconds = as_positive(period, "period", _OWNER, InvalidOption)
    k = {"period": exponent_k(seconds), "one": 1.0, "two": 2.0}[rule.exponent]
    of_period = min(0.07 * seconds, 0.25) if seconds > 0.7 else 0.0
    top = {"none": 0.0, "period": of_period, "eight-percent": 0.08}[rule.top] * total
    moment = w * np.cumsum(h) ** k
    force = (total - top) * moment / moment.sum()
    force[-1] += top
    shear = np.cumsum(force[::-1])[::-1]
    return LateralForces(rule, total, k, top, w, h, frozen(force), frozen(shear), frozen(moments(shear, h)))


def exponent_k(period: float) -> float:
    """Return k of the vertical distribution: 1 up to 0.5 s, 2 from 2.5 s, linear between.

    Parameters
    ----------
    period : float
        Period of the design (s).

    Raises
    ------
    InvalidOption
        The period is not positive.

    Notes
    -----
    ASCE/SEI 7-10, 12.8.3 (verified), which allows 2 between as well; BNBC 2017, 2.5.7.4.
    """
    seconds = as_positive(period, "period", _OWNER, InvalidOption)
    return float(np.clip(1.0 + (seconds - 0.5) / 2.0, 1.0, 2.0))


def seismic_response_coefficient(
    s_ds: float,
    s_d1: float,
    period: float,
    reduction: float,
    *,
    importance: float = 1.0,
    s_1: float | None = None,
    t_l: float = np.inf,
    minimum: bool = True,
) -> float:
    """Return C_s, the base shear over the effective seismic weight.

    Parameters
    ----------
    s_ds, s_d1 : float
        Design spectral accelerations at short periods and at 1 s (g).
    period : float
        Period of the design T (s).
    reduction : float
        Response modification coefficient R.
    importance : float, default 1.0
        Importance factor I_e.
    s_1 : float, optional
        Mapped spectral acceleration at 1 s (g); from 0.6 g it gives a further minimum.
    t_l : float, optional
        Long-period transition period T_L (s).
    minimum : bool, default True
        False leaves out 0.044 S_DS I_e, which need not be considered for drift (12.8.6.1), and 0.01.

    Raises
    ------
    InvalidOption
        An argument is out of its range.

    Notes
    -----
    ASCE/SEI 7-10, 12.8.1.1, equations 12.8-2 to 12.8-6 (verified). A period of S_D1/S_DS has both branches.

    Examples
    --------
    >>> import seismass as sm
    >>> sm.design.seismic_response_coefficient(1.0, 0.6, 0.5, 8.0)
    0.125
    >>> sm.design.seismic_response_coefficient(1.0, 0.6, 1.0, 8.0)
    0.075
    """
    short = as_positive(s_ds, "s_ds", _OWNER, InvalidOption)
    second = as_positive(s_d1, "s_d1", _OWNER, InvalidOption)
    t = as_positive(period, "period", _OWNER, InvalidOption)
    longest = as_positive(t_l, "t_l", _OWNER, InvalidOption, or_infinite=True)
    factor = as_positive(importance, "importance", _OWNER, InvalidOption)
    reduced = as_positive(reduction, "reduction", _OWNER, InvalidOption) / factor
    limit = second / t if t <= longest else second * longest / t**2
    coefficient = min(short, limit) / reduced
    if as_flag(minimum, "minimum", _OWNER, InvalidOption):
        coefficient = max(coefficient, 0.044 * short * factor, 0.01)
    if s_1 is not None and as_positive(s_1, "s_1", _OWNER, InvalidOption) >= 0.6:
        coefficient = max(coefficient, 0.5 * s_1 / reduced)
    return coefficient


def distribution_table() -> pl.DataFrame:
    """Return one row per code whose distribution is known here.

    Returns
    -------
    polars.DataFrame
        Columns as `DistributionRule` has them.
    """
    return pl.DataFrame([asdict(rule) for rule in _DISTRIBUTIONS])
