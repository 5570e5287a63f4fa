"""Selection of records whose scaled shape is closest to a target, with limits per event and per station."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
import polars as pl

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.values import FieldValue, FloatArray, as_count, brief, refusal
from seismass.base.views import Card
from seismass.motions.records import Record, Suite, read_suite
from seismass.motions.scaling.suite import SuiteSpectra, checked_range, suite_spectra
from seismass.motions.spectra import TargetSpectrum

Choice: TypeAlias = Literal["mean", "each"]
"""Whether the mean of those chosen is to be close to the target, or each record by itself."""

_SEQUENCE: Final = re.compile(r"RSN\d+", re.IGNORECASE)


@dataclass(frozen=True, eq=False, repr=False)
class Selection(FieldValue, Card):
    """Records that were chosen, and the table of all candidates.

    Attributes
    ----------
    suite : Suite
        The records chosen, in the order of the candidates.
    table : polars.DataFrame
        One row per candidate: `number` from 1, `record`, `event`, `station`, `factor` (of least squares in the
        logarithm), `misfit` and `largest_misfit` (root mean square and largest of abs(ln(scaled/target))), `step` at
        which it was chosen (null: it was not), `mean_misfit` of the mean of those chosen up to then (of its shape: a
        common factor is taken out), and the `reason`.
    """

    suite: Suite
    table: pl.DataFrame


def select_records(
    suite: Suite | str | os.PathLike[str],
    target: TargetSpectrum | str,
    count: int,
    *,
    period: float = 1.0,
    period_range: tuple[float, float] = (0.2, 1.5),
    max_per_event: int | None = 2,
    max_per_station: int | None = 1,
    factor_range: tuple[float, float] | None = (0.2, 5.0),
    method: Choice = "mean",
    damping: float = 0.05,
    points: int = 100,
    threads: int | None = None,
) -> Selection:
    """Return the records of a suite or folder whose scaled shape is closest to the target.

    Parameters
    ----------
    suite : Suite or path-like
        The candidates; a path is read by `read_suite`.
    target : TargetSpectrum or str
        The target.
    count : int
        Number of records to choose.
    period, period_range, points, damping, threads
        As `period`, `period_range`, `count`, `damping` and `threads` of `scale_asce7_10`.
    max_per_event : int, optional
        Most records of one event; None: any number. Synthetic records and those without an event are each their own.
    max_per_station : int, optional
        Most records of one event at one station: 1 takes one of the two components of a recording. Where event or
        station is not known, an NGA sequence number in the name (RSN767) identifies components of one recording.
    factor_range : tuple of float, optional
        Least and largest factor of a record.
    method : {"mean", "each"}, default "mean"
        At each step, the record with which the mean of those chosen is closest to the target; or the one that is
        closest by itself.

    Raises
    ------
    InvalidOption
        An argument is out of its range.
    InvalidMotion
        `suite` is not a Suite, or fewer records than requested are within the limits.

    Notes
    -----
    Each candidate has the factor of least squares in the logarithm. The search is greedy: no choice is taken back, and
    the first is the record that is closest by itself. Of equal misfits the first candidate is taken, so that the result
    does not change from run to run. Magnitude, distance and site, on which a selection should begin, are the user's.
    """
    candidates = suite if isinstance(suite, Suite) else read_suite(suite)
    wanted = as_count(count, "count", "selection", InvalidOption, least=1)
    as_word(method, get_args(Choice), "method", "selection")
    limits = {
        name: None if value is None else as_count(value, name, "selection", InvalidOption, least=1)
        for name, value in (("max_per_event", max_per_event), ("max_per_station", max_per_station))
    }
    factors_within = (0.0, np.inf) if factor_range is None else _factor_range(factor_range)
    compared = suite_spectra(
        candidates,
        target,
        period,
        damping=damping,
        period_range=checked_range(period_range),
        count=points,
        threads=threads,
    )
    factors = compared.log_factors()
    log_ratio = np.log(factors[:, None] * compared.spectra / compared.target)
    misfit = _rms(log_ratio)
    groups = {
        "max_per_event": [_event(record, number) for number, record in enumerate(candidates)],
        "max_per_station": [_recording(record, number) for number, record in enumerate(candidates)],
    }
    reasons: list[str | None] = [
        None if factors_within[0] <= factor <= factors_within[1] else _factor_reason(factor, factors_within)
        for factor in factors
    ]
    picks: list[int] = []
    means: list[float] = []
    while len(picks) < wanted:
        open_ones = [number for number, reason in enumerate(reasons) if reason is None and number not in picks]
        if not open_ones:
            got = f"{len(picks)} of {len(candidates)} within the limits"
            raise refusal(InvalidMotion, "records", "selection", f"at least {wanted} to choose", got)
        together = _misfits_of_mean(compared, factors, picks, open_ones)
        order = together if method == "mean" and picks else misfit[open_ones]
        best = int(np.argmin(order))
        picks.append(open_ones[best])
        means.append(float(together[best]))
        _close(reasons, groups, limits, candidates, picks)
    table = _table(candidates, factors, log_ratio, picks, means, method, reasons)
    records = tuple(record for number, record in enumerate(candidates) if number in picks)
    remark = f"{wanted} of {len(candidates)} records chosen: {_words(method)}"
    return Selection(Suite(candidates.name, records, candidates.excluded, (*candidates.remarks, remark)), table)


def _table(
    candidates: Suite,
    factors: FloatArray,
    log_ratio: FloatArray,
    picks: list[int],
    means: list[float],
    method: Choice,
    reasons: list[str | None],
) -> pl.DataFrame:
    """The table of `Selection`."""
    misfit = _rms(log_ratio)
    steps = {number: step for step, number in enumerate(picks, start=1)}
    rows = [
        {
            "number": number + 1,
            "record": record.name or f"motion {number + 1}",
            "event": record.event,
            "station": record.station,
            "factor": float(factors[number]),
            "misfit": float(misfit[number]),
            "largest_misfit": float(np.max(np.abs(log_ratio[number]))),
            "step": steps.get(number),
            "mean_misfit": means[steps[number] - 1] if number in steps else None,
            "reason": _reason(method, steps.get(number), reasons[number]),
        }
        for number, record in enumerate(candidates)
    ]
    schema = {"step": pl.UInt32, "number": pl.UInt32, "mean_misfit": pl.Float64}
    return pl.DataFrame(rows, schema_overrides=schema)


def _rms(log_ratio: FloatArray) -> FloatArray:
    """Root mean square over the periods, of each row."""
    return np.asarray(np.sqrt(np.mean(log_ratio**2, axis=1)))


def _factor_range(value: Any) -> tuple[float, float]:
    try:
        return checked_range(value)
    except InvalidOption:
        requirement = "two positive numbers, the smaller first"
        raise refusal(InvalidOption, "factor_range", "selection", requirement, brief(value)) from None


def _event(record: Record, number: int) -> tuple[Any, ...]:
    return (record.event.casefold(),) if record.event and not record.synthetic else (number,)


def _recording(record: Record, number: int) -> tuple[Any, ...]:
    """What two components of one recording share."""
    if record.synthetic:
        return (number,)
    if record.event and record.station:
        return (record.event.casefold(), record.station.casefold())
    sequence = _SEQUENCE.search(record.name)
    return (sequence.group().upper(),) if sequence else (number,)


def _misfits_of_mean(
    compared: SuiteSpectra, factors: FloatArray, picks: list[int], candidates: list[int]
) -> FloatArray:
    """Misfit of the mean of those chosen with each candidate."""
    scaled = factors[:, None] * compared.spectra
    total = scaled[picks].sum(axis=0)
    means = (total[None, :] + scaled[candidates]) / (len(picks) + 1)
    # The mean is compared in shape: a common factor brings it to the target anyway.
    ratio = np.log(means / compared.target)
    ratio -= ratio.mean(axis=1, keepdims=True)
    return _rms(ratio)


def _close(
    reasons: list[str | None],
    groups: dict[str, list[tuple[Any, ...]]],
    limits: dict[str, int | None],
    candidates: Suite,
    picks: list[int],
) -> None:
    """Give candidates a reason whose event or recording has as many as may be chosen."""
    last = picks[-1]
    for limit, group in groups.items():
        most = limits[limit]
        if most is None or sum(group[number] == group[last] for number in picks) < most:
            continue
        what = f"event {candidates[last].event}" if limit == "max_per_event" else "this recording"
        for number, reason in enumerate(reasons):
            if reason is None and number not in picks and group[number] == group[last]:
                reasons[number] = f"{limit} is {most}: {what} has {most} already"


def _factor_reason(factor: float, factor_range: tuple[float, float]) -> str:
    return f"factor {factor:.3g} is outside {factor_range[0]:g} to {factor_range[1]:g}"


def _words(method: str) -> str:
    return (
        "at each step the one with which their mean is closest to the target"
        if method == "mean"
        else "the closest to the target by themselves"
    )


def _reason(method: str, step: int | None, refused: str | None) -> str:
    if step is not None:
        closest = method == "each" or step == 1
        return "closest by itself" if closest else "mean closest with it"
    return refused or "others are closer"
