"""`seismass spectrum`: what it takes for a record and what for a list of them, and what it leaves out."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.cli import main
from seismass.motions.records.formats.common import NO_COUNT

SAMPLES = np.sin(0.3 * np.arange(400)) * np.hanning(400)
PERIODS = (0.2, 0.5)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "two.csv").write_text(
        "time (s),acceleration (m/s2)\n" + "".join(f"{0.01 * i:.2f},{x:.6f}\n" for i, x in enumerate(SAMPLES))
    )
    (tmp_path / "one.txt").write_text("".join(f"{100.0 * x:.4f}\n" for x in SAMPLES))
    (tmp_path / "list.csv").write_text('name, "file", dt, unit\nfirst, one.txt, 0.01, cm/s2\n')
    return tmp_path


def spectrum(*arguments: object) -> int:
    return main(["spectrum", *map(str, arguments), "--period", *map(str, PERIODS)])


@pytest.mark.parametrize(
    ("arguments", "name"),
    [(["two.csv"], "two"), (["one.txt", "--dt", 0.01, "--unit", "cm/s2"], "one"), (["list.csv"], "first")],
)
def test_a_csv_is_a_list_where_it_has_a_column_of_files(
    folder: Path, capsys: pytest.CaptureFixture[str], arguments: list[object], name: str
) -> None:
    assert spectrum(folder / str(arguments[0]), *arguments[1:]) == 0
    printed = capsys.readouterr()
    # Text that states no number of points cannot be checked for its end, which is said.
    assert printed.err == f"seismass: motion 1, {name}: {NO_COUNT}\n"
    table = pl.read_csv(printed.out.encode())
    assert table["record"].to_list() == [name] * 2
    expected = sm.response_spectrum(sm.Motion(SAMPLES, 0.01), PERIODS)[0] / 9.80665
    # The files have six decimals of m/s2.
    np.testing.assert_allclose(table["psa_g"], expected, rtol=1e-5)


def test_true_acceleration_is_printed_in_g(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert spectrum(folder / "two.csv", "--kind", "sa", "--damping", 0.1) == 0
    table = pl.read_csv(capsys.readouterr().out.encode())
    expected = sm.response_spectrum(sm.Motion(SAMPLES, 0.01), PERIODS, 0.1, "acceleration")[0] / 9.80665
    np.testing.assert_allclose(table["sa_g"], expected, rtol=1e-5)  # of six decimals in the file


def test_inelastic_spectra_are_printed(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert spectrum(folder / "two.csv", "--ductility", 2, 4, "--overstrength", 1, "--second-slope", 0) == 0
    table = pl.read_csv(capsys.readouterr().out.encode())
    found = sm.spectra.inelastic_spectrum(
        sm.Motion(SAMPLES, 0.01), PERIODS, ductility=[2, 4], overstrength=1.0, second_slope=0.0
    )
    np.testing.assert_allclose(table["strength"], found.strength.ravel(), rtol=1e-4)
    assert table["period"].to_list() == [0.2, 0.5, 0.2, 0.5]
    assert table["damping"].to_list() == [0.05] * 4
    assert spectrum(folder / "two.csv", "--strength", 0.02, "--damping", 0.02, 0.05) == 0
    table = pl.read_csv(capsys.readouterr().out.encode())
    assert table["damping"].to_list() == [0.02, 0.02, 0.05, 0.05]
    assert (table["strength"] == 0.02).all()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--overstrength", 1], "--overstrength of spectrum must be left out without --strength or --ductility; got 1"),
        (["--strength", 0.1, "--kind", "sd"], "--kind of spectrum must be left out with --strength or --ductility"),
        (["--ductility", 0.5], "ductility of inelastic spectrum must be at least 1; got 0.5"),
    ],
)
def test_options_that_do_not_fit_are_refused(
    folder: Path, capsys: pytest.CaptureFixture[str], options: list[object], message: str
) -> None:
    assert spectrum(folder / "two.csv", *options) == 2
    assert message in capsys.readouterr().err


def test_what_the_file_does_not_state_is_asked_for(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert spectrum(folder / "one.txt", "--unit", "cm/s2") == 2
    assert "dt of one.txt must be given" in capsys.readouterr().err
    assert spectrum(folder / "one.txt", "--dt", 0.01) == 2
    assert "unit of one.txt must be" in capsys.readouterr().err


@pytest.mark.parametrize(("option", "value"), [("--dt", "0.01"), ("--unit", "g")])
def test_a_list_states_steps_and_units_itself(
    folder: Path, capsys: pytest.CaptureFixture[str], option: str, value: str
) -> None:
    assert spectrum(folder / "list.csv", option, value) == 2
    message = f"{option} of list.csv must be left out for a folder or a list of records; got {value}"
    assert message in capsys.readouterr().err


def test_what_is_left_out_is_said_beside_the_table(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    motion = next(record.source for record in sm.builtin_suite() if record.source is not None).read_text()
    for number, name in enumerate(("BRA225.AT2", "BRA315.AT2", "ERZ000.AT2", "BRA-UP.AT2")):
        (tmp_path / name).write_text(motion + "\n" * number)  # no copies of one another, which would be said too
    says = "left out BRA-UP.AT2: vertical component by its name: BRA-UP\n"
    assert spectrum(tmp_path) == 0
    printed = capsys.readouterr()
    assert printed.err == f"seismass: {says}"
    assert pl.read_csv(printed.out.encode())["record"].unique(maintain_order=True).to_list() == [
        "BRA225",
        "BRA315",
        "ERZ000",
    ]
    assert main(["scale", "--records", str(tmp_path), "--json"]) == 0
    assert capsys.readouterr().err == f"seismass: {says}"
    assert main(["scale", "--records", str(tmp_path)]) == 0
    printed = capsys.readouterr()
    assert printed.err == ""
    assert says in printed.out


def test_motions_of_one_name_are_told_apart(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    motions = [record.source for record in sm.builtin_suite() if record.source is not None][:2]
    for folder, motion in zip(("a", "b"), motions, strict=True):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "1.AT2").write_text(motion.read_text())
    assert spectrum(tmp_path) == 0
    table = pl.read_csv(capsys.readouterr().out.encode())
    assert table.select("motion", "record").rows() == [(1, 1), (1, 1), (2, 1), (2, 1)]


def test_remarks_of_a_record_are_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "one.txt").write_text(f"{len(SAMPLES)}\n0.01\n" + "".join(f"{x:.6f}\n" for x in SAMPLES))
    remark = "first numbers 400 and 0.01 taken as number of points and step, not as samples"
    assert spectrum(tmp_path / "one.txt", "--unit", "g") == 0
    assert capsys.readouterr().err == f"seismass: motion 1, one: {remark}\n"
    (tmp_path / "scene.toml").write_text(
        "[[blocks]]\nfloor = 0\nmass = 1.0\nmu = 0.1\n[motion]\nfile = 'one.txt'\nunit = 'g'\n"
    )
    assert main(["run", str(tmp_path / "scene.toml")]) == 0
    assert f"one: {remark}\n" in capsys.readouterr().out
    assert main(["run", str(tmp_path / "scene.toml"), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["remarks"] == [f"one: {remark}"]
