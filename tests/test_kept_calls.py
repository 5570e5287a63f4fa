"""What the public calls answer is as it was, with their defaults and with each argument given in turn.

Calls are made from the names: every function of every public module, and every method of a value of each class, plots
and cards among them. An argument that may be left out is given another value: the other truth value, each other word
of its type, another number, or what GIVEN or BY_NAME say. Answers, refusals too, are compared with
tests/kept_answers/calls; `KEEP_ANSWERS=1 pytest tests/test_kept_calls.py` writes them anew.
"""

from __future__ import annotations

import inspect
import runpy
import typing
import warnings
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import ImageDraw

import seismass as sm
from answer_texts import array_text, compare, short, steady, value_lines
from seismass.show.animation.picture import Picture
from seismass.show.animation.plane_picture import PlanePicture
from seismass.studies.slip.runs import Base

MODULES = """
records spectra scaling matching pulses fragility risk slip codes friction distributions runs plots design
occupancy evidence animation
"""
CLASSES = """
Animation AnnualRate Building Campaign CodeDesign DesignedBuilding EffectiveMass Fragility FragilityAnalysis Grid
HazardCurve LimitState LiveLoadUncertainty MatchedRecord MatchedSuite Motion OrientationScan OwnBuilding Pair
PlaneAnimation PlaneResponse PulseResult Pushover PushoverFit Racked Record Response RotD
ScalingResult Scene SlipDemand Suite TargetSpectrum
"""
"""Of each there is a value in `values`, under "made"."""
FOLDERS = "path folder progress threads ax axes figure executor workers scheduler unit report file"
LEFT_OUT = """
evidence match_suite effective_mass_map builtin_suite builtin_record builtin_pairs catalogue instruction_set
read_record read_records read_suite read_pair read_scene read_building read_campaign find_pairs find_catalogue
read_counts write_many write_opensees write assess validate figure_svg inline_svg example_file default_hazard
example_description animate risk_targeted_share to_json solve_grid multiple_stripes replace from_csv each run
as_motions digits digits_of_batch incremental_dynamic_analysis
"""
"""What whole commands are asked for, or files, and texts of results whose numbers are looked at."""
MOST, FIRST = 40, 5
"""Lines that are kept of a call with the defaults, and with an argument given; a check sum stands for the rest."""


G = sm.STANDARD_GRAVITY
PERIODS = np.array([0.17, 0.31, 0.53, 0.77, 1.3])


@pytest.fixture(scope="module")
def values(unequal_scene: sm.Scene, unequal_motions: tuple[sm.Record, ...], unequal_building: Any) -> dict[str, Any]:
    """Values of arguments by their names, no two quantities alike, and in "made" what makes one of each class."""
    scene, motions = unequal_scene, unequal_motions
    building, first, second = scene.building, motions[0], motions[1]
    plain = sm.Scene(
        building.replace(geometric_stiffness=None, gravity_load=None), scene.blocks, name="without P-Delta"
    )
    suite = sm.Suite("bursts", motions)
    crossing = np.interp(first.time, second.time, 0.83 * second.acceleration)
    other = sm.Record(crossing, first.dt, name="across", component="090", azimuth=121.0)
    pair = sm.Pair(first.replace(component="000", azimuth=31.0), other)
    target = sm.TargetSpectrum.asce7(1.13, 0.71, 6.7)
    hazard = sm.risk.HazardCurve([0.05, 0.31, 1.07, 4.1], [0.053, 0.0023, 0.00013, 1.1e-6], period=0.53, label="site")
    limit = sm.fragility.LimitState("drift", 0.031)
    grid = sm.Grid.product(building, mass_ratio=[0.41, 0.83], mu=[0.13, 0.29], scale=[0.7, 1.3])
    frame = sm.Building([2.3e4, 1.9e4], [2.3e7, 1.7e7], yield_shear=[1.3e5, 6.1e4], heights=[3.7, 3.1])
    goods = [sm.RackBlock(level, mass=1700.0 + 300.0 * level, mu=0.17 + 0.04 * level) for level in (1, 2)]
    rail = sm.Stops(0.03, stiffness=2.1e6, damping=1.9e3)
    racks = [
        sm.Rack(2, levels=2, level_mass=310.0, period=0.53, yield_shear=8.3e3, blocks=goods),
        sm.Rack(1, levels=1, level_mass=270.0, period=0.31, blocks=[sm.RackBlock(1, mass=2900.0, mu=0.15, stops=rail)]),
    ]
    stopped = sm.Block(1, mass=7900.0, mu_s=0.13, mu_k=0.11, stops=sm.Stops([0.05, 0.02], stiffness=5.3e6))
    racked = sm.Scene(sm.design.Wall.of_alpha_h(frame, 4.1).beside(frame), [stopped], racks=racks, name="racks")
    single = sm.Building.uniform(1, 0.43, mass=2.3e4, yield_shear=7.1e4, heights=3.7)
    small = sm.Scene(single, [stopped.replace(stops=None)])
    pairs = [*sm.blocks_on_floors([0.31, 0.23], mu=0.21), *sm.blocks_on_floors([0.19, 0.13], mu=0.17)]
    plane = sm.Scene(frame, pairs, other_direction=True, name="plane")
    kept = {"histories": True, "energy": True}
    response = sm.simulate(scene, first, **kept)
    planar = sm.simulate(plane, (pair.first, pair.second), histories=True)
    pulse = sm.records.NearFaultPulse(1.3, 0.31, 5.1)
    batch = sm.simulate_many([scene, plain], suite)
    loads = {"heights": [4.1, 3.6, 3.3], "fraction": 0.23, "area": 710.0, "system": "steel-moment-frame"}
    found = {
        "response": response,
        "scene": scene,
        "scenes": scene,
        "models": scene,
        "building": building,
        "mass": building.mass,
        "stiffness": building.stiffness,
        "heights": building.heights,
        "weight": building.mass * G,
        "load": building.mass * G * 1.7,
        "shear": [231e3, 157e3, 83e3],
        "drift": [0.017, 0.023, 0.013],
        "motion": first,
        "motions": suite,
        "record": first,
        "records": suite,
        "suite": suite,
        "pair": pair,
        "first": pair.first,
        "second": pair.second,
        "target": target,
        "spectrum": target,
        "small": small,
        "plane": planar,
        "flat": plane,
        "both": (pair.first, pair.second),
        "listed": [scene, plain],
        "small frame": frame,
        "many": sm.Suite("many", tuple(one.scaled(0.71 + 0.13 * number) for number, one in enumerate(motions * 4))),
        "scaled": sm.simulate_many(grid, suite),
        "brief": [sm.Record(one.acceleration[::5], 5.0 * one.dt, name=one.name) for one in motions],
        "table": batch,
        "hazard": hazard,
        "grid": grid,
        "limits": limit,
        "limit": limit,
        "periods": PERIODS,
        "parameters": sm.records.SyntheticParameters(0.71, 7.3, 5.3, 3.1, pulse=pulse),
        "base": Base(first, 0.19 * G, 0.61, 0.07),
        "kinds": unequal_building.kinds,
        "vertical": pair.second,
        "stiffness_matrix": np.diag(building.stiffness) * 2.3,
        "path": sm.design.pushover(building, drift_limit=0.21),
        "dead_load": [5.1e3, 4.4e3, 2.3e3],
        "live_load": [6.3e3, 5.2e3, 0.0],
    }
    stripes = {"method": "stripes", "intensities": [0.37, 0.79, 1.31, 2.3], "resamples": 20}
    design = sm.design.designed_building(found["dead_load"], found["live_load"], target, 5.3, **loads)
    drifts = np.linspace(0.0, 0.1, 40)
    classes = {
        "Animation": lambda: sm.animate(scene, first, start=0.7, end=4.3),
        "AnimationOfRacks": lambda: sm.animate(racked, first, end=3.7),
        "AnnualRate": lambda: sm.risk.annual_rate([0.05, 0.23, 0.61, 0.97], hazard),
        "Building": lambda: building,
        "Campaign": lambda: sm.campaign.Campaign(grid, [first, second], part_runs=3),
        "CodeDesign": lambda: design.design,
        "DesignedBuilding": lambda: design,
        "EffectiveMass": lambda: sm.effective_mass(scene, suite, fractions=np.linspace(0.0, 1.0, 6), resamples=20),
        "Fragility": lambda: sm.fragility.fit_counts([0.13, 0.29, 0.53], [2, 5, 9], 11, resamples=20),
        "FragilityAnalysis": lambda: sm.fragility.incremental_dynamic_analysis(scene, suite, limit, **stripes),
        "Grid": lambda: grid,
        "HazardCurve": lambda: hazard,
        "LimitState": lambda: limit,
        "LiveLoadUncertainty": lambda: sm.live_load_uncertainty(
            plain, suite, mu=sm.distributions.beta(0.31, 0.07), occupancy=0.61, samples=4, fractions=[0.0, 0.5, 1.0]
        ),
        "MatchedRecord": lambda: sm.matching.match_spectrum(
            first, target, periods=(0.3, 1.1), points=12, max_iterations=3
        ),
        "MatchedSuite": lambda: sm.matching.match_suite(
            motions[:2], target, periods=(0.3, 1.1), points=9, tolerance=0.5, max_iterations=2
        ),
        "Motion": lambda: sm.Motion(first.acceleration, first.dt, vertical=0.31 * first.acceleration),
        "OrientationScan": lambda: sm.pulses.baker2007_orientations(pair, orientations=3),
        "OwnBuilding": lambda: unequal_building,
        "Pair": lambda: pair,
        "PlaneAnimation": lambda: sm.animation.animate_plane(plane, (pair.first, pair.second), end=3.1),
        "PlaneResponse": lambda: planar,
        "PulseResult": lambda: sm.pulses.shahi_baker2014(pair),
        "Pushover": lambda: found["path"],
        "PushoverFit": lambda: sm.design.fit_pushover(drifts, 1e6 * np.tanh(drifts / 0.013) + 2.1e6 * drifts),
        "Racked": lambda: sm.simulate(racked, first, **kept),
        "Record": lambda: first,
        "Response": lambda: response,
        "RotD": lambda: sm.records.rotd(pair, PERIODS, angles=12),
        "ScalingResult": lambda: sm.scaling.scale_asce7_10(suite, target, 0.63),
        "Scene": lambda: scene,
        "SlipDemand": lambda: sm.slip.slip_demand(scene, suite, clearance=0.07, resamples=20),
        "Suite": lambda: suite,
        "TargetSpectrum": lambda: target,
    }
    return found | {"made": {name: cache(make) for name, make in classes.items()}}


BY_NAME: dict[str, Any] = {
    "acceleration": [0.0, 1.3, -0.7, 0.0],
    "added_load": [5.3e4, 4.1e4, 3.1e4],
    "agr_g": 0.31,
    "angle": 37.0,
    "area": [530.0, 470.0, 410.0],
    "attached": 0.23,
    "azimuth": 77.0,
    "base_shear": 310e3,
    "blocks": 1,
    "by": "scene",
    "c_d": 5.3,
    "capacities": [0.31, 0.47, 0.59, 0.83, 1.31],
    "capacity": "last",
    "censored_above": 1.1,
    "clearance": 0.053,
    "clearances": (sm.slip.Clearance(0.031, 0.017), None),
    "cluster_of": np.array([0, 0, 1]),
    "code_id": "ec8",
    "codes": {"one": 0.21, "other": 0.37},
    "collapsed": [False, False, True, False, False],
    "column": "peak_drift",
    "confidence": 0.83,
    "corner_period": 0.61,
    "count": 2,
    "damping": 0.07,
    "dead": [5.1e3, 4.4e3, 2.3e3],
    "deflection": 4.3,
    "degrees": np.array([0.0, 37.0, 91.0]),
    "demand": np.array([0.011, 0.017, 0.029, 0.047, 0.083]),
    "drift_limit": 0.19,
    "drifts": [0.0, 0.013, -0.007, 0.031, -0.041],
    "dt": 0.0037,
    "ductility": 3.1,
    "duration": 6.1,
    "end": 4.1,
    "energy_ratio": 0.61,
    "equipment": [310.0, 230.0, 170.0],
    "exceeded": [1, 3, 7],
    "exceeding": [1, 3, 7],
    "factor": 1.37,
    "factors": [1.3, 0.7, 0.9],
    "fault_distance_km": 7.3,
    "floor": 1,
    "floors": 2,
    "forces": [0.7, 1.1, 1.3],
    "fraction": 0.37,
    "fractions": [0.0, 0.29, 0.71, 1.0],
    "fragility": [0.05, 0.23, 0.61, 0.97],
    "height": 11.3,
    "high_hz": 11.0,
    "hunt": sm.fragility.HuntAndFill(tolerance=0.07, step=0.31, fill=2),
    "intensities": [0.41, 0.97, 1.7],
    "intensity": [0.13, 0.31, 0.67, 0.97, 1.3],
    "landscaping": [0.0, 0.0, 410.0],
    "levels": [0.11, 0.29, 0.71, 1.7],
    "live": [6.3e3, 5.2e3, 1.1e3],
    "low_hz": 0.7,
    "lowest_period": 0.23,
    "mean": 0.31,
    "deviation": 0.07,
    "median": 0.31,
    "sigma": 0.43,
    "minus": np.array([0.011, 0.037, 0.019, 0.0, 0.023]),
    "modal": [[31.0, 23.0], [-7.0, 11.0], [3.1, -2.3]],
    "model": np.array([0.7, 0.9, 1.3]),
    "most": 0.41,
    "mu_k": 0.17,
    "number": 3,
    "occupancy_id": "office, sustained",
    "other_limits": [0.021, 0.047],
    "owner": "this test",
    "p_over_h": 1.3e5,
    "pair_id": "timber-on-steel",
    "pairs": [[0, 1], [1, 2]],
    "part": 2,
    "partitions": [480.0, 530.0, 0.0],
    "parts": [0.23, sm.distributions.beta(0.31, 0.07)],
    "period": 0.61,
    "pgv_cm_s": 43.0,
    "pgv_ratio": 0.53,
    "plan": sm.plots.FloorPlan((-1.7, -2.3, 3.1, 2.9), {1: sm.plots.Footprint(0.3, 0.2)}),
    "plus": np.array([0.023, 0.013, 0.041, 0.007, 0.0]),
    "points": 7,
    "power": 0.13,
    "probability": [0.03, 0.17, 0.53, 0.97],
    "quantities": ("drift", "slip"),
    "racks": 2,
    "rate": 0.0017,
    "reduction": 3.7,
    "relative_stiffness": [1.0, 0.83, 0.61],
    "relative_strength": [1.0, 0.77, 0.53],
    "remarks": ("one", "two"),
    "risk_category": "IV",
    "roof_displacement": 0.031,
    "runs": range(1, 4),
    "s_1": 0.67,
    "s_d1": 0.71,
    "s_ds": 1.13,
    "sa_g": 0.47,
    "samples": 5,
    "seed": 7,
    "shares": np.array([0.0, 0.43, 1.0]),
    "shortest_period": 0.31,
    "sizes": sm.slip.BlockSize(0.71, 1.9),
    "sliding": np.array([0.81, 0.83, 0.79]),
    "snow": 1700.0,
    "start": 1.3,
    "storey": 2,
    "storeys": 2,
    "strength": [0.11, 0.23],
    "strike": 53.0,
    "system": "steel-moment-frame",
    "system_id": "steel-special-moment-frame",
    "text": "drift=0.023",
    "title": "a title",
    "total": 11,
    "weights": [0.31, 0.69],
    "x": "peak_drift",
    "y": "peak_base_shear",
    "years": 73.0,
    "yield_coefficient": 0.17,
    "yield_shear": [281e3, 173e3],
    "yield_shear_over_weight": [0.31, 0.17],
    "z": 0.37,
}
"""Values of arguments, for all calls: of those that have no default, and others than None."""
GIVEN: dict[str, dict[str, Any]] = {
    "animate_plane": {"scene": "flat", "motions": "both"},
    "baker2007_orientations": {"orientations": 3},
    "cloud_analysis": {"models": "small", "motions": "many", "resamples": 20},
    "code_period": {"code_id": "asce7-10", "height": 11.3},
    "combined_modes": {"periods": [0.47, 0.41, 0.13]},
    "design_by_code": {"heights": [4.3, 3.7, 3.1]},
    "effective_mass_table": {"scenes": "listed", "motions": "brief", "fractions": [0.0, 0.5, 1.0], "resamples": 20},
    "fit_pushover": {"drift": np.linspace(0.0, 0.1, 30), "shear": 1e6 * np.tanh(np.linspace(0.0, 7.7, 30))},
    "ida": {"table": "scaled", "intensity": "scale"},
    "inelastic_spectrum": {"motions": "brief", "strength": [0.11, 0.23]},
    "intensity_of": {"period": 0.61},
    "product": {"building": "small frame", "mass_ratio": [0.41, 0.83], "mu": [0.13, 0.29]},
    "sample": {"building": "small frame", "mass_ratio": 0.61, "mu": sm.distributions.beta(0.31, 0.07)},
    "scale_asce7_16": {"records": "many"},
    "scale_by_code": {"records": "many", "code_id": "ec8"},
    "scale_modal_pushover": {"building": "small frame"},
    "shahi_baker2014": {"second": "second"},
    "system_factors": {"system_id": "c1"},
    "uniform": {"storeys": 2, "period": 0.61, "mass": 2.3e4, "heights": 3.7, "yield_shear": 7.1e4},
    "asce7_multi_period": {"periods": [0.1, 0.53, 1.7], "sa_g": [0.83, 1.13, 0.31]},
    "band": {"intensity": 0.37},
    "equal_share": {"model": np.array([0.71, 0.83, 0.97])[:, None] * [1.0, 1.1, 0.9]},
    "base_shear_at": {"roof_displacement": [0.0, 0.031]},
    "energy": {"points": 20},
    "exceedance_table": {"plus": np.array([[0.023, 0.013]]), "minus": np.array([[0.011, 0.037]])},
    "exceeded": {"demand": np.array([0.011, 0.031, 0.047])},
    "fit_cloud": {"limit": 0.031, "resamples": 20},
    "fit_counts": {"intensity": [0.13, 0.31, 0.67], "resamples": 20},
    "floor_paths": {"response": "plane"},
    "fragility_fit": {"intensity": [0.13, 0.31, 0.67], "number": [7, 8, 9]},
    "intensity": {"rate": 0.0017},
    "bounded": {"distribution": sm.distributions.beta(0.31, 0.07)},
    "match_spectrum": {"periods": (0.3, 1.1), "points": 9, "max_iterations": 2},
    "parse_size": {"text": "0.7x1.9"},
    "quantile": {"probability": 0.37},
    "run_rates": {"demand": [0.011, 0.017, 0.029, 0.047], "limit": 0.023},
    "signed_peaks": {
        "slip": np.array([[0.0], [0.013], [-0.007], [0.011]]),
        "rate": np.array([[0.0], [0.31], [-0.7], [0.23]]),
        "dt": 0.1,
        "peak": np.array([0.017]),
    },
    "slope": {"sa_g": 0.47},
    "storey_checks": {"limit": 0.021},
    "wilson_interval": {"count": 3},
}
"""Of some calls, in place of those; a word of `values` stands for its value."""


def calls(place: Any) -> Iterator[tuple[str, Callable[..., Any]]]:
    """Public functions of a module, or methods of a value, with those of its views of plots."""
    for name in getattr(place, "__all__", None) or dir(place):
        if name.startswith("_") or name in LEFT_OUT.split():
            continue
        try:
            found = getattr(place, name)
        except sm.SeismassError:
            continue  # of a base that the scene has not
        if type(found).__name__.endswith("Plots"):
            yield from ((f"{name}.{each}", function) for each, function in calls(found))
        elif callable(found) and typing.get_origin(found) is not typing.Literal and not inspect.isclass(found):
            yield name, found


def words_of(function: Callable[..., Any], hint: Any) -> tuple[Any, ...]:
    """The words that an argument may be."""
    if isinstance(hint, str):
        try:
            hint = eval(hint, dict(inspect.unwrap(function).__globals__))  # as the module has it
        except NameError:
            return ()
    inner = [typing.get_args(one) for one in (hint, *typing.get_args(hint)) if typing.get_origin(one) is typing.Literal]
    return inner[0] if inner else ()


def others(function: Callable[..., Any], one: inspect.Parameter, known: dict[str, Any]) -> list[Any]:
    """Other values of an argument that is left out."""
    if one.name in FOLDERS.split():
        return []
    if words := words_of(function, one.annotation):
        return [word for word in words if word != one.default]
    if one.name in BY_NAME:
        return [BY_NAME[one.name]]
    match one.default:
        case bool():
            return [not one.default]
        case int():
            return [one.default + 1]
        case float() if np.isfinite(one.default):
            return [1.37 * one.default or 0.13]
        case (float(), float()):
            return [(1.37 * one.default[0], 1.13 * one.default[1])]
    return [known[one.name]] if one.name in known else []


def answers(name: str, function: Callable[..., Any], known: dict[str, Any]) -> Iterator[str]:
    """Yield what a call answers with its defaults, and with each argument given in turn."""
    signature = inspect.signature(function).parameters.values()
    found = [one for one in signature if one.kind in (one.POSITIONAL_OR_KEYWORD, one.KEYWORD_ONLY)]
    last = name.rpartition(".")[2]
    names = [one.name for one in found if one.default is one.empty]
    needed = {each: known[each] for each in names if each in known}
    for key, one in GIVEN.get(last, {}).items():
        needed[key] = known[one] if isinstance(one, str) and one in known else one
    assert needed.keys() >= set(names), f"{name} needs others, say them in BY_NAME: {names}"
    yield f"== {name}"
    yield from short(list(outcome(function, needed)), MOST)
    for one in found:
        for value in others(function, one, known) if one.name not in needed else []:
            said = value if isinstance(value, str | bool | int | float | tuple) else "given"
            yield f"= {one.name}: {said}"
            yield from short(list(outcome(function, needed | {one.name: value})), FIRST)


def outcome(function: Callable[..., Any], given: dict[str, Any]) -> Iterator[str]:
    """Yield the lines of an answer, of its warnings, or of a refusal."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            result = function(**given)
            yield from map(steady, value_lines(list(result) if isinstance(result, Iterator) else result))
        except sm.SeismassError as error:
            yield steady(f"refused: {error}")
    yield from (steady(f"warned: {one.message}") for one in said)


@pytest.mark.parametrize("name", [*MODULES.split(), *CLASSES.split()])
def test_a_call_answers_as_it_did(
    name: str, values: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    place = getattr(sm, name) if name in MODULES.split() else values["made"][name]()
    methods = dir(values["response"].plot) if name == "plots" else []
    lines = list(value_lines(place, "value")) if name in CLASSES.split() else []
    for each, function in calls(place):
        lines += [] if each in methods else answers(each, function, BY_NAME | values)
    compare(f"calls/{name}", steady("\n".join(lines)) + "\n")


@pytest.mark.parametrize("name", ["Animation", "AnimationOfRacks", "PlaneAnimation"])
def test_a_film_draws_what_it_did(name: str, values: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """Places, words and colours of two frames, as they are given to Pillow."""
    drawn: list[str] = []

    def recorded(kind: str) -> Callable[..., None]:
        def draw(_: Any, places: Any, *words: Any, font: Any = None, **options: Any) -> None:
            drawn.append(f"{kind} {array_text(np.array(places))} {words} {options}")

        return draw

    for kind in ("line", "polygon", "rectangle", "ellipse", "text"):
        monkeypatch.setattr(ImageDraw.ImageDraw, kind, recorded(kind))
    picture = (PlanePicture if name == "PlaneAnimation" else Picture)(values["made"][name]())
    for time in (0.0, 1.3, 2.9):
        picture.frame(time)
    compare(f"calls/film_{name}", steady("\n".join([str(picture.size), *short(drawn, 60)])) + "\n")


def test_a_record_file_is_read_as_it_was(tmp_path: Path) -> None:
    """Files of every format, made up by its rules: motions and labels, or the refusal."""
    lines = []
    made = dict(runpy.run_path(str(Path(__file__).parents[1] / "tools" / "record_files.py"))["files"]())
    made["agency.V2"] = made["made.V2"].replace(b"NOWHERE" + 35 * b" " + b"CGS", b"NOWHERE")
    assert made["agency.V2"] != made["made.V2"]
    for name, content in made.items():
        (tmp_path / name).write_bytes(content)
        for read, options, most in ((sm.read_records, {}, MOST), (sm.read_record, {"unit": "g"}, FIRST)):
            found = [line.replace(str(tmp_path), "") for line in outcome(read, {"path": tmp_path / name, **options})]
            lines += [f"== {name} {options or ''}", *short(found, most)]
    compare("calls/record_files", steady("\n".join(lines)) + "\n")
