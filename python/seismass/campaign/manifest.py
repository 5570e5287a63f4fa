"""The manifest of a campaign's folder: what is in it, from which inputs, by which version and instruction set."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Final

from seismass import _kernel
from seismass.base.errors import InvalidOption
from seismass.base.values import refusal
from seismass.campaign.campaign import SCHEMA_VERSION, Campaign
from seismass.campaign.columns import UNITS
from seismass.runs.simulate import instruction_set

MANIFEST: Final = "manifest.json"
"""Name of the file; it is the last one that is written before the parts."""
KIND: Final = "seismass campaign"
_SAME_BITS: Final = {"avx512": "avx2"}
"""Instruction sets that give the same bits as another."""


def bits() -> str:
    """Return the instruction set of this process, or the one that gives the same bits."""
    name = instruction_set()
    return _SAME_BITS.get(name, name)


def manifest_of(campaign: Campaign) -> dict[str, Any]:
    """Return the manifest of a campaign that this process solves."""
    return {
        "kind": KIND,
        "schema_version": SCHEMA_VERSION,
        "name": campaign.name,
        "inputs_sha256": campaign.sha256,
        "package_version": _kernel.VERSION,
        "bits": bits(),
        "scenes": len(campaign.grid),
        "motions": len(campaign.motions),
        "runs": campaign.total,
        "parts": campaign.parts,
        "units": {name: UNITS[name] for name in campaign.columns},
        **campaign.document,
    }


def read_manifest(folder: Path) -> dict[str, Any]:
    """Return the manifest of a folder.

    Raises
    ------
    InvalidOption
        There is none, or it is not one of this schema.
    """
    path = folder / MANIFEST
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        requirement = f"one of a campaign, with a {MANIFEST}"
        raise refusal(InvalidOption, "folder", "campaign", requirement, str(folder)) from None
    except ValueError as error:
        raise refusal(InvalidOption, MANIFEST, "campaign", "JSON", f"{path}: {error}") from None
    if not isinstance(found, dict) or found.get("kind") != KIND:
        raise refusal(InvalidOption, MANIFEST, "campaign", f"of the kind {KIND!r}", str(path))
    if found.get("schema_version") != SCHEMA_VERSION:
        got = f"{found.get('schema_version')} in {path}"
        raise refusal(InvalidOption, "schema_version", "campaign", str(SCHEMA_VERSION), got)
    return found


def check_same(present: dict[str, Any], wanted: dict[str, Any], folder: Path) -> None:
    """Refuse to go on in a folder whose rows come from elsewhere.

    Raises
    ------
    InvalidOption
        Another version, instruction set or input.
    """
    version = present.get("package_version")
    if version != wanted["package_version"]:
        requirement = f"solved by seismass {wanted['package_version']}, the version that goes on"
        raise refusal(InvalidOption, f"folder {folder}", "campaign", requirement, f"version {version}")
    if present.get("bits") != wanted["bits"]:
        requirement = (
            f"solved with the instruction set of this process, {wanted['bits']} (SEISMASS_INSTRUCTIONS chooses another)"
        )
        raise refusal(InvalidOption, f"folder {folder}", "campaign", requirement, str(present.get("bits")))
    if present.get("inputs_sha256") != wanted["inputs_sha256"]:
        keys = ("scenes", "motions", "runs", "part_runs", "peaks_only", "columns", "single")
        differing = [key for key in keys if present.get(key) != wanted[key]] or ["values of scenes or motions"]
        requirement = "a new one, or one of the same inputs"
        got = f"one of other inputs (they differ in {', '.join(differing)})"
        raise refusal(InvalidOption, f"folder {folder}", "campaign", requirement, got)
