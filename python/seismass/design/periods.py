"""Approximate periods of codes and their upper limits, each with its clause and how it was checked."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final, Literal, TypeAlias

import numpy as np
import polars as pl

from seismass.base.arguments import known_id
from seismass.base.errors import InvalidOption
from seismass.base.files import stored_rows
from seismass.base.values import as_count, as_number, brief, refusal
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


def _rule(row: dict[str, str]) -> PeriodRule:
    numbers = (float(row["coefficient"]), float(row["exponent"]))
    variable: Variable = row["variable"]  # type: ignore[assignment]
    upper = float(row["upper"]) if row["upper"] else None
    texts = (row["clause"], row["status"], row["note"])
    return PeriodRule(row["id"], CODE_NAMES[row["id"]], row["system"], *numbers, variable, upper, *texts)


_RULES: Final = tuple(_rule(row) for row in stored_rows("periods"))

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
