"""ASCE 7-10 scaling: the properties that make its factors unique, and what it refuses."""

import re

import numpy as np
import pytest

import seismass as sm

G = 9.80665


@pytest.fixture(scope="module")
def suite() -> list[sm.Record]:
    return list(sm.builtin_suite("seven"))


@pytest.fixture(scope="module")
def result(suite: list[sm.Record]) -> sm.scaling.ScalingResult:
    return sm.scaling.scale_asce7_10(suite, sm.TargetSpectrum.asce7())


def test_mean_touches_the_target_at_the_periods_alone_where_that_is_asked_for(suite: list[sm.Record]) -> None:
    result = sm.scaling.scale_asce7_10(suite, sm.TargetSpectrum.asce7(), between=False)
    ratio = result.mean / result.target
    # SF2 and the mean are rounded once each.
    assert ratio.min() == pytest.approx(1.0, abs=4e-16)
    assert result.periods[np.argmin(ratio)] == result.governing_period


def test_mean_is_nowhere_below_the_target_between_the_periods(
    suite: list[sm.Record], result: sm.scaling.ScalingResult
) -> None:
    """3001 periods that scaling does not use; 1e-6 is what a minimum can lie below the nearest that it looks at.

    At the hundred periods alone the mean is 0.9982 of the target between two.
    """
    target = sm.TargetSpectrum.asce7()
    periods = np.geomspace(result.periods[0], result.periods[-1], 3001)
    spectra = sm.response_spectrum(suite, periods, result.damping)
    mean = np.mean(result.factors[:, None] * spectra, axis=0)
    assert 1.0 - 1e-6 <= np.min(mean / target(periods)) <= 1.0 + 1e-3
    alone = sm.scaling.scale_asce7_10(suite, target, between=False)
    assert np.min(mean / target(periods)) * alone.common / result.common == pytest.approx(0.9982, abs=1e-4)
    assert result.governing_period in result.periods
    with pytest.raises(sm.errors.InvalidOption, match="between of scaling must be True or False"):
        sm.scaling.scale_asce7_10(suite, target, between=None)  # type: ignore[arg-type]


def test_periods_are_a_hundred_in_geometric_spacing_with_the_ends(result: sm.scaling.ScalingResult) -> None:
    assert len(result.periods) == 100
    assert result.periods[[0, -1]].tolist() == pytest.approx([0.2, 1.5], rel=1e-15)
    steps = result.periods[1:] / result.periods[:-1]
    np.testing.assert_allclose(steps, (1.5 / 0.2) ** (1.0 / 99.0), rtol=1e-13)


def test_individual_factors_minimise_the_distance_in_logarithms(
    suite: list[sm.Record], result: sm.scaling.ScalingResult
) -> None:
    spectra = sm.response_spectrum(suite, result.periods)
    for row, factor in zip(spectra, result.individual, strict=True):

        def distance(scale: float, row: np.ndarray = row) -> float:
            return float(np.sum(np.log(scale * row / result.target) ** 2))

        assert distance(factor) < min(distance(1.001 * factor), distance(factor / 1.001))
    np.testing.assert_allclose(result.factors, result.individual * result.common, rtol=1e-15)
    np.testing.assert_allclose(result.spectra, result.factors[:, None] * spectra, rtol=1e-15)


def test_amplitude_of_a_record_does_not_matter(suite: list[sm.Record], result: sm.scaling.ScalingResult) -> None:
    changed = [record.scaled(factor) for record, factor in zip(suite, [3.0, -0.1, 1, 7, 1, 1, 2.5], strict=True)]
    again = sm.scaling.scale_asce7_10(changed, sm.TargetSpectrum.asce7())
    np.testing.assert_allclose(again.factors * [3.0, 0.1, 1, 7, 1, 1, 2.5], result.factors, rtol=1e-12)


def test_doubling_the_target_doubles_the_factors(suite: list[sm.Record], result: sm.scaling.ScalingResult) -> None:
    double = sm.scaling.scale_asce7_10(suite, sm.TargetSpectrum.asce7(2 * 1.07, 2 * 0.61))
    np.testing.assert_allclose(double.factors, 2.0 * result.factors, rtol=1e-12)


def test_tables_hold_the_factors_and_spectra(suite: list[sm.Record], result: sm.scaling.ScalingResult) -> None:
    table = result.table()
    assert table["record"].to_list() == [record.name for record in suite]
    assert table["motion"].to_list() == list(range(1, 8))
    assert table["factor"].to_list() == result.factors.tolist()
    alone = sm.scaling.scale_asce7_10(suite, sm.TargetSpectrum.asce7(), between=False)
    assert result.spectrum_table()["ratio"].min() == pytest.approx(result.common / alone.common, rel=1e-12)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"period": 0.0}, sm.errors.InvalidOption, "period of scaling must be a positive number; got 0"),
        ({"period": "1"}, sm.errors.InvalidOption, "period of scaling must be a number; got '1'"),
        (
            {"period_range": (1.5, 0.2)},
            sm.errors.InvalidOption,
            "period_range of scaling must be two positive multiples",
        ),
        ({"period_range": 0.2}, sm.errors.InvalidOption, "period_range of scaling must be two positive multiples"),
        ({"period_range": (0.2, "b")}, sm.errors.InvalidOption, "period_range of scaling must be a number; got 'b'"),
        ({"count": 1}, sm.errors.InvalidOption, "count of scaling must be a whole number of at least 2; got 1"),
        ({"count": 10.5}, sm.errors.InvalidOption, "count of scaling must be a whole number of at least 2; got 10.5"),
        (
            {"damping": -0.05},
            sm.errors.InvalidOption,
            "damping of spectrum 1 must be at least 0 and below 1; got -0.05",
        ),
        ({"damping": [0.05]}, sm.errors.InvalidOption, "damping of scaling must be a number; got [0.05]"),
        ({"target": 1.0}, sm.errors.InvalidOption, "target of scaling must be a TargetSpectrum; got 1.0"),
        (
            {"records": [sm.Motion([1.0], 0.01)] * 2},
            sm.errors.InvalidMotion,
            "records of scaling must be at least three",
        ),
        (
            {"records": [sm.Motion([1.0], 0.01)] * 2 + [sm.Motion([0.0, 0.0], 0.01)]},
            sm.errors.InvalidMotion,
            "acceleration of motion 3 must be other than zero somewhere; got zero throughout",
        ),
    ],
)
def test_bad_arguments_are_refused(
    suite: list[sm.Record], arguments: dict, error: type[sm.SeismassError], message: str
) -> None:
    given = {"records": suite, "target": sm.TargetSpectrum.asce7()} | arguments
    with pytest.raises(error, match=re.escape(message)):
        sm.scaling.scale_asce7_10(**given)


def test_range_outside_the_target_is_refused(suite: list[sm.Record], tmp_path) -> None:
    file = tmp_path / "short.csv"
    file.write_text("T,Sa (g)\n0.3,1.0\n2.0,0.3\n")
    with pytest.raises(sm.errors.InvalidOption, match=r"period of target spectrum must be from 0.3 s to 2 s"):
        sm.scaling.scale_asce7_10(suite, sm.TargetSpectrum.from_csv(file))
