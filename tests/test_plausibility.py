"""Remarks on inputs that are valid but unlikely. The limits are those that the module states."""

import json
import re
import warnings

import numpy as np
import pytest

import seismass as sm
from seismass.base.units import STANDARD_GRAVITY as G
from seismass.cli import main
from seismass.model.plausibility import motion_remarks
from seismass.motions.spectra.target import target_remarks


def scene(mu=0.4, **building):
    arguments = {"mass": [1e5, 1e5], "stiffness": 1e8, "yield_shear": 4e5, "heights": 3.5} | building
    return sm.Scene(sm.Building(**arguments), [sm.Block(floor, mass=5e4, mu=mu) for floor in (1, 2)])


def test_usual_inputs_have_no_remark():
    usual = scene(gravity_load=1e6)
    assert usual.remarks == ()
    assert sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.3)]).remarks == ()
    suite = sm.builtin_suite("seven")
    target = sm.TargetSpectrum.asce7()
    assert motion_remarks(suite) == target_remarks(target) == ()
    scaling = sm.scaling.scale_asce7_10(suite, target)
    # The built-in suite is made for this target: all factors are within 0.2 to 5.
    assert ((scaling.factors > 0.2) & (scaling.factors < 5.0)).all()
    assert scaling.remarks == scaling.doubts == ()


W = 2e5 * G


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"mu": 1.5}, None),
        ({"mu": 1.6}, "mu_s of block 1 is 1.6, above 1.5 (and 1 more)"),
        ({"heights": [3.5, 20.0]}, None),
        ({"heights": [3.5, 21.0]}, "height of storey 2 is 21 m, above 20 m:"),
        ({"yield_shear": 4.99 * W}, None),
        ({"yield_shear": [6.0 * W, 4e5]}, "V_y of storey 1 is 6 of the weight W"),
        ({"yield_shear": np.inf}, None),
        ({"yield_shear": 1.01e-4 * W}, None),
        ({"yield_shear": [4e5, 5e-5 * W]}, "V_y of storey 2 is 5e-05 of the weight W"),
        ({"gravity_load": [1e6, 1e3]}, "gravity load of floor 2 is 0.00102 of the weight of its mass:"),
        ({"gravity_load": [1e6, 0.0]}, None),
    ],
)
def test_scene_beyond_a_limit_has_a_remark(changes, expected):
    remarks = scene(**changes).remarks
    assert len(remarks) == (expected is not None), remarks
    assert not remarks or remarks[0].startswith(expected)


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({"base": sm.SlidingBase(mu=1.5, radius=99.0)}, None),
        ({"base": sm.SlidingBase(mu=20.0)}, "mu_s of the base is 20, above 1.5: friction coefficients are ratios"),
        ({"base": sm.SlidingBase(mu=0.1, radius=2000.0)}, "the radius of the base is 2000 m, above 100: is it in m"),
        ({"racks": 0.011}, None),
        ({"racks": 500.0}, "the period of rack 1 is 500 s, not between 0.01 and 10: is it in s?"),
        ({"blocks": sm.Stops(10.0, 1e5)}, None),
        ({"blocks": sm.Stops((0.1, np.inf), 1e5)}, None),
        ({"blocks": sm.Stops((50.0, np.inf), 1e5)}, "the clearance of stops of block 1 is 50 m, above 10"),
    ],
)
def test_base_rack_and_stops_beyond_a_limit_have_a_remark(changes, expected):
    building = sm.Building([1e5], 4e7, heights=3.0)
    if "racks" in changes:
        goods = [sm.RackBlock(1, mass=10.0, mu=0.2)]
        changes = {"racks": [sm.Rack(1, 1, level_mass=10.0, period=changes["racks"], blocks=goods)]}
    if "blocks" in changes:
        changes = {"blocks": [sm.Block(1, mass=10.0, mu=0.2, stops=changes["blocks"])]}
    remarks = sm.Scene(building, **changes).remarks
    assert len(remarks) == (expected is not None), remarks
    assert not remarks or remarks[0].startswith(expected)


def test_first_period():
    def remarks(period):
        return sm.Scene(sm.Building.uniform(1, period)).remarks

    assert remarks(9.99) == remarks(0.011) == ()
    assert remarks(10.5)[0].startswith("first period is 10.5 s, above 10 s")
    assert remarks(0.005)[0].startswith("first period is 0.005 s, below 0.01 s")


@pytest.mark.parametrize("floors", [1, 2, 4, 9])
def test_stiffness_in_other_units_is_seen_by_the_height(floors):
    """Of usual buildings, 0.4 to 1.7 times C_t h^x of ASCE 7; stiffnesses a thousandth or thousandfold."""
    for usual in (0.4, 1.0, 1.7):
        whole = sm.Building.uniform(floors, usual * 0.0724 * (3.5 * floors) ** 0.8, mass=2e5)
        building = sm.Building(whole.mass, whole.stiffness, heights=3.5)
        assert sm.Scene(building).remarks == ()
        for factor, said in (
            (1e-3, "first period is .* above .* m of height"),
            (1e3, "first period is .* below"),
        ):
            wrong = sm.Building(whole.mass, factor * whole.stiffness, heights=3.5)
            assert re.match(said, sm.Scene(wrong).remarks[0]), (usual, factor)


def test_records_in_g_and_steps_of_seconds():
    time = np.arange(1000) * 0.01
    record = sm.Record(0.3 * np.sin(7.0 * time), 0.01, name="RIO")  # 0.3 g, read as m/s2
    assert motion_remarks(record) == (
        "motion 1, RIO, has a PGA of 0.03059 g, below 0.04 g: are its accelerations in g, and read as m/s2?",
    )
    slow = sm.Motion(record.acceleration * G, 10.0)
    assert motion_remarks([record.scaled(G), slow])[0].startswith(
        "motion 2 has a time step of 10 s, above 0.1 s: is it"
    )
    assert motion_remarks(record.scaled(G)) == motion_remarks(sm.Motion([0.0, 0.1, 0.0], 0.5)) == ()
    assert any("PGA of 0.03059 g" in remark for remark in sm.simulate(scene(), record).remarks)


def test_goods_on_the_roof_of_a_product_are_doubted_unless_stated():
    two, one = sm.Building.uniform(2, 0.3), sm.Building.uniform(1, 0.3)
    with pytest.warns(sm.errors.DoubtfulInput, match='the roof carries goods, too: roof="bare" leaves it without'):
        sm.Grid.product(two, mass_ratio=[0.5, 1.0], mu=[0.2])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for building, given in (
            (two, {"roof": "loaded"}),
            (two, {"roof": "bare"}),
            (two, {"floors": [1, 2]}),
            (one, {}),
        ):
            sm.Grid.product(building, mass_ratio=1.0, mu=[0.2], **given)
        sm.Grid.product(two, mass_ratio=[[0.5, 1.0]], mu=[0.2])


def test_motions_are_counted_from_1_and_named():
    calm, violent = sm.Motion([0.0, 4.9 * G], 0.01), sm.Motion([0.0, -5.1 * G], 0.01)
    assert motion_remarks([calm, violent])[0].startswith("motion 2 has a PGA of 5.1 g, above 5 g")
    assert motion_remarks(sm.Record([0.0, 6.0 * G], 0.01, name="RIO"))[0].startswith("motion 1, RIO, has a PGA of 6 g")


def test_targets(tmp_path):
    assert target_remarks(sm.TargetSpectrum.asce7(3.9, 2.0)) == ()
    assert target_remarks(sm.TargetSpectrum.asce7(4.1, 2.0))[0].startswith("S_DS of the target spectrum is 4.1 g")
    assert target_remarks(sm.TargetSpectrum.asce7(1.0, 6.0)) == (
        "S_D1 of the target spectrum is 6 g, above S_DS = 1 g: are they exchanged?",
    )
    file = tmp_path / "hazard.csv"
    file.write_text("T,Sa (g)\n0.1,11\n2.0,0.3\n")
    assert target_remarks(sm.TargetSpectrum.from_csv(file))[0].startswith("largest Sa of the target spectrum is 11 g")


def test_factors_and_mean_spectrum():
    suite, target = sm.builtin_suite("seven"), sm.TargetSpectrum.asce7()
    factors = sm.scaling.scale_asce7_10(suite, target).factors
    # A record a tenth as strong has ten times the factor.
    weak = sm.Suite("weak", (suite[0].scaled(0.1), *suite[1:]))
    remark = sm.scaling.scale_asce7_10(weak, target).remarks[0]
    assert remark.startswith(f"scale factors are outside 0.2 to 5: {10 * factors[0]:.4g} of motion 1 (synthetic-1);")
    # Sines have a narrow spectrum: where the mean touches the target elsewhere, it is far above it at their period.
    time = np.arange(2000) * 0.01
    sines = [sm.Motion(np.sin(2 * np.pi * time / period), 0.01) for period in (0.99, 1.0, 1.01)]
    scaling = sm.scaling.scale_asce7_10(sines, target)
    ratio = scaling.mean / scaling.target
    assert ratio.max() > 2.0
    at = scaling.periods[ratio.argmax()]
    assert scaling.remarks[-1].startswith(f"mean scaled spectrum is {ratio.max():.3g} times the target at {at:.4g} s")


def test_the_command_that_scales_prints_remarks_once_and_keeps_them(capsys):
    options = ["scale", "--sds", "107", "--sd1", "61"]
    assert main(options) == 0
    printed = capsys.readouterr().out
    assert printed.count("S_DS of the target spectrum is 107 g") == printed.count("scale factors are outside") == 1
    assert main([*options, "--json"]) == 0
    remarks = json.loads(capsys.readouterr().out)["remarks"]
    assert [remark.split(" is ")[0] for remark in remarks[:1]] == ["S_DS of the target spectrum"]
    assert remarks[1].startswith("scale factors are outside 0.2 to 5")


def test_a_run_says_what_is_unlikely_about_its_input() -> None:
    scene = sm.Scene(sm.Building.uniform(1, 0.4), [sm.Block(1, mass_ratio=1.0, mu=40.0)])
    response = sm.simulate(scene, sm.Motion([0.0, 350.0, 0.0], dt=0.01))
    assert response.remarks == (
        *scene.remarks,
        "motion 1 has a PGA of 35.69 g, above 5 g: are its accelerations in m/s2?",
    )
    for remark in response.remarks:
        assert remark in response.text
    assert (
        sm.simulate(
            scene.replace(blocks=[sm.Block(1, mass_ratio=1.0, mu=0.4)]), sm.Motion([0.0, 3.5, 0.0], 0.01)
        ).remarks
        == ()
    )
