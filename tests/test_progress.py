"""Progress of every public call that has it: it never goes back, ends with all done, and its stages make the whole.

Calls are found by their names, and one that is new needs a case here. As no call is told of more than all, a stage that
is counted wrongly would not be seen in what is told: each is held against its own count.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import seismass as sm
from seismass.base.arguments import Progress
from seismass.studies.campaign.manifest import part_path
from seismass.studies.evidence import read_archetypes
from seismass.studies.study import StudyParameters

ARCHETYPES, WHOLE = read_archetypes()
SETTING = replace(WHOLE, samples=(2, 3), levels=(1.0, 1.5), shares=(0.0, 0.5, 1.0))
FEW: dict[str, Any] = {"fractions": [0.0, 0.4, 0.7, 1.0], "resamples": 2}
TARGET = sm.TargetSpectrum.asce7(1.13, 0.71)
HAZARD = sm.risk.HazardCurve([0.05, 0.31, 1.07, 4.1], [0.053, 0.0023, 0.00013, 1.1e-6], period=0.53, label="site")
LIMIT = sm.fragility.LimitState("drift_ratio", 0.013)
TWO_STOREYS = Path(__file__).parent / "data" / "two_storeys.json"
SPRINGS = ((1e5, 20),)
STUDY = StudyParameters(
    buildings=((2, 0.38), (3, 0.47)), response_modification=(4.0,), mass_ratios=(1.0,), occupancies=(("storage", 0.25),)
)
MAP = sm.EffectiveMassParameters(
    buildings=((2, 0.38, "bare"),), mass_ratios=(1.0,), response_modification=(4.0,), mus=(0.1, 0.2), shares=5
)


@pytest.fixture(scope="module")
def suite(unequal_motions: tuple[sm.Record, ...]) -> sm.Suite:
    """Three short motions."""
    return sm.Suite("bursts", unequal_motions)


def building(storeys: int, strength: float = 0.23) -> sm.Building:
    """So many storeys."""
    return sm.Building.uniform(storeys, 0.2 + 0.1 * storeys, heights=3.7, yield_shear_over_weight=strength)


def goods(storeys: int, mu: float = 0.13) -> sm.Scene:
    """So many storeys with goods that slide."""
    return sm.Scene(building(storeys), sm.blocks_on_floors([0.71] * storeys, mu=mu))


def on_rack() -> sm.Scene:
    """A building whose models go on beyond a share of 1, as a rack stands in it."""
    rack = sm.Rack(1, levels=1, level_mass_ratio=0.07, period=0.53, blocks=[sm.RackBlock(1, mass_ratio=0.29, mu=0.19)])
    return sm.Scene(building(1), racks=[rack])


def campaign(suite: sm.Suite) -> sm.campaign.Campaign:
    """Twelve runs in three parts."""
    grid = sm.Grid.product(building(1), mass_ratio=[0.41, 0.83], mu=[0.13, 0.29])
    return sm.campaign.Campaign(grid, suite, part_runs=5)


def broken(suite: sm.Suite, place: Path) -> sm.campaign.CampaignFolder:
    """A folder of that campaign without its second part."""
    campaign(suite).run(place)
    part_path(place, 2).unlink()
    return sm.campaign.CampaignFolder(place)


def public(place: Any) -> set[str]:
    """Public functions and methods that take `progress`."""
    found = set()
    for name in place.__all__ if isinstance(place, ModuleType) else dir(place):
        one = None if name.startswith("_") else getattr(place, name)
        if (isinstance(one, ModuleType) and place is sm) or (isinstance(one, type) and isinstance(place, ModuleType)):
            found |= public(one)
        elif inspect.isfunction(one) and "progress" in inspect.signature(one).parameters:
            found.add(one.__qualname__)
    return found


CASES: dict[str, Callable[[dict[str, Any], sm.Suite, Path], object]] = {
    "Campaign.run": lambda how, suite, place: campaign(suite).run(place / "out", **how),
    "CampaignFolder.run": lambda how, suite, place: broken(suite, place / "out").run(**how),
    "CampaignRuns.solve": lambda how, suite, _: campaign(suite).solve(2, **how),
    "CampaignRuns.solve_runs": lambda how, suite, _: campaign(suite).solve_runs(range(2, 7), **how),
    "assess": lambda how, suite, _: sm.assess(TWO_STOREYS, suite, resamples=2, **how),
    "cloud_analysis": lambda how, suite, _: sm.fragility.cloud_analysis(goods(1), suite, LIMIT, resamples=2, **how),
    "effective_mass": lambda how, suite, _: sm.effective_mass(goods(2), suite, **FEW, **how),
    "effective_mass, rack": lambda how, suite, _: sm.effective_mass(on_rack(), suite, **FEW, **how),
    "effective_mass_map": lambda how, suite, _: sm.effective_mass_map(suite, TARGET, MAP, **how),
    "effective_mass_of_design": lambda how, suite, _: sm.effective_mass_of_design(
        lambda share: building(1, 0.2 + 0.13 * share), goods(1).blocks, suite, **FEW, **how
    ),
    "effective_mass_table": lambda how, suite, _: sm.evidence.effective_mass_table(
        [goods(1), goods(2), goods(2, 0.31)], suite, **FEW, **how
    ),
    "evidence": lambda how, suite, _: sm.evidence.evidence(
        ARCHETYPES[1:2], suite, other=sm.Suite("two", suite.records[:2]), setting=SETTING, resamples=2, **how
    ),
    "incremental_dynamic_analysis": lambda how, suite, _: sm.fragility.incremental_dynamic_analysis(
        goods(1), suite, LIMIT, resamples=2, **how
    ),
    "live_load_uncertainty": lambda how, suite, _: sm.live_load_uncertainty(
        goods(1),
        suite,
        mu=sm.distributions.beta(0.31, 0.07),
        occupancy=0.61,
        samples=4,
        fractions=FEW["fractions"],
        **how,
    ),
    "match_suite": lambda how, suite, _: sm.matching.match_suite(
        suite[:2], TARGET, periods=(0.3, 1.1), points=9, max_iterations=0, **how
    ),
    "multiple_stripes": lambda how, suite, _: sm.fragility.multiple_stripes(
        goods(1), {0.31: suite, 0.71: suite.records[1:]}, LIMIT, resamples=2, **how
    ),
    "paper_scenes": lambda how, *_: sm.validation.paper_scenes(springs=SPRINGS, **how),
    "risk_targeted_share": lambda how, suite, _: sm.risk.risk_targeted_share(
        goods(1), suite, HAZARD, LIMIT, shares=FEW["fractions"], other_limits=[0.03], resamples=2, **how
    ),
    "run_study": lambda how, suite, _: sm.study.run_study(suite, TARGET, STUDY, **how),
    "run_study, effective": lambda how, suite, _: sm.study.run_study(suite, TARGET, STUDY, effective=True, **how),
    "section4": lambda how, suite, _: sm.validation.section4([suite[0]], springs=SPRINGS, **how),
    "simulate_many": lambda how, suite, _: sm.simulate_many([goods(1), goods(2), on_rack()], suite, **how),
    "slip_demand": lambda how, suite, _: sm.slip.slip_demand(goods(1), suite, clearance=0.07, resamples=2, **how),
    "solve_grid": lambda how, suite, _: sm.fragility.solve_grid(
        {"one": goods(1), "other": goods(1, 0.31)}, suite, LIMIT, [0.31, 0.71], **how
    ),
    "stream_many": lambda how, suite, _: [*sm.stream_many([goods(1), on_rack()], suite, chunk=4, **how)],
    "study_sensitivity": lambda how, suite, _: sm.study.study_sensitivity(suite, TARGET, STUDY, **how),
    "validate": lambda how, *_: sm.validation.validate(**how),
    "write_many": lambda how, suite, place: sm.write_many(
        place / "runs.parquet", [goods(1), goods(2)], suite, chunk=4, **how
    ),
}
"""One call of each, small, with numbers of scenes, motions and shares that differ."""
TWICE = {"run_study, effective": 2, "validate": 2}
"""Calls that solve twice, and say of each how far it is."""


def test_every_call_with_progress_has_a_case() -> None:
    assert public(sm) == {name.partition(",")[0] for name in CASES}


@pytest.mark.parametrize("name", CASES)
def test_progress_ends_with_all_and_its_stages_are_the_whole(
    name: str, suite: sm.Suite, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[tuple[int, int]] = []
    wholes: list[Progress] = []
    stages: list[tuple[int, list[tuple[int, int]]]] = []
    begin, part = Progress.__init__, Progress.part

    def begun(whole: Progress, *given: Any) -> None:
        begin(whole, *given)
        wholes.append(whole)

    def parted(whole: Progress, count: int) -> Any:
        call, own = part(whole, count), list[tuple[int, int]]()
        stages.append((count, own))
        return call and (lambda done, total: (own.append((done, total)), call(done, total)))

    def tell(*now: Any) -> None:
        of_campaign = [(one.runs_done, one.runs) for one in now if isinstance(one, sm.campaign.CampaignProgress)]
        told.extend(of_campaign or [now])

    monkeypatch.setattr(Progress, "__init__", begun)
    monkeypatch.setattr(Progress, "part", parted)
    CASES[name]({"progress": tell}, suite, tmp_path)
    ends = [now for now, after in pairwise([*told, (-1, 0)]) if after[0] < now[0]]
    assert ends == [(total, total) for _, total in ends]
    assert len(ends) == TWICE.get(name, 1)
    assert [whole.done for whole in wholes] == [whole._total for whole in wholes]
    for count, own in stages:
        assert own[-1:] in ([], [(count, count)])
