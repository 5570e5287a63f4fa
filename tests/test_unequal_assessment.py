"""An assessment of a building whose storeys, goods and shares are all unequal: each row has its own numbers."""

from __future__ import annotations

from typing import Any

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.assessment.advice import _envelope
from seismass.assessment.answer import deciding
from seismass.assessment.checks import largest_excess
from seismass.assessment.doubts import _load_doubts
from seismass.assessment.models import motion_of_runs
from seismass.show.assessment.page import building_page

G = 9.80665


@pytest.fixture(scope="module")
def unequal(unequal_building: sm.assessment.OwnBuilding, unequal_motions: tuple[sm.Record, ...]) -> sm.Assessment:
    return sm.assess(unequal_building, unequal_motions, scale=False, resamples=2)


def test_unequal_storeys_and_goods_have_their_own_rows(
    unequal: sm.Assessment, unequal_motions: tuple[sm.Record, ...]
) -> None:
    """Drifts, stability and slips of each storey and each kind again, from single runs of models made here."""
    heights, stiffness = np.array([4.3, 3.7, 3.1]), np.array([1.93e8, 1.57e8, 1.13e8])
    loads = 1e3 * np.array([6.1 * 530.0, 4.3 * 470.0, 1.9 * 410.0])
    present = np.array([0.59 * 0.88 + 0.41 * 0.55, 0.71, 0.43]) * loads
    gravity = np.cumsum((np.array([3.07e6, 2.39e6, 1.64e6]) + present)[::-1])[::-1]
    frictions = [(1, 0.298, 0.214), (1, 0.253, 0.154), (2, 0.349, 0.184), (3, 0.291, 0.24)]
    real = unequal.building.scene()
    assert real.building is not None
    assert unequal.advised is not None
    bare = real.building.replace(
        damping=real.building.damping_matrix, gravity_load=None, geometric_stiffness=gravity / heights
    )

    def attached(mass: Any) -> sm.Scene:
        return sm.Scene(bare.replace(mass=real.building.mass + mass / G))

    scenes = {
        "real": real,
        "real_mu_low": unequal.building.scene(mu_factor=0.71),
        "real_mu_high": unequal.building.scene(mu_factor=1.37),
        "advised": attached(unequal.advised * present),
        "code": attached(0.25 * loads),
        "attached": attached(present),
        "bare": attached(0.0),
    }
    assert list(scenes) == unequal.storeys["model"].unique(maintain_order=True).to_list()
    means = {}
    for model, scene in scenes.items():
        runs = [sm.simulate(scene, motion) for motion in unequal_motions]
        drift = np.array([run.peak_drift for run in runs])
        shear = np.array([run.peak_storey_shear for run in runs]).mean(axis=0)
        rows = unequal.storeys.filter(model=model)
        means[model] = (drift / heights).mean(axis=0)
        for column, values in {
            "mean": means[model],
            "p16": np.quantile(drift / heights, 0.16, axis=0),
            "median": np.median(drift / heights, axis=0),
            "p84": np.quantile(drift / heights, 0.84, axis=0),
            "max": (drift / heights).max(axis=0),
            "mean_over_limit": means[model] / 0.017,
            "motions_above_limit": (drift / heights > 0.017).sum(axis=0),
            "mean_peak_shear": shear,
            "theta": gravity * drift.mean(axis=0) / (shear * heights),
            "theta_elastic": gravity / (stiffness * heights),
        }.items():
            np.testing.assert_allclose(rows[column], values, rtol=1e-10, err_msg=f"{model}, {column}")
        if not scene.goods:
            continue
        slips, residuals = (np.array([getattr(run, name) for run in runs]) for name in ("peak_slip", "residual_slip"))
        factor = {"real": 1.0, "real_mu_low": 0.71, "real_mu_high": 1.37}[model]
        table = unequal.slip.filter(model=model)
        assert table["goods"].to_list() == ["pallets", "drums", "", ""]
        for row, (floor, mu_s, mu_k), peak, left in zip(
            table.iter_rows(named=True), frictions, slips.T, np.abs(residuals.T), strict=True
        ):
            assert (row["floor"], row["mu_s"], row["mu_k"]) == (floor, factor * mu_s, factor * mu_k)
            assert row["motions_that_slide"] == (peak > 0.0).sum()
            found = [row[f"peak_{name}"] for name in ("mean", "p16", "median", "p84", "max")]
            expected = [peak.mean(), *np.quantile(peak, [0.16, 0.5, 0.84]), peak.max()]
            assert found == pytest.approx(expected, rel=1e-12, abs=1e-15)
            found = [row[f"residual_{name}"] for name in ("mean", "median", "p84")]
            assert found == pytest.approx([left.mean(), *np.quantile(left, [0.5, 0.84])], rel=1e-12, abs=1e-15)
        # Of two kinds on a floor the one that slides further.
        rows = unequal.runs.filter(model=model)
        np.testing.assert_allclose(rows.filter(storey=1)["peak_slip"], slips[:, :2].max(axis=1), rtol=1e-12)
        np.testing.assert_allclose(rows.filter(storey=2)["peak_slip"], slips[:, 2], rtol=1e-12)
        np.testing.assert_allclose(rows.filter(storey=3)["residual_drift"], [run.residual_drift[2] for run in runs])
    words = {"real": "mu as stated", "real_mu_high": "mu x 1.37", "real_mu_low": "mu x 0.71"}
    for place, row in enumerate(unequal.governing.iter_rows(named=True)):
        sliding = max(words, key=lambda model, place=place: means[model][place])
        of = {model: means[model][place] for model in ("advised", "bare", *words)}
        assert row["sliding_at"] == words[sliding]
        assert row["sliding"] == pytest.approx(of[sliding], rel=1e-10)
        assert row["governing"] == pytest.approx(max(of.values()), rel=1e-10)
        by = max(of, key=lambda model, of=of: of[model])
        names = {"advised": "analysis 1", "bare": "analysis 2"}
        assert row["governed_by"] == names.get(by, f"goods slide, {words.get(by)}")
        assert row["governing_over_limit"] == pytest.approx(max(of.values()) / 0.017, rel=1e-10)


def test_shares_are_told_of_the_goods_present_and_of_the_design_load(unequal: sm.Assessment) -> None:
    """The code counts 0.25 of the design load, which is 0.36 of the goods; the share advised is of the goods."""
    loads = np.array([6.1 * 530.0, 4.3 * 470.0, 1.9 * 410.0])
    present = np.array([0.59 * 0.88 + 0.41 * 0.55, 0.71, 0.43])
    share = present @ loads / loads.sum()
    assert unequal.advised is not None
    text = " ".join(unequal.text.split())
    assert f"ASCE/SEI 7-10, storage: {0.25 / share:.2f} of the goods present (0.25 of the design live load)" in text
    own = f"lambda = {unequal.advised:.2f} of the goods present ({unequal.advised * share:.2f} of the design live load)"
    assert own in text
    assert unequal.advised_of_live_load == pytest.approx(unequal.advised * share, rel=1e-12)
    assert f"present: {share:.3g} of the design live load of the whole building" in text
    masses = unequal.tables["analysis"]
    np.testing.assert_allclose(masses["multiplier_1"], unequal.advised * present, rtol=1e-12)
    np.testing.assert_allclose(masses["multiplier_2"], 0.0, atol=0.0)
    floors = np.array([5.3 * 530.0, 4.7 * 470.0, 3.7 * 410.0])
    np.testing.assert_allclose(masses["weight_1_kn"], floors + unequal.advised * present * loads, rtol=1e-12)
    real = unequal.effective["real"]
    # Means of static and kinetic friction, by the masses present.
    of_floors = [0.59 * 0.88 * 0.256 + 0.41 * 0.55 * 0.2035, 0.71 * 0.2665, 0.43 * 0.2655]
    assert real.by_hand.friction == pytest.approx(np.array(of_floors) @ loads / (present @ loads), rel=1e-12)
    assert f"(mu_s + mu_k)/2 = {unequal.effective[deciding(unequal.effective)].by_hand.friction:.3g}" in text


def test_sentences_name_the_storey_and_the_friction_of_the_largest_ratio(unequal: sm.Assessment) -> None:
    """Drift with sliding goods over that of analysis 1, over the larger of both analyses, and over the code's model."""
    means = {model: rows["mean"].to_list() for (model,), rows in unequal.storeys.group_by("model")}
    words = {"real": "mu as stated", "real_mu_high": "mu x 1.37", "real_mu_low": "mu x 0.71"}

    def largest(*models: str) -> tuple[float, int, str]:
        """Over storeys and frictions; with its storey and friction."""
        return max(
            (means[sliding][place] / max(means[model][place] for model in models), place + 1, words[sliding])
            for sliding in words
            for place in range(3)
        )

    text = " ".join(unequal.advice)
    ratio, storey, friction = largest("code")
    assert f"({friction}) storey {storey} drifts {ratio:.2f} times the model with the code's" in text
    ratio, storey, friction = largest("advised")
    covers = "covers every storey here" if ratio <= 1.05 else "does not cover every storey"
    assert f"Analysis 1 alone {covers}: with sliding goods storey {storey} drifts {ratio:.2f} times its own" in text
    assert f"drifts {ratio:.2f} times its own ({friction})" in text
    ratio, storey, friction = largest("advised", "bare")
    assert unequal.answer.governs[-1].endswith(f"{ratio:.2f} times the larger (storey {storey}, {friction})")


@pytest.mark.parametrize(
    ("advised", "words", "bare", "over_both"),
    [
        # Storey 2: 24 over 20, and over the larger of 20 and 15; then over the larger of 20 and 22.
        ([0.010, 0.020], "does not cover every storey: with sliding goods storey 2 drifts 1.20", [0.008, 0.015], 1.2),
        (
            [0.010, 0.020],
            "does not cover every storey: with sliding goods storey 2 drifts 1.20",
            [0.008, 0.022],
            12 / 11,
        ),
        # Exactly 1.05 is covered still.
        ([0.010, 0.024 / 1.05], "covers every storey here: with sliding goods storey 2 drifts 1.05", [0.0, 0.0], 1.05),
    ],
)
def test_what_the_pair_covers_is_by_the_larger_of_both(
    unequal: sm.Assessment, advised: list[float], words: str, bare: list[float], over_both: float
) -> None:
    drifts = {"real": [0.009, 0.024], "advised": advised, "bare": bare}
    rows = pl.DataFrame([{"model": model, "mean": value} for model, values in drifts.items() for value in values])
    assert _envelope(unequal.building, rows, ("real",)) == f"Analysis 1 alone {words} times its own (mu as stated)."
    columns = {"sliding": drifts["real"], "advised": advised, "bare": bare}
    governing = pl.DataFrame({"storey": [1, 2], **columns, "sliding_at": ["mu as stated"] * 2})
    assert largest_excess(governing) == (pytest.approx(over_both, rel=1e-12), 2, "mu as stated")


@pytest.mark.parametrize(
    ("drift", "slip", "collapsed", "shown"),
    [
        ([3.0, 1.0, 2.0], [1.0, 1.0, 1.0], [], 2),  # the median of three
        ([3.0, 1.0, 2.0, 4.0], [1.0, 1.0, 1.0, 1.0], [], 2),  # the lower one of the two in the middle
        ([3.0, 1.0, 2.0, 4.0], [1.0, 0.0, 1.0, 1.0], [], 0),  # of those with slip: 3 of 2, 3, 4
        ([3.0, 1.0, 2.0, 4.0], [0.0, 0.0, 0.0, 0.0], [], 2),  # none slides: of all
        ([3.0, 1.0, 2.0, 4.0], [1.0, 1.0, 1.0, 1.0], [0], 2),  # not the one that collapses: 2 of 1, 2, 4
        ([3.0, 1.0], [1.0, 1.0], [0, 1], 0),  # all collapse: the first
        ([2.0, 2.0], [1.0, 1.0], [], 0),  # equal: the first
    ],
)
def test_the_motion_shown_is_that_of_median_drift(
    drift: list[float], slip: list[float], collapsed: list[int], shown: int
) -> None:
    """The larger of two storeys counts, of the first model alone."""
    rows = [
        {
            "model": model,
            "motion": number + 1,
            "collapsed": number in collapsed,
            "peak_drift": (factor if model == "real" else -1.0) * value,
            "peak_slip": slip[number] if storey == 0 else None,
        }
        for model in ("real", "bare")
        for number, value in enumerate(drift)
        for storey, factor in enumerate((1.0, 0.5))
    ]
    assert motion_of_runs(pl.DataFrame(rows, schema_overrides={"peak_slip": pl.Float64})) == shown


def test_the_page_has_the_drawing_for_phones_beside_the_wide_one(unequal: sm.Assessment) -> None:
    start = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0'
    wide, narrow = (f'{start} {size} 9" width="{size}pt" height="9pt"><path d="M0 0"/></svg>' for size in (711, 311))
    alone, both = building_page(unequal, {"drift": wide}), building_page(unequal, {"drift": wide}, {"drift": narrow})
    assert [text in alone for text in ("0 0 711 9", "0 0 311 9")] == [True, False]
    assert [text in both for text in ("0 0 711 9", "0 0 311 9")] == [True, True]


@pytest.mark.parametrize(("place", "called"), [(0, "floor 1, hall,"), (1, "floor 2, loft,"), (2, "floor 3, roof,")])
@pytest.mark.parametrize(("key", "what"), [("live_load_kpa", "design live load"), ("dead_load_kpa", "dead load")])
def test_a_load_out_of_range_is_that_of_its_floor(
    unequal_file: dict[str, Any], place: int, called: str, key: str, what: str
) -> None:
    unequal_file["storeys"][place][key] = 96.5
    (doubt,) = [text for text in _load_doubts(sm.read_building(unequal_file)) if text.startswith(what)]
    assert doubt.startswith(f"{what} of {called} is 96.5 kPa, above ")
    assert "(and " not in doubt
    unequal_file["storeys"][place - 1][key] = 97.5
    (doubt,) = [text for text in _load_doubts(sm.read_building(unequal_file)) if text.startswith(what)]
    assert "(and 1 more)" in doubt
