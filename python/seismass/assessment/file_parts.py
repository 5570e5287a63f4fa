"""Parts of a building file: site, period, limits, code, goods, racks, walls, the second direction, the base."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple, get_args

import numpy as np
import polars as pl

from seismass.assessment.building import limit_at_level
from seismass.assessment.file_keys import KEYS, held, keys_of, known, missing, needed, number, optional, spelled
from seismass.assessment.floors import NOTHING_STATED, FloorCode, FloorGoods, GoodsRack, GoodsStops
from seismass.base.errors import InvalidBuildingFile, InvalidOption, SeismassError
from seismass.base.input_table import Need, Table
from seismass.base.statistics import QUANTILES, quantile
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_array, brief, printable
from seismass.design import (
    DRIFT_LIMIT_CODES,
    PERIOD_CODES,
    DriftLimit,
    PeriodRule,
    Wall,
    code_period,
    drift_limit,
    drift_limit_table,
    period_table,
    vibration_modes,
)
from seismass.design.rules import CATEGORIES
from seismass.design.scaling.asce7 import spectra_of
from seismass.design.scaling.by_code import SCALING_CODES
from seismass.model.block import SlidingBase
from seismass.model.building import Building
from seismass.model.codes import AS_STATED, CodeFraction, code_fraction
from seismass.model.friction import BOUND_FACTORS, bound_factors, friction_pair
from seismass.model.occupancy import SURVEYED, surveyed_load
from seismass.model.plausibility import PERIOD_RANGE
from seismass.model.rack import rack_direction
from seismass.model.tipping import BlockSize, Tipping
from seismass.motions.scaling.suite import target_of
from seismass.motions.spectra import TargetSpectrum
from seismass.motions.spectra.tables import file_and_words

PERIOD_MASSES: Final = ("bare", "code share", "all")
"""What a period is the period of: the building without goods, with the code's share of them, or with all present."""


def site_of(site: Table, folder: Path) -> TargetSpectrum | None:
    """Return the site spectrum; None where the file has none."""
    if not site.values:
        return None
    for whole in ("target", "spectrum_csv"):
        for key in KEYS["site"]:
            if key not in (whole, "s1_g"):
                site.excluded(key, whole)
    if "target" in site.values:
        try:
            return target_of(site.text("target"), folder)
        except InvalidOption as error:
            requirement = str(error).partition(" must be ")[2].rpartition("; got ")[0]
            site.refuse("target", requirement if "one of asce7" in requirement else f"valid: {error}", "another")
    if "spectrum_csv" in site.values:
        file, words = file_and_words(site.text("spectrum_csv"), folder)
        return TargetSpectrum.from_csv(file, **words)
    for key in ("sds_g", "sd1_g"):
        if key not in site.values:
            others = f"{site.key('spectrum_csv')} or {site.key('target')} for the whole spectrum"
            site.refuse(key, f"given, or {others}", "nothing")
    short, one, tl = (number(site, key) for key in ("sds_g", "sd1_g", "tl_s"))
    if tl < one / short:
        site.refuse("tl_s", f"at least T_S = S_D1/S_DS = {one / short:g} s", f"{tl:g}")
    return TargetSpectrum.asce7(short, one, tl)


class StatedPeriod(NamedTuple):
    """First period of a building file (s; None where stiffnesses are stated), which goods act as mass in it (one of
    `PERIOD_MASSES`), and the row of the code that gave it.
    """

    value: float | None
    mass: str
    rule: PeriodRule | None


def period_of(building: Table, heights: FloatArray | None, storeys: int, code: CodeFraction) -> StatedPeriod:
    """Return the first period: as stated, or by the formula of a code for a structural system and the height."""
    if "system" not in building.values or "period_s" in building.values:
        if "system" not in building.values:
            building.left_out(("period_code",), f"{building.key('system')} is not given")
        else:  # it limits the period of the design, by the code of the file
            building.left_out(("period_code",), f"{building.key('period_s')} is given", "both")
            building.choice("system", period_table()["system"].unique(maintain_order=True))
        if "period_mass" in building.values:
            building.needed("period_s", "system")
        return StatedPeriod(optional(building, "period_s"), _mass(building, "bare"), None)
    code_id = _code_id(building, "period_code", code, PERIOD_CODES, "approximate period is known here")
    if heights is None:
        building.refuse("height_m", f"given where {building.key('system')} is", "nothing")
    try:
        rule = code_period(code_id, building.text("system"), height=float(heights.sum()), storeys=storeys)
    except InvalidOption as error:
        building.refuse_as("system", error)
    return StatedPeriod(rule.approximate, _mass(building, "code share"), rule.rule)


def _mass(building: Table, default: str) -> str:
    mass = building.text("period_mass") if "period_mass" in building.values else default
    if mass not in PERIOD_MASSES:
        building.refuse("period_mass", f"one of {', '.join(PERIOD_MASSES)}", brief(mass))
    return mass


def limit_of(building: Table, code: CodeFraction, scaling: str) -> tuple[float, DriftLimit | None]:
    """Return the limit of the drift ratio at the level of a rule of scaling, and the row of the code that gave it (of
    ASCE 7-10 where the code has none); None where it was stated.
    """
    by_code = ("drift_class", "drift_limit_code")
    category = category_of(building)
    asked = any(key in building.values for key in by_code)
    if "drift_limit" in building.values:
        building.left_out(by_code, f"{building.key('drift_limit')} is given", "both")
        return number(building, "drift_limit"), None
    if not asked and code.code_id not in DRIFT_LIMIT_CODES:
        row = drift_limit(DEFAULT_CODE, category)
        return limit_at_level(row, scaling), row
    code_id = _code_id(building, "drift_limit_code", code, DRIFT_LIMIT_CODES, "drift limits are known here")
    of_code = drift_limit_table().filter(code_id=code_id)
    structure = building.choice("drift_class", of_code["structure"].unique(maintain_order=True), "other")
    row = drift_limit(code_id, category, structure)
    return limit_at_level(row, scaling), row


def category_of(building: Table) -> str:
    """Return the risk category that the file states, or II."""
    return building.choice("risk_category", CATEGORIES, "II")


def scaling_of(table: Table) -> str:
    """Return the rule of scaling that the file states; empty where it states none."""
    if "scaling" not in table.values:
        return ""
    return table.choice("scaling", SCALING_CODES)


def check_period(building: Table, period: StatedPeriod, stiffness: FloatArray, geometric: FloatArray) -> None:
    """Refuse a period so long that P-Delta takes the whole stiffness of a storey: `geometric` is P/h with the goods
    present (N/m), shape (storeys,).
    """
    ratio = geometric / stiffness
    storey = int(np.argmax(ratio))
    if period.value is None or ratio[storey] < 1.0:
        return
    longest = period.value / np.sqrt(ratio[storey])
    if longest < PERIOD_RANGE[0]:  # no building has one so short: the loads are wrong, which the scene says
        return
    sentence = (
        f"below {longest:.3g} s, where the gravity load P/h of storey {storey + 1} takes its whole stiffness (are "
        "loads and heights in the units of their keys?)"
    )
    if period.rule is None:
        building.refuse("period_s", sentence, f"{period.value:g}")
    building.refuse("system", f"one whose period is {sentence}", f"{period.value:.3g} s")


def _code_id(building: Table, key: str, code: CodeFraction, known: tuple[str, ...], what: str) -> str:
    """The code that a key names, or else that of the file, whose rules must be known."""
    code_id = building.text(key).lower() if key in building.values else code.code_id
    if code_id in known:
        return code_id
    building.refuse(key, f"one of the codes whose {what}: {', '.join(known)}", brief(code_id) if code_id else "none")


DEFAULT_CODE: Final = "asce7-10"
"""Code whose fraction is taken where the file names none."""


def code_of(table: Table) -> CodeFraction:
    """Return the code of the file, or a fraction of your own."""
    if "fraction" in table.values:
        table.excluded("id", "fraction")
        table.excluded("use", "fraction")
        value = number(table, "fraction")
        return CodeFraction("own", "a fraction that the user states", "storage", value, value, value, "", "", AS_STATED)
    names = {key: table.text(key) for key in ("id", "use")}
    try:
        row = code_fraction(names["id"] or DEFAULT_CODE)
        return code_fraction(row.code_id, names["use"] or "storage")  # type: ignore[arg-type]
    except InvalidOption as error:
        key = "use" if str(error).startswith("use") else "id"
        table.refuse_as(key, error)


def floor_codes(storeys: list[Table], goods: Table, code: CodeFraction) -> tuple[FloorCode, ...]:
    """Return what the tables of the storeys, or of all goods, say for the code: `use`, or `fraction`, and `exempt`."""
    codes = []
    of_all = _use(goods, code)
    for storey in storeys:
        storey.one_of("use", "fraction")
        exempt = storey.flag("exempt", False) if "exempt" in storey.values else None
        if exempt:
            storey.one_of("use", "fraction", "exempt")
        for kind in storey.tables("goods"):
            _use(kind, code)
        codes.append(FloorCode(number(storey, "fraction"), _use(storey, code) or of_all, exempt))
    return tuple(codes)


def _use(table: Table, code: CodeFraction) -> str:
    """The use that a table states, of which the code must say something; empty where it states none."""
    use = table.text("use")
    if use and code.status == AS_STATED:
        table.refuse("use", "left out where code.fraction is given", "both")
    if use:
        try:
            code_fraction(code.code_id, use)  # type: ignore[arg-type]
        except InvalidOption as error:
            table.refuse_as("use", error)
    return use


PERIODS: Final[FloatArray] = np.round(np.geomspace(0.05, 5.0, 81), 4)
"""Periods (s) of the table."""
DAMPING: Final = 0.05


def spectra_table(
    motions: Sequence[Any], target: TargetSpectrum | None, pairs: str = "srss", *, threads: int | None = None
) -> pl.DataFrame:
    """Return the period (s) and, in m/s2, the target and the mean, p16, median and p84 of the pseudo-acceleration of
    scaled motions, 5 % damped; `pairs` names what stands for a pair. The target is null outside its range.
    """
    spectra = spectra_of(list(motions), PERIODS, DAMPING, pairs, threads=threads)
    wanted = np.full(len(PERIODS), np.nan)
    if target is not None:
        covered = (target.shortest <= PERIODS) & (target.longest >= PERIODS)
        wanted[covered] = target(PERIODS[covered])
    columns = {"period": PERIODS, "target": wanted, "mean": spectra.mean(axis=0)}
    columns |= {name: quantile(spectra.T, share) for name, share in QUANTILES.items()}
    return pl.DataFrame(columns).with_columns(pl.col("target").fill_nan(None))


SUPPORT: Final = ("on_racks", "stops")
"""Keys of how goods stand: tables, or false where a default does not hold."""


def rack_of(tables: tuple[Table, ...]) -> GoodsRack | None:
    """Return the racks under goods, by the first of `tables` that has racks; None where goods stand on the floor."""
    table = _described(tables, "on_racks")
    if table is None:
        return None
    table.needed("direction", "period_s")
    table.one_of("direction", "period_s")
    if "period_s" in table.values:
        period, how = number(table, "period_s"), "as stated"
    else:
        try:
            row = rack_direction(table.text("direction"))
        except SeismassError as error:
            table.refuse_as("direction", error)
        period = row.period
        how = f"{row.name}, usually {row.low:g} to {row.high:g} s; {row.source}, {row.status}"
    return GoodsRack(
        period,
        how,
        table.count("levels", least=1) if "levels" in table.values else int(number(table, "levels")),
        number(table, "frame"),
        number(table, "damping"),
        optional(table, "yield_shear_over_weight"),
    )


def stops_of(tables: tuple[Table, ...]) -> GoodsStops | None:
    """Return the stops beside goods; None where there are none. The first of `tables` that describes stops counts."""
    table = _described(tables, "stops")
    if table is None:
        return None
    table.needed("clearance_m")
    stiffness = optional(table, "stiffness_kn_per_m")
    return GoodsStops(number(table, "clearance_m"), None if stiffness is None else 1e3 * stiffness)


def _described(tables: tuple[Table, ...], key: str) -> Table | None:
    """The table of a key, by the first of `tables` that has it; None where it is false or nowhere."""
    place = held(tables, (key,))
    if place is None:
        return None
    table, _ = place
    if table.values[key] is False:
        return None
    if not isinstance(table.values[key], dict):
        table.refuse(key, f"a table with {' or '.join(list(KEYS[key])[:2])}, or false", str(table.values[key]))
    inner = table.table(key)
    known(inner)
    return inner


LIVE_LOAD, FRICTION, PRESENT = keys_of("live_load"), keys_of("friction"), keys_of("present")
"""Keys of the design live load of a floor, of its friction, and of how much of it is present."""
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
    value = number(table, key)
    if key == "live_load_kg" or value == 0.0:
        return value
    return 1e3 * value * needed(storey, building, "area_m2") / STANDARD_GRAVITY


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
    shares = [number(table, "share") for table in tables]
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
    return BlockSize(*(number(place[0], key) for key in SIZE[:2])), stated_model


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
        return number(table, key), "of the design live load, as stated", ""
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
    static = number(table, key)
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


_BY_THEMSELVES: Final = ("flexural_rigidity_kn_m2", "period_s", "stiffness_matrix_kn_per_m")
"""Keys of walls that do not follow the stiffness of the storeys."""


class Walls(NamedTuple):
    """Walls beside the storeys: storey stiffnesses (N/m, scaled where the period stated is that of both together),
    stiffness matrix of the walls over the floors (N/m), and `how` they are stated.
    """

    stiffness: FloatArray
    matrix: FloatArray
    how: str


def walls_of(
    walls: Table, building: Table, mass: FloatArray, stiffness: FloatArray, heights: Any, period: float | None
) -> Walls:
    """Return the walls of a file. `mass` is that of the floors without goods (kg); where `period` (s) is stated for the
    building, `stiffness` (N/m) gives it without walls.
    """
    walls.needed(*KEYS["walls"])
    walls.one_of(*KEYS["walls"])
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
    value = number(walls, key)
    if key == "period_s":
        return Wall.of_period(mass, heights, value).stiffness_matrix, f"flexural cantilever, alone {value:g} s"
    if key == "alpha_h":
        return Wall.of_alpha_h(frame, value).stiffness_matrix, f"flexural cantilever, alpha H = {value:g}"
    share = f"flexural cantilever with {value:g} of the base shear in the first mode"
    return Wall.of_base_shear_share(frame, value).stiffness_matrix, share


PERIOD: Final = ("period_s", "system", "period_code", "period_mass")
DESIGN: Final = ("design", "R", "design_fraction", "combination")
STIFFNESS, STRENGTH = spelled(keys_of("stiffness")[:2]), spelled(keys_of("strength"))
_REPLACED: Final = ((*PERIOD, *STIFFNESS), STRENGTH)
"""Groups of keys of which one in y replaces all in x."""


def tables_in_y(tables: Mapping[str, Any], file: str) -> Table:
    """Return the tables of the building in y, made from `other_direction` of a file; `tables` stays as it is."""
    whole = copy.deepcopy(dict(tables))
    other = Table(whole, "", file, InvalidBuildingFile).table("other_direction")
    del whole["other_direction"]
    known(other, None)
    in_y = Table(whole, "", f"{file}, other_direction", InvalidBuildingFile)
    storeys = other.tables("storeys") if "storeys" in other.values else []
    for key, read in (("building", in_y.table), ("storeys", in_y.tables)):
        if key in whole:
            read(key)  # what is not a table is refused before it is changed
    of_building, storey_tables = whole.setdefault("building", {}), whole.get("storeys", [])
    if storeys and len(storeys) != len(storey_tables):
        other.refuse("storeys", f"as many tables as the building has storeys, {len(storey_tables)}", str(len(storeys)))
    _merge([of_building, *storey_tables], {key: value for key, value in other.values.items() if key != "storeys"})
    for storey, of_storey in zip(storeys, storey_tables, strict=False):
        known(storey, None)
        _merge([of_storey], storey.values)
        # What y itself states beside it stays, and is refused.
        for group, replaced in ((STIFFNESS, (*PERIOD, *STIFFNESS)), (STRENGTH, (*STRENGTH, *DESIGN))):
            if any(key in storey.values for key in group):
                _drop(of_building, tuple(key for key in replaced if key not in other.values))
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


def base_of(table: Table) -> SlidingBase:
    """Return the sliding base of a building file from its table `base`."""
    table.needed("mu", "mu_s")
    table.excluded("mu", "mu_s", "mu_k")
    table.one_of("mass_kg", "mass_ratio")
    friction = {key: number(table, key) for key in ("mu", "mu_s", "mu_k") if key in table.values}
    others = {"radius_m": "radius", "mass_kg": "mass", "mass_ratio": "mass_ratio"}
    values: dict[str, Any] = {name: number(table, key) for key, name in others.items() if key in table.values}
    static = friction.get("mu_s", friction.get("mu"))
    if "mu_k" in friction and static is not None and friction["mu_k"] > static:
        table.refuse("mu_k", f"at most {table.key('mu_s')}", f"{friction['mu_k']:g}")
    return SlidingBase(**friction, **values)
