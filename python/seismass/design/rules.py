"""Rules of codes for a building: importance, base shear, modal scaling, level and scaling of motions, and
drift limits with the check of storeys against them and against the stability coefficient.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.arguments import as_word, known_id
from seismass.base.errors import InvalidOption
from seismass.base.files import stored_rows
from seismass.base.values import FloatArray, as_array, as_positive, brief, frozen, refusal
from seismass.design.modes import positive, positive_of_length
from seismass.model.codes import CODE_NAMES, SECOND_HAND, VERIFIED

CATEGORIES: Final = ("I", "II", "III", "IV")
"""Risk categories, importance classes or levels."""
APPLIED: Final = ("importance", "coefficient", "least coefficient", "modal share", "period limit", "drift limit")
"""Rules that the design of a building asks for; what a code does not have of them is said."""


@dataclass(frozen=True)
class CodeRule:
    """A rule of a code with its value.

    Attributes
    ----------
    code_id, code : str
        Short name of the code, which names the edition, and its full name.
    rule, case : str
        What the value is, and in which case it holds; `docs/design.md` explains them.
    value : str
        A number, one number for each risk category, the ends of a range, or a name.
    clause : str
        Where the code says so.
    status : {"verified", "second-hand", "from memory, unverified"}
        How the rule was checked, as in `code_table`.
    note : str
        Conditions, and what is not applied.
    """

    code_id: str
    code: str
    rule: str
    case: str
    value: str
    clause: str
    status: str
    note: str

    @property
    def numbers(self) -> tuple[float, ...]:
        """The numbers of the value."""
        return tuple(float(word) for word in self.value.split())

    @property
    def number(self) -> float:
        """The first number of the value."""
        return self.numbers[0]

    def of(self, category: str) -> float:
        """Return the number of a risk category.

        Parameters
        ----------
        category : {"I", "II", "III", "IV"}
            Risk category.
        """
        return self.numbers[CATEGORIES.index(category)]


RULES: Final = tuple(
    CodeRule(
        row["id"], CODE_NAMES[row["id"]], *(row[key] for key in ("rule", "case", "value", "clause", "status", "note"))
    )
    for row in stored_rows("rules")
)
"""All rules, code by code."""


def rule_of(code_id: str, rule: str, case: str | None = None) -> CodeRule | None:
    """Return a rule of a code, that of a case where one is named; None where it is not known here."""
    rules = (row for row in RULES if (row.code_id, row.rule) == (code_id, rule))
    return next((row for row in rules if case in (None, row.case)), None)


def known_category(risk_category: str) -> str:
    """Return a risk category in capitals; an unknown one is refused."""
    wanted: str = as_word(str(risk_category).strip().upper(), CATEGORIES, "risk_category", "building")
    return wanted


def rules_table() -> pl.DataFrame:
    """Return one row per code, rule and case.

    Returns
    -------
    polars.DataFrame
        Columns as `CodeRule` has them.
    """
    return pl.DataFrame([asdict(rule) for rule in RULES])


def weakest(statuses: list[str]) -> str:
    """Return the weakest of several statuses."""
    order = (VERIFIED, SECOND_HAND)
    return max(statuses, key=lambda status: order.index(status) if status in order else len(order), default=VERIFIED)


@dataclass(frozen=True)
class SystemFactors:
    """Design coefficients of a seismic force-resisting system.

    Attributes
    ----------
    system_id : str
        Line of the table, as options take it: "C1".
    system : str
        The system.
    R : float
        Response modification coefficient.
    omega_0 : float
        Overstrength factor Omega_0.
    C_d : float
        Deflection amplification factor.
    code, clause : str
        The code, and where it says so.
    status : {"verified", "second-hand", "from memory, unverified"}
        How the numbers were checked, as in `code_table`.
    """

    system_id: str
    system: str
    R: float
    omega_0: float
    C_d: float
    code: str
    clause: str
    status: str


_NUMBERS: Final = ("R", "omega_0", "C_d")
_SYSTEMS: Final = {
    row["id"]: SystemFactors(
        row["id"],
        row["system"],
        **{name: float(row[name]) for name in _NUMBERS},
        code="ASCE/SEI 7-10",
        clause="table 12.2-1",
        status=VERIFIED,
    )
    for row in stored_rows("systems")
}


def system_factors(system_id: str) -> SystemFactors:
    """Return R, Omega_0 and C_d of a system by its line in ASCE/SEI 7-10, table 12.2-1.

    Parameters
    ----------
    system_id : str
        Group and number of the line, in any case: "C1" is a steel special moment frame. `system_table` lists them.

    Raises
    ------
    InvalidOption
        There is no such line.

    Examples
    --------
    >>> import seismass as sm
    >>> frame = sm.design.system_factors("C5")
    >>> frame.R, frame.omega_0, frame.C_d
    (8.0, 3.0, 5.5)
    """
    known = {name.lower(): name for name in _SYSTEMS}
    return _SYSTEMS[known[known_id(system_id, tuple(known), "system")]]


def system_table() -> pl.DataFrame:
    """Return one row per system of ASCE/SEI 7-10, table 12.2-1.

    Returns
    -------
    polars.DataFrame
        Columns as `SystemFactors` has them. Limits of height and of seismic design category are not in it.
    """
    return pl.DataFrame([asdict(row) for row in _SYSTEMS.values()])


def importance_factor(risk_category: str, code_id: str = "asce7-10") -> float:
    """Return the seismic importance factor I_e of a risk category.

    Parameters
    ----------
    risk_category : {"I", "II", "III", "IV"}
        Risk category, importance class or level.
    code_id : str, default "asce7-10"
        The code, as `rules_table` names it.

    Raises
    ------
    InvalidOption
        There is no such category, or the importance factors of the code are not known here.

    Notes
    -----
    ASCE/SEI 7-10, table 1.5-2: 1.00, 1.00, 1.25 and 1.50 (verified).
    """
    category = known_category(risk_category)
    rule = rule_of(code_id, "importance")
    if rule is None:
        raise refusal(InvalidOption, "id", "code", "one whose importance factors are known here", brief(code_id))
    return rule.of(category)


THETA_THRESHOLD: Final = 0.10
"""Stability coefficient up to which P-Delta need not be considered: ASCE/SEI 7-10, 12.8.7 (verified)."""
THETA_CAP: Final = 0.25
"""Largest limit of the stability coefficient: ASCE/SEI 7-10, equation 12.8-17 (verified)."""


@dataclass(frozen=True)
class DriftLimit:
    """Allowable drift ratio of a code for one kind of structure and risk category.

    Attributes
    ----------
    code_id, code : str
        Short name of the code, as options take it, and its full name.
    structure : str
        Kind of structure, as options take it.
    risk_category : {"I", "II", "III", "IV"}
        Risk category; importance class in Eurocode 8.
    ratio : float
        Allowable drift over the storey height.
    of : str
        The drift that is limited.
    clause : str
        Where the code says so.
    status : {"verified", "second-hand", "from memory, unverified"}
        How the row was checked, as in `code_table`.
    note : str
        Conditions.
    """

    code_id: str
    code: str
    structure: str
    risk_category: str
    ratio: float
    of: str
    clause: str
    status: str
    note: str


_LIMITS: Final = tuple(
    DriftLimit(rule.code_id, rule.code, rule.case, category, rule.of(category), drift, rule.clause, rule.status, note)
    for rule in RULES
    if rule.rule == "drift limit"
    for drift, _, note in [rule.note.partition("; ")]
    for category in CATEGORIES
)
DRIFT_LIMIT_CODES: Final = tuple(dict.fromkeys(row.code_id for row in _LIMITS))
"""Short names of the codes whose drift limits are known here."""


def drift_limit(code_id: str, risk_category: str = "II", structure: str = "other") -> DriftLimit:
    """Return the allowable drift ratio of a code.

    Parameters
    ----------
    code_id : str
        One of `DRIFT_LIMIT_CODES`, in any case.
    risk_category : {"I", "II", "III", "IV"}, default "II"
        Risk category.
    structure : str, default "other"
        Kind of structure; `drift_limit_table` lists those of each code.

    Raises
    ------
    InvalidOption
        There is no such row.

    Examples
    --------
    >>> import seismass as sm
    >>> sm.design.drift_limit("asce7-10", "IV").ratio
    0.01
    """
    code = known_id(code_id, DRIFT_LIMIT_CODES, "code")
    category = known_category(risk_category)
    of_code = {row.structure: row for row in _LIMITS if (row.code_id, row.risk_category) == (code, category)}
    if structure not in of_code:
        raise refusal(InvalidOption, "structure", f"code {code}", f"one of {', '.join(of_code)}", brief(structure))
    return of_code[structure]


def drift_limit_table() -> pl.DataFrame:
    """Return one row per code, kind of structure and risk category.

    Returns
    -------
    polars.DataFrame
        Columns as `DriftLimit` has them.
    """
    return pl.DataFrame([asdict(row) for row in _LIMITS])


def stability_coefficient(load: ArrayLike, drift: ArrayLike, shear: ArrayLike, heights: ArrayLike) -> FloatArray:
    """Return the stability coefficient theta = P d/(V h) of each storey.

    Parameters
    ----------
    load : array_like, shape (storeys,)
        Vertical load P at and above each storey (N).
    drift : array_like, shape (storeys,)
        Elastic drift d under the shears (m). With the amplified drift Delta = C_d d/I_e it is theta C_d/I_e.
    shear : array_like, shape (storeys,)
        Storey shear V (N).
    heights : array_like
        Storey heights h (m); one number stands for all storeys.

    Raises
    ------
    InvalidScene, InvalidOption
        An argument is out of its range.

    Notes
    -----
    ASCE/SEI 7-10, equation 12.8-16, P Delta I_e/(V h C_d), with Delta I_e/C_d = d (verified).
    """
    v = positive(shear, "shear")
    h = positive_of_length(heights, "heights", len(v))
    p, d = (_not_negative(values, name, len(v)) for values, name in ((load, "load"), (drift, "drift")))
    return frozen(p * d / (v * h))


def stability_limit(c_d: float, *, beta: float = 1.0) -> float:
    """Return theta_max, the limit of the stability coefficient.

    Parameters
    ----------
    c_d : float
        Deflection amplification factor C_d.
    beta : float, default 1.0
        Shear demand over shear capacity of the storey; 1 is conservative.

    Raises
    ------
    InvalidOption
        An argument is not positive.

    Notes
    -----
    ASCE/SEI 7-10, equation 12.8-17: 0.5/(beta C_d), at most 0.25 (verified).
    """
    factor = as_positive(c_d, "c_d", "stability limit", InvalidOption)
    ratio = as_positive(beta, "beta", "stability limit", InvalidOption)
    return min(0.5 / (factor * ratio), THETA_CAP)


def storey_checks(
    shear: ArrayLike,
    drift: ArrayLike,
    heights: ArrayLike,
    *,
    c_d: float,
    importance: float = 1.0,
    limit: float,
    load: ArrayLike | None = None,
    beta: float = 1.0,
) -> pl.DataFrame:
    """Return the check of each storey against the drift limit and the limit of the stability coefficient.

    Parameters
    ----------
    shear, drift : array_like, shape (storeys,)
        Storey shears (N) and elastic drifts (m) under the same design forces: those of `LateralForces`, or those of
        `SpectrumAnalysis.for_design` without a base shear.
    heights : array_like
        Storey heights (m); one number stands for all storeys.
    c_d, importance : float, optional
        C_d and I_e.
    limit : float
        Allowable drift ratio, as `drift_limit` has it.
    load : array_like, shape (storeys,), optional
        Vertical load at and above each storey (N); without it stability is not checked.
    beta : float, default 1.0
        Shear demand over shear capacity.

    Returns
    -------
    polars.DataFrame
        storey, from 1; elastic_drift and design_drift, C_d times that over I_e (m), not yet amplified for P-Delta;
        theta, theta_limit; amplification, 1/(1 - theta) where theta is above 0.10, else 1; drift_ratio, the amplified
        design drift over the height; limit; drift_ok; p_delta: "negligible", "to be considered" or "unstable" (theta
        above its limit, without an amplification and a drift ratio). What needs the load is null without it.

    Raises
    ------
    InvalidScene, InvalidOption
        An argument is out of its range.

    Notes
    -----
    ASCE/SEI 7-10, 12.8.6, 12.8.7 and 12.12.1 (verified). The drift is amplified before it is compared with its limit.
    """
    v = positive(shear, "shear")
    storeys = len(v)
    h, elastic = positive_of_length(heights, "heights", storeys), _not_negative(drift, "drift", storeys)
    factor = as_positive(importance, "importance", "storey checks", InvalidOption)
    share = as_positive(limit, "limit", "storey checks", InvalidOption)
    theta_limit = stability_limit(c_d, beta=beta)
    design = c_d * elastic / factor
    theta = None if load is None else stability_coefficient(load, elastic, v, h)
    rows = []
    for i in range(storeys):
        coefficient = None if theta is None else float(theta[i])
        unstable = coefficient is not None and coefficient > theta_limit
        larger = 1.0 if coefficient is None or coefficient <= THETA_THRESHOLD else 1.0 / (1.0 - coefficient)
        ratio = None if unstable else larger * float(design[i] / h[i])
        state = None
        if coefficient is not None:
            state = "unstable" if unstable else "to be considered" if coefficient > THETA_THRESHOLD else "negligible"
        rows.append(
            {
                "storey": i + 1,
                "elastic_drift": float(elastic[i]),
                "design_drift": float(design[i]),
                "theta": coefficient,
                "theta_limit": None if coefficient is None else theta_limit,
                "amplification": None if coefficient is None or unstable else larger,
                "drift_ratio": ratio,
                "limit": share,
                "drift_ok": ratio is not None and ratio <= share,
                "p_delta": state,
            }
        )
    numbers = dict.fromkeys(("theta", "theta_limit", "amplification", "drift_ratio"), pl.Float64)
    return pl.DataFrame(rows, schema_overrides={"storey": pl.UInt32, "p_delta": pl.String, **numbers})


def _not_negative(values: ArrayLike, name: str, storeys: int) -> FloatArray:
    array = as_array(values, name, "storeys", InvalidOption)
    if len(array) != storeys:
        requirement = f"a list of {storeys} values, one per storey"
        raise refusal(InvalidOption, name, "storeys", requirement, f"{len(array)} values")
    return not_negative(array, name, "storeys")


def not_negative(array: FloatArray, name: str, owner: str) -> FloatArray:
    """Return finite numbers of at least 0."""
    if not (np.isfinite(array) & (array >= 0.0)).all():
        raise refusal(InvalidOption, name, owner, "numbers of at least 0", brief(array.tolist()))
    return array
