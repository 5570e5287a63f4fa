"""The built-in suite: seven synthetic motions stored with the package, so that a study runs without any recording."""

from __future__ import annotations

from pathlib import Path

from seismass.errors import RecordFormatError
from seismass.records.suite import Suite, read_suite


def data_directory() -> Path:
    """Return the folder of the stored data: inside an installed package, or at the top of the source tree."""
    package = Path(__file__).parents[1]
    tree = package.parents[1]
    # In the source tree a development build leaves a copy in the package, which the files themselves outdate. The
    # folder above an installed package may be a project too, and not this one.
    place = (tree if (tree / "crates" / "seismass").is_dir() else package) / "data"
    if not (place / "synthetic" / "suite.csv").is_file():
        raise RecordFormatError(f"built-in suite must be in {place}, as it was installed; got no suite.csv there")
    return place


def builtin_suite() -> Suite:
    """Return the seven synthetic motions that `seismass.records.synthetic` made; none is a recording."""
    return Suite("built-in suite", read_suite(data_directory() / "synthetic" / "suite.csv").records)
