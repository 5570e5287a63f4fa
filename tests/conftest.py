"""Fixtures of all tests."""

import os
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
