"""Rules of codes for a building: importance, base shear, modal scaling, drift limits, level and scaling of motions."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final

import polars as pl

from seismass.base.arguments import as_word
from seismass.base.files import stored_rows
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
