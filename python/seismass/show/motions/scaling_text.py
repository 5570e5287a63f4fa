"""Factors of a suite as lines to read."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

import numpy as np

from seismass.media.text_table import text_line
from seismass.scaling.result import ScalingResult


def scaling_text(scaling: ScalingResult) -> str:
    """Return target, method, remarks, how the mean fits the target, the scatter, and the factor of each motion."""
    return "\n".join([*scaling_lines(scaling, scaling.remarks), "", *factor_lines(scaling)])


def scaling_lines(scaling: ScalingResult, remarks: Sequence[str]) -> list[str]:
    """Return target and method, remarks, the fit of the mean and the scatter."""
    touches = "touches the target" if scaling.method == "ASCE 7-10" else f"is {scaling.least_ratio:.4f} of the target"
    lines = [f"target  {scaling.target_label}", f"method  {scaling.method}, T = {scaling.period:g} s"]
    for remark in remarks:
        lines += textwrap.wrap(remark, 120, initial_indent="remark  ", subsequent_indent=f"{'':8}")
    lines.append(
        f"range   {len(scaling.periods)} periods from {scaling.periods[0]:g} to {scaling.periods[-1]:g} s; "
        f"the mean {touches} at {scaling.governing_period:.4g} s, at most {scaling.largest_ratio:.3f} of it; "
        f"SF2 = {scaling.common:.6f}"
    )
    if len(scaling.names) > 1:
        at = float(np.interp(np.log(scaling.period), np.log(scaling.periods), scaling.log_scatter))
        lines.append(
            f"scatter {float(scaling.log_scatter.mean()):.3f} between the motions over the range, {at:.3f} at T "
            "(standard deviation of ln Sa)"
        )
    return lines


def factor_lines(scaling: ScalingResult, remarks: Sequence[Sequence[str]] = ()) -> list[str]:
    """Return the factor and misfit of each motion, with what its record says of itself below it."""
    widths = (-5, -10, -10, -8, -8, 0)
    lines = [text_line(("", "SF1", "SF", "misfit", "largest", "record"), widths, indent=0)]
    for number, (row, largest) in enumerate(
        zip(scaling.diagnostics().iter_rows(named=True), scaling.largest_misfit, strict=True)
    ):
        factors = (f"{row[name]:.5f}" for name in ("individual_factor", "factor"))
        misfits = (f"{misfit:.3f}" for misfit in (row["misfit"], largest))
        lines.append(text_line((f"{row['motion']:>3}", *factors, *misfits, row["record"]), widths, indent=0))
        lines += [f"{'':42}{remark}" for remark in (remarks[number] if remarks else ())]
    return [
        *lines,
        "",
        "SF1: each motion by itself; SF = SF1 SF2: what its accelerations are multiplied by",
        "misfit: root mean square, and largest, of |ln(scaled/target)| over the range",
    ]
