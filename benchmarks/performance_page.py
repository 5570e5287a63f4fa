"""The page docs/performance.md: every number in it is measured or computed from what was."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Final

from targets.base import Section, Target, table

HEAD: Final = """\
# Performance

Written by `benchmarks/performance.py` (`make bench`). {recordings}

Measured on: {machine}.

How to read it: times are medians of wall time after a warm-up. What is compared is measured in one run and takes turns
where it can, so ratios hold on other machines better than times do; on a machine that others use too they still
scatter by some per cent, and instruction counts do not. Targets were set before anything was measured, and none is
moved: what is missed is missed.

## Targets

{counts}

{targets}"""


def _bound(target: Target) -> str:
    return f"{'<=' if target.at_most else '>='} {target.bound:g} {target.unit}".rstrip()


def _measured(target: Target) -> str:
    if target.value is None:
        return target.note or "-"
    return f"{target.value:.3g} {target.unit}".rstrip()


def targets_table(sections: Mapping[str, Section]) -> str:
    """Return the targets of all sections, misses included."""
    rows = [
        [target.what.replace("_", r"\_"), _bound(target), _measured(target), _emphasis(target)]
        for section in sections.values()
        for target in section.targets
    ]
    return table(("what", "target", "measured", ""), rows)


def _emphasis(target: Target) -> str:
    return target.verdict if target.verdict == "met" else f"**{target.verdict}**"


def page(sections: Mapping[str, Section], machine: str, *, recorded: bool) -> str:
    """Return the page; `recorded`: motions are recordings."""
    counts = Counter(target.verdict for section in sections.values() for target in section.targets)
    told = ", ".join(f"{counts[verdict]} {verdict}" for verdict in ("met", "missed", "not measured") if counts[verdict])
    where = "Motions are recordings" if recorded else "Motions are the synthetic ones of the package, not recordings"
    head = HEAD.format(
        recordings=f"{where}, unless a section says otherwise.",
        machine=machine,
        counts=f"Of {counts.total()} targets: {told}.",
        targets=targets_table(sections),
    )
    return "\n".join([head, *(f"## {section.title}\n\n{section.text}" for section in sections.values())])
