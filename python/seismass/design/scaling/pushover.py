"""Modal-pushover-based scaling: the first-mode inelastic oscillator reaches a target deformation."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
import polars as pl

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidOption, SimulationError
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_number, brief, frozen, refusal, short_repr
from seismass.design.scaling.oscillator import FirstModeOscillator, deformation_ratio, first_mode_oscillator
from seismass.model.building import Building
from seismass.model.scene import Scene
from seismass.model.springs import DEFAULT_OVERSTRENGTH, DEFAULT_SECOND_SLOPE, DEFAULT_THIRD_SLOPE
from seismass.motions.scaling.suite import ScalingResult, as_target, positive_number, suite_spectra
from seismass.motions.spectra import GroundMotion, TargetSpectrum, as_motions, response_spectrum
from seismass.motions.spectra.inelastic import Oscillators

Deformation: TypeAlias = Literal["ratio", "median"]
"""Target deformation: C_R of Chopra and Chintanapakdee, or the median of the suite at the elastic target."""

SCAN_STEP: Final = 0.01
"""Step of ln SF in the search for factors; two of them closer than it may both be missed."""
TOLERANCE: Final = 1e-10
"""Relative tolerance of a factor."""
_BEYOND: Final = 10.0
"""The search goes to this multiple of the elastic ratio, and on from there until the target is exceeded."""
_LARGEST: Final = 1e6


@dataclass(frozen=True, eq=False)
class PushoverScaling(ScalingResult):
    """Result of `scale_modal_pushover`, beside the attributes of `ScalingResult`.

    Attributes
    ----------
    oscillator : FirstModeOscillator
        The inelastic oscillator.
    reduction : float
        R_y: elastic demand A_t(T1) over the yield acceleration; up to 1 it stays elastic.
    deformation_ratio : float
        C_R: target deformation over the elastic one.
    target_deformation : float
        D_t (m).
    deformations : ndarray, shape (motions,)
        Peak deformation of the oscillator under each motion with its factor (m).
    second_mode_ratio : ndarray, shape (motions,), or None
        Scaled pseudo-acceleration at T2 over the target there, for a building of two storeys or more: how far the
        second, elastic mode is from its target, by which Kalkan and Chopra rank records for buildings in which it
        matters. None without a building, or where the target does not cover T2.
    roots : tuple of ndarray
        All factors of each motion that were found to reach the target, increasing; the one nearest 1 in the logarithm
        is taken.
    """

    oscillator: FirstModeOscillator | None = None
    reduction: float = 1.0
    deformation_ratio: float = 1.0
    target_deformation: float = 0.0
    deformations: FloatArray = field(default_factory=lambda: frozen([]))
    roots: tuple[FloatArray, ...] = ()
    second_mode_ratio: FloatArray | None = None

    __repr__ = short_repr

    def diagnostics(self) -> pl.DataFrame:
        """Return those of `ScalingResult` with the deformation (m), over the target, and all factors found."""
        table = (
            super()
            .diagnostics()
            .with_columns(
                deformation=pl.Series(self.deformations),
                deformation_over_target=pl.Series(self.deformations / self.target_deformation),
                roots=pl.Series([roots.tolist() for roots in self.roots], dtype=pl.List(pl.Float64)),
            )
        )
        if self.second_mode_ratio is None:
            return table
        return table.with_columns(second_mode_ratio=pl.Series(self.second_mode_ratio))


def scale_modal_pushover(
    records: Iterable[GroundMotion],
    target: TargetSpectrum | str,
    building: Building | None = None,
    *,
    period: float | None = None,
    yield_coefficient: float | None = None,
    reduction: float | None = None,
    overstrength: float = DEFAULT_OVERSTRENGTH,
    second_slope: float = DEFAULT_SECOND_SLOPE,
    third_slope: float = DEFAULT_THIRD_SLOPE,
    damping: float = 0.05,
    deformation: Deformation = "ratio",
    corner_period: float | None = None,
    period_range: tuple[float, float] = (0.2, 1.5),
    count: int = 100,
    threads: int | None = None,
) -> PushoverScaling:
    """Return for each motion the factor by which the first-mode inelastic oscillator reaches the target deformation.

    Parameters
    ----------
    records : iterable of Record or Motion
        The suite.
    target : TargetSpectrum or str
        Elastic design spectrum.
    building : Building, optional
        Shear building; its pushover under s = m phi_1 gives the oscillator (`first_mode_oscillator`), without P-Delta.
        Without a building the oscillator is given by the next arguments.
    period : float, optional
        Period T1 of the oscillator (s); 1 by default.
    yield_coefficient : float, optional
        A_y/g: yield strength of the oscillator over its weight. Either it or the next is needed without a building.
    reduction : float, optional
        R_y: A_t(T1) over the yield acceleration A_y.
    overstrength, second_slope, third_slope, damping : float, optional
        The oscillator's, as for `Building`; left out with a building, which has its own.
    deformation : {"ratio", "median"}, default "ratio"
        Target deformation D_t: C_R times the elastic one, or the median over the suite of the inelastic deformation of
        the motions scaled to A_t(T1).
    corner_period : float, optional
        T_c of C_R (s); by default that of the target (`TargetSpectrum.corner_period`).
    period_range, count, threads
        As for `scale_asce7_10`; the factors do not depend on the range, in which they are compared.

    Raises
    ------
    InvalidOption
        An argument is out of its range, or given beside a building.
    InvalidMotion
        No motion, or one without any acceleration.
    SimulationError
        No factor up to a million reaches the target.

    Notes
    -----
    Kalkan and Chopra (2011), J. Struct. Eng. 137:298; one component, first mode. The target deformation is that of the
    single-component procedure as published reviews give it: the exact variant of Reyes and Chopra was not at hand.

    *Method.* Up to the factor at which the oscillator first yields the deformation is proportional to it, and the
    factor is a ratio: for R_y up to 1 it is A_t(T1)/A_i(T1). Beyond, the deformation does not rise monotonically: it
    is found at factors in steps of 1 % up to ten times the elastic ratio, each interval in which it passes the target
    is halved to a relative width of 1e-10, and of several factors the one nearest 1 in the logarithm is taken.

    *Limitation.* Two factors within one step of 1 % are both missed.
    """
    suite = as_motions(records, "scaling")
    target = as_target(target)
    as_word(deformation, get_args(Deformation), "deformation", "scaling")
    springs = {"overstrength": overstrength, "second_slope": second_slope, "third_slope": third_slope}
    oscillator = (
        _oscillator_of_options(target, period, yield_coefficient, reduction, damping, springs)
        if building is None
        else _of_building(building, period, yield_coefficient, reduction)
    )
    compared = suite_spectra(
        suite,
        target,
        oscillator.period,
        damping=oscillator.damping,
        period_range=period_range,
        count=count,
        threads=threads,
    )
    elastic = response_spectrum(suite, [oscillator.period], oscillator.damping, "displacement", threads=threads)[:, 0]
    demand = float(target(oscillator.period)) / oscillator.frequency**2
    strength = demand / oscillator.yield_deformation
    search = _Search(oscillator, suite, elastic, strength, threads)
    corner = target.corner_period() if corner_period is None else positive_number(corner_period, "corner_period")
    if strength <= 1.0:
        ratio = 1.0
    elif deformation == "ratio":
        ratio = deformation_ratio(strength, oscillator.period / corner, oscillator.post_yield_slope)
    else:
        ratio = float(np.median(search.deformations(np.arange(len(suite)), demand / elastic))) / demand
    wanted = ratio * demand
    roots = search.roots(wanted)
    factors = np.array([crossings[np.argmin(np.abs(np.log(crossings)))] for crossings in roots])
    reached = search.deformations(np.arange(len(suite)), factors)
    second = None if building is None else _second_mode(building, suite, target, factors, oscillator.damping, threads)
    notes = _notes(compared.names, roots, deformation, strength, oscillator, corner)
    notes += [] if building is None else _p_delta_notes(building)
    return PushoverScaling(
        **compared.content("modal pushover", factors, 1.0, notes),
        oscillator=oscillator,
        reduction=strength,
        deformation_ratio=ratio,
        target_deformation=wanted,
        deformations=frozen(reached),
        roots=tuple(frozen(crossings) for crossings in roots),
        second_mode_ratio=second,
    )


def _second_mode(
    building: Building,
    suite: list[GroundMotion],
    target: TargetSpectrum,
    factors: FloatArray,
    damping: float,
    threads: int | None,
) -> FloatArray | None:
    """Scaled over target pseudo-acceleration at the second period."""
    if building.storeys == 1 or not target.shortest <= building.periods[1] <= target.longest:
        return None
    period = float(building.periods[1])
    ordinates = response_spectrum(suite, [period], damping, threads=threads)[:, 0]
    return frozen(factors * ordinates / float(target(period)))


def _oscillator_of_options(
    target: TargetSpectrum, period: Any, yield_coefficient: Any, reduction: Any, damping: Any, springs: dict[str, Any]
) -> FirstModeOscillator:
    if (yield_coefficient is None) == (reduction is None):
        got = "neither" if reduction is None else "both"
        requirement = "given, or reduction, not both, where there is no building"
        raise refusal(InvalidOption, "yield_coefficient", "scaling", requirement, got)
    natural = positive_number(1.0 if period is None else period, "period")
    if reduction is None:
        acceleration = positive_number(yield_coefficient, "yield_coefficient") * STANDARD_GRAVITY
    else:
        acceleration = float(target(natural)) / positive_number(reduction, "reduction")
    numbers = {name: as_number(value, name, "scaling", InvalidOption) for name, value in springs.items()}
    return FirstModeOscillator(
        natural, acceleration, damping=as_number(damping, "damping", "scaling", InvalidOption), **numbers
    )


def _of_building(building: Any, period: Any, yield_coefficient: Any, reduction: Any) -> FirstModeOscillator:
    for name, value in (("period", period), ("yield_coefficient", yield_coefficient), ("reduction", reduction)):
        if value is not None:
            raise refusal(InvalidOption, name, "scaling", "left out where a building is given", brief(value))
    return first_mode_oscillator(building)


def _notes(
    names: tuple[str, ...],
    roots: list[FloatArray],
    deformation: str,
    strength: float,
    oscillator: FirstModeOscillator,
    corner: float,
) -> list[str]:
    source = (
        f"C_R of Chopra and Chintanapakdee (2004) with T_c = {corner:.3g} s"
        if deformation == "ratio"
        else "the median of the suite scaled to the elastic target"
    )
    target = "the oscillator stays elastic, R_y <= 1" if strength <= 1.0 else f"target deformation by {source}"
    notes = [
        f"first mode alone, an oscillator of {oscillator.period:.4g} s with R_y = {strength:.3g}; {target}; "
        "nothing keeps the mean spectrum above the target"
    ]
    for number, (name, several) in enumerate(zip(names, roots, strict=True), start=1):
        if len(several) > 1:
            listed = ", ".join(f"{value:.4g}" for value in several)
            notes.append(f"motion {number} ({name}) reaches the target deformation at several factors: {listed}")
    return notes


def _p_delta_notes(building: Building) -> list[str]:
    """Say that P-Delta is left out of the pushover, and how much it is."""
    share = Scene(building).geometric_stiffness / building.stiffness
    largest = float(np.max(share))
    if largest == 0.0:
        return []
    storey = int(np.argmax(share)) + 1
    return [f"P-Delta is left out of the pushover: P/h is up to {100.0 * largest:.2g} % of k (storey {storey})"]


class _Search:
    """Deformations of the oscillator under a suite, and the factors that lead to one."""

    def __init__(
        self,
        oscillator: FirstModeOscillator,
        suite: list[GroundMotion],
        elastic: FloatArray,
        strength: float,
        threads: int | None,
    ) -> None:
        self._elastic = elastic
        self._yield_deformation = oscillator.yield_deformation
        self._at_yield = oscillator.yield_deformation / elastic
        largest = _BEYOND * max(strength, 1.0) * float(self._at_yield.max())
        self._runner = Oscillators([oscillator.of_spectrum()], suite, largest, threads)

    def deformations(self, motion: Any, factor: FloatArray) -> FloatArray:
        """Return the peak deformation (m) under motions by index, with factors; below yield it is proportional."""
        peaks = factor * self._elastic[motion]
        yields = np.flatnonzero(factor > self._at_yield[motion])
        if len(yields):
            peaks[yields] = self._runner.peaks(
                np.zeros(len(yields), dtype=np.int64), np.asarray(motion)[yields], factor[yields]
            )
        return np.asarray(peaks)

    def roots(self, wanted: float) -> list[FloatArray]:
        """Return for each motion the factors that lead to a deformation, increasing."""
        if wanted <= self._yield_deformation:
            return [np.array([wanted / peak]) for peak in self._elastic]
        motion, low, high = self._brackets(wanted)
        rising = self.deformations(motion, np.exp(low)) < wanted
        while float(np.max(high - low)) > TOLERANCE:
            middle = 0.5 * (low + high)
            below = self.deformations(motion, np.exp(middle)) < wanted
            low, high = np.where(below == rising, middle, low), np.where(below == rising, high, middle)
        factors = np.exp(0.5 * (low + high))
        return [factors[motion == number] for number in range(len(self._elastic))]

    def _brackets(self, wanted: float) -> tuple[Any, FloatArray, FloatArray]:
        """Motion, and ln of the factors around each passage of the target, from the factor at yield up."""
        motions, lows, highs = [], [], []
        for number, (start, peak) in enumerate(zip(self._at_yield, self._elastic, strict=True)):
            ratio = max(wanted / peak / start, 1.0) if peak > 0.0 < start else np.inf
            if not np.isfinite(ratio):
                requirement = "such that the factors at yield and at the target are numbers"
                got = f"{wanted:g} m at a peak of {peak:g} m"
                raise refusal(InvalidOption, "strength", "scaling", requirement, got)
            steps = int(np.ceil(np.log(_BEYOND * ratio) / SCAN_STEP))
            log_factors = np.log(start) + SCAN_STEP * np.arange(steps + 1)
            peaks = self.deformations(np.full(steps + 1, number), np.exp(log_factors))
            while peaks[-1] < wanted:
                if log_factors[-1] > np.log(_LARGEST * start):
                    raise SimulationError(
                        f"motion {number + 1} of scaling has no factor up to {np.exp(log_factors[-1]):.3g} by which "
                        f"the oscillator reaches {wanted:.4g} m"
                    )
                more = log_factors[-1] + SCAN_STEP * np.arange(1, steps + 1)
                log_factors = np.append(log_factors, more)
                peaks = np.append(peaks, self.deformations(np.full(steps, number), np.exp(more)))
            below = peaks < wanted
            intervals = np.flatnonzero(below[:-1] != below[1:])
            motions += [number] * len(intervals)
            lows.append(log_factors[intervals])
            highs.append(log_factors[intervals + 1])
        return np.array(motions), np.concatenate(lows), np.concatenate(highs)
