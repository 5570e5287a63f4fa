"""Effective fractions of many buildings by eta, among which the live page shows its own case."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

CASES: Final = 4928
"""Buildings behind the bins: those of `seismass map` with its default parameters."""


@dataclass(frozen=True)
class Bin:
    """Quantiles (16, 50 and 84 %) of the effective fraction of the buildings with eta = mu_k/C1 in a range, whose ends
    are None where it is open.
    """

    start: float
    end: float | None
    low: float
    median: float
    high: float

    @property
    def content(self) -> dict[str, Any]:
        """What the page takes."""
        return {"from": self.start, "to": self.end, "low": self.low, "median": self.median, "high": self.high}


BINS: Final = (
    Bin(0.0, 0.2, 0.0, 0.0, 0.03),
    Bin(0.2, 0.3, 0.0, 0.0, 0.13),
    Bin(0.3, 0.4, 0.0, 0.07, 0.24),
    Bin(0.4, 0.5, 0.0, 0.26, 0.41),
    Bin(0.5, 0.6, 0.09, 0.38, 0.55),
    Bin(0.6, 0.7, 0.28, 0.52, 0.68),
    Bin(0.7, 0.8, 0.48, 0.68, 0.84),
    Bin(0.8, 1.0, 0.68, 0.85, 0.95),
    Bin(1.0, 1.2, 0.87, 0.97, 1.0),
    Bin(1.2, 1.5, 0.94, 1.0, 1.0),
    Bin(1.5, 2.0, 0.99, 1.0, 1.0),
    Bin(2.0, None, 1.0, 1.0, 1.0),
)
"""The map of the built-in suite, as docs/effective_mass.md prints it, which `tools/pages` computes; a test compares
both."""
