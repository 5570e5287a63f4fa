"""Every public result has a small card in notebooks, and no dump of its arrays as text."""

from __future__ import annotations

import inspect
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass import assessment, effective_mass
from seismass.media.result import pre
from seismass.media.text_table import column_texts
from seismass.show.animation import animate_plane

SHORT: dict[str, str] = {
    "Block": "an input of one line",
    "RackBlock": "an input of one line",
    "Rayleigh": "an input of one line",
    "Stops": "an input of one line",
    "EffectiveMassParameters": "settings",
    "HuntAndFill": "settings",
    "IntensityMeasure": "settings",
    "LimitState": "settings",
    "StudyParameters": "settings",
    "Setting": "settings",
    "Archetype": "a row of a table",
    "Occupancy": "a row of a table",
    "System": "a row of a table",
    "EqualShare": "a number and its interval",
    "SyntheticParameters": "settings",
    "NearFaultPulse": "settings",
    "StrengthDesign": "settings",
    "BlockSize": "two lengths",
    "Clearance": "two lengths",
    "FloorPlan": "what a figure is given",
    "Footprint": "what a figure is given",
    "GridAxis": "a row of a table",
    "CodeFraction": "a row of a table",
    "CodeRule": "a row of a table",
    "DesignEntry": "a row of a table",
    "DistributionRule": "a row of a table",
    "DriftLimit": "a row of a table",
    "Excluded": "a row of a table",
    "FoundFile": "a row of a table",
    "FrictionPair": "a row of a table",
    "PeriodRule": "a row of a table",
    "SurveyedLoad": "a row of a table",
    "SystemFactors": "a row of a table",
    "Claim": "a row of a table",
    "Misfit": "five numbers with names",
    "Distribution": "a protocol",
    "GroundMotion": "a protocol",
}
"""Public classes without a card: their one line says all."""
TESTED_ELSEWHERE = {
    "Animation": "test_animation.py",
    "DesignedBuilding": "test_designed_building.py",
    "EffectiveMassMap": "test_effective_map.py",
    "Evidence": "test_evidence.py",
    "FragilityAnalysis": "test_intensity_analysis.py",
    "LiveLoadUncertainty": "test_live_load.py",
    "RiskTargetedShare": "test_risk.py",
    "Sensitivity": "test_study_choices.py",
    "StudyResult": "test_study.py",
    "Validation": "test_validation.py",
    "CatalogueSearch": "test_catalogue.py",
    "Candidate": "test_pulses.py",
    "OrientationScan": "test_pulses.py",
    "PulseResult": "test_pulses.py",
    "PushoverScaling": "test_pushover_scaling.py",
    "AnnualRate": "test_hazard.py",
}
"""Results that take long to make; all but the animation have the card of `Result` or of their text, tried below."""


def public_classes() -> dict[str, type]:
    """Every class that the package shows, by name."""
    modules = [sm, assessment, effective_mass]
    modules += [getattr(sm, name) for name in sm.__all__ if inspect.ismodule(getattr(sm, name))]
    found: dict[str, type] = {}
    for module in modules:
        for name in getattr(module, "__all__", []):
            value = getattr(module, name)
            if inspect.isclass(value) and not issubclass(value, BaseException):
                found[value.__name__] = value
    return found


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """A value of each class with a card."""
    folder = tmp_path_factory.mktemp("cards")
    suite, target = sm.builtin_suite("seven"), sm.TargetSpectrum.asce7()
    record = suite.records[0]
    building = sm.Building.uniform(2, 0.3, mass=1e5, yield_shear_over_weight=[0.3, 0.2], heights=3.5)
    scene = sm.Scene(building, sm.blocks_on_floors([1.0, 0.0], mu=0.2))
    scaling = sm.scaling.scale_asce7_10(suite, target)
    motions = [one.scaled(float(factor)) for one, factor in zip(suite, scaling.factors, strict=True)]
    grid = sm.Grid.product(building, mass_ratio=[0.5, 1.0], mu=[0.2, 0.3])
    campaign = sm.campaign.Campaign(grid, [record.motion], part_runs=2)
    tables = {
        "name": "<b>shed</b>",
        "site": {"sds_g": 1.0, "sd1_g": 0.6},
        "building": {"period_s": 0.4, "height_m": 4.5, "area_m2": 1200, "dead_load_kpa": 6.0, "design": True, "R": 4},
        "goods": {"live_load_kpa": 7.2, "mu": 0.3},
        "storeys": [{}, {"live_load_kpa": 0.0}],
    }
    drift = np.linspace(0.0, 0.1, 30)
    (folder / "push.csv").write_text("Roof Drift (mm),Base Shear (kN)\n0,0\n10,5\n30,7\n")
    (folder / "storeys.csv").write_text("Story,Height (m),Mass (t)\nRoof,3,40\nL1,4,50\n")
    rack = sm.Rack(1, 2, period=0.6, level_mass=1e3, blocks=[sm.RackBlock(1, mass=2e4, mu=0.3)])
    flat = lambda periods: np.full(len(periods), 9.81)  # noqa: E731
    analysis = sm.design.response_spectrum_analysis(building.mass, building.stiffness, flat, heights=building.heights)
    two = sm.Scene(building, sm.blocks_on_floors([1.0, 0.0], mu=0.2), other_direction=True)
    turned = sm.Record(record.acceleration[::-1], record.dt, name="turned")
    pair = sm.Pair(record, turned)
    hazard = sm.risk.HazardCurve([0.1, 0.3, 1.0], [1e-2, 2e-3, 1e-4], period=0.3)
    fragility = sm.fragility.fit_capacities(np.linspace(0.4, 1.2, 12), resamples=20)
    matched = sm.matching.match_suite([record], target, periods=(0.5, 0.6), max_iterations=2)
    line = np.linspace(0.0, 1.0, 50)
    band = sm.validation.Band("x", 0.5, *[line] * 5)
    histories = sm.validation.Histories("kernel", "exact", "x", 0.05, 10, line, np.ones((50, 3)), np.ones((50, 3)))
    frame = pl.DataFrame({"run": [1, 2], "drift": [0.01, 0.2]})
    values = [
        scaling,
        sm.assess(tables, suite),
        sm.read_building(tables),
        sm.effective_mass(scene, motions, resamples=20),
        sm.slip.slip_demand(scene, motions),
        building,
        scene,
        record,
        record.motion,
        suite,
        target,
        pair,
        sm.records.Pairs("folder", (pair,)),
        sm.records.rotd(pair, [0.2, 0.5]),
        sm.simulate(scene, record, histories=True),
        sm.simulate(two, pair),
        animate_plane(two, pair),
        rack,
        sm.SlidingBase(mass_ratio=1.0, mu=0.1),
        grid,
        sm.runs.SceneProduct(lambda period: sm.Scene(sm.Building.uniform(1, period)), period=[0.3, 0.6]),
        sm.runs.spring_forces(building, 1, np.linspace(0.0, 0.1, 20)),
        campaign,
        campaign.run(folder / "campaign"),
        sm.campaign.CampaignProgress(1, 2, 10, 20, 0, 3.0),
        sm.read_scene(Path(sm.runs.__file__).parents[1] / "data/examples/storage.toml"),
        sm.design.code_period("asce7-10", "steel-moment-frame", height=9.0, s_d1=0.6),
        sm.design.equivalent_lateral_forces([1e6, 8e5], [3.5, 3.5], 2e5, 0.3),
        sm.design.design_by_code(np.full(2, 1e5), np.full(2, 4e7), sm.TargetSpectrum.asce7(1.0, 0.6), 4.0),
        sm.design.effective_seismic_weight([1e6, 8e5], [5e5, 0.0], use="storage"),
        sm.design.Wall.of_alpha_h(building, 2.0),
        analysis,
        analysis.modes,
        analysis.for_design(4.0),
        sm.design.pushover(building),
        sm.design.fit_pushover(drift, 1e6 * np.tanh(drift / 0.02)),
        sm.spectra.inelastic_spectrum(record, [0.3, 0.6], strength=[0.2, 0.4]),
        sm.scaling.first_mode_oscillator(building),
        sm.scaling.select_records(suite, target, 3),
        matched,
        matched.matched[0],
        fragility,
        sm.slip.Base(record.motion, 3.0, 0.4, 0.0),
        assessment.read_pushover(folder / "push.csv"),
        assessment.read_storey_table(folder / "storeys.csv"),
        hazard,
        sm.study.StudyBuilding({"storeys": 2}, analysis, building.mass, building.yield_shear, {"real": scene}),
        band,
        histories,
        sm.validation.Platform(frame, (band,), {"median": 1.0}, synthetic=True),
        sm.validation.Section4(frame, frame, (histories,), synthetic=True),
    ]
    return {type(value).__name__: value for value in values}


def test_every_public_class_is_known_here(made: dict[str, Any]) -> None:
    assert set(public_classes()) == {*made, *SHORT, *TESTED_ELSEWHERE}


def test_every_result_has_a_card(made: dict[str, Any]) -> None:
    """Well-formed, without script, small, with aligned digits, and said by name."""
    for name, value in public_classes().items():
        assert hasattr(value, "_repr_html_") != (name in SHORT), name
    for name, value in made.items():
        html = value._repr_html_()
        roots = ET.fromstring(f"<all>{html}</all>")
        assert not {"script", "style", "link", "img"} & {element.tag for element in roots.iter()}, name
        assert len(html) < 32_000, name
        text = "".join(roots.itertext())
        assert len(text) < 4000, name
        assert not re.search(r"array\(|Struct|\bobject at 0x|dtype=", text), name
        for table in roots.iter("table"):
            assert "tabular-nums" in table.attrib["style"], name


def test_numbers_of_a_column_have_the_same_decimals(made: dict[str, Any]) -> None:
    for name, value in made.items():
        for table in ET.fromstring(f"<all>{value._repr_html_()}</all>").iter("table"):
            body = [["".join(cell.itertext()) for cell in row.iter("td")] for row in table.iter("tr")]
            columns = list(zip(*[row for row in body if row], strict=True))
            for column in columns:
                numbers = [cell.split()[0] for cell in column if re.fullmatch(r"-?\d+\.\d+( \S+)?", cell)]
                assert len({number.partition(".")[2].__len__() for number in numbers}) <= 1, (name, column)


def test_no_result_is_a_dump_of_its_arrays(made: dict[str, Any]) -> None:
    for name, value in made.items():
        assert len(repr(value)) < 1200, (name, len(repr(value)))


def test_long_texts_and_tables_say_how_the_rest_is_seen(made: dict[str, Any]) -> None:
    assert made["SlipDemand"].text.count("\n") < 26
    assert "more lines" not in made["SlipDemand"]._repr_html_()
    assert "and 26 more lines: print(result.text)" in pre("line\n" * 50)
    pushed = sm.design.pushover(sm.Building.uniform(9, 0.9, mass=1e5, yield_shear_over_weight=0.2, heights=3.0))
    assert re.search(r"of \d+ rows? and 22 columns", pushed._repr_html_())


def test_an_assessment_shows_both_analyses_and_each_storey(made: dict[str, Any]) -> None:
    result = made["Assessment"]
    html = result._repr_html_()
    text = "".join(ET.fromstring(html).itertext())
    assert result.answer.headline in text
    for words in result.answer.pair:
        assert words in text
    assert f"{100.0 * result.governing['governing'][0]:.2f} %" in text
    assert "&lt;b&gt;shed&lt;/b&gt;" in html


def test_digits_of_columns() -> None:
    """The largest has the digits that are asked for, whatever rounding does to it; the others its decimals."""
    assert column_texts([0.06374, 0.00812, 3.296e-6], digits=4, scale=1e3, unit=" mm") == [
        "63.74 mm",
        "8.12 mm",
        "0.00 mm",
    ]
    assert column_texts([9.9996, 1.0], digits=4) == ["10.00", "1.00"]
    assert column_texts([123456.0, 7.0]) == ["123456", "7"]
    assert column_texts([0.0, 0.0]) == ["0.00", "0.00"]
    assert column_texts([None, float("nan"), 0.5]) == ["-", "-", "0.500"]
    assert column_texts([2e-6, 1e-7]) == ["2.00e-06", "1.00e-07"]
    assert column_texts([float("inf"), 2.0]) == ["inf", "2.00"]
    assert column_texts([]) == []
