"""What a reader should know of a matched record, as sentences: what was not reached, and what else has changed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from seismass.base.values import counted
from seismass.scaling.result import FACTOR_RANGE

if TYPE_CHECKING:
    from seismass.matching.result import MatchedRecord

GROWN: Final = 1.25
"""Growth of PGV or PGD, and of the spectrum outside the range, that is remarked."""
SHIFTED: Final = 0.25
"""Difference of the normalised build-up of Arias intensity that is remarked."""


def matching_remarks(matched: MatchedRecord, shortened: bool) -> tuple[str, ...]:
    """Return the remarks on a matched record; none for most. `shortened`: an end of it made a wavelet narrower."""
    remarks = []
    misfit = matched.misfit
    if not matched.converged:
        worst = matched.periods[int(np.argmax(np.abs(matched.ratio_after - 1.0)))]
        remarks.append(
            f"not matched within {100.0 * matched.tolerance:g} %: the largest misfit is {100.0 * misfit.largest:.1f} % "
            f"at {worst:.3g} s after {counted(matched.iterations, 'pass', 'passes')}"
        )
    if not FACTOR_RANGE[0] <= abs(matched.factor) <= FACTOR_RANGE[1]:
        remarks.append(
            f"scaled by {matched.factor:.3g} first, outside {FACTOR_RANGE[0]:g} to {FACTOR_RANGE[1]:g}: far from the "
            "motion that was recorded"
        )
    for name, unit, before, after in (
        ("PGV", "m/s", matched.original.pgv, matched.record.pgv),
        ("PGD", "m", matched.original.pgd, matched.record.pgd),
    ):
        if after > GROWN * before:
            remarks.append(f"{name} grew from {before:.3g} to {after:.3g} {unit}, times {after / before:.2f}")
    for name, ratio in matched.outside.items():
        if ratio > GROWN:
            remarks.append(f"the spectrum at {name} periods than those matched grew by {ratio:.2f} on average")
    if matched.husid_difference > SHIFTED:
        remarks.append(
            f"the build-up of Arias intensity differs by up to {100.0 * matched.husid_difference:.0f} % of its end"
        )
    if shortened:
        remarks.append("an end of the record left less room than some wavelets have; they were made narrower")
    return tuple(remarks)
