"""The first-mode inelastic oscillator of a shear building from its pushover, and its ratio of deformations C_R."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, brief, refusal
from seismass.base.views import Card
from seismass.design.modes import vibration_modes
from seismass.model.building import Building, of_storeys_alone
from seismass.motions.spectra.inelastic import Oscillator


@dataclass(frozen=True)
class FirstModeOscillator(Card):
    """D'' + 2 zeta w D' + F(D) = -a_g with a trilinear F, per unit mass.

    Parameters
    ----------
    period : float
        Initial period T1 (s).
    yield_acceleration : float
        A_y (m/s2): F at the first yield, V_b1y/M1*. Infinite: elastic.
    overstrength, second_slope, third_slope : float, optional
        Second yield over the first, and slopes over the initial one.
    damping : float, default 0.05
        Ratio of critical damping.
    """

    period: float
    yield_acceleration: float
    overstrength: float = 1.0
    second_slope: float = 0.0
    third_slope: float = 0.0
    damping: float = 0.05

    @property
    def frequency(self) -> float:
        """Circular frequency w (rad/s)."""
        return 2.0 * np.pi / self.period

    @property
    def yield_deformation(self) -> float:
        """D_y = A_y/w^2 (m)."""
        return self.yield_acceleration / self.frequency**2

    @property
    def yield_coefficient(self) -> float:
        """A_y/g."""
        return self.yield_acceleration / STANDARD_GRAVITY

    @property
    def post_yield_slope(self) -> float:
        """Slope after the first yield over the initial one: r2, or r3 where both yields coincide."""
        return self.second_slope if self.overstrength > 1.0 else self.third_slope

    def of_spectrum(self) -> Oscillator:
        """Return the oscillator as inelastic spectra take it."""
        shape = (self.overstrength, self.second_slope, self.third_slope)
        return Oscillator(self.period, self.yield_acceleration, self.damping, *shape)

    @property
    def building(self) -> Building:
        """The oscillator as a building of one storey and 1 kg."""
        return Building.uniform(
            1,
            self.period,
            mass=1.0,
            yield_shear=self.yield_acceleration,
            overstrength=self.overstrength,
            second_slope=self.second_slope,
            third_slope=self.third_slope,
            damping=self.damping,
        )


def first_mode_oscillator(building: Building) -> FirstModeOscillator:
    """Return the first-mode oscillator of a shear building from its pushover under s = m phi_1.

    Parameters
    ----------
    building : Building
        The building; P-Delta is left out.

    Raises
    ------
    InvalidOption
        It is not a building, or has springs that are not trilinear with Masing unloading.

    Notes
    -----
    Storey shears are fixed shares of the base shear, V_i/V_b = sum_{j>=i} m_j phi_j / sum_j m_j phi_j, so that the
    pushover curve of base shear against roof displacement is the sum of the storeys' own curves: a polygon with a
    corner at each yield of a storey, in closed form. It is idealised by three lines: the initial slope; the corner
    (u_U, V_U) at which the first storey reaches its second yield, and the slope after it; and a first yield on the
    initial line with which the area below the curve up to u_U is kept. With M1* = L1^2/M1 and D = u_r/(Gamma_1 phi_r)
    the oscillator has F = V_b/M1*. Where all storeys yield at once the three lines are the curve.
    """
    if not isinstance(building, Building):
        raise refusal(InvalidOption, "building", "scaling", "a Building", brief(building))
    of_storeys_alone(building, "scaling by pushover")
    if building.laws:
        requirement = "of trilinear springs with Masing unloading, as those of the oscillator are"
        raise refusal(InvalidOption, "building", "scaling", requirement, ", ".join(building.laws))
    modes = vibration_modes(building.mass, building.stiffness)
    shape, period, modal_mass = modes.shapes[:, 0], float(modes.periods[0]), float(modes.effective_mass[0])
    loads = building.mass * shape
    shares = np.cumsum(loads[::-1])[::-1] / loads.sum()  # V_i / V_b
    damping = float(shape @ building.damping_matrix @ shape) * period / (4.0 * np.pi)
    if not np.isfinite(building.yield_shear).any():
        return FirstModeOscillator(period, np.inf, damping=damping)
    yield_shear, overstrength, second, third = _idealised(building, shares)
    return FirstModeOscillator(period, yield_shear / modal_mass, overstrength, second, third, damping)


def pushover_curve(building: Building, shares: FloatArray, base_shear: FloatArray) -> FloatArray:
    """Return the roof displacement (m) at base shears (N) below the first mechanism."""
    shear = shares[:, None] * np.asarray(base_shear)[None, :]
    drift = np.zeros_like(shear)
    for i in range(building.storeys):
        v_y, k = float(building.yield_shear[i]), float(building.stiffness[i])
        v_u = float(building.overstrength[i]) * v_y
        slopes = (1.0, float(building.second_slope[i]), float(building.third_slope[i]))
        for low, high, slope in ((0.0, v_y, slopes[0]), (v_y, v_u, slopes[1]), (v_u, np.inf, slopes[2])):
            if np.isfinite(low) and high > low:
                part = np.maximum(np.minimum(shear[i], high) - low, 0.0)
                drift[i] += np.where(part > 0.0, part / (k * slope) if slope > 0.0 else np.inf, 0.0)
    return np.asarray(drift.sum(axis=0))


def _idealised(building: Building, shares: FloatArray) -> tuple[float, float, float, float]:
    """Yield base shear (N), Omega, r2 and r3 of three lines for the pushover curve."""
    flat_at_once = np.where(building.second_slope > 0.0, building.overstrength, 1.0)
    ultimate = float(np.min(flat_at_once * building.yield_shear / shares))
    firsts = building.yield_shear / shares
    seconds = firsts * building.overstrength
    corners = np.concatenate([[0.0], firsts, seconds, [ultimate]])
    corners = np.unique(corners[corners <= ultimate])
    # Corners of one storey that rounding puts beside those of another are one.
    keep = np.append(np.diff(corners) > 1e-12 * ultimate, True)
    corners = corners[keep]
    corners[-1] = ultimate
    curve = pushover_curve(building, shares, corners)
    initial = float(1.0 / np.sum(shares / building.stiffness))  # N/m of base shear over roof displacement
    area = float(np.trapezoid(corners, curve))
    u, v = float(curve[-1]), float(corners[-1])
    slope_after = _slope_behind(building, shares, ultimate) / initial
    gap = u - v / initial
    if gap <= 1e-12 * u:  # the curve is straight up to there
        return v, 1.0, slope_after, slope_after
    first = (2.0 * area - v * u) / gap
    slope = (v - first) / (u - first / initial) / initial
    return first, v / first, slope, min(slope_after, slope)


def _slope_behind(building: Building, shares: FloatArray, base_shear: float) -> float:
    """Slope (N/m) of the curve just after a base shear."""
    larger_shear = shares * base_shear * (1.0 + 1e-9)
    v_y, v_u = building.yield_shear, building.overstrength * building.yield_shear
    slope = np.where(larger_shear > v_u, building.third_slope, np.where(larger_shear > v_y, building.second_slope, 1.0))
    if (slope == 0.0).any():
        return 0.0
    return float(1.0 / np.sum(shares / (slope * building.stiffness)))


def deformation_ratio(reduction: float, relative_period: float, slope: float) -> float:
    """Return C_R = 1 + [(L_R - 1)^-1 + (61/R_y^2.4 + 1.5)(T/T_c)^2.4]^-1, L_R = (1 + (R_y - 1)/slope)/R_y: Chopra and
    Chintanapakdee (2004), J. Struct. Eng. 130:1309, numbers from memory, unchecked.
    """
    if slope >= 1.0 or reduction <= 1.0:
        return 1.0
    growth: Any = (61.0 / reduction**2.4 + 1.5) * relative_period**2.4
    if slope > 0.0:
        limit = (1.0 + (reduction - 1.0) / slope) / reduction
        growth += 1.0 / (limit - 1.0)
    return float(1.0 + 1.0 / growth)
