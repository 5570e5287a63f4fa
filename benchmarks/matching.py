"""Spectral matching beside reqpy-M: misfit by exact spectra, drift and times, for the seven records.

Usage: SEISMASS_SHARED=... python benchmarks/matching.py [--quick]; writes its table into docs/matching.md, the quick
one prints that of one record.
"""

from __future__ import annotations

import argparse
import importlib
import importlib.metadata
import logging
import os
import sys
import time
from pathlib import Path
from typing import Any, Final

import numpy as np

import seismass as sm
from environment import cpu, page_module
from scenes import FloatArray

RANGE: Final = (0.2, 1.5)
SHARE: Final = 0.05
"""Share of the range by which that of reqpy-M is wider, whose periods do not fall on its ends."""

Row = tuple[str, ...]


def measured(name: str, record: sm.Record, periods: FloatArray, target: FloatArray, taken: float) -> Row:
    """One row of the table, of a matched record."""
    ratios = sm.response_spectrum(record, periods)[0] / target
    rms = float(np.sqrt(np.mean((ratios - 1.0) ** 2)))
    return (
        name,
        f"{ratios.min():.3f} to {ratios.max():.3f}",
        f"{100.0 * rms:.2f}",
        f"{record.pgv:.3f}",
        f"{record.pgd:.3f}",
        f"{record.velocity[-1]:+.1e}",
        f"{record.displacement[-1]:+.1e}",
        f"{taken:.1f}",
    )


def ours(record: sm.Record, target: sm.TargetSpectrum) -> tuple[sm.Record, float]:
    began = time.process_time()
    matched = sm.matching.match_spectrum(record, target, periods=RANGE, threads=1)
    return matched.record, time.process_time() - began


def with_reqpy(record: sm.Record, target: sm.TargetSpectrum) -> tuple[sm.Record, float]:
    """Its own baseline correction with a displacement of zero at the end, everything else as it is set."""
    reqpy: Any = importlib.import_module("reqpy_M")
    logging.disable(logging.WARNING)
    at = np.geomspace(0.02, 10.0, 400)
    began = time.process_time()
    found = reqpy.generate_single_component_compatible_record(
        record.acceleration / sm.STANDARD_GRAVITY,
        1.0 / record.dt,
        at,
        target(at) / sm.STANDARD_GRAVITY,
        targetPSAlimits=(1.0 - SHARE, 1.0 + SHARE),
        T1PSA=RANGE[0] * (1.0 - SHARE),
        T2PSA=RANGE[1] * (1.0 + SHARE),
    )
    taken = time.process_time() - began
    samples = np.asarray(found["sc"], dtype=np.float64) * sm.STANDARD_GRAVITY
    return sm.Record(samples, record.dt), taken


def text(shared: Path, *, quick: bool) -> str:
    """Return the section of the page."""
    records = list(sm.read_suite(shared / "records" / "paper_seven.csv"))
    records = records[1:2] if quick else records
    target = sm.TargetSpectrum.asce7()
    periods = np.geomspace(*RANGE, 500)
    ordinates = target(periods)
    rows: list[Row] = []
    for number, record in enumerate(records, start=1):
        for name, match in (("seismass", ours), ("reqpy-M", with_reqpy)):
            try:
                if name == "reqpy-M" and number == 1:
                    match(record, target)  # compiles
                rows.append((record.station, *measured(name, *_spread(match, record, target, periods, ordinates))))
            except ImportError as missing:
                rows.append((record.station, f"{name}: absent ({missing})", *[""] * 7))
    heads = "record | program | over the target | rms (%) | PGV (m/s) | PGD (m) | end (m/s) | end (m) | time (s)"
    table = page_module("parts").table(heads, rows, 1)
    try:
        version = importlib.metadata.version("reqpy-M")
    except importlib.metadata.PackageNotFoundError:
        version = "absent"
    return (
        f"reqpy-M {version} (continuous wavelets, 300 scales, 30 passes, its baseline correction of sixth order) "
        f"beside seismass\n{sm.__version__}, both from {RANGE[0]:g} to {RANGE[1]:g} s at 5 % damping; ratios to the "
        f"target by exact spectra at {len(periods)} periods, velocity\nand displacement at the end of the "
        f"record, processor time.\n\n"
        f"{table}\n\n"
        f"{cpu()}; Python {sys.version.split()[0]}, numpy {np.__version__}."
    )


def _spread(
    match: Any, record: sm.Record, target: sm.TargetSpectrum, periods: FloatArray, ordinates: FloatArray
) -> tuple[sm.Record, FloatArray, FloatArray, float]:
    matched, taken = match(record, target)
    return matched, periods, ordinates, taken


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="one record, printed")
    arguments = parser.parse_args()
    folder = os.environ.get("SEISMASS_SHARED")
    if not folder:
        sys.exit("SEISMASS_SHARED must name the folder that holds the recordings")
    section = text(Path(folder), quick=arguments.quick)
    if arguments.quick:
        print(section)
        return
    parts = page_module("parts")
    page = parts.Page(parts.ROOT / "docs" / "matching.md")
    page.marked("peer", section)
    page.write()


if __name__ == "__main__":
    main()
