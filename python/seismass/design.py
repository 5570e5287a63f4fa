"""Strengths as a designer finds them: vibration modes and response spectrum analysis of a shear building."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

import numpy as np
from numpy.typing import ArrayLike

from seismass._values import FloatArray, as_array, as_number, brief, frozen, refusal
from seismass.errors import InvalidOption, InvalidScene

Combination: TypeAlias = Literal["srss", "cqc"]
"""How modal peaks are combined: root of the sum of squares, or complete quadratic combination."""


@dataclass(frozen=True, eq=False)
class Modes:
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


@dataclass(frozen=True, eq=False)
class SpectrumAnalysis:
    """Result of a response spectrum analysis.

    Attributes
    ----------
    modes : Modes
        The modes, one per floor.
    ordinates : ndarray, shape (modes,)
        Pseudo-acceleration (m/s2) at each modal period.
    modal_shear : ndarray, shape (modes, storeys)
        Peak storey shear of each mode (N), with the sign of its shape.
    storey_shear : ndarray, shape (storeys,)
        Combined elastic storey shear V_e (N).
    """

    modes: Modes
    ordinates: FloatArray
    modal_shear: FloatArray
    storey_shear: FloatArray


def vibration_modes(mass: ArrayLike, stiffness: ArrayLike) -> Modes:
    """Return the modes of a shear building.

    Parameters
    ----------
    mass, stiffness : array_like, shape (storeys,)
        Floor masses (kg) and storey stiffnesses (N/m), storey 1 first.

    Raises
    ------
    InvalidScene
        The lists differ in length, are empty, or hold a value that is not positive.
    """
    m, k = _positive(mass, "mass"), _positive(stiffness, "stiffness")
    if len(m) != len(k):
        requirement = f"a list of {len(m)} values, one per storey"
        raise refusal(InvalidScene, "stiffness", "building", requirement, f"{len(k)} values")
    from scipy.linalg import eigh_tridiagonal  # slow to import

    # M^(-1/2) K M^(-1/2) is symmetric and tridiagonal.
    diagonal = (k + np.append(k[1:], 0.0)) / m
    beside = -k[1:] / np.sqrt(m[1:] * m[:-1])
    squares, vectors = eigh_tridiagonal(diagonal, beside)
    shapes = vectors / np.sqrt(m)[:, None]
    shapes = shapes * np.where(shapes[-1] < 0.0, -1.0, 1.0)
    participation = m @ shapes
    return Modes(
        periods=frozen(2.0 * np.pi / np.sqrt(squares)),
        shapes=frozen(shapes),
        participation=frozen(participation),
        effective_mass=frozen(participation**2),
    )


def response_spectrum_analysis(
    mass: ArrayLike,
    stiffness: ArrayLike,
    spectrum: Callable[[FloatArray], ArrayLike],
    *,
    combination: Combination = "srss",
    damping: float = 0.05,
) -> SpectrumAnalysis:
    """Return the elastic storey shears V_e of a shear building under a pseudo-acceleration spectrum.

    Parameters
    ----------
    mass, stiffness : array_like, shape (storeys,)
        Floor masses (kg) and storey stiffnesses (N/m), storey 1 first.
    spectrum : callable
        Takes the modal periods (s), returns the pseudo-acceleration (m/s2) at each.
    combination : {"srss", "cqc"}
        SRSS, or CQC with equal damping in every mode.
    damping : float
        Ratio of critical damping for the correlation of modes in CQC.

    Raises
    ------
    InvalidScene, InvalidOption
        An argument is out of its range.

    Notes
    -----
    V_in = sum over floors j >= i of Gamma_n m_j phi_jn A_n (Chopra, Dynamics of Structures, chapter 13); CQC with the
    correlation of Der Kiureghian (1981), Earthquake Engng Struct. Dyn. 9:419, for equal damping ratios.
    """
    if combination not in get_args(Combination):
        raise refusal(InvalidOption, "combination", "response spectrum analysis", "srss or cqc", brief(combination))
    ratio = as_number(damping, "damping", "response spectrum analysis", InvalidOption)
    if not 0.0 < ratio < 1.0:
        raise refusal(InvalidOption, "damping", "response spectrum analysis", "above 0 and below 1", f"{ratio:g}")
    modes = vibration_modes(mass, stiffness)
    ordinates = as_array(spectrum(modes.periods), "spectrum", "response spectrum analysis", InvalidOption)
    if ordinates.shape != modes.periods.shape or not (np.isfinite(ordinates) & (ordinates >= 0.0)).all():
        requirement = f"{len(modes.periods)} values of at least zero, one per period"
        raise refusal(InvalidOption, "spectrum", "response spectrum analysis", requirement, brief(ordinates))
    forces = (modes.participation * ordinates) * modes.shapes * np.asarray(mass, dtype=np.float64)[:, None]
    modal_shear = np.cumsum(forces[::-1], axis=0)[::-1].T
    correlation = np.eye(len(ordinates)) if combination == "srss" else modal_correlation(modes.periods, ratio)
    combined = np.sqrt(np.einsum("ni,nm,mi->i", modal_shear, correlation, modal_shear))
    return SpectrumAnalysis(modes, ordinates, frozen(modal_shear), frozen(combined))


def modal_correlation(periods: ArrayLike, damping: float) -> FloatArray:
    """Return the CQC correlation of modes of equal damping ratio, shape (modes, modes)."""
    t = np.asarray(periods, dtype=np.float64)
    r = t[:, None] / t[None, :]
    numerator = 8.0 * damping**2 * (1.0 + r) * r**1.5
    correlation: FloatArray = numerator / ((1.0 - r**2) ** 2 + 4.0 * damping**2 * r * (1.0 + r) ** 2)
    return correlation


def _positive(values: ArrayLike, name: str) -> FloatArray:
    array = as_array(values, name, "building", InvalidScene)
    if len(array) == 0:
        raise refusal(InvalidScene, name, "building", "a list of at least one value", "none")
    for number, value in enumerate(array, start=1):
        if not (np.isfinite(value) and value > 0.0):
            raise refusal(InvalidScene, name, f"storey {number}", "a positive number", f"{value:g}")
    return array
