"""Modes of a shear building with the masses that take part in them."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh

from seismass._values import FloatArray, frozen
from seismass.scene import Building


def shear_modes(building: Building) -> tuple[FloatArray, FloatArray]:
    """Return natural frequencies (rad/s), lowest first, and mass-normalised modes as columns."""
    k = building.stiffness
    stiffness = np.diag(k + np.append(k[1:], 0.0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    squares, modes = eigh(stiffness, np.diag(building.mass))
    return frozen(np.sqrt(squares)), frozen(modes)


def mass_participation(building: Building) -> tuple[FloatArray, FloatArray]:
    """Return natural periods (s), longest first, and the share of the mass of each mode, which sum to 1."""
    frequencies, modes = shear_modes(building)
    shares = (modes.T @ building.mass) ** 2 / building.mass.sum()
    return frozen(2.0 * np.pi / frequencies), frozen(shares)
