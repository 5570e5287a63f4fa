"""`seismass explore`: writes the live page, in which the kernel answers while one plays."""

from __future__ import annotations

import argparse
import webbrowser

from seismass.base.files import write_file
from seismass.commands.frame import Command, show
from seismass.commands.options import add_output_option


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    add_output_option(parser, "FILE", "file to write (explorer.html)", "explorer.html")
    parser.add_argument("--open", action="store_true", help="open it in the browser")


def run(args: argparse.Namespace) -> int:
    """Write the page; return the exit code. Bad input, and a kernel that is missing, are raised."""
    from seismass.show.explore import explorer_html

    write_file(args.out, explorer_html())
    show(f"{args.out}: {args.out.stat().st_size / 1e3:.0f} kB")
    if args.open:
        webbrowser.open(args.out.absolute().as_uri())
    return 0


COMMAND = Command(
    description=(
        "Write the live page: a building of up to four storeys with sliding goods, solved exactly in the "
        "browser while its sliders move, with its effective fraction of live load."
    ),
    examples="""
explore
explore --out warehouse.html --open
""",
    options=options,
    run=run,
    note="""
The page needs no other file: no network and no Python. docs/explorer.md explains it. It carries the kernel
compiled to WebAssembly, which wheels of releases have; in a clone of the project, make explorer compiles it and writes
the page.
""",
    codes={2: "bad input, or no compiled kernel"},
)
