"""The target spectrum that motions are scaled to: one interface over the kinds that the neighbouring modules define."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final, Protocol

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_array, as_number, as_positive, brief, frozen, refusal
from seismass.base.views import view
from seismass.motions.elementary import geomspace, power
from seismass.motions.spectra.codes import (
    DEFAULT_SD1_G,
    DEFAULT_SDS_G,
    DEFAULT_TL,
    eurocode8_shape,
    multi_period_shape,
    nzs1170_shape,
    two_period_shape,
)
from seismass.motions.spectra.elastic import GroundMotion
from seismass.motions.spectra.tables import CsvTable, csv_shape, mean_shape


class Shape(Protocol):
    """What a kind of target spectrum has: it can be called, named, described in JSON, and pickled."""

    @property
    def label(self) -> str:
        """What it is, as figures and tables name it."""
        ...

    @property
    def parameters(self) -> dict[str, Any]:
        """What it was made from, with its kind as `shape`; a digest of it distinguishes two spectra."""
        ...

    @property
    def shortest(self) -> float:
        """Shortest period (s)."""
        ...

    @property
    def longest(self) -> float:
        """Longest period (s), or infinity."""
        ...

    def __call__(self, periods: FloatArray) -> FloatArray:
        """Return Sa (m/s2) at periods within the range."""
        ...


@dataclass(frozen=True, eq=False)
class TargetSpectrum:
    """Pseudo-acceleration against period that motions are scaled to; call it with periods.

    Make one with `asce7`, `asce7_multi_period`, `eurocode8`, `nzs1170`, `from_csv` or `mean_of`. Two are equal where
    their parameters are.

    Parameters
    ----------
    shape : Shape
        The kind of spectrum with its numbers.
    tilt : float, default 0.0
        Power p of (T/1 s)^p by which it is multiplied; see `tilted`.
    factor : float
        Number by which it is multiplied; see `times`.

    Attributes
    ----------
    label : str
        What it is, as figures and tables name it.
    parameters : dict
        What it was made from, for JSON: its kind as `shape`, and numbers or the file and its points.
    shortest, longest : float
        Range of periods (s); others are refused.
    """

    shape: Shape
    tilt: float = 0.0
    factor: float = 1.0

    @property
    def label(self) -> str:
        """What it is, as figures and tables name it."""
        label = self.shape.label if self.tilt == 0.0 else f"{self.shape.label}, times (T/1 s)^{self.tilt:g}"
        return label if self.factor == 1.0 else f"{self.factor:g} times {label}"

    @property
    def parameters(self) -> dict[str, Any]:
        """What it was made from."""
        changes = {"tilt": self.tilt} if self.tilt else {}
        return {**self.shape.parameters, **changes, **({"factor": self.factor} if self.factor != 1.0 else {})}

    @property
    def shortest(self) -> float:
        """Shortest period (s)."""
        return self.shape.shortest

    @property
    def longest(self) -> float:
        """Longest period (s), or infinity."""
        return self.shape.longest

    @classmethod
    def asce7(
        cls, sds_g: float = DEFAULT_SDS_G, sd1_g: float = DEFAULT_SD1_G, tl: float = DEFAULT_TL
    ) -> TargetSpectrum:
        """Return the two-period shape of ASCE/SEI 7-10, 11.4.5, which 7-16 keeps in 11.4.6.

        S_DS (0.4 + 0.6 T/T0) below T0 = 0.2 S_D1/S_DS, S_DS up to T_S = S_D1/S_DS, S_D1/T up to T_L, S_D1 T_L/T^2
        beyond.

        Parameters
        ----------
        sds_g, sd1_g : float, optional
            Design spectral accelerations at short periods and at 1 s (g); for MCE_R those times 1.5.
        tl : float, optional
            Long-period transition (s).

        Examples
        --------
        >>> import seismass as sm
        >>> target = sm.TargetSpectrum.asce7(sds_g=1.0, sd1_g=0.6)
        >>> (target([0.0, 0.3, 1.0, 16.0]) / sm.STANDARD_GRAVITY).round(6).tolist()
        [0.4, 1.0, 0.6, 0.01875]
        """
        return cls(two_period_shape(sds_g, sd1_g, tl))

    @classmethod
    def asce7_multi_period(cls, periods: ArrayLike, sa_g: ArrayLike) -> TargetSpectrum:
        """Return the multi-period spectrum of ASCE/SEI 7-22, 11.4.5.1, from the user's table of it.

        The table is that of the site from the USGS database, design or MCE_R as it is given. Between its periods Sa is
        linear in T, as the standard has it; the first may be 0. Beyond the last one, 10 s in the standard, periods are
        refused: what the standard prescribes there needs T_L.

        Parameters
        ----------
        periods : array_like
            Periods (s), increasing; those of the standard are `seismass.spectra.MULTI_PERIODS`.
        sa_g : array_like
            Sa (g) at them.

        Examples
        --------
        >>> import seismass as sm
        >>> target = sm.TargetSpectrum.asce7_multi_period([0.0, 0.1, 1.0, 10.0], [0.5, 1.0, 0.6, 0.03])
        >>> (target([0.05, 0.55]) / sm.STANDARD_GRAVITY).round(6).tolist()
        [0.75, 0.8]
        """
        return cls(multi_period_shape(periods, sa_g))

    @classmethod
    def eurocode8(
        cls, kind: int = 1, ground: str = "A", *, agr_g: float, importance: float = 1.0, damping: float = 0.05
    ) -> TargetSpectrum:
        """Return the horizontal elastic spectrum of EN 1998-1:2004, 3.2.2.2.

        Parameters
        ----------
        kind : {1, 2}, default 1
            Type of the spectrum: 1 for earthquakes of surface-wave magnitude above 5.5 (table 3.2), 2 up to it (3.3).
        ground : {"A", "B", "C", "D", "E"}, default "A"
            Ground type. The recommended S, T_B, T_C and T_D are used; a National Annex may have others.
        agr_g : float
            Reference peak ground acceleration a_gR on ground type A (g).
        importance : float, default 1.0
            Importance factor gamma_I: a_g = gamma_I a_gR.
        damping : float, default 0.05
            Ratio of critical damping xi: eta = sqrt(10/(5 + 100 xi)), at least 0.55.

        Notes
        -----
        Periods are from 0 to 4 s, as far as the equations (3.2) to (3.5) go. Design spectra with a behaviour factor are
        no targets for motions.

        Examples
        --------
        >>> import seismass as sm
        >>> target = sm.TargetSpectrum.eurocode8(1, "C", agr_g=0.3)
        >>> (target([0.0, 0.4, 1.2]) / sm.STANDARD_GRAVITY).round(6).tolist()
        [0.345, 0.8625, 0.43125]
        """
        return cls(eurocode8_shape(kind, ground, agr_g, importance, damping))

    @classmethod
    def nzs1170(
        cls, site_class: str = "C", *, z: float, r: float = 1.0, fault_distance_km: float | None = None
    ) -> TargetSpectrum:
        """Return the elastic site spectrum of NZS 1170.5:2004, C(T) = C_h(T) Z R N(T, D).

        Parameters
        ----------
        site_class : {"A", "B", "C", "D", "E"}, default "C"
            Site subsoil class.
        z : float
            Hazard factor Z.
        r : float, default 1.0
            Return period factor R of the limit state; 1 for 500 years. Z R counts as 0.7 at most.
        fault_distance_km : float, optional
            Shortest distance D to a major fault (km); N = 1 without it, beyond 20 km, and for R up to 0.75.

        Notes
        -----
        C_h is that of the modal response spectrum and the time history methods. Its equations (of the commentary),
        N_max and the limit of Z R are second-hand, from public programs; the standard was not at hand. The label says
        so.

        Examples
        --------
        >>> import seismass as sm
        >>> target = sm.TargetSpectrum.nzs1170("C", z=0.4)
        >>> (target([0.2, 2.0]) / sm.STANDARD_GRAVITY).round(6).tolist()
        [1.172, 0.264]
        """
        return cls(nzs1170_shape(site_class, z, r, fault_distance_km))

    @classmethod
    def from_csv(
        cls, path: str | os.PathLike[str], *, unit: str | None = None, column: str | None = None
    ) -> TargetSpectrum:
        """Return the spectrum of a file: periods (s) and Sa, interpolated log-log, refused outside its range.

        Parameters
        ----------
        path : path-like
            A table whose heads name a column of periods (`period`, `T`) and one of ordinates (`Sa`, `PSA`, `Se`, any
            acceleration), with commas, semicolons, tabs or blanks and decimal points or commas; a table of OpenQuake's
            uniform hazard spectra, PEER's _SearchResults.csv, an answer of the USGS design services in JSON, or what
            `seismass spectrum` and `seismass target` print. Spectral displacements and pseudo-velocities become
            omega^2 SD and omega PSV. The first period may be 0, from which Sa is linear in the period.
        unit : str, optional
            Unit of the ordinates, such as "g" or "m/s2", which the file must state otherwise.
        column : str, optional
            Which of several spectra of the file, by its head, its probability or its record, or a part of that.

        Raises
        ------
        RecordFormatError
            The file cannot be read, has fewer than two points, a value that is not a positive number, periods that do
            not increase, no unit, or several spectra of which `column` names none.
        """
        return cls(csv_shape(path, unit, column))

    @classmethod
    def mean_of(
        cls,
        records: GroundMotion | Iterable[GroundMotion],
        factors: ArrayLike | None = None,
        *,
        damping: float = 0.05,
        label: str = "",
    ) -> TargetSpectrum:
        """Return the mean spectrum of a suite, solved for at every period asked for, not interpolated.

        Parameters
        ----------
        records : Record, Motion or iterable of them
            The suite.
        factors : array_like, optional
            Factor of each motion; 1 by default.
        damping : float, default 0.05
            Ratio of critical damping.
        label : str, optional
            What it is called; by default the mean of the motions by number.

        Notes
        -----
        Periods are from a thousandth of the largest time step.

        Examples
        --------
        >>> import seismass as sm
        >>> step = sm.Motion([1.0] * 200, dt=0.01)
        >>> sm.TargetSpectrum.mean_of([step, step], [1.0, 3.0], damping=0.0)(0.5).round(6).tolist()
        4.0
        """
        return cls(mean_shape(records, factors, damping, label))

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
        >>> (target([0.5, 1.0, 2.0]) / sm.STANDARD_GRAVITY).round(6).tolist()
        [2.0, 0.6, 0.15]
        """
        added = as_number(power, "power", "target spectrum", InvalidOption)
        if not np.isfinite(added):
            raise refusal(InvalidOption, "power", "target spectrum", "a finite number", f"{added:g}")
        return TargetSpectrum(self.shape, self.tilt + added, self.factor)

    def times(self, factor: float) -> TargetSpectrum:
        """Return the spectrum times a number, such as 1.5 from the design spectrum of ASCE 7 to MCE_R.

        Parameters
        ----------
        factor : float
            The number, positive.

        Raises
        ------
        InvalidOption
            The factor is not positive.

        Examples
        --------
        >>> import seismass as sm
        >>> target = sm.TargetSpectrum.asce7(sds_g=1.0, sd1_g=0.6).times(1.5)
        >>> (target(1.0) / sm.STANDARD_GRAVITY).round(6).tolist()
        0.9
        """
        more = as_positive(factor, "factor", "target spectrum", InvalidOption)
        return TargetSpectrum(self.shape, self.tilt, self.factor * more)

    def corner_period(self) -> float:
        """Return the period (s) between the ranges sensitive to acceleration and to velocity.

        It is 2 pi times the largest pseudo-velocity over the largest pseudo-acceleration, at 400 periods from 0.02 to
        10 s as far as the spectrum goes; for the two-period shape of ASCE 7 it is T_S.
        """
        shortest, longest = max(self.shortest, 0.02), min(self.longest, 10.0)
        periods = geomspace(shortest, longest, 400) if shortest < longest else np.array([self.shortest])
        ordinates = self(np.clip(periods, self.shortest, self.longest))
        return float(np.max(ordinates * periods) / np.max(ordinates))

    def table(self, periods: ArrayLike | None = None) -> pl.DataFrame:
        """Return the spectrum as a table, which `from_csv` reads again from a file.

        Parameters
        ----------
        periods : array_like, optional
            Periods (s), positive; by default 200 from 0.01 to 10 s as far as the spectrum goes, geometric, with the
            corners of the shape among them. `from_csv` interpolates log-log between them.

        Returns
        -------
        polars.DataFrame
            period (s), Sa (g).

        Raises
        ------
        InvalidOption
            A period is outside the range of the spectrum.

        Examples
        --------
        >>> import seismass as sm
        >>> sm.TargetSpectrum.eurocode8(1, "C", agr_g=0.3).table([0.4, 1.2])["Sa (g)"].round(6).to_list()
        [0.8625, 0.43125]
        """
        if periods is None:
            values = geomspace(max(self.shortest, 0.01), min(self.longest, 10.0), 200)
            names = ("tb", "tc", "td", "tl", "sds_g", "sd1_g")
            known = {name: float(self.parameters[name]) for name in names if name in self.parameters}
            if "sds_g" in known:
                corner = known.pop("sd1_g") / known.pop("sds_g")
                known |= {"t0": 0.2 * corner, "ts": corner}
            points = [*values, *known.values(), *self.parameters.get("period", ())]
            values = np.unique([point for point in points if values[0] <= point <= values[-1]])
        else:
            values = as_array(periods, "periods", "target spectrum", InvalidOption)
            if not (values > 0.0).all():
                raise refusal(InvalidOption, "periods", "target spectrum", "positive", f"{values.min():g}")
        return pl.DataFrame({"period (s)": values, "Sa (g)": self(values) / STANDARD_GRAVITY})

    @view
    def _repr_html_(self) -> str:
        raise NotImplementedError

    def __eq__(self, other: object) -> bool:
        """Return whether the other spectrum was made from the same."""
        if not isinstance(other, TargetSpectrum):
            return NotImplemented
        return self is other or self.parameters == other.parameters

    def __hash__(self) -> int:
        return hash(json.dumps(self.parameters, sort_keys=True))

    def __call__(self, periods: ArrayLike) -> FloatArray:
        """Return Sa (m/s2) at periods (s), of the same shape.

        Raises
        ------
        InvalidOption
            A period is outside the range of the spectrum or not a number, or 0 where a negative power tilts it.
        """
        values = as_array(periods, "period", "target spectrum", InvalidOption, or_number=True)
        inside = (self.shortest <= values) & (values <= self.longest) & np.isfinite(values)
        if not inside.all():
            upper = "up" if np.isinf(self.longest) else f"to {self.longest:g} s"
            wrong = np.atleast_1d(values)[~np.atleast_1d(inside)][0]
            requirement = f"from {self.shortest:g} s {upper}, the range of {self.label}"
            raise refusal(InvalidOption, "period", "target spectrum", requirement, f"{wrong:g}")
        if self.tilt < 0.0 and (values == 0.0).any():
            requirement = "positive where the spectrum is tilted by a negative power"
            raise refusal(InvalidOption, "period", "target spectrum", requirement, "0")
        ordinates = self.shape(values)
        tilted = ordinates if self.tilt == 0.0 else ordinates * power(values, self.tilt)
        return tilted if self.factor == 1.0 else self.factor * tilted


def target_of_parameters(parameters: dict[str, Any]) -> TargetSpectrum:
    """Return the target spectrum whose `TargetSpectrum.parameters` these are; refused is the mean of motions, whose
    samples they do not hold.
    """
    data = dict(parameters)
    tilt, factor = data.pop("tilt", 0.0), data.pop("factor", 1.0)
    match data.get("shape"):
        case "asce7":
            target = TargetSpectrum.asce7(data["sds_g"], data["sd1_g"], data["tl"])
        case "asce7_multi_period":
            target = TargetSpectrum.asce7_multi_period(data["period"], data["sa_g"])
        case "eurocode8":
            target = TargetSpectrum.eurocode8(
                data["type"],
                data["ground"],
                agr_g=data["agr_g"],
                importance=data["importance"],
                damping=data["damping"],
            )
        case "nzs1170":
            distance = data["fault_distance_km"]
            target = TargetSpectrum.nzs1170(data["site_class"], z=data["z"], r=data["r"], fault_distance_km=distance)
        case "csv":
            label = data["file"].rpartition(".")[0] or data["file"]
            target = TargetSpectrum(CsvTable(frozen(data["period"]), frozen(data["sa_g"]), label, data["file"]))
        case "suite_mean":
            requirement = "made of numbers (TargetSpectrum.from_csv reads a table of a mean spectrum)"
            raise refusal(InvalidOption, "target", "stored spectrum", requirement, "the mean of motions")
        case other:
            raise refusal(InvalidOption, "target", "stored spectrum", "of a kind that is known", brief(other))
    return TargetSpectrum(target.shape, tilt, factor)


MAX_ORDINATE: Final = 4.0
"""Ordinate of a target spectrum (g); no site has an S_DS above it, and 1 g stated in m/s2 is 9.81."""


PARAMETERS: Final[dict[str, dict[str, tuple[float, float, str, str]]]] = {
    "nzs1170": {
        "z": (0.1, 0.6, "", "the hazard factor Z is a fraction, 0.13 to 0.6 in the table of the standard"),
        "r": (0.2, 1.8, "", "the return period factor R is 0.2 to 1.8 in the table of the standard"),
    },
    "eurocode8": {
        "agr_g": (0.01, 0.6, " g", "a_gR is a fraction of g, and in Europe no larger than about 0.4"),
        "importance": (0.5, 2.0, "", "the importance factor is 0.8 to 1.4 as EN 1998-1 recommends"),
    },
}
"""Ranges of the parameters of codes by their shapes: least, most, unit, and what is doubted outside.

NZS 1170.5:2004, tables 3.3 and 3.5; EN 1998-1:2004, 4.2.5(5)P and the zone maps of national annexes. As the other
numbers of these shapes they are second-hand.
"""


def target_remarks(target: TargetSpectrum) -> tuple[str, ...]:
    """Return what is unlikely about a target spectrum: an ordinate that is too large, S_DS and S_D1 exchanged, and
    parameters of a code outside their ranges.
    """
    parameters = target.parameters
    if "sds_g" in parameters:
        ordinates = {"S_DS": parameters["sds_g"]}
    elif "sa_g" in parameters:
        ordinates = {"largest Sa": max(parameters["sa_g"])}
    else:
        periods = np.geomspace(max(target.shortest, 0.01), min(target.longest, 10.0), 100)
        ordinates = {"largest Sa": float(np.max(target(periods))) / STANDARD_GRAVITY}
    ranges = PARAMETERS.get(str(parameters.get("shape")), {})
    outside = tuple(
        f"{name} of the target spectrum is {parameters[name]:g}, outside {least:g} to {most:g}{unit}: {doubt}"
        for name, (least, most, unit, doubt) in ranges.items()
        if not least <= parameters[name] <= most
    )
    remarks = [
        f"{name} of the target spectrum is {value:.4g} g, above {MAX_ORDINATE:g} g: "
        "spectral accelerations are in g, not m/s2 or per cent"
        for name, value in ordinates.items()
        if value > MAX_ORDINATE
    ]
    if "sd1_g" in parameters and parameters["sd1_g"] > parameters["sds_g"]:
        remarks.append(
            f"S_D1 of the target spectrum is {parameters['sd1_g']:.4g} g, above S_DS = {parameters['sds_g']:.4g} g: "
            "are they exchanged?"
        )
    return (*remarks, *outside)
