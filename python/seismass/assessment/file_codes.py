"""The code of a building file, and what the file says of each floor for it."""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.assessment.floors import FloorCode
from seismass.base.errors import InvalidOption
from seismass.base.input_table import SHARE, Table
from seismass.model.codes import AS_STATED, CodeFraction, code_fraction

DEFAULT_CODE: Final = "asce7-10"
"""Code whose fraction is taken where the file names none."""


def code_of(table: Table) -> CodeFraction:
    """Return the code of the file, or a fraction of your own."""
    if "fraction" in table.values:
        table.excluded("id", "fraction")
        table.excluded("use", "fraction")
        value = table.number("fraction", need=SHARE)
        return CodeFraction("own", "a fraction of one's own", "storage", value, value, value, "", "", AS_STATED)
    names = {key: table.text(key) for key in ("id", "use")}
    try:
        found = code_fraction(names["id"] or DEFAULT_CODE)
        return code_fraction(found.code_id, names["use"] or "storage")  # type: ignore[arg-type]
    except InvalidOption as error:
        key = "use" if str(error).startswith("use") else "id"
        table.refuse_as(key, error)


def floor_codes(storeys: list[Table], code: CodeFraction) -> tuple[FloorCode, ...]:
    """Return what the tables of the storeys say for the code: `use`, or `fraction`, and `exempt`."""
    found = []
    for storey in storeys:
        storey.one_of("use", "fraction")
        exempt = storey.flag("exempt", False) if "exempt" in storey.values else None
        if exempt:
            storey.one_of("use", "fraction", "exempt")
        fraction = storey.number("fraction", need=SHARE) if "fraction" in storey.values else np.nan
        use = storey.text("use")
        if use and code.status == AS_STATED:
            storey.refuse("use", "left out where code.fraction is given", "both")
        if use:
            try:
                code_fraction(code.code_id, use)  # type: ignore[arg-type]
            except InvalidOption as error:
                storey.refuse_as("use", error)
        found.append(FloorCode(fraction, use, exempt))
    return tuple(found)
