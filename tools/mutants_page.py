"""The page that says which planted faults the tests see: docs/mutants.md."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import groupby
from typing import Any

WORDS = """# Planted faults

Written by `make mutants`. It changes the program in one small place, runs the tests, and sees whether one of them
fails. A fault that no test sees shows a test that is missing, or a place where the change makes no difference.

*Listed* faults were chosen by hand (`tests/mutants`), many of them because a test was missing, and then had one: they
say what was mended, and not how much the tests see. That is said by faults *drawn at random*, from all places of the
package and of the kernel where an operator of `tools/random_faults.py` fits: `<` for `<=`, `+` for `-`, `*` for `/`, 0
for 1, `and` for `or`, the largest for the smallest, two arguments exchanged; in Rust the sign of a term, a factor left
out, an index off by one, and conditions. Each operator is drawn as often as the others.

The *chosen tests* are those that name the place, those named like its module, and for faults drawn in Python those of
public calls and whole commands (`tests/test_kept_calls.py`, `tests/test_kept_answers.py`). What they do not see is
asked of the *quick tier*, the tests of `make test`, and then of the *full tier*, those of `make test-all`. An empty
cell is a tier that was not asked. Faults of Rust have no chosen tests: the quick tier is Rust's tests with fewer
random scenes, and for the extension module Python's. A program that does not end counts as caught.

Of faults drawn in Python the chosen tests alone are asked unless `--full` stands on the command line, so that their
share is a lower bound of what all tests see. What survives is a number, a refusal or a sentence without a test, which
then gets one for all places of its kind; or a measure of a picture, such as the width of a line; or no fault, with a
reason in `REASONS` of `tests/mutants`. Once a survivor of a draw has its test, the share of that draw says no more of
all places; `--seed 2` draws others.
"""


def interval(caught: int, asked: int) -> str:
    """Share in per cent, with Wilson's 95 % interval of the share among all faults that could have been drawn."""
    z, share = 1.959964, caught / asked
    middle = (share + z * z / (2 * asked)) / (1 + z * z / asked)
    half = z * math.sqrt(share * (1 - share) / asked + z * z / (4 * asked * asked)) / (1 + z * z / asked)
    return f"{100 * share:.0f} % ({100 * (middle - half):.0f} to {100 * (middle + half):.0f} %)"


def page(faults: Sequence[Any], asked: dict[str, tuple[str, ...]]) -> str:
    """The page: shares caught by layer and tier, what no test sees, and what is no fault."""
    tiers = list(dict.fromkeys(tier for some in asked.values() for tier in some))
    header = ["faults", "asked", "caught", "share", *(f"by the {tier}" for tier in tiers)]
    lines = [WORDS, f"| {' | '.join(header)} |", "| --- |" + " ---: |" * (len(header) - 1)]
    counted = [fault for fault in faults if fault.caught or not fault.reason]
    for group, of_group in groupby(counted, key=lambda fault: fault.group):
        some = sorted(of_group, key=lambda fault: fault.layer)
        rows = [(f"**{group}**", some), *((name, list(own)) for name, own in groupby(some, key=lambda f: f.layer))]
        for name, own in rows:
            caught = [fault for fault in own if fault.caught]
            share = interval if "drawn" in group and own is some else lambda k, n: f"{100 * k / n:.0f} %"
            by = [sum(f.caught == tier for f in own) if tier in asked[group] else "" for tier in tiers]
            cells = [name, len(own), len(caught), share(len(caught), len(own)), *by]
            lines.append(f"| {' | '.join(map(str, cells))} |")
    lines += ["", "In brackets: the 95 % interval of the share among all places that could have been drawn (Wilson)."]
    for title, words, some in (
        (
            "What no test sees",
            "A test is missing, or nobody has shown yet that the change makes no difference.",
            [fault for fault in counted if not fault.caught],
        ),
        (
            "What is no fault",
            "The change makes no difference, for the reason beside it. No test is asked, and none of these counts.",
            [fault for fault in faults if fault.reason],
        ),
    ):
        lines += ["", f"## {title}", "", words if some else "None."]
        for group, own in groupby(some, key=lambda fault: fault.group):
            lines += ["", f"{group}:", "", *(f"- {told(fault)}" for fault in own)]
    return "\n".join(lines) + "\n"


def told(fault: Any) -> str:
    """One fault in a list."""
    number = "" if "drawn" in fault.group else f"{fault.number}. "
    return f"{number}{fault.what}{f': {fault.reason}' if fault.reason else ''}"
