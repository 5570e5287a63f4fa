"""One digest of inputs: every field that there is counts to its last bit, labels do not."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.assessment.building_file import read_building
from seismass.base.stored_results import LABELS, fields_of, inputs_digest, motion_contents
from seismass.base.values import Value
from seismass.motions.records.builtin import data_directory


def changed(value: Any, where: str) -> Iterator[tuple[str, Any]]:
    """Yield copies of a value that differ in one leaf alone, by its last bit, with the place of the leaf."""
    if isinstance(value, bool | np.bool_):
        yield where, not value
    elif value is None:
        yield where, 0.0
    elif isinstance(value, int):
        yield where, value + 1
    elif isinstance(value, float):
        yield where, 0.0 if np.isnan(value) else float(np.nextafter(value, 0.0)) if value else 5e-324
    elif isinstance(value, str):
        yield where, value + "x"
    elif isinstance(value, np.ndarray):
        for index in np.ndindex(value.shape):
            other = value.copy()
            if value.dtype.kind == "f":
                other[index] = next(changed(float(value[index]), where))[1]
            else:
                other[index] = not value[index] if value.dtype.kind == "b" else value[index] + 1
            yield f"{where}{list(index)}", other
    elif isinstance(value, tuple | list):
        for index, item in enumerate(value):
            for place, other in changed(item, f"{where}[{index}]"):
                yield place, [*value[:index], other, *value[index + 1 :]]
        yield f"{where}[]", [*value, 1.0]
    elif isinstance(value, dict):
        for name, item in value.items():
            for place, other in changed(item, f"{where}.{name}"):
                yield place, {**value, name: other}
    elif (fields := fields_of(value)) is not None:
        for name, item in fields.items():
            for place, other in changed(item, f"{where}.{name}"):
                yield place, with_field(value, name, other)


def with_field(value: Any, name: str, other: Any) -> Any:
    """Return a copy with another field, though no constructor would take it."""
    copy = object.__new__(type(value))
    slots = [slot for kind in type(value).__mro__ for slot in getattr(kind, "__slots__", ())]
    for slot in slots or [field.name for field in dataclasses.fields(value)]:
        if hasattr(value, slot):
            object.__setattr__(copy, slot, getattr(value, slot))
    object.__setattr__(copy, name, other)
    return copy


def whole_scene() -> sm.Scene:
    """A scene that has everything, in two directions."""
    building = sm.Building(
        mass=[1.1e5, 0.9e5],
        stiffness=[3.1e7, 2.3e7],
        yield_shear=[1.7e5, 0.8e5],
        overstrength=1.9,
        second_slope=0.07,
        third_slope=0.01,
        heights=[4.1, 3.3],
        gravity_load=[1.2e6, 0.7e6],
        hysteresis="peak-oriented",
        energy_capacity=[9.0, 8.0],
    )
    stops = sm.Stops(0.11, stiffness=2e6, damping=3e3)
    blocks = [
        sm.Block(1, mass=5.1e4, mu_s=0.37, mu_k=0.29, wear=[(0.5, 0.31, 0.23)]),
        sm.Block(2, mass=2.7e4, mu_s=0.41, mu_k=0.33, stops=stops),
    ]
    other = building.replace(stiffness=[2.9e7, 2.1e7], hysteresis="masing", energy_capacity=np.inf)
    return sm.Scene(building, blocks, other_direction=other, collapse_drift=[0.4, 0.3], name="one", note="two")


def racked_scene() -> sm.Scene:
    """A scene with a rack and a sliding base, which one in two directions does not take."""
    building = sm.Building.uniform(2, 0.41, mass=1.3e5, yield_shear_over_weight=0.19, heights=3.1)
    rack = sm.Rack(1, 2, level_mass=5100.0, stiffness=1.3e7, blocks=[sm.RackBlock(1, mass=4.1e4, mu=0.23)])
    goods = [sm.Block(2, mass=3.3e4, mu=0.31)]
    return sm.Scene(building, goods, racks=[rack], base=sm.SlidingBase(mu_s=0.17, mu_k=0.13, mass=9e4, radius=2.1))


@pytest.mark.parametrize("scene", [whole_scene(), racked_scene()], ids=["two directions", "rack and base"])
def test_every_field_of_a_scene_counts_to_its_last_bit(scene: sm.Scene) -> None:
    before = inputs_digest(scene)
    digests = {place: inputs_digest(other) for place, other in changed(scene, "scene")}
    assert len(digests) > 60
    assert [place for place, digest in digests.items() if digest == before] == []
    assert len(set(digests.values())) == len(digests)


def test_every_field_of_a_building_file_counts() -> None:
    building = read_building(data_directory() / "examples" / "warehouse.toml")
    before = inputs_digest(building)
    digests = {place: inputs_digest(other) for place, other in changed(building, "building")}
    assert len(digests) > 80
    assert [place for place, digest in digests.items() if digest == before] == []


def test_labels_and_the_sign_of_zero_do_not_count() -> None:
    scene = whole_scene()
    assert inputs_digest(scene) == inputs_digest(scene.replace(name="other", note="words"))
    assert inputs_digest(0.0, np.zeros(2)) == inputs_digest(-0.0, -np.zeros(2))
    assert inputs_digest(np.float64(0.1), np.int64(3)) == inputs_digest(0.1, 3)


def test_no_two_kinds_of_values_have_one_digest() -> None:
    values: list[Any] = [1, 1.0, True, "1", b"1", None, [], (1,), [1, 1], [[1], 1], {"a": 1}]
    values += [np.ones(1), np.ones((1, 1))]
    values += [np.ones(1, dtype=np.float32), ["ab", "c"], ["a", "bc"], {"a": [1], "b": []}, {"a": [], "b": [1]}]
    assert len({inputs_digest(value) for value in values}) == len(values)
    with pytest.raises(TypeError, match="no digest of a object"):
        inputs_digest(object())


def test_every_public_field_of_a_value_is_one_of_the_digest() -> None:
    """Fields come from the class itself, so that one that is added counts without a word."""
    kinds = [
        kind for kind in Value.__subclasses__() if kind.__module__.startswith(("seismass.model", "seismass.motions"))
    ]
    assert {sm.Scene, sm.Building, sm.Block, sm.Rack, sm.RackBlock, sm.Stops, sm.SlidingBase, sm.Motion} <= set(kinds)
    for value in (whole_scene(), *racked_scene().racks, sm.Motion([0.1, 0.2], 0.01)):
        public = {name for name in type(value).__slots__ if name[0] != "_"} - LABELS
        assert set(fields_of(value) or {}) == public


def test_motions_count_by_samples_and_step_in_both_directions() -> None:
    motion = sm.Motion([0.1, -0.2], 0.01, vertical=[0.3, 0.4])
    digests = {place: inputs_digest(motion_contents([other])) for place, other in changed(motion, "motion")}
    assert len(digests) == 5
    assert inputs_digest(motion_contents([motion])) not in digests.values()
    assert len(set(digests.values())) == 5


def test_results_of_inputs_that_differ_in_the_seventh_digit_say_so() -> None:
    suite = [record.motion for record in sm.builtin_suite("seven")[:2]]

    def digest(mu: float) -> str:
        scene = sm.Scene(None, [sm.Block(0, mass=100.0, mu=mu)])
        return str(sm.slip.slip_demand(scene, suite).metadata["inputs_sha256"])

    assert digest(0.2) == digest(0.2)
    assert digest(0.2) != digest(0.2000004)
