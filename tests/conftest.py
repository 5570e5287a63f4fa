"""Fixtures of all tests."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import settings

# A shared machine may be slow; a failure prints what reproduces it.
settings.register_profile("seismass", deadline=None, print_blob=True)
settings.load_profile("seismass")


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
