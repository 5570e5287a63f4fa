"""What the numbers of a study depend on, as lines to read."""

from __future__ import annotations

from typing import Any

from seismass.show.study.words import DAMPING_TEXTS
from seismass.study.run import motions_text


def inputs_text(metadata: dict[str, Any]) -> str:
    """Return motions, target, runs, springs, damping, code and remarks as lines, from the metadata of a study."""
    counts, chosen, suite = metadata["counts"], metadata["parameters"], metadata["suite"]
    none_recorded = ", none recorded" * (suite["synthetic"] == len(suite["motions"]))
    lines = [f"suite    {suite['name']}: {motions_text(suite)}{none_recorded}"]
    for motion in suite["motions"]:
        lines.append(f"         {motion['motion']:>2}  x {motion['factor']:<7.4f} {motion['record']}")
        lines += [f"{'':25}{remark}" for remark in motion["remarks"]]
    lines += [
        f"target   {metadata['target']['label']}",
        f"runs     {counts['buildings']} buildings, {counts['analyses']} analyses, {counts['distinct']} distinct: "
        f"{counts['completed']} completed, {counts['collapsed']} collapsed, {counts['failed']} failed",
        f"springs  Omega = {chosen['overstrength']:g}, r2 = {chosen['second_slope']:g}, "
        f"r3 = {chosen['third_slope']:g} (r2, r3: not the paper's numbers)",
        f"damping  {100.0 * chosen['damping']:g} %, {DAMPING_TEXTS[chosen['damping_base']]}",
    ]
    for name, row in metadata["code"]["fractions"].items():
        where = ", ".join(part for part in (row["clause"], row["status"]) if part)
        lines.append(f"code     {metadata['code']['name']}, {name}: {row['fraction']:g} of the live load ({where})")
    return "\n".join([*lines, *(f"remark   {remark}" for remark in metadata["remarks"])])
