"""Folders of campaigns that are not as they were written: every change is found, and nothing foreign is reused."""

from __future__ import annotations

import hashlib
import json
import os
import random
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import polars as pl
import pytest

import seismass as sm
from seismass.base.files import write_file
from seismass.base.stored_results import checked_content
from seismass.studies.campaign.manifest import part_path

MOTIONS = [sm.Motion([2.0, -2.0, 2.0, 0.0], dt=0.1), sm.Motion([0.0, 3.0, -4.0, 1.0, 2.0], dt=0.1)]


def campaign(**options: Any) -> sm.campaign.Campaign:
    """36 runs in 8 parts."""
    building = sm.Building.uniform(2, 0.3, heights=[3.4, 2.7], yield_shear_over_weight=[0.2, 0.12])
    grid = sm.Grid.product(building, mass_ratio=[0.5, 1.0], mu=[0.1, 0.2, 0.3], scale=[0.5, 1.0, 2.0])
    return sm.campaign.Campaign(grid, MOTIONS, **{"part_runs": 5, **options})


def tree(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def rewrite(path: Path, changes: dict[str, Any]) -> None:
    """Change a manifest as another version would have written it: with its digest, SHA-256 of the sorted JSON."""
    changed = json.loads(path.read_text()) | changes
    del changed["sha256"]
    sha256 = hashlib.sha256(json.dumps(changed, sort_keys=True).encode()).hexdigest()
    path.write_text(json.dumps({**changed, "sha256": sha256}))


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("package_version", "0.0.9", "must be solved by seismass .*; got version 0.0.9"),
        ("bits", "another", "instruction set of this process"),
        ("written_by", {"numpy": "1", "polars": "2"}, "written by numpy .*, polars .*; got numpy 1, polars 2"),
        ("schema_version", 0, "schema_version of campaign must be 3; got 0"),
        ("kind", "report", "must be of the kind"),
    ],
)
def test_a_folder_of_another_version_or_instruction_set_is_refused(
    tmp_path: Path, key: str, value: Any, said: str
) -> None:
    campaign().run(tmp_path / "a", shard=(1, 8))
    path = tmp_path / "a" / "manifest.json"
    rewrite(path, {key: value})
    with pytest.raises(sm.errors.InvalidOption, match=said):
        campaign().run(tmp_path / "a")


def test_a_damaged_part_is_found(tmp_path: Path) -> None:
    folder = campaign().run(tmp_path / "a")
    part_path(folder.path, 3).write_bytes(part_path(folder.path, 3).read_bytes()[:100])
    part_path(folder.path, 5).write_bytes(part_path(folder.path, 4).read_bytes())
    other = campaign(columns=["slips"]).run(tmp_path / "b")
    part_path(folder.path, 7).write_bytes(part_path(other.path, 7).read_bytes())
    problems = dict(folder.verify().select("part", "problem").iter_rows())
    assert problems.pop(3).startswith("is damaged")
    assert problems.pop(5) == "is of other runs"
    assert problems.pop(7) == "is of other inputs"
    assert set(problems.values()) == {None}


def test_one_changed_bit_is_found_whatever_it_changes(tmp_path: Path) -> None:
    """Also in numbers that Parquet reads without a word: each of 200 random bits of random parts."""
    folder = campaign().run(tmp_path / "a")
    rng = random.Random(3)
    for _ in range(200):
        path = part_path(folder.path, rng.randint(1, folder.parts))
        whole = path.read_bytes()
        damaged = bytearray(whole)
        bit = rng.randrange(8 * len(whole))
        damaged[bit // 8] ^= 1 << bit % 8
        path.write_bytes(damaged)
        assert folder.verify()["problem"].drop_nulls().len() == 1, (path.name, bit)
        path.write_bytes(whole)
    assert folder.verify()["problem"].drop_nulls().len() == 0


def zeroed(path: Path) -> None:
    """Set all peaks of a part to 0, with the metadata that it has."""
    frame = pl.read_parquet(path).with_columns(peak_base_shear=0.0)
    metadata = {key: value for key, value in pl.read_parquet_metadata(path).items() if key != "ARROW:schema"}
    frame.write_parquet(path, metadata=metadata)


def to_folder(path: Path) -> None:
    path.unlink()
    path.mkdir()


def to_link(path: Path) -> None:
    path.symlink_to(path.rename(path.parent.parent.parent / "elsewhere"))


def to_pipe(path: Path) -> None:
    path.unlink()
    os.mkfifo(path)


@pytest.mark.parametrize(
    ("harm", "said"),
    [
        (zeroed, "is damaged: its bytes are not those of its digest"),
        (lambda path: path.write_bytes(path.read_bytes()[:-20]), "is damaged"),
        (lambda path: path.write_bytes(b""), "is damaged: it is cut off"),
        (lambda path: path.write_bytes(part_path(path.parent.parent, 4).read_bytes()), "is of other runs"),
        (to_folder, "is a folder and no file"),
        (to_link, "is a link and no file"),
        (to_pipe, "cannot be read: no regular file"),
    ],
)
def test_a_part_that_is_not_as_it_was_written_is_not_reused(
    tmp_path: Path, harm: Callable[[Path], object], said: str
) -> None:
    folder = campaign().run(tmp_path / "a")
    assert folder.scan().collect().height == folder.manifest["runs"]
    harm(part_path(folder.path, 3))
    for reader in (folder, sm.campaign.CampaignFolder(folder.path)):
        with pytest.raises(sm.errors.InvalidOption, match=rf"got part-0000003.parquet, which {said}"):
            reader.scan()
    if harm is zeroed:
        assert folder.scan(force=True).filter(pl.col("peak_base_shear") == 0.0).collect().height > 0
    with pytest.raises(
        sm.errors.InvalidOption, match=rf"parts .* must be whole .*; got part-0000003.parquet, which {said}"
    ):
        campaign().run(tmp_path / "a")
    with pytest.raises(sm.errors.InvalidOption, match=said):
        folder.run()
    assert dict(folder.verify().select("part", "problem").iter_rows())[3].startswith(said)
    assert 3 not in folder.present() or part_path(folder.path, 3).is_file()
    campaign().run(tmp_path / "a", shard=(1, 2 * folder.parts))  # has not this part


def test_one_bit_of_any_part_is_seen_by_a_scan(tmp_path: Path) -> None:
    folder, chooser = campaign().run(tmp_path / "a"), random.Random(7)
    for _ in range(60):
        path = part_path(folder.path, chooser.randint(1, folder.parts))
        whole = path.read_bytes()
        bit = chooser.randrange(8 * len(whole))
        path.write_bytes(whole[: bit // 8] + bytes([whole[bit // 8] ^ 1 << bit % 8]) + whole[bit // 8 + 1 :])
        with pytest.raises(sm.errors.InvalidOption, match=f"got {path.name}, which"):
            sm.campaign.CampaignFolder(folder.path).scan()
        path.write_bytes(whole)
    assert sm.campaign.CampaignFolder(folder.path).scan().collect().height == folder.manifest["runs"]


def test_parts_without_a_manifest_are_refused(tmp_path: Path) -> None:
    folder = campaign().run(tmp_path / "a")
    (folder.path / "manifest.json").unlink()
    before = tree(folder.path)
    for made in (campaign(), campaign(single=True)):
        with pytest.raises(sm.errors.InvalidOption, match=r"whose parts have a manifest.json .* of unknown inputs"):
            made.run(tmp_path / "a")
    assert tree(folder.path) == before


@pytest.mark.parametrize("name", ["axes.parquet", "motions.parquet"])
def test_edited_inputs_of_a_folder_are_refused(tmp_path: Path, name: str) -> None:
    folder = campaign().run(tmp_path / "a")
    path = folder.path / name
    whole = path.read_bytes()
    table = pl.read_parquet(path)
    others = table.with_columns(pl.col(pl.Float64) * 1.5)

    def all_refuse(said: str) -> None:
        again = sm.campaign.CampaignFolder(folder.path)
        for call in (lambda: campaign().run(folder.path), again.run, again.verify, lambda: again.scan()):
            with pytest.raises(sm.errors.InvalidOption, match=said):
                call()

    others.write_parquet(path)
    all_refuse("has no digest of itself")
    path.write_bytes(whole[: len(whole) // 2])
    all_refuse("is damaged")
    path.unlink()
    path.mkdir()
    all_refuse("is a folder and no file")
    path.rmdir()
    write_file(path, checked_content(others, {}))  # by one who knows how the digest is made
    with pytest.raises(sm.errors.InvalidOption, match="must be of the values of this campaign"):
        campaign().run(folder.path)
    with pytest.raises(sm.errors.InvalidOption, match="one of other inputs"):
        sm.campaign.CampaignFolder(folder.path).verify()
    path.unlink()
    campaign().run(folder.path)  # written again
    assert path.read_bytes() == whole


@pytest.mark.parametrize(
    "text",
    [
        "[" * 100_000,
        "{}",
        "",
        "null",
        '{"kind": "seismass campaign"}',
        '{"kind": "seismass campaign", "schema_version": 3, "parts": "x"}',
    ],
)
def test_a_damaged_manifest_is_an_error_of_the_package(tmp_path: Path, text: str) -> None:
    folder = campaign().run(tmp_path / "a", shard=(1, 8))
    (folder.path / "manifest.json").write_text(text)
    with pytest.raises(sm.errors.InvalidOption, match=r"manifest\.json|schema_version"):
        sm.campaign.CampaignFolder(folder.path)


@pytest.mark.parametrize(
    "changes", [{"parts": 10**15}, {"parts": -1}, {"grid": {}}, {"grid": {"axes": 3}}, {"runs": 5}, {"columns": [1]}]
)
def test_a_manifest_of_other_content_is_refused(tmp_path: Path, changes: dict[str, Any]) -> None:
    folder = campaign().run(tmp_path / "a", shard=(1, 8))
    path = folder.path / "manifest.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | changes))
    with pytest.raises(sm.errors.InvalidOption, match="must be as it was written"):
        sm.campaign.CampaignFolder(folder.path)
    rewrite(path, changes)
    with pytest.raises(sm.errors.InvalidOption):
        sm.campaign.CampaignFolder(folder.path).verify()


def test_a_link_in_place_of_the_parts_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    (tmp_path / "victim").mkdir()
    (tmp_path / "a" / "parts").symlink_to(tmp_path / "victim")
    with pytest.raises(sm.errors.InvalidOption, match=r"parts of campaign must be a folder; got .*, a link"):
        campaign().run(tmp_path / "a")
    assert list((tmp_path / "victim").iterdir()) == []


@pytest.mark.skipif(sys.platform != "linux", reason="names of other systems are UTF-8")
def test_a_folder_whose_name_is_not_utf_8_is_refused_at_once(tmp_path: Path) -> None:
    place = tmp_path / os.fsdecode(b"\xff")
    with pytest.raises(sm.errors.InvalidOption, match="folder of campaign must be in UTF-8"):
        campaign().run(place)
    assert not place.exists()
