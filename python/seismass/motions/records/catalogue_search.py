"""Which of the paper's seven records a folder holds, judged by header and content of its files, not by their names."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final, Literal

import numpy as np

from seismass.base.errors import RecordFormatError
from seismass.base.files import open_regular
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import as_path, printable
from seismass.motions.records.catalogue import (
    RECORDINGS,
    SUBSTITUTES,
    CatalogueSearch,
    Component,
    FoundFile,
    Judged,
    Recording,
)
from seismass.motions.records.formats.labels import azimuth_of, is_vertical
from seismass.motions.records.read import HEAD_BYTES, files_below, format_of, read_records
from seismass.motions.records.record import Record

_ALL: Final = (*RECORDINGS, *SUBSTITUTES)
_LARGEST_BYTES: Final = 8 * 1024 * 1024
"""Larger files are not looked at; the longest of the seven has 0.12 MB."""
_HEAD_LINES: Final = 10
_SAME_PEAK: Final = 2e-4
"""Peaks are the same within this, of files with five digits and more."""
_SAME_SHAPE: Final = 1e-3
"""Ratios of the two largest accelerations are the same within this,"""
_NEAR_SHAPE: Final = 0.05
"""and those of one recording processed twice are within this."""
_SEQUENCE: Final = re.compile(r"RSN_?(\d+)(?!\d)", re.IGNORECASE)
_YEAR: Final = re.compile(r"\b((?:18|19|20)\d\d)\b")
_SHORT_YEAR: Final = re.compile(r"\b\d{1,2}/\d{1,2}/(\d\d)\b")
# What text of columns may leave out. The shape of a record needs no step, and its peak tells the unit.
_ATTEMPTS: Final[tuple[dict[str, Any], ...]] = ({}, {"unit": "g"}, {"dt": 0.01}, {"unit": "g", "dt": 0.01})


def find_catalogue(folder: str | os.PathLike[str]) -> CatalogueSearch:
    """Look in a folder, and in all below, for the seven records of the paper's Table 1 and for substitutes.

    Parameters
    ----------
    folder : path-like
        A directory; hidden files are not looked at.

    Returns
    -------
    CatalogueSearch
        What each file is, and how to get what is missing.

    Raises
    ------
    RecordFormatError
        The folder is not a directory.

    Notes
    -----
    A file is one of the seven if its header names event, year and station, or if its points, the place of its peak and
    the ratio of its two largest accelerations are those of a component: that is so in any unit, and for scaled records.
    Where the ratio is only near, the file is another processing of the recording, and a remark says so. A name such as
    ``RSN6_...`` alone proves nothing: files are renamed.
    """
    place = as_path(folder, "catalogue search", RecordFormatError)
    if not place.is_dir():
        missing = "" if place.exists() else ", which does not exist"
        raise RecordFormatError(f"folder of catalogue search must be a directory; got {place}{missing}")
    files = files_below(place)
    matches = [one for file in files for one in _identified(file)]
    order = {recording.rsn: position for position, recording in enumerate(_ALL)}
    matches.sort(key=lambda one: (order[one.recording.rsn], one.file))
    return CatalogueSearch(place, tuple(_without_doubles(matches)), len(files))


def _without_doubles(matches: list[FoundFile]) -> Iterator[FoundFile]:
    """The files, with a remark on each that is of the same component as one before."""
    first: dict[str, Path] = {}
    for one in matches:
        if one.component is None or not one.usable:
            yield one
            continue
        known = first.setdefault(one.component.file, one.file)
        remarks = one.remarks
        if known != one.file:
            remarks += (f"the same component as {printable(known.name)}",)
        yield FoundFile(**{**one.__dict__, "remarks": remarks})


def _identified(file: Path) -> Iterator[FoundFile]:
    """What a file is, channel by channel; nothing where it is not one of the seven."""
    if file.stat().st_size > _LARGEST_BYTES:
        return
    reason = ""
    for options in _ATTEMPTS:
        try:
            records = read_records(file, **options)
        except RecordFormatError as error:
            reason = reason or str(error)
            continue
        for record in records:
            one = _of_record(file, record, step_stated="dt" not in options)
            if one is not None:
                yield one
        return
    titled = _title(file)
    by_header = None if titled is None else _by_header(titled[0], titled[1])
    if titled is not None and by_header is not None:
        component = _component(by_header, titled[2], azimuth_of(titled[2]))
        yield FoundFile(
            file=file,
            recording=by_header,
            component=component,
            label=titled[2],
            direction=_direction(component, titled[2]),
            samples=None,
            dt=None,
            pga_g=None,
            judged="header",
            usable=False,
            remarks=(reason,),
        )


def _of_record(file: Path, record: Record, *, step_stated: bool) -> FoundFile | None:
    """What a record is, by its header, else by its samples; by its name it is said to be so alone."""
    remarks = list(record.remarks)
    judged: Judged = "header"
    recording = _by_header(record.event, record.station)
    component = None if recording is None else _component(recording, record.component, record.azimuth)
    named = _by_name(file)
    if recording is None:
        match = _by_content(record)
        if match is not None:
            (recording, component), judged = match, "content"
        elif named is not None:
            recording, judged = named, "name"
            remarks.append(f"its name says RSN{named.rsn}; neither header nor content does: not counted")
        else:
            return None
    elif component is not None and _alike(record, component):
        judged = "header and content"
    if component is not None and _alike(record, component):
        remarks += _scale(record, component)
    elif judged != "name":
        remarks += _version(record, component)
    if named is not None and named is not recording:
        remarks.append(f"its name says RSN{named.rsn}, its header {recording.event}, {recording.station}")
    return FoundFile(
        file=file,
        recording=recording,
        component=component,
        label=record.component or ("" if component is None else _label(component)),
        direction=_direction(component, record.component),
        samples=record.samples,
        dt=record.dt if step_stated else None,
        pga_g=record.pga_g,
        judged=judged,
        usable=judged != "name",
        remarks=tuple(remarks),
    )


def _by_header(event: str, station: str) -> Recording | None:
    """The recording whose event, year and station a header names; a header without a year may be of any."""
    event, station = event.upper(), station.strip().upper()
    short = _SHORT_YEAR.search(event)
    full = _YEAR.search(event)
    year = int(full[1]) if full else 1900 + int(short[1]) if short else None
    for one in _ALL:
        if year in (None, one.year) and one.event_pattern.search(event) and one.station_pattern.search(station):
            return one
    return None


def _by_content(record: Record) -> tuple[Recording, Component] | None:
    """The component whose points and peak a record has; one that is only near it where none is the same."""
    for tolerance in (_SAME_SHAPE, _NEAR_SHAPE):
        for one in _ALL:
            for component in one.components:
                if _alike(record, component, tolerance):
                    return one, component
    return None


def _by_name(file: Path) -> Recording | None:
    number = _SEQUENCE.search(file.name)
    return None if number is None else next((one for one in _ALL if one.rsn == int(number[1])), None)


def _title(file: Path) -> tuple[str, str, str] | None:
    """Event, station and component of the title of a damaged .AT2 file, or of one of velocities; else None."""
    try:
        with open_regular(file) as opened:
            head = opened.read(HEAD_BYTES).decode("latin-1")
        if format_of(head, file).name != "at2":
            return None
    except (OSError, RecordFormatError):
        return None
    for line in head.splitlines()[:_HEAD_LINES]:
        parts = [part.strip() for part in line.split(",")]
        if len(parts) >= 3 and _by_header(", ".join(parts[:-2]), parts[-2]) is not None:
            return ", ".join(parts[:-2]), parts[-2], parts[-1]
    return None


def _component(recording: Recording, label: str, azimuth: float | None) -> Component | None:
    """The component of a recording that a label names."""
    if is_vertical(label):
        return next(one for one in recording.components if one.azimuth is None)
    if azimuth is None:
        return None
    return next((one for one in recording.components if one.azimuth == azimuth % 360.0), None)


def _direction(component: Component | None, label: str) -> Literal["horizontal", "vertical", "unknown"]:
    if component is not None:
        return "vertical" if component.azimuth is None else "horizontal"
    if is_vertical(label):
        return "vertical"
    return "unknown" if azimuth_of(label) is None else "horizontal"


def _label(component: Component) -> str:
    return "vertical" if component.azimuth is None else f"{component.azimuth:g}"


def _alike(record: Record, component: Component, tolerance: float = _SAME_SHAPE) -> bool:
    """Whether points, place of the peak and ratio of the two largest accelerations are those of a component."""
    if record.samples != component.samples or component.opposite is None:
        return False
    samples = record.acceleration
    peak = int(np.argmax(np.abs(samples)))
    if samples[peak] == 0.0 or peak + 1 != component.peak_sample:
        return False
    sign = np.sign(samples[peak])
    return abs(float(np.min(sign * samples)) / abs(float(samples[peak])) - component.opposite) < tolerance


def _scale(record: Record, component: Component) -> list[str]:
    """A remark where accelerations are a multiple of those recorded, or the step is another."""
    remarks = []
    if component.peak_g is not None and component.peak_sample is not None:
        factor = float(record.acceleration[component.peak_sample - 1]) / (STANDARD_GRAVITY * component.peak_g)
        if abs(factor - 1.0) > _SAME_PEAK:
            remarks.append(
                f"accelerations are {factor:.5g} times those recorded, {abs(component.peak_g):.5f} g at the peak: "
                "scaled, or in another unit"
            )
    return remarks


def _version(record: Record, component: Component | None) -> list[str]:
    """A remark where a header names a component whose samples are not those of NGA-West2."""
    if component is None:
        return ["its direction is none of those recorded: turned, or another file"]
    if component.samples is None or component.peak_g is None:
        return ["its content cannot be checked: points and peak of this component were not at hand"]
    return [
        f"not the samples of {component.file}, which has {component.samples} points of {component.dt:g} s and a peak "
        f"of {abs(component.peak_g):.5f} g: another processing of the recording, or changed"
    ]
