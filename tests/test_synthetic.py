"""The built-in suite: what is stored is what the generator makes, and it is fit for a study."""

import math
from pathlib import Path

import numpy as np
import pytest

from seismass.records import Record, builtin_suite
from seismass.records.synthetic import (
    GENERATOR_VERSION,
    RECIPES,
    Recipe,
    asce7_shape,
    end_state,
    envelope,
    generate,
    pulse,
    spectrum,
    write_suite,
)
from seismass.units import STANDARD_GRAVITY


def test_seven_labelled_synthetic_everywhere() -> None:
    suite = builtin_suite()
    assert suite.name == "built-in suite"
    assert len(suite) == len(RECIPES) == 7
    assert suite.table()["synthetic"].to_list() == [True] * 7
    for record, recipe in zip(suite, RECIPES, strict=True):
        assert record.synthetic
        assert record.name == recipe.name and record.name.startswith("synthetic")
        assert record.event == "synthetic"
        assert "not a recording" in record.remarks[0]
        assert record.source is not None
        first_line = record.source.read_text().splitlines()[0]
        assert "SYNTHETIC MOTION, NOT A RECORDING" in first_line and f"version {GENERATOR_VERSION}" in first_line
    assert len({recipe.seed for recipe in RECIPES}) == 7


@pytest.mark.parametrize("recipe", RECIPES, ids=lambda recipe: recipe.name)
def test_stored_motion_is_the_generated_one(recipe: Recipe) -> None:
    stored = builtin_suite()[recipe.number - 1]
    made = generate(recipe)
    assert (stored.dt, stored.samples) == (made.dt, made.samples)
    # Files keep eight digits (5e-8 of each value); 1e-9 of the peak allows for another machine's FFT and libm.
    np.testing.assert_allclose(stored.acceleration, made.acceleration, rtol=5.1e-8, atol=1e-9 * made.pga)


@pytest.mark.parametrize("record", builtin_suite().records, ids=lambda record: record.name)
def test_stored_motion_is_fit_for_use(record: Record) -> None:
    assert 0.3 < record.pga_g < 0.55
    assert 30.0 <= record.duration <= 40.0
    assert record.acceleration[0] == 0.0 and abs(record.acceleration[-1]) < 1e-12
    velocity, displacement = end_state(record.acceleration, record.dt)
    # Rounding to eight digits: 4000 samples of up to 5 m/s2, each off by 2.5e-8 at most of its own size.
    assert abs(velocity) < 1e-6 and abs(displacement) < 1e-5


def test_spectra_scatter_about_the_shape() -> None:
    periods = np.geomspace(0.2, 1.5, 40)  # where the study scales its records
    spectra = np.array([spectrum(record.acceleration, record.dt, periods) for record in builtin_suite()])
    mean_ratio = spectra.mean(axis=0) / asce7_shape(periods)
    assert mean_ratio.min() > 0.75
    assert mean_ratio.max() < 1.15
    scatter = np.log(spectra).std(axis=0, ddof=1)
    assert 0.1 < scatter.mean() < 0.5


def test_asce7_shape_at_its_corners() -> None:
    # ASCE 7-10 11.4.5: 0.4 S_DS at T = 0, S_DS on the plateau, S_D1 at 1 s, S_D1 T_L / T^2 beyond T_L
    expected = STANDARD_GRAVITY * np.array([0.4 * 1.07, 1.07, 1.07, 0.61, 0.61 * 8 / 100])
    np.testing.assert_allclose(asce7_shape(np.array([1e-12, 0.2 * 0.61 / 1.07, 0.3, 1.0, 10.0])), expected, rtol=1e-9)


def test_envelope_has_its_defining_points() -> None:
    # Boore (2003): largest, 1, at 0.2 of the length and 0.05 at its end
    np.testing.assert_allclose(envelope(np.array([0.0, 4.0, 20.0]), 10.0), [0.0, 1.0, 0.05], atol=1e-12)


def test_pulse_is_the_derivative_of_its_velocity() -> None:
    time = np.linspace(0.0, 10.0, 100_001)
    period, speed, centre = 2.6, 0.3, 5.0
    acceleration = pulse(time, centre, period, speed)
    since = time - centre
    bell = 1.0 + np.cos(math.pi * since / period)
    velocity = 0.5 * speed * bell * np.cos(2 * math.pi * since / period + 0.5 * math.pi)
    velocity[np.abs(since) > period] = 0.0
    np.testing.assert_allclose(np.gradient(velocity, time)[1:-1], acceleration[1:-1], atol=1e-4)
    assert 0.8 * speed < np.max(velocity) <= speed


def test_spectrum_of_a_harmonic_is_the_textbook_amplification() -> None:
    # Steady state of a 5 % oscillator at resonance: 1 / (2 * 0.05) = 10, reached to 1 - exp(-0.05 w t)
    time = np.arange(0.0, 40.0, 0.005)
    at_resonance = spectrum(np.sin(2 * math.pi * time), 0.005, np.array([1.0]))[0]
    assert at_resonance == pytest.approx(10.0, rel=1e-3)


def test_writing_leaves_a_readable_suite(tmp_path: Path) -> None:
    write_suite(tmp_path / "suite", RECIPES[:1])
    assert sorted(file.name for file in (tmp_path / "suite").iterdir()) == ["suite.csv", "synthetic-1.AT2"]
