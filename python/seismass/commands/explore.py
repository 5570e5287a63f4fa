"""`seismass explore`: writes the live page, in which the kernel answers while one plays."""

from __future__ import annotations

import argparse
import webbrowser
from pathlib import Path
from typing import Any

from seismass.base.files import written_whole
from seismass.commands.options import check_files

_EPILOG = """examples:
  seismass explore
  seismass explore --out warehouse.html --open

The page needs nothing but itself: no network and no Python. docs/explorer.md explains it. It carries the kernel
compiled to WebAssembly, which wheels of releases have; in a clone of the project, make explorer compiles it and writes
the page.
exit codes: 0 done, 2 bad input, or no compiled kernel"""


def add_parser(subparsers: Any, help: str) -> None:
    """Add the subcommand to those of the `seismass` command, with the line that lists it."""
    parser = subparsers.add_parser(
        "explore",
        help=help,
        description="Write the live page: a building of up to four storeys with sliding goods, solved exactly in the "
        "browser while its sliders move, with its effective fraction of live load.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--out", type=Path, metavar="FILE", default=Path("explorer.html"), help="file to write (explorer.html)"
    )
    parser.add_argument("--open", action="store_true", help="open it in the browser")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Write the page; return the exit code. Bad input, and a kernel that is missing, are raised."""
    from seismass.explore import explorer_html

    check_files(args.out)
    html = explorer_html()
    with written_whole(args.out) as temporary:
        temporary.write_text(html, encoding="utf-8")
    print(f"{args.out}: {args.out.stat().st_size / 1e3:.0f} kB")
    if args.open:
        webbrowser.open(args.out.absolute().as_uri())
    return 0
