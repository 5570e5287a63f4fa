"""The warehouse by hand: what the blocks of the page print, which also compare it with `assess`."""

from __future__ import annotations

import contextlib
import io
import re
import tempfile

from pages.parts import Page
from pages.questions import BLOCK, command


def fill(page: Page) -> None:
    """Run the blocks in one folder, those of Python with the names of those before, and put in what they print."""
    names: dict[str, object] = {"__name__": "page"}

    def block(found: re.Match[str]) -> str:
        language, code, between, _ = found.groups()
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            if language == "sh":
                print("".join(command(line) for line in code.splitlines()), end="")
            else:
                exec(compile(code, "code of the page", "exec"), names)
        shown = f"```{language}\n{code}```"
        return shown if between is None else f"{shown}{between}{printed.getvalue().rstrip()}\n```"

    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        page.text = BLOCK.sub(block, page.text)
