"""Counts of miniSEED and SAC files as accelerations, by a factor that the caller states; ObsPy reads the files.

Sources: FDSN, "SEED Reference Manual" 2.4, appendix A (codes of bands, instruments and orientations) and chapter 8
(data records); IRIS, "SAC Data File Format" (IDEP: 6 displacement, 7 velocity, 8 acceleration, -12345 undefined;
CMPAZ degrees clockwise from north, CMPINC from up).
"""

from __future__ import annotations

import hashlib
import importlib
import io
import math
import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np

from seismass.base.errors import InvalidMotion, MissingPackage, RecordFormatError
from seismass.base.files import open_regular
from seismass.base.limits import MOST_RECORD
from seismass.base.values import as_number, as_path, brief, printable
from seismass.motions.records.formats import NotRead, known_binary
from seismass.motions.records.formats.labels import azimuth_of, is_vertical
from seismass.motions.records.read import HEAD_BYTES, suspicions
from seismass.motions.records.record import Record

FORMATS: Final = {"miniSEED": "MSEED", "SAC": "SAC"}
"""Kinds by their first bytes, and what ObsPy calls them."""
_SEED_CODE: Final = re.compile(r"[A-Z](?P<instrument>[A-Z])[A-Z0-9]")
VERTICAL: Final = 1.0
"""A SAC component within so many degrees of the vertical is one of it; CMPINC counts from up."""
_QUANTITIES: Final = {6: "displacement", 7: "velocity"}
_NO_ACCELEROMETER: Final = {"H": "velocity (a seismometer)", "L": "velocity (a seismometer of low gain)"}


def read_counts(path: str | os.PathLike[str], *, factor: float | Mapping[str, float]) -> tuple[Record, ...]:
    """Read every channel of a miniSEED or SAC file; counts times the factor are accelerations in m/s2.

    Needs ObsPy: pip install "seismass[obspy]".

    Parameters
    ----------
    path : path-like
        A miniSEED 2 or binary SAC file.
    factor : float or mapping
        m/s2 of one count; for a mapping that of each channel by its code, such as "HNE", or its whole name,
        "NET.STA.LOC.HNE". The files do not state it: it is one over the sensitivity that the network's station
        metadata gives, in counts per m/s2.

    Returns
    -------
    tuple of Record
        One for each channel, vertical ones included, in the order of the file. The mean is removed, as a remark says;
        nothing else is corrected.

    Raises
    ------
    RecordFormatError
        The file is of another kind or damaged, a channel has gaps or is of velocity or displacement, or the factor is
        no number or 0, or is missing for a channel.
    MissingPackage
        ObsPy is not installed.
    """
    source = as_path(path, "record", RecordFormatError)
    file = source.name
    if not isinstance(factor, Mapping):
        factor = {"": _stated(factor, file)}
    content, kind = _content(source)
    digest = hashlib.sha256(content).hexdigest()
    traces = _traces(content, kind, file)
    names = [str(trace.id) for trace in traces]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise RecordFormatError(
            f"channel {printable(twice)} of {file} must be without gaps; got {names.count(twice)} parts"
        )
    return tuple(_record(trace, factor, source, kind, digest, len(traces)) for trace in traces)


def _stated(value: Any, file: str) -> float:
    number = as_number(value, "factor", file, RecordFormatError)
    if not (math.isfinite(number) and number != 0.0):
        raise RecordFormatError(f"factor of {file} must be a number of m/s2 of one count, not 0; got {number:g}")
    return number


def _content(source: Path) -> tuple[bytes, str]:
    """Return the bytes of a file, and its kind."""
    try:
        with open_regular(source) as opened:
            content = opened.read(MOST_RECORD + 1)
    except OSError as error:
        raise RecordFormatError(
            f"record file must be a file that can be read; got {source} ({error.strerror or error})"
        ) from error
    if len(content) > MOST_RECORD:
        raise RecordFormatError(f"size of {source.name} must be at most {MOST_RECORD} bytes; got more")
    known = known_binary(content[:HEAD_BYTES])
    if known is None or known[0] not in FORMATS:
        got = known[0] if known else "something else; a text is read by read_record"
        raise NotRead(f"content of {source.name} must be miniSEED or SAC; got {got}")
    return content, known[0]


def _traces(content: bytes, kind: str, file: str) -> list[Any]:
    try:
        obspy: Any = importlib.import_module("obspy")
    except ImportError as error:
        raise MissingPackage(
            f'ObsPy of {kind} files must be installed (pip install "seismass[obspy]"); got: {error}'
        ) from error
    try:
        traces = list(obspy.read(io.BytesIO(content), format=FORMATS[kind]))
    except Exception as error:  # its readers raise of many kinds
        raise RecordFormatError(
            f"content of {file} must be a sound {kind} file; got: {printable(str(error))}"
        ) from error
    if not traces:
        raise RecordFormatError(f"content of {file} must be at least one channel; got none")
    return traces


def _record(trace: Any, factors: Mapping[str, float], source: Path, kind: str, digest: str, channels: int) -> Record:
    file, code = source.name, str(trace.stats.channel).strip()
    _check_quantity(trace, code, kind, file)
    stated = next((factors[name] for name in (str(trace.id), code, "") if name in factors), None)
    if stated is None:
        raise RecordFormatError(
            f"factor of {file} must be given for channel {printable(code)}; got {brief(list(factors))}"
        )
    counts = np.asarray(trace.data, dtype=np.float64)
    if counts.ndim != 1 or len(counts) == 0 or not np.isfinite(counts).all():
        raise RecordFormatError(f"samples of {file} must be finite numbers; got others")
    samples = counts * _stated(stated, file)
    mean = float(np.mean(samples))
    remarks = [f"mean of {mean:.4g} m/s2 removed", f"counts times {stated:g} m/s2, as the caller said"]
    if _SEED_CODE.fullmatch(code) is None:
        remarks.append(
            f"channel {printable(code) or 'without a code'}: that it is an acceleration is the caller's word"
        )
    component, azimuth = _direction(trace, code, kind, remarks)
    # SAC has a step of single precision: the shortest number that is it.
    step = float(str(np.float32(trace.stats.delta))) if kind == "SAC" else 1.0 / float(trace.stats.sampling_rate)
    try:
        record = Record(
            acceleration=samples - mean,
            dt=step,
            name=printable(source.stem) + (f" {printable(code)}" if channels > 1 else ""),
            event=printable(str(trace.stats.starttime)),
            station=printable(str(trace.stats.station)),
            component=printable(component),
            azimuth=azimuth,
            network=printable(str(trace.stats.network)),
            source=source,
            sha256=digest,
            file_unit="counts",
            remarks=tuple(remarks),
        )
    except InvalidMotion as error:
        raise RecordFormatError(f"samples of {file} must be those of a motion; got: {error}") from error
    return record.replace(remarks=record.remarks + suspicions(record, unit_is_stated=True))


def _direction(trace: Any, code: str, kind: str, remarks: list[str]) -> tuple[str, float | None]:
    """Return component and azimuth: by CMPAZ and CMPINC of a SAC file where it has them, else by the code."""
    by_code = azimuth_of(code)
    azimuth, from_up = (trace.stats.sac.get(key) if kind == "SAC" else None for key in ("cmpaz", "cmpinc"))
    if from_up is not None and min(abs(from_up), abs(from_up - 180.0)) < VERTICAL:
        return (code if is_vertical(code) else f"{code} UP".strip()), None
    if azimuth is None or not 0.0 <= azimuth <= 360.0 or (from_up is None and is_vertical(code)):
        return code, by_code
    turned = float(azimuth) % 360.0
    if by_code is not None and turned != by_code:
        remarks.append(f"direction is {turned:g} degrees by its CMPAZ, not {by_code:g} as its code, {printable(code)}")
    return code, turned


def _check_quantity(trace: Any, code: str, kind: str, file: str) -> None:
    seed = _SEED_CODE.fullmatch(code)
    got = _NO_ACCELEROMETER.get(seed["instrument"]) if seed else None
    if kind == "SAC":
        got = _QUANTITIES.get(int(trace.stats.sac.get("idep", 0)), got)
    if got is not None:
        raise NotRead(f"quantity of channel {printable(code)} of {file} must be acceleration; got {got}")
