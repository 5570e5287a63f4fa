"""A target spectrum from a table of the user's: a CSV of period (s) and Sa (g)."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass.base.digest import inputs_digest
from seismass.base.errors import InvalidMotion, InvalidOption, RecordFormatError
from seismass.base.files import read_utf8
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import (
    FloatArray,
    as_array,
    as_number,
    as_path,
    brief,
    counted,
    frozen,
    printable,
    refusal,
    short,
)
from seismass.motions.elementary import exp, log
from seismass.motions.spectra.codes import PeriodTable
from seismass.motions.spectra.elastic import OWNER, GroundMotion, as_motions, mean_spectrum


@dataclass(frozen=True, eq=False)
class CsvTable(PeriodTable):
    """Sa (g) at periods (s) from a file, linear in logarithms between them."""

    label: str
    file: str

    @property
    def parameters(self) -> dict[str, Any]:
        """The file's name and its points."""
        return {"shape": "csv", "file": self.file, **self.points}

    def __call__(self, periods: FloatArray) -> FloatArray:
        """Return Sa (m/s2)."""
        log_ordinates = np.interp(log(periods), log(self.periods), log(self.sa_g))
        return STANDARD_GRAVITY * exp(log_ordinates)


def csv_shape(path: str | os.PathLike[str]) -> CsvTable:
    """Return the shape of a CSV, of which `TargetSpectrum.from_csv` says what it must be."""
    source = as_path(path, OWNER, RecordFormatError)
    periods, ordinates = read_table(path)
    return CsvTable(periods, ordinates, printable(source.stem), printable(source.name))


def read_table(path: str | os.PathLike[str], *, zero: bool = False) -> tuple[FloatArray, FloatArray]:
    """Return the periods (s) and Sa (g) of a CSV; with `zero` the first period may be 0."""
    source = as_path(path, OWNER, RecordFormatError)
    try:
        text = read_utf8(source)
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "not text"
        requirement = "a file of text that can be read"
        raise refusal(RecordFormatError, "path", OWNER, requirement, f"{source} ({reason})") from None
    return _parse_csv(text, source.name, zero)


def _parse_csv(text: str, file: str, zero: bool) -> tuple[FloatArray, FloatArray]:
    text, separator = _with_points(text)
    try:
        rows = [
            [cell.strip() for cell in row]
            for row in csv.reader(io.StringIO(text), delimiter=separator)
            if any(cell.strip() for cell in row) and not row[0].lstrip().startswith("#")
        ]
    except csv.Error as error:
        raise refusal(RecordFormatError, "content", file, "a table in CSV", str(error)) from error
    columns = (0, 1)
    if rows and not _is_number(rows[0][0]):
        columns = _named_columns(rows.pop(0), file)
    points = []
    for number, row in enumerate(rows, start=1):
        for name, column in zip(("period", "Sa"), columns, strict=True):
            cell = row[column] if column < len(row) else ""
            at_zero = zero and number == 1 and name == "period" and _is_number(cell) and float(cell) == 0.0
            if not (at_zero or (_is_number(cell) and 0.0 < float(cell) < np.inf)):
                raise refusal(RecordFormatError, name, f"{file}, point {number},", "a positive number", brief(cell))
        points.append([float(row[column]) for column in columns])
    if len(points) < 2:
        raise refusal(RecordFormatError, "points", file, "at least two rows of period and Sa", str(len(points)))
    periods, ordinates = (frozen(column) for column in zip(*points, strict=True))
    falling = np.flatnonzero(np.diff(periods) <= 0.0)
    if len(falling):
        number = int(falling[0]) + 2
        got = f"{periods[number - 1]:g} after {periods[number - 2]:g}"
        raise refusal(RecordFormatError, "period", f"{file}, point {number},", "longer than the one before", got)
    return periods, ordinates


def _with_points(text: str) -> tuple[str, str]:
    """Return a text with points for decimal commas, and what separates its cells: where there are semicolons, those."""
    if ";" not in text:
        return text, ","
    rows = [line for line in text.splitlines() if line.strip() and not line.lstrip().startswith("#")]
    cells = [cell for line in rows[-1:] for cell in line.split(";")]
    decimal = any("," in cell for cell in cells) and not any("." in cell for cell in cells)
    return text.replace(",", ".") if decimal else text, ";"


def _named_columns(header: list[str], file: str) -> tuple[int, int]:
    words = [cell.lower().replace("(", " ").replace("_", " ").split() for cell in header]
    indices = []
    for names in (("period", "t"), ("sa",)):
        columns = [index for index, cell in enumerate(words) if cell and cell[0] in names]
        if len(columns) != 1:
            requirement = "one period or T and one Sa"
            raise refusal(RecordFormatError, "columns", file, requirement, short(", ".join(header)))
        indices.append(columns[0])
    of_period = [word.strip("()[]") for word in words[indices[0]][1:]]
    if of_period and of_period[0] not in ("s", "sec", "seconds", ""):
        raise refusal(RecordFormatError, "unit of period", file, "s", " ".join(of_period))
    unit = [word.strip("()[]") for word in words[indices[1]][1:]]
    if unit and unit != ["g"]:
        raise refusal(RecordFormatError, "unit of Sa", file, "g", short(" ".join(unit)))
    return indices[0], indices[1]


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


CORNER_PERIODS: Final = np.geomspace(0.05, 4.0, 60)
"""Periods (s) among which `corner_period` looks for the peaks of a spectrum."""


def corner_period(spectrum: Callable[[FloatArray], ArrayLike]) -> float:
    """Return T_c, where constant acceleration and constant velocity at the peaks of a spectrum would meet.

    T_c = 2 pi max(Sv)/max(Sa) with Sv = Sa T/(2 pi), over periods from 0.05 to 4 s. Of the two-period shape of ASCE 7
    it is T_S = S_D1/S_DS.

    Parameters
    ----------
    spectrum : callable
        Takes periods (s), returns pseudo-accelerations; their unit does not matter. A `TargetSpectrum` is one, and
        `TargetSpectrum.mean_of` makes one of motions.

    Examples
    --------
    >>> import seismass as sm
    >>> from seismass.motions.spectra import corner_period
    >>> round(corner_period(sm.TargetSpectrum.asce7(sds_g=1.0, sd1_g=0.6)), 6)
    0.6
    """
    accelerations = np.asarray(spectrum(CORNER_PERIODS), dtype=np.float64)
    return float(np.max(accelerations * CORNER_PERIODS) / np.max(accelerations))


@dataclass(frozen=True, eq=False)
class HeldMotion:
    """Samples (m/s2) and time step (s) of a motion, without its labels."""

    acceleration: FloatArray
    dt: float


@dataclass(frozen=True, eq=False)
class SuiteMean:
    """Motions, their names and factors, and the damping ratio."""

    motions: tuple[HeldMotion, ...]
    names: tuple[str, ...]
    factors: FloatArray
    damping: float
    own_label: str
    longest: float = np.inf

    @property
    def label(self) -> str:
        """Name with the number of motions."""
        return (
            self.own_label
            or f"mean spectrum of {counted(len(self.motions), 'motion')}, {100.0 * self.damping:g} % damping"
        )

    @property
    def parameters(self) -> dict[str, Any]:
        """Names, factors, damping, and a digest of the samples."""
        return {
            "shape": "suite_mean",
            "records": list(self.names),
            "factors": self.factors.tolist(),
            "damping": self.damping,
            "samples_sha256": inputs_digest(self.motions),
        }

    @property
    def shortest(self) -> float:
        """A thousandth of the largest time step, as far as spectra of it go (s)."""
        return _kernel.SHORTEST_PERIOD_OVER_STEP * max(motion.dt for motion in self.motions)

    def __call__(self, periods: FloatArray) -> FloatArray:
        """Return the mean Sa (m/s2)."""
        flat = mean_spectrum(self.motions, self.factors, np.atleast_1d(periods), self.damping)
        return flat.reshape(np.shape(periods))


def mean_shape(
    records: GroundMotion | Iterable[GroundMotion], factors: ArrayLike | None, damping: float, label: str
) -> SuiteMean:
    """Return the shape; there is a finite factor for each motion."""
    suite = as_motions(records, OWNER)
    scale = frozen(np.ones(len(suite))) if factors is None else as_array(factors, "factors", OWNER, InvalidOption)
    if len(scale) != len(suite):
        requirement = f"a list of {len(suite)} values, one per motion"
        raise refusal(InvalidOption, "factors", OWNER, requirement, str(len(scale)))
    if not (np.isfinite(scale) & (scale > 0.0)).all():
        wrong = scale[~(np.isfinite(scale) & (scale > 0.0))][0]
        raise refusal(InvalidOption, "factors", OWNER, "positive numbers", f"{wrong:g}")
    ratio = as_number(damping, "damping", OWNER, InvalidOption)
    if not 0.0 <= ratio < 1.0:
        raise refusal(InvalidOption, "damping", OWNER, "at least 0 and below 1", f"{ratio:g}")
    motions = []
    for number, motion in enumerate(suite, start=1):
        owner = f"motion {number} of {OWNER}"
        samples = as_array(motion.acceleration, "acceleration", owner, InvalidMotion)
        motions.append(HeldMotion(samples, as_number(motion.dt, "dt", owner, InvalidMotion)))
    names = tuple(getattr(motion, "name", "") or f"motion {number}" for number, motion in enumerate(suite, start=1))
    return SuiteMean(tuple(motions), names, scale, ratio, label)
