"""The manifest of a campaign's folder: what is in it, from which inputs, by which version and instruction set."""

from __future__ import annotations

import hashlib
import json
import os
import re
from pathlib import Path
from typing import Any, Final, NamedTuple, TypeVar

import numpy as np
import polars as pl

from seismass import _kernel
from seismass.base.errors import InvalidOption, SeismassError
from seismass.base.files import read_file, write_file
from seismass.base.stored_results import checked_content, damage, read_checked
from seismass.base.values import brief, refusal
from seismass.runs.grid.content import grid_of
from seismass.runs.simulate import instruction_set
from seismass.studies.campaign.campaign import SCHEMA_VERSION, UNITS, CampaignRuns, motions_of, motions_table

MANIFEST: Final = "manifest.json"
"""What is in the folder; it is the last file that is written before the parts."""
AXES: Final = "axes.parquet"
MOTIONS: Final = "motions.parquet"
PARTS: Final = "parts"
_PART: Final = re.compile(r"part-(\d{7,16})\.parquet")


class Present(NamedTuple):
    """The parts that are there, by their numbers from 1: `files`, `others` (a folder, link or pipe under the name of a
    part), and the size of the files in bytes.
    """

    files: set[int]
    others: set[int]
    bytes: int


def part_path(folder: Path, part: int) -> Path:
    """Return the path of a part, by its number from 1."""
    return folder / PARTS / f"part-{part:07d}.parquet"


def parts_present(folder: Path, most: int | None = None) -> Present:
    """Return which parts up to `most` are there; none where there is no folder of parts."""
    files, others, size = set(), set(), 0
    try:
        with os.scandir(folder / PARTS) as entries:
            for entry in entries:
                named = _PART.fullmatch(entry.name)
                part = int(named[1]) if named else 0
                if part < 1 or (most is not None and part > most) or entry.name != part_path(folder, part).name:
                    continue
                if entry.is_file(follow_symlinks=False):
                    files.add(part)
                    size += entry.stat(follow_symlinks=False).st_size
                else:
                    others.add(part)
    except FileNotFoundError:
        pass
    return Present(files, others, size)


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
    document = {
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
    return {**document, "sha256": _digest(document)}


def read_manifest(folder: Path) -> dict[str, Any]:
    """Return the manifest of a folder; a missing or damaged one and one of another schema are refused."""
    path = folder / MANIFEST
    try:
        document = json.loads(read_file(path))
    except FileNotFoundError:
        requirement = f"one of a campaign, with a {MANIFEST}"
        raise refusal(InvalidOption, "folder", "campaign", requirement, str(folder)) from None
    except OSError as error:
        got = f"{path} ({error.strerror or error})"
        raise refusal(InvalidOption, MANIFEST, "campaign", "a file that can be read", got) from None
    except (ValueError, RecursionError) as error:
        raise refusal(InvalidOption, MANIFEST, "campaign", "JSON", f"{path}: {error}") from None
    if not isinstance(document, dict) or document.get("kind") != KIND:
        raise refusal(InvalidOption, MANIFEST, "campaign", f"of the kind {KIND!r}", str(path))
    if document.get("schema_version") != SCHEMA_VERSION:
        got = f"{brief(document.get('schema_version'))} in {path}"
        raise refusal(InvalidOption, "schema_version", "campaign", str(SCHEMA_VERSION), got)
    for key, kind in _TYPES.items():
        # type() and not isinstance(), as true is an int.
        if type(document.get(key)) is not kind:
            raise refusal(
                InvalidOption, f"{key} of {MANIFEST}", "campaign", f"there, of the kind {kind.__name__}", str(path)
            )
    if document.get("sha256") != _digest({key: value for key, value in document.items() if key != "sha256"}):
        requirement = "as it was written, by the digest in it"
        raise refusal(InvalidOption, MANIFEST, "campaign", requirement, f"{path}, which was changed since")
    return document


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


_C = TypeVar("_C", bound=CampaignRuns)


def campaign_in(folder: Path, kind: type[_C]) -> _C:
    """Return the campaign of a folder from its files; files that changed or do not belong together are refused."""
    document = read_manifest(folder)
    axes, motions = (read_table(folder, name) for name in (AXES, MOTIONS))
    try:
        campaign = kind(
            grid_of(document["grid"], axes),
            motions_of(motions),
            name=document["name"],
            part_runs=document["part_runs"],
            peaks_only=document["peaks_only"],
            columns=document["columns"],
            single=document["single"],
        )
    except SeismassError:
        raise
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, pl.exceptions.PolarsError) as error:
        got = f"{type(error).__name__}: {error}"
        raise refusal(InvalidOption, f"folder {folder}", "campaign", "one with a grid and motions", got) from None
    check_same(document, manifest_of(campaign), folder)
    return campaign


def read_table(folder: Path, name: str) -> pl.DataFrame:
    """Return the table of axes or of motions; one that is missing or damaged is refused."""
    path = folder / name
    problem = damage(path)
    if problem is not None:
        raise refusal(InvalidOption, name, "campaign", "as it was written", f"{path}, which {problem}")
    return read_checked(path)


def write_inputs(campaign: CampaignRuns, folder: Path) -> None:
    """Write the tables of axes and motions that are missing; refuse those that are damaged or of other values."""
    for name, table in ((AXES, campaign.axes), (MOTIONS, motions_table(campaign.motions))):
        path = folder / name
        try:
            path.lstat()
        except FileNotFoundError:
            write_file(path, checked_content(table, {"campaign": campaign.sha256}), durable=True)
            continue
        if not read_table(folder, name).equals(table):
            requirement = "of the values of this campaign (remove it, and the same call writes it again)"
            raise refusal(InvalidOption, name, "campaign", requirement, f"{path} with others")
