"""The result of an analysis from its runs and fragilities: tables, remarks, and a digest of the inputs."""

from __future__ import annotations

from typing import Any, Final, TypeAlias

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass import _kernel
from seismass.base.digest import inputs_digest, motion_contents
from seismass.base.errors import InvalidOption
from seismass.base.values import as_array, counted
from seismass.fragility.compare import comparison_table, curve_table, exceedance_table, fragility_table
from seismass.fragility.fragility import BootstrapOptions, Fragility
from seismass.fragility.result import SCHEMA_VERSION, AnalysisMethod, FragilityAnalysis
from seismass.fragility.run import Setting, check_levels
from seismass.model.plausibility import usage_remarks
from seismass.runs.simulate import instruction_set

Fits: TypeAlias = dict[tuple[str, str], Fragility]
"""Fragilities by name of the model and name of the limit."""

FEW_MOTIONS: Final = 20
"""Fewer motions than this are remarked, a choice of ours: intervals of so few motions are too narrow."""


def result_of(
    setting: Setting,
    method: AnalysisMethod,
    runs: pl.DataFrame,
    capacities: pl.DataFrame | None,
    fits: Fits,
    at: ArrayLike,
    options: BootstrapOptions,
    chosen: dict[str, Any],
) -> FragilityAnalysis:
    """Return the result with its tables, remarks and metadata."""
    names, motions = tuple(setting.models), setting.motions
    levels = np.unique(as_array(at, "at", "intensity analysis", InvalidOption, or_number=True))
    if len(levels):
        check_levels(levels, "intensities of comparison", "at")
    known = capacities if capacities is not None else pl.DataFrame()
    described = {
        **chosen,
        "method": method,
        "measure": setting.measure.to_dict(),
        "limits": [limit.to_dict() for limit in setting.limits],
        "confidence": options.confidence,
        "resamples": options.resamples,
        "seed": options.seed,
        "at": levels.tolist(),
    }
    return FragilityAnalysis(
        method=method,
        measure=setting.measure,
        models=names,
        limits=setting.limits,
        motions=pl.DataFrame(
            {
                "motion": np.arange(1, len(motions) + 1, dtype=np.uint32),
                "record": motions.names,
                "event": pl.Series([event or None for event in motions.events], dtype=pl.String),
                setting.measure.column: setting.unit,
            }
        ),
        runs=runs,
        capacities=known,
        fragilities=fragility_table(fits),
        curves=curve_table(fits, setting.limits),
        comparison=comparison_table(fits, setting.limits, names),
        exceedance=exceedance_table(fits, setting.limits, names, levels),
        remarks=_remarks(setting, method, known, fits, options, chosen),
        metadata={
            "schema_version": SCHEMA_VERSION,
            "package_version": _kernel.VERSION,
            "instructions": instruction_set(),
            "inputs_sha256": inputs_digest(setting.models, motion_contents(motions.components), described),
            **described,
            "motions": len(motions),
            "clusters": motions.clusters,
            "runs": runs.height,
        },
        fits=fits,
    )


def _remarks(
    setting: Setting,
    method: AnalysisMethod,
    capacities: pl.DataFrame,
    fits: Fits,
    options: BootstrapOptions,
    chosen: dict[str, Any],
) -> tuple[str, ...]:
    """What a user must know beside the numbers."""
    count, clusters = len(setting.motions), setting.motions.clusters
    said = (remark for scene in setting.models.values() for remark in scene.remarks)
    remarks = usage_remarks(said, (), ((limit.quantity, limit.value) for limit in setting.limits))
    if count < FEW_MOTIONS:
        remarks.append(f"{counted(count, 'motion')}: few for a fragility; intervals of so few are too narrow")
    if clusters == 1 and count > 1:
        remarks.append("there are no intervals, as all motions are of one earthquake")
    if not capacities.is_empty():
        several = capacities.filter(pl.col("crossings") > 1).group_by("limit", "model", maintain_order=True).len()
        for limit, model, number in several.iter_rows():
            remarks.append(
                f"{limit}, {model}: {number} of {counted(count, 'motion')} cross the limit more than once; the "
                f"{chosen['capacity']} crossing counts"
            )
    for (model, limit), fit in fits.items():
        remarks += [f"{limit}, {model}: {remark}" for remark in fit.remarks]
    for limit_state in setting.limits:
        without = [name for name, scene in setting.models.items() if not limit_state.applies(scene)]
        if without:
            have = "have" if len(without) > 1 else "has"
            remarks.append(f"{limit_state.name}: {' and '.join(without)} {have} no goods that slide, and so no slip")
    remarks.append(
        "the scatter is that of the motions alone: friction, occupancy, stiffness and strength are as given"
        + ("" if method == "cloud" else ", and scaling leaves the shape of spectra as it is")
    )
    if "code_share" in chosen:
        convention = "C of the real building" if chosen["damping"] == "same" else "ratio in the model's own modes"
        remarks.append(
            f"code: {100.0 * chosen['code_share']:g} % of the goods attached as mass, attached: all of them; "
            f"stiffness, strength and gravity load as in the real building; damping: {convention}"
        )
    return tuple(remarks)
