"""`seismass pulse`: one component, two, both in one file, a folder; figures, JSON and refusals."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path

import numpy as np
import pytest

from seismass.cli import main
from seismass.motions.pulses import extraction

DT, PERIOD = 0.01, 2.0
TIME = np.arange(3000) * DT
X = (TIME - 7.0) / PERIOD
VELOCITY = 0.6 * np.where(np.abs(X) < 1.0, 0.5 * (1.0 + np.cos(np.pi * X)), 0.0) * np.cos(2.0 * np.pi * X)
FOUND = f"T_p = {1.115 * PERIOD:.1f}"


def at2(path: Path, component: str, velocity: np.ndarray) -> Path:
    rows = "\n".join(f"{value:.8E}" for value in np.gradient(velocity, DT) / 9.80665)
    path.write_text(
        f"MADE RECORD\nSome Event, 1/2/2003, Some Station, {component}\nACCELERATION TIME SERIES IN UNITS OF G\n"
        f"NPTS= {len(velocity)}, DT= {DT:.4f} SEC\n{rows}\n"
    )
    return path


@pytest.fixture
def pair(tmp_path: Path) -> list[str]:
    """A pulse towards 30 degrees from north, as components 0 and 90."""
    angle = math.radians(30.0)
    return [
        str(at2(tmp_path / f"PUL{name}.AT2", name, VELOCITY * factor))
        for name, factor in (("000", math.cos(angle)), ("090", math.sin(angle)))
    ]


def test_two_components_are_judged_together(pair: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["pulse", *pair]) == 0
    printed = capsys.readouterr().out
    assert "PUL000 and PUL090, Shahi and Baker (2014): pulse-like" in printed
    assert FOUND in printed
    assert "30 degrees from the first component to the second (30 degrees from north)" in printed
    assert main(["pulse", *pair, "--json"]) == 0
    (document,) = json.loads(capsys.readouterr().out)
    assert document["is_pulse"] is True
    assert document["period"] == pytest.approx(1.115 * PERIOD, rel=0.02)
    assert len(document["candidates"]) == 5
    assert document["candidates"][0]["azimuth"] == pytest.approx(30.0, abs=0.1)


def test_one_component_is_judged_alone(pair: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["pulse", pair[0]]) == 0
    assert "PUL000, Baker (2007): pulse-like" in capsys.readouterr().out
    assert main(["pulse", *pair, "--method", "baker2007", "--json"]) == 0
    documents = json.loads(capsys.readouterr().out)
    assert [one["records"] for one in documents] == [["PUL000"], ["PUL090"]]
    # 0.6 sin(30 degrees) is 0.3 m/s, and its peak at the samples just below: not above 30 cm/s.
    assert [one["kind"] for one in documents] == ["pulse", "no pulse"]


def test_orientations(pair: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """The pulse is above 30 cm/s within 60 degrees of its direction: from -30 to 90, that is 0 to 85 and 155 to 175."""
    assert main(["pulse", *pair, "--orientations", "36"]) == 0
    printed = capsys.readouterr().out
    assert "pulse-like in 23 of 36 orientations" in printed
    assert "orientations 0 to 85, 155 to 175 degrees" in printed
    assert main(["pulse", *pair, "--orientations", "4", "--json"]) == 0
    (document,) = json.loads(capsys.readouterr().out)
    assert [row["angle"] for row in document["orientations"]] == [0.0, 45.0, 90.0, 135.0]
    assert document["pulses"] == 2


def test_figures_are_written(pair: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["pulse", *pair, "--plot", str(tmp_path / "pulse.png")]) == 0
    assert (tmp_path / "pulse.png").read_bytes().startswith(b"\x89PNG")
    assert main(["pulse", *pair, "--orientations", "6", "--plot", str(tmp_path / "scan.svg")]) == 0
    assert "<svg" in (tmp_path / "scan.svg").read_text()
    capsys.readouterr()
    assert main(["pulse", *pair, "--plot", str(tmp_path / "pulse.pdf")]) == 2
    assert "--plot of pulse must be a file with the suffix .png or .svg" in capsys.readouterr().err
    assert main(["pulse", *pair, "--method", "baker2007", "--plot", str(tmp_path / "two.png")]) == 2
    assert "--plot of pulse must be of one result; got 2" in capsys.readouterr().err


def test_pairs_of_a_folder(pair: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "alone").mkdir()
    at2(tmp_path / "alone" / "X000.AT2", "0", VELOCITY)
    assert main(["pulse", str(tmp_path)]) == 0
    printed = capsys.readouterr()
    assert printed.out.count("Shahi and Baker (2014)") == 1
    assert "seismass: left out X000.AT2: no second horizontal component beside it" in printed.err
    assert main(["pulse", str(tmp_path / "alone")]) == 2
    assert "must be at least one; got none in 1 files" in capsys.readouterr().err


def test_both_components_in_one_file(shared: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = shared / "record_formats" / "csmip" / "ce36456p_CE36456.V2"
    assert main(["pulse", str(file), "--json"]) == 0
    (document,) = json.loads(capsys.readouterr().out)
    assert len(document["records"]) == 2
    assert document["is_pulse"] is False
    assert document["period"] is None


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["{0}", "--orientations", "6"], "--orientations of pulse must be given two components; got one"),
        (["{0}", "--method", "shahi_baker2014"], "must be given two components; got one"),
        (["{0}", "{1}", "--orientations", "6", "--method", "shahi_baker2014"], "must be baker2007 with --orientations"),
        (["{folder}", "{0}"], "RECORD2 of pulse must be left out for a folder"),
        (["{0}", "{folder}/no.AT2"], "record file must be a file that can be read"),
    ],
)
def test_what_does_not_go_together_is_refused(
    pair: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], message: str
) -> None:
    assert main(["pulse", *(argument.format(*pair, folder=tmp_path) for argument in arguments)]) == 2
    assert message in capsys.readouterr().err


def test_orientations_are_a_number(pair: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["pulse", *pair, "--orientations", "none"])
    assert "must be a whole number above zero; got 'none'" in capsys.readouterr().err


def test_a_missing_package_is_one_line(
    pair: list[str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    extraction._wavelet.cache_clear()
    extraction._integral.cache_clear()
    monkeypatch.setitem(sys.modules, "pywt", None)
    assert main(["pulse", *pair]) == 2
    assert "pip install PyWavelets" in capsys.readouterr().err
