"""Response spectrum analysis of a building: displacements, drifts, shears and overturning moments."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, as_array, as_positive, brief, frozen, refusal, short_repr
from seismass.base.views import Card
from seismass.design.modes import (
    Combination,
    Modes,
    checked_combination,
    combine,
    positive_of_length,
    vibration_modes,
)

MODAL_BASE_SHEAR_SHARE: Final = 0.85
"""Share of the base shear of lateral forces that a modal one must reach: ASCE/SEI 7-10, 12.9.4.1 (verified)."""


@dataclass(frozen=True, eq=False)
class DesignDemand(Card):
    """Demands of a response spectrum analysis for the design.

    Attributes
    ----------
    shear : ndarray, shape (storeys,)
        Storey shears (N).
    drift : ndarray, shape (storeys,)
        Elastic storey drifts under the forces before they were scaled up (m).
    overturning : ndarray, shape (storeys,), or None
        Overturning moments at the foot of each storey (N m); None without heights.
    scale : float
        What forces were scaled up by, 1 or more.
    """

    shear: FloatArray
    drift: FloatArray
    overturning: FloatArray | None
    scale: float


@dataclass(frozen=True, eq=False)
class SpectrumAnalysis(Card):
    """Result of a response spectrum analysis: elastic peaks, not reduced by R.

    Attributes
    ----------
    modes : Modes
        The modes, one per floor.
    ordinates : ndarray, shape (modes,)
        Pseudo-acceleration (m/s2) at each modal period.
    modal_shear : ndarray, shape (modes, storeys)
        Peak storey shear of each mode (N), with the sign of its shape.
    storey_shear : ndarray, shape (storeys,)
        Combined elastic storey shear V_e (N), of springs and walls together.
    spring_shear : ndarray, shape (storeys,)
        Combined elastic force of each storey spring (N); without walls it is the storey shear.
    wall_shear : ndarray, shape (storeys,)
        Combined elastic shear of the walls in each storey (N); zero without walls. Each is combined from its own modal
        peaks, so that they do not add up to the storey shear.
    modal_drift : ndarray, shape (modes, storeys)
        Peak storey drift of each mode (m), with the sign of its shape.
    storey_drift : ndarray, shape (storeys,)
        Combined elastic storey drift (m).
    displacement : ndarray, shape (floors,)
        Combined displacement of each floor relative to the ground (m).
    heights : ndarray, shape (storeys,), or None
        Storey heights (m), as given.
    overturning : ndarray, shape (storeys,), or None
        Combined overturning moment at the foot of each storey (N m), without P-Delta; None without heights.
    """

    modes: Modes
    ordinates: FloatArray
    modal_shear: FloatArray
    storey_shear: FloatArray
    spring_shear: FloatArray
    wall_shear: FloatArray
    modal_drift: FloatArray
    storey_drift: FloatArray
    displacement: FloatArray
    heights: FloatArray | None
    overturning: FloatArray | None

    __repr__ = short_repr

    @property
    def base_shear(self) -> float:
        """Combined elastic base shear (N)."""
        return float(self.storey_shear[0])

    def table(self) -> pl.DataFrame:
        """Return one row per storey.

        Returns
        -------
        polars.DataFrame
            storey, from 1; shear (N), and the parts spring_shear and wall_shear where there are walls; drift and
            displacement of the floor above (m); drift_ratio and overturning (N m), null without heights.
        """
        nothing = [None] * len(self.storey_shear)
        parts = {"spring_shear": self.spring_shear, "wall_shear": self.wall_shear} if self.wall_shear.any() else {}
        return pl.DataFrame(
            {
                "storey": list(range(1, len(self.storey_shear) + 1)),
                "shear": self.storey_shear,
                **parts,
                "drift": self.storey_drift,
                "displacement": self.displacement,
                "drift_ratio": nothing if self.heights is None else self.storey_drift / self.heights,
                "overturning": nothing if self.overturning is None else self.overturning,
            },
            schema_overrides={"storey": pl.UInt32, "drift_ratio": pl.Float64, "overturning": pl.Float64},
        )

    def for_design(
        self,
        reduction: float,
        *,
        importance: float = 1.0,
        base_shear: float | None = None,
        share: float = MODAL_BASE_SHEAR_SHARE,
    ) -> DesignDemand:
        """Return shears, drifts and moments divided by R/I_e, and scaled up to the base shear of lateral forces.

        Parameters
        ----------
        reduction, importance : float
            R and I_e.
        base_shear : float, optional
            V of the equivalent lateral forces (N), by the same R and I_e; without it nothing is scaled up.
        share : float
            Share of V below which forces are scaled up to it: 0.85 in ASCE/SEI 7-10.

        Raises
        ------
        InvalidOption
            A number is not positive.

        Notes
        -----
        ASCE/SEI 7-10, 12.9.2 and 12.9.4.1 (verified): forces by I_e/R, then by 0.85 V/V_t where V_t is smaller than
        0.85 V. Drifts are those under the forces before they are scaled up; times C_d/I_e they are the design drifts.
        The share of ASCE/SEI 7-16 and 7-22 is 1.0 (second-hand).
        """
        factors = {"reduction": reduction, "importance": importance, "share": share}
        if base_shear is not None:
            factors["base_shear"] = base_shear
        for name, value in factors.items():
            as_positive(value, name, "design", InvalidOption)
        factor = importance / reduction
        least = 0.0 if base_shear is None else share * base_shear
        scale = max(least / (factor * self.base_shear), 1.0) if self.base_shear > 0.0 else 1.0
        return DesignDemand(
            shear=frozen(scale * factor * self.storey_shear),
            drift=frozen(factor * self.storey_drift),
            overturning=None if self.overturning is None else frozen(scale * factor * self.overturning),
            scale=scale,
        )

    def mode_table(self) -> pl.DataFrame:
        """Return `Modes.table` with the ordinate (m/s2) and the modal base shear (N) of each mode."""
        own = pl.DataFrame({"ordinate": self.ordinates, "base_shear": np.abs(self.modal_shear[:, 0])})
        return pl.concat([self.modes.table(), own], how="horizontal")


def response_spectrum_analysis(
    mass: ArrayLike,
    stiffness: ArrayLike,
    spectrum: Callable[[FloatArray], ArrayLike],
    *,
    combination: Combination = "srss",
    damping: float = 0.05,
    heights: ArrayLike | None = None,
    stiffness_matrix: ArrayLike | None = None,
) -> SpectrumAnalysis:
    """Return the elastic peaks of a shear building, with or without walls, under a pseudo-acceleration spectrum.

    Parameters
    ----------
    mass, stiffness : array_like, shape (storeys,)
        Floor masses (kg) and storey stiffnesses (N/m), storey 1 first.
    spectrum : callable
        Takes the modal periods (s), returns the pseudo-acceleration (m/s2) at each, as a `TargetSpectrum` does.
    combination : {"srss", "cqc"}
        SRSS, or CQC with equal damping in every mode. Each quantity is combined from its own modal peaks.
    damping : float
        Ratio of critical damping for the correlation of modes in CQC.
    heights : array_like, optional
        Storey heights (m); one number stands for all storeys. With them overturning moments and drift ratios are known.
    stiffness_matrix : array_like, shape (storeys, storeys), optional
        Stiffness over the floors (N/m) beside the storeys, as a `Building` has it: walls.

    Raises
    ------
    InvalidScene, InvalidOption
        An argument is out of its range.

    Notes
    -----
    V_in = sum over floors j >= i of Gamma_n m_j phi_jn A_n, drift V_in/k_i, M_in = sum over storeys j >= i of V_jn h_j
    (Chopra, Dynamics of Structures, chapter 13); CQC with the correlation of Der Kiureghian (1981), Earthquake Engng
    Struct. Dyn. 9:419, for equal damping ratios. All modes are used. With walls, displacements are Gamma_n phi_jn
    A_n/w_n^2, springs have k_i times the drift, and the walls the rest of the storey shear.

    Examples
    --------
    >>> import seismass as sm
    >>> target = sm.TargetSpectrum.asce7()
    >>> found = sm.design.response_spectrum_analysis([1e5, 1e5], [4e7, 4e7], target, heights=3.5)
    >>> found.table().columns
    ['storey', 'shear', 'drift', 'displacement', 'drift_ratio', 'overturning']
    """
    owner = "response spectrum analysis"
    ratio = checked_combination(combination, damping, owner)
    modes = vibration_modes(mass, stiffness, stiffness_matrix=stiffness_matrix)
    storeys = len(modes.periods)
    h = None if heights is None else positive_of_length(heights, "heights", storeys)
    ordinates = as_array(spectrum(modes.periods), "spectrum", owner, InvalidOption)
    if ordinates.shape != modes.periods.shape or not (np.isfinite(ordinates) & (ordinates >= 0.0)).all():
        requirement = f"{storeys} values of at least zero, one per period"
        raise refusal(InvalidOption, "spectrum", owner, requirement, brief(ordinates))
    forces = (modes.participation * ordinates) * modes.shapes * np.asarray(mass, dtype=np.float64)[:, None]
    shear = np.cumsum(forces[::-1], axis=0)[::-1].T
    if stiffness_matrix is None:
        drift, of_springs = shear / np.asarray(stiffness, dtype=np.float64), shear
    else:
        floors = (modes.participation * ordinates * (modes.periods / (2.0 * np.pi)) ** 2) * modes.shapes
        drift = np.diff(floors, axis=0, prepend=0.0).T
        of_springs = drift * np.asarray(stiffness, dtype=np.float64)

    def combined(modal: FloatArray) -> FloatArray:
        return combine(modal, modes.periods, combination, ratio)

    return SpectrumAnalysis(
        modes=modes,
        ordinates=ordinates,
        modal_shear=frozen(shear),
        storey_shear=combined(shear),
        spring_shear=combined(of_springs),
        wall_shear=combined(shear - of_springs),
        modal_drift=frozen(drift),
        storey_drift=combined(drift),
        displacement=combined(np.cumsum(drift, axis=1)),
        heights=h,
        overturning=None if h is None else combined(moments(shear, h)),
    )


def moments(shear: FloatArray, heights: FloatArray) -> FloatArray:
    """Return the overturning moment (N m) at the foot of each storey, shape of `shear`: (..., storeys)."""
    found: FloatArray = np.cumsum((shear * heights)[..., ::-1], axis=-1)[..., ::-1]
    return found
