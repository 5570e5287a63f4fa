"""The built-in suite: seven synthetic motions stored with the package, so that a study runs without any recording."""

from __future__ import annotations

from pathlib import Path

from seismass.errors import RecordFormatError
from seismass.records.suite import Suite, read_suite


def data_directory() -> Path:
    """Return the folder of the stored data: inside an installed package, or at the top of a source tree."""
    package = Path(__file__).parents[1]
    places = (package / "data", package.parents[1] / "data")
    for place in places:
        if (place / "synthetic" / "suite.csv").is_file():
            return place
    raise RecordFormatError(f"built-in suite must be in {places[0]} or {places[1]}; got neither")


def builtin_suite() -> Suite:
    """Return the seven synthetic motions that `seismass.records.synthetic` made; none is a recording."""
    return read_suite(data_directory() / "synthetic" / "suite.csv")
