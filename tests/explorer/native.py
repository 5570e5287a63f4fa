"""Solves the runs of solve.js with the kernel of this installation: python native.py < asked.json."""

from __future__ import annotations

import hashlib
import json
import sys
from typing import Any

import numpy as np

import seismass as sm
from seismass.effective_mass.models import attached_scene
from seismass.runs.response import EVENT_KINDS


def scene_of(case: dict[str, Any]) -> sm.Scene:
    """The scene that a case of the page means."""
    building = sm.Building.uniform(
        case["storeys"],
        case["period"],
        yield_shear_over_weight=[float(value) for value in case["strength"]],
        damping=case["damping"],
        overstrength=case["overstrength"],
        second_slope=case["secondSlope"],
        third_slope=case["thirdSlope"],
    )
    return sm.Scene(building, sm.blocks_on_floors(case["massRatio"], case["muS"], mu_k=case["muK"]))


def numbers(response: sm.Response) -> list[Any]:
    """All that a run of the page gives, in its order."""
    log = response.event_log
    kinds = np.array([EVENT_KINDS.index(kind) for kind in log["kind"]], dtype=np.float64)
    peaks = [
        getattr(response, name + end)
        for name in ("peak_drift", "peak_slip", "peak_floor_acceleration", "peak_storey_shear")
        for end in ("", "_time")
    ]
    return [
        [response.end_time, 0.0],
        *peaks,
        response.residual_drift,
        response.residual_slip,
        response.slip_path,
        list(response.counts.values()),
        np.stack([log["time"], kinds, log["number"], log["sign"]], axis=1),
        response.drift,
        response.slip,
        response.storey_shear,
    ]


def solved(run: dict[str, Any], motions: list[sm.Motion]) -> dict[str, Any]:
    """Hash of a run, and how many events it had."""
    scene = scene_of(run["scene"])
    if run["share"] is not None:
        scene = attached_scene(scene, run["share"])
    response = sm.simulate(scene, motions[run["motion"]], histories=run["every"])
    digest = hashlib.sha256()
    for values in numbers(response):
        digest.update(np.ascontiguousarray(values, dtype="<f8").tobytes())
    return {"hash": digest.hexdigest(), "events": len(response.event_log)}


def main() -> None:
    """Answer what standard input asks for."""
    asked = json.load(sys.stdin)
    motions = [sm.Motion(motion["samples"], motion["dt"]) for motion in asked["motions"]]
    print(json.dumps([solved(run, motions) for run in asked["runs"]]))


if __name__ == "__main__":
    main()
