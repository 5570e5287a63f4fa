"""Damping of a building as users meet it: a ratio in every mode, Rayleigh damping, or a matrix."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any, Final, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidScene
from seismass.base.values import FloatArray, as_array, as_count, as_number, brief, refusal

DEFAULT_DAMPING: Final = 0.05
"""Ratio of critical damping in every vibration mode."""


@dataclass(frozen=True)
class Rayleigh:
    """Rayleigh damping C = a M + b K with the same ratio in two modes of the bare building.

    Parameters
    ----------
    ratio : float
        Ratio of critical damping in both modes, from 0 to 1: 0.05 for 5 %.
    modes : tuple of int
        The two modes, counted from 1.

    Raises
    ------
    InvalidScene
        The modes are not two whole numbers from 1, or the ratio is not a number. A building refuses a ratio
        that is not from 0 to 1, and modes that it does not have.
    """

    ratio: float
    modes: tuple[int, int] = (1, 2)

    def __post_init__(self) -> None:
        modes: Any = self.modes
        if not (isinstance(modes, Sequence) and len(modes) == 2) or isinstance(modes, str):
            raise refusal(InvalidScene, "modes", "Rayleigh damping", "two mode numbers", brief(modes))
        checked = tuple(as_count(mode, "modes", "Rayleigh damping", InvalidScene, least=1) for mode in modes)
        object.__setattr__(self, "modes", checked)
        object.__setattr__(self, "ratio", as_number(self.ratio, "ratio", "Rayleigh damping", InvalidScene))


Damping: TypeAlias = float | Rayleigh | ArrayLike
"""A ratio in every mode, Rayleigh damping, or the matrix C itself (N s/m, floor coordinates, symmetric)."""


def read_damping(damping: Any) -> float | Rayleigh | FloatArray:
    """Return damping as a building holds it; the kernel refuses a ratio out of range, such as 5 for 5 %."""
    if isinstance(damping, Rayleigh):
        return damping
    if isinstance(damping, Real) or (isinstance(damping, np.ndarray) and damping.ndim == 0):
        return as_number(damping, "damping", "building", InvalidScene)
    if damping is None or isinstance(damping, str | bytes):
        raise refusal(InvalidScene, "damping", "building", "a ratio, Rayleigh damping or a matrix", brief(damping))
    return as_array(damping, "damping", "building", InvalidScene, dimensions=2)


def kernel_damping(damping: float | Rayleigh | FloatArray) -> dict[str, Any]:
    """Return damping as the kernel takes it."""
    if isinstance(damping, Rayleigh):
        return {"damping_ratio": damping.ratio, "rayleigh_modes": damping.modes}
    if isinstance(damping, np.ndarray):
        return {"damping_matrix": damping}
    return {"damping_ratio": damping}
