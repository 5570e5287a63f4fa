"""Whether a part is whole and of its runs: by its digest before it is reused, and by its rows too on request."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import polars as pl

from seismass.base.checked_parquet import damage, metadata_of, read_checked
from seismass.base.errors import InvalidOption
from seismass.base.values import refusal
from seismass.campaign.campaign import CampaignRuns
from seismass.campaign.places import part_path


def part_metadata(sha256: str, part: int) -> dict[str, str]:
    """Return the metadata of a part: the digest of its inputs and its number."""
    return {"campaign": sha256, "part": str(part)}


def part_problem(folder: Path, sha256: str, part: int) -> str | None:
    """Return what is wrong with a part by its bytes and what they say of themselves; None where nothing is."""
    path = part_path(folder, part)
    problem = damage(path)
    if problem is not None:
        return problem
    stated = metadata_of(path)
    if stated.get("campaign") != sha256:
        return "is of other inputs"
    return None if stated.get("part") == str(part) else "is of other runs"


def check_parts(folder: Path, sha256: str, parts: Iterable[int]) -> None:
    """Refuse parts that are damaged, are not files, or belong to other inputs or other runs."""
    found = [(part, problem) for part in parts if (problem := part_problem(folder, sha256, part)) is not None]
    if found:
        part, problem = found[0]
        more = f", and {len(found) - 1} more that are not as they were written" if len(found) > 1 else ""
        requirement = "whole and of this campaign (remove a part that is not, and the same call solves it again)"
        got = f"{part_path(folder, part).name}, which {problem}{more}"
        raise refusal(InvalidOption, f"parts of {folder}", "campaign", requirement, got)


def rows_and_problem(folder: Path, campaign: CampaignRuns, part: int) -> tuple[int | None, str | None]:
    """Return the number of rows of a part, and what is wrong with it."""
    problem = part_problem(folder, campaign.sha256, part)
    if problem is not None:
        return None, problem
    try:
        frame = read_checked(part_path(folder, part))
    except (pl.exceptions.PolarsError, OSError) as error:
        return None, f"cannot be read: {error}"
    runs = campaign.runs_of(part)
    if frame.height != len(runs) or frame.columns != list(campaign.columns):
        return frame.height, f"has not the {len(runs)} rows of its runs"
    numbers = np.arange(runs.start - 1, runs.stop - 1)
    scene, motion = campaign.grid._scene_and_motion(numbers, len(campaign.motions))
    same = (frame["scene"].to_numpy() == scene + 1).all() and (frame["motion"].to_numpy() == motion + 1).all()
    return frame.height, None if same else "is of other runs"
