"""Spectral matching of records: what is given is judged, scaled by one factor, adjusted, and measured."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from threading import Event
from typing import Any, Final, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from seismass.base.arguments import ProgressLike, as_threads, is_one_of
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.values import FloatArray, as_array, as_count, as_number, brief, counted, frozen, refusal
from seismass.motions.elementary import exp, geomspace, log, rounded
from seismass.motions.matching.linear import CANCELLED
from seismass.motions.matching.result import MatchedRecord, MatchedSuite
from seismass.motions.matching.solver import Ratios, adjust
from seismass.motions.records.record import Record
from seismass.motions.records.suite import Suite
from seismass.motions.scaling.suite import FACTOR_RANGE
from seismass.motions.spectra import TargetSpectrum

GROWN: Final = 1.25
"""Growth of PGV or PGD, and of the spectrum outside the range, that is remarked."""
SHIFTED: Final = 0.25
"""Difference of the normalised build-up of Arias intensity that is remarked."""


def matching_remarks(matched: MatchedRecord, shortened: bool) -> tuple[str, ...]:
    """Return the remarks on a matched record; none for most. `shortened`: an end of it made a wavelet narrower."""
    remarks = []
    misfit = matched.misfit
    if not matched.converged:
        worst = matched.periods[int(np.argmax(np.abs(matched.ratio_after - 1.0)))]
        remarks.append(
            f"not matched within {100.0 * matched.tolerance:g} %: the largest misfit is {100.0 * misfit.largest:.1f} % "
            f"at {worst:.3g} s after {counted(matched.iterations, 'pass', 'passes')}"
        )
    if not FACTOR_RANGE[0] <= abs(matched.factor) <= FACTOR_RANGE[1]:
        remarks.append(
            f"scaled by {matched.factor:.3g} first, outside {FACTOR_RANGE[0]:g} to {FACTOR_RANGE[1]:g}: far from the "
            "motion that was recorded"
        )
    for name, unit, before, after in (
        ("PGV", "m/s", matched.original.pgv, matched.record.pgv),
        ("PGD", "m", matched.original.pgd, matched.record.pgd),
    ):
        if after > GROWN * before:
            remarks.append(f"{name} grew from {before:.3g} to {after:.3g} {unit}, times {after / before:.2f}")
    for name, ratio in matched.outside.items():
        if ratio > GROWN:
            remarks.append(f"the spectrum at {name} periods than those matched grew by {ratio:.2f} on average")
    if matched.husid_difference > SHIFTED:
        remarks.append(
            f"the build-up of Arias intensity differs by up to {100.0 * matched.husid_difference:.0f} % of its end"
        )
    if shortened:
        remarks.append("an end of the record left less room than some wavelets have; they were made narrower")
    return tuple(remarks)


Target: TypeAlias = TargetSpectrum | Callable[[FloatArray], ArrayLike]
"""Pseudo-acceleration (m/s2) at periods (s)."""

DEFAULT_PERIODS: Final = (0.2, 1.5)
"""Range (s): 0.2 T to 1.5 T for T = 1 s."""
DEFAULT_TOLERANCE: Final = 0.03
"""Largest misfit |ratio - 1| at any period."""
SPACING: Final = 0.25
"""Ratio of neighbouring periods that are matched: 1 plus this share of the damping, and no less than `CLOSEST`.

The half-power band of an oscillator is 2 damping wide; 1.0125 at 5 % damping."""
CLOSEST: Final = 0.005
"""Least spacing of matched periods."""
GUARDED: Final = 5.0
"""How far beyond the range, as a ratio of periods, the spectrum is held."""
GUARD_SPACING: Final = 1.15
"""Ratio of neighbouring periods there."""
GROWTH: Final = 1.25
"""Growth of the spectrum there that is not held."""
STEPS_PER_PERIOD: Final = 4.0
"""Time steps in the shortest period that is matched."""
WIDE: Final = (0.02, 10.0)
"""Range of periods (s) over which the spectra are given before and after, outside the range that is matched too."""
AWAKE: Final = 0.1
"""Longest time (s) after which a suite that is being matched sees that it was interrupted."""
AT_ONCE: Final = 2
"""Records of a suite that are matched at a time."""
FACTOR_BITS, LIMIT_BITS = 41, 32
"""Bits of the factor and of the limits outside the range, which come from spectra: the kernel's paths with and without
fused multiply-add differ in the last ones."""
_SHORTEST_RECORD: Final = 8


def match_spectrum(
    record: Record,
    target: Target,
    *,
    periods: ArrayLike = DEFAULT_PERIODS,
    damping: float = 0.05,
    points: int | None = None,
    tolerance: float = DEFAULT_TOLERANCE,
    max_iterations: int = 40,
    scale: Literal["least_squares", "none"] | float = "least_squares",
    padding: tuple[float, float] = (0.0, 0.0),
    threads: int | None = None,
) -> MatchedRecord:
    """Return a record adjusted in the time domain until its spectrum is the target over a range of periods.

    The record is multiplied by one factor; then wavelets are added that leave no final velocity or displacement,
    so that both end as those of the scaled record do. Spectra are exact for acceleration that is linear between
    samples. A record whose largest misfit is within the tolerance as it is comes back as it is.

    Parameters
    ----------
    record : Record
        What is matched; a vertical component is multiplied by the same factor and not matched.
    target : TargetSpectrum or callable
        Pseudo-acceleration (m/s2) at periods (s), for the damping below.
    periods : array_like, optional
        Two numbers: the range (s). More: the periods themselves, increasing; between them is looked at, too.
    damping : float, default 0.05
        Ratio of critical damping of the spectra.
    points : int, optional
        Periods in the range at which wavelets are fitted, in geometric spacing; by default so many that neighbours
        differ by a quarter of the damping. The misfit is judged at three times as many.
    tolerance : float, optional
        Largest misfit, abs(Sa/target - 1), at any of the periods at which it is judged.
    max_iterations : int, default 40
        Largest number of passes; 0 for the scaled record.
    scale : {"least_squares", "none"} or float, default "least_squares"
        How the record is scaled first: to the target by least squares in the logarithm, not at all, or by this factor.
    padding : tuple of float, optional
        Zeros (s) added before and after the record, where wavelets need room: for a record that begins with its
        strong motion, or is short beside the longest period. The time axis then begins earlier.
    threads : int, optional
        Number of threads for the spectra; default all cores. The result does not depend on it.

    Returns
    -------
    MatchedRecord
        The matched record, the scaled one, spectra, misfit and measures before and after. Whether the tolerance was
        reached is its `converged`; where it was not, the best that was found is returned, and a remark says so.

    Raises
    ------
    InvalidOption
        An option out of its range, a shortest period below four time steps, or a target that cannot be evaluated.
    InvalidMotion
        Something other than a record, fewer than 8 samples, or accelerations of zero throughout.

    Notes
    -----
    Al Atik and Abrahamson (2010), An improved method for nonstationary spectral matching, Earthquake Spectra
    26:601-617, after Lilhanand and Tseng (1988). Changed here: the wavelets are second differences of a displacement
    that is zero at its ends, peaks are found in continuous time, all periods are adjusted at once, other extrema that
    would grow past the target are held there, the spectrum outside the range is held, and the sum of the wavelets is
    sought again in each pass.

    A matched record has the spectrum of no earthquake. A suite of them has lost the scatter from record to record, so
    that it serves for mean response, not for its dispersion; ASCE/SEI 7-16, 16.2.3.3, asks for a mean of 110 % of the
    target where records are matched.

    Examples
    --------
    >>> import seismass as sm
    >>> matched = sm.matching.match_spectrum(sm.builtin_suite()[0], sm.TargetSpectrum.asce7(), tolerance=0.05)
    >>> matched.converged, bool(abs(matched.ratio_after - 1.0).max() <= 0.05)
    (True, True)
    """
    _check_record(record)
    ratio, largest = _share(damping, "damping"), _share(tolerance, "tolerance")
    passes = as_count(max_iterations, "max_iterations", "matching", InvalidOption)
    workers = as_threads(threads, "matching")
    matched = _periods(periods, points, ratio, record)
    before, after = _padding(padding)
    fitted, judged = _refined(matched, 2), _refined(matched, 3)
    ordinates = {count: _ordinates(target, grid) for count, grid in ((1, matched), (2, fitted), (3, judged))}
    fitted_ratios = Ratios(fitted, ordinates[2], ratio, record.dt, workers)
    final = Ratios(judged, ordinates[3], ratio, record.dt, workers)

    unmatched = np.array(record.acceleration)
    unmatched_ratios = final([unmatched])[0]
    padded = before > 0.0 or after > 0.0
    factor = _factor(scale, unmatched_ratios, largest)
    original = record if factor == 1.0 else record.scaled(factor)
    if padded:
        original = _padded(original, before, after)
    start = np.array(original.acceleration)
    adjusted = adjust(
        start,
        record.dt,
        matched,
        ordinates[1],
        _guards(matched, ordinates[1], start, ratio, record.dt, workers),
        fitted_ratios,
        final,
        damping=ratio,
        tolerance=largest,
        max_iterations=passes,
    )
    ratios = final([start, adjusted.acceleration])
    result = original
    label = getattr(target, "label", "a given function of the period")
    if factor != 1.0 or padded or adjusted.best > 0:
        note = (
            f"matched to {label} from {matched[0]:g} to {matched[-1]:g} s at {100.0 * ratio:g} % damping: "
            f"{counted(adjusted.best, 'pass', 'passes')}, "
            f"largest misfit {100.0 * np.max(np.abs(ratios[1] - 1.0)):.2f} %"
        )
        result = original.replace(
            acceleration=adjusted.acceleration,
            history=(*original.history, note),
            remarks=(*original.remarks, "matched to a spectrum: not as recorded"),
        )
    wide = geomspace(max(WIDE[0], record.dt), max(WIDE[1], 2.0 * matched[-1]), 160)
    unit_target = np.ones(len(wide))
    spectra = Ratios(wide, unit_target, ratio, record.dt, workers)([start, result.acceleration])
    matched_record = MatchedRecord(
        record=result,
        original=original,
        factor=factor,
        target=label,
        damping=ratio,
        tolerance=largest,
        iterations=adjusted.iterations,
        matched_periods=frozen(matched),
        periods=frozen(judged),
        ordinates=frozen(ordinates[3]),
        ratio_before=frozen(ratios[0]),
        ratio_after=frozen(ratios[1]),
        wide_periods=frozen(wide),
        wide_before=frozen(spectra[0]),
        wide_after=frozen(spectra[1]),
        remarks=(),
    )
    return matched_record.with_remarks(matching_remarks(matched_record, adjusted.shortened))


def match_suite(
    records: Iterable[Record],
    target: Target,
    *,
    progress: ProgressLike = None,
    **options: Any,
) -> MatchedSuite:
    """Return a suite in which every record is matched to the target by `match_spectrum`, which takes the options.

    Parameters
    ----------
    records : Suite or iterable of Record
        What is matched, in order.
    target : TargetSpectrum or callable
        As for `match_spectrum`.
    progress : callable, optional
        Called with the number of records that are matched and of all, before the first and after each.
    **options
        Those of `match_spectrum`.

    Raises
    ------
    InvalidOption, InvalidMotion
        As for `match_spectrum`, or no record.
    """
    try:
        listed: Sequence[Any] = [records] if isinstance(records, Record) else list(records)
    except TypeError:
        raise refusal(InvalidMotion, "records", "matching", "Records", brief(records)) from None
    if not listed:
        raise refusal(InvalidMotion, "records", "matching", "at least one Record", "none")
    name = records.name if isinstance(records, Suite) else "records"
    suite_remarks = records.remarks if isinstance(records, Suite) else ()
    tell = progress or (lambda done, total: None)
    tell(0, len(listed))
    done: list[MatchedRecord] = []
    cancelled = Event()

    def matched_unless_cancelled(record: Any) -> MatchedRecord:
        CANCELLED.set(cancelled)
        return match_spectrum(record, target, **options)

    # Two at a time: what one does in Python, the other does in libraries that let it.
    with ThreadPoolExecutor(AT_ONCE) as pool:
        try:
            for future in [pool.submit(matched_unless_cancelled, record) for record in listed]:
                # A signal may reach another thread than this one, which sees it when it wakes.
                while not wait([future], timeout=AWAKE).done:
                    pass
                done.append(future.result())
                tell(len(done), len(listed))
        except BaseException:
            cancelled.set()
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    matched = tuple(done)
    note = f"matched to {matched[0].target}: the scatter from record to record is taken out of the spectra"
    suite = Suite(f"{name}, matched", tuple(one.record for one in matched), remarks=(*suite_remarks, note))
    return MatchedSuite(suite, matched)


def _check_record(record: Any) -> None:
    """Refuse what cannot be matched."""
    if not isinstance(record, Record):
        raise refusal(InvalidMotion, "record", "matching", "a Record", brief(record))
    what = f"record {record.name}".rstrip()
    if record.samples < _SHORTEST_RECORD:
        raise refusal(InvalidMotion, "samples", what, f"at least {_SHORTEST_RECORD}", f"{record.samples}")
    if not np.any(record.acceleration):
        raise refusal(InvalidMotion, "acceleration", what, "other than zero somewhere", "zero throughout")


def _share(share: Any, name: str) -> float:
    """A number above 0 and below 1."""
    value = as_number(share, name, "matching", InvalidOption)
    if not 0.0 < value < 1.0:
        raise refusal(InvalidOption, name, "matching", "above 0 and below 1", f"{value:g}")
    return value


def _periods(periods: ArrayLike, points: int | None, damping: float, record: Record) -> FloatArray:
    """The periods that are matched."""
    array = as_array(periods, "periods", "matching", InvalidOption)
    wrong = len(array) < 2 or not np.all(np.isfinite(array)) or np.any(array <= 0.0) or np.any(np.diff(array) <= 0.0)
    if wrong:
        requirement = "a range of two positive numbers, or a list of more, increasing"
        raise refusal(InvalidOption, "periods", "matching", requirement, brief(periods))
    least = STEPS_PER_PERIOD * record.dt
    if array[0] < least * (1.0 - 1e-9):
        what = f"matching of record {record.name}".rstrip()
        requirement = f"at least four time steps, {least:g} s, or the record resampled"
        raise refusal(InvalidOption, "shortest period", what, requirement, f"{array[0]:g} s")
    if len(array) > 2:
        if points is not None:
            raise refusal(InvalidOption, "points", "matching", "left out for a list of periods", brief(points))
        return array
    span = float(log(array[1] / array[0]))
    if points is None:
        count = max(int(np.ceil(span / max(SPACING * damping, CLOSEST))) + 1, 2)
    else:
        count = as_count(points, "points", "matching", InvalidOption, least=2)
    return geomspace(float(array[0]), float(array[1]), count)


def _refined(periods: FloatArray, parts: int) -> FloatArray:
    """Return the periods with `parts` - 1 more between neighbours, in geometric spacing."""
    number = np.arange(len(periods))
    finer = np.arange(parts * (len(periods) - 1) + 1) / parts
    refined = exp(np.interp(finer, number, log(periods)))
    refined[::parts] = periods
    return np.asarray(refined)


def _ordinates(target: Target, periods: FloatArray) -> FloatArray:
    """The target at periods, checked."""
    if not callable(target):
        raise refusal(InvalidOption, "target", "matching", "a TargetSpectrum or a function of periods", brief(target))
    if isinstance(target, type):
        raise refusal(InvalidOption, "target", "matching", "a TargetSpectrum or a function of periods", brief(target))
    ordinates = as_array(target(periods), "target", "matching", InvalidOption)
    if ordinates.shape != periods.shape:
        got = f"{len(ordinates)} for {len(periods)} periods"
        raise refusal(InvalidOption, "target", "matching", "one ordinate per period", got)
    wrong = ~(np.isfinite(ordinates) & (ordinates > 0.0))
    if wrong.any():
        got = f"{ordinates[wrong][0]:g} at {periods[wrong][0]:g} s"
        raise refusal(InvalidOption, "target", "matching", "a positive number at every period", got)
    return ordinates


def _guards(
    periods: FloatArray, target: FloatArray, motion: FloatArray, damping: float, dt: float, threads: int | None
) -> tuple[FloatArray, FloatArray]:
    """Periods outside the range and the pseudo-acceleration that the spectrum must not exceed there: `GROWTH` times the
    motion's, or if larger the target's continuation: a line from 0.4 at T = 0, and 1/T beyond the end.
    """
    shortest, longest = float(periods[0]), float(periods[-1])
    first = max(shortest / GUARDED, STEPS_PER_PERIOD * dt)
    parts: list[FloatArray] = []
    if first < shortest / GUARD_SPACING:
        count = int(log(shortest / GUARD_SPACING / first) / log(GUARD_SPACING)) + 1
        parts.append(geomspace(first, shortest / GUARD_SPACING, max(count, 1)))
    exponents = np.arange(1.0, int(log(GUARDED) / log(GUARD_SPACING)) + 1.0)
    parts.append(longest * exp(float(log(GUARD_SPACING)) * exponents))
    guarded = np.concatenate(parts)
    ratios = rounded(Ratios(guarded, np.ones(len(guarded)), damping, dt, threads)([motion])[0], LIMIT_BITS)
    short = target[0] * (0.4 + 0.6 * guarded / shortest)
    return guarded, np.maximum(GROWTH * ratios, np.where(guarded < shortest, short, target[-1] * longest / guarded))


def _factor(scale: Literal["least_squares", "none"] | float, ratios: FloatArray, tolerance: float) -> float:
    """The factor by which the record is multiplied first: 1 where it is within the tolerance as it is."""
    if isinstance(scale, str):
        if not is_one_of(scale, ("least_squares", "none")):
            raise refusal(InvalidOption, "scale", "matching", "least_squares, none or a factor", brief(scale))
        if scale == "none" or np.max(np.abs(ratios - 1.0)) <= tolerance:
            return 1.0
        return float(rounded(exp(-np.mean(log(ratios))), FACTOR_BITS))
    factor = as_number(scale, "scale", "matching", InvalidOption)
    if not (np.isfinite(factor) and factor != 0.0):
        raise refusal(InvalidOption, "scale", "matching", "least_squares, none or a factor other than 0", f"{factor:g}")
    return factor


def _padding(seconds: tuple[float, float]) -> tuple[float, float]:
    requirement = "two times of at least 0 s, before and behind"
    try:
        before, after = seconds
    except (TypeError, ValueError):
        raise refusal(InvalidOption, "padding", "matching", requirement, brief(seconds)) from None
    times = [as_number(value, "padding", "matching", InvalidOption) for value in (before, after)]
    if not all(np.isfinite(value) and value >= 0.0 for value in times):
        raise refusal(InvalidOption, "padding", "matching", requirement, brief(seconds))
    return times[0], times[1]


def _padded(record: Record, before: float, after: float) -> Record:
    """The record with zeros before and after it, as its history says."""
    counts = (int(np.ceil(before / record.dt - 1e-9)), int(np.ceil(after / record.dt - 1e-9)))
    note = f"{counts[0]} zeros added before the first sample, {counts[1]} behind the last"
    return record.replace(
        acceleration=np.pad(record.acceleration, counts),
        vertical=None if record.vertical is None else np.pad(record.vertical, counts),
        history=(*record.history, note),
    )
