"""Results answer alike: text, tables, figures, document, files, and a card."""

from __future__ import annotations

import json
from pathlib import Path

import polars as pl
import pytest
from matplotlib.figure import Figure

import seismass as sm
from seismass.effective_mass.design_map import EffectiveMassMap
from seismass.media.result import Result
from seismass.studies.study import Sensitivity
from seismass.studies.study.run import StudyResult
from seismass.studies.validation import Validation

KINDS = (
    sm.Assessment,
    sm.EffectiveMass,
    EffectiveMassMap,
    sm.LiveLoadUncertainty,
    sm.design.PushoverFit,
    sm.fragility.FragilityAnalysis,
    sm.risk.RiskTargetedShare,
    sm.scaling.ScalingResult,
    sm.slip.SlipDemand,
    Sensitivity,
    StudyResult,
    Validation,
)


def test_every_kind_of_result_is_known_here() -> None:
    assert set(Result.__subclasses__()) == set(KINDS)


@pytest.mark.parametrize("kind", KINDS, ids=[kind.__name__ for kind in KINDS])
def test_every_result_has_a_part_of_its_own_for_each_that_all_have(kind: type[Result]) -> None:
    for name in ("text", "tables", "figure_names", "plot", "to_dict"):
        assert getattr(kind, name) is not getattr(Result, name), name
        assert name in vars(kind), name
    assert [other.document for other in KINDS].count(kind.document) == 1


@pytest.fixture(scope="module")
def results() -> list[Result]:
    suite = sm.builtin_suite("seven")
    scaling = sm.scaling.scale_asce7_10(suite, sm.TargetSpectrum.asce7())
    motions = [record.scaled(float(factor)) for record, factor in zip(suite, scaling.factors, strict=True)]
    building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.3, 0.2])
    scene = sm.Scene(building, sm.blocks_on_floors([1.0, 0.0], mu=0.2))
    return [scaling, sm.effective_mass(scene, motions, resamples=50), sm.slip.slip_demand(scene, motions)]


def test_a_result_gives_all_that_it_promises(results: list[Result], tmp_path: Path) -> None:
    for result in results:
        assert result.text and all(isinstance(table, pl.DataFrame) for table in result.tables.values())
        assert json.loads(result.to_json()) == json.loads(json.dumps(result.to_dict()))
        assert all(isinstance(figure, Figure) for figure in result.figures().values())
        assert isinstance(result.plot(), Figure)
        with pytest.raises(sm.errors.InvalidOption, match=f"name of figure of {result.document} must be one of"):
            result.plot("another")
        files = {path.name for path in result.write(tmp_path / result.document, figures=False)}
        assert files >= {f"{result.document}.json", *(f"{name}.parquet" for name in result.tables)}
        assert not any(name.endswith((".png", ".svg")) for name in files)
        assert result._repr_html_().startswith("<div")


def test_a_response_is_a_document_with_what_was_asked_for() -> None:
    scene = sm.Scene(sm.Building.uniform(1, 0.3), [sm.Block(1, mass_ratio=0.5, mu=0.2)])
    motion = sm.Motion([0.0, 3.0, -3.0, 0.0], dt=0.1)
    bare, whole = sm.simulate(scene, motion, events=False), sm.simulate(scene, motion, energy=True)
    assert {"events", "energy"}.isdisjoint(bare.to_dict())
    document = json.loads(whole.to_json())
    assert document["peak_drift"] == whole.peak_drift.tolist()
    assert len(document["events"]) == sum(document["counts"].values())
    assert document["energy"]["relative_residual"] == whole.energy["relative_residual"]
    assert whole.text.splitlines()[0] == "Response"
