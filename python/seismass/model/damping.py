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
        The modes are not two whole numbers from 1, or the ratio is not a number of at most 1.
    """

    ratio: float
    modes: tuple[int, int] = (1, 2)

    def __post_init__(self) -> None:
        modes: Any = self.modes
        if not (isinstance(modes, Sequence) and len(modes) == 2) or isinstance(modes, str):
            raise refusal(InvalidScene, "modes", "Rayleigh damping", "two mode numbers", brief(modes))
        checked = tuple(as_count(mode, "modes", "Rayleigh damping", InvalidScene, least=1) for mode in modes)
        object.__setattr__(self, "modes", checked)
        object.__setattr__(self, "ratio", _damping_ratio(self.ratio, "ratio", "Rayleigh damping"))


Damping: TypeAlias = float | Rayleigh | ArrayLike
"""A ratio in every mode, Rayleigh damping, or the matrix C itself (N s/m, floor coordinates, symmetric)."""


def read_damping(damping: Any) -> float | Rayleigh | FloatArray:
    """Return damping as a building holds it."""
    if isinstance(damping, Rayleigh):
        return damping
    if isinstance(damping, Real) or (isinstance(damping, np.ndarray) and damping.ndim == 0):
        return _damping_ratio(damping, "damping", "building")
    if damping is None or isinstance(damping, str | bytes):
        raise refusal(InvalidScene, "damping", "building", "a ratio, Rayleigh damping or a matrix", brief(damping))
    return as_array(damping, "damping", "building", InvalidScene, dimensions=2)


def _damping_ratio(value: Any, parameter: str, owner: str) -> float:
    """Return a ratio of critical damping; what is above 1 was meant in per cent, and the kernel refuses the rest."""
    ratio = as_number(value, parameter, owner, InvalidScene)
    if ratio > 1.0:
        raise refusal(InvalidScene, parameter, owner, "a ratio of at most 1 (0.05 for 5 %)", f"{ratio:g}")
    return ratio


def kernel_damping(damping: float | Rayleigh | FloatArray) -> dict[str, Any]:
    """Return damping as the kernel takes it."""
    if isinstance(damping, Rayleigh):
        return {"damping_ratio": damping.ratio, "rayleigh_modes": damping.modes}
    if isinstance(damping, np.ndarray):
        return {"damping_matrix": damping}
    return {"damping_ratio": damping}
