"""Approximate periods of codes and their upper limits, each with its clause and how it was checked."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final, Literal, TypeAlias

import numpy as np
import polars as pl

from seismass.base.errors import InvalidOption
from seismass.base.values import as_count, as_number, brief, known_id, refusal
from seismass.base.views import Card
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


_STEEL, _CONCRETE, _OTHER = "steel-moment-frame", "concrete-moment-frame", "other"
_EBF, _BRB, _BRACED = "steel-eccentrically-braced-frame", "steel-buckling-restrained-frame", "braced-frame"
_WALL, _BY_STOREYS = "shear-wall", "moment-frame-by-storeys"
_FRAMES = "frames that resist all of the seismic force and are not enclosed by stiffer parts"

# Code, clause, status, then (system, C_t, x, upper limit, note) of each system.
_Row: TypeAlias = tuple[str, float, float, float | None, str]
_ASCE_ROWS: Final[tuple[_Row, ...]] = (
    (_STEEL, 0.0724, 0.8, None, _FRAMES),
    (_CONCRETE, 0.0466, 0.9, None, _FRAMES),
    (_EBF, 0.0731, 0.75, None, ""),
    (_BRB, 0.0731, 0.75, None, ""),
    (_OTHER, 0.0488, 0.75, None, ""),
    (_BY_STOREYS, 0.1, 1.0, None, "up to 12 storeys of at least 3 m on average, moment frames alone"),
)
_CODES: Final[tuple[tuple[str, str, str, tuple[_Row, ...]], ...]] = (
    ("asce7-10", "12.8.2.1, table 12.8-2", VERIFIED, _ASCE_ROWS),
    ("asce7-16", "12.8.2.1, table 12.8-2", FROM_MEMORY, _ASCE_ROWS),
    ("asce7-22", "12.8.2.1, table 12.8-2", FROM_MEMORY, _ASCE_ROWS),
    (
        "bnbc2017",
        "2.5.7.2, table 6.2.20",
        VERIFIED,
        (
            (_STEEL, 0.0724, 0.8, 1.4, _FRAMES),
            (_CONCRETE, 0.0466, 0.9, 1.4, _FRAMES),
            (_EBF, 0.0731, 0.75, 1.4, ""),
            (_OTHER, 0.0488, 0.75, 1.4, ""),
        ),
    ),
    (
        "ec8",
        "4.3.3.2.2(3)",
        FROM_MEMORY,
        (
            (_STEEL, 0.085, 0.75, None, "up to 40 m; no limit of calculated periods"),
            (_CONCRETE, 0.075, 0.75, None, "up to 40 m; no limit of calculated periods"),
            (_EBF, 0.075, 0.75, None, "up to 40 m; no limit of calculated periods"),
            (_OTHER, 0.05, 0.75, None, "up to 40 m; no limit of calculated periods"),
        ),
    ),
    (
        "nbc",
        "4.1.8.11(3)",
        VERIFIED,
        (
            (_STEEL, 0.085, 0.75, 1.5, _FRAMES),
            (_CONCRETE, 0.075, 0.75, 1.5, _FRAMES),
            (_BY_STOREYS, 0.1, 1.0, 1.5, "other moment frames"),
            (_BRACED, 0.025, 1.0, 2.0, ""),
            (_WALL, 0.05, 0.75, 2.0, ""),
            (_OTHER, 0.05, 0.75, 1.0, ""),
        ),
    ),
    (
        "ubc-97",
        "1630.2.2, method A",
        FROM_MEMORY,
        (
            (_STEEL, 0.0853, 0.75, 1.3, "the limit is 1.4 outside seismic zone 4"),
            (_CONCRETE, 0.0731, 0.75, 1.3, "the limit is 1.4 outside seismic zone 4"),
            (_EBF, 0.0731, 0.75, 1.3, "the limit is 1.4 outside seismic zone 4"),
            (_OTHER, 0.0488, 0.75, 1.3, "the limit is 1.4 outside seismic zone 4"),
        ),
    ),
    (
        "is1893",
        "7.6.2",
        FROM_MEMORY,
        (
            (_STEEL, 0.085, 0.75, None, "bare frames; the limit of calculated periods is not known here"),
            (_CONCRETE, 0.075, 0.75, None, "bare frames; the limit of calculated periods is not known here"),
        ),
    ),
    (
        "nzs1170.5",
        "C4.1.2.2 (commentary)",
        FROM_MEMORY,
        (
            (
                _STEEL,
                1.25 * 0.11,
                0.75,
                None,
                "1.25 k_t h^0.75, ultimate limit state",
            ),
            (_CONCRETE, 1.25 * 0.075, 0.75, None, "as above"),
            (_EBF, 1.25 * 0.06, 0.75, None, "as above"),
            (_OTHER, 1.25 * 0.05, 0.75, None, "as above"),
        ),
    ),
    (
        "as1170.4",
        "6.2.3",
        FROM_MEMORY,
        (
            (_STEEL, 1.25 * 0.11, 0.75, None, "1.25 k_t h^0.75; the limit of calculated periods is not known here"),
            (_CONCRETE, 1.25 * 0.075, 0.75, None, "as above"),
            (_EBF, 1.25 * 0.06, 0.75, None, "as above"),
            (_OTHER, 1.25 * 0.05, 0.75, None, "as above"),
        ),
    ),
)

_RULES: Final = tuple(
    PeriodRule(
        code_id, CODE_NAMES[code_id], system, c_t, x, "storeys" if system == _BY_STOREYS else "height", upper, clause,
        status, note,
    )
    for code_id, clause, status, rows in _CODES
    for system, c_t, x, upper, note in rows
)  # fmt: skip

PERIOD_CODES: Final = tuple(dict.fromkeys(rule.code_id for rule in _RULES))
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
    of_code = {rule.system: rule for rule in _RULES if rule.code_id == code}
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
    return pl.DataFrame([asdict(rule) for rule in _RULES], schema_overrides={"upper": pl.Float64})
