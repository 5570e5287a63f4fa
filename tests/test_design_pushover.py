"""Pushover: paths by hand, equilibrium, springs of the kernel driven along the path, and a slow run of the kernel."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure

import seismass as sm
from seismass import design
from seismass.design.scaling.oscillator import pushover_curve


def along_the_kernel(building: sm.Building, path: design.Pushover) -> None:
    """Forces of the kernel's springs, driven along the drifts of the path, are those of the path."""
    for storey in range(building.storeys):
        kernel = sm.runs.spring_forces(building, storey + 1, path.drift[:, storey])
        # Both add up a few dozen products of doubles.
        scale = np.abs(path.spring_force[:, storey]).max()
        np.testing.assert_allclose(kernel.force, path.spring_force[:, storey], rtol=0.0, atol=1e-11 * scale)


def p_delta(building: sm.Building) -> np.ndarray:
    if building.geometric_stiffness is not None:
        return building.geometric_stiffness
    if building.gravity_load is None:
        return np.zeros(building.storeys)
    return np.cumsum(building.gravity_load[::-1])[::-1] / building.heights


def in_equilibrium(building: sm.Building, path: design.Pushover) -> None:
    share = np.cumsum(path.force[::-1])[::-1]
    left = path.spring_force - p_delta(building) * path.drift
    # Points where storeys reach corners together within rounding are one.
    np.testing.assert_allclose(left, share * path.base_shear[:, None], rtol=0.0, atol=1e-10 * path.capacity)


def test_two_trilinear_storeys_by_hand() -> None:
    """Equal forces on two floors: V_1 = V, V_2 = V/2; k = 100, r2 = 0.1, Omega = 1.5, V_y = 10 and 3, then flat.

    Storey 2 yields at V = 6, d = 0.03; storey 1 at 10, 0.1; storey 2 is flat from V_2 = 4.5, V = 9, at
    d_2 = 0.03 + 1.5/10 = 0.18, where d_1 = 0.09: its mechanism, before storey 1 yields.
    """
    building = sm.Building([1.0, 1.0], 100.0, yield_shear=[10.0, 3.0], overstrength=1.5, second_slope=0.1)
    path = design.pushover(building, [2.0, 2.0], drift_limit=0.5)
    np.testing.assert_allclose(path.base_shear, [0.0, 6.0, 9.0, 9.0], rtol=1e-14)
    np.testing.assert_allclose(path.drift, [[0, 0], [0.06, 0.03], [0.09, 0.18], [0.09, 0.5]], rtol=1e-13)
    assert (path.mechanism, path.end) == (2, "drift limit")
    assert path.capacity == pytest.approx(9.0)
    assert path.stiffness == pytest.approx(1.0 / (1.0 / 100.0 + 0.5 / 100.0))
    assert path.events.select("point", "storey", "kind").rows() == [
        (1, 2, "yield"),
        (2, 2, "yield"),
        (2, 2, "capacity"),
        (3, 2, "drift limit"),
    ]
    np.testing.assert_allclose(path.base_shear_at([0.0, 0.045, 0.18, 0.3, 0.6]), [0.0, 3.0, 7.5, 9.0, np.nan])
    along_the_kernel(building, path)


def test_p_delta_of_one_storey_by_hand() -> None:
    """k = 100, V_y = 10, plateau, P/h = 20: (100 - 20) d up to V = 8 at 0.1, then 10 - 20 d, zero at d = 0.5."""
    building = sm.Building(1.0, 100.0, yield_shear=10.0, overstrength=1.0, heights=3.0, gravity_load=60.0)
    path = design.pushover(building)
    np.testing.assert_allclose(path.drift[:, 0], [0.0, 0.1, 0.15], rtol=1e-13)  # 5 % of 3 m
    np.testing.assert_allclose(path.base_shear, [0.0, 8.0, 7.0], rtol=1e-13)
    whole = design.pushover(building, drift_limit=1.0)
    assert whole.drift[-1, 0] == pytest.approx(0.5, rel=1e-13)
    assert (whole.base_shear[-1], whole.end, whole.mechanism) == (0.0, "no strength left", 1)
    heavier = design.pushover(building, drift_limit=1.0, added_load=[60.0])
    np.testing.assert_allclose(heavier.base_shear, [0.0, 6.0, 0.0], rtol=1e-13, atol=1e-13)
    assert heavier.drift[-1, 0] == pytest.approx(0.25, rel=1e-13)


def test_softening_storey_unloads_the_other_and_snaps_back() -> None:
    """Storey 1 falls with -k from V_y = 10 at 0.1 to zero at 0.2; storey 2 (k_2 = 50) unloads by 0.2, to zero.

    Roof displacement 0.1 + 0.2 at the peak and 0.2 at the end: it goes back.
    """
    building = sm.Building(
        [1.0, 1.0],
        [100.0, 50.0],
        yield_shear=[10.0, 1e3],
        overstrength=1.0,
        second_slope=0.0,
        third_slope=[-1.0, 0.0],
        hysteresis="peak-oriented",
    )
    path = design.pushover(building, [0.0, 1.0], drift_limit=1.0)
    np.testing.assert_allclose(path.drift, [[0, 0], [0.1, 0.2], [0.2, 0.0]], rtol=0.0, atol=1e-14)
    np.testing.assert_allclose(path.base_shear, [0.0, 10.0, 0.0], rtol=1e-13)
    assert path.end == "no strength left"
    np.testing.assert_allclose(path.base_shear_at([0.15, 0.3, 0.31]), [5.0, 10.0, np.nan], rtol=1e-13)


def test_residual_strength_is_a_plateau() -> None:
    """From V_y = 10 at 0.1 with -0.5 k down to 0.4 V_y: 4 at 0.1 + 6/50 = 0.22, then flat."""
    building = sm.Building(
        1.0,
        100.0,
        yield_shear=10.0,
        overstrength=1.0,
        third_slope=-0.5,
        residual_strength=0.4,
        hysteresis="peak-oriented",
    )
    path = design.pushover(building, drift_limit=0.3)
    np.testing.assert_allclose(path.drift[:, 0], [0.0, 0.1, 0.22, 0.3], rtol=1e-13)
    np.testing.assert_allclose(path.base_shear, [0.0, 10.0, 4.0, 4.0], rtol=1e-13)


def test_multilinear_backbone_is_the_path_of_one_storey() -> None:
    points = [[0.01, 100.0], [0.03, 200.0], [0.08, 300.0], [0.2, 360.0]]
    building = sm.Building(1.0, backbone=points)
    path = design.pushover(building, drift_limit=0.32)
    np.testing.assert_allclose(path.drift[:, 0], [0.0, 0.01, 0.03, 0.08, 0.32], rtol=1e-13)
    # The last slope, 60/0.12 = 500, goes on: 300 + 0.24 x 500.
    np.testing.assert_allclose(path.base_shear, [0.0, 100.0, 200.0, 300.0, 420.0], rtol=1e-13)


def test_storeys_of_one_strength_share_a_plateau() -> None:
    """Strengths as the shears: all storeys yield at once, and drift on as S_i/k_i without P-Delta."""
    building = sm.Building.uniform(3, 0.6, mass=1.0, yield_shear_over_weight=[0.24, 0.20, 0.12], overstrength=1.0)
    path = design.pushover(building, [1.0, 2.0, 3.0], drift_limit=1.0)
    assert path.drift[-1] == pytest.approx([1.0, 5.0 / 6.0, 0.5], rel=1e-12)
    assert path.capacity == pytest.approx(0.24 * building.weight, rel=1e-13)
    # With P-Delta they fall; with equal P/h the steepest over its shear is that of storey 3, and the others unload.
    falling = design.pushover(building.replace(geometric_stiffness=5.0), [1.0, 2.0, 3.0], drift_limit=1.0)
    assert falling.mechanism == 3
    assert (falling.drift[-1, :2] < falling.drift[1, :2]).all()
    in_equilibrium(building.replace(geometric_stiffness=5.0), falling)


def test_a_stop_lets_the_base_shear_grow_again() -> None:
    """Two storeys with P/h = 20, plateau at 10 and 12: storey 1 falls, its stop closes at 0.3, then storey 2 yields."""
    building = sm.Building(
        [1.0, 1.0],
        100.0,
        yield_shear=[10.0, 12.0],
        overstrength=1.0,
        clearance=0.3,
        stop_stiffness=200.0,
        geometric_stiffness=20.0,
    )
    path = design.pushover(building, [0.0, 1.0], drift_limit=0.5)
    assert path.events["kind"].to_list()[:3] == ["yield", "capacity", "close"]
    # 10 - 20 x 0.3 = 4 at the stop; storey 2 unloaded to 4/80 = 0.05 there, and yields at 12 - 20 x 0.12 = 9.6.
    np.testing.assert_allclose(path.base_shear[:3], [0.0, 8.0, 4.0], rtol=1e-12)
    np.testing.assert_allclose(path.drift[2], [0.3, 0.05], rtol=1e-12)
    assert path.events.filter(kind="capacity")["storey"].to_list() == [1, 2]
    assert path.events.filter(kind="capacity")["base_shear"][1] == pytest.approx(9.6, rel=1e-12)
    in_equilibrium(building, path)
    along_the_kernel(building, path)


def test_patterns() -> None:
    building = sm.Building([3.0, 2.0, 1.0], [900.0, 700.0, 500.0], heights=[4.0, 3.0, 3.0])
    first = design.vibration_modes(building.mass, building.stiffness).shapes[:, 0]
    expected = {"modal": building.mass * first, "uniform": building.mass}
    expected["code"] = building.mass * np.array([4.0, 7.0, 10.0]) ** design.exponent_k(building.periods[0])
    for pattern, force in expected.items():
        path = design.pushover(building, pattern)
        np.testing.assert_allclose(path.force, force / force.sum(), rtol=1e-12)
    # Elastic: a straight line up to the drift limit of 5 %, with the mode's shape.
    path = design.pushover(building, "modal")
    displacement = np.cumsum(path.drift[-1])
    np.testing.assert_allclose(displacement / displacement[-1], first / first[-1], rtol=1e-12)
    assert path.mechanism is None
    assert (path.drift[-1] / building.heights).max() == pytest.approx(0.05)


@st.composite
def buildings(draw: st.DrawFn) -> sm.Building:
    storeys = draw(st.integers(1, 4))

    def listed(low: float, high: float) -> list[float]:
        return draw(st.lists(st.floats(low, high), min_size=storeys, max_size=storeys))

    stiffness = np.array(listed(50.0, 200.0))
    shape: dict[str, object] = {"overstrength": listed(1.0, 2.5), "yield_shear": listed(5.0, 20.0)}
    second = np.array(listed(0.02, 0.5))
    law = draw(st.sampled_from(["masing", "gap", "peak-oriented", "mixed"]))
    share = np.array(listed(0.0, 1.0))
    shape["third_slope"] = share * second
    if law in ("peak-oriented", "mixed"):
        kinds = ["peak-oriented"] if law == "peak-oriented" else ["masing", "peak-oriented"]
        hysteresis = [
            "peak-oriented",
            *draw(st.lists(st.sampled_from(kinds), min_size=storeys - 1, max_size=storeys - 1)),
        ]
        softening = np.minimum(share * (0.3 + second) - 0.3, second)
        shape["third_slope"] = np.where(np.array(hysteresis) == "masing", share * second, softening)
        shape |= {
            "hysteresis": hysteresis,
            "residual_strength": listed(0.0, 0.6),
            "unloading_exponent": listed(0.0, 0.6),
        }
    if law == "gap":
        shape |= {"clearance": listed(0.2, 1.0), "stop_stiffness": listed(50.0, 300.0)}
    return sm.Building(
        listed(0.5, 2.0),
        stiffness,
        second_slope=second,
        geometric_stiffness=np.array(listed(0.0, 0.2)) * stiffness,
        **shape,  # type: ignore[arg-type]
    )


@settings(max_examples=150, deadline=None)
@given(buildings())
def test_path_of_any_law_is_in_equilibrium_and_that_of_the_kernels_springs(building: sm.Building) -> None:
    path = design.pushover(building, "uniform", drift_limit=2.0)
    in_equilibrium(building, path)
    along_the_kernel(building, path)
    assert (path.drift <= 2.0 * (1.0 + 1e-12)).all()
    assert path.end in {"drift limit", "no strength left", "unstable unloading"}


def test_slow_run_of_the_kernel_follows_the_path() -> None:
    """A ground acceleration that grows slowly loads the floors in proportion to their masses."""
    building = sm.Building.uniform(3, 0.3, mass=1.0, yield_shear_over_weight=[0.24, 0.20, 0.12], heights=3.0)
    path = design.pushover(building, "uniform")
    # Up to 1.4 V_y of storey 1 in 3000 s. What damping takes is in proportion to the rate: the drift lags by 2 zeta/w
    # over r2, 0.1 s, of the 900 s in which it yields.
    top = 1.4 * 0.24 * sm.STANDARD_GRAVITY
    motion = sm.Motion(np.linspace(0.0, -top, 301), 10.0)
    response = sm.simulate(sm.Scene(building), motion, histories=True)
    wanted = top * building.mass.sum()
    drift = [np.interp(wanted, path.base_shear, path.drift[:, i]) for i in range(3)]
    np.testing.assert_allclose(response.drift[-1], drift, rtol=5e-4)
    assert (response.peak_drift > 1.05 * building.yield_shear / building.stiffness)[0]


def test_curve_is_that_of_modal_pushover_scaling() -> None:
    """The curve of scaling is another implementation: trilinear storeys, no P-Delta, up to the first mechanism."""
    building = sm.Building.uniform(3, 0.6, yield_shear_over_weight=[0.24, 0.15, 0.11], overstrength=[1.8, 2.2, 1.5])
    path = design.pushover(building, "modal", drift_limit=10.0)
    share = np.cumsum(path.force[::-1])[::-1]
    base_shear = np.linspace(0.0, 0.999, 200) * path.capacity
    roof = pushover_curve(building, share, base_shear)
    np.testing.assert_allclose(
        np.interp(base_shear, path.base_shear[:-1], path.roof_displacement[:-1]), roof, rtol=1e-12
    )


def test_table_and_figure() -> None:
    building = sm.Building.uniform(2, 0.4, mass=1e5, yield_shear_over_weight=0.2, heights=[4.0, 3.0])
    path = design.pushover(building, "code")
    table = path.table()
    np.testing.assert_allclose(table["base_shear_over_weight"], path.base_shear / building.weight, rtol=1e-15)
    np.testing.assert_allclose(table["drift_ratio_1"], path.drift[:, 0] / 4.0, rtol=1e-15)
    assert table.columns[:4] == ["point", "base_shear", "base_shear_over_weight", "roof_displacement"]
    drawn = path.plot()
    assert isinstance(drawn, Figure)
    line = drawn.axes[0].lines[0]
    np.testing.assert_allclose(line.get_ydata(), path.base_shear / building.weight)
    np.testing.assert_allclose(line.get_xdata(), 1e3 * path.roof_displacement)
    own = Figure()
    axes = own.subplots()
    assert path.plot(ax=axes) is own
    assert sm.plots.pushover(path, labels=False, ax=axes) is own
    with pytest.raises(sm.errors.InvalidOption, match="ax of pushover figure must be one Axes"):
        path.plot(ax="here")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"pattern": "code"}, "pattern of pushover must be modal or uniform where no heights are known; got 'code'"),
        (
            {"pattern": "triangle"},
            "pattern of pushover must be modal, uniform, code or a list of forces; got 'triangle'",
        ),
        ({"pattern": [1.0]}, "pattern of pushover must be a list of 2 forces, one per floor; got 1 values"),
        ({"pattern": [2.0, -1.0]}, "pattern of pushover must be forces with a positive shear in every storey"),
        ({"drift_limit": None}, "drift_limit of pushover must be given where no heights are known; got none"),
        ({"added_load": [1.0, 1.0]}, "added_load of pushover must be left out without gravity_load"),
    ],
)
def test_bad_arguments_are_refused(arguments: dict, message: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=message):
        design.pushover(sm.Building([1.0, 1.0], 100.0), **({"drift_limit": 1.0} | arguments))
    with pytest.raises(sm.errors.InvalidOption, match="building of pushover must be a Building; got"):
        design.pushover(sm.Scene(sm.Building([1.0, 1.0], 100.0)))  # type: ignore[arg-type]


def storeys_as_matrix(stiffness: list[float]) -> np.ndarray:
    """Stiffness of a chain of storeys over its floors."""
    down = np.eye(len(stiffness)) - np.eye(len(stiffness), k=-1)
    return down.T @ np.diag(stiffness) @ down


def test_one_storey_beside_a_wall_by_hand() -> None:
    """k = 100, V_y = 5, flat; a wall of 20 beside it: slope 120 up to d = 0.05, V = 6; then 20 up to 0.3, V = 11."""
    building = sm.Building([1.0], 100.0, yield_shear=5.0, overstrength=1.0, stiffness_matrix=[[20.0]])
    path = design.pushover(building, "uniform", drift_limit=0.3)
    np.testing.assert_allclose(path.base_shear, [0.0, 6.0, 11.0], rtol=1e-14)
    np.testing.assert_allclose(path.roof_displacement, [0.0, 0.05, 0.3], rtol=1e-14)
    np.testing.assert_allclose(path.wall_shear[:, 0], [0.0, 1.0, 6.0], rtol=1e-13)
    np.testing.assert_allclose(path.spring_force[:, 0], [0.0, 5.0, 5.0], rtol=1e-14)
    assert (path.mechanism, path.end) == (None, "drift limit")


@pytest.mark.parametrize("third", [0.1, -0.05])
def test_storeys_as_springs_and_as_a_matrix_give_one_path(third: float) -> None:
    """A bilinear spring is an elastic one of 0.1 k, here in the matrix, beside one of 0.9 k with a lower last slope."""
    stiffness, strength = np.array([400.0, 300.0, 200.0]), np.array([8.0, 5.0, 4.0])
    given: dict[str, object] = {"overstrength": 1.0, "damping": 0.0}
    if third < 0.0:
        given["hysteresis"] = "peak-oriented"
    springs = sm.Building(np.ones(3), stiffness, yield_shear=strength, second_slope=0.1, third_slope=third, **given)
    mixed = sm.Building(
        np.ones(3),
        0.9 * stiffness,
        yield_shear=0.9 * strength,
        third_slope=(third - 0.1) / 0.9,
        stiffness_matrix=storeys_as_matrix((0.1 * stiffness).tolist()),
        **given,
    )
    force = [1.0, 1.0, 1.0]
    series = design.pushover(springs, force, drift_limit=0.1)
    walls = design.pushover(mixed, force, drift_limit=0.1)
    np.testing.assert_allclose(walls.base_shear, series.base_shear, rtol=1e-12)
    np.testing.assert_allclose(walls.drift, series.drift, rtol=1e-11, atol=1e-14)
    np.testing.assert_allclose(walls.spring_force + walls.wall_shear, series.spring_force, rtol=1e-11)
    assert (walls.end, walls.mechanism) == (series.end, series.mechanism)
    assert walls.events["kind"].to_list() == series.events["kind"].to_list()


def test_a_flat_storey_that_no_wall_holds_drifts_alone() -> None:
    """A brace of 50 beside storey 1 alone; storey 2 is flat at V_2 = V/2 = 3: the base shear ends at 6."""
    brace = [[50.0, 0.0], [0.0, 0.0]]
    building = sm.Building([1.0, 1.0], 100.0, yield_shear=[50.0, 3.0], overstrength=1.0, stiffness_matrix=brace)
    path = design.pushover(building, "uniform", drift_limit=0.5)
    np.testing.assert_allclose(path.base_shear, [0.0, 6.0, 6.0], rtol=1e-13)
    np.testing.assert_allclose(path.drift, [[0, 0], [0.04, 0.03], [0.04, 0.5]], rtol=1e-12)
    assert (path.capacity, path.mechanism, path.end) == (pytest.approx(6.0), 2, "drift limit")


@pytest.mark.parametrize("seed", range(12))
def test_walls_are_in_equilibrium_along_the_path(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 9))
    soft = bool(rng.integers(2))
    frame = sm.Building(
        rng.uniform(0.5, 2.0, n),
        rng.uniform(50.0, 200.0, n),
        yield_shear=rng.uniform(1.0, 6.0, n),
        overstrength=rng.uniform(1.0, 2.0, n),
        third_slope=rng.uniform(-0.4, 0.0, n) if soft else 0.0,
        hysteresis="peak-oriented" if soft else "masing",
        heights=rng.uniform(2.0, 4.0, n),
        gravity_load=rng.uniform(0.0, 5.0, n),
    )
    building = design.Wall.of_alpha_h(frame, float(rng.uniform(1.0, 8.0))).beside(frame)
    path = design.pushover(building, "code")
    share = np.cumsum(path.force[::-1])[::-1]
    left = path.spring_force + path.wall_shear - p_delta(building) * path.drift
    np.testing.assert_allclose(left, share * path.base_shear[:, None], rtol=0.0, atol=1e-9 * path.capacity)
    along_the_kernel(frame, path)
    # The walls' shear is what the matrix gives at the displacements of the floors.
    forces = np.cumsum(path.drift, axis=1) @ building.stiffness_matrix
    expected = np.cumsum(forces[:, ::-1], axis=1)[:, ::-1]
    np.testing.assert_allclose(path.wall_shear, expected, rtol=0.0, atol=1e-9 * path.capacity)
