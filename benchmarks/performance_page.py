"""The page docs/performance.md: every number in it is measured or computed from what was."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Final

from targets.base import Section, Target, table

HEAD: Final = """\
# Performance

Written by `benchmarks/performance.py` (`make bench`). {recordings}

Measured on: {machine}.

Times are medians of wall time after a warm-up, unless a section says otherwise. Quantities that are compared are
measured alternately in one run where possible, so ratios carry over to other machines better than times. On a shared
machine ratios scatter by some per cent; instruction counts do not. Brackets show quartiles of alternating measurements.
Where the bound lies between the quartiles, the verdict is marked "within scatter".

## Targets

The targets were set before anything was measured and have not been changed. {counts}

{targets}"""
LATER: Final = """
Added after these had been measured, with the same bound: the short motions at half their step, which gives them the
number of samples that the target assumes, and one of them scaled down to the number of events that it assumes.
{counts}

{targets}"""


def _bound(target: Target) -> str:
    return f"{'<=' if target.at_most else '>='} {target.bound:g} {target.unit}".rstrip()


def _measured(target: Target) -> str:
    if target.value is None:
        return target.note or "-"
    scatter = f"({target.scatter[0]:.3g} to {target.scatter[1]:.3g}) " if target.scatter else ""
    return f"{target.value:.3g} {scatter}{target.unit}".rstrip()


def targets_table(targets: Iterable[Target]) -> str:
    """Return targets with what was measured, misses included."""
    rows = [
        [target.what.replace("_", r"\_"), _bound(target), _measured(target), _emphasis(target)] for target in targets
    ]
    return table(("what", "target", "measured", ""), rows)


def _emphasis(target: Target) -> str:
    told = target.verdict if target.verdict == "met" else f"**{target.verdict}**"
    return f"{told}, within scatter" if target.within_scatter else told


def _counts(targets: Sequence[Target]) -> str:
    counts = Counter(target.verdict for target in targets)
    told = ", ".join(f"{counts[verdict]} {verdict}" for verdict in ("met", "missed", "not measured") if counts[verdict])
    return f"Of {len(targets)} targets: {told}."


def page(sections: Mapping[str, Section], machine: str, *, recorded: bool) -> str:
    """Return the page; `recorded`: motions are recordings."""
    targets = [target for section in sections.values() for target in section.targets]
    first = [target for target in targets if not target.later]
    later = [target for target in targets if target.later]
    where = "Motions are recordings" if recorded else "Motions are the synthetic ones of the package, not recordings"
    head = HEAD.format(
        recordings=f"{where}, unless a section says otherwise.",
        machine=machine,
        counts=_counts(first),
        targets=targets_table(first),
    )
    if later:
        head += LATER.format(counts=_counts(later), targets=targets_table(later))
    return "\n".join([head, *(f"## {section.title}\n\n{section.text}" for section in sections.values())])
