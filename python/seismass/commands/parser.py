"""The parser of the `seismass` command: its subcommands, and what its help says of them."""

from __future__ import annotations

import argparse
import importlib
from typing import Final

from seismass._kernel import VERSION

COMMANDS: Final = {
    "building": ("building", "your own building: how much of its live load to count as mass"),
    "explore": ("explore", "the live page: a building with sliding goods, solved while sliders move"),
    "map": ("effective_map", "the effective fraction of live load for many buildings: chart and rules"),
    "ida": ("ida", "fragility: what a code's model makes of the probability of exceeding a limit"),
    "slip": ("slip", "how far goods slide, to which edge or wall, and whether they slide or rock"),
    "risk": ("risk", "the share of the live load that keeps the annual rate of exceeding a drift limit"),
    "study": ("study", "the parametric study: drift with sliding live load against a code's rule"),
    "campaign": ("campaign", "a study of any size: axes or samples times motions, into a folder that resumes"),
    "run": ("run", "solve one scene file"),
    "animate": ("animate", "animate one scene file"),
    "records": ("records", "what record files hold; the paper's seven records in a folder"),
    "spectrum": ("spectrum", "response spectra of records, as CSV"),
    "scale": ("scale", "scale a suite to a target spectrum"),
    "match": ("match", "match records to a target spectrum"),
    "pulse": ("pulse", "velocity pulses of near-fault records"),
    "validate": ("validate", "the paper's validations and its claims, with our numbers"),
    "report": ("report", "the page of a study or of a building again, from its tables"),
    "completion": ("completion", "what a shell completes: a script for bash or zsh"),
}
"""Subcommands: the module in seismass.commands, which is imported when it is needed, and what --help says of it."""

_DESCRIPTION: Final = """How much of a building's live load acts as mass in an earthquake.

the number for your building:
  seismass building --example > warehouse.toml    a file to edit: the building, its goods and its site
  seismass building warehouse.toml                the share to count as mass, with drifts, slips and assumptions"""


def build_parser(only: str | None = None) -> argparse.ArgumentParser:
    """Return the parser of the command line.

    Parameters
    ----------
    only : str, optional
        The one subcommand whose options are needed; others are listed alone. By default all of them.
    """
    parser = argparse.ArgumentParser(
        prog="seismass",
        description=_DESCRIPTION,
        epilog="`seismass COMMAND --help` has examples. exit codes: 0 done, 1 a run failed, 2 bad input, 130 stopped",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"seismass {VERSION}")
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for name, (module, text) in COMMANDS.items():
        if only in (None, name):
            importlib.import_module(f"seismass.commands.{module}").add_parser(subparsers, text)
        else:
            subparsers.add_parser(name, help=text)
    return parser
