"""Inelastic response spectra of constant strength and of constant ductility, with the trilinear spring."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import numpy as np
import polars as pl
from numpy.typing import ArrayLike, NDArray

from seismass import _kernel
from seismass.base.arguments import as_threads
from seismass.base.errors import InvalidOption, InvalidScene, SimulationError
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FieldValue, FloatArray, as_array, as_number, frozen, refusal
from seismass.base.views import Card
from seismass.motions.motion import motion_names
from seismass.motions.spectra.elastic import GroundMotion, as_motions, check_not_zero, held, response_spectrum

IndexArray: TypeAlias = NDArray[np.int64]

_LONGEST_FLOW: Final = 60.0
"""Longest time of plastic flow after a motion that is followed (s)."""


@dataclass(frozen=True)
class Oscillator:
    """An oscillator of 1 kg with a trilinear spring: period (s), first yield A_y (m/s2), damping ratio, shape."""

    period: float
    yield_acceleration: float
    damping: float
    overstrength: float
    second_slope: float
    third_slope: float

    def of_kernel(self) -> _kernel.Building:
        """Return the oscillator as the kernel takes it; InvalidScene where there is none of these numbers."""
        shape = {name: getattr(self, name) for name in ("overstrength", "second_slope", "third_slope")}
        numbers = {name: as_number(value, name, "oscillator", InvalidScene) for name, value in shape.items()}
        springs = {
            "stiffness": _kernel.uniform_stiffness(1, self.period, 1.0),
            "yield_shear": self.yield_acceleration,
            **numbers,
        }
        return _kernel.Building(
            np.ones(1), {name: np.full(1, value) for name, value in springs.items()}, damping_ratio=self.damping
        )

    def rest(self, motion: GroundMotion, largest: float) -> float:
        """Return the time (s) after the last sample of a motion in which a peak can still be reached."""
        yields = self.yield_acceleration * self.overstrength
        if not np.isfinite(yields):
            return 2.0 * self.period
        velocity = np.cumsum(np.asarray(motion.acceleration, dtype=np.float64)) * float(motion.dt)
        speed = 2.0 * largest * float(np.abs(velocity).max())
        rate = 4.0 * np.pi * self.damping / self.period
        # v' = -rate v - A_y comes to rest after ln(1 + rate v/A_y)/rate.
        flow = np.log1p(rate * speed / yields) / rate if rate > 0.0 else speed / yields
        return 2.0 * self.period + min(float(flow), _LONGEST_FLOW)


class Oscillators:
    """Oscillators run with factors of motions, continued at zero until free vibration and flow end. A factor s is a
    strength of 1/s: displacement of an oscillator s times weaker is that of this one over s.
    """

    def __init__(
        self, oscillators: Sequence[Oscillator], motions: Sequence[GroundMotion], largest: float, threads: int | None
    ) -> None:
        none = np.zeros((len(oscillators), 0))
        kernels = [oscillator.of_kernel() for oscillator in oscillators]
        self._columns = _kernel.Columns(kernels, [], np.arange(len(oscillators)), none, none, none)
        self._motions = []
        self._threads = threads
        for number, motion in enumerate(motions, start=1):
            rest = max(oscillator.rest(motion, largest) for oscillator in oscillators)
            motion_held = held(motion, number)
            self._motions.append(motion_held.with_duration((len(motion_held.acceleration) - 1) * motion_held.dt + rest))

    def peaks(self, oscillator: IndexArray, motion: IndexArray, factor: FloatArray) -> FloatArray:
        """Return peak displacements (m) of runs by oscillator and motion (from 0) and factor of the motion."""
        runs = np.stack([oscillator, motion], axis=1).astype(np.int64)
        scale = np.ascontiguousarray(factor, dtype=np.float64)
        batch = _kernel.simulate_columns(
            self._columns, self._motions, runs, scale, peaks_only=True, threads=self._threads
        )
        if batch.failures:
            run, reason = batch.failures[0]
            raise SimulationError(
                f"oscillator of period {oscillator[run] + 1} under motion {motion[run] + 1}: {reason}"
            )
        return np.asarray(batch.peak_drift)


SCAN_STEP: Final = 0.04
"""Step of ln C_y by which the strength is lowered in search of a ductility; roots closer than it may be missed."""
TOLERANCE: Final = 1e-8
"""Relative tolerance of the strength that gives a ductility."""
_CHUNK: Final = 16
_MOST_STEPS: Final = 1000


@dataclass(frozen=True, eq=False)
class InelasticSpectrum(FieldValue, Card):
    """Peaks of inelastic oscillators; arrays are motions by periods, or motions by levels by periods for a list.

    Attributes
    ----------
    names : tuple of str
        Names of the motions.
    periods : ndarray, shape (periods,)
        Initial periods (s).
    strength : ndarray
        C_y = V_y/W: yield shear over weight, given or found.
    displacement : ndarray
        Peak displacement relative to the ground (m).
    ductility : ndarray
        It over the yield displacement V_y/k; 0 for infinite strength.
    elastic_strength : ndarray, shape (motions, periods)
        C_e: the least strength with which the oscillator stays elastic, pseudo-acceleration over g.
    damping, overstrength, second_slope, third_slope : float
        The oscillator.
    """

    names: tuple[str, ...]
    periods: FloatArray
    strength: FloatArray
    displacement: FloatArray
    ductility: FloatArray
    elastic_strength: FloatArray
    damping: float
    overstrength: float
    second_slope: float
    third_slope: float

    @property
    def reduction(self) -> FloatArray:
        """R = C_e/C_y, of the shape of `strength`; below 1 where the oscillator stays elastic."""
        elastic = self.elastic_strength if self.strength.ndim == 2 else self.elastic_strength[:, None, :]
        return frozen(elastic / self.strength)

    def table(self) -> pl.DataFrame:
        """Return one row per motion, level and period: number from 1, record, period (s) and the five quantities."""
        levels = 1 if self.strength.ndim == 2 else self.strength.shape[1]
        motions, periods = len(self.names), len(self.periods)
        each = levels * periods
        elastic = np.repeat(self.elastic_strength[:, None, :], levels, axis=1)
        return pl.DataFrame(
            {
                "motion": np.repeat(np.arange(1, motions + 1, dtype=np.uint32), each),
                "record": [name for name in self.names for _ in range(each)],
                "period": np.tile(self.periods, motions * levels),
                "strength": self.strength.ravel(),
                "ductility": self.ductility.ravel(),
                "displacement": self.displacement.ravel(),
                "elastic_strength": elastic.ravel(),
                "reduction": self.reduction.ravel(),
            }
        )


def inelastic_spectrum(
    motions: GroundMotion | Iterable[GroundMotion],
    periods: ArrayLike,
    *,
    strength: ArrayLike | None = None,
    ductility: ArrayLike | None = None,
    damping: float = 0.05,
    overstrength: float = _kernel.DEFAULT_OVERSTRENGTH,
    second_slope: float = _kernel.DEFAULT_SECOND_SLOPE,
    third_slope: float = _kernel.DEFAULT_THIRD_SLOPE,
    threads: int | None = None,
) -> InelasticSpectrum:
    """Return peak displacement and ductility of oscillators of given strength, or the strength for a given ductility.

    Parameters
    ----------
    motions : Record, Motion or iterable of them
        One motion counts as a suite of one.
    periods : array_like, shape (periods,)
        Initial periods (s).
    strength : float or array_like of shape (levels,), optional
        C_y = V_y/W, positive; infinite: elastic. Either it or the next is needed.
    ductility : float or array_like of shape (levels,), optional
        Ductility demand, at least 1.
    damping : float, default 0.05
        Ratio of critical damping of the initial stiffness; the coefficient stays constant.
    overstrength, second_slope, third_slope : float, optional
        Omega, r2 and r3 of the spring, as for `Building`; Omega = 1 and r3 = 0 is elastoplastic.
    threads : int, optional
        Number of threads; default all cores. The result does not depend on it.

    Returns
    -------
    InelasticSpectrum
        Strength, displacement and ductility.

    Raises
    ------
    InvalidOption
        Neither or both of strength and ductility, or a number out of its range.
    InvalidMotion
        No motion, or one without any acceleration where a ductility is given.
    InvalidScene
        Overstrength, slopes or damping that no building can have.

    Notes
    -----
    *Method.* Each oscillator is a one-storey building without blocks, solved exactly, the free vibration after the
    motion included. Ductility demand does not fall monotonically with strength, so that several strengths may have the
    demand asked for. The largest is returned: strength is lowered from C_e in steps of 4 % until the demand first
    reaches the target, and that interval is halved to a relative width of 1e-8.

    *Limitation.* A demand that passes the target and comes back within one step of 4 % is not seen.

    Examples
    --------
    A step of 1 m/s2 on an undamped elastoplastic oscillator that yields at A_y = 1.25 m/s2: the work of the step is
    that of the spring where the ductility is (A_y/2)/(A_y - 1).

    >>> import seismass as sm
    >>> step = sm.Motion([1.0] * 300, dt=0.01)
    >>> found = sm.spectra.inelastic_spectrum(
    ...     step, [0.5], strength=1.25 / sm.STANDARD_GRAVITY, damping=0.0, overstrength=1.0, second_slope=0.0
    ... )
    >>> found.ductility.round(6)
    array([[2.5]])
    """
    owner = "inelastic spectrum"
    if (strength is None) == (ductility is None):
        got = "neither" if strength is None else "both"
        raise refusal(InvalidOption, "strength", owner, "given, or ductility, not both", got)
    suite = as_motions(motions, owner)
    period_values = as_array(periods, "periods", owner, InvalidOption)
    damping_ratio = as_number(damping, "damping", owner, InvalidOption)
    workers = as_threads(threads, owner)
    elastic = response_spectrum(suite, period_values, damping_ratio, "displacement", threads=workers)
    oscillators = [
        Oscillator(period, STANDARD_GRAVITY, damping_ratio, overstrength, second_slope, third_slope)
        for period in period_values.tolist()
    ]
    unit = STANDARD_GRAVITY * (period_values / (2.0 * np.pi)) ** 2  # yield displacement of C_y = 1
    value, name = (strength, "strength") if ductility is None else (ductility, "ductility")
    levels = _levels(value, name, owner)
    if ductility is None:
        finite = levels[np.isfinite(levels)]
        runner = Oscillators(oscillators, suite, float(1.0 / finite.min()) if len(finite) else 1.0, workers)
        values_of = _of_strengths(runner, np.atleast_1d(levels), elastic, unit)
    else:
        check_not_zero(elastic)
        largest = float(levels.max() / (elastic / unit).min())
        runner = Oscillators(oscillators, suite, largest, workers)
        values_of = _of_ductilities(runner, np.atleast_1d(levels), elastic / unit, unit)
    if levels.ndim == 0:
        values_of = [values[:, 0, :] for values in values_of]
    at_yield, peaks, demands = (frozen(values) for values in values_of)
    return InelasticSpectrum(
        names=tuple(motion_names(suite)),
        periods=frozen(period_values),
        strength=at_yield,
        displacement=peaks,
        ductility=demands,
        elastic_strength=frozen(elastic / unit),
        damping=damping_ratio,
        overstrength=float(overstrength),
        second_slope=float(second_slope),
        third_slope=float(third_slope),
    )


def _levels(value: Any, name: str, owner: str) -> FloatArray:
    levels = as_array(value, name, owner, InvalidOption, or_number=True)
    if levels.size == 0:
        raise refusal(InvalidOption, name, owner, "a number or a list of at least one", "none")
    if name == "ductility":
        wrong, requirement = ~(np.isfinite(levels) & (levels >= 1.0)), "at least 1"
    else:
        wrong, requirement = ~(levels > 0.0), "positive"
    if wrong.any():
        raise refusal(InvalidOption, name, owner, requirement, f"{np.atleast_1d(levels)[np.atleast_1d(wrong)][0]:g}")
    return levels


def _of_strengths(runner: Oscillators, levels: FloatArray, elastic: FloatArray, unit: FloatArray) -> list[FloatArray]:
    """Strength, displacement and ductility: motions x levels x periods."""
    motions, periods = elastic.shape
    displacement = np.repeat(elastic[:, None, :], len(levels), axis=1)
    ductility = np.zeros_like(displacement)
    finite = np.flatnonzero(np.isfinite(levels))
    motion, level, period = (
        grid.ravel() for grid in np.meshgrid(range(motions), finite, range(periods), indexing="ij")
    )
    if len(motion):
        peaks = runner.peaks(period, motion, 1.0 / levels[level])
        displacement[motion, level, period] = peaks * levels[level]
        ductility[motion, level, period] = peaks / unit[period]
    return [np.broadcast_to(levels[None, :, None], displacement.shape), displacement, ductility]


def _of_ductilities(runner: Oscillators, levels: FloatArray, strong: FloatArray, unit: FloatArray) -> list[FloatArray]:
    """As `_of_strengths`; `strong` is C_e, motions x periods."""
    motions, periods = strong.shape
    motion, period = (grid.ravel() for grid in np.meshgrid(range(motions), range(periods), indexing="ij"))
    start = strong.ravel()

    def demand(pairs: Any, reduction: FloatArray) -> FloatArray:
        factor = reduction / start[pairs]
        demands: FloatArray = runner.peaks(period[pairs], motion[pairs], factor) / unit[period[pairs]]
        return demands

    pairs, level, step = _brackets(demand, levels, len(start))
    low, high = SCAN_STEP * (step - 1.0), SCAN_STEP * step  # ln R, with the demand below and not below the target
    while len(pairs) and float(np.max(high - low)) > TOLERANCE:
        middle = 0.5 * (low + high)
        reached = demand(pairs, np.exp(middle)) >= levels[level]
        low, high = np.where(reached, low, middle), np.where(reached, middle, high)
    reduction = np.ones((len(start), len(levels)))
    reduction[pairs, level] = np.exp(high)
    every = np.repeat(np.arange(len(start)), len(levels))
    demands = demand(every, reduction.ravel()).reshape(reduction.shape)
    demands = np.where(levels[None, :] == 1.0, 1.0, demands)
    strength = start[:, None] / reduction
    shape = (motions, periods, len(levels))
    displacement = demands * strength * np.repeat(unit[None, :], motions, axis=0).reshape(-1, 1)
    return [values.reshape(shape).swapaxes(1, 2) for values in (strength, displacement, demands)]


def _brackets(demand: Any, levels: FloatArray, count: int) -> tuple[Any, Any, Any]:
    """Pair, level and step of the scan at which the demand first reaches a ductility above 1."""
    first = np.zeros((count, len(levels)), dtype=np.int64)
    first[:, levels == 1.0] = -1
    active = np.flatnonzero((first == 0).any(axis=1))
    done = 0
    while len(active):
        if done >= _MOST_STEPS:
            raise SimulationError(
                f"strength of {len(active)} oscillators has no ductility of {levels.max():g} down to a "
                f"reduction of {np.exp(SCAN_STEP * done):.3g}"
            )
        steps = np.arange(done + 1, done + _CHUNK + 1)
        many = np.repeat(active, _CHUNK)
        demands = demand(many, np.exp(SCAN_STEP * np.tile(steps, len(active)))).reshape(len(active), _CHUNK)
        for index, ductility in enumerate(levels):
            reached = demands >= ductility
            start = np.where(reached.any(axis=1), steps[reached.argmax(axis=1)], 0)
            first[active, index] = np.where(first[active, index] == 0, start, first[active, index])
        active = active[(first[active] == 0).any(axis=1)]
        done += _CHUNK
    pairs, level = np.nonzero(first > 0)
    return pairs, level, first[pairs, level].astype(np.float64)
