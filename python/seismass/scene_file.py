"""Scene files: a scene, its motion and what to do with it, from TOML or JSON. Every key is known or refused."""

from __future__ import annotations

import difflib
import json
import os
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, NoReturn

import numpy as np

from seismass._values import FloatArray, as_array, as_count, as_number, as_path, brief, refusal
from seismass.errors import InvalidMotion, InvalidScene, InvalidSceneFile
from seismass.plausibility import motion_remarks
from seismass.records import Record, read_record
from seismass.scene import MAX_STOREYS, Block, Building, Rayleigh, Scene, as_fraction_of_weight
from seismass.simulate import Motion
from seismass.units import ACCELERATION_UNITS

_SPRING_KEYS = ("overstrength", "second_slope", "third_slope", "heights", "gravity_load", "geometric_stiffness")
_DAMPING_KEYS = {"modal": ("ratio",), "rayleigh": ("ratio", "modes"), "matrix": ("matrix",)}
KEYS: Final = {
    "": (
        "name",
        "note",
        "building",
        "blocks",
        "motion",
        "vertical_motion",
        "duration",
        "initial",
        "collapse_drift",
        "result",
    ),
    "building": (
        "mass",
        "stiffness",
        "storeys",
        "period",
        "yield_shear",
        "yield_shear_over_weight",
        "damping",
        *_SPRING_KEYS,
    ),
    "building.damping": ("kind", *dict.fromkeys(key for keys in _DAMPING_KEYS.values() for key in keys)),
    "blocks": ("floor", "mass", "mass_ratio", "mu", "mu_s", "mu_k", "velocity"),
    "motion": ("file", "acceleration", "dt", "unit", "scale", "dt_scale"),
    "initial": ("drift", "velocity"),
}
"""Keys of each table of a scene file, the file itself first; `vertical_motion` has those of `motion`."""


@dataclass(frozen=True)
class SceneFile:
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
    """

    scene: Scene
    motion: Motion
    duration: float | None
    name: str
    note: str
    path: Path
    records: tuple[Record, ...] = ()

    @property
    def remarks(self) -> tuple[str, ...]:
        """What the records had interpreted or left out, and what is unlikely about scene and motion, as sentences."""
        of_records = (f"{record.name}: {remark}" for record in self.records for remark in record.remarks)
        return (*of_records, *self.scene.remarks, *motion_remarks(self.motion))


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
    top = _Table(_load(source), "", source.name)
    top.known(KEYS[""])
    if "motion" not in top.values:
        top.refuse("motion", "given", "nothing")
    name, note = (top.text(key) for key in ("name", "note"))
    building = _building(top.table("building")) if "building" in top.values else None
    initial = top.table("initial") if "initial" in top.values else None
    if initial is not None:
        initial.known(KEYS["initial"])
        if building is None:
            initial.empty("there is no building")
    scene = Scene(
        building,
        [_block(table, number) for number, table in enumerate(top.tables("blocks"), start=1)],
        initial_drift=None if initial is None else initial.per_storey("drift"),
        initial_velocity=None if initial is None else initial.per_storey("velocity"),
        collapse_drift=top.values.get("collapse_drift"),
        name=name,
        note=note,
    )
    motion, records = _motions(top, source.parent)
    duration = top.values.get("duration")
    if duration is not None:
        duration = as_number(duration, "duration", source.name, InvalidSceneFile)
        motion = motion.with_duration(duration)
    return SceneFile(scene, motion, duration, name, note, source, records)


def _load(source: Path) -> dict[str, Any]:
    """The file as tables and lists, whatever its format."""
    suffix = source.suffix.lower()
    if suffix not in (".toml", ".json"):
        raise refusal(InvalidSceneFile, "suffix", f"scene file {source.name}", ".toml or .json", brief(suffix))
    try:
        text = source.read_bytes().decode("utf-8-sig")
        loaded = tomllib.loads(text) if suffix == ".toml" else json.loads(text, object_pairs_hook=_without_repeats)
    except OSError as error:
        raise InvalidSceneFile(
            f"scene file must be a file that can be read; got {source} ({error.strerror or error})"
        ) from error
    except (ValueError, RecursionError) as error:
        form = suffix[1:].upper()
        raise refusal(InvalidSceneFile, "content", source.name, f"valid {form}", str(error)) from error
    except _RepeatedKey as error:
        raise refusal(InvalidSceneFile, str(error), source.name, "given once", "it twice") from None
    if not isinstance(loaded, dict):
        raise refusal(InvalidSceneFile, "content", source.name, "a table of keys", brief(loaded))
    return loaded


class _RepeatedKey(Exception):
    """A key that a JSON object has twice, of which Python would keep the last."""


def _without_repeats(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    table = dict(pairs)
    if len(table) < len(pairs):
        keys = [key for key, _ in pairs]
        raise _RepeatedKey(next(key for key in keys if keys.count(key) > 1))
    return table


class _Table:
    """A table of the file, with its place in it for messages. Null stands for an absent key, but for `nullable`."""

    def __init__(self, given: dict[str, Any], place: str, file: str, nullable: Iterable[str] = ()) -> None:
        kept = set(nullable)
        self.values = {key: value for key, value in given.items() if value is not None or key in kept}
        self._all_keys = tuple(given)
        self._place = place
        self._file = file

    def key(self, key: str) -> str:
        """Where a key stands: building.damping.ratio."""
        return f"{self._place}.{key}" if self._place else key

    def refuse(self, key: str, requirement: str, got: str) -> NoReturn:
        raise refusal(InvalidSceneFile, self.key(key), self._file, requirement, got)

    def known(self, keys: tuple[str, ...]) -> None:
        """Refuse every other key."""
        for key in self._all_keys:
            if key not in keys:
                close = difflib.get_close_matches(key, keys, n=1)
                hint = f" (did you mean {self.key(close[0])}?)" if close else ""
                self.refuse(key, f"one of the keys {', '.join(keys)}{hint}", "an unknown key")

    def excluded(self, key: str, *others: str) -> None:
        """Refuse a key beside others that say the same."""
        for other in others:
            if key in self.values and other in self.values:
                self.refuse(key, f"left out where {self.key(other)} is given", "both")

    def empty(self, where: str) -> None:
        """Refuse every key."""
        for key, value in self.values.items():
            self.refuse(key, f"left out where {where}", brief(value))

    def needed(self, *keys: str) -> None:
        """Refuse a table in which none of the keys is."""
        if not any(key in self.values for key in keys):
            self.refuse(keys[0], "given" + "".join(f", or {self.key(key)}" for key in keys[1:]), "nothing")

    def table(self, key: str, nullable: Iterable[str] = ()) -> _Table:
        value = self.values[key]
        if not isinstance(value, dict):
            self.refuse(key, "a table of keys", brief(value))
        return _Table(value, self.key(key), self._file, nullable)

    def tables(self, key: str) -> list[_Table]:
        value = self.values.get(key, [])
        if not isinstance(value, list):
            self.refuse(key, "a list of tables", brief(value))
        tables = []
        for number, item in enumerate(value, start=1):
            if not isinstance(item, dict):
                self.refuse(f"{key}[{number}]", "a table of keys", brief(item))
            tables.append(_Table(item, self.key(f"{key}[{number}]"), self._file))
        return tables

    def text(self, key: str) -> str:
        value = self.values.get(key, "")
        if not isinstance(value, str) or "\0" in value:
            self.refuse(key, "text", brief(value))
        return value

    def per_storey(self, key: str) -> FloatArray | None:
        value = self.values.get(key)
        return None if value is None else as_array(value, self.key(key), self._file, InvalidScene, or_number=True)

    def number(self, key: str, default: float) -> float:
        return as_number(self.values.get(key, default), self.key(key), self._file, InvalidSceneFile)


def _building(table: _Table) -> Building:
    table.known(KEYS["building"])
    table.excluded("yield_shear_over_weight", "yield_shear")
    table.excluded("geometric_stiffness", "gravity_load")
    if "gravity_load" in table.values:
        table.needed("heights")
    springs = {key: table.values[key] for key in _SPRING_KEYS if key in table.values}
    if "damping" in table.values:
        springs["damping"] = _damping(table)
    yield_shear = _yield_shear(table.values.get("yield_shear"))
    if yield_shear is not None:
        springs["yield_shear"] = yield_shear
    over_weight = _yield_shear(table.values.get("yield_shear_over_weight"))
    if "period" in table.values:
        table.excluded("stiffness", "period")
        table.needed("storeys")
        if isinstance(table.values.get("mass"), list):
            table.refuse("mass", f"one number where {table.key('period')} is given", brief(table.values["mass"]))
        uniform = {key: table.values[key] for key in ("mass",) if key in table.values}
        return Building.uniform(
            table.values["storeys"],
            table.values["period"],
            **uniform,
            yield_shear_over_weight=over_weight,
            **springs,
        )
    table.needed("stiffness", "period")
    table.needed("mass")
    mass, stiffness = table.values["mass"], table.values["stiffness"]
    count = _storeys(table, over_weight, springs)
    if count is not None:
        mass = np.full(count, as_number(mass, "mass", "building", InvalidScene))
    if over_weight is None:
        return Building(mass, stiffness, **springs)
    building = Building(mass, stiffness, **springs)
    return building.replace(yield_shear=as_fraction_of_weight(over_weight, building.storeys) * building.weight)


def _storeys(table: _Table, over_weight: Any, springs: dict[str, Any]) -> int | None:
    """Number of storeys as stated, or that of the strengths over the weight where nothing else is a list."""
    listed = any(isinstance(table.values[key], list) for key in ("mass", "stiffness"))
    if "storeys" in table.values:
        count = as_count(table.values["storeys"], "storeys", "building", InvalidScene, least=1)
        if listed:
            table.refuse("storeys", "left out where mass or stiffness is a list", str(count))
        if count > MAX_STOREYS:
            raise refusal(InvalidScene, "storeys", "building", f"at most {MAX_STOREYS}", str(count))
        return count
    listed = listed or any(isinstance(value, list) for value in springs.values())
    return len(over_weight) if isinstance(over_weight, list) and over_weight and not listed else None


def _yield_shear(value: Any) -> Any:
    """A null in a list is a storey that stays elastic; JSON has no infinity."""
    return [np.inf if item is None else item for item in value] if isinstance(value, list) else value


def _damping(building: _Table) -> float | Rayleigh | FloatArray:
    if not isinstance(building.values["damping"], dict):
        return as_number(building.values["damping"], "damping", "building", InvalidScene)
    table = building.table("damping")
    kind = table.values.get("kind")
    if not isinstance(kind, str) or kind not in _DAMPING_KEYS:
        table.refuse("kind", f"one of {', '.join(_DAMPING_KEYS)}", "nothing" if kind is None else brief(kind))
    table.known(("kind", *_DAMPING_KEYS[kind]))
    for key in _DAMPING_KEYS[kind]:
        table.needed(key)
    if kind == "matrix":
        return as_array(table.values["matrix"], "damping matrix", "building", InvalidScene, dimensions=2)
    ratio = as_number(table.values["ratio"], "damping ratio", "building", InvalidScene)
    return Rayleigh(ratio, table.values["modes"]) if kind == "rayleigh" else ratio


def _block(table: _Table, number: int) -> Block:
    table.known(KEYS["blocks"])
    table.needed("floor")
    table.needed("mass", "mass_ratio")
    table.needed("mu", "mu_s")
    table.excluded("mass_ratio", "mass")
    table.excluded("mu", "mu_s", "mu_k")
    owner = f"block {number}"
    floor = as_count(table.values["floor"], "floor", owner, InvalidScene)
    values = {key: as_number(value, key, owner, InvalidScene) for key, value in table.values.items() if key != "floor"}
    if "mu" in values and not 0.0 <= values["mu"] < np.inf:  # the kernel would call it mu_s
        raise refusal(InvalidScene, "mu", owner, "finite and not negative", f"{values['mu']:g}")
    return Block(floor, **values)


def _motions(top: _Table, folder: Path) -> tuple[Motion, tuple[Record, ...]]:
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


def _samples(table: _Table, folder: Path) -> tuple[FloatArray, float, Record | None]:
    """Acceleration (m/s2) and time step (s) after scaling, and the record they come from, if any."""
    table.known(KEYS["motion"])
    table.needed("file", "acceleration")
    table.excluded("file", "acceleration")
    unit = table.values.get("unit")
    if unit is not None and (not isinstance(unit, str) or unit not in ACCELERATION_UNITS):
        table.refuse("unit", f"one of {', '.join(ACCELERATION_UNITS)}", brief(unit))
    scale, dt_scale = table.number("scale", 1.0), table.number("dt_scale", 1.0)
    if not np.isfinite(scale):
        table.refuse("scale", "a finite number", f"{scale:g}")
    if not (np.isfinite(dt_scale) and dt_scale > 0.0):
        table.refuse("dt_scale", "a positive number", f"{dt_scale:g}")
    record, in_si = None, 1.0
    if "file" in table.values:
        file = table.text("file")
        dt = table.number("dt", 0.0) if "dt" in table.values else None
        record = read_record(folder / file, dt=dt, unit=unit)
        samples, dt = record.acceleration, record.dt
    else:
        table.needed("dt")
        samples = as_array(table.values["acceleration"], "acceleration", "motion", InvalidMotion)
        in_si = ACCELERATION_UNITS[unit or "m/s2"]
        dt = as_number(table.values["dt"], "dt", "motion", InvalidMotion)
    with np.errstate(over="ignore"):  # the motion refuses what is not finite
        return samples * in_si * scale, dt * dt_scale, record
