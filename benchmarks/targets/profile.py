"""Where the instructions go: shares by module and by function, and what each recorded change of the code gained."""

from __future__ import annotations

import re
import subprocess
import tempfile
from collections import Counter
from collections.abc import Sequence
from itertools import pairwise
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
    ("step", instructions.YIELDING, instructions.STEP),
    ("event", instructions.YIELDING, instructions.EVENT),
    ("regime", instructions.YIELDING, instructions.REGIME),
    *(("run", scene, instructions.RUN) for scene in instructions.SECTION4),
    ("run", "sliding, 3 storeys", instructions.RUN),
    ("run", "elastic, 4 storeys", instructions.RUN),
    ("run", "rayleigh, 12 storeys", instructions.RUN),
    ("step of an oscillator", "spectrum", "per oscillator and sample"),
)
"""What the table of changes compares: name, scene, quantity."""
LEAST_CHANGE: Final = 0.015
"""Smallest relative change of a count that the table of changes shows."""
TIMED: Final = (
    (
        "sample intervals above 4 radians of the highest frequency solved in substeps",
        "wall time 1/10 to 1/30",
        "a building on a storey 10 000 times as stiff",
    ),
    ("SciPy imported where it is used", "import time 1/5", "`import seismass`"),
)
"""Changes measured otherwise than by instructions: what changed, what it gained, where."""

TEXT: Final = """{profile}
What each change gained. Instructions are those of `benchmarks/results/instructions.csv` (`make count-instructions
LABEL="..."`), counted by callgrind on the path for AVX2. Each state is compared with the one before it; changes below
1.5 % are not shown. Steps, events and regimes are those of the scene with 4 yielding storeys.

{history}
From the first to the last recorded state: {total}.
"""
PROFILE: Final = """\
Instructions of one run, peaks only, under a built-in motion, by callgrind on the path for AVX2. In words:

{words}

By module of the kernel, inlined code counted where it stands in the sources ({scene}):

{modules}
By function, inlined code counted in the function that it was inlined into:

{functions}"""

MEMORY: Final = "memory: allocated, copied, cleared"
ACTIVITIES: Final = (
    ("take plain steps and prove them clear", ("plain",)),
    (
        "form the series of intervals in which something may happen",
        ("step/drive", "step/polynomials", "step/series", "step/stop"),
    ),
    ("bound quantities over them, look at guards and locate their roots", ("state", "events", "polynomial")),
    ("go from event to event and follow springs, blocks and peaks", ("run", "record", "machines")),
    (
        "form regimes with their steps and tables",
        ("regime", "step/banded", "step/cache", "step/dense", "step/few", "step/full", "step/steps", "step/table"),
    ),
    ("allocate, copy and clear memory", (MEMORY,)),
)
"""What modules do, as a sentence tells it."""

_LINE: Final = re.compile(r"^\s*([\d,]+) \(\s*[\d.]+%\)\s+([^:]+):(.+?)(?: \[.*\])?$")
_KERNEL: Final = re.compile(r"crates/seismass/src/([\w/]+)\.rs")
_FUNCTION: Final = re.compile(r"seismass::((?:[a-z_]+::)+)")
_MEMORY: Final = re.compile(r"malloc|free|calloc|alloc::|mem(cpy|move|set)|_int_")


def module_of(file: str, function: str) -> str:
    """Return the layer of the kernel that a line belongs to, of steps the module too.

    It is told by the file, or by the function where that is inlined.
    """
    found = _KERNEL.search(file) or _FUNCTION.search(function)
    if found:
        parts = [part for part in re.split("/|::", found.group(1)) if part and part != "mod"]
        return "/".join(parts[:2]) if parts[0] == "step" else parts[0]
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


def _states() -> list[tuple[str, list[float | None]]]:
    """Return the recorded states of the code with what `HIGHLIGHTS` names."""
    recorded = instructions.recorded()
    states = []
    for label in recorded["label"].unique(maintain_order=True):
        state = recorded.filter(recorded["label"] == label)
        found = {(scene, quantity): value for _, scene, quantity, value, _ in state.iter_rows()}
        states.append((label, [found.get((scene, quantity)) for _, scene, quantity in HIGHLIGHTS]))
    return states


def changes(before: Sequence[float | None], after: Sequence[float | None]) -> tuple[str, str]:
    """Return by how much counts differ, and the scenes of the runs among them."""
    found: dict[str, list[float]] = {}
    scenes: list[str] = []
    for (name, scene, _), old, new in zip(HIGHLIGHTS, before, after, strict=True):
        if old and new is not None and abs(new / old - 1.0) >= LEAST_CHANGE:
            found.setdefault(name, []).append(100.0 * (new / old - 1.0))
            scenes.append(scene)
    runs = {scene for name, scene, _ in HIGHLIGHTS if name == "run"}
    if runs <= set(scenes):
        scenes = [*(scene for scene in scenes if scene not in runs), "all runs"]
    gained = []
    for name, percents in found.items():
        least, most = (f"{value:+.0f}" for value in (max(percents), min(percents)))
        gained.append(f"{name} {least} %" if least == most else f"{name} {least} to {most} %")
    return ", ".join(gained), "; ".join(dict.fromkeys(scene.partition(", r2")[0] for scene in scenes))


def history() -> tuple[str, str]:
    """Return the table of what each change gained, and what all have gained together."""
    states = _states()
    rows = []
    for (_, before), (label, after) in pairwise(states):
        gained, where = changes(before, after)
        rows.append([label, f"instructions: {gained}" if gained else "less than 1.5 %", where])
    shown = [
        f"{name}{f' ({scene})' if name == 'run' else ''} {first:,.{digits}f} to {last:,.{digits}f}"
        for (name, scene, _), first, last in zip(HIGHLIGHTS, states[0][1], states[-1][1], strict=True)
        if first and last
        for digits in [0 if first >= 100.0 else 1]
    ]
    total = f"instructions per {', '.join(shown)}"
    return table(("what changed", "what it gained", "where it was measured"), [*rows, *map(list, TIMED)]), total


def section(*, quick: bool) -> Section:
    """Profile one run where valgrind is installed; show what was recorded."""
    try:
        profile = "Not measured in the quick mode.\n" if quick else _profile()
    except instructions.Missing as missing:
        profile = f"Not measured: {missing}.\n"
    gained, total = history()
    return Section("Where the instructions go", [], TEXT.format(profile=profile, history=gained, total=total))
