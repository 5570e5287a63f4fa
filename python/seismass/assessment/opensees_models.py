"""A building with its goods, and the two analyses of its answer, as models of OpenSeesPy."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Final

import numpy as np

from seismass.assessment.answer import ANALYSIS, analysis_table
from seismass.assessment.models import ADVISED, BARE, REAL, compared_models
from seismass.assessment.result import Assessment
from seismass.base.files import without_formulas
from seismass.records import Suite
from seismass.runs.opensees_export import write_opensees

TITLES: Final = {REAL: "goods slide", ADVISED: "analysis 1", BARE: "analysis 2"}
"""Models that are written, and what the program calls them."""


def write_models(folder: str | os.PathLike[str], result: Assessment, suite: Suite) -> list[Path]:
    """Write OpenSeesPy models of an assessed building, with goods that slide and of both analyses, and analysis.csv.
    `suite` holds its motions, unscaled.
    """
    share = next((one.share_of_goods_present for one in result.answer.analyses if one.model == ADVISED), None)
    scenes = compared_models(result.building, result.target, share)
    factors = np.ones(len(suite)) if result.scaling is None else result.scaling.factors
    motions = [record.scaled(float(factor)) for record, factor in zip(suite, factors, strict=True)]
    chosen = {title: scenes[name] for name, title in TITLES.items() if name in scenes}
    table = analysis_table(result.answer, result.building)
    return write_opensees(folder, chosen, motions, documents={f"{ANALYSIS}.csv": without_formulas(table).write_csv()})
