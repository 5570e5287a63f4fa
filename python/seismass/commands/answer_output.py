"""How a command gives its answer: what it writes, and what it prints."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal, Protocol

from seismass.commands.frame import seconds, show
from seismass.commands.options import left_out, warn_left_out

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seismass.motions.records import Pairs, Suite


class Answer(Protocol):
    """A result as commands print and write it; every `Result` is one."""

    @property
    def text(self) -> str:
        """What is printed."""

    def to_json(self) -> str:
        """Return what is printed for another program."""

    def write(self, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
        """Write tables, and figures if asked for, and return the files."""


def give_answer(
    args: argparse.Namespace, result: Answer, suite: Suite | Pairs, *, head: str = "", indent: int = 0, answer: str = ""
) -> None:
    """Write the files of an answer and print it below `head`. What its motions leave out is printed below the text,
    indented by `indent`, or on standard error beside JSON.
    """
    print_answer(args, result, suite, write_answer(args, result), head=head, indent=indent, answer=answer)


def write_answer(args: argparse.Namespace, result: Answer) -> list[Path]:
    """Write the files of an answer where the options ask for them, and return them."""
    return [] if args.out is None else result.write(args.out, figures=not args.no_figures)


def print_answer(
    args: argparse.Namespace,
    result: Answer,
    suite: Suite | Pairs,
    files: Sequence[Path],
    *,
    head: str = "",
    indent: int = 0,
    answer: str = "",
) -> None:
    """Print an answer whose files are written; see `give_answer`."""
    from seismass.media.result import PAGE

    if args.json:
        warn_left_out(suite)
        print(result.to_json())
        return
    show(f"{head}{result.text}", answer)
    for line in left_out(suite):
        show(" " * indent + line)
    page = f", the page is {args.out / PAGE}" if any(file.name == PAGE for file in files) else ""
    written = f"{len(files)} files in {args.out}{page}, " if files else ""
    show(f"\n{written}{seconds(args)}")


def write_figure(figure: Figure, path: Path) -> None:
    """Write one figure, PNG or SVG by the suffix of its file."""
    from seismass.base.files import write_file
    from seismass.media.svg import figure_content

    kind: Literal["png", "svg"] = "svg" if path.suffix.lower() == ".svg" else "png"
    write_file(path, figure_content(figure, kind))
