"""Wrong input: every refusal has its exception and says which parameter of what must be what, and what it was."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

import seismass as sm
from seismass import _kernel
from seismass.runs.batch import MAX_THREADS

NAN, INF = float("nan"), float("inf")
QUIET = sm.Motion([0.0, 1.0, 0.0], 0.01)


def building(**changes: object) -> sm.Building:
    arguments: dict[str, object] = {"mass": [1e3, 1e3], "stiffness": [5e5, 5e5]}
    return sm.Building(**(arguments | changes))  # type: ignore[arg-type]


def block(**changes: object) -> sm.Scene:
    arguments: dict[str, object] = {"floor": 1, "mass": 1e3, "mu": 0.3}
    arguments |= changes
    return sm.Scene(building(), [sm.Block(**{k: v for k, v in arguments.items() if v is not None})])  # type: ignore[arg-type]


def scene(**changes: object) -> sm.Scene:
    return sm.Scene(building(yield_shear=1e3), **changes)  # type: ignore[arg-type]


Case = tuple[str, Callable[[], object], type[Exception], str]

CASES: list[Case] = [
    # Building
    (
        "no storeys",
        lambda: building(mass=[], stiffness=[]),
        sm.errors.InvalidScene,
        r"mass of building must be a list of at least one floor mass; got none",
    ),
    (
        "NaN mass",
        lambda: building(mass=[1e3, NAN]),
        sm.errors.InvalidScene,
        r"mass of floor 2 must be a positive number; got NaN",
    ),
    (
        "infinite mass",
        lambda: building(mass=[INF, 1e3]),
        sm.errors.InvalidScene,
        r"mass of floor 1 must be a positive number; got inf",
    ),
    (
        "negative mass",
        lambda: building(mass=[-1e3, 1e3]),
        sm.errors.InvalidScene,
        r"mass of floor 1 must be a positive number; got -1000",
    ),
    (
        "zero mass",
        lambda: building(mass=0),
        sm.errors.InvalidScene,
        r"mass of floor 1 must be a positive number; got 0",
    ),
    (
        "mass as text",
        lambda: building(mass="heavy"),
        sm.errors.InvalidScene,
        r"mass of building must be a number or a list of numbers; got 'heavy'",
    ),
    (
        "masses as text",
        lambda: building(mass=["1", "2"]),
        sm.errors.InvalidScene,
        r"mass of building must be .*numbers; got \['1', '2'\]",
    ),
    (
        "mass as bool",
        lambda: building(mass=True),
        sm.errors.InvalidScene,
        r"mass of building must be .*numbers; got True",
    ),
    (
        "mass as None",
        lambda: building(mass=[None, 1e3]),
        sm.errors.InvalidScene,
        r"mass of building must be .*numbers; got \[None, 1000.0\]",
    ),
    (
        "ragged masses",
        lambda: building(mass=[[1.0], [1.0, 2.0]]),
        sm.errors.InvalidScene,
        r"mass of building must be .*numbers; got \[\[1.0\]",
    ),
    (
        "table of masses",
        lambda: building(mass=np.ones((2, 2))),
        sm.errors.InvalidScene,
        r"mass of building must be .*numbers; got an array of shape \(2, 2\)",
    ),
    (
        "complex mass",
        lambda: building(mass=[1j, 2.0]),
        sm.errors.InvalidScene,
        r"mass of building must be .*numbers; got",
    ),
    (
        "too few stiffnesses",
        lambda: building(stiffness=[5e5]),
        sm.errors.InvalidScene,
        r"stiffness of building must be one number or a list of 2 values, one per storey; got 1 values",
    ),
    (
        "too many strengths",
        lambda: building(yield_shear=[1.0] * 3),
        sm.errors.InvalidScene,
        r"yield_shear of building must be .* 2 values, one per storey; got 3 values",
    ),
    (
        "zero stiffness",
        lambda: building(stiffness=[5e5, 0.0]),
        sm.errors.InvalidScene,
        r"stiffness of storey 2 must be a positive number; got 0",
    ),
    (
        "infinite stiffness",
        lambda: building(stiffness=INF),
        sm.errors.InvalidScene,
        r"stiffness of storey 1 must be a positive number; got inf",
    ),
    (
        "negative strength",
        lambda: building(yield_shear=-1.0),
        sm.errors.InvalidScene,
        r"yield_shear of storey 1 must be positive .*; got -1",
    ),
    (
        "NaN strength",
        lambda: building(yield_shear=[1.0, NAN]),
        sm.errors.InvalidScene,
        r"yield_shear of storey 2 must be positive .*; got NaN",
    ),
    (
        "overstrength below 1",
        lambda: building(overstrength=0.9),
        sm.errors.InvalidScene,
        r"overstrength of storey 1 must be finite and at least 1; got 0.9",
    ),
    (
        "second slope above 1",
        lambda: building(second_slope=1.1),
        sm.errors.InvalidScene,
        r"second_slope of storey 1 must be between 0 and 1; got 1.1",
    ),
    (
        "third slope above second",
        lambda: building(second_slope=0.1, third_slope=0.2),
        sm.errors.InvalidScene,
        r"third_slope of storey 1 must be between 0 and the second slope 0.1; got 0.2",
    ),
    (
        "negative third slope",
        lambda: building(third_slope=[0.0, -0.1]),
        sm.errors.InvalidScene,
        r"third_slope of storey 2 must be between 0 and .*; got -0.1",
    ),
    (
        "negative damping",
        lambda: building(damping=-0.05),
        sm.errors.InvalidScene,
        r"damping.* of .* must be .*; got -0.05",
    ),
    ("NaN damping", lambda: building(damping=NAN), sm.errors.InvalidScene, r"damping.* of .* must be .*; got NaN"),
    (
        "damping in per cent",
        lambda: building(damping=5),
        sm.errors.InvalidScene,
        r"damping of building must be a ratio of at most 1 \(0.05 for 5 %\); got 5",
    ),
    (
        "Rayleigh damping in per cent",
        lambda: building(damping=sm.Rayleigh(5.0)),
        sm.errors.InvalidScene,
        r"damping of building must be a ratio of at most 1 \(0.05 for 5 %\); got 5",
    ),
    (
        "damping as text",
        lambda: building(damping="five"),
        sm.errors.InvalidScene,
        r"damping of building must be a ratio, Rayleigh damping or a matrix; got 'five'",
    ),
    (
        "damping as list",
        lambda: building(damping=[0.05, 0.05]),
        sm.errors.InvalidScene,
        r"damping of building must be a table of numbers, rows by columns; got an array of shape \(2,\)",
    ),
    (
        "damping of other size",
        lambda: building(damping=np.eye(3)),
        sm.errors.InvalidScene,
        r"damping.* of .* must be .*; got .*3",
    ),
    (
        "oblong damping",
        lambda: building(damping=np.ones((2, 3))),
        sm.errors.InvalidScene,
        r"damping of building must be a square matrix; got 2 x 3",
    ),
    (
        "asymmetric damping",
        lambda: building(damping=[[1.0, 0.5], [0.0, 1.0]]),
        sm.errors.InvalidScene,
        r"damping.* of .* must be .*symmetric.*; got",
    ),
    (
        "NaN in damping",
        lambda: building(damping=[[NAN, 0.0], [0.0, 1.0]]),
        sm.errors.InvalidScene,
        r"damping.* of .* must be .*; got",
    ),
    (
        "equal Rayleigh modes",
        lambda: building(damping=sm.Rayleigh(0.05, (1, 1))),
        sm.errors.InvalidScene,
        r"damping modes of building must be two different modes from 1 to 2; got 1 and [13]",
    ),
    (
        "missing Rayleigh mode",
        lambda: building(damping=sm.Rayleigh(0.05, (1, 3))),
        sm.errors.InvalidScene,
        r"damping modes of building must be two different modes from 1 to 2; got 1 and [13]",
    ),
    (
        "Rayleigh mode 0",
        lambda: building(damping=sm.Rayleigh(0.05, (0, 1))),
        sm.errors.InvalidScene,
        r"modes of Rayleigh damping must be a whole number of at least 1; got 0",
    ),
    (
        "one Rayleigh mode",
        lambda: building(damping=sm.Rayleigh(0.05, (1,))),
        sm.errors.InvalidScene,
        r"modes of Rayleigh damping must be two mode numbers; got \(1,\)",
    ),  # type: ignore[arg-type]
    (
        "zero height",
        lambda: building(heights=[3.0, 0.0]),
        sm.errors.InvalidScene,
        r"heights of storey 2 must be a positive number; got 0",
    ),
    (
        "zero height with loads",
        lambda: building(heights=[3.0, 0.0], gravity_load=1.0),
        sm.errors.InvalidScene,
        r"heights of storey 2 must be a positive number; got 0",
    ),
    (
        "too many heights",
        lambda: building(heights=[3.0] * 3),
        sm.errors.InvalidScene,
        r"heights of building must be .* 2 values, one per storey; got 3 values",
    ),
    (
        "loads without heights",
        lambda: building(gravity_load=1e3),
        sm.errors.InvalidScene,
        r"heights of building must be given where gravity_load is; got none",
    ),
    (
        "negative load",
        lambda: building(heights=3.0, gravity_load=[-1.0, 0.0]),
        sm.errors.InvalidScene,
        r"gravity_load of floor 1 must be zero or positive; got -1",
    ),
    (
        "both P-Delta forms",
        lambda: building(heights=3.0, gravity_load=1.0, geometric_stiffness=1.0),
        sm.errors.InvalidScene,
        r"geometric_stiffness of building must be left out where gravity_load is given; got both",
    ),
    (
        "P/h reaches k",
        lambda: sm.Scene(building(geometric_stiffness=[1.0, 5e5])),
        sm.errors.InvalidScene,
        r"geometric stiffness P/h of storey 2 must be below its stiffness 500000 N/m; got 500000",
    ),
    (
        "P/h of the blocks reaches k",
        lambda: sm.Scene(building(heights=1.0, gravity_load=0.0), [sm.Block(1, mass=1e5, mu=0.3)]),
        sm.errors.InvalidScene,
        r"geometric stiffness P/h of storey 1 must be below .*; got 980665",
    ),
    (
        "negative P/h",
        lambda: building(geometric_stiffness=-1.0),
        sm.errors.InvalidScene,
        r"geometric_stiffness of storey 1 must be zero or positive; got -1",
    ),
    # Uniform buildings
    (
        "uniform of no storeys",
        lambda: sm.Building.uniform(0, 0.5),
        sm.errors.InvalidScene,
        r"storeys of building must be a whole number of at least 1; got 0",
    ),
    (
        "uniform of half a storey",
        lambda: sm.Building.uniform(2.5, 0.5),
        sm.errors.InvalidScene,
        r"storeys of building must be a whole number of at least 1; got 2.5",
    ),  # type: ignore[arg-type]
    (
        "uniform of period zero",
        lambda: sm.Building.uniform(2, 0.0),
        sm.errors.InvalidScene,
        r"period of building must be a positive number; got 0",
    ),
    (
        "uniform of NaN period",
        lambda: sm.Building.uniform(2, NAN),
        sm.errors.InvalidScene,
        r"period of building must be a positive number; got NaN",
    ),
    (
        "uniform of many masses",
        lambda: sm.Building.uniform(2, 0.5, mass=[1, 2]),
        sm.errors.InvalidScene,
        r"mass of building must be a number; got \[1, 2\]",
    ),  # type: ignore[arg-type]
    (
        "both strengths",
        lambda: sm.Building.uniform(2, 0.5, mass=1.0, yield_shear=1.0, yield_shear_over_weight=0.1),
        sm.errors.InvalidScene,
        r"yield_shear_over_weight of building must be left out where yield_shear is given; got both",
    ),
    # Blocks
    (
        "block without mass",
        lambda: sm.Block(1, mu=0.3),
        sm.errors.InvalidScene,
        r"mass of block must be given either as mass or as mass_ratio; got neither",
    ),
    (
        "block with two masses",
        lambda: sm.Block(1, mass=1.0, mass_ratio=1.0, mu=0.3),
        sm.errors.InvalidScene,
        r"mass of block must be given .*; got both",
    ),
    (
        "block without friction",
        lambda: sm.Block(1, mass=1.0),
        sm.errors.InvalidScene,
        r"mu of block must be given, or mu_s; got neither",
    ),
    (
        "block with two frictions",
        lambda: sm.Block(1, mass=1.0, mu=0.3, mu_k=0.2),
        sm.errors.InvalidScene,
        r"mu of block must be left out where mu_s or mu_k is given; got 0.3",
    ),
    (
        "block friction as text",
        lambda: sm.Block(1, mass=1.0, mu="low"),
        sm.errors.InvalidScene,
        r"mu of block must be a number; got 'low'",
    ),  # type: ignore[arg-type]
    (
        "block on half a floor",
        lambda: sm.Block(1.5, mass=1.0, mu=0.3),
        sm.errors.InvalidScene,
        r"floor of block must be a whole number of at least 0; got 1.5",
    ),  # type: ignore[arg-type]
    (
        "block below the ground",
        lambda: sm.Block(-1, mass=1.0, mu=0.3),
        sm.errors.InvalidScene,
        r"floor of block must be a whole number of at least 0; got -1",
    ),
    (
        "block on a missing floor",
        lambda: block(floor=3),
        sm.errors.InvalidScene,
        r"floor of block 1 must be a floor of the building, 1 to 2, or 0 for the ground; got 3",
    ),
    (
        "ratio on a missing floor",
        lambda: block(floor=3, mass=None, mass_ratio=1.0),
        sm.errors.InvalidScene,
        r"floor of block 1 must be a floor of the building, 1 to 2; got 3",
    ),
    (
        "ratio on the ground",
        lambda: block(floor=0, mass=None, mass_ratio=1.0),
        sm.errors.InvalidScene,
        r"mass_ratio of block 1 must be left out on the ground; got 1",
    ),
    (
        "negative ratio",
        lambda: block(mass=None, mass_ratio=-1.0),
        sm.errors.InvalidScene,
        r"mass_ratio of block 1 must be a positive number; got -1",
    ),
    (
        "NaN block mass",
        lambda: block(mass=NAN),
        sm.errors.InvalidScene,
        r"mass of block 1 must be a positive number; got NaN",
    ),
    (
        "weightless block",
        lambda: block(mass=0),
        sm.errors.InvalidScene,
        r"mass of block 1 must be a positive number; got 0",
    ),
    (
        "negative friction",
        lambda: block(mu=-0.1),
        sm.errors.InvalidScene,
        r"mu_s of block 1 must be finite and not negative; got -0.1",
    ),
    (
        "strength over weight, negative",
        lambda: sm.Building.uniform(3, 0.6, yield_shear_over_weight=[0.2, -0.1, 0.1]),
        sm.errors.InvalidScene,
        r"yield_shear_over_weight of building must be positive; got \[0.2, -0.1, 0.1\]",
    ),
    (
        "strength over weight, too few",
        lambda: sm.Building.uniform(3, 0.6, yield_shear_over_weight=[0.2, 0.1]),
        sm.errors.InvalidScene,
        r"yield_shear_over_weight of building must be one number or a list of 3 values, one per storey; got 2 values",
    ),
    (
        "strength over weight, a list of one",
        lambda: sm.Building.uniform(3, 0.6, yield_shear_over_weight=[0.2]),
        sm.errors.InvalidScene,
        r"yield_shear_over_weight of building must be one number or a list of 3 values, one per storey; got 1 values",
    ),
    (
        "initial drift of nothing",
        lambda: sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)], initial_drift=0.1),
        sm.errors.InvalidScene,
        r"initial_drift of scene must be left out where there is no building; got 0.1",
    ),
    (
        "initial velocity of nothing",
        lambda: sm.Scene(None, initial_velocity=[0.1]),
        sm.errors.InvalidScene,
        r"initial_velocity of scene must be left out where there is no building; got \[0.1\]",
    ),
    (
        "collapse of nothing",
        lambda: sm.Scene(None, collapse_drift=0.3),
        sm.errors.InvalidScene,
        r"collapse_drift of scene must be left out where there is no building; got 0.3",
    ),
    (
        "scene file as number",
        lambda: sm.read_scene(5),
        sm.errors.InvalidSceneFile,
        r"path of scene file must be a path; got 5",
    ),  # type: ignore[arg-type]
    (
        "record as number",
        lambda: sm.read_record(5),  # type: ignore[arg-type]
        sm.errors.RecordFormatError,
        r"path of record must be a path; got 5",
    ),
    ("suite as number", lambda: sm.read_suite(5), sm.errors.RecordFormatError, r"path of suite must be a path; got 5"),  # type: ignore[arg-type]
    (
        "negative threads",
        lambda: sm.simulate_many([block()], [sm.Motion([0.0, 1.0], 0.01)], threads=-1),
        sm.errors.InvalidOption,
        r"threads of batch must be a whole number of at least 1; got -1",
    ),
    (
        "infinite friction",
        lambda: block(mu=INF),
        sm.errors.InvalidScene,
        r"mu_s of block 1 must be finite and not negative; got inf",
    ),
    (
        "mu_k above mu_s",
        lambda: block(mu=None, mu_s=0.3, mu_k=0.4),
        sm.errors.InvalidScene,
        r"mu_k of block 1 must be at most mu_s = 0.3; got 0.4",
    ),
    (
        "NaN block velocity",
        lambda: block(velocity=NAN),
        sm.errors.InvalidScene,
        r"velocity of block 1 must be a finite number; got NaN",
    ),
    (
        "frictions of other length",
        lambda: sm.blocks_on_floors([1, 1], [0.3] * 3),
        sm.errors.InvalidScene,
        r"mu of blocks must be one number or a list of 2 values, one per floor; got 3 values",
    ),
    # Scenes
    (
        "empty scene",
        lambda: sm.Scene(None),
        sm.errors.InvalidScene,
        r"blocks of scene must be at least one where there is no building; got none",
    ),
    (
        "building of another kind",
        lambda: sm.Scene("tower"),
        sm.errors.InvalidScene,
        r"building of scene must be a Building or None; got 'tower'",
    ),  # type: ignore[arg-type]
    (
        "blocks of another kind",
        lambda: sm.Scene(building(), [1]),
        sm.errors.InvalidScene,
        r"block 1 of scene must be a Block; got 1",
    ),  # type: ignore[list-item]
    (
        "one block, no list",
        lambda: sm.Scene(building(), sm.Block(1, mass=1.0, mu=0.3)),
        sm.errors.InvalidScene,
        r"blocks of scene must be a list of Blocks; got Block",
    ),  # type: ignore[arg-type]
    (
        "initial drift beyond yield",
        lambda: scene(initial_drift=[3e-3, 0.0]),
        sm.errors.InvalidScene,
        r"initial drift of storey 1 must be within 0.002 m, its elastic range; got 0.003",
    ),
    (
        "initial drifts of other length",
        lambda: scene(initial_drift=[0.0]),
        sm.errors.InvalidScene,
        r"drift of initial state must be a list of 2 values, one per storey; got 1 values",
    ),
    (
        "NaN initial velocity",
        lambda: scene(initial_velocity=[0.0, NAN]),
        sm.errors.InvalidScene,
        r"initial velocity of floor 2 must be a finite number; got NaN",
    ),
    (
        "collapse drift zero",
        lambda: scene(collapse_drift=0.0),
        sm.errors.InvalidScene,
        r"collapse_drift of storey 1 must be a positive number; got 0",
    ),
    (
        "start beyond collapse",
        lambda: scene(collapse_drift=1e-3, initial_drift=[1.5e-3, 0]),
        sm.errors.InvalidScene,
        r"initial drift of storey 1 must be below the collapse drift 0.001 m; got 0.0015",
    ),
    # Motions
    (
        "empty motion",
        lambda: sm.Motion([], 0.01),
        sm.errors.InvalidMotion,
        r"acceleration of motion must be a list of 1 to \d+ samples; got 0 samples",
    ),
    (
        "NaN sample",
        lambda: sm.Motion([0.0, NAN], 0.01),
        sm.errors.InvalidMotion,
        r"acceleration of motion must be finite at every sample; got NaN at sample 1",
    ),
    (
        "infinite vertical sample",
        lambda: sm.Motion([0.0, 0.0], 0.01, [0.0, -INF]),
        sm.errors.InvalidMotion,
        r"vertical acceleration of motion must be finite at every sample; got -inf at sample 1",
    ),
    (
        "vertical of other length",
        lambda: sm.Motion([0.0, 0.0], 0.01, [0.0]),
        sm.errors.InvalidMotion,
        r"vertical acceleration of motion must be as long as the horizontal one, 2 samples; got 1 samples",
    ),
    (
        "samples as text",
        lambda: sm.Motion(["a", "b"], 0.01),
        sm.errors.InvalidMotion,
        r"acceleration of motion must be a list of numbers; got \['a', 'b'\]",
    ),
    (
        "two columns",
        lambda: sm.Motion([[0.0, 1.0]], 0.01),
        sm.errors.InvalidMotion,
        r"acceleration of motion must be a list of numbers; got an array of shape \(1, 2\)",
    ),
    (
        "one number",
        lambda: sm.Motion(1.0, 0.01),
        sm.errors.InvalidMotion,
        r"acceleration of motion must be a list of numbers; got 1.0",
    ),
    (
        "zero dt",
        lambda: sm.Motion([0.0], 0.0),
        sm.errors.InvalidMotion,
        r"dt of motion must be a positive number; got 0",
    ),
    (
        "negative dt",
        lambda: sm.Motion([0.0], -0.01),
        sm.errors.InvalidMotion,
        r"dt of motion must be a positive number; got -0.01",
    ),
    (
        "NaN dt",
        lambda: sm.Motion([0.0], NAN),
        sm.errors.InvalidMotion,
        r"dt of motion must be a positive number; got NaN",
    ),
    (
        "dt as text",
        lambda: sm.Motion([0.0], "0.01"),
        sm.errors.InvalidMotion,
        r"dt of motion must be a number; got '0.01'",
    ),  # type: ignore[arg-type]
    (
        "negative duration",
        lambda: QUIET.with_duration(-1.0),
        sm.errors.InvalidMotion,
        r"duration of motion must be between 0 and [\d.]+ s; got -1",
    ),
    (
        "NaN duration",
        lambda: sm.simulate(block(), QUIET, duration=NAN),
        sm.errors.InvalidMotion,
        r"duration of motion must be .*; got NaN",
    ),
    # Runs
    (
        "run of no scene",
        lambda: sm.simulate("scene", QUIET),
        sm.errors.InvalidScene,
        r"scene of simulate must be a Scene; got 'scene'",
    ),  # type: ignore[arg-type]
    (
        "run of no motion",
        lambda: sm.simulate(block(), [0.0, 1.0]),
        sm.errors.InvalidMotion,
        r"motion of simulate must be a Motion or a Record; got \[0.0, 1.0\]",
    ),  # type: ignore[arg-type]
    (
        "every zero samples",
        lambda: sm.simulate(block(), QUIET, histories=0),
        sm.errors.InvalidOption,
        r"histories of simulate must be a whole number of at least 1; got 0",
    ),
    (
        "history left out",
        lambda: (
            sm.simulate(
                sm.Scene(None, [sm.Block(0, mass=1.0, mu=0.1)]),
                sm.Motion([1.0, 2.0], dt=0.1),
                histories=True,
                displacements_only=True,
            ).block_velocity
        ),
        sm.errors.InvalidOption,
        r"displacements_only of simulate must be False, if block_velocity is wanted; got True",
    ),
    (
        "history not asked for",
        lambda: sm.simulate(block(), QUIET).drift,
        sm.errors.InvalidOption,
        r"histories of simulate must be asked for, if drift is wanted; got False",
    ),
    (
        "times not asked for",
        lambda: sm.simulate(block(), QUIET).time,
        sm.errors.InvalidOption,
        r"histories of simulate must be asked for, if time is wanted; got False",
    ),
    (
        "events not asked for",
        lambda: sm.simulate(block(), QUIET, events=False).events,
        sm.errors.InvalidOption,
        r"events of simulate must be asked for, if events is wanted; got False",
    ),
    (
        "energy not asked for",
        lambda: sm.simulate(block(), QUIET).energy,
        sm.errors.InvalidOption,
        r"energy of simulate must be asked for, if energy is wanted; got False",
    ),
    (
        "batch of other things",
        lambda: sm.simulate_many([block(), 1], QUIET),
        sm.errors.InvalidScene,
        r"scene 2 of batch must be a Scene; got 1",
    ),  # type: ignore[list-item]
    (
        "batch of no list",
        lambda: sm.simulate_many(1, QUIET),
        sm.errors.InvalidScene,
        r"scenes of batch must be a list of Scenes; got 1",
    ),  # type: ignore[arg-type]
    (
        "batch under other things",
        lambda: sm.simulate_many(block(), [QUIET, None]),
        sm.errors.InvalidMotion,
        r"motion 2 of batch must be a Motion or a Record; got None",
    ),  # type: ignore[list-item]
    (
        "pair of a missing scene",
        lambda: sm.simulate_many(block(), QUIET, pairs=[(1, 1), (2, 1)]),
        sm.errors.InvalidOption,
        r"pairs of batch must be the number of a scene, counted from 1 to 1; got 2 in pair 2",
    ),
    (
        "pairs of three",
        lambda: sm.simulate_many(block(), QUIET, pairs=[(1, 1, 1)]),
        sm.errors.InvalidOption,
        r"pairs of batch must be rows of \(number of scene, number of motion\); got",
    ),
    (
        "pairs of fractions",
        lambda: sm.simulate_many(block(), QUIET, pairs=[(0.0, 0.5)]),
        sm.errors.InvalidOption,
        r"pairs of batch must be rows of .*; got",
    ),
    (
        "too many runs",
        lambda: sm.stream_many(
            sm.Grid.product(
                sm.Building.uniform(1, 0.3), mass_ratio=[1.0] * 2**16, mu=[0.1] * 2**18, scale=[1.0] * 2**18
            ),
            [QUIET] * 3,
        ),
        sm.errors.InvalidOption,
        rf"runs of batch must be at most {2**53}; got {3 * 2**52}",
    ),
    (
        "no threads",
        lambda: sm.simulate_many(block(), QUIET, threads=0),
        sm.errors.InvalidOption,
        r"threads of batch must be a whole number of at least 1; got 0",
    ),
    (
        "threads without end",
        lambda: sm.simulate_many(block(), QUIET, threads=10**6),
        sm.errors.InvalidOption,
        r"threads of batch must be between 1 and 1024; got 1000000",
    ),
    (
        "threads without end, judged before a frame is asked for",
        lambda: sm.stream_many(block(), QUIET, threads=MAX_THREADS + 1),
        sm.errors.InvalidOption,
        r"threads of batch must be between 1 and 1024; got 1025",
    ),
    (
        "threads without end, by the kernel",
        lambda: _kernel.simulate_many([], [], np.empty((0, 2), dtype=np.int64), threads=MAX_THREADS + 1),
        sm.errors.InvalidOption,
        rf"threads of batch must be between 1 and {MAX_THREADS}; got 1025",
    ),
    (
        "progress of another kind",
        lambda: sm.simulate_many(block(), QUIET, progress="bar"),
        sm.errors.InvalidOption,
        r"progress of batch must be a callable of two numbers; got 'bar'",
    ),  # type: ignore[arg-type]
]


@pytest.mark.parametrize(("make", "kind", "message"), [case[1:] for case in CASES], ids=[case[0] for case in CASES])
def test_wrong_input_is_refused_by_name(make: Callable[[], object], kind: type[Exception], message: str) -> None:
    with pytest.raises(kind, match=f"^{message}") as refused:
        make()
    assert isinstance(refused.value, sm.SeismassError)
    assert isinstance(refused.value, ValueError)
    text = str(refused.value)
    assert " of " in text
    assert " must be " in text
    assert "; got " in text


def test_the_table_is_long_enough() -> None:
    assert len(CASES) >= 40
    assert len({name for name, *_ in CASES}) == len(CASES)


def test_a_run_that_leaves_the_range_of_numbers_is_an_error_and_a_row() -> None:
    falling = sm.Scene(sm.Building(1.0, 1.0, yield_shear=1e-9, second_slope=0.0, damping=0.0))
    huge = sm.Motion([1e308] * 50, 10.0)
    with pytest.raises(sm.errors.SimulationError, match="t = "):
        sm.simulate(falling, huge)
    table = sm.simulate_many(falling, [huge, QUIET])
    assert table["status"].to_list() == ["failed", "completed"]
    assert "t = " in table["reason"][0]
    assert table["peak_drift"].to_list()[0] is None
    assert table["end_time"][0] is None
    assert table["events"][0] is None
