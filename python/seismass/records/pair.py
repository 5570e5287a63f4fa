"""Two horizontal components recorded together, and the vertical one where there is one: aligned, and turned in plan."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields
from itertools import takewhile
from typing import Any, Final, Literal

import numpy as np

from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.values import FloatArray, Value, as_number, brief, is_one_of, printable, refusal
from seismass.records.formats.directions import azimuth_of, is_vertical
from seismass.records.read import read_record
from seismass.records.record import Record
from seismass.records.rotation import at_angles, between

PERPENDICULAR: Final = 5.0
"""How far (degrees) two stated directions may be from a right angle; motion in the plane is solved for."""
RIGHT: Final = 1e-9
"""Deviation from a right angle (degrees) that is rounding of azimuths."""


@dataclass(frozen=True, eq=False, repr=False)
class Pair(Value):
    """Two horizontal components of one recording at the same instants, and its vertical component.

    Make one with `from_records`, `read_pair` or `find_pairs`. Components of other directions are linear combinations of
    the two, and as exact as they are. Iterating gives the two horizontals and then the vertical, if there is one.

    Parameters
    ----------
    first, second : Record
        Horizontal components: of one step and length, without vertical accelerations of their own.
    vertical : Record, optional
        Vertical component, up positive, of the same step and length.
    remarks : tuple of str
        What was done to bring them together.

    Raises
    ------
    InvalidMotion
        Steps or lengths that differ, stated directions that are not at right angles (within 5 degrees), a vertical
        component in place of a horizontal one or the reverse, or something other than records.
    """

    first: Record
    second: Record
    vertical: Record | None = None
    remarks: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        for name, record in self._named().items():
            if not isinstance(record, Record):
                raise refusal(InvalidMotion, f"{name} component", "pair", "a Record", brief(record))
        what = f"pair {self.name}".rstrip()
        for name, record in self._named().items():
            if not math.isclose(record.dt, self.first.dt, rel_tol=1e-9):
                got = f"{record.dt:g} s"
                raise refusal(
                    InvalidMotion, f"dt of {name} component", what, f"that of the first, {self.first.dt:g} s", got
                )
            if record.samples != self.first.samples:
                requirement = f"{self.first.samples}, as many as of the first (from_records aligns them)"
                raise refusal(InvalidMotion, f"samples of {name} component", what, requirement, str(record.samples))
        for name, record in (("first", self.first), ("second", self.second)):
            if is_vertical(record.component):
                raise refusal(InvalidMotion, f"{name} component", what, "a horizontal one", record.component)
        if self.vertical is not None and azimuth_of(self.vertical.component) is not None:
            raise refusal(InvalidMotion, "vertical component", what, "a vertical one", self.vertical.component)
        one, other = self.first.azimuth, self.second.azimuth
        if one is not None and other is not None and abs(abs(between(one, other)) - 90.0) > PERPENDICULAR:
            got = f"{one:g} and {other:g} degrees"
            raise refusal(InvalidMotion, "azimuths", what, f"at right angles within {PERPENDICULAR:g} degrees", got)
        remarks: Any = self.remarks
        if not isinstance(remarks, tuple | list) or not all(isinstance(one, str) for one in remarks):
            raise refusal(InvalidMotion, "remarks", what, "a tuple of strings", brief(remarks))
        object.__setattr__(self, "remarks", tuple(printable(one) for one in remarks))

    @classmethod
    def from_records(
        cls,
        first: Record,
        second: Record,
        vertical: Record | None = None,
        *,
        lengths: Literal["shorter", "padded"] = "shorter",
    ) -> Pair:
        """Return the pair of two horizontal records, aligned at their first samples.

        Parameters
        ----------
        first, second, vertical : Record
            Components that begin at the same instant, as those of one file set do. A horizontal without azimuth has the
            one that its component label states, if it states one.
        lengths : {"shorter", "padded"}
            Where the horizontals differ in length: cut the longer, or pad the shorter with zeros. The vertical is cut
            or padded to them. Both are stated in the remarks and in the history of the component.

        Raises
        ------
        InvalidMotion
            As the class says, or one file twice.
        InvalidOption
            Another value of `lengths`.
        """
        if not is_one_of(lengths, ("shorter", "padded")):
            raise refusal(InvalidOption, "lengths", "pair", "shorter or padded", brief(lengths))
        for name, record in (("first", first), ("second", second)):
            if not isinstance(record, Record):
                raise refusal(InvalidMotion, f"{name} component", "pair", "a Record", brief(record))
        if first.source and first.source == second.source and np.array_equal(first.acceleration, second.acceleration):
            got = f"{first.source.name} twice"
            raise refusal(InvalidMotion, "second component", "pair", "another than the first", got)
        samples = (min if lengths == "shorter" else max)(first.samples, second.samples)
        remarks: list[str] = []
        ready = [_aligned(_alone(_directed(one), remarks), samples, remarks) for one in (first, second)]
        if isinstance(vertical, Record):
            vertical = _aligned(_alone(vertical, remarks), samples, remarks)
        pair = cls(ready[0], ready[1], vertical, tuple(remarks))
        for label in ("event", "station"):
            named = [getattr(record, label) for record in ready]
            if all(named) and named[0] != named[1]:
                remarks.append(f"{label} of the two horizontals differs: {named[0]} and {named[1]}")
        if pair.azimuths is None:
            remarks.append("directions of the two horizontals are not both stated: taken as perpendicular")
        elif abs(pair.apart) != 90.0:
            remarks.append(f"directions {abs(pair.apart):g} degrees apart: motion in the plane is solved for")
        return pair.replace(remarks=tuple(remarks))

    def _arguments(self) -> dict[str, Any]:
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def _named(self) -> dict[str, Record]:
        horizontals = {"first": self.first, "second": self.second}
        return horizontals if self.vertical is None else horizontals | {"vertical": self.vertical}

    def __repr__(self) -> str:
        peaks = " and ".join(f"{record.pga_g:.4f}" for record in (self.first, self.second))
        vertical = "" if self.vertical is None else f", vertical {self.vertical.pga_g:.4f} g"
        return f"<Pair {self.name or '(unnamed)'}: {self.samples} x {self.dt:g} s, PGA {peaks} g{vertical}>"

    def _repr_html_(self) -> str:
        return "".join(record._repr_html_() for record in self)

    def __len__(self) -> int:
        return len(self._named())

    def __iter__(self) -> Iterator[Record]:
        return iter(self._named().values())

    @property
    def name(self) -> str:
        """What the names of the two share before their directions, or both names."""
        one, other = self.first.name, self.second.name
        alike = takewhile(lambda letters: letters[0] == letters[1], zip(one, other, strict=False))
        common = "".join(letter for letter, _ in alike)
        if one != other and self.azimuths is not None:
            # Directions may begin alike (000 and 090): their digits are not part of the name.
            degrees = [f"{azimuth % 360.0:03.0f}" for azimuth in self.azimuths]
            for length in (len(common) - 1, len(common) - 2):
                if length >= 0 and [name[length : length + 3] for name in (one, other)] == degrees:
                    common = common[:length]
                    break
        common = common.rstrip("-_. ").removesuffix(" channel")
        return common if len(common) >= 3 else " + ".join(name for name in (one, other) if name)

    @property
    def event(self) -> str:
        """What the source calls the event."""
        return self.first.event or self.second.event

    @property
    def station(self) -> str:
        """What the source calls the station."""
        return self.first.station or self.second.station

    @property
    def dt(self) -> float:
        """Time step (s)."""
        return self.first.dt

    @property
    def samples(self) -> int:
        """Number of samples of each component."""
        return self.first.samples

    @property
    def azimuths(self) -> tuple[float, float] | None:
        """Directions of the two horizontals (degrees clockwise from north); None where they are not both stated."""
        if self.first.azimuth is None or self.second.azimuth is None:
            return None
        return self.first.azimuth, self.second.azimuth

    @property
    def apart(self) -> float:
        """Angle (degrees) from the first direction to the second, clockwise positive; 90 where they are not stated."""
        if self.azimuths is None:
            return 90.0
        apart = between(*self.azimuths)
        right = math.copysign(90.0, apart)
        return right if abs(apart - right) < RIGHT else apart

    def at_angles(self, degrees: FloatArray) -> FloatArray:
        """Return accelerations (m/s2), angles x samples, at angles (degrees) from the first towards the second."""
        return at_angles(self.first.acceleration, self.second.acceleration, degrees, abs(self.apart))

    def component(self, angle: float) -> Record:
        """Return the horizontal component at an angle (degrees) from the first towards the second.

        Raises
        ------
        InvalidOption
            The angle is not a finite number.
        """
        turn = _angle("angle", angle)
        azimuth = None
        if self.azimuths is not None:
            azimuth = (self.azimuths[0] + math.copysign(1.0, self.apart) * turn) % 360.0
        return self._turned(turn, azimuth, f"component at {turn:g} degrees from {self._labels()}")

    def rotated(self, angle: float) -> Pair:
        """Return the pair turned by an angle (degrees) from the first towards the second.

        Its first component is the one at `angle`, its second the one at `angle` + 90; `rotated(-angle)` turns it back.
        """
        turn = _angle("angle", angle)
        return self.replace(first=self.component(turn), second=self.component(turn + 90.0))

    def toward(self, azimuth: float) -> Record:
        """Return the horizontal component that is positive towards an azimuth (degrees clockwise from north).

        Raises
        ------
        InvalidOption
            The directions of the pair are not stated, or the azimuth is not a finite number.
        """
        wanted = _angle("azimuth", azimuth) % 360.0
        if self.azimuths is None:
            requirement = "stated, as record.replace(azimuth=...) does, or an angle from the first be taken"
            raise refusal(InvalidOption, "azimuths", f"pair {self.name}".rstrip(), requirement, "none")
        turn = math.copysign(1.0, self.apart) * between(self.azimuths[0], wanted)
        return self._turned(turn, wanted, f"component towards azimuth {wanted:g} of {self._labels()}")

    def fault_normal_parallel(self, strike: float) -> Pair:
        """Return the pair of fault-normal (first) and fault-parallel (second) components.

        Parameters
        ----------
        strike : float
            Strike of the fault (degrees clockwise from north). Fault-parallel is positive towards the strike,
            fault-normal towards strike + 90, which is where the fault dips by the convention of Aki and Richards. The
            other of the two strikes of a vertical fault, 180 degrees from it, changes both signs and nothing else.

        Raises
        ------
        InvalidOption
            As for `toward`.
        """
        along = _angle("strike", strike)
        normal = self.toward(along + 90.0)
        parallel = self.toward(along)
        return self.replace(
            first=normal.replace(component=f"fault-normal, strike {along % 360.0:g}"),
            second=parallel.replace(component=f"fault-parallel, strike {along % 360.0:g}"),
        )

    def scaled(self, factor: float) -> Pair:
        """Return the pair with every component multiplied by one factor."""
        return self.each(lambda record: record.scaled(factor))

    def each(self, change: Callable[[Record], Record]) -> Pair:
        """Return the pair with every component changed in one way, as `pair.each(lambda r: r.resampled(0.005))`."""
        return self.replace(**{name: change(record) for name, record in self._named().items()})

    def _labels(self) -> str:
        one, other = (record.component or record.name or "?" for record in (self.first, self.second))
        return f"{one} and {other}"

    def _turned(self, turn: float, azimuth: float | None, said: str) -> Record:
        acceleration = self.at_angles(np.array([turn]))[0]
        direction = f"{turn % 360.0:g} from first" if azimuth is None else f"{azimuth:g}"
        return self.first.replace(
            acceleration=acceleration,
            name=f"{self.name} {direction}".strip(),
            component=direction,
            azimuth=azimuth,
            source=None,
            sha256="",
            history=(*self.first.history, said),
        )


def read_pair(
    first: str | os.PathLike[str],
    second: str | os.PathLike[str],
    vertical: str | os.PathLike[str] | None = None,
    *,
    lengths: Literal["shorter", "padded"] = "shorter",
    **options: Any,
) -> Pair:
    """Read the two horizontal components of a recording, and its vertical one, from their files.

    Parameters
    ----------
    first, second, vertical : path-like
        The files; each of any format that `read_record` reads.
    lengths : {"shorter", "padded"}
        See `Pair.from_records`.
    **options
        Passed to `read_record` for each file, such as `dt` and `unit`.

    Raises
    ------
    RecordFormatError
        A file that cannot be read.
    InvalidMotion
        Steps that differ or directions that are not at right angles.
    """
    records = [read_record(path, **options) for path in (first, second)]
    up = None if vertical is None else read_record(vertical, **options)
    return Pair.from_records(records[0], records[1], up, lengths=lengths)


def _angle(parameter: str, value: Any) -> float:
    angle = as_number(value, parameter, "pair", InvalidOption)
    if not math.isfinite(angle):
        raise refusal(InvalidOption, parameter, "pair", "a finite number of degrees", brief(value))
    return angle


def _directed(record: Record) -> Record:
    azimuth = azimuth_of(record.component) if record.azimuth is None else record.azimuth
    return record if azimuth == record.azimuth else record.replace(azimuth=azimuth)


def _alone(record: Record, remarks: list[str]) -> Record:
    if record.vertical is None:
        return record
    remarks.append(f"vertical accelerations that {record.name or 'a component'} had beside its own left out")
    return record.replace(vertical=None)


def _aligned(record: Record, samples: int, remarks: list[str]) -> Record:
    more = samples - record.samples
    if more == 0:
        return record
    what = f"{record.name or 'component'} "
    said = f"cut to the {samples} samples of its pair" if more < 0 else f"padded by {more} zeros to its pair"
    remarks.append(f"{what}{said}, from {record.samples}")
    acceleration = record.acceleration[:samples] if more < 0 else np.pad(record.acceleration, (0, more))
    return record.replace(acceleration=acceleration, history=(*record.history, said))
