"""How the rule for the effective fraction does on buildings and motions to which it was not fitted.

    benchmarks/rules.py [--suites recorded matched pulses long] [--buildings 60] [--seed 58] [--write]

draws buildings, solves them under a suite, keeps the cases in benchmarks/results/rules.parquet, those of each suite in
place of its earlier ones, and prints the tables; `--write` puts them into docs/effective_mass.md. Recordings are read
from the folder `records` of SEISMASS_SHARED.

Buildings have 1 to 12 storeys of 3.5 m, periods of 0.1 to 3 s, goods of 0.25 to 3 times the floor on all floors, on all
but the roof, or on any in any amount, second slopes of 0 to 0.2, overstrengths of 1 to 4, P-Delta in two of five
where P/(k h) is below 0.25, and
strengths of a spectrum analysis with none to 0.8 of the goods over R of 1 (elastic) to 8. Motions are scaled for the
period with goods to one of three targets; matched ones are as they are. The friction is eta times the mean peak base
shear of the runs with all goods attached, over the weight. Drifts are capped means, as in `effective_mass`.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import NDArray

import seismass as sm
from environment import page_module
from seismass.base.values import FloatArray
from seismass.design import response_spectrum_analysis
from seismass.effective_mass.models import attached, full_weight
from seismass.effective_mass.rule import (
    OFFSET,
    RULE,
    SMALL_OFFSET,
    UNSAFE,
    exceptions,
    floor_coefficient,
    share_by_hand,
)
from seismass.motions.records import NearFaultPulse, Suite, SyntheticParameters, synthetic_motion
from seismass.motions.spectra import TargetSpectrum, corner_period, mean_spectrum
from seismass.runs.peaks import named_motions, solve

ROOT: Final = Path(__file__).parents[1]
RESULTS: Final = ROOT / "benchmarks" / "results" / "rules.parquet"
PAGE: Final = ROOT / "docs" / "effective_mass.md"
SUITES: Final = {
    "recorded": "recorded: horizontal components of seven earthquakes, scaled",
    "matched": "matched: every second of them, matched to the target within 5 % from 0.1 to 3 s",
    "pulses": "pulses: 24 synthetic motions with a velocity pulse of 0.6 to 5 s, scaled",
    "long": "long: 20 synthetic motions with D5-95 of 30 to 60 s, scaled",
}
TARGETS: Final = {
    0.57: TargetSpectrum.asce7(),
    0.3: TargetSpectrum.asce7(1.0, 0.3),
    1.0: TargetSpectrum.asce7(0.6, 0.6),
}
"""By T_S (s)."""
MATCHED: Final = (0.1, 3.0)
SHARES: Final = np.linspace(0.0, 1.0, 17)
ETAS: Final = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0)
STATIC: Final = (1.0, 4.0 / 3.0)
"""Static over kinetic friction; contacts have 1 to 1.5."""
NEAR_ONE: Final = 0.3
"""Cases below are left out of shares of unsafe cases: no rule is near a model over real of 1 there."""
STOREY_HEIGHT: Final = 3.5
LARGEST_STABILITY: Final = 0.25
"""Elastic stability coefficient up to which a building has P-Delta; codes allow no more."""
LEAST_CASES: Final = 100
"""Of a class whose share of unsafe cases is said to be the worst."""
MOST_AT_CAP: Final = 0.1
"""Share of the motions with drifts at the cap from which a building counts as collapsed."""
CLASSES: Final[dict[str, tuple[str, tuple[float, ...]]]] = {
    "T (s)": ("period", (0.1, 0.2, 0.35, 0.6, 1.0, 1.6, 3.01)),
    "R": ("R", (1.0, 1.25, 2.5, 5.0, 8.1)),
    "eta": ("eta", (0.3, 0.45, 0.65, 0.8, 1.01)),
    "r2": ("second_slope", (0.0, 0.01, 0.03, 0.07, 0.15, 0.21)),
    "alpha": ("alpha", (0.0, 0.6, 1.2, 2.01, 3.01)),
    "storeys": ("storeys", (1.0, 2.0, 4.0, 7.0, 13.0)),
    "P-Delta (0: without)": ("p_delta", (0.0, 0.5, 1.5)),
    "mu_s over mu_k": ("static", (1.0, 1.1, 1.5)),
}


def recorded() -> Suite:
    """Return the horizontal components of the folders 01 to 07."""
    records = Path(os.environ["SEISMASS_SHARED"]) / "records"
    files = sorted(file for folder in records.glob("[0-9][0-9]_*") for file in folder.glob("*.AT2"))
    horizontal = [file for file in files if not any(word in file.name.upper() for word in ("VER", "UP", "-V."))]
    return Suite("recorded", tuple(sm.read_record(file) for file in horizontal))


def suite_of(name: str) -> Suite:
    """Return a suite by its key: one of `SUITES`, "seven", "forty" or "far_field"."""
    if name in ("seven", "forty"):
        return sm.builtin_suite("seven" if name == "seven" else "forty")
    if name == "far_field":
        return sm.read_suite(Path(os.environ["SEISMASS_SHARED"]) / "records" / "fema_p695_far_field")
    if name in ("recorded", "matched"):
        found = recorded()
        if name == "matched":  # a motion takes half a minute
            return sm.matching.match_suite(found.records[::2], TARGETS[0.57], periods=MATCHED, tolerance=0.05).suite
        return found
    draw = np.random.default_rng(71 if name == "pulses" else 72)
    motions = []
    for number in range(24 if name == "pulses" else 20):
        pulse = None
        length = float(draw.uniform(30.0, 60.0)) if name == "long" else float(draw.uniform(7.0, 15.0))
        if name == "pulses":
            period = float(0.6 * (5.0 / 0.6) ** draw.random())
            pulse = NearFaultPulse(period=period, velocity=float(draw.uniform(0.4, 0.9)), centre=period + 3.0)
        parameters = SyntheticParameters(
            arias=float(draw.uniform(1.0, 4.0)),
            d5_95=length,
            t_mid=0.45 * length,
            frequency=float(draw.uniform(1.5, 5.0)),
            frequency_rate=float(draw.uniform(-0.1, 0.0)),
            damping=float(draw.uniform(0.2, 0.6)),
            corner=0.12,
            pulse=pulse,
        )
        motions.append(synthetic_motion(parameters, seed=9000 + number + 100 * (name == "long"), dt=0.01))
    return Suite(name, tuple(motions))


def two_exponents(building: sm.Building, goods: FloatArray, motions: Any, yields: bool) -> Callable[[float], float]:
    """Return the rule of earlier versions, min(1, eta_h^p), as a function of friction, with its C1 by hand."""

    def spectrum(periods: FloatArray) -> FloatArray:
        return mean_spectrum(motions, np.ones(len(motions)), periods)

    corner, period = corner_period(spectrum), float(building.periods[0])
    full = response_spectrum_analysis(building.mass + goods, building.stiffness, spectrum)
    weight = sm.STANDARD_GRAVITY * float((building.mass + goods).sum())
    strength, elastic = building.yield_shear[0] / weight, full.base_shear / weight
    ductility = max(elastic / strength - 1.0, 0.0) * (1.0 + 0.6 * corner / full.modes.periods[0])
    growth = min(building.overstrength[0], 1.0 + building.second_slope[0] * ductility)
    coefficient = min(1.07 * elastic, strength * growth)
    level, mass = np.arange(1.0, building.storeys + 1.0), building.mass + goods
    heights = (goods @ level / goods.sum()) / (mass @ level / mass.sum())
    ratio = min(period / corner, 1.5)
    power = 1.2 * (1.0 + ratio) if yields else 1.0 + 0.5 * ratio
    return lambda mu: float(min(1.0, (mu / coefficient / np.sqrt(heights)) ** power))


def drawn(draw: np.random.Generator) -> tuple[dict[str, Any], sm.Building, FloatArray]:
    """Return what describes a building, the building without a strength, and its goods (kg)."""
    period = float(0.1 * 30.0 ** draw.random())
    possible = [n for n in (1, 2, 3, 4, 6, 8, 12) if n >= np.ceil(period / 1.2) and n <= max(1, int(period / 0.06))]
    storeys = int(draw.choice(possible or [12]))
    alpha = float(draw.choice([0.25, 0.5, 1.0, 1.5, 2.0, 3.0]))
    slope = float(draw.choice([0.0, 0.02, 0.05, 0.1, 0.2], p=[0.12, 0.22, 0.22, 0.22, 0.22]))
    overstrength = float(draw.choice([1.0, 1.5, 2.0, 3.0, 4.0], p=[0.1, 0.25, 0.25, 0.2, 0.2]))
    bare = sm.Building.uniform(
        storeys, period, mass=1e5, overstrength=overstrength, second_slope=slope, heights=STOREY_HEIGHT
    )
    kind = str(draw.choice(["all floors", "bare roof", "any floors"])) if storeys > 1 else "all floors"
    ratios = np.full(storeys, alpha)
    if kind == "bare roof":
        ratios[-1] = 0.0
    if kind == "any floors":
        ratios *= draw.random(storeys) * (draw.random(storeys) < 0.7)
        ratios[int(draw.integers(storeys))] = alpha
    goods = ratios * bare.mass
    gravity = (bare.mass + goods) * sm.STANDARD_GRAVITY
    stability = np.cumsum(gravity[::-1])[::-1] / (bare.stiffness * STOREY_HEIGHT)
    p_delta = bool(draw.random() < 0.4 and stability.max() < LARGEST_STABILITY)
    labels = {"storeys": storeys, "period": period, "goods": kind, "alpha": alpha, "p_delta": p_delta}
    labels |= {"second_slope": slope, "overstrength": overstrength}
    labels |= {"R": float(draw.choice([1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0]))}
    labels |= {"design_share": float(draw.choice([0.0, 0.25, 0.25, 0.5, 0.8]))}
    return labels, bare.replace(gravity_load=gravity if p_delta else None), goods


def on_floors(ratios: FloatArray, mu_k: float, mu_s: float) -> list[sm.Block]:
    """Return goods on the floors that carry some."""
    loaded = [(floor, float(ratio)) for floor, ratio in enumerate(ratios, start=1) if ratio > 0.0]
    return [sm.Block(floor, mass_ratio=ratio, mu_s=mu_s, mu_k=mu_k) for floor, ratio in loaded]


def cases_of(suite: Suite, labels: dict[str, Any], bare: sm.Building, goods: FloatArray) -> Iterator[dict[str, Any]]:
    """Solve a building and yield a case for each friction; none where its models collapse."""
    target = TARGETS[labels["target"]]
    period = float(sm.design.vibration_modes(bare.mass + goods, bare.stiffness).periods[0])
    factors = np.ones(len(suite))
    if labels["suite"] != "matched":
        factors = sm.scaling.scale_asce7_10(suite, target, period, between=False).factors
    motions = [record.scaled(float(factor)).motion for record, factor in zip(suite, factors, strict=True)]
    named = named_motions(motions, "rules")
    design = response_spectrum_analysis(bare.mass + labels["design_share"] * goods, bare.stiffness, target)
    elastic = labels["R"] == 1.0
    building = bare if elastic else bare.replace(yield_shear=design.storey_shear / labels["R"])
    scene = sm.Scene(building, sm.blocks_on_floors((goods / bare.mass).tolist(), mu=1.0))
    model = solve([attached(scene, float(share), "same") for share in SHARES], named)
    if (model.drift.max(axis=2) >= model.cap).mean(axis=1).max() > MOST_AT_CAP:
        return
    weight = full_weight(scene)
    shear = float(model.base_shear[-1].mean()) / weight
    yields = bool((model.capped[-1].mean(axis=0) > building.yield_shear / building.stiffness / STOREY_HEIGHT).any())
    earlier = two_exponents(building, goods, motions, yields)
    accelerations = [
        float(np.asarray(values)[0]) / sm.STANDARD_GRAVITY
        for values in (target([labels["period"]]), mean_spectrum(motions, factors**0, [labels["period"]]))
    ]
    of_target, of_motions = (float(floor_coefficient(one, building.yield_shear[0] / weight)) for one in accelerations)
    cases = [(eta, static, eta * shear) for static in STATIC for eta in ETAS]
    real = solve([sm.Scene(building, on_floors(goods / bare.mass, mu, static * mu)) for _, static, mu in cases], named)
    reasons = exceptions(building, float((goods / bare.mass).max()))
    for place, (eta, static, mu) in enumerate(cases):
        yield {
            **labels,
            "eta": eta,
            "static": static,
            "mu": mu,
            "c1": of_target,
            "c1_of_motions": of_motions,
            "ordinary": not reasons,
            "earlier": earlier(mu),
            "real": float(real.largest[place].mean()),
            "curve": model.largest.mean(axis=1).tolist(),
        }


def solved(name: str, buildings: int, seed: int) -> pl.DataFrame:
    """Return the cases of a suite."""
    suite, began, rows = suite_of(name), time.perf_counter(), list[dict[str, Any]]()
    draw = np.random.default_rng([seed, list(SUITES).index(name)])
    for number in range(buildings):
        labels, bare, goods = drawn(draw)
        labels |= {"suite": name, "building": number + 1}
        labels["target"] = 0.57 if name == "matched" else float(draw.choice(list(TARGETS), p=[0.6, 0.2, 0.2]))
        rows += cases_of(suite, labels, bare, goods)
        if number % 10 == 9:
            print(f"{name}: {number + 1} buildings, {time.perf_counter() - began:.0f} s", flush=True)
    return pl.DataFrame(rows).with_columns(pl.col("curve").cast(pl.List(pl.Float32)), drawn=pl.lit(buildings))


def shares_of(cases: pl.DataFrame) -> dict[str, FloatArray]:
    """Return the share of each case by each rule that is compared."""
    names = ("mu", "static", "c1", "c1_of_motions")
    mu, static, of_target, of_motions = (cases[name].to_numpy() for name in names)
    mean = 0.5 * (1.0 + static) * mu
    offset = np.where(cases["ordinary"].to_numpy(), OFFSET, SMALL_OFFSET)
    return {
        RULE: share_by_hand(mean, of_target, offset),
        "the same, S_a of the motions": share_by_hand(mean, of_motions, offset),
        "the same, mu_k in place of mu": share_by_hand(mu, of_target, offset),
        "the same, mu_s in place of mu": share_by_hand(static * mu, of_target, offset),
        "- 0.10 for all": share_by_hand(mean, of_target, SMALL_OFFSET),
        "- 0.20 for all": share_by_hand(mean, of_target, 0.20),
        "- 0.10 for all, S_a of the motions": share_by_hand(mean, of_motions, SMALL_OFFSET),
        "min(1, eta_h^p), earlier": cases["earlier"].to_numpy(),
        "ASCE 7 storage, 0.25": np.full(len(mu), 0.25),
    }


def ratios_of(cases: pl.DataFrame, shares: FloatArray) -> FloatArray:
    """Return drift of the model with a share over that of the building with sliding goods."""
    curves = np.array(cases["curve"].to_list(), dtype=np.float64)
    model = np.array([np.interp(share, SHARES, curve) for share, curve in zip(shares, curves, strict=True)])
    ratio: FloatArray = model / cases["real"].to_numpy()
    return ratio


def kept() -> pl.DataFrame | None:
    """Return the stored cases."""
    return pl.read_parquet(RESULTS) if RESULTS.exists() else None


def unsafe_text(unsafe: NDArray[np.bool_]) -> str:
    """Return the share of unsafe cases with its binomial interval of 95 %."""
    from scipy.stats import binomtest

    count = int(unsafe.sum())
    ends = binomtest(count, len(unsafe)).proportion_ci(0.95, method="exact")
    return f"{100.0 * count / len(unsafe):.1f} % [{100.0 * ends.low:.1f}, {100.0 * ends.high:.1f}]"


def lines(table: pl.DataFrame) -> list[str]:
    """Return the tables as text."""
    sliding = table.filter(pl.col("eta") >= NEAR_ONE)
    text = [
        f"Model over real drift, cases with eta from {NEAR_ONE:g} to 1.",
        f"unsafe: the real building drifts more than {UNSAFE:g} x the model",
        "in brackets: binomial interval of 95 %; cases of one building are not independent",
        "ordinary: Omega from 1.5, r2 above 0 to 0.1, alpha to 2, or elastic; buildings",
        f"with drifts at the cap under more than {MOST_AT_CAP:g} of the motions are left out",
    ]
    groups = [(title, sliding.filter(suite=name)) for name, title in SUITES.items()]
    for title, group in [*groups, ("all four", sliding)]:
        for kind, cases in (("all buildings", group), ("ordinary", group.filter("ordinary"))):
            if not cases.height:
                continue
            count = cases.select("suite", "building").n_unique()
            drawn_in_all = int(group.group_by("suite").agg(pl.col("drawn").first())["drawn"].sum())
            text += ["", f"{title}; {kind}: {cases.height} cases of {count} buildings of {drawn_in_all} drawn"]
            text.append(f"{'':36}{'mean':>6}{'worst':>7}  {'unsafe':20}buildings with an unsafe case")
            for rule, shares in shares_of(cases).items():
                ratio = ratios_of(cases, shares)
                unsafe = 1.0 / ratio > UNSAFE
                within = cases.filter(pl.Series(unsafe)).select("suite", "building").n_unique()
                text.append(
                    f"{rule:36}{np.exp(np.log(ratio).mean()):6.3f}{ratio.min():7.2f}  {unsafe_text(unsafe):20}{within}"
                )
    for kind, cases in (("all buildings", sliding), ("ordinary", sliding.filter("ordinary"))):
        text += ["", f"Unsafe cases in % by class, all four suites, {kind}"]
        for title, (column, edges) in CLASSES.items():
            values = cases[column].to_numpy().astype(np.float64)
            members = [(low <= values) & (values < high) for low, high in pairwise(edges)]
            ends = [(min(values[m]), max(values[m])) if m.any() else None for m in members]
            names = ["-" if each is None else "-".join(f"{end:g}" for end in dict.fromkeys(each)) for each in ends]
            width = 8
            if column == "period":
                names, title, width = [f"{low:g}" for low, _ in pairwise(edges)], f"{title}, from", 7
            text.append(f"{title:36}" + "".join(f"{name:>{width}}" for name in names))
            text.append(f"{'cases':36}" + "".join(f"{int(m.sum()):{width}d}" for m in members))
            for rule, shares in list(shares_of(cases).items())[:-1]:
                unsafe = 1.0 / ratios_of(cases, shares) > UNSAFE
                cells = [f"{100.0 * unsafe[m].mean():.1f}" if m.any() else "-" for m in members]
                text.append(f"  {rule:34}" + "".join(f"{cell:>{width}}" for cell in cells))
    return text


def say(page: Any, table: pl.DataFrame) -> None:
    """Put in the numbers that stand in sentences."""
    sliding = table.filter(pl.col("eta") >= NEAR_ONE)
    ratios = {rule: ratios_of(sliding, shares) for rule, shares in shares_of(sliding).items()}
    unsafe = {rule: 1.0 / ratio > UNSAFE for rule, ratio in ratios.items()}
    worst = dict.fromkeys(unsafe, 0.0)
    for column, edges in CLASSES.values():
        values = sliding[column].to_numpy().astype(np.float64)
        for low, high in pairwise(edges):
            member = (low <= values) & (values < high)
            if member.sum() >= LEAST_CASES:
                worst = {rule: max(share, float(unsafe[rule][member].mean())) for rule, share in worst.items()}
    earlier, strict = (next(rule for rule in unsafe if part in rule) for part in ("earlier", "S_a of the motions"))
    numbers = [f"{100.0 * share:.1f} %" for rule in (RULE, earlier) for share in (unsafe[rule].mean(), worst[rule])]
    said = "The rule is unsafe in {} of the cases and in at most {} of those of a class, the rule of earlier versions "
    page.words(f"{said}in {{}} and in up to {{}}. Its", *numbers)
    means = [f"{np.exp(np.log(ratios[rule]).mean()):.2f}" for rule in (RULE, earlier)]
    page.words("models drift {} times the real buildings in the mean, those of earlier versions {} times.", *means)
    page.words("design spectrum the rule is unsafe in {} of the cases:", f"{100.0 * unsafe[strict].mean():.1f} %")
    matched = unsafe[RULE][(sliding["suite"] == "matched").to_numpy()]
    page.words("hand: the rule is unsafe in {} of their cases.", f"{100.0 * matched.mean():.1f} %")


def main() -> None:
    """Solve, keep, print and write as the options say."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--suites", nargs="*", choices=tuple(SUITES), default=[])
    parser.add_argument("--buildings", type=int, default=60)
    parser.add_argument("--seed", type=int, default=58)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    for name in options.suites:
        new, before = solved(name, options.buildings, options.seed), kept()
        if before is not None:
            new = pl.concat([before.filter(pl.col("suite") != name), new], how="vertical_relaxed")
        new.write_parquet(RESULTS, compression="zstd")
    table = kept()
    if table is None:
        parser.error("nothing is kept yet: name --suites")
    print("\n".join(lines(table)))
    if options.write:
        page = page_module("parts").Page(PAGE)
        page.block("rules", lines(table))
        say(page, table)
        page.write()


if __name__ == "__main__":
    main()
