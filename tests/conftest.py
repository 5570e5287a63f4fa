"""Fixtures of all tests."""

from __future__ import annotations

import copy
import os
import signal
from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import settings

import seismass as sm

SLOW = Path(__file__).with_name("slow.txt")
"""Files and tests that `make test` leaves to `make test-all`, one a line: what the id of a test begins with."""
UNUSED = pytest.StashKey[list[str]]()


@pytest.fixture
def unused_lines(request: pytest.FixtureRequest) -> list[str]:
    """Lines of tests/slow.txt that name no test."""
    return request.config.stash[UNUSED]


# The processes of pytest-xdist have a width, and a user's shell may: what is printed into a pipe would be folded to it.
os.environ.pop("COLUMNS", None)

# nohup and shells that put tests into the background have these signals ignored, and so would the commands under test.
for _number, _default in ((signal.SIGINT, signal.default_int_handler), (signal.SIGHUP, signal.SIG_DFL)):
    if signal.getsignal(_number) is signal.SIG_IGN:
        signal.signal(_number, _default)

# A shared machine may be slow; a failure prints what reproduces it.
settings.register_profile("seismass", deadline=None, print_blob=True)
settings.load_profile("seismass")

# A building file in which no two numbers of a kind are equal or in the ratio of small whole numbers, so that a test of
# it sees one taken in place of another: tests/test_unequal.py.
_FILE: dict[str, Any] = {
    "name": "three unequal storeys",
    "site": {"sds_g": 1.13, "sd1_g": 0.71, "tl_s": 6.7},
    "building": {"damping": 0.037, "drift_limit": 0.017, "theta_limit": 0.23},
    "goods": {"mu_factors": [0.71, 1.37]},
    "storeys": [
        {
            "name": "hall",
            "height_m": 4.3,
            "area_m2": 530.0,
            "dead_load_kpa": 5.3,
            "gravity_load_kn": 3070.0,
            "stiffness_kn_per_m": 1.93e5,
            "yield_shear_kn": 1870.0,
            "overstrength": 1.87,
            "second_slope": 0.067,
            "third_slope": 0.013,
            "live_load_kpa": 6.1,
            "goods": [
                {"name": "pallets", "share": 0.59, "occupied": 0.88, "mu_s": 0.298, "mu_k": 0.214},
                {"name": "drums", "share": 0.41, "occupied": 0.55, "mu_s": 0.253, "mu_k": 0.154},
            ],
        },
        {
            "name": "loft",
            "height_m": 3.7,
            "area_m2": 470.0,
            "dead_load_kpa": 4.7,
            "gravity_load_kn": 2390.0,
            "stiffness_kn_per_m": 1.57e5,
            "yield_shear_kn": 1510.0,
            "overstrength": 2.11,
            "second_slope": 0.053,
            "third_slope": 0.0103,
            "live_load_kpa": 4.3,
            "occupied": 0.71,
            "mu_s": 0.349,
            "mu_k": 0.184,
        },
        {
            "name": "roof",
            "height_m": 3.1,
            "area_m2": 410.0,
            "dead_load_kpa": 3.7,
            "gravity_load_kn": 1640.0,
            "stiffness_kn_per_m": 1.13e5,
            "yield_shear_kn": 830.0,
            "overstrength": 1.61,
            "second_slope": 0.043,
            "third_slope": 0.0083,
            "live_load_kpa": 1.9,
            "occupied": 0.43,
            "mu_s": 0.291,
            "mu_k": 0.24,
        },
    ],
}


@pytest.fixture
def unequal_file() -> dict[str, Any]:
    """Tables of a building file of three storeys and four kinds of goods, two of them on floor 1; a copy per test."""
    return copy.deepcopy(_FILE)


@pytest.fixture(scope="session")
def unequal_building() -> sm.assessment.OwnBuilding:
    """The building of that file."""
    return sm.read_building(_FILE)


@pytest.fixture(scope="session")
def unequal_scene() -> sm.Scene:
    """Three storeys and four blocks, two of them on floor 1, with P-Delta; no two quantities of a kind alike."""
    building = sm.Building(
        [44.1e3, 35.7e3, 22.4e3],
        [29.3e6, 23.1e6, 16.1e6],
        yield_shear=[283e3, 227e3, 139e3],
        overstrength=[1.87, 2.11, 1.61],
        second_slope=[0.067, 0.053, 0.043],
        third_slope=[0.013, 0.0103, 0.0083],
        damping=0.037,
        heights=[4.3, 3.7, 3.1],
        gravity_load=[461e3, 367e3, 251e3],
    )
    blocks = [
        sm.Block(1, mass=18.9e3, mu_s=0.298, mu_k=0.214),
        sm.Block(1, mass=11.5e3, mu_s=0.253, mu_k=0.154),
        sm.Block(2, mass=13.7e3, mu_s=0.349, mu_k=0.184),
        sm.Block(3, mass=7.8e3, mu_s=0.291, mu_k=0.24),
    ]
    return sm.Scene(building, blocks, name="three unequal storeys")


@pytest.fixture(scope="session")
def unequal_motions() -> tuple[sm.Record, ...]:
    """Three bursts of waves with time steps, lengths, periods and peaks of their own; the goods slide under each."""
    bursts = []
    for number, (dt, seconds, period, peak) in enumerate(
        [(0.005, 5.3, 0.53, 5.9), (0.007, 6.3, 1.13, 4.7), (0.011, 8.3, 0.67, 7.3)], start=1
    ):
        time = dt * np.arange(round(seconds / dt))
        wave = peak * np.sin(2.0 * np.pi * time / period) * np.sin(np.pi * time / seconds) ** 2
        bursts.append(sm.Record(wave, dt, name=f"burst {number}"))
    return tuple(bursts)


@pytest.fixture(scope="session")
def take_few() -> Callable[[pytest.MonkeyPatch], None]:
    """What makes three of the built-in forty, for whole commands of which no number is tested."""
    from seismass.motions.records import builtin

    stored = builtin._stored
    return lambda patch: patch.setattr(builtin, "_stored", lambda *of: stored(*of)[:3])


@pytest.fixture
def few_motions(take_few: Callable[[pytest.MonkeyPatch], None], monkeypatch: pytest.MonkeyPatch) -> None:
    """The built-in forty are three in this test."""
    take_few(monkeypatch)


@pytest.fixture
def small_map(monkeypatch: pytest.MonkeyPatch) -> None:
    """The command of the map has two buildings, and models of eleven shares."""
    package = import_module("seismass.effective_mass")  # as an attribute of seismass it is the function
    buildings = ((1, 0.4, "loaded"), (2, 0.38, "bare"))
    small = partial(package.EffectiveMassParameters, buildings=buildings, shares=11)
    monkeypatch.setattr(package, "EffectiveMassParameters", small)


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of reference results and recordings that are not part of the project."""
    folder = os.environ.get("SEISMASS_SHARED")
    if not folder:
        pytest.skip("SEISMASS_SHARED is not set: no reference results, no recordings")
    path = Path(folder)
    if not path.is_dir():
        pytest.fail(f"SEISMASS_SHARED must be a directory; got {folder}")
    return path


@pytest.fixture
def reference(request: pytest.FixtureRequest) -> Callable[[str], Path]:
    """Finds a file of the reference scenes: in the repository, else in the folder that is not part of the project."""

    def find(name: str) -> Path:
        path = Path(__file__).parents[1] / "crates/seismass/tests/data/reference" / name
        return path if path.exists() else request.getfixturevalue("shared") / "reference" / name

    return find


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark the tests that take seconds, and note the lines that no test begins with where all are collected."""
    lines = [line.partition("  #")[0].rstrip() for line in SLOW.read_text(encoding="utf-8").splitlines()]
    slow = [line for line in lines if line and not line.startswith("#")]
    used, whole = set(), not config.args or config.args == ["tests"]
    for item in items:
        own = item.nodeid.removeprefix("tests/")
        found = [line for line in slow if own.startswith(line)]
        used.update(found)
        if found:
            item.add_marker(pytest.mark.slow)
    unused = [line for line in slow if line not in used]
    config.stash[UNUSED] = unused if whole else []
