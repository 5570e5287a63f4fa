"""Words on a study that its page and the command share: what it assumes, and from what its numbers were made."""

from __future__ import annotations

from typing import Any, Final

from seismass.study import motions_text

DAMPING_TEXTS: Final = {
    "bare": "in the modes of the bare building, one matrix for all models",
    "loaded": "in the modes of the building with all its goods, one matrix for all models",
    "own": "in the modes of each model's own masses",
}
"""Damping bases as they are printed."""


def assumptions(metadata: dict[str, Any]) -> list[str]:
    """Return everything that a study assumes, sentence by sentence.

    Parameters
    ----------
    metadata : dict
        `StudyResult.metadata`.
    """
    chosen, suite, scaling = metadata["parameters"], metadata["suite"], metadata["scaling"]
    shortest, longest, _ = scaling["periods"]
    at_r1 = "yield at V_e" if chosen["yield_at_r1"] else "stay elastic"
    lines = [
        "Shear buildings: rigid floors of equal mass, storeys of equal stiffness, one direction, no loss of strength.",
        f"Springs: trilinear with Masing unloading, Omega = {chosen['overstrength']:g}, r2 = "
        f"{chosen['second_slope']:g}, r3 = {chosen['third_slope']:g}. The paper states Omega = 2 for its section 4 "
        "only, and neither slope.",
        f"Strength: V_y = V_e/R by response spectrum analysis ({chosen['combination'].upper()}) under the mean scaled "
        f"spectrum, with the design's share of the live load as mass. Buildings of R = 1 {at_r1}.",
        f"Damping: {100.0 * chosen['damping']:g} % {DAMPING_TEXTS[chosen['damping_base']]}.",
        "Goods: one rigid block on every floor but the roof, Coulomb friction with mu_s = mu_k; no rocking, no impact.",
        f"Motions: {motions_text(suite)} ({suite['name']}); one component each, all of equal weight in the means.",
        f"Scaling: {scaling['method']}, for T = {chosen['scaling_period']:g} s: mean not below the target from "
        f"{shortest:.3g} to {longest:.3g} s.",
        f"Target: {metadata['target']['label']}.",
        "P-Delta: the whole weight of building and goods, in every model alike."
        if chosen["p_delta"]
        else "P-Delta: none.",
    ]
    if chosen["collapse_drift_ratio"] is not None:
        lines.append(f"Collapse: a storey whose drift reaches {chosen['collapse_drift_ratio']:g} of its height.")
    for name, row in metadata["code"]["fractions"].items():
        source = "; ".join(part for part in (row["clause"], row["status"]) if part)
        lines.append(f"Code: {metadata['code']['name']}, {name}: {row['fraction']:g} of the live load ({source}).")
    return lines


def provenance(metadata: dict[str, Any]) -> dict[str, str]:
    """Return from what the numbers of a study were made, by name."""
    counts = metadata["counts"]
    return {
        "Program": f"seismass {metadata['package_version']}",
        "Instruction set": str(metadata["instructions"]),
        "Version of the tables": str(metadata["schema_version"]),
        "Inputs (SHA-256)": metadata["inputs_sha256"],
        "Analyses": f"{counts['analyses']} of {counts['buildings']} buildings, {counts['distinct']} distinct: "
        f"{counts['completed']} completed, {counts['collapsed']} collapsed, {counts['failed']} failed",
        **{name.replace("_", " "): _option(value) for name, value in metadata["parameters"].items()},
    }


def _option(value: Any) -> str:
    """A parameter as a text: lists with commas, pairs with colons."""
    if isinstance(value, list | tuple):
        nested = any(isinstance(item, list | tuple) for item in value)
        return ", ".join(":".join(_option(part) for part in item) if nested else _option(item) for item in value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if value is None:
        return "none"
    return f"{value:g}" if isinstance(value, float) else str(value)
