"""Two directions: the cases that benchmarks/two_directions.py solved, kept in its results."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import Any, Final

import numpy as np
from matplotlib.figure import Figure

import seismass as sm
from pages.parts import ROOT, Page, table
from seismass.base.values import FloatArray, signed
from seismass.effective_mass.rule import REDUCED_FRICTION, RULE, by_period, share_by_hand
from seismass.show.plots import FloorPlan, Footprint, floor_paths

SUITES: Final = ("far_field", "other", "forty")
"""In the order of the page; the factor was chosen on the first."""
CODES: Final = {
    "none, 0": 0.0,
    "ASCE 7 storage, 0.25": 0.25,
    "IS 1893, 0.5": 0.5,
    "NBC and NZS 1170.5, 0.6": 0.6,
    "Eurocode 8, 0.8": 0.8,
    "all, 1": 1.0,
}

Case = dict[str, Any]


def fill(page: Page) -> None:
    """Put in the tables and what is said of them."""
    found = kept()
    cases = found["cases"]
    base = sliding(cases, "far_field")
    slid = [case for case in base if case["slip_one"] > 1e-3]
    one, two = numbers(base, "value_one"), numbers(base, "value_two")
    of_suites = [own for suite in SUITES if (own := sliding(cases, suite))]
    for of in (drift_table, slip_table, rule_table):
        page.tables(*map(of, of_suites))
    page.tables(code_table(base), factor_table(cases))
    page.words(
        "Peak drift in a direction, two over one: {} of {} cases.", spread(numbers(base, "drift_ratio")), len(base)
    )
    higher = int(np.sum(two > one + 0.005))
    change = spread(two - one, "+.2f")
    page.words("Effective fraction, two minus one: {}; higher in {} of {}.", change, higher, len(base))
    for said, name in (
        ("Peak slip in a direction, two over one: {}, {} times in sum;", "slip_ratio"),
        ("over that in one direction: {}, {} times in sum.", "length_ratio"),
    ):
        page.words(said, spread(numbers(slid, name)), f"{in_sum(slid, name):.2f}")
    failed, runs = (sum(case[name] for case in cases) for name in ("failed", "pairs"))
    reached = f"All but {failed} of {failed + runs}" if failed else f"All {runs}"
    page.words("\n\n{} runs in two directions reach their end.", reached)
    page.words("mu counts {} times: lambda = 1.35 x {} mu/C1 - 0.15 ", *[f"{REDUCED_FRICTION:g}"] * 2)
    said = "building of {} storeys with stated strengths in two directions under {} pairs ({} of them turned in plan), "
    said += "with its three frictions, takes {} s of {} cores, {} s of processor"
    timed = ("storeys", "pairs", "turned", "seconds", "cores", "processor_seconds")
    page.words(said, *(f"{found['assess'][name]:.0f}" for name in timed))
    page.figure("two_directions_paths", paths)


def kept() -> dict[str, Any]:
    """Return what is stored."""
    file = ROOT / "benchmarks" / "results" / "two_directions.json"
    found: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    return found


def sliding(cases: Sequence[Case], suite: str) -> list[Case]:
    """Return the cases of a suite in which goods slide in one direction."""
    return [case for case in cases if case["suite"] == suite and case["slides"]]


def groups(cases: Sequence[Case]) -> list[tuple[str, list[Case]]]:
    """Return all cases, and those by eta, period and R, each with its name."""
    found = [("all", list(cases))]
    for key, name in (("eta", "eta = {:g}"), ("period", "T = {:g} s"), ("R", "R = {:g}")):
        values = sorted({case[key] for case in cases})
        found += [(name.format(value), [case for case in cases if case[key] == value]) for value in values]
    return found


def numbers(cases: Sequence[Case], name: str) -> FloatArray:
    """Return a number of every case that has it."""
    return np.array([case[name] for case in cases if case[name] is not None])


def spread(values: FloatArray, form: str = ".2f") -> str:
    """Return the mean of values with the smallest and the largest."""
    if not len(values):
        return "-"
    mean, low, high = (signed(float(value), form) for value in (values.mean(), values.min(), values.max()))
    return f"{mean} ({low} to {high})"


def drift_table(cases: Sequence[Case]) -> str:
    """Return drift and effective fraction of two directions beside one."""
    rows = []
    for name, own in groups(cases):
        one, two, larger = (numbers(own, f"value_{which}") for which in ("one", "two", "larger"))
        between = np.mean([[case["drift_ratios"][1], case["drift_ratios"][3]] for case in own], axis=0)
        drift = spread(numbers(own, "drift_ratio")), f"{between[0]:.2f} to {between[1]:.2f}"
        shares = f"{one.mean():.2f}", f"{two.mean():.2f}", spread(two - one, "+.2f"), f"{larger.mean():.2f}"
        rows.append([name, len(own), *drift, *shares])
    heads = "cases | number | drift, two over one | pairs, 16 to 84 % | lambda, one | two | change"
    return table(f"{heads} | two, larger of x and y", rows)


def slip_table(cases: Sequence[Case]) -> str:
    """Return slip of two directions over that of one."""
    rows = []
    for name, own in groups(cases):
        slid = [case for case in own if case["slip_one"] > 1e-3]
        if not slid:
            continue
        of_pairs = [case["slip_ratios"] for case in slid if case["slip_ratios"] is not None]
        between = np.mean([[each[1], each[3]] for each in of_pairs], axis=0)
        ratios = spread(numbers(slid, "slip_ratio")), f"{between[0]:.2f} to {between[1]:.2f}"
        slip = f"{1e3 * numbers(slid, 'slip_one').mean():.0f} mm"
        rows.append([name, len(slid), *ratios, spread(numbers(slid, "length_ratio")), slip])
    heads = "cases | number | slip in x or y, two over one | pairs, 16 to 84 % | length over one | slip, one"
    return table(heads, rows)


def in_sum(cases: Sequence[Case], name: str) -> float:
    """Return a ratio of slips over that of one direction, of the sums over all cases."""
    weights = [case["slip_one"] * case["pairs"] for case in cases]
    return float(np.average([case[name] for case in cases], weights=weights))


def model_ratio(case: Case, share: float, real: str) -> float:
    """Return the drift of the model with a share attached over the real one, "real_one" or "real_two"."""
    curve = np.array(case["curve"])
    return float(np.interp(share, np.linspace(0.0, 1.0, len(curve)), curve) / case[real])


def code_table(cases: Sequence[Case]) -> str:
    """Return how often a code's share is too little, in one direction and in two."""
    rows = []
    for name, share in CODES.items():
        cells = [name]
        for real in ("real_one", "real_two"):
            ratio = np.array([model_ratio(case, share, real) for case in cases])
            cells += [f"{np.exp(np.log(ratio).mean()):.2f}", f"{100.0 * np.mean(1.0 / ratio > 1.05):.0f} %"]
        rows.append(cells)
    return table("share attached | model/real, one | unsafe, one | model/real, two | unsafe, two", rows)


RULES: Final[dict[str, Callable[[Case], float]]] = {
    f"{RULE}, of one direction": lambda case: _by_hand(case, 1.0),
    "two directions: 0.8 mu in it": lambda case: _by_hand(case, REDUCED_FRICTION),
}
"""Rules that are compared with the runs in two directions."""


def _by_hand(case: Case, factor: float) -> float:
    return float(share_by_hand(factor * case["mu"], case["coefficient"]))


def rule_table(cases: Sequence[Case]) -> str:
    """Return how rules do in two directions by class of period."""
    period = numbers(cases, "period")
    rows = []
    for name, rule in RULES.items():
        ratio = np.array([model_ratio(case, rule(case), "real_two") for case in cases])
        whole = by_period(name, ratio, np.full(len(ratio), 1.0))[0]
        cells = [name, _judged(whole)]
        rows.append([*cells, *(_judged(row) for row in by_period(name, ratio, period))])
    classes = [f"T = {value:g} s" for value in sorted(set(period.tolist()))]
    return table(["rule", "all", *classes], rows)


def _judged(row: dict[str, Any]) -> str:
    return f"{row['bias']:.2f}, {row['worst']:.2f}, {100.0 * row['unsafe']:.0f} %"


def bias_of_factor(cases: Sequence[Case], factor: float) -> float:
    """Return the geometric mean of model over real drift of the rule with a factor of friction."""
    ratio = np.array([model_ratio(case, _by_hand(case, factor), "real_two") for case in cases])
    return float(np.exp(np.log(ratio).mean()))


def factor_table(cases: Sequence[Case]) -> str:
    """Return what other factors of friction would give."""
    suites = [suite for suite in SUITES if sliding(cases, suite)]
    rows = [
        [f"{factor:.2f}", *(f"{bias_of_factor(sliding(cases, suite), factor):.3f}" for suite in suites)]
        for factor in (0.7, 0.75, 0.8, 0.85, 0.9, 1.0)
    ]
    return table(["factor of mu", *suites], rows)


def paths() -> Figure:
    """Return the figure of goods on a floor: pallets and a machine beside an aisle, under a built-in pair."""
    building = sm.Building.uniform(3, 0.47, mass=1e5, heights=3.5, yield_shear_over_weight=[0.34, 0.27, 0.13])
    goods = [sm.Block(1, mass_ratio=share, mu=mu) for share, mu in ((0.2, 0.12), (0.2, 0.2), (0.2, 0.3), (0.1, 0.15))]
    scene = sm.Scene(building, goods, other_direction=True)
    response = sm.simulate(scene, sm.records.builtin_pairs()[8].scaled(1.5), histories=True)
    standing = {
        1: Footprint(0.9, 2.6),
        2: Footprint(2.7, 2.6),
        3: Footprint(4.5, 2.6),
        4: Footprint(1.2, 0.55, 1.6, 0.8),
    }
    plan = FloorPlan((0.0, 0.0, 5.6, 3.4), standing, ((0.0, 1.05, 5.6, 2.1),))
    return floor_paths(response, floor=1, plan=plan)
