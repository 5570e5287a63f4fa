"""The fraction of live load that codes count as seismic mass, each row with its clause and how it was verified.

A row of which any part was not read in the code itself says so: check it in the code before use.
"""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Final, Literal, TypeAlias, get_args

from seismass.base.arguments import as_word, known_id
from seismass.base.errors import InvalidOption
from seismass.base.files import stored_rows
from seismass.base.values import refusal

if TYPE_CHECKING:
    import polars as pl

__all__ = [
    "AS_STATED",
    "CODE_IDS",
    "CODE_NAMES",
    "FROM_MEMORY",
    "MARK",
    "NOT_CHECKED",
    "NOT_KNOWN",
    "SECOND_HAND",
    "VERIFIED",
    "CodeFraction",
    "Use",
    "code_fraction",
    "code_legend",
    "code_table",
]

__dir__ = __all__.copy  # for completion

Use: TypeAlias = Literal["storage", "archive", "assembly", "shop", "ordinary", "garage", "roof", "important"]
"""Use of goods or of a floor: storage and warehouses, archives and libraries, assembly (schools, theatres), shops,
offices and dwellings, car parks, roofs, or any floor of important buildings (categories A and B of E.030).
"""
STORED: Final = ("storage", "archive")
"""Uses whose floors are full where nothing is stated."""
_CLASS_OF: Final[dict[str, Use]] = {
    "archive": "storage",
    "assembly": "ordinary",
    "shop": "ordinary",
    "roof": "ordinary",
    "important": "ordinary",
}
"""Use whose row counts where a code has none for a use; a car park has no such row."""

VERIFIED: Final = "verified"
SECOND_HAND: Final = "second-hand"
FROM_MEMORY: Final = "from memory, unverified"
"""Status of a row: read in the text named, read in a text that quotes it, or neither."""
NOT_KNOWN: Final = "not known here"
"""Status of a row without numbers."""
AS_STATED: Final = "as stated"
"""Status of a fraction that the user states."""
NOT_CHECKED: Final = "not checked against the code"
"""What every table, figure and page says of a row that was not read in the code's own text."""
MARK: Final = "\N{DAGGER}"
"""Mark of such a row."""


@dataclass(frozen=True)
class CodeFraction:
    """What a code counts of the live load as seismic mass, for one use.

    Attributes
    ----------
    code_id : str
        Short name, as options and files take it: "asce7-10".
    code : str
        The code in full.
    use : {"storage", "archive", "assembly", "shop", "ordinary", "garage", "roof", "important"}
        Storage and warehouses, archives and libraries, assembly, shops, offices and dwellings, car parks, roofs, or
        important buildings.
    fraction : float
        Fraction of the design live load; the upper end where the code has a range; NaN where it is not known here.
    low, high : float
        The range; both equal `fraction` where there is none.
    clause : str
        Where the code says so; empty where that is not known.
    note : str
        Exceptions, and what else counts.
    status : {"verified", "second-hand", "from memory, unverified", "not known here", "as stated"}
        How the fraction was checked; the weakest of its parts.
    edition : str
        Edition of the code; empty where it is not known.
    """

    code_id: str
    code: str
    use: Use
    fraction: float
    low: float
    high: float
    clause: str
    note: str
    status: str
    edition: str = ""

    @property
    def checked(self) -> bool:
        """Whether the fraction was read in the code's own text, or stated by the user."""
        return self.status in (VERIFIED, AS_STATED)

    @property
    def mark(self) -> str:
        """`MARK` where the fraction was not checked against the code's text; else nothing."""
        return "" if self.checked else MARK


def _fraction(row: dict[str, str]) -> CodeFraction:
    high = float(row["fraction"] or "nan")
    use: Use = row["use"]  # type: ignore[assignment]
    texts = (row["clause"], row["note"], row["status"], row["edition"])
    return CodeFraction(row["id"], row["code"], use, high, float(row["low"] or high), high, *texts)


_ROWS: Final = tuple(_fraction(row) for row in stored_rows("fractions"))

CODE_IDS: Final = tuple(dict.fromkeys(row.code_id for row in _ROWS))
"""Short names of all codes."""
CODE_NAMES: Final = {row.code_id: row.code for row in _ROWS}
"""Full name of each code by its short name."""


def code_fraction(code_id: str, use: Use = "storage") -> CodeFraction:
    """Return what a code counts of the live load as seismic mass.

    Parameters
    ----------
    code_id : str
        One of `CODE_IDS`, in any case: "asce7-10", "ec8", "nzs1170.5", "nbc", ...
    use : {"storage", "archive", "assembly", "shop", "ordinary", "garage", "roof", "important"}, default "storage"
        As in `CodeFraction`. A code without a row of its own for archives has them in storage; for assembly, shops,
        roofs and important buildings in ordinary floors.

    Raises
    ------
    InvalidOption
        The code is not in the table, says nothing of this use, or its fractions are not known here.

    Examples
    --------
    >>> import seismass as sm
    >>> sm.codes.code_fraction("nbc", "storage").fraction
    0.6
    >>> sm.codes.code_fraction("ec8", "storage").status
    'second-hand'
    """
    wanted = known_id(code_id, CODE_IDS, "code")
    as_word(use, get_args(Use), "use", "code")
    rows = {row.use: row for row in _ROWS if row.code_id == wanted}
    unknown = all(math.isnan(row.fraction) for row in rows.values())
    if not unknown and use not in rows and _CLASS_OF.get(use) not in rows:
        raise refusal(InvalidOption, "use", f"code {wanted}", " or ".join(rows), use)
    if unknown:
        raise refusal(InvalidOption, "id", "code", "one whose fractions are known here, or state a fraction", wanted)
    return rows[use] if use in rows else replace(rows[_CLASS_OF[use]], use=use)


def code_table() -> pl.DataFrame:
    """Return one row per code and use.

    Returns
    -------
    polars.DataFrame
        Columns `code_id`, `code`, `use`, `fraction`, `low`, `high`, `clause`, `note`, `status`, `edition`, `checked`,
        as `CodeFraction` has them; fractions that are not known are null.
    """
    import polars as pl

    table = pl.DataFrame([asdict(row) | {"checked": row.checked} for row in _ROWS])
    return table.with_columns(pl.col("fraction", "low", "high").fill_nan(None))


def code_legend() -> str:
    """Return what `MARK` means, with the number of rows of each status.

    Examples
    --------
    >>> import seismass as sm
    >>> sm.codes.code_legend().partition(":")[0]
    '\N{DAGGER} not checked against the code'
    """
    counts = Counter(row.status for row in _ROWS)
    return (
        f"{MARK} {NOT_CHECKED}: {counts[SECOND_HAND]} of {len(_ROWS)} rows are second-hand, {counts[FROM_MEMORY]} from "
        f"memory, {counts[NOT_KNOWN]} empty; {counts[VERIFIED]} were read in the text named"
    )
