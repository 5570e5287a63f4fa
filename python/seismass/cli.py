"""The `seismass` command: finds the subcommand, runs it, and turns what goes wrong into one line and an exit code."""

from __future__ import annotations

import argparse
import contextlib
import importlib
import io
import os
import sys
from collections.abc import Sequence
from typing import Final

from seismass import __version__
from seismass.errors import SeismassError

COMMANDS: Final = {
    "building": ("building", "your own building: how much of its live load to count as mass"),
    "explore": ("explore", "the live page: a building with sliding goods, solved while sliders move"),
    "map": ("effective_map", "the effective fraction of live load for many buildings: chart and rules"),
    "ida": ("ida", "fragility: what a code's model makes of the probability of exceeding a limit"),
    "slip": ("slip", "how far goods slide, to which edge or wall, and whether they slide or rock"),
    "risk": ("risk", "the share of the live load that keeps the annual rate of exceeding a drift limit"),
    "study": ("study", "the parametric study: drift with sliding live load against a code's rule"),
    "campaign": ("campaign", "a study of any size: axes or samples times motions, into a folder that resumes"),
    "run": ("run", "solve one scene file"),
    "animate": ("animate", "animate one scene file"),
    "records": ("records", "what record files hold; the paper's seven records in a folder"),
    "spectrum": ("spectrum", "response spectra of records, as CSV"),
    "scale": ("scale", "scale a suite to a target spectrum"),
    "match": ("match", "match records to a target spectrum"),
    "pulse": ("pulse", "velocity pulses of near-fault records"),
    "validate": ("validate", "the paper's validations and its claims, with our numbers"),
    "report": ("report", "the page of a study or of a building again, from its tables"),
    "completion": ("completion", "what a shell completes: a script for bash or zsh"),
}
"""Subcommands: the module in seismass.commands, which is imported when it is needed, and what --help says of it."""

INTERRUPTED: Final = 130
"""Exit code after Ctrl-C, as shells give it (128 + SIGINT)."""

_DESCRIPTION: Final = """How much of a building's live load acts as mass in an earthquake.

the number for your building:
  seismass building --example > warehouse.toml    a file to edit: the building, its goods and its site
  seismass building warehouse.toml                the share to count as mass, with drifts, slips and assumptions"""


def build_parser(only: str | None = None) -> argparse.ArgumentParser:
    """Return the parser of the command line.

    Parameters
    ----------
    only : str, optional
        The one subcommand whose options are needed; others are listed alone. By default all of them.
    """
    parser = argparse.ArgumentParser(
        prog="seismass",
        description=_DESCRIPTION,
        epilog="`seismass COMMAND --help` has examples. exit codes: 0 done, 1 a run failed, 2 bad input, 130 stopped",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"seismass {__version__}")
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, (module, text) in COMMANDS.items():
        if only in (None, name):
            importlib.import_module(f"seismass.commands.{module}").add_parser(subparsers, text)
        else:
            subparsers.add_parser(name, help=text)
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
    words = sys.argv[1:] if arguments is None else list(arguments)
    args = build_parser(next((word for word in words if not word.startswith("-")), "")).parse_args(words)
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


if __name__ == "__main__":
    sys.exit(main())
