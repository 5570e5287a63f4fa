"""Building files: one's own building with its goods, site and code, from TOML or JSON, in the units that offices use.

Every key is known or refused, and every key of a quantity with a unit names it.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final, NoReturn, cast, get_args

import numpy as np

from seismass.assessment.own_building import DEFAULT_DRIFT_LIMIT, DEFAULT_THETA_LIMIT, DesignRule, OwnBuilding
from seismass.base.errors import InvalidBuildingFile, InvalidOption, SeismassError
from seismass.base.input_table import NOT_NEGATIVE, POSITIVE, SHARE, Need, Table, load_table
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import as_path, printable
from seismass.design import Combination, vibration_modes
from seismass.model.codes import AS_STATED, CodeFraction, code_fraction
from seismass.model.damping import DEFAULT_DAMPING
from seismass.model.friction import BOUND_FACTORS, bound_factors, friction_pair
from seismass.model.springs import DEFAULT_THIRD_SLOPE, SHAPE_FIELDS
from seismass.records.builtin import data_directory
from seismass.spectra import DEFAULT_TL, TargetSpectrum

DEFAULT_CODE: Final = "asce7-10"
"""Code whose fraction is taken where the file names none."""

_MASS: Final = ("dead_load_kpa", "mass_kg")
_STIFFNESS: Final = ("stiffness_kn_per_m", "stiffness_n_per_m")
_STRENGTH: Final = ("yield_shear_kn", "yield_shear_n", "yield_shear_over_weight")
_LIVE_LOAD: Final = ("live_load_kpa", "live_load_kg")
_FRICTION: Final = ("friction", "mu", "mu_s")
_STRONG: Final = Need("positive (inf: the storey stays elastic)", lambda number: number > 0.0)
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
_GOODS: Final = (*_LIVE_LOAD, "occupied", *_FRICTION, "mu_k")
_DESIGN: Final = ("R", "design_fraction", "combination")
KEYS: Final = {
    "": ("name", "note", "site", "code", "building", "goods", "storeys"),
    "site": ("sds_g", "sd1_g", "tl_s", "spectrum_csv"),
    "code": ("id", "use", "fraction"),
    "building": (
        "period_s",
        "damping",
        "p_delta",
        "design",
        *_DESIGN,
        "drift_limit",
        "theta_limit",
        "collapse_drift_ratio",
        "scaling_period_s",
        *_STOREY,
    ),
    "goods": ("mu_factors", *_GOODS),
    "storeys": ("name", *_STOREY, *_GOODS),
}
"""Keys of each table of a building file, the file itself first."""


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
    top.known(KEYS[""])
    storeys = top.tables("storeys")
    if not storeys:
        top.refuse("storeys", "a table per storey, storey 1 first", "none")
    for storey in storeys:
        storey.known(KEYS["storeys"])
    building, goods, site, code = (_table(top, key) for key in ("building", "goods", "site", "code"))
    _unique(building, goods, storeys)
    mass = np.array([_mass(storey, building) for storey in storeys])
    heights = _heights(storeys, building)
    fraction = _code(code)
    strength, design = _strength(storeys, building, mass)
    live_load = np.array([_live_load(storey, goods, building) for storey in storeys])
    occupied = np.array([_stated(storey, goods, "occupied", SHARE, 1.0) for storey in storeys])
    friction = [
        _friction(storey, goods) if load * share > 0.0 else ("", 0.0, 0.0)
        for storey, load, share in zip(storeys, live_load, occupied, strict=True)
    ]
    p_delta = building.flag("p_delta", heights is not None)
    if p_delta and heights is None:
        storeys[0].refuse("height_m", f"given where {building.key('p_delta')} is true", "nothing")
    collapse = _optional(building, "collapse_drift_ratio")
    if collapse is not None and heights is None:
        storeys[0].refuse("height_m", f"given where {building.key('collapse_drift_ratio')} is", "nothing")

    def springs(name: str) -> Any:
        return np.array([_spring(storey, building, name) for storey in storeys])

    return OwnBuilding(
        name=printable(top.text("name")) or ("building" if path is None else printable(path.stem)),
        note=printable(top.text("note"), lines=True),
        storey_names=tuple(printable(storey.text("name")) for storey in storeys),
        mass=mass,
        stiffness=_stiffness(storeys, building, mass),
        heights=heights,
        yield_shear=strength,
        design=design,
        overstrength=springs("overstrength"),
        second_slope=springs("second_slope"),
        third_slope=np.array(
            [_stated(storey, building, "third_slope", SHARE, DEFAULT_THIRD_SLOPE) for storey in storeys]
        ),
        damping=building.number("damping", DEFAULT_DAMPING, SHARE),
        gravity_load=_gravity_load(storeys, building, mass) if p_delta else None,
        area=np.array([_positive(storey, building, "area_m2", np.nan) for storey in storeys]),
        dead_load_stated=np.array([_key_of(storey, building, _MASS) == "dead_load_kpa" for storey in storeys]),
        live_load=live_load,
        occupied=occupied,
        friction=tuple(name for name, _, _ in friction),
        mu_s=np.array([static for _, static, _ in friction]),
        mu_k=np.array([kinetic for _, _, kinetic in friction]),
        mu_factors=_mu_factors(goods),
        target=_target(site, Path() if path is None else path.parent),
        code=fraction,
        code_stated=bool(code.values),
        drift_limit=building.number("drift_limit", DEFAULT_DRIFT_LIMIT, POSITIVE),
        theta_limit=building.number("theta_limit", DEFAULT_THETA_LIMIT, POSITIVE),
        collapse_drift_ratio=collapse,
        scaling_period=_optional(building, "scaling_period_s"),
        path=path,
    )


def _table(top: Table, key: str) -> Table:
    """Return a table, empty where the file has none."""
    table = top.table(key) if key in top.values else Table({}, key, top.file, InvalidBuildingFile)
    table.known(KEYS[key])
    return table


def _unique(building: Table, goods: Table, storeys: list[Table]) -> None:
    """Refuse two keys of one table that say the same."""
    for table in (building, goods, *storeys):
        for group in (_MASS, _STIFFNESS, _STRENGTH, _LIVE_LOAD, _FRICTION):
            table.one_of(*group)
        for key in ("mu", "friction"):
            table.excluded("mu_k", key)
    if "period_s" in building.values:
        for table in (building, *storeys):
            table.left_out(_STIFFNESS, f"{building.key('period_s')} is given", "both")


def _held(storey: Table, default: Table, group: tuple[str, ...]) -> tuple[Table, str] | None:
    """Return where a storey's value stands: in its own table, or else in the defaults."""
    for table in (storey, default):
        for key in group:
            if key in table.values:
                return table, key
    return None


def _key_of(storey: Table, default: Table, group: tuple[str, ...]) -> str:
    """Return by which key a storey's value stands; empty where there is none."""
    held = _held(storey, default, group)
    return "" if held is None else held[1]


def _number(held: tuple[Table, str], need: Need) -> float:
    table, key = held
    return table.number(key, need=need)


def _stated(storey: Table, default: Table, key: str, need: Need, value: float) -> float:
    """Return a number of a storey or of the defaults, or the value that stands for a missing one."""
    held = _held(storey, default, (key,))
    return value if held is None else _number(held, need)


def _positive(storey: Table, default: Table, key: str, value: float | None = None) -> float:
    """Return a positive number of a storey or of the defaults; a missing one is refused where there is no value."""
    if value is not None:
        return _stated(storey, default, key, POSITIVE, value)
    held = _held(storey, default, (key,))
    if held is None:
        storey.refuse(key, f"given, or {default.key(key)} for all storeys", "nothing")
    return _number(held, POSITIVE)


def _spring(storey: Table, default: Table, name: str) -> float:
    field = SHAPE_FIELDS[name]
    return _stated(
        storey, default, name, Need(field.requirement, lambda number: bool(field.accepts(number))), field.default
    )


def _optional(table: Table, key: str) -> float | None:
    return table.number(key, need=POSITIVE) if key in table.values else None


def _missing(storey: Table, default: Table, group: tuple[str, ...]) -> NoReturn:
    others = "".join(f", or {key}" for key in group[1:])
    storey.refuse(group[0], f"given{others}, here or in {default.place}", "nothing")


def _mass(storey: Table, building: Table) -> float:
    """Mass of a floor without goods (kg)."""
    held = _held(storey, building, _MASS)
    if held is None:
        _missing(storey, building, _MASS)
    table, key = held
    value = table.number(key, need=POSITIVE)
    return value if key == "mass_kg" else 1e3 * value * _positive(storey, building, "area_m2") / STANDARD_GRAVITY


def _heights(storeys: list[Table], building: Table) -> Any:
    """Heights (m), or None where none is known."""
    if not any(_held(storey, building, ("height_m",)) for storey in storeys):
        return None
    return np.array([_positive(storey, building, "height_m") for storey in storeys])


def _gravity_load(storeys: list[Table], building: Table, mass: Any) -> Any:
    """Gravity load of each floor without goods (N): its weight, unless stated."""
    return np.array(
        [
            1e3 * _positive(storey, building, "gravity_load_kn", 1e-3 * STANDARD_GRAVITY * float(floor))
            for storey, floor in zip(storeys, mass, strict=True)
        ]
    )


def _stiffness(storeys: list[Table], building: Table, mass: Any) -> Any:
    """Storey stiffnesses (N/m): as stated, or as the period of the building without goods asks."""
    if "period_s" not in building.values:
        values = []
        for storey in storeys:
            held = _held(storey, building, _STIFFNESS)
            if held is None:
                where = f"given, or {_STIFFNESS[1]}, or {building.key('period_s')} for the whole building"
                storey.refuse(_STIFFNESS[0], where, "nothing")
            unit = 1e3 if held[1] == "stiffness_kn_per_m" else 1.0
            values.append(unit * _number(held, POSITIVE))
        for table in (building, *storeys):
            table.left_out(("relative_stiffness",), f"{building.key('period_s')} is", "given")
        return np.array(values)
    period = building.number("period_s", need=POSITIVE)
    relative = np.array([_positive(storey, building, "relative_stiffness", 1.0) for storey in storeys])
    trial = relative * mass.mean()
    return trial * (vibration_modes(mass, trial).periods[0] / period) ** 2


def _strength(storeys: list[Table], building: Table, mass: Any) -> tuple[Any, DesignRule | None]:
    """First yield shears (N), or the rule that designs them."""
    if building.flag("design", False):
        for table in (building, *storeys):
            table.left_out(_STRENGTH, f"{building.key('design')} is true", "both")
        building.needed("R")
        reduction = building.number("R", need=Need("finite and at least 1", lambda number: 1.0 <= number < np.inf))
        combination = building.choice("combination", get_args(Combination), "srss")
        stated = "design_fraction" in building.values
        fraction = building.number("design_fraction", need=SHARE) if stated else None
        return None, DesignRule(reduction, fraction, cast(Combination, combination))
    building.left_out(_DESIGN, f"{building.key('design')} is not true", "given")
    weight = STANDARD_GRAVITY * float(mass.sum())
    units = {"yield_shear_kn": 1e3, "yield_shear_n": 1.0, "yield_shear_over_weight": weight}
    values = []
    for storey in storeys:
        held = _held(storey, building, _STRENGTH)
        if held is None:
            others = ", or ".join(("", *_STRENGTH[1:])).removeprefix(", or ")
            storey.refuse(_STRENGTH[0], f"given, or {others}, or {building.key('design')} = true with R", "nothing")
        values.append(units[held[1]] * _number(held, _STRONG))
    return np.array(values), None


def _live_load(storey: Table, goods: Table, building: Table) -> float:
    """Design live load of a floor as a mass (kg)."""
    held = _held(storey, goods, _LIVE_LOAD)
    if held is None:
        return 0.0
    table, key = held
    value = table.number(key, need=NOT_NEGATIVE)
    if key == "live_load_kg" or value == 0.0:
        return value
    return 1e3 * value * _positive(storey, building, "area_m2") / STANDARD_GRAVITY


def _friction(storey: Table, goods: Table) -> tuple[str, float, float]:
    """Contact (empty: stated as numbers), static and kinetic coefficient of the goods of a floor."""
    held = _held(storey, goods, _FRICTION)
    if held is None:
        _missing(storey, goods, _FRICTION)
    table, key = held
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


def _mu_factors(goods: Table) -> tuple[float, float]:
    given = goods.values.get("mu_factors", BOUND_FACTORS)
    try:
        return bound_factors(given, "goods")
    except InvalidOption as error:
        goods.refuse_as("mu_factors", error)


def _code(table: Table) -> CodeFraction:
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


def _target(site: Table, folder: Path) -> TargetSpectrum | None:
    """Site spectrum; None where the file has none."""
    if not site.values:
        return None
    if "spectrum_csv" in site.values:
        for key in ("sds_g", "sd1_g", "tl_s"):
            site.excluded(key, "spectrum_csv")
        return TargetSpectrum.from_csv(folder / site.text("spectrum_csv"))
    for key in ("sds_g", "sd1_g"):
        if key not in site.values:
            site.refuse(key, f"given, or {site.key('spectrum_csv')} for the whole spectrum", "nothing")
    short, one = (site.number(key, need=POSITIVE) for key in ("sds_g", "sd1_g"))
    tl = site.number("tl_s", DEFAULT_TL, POSITIVE)
    if tl < one / short:
        site.refuse("tl_s", f"at least T_S = S_D1/S_DS = {one / short:g} s", f"{tl:g}")
    return TargetSpectrum.asce7(short, one, tl)
