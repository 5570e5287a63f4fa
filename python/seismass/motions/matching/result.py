"""A record before and after spectral matching: what was reached and what else changed, as values, tables, text."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import polars as pl

from seismass.base.arguments import is_one_of
from seismass.base.errors import InvalidOption
from seismass.base.files import write_file
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FieldValue, FloatArray, as_path, brief, counted, refusal
from seismass.base.views import Card, view
from seismass.motions.records.intensity import build_up
from seismass.motions.records.record import Record
from seismass.motions.records.suite import Suite

if TYPE_CHECKING:
    from matplotlib.figure import Figure


SUFFIXES = (".at2", ".csv")


def write_record(record: Record, path: str | os.PathLike[str]) -> None:
    """Write a record as .AT2, in g to eleven digits, or .csv, time (s) and acceleration (m/s2) to the last bit, by the
    suffix of `path`. A vertical component is left out.
    """
    target = as_path(path, "matched record", InvalidOption)
    kind = target.suffix.lower()
    if not is_one_of(kind, SUFFIXES):
        raise refusal(InvalidOption, "path", "matched record", "a name that ends in .AT2 or .csv", brief(target.name))
    write_file(target, at2_text(record) if kind == ".at2" else _csv(record))


def at2_text(record: Record) -> str:
    """Return a matched record as an .AT2 file."""
    values = record.acceleration / STANDARD_GRAVITY
    step = f"{record.dt:.10f}".rstrip("0")
    head = (
        "SPECTRALLY MATCHED MOTION, NOT AS RECORDED (seismass)",
        _one_line(", ".join((record.event, record.station, record.component))),
        "ACCELERATION TIME SERIES IN UNITS OF G",
        f"NPTS= {record.samples:6d}, DT= {step} SEC",
    )
    lines = ("".join(f"{value:18.10E}" for value in values[row : row + 5]) for row in range(0, len(values), 5))
    return "\n".join((*head, *lines)) + "\n"


def _csv(record: Record) -> str:
    comments = [f"# {_one_line(sentence)}" for sentence in (*record.history, *record.remarks)]
    rows = (f"{number * record.dt:.10g},{value!r}" for number, value in enumerate(record.acceleration.tolist()))
    return "\n".join((*comments, "time (s),acceleration (m/s2)", *rows)) + "\n"


def _one_line(text: str) -> str:
    return " ".join(text.split())


_QUANTITIES = ("pga_g", "pgv", "pgd", "end_velocity", "end_displacement", "arias", "d5_75", "d5_95", "cav")


class Misfit(NamedTuple):
    """Deviation of a spectrum from the target over the periods at which it is judged."""

    largest: float
    """Largest abs(Sa/target - 1)."""
    rms: float
    """Root mean square of Sa/target - 1."""
    lowest: float
    """Lowest Sa/target."""
    highest: float
    """Highest Sa/target."""


def _misfit(ratios: FloatArray) -> Misfit:
    off = ratios - 1.0
    rms = float(np.sqrt(np.mean(off * off)))
    return Misfit(float(np.max(np.abs(off))), rms, float(ratios.min()), float(ratios.max()))


@dataclass(frozen=True, eq=False)
class MatchedRecord(FieldValue, Card):
    """A record whose spectrum was matched to a target.

    Attributes
    ----------
    record : Record
        The matched motion; its history says what was done.
    original : Record
        The record as it was given, times the factor, with the zeros that were added.
    factor : float
        By which it was multiplied first.
    target : str
        What the target is.
    damping, tolerance : float
        Ratio of critical damping of the spectra, and the tolerance of the misfit.
    iterations : int
        Passes made.
    matched_periods : ndarray
        Periods (s) at which wavelets were fitted.
    periods, ordinates : ndarray, shape (periods,)
        Periods (s) at which the misfit is judged, those matched and two between each two of them, and the target there
        (m/s2).
    ratio_before, ratio_after : ndarray, shape (periods,)
        Pseudo-acceleration over the target, of `original` and of `record`.
    wide_periods, wide_before, wide_after : ndarray
        Periods (s) beyond the range that was matched, and pseudo-acceleration there (m/s2).
    remarks : tuple of str
        What was not reached, and what else has changed by much.
    """

    record: Record
    original: Record
    factor: float
    target: str
    damping: float
    tolerance: float
    iterations: int
    matched_periods: FloatArray
    periods: FloatArray
    ordinates: FloatArray
    ratio_before: FloatArray
    ratio_after: FloatArray
    wide_periods: FloatArray
    wide_before: FloatArray
    wide_after: FloatArray
    remarks: tuple[str, ...]

    def __repr__(self) -> str:
        name, largest = self.record.name or "(unnamed)", 100.0 * self.misfit.largest
        state = "" if self.converged else ", not converged"
        passes = counted(self.iterations, "pass", "passes")
        return f"<MatchedRecord {name}: misfit up to {largest:.2f} % in {passes}{state}>"

    def with_remarks(self, remarks: tuple[str, ...]) -> MatchedRecord:
        """Return the same result with these remarks."""
        return replace(self, remarks=remarks)

    @property
    def misfit_before(self) -> Misfit:
        """Misfit of the scaled record."""
        return _misfit(self.ratio_before)

    @property
    def misfit(self) -> Misfit:
        """Misfit of the matched record."""
        return _misfit(self.ratio_after)

    @property
    def converged(self) -> bool:
        """Whether the largest misfit is within the tolerance."""
        return self.misfit.largest <= self.tolerance

    @property
    def build_up(self) -> tuple[FloatArray, FloatArray]:
        """Arias intensity up to each sample over that at the end, before and after (Husid 1969), shape (samples,)."""
        before, after = (build_up(one.acceleration, one.dt) for one in (self.original, self.record))
        return before / before[-1], after / after[-1]

    @cached_property
    def husid_difference(self) -> float:
        """Largest difference of the two normalised build-ups."""
        before, after = self.build_up
        return float(np.max(np.abs(after - before)))

    @property
    def outside(self) -> dict[str, float]:
        """Mean ratio of the spectra after to before, in the logarithm, at shorter and at longer periods than matched.

        Shorter from a fifth of the shortest, longer up to five times the longest period; empty where there is none.
        """
        shortest, longest = self.matched_periods[0], self.matched_periods[-1]
        wide, grown = self.wide_periods, np.log(self.wide_after / self.wide_before)
        ranges = {
            "shorter": (0.2 * shortest <= wide) & (wide < shortest),
            "longer": (longest < wide) & (wide <= 5.0 * longest),
        }
        return {name: float(np.exp(grown[inside].mean())) for name, inside in ranges.items() if inside.any()}

    def table(self) -> pl.DataFrame:
        """Return one row per quantity, before and after: misfit, peaks, ends and intensity measures.

        Units as in the names of `Record.measures`: g, m/s, m, m/s, s.
        """
        before, after = self.original.measures(), self.record.measures()
        rows: dict[str, tuple[float | None, float | None]] = {
            "largest_misfit": (self.misfit_before.largest, self.misfit.largest),
            "rms_misfit": (self.misfit_before.rms, self.misfit.rms),
        }
        rows |= {name: (before[name], after[name]) for name in _QUANTITIES}
        rows["husid_difference"] = (None, self.husid_difference)
        rows |= {f"spectrum_at_{name}_periods": (1.0, ratio) for name, ratio in self.outside.items()}
        return pl.DataFrame(
            {
                "quantity": list(rows),
                "before": [values[0] for values in rows.values()],
                "after": [values[1] for values in rows.values()],
            },
            schema={"quantity": pl.String, "before": pl.Float64, "after": pl.Float64},
        )

    def spectrum_table(self) -> pl.DataFrame:
        """Return one row per period: target, pseudo-acceleration before and after (m/s2), and the ratios to it."""
        return pl.DataFrame(
            {
                "period": self.periods,
                "target": self.ordinates,
                "before": self.ordinates * self.ratio_before,
                "after": self.ordinates * self.ratio_after,
                "ratio_before": self.ratio_before,
                "ratio_after": self.ratio_after,
            }
        )

    @property
    def text(self) -> str:
        """What happened, in some lines."""
        before, after = self.original, self.record
        first, last = self.misfit_before, self.misfit
        state = "within" if self.converged else "NOT within"
        shortest, longest = self.matched_periods[0], self.matched_periods[-1]
        lines = [
            f"record  {after.name or '(unnamed)'}, times {self.factor:.5g}",
            f"target  {self.target}",
            f"range   {shortest:g} to {longest:g} s, {100.0 * self.damping:g} % damping, judged at {len(self.periods)} "
            "periods",
            f"misfit  {100.0 * first.largest:.1f} % at most, {100.0 * first.rms:.1f} % rms before; "
            f"{100.0 * last.largest:.2f} % and {100.0 * last.rms:.2f} % after "
            f"{counted(self.iterations, 'pass', 'passes')}, {state} {100.0 * self.tolerance:g} %",
            f"PGA     {before.pga_g:.3f} to {after.pga_g:.3f} g",
            f"PGV     {before.pgv:.3f} to {after.pgv:.3f} m/s, at the end {before.velocity[-1]:.2e} to "
            f"{after.velocity[-1]:.2e}",
            f"PGD     {before.pgd:.3f} to {after.pgd:.3f} m, at the end {before.displacement[-1]:.2e} to "
            f"{after.displacement[-1]:.2e}",
            f"Arias   {before.arias:.3f} to {after.arias:.3f} m/s, D5-95 {before.d5_95:.2f} to {after.d5_95:.2f} s, "
            f"build-up apart by {100.0 * self.husid_difference:.1f} % at most",
        ]
        if self.outside:
            ratios = ", ".join(f"{ratio:.2f} at {name} periods" for name, ratio in self.outside.items())
            lines.append(f"outside spectrum times {ratios}, on average")
        return "\n".join([*lines, *(f"remark  {remark}" for remark in self.remarks)]) + "\n"

    @view
    def plot(self) -> Figure:
        """Return the figure: spectra with the target, histories, and the build-up of Arias intensity, before and after.

        In a notebook it shows itself; `savefig` writes it.
        """
        raise NotImplementedError

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the matched record to a file that `read_record` reads: .AT2 in g, or .csv of time and m/s2.

        A CSV keeps every bit of the samples, an .AT2 file eleven digits.

        Raises
        ------
        InvalidOption
            Another suffix.
        OSError
            The file cannot be written.
        """
        write_record(self.record, path)


@dataclass(frozen=True, eq=False)
class MatchedSuite(FieldValue, Card):
    """Records matched one by one to the same target.

    Attributes
    ----------
    suite : Suite
        The matched records in order, for what takes a suite.
    matched : tuple of MatchedRecord
        How each was matched.
    """

    suite: Suite
    matched: tuple[MatchedRecord, ...]

    def __len__(self) -> int:
        return len(self.matched)

    def __iter__(self) -> Iterator[MatchedRecord]:
        return iter(self.matched)

    def __getitem__(self, index: int) -> MatchedRecord:
        return self.matched[index]

    @property
    def converged(self) -> bool:
        """Whether every record is within the tolerance."""
        return all(one.converged for one in self.matched)

    @property
    def remarks(self) -> tuple[str, ...]:
        """The remarks on each record, with its number and name, and those on the suite."""
        named = (
            f"motion {number}, {one.record.name}: {remark}"
            for number, one in enumerate(self.matched, start=1)
            for remark in one.remarks
        )
        return (*self.suite.remarks, *named)

    def table(self) -> pl.DataFrame:
        """Return one row per motion: factor, passes, misfit, and peaks and measures before and after."""
        rows = []
        for number, one in enumerate(self.matched, start=1):
            row: dict[str, object] = {
                "motion": number,
                "record": one.record.name,
                "factor": one.factor,
                "iterations": one.iterations,
                "converged": one.converged,
            }
            for quantity, before, after in one.table().iter_rows():
                if quantity == "husid_difference" or quantity.startswith("spectrum_at"):
                    row[quantity] = after
                else:
                    row |= {f"{quantity}_before": before, f"{quantity}_after": after}
            rows.append(row)
        return pl.DataFrame(rows, schema_overrides={"motion": pl.UInt32}, infer_schema_length=None)
