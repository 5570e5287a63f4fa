"""Response spectra of ground motions, and target spectra to scale them to."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal, Protocol, TypeAlias, cast, get_args

import numpy as np
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass._values import FloatArray, as_array, as_count, as_number, as_path, brief, frozen, printable, refusal
from seismass.errors import InvalidMotion, InvalidOption, RecordFormatError
from seismass.units import STANDARD_GRAVITY

Kind: TypeAlias = Literal["pseudo_acceleration", "displacement", "pseudo_velocity"]
"""Ordinate of a spectrum: w^2 D (m/s2), D (m) or w D (m/s) of the peak relative displacement D."""

DEFAULT_SDS_G: Final = 1.07
"""Default S_DS (g): with the two below a stand-in for the Port of Long Beach, not its published spectrum."""
DEFAULT_SD1_G: Final = 0.61
"""Default S_D1 (g)."""
DEFAULT_TL: Final = 8.0
"""Default long-period transition T_L (s)."""

_POWER_OF_FREQUENCY: Final = {"displacement": 0, "pseudo_velocity": 1, "pseudo_acceleration": 2}


class GroundMotion(Protocol):
    """What a spectrum needs of a motion: a `Record` and a `Motion` both have it."""

    @property
    def acceleration(self) -> FloatArray:
        """Horizontal samples (m/s2)."""
        ...

    @property
    def dt(self) -> float:
        """Time step (s)."""
        ...


def response_spectrum(
    motions: GroundMotion | Iterable[GroundMotion],
    periods: ArrayLike,
    damping: float | Sequence[float] = 0.05,
    kind: Kind = "pseudo_acceleration",
    *,
    threads: int | None = None,
) -> FloatArray:
    """Return elastic response spectra, exact for acceleration that is linear between samples.

    Peaks are taken in continuous time, from rest at the first sample to the end of the free vibration that follows the
    motion, which goes to zero over one step after its last sample.

    Parameters
    ----------
    motions : Record, Motion or iterable of them
        One motion counts as a suite of one.
    periods : array_like, shape (periods,)
        Natural periods (s), from a thousandth of the time step; each is solved for, none is interpolated.
    damping : float or sequence of float
        Ratios of critical damping, at least 0 and below 1.
    kind : {"pseudo_acceleration", "displacement", "pseudo_velocity"}
        Ordinate, in m/s2, m or m/s.
    threads : int, optional
        Number of threads; default all cores. The result does not depend on it.

    Returns
    -------
    ndarray, shape (motions, periods), or (motions, damping, periods) for a sequence of ratios
        Spectral ordinates.

    Raises
    ------
    InvalidOption
        A period, ratio, kind or number of threads out of its range.
    InvalidMotion
        No motion, or something that is none.

    Notes
    -----
    Nigam and Jennings (1969), Bull. Seism. Soc. Am. 59:909-922.

    Examples
    --------
    A step of 1 m/s2 on an undamped oscillator: twice the static displacement.

    >>> import seismass as sm
    >>> step = sm.Motion([1.0] * 200, dt=0.01)
    >>> sm.response_spectrum(step, [0.5, 1.0], damping=0.0)
    array([[2., 2.]])
    """
    if kind not in get_args(Kind):
        raise refusal(InvalidOption, "kind", "spectrum", "one of " + ", ".join(get_args(Kind)), brief(kind))
    at = as_array(periods, "periods", "spectrum", InvalidOption)
    if len(at) == 0:
        raise refusal(InvalidOption, "periods", "spectrum", "a list of at least one period", "none")
    ratios = as_array(damping, "damping", "spectrum", InvalidOption, or_number=True)
    if ratios.size == 0:
        raise refusal(InvalidOption, "damping", "spectrum", "a number or a list of at least one ratio", "none")
    workers = None if threads is None else as_count(threads, "threads", "spectrum", InvalidOption, least=1)
    held = [_held(motion, number) for number, motion in enumerate(as_motions(motions, "spectrum"), start=1)]
    peaks = np.asarray(_kernel.response_spectra(held, at, np.atleast_1d(ratios), workers))
    ordinates = peaks * (2.0 * np.pi / at) ** _POWER_OF_FREQUENCY[kind]
    return ordinates[:, 0, :] if ratios.ndim == 0 else ordinates


def mean_spectrum(
    motions: Iterable[GroundMotion],
    factors: ArrayLike,
    periods: ArrayLike,
    damping: float = 0.05,
    *,
    threads: int | None = None,
) -> FloatArray:
    """Return the mean pseudo-acceleration spectrum (m/s2) of motions times their factors, shape (periods,)."""
    ratio = as_number(damping, "damping", "mean spectrum", InvalidOption)
    spectra = response_spectrum(motions, periods, ratio, threads=threads)
    scale = as_array(factors, "factors", "mean spectrum", InvalidOption)
    if len(scale) != len(spectra):
        raise refusal(
            InvalidOption,
            "factors",
            "mean spectrum",
            f"a list of {len(spectra)} values, one per motion",
            f"{len(scale)}",
        )
    return cast(FloatArray, np.mean(scale[:, None] * spectra, axis=0))


def _held(motion: GroundMotion, number: int) -> _kernel.Motion:
    """A motion as the kernel takes it, from samples of any kind."""
    owner = f"motion {number} of spectrum"
    samples = as_array(motion.acceleration, "acceleration", owner, InvalidMotion)
    return _kernel.Motion(samples, as_number(motion.dt, "dt", owner, InvalidMotion))


def as_motions(motions: Any, owner: str) -> list[GroundMotion]:
    """Return motions as a list; one motion is a list of one."""
    try:
        given = [motions] if hasattr(motions, "acceleration") else list(motions)
    except TypeError:
        raise refusal(InvalidMotion, "motions", owner, "Records or Motions", brief(motions)) from None
    if not given:
        raise refusal(InvalidMotion, "motions", owner, "at least one Record or Motion", "none")
    for number, motion in enumerate(given, start=1):
        if not (hasattr(motion, "acceleration") and hasattr(motion, "dt")):
            raise refusal(InvalidMotion, f"motion {number}", owner, "a Record or Motion", brief(motion))
    return given


@dataclass(frozen=True, eq=False)
class TargetSpectrum:
    """Pseudo-acceleration against period that motions are scaled to; call it with periods.

    Make one with `asce7` or `from_csv`.

    Attributes
    ----------
    label : str
        What it is, as figures and tables name it.
    parameters : dict
        What it was made from: S_DS, S_D1 (g) and T_L (s), or the file and its points.
    shortest, longest : float
        Range of periods (s); others are refused.
    """

    label: str
    parameters: dict[str, Any]
    shortest: float
    longest: float

    @classmethod
    def asce7(
        cls, sds_g: float = DEFAULT_SDS_G, sd1_g: float = DEFAULT_SD1_G, tl: float = DEFAULT_TL
    ) -> TargetSpectrum:
        """Return the two-period shape of ASCE/SEI 7-10, 11.4.5.

        S_DS (0.4 + 0.6 T/T0) below T0 = 0.2 S_D1/S_DS, S_DS up to T_S = S_D1/S_DS, S_D1/T up to T_L, S_D1 T_L/T^2
        beyond.

        Parameters
        ----------
        sds_g, sd1_g : float
            Design spectral accelerations at short periods and at 1 s (g).
        tl : float
            Long-period transition (s).

        Examples
        --------
        >>> import seismass as sm
        >>> target = sm.TargetSpectrum.asce7(sds_g=1.0, sd1_g=0.6)
        >>> (target([0.0, 0.3, 1.0, 16.0]) / 9.80665).round(6).tolist()
        [0.4, 1.0, 0.6, 0.01875]
        """
        given = {"sds_g": sds_g, "sd1_g": sd1_g, "tl": tl}
        numbers = {name: as_number(value, name, "target spectrum", InvalidOption) for name, value in given.items()}
        for name, value in numbers.items():
            if not (np.isfinite(value) and value > 0.0):
                raise refusal(InvalidOption, name, "target spectrum", "a positive number", f"{value:g}")
        corner = numbers["sd1_g"] / numbers["sds_g"]
        if numbers["tl"] < corner:
            raise refusal(
                InvalidOption, "tl", "target spectrum", f"at least T_S = S_D1/S_DS = {corner:g} s", f"{numbers['tl']:g}"
            )
        defaults = {"sds_g": DEFAULT_SDS_G, "sd1_g": DEFAULT_SD1_G, "tl": DEFAULT_TL}
        label = f"ASCE 7 shape, S_DS = {sds_g:g} g, S_D1 = {sd1_g:g} g, T_L = {tl:g} s"
        if numbers == defaults:
            label += " (stand-in for the Port of Long Beach, not its published spectrum)"
        return cls(label, {"shape": "asce7", **numbers}, 0.0, np.inf)

    @classmethod
    def from_csv(cls, path: str | os.PathLike[str]) -> TargetSpectrum:
        """Return the spectrum of a CSV: period (s) and Sa (g), interpolated log-log, refused outside its range.

        A first row that is not numbers names the columns: one `period` or `T`, one `Sa`, each with any unit behind it;
        further columns are ignored. Without it the first two columns count. Blank lines and those with # are skipped.

        Raises
        ------
        RecordFormatError
            The file cannot be read, has fewer than two points, a value that is not a positive number, or periods that
            do not increase.
        """
        source = as_path(path, "target spectrum", RecordFormatError)
        try:
            text = source.read_text(encoding="utf-8-sig")
        except (OSError, UnicodeDecodeError) as error:
            reason = getattr(error, "strerror", None) or "not text"
            requirement = "a file of text that can be read"
            raise refusal(RecordFormatError, "path", "target spectrum", requirement, f"{source} ({reason})") from None
        periods, ordinates = _parse_csv(text, source.name)
        parameters = {
            "shape": "csv",
            "file": printable(source.name),
            "period": periods.tolist(),
            "sa_g": ordinates.tolist(),
        }
        return cls(printable(source.stem), parameters, float(periods[0]), float(periods[-1]))

    def tilted(self, power: float) -> TargetSpectrum:
        """Return the spectrum times (T/1 s)^power: another shape with the same ordinate at 1 s.

        Parameters
        ----------
        power : float
            Positive: more at periods above 1 s, less below.

        Raises
        ------
        InvalidOption
            The power is not a finite number.

        Examples
        --------
        >>> import seismass as sm
        >>> target = sm.TargetSpectrum.asce7(sds_g=1.0, sd1_g=0.6).tilted(-1.0)
        >>> (target([0.5, 1.0, 2.0]) / 9.80665).round(6).tolist()
        [2.0, 0.6, 0.15]
        """
        added = as_number(power, "power", "target spectrum", InvalidOption)
        if not np.isfinite(added):
            raise refusal(InvalidOption, "power", "target spectrum", "a finite number", f"{added:g}")
        total = self.parameters.get("tilt", 0.0) + added
        return TargetSpectrum(
            f"{self.label}, times (T/1 s)^{added:g}", {**self.parameters, "tilt": total}, self.shortest, self.longest
        )

    def __call__(self, periods: ArrayLike) -> FloatArray:
        """Return Sa (m/s2) at periods (s), of the same shape.

        Raises
        ------
        InvalidOption
            A period is outside the range of the spectrum or not a number.
        """
        at = as_array(periods, "period", "target spectrum", InvalidOption, or_number=True)
        inside = (self.shortest <= at) & (at <= self.longest) & np.isfinite(at)
        if not inside.all():
            upper = "up" if np.isinf(self.longest) else f"to {self.longest:g} s"
            wrong = np.atleast_1d(at)[~np.atleast_1d(inside)][0]
            requirement = f"from {self.shortest:g} s {upper}, the range of {self.label}"
            raise refusal(InvalidOption, "period", "target spectrum", requirement, f"{wrong:g}")
        tilt = self.parameters.get("tilt", 0.0)
        ordinates = self._untilted(at)
        return ordinates if tilt == 0.0 else ordinates * at**tilt

    def _untilted(self, at: FloatArray) -> FloatArray:
        if self.parameters["shape"] == "csv":
            log_periods, log_ordinates = np.log(self.parameters["period"]), np.log(self.parameters["sa_g"])
            return cast(FloatArray, STANDARD_GRAVITY * np.exp(np.interp(np.log(at), log_periods, log_ordinates)))
        short, one, tl = (self.parameters[name] for name in ("sds_g", "sd1_g", "tl"))
        corner = one / short
        t = np.maximum(at, 0.2 * corner)
        falling = np.where(t <= tl, one / t, one * tl / t**2)
        ordinates = np.where(t <= corner, short * np.minimum(0.4 + 0.6 * at / (0.2 * corner), 1.0), falling)
        return cast(FloatArray, STANDARD_GRAVITY * ordinates)


def _parse_csv(text: str, file: str) -> tuple[FloatArray, FloatArray]:
    try:
        rows = [
            [cell.strip() for cell in row]
            for row in csv.reader(io.StringIO(text))
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
            if not (_is_number(cell) and 0.0 < float(cell) < np.inf):
                raise refusal(RecordFormatError, name, f"{file}, point {number},", "a positive number", repr(cell))
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


def _named_columns(header: list[str], file: str) -> tuple[int, int]:
    words = [cell.lower().replace("(", " ").replace("_", " ").split() for cell in header]
    found = []
    for names in (("period", "t"), ("sa",)):
        columns = [index for index, cell in enumerate(words) if cell and cell[0] in names]
        if len(columns) != 1:
            requirement = "one period or T and one Sa"
            raise refusal(RecordFormatError, "columns", file, requirement, ", ".join(header))
        found.append(columns[0])
    unit = [word.strip("()[]") for word in words[found[1]][1:]]
    if unit and unit != ["g"]:
        raise refusal(RecordFormatError, "unit of Sa", file, "g", " ".join(unit))
    return found[0], found[1]


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
