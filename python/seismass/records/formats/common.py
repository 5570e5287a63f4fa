"""What every reader of a format takes and gives, and how a caller's step and unit are held against a header's."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS
from seismass.records.record import Record

LINE_WIDTH: Final = 400
"""Lines of headers have 80 characters, some a little more; what stands further right is not looked at."""

SAME_STEP: Final = 1e-6
"""Two steps that differ by less, relatively, are the same."""


class NotRead(RecordFormatError):
    """A sound file of a kind that is known and not read as acceleration: another format, velocity, raw counts."""


@dataclass(frozen=True)
class Arguments:
    """What a caller of `read_record` says of the file: step (s), unit by its name, rows to leave out."""

    dt: float | None = None
    unit: str | None = None
    skip: int | None = None


@dataclass(frozen=True)
class Channel:
    """One acceleration of a file, by the number or code that the file gives it."""

    label: str
    record: Record


def channels_of(
    lines: list[str], component: Callable[[int, int], tuple[Channel, int]], *, between: str | None = None
) -> tuple[Channel, ...]:
    """Return the components of a file, one after the other, with blank lines or lines that begin with `between` in
    between. `component` takes the first line's index and the number (from 1), returns it and the next line.
    """
    channels: list[Channel] = []
    at = 0
    while at < len(lines):
        if not lines[at].strip() or (between is not None and lines[at].startswith(between)):
            at += 1
            continue
        channel, at = component(at, len(channels) + 1)
        channels.append(channel)
    return tuple(channels)


@dataclass(frozen=True)
class Format:
    """One format: its key, what it is called, how its head is known, and its reader."""

    name: str
    title: str
    recognises: Callable[[str], bool]
    parse: Callable[[str, Path, Arguments], tuple[Channel, ...]]


def agreed_step(stated: float | None, dt: float | None, written: str, file: str) -> float:
    """Return the step (s) of a header, which a given one must equal."""
    if stated is None:
        if dt is None:
            raise RecordFormatError(f"dt of {file} must be given, its header states no step; got none")
        return dt
    if dt is not None and abs(dt - stated) > SAME_STEP * stated:
        raise RecordFormatError(f"dt of {file} must agree with its header, {written}; got {dt:g} s")
    return stated


def agreed_unit(stated: str, unit: str | None, file: str) -> str:
    """Return the unit of a header, which a given one must equal."""
    if unit is not None and ACCELERATION_UNITS[unit] != ACCELERATION_UNITS[stated]:
        raise RecordFormatError(f"unit of {file} must be that of its header, {stated}; got {unit}")
    return stated


def refuse_skip(arguments: Arguments, format_title: str, file: str) -> None:
    """Refuse rows to leave out where the format says which lines are data."""
    if arguments.skip is not None:
        article = "an" if format_title[:1] in ".AEIOU" else "a"
        raise RecordFormatError(
            f"skip of {file} must be left out for {article} {format_title} file; got {arguments.skip!r}"
        )
