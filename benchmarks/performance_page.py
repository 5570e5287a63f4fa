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

## In short

On this machine, for four storeys with blocks, one more sample in which nothing happens costs some eight nanoseconds. A
whole run of 2000 samples in which nothing yields or slides takes some twenty-five per sample, everything included. An
event costs some 0.4 microseconds: the paper's section-4 building under a record with a few hundred events takes 0.15 to
0.3 ms on one core, the 1008 analyses of its section 5 less than a third of a second on two. At equal error that is
hundreds of times less than OpenSees, and at an error of 1e-6 of the drift history at least twelve times less than a
compiled leapfrog. If an error of 1e-3 to 1e-2 is acceptable and events are frequent, that can still be up to about 1.1
times as fast as the exact run. These times are under recordings; [error against run time](work_precision.md) compares
programs.

The kernel selects an instruction set at run time. `sm.runs.instruction_set()` and the statistics of each response name
it. The environment variable `SEISMASS_INSTRUCTIONS` selects another one: `baseline`, which every machine has, or `avx2`
or `avx512` where available. An instruction set gives the same bits on every machine, and the baseline gives the same
bits on x86-64 and aarch64 (`crates/seismass-judge/tests/same_bits.rs` and `make test-aarch64` check this by emulation).
`avx2` and `avx512` give the same bits too; the baseline agrees with them to rounding.

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
