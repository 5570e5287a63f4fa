"""The performance benchmark: targets and what is measured, growth, and where the instructions go.

Usage: python benchmarks/performance.py [--quick] [--sections NAME ...]. The full benchmark writes docs/performance.md
and its figures in docs/figures; --quick, with small sizes and few repeats, writes the same under out/bench. A part of
the sections is printed and not written.
"""

from __future__ import annotations

import argparse
import importlib
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Final

from environment import summary
from judge import ROOT
from performance_figure import storeys_figure
from performance_page import page, targets_table
from scenes import suite
from targets.base import Section
from targets.gauge import Gauge

SECTIONS: Final = (
    "leapfrog",
    "step",
    "study_time",
    "threads",
    "simd",
    "storeys",
    "million",
    "spectra",
    "start",
    "profile",
)
"""Modules of `targets`, in the order of the page."""


def measure(names: Sequence[str], *, quick: bool) -> dict[str, Section]:
    """Measure section by section, and how busy the machine was between them."""
    gauge = Gauge()
    gauge.read()
    found = {}
    for name in names:
        began = time.perf_counter()
        found[name] = importlib.import_module(f"targets.{name}").section(quick=quick)
        print(f"## {found[name].title} ({time.perf_counter() - began:.0f} s)\n\n{found[name].text}", flush=True)
        for target in found[name].targets:
            print(f"  {target.verdict}: {target.what}: {target.value} (bound {target.bound} {target.unit})", flush=True)
        gauge.read()
    busy = gauge.section([section.title for section in found.values()])
    print(f"## {busy.title}\n\n{busy.text}", flush=True)
    return found | {"busy": busy}


def write(sections: Mapping[str, Section], machine: str, out: Path) -> None:
    """Write the page and its figures."""
    recorded = not any(record.synthetic for record in suite())
    figures = out / "docs" / "figures"
    figures.mkdir(parents=True, exist_ok=True)
    storeys_figure(sections["storeys"].data, figures / "performance_storeys.png")
    (out / "docs" / "performance.md").write_text(page(sections, machine, recorded=recorded), encoding="utf-8")
    print(f"wrote {out / 'docs' / 'performance.md'}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the benchmark and write its results."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--quick", action="store_true", help="small sizes and few repeats; docs stay as they are")
    parser.add_argument("--sections", nargs="+", choices=SECTIONS, help="only these; nothing is written")
    given = parser.parse_args(arguments)
    machine = summary(("numpy", "polars", "eqsig", "pyrotd", "mpmath"), ("rustc", "valgrind"))
    print(machine, flush=True)
    sections = measure(given.sections or SECTIONS, quick=given.quick)
    print(targets_table(target for section in sections.values() for target in section.targets))
    if not given.sections:
        write(sections, machine, ROOT / "out" / "bench" if given.quick else ROOT)
    return 0


if __name__ == "__main__":
    sys.exit(main())
