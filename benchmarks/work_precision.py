"""The work-precision benchmark: time of a run against its error, beside the peers.

Usage: python benchmarks/work_precision.py [--quick] [--contestants NAME ...] [--scenes NAME ...]. The full benchmark
writes docs/work_precision.md, its figures in docs/figures and all points in benchmarks/results; --quick writes the same
under out/bench. A part of the contestants or scenes is printed and not written.
"""

from __future__ import annotations

import argparse
import importlib
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

import polars as pl

from contestants.base import EVERYWHERE, Setting
from environment import summary
from figure import main_figure, scenes_figure
from judge import ROOT, Reference, reference
from measure import ERRORS, FULL, QUICK, measure
from page import page
from scenes import BenchmarkScene, scenes

CONTESTANTS: Final = (
    "exact",
    "reference",
    "numba_leapfrog",
    "opensees",
    "heyoka_taylor",
    "diffsol_tsit45",
    "scipy_events",
    "scipy_regularised",
)
SCHEMA: Final[dict[str, Any]] = {
    "scene": pl.String,
    "family": pl.String,
    "setting": pl.String,
    "status": pl.String,
    "reason": pl.String,
    "time": pl.Float64,
    "repeats": pl.Int64,
    **dict.fromkeys(ERRORS, pl.Float64),
}


def settings(contestants: Sequence[str] = CONTESTANTS, *, quick: bool) -> list[Setting]:
    """Return the settings of contestants."""
    modules = (importlib.import_module(f"contestants.{name}") for name in contestants)
    return [setting for module in modules for setting in module.settings() if setting.quick or not quick]


def line(row: dict[str, Any]) -> str:
    """Return a row as one line of the log."""
    spent = "-" if row["time"] is None else f"{1e3 * row['time']:.3f} ms"
    found = "  ".join("-" if row[name] is None else f"{row[name]:.1e}" for name in ERRORS)
    told = row["reason"] if row["status"] != "ok" else found
    return f"  {row['family']:34} {row['setting']:26} {spent:>14}  {told}"


def run(
    benches: list[BenchmarkScene], references: dict[str, Reference], chosen: list[Setting], *, quick: bool
) -> pl.DataFrame:
    """Measure the chosen settings, scene by scene."""
    rows = []
    for bench in benches:
        print(f"{bench.title}; {bench.motion_name}; {references[bench.name].events} events", flush=True)
        for setting in chosen:
            if bench.name in setting.scenes:
                rows.append(measure(setting, bench, references[bench.name], QUICK if quick else FULL))
                print(line(rows[-1]), flush=True)
    return pl.DataFrame(rows, schema=SCHEMA)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the benchmark and write its results."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--quick", action="store_true", help="fewer settings and repeats; docs stay as they are")
    for option, names in (("--contestants", CONTESTANTS), ("--scenes", EVERYWHERE)):
        parser.add_argument(option, nargs="+", metavar="NAME", choices=names, help=f"only these of {', '.join(names)}")
    given = parser.parse_args(arguments)
    began = time.perf_counter()
    machine = summary()
    print(machine, flush=True)
    benches = [bench for bench in scenes() if given.scenes is None or bench.name in given.scenes]
    references = {bench.name: reference(bench) for bench in benches}
    table = run(benches, references, settings(given.contestants or CONTESTANTS, quick=given.quick), quick=given.quick)
    if given.contestants is None and given.scenes is None:
        write(table, benches, references, machine, ROOT / "out" / "bench" if given.quick else ROOT)
    print(f"{len(table)} points in {time.perf_counter() - began:.0f} s")
    return 0


def write(
    table: pl.DataFrame, benches: list[BenchmarkScene], references: dict[str, Reference], machine: str, out: Path
) -> None:
    """Write the points, the figures and the page."""
    results, docs = out / "benchmarks" / "results", out / "docs"
    for folder in (results, docs / "figures"):
        folder.mkdir(parents=True, exist_ok=True)
    table.write_parquet(results / "work_precision.parquet")
    main_figure(table, benches[0], docs / "figures" / "work_precision.png")
    scenes_figure(table, benches, docs / "figures" / "work_precision_scenes.png")
    (docs / "work_precision.md").write_text(page(table, benches, references, machine), encoding="utf-8")
    print(f"wrote {docs / 'work_precision.md'}")


if __name__ == "__main__":
    sys.exit(main())
