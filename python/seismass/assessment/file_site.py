"""Site, period and drift limit of a building file: as stated, or by a code with its numbers."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
import polars as pl

from seismass.assessment.building import limit_at_level
from seismass.assessment.floors import FloorCode
from seismass.base.errors import InvalidOption
from seismass.base.input_table import POSITIVE, SHARE, Table
from seismass.base.statistics import QUANTILES, quantile
from seismass.base.values import FloatArray, brief
from seismass.design import (
    DRIFT_LIMIT_CODES,
    PERIOD_CODES,
    DriftLimit,
    PeriodRule,
    code_period,
    drift_limit,
    drift_limit_table,
    period_table,
)
from seismass.design.rules import CATEGORIES
from seismass.design.scaling.asce7 import spectra_of
from seismass.design.scaling.by_code import SCALING_CODES
from seismass.model.codes import AS_STATED, CodeFraction, code_fraction
from seismass.model.plausibility import PERIOD_RANGE
from seismass.motions.scaling.suite import target_of
from seismass.motions.spectra import DEFAULT_TL, TargetSpectrum
from seismass.motions.spectra.tables import file_and_words

SITE: Final = ("sds_g", "sd1_g", "tl_s", "s1_g", "spectrum_csv", "target")
"""Keys of the site."""
PERIOD: Final = ("period_s", "system", "period_code", "period_mass")
"""Keys of the first period."""
LIMIT: Final = ("drift_limit", "risk_category", "drift_class", "drift_limit_code")
"""Keys of the limit of the drift ratio."""
PERIOD_MASSES: Final = ("bare", "code share", "all")
"""What a period is the period of: the building without goods, with the code's share of them, or with all present."""


def site_of(site: Table, folder: Path) -> TargetSpectrum | None:
    """Return the site spectrum; None where the file has none."""
    if not site.values:
        return None
    for whole in ("target", "spectrum_csv"):
        for key in SITE:
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
    short, one = (site.number(key, need=POSITIVE) for key in ("sds_g", "sd1_g"))
    tl = site.number("tl_s", DEFAULT_TL, POSITIVE)
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
        value = building.number("period_s", need=POSITIVE) if "period_s" in building.values else None
        return StatedPeriod(value, _mass(building, "bare"), None)
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
        return building.number("drift_limit", need=POSITIVE), None
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
        value = table.number("fraction", need=SHARE)
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
        fraction = storey.number("fraction", need=SHARE) if "fraction" in storey.values else np.nan
        for kind in storey.tables("goods"):
            _use(kind, code)
        codes.append(FloorCode(fraction, _use(storey, code) or of_all, exempt))
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
