"""The effective fraction where masses, heights, frictions and springs are all unequal, again from single runs."""

from __future__ import annotations

import numpy as np
import pytest

import seismass as sm
from seismass.base.units import STANDARD_GRAVITY


def test_answers_of_unequal_goods_and_storeys(unequal_scene: sm.Scene, unequal_motions: tuple[sm.Record, ...]) -> None:
    """Every number again from single runs of models made here, where no two masses, heights or frictions are alike."""
    building = unequal_scene.building
    assert building is not None
    mass, heights = np.array([44.1e3, 35.7e3, 22.4e3]), np.array([4.3, 3.7, 3.1])
    goods = np.array([18.9e3 + 11.5e3, 13.7e3, 7.8e3])
    # P-Delta of all goods stays in every model.
    carried = building.replace(
        damping=building.damping_matrix, gravity_load=np.array([461e3, 367e3, 251e3]) + STANDARD_GRAVITY * goods
    )
    found = sm.effective_mass(unequal_scene, unequal_motions, fractions=[0.0, 0.25, 0.5, 0.75, 1.0], resamples=2)
    assert found.unit == "ratio"
    assert found.kind == "root"

    def runs(share: float | None) -> list[sm.Response]:
        scene = unequal_scene if share is None else sm.Scene(carried.replace(mass=mass + share * goods))
        return [sm.simulate(scene, motion) for motion in unequal_motions]

    def ratios(share: float | None) -> np.ndarray:
        return np.array([run.peak_drift / heights for run in runs(share)])

    real, model, bare, full = (ratios(share) for share in (None, found.value, 0.0, 1.0))
    assert found.real == pytest.approx(real.max(axis=1).mean(), rel=1e-12)
    assert found.model == pytest.approx(model.max(axis=1).mean(), rel=1e-10) == found.real
    expected = {
        "real": real.mean(axis=0),
        "model": model.mean(axis=0),
        "model_at_0": bare.mean(axis=0),
        "model_at_1": full.mean(axis=0),
    }
    expected |= {
        "ratio": expected["real"] / expected["model"],
        "ratio_at_0": expected["real"] / expected["model_at_0"],
        "ratio_at_1": expected["real"] / expected["model_at_1"],
        "envelope_ratio": expected["real"] / np.maximum(expected["model"], expected["model_at_0"]),
    }
    for column, values in expected.items():
        np.testing.assert_allclose(found.storeys[column], values, rtol=1e-10, err_msg=column)
    curve = found.curve.filter(fraction=1.0)
    np.testing.assert_allclose(curve["model_drift"], [full.max(axis=1).mean(), *full.mean(axis=0)], rtol=1e-12)
    # mu_k by mass, over the mean peak base shear of the building with all goods attached over the whole weight.
    shears = [run.peak_storey_shear[0] for run in runs(1.0)]
    coefficient = np.mean(shears) / (STANDARD_GRAVITY * (mass.sum() + goods.sum()))
    assert found.base_shear_coefficient == pytest.approx(coefficient, rel=1e-12)
    mu_k = (18.9 * 0.214 + 11.5 * 0.154 + 13.7 * 0.184 + 7.8 * 0.24) / (18.9 + 11.5 + 13.7 + 7.8)
    assert found.eta == pytest.approx(mu_k / coefficient, rel=1e-12)
