"""`seismass animate FILE`: a building with goods that slide beside the model of a code, as a page, a GIF or a film."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from seismass.base.errors import InvalidOption
from seismass.commands.frame import Command, show
from seismass.commands.options import (
    add_code_options,
    add_code_share_option,
    add_output_option,
    add_records_options,
    arguments,
    positive_option,
    read_code,
    read_site,
    refuse_options,
)
from seismass.commands.parser import tell
from seismass.commands.scene_or_building import add_scaling_options, add_site_options, is_building_file, motions_of_file

if TYPE_CHECKING:
    from seismass.model.scene import Scene


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("scene", type=Path, nargs="?", metavar="FILE", help="scene or building file, .toml or .json")
    what.add_argument("--example", action="store_true", help="the built-in example: three storeys of storage")
    where = "file to write, .html, .gif or .mp4 (the name of the scene file with .html, in this folder)"
    add_output_option(parser, "FILE", where)
    add_code_options(parser)
    add_code_share_option(parser, "share of the goods attached in place of a code's, from 0 to 1")
    parser.add_argument(
        "--fps", type=positive_option, metavar="N", help="frames per second of a GIF (12.5) or film (25)"
    )
    for name, dest, words in (
        ("--from", "start", "second from which it plays (shortly before the ground shakes strongly)"),
        ("--to", "end", "second up to which it plays (the end)"),
    ):
        parser.add_argument(name, dest=dest, type=float, metavar="SECONDS", help=words)
    parser.add_argument("--speed", type=positive_option, default=1.0, metavar="X", help="speed of a GIF or film (1)")
    motions = parser.add_argument_group("motions of a building file, scaled to its site; one of them is shown")
    add_records_options(motions)
    add_scaling_options(motions)
    add_site_options(parser)


def run(args: argparse.Namespace) -> int:
    """Write the animation; return the exit code."""
    from seismass.runs.peak_digits import digits_remarks
    from seismass.runs.scene_file import example_scene
    from seismass.show.animation import Animation, PlaneAnimation, animate, animate_plane

    if args.code_share is not None and (args.code is not None or args.use is not None):
        raise InvalidOption("--code-share of animate must be left out with --code or --use; got both")
    scene: Path = example_scene() if args.example else args.scene
    shown_of = _of_building if is_building_file(scene) else _of_scene
    target = args.out or Path(scene.name).with_suffix(".html")
    shown = shown_of(args, scene)
    for remark in shown.remarks:
        tell(remark)
    played = arguments(args, "start", "end")
    options = shown.options | arguments(args, fraction="code_share") | played
    animation: Animation | PlaneAnimation
    if shown.scene.engine == "plane":
        refuse_options(args, ("code", "use", "code_share"), "animate", "in two directions, where no model is shown")
        target = args.out or target.with_suffix(".gif")  # there is no page of it
        animation = animate_plane(shown.scene, shown.motion, title=shown.title, note=shown.note, **played)
    else:
        animation = animate(shown.scene, shown.motion, title=shown.title, note=shown.note, **options)
    chaotic = digits_remarks(animation.response)
    for remark in chaotic:
        tell(remark)
    animation = replace(animation, note="; ".join(part for part in (shown.note, *chaotic) if part))
    animation.write(target, frames_per_second=args.fps, speed=args.speed)
    show("\n".join([*shown.about_motion, *animation.sentences]))
    show(f"{target}: {target.stat().st_size / 1e3:.0f} kB")
    return 0


class _Shown(NamedTuple):
    """What of a file is animated; `options` are those of `animate` that the file states, `about_motion` is printed."""

    scene: Scene
    motion: Any
    title: str
    note: str
    remarks: tuple[str, ...]
    options: dict[str, Any]
    about_motion: tuple[str, ...] = ()


def _of_scene(args: argparse.Namespace, path: Path) -> _Shown:
    from seismass.runs.scene_file import read_scene

    of_buildings = ("records", "suite", "target", "sds", "sd1", "tl", "period", "factor")
    refuse_options(args, of_buildings, "animate", "with a scene file")
    file = read_scene(path)
    note = ", ".join(part for part in (file.note, *(record.name for record in file.records[:1])) if part)
    motion: Any = file.motion if file.other_motion is None else (file.motion, file.other_motion)
    return _Shown(file.scene, motion, file.name or path.stem, note, file.remarks, arguments(args, "code", "use"))


def _of_building(args: argparse.Namespace, path: Path) -> _Shown:
    """A building file, under the motion of `shown_motion`, beside the model with the share of its code or --code."""
    from seismass.assessment.building import with_code
    from seismass.assessment.building_file import read_building
    from seismass.assessment.models import median_of, shown_motion

    building, target, code = read_building(path), read_site(args, "animate"), read_code(args, "animate")
    if code is not None:
        building = with_code(building, code)
    scene = building.scene(target)
    motions = motions_of_file(args, "animate", scene, building, target)
    motion = shown_motion(scene, motions.scaled, motions.factors)
    shown: Any = motions.suite[motion.number - 1]
    made = "synthetic motion" if getattr(shown, "first", shown).synthetic else "motion"
    which = f"{made} {motion.number} of {len(motions.suite)}, that with the {median_of(motion.slides)}"
    note = f"{motion.motion.name} x {motion.factor:.3g}, {which}"
    options: dict[str, Any] = {}
    if args.code_share is None:
        options = {"fraction": building.present_code_share, "code_name": building.code.code}
    notes = (f"Motion: {note}.", f"Scaling: {motions.scaling}.")
    return _Shown(scene, motion.motion, building.name, f"{note}; {motions.scaling}", scene.remarks, options, notes)


COMMAND = Command(
    description=(
        "Animate a scene file or a building file: the building sways and its goods slide, beside the model of a code, "
        "which has a share of them attached as mass, above the histories of record, drift and slip."
    ),
    examples="""
animate --example
animate scene.toml
animate warehouse.toml
animate scene.toml --code ec8 --out scene.gif --from 4 --to 12
animate scene.toml --code-share 0.5 --out scene.mp4 --speed 0.5
""",
    options=options,
    run=run,
    note="""
docs/scene_file.md explains the keys of a scene file, docs/animation.md what is shown. A page (.html) needs nothing but
itself; a film (.mp4) needs ffmpeg on the path.
""",
    codes={0: "done (a collapse is a result)", 1: "the run failed"},
)
