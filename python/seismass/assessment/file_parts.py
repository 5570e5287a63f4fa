"""Parts of a building file: goods, racks, walls, the second direction, the base."""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping
from typing import Any, Final, NamedTuple, NoReturn, get_args

import numpy as np

from seismass.assessment.file_site import PERIOD
from seismass.assessment.floors import DEFAULT_FRAME, DEFAULT_LEVELS, NOTHING_STATED, FloorGoods, GoodsRack, GoodsStops
from seismass.base.errors import InvalidBuildingFile, InvalidOption, SeismassError
from seismass.base.input_table import NOT_NEGATIVE, POSITIVE, SHARE, Need, Table
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_array, printable
from seismass.design import Wall, vibration_modes
from seismass.model.block import SlidingBase
from seismass.model.building import Building
from seismass.model.friction import BOUND_FACTORS, bound_factors, friction_pair
from seismass.model.occupancy import SURVEYED, surveyed_load
from seismass.model.rack import DEFAULT_RACK_DAMPING, rack_direction
from seismass.model.tipping import BlockSize, Tipping

STRONG: Final = Need("positive (inf: the storey stays elastic)", lambda number: number > 0.0)
"""What a strength must be."""
REDUCTION: Final = Need("finite and at least 1", lambda number: 1.0 <= number < math.inf)
"""What R must be."""


def held(tables: tuple[Table, ...], group: tuple[str, ...]) -> tuple[Table, str] | None:
    """Return where a value stands: in the first of the tables that has it, a storey's own before the defaults."""
    for table in tables:
        for key in group:
            if key in table.values:
                return table, key
    return None


def key_of(storey: Table, default: Table, group: tuple[str, ...]) -> str:
    """Return the key that states a value of a storey; empty where none does."""
    place = held((storey, default), group)
    return "" if place is None else place[1]


def number_of(place: tuple[Table, str], need: Need) -> float:
    """Return the number that stands at a place."""
    table, key = place
    return table.number(key, need=need)


def stated(storey: Table, default: Table, key: str, need: Need, value: float) -> float:
    """Return a number of a storey or of the defaults, or the value that stands for a missing one."""
    place = held((storey, default), (key,))
    return value if place is None else number_of(place, need)


def positive(storey: Table, default: Table, key: str, value: float | None = None) -> float:
    """Return a positive number of a storey or of the defaults; a missing one is refused where there is no value."""
    if value is not None:
        return stated(storey, default, key, POSITIVE, value)
    place = held((storey, default), (key,))
    if place is None:
        storey.refuse(key, f"given, or {default.key(key)} for all storeys", "nothing")
    return number_of(place, POSITIVE)


def missing(storey: Table, default: Table, group: tuple[str, ...]) -> NoReturn:
    """Refuse a quantity that is stated nowhere."""
    others = "".join(f", or {key}" for key in group[1:])
    storey.refuse(group[0], f"given{others}, here or in {default.place}", "nothing")


SUPPORT: Final = ("on_racks", "stops")
"""Keys of how goods stand: tables, or false where a default does not hold."""
RACK_KEYS: Final = ("direction", "period_s", "levels", "frame", "damping", "yield_shear_over_weight")
STOP_KEYS: Final = ("clearance_m", "stiffness_kn_per_m")


def rack_of(tables: tuple[Table, ...]) -> GoodsRack | None:
    """Return the racks under goods, by the first of `tables` that has racks; None where goods stand on the floor."""
    table = _stated(tables, "on_racks", RACK_KEYS)
    if table is None:
        return None
    table.needed("direction", "period_s")
    table.one_of("direction", "period_s")
    if "period_s" in table.values:
        period, how = table.number("period_s", need=POSITIVE), "as stated"
    else:
        try:
            row = rack_direction(table.text("direction"))
        except SeismassError as error:
            table.refuse_as("direction", error)
        period = row.period
        how = f"{row.name}, usually {row.low:g} to {row.high:g} s; {row.source}, {row.status}"
    strength = "yield_shear_over_weight" in table.values
    return GoodsRack(
        period,
        how,
        table.count("levels", least=1) if "levels" in table.values else DEFAULT_LEVELS,
        table.number("frame", DEFAULT_FRAME, POSITIVE),
        table.number("damping", DEFAULT_RACK_DAMPING, SHARE),
        table.number("yield_shear_over_weight", need=POSITIVE) if strength else None,
    )


def stops_of(tables: tuple[Table, ...]) -> GoodsStops | None:
    """Return the stops beside goods; None where there are none. The first of `tables` that describes stops counts."""
    table = _stated(tables, "stops", STOP_KEYS)
    if table is None:
        return None
    table.needed("clearance_m")
    stated = "stiffness_kn_per_m" in table.values
    stiffness = 1e3 * table.number("stiffness_kn_per_m", need=POSITIVE) if stated else None
    return GoodsStops(table.number("clearance_m", np.nan, NOT_NEGATIVE), stiffness)


def _stated(tables: tuple[Table, ...], key: str, known: tuple[str, ...]) -> Table | None:
    place = held(tables, (key,))
    if place is None:
        return None
    table, _ = place
    if table.values[key] is False:
        return None
    if not isinstance(table.values[key], dict):
        table.refuse(key, f"a table with {' or '.join(known[:2])}, or false", str(table.values[key]))
    inner = table.table(key)
    inner.known(known)
    return inner


LIVE_LOAD: Final = ("live_load_kpa", "live_load_kg")
"""Keys of the design live load of a floor."""
FRICTION: Final = ("friction", "mu", "mu_s")
"""Keys of its friction."""
PRESENT: Final = ("occupied", "occupancy")
"""Keys of how much of it is present: a share, or what surveys say."""
SIZE: Final = ("width_m", "height_m", "tipping")
"""Keys of the size of the goods, and of what stands for those that tip."""
SUM_ERROR: Final = 1e-6
"""By how much the shares of the kinds of goods on a floor may miss one."""


def live_load_of(storey: Table, goods_table: Table, building: Table) -> float:
    """Design live load of a floor as a mass (kg)."""
    place = held((storey, goods_table), LIVE_LOAD)
    if place is None:
        return 0.0
    table, key = place
    value = table.number(key, need=NOT_NEGATIVE)
    if key == "live_load_kg" or value == 0.0:
        return value
    return 1e3 * value * positive(storey, building, "area_m2") / STANDARD_GRAVITY


def kinds_of(
    floor: int, storey: Table, goods_table: Table, live_load: float, area: float, uses: tuple[str, str]
) -> tuple[FloorGoods, ...]:
    """Return the goods of a floor, kind by kind. Floors count from 1; `live_load` is the design live load as a mass
    (kg), `area` in m2, NaN where it is not known, `uses` that of the floor (empty: none is stated) and of the file.
    """
    tables = storey.tables("goods")
    if not tables:
        levels = (storey, goods_table)
        share, how, source = _present(levels, live_load, area, uses[0] or uses[1])
        contact = _friction(levels) if live_load * share > 0.0 else ("", 0.0, 0.0)
        neighbours, size = (rack_of(levels), stops_of(levels)), size_of((goods_table,))
        return (FloorGoods(floor, "", live_load, share, how, False, *contact, *neighbours, source, uses[0], *size),)
    shares = [table.number("share", need=SHARE) if "share" in table.values else np.nan for table in tables]
    total = sum(shares)
    if not abs(total - 1.0) <= SUM_ERROR:
        got = "a kind without one" if np.isnan(total) else f"a sum of {total:g}"
        storey.refuse("goods", "kinds with a share of the design live load each, one in sum", got)
    kinds = []
    for table, part in zip(tables, shares, strict=True):
        attached = table.flag("attached", False)
        name = printable(table.text("name"))
        load = part * live_load
        if attached:
            table.left_out((*FRICTION, "mu_k", *SUPPORT, *SIZE), f"{table.key('attached')} is true", "both")
            share, how, _ = _present((table,), live_load, area, "")
            kinds.append(FloorGoods(floor, name, load, share, how, True, "", 0.0, 0.0))
            continue
        places, uses_of_kind = (table, storey, goods_table), table.text("use") or uses[0]
        share, how, source = _present(places, live_load, area, uses_of_kind or uses[1])
        contact = _friction(places) if load * share > 0.0 else ("", 0.0, 0.0)
        neighbours, size = (rack_of(places), stops_of(places)), size_of((table, goods_table))
        kinds.append(
            FloorGoods(floor, name, load, share, how, False, *contact, *neighbours, source, uses_of_kind, *size)
        )
    return tuple(kinds)


def size_of(tables: tuple[Table, ...]) -> tuple[BlockSize | None, str]:
    """Return the size of goods, as the first of `tables` that has one states it, and what stands for goods that tip."""
    place, model = held(tables, SIZE[:2]), held(tables, SIZE[2:])
    stated_model = "" if model is None else model[0].choice(SIZE[2], get_args(Tipping))
    if place is None:
        if model is not None:
            model[0].refuse(SIZE[2], f"left out where {SIZE[0]} and {SIZE[1]} of the goods are not given", stated_model)
        return None, ""
    for key in SIZE[:2]:
        if key not in place[0].values:
            both = (
                f"given: {SIZE[0]} and {SIZE[1]} are the size of one of the goods (heights of storeys stand elsewhere)"
            )
            place[0].refuse(key, both, "nothing")
    return BlockSize(*(place[0].number(key, need=POSITIVE) for key in SIZE[:2])), stated_model


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
        survey = surveyed_load(table.text(key))
    except SeismassError as error:
        table.refuse_as(key, error)
    design = 1e-3 * STANDARD_GRAVITY * live_load / area
    if not design > 0.0:
        return (
            survey.share,
            f"of the design live load, by {survey.occupancy_id}, the area not being known",
            survey.occupancy_id,
        )
    share, mean = (
        survey.mean / design,
        f"of the design live load, the mean of {survey.occupancy_id} ({survey.mean:g} kPa)",
    )
    return min(1.0, share), mean + (", which is more than all of it" if share > 1.0 else ""), survey.occupancy_id


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


def mu_factors_of(goods_table: Table) -> tuple[float, float]:
    """Return the factors of friction for its bounds."""
    factors = goods_table.values.get("mu_factors", BOUND_FACTORS)
    try:
        return bound_factors(factors, "goods")
    except InvalidOption as error:
        goods_table.refuse_as("mu_factors", error)


WALL_KEYS: Final = (
    "flexural_rigidity_kn_m2",
    "period_s",
    "alpha_h",
    "base_shear_share",
    "stiffness_matrix_kn_per_m",
)
"""Keys of the table; one of them is given."""
_BY_THEMSELVES: Final = ("flexural_rigidity_kn_m2", "period_s", "stiffness_matrix_kn_per_m")
"""Those that do not follow the stiffness of the storeys."""


class Walls(NamedTuple):
    """Walls beside the storeys: storey stiffnesses (N/m, scaled where the period stated is that of both together),
    stiffness matrix of the walls over the floors (N/m), and `how` they are stated.
    """

    stiffness: FloatArray
    matrix: FloatArray
    how: str


def walls_of(
    walls: Table, building: Table, mass: FloatArray, stiffness: FloatArray, heights: Any, period: float | None
) -> Walls | None:
    """Return the walls of a file; None where it has none. `mass` is that of the floors without goods (kg); where
    `period` (s) is stated for the building, `stiffness` (N/m) gives it without walls.
    """
    if not walls.values:
        return None
    walls.known(WALL_KEYS)
    walls.needed(*WALL_KEYS)
    walls.one_of(*WALL_KEYS)
    (key,) = walls.values
    by_period = period is not None
    if by_period and key in _BY_THEMSELVES:
        requirement = f"left out where {building.key('period_s')}, that of storeys and walls together, is known"
        walls.refuse(key, requirement, "both")
    if key != "stiffness_matrix_kn_per_m" and heights is None:
        building.refuse("height_m", f"given where {walls.key(key)} is", "nothing")
    try:
        matrix, how = _matrix(key, walls, mass, stiffness, heights)
        if not by_period:
            return Walls(stiffness, matrix, how)
        alone, both = (vibration_modes(mass, stiffness, stiffness_matrix=each).periods[0] for each in (None, matrix))
    except SeismassError as error:
        walls.refuse_as(key, error)
    scale = float(both / alone) ** 2  # changes neither alpha H nor the share
    return Walls(scale * stiffness, scale * matrix, how)


def _matrix(key: str, walls: Table, mass: FloatArray, stiffness: FloatArray, heights: Any) -> tuple[FloatArray, str]:
    if key == "stiffness_matrix_kn_per_m":
        stated: FloatArray = as_array(walls.values[key], key, "walls", InvalidBuildingFile, dimensions=2)
        return 1e3 * stated, "an elastic matrix over the floors, as stated"
    frame = Building(mass, stiffness, yield_shear=np.inf, heights=heights)
    if key == "flexural_rigidity_kn_m2":
        rows = walls.per_storey(key)
        rigidity = np.full(len(mass), np.nan) if rows is None else 1e3 * rows * np.ones(len(mass))
        return Wall(heights, rigidity).stiffness_matrix, "flexural cantilever of the stated EI"
    number = walls.number(key, need=POSITIVE)
    if key == "period_s":
        return Wall.of_period(mass, heights, number).stiffness_matrix, f"flexural cantilever, alone {number:g} s"
    if key == "alpha_h":
        return Wall.of_alpha_h(frame, number).stiffness_matrix, f"flexural cantilever, alpha H = {number:g}"
    share = f"flexural cantilever with {number:g} of the base shear in the first mode"
    return Wall.of_base_shear_share(frame, number).stiffness_matrix, share


STIFFNESS: Final = ("stiffness_kn_per_m", "stiffness_n_per_m", "stiffness_kip_per_in", "stiffness")
STRENGTH: Final = ("yield_shear_kn", "yield_shear_n", "yield_shear_over_weight", "yield_shear_kip", "yield_shear")
DESIGN: Final = ("design", "R", "design_fraction", "combination")
OF_STOREYS: Final = (
    *STIFFNESS,
    "relative_stiffness",
    *STRENGTH,
    "overstrength",
    "second_slope",
    "third_slope",
)
"""Keys of a storey that may differ in y."""
OTHER_DIRECTION: Final = (*PERIOD, *DESIGN, "damping", "damping_from_storey", *OF_STOREYS, "storeys")
"""Keys of the other direction."""
_REPLACED: Final = ((*PERIOD, *STIFFNESS), STRENGTH)
"""Groups of keys of which one in y replaces all in x."""


def tables_in_y(tables: Mapping[str, Any], file: str) -> Table:
    """Return the tables of the building in y, made from `other_direction` of a file; `tables` stays as it is."""
    whole = copy.deepcopy(dict(tables))
    other = Table(whole.pop("other_direction"), "other_direction", file, InvalidBuildingFile)
    other.known(OTHER_DIRECTION)
    in_y = Table(whole, "", f"{file}, other_direction", InvalidBuildingFile)
    storeys = other.tables("storeys") if "storeys" in other.values else []
    for key, read in (("building", in_y.table), ("storeys", in_y.tables)):
        if key in whole:
            read(key)  # what is not a table is refused before it is changed
    of_building, storey_tables = whole.setdefault("building", {}), whole.get("storeys", [])
    if storeys and len(storeys) != len(storey_tables):
        other.refuse("storeys", f"as many tables as the building has storeys, {len(storey_tables)}", str(len(storeys)))
    _merge([of_building, *storey_tables], {key: value for key, value in other.values.items() if key != "storeys"})
    for number, storey in enumerate(storeys):
        storey.known(OF_STOREYS)
        _merge([storey_tables[number]], storey.values)
        if any(key in storey.values for key in (*STIFFNESS, *STRENGTH)):
            for group in _REPLACED:
                if any(key in storey.values for key in group):
                    _drop(of_building, group)
    return in_y


def _merge(tables: list[dict[str, Any]], changes: dict[str, Any]) -> None:
    """Put what is given into the first table, in place of what all of them have of it."""
    for table in tables:
        for key in changes:
            table.pop(key, None)
        for group in _REPLACED:
            if any(key in changes for key in group):
                _drop(table, group)
        if any(key in changes for key in STRENGTH):
            _drop(table, DESIGN)
        if changes.get("design") is True:
            _drop(table, STRENGTH)
    tables[0].update(changes)


def _drop(table: dict[str, Any], keys: tuple[str, ...]) -> None:
    for key in keys:
        table.pop(key, None)


BASE_KEYS: Final = ("mu", "mu_s", "mu_k", "radius_m", "mass_kg", "mass_ratio")


def base_of(table: Table) -> SlidingBase | None:
    """Return the sliding base of a building file from its table `base`; None where that table is empty."""
    if not table.values:
        return None
    table.known(BASE_KEYS)
    table.needed("mu", "mu_s")
    table.excluded("mu", "mu_s", "mu_k")
    table.one_of("mass_kg", "mass_ratio")
    friction = {key: table.number(key, need=NOT_NEGATIVE) for key in ("mu", "mu_s", "mu_k") if key in table.values}
    others = {"radius_m": "radius", "mass_kg": "mass", "mass_ratio": "mass_ratio"}
    values: dict[str, Any] = {
        name: table.number(key, need=POSITIVE) for key, name in others.items() if key in table.values
    }
    static = friction.get("mu_s", friction.get("mu"))
    if "mu_k" in friction and static is not None and friction["mu_k"] > static:
        table.refuse("mu_k", f"at most {table.key('mu_s')}", f"{friction['mu_k']:g}")
    return SlidingBase(**friction, **values)
