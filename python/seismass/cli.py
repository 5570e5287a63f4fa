"""The `seismass` command: finds the subcommand, runs it, and turns what goes wrong into one line and an exit code."""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import sys
from collections.abc import Sequence

from seismass import __version__
from seismass.commands import (
    animate,
    building,
    effective_map,
    ida,
    match,
    pulse,
    records,
    report,
    risk,
    run,
    scale,
    slip,
    spectrum,
    study,
    validate,
)
from seismass.errors import SeismassError

COMMANDS = (
    building,
    effective_map,
    ida,
    risk,
    slip,
    study,
    run,
    animate,
    records,
    spectrum,
    scale,
    match,
    pulse,
    validate,
    report,
)

INTERRUPTED = 130
"""Exit code after Ctrl-C, as shells give it (128 + SIGINT)."""


def build_parser() -> argparse.ArgumentParser:
    """Return the parser of the command line, with all subcommands."""
    parser = argparse.ArgumentParser(
        prog="seismass",
        description="How much of a building's live load acts as mass in an earthquake.",
        epilog="exit codes: 0 done, 1 a run failed, 2 bad input, 130 interrupted",
    )
    parser.add_argument("--version", action="version", version=f"seismass {__version__}")
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for command in COMMANDS:
        command.add_parser(subparsers)
    return parser


def _make_output_safe() -> None:
    """Print escapes for what an encoding lacks, and nothing to a stream that the caller has closed."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, io.StringIO())
        elif isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit code: 0 done, 1 a run failed, 2 bad input, 130 interrupted.

    Parameters
    ----------
    arguments : sequence of str, optional
        Without the name of the program; default those of the process.
    """
    _make_output_safe()
    args = build_parser().parse_args(arguments)
    try:
        code: int = args.run(args)
        sys.stdout.flush()
    except BrokenPipeError:
        # The reader has gone, as with `| head`; nothing more can be printed, not even by the interpreter at its end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (SeismassError, OSError) as error:
        print(f"seismass: error: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        # On a terminal a progress bar, or the ^C itself, has begun the line.
        # One Ctrl-C may be heard twice, by a library and by Python.
        with contextlib.suppress(KeyboardInterrupt):
            print("\n" * sys.stderr.isatty() + "seismass: interrupted", file=sys.stderr)
        return INTERRUPTED
    return code
