"""Measures and RotD50 spectra of recordings beside eqsig, pyrotd and the NGA-West2 flatfile: differences and times.

Usage: SEISMASS_SHARED=... python benchmarks/ground_motions.py [--quick]; writes its table into docs/ground_motions.md,
the quick one prints that of two pairs.
"""

from __future__ import annotations

import argparse
import importlib
import importlib.metadata
import os
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

import seismass as sm
from environment import page_module, summary
from scenes import FloatArray
from seismass.motions.records import Record

DAMPING: Final = 0.05
ZEROS: Final = 60.0
"""Zeros after the record (s), in which the responses of the longest periods die away."""
ANGLES: Final = 180
SAMPLES: Final = 10
"""Least number of samples a period, to which the flatfile's spectra turn out to be refined."""
BANDS: Final = ((0.0, 0.05), (0.05, 0.2), (0.2, 1.0), (1.0, 10.0))
"""Bands of periods (s): above the first up to and with the second."""

Spectrum = Callable[[sm.Pair, FloatArray], FloatArray]


def ours(pair: sm.Pair, periods: FloatArray) -> FloatArray:
    return sm.records.rotd(pair, periods, (50.0,), DAMPING, angles=ANGLES, threads=1)[50]


def with_eqsig(pair: sm.Pair, periods: FloatArray) -> FloatArray:
    """Responses of the two components at the samples, combined at each angle; the largest sample counts."""
    series = importlib.import_module("eqsig.sdof").response_series
    first, second = (
        series(record.acceleration, record.dt, periods, DAMPING)[0] for record in (pair.first, pair.second)
    )
    turns = np.radians(np.arange(ANGLES) * (180.0 / ANGLES))
    peaks = [np.abs(np.cos(turn) * first + np.sin(turn) * second).max(axis=-1) for turn in turns]
    return np.asarray(np.median(peaks, axis=0) * (2.0 * np.pi / periods) ** 2, dtype=np.float64)


def with_eqsig_refined(pair: sm.Pair, periods: FloatArray) -> FloatArray:
    """The same with so many samples more, on the lines between them, that each period has at least `SAMPLES`."""
    times = np.maximum(1, np.ceil(SAMPLES * pair.dt / periods - 1e-9)).astype(int)
    ordinates = np.empty(len(periods))
    for count in np.unique(times):
        finer = pair.each(partial(Record.resampled, dt=pair.dt / int(count)))
        ordinates[times == count] = with_eqsig(finer, periods[times == count])
    return ordinates


def with_pyrotd(pair: sm.Pair, periods: FloatArray, *, zeros: float = 0.0) -> FloatArray:
    pyrotd: Any = importlib.import_module("pyrotd")
    pyrotd.processes = 1
    after = round(zeros / pair.dt)
    components = (np.pad(record.acceleration, (0, after)) for record in (pair.first, pair.second))
    found = pyrotd.calc_rotated_spec_accels(
        pair.dt, *components, 1.0 / periods, DAMPING, percentiles=[50], osc_type="psa"
    )
    return np.asarray(found["spec_accel"], dtype=np.float64)


PROGRAMS: Final[tuple[tuple[str, str, Spectrum], ...]] = (
    ("seismass", "", ours),
    ("eqsig", "", with_eqsig),
    ("eqsig", f", {SAMPLES} samples a period", with_eqsig_refined),
    ("pyrotd", "", with_pyrotd),
    ("pyrotd", f", {ZEROS:g} s of zeros added", partial(with_pyrotd, zeros=ZEROS)),
)


def timed(work: Callable[[], FloatArray]) -> tuple[float, FloatArray]:
    began = time.process_time()
    result = work()
    return time.process_time() - began, result


def spectra_rows(listed: list[Any], signed: Callable[[float], str]) -> list[tuple[str, ...]]:
    """Differences of each program from the flatfile (%), least to largest by band of periods, and its time."""
    rows = []
    for name, how, spectrum in PROGRAMS:
        try:
            version = sm.__version__ if name == "seismass" else importlib.metadata.version(name)
            parts = [timed(partial(spectrum, item.pair, item.periods)) for item in listed]
        except ImportError as missing:
            rows.append((f"{name}: absent ({missing})", *[""] * (len(BANDS) + 2)))
            continue
        apart = np.array([100.0 * (part[1] / item.spectrum - 1.0) for part, item in zip(parts, listed, strict=True)])
        periods = listed[0].periods
        cells = []
        for low, high in BANDS:
            part = apart[:, (periods > low) & (periods <= high)]
            cells.append(f"{signed(part.min())} to {signed(part.max())}")
        rows.append(
            (f"{name} {version}{how}", *cells, signed(float(np.median(apart))), f"{sum(part[0] for part in parts):.1f}")
        )
    return rows


def measures_rows(pairs: list[sm.Pair]) -> list[tuple[str, ...]]:
    """Differences of eqsig's measures from ours over all horizontals (%; durations in s)."""
    try:
        im, single = importlib.import_module("eqsig.im"), importlib.import_module("eqsig.single")
    except ImportError as missing:
        return [(f"absent ({missing})", "", "", "")]
    apart: dict[str, list[float]] = {}
    for record in (record for pair in pairs for record in (pair.first, pair.second)):
        signal = single.AccSignal(record.acceleration, record.dt)
        signal.generate_displacement_and_velocity_series()
        relative = {
            "Arias (%)": (im.calc_arias_intensity(signal)[-1], record.arias),
            "CAV (%)": (im.calc_cav(signal)[-1], record.cav),
            "PGV (%)": (np.abs(signal.velocity).max(), record.pgv),
            "PGD (%)": (np.abs(signal.displacement).max(), record.pgd),
        }
        for name, (theirs, own) in relative.items():
            apart.setdefault(name, []).append(100.0 * (float(theirs) / own - 1.0))
        theirs = im.calc_sig_dur_vals(record.acceleration, record.dt)
        apart.setdefault("D5-95 (s)", []).append(float(theirs) - record.d5_95)
        theirs = im.calc_brac_dur(signal, 0.05 * sm.STANDARD_GRAVITY)
        apart.setdefault("bracketed (s)", []).append(float(theirs) - record.bracketed_duration())
    return [
        (name, *(f"{value:+.4f}" for value in (min(values), float(np.median(values)), max(values))))
        for name, values in apart.items()
    ]


def text(shared: Path, *, quick: bool) -> str:
    """Return the section of the page."""
    tool, table = page_module("ground_motions"), page_module("parts").table
    pairs = sm.records.find_pairs(shared / "records")
    listed = tool.listed_pairs(shared / "records", pairs)[: 2 if quick else None]
    bands = (f"to {BANDS[0][1]:g} s", *(f"{low:g} to {high:g} s" for low, high in BANDS[1:]))
    spectra = table(["program", *bands, "median", "time (s)"], spectra_rows(listed, tool.signed), 1)
    chosen = [item.pair for item in listed]
    measured = table("eqsig less ours | least | median | largest", measures_rows(chosen), 1)
    return (
        f"RotD50, 5 % damping, {len(listed)} pairs at {len(listed[0].periods)} periods: differences from the flatfile "
        "(%) by band of periods, least to\nlargest, and processor time of one thread for all of them.\n\n"
        f"{spectra}\n\n"
        "eqsig has the recurrence of Nigam and Jennings (1969), as ours, and takes the largest sample of the response "
        "of each\ncombination. With the samples refined on the lines between them it gives the flatfile's numbers "
        "themselves: these are\npeaks at no fewer than ten samples a period, and ours differ from them by what lies "
        "between the samples. pyrotd multiplies\nby transfer functions in the frequency domain, where a record repeats "
        "without rest unless zeros are added.\n\n"
        f"Measures of the {2 * len(listed)} horizontal components, which eqsig sums over samples:\n\n{measured}\n\n"
        f"{summary(('numpy', 'eqsig', 'pyrotd'))}."
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--quick", action="store_true", help="two pairs, printed")
    arguments = parser.parse_args()
    folder = os.environ.get("SEISMASS_SHARED")
    if not folder:
        sys.exit("SEISMASS_SHARED must name the folder that holds the recordings")
    section = text(Path(folder), quick=arguments.quick)
    if arguments.quick:
        print(section)
        return
    parts = page_module("parts")
    page = parts.Page(parts.ROOT / "docs" / "ground_motions.md")
    page.marked("peers", section)
    page.write()


if __name__ == "__main__":
    main()
