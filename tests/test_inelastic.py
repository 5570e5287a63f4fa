"""Inelastic spectra: closed forms under a step, an independent integration, elastic limits, and the root returned."""

import re

import numpy as np
import pytest

import seismass as sm

G = 9.80665
STEP = sm.Motion(np.ones(400), 0.01)
ELASTOPLASTIC = {"overstrength": 1.0, "second_slope": 0.0, "third_slope": 0.0}


def noise(seed: int = 1, samples: int = 1500) -> sm.Motion:
    rng = np.random.default_rng(seed)
    envelope = np.sin(np.linspace(0.0, np.pi, samples)) ** 2
    return sm.Motion(3.0 * envelope * np.convolve(rng.standard_normal(samples), np.ones(8) / 8.0, "same"), 0.01)


@pytest.mark.parametrize("yield_acceleration", [1.1, 1.25, 1.5, 1.9])
def test_elastoplastic_under_a_step(yield_acceleration: float) -> None:
    # Work of the step, a u, equals that of the spring, A_y u_y/2 + A_y (u - u_y): mu = (A_y/2)/(A_y - a).
    found = sm.spectra.inelastic_spectrum(
        STEP, [0.3, 0.5], strength=yield_acceleration / G, damping=0.0, **ELASTOPLASTIC
    )
    expected = 0.5 * yield_acceleration / (yield_acceleration - 1.0)
    np.testing.assert_allclose(found.ductility, [[expected, expected]], rtol=1e-12)
    unit = yield_acceleration * (np.array([0.3, 0.5]) / (2.0 * np.pi)) ** 2
    np.testing.assert_allclose(found.displacement, [expected * unit], rtol=1e-12)
    np.testing.assert_allclose(found.reduction, [[2.0 / yield_acceleration] * 2], rtol=1e-12)


def test_trilinear_under_a_step() -> None:
    # V_y = 0.8 a, Omega = 1.5, r2 = 0.5, r3 = 0.1: in units of u_y and A_y the work of the spring up to x = u/u_y is
    # 1/2 + (x - 1) + r2 (x - 1)^2/2 up to x2 = 1 + (Omega - 1)/r2, then with force Omega + r3 (x - x2).
    strength, omega, r2, r3 = 0.8, 1.5, 0.5, 0.1
    x2 = 1.0 + (omega - 1.0) / r2
    work2 = 0.5 + (x2 - 1.0) + 0.5 * r2 * (x2 - 1.0) ** 2
    # work2 + omega d + r3 d^2/2 = (x2 + d)/strength.
    b, c = omega - 1.0 / strength, work2 - x2 / strength
    expected = x2 + (-b + np.sqrt(b**2 - 2.0 * r3 * c)) / r3
    assert expected > x2
    found = sm.spectra.inelastic_spectrum(
        STEP, [0.4], strength=strength / G, damping=0.0, overstrength=omega, second_slope=r2, third_slope=r3
    )
    assert found.ductility[0, 0] == pytest.approx(expected, rel=1e-12)


def newmark(motion: sm.Motion, period: float, yield_acceleration: float, parts: int) -> float:
    """Largest |u| of an elastoplastic oscillator of 5 % damping, by small explicit steps."""
    w, h = 2.0 * np.pi / period, motion.dt / parts
    rest = np.zeros(int(6.0 * period / motion.dt))
    samples = np.concatenate([motion.acceleration, rest])
    ground = np.interp(np.arange((len(samples) - 1) * parts) / parts, np.arange(len(samples)), samples)
    u = v = force = peak = 0.0
    for a in ground:
        v += h * (-a - 2.0 * 0.05 * w * v - force)
        u += h * v
        force = min(max(force + w**2 * h * v, -yield_acceleration), yield_acceleration)
        peak = max(peak, abs(u))
    return peak


def test_independent_integration() -> None:
    motion = noise()
    for period, strength in ((0.3, 0.05), (1.0, 0.02)):
        exact = sm.spectra.inelastic_spectrum(motion, [period], strength=strength, **ELASTOPLASTIC).displacement[0, 0]
        # First order in the step: the error of 128 parts is half of that of 64, their extrapolation is near.
        coarse, fine = (newmark(motion, period, strength * G, parts) for parts in (64, 128))
        assert 2.0 * fine - coarse == pytest.approx(exact, rel=1e-5)


def test_infinite_strength_is_elastic() -> None:
    motions, periods = [noise(1), noise(2)], [0.05, 0.3, 1.0, 3.0]
    elastic = sm.response_spectrum(motions, periods, kind="displacement")
    found = sm.spectra.inelastic_spectrum(motions, periods, strength=[np.inf, 50.0])
    assert found.displacement.shape == (2, 2, 4)
    np.testing.assert_array_equal(found.displacement[:, 0], elastic)
    # Another path through the kernel, free vibration included.
    np.testing.assert_allclose(found.displacement[:, 1], elastic, rtol=1e-12)
    assert (found.ductility[:, 0] == 0.0).all()
    np.testing.assert_allclose(found.ductility[:, 1], found.elastic_strength / 50.0, rtol=1e-12)


def test_elastic_strength_is_the_pseudo_acceleration() -> None:
    motion, periods = noise(), [0.2, 0.7]
    found = sm.spectra.inelastic_spectrum(motion, periods, ductility=1.0)
    expected = sm.response_spectrum(motion, periods) / G
    np.testing.assert_allclose(found.strength, expected, rtol=1e-14)
    np.testing.assert_allclose(
        found.displacement, sm.response_spectrum(motion, periods, kind="displacement"), rtol=1e-14
    )
    assert (found.ductility == 1.0).all()


@pytest.mark.parametrize("spring", [ELASTOPLASTIC, {}], ids=["elastoplastic", "trilinear"])
def test_strength_for_a_ductility_is_the_largest(spring: dict[str, float]) -> None:
    motion, periods, levels = noise(3), [0.15, 0.6, 2.0], [1.0, 1.5, 4.0, 8.0]
    found = sm.spectra.inelastic_spectrum(motion, periods, ductility=levels, **spring)
    assert found.strength.shape == (1, 4, 3)
    np.testing.assert_allclose(found.ductility, np.broadcast_to(np.array(levels)[:, None], (1, 4, 3)), rtol=1e-6)
    again = sm.spectra.inelastic_spectrum(motion, periods, strength=found.strength[0, 2, 0], **spring)
    assert again.ductility[0, 0] == pytest.approx(4.0, rel=1e-6)
    # No strength between it and that of the elastic oscillator has as much demand, up to the step of the search.
    for level, ductility in enumerate(levels[1:], start=1):
        for at in range(len(periods)):
            grid = np.geomspace(found.strength[0, level, at] * np.exp(0.041), found.elastic_strength[0, at], 40)
            demands = sm.spectra.inelastic_spectrum(motion, [periods[at]], strength=grid, **spring).ductility[0, :, 0]
            assert demands.max() < ductility


def test_ductility_agrees_with_a_simulation() -> None:
    motion = noise(4)
    found = sm.spectra.inelastic_spectrum(motion, [0.5], ductility=3.0)
    strength = float(found.strength[0, 0])
    building = sm.Building.uniform(1, 0.5, yield_shear_over_weight=strength)
    response = sm.simulate(sm.Scene(building), motion.with_duration(motion.duration + 5.0))
    yield_drift = strength * G * (0.5 / (2.0 * np.pi)) ** 2
    # Of the interval of 1e-8 in the strength; the demand may change faster than the strength.
    assert response.peak_drift[0] / yield_drift == pytest.approx(3.0, rel=1e-6)


def test_peaks_after_the_motion_count() -> None:
    # Half a sine much shorter than the period: the peak is long after its end.
    pulse = sm.Motion(20.0 * np.sin(np.linspace(0.0, np.pi, 11)), 0.01)
    alone = sm.spectra.inelastic_spectrum(pulse, [2.0], strength=0.02)
    longer = sm.spectra.inelastic_spectrum(pulse.with_duration(30.0), [2.0], strength=0.02)
    np.testing.assert_allclose(alone.displacement, longer.displacement, rtol=1e-12)
    elastic = sm.response_spectrum(pulse, [2.0], kind="displacement")
    np.testing.assert_allclose(
        sm.spectra.inelastic_spectrum(pulse, [2.0], strength=9.0).displacement, elastic, rtol=1e-12
    )


def test_doubling_motion_and_strength_doubles_displacement() -> None:
    motion = noise(5)
    one = sm.spectra.inelastic_spectrum(motion, [0.4, 1.1], strength=0.05)
    two = sm.spectra.inelastic_spectrum(sm.Motion(2.0 * motion.acceleration, motion.dt), [0.4, 1.1], strength=0.1)
    np.testing.assert_allclose(two.displacement, 2.0 * one.displacement, rtol=1e-12)
    np.testing.assert_allclose(two.ductility, one.ductility, rtol=1e-12)


def test_threads_change_nothing() -> None:
    motions = [noise(6), noise(7)]
    one, all_of_them = (
        sm.spectra.inelastic_spectrum(motions, [0.3, 0.9], ductility=[2.0, 5.0], threads=threads)
        for threads in (1, None)
    )
    np.testing.assert_array_equal(one.strength, all_of_them.strength)


def test_table_has_a_row_per_motion_level_and_period() -> None:
    motions, periods, levels = [noise(1), noise(2)], [0.3, 0.9], [0.05, 0.1, 0.2]
    found = sm.spectra.inelastic_spectrum(motions, periods, strength=levels)
    table = found.table()
    assert len(table) == 12
    row = table.row(7, named=True)
    assert (row["motion"], row["record"], row["period"], row["strength"]) == (2, "motion 2", 0.9, 0.05)
    assert row["displacement"] == found.displacement[1, 0, 1]
    assert row["reduction"] == pytest.approx(found.elastic_strength[1, 1] / 0.05, rel=1e-15)
    single = sm.spectra.inelastic_spectrum(motions, periods, strength=0.05)
    assert single.table()["displacement"].to_list() == found.displacement[:, 0].ravel().tolist()


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        (
            {},
            sm.errors.InvalidOption,
            "strength of inelastic spectrum must be given, or ductility, not both; got neither",
        ),
        ({"strength": 0.1, "ductility": 2.0}, sm.errors.InvalidOption, "not both; got both"),
        ({"strength": 0.0}, sm.errors.InvalidOption, "strength of inelastic spectrum must be positive; got 0"),
        (
            {"strength": [0.1, np.nan]},
            sm.errors.InvalidOption,
            "strength of inelastic spectrum must be positive; got nan",
        ),
        (
            {"strength": []},
            sm.errors.InvalidOption,
            "strength of inelastic spectrum must be a number or a list of at least",
        ),
        ({"ductility": 0.9}, sm.errors.InvalidOption, "ductility of inelastic spectrum must be at least 1; got 0.9"),
        ({"ductility": np.inf}, sm.errors.InvalidOption, "ductility of inelastic spectrum must be at least 1; got inf"),
        ({"ductility": "2"}, sm.errors.InvalidOption, "ductility of inelastic spectrum must be a number or a list"),
        (
            {"strength": 0.1, "damping": 1.5},
            sm.errors.InvalidOption,
            "damping of spectrum 1 must be at least 0 and below 1",
        ),
        ({"strength": 0.1, "overstrength": 0.5}, sm.errors.InvalidScene, "overstrength of storey 1"),
        (
            {"strength": 0.1, "threads": 0},
            sm.errors.InvalidOption,
            "threads of inelastic spectrum must be a whole number",
        ),
        (
            {"strength": 0.1, "periods": [0.0]},
            sm.errors.InvalidOption,
            "period of oscillator 1 must be a positive number",
        ),
        (
            {"strength": 0.1, "motions": []},
            sm.errors.InvalidMotion,
            "motions of inelastic spectrum must be at least one",
        ),
        (
            {"ductility": 2.0, "motions": sm.Motion([0.0, 0.0], 0.01)},
            sm.errors.InvalidMotion,
            "acceleration of motion 1 must be other than zero somewhere; got zero throughout",
        ),
    ],
)
def test_bad_arguments_are_refused(arguments: dict, error: type[sm.SeismassError], message: str) -> None:
    given = {"motions": noise(samples=100), "periods": [0.5]} | arguments
    with pytest.raises(error, match=re.escape(message)):
        sm.spectra.inelastic_spectrum(**given)
