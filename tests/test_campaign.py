"""Campaigns: the rows of `simulate_many` in a folder, joined with what varies; the same folder for every engine."""

from __future__ import annotations

import hashlib
import json
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest
from polars.testing import assert_frame_equal

import seismass as sm
from seismass.studies.campaign.engine import duration_text
from seismass.studies.campaign.manifest import part_path

BUILDING = sm.Building.uniform(2, 0.3, heights=[3.4, 2.7], yield_shear_over_weight=[0.2, 0.12])
MOTIONS = [
    sm.Motion([2.0, -2.0, 2.0, 0.0], dt=0.1),
    sm.Motion([0.0, 3.0, -4.0, 1.0, 2.0], dt=0.1, vertical=[0.0, 1.0, -1.0, 0.5, 0.0]),
]


def product() -> sm.Grid:
    return sm.Grid.product(BUILDING, mass_ratio=[0.5, 1.0], mu=[0.1, 0.2, 0.3], scale=[0.5, 1.0, 2.0])


def aligned() -> sm.Grid:
    rng = np.random.default_rng(1)
    buildings = [BUILDING, sm.Building.uniform(3, 0.5, damping=sm.Rayleigh(0.03), yield_shear_over_weight=0.2)]
    return sm.Grid(
        buildings,
        building_index=rng.integers(1, 3, 12),
        mass_ratio=rng.uniform(0.2, 1.0, (12, 2)),
        floors=[1, 2],
        mu_s=rng.uniform(0.2, 0.4, 12),
        mu_k=0.15,
        attached=0.25,
        motion=rng.integers(1, 3, 12),
    )


def campaign(**options: Any) -> sm.campaign.Campaign:
    return sm.campaign.Campaign(product(), MOTIONS, **({"part_runs": 5} | options))


def tree(folder: Path) -> dict[str, str]:
    """Digest of every file of a folder."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("campaign") / "undisturbed"
    campaign().run(place)
    return place


@pytest.mark.parametrize("grid", [product, aligned])
@pytest.mark.parametrize("part_runs", [1, 5, 1000])
def test_rows_are_those_of_a_batch_with_what_varies(tmp_path: Path, grid: Any, part_runs: int) -> None:
    made = sm.campaign.Campaign(grid(), MOTIONS, part_runs=part_runs)
    folder = made.run(tmp_path / "results")
    rows = folder.scan().collect()
    batch = sm.simulate_many(grid(), MOTIONS)
    kept = [name for name in made.columns if name != "record"]
    assert_frame_equal(rows.select(kept), batch.select(kept), check_exact=True)
    assert rows["record"].to_list() == batch["record"].to_list()
    varied = grid().table()
    joined = batch.select("scene").join(varied, on="scene", how="left", maintain_order="left")
    names = [name for name in varied.columns if name not in ("scene", "motion")]
    assert_frame_equal(rows.select(names), joined.select(names), check_exact=True)


def test_the_folder_says_what_it_is(undisturbed: Path) -> None:
    manifest = json.loads((undisturbed / "manifest.json").read_text())
    made = campaign()
    assert manifest["inputs_sha256"] == made.sha256
    assert (manifest["runs"], manifest["scenes"], manifest["parts"]) == (36, 18, 8) == (made.total, 18, made.parts)
    assert manifest["package_version"] == sm.__version__
    assert manifest["units"]["peak_drift"] == "m"
    motions = sm.campaign.CampaignFolder(undisturbed).motions
    assert motions["pga_g"].to_list() == [motion.pga_g for motion in MOTIONS]
    assert motions["sha256"].n_unique() == 2
    folder = sm.campaign.CampaignFolder(undisturbed)
    assert folder.complete
    assert folder.runs_present == 36
    assert folder.verify()["problem"].null_count() == 8
    assert repr(folder).endswith("8 of 8 parts)")


def test_a_folder_makes_its_campaign_again(tmp_path: Path) -> None:
    made = sm.campaign.Campaign(aligned(), MOTIONS, columns=["peak_slip"], single=True, name="again", part_runs=7)
    again = made.run(tmp_path / "a").campaign
    assert again.sha256 == made.sha256
    assert again.name == "again"
    assert_frame_equal(again.grid.table(), made.grid.table(), check_exact=True)
    assert_frame_equal(again.solve(2), made.solve(2), check_exact=True)


def test_a_sample_of_a_designed_grid_makes_its_campaign_again(tmp_path: Path) -> None:
    grid = sm.Grid.sample(
        samples=8,
        seed=3,
        storeys=[2, 3],
        period=[0.38, 0.47],
        R=[1.0, 2.0, 4.0],
        design=sm.runs.StrengthDesign(sm.TargetSpectrum.asce7(1.0, 0.6).tilted(0.1)),
        mass_ratio=[0.5, 1.0],
        occupancy=sm.distributions.beta(0.7, 0.15),
        mu=sm.distributions.lognormal(0.4, 0.25),
        attached=0.25,
        attached_of="design",
    )
    made = sm.campaign.Campaign(grid, MOTIONS, part_runs=3)
    folder = made.run(tmp_path / "a")
    assert folder.campaign.sha256 == made.sha256
    assert_frame_equal(folder.campaign.solve(5), made.solve(5), check_exact=True)
    assert {"R", "occupancy", "mu_s", "peak_slip"} <= set(folder.scan().collect_schema().names())


def test_kept_columns_and_single_precision(tmp_path: Path) -> None:
    made = campaign(columns=["peak_slip", "slips"], single=True, peaks_only=True)
    rows = made.run(tmp_path / "a").scan_parts().collect()
    assert rows.columns == ["scene", "motion", "status", "peak_slip", "slips"]
    assert rows.schema["peak_slip"] == pl.List(pl.Float32)
    whole = sm.simulate_many(product(), MOTIONS, peaks_only=True)["peak_slip"].explode().to_numpy()
    assert np.array_equal(rows["peak_slip"].explode().to_numpy(), whole.astype(np.float32))


def test_only_what_is_missing_is_solved_and_ends_in_the_same_bytes(undisturbed: Path, tmp_path: Path) -> None:
    place = tmp_path / "a"
    campaign().run(place)
    for part in (1, 4, 8):
        part_path(place, part).unlink()
    kept = part_path(place, 2).stat().st_mtime_ns
    reports: list[sm.campaign.CampaignProgress] = []
    folder = sm.campaign.CampaignFolder(place).run(progress=reports.append)
    assert tree(place) == tree(undisturbed)
    assert part_path(place, 2).stat().st_mtime_ns == kept
    assert (reports[-1].parts_done, reports[-1].runs_done) == (8, 36)
    assert reports[-1].runs_before == 36 - 5 - 5 - 1
    assert list(folder.missing()) == []


def test_jobs_of_an_array_share_a_folder(undisturbed: Path, tmp_path: Path) -> None:
    place = tmp_path / "a"
    for job in (3, 1, 2):
        folder = campaign().run(place, shard=(job, 3))
    assert folder.complete
    assert tree(place) == tree(undisturbed)
    assert campaign().run(tmp_path / "b", shard=(9, 9)).present() == set()


@pytest.mark.parametrize("workers", [1, 3])
def test_threads_of_an_executor_give_the_same_folder(undisturbed: Path, tmp_path: Path, workers: int) -> None:
    with ThreadPoolExecutor(workers) as executor:
        campaign().run(tmp_path / "a", executor=executor)
    assert tree(tmp_path / "a") == tree(undisturbed)


def test_started_processes_give_the_same_folder(undisturbed: Path, tmp_path: Path) -> None:
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as executor:
        campaign().run(tmp_path / "a", executor=executor)
    assert tree(tmp_path / "a") == tree(undisturbed)


class Lost(Executor):
    """An executor whose workers die."""

    def submit(self, *_: Any, **__: Any) -> Future[Any]:
        future: Future[Any] = Future()
        future.set_exception(BrokenProcessPool("a worker died"))
        return future


def test_lost_workers_are_an_error_that_says_how_to_go_on(tmp_path: Path) -> None:
    with pytest.raises(
        sm.errors.SimulationError, match=r"able to keep its workers .*the same call goes on.*BrokenProcessPool"
    ):
        campaign().run(tmp_path / "a", executor=Lost())
    assert campaign().run(tmp_path / "a").complete


def test_an_interrupt_leaves_whole_parts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("seismass.studies.campaign.engine.SECONDS_BETWEEN_REPORTS", 0.0)

    def interrupt(progress: sm.campaign.CampaignProgress) -> None:
        if progress.parts_done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        campaign(part_runs=1).run(tmp_path / "one", progress=interrupt)
    folder = sm.campaign.CampaignFolder(tmp_path / "one")
    assert 0 < len(folder.present()) < folder.parts
    assert set(folder.verify()["problem"].to_list()) == {None}
    assert folder.run().complete


@pytest.mark.parametrize(
    ("changes", "differing"),
    [
        ({"part_runs": 6}, "part_runs"),
        ({"peaks_only": True}, "peaks_only, columns"),
        ({"single": True}, "single"),
        ({"columns": ["slips"]}, "columns"),
    ],
)
def test_a_folder_of_other_options_is_refused(undisturbed: Path, changes: dict[str, Any], differing: str) -> None:
    before = tree(undisturbed)
    with pytest.raises(sm.errors.InvalidOption, match=rf"one of other inputs \(they differ in {differing}\)"):
        campaign(**changes).run(undisturbed)
    assert tree(undisturbed) == before


def test_a_folder_of_other_scenes_or_motions_is_refused(undisturbed: Path) -> None:
    grid = sm.Grid.product(BUILDING, mass_ratio=[0.5, 1.0], mu=[0.1, 0.2, 0.31], scale=[0.5, 1.0, 2.0])
    for made in (
        sm.campaign.Campaign(grid, MOTIONS, part_runs=5),
        sm.campaign.Campaign(product(), MOTIONS[::-1], part_runs=5),
    ):
        with pytest.raises(sm.errors.InvalidOption, match="values of scenes or motions"):
            made.run(undisturbed)


def test_a_folder_with_other_files_is_refused(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("mine")
    with pytest.raises(
        sm.errors.InvalidOption, match=r"must be a new or empty one, or one of a campaign; got .*notes\.txt"
    ):
        campaign().run(tmp_path)
    with pytest.raises(sm.errors.InvalidOption, match="folder of campaign must be a folder; got the file"):
        campaign().run(tmp_path / "notes.txt")
    with pytest.raises(sm.errors.InvalidOption, match="folder of campaign must be one of a campaign"):
        sm.campaign.CampaignFolder(tmp_path)


def test_campaigns_go_beyond_32_bits(tmp_path: Path) -> None:
    many = np.linspace(0.1, 0.5, 2**17)
    grid = sm.Grid.product(BUILDING, mass_ratio=1.0, mu=many, scale=np.linspace(0.5, 2.0, 2**17))
    made = sm.campaign.Campaign(grid, MOTIONS, part_runs=2**16)
    assert made.total == 2**35
    assert made.parts == 2**19
    part = sm.campaign.Campaign(grid, MOTIONS, part_runs=4)
    rows = part.solve(part.parts)
    assert rows["scene"].to_list() == [2**34 - 1, 2**34 - 1, 2**34, 2**34]
    alone = sm.simulate(grid.scene(2**34), MOTIONS[1].scaled(2.0))
    assert rows["peak_drift"][3].to_list() == alone.peak_drift.tolist()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"part_runs": 0}, "part_runs of campaign must be a whole number of at least 1"),
        ({"part_runs": 2**25}, "part_runs of campaign must be at most"),
        ({"columns": ["drift"]}, "columns of campaign must be some of"),
        ({"columns": "slips"}, "columns of campaign must be a list of names"),
        ({"columns": ["residual_slip"], "peaks_only": True}, "left out where peaks_only is chosen"),
        ({"name": 3}, "name of campaign must be text"),
    ],
)
def test_arguments_are_judged(arguments: dict[str, Any], said: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=said):
        campaign(**arguments)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"shard": (0, 3)}, "shard of campaign must be a whole number of at least 1"),
        ({"shard": (4, 3)}, r"shard of campaign must be \(i, n\)"),
        ({"shard": 3}, r"shard of campaign must be \(i, n\)"),
        ({"executor": 2}, "executor of campaign must be a concurrent.futures.Executor"),
        ({"executor": Lost(), "workers": 2}, "workers of campaign must be left out where executor is given"),
        ({"progress": 1}, "progress of campaign must be a callable"),
        ({"threads": 0}, "threads of batch must be a whole number of at least 1"),
    ],
)
def test_engines_are_judged(tmp_path: Path, arguments: dict[str, Any], said: str) -> None:
    with pytest.raises(sm.errors.InvalidOption, match=said):
        campaign().run(tmp_path / "a", **arguments)


def test_motions_are_needed() -> None:
    with pytest.raises(sm.errors.InvalidOption, match="motions of campaign must be at least one; got none"):
        sm.campaign.Campaign(product(), [])
    with pytest.raises(sm.errors.InvalidOption, match="grid of campaign must be a Grid"):
        sm.campaign.Campaign(sm.Scene(BUILDING), MOTIONS)  # type: ignore[arg-type]


def test_progress_estimates_what_is_left() -> None:
    progress = sm.campaign.CampaignProgress(3, 10, 3000, 10000, 1000, 4.0)
    assert progress.runs_per_second == 500.0
    assert progress.seconds_left == 14.0
    assert progress.text == "3 of 10 parts, 3000 of 10000 runs, 500 runs/s, 14 s left"
    assert sm.campaign.CampaignProgress(0, 10, 0, 10000, 0, 0.0).text == "0 of 10 parts, 0 of 10000 runs"
    assert [duration_text(s) for s in (5, 200, 7500, 360000)] == ["5 s", "3 min 20 s", "2 h 5 min", "4 d 4 h"]
