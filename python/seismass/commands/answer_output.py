"""The output of the commands whose answer is a result with a text, tables and figures: `ida`, `risk` and `slip`."""

from __future__ import annotations

import argparse
import json
import os
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from seismass.commands.options import left_out, threads_option, warn_left_out

if TYPE_CHECKING:
    from seismass.records import Suite


class Answer(Protocol):
    """A result that these commands print and write."""

    @property
    def text(self) -> str:
        """What the command prints."""

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain values."""

    def write(self, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
        """Write tables, and figures if asked for, and return the files."""


def add_answer_options(parser: argparse.ArgumentParser) -> None:
    """Add --seed, --out, --jobs, --json and --no-figures."""
    output = parser.add_argument_group("running and output")
    output.add_argument("--seed", type=int, default=0, metavar="N", help="seed of the bootstrap (0)")
    output.add_argument("--out", type=Path, metavar="DIR", help="folder to write tables and figures to")
    output.add_argument("--jobs", type=threads_option, metavar="N", help="threads (all cores); changes no digit")
    output.add_argument("--json", action="store_true", help="print the answer as JSON")
    output.add_argument("--no-figures", action="store_true", help="write tables only")


def give_answer(
    args: argparse.Namespace, result: Answer, suite: Suite, *, head: str, indent: int, started: float
) -> None:
    """Write the files of an answer and print it.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `add_answer_options`.
    result : Answer
        The answer.
    suite : Suite
        Its motions. What they leave out is printed below the text, or on standard error beside JSON.
    head : str
        What is printed before the text, with its ends of lines.
    indent : int
        Spaces before what the motions leave out.
    started : float
        When the command began, by `time.perf_counter`.

    Raises
    ------
    OSError
        A file cannot be written.
    """
    files = [] if args.out is None else result.write(args.out, figures=not args.no_figures)
    if args.json:
        warn_left_out(suite)
        print(json.dumps(result.to_dict(), indent=2, allow_nan=False))
        return
    print(f"{head}{result.text}")
    for line in left_out(suite):
        print(" " * indent + line)
    written = f"{len(files)} files in {args.out}, " if files else ""
    print(f"\n{written}{time.perf_counter() - started:.1f} s")
