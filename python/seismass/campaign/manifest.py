"""The manifest of a campaign's folder: what is in it, from which inputs, by which version and instruction set."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any, Final

import numpy as np
import polars as pl

from seismass import _kernel
from seismass.base.errors import InvalidOption
from seismass.base.files import read_file
from seismass.base.values import brief, refusal
from seismass.campaign.campaign import SCHEMA_VERSION, CampaignRuns
from seismass.campaign.columns import UNITS
from seismass.campaign.places import MANIFEST
from seismass.runs.simulate import instruction_set

KIND: Final = "seismass campaign"
_SAME_BITS: Final = {"avx512": "avx2"}
"""Instruction sets that give the same bits as another."""
_TYPES: Final[dict[str, type]] = {
    "name": str,
    "inputs_sha256": str,
    "package_version": str,
    "written_by": dict,
    "bits": str,
    "scenes": int,
    "motions": int,
    "runs": int,
    "parts": int,
    "part_runs": int,
    "peaks_only": bool,
    "single": bool,
    "columns": list,
    "units": dict,
    "grid": dict,
}
"""Keys that a manifest has beside kind, schema_version and sha256, and what stands there."""


def bits() -> str:
    """Return the instruction set of this process, or the one that gives the same bits."""
    name = instruction_set()
    return _SAME_BITS.get(name, name)


def manifest_of(campaign: CampaignRuns) -> dict[str, Any]:
    """Return the manifest of a campaign that this process solves; its last key is a digest of all others."""
    found = {
        "kind": KIND,
        "schema_version": SCHEMA_VERSION,
        "name": campaign.name,
        "inputs_sha256": campaign.sha256,
        "package_version": _kernel.VERSION,
        "written_by": {"numpy": np.__version__, "polars": pl.__version__},
        "bits": bits(),
        "scenes": len(campaign.grid),
        "motions": len(campaign.motions),
        "runs": campaign.total,
        "parts": campaign.parts,
        "units": {name: UNITS[name] for name in campaign.columns},
        **campaign.document,
    }
    return {**found, "sha256": _digest(found)}


def read_manifest(folder: Path) -> dict[str, Any]:
    """Return the manifest of a folder; a missing or damaged one and one of another schema are refused."""
    path = folder / MANIFEST
    try:
        found = json.loads(read_file(path))
    except FileNotFoundError:
        requirement = f"one of a campaign, with a {MANIFEST}"
        raise refusal(InvalidOption, "folder", "campaign", requirement, str(folder)) from None
    except OSError as error:
        got = f"{path} ({error.strerror or error})"
        raise refusal(InvalidOption, MANIFEST, "campaign", "a file that can be read", got) from None
    except (ValueError, RecursionError) as error:
        raise refusal(InvalidOption, MANIFEST, "campaign", "JSON", f"{path}: {error}") from None
    if not isinstance(found, dict) or found.get("kind") != KIND:
        raise refusal(InvalidOption, MANIFEST, "campaign", f"of the kind {KIND!r}", str(path))
    if found.get("schema_version") != SCHEMA_VERSION:
        got = f"{brief(found.get('schema_version'))} in {path}"
        raise refusal(InvalidOption, "schema_version", "campaign", str(SCHEMA_VERSION), got)
    for key, kind in _TYPES.items():
        # type() and not isinstance(), as true is an int.
        if type(found.get(key)) is not kind:
            raise refusal(
                InvalidOption, f"{key} of {MANIFEST}", "campaign", f"there, of the kind {kind.__name__}", str(path)
            )
    if found.get("sha256") != _digest({key: value for key, value in found.items() if key != "sha256"}):
        requirement = "as it was written, by the digest in it"
        raise refusal(InvalidOption, MANIFEST, "campaign", requirement, f"{path}, which was changed since")
    return found


def _digest(manifest: dict[str, Any]) -> str:
    return hashlib.sha256(json.dumps(manifest, sort_keys=True).encode()).hexdigest()


def check_same(present: dict[str, Any], wanted: dict[str, Any], folder: Path) -> None:
    """Refuse to go on in a folder of another version, instruction set or input."""
    version = present["package_version"]
    if version != wanted["package_version"]:
        requirement = f"solved by seismass {wanted['package_version']}, the version that goes on"
        raise refusal(InvalidOption, f"folder {folder}", "campaign", requirement, f"version {version}")
    if present["written_by"] != wanted["written_by"]:
        here, there = (
            ", ".join(f"{name} {number}" for name, number in each["written_by"].items()) for each in (wanted, present)
        )
        requirement = f"written by {here}, the versions that go on: others write other bytes"
        raise refusal(InvalidOption, f"folder {folder}", "campaign", requirement, there)
    if present["bits"] != wanted["bits"]:
        requirement = (
            f"solved with the instruction set of this process, {wanted['bits']} (SEISMASS_INSTRUCTIONS chooses another)"
        )
        raise refusal(InvalidOption, f"folder {folder}", "campaign", requirement, present["bits"])
    keys = ("scenes", "motions", "runs", "part_runs", "peaks_only", "columns", "single")
    # The number of parts follows from the others.
    differing = [key for key in keys if present[key] != wanted[key]] or ["parts"] * (
        present["parts"] != wanted["parts"]
    )
    if differing or present["inputs_sha256"] != wanted["inputs_sha256"]:
        requirement = "a new one, or one of the same inputs"
        got = f"one of other inputs (they differ in {', '.join(differing or ['values of scenes or motions'])})"
        raise refusal(InvalidOption, f"folder {folder}", "campaign", requirement, got)
