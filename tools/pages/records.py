"""What is read of recordings, against the headers' words and other readers' numbers, and of kinds of files."""

from __future__ import annotations

import csv
import re
import runpy
from pathlib import Path

import numpy as np

from pages.parts import ROOT, Page, table
from seismass.base.errors import RecordFormatError
from seismass.motions.records import Record, read_records

OTHERS = ROOT / "tests" / "data" / "other_readers.csv"
ARGUMENTS: dict[str, dict[str, object]] = {
    "4_HECTOR000.txt": {"unit": "g"},
    "el_centro.th": {"unit": "g", "dt": 0.02},
    "ChiChi.txt": {"unit": "g"},
}

CLAIMS: tuple[str, ...] = (
    r"PEAK ACCELERATION =\s*\S+\s+CM/SEC/SEC\s+AT\s+\S+\s+SEC",
    r"Max =\s*\S+ cm/sec2 at\s+\S+ sec",
    r"NDATA: \d+|SAMPLING_INTERVAL_S: \S+|PGA_CM/S\^2: \S+|TIME_PGA_S: \S+",
    r"Sampling Freq\(Hz\) \S+|Duration Time\(s\)\s+\S+|Max. Acc. \(gal\)\s+\S+",
    r"pk acc =\s+\S+|pk     =\s+\S+",
    r"NPTS=\s*\d+,?\s*DT=\s*\S+",
    r"\d+\s+points of instrument-|AT EQUALLY-SPACED INTERVALS OF\s+\S+\s+SEC",
    r"\d+ acceleration pts, approx\s+\d+ secs",
)
"""Where headers say the number of points, the step and the peak; read apart from the readers."""


def fill(page: Page) -> None:
    """Put in the table of recordings, where they are at hand, and that of kinds of files, which are made."""
    page.marked("kinds", runpy.run_path(str(ROOT / "tools" / "kinds_of_files.py"))["table"]())
    if page.shared:
        page.marked("readings", readings(page.shared / "record_formats"))


def claims(text: str) -> list[str]:
    """Return the words of the headers, one per channel where there are several."""
    heads = re.split(r"(?m)^(?=CORRECTED ACCELEROGRAM)", text, flags=re.IGNORECASE)
    found = []
    for head in [head for head in heads if head.strip()]:
        lines = "\n".join(head.splitlines()[:80])
        words = [match for pattern in CLAIMS for match in re.findall(pattern, lines, re.IGNORECASE)]
        found.append("; ".join(" ".join(word.split()) for word in words) or "none")
    return found


def numbers(record: Record) -> tuple[int, float, float, float, float]:
    """Return points, step, signed peak, its time and the first sample."""
    at = int(np.argmax(np.abs(record.acceleration)))
    samples = record.acceleration
    return record.samples, record.dt, float(samples[at]), at * record.dt, float(samples[0])


def others() -> dict[tuple[str, int], dict[str, str]]:
    """Return other readers' numbers by file and channel."""
    with OTHERS.open(encoding="utf-8", newline="") as file:
        return {(row["file"], int(row["channel"])): row for row in csv.DictReader(file)}


def readings(folder: Path) -> str:
    """Return the table of recordings."""
    known, rows = others(), []
    for file in sorted(path for path in folder.rglob("*") if path.is_file()):
        name = file.relative_to(folder).as_posix()
        said = claims(file.read_bytes().decode("latin-1"))
        try:
            records = read_records(file, **ARGUMENTS.get(file.name, {}))
        except RecordFormatError as error:
            rows.append([f"`{name}`", f"refused: {error}", *[""] * 4, said[0], ""])
            continue
        for number, record in enumerate(records, start=1):
            points, dt, peak, at, first = numbers(record)
            channel = f" channel {number}" if len(records) > 1 else ""
            row = known.get((name, number))
            same = f"{row['reader']}: {row['peak']} at {row['time']}" if row else ""
            measured = (points, f"{dt:g}", f"{peak:.7g}", f"{at:.6g}", f"{first:.4g}")
            rows.append([f"`{name}`{channel}", *measured, said[min(number, len(said)) - 1], same])
    heads = "file | points | step (s) | peak (m/s2) | at (s) | first (m/s2) | the header says | another reader"
    head, _, *lines = table(heads, rows).splitlines()
    return "\n".join([head, f"| --- |{' ---: |' * 5} --- | --- |", *lines]).replace("  |", " |")
