"""Making the folder of a campaign, or taking one that was begun by the same inputs."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Final

import polars as pl

from seismass.base.errors import InvalidOption
from seismass.base.files import polars_writing, written_whole
from seismass.base.temporary import PREFIX, remove_left_behind
from seismass.base.values import refusal
from seismass.campaign.campaign import Campaign
from seismass.campaign.folder import AXES, MOTIONS, PARTS, CampaignFolder
from seismass.campaign.manifest import MANIFEST, check_same, manifest_of, read_manifest
from seismass.campaign.motions import motions_table

_OURS: Final = (MANIFEST, AXES, MOTIONS, PARTS)


def prepared(campaign: Campaign, folder: Path) -> CampaignFolder:
    """Return the folder of a campaign, ready for its parts; what killed processes have left in it is removed.

    Raises
    ------
    InvalidOption
        It belongs to other inputs, another version or another instruction set, or has other files.
    OSError
        It cannot be made or written to.
    """
    if folder.exists() and not folder.is_dir():
        raise refusal(InvalidOption, "folder", "campaign", "a folder", f"the file {folder}")
    wanted = manifest_of(campaign)
    if not (folder / MANIFEST).is_file():
        _make(campaign, folder, wanted)
    # Read again, as another process may have made the folder at the same time.
    check_same(read_manifest(folder), wanted, folder)
    for place in (folder, folder / PARTS):
        _check_writable(place)
        remove_left_behind(place)
    return CampaignFolder(folder)


def _make(campaign: Campaign, folder: Path, manifest: dict[str, object]) -> None:
    if folder.is_dir():
        others = [entry.name for entry in folder.iterdir() if entry.name not in _OURS and PREFIX not in entry.name]
        if others:
            requirement = "a new or empty one, or one of a campaign"
            got = f"{folder} with {sorted(others)[0]} in it"
            raise refusal(InvalidOption, "folder", "campaign", requirement, got)
    (folder / PARTS).mkdir(parents=True, exist_ok=True)
    _write(campaign.axes, folder / AXES)
    _write(motions_table(campaign.motions), folder / MOTIONS)
    text = json.dumps(manifest, indent=1, allow_nan=False) + "\n"
    with written_whole(folder / MANIFEST, durable=True) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _write(table: pl.DataFrame, path: Path) -> None:
    with written_whole(path, durable=True) as temporary, polars_writing(path):
        table.write_parquet(temporary, compression="zstd")


def _check_writable(folder: Path) -> None:
    """Raise the system's error before anything is solved."""
    if not os.access(folder, os.W_OK | os.X_OK):
        raise PermissionError(13, os.strerror(13), str(folder))
