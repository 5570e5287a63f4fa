"""Text for a reader: as it is for a file or another program; fitted to a terminal, with its answer in bold."""

from __future__ import annotations

import os
import re
import shutil
import sys

from seismass.media.fit_text import fitted_blocks, is_row


def columns() -> int | None:
    """Return the width of the terminal, which COLUMNS may state; None where standard output is not a terminal."""
    return shutil.get_terminal_size().columns if sys.stdout.isatty() else None


def shows_bold() -> bool:
    """Whether standard output is a terminal that shows bold letters, and they are wanted (https://no-color.org)."""
    wanted = not os.environ.get("NO_COLOR") and os.environ.get("TERM") not in ("dumb", "unknown")
    return sys.stdout.isatty() and wanted


def show(text: str, answer: str = "") -> None:
    """Print lines; those whose beginning matches the pattern `answer` are the answer and stand out."""
    width = columns()
    if width is None:
        print(text)
        return
    pattern = re.compile(answer) if answer and shows_bold() else None
    for block, lines in fitted_blocks(text, width):
        whole = pattern is not None and not is_row(block[0]) and pattern.match(block[0])
        for line in lines:
            bold = whole or (pattern is not None and pattern.match(line))
            if bold:
                _print_bold(line)
            else:
                print(line)


def _print_bold(line: str) -> None:
    from rich.console import Console
    from rich.text import Text

    Console(markup=False, highlight=False, emoji=False).print(Text(line, "bold"), soft_wrap=True)
