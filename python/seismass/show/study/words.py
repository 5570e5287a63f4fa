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
    """Return everything that a study assumes, sentence by sentence, from `StudyResult.metadata`."""
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
        "Processor instructions": f"{metadata['instructions']}; the same bits wherever they are used",
        "Format of the tables": f"version {metadata['schema_version']}",
        "Inputs, SHA-256": metadata["inputs_sha256"],
        "Analyses": f"{counts['analyses']} of {counts['buildings']} buildings, {counts['distinct']} distinct: "
        f"{counts['completed']} completed, {counts['collapsed']} collapsed, {counts['failed']} failed",
        **dict(_option(name, value) for name, value in metadata["parameters"].items()),
    }


_PARAMETERS: Final = {
    "buildings": "Buildings",
    "response_modification": "Response modification factors R",
    "mass_ratios": "Goods over floor mass, \N{GREEK SMALL LETTER ALPHA}",
    "occupancies": "Share of the goods that the code counts",
    "code": "Code",
    "mu": "Friction, \N{GREEK SMALL LETTER MU}",
    "overstrength": "Overstrength, \N{GREEK CAPITAL LETTER OMEGA}",
    "second_slope": "Slope after the first yield over the initial one, r2",
    "third_slope": "Slope after the second yield over the initial one, r3",
    "damping": "Damping ratio",
    "damping_base": "Damping",
    "scaling_period": "Period for which motions are scaled",
    "combination": "Combination of modes",
    "yield_at_r1": "Buildings of R = 1",
    "height": "Storey height",
    "p_delta": "P-Delta",
    "collapse_drift_ratio": "Collapse",
}
"""Parameters in words."""


def _option(name: str, value: Any) -> tuple[str, str]:
    """A parameter in words, its value with its unit."""
    if name == "buildings":
        text = ", ".join(f"{storeys} storeys, {period:g} s" for storeys, period in value)
    elif name == "occupancies":
        text = ", ".join(
            f"{use} {design:g}" + ("" if design == analysis else f" in the design, {analysis:g} in the analysis")
            for use, design, analysis in value
        )
    elif name == "damping_base":
        text = DAMPING_TEXTS[value]
    elif name == "yield_at_r1":
        text = "yield at V_e" if value else "stay elastic"
    elif name == "collapse_drift_ratio":
        text = "only where P-Delta says so" if value is None else f"at a drift of {value:g} of the height"
    elif name == "combination":
        text = value.upper()
    else:
        text = _plain_option(value)
    unit = {"scaling_period": " s", "height": " m"}.get(name, "")
    return _PARAMETERS[name], f"{text}{unit}"


def _plain_option(value: Any) -> str:
    """Numbers with commas, yes or no, a text."""
    if isinstance(value, list | tuple):
        return ", ".join(_plain_option(item) for item in value)
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:g}" if isinstance(value, float) else str(value)
