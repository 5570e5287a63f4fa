"""A user's building as an assessment takes it: structure, goods, site, code and limits, in SI units.

It makes the models that are compared: goods that slide, and a share of them attached as mass.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from datetime import date, datetime
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from seismass.assessment.file_keys import KEYS
from seismass.assessment.floors import CountedFraction, FloorCode, FloorGoods, by_floor, counted_fractions
from seismass.base.errors import InvalidOption
from seismass.base.input_table import Table
from seismass.base.units import STANDARD_GRAVITY, UNITS, Units
from seismass.base.values import FieldValue, FloatArray, brief, printable, refusal
from seismass.base.views import Card
from seismass.design import (
    DRIFT_LIMIT_CODES,
    THETA_CAP,
    CodeDesign,
    Combination,
    DriftLimit,
    Modes,
    PeriodRule,
    SpectrumAnalysis,
    design_by_code,
    drift_limit,
    response_spectrum_analysis,
    vibration_modes,
)
from seismass.design.rules import RULES, CodeRule, rule_of
from seismass.design.scaling.by_code import SCALING_CODES
from seismass.model.block import Block, SlidingBase
from seismass.model.building import DEFAULT_DAMPING, Building
from seismass.model.codes import CodeFraction
from seismass.model.scene import Scene
from seismass.model.tipping import Tipping
from seismass.motions.spectra import TargetSpectrum
from seismass.motions.spectra.target import target_of_parameters


@dataclass(frozen=True)
class Project:
    """Head of a calculation page; texts are empty where the file does not state them.

    Attributes
    ----------
    name, number, client, revision, author, checker : str
        Project, its number, for whom it is, revision of the calculation, who made it and who checked it.
    date : str
        Date of the calculation, as 2026-11-25.
    """

    name: str = ""
    number: str = ""
    client: str = ""
    revision: str = ""
    author: str = ""
    checker: str = ""
    date: str = ""


NO_PROJECT: Final = Project()
"""The project of a file that states none."""


def project_of(table: Table) -> Project:
    """Return what a table [project] says."""
    return Project(
        **{key: printable(table.text(key)) for key in KEYS["project"] if key != "date"},
        date=_date(table),
    )


def _date(table: Table) -> str:
    """A date of TOML, or a text that is one."""
    value = table.values.get("date", "")
    if isinstance(value, date) and not isinstance(value, datetime):
        return value.isoformat()
    if value == "":
        return ""
    try:
        return date.fromisoformat(value).isoformat()
    except (TypeError, ValueError):
        table.refuse("date", "a date, such as 2026-11-25", brief(value))


DEFAULT_THETA_LIMIT: Final = THETA_CAP
"""Largest stability coefficient of ASCE/SEI 7-10, 12.8.7: 0.5/(beta C_d), at most 0.25."""


RULE_CODES: Final = tuple(dict.fromkeys(rule.code_id for rule in RULES))
"""Codes of which some rule of design is known here."""
DEFAULT_RULES: Final = "asce7-10"
"""Code whose rules hold where those of the file's code are not known here."""


@dataclass(frozen=True)
class DesignRule:
    """How strengths are found where they are not stated: by the rules of the code, with response spectrum analysis.

    Attributes
    ----------
    R : float
        The code's reduction of forces, at least 1: R, q in Eurocode 8, R_d R_o in NBC, mu in NZS 1170.5.
    fraction : float or None
        Fraction of the design live load in the mass of the design; None: that of the code.
    combination : {"srss", "cqc"}
        Modal combination.
    """

    R: float
    fraction: float | None
    combination: Combination = "srss"


@dataclass(frozen=True, eq=False, repr=False)
class OwnBuilding(FieldValue, Card):
    """A building with its goods, as a building file describes it; see `read_building`.

    Attributes
    ----------
    name, note : str
        Free text.
    storey_names : tuple of str
        A name per floor, or empty texts.
    mass : ndarray, shape (storeys,)
        Floor masses without loose goods (kg), with those that are bolted.
    stiffness : ndarray, shape (storeys,)
        Initial storey stiffnesses (N/m).
    stated_period : float or None
        First period (s) from which they were found; None where they were stated.
    period_mass : {"bare", "code share", "all"}
        Which goods acted as mass in that period: none, the code's share, or all present.
    period_rule : PeriodRule or None
        Row of the code whose formula gave that period; None where it was stated.
    heights : ndarray, shape (storeys,), or None
        Storey heights (m); None where they are not known: then drifts are in metres and there is no limit.
    yield_shear : ndarray, shape (storeys,), or None
        First yield shears (N); None where `design` finds them.
    design : DesignRule or None
        How strengths are found where they are not stated.
    overstrength, second_slope, third_slope : ndarray, shape (storeys,)
        Omega, r2 and r3 of the storeys.
    damping : float
        Ratio of critical damping in every mode of the building without goods.
    damping_from_storey : int
        Lowest storey that is damped; above 1 the modes are those of the building above the floor below it.
    gravity_load : ndarray, shape (storeys,), or None
        Gravity load of each floor without loose goods (N), to which their weight is added; None: no P-Delta.
    area : ndarray, shape (storeys,)
        Floor areas (m2); NaN where they are not stated.
    dead_load_stated : ndarray of bool, shape (storeys,)
        Whether the mass of a floor was stated as a dead load per area.
    kinds : tuple of FloorGoods
        Goods of each kind on each floor, floor by floor; a floor has one kind at least.
    mu_factors : tuple of float
        Factors of friction for its lower and upper bound.
    target : TargetSpectrum or None
        Site spectrum; None where the file has none.
    code : CodeFraction
        The code, and the fraction of the design live load that it counts as mass where a floor states none.
    floor_codes : tuple of FloorCode
        What the file says of each floor for the code.
    code_stated : bool
        Whether the file names the code.
    drift_limit, theta_limit : float
        Limits of drift ratio and stability coefficient.
    drift_limit_rule : DriftLimit or None
        Row of the code that gave the limit of the drift ratio; None where it was stated, or is the default.
    collapse_drift_ratio : float or None
        Drift ratio at which a storey counts as collapsed; None: only where P-Delta says so.
    drift_cap : float
        Drift ratio above which a drift counts as it in capped means; no run ends there. Infinite without heights.
    scaling_period : float or None
        Period (s) for which motions are scaled; None: first period of the building with its goods attached.
    path : Path or None
        The file.
    file_sha256 : str
        Its digest; empty without a file.
    units : {"si", "us"}
        Units in which results are shown: those of the file.
    project : Project
        What the head of the page says.
    sources : tuple of (str, str)
        Each quantity with the keys that state it; see `seismass.assessment.building_file`.
    walls : ndarray, shape (storeys, storeys), or None
        Stiffness of elastic walls over the floors (N/m), beside the storeys; None without.
    walls_stated : str
        How they are stated, in words.
    base : SlidingBase or None
        What the building slides on; None on firm ground.
    other : OwnBuilding or None
        The building in y, where there are two directions: with the same masses, goods and limits.
    risk_category : {"I", "II", "III", "IV"}
        Risk category, importance class or level, by which the code's importance factor and limits are taken.
    category_stated : bool
        Whether the file states it.
    system : str
        Structural system, whose approximate period limits the period of the design; empty where none is stated.
    s_1 : float or None
        Mapped spectral acceleration at 1 s (g), for the least base shear of ASCE 7 near faults.
    scaling : str
        Rule of scaling that the file states; empty: that of the code.
    """

    name: str
    note: str
    storey_names: tuple[str, ...]
    mass: FloatArray
    stiffness: FloatArray
    stated_period: float | None
    period_mass: str
    period_rule: PeriodRule | None
    heights: FloatArray | None
    yield_shear: FloatArray | None
    design: DesignRule | None
    overstrength: FloatArray
    second_slope: FloatArray
    third_slope: FloatArray
    damping: float
    damping_from_storey: int
    gravity_load: FloatArray | None
    area: FloatArray
    dead_load_stated: NDArray[np.bool_]
    kinds: tuple[FloorGoods, ...]
    mu_factors: tuple[float, float]
    target: TargetSpectrum | None
    code: CodeFraction
    floor_codes: tuple[FloorCode, ...]
    code_stated: bool
    drift_limit: float
    drift_limit_rule: DriftLimit | None
    theta_limit: float
    collapse_drift_ratio: float | None
    drift_cap: float
    scaling_period: float | None
    path: Path | None = None
    file_sha256: str = ""
    units: str = "si"
    project: Project = NO_PROJECT
    sources: tuple[tuple[str, str], ...] = ()
    walls: FloatArray | None = None
    walls_stated: str = ""
    base: SlidingBase | None = None
    other: OwnBuilding | None = None
    risk_category: str = "II"
    category_stated: bool = False
    system: str = ""
    s_1: float | None = None
    scaling: str = ""

    @property
    def shown(self) -> Units:
        """The units in which results are shown."""
        return UNITS[self.units]

    @property
    def storeys(self) -> int:
        """Number of storeys."""
        return len(self.mass)

    @property
    def weight(self) -> float:
        """Weight of the building without loose goods (N)."""
        return STANDARD_GRAVITY * float(self.mass.sum())

    @property
    def loose(self) -> tuple[FloorGoods, ...]:
        """The kinds of goods that are not bolted."""
        return tuple(kind for kind in self.kinds if not kind.attached)

    @property
    def present(self) -> tuple[FloorGoods, ...]:
        """The kinds of loose goods of which some are present."""
        return tuple(kind for kind in self.loose if kind.mass > 0.0)

    def with_kinds(self, kinds: tuple[FloorGoods, ...]) -> OwnBuilding:
        """Return the building with other goods, in both directions."""
        other = None if self.other is None else replace(self.other, kinds=kinds)
        return replace(self, kinds=kinds, other=other)

    def with_tipping(self, model: Tipping) -> OwnBuilding:
        """Return the building in which one model stands for all goods that tip; with "slide" all goods slide."""
        return self.with_kinds(tuple(replace(kind, tipping=model) for kind in self.kinds))

    def sliding(self, mu_factor: float = 1.0) -> tuple[tuple[int, int], ...]:
        """Index in `loose` and level of the rack (0: on the floor) of each block of `scene`, in their order."""
        numbered = enumerate(self.loose)
        there = [(number, kind) for number, kind in numbered if kind.mass > 0.0 and kind.staying(mu_factor) < 1.0]
        on_floors = [(number, 0) for number, kind in there if kind.rack is None]
        levels = [(number, kind.rack.levels) for number, kind in there if kind.rack is not None]
        return (*on_floors, *((number, level) for number, count in levels for level in range(1, count + 1)))

    @property
    def bolted(self) -> FloatArray:
        """Mass of the bolted goods on each floor (kg), which `mass` contains; shape (storeys,)."""
        bolted = tuple(kind for kind in self.kinds if kind.attached)
        return by_floor(bolted, [kind.mass for kind in bolted], self.storeys)

    @property
    def live_load(self) -> FloatArray:
        """Design live load of the loose goods on each floor as a mass (kg), shape (storeys,)."""
        return by_floor(self.loose, [kind.live_load for kind in self.loose], self.storeys)

    @property
    def goods_mass(self) -> FloatArray:
        """Mass of the loose goods present on each floor (kg), shape (storeys,)."""
        return by_floor(self.loose, [kind.mass for kind in self.loose], self.storeys)

    @property
    def frames(self) -> FloatArray:
        """Mass of the frames of racks on each floor (kg), in every model; shape (storeys,)."""
        frames = [0.0 if kind.rack is None else kind.rack.frame * kind.mass for kind in self.loose]
        return by_floor(self.loose, frames, self.storeys)

    @property
    def present_share(self) -> float:
        """Goods present over the design live load, of the whole building; 0 where there is no live load."""
        total = float(self.live_load.sum())
        return float(self.goods_mass.sum()) / total if total > 0.0 else 0.0

    @property
    def uses(self) -> str:
        """Uses of the goods in words, with their floors where there are several."""
        floors: dict[str, list[int]] = {}
        for kind in self.loose:
            if kind.live_load > 0.0:
                floors.setdefault(kind.use or self.code.use, []).append(kind.floor)
        if len(floors) < 2:
            return next(iter(floors), self.code.use)
        listed = {use: ", ".join(map(str, dict.fromkeys(numbers))) for use, numbers in floors.items()}
        return " and ".join(f"{use} (floor {numbers})" for use, numbers in listed.items())

    @property
    def code_mass(self) -> FloatArray:
        """What the code counts of the live load on each floor (kg), shape (storeys,)."""
        return self.live_load * np.array([one.fraction for one in self.counted], dtype=np.float64)

    @property
    def counted(self) -> tuple[CountedFraction, ...]:
        """Fraction of the design live load of each floor that the code counts, with its exceptions."""
        return counted_fractions(self.code, self.floor_codes, self.mass, self.kinds, self.area)

    @property
    def code_share(self) -> float:
        """What the code counts over the design live load of the whole building; that of the code without live load."""
        total = float(self.live_load.sum())
        uniform = all(one.fraction == self.code.fraction for one in self.counted)
        return self.code.fraction if uniform or total == 0.0 else float(self.code_mass.sum()) / total

    @property
    def present_code_share(self) -> float:
        """What the code counts over the goods present, at most 1; 0 where there are none."""
        return min(1.0, self.code_share / self.present_share) if self.present_share > 0.0 else 0.0

    @property
    def design_mass(self) -> FloatArray:
        """Mass of the live load in the design (kg): the fraction that is stated, else what the code counts."""
        stated = None if self.design is None else self.design.fraction
        return self.code_mass if stated is None else stated * self.live_load

    @property
    def design_fraction(self) -> float:
        """Mass of the live load in the design over the design live load of the whole building."""
        stated = None if self.design is None else self.design.fraction
        return self.code_share if stated is None else stated

    def modes(self, attached: FloatArray | float = 0.0) -> Modes:
        """Return the vibration modes with a mass attached to each floor (kg)."""
        mass = self.mass + self.frames + attached
        return vibration_modes(mass, self.stiffness, stiffness_matrix=self.walls)

    def period(self, attached: FloatArray | float = 0.0) -> float:
        """Return the first period (s) with a mass attached to each floor (kg)."""
        return float(self.modes(attached).periods[0])

    @property
    def rules_code(self) -> str:
        """The code whose rules of design hold: that of the file, or ASCE 7-10 where none of its rules are known."""
        return self.code.code_id if self.code.code_id in RULE_CODES else DEFAULT_RULES

    @property
    def scaling_code(self) -> str:
        """The rule by which motions are scaled: that of the file, else that of the code, else that of ASCE 7-10."""
        if self.scaling:
            return self.scaling
        return self.rules_code if self.rules_code in SCALING_CODES else DEFAULT_RULES

    @property
    def pairs_as(self) -> str:
        """What stands for a pair of motions in that rule: "srss", "maximum direction", ..."""
        rule = rule_of(self.scaling_code, "pairs")
        return "geometric mean" if rule is None or rule.value == "principal" else rule.value

    def motion_target(self, target: TargetSpectrum | None = None) -> TargetSpectrum:
        """Return the spectrum of the level that motions are scaled to: in ASCE 7-16 and 7-22 MCE_R."""
        level = rule_of(self.scaling_code, "level")
        spectrum = self.site_spectrum(target)
        return spectrum if level is None or level.number == 1.0 else spectrum.times(level.number)

    def analysis(self, target: TargetSpectrum | None = None, attached: FloatArray | None = None) -> SpectrumAnalysis:
        """Return the response spectrum analysis of the building with the mass of its design.

        Parameters
        ----------
        target : TargetSpectrum, optional
            Site spectrum; default the building's own.
        attached : ndarray, shape (storeys,), optional
            Mass of the design beside that of the floors (kg); default the fraction of the design live load.

        Raises
        ------
        InvalidOption
            There is no site spectrum, or it does not cover the modal periods.
        """
        design, options = self._of_design(target, attached)
        return response_spectrum_analysis(*design, **options)

    def _of_design(
        self, target: TargetSpectrum | None, attached: FloatArray | None
    ) -> tuple[tuple[FloatArray, FloatArray, TargetSpectrum], dict[str, Any]]:
        """Masses, stiffnesses and spectrum of a design, and the options of its modal analysis."""
        mass = self.mass + self.frames + (self.design_mass if attached is None else attached)
        options: dict[str, Any] = {
            "stiffness_matrix": self.walls,
            "combination": "srss" if self.design is None else self.design.combination,
            "damping": self.damping or DEFAULT_DAMPING,
        }
        return (mass, self.stiffness, self.site_spectrum(target)), options

    def code_design(self, target: TargetSpectrum | None = None, attached: FloatArray | None = None) -> CodeDesign:
        """Return the design of the strengths by the code.

        Parameters
        ----------
        target, attached
            As for `analysis`.

        Raises
        ------
        InvalidOption
            As for `analysis`, or the strengths are stated and not designed.
        """
        if self.design is None:
            requirement = "designed (building.design = true); they are as stated"
            raise refusal(InvalidOption, "strengths", f"building {self.name}", requirement, "no design")
        design, options = self._of_design(target, attached)
        return design_by_code(
            *design,
            self.design.R,
            code_id=self.rules_code,
            risk_category=self.risk_category,
            system=self.system,
            height=None if self.heights is None else float(self.heights.sum()),
            s_1=self.s_1,
            **options,
        )

    def site_spectrum(self, target: TargetSpectrum | None = None) -> TargetSpectrum:
        """Return the spectrum given, or else the building's own; a missing one is refused. The importance factor of
        Eurocode 8 and the return period factor of NZS 1170.5 are those of the category where the spectrum has none.
        """
        spectrum = self.target if target is None else target
        rule = rule_of(self.rules_code, "importance", "spectrum")
        if self.category_stated and rule is not None and isinstance(spectrum, TargetSpectrum):
            spectrum = with_importance(spectrum, rule.of(self.risk_category))
        if not isinstance(spectrum, TargetSpectrum):
            requirement = (
                "given: [site] in the file (sds_g and sd1_g, target or spectrum_csv), --target, or an argument"
            )
            raise refusal(InvalidOption, "target", f"building {self.name}", requirement, brief(spectrum))
        return spectrum

    def structure(self, target: TargetSpectrum | None = None, attached: FloatArray | None = None) -> Building:
        """Return the building without goods; strengths of a design need the site spectrum.

        Parameters
        ----------
        target, attached
            As for `analysis`.

        Raises
        ------
        InvalidOption
            As for `analysis`.
        InvalidScene
            P/h reaches a stiffness, or slopes contradict each other.
        """
        strength = self.yield_shear
        if strength is None and self.design is not None:
            strength = self.code_design(target, attached).yield_shear
        return Building(
            self.mass,
            self.stiffness,
            yield_shear=np.inf if strength is None else strength,
            overstrength=self.overstrength,
            second_slope=self.second_slope,
            third_slope=self.third_slope,
            damping=self.damping if self.damping_from_storey == 1 else self._damping_above(),
            heights=self.heights,
            gravity_load=self.gravity_load,
            stiffness_matrix=self.walls,
        )

    def _damping_above(self) -> FloatArray:
        """Damping matrix in the modes of the building above the floor on which the lowest damped storey stands."""
        below = self.damping_from_storey - 1
        above = Building(
            self.mass[below:], self.stiffness[below:], yield_shear=np.inf, damping=self.damping
        ).damping_matrix
        # Displacements of the floors above relative to that floor.
        relative = np.zeros((self.storeys - below, self.storeys))
        relative[:, below:] = np.eye(self.storeys - below)
        relative[:, below - 1] = -1.0
        matrix: FloatArray = relative.T @ above @ relative
        return matrix

    def scene(self, target: TargetSpectrum | None = None, *, mu_factor: float = 1.0) -> Scene:
        """Return the building with its goods, one block per kind of loose goods on a floor.

        Parameters
        ----------
        target : TargetSpectrum, optional
            Site spectrum for strengths of a design; default the building's own.
        mu_factor : float, default 1.0
            Factor of all friction coefficients. Goods that tip first with it have the model of `FloorGoods.model`.

        Raises
        ------
        InvalidOption, InvalidScene
            As for `structure`.
        """
        blocks, racks, fixed = [], [], np.zeros(self.storeys)
        for kind in self.present:
            (mu_s, mu_k), staying = kind.contact_at(mu_factor), kind.staying(mu_factor)
            if kind.rack is not None:
                racks.append(kind.rack.under(kind.floor, kind.mass, (mu_s, mu_k), kind.stops, staying))
                continue
            fixed[kind.floor - 1] += staying * kind.mass
            sliding = (1.0 - staying) * kind.mass
            stops = None if kind.stops is None else kind.stops.beside(sliding)
            if sliding > 0.0:
                blocks.append(Block(kind.floor, mass=sliding, mu_s=mu_s, mu_k=mu_k, stops=stops))
        collapse = (
            None
            if self.heights is None or self.collapse_drift_ratio is None
            else (self.collapse_drift_ratio * self.heights)
        )
        return Scene(
            self.structure(target),
            blocks,
            racks=racks,
            base=self.base,
            fixed_goods=fixed,
            other_direction=False if self.other is None else self.other.structure(target),
            collapse_drift=collapse,
            name=self.name,
            note=self.note,
        )


def level_factor(code_id: str, scaling: str) -> CodeRule | None:
    """Return the rule of a code by which its drift limit grows with the level of a rule of scaling: at MCE_R."""
    level = rule_of(scaling, "level")
    return None if level is None or level.number == 1.0 else rule_of(code_id, "drift factor")


def limit_at_level(row: DriftLimit, scaling: str) -> float:
    """Return the limit of the drift ratio of a code at the level of a rule of scaling: of ASCE 7 twice it at MCE_R."""
    factor = level_factor(row.code_id, scaling)
    return row.ratio if factor is None else factor.number * row.ratio


def with_code(building: OwnBuilding, code: CodeFraction) -> OwnBuilding:
    """Return the building under another code: its fraction, and its rules and limits where the file states none."""
    changed = replace(building, code=code, code_stated=True)
    row = building.drift_limit_rule
    if row is not None:
        structure = row.structure if code.code_id == row.code_id else "other"
        known = code.code_id in DRIFT_LIMIT_CODES
        row = drift_limit(code.code_id if known else DEFAULT_RULES, building.risk_category, structure)
        changed = replace(changed, drift_limit=limit_at_level(row, changed.scaling_code), drift_limit_rule=row)
    other = None if building.other is None else with_code(building.other, code)
    return replace(changed, other=other)


def with_importance(target: TargetSpectrum, factor: float) -> TargetSpectrum:
    """Return a spectrum of Eurocode 8 or NZS 1170.5 with an importance or return period factor where it has none."""
    known = target.parameters
    name = {"eurocode8": "importance", "nzs1170": "r"}.get(known["shape"], "")
    return target_of_parameters(known | {name: factor}) if name and known[name] == 1.0 != factor else target
