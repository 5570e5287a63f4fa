"""Campaign files and the command `seismass campaign`: every key, every refusal, and a folder that goes on."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import polars as pl
import pytest
from polars.testing import assert_frame_equal

import seismass as sm
from seismass import cli
from seismass.studies.campaign import example_description
from seismass.studies.campaign.manifest import part_path

BASE: dict[str, Any] = {
    "name": "trial",
    "part_runs": 30,
    "peaks_only": True,
    "motions": {"builtin": "seven"},
    "building": {"storeys": 2, "period": 0.3, "yield_shear_over_weight": [0.2, 0.12]},
    "grid": {"mass_ratio": [0.5, 1.0], "mu": {"from": 0.1, "to": 0.4, "count": 4}, "scale": [0.5, 1.0]},
}
TEXT = """
name = "trial"
part_runs = 30
peaks_only = true
[motions]
builtin = "seven"
[building]
storeys = 2
period = 0.3
yield_shear_over_weight = [0.2, 0.12]
[grid]
mass_ratio = [0.5, 1.0]
mu = { from = 0.1, to = 0.4, count = 4 }
scale = [0.5, 1.0]
"""


def changed(**changes: Any) -> dict[str, Any]:
    """The base with tables updated; None removes a key."""
    found = {key: dict(value) if isinstance(value, dict) else value for key, value in BASE.items()}
    for key, value in changes.items():
        if isinstance(value, dict) and isinstance(found.get(key), dict):
            found[key] = {name: item for name, item in (found[key] | value).items() if item is not None}
        elif value is None:
            found.pop(key, None)
        else:
            found[key] = value
    return found


def test_a_file_says_what_the_calls_say(tmp_path: Path) -> None:
    (tmp_path / "c.toml").write_text(TEXT)
    (tmp_path / "c.json").write_text(json.dumps(BASE))
    building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.2, 0.12])
    grid = sm.Grid.product(building, mass_ratio=[0.5, 1.0], mu=np.linspace(0.1, 0.4, 4), scale=[0.5, 1.0])
    own = sm.campaign.Campaign(grid, sm.builtin_suite("seven"), part_runs=30, peaks_only=True)
    for source in (tmp_path / "c.toml", tmp_path / "c.json", BASE):
        found = sm.campaign.read_campaign(source)
        assert found.sha256 == own.sha256
        assert (found.name, found.total, found.parts) == ("trial", 112, 4)


def test_motions_are_read_and_scaled_as_by_the_functions(tmp_path: Path) -> None:
    suite, target = sm.builtin_suite("eleven"), sm.TargetSpectrum.asce7(1.0, 0.6)
    for scaling, scale in (("asce7-10", sm.scaling.scale_asce7_10), ("asce7-16", sm.scaling.scale_asce7_16)):
        found = sm.campaign.read_campaign(
            changed(motions={"builtin": "eleven", "scaling": scaling, "target": "asce7:1.0:0.6", "period": 0.5})
        )
        for item, record, factor in zip(found.motions, suite, scale(suite, target, 0.5).factors, strict=True):
            assert item.motion == record.scaled(float(factor)).motion
    folder = tmp_path / "records"
    folder.mkdir()
    source = suite[0].source
    assert source is not None
    (folder / source.name).write_bytes(source.read_bytes())
    text = TEXT.replace('builtin = "seven"', 'records = "records"')
    (tmp_path / "c.toml").write_text(text)
    found = sm.campaign.read_campaign(tmp_path / "c.toml")
    assert [item.name for item in found.motions] == [suite[0].name]
    assert found.motions[0].file == source.name
    (tmp_path / "site.csv").write_text("period,sa (g)\n0.01,0.4\n0.3,1.1\n3,0.2\n")
    (tmp_path / "c.toml").write_text(
        TEXT.replace('builtin = "seven"', 'builtin = "seven"\nscaling = "asce7-10"\ntarget = "site.csv"')
    )
    seven, site = sm.builtin_suite("seven"), sm.TargetSpectrum.from_csv(tmp_path / "site.csv")
    factor = float(sm.scaling.scale_asce7_10(seven, site, 1.0).factors[0])
    assert sm.campaign.read_campaign(tmp_path / "c.toml").motions[0].motion == seven[0].scaled(factor).motion


def test_the_example_is_a_campaign_that_runs(tmp_path: Path) -> None:
    campaign = sm.campaign.read_campaign(example_description())
    document = tomllib.loads(example_description().read_text(encoding="utf-8"))
    lengths = [3, 3, 3, 6, 4, 8]
    assert len(campaign.grid) == int(np.prod(lengths))
    assert {"R", "occupancy", "mu_s", "scale"} <= set(campaign.grid.table(1, 1).columns)
    assert document["name"] == campaign.name
    # The commented sample is valid, too.
    sampled = document | {"sample": {"samples": 16, "method": "sobol", "seed": 1}}
    sampled["grid"] = document["grid"] | {
        "mu": {"distribution": "lognormal", "median": 0.4, "sigma": 0.25},
        "occupancy": {"distribution": "beta", "mean": 0.7, "deviation": 0.15},
    }
    small = sm.campaign.read_campaign(sampled)
    assert len(small.grid) == 16
    rows = small.run(tmp_path / "a").scan().collect()
    assert rows.filter(pl.col("status") == "failed").is_empty()


@pytest.mark.parametrize(
    ("value", "low", "high"),
    [
        ({"distribution": "lognormal", "median": 0.4, "sigma": 0.25}, 0.2, 0.9),
        ({"distribution": "normal", "mean": 0.4, "deviation": 0.02}, 0.3, 0.5),
        ({"distribution": "beta", "mean": 0.7, "deviation": 0.1}, 0.3, 1.0),
        ({"distribution": "uniform", "low": 0.2, "high": 0.3}, 0.2, 0.3),
        ({"distribution": "triang", "c": 0.5, "loc": 0.2, "scale": 0.1}, 0.2, 0.3),
        ([0.2, 0.3], 0.2, 0.3),
        (0.25, 0.25, 0.25),
    ],
)
def test_distributions_of_a_sample(value: Any, low: float, high: float) -> None:
    table = sm.campaign.read_campaign(changed(grid={"mu": value}, sample={"samples": 64, "seed": 3})).grid.table()
    assert table["mu_s"].min() >= low  # type: ignore[operator]
    assert table["mu_s"].max() <= high  # type: ignore[operator]


def test_blocks_may_have_distributions_and_samples_one_motion() -> None:
    draw = {"distribution": "uniform", "low": 0.2, "high": 0.3}
    found = sm.campaign.read_campaign(
        changed(grid={"mu": [draw, draw]}, sample={"samples": 32, "method": "latin_hypercube", "one_motion": True})
    )
    assert found.total == 32
    assert found.grid.table()["mu_s"].list.len().unique().to_list() == [2]


def test_ranges_are_linear_or_logarithmic() -> None:
    found = sm.campaign.read_campaign(changed(grid={"scale": {"from": 0.25, "to": 4.0, "count": 5, "spacing": "log"}}))
    assert sorted(found.grid.table()["scale"].unique()) == pytest.approx([0.25, 0.5, 1.0, 2.0, 4.0], rel=1e-12)


@pytest.mark.parametrize(
    ("document", "said"),
    [
        (changed(parts=3), r"parts of campaign must be one of the keys .*; got an unknown key"),
        (changed(grid=None), "grid of campaign must be given; got nothing"),
        (changed(motions=None), "motions of campaign must be given, with builtin or records; got nothing"),
        (changed(motions={"builtin": "nine"}), "motions.builtin of campaign must be seven or eleven; got 'nine'"),
        (changed(motions={"records": "a"}), "motions.records of campaign must be left out where motions.builtin"),
        (changed(motions={"scaling": "pga"}), "motions.scaling of campaign must be one of none, asce7-10, asce7-16"),
        (
            changed(motions={"target": "asce7:1:0.6"}),
            "motions.target of campaign must be left out where motions",
        ),
        (changed(grid={"storeys": 2}), "grid.storeys of campaign must be left out where building is given; got both"),
        (changed(building=None), "grid.storeys of campaign must be given, or building; got nothing"),
        (changed(grid={"friction": 0.3}), r"grid.friction of campaign must be one of the keys"),
        (changed(peaks_only=1), "peaks_only of campaign must be true or false; got 1"),
        (changed(columns="slips"), "columns of campaign must be a list of names; got 'slips'"),
        (changed(part_runs="many"), "part_runs of campaign must be a whole number"),
        (changed(grid={"mu": {"from": 0.1, "to": 0.4}}), "grid.mu.count of campaign must be given; got nothing"),
        (changed(grid={"mu": {"from": 0.1, "to": 0.4, "count": 3, "step": 1}}), "grid.mu.step of campaign must be one"),
        (
            changed(grid={"mu": {"from": 0.0, "to": 0.4, "count": 3, "spacing": "log"}}),
            "grid.mu.from of campaign must be positive where the spacing is log; got 0",
        ),
        (
            changed(grid={"mu": {"from": 0.1, "to": 0.4, "count": 3, "spacing": "cubic"}}),
            "grid.mu.spacing of campaign must be linear or log; got 'cubic'",
        ),
        (
            changed(grid={"mu": {"distribution": "uniform", "low": 0.1, "high": 0.2}}),
            "grid.mu.distribution of campaign must be left out where there is no table `sample`",
        ),
        (changed(sample={"method": "sobol"}), "sample.samples of campaign must be given; got nothing"),
        (changed(sample={"samples": 4, "draws": 1}), "sample.draws of campaign must be one of the keys"),
        (
            changed(sample={"samples": 4}, grid={"mu": {"distribution": "cauchit"}}),
            "grid.mu.distribution of campaign must be lognormal",
        ),
        (
            changed(sample={"samples": 4}, grid={"mu": {"distribution": "lognormal", "median": -1.0, "sigma": 0.1}}),
            "grid.mu.distribution of campaign must be one that exists",
        ),
        (
            changed(sample={"samples": 4}, grid={"mu": {"distribution": "uniform", "low": 0.3, "high": 0.2}}),
            "grid.mu.high - low of campaign must be positive",
        ),
        (
            changed(sample={"samples": 4}, grid={"mu": {"distribution": "gamma", "median": 1.0}}),
            "given with the parameters of scipy.stats.gamma",
        ),
        (
            changed(sample={"samples": 4}, grid={"mu": {"distribution": "gamma", "a": -1.0}}),
            "given with parameters that scipy.stats.gamma allows",
        ),
        (changed(grid={"R": 2.0, "design": {"share": 0.25}}), "grid.design.target of campaign must be given"),
        (changed(grid={"R": 2.0, "design": {"target": "asce7:1:0.6", "part": 1}}), "grid.design.part of campaign must"),
    ],
)
def test_what_a_file_must_not_say(document: dict[str, Any], said: str) -> None:
    with pytest.raises(sm.errors.InvalidCampaignFile, match=said):
        sm.campaign.read_campaign(document)


def test_other_errors_of_a_file_are_those_of_what_it_describes(tmp_path: Path) -> None:
    with pytest.raises(sm.errors.InvalidScene, match="R of grid must be left out where yield_shear_over_weight"):
        sm.campaign.read_campaign(
            changed(grid={"R": 2.0, "yield_shear_over_weight": 0.2, "design": {"target": "asce7:1:0.6"}})
        )
    with pytest.raises(sm.errors.InvalidCampaignFile, match=r"suffix of campaign file c\.yaml must be"):
        sm.campaign.read_campaign(tmp_path / "c.yaml")
    with pytest.raises(sm.errors.InvalidCampaignFile, match="must be a file that can be read"):
        sm.campaign.read_campaign(tmp_path / "missing.toml")


def run(*arguments: object) -> int:
    return cli.main(["campaign", *(str(argument) for argument in arguments)])


def test_the_command_runs_goes_on_and_looks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file, out = tmp_path / "c.toml", tmp_path / "results"
    file.write_text(TEXT)
    assert run(file, "--out", out, "--shard", "2/2") == 0
    assert "runs     52 of 112, 0 failed\nparts    2 of 4, 2 missing" in capsys.readouterr().out
    assert run(out, "--status", "--json") == 0
    state = json.loads(capsys.readouterr().out)
    assert (state["parts_present"], state["parts"], state["complete"]) == (2, 4, False)
    assert run(out, "--jobs", 1) == 0
    assert "parts    4 of 4\n" in capsys.readouterr().out
    batch = sm.simulate_many(sm.campaign.read_campaign(file).grid, sm.builtin_suite("seven"), peaks_only=True)
    rows = sm.campaign.CampaignFolder(out).scan().collect()
    assert_frame_equal(rows.select("peak_drift", "peak_slip"), batch.select("peak_drift", "peak_slip"))
    assert run(file, "--out", out, "--verify") == 0
    capsys.readouterr()
    part_path(out, 3).write_bytes(b"torn")
    assert run(out, "--verify") == 1
    assert "part 3: is damaged" in capsys.readouterr().out
    assert run(out, "--status") == 1
    said = capsys.readouterr().out
    assert "parts    4 of 4\n" in said
    assert "damaged  parts 3; remove them, and the same command solves them again" in said
    assert run(out) == 2
    assert "must be whole and of this campaign" in capsys.readouterr().err
    part_path(out, 3).unlink()
    part_path(out, 3).mkdir()
    assert run(out, "--status") == 1
    assert "parts    3 of 4, 1 missing\n" in capsys.readouterr().out
    part_path(out, 3).rmdir()
    assert run(out) == 0
    assert run(out, "--verify") == 0


def test_the_command_starts_workers(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("distributed", reason="distributed is not installed: no workers are started")
    file = tmp_path / "c.toml"
    file.write_text(TEXT)
    assert run(file, "--out", tmp_path / "a", "--workers", 2) == 0
    assert run(file, "--out", tmp_path / "b") == 0
    for part in (1, 2, 3, 4):
        assert part_path(tmp_path / "a", part).read_bytes() == part_path(tmp_path / "b", part).read_bytes()
    assert "parts    4 of 4" in capsys.readouterr().out


def test_the_example_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--example") == 0
    assert capsys.readouterr().out == example_description().read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["c.toml"], "--out of command must be given with a campaign file; got none"),
        (
            ["missing.toml", "--out", "a"],
            "FILE of command must be a campaign file or the folder of a campaign",
        ),
        (["folder", "--out", "a"], "--out of command must be left out where a folder goes on; got a"),
        (["folder"], "folder of campaign must be one of a campaign, with a manifest.json; got folder"),
        (["c.toml", "--out", "folder"], "must be a new or empty one, or one of a campaign; got folder with notes"),
        (
            ["c.toml", "--out", "a", "--scheduler", "tcp://127.0.0.1:1"],
            "scheduler of campaign must be one that ans",
        ),
    ],
)
def test_wrong_use_is_one_line_and_code_2(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    said: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT", "1s")
    if "--scheduler" in arguments:
        distributed = pytest.importorskip("distributed", reason="distributed is not installed: no workers are started")
        dask = pytest.importorskip("dask", reason="dask is not installed: no workers are started")
        assert distributed
        dask.config.refresh()
    Path("c.toml").write_text(TEXT)
    Path("folder").mkdir()
    Path("folder/notes.txt").write_text("mine")
    assert run(*arguments) == 2
    error = capsys.readouterr().err
    assert error.startswith("seismass: error: ")
    assert said in error
    assert error.count("\n") == 1


@pytest.mark.parametrize("value", ["0/3", "4/3", "3", "a/b", "1/0"])
def test_a_shard_is_i_of_n(value: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        run("c.toml", "--out", "a", "--shard", value)
    assert ended.value.code == 2
    assert "must be I/N with I from 1 to N" in capsys.readouterr().err
