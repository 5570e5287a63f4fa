"""The table by which a code committee changes its fraction of the live load: shares of many archetypes, and rules."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass import _kernel
from seismass.base.digest import inputs_digest, motion_contents
from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.stored_results import NOTHING_STORED, StoredResults
from seismass.base.values import as_count, brief, content_hash, refusal, same_content, short_repr
from seismass.base.views import view
from seismass.effective_mass.runs import Stages
from seismass.media.result import Result, finite_values
from seismass.model.codes import code_fraction
from seismass.motions.records import Suite
from seismass.runs.simulate import instruction_set
from seismass.studies.evidence.archetypes import Archetype, Setting, read_archetypes
from seismass.studies.evidence.definitions import MCE, QUANTITIES, Answer, Question, answer_of
from seismass.studies.evidence.runs import present_share, runs_of, solved_archetype
from seismass.studies.evidence.variants import variants
from seismass.studies.risk.hazard import HazardCurve

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SCHEMA_VERSION: Final = 1
"""Version of the tables; see docs/evidence.md."""
CODES: Final = ("asce7-10", "nbc", "nzs1170.5", "ec8")
"""Codes whose fractions are compared by default."""
NUMBERS: Final = (0.3, 0.6, 0.8, 1.0)
"""Plain fractions that are compared with those of codes."""
STEP: Final = 0.05
"""To which round numbers are rounded."""
RIGHT: Final = (0.8, 1.25)
"""Rate, real over model, between which a rule is right."""
QUICK: Final[dict[str, Any]] = {"levels": (0.5, 1.0, 1.5, 2.25, 3.3), "samples": (2, 2)}
"""Settings of a quick run."""
_QUICK_ARCHETYPES: Final = 10
ROUND: Final = "round numbers"
BY_CLASS: Final = "present x factor of the class"


def default_hazard(slope: float = 2.5) -> HazardCurve:
    """Return an illustrative hazard of no site: 1/2475 a year at the MCE, where it has a slope that grows upwards.

    Parameters
    ----------
    slope : float, default 2.5
        k at the MCE.
    """
    ratio = np.geomspace(0.05, 8.0, 60)
    x = np.log(ratio / MCE)
    return HazardCurve(ratio, np.exp(-slope * x - 0.1 * x * x) / 2475.0, label=f"illustrative, k = {slope:g}")


@dataclass(frozen=True, eq=False)
class Evidence(Result):
    """Which share of the design live load acts as mass in the archetypes of a code.

    Attributes
    ----------
    tables : dict of str to polars.DataFrame
        By name; docs/evidence.md has their columns: archetypes, shares, codes, fragility, convergence, summary, rules,
        full (floors with their whole design live load), vary (where it was asked for).
    metadata : dict
        Versions, digest, suites, hazard, setting, assumptions.
    """

    document: ClassVar[str] = "evidence"

    tables_by_name: dict[str, pl.DataFrame] = field(repr=False)
    metadata: dict[str, Any] = field(repr=False)

    __repr__ = short_repr
    __eq__ = same_content
    __hash__ = content_hash

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name."""
        return self.tables_by_name

    @property
    def table(self) -> pl.DataFrame:
        """The summary by occupancy and class of system, which the sheet shows."""
        return self.tables_by_name["summary"]

    @property
    @view
    def text(self) -> str:
        """The table of the sheet and the sentences that the numbers make."""
        raise NotImplementedError

    @property
    def figure_names(self) -> tuple[str, ...]:
        """evidence; tornado, where inputs were varied."""
        return ("evidence", *(("tornado",) if "vary" in self.tables_by_name else ()))

    @view
    def plot(self, name: str | None = None) -> Figure:
        """Return a figure: shares of every archetype with rates of fractions, or what moves them.

        Parameters
        ----------
        name : str, optional
            "evidence" or "tornado".

        Raises
        ------
        InvalidOption
            There is no such figure.
        """
        raise NotImplementedError

    def to_dict(self) -> dict[str, Any]:
        """Return metadata, summary and rules as plain values."""
        names = ("summary", "rules", "full")
        found: dict[str, Any] = finite_values(
            {**self.metadata, **{name: self.tables_by_name[name].to_dicts() for name in names}}
        )
        return found

    @view
    def write(self, folder: str | os.PathLike[str], *, figures: bool = True) -> list[Path]:
        """Write tables (Parquet and CSV), evidence.json, figures (SVG) and the sheets, report.html, to a folder.

        Returns
        -------
        list of Path
            The files, in the order written.

        Raises
        ------
        OSError
            A file cannot be written; then none is changed.
        """
        raise NotImplementedError


@dataclass(frozen=True)
class _Part:
    """A suite with the setting in which archetypes are solved under it; `name` is that of its kept parts."""

    name: str
    suite: Suite
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
    progress: Callable[[int, int], object] | None = None,
    store: StoredResults = NOTHING_STORED,
) -> Evidence:
    """Return which share of the design live load, as mass, gives archetypes the response with the goods that slide.

    Parameters
    ----------
    archetypes : path or sequence of Archetype, optional
        A file as `example_file` has it, or archetypes of `read_archetypes`; by default the 29 of that file.
    suite : Suite, optional
        Motions, unscaled; by default the built-in forty, which are synthetic.
    setting : Setting, optional
        Site, code, distributions, samples; by default those of the file.
    hazard : HazardCurve, optional
        Annual rate of the intensity over that of the design; by default `default_hazard`, of no site.
    codes : iterable of str
        Codes whose fractions are compared.
    other : Suite, optional
        Motions on which the round numbers are judged that were found on `suite`; half as many buildings, no redesign.
    quick : bool, default False
        Ten archetypes, five levels, two buildings and two loads a motion: some tens of seconds, for a first look.
    vary : bool, default False
        Change one input at a time on one archetype of each occupancy and class: half an hour.
    resamples : int, default 300
        Of the bootstrap over stations.
    threads, progress, store
        As for `run_study`; progress is in runs.

    Raises
    ------
    InvalidOption, InvalidMotion
        An argument is not what it must be.
    SimulationError
        A run could not be carried to its end.

    Notes
    -----
    A real building has the strengths and slopes of its sample and goods with the presence and the friction of theirs.
    Its models have the same strengths, shares of the design live load as mass, and the weight of the mean load present.
    Each motion is scaled to levels of the design spectrum at the period of the design.

    Examples
    --------
    >>> import seismass as sm
    >>> archetypes, setting = sm.evidence.read_archetypes()
    >>> seven = sm.builtin_suite("seven")
    >>> found = sm.evidence.evidence(archetypes[:1], seven, setting=setting, quick=True, resamples=20)
    >>> found.table["occupancy"].to_list(), found.metadata["synthetic"]
    (['light storage'], True)
    """
    if archetypes is None or isinstance(archetypes, str | os.PathLike):
        listed, of_file = read_archetypes(archetypes)
    else:
        listed, of_file = tuple(archetypes), read_archetypes()[1]
    if not listed or not all(isinstance(item, Archetype) for item in listed):
        raise refusal(InvalidOption, "archetypes", "evidence", "a file, or a list of Archetypes", brief(archetypes))
    chosen = of_file if setting is None else setting
    if quick:
        chosen = replace(chosen, **QUICK)
        listed = listed[:: -(-len(listed) // _QUICK_ARCHETYPES)]
    motions = _checked_suite(suite, other)
    curve = default_hazard() if hazard is None else hazard
    parts = [_Part("first", motions[0], chosen, True)]
    if len(motions) > 1:
        fewer = replace(chosen, samples=(max(chosen.samples[0] // 2, 1), chosen.samples[1]))
        parts.append(_Part("other", motions[1], fewer, False))
    full = _Part("full", motions[0], replace(chosen, full=True, samples=parts[-1].setting.samples), False)
    typical = typical_archetypes(listed)
    work = [(part, each) for part in parts for each in listed] + [(full, each) for each in typical]
    varied = variants(chosen, motions, typical) if vary else []
    everything = [*work, *((_Part("vary", each.suite, each.setting, False), each.archetype) for each in varied)]
    total = sum(runs_of(each, part.setting, len(part.suite), part.redesign) for part, each in everything)
    stages = Stages(progress, total)
    count = as_count(resamples, "resamples", "evidence", InvalidOption, least=1)

    def solved(part: _Part, archetype: Archetype, at: HazardCurve = curve) -> Answer:
        runs = runs_of(archetype, part.setting, len(part.suite), part.redesign)
        tell = stages.next(runs)  # of what is kept, too
        digest = inputs_digest(part.setting, archetype, part.redesign, motion_contents(part.suite))[:24]
        table = store.of(
            f"{part.name}-{digest}",
            lambda: solved_archetype(
                archetype,
                part.setting,
                part.suite,
                redesign=part.redesign,
                threads=threads,
                report=None if tell is None else lambda done: tell(done, runs),
            ),
        )
        if tell is not None:
            tell(runs, runs)
        question = Question(part.setting, at, stations(part.suite), count)
        return answer_of(table, question, convergence=part.name == "first")

    answers = {(part.name, each): solved(part, each) for part, each in work}
    tables = _tables(listed, parts, answers, tuple(codes))
    tables["full"] = _full_table(typical, full, answers)
    if vary:
        tables["vary"] = pl.DataFrame(
            [
                each.row(solved(part, each.archetype, curve if each.slope is None else default_hazard(each.slope)))
                for each, (part, _) in zip(varied, everything[len(work) :], strict=True)
            ],
            schema_overrides={"a_mean": pl.Float64, "d": pl.Float64},
            infer_schema_length=None,
        )
    synthetic = [sum(record.synthetic for record in each) for each in motions]
    return Evidence(
        tables,
        {
            "schema_version": SCHEMA_VERSION,
            "package_version": _kernel.VERSION,
            "instructions": instruction_set(),
            "inputs_sha256": evidence_digest(listed, chosen, motions, curve),
            "suites": [each.name for each in motions],
            "motions": [len(each) for each in motions],
            "stations": [int(stations(each).max()) + 1 for each in motions],
            "synthetic": synthetic[0] > 0,
            "hazard": curve.parameters,
            "setting": asdict(chosen),
            "quick": quick,
            "runs": total,
            "codes": list(codes),
        },
    )


def _checked_suite(suite: Any, other: Any) -> list[Suite]:
    from seismass.motions.records import builtin_suite

    suites = [builtin_suite("forty") if suite is None else suite, *([] if other is None else [other])]
    for each in suites:
        if not isinstance(each, Suite) or not len(each):
            raise refusal(InvalidMotion, "suite", "evidence", "a Suite of records", brief(each))
    return suites


def evidence_digest(
    archetypes: Sequence[Archetype], setting: Setting, suites: Sequence[Suite], hazard: HazardCurve
) -> str:
    """Return the digest of all that the numbers depend on."""
    contents = [motion_contents(suite) for suite in suites]
    return inputs_digest(SCHEMA_VERSION, list(archetypes), setting, contents, hazard.parameters)


def stations(suite: Suite) -> NDArray[np.int64]:
    """Number of the station of each record, from 0; a synthetic one is its own."""
    names = [
        number if record.synthetic or not record.station else (record.event, record.station)
        for number, record in enumerate(suite)
    ]
    numbers = {name: number for number, name in enumerate(dict.fromkeys(names))}
    return np.array([numbers[name] for name in names])


def typical_archetypes(archetypes: Sequence[Archetype]) -> list[Archetype]:
    """Return one archetype of each occupancy and class: the middle one by storeys."""
    groups: dict[tuple[str, str], list[Archetype]] = {}
    for each in archetypes:
        groups.setdefault((each.occupancy.name, each.kind), []).append(each)
    ordered = (sorted(group, key=lambda each: (each.storeys, each.system.R)) for group in groups.values())
    return [group[len(group) // 2] for group in ordered]


def _labels(archetype: Archetype) -> dict[str, Any]:
    return {"archetype": archetype.name, "occupancy": archetype.occupancy.name, "class": archetype.kind}


def _design_row(archetype: Archetype, setting: Setting, present: float, slides: float) -> dict[str, Any]:
    """Numbers of a design, for a check by hand."""
    design = setting.designed(archetype)
    occupancy = archetype.occupancy
    return {
        **_labels(archetype),
        "storeys": archetype.storeys,
        "R": archetype.system.R,
        "system": archetype.system.period,
        "height_m": archetype.storeys * occupancy.height,
        "T_a_s": design.approximate_period,
        "T_design_s": design.period,
        "T_bare_s": float(design.building.periods[0]),
        "C_s": design.design.coefficient,
        "W_kn": 1e-3 * design.design.weight,
        "V_design_kn": 1e-3 * float(design.design.base_shear or 0.0),
        "k_1_kn_m": 1e-3 * float(design.building.stiffness[0]),
        "first_yield": setting.first_yield,
        "drift_design": float((design.checks["design_drift"] / occupancy.height).max()),  # type: ignore[arg-type]
        "theta": float(design.checks["theta"].max()),  # type: ignore[arg-type]
        "design_fraction": setting.fraction(occupancy),
        "dead_kpa": occupancy.dead_load,
        "live_kpa": occupancy.live_load,
        "present": present,
        "slides_at_design": slides,
    }


def _tables(
    archetypes: Sequence[Archetype],
    parts: Sequence[_Part],
    answers: Mapping[tuple[str, Archetype], Answer],
    codes: tuple[str, ...],
) -> dict[str, pl.DataFrame]:
    first, setting = parts[0], parts[0].setting
    present = {each: present_share(each, setting, len(first.suite)) for each in archetypes}
    designs = [_design_row(each, setting, present[each], answers["first", each].slides) for each in archetypes]
    rows = [
        {"suite": part.name, **_labels(each), **row}
        for part in parts
        for each in archetypes
        for row in answers[part.name, each].share_rows()
    ]
    numbers = {"share": pl.Float64, "low": pl.Float64, "high": pl.Float64, "lambda": pl.Float64}
    shares = pl.DataFrame(rows, schema_overrides={**numbers, "without_friction": pl.Float64}, infer_schema_length=None)
    rounds = _round_numbers(shares)
    factors = _factors(shares, present)
    rules = {each: _fractions(each, codes, rounds, factors, present[each]) for each in archetypes}
    ratios = []
    for part in parts:
        for each in archetypes:
            answer = answers[part.name, each]
            for code, fraction in rules[each].items():
                for quantity in (*QUANTITIES, "floor_acceleration"):
                    ratio, low, high = answer.ratio(quantity, fraction)
                    ends = {"real_over_model": ratio, "low": low, "high": high}
                    labels = {"suite": part.name, **_labels(each), "code_id": code, "fraction": fraction}
                    ratios.append({**labels, "quantity": quantity, **ends})
    of_codes = pl.DataFrame(ratios, schema_overrides=dict.fromkeys(("real_over_model", "low", "high"), pl.Float64))
    fragility = [
        {"suite": part.name, **_labels(each), **row}
        for part in parts
        for each in archetypes
        for row in answers[part.name, each].fragility
    ]
    changes = pl.DataFrame(
        [row for each in archetypes for row in answers["first", each].convergence],
        schema={"sample": pl.String, "definition": pl.String, "change": pl.Float64},
    )
    convergence = changes.group_by("sample", "definition", maintain_order=True).agg(
        rms_change=(pl.col("change").drop_nans() ** 2).mean().sqrt(), archetypes=pl.len()
    )
    table = pl.DataFrame(designs)
    return {
        "summary": _summary(table, shares, of_codes, rounds, codes[0]),
        "rules": _rules(of_codes),
        "archetypes": table,
        "shares": shares,
        "codes": of_codes,
        "fragility": pl.DataFrame(fragility, infer_schema_length=None),
        "convergence": convergence,
    }


def _values(shares: pl.DataFrame, definition: str) -> pl.DataFrame:
    return shares.filter(pl.col("suite") == "first", pl.col("definition") == definition)


def _round_numbers(shares: pl.DataFrame) -> dict[tuple[str, str], float]:
    """Mean of (a) and (d) of each occupancy and class, to the next step."""
    both = shares.filter(pl.col("suite") == "first", pl.col("definition").is_in(["a_mean", "d"]))
    means = both.group_by("occupancy", "class", "definition").agg(pl.col("share").mean())
    means = means.group_by("occupancy", "class").agg(pl.col("share").mean())
    return {(name, kind): round(share / STEP) * STEP for name, kind, share in means.drop_nulls().iter_rows()}


def _factors(shares: pl.DataFrame, present: Mapping[Archetype, float]) -> dict[str, float]:
    """Mean of (a) and (d) over the mean load present, by class of system, to the next step."""
    over = {each.name: value for each, value in present.items()}
    both = shares.filter(pl.col("suite") == "first", pl.col("definition").is_in(["a_mean", "d"])).with_columns(
        factor=pl.col("share") / pl.col("archetype").replace_strict(over, return_dtype=pl.Float64)
    )
    means = both.group_by("class").agg(pl.col("factor").mean())
    return {kind: round(value / STEP) * STEP for kind, value in means.drop_nulls().iter_rows()}


def _fractions(
    archetype: Archetype,
    codes: tuple[str, ...],
    rounds: Mapping[tuple[str, str], float],
    factors: Mapping[str, float],
    present: float,
) -> dict[str, float]:
    """Fractions of the design live load by the name of the code or rule."""
    use = archetype.occupancy.survey.use
    found = {code: code_fraction(code, use).fraction for code in codes}
    found |= {f"{number:g} everywhere": number for number in NUMBERS}
    stored = use in ("storage", "archive")
    found |= {f"{number:g} storage, 0.3": number if stored else 0.3 for number in (0.6, 0.8)}
    place = archetype.occupancy.name, archetype.kind
    found |= {"mean present": present}
    found |= {BY_CLASS: factors[archetype.kind] * present} if archetype.kind in factors else {}
    return found | ({ROUND: rounds[place]} if place in rounds else {})


def _summary(
    designs: pl.DataFrame,
    shares: pl.DataFrame,
    ratios: pl.DataFrame,
    rounds: Mapping[tuple[str, str], float],
    code: str,
) -> pl.DataFrame:
    """One row per occupancy and class: what the sheet shows."""
    keys = ["occupancy", "class"]
    summary = designs.group_by(keys, maintain_order=True).agg(
        archetypes=pl.len(), live_kpa=pl.col("live_kpa").first(), present=pl.col("present").mean()
    )
    for name in ("a_mean", "d", "base_shear", "e_d", "b", "c"):
        known = _values(shares, name)
        columns: dict[str, pl.Expr] = {name: pl.col("share").mean()}
        if name == "d":
            ends = ("least", pl.col("share").min()), ("most", pl.col("share").max())
            of_stations = ("low", pl.col("low").mean()), ("high", pl.col("high").mean())
            columns |= {f"d_{end}": value for end, value in (*ends, *of_stations)}
        if name in ("a_mean", "d"):
            columns[f"lambda_{name}"] = pl.col("lambda").mean()
        summary = summary.join(known.group_by(keys).agg(**columns), on=keys, how="left", maintain_order="left")
    summary = summary.with_columns(
        round=pl.Series([rounds.get((name, kind)) for name, kind in summary.select(keys).iter_rows()], dtype=pl.Float64)
    )
    rates = ratios.filter(pl.col("suite") == "first", pl.col("quantity") == "rate").drop_nulls("real_over_model")
    for rule in (code, *(f"{number:g} everywhere" for number in NUMBERS), ROUND):
        stem = "rate_" + rule.removesuffix(" everywhere").replace(" ", "_")
        of_rule = rates.filter(pl.col("code_id") == rule).group_by(keys)
        ratio = pl.col("real_over_model")
        columns = {stem: ratio.log().mean().exp()}
        if rule == code:
            columns |= {"code_fraction": pl.col("fraction").first()}
            columns |= {f"{stem}_least": ratio.min(), f"{stem}_most": ratio.max()}
        summary = summary.join(of_rule.agg(**columns), on=keys, how="left", maintain_order="left")
    return summary


def _rules(ratios: pl.DataFrame) -> pl.DataFrame:
    """One row per suite, rule and quantity: geometric mean, range and scatter of real over model, and how many are
    right.
    """
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


def _full_table(
    archetypes: Sequence[Archetype], part: _Part, answers: Mapping[tuple[str, Archetype], Answer]
) -> pl.DataFrame:
    """One row per archetype whose floors have their whole design live load: shares, and rates with fractions."""
    rows = []
    for each in archetypes:
        answer = answers[part.name, each]
        values = {name: answer.shares[name] for name in ("a_mean", "d")}
        shares = {name: None if share.kind == "rare" else share.value for name, share in values.items()}
        ratios = {f"rate_{number:g}": answer.ratio("rate", number)[0] for number in (0.25, *NUMBERS)}
        rows.append({**_labels(each), **shares, **ratios})
    return pl.DataFrame(rows, schema_overrides=dict.fromkeys(("a_mean", "d"), pl.Float64))
