"""The parser of the `seismass` command: its subcommands in groups, exit codes, how help is laid out, and how lists of
numbers are typed.
"""

from __future__ import annotations

import argparse
import importlib
import os
import re
import sys
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Final, NoReturn, TextIO

from seismass._kernel import VERSION
from seismass.base.errors import did_you_mean

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


def columns(stream: TextIO | None = None) -> int | None:
    """Return the width of the terminal, which COLUMNS may state; into a file or pipe what COLUMNS states, else None."""
    stream, stated = stream or sys.stdout, os.environ.get("COLUMNS", "")
    if stated.isdecimal() and int(stated) > 0:
        return int(stated)
    if not stream.isatty():
        return None
    with suppress(OSError, ValueError):
        return os.get_terminal_size(stream.fileno()).columns or 80
    return 80


def tell(message: str) -> None:
    """Print a message about a command to standard error, in lines that fit it."""
    print(_folded(f"seismass: {message}"), file=sys.stderr)


def _folded(text: str) -> str:
    from seismass.media.text_table import folded  # numpy, which --help does not need

    return folded(text, columns(sys.stderr))


class Parser(argparse.ArgumentParser):
    """Says what is wrong with a command line in lines that fit."""

    def error(self, message: str) -> NoReturn:
        """Print usage and message, and exit."""
        self.print_usage(sys.stderr)
        self.exit(BAD_INPUT, f"{_folded(f'{self.prog}: error: {message}')}\n")


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
    """What is typed: whole, or going on in further lines as a shell takes them; its explanation stands below."""
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


COMMANDS: Final = {
    "building": ("building", "your own building: how much of its live load to count as mass"),
    "new": ("new", "a building file from questions, from options, or from another program's storey table"),
    "slip": ("slip", "how far goods slide, to which edge or wall, and whether they slide or rock"),
    "fragility": ("fragility", "what a code's model makes of the probability of exceeding a limit"),
    "risk": ("risk", "the share of the live load that keeps the annual rate of exceeding a drift limit"),
    "explore": ("explore", "the live page: a building with sliding goods, solved while sliders move"),
    "records": ("records", "what record files hold; the paper's seven records in a folder"),
    "spectrum": ("spectrum", "response spectra of records, as CSV"),
    "target": ("target", "a target spectrum of a code, a suite or a building file, as CSV"),
    "scale": ("scale", "scale a suite to a target spectrum"),
    "match": ("match", "match records to a target spectrum"),
    "pulse": ("pulse", "velocity pulses of near-fault records"),
    "map": ("effective_map", "the effective fraction of live load for many buildings: chart and rules"),
    "evidence": ("evidence", "the table by which a code changes its fraction of the live load"),
    "campaign": ("campaign", "a study of any size: axes or samples times motions, into a folder that resumes"),
    "run": ("run", "solve one scene file"),
    "animate": ("animate", "animate a scene file or a building file"),
    "study": ("study", "the parametric study: drift with sliding live load against a code's rule"),
    "validate": ("validate", "the paper's validations and its claims, with our numbers"),
    "report": ("report", "the page of a study or of a building again, from its tables"),
    "completion": ("completion", "what a shell completes: a script for bash or zsh"),
}
"""Subcommands: the module in seismass.commands, which is imported when it is needed, and what --help says of it."""

GROUPS: Final = {
    "my building": ("new", "building", "slip", "fragility", "risk", "explore"),
    "motions": ("records", "spectrum", "target", "scale", "match", "pulse"),
    "research": ("map", "evidence", "campaign", "run", "animate"),
    "the paper": ("study", "validate", "report"),
    "shell": ("completion",),
}
"""Subcommands by what one wants, as --help lists them."""

NEVER_BARE: Final = ("scale",)
"""Subcommands that would run without any option, on motions and for a site that nobody chose."""
_DESCRIPTION: Final = """How much of a building's live load acts as mass in an earthquake.

the number for your building:
  seismass building --example > warehouse.toml    a file to edit: the building, its goods and its site
  seismass building warehouse.toml                the share to count as mass, with drifts, slips and assumptions"""
_EPILOG: Final = (
    "`seismass COMMAND --help` has examples. COLUMNS=80 states the width of what is printed into a pipe. exit codes: 0 "
    "done, 1 a run failed, 2 bad input, 130 interrupted"
)


def build_parser(only: str | None = None) -> argparse.ArgumentParser:
    """Return the parser of the command line; with `only`, that subcommand alone has its options."""
    parser = Parser(prog="seismass", description=_DESCRIPTION, epilog=_EPILOG, formatter_class=grouped(GROUPS))
    parser.add_argument("--version", action="version", version=f"seismass {VERSION}")
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, (module, text) in COMMANDS.items():
        if only in (None, name):
            importlib.import_module(f"seismass.commands.{module}").COMMAND.add(subparsers, name, text)
        else:
            subparsers.add_parser(name, help=text, formatter_class=HelpText)
    return parser


def parse(words: Sequence[str]) -> argparse.Namespace:
    """Return the options of a command line, without the name of the program; numbers in a row are one list. An unknown
    option is refused with the one that it resembles; a command that needs an option shows its help where it has none.
    """
    command = next((word for word in words if not word.startswith("-")), "")
    parser = build_parser(command)
    if command and command not in COMMANDS:
        known = ", ".join(COMMANDS)
        parser.error(f"invalid choice: {command!r}{did_you_mean(command, COMMANDS)}; commands are {known}")
    actions = (action for action in parser._actions if isinstance(action, argparse._SubParsersAction))
    command_parser = next(actions).choices.get(command, parser)
    if list(words) == [command] and command in NEVER_BARE:
        command_parser.print_help()
        command_parser.exit(BAD_INPUT)
    args, unknown = parser.parse_known_args(list(joined_numbers(words)))
    if unknown:
        option = unknown[0].partition("=")[0]
        hint = did_you_mean(option, command_parser._option_string_actions) if option.startswith("--") else ""
        command_parser.error(f"unrecognized arguments: {' '.join(unknown)}{hint}")
    return args


def joined_numbers(words: Sequence[str]) -> Iterator[str]:
    """Yield the words of a command line, with numbers that follow an option joined by commas. An option that took words
    up to the next one would take a file that follows, too.
    """
    run: list[str] = []
    after_option = False
    for word in words:
        option, equals, value = word.partition("=")
        if run and _is_numbers(word):
            run.append(word)
            continue
        if run:
            yield ",".join(run)
            run = []
        if (after_option and _is_numbers(word)) or (option.startswith("--") and equals and _is_numbers(value)):
            run = [word]
        else:
            yield word
        after_option = word.startswith("--") and not equals
    if run:
        yield ",".join(run)


def _is_numbers(text: str) -> bool:
    """Whether a word is numbers alone, with commas between."""
    pieces = [piece for piece in text.split(",") if piece]
    try:
        return bool([float(piece) for piece in pieces])
    except ValueError:
        return False
