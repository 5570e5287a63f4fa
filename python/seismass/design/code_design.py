"""The strengths that a code asks for: weight, period, base shear, and storey shears of modes or of lateral forces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FieldValue, FloatArray, as_one_of, as_positive, frozen, refusal
from seismass.base.views import Card
from seismass.design.lateral_force import (
    PERIOD_CODES,
    DistributionRule,
    code_period,
    equivalent_lateral_forces,
    seismic_response_coefficient,
)
from seismass.design.modes import Combination, SpectrumAnalysis, positive, response_spectrum_analysis
from seismass.design.rules import APPLIED, CodeRule, known_category, rule_of
from seismass.model.codes import CODE_NAMES
from seismass.motions.scaling.suite import as_target
from seismass.motions.spectra import TargetSpectrum

Procedure: TypeAlias = Literal["modal", "lateral-force"]
"""How storey shears follow from a base shear."""
LONGEST_PERIOD: Final = 10.0
"""Period (s) up to which the largest ordinate of a spectrum without S_DS is looked for."""
LEAST_PERIOD_NZS: Final = 0.4
"""Least T_1 (s) of the equivalent static method: NZS 1170.5, 5.2.1.1 (second-hand)."""
LAMBDA_STOREYS: Final = 2
"""Eurocode 8, 4.3.3.2.2(1): lambda is below 1 for buildings with more storeys than so many (from memory)."""


@dataclass(frozen=True)
class DesignEntry:
    """A quantity of a design with its clause.

    Attributes
    ----------
    quantity : str
        Its symbol: "W", "T", "I", "C_s", "V", "V_t", "V_y", ...
    storey : int or None
        Storey, from 1; None for the whole building.
    value : float
        In the unit of `unit`.
    unit : str
        N, s, or empty.
    clause, status : str
        Where the code says so, and how that was checked; empty for what is computed or stated.
    note : str
        What it is, and its conditions.
    """

    quantity: str
    storey: int | None
    value: float
    unit: str
    clause: str = ""
    status: str = ""
    note: str = ""


@dataclass(frozen=True, eq=False, repr=False)
class CodeDesign(FieldValue, Card):
    """Strengths of a building by its code.

    Attributes
    ----------
    code_id : str
        The code.
    weight : float
        W (N), the weight of the design.
    period : float
        T (s), by which C_s was found.
    coefficient : float or None
        C_s; None where the code's is not known here, or R is not stated.
    base_shear : float or None
        V = C_s W (N).
    modal_shear : float or None
        Base shear of the modes (N), reduced by R and with I, before it was scaled; None by lateral forces.
    scale : float
        What the modal shears were scaled up by to reach the share of V that the code asks for.
    yield_shear : ndarray, shape (storeys,)
        V_y of each storey (N).
    entries : tuple of DesignEntry
        All quantities with their clauses.
    not_applied : tuple of str
        Rules of the code that are not applied, as sentences.
    """

    code_id: str
    weight: float
    period: float
    coefficient: float | None
    base_shear: float | None
    modal_shear: float | None
    scale: float
    yield_shear: FloatArray
    entries: tuple[DesignEntry, ...]
    not_applied: tuple[str, ...]

    def table(self) -> pl.DataFrame:
        """Return one row per quantity.

        Returns
        -------
        polars.DataFrame
            Columns as `DesignEntry` has them.
        """
        schema = {"quantity": pl.String, "storey": pl.UInt32, "value": pl.Float64}
        rows = [vars(entry) for entry in self.entries]
        return pl.DataFrame(rows, schema=schema | dict.fromkeys(("unit", "clause", "status", "note"), pl.String))


class _Design:
    """A design while it is made: its weight (N), period (s) and C_s, entries and omissions."""

    def __init__(self, code_id: str, weight: float) -> None:
        self.code_id, self.weight = code_id, weight
        self.period = 0.0
        self.coefficient: float | None = None
        self.entries: list[DesignEntry] = []
        self.missing: list[str] = []

    def add(self, quantity: str, value: float, unit: str = "", rule: CodeRule | None = None, note: str = "") -> None:
        """Add a quantity of the whole building, with the clause of a rule."""
        clause, status = ("", "") if rule is None else (rule.clause, rule.status)
        words = "; ".join(part for part in (note, "" if rule is None else rule.note) if part)
        self.entries.append(DesignEntry(quantity, None, float(value), unit, clause, status, words))

    def lacks(self, sentence: str) -> None:
        """Add what is not applied."""
        self.missing.append(f"{CODE_NAMES.get(self.code_id, 'the code')}: {sentence}")

    def with_strengths(
        self,
        strength: FloatArray,
        rule: CodeRule | DistributionRule | None,
        base_shear: float | None,
        modal_shear: float | None = None,
        scale: float = 1.0,
    ) -> CodeDesign:
        """Return the design with the first yields V_y (N) that a rule gives."""
        clause, status = ("", "") if rule is None else (rule.clause, rule.status)
        for number, value in enumerate(strength, start=1):
            self.entries.append(DesignEntry("V_y", number, float(value), "N", clause, status, "first yield"))
        if modal_shear is not None and base_shear is not None:
            self.add("V_y/(C_s W)", float(strength[0]) / base_shear, note="storey 1")
        known = (self.code_id, self.weight, self.period, self.coefficient, base_shear, modal_shear, scale)
        return CodeDesign(*known, frozen(strength), tuple(self.entries), tuple(self.missing))


def design_by_code(
    mass: FloatArray,
    stiffness: FloatArray,
    target: TargetSpectrum | str,
    reduction: float,
    *,
    code_id: str = "asce7-10",
    risk_category: str = "II",
    system: str = "",
    height: float | None = None,
    s_1: float | None = None,
    stiffness_matrix: FloatArray | None = None,
    combination: Combination = "srss",
    damping: float = 0.05,
    procedure: Procedure = "modal",
    heights: ArrayLike | None = None,
) -> CodeDesign:
    """Return the strengths that a code asks for: storey shears of modes by R and I, scaled to the code's base shear, or
    those of equivalent lateral forces.

    Parameters
    ----------
    mass, stiffness : ndarray, shape (storeys,)
        Floor masses of the design (kg) and storey stiffnesses (N/m), storey 1 first.
    target : TargetSpectrum or str
        Elastic design spectrum of the site.
    reduction : float
        The code's reduction of forces: R, q in Eurocode 8, R_d R_o in NBC, mu in NZS 1170.5.
    code_id : str, default "asce7-10"
        The code, which names the edition; `rules_table` has its rules.
    risk_category : {"I", "II", "III", "IV"}, default "II"
        Risk category, importance class or level.
    system : str, optional
        Structural system of `period_table`, whose approximate period limits T; empty: no limit.
    height : float, optional
        Height above the base (m), for that.
    s_1 : float, optional
        Mapped spectral acceleration at 1 s (g), for ASCE 7.
    stiffness_matrix, combination, damping
        As for `response_spectrum_analysis`.
    procedure : {"modal", "lateral-force"}, default "modal"
        Modal response spectrum analysis, or equivalent lateral forces of V over height.
    heights : array_like, optional
        Storey heights (m), needed for lateral forces.

    Raises
    ------
    InvalidScene, InvalidOption
        An argument is out of its range, or the code's lateral forces are not known here.

    Notes
    -----
    The first yield of every storey is at its share of the design shear: V_y = V_t,i max(1, share V/V_t). W is that of
    `mass`. Rules that are not known here are named in `not_applied`.

    Examples
    --------
    >>> import numpy as np
    >>> import seismass as sm
    >>> target = sm.TargetSpectrum.asce7(1.0, 0.6)
    >>> found = sm.design.design_by_code(np.full(2, 1e5), np.full(2, 4e7), target, 4.0, code_id="asce7-16")
    >>> round(float(found.yield_shear[0] / found.base_shear), 12), found.coefficient
    (1.0, 0.25)
    """
    as_word(procedure, get_args(Procedure), "procedure", "design")
    target = as_target(target, "design")
    code_id = as_one_of(code_id, str, "code_id", "design", InvalidOption)
    risk_category = known_category(risk_category)
    as_one_of(system, str, "system", "design", InvalidOption)
    reduction = as_positive(reduction, "reduction", "design", InvalidOption)
    s_1 = None if s_1 is None else as_positive(s_1, "s_1", "design", InvalidOption)
    mass = positive(mass, "mass", or_zero=True)
    made = _Design(code_id, STANDARD_GRAVITY * float(mass.sum()))
    options: dict[str, Any] = {"stiffness_matrix": stiffness_matrix, "combination": combination, "damping": damping}
    elastic = response_spectrum_analysis(mass, stiffness, target, **options)
    calculated = float(elastic.modes.periods[0])
    made.add("W", made.weight, "N", note="weight of the floors with what counts of the live load")
    made.add("T_1", calculated, "s", note="first period with W")
    made.period = period = _limited(made, calculated, target, system, height, len(mass))
    importance, of_spectrum = _importance(made, risk_category)
    form = rule_of(code_id, "coefficient")
    kind = "" if form is None else form.value
    factor = importance / reduction
    if kind == "nzs1170.5":
        factor = _nzs_factor(made, reduction, period, target)
    made.add("R", reduction, note={"ec8": "q", "nzs1170.5": "mu"}.get(kind, "") or "as stated")
    analysis = elastic
    if kind == "ec8":
        spectrum = _ec8_spectrum(made, target, reduction)
        analysis, factor = response_spectrum_analysis(mass, stiffness, spectrum, **options), 1.0
        made.coefficient = _ec8_coefficient(made, spectrum, period, target, len(mass))
    elif kind == "nzs1170.5":
        made.coefficient = _nzs_coefficient(made, target, period, factor)
    elif kind == "asce7":
        made.coefficient = _coefficient(made, target, period, importance, reduction, s_1)
    for rule in APPLIED:
        if rule_of(code_id, rule) is None and (rule, kind) not in (("period limit", "ec8"), ("modal share", "ec8")):
            made.lacks(f"no rule of the {rule} is known here, and none is applied")
    if of_spectrum and importance != 1.0 and target.parameters.get("importance", target.parameters.get("r")) is None:
        made.lacks(f"{importance:g} for category {risk_category} is taken to be in the site spectrum")
    base_shear = None
    if made.coefficient is not None:
        base_shear = made.coefficient * made.weight
        made.add("C_s", made.coefficient, rule=form)
        made.add("V", base_shear, "N", form, "C_s W")
    if procedure == "lateral-force":
        return _by_lateral_forces(made, mass, heights, base_shear)
    return _scaled(made, analysis, factor, base_shear)


def _by_lateral_forces(
    made: _Design, mass: FloatArray, heights: ArrayLike | None, base_shear: float | None
) -> CodeDesign:
    """The design with the storey shears of equivalent lateral forces."""
    if base_shear is None or heights is None:
        missing = "heights" if heights is None else "base shear"
        raise refusal(InvalidOption, missing, "design by lateral forces", "known", "none")
    weights = STANDARD_GRAVITY * mass
    forces = equivalent_lateral_forces(weights, heights, base_shear, made.period, code_id=made.code_id)
    return made.with_strengths(forces.shear, forces.rule, forces.base_shear)


def _scaled(made: _Design, analysis: SpectrumAnalysis, factor: float, base_shear: float | None) -> CodeDesign:
    """The design with its modal shears times a factor and scaled to the base shear."""
    modal = factor * analysis.base_shear
    made.add("V_t", modal, "N", note="base shear of the modes, reduced")
    share, scale = rule_of(made.code_id, "modal share"), 1.0
    if share is not None and base_shear is not None and modal > 0.0:
        scale = max(share.number * base_shear / modal, 1.0)
        note = f"modal shears up to {100.0 * share.number:g} % of V"
        made.add("scale", scale, rule=share, note=note)
    # Without walls the springs carry the storey shear; walls stay elastic.
    strength = scale * factor * analysis.spring_shear
    return made.with_strengths(strength, share, base_shear, modal, scale)


def _limited(
    made: _Design, calculated: float, target: TargetSpectrum, system: str, height: float | None, storeys: int
) -> float:
    """Period of the base shear (s): the calculated one, at most that of the code's limit."""
    rule = rule_of(made.code_id, "period limit")
    if rule is None:
        return calculated
    if not system or height is None or made.code_id not in PERIOD_CODES:
        missing = [name for name, lacks in (("building.system", not system), ("heights", height is None)) if lacks]
        made.lacks(f"the upper limit of T is not applied: state {' and '.join(missing) or 'another code'}")
        return calculated
    try:
        limit = code_period(made.code_id, system, height=height, storeys=storeys, s_d1=_at_1_s(target)).limit
    except InvalidOption:
        made.lacks(f"the upper limit of T is not applied: no approximate period of {system} is known here")
        return calculated
    made.add("T limit", limit, "s", rule)
    made.add("T", min(calculated, limit), "s", rule, "period of C_s")
    return min(calculated, limit)


def _at_1_s(target: TargetSpectrum) -> float:
    """S_D1 (g)."""
    stated = target.parameters.get("sd1_g")
    return float(target(1.0)) / STANDARD_GRAVITY if stated is None else float(stated)


def _importance(made: _Design, category: str) -> tuple[float, bool]:
    """Importance factor, and whether it is of the site spectrum; then that of the design is 1."""
    rule = rule_of(made.code_id, "importance")
    if rule is None:
        return 1.0, False
    made.add("I", rule.of(category), rule=rule, note=f"category {category}")
    return (rule.of(category), False) if rule.case == "strength" else (1.0, True)


def _largest_from(target: TargetSpectrum, period: float) -> float:
    """Largest ordinate (g) at a period (s) and longer ones: the plateau, below its corner."""
    longest = min(target.longest, max(LONGEST_PERIOD, period))
    points = np.array(target.parameters.get("period", ()), dtype=np.float64)
    start = max(period, target.shortest)
    periods = np.unique([start, longest, *np.geomspace(max(start, 1e-3), longest, 400), *points[points >= start]])
    return float(np.max(target(periods[periods <= longest]))) / STANDARD_GRAVITY


def _coefficient(
    made: _Design, target: TargetSpectrum, period: float, importance: float, reduction: float, s_1: float | None
) -> float:
    """C_s from the ordinate at T, with I/R, and the least values that the code has."""
    known = target.parameters
    if known.get("shape") == "asce7" and "factor" not in known and "tilt" not in known:
        coefficient = seismic_response_coefficient(
            known["sds_g"], known["sd1_g"], period, reduction, importance=importance, t_l=known["tl"], minimum=False
        )
        short = float(known["sds_g"])
    else:
        coefficient = _largest_from(target, period) * importance / reduction
        short = 0.9 * _largest_from(target, max(0.2, target.shortest))  # ASCE/SEI 7-22, 21.4, from memory
    values: dict[str, Callable[[], float | None]] = {
        "": lambda: 1.0,
        "of S_DS I": lambda: short * importance,
        "of S_1 I/R": lambda: None if s_1 is None else (s_1 if s_1 >= 0.6 else 0.0) * importance / reduction,
        "of S(2.0) I/R": lambda: float(target(2.0)) / STANDARD_GRAVITY * importance / reduction,
        "of S_a(0) I": lambda: float(target(0.0)) / STANDARD_GRAVITY * importance if target.shortest == 0.0 else None,
    }
    for case, value in values.items():
        rule = rule_of(made.code_id, "least coefficient", case)
        if rule is None:
            continue
        least = value()
        if least is None:
            what = "site.s1_g is not stated" if "S_1" in case else "the spectrum has no ordinate at T = 0"
            made.lacks(f"the least coefficient {rule.number:g} {case} ({rule.clause}) is not applied, as {what}")
            continue
        made.add("least C_s", rule.number * least, rule=rule, note=f"{rule.number:g} {case}".rstrip())
        coefficient = max(coefficient, rule.number * least)
    return coefficient


def _ec8_spectrum(made: _Design, target: TargetSpectrum, q: float) -> Callable[[FloatArray], FloatArray]:
    """S_d(T) (m/s2) of Eurocode 8, 3.2.2.5(4): the elastic spectrum over q, 2/3 a_g S at T = 0, at least beta a_g."""
    known, least = target.parameters, rule_of(made.code_id, "least coefficient", "of a_g")
    if known.get("shape") != "eurocode8" or least is None:
        made.lacks("the branch of S_d below T_B and beta a_g are not applied: the site spectrum is not ec8:...")
        return lambda periods: target(periods) / q
    ground = STANDARD_GRAVITY * known["importance"] * known["agr_g"]
    made.add("least S_d", least.number * ground / STANDARD_GRAVITY, rule=least, note=f"beta = {least.number:g}, in g")
    if known["damping"] != 0.05:
        made.lacks("S_d has the damping of the site spectrum; the code's is that of 5 %")

    def spectrum(periods: FloatArray) -> FloatArray:
        period = np.asarray(periods, dtype=np.float64)
        rising = ground * known["s"] * (2.0 / 3.0 + period / known["tb"] * (2.5 / q - 2.0 / 3.0))
        falling = target(period) / q
        falling = np.where(period >= known["tc"], np.maximum(falling, least.number * ground), falling)
        return np.where(period < known["tb"], rising, falling)

    return spectrum


def _ec8_coefficient(
    made: _Design, spectrum: Callable[[FloatArray], FloatArray], period: float, target: TargetSpectrum, storeys: int
) -> float:
    """S_d(T_1) lambda (g) of Eurocode 8, 4.3.3.2.2(1)."""
    corner, rule = target.parameters.get("tc"), rule_of(made.code_id, "lambda")
    share = 1.0
    if rule is not None and corner is not None and period <= 2.0 * corner and storeys > LAMBDA_STOREYS:
        share = rule.number
    made.add("lambda", share, rule=rule, note="of lateral forces; modal shears are not scaled to them")
    return share * float(spectrum(np.array([period]))[0]) / STANDARD_GRAVITY


def _nzs_factor(made: _Design, mu: float, period: float, target: TargetSpectrum) -> float:
    """S_p/k_mu of NZS 1170.5, 4.4.2 and 5.2.1.1."""
    bounded_period = max(period, LEAST_PERIOD_NZS)
    if target.parameters.get("site_class") == "E":
        k_mu = mu if bounded_period >= 1.0 or mu < 1.5 else (mu - 1.5) * bounded_period + 1.5
    else:
        k_mu = mu if bounded_period >= 0.7 else (mu - 1.0) * bounded_period / 0.7 + 1.0
    s_p = structural_performance(mu)
    made.add("S_p", s_p, rule=rule_of(made.code_id, "S_p"))
    made.add("k_mu", k_mu, rule=rule_of(made.code_id, "coefficient"))
    return s_p / k_mu


def structural_performance(mu: float) -> float:
    """S_p of NZS 1170.5, 4.4.2 (from memory): 1 at mu = 1, 0.7 from mu = 2, a line between."""
    ends = [rule_of("nzs1170.5", "S_p", case) for case in ("mu = 1", "mu >= 2")]
    return float(np.interp(mu, [1.0, 2.0], [end.number for end in ends if end is not None]))


def _nzs_coefficient(made: _Design, target: TargetSpectrum, period: float, factor: float) -> float:
    """C_d(T_1) (g) of NZS 1170.5, 5.2.1.1."""
    coefficient = float(target(max(period, LEAST_PERIOD_NZS))) / STANDARD_GRAVITY * factor
    known = target.parameters
    if known.get("shape") != "nzs1170":
        made.lacks("Z R_u/20 + 0.02 R_u and 0.03 R_u are not applied: the site spectrum is not nzs1170:...")
        return coefficient
    rules = [rule_of(made.code_id, "least coefficient", case) for case in ("of Z R_u", "of R_u", "of R_u alone")]
    of_z, of_r, alone = (rule.number for rule in rules if rule is not None)
    z_r = min(known["z"] * known["r"], 0.7)
    least = max(of_z * z_r + of_r * known["r"], alone * known["r"])
    made.add("least C_s", least, rule=rules[0])
    return max(coefficient, float(least))
