"""Building files: your own building with its goods, site and code, from TOML or JSON, in the units that offices use.

Every key is known or refused, and every key of a quantity with a unit names it.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Final, cast, get_args

import numpy as np

from seismass.assessment.file_base import BASE_KEYS, base_of
from seismass.assessment.file_codes import code_of, floor_codes
from seismass.assessment.file_goods import FRICTION, LIVE_LOAD, PRESENT, kinds_of, live_load_of, mu_factors_of
from seismass.assessment.file_plane import OTHER_DIRECTION, tables_in_y
from seismass.assessment.file_racks import SUPPORT
from seismass.assessment.file_site import LIMIT, PERIOD, SITE, check_period, limit_of, period_of, site_of
from seismass.assessment.file_units import (
    PLAIN_GOODS_KEYS,
    PLAIN_STOREY_KEYS,
    SYSTEMS,
    US_GOODS_KEYS,
    US_STOREY_KEYS,
    plain_keys,
    to_si,
)
from seismass.assessment.file_values import (
    REDUCTION,
    STRONG,
    held,
    key_of,
    missing,
    number_of,
    positive,
    stated,
)
from seismass.assessment.file_walls import WALL_KEYS, walls_of
from seismass.assessment.floors import by_floor, counted_fractions
from seismass.assessment.own_building import (
    DEFAULT_THETA_LIMIT,
    DesignRule,
    OwnBuilding,
)
from seismass.assessment.project import PROJECT, project_of
from seismass.assessment.sources import sources_of
from seismass.base.errors import InvalidBuildingFile
from seismass.base.input_kinds import BUILDING_FILE, refuse_other_kind
from seismass.base.input_table import POSITIVE, SHARE, Need, Table, load_table
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import as_path, printable
from seismass.design import Combination, vibration_modes
from seismass.model.damping import DEFAULT_DAMPING
from seismass.model.springs import DEFAULT_THIRD_SLOPE, SHAPE_FIELDS
from seismass.records.builtin import data_directory

_MASS: Final = ("dead_load_kpa", "mass_kg")
_STIFFNESS: Final = ("stiffness_kn_per_m", "stiffness_n_per_m")
_STRENGTH: Final = ("yield_shear_kn", "yield_shear_n", "yield_shear_over_weight")
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
_KIND: Final = (*PRESENT, *FRICTION, "mu_k", *SUPPORT)
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
    "code": ("id", "use", "fraction"),
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
        "scaling_period_s",
        *_STOREY,
    ),
    "walls": WALL_KEYS,
    "base": BASE_KEYS,
    "goods": ("mu_factors", *_GOODS),
    "storeys": ("name", "use", "fraction", "exempt", "goods", *_STOREY, *_GOODS),
    "storeys.goods": ("name", "share", "attached", *_KIND),
    "other_direction": OTHER_DIRECTION,
}
"""Keys of each table of a building file, the file itself first."""
US_KEYS: Final[dict[str, tuple[str, ...]]] = {
    "building": tuple(US_STOREY_KEYS),
    "goods": tuple(US_GOODS_KEYS),
    "storeys": (*US_STOREY_KEYS, *US_GOODS_KEYS),
}
"""Keys in US units, in place of those in SI units."""
PLAIN_KEYS: Final[dict[str, dict[str, dict[str, str]]]] = {
    "building": PLAIN_STOREY_KEYS,
    "goods": PLAIN_GOODS_KEYS,
    "storeys": PLAIN_STOREY_KEYS | PLAIN_GOODS_KEYS,
}
"""Keys without a unit, in a file that states its system of units."""


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
        for kind in storey.tables("goods"):
            _known(kind, "storeys.goods", units)
    building, goods, site, code, walls, base, project = (
        _table(top, key, units) for key in ("building", "goods", "site", "code", "walls", "base", "project")
    )
    _unique(building, goods, storeys)
    frame = np.array([_mass(storey, building) for storey in storeys])
    heights = _heights(storeys, building)
    fraction = code_of(code)
    of_floors = floor_codes(storeys, fraction)
    strength, design = _strength(storeys, building, frame)
    area = np.array([positive(storey, building, "area_m2", np.nan) for storey in storeys])
    kinds = tuple(
        kind
        for number, storey in enumerate(storeys, start=1)
        for kind in kinds_of(
            number,
            storey,
            goods,
            live_load_of(storey, goods, building),
            float(area[number - 1]),
            of_floors[number - 1].use or fraction.use,
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
    if collapse is not None and heights is None:
        storeys[0].refuse("height_m", f"given where {building.key('collapse_drift_ratio')} is", "nothing")

    def springs(name: str) -> Any:
        return np.array([_spring(storey, building, name) for storey in storeys])

    period = period_of(building, heights, len(storeys), fraction)
    counted = {"bare": 0.0 * mass, "all": fixed + present}
    if period.mass == "code share":
        live_load = by_floor(loose, [kind.live_load for kind in loose], len(storeys))
        shares = [one.fraction for one in counted_fractions(fraction, of_floors, mass, kinds, area)]
        counted["code share"] = fixed + np.array(shares) * live_load
    limit, limit_rule = limit_of(building, fraction)
    stiffness = _stiffness(storeys, building, frame, counted[period.mass], period.value)
    beside = walls_of(walls, building, frame + counted[period.mass], stiffness, heights, period.value)
    if beside is not None and "damping_from_storey" in building.values:
        building.refuse("damping_from_storey", f"left out where {top.key('walls')} is given", "both")
    gravity = _gravity_load(storeys, building, frame) + STANDARD_GRAVITY * fixed if p_delta else None
    if gravity is not None and heights is not None and beside is None:
        load = np.cumsum((gravity + STANDARD_GRAVITY * present)[::-1])[::-1]
        check_period(building, period, stiffness, load / heights)
    return OwnBuilding(
        name=printable(top.text("name")) or ("building" if path is None else printable(path.stem)),
        note=printable(top.text("note"), lines=True),
        storey_names=tuple(printable(storey.text("name")) for storey in storeys),
        mass=mass,
        stiffness=stiffness if beside is None else beside.stiffness,
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
        mu_factors=mu_factors_of(goods),
        target=site_of(site, Path() if path is None else path.parent),
        code=fraction,
        floor_codes=of_floors,
        code_stated=bool(code.values),
        drift_limit=limit,
        drift_limit_rule=limit_rule,
        theta_limit=building.number("theta_limit", DEFAULT_THETA_LIMIT, POSITIVE),
        collapse_drift_ratio=collapse,
        scaling_period=_optional(building, "scaling_period_s"),
        path=path,
        project=project_of(project),
        sources=sources_of(top.values),
        walls=None if beside is None else beside.matrix,
        walls_stated="" if beside is None else beside.how,
        base=base_of(base),
    )


def _table(top: Table, key: str, units: str) -> Table:
    """Return a table, empty where the file has none."""
    table = top.table(key) if key in top.values else Table({}, key, top.file, InvalidBuildingFile)
    _known(table, key, units)
    return table


def _known(table: Table, kind: str, units: str) -> None:
    """Refuse keys that are not known, and put those without a unit and in US units into SI units."""
    table.known(KEYS[kind], also=(*US_KEYS.get(kind, ()), *plain_keys(PLAIN_KEYS.get(kind, {}), units)))
    to_si(table, units)


def _unique(building: Table, goods: Table, storeys: list[Table]) -> None:
    """Refuse two keys of one table that say the same."""
    for table in (building, goods, *storeys):
        for group in (_MASS, _STIFFNESS, _STRENGTH, LIVE_LOAD):
            table.one_of(*group)
    for table in (goods, *storeys, *(kind for storey in storeys for kind in storey.tables("goods"))):
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
