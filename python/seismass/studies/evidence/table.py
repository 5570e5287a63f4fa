"""The table by which a code committee changes its fraction of the live load: shares of many archetypes, and rules."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any, ClassVar, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.base.arguments import Progress, ProgressLike
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.stored_results import NOTHING_STORED, StoredResults, inputs_digest, metadata_head, motion_contents
from seismass.base.values import FieldValue, as_flag, as_list, as_number, as_one_of, brief, refusal
from seismass.media.result import Result, finite_values
from seismass.model.codes import code_fraction
from seismass.motions.records import Pair, Suite, builtin_suite
from seismass.studies.evidence.archetypes import Archetype, Setting, read_archetypes
from seismass.studies.evidence.definitions import MCE, QUANTITIES, Answer, Question, answer_of
from seismass.studies.evidence.runs import Motions, first_components, present_share, runs_of, solved_archetype
from seismass.studies.evidence.variants import variants
from seismass.studies.risk.hazard import HazardCurve

SCHEMA_VERSION: Final = 1
"""Version of the tables; see docs/evidence.md."""
CODES: Final = ("asce7-10", "nbc", "nzs1170.5", "ec8")
NUMBERS: Final = (0.3, 0.6, 0.8, 1.0)
"""Codes, and plain fractions, that are compared."""
STEP: Final = 0.05
"""To which round numbers are rounded."""
RIGHT: Final = (0.8, 1.25)
"""Rate, real over model, between which a rule is right."""
QUICK: Final[dict[str, Any]] = {"levels": (0.3, 0.75, 1.0, 1.5, 3.3), "samples": (2, 2)}
_QUICK_ARCHETYPES: Final = 10
ROUND: Final = "round numbers"
BY_CLASS: Final = "present x factor of the class"


def default_hazard(slope: float = 2.5) -> HazardCurve:
    """Return an illustrative hazard of no site: 1/2475 a year at the MCE, where it has a slope that grows upwards."""
    power, ratio = as_number(slope, "slope", "hazard", InvalidOption), np.geomspace(0.05, 8.0, 60)
    x = np.log(ratio / MCE)
    return HazardCurve(ratio, np.exp(-power * x - 0.1 * x * x) / 2475.0, label=f"illustrative, k = {power:g}")


@dataclass(frozen=True, eq=False, repr=False)
class Evidence(FieldValue, Result):
    """Which share of the design live load acts as mass in the archetypes of a code.

    Attributes
    ----------
    tables : dict of str to polars.DataFrame
        By name; docs/evidence.md has their columns.
    table : polars.DataFrame
        The summary by occupancy and class of system, which the sheet shows.
    metadata : dict
        Versions, digest, suites, hazard, setting.
    """

    document: ClassVar[str] = "evidence"

    frames: dict[str, pl.DataFrame] = field(repr=False)
    metadata: dict[str, Any] = field(repr=False)

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name."""
        return self.frames

    @property
    def table(self) -> pl.DataFrame:
        """The summary by occupancy and class of system."""
        return self.frames["summary"]

    @property
    def figure_names(self) -> tuple[str, ...]:
        """evidence: shares of archetypes with rates of fractions; tornado: what moves them, where these were varied."""
        return ("evidence", *(("tornado",) if "vary" in self.tables else ()))

    def to_dict(self) -> dict[str, Any]:
        """Return metadata, summary and rules as plain values."""
        tables = {name: self.tables[name].to_dicts() for name in ("summary", "rules", "full")}
        return finite_values({**self.metadata, **tables})


@dataclass(frozen=True)
class _Part:
    """A suite with the setting in which archetypes are solved under it; `name` begins those of its kept parts."""

    name: str
    suite: Motions
    setting: Setting
    redesign: bool


def evidence(
    archetypes: str | os.PathLike[str] | Sequence[Archetype] | None = None,
    suite: Suite | None = None,
    *,
    setting: Setting | None = None,
    hazard: HazardCurve | None = None,
    codes: Iterable[str] = CODES,
    other: Suite | None = None,
    quick: bool = False,
    vary: bool = False,
    resamples: int = 300,
    threads: int | None = None,
    progress: ProgressLike = None,
    store: StoredResults = NOTHING_STORED,
) -> Evidence:
    """Return which share of the design live load, as mass, gives archetypes the response with the goods that slide.

    Parameters
    ----------
    archetypes, setting : optional
        A file as `example_file` has it, or archetypes and setting of `read_archetypes`; by default the 29 of that file.
    suite : Suite, optional
        Motions, unscaled; by default the built-in forty, which are synthetic.
    hazard : HazardCurve, optional
        Annual rate of the intensity over that of the design; by default `default_hazard`, of no site.
    codes : iterable of str, optional
        Codes whose fractions are compared.
    other : Suite, optional
        Motions on which the round numbers are judged that were found on `suite`; a quarter of the buildings, no
        redesign.
    quick, vary : bool, default False
        Ten archetypes with few samples and levels, for a first look; one input at a time changed, too, on one archetype
        of each occupancy and class.
    resamples : int, default 300
        Of the bootstrap over stations.
    threads, progress, store
        As for `run_study`; progress is in runs.

    Raises
    ------
    InvalidOption, InvalidMotion, SimulationError
        An argument is not what it must be; a run could not be carried to its end.

    Notes
    -----
    A real building has the strengths of its sample, and goods with the presence and the friction of theirs. Its models
    have the same strengths, shares of the design live load as mass, and the weight of the mean load. Motions are
    scaled to levels of the design spectrum at the period of the design.

    Examples
    --------
    >>> import seismass as sm
    >>> archetypes, setting = sm.evidence.read_archetypes()
    >>> seven = sm.builtin_suite("seven")
    >>> found = sm.evidence.evidence(archetypes[:1], seven, setting=setting, quick=True, resamples=20)
    >>> found.table["occupancy"].to_list(), found.metadata["synthetic"]
    (['light storage'], True)
    """
    for name, flag in (("quick", quick), ("vary", vary)):
        as_flag(flag, name, "evidence", InvalidOption)
    is_file = archetypes is None or isinstance(archetypes, str | os.PathLike)
    listed, of_file = read_archetypes(archetypes if is_file else None)  # type: ignore[arg-type]
    requirement = "a file, or a list of Archetypes"
    if not is_file:
        listed = tuple(as_list(archetypes, "archetypes", "evidence", InvalidOption, requirement))
    if not listed or not all(isinstance(item, Archetype) for item in listed):
        raise refusal(InvalidOption, "archetypes", "evidence", requirement, brief(archetypes))
    settings = of_file if setting is None else as_one_of(setting, Setting, "setting", "evidence", InvalidOption)
    if quick:
        settings = replace(settings, **QUICK)
        listed = listed[:: -(-len(listed) // _QUICK_ARCHETYPES)]
    as_one_of(store, StoredResults, "store", "evidence", InvalidOption)
    suites: list[Any] = [builtin_suite("forty") if suite is None else suite, *([] if other is None else [other])]
    if not all(isinstance(each, Suite) and len(each) for each in suites):
        raise refusal(InvalidMotion, "suite", "evidence", "a Suite of records", brief(suite))
    if not {1.0, MCE} <= set(settings.levels):
        raise refusal(InvalidOption, "levels", "evidence", f"1 and {MCE:g} among others", brief(settings.levels))
    compared = tuple(as_list(codes, "codes", "evidence", InvalidOption, "names of codes"))
    for code in compared:  # before anything is solved
        _ = [code_fraction(code, each.occupancy.survey.use) for each in listed]
    curve = default_hazard() if hazard is None else as_one_of(hazard, HazardCurve, "hazard", "evidence", InvalidOption)
    parts = [_Part("first", suites[0], settings, True)]
    fewer = replace(settings, samples=(max(settings.samples[0] // 4, 1), settings.samples[1]))
    parts += [_Part("other", each, fewer, False) for each in suites[1:]]
    full, typical = _Part("full", suites[0], replace(fewer, full=True), False), typical_archetypes(listed)
    work = [(part, each) for part in parts for each in listed] + [(full, each) for each in typical]
    varied = variants(fewer, suites, typical) if vary else []
    everything = [*work, *((_Part("vary", each.suite, each.setting, False), each.archetype) for each in varied)]
    total = sum(runs_of(each, part.setting, len(part.suite), part.redesign) for part, each in everything)
    stages = Progress(progress, total, "evidence")

    def solved(part: _Part, archetype: Archetype, slope: float | None = None) -> Answer:
        runs = runs_of(archetype, part.setting, len(part.suite), part.redesign)
        tell = stages.part(runs) or (lambda *_: None)
        components = [one for each in part.suite for one in (each if isinstance(each, Pair) else (each,))]
        digest = inputs_digest(part.setting, archetype, part.redesign, motion_contents(components))[:24]
        how: dict[str, Any] = {"redesign": part.redesign, "threads": threads, "report": lambda done: tell(done, runs)}
        make = lambda: solved_archetype(archetype, part.setting, part.suite, **how)  # noqa: E731
        tell(0, runs)
        table = store.of(f"{part.name}-{digest}", make)
        tell(runs, runs)
        of_levels = curve if slope is None else default_hazard(slope)
        question = Question(part.setting, of_levels, stations(part.suite), resamples)
        return answer_of(table, question, convergence=part.name == "first")

    answers = {(part.name, each): solved(part, each) for part, each in work}
    tables = _tables(listed, parts, answers, compared)
    tables["full"] = _full_table(typical, answers)
    if vary:
        pairs = zip(varied, everything[len(work) :], strict=True)
        rows = [each.row(solved(part, each.archetype, each.slope)) for each, (part, _) in pairs]
        tables["vary"] = pl.DataFrame(rows, schema_overrides={"a_mean": pl.Float64, "d": pl.Float64})
    contents = [motion_contents(each) for each in suites]
    metadata = metadata_head(SCHEMA_VERSION, SCHEMA_VERSION, list(listed), settings, contents, curve.parameters)
    metadata |= {"suites": [each.name for each in suites], "motions": [len(each) for each in suites]}
    metadata |= {"stations": [int(stations(each).max()) + 1 for each in suites], "hazard": curve.parameters}
    metadata |= {"synthetic": any(record.synthetic for record in suites[0]), "setting": asdict(settings)}
    return Evidence(tables, metadata | {"quick": quick, "runs": total, "codes": list(compared)})


def stations(suite: Motions) -> NDArray[np.int64]:
    """Number of the station of each record or pair, from 0; a synthetic one is its own."""
    names = [
        number if record.synthetic or not record.station else (record.event, record.station)
        for number, record in enumerate(first_components(suite))
    ]
    numbers = {name: number for number, name in enumerate(dict.fromkeys(names))}
    return np.array([numbers[name] for name in names])


def typical_archetypes(archetypes: Sequence[Archetype]) -> list[Archetype]:
    """Return one archetype of each occupancy and class: the middle one by storeys."""
    groups: dict[tuple[str, str], list[Archetype]] = {}
    for each in sorted(archetypes, key=lambda each: (each.storeys, each.system.R)):
        groups.setdefault((each.occupancy.name, each.kind), []).append(each)
    middle = {group[len(group) // 2] for group in groups.values()}
    return [each for each in archetypes if each in middle]


def _labels(archetype: Archetype) -> dict[str, Any]:
    return {"archetype": archetype.name, "occupancy": archetype.occupancy.name, "class": archetype.kind}


def _design_row(archetype: Archetype, setting: Setting, present: float, slides: float) -> dict[str, Any]:
    """Numbers of a design, for a check by hand."""
    designed, occupancy, system = setting.designed(archetype), archetype.occupancy, archetype.system
    design, building = designed.design, designed.building
    drift = np.max(designed.checks["design_drift"].to_numpy()) / occupancy.height
    row = _labels(archetype) | {"storeys": archetype.storeys, "R": system.R, "system": system.period}
    row |= {"height_m": archetype.storeys * occupancy.height, "T_a_s": designed.approximate_period}
    row |= {"T_design_s": design.period, "T_bare_s": float(building.periods[0]), "C_s": design.coefficient}
    row |= {"W_kn": 1e-3 * design.weight, "V_design_kn": 1e-3 * float(design.yield_shear[0])}
    row |= {"k_1_kn_m": 1e-3 * float(building.stiffness[0]), "first_yield": setting.first_yield}
    row |= {"drift_design": float(drift), "theta": float(designed.checks["theta"].to_numpy().max())}
    row |= {"design_fraction": setting.fraction(occupancy), "dead_kpa": occupancy.dead_load}
    return row | {"live_kpa": occupancy.live_load, "present": present, "slides_at_design": slides}


def _tables(
    archetypes: Sequence[Archetype],
    parts: Sequence[_Part],
    answers: Mapping[tuple[str, Archetype], Answer],
    codes: tuple[str, ...],
) -> dict[str, pl.DataFrame]:
    first, setting = parts[0], parts[0].setting
    present = {each: present_share(each, setting, len(first.suite)) for each in archetypes}
    designs = [_design_row(each, setting, present[each], answers["first", each].slides) for each in archetypes]
    places = [
        ({"suite": part.name, **_labels(each)}, each, answers[part.name, each]) for part in parts for each in archetypes
    ]
    shares = _frame([labels | row for labels, _, answer in places for row in answer.share_rows()])
    rules = _Rules.of(shares, present, codes)
    ratios = _frame(
        [
            labels | {"code_id": code, "fraction": fraction, "quantity": quantity} | answer.ratio(quantity, fraction)
            for labels, each, answer in places
            for code, fraction in rules.fractions(each).items()
            for quantity in (*QUANTITIES, "floor_acceleration")
        ]
    )
    changes = [row for each in archetypes for row in answers["first", each].convergence]
    schema: Any = {"sample": pl.String, "definition": pl.String, "change": pl.Float64}
    of_samples = pl.DataFrame(changes, schema=schema).group_by("sample", "definition", maintain_order=True)
    table = pl.DataFrame(designs)
    return {
        "summary": _summary(table, shares, ratios, rules, codes[0]),
        "rules": _judged(ratios),
        "archetypes": table,
        "shares": shares,
        "codes": ratios,
        "fragility": _frame([labels | row for labels, _, answer in places for row in answer.fragility]),
        "convergence": of_samples.agg(rms_change=(pl.col("change").drop_nans() ** 2).mean().sqrt()),
    }


def _frame(rows: list[dict[str, Any]]) -> pl.DataFrame:
    """Rows whose first may be null where others have numbers."""
    frame = pl.DataFrame(rows, infer_schema_length=None)
    return frame.with_columns(pl.col(pl.Null).cast(pl.Float64))


@dataclass(frozen=True)
class _Rules:
    """Fractions of codes and of rules that the shares of the first suite make: round numbers by occupancy and class,
    factors of the mean load present by class, both means of (a) and (d) to the next step.
    """

    codes: tuple[str, ...]
    present: Mapping[Archetype, float]
    rounds: dict[tuple[str, str], float]
    factors: dict[str, float]

    @classmethod
    def of(cls, shares: pl.DataFrame, present: Mapping[Archetype, float], codes: tuple[str, ...]) -> _Rules:
        """Return those of a table of shares."""
        over = {each.name: value for each, value in present.items()}
        both = shares.filter(pl.col("definition").is_in(["a_mean", "d"]), suite="first").drop_nulls("share")
        both = both.with_columns(
            factor=pl.col("share") / pl.col("archetype").replace_strict(over, return_dtype=pl.Float64)
        )
        means = both.group_by("occupancy", "class", "definition").agg(pl.col("share").mean())
        means = means.group_by("occupancy", "class").agg(pl.col("share").mean())
        rounds = {(name, kind): round(share / STEP) * STEP for name, kind, share in means.iter_rows()}
        by_class = both.group_by("class").agg(pl.col("factor").mean())
        return cls(codes, present, rounds, {kind: round(value / STEP) * STEP for kind, value in by_class.iter_rows()})

    def fractions(self, archetype: Archetype) -> dict[str, float]:
        """Fractions of the design live load by the name of the code or rule."""
        use, kind, present = archetype.occupancy.survey.use, archetype.kind, self.present[archetype]
        fractions = {code: code_fraction(code, use).fraction for code in self.codes}
        fractions |= {f"{number:g} everywhere": number for number in NUMBERS}
        stored = use in ("storage", "archive")
        fractions |= {f"{number:g} storage, 0.3": number if stored else 0.3 for number in (0.6, 0.8)}
        fractions |= {"mean present": present, BY_CLASS: self.factors.get(kind, np.nan) * present}
        fractions |= {ROUND: self.rounds.get((archetype.occupancy.name, kind), np.nan)}
        return {name: value for name, value in fractions.items() if np.isfinite(value)}


def _summary(
    designs: pl.DataFrame, shares: pl.DataFrame, ratios: pl.DataFrame, rules: _Rules, code: str
) -> pl.DataFrame:
    """One row per occupancy and class: what the sheet shows."""
    keys, share, ratio = ["occupancy", "class"], pl.col("share"), pl.col("real_over_model")
    loads = {"archetypes": pl.len(), "live_kpa": pl.col("live_kpa").first(), "present": pl.col("present").mean()}
    summary = designs.group_by(keys, maintain_order=True).agg(**loads)
    joined = []
    for name in ("a_mean", "d", "base_shear", "floor_force", "e_d", "b", "c"):
        columns = {name: share.mean(), f"lambda_{name}": pl.col("lambda").mean()}
        if name == "d":
            columns |= {"d_least": share.min(), "d_most": share.max()}
            columns |= {"d_low": pl.col("low").mean(), "d_high": pl.col("high").mean()}
        joined.append(shares.filter(suite="first", definition=name).group_by(keys).agg(**columns))
    rates = ratios.filter(suite="first", quantity="rate").drop_nulls("real_over_model")
    for rule in (code, *(f"{number:g} everywhere" for number in NUMBERS), ROUND):
        stem = "rate_" + rule.removesuffix(" everywhere").replace(" ", "_")
        columns = {stem: ratio.log().mean().exp()}
        if rule == code:
            columns |= {"code_fraction": pl.col("fraction").first()}
            columns |= {f"{stem}_least": ratio.min(), f"{stem}_most": ratio.max()}
        joined.append(rates.filter(code_id=rule).group_by(keys).agg(**columns))
    for each in joined:
        summary = summary.join(each, on=keys, how="left", maintain_order="left")
    rounds = [rules.rounds.get((name, kind)) for name, kind in summary.select(keys).iter_rows()]
    return summary.with_columns(round=pl.Series(rounds, dtype=pl.Float64))


def _judged(ratios: pl.DataFrame) -> pl.DataFrame:
    """One row per suite, rule and quantity: mean, range and scatter of real over model, and how many are right."""
    ratio = pl.col("real_over_model")
    known = ratios.filter(pl.col("quantity").is_in(["rate", "drift"])).drop_nulls("real_over_model")
    return known.group_by("suite", "code_id", "quantity", maintain_order=True).agg(
        archetypes=pl.len(),
        mean=ratio.log().mean().exp(),
        least=ratio.min(),
        most=ratio.max(),
        log_deviation=ratio.log().std(ddof=0),
        right=ratio.is_between(*RIGHT).mean(),
        unsafe=(ratio > RIGHT[1]).mean(),
    )


def _full_table(archetypes: Sequence[Archetype], answers: Mapping[tuple[str, Archetype], Answer]) -> pl.DataFrame:
    """One row per archetype whose floors have their whole design live load: shares, and rates with fractions."""
    rows = []
    for each in archetypes:
        answer = answers["full", each]
        shares = {
            row["definition"]: row["share"] for row in answer.share_rows() if row["definition"] in ("a_mean", "d")
        }
        rates = {f"rate_{number:g}": answer.ratio("rate", number)["real_over_model"] for number in (0.25, *NUMBERS)}
        rows.append(_labels(each) | shares | rates)
    return _frame(rows)
