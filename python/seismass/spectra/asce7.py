"""Design spectra of ASCE/SEI 7: the two-period shape of 7-10 and 7-16, and the multi-period table of 7-22."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_array, frozen, refusal
from seismass.spectra.checks import OWNER, positive
from seismass.spectra.period_table import PeriodTable

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
    at = as_array(periods, "periods", OWNER, InvalidOption)
    ordinates = as_array(sa_g, "sa_g", OWNER, InvalidOption)
    if len(at) < 2:
        raise refusal(InvalidOption, "periods", OWNER, "a list of at least two", str(len(at)))
    if len(ordinates) != len(at):
        raise refusal(InvalidOption, "sa_g", OWNER, f"a list of {len(at)} values, one per period", str(len(ordinates)))
    if not (np.isfinite(at).all() and at[0] >= 0.0 and (np.diff(at) > 0.0).all()):
        wrong = np.flatnonzero(~(np.isfinite(at) & (np.diff(at, prepend=-1e-300) > 0.0)) | (at < 0.0))
        raise refusal(InvalidOption, "periods", OWNER, "increasing from 0 or more", f"{at[wrong[0]]:g}")
    for value in ordinates:
        positive(float(value), "sa_g")
    return MultiPeriod(frozen(at), frozen(ordinates))
