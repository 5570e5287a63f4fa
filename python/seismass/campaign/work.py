"""The work on one part: what a task of an executor does, wherever it runs.

A task is the name of a folder and the number of a part. A process reads the inputs from the folder once and keeps them.
"""

from __future__ import annotations

import threading
from pathlib import Path
from typing import NamedTuple

import polars as pl

from seismass.base.checked_parquet import write_checked
from seismass.base.errors import InvalidOption
from seismass.base.files import written_whole
from seismass.base.forks import require_polars
from seismass.base.temporary import reported_as
from seismass.base.values import refusal
from seismass.campaign.campaign import CampaignRuns
from seismass.campaign.contents import campaign_in
from seismass.campaign.places import part_path
from seismass.campaign.verify import part_metadata

_lock = threading.Lock()
_last: tuple[str, str, CampaignRuns] | None = None


class Done(NamedTuple):
    """What a task gives back: the number of its part and its runs."""

    part: int
    runs: int


def solve_part(folder: str, sha256: str, part: int, threads: int | None) -> Done:
    """Solve a part (from 1) and write it, as a task. A worker whose version, instruction set or folder does not agree
    with the digest `sha256` of the inputs is refused.
    """
    require_polars("campaign")
    campaign = _campaign(folder, sha256)
    frame = campaign.solve(part, threads=threads)
    write_part(frame, Path(folder), sha256, part)
    return Done(part, frame.height)


def write_part(frame: pl.DataFrame, folder: Path, sha256: str, part: int) -> None:
    """Write the rows of a part under its name, whole and on the disk. The folder, which may have many parts, is not
    listed.
    """
    path = part_path(folder, part)
    with reported_as(path), written_whole(path, durable=True, tidy=False) as temporary:
        write_checked(frame, temporary, part_metadata(sha256, part))


def _campaign(folder: str, sha256: str) -> CampaignRuns:
    """The campaign of a folder, read by this process once."""
    global _last
    with _lock:
        if _last is None or _last[:2] != (folder, sha256):
            campaign = campaign_in(Path(folder), CampaignRuns)
            if campaign.sha256 != sha256:
                requirement = "that of the one who gives the work, under the same name on each machine"
                raise refusal(InvalidOption, f"folder {folder}", "worker", requirement, "one of other inputs")
            _last = (folder, sha256, campaign)
        return _last[2]
