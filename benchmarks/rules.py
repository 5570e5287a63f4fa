"""How rules for the effective fraction do by class of period, on several suites and shapes of the target spectrum.

    benchmarks/rules.py [--suites paper seven forty other far_field] [--shapes 0.3 0.57 1.0]

solves the maps, prints the tables and keeps them in benchmarks/results/rules.csv, each suite and shape in place of its
earlier rows; without options it prints what is kept. `--write` puts the tables into docs/effective_mass.md. Recordings
are read from the folder `records` of SEISMASS_SHARED. The exponents of the rule were fitted on the far-field suite; the
others judge it.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path

import polars as pl

import seismass as sm
from environment import page_module
from seismass.effective_mass import EffectiveMassParameters, effective_mass_map
from seismass.effective_mass.estimate import CLOSED_FORMS
from seismass.motions.spectra import DEFAULT_SDS_G

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "benchmarks" / "results" / "rules.csv"
PAGE = ROOT / "docs" / "effective_mass.md"
DEFAULT_SHAPE = 0.57
"""T_S (s) of the default target, S_DS = 1.07 g and S_D1 = 0.61 g."""
GRID = EffectiveMassParameters(
    mass_ratios=(0.5, 1.5), response_modification=(1.0, 2.0, 4.0, 8.0), resamples=1, shares=21
)
"""Half of the default loads and strengths and a fifth of the shares, so that a suite takes a minute or two."""
TITLES = {
    "far_field": "FEMA P-695 far field, 36 recordings (fitted)",
    "paper": "the paper's seven recordings (one substitute)",
    "other": "8 recordings of the same events, other components",
    "seven": "built-in seven, synthetic",
    "forty": "built-in forty, synthetic",
}


def suite_of(name: str) -> sm.records.Suite:
    """Return a suite by its key."""
    if name in ("seven", "forty"):
        return sm.builtin_suite("seven" if name == "seven" else "forty")
    records = Path(os.environ["SEISMASS_SHARED"]) / "records"
    if name == "far_field":
        return sm.read_suite(records / "fema_p695_far_field")
    paper = sm.read_suite(records / "paper_seven.csv")
    if name == "paper":
        return paper
    used = {record.source.name for record in paper if record.source is not None}
    listed = sorted(
        file
        for folder in records.iterdir()
        if folder.name[:2].isdigit()
        for file in folder.glob("*.AT2")
        if file.name not in used and not any(word in file.name.upper() for word in ("VER", "UP", "-V."))
    )
    return sm.records.Suite("other components", tuple(sm.read_record(file) for file in listed))


def solved(name: str, shape: float) -> pl.DataFrame:
    """Return the rules by class of period of one suite under one shape of the target."""
    shaped = sm.TargetSpectrum.asce7(DEFAULT_SDS_G, DEFAULT_SDS_G * shape)
    target = sm.TargetSpectrum.asce7() if shape == DEFAULT_SHAPE else shaped
    found = effective_mass_map(suite_of(name), target, GRID)
    return found.rules_by_period().select(
        pl.lit(name).alias("suite"),
        pl.lit(shape).alias("shape"),
        pl.lit(round(float(found.table["corner_period"].to_numpy().mean()), 3)).alias("corner_period"),
        pl.all(),
    )


def kept() -> pl.DataFrame | None:
    """Return the stored rows."""
    return pl.read_csv(RESULTS) if RESULTS.exists() else None


def lines(table: pl.DataFrame) -> list[str]:
    """Return the tables as text: mean, worst and unsafe cases by class of period."""
    periods = table["period_from"].unique().sort().to_list()
    heads = ["below 0.225", *(f"from {low:g}" for low in periods[1:])]
    text = [
        "Model over real drift by period of the bare building (s): geometric mean, worst, share of unsafe cases",
        "(the real building drifts more than 1.05 x the model); T_S of the target, T_c of the motions",
    ]
    order = list(TITLES)
    keys = sorted(table.select("suite", "shape", "corner_period").unique().rows(), key=lambda row: order.index(row[0]))
    for suite, shape, corner in sorted(keys, key=lambda row: (order.index(row[0]), row[1])):
        here = table.filter(suite=suite, shape=shape)
        cases = here.filter(rule=CLOSED_FORMS[0])["cases"].to_list()
        text += ["", f"{TITLES[suite]}; T_S = {shape:g} s, T_c = {corner:.2f} s"]
        text.append(f"{'cases':28}" + "".join(f"{f'{head}: {n}':>19}" for head, n in zip(heads, cases, strict=True)))
        for rule in CLOSED_FORMS:
            rows = here.filter(rule=rule).sort("period_from").iter_rows(named=True)
            cells = [f"{row['bias']:.3f} {row['worst']:.2f} {100 * row['unsafe']:3.0f} %" for row in rows]
            text.append(f"{rule:28}" + "".join(f"{cell:>19}" for cell in cells))
    return text


def main() -> None:
    """Solve, keep, print and write as the options say."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suites", nargs="*", choices=tuple(TITLES), default=[])
    parser.add_argument("--shapes", nargs="*", type=float, default=[DEFAULT_SHAPE], help="T_S of the target (s)")
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    for suite in options.suites:
        for shape in options.shapes:
            new, before = solved(suite, shape), kept()
            if before is not None:
                same = (pl.col("suite") == suite) & (pl.col("shape") == shape)
                new = pl.concat([before.filter(~same), new], how="vertical_relaxed")
            new.filter(pl.col("rule").is_in(CLOSED_FORMS)).write_csv(RESULTS, float_precision=4)
    table = kept()
    if table is None:
        parser.error("nothing is kept yet: name --suites")
    print("\n".join(lines(table)))
    if options.write:
        page = page_module("parts").Page(PAGE)
        page.block("rules", lines(table))
        page.write()


if __name__ == "__main__":
    main()
