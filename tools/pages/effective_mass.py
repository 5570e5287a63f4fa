"""Tables of maps of the effective fraction under recordings and built-in motions, and the chart of docs/question.md."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import polars as pl

import seismass as sm
from pages.default_suite import TARGETS
from pages.parts import Page, table
from seismass.assessment.models import SLIDING, friction_factors, scaled_to_site
from seismass.effective_mass import EffectiveMassMap, EffectiveMassParameters, effective_mass_map
from seismass.effective_mass.rule import remarks_of_structure
from seismass.motions.motion import scaled_motions
from seismass.motions.records import Suite, builtin_suite, read_record, read_suite
from seismass.motions.spectra import TargetSpectrum
from seismass.show.effective_mass import bins_text, by_period_text, collapse_figure, rules_figure, rules_text

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
HEADS = (
    "building | T (s) | S_a (g) | R_y | mu | C1 | lambda by hand | runs, forty | recorded | real over model, forty "
    "| recorded "
).strip()
SHARES = np.linspace(0.0, 1.0, 21)
TITLES = {
    "builtin": "Built-in suite, 7 synthetic motions",
    "far_field": "36 components of 18 of the FEMA P-695 far-field pairs",
}


def fill(page: Page) -> EffectiveMassMap:
    """Put in the table of the built-in suite, those of recordings that are asked for, and return the first map."""
    target = TargetSpectrum.asce7()
    builtin = effective_mass_map(builtin_suite("seven"), target, PARAMETERS)
    page.block("builtin", tables("builtin", builtin))
    if page.wants("far_field"):
        suite = Suite("FEMA P-695 far field", read_suite(page.records / "fema_p695_far_field").records)
        found = effective_mass_map(suite, target, PARAMETERS)
        page.block("far_field", tables("far_field", found))
        page.figure("effective_fraction", collapse_figure, found)
        page.figure("rules", rules_figure, found)
    if page.wants("fourteen"):
        page.tables(fourteen(page))
    return builtin


def fourteen(page: Page) -> str:
    """Return the table of the rule by hand beside the runs, of the buildings of docs/default_suite.md."""
    folders = (page.records.parent / "findings" / name for name in ("answer", "buildings"))
    files = [file for folder in folders for file in sorted(folder.glob("[bn][0-9]_*.toml")) if "_I" not in file.stem]
    suites = builtin_suite("forty"), read_suite(page.records / "fema_p695_far_field")
    return table(HEADS, [cells for file in files for cells in of_building(file, suites)])


def of_building(file: Path, suites: tuple[Suite, Suite]) -> list[list[str]]:
    """Return the rows of a building, a row for each friction: the rule, and the runs under each suite."""
    building = sm.read_building(file)
    target = TARGETS.get(file.stem, building.target)
    rows = []
    for name, factor in friction_factors(building.mu_factors).items():
        scene, by_runs, ratios = building.scene(target, mu_factor=factor), [], []
        for suite in suites:
            factors = scaled_to_site(building, suite, target).factors
            motions = scaled_motions(suite, factors)
            how = {"fractions": SHARES, "drift_cap": building.drift_cap, "resamples": 1}
            level = None if target is None else building.motion_target(target)
            found = sm.effective_mass(scene, motions, target=level, **how)
            curve = found.curve.filter(storey=0)
            ratio = np.interp(found.by_hand.estimate, curve["fraction"], curve["ratio"])
            by_runs.append("none" if np.isnan(found.value) else f"{found.value:.2f}")
            ratios.append(f"{ratio:.2f}")
        rule = found.by_hand
        numbers = (rule.period, rule.spectral_acceleration_g, rule.yield_reduction)
        head = (building.name, *(f"{number:.2f}" for number in numbers)) if name == SLIDING else ("", "", "", "")
        by_hand = f"{rule.estimate:.2f}" + " (- 0.10)" * bool(rule.exceptions)
        if remarks_of_structure(scene):
            by_hand, ratios = "not applied", ["-"] * len(ratios)
        rows.append([*head, f"{rule.friction:.3g}", f"{rule.coefficient:.3f}", by_hand, *by_runs, *ratios])
    return rows


def far_field_components(records: Path) -> Suite:
    """Return 42 components of 21 of the far-field pairs: those of the far-field suite and `MORE`."""
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
