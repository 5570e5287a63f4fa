"""Text for a reader: as it is for a file or another program; on a terminal with its answer in bold, folded to fit."""

from __future__ import annotations

import re
import sys
import textwrap
from typing import Final

_LABELLED: Final = re.compile(r" *(?:\S+(?: \S+)* {2,})?")
"""Indentation of a line, with its label where it has one."""


def show(text: str, answer: str = "") -> None:
    """Print lines.

    Parameters
    ----------
    text : str
        The lines.
    answer : str
        Pattern of the beginnings of lines that are the answer; by default there is none.
    """
    if not sys.stdout.isatty():
        print(text)
        return
    from rich.console import Console
    from rich.text import Text

    console = Console(markup=False, highlight=False, emoji=False)
    pattern = re.compile(answer)
    for line in text.split("\n"):
        style = "bold" if answer and pattern.match(line) else ""
        for piece in folded(line, console.width):
            console.print(Text(piece, style), soft_wrap=True)


def folded(line: str, width: int) -> list[str]:
    """Return a line in pieces that fit, below its label; a row of a table, which has columns, stays whole."""
    label = _LABELLED.match(line)
    start = label.end() if label else 0
    if len(line) <= width or "  " in line[start:] or start > width // 2:
        return [line]
    return textwrap.wrap(line, width, subsequent_indent=" " * start, break_on_hyphens=False, break_long_words=False)
