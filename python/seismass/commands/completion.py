"""`seismass completion SHELL`: the script by which a shell completes the commands and options of `seismass`."""

from __future__ import annotations

import argparse

from seismass.commands.frame import Command


def options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    parser.add_argument("shell", choices=("bash", "zsh"), help="the shell")


def run(args: argparse.Namespace) -> int:
    """Print the script; return the exit code."""
    import shtab

    from seismass.commands.parser import build_parser

    print(shtab.complete(build_parser(), shell=args.shell))
    return 0


COMMAND = Command(
    description="Print the script by which a shell completes commands, options and choices of `seismass`.",
    examples="""
completion bash > ~/.local/share/bash-completion/completions/seismass
completion zsh > ~/.zfunc/_seismass
""",
    options=options,
    run=run,
    note="""
A folder of zsh has to be in fpath. A new shell completes then.
""",
)
