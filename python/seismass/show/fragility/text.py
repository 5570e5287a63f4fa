"""An analysis of fragility in lines: capacity and dispersion of every model, and what the rule makes of it."""

from __future__ import annotations

import math
import textwrap
from typing import TYPE_CHECKING, Any, Final

from seismass.base.values import counted
from seismass.media.text_table import ends_text, number_text

if TYPE_CHECKING:
    from seismass.fragility.result import FragilityAnalysis

_WIDTH: Final = 120
_METHODS: Final = {
    "hunt_fill": "incremental dynamic analysis",
    "stripes": "stripes",
    "cloud": "cloud",
}


def analysis_text(result: FragilityAnalysis) -> str:
    """Return the text of an analysis."""
    unit = f" ({result.measure.unit})" if result.measure.unit else ""
    motions = counted(result.motions.height, "motion")
    lines = [f"{_METHODS[result.method]}: {motions}, {result.runs.height} runs; intensity {result.measure.label}{unit}"]
    share = f"{100.0 * result.metadata['confidence']:g} %"
    for limit in result.limits:
        lines += ["", f"limit     {limit.text}"]
        own = result.fragilities.filter(limit=limit.name)
        width = max(len(name) for name in result.models) + 2
        lines.append(f"  {'':{width}}{'median capacity':24}dispersion [{share} interval over the motions]")
        for row in own.iter_rows(named=True):
            lines.append(f"  {row['model']:{width}}{_fitted(row)}")
        missing = [name for name in result.models if name not in own["model"].to_list()]
        lines += [f"  {name:{width}}has no such quantity" for name in missing]
        lines += [
            _ratio(row, result.reference) for row in result.comparison.filter(limit=limit.name).iter_rows(named=True)
        ]
        rows = result.exceedance.filter(limit=limit.name)
        lines += [_exceedance(row, result.reference) for row in rows.iter_rows(named=True)]
    if result.remarks:
        lines.append("")
    for remark in result.remarks:
        lines += textwrap.wrap(remark, _WIDTH, initial_indent="remark    ", subsequent_indent=10 * " ")
    return "\n".join(lines)


def _fitted(row: dict[str, Any]) -> str:
    if row["kind"] in ("never", "always", "falling", "none"):
        said = {
            "never": f"never exceeded up to {row['highest']:.3g}",
            "always": f"always exceeded from {row['lowest']:.3g} on",
            "falling": "not exceeded more often at higher intensities: no curve",
            "none": "too few runs for a curve",
        }
        return said[row["kind"]]
    median = _known(row, "median", ".3g")
    if row["kind"] == "step":
        return f"{median:23} unknown, a step"
    return f"{median:23} {_known(row, 'dispersion', '.2f')}"


def _known(row: dict[str, Any], name: str, form: str) -> str:
    """A number with its interval; "none" where it is infinite."""
    ends = ends_text(row[f"{name}_low"], row[f"{name}_high"], form, infinite="none")
    return number_text(row[name], form, missing="unknown", infinite="none") + ends


def _ratio(row: dict[str, Any], reference: str) -> str:
    if row["median_ratio"] is None or not math.isfinite(row["median_ratio"]):
        return f"  capacity of {row['model']} over {reference}: not known"
    interval = ends_text(row["median_ratio_low"], row["median_ratio_high"], infinite="none")
    return f"  capacity of {row['model']} over {reference}: {row['median_ratio']:.2f}{interval}"


def _exceedance(row: dict[str, Any], reference: str) -> str:
    def percent(name: str) -> str:
        if row[name] is None:
            return "unknown"
        ends = ends_text(row[f"{name}_low"], row[f"{name}_high"], ".1f", scale=100.0, infinite="none")
        return f"{100.0 * row[name]:.1f} %{ends}"

    if row["model"] == reference:
        return f"  at {row['intensity']:.3g}: {reference} {percent('reference')}"
    difference = ""
    if row["difference"] is not None:
        points = f"{100.0 * row['difference']:+.1f} points"
        ends = ends_text(row["difference_low"], row["difference_high"], "+.1f", scale=100.0, infinite="none")
        difference = f"; {points}{ends}"
    said = "unknown" if row["probability"] is None else f"{100.0 * row['probability']:.1f} %"
    given = f"at {row['intensity']:.3g}: probability {said} by {row['model']}"
    return f"  {given}, {percent('reference')} by {reference}{difference}"
