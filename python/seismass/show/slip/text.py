"""A slip demand as lines of text: slip and its scatter, the ground, clearances, size, estimates, remarks."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Final

from seismass.base.values import counted
from seismass.slip.estimates import TITLES

if TYPE_CHECKING:
    from seismass.slip.result import SlipDemand

_LABEL: Final = 12


def slip_demand_text(result: SlipDemand) -> str:
    """Return `SlipDemand.text`."""
    lines = _blocks(result)
    for part in (_exceedance(result), _squat(result), _estimates(result)):
        if part:
            lines += ["", *part]
    return "\n".join([*lines, "", *remark_lines(result.remarks, _LABEL)])


def remark_lines(remarks: Iterable[str], indent: int) -> list[str]:
    """Return remarks as lines of at most 120 characters, indented by their label."""
    lines = []
    for remark in remarks:
        first = f"{'remark':{indent}}"
        lines += textwrap.wrap(remark, 120, initial_indent=first, subsequent_indent=" " * indent)
    return lines


def _blocks(result: SlipDemand) -> list[str]:
    motions = counted(result.metadata["motions"], "motion")
    lines = [
        f"Peak slip (mm): mean of {motions} [16 %, 84 % of them], largest; share of motions that slide",
        f"  {'block':16}{'in the building':>30}{'largest':>9}{'slides':>8}{'on the ground':>30}{'slides':>8}",
    ]
    for row in result.blocks.iter_rows(named=True):
        name = f"{row['block']}, {_floor(row['floor'])}"
        here = f"{_mm(row['mean'])} [{_mm(row['p16'])}, {_mm(row['p84'])}]"
        ground = f"{_mm(row['ground_mean'])} [{_mm(row['ground_p16'])}, {_mm(row['ground_p84'])}]"
        lines.append(
            f"  {name:16}{here:>30}{_mm(row['largest']):>9}{_percent(row['slides']):>8}{ground:>30}"
            f"{_percent(row['ground_slides']):>8}"
        )
    lines += ["", "Slip that remains (mm), slip over that on the ground, friction over floor acceleration"]
    lines.append(f"  {'block':16}{'remains':>24}{'building/ground':>26}{'motion by motion':>24}{'mu_s g/PFA':>12}")
    for row in result.blocks.iter_rows(named=True):
        name = f"{row['block']}, {_floor(row['floor'])}"
        remains = f"{_mm(row['residual_mean'])} [{_mm(row['residual_p16'])}, {_mm(row['residual_p84'])}]"
        pooled = _between(row["amplification"], row["amplification_low"], row["amplification_high"])
        each = _between(row["amplification_median"], row["amplification_p16"], row["amplification_p84"])
        ratio = "-" if row["mu_over_attached"] is None else f"{row['mu_over_attached']:.2f}"
        lines.append(f"  {name:16}{remains:>24}{pooled:>26}{each:>24}{ratio:>12}")
        if row["slides_on_floor_only"]:
            lines.append(
                f"  {'':16}slides in the building alone under {counted(row['slides_on_floor_only'], 'motion')}"
            )
    lines.append(
        f"  building/ground: ratio of means with its {100 * result.confidence:g} % interval; motion by motion: median "
        f"[16 %, 84 %];"
    )
    lines.append("  PFA: peak floor acceleration with all goods attached, mean of the ratio")
    return lines


def _exceedance(result: SlipDemand) -> list[str]:
    if not result.exceedance.height:
        return []
    lines = [f"Clearance reached: share of motions, {100 * result.confidence:g} % interval (Wilson)"]
    for row in result.exceedance.iter_rows(named=True):
        lines.append(
            f"  block {row['block']}, side {row['side']:4}{1e3 * row['clearance']:6.0f} mm   {row['exceeding']} of "
            f"{row['motions']}: {_percent(row['probability'])} [{_percent(row['low'])}, {_percent(row['high'])}]"
        )
    for block, fit in result.fragilities.items():
        first, *rest = fit.text.splitlines()
        lines.append(f"  block {block}, by {result.metadata['measure']['label']}: {first}")
        lines += [f"    {line}" for line in rest]
    return lines


def _squat(result: SlipDemand) -> list[str]:
    lines = []
    for row in result.squat.iter_rows(named=True):
        rule = (
            f"{'rocks' if row['rocks_first'] else 'slides'} first: mu_s = {row['mu_s']:g}, b/(2 h_c) = "
            f"{row['uplift_g']:.3g}"
        )
        lines.append(f"  block {row['block']}, {row['width']:g} x {row['height']:g} m: {rule}")
        if row["rocks_first"]:
            lines.append(
                f"    lifts off above {row['uplift_g']:.3g} g: under {row['uplift']} of {row['motions']} motions"
            )
            if row["overturning_limits_exceeded"] is not None:
                exceeded = counted(row["overturning_limits_exceeded"], "motion")
                lines.append(
                    f"    above both of Ishiyama's lower limits of overturning, as to velocity "
                    f"{row['overturning_velocity']:.2g} m/s: under {exceeded}"
                )
    return ["Slide or rock", *lines] if lines else []


def _estimates(result: SlipDemand) -> list[str]:
    if not result.estimates.height:
        return []
    lines = [
        "Estimates over the exact slip: geometric mean, log scatter, share of sliding cases that they fall short of",
        f"  {'block':8}{'motion of':14}{'estimate':34}{'mean':>8}{'scatter':>9}{'short':>8}",
    ]
    for row in result.estimates.iter_rows(named=True):
        if row["base"] == "ground" and row["estimate"] == "rigid_block":
            continue  # the exact slip itself
        base = "the ground" if row["base"] == "ground" else f"{_floor(row['floor'])} alone"
        cells = ["-" if row[name] is None else f"{row[name]:.2f}" for name in ("ratio", "log_scatter")]
        short = "-" if row["below"] is None else _percent(row["below"])
        lines.append(f"  {row['block']:<8}{base:14}{TITLES[row['estimate']]:34}{cells[0]:>8}{cells[1]:>9}{short:>8}")
    return [
        *lines,
        "  on the ground beside the slip there; on a floor of the building alone beside that in the building",
    ]


def _floor(floor: int) -> str:
    return "ground" if floor == 0 else f"floor {floor}"


def _mm(value: float | None) -> str:
    return "-" if value is None else f"{1e3 * value:.0f}"


def _percent(value: float) -> str:
    return f"{100.0 * value:.0f} %"


def _between(value: Any, low: Any, high: Any) -> str:
    return "-" if value is None else f"{value:.2f} [{low:.2f}, {high:.2f}]"
