"""The table of spring numbers: what reads it has every entry, and what the kernel exports is written nowhere else."""

from __future__ import annotations

import inspect
import pickle
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass import _kernel
from seismass.model.springs import SHAPE_FIELDS, SPRING_FIELDS
from seismass.runs.grid.columns import TABLE_COLUMNS
from seismass.runs.scene_goods import KEYS

PACKAGE = Path(sm.__file__).parent
ROOT = Path(__file__).parents[1]


def defaults_of(function: Any) -> dict[str, Any]:
    return {name: item.default for name, item in inspect.signature(function).parameters.items()}


def test_defaults_are_those_of_the_paper_and_of_the_inferences() -> None:
    # Omega of section 4 of the 16WCEE paper; r2 and r3 are inferences; elastic where no strength is given.
    found = {
        name: SPRING_FIELDS[name].default for name in ("yield_shear", "overstrength", "second_slope", "third_slope")
    }
    assert found == {"yield_shear": np.inf, "overstrength": 2.0, "second_slope": 0.05, "third_slope": 0.0}


def test_standard_gravity_is_that_of_the_cgpm() -> None:
    assert sm.STANDARD_GRAVITY == 9.80665  # 3rd CGPM, 1901


@pytest.mark.parametrize(
    ("function", "fields"), [(sm.Building, SPRING_FIELDS), (sm.Building.uniform, SHAPE_FIELDS)], ids=["init", "uniform"]
)
def test_signatures_name_every_field_with_its_default(function: Any, fields: dict[str, Any]) -> None:
    found = defaults_of(function)
    for name, field in fields.items():
        assert found[name] == field.default


@pytest.mark.parametrize("function", [sm.Grid, sm.Grid.product], ids=["init", "product"])
def test_every_shape_is_a_column_of_a_grid(function: Any) -> None:
    found = defaults_of(function)
    assert set(SHAPE_FIELDS) <= set(TABLE_COLUMNS)
    assert all(found[name] is None for name in SHAPE_FIELDS)


def test_building_declares_and_documents_every_field() -> None:
    for name, field in SPRING_FIELDS.items():
        assert name in sm.Building.__annotations__
        assert re.search(rf"^{name} : array_like, default {field.default:g}$", inspect.getdoc(sm.Building) or "", re.M)


def test_scene_files_have_every_field() -> None:
    assert set(SPRING_FIELDS) <= set(KEYS["building"])


def test_an_unknown_argument_is_refused_as_python_does() -> None:
    with pytest.raises(TypeError, match=r"Building\(\) got an unexpected keyword argument 'overstrenght'"):
        sm.Building(1.0, 1.0, overstrenght=2.0)  # type: ignore[call-arg]
    building = sm.Building(1.0, 1.0)
    with pytest.raises(TypeError, match=r"Grid\(\) got an unexpected keyword argument 'yield_shear'"):
        sm.Grid(building, yield_shear=2.0)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match=r"Grid.product\(\) got an unexpected keyword argument 'slope'"):
        sm.Grid.product(building, slope=2.0)  # type: ignore[call-arg]


def test_the_kernel_knows_every_field_and_no_other() -> None:
    springs = sm.Building([1.0, 2.0], 1.0).springs
    for name in springs:
        short = springs | {name: np.ones(1)}
        with pytest.raises(
            sm.errors.InvalidScene, match=f"{name} of building must be one number or a list of 2 values"
        ):
            _kernel.Building(np.ones(2), short, damping_ratio=0.0)
    with pytest.raises(sm.errors.InvalidScene, match="stiffness of storey 1 must be a positive number; got NaN"):
        _kernel.Building(np.ones(2), {}, damping_ratio=0.0)
    with pytest.raises(
        sm.errors.InvalidScene, match="slope of building must be a number that springs have; got another name"
    ):
        _kernel.Building(np.ones(2), springs | {"slope": np.ones(2)}, damping_ratio=0.0)


def test_a_grid_has_a_third_slope() -> None:
    """A column of third slopes gives the scenes that buildings with these slopes give."""
    building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.1, 0.06])
    motion = sm.builtin_suite("seven")[0]
    slopes = [0.0, 0.02, 0.05]
    grid = sm.Grid.product(building, third_slope=slopes)
    assert [float(grid.scene(n).building.third_slope[0]) for n in (1, 2, 3)] == slopes  # type: ignore[union-attr]
    table = sm.simulate_many(grid, motion)
    scenes = [sm.Scene(building.replace(third_slope=slope)) for slope in slopes]
    assert table["peak_drift"].to_list() == sm.simulate_many(scenes, motion)["peak_drift"].to_list()
    assert table["peak_drift"].n_unique() == 3


def test_what_the_kernel_exports_is_written_nowhere_else() -> None:
    for file in PACKAGE.rglob("*.py"):
        if "data" in file.relative_to(PACKAGE).parts:  # a copy of data/, whose programs need no seismass
            continue
        assert "9.80665" not in file.read_text(encoding="utf-8"), file
    rust = "".join(file.read_text() for file in (ROOT / "crates" / "seismass" / "src").rglob("*.rs"))
    assert rust.count("9.806_65") == 1


def test_values_are_equal_after_pickling() -> None:
    building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=0.1)
    motion = sm.Motion([0.0, 3.0, -3.0, 0.0], dt=0.1)
    scene = sm.Scene(building, [sm.Block(1, mass_ratio=0.5, mu=0.3)])
    for value in (building, scene, scene.blocks[0], motion, sm.simulate(scene, motion)):
        assert pickle.loads(pickle.dumps(value)) == value
