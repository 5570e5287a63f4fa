"""The file of a scene or of a building, which `ida`, `risk` and `slip` take."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from seismass.assessment.own_building import OwnBuilding
    from seismass.model.scene import Scene

DEFAULT_LIMIT: Final = "drift_ratio=0.02"
"""Limit state of a scene file: the allowable drift of ASCE/SEI 7-10, table 12.12-1, other structures of risk category I
or II."""


def add_file_argument(parser: argparse.ArgumentParser) -> None:
    """Add the argument `file`."""
    parser.add_argument(
        "file", type=Path, metavar="FILE", help="scene file (its motion is not read) or building file, .toml or .json"
    )


def read_scene_or_building(path: Path) -> tuple[Scene, OwnBuilding | None]:
    """Return the scene of a scene file or a building file, and the building of the latter.

    A building file has tables that no scene file has.

    Raises
    ------
    InvalidSceneFile, InvalidScene
        It cannot be read, or as for `read_scene`.
    InvalidBuildingFile
        As for `read_building`.
    """
    from seismass.assessment.building_file import read_building
    from seismass.base.errors import InvalidSceneFile
    from seismass.base.input_table import load_table
    from seismass.runs.scene_file import scene_without_motion

    found = load_table(path, "scene or building file", InvalidSceneFile).values
    if not any(name in found for name in ("storeys", "goods", "site")):
        return scene_without_motion(path), None
    building = read_building(path)
    return building.scene(), building
