"""One subcommand: what it is for, what is typed, its options, what it does, and how it ends."""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from seismass.commands.exit_codes import ANY_COMMAND
from seismass.commands.help_text import HelpText


@dataclass(frozen=True, kw_only=True)
class Command:
    """One subcommand: what it answers, examples without the name of the program, a function that adds its options, one
    that runs and returns an exit code, and exit codes of its own beside `ANY_COMMAND`.
    """

    description: str
    examples: str
    options: Callable[[argparse.ArgumentParser], None]
    run: Callable[[argparse.Namespace], int]
    note: str = ""
    codes: Mapping[int, str] = field(default_factory=dict)

    @property
    def epilog(self) -> str:
        """Examples, note and exit codes."""
        examples = "\n".join(f"  seismass {line}" for line in self.examples.strip().splitlines())
        codes = ", ".join(f"{code} {meaning}" for code, meaning in sorted({**ANY_COMMAND, **self.codes}.items()))
        parts = (f"examples:\n{examples}", self.note.strip("\n"), f"exit codes: {codes}")
        return "\n\n".join(part for part in parts if part)

    def add(self, subparsers: Any, name: str, help: str) -> None:
        """Add the parser to those of the `seismass` command, with the line that lists it."""
        parser = subparsers.add_parser(
            name, help=help, description=self.description, epilog=self.epilog, formatter_class=HelpText
        )
        parser.register("type", Path, _path)
        self.options(parser)
        parser.set_defaults(run=self.timed)

    def timed(self, args: argparse.Namespace) -> int:
        """Run with the clock started, which `seconds` reads."""
        args.started = time.perf_counter()
        return self.run(args)


def _path(text: str) -> Path:
    """Read an argument of type Path; Path("") would be the current folder."""
    if not text:
        raise argparse.ArgumentTypeError("must be a path; got ''")
    return Path(text)


def seconds(args: argparse.Namespace) -> str:
    """Return how long the command has taken, as it is printed."""
    return f"{time.perf_counter() - args.started:.1f} s"
