"""An analysis of fragility in lines: capacity and dispersion of every model, and what the rule makes of it."""

from __future__ import annotations

import math
import textwrap
from typing import TYPE_CHECKING, Any, Final

from seismass.base.values import counted

if TYPE_CHECKING:
    from seismass.fragility.result import FragilityAnalysis

_WIDTH: Final = 120
_METHODS: Final = {
    "hunt_fill": "incremental dynamic analysis, hunt and fill",
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


def _number(value: float | None, digits: str = ".3g") -> str:
    if value is None:
        return "unknown"
    return "none" if math.isinf(value) else f"{value:{digits}}"


def _between(low: float | None, high: float | None, digits: str = ".3g", scale: float = 1.0) -> str:
    if low is None or high is None:
        return ""
    ends = (f"{scale * end:{digits}}" if math.isfinite(end) else "none" for end in (low, high))
    return f" [{', '.join(ends)}]"


def _fitted(row: dict[str, Any]) -> str:
    if row["kind"] in ("never", "always", "falling", "none"):
        said = {
            "never": f"never exceeded up to {row['highest']:.3g}",
            "always": f"always exceeded from {row['lowest']:.3g} on",
            "falling": "not exceeded more often at higher intensities: no curve",
            "none": "too few runs for a curve",
        }
        return said[row["kind"]]
    median = _number(row["median"]) + _between(row["median_low"], row["median_high"])
    if row["kind"] == "step":
        return f"{median:23} unknown, a step"
    spread = _number(row["dispersion"], ".2f") + _between(row["dispersion_low"], row["dispersion_high"], ".2f")
    return f"{median:23} {spread}"


def _ratio(row: dict[str, Any], reference: str) -> str:
    if row["median_ratio"] is None or not math.isfinite(row["median_ratio"]):
        return f"  capacity of {row['model']} over {reference}: not known"
    interval = _between(row["median_ratio_low"], row["median_ratio_high"], ".2f")
    return f"  capacity of {row['model']} over {reference}: {row['median_ratio']:.2f}{interval}"


def _exceedance(row: dict[str, Any], reference: str) -> str:
    def percent(name: str) -> str:
        value = row[name]
        if value is None:
            return "unknown"
        return f"{100.0 * value:.1f} %" + _between(row[f"{name}_low"], row[f"{name}_high"], ".1f", 100.0)

    if row["model"] == reference:
        return f"  at {row['intensity']:.3g}: {reference} {percent('reference')}"
    difference = ""
    if row["difference"] is not None:
        points = f"{100.0 * row['difference']:+.1f} points"
        difference = f"; {points}{_between(row['difference_low'], row['difference_high'], '+.1f', 100.0)}"
    said = "unknown" if row["probability"] is None else f"{100.0 * row['probability']:.1f} %"
    where = f"where {row['model']} says {said} (at {row['intensity']:.3g})"
    return f"  {where}, {reference} has {percent('reference')}{difference}"
