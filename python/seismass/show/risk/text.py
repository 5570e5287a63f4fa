"""A risk-targeted share as lines of text: the share, annual rates, what they depend on, remarks."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from seismass.base.values import counted
from seismass.effective_mass.curve import Kind
from seismass.effective_mass.result import KIND_TEXTS as EFFECTIVE_KINDS
from seismass.media.roles import model_name
from seismass.media.text_table import interval_text, number_text, text_line
from seismass.show.slip.text import remark_lines

if TYPE_CHECKING:
    from seismass.risk.result import RiskTargetedShare

KIND_TEXTS: Final[dict[Kind, str]] = {
    "stuck": "no goods slide up to the limit, so that all of them act as mass",
    "root": "one share gives the annual rate with sliding goods",
    "multiple": "several shares give the annual rate with sliding goods, the largest counts",
    "zero": "no share gives a lower rate than sliding goods do, so that none needs to be attached",
    "one": "even with all goods attached the model exceeds the limit less often than with sliding goods",
}
"""What each kind means."""
_LABEL: Final = 21
_RATES: Final = (-22, 34, 13, 26)
_CHANGES: Final = (-30, 22, 10, 12, 16)


def risk_text(result: RiskTargetedShare) -> str:
    """Return `RiskTargetedShare.text`."""
    percent = f"{100.0 * result.confidence:g} %"
    about = result.metadata
    motions = counted(about["motions"], "motion")
    lines = [
        f"risk-targeted share  {result.value:.3f}{_interval(result.interval, percent)}",
        f"                     {KIND_TEXTS[result.kind]}",
        f"limit                {result.limit.text} under {motions}; {result.measure.label}, "
        f"{result.estimator} fragilities",
        f"hazard               {result.hazard.label or 'as given'}: {result.hazard.sa_g[0]:g} to "
        f"{result.hazard.sa_g[-1]:g} g{', extrapolated' if about['extrapolate'] else ''}",
    ]
    effective = result.effective
    if effective is not None:
        level = result.hazard.intensity(about["design_rate"])
        at = f"at {level:.3g} g, {1.0 / about['design_rate']:.0f} years"
        why = "" if math.isfinite(effective.value) else f": {EFFECTIVE_KINDS[effective.kind]}"
        lines.append(f"effective fraction   {effective.value_text}{_interval(effective.interval, percent)} {at}{why}")
    lines += [
        "",
        f"Annual rate of exceeding the limit, with its {percent} interval over the motions",
        text_line(("model", "rate (1/year)", "in 50 years", "slide / model"), _RATES),
    ]
    for row in result.rates.iter_rows(named=True):
        name = model_name(row["model"]) + (f", {row['share']:g}" if row["model"] == "code" else "")
        rate = interval_text(row["rate"], row["rate_low"], row["rate_high"], ".3g")
        ratio = interval_text(row["real_over_model"], row["real_over_model_low"], row["real_over_model_high"], ".2f")
        ratio = "" if row["model"] == "real" else ratio
        lines.append(text_line((name, rate, f"{100.0 * row['probability_50_years']:.2g} %", ratio), _RATES))
    lines += [
        "",
        "What the share depends on",
        text_line(("changed", "share", "kind", "slide rate", "slide / code"), _CHANGES),
    ]
    for row in result.sensitivity.iter_rows(named=True):
        name = f"{row['parameter']} {row['setting']}".strip()
        share = interval_text(row["value"], row["low"], row["high"], ".2f")
        cells = (name, share, row["kind"], f"{row['real_rate']:.2g}", number_text(row["real_over_code"]))
        lines.append(text_line(cells, _CHANGES))
    return "\n".join([*lines, "", *remark_lines(result.remarks, _LABEL)])


def _interval(ends: tuple[float, float] | None, percent: str) -> str:
    return "" if ends is None else f" ({percent} interval {ends[0]:.2f} to {ends[1]:.2f})"
