"""What scaling methods share: the arguments as they judge them, the spectra of the suite, and the result."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Final, Literal, TypeAlias, get_args

import numpy as np
import polars as pl

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.values import (
    FieldValue,
    FloatArray,
    as_count,
    as_number,
    as_one_of,
    as_positive,
    brief,
    counted,
    frozen,
    refusal,
)
from seismass.base.views import view
from seismass.media.result import Result, finite_values
from seismass.motions.motion import motion_names
from seismass.motions.records.known import band_remarks
from seismass.motions.scaling import FORMS
from seismass.motions.spectra import GroundMotion, TargetSpectrum, as_motions, response_spectrum
from seismass.motions.spectra.elastic import check_not_zero

if TYPE_CHECKING:
    from matplotlib.figure import Figure


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
        return finite_values(document)

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


@dataclass(frozen=True, eq=False)
class SuiteSpectra:
    """A suite with its unscaled spectra (m/s2, motions x periods) beside the target at the periods of comparison."""

    names: tuple[str, ...]
    period: float
    damping: float
    periods: FloatArray
    target: FloatArray
    spectra: FloatArray
    target_label: str
    remarks_on_band: tuple[str, ...] = ()

    def result(
        self, method: str, individual: FloatArray, common: float = 1.0, notes: Iterable[str] = ()
    ) -> ScalingResult:
        """Return the result of these factors."""
        return ScalingResult(**self.content(method, individual, common, notes))

    def content(self, method: str, individual: FloatArray, common: float, notes: Iterable[str]) -> dict[str, Any]:
        """Return the attributes of a result of these factors."""
        factors = individual * common
        scaled = factors[:, None] * self.spectra
        mean = np.mean(scaled, axis=0)
        return {
            "names": self.names,
            "individual": frozen(individual),
            "common": common,
            "factors": frozen(factors),
            "periods": self.periods,
            "target": self.target,
            "mean": frozen(mean),
            "spectra": frozen(scaled),
            "governing_period": float(self.periods[int(np.argmin(mean / self.target))]),
            "method": method,
            "period": self.period,
            "damping": self.damping,
            "target_label": self.target_label,
            "notes": (*notes, *self.remarks_on_band),
        }

    def log_factors(self) -> FloatArray:
        """Return the factors that bring each motion closest to the target, in the logarithm."""
        factors: FloatArray = np.exp(np.mean(np.log(self.target) - np.log(self.spectra), axis=1))
        return factors

    def common_factor(self, individual: FloatArray, share: float) -> float:
        """Return the factor that lifts the mean of the motions until it is nowhere below the share of the target."""
        mean = np.mean(individual[:, None] * self.spectra, axis=0)
        return float(np.max(share * self.target / mean))


def suite_spectra(
    records: Iterable[GroundMotion],
    target: TargetSpectrum | str,
    period: Any,
    *,
    damping: Any,
    period_range: Any,
    count: Any,
    threads: int | None,
    least: tuple[int, str] = (1, ""),
) -> SuiteSpectra:
    """Return the spectra of a suite at `count` periods over the range, in geometric spacing; `least` is the least
    number of motions, and what asks for it. Other arguments as in `scale_asce7_10`.
    """
    suite = as_motions(records, "scaling")
    number, clause = least
    if len(suite) < number:
        words = {3: "three", 11: "eleven"}.get(number, str(number))
        raise refusal(InvalidMotion, "records", "scaling", f"at least {words} motions ({clause})", f"{len(suite)}")
    spectrum = as_target(target)
    fundamental = positive_period(period)
    damping_ratio = as_number(damping, "damping", "scaling", InvalidOption)
    points = as_count(count, "count", "scaling", InvalidOption, least=2)
    shortest, longest = checked_range(period_range)
    periods = fundamental * np.geomspace(shortest, longest, points)
    ordinates = spectrum(periods)
    spectra = response_spectrum(suite, periods, damping_ratio, threads=threads)
    check_not_zero(spectra)
    return SuiteSpectra(
        names=tuple(motion_names(suite)),
        period=fundamental,
        damping=damping_ratio,
        periods=frozen(periods),
        target=frozen(ordinates),
        spectra=frozen(spectra),
        target_label=spectrum.label,
        remarks_on_band=tuple(band_remarks(suite, float(periods[0]), float(periods[-1]))),
    )


def as_target(target: Any, owner: str = "scaling") -> TargetSpectrum:
    """Return a target spectrum, or that of a text such as "asce7:1:0.6" (`target_of`)."""
    spectrum = target_of(target) if isinstance(target, str) else target
    return as_one_of(spectrum, TargetSpectrum, "target", owner, InvalidOption)


def positive_period(period: Any) -> float:
    """Return a positive period (s)."""
    return positive_number(period, "period")


def positive_number(value: Any, name: str) -> float:
    """Return a positive number."""
    return as_positive(value, name, "scaling", InvalidOption)


def checked_range(ends: Any) -> tuple[float, float]:
    """Return two positive multiples of the period, the smaller first."""
    requirement = "two positive multiples of the period, the smaller first"
    try:
        shortest, longest = (as_number(value, "period_range", "scaling", InvalidOption) for value in ends)
    except (TypeError, ValueError) as error:
        if isinstance(error, InvalidOption):
            raise
        raise refusal(InvalidOption, "period_range", "scaling", requirement, brief(ends)) from None
    if not (0.0 < shortest < longest < np.inf):
        raise refusal(InvalidOption, "period_range", "scaling", requirement, brief(ends))
    return shortest, longest


ALIASES: Final = {"nzs": "nzs1170", "asce": "asce7"}
"""Other names of the forms."""


def target_of(text: str, folder: Path = Path()) -> TargetSpectrum:
    """Return the target spectrum of a file, relative to `folder`, or of one of `FORMS`, with its numbers."""
    from seismass.motions.spectra import TargetSpectrum
    from seismass.motions.spectra.tables import file_and_words, read_table

    name, colon, rest = text.partition(":")
    name = ALIASES.get(name.lower(), name.lower())
    if name not in FORMS or not colon:
        file, words_behind = file_and_words(text, folder)
        if (colon or not Path(text).suffix) and not file.exists():
            forms = ", ".join(FORMS.values())
            raise InvalidOption(f"--target of command must be a CSV that is there or one of {forms}; got {text}")
        return TargetSpectrum.from_csv(file, **words_behind)
    if not rest:
        raise _refused(name, text)
    if name == "asce7-22":
        file, words_behind = file_and_words(rest, folder)
        return TargetSpectrum.asce7_multi_period(*read_table(file, **words_behind))
    if name == "mean":
        from seismass.motions.records.builtin import records_named

        suite = records_named(folder / rest)
        return TargetSpectrum.mean_of(suite, label=f"mean spectrum of {suite.name}, {counted(len(suite), 'motion')}")
    words = rest.split(":")
    least = {"asce7": 2, "ec8": 3, "nzs1170": 2}[name]
    most = {"asce7": 3, "ec8": 5, "nzs1170": 4}[name]
    if not least <= len(words) <= most or not all(words):
        raise _refused(name, text)
    if name == "asce7":
        return TargetSpectrum.asce7(*(_number(word, name, text) for word in words))
    if name == "ec8":
        kind, ground, *numbers = words
        keys = ("agr_g", "importance", "damping")
        parameters: dict[str, Any] = dict(zip(keys, (_number(word, name, text) for word in numbers), strict=False))
        return TargetSpectrum.eurocode8(int(kind) if kind.isdecimal() else 0, ground.upper(), **parameters)
    site_class, *numbers = words
    keys = ("z", "r", "fault_distance_km")
    parameters = dict(zip(keys, (_number(word, name, text) for word in numbers), strict=False))
    return TargetSpectrum.nzs1170(site_class.upper(), **parameters)


def _number(word: str, name: str, text: str) -> float:
    try:
        return float(word)
    except ValueError:
        raise _refused(name, text) from None


def _refused(name: str, text: str) -> InvalidOption:
    return InvalidOption(f"--target of command must be {FORMS[name]}; got {text}")


Space: TypeAlias = Literal["log", "linear"]
"""Whether the squares are of ln A_t - ln SF A or of A_t - SF A."""


def scale_least_squares(
    records: Iterable[GroundMotion],
    target: TargetSpectrum | str,
    period: float = 1.0,
    *,
    space: Space = "log",
    damping: float = 0.05,
    period_range: tuple[float, float] = (0.2, 1.5),
    count: int = 100,
    threads: int | None = None,
) -> ScalingResult:
    """Return for each motion the factor of least squares between its spectrum and the target.

    Parameters
    ----------
    records, target, period, damping, period_range, count, threads
        As for `scale_asce7_10`; one motion is enough.
    space : {"log", "linear"}, default "log"
        Differences of logarithms, or of ordinates, which weigh the periods of large ordinates.

    Raises
    ------
    InvalidOption, InvalidMotion
        As for `scale_asce7_10`, or another space.

    Notes
    -----
    In the logarithm ln SF_i = mean over T_j of ln A_t - ln A_i; else SF_i = sum A_i A_t / sum A_i^2. The mean of the
    suite may be below the target.
    """
    choice: Any = space
    as_word(choice, get_args(Space), "space", "scaling")
    suite = suite_spectra(
        records, target, period, damping=damping, period_range=period_range, count=count, threads=threads
    )
    if space == "log":
        factors = suite.log_factors()
    else:
        squares: FloatArray = np.sum(suite.spectra**2, axis=1)
        factors = suite.spectra @ suite.target / squares
    note = "each motion is fitted by itself: nothing keeps the mean of the suite above the target"
    return suite.result(f"least squares, {space}", factors, notes=(note,))


def scale_sa_t1(
    records: Iterable[GroundMotion],
    target: TargetSpectrum | str,
    period: float = 1.0,
    *,
    damping: float = 0.05,
    period_range: tuple[float, float] = (0.2, 1.5),
    count: int = 100,
    threads: int | None = None,
) -> ScalingResult:
    """Return for each motion the factor by which its spectrum is the target at T1.

    Parameters
    ----------
    records, target, damping, count, threads
        As for `scale_asce7_10`; one motion is enough.
    period : float, default 1.0
        T1 (s).
    period_range : tuple of float, optional
        Range of the comparison as multiples of T1, which the factors do not depend on.

    Raises
    ------
    InvalidOption, InvalidMotion
        As for `scale_asce7_10`.

    Notes
    -----
    SF_i = A_t(T1)/A_i(T1), the elastic ratio to which `scale_modal_pushover` comes down for R = 1.
    """
    target = as_target(target)
    motions = as_motions(records, "scaling")
    suite = suite_spectra(
        motions, target, period, damping=damping, period_range=period_range, count=count, threads=threads
    )
    ordinates = response_spectrum(motions, [suite.period], suite.damping, threads=threads)[:, 0]
    note = (
        f"the motions meet the target at {suite.period:g} s alone: scatter at other periods, those of higher modes and "
        "of a yielding building, is left as it is"
    )
    return suite.result("Sa(T1)", target(suite.period) / ordinates, notes=(note,))
