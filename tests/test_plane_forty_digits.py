"""The kernel beside plane scenes solved with forty digits by tools/plane_forty_digits.py, and that program itself."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm

sys.path.append(str(Path(__file__).parents[1] / "tools"))

from forty_digits.run import solve
from forty_digits.scenes import scene

KEPT: list[dict[str, Any]] = json.loads((Path(__file__).parent / "data" / "plane_forty_digits.json").read_text())
PEAK = 1e-13  # of the largest peak of a kind: some hundred roundings of doubles
EVENT_TIME = 1e-12  # s: time falls more slowly than what it is found from
ANGLE = 1e-11  # rad, of a start


def test_every_scene_has_what_is_hard() -> None:
    assert len(KEPT) == 20
    for kept in KEPT:
        result = kept["result"]
        kinds = [event[1] for event in result["events"]]
        assert "stick" in kinds
        assert result["near_misses"] > 0
        assert min(result["starts"].values()) > 0, "starts with mu_s > mu_k and with mu_s = mu_k"


@pytest.mark.parametrize("kept", KEPT, ids=[str(kept["seed"]) for kept in KEPT])
def test_the_kernel_agrees(kept: dict[str, Any], tmp_path: Path) -> None:
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(kept["scene"]))
    file = sm.read_scene(path)
    assert file.other_motion is not None
    response = sm.simulate(file.scene, (file.motion, file.other_motion), energy=True)
    expected = kept["result"]
    for key, found in (
        ("peak_drift", response.peak_drift),
        ("peak_acceleration", response.peak_floor_acceleration),
        ("peak_slip", response.peak_slip),
        ("path", response.slip_path),
        ("residual_drift", response.residual_drift),
        ("residual_slip", response.residual_slip),
    ):
        values = np.array(expected[key], dtype=float)
        scale = np.abs(np.array(expected[key.replace("residual", "peak")], dtype=float)).max()
        np.testing.assert_allclose(found, values, rtol=0.0, atol=PEAK * scale, err_msg=key)
    events = response.events.rows(named=True)
    assert [(e["kind"], e["number"]) for e in events] == [(kind, number) for _, kind, number, *_ in expected["events"]]
    for event, (time, kind, _, sign, element, axis, angle) in zip(events, expected["events"], strict=True):
        assert event["time"] == pytest.approx(float(time), abs=EVENT_TIME)
        if kind in ("yield", "unload"):
            assert (event["sign"], event["direction"]) == (sign, axis)
        if element:
            assert event["element"] == element
        if kind in ("slip", "reverse"):
            assert np.sin(0.5 * (event["angle"] - angle)) == pytest.approx(0.0, abs=0.5 * ANGLE)
    assert abs(response.energy["relative_residual"]) < 1e-12


def test_what_is_kept_is_what_the_program_finds() -> None:
    kept = min(KEPT, key=lambda one: one["result"]["steps"])
    made = scene(kept["seed"])
    assert made == kept["scene"]
    assert solve(made) == kept["result"]
