"""Response spectra against closed forms and an independent recurrence; target spectra; what both refuse."""

import itertools
import re
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

import seismass as sm
from seismass.motions.spectra import mean_spectrum

G = 9.80665


def noise(samples: int = 300, dt: float = 0.01, seed: int = 1) -> sm.Motion:
    rng = np.random.default_rng(seed)
    return sm.Motion(np.convolve(rng.standard_normal(samples), [0.25, 0.5, 0.25]), dt)


def finely_sampled_peak(motion: sm.Motion, period: float, damping: float, parts: int) -> float:
    """Largest |u| at `parts` instants per sample interval, by the matrix exponential of state, load and its rate."""
    w = 2.0 * np.pi / period
    h = motion.dt / parts
    generator = np.zeros((4, 4))
    generator[0, 1] = 1.0
    generator[1] = [-(w**2), -2.0 * damping * w, -1.0, 0.0]
    generator[2, 3] = 1.0
    propagator = expm(generator * h)
    quiet = np.zeros(int(np.ceil(period / motion.dt)) + 2)
    samples = np.concatenate([motion.acceleration, quiet])
    state, peak = np.zeros(2), 0.0
    for before, after in itertools.pairwise(samples):
        full = np.array([*state, before, (after - before) / motion.dt])
        for _ in range(parts):
            full = propagator @ full
            peak = max(peak, abs(full[0]))
        state = full[:2]
    return peak


@pytest.mark.parametrize("damping", [0.0, 0.05, 0.5])
@pytest.mark.parametrize("period", [0.05, 0.33, 2.0])
def test_peaks_are_those_of_a_fine_sampling_from_above(period: float, damping: float) -> None:
    motion = noise()
    parts = 128
    sampled = finely_sampled_peak(motion, period, damping, parts)
    exact = float(sm.response_spectrum(motion, [period], damping, "displacement")[0, 0])
    # A maximum is missed by at most |u''| h^2 / 8 with |u''| below the peak acceleration plus w^2 u, and a few more.
    w = 2.0 * np.pi / period
    missed = (motion.pga + w**2 * exact + 2.0 * damping * w**2 * exact) * (motion.dt / parts) ** 2 / 8.0
    assert sampled <= exact * (1.0 + 1e-12)
    assert exact - sampled <= missed


@pytest.mark.parametrize("kind", [list, lambda values: np.array(values, dtype=np.float32), np.int64])
def test_samples_of_any_kind_are_taken(kind: Callable[[list[int]], object]) -> None:
    samples = [1, -2, 3, 0]
    given = SimpleNamespace(acceleration=kind(samples), dt=np.float32(0.5))
    expected = sm.response_spectrum(sm.Motion(samples, 0.5), [1.0, 2.0])
    np.testing.assert_array_equal(sm.response_spectrum(given, [1.0, 2.0]), expected)


def test_undamped_step_gives_twice_the_static_displacement_in_every_kind() -> None:
    step = sm.Motion(np.full(300, 2.0), 0.01)
    w = 2.0 * np.pi / 0.7
    for kind, expected in (("displacement", 4.0 / w**2), ("pseudo_velocity", 4.0 / w), ("pseudo_acceleration", 4.0)):
        got = sm.response_spectrum(step, [0.7], 0.0, kind)
        np.testing.assert_allclose(got, [[expected]], rtol=1e-13)


def test_shapes_and_order() -> None:
    motions = [noise(seed=1), noise(seed=2, dt=0.02), noise(seed=3)]
    periods = [0.1, 1.0, 0.5, 2.0]
    table = sm.response_spectrum(motions, periods, [0.02, 0.1])
    assert table.shape == (3, 2, 4)
    assert sm.response_spectrum(motions, periods).shape == (3, 4)
    for m, motion in enumerate(motions):
        for z, damping in enumerate([0.02, 0.1]):
            alone = [sm.response_spectrum(motion, [period], damping)[0, 0] for period in periods]
            assert table[m, z].tolist() == alone
    assert np.array_equal(table, sm.response_spectrum(motions, periods, [0.02, 0.1], threads=1))


def test_stiff_oscillators_follow_the_ground() -> None:
    record = sm.builtin_suite()[0]
    period = 1e-4
    # Where the slope of the ground acceleration jumps, a stiff oscillator overshoots by the jump over w at most.
    jump = np.abs(np.diff(record.acceleration, 2)).max() / record.dt
    overshoot = jump * period / (2.0 * np.pi)
    assert overshoot < 1e-3 * record.pga
    assert sm.response_spectrum(record, [period])[0, 0] == pytest.approx(record.pga, abs=2.0 * overshoot)


@pytest.mark.parametrize("damping", [0.0, 0.05, 0.3])
def test_true_acceleration_is_that_of_a_fine_sampling_from_above(damping: float) -> None:
    motion, period, parts = noise(), 0.4, 128
    w, h = 2.0 * np.pi / period, motion.dt / 128
    generator = np.zeros((4, 4))
    generator[0, 1] = 1.0
    generator[1] = [-(w**2), -2.0 * damping * w, -1.0, 0.0]
    generator[2, 3] = 1.0
    propagator = expm(generator * h)
    samples = np.concatenate([motion.acceleration, np.zeros(int(2.0 * period / motion.dt))])
    state, peak = np.zeros(2), 0.0
    for before, after in itertools.pairwise(samples):
        full = np.array([*state, before, (after - before) / motion.dt])
        for _ in range(parts):
            full = propagator @ full
            peak = max(peak, abs(w**2 * full[0] + 2.0 * damping * w * full[1]))
        state = full[:2]
    exact = float(sm.response_spectrum(motion, [period], damping, "acceleration")[0, 0])
    # Second order in the sampling: peaks of a curve whose second derivative is below w^2 + 2 zeta w/dt times the peak.
    missed = (w**2 + 2.0 * damping * w / motion.dt) * (exact + motion.pga) * h**2
    assert peak <= exact * (1.0 + 1e-12)
    assert exact - peak <= missed


def test_true_acceleration_without_damping_is_the_pseudo_acceleration() -> None:
    motion, periods = noise(), [0.05, 0.4, 2.0]
    expected = sm.response_spectrum(motion, periods, 0.0)
    np.testing.assert_allclose(sm.response_spectrum(motion, periods, 0.0, "acceleration"), expected, rtol=1e-12)


@given(factor=st.floats(-8.0, 8.0).filter(lambda x: abs(x) > 1e-3), period=st.floats(0.02, 5.0))
def test_spectra_are_linear_in_amplitude(factor: float, period: float) -> None:
    motion = noise(100)
    scaled = sm.Motion(factor * motion.acceleration, motion.dt)
    one, many = (sm.response_spectrum(m, [period])[0, 0] for m in (motion, scaled))
    assert many == pytest.approx(abs(factor) * one, rel=1e-12)


def test_mean_spectrum_is_the_mean_of_scaled_spectra() -> None:
    motions = [noise(seed=1), noise(seed=2)]
    spectra = sm.response_spectrum(motions, [0.3, 0.9])
    np.testing.assert_allclose(mean_spectrum(motions, [2.0, 0.5], [0.3, 0.9]), spectra[0] + 0.25 * spectra[1])


def test_asce7_shape_is_that_of_the_standard() -> None:
    target = sm.TargetSpectrum.asce7(sds_g=1.0, sd1_g=0.5, tl=6.0)  # T0 = 0.1 s, T_S = 0.5 s
    periods = [0.0, 0.05, 0.1, 0.3, 0.5, 1.0, 6.0, 12.0]
    expected = [0.4, 0.7, 1.0, 1.0, 1.0, 0.5, 0.5 / 6.0, 0.5 * 6.0 / 144.0]
    np.testing.assert_allclose(target(periods) / G, expected, rtol=1e-15)
    assert "not its published spectrum" not in target.label
    assert "not its published spectrum" in sm.TargetSpectrum.asce7().label


@pytest.mark.parametrize(
    "text",
    [
        "# units: g\n0.1,0.4\n1.0,0.2\n2.0,0.05\n",
        "Period (s), Sa (g)\n0.1,0.4\n1.0,0.2\n2.0,0.05\n",
        "# uniform hazard\nsa_g,site,T\n0.4,x,0.1\n\n0.2,x,1.0\n0.05,x,2.0\n",
        "\ufeffperiod,sa (g)\r\n0.1,4e-1\r\n1.0,0.2\r\n2.0,5e-2\r\n",
    ],
)
def test_csv_target_is_interpolated_in_logarithms(tmp_path: Path, text: str) -> None:
    file = tmp_path / "uhs.csv"
    file.write_text(text, encoding="utf-8", newline="")
    target = sm.TargetSpectrum.from_csv(file)
    expected = [0.4, 0.4 * (np.sqrt(0.1) / 0.1) ** np.log10(0.5), 0.2, 0.1, 0.05]
    np.testing.assert_allclose(target([0.1, np.sqrt(0.1), 1.0, np.sqrt(2.0), 2.0]) / G, expected, rtol=1e-14)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "points of uhs.csv must be at least two rows of period and Sa; got 0"),
        ("period,sa\n1.0,0.2\n", "points of uhs.csv must be at least two rows of period and Sa; got 1"),
        ("0.1,0.4\n1.0\n", "Sa of uhs.csv, point 2, must be a positive number; got ''"),
        ("0.1,0.4\n1.0,nan\n", "Sa of uhs.csv, point 2, must be a positive number; got 'nan'"),
        ("-0.1,0.4\n1.0,0.2\n", "period of uhs.csv, point 1, must be a positive number; got '-0.1'"),
        ("0.1,0.4\n1.0,0.2\n", "unit of Sa of uhs.csv must be stated by the head as Sa (g), or behind the name"),
        ("0.1,0.4\n1.0,-0.2\n", "Sa of uhs.csv, point 2, must be a positive number; got '-0.2'"),
        ("1.0,0.4\n1.0,0.2\n", "period of uhs.csv, point 2, must be longer than the one before; got 1 after 1"),
        ("period,sigma\n0.1,0.4\n1,0.2\n", "columns of uhs.csv must be one period or T and one Sa; got period, sigma"),
        ("period,value\n0.1,0.4\n1,0.2\n", "unit of Sa of uhs.csv must be stated by the head"),
        ("0.1,0.4\n" + "1" * 200_000 + ",0.2\n", "content of uhs.csv must be a table in CSV; got field larger than"),
        ("period,Sa (kN)\n0.1,0.4\n1,0.2\n", "unit of Sa of uhs.csv must be stated by the head as Sa (g), or behind"),
    ],
)
def test_bad_target_files_are_refused(tmp_path: Path, text: str, message: str) -> None:
    file = tmp_path / "uhs.csv"
    file.write_text(text)
    with pytest.raises(sm.errors.RecordFormatError, match=re.escape(message)):
        sm.TargetSpectrum.from_csv(file)


def test_missing_or_binary_target_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(sm.errors.RecordFormatError, match="path of target spectrum must be a file of text"):
        sm.TargetSpectrum.from_csv(tmp_path / "none.csv")
    (tmp_path / "binary.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(sm.errors.RecordFormatError, match="path of target spectrum must be a file of text"):
        sm.TargetSpectrum.from_csv(tmp_path / "binary.csv")


@pytest.mark.parametrize("path", [None, 3, "a\0b"])
def test_target_path_that_is_none_is_refused(path: object) -> None:
    with pytest.raises(
        sm.errors.RecordFormatError, match=re.escape(f"path of target spectrum must be a path; got {path!r}")
    ):
        sm.TargetSpectrum.from_csv(path)  # type: ignore[arg-type]


def test_csv_target_is_refused_outside_its_range(tmp_path: Path) -> None:
    file = tmp_path / "uhs.csv"
    file.write_text("T,Sa (g)\n0.1,0.4\n2.0,0.05\n")
    target = sm.TargetSpectrum.from_csv(file)
    for period in (0.09, 2.1, np.nan):
        with pytest.raises(sm.errors.InvalidOption, match=r"must be from 0.1 s to 2 s, the range of uhs; got"):
            target([1.0, period])


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"periods": [1.0, 0.0]}, sm.errors.InvalidOption, "period of oscillator 2 must be a positive number; got 0"),
        ({"periods": [np.nan]}, sm.errors.InvalidOption, "period of oscillator 1 must be a positive number; got NaN"),
        (
            {"periods": []},
            sm.errors.InvalidOption,
            "periods of spectrum must be a list of at least one period; got none",
        ),
        ({"periods": "1.0"}, sm.errors.InvalidOption, "periods of spectrum must be a list of numbers; got '1.0'"),
        ({"periods": [1e-6]}, sm.errors.InvalidOption, "for the time step of motion 1"),
        ({"damping": 1.0}, sm.errors.InvalidOption, "damping of spectrum 1 must be at least 0 and below 1; got 1"),
        ({"damping": [0.05, -0.01]}, sm.errors.InvalidOption, "damping of spectrum 2 must be at least 0 and below 1"),
        (
            {"damping": []},
            sm.errors.InvalidOption,
            "damping of spectrum must be a number or a list of at least one ratio",
        ),
        (
            {"motions": SimpleNamespace(acceleration="loud", dt=0.01)},
            sm.errors.InvalidMotion,
            "acceleration of motion 1 of spectrum must be a list of numbers; got 'loud'",
        ),
        (
            {"motions": [noise(), SimpleNamespace(acceleration=[1.0], dt="short")]},
            sm.errors.InvalidMotion,
            "dt of motion 2 of spectrum must be a number; got 'short'",
        ),
        ({"damping": "five"}, sm.errors.InvalidOption, "damping of spectrum must be a number or a list of numbers"),
        ({"kind": "absolute"}, sm.errors.InvalidOption, "kind of spectrum must be one of pseudo_acceleration"),
        ({"threads": 0}, sm.errors.InvalidOption, "threads of spectrum must be a whole number of at least 1; got 0"),
        (
            {"motions": []},
            sm.errors.InvalidMotion,
            "motions of spectrum must be at least one Record or Motion; got none",
        ),
        ({"motions": 3.0}, sm.errors.InvalidMotion, "motions of spectrum must be Records or Motions; got 3.0"),
        (
            {"motions": [noise(), "x"]},
            sm.errors.InvalidMotion,
            "motion 2 of spectrum must be a Record or Motion; got 'x'",
        ),
    ],
)
def test_bad_arguments_are_refused(arguments: dict, error: type[sm.SeismassError], message: str) -> None:
    with pytest.raises(error, match=re.escape(message)):
        sm.response_spectrum(**({"motions": noise(), "periods": [1.0]} | arguments))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"sds_g": 0.0}, "sds_g of target spectrum must be a positive number; got 0"),
        ({"sd1_g": np.inf}, "sd1_g of target spectrum must be a positive number; got inf"),
        ({"tl": "8"}, "tl of target spectrum must be a number; got '8'"),
        ({"tl": 0.1}, "tl of target spectrum must be at least T_S"),
    ],
)
def test_bad_target_parameters_are_refused(arguments: dict, message: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=re.escape(message)):
        sm.TargetSpectrum.asce7(**arguments)


def test_mean_spectrum_refuses_factors_that_do_not_fit() -> None:
    with pytest.raises(sm.errors.InvalidOption, match="factors of mean spectrum must be a list of 1 values"):
        mean_spectrum([noise()], [1.0, 2.0], [1.0])


def test_mean_spectrum_is_of_one_damping() -> None:
    with pytest.raises(sm.errors.InvalidOption, match=r"damping of mean spectrum must be a number; got \[0.05\]"):
        mean_spectrum([noise()], [1.0], [1.0, 2.0], [0.05])  # type: ignore[arg-type]
