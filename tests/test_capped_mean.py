"""The capped mean of drifts: its definition, and that nothing jumps where a parameter moves a run through collapse."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.base.errors import InvalidOption
from seismass.base.statistics import capped, few_collapses
from seismass.runs.peaks import named_motions, solve

SUITE = [record.scaled(1.5) for record in sm.builtin_suite("seven")]
HALVINGS = 20
"""Of a step across a collapse: the peak of a run that just survives grows as the square root of what is left."""


def building(strength: float, period: float, load: float, mu: float, storeys: int) -> sm.Scene:
    """A shear building with P-Delta and goods on all floors but the roof, without hardening after the second yield."""
    shape = np.linspace(1.0, 0.55, storeys)
    frame = sm.Building.uniform(
        storeys,
        period,
        yield_shear_over_weight=(strength * shape).tolist(),
        second_slope=0.03,
        heights=3.6,
        gravity_load=13.0 * sm.Building.uniform(storeys, period).mass,
    )
    ratios = np.full(storeys, load)
    ratios[-1] = load if storeys == 1 else 0.0
    return sm.Scene(frame, sm.blocks_on_floors(ratios, mu))


def peaks_of(scene: sm.Scene, cap: float = 0.10) -> Any:
    return solve([scene], named_motions(SUITE, "test"), drift_cap=cap)


def walk(number: int) -> Callable[[float], sm.Scene]:
    """One of strength, period, load and friction of a random building, from 0 to 1 through at least one collapse: the
    strongest of some buildings whose walk has one.
    """
    storeys, varied = 1 + number % 3, number % 4
    factor = [0.6, 1.3, 1.5, 16.0][varied]
    for seed in range(number, number + 3000, 1000):
        random = np.random.default_rng(seed)
        start = [0.4, random.uniform(0.25, 0.7), random.uniform(0.3, 1.5), random.uniform(0.04, 0.1)]
        for strength in 0.4 * 0.93 ** np.arange(28):

            def scene_at(place: float, values: tuple[float, ...] = (float(strength), *start[1:])) -> sm.Scene:
                varied_values = list(values)
                varied_values[varied] *= factor**place
                return building(*varied_values, storeys)

            if (peaks_of(scene_at(0.0)).collapsed != peaks_of(scene_at(1.0)).collapsed).any():
                return scene_at
    raise AssertionError(number)


def test_the_definition_by_hand() -> None:
    np.testing.assert_array_equal(capped(np.array([0.01, 0.1, 0.4]), 0.1), [0.01, 0.1, 0.1])
    assert [few_collapses(count, motions) for count, motions in ((1, 10), (1, 9), (4, 40), (5, 40))] == [1, 0, 1, 0]
    assert [few_collapses(count, 7, "median") for count in (3, 4)] == [True, False]


@pytest.mark.parametrize("cap", [0.02, 0.05, np.inf])
def test_drifts_of_single_runs_give_the_capped_mean(cap: float) -> None:
    """Peaks until a collapse, in every storey; the storey that collapses has its collapse drift."""
    scene = building(0.1, 0.6, 1.0, 0.3, 2)
    runs = [sm.simulate(scene, record) for record in SUITE]
    drifts = np.array([run.peak_drift_ratio for run in runs])
    found = sm.effective_mass(scene, SUITE, drift_cap=cap, statistic="median", fractions=[0.0, 1.0], resamples=2)
    assert 0 < sum(run.status == "collapsed" for run in runs) == found.collapses["real"]
    np.testing.assert_allclose(
        peaks_of(scene, cap).capped[0].mean(axis=0), np.minimum(drifts, cap).mean(axis=0), rtol=1e-12
    )
    assert found.real == pytest.approx(np.median(np.minimum(drifts, cap).max(axis=1)), rel=1e-12)
    assert (
        list(found.metadata["share_at_drift_cap"]) == [f"{0.5 * cap:g}", f"{2.0 * cap:g}"][: 2 if cap < np.inf else 1]
    )
    for cap_of_metadata, share in found.metadata["share_at_drift_cap"].items():
        other = {"drift_cap": float(cap_of_metadata), "statistic": "median", "fractions": [0.0, 1.0], "resamples": 2}
        again = sm.effective_mass(scene, SUITE, **other).curve.filter(storey=0)
        assert share == pytest.approx(line(again["model_drift"].to_list(), again["real_drift"][0]), abs=1e-9)


def line(model: list[float], real: float) -> float:
    """Share at which a straight line between two models has a drift."""
    return 0.0 if model[0] >= real else 1.0 if model[1] < real else (real - model[0]) / (model[1] - model[0])


def closed(scene_at: Callable[[float], sm.Scene]) -> tuple[Any, Any]:
    """Peaks on both sides of a collapse, so close to one another as the halvings of the walk leave them."""
    low, high = 0.0, 1.0
    one, other = peaks_of(scene_at(low)), peaks_of(scene_at(high))
    for _ in range(HALVINGS):
        between = peaks_of(scene_at(0.5 * (low + high)))
        if np.array_equal(between.collapsed, one.collapsed):
            low, one = 0.5 * (low + high), between
        else:
            high, other = 0.5 * (low + high), between
    return one, other


def nothing_jumps(number: int) -> None:
    """The largest drift of a run that collapses is that of the same run just before, and so is the mean of each storey,
    but for what the collapse leaves out of the history of the others.
    """
    one, other = closed(walk(number))
    assert (one.collapsed != other.collapsed).any()
    np.testing.assert_allclose(one.largest, other.largest, rtol=2e-2)
    means = [peaks.capped[0].mean(axis=0) for peaks in (one, other)]
    assert np.abs(means[0] - means[1]).max() < 0.1 * max(means[0].max(), means[1].max())


@pytest.mark.parametrize("number", range(8))
def test_nothing_jumps_at_a_collapse(number: int) -> None:
    nothing_jumps(number)


@pytest.mark.parametrize("number", range(8, 120))
def test_nothing_jumps_at_many_collapses(number: int) -> None:
    nothing_jumps(number)


@pytest.mark.parametrize("period", [0.3, 0.5])
def test_the_share_does_not_jump_at_the_first_collapse(period: float) -> None:
    """Of eleven motions one may bring a collapse of the building with sliding goods."""
    suite = [record.scaled(1.5) for record in sm.builtin_suite("eleven")]
    motions = named_motions(suite, "test")

    def collapses(strength: float) -> int:
        return int(solve([building(strength, period, 0.8, 0.12, 1)], motions).collapsed.sum())

    weak = next(strength for strength in 0.4 * 0.95 ** np.arange(40) if collapses(strength))
    strong = weak / 0.95
    for _ in range(HALVINGS):
        middle = 0.5 * (weak + strong)
        weak, strong = (middle, strong) if collapses(middle) else (weak, middle)
    pair = [building(strength, period, 0.8, 0.12, 1) for strength in (strong, weak)]
    found = [sm.effective_mass(scene, suite, fractions=np.linspace(0.0, 1.0, 11), resamples=2) for scene in pair]
    assert [one.collapses["real"] for one in found] == [0, 1]
    assert found[0].value == pytest.approx(found[1].value, abs=0.01)
    assert found[0].real == pytest.approx(found[1].real, rel=0.002)
    assert 0.1 < found[0].value < 0.9
    others = found[1].records.filter(~pl.col("collapsed"))["real_drift"].mean()
    assert others < found[1].real  # the mean without the run that collapses, by which the weaker building drifts less


@pytest.mark.parametrize("cap", [0.0, -0.1, np.nan, "much"])
def test_caps_that_are_none(cap: Any) -> None:
    scene = building(0.1, 0.6, 1.0, 0.3, 1)
    with pytest.raises(InvalidOption, match="drift_cap of effective mass must be a"):
        sm.effective_mass(scene, SUITE, drift_cap=cap)
