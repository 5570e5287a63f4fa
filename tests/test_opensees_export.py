"""Models of OpenSeesPy: their springs, what they refuse, and, where OpenSees is installed, their peaks."""

from __future__ import annotations

import csv
import importlib.util
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.cli import main
from seismass.runs import spring_forces, write_opensees
from seismass.runs.opensees_export import model_content

BUILDING = sm.Building.uniform(
    2, 0.5, mass=2.0e5, yield_shear_over_weight=[0.3, 0.2], overstrength=1.8, second_slope=0.1, third_slope=0.02
)


def scene(**changes: Any) -> sm.Scene:
    return sm.Scene(BUILDING.replace(**changes), sm.blocks_on_floors([1.0, 0.5], mu=0.2))


def in_parallel(parts: list[tuple[float, float | None]], path: list[float]) -> list[float]:
    """Force of elastic-plastic springs in parallel, each by its own return mapping."""
    plastic = [0.0] * len(parts)
    forces = []
    for drift in path:
        total = 0.0
        for place, (stiffness, strength) in enumerate(parts):
            force = stiffness * (drift - plastic[place])
            if strength is not None and abs(force) > strength:
                force = np.sign(force) * strength
                plastic[place] = drift - force / stiffness
            total += force
        forces.append(total)
    return forces


@pytest.mark.parametrize(("second", "third", "omega"), [(0.1, 0.02, 1.8), (0.05, 0.0, 2.0), (0.0, 0.0, 2.0)])
def test_springs_in_parallel_are_the_trilinear_spring(second: float, third: float, omega: float) -> None:
    """Along a path with reversals beyond both yields they have the forces of the kernel's spring."""
    changed = scene(second_slope=second, third_slope=third, overstrength=omega)
    assert changed.building is not None
    parts = model_content(changed)["springs"][0]
    assert sum(stiffness for stiffness, _ in parts) == pytest.approx(BUILDING.stiffness[0], rel=1e-12)
    yields = float(BUILDING.yield_shear[0] / BUILDING.stiffness[0])
    path = [0.5, 0.9, 5.0, 30.0, 10.0, -4.0, -40.0, 2.0, 50.0, 0.0]
    drift = [yields * value for value in path]
    exact = spring_forces(changed.building, 1, drift).force
    assert in_parallel(parts, drift) == pytest.approx(exact.tolist(), rel=1e-9)


def test_folder_has_what_the_program_needs(tmp_path: Path) -> None:
    motions = sm.builtin_suite("seven")[:2]
    files = write_opensees(tmp_path / "models", {"slides": scene(heights=3.0, gravity_load=[1e6, 1e6])}, motions)
    assert [file.name for file in files] == [
        "model.py",
        "README.md",
        "motion-01.txt",
        "motion-02.txt",
        "model.json",
        "files.json",
    ]
    content = json.loads(files[4].read_text())
    model = content["models"]["slides"]
    assert model["mass"] == [2.0e5, 2.0e5]
    assert [block["mass"] for block in model["blocks"]] == [2.0e5, 1.0e5]
    # P/h of storey 1 carries both floors and all goods, that of storey 2 its own.
    weight = np.array([2.0e5, 1.0e5]) * sm.STANDARD_GRAVITY
    assert model["p_over_h"] == pytest.approx([(2e6 + weight.sum()) / 3.0, (1e6 + weight[1]) / 3.0])
    assert model["damping"] == BUILDING.damping_matrix.tolist()
    response = sm.simulate(scene(heights=3.0, gravity_load=[1e6, 1e6]), motions[1])
    assert model["exact"][1] == {"drift": response.peak_drift.tolist(), "slip": response.peak_slip.tolist()}
    assert np.loadtxt(files[2]).tolist() == motions[0].acceleration.tolist()
    compile(files[0].read_text(), "model.py", "exec")


def test_content_of_unequal_goods_and_storeys(unequal_scene: sm.Scene) -> None:
    """Each block with its own numbers; P/h of storey 1 carries all floors and goods, that of storey 3 its own."""
    content = model_content(unequal_scene)
    assert content["mass"] == [44.1e3, 35.7e3, 22.4e3]
    assert content["blocks"] == [
        {"floor": 1, "mass": 18.9e3, "mu_s": 0.298, "mu_k": 0.214},
        {"floor": 1, "mass": 11.5e3, "mu_s": 0.253, "mu_k": 0.154},
        {"floor": 2, "mass": 13.7e3, "mu_s": 0.349, "mu_k": 0.184},
        {"floor": 3, "mass": 7.8e3, "mu_s": 0.291, "mu_k": 0.24},
    ]
    own = np.array([461e3, 367e3, 251e3]) + sm.STANDARD_GRAVITY * np.array([30.4e3, 13.7e3, 7.8e3])
    load = np.array([own.sum(), own[1:].sum(), own[2]])
    np.testing.assert_allclose(content["p_over_h"], load / [4.3, 3.7, 3.1], rtol=1e-13)
    for storey, (stiffness, strength, omega, second, third) in enumerate(
        [
            (29.3e6, 283e3, 1.87, 0.067, 0.013),
            (23.1e6, 227e3, 2.11, 0.053, 0.0103),
            (16.1e6, 139e3, 1.61, 0.043, 0.0083),
        ]
    ):
        # Forces of the trilinear backbone in each of its three parts.
        first = strength / stiffness
        last = first + (omega - 1.0) * strength / (second * stiffness)
        at = [0.5 * first, 0.5 * (first + last), 2.0 * last]
        forces = [
            0.5 * strength,
            0.5 * (1.0 + omega) * strength,
            omega * strength + third * stiffness * last,
        ]
        assert in_parallel(content["springs"][storey], at) == pytest.approx(forces, rel=1e-12)


@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ({"hysteresis": "peak-oriented"}, "springs of the law peak-oriented"),
        ({"clearance": 0.05, "stop_stiffness": 1e8}, "stops of springs"),
        ({"stiffness_matrix": [[1e6, -1e6], [-1e6, 1e6]]}, "a stiffness matrix"),
    ],
)
def test_what_the_models_do_not_have_is_refused(tmp_path: Path, changes: dict[str, Any], what: str) -> None:
    with pytest.raises(sm.errors.InvalidScene, match=what):
        write_opensees(tmp_path / "models", {"one": scene(**changes)}, sm.builtin_suite("seven")[:1])
    assert not (tmp_path / "models").exists()


def test_nothing_to_write_and_no_folder_are_refused(tmp_path: Path) -> None:
    with pytest.raises(sm.errors.InvalidOption, match="scenes and motions, at least one of each; got no motion"):
        write_opensees(tmp_path, {"one": scene()}, [])
    with pytest.raises(sm.errors.InvalidOption, match="at least one of each; got no scene"):
        write_opensees(tmp_path, {}, sm.builtin_suite("seven"))
    file = tmp_path / "file"
    file.write_text("")
    with pytest.raises(sm.errors.InvalidOption, match="folder of OpenSees export must be a folder"):
        write_opensees(file, {"one": scene()}, sm.builtin_suite("seven")[:1])
    vertical = sm.Motion([0.0, 1.0, 0.0], dt=0.01, vertical=[0.0, 0.5, 0.0])
    with pytest.raises(sm.errors.InvalidScene, match="one with a vertical component"):
        write_opensees(tmp_path, {"one": scene()}, [vertical])


def test_commands_write_models(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["building", "--example"]) == 0
    Path("warehouse.toml").write_text(capsys.readouterr().out)
    command = ["building", "warehouse.toml", "--suite", "seven", "--no-figures", "--opensees", "models"]
    assert main(command) == 0
    content = json.loads(Path("models/model.json").read_text())
    assert list(content["models"]) == ["goods slide", "analysis 1", "analysis 2"]
    beside = Path("warehouse/analysis.csv").read_text()
    assert Path("models/analysis.csv").read_text() == beside
    for number in (1, 2):
        own = [1e3 * float(row[f"mass_{number}_t"]) for row in csv.DictReader(beside.splitlines())]
        assert content["models"][f"analysis {number}"]["mass"] == pytest.approx(own, rel=1e-12)
        assert content["models"][f"analysis {number}"]["blocks"] == []
    capsys.readouterr()
    assert main(["run", "--example"]) == 0
    Path("scene.toml").write_text(capsys.readouterr().out)
    assert main(["run", "scene.toml", "--opensees", "scene"]) == 0
    assert list(json.loads(Path("scene/model.json").read_text())["models"]) == ["scene"]


@pytest.mark.skipif(importlib.util.find_spec("openseespy") is None, reason="openseespy is not installed: not run")
def test_opensees_has_the_exact_peaks(tmp_path: Path) -> None:
    write_opensees(tmp_path, {"slides": scene()}, sm.builtin_suite("seven")[:1])
    subprocess.run([sys.executable, str(tmp_path / "model.py")], check=True, capture_output=True)
    rows = list(csv.DictReader((tmp_path / "comparison.csv").read_text().splitlines()))
    assert len(rows) == 4
    for row in rows:
        within = 0.02 if row["quantity"].startswith("drift") else 0.05
        assert float(row["ratio"]) == pytest.approx(1.0, abs=within), row["quantity"]
