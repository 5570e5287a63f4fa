"""The inputs of a campaign in its folder: written once, and made to runs again from there."""

from __future__ import annotations

from pathlib import Path
from typing import TypeVar

import polars as pl

from seismass.base.checked_parquet import damage, read_checked, write_checked
from seismass.base.errors import InvalidOption, SeismassError
from seismass.base.files import written_whole
from seismass.base.temporary import reported_as
from seismass.base.values import refusal
from seismass.campaign.campaign import CampaignRuns
from seismass.campaign.manifest import check_same, manifest_of, read_manifest
from seismass.campaign.motions import motions_of, motions_table
from seismass.campaign.places import AXES, MOTIONS
from seismass.runs.grid.content import grid_of

_C = TypeVar("_C", bound=CampaignRuns)


def campaign_in(folder: Path, kind: type[_C]) -> _C:
    """Return the campaign of a folder, made again from its files; files that changed or do not belong together are
    refused.
    """
    document = read_manifest(folder)
    axes, motions = (read_table(folder, name) for name in (AXES, MOTIONS))
    try:
        found = kind(
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
    check_same(document, manifest_of(found), folder)
    return found


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
            with reported_as(path), written_whole(path, durable=True) as temporary:
                write_checked(table, temporary, {"campaign": campaign.sha256})
            continue
        if not read_table(folder, name).equals(table):
            requirement = "of the values of this campaign (remove it, and the same call writes it again)"
            raise refusal(InvalidOption, name, "campaign", requirement, f"{path} with others")
