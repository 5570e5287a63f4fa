"""The fraction of live load that codes count as seismic mass, each row with its clause and how it was verified.

A row of which any part was not read in the code itself says so: check it in the code before use.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from typing import TYPE_CHECKING, Final, Literal, TypeAlias, get_args

from seismass.base.errors import InvalidOption
from seismass.base.values import brief, is_one_of, known_id, refusal

if TYPE_CHECKING:
    import polars as pl

__all__ = [
    "AS_STATED",
    "CODE_IDS",
    "CODE_NAMES",
    "FROM_MEMORY",
    "MARK",
    "NOT_CHECKED",
    "SECOND_HAND",
    "VERIFIED",
    "CodeFraction",
    "Use",
    "code_fraction",
    "code_legend",
    "code_table",
]


def __dir__() -> list[str]:
    """Return the public names, for completion."""
    return list(__all__)


Use: TypeAlias = Literal["storage", "ordinary", "archive", "shop", "garage"]
"""Use of a floor: storage and warehouses, offices and dwellings, archives and libraries, shops, or car parks."""
_CLASS_OF: Final[dict[str, Use]] = {"archive": "storage", "shop": "ordinary"}
"""Use whose row counts where a code has none for a use; a car park has no such row."""

VERIFIED: Final = "verified"
SECOND_HAND: Final = "second-hand"
FROM_MEMORY: Final = "from memory, unverified"
"""Status of a row: read in the text named, read in a text that quotes it, or neither."""
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
    use : {"storage", "ordinary", "archive", "shop", "garage"}
        Storage and warehouses, offices and dwellings, archives and libraries, shops, or car parks.
    fraction : float
        Fraction of the design live load; the upper end where the code has a range.
    low, high : float
        The range; both equal `fraction` where there is none.
    clause : str
        Where the code says so; empty where that is not known.
    note : str
        Exceptions, and what else counts.
    status : {"verified", "second-hand", "from memory, unverified"}
        How the fraction was checked; the weakest of its parts.
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

    @property
    def checked(self) -> bool:
        """Whether the fraction was read in the code's own text, or stated by the user."""
        return self.status in (VERIFIED, AS_STATED)

    @property
    def mark(self) -> str:
        """`MARK` where the fraction was not checked against the code's text; else nothing."""
        return "" if self.checked else MARK


def _row(
    code_id: str, code: str, use: Use, fraction: float | tuple[float, float], clause: str, status: str, note: str = ""
) -> CodeFraction:
    low, high = fraction if isinstance(fraction, tuple) else (fraction, fraction)
    return CodeFraction(code_id, code, use, high, low, high, clause, note, status)


_ASCE_NOTE = (
    "a minimum; exempt are storage that adds at most 5 % to the seismic weight of its level, and floors of public "
    "garages and open parking structures; partitions, permanent equipment and part of the snow count besides"
)
_BNBC_NOTE = (
    "a minimum; 1.00 for permanent heavy equipment, retained liquid or any imposed load sustained in nature, and a "
    "higher share where loads at the time of the earthquake are more correctly assessed"
)
_GARAGES = "public garages and open parking structures are exempt"
_PAPER_NOTE = "as stated by the 16WCEE paper on rigid blocks in buildings"

_ROWS: Final = (
    _row("asce7-10", "ASCE/SEI 7-10", "storage", 0.25, "12.7.2, item 1", VERIFIED, _ASCE_NOTE),
    _row("asce7-10", "ASCE/SEI 7-10", "ordinary", 0.0, "12.7.2", VERIFIED, "partitions and equipment count"),
    _row("asce7-10", "ASCE/SEI 7-10", "garage", 0.0, "12.7.2, item 1b", VERIFIED, _GARAGES),
    _row("asce7-16", "ASCE/SEI 7-16", "storage", 0.25, "12.7.2, item 1", FROM_MEMORY, _ASCE_NOTE),
    _row("asce7-16", "ASCE/SEI 7-16", "ordinary", 0.0, "12.7.2", FROM_MEMORY, "partitions and equipment count"),
    _row("asce7-16", "ASCE/SEI 7-16", "garage", 0.0, "12.7.2, item 1b", FROM_MEMORY, _GARAGES),
    _row("asce7-22", "ASCE/SEI 7-22", "storage", 0.25, "12.7.2, item 1", SECOND_HAND, _ASCE_NOTE),
    _row("asce7-22", "ASCE/SEI 7-22", "ordinary", 0.0, "12.7.2", SECOND_HAND, "partitions and equipment count"),
    _row("asce7-22", "ASCE/SEI 7-22", "garage", 0.0, "12.7.2, item 1b", FROM_MEMORY, _GARAGES),
    _row(
        "asce7-10-racks",
        "ASCE/SEI 7-10, steel storage racks",
        "storage",
        0.67,
        "15.5.3.6",
        VERIFIED,
        "every level at 67 % of its rated load; a second case has the highest level alone at 100 %",
    ),
    _row(
        "rmi-mh16.1",
        "ANSI/RMI MH16.1",
        "storage",
        0.67,
        "W_s = 0.67 PL_RF PL + DL + 0.25 LL",
        SECOND_HAND,
        "of the product load, for PL_RF = 1; 0.25 of other live load; PL_RF is average over maximum product load "
        "down-aisle (from memory)",
    ),
    _row("asce61-14", "ASCE/COPRI 61-14, piers and wharves", "storage", 0.10, "", SECOND_HAND, _PAPER_NOTE),
    _row("aashto", "AASHTO LRFD bridge design", "storage", 0.0, "", SECOND_HAND, _PAPER_NOTE),
    _row("ubc-97", "UBC-97", "storage", 0.25, "1630.1.1", FROM_MEMORY, "a minimum; the ancestor of the ASCE rule"),
    _row("ubc-97", "UBC-97", "ordinary", 0.0, "1630.1.1", FROM_MEMORY),
    _row(
        "ec8",
        "Eurocode 8, EN 1998-1",
        "storage",
        0.8,
        "4.2.4",
        FROM_MEMORY,
        "phi psi_2 = 1.0 x 0.8; psi_2 was read in the source, phi = 1.0 of categories D to F is from memory",
    ),
    _row(
        "ec8",
        "Eurocode 8, EN 1998-1",
        "ordinary",
        (0.15, 0.30),
        "4.2.4",
        SECOND_HAND,
        "phi psi_2 with psi_2 = 0.3: phi 1.0 at the roof, 0.8 where occupancies are correlated, 0.5 where "
        "independent; psi_2 0.6 for assembly",
    ),
    _row(
        "ec8",
        "Eurocode 8, EN 1998-1",
        "shop",
        0.6,
        "4.2.4",
        FROM_MEMORY,
        "phi psi_2 = 1.0 x 0.6; psi_2 is second-hand, phi = 1.0 of category D is from memory",
    ),
    _row("nzs1170.5", "NZS 1170.5", "storage", 0.6, "4.2", FROM_MEMORY),
    _row("nzs1170.5", "NZS 1170.5", "ordinary", 0.3, "4.2", SECOND_HAND, "0 for roofs without public access"),
    _row("as1170.4", "AS 1170.4", "storage", 0.6, "", FROM_MEMORY),
    _row("as1170.4", "AS 1170.4", "ordinary", 0.3, "", FROM_MEMORY),
    _row(
        "nbc",
        "NBC of Canada",
        "storage",
        0.60,
        "4.1.8.2",
        SECOND_HAND,
        "with 25 % of the snow and the full contents of tanks",
    ),
    _row("nbc", "NBC of Canada", "ordinary", 0.0, "4.1.8.2", SECOND_HAND),
    _row("nbc", "NBC of Canada", "garage", 0.0, "4.1.8.2", FROM_MEMORY, "storage garages are exempt"),
    _row(
        "is1893",
        "IS 1893 (Part 1): 2016",
        "storage",
        0.50,
        "table 10",
        FROM_MEMORY,
        "live load above 3 kPa; the two fractions are second-hand, the limit of 3 kPa is from memory; roof 0",
    ),
    _row(
        "is1893",
        "IS 1893 (Part 1): 2016",
        "ordinary",
        0.25,
        "table 10",
        FROM_MEMORY,
        "live load up to 3 kPa; the two fractions are second-hand, the limit of 3 kPa is from memory; roof 0",
    ),
    _row("bnbc2017", "BNBC 2017, Bangladesh", "storage", 0.50, "2.5.7.3", VERIFIED, f"above 3 kPa; {_BNBC_NOTE}"),
    _row("bnbc2017", "BNBC 2017, Bangladesh", "ordinary", 0.25, "2.5.7.3", VERIFIED, f"up to 3 kPa; {_BNBC_NOTE}"),
    _row(
        "nch433",
        "NCh433, Chile",
        "storage",
        0.50,
        "",
        FROM_MEMORY,
        "a minimum, where crowding of people or things is usual",
    ),
    _row("nch433", "NCh433, Chile", "ordinary", 0.25, "", SECOND_HAND, "a minimum"),
    _row("nch433", "NCh433, Chile", "shop", (0.25, 0.50), "", FROM_MEMORY, "0.50 where crowding is usual"),
    _row("nch2369", "NCh2369, Chile, industrial", "storage", 0.50, "", FROM_MEMORY),
    _row("nch2369", "NCh2369, Chile, industrial", "ordinary", 0.25, "", FROM_MEMORY, "0 for roofs"),
    _row(
        "e030",
        "E.030, Peru",
        "storage",
        0.80,
        "art. 31 (2026), 26 (2018)",
        FROM_MEMORY,
        "of the total weight that can be stored; tanks 1.0",
    ),
    _row(
        "e030",
        "E.030, Peru",
        "ordinary",
        0.25,
        "art. 31 (2026), 26 (2018)",
        SECOND_HAND,
        "category C and roofs; 0.50 in categories A and B (from memory)",
    ),
    _row(
        "e030",
        "E.030, Peru",
        "shop",
        (0.25, 0.50),
        "art. 31 (2026), 26 (2018)",
        FROM_MEMORY,
        "0.50 in buildings of category B, shopping centres among them",
    ),
    _row("nsr-10", "NSR-10, Colombia", "storage", 0.25, "", FROM_MEMORY, "deposits and warehouses"),
    _row("nsr-10", "NSR-10, Colombia", "ordinary", 0.0, "", FROM_MEMORY),
    _row(
        "gb50011",
        "GB 50011, China",
        "storage",
        0.8,
        "5.1.3",
        FROM_MEMORY,
        "libraries and archives; 1.0 where the live load is taken as it is; snow 0.5",
    ),
    _row("gb50011", "GB 50011, China", "ordinary", 0.5, "5.1.3", SECOND_HAND, "roof live load 0"),
    _row(
        "japan-bsl",
        "Building Standard Law of Japan, Enforcement Order",
        "storage",
        1.0,
        "art. 85",
        FROM_MEMORY,
        "the actual load, at least 3.9 kPa in warehousing business",
    ),
    _row(
        "japan-bsl",
        "Building Standard Law of Japan, Enforcement Order",
        "ordinary",
        (0.28, 0.48),
        "art. 85",
        FROM_MEMORY,
        "a seismic live load of its own over that of floors: dwellings 0.6 of 1.8 kPa, offices 0.8 of 2.9, classrooms "
        "1.1 of 2.3, shops 1.3 of 2.9",
    ),
    _row("tbdy2018", "TBDY 2018, Turkey", "storage", 0.80, "table 4.3", SECOND_HAND),
    _row(
        "tbdy2018",
        "TBDY 2018, Turkey",
        "ordinary",
        0.30,
        "table 4.3",
        SECOND_HAND,
        "dwellings, offices, hotels, hospitals; 0.60 in schools, dormitories, halls for sport, cinemas, theatres, "
        "places of worship and restaurants",
    ),
    _row("tbdy2018", "TBDY 2018, Turkey", "shop", 0.60, "table 4.3", SECOND_HAND),
    _row("tbdy2018", "TBDY 2018, Turkey", "garage", 0.30, "table 4.3", SECOND_HAND, "car parks, with dwellings"),
    _row(
        "rpa99",
        "RPA 99/2003, Algeria",
        "storage",
        (0.50, 1.00),
        "coefficient beta",
        FROM_MEMORY,
        "0.50 in depots and hangars, where fraction = 0.5 states it; 1.00 in archives, libraries and tanks",
    ),
    _row(
        "rpa99",
        "RPA 99/2003, Algeria",
        "ordinary",
        0.20,
        "coefficient beta",
        FROM_MEMORY,
        "0.30 to 0.40 for assembly, 0.60 for other uses",
    ),
    _row("rpa99", "RPA 99/2003, Algeria", "archive", 1.0, "coefficient beta", FROM_MEMORY, "with libraries and tanks"),
    _row("rpa99", "RPA 99/2003, Algeria", "shop", 0.60, "coefficient beta", FROM_MEMORY, "one of the other uses"),
    _row("iran2800", "Iranian Standard 2800", "storage", 0.60, "", FROM_MEMORY, "storage and libraries"),
    _row("iran2800", "Iranian Standard 2800", "ordinary", 0.20, "", FROM_MEMORY, "0.40 in public buildings"),
    _row("iran2800", "Iranian Standard 2800", "shop", 0.40, "", FROM_MEMORY, "with public buildings"),
)

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
    use : {"storage", "ordinary", "archive", "shop", "garage"}, default "storage"
        Storage and warehouses, offices and dwellings, archives and libraries, shops, or car parks. A code without a row
        of its own for archives has them in storage, for shops in ordinary floors.

    Raises
    ------
    InvalidOption
        The code is not in the table, or says nothing of this use.

    Examples
    --------
    >>> import seismass as sm
    >>> sm.codes.code_fraction("nbc", "storage").fraction
    0.6
    >>> sm.codes.code_fraction("ec8", "storage").status
    'from memory, unverified'
    """
    wanted = known_id(code_id, CODE_IDS, "code")
    if not is_one_of(use, get_args(Use)):
        raise refusal(InvalidOption, "use", "code", f"one of {', '.join(get_args(Use))}", brief(use))
    rows = {row.use: row for row in _ROWS if row.code_id == wanted}
    if use not in rows and _CLASS_OF.get(use) not in rows:
        raise refusal(InvalidOption, "use", f"code {wanted}", " or ".join(rows), use)
    return rows[use] if use in rows else replace(rows[_CLASS_OF[use]], use=use)


def code_table() -> pl.DataFrame:
    """Return one row per code and use.

    Returns
    -------
    polars.DataFrame
        Columns `code_id`, `code`, `use`, `fraction`, `low`, `high`, `clause`, `note`, `status`, `checked`, as
        `CodeFraction` has them.
    """
    import polars as pl

    return pl.DataFrame([asdict(row) | {"checked": row.checked} for row in _ROWS])


def code_legend() -> str:
    """Return what `MARK` means, with the number of rows of each status.

    Examples
    --------
    >>> import seismass as sm
    >>> sm.codes.code_legend().partition(":")[0]
    '\N{DAGGER} not checked against the code'
    """
    counts = {status: sum(row.status == status for row in _ROWS) for status in (VERIFIED, SECOND_HAND, FROM_MEMORY)}
    return (
        f"{MARK} {NOT_CHECKED}: {counts[SECOND_HAND]} of {len(_ROWS)} rows are second-hand, {counts[FROM_MEMORY]} from "
        f"memory; {counts[VERIFIED]} were read in the text named"
    )
