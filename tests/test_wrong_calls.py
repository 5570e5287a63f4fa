"""Wrong values in place of each argument of each public call: the package's own errors, or a result, and nothing else.

Calls are generated: of a call that works for each callable of `CALLS`, every parameter of its signature is replaced in
turn by each of `WRONG`. Callables that are not in `CALLS` are named in `LEFT_OUT` with the reason. The second list is
made from the names alone: every function of every public module, and every public method of one value of each class
that has methods with arguments, plots among them.
"""

from __future__ import annotations

import inspect
import warnings
from collections.abc import Callable, Iterator
from contextlib import nullcontext
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm

WRONG: dict[str, Any] = {
    "None": None,
    "text": "a",
    "empty text": "",
    "NaN": float("nan"),
    "infinity": float("inf"),
    "minus one": -1,
    "huge": 10**400,
    "tiny": 1e-320,
    "complex": 1j,
    "true": True,
    "bytes": b"a",
    "list": [],
    "nested": [[1.0], [2.0, 3.0]],
    "texts": ["a", "b"],
    "dict": {"a": 1},
    "array": np.array([1.0, 2.0, np.nan]),
    "table": np.ones((2, 3)),
    "objects": np.array([None, "a"], dtype=object),
    "object": object(),
    "function": lambda *_: None,
    "class": int,
}

RESULTS = """
    Animation AnnualRate Assessment CampaignProgress CodeFraction EffectiveMass
    EffectiveMassMap FirstModeOscillator FrictionPair GridAxis InelasticSpectrum FragilityAnalysis
    LiveLoadUncertainty MatchedRecord MatchedSuite OrientationScan OwnBuilding Pairs
    PulseResult PushoverScaling Response RiskTargetedShare RotD SceneFile
    Selection ScalingResult SlipDemand SpringPath
"""
TYPES = "Base Candidate CatalogueSearch Distribution Excluded FoundFile Fragility GroundMotion Kind Misfit Use"
SEE = "see tests/test_racks_walls_stops.py"
PARTS = """
    as_motions asce43 compared_models corner_period example_description exceedance_table intensity_of newmark_bound
    newmark_pulse parse_limit parse_size pulse_indicator_2007 pulse_indicator_2014 signed_peaks solve_grid
    wilson_interval
"""
LEFT_OUT: dict[str, str] = {
    **dict.fromkeys(("Rack", "RackBlock", "Stops"), SEE),
    "SlidingBase": "see tests/test_sliding_base.py",
    **dict.fromkeys(("SceneProduct", "PlaneResponse"), "see tests/test_scene_product.py and tests/test_plane.py"),
    "write_opensees": "see tests/test_opensees_export.py",
    "read_counts": "needs ObsPy: see tests/test_record_counts.py",
    **dict.fromkeys(TYPES.split(), "a type or a part of a result"),
    **dict.fromkeys(PARTS.split(), "a step of a public call, which has checked what it is given"),
    **dict.fromkeys(("HuntAndFill", "IntensityMeasure", "multiple_stripes", "cloud_analysis"), "see its own tests"),
    **dict.fromkeys(("fit_capacities", "fit_cloud", "fit_counts"), "see its own tests"),
    **dict.fromkeys(RESULTS.split(), "a result, made by the package"),
    **dict.fromkeys(("builtin_pairs", "catalogue", "code_legend", "code_table", "instruction_set"), "takes nothing"),
    "EffectiveMassParameters": "see effective_mass_map",
    "NearFaultPulse": "see synthetic_motion",
    "SyntheticParameters": "see synthetic_motion",
    "baker2007_orientations": "as baker2007, 36 times as long",
    "effective_mass_map": "dozens of buildings",
    "effective_mass_of_design": "as effective_mass, of a function",
    "match_suite": "as match_spectrum",
    "risk_targeted_share": "as incremental_dynamic_analysis, some seconds",
    "synthetic_motion": "of SyntheticParameters",
    "write_many": "as stream_many",
}

GROUPS = [
    "records",
    "spectra",
    "scaling",
    "matching",
    "pulses",
    "fragility",
    "risk",
    "slip",
    "campaign",
    "codes",
    "friction",
    "distributions",
    "runs",
]

BUILDING = sm.Building.uniform(2, 0.3, heights=3.0, yield_shear_over_weight=[0.2, 0.12])
SCENE = sm.Scene(BUILDING, [sm.Block(1, mass_ratio=0.5, mu=0.2)])
MOTION = sm.Motion([2.0, -2.0, 2.0, 0.0], dt=0.1)
RECORD = sm.Record(np.sin(np.arange(40)), 0.02, name="a", event="e", component="000")
OTHER = sm.Record(np.cos(np.arange(40)), 0.02, name="b", event="f", component="090")
PAIR = sm.Pair(RECORD, OTHER)
SUITE = sm.Suite("s", (RECORD, OTHER, RECORD.scaled(0.5)))
TARGET = sm.TargetSpectrum.asce7()
RESPONSE = sm.simulate(SCENE, MOTION, histories=True, energy=True)
GRID = sm.Grid.product(BUILDING, mass_ratio=[0.5, 1.0], mu=[0.1, 0.2])
CAMPAIGN = sm.campaign.Campaign(GRID, MOTION, part_runs=3)
BATCH = sm.simulate_many(SCENE, MOTION)
LIMIT = sm.fragility.LimitState("drift", 0.02)
MISSING = "missing.toml"
HAZARD = sm.risk.HazardCurve([0.1, 0.5, 1.0], [0.01, 1e-3, 1e-4])
BLOCKS = [sm.Block(1, mass_ratio=0.5, mu=0.2)]
MANY = sm.Suite("many", tuple(RECORD.scaled(1.0 + 0.1 * number) for number in range(11)))
SMALL: dict[str, Any] = {"resamples": 10, "fractions": [0.0, 0.5, 1.0]}

CALLS: dict[str, tuple[Callable[..., Any], dict[str, Any]]] = {
    "Motion": (sm.Motion, {"acceleration": [0.0, 1.0], "dt": 0.1, "vertical": [0.0, 1.0]}),
    "Motion.scaled": (MOTION.scaled, {"factor": 2.0}),
    "Motion.with_duration": (MOTION.with_duration, {"duration": 0.2}),
    "Rayleigh": (sm.Rayleigh, {"ratio": 0.05, "modes": (1, 2)}),
    "Block": (sm.Block, {"floor": 1, "mass": 1.0, "mu_s": 0.3, "mu_k": 0.2, "velocity": 0.1}),
    "Block of mass ratio": (sm.Block, {"floor": 1, "mass_ratio": 1.0, "mu": 0.3}),
    "blocks_on_floors": (sm.blocks_on_floors, {"mass_ratio": [0.5, 0.2], "mu": 0.2}),
    "Building": (sm.Building, {"mass": [1.0, 1.0], "stiffness": [50.0, 50.0], "yield_shear": [1.0, 1.0]}),
    "Building.uniform": (
        sm.Building.uniform,
        {"storeys": 2, "period": 0.3, "yield_shear_over_weight": 0.2, "heights": 3.0},
    ),
    "Scene": (sm.Scene, {"building": BUILDING, "blocks": BLOCKS, "collapse_drift": 0.1}),
    "attached_scene": (sm.attached_scene, {"scene": SCENE, "fraction": 0.5}),
    "simulate": (sm.simulate, {"scene": SCENE, "motion": MOTION}),
    "simulate_many": (sm.simulate_many, {"scenes": SCENE, "motions": MOTION}),
    "stream_many": (sm.stream_many, {"scenes": SCENE, "motions": MOTION}),
    "digits": (sm.runs.digits, {"response": RESPONSE}),
    "digits_of_batch": (sm.runs.digits_of_batch, {"scenes": [SCENE], "motions": [MOTION]}),
    "history_table": (sm.runs.history_table, {"response": RESPONSE}),
    "long_table": (sm.long_table, {"table": BATCH, "scenes": SCENE}),
    "spring_forces": (sm.runs.spring_forces, {"building": BUILDING, "storey": 1, "drifts": [0.0, 0.01, -0.01]}),
    "Record": (sm.Record, {"acceleration": [0.0, 1.0], "dt": 0.01, "name": "a", "azimuth": 10.0}),
    "Record.scaled": (RECORD.scaled, {"factor": 2.0}),
    "Record.with_duration": (RECORD.with_duration, {"duration": 0.2}),
    "Record.resampled": (RECORD.resampled, {"dt": 0.01}),
    "Record.baseline_corrected": (RECORD.baseline_corrected, {}),
    "Record.band_passed": (RECORD.band_passed, {"low_hz": 1.0, "high_hz": 10.0}),
    "Record.with_vertical": (RECORD.with_vertical, {"vertical": OTHER}),
    "Suite": (sm.Suite, {"name": "s", "records": (RECORD,)}),
    "Pair": (sm.Pair, {"first": RECORD, "second": OTHER}),
    "rotd": (sm.records.rotd, {"pair": PAIR, "periods": [0.5]}),
    "builtin_suite": (sm.builtin_suite, {}),
    "builtin_record": (sm.builtin_record, {"name": "synthetic-1"}),
    "intensity_table": (sm.records.intensity_table, {"records": SUITE}),
    "read_record": (sm.read_record, {"path": MISSING}),
    "read_records": (sm.read_records, {"path": MISSING}),
    "read_suite": (sm.read_suite, {"path": MISSING}),
    "read_pair": (sm.read_pair, {"first": MISSING, "second": MISSING}),
    "read_scene": (sm.read_scene, {"path": MISSING}),
    "read_building": (sm.read_building, {"source": MISSING}),
    "read_campaign": (sm.campaign.read_campaign, {"source": MISSING}),
    "find_pairs": (sm.records.find_pairs, {"folder": MISSING}),
    "find_catalogue": (sm.records.find_catalogue, {"folder": MISSING}),
    "CampaignFolder": (sm.campaign.CampaignFolder, {"path": MISSING}),
    "TargetSpectrum.asce7": (sm.TargetSpectrum.asce7, {}),
    "TargetSpectrum.eurocode8": (sm.TargetSpectrum.eurocode8, {"agr_g": 0.3}),
    "TargetSpectrum.nzs1170": (sm.TargetSpectrum.nzs1170, {"z": 0.3}),
    "TargetSpectrum.from_csv": (sm.TargetSpectrum.from_csv, {"path": MISSING}),
    "TargetSpectrum.mean_of": (sm.TargetSpectrum.mean_of, {"records": SUITE}),
    "TargetSpectrum": (TARGET, {"periods": [0.5, 1.0]}),
    "TargetSpectrum.tilted": (TARGET.tilted, {"power": 0.1}),
    "response_spectrum": (sm.response_spectrum, {"motions": RECORD, "periods": [0.5]}),
    "mean_spectrum": (sm.spectra.mean_spectrum, {"motions": SUITE, "factors": [1.0, 1.0, 1.0], "periods": [0.5]}),
    "inelastic_spectrum": (sm.spectra.inelastic_spectrum, {"motions": RECORD, "periods": [0.5], "strength": [0.1]}),
    "scale_asce7_10": (sm.scaling.scale_asce7_10, {"records": SUITE, "target": TARGET, "period": 0.5}),
    "scale_by_code": (sm.scaling.scale_by_code, {"records": MANY, "target": TARGET, "period": 0.5, "code_id": "ec8"}),
    "scale_asce7_16": (sm.scaling.scale_asce7_16, {"records": MANY, "target": TARGET, "period": 0.5}),
    "scale_sa_t1": (sm.scaling.scale_sa_t1, {"records": SUITE, "target": TARGET, "period": 0.5}),
    "scale_least_squares": (sm.scaling.scale_least_squares, {"records": SUITE, "target": TARGET, "period": 0.5}),
    "scale_modal_pushover": (
        sm.scaling.scale_modal_pushover,
        {"records": SUITE, "target": TARGET, "period": 0.5, "yield_coefficient": 0.2},
    ),
    "select_records": (
        sm.scaling.select_records,
        {
            "suite": MANY,
            "target": TARGET,
            "count": 2,
            "max_per_event": None,
            "max_per_station": None,
            "factor_range": None,
        },
    ),
    "first_mode_oscillator": (sm.scaling.first_mode_oscillator, {"building": BUILDING}),
    "Grid": (sm.Grid, {"building": [BUILDING], "mass_ratio": [0.5, 1.0], "mu": [0.1, 0.2]}),
    "Grid.product": (sm.Grid.product, {"building": BUILDING, "mass_ratio": [0.5, 1.0], "mu": [0.1, 0.2]}),
    "Grid.sample": (sm.Grid.sample, {"building": BUILDING, "samples": 4, "mu": [0.1, 0.2], "mass_ratio": 1.0}),
    "Grid.sample nested": (sm.Grid.sample, {"building": BUILDING, "samples": (2, 2, 1), "mu": 0.1, "mass_ratio": 1.0}),
    "Grid.scene": (GRID.scene, {"number": 1}),
    "Grid.table": (GRID.table, {}),
    "StrengthDesign": (sm.runs.StrengthDesign, {"target": TARGET}),
    "Campaign": (sm.campaign.Campaign, {"grid": GRID, "motions": MOTION}),
    "Campaign.solve": (CAMPAIGN.solve, {"part": 1}),
    "Campaign.runs_of": (CAMPAIGN.runs_of, {"part": 1}),
    "code_fraction": (sm.codes.code_fraction, {"code_id": "asce7-10"}),
    "friction_pair": (sm.friction.friction_pair, {"pair_id": "timber-on-steel"}),
    "friction_table": (sm.friction.friction_table, {}),
    "surveyed_load": (sm.occupancy.surveyed_load, {"occupancy_id": "office, sustained"}),
    "SurveyedLoad.deviation": (sm.occupancy.surveyed_load("office, sustained").deviation, {"area": 100.0}),
    "on_surveyed_goods": (sm.occupancy.on_surveyed_goods, {"fraction": 0.25, "use": "storage"}),
    "lognormal": (sm.distributions.lognormal, {"median": 0.3, "sigma": 0.2}),
    "beta": (sm.distributions.beta, {"mean": 0.3, "deviation": 0.1}),
    "gamma": (sm.distributions.gamma, {"mean": 0.3, "deviation": 0.1}),
    "bounded": (sm.distributions.bounded, {"distribution": sm.distributions.beta(0.3, 0.1), "most": 0.4}),
    "mixture": (sm.distributions.mixture, {"parts": [0.2, sm.distributions.beta(0.3, 0.1)], "weights": [0.3, 0.7]}),
    "stripe_rates": (sm.risk.stripe_rates, {"levels": [0.2, 0.4], "probability": [0.1, 0.5], "hazard": HAZARD}),
    "run_rates": (sm.risk.run_rates, {"levels": [0.2, 0.4], "demand": [0.1, 0.5], "limit": 0.2, "hazard": HAZARD}),
    "stripe_weights": (sm.risk.stripe_weights, {"levels": [0.2, 0.4], "hazard": HAZARD}),
    "effective_mass": (sm.effective_mass, {"scene": SCENE, "motions": SUITE, **SMALL}),
    "live_load_uncertainty": (
        sm.live_load_uncertainty,
        {"scene": SCENE, "motions": SUITE, "mu": 0.3, "occupancy": 0.5, "samples": 2, "fractions": [0.0, 1.0]},
    ),
    "incremental_dynamic_analysis": (
        sm.fragility.incremental_dynamic_analysis,
        {"models": SCENE, "motions": SUITE, "limits": LIMIT, "method": "stripes", "intensities": [1.0], "resamples": 2},
    ),
    "LimitState": (sm.fragility.LimitState, {"quantity": "drift", "value": 0.02}),
    "HazardCurve": (sm.risk.HazardCurve, {"sa_g": [0.1, 0.5, 1.0], "rate": [0.01, 1e-3, 1e-4]}),
    "HazardCurve.rate": (HAZARD.rate, {"sa_g": 0.2}),
    "HazardCurve.probability": (HAZARD.probability, {"sa_g": 0.2, "years": 50.0}),
    "annual_rate": (sm.risk.annual_rate, {"fragility": [0.2, 0.3, 0.4], "hazard": HAZARD}),
    "BlockSize": (sm.slip.BlockSize, {"width": 1.0, "height": 1.0}),
    "BlockSize.rocks_first": (sm.slip.BlockSize(1.0, 1.0).rocks_first, {"mu_s": 0.3}),
    "Clearance": (sm.slip.Clearance, {"plus": 0.1}),
    "slip_demand": (sm.slip.slip_demand, {"scene": SCENE, "motions": SUITE, "resamples": 2}),
    "match_spectrum": (sm.matching.match_spectrum, {"record": RECORD, "target": TARGET, "max_iterations": 1}),
    "baker2007": (sm.pulses.baker2007, {"record": RECORD}),
    "shahi_baker2014": (sm.pulses.shahi_baker2014, {"first": RECORD, "second": OTHER}),
    "animate": (sm.animate, {"scene": SCENE, "motion": MOTION}),
    "assess": (sm.assess, {"building": MISSING}),
}


def parameters_of(name: str) -> list[str]:
    """Names of the parameters of a call, and of those that it takes by `**`."""
    function, base = CALLS[name]
    found = inspect.signature(function).parameters.values()
    named = [one.name for one in found if one.kind in (one.POSITIONAL_OR_KEYWORD, one.KEYWORD_ONLY)]
    return list(dict.fromkeys([*named, *base]))


@pytest.fixture(autouse=True)
def an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where paths lead that are not meant as such."""
    monkeypatch.chdir(tmp_path)


def call(name: str, /, **changes: Any) -> None:
    function, base = CALLS[name]
    result = function(**base | changes)
    if isinstance(result, Iterator):
        list(result)


@pytest.mark.parametrize("name", CALLS)
def test_a_wrong_value_ends_in_an_error_of_the_package(name: str) -> None:
    missing = MISSING in [value for value in CALLS[name][1].values() if isinstance(value, str)]
    with pytest.raises((sm.SeismassError, OSError)) if missing else nullcontext():
        call(name)  # the call to which the changes are made is right
    for parameter in parameters_of(name):
        for kind, wrong in WRONG.items():
            if parameter == "progress" and callable(wrong):
                continue  # what the caller's own function raises is the caller's
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                try:
                    call(name, **{parameter: wrong})
                except (sm.SeismassError, OSError) as error:
                    assert len(str(error)) < 2000, (parameter, kind)
                except Exception as error:
                    raise AssertionError(f"{name}({parameter}={kind}) raised {error!r}") from error


def test_every_public_callable_is_called() -> None:
    places = [sm, *(getattr(sm, name) for name in GROUPS)]
    public = {name for place in places for name in place.__all__ if callable(getattr(place, name))}
    errors = {name for name in public if name.startswith("Invalid") or name.endswith(("Error", "Package"))}
    called = {name.partition(".")[0].partition(" ")[0] for name in CALLS}
    assert public - errors - called == set(LEFT_OUT)


def test_masses_that_no_double_can_relate_are_refused() -> None:
    with pytest.raises(sm.errors.InvalidScene, match="mass of building must be in a ratio to the stiffnesses"):
        sm.design.vibration_modes([1e-300, 1e6], [1e9, 1e9])


MODULES = [*GROUPS, "plots", "design", "occupancy", "evidence", "animation", "explore", "study", "validation"]
WRONG_HERE = {**WRONG, "array without an axis": np.array(3.0), "three": 3, "zero": 0}
BY_NAME: dict[str, Any] = {
    "response": RESPONSE,
    "scene": SCENE,
    "scenes": SCENE,
    "building": BUILDING,
    "motion": MOTION,
    "motions": SUITE,
    "record": RECORD,
    "records": SUITE,
    "suite": SUITE,
    "target": TARGET,
    "period": 0.5,
    "periods": [0.5, 1.0],
    "batch": BATCH,
    "table": BATCH,
    "pair": PAIR,
    "first": RECORD,
    "second": OTHER,
    "hazard": HAZARD,
    "grid": GRID,
    "limits": LIMIT,
    "models": SCENE,
    "years": 50.0,
    "mu": 0.3,
    "mass": [1e3, 1e3],
    "stiffness": [1e6, 1e6],
    "storeys": 2,
    "dt": 0.01,
    "acceleration": [0.0, 1.0, 0.0],
    "fraction": 0.5,
    "name": "a",
    "sa_g": 0.2,
    "factor": 1.0,
    "path": "x.csv",
    "folder": "out",
    "weight": [1e4, 1e4],
    "heights": [3.0, 3.0],
}
"""What stands for an argument without a default, by its name; 0.5 for others."""
LONG = """
match_suite effective_mass_map effective_mass_of_design risk_targeted_share live_load_uncertainty write_many
multiple_stripes cloud_analysis incremental_dynamic_analysis slip_demand effective_mass assess isolate
baker2007_orientations animate write synthetic_motion builtin_suite builtin_pairs catalogue
"""
"""What takes seconds where it is not refused: called in tests/test_wrong_calls.py or in tests of their own."""
STOPPED = "evidence run_study study_sensitivity validate paper_scenes section4 effective_mass_table"
"""What would take seconds, and ends where it first tells of its progress: what is wrong is refused before."""
LITERALS = ("Combination", "DampingBase", "FloorUse", "Kind", "Model", "Pattern", "Station", "Use", "Verdict")
"""Types of arguments, which are not called."""
MADE = (*RESULTS.split(), *TYPES.split(), "PlaneResponse")
"""Classes whose values the package makes."""


@cache
def values() -> dict[str, Any]:
    """A value of each class that has methods with arguments."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        intensities = {"method": "stripes", "intensities": [0.5, 1.0, 2.0], "resamples": 2}
        return {
            "Response": RESPONSE,
            "Scene": SCENE,
            "Building": BUILDING,
            "Motion": MOTION,
            "Record": RECORD,
            "Pair": PAIR,
            "TargetSpectrum": TARGET,
            "Grid": GRID,
            "Campaign": CAMPAIGN,
            "HazardCurve": HAZARD,
            "LimitState": LIMIT,
            "EffectiveMass": sm.effective_mass(SCENE, SUITE, **SMALL),
            "SlipDemand": sm.slip.slip_demand(SCENE, SUITE, resamples=2),
            "ScalingResult": sm.scaling.scale_sa_t1(SUITE, TARGET, 0.5),
            "MatchedRecord": sm.matching.match_spectrum(RECORD, TARGET, max_iterations=1),
            "FragilityAnalysis": sm.fragility.incremental_dynamic_analysis(SCENE, SUITE, LIMIT, **intensities),
            "AnnualRate": sm.risk.annual_rate([0.2, 0.3, 0.4], HAZARD),
            "FrictionPair": sm.friction.friction_pair("timber-on-steel"),
        }


def stopped(*_: int) -> None:
    raise sm.SeismassError("stopped")


def methods(value: Any) -> Iterator[tuple[str, Callable[..., Any]]]:
    """Public functions of a module or a value, with those of its views of plots."""
    for name in getattr(value, "__all__", None) or dir(value):
        if name.startswith("_") or name in LITERALS or (inspect.ismodule(value) and name in MADE):
            continue
        try:
            attribute = getattr(value, name)
        except sm.SeismassError:
            continue  # of a base that the scene has not
        if callable(attribute):
            yield name, attribute
        elif type(attribute).__name__.endswith("Plots") or name == "plot":
            yield from ((f"{name}.{each}", function) for each, function in methods(attribute))


def arguments(name: str, function: Callable[..., Any]) -> tuple[list[str], dict[str, Any]]:
    """Names of the arguments of a function, and those that it needs."""
    kinds = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
    found = [one for one in inspect.signature(function).parameters.values() if one.kind in kinds]
    needed = {one.name: BY_NAME.get(one.name, 0.5) for one in found if one.default is one.empty}
    known = CALLS.get(name, (None, {}))[1]
    if name in STOPPED.split():
        needed["progress"] = stopped
    return [one.name for one in found], needed | {one.name: known[one.name] for one in found if one.name in known}


def foreign(function: Callable[..., Any], given: dict[str, Any]) -> str:
    """What another exception a call ends in; empty where it ends in a result or in an error of the package."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            result = function(**given)
            if isinstance(result, Iterator):
                next(result, None)
        except (sm.SeismassError, OSError):
            return ""
        except Exception as error:
            return repr(error)[:200]
    return ""


CLASSES = """
AnnualRate Building Campaign EffectiveMass FragilityAnalysis FrictionPair Grid HazardCurve LimitState
MatchedRecord Motion Pair Record Response ScalingResult Scene SlipDemand TargetSpectrum
"""


@pytest.mark.parametrize("place", ["seismass", *MODULES, *CLASSES.split()])
def test_a_wrong_value_of_whatever_a_name_leads_to_ends_in_an_error_of_the_package(place: str) -> None:
    value = sm if place == "seismass" else getattr(sm, place) if place in MODULES else values()[place]
    found: dict[str, str] = {}
    number = 0
    for name, function in methods(value):
        last = name.rpartition(".")[2]
        if last in LONG.split() or (inspect.isclass(function) and issubclass(function, BaseException)):
            continue
        try:
            names, needed = arguments(last, function)
        except (TypeError, ValueError):
            continue  # a type without a signature
        for argument in names:
            for kind, wrong in WRONG_HERE.items():
                if argument in ("progress", "change", "spectrum", "design", "target") and callable(wrong):
                    continue  # what the caller's own function raises is the caller's
                if last in STOPPED.split() and argument == "progress" and wrong is None:
                    continue  # runs to its end
                number += 1
                said = foreign(function, needed | {argument: wrong})
                if said:
                    found.setdefault(f"{name}({argument}={kind})", said)
    assert found == {}
    assert number > 0


def test_every_class_with_a_value_is_looked_at() -> None:
    assert sorted(values()) == sorted(CLASSES.split())
