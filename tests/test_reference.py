"""Every reference scene against its result, made by an independent solver in 80-bit arithmetic: those of the repository
always, the others of $SEISMASS_SHARED/reference where it is set.

Tolerances are relative to the larger of a history's peak and a thousandth of the scene's largest of its kind. A double
has 1e-16; the rest is what chaos in yielding and sliding amplifies: at worst 5.4e-14 of histories, 4.6e-14 of peaks and
5.3e-14 s of event times, whichever instructions the kernel uses.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm

HISTORY_TOLERANCE = 1e-13
PEAK_TOLERANCE = 1e-13
EVENT_TIME_TOLERANCE = 1e-13
"""Seconds."""
INSTANT = 1e-10
"""Seconds; events that are closer are in one instant, where their order means nothing."""

SHARED = os.environ.get("SEISMASS_SHARED")
FOLDERS = [Path(__file__).parents[1] / "crates/seismass/tests/data/reference"]
if SHARED:
    FOLDERS.insert(0, Path(SHARED) / "reference")
SCENES = sorted({path.name: path for folder in FOLDERS for path in folder.glob("*.json")}.values())
COLUMNS = ("drift", "slip", "peak drift", "peak slip", "event time s", "energy")


@pytest.fixture(scope="module")
def table(request: pytest.FixtureRequest) -> Iterator[list[tuple[str, list[float]]]]:
    """Errors of each scene, printed at the end whether output is captured or not."""
    rows: list[tuple[str, list[float]]] = []
    yield rows
    capture = request.config.pluginmanager.getplugin("capturemanager")
    with capture.global_and_fixture_disabled():
        width = max((len(name) for name, _ in rows), default=0)
        print("\n" + " " * width + "".join(f"{column:>14}" for column in COLUMNS))
        for name, errors in rows:
            print(name.ljust(width) + "".join(f"{error:14.1e}" for error in errors))


def relative(got: np.ndarray, expected: Any, peaks: Any) -> float:
    """Largest error over storeys or blocks (the last axis), each over its scale."""
    scale = np.asarray(peaks, dtype=float)
    if not scale.size:
        return 0.0
    scale = np.maximum(scale, 1e-3 * scale.max())
    error = np.abs(np.asarray(got) - np.asarray(expected, dtype=float).reshape(np.shape(got)))
    # Where nothing of the kind moves at all, nothing may move here.
    return float(np.max(np.where(error == 0.0, 0.0, error / np.where(scale > 0.0, scale, 1e-300))))


def instants(times: np.ndarray) -> list[slice]:
    """Runs of events that are one instant."""
    starts = np.flatnonzero(np.diff(times, prepend=-np.inf) > INSTANT)
    return [slice(a, b) for a, b in zip(starts, [*starts[1:], len(times)], strict=True)]


@pytest.mark.parametrize("path", SCENES, ids=lambda path: path.stem)
def test_reference_scene(path: Path, table: list[tuple[str, list[float]]]) -> None:
    expected = json.loads(path.read_text())["result"]
    file = sm.read_scene(path)
    response = sm.simulate(file.scene, file.motion, histories=expected["sample_every"], energy=True)

    drift = relative(response.drift, expected["drift"], expected["peak_drift"])
    slip = relative(response.slip, expected["slip"], expected["peak_slip"])
    peak_drift = relative(response.peak_drift, expected["peak_drift"], expected["peak_drift"])
    peak_slip = relative(response.peak_slip, expected["peak_slip"], expected["peak_slip"])
    residual_drift = relative(response.residual_drift, expected["residual_drift"], expected["peak_drift"])
    residual_slip = relative(response.residual_slip, expected["residual_slip"], expected["peak_slip"])

    log = response.events.rows(named=True)
    reference_log = expected["events"]
    times = np.array([event["time"] for event in reference_log])
    late = np.abs(response.events["time"].to_numpy() - times).max(initial=0.0) if len(log) == len(times) else np.inf
    table.append((path.stem, [drift, slip, peak_drift, peak_slip, late, abs(response.energy["relative_residual"])]))

    assert file.motion.dt == pytest.approx(expected["dt"], rel=1e-15)
    assert response.status == "completed"
    assert {kind: count for kind, count in response.counts.items() if count} == expected["counts"]
    for instant in instants(times):
        here, there = (
            sorted((e["kind"], e["number"], e["sign"], e.get("element") or 0) for e in events[instant])
            for events in (log, reference_log)
        )
        assert here == there, f"events at t = {times[instant.start]} s"
    assert late < EVENT_TIME_TOLERANCE
    assert max(drift, slip, residual_drift, residual_slip) < HISTORY_TOLERANCE
    assert max(peak_drift, peak_slip) < PEAK_TOLERANCE
    # The drift is flat at its peak, so that the time of the peak is known to the root of the precision only.
    assert response.peak_drift_time == pytest.approx(expected["peak_drift_time"], abs=1e-6)
    assert abs(response.energy["relative_residual"]) < 1e-11
    for name in ("input", "kinetic", "viscous", "elastic", "hysteretic", "friction"):
        largest = expected["energy"]["input"]
        assert response.energy[name] == pytest.approx(expected["energy"][name], abs=1e-11 * largest), name
    building = file.scene.building
    assert building is not None
    matrix = np.array(expected["damping_matrix"])
    assert building.damping_matrix == pytest.approx(matrix, abs=1e-12 * np.abs(matrix).max())
