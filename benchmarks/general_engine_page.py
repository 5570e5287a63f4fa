"""The page docs/general_engine.md of what benchmarks/general_engine.py has measured."""

from __future__ import annotations

from typing import Any, Final

PLAIN: Final[dict[str, int]] = {"8": 167, "16": 2802}
"""A plain C++ solver by series, by coordinates of both directions: whole runs (ms, one core of another machine)."""


def _work_and_error(rows: list[dict[str, Any]]) -> list[str]:
    lines = ["| | time ms | drift error | slip error |", "| --- | --- | --- | --- |"]
    for row in rows:
        if row["status"] != "ok":
            lines.append(f"| {row['setting']} | {row['status']} | - | - |")
            continue
        slip = "-" if row["slip"] is None else f"{row['slip']:.1e}"
        lines.append(f"| {row['setting']} | {1e3 * row['time']:.2f} | {row['drift']:.1e} | {slip} |")
    return lines


def _plane(data: dict[str, Any]) -> list[str]:
    """Two directions: costs by coordinates, a suite, and OpenSees."""
    lines = [
        "",
        "## Two horizontal directions",
        "",
        f"{data['machine']}.",
        "Buildings equal in both directions with goods on every floor (mu = 0.2, half the floor's mass), under",
        "synthetic-3 and synthetic-4 at 0.45 g; whole runs yield and slide. The last row is",
        "a rack of three levels of 50 kg under 1000 kg each on a two-storey building: its goods slide in stiff",
        "directions. A plain C++ solver by series takes what the last column says for the same files, on another",
        "machine.",
        "",
        "| coordinates | nothing slides: a sample us | whole run ms | events | steps | C++: whole run ms |",
        "| --- | --- | --- | --- | --- | --- |",
    ]
    for row in data["costs"]:
        lines.append(
            f"| {row['coordinates']} | {_micro(row['sample'])} | {1e3 * row['run']:.1f} | {row['events']} | "
            f"{row['series_steps']} | {PLAIN.get(row['coordinates'], '-')} |"
        )
    suite = data["suite"]
    return [
        *lines,
        "",
        f"Such a building of four storeys under {suite['runs']} pairs of motions ({suite['samples']} samples, "
        f"{suite['events']} events) takes {suite['time']:.1f} s of one thread.",
        "",
        "### OpenSees: flat sliders on a yielding building of two storeys",
        "",
        "Errors are of the lengths of drift and slip vectors at the steps. The element is flatSliderBearing with",
        "Coulomb friction, which has the same circle; before it slides it is a spring, k times as stiff as the",
        "stiffest storey.",
        "",
        *_work_and_error(data["opensees"]),
    ]


def _micro(value: float | None) -> str:
    return "-" if value is None else f"{1e6 * value:.2f}"


def page(data: dict[str, Any], repeats: int) -> str:
    """Return the page of the measurements."""
    lines = [
        "# Cost of the general engine, and OpenSees on racks, walls and the plane",
        "",
        "Made by `python benchmarks/general_engine.py --write .`; the numbers are kept in",
        "`benchmarks/results/general_engine.json`.",
        "",
        f"{data['machine']}; OpenSees: {data['opensees_machine']}.",
        f"Processor time of one thread, median of {repeats} runs after a first; the motion is",
        f"{data['motion']}. Times are of whole calls of `simulate`, without histories.",
        "",
        "## By number of coordinates",
        "",
        "Buildings with racks whose floors and levels are n in all; for the chain engine shear buildings of n",
        "storeys. A",
        "sample is of an elastic building whose goods are fixed; an event is what a run that yields and slides",
        "takes more,",
        "over its events. OpenSees: Newmark at the time step of the motion, friction by springs 1e3 times as",
        "stiff as the",
        "stiffest spring, per sample with all that happens in it.",
        "",
        "| n | general: a sample us | an event us | events | chain: a sample us | an event us "
        "| OpenSees: a sample us |",
        "| --- | --- | --- | --- | --- | --- | --- |",
    ]
    for row in data["costs"]:
        general, chain = row["general"], row["chain"]
        lines.append(
            f"| {row['nodes']} | {_micro(general['sample'])} | {_micro(general['event'])} | {general['events']} | "
            f"{_micro(chain['sample'])} | {_micro(chain['event'])} | {_micro(row['opensees'])} |"
        )
    suite = data["suite"]
    lines += [
        "",
        f"A rack building of 30 coordinates under {suite['runs']} motions ({suite['samples']} samples, "
        f"{suite['events']} events) takes {suite['time']:.1f} s of one thread.",
        "",
        "## OpenSees on a rack and a wall-frame",
        "",
        "Both models have the same masses, springs, dampers and matrices. The error is that of the peaks at the",
        "steps, over",
        "the largest drift or slip; what is exact is the general engine, which agrees with an independent program",
        "to 1e-14",
        "([method](numerics.md), 9.5). For the engine itself the table has the residual of its energies.",
    ]
    for name, title in (
        ("rack", "A rack of three levels on floor 1 of two yielding storeys, goods that slide"),
        ("wall", "A flexural cantilever beside a yielding frame of four storeys, goods that slide"),
    ):
        lines += ["", f"### {title}", ""]
        lines += _work_and_error(data["opensees"][name])
    lines += [
        "",
        "Where the differences come from: a friction spring creeps, by its yield force over its stiffness,",
        "whenever a block",
        "should stick; a step that has an event in it goes on with the forces of its start or end, so the error",
        "falls like",
        "the step and not like its square; peaks are taken at steps. With stiffer springs and shorter steps",
        "together the",
        "peaks of OpenSees approach those of the engine; stiffer springs alone do not help, as the step does not",
        "resolve",
        "them. Models and motions are the same to rounding: with goods fixed and springs elastic the two differ by the",
        f"period error of the method alone ({data['elastic']:.1e} of the drift at dt / 20 for the rack).",
    ]
    return "\n".join([*lines, *_plane(data["plane"]), ""])
