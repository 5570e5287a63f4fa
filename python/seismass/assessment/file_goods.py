"""The goods of the floors of a building file, and what the code counts of them, floor by floor."""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.assessment.file_values import held, missing, positive
from seismass.base.errors import InvalidOption, SeismassError
from seismass.base.input_table import NOT_NEGATIVE, SHARE, Need, Table
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray
from seismass.model.codes import AS_STATED, CodeFraction, code_fraction
from seismass.model.friction import BOUND_FACTORS, bound_factors, friction_pair

DEFAULT_CODE: Final = "asce7-10"
"""Code whose fraction is taken where the file names none."""
LIVE_LOAD: Final = ("live_load_kpa", "live_load_kg")
"""Keys of the design live load of a floor."""
FRICTION: Final = ("friction", "mu", "mu_s")
"""Keys of its friction."""


def live_load_of(storey: Table, goods: Table, building: Table) -> float:
    """Design live load of a floor as a mass (kg)."""
    place = held(storey, goods, LIVE_LOAD)
    if place is None:
        return 0.0
    table, key = place
    value = table.number(key, need=NOT_NEGATIVE)
    if key == "live_load_kg" or value == 0.0:
        return value
    return 1e3 * value * positive(storey, building, "area_m2") / STANDARD_GRAVITY


def friction_of(storey: Table, goods: Table) -> tuple[str, float, float]:
    """Contact (empty: stated as numbers), static and kinetic coefficient of the goods of a floor."""
    place = held(storey, goods, FRICTION)
    if place is None:
        missing(storey, goods, FRICTION)
    table, key = place
    if key == "friction":
        try:
            pair = friction_pair(table.text(key))
        except SeismassError as error:
            table.refuse_as(key, error)
        return pair.pair_id, pair.mu_s, pair.mu_k
    static = table.number(key, need=NOT_NEGATIVE)
    if key == "mu" or "mu_k" not in table.values:
        return "", static, static
    requirement = f"from 0 to {table.key('mu_s')} = {static:g}"
    return "", static, table.number("mu_k", need=Need(requirement, lambda number: 0.0 <= number <= static))


def mu_factors_of(goods: Table) -> tuple[float, float]:
    """Return the factors of friction for its bounds."""
    given = goods.values.get("mu_factors", BOUND_FACTORS)
    try:
        return bound_factors(given, "goods")
    except InvalidOption as error:
        goods.refuse_as("mu_factors", error)


def code_of(table: Table) -> CodeFraction:
    """Return the code of the file, or a fraction of one's own."""
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


def floor_codes(storeys: list[Table], code: CodeFraction) -> tuple[FloatArray, tuple[str, ...]]:
    """Return the fraction that each floor states (NaN: none; 0: exempt), and its use (empty: that of the file).

    Parameters
    ----------
    storeys : list of Table
        Tables of the storeys, which may have `use`, or `fraction`, or `exempt`.
    code : CodeFraction
        Code of the file.
    """
    fractions, uses = [], []
    for storey in storeys:
        storey.one_of("use", "fraction", "exempt")
        stated = storey.number("fraction", need=SHARE) if "fraction" in storey.values else np.nan
        fractions.append(0.0 if storey.flag("exempt", False) else stated)
        use = storey.text("use")
        if use and code.status == AS_STATED:
            storey.refuse("use", "left out where code.fraction is given", "both")
        if use:
            try:
                code_fraction(code.code_id, use)  # type: ignore[arg-type]
            except InvalidOption as error:
                storey.refuse_as("use", error)
        uses.append(use)
    return np.array(fractions), tuple(uses)
