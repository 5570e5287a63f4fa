"""What target spectra by a table have in common; those by a formula are in the files of their codes."""

from __future__ import annotations

from dataclasses import dataclass

from seismass.base.values import FloatArray


@dataclass(frozen=True, eq=False)
class PeriodTable:
    """Sa (g) at increasing periods (s); a kind of table says how it goes between them."""

    periods: FloatArray
    sa_g: FloatArray

    @property
    def points(self) -> dict[str, list[float]]:
        """Periods and ordinates, for JSON."""
        return {"period": self.periods.tolist(), "sa_g": self.sa_g.tolist()}

    @property
    def shortest(self) -> float:
        """First period (s)."""
        return float(self.periods[0])

    @property
    def longest(self) -> float:
        """Last period (s)."""
        return float(self.periods[-1])
