"""`seismass scale`: each method as the library has it, selection, files written, options that do not fit."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.assessment.models import with_mass
from seismass.cli import main
from seismass.motions.records.builtin import data_directory

SUITE = sm.builtin_suite("seven")
TARGET = sm.TargetSpectrum.asce7()


def scaled(capsys: pytest.CaptureFixture[str], *options: object) -> dict:
    assert main(["scale", "--json", *map(str, options)]) == 0
    document: dict = json.loads(capsys.readouterr().out)
    return document


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Twelve records: the built-in ones under other names and steps."""
    sources = [record.source for record in SUITE if record.source is not None]
    for number in range(12):
        text = sources[number % 7].read_text()
        (tmp_path / f"R{number:02}.AT2").write_text(text)
    return tmp_path


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ([], sm.scaling.scale_asce7_10(SUITE, TARGET)),
        (["--method", "least-squares", "--period", 0.5], sm.scaling.scale_least_squares(SUITE, TARGET, 0.5)),
        (["--method", "least-squares-linear"], sm.scaling.scale_least_squares(SUITE, TARGET, space="linear")),
        (["--method", "sa-t1", "--period", 0.7], sm.scaling.scale_sa_t1(SUITE, TARGET, 0.7)),
        (
            ["--method", "mps", "--reduction", 4, "--overstrength", 1, "--second-slope", 0, "--deformation", "median"],
            sm.scaling.scale_modal_pushover(
                SUITE, TARGET, reduction=4, overstrength=1, second_slope=0, deformation="median"
            ),
        ),
        (
            ["--method", "mps", "--yield-coefficient", 0.2, "--target", "ec8:1:C:0.3"],
            sm.scaling.scale_modal_pushover(
                SUITE, sm.TargetSpectrum.eurocode8(1, "C", agr_g=0.3), yield_coefficient=0.2
            ),
        ),
    ],
    ids=["asce7-10", "least-squares", "linear", "sa-t1", "mps", "mps towards ec8"],
)
def test_methods_are_those_of_the_library(
    capsys: pytest.CaptureFixture[str], options: list[object], expected: sm.scaling.ScalingResult
) -> None:
    document = scaled(capsys, *options)
    assert [row["factor"] for row in document["motions"]] == expected.factors.tolist()
    assert document["method"] == expected.method
    assert document["least_ratio"] == expected.least_ratio
    assert [row["misfit"] for row in document["motions"]] == expected.misfit.tolist()
    assert set(expected.remarks) <= set(document["remarks"])


def test_asce7_16_asks_for_eleven(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["scale", "--method", "asce7-16", "--suite", "seven"]) == 2
    assert "at least eleven motions (ASCE/SEI 7-16, 16.2.2); got 7" in capsys.readouterr().err
    # The built-in suite of eleven is taken where none is named.
    built_in = scaled(capsys, "--method", "asce7-16")
    assert [row["record"] for row in built_in["motions"]] == [record.name for record in sm.builtin_suite("eleven")]
    assert built_in["least_ratio"] == pytest.approx(0.9, abs=1e-12)
    document = scaled(capsys, "--method", "asce7-16", "--records", folder, "--lowest-period", 0.1)
    assert document["least_ratio"] == pytest.approx(0.9, abs=1e-12)
    assert document["spectrum"]["period"][0] == pytest.approx(0.1, rel=1e-12)


def test_pairs_of_a_folder_are_scaled_in_their_maximum_direction(
    shared: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = shared / "records" / "fema_p695_far_field"
    document = scaled(capsys, "--method", "asce7-16", "--pairs", "--records", folder)
    pairs = sm.records.find_pairs(folder)
    assert [row["record"] for row in document["motions"]] == [pair.name for pair in pairs]
    found = sm.scaling.scale_asce7_16(pairs, TARGET)
    assert [row["factor"] for row in document["motions"]] == found.factors.tolist()
    assert found.least_ratio == pytest.approx(0.9, abs=1e-12)
    # RotD100 of a pair by the function of its own.
    expected = found.factors[3] * sm.records.rotd(pairs[3], found.periods)[100]
    np.testing.assert_allclose(found.spectra[3], expected, rtol=1e-12)
    assert "single components" not in " ".join(document["remarks"])


def test_selection_names_what_was_not_chosen(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    document = scaled(capsys, "--records", folder, "--select", 3, "--max-per-event", 12, "--max-per-station", 12)
    steps = [row["step"] for row in document["selection"]]
    assert sorted(step for step in steps if step) == [1, 2, 3]
    expected = sm.scaling.select_records(folder, TARGET, 3, max_per_event=12, max_per_station=12)
    assert [row["record"] for row in document["motions"]] == [record.name for record in expected.suite]
    assert main(["scale", "--records", str(folder), "--select", "3"]) == 0
    printed = capsys.readouterr().out
    assert printed.count("not chosen") == 1
    assert printed.count(": ") >= 9


def test_table_and_figure_are_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    table, figure = tmp_path / "factors.csv", tmp_path / "scaling.png"
    options = ["--method", "mps", "--reduction", "2", "--out", str(table), "--plot", str(figure)]
    assert main(["scale", *options]) == 0
    assert "misfit: root mean square" in capsys.readouterr().out
    expected = sm.scaling.scale_modal_pushover(SUITE, TARGET, reduction=2.0)
    frame = pl.read_csv(table)
    np.testing.assert_allclose(frame["factor"], expected.factors, rtol=1e-14)
    roots = [[float(root) for root in str(cell).split()] for cell in frame["roots"]]
    assert [len(several) for several in roots] == [len(several) for several in expected.roots]
    assert figure.read_bytes().startswith(b"\x89PNG")
    svg = tmp_path / "scaling.svg"
    assert main(["scale", "--plot", str(svg)]) == 0
    assert "<svg" in svg.read_text()


def test_a_building_gives_period_and_pushover(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["building", "--example"]) == 0
    file = tmp_path / "warehouse.toml"
    file.write_text(capsys.readouterr().out)
    own = sm.read_building(file)
    target = sm.TargetSpectrum.asce7(0.8, 0.5)
    loaded = with_mass(own.scene(target), own.goods_mass).building
    expected = sm.scaling.scale_modal_pushover(SUITE, target, loaded)
    document = scaled(capsys, "--method", "mps", "--building", file, "--sds", 0.8, "--sd1", 0.5)
    assert [row["factor"] for row in document["motions"]] == expected.factors.tolist()
    assert document["period"] == pytest.approx(own.period(own.goods_mass), rel=1e-12)
    assert any(remark.startswith("P-Delta is left out") for remark in document["remarks"])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--reduction", "4"], "--reduction of scale must be left out with asce7-10; got 4"),
        (["--lowest-period", "0.1"], "--lowest-period of scale must be left out with asce7-10; got 0.1"),
        (["--method", "sa-t1", "--building", "b.toml"], "--building of scale must be left out with sa-t1; got b.toml"),
        (
            ["--method", "mps", "--building", "b.toml", "--reduction", "4"],
            "--reduction of scale must be left out with --building; got 4",
        ),
        (["--pairs"], "--pairs of scale must be given with a rule of a code and --records; got asce7-10 without"),
        (
            ["--pairs", "--method", "asce7-16", "--records", ".", "--select", "3"],
            "--select of scale must be left out with --pairs; got 3",
        ),
        (
            ["--pairs", "--method", "asce7-16", "--records", str(data_directory() / "synthetic")],
            "synthetic must be at least one; got none in",
        ),
        (["--max-per-event", "3"], "--max-per-event of scale must be left out without --select; got 3"),
        (["--plot", "figure.pdf"], "--plot of scale must be a file with the suffix .png or .svg; got figure.pdf"),
        (["--method", "mps"], "--building of scale must be given with mps, one of them; got none"),
        (["--out", "no_folder/factors.csv"], "No such folder: 'no_folder'"),
        (["--target", "ec8:1:C:0.3", "--sds", "1"], "sds of target spectrum must be left out where --target is given"),
        (["--select", "8"], "records of selection must be at least 8 to choose; got 7 of 7 within the limits"),
    ],
)
def test_options_that_do_not_fit_are_refused(
    capsys: pytest.CaptureFixture[str], options: list[str], message: str
) -> None:
    assert main(["scale", *options]) == 2
    assert message in capsys.readouterr().err
