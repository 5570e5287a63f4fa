"""R, Omega_0 and C_d of seismic force-resisting systems, and importance factors."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final

import polars as pl

from seismass.base.errors import InvalidOption
from seismass.base.values import is_one_of, known_id, refusal
from seismass.model.codes import VERIFIED


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


_GROUPS: Final = {
    "A": "bearing wall system",
    "B": "building frame system",
    "C": "moment-resisting frame",
    "D": "dual system with special moment frames",
    "E": "dual system with intermediate moment frames",
    "F": "shear wall-frame interactive system",
    "G": "cantilevered column system",
    "H": "steel system not detailed for seismic resistance",
}

# Line, R, Omega_0, C_d and system, in the order of the code.
_LINES: Final = """
A1 5 2.5 5 special reinforced concrete shear walls
A2 4 2.5 4 ordinary reinforced concrete shear walls
A3 2 2.5 2 detailed plain concrete shear walls
A4 1.5 2.5 1.5 ordinary plain concrete shear walls
A5 4 2.5 4 intermediate precast shear walls
A6 3 2.5 3 ordinary precast shear walls
A7 5 2.5 3.5 special reinforced masonry shear walls
A8 3.5 2.5 2.25 intermediate reinforced masonry shear walls
A9 2 2.5 1.75 ordinary reinforced masonry shear walls
A10 2 2.5 1.75 detailed plain masonry shear walls
A11 1.5 2.5 1.25 ordinary plain masonry shear walls
A12 1.5 2.5 1.75 prestressed masonry shear walls
A13 2 2.5 2 ordinary reinforced AAC masonry shear walls
A14 1.5 2.5 1.5 ordinary plain AAC masonry shear walls
A15 6.5 3 4 light-frame wood walls with structural panels or steel sheets
A16 6.5 3 4 light-frame cold-formed steel walls with structural panels or steel sheets
A17 2 2.5 2 light-frame walls with shear panels of all other materials
A18 4 2 3.5 light-frame cold-formed steel walls with flat strap bracing
B1 8 2 4 steel eccentrically braced frames
B2 6 2 5 steel special concentrically braced frames
B3 3.25 2 3.25 steel ordinary concentrically braced frames
B4 6 2.5 5 special reinforced concrete shear walls
B5 5 2.5 4.5 ordinary reinforced concrete shear walls
B6 2 2.5 2 detailed plain concrete shear walls
B7 1.5 2.5 1.5 ordinary plain concrete shear walls
B8 5 2.5 4.5 intermediate precast shear walls
B9 4 2.5 4 ordinary precast shear walls
B10 8 2.5 4 composite eccentrically braced frames
B11 5 2 4.5 composite special concentrically braced frames
B12 3 2 3 composite ordinary braced frames
B13 6.5 2.5 5.5 composite plate shear walls
B14 6 2.5 5 composite special shear walls
B15 5 2.5 4.5 composite ordinary shear walls
B16 5.5 2.5 4 special reinforced masonry shear walls
B17 4 2.5 4 intermediate reinforced masonry shear walls
B18 2 2.5 2 ordinary reinforced masonry shear walls
B19 2 2.5 2 detailed plain masonry shear walls
B20 1.5 2.5 1.25 ordinary plain masonry shear walls
B21 1.5 2.5 1.75 prestressed masonry shear walls
B22 7 2.5 4.5 light-frame wood walls with structural panels
B23 7 2.5 4.5 light-frame cold-formed steel walls with structural panels or steel sheets
B24 2.5 2.5 2.5 light-frame walls with shear panels of all other materials
B25 8 2.5 5 steel buckling-restrained braced frames
B26 7 2 6 steel special plate shear walls
C1 8 3 5.5 steel special moment frames
C2 7 3 5.5 steel special truss moment frames
C3 4.5 3 4 steel intermediate moment frames
C4 3.5 3 3 steel ordinary moment frames
C5 8 3 5.5 special reinforced concrete moment frames
C6 5 3 4.5 intermediate reinforced concrete moment frames
C7 3 3 2.5 ordinary reinforced concrete moment frames
C8 8 3 5.5 composite special moment frames
C9 5 3 4.5 composite intermediate moment frames
C10 6 3 5.5 composite partially restrained moment frames
C11 3 3 2.5 composite ordinary moment frames
C12 3.5 3 3.5 cold-formed steel special bolted moment frames
D1 8 2.5 4 steel eccentrically braced frames
D2 7 2.5 5.5 steel special concentrically braced frames
D3 7 2.5 5.5 special reinforced concrete shear walls
D4 6 2.5 5 ordinary reinforced concrete shear walls
D5 8 2.5 4 composite eccentrically braced frames
D6 6 2.5 5 composite special concentrically braced frames
D7 7.5 2.5 6 composite plate shear walls
D8 7 2.5 6 composite special shear walls
D9 6 2.5 5 composite ordinary shear walls
D10 5.5 3 5 special reinforced masonry shear walls
D11 4 3 3.5 intermediate reinforced masonry shear walls
D12 8 2.5 5 steel buckling-restrained braced frames
D13 8 2.5 6.5 steel special plate shear walls
E1 6 2.5 5 steel special concentrically braced frames
E2 6.5 2.5 5 special reinforced concrete shear walls
E3 3 3 2.5 ordinary reinforced masonry shear walls
E4 3.5 3 3 intermediate reinforced masonry shear walls
E5 5.5 2.5 4.5 composite special concentrically braced frames
E6 3.5 2.5 3 composite ordinary braced frames
E7 5 3 4.5 composite ordinary shear walls
E8 5.5 2.5 4.5 ordinary reinforced concrete shear walls
F 4.5 2.5 4 ordinary reinforced concrete moment frames with ordinary reinforced concrete shear walls
G1 2.5 1.25 2.5 steel special cantilever columns
G2 1.25 1.25 1.25 steel ordinary cantilever columns
G3 2.5 1.25 2.5 special reinforced concrete moment frames
G4 1.5 1.25 1.5 intermediate reinforced concrete moment frames
G5 1 1.25 1 ordinary reinforced concrete moment frames
G6 1.5 1.5 1.5 timber frames
H 3 3 3 all but cantilever columns
"""


def _read() -> dict[str, SystemFactors]:
    rows = {}
    for line in _LINES.strip().splitlines():
        system_id, r, omega_0, c_d, name = line.split(maxsplit=4)
        system = f"{_GROUPS[system_id[0]]}: {name}"
        numbers = (float(r), float(omega_0), float(c_d))
        rows[system_id] = SystemFactors(system_id, system, *numbers, "ASCE/SEI 7-10", "table 12.2-1", VERIFIED)
    return rows


_SYSTEMS: Final = _read()

_IMPORTANCE: Final = {"I": 1.0, "II": 1.0, "III": 1.25, "IV": 1.5}


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


def importance_factor(risk_category: str) -> float:
    """Return the seismic importance factor I_e of a risk category.

    Parameters
    ----------
    risk_category : {"I", "II", "III", "IV"}
        Risk category.

    Raises
    ------
    InvalidOption
        There is no such category.

    Notes
    -----
    ASCE/SEI 7-10, table 1.5-2: 1.00, 1.00, 1.25 and 1.50 (verified).
    """
    return _IMPORTANCE[known_category(risk_category)]


def known_category(risk_category: str) -> str:
    """Return a risk category in capitals; an unknown one is refused."""
    wanted = str(risk_category).strip().upper()
    if not is_one_of(wanted, _IMPORTANCE):
        raise refusal(InvalidOption, "risk_category", "building", "one of I, II, III, IV", repr(risk_category))
    return wanted
