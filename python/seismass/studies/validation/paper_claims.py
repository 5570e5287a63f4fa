"""The claims of the paper's abstract, sections 4 and 5 and conclusions, each with our numbers and what it depends on.

Verdicts are computed from tables by the rules that stand with each claim, and by nothing else.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Final, Literal, TypeAlias

import numpy as np
import polars as pl

from seismass.base.errors import InvalidOption
from seismass.base.values import as_one_of, signed
from seismass.studies.study import Sensitivity, StudyResult
from seismass.studies.validation.shaking_table import MASS_RATIOS, Platform
from seismass.studies.validation.three_storeys import OPENSEES, Section4

Verdict: TypeAlias = Literal["reproduced", "depends", "not reproduced", "not tested"]

SAME_SERIES_PERCENT: Final = 1.0
"""Difference of histories over the largest drift up to which they are "essentially the same": below a line's width."""
MOST: Final = 0.9
"""Share of all cases from which on a statement holds."""
AS_LARGE_AS: Final = 100.0
"""Underestimation that the paper gives as the largest (%)."""
CLOSE: Final = 10.0
"""Difference from it that the paper's rounding allows (%)."""
PLACES: Final = ("first", "middle", "top")
"""Places of storeys in a building."""
_ROUNDING: Final = 1e-7
"""Underestimations (%) that differ by less are the same."""


@dataclass(frozen=True)
class Claim:
    """One claim.

    Attributes
    ----------
    number : int
        Its place in the table, from 1.
    source : str
        Where the paper makes it.
    claim : str
        What it says.
    verdict : {"reproduced", "depends", "not reproduced", "not tested"}
        Whether it holds here.
    numbers : str
        Our numbers.
    depends_on : str
        What the verdict depends on; empty where on nothing that was varied.
    """

    number: int
    source: str
    claim: str
    verdict: Verdict
    numbers: str
    depends_on: str


_Row: TypeAlias = tuple[str, str, Verdict, str, str]


def claims(
    study: StudyResult,
    section4: Section4 | None = None,
    platform: Platform | None = None,
    *,
    sensitivity: Sensitivity | None = None,
) -> list[Claim]:
    """Return the claims of the paper with our numbers.

    Parameters
    ----------
    study : StudyResult
        Result of `run_study`.
    section4 : Section4, optional
        Result of `section4`; claims on it are left out without it.
    platform : Platform, optional
        Result of `platform`; as section4.
    sensitivity : Sensitivity, optional
        Result of `study_sensitivity`; adds how far the largest underestimation changes with each choice.

    Returns
    -------
    list of Claim
        In the order of the paper: the shaking table, the comparison of programs, the study.
    """
    wanted = {"study": StudyResult, "section4": Section4, "platform": Platform, "sensitivity": Sensitivity}
    for (name, kind), result in zip(wanted.items(), (study, section4, platform, sensitivity), strict=True):
        as_one_of(result, kind if name == "study" else (kind, type(None)), name, "validation", InvalidOption)
    rows: list[_Row] = []
    if platform is not None:
        rows.append(_shaking_table(platform))
    if section4 is not None:
        rows += _comparison(section4)
    rows += _study(study, sensitivity)
    return [Claim(number, *row) for number, row in enumerate(rows, start=1)]


def claims_table(claims: list[Claim]) -> pl.DataFrame:
    """Return claims as a table, one row each; columns are the attributes of `Claim`."""
    return pl.DataFrame([vars(item) for item in claims], schema_overrides={"number": pl.UInt8})


def _shaking_table(platform: Platform) -> _Row:
    robust = platform.robust
    low, _, high = robust["heavier"]
    return (
        "section 4, abstract",
        "The calculated drift of a platform at 1:15 is similar to that measured on a shaking table.",
        "not tested",
        f"The measured drift is not published as numbers. Over the ranges the block slides in {robust['slides']} of "
        f"{robust['runs']} runs and lowers the drift in {robust['below_attached']} of these; the drift with alpha = "
        f"{MASS_RATIOS[1]:g} is {low:.2f} to {high:.2f} of that with {MASS_RATIOS[0]:g} (5 to 95 %).",
        f"period of the platform (drift changes by a factor of {robust['by_period']:.0f} over its range), friction "
        f"({robust['by_mu']:.1f}), damping ({robust['by_damping']:.1f}); none is published",
    )


def _comparison(section4: Section4) -> Iterator[_Row]:
    others = section4.differences.filter(pl.col("drift_percent").is_not_null())
    finest = others.group_by("component", "second_slope", "program", maintain_order=True).last()
    drift, slip = (float(np.max([0.0, *finest[f"{name}_percent"].drop_nulls()])) for name in ("drift", "slip"))
    programs = sorted(set(finest["program"]))
    same = max(drift, slip) <= SAME_SERIES_PERCENT
    missing = "" if OPENSEES in programs else " OpenSees has no kept results for this motion."
    yield (
        "section 4, abstract",
        "The model and two finite-element programs produce essentially the same time series of drift and slip.",
        ("reproduced" if same else "not reproduced") if finest.height else "not tested",
        f"Largest difference from the exact kernel over {finest.height} histories of {' and '.join(programs)}, with "
        f"the stiffest friction spring: drift {_few_digits(drift)} %, slip {_few_digits(slip)} % of the largest."
        f"{missing}",
        "stiffness of the springs that stand for friction; the difference is inversely proportional to it",
    )
    runs = section4.runs
    yielding = int(runs["all_yield"].sum())
    yield (
        "section 4",
        "Restoring forces in all three storeys reach yielding.",
        _of_share(yielding / runs.height),
        f"In {yielding} of {runs.height} runs: {_ranges(runs)}.",
        "",
    )
    sliding = runs.filter(pl.col("slides_most").is_not_null())
    first = sliding.filter(slides_most=1)
    by_slope = "; ".join(
        f"r2 = {slope:g}: {rows.filter(slides_most=1).height} of {rows.height}"
        for (slope,), rows in sliding.group_by("second_slope", maintain_order=True)
    )
    by_component = "; ".join(
        f"{name}: {rows.filter(slides_most=1).height} of {rows.height}"
        for (name,), rows in sliding.group_by("component", maintain_order=True)
    )
    yield (
        "section 4",
        "Sliding occurs mostly at the first floor.",
        _of_share(first.height / sliding.height) if sliding.height else "not tested",
        f"The block of the first floor slides most in {first.height} of {sliding.height} runs in which any slides. By "
        f"component: {by_component}. By second slope: {by_slope}.",
        "second slope r2, component and scale of the record; the paper states none",
    )


def _few_digits(value: float) -> str:
    """A small number with two digits, without a power of ten."""
    return np.format_float_positional(value, precision=2, fractional=False, trim="-")


def _ranges(runs: pl.DataFrame) -> str:
    slopes, peaks = runs["second_slope"].unique().sort(), runs["peak_g"].unique().sort()
    components = runs["component"].n_unique()
    return (
        f"{components} component{'s' * (components > 1)}, r2 from {slopes[0]:g} to {slopes[-1]:g}, peaks from "
        f"{peaks[0]:g} to {peaks[-1]:g} g"
    )


def _of_share(share: float) -> Verdict:
    if share >= MOST:
        return "reproduced"
    return "depends" if share > 0.0 else "not reproduced"


def _study(study: StudyResult, sensitivity: Sensitivity | None) -> Iterator[_Row]:
    missed = pl.col("underestimation_percent")
    rows = study.summary.filter(missed.is_finite()).with_columns(
        place=pl.when(pl.col("storey") == 1)
        .then(pl.lit("first"))
        .when(pl.col("storey") == pl.col("storeys"))
        .then(pl.lit("top"))
        .otherwise(pl.lit("middle"))
    )
    yielding = rows.filter(pl.col("R") > 1.0)
    for (occupancy,), rows_of_occupancy in yielding.group_by("occupancy", maintain_order=True):
        share = 100.0 * rows_of_occupancy["lambda_analysis"][0]
        below = rows_of_occupancy.filter(missed > _ROUNDING)
        yield (
            "abstract, conclusions",
            f"With {share:g} % of the live load as mass ({occupancy}), drift demands of yielding buildings are "
            "underestimated.",
            _of_share(below.height / rows_of_occupancy.height),
            f"Mean peak drift is underestimated in {_by_place(below, rows_of_occupancy)}.",
            "storey: heavy goods below a bare roof concentrate yielding in the lower storeys",
        )
    yield _commercial(yielding)
    first = rows.filter(place="first")
    for name, claim in (("alpha", "block-to-floor mass ratios alpha"), ("R", "response modification factors R")):
        steps, grows = _steps(rows, name)
        steps_first, grows_first = _steps(first, name)
        yield (
            "section 5, conclusions",
            f"The underestimation is larger for greater {claim}.",
            _of_growth(grows / steps, grows_first / steps_first) if steps and steps_first else "not tested",
            f"It grows in {grows} of {steps} steps of {name} over all storeys, in {grows_first} of {steps_first} of "
            f"first storeys. {_means(first, name)}",
            "storey" if name == "alpha" else "storey, second slope and overstrength",
        )
    yield _periods(yielding.filter(place="first"))
    yield _largest(yielding, sensitivity)
    yield _less_sliding(first)


def _of_growth(share: float, share_first: float) -> Verdict:
    if share >= MOST:
        return "reproduced"
    return "depends" if share_first > 0.5 else "not reproduced"


def _by_place(some: pl.DataFrame, every: pl.DataFrame) -> str:
    """How many storeys of all, and by their place."""
    counts = [
        f"{place} storeys {some.filter(place=place).height} of {rows.height}"
        for place in PLACES
        if (rows := every.filter(place=place)).height
    ]
    return f"{some.height} of {every.height} storeys: {', '.join(counts)}"


def _commercial(yielding: pl.DataFrame) -> _Row:
    keys = ["storeys", "R", "alpha", "mu", "storey"]
    more, less = (yielding.filter(lambda_analysis=share) for share in _least_and_next(yielding))
    both = more.join(less, on=keys, suffix="_less")
    larger = both.filter(pl.col("underestimation_percent") > pl.col("underestimation_percent_less"))
    names = more["occupancy"][0] if more.height else "", less["occupancy"][0] if less.height else ""
    claim = "The underestimation is larger for commercial facilities than for storage facilities."
    if not both.height:
        return "section 5", claim, "not tested", "The study has one occupancy.", ""
    return (
        "section 5",
        claim,
        _of_share(larger.height / both.height),
        f"Of yielding buildings, {names[0]} against {names[1]}, in {_by_place(larger, both)}.",
        "storey" if larger.height < both.height else "",
    )


def _least_and_next(rows: pl.DataFrame) -> tuple[float, float]:
    """The least fraction of the analyses and the next."""
    shares = rows["lambda_analysis"].unique().sort().to_list()
    return (shares[0], shares[1]) if len(shares) > 1 else (shares[0], float("nan"))


def _steps(rows: pl.DataFrame, varied: str) -> tuple[int, int]:
    """Pairs of storeys that differ by one step of a quantity alone, and in how many the underestimation grows."""
    keys = [name for name in ("occupancy", "mu", "storeys", "storey", "R", "alpha") if name != varied]
    step = rows.sort(varied).select(pl.col("underestimation_percent").diff().over(keys))["underestimation_percent"]
    return step.count(), int((step > _ROUNDING).sum())


def _means(first: pl.DataFrame, varied: str) -> str:
    means = first.group_by(varied).agg(pl.col("underestimation_percent").mean()).sort(varied)
    text = ", ".join(f"{signed(mean)} % at {varied} = {value:g}" for value, mean in means.rows())
    return f"Mean of first storeys: {text}."


def _periods(first: pl.DataFrame) -> _Row:
    """Buildings of the study have one period per number of storeys."""
    keys = ["occupancy", "mu", "R", "alpha"]
    step = first.sort("period").select(pl.col("underestimation_percent").diff().over(keys))["underestimation_percent"]
    count, grows = step.count(), int((step > _ROUNDING).sum())
    means = first.group_by("period").agg(pl.col("underestimation_percent").mean()).sort("period")
    text = ", ".join(f"{signed(mean)} % at T = {period:g} s" for period, mean in means.rows())
    share = grows / count if count else 0.0
    verdict: Verdict = "reproduced" if share >= MOST else "depends" if share > 0.5 else "not reproduced"
    return (
        "abstract",
        "Results obtained with the code are highly unconservative for long-period buildings.",
        verdict if count else "not tested",
        f"First storeys of yielding buildings: {text}; the underestimation grows in {grows} of {count} steps of the "
        "period.",
        "number of storeys: period and storeys change together in the study",
    )


def _largest(yielding: pl.DataFrame, sensitivity: Sensitivity | None) -> _Row:
    claim = "The difference between the actual and the code's drift demand can be as large as 100 %."
    if not yielding.height:
        return "section 5", claim, "not tested", "No building of the study yields.", ""
    parts, verdicts = [], []
    for (occupancy,), rows in yielding.group_by("occupancy", maintain_order=True):
        row = rows.sort("underestimation_percent", descending=True).row(0, named=True)
        largest, left_out = row["underestimation_percent"], row["leave_one_out_percent"]
        robust = left_out is not None and np.isfinite(left_out) and left_out >= AS_LARGE_AS - CLOSE
        verdicts.append((largest >= AS_LARGE_AS - CLOSE, robust))
        record = row["leave_one_out_record"]
        parts.append(
            f"{occupancy}: {signed(largest)} % (storey {row['storey']} of {row['storeys']}, R = {row['R']:g}, alpha = "
            f"{row['alpha']:g}), median of the motions {signed(row['median_underestimation_percent'])} %"
            + (f", {signed(left_out)} % without {record}" if record is not None else "")
        )
    reached = any(largest for largest, _ in verdicts)
    robust = all(left_out for _, left_out in verdicts)
    verdict: Verdict = "reproduced" if robust else "depends" if reached else "not reproduced"
    depends = "one record, and the statistic over the records"
    if sensitivity is not None:
        spans = [
            f"{occupancy} {signed(low)} to {signed(high)} %"
            for occupancy, low, high in sensitivity.table.group_by("occupancy", maintain_order=True)
            .agg(low=pl.col("largest_percent").min(), high=pl.col("largest_percent").max())
            .rows()
        ]
        depends += f"; over all choices of the sensitivity study, first storeys: {', '.join(spans)}"
    return "section 5", claim, verdict, f"{'. '.join(parts)}.", depends


def _less_sliding(first: pl.DataFrame) -> _Row:
    """What sliding does to first storeys, real over attached, at each R."""
    change = 100.0 * (pl.col("ratio_sliding") - 1.0)
    by_change = first.with_columns(sliding=change.abs(), change=change)
    means = by_change.group_by("R").agg(pl.col("sliding").mean(), pl.col("change").mean()).sort("R")
    values = means["sliding"].to_list()
    falls = all(after < before for before, after in pairwise(values)) and len(values) > 1
    keys = ["occupancy", "mu", "storeys", "storey", "R"]
    step = by_change.sort("alpha").select("R", step=pl.col("sliding").diff().over(keys)).drop_nulls()
    less = step.filter(pl.col("step") < -_ROUNDING)
    with_alpha = ", ".join(
        f"R = {factor:g}: {less.filter(R=factor).height} of {rows.height}"
        for (factor,), rows in step.sort("R").group_by("R", maintain_order=True)
    )
    text = ", ".join(
        f"{signed(change, '+.1f')} % at R = {factor:g} (size {size:.1f} %)" for factor, size, change in means.rows()
    )
    verdict: Verdict = "not reproduced"
    if falls:
        verdict = "reproduced" if step.height and less.height / step.height >= MOST else "depends"
    return (
        "section 5, conclusions",
        "With greater R and alpha floors accelerate less, goods slide less and act as if attached.",
        verdict,
        f"Mean change of first-storey drift by sliding: {text}. Its size falls with alpha in {less.height} of "
        f"{step.height} steps ({with_alpha}).",
        "R rather than alpha" if verdict == "depends" else "",
    )
