"""What is known of a record beside its samples: magnitude, distance, Vs30, mechanism and usable band.

From its header, or from a table that lies beside the files: PEER's _SearchResults.csv or an NGA-West2 flatfile.
"""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterable, Sequence
from itertools import islice
from pathlib import Path
from typing import Any, Final

from seismass.base.files import read_file
from seismass.base.limits import MOST_FLATFILE, MOST_ROWS
from seismass.base.values import printable
from seismass.motions.records.record import KNOWN, Record

USABLE_OVER_CORNER: Final = 1.25
"""Lowest usable frequency over the corner of a high-pass filter, as PEER takes it for NGA (second-hand)."""

_N: Final = r"(\d+(?:\.\d*)?|\.\d+)"
_IN_HEADER: Final = {
    "magnitude": (
        r"(?:magnitud\w*(?:_[wl])?|moment mag|mag|m[wlsb]|m(?=[ ]*=?[ ]*\d\.\d))[ .]*(?:\([^)]*\))?[ ]*[:=]?[ ]*"
        rf"{_N}(?![\w/:])"
    ),
    "distance_km": (
        rf"(?:epicentral[ _]*dist\w*(?:_km)?|(?:distance|rrup|rjb)[ ]*\(km\))[ ]*(?:\(km\))?[ ]*[:=]?[ ]*{_N}"
        rf"|(?<![^\W_])dist\w*[ ]*[:=]?[ ]*{_N}[ ]*km\b"
    ),
    "vs30": rf"vs_?30(?:_m/s)?[ ]*(?:\([^)]*\))?[ ]*[:=]?[ ]*{_N}",
    "mechanism": r"(?:focal[ _]mechanism|mechanism|style of faulting)[ ]*[:=][ ]*([A-Za-z][A-Za-z -]*)",
}
_PATTERNS: Final = {
    name: re.compile(rf"(?<![^\W_]){pattern}", re.IGNORECASE | re.MULTILINE) for name, pattern in _IN_HEADER.items()
}
_BANDS: Final = tuple(
    (re.compile(pattern, re.IGNORECASE), over)
    for pattern, over in (
        (rf"ramps at\s*{_N}\s*-\s*{_N}\s*and\s*{_N}\s*-\s*{_N}", 1.0),  # all of a frequency passes behind its ramp
        (rf"transition bands are\s*{_N}\s*-\s*{_N}\s*Hz and\s*{_N}\s*-\s*{_N}", 1.0),
        (rf"3 ?dB (?:pts|points) at\s*{_N}\s*and\s*{_N}\s*(?:cyc|Hz)", USABLE_OVER_CORNER),
        (rf"filtered below\s*{_N}\s*Hz[^\n]*above\s*{_N}\s*Hz", USABLE_OVER_CORNER),
        (rf"LOW_CUT_FREQUENCY_HZ:\s*{_N}\s*\n\s*HIGH_CUT_FREQUENCY_HZ:\s*{_N}", USABLE_OVER_CORNER),
        (rf"(?:filter )?(?:cut-?off|corner) freq\w*[^:\n]*:\s*{_N}\s*(?:-|to|and|,)\s*{_N}", USABLE_OVER_CORNER),
        (rf"\bHP\s*=\s*{_N}\s*Hz[, ]*LP\s*=\s*{_N}", USABLE_OVER_CORNER),
    )
)
_PLACES: Final = (
    re.compile(rf"^#?(?:Lat\.|EpicenterLatitude\(N\):)[ ]*{_N}", re.MULTILINE),
    re.compile(rf"^#?(?:Long\.|EpicenterLongitude\(E\):)[ ]*{_N}", re.MULTILINE),
    re.compile(rf"^#?(?:Station Lat\.|StationLatitude\(N\):)[ ]*{_N}", re.MULTILINE),
    re.compile(rf"^#?(?:Station Long\.|StationLongitude\(E\):)[ ]*{_N}", re.MULTILINE),
)
_LIMITS: Final = {"magnitude": (1.0, 10.0), "distance_km": (0.0, 2e4), "vs30": (30.0, 5e3)}
EARTH_KM: Final = 6371.0


def known_of_header(text: str) -> dict[str, Any]:
    """Return what the head of a file says, by the names of the fields of a record."""
    facts: dict[str, Any] = {}
    for name, pattern in _PATTERNS.items():
        for match in pattern.finditer(text):
            text_of_value = next(group for group in match.groups() if group)
            if name == "mechanism":
                facts.setdefault(name, text_of_value.strip())
            elif _LIMITS[name][0] < float(text_of_value) <= _LIMITS[name][1]:
                facts.setdefault(name, float(text_of_value))
    for pattern, over in _BANDS:
        band = pattern.search(text)
        if band is not None:
            numbers = [float(one) for one in band.groups()]
            facts |= {"lowest_hz": over * numbers[len(numbers) // 2 - 1], "highest_hz": numbers[len(numbers) // 2]}
            break
    places = [place[1] for pattern in _PLACES if (place := pattern.search(text))]
    if "distance_km" not in facts and len(places) == len(_PLACES):
        lat, lon, at_lat, at_lon = (math.radians(float(one)) for one in places)
        half = (
            math.sin((at_lat - lat) / 2.0) ** 2 + math.cos(lat) * math.cos(at_lat) * math.sin((at_lon - lon) / 2.0) ** 2
        )
        facts["distance_km"] = round(2.0 * EARTH_KM * math.asin(math.sqrt(half)), 1)
    return facts


_HEADS: Final = {
    "magnitude": r"(?:earthquake )?magnitude|mag|mw|m",
    "mechanism": r"mechanism(?: based on rake angle)?",
    "distance_km": r"rrup(?: \(km\))?|clstd(?: \(km\))?|closest distance(?: \(km\))?",
    "vs30": r"vs30(?: \(m/s(?:ec)?\))?(?: selected for analysis)?|preferred vs30 \(m/s\)",
    "lowest_hz": r"lowest use?able freq\w*(?: ?- ?(?:ave\. component|h1))?(?: \(hz\))?",
}
_RSN: Final = re.compile(r"rsn|record sequence number", re.IGNORECASE)
_FILES: Final = re.compile(r"(?:horizontal|vertical)[^,]*file ?name|file name[^,]*", re.IGNORECASE)
_MECHANISMS: Final = {"0": "strike slip", "1": "normal", "2": "reverse", "3": "reverse oblique", "4": "normal oblique"}
"""Numbers of the NGA-West2 flatfile."""
_SEQUENCE: Final = re.compile(r"RSN(\d+)", re.IGNORECASE)


def with_tables(records: Sequence[Record], files: Iterable[Path]) -> list[Record]:
    """Return records with what tables beside them say of their files or sequence numbers, where headers say nothing."""
    rows: dict[str, dict[str, Any]] = {}
    for file in files:
        if file.suffix.lower() == ".csv" and records:
            rows |= _rows_of(file)
    return [_with(record, rows) for record in records] if rows else list(records)


def _with(record: Record, rows: dict[str, dict[str, Any]]) -> Record:
    file = record.source.name if record.source else record.name
    sequence = _SEQUENCE.match(file)
    row = rows.get(file.lower()) or (rows.get(sequence[1]) if sequence else None) or {}
    return record.replace(**{name: value for name, value in row.items() if getattr(record, name) in (None, "")})


def _rows_of(file: Path) -> dict[str, dict[str, Any]]:
    """Return what a table says, by file names in lower case and by record sequence numbers."""
    try:
        text = read_file(file, MOST_FLATFILE).decode("utf-8-sig", "replace")
        rows_of_text = csv.reader(io.StringIO(text), skipinitialspace=True)
        table = list(islice(rows_of_text, 10 * MOST_ROWS)) if _RSN.search(text) else []
    except (OSError, csv.Error):
        return {}
    rows: dict[str, dict[str, Any]] = {}
    heads: list[str] = []
    for cells in table:
        if any(_RSN.fullmatch(cell.strip()) for cell in cells):
            heads = [" ".join(cell.split()) for cell in cells]
            continue
        if not heads or len(cells) < len(heads) - 1:
            continue
        by_head = dict(zip(heads, (cell.strip() for cell in cells), strict=False))
        row: dict[str, Any] = {}
        for name, pattern in _HEADS.items():
            cell = next((by_head[head] for head in by_head if re.fullmatch(pattern, head, re.IGNORECASE)), "")
            try:
                row[name] = _MECHANISMS.get(cell, printable(cell)) if name == "mechanism" else float(cell)
            except ValueError:
                continue
            if name != "mechanism" and not (math.isfinite(row[name]) and row[name] > 0.0):
                del row[name]  # -999 is not known
        keys = [cell for head, cell in by_head.items() if _FILES.fullmatch(head) or _RSN.fullmatch(head)]
        rows |= dict.fromkeys((re.split(r"[\\/]", key)[-1].lower() for key in keys if key), row)
    return rows


def known_words(record: Record) -> str:
    """Return what is known of a record in a line, or nothing."""
    facts = (
        ("M {:g}", record.magnitude),
        ("{:g} km", record.distance_km),
        ("Vs30 {:g} m/s", record.vs30),
        ("{}", record.mechanism),
        ("usable from {:.3g} Hz", record.lowest_hz),
        ("to {:.3g} Hz", record.highest_hz),
    )
    return ", ".join(form.format(value) for form, value in facts if value not in (None, ""))


def band_remarks(records: Iterable[Any], shortest: float, longest: float) -> list[str]:
    """Return a remark on records that are used at periods (s) beyond their usable band."""
    sentences = []
    for number, motion in enumerate(records, start=1):
        record = getattr(motion, "first", motion)
        lowest, highest = getattr(record, "lowest_hz", None), getattr(record, "highest_hz", None)
        name = getattr(motion, "name", "") or f"motion {number}"
        if lowest and longest > (1.0 + 1e-9) / lowest:
            sentences.append(f"{name} is usable to {1.0 / lowest:.3g} s and used to {longest:.3g} s")
        elif highest and shortest < (1.0 - 1e-9) / highest:
            sentences.append(f"{name} is usable from {1.0 / highest:.3g} s and used from {shortest:.3g} s")
    listed = "; ".join(sentences[:3]) + (f" (and {len(sentences) - 3} more)" if len(sentences) > 3 else "")
    return [f"the suite is used beyond the band of its records: {listed}"] if sentences else []


__all__ = ["KNOWN", "band_remarks", "known_of_header", "known_words", "with_tables"]
