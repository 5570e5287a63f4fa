"""Measures, pairs and RotD spectra of recordings, beside the NGA-West2 flatfile.

The table of other programs is written by benchmarks/ground_motions.py and kept as it is.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

import seismass as sm
from pages.parts import Page, table
from seismass.base.values import signed

LENGTH_RATIO: Final = 15.0
FILTER: Final = (0.2, 25.0)
FILTERED: Final = "RSN6_IMPVALL.I_I-ELC180-hor1"


def fill(page: Page) -> list[Listed]:
    """Put in the tables, and return the pairs that the flatfile lists."""
    suite = sm.read_suite(page.records / "paper_seven.csv")
    pairs = sm.records.find_pairs(page.records)
    listed = listed_pairs(page.records, pairs)
    page.marked("measures", measures_table(suite))
    page.marked("pairs", pairs_table(pairs))
    page.marked("flatfile", flatfile_tables(listed))
    page.marked("processing", processing_table(sm.read_record(next(page.records.glob(f"*/{FILTERED}.AT2")))))
    page.marked("similitude", similitude_table(suite))
    return listed


@dataclass(frozen=True)
class Listed:
    """A pair at hand that the flatfile lists: its RotD50 there, peaks in m/s2, m/s and m, spectrum in m/s2."""

    sequence: int
    pair: sm.Pair
    periods: NDArray[np.float64]
    spectrum: NDArray[np.float64]
    peaks: dict[str, float]


def listed_pairs(records: Path, pairs: sm.records.Pairs) -> list[Listed]:
    """Return the pairs that the flatfile lists, by record sequence number."""
    flat = pl.read_csv(records / "reference" / "nga_w2_selected.csv", infer_schema_length=0)
    columns = [column for column in flat.columns if re.fullmatch(r"T\d+\.\d+S", column)]
    periods = np.array([float(column[1:-1]) for column in columns])
    found = []
    for pair in pairs:
        match = re.match(r"RSN(\d+)", pair.name)
        rows = flat.filter(pl.col("Record Sequence Number") == (match[1] if match else ""))
        if match is None or rows.height == 0:
            continue
        row = rows.row(0, named=True)
        if (float(row["Damping (%)"]), float(row["RotD percentile"])) != (5.0, 50.0):
            raise SystemExit(f"RSN{match[1]}: not RotD50 at 5 % damping")
        spectrum = np.array([float(row[column]) for column in columns]) * sm.STANDARD_GRAVITY
        peaks = {
            "pga": float(row["PGA (g)"]) * sm.STANDARD_GRAVITY,
            "pgv": 0.01 * float(row["PGV (cm/sec)"]),
            "pgd": 0.01 * float(row["PGD (cm)"]),
        }
        found.append(Listed(int(match[1]), pair, periods, spectrum, peaks))
    return sorted(found, key=lambda item: item.sequence)


def measures_table(suite: sm.Suite) -> str:
    """Return the measures of the paper's components."""
    digits = {"pga_g": 4, "pgv": 3, "pgd": 3, "arias": 3, "d5_75": 2, "d5_95": 2, "cav": 2, "bracketed": 2}
    rows = [
        (row["name"].partition("__")[0], *(f"{row[name]:.{n}f}" for name, n in digits.items()))
        for row in sm.records.intensity_table(suite).iter_rows(named=True)
    ]
    heads = "PGA (g) | PGV (m/s) | PGD (m) | Arias (m/s) | D5-75 (s) | D5-95 (s) | CAV (m/s) | bracketed (s)"
    return table(f"record | {heads}", rows, 1)


def pairs_table(pairs: sm.records.Pairs) -> str:
    """Return the pairs that were found."""
    rows = []
    for pair in pairs:
        said = "not stated" if pair.azimuths is None else " / ".join(f"{azimuth:g}" for azimuth in pair.azimuths)
        files = ("yes" if pair.vertical is not None else "no", str(pair.samples), f"{pair.dt:g}")
        peaks = [f"{record.pga_g:.5f}" for record in (pair.first, pair.second)]
        aligned = sum("samples of its pair" in one or "zeros" in one for one in pair.remarks)
        rows.append((pair.name, said, *files, *peaks, aligned))
    heads = "pair | azimuths | vertical | samples | dt (s) | PGA 1 (g) | PGA 2 (g) | components aligned"
    return table(heads, rows, 1)


def flatfile_tables(listed: list[Listed]) -> str:
    """Return the differences by record and by period, with the words on them."""
    rows, differences = [], []
    for item in listed:
        ours = sm.records.rotd(item.pair, item.periods)
        apart = 100.0 * (ours[50] / item.spectrum - 1.0)
        peaks = [100.0 * (ours.peaks[name][1] / item.peaks[name] - 1.0) for name in ("pga", "pgv", "pgd")]
        differences.append(apart)
        most = int(np.argmax(np.abs(apart)))
        at = int(np.argmin(np.abs(item.periods - 1.0)))
        rows.append(
            (
                f"RSN{item.sequence} {item.pair.station}",
                f"{item.pair.dt:g}",
                *(signed(value, "+.2f") for value in peaks),
                signed(float(np.median(apart)), "+.2f"),
                f"{signed(float(apart[most]), '+.2f')} at {item.periods[most]:g} s",
                f"{ours[100][at] / ours[50][at]:.3f}",
                "" if ours.azimuth is None else f"{ours.azimuth[at]:.0f}",
            )
        )
    all_of_them = np.array(differences)
    heads = "record | dt (s) | PGA | PGV | PGD | spectrum, median | largest | RotD100/50 at 1 s | its azimuth"
    by_period = [
        (f"{period:g}", *(signed(float(value), "+.2f") for value in (column.min(), np.median(column), column.max())))
        for period, column in zip(listed[0].periods, all_of_them.T, strict=True)
    ]
    worst = np.unravel_index(np.argmax(all_of_them), all_of_them.shape)
    item, period = listed[int(worst[0])], float(listed[0].periods[int(worst[1])])
    least, largest = signed(float(all_of_them.min()), "+.2f"), signed(float(all_of_them.max()), "+.2f")
    long_periods = np.abs(all_of_them[:, listed[0].periods >= 1.0]).max()
    return (
        f"Differences of ours from the flatfile (%), RotD50, {len(listed)} pairs at {all_of_them.shape[1]} periods:\n\n"
        f"{table(heads, rows, 1)}\n\n"
        f"{table('period (s) | least | median | largest', by_period, 0)}\n\n"
        f"The least difference is {least} %, the largest {largest} % (RSN{item.sequence} at {period:g} s, "
        f"{period / item.pair.dt:.0f} samples a period): the\nflatfile's are peaks at samples, as the table of other "
        "programs shows, and ours in continuous time. From 1 s on the two\n"
        f"agree within {long_periods:.2f} %."
    )


def similitude_table(suite: sm.Suite) -> str:
    """Return what the paper's components are on a table at reduced scale."""
    rows = []
    for record in suite:
        model = record.similitude(LENGTH_RATIO)
        times = f"{record.dt:g}", f"{1000.0 * model.dt:.4f}", f"{record.duration:.2f}", f"{model.duration:.2f}"
        peaks = f"{model.pga_g:.4f}", f"{100.0 * model.pgv:.2f}", f"{1000.0 * model.pgd:.2f}"
        rows.append((record.name.partition("__")[0], *times, *peaks))
    heads = "record | dt (s) | dt of the model (ms) | duration (s) | of the model (s) | PGA (g), both"
    return table(f"{heads} | PGV of the model (cm/s) | PGD of the model (mm)", rows, 1)


def processing_table(record: sm.Record) -> str:
    """Return what filtering with and without pads and baselines does to one component."""
    drifting = record.replace(acceleration=record.acceleration + 0.002 * sm.STANDARD_GRAVITY)
    made = {
        "as it is": record,
        f"{FILTER[0]:g} to {FILTER[1]:g} Hz, pads removed": record.band_passed(*FILTER),
        f"{FILTER[0]:g} to {FILTER[1]:g} Hz, pads kept": record.band_passed(*FILTER, keep_pads=True),
        "with 0.002 g added": drifting,
        "that, baseline of degree 1 fitted to the velocity": drifting.baseline_corrected(1),
        "that, mean removed": drifting.baseline_corrected(0, fit="acceleration"),
    }
    rows = []
    for what, one in made.items():
        ends = f"{one.velocity[-1]:z.4f}", f"{one.displacement[-1]:z.3f}"
        rows.append((what, one.samples, f"{one.pga_g:.4f}", f"{one.pgv:.3f}", f"{one.pgd:.3f}", *ends))
    heads = "RSN6, 180 | samples | PGA (g) | PGV (m/s) | PGD (m) | end velocity (m/s) | end displacement (m)"
    return table(heads, rows, 1)
