"""What the code and the commands of the page print.

A block of TOML whose first line is `# NAME` is the file NAME. Blocks of Python run by themselves. Commands run one
after another in one folder; `> FILE` and `| head -n COUNT` mean what they do in a shell. A block of plain text below
either is what they print.
"""

from __future__ import annotations

import contextlib
import io
import re
import shlex
import tempfile
from pathlib import Path
from typing import Final

from pages.parts import Page
from seismass.cli import main as seismass

BLOCK: Final = re.compile(r"^```(\w+)\n(.*?)^```$(?:(\n\n```text\n)(.*?)^```$)?", re.MULTILINE | re.DOTALL)
"""A block of code with its language, and the block of plain text below it, where there is one."""


def fill(page: Page) -> None:
    """Put in what the blocks print today, made in an empty folder."""

    def block(found: re.Match[str]) -> str:
        language, code, between, _ = found.groups()
        text = printed_by(language, code)
        shown = f"```{language}\n{code}```"
        return shown if between is None else f"{shown}{between}{text.strip()}\n```"

    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        page.text = BLOCK.sub(block, page.text)


def command(line: str) -> str:
    """Run a command of a page and return what of it is seen.

    Raises
    ------
    SystemExit
        It is no command of seismass, or it fails.
    """
    asked, piped, head = line.partition(" | ")
    asked, redirected, file = asked.partition(" > ")
    program, *arguments = shlex.split(asked, comments=True)
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(io.StringIO()) as said:
        code = seismass(arguments) if program == "seismass" else 2
    if code != 0:
        raise SystemExit(f"the command must end with code 0; got {code}: {line}\n{said.getvalue()}")
    text = printed.getvalue()
    if redirected:
        Path(file.strip()).write_text(text, encoding="utf-8")
        return ""
    if not piped:
        return text
    counted = re.fullmatch(r"head -n (\d+)", head.strip())
    if counted is None:
        raise SystemExit(f"a command is piped to head -n COUNT alone; got {head}")
    return "".join(text.splitlines(keepends=True)[: int(counted[1])])


def printed_by(language: str, code: str) -> str:
    """Return what a block prints in the present folder; a block of TOML is written there."""
    if language == "toml":
        name = code.partition("\n")[0].removeprefix("# ")
        Path(name).write_text(code, encoding="utf-8")
        return ""
    if language == "sh":
        return "".join(command(line) for line in code.splitlines())
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(code, "code of the page", "exec"), {"__name__": "page"})
    return printed.getvalue()
