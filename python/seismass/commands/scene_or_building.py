"""The file of a scene or of a building, which several commands take, its site, and motions scaled to that site."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple, Protocol, TypeVar, cast

from seismass.base.errors import InvalidOption, InvalidSceneFile
from seismass.base.input_table import BUILDING_FILE, kind_of, load_table
from seismass.commands.options import (
    add_period_option,
    add_target_options,
    positive_option,
    read_motions,
    read_pairs,
    refuse_options,
)
from seismass.motions.motion import scaled_motions

if TYPE_CHECKING:
    from seismass.assessment.building import OwnBuilding
    from seismass.base.values import FloatArray
    from seismass.model.scene import Scene
    from seismass.motions.records import Pairs, Suite
    from seismass.motions.spectra import TargetSpectrum

DEFAULT_LIMIT: Final = "drift_ratio=0.02"
"""Limit state of a scene file: the allowable drift of ASCE/SEI 7-10, table 12.12-1, other structures of risk category I
or II."""


class HasRemarks(Protocol):
    """A result with remarks."""

    @property
    def remarks(self) -> tuple[str, ...]:
        """What to know beside the numbers."""
        ...


Doubtable = TypeVar("Doubtable", bound=HasRemarks)


def add_file_argument(parser: argparse.ArgumentParser) -> None:
    """Add the argument `file`."""
    parser.add_argument(
        "file", type=Path, metavar="FILE", help="scene file (its motion is not read) or building file, .toml or .json"
    )


def add_site_options(parser: argparse.ArgumentParser) -> None:
    """Add --target, --sds, --sd1 and --tl, which `read_site` reads, for strengths that a building file designs."""
    group = parser.add_argument_group("site of a building file, in place of its own")
    add_target_options(group, stand_in=False)


def add_scaling_options(group: argparse._ActionsContainer) -> None:
    """Add --period and --factor, which `motions_of_file` reads."""
    period = "motions are scaled from 0.2 T to 1.5 T (of a building file its period with the goods attached; else 1 s)"
    add_period_option(group, None, period)
    factor = "motions times F (1: as they are), in place of scaling them as `seismass building` does"
    group.add_argument("--factor", type=positive_option, metavar="F", help=factor)


class FileMotions(NamedTuple):
    """Motions as they were read, the factors by which they are multiplied, and how they are scaled, in words."""

    suite: Suite | Pairs
    factors: FloatArray
    scaling: str

    @property
    def scaled(self) -> list[Any]:
        """The motions times their factors."""
        return scaled_motions(self.suite, self.factors)


def motions_of_file(
    args: argparse.Namespace,
    command: str,
    scene: Scene,
    building: OwnBuilding | None,
    target: TargetSpectrum | None,
) -> FileMotions:
    """Return the motions of a command: those of a building file scaled to its site as in `assess`, those of a scene
    file to `target` where one is given, or all times --factor. Scenes in two directions take pairs.
    """
    import numpy as np

    from seismass.assessment.models import scaled_to_site
    from seismass.design.scaling import scale_asce7_10

    suite = read_motions(args) if scene.other_direction is False else read_pairs(args)
    if target is not None:
        refuse_options(args, ("factor",), command, "where a target is given")
    if args.factor is not None or (building is None and target is None):
        refuse_options(args, ("period",), command, "where motions are not scaled to a target")
        note = "motions as they are" if args.factor in (None, 1.0) else f"motions x {args.factor:g}"
        return FileMotions(suite, np.full(len(suite), args.factor or 1.0), note)
    if building is None:
        result = scale_asce7_10(suite, cast("TargetSpectrum", target), args.period or 1.0, between=False)
    else:
        result = scaled_to_site(building, suite, target, args.period)
    return FileMotions(
        suite, result.factors, f"{result.method} to {result.target_label}, for T = {result.period:.3g} s"
    )


def doubts_of_input(
    scene: Scene,
    building: OwnBuilding | None,
    target: TargetSpectrum | None,
    limits: Iterable[tuple[str, float]],
    motions: Any = (),
) -> tuple[str, ...]:
    """Return what makes the input of a study doubtful: of a scene its limits and motions, of a building its file.
    `target` stands in place of the site spectrum of the file.
    """
    from seismass.assessment.doubts import building_doubts
    from seismass.model.plausibility import usage_remarks

    doubts = () if building is None else building_doubts(building, scene, building.target if target is None else target)
    return tuple(dict.fromkeys([*doubts, *usage_remarks(scene.remarks, motions, limits)]))


def with_doubts(result: Doubtable, doubts: tuple[str, ...]) -> tuple[Doubtable, str]:
    """Return a result whose remarks begin with the doubts, and the lines that stand before its text."""
    from seismass.assessment.answer import doubt_lines

    merged: Any = replace(cast("Any", result), remarks=tuple(dict.fromkeys([*doubts, *result.remarks])))
    return merged, "".join(f"{line}\n" for line in doubt_lines(doubts)) + "\n" * bool(doubts)


def is_building_file(path: Path) -> bool:
    """Whether a file has the tables of a building file."""
    return kind_of(load_table(path, "scene or building file", InvalidSceneFile).values) == BUILDING_FILE


def read_scene_or_building(
    path: Path, target: TargetSpectrum | None = None, *, only_site: str = ""
) -> tuple[Scene, OwnBuilding | None]:
    """Return the scene of a scene file or a building file (which has tables that no scene file has) and the building of
    the latter. `only_site` names a command that needs a site spectrum, which a scene file lacks.
    """
    from seismass.assessment.building_file import read_building
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
