"""Fixtures of all tests."""

import os
from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path

import pytest
from hypothesis import settings

# A shared machine may be slow; a failure prints what reproduces it.
settings.register_profile("seismass", deadline=None, print_blob=True)
settings.load_profile("seismass")


@pytest.fixture(scope="session")
def take_few() -> Callable[[pytest.MonkeyPatch], None]:
    """What makes three of the built-in forty, for whole commands of which no number is tested."""
    from seismass.records import builtin

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
