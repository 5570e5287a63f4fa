"""What every scaling method gives back: factors, scaled spectra beside the target, and how good they are."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Final

import numpy as np
import polars as pl

from seismass.base.values import FieldValue, FloatArray, frozen
from seismass.base.views import view
from seismass.media.result import Result, finite_values

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seismass.motions.spectra import GroundMotion, TargetSpectrum

FACTOR_RANGE: Final = (0.2, 5.0)
"""Scale factor of a motion."""
MAX_OVERSHOOT: Final = 2.0
"""Mean scaled spectrum over the target."""


@dataclass(frozen=True, eq=False, repr=False)
class ScalingResult(FieldValue, Result):
    """Factors of a suite, and the spectra that they follow from.

    Attributes
    ----------
    names : tuple of str
        Names of the records.
    individual : ndarray, shape (motions,)
        SF1: the factor of each motion by itself; for ASCE 7 it brings the motion as close to the target as one factor
        can, in the logarithm.
    common : float
        SF2: lifts the mean spectrum until it is not below the target, or the required share of it, at any of
        the periods. 1 for methods that look at each motion alone.
    factors : ndarray, shape (motions,)
        SF1 SF2, by which accelerations are multiplied.
    periods : ndarray, shape (periods,)
        Periods (s) of the comparison.
    target, mean : ndarray, shape (periods,)
        Target and mean scaled pseudo-acceleration (m/s2) there.
    spectra : ndarray, shape (motions, periods)
        Scaled pseudo-acceleration of each motion (m/s2) there.
    governing_period : float
        Period (s) at which the mean over the target is lowest; for ASCE 7 it touches the required level there.
    method : str
        Name of the method.
    period : float
        Period T (s) for which the suite is scaled.
    damping : float
        Ratio of critical damping of the spectra.
    target_label : str
        What the target is.
    notes : tuple of str
        What the method assumes or cannot honour, as sentences.
    """

    document: ClassVar[str] = "scaling"

    names: tuple[str, ...]
    individual: FloatArray
    common: float
    factors: FloatArray
    periods: FloatArray
    target: FloatArray
    mean: FloatArray
    spectra: FloatArray
    governing_period: float
    method: str = "ASCE 7-10"
    period: float = 1.0
    damping: float = 0.05
    target_label: str = ""
    notes: tuple[str, ...] = ()

    @property
    def misfit(self) -> FloatArray:
        """Root mean square over the periods of ln(scaled/target) of each motion, shape (motions,)."""
        return frozen(np.sqrt(np.mean(self._log_ratio() ** 2, axis=1)))

    @property
    def largest_misfit(self) -> FloatArray:
        """Largest absolute ln(scaled/target) of each motion, shape (motions,)."""
        return frozen(np.max(np.abs(self._log_ratio()), axis=1))

    @property
    def mean_misfit(self) -> float:
        """Root mean square over the periods of ln(mean/target)."""
        return float(np.sqrt(np.mean(np.log(self.mean / self.target) ** 2)))

    @property
    def least_ratio(self) -> float:
        """Least mean/target over the periods."""
        return float(np.min(self.mean / self.target))

    @property
    def largest_ratio(self) -> float:
        """Largest mean/target over the periods."""
        return float(np.max(self.mean / self.target))

    @property
    def log_scatter(self) -> FloatArray:
        """Standard deviation of ln of the scaled spectra between the motions, shape (periods,); zero for one motion."""
        if len(self.names) == 1:
            return frozen(np.zeros(len(self.periods)))
        return frozen(np.std(np.log(self.spectra), axis=0, ddof=1))

    def _log_ratio(self) -> FloatArray:
        ratio: FloatArray = np.log(self.spectra / self.target)
        return ratio

    def table(self) -> pl.DataFrame:
        """Return one row per motion: number, name, SF1, SF2 and their product."""
        return pl.DataFrame(
            {
                "motion": np.arange(1, len(self.names) + 1, dtype=np.uint32),
                "record": list(self.names),
                "individual_factor": self.individual,
                "common_factor": np.full(len(self.names), self.common),
                "factor": self.factors,
            }
        )

    def diagnostics(self) -> pl.DataFrame:
        """Return the rows of `table` with `misfit` and `largest_misfit`, and what else the method knows of a motion."""
        return self.table().with_columns(misfit=pl.Series(self.misfit), largest_misfit=pl.Series(self.largest_misfit))

    @property
    def remarks(self) -> tuple[str, ...]:
        """What the method assumes, and what is unlikely about the factors and the mean spectrum, as sentences."""
        return (*self.notes, *self.doubts)

    @property
    def doubts(self) -> tuple[str, ...]:
        """What is unlikely: factors outside 0.2 to 5, and a mean spectrum above twice the target, as sentences."""
        low, high = FACTOR_RANGE
        doubts = []
        outside = np.flatnonzero((self.factors < low) | (self.factors > high))
        if len(outside):
            listed = ", ".join(f"{self.factors[i]:.4g} of motion {i + 1} ({self.names[i]})" for i in outside[:3])
            others = f" and {len(outside) - 3} more" if len(outside) > 3 else ""
            doubts.append(
                f"scale factors are outside {low:g} to {high:g}: {listed}{others}; "
                "records so far from the target may not stand for it"
            )
        ratio = self.mean / self.target
        worst = int(np.argmax(ratio))
        if ratio[worst] > MAX_OVERSHOOT:
            doubts.append(
                f"mean scaled spectrum is {ratio[worst]:.3g} times the target at {self.periods[worst]:.4g} s, "
                f"above {MAX_OVERSHOOT:g} times: the shapes of suite and target differ"
            )
        return tuple(doubts)

    def spectrum_table(self) -> pl.DataFrame:
        """Return one row per period: target, mean scaled pseudo-acceleration (m/s2), their ratio, and the scatter.

        `p16` and `p84` are the geometric mean of the motions over and times exp(`log_scatter`).
        """
        middle = np.exp(np.mean(np.log(self.spectra), axis=0))
        spread = np.exp(self.log_scatter)
        return pl.DataFrame(
            {
                "period": self.periods,
                "target": self.target,
                "mean": self.mean,
                "ratio": self.mean / self.target,
                "p16": middle / spread,
                "p84": middle * spread,
                "log_scatter": self.log_scatter,
            }
        )

    @property
    @view
    def text(self) -> str:
        """The method, how the mean fits the target, the scatter, and the factor and misfit of each motion."""
        raise NotImplementedError

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name: scaling, one row per motion; spectrum, one row per period."""
        return {"scaling": self.diagnostics(), "spectrum": self.spectrum_table()}

    def to_dict(self) -> dict[str, Any]:
        """Return factors, misfits and the spectrum as plain values; null for non-finite values."""
        document = {
            "target": self.target_label,
            "method": self.method,
            "period": self.period,
            "common_factor": self.common,
            "governing_period": self.governing_period,
            "least_ratio": self.least_ratio,
            "largest_ratio": self.largest_ratio,
            "mean_misfit": self.mean_misfit,
            "remarks": list(self.remarks),
            "motions": self.diagnostics().to_dicts(),
            "spectrum": self.spectrum_table().to_dict(as_series=False),
        }
        finite: dict[str, Any] = finite_values(document)
        return finite

    @property
    def figure_names(self) -> tuple[str, ...]:
        """scaling: the scaled spectra, their mean and the target."""
        return ("scaling",)

    @view
    def plot(
        self,
        name: str | None = None,
        *,
        records: Iterable[GroundMotion] | None = None,
        target: TargetSpectrum | None = None,
    ) -> Figure:
        """Return a figure of the scaled spectra, their mean and scatter, and the target, as the paper's Fig. 1.

        Parameters
        ----------
        name : str, optional
            "scaling".
        records, target : optional
            The suite and the target that were scaled: spectra are then drawn beyond the range of the comparison, which
            is marked. The result itself has them within it.

        Raises
        ------
        InvalidOption
            There is no such figure.
        """
        raise NotImplementedError
