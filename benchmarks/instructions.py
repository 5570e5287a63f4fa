"""Instructions that the kernel executes, counted by valgrind: per plain step, per event, per regime, per run.

Usage: python benchmarks/instructions.py [--label LABEL] [--tolerance PERCENT] [--all]. Prints the counts beside those
last recorded in benchmarks/results/instructions.csv, and fails where one has grown by more than the tolerance; under a
label, appends them there instead. Counts do not depend on the machine's load, so a change of one per cent is a change
of the code, or of the tools. Valgrind knows no AVX-512: it runs the path for AVX2.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Final

import polars as pl

from environment import program_versions

ROOT: Final = Path(__file__).resolve().parent.parent
RECORDED: Final = ROOT / "benchmarks" / "results" / "instructions.csv"
SCHEMA: Final = {
    "label": pl.String,
    "scene": pl.String,
    "quantity": pl.String,
    "value": pl.Float64,
    "tools": pl.String,
}
"""Columns; `tools`, the versions of compiler and valgrind, are not known of the first labels."""
NOW: Final = "now"
TOLERANCE: Final = 1.0
"""Per cent by which a count may grow."""

YIELDING: Final = "yielding, 4 storeys"
SECTION4: Final = ("section 4, r2 = 0.05", "section 4, r2 = 0.5")
STEPPED: Final = (
    YIELDING,
    "yielding, 5 storeys",
    "128 blocks, 4 storeys",
    *SECTION4,
    "sliding, 3 storeys",
    "rayleigh, 12 storeys",
)
"""Scenes solved by plain steps and events, of crates/seismass-bench/benches/common."""
WHOLE: Final = ("elastic, 4 storeys", "rayleigh, 100 storeys")
"""Scenes of which the run as a whole is counted: without events, and without plain steps."""
OTHER: Final = (
    ("histories", YIELDING),
    *(("histories", scene) for scene in SECTION4),
    *(("leapfrog", scene) for scene in SECTION4),
    ("spectrum", "plain, 4 storeys"),
)
STEP: Final = "per plain step"
EVENT: Final = "per event"
REGIME: Final = "per regime"
RUN: Final = "per run"
SAMPLE: Final = "per sample"
QUANTITIES: Final = f"""{STEP}: what a run without events costs more when its motion goes on, over its samples.
{REGIME}: twice a run less the batch of the run and its mirror image, which finds all regimes known; over its regimes.
{EVENT}: all that is neither a plain step nor a regime (setting up and looking at peaks included), over the events.
"""


class Missing(Exception):
    """A program that counting needs is not installed."""


@dataclass(frozen=True)
class Count:
    """Instructions of a piece of work, and what it did."""

    instructions: int
    done: dict[str, int]


@cache
def program() -> Path:
    """Build the work to be counted, crates/seismass-bench/benches/count.rs, and return where it is."""
    if shutil.which("valgrind") is None:
        raise Missing("valgrind is not installed: no instruction is counted")
    cargo = os.environ.get("CARGO", "cargo")
    options = ("--locked", "--quiet", "--no-run", "-p", "seismass-bench", "--bench", "count", "--message-format=json")
    built = subprocess.run([cargo, "bench", *options], cwd=ROOT, check=True, capture_output=True, text=True)
    found = [json.loads(line).get("executable") for line in built.stdout.splitlines() if line.startswith("{")]
    return Path(next(path for path in reversed(found) if path))


def profile(work: str, scene: str, out: Path) -> Count:
    """Count a piece of work; its profile is left in a file."""
    if "SEISMASS_INSTRUCTIONS" in os.environ:
        raise Missing("SEISMASS_INSTRUCTIONS must not be set: counts are recorded for the path that valgrind takes")
    collect = ("--collect-atstart=no", "--toggle-collect=*counted*", f"--callgrind-out-file={out}")
    command = ["valgrind", "--quiet", "--tool=callgrind", *collect, str(program()), work, scene]
    ran = subprocess.run(command, check=False, capture_output=True, text=True)
    if ran.returncode == -signal.SIGILL:
        raise Missing("valgrind does not know an instruction of the kernel: 3.24 does, 3.19 does not")
    ran.check_returncode()
    done = {name: int(value) for name, value in (line.split() for line in ran.stdout.splitlines())}
    total = re.search(r"^(?:summary|totals):\s*(\d+)", out.read_text(), re.MULTILINE)
    if total is None or int(total.group(1)) == 0:
        raise RuntimeError(f"callgrind counted nothing of {work}, {scene}: it does not find the function counted")
    return Count(int(total.group(1)), done)


def _count(work: str, scene: str) -> Count:
    with tempfile.TemporaryDirectory() as folder:
        return profile(work, scene, Path(folder) / "callgrind.out")


def _stepped(scene: str) -> Iterable[tuple[str, float]]:
    run, mirrored = _count("run", scene), _count("mirrored", scene)
    calm, continued = _count("calm", scene), _count("continued", scene)
    if calm.done["events"] or calm.done["series_steps"] != continued.done["series_steps"]:
        raise RuntimeError(f"the calm run of {scene} has events, or its continuation is not all plain steps")
    steps = continued.done["plain_steps"] - calm.done["plain_steps"]
    step = (continued.instructions - calm.instructions) / steps
    regimes = 2 * run.instructions - mirrored.instructions
    rest = run.instructions - regimes - step * run.done["plain_steps"]
    yield STEP, step
    yield EVENT, rest / run.done["events"]
    yield REGIME, regimes / run.done["regimes"]
    yield RUN, run.instructions
    for name in ("plain_steps", "series_steps", "events", "regimes"):
        yield name.replace("_", " "), run.done[name]


def measured() -> pl.DataFrame:
    """Count everything, under the label NOW."""
    rows: list[tuple[str, str, float]] = []
    for scene in STEPPED:
        rows += [(scene, name, value) for name, value in _stepped(scene)]
    for scene in WHOLE:
        count = _count("run", scene)
        rows += [(scene, RUN, count.instructions), (scene, SAMPLE, count.instructions / count.done["samples"])]
    for work, scene in OTHER:
        count = _count(work, scene)
        if work == "spectrum":
            pairs = count.done["oscillators"] * count.done["samples"]
            rows.append(("spectrum", "per oscillator and sample", count.instructions / pairs))
        else:
            rows.append((f"{scene}, {work}", RUN, count.instructions))
            rows.append((f"{scene}, {work}", SAMPLE, count.instructions / count.done["samples"]))
    tools = ", ".join(f"{name} {version}" for name, version in program_versions("rustc", "valgrind").items())
    return pl.DataFrame([(NOW, *row, tools) for row in rows], schema=SCHEMA, orient="row")


def recorded() -> pl.DataFrame:
    """Return what was recorded under labels, in order of recording."""
    empty = pl.DataFrame(schema=SCHEMA)
    if not RECORDED.exists():
        return empty
    return pl.concat([empty, pl.read_csv(RECORDED, schema_overrides=SCHEMA)], how="diagonal")


def record(counts: pl.DataFrame, label: str) -> None:
    """Append counts under a label."""
    table = recorded()
    if label in table["label"]:
        raise ValueError(f"label must be new; got {label}, which {RECORDED.name} has")
    RECORDED.parent.mkdir(parents=True, exist_ok=True)
    unfinished = RECORDED.with_suffix(".part")
    rounded = counts.with_columns(label=pl.lit(label), value=pl.col("value").round(1))
    pl.concat([table, rounded]).write_csv(unfinished)
    unfinished.rename(RECORDED)


def growth(table: pl.DataFrame) -> dict[tuple[str, str], float]:
    """Return the counts of the last label over those of the label before it, by scene and quantity."""
    *before, last = table["label"].unique(maintain_order=True)
    if not before:
        return {}
    old, new = (
        {(scene, quantity): value for _, scene, quantity, value, _ in table.filter(label=label).iter_rows()}
        for label in (before[-1], last)
    )
    return {key: value / old[key] for key, value in new.items() if old.get(key)}


def comparison(table: pl.DataFrame, *, every: bool = False) -> str:
    """Return the last two labels, or every one, side by side in columns, and the last over the one before it."""
    labels = table["label"].unique(maintain_order=True).to_list()
    table = table if every else table.filter(pl.col("label").is_in(labels[-2:]))
    told = table.unique("label", maintain_order=True).select("label", "tools").rows()
    letters = {label: chr(ord("A") + place) for place, (label, _) in enumerate(told)}
    lines = [f"{letters[label]}: {label}{f' ({tools})' if tools else ''}" for label, tools in told]
    head = "".join(f"{letter:>15}" for letter in letters.values())
    lines.append(f"{'':40}{'':26}{head}{'last / before':>14}")
    grown = growth(table)
    for scene, quantity in table.select("scene", "quantity").unique(maintain_order=True).iter_rows():
        found = dict(table.filter(scene=scene, quantity=quantity).select("label", "value").iter_rows())
        cells = "".join(f"{f'{found[label]:,.1f}' if label in found else '-':>15}" for label in letters)
        ratio = f"{grown[scene, quantity]:14.3f}" if (scene, quantity) in grown else ""
        lines.append(f"{scene:40}{quantity:26}{cells}{ratio}")
    return "\n".join(lines)


def worse(table: pl.DataFrame, tolerance: float) -> list[str]:
    """Return what the last label has more of than the one before it, by more than so many per cent."""
    return [
        f"{scene}, {quantity}: {100.0 * (ratio - 1.0):+.1f} %"
        for (scene, quantity), ratio in growth(table).items()
        if quantity.startswith("per ") and ratio > 1.0 + 0.01 * tolerance
    ]


def main() -> int:
    """Count and print; record if a label is given, otherwise judge."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--label", help="record the counts under this name")
    parser.add_argument(
        "--tolerance", type=float, default=TOLERANCE, metavar="PERCENT", help="growth that is no failure: %(default)g"
    )
    parser.add_argument("--all", action="store_true", help="print what was recorded under every label")
    given = parser.parse_args()
    try:
        counts = measured()
    except Missing as missing:
        print(missing, file=sys.stderr)
        return 1
    print("Instructions, by callgrind on the path for AVX2 (valgrind knows no AVX-512).")
    print(QUANTITIES)
    table = pl.concat([recorded(), counts])
    print(comparison(table, every=given.all))
    if given.label:
        record(counts, given.label)
        print(f"recorded as {given.label!r} in {RECORDED.relative_to(ROOT)}")
        return 0
    grown = worse(table, given.tolerance)
    for line in grown:
        print(f"grown by more than {given.tolerance:g} %: {line}", file=sys.stderr)
    return 1 if grown else 0


if __name__ == "__main__":
    sys.exit(main())
