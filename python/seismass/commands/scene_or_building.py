"""The file of a scene or of a building, which `fragility`, `risk` and `slip` take, and the site of the latter."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Final

from seismass.base.input_kinds import BUILDING_FILE, kind_of
from seismass.commands.options import add_target_options

if TYPE_CHECKING:
    from seismass.assessment.own_building import OwnBuilding
    from seismass.model.scene import Scene
    from seismass.spectra import TargetSpectrum

DEFAULT_LIMIT: Final = "drift_ratio=0.02"
"""Limit state of a scene file: the allowable drift of ASCE/SEI 7-10, table 12.12-1, other structures of risk category I
or II."""


def add_file_argument(parser: argparse.ArgumentParser) -> None:
    """Add the argument `file`."""
    parser.add_argument(
        "file", type=Path, metavar="FILE", help="scene file (its motion is not read) or building file, .toml or .json"
    )


def add_site_options(parser: argparse.ArgumentParser) -> None:
    """Add --target, --sds, --sd1 and --tl, which `read_site` reads, for strengths that a building file designs."""
    group = parser.add_argument_group("site of a building file that designs strengths, in place of its own")
    add_target_options(group, stand_in=False)


def is_building_file(path: Path) -> bool:
    """Whether a file has the tables of a building file."""
    from seismass.base.errors import InvalidSceneFile
    from seismass.base.input_table import load_table

    return kind_of(load_table(path, "scene or building file", InvalidSceneFile).values) == BUILDING_FILE


def read_scene_or_building(
    path: Path, target: TargetSpectrum | None = None, *, only_site: str = ""
) -> tuple[Scene, OwnBuilding | None]:
    """Return the scene of a scene file or a building file, and the building of the latter.

    Parameters
    ----------
    path : Path
        The file. A building file has tables that no scene file has.
    target : TargetSpectrum, optional
        Site spectrum of a building file, in place of its own.
    only_site : str
        Name of a command that needs the target as a site alone, which a scene file has not.

    Raises
    ------
    InvalidSceneFile, InvalidScene
        It cannot be read, or as for `read_scene`.
    InvalidBuildingFile
        As for `read_building`.
    InvalidOption
        A site is given that nothing needs.
    """
    from seismass.assessment.building_file import read_building
    from seismass.base.errors import InvalidOption
    from seismass.runs.scene_file import scene_without_motion

    if not is_building_file(path):
        if only_site and target is not None:
            raise InvalidOption(
                f"--target of {only_site} must be left out with a scene file, which states its strengths; "
                f"got {target.label}"
            )
        return scene_without_motion(path), None
    building = read_building(path)
    return building.scene(target), building
