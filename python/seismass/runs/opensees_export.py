"""Models for OpenSeesPy: a folder with the buildings, their goods and motions, and a program that runs them."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
import polars as pl
from numpy.typing import ArrayLike

from seismass.base.errors import InvalidOption, InvalidScene, SeismassError
from seismass.base.files import Content, data_directory
from seismass.base.folders import write_folder
from seismass.base.fork_check import require_polars
from seismass.base.values import FieldValue, FloatArray, as_array, as_count, as_list, as_one_of, as_path, brief, refusal
from seismass.base.views import Card
from seismass.model.building import Building
from seismass.model.scene import Scene
from seismass.motions.motion import Motion, MotionLike, as_motion
from seismass.runs.response import EVENT_KINDS
from seismass.runs.simulate import simulate

PROGRAM: Final = "model.py"
CONTENT: Final = "model.json"
README: Final = "README.md"


def write_opensees(
    folder: str | os.PathLike[str],
    scenes: Mapping[str, Scene],
    motions: Iterable[MotionLike],
    *,
    documents: Mapping[str, str] | None = None,
) -> list[Path]:
    """Write models for OpenSeesPy, with the exact peaks beside them.

    Parameters
    ----------
    folder : path-like
        Folder for model.py, model.json, README.md and a file per motion; it is made if it is missing.
    scenes : mapping of str to Scene
        Models by name: shear buildings with trilinear springs, blocks without wear and stops.
    motions : iterable of Motion or Record
        Horizontal ground motions.
    documents : mapping of str to str, optional
        Further files of the folder: text by name.

    Returns
    -------
    list of Path
        The files, in the order written.

    Raises
    ------
    InvalidScene
        A scene has what the models do not have: another spring law, racks, walls, stops, wear, an initial state.
    InvalidOption
        There is no scene or no motion, or the folder is a file.
    InvalidMotion
        A motion has a vertical component.
    OSError
        A file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> import seismass as sm
    >>> from seismass.runs import write_opensees
    >>> building = sm.Building.uniform(2, 0.4, mass=1e5, yield_shear_over_weight=[0.3, 0.2])
    >>> scene = sm.Scene(building, sm.blocks_on_floors([1.0, 0.0], mu=0.2))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     files = write_opensees(folder, {"goods slide": scene}, sm.builtin_suite("seven")[:1])
    >>> [file.name for file in files]
    ['model.py', 'README.md', 'motion-01.txt', 'model.json', 'files.json']
    """
    out = as_path(folder, "folder of OpenSees models", InvalidOption)
    owner = "OpenSees export"
    listed_motions = as_list(motions, "motions", owner, InvalidOption, "Motions or Records")
    items = [as_motion(motion, f"motion {number}", owner) for number, motion in enumerate(listed_motions, start=1)]
    for scene in as_one_of(scenes, Mapping, "scenes", owner, InvalidOption).values():
        as_one_of(scene, Scene, "scene", owner, InvalidScene)
    as_one_of({} if documents is None else documents, Mapping, "documents", owner, InvalidOption)
    if not scenes or not items:
        got = "no motion" if scenes else "no scene"
        raise refusal(InvalidOption, "models", "OpenSees export", "scenes and motions, at least one of each", got)
    if out.exists() and not out.is_dir():
        raise refusal(InvalidOption, "folder", "OpenSees export", "a folder", str(out))
    for motion in items:
        if motion.vertical is not None:
            raise refusal(InvalidScene, "motions", "OpenSees export", "horizontal", "one with a vertical component")
    models = {name: model_content(scene, name) for name, scene in scenes.items()}
    for name, scene in scenes.items():
        models[name]["exact"] = [_exact(scene, motion) for motion in items]
    files = [f"motion-{number:02d}.txt" for number in range(1, len(items) + 1)]
    listed = [
        {"file": file, "dt": motion.dt, "samples": motion.samples} for file, motion in zip(files, items, strict=True)
    ]
    source = data_directory() / "opensees"
    texts: dict[str, Content] = dict(documents or {})
    texts |= {name: (source / name).read_text(encoding="utf-8") for name in (PROGRAM, README)}
    for file, motion in zip(files, items, strict=True):
        texts[file] = "".join(f"{value!r}\n" for value in motion.acceleration.tolist())
    texts[CONTENT] = json.dumps({"units": "kg, N, m, s", "models": models, "motions": listed}, indent=1) + "\n"
    return write_folder(out, texts, owner="OpenSees export")


def model_content(scene: Scene, name: str = "") -> dict[str, Any]:
    """Return a scene, called `name` in errors, as model.json has it."""
    building = scene.building

    owner = name if name == "scene" else f"scene {name}".strip()

    def refused(what: str) -> SeismassError:
        return refusal(InvalidScene, owner, "OpenSees export", "a shear building with goods", what)

    if building is None:
        raise refused("blocks on the ground alone")
    for what, is_there in (
        ("racks", bool(scene.racks)),
        ("a sliding base", scene.base is not None),
        ("two directions", scene.engine == "plane"),
        ("a stiffness matrix", building.stiffness_matrix is not None),
        ("backbones of several branches", building.backbone is not None),
        ("stops of springs", bool(np.isfinite(building.clearance).any())),
        ("stops of goods", any(block.stops is not None for block in scene.blocks)),
        ("friction that wears", any(block.wear for block in scene.blocks)),
        ("an initial state", scene.initial_drift is not None or scene.initial_velocity is not None),
        ("a velocity of goods", any(block.velocity for block in scene.blocks)),
    ):
        if is_there:
            raise refused(what)
    laws = sorted(set(building.hysteresis) - {"masing"})
    if laws:
        raise refused(f"springs of the law {laws[0]}")
    return {
        "mass": (building.mass if scene.fixed_goods is None else building.mass + scene.fixed_goods).tolist(),
        "springs": [_parallel(building, storey) for storey in range(len(building.mass))],
        "p_over_h": scene.geometric_stiffness.tolist(),
        "damping": building.damping_matrix.tolist(),
        "blocks": [
            {"floor": block.floor, "mass": float(mass), "mu_s": block.mu_s, "mu_k": block.mu_k}
            for block, mass in zip(scene.blocks, scene.block_mass, strict=True)
        ],
    }


def _parallel(building: Building, storey: int) -> list[tuple[float, float | None]]:
    """Stiffness (N/m) and strength (N; None: elastic) of springs in parallel that make the trilinear backbone."""
    stiffness, strength = float(building.stiffness[storey]), float(building.yield_shear[storey])
    if not np.isfinite(strength):
        return [(stiffness, None)]
    second, third = float(building.second_slope[storey]), float(building.third_slope[storey])
    first_yield = strength / stiffness
    parts: list[tuple[float, float | None]] = [(stiffness * (1.0 - second), strength * (1.0 - second))]
    if second > third:
        second_yield = first_yield + (float(building.overstrength[storey]) - 1.0) * first_yield / second
        parts.append((stiffness * (second - third), stiffness * (second - third) * second_yield))
    if third > 0.0:
        parts.append((stiffness * third, None))
    return [(part, limit) for part, limit in parts if part > 0.0]


def _exact(scene: Scene, motion: Motion) -> dict[str, list[float]]:
    response = simulate(scene, motion, events=False)
    return {"drift": response.peak_drift.tolist(), "slip": response.peak_slip.tolist()}


@dataclass(frozen=True, eq=False, repr=False)
class SpringPath(FieldValue, Card):
    """What a spring did along a list of drifts.

    Attributes
    ----------
    drift : ndarray, shape (drifts,)
        The drifts (m), as given.
    force : ndarray, shape (drifts,)
        Force of the spring at each of them, without damping and P-Delta (N).
    dissipated : ndarray, shape (drifts,)
        Energy dissipated up to each of them (J).
    stored : ndarray, shape (drifts,)
        Energy stored at each of them (J).
    events : polars.DataFrame
        Events on the way, in order: `drift_number` of the drift towards which it happened, from 1; `drift` (m) and
        `force` (N) then; `kind`, `sign` and `element` as in `Response.events`.
    """

    drift: FloatArray
    force: FloatArray
    dissipated: FloatArray
    stored: FloatArray
    events: pl.DataFrame


def spring_forces(building: Building, storey: int, drifts: ArrayLike) -> SpringPath:
    """Drive the spring of a storey from one drift to the next and return its forces.

    The spring is virgin at first, at drift 0. It moves slowly, without damping, P-Delta and collapse.

    Parameters
    ----------
    building : Building
        The building.
    storey : int
        Number of the storey, from 1.
    drifts : array_like, shape (drifts,)
        Drifts (m), reached one after the other, each by a straight way from the one before.

    Returns
    -------
    SpringPath
        Forces, energies and events.

    Raises
    ------
    InvalidOption
        There is no such storey, or a drift is not a finite number.
    SimulationError
        The process was forked from one in which Polars had been used.

    Examples
    --------
    An elastoplastic storey that yields at 0.01 m, pushed to 0.03 m and back:

    >>> import seismass as sm
    >>> building = sm.Building(1e3, 1e6, yield_shear=1e4, overstrength=1.0, second_slope=0.0)
    >>> path = sm.runs.spring_forces(building, 1, [0.005, 0.03, 0.0])
    >>> path.force.tolist()
    [5000.0, 10000.0, -10000.0]
    >>> path.events["kind"].to_list()
    ['yield', 'unload', 'yield']
    """
    if not isinstance(building, Building):
        raise refusal(InvalidOption, "building", "spring path", "a Building", brief(building))
    require_polars("spring_forces")
    number = as_count(storey, "storey", "spring path", InvalidOption, least=1)
    if number > building.storeys:
        requirement = f"the number of a storey, counted from 1 to {building.storeys}"
        raise refusal(InvalidOption, "storey", "spring path", requirement, str(number))
    path = as_array(drifts, "drifts", "spring path", InvalidOption)
    run = building._kernel.spring_path(number - 1, path)
    events = pl.DataFrame(
        {
            "drift_number": pl.Series(run.event_leg + 1, dtype=pl.UInt32),
            "drift": pl.Series(run.event_drift, dtype=pl.Float64),
            "force": pl.Series(run.event_force, dtype=pl.Float64),
            "kind": pl.Series(np.array(EVENT_KINDS)[run.event_kind].tolist(), dtype=pl.String),
            "sign": pl.Series(run.event_sign, dtype=pl.Int8),
            "element": pl.Series(run.event_element, dtype=pl.UInt8).replace(0, None),
        }
    )
    return SpringPath(path, run.force, run.dissipated, run.stored, events)
