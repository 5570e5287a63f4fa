"""`seismass report DIR`: the page of a study or of a building again, from its tables alone."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import Any

from seismass.commands.options import check_files

_EPILOG = """examples:
  seismass report study
  seismass report warehouse
  seismass report study --out study.html

exit codes: 0 done, 2 bad input"""


def add_parser(subparsers: Any, help: str) -> None:
    """Add the subcommand to those of the `seismass` command, with the line that lists it."""
    parser = subparsers.add_parser(
        "report",
        help=help,
        description="Write the page of a study or of a building from the tables of its folder, without solving "
        "anything. The page needs nothing but itself.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("folder", type=Path, metavar="DIR", help="folder of seismass study or seismass building")
    parser.add_argument("--out", type=Path, metavar="FILE", help="file to write (report.html in the folder)")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Write the page; return the exit code. Bad input is raised."""
    from seismass.media.folder import PAGE
    from seismass.show.assessment.tables import DOCUMENT
    from seismass.show.assessment.write import write_assessment_page
    from seismass.show.study.write import write_study_page

    started = time.perf_counter()
    target = args.out or args.folder / PAGE
    check_files(target)
    write = write_assessment_page if (args.folder / DOCUMENT).exists() else write_study_page
    write(args.folder, target)
    print(f"{target}: {target.stat().st_size / 1e6:.2f} MB, {time.perf_counter() - started:.1f} s")
    return 0
