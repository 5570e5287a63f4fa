"""Two horizontal components recorded together, and the vertical one where there is one: aligned, and turned in plan."""

from __future__ import annotations

import math
import os
import re
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields
from itertools import takewhile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

import numpy as np

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidMotion, InvalidOption, RecordFormatError
from seismass.base.values import FloatArray, Value, as_array, as_number, as_path, brief, printable, refusal
from seismass.base.views import Card
from seismass.motions.records.formats.labels import azimuth_of, is_vertical
from seismass.motions.records.known import with_tables
from seismass.motions.records.read import files_below, is_archive, off_ground, read_record, unpacked, vertical_reason
from seismass.motions.records.record import Record
from seismass.motions.records.suite import Excluded, excluded_record, read_file, recorded_once

if TYPE_CHECKING:
    import polars as pl


def between(first: float, second: float) -> float:
    """Return the angle (degrees) from one azimuth to another, from -180 to below 180, clockwise positive."""
    return (second - first + 180.0) % 360.0 - 180.0


def at_angles(first: FloatArray, second: FloatArray, degrees: FloatArray, apart: float = 90.0) -> FloatArray:
    """Return components of a plane motion at angles (degrees) from its first towards its second component, shape
    (angles, samples). `apart` (degrees) is between these; at 90: first cos(angle) + second sin(angle).
    """
    from scipy.special import cosdg, sindg  # exact at quarter turns; slow to import

    degrees = as_array(degrees, "degrees", "pair", InvalidOption, or_number=True)
    across = second if apart == 90.0 else (second - cosdg(apart) * first) / sindg(apart)
    rotated: FloatArray = np.multiply.outer(cosdg(degrees), first)
    rotated += np.multiply.outer(sindg(degrees), across)
    return rotated


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
    remarks : tuple of str, optional
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
        first, second, vertical : Record, optional
            Components that begin at the same instant, as those of one file set do. A horizontal without azimuth has the
            one that its component label states, if it states one.
        lengths : {"shorter", "padded"}, default "shorter"
            Where the horizontals differ in length: cut the longer, or pad the shorter with zeros. The vertical is cut
            or padded to them. Both are stated in the remarks and in the history of the component.

        Raises
        ------
        InvalidMotion
            As the class says, or one file twice.
        InvalidOption
            Another value of `lengths`.
        """
        as_word(lengths, ("shorter", "padded"), "lengths", "pair")
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
        if not callable(change):
            raise refusal(InvalidOption, "change", "pair", "a callable of a Record", brief(change))
        return self.replace(**{name: change(record) for name, record in self._named().items()})

    def _labels(self) -> str:
        one, other = (record.component or record.name or "?" for record in (self.first, self.second))
        return f"{one} and {other}"

    def _turned(self, turn: float, azimuth: float | None, note: str) -> Record:
        acceleration = self.at_angles(np.array([turn]))[0]
        direction = f"{turn % 360.0:g} from first" if azimuth is None else f"{azimuth:g}"
        return self.first.replace(
            acceleration=acceleration,
            name=f"{self.name} {direction}".strip(),
            component=direction,
            azimuth=azimuth,
            source=None,
            sha256="",
            history=(*self.first.history, note),
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
    first, second, vertical : path-like, optional
        The files; each of any format that `read_record` reads.
    lengths : {"shorter", "padded"}, default "shorter"
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
    note = f"cut to the {samples} samples of its pair" if more < 0 else f"padded by {more} zeros to its pair"
    remarks.append(f"{what}{note}, from {record.samples}")
    acceleration = record.acceleration[:samples] if more < 0 else np.pad(record.acceleration, (0, more))
    return record.replace(acceleration=acceleration, history=(*record.history, note))


_SEQUENCE: Final = re.compile(r"^RSN(\d+)(?!\d)", re.IGNORECASE)
_DIRECTION: Final = re.compile(
    r"(?:[-_. ]*(?:(?:NS|EW|UD)(?P<level>[12]?)|UP|VERT?|LN|TR|LONG|TRAN|H[12]|[BH][NLH][NEZ123])|[-_. ]+[NSEWLTVZ]"
    r"|[-_. ]?(?P<degrees>\d{3}))$",
    re.IGNORECASE,
)
"""End of a name that says which component it is; KiK-net numbers the instruments in the borehole 1, those above 2."""


@dataclass(frozen=True)
class Pairs(Card):
    """Pairs found in a folder, in the order of their first files, and the files that are in none.

    Parameters
    ----------
    name : str
        Name of the folder.
    pairs : tuple of Pair
        What was found.
    excluded : tuple of Excluded, optional
        Files that are not a component of a pair, with the reason.
    """

    name: str
    pairs: tuple[Pair, ...]
    excluded: tuple[Excluded, ...] = ()

    def __len__(self) -> int:
        return len(self.pairs)

    def __iter__(self) -> Iterator[Pair]:
        return iter(self.pairs)

    def __getitem__(self, index: int) -> Pair:
        return self.pairs[index]

    def table(self) -> pl.DataFrame:
        """Return one row per pair: labels, files, azimuths (degrees), samples, dt (s), PGA (g) and remarks."""
        import polars as pl

        rows = [
            {
                "pair": number,
                "name": pair.name,
                "event": pair.event,
                "station": pair.station,
                "first": _file(pair.first),
                "second": _file(pair.second),
                "vertical": None if pair.vertical is None else _file(pair.vertical),
                "azimuth_first": pair.first.azimuth,
                "azimuth_second": pair.second.azimuth,
                "samples": pair.samples,
                "dt": pair.dt,
                "pga_g_first": pair.first.pga_g,
                "pga_g_second": pair.second.pga_g,
                "remarks": "; ".join(pair.remarks),
            }
            for number, pair in enumerate(self.pairs, start=1)
        ]
        schema: dict[str, Any] = {"pair": pl.UInt32}
        schema |= dict.fromkeys(("name", "event", "station", "first", "second", "vertical"), pl.String)
        schema |= dict.fromkeys(("azimuth_first", "azimuth_second"), pl.Float64)
        schema |= {"samples": pl.UInt32, "dt": pl.Float64, "pga_g_first": pl.Float64, "pga_g_second": pl.Float64}
        return pl.DataFrame(rows, schema=schema | {"remarks": pl.String})


def find_pairs(folder: str | os.PathLike[str], *, lengths: Literal["shorter", "padded"] = "shorter") -> Pairs:
    """Return the pairs and triples of components among the record files of a folder and of those below.

    Files of one folder belong together that share the record sequence number of their names (``RSN161_...``), or else
    event and station of their headers, or else a name without the direction it ends in. Of those the two horizontals
    make the pair, and one vertical component is added. Directions come from the header, or from names that end in two
    numbers 90 degrees apart.

    Parameters
    ----------
    folder : path-like
        The folder, or a ZIP archive of one; hidden files are not looked at. What is read of it is what `read_suite`
        reads: every record format, each channel of files of several, and text of columns that states step and unit.
    lengths : {"shorter", "padded"}, default "shorter"
        See `Pair.from_records`.

    Raises
    ------
    RecordFormatError
        It is no folder or archive. A damaged file raises nothing: it stands in `excluded` with the reason, as does one
        that is not a record, or a component without a partner or with several.
    """
    directory = as_path(folder, "pairs", RecordFormatError)
    if is_archive(directory):
        with unpacked(directory) as (inside, names):
            files = [(file, directory / names[file]) for file in files_below(inside)]
            return _pairs_of(printable(directory.stem), files, lengths)
    if not directory.is_dir():
        missing = "" if directory.exists() else ", which does not exist"
        raise RecordFormatError(f"folder of pairs must be a directory; got {printable(str(directory))}{missing}")
    files = [(file, file) for file in files_below(directory)]
    return _pairs_of(printable(directory.resolve().name), files, lengths)


def _pairs_of(name: str, files: list[tuple[Path, Path]], lengths: Literal["shorter", "padded"]) -> Pairs:
    """Return the pairs of files, each with the path that it is called by."""
    excluded: list[Excluded] = []
    groups: dict[tuple[str, ...], list[Record]] = {}
    records_of_all: list[Record] = []
    for file, shown in files:
        try:
            read = read_file(file)
        except RecordFormatError as error:
            read = str(error)
        if isinstance(read, str):
            excluded.append(Excluded(shown, read))
            continue
        read = tuple(record.replace(source=shown) for record in read)
        excluded += [excluded_record(one, reason) for one in read if (reason := off_ground(one))]
        records_of_all += [one for one in read if not off_ground(one)]
    records_of_all, twice = recorded_once(with_tables(records_of_all, (file for file, _ in files)))
    excluded += twice
    several = Counter(record.source for record in records_of_all)
    for record in records_of_all:
        groups.setdefault(_group(record, several[record.source] > 1), []).append(record)
    pairs: list[Pair] = []
    for records in groups.values():
        for together in _sorted_out(records):
            pair, left = _pair(together, lengths)
            pairs.extend(pair)
            excluded.extend(left)
    excluded.sort(key=lambda item: item.file)
    return Pairs(name, tuple(pairs), tuple(excluded))


def _file(record: Record) -> str:
    return "" if record.source is None else printable(str(record.source))


def _group(record: Record, several: bool) -> tuple[str, ...]:
    """What components of one recording share: those of a file of several that says no more share the file."""
    file = record.source or Path(record.name)
    sequence = _SEQUENCE.match(file.name)
    if sequence:
        return str(file.parent), "RSN", sequence[1]
    if record.event and record.station:
        return str(file.parent), "header", record.event.lower(), record.station.lower()
    return str(file.parent), "name", file.name if several else _stem(record.name)


def _stem(name: str) -> str:
    """A name without the direction it ends in."""
    return _DIRECTION.sub(lambda end: end["level"] or "", re.sub(r" channel \S+$", "", name)).lower()


def _sorted_out(records: list[Record]) -> list[list[Record]]:
    """One group, or several by name where it has more than two horizontals: instruments of one station."""
    if sum(vertical_reason(record) is None for record in records) <= 2:
        return [records]
    groups: dict[str, list[Record]] = {}
    for record in records:
        groups.setdefault(_stem(record.name), []).append(record)
    return list(groups.values())


def _pair(records: list[Record], lengths: Literal["shorter", "padded"]) -> tuple[list[Pair], list[Excluded]]:
    """The pair that a group makes, and what is left of it."""
    horizontal = [record for record in records if vertical_reason(record) is None]
    vertical = [record for record in records if vertical_reason(record) is not None]
    if len(horizontal) != 2:
        alone = "no second horizontal component beside it"
        several = f"{len(horizontal)} horizontal components that belong together: read_pair takes two by name"
        none = "vertical component without horizontal ones"
        return [], _left(records, {0: none, 1: alone}.get(len(horizontal), several))
    first, second = _directed_pair_search(horizontal)
    up = vertical[0] if len(vertical) == 1 else None
    try:
        pair = Pair.from_records(first, second, up, lengths=lengths)
    except InvalidMotion as error:
        return [], _left(records, str(error))
    return [pair], [] if up else _left(vertical, "more than one vertical component of its pair")


def _left(records: list[Record], reason: str) -> list[Excluded]:
    """Records that are in no pair; those of a file of several channels by name."""
    sources = [record.source for record in records]
    return [
        Excluded(record.source, reason if sources.count(record.source) == 1 else f"{record.name}: {reason}")
        for record in records
        if record.source is not None
    ]


def _directed_pair_search(horizontal: list[Record]) -> list[Record]:
    """The two horizontals with the directions that their names end in, where nothing else states them."""
    if any(record.azimuth is not None or azimuth_of(record.component) is not None for record in horizontal):
        return horizontal
    ends = [_DIRECTION.search(record.name) for record in horizontal]
    degrees = [float(end["degrees"]) for end in ends if end and end["degrees"]]
    if len(degrees) != 2 or max(degrees) > 360.0 or abs(between(*degrees)) != 90.0:
        return horizontal
    return [record.replace(azimuth=azimuth % 360.0) for record, azimuth in zip(horizontal, degrees, strict=True)]
