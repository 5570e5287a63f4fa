"""Building files: your own building with its goods, site and code, from TOML or JSON, in the units that offices use.

Every key is known or refused, and every key of a quantity with a unit names it.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, cast, get_args

import numpy as np

from seismass.assessment.building import DesignRule, OwnBuilding, project_of
from seismass.assessment.file_keys import (
    ROWS,
    SI,
    SYSTEMS,
    US,
    held,
    keys_of,
    known,
    missing,
    needed,
    number,
    optional,
    sources_of,
    stated,
)
from seismass.assessment.file_parts import (
    DESIGN,
    FRICTION,
    LIVE_LOAD,
    PRESENT,
    base_of,
    category_of,
    check_period,
    code_of,
    floor_codes,
    kinds_of,
    limit_of,
    live_load_of,
    mu_factors_of,
    period_of,
    scaling_of,
    site_of,
    tables_in_y,
    walls_of,
)
from seismass.assessment.floors import by_floor, counted_fractions
from seismass.base.errors import InvalidBuildingFile
from seismass.base.files import data_directory
from seismass.base.input_table import (
    BUILDING_FILE,
    Need,
    Table,
    load_table,
    refuse_other_kind,
)
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import as_path, printable
from seismass.design import Combination, vibration_modes

_MASS, _STRENGTH, _STIFFNESS = keys_of("dead_load"), keys_of("strength"), keys_of("stiffness")[:2]


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
    known(top)
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
        known(storey, units)
        kinds_of_storey = storey.tables("goods")
        for kind in kinds_of_storey:
            known(kind, units)
        if kinds_of_storey:
            storey.values["goods"] = [kind.values for kind in kinds_of_storey]
    building, goods_table, site, code, walls, base, project = (
        _table(top, key, units) for key in ("building", "goods", "site", "code", "walls", "base", "project")
    )
    sources = sources_of(top.values)
    is_us = units == US or (not units and any(row.us and row.us in text for _, text in sources for row in ROWS))
    _unique(building, goods_table, storeys)
    frame = np.array([_mass(storey, building) for storey in storeys])
    heights = _heights(storeys, building)
    fraction = code_of(code)
    of_floors = floor_codes(storeys, goods_table, fraction)
    strength, design = _strength(storeys, building, frame)
    area = np.array([stated(storey, building, "area_m2") for storey in storeys])
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
    collapse = optional(building, "collapse_drift_ratio")
    for key in building.subset("collapse_drift_ratio", "drift_cap") if heights is None else ():
        storeys[0].refuse("height_m", f"given where {building.key(key)} is", "nothing")

    def springs(name: str) -> Any:
        return np.array([stated(storey, building, name) for storey in storeys])

    period = period_of(building, heights, len(storeys), fraction)
    counted = {"bare": 0.0 * mass, "all": fixed + present}
    if period.mass == "code share":
        live_load = by_floor(loose, [kind.live_load for kind in loose], len(storeys))
        shares = [one.fraction for one in counted_fractions(fraction, of_floors, mass, kinds, area)]
        counted["code share"] = fixed + np.array(shares) * live_load
    scaling = scaling_of(code)
    limit, limit_rule = limit_of(building, fraction, scaling or fraction.code_id)
    stiffness = _stiffness(storeys, building, frame, counted[period.mass], period.value)
    wall_matrix = None
    if "walls" in top.values:
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
        third_slope=springs("third_slope"),
        damping=number(building, "damping"),
        damping_from_storey=_damping_from(building, len(storeys)),
        gravity_load=gravity,
        area=area,
        dead_load_stated=np.array(
            [(held((storey, building), _MASS) or "")[1:] == ("dead_load_kpa",) for storey in storeys]
        ),
        kinds=kinds,
        mu_factors=mu_factors_of(goods_table),
        target=site_of(site, Path() if path is None else path.parent),
        code=fraction,
        floor_codes=of_floors,
        code_stated=bool(code.values.keys() - {"scaling"}),
        drift_limit=limit,
        drift_limit_rule=limit_rule,
        theta_limit=number(building, "theta_limit"),
        collapse_drift_ratio=collapse,
        drift_cap=np.inf if heights is None else number(building, "drift_cap"),
        scaling_period=optional(building, "scaling_period_s"),
        path=path,
        file_sha256=top.sha256,
        units=US if is_us else SI,
        project=project_of(project),
        sources=sources,
        walls=None if wall_matrix is None else wall_matrix.matrix,
        walls_stated="" if wall_matrix is None else wall_matrix.how,
        base=base_of(base) if "base" in top.values else None,
        risk_category=category_of(building),
        category_stated="risk_category" in building.values,
        system=building.text("system"),
        s_1=optional(site, "s1_g"),
        scaling=scaling,
    )


def _table(top: Table, key: str, units: str) -> Table:
    """Return a table, empty where the file has none."""
    table = top.table(key) if key in top.values else Table({}, key, top.file, InvalidBuildingFile)
    known(table, units)
    return table


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


def _mass(storey: Table, building: Table) -> float:
    """Mass of a floor without goods (kg)."""
    place = held((storey, building), _MASS)
    if place is None:
        missing(storey, building, _MASS)
    table, key = place
    value = number(table, key)
    return value if key == "mass_kg" else 1e3 * value * needed(storey, building, "area_m2") / STANDARD_GRAVITY


def _heights(storeys: list[Table], building: Table) -> Any:
    """Heights (m), or None where none is known."""
    if not any(held((storey, building), ("height_m",)) for storey in storeys):
        return None
    return np.array([needed(storey, building, "height_m") for storey in storeys])


def _gravity_load(storeys: list[Table], building: Table, mass: Any) -> Any:
    """Gravity load of each floor without goods (N): its weight, unless stated."""
    loads = np.array([stated(storey, building, "gravity_load_kn") for storey in storeys])
    return 1e3 * np.where(np.isnan(loads), 1e-3 * STANDARD_GRAVITY * mass, loads)


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
            values.append(unit * number(*place))
        for table in (building, *storeys):
            table.left_out(("relative_stiffness",), f"{building.key('period_s')} is", "given")
        return np.array(values)
    relative = np.array([stated(storey, building, "relative_stiffness") for storey in storeys])
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
        combination = building.choice("combination", get_args(Combination), "srss")
        fraction = optional(building, "design_fraction")
        return None, DesignRule(number(building, "R"), fraction, cast(Combination, combination))
    building.left_out(DESIGN[1:], f"{building.key('design')} is not true", "given")
    weight = STANDARD_GRAVITY * float(mass.sum())
    units = {"yield_shear_kn": 1e3, "yield_shear_n": 1.0, "yield_shear_over_weight": weight}
    values = []
    for storey in storeys:
        place = held((storey, building), _STRENGTH)
        if place is None:
            others = ", or ".join(("", *_STRENGTH[1:])).removeprefix(", or ")
            storey.refuse(_STRENGTH[0], f"given, or {others}, or {building.key('design')} = true with R", "nothing")
        values.append(units[place[1]] * number(*place))
    return np.array(values), None
