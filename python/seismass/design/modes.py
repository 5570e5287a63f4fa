"""Vibration modes of a shear building: periods, shapes, participation and effective masses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import ArrayLike

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.values import (
    FieldValue,
    FloatArray,
    as_array,
    as_number,
    as_positive,
    brief,
    frozen,
    refusal,
    short_repr,
)
from seismass.base.views import Card

if TYPE_CHECKING:
    import polars as pl

Combination: TypeAlias = Literal["srss", "cqc"]
"""How modal peaks are combined: root of the sum of squares, or complete quadratic combination."""


@dataclass(frozen=True, eq=False)
class Modes(FieldValue, Card):
    """Vibration modes of an undamped shear building, longest period first.

    Attributes
    ----------
    periods : ndarray, shape (modes,)
        Natural periods (s).
    shapes : ndarray, shape (floors, modes)
        Mode shapes with unit modal mass, positive at the roof.
    participation : ndarray, shape (modes,)
        Gamma_n = phi_n^T m 1.
    effective_mass : ndarray, shape (modes,)
        Gamma_n^2 (kg); they add up to the mass of the building.
    """

    periods: FloatArray
    shapes: FloatArray
    participation: FloatArray
    effective_mass: FloatArray

    @property
    def mass(self) -> float:
        """Mass of the building (kg): the sum of the effective masses."""
        return float(self.effective_mass.sum())

    def modes_needed(self, share: float = 0.90) -> int:
        """Return the number of modes whose effective masses add up to a share of the mass.

        Parameters
        ----------
        share : float, default 0.9
            Share of the mass, above 0 and up to 1. ASCE/SEI 7-10, 12.9.1, and Eurocode 8, 4.3.3.3.1, ask for 0.90.

        Raises
        ------
        InvalidOption
            The share is out of its range.
        """
        wanted = as_number(share, "share", "modes", InvalidOption)
        if not 0.0 < wanted <= 1.0:
            raise refusal(InvalidOption, "share", "modes", "above 0 and up to 1", f"{wanted:g}")
        reached = np.cumsum(self.effective_mass) / self.mass >= wanted * (1.0 - 1e-12)
        return int(np.argmax(reached)) + 1

    def table(self) -> pl.DataFrame:
        """Return one row per mode.

        Returns
        -------
        polars.DataFrame
            mode, from 1; period (s); frequency (Hz); participation, Gamma_n phi_n at the roof, which does not depend on
            how shapes are scaled; effective_mass (kg), effective_share, that over the mass, and cumulative_share; and
            floor_1, floor_2, ..., the shape with 1 at the roof.
        """
        import polars as pl

        roof = self.shapes[-1]
        columns: dict[str, FloatArray | list[int]] = {
            "mode": list(range(1, len(self.periods) + 1)),
            "period": self.periods,
            "frequency": 1.0 / self.periods,
            "participation": self.participation * roof,
            "effective_mass": self.effective_mass,
            "effective_share": self.effective_mass / self.mass,
            "cumulative_share": np.cumsum(self.effective_mass) / self.mass,
        }
        floors = {f"floor_{number}": row / roof for number, row in enumerate(self.shapes, start=1)}
        return pl.DataFrame(columns | floors, schema_overrides={"mode": pl.UInt32})


def vibration_modes(mass: ArrayLike, stiffness: ArrayLike, *, stiffness_matrix: ArrayLike | None = None) -> Modes:
    """Return the modes of a shear building, with walls beside its storeys where it has them.

    Parameters
    ----------
    mass, stiffness : array_like, shape (storeys,)
        Floor masses (kg) and storey stiffnesses (N/m), storey 1 first.
    stiffness_matrix : array_like, shape (storeys, storeys), optional
        Stiffness over the floors (N/m) beside the storeys, as a `Building` has it; a storey's stiffness may then be 0.

    Raises
    ------
    InvalidScene
        The lists differ in length, are empty, or hold a value that is not positive; or the matrix does not fit, is not
        symmetric, or leaves a displacement without stiffness.

    Examples
    --------
    >>> import seismass as sm
    >>> modes = sm.design.vibration_modes([1000.0, 1000.0, 1000.0], [553676.0, 553676.0, 553676.0])
    >>> modes.periods.round(4)
    array([0.6   , 0.2141, 0.1482])
    >>> modes.table()["cumulative_share"].round(3).to_list()
    [0.914, 0.989, 1.0]
    """
    m = positive(mass, "mass")
    k = positive(stiffness, "stiffness", or_zero=stiffness_matrix is not None)
    if len(m) != len(k):
        requirement = f"a list of {len(m)} values, one per storey"
        raise refusal(InvalidScene, "stiffness", "building", requirement, f"{len(k)} values")
    # M^(-1/2) K M^(-1/2) is symmetric and tridiagonal.
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        diagonal = (k + np.append(k[1:], 0.0)) / m
        off_diagonal = -k[1:] / (np.sqrt(m[1:]) * np.sqrt(m[:-1]))
    if not (np.isfinite(diagonal).all() and np.isfinite(off_diagonal).all()):
        requirement = "in a ratio to the stiffnesses that a double can hold"
        raise refusal(InvalidScene, "mass", "building", requirement, brief(m.tolist()))
    springs = np.diag(diagonal) + np.diag(off_diagonal, 1) + np.diag(off_diagonal, -1)
    if stiffness_matrix is None:
        squares, vectors = np.linalg.eigh(springs)
        vectors = np.asfortranarray(vectors)  # sums over floors then have the bits of those over LAPACK's own columns
    else:
        walls = checked_matrix(stiffness_matrix, len(m))
        squares, vectors = np.linalg.eigh(springs + walls / np.sqrt(m[:, None] * m[None, :]))
        if not squares[0] > 0.0:
            requirement = "positive definite together with the storeys"
            raise refusal(InvalidScene, "stiffness_matrix", "building", requirement, f"an eigenvalue {squares[0]:.3g}")
    shapes = vectors / np.sqrt(m)[:, None]
    shapes = shapes * np.where(shapes[-1] < 0.0, -1.0, 1.0)
    participation = m @ shapes
    return Modes(
        periods=frozen(2.0 * np.pi / np.sqrt(squares)),
        shapes=frozen(shapes),
        participation=frozen(participation),
        effective_mass=frozen(participation**2),
    )


def modal_correlation(periods: ArrayLike, damping: float) -> FloatArray:
    """Return the CQC correlation of modes of equal damping ratio, shape (modes, modes).

    Parameters
    ----------
    periods : array_like, shape (modes,)
        Natural periods (s).
    damping : float
        Ratio of critical damping.

    Notes
    -----
    Der Kiureghian (1981), Earthquake Engng Struct. Dyn. 9:419, for equal damping ratios.
    """
    t, damping = positive(periods, "periods"), as_number(damping, "damping", "modes", InvalidOption)
    r = t[:, None] / t[None, :]
    numerator = 8.0 * damping**2 * (1.0 + r) * r**1.5
    correlation: FloatArray = numerator / ((1.0 - r**2) ** 2 + 4.0 * damping**2 * r * (1.0 + r) ** 2)
    return correlation


def combined_modes(
    modal: ArrayLike, periods: ArrayLike, *, combination: Combination = "srss", damping: float = 0.05
) -> FloatArray:
    """Return the combined peaks of quantities whose modal peaks are known.

    Parameters
    ----------
    modal : array_like, shape (modes, quantities)
        Peak of each quantity in each mode, with the sign of the mode shape.
    periods : array_like, shape (modes,)
        Natural periods (s).
    combination : {"srss", "cqc"}, default "srss"
        SRSS, or CQC with equal damping in every mode.
    damping : float, default 0.05
        Ratio of critical damping for the correlation of modes in CQC.

    Returns
    -------
    ndarray, shape (quantities,)
        sqrt(sum over modes n, m of r_n rho_nm r_m); rho is the unit matrix for SRSS.

    Raises
    ------
    InvalidOption
        An argument is out of its range, or the shapes do not fit.

    Examples
    --------
    Modes of equal period have the correlation 1, so that CQC adds them:

    >>> import seismass as sm
    >>> sm.design.combined_modes([[3.0], [4.0]], [0.5, 0.5], combination="cqc").round(12).tolist()
    [7.0]
    >>> sm.design.combined_modes([[3.0], [4.0]], [0.5, 0.5]).tolist()
    [5.0]
    """
    owner = "modal combination"
    ratio = checked_combination(combination, damping, owner)
    peaks = as_array(modal, "modal", owner, InvalidOption, dimensions=2)
    t = as_array(periods, "periods", owner, InvalidOption)
    if len(t) != len(peaks):
        raise refusal(InvalidOption, "periods", owner, f"{len(peaks)} values, one per mode", f"{len(t)} values")
    if not (np.isfinite(t) & (t > 0.0)).all():
        raise refusal(InvalidOption, "periods", owner, "positive", brief(t.tolist()))
    return combine(peaks, t, combination, ratio)


def combine(modal: FloatArray, periods: FloatArray, combination: Combination, damping: float) -> FloatArray:
    """Return the combined peaks, shape (quantities,), of checked arguments."""
    correlation = np.eye(len(periods)) if combination == "srss" else modal_correlation(periods, damping)
    return frozen(np.sqrt(np.maximum(np.einsum("ni,nm,mi->i", modal, correlation, modal), 0.0)))


def checked_combination(combination: str, damping: float, owner: str) -> float:
    """Return the damping ratio; an unknown combination and a ratio out of range are refused."""
    as_word(combination, get_args(Combination), "combination", owner)
    ratio = as_number(damping, "damping", owner, InvalidOption)
    if not 0.0 < ratio < 1.0:
        raise refusal(InvalidOption, "damping", owner, "above 0 and below 1", f"{ratio:g}")
    return ratio


def checked_matrix(matrix: ArrayLike, storeys: int) -> FloatArray:
    """Return a stiffness over the floors (N/m); one of another shape, or that is not symmetric, is refused."""
    name, owner = "stiffness_matrix", "building"
    values = as_array(matrix, name, owner, InvalidScene, dimensions=2)
    if values.shape != (storeys, storeys):
        requirement = f"{storeys} lists of {storeys} values"
        raise refusal(InvalidScene, name, owner, requirement, " by ".join(map(str, values.shape)))
    if not np.isfinite(values).all() or not np.allclose(values, values.T, rtol=0.0, atol=1e-9 * np.abs(values).max()):
        raise refusal(InvalidScene, name, owner, "finite and symmetric", brief(values.tolist()))
    return values


def checked_heights(heights: FloatArray | None, owner: str) -> FloatArray:
    """Return the heights of a building; one that has none is refused."""
    if heights is None:
        raise refusal(InvalidScene, "heights", "building", f"given for a {owner}", "none")
    return heights


def positive(values: ArrayLike, name: str, *, or_zero: bool = False) -> FloatArray:
    """Return one positive number per storey, or zero where that is allowed; an empty list is refused."""
    array = as_array(values, name, "building", InvalidScene)
    if len(array) == 0:
        raise refusal(InvalidScene, name, "building", "a list of at least one value", "none")
    for number, value in enumerate(array, start=1):
        if not (np.isfinite(value) and (value > 0.0 or (or_zero and value == 0.0))):
            requirement = "zero or a positive number" if or_zero else "a positive number"
            raise refusal(InvalidScene, name, f"storey {number}", requirement, f"{value:g}")
    return array


def positive_of_length(values: ArrayLike, name: str, storeys: int) -> FloatArray:
    """Return one positive number per storey; one number stands for all of them."""
    array = as_array(values, name, "building", InvalidScene, or_number=True)
    values = array if array.ndim else np.full(storeys, float(array))
    array = positive(values, name)
    if len(array) != storeys:
        requirement = f"one number or a list of {storeys} values, one per storey"
        raise refusal(InvalidScene, name, "building", requirement, f"{len(array)} values")
    return array


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
        import polars as pl

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
        reduction, importance : float, optional
            R and I_e.
        base_shear : float, optional
            V of the equivalent lateral forces (N), by the same R and I_e; without it nothing is scaled up.
        share : float, optional
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
        import polars as pl

        columns = pl.DataFrame({"ordinate": self.ordinates, "base_shear": np.abs(self.modal_shear[:, 0])})
        return pl.concat([self.modes.table(), columns], how="horizontal")


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
    combination : {"srss", "cqc"}, default "srss"
        SRSS, or CQC with equal damping in every mode. Each quantity is combined from its own modal peaks.
    damping : float, default 0.05
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
    if not callable(spectrum):
        raise refusal(InvalidOption, "spectrum", owner, "a callable of periods", brief(spectrum))
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
    moment: FloatArray = np.cumsum((shear * heights)[..., ::-1], axis=-1)[..., ::-1]
    return moment
