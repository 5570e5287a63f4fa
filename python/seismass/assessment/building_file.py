"""Building files: your own building with its goods, site and code, from TOML or JSON, in the units that offices use.

Every key is known or refused, and every key of a quantity with a unit names it.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final, NamedTuple, cast, get_args

import numpy as np

from seismass.assessment.building import DEFAULT_THETA_LIMIT, PROJECT, DesignRule, OwnBuilding, project_of
from seismass.assessment.file_parts import (
    BASE_KEYS,
    FRICTION,
    LIVE_LOAD,
    OTHER_DIRECTION,
    PRESENT,
    REDUCTION,
    SIZE,
    STRONG,
    SUPPORT,
    WALL_KEYS,
    base_of,
    held,
    key_of,
    kinds_of,
    live_load_of,
    missing,
    mu_factors_of,
    number_of,
    positive,
    stated,
    tables_in_y,
    walls_of,
)
from seismass.assessment.file_site import (
    LIMIT,
    PERIOD,
    SITE,
    category_of,
    check_period,
    code_of,
    floor_codes,
    limit_of,
    period_of,
    scaling_of,
    site_of,
)
from seismass.assessment.floors import by_floor, counted_fractions
from seismass.base.errors import InvalidBuildingFile
from seismass.base.files import data_directory
from seismass.base.input_table import (
    BUILDING_FILE,
    NOT_NEGATIVE,
    POSITIVE,
    SHARE,
    Need,
    Table,
    load_table,
    refuse_other_kind,
)
from seismass.base.statistics import DRIFT_CAP
from seismass.base.units import FOOT, KIP, STANDARD_GRAVITY
from seismass.base.values import as_path, printable
from seismass.design import Combination, vibration_modes
from seismass.model.building import DEFAULT_DAMPING
from seismass.model.springs import DEFAULT_THIRD_SLOPE, SHAPE_FIELDS

SI: Final = "si"
US: Final = "us"
SYSTEMS: Final = (SI, US)
"""What `units` of a file may be."""


class UnitKey(NamedTuple):
    """A quantity in the units of a file: its key without a unit (empty: none), in SI and in US units, the US unit in
    that of the SI key, what its number must be, and which tables have it; `in_si`: without a unit in SI files too.
    """

    plain: str
    si: str
    us: str
    factor: float
    need: Need
    tables: tuple[str, ...]
    in_si: bool = True


_STOREYS: Final = ("building", "storeys")
_LOADS: Final = ("goods", "storeys")
_SIZES: Final = ("goods", "storeys.goods")
UNIT_KEYS: Final = (
    UnitKey("height", "height_m", "height_ft", FOOT, POSITIVE, _STOREYS + _SIZES),
    UnitKey("area", "area_m2", "area_ft2", FOOT**2, POSITIVE, _STOREYS),
    UnitKey("dead_load", "dead_load_kpa", "dead_load_psf", 1e-6 * KIP / FOOT**2, POSITIVE, _STOREYS),
    UnitKey("mass", "mass_kg", "", 1.0, POSITIVE, _STOREYS),
    UnitKey("weight", "mass_kg", "weight_kip", KIP / STANDARD_GRAVITY, POSITIVE, _STOREYS, in_si=False),
    UnitKey("gravity_load", "gravity_load_kn", "gravity_load_kip", 1e-3 * KIP, POSITIVE, _STOREYS),
    UnitKey("stiffness", "stiffness_kn_per_m", "stiffness_kip_per_in", 1e-3 * KIP / (FOOT / 12.0), POSITIVE, _STOREYS),
    UnitKey("yield_shear", "yield_shear_kn", "yield_shear_kip", 1e-3 * KIP, STRONG, _STOREYS),
    UnitKey("live_load", "live_load_kpa", "live_load_psf", 1e-6 * KIP / FOOT**2, NOT_NEGATIVE, _LOADS),
    UnitKey("", "live_load_kg", "live_load_kip", KIP / STANDARD_GRAVITY, NOT_NEGATIVE, _LOADS),
    UnitKey("width", "width_m", "width_ft", FOOT, POSITIVE, _SIZES),
)
"""Keys of quantities that may stand in other units, or without one in a file that states its system."""


def _of_file(row: UnitKey, units: str) -> str:
    """The key that one without a unit stands for; empty where there is none in that system."""
    return {SI: row.si * row.in_si, US: row.us}.get(units, "") if row.plain else ""


def to_si(table: Table, units: str) -> None:
    """Convert the table in place to SI units: keys without a unit are in the `units` of the file ("", "si" or "us"). A
    key stated in two units is refused.
    """
    for row in UNIT_KEYS:
        key = _of_file(row, units)
        if key and row.plain in table.values:
            table.excluded(row.plain, key)
            table.values[key] = table.values.pop(row.plain)
    for row in UNIT_KEYS:
        if row.us and row.us in table.values:
            table.excluded(row.us, row.si)
            table.values[row.si] = row.factor * table.number(row.us, need=row.need)
            del table.values[row.us]


DEFAULT: Final = "default"
"""Source of a quantity that the file does not state."""
_MASS: Final = ("dead_load_kpa", "mass_kg")
_STIFFNESS: Final = ("stiffness_kn_per_m", "stiffness_n_per_m")
_STRENGTH: Final = ("yield_shear_kn", "yield_shear_n", "yield_shear_over_weight")
_OF_STOREYS: Final = {
    "height": ("height_m",),
    "area": ("area_m2",),
    "dead_load": ("dead_load_kpa", "mass_kg"),
    "gravity_load": ("gravity_load_kn",),
    "stiffness": (*_STIFFNESS, "relative_stiffness"),
    "strength": _STRENGTH,
    "overstrength": ("overstrength",),
    "second_slope": ("second_slope",),
    "third_slope": ("third_slope",),
}
_OF_GOODS: Final = {"live_load": LIVE_LOAD, "present": PRESENT, "friction": FRICTION, "size": SIZE[:1]}
_OF_BUILDING: Final = {
    "period": ("period_s", "system"),
    "damping": ("damping",),
    "p_delta": ("p_delta",),
    "design": ("design",),
    "reduction": ("R",),
    "design_fraction": ("design_fraction",),
    "combination": ("combination",),
    "drift_limit": ("drift_limit", "risk_category"),
    "risk_category": ("risk_category",),
    "theta_limit": ("theta_limit",),
    "collapse": ("collapse_drift_ratio",),
    "drift_cap": ("drift_cap",),
    "scaling_period": ("scaling_period_s",),
}


def sources_of(file: Mapping[str, Any]) -> tuple[tuple[str, str], ...]:
    """Return each quantity with the keys that state it, as the file has them, or `DEFAULT`."""
    building, goods_table = file.get("building") or {}, file.get("goods") or {}
    storeys: Sequence[Mapping[str, Any]] = file.get("storeys") or []
    sources = {}
    for name, keys in _OF_STOREYS.items():
        sources[name] = _stated(keys, ("building", building), storeys)
    for name, keys in _OF_GOODS.items():
        sources[name] = _stated(keys, ("goods", goods_table), storeys)
    for name, keys in _OF_BUILDING.items():
        sources[name] = ", ".join(f"building.{key}" for key in keys if building.get(key) is not None) or DEFAULT
    sources["mu_factors"] = "goods.mu_factors" if goods_table.get("mu_factors") is not None else DEFAULT
    for name in ("site", "code"):
        stated = file.get(name) or {}
        sources[name] = ", ".join(f"{name}.{key}" for key in stated if stated[key] is not None) or DEFAULT
    return tuple(sources.items())


def _stated(keys: Sequence[str], default: tuple[str, Mapping[str, Any]], storeys: Sequence[Mapping[str, Any]]) -> str:
    """Keys of the defaults and of storeys that state a quantity, in whichever unit."""
    known = {*keys, *_in_other_units(keys)}
    place, table = default
    parts = [f"{place}.{key}" for key in table if key in known and table[key] is not None]
    places: dict[str, list[str]] = {}
    for number, storey in enumerate(storeys, start=1):
        for key in storey:
            if key in known and storey[key] is not None:
                places.setdefault(key, []).append(str(number))
        for kind in storey.get("goods") or []:
            for key in kind:
                if key in known and kind[key] is not None and str(number) not in places.setdefault(f"goods.{key}", []):
                    places[f"goods.{key}"].append(str(number))
    parts += [f"storeys[{', '.join(numbers)}].{key}" for key, numbers in places.items()]
    return "; ".join(parts) or DEFAULT


def _in_other_units(keys: Sequence[str]) -> set[str]:
    """Keys in US units, and those without a unit, that stand in the place of keys."""
    return {other for row in UNIT_KEYS if row.si in keys for other in (row.plain, row.us) if other}


_STOREY: Final = (
    "height_m",
    "area_m2",
    *_MASS,
    "gravity_load_kn",
    *_STIFFNESS,
    "relative_stiffness",
    *_STRENGTH,
    "overstrength",
    "second_slope",
    "third_slope",
)
_KIND: Final = ("use", *PRESENT, *FRICTION, "mu_k", *SUPPORT)
_GOODS: Final = (*LIVE_LOAD, *_KIND)
_DESIGN: Final = ("R", "design_fraction", "combination")
KEYS: Final = {
    "": (
        "name",
        "note",
        "units",
        "project",
        "site",
        "code",
        "building",
        "walls",
        "base",
        "goods",
        "storeys",
        "other_direction",
    ),
    "project": PROJECT,
    "site": SITE,
    "code": ("id", "use", "fraction", "scaling"),
    "building": (
        *PERIOD,
        "damping",
        "damping_from_storey",
        "p_delta",
        "design",
        *_DESIGN,
        *LIMIT,
        "theta_limit",
        "collapse_drift_ratio",
        "drift_cap",
        "scaling_period_s",
        *_STOREY,
    ),
    "walls": WALL_KEYS,
    "base": BASE_KEYS,
    "goods": ("mu_factors", *_GOODS, *SIZE),
    "storeys": ("name", "fraction", "exempt", "goods", *_STOREY, *_GOODS),
    "storeys.goods": ("name", "share", "attached", *_KIND, *SIZE),
    "other_direction": OTHER_DIRECTION,
}
"""Keys of each table of a building file, the file itself first."""
US_KEYS: Final = {kind: tuple(row.us for row in UNIT_KEYS if row.us and kind in row.tables) for kind in KEYS}
"""Keys in US units, in place of those in SI units."""


def example_file() -> Path:
    """Return the building file that ships with the package: a warehouse of four storeys."""
    return data_directory() / "examples" / "warehouse.toml"


def read_building(source: str | os.PathLike[str] | Mapping[str, Any]) -> OwnBuilding:
    """Read a building file.

    Parameters
    ----------
    source : path-like or mapping
        A .toml or .json file with the keys of docs/building_file.md, or its tables as a dict. Paths in it are relative
        to its folder.

    Returns
    -------
    OwnBuilding
        The building with its goods, site, code and limits, in SI units.

    Raises
    ------
    InvalidBuildingFile
        The file cannot be read, has an unknown, missing or contradicting key, or a value out of its range.
    RecordFormatError
        The spectrum that it names cannot be read.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.read_building({
    ...     "site": {"sds_g": 1.0, "sd1_g": 0.6},
    ...     "building": {"period_s": 0.4, "height_m": 4, "area_m2": 500, "dead_load_kpa": 5, "design": True, "R": 4},
    ...     "goods": {"live_load_kpa": 6, "friction": "timber-on-steel"},
    ...     "storeys": [{}, {"live_load_kpa": 0}],
    ... })
    >>> building.live_load.round()
    array([305915.,      0.])
    """
    if isinstance(source, Mapping):
        path, top = None, Table(dict(source), "", "building", InvalidBuildingFile)
    else:
        path = as_path(source, "building file", InvalidBuildingFile)
        top = load_table(path, "building file", InvalidBuildingFile)
    refuse_other_kind(top, BUILDING_FILE)
    top.known(KEYS[""])
    if "other_direction" not in top.values:
        return _building(top, path)
    if "base" in top.values:
        top.refuse("base", f"left out where {top.key('other_direction')} is given", "both")
    in_y = tables_in_y(top.values, top.file)
    return replace(_building(top, path), other=_building(in_y, path))


def _building(top: Table, path: Path | None) -> OwnBuilding:
    """The building of a file in one direction."""
    units = top.choice("units", SYSTEMS) if "units" in top.values else ""
    storeys = top.tables("storeys")
    if not storeys:
        top.refuse("storeys", "a table per storey, storey 1 first", "none")
    for storey in storeys:
        _known(storey, "storeys", units)
        kinds_of_storey = storey.tables("goods")
        for kind in kinds_of_storey:
            _known(kind, "storeys.goods", units)
        if kinds_of_storey:
            storey.values["goods"] = [kind.values for kind in kinds_of_storey]
    building, goods_table, site, code, walls, base, project = (
        _table(top, key, units) for key in ("building", "goods", "site", "code", "walls", "base", "project")
    )
    sources = sources_of(top.values)
    is_us = units == US or (not units and any(row.us and row.us in text for _, text in sources for row in UNIT_KEYS))
    _unique(building, goods_table, storeys)
    frame = np.array([_mass(storey, building) for storey in storeys])
    heights = _heights(storeys, building)
    fraction = code_of(code)
    of_floors = floor_codes(storeys, goods_table, fraction)
    strength, design = _strength(storeys, building, frame)
    area = np.array([positive(storey, building, "area_m2", np.nan) for storey in storeys])
    kinds = tuple(
        kind
        for number, storey in enumerate(storeys, start=1)
        for kind in kinds_of(
            number,
            storey,
            goods_table,
            live_load_of(storey, goods_table, building),
            float(area[number - 1]),
            (of_floors[number - 1].use, fraction.use),
        )
    )
    loose, bolted = (tuple(kind for kind in kinds if kind.attached == fixed) for fixed in (False, True))
    present = by_floor(loose, [kind.mass for kind in loose], len(storeys))
    fixed = by_floor(bolted, [kind.mass for kind in bolted], len(storeys))
    mass = frame + fixed
    p_delta = building.flag("p_delta", heights is not None)
    if p_delta and heights is None:
        storeys[0].refuse("height_m", f"given where {building.key('p_delta')} is true", "nothing")
    collapse = _optional(building, "collapse_drift_ratio")
    for key in building.subset("collapse_drift_ratio", "drift_cap") if heights is None else ():
        storeys[0].refuse("height_m", f"given where {building.key(key)} is", "nothing")

    def springs(name: str) -> Any:
        return np.array([_spring(storey, building, name) for storey in storeys])

    period = period_of(building, heights, len(storeys), fraction)
    counted = {"bare": 0.0 * mass, "all": fixed + present}
    if period.mass == "code share":
        live_load = by_floor(loose, [kind.live_load for kind in loose], len(storeys))
        shares = [one.fraction for one in counted_fractions(fraction, of_floors, mass, kinds, area)]
        counted["code share"] = fixed + np.array(shares) * live_load
    scaling = scaling_of(code)
    limit, limit_rule = limit_of(building, fraction, scaling or fraction.code_id)
    stiffness = _stiffness(storeys, building, frame, counted[period.mass], period.value)
    wall_matrix = walls_of(walls, building, frame + counted[period.mass], stiffness, heights, period.value)
    if wall_matrix is not None and "damping_from_storey" in building.values:
        building.refuse("damping_from_storey", f"left out where {top.key('walls')} is given", "both")
    gravity = _gravity_load(storeys, building, frame) + STANDARD_GRAVITY * fixed if p_delta else None
    if gravity is not None and heights is not None and wall_matrix is None:
        load = np.cumsum((gravity + STANDARD_GRAVITY * present)[::-1])[::-1]
        check_period(building, period, stiffness, load / heights)
    return OwnBuilding(
        name=printable(top.text("name")) or ("building" if path is None else printable(path.stem)),
        note=printable(top.text("note"), lines=True),
        storey_names=tuple(printable(storey.text("name")) for storey in storeys),
        mass=mass,
        stiffness=stiffness if wall_matrix is None else wall_matrix.stiffness,
        stated_period=period.value,
        period_mass=period.mass,
        period_rule=period.rule,
        heights=heights,
        yield_shear=strength,
        design=design,
        overstrength=springs("overstrength"),
        second_slope=springs("second_slope"),
        third_slope=np.array(
            [stated(storey, building, "third_slope", SHARE, DEFAULT_THIRD_SLOPE) for storey in storeys]
        ),
        damping=building.number("damping", DEFAULT_DAMPING, SHARE),
        damping_from_storey=_damping_from(building, len(storeys)),
        gravity_load=gravity,
        area=area,
        dead_load_stated=np.array([key_of(storey, building, _MASS) == "dead_load_kpa" for storey in storeys]),
        kinds=kinds,
        mu_factors=mu_factors_of(goods_table),
        target=site_of(site, Path() if path is None else path.parent),
        code=fraction,
        floor_codes=of_floors,
        code_stated=bool(code.values.keys() - {"scaling"}),
        drift_limit=limit,
        drift_limit_rule=limit_rule,
        theta_limit=building.number("theta_limit", DEFAULT_THETA_LIMIT, POSITIVE),
        collapse_drift_ratio=collapse,
        drift_cap=np.inf if heights is None else building.number("drift_cap", DRIFT_CAP, POSITIVE),
        scaling_period=_optional(building, "scaling_period_s"),
        path=path,
        file_sha256=top.sha256,
        units=US if is_us else SI,
        project=project_of(project),
        sources=sources,
        walls=None if wall_matrix is None else wall_matrix.matrix,
        walls_stated="" if wall_matrix is None else wall_matrix.how,
        base=base_of(base),
        risk_category=category_of(building),
        category_stated="risk_category" in building.values,
        system=building.text("system"),
        s_1=_optional(site, "s1_g"),
        scaling=scaling,
    )


def _table(top: Table, key: str, units: str) -> Table:
    """Return a table, empty where the file has none."""
    table = top.table(key) if key in top.values else Table({}, key, top.file, InvalidBuildingFile)
    _known(table, key, units)
    return table


def _known(table: Table, kind: str, units: str) -> None:
    """Refuse keys that are not known, and put those without a unit and in US units into SI units."""
    plain = (row.plain for row in UNIT_KEYS if _of_file(row, units) and kind in row.tables)
    table.known(KEYS[kind], also=(*US_KEYS[kind], *plain))
    to_si(table, units)


def _unique(building: Table, goods_table: Table, storeys: list[Table]) -> None:
    """Refuse two keys of one table that say the same."""
    for table in (building, goods_table, *storeys):
        for group in (_MASS, _STIFFNESS, _STRENGTH, LIVE_LOAD):
            table.one_of(*group)
    for table in (goods_table, *storeys, *(kind for storey in storeys for kind in storey.tables("goods"))):
        for group in (PRESENT, FRICTION):
            table.one_of(*group)
        for key in ("mu", "friction"):
            table.excluded("mu_k", key)
    for key in ("period_s", "system"):
        if key in building.values:
            for table in (building, *storeys):
                table.left_out(_STIFFNESS, f"{building.key(key)} is given", "both")


def _spring(storey: Table, default: Table, name: str) -> float:
    field = SHAPE_FIELDS[name]
    return stated(
        storey, default, name, Need(field.requirement, lambda number: bool(field.accepts(number))), field.default
    )


def _optional(table: Table, key: str) -> float | None:
    return table.number(key, need=POSITIVE) if key in table.values else None


def _mass(storey: Table, building: Table) -> float:
    """Mass of a floor without goods (kg)."""
    place = held((storey, building), _MASS)
    if place is None:
        missing(storey, building, _MASS)
    table, key = place
    value = table.number(key, need=POSITIVE)
    return value if key == "mass_kg" else 1e3 * value * positive(storey, building, "area_m2") / STANDARD_GRAVITY


def _heights(storeys: list[Table], building: Table) -> Any:
    """Heights (m), or None where none is known."""
    if not any(held((storey, building), ("height_m",)) for storey in storeys):
        return None
    return np.array([positive(storey, building, "height_m") for storey in storeys])


def _gravity_load(storeys: list[Table], building: Table, mass: Any) -> Any:
    """Gravity load of each floor without goods (N): its weight, unless stated."""
    return np.array(
        [
            1e3 * positive(storey, building, "gravity_load_kn", 1e-3 * STANDARD_GRAVITY * float(floor))
            for storey, floor in zip(storeys, mass, strict=True)
        ]
    )


def _stiffness(storeys: list[Table], building: Table, mass: Any, counted: Any, period: float | None) -> Any:
    """Storey stiffnesses (N/m): as stated, or as the period of the building with the mass counted on floors asks."""
    if period is None:
        values = []
        for storey in storeys:
            place = held((storey, building), _STIFFNESS)
            if place is None:
                whole = f"{building.key('period_s')} or {building.key('system')} for the whole building"
                where = f"given, or {_STIFFNESS[1]}, or {whole}"
                storey.refuse(_STIFFNESS[0], where, "nothing")
            unit = 1e3 if place[1] == "stiffness_kn_per_m" else 1.0
            values.append(unit * number_of(place, POSITIVE))
        for table in (building, *storeys):
            table.left_out(("relative_stiffness",), f"{building.key('period_s')} is", "given")
        return np.array(values)
    relative = np.array([positive(storey, building, "relative_stiffness", 1.0) for storey in storeys])
    trial = relative * mass.mean()
    return trial * (vibration_modes(mass + counted, trial).periods[0] / period) ** 2


def _damping_from(building: Table, storeys: int) -> int:
    """Lowest storey that is damped."""
    need = Need(f"a whole number from 1 to {storeys}", lambda number: number in range(1, storeys + 1))
    return int(building.number("damping_from_storey", 1.0, need))


def _strength(storeys: list[Table], building: Table, mass: Any) -> tuple[Any, DesignRule | None]:
    """First yield shears (N), or the rule that designs them."""
    if building.flag("design", False):
        for table in (building, *storeys):
            table.left_out(_STRENGTH, f"{building.key('design')} is true", "both")
        building.needed("R")
        reduction = building.number("R", need=REDUCTION)
        combination = building.choice("combination", get_args(Combination), "srss")
        stated = "design_fraction" in building.values
        fraction = building.number("design_fraction", need=SHARE) if stated else None
        return None, DesignRule(reduction, fraction, cast(Combination, combination))
    building.left_out(_DESIGN, f"{building.key('design')} is not true", "given")
    weight = STANDARD_GRAVITY * float(mass.sum())
    units = {"yield_shear_kn": 1e3, "yield_shear_n": 1.0, "yield_shear_over_weight": weight}
    values = []
    for storey in storeys:
        place = held((storey, building), _STRENGTH)
        if place is None:
            others = ", or ".join(("", *_STRENGTH[1:])).removeprefix(", or ")
            storey.refuse(_STRENGTH[0], f"given, or {others}, or {building.key('design')} = true with R", "nothing")
        values.append(units[place[1]] * number_of(place, STRONG))
    return np.array(values), None
