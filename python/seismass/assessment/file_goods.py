"""The goods of the floors of a building file: how much, how much of it is there, and at what friction."""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.assessment.file_racks import SUPPORT, rack_of, stops_of
from seismass.assessment.file_values import held, missing, number_of, positive
from seismass.assessment.floors import NOTHING_STATED, FloorGoods
from seismass.base.errors import InvalidOption, SeismassError
from seismass.base.input_table import NOT_NEGATIVE, SHARE, Need, Table
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import printable
from seismass.model.friction import BOUND_FACTORS, bound_factors, friction_pair
from seismass.model.occupancy import SURVEYED, surveyed_load

LIVE_LOAD: Final = ("live_load_kpa", "live_load_kg")
"""Keys of the design live load of a floor."""
FRICTION: Final = ("friction", "mu", "mu_s")
"""Keys of its friction."""
PRESENT: Final = ("occupied", "occupancy")
"""Keys of how much of it is present: a share, or what surveys say."""
SUM_ERROR: Final = 1e-6
"""By how much the shares of the kinds of goods on a floor may miss one."""


def live_load_of(storey: Table, goods: Table, building: Table) -> float:
    """Design live load of a floor as a mass (kg)."""
    place = held((storey, goods), LIVE_LOAD)
    if place is None:
        return 0.0
    table, key = place
    value = table.number(key, need=NOT_NEGATIVE)
    if key == "live_load_kg" or value == 0.0:
        return value
    return 1e3 * value * positive(storey, building, "area_m2") / STANDARD_GRAVITY


def kinds_of(
    floor: int, storey: Table, goods: Table, live_load: float, area: float, use: str
) -> tuple[FloorGoods, ...]:
    """Return the goods of a floor, kind by kind. Floors count from 1; `live_load` is the design live load as a mass
    (kg), `area` in m2, NaN where it is not known.
    """
    tables = storey.tables("goods")
    if not tables:
        given = (storey, goods)
        share, how, of = _present(given, live_load, area, use)
        contact = _friction(given) if live_load * share > 0.0 else ("", 0.0, 0.0)
        return (FloorGoods(floor, "", live_load, share, how, False, *contact, rack_of(given), stops_of(given), of),)
    shares = [table.number("share", need=SHARE) if "share" in table.values else np.nan for table in tables]
    total = sum(shares)
    if not abs(total - 1.0) <= SUM_ERROR:
        got = "a kind without one" if np.isnan(total) else f"a sum of {total:g}"
        storey.refuse("goods", "kinds with a share of the design live load each, one in sum", got)
    found = []
    for table, part in zip(tables, shares, strict=True):
        attached = table.flag("attached", False)
        name = printable(table.text("name"))
        load = part * live_load
        if attached:
            table.left_out((*FRICTION, "mu_k", *SUPPORT), f"{table.key('attached')} is true", "both")
            share, how, _ = _present((table,), live_load, area, "")
            found.append(FloorGoods(floor, name, load, share, how, True, "", 0.0, 0.0))
            continue
        places = (table, storey, goods)
        share, how, of = _present(places, live_load, area, use)
        contact = _friction(places) if load * share > 0.0 else ("", 0.0, 0.0)
        found.append(FloorGoods(floor, name, load, share, how, False, *contact, rack_of(places), stops_of(places), of))
    return tuple(found)


def _present(tables: tuple[Table, ...], live_load: float, area: float, use: str) -> tuple[float, str, str]:
    """Share of the design live load that is present, how that is known, and the occupancy that is stated."""
    place = held(tables, PRESENT)
    if place is None:
        if use not in ("ordinary", "shop"):
            return 1.0, f"of the design live load, {NOTHING_STATED}", ""
        usual = surveyed_load(SURVEYED[use])
        how = f"of the design live load, as {usual.occupancy_id}, since the use is {use} and nothing is stated"
        return usual.share, how, ""
    table, key = place
    if key == "occupied":
        return number_of(place, SHARE), "of the design live load, as stated", ""
    try:
        found = surveyed_load(table.text(key))
    except SeismassError as error:
        table.refuse_as(key, error)
    design = 1e-3 * STANDARD_GRAVITY * live_load / area
    if not design > 0.0:
        return (
            found.share,
            f"of the design live load, by {found.occupancy_id}, the area not being known",
            found.occupancy_id,
        )
    share, spread = found.mean / design, found.deviation(area) / design
    scatter = f"+/- {spread:.2f} of the design live load, by {found.occupancy_id} ({found.mean:g} kPa)"
    return min(1.0, share), scatter + (", which is more than all of it" if share > 1.0 else ""), found.occupancy_id


def _friction(tables: tuple[Table, ...]) -> tuple[str, float, float]:
    """Contact (empty: stated as numbers), static and kinetic coefficient of goods."""
    place = held(tables, FRICTION)
    if place is None:
        missing(tables[-2], tables[-1], FRICTION)
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
