"""Kill every command that writes at random times, and fill its disk: nothing half written is left under its name.

Usage: tools/killed_commands.py [--kills 2] [--seed 1] [--only NAME ...]. Each command has written once before, with
other options; it is then run again and again into the same place and ended by SIGKILL, SIGTERM or SIGHUP at a random
time, or stopped by a limit for the size of files, as by a full disk. After each the place must be whole: a file by its
bytes, a folder by the digests of its files.json. At the end an undisturbed run must leave nothing beside it. Prints a
table by command and ends with 1 where something was half written. Needs the live page's kernel for `explore`.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGHUP)
PROGRAM = "import sys; from seismass.cli import main; sys.exit(main(sys.argv[1:]))"
SCENE = """
[building]
storeys = 1
period = 0.3
yield_shear_over_weight = 0.2
heights = 3.0
[[blocks]]
floor = 1
mass_ratio = 0.5
mu = 0.2
[motion]
builtin = "synthetic-1"
"""
HAZARD = "Sa (g),annual rate\n0.05,0.05\n0.3,0.002\n1.0,0.0001\n4.0,0.000001\n"


@dataclass(frozen=True)
class Command:
    """A command: its words, those that the earlier run has besides, and the name of what it writes."""

    words: tuple[str, ...]
    earlier: tuple[str, ...]
    out: str


COMMANDS = {
    "building": Command(("building", "b.toml", "--suite", "seven", "--out", "out"), ("--no-figures",), "out"),
    "study": Command(("study", "--out", "out", "--mu", "0.2", "--no-figures"), ("--png",), "out"),
    "campaign": Command(("campaign", "c.toml", "--out", "out"), (), "out"),
    "match": Command(("match", "records", "--iterations", "1", "--out", "out"), ("--scale", "2"), "out"),
    "slip": Command(("slip", "s.toml", "--suite", "seven", "--out", "out"), ("--no-figures",), "out"),
    "fragility": Command(
        (
            *("fragility", "s.toml", "--suite", "seven", "--limit", "drift=0.01", "--out", "out"),
            *("--method", "stripes", "--intensity", "0.5,1"),
        ),
        ("--no-figures",),
        "out",
    ),
    "risk": Command(
        ("risk", "s.toml", "--suite", "seven", "--hazard", "h.csv", "--limit", "drift=0.01", "--out", "out"),
        ("--no-figures",),
        "out",
    ),
    "map": Command(("map", "--suite", "seven", "--mu", "0.2", "--R", "4", "--alpha", "1", "--out", "out"),
                   ("--no-figures",), "out"),
    "evidence": Command(("evidence", "--quick", "--suite", "seven", "--out", "out"), ("--no-figures",), "out"),
    "validate": Command(("validate", "--out", "out"), ("--no-figures",), "out"),
    "run": Command(("run", "s.toml", "--out", "x.csv"), (), "x.csv"),
    "scale": Command(("scale", "--suite", "seven", "--period", "0.5", "--out", "x.csv"), ("--sds", "1"), "x.csv"),
    "target": Command(("target", "ec8:1:C:0.3", "--out", "x.csv"), ("--period", "1"), "x.csv"),
    "explore": Command(("explore", "--out", "x.html"), (), "x.html"),
    "animate": Command(("animate", "s.toml", "--out", "x.gif", "--fps", "4"), ("--speed", "2"), "x.gif"),
    "report": Command(("report", "out"), (), "out"),
}  # fmt: skip


def state(path: Path) -> str:
    """What is in a place, as a digest; what is half written is said."""
    if not path.exists():
        return "nothing"
    if path.is_file():
        return hashlib.sha256(path.read_bytes()).hexdigest()
    listed = path / "files.json"
    if not listed.is_file():  # a campaign: its own manifest, and parts with digests of themselves
        names = sorted(each.relative_to(path).as_posix() for each in path.rglob("*.parquet"))
        return "campaign " + " ".join(names) if (path / "manifest.json").is_file() or not names else "half: no manifest"
    document = json.loads(listed.read_text("utf-8"))
    there = {each.name for each in path.iterdir()} - {"files.json"}
    if there != set(document["sha256"]):
        return f"half: {sorted(there ^ set(document['sha256']))}"
    for name, sha256 in document["sha256"].items():
        if hashlib.sha256((path / name).read_bytes()).hexdigest() != sha256 and name != "report.html":
            return f"half: {name}"
    return document["sha256_of_list"]


def started(words: tuple[str, ...], place: Path, most: int | None = None) -> subprocess.Popen[bytes]:
    """Start a command in a folder; no file may be larger than `most` bytes."""

    def before() -> None:
        signal.signal(signal.SIGHUP, signal.SIG_DFL)  # nohup has it ignored
        if most is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))

    return subprocess.Popen(
        [sys.executable, "-W", "ignore", "-c", PROGRAM, *words],
        cwd=place,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        preexec_fn=before,
    )


def prepared(place: Path) -> None:
    """Write what the commands read."""
    import seismass as sm
    from seismass.assessment.building_file import example_file
    from seismass.studies.campaign.folder import example_description

    (place / "b.toml").write_bytes(example_file().read_bytes())
    (place / "c.toml").write_bytes(example_description().read_bytes())
    (place / "s.toml").write_text(SCENE)
    (place / "h.csv").write_text(HAZARD)
    (place / "records").mkdir()
    for record in sm.builtin_suite("seven")[:2]:
        rows = "\n".join(f"{value / 9.80665:.6e}" for value in record.acceleration[:1500])
        head = f"A\n{record.event}\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 1500, DT= {record.dt} SEC\n"
        (place / "records" / f"{record.name}.AT2").write_text(head + rows + "\n")


def tried(command: Command, place: Path, kills: int, rng: random.Random) -> tuple[Counter[str], list[str]]:
    """Kill a command; return what became of it, and what was half written."""
    counts: Counter[str] = Counter()
    faults = []
    out = place / command.out
    began = time.monotonic()
    child = started((*command.words, *command.earlier), place)
    said = child.communicate()[1].decode(errors="replace")
    length = time.monotonic() - began
    if child.returncode not in (0, 1):
        return counts, [f"the earlier run: {child.returncode} {said}"]
    before = state(out)
    for number in range(2 * kills):
        full = number >= kills
        most = rng.choice((0, 100, 2000, 20_000, 100_000)) if full else None
        child = started(command.words, place, most)
        if not full:
            time.sleep(rng.uniform(0.3, 1.3) * length)
            child.send_signal(SIGNALS[number % len(SIGNALS)])
        said = child.communicate()[1].decode(errors="replace")
        now = state(out)
        if now.startswith("half") or now == "nothing" != before:
            faults.append(f"{'full disk' if full else SIGNALS[number % 3].name}: {now}")
        if (full and child.returncode not in (0, 1, 2, -signal.SIGXFSZ)) or "Traceback" in said:
            faults.append(f"full disk: {child.returncode} {said[-300:]}")
        counts["as before" if now == before else "new"] += 1
    child = started(command.words, place)
    said = child.communicate()[1].decode(errors="replace")
    left = [path.name for path in place.iterdir() if path.name.startswith(".seismass-")]
    if child.returncode not in (0, 1) or state(out).startswith(("half", "nothing")) or left:
        faults.append(f"afterwards: {child.returncode} {state(out)[:200]} {left} {said[-300:]}")
    return counts, faults


def main() -> int:
    """Try all, print the table, and return 1 where something was half written."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--kills", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", nargs="+", choices=tuple(COMMANDS), default=list(COMMANDS))
    args = parser.parse_args()
    rng = random.Random(args.seed)
    bad = 0
    print("| command | killed | full disk | as before | whole and new | half written |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    os.environ["MPLBACKEND"] = "Agg"
    for name in args.only:
        with tempfile.TemporaryDirectory() as folder:
            place = Path(folder)
            prepared(place)
            if name == "report":
                started(("building", "b.toml", "--suite", "seven", "--out", "out"), place).communicate()
            counts, faults = tried(COMMANDS[name], place, args.kills, rng)
        bad += len(faults)
        row = (args.kills, args.kills, counts["as before"], counts["new"], len(faults))
        print(f"| `{name}` | {' | '.join(map(str, row))} |", flush=True)
        for fault in faults:
            print(f"{name}: {fault}", file=sys.stderr)
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
