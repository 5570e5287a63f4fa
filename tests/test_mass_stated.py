"""A building whose mass was not stated: ratios only, forces as fractions of its weight, and never a silent kilogram."""

from __future__ import annotations

import copy
import json
import pickle
from pathlib import Path

import numpy as np
import pytest

import seismass as sm
from seismass.cli import main

RATIOS = sm.Building.uniform(3, 0.6, yield_shear_over_weight=[0.24, 0.20, 0.12])
STATED = sm.Building.uniform(3, 0.6, mass=1.0, yield_shear_over_weight=[0.24, 0.20, 0.12])


def test_it_is_remembered() -> None:
    assert not RATIOS.mass_is_stated
    assert STATED.mass_is_stated
    assert sm.Building(mass=[1.0], stiffness=1.0).mass_is_stated
    for again in (pickle.loads(pickle.dumps(RATIOS)), copy.deepcopy(RATIOS), RATIOS.replace(damping=0.02)):
        assert not again.mass_is_stated
    assert pickle.loads(pickle.dumps(RATIOS)) == RATIOS
    # The same numbers, but not the same building: one takes blocks in kilograms.
    assert RATIOS != STATED
    np.testing.assert_array_equal(RATIOS.yield_shear, STATED.yield_shear)


def test_masses_that_are_given_later_are_stated() -> None:
    assert RATIOS.replace(mass=[2e5, 2e5, 2e5]).mass_is_stated
    assert not RATIOS.replace(mass=RATIOS.mass + 0.25, mass_is_stated=False).mass_is_stated


def test_strengths_may_be_replaced_as_fractions() -> None:
    elastic = sm.Building.uniform(3, 0.6)
    assert elastic.replace(yield_shear_over_weight=[0.24, 0.20, 0.12]) == RATIOS
    assert RATIOS.replace(yield_shear=np.inf) == elastic
    heavy = STATED.replace(mass=1e5, yield_shear_over_weight=0.2)
    np.testing.assert_allclose(heavy.yield_shear, 0.2 * 3e5 * sm.STANDARD_GRAVITY, rtol=1e-15)
    with pytest.raises(
        sm.errors.InvalidScene, match="yield_shear_over_weight of building must be left out where yield_shear"
    ):
        RATIOS.replace(yield_shear=1.0, yield_shear_over_weight=0.2)


def test_forces_are_for_floors_of_one_kilogram() -> None:
    """V_y in N beside masses that are not stated are those of 1 kg; far too large ones are remarked on."""
    forces = RATIOS.yield_shear
    assert sm.Building.uniform(3, 0.6, yield_shear=forces) == RATIOS
    assert sm.Building.uniform(3, 0.6).replace(yield_shear=forces) == RATIOS
    meant_in_newtons = sm.Scene(sm.Building.uniform(3, 0.6, yield_shear=440e3))
    assert any("5 W" in remark or "above 5" in remark for remark in meant_in_newtons.remarks)


def test_blocks_are_ratios_but_for_those_on_the_ground() -> None:
    heavy = sm.Block(1, mass=440_000.0, mu=0.4)
    message = "mass of block 2 must be given as mass_ratio where the mass of the building is not stated; got 440000 kg"
    with pytest.raises(sm.errors.InvalidScene, match=f"^{message}"):
        sm.Scene(RATIOS, [sm.Block(0, mass=100.0, mu=0.1), heavy])
    assert sm.Scene(STATED, [heavy]).block_mass.tolist() == [440_000.0]
    assert sm.Scene(RATIOS, [sm.Block(1, mass_ratio=2.0, mu=0.4)]).block_mass.tolist() == [2.0]


SCENE = """
    [building]
    storeys = 3
    period = 0.6
    {mass}
    yield_shear_over_weight = [0.24, 0.20, 0.12]
    [[blocks]]
    floor = 1
    {block}
    mu = 0.3
    [motion]
    acceleration = [0.0, 0.5, -0.5, 0.2, 0.0]
    unit = "g"
    dt = 0.2
"""


def run(path: Path, capsys: pytest.CaptureFixture[str], *options: str) -> tuple[int, str]:
    code = main(["run", str(path), *options])
    printed = capsys.readouterr()
    return code, printed.out + printed.err


def test_forces_are_printed_as_fractions_of_the_weight(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, shears = tmp_path / "scene.toml", {}
    for mass in ("", "mass = 2e5"):
        path.write_text(SCENE.format(mass=mass, block="mass_ratio = 1.0"))
        code, text = run(path, capsys)
        assert code == 0
        assert ("peak shear / W" in text) == ("of floor mass" in text) == (not mass)
        assert ("peak shear kN" in text) == ("mass kg" in text) == ("weight 5884 kN" in text) == bool(mass)
        document = json.loads(run(path, capsys, "--json")[1])
        assert document["mass_stated"] == bool(mass)
        shears[mass] = document["peak_shear_over_weight"]
        weight = (6e5 if mass else 3.0) * sm.STANDARD_GRAVITY
        np.testing.assert_allclose(np.array(document["peak_storey_shear"]) / weight, shears[mass], rtol=1e-14)
    # Drifts do not depend on the mass, nor do forces over the weight; only rounding does.
    np.testing.assert_allclose(shears[""], shears["mass = 2e5"], rtol=1e-9)


def test_a_scene_file_with_a_mass_beside_ratios_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(SCENE.format(mass="", block="mass = 440000.0"))
    code, text = run(path, capsys)
    assert code == 2
    assert "mass of block 1 must be given as mass_ratio where the mass of the building is not stated" in text


def test_remarks_of_a_scene_file_are_printed_once_and_kept(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(SCENE.format(mass="", block="mass_ratio = 1.0").replace("mu = 0.3", "mu = 30"))
    (remark,) = sm.read_scene(path).remarks
    assert remark.startswith("mu_s of block 1 is 30, above 1.5")
    assert run(path, capsys)[1].count(remark) == 1
    assert json.loads(run(path, capsys, "--json")[1])["remarks"] == [remark]
