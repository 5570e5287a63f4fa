"""The Rust program of the documentation prints what Python finds for the same scene."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import seismass as sm

ROOT = Path(__file__).parents[1]


def program() -> str:
    """The program, built with the kernel that the extension and the integration tests share."""
    if shutil.which("cargo") is None:
        pytest.skip("no cargo on the path: the example is not built")
    shared = ["--locked", "--release", "--workspace", "--exclude", "seismass-bench"]
    command = ["cargo", "build", *shared, "--message-format=json", "--example", "warehouse"]
    text = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True, timeout=1200).stdout
    built = [message.get("executable") for message in map(json.loads, text.splitlines())]
    return next(executable for executable in built if executable)


def test_the_rust_program_prints_the_numbers_of_python() -> None:
    text = subprocess.run([program()], cwd=ROOT, capture_output=True, text=True, check=True, timeout=600).stdout
    building = sm.Building.uniform(3, 0.6, mass=1e5, yield_shear_over_weight=[0.24, 0.20, 0.12])
    goods = [sm.Block(floor, mass=1e5, mu=0.3) for floor in (1, 2)]
    samples = 5.0 * np.sin(0.1 * np.arange(1000)) * np.exp(-0.002 * np.arange(1000))
    response = sm.simulate(sm.Scene(building, goods), sm.Motion(samples, 0.01))
    drift = [float(number) for number in re.findall(r"drift ([\d.]+) mm", text)]
    slip = [float(number) for number in re.findall(r"slip ([\d.]+) mm", text)]
    # Six decimals are printed; sines of two libraries differ by rounding.
    np.testing.assert_allclose(drift, 1e3 * response.peak_drift, atol=6e-7)
    np.testing.assert_allclose(slip, 1e3 * response.peak_slip, atol=6e-7)
    assert min(slip) > 0.0
