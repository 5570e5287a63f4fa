"""Values: not to be changed after they were made, and equal after pickling."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass.assessment.building_file import example_file

BUILDING = sm.Building.uniform(2, 0.3, heights=[3.4, 2.7], yield_shear_over_weight=[0.2, 0.12])
SCENE = sm.Scene(BUILDING, [sm.Block(1, mass_ratio=0.5, mu=0.2)])
MOTION = sm.Motion([2.0, -2.0, 2.0, 0.0], dt=0.1, vertical=[0.0, 1.0, 0.0, -1.0])
SUITE = sm.builtin_suite("seven")
TWO = sm.Suite("two", SUITE.records[:2])
TARGET = sm.TargetSpectrum.asce7()
GRID = sm.Grid.product(BUILDING, mass_ratio=[0.5, 1.0], mu=[0.1, 0.2], scale=[1.0, 2.0])
HAZARD = sm.risk.HazardCurve([0.1, 0.5, 1.0], [0.01, 1e-3, 1e-4])
FEW: dict[str, Any] = {"resamples": 2}

MADE: dict[str, Callable[[], Any]] = {
    "Building": lambda: BUILDING,
    "Scene": lambda: SCENE,
    "Motion": lambda: MOTION,
    "Record": lambda: SUITE[0],
    "Suite": lambda: SUITE,
    "TargetSpectrum": lambda: TARGET,
    "mean of a suite": lambda: sm.TargetSpectrum.mean_of(TWO),
    "Grid": lambda: GRID,
    "GridAxis": lambda: GRID.axes()[-1],
    "sample": lambda: sm.Grid.sample(BUILDING, samples=4, mass_ratio=1.0, mu=sm.distributions.lognormal(0.3, 0.2)),
    "StrengthDesign": lambda: sm.runs.StrengthDesign(TARGET),
    "Campaign": lambda: sm.campaign.Campaign(GRID, MOTION),
    "Animation": lambda: sm.animate(SCENE, MOTION),
    "SpringPath": lambda: sm.runs.spring_forces(BUILDING, 1, [0.0, 0.01]),
    "ScalingResult": lambda: sm.scaling.scale_asce7_10(SUITE, TARGET, 0.5),
    "PushoverScaling": lambda: sm.scaling.scale_modal_pushover(TWO, TARGET, period=0.5, yield_coefficient=0.2),
    "Selection": lambda: sm.scaling.select_records(
        SUITE, TARGET, 2, max_per_event=None, max_per_station=None, factor_range=None
    ),
    "EffectiveMass": lambda: sm.effective_mass(SCENE, TWO, fractions=[0.0, 0.5, 1.0], **FEW),
    "LiveLoadUncertainty": lambda: sm.live_load_uncertainty(
        SCENE, TWO, mu=0.3, occupancy=0.5, samples=2, fractions=[0.0, 1.0]
    ),
    "MatchedRecord": lambda: sm.matching.match_spectrum(SUITE[0], TARGET, max_iterations=1, tolerance=0.9),
    "MatchedSuite": lambda: sm.matching.match_suite(TWO, TARGET, max_iterations=1, tolerance=0.9),
    "InelasticSpectrum": lambda: sm.spectra.inelastic_spectrum(SUITE[0], [0.5], strength=[0.1]),
    "SlipDemand": lambda: sm.slip.slip_demand(SCENE, TWO, **FEW),
    "HazardCurve": lambda: HAZARD,
    "AnnualRate": lambda: sm.risk.annual_rate([0.2, 0.3, 0.4], HAZARD),
    "FragilityAnalysis": lambda: sm.fragility.incremental_dynamic_analysis(
        SCENE, TWO, sm.fragility.LimitState("drift", 0.02), method="stripes", intensities=[1.0], **FEW
    ),
    "PulseResult": lambda: sm.pulses.baker2007(SUITE[0]),
    "FirstModeOscillator": lambda: sm.scaling.first_mode_oscillator(BUILDING),
    "Modes": lambda: sm.design.vibration_modes([1.0, 1.0], [50.0, 50.0]),
    "OwnBuilding": lambda: sm.read_building(example_file()),
    "Assessment": lambda: sm.assess(example_file(), mu_factors=(1.0, 1.0), **FEW),
}


@pytest.mark.parametrize("name", MADE)
def test_values_are_equal_after_pickling_and_copying(name: str) -> None:
    value = MADE[name]()
    copies = [pickle.loads(pickle.dumps(value, protocol)) for protocol in range(pickle.HIGHEST_PROTOCOL + 1)]
    for other in (*copies, copy.copy(value), copy.deepcopy(value)):
        assert other == value
        assert hash(other) == hash(value)
    assert value != object()


def test_results_of_other_numbers_differ() -> None:
    result = MADE["EffectiveMass"]()
    assert result != sm.effective_mass(SCENE, TWO, fractions=[0.0, 0.6, 1.0], **FEW)
    assert sm.Grid.product(BUILDING, mass_ratio=[0.5, 1.0], mu=[0.1, 0.2], scale=[1.0, 2.5]) != GRID
    assert sm.campaign.Campaign(GRID, MOTION) != sm.campaign.Campaign(GRID, MOTION.scaled(2.0))
    assert sm.campaign.Campaign(GRID, MOTION) != sm.campaign.Campaign(GRID, MOTION, part_runs=3)
    one, other = (sm.scaling.scale_asce7_10(SUITE, TARGET, period) for period in (0.5, 0.6))
    assert one != other


@pytest.mark.parametrize(
    "array",
    [
        MOTION.acceleration,
        MOTION.vertical,
        MOTION.time,
        BUILDING.mass,
        BUILDING.yield_shear,
        SUITE[0].acceleration,
        SUITE[0].velocity,
        HAZARD.sa_g,
        GRID.axes()[-1].columns["scale"],
        sm.simulate(SCENE, MOTION).peak_drift,
        sm.simulate(SCENE, MOTION).event_log["time"],
        pickle.loads(pickle.dumps(sm.simulate(SCENE, MOTION))).peak_drift,
    ],
)
def test_arrays_of_values_cannot_be_made_writeable(array: np.ndarray[Any, Any]) -> None:
    with pytest.raises(ValueError, match="read-only"):
        array[0] = 1.0
    with pytest.raises(ValueError, match="WRITEABLE"):
        array.setflags(write=True)


def test_dicts_that_are_given_back_are_copies(tmp_path: Any) -> None:
    campaign = sm.campaign.Campaign(GRID, MOTION, part_runs=3)
    before = campaign.sha256
    campaign.document["single"] = True
    campaign.document["grid"]["axes"] = []
    assert campaign.sha256 == sm.campaign.Campaign(GRID, MOTION, part_runs=3).sha256 == before
    folder = campaign.run(tmp_path / "a")
    folder.manifest["parts"] = 0
    folder.manifest["grid"]["axes"].clear()
    assert folder.parts == campaign.parts
    assert folder.scan().collect().height == campaign.total
    BUILDING.springs["stiffness"] = BUILDING.mass
    assert BUILDING.springs["stiffness"] is BUILDING.stiffness
