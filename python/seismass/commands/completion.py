"""`seismass completion SHELL`: the script by which a shell completes the commands and options of `seismass`."""

from __future__ import annotations

import argparse
from typing import Any

_EPILOG = """examples:
  seismass completion bash > ~/.local/share/bash-completion/completions/seismass
  seismass completion zsh > ~/.zfunc/_seismass

A folder of zsh has to be in fpath. A new shell completes then.

exit codes: 0 done, 2 bad input"""


def add_parser(subparsers: Any, help: str) -> None:
    """Add the subcommand to those of the `seismass` command, with the line that lists it."""
    parser = subparsers.add_parser(
        "completion",
        help=help,
        description="Print the script by which a shell completes commands, options and choices of `seismass`.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("shell", choices=("bash", "zsh"), help="the shell")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Print the script; return the exit code."""
    import shtab

    from seismass.commands.parser import build_parser

    print(shtab.complete(build_parser(), shell=args.shell))
    return 0
