"""An analysis of fragility in lines: capacity and dispersion of every model, and what the rule makes of it."""

from __future__ import annotations

import math
import textwrap
from typing import TYPE_CHECKING, Any, Final

from seismass.base.values import counted
from seismass.media.roles import model_name
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
        names = {name: model_name(name) for name in result.models}
        width = max(map(len, names.values())) + 2
        lines.append(f"  {'':{width}}{'median capacity':24}dispersion [{share} interval over the motions]")
        for row in own.iter_rows(named=True):
            lines.append(f"  {names[row['model']]:{width}}{_fitted(row)}")
        missing = [name for name in result.models if name not in own["model"].to_list()]
        lines += [f"  {names[name]:{width}}has no such quantity" for name in missing]
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
        return f"  capacity of {model_name(row['model'])} over {model_name(reference)}: not known"
    interval = ends_text(row["median_ratio_low"], row["median_ratio_high"], infinite="none")
    over = f"{model_name(row['model'])} over {model_name(reference)}"
    return f"  capacity of {over}: {row['median_ratio']:.2f}{interval}"


def _exceedance(row: dict[str, Any], reference: str) -> str:
    def percent(name: str) -> str:
        if row[name] is None:
            return "unknown"
        ends = ends_text(row[f"{name}_low"], row[f"{name}_high"], ".1f", scale=100.0, infinite="none")
        return f"{100.0 * row[name]:.1f} %{ends}"

    if row["model"] == reference:
        return f"  at intensity {row['intensity']:.3g}: {model_name(reference)} {percent('reference')}"
    difference = ""
    if row["difference"] is not None:
        points = f"{100.0 * row['difference']:+.1f} points"
        ends = ends_text(row["difference_low"], row["difference_high"], "+.1f", scale=100.0, infinite="none")
        difference = f"; {points}{ends}"
    said = "unknown" if row["probability"] is None else f"{100.0 * row['probability']:.1f} %"
    model = f"at {row['intensity']:.3g}: {model_name(row['model'])} {said}"
    return f"  {model}, {model_name(reference)} {percent('reference')}{difference}"
