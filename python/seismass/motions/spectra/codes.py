"""Design spectra of ASCE 7, Eurocode 8 and NZS 1170.5."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_array, as_number, frozen, refusal
from seismass.motions.elementary import power
from seismass.motions.spectra.elastic import OWNER, one_of, positive


@dataclass(frozen=True, eq=False)
class PeriodTable:
    """Sa (g) at increasing periods (s); a kind of table says how it goes between them."""

    periods: FloatArray
    sa_g: FloatArray

    @property
    def points(self) -> dict[str, list[float]]:
        """Periods and ordinates, for JSON."""
        return {"period": self.periods.tolist(), "sa_g": self.sa_g.tolist()}

    @property
    def shortest(self) -> float:
        """First period (s)."""
        return float(self.periods[0])

    @property
    def longest(self) -> float:
        """Last period (s)."""
        return float(self.periods[-1])


DEFAULT_SDS_G: Final = 1.07
"""Default S_DS (g): with the two below a stand-in for the Port of Long Beach, not its published spectrum."""
DEFAULT_SD1_G: Final = 0.61
"""Default S_D1 (g)."""
DEFAULT_TL: Final = 8.0
"""Default long-period transition T_L (s)."""
MULTI_PERIODS: Final = (
    *(0.0, 0.01, 0.02, 0.03, 0.05, 0.075, 0.1, 0.15, 0.2, 0.25, 0.3),
    *(0.4, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.5, 10.0),
)
"""The 22 periods (s) of ASCE/SEI 7-22, 11.4.5.1 (from the proposal of the 2020 NEHRP provisions)."""


@dataclass(frozen=True)
class TwoPeriod:
    """S_DS, S_D1 (g) and T_L (s)."""

    sds_g: float
    sd1_g: float
    tl: float
    shortest: float = 0.0
    longest: float = np.inf

    @property
    def label(self) -> str:
        """Name with the three numbers."""
        text = f"ASCE 7 shape, S_DS = {self.sds_g:g} g, S_D1 = {self.sd1_g:g} g, T_L = {self.tl:g} s"
        if (self.sds_g, self.sd1_g, self.tl) == (DEFAULT_SDS_G, DEFAULT_SD1_G, DEFAULT_TL):
            text += " (stand-in for the Port of Long Beach, not its published spectrum)"
        return text

    @property
    def parameters(self) -> dict[str, Any]:
        """The three numbers."""
        return {"shape": "asce7", "sds_g": self.sds_g, "sd1_g": self.sd1_g, "tl": self.tl}

    def __call__(self, periods: FloatArray) -> FloatArray:
        """Return Sa (m/s2)."""
        periods = as_array(periods, "periods", "target spectrum", InvalidOption, or_number=True)
        corner = self.sd1_g / self.sds_g
        t = np.maximum(periods, 0.2 * corner)
        falling = np.where(t <= self.tl, self.sd1_g / t, self.sd1_g * self.tl / t**2)
        rising = self.sds_g * np.minimum(0.4 + 0.6 * periods / (0.2 * corner), 1.0)
        return STANDARD_GRAVITY * np.where(t <= corner, rising, falling)


def two_period_shape(sds_g: float, sd1_g: float, tl: float) -> TwoPeriod:
    """Return the shape; S_DS, S_D1 and T_L are positive, and T_L is not below T_S."""
    shape = TwoPeriod(positive(sds_g, "sds_g"), positive(sd1_g, "sd1_g"), positive(tl, "tl"))
    corner = shape.sd1_g / shape.sds_g
    if shape.tl < corner:
        raise refusal(InvalidOption, "tl", OWNER, f"at least T_S = S_D1/S_DS = {corner:g} s", f"{shape.tl:g}")
    return shape


@dataclass(frozen=True, eq=False)
class MultiPeriod(PeriodTable):
    """Sa (g) at periods (s), linear between them."""

    @property
    def label(self) -> str:
        """Name with the number of periods."""
        if tuple(self.periods) == MULTI_PERIODS:
            return "ASCE 7-22 multi-period spectrum, 22 periods to 10 s"
        return (
            f"multi-period spectrum as in ASCE 7-22, {len(self.periods)} periods from {self.shortest:g} to "
            f"{self.longest:g} s, not the standard's 22"
        )

    @property
    def parameters(self) -> dict[str, Any]:
        """The table."""
        return {"shape": "asce7_multi_period", **self.points}

    def __call__(self, periods: FloatArray) -> FloatArray:
        """Return Sa (m/s2)."""
        return STANDARD_GRAVITY * np.interp(periods, self.periods, self.sa_g)


def multi_period_shape(periods: ArrayLike, sa_g: ArrayLike) -> MultiPeriod:
    """Return the shape; periods increase from 0 or more, and every Sa is positive."""
    grid = as_array(periods, "periods", OWNER, InvalidOption)
    ordinates = as_array(sa_g, "sa_g", OWNER, InvalidOption)
    if len(grid) < 2:
        raise refusal(InvalidOption, "periods", OWNER, "a list of at least two", str(len(grid)))
    if len(ordinates) != len(grid):
        raise refusal(
            InvalidOption, "sa_g", OWNER, f"a list of {len(grid)} values, one per period", str(len(ordinates))
        )
    if not (np.isfinite(grid).all() and grid[0] >= 0.0 and (np.diff(grid) > 0.0).all()):
        wrong = np.flatnonzero(~(np.isfinite(grid) & (np.diff(grid, prepend=-1e-300) > 0.0)) | (grid < 0.0))
        raise refusal(InvalidOption, "periods", OWNER, "increasing from 0 or more", f"{grid[wrong[0]]:g}")
    for value in ordinates:
        positive(float(value), "sa_g")
    return MultiPeriod(frozen(grid), frozen(ordinates))


class Ground(NamedTuple):
    """Soil factor S and the corner periods (s)."""

    s: float
    tb: float
    tc: float
    td: float


GROUNDS: Final = {
    1: {  # table 3.2
        "A": Ground(1.0, 0.15, 0.4, 2.0),
        "B": Ground(1.2, 0.15, 0.5, 2.0),
        "C": Ground(1.15, 0.20, 0.6, 2.0),
        "D": Ground(1.35, 0.20, 0.8, 2.0),
        "E": Ground(1.4, 0.15, 0.5, 2.0),
    },
    2: {  # table 3.3
        "A": Ground(1.0, 0.05, 0.25, 1.2),
        "B": Ground(1.35, 0.05, 0.25, 1.2),
        "C": Ground(1.5, 0.10, 0.25, 1.2),
        "D": Ground(1.8, 0.10, 0.30, 1.2),
        "E": Ground(1.6, 0.05, 0.25, 1.2),
    },
}
LEAST_ETA: Final = 0.55
"""Least damping correction, 3.2.2.2(3)."""


@dataclass(frozen=True)
class Eurocode8:
    """Type, ground type, a_gR (g), importance factor and damping ratio."""

    kind: int
    ground: str
    agr_g: float
    importance: float
    damping: float
    shortest: float = 0.0
    longest: float = 4.0

    @property
    def label(self) -> str:
        """Name with the numbers that differ from the usual."""
        text = f"Eurocode 8 elastic, type {self.kind}, ground {self.ground}, a_gR = {self.agr_g:g} g"
        if self.importance != 1.0:
            text += f", gamma_I = {self.importance:g}"
        return text if self.damping == 0.05 else f"{text}, {100.0 * self.damping:g} % damping"

    @property
    def parameters(self) -> dict[str, Any]:
        """The five arguments, and the numbers of the table."""
        return {
            "shape": "eurocode8",
            "type": self.kind,
            "ground": self.ground,
            "agr_g": self.agr_g,
            "importance": self.importance,
            "damping": self.damping,
            **GROUNDS[self.kind][self.ground]._asdict(),
        }

    def __call__(self, periods: FloatArray) -> FloatArray:
        """Return S_e(T) (m/s2) by equations (3.2) to (3.5)."""
        s, tb, tc, td = GROUNDS[self.kind][self.ground]
        eta = max(math.sqrt(10.0 / (5.0 + 100.0 * self.damping)), LEAST_ETA)
        t = np.maximum(periods, tb)
        rising = 1.0 + periods / tb * (2.5 * eta - 1.0)
        falling = 2.5 * eta * np.where(t <= tc, 1.0, np.where(t <= td, tc / t, tc * td / t**2))
        ratio = np.where(periods < tb, rising, falling)
        return STANDARD_GRAVITY * self.importance * self.agr_g * s * ratio


def eurocode8_shape(kind: Any, ground: Any, agr_g: Any, importance: Any, damping: Any) -> Eurocode8:
    """Return the shape; type and ground are those of the tables, the accelerations positive."""
    ratio = as_number(damping, "damping", OWNER, InvalidOption)
    if not 0.0 <= ratio < 1.0:
        raise refusal(InvalidOption, "damping", OWNER, "at least 0 and below 1", f"{ratio:g}")
    return Eurocode8(
        one_of(kind, "kind", tuple(GROUNDS)),
        one_of(ground, "ground", tuple(GROUNDS[1])),
        positive(agr_g, "agr_g"),
        positive(importance, "importance"),
        ratio,
    )


class Soil(NamedTuple):
    """C_h at T = 0, the plateau from 0.1 s, the branch a (b/T)^0.75, and c/T from 1.5 s, 3 c/T^2 from 3 s."""

    at_0: float
    plateau: float
    a: float
    b: float
    c: float


SOILS: Final = {
    "A": Soil(1.00, 2.35, 1.6, 0.5, 1.05),
    "B": Soil(1.00, 2.35, 1.6, 0.5, 1.05),
    "C": Soil(1.33, 2.93, 2.0, 0.5, 1.32),
    "D": Soil(1.12, 3.00, 2.4, 0.75, 2.14),
    "E": Soil(1.12, 3.00, 3.0, 1.0, 3.32),
}
NEAR_FAULT: Final = ((1.5, 2.0, 3.0, 4.0, 5.0), (1.0, 1.12, 1.36, 1.60, 1.72))
"""Periods (s) and N_max, linear between them, constant outside (table 3.7)."""
LEAST_R_NEAR_FAULT: Final = 0.75
"""N = 1 up to this return period factor, that of 250 years."""

LARGEST_ZR: Final = 0.7
"""Z R is not taken above this (3.1.1)."""


@dataclass(frozen=True)
class Nzs1170:
    """Site subsoil class, Z, R and the distance to a major fault (km)."""

    site_class: str
    z: float
    r: float
    fault_distance_km: float | None
    shortest: float = 0.0
    longest: float = np.inf

    @property
    def label(self) -> str:
        """Name with the numbers, and where they are from."""
        fault = "" if self.fault_distance_km is None else f", D = {self.fault_distance_km:g} km"
        capped = f", Z R taken as {LARGEST_ZR:g}" if self.z * self.r > LARGEST_ZR else ""
        return (
            f"NZS 1170.5 site class {self.site_class}, Z = {self.z:g}, R = {self.r:g}{capped}{fault} "
            "(C_h and N second-hand, not checked against the standard)"
        )

    @property
    def parameters(self) -> dict[str, Any]:
        """The four arguments, and where the coefficients are from."""
        return {
            "shape": "nzs1170",
            "site_class": self.site_class,
            "z": self.z,
            "r": self.r,
            "fault_distance_km": self.fault_distance_km,
            "coefficients": "second-hand, not checked against the standard",
        }

    def shape_factor(self, periods: FloatArray) -> FloatArray:
        """Return C_h(T)."""
        at_0, plateau, a, b, c = SOILS[self.site_class]
        t = np.maximum(periods, 0.1)
        middle = np.minimum(a * power(b / t, 0.75), plateau)
        falling = np.where(t <= 1.5, middle, np.where(t <= 3.0, c / t, 3.0 * c / t**2))
        return np.where(periods < 0.1, at_0 + (plateau - at_0) * periods / 0.1, falling)

    def near_fault_factor(self, periods: FloatArray) -> FloatArray:
        """Return N(T, D)."""
        if self.fault_distance_km is None or self.r <= LEAST_R_NEAR_FAULT:
            return np.ones_like(periods)
        share = min(max((20.0 - self.fault_distance_km) / 18.0, 0.0), 1.0)
        return 1.0 + (np.interp(periods, *NEAR_FAULT) - 1.0) * share

    def __call__(self, periods: FloatArray) -> FloatArray:
        """Return C(T) (m/s2)."""
        factor = min(self.z * self.r, LARGEST_ZR) * self.near_fault_factor(periods)
        return STANDARD_GRAVITY * factor * self.shape_factor(periods)


def nzs1170_shape(site_class: Any, z: Any, r: Any, fault_distance_km: Any) -> Nzs1170:
    """Return the shape; Z and R are positive, D is not negative."""
    distance = None
    if fault_distance_km is not None:
        distance = as_number(fault_distance_km, "fault_distance_km", OWNER, InvalidOption)
        if not (np.isfinite(distance) and distance >= 0.0):
            raise refusal(InvalidOption, "fault_distance_km", OWNER, "at least 0", f"{distance:g}")
    return Nzs1170(one_of(site_class, "site_class", tuple(SOILS)), positive(z, "z"), positive(r, "r"), distance)
