"""Making the folder of a campaign, or taking one that was begun by the same inputs."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Final

from seismass.base.errors import InvalidOption
from seismass.base.files import written_whole
from seismass.base.temporary import PREFIX, remove_left_behind
from seismass.base.values import brief, printable, refusal
from seismass.campaign.campaign import CampaignRuns
from seismass.campaign.contents import write_inputs
from seismass.campaign.manifest import check_same, manifest_of, read_manifest
from seismass.campaign.places import AXES, MANIFEST, MOTIONS, PARTS, parts_present

_OURS: Final = (MANIFEST, AXES, MOTIONS, PARTS)


def prepare(campaign: CampaignRuns, folder: Path) -> None:
    """Make the folder of a campaign ready for its parts and remove what killed processes left in it. A folder of other
    inputs, another version or another instruction set, or with other files, is refused.
    """
    absolute = str(folder.absolute())
    if printable(absolute) != absolute:
        raise refusal(InvalidOption, "folder", "campaign", "in UTF-8, as Polars reads no other", brief(absolute))
    if folder.exists() and not folder.is_dir():
        raise refusal(InvalidOption, "folder", "campaign", "a folder", f"the file {folder}")
    wanted = manifest_of(campaign)
    if not (folder / MANIFEST).is_file():
        _make(campaign, folder, wanted)
    # Read again, as another process may have made the folder at the same time.
    check_same(read_manifest(folder), wanted, folder)
    write_inputs(campaign, folder)
    _make_parts(folder)
    for place in (folder, folder / PARTS):
        _check_writable(place)
        remove_left_behind(place)


def _make(campaign: CampaignRuns, folder: Path, manifest: dict[str, object]) -> None:
    if folder.is_dir():
        others = [entry.name for entry in folder.iterdir() if entry.name not in _OURS and PREFIX not in entry.name]
        if others:
            requirement = "a new or empty one, or one of a campaign"
            got = f"{folder} with {printable(sorted(others)[0])} in it"
            raise refusal(InvalidOption, "folder", "campaign", requirement, got)
        there = parts_present(folder)
        # The manifest is looked for after the parts, as another process may begin the same campaign now.
        if (there.files or there.others) and not (folder / MANIFEST).is_file():
            requirement = f"one whose parts have a {MANIFEST} (remove the parts, or bring it back)"
            got = f"{folder} with {len(there.files) + len(there.others)} parts of unknown inputs"
            raise refusal(InvalidOption, "folder", "campaign", requirement, got)
    folder.mkdir(parents=True, exist_ok=True)
    _make_parts(folder)
    write_inputs(campaign, folder)
    text = json.dumps(manifest, indent=1, allow_nan=False) + "\n"
    with written_whole(folder / MANIFEST, durable=True) as temporary:
        temporary.write_text(text, encoding="utf-8")


def _make_parts(folder: Path) -> None:
    """Make the folder of parts; a link in its place would lead the parts elsewhere."""
    parts = folder / PARTS
    if parts.is_symlink() or (parts.exists() and not parts.is_dir()):
        got = f"{parts}, {'a link' if parts.is_symlink() else 'a file'}"
        raise refusal(InvalidOption, PARTS, "campaign", "a folder", got)
    parts.mkdir(exist_ok=True)


def _check_writable(folder: Path) -> None:
    """Raise the system's error before anything is solved."""
    if not os.access(folder, os.W_OK | os.X_OK):
        raise PermissionError(13, os.strerror(13), str(folder))
