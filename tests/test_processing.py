"""Steps that change a record: baseline, filter, resampling, similitude; each in its history, the vertical as well."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.motions.records import Record
from seismass.motions.records.processing import band_passed, baseline_corrected, resampled


@pytest.fixture
def record() -> Record:
    """Noise that rises and falls, with other noise upwards."""
    noise = np.random.default_rng(3).normal(size=(2, 2001)) * np.sin(np.linspace(0.0, math.pi, 2001)) ** 2
    return Record(noise[0], 0.01, name="noise", vertical=noise[1])


@pytest.mark.parametrize("fit", ["velocity", "acceleration"])
@pytest.mark.parametrize("order", [0, 1, 3, 6])
def test_baseline_is_a_projection(record: Record, order: int, fit: Any) -> None:
    """A polynomial is removed whole; what is left has none; the sum of both gives the same as the record alone."""
    t = record.time / record.duration
    polynomial = np.polynomial.Polynomial(np.arange(1.0, order + 2.0))(t)
    assert baseline_corrected(record.replace(acceleration=polynomial), order, fit).pga < 1e-11
    left = record.baseline_corrected(order, fit)
    np.testing.assert_allclose(left.baseline_corrected(order, fit).acceleration, left.acceleration, atol=1e-10)
    drifting = record.replace(acceleration=record.acceleration + polynomial)
    np.testing.assert_allclose(drifting.baseline_corrected(order, fit).acceleration, left.acceleration, atol=1e-10)
    assert left.velocity[0] == left.displacement[0] == 0.0


def test_baseline_is_the_least_squares_fit(record: Record) -> None:
    """Any other line leaves more of the velocity; for degree 0 of the acceleration what goes is the mean."""
    corrected = record.baseline_corrected(1)
    least = float(np.sum(corrected.velocity**2))
    for constant, slope in ((1e-3, 0.0), (0.0, 1e-3), (-1e-3, 1e-4)):
        other = corrected.replace(acceleration=corrected.acceleration + constant + slope * record.time)
        assert float(np.sum(other.velocity**2)) > least
    mean = record.baseline_corrected(0, "acceleration")
    np.testing.assert_allclose(mean.acceleration, record.acceleration - record.acceleration.mean(), atol=1e-14)
    assert record.vertical is not None
    np.testing.assert_allclose(mean.vertical, record.vertical - record.vertical.mean(), atol=1e-14)


def sine(hz: float, samples: int = 20_001, dt: float = 0.01) -> Record:
    return Record(np.sin(2.0 * math.pi * hz * dt * np.arange(samples)), dt)


@pytest.mark.parametrize("order", [2, 4])
@pytest.mark.parametrize("hz", [0.5, 5.0, 10.0, 20.0])
def test_gain_of_the_filter(order: int, hz: float) -> None:
    """Twice a Butterworth filter made by the bilinear rule: 1/(1 + (tan(pi f dt)/tan(pi f_c dt))^(2 n)), no phase."""
    given = sine(hz)
    ratio = math.tan(math.pi * hz * given.dt) / math.tan(math.pi * 10.0 * given.dt)
    middle = slice(5000, 15_000)
    for low, high, gain in ((None, 10.0, 1.0 / (1.0 + ratio ** (2 * order))),
                            (10.0, None, 1.0 / (1.0 + ratio ** (-2 * order)))):  # fmt: skip
        passed = given.band_passed(low, high, order)
        np.testing.assert_allclose(passed.acceleration[middle], gain * given.acceleration[middle], atol=1e-9)


def test_filter_has_no_direction_in_time(record: Record) -> None:
    forwards = record.band_passed(0.3, 20.0, taper=0.05)
    reversed_record = record.replace(acceleration=record.acceleration[::-1])
    backwards = reversed_record.band_passed(0.3, 20.0, taper=0.05)
    np.testing.assert_allclose(backwards.acceleration[::-1], forwards.acceleration, atol=1e-9)


def test_kept_pads_hold_the_transients(record: Record) -> None:
    """With them the motion ends at rest where it began; without, the samples between are the same."""
    kept, cut = (record.band_passed(0.3, 20.0, keep_pads=keep) for keep in (True, False))
    pad = math.ceil(1.5 * 4 / (0.3 * record.dt))
    assert (kept.samples, cut.samples) == (record.samples + 2 * pad, record.samples)
    np.testing.assert_array_equal(kept.acceleration[pad:-pad], cut.acceleration)
    assert abs(kept.velocity[-1]) < 1e-3 * kept.pgv
    assert abs(kept.displacement[-1]) < 1e-2 * kept.pgd
    assert kept.vertical is not None
    alone = Record(record.vertical, record.dt).band_passed(0.3, 20.0, keep_pads=True)
    np.testing.assert_array_equal(kept.vertical, alone.acceleration)


def test_taper_that_reaches_the_peak_is_remarked() -> None:
    record = Record([0.0, 1.0, *[0.0] * 998], 0.01)
    assert record.band_passed(None, 20.0).remarks == ("the taper reduced its largest acceleration",)
    assert record.band_passed(None, 20.0, taper=0.0).remarks == ()


def test_resampling_to_a_step_that_divides_is_the_same_motion(record: Record) -> None:
    finer = record.resampled(0.002)
    np.testing.assert_array_equal(finer.acceleration[::5], record.acceleration)
    assert (finer.duration, finer.remarks) == (pytest.approx(record.duration), ())
    periods = [0.05, 0.3, 2.0]
    # The free vibration after the record starts one step after its last sample, which is zero here to 1e-16.
    np.testing.assert_allclose(sm.response_spectrum(finer, periods), sm.response_spectrum(record, periods), rtol=1e-10)
    assert record.resampled(0.01) is record
    third = record.resampled(0.01 / 3.0)
    assert third.samples == 3 * (record.samples - 1) + 1


@pytest.mark.parametrize("dt", [0.02, 0.025, 0.0075, 1.0 / 128.0])
def test_resampling_otherwise_keeps_what_is_below_both_nyquist_frequencies(dt: float) -> None:
    """A sine of 1 Hz keeps its samples within 1e-3 of its amplitude, the ripple of scipy's default window."""
    given = sine(1.0)
    changed = resampled(given, dt)
    assert changed.dt == dt
    middle = slice(changed.samples // 4, 3 * changed.samples // 4)
    wanted = np.sin(2.0 * math.pi * changed.time)
    np.testing.assert_allclose(changed.acceleration[middle], wanted[middle], atol=1e-3)
    assert "changed PGA from 0.1020 g by" in changed.remarks[-1]


def test_resampling_says_what_is_lost() -> None:
    """A sine of 20 Hz is above the Nyquist frequency of 0.05 s: only its ends remain, and the remark says so."""
    given = sine(20.0)
    lost = given.resampled(0.05)
    assert lost.with_duration(150.0).acceleration[1000:] == pytest.approx(0.0, abs=2e-5)
    change = 100.0 * (lost.pga / given.pga - 1.0)
    assert lost.remarks[-1].endswith(f"changed PGA from {given.pga_g:.4f} g by {change:+.2f} %")


def test_similitude() -> None:
    """A = A_p, V = V_p/sqrt(L), D = D_p/L, and the spectrum at T/sqrt(L) is that of the prototype at T."""
    record = sm.builtin_suite()[0]
    model = record.similitude(15.0)
    root = math.sqrt(15.0)
    assert (model.dt, model.pga) == (record.dt / root, record.pga)
    assert model.pgv == pytest.approx(record.pgv / root, rel=1e-12)
    assert model.pgd == pytest.approx(record.pgd / 15.0, rel=1e-12)
    assert model.arias == pytest.approx(record.arias / root, rel=1e-12)
    periods = np.array([0.2, 1.0, 3.0])
    np.testing.assert_allclose(
        sm.response_spectrum(model, periods / root), sm.response_spectrum(record, periods), rtol=1e-9
    )
    assert record.similitude(1.0).acceleration.tolist() == record.acceleration.tolist()


def test_history_has_every_step_in_order(record: Record) -> None:
    other = Record([0.5] * 1500, 0.01, name="up")
    changed = (
        record.scaled(2.0)
        .time_scaled(0.5)
        .time_scaled(2.0)
        .with_duration(15.0)
        .baseline_corrected(2)
        .band_passed(0.2, 20.0)
        .with_vertical(other)
        .resampled(0.005)
        .resampled(0.02)
        .similitude(15.0)
    )
    starts = (
        "scaled by 2",
        "time step multiplied by 0.5",
        "time step multiplied by 2",
        "cut to 15 s",
        "baseline of degree 2 fitted to the velocity and removed",
        "filtered 0.2 to 20 Hz: Butterworth of order 4",
        "vertical accelerations of up set beside it",
        "resampled from 0.01 to 0.005 s on the lines",
        "resampled from 0.005 to 0.02 s by band-limited interpolation (1/4)",
        "time step over sqrt(15) for a model at 1:15",
    )
    assert len(changed.history) == len(starts)
    for said, start in zip(changed.history, starts, strict=True):
        assert said.startswith(start)
    assert record.history == ()


@pytest.mark.parametrize(
    ("wrong", "kind", "message"),
    [
        (
            lambda r: baseline_corrected(r, -1),
            sm.errors.InvalidOption,
            "order of baseline correction must be a whole number",
        ),
        (
            lambda r: baseline_corrected(r, 11),
            sm.errors.InvalidOption,
            "order of baseline correction must be at most 10",
        ),
        (
            lambda r: baseline_corrected(r, 1, "displacement"),
            sm.errors.InvalidOption,
            "fit of baseline correction must be",
        ),
        (
            lambda r: baseline_corrected(r.with_duration(0.0)),
            sm.errors.InvalidOption,
            "samples of baseline .* at least 3",
        ),
        (
            lambda r: band_passed(r, None, None),
            sm.errors.InvalidOption,
            "corners of band-pass filter of noise must be one",
        ),
        (
            lambda r: band_passed(r, 0.1, 50.0),
            sm.errors.InvalidOption,
            r"high_hz .* to below 50 Hz, 1/\(2 dt\); got 50",
        ),
        (lambda r: band_passed(r, 1e-4, 20.0), sm.errors.InvalidOption, "low_hz .* a tenth of one over the duration"),
        (lambda r: band_passed(r, -1.0, 20.0), sm.errors.InvalidOption, "low_hz of band-pass filter of noise must be"),
        (lambda r: band_passed(r, 20.0, 1.0), sm.errors.InvalidOption, "low_hz .* must be below high_hz, 1; got 20"),
        (lambda r: band_passed(r, 1.0, float("nan")), sm.errors.InvalidOption, "high_hz of band-pass filter"),
        (
            lambda r: band_passed(r, 1.0, 20.0, 0),
            sm.errors.InvalidOption,
            "order of band-pass filter must be a whole number",
        ),
        (
            lambda r: band_passed(r, 1.0, 20.0, 11),
            sm.errors.InvalidOption,
            "order of band-pass filter must be at most 10",
        ),
        (
            lambda r: band_passed(r, 1.0, 20.0, taper=0.6),
            sm.errors.InvalidOption,
            "taper of band-pass filter must be a share",
        ),
        (
            lambda r: resampled(r, 0.0),
            sm.errors.InvalidOption,
            "dt of resampled record must be a positive number; got 0.0",
        ),
        (
            lambda r: resampled(r, 0.01 / math.sqrt(15.0)),
            sm.errors.InvalidOption,
            "dt of resampled record must be in a ratio",
        ),
        (lambda r: resampled(r, 1e-9), sm.errors.InvalidOption, "dt of resampled record must be in a ratio"),
        (
            lambda r: r.similitude(0.0),
            sm.errors.InvalidMotion,
            "length_ratio of similitude must be a positive number; got 0.0",
        ),
    ],
)
def test_wrong_input(record: Record, wrong: Any, kind: type[Exception], message: str) -> None:
    with pytest.raises(kind, match=message):
        wrong(record)
