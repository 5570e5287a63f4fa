"""The file of a scene or of a building, which `ida`, `risk` and `slip` take."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from seismass.scene import Scene

DEFAULT_LIMIT: Final = "drift_ratio=0.02"
"""Limit state of a scene file: the allowable drift of ASCE/SEI 7-10, table 12.12-1, other structures of risk category I
or II."""


def add_file_argument(parser: argparse.ArgumentParser) -> None:
    """Add the argument `file`."""
    parser.add_argument(
        "file", type=Path, metavar="FILE", help="scene file (its motion is not read) or building file, .toml or .json"
    )


def is_building_file(path: Path) -> bool:
    """Whether a file has tables that only building files have.

    Raises
    ------
    InvalidSceneFile
        It cannot be read.
    """
    from seismass.errors import InvalidSceneFile
    from seismass.input_table import load_table

    found = load_table(path, "scene or building file", InvalidSceneFile).values
    return any(name in found for name in ("storeys", "goods", "site"))


def scene_of(path: Path) -> Scene:
    """Return the scene of a scene file or a building file.

    Raises
    ------
    InvalidSceneFile
        It cannot be read, or describes no scene or building.
    """
    from seismass.building_file import read_building
    from seismass.scene_file import scene_without_motion

    return read_building(path).scene() if is_building_file(path) else scene_without_motion(path)
