"""Least squares, Sa(T1) and the preset of ASCE 7-16: what defines their factors, diagnostics, figure, refusals."""

import re
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

import seismass as sm
from seismass.design.scaling.asce7 import DIRECTIONS

G = 9.80665
TARGET = sm.TargetSpectrum.asce7()
SUITE = list(sm.builtin_suite("seven"))
ELEVEN = [*SUITE[:7], *(record.time_scaled(1.3).replace(name=f"slow {record.name}") for record in SUITE[:4])]


def test_least_squares_in_the_logarithm_minimise_the_misfit() -> None:
    found = sm.scaling.scale_least_squares(SUITE, TARGET)
    spectra = sm.response_spectrum(SUITE, found.periods)
    # ln SF is the mean of ln A_t - ln A; then the mean of ln(scaled/target) is zero.
    np.testing.assert_allclose(np.log(found.spectra / found.target).mean(axis=1), 0.0, atol=1e-14)
    np.testing.assert_array_equal(found.factors, sm.scaling.scale_asce7_10(SUITE, TARGET).individual)
    np.testing.assert_allclose(found.spectra, found.factors[:, None] * spectra, rtol=1e-15)
    assert found.common == 1.0
    assert found.least_ratio < 1.0  # nothing lifts the mean


def test_least_squares_in_the_ordinates_minimise_the_differences() -> None:
    found = sm.scaling.scale_least_squares(SUITE, TARGET, space="linear")
    spectra = sm.response_spectrum(SUITE, found.periods)
    for row, factor in zip(spectra, found.factors, strict=True):
        best = np.linalg.lstsq(row[:, None], found.target, rcond=None)[0][0]
        assert factor == pytest.approx(best, rel=1e-12)


@pytest.mark.parametrize("period", [0.3, 1.0])
def test_sa_t1_meets_the_target_at_t1(period: float) -> None:
    found = sm.scaling.scale_sa_t1(SUITE, TARGET, period)
    at = sm.response_spectrum(SUITE, [period])[:, 0]
    np.testing.assert_allclose(found.factors * at, float(TARGET(period)), rtol=1e-14)
    assert found.period == period
    assert found.periods[[0, -1]].tolist() == pytest.approx([0.2 * period, 1.5 * period], rel=1e-15)
    assert sm.scaling.scale_sa_t1(SUITE[0], TARGET).names == (SUITE[0].name,)
    np.testing.assert_array_equal(sm.scaling.scale_sa_t1(iter(SUITE), TARGET, period).factors, found.factors)


@pytest.mark.parametrize(
    ("scale", "suite", "share"),
    [(partial(sm.scaling.scale_asce7_10, between=False), SUITE, 1.0), (sm.scaling.scale_asce7_16, ELEVEN, 0.9)],
)
def test_mean_of_each_preset_touches_what_is_asked_for(scale, suite: list[sm.Record], share: float) -> None:
    """Of ASCE 7-10 at its periods alone; between them, see test_scaling.py."""
    for period in (0.38, 1.0, 2.0):
        found = scale(suite, TARGET, period)
        ratio = found.mean / found.target
        assert ratio.min() == pytest.approx(share, abs=1e-12) == found.least_ratio
        assert found.periods[ratio.argmin()] == found.governing_period
        assert found.largest_ratio == ratio.max()
        np.testing.assert_allclose(found.factors, found.individual * found.common, rtol=1e-15)


@pytest.mark.parametrize(
    ("scale", "words", "clause"),
    [
        # 7-10: "not less than three appropriate ground motions"; 7-16: "not less than 11 ground motions".
        (sm.scaling.scale_asce7_10, "three", "ASCE/SEI 7-10, 16.1.3"),
        (sm.scaling.scale_asce7_16, "eleven", "ASCE/SEI 7-16, 16.2.2"),
    ],
)
def test_too_few_motions_are_told_the_clause(scale, words: str, clause: str) -> None:
    message = f"records of scaling must be at least {words} motions ({clause}); got 2"
    with pytest.raises(sm.errors.InvalidMotion, match=f"^{re.escape(message)}$"):
        scale(SUITE[:2], TARGET)


def test_too_short_a_range_is_told_the_clause() -> None:
    message = "longest of scaling must be at least 1.5 (ASCE/SEI 7-16, 16.2.3.1); got 1.49"
    with pytest.raises(sm.errors.InvalidOption, match=f"^{re.escape(message)}$"):
        sm.scaling.scale_asce7_16(ELEVEN, TARGET, longest=1.49)


def test_asce7_16_range() -> None:
    def ends(**options: object) -> list[float]:
        return sm.scaling.scale_asce7_16(ELEVEN, TARGET, **options).periods[[0, -1]].tolist()

    assert ends() == pytest.approx([0.2, 2.0], rel=1e-14)
    assert ends(period=0.5, longest=1.5) == pytest.approx([0.1, 0.75], rel=1e-14)
    # The period of 90 % of the mass counts where it is shorter than 0.2 T.
    assert ends(lowest_period=0.12) == pytest.approx([0.12, 2.0], rel=1e-14)
    assert ends(lowest_period=0.3) == pytest.approx([0.2, 2.0], rel=1e-14)


def test_asce7_16_of_a_building() -> None:
    building = sm.Building([1.0, 1.0, 1.0, 0.5, 3.0], [900.0, 700.0, 300.0, 20.0, 300.0])
    k = building.stiffness
    stiffness = np.diag(k + np.append(k[1:], 0.0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    squares, shapes = np.linalg.eigh(stiffness / np.sqrt(np.outer(building.mass, building.mass)))
    shares = (shapes.T @ np.sqrt(building.mass)) ** 2 / building.mass.sum()
    needed = int(np.searchsorted(np.cumsum(shares), 0.9))
    assert needed > 0
    periods = 2.0 * np.pi / np.sqrt(squares)
    found = sm.scaling.scale_asce7_16(ELEVEN, TARGET, building=building)
    assert found.period == pytest.approx(periods[0], rel=1e-12)
    assert found.periods[0] == pytest.approx(min(0.2 * periods[0], periods[needed]), rel=1e-12)
    assert len(found.notes) == 3  # no note that the period of the mass is missing


class Twin:
    """A pair as `scale_asce7_16` sees one: components at right angles with any ratio."""

    def __init__(self, record: sm.Record, ratio: float) -> None:
        self.first, self.dt, self.name = record, record.dt, f"pair of {record.name}"
        self.ratio = ratio

    def at_angles(self, degrees: np.ndarray) -> np.ndarray:
        turn = np.radians(degrees)[:, None]
        return (np.cos(turn) + self.ratio * np.sin(turn)) * self.first.acceleration


def test_asce7_16_takes_the_largest_spectrum_of_a_pair_over_directions() -> None:
    alone = sm.scaling.scale_asce7_16(ELEVEN, TARGET)
    pairs = sm.scaling.scale_asce7_16([Twin(record, 1.0) for record in ELEVEN], TARGET)
    # Equal components are sqrt(2) times one of them at 45 degrees, one of the 180 directions.
    assert DIRECTIONS % 4 == 0
    np.testing.assert_allclose(pairs.factors, alone.factors / np.sqrt(2.0), rtol=1e-12)
    assert pairs.names[0] == f"pair of {ELEVEN[0].name}"
    assert not any("single components" in note for note in pairs.notes)
    mixed = sm.scaling.scale_asce7_16([Twin(ELEVEN[0], 0.0), *ELEVEN[1:]], TARGET)
    np.testing.assert_allclose(mixed.factors, alone.factors, rtol=1e-12)
    assert "10 of 11 are single components" in mixed.notes[0]


def test_asce7_16_says_what_it_cannot_honour() -> None:
    remarks = " ".join(sm.scaling.scale_asce7_16(ELEVEN, TARGET).remarks)
    for what in ("maximum-direction", "MCE_R", "velocity pulse", "90 % of the mass"):
        assert what in remarks


def test_misfits_and_scatter() -> None:
    found = sm.scaling.scale_asce7_10(SUITE, TARGET)
    ratio = np.log(found.factors[:, None] * sm.response_spectrum(SUITE, found.periods) / TARGET(found.periods))
    np.testing.assert_allclose(found.misfit, np.sqrt((ratio**2).mean(axis=1)), rtol=1e-12)
    np.testing.assert_allclose(found.largest_misfit, np.abs(ratio).max(axis=1), rtol=1e-12)
    np.testing.assert_allclose(found.log_scatter, ratio.std(axis=0, ddof=1), rtol=1e-10)
    mean = np.log(np.exp(ratio).mean(axis=0))
    assert found.mean_misfit == pytest.approx(np.sqrt((mean**2).mean()), rel=1e-12)
    table = found.spectrum_table()
    np.testing.assert_allclose(table["p84"] / table["p16"], np.exp(2.0 * found.log_scatter), rtol=1e-12)
    middle = np.exp(ratio.mean(axis=0)) * found.target
    np.testing.assert_allclose(np.sqrt(table["p84"] * table["p16"]), middle, rtol=1e-12)
    assert found.diagnostics()["misfit"].to_list() == found.misfit.tolist()
    assert (sm.scaling.scale_sa_t1(SUITE[0], TARGET).log_scatter == 0.0).all()


def test_inputs_are_not_changed() -> None:
    before = [record.acceleration.copy() for record in ELEVEN]
    sm.scaling.scale_asce7_16(ELEVEN, TARGET)
    assert all(np.array_equal(record.acceleration, kept) for record, kept in zip(ELEVEN, before, strict=True))


def test_figure_shows_every_motion_and_what_is_compared() -> None:
    found = sm.scaling.scale_asce7_10(SUITE, TARGET)
    upper, lower = found.plot().axes
    # Seven motions, two bounds, mean, target, T.
    assert len(upper.lines) == 12
    assert upper.get_xlim() == pytest.approx((0.2, 1.5))
    np.testing.assert_allclose(lower.lines[0].get_ydata(), found.mean / found.target, rtol=1e-15)
    wide = found.plot(records=SUITE, target=TARGET).axes[0]
    assert wide.get_xlim() == pytest.approx((0.05, 4.0))
    (target,) = [line for line in wide.lines if line.get_label() == "target"]
    np.testing.assert_allclose(target.get_ydata(), TARGET(target.get_xdata()) / G, rtol=1e-12)
    labels = [text.get_text() for text in found.plot().legends[0].get_texts()]
    assert "compared, 0.2 to 1.5 s" in labels


@pytest.mark.parametrize(
    ("scale", "arguments", "error", "message"),
    [
        (
            sm.scaling.scale_least_squares,
            {"space": "cubic"},
            sm.errors.InvalidOption,
            "space of scaling must be log or linear",
        ),
        (
            sm.scaling.scale_least_squares,
            {"records": []},
            sm.errors.InvalidMotion,
            "motions of scaling must be at least one Record",
        ),
        (
            sm.scaling.scale_sa_t1,
            {"period": -1.0},
            sm.errors.InvalidOption,
            "period of scaling must be a positive number; got -1",
        ),
        (
            sm.scaling.scale_sa_t1,
            {"target": None},
            sm.errors.InvalidOption,
            "target of scaling must be a TargetSpectrum; got None",
        ),
        (
            sm.scaling.scale_asce7_16,
            {},
            sm.errors.InvalidMotion,
            "records of scaling must be at least eleven motions (ASCE/SEI 7-16, 16.2.2); got 7",
        ),
        (
            sm.scaling.scale_asce7_16,
            {"longest": 1.2},
            sm.errors.InvalidOption,
            "longest of scaling must be at least 1.5 (ASCE/SEI",
        ),
        (
            sm.scaling.scale_asce7_16,
            {"lowest_period": 0.0},
            sm.errors.InvalidOption,
            "lowest_period of scaling must be a positive",
        ),
        (
            sm.scaling.scale_asce7_16,
            {"building": 3.0},
            sm.errors.InvalidOption,
            "building of scaling must be a Building; got 3.0",
        ),
        (
            sm.scaling.scale_asce7_16,
            {"building": sm.Building.uniform(2, 0.5), "period": 1.0},
            sm.errors.InvalidOption,
            "period of scaling must be left out where a building is given; got 1.0",
        ),
        (
            sm.scaling.scale_asce7_16,
            {"building": sm.Building.uniform(2, 0.5), "lowest_period": 0.1},
            sm.errors.InvalidOption,
            "lowest_period of scaling must be left out where a building is given; got 0.1",
        ),
        (
            sm.scaling.scale_asce7_16,
            {"records": 3.0},
            sm.errors.InvalidMotion,
            "motions of scaling must be Records or Motions",
        ),
        (
            sm.scaling.scale_asce7_16,
            {"records": [SimpleNamespace()] * 11},
            sm.errors.InvalidMotion,
            "motion 1 of scaling must be a Record or Motion",
        ),
    ],
)
def test_bad_arguments_are_refused(scale, arguments: dict, error: type[sm.SeismassError], message: str) -> None:
    with pytest.raises(error, match=re.escape(message)):
        scale(**({"records": SUITE, "target": TARGET} | arguments))


@pytest.mark.parametrize(
    "scale",
    [
        sm.scaling.scale_sa_t1,
        sm.scaling.scale_least_squares,
        sm.scaling.scale_asce7_10,
        lambda suite, target: sm.scaling.scale_by_code(suite, target, 1.0, code_id="ec8"),
        lambda suite, target: sm.scaling.scale_modal_pushover(suite, target, period=0.5, yield_coefficient=0.2),
    ],
)
def test_a_target_may_be_text_as_in_files_and_commands(scale) -> None:
    suite = sm.builtin_suite("seven")
    by_text, by_object = (scale(suite, target) for target in ("asce7:1:0.6", sm.TargetSpectrum.asce7(1.0, 0.6)))
    np.testing.assert_array_equal(by_text.factors, by_object.factors)
