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


def test_every_table_again_from_single_runs(unequal_scene: sm.Scene, unequal_motions: tuple[sm.Record, ...]) -> None:
    """Four samples of a scene in which no two masses, heights or frictions are alike, and the five of the tornado."""
    building, heights = unequal_scene.building, np.array([4.3, 3.7, 3.1])
    mass, goods = np.array([44.1e3, 35.7e3, 22.4e3]), np.array([18.9e3 + 11.5e3, 13.7e3, 7.8e3])
    assert building is not None
    carried = building.replace(
        damping=building.damping_matrix,
        gravity_load=np.array([461e3, 367e3, 251e3]) + sm.STANDARD_GRAVITY * goods,
    )
    mu, occupancy = sm.distributions.lognormal(0.27, 0.3), sm.distributions.beta(0.6, 0.17)
    fractions = np.array([0.0, 0.2, 0.5, 0.7, 1.0])
    found = sm.live_load_uncertainty(
        unequal_scene, unequal_motions, mu=mu, occupancy=occupancy, samples=4, fractions=fractions, seed=3
    )

    def drifts(scene: sm.Scene) -> tuple[float, float]:
        """Mean over the motions of the largest drift ratio, and the share of motions under which goods slide."""
        runs = [sm.simulate(scene, motion) for motion in unequal_motions]
        largest = [(run.peak_drift / heights).max() for run in runs]
        return float(np.mean(largest)), float(np.mean([(run.peak_slip > 0.0).any() for run in runs]))

    def real(friction: float, present: float) -> tuple[float, float]:
        kinds = [
            (1, 18.9e3, 0.298, 0.214),
            (1, 11.5e3, 0.253, 0.154),
            (2, 13.7e3, 0.349, 0.184),
            (3, 7.8e3, 0.291, 0.24),
        ]
        blocks = [
            sm.Block(floor, mass=kilograms * present, mu_s=friction, mu_k=friction * (mu_k / mu_s))
            for floor, kilograms, mu_s, mu_k in kinds
        ]
        return drifts(unequal_scene.replace(blocks=blocks))

    curve = np.array([drifts(sm.Scene(carried.replace(mass=mass + share * goods)))[0] for share in fractions])
    assert found.unit == "ratio"
    assert found.curve["fraction"].to_list() == fractions.tolist()
    np.testing.assert_allclose(found.curve["model_drift"], curve, rtol=1e-12)

    def at(share: float) -> float:
        return float(np.interp(share, fractions, curve))

    samples = found.samples
    assert samples["sample"].to_list() == [1, 2, 3, 4]
    # One sample in each quarter of both distributions.
    for column, distribution in (("mu", mu), ("occupancy", occupancy)):
        levels = distribution.cdf(samples[column].to_numpy())  # type: ignore[attr-defined]
        assert sorted((4.0 * levels).astype(int)) == [0, 1, 2, 3], column
    for row in samples.iter_rows(named=True):
        drift, slides = real(row["mu"], row["occupancy"])
        assert row["real_drift"] == pytest.approx(drift, rel=1e-12)
        assert row["slides"] == pytest.approx(slides, rel=1e-12)
        # At the share the model has the drift of the sample, and it has more at every larger share.
        assert 0.0 < row["share"] < 1.0
        assert at(row["share"]) == pytest.approx(drift, rel=1e-9)
        assert (curve[fractions > row["share"]] > drift).all()
    shares = samples["share"].to_numpy()
    assert found.quantiles["probability"].to_list() == [0.05, 0.16, 0.5, 0.84, 0.95]
    np.testing.assert_allclose(found.quantiles["share"], np.quantile(shares, [0.05, 0.16, 0.5, 0.84, 0.95]), rtol=1e-12)
    assert found.share_84 == pytest.approx(np.quantile(shares, 0.84), rel=1e-12)
    assert at(found.share) == pytest.approx(samples["real_drift"].mean(), rel=1e-9)
    assert found.exceedance(float(np.sort(shares)[1])) == 0.5
    rows = {row["variable"]: row for row in found.tornado.iter_rows(named=True)}
    assert set(rows) == {"friction mu", "occupancy"}
    for name, distribution in (("friction mu", mu), ("occupancy", occupancy)):
        row = rows[name]
        ends = distribution.ppf([0.05, 0.95])
        assert [row["low"], row["high"]] == pytest.approx(ends.tolist(), rel=1e-12)
        middles = float(mu.ppf(0.5)), float(occupancy.ppf(0.5))
        pairs = [(end, middles[1]) if name == "friction mu" else (middles[0], end) for end in ends]
        for column, pair in zip(("share_low", "share_high", "share_median"), [*pairs, middles], strict=True):
            drift = real(*pair)[0]
            inside = curve[0] < drift < curve[-1]
            assert at(row[column]) == pytest.approx(drift if inside else np.clip(drift, curve[0], curve[-1]), rel=1e-9)
        assert row["span"] == pytest.approx(abs(row["share_high"] - row["share_low"]), rel=1e-12)
    assert found.tornado["span"].to_list() == sorted(found.tornado["span"], reverse=True)
    document = found.to_dict()
    for name in ("share", "share_84", "unit", "metadata"):
        assert document[name] == getattr(found, name), name
    assert document["tornado"] == found.tornado.to_dicts()
    assert document["quantiles"] == found.quantiles.to_dicts()


def test_collapses_are_counted_by_sample(unequal_scene: sm.Scene, unequal_motions: tuple[sm.Record, ...]) -> None:
    """One of two motions brings all three samples down: three samples, and not one motion."""
    strong, weak = unequal_motions[0].scaled(5.0), unequal_motions[1].scaled(0.01)
    scene = unequal_scene.replace(collapse_drift=[0.043, 0.037, 0.031])
    found = sm.live_load_uncertainty(scene, [strong, weak], mu=0.3, occupancy=0.6, samples=3, fractions=[0.0, 1.0])
    assert "the building with sliding goods collapses under some motion in 3 samples" in found.remarks
    assert np.isnan(found.share)
    assert found.interval is None
    whole = sm.live_load_uncertainty(scene, [weak], mu=0.3, occupancy=0.6, samples=3, fractions=[0.0, 1.0])
    assert not any("collapses" in remark for remark in whole.remarks)


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
