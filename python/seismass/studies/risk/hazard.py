"""Hazard curves: the annual rate at which an intensity is exceeded, a power law between the points of a table.

Reading a table of the user's is in `hazard_file`; integrals of fragilities over a curve are in `annual_rate`.
"""

from __future__ import annotations

import csv
import io
import os
import re
from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption, RecordFormatError
from seismass.base.files import read_utf8
from seismass.base.limits import MOST_TABLE, within_rows
from seismass.base.units import unit_by_name
from seismass.base.values import (
    FloatArray,
    Value,
    as_array,
    as_flag,
    as_path,
    as_positive,
    brief,
    frozen,
    printable,
    refusal,
    short,
)
from seismass.base.views import Card

RATE_WORDS: Final = frozenset({"rate", "rates", "lambda", "frequency", "afe", "mafe"})
"""Words of which one is in the name of the column of rates."""
INTENSITY_WORDS: Final = frozenset({"sa", "im", "iml", "pga", "intensity", "acceleration"})
"""Words with which the name of the column of intensities begins."""
_OTHER_UNITS: Final = frozenset({"m", "cm", "mm", "gal", "gals", "ms2", "cms2", "percent"})


def read_hazard(path: str | os.PathLike[str]) -> tuple[FloatArray, FloatArray, str]:
    """Return intensities (g), annual rates and the name of a CSV; see `HazardCurve.from_csv`."""
    source = as_path(path, "hazard curve", RecordFormatError)
    try:
        text = read_utf8(source, MOST_TABLE)
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "not text"
        got = f"{source} ({reason})"
        raise refusal(RecordFormatError, "path", "hazard curve", "a file of text that can be read", got) from None
    return (*_parsed(text, printable(source.name)), printable(source.stem))


def _parsed(text: str, file: str) -> tuple[FloatArray, FloatArray]:
    rows = _rows(within_rows(text, file, RecordFormatError), file)
    columns = (0, 1)
    if rows and not all(_number(cell) is not None for cell in rows[0][1][:2]):
        line, header = rows.pop(0)
        columns = _columns(header, f"{file}, line {line},")
    points: list[tuple[float, float]] = []
    for line, row in rows:
        place = f"{file}, line {line},"
        values = []
        for name, column in zip(("intensity", "annual rate"), columns, strict=True):
            cell = row[column] if column < len(row) else ""
            value = _number(cell)
            if value is None or not 0.0 < value < np.inf:
                raise refusal(RecordFormatError, name, place, "a positive number", brief(cell))
            values.append(value)
        if points:
            for name, now, before, larger in zip(
                ("intensity", "annual rate"), values, points[-1], (True, False), strict=True
            ):
                if not (now > before if larger else now < before):
                    requirement = f"{'above' if larger else 'below'} that of the point before"
                    raise refusal(RecordFormatError, name, place, requirement, f"{now:g} after {before:g}")
        points.append((values[0], values[1]))
    if len(points) < 2:
        requirement = "at least two rows of intensity and annual rate"
        raise refusal(RecordFormatError, "points", file, requirement, str(len(points)))
    intensities, rates = zip(*points, strict=True)
    return frozen(intensities), frozen(rates)


def _rows(text: str, file: str) -> list[tuple[int, list[str]]]:
    """Rows that are neither empty nor comments, each with its line, counted from 1."""
    reader = csv.reader(io.StringIO(text))
    rows = []
    try:
        for row in reader:
            cells = [cell.strip() for cell in row]
            if any(cells) and not cells[0].startswith("#"):
                rows.append((reader.line_num, cells))
    except csv.Error as error:
        raise refusal(RecordFormatError, "content", file, "a table in CSV", str(error)) from error
    return rows


def _columns(header: list[str], place: str) -> tuple[int, int]:
    """Index of the intensity and of the rate, by the words of their names."""
    words = [re.findall(r"[a-z]+\d*", cell.lower()) for cell in header]
    rates = [index for index, cell in enumerate(words) if RATE_WORDS.intersection(cell)]
    intensities = [
        index for index, cell in enumerate(words) if index not in rates and cell and cell[0] in INTENSITY_WORDS
    ]
    if len(rates) != 1 or len(intensities) != 1:
        requirement = "one of an intensity (Sa, IM, PGA) and one of an annual rate (rate, lambda, MAFE)"
        raise refusal(RecordFormatError, "columns", place, requirement, short(", ".join(header)))
    unit = unit_by_name(re.sub(r".*[(\[]|[)\]]\s*$", "", header[intensities[0]]))
    if unit not in (None, "g") or _OTHER_UNITS.intersection(words[intensities[0]][1:]):
        raise refusal(RecordFormatError, "unit of the intensity", place, "g", short(header[intensities[0]]))
    if re.search(r"(?<![\d.])(?!1\D)\d+[\s_-]*y", header[rates[0]].lower()):
        raise refusal(RecordFormatError, "rate", place, "annual", short(header[rates[0]]))
    return intensities[0], rates[0]


def _number(cell: str) -> float | None:
    try:
        return float(cell)
    except ValueError:
        return None


OWNER: Final = "hazard curve"
DESIGN_RATE: Final = 1.0 / 475.0
"""Annual rate of 10 % in 50 years, the usual design intensity: -50/ln(0.9) is 475 years."""


class HazardCurve(Value, Card):
    """Annual rate at which an intensity is exceeded at a site, a straight line in logarithms between its points.

    Between two points the rate is the power law rate = rate_i (Sa/Sa_i)^-k with the slope k of the segment, so that
    integrals over the curve have closed forms (see `annual_rate`).

    Parameters
    ----------
    sa_g : array_like, shape (points,)
        Intensities (g), strictly increasing: the spectral acceleration at `period`, or another intensity in g.
    rate : array_like, shape (points,)
        Annual rates of exceedance (1/year), positive and strictly decreasing.
    period : float, optional
        Period of the spectral acceleration (s), where it is known.
    label : str, optional
        What the curve is, as texts and figures name it.

    Attributes
    ----------
    sa_g, period, label
        As given; `sa_g` is read-only.
    annual_rate : ndarray, shape (points,)
        The rates as given.

    Raises
    ------
    InvalidOption
        Fewer than two points, lists of different lengths, values that are not positive or not in order.

    See Also
    --------
    HazardCurve.from_csv : Reads a table.
    seismass.studies.risk.annual_rate : Integrates a fragility over a curve.

    Examples
    --------
    >>> import seismass as sm
    >>> hazard = sm.risk.HazardCurve([0.05, 0.2, 1.0], [2e-2, 2e-3, 4e-5])
    >>> round(hazard.rate(0.1), 6)
    0.006325
    >>> round(hazard.intensity(1 / 475), 3)
    0.194
    >>> round(hazard.probability(0.2, years=50), 4)
    0.0952
    """

    __slots__ = ("annual_rate", "label", "period", "sa_g")
    sa_g: FloatArray
    annual_rate: FloatArray
    period: float | None
    label: str

    def __init__(self, sa_g: ArrayLike, rate: ArrayLike, *, period: float | None = None, label: str = "") -> None:
        intensities = as_array(sa_g, "sa_g", OWNER, InvalidOption)
        rates = as_array(rate, "rate", OWNER, InvalidOption)
        if len(intensities) != len(rates):
            got = f"{len(intensities)} intensities and {len(rates)} rates"
            raise refusal(InvalidOption, "points", OWNER, "as many intensities as rates", got)
        if len(intensities) < 2:
            raise refusal(InvalidOption, "points", OWNER, "at least two", str(len(intensities)))
        for name, values, sign, order in (
            ("sa_g", intensities, 1.0, "increasing"),
            ("rate", rates, -1.0, "decreasing"),
        ):
            wrong = np.flatnonzero(~((values > 0.0) & np.isfinite(values)))
            if len(wrong):
                got = f"{values[wrong[0]]:g} in point {wrong[0] + 1}"
                raise refusal(InvalidOption, name, OWNER, "positive numbers", got)
            out_of_order = np.flatnonzero(~(sign * np.diff(values) > 0.0))
            if len(out_of_order):
                number = int(out_of_order[0]) + 1
                got = f"{values[number]:g} after {values[number - 1]:g} in point {number + 1}"
                raise refusal(InvalidOption, name, OWNER, f"strictly {order}", got)
        self._set(
            sa_g=intensities,
            annual_rate=rates,
            period=None if period is None else as_positive(period, "period", OWNER, InvalidOption),
            label=str(label),
        )

    @classmethod
    def from_csv(cls, path: str | os.PathLike[str], *, period: float | None = None, label: str = "") -> HazardCurve:
        """Read a hazard curve from a CSV of intensity (g) and annual rate of exceedance.

        Parameters
        ----------
        path : path-like
            Text in UTF-8. Lines that begin with # and empty lines are skipped. Without a header the first column is
            the intensity and the second the rate. With a header, one column of each is looked for, others are not
            used: an intensity is headed Sa, IM, IML, PGA, intensity or acceleration, a rate by a name with the word
            rate, lambda, frequency, AFE or MAFE, in any case. A unit beside the name of the intensity must be g.
        period : float, optional
            Period of the spectral acceleration (s).
        label : str, optional
            What the curve is; by default the name of the file.

        Raises
        ------
        RecordFormatError
            The file cannot be read, has no such columns, fewer than two rows, or a value that is not a positive
            number or out of order; the message has the file and the line.
        """
        intensities, rates, name = read_hazard(path)
        return cls(intensities, rates, period=period, label=label or name)

    @property
    def slopes(self) -> FloatArray:
        """Slope k = -d ln(rate)/d ln(Sa) of each segment, shape (points - 1,)."""
        return frozen(-np.diff(np.log(self.annual_rate)) / np.diff(np.log(self.sa_g)))

    def slope(self, sa_g: float) -> float:
        """Return the slope k of the segment at an intensity (g), of an end segment beyond the ends."""
        number = np.searchsorted(self.sa_g, as_positive(sa_g, "sa_g", OWNER, InvalidOption)) - 1
        return float(self.slopes[np.clip(number, 0, len(self.sa_g) - 2)])

    def rate(self, sa_g: float, *, extrapolate: bool = False) -> float:
        """Return the annual rate at which an intensity (g) is exceeded.

        Parameters
        ----------
        sa_g : float
            Intensity (g).
        extrapolate : bool, default False
            Continue the end segments beyond the ends of the curve, where an intensity is refused otherwise.

        Raises
        ------
        InvalidOption
            The intensity is not positive, or outside the curve.
        """
        intensities = as_positive(sa_g, "sa_g", OWNER, InvalidOption)
        self._check_inside(intensities, self.sa_g, "sa_g", "g", extrapolate)
        return float(self.rates(np.array([intensities]))[0])

    def intensity(self, rate: float, *, extrapolate: bool = False) -> float:
        """Return the intensity (g) that is exceeded at an annual rate; the inverse of `rate`.

        Raises
        ------
        InvalidOption
            The rate is not positive, or outside the curve where `extrapolate` is False.
        """
        rates = as_positive(rate, "rate", OWNER, InvalidOption)
        self._check_inside(rates, self.annual_rate[::-1], "rate", "a year", extrapolate)
        number = int(np.clip(np.searchsorted(-self.annual_rate, -rates, side="right") - 1, 0, len(self.sa_g) - 1))
        slope = self.slopes[min(number, len(self.sa_g) - 2)]
        return float(self.sa_g[number] * (rates / self.annual_rate[number]) ** (-1.0 / slope))

    def probability(self, sa_g: float, years: float, *, extrapolate: bool = False) -> float:
        """Return the probability that an intensity (g) is exceeded at least once in so many years.

        Exceedances are a Poisson process: 1 - exp(-rate years).
        """
        duration = as_positive(years, "years", OWNER, InvalidOption)
        return float(-np.expm1(-self.rate(sa_g, extrapolate=extrapolate) * duration))

    def rates(self, sa_g: FloatArray) -> FloatArray:
        """Return the annual rate at each of several positive intensities (g), by the end segments beyond the ends."""
        values: Any = sa_g
        if getattr(getattr(values, "dtype", None), "kind", "") not in tuple("iuf"):  # of any shape
            sa_g = as_array(values, "intensity", OWNER, InvalidOption, or_number=True)
        number = np.clip(np.searchsorted(self.sa_g, sa_g, side="right") - 1, 0, len(self.sa_g) - 1)
        slope = np.append(self.slopes, self.slopes[-1])[number]
        return np.asarray(self.annual_rate[number] * (sa_g / self.sa_g[number]) ** -slope, dtype=np.float64)

    def tilted(self, factor: float, pivot: float = DESIGN_RATE) -> HazardCurve:
        """Return the curve with all slopes multiplied by a factor, through the same intensity at an annual rate.

        Parameters
        ----------
        factor : float
            Factor of the slopes: above 1 the strong motions become rarer.
        pivot : float, default 1/475
            Annual rate at which the intensity stays as it is.

        Raises
        ------
        InvalidOption
            A value is not positive, or the factor is so large that rates leave the range of doubles.
        """
        power = as_positive(factor, "factor", OWNER, InvalidOption)
        fixed = as_positive(pivot, "pivot", OWNER, InvalidOption)
        changed = fixed * (self.annual_rate / fixed) ** power
        return self.replace(rate=changed, label=f"{self.label or 'hazard'}, slopes x {power:g}")

    def table(self) -> pl.DataFrame:
        """Return one row per point: sa_g, annual_rate, return_period (years), slope (of the segment that follows)."""
        return pl.DataFrame(
            {
                "sa_g": self.sa_g,
                "annual_rate": self.annual_rate,
                "return_period": 1.0 / self.annual_rate,
                "slope": pl.Series([*self.slopes.tolist(), None], dtype=pl.Float64),
            }
        )

    @property
    def parameters(self) -> dict[str, Any]:
        """What the curve is made of, as plain values."""
        points = {"sa_g": self.sa_g.tolist(), "annual_rate": self.annual_rate.tolist()}
        return {"label": self.label, "period": self.period, **points}

    def _check_inside(self, value: float, values: FloatArray, name: str, unit: str, extrapolate: bool) -> None:
        if not as_flag(extrapolate, "extrapolate", OWNER, InvalidOption) and not values[0] <= value <= values[-1]:
            requirement = f"within the curve, {values[0]:g} to {values[-1]:g} {unit}, or extrapolate=True"
            raise refusal(InvalidOption, name, OWNER, requirement, f"{value:g}")

    def _arguments(self) -> dict[str, Any]:
        return {"sa_g": self.sa_g, "rate": self.annual_rate, "period": self.period, "label": self.label}

    def __repr__(self) -> str:
        name = f"{self.label!r}, " if self.label else ""
        period = "" if self.period is None else f" at {self.period:g} s"
        ends = f"Sa{period} {self.sa_g[0]:g} to {self.sa_g[-1]:g} g"
        rates = f"{self.annual_rate[0]:.3g} to {self.annual_rate[-1]:.3g} a year"
        return f"HazardCurve({name}{len(self.sa_g)} points, {ends}, {rates})"


def check_hazard(hazard: Any, owner: str) -> HazardCurve:
    """Return a hazard curve."""
    if not isinstance(hazard, HazardCurve):
        raise refusal(InvalidOption, "hazard", owner, "a HazardCurve", brief(hazard))
    return hazard


def check_years(years: Any, owner: str) -> float:
    """Return a number of years for which probabilities are given."""
    return as_positive(years, "years", owner, InvalidOption)
