"""The site-based stochastic model: intensity, variance and frequency as its parameters say, ends at rest."""

import dataclasses
import math
import random
from typing import Any

import numpy as np
import pytest
from scipy import signal

import seismass as sm
from seismass.motions.records.synthetic.process import LEAST_FREQUENCY, end_state, filtered_noise, high_passed, normals

G = sm.STANDARD_GRAVITY
USUAL = sm.records.SyntheticParameters(
    arias=1.5, d5_95=9.0, t_mid=6.0, frequency=4.0, frequency_rate=-0.15, damping=0.3
)
STEADY = dataclasses.replace(USUAL, frequency_rate=0.0)


def crossing_times(process: np.ndarray, dt: float) -> list[np.ndarray]:
    """Times at which each motion crosses zero upwards."""
    return [dt * np.flatnonzero((motion[:-1] < 0.0) & (motion[1:] >= 0.0)) for motion in process]


@pytest.fixture(scope="module")
def ensemble() -> np.ndarray:
    """400 processes of unit variance, dt = 0.01 s, 24 s."""
    noise = normals(random.Random(2010), 400 * 2400).reshape(400, 2400)
    return filtered_noise(USUAL, noise, 0.01)


@pytest.mark.parametrize("d5_95", [0.3, 2.0, 9.0, 20.0, 29.3])
def test_modulation_has_its_intensity_duration_and_middle_exactly(d5_95: float) -> None:
    chosen = dataclasses.replace(USUAL, d5_95=d5_95)
    time = np.linspace(0.0, 20.0 * max(d5_95, 6.0), 2_000_001)
    husid = np.cumsum(chosen.standard_deviation(time) ** 2) * (time[1] - time[0]) * math.pi / (2.0 * G)
    # Sums on a grid of 6e-5 s or finer; close to 29.4 the density starts steeply.
    assert husid[-1] == pytest.approx(1.5, rel=1e-4)
    early, middle, late = np.interp((0.05, 0.45, 0.95), husid / husid[-1], time)
    assert late - early == pytest.approx(d5_95, rel=1e-3)
    assert middle == pytest.approx(6.0, rel=1e-3)
    assert np.all(chosen.standard_deviation(np.array([-1.0, 0.0])) == 0.0)


def test_modulation_where_the_density_is_exponential() -> None:
    # k = 1: t45 = -ln 0.55 scale, t95 - t05 = ln(0.95 / 0.05) scale, whose ratio, 4.925, is just beyond what is taken.
    ratio = math.log(19.0) / -math.log(0.55)
    shape, scale = dataclasses.replace(USUAL, d5_95=4.9, t_mid=1.0).modulation
    assert ratio == pytest.approx(4.925, abs=1e-3)
    assert 1.0 < shape < 1.02
    assert scale == pytest.approx(1.0 / -math.log(0.55), rel=0.01)


def test_mean_of_many_motions_is_what_the_parameters_say(ensemble: np.ndarray) -> None:
    """Arias intensity and Husid curve before the high-pass; four standard errors of the mean, found from the sample."""
    time = 0.01 * np.arange(ensemble.shape[1])
    husid = np.cumsum((USUAL.standard_deviation(time) * ensemble) ** 2, axis=1) * 0.01 * math.pi / (2.0 * G)
    for share in (0.05, 0.45, 0.95):
        # t_mid is given; t_5 and t_95 are D5-95 apart, and the mean curve passes through their shares.
        at = np.interp(share, np.cumsum(USUAL.standard_deviation(time) ** 2) * 0.01 * math.pi / (2.0 * G * 1.5), time)
        found = husid[:, round(at / 0.01)]
        assert abs(found.mean() - share * 1.5) < 4.0 * found.std(ddof=1) / 20.0
        assert 4.0 * found.std(ddof=1) / 20.0 < 0.12 * share * 1.5
    assert abs(husid[:, -1].mean() - 1.5) < 4.0 * husid[:, -1].std(ddof=1) / 20.0
    mean = husid.mean(axis=0) / husid[:, -1].mean()
    early, middle, late = np.interp((0.05, 0.45, 0.95), mean, time)
    # A twentieth of the duration: the scatter of a quantile of the mean curve of 400 motions is some 1 % of it.
    assert late - early == pytest.approx(USUAL.d5_95, rel=0.05)
    assert middle == pytest.approx(USUAL.t_mid, rel=0.05)


def test_variance_is_one_and_no_sample_knows_later_noise() -> None:
    weights = filtered_noise(USUAL, np.eye(500), 0.02)  # row i: what noise i does to each sample
    assert np.all(np.tril(weights) == 0.0)
    np.testing.assert_allclose(np.sum(weights**2, axis=0)[1:], 1.0, rtol=1e-13)
    assert np.all(weights[:, 0] == 0.0)


def test_process_of_one_frequency_is_the_known_autoregression() -> None:
    # Samples of exp(-z w t) sin(w_d t) are the impulse response of x_k = a x_(k-1) - b x_(k-2) + e_(k-1) with
    # a = 2 exp(-z w dt) cos(w_d dt), b = exp(-2 z w dt): correlation a / (1 + b) one step apart.
    dt, w, z = 0.02, 2.0 * math.pi * 4.0, 0.3
    weights = filtered_noise(STEADY, np.eye(600), dt)
    a = 2.0 * math.exp(-z * w * dt) * math.cos(w * math.sqrt(1.0 - z * z) * dt)
    b = math.exp(-2.0 * z * w * dt)
    assert np.sum(weights[:, -2] * weights[:, -1]) == pytest.approx(a / (1.0 + b), rel=1e-12)
    two_apart = a * a / (1.0 + b) - b
    assert np.sum(weights[:, -3] * weights[:, -1]) == pytest.approx(two_apart, rel=1e-12)


def test_steady_process_crosses_zero_at_the_frequency_of_its_filter() -> None:
    # Of a Gaussian sequence with correlation r from sample to sample a share arccos(r) / (2 pi) of the steps crosses
    # upwards; in the limit of short steps that is the frequency of the filter (Rice).
    dt, motions, samples = 0.005, 60, 6000
    noise = normals(random.Random(1), motions * samples).reshape(motions, samples)
    process = filtered_noise(STEADY, noise, dt)[:, 1000:]
    rates = np.array([len(times) for times in crossing_times(process, dt)]) / (dt * (process.shape[1] - 1))
    w, z = 2.0 * math.pi * 4.0, 0.3
    a = 2.0 * math.exp(-z * w * dt) * math.cos(w * math.sqrt(1.0 - z * z) * dt)
    expected = math.acos(a / (1.0 + math.exp(-2.0 * z * w * dt))) / (2.0 * math.pi * dt)
    assert abs(rates.mean() - expected) < 4.0 * rates.std(ddof=1) / math.sqrt(motions)
    assert expected == pytest.approx(4.0, rel=0.03)


def test_frequency_changes_over_time_as_told(ensemble: np.ndarray) -> None:
    times = np.concatenate(crossing_times(ensemble, 0.01))
    for start, stop in ((2.0, 4.0), (6.0, 8.0), (12.0, 14.0)):
        rate = np.sum((times >= start) & (times < stop)) / (400 * (stop - start))
        filter_rate = float(np.mean(USUAL.filter_frequency(np.linspace(start, stop, 101))))
        # Steps of 0.01 s miss some 2 % of the crossings and the filter remembers 0.15 Hz/s for a tenth of a second;
        # the scatter of a count over 800 s is below 1 %.
        assert rate == pytest.approx(filter_rate, rel=0.05)
    assert USUAL.filter_frequency(np.array([6.0]))[0] == 4.0
    assert USUAL.filter_frequency(np.array([1000.0]))[0] == LEAST_FREQUENCY


def test_high_pass_is_exact_for_straight_lines() -> None:
    # scipy's simulation of the same system by matrix exponentials with linear interpolation of its input.
    x = normals(random.Random(3), 800)
    x[0] = 0.0
    dt, w = 0.01, 2.0 * math.pi * 0.2
    system = signal.StateSpace([[0.0, 1.0], [-w * w, -2.0 * w]], [[0.0], [1.0]], [[-w * w, -2.0 * w]], [[1.0]])
    _, expected, _ = signal.lsim(system, x, dt * np.arange(800))
    np.testing.assert_allclose(high_passed(x, dt, 0.2), expected, rtol=0.0, atol=1e-12 * np.abs(expected).max())


def test_high_pass_takes_off_long_periods_only() -> None:
    time = 0.01 * np.arange(20_000)
    for frequency in (0.05, 0.2, 2.0):
        steady = high_passed(np.sin(2.0 * math.pi * frequency * time), 0.01, 0.2)[-4000:]
        # |H| = f^2 / (f^2 + corner^2) of a critically damped oscillator; samples of 2 Hz miss the peak by 2e-3
        assert np.max(np.abs(steady)) == pytest.approx(frequency**2 / (frequency**2 + 0.04), rel=2e-3)


@pytest.mark.parametrize("pulse", [None, sm.records.NearFaultPulse(2.0, 0.4, 5.0)], ids=["no pulse", "pulse"])
@pytest.mark.parametrize("seed", [0, 1, 2, 3])
def test_motion_ends_at_rest_where_it_started(seed: int, pulse: sm.records.NearFaultPulse | None) -> None:
    record = sm.records.synthetic_motion(dataclasses.replace(USUAL, pulse=pulse), seed, 0.01)
    velocity = np.concatenate(
        ([0.0], np.cumsum(0.5 * record.dt * (record.acceleration[1:] + record.acceleration[:-1])))
    )
    displacement = np.cumsum(velocity) * record.dt
    end_velocity, end_displacement = end_state(record.acceleration, record.dt)
    # Rounding of sums of 3200 numbers
    assert abs(end_velocity) < 1e-12 and abs(end_displacement) < 1e-11
    assert record.acceleration[0] == 0.0
    # At rest, not merely passing through zero: the last second has next to nothing of the peaks.
    assert np.max(np.abs(velocity[-100:])) < 1e-3 * np.max(np.abs(velocity))
    assert np.max(np.abs(displacement[-100:])) < 5e-3 * np.max(np.abs(displacement))


def test_motion_is_labelled_and_the_same_for_the_same_seed() -> None:
    record, again, other = (sm.records.synthetic_motion(USUAL, seed, 0.01) for seed in (7, 7, 8))
    assert record == again
    assert not np.array_equal(record.acceleration, other.acceleration)
    assert record.synthetic and record.event == "synthetic"
    assert "not a recording; seed 7; I_a 1.5 m/s, D5-95 9 s" in record.remarks[0]
    assert "0.2 Hz" in record.history[0]
    assert record.duration == pytest.approx(USUAL.duration, abs=0.011)


def test_pulse_adds_its_velocity_and_nothing_after_it() -> None:
    pulse = sm.records.NearFaultPulse(period=2.0, velocity=0.5, centre=6.0)
    quiet = dataclasses.replace(USUAL, arias=1e-9)
    record = sm.records.synthetic_motion(dataclasses.replace(quiet, pulse=pulse), 1, 0.01)
    velocity = np.cumsum(record.acceleration) * 0.01
    # 0.8696 of its amplitude (tests/test_synthetic.py); the process is 1e-4 of a usual one.
    assert np.max(np.abs(velocity)) == pytest.approx(0.8696 * 0.5, rel=2e-3)
    after = record.time > pulse.end
    assert pulse.end == 8.0
    assert np.max(np.abs(velocity[after])) < 1e-3 * np.max(np.abs(velocity))


def test_intensity_after_the_high_pass_is_a_little_less() -> None:
    # Power of white noise through the filter, 1 / |1 - r^2 + 2 i z r|^2 with r = f / 4 Hz, and that of it which the
    # high-pass leaves, |H|^2 = (f^2 / (f^2 + corner^2))^2. Modulation changes slowly beside both.
    f = np.linspace(0.0, 100.0, 400_001)
    power = 1.0 / ((1.0 - (f / 4.0) ** 2) ** 2 + (0.6 * f / 4.0) ** 2)
    left = float(np.sum(power * (f**2 / (f**2 + 0.04)) ** 2) / np.sum(power))
    assert 0.94 < left < 0.98
    measured = []
    for seed in range(60):
        record = sm.records.synthetic_motion(STEADY, seed, 0.02)
        measured.append(np.sum(record.acceleration**2) * 0.02 * math.pi / (2.0 * G))
    error = 4.0 * np.std(measured, ddof=1) / math.sqrt(60.0)
    assert abs(np.mean(measured) - left * 1.5) < error


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"arias": 0.0}, "arias of synthetic motion must be a positive number; got 0.0"),
        ({"arias": "1"}, "arias of synthetic motion must be a number; got '1'"),
        ({"d5_95": -1.0}, "d5_95 of synthetic motion must be a positive number; got -1.0"),
        ({"d5_95": 29.5}, "d5_95 of synthetic motion must be 0.01 to 4.9 times t_mid; got 29.5 s beside 6 s"),
        ({"d5_95": 0.05}, "d5_95 of synthetic motion must be 0.01 to 4.9 times t_mid; got 0.05 s beside 6 s"),
        ({"t_mid": math.inf}, "t_mid of synthetic motion must be a positive number; got inf"),
        ({"frequency": 0.2}, "frequency of synthetic motion must be at least 0.3 Hz; got 0.2 Hz"),
        ({"frequency_rate": math.nan}, "frequency_rate of synthetic motion must be a finite number; got nan"),
        ({"damping": 1.0}, "damping of synthetic motion must be between 0 and 1; got 1"),
        ({"damping": 0.0}, "damping of synthetic motion must be a positive number; got 0.0"),
        ({"corner": 0.0}, "corner of synthetic motion must be a positive number; got 0.0"),
        ({"corner": 4.0}, "corner of synthetic motion must be below the frequency, 4 Hz; got 4 Hz"),
        ({"pulse": 2.0}, "pulse of synthetic motion must be a NearFaultPulse or None; got 2.0"),
    ],
)
def test_parameters_out_of_range_are_refused(change: dict[str, Any], message: str) -> None:
    with pytest.raises(sm.errors.InvalidMotion) as error:
        dataclasses.replace(USUAL, **change)
    assert str(error.value) == message


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((USUAL, 1.5, 0.01), "seed of synthetic motion must be a whole number of at least 0; got 1.5"),
        ((USUAL, True, 0.01), "seed of synthetic motion must be a whole number of at least 0; got True"),
        # `random.Random` takes the absolute value, so that -5 would be 5 again.
        ((USUAL, -5, 0.01), "seed of synthetic motion must be a whole number of at least 0; got -5"),
        ((USUAL, 1, 0.0), "dt of synthetic motion must be positive and at most 0.02041 s"),
        ((USUAL, 1, 0.05), "dt of synthetic motion must be positive and at most 0.02041 s"),
        ((USUAL, 1, math.nan), "dt of synthetic motion must be positive and at most 0.02041 s"),
        ((USUAL, 1, 1e-9), "duration of synthetic motion must be at most 1000000 samples"),
        (("M 7", 1, 0.01), "parameters of synthetic motion must be a SyntheticParameters; got 'M 7'"),
    ],
)
def test_motions_that_cannot_be_made_are_refused(arguments: tuple[Any, ...], message: str) -> None:
    with pytest.raises(sm.errors.InvalidMotion) as error:
        sm.records.synthetic_motion(*arguments)
    assert str(error.value).startswith(message)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.0, 0.3, 5.0), "period of near-fault pulse must be a positive number; got 0.0"),
        ((2.0, math.nan, 5.0), "velocity of near-fault pulse must be a positive number; got nan"),
        ((2.0, 0.3, 1.5), "centre of near-fault pulse must be at least its period, 2 s"),
    ],
)
def test_pulses_out_of_range_are_refused(arguments: tuple[float, float, float], message: str) -> None:
    with pytest.raises(sm.errors.InvalidMotion) as error:
        sm.records.NearFaultPulse(*arguments)
    assert str(error.value).startswith(message)


def test_normal_numbers_are_box_and_mullers_of_the_stream_that_python_promises() -> None:
    # random.Random(1) begins 0.13436424411240122, 0.8474337369372327 (Mersenne twister, as Python documents).
    p, q = 0.13436424411240122, 0.8474337369372327
    radius = math.sqrt(-2.0 * math.log(1.0 - p))
    expected = [radius * math.cos(2.0 * math.pi * q), radius * math.sin(2.0 * math.pi * q)]
    np.testing.assert_allclose(normals(random.Random(1), 2), expected, rtol=1e-14)
    drawn = normals(random.Random(5), 20_001)
    assert len(drawn) == 20_001
    # Four standard errors: 1 / sqrt n of the mean, sqrt(2 / n) of the variance
    assert abs(drawn.mean()) < 4.0 / math.sqrt(20_001)
    assert abs(drawn.var() - 1.0) < 4.0 * math.sqrt(2.0 / 20_001)
