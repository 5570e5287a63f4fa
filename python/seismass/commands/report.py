"""`seismass report DIR`: the page of a study or of a building again, from its tables alone."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from seismass.base.arguments import ProgressLike
from seismass.base.files import write_file
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


def write_page(folder: Path, target: Path, *, force: bool = False, progress: ProgressLike = None) -> tuple[str, ...]:
    """Write the page of a result from the files of its folder alone and return those that were edited since they were
    written, which are read with `force` alone; `progress` is called with (figures drawn, figures in all).
    """
    from seismass.assessment.result import Assessment
    from seismass.base.folders import as_written, read_folder
    from seismass.show.assessment.page import whole_page as page_of_assessment
    from seismass.show.study.write import whole_page as page_of_study
    from seismass.studies.study import StudyResult

    kind: Any = Assessment if (folder / f"{Assessment.document}.json").exists() else StudyResult
    page_of: Any = page_of_assessment if kind is Assessment else page_of_study
    files = read_folder(folder, kind.files_read(), force=force)
    with as_written(folder):
        page = page_of(kind.of_files(files), files.edited, progress)
    write_file(target, page)
    return files.edited


def run(args: argparse.Namespace) -> int:
    """Write the page; return the exit code. Bad input is raised."""
    with progress("figures") as tell:
        edited = write_page(args.folder, args.out, force=args.force, progress=tell)
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
