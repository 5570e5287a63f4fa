"""The address of a case of the live page, as `caseOf` of case.js reads it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

MOST_STOREYS: Final = 4
"""Storeys that the page solves."""
PAGE: Final = "explorer.html"
"""File that `seismass explore` writes."""
RECORD: Final = "synthetic-1"
LIMITS: Final = {
    "T": (0.05, 5.0),
    "z": (0.0, 0.5),
    "O": (1.0, 10.0),
    "r2": (0.0, 1.0),
    "h": (0.5, 20.0),
    "V": (0.001, 20.0),
    "a": (0.0, 10.0),
    "s": (0.0, 5.0),
    "k": (0.0, 5.0),
    "c": (0.0, 1.0),
}
"""Range of each number, by its letters in the address: `LIMITS` of case.js."""


@dataclass(frozen=True)
class LiveCase:
    """A building as the live page has it: equal floor masses, stiffnesses, heights (m) and springs; strengths V_y over
    the weight without goods (empty: elastic), goods over floor mass with friction by floor.
    """

    period: float
    damping: float
    overstrength: float
    second_slope: float
    height: float
    strength: Sequence[float]
    mass_ratio: Sequence[float]
    mu_s: Sequence[float]
    mu_k: Sequence[float]
    counted: float

    @property
    def numbers(self) -> dict[str, Sequence[float]]:
        """What the address says, by its letters."""
        alone = {"T": self.period, "z": self.damping, "O": self.overstrength, "r2": self.second_slope, "h": self.height}
        lists = {"a": self.mass_ratio, "s": self.mu_s, "k": self.mu_k}
        lists |= {"V": self.strength} if self.strength else {}
        return {**{key: [value] for key, value in alone.items()}, "c": [self.counted], **lists}

    @property
    def beyond(self) -> tuple[str, ...]:
        """Letters of the numbers that the page does not take."""
        found = self.numbers.items()
        return tuple(key for key, values in found if not all(LIMITS[key][0] <= one <= LIMITS[key][1] for one in values))

    @property
    def address(self) -> str:
        """What follows the # of the address."""
        by = "hand" if self.strength else "elastic"
        parts = ["v=1", f"by={by}", f"m={RECORD}", "d=code", f"n={len(self.mass_ratio)}", "x=1"]
        parts += [f"{key}={','.join(f'{value:.10g}' for value in values)}" for key, values in self.numbers.items()]
        return "&".join(parts)
