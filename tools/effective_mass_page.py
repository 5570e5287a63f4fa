"""Make the tables of docs/effective_mass.md and the chart of docs/question.md from maps under recordings and built-in
motions.

Usage: tools/effective_mass_page.py SHARED [SUITE ...], SHARED a folder with `records`, by default all three suites;
some ten minutes. Models are solved at a quarter of the shares that a map takes by default, and no interval is printed.
The tests check the table of the built-in suite alone.
"""

from __future__ import annotations

import runpy
import sys
from pathlib import Path

import polars as pl

from seismass.effective_mass import EffectiveMassMap, EffectiveMassParameters, effective_mass_map
from seismass.media.figure_file import save_figure
from seismass.records import Suite, builtin_suite, read_record, read_suite
from seismass.show.effective_mass.map import collapse_figure, rules_figure
from seismass.show.effective_mass.map_text import bins_text, by_period_text, rules_text
from seismass.spectra import TargetSpectrum

ROOT = Path(__file__).parents[1]
PARTS = runpy.run_path(str(ROOT / "tools" / "page_parts.py"))
PAGE = ROOT / "docs" / "effective_mass.md"
MORE = (
    "01_Hector_Mine_1999_Hector/RSN1787_HECTOR_HEC000.AT2",
    "01_Hector_Mine_1999_Hector/RSN1787_HECTOR_HEC090.AT2",
    "02_Loma_Prieta_1989_Gilroy_Array_3/RSN767_LOMAP_G03000.AT2",
    "02_Loma_Prieta_1989_Gilroy_Array_3/RSN767_LOMAP_G03090.AT2",
    "07_Kobe_1995_substitutes/RSN1111_KOBE_NIS000.AT2",
    "07_Kobe_1995_substitutes/RSN1111_KOBE_NIS090.AT2",
)
"""Components of the far-field set that are, or stand beside, records of the paper: no rule was fitted on them."""
PARAMETERS = EffectiveMassParameters(shares=26, resamples=1)
TITLES = {
    "builtin": "Built-in suite, 7 synthetic motions",
    "paper": "The paper's seven recordings (one substitute)",
    "far_field": "36 components of 18 of the FEMA P-695 far-field pairs",
}


def suites(shared: Path) -> dict[str, Suite]:
    """Return the three suites by key."""
    records = shared / "records"
    return {
        "builtin": builtin_suite("seven"),
        "paper": read_suite(records / "paper_seven.csv"),
        "far_field": Suite("FEMA P-695 far field", read_suite(records / "fema_p695_far_field").records),
    }


def far_field_components(shared: Path) -> Suite:
    """Return 42 components of 21 of the far-field pairs: those of the far-field suite and `MORE`."""
    records = shared / "records"
    more = (read_record(records / file) for file in MORE)
    return Suite("FEMA P-695 far field", (*read_suite(records / "fema_p695_far_field").records, *more))


def tables(key: str, result: EffectiveMassMap) -> list[str]:
    """Return the lines of the tables of one map."""
    sliding = result.table.filter(pl.col("slides"))
    worst = []
    for name, what in (
        ("worst_storey_ratio", "with the effective fraction"),
        ("worst_storey_ratio_at_1", "with all attached"),
        ("worst_storey_envelope_ratio", "over the larger of the effective fraction and nothing"),
    ):
        share, most = float((sliding[name] > 1.05).to_numpy().mean()), float(sliding[name].to_numpy().max())
        worst.append(f"  {what:55}{100.0 * share:>5.1f} % of cases, worst {most:.2f}")
    counts = result.table["kind"].value_counts().sort("kind").to_dicts()
    kinds = ", ".join(f"{row['count']} {row['kind']}" for row in counts)
    return [
        f"{TITLES[key]}: {result.table.height} cases, goods slide in {sliding.height} ({kinds})",
        "",
        *rules_text(result.rules()),
        "",
        *by_period_text(result.rules_by_period()),
        "",
        *bins_text(result.by_eta()),
        "",
        "Some storey drifts more than 1.05 times the model",
        *worst,
    ]


def with_tables(page: str, key: str, result: EffectiveMassMap) -> str:
    """Return the page with the tables of one map in their place."""
    changed: str = PARTS["with_block"](page, key, tables(key, result))
    return changed


def write(maps: dict[str, EffectiveMassMap]) -> None:
    """Write page and figures."""
    page = PAGE.read_text(encoding="utf-8")
    for key, result in maps.items():
        page = with_tables(page, key, result)
    PAGE.write_text(page, encoding="utf-8")
    if "far_field" not in maps:
        return
    save_figure(collapse_figure(maps["far_field"]), "png", ROOT / "docs" / "figures" / "effective_fraction.png")
    save_figure(rules_figure(maps["far_field"]), "png", ROOT / "docs" / "figures" / "rules.png")


if __name__ == "__main__":
    if len(sys.argv) < 2 or not set(sys.argv[2:]) <= TITLES.keys():
        sys.exit(__doc__)
    wanted = sys.argv[2:] or list(TITLES)
    every = suites(Path(sys.argv[1]))
    write({key: effective_mass_map(every[key], TargetSpectrum.asce7(), PARAMETERS) for key in wanted})
