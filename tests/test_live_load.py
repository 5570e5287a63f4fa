"""The share to attach under random occupancy and friction: limits, single answers, reference values, errors."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import polars as pl
import pytest
from scipy import stats

import seismass as sm
from pages.effective_mass import far_field_components
from seismass.design import response_spectrum_analysis
from seismass.motions.spectra import mean_spectrum

ROOT = Path(__file__).parents[1]
BUILDING = sm.Building.uniform(3, 0.47, yield_shear_over_weight=[0.34, 0.27, 0.13])
SCENE = sm.Scene(BUILDING, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.4, mu_k=0.3))
MOTIONS = [record.scaled(2.0) for record in sm.builtin_suite("seven")]
SOME = {"mu": sm.distributions.lognormal(0.4, 0.25), "occupancy": sm.distributions.beta(0.7, 0.15)}


def test_distributions() -> None:
    mu, occupancy = stats.lognorm(s=0.25, scale=0.4), sm.distributions.beta(0.7, 0.15)
    assert sm.distributions.lognormal(0.4, 0.25).ppf(0.9) == pytest.approx(mu.ppf(0.9))
    assert occupancy.mean() == pytest.approx(0.7)  # type: ignore[attr-defined]
    assert occupancy.std() == pytest.approx(0.15)  # type: ignore[attr-defined]


def test_samples_are_single_answers() -> None:
    """With all goods present the share of a sample is the effective fraction; with fewer, that of a lighter scene."""
    full = sm.live_load_uncertainty(
        SCENE, MOTIONS, mu=sm.distributions.lognormal(0.2, 0.5), occupancy=1.0, samples=4, seed=2
    )
    for row in full.samples.iter_rows(named=True):
        blocks = sm.blocks_on_floors([1.0, 1.0, 0.0], mu=row["mu"], mu_k=0.75 * row["mu"])
        answer = sm.effective_mass(sm.Scene(BUILDING, blocks), MOTIONS)
        assert row["real_drift"] == pytest.approx(answer.real, rel=1e-12)
        assert row["share"] == pytest.approx(answer.value, abs=5e-4)
    half = sm.live_load_uncertainty(
        SCENE, MOTIONS, mu=sm.distributions.lognormal(0.2, 0.5), occupancy=0.5, samples=3, seed=2
    )
    for row in half.samples.iter_rows(named=True):
        blocks = sm.blocks_on_floors([0.5, 0.5, 0.0], mu=row["mu"], mu_k=0.75 * row["mu"])
        peaks = [sm.simulate(sm.Scene(BUILDING, blocks), motion).peak_drift.max() for motion in MOTIONS]
        assert row["real_drift"] == pytest.approx(np.mean(peaks), rel=1e-12)


def test_glued_goods_have_the_share_that_is_present() -> None:
    """Goods that never slide are mass: an occupancy of 0.6 asks for 0.6 of the design live load."""
    found = sm.live_load_uncertainty(
        SCENE, MOTIONS, mu=sm.distributions.lognormal(50.0, 0.01), occupancy=0.6, samples=3
    )
    # The model with share 0.6 is the same building; the drift is monotonic enough there for the largest crossing.
    model = found.curve.filter((pl.col("fraction") - 0.6).abs() < 1e-9)["model_drift"][0]
    np.testing.assert_allclose(found.samples["real_drift"], model, rtol=1e-12)
    assert found.samples["slides"].sum() == 0.0


def test_same_seed_same_answer_and_files(tmp_path: Path) -> None:
    one, two = (sm.live_load_uncertainty(SCENE, MOTIONS, **SOME, samples=20, threads=n) for n in (1, 2))
    assert one.to_json() == two.to_json()
    assert one.samples.equals(two.samples)
    assert one.quantiles["share"].is_sorted()
    assert one.interval is not None
    assert one.interval[0] <= one.share <= one.interval[1]
    assert one.exceedance(0.0) >= one.exceedance(0.25) >= one.exceedance(1.0)
    assert one.exceedance(1.0) == 0.0
    assert one.tornado["span"].is_sorted(descending=True)
    assert "equal expected drift" in one.text
    assert json.loads(one.to_json())["metadata"]["samples"] == 20
    assert {"live_load.png", "tornado.csv", "samples.parquet"} <= {file.name for file in one.write(tmp_path)}


@pytest.mark.parametrize(
    ("reduction", "share", "quantiles"),
    [(1.0, 0.076, (0.0, 0.06, 0.26)), (2.0, 0.496, (0.17, 0.52, 0.82)), (4.0, 0.691, (0.40, 0.71, 0.91))],
)
def test_reference_on_recordings(shared: Path, reduction: float, share: float, quantiles: tuple[float, ...]) -> None:
    """Values of another sampling of the same distributions: equal expected drift, 5, 50 and 95 %."""
    suite = far_field_components(shared / "records")
    factors = sm.scaling.scale_asce7_10(suite, sm.TargetSpectrum.asce7(), between=False).factors
    motions = [record.scaled(factor) for record, factor in zip(suite, factors, strict=True)]
    bare = sm.Building.uniform(3, 0.47, mass=1.0)
    shear = response_spectrum_analysis(
        bare.mass + np.array([0.25, 0.25, 0.0]), bare.stiffness, lambda at: mean_spectrum(suite, factors, at)
    ).storey_shear
    building = bare if reduction == 1.0 else bare.replace(yield_shear=shear / reduction)
    scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], 0.4))
    found = sm.live_load_uncertainty(scene, motions, **SOME)
    # 200 samples each: the standard error of the mean is some 0.01, of the outer quantiles some 0.03.
    assert found.share == pytest.approx(share, abs=0.02)
    low, middle, high = found.quantiles["share"].to_list()[::2]
    np.testing.assert_allclose([low, middle, high], quantiles, atol=0.05)


WRONG: list[tuple[Callable[[], object], str]] = [
    (
        lambda: sm.live_load_uncertainty(SCENE, MOTIONS, mu="0.4", occupancy=0.7),  # type: ignore[arg-type]
        "mu of live load uncertainty must be a frozen distribution",
    ),
    (
        lambda: sm.live_load_uncertainty(SCENE, MOTIONS, mu=stats.norm(0.1, 1.0), occupancy=SOME["occupancy"]),
        "mu of live load uncertainty must be a distribution of values zero or positive",
    ),
    (
        lambda: sm.live_load_uncertainty(SCENE, MOTIONS, mu=SOME["mu"], occupancy=stats.norm(0.9, 0.5)),
        "occupancy of live load uncertainty must be a distribution of values from 0 to 1",
    ),
    (lambda: sm.live_load_uncertainty(SCENE, MOTIONS, **SOME, samples=1), "samples of live load uncertainty"),
    (lambda: sm.distributions.lognormal(-1.0, 0.2), "median and sigma of lognormal must be positive"),
    (lambda: sm.distributions.beta(0.7, 0.9), "mean of beta must be between 0 and 1"),
]


@pytest.mark.parametrize(("make", "message"), WRONG, ids=[message for _, message in WRONG])
def test_wrong_input(make: Callable[[], object], message: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=f"^{message}"):
        make()
