"""Instructions that the kernel executes, counted by valgrind: per plain step, per event, per regime, per run.

Usage: python benchmarks/instructions.py [--label LABEL]. Prints the counts beside those recorded in
benchmarks/results/instructions.csv, and appends them there under a label. Counts do not depend on the machine's load,
so a change of one per cent is a change of the code. Valgrind knows no AVX-512: it runs the path for AVX2.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Final

import polars as pl

ROOT: Final = Path(__file__).resolve().parent.parent
RECORDED: Final = ROOT / "benchmarks" / "results" / "instructions.csv"
SCHEMA: Final = {"label": pl.String, "scene": pl.String, "quantity": pl.String, "value": pl.Float64}
NOW: Final = "now"

YIELDING: Final = "yielding, 4 storeys"
SECTION4: Final = ("section 4, r2 = 0.05", "section 4, r2 = 0.5")
STEPPED: Final = (YIELDING, *SECTION4, "sliding, 3 storeys", "rayleigh, 12 storeys")
"""Scenes solved by plain steps and events, of crates/seismass/benches/common."""
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
    """Build the work to be counted, crates/seismass/benches/count.rs, and return where it is."""
    if shutil.which("valgrind") is None:
        raise Missing("valgrind is not installed: no instruction is counted")
    cargo = os.environ.get("CARGO", "cargo")
    options = ("--locked", "--quiet", "--no-run", "-p", "seismass", "--bench", "count", "--message-format=json")
    built = subprocess.run([cargo, "bench", *options], cwd=ROOT, check=True, capture_output=True, text=True)
    found = [json.loads(line).get("executable") for line in built.stdout.splitlines() if line.startswith("{")]
    return Path(next(path for path in reversed(found) if path))


def profile(work: str, scene: str, out: Path) -> Count:
    """Count a piece of work; its profile is left in a file."""
    if "SEISMASS_INSTRUCTIONS" in os.environ:
        raise Missing("SEISMASS_INSTRUCTIONS must not be set: counts are recorded for the path that valgrind takes")
    collect = ("--collect-atstart=no", "--toggle-collect=*counted*", f"--callgrind-out-file={out}")
    command = ["valgrind", "--quiet", "--tool=callgrind", *collect, str(program()), work, scene]
    ran = subprocess.run(command, check=True, capture_output=True, text=True)
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
    """Count everything; columns label (NOW), scene, quantity, value."""
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
    return pl.DataFrame([(NOW, *row) for row in rows], schema=SCHEMA, orient="row")


def recorded() -> pl.DataFrame:
    """Return what was recorded under labels, in order of recording."""
    return pl.read_csv(RECORDED, schema=SCHEMA) if RECORDED.exists() else pl.DataFrame(schema=SCHEMA)


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


def comparison(table: pl.DataFrame) -> str:
    """Return counts side by side, a column per label, and the last over the first."""
    labels = table["label"].unique(maintain_order=True).to_list()
    lines = [f"{letter}: {label}" for letter, label in zip(_letters(labels), labels, strict=True)]
    head = "".join(f"{letter:>15}" for letter in _letters(labels))
    lines.append(f"{'':40}{'':26}{head}{'last / first':>14}")
    for scene, quantity in table.select("scene", "quantity").unique(maintain_order=True).iter_rows():
        rows = table.filter((pl.col("scene") == scene) & (pl.col("quantity") == quantity))
        found = dict(rows.select("label", "value").iter_rows())
        values = [found.get(label) for label in labels]
        known = [value for value in values if value is not None]
        cells = "".join(f"{'-' if value is None else f'{value:,.1f}':>15}" for value in values)
        ratio = f"{known[-1] / known[0]:14.3f}" if len(known) > 1 and known[0] else ""
        lines.append(f"{scene:40}{quantity:26}{cells}{ratio}")
    return "\n".join(lines)


def _letters(labels: list[str]) -> list[str]:
    return [chr(ord("A") + place) for place in range(len(labels))]


def main() -> int:
    """Count, print, and record if a label is given."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--label", help="record the counts under this name")
    label = parser.parse_args().label
    try:
        counts = measured()
    except Missing as missing:
        print(missing, file=sys.stderr)
        return 1
    print("Instructions, by callgrind on the path for AVX2 (valgrind knows no AVX-512).")
    print(QUANTITIES)
    print(comparison(pl.concat([recorded(), counts])))
    if label:
        record(counts, label)
        print(f"recorded as {label!r} in {RECORDED.relative_to(ROOT)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
