"""One run of a study to look at: the building whose drift is underestimated most among those whose goods slide."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import polars as pl

from seismass.base.values import FloatArray
from seismass.model.scene import Scene
from seismass.records import Record, Suite
from seismass.spectra import mean_spectrum
from seismass.study.buildings import study_buildings
from seismass.study.parameters import StudyParameters
from seismass.study.run import StudyResult

SLIDES: Final = 0.01
"""Mean peak slip (m) of goods that are seen to slide."""


@dataclass(frozen=True, eq=False)
class Example:
    """A building of a study with its sliding goods under one of its motions: key columns, scaled record, and the name
    of the motion in the study.
    """

    labels: dict[str, Any]
    scene: Scene
    record: Record
    name: str


def study_example(suite: Suite, parameters: StudyParameters, result: StudyResult) -> Example | None:
    """Return the building of largest first-storey underestimation whose first-floor goods slide by `SLIDES` on average
    (or of all), and the motion closest to that of the means; None where no run has a result.
    """
    first = result.summary.filter(storey=1).drop_nulls("underestimation_percent")
    slides = first.filter((pl.col("mean_peak_slip") >= SLIDES) & (pl.col("R") > 1.0))
    ranked = (slides if slides.height else first).sort("underestimation_percent", descending=True)
    if not ranked.height:
        return None
    row = ranked.row(0, named=True)
    runs = result.responses.filter(building=row["building"], storey=1).sort("motion")
    real, code = (runs.filter(model=model)["peak_drift"].to_numpy() for model in ("real", "code"))
    motion = int(np.argmin(np.abs(np.log(real / code) - np.log(row["ratio"]))))
    factors = result.scaling.factors

    def spectrum(periods: FloatArray) -> FloatArray:
        return mean_spectrum(suite, factors, periods, parameters.damping)

    building = list(study_buildings(parameters, spectrum))[row["building"] - 1]
    name = result.metadata["suite"]["motions"][motion]["record"]
    return Example(building.labels, building.scenes["real"], suite[motion].scaled(float(factors[motion])), name)
