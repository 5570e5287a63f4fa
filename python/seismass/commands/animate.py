"""`seismass animate SCENE`: a building with goods that slide beside the model of a code, as a page, a GIF or a film."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from seismass.base.errors import InvalidOption
from seismass.commands.command import Command
from seismass.commands.options import (
    add_code_options,
    add_code_share_option,
    add_out_option,
    check_files,
    positive_option,
)


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("scene", type=Path, nargs="?", metavar="SCENE", help="scene file, .toml or .json")
    what.add_argument("--example", action="store_true", help="the built-in example: three storeys of storage")
    where = "file to write, .html, .gif or .mp4 (the name of the scene file with .html, in this folder)"
    add_out_option(parser, "FILE", where)
    add_code_options(parser)
    add_code_share_option(parser, "share of the goods attached in place of a code's, from 0 to 1")
    parser.add_argument(
        "--fps", type=positive_option, metavar="N", help="frames per second of a GIF (12.5) or film (25)"
    )
    parser.add_argument("--speed", type=positive_option, default=1.0, metavar="X", help="speed of a GIF or film (1)")


def run(args: argparse.Namespace) -> int:
    """Write the animation; return the exit code."""
    from seismass.animation import animate
    from seismass.runs.scene_file import example_scene, read_scene

    if args.code_share is not None and (args.code is not None or args.use is not None):
        raise InvalidOption("--code-share of animate must be left out with --code or --use; got both")
    scene: Path = example_scene() if args.example else args.scene
    target = args.out or Path(scene.name).with_suffix(".html")
    check_files(target)
    file = read_scene(scene)
    for remark in file.remarks:
        print(f"seismass: {remark}", file=sys.stderr)
    chosen = {"code": args.code, "use": args.use, "fraction": args.code_share}
    note = ", ".join(part for part in (file.note, *(record.name for record in file.records[:1])) if part)
    animation = animate(
        file.scene,
        file.motion,
        title=file.name or scene.stem,
        note=note,
        **{name: value for name, value in chosen.items() if value is not None},
    )
    animation.write(target, frames_per_second=args.fps, speed=args.speed)
    print("\n".join(animation.shown.sentences))
    print(f"{target}: {target.stat().st_size / 1e3:.0f} kB")
    return 0


COMMAND = Command(
    description=(
        "Animate a scene file: the building sways and its goods slide, beside the model of a code, which "
        "has a share of them attached as mass, above the histories of record, drift and slip."
    ),
    examples="""
animate --example
animate scene.toml
animate scene.toml --code ec8 --out scene.gif
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
