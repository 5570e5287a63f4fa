"""Modal-pushover scaling: elastic limit, closed form under a step, the target reached in a simulation, all roots."""

import re

import numpy as np
import pytest
from scipy.optimize import brentq

import seismass as sm
from seismass.design.scaling.oscillator import _slope_behind, deformation_ratio

G = 9.80665
TARGET = sm.TargetSpectrum.asce7()
SUITE = list(sm.builtin_suite("seven"))
STEP = sm.Motion(np.ones(600), 0.01)


@pytest.mark.parametrize("reduction", [1.0, 0.5])
def test_elastic_oscillator_gives_the_elastic_ratio(reduction: float) -> None:
    found = sm.scaling.scale_modal_pushover(SUITE, TARGET, period=0.7, reduction=reduction)
    ratio = float(TARGET(0.7)) / sm.response_spectrum(SUITE, [0.7])[:, 0]
    np.testing.assert_allclose(found.factors, ratio, rtol=1e-12)
    np.testing.assert_allclose(found.factors, sm.scaling.scale_sa_t1(SUITE, TARGET, 0.7).factors, rtol=1e-12)
    assert found.deformation_ratio == 1.0
    assert [len(roots) for roots in found.roots] == [1] * 7
    assert "the oscillator stays elastic, R_y <= 1" in " ".join(found.notes)
    yields = sm.scaling.scale_modal_pushover(SUITE, TARGET, period=0.7, reduction=1.001)
    assert "target deformation by C_R" in " ".join(yields.notes)


@pytest.mark.parametrize("reduction", [1.5, 3.0, 6.0])
def test_elastoplastic_oscillator_under_a_step(reduction: float) -> None:
    # mu = (A_y/2)/(A_y - s a) under a step s a; so s = A_y (1 - 1/(2 mu))/a, and mu = C_R R is the target.
    found = sm.scaling.scale_modal_pushover(
        STEP, TARGET, period=0.5, reduction=reduction, overstrength=1.0, second_slope=0.0, damping=0.0
    )
    strength = float(TARGET(0.5)) / reduction
    ductility = found.deformation_ratio * reduction
    expected = strength * (1.0 - 0.5 / ductility)
    np.testing.assert_allclose(found.factors, [expected], rtol=2e-10)
    # T_c = T_S = 0.61/1.07; a/R^b + c with a = 61, b = 2.4, c = 1.5, d = 2.4.
    ratio = 1.0 + 1.0 / ((61.0 / reduction**2.4 + 1.5) * (0.5 * 1.07 / 0.61) ** 2.4)
    assert found.deformation_ratio == pytest.approx(ratio, rel=1e-12)


def test_deformation_ratio_by_hand() -> None:
    # R = 4, T = T_c, elastoplastic: 4^2.4 = 27.8576, 61/27.8576 = 2.18971, + 1.5 = 3.68971, inverse 0.271024.
    assert deformation_ratio(4.0, 1.0, 0.0) == pytest.approx(1.271024, abs=1e-6)
    # T to 0: C_R is L_R = (1 + (R - 1)/alpha)/R; T to infinity: 1.
    assert deformation_ratio(4.0, 1e-9, 0.05) == pytest.approx((1.0 + 3.0 / 0.05) / 4.0, rel=1e-9)
    assert deformation_ratio(4.0, 1e9, 0.05) == pytest.approx(1.0, abs=1e-12)
    assert deformation_ratio(1.0, 0.1, 0.05) == 1.0
    assert deformation_ratio(4.0, 1.0, 1.0) == 1.0


@pytest.mark.parametrize("deformation", ["ratio", "median"])
def test_scaled_motions_reach_the_target_in_a_simulation(deformation: str) -> None:
    found = sm.scaling.scale_modal_pushover(SUITE, TARGET, period=1.0, reduction=4.0, deformation=deformation)
    assert found.reduction == pytest.approx(4.0, rel=1e-14)
    strength = float(TARGET(1.0)) / 4.0 / G
    assert found.oscillator.yield_coefficient == pytest.approx(strength, rel=1e-14)
    building = sm.Building.uniform(1, 1.0, yield_shear_over_weight=strength)
    for record, factor in zip(SUITE, found.factors, strict=True):
        motion = record.scaled(factor).with_duration(record.duration + 6.0).motion
        drift = sm.simulate(sm.Scene(building), motion).peak_drift[0]
        # The factor is known to 1e-10; the deformation follows it within a few times that.
        assert drift == pytest.approx(found.target_deformation, rel=2e-9)
    np.testing.assert_allclose(found.deformations, found.target_deformation, rtol=2e-9)
    np.testing.assert_allclose(found.diagnostics()["deformation_over_target"], 1.0, rtol=2e-9)


def test_median_is_that_of_the_suite_at_the_elastic_target() -> None:
    found = sm.scaling.scale_modal_pushover(SUITE, TARGET, period=1.0, reduction=4.0, deformation="median")
    building = sm.Building.uniform(1, 1.0, yield_shear_over_weight=float(TARGET(1.0)) / 4.0 / G)
    factors = sm.scaling.scale_sa_t1(SUITE, TARGET, 1.0).factors
    drifts = [
        sm.simulate(sm.Scene(building), record.scaled(factor).with_duration(record.duration + 6.0).motion).peak_drift[0]
        for record, factor in zip(SUITE, factors, strict=True)
    ]
    assert found.target_deformation == pytest.approx(np.median(drifts), rel=1e-12)


def test_strength_by_coefficient_or_reduction() -> None:
    one = sm.scaling.scale_modal_pushover(SUITE, TARGET, period=0.8, reduction=3.0)
    coefficient = float(TARGET(0.8)) / 3.0 / G
    other = sm.scaling.scale_modal_pushover(SUITE, TARGET, period=0.8, yield_coefficient=coefficient)
    np.testing.assert_allclose(one.factors, other.factors, rtol=1e-9)


def motions_of_several_roots() -> list[sm.Motion]:
    motions = []
    for seed in range(12):
        rng = np.random.default_rng(seed)
        envelope = np.sin(np.linspace(0.0, np.pi, 1200)) ** 2
        motions.append(sm.Motion(envelope * np.convolve(rng.standard_normal(1200), np.ones(12) / 12.0, "same"), 0.01))
    return motions


def test_several_factors_are_all_reported_and_the_nearest_1_is_taken() -> None:
    motions = motions_of_several_roots()
    found = sm.scaling.scale_modal_pushover(
        motions, TARGET, period=0.6, reduction=1.5, overstrength=1.0, second_slope=0.0
    )
    several = [number for number, roots in enumerate(found.roots) if len(roots) > 1]
    assert several
    spring = {"overstrength": 1.0, "second_slope": 0.0}
    oscillator = found.oscillator
    for number in several:
        roots = found.roots[number]
        assert (np.diff(roots) > 0.0).all()
        assert found.factors[number] == roots[np.argmin(np.abs(np.log(roots)))]
        # Each of them, by a spectrum of constant strength: the motion times s, or the strength over s.
        strengths = oscillator.yield_coefficient / roots
        spectrum = sm.spectra.inelastic_spectrum(motions[number], [0.6], strength=strengths, **spring)
        reached = spectrum.displacement[0, :, 0] * roots
        np.testing.assert_allclose(reached, found.target_deformation, rtol=1e-8)
        remark = f"motion {number + 1} (motion {number + 1}) reaches the target deformation at several factors"
        assert any(note.startswith(remark) for note in found.notes)
    # An odd number of passages, as the deformation begins below the target and ends above.
    assert all(len(roots) % 2 == 1 for roots in found.roots)
    # A fine search by another path finds no other, in the range of all roots of the first such motion.
    number = several[0]
    factors = np.geomspace(0.5 * found.roots[number][0], 2.0 * found.roots[number][-1], 1500)
    spectrum = sm.spectra.inelastic_spectrum(
        motions[number], [0.6], strength=oscillator.yield_coefficient / factors, **spring
    )
    above = spectrum.displacement[0, :, 0] * factors >= found.target_deformation
    assert np.count_nonzero(above[:-1] != above[1:]) == len(found.roots[number])


def test_oscillator_of_one_storey_is_the_storey() -> None:
    building = sm.Building.uniform(1, 0.6, yield_shear_over_weight=0.2, overstrength=1.7, second_slope=0.1)
    found = sm.scaling.first_mode_oscillator(building)
    assert found.period == pytest.approx(0.6, rel=1e-14)
    assert found.yield_coefficient == pytest.approx(0.2, rel=1e-12)
    assert (found.overstrength, found.second_slope) == pytest.approx((1.7, 0.1), rel=1e-12)
    assert found.third_slope == 0.0
    assert found.damping == pytest.approx(0.05, rel=1e-12)


def shares_of(building: sm.Building) -> tuple[np.ndarray, float, float]:
    """V_i/V_b under s = m phi_1, M1* and w1, by a dense eigenvalue solution."""
    k = building.stiffness
    stiffness = np.diag(k + np.append(k[1:], 0.0)) - np.diag(k[1:], 1) - np.diag(k[1:], -1)
    root = np.sqrt(building.mass)
    squares, vectors = np.linalg.eigh(stiffness / np.outer(root, root))
    shape = vectors[:, 0] / root
    loads = building.mass * shape
    modal_mass = loads.sum() ** 2 / (loads @ shape)
    return np.cumsum(loads[::-1])[::-1] / loads.sum(), modal_mass, float(np.sqrt(squares[0]))


def test_storeys_that_yield_at_once_give_the_exact_curve() -> None:
    elastic = sm.Building.uniform(4, 0.8, mass=2e5)
    shares, modal_mass, _ = shares_of(elastic)
    base_shear = 0.15 * elastic.weight
    building = elastic.replace(yield_shear=shares * base_shear, overstrength=2.0, second_slope=0.05, third_slope=0.01)
    found = sm.scaling.first_mode_oscillator(building)
    assert found.period == pytest.approx(0.8, rel=1e-12)
    assert found.yield_acceleration == pytest.approx(base_shear / modal_mass, rel=1e-9)
    assert found.overstrength == pytest.approx(2.0, rel=1e-9)
    assert found.second_slope == pytest.approx(0.05, rel=1e-8)
    assert found.third_slope == pytest.approx(0.01, rel=1e-8)


def test_idealised_curve_has_the_corner_and_the_area_of_the_pushover() -> None:
    building = sm.Building(
        [2e5, 1.5e5, 1e5],
        [9e7, 7e7, 4e7],
        yield_shear=[6e5, 4e5, 2.8e5],
        overstrength=[2.0, 1.5, 1.8],
        second_slope=[0.05, 0.1, 0.03],
    )
    shares, modal_mass, w = shares_of(building)
    found = sm.scaling.first_mode_oscillator(building)
    assert found.frequency == pytest.approx(w, rel=1e-12)

    def force(i: int, drift: float) -> float:
        k, v_y = building.stiffness[i], building.yield_shear[i]
        u_y = v_y / k
        u_2 = u_y + (building.overstrength[i] - 1.0) * v_y / (building.second_slope[i] * k)
        return k * min(drift, u_y) + building.second_slope[i] * k * (min(max(drift, u_y), u_2) - u_y)

    ultimate = float((building.overstrength * building.yield_shear / shares).min())

    def roof(base_shear: float) -> float:
        # Each storey's drift by root finding on its own backbone.
        return sum(brentq(lambda d, i=i: force(i, d) - shares[i] * base_shear, 0.0, 10.0, xtol=1e-15) for i in range(3))

    shears = np.linspace(0.0, ultimate * (1.0 - 1e-12), 4001)
    curve = np.array([roof(shear) for shear in shears])
    area = np.trapezoid(shears, curve)
    initial = 1.0 / np.sum(shares / building.stiffness)
    first = found.yield_acceleration * modal_mass
    last = first * found.overstrength
    assert last == pytest.approx(ultimate, rel=1e-9)
    u_1, u_2 = first / initial, curve[-1]
    # The corners lie between samples: the trapezoidal rule is good to 1e-6 of the area.
    assert 0.5 * first * u_1 + 0.5 * (first + last) * (u_2 - u_1) == pytest.approx(area, rel=1e-6)
    assert found.second_slope * initial == pytest.approx((last - first) / (u_2 - u_1), rel=1e-8)
    assert found.third_slope == 0.0


def test_elastoplastic_storeys_give_an_elastoplastic_oscillator() -> None:
    building = sm.Building.uniform(3, 0.6, yield_shear_over_weight=0.2, overstrength=1.0, second_slope=0.0)
    modal_mass = shares_of(building)[1]
    found = sm.scaling.first_mode_oscillator(building)
    # Equal strengths: the first storey, of the largest shear, forms the mechanism.
    assert found.yield_acceleration == pytest.approx(0.2 * building.weight / modal_mass, rel=1e-12)
    assert (found.overstrength, found.second_slope, found.third_slope) == (1.0, 0.0, 0.0)


@pytest.mark.parametrize("plastic", [[0], [1], [0, 2], [0, 1, 2]])
def test_a_storey_without_slope_is_a_mechanism(plastic: list[int]) -> None:
    """Whichever it is the base shear rises no more; without one, storeys are springs in series."""
    slopes = np.array([0.04, 0.05, 0.06])
    building = sm.Building.uniform(3, 0.6, yield_shear_over_weight=0.2, second_slope=slopes)
    shares = np.array([1.0, 0.7, 0.4])
    yields = 1.1 * float((building.yield_shear / shares).max())
    series = 1.0 / (shares / (slopes * building.stiffness)).sum()
    strong = building.replace(overstrength=10.0)  # no storey reaches it
    assert _slope_behind(strong, shares, yields) == pytest.approx(series, rel=1e-12)
    slopes[plastic] = 0.0
    assert _slope_behind(strong.replace(second_slope=slopes), shares, yields) == 0.0


def test_p_delta_is_left_out_and_said() -> None:
    plain = sm.Building.uniform(2, 0.5, mass=1e5, yield_shear_over_weight=0.2)
    heavy = plain.replace(geometric_stiffness=[0.02 * plain.stiffness[0], 0.01 * plain.stiffness[1]])
    assert sm.scaling.first_mode_oscillator(heavy) == sm.scaling.first_mode_oscillator(plain)
    note = "P-Delta is left out of the pushover: P/h is up to 2 % of k (storey 1)"
    assert note in sm.scaling.scale_modal_pushover(SUITE[:2], TARGET, heavy).remarks
    assert not any("P-Delta" in remark for remark in sm.scaling.scale_modal_pushover(SUITE[:2], TARGET, plain).remarks)


def test_damping_of_the_first_mode() -> None:
    building = sm.Building.uniform(3, 0.6, mass=1e5, damping=sm.Rayleigh(0.03, (1, 3)))
    assert sm.scaling.first_mode_oscillator(building).damping == pytest.approx(0.03, rel=1e-9)


def test_scaling_by_a_building_is_that_of_its_oscillator() -> None:
    building = sm.Building.uniform(3, 0.6, yield_shear_over_weight=[0.24, 0.20, 0.12])
    found = sm.scaling.scale_modal_pushover(SUITE, TARGET, building)
    oscillator = found.oscillator
    again = sm.scaling.scale_modal_pushover(
        SUITE,
        TARGET,
        period=oscillator.period,
        yield_coefficient=oscillator.yield_coefficient,
        overstrength=oscillator.overstrength,
        second_slope=oscillator.second_slope,
        third_slope=oscillator.third_slope,
        damping=oscillator.damping,
    )
    np.testing.assert_array_equal(found.factors, again.factors)
    assert again.second_mode_ratio is None
    at = float(building.periods[1])
    expected = found.factors * sm.response_spectrum(SUITE, [at])[:, 0] / TARGET(at)
    # The damping of the oscillator is 0.05 but for rounding.
    np.testing.assert_allclose(found.second_mode_ratio, expected, rtol=1e-10)
    assert found.diagnostics()["second_mode_ratio"].to_list() == found.second_mode_ratio.tolist()
    elastic = sm.scaling.scale_modal_pushover(SUITE, TARGET, sm.Building.uniform(3, 0.6))
    np.testing.assert_allclose(elastic.factors, sm.scaling.scale_sa_t1(SUITE, TARGET, 0.6).factors, rtol=1e-10)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        (
            {},
            sm.errors.InvalidOption,
            "yield_coefficient of scaling must be given, or reduction, not both, where there is no",
        ),
        ({"reduction": 2.0, "yield_coefficient": 0.1}, sm.errors.InvalidOption, "no building; got both"),
        ({"reduction": 0.0}, sm.errors.InvalidOption, "reduction of scaling must be a positive number; got 0"),
        (
            {"yield_coefficient": -1.0},
            sm.errors.InvalidOption,
            "yield_coefficient of scaling must be a positive number",
        ),
        ({"reduction": 2.0, "period": "T"}, sm.errors.InvalidOption, "period of scaling must be a number; got 'T'"),
        (
            {"reduction": 2.0, "deformation": "x"},
            sm.errors.InvalidOption,
            "deformation of scaling must be ratio or med",
        ),
        (
            {"reduction": 2.0, "corner_period": 0.0},
            sm.errors.InvalidOption,
            "corner_period of scaling must be a positive",
        ),
        ({"reduction": 2.0, "second_slope": "x"}, sm.errors.InvalidOption, "second_slope of scaling must be a number"),
        ({"reduction": 2.0, "overstrength": 0.5}, sm.errors.InvalidScene, "overstrength of storey 1"),
        ({"building": 1.0}, sm.errors.InvalidOption, "building of scaling must be a Building; got 1.0"),
        (
            {"building": sm.Building.uniform(2, 0.5), "reduction": 2.0},
            sm.errors.InvalidOption,
            "reduction of scaling must be left out where a building is given; got 2.0",
        ),
        (
            {"records": [], "reduction": 2.0},
            sm.errors.InvalidMotion,
            "motions of scaling must be at least one Record or",
        ),
        (
            {"records": sm.Motion([0.0, 0.0], 0.01), "reduction": 2.0},
            sm.errors.InvalidMotion,
            "acceleration of motion 1 must be other than zero somewhere; got zero throughout",
        ),
    ],
)
def test_bad_arguments_are_refused(arguments: dict, error: type[sm.SeismassError], message: str) -> None:
    with pytest.raises(error, match=re.escape(message)):
        sm.scaling.scale_modal_pushover(**({"records": SUITE, "target": TARGET} | arguments))
