"""The horizontal elastic response spectrum of EN 1998-1:2004, 3.2.2.2, types 1 and 2, with the recommended numbers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_number, refusal
from seismass.spectra.checks import OWNER, one_of, positive


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
