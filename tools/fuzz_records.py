"""Read mutated record files and count what becomes of them: refused, the same, different with a remark, or a defect.

Usage: tools/fuzz_records.py [--count 100000] [--seed 1] [--page] [--keep DIR]. Files are those of tools/record_files.py
and, where SEISMASS_SHARED names a folder, its record_formats and some of its records. --page writes the outcome to
docs/records.md; --keep saves the files behind defects. A small run is part of the tests.
"""

from __future__ import annotations

import argparse
import os
import random
import re
import resource
import runpy
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from seismass.base.errors import RecordFormatError
from seismass.motions.records import Record, read_records
from seismass.motions.records.formats import Format, recognise
from seismass.motions.records.formats.common import NO_COUNT

NETWORKS = ("resorce", "csmnc", "jma", "nied_csv", "cwa", "afad", "geonet", "unam", "bhrc")

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "records.md"

SECONDS_PER_FILE = 5.0
MEMORY_GROWTH_KB = 512 * 1024
"""A file that takes longer, or makes the process larger by more, is a defect. The largest file read has 1.1 MB."""

SCALE_ROUNDING = 1e-4
"""A scale that is off by less is within the digits of the peak in the header."""

ARGUMENTS: dict[str, dict[str, object]] = {
    "4_HECTOR000.txt": {"unit": "g"},
    "el_centro.th": {"unit": "g", "dt": 0.02},
    "ChiChi.txt": {"unit": "g"},
}
SOME_RECORDS = ("RSN1612_DUZCE_1059-E.AT2", "RSN821_ERZINCAN_ERZ-UP", "RSN1633_MANJIL_ABBAR--T", "RSN725_SUPER")

OUTCOMES = {
    "refused": "refused with a `RecordFormatError`",
    "same": "read as the unchanged file, or as the other of two spliced",
    "labels": "same samples and step, another event, station, component or direction",
    "fewer": "fewer channels, each as in the unchanged file",
    "remark": "different samples or step, with a remark that the unchanged file has not",
    "no count": "another number of samples in text of columns that states none, as a remark says of any such file",
    "value": "the same number of samples, some of other values (a digit, a sign, end of a scale): nothing contradicts",
    "order": "the same number of samples, lines or columns of them in another order or in place of others",
    "step": "another step: a digit of the only step that the file states",
    "defect: silent": "**defect**: different without a remark",
    "defect: crash": "**defect**: another exception",
    "defect: slow": f"**defect**: more than {SECONDS_PER_FILE:g} s",
    "defect: memory": f"**defect**: more than {MEMORY_GROWTH_KB // 1024} MB",
}


@dataclass(frozen=True)
class Original:
    """An unchanged file, how it is read, and what it gives."""

    name: str
    content: bytes
    arguments: dict[str, object]
    records: tuple[Record, ...]
    header_lines: int


@dataclass
class Tally:
    """Counts by format and outcome, and the first defects."""

    counts: Counter[tuple[str, str]] = field(default_factory=Counter)
    defects: list[tuple[str, str, bytes]] = field(default_factory=list)

    @property
    def total(self) -> int:
        """Number of files read."""
        return sum(self.counts.values())


def originals(shared: Path | None, folder: Path) -> list[Original]:
    """Return all files that read without error, the made ones first."""
    made = runpy.run_path(str(ROOT / "tools" / "record_files.py"))["files"]()
    sources: list[tuple[str, bytes]] = list(made)
    if shared is not None:
        real = sorted(file for file in (shared / "record_formats").rglob("*") if file.is_file())
        real += [
            file
            for file in sorted((shared / "records").rglob("*.AT2"))
            if any(file.name.startswith(name) for name in SOME_RECORDS)
        ]
        sources += [(file.name, file.read_bytes()) for file in real]
    found = []
    for name, content in sources:
        arguments = ARGUMENTS.get(name, {})
        path = folder / name
        path.write_bytes(content)
        try:
            records = read_records(path, **arguments)
        except RecordFormatError:
            continue
        finally:
            path.unlink()
        lines = content.decode("latin-1").split("\n")
        header = next((at for at, line in enumerate(lines) if at > 3 and not re.search("[A-Za-z]{3}", line)), 4)
        found.append(Original(name, content, arguments, records, header))
    return found


Mutation = Callable[[random.Random, bytes, Original, list[Original]], bytes]


def _lines(content: bytes) -> list[bytes]:
    return content.split(b"\n")


def truncate(rng: random.Random, content: bytes, _: Original, __: list[Original]) -> bytes:
    """Cut the file at any byte."""
    return content[: rng.randrange(len(content))]


def truncate_at_line(rng: random.Random, content: bytes, _: Original, __: list[Original]) -> bytes:
    """Cut the file after any line."""
    lines = _lines(content)
    return b"\n".join(lines[: rng.randrange(1, len(lines) + 1)]) + rng.choice((b"", b"\n"))


def delete_lines(rng: random.Random, content: bytes, _: Original, __: list[Original]) -> bytes:
    """Leave out some lines in a row."""
    lines = _lines(content)
    at = rng.randrange(len(lines))
    del lines[at : at + rng.choice((1, 1, 1, 2, 5, 50))]
    return b"\n".join(lines)


def duplicate_lines(rng: random.Random, content: bytes, _: Original, __: list[Original]) -> bytes:
    """Write some lines twice."""
    lines = _lines(content)
    at = rng.randrange(len(lines))
    some = lines[at : at + rng.choice((1, 1, 2, 10))]
    lines[at:at] = some * rng.choice((1, 1, 2, 30))
    return b"\n".join(lines)


def insert_line(rng: random.Random, content: bytes, _: Original, others: list[Original]) -> bytes:
    """Put a line of this or another file somewhere."""
    lines = _lines(content)
    source = lines if rng.random() < 0.5 else _lines(rng.choice(others).content)
    lines.insert(rng.randrange(len(lines) + 1), rng.choice((rng.choice(source), b"", b"1 2 3", b"--", b"0.0")))
    return b"\n".join(lines)


def replace_line(rng: random.Random, content: bytes, _: Original, __: list[Original]) -> bytes:
    """Put one line in the place of another, or change two."""
    lines = _lines(content)
    a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[a], lines[b] = lines[b], lines[a] if rng.random() < 0.5 else lines[b]
    return b"\n".join(lines)


def flip_bits(rng: random.Random, content: bytes, _: Original, __: list[Original]) -> bytes:
    """Flip one to four bits."""
    changed = bytearray(content)
    for _i in range(rng.randrange(1, 5)):
        changed[_place(rng, changed)] ^= 1 << rng.randrange(8)
    return bytes(changed)


def change_digits(rng: random.Random, content: bytes, _: Original, __: list[Original]) -> bytes:
    """Change one to three digits, half of the time in the first lines."""
    changed = bytearray(content)
    for _i in range(rng.randrange(1, 4)):
        at = _place(rng, changed)
        while at < len(changed) - 1 and not chr(changed[at]).isdecimal():
            at += 1
        changed[at] = ord(rng.choice("0123456789"))
    return bytes(changed)


def change_bytes(rng: random.Random, content: bytes, _: Original, __: list[Original]) -> bytes:
    """Delete, insert or overwrite some bytes."""
    at = _place(rng, bytearray(content))
    size = rng.choice((1, 1, 2, 3, 8, 80))
    new = bytes(rng.choice(b" \t\r\n0123456789.-+eEgG,;#*/()=\x00\xff") for _i in range(rng.choice((0, 0, size))))
    return content[:at] + new + content[at + rng.choice((0, size)) :]


def swap_columns(rng: random.Random, content: bytes, _: Original, __: list[Original]) -> bytes:
    """Change two columns of numbers of equal width in some lines."""
    lines = _lines(content)
    start = rng.randrange(len(lines))
    width = rng.choice((7, 8, 9, 10, 15))
    for at in range(start, min(start + rng.choice((1, 5, 10_000)), len(lines))):
        line = lines[at]
        if len(line) >= 2 * width:
            lines[at] = line[width : 2 * width] + line[:width] + line[2 * width :]
    return b"\n".join(lines)


def swap_tokens(rng: random.Random, content: bytes, _: Original, __: list[Original]) -> bytes:
    """Change the first two tokens of every line of a stretch, as of times and accelerations."""
    lines = _lines(content)
    start = rng.randrange(len(lines))
    for at in range(start, min(start + rng.choice((1, 10_000)), len(lines))):
        lines[at] = re.sub(rb"^(\s*)([^\s,]+)([\s,]+)([^\s,]+)", rb"\1\4\3\2", lines[at])
    return b"\n".join(lines)


def drop_header_lines(rng: random.Random, content: bytes, original: Original, _: list[Original]) -> bytes:
    """Leave out one to three lines of the header."""
    lines = _lines(content)
    for _i in range(rng.randrange(1, 4)):
        del lines[rng.randrange(min(original.header_lines, len(lines)))]
    return b"\n".join(lines)


def splice(rng: random.Random, content: bytes, _: Original, others: list[Original]) -> bytes:
    """Put the end of another file behind the beginning of this one."""
    other = rng.choice(others).content
    a, b = _lines(content), _lines(other)
    cut = rng.randrange(len(a))
    return b"\n".join(a[:cut] + b[rng.choice((min(cut, len(b) - 1), rng.randrange(len(b)))) :])


def odd_numbers(rng: random.Random, content: bytes, _: Original, __: list[Original]) -> bytes:
    """Write something that is nearly a number in place of one."""
    found = list(re.finditer(rb"[-+]?\d*\.\d+(?:[EeDd][-+]?\d+)?", content[: 1 << 17]))
    if not found:
        return content
    match = rng.choice(found)
    size = match.end() - match.start()
    odd = rng.choice((b"nan", b"inf", b"*" * size, b"1e999", b"1_0", b"0x1", b"", b"9" * size, b"-", b"1,5", b"1.0.0"))
    return content[: match.start()] + odd.rjust(size) + content[match.end() :]


def line_ends(rng: random.Random, content: bytes, _: Original, __: list[Original]) -> bytes:
    """Write other line ends, trailing blanks, or a mark of the encoding: the same record."""
    plain = content.replace(b"\r\n", b"\n")
    return rng.choice(
        (
            plain.replace(b"\n", b"\r\n"),
            plain.replace(b"\n", b"   \n"),
            b"\xef\xbb\xbf" + plain,
            plain + b"\x1a",
            plain + b"\n\n\n",
        )
    )


MUTATIONS: tuple[Mutation, ...] = (
    truncate,
    truncate_at_line,
    delete_lines,
    duplicate_lines,
    insert_line,
    replace_line,
    flip_bits,
    change_digits,
    change_digits,
    change_bytes,
    swap_columns,
    swap_tokens,
    drop_header_lines,
    splice,
    odd_numbers,
    line_ends,
)


def _place(rng: random.Random, content: bytearray) -> int:
    """Return an index, half of the time among the first 4000 bytes, where headers are."""
    return rng.randrange(min(len(content), 4000) if rng.random() < 0.5 else len(content)) if content else 0


def classify(original: Original, records: tuple[Record, ...]) -> str:
    """Return the outcome of a mutated file that was read."""
    before = original.records
    known = {remark for record in before for remark in record.remarks}
    remarked = any(remark not in known for record in records for remark in record.remarks)
    if len(records) < len(before) and all(any(_equal(one, old) for old in before) for one in records):
        return "fewer"
    if len(records) == len(before) and all(_equal(one, old) for one, old in zip(records, before, strict=True)):
        labels = ("event", "station", "component", "azimuth", "network")
        same = all(getattr(a, x) == getattr(b, x) for a, b in zip(records, before, strict=True) for x in labels)
        return "same" if same else "labels"
    if remarked:
        return "remark"
    if len(records) != len(before):
        return "defect: silent"
    if any(a.samples != b.samples for a, b in zip(records, before, strict=True)):
        same_step = all(a.dt == b.dt and a.file_unit == b.file_unit for a, b in zip(records, before, strict=True))
        return "no count" if NO_COUNT in records[0].remarks and same_step else "defect: silent"
    changed = []
    for a, b in zip(records, before, strict=True):
        # The mean that is removed from K-NET counts moves with every sample.
        moved = a.acceleration - b.acceleration
        moved -= np.median(moved)
        changed.append(np.flatnonzero(np.abs(moved) > 1e-12 * b.pga))
    if all(
        np.array_equal(np.sort(a.acceleration), np.sort(b.acceleration)) for a, b in zip(records, before, strict=True)
    ):
        return "order"
    if all(len(at) > 0.9 * a.samples for at, a in zip(changed, records, strict=True)):
        # Another unit, sign or scale, but for the last digits of K-NET's scale factor, below those of its peak.
        rounding = all(
            np.max(np.abs(a.acceleration - b.acceleration)) < SCALE_ROUNDING * b.pga
            for a, b in zip(records, before, strict=True)
        )
        return "value" if rounding else "defect: silent"
    if any(a.dt != b.dt for a, b in zip(records, before, strict=True)):
        return "step" if sum(map(len, changed)) <= 4 else "defect: silent"
    return "value" if sum(map(len, changed)) <= 4 else "order"


def _equal(one: Record, other: Record) -> bool:
    """Whether samples and step are the same."""
    return one.dt == other.dt and np.array_equal(one.acceleration, other.acceleration)


def try_one(original: Original, content: bytes, path: Path, sources: list[Original]) -> str:
    """Read one mutated file and return its outcome."""
    path.write_bytes(content)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.process_time()
    try:
        records = read_records(path, **original.arguments)
        outcome = classify(original, records)
        if outcome == "defect: silent" and any(classify(other, records) in ("same", "labels") for other in sources):
            outcome = "same"  # the head of a file before the whole of another
    except RecordFormatError:
        outcome = "refused"
    except Exception as error:
        return f"defect: crash {type(error).__name__}: {error}"[:200]
    if time.process_time() - start > SECONDS_PER_FILE:
        return "defect: slow"
    if resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before > MEMORY_GROWTH_KB:
        return "defect: memory"
    return outcome


def fuzz(count: int, seed: int, shared: Path | None) -> Tally:
    """Read `count` mutated files; the same seed and files give the same."""
    rng = random.Random(seed)
    tally = Tally()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sources = originals(shared, folder)
        # Small files are taken more often: all are, but a large one costs as much as many small ones.
        weights = [1.0 / (2000.0 + len(source.content)) for source in sources]
        for original, mutation in _cases(rng, count, sources, weights):
            content = mutation(rng, original.content, original, sources)
            path = folder / original.name
            outcome = try_one(original, content, path, sources)
            key = "defect: crash" if outcome.startswith("defect: crash") else outcome
            tally.counts[_format_of(original), key] += 1
            if key.startswith("defect") and len(tally.defects) < 50:
                tally.defects.append((f"{original.name}, {mutation.__name__}", outcome, content))
            path.unlink()
    return tally


def _cases(
    rng: random.Random, count: int, sources: list[Original], weights: list[float]
) -> Iterator[tuple[Original, Mutation]]:
    for _ in range(count):
        yield rng.choices(sources, weights)[0], rng.choice(MUTATIONS)


def _format_of(original: Original) -> str:
    suffixes = {
        "AT2": ".at2",
        "COSMOS": ".cosmos .v2c",
        "CSMIP": ".v1 .v2",
        "ESM": ".asc",
        "K-NET, KiK-net": ".ew .ud2 .knet",
        "SMC": ".smc",
    }
    suffix = Path(original.name).suffix.lower()
    known_by = recognise(original.content[:8192].decode("latin-1"))
    if isinstance(known_by, Format) and known_by.name in NETWORKS:
        return "networks"
    return next((name for name, known in suffixes.items() if suffix in known.split()), "columns")


def table(tally: Tally, seed: int, real: bool) -> str:
    """Return the outcome as a table of Markdown."""
    formats = sorted({name for name, _ in tally.counts})
    of = f"{tally.total} mutated files, seed {seed}, of made-up {'and recorded ' if real else ''}files"
    lines = [
        f"{of}:",
        "",
        "| outcome | " + " | ".join(formats) + " | all |",
        "| --- |" + " ---: |" * (len(formats) + 1),
    ]
    for key, words in OUTCOMES.items():
        row = [tally.counts[name, key] for name in formats]
        lines.append(f"| {words} | " + " | ".join(map(str, row)) + f" | {sum(row)} |")
    return "\n".join(lines)


def write_page(text: str) -> None:
    """Put the table into docs/records.md between its marks."""
    page = PAGE.read_text(encoding="utf-8")
    parts = runpy.run_path(str(ROOT / "tools" / "pages" / "parts.py"))
    PAGE.write_text(parts["with_text"](page, "fuzz", text), encoding="utf-8")


def main() -> None:
    """Run as the usage says; exit with 1 where there is a defect."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=100_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--keep", type=Path)
    args = parser.parse_args()
    shared = os.environ.get("SEISMASS_SHARED")
    tally = fuzz(args.count, args.seed, Path(shared) if shared else None)
    text = table(tally, args.seed, bool(shared))
    print(text)
    for number, (source, outcome, content) in enumerate(tally.defects):
        print(f"{number}: {source}: {outcome}")
        if args.keep:
            args.keep.mkdir(parents=True, exist_ok=True)
            (args.keep / f"{number}_{source.partition(',')[0]}").write_bytes(content)
    if args.page:
        write_page(text)
    sys.exit(any(key.startswith("defect") for _, key in tally.counts))


if __name__ == "__main__":
    main()
