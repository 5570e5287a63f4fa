"""Read files that ask for memory or time without end, each in a process of its own, and print what became of each.

Usage: tools/hostile_files.py [--only WORDS]. Each file is at or beyond a limit of seismass/base/limits.py. The table
has its size, memory that reading it took beyond the program itself, processor time, and the error, which is one line.
It ends with 1 where one takes more than MOST_MB or MOST_SECONDS, or ends in an exception that is not the package's.
"""

from __future__ import annotations

import argparse
import io
import json
import resource
import subprocess
import sys
import tempfile
import time
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

MOST_MB, MOST_SECONDS = 1024, 30.0
MB = 2**20
ROW = b'<row r="%d"><c r="%s" t="inlineStr"><is><t>%s</t></is></c></row>'
SCENE = """
[building]
storeys = 1
period = 0.3
[[racks]]
floor = 1
levels = %s
level_mass_ratio = 0.1
period = 0.5
[motion]
acceleration = [0.1, 0.2]
dt = 0.1
"""


def archive(members: dict[str, bytes | int]) -> bytes:
    """Return an archive; a number stands for so many zeros."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, member in members.items():
            with packed.open(name, "w", force_zip64=True) as file:
                if isinstance(member, bytes):
                    file.write(member)
                else:
                    for _ in range(member // MB):
                        file.write(b"0" * MB)
    return content.getvalue()


def workbook(sheet: bytes | int) -> bytes:
    """Return a workbook of one sheet."""
    return archive(
        {
            "xl/_rels/workbook.xml.rels": b'<R><L Id="r" Target="worksheets/a.xml"/></R>',
            "xl/workbook.xml": b'<w xmlns:r="q"><sheets><sheet name="A" r:id="r"/></sheets></w>',
            "xl/worksheets/a.xml": sheet,
        }
    )


def rows(*cells: tuple[int, bytes, bytes]) -> bytes:
    """Return a sheet of rows with one cell each: number, place and text."""
    return b"<worksheet><sheetData>" + b"".join(ROW % cell for cell in cells) + b"</sheetData></worksheet>"


def whole(piece: bytes, size: int, head: bytes = b"", tail: bytes = b"") -> bytes:
    """Return a file of a size, of one piece again and again."""
    return head + piece * ((size - len(head) - len(tail)) // len(piece)) + tail


HEAD = b"Story,Height (m),Mass (t)\n"
FILES: dict[str, tuple[str, Callable[[], bytes]]] = {
    "storey table, a cell far away": (
        "t.xlsx",
        lambda: workbook(rows((1, b"A1", b"Story"), (2**20, b"XFD1048576", b"x"))),
    ),
    "storey table, a workbook of 1 GB": ("t.xlsx", lambda: workbook(1024 * MB)),
    "storey table, a workbook of entities": ("t.xlsx", lambda: workbook(b"<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>")),
    "storey table, 200 000 columns": ("t.csv", lambda: HEAD.strip() + b"," * 200_000 + b"\n" + b"L,3,1\n" * 20_000),
    "storey table, 16 MB of commas": ("t.csv", lambda: whole(b",", 16 * MB, HEAD)),
    "storey table, 16 MB of rows": ("t.csv", lambda: whole(b"a\n", 16 * MB, HEAD)),
    "storey table, a cell of 16 MB": ("t.csv", lambda: whole(b"a", 16 * MB, HEAD)),
    "storey table, 16 MB of KEY=value": ("t.s2k", lambda: whole(b"A=1 ", 16 * MB, b'TABLE:  "STORY"\n')),
    "pushover curve, 16 MB of rows": ("p.csv", lambda: whole(b"1,2\n", 16 * MB, b"Roof Drift (mm),Base Shear (kN)\n")),
    "target spectrum, 16 MB of rows": ("target.csv", lambda: whole(b"1\n", 16 * MB, b"period (s),Sa (g)\n")),
    "target spectrum, 16 MB of commas": ("target.csv", lambda: whole(b",", 16 * MB, b"period (s),Sa (g)\n")),
    "hazard curve, 16 MB of rows": ("hazard.csv", lambda: whole(b"1\n", 16 * MB, b"Sa (g),annual rate\n")),
    "list of records, 16 MB of rows": ("suite.csv", lambda: whole(b"1\n", 16 * MB, b"file,dt\n")),
    "scene, 32 MB of objects": ("s.json", lambda: whole(b"{},", 32 * MB, b'{"a": [', b"{}]}")),
    "scene, 32 MB of texts": ("s.json", lambda: whole(b'"",', 32 * MB, b'{"a": [', b'""]}')),
    "scene, 32 MB of numbers": ("s.json", lambda: whole(b"1.5,", 32 * MB, b'{"a": [', b"1]}")),
    "scene, 32 MB of brackets": ("s.json", lambda: whole(b"[", 32 * MB)),
    "scene, 33 MB": ("s.json", lambda: whole(b" ", 33 * MB)),
    "scene, 4 MB of TOML": ("s.toml", lambda: whole(b"{},", 4 * MB - 1, b"a = [", b"{}]")),
    "scene, a rack of a milliard levels": ("s.toml", lambda: (SCENE % 10**9).encode()),
    "scene, a name of a million letters": ("s.toml", lambda: (f'name = "{"n" * 10**6}"' + SCENE % 2).encode()),
    "campaign, an axis of 1e12 values": (
        "campaign.json",
        lambda: json.dumps(
            {
                "motions": {"builtin": "seven"},
                "grid": {"storeys": 1, "mass_ratio": 1.0, "mu": {"from": 0.1, "to": 0.5, "count": 10**12}},
            }
        ).encode(),
    ),
    "record, 24 MB of one column": ("r.txt", lambda: whole(b"1\n", 24 * MB - 1, b"acceleration (m/s2), dt = 0.01 s\n")),
    "record, 2 000 000 rows": ("r.txt", lambda: b"acceleration (m/s2), dt = 0.01 s\n" + b"0.1\n" * 1_900_000),
    "record, 24 MB of rows of a hundred": (
        "r.txt",
        lambda: whole(b"1 " * 100 + b"\n", 24 * MB - 1, b"m/s2, dt = 0.01 s\n"),
    ),
    "record, 25 MB": ("r.txt", lambda: whole(b"1\n", 25 * MB)),
    "archive of a member of 2 GB": ("a.zip", lambda: archive({"a.AT2": 2048 * MB})),
    "archive of 12 members of 96 MB": ("a.zip", lambda: archive({f"{number}.AT2": 96 * MB for number in range(12)})),
    "archive of 5001 members": ("a.zip", lambda: archive({f"{number}.AT2": b"1" for number in range(5001)})),
    "archive of archives": ("a.zip", lambda: archive({f"{n}.zip": archive({"a.AT2": 200 * MB}) for n in range(9)})),
}
"""Name of each, the file, and what makes it."""


def reader(name: str) -> Callable[[Path], Any]:
    """Return what reads a file of this name."""
    import seismass as sm
    from seismass.assessment import read_pushover, read_storey_table

    kind = name.split(",")[0].split(" of ")[0]
    return {
        "storey table": read_storey_table,
        "pushover curve": read_pushover,
        "target spectrum": sm.TargetSpectrum.from_csv,
        "hazard curve": sm.risk.HazardCurve.from_csv,
        "list": sm.read_suite,
        "scene": sm.read_scene,
        "campaign": sm.campaign.read_campaign,
        "record": sm.read_record,
        "archive": sm.read_suite,
    }[kind]


def child(name: str, path: Path) -> None:
    """Read a file; print memory (MB), time (s) and the outcome."""
    import seismass as sm

    read = reader(name)
    small = path.with_name("small.csv")
    for each in (sm.TargetSpectrum.from_csv, sm.read_suite):  # what is imported for it is not its memory
        try:
            small.write_text("period (s),Sa (g)\n0.1,1\n1,0.5\n")
            each(small)
        except sm.SeismassError:
            pass
    before, began = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.process_time()
    try:
        read(path)
        outcome = "read"
    except (sm.SeismassError, OSError) as error:
        outcome = str(error)
    grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024.0
    print(json.dumps([grown, time.process_time() - began, outcome]))


def tried(name: str, place: Path) -> tuple[int, float, float, str]:
    """Return size (bytes), memory (MB), time (s) and outcome of a file, read by another process."""
    file, make = FILES[name]
    path = place / file
    path.write_bytes(make())
    command = [sys.executable, "-W", "ignore", __file__, "--child", name, str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    size = path.stat().st_size
    path.unlink()
    if done.returncode:
        return size, 0.0, 0.0, f"defect: {done.stderr.strip().splitlines()[-1:] or done.returncode}"
    grown, seconds, outcome = json.loads(done.stdout)
    if grown > MOST_MB or seconds > MOST_SECONDS or "\n" in outcome or len(outcome) > 500:
        outcome = f"defect: {outcome[:200]}"
    return size, grown, seconds, outcome


def main() -> int:
    """Read every file, print the table, and return 1 where one is not refused or read as it should be."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="")
    parser.add_argument("--child", nargs=2, metavar=("NAME", "FILE"))
    args = parser.parse_args()
    if args.child:
        child(args.child[0], Path(args.child[1]))
        return 0
    bad = 0
    print("| file | size | memory | time | outcome |\n| --- | ---: | ---: | ---: | --- |")
    with tempfile.TemporaryDirectory() as place:
        for name in FILES:
            if args.only in name:
                size, grown, seconds, outcome = tried(name, Path(place))
                bad += outcome.startswith("defect")
                words = outcome.replace("|", " ").replace(f"{place}/", "").replace(place, "")
                shown = f"{size / MB:.0f} MB" if size >= MB else f"{size / 1024:.0f} kB"
                print(f"| {name} | {shown} | {grown:.0f} MB | {seconds:.1f} s | {words} |", flush=True)
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
