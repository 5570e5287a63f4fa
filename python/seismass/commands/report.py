"""`seismass report DIR`: the page of a study or of a building again, from its tables alone."""

from __future__ import annotations

import argparse
from pathlib import Path

from seismass.commands.frame import Command, progress, seconds, show
from seismass.commands.options import add_output_option
from seismass.media.result import PAGE


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    parser.add_argument("folder", type=Path, metavar="DIR", help="folder of seismass study or seismass building")
    add_output_option(parser, "FILE", "file to write (report.html in the folder)", lambda args: args.folder / PAGE)
    parser.add_argument(
        "--force", action="store_true", help="read files that were edited since they were written; the page says so"
    )


def run(args: argparse.Namespace) -> int:
    """Write the page; return the exit code. Bad input is raised."""
    from seismass.assessment.result import DOCUMENT
    from seismass.show.assessment.page import write_assessment_page
    from seismass.show.study.write import write_study_page

    write = write_assessment_page if (args.folder / DOCUMENT).exists() else write_study_page
    with progress("figures") as tell:
        edited = write(args.folder, args.out, force=args.force, progress=tell)
    if edited:
        show(f"edited since they were written: {', '.join(edited)}")
    show(f"{args.out}: {args.out.stat().st_size / 1e6:.2f} MB, {seconds(args)}")
    return 0


COMMAND = Command(
    description=(
        "Write the page of a study or of a building from the tables of its folder, without solving "
        "anything. The page needs no other file. Files are compared with the digests of files.json."
    ),
    examples="""
report study
report warehouse
report study --out study.html
""",
    options=options,
    run=run,
)
