"""How help is laid out: paragraphs, lists and examples at the width of the terminal, and commands in groups."""

from __future__ import annotations

import argparse
import re
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from typing import Final

DONE: Final = 0
FAILED: Final = 1
BAD_INPUT: Final = 2
INTERRUPTED: Final = 130
"""After Ctrl-C, as shells give it: 128 + SIGINT."""
ANY_COMMAND: Final = {DONE: "done", BAD_INPUT: "bad input", INTERRUPTED: "interrupted"}
"""How every command may end."""
RUNS: Final = {FAILED: "a run failed"}
"""How a command that solves runs may end besides."""

EXAMPLE: Final = "  seismass "
"""How a line begins that is typed."""
_HANGING: Final = re.compile(r" +(?:\S+(?: \S+)* {2,})?")
"""Indentation of a line in a list, with its first column where there is one."""


class HelpText(argparse.HelpFormatter):
    """Fills paragraphs and indented lines of descriptions and epilogs; examples can still be typed."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return "\n".join(_filled(text, width))


def grouped(groups: Mapping[str, Sequence[str]]) -> type[HelpText]:
    """Return the layout of help that lists commands by group, each of them with its names."""

    class Grouped(HelpText):
        def _format_action(self, action: argparse.Action) -> str:
            listed = {command.dest: command for command in self._iter_indented_subactions(action)}
            if not listed:
                return super()._format_action(action)
            self._indent()
            # What argparse makes room for does not count that commands are indented.
            longest = max(len(name) for name in listed) + self._current_indent
            self._action_max_length = max(self._action_max_length, longest)
            parts = ["".join(self._format_action(listed[name]) for name in names) for names in groups.values()]
            self._dedent()
            headings = (f"{'':{self._current_indent}}{group}:\n" for group in groups)
            return "\n".join(heading + part for heading, part in zip(headings, parts, strict=True))

    return Grouped


def _filled(text: str, width: int) -> Iterator[str]:
    paragraph: list[str] = []
    for line in [*text.splitlines(), ""]:
        if line and not line.startswith(" "):
            paragraph.append(line)
            continue
        if paragraph:
            yield from textwrap.wrap(" ".join(paragraph), width)
            paragraph = []
        if line.startswith(EXAMPLE):
            yield from _example(line, width)
        elif line:
            start = _HANGING.match(line)
            hanging = " " * min(start.end() if start else 0, width // 2)
            yield from textwrap.wrap(line, width, subsequent_indent=hanging, break_on_hyphens=False)
        else:
            yield ""


def _example(line: str, width: int) -> Iterator[str]:
    """What is typed: whole, or going on in further lines as a shell takes them; what is said of it stands below."""
    if len(line) <= width:
        yield line
        return
    typed, _, meaning = line.strip().partition("    ")
    together = re.sub(r"(?<= )(--\S+) (?!--)", "\\1\0", typed)  # an option and its value
    pieces = textwrap.wrap(f"  {together}", width - 2, subsequent_indent=" " * 6, break_on_hyphens=False)
    pieces = [piece.replace("\0", " ") for piece in pieces]
    yield from (f"{piece} \\" for piece in pieces[:-1])
    yield pieces[-1]
    yield from textwrap.wrap(meaning.strip(), width, initial_indent=" " * 6, subsequent_indent=" " * 6)
