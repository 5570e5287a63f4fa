"""Fixtures of all tests."""

import os
from pathlib import Path

import pytest
from hypothesis import settings

SLOW = Path(__file__).with_name("slow.txt")
"""Files and tests that `make test` leaves to `make test-all`, one a line: what the id of a test begins with."""

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


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark the tests that take seconds. A line that no test of a collected file begins with is an error."""
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
    if whole and unused:
        raise pytest.UsageError(f"tests/slow.txt names no test by: {', '.join(unused)}")
