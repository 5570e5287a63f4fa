"""Scene files: a scene, its motion and what to do with it, from TOML or JSON. Every key is known or refused."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from seismass import _kernel
from seismass.base.errors import InvalidMotion, InvalidScene, InvalidSceneFile
from seismass.base.files import data_directory
from seismass.base.input_table import FINITE, POSITIVE, SCENE_FILE, Table, load_table, refuse_other_kind
from seismass.base.units import ACCELERATION_UNITS
from seismass.base.values import FloatArray, as_array, as_count, as_number, as_path, brief, refusal
from seismass.base.views import Card
from seismass.model.building import Building, Rayleigh, as_fraction_of_weight
from seismass.model.plausibility import motion_remarks
from seismass.model.scene import Scene
from seismass.model.springs import SPRING_FIELDS, is_per_storey
from seismass.motions.motion import Motion, check_size
from seismass.motions.records import Record, builtin_record, read_record
from seismass.motions.records.builtin import builtin_names
from seismass.runs.plane import motions_in_plane
from seismass.runs.scene_goods import (
    KEYS,
    check_walls,
    infinite_where_null,
    matrix_of_walls,
    pair_of_scene,
    read_base,
    read_block,
    read_rack,
    with_walls,
)

_SPRING_KEYS: Final = (*SPRING_FIELDS, "heights", "gravity_load", "geometric_stiffness")
_DAMPING_KEYS = {"modal": ("ratio",), "rayleigh": ("ratio", "modes"), "matrix": ("matrix",)}


@dataclass(frozen=True)
class SceneFile(Card):
    """What a scene file holds.

    Attributes
    ----------
    scene : Scene
        Building, blocks and initial state.
    motion : Motion
        Ground motion, scaled and ending at `duration`.
    duration : float or None
        As stated (s); None: to the last sample.
    name, note : str
        Free text.
    path : Path
        The file.
    records : tuple of Record
        Records that the motion was read from, as their files have them; empty where the samples stand in the file.
    other_motion : Motion or None
        The motion in y, where there are two directions.
    """

    scene: Scene
    motion: Motion
    duration: float | None
    name: str
    note: str
    path: Path
    records: tuple[Record, ...] = ()
    other_motion: Motion | None = None

    @property
    def remarks(self) -> tuple[str, ...]:
        """What the records had interpreted or left out, and what is unlikely about scene and motion, as sentences."""
        of_records = (f"{record.name}: {remark}" for record in self.records for remark in record.remarks)
        return (*of_records, *self.scene.remarks, *motion_remarks(self.motion))


def example_scene() -> Path:
    """Return the scene file that ships with the package: three storeys of storage under a built-in motion."""
    return data_directory() / "examples" / "storage.toml"


def read_scene(path: str | os.PathLike[str]) -> SceneFile:
    """Read a scene file.

    Parameters
    ----------
    path : path-like
        A .toml or .json file with the keys of docs/scene_file.md. Paths in it are relative to its folder.

    Returns
    -------
    SceneFile
        The scene and its motion.

    Raises
    ------
    InvalidSceneFile
        The file cannot be read, or has an unknown, missing or contradicting key.
    InvalidScene, InvalidMotion
        A value is not what it must be.
    RecordFormatError
        A record that it names cannot be read.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import mkdtemp
    >>> import seismass as sm
    >>> file = Path(mkdtemp(), "crate.toml")
    >>> _ = file.write_text('''
    ... [[blocks]]
    ... floor = 0
    ... mass = 100.0
    ... mu = 0.1
    ... [motion]
    ... acceleration = [0.2, 0.2, 0.0]
    ... unit = "g"
    ... dt = 0.1
    ... ''')
    >>> sm.read_scene(file).scene
    Scene(ground only, 1 block)
    """
    source = as_path(path, "scene file", InvalidSceneFile)
    top = load_table(source, "scene file", InvalidSceneFile)
    refuse_other_kind(top, SCENE_FILE)
    top.known(KEYS[""])
    if "pair" not in top.values:
        top.needed("motion")
    scene = _scene(top)
    other_motion, pair = None, pair_of_scene(top, scene, source.parent)
    if pair is not None:
        records: tuple[Record, ...] = (pair.first, pair.second)
        motion, other_motion = motions_in_plane(pair)
    else:
        motion, records = _motions(top, source.parent)
    if "other_motion" in top.values:
        if scene.engine != "plane":
            top.refuse("other_motion", "left out where there is no other_direction", "a motion")
        samples, dt, record = _samples(top.table("other_motion"), source.parent)
        records = records if record is None else (*records, record)
        motion, other_motion = motions_in_plane((motion, Motion(samples, dt)))
    elif scene.engine == "plane" and other_motion is None:
        top.needed("other_motion", "pair")
    duration = top.values.get("duration")
    if duration is not None:
        duration = as_number(duration, "duration", source.name, InvalidSceneFile)
        motion = motion.with_duration(duration)
        other_motion = None if other_motion is None else other_motion.with_duration(duration)
    return SceneFile(scene, motion, duration, scene.name, scene.note, source, records, other_motion)


def scene_without_motion(path: str | os.PathLike[str]) -> Scene:
    """Return the scene of a scene file, whose motion may be missing and is not read."""
    top = load_table(as_path(path, "scene file", InvalidSceneFile), "scene file", InvalidSceneFile)
    refuse_other_kind(top, SCENE_FILE)
    top.known(KEYS[""])
    return _scene(top)


def _scene(top: Table) -> Scene:
    """Building, blocks and initial state of a file."""
    walls = top.table("walls") if "walls" in top.values else None
    building = building_of_table(top.table("building"), walls) if "building" in top.values else None
    if building is None and walls is not None:
        top.refuse("walls", "left out where there is no building", "a table")
    initial = top.table("initial") if "initial" in top.values else None
    if initial is not None:
        initial.known(KEYS["initial"])
        if building is None:
            initial.empty("there is no building")

    def state(key: str) -> Any:
        if initial is None:
            return None
        return initial.values.get(key) if "other_direction" in top.values else initial.per_storey(key)

    return Scene(
        building,
        [read_block(table, number) for number, table in enumerate(top.tables("blocks"), start=1)],
        racks=[read_rack(table, number) for number, table in enumerate(top.tables("racks"), start=1)],
        other_direction=_other_direction(top, building),
        fixed_goods=top.values.get("fixed_goods"),
        initial_drift=state("drift"),
        initial_velocity=state("velocity"),
        base=read_base(top.table("base")) if "base" in top.values else None,
        collapse_drift=top.values.get("collapse_drift"),
        name=top.text("name"),
        note=top.text("note"),
    )


_SAME_IN_Y: Final = ("mass", "storeys", "heights", "gravity_load", "geometric_stiffness")
"""Keys of a building that hold in both directions."""


def _other_direction(top: Table, building: Building | None) -> Building | bool:
    """The building in y: that in x with the keys that differ."""
    if "other_direction" not in top.values:
        return False
    other = top.table("other_direction")
    other.known(tuple(key for key in KEYS["building"] if key not in _SAME_IN_Y))
    if building is None or not other.values:
        if building is None:
            other.empty("there is no building")
        return True
    merged = {**top.values["building"]}
    for one, replaced in (("period", "stiffness"), ("yield_shear", "yield_shear_over_weight")):
        for key, dropped in ((one, replaced), (replaced, one)):
            if key in other.values:
                merged.pop(dropped, None)
    merged |= other.values
    _one_of_each(Table(merged, "other_direction", top.file, InvalidSceneFile))
    if "period" in merged and isinstance(merged.get("mass"), list):
        period = other.number("period", np.nan, POSITIVE)
        merged["stiffness"] = [_kernel.Rack.uniform_stiffness(building.mass, period)] * building.storeys
        del merged["period"]
    return building_of_table(Table(merged, "other_direction", top.file, InvalidSceneFile))


def _one_of_each(table: Table) -> None:
    """Refuse keys of a building beside others that say the same."""
    table.excluded("yield_shear_over_weight", "yield_shear")
    table.excluded("geometric_stiffness", "gravity_load")
    for key in ("stiffness", "stiffness_matrix", "backbone"):
        table.excluded(key, "period")


def building_of_table(table: Table, walls: Table | None = None) -> Building:
    """Return the building of a table with the keys that a scene file has for one, with the walls of another table;
    errors in keys have the class of the table's errors.
    """
    table.known(KEYS["building"])
    _one_of_each(table)
    if "gravity_load" in table.values:
        table.needed("heights")
    springs = infinite_where_null(table.subset(*_SPRING_KEYS))
    if "damping" in table.values:
        springs["damping"] = _damping(table)
    over_weight = infinite_where_null(table.values).get("yield_shear_over_weight")
    springs |= table.subset("backbone", "hysteresis", "stiffness_matrix")
    if walls is not None:
        check_walls(walls, table)
    if isinstance(springs.get("backbone"), list):  # TOML has no null
        springs["backbone"] = [None if points == [] else points for points in springs["backbone"]]
    if "period" in table.values:
        table.needed("storeys")
        if isinstance(table.values.get("mass"), list):
            table.refuse("mass", f"one number where {table.key('period')} is given", brief(table.values["mass"]))
        building = Building.uniform(
            table.values["storeys"],
            table.values["period"],
            **table.subset("mass"),
            yield_shear_over_weight=over_weight,
            **springs,
        )
        return building if walls is None else with_walls(building, walls, scaled=True)
    table.needed("stiffness", "period", "backbone")
    table.needed("mass")
    mass, stiffness = table.values["mass"], table.values.get("stiffness")
    count = _storeys(table, over_weight, springs)
    if count is not None:
        mass = np.full(count, as_number(mass, "mass", "building", InvalidScene))
    if walls is not None:
        springs |= {"stiffness_matrix": matrix_of_walls(walls, table)}
    building = Building(mass, stiffness, **springs)
    if walls is not None and building.stiffness_matrix is None:
        building = with_walls(building, walls, scaled=False)
    if over_weight is None:
        return building
    return building.replace(yield_shear=as_fraction_of_weight(over_weight, building.storeys) * building.weight)


def _storeys(table: Table, over_weight: Any, springs: dict[str, Any]) -> int | None:
    """Number of storeys as stated, or that of the strengths over the weight where nothing else is a list."""
    listed = any(isinstance(table.values.get(key), list) for key in ("mass", "stiffness"))
    if "storeys" in table.values:
        count = as_count(table.values["storeys"], "storeys", "building", InvalidScene, least=1)
        if listed:
            table.refuse("storeys", "left out where mass or stiffness is a list", str(count))
        if count > _kernel.MAX_STOREYS:
            raise refusal(InvalidScene, "storeys", "building", f"at most {_kernel.MAX_STOREYS}", str(count))
        return count
    listed = listed or any(
        is_per_storey(value) if key == "backbone" else isinstance(value, list) for key, value in springs.items()
    )
    return len(over_weight) if isinstance(over_weight, list) and over_weight and not listed else None


def _damping(building: Table) -> float | Rayleigh | FloatArray:
    if not isinstance(building.values["damping"], dict):
        return as_number(building.values["damping"], "damping", "building", InvalidScene)
    table = building.table("damping")
    kind = table.choice("kind", _DAMPING_KEYS)
    table.known(("kind", *_DAMPING_KEYS[kind]))
    for key in _DAMPING_KEYS[kind]:
        table.needed(key)
    if kind == "matrix":
        return as_array(table.values["matrix"], "damping matrix", "building", InvalidScene, dimensions=2)
    ratio = as_number(table.values["ratio"], "damping ratio", "building", InvalidScene)
    return Rayleigh(ratio, table.values["modes"]) if kind == "rayleigh" else ratio


def _motions(top: Table, folder: Path) -> tuple[Motion, tuple[Record, ...]]:
    """Horizontal and vertical samples, both ending with the shorter."""
    samples, dt, record = _samples(top.table("motion"), folder)
    records = () if record is None else (record,)
    if "vertical_motion" not in top.values:
        return Motion(samples, dt), records
    vertical, vertical_dt, record = _samples(top.table("vertical_motion"), folder)
    if not np.isclose(vertical_dt, dt, rtol=1e-9, atol=0.0):
        top.refuse("vertical_motion", f"at the time step of the horizontal motion, {dt:g} s", f"{vertical_dt:g} s")
    shared = min(len(samples), len(vertical))
    records = records if record is None else (*records, record)
    return Motion(samples[:shared], dt, vertical[:shared]), records


def _samples(table: Table, folder: Path) -> tuple[FloatArray, float, Record | None]:
    """Acceleration (m/s2) and time step (s) after scaling, and the record they come from, if any."""
    table.known(KEYS["motion"])
    table.needed("file", "builtin", "acceleration")
    table.one_of("file", "builtin", "acceleration")
    for key in ("dt", "unit"):
        table.excluded(key, "builtin")
    unit = table.choice("unit", ACCELERATION_UNITS) if "unit" in table.values else None
    scale, dt_scale = table.number("scale", 1.0, FINITE), table.number("dt_scale", 1.0, POSITIVE)
    record, in_si = None, 1.0
    if "acceleration" not in table.values:
        record = _record(table, folder, unit)
        samples, dt = record.acceleration, record.dt
    else:
        table.needed("dt")
        samples = as_array(table.values["acceleration"], "acceleration", "motion", InvalidMotion)
        in_si = ACCELERATION_UNITS[unit or "m/s2"]
        dt = as_number(table.values["dt"], "dt", "motion", InvalidMotion)
    check_size(len(samples), dt * dt_scale, f"motion of {table.file}")
    with np.errstate(over="ignore"):  # the motion refuses what is not finite
        return samples * in_si * scale, dt * dt_scale, record


def _record(table: Table, folder: Path, unit: str | None) -> Record:
    """The record that a table names: a file, or a built-in motion."""
    if "file" in table.values:
        dt = table.number("dt") if "dt" in table.values else None
        return read_record(folder / table.text("file"), dt=dt, unit=unit)
    name, names = table.text("builtin"), builtin_names()
    if name not in names:
        table.refuse("builtin", f"one from {names[0]} to {names[-1]}", brief(name))
    return builtin_record(name)
