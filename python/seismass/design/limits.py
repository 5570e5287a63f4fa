"""Drift limits by risk category, the stability coefficient, and the check of storeys against both."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_array, as_positive, brief, frozen, is_one_of, known_id, refusal
from seismass.design.modes import positive, positive_of_length
from seismass.model.codes import CODE_NAMES, FROM_MEMORY, SECOND_HAND, VERIFIED


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


_CATEGORIES: Final = ("I", "II", "III", "IV")
_SOFT: Final = (
    "up to 4 storeys, with interior walls, partitions, ceilings and exterior walls that accommodate the drift; no "
    "limit for such structures of one storey"
)
_ASCE: Final = (
    ("other", (0.020, 0.020, 0.015, 0.010), "divided by rho for moment frames alone in categories D to F, 12.12.1.1"),
    ("low-rise-accommodating", (0.025, 0.025, 0.020, 0.015), _SOFT),
    ("masonry-cantilever-wall", (0.010,) * 4, ""),
    ("masonry-wall", (0.007,) * 4, ""),
)
_EC8_NOTE: Final = "alpha/nu with nu = 0.5 in classes I and II, 0.4 in III and IV; damage limitation"
_EC8: Final = (
    ("brittle-partitions", (0.005 / 0.5, 0.005 / 0.5, 0.005 / 0.4, 0.005 / 0.4), _EC8_NOTE),
    ("ductile-partitions", (0.0075 / 0.5, 0.0075 / 0.5, 0.0075 / 0.4, 0.0075 / 0.4), _EC8_NOTE),
    ("other", (0.010 / 0.5, 0.010 / 0.5, 0.010 / 0.4, 0.010 / 0.4), _EC8_NOTE + "; partitions that do not interfere"),
)
_AMPLIFIED, _DESIGN_FORCE = "C_d times elastic drift over I_e", "elastic drift under the design forces"
_TABLES: Final = (
    ("asce7-10", "12.12.1, table 12.12-1", VERIFIED, _AMPLIFIED, _ASCE),
    ("asce7-16", "12.12.1, table 12.12-1", FROM_MEMORY, _AMPLIFIED, _ASCE),
    ("asce7-22", "12.12.1, table 12.12-1", FROM_MEMORY, _AMPLIFIED, _ASCE),
    ("bnbc2017", "2.5.14.1, table 6.2.21", VERIFIED, _AMPLIFIED, _ASCE),
    ("ec8", "4.4.3.2(1)", SECOND_HAND, "q times elastic drift under the design forces", _EC8),
    (
        "nbc",
        "4.1.8.13(3)",
        FROM_MEMORY,
        "R_d R_o times elastic drift over I_E",
        (("other", (0.025, 0.025, 0.020, 0.010), "III: high importance, IV: post-disaster"),),
    ),
    (
        "nzs1170.5",
        "7.5.1",
        FROM_MEMORY,
        "drift in the ultimate limit state",
        (("other", (0.025,) * 4, "importance levels 1 to 4; the damage of partitions has a limit state of its own"),),
    ),
    (
        "as1170.4",
        "5.4.4",
        FROM_MEMORY,
        "drift in the ultimate limit state",
        (("other", (0.015,) * 4, "importance levels 1 to 4"),),
    ),
    ("is1893", "7.11.1.1", FROM_MEMORY, _DESIGN_FORCE, (("other", (0.004,) * 4, ""),)),
)
_LIMITS: Final = tuple(
    DriftLimit(code_id, CODE_NAMES[code_id], structure, category, ratio, quantity, clause, status, note)
    for code_id, clause, status, quantity, rows in _TABLES
    for structure, ratios, note in rows
    for category, ratio in zip(_CATEGORIES, ratios, strict=True)
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
    if not (np.isfinite(array) & (array >= 0.0)).all():
        raise refusal(InvalidOption, name, "storeys", "numbers of at least 0", brief(array.tolist()))
    return array
