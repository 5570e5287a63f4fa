"""Results answer alike: text, tables, figures, document, files, and a card."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest
from matplotlib.figure import Figure

import seismass as sm
from seismass.base.views import maker_of
from seismass.effective_mass.design_map import EffectiveMassMap
from seismass.media.result import Result, StoredResult
from seismass.model.scene import goods_names
from seismass.studies.study import Sensitivity
from seismass.studies.study.run import StudyResult
from seismass.studies.validation import Validation

KINDS = (
    sm.Assessment,
    sm.evidence.Evidence,
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
    assert {*Result.__subclasses__(), *StoredResult.__subclasses__()} - {StoredResult} == set(KINDS)


@pytest.mark.parametrize("kind", KINDS, ids=[kind.__name__ for kind in KINDS])
def test_every_result_has_a_part_of_its_own_for_each_that_all_have(kind: type[Result]) -> None:
    for name in ("tables", "figure_names", "to_dict"):
        assert getattr(kind, name) is not getattr(Result, name), name
    for name in ("text", "plot"):
        assert name in vars(kind) or maker_of(kind, name), name
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
        with pytest.raises(sm.errors.InvalidOption, match=f"name of figure of {result.document} must be"):
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


def plain(value: Any) -> Any:
    """Arrays as lists, and None for what is not finite."""
    if isinstance(value, dict):
        return {key: plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [plain(one) for one in value]
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    return None if isinstance(value, float) and not np.isfinite(value) else value


def document_of(response: sm.Response) -> dict[str, Any]:
    """What the document of a response must hold, by name: attributes, and what has another place."""
    scene, building = response.scene, response.scene.building
    own = {
        "name": scene.name,
        "dt": response.motion.dt,
        "counts": {kind: count for kind, count in response.counts.items() if count},
        "events": [
            {key: value for key, value in row.items() if value is not None} for row in response.events.to_dicts()
        ],
    }
    if scene.engine == "general":
        own["goods"] = list(goods_names(scene))
    if building is not None:
        own["damping_matrix"] = building.damping_matrix
        own["mass_stated"] = building.mass_is_stated
        own["peak_shear_over_weight"] = response.peak_storey_shear / (sm.STANDARD_GRAVITY * building.mass.sum())
    return {name: plain(own[name] if name in own else getattr(response, name)) for name in response.to_dict()}


PEAKS = ("drift", "slip", "floor_acceleration", "storey_shear")


def test_every_field_of_a_response_is_its_attribute(
    unequal_scene: sm.Scene, unequal_motions: tuple[sm.Record, ...]
) -> None:
    """In a chain, with racks and stops, and on a sliding base."""
    stops = sm.Stops([0.011, 0.007], stiffness=3e6, damping=1e3)
    rack = sm.Rack(2, levels=2, level_mass=310.0, period=0.41, blocks=[sm.RackBlock(1, mass=1900.0, mu=0.17)])
    racked = unequal_scene.replace(
        racks=[rack], blocks=[*unequal_scene.blocks, sm.Block(1, mass=7e3, mu=0.1, stops=stops)]
    )
    for scene in (unequal_scene, racked, unequal_scene.replace(base=sm.SlidingBase(mass_ratio=0.9, mu=0.13))):
        response = sm.simulate(scene, unequal_motions[0], energy=True)
        document = response.to_dict()
        assert document.keys() >= {f"peak_{name}{end}" for name in PEAKS for end in ("", "_time")}
        assert document.keys() >= {"residual_drift", "residual_slip", "slip_path", "status", "end_time", "energy"}
        expected = document_of(response)
        # The weight is that of the building; a rack or a slab adds to what stands on the ground.
        assert document.pop("peak_shear_over_weight") == pytest.approx(
            expected.pop("peak_shear_over_weight"), rel=1e-12
        )
        assert document == expected
    assert {"peak_base_slip", "base_slip_path"} <= document.keys()
