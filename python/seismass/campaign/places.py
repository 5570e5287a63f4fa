"""Names of the files of a campaign's folder, and which parts are there."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Final, NamedTuple

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
