"""Cost of the general engine by number of coordinates beside the chain engine and OpenSees: a rack, a wall, the plane.

Usage: python benchmarks/general_engine.py [--plane] [--write FOLDER]. It prints the page docs/general_engine.md, or
writes it into a folder with the measured numbers (general_engine.json). With --plane it measures what is in two
directions and takes the other numbers from those that are kept; without OpenSees, its numbers. Times are processor
times of one thread.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

import general_opensees
import plane_opensees
import seismass as sm
from environment import summary
from general_engine_page import page
from general_scenes import (
    FloatArray,
    chain_of_nodes,
    in_plane,
    of_nodes,
    plane_scene,
    rack_scene,
    stiff_plane_scene,
    wall_scene,
)

NODES: Final = (4, 8, 16, 30)
SETTINGS: Final = ((1e2, 1), (1e3, 1), (1e3, 5), (1e4, 5), (1e4, 20))
"""Stiffness of OpenSees' friction springs over that of the stiffest spring, and steps in a sample interval."""
REPEATS: Final = 7


def _time(work: Callable[[], Any], repeats: int = REPEATS) -> float:
    """Median processor time after a first run (s)."""
    work()
    taken = []
    for _ in range(repeats):
        began = time.process_time()
        work()
        taken.append(time.process_time() - began)
    return statistics.median(taken)


def _costs(make: Callable[..., sm.Scene], nodes: int, motion: sm.Motion) -> dict[str, float]:
    """Time of a sample without events, and what an event takes more (s)."""
    still, moving = make(nodes, events=False), make(nodes, events=True)
    plain = _time(lambda: sm.simulate(still, motion, events=False))
    whole = _time(lambda: sm.simulate(moving, motion, events=False))
    events = sm.simulate(moving, motion, events=False).statistics["events"]
    return {
        "sample": plain / motion.samples,
        "event": (whole - plain) / events,
        "events": events,
        "run": whole,
    }


def costs(motion: sm.Motion) -> list[dict[str, Any]]:
    """Return the costs by number of coordinates of both engines, and the time of a sample in OpenSees (s)."""
    rows = []
    for nodes in NODES:
        row: dict[str, Any] = {"nodes": nodes, "general": _costs(of_nodes, nodes, motion)}
        row["chain"] = _costs(chain_of_nodes, nodes, motion)
        row["opensees"] = None
        if general_opensees.ops is not None:
            scene = of_nodes(nodes, events=True)
            began = time.process_time()
            general_opensees.run(scene, motion, 1e3, 1)
            row["opensees"] = (time.process_time() - began) / motion.samples
        rows.append(row)
        print(row, file=sys.stderr, flush=True)
    return rows


def suite_time(nodes: int) -> dict[str, float]:
    """Time of a rack building under 42 motions: the built-in forty, and two of them again at another scale."""
    scene = of_nodes(nodes, events=True)
    forty = list(sm.builtin_suite("forty"))
    motions = [record.motion for record in forty] + [record.scaled(1.5).motion for record in forty[:2]]
    began = time.process_time()
    runs = [sm.simulate(scene, motion, events=False) for motion in motions]
    return {
        "time": time.process_time() - began,
        "runs": len(runs),
        "samples": sum(motion.samples for motion in motions),
        "events": sum(run.statistics["events"] for run in runs),
    }


def plane_costs(motions: tuple[sm.Motion, sm.Motion]) -> list[dict[str, Any]]:
    """Return the costs of a sample in two directions while nothing slides, and of a whole run with its steps (s)."""
    rows = []
    scenes = [(f"{2 * storeys}", in_plane(storeys, events=False), in_plane(storeys, events=True)) for storeys in (4, 8)]
    for name, still, moving in (*scenes, ("10, rack", None, stiff_plane_scene())):
        row: dict[str, Any] = {"coordinates": name, "sample": None}
        if still is not None:
            samples = max(motion.samples for motion in motions)
            row["sample"] = _time(partial(sm.simulate, still, motions, events=False)) / samples
        row["run"] = _time(partial(sm.simulate, moving, motions, events=False), 3)
        run = sm.simulate(moving, motions, events=False)
        row |= {key: run.statistics[key] for key in ("events", "series_steps")}
        rows.append(row)
        print(row, file=sys.stderr, flush=True)
    return rows


def plane_suite_time() -> dict[str, float]:
    """Time of a four-storey building in two directions under 42 pairs of the built-in forty motions."""
    scene = in_plane(4, events=True)
    records = list(sm.builtin_suite("forty"))
    numbers = [(i, (i + 1) % len(records)) for i in range(len(records))] + [(0, 2), (1, 3)]
    began, samples, events = time.process_time(), 0, 0
    for x, y in numbers:
        run = sm.simulate(scene, (records[x].motion, records[y].motion), events=False)
        samples, events = samples + run.motions[0].samples, events + run.statistics["events"]
    return {"time": time.process_time() - began, "runs": len(numbers), "samples": samples, "events": events}


def plane_against_opensees(motions: tuple[sm.Motion, sm.Motion]) -> list[dict[str, Any]]:
    """Return time and error of OpenSees on the vectors of a scene in two directions, beside the general engine."""
    scene = plane_scene()
    run = sm.simulate(scene, motions, energy=True)
    drift, slip = run.peak_drift[:, 2], run.peak_slip[:, 2]
    taken = _time(partial(sm.simulate, scene, motions, events=False), 3)
    rows: list[dict[str, Any]] = [_of_engine(taken, run.energy["relative_residual"], run.statistics["events"])]
    for friction, substeps in SETTINGS if general_opensees.ops is not None else ():
        rows.append(_of_opensees(partial(plane_opensees.run, scene, motions), (drift, slip), friction, substeps))
        print("plane", rows[-1], file=sys.stderr, flush=True)
    return rows


def _of_engine(taken: float, residual: float, events: int) -> dict[str, Any]:
    return {
        "setting": "general engine",
        "time": taken,
        "drift": abs(residual),
        "slip": None,
        "status": "ok",
        "events": events,
    }


def _of_opensees(
    run: Callable[[float, int], general_opensees.Outcome],
    exact: tuple[FloatArray, FloatArray],
    friction: float,
    substeps: int,
) -> dict[str, Any]:
    row: dict[str, Any] = {"setting": f"OpenSees, {friction:.0e} k, dt / {substeps}", "status": "ok"}
    drift, slip = exact
    began = time.process_time()
    try:
        outcome = run(friction, substeps)
    except RuntimeError as error:
        row |= {"status": str(error), "drift": None, "slip": None}
    else:
        row["drift"] = float(np.abs(outcome.drift - drift).max() / drift.max())
        row["slip"] = float(np.abs(outcome.slip - slip).max() / slip.max())
    return row | {"time": time.process_time() - began}


def against_opensees(motion: sm.Motion) -> dict[str, list[dict[str, Any]]]:
    """Return time and error of OpenSees on a rack and a wall-frame, beside the general engine."""
    found = {}
    for name, scene in (("rack", rack_scene()), ("wall", wall_scene())):
        run = sm.simulate(scene, motion, energy=True)
        drift, slip = np.concatenate([run.peak_drift, *run.peak_rack_drift]), run.peak_slip
        taken = _time(partial(sm.simulate, scene, motion, events=False))
        rows = [_of_engine(taken, run.energy["relative_residual"], run.statistics["events"])]
        for friction, substeps in SETTINGS if general_opensees.ops is not None else ():
            rows.append(_of_opensees(partial(general_opensees.run, scene, motion), (drift, slip), friction, substeps))
            print(name, rows[-1], file=sys.stderr, flush=True)
        found[name] = rows
    return found


def elastic_difference(motion: sm.Motion) -> float | None:
    """Return the difference of peak drifts with a rack whose goods are fixed on an elastic building, at dt / 20."""
    if general_opensees.ops is None:
        return None
    scene = of_nodes(8, events=False)
    run = sm.simulate(scene, motion)
    drift = np.concatenate([run.peak_drift, *run.peak_rack_drift])
    found = general_opensees.run(scene, motion, 1e3, 20).drift
    return float(np.abs(found - drift).max() / drift.max())


def keep_opensees(data: dict[str, Any], kept: dict[str, Any]) -> None:
    """Take the numbers of OpenSees from those that are kept."""
    data["opensees_machine"] = kept["opensees_machine"]
    for row, before in zip(data["costs"], kept["costs"], strict=True):
        row["opensees"] = before["opensees"]
    for name, rows in (*data["opensees"].items(), ("plane", data["plane"]["opensees"])):
        rows[1:] = (kept["plane"]["opensees"] if name == "plane" else kept["opensees"][name])[1:]
    data["elastic"] = kept["elastic"]


def main() -> int:
    """Measure, and print or write the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument(
        "--write", type=Path, help="folder of the project: docs and benchmarks/results in it are written"
    )
    parser.add_argument("--plane", action="store_true", help="measure two directions alone")
    given = parser.parse_args()
    first, second = (sm.builtin_record(f"synthetic-{number}") for number in (3, 4))
    motion, other = (record.scaled(0.45 / record.pga_g).motion for record in (first, second))
    motions = (motion, other)
    kept = json.loads((Path(__file__).parent / "results" / "general_engine.json").read_text())
    data: dict[str, Any] = dict(kept)
    if not given.plane:
        data = {
            "machine": summary(("numpy", "openseespy")),
            "motion": f"synthetic-3 at 0.45 g, {motion.samples} samples",
            "costs": costs(motion),
            "suite": suite_time(30),
            "opensees": against_opensees(motion),
            "elastic": elastic_difference(motion),
        }
    data["plane"] = {
        "machine": summary(("numpy", "openseespy")),
        "costs": plane_costs(motions),
        "suite": plane_suite_time(),
        "opensees": plane_against_opensees(motions),
    }
    data["opensees_machine"] = data["machine"]
    if general_opensees.ops is None:
        keep_opensees(data, kept)
    text = page(data, REPEATS)
    if given.write is None:
        print(text)
        return 0
    (given.write / "benchmarks" / "results" / "general_engine.json").write_text(json.dumps(data, indent=1) + "\n")
    (given.write / "docs" / "general_engine.md").write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
