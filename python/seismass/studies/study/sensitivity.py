"""What the choices that the paper does not state do to the study's headline numbers, one choice at a time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, ClassVar, Final, get_args

import numpy as np
import polars as pl

from seismass.base.arguments import Progress, ProgressLike
from seismass.base.errors import InvalidOption
from seismass.base.stored_results import NOTHING_STORED, StoredResults
from seismass.base.values import as_one_of, short_repr
from seismass.design import Combination
from seismass.design.scaling import ScalingResult, scale_modal_pushover
from seismass.media.result import Result, finite_values
from seismass.motions.matching import match_suite
from seismass.motions.records import Suite
from seismass.motions.spectra import TargetSpectrum
from seismass.studies.study.parameters import MODELS, DampingBase, StudyParameters
from seismass.studies.study.run import StudyResult, checked_study, run_study
from seismass.studies.study.tables import TABLES, Drifts, collapsed_of, drifts_of, geometric_mean

AS_IS: Final = "as it is"
"""The first choice: the study with its own parameters."""
DAMPING_BASE: Final = "damping base"

SECOND_SLOPES: Final = (0.0, 0.02, 0.1, 0.2)
OVERSTRENGTHS: Final = (1.0, 1.5, 3.0)
TILTS: Final = (-0.3, 0.3)
"""Powers of the period (s) by which the target is multiplied: less and more demand at long periods, equal at 1 s."""
SCALING_PERIODS: Final = (0.5, 1.5)
MATCHED_RANGE: Final = (0.2, 1.5)
"""Range of periods that motions are matched in, as multiples of the period of scaling."""
MATCHED_TOLERANCE: Final = 0.10
"""Largest misfit of their spectra, reached in a few passes. A closer match of single records takes up to thirty, whose
last digits decide about the next pass; the mean of the suite is closer to the target than its records."""
_KEYS: Final = ("occupancy", "mu", "R", "alpha", "storey")
"""Columns of the summary by which its rows are grouped."""
_COLLAPSES: Final = tuple(f"collapses_{model}" for model in MODELS)
MOTIONS: Final = "motions"
"""The choice how motions are brought to the target."""


@dataclass(frozen=True)
class _Change:
    """One choice, its setting, and the study with it alone changed."""

    choice: str
    setting: str
    parameters: StudyParameters
    target: TargetSpectrum
    motions: Callable[[], tuple[Suite, ScalingResult | None]]
    """Makes the suite and its factors when the study is run: matching takes longer than all studies."""


@dataclass(frozen=True, eq=False)
class Sensitivity(Result):
    """Headline numbers of a study under one changed choice at a time.

    Attributes
    ----------
    table : polars.DataFrame
        One row per setting, occupancy and friction coefficient; columns in docs/study_schema.md.
    metadata : dict
        Metadata of the study as it is.
    """

    document: ClassVar[str] = "sensitivity"

    table: pl.DataFrame
    metadata: dict[str, Any] = field(repr=False)

    __repr__ = short_repr

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The table by its name: sensitivity."""
        return {"sensitivity": self.table}

    def to_dict(self) -> dict[str, Any]:
        """Return the rows, and the metadata of the study as it is, as plain values."""
        return finite_values({"sensitivity": self.table.to_dicts(), "metadata": self.metadata})

    @property
    def figure_names(self) -> tuple[str, ...]:
        """sensitivity: a dot per choice and occupancy, beside lines of the study as it is."""
        return ("sensitivity",)


def study_sensitivity(
    suite: Suite,
    target: TargetSpectrum,
    parameters: StudyParameters | None = None,
    *,
    as_is: StudyResult | None = None,
    threads: int | None = None,
    progress: ProgressLike = None,
    store: StoredResults = NOTHING_STORED,
) -> Sensitivity:
    """Run the study again with each choice changed alone, from springs and damping to the statistic over records.

    The statistic and the records left out change no run: the drifts are those of the study as it is, and with a record
    left out the factors of the others stay.

    Parameters
    ----------
    suite, target, parameters, threads
        As for `run_study`.
    as_is : StudyResult, optional
        The study of these, where it has been run.
    progress : callable, optional
        Called with (studies done, studies in all).
    store : StoredResults, optional
        What an interrupted call of the same inputs has left, and where this one leaves what is done.

    Raises
    ------
    InvalidOption, InvalidMotion, KeyboardInterrupt
        As for `run_study`.
    """
    setup = checked_study(suite, target, parameters, store)
    if as_is is not None:
        as_one_of(as_is, StudyResult, "as_is", "study", InvalidOption)
    changes = [*_changes(setup, target, suite), *_motion_changes(setup, target, suite, threads)]
    whole = Progress(progress, len(changes) + 1, "study")
    if as_is is None:
        as_is = run_study(suite, target, setup, threads=threads)
    base_drifts, fallen = drifts_of(as_is.responses, len(suite), setup), collapsed_of(as_is.responses, len(suite))
    summary = as_is.summary
    rows = _rows(AS_IS, "", summary, base_drifts, np.mean)
    of_base: dict[str, tuple[pl.DataFrame, Drifts]] = {setup.damping_base: (summary, base_drifts)}
    for number, change in enumerate(changes, start=1):
        whole.tell()
        table = store.of(f"changed-{number}", partial(_study_of, change, threads))
        drifts: Drifts = {model: np.array(table[model].to_list()) for model in MODELS}
        rows += _rows(change.choice, change.setting, table, drifts, np.mean)
        if change.choice == DAMPING_BASE:
            of_base[change.parameters.damping_base] = (table, drifts)
            if len(of_base) == len(get_args(DampingBase)):
                (keys, loaded), (of_own, alone) = of_base["loaded"], of_base["own"]
                keys, mixed = keys.with_columns(of_own["collapses_code"]), {**loaded, "code": alone["code"]}
                rows += _rows(DAMPING_BASE, "loaded, of the code model its own", keys, mixed, np.mean)
    rows += _rows("statistic", "median", summary, base_drifts, np.median)
    rows += _rows("statistic", "geometric mean", summary, base_drifts, geometric_mean)
    for left_out in _heaviest(as_is):
        name = as_is.metadata["suite"]["motions"][left_out]["record"]
        others: Drifts = {model: np.delete(values, left_out, axis=1) for model, values in base_drifts.items()}
        counts = {f"collapses_{model}": np.delete(fell, left_out, axis=1).sum(axis=1) for model, fell in fallen.items()}
        rows += _rows("one record left out", name, summary.with_columns(**counts), others, np.mean)
    whole.tell()
    rows_of_changes = pl.DataFrame(rows, schema=list(TABLES["sensitivity"][1]), orient="row").with_columns(
        pl.col("collapses").cast(pl.UInt32)
    )
    return Sensitivity(rows_of_changes, as_is.metadata)


def _study_of(change: _Change, threads: int | None) -> pl.DataFrame:
    """Keys of the summary of a changed study, and the drifts of each model as a column of lists."""
    suite, scaling = change.motions()
    result = run_study(suite, change.target, change.parameters, scaling=scaling, threads=threads)
    drifts = drifts_of(result.responses, len(suite), change.parameters)
    lists = {model: pl.Series(values.tolist(), dtype=pl.List(pl.Float64)) for model, values in drifts.items()}
    return result.summary.select(*_KEYS, *_COLLAPSES).with_columns(**lists)


def _changes(setup: StudyParameters, target: TargetSpectrum, suite: Suite) -> Iterator[_Change]:
    """Changes of parameters and of the target; settings that are the study's own are left out."""

    def changed(choice: str, setting: str, spectrum: TargetSpectrum = target, **parameters: Any) -> _Change:
        return _Change(choice, setting, replace(setup, **parameters), spectrum, lambda: (suite, None))

    for slope in SECOND_SLOPES:
        if slope != setup.second_slope:
            third = min(setup.third_slope, slope)
            yield changed("r2", f"{slope:g}", second_slope=slope, third_slope=third)
    if setup.third_slope != setup.second_slope:
        yield changed("r3", f"{setup.second_slope:g}, as r2", third_slope=setup.second_slope)
    for factor in OVERSTRENGTHS:
        if factor != setup.overstrength:
            yield changed("Omega", f"{factor:g}", overstrength=factor)
    at_r1 = not setup.yield_at_r1
    yield changed("R = 1", "yields at V_e" if at_r1 else "elastic", yield_at_r1=at_r1)
    other: Combination = "cqc" if setup.combination == "srss" else "srss"
    yield changed("combination", other.upper(), combination=other)
    for base in get_args(DampingBase):
        if base != setup.damping_base:
            yield changed(DAMPING_BASE, base, damping_base=base)
    if not setup.p_delta:
        yield changed("P-Delta", f"storeys of {setup.height:g} m", p_delta=True)
    for power in TILTS:
        yield changed("target shape", f"times (T/1 s)^{power:g}", target.tilted(power))
    for period in SCALING_PERIODS:
        if period != setup.scaling_period:
            yield changed("scaling period", f"{period:g} s", scaling_period=period)


def _motion_changes(
    setup: StudyParameters, target: TargetSpectrum, suite: Suite, threads: int | None
) -> Iterator[_Change]:
    """Changes of how motions are brought to the target: factors of modal pushover (period and springs of the study, a
    setting per R above 1), and matched motions, scaled so that their mean is not below the target.
    """
    shortest, longest = (setup.scaling_period * multiple for multiple in MATCHED_RANGE)

    def pushover(reduction: float) -> tuple[Suite, ScalingResult]:
        return suite, scale_modal_pushover(
            suite,
            target,
            period=setup.scaling_period,
            reduction=reduction,
            overstrength=setup.overstrength,
            second_slope=setup.second_slope,
            third_slope=setup.third_slope,
            damping=setup.damping,
            threads=threads,
        )

    def matched() -> tuple[Suite, None]:
        result = match_suite(
            suite,
            target,
            periods=(shortest, longest),
            damping=setup.damping,
            tolerance=MATCHED_TOLERANCE,
            threads=threads,
        )
        return result.suite, None

    for reduction in setup.response_modification:
        if reduction > 1.0:
            yield _Change(MOTIONS, f"modal pushover, R_y = {reduction:g}", setup, target, partial(pushover, reduction))
    setting = f"matched, {100.0 * MATCHED_TOLERANCE:g} %, {shortest:g} to {longest:g} s"
    yield _Change(MOTIONS, setting, setup, target, matched)


def _heaviest(result: StudyResult) -> list[int]:
    """Indices of the records that change the largest first-storey underestimation of an occupancy most."""
    first = result.summary.filter(storey=1).drop_nulls("leave_one_out_motion")
    rows = first.sort("underestimation_percent", descending=True).unique(
        ["occupancy", "mu"], keep="first", maintain_order=True
    )
    return [int(number) - 1 for number in rows["leave_one_out_motion"].unique(maintain_order=True)]


def _rows(
    choice: str, setting: str, keys: pl.DataFrame, drifts: Drifts, statistic: Callable[..., Any]
) -> list[tuple[Any, ...]]:
    """Headline numbers of the first storeys by a statistic over the records; null where one is not finite."""
    with np.errstate(divide="ignore", invalid="ignore"):
        sliding, code, attached = (statistic(drifts[model], axis=1) for model in MODELS)
        compared = {
            "missed": 100.0 * (sliding / code - 1.0),
            "mass": 100.0 * (attached / code - 1.0),
            "sliding": 100.0 * (sliding / attached - 1.0),
        }
    frame = keys.select(*_KEYS, collapses=pl.sum_horizontal(_COLLAPSES)).with_columns(
        **{name: pl.Series(values) for name, values in compared.items()}
    )
    rows = []
    for (occupancy, mu), first in frame.filter(storey=1).group_by("occupancy", "mu", maintain_order=True):
        # NaN of one building is NaN of the mean and of the largest: no number is of fewer buildings.
        heavy = first.filter(alpha=first["alpha"].max())
        least, most = heavy.filter(R=first["R"].min()), heavy.filter(R=first["R"].max())
        largest = np.max(first["missed"].to_numpy())
        values = [largest, least["missed"].mean(), *(most[name].mean() for name in compared)]
        known = [value if value is not None and np.isfinite(value) else None for value in values]
        rows.append((choice, setting, occupancy, mu, *known, first["collapses"].sum()))
    return rows
