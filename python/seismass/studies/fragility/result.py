"""What an analysis of fragility gives back: runs, capacities, fragilities of every model, and what the rule changes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, Final, Literal, TypeAlias

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.arguments import Bootstrap, as_word, is_one_of
from seismass.base.errors import InvalidOption
from seismass.base.statistics import quantile
from seismass.base.stored_results import metadata_head, motion_contents
from seismass.base.values import FieldValue, FloatArray, as_array, brief, counted, refusal
from seismass.media.result import Result, finite_values
from seismass.model.plausibility import usage_remarks
from seismass.studies.fragility.compare import (
    comparison_table,
    curve_table,
    exceedance_table,
    fragility_table,
    reference_of,
)
from seismass.studies.fragility.fragility import Fragility
from seismass.studies.fragility.hunt import demand_at, intensity_at
from seismass.studies.fragility.limits import IntensityMeasure, LimitState
from seismass.studies.fragility.run import Setting, check_levels

SCHEMA_VERSION: Final = 2
"""Version of the tables and of the JSON of an analysis."""
FRACTILES: Final = (0.16, 0.50, 0.84)
"""Shares of the motions at which curves are summarised."""
_LEVELS: Final = 40

AnalysisMethod = Literal["hunt_fill", "stripes", "cloud"]
"""How intensities were chosen."""


@dataclass(frozen=True, eq=False, repr=False)
class FragilityAnalysis(FieldValue, Result):
    """Demand by intensity of several models of a building, and the probability of exceeding limits.

    Attributes
    ----------
    method : {"hunt_fill", "stripes", "cloud"}
        How intensities were chosen.
    measure : IntensityMeasure
        The intensity measure.
    models : tuple of str
        Names of the models; others are compared with "real", or with the first where no model has that name.
    limits : tuple of LimitState
        The limit states.
    motions : polars.DataFrame
        One row per motion: motion, record, event, and its intensity as it is, in the column of the measure.
    runs : polars.DataFrame
        One row per run: model, motion, record, scale, intensity, status, and the demand of each column of the limits.
    capacities : polars.DataFrame
        One row per limit, model and motion: limit, model, motion, record, capacity (null where the limit is not
        exceeded), lower and upper (intensities between which it is crossed), highest (intensity up to which the motion
        was scaled), crossings (how often demand rises above the limit). Empty for stripes of different motions and for
        clouds.
    fragilities : polars.DataFrame
        One row per limit and model: limit, model, kind, method, median, median_low, median_high, dispersion,
        dispersion_low, dispersion_high, runs, exceeding, lowest, highest; see `Fragility`.
    curves : polars.DataFrame
        Fragility curves: limit, model, intensity, probability, probability_low, probability_high.
    comparison : polars.DataFrame
        One row per limit and model beside the reference: limit, model, median_ratio (capacity of the model over that of
        the reference: above 1 the model promises too much), median_ratio_low, median_ratio_high, median,
        reference_median.
    exceedance : polars.DataFrame
        One row per limit, model beside the reference and intensity: limit, model, given ("chosen", or at which
        probability of the model), intensity, probability (of the model), reference (that of the reference), difference
        (reference - model), ratio (reference / model), each with _low and _high.
    remarks : tuple of str
        What a user must know beside the numbers.
    metadata : dict
        Versions, digest of the inputs, options, seed, conventions.
    """

    document: ClassVar[str] = "fragility"

    method: AnalysisMethod
    measure: IntensityMeasure
    models: tuple[str, ...]
    limits: tuple[LimitState, ...]
    motions: pl.DataFrame = field(repr=False)
    runs: pl.DataFrame = field(repr=False)
    capacities: pl.DataFrame = field(repr=False)
    fragilities: pl.DataFrame = field(repr=False)
    curves: pl.DataFrame = field(repr=False)
    comparison: pl.DataFrame = field(repr=False)
    exceedance: pl.DataFrame = field(repr=False)
    remarks: tuple[str, ...] = field(repr=False)
    metadata: dict[str, Any] = field(repr=False)
    fits: dict[tuple[str, str], Fragility] = field(repr=False)

    @property
    def reference(self) -> str:
        """Name of the model with which others are compared."""
        return reference_of(self.models)

    def limit(self, limit: LimitState | str) -> LimitState:
        """Return a limit state of the analysis, also by its name.

        Raises
        ------
        InvalidOption
            The analysis has no such limit.
        """
        name = limit.name if isinstance(limit, LimitState) else limit
        for each in self.limits:
            if is_one_of(name, (each.name,)):
                return each
        known = ", ".join(each.name for each in self.limits)
        raise refusal(InvalidOption, "limit", "analysis", f"one of {known}", brief(name))

    def fragility(self, limit: LimitState | str | None = None, model: str | None = None) -> Fragility:
        """Return the fragility of a model; by default that of the first limit and of the reference.

        Raises
        ------
        InvalidOption
            There is no such limit or model, or the model does not have the quantity, as one without goods has no slip.
        """
        state = self.limits[0] if limit is None else self.limit(limit)
        name = self.reference if model is None else model
        as_word(
            name, [each for each, other in self.fits if other == state.name], "model", f"fragility for {state.name}"
        )
        return self.fits[name, state.name]

    def fractiles(
        self, axis: Literal["intensity", "demand"] = "intensity", levels: ArrayLike | None = None
    ) -> pl.DataFrame:
        """Return 16, 50 and 84 % fractiles over the motions of demand given intensity, or of intensity given demand.

        Parameters
        ----------
        axis : {"intensity", "demand"}, default "intensity"
            Quantity of the levels, at each of which the fractiles of the other are given.
        levels : array_like, optional
            Intensities or demands, positive and increasing; by default 40 up to the largest intensity to which all
            motions were scaled or exceed the limit, or the intensities of stripes; or up to 1.5 times the largest limit
            of the quantity.

        Returns
        -------
        polars.DataFrame
            One row per model, column of demand and level: model, demand_column, given ("intensity" or "demand"), level,
            p16, p50, p84. A collapse counts as infinite demand; a fractile that it decides is infinite. Null where a
            motion was not scaled so far.

        Raises
        ------
        InvalidOption
            `axis` is another word, the levels are not what they must be, or motions are not scaled, as in a cloud.

        Notes
        -----
        Vamvatsikos and Cornell (2002), section 5. Between intensities that were solved curves are linear.
        """
        as_word(axis, ("intensity", "demand"), "axis", "fractiles")
        if self.capacities.is_empty():
            requirement = "those of motions that are scaled to several intensities"
            raise refusal(InvalidOption, "analysis", "fractiles", requirement, self.method)
        stated = None if levels is None else check_levels(levels, "fractiles", "levels")
        frames = []
        for column in dict.fromkeys(limit.column for limit in self.limits):
            largest = max(limit.value for limit in self.limits if limit.column == column)
            for model in self.models:
                traced = self.traces(model, column)
                if not traced:
                    continue
                points = stated if stated is not None else self._levels(axis, traced, largest)
                rows = [
                    demand_at(x, y, points, largest) if axis == "intensity" else intensity_at(x, y, points)
                    for x, y in traced
                ]
                values = np.array(rows).T
                frames.append(
                    pl.DataFrame(
                        {
                            "model": np.repeat(model, len(points)),
                            "demand_column": np.repeat(column, len(points)),
                            "given": np.repeat(axis, len(points)),
                            "level": points,
                            **{
                                f"p{100 * share:.0f}": pl.Series(quantile(values, share), nan_to_null=True)
                                for share in FRACTILES
                            },
                        }
                    )
                )
        return pl.concat(frames)

    def traces(self, model: str, column: str) -> list[tuple[FloatArray, FloatArray]]:
        """Return intensities and demands of each motion under a model; none where the model has no such quantity."""
        for name, known in (
            (model, self.runs["model"].unique(maintain_order=True).to_list()),
            (column, self.runs.columns),
        ):
            as_word(name, known, "name", "traces")
        rows = self.runs.filter(pl.col("model") == model).drop_nulls(column).sort("motion", "intensity")
        return [
            (part["intensity"].to_numpy(), part[column].to_numpy())
            for part in rows.partition_by("motion", maintain_order=True)
        ]

    def _levels(self, axis: str, traced: Sequence[tuple[FloatArray, FloatArray]], largest: float) -> FloatArray:
        if axis == "demand":
            return np.linspace(0.0, 1.5 * (largest or 1.0), _LEVELS + 1)[1:]
        if self.method == "stripes":
            return np.unique(np.concatenate([x for x, _ in traced]))
        known = [float(x[-1]) for x, y in traced if y[-1] <= largest]
        top = min(known, default=max(float(x[-1]) for x, _ in traced))
        return np.linspace(0.0, top, _LEVELS + 1)[1:]

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name, the fractiles among them where motions are scaled."""
        names = ("motions", "runs", "capacities", "fragilities", "curves", "comparison", "exceedance")
        tables: dict[str, pl.DataFrame] = {name: getattr(self, name) for name in names}
        if self.capacities.is_empty():
            del tables["capacities"]
        else:
            tables |= {f"fractiles_given_{axis}": self.fractiles(axis) for axis in ("intensity", "demand")}
        return tables

    def to_dict(self) -> dict[str, Any]:
        """Return the answer as plain values; null for non-finite values. Runs and curves are in the tables."""
        document: dict[str, Any] = {
            "schema_version": SCHEMA_VERSION,
            "method": self.method,
            "measure": self.measure.to_dict(),
            "models": list(self.models),
            "reference": self.reference,
            "limits": [limit.to_dict() for limit in self.limits],
        }
        document |= {
            name: getattr(self, name).to_dicts() for name in ("fragilities", "comparison", "exceedance", "motions")
        }
        finite: dict[str, Any] = finite_values(document | {"remarks": list(self.remarks), "metadata": self.metadata})
        return finite

    @property
    def figure_names(self) -> tuple[str, ...]:
        """Names: fragility for the curves, and for each quantity of the limits one that begins with demand: demand by
        intensity of each motion with the fractiles over the motions, a panel for each model.
        """
        return ("fragility", *(f"demand_{column}" for column in self.demands))

    @property
    def demands(self) -> dict[str, LimitState]:
        """The last limit of each quantity, by the column of its demand."""
        return {each.column: each for each in self.limits if each.quantity != "collapse"}


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
    intensities: ArrayLike,
    options: Bootstrap,
    settings: dict[str, Any],
) -> FragilityAnalysis:
    """Return the result with its tables, remarks and metadata."""
    names, motions = tuple(setting.models), setting.motions
    levels = np.unique(as_array(intensities, "at", "intensity analysis", InvalidOption, or_number=True))
    if len(levels):
        check_levels(levels, "intensities of comparison", "at")
    known = capacities if capacities is not None else pl.DataFrame()
    described = {
        **settings,
        "method": method,
        "measure": setting.measure.to_dict(),
        "limits": [limit.to_dict() for limit in setting.limits],
        **options._asdict(),
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
        remarks=_remarks(setting, method, known, fits, options, settings),
        metadata={
            **metadata_head(SCHEMA_VERSION, setting.models, motion_contents(motions.components), described),
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
    options: Bootstrap,
    settings: dict[str, Any],
) -> tuple[str, ...]:
    """What a user must know beside the numbers."""
    count, clusters = len(setting.motions), setting.motions.clusters
    scene_remarks = (remark for scene in setting.models.values() for remark in scene.remarks)
    remarks = usage_remarks(scene_remarks, (), ((limit.quantity, limit.value) for limit in setting.limits))
    if count < FEW_MOTIONS:
        remarks.append(f"{counted(count, 'motion')}: few for a fragility; intervals of so few are too narrow")
    if clusters == 1 and count > 1:
        remarks.append("there are no intervals, as all motions are of one earthquake")
    if not capacities.is_empty():
        several = capacities.filter(pl.col("crossings") > 1).group_by("limit", "model", maintain_order=True).len()
        for limit, model, number in several.iter_rows():
            remarks.append(
                f"{limit}, {model}: {number} of {counted(count, 'motion')} cross the limit more than once; the "
                f"{settings['capacity']} crossing counts"
            )
    for (model, limit), fit in fits.items():
        remarks += [f"{limit}, {model}: {remark}" for remark in fit.remarks]
    for limit_state in setting.limits:
        empty = [name for name, scene in setting.models.items() if not limit_state.applies(scene)]
        if empty:
            have = "have" if len(empty) > 1 else "has"
            remarks.append(f"{limit_state.name}: {' and '.join(empty)} {have} no goods that slide, and so no slip")
    remarks.append(
        "the scatter is that of the motions alone: friction, occupancy, stiffness and strength are as given"
        + ("" if method == "cloud" else ", and scaling leaves the shape of spectra as it is")
    )
    if "code_share" in settings:
        convention = "C of the real building" if settings["damping"] == "same" else "ratio in the model's own modes"
        remarks.append(
            f"code: {100.0 * settings['code_share']:g} % of the goods attached as mass, attached: all of them; "
            f"stiffness, strength and gravity load as in the real building; damping: {convention}"
        )
    return tuple(remarks)
