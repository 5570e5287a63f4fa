"""Where the instructions go: shares by module and by function, and what each recorded state of the code brought."""

from __future__ import annotations

import re
import subprocess
import tempfile
from collections import Counter
from pathlib import Path
from typing import Final

import instructions
from targets.base import Section, table

SCENE: Final = instructions.SECTION4[0]
FUNCTIONS: Final = 15
"""Functions that are listed."""
LEAST: Final = 0.005
"""Smallest share of a module that is listed by itself."""
HIGHLIGHTS: Final = (
    ("step, 4 storeys", instructions.YIELDING, instructions.STEP),
    ("event, 4 storeys", instructions.YIELDING, instructions.EVENT),
    ("regime, 4 storeys", instructions.YIELDING, instructions.REGIME),
    *((f"run, {scene}", scene, instructions.RUN) for scene in instructions.SECTION4),
    ("run, sliding, 3 storeys", "sliding, 3 storeys", instructions.RUN),
    ("run, elastic, 4 storeys", "elastic, 4 storeys", instructions.RUN),
    ("run, 12 storeys", "rayleigh, 12 storeys", instructions.RUN),
    ("spectrum, step", "spectrum", "per oscillator and sample"),
)
"""Columns of the table of what each idea brought: title, scene, quantity."""

TEXT: Final = """{profile}
What each change brought, in instructions (`benchmarks/results/instructions.csv`, written by
`make count-instructions LABEL="..."`); in brackets, the share of the state before:

{history}"""
PROFILE: Final = """\
Instructions of one run, peaks only, under a built-in motion, by callgrind on the path for AVX2. In words:

{words}

By module of the kernel, inlined code counted where it stands in the sources ({scene}):

{modules}
By function, inlined code counted in the function that it was inlined into:

{functions}"""

MEMORY: Final = "memory: allocated, copied, cleared"
ACTIVITIES: Final = (
    ("take plain steps and prove them clear", ("plain_run", "closer_look", "sliding")),
    ("form the series of intervals in which something may happen", ("taylor",)),
    ("bound quantities over them, look at guards and locate their roots", ("state", "bounds", "events", "bernstein")),
    ("go from event to event and follow springs, blocks and peaks", ("simulate", "observe", "storey", "friction")),
    ("form regimes with their steps and tables", ("regime", "regime_bounds", "propagator", "few_storeys")),
    ("allocate, copy and clear memory", (MEMORY,)),
)
"""What modules do, as a sentence tells it."""

_LINE: Final = re.compile(r"^\s*([\d,]+) \(\s*[\d.]+%\)\s+([^:]+):(.+?)(?: \[.*\])?$")
_KERNEL: Final = re.compile(r"crates/seismass/src/(\w+)")
_FUNCTION: Final = re.compile(r"seismass::(\w+)::")
_MEMORY: Final = re.compile(r"malloc|free|calloc|alloc::|mem(cpy|move|set)|_int_")


def module_of(file: str, function: str) -> str:
    """Return the module of the kernel that a line belongs to: by its file, or by its function where that is inlined."""
    found = _KERNEL.search(file) or _FUNCTION.search(function)
    if found:
        return found.group(1)
    if _MEMORY.search(function):
        return MEMORY
    return "other libraries"


def shares(annotated: str) -> tuple[Counter[str], Counter[str]]:
    """Return the instructions by module and by function from what callgrind_annotate prints."""
    modules: Counter[str] = Counter()
    functions: Counter[str] = Counter()
    for line in annotated.splitlines():
        found = _LINE.match(line)
        if found:
            count, file, function = int(found.group(1).replace(",", "")), found.group(2), found.group(3)
            modules[module_of(file, function)] += count
            functions[function] += count
    return modules, functions


def _counted(scene: str) -> tuple[int, Counter[str], Counter[str]]:
    """Instructions of a run: in all, by module and by function."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "callgrind.out"
        total = instructions.profile("run", scene, out).instructions
        command = ["callgrind_annotate", "--threshold=100", "--auto=no", str(out)]
        annotated = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return total, *shares(annotated)


def in_words(scene: str, total: int, modules: Counter[str]) -> str:
    """Return what the instructions of a run do, as a sentence."""
    done = [(sum(modules[name] for name in names), what) for what, names in ACTIVITIES]
    parts = ", ".join(f"{100.0 * count / total:.0f} % {what}" for count, what in done)
    rest = 100.0 * (total - sum(count for count, _ in done)) / total
    others = f"the other {rest:.0f} % are operations of vectors that all of these share, and what is set up once"
    return f"- {scene}: of {total / 1e6:.2f} million instructions {parts}; {others}."


def _profile() -> str:
    counted = {scene: _counted(scene) for scene in instructions.SECTION4}
    total, modules, functions = counted[SCENE]
    large = [(name, count) for name, count in modules.most_common() if count >= LEAST * total]
    rest = total - sum(count for _, count in large)
    return PROFILE.format(
        scene=SCENE,
        words="\n".join(in_words(scene, total, modules) for scene, (total, modules, _) in counted.items()),
        modules=table(
            ("module", "share"), [[name, f"{100.0 * n / total:.1f} %"] for name, n in [*large, ("rest", rest)]]
        ),
        functions=table(
            ("function", "share"),
            [[f"`{name}`", f"{100.0 * n / total:.1f} %"] for name, n in functions.most_common(FUNCTIONS)],
        ),
    )


def history() -> str:
    """Return the table of the recorded states of the code."""
    recorded = instructions.recorded()
    rows, before = [], dict[tuple[str, str], float]()
    for label in recorded["label"].unique(maintain_order=True):
        state = recorded.filter(recorded["label"] == label)
        found = {(scene, quantity): value for _, scene, quantity, value, _ in state.iter_rows()}
        cells = []
        for _, scene, quantity in HIGHLIGHTS:
            value, old = found.get((scene, quantity)), before.get((scene, quantity))
            shown = "-" if value is None else f"{value:,.1f}" if value < 100.0 else f"{value:,.0f}"
            cells.append(shown if value is None or not old else f"{shown} ({100.0 * value / old:.0f} %)")
        rows.append([label, *cells])
        before = found
    return table(("state of the code", *(title for title, _, _ in HIGHLIGHTS)), rows)


def section(*, quick: bool) -> Section:
    """Profile one run where valgrind is installed; show what was recorded."""
    try:
        profile = "Not measured in the quick mode.\n" if quick else _profile()
    except instructions.Missing as missing:
        profile = f"Not measured: {missing}.\n"
    return Section("Where the instructions go", [], TEXT.format(profile=profile, history=history()))
