"""Equivalent lateral forces: the seismic response coefficient and the distribution of the base shear over height."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Final, Literal, TypeAlias

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.arguments import known_id
from seismass.base.errors import InvalidOption
from seismass.base.files import stored_rows
from seismass.base.values import FloatArray, as_flag, as_positive, frozen
from seismass.base.views import Card
from seismass.design.modes import moments, positive, positive_of_length
from seismass.model.codes import CODE_NAMES

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


_RULES: Final = tuple(
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
DISTRIBUTION_CODES: Final = tuple(rule.code_id for rule in _RULES)
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
    rule = next(row for row in _RULES if row.code_id == code)
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
    return pl.DataFrame([asdict(rule) for rule in _RULES])
