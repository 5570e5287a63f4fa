"""The elastic site spectrum of NZS 1170.5:2004, C(T) = C_h(T) Z R N(T, D), by the equations of its commentary.

The numbers are second-hand: two public programs agree on them, the limit of Z R is that of one; the standard was not
at hand.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np

from seismass.base.elementary import power
from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_number, refusal
from seismass.spectra.checks import OWNER, one_of, positive


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
