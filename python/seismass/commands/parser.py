"""The parser of the `seismass` command: its subcommands in groups, and how lists of numbers are typed."""

from __future__ import annotations

import argparse
import importlib
from collections.abc import Iterator, Sequence
from typing import Final

from seismass._kernel import VERSION
from seismass.commands.help_text import HelpText, grouped

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
    "research": ("map", "campaign", "run", "animate"),
    "the paper": ("study", "validate", "report"),
    "shell": ("completion",),
}
"""Subcommands by what one wants, as --help lists them."""

_DESCRIPTION: Final = """How much of a building's live load acts as mass in an earthquake.

the number for your building:
  seismass building --example > warehouse.toml    a file to edit: the building, its goods and its site
  seismass building warehouse.toml                the share to count as mass, with drifts, slips and assumptions"""
_EPILOG: Final = (
    "`seismass COMMAND --help` has examples. exit codes: 0 done, 1 a run failed, 2 bad input, 130 interrupted"
)


def build_parser(only: str | None = None) -> argparse.ArgumentParser:
    """Return the parser of the command line; with `only`, that subcommand alone has its options and the others are only
    listed.
    """
    parser = argparse.ArgumentParser(
        prog="seismass", description=_DESCRIPTION, epilog=_EPILOG, formatter_class=grouped(GROUPS)
    )
    parser.add_argument("--version", action="version", version=f"seismass {VERSION}")
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, (module, text) in COMMANDS.items():
        if only in (None, name):
            importlib.import_module(f"seismass.commands.{module}").COMMAND.add(subparsers, name, text)
        else:
            subparsers.add_parser(name, help=text, formatter_class=HelpText)
    return parser


def parse(words: Sequence[str]) -> argparse.Namespace:
    """Return the options of a command line, without the name of the program; numbers in a row are one list."""
    command = next((word for word in words if not word.startswith("-")), "")
    return build_parser(command).parse_args(list(joined_numbers(words)))


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
