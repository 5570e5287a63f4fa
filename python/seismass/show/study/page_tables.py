"""The tables of the page of a study: storeys, fractions, slip."""

from __future__ import annotations

from typing import Final

import polars as pl
from markupsafe import Markup

from seismass.effective_mass.estimate import RULE, RULE_IN_WORDS, SAFE_RULE
from seismass.media.page import table_html
from seismass.media.roles import ATTACHED, CODE, EFFECTIVE, ETA, SLIDE, lettered
from seismass.show.study.answer import percent
from seismass.show.study.tables import StudyTables

_KEYS: Final = ("occupancy", "storeys", "R", "alpha", "mu")


def shown_keys(table: pl.DataFrame) -> list[str]:
    """Key columns, without a friction coefficient that is the same throughout."""
    return [name for name in _KEYS if name != "mu" or table["mu"].n_unique() > 1]


def storeys_table(result: StudyTables) -> Markup:
    """Return mean drifts of every storey by the three models, and the underestimation."""
    names = {
        "storey": "storey",
        "mean_peak_drift_real": f"{SLIDE.name} (mm)",
        "mean_peak_drift_code": f"{CODE.name} (mm)",
        "mean_peak_drift_attached": f"{ATTACHED.name} (mm)",
        "underestimation_percent": "under-estimation",
        "p16_underestimation_percent": "16 %",
        "median_underestimation_percent": "median",
        "p84_underestimation_percent": "84 %",
        "ratio_mass": f"{ATTACHED.name} / {CODE.name}",
        "ratio_sliding": f"{SLIDE.name} / {ATTACHED.name}",
    }
    table = result.summary.select(*shown_keys(result.summary), *names)
    millimetres = [name for name in names if name.startswith("mean_peak")]
    percents = [name for name in names if name.endswith("percent")]
    return table_html(
        table,
        f"Mean peak drift of every storey, and ({SLIDE.name} \N{EN DASH} {CODE.name}) / {CODE.name}: of the means, "
        "and motion by motion.",
        headers=names,
        formats={
            **dict.fromkeys(millimetres, lambda drift: f"{1e3 * drift:.1f}"),
            **dict.fromkeys(percents, percent),
            **dict.fromkeys(("ratio_mass", "ratio_sliding"), ".2f"),
        },
    )


def fractions_table(fractions: pl.DataFrame) -> Markup:
    """Return C1, eta, the estimates and the effective fraction of every building."""
    names = {
        "base_shear_coefficient": "C1",
        "eta": ETA,
        "height_ratio": "h_g/h_m",
        "exponent": "p",
        "estimate": lettered(RULE),
        "conservative": lettered(SAFE_RULE),
        "effective": EFFECTIVE,
        "low": "5 %",
        "high": "95 %",
        "kind": "kind",
    }
    known = [name for name in names if fractions[name].null_count() < fractions.height]
    return table_html(
        fractions.select(*shown_keys(fractions), *known),
        "Every building: mean peak base shear coefficient C1 with all attached, {ETA} = {MU}/C1, the estimates with "
        f"{lettered(RULE_IN_WORDS)}"
        + (", and the effective fraction with its interval." if "effective" in known else "."),
        headers={name: names[name] for name in known},
        formats={name: ".3f" if name.startswith("base") else ".2f" for name in known if name != "kind"},
    )


def slip_table(demand: pl.DataFrame) -> Markup:
    """Return the slip demand of every building."""
    names = {
        "mean": "mean (mm)",
        "p16": "16 % (mm)",
        "p84": "84 % (mm)",
        "largest": "largest (mm)",
        "residual": "residual, mean (mm)",
    }
    return table_html(
        demand.select(*shown_keys(demand), "slides", *names),
        "Slip demand of each building: of the floor on which goods slide farthest, under each motion.",
        headers={**names, "slides": "motions in which goods slide"},
        formats=dict.fromkeys(names, lambda slip: f"{1e3 * slip:.1f}"),
    )
