"""The paper's seven records as data, and finding them in a folder by header and content."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import polars as pl
import pytest

import seismass as sm
from seismass.base.errors import RecordFormatError
from seismass.cli import main
from seismass.motions.records import catalogue, find_catalogue
from seismass.motions.records.catalogue import RECORDINGS, SUBSTITUTES

TITLE = "PEER NGA STRONG MOTION DATABASE RECORD"


def at2(path: Path, title: str, samples: np.ndarray, dt: float = 0.01, unit: str = "G") -> Path:
    rows = "\n".join(f"{value:.7E}" for value in samples)
    kind = "ACCELERATION" if path.suffix.upper() == ".AT2" else "VELOCITY"
    header = f"{TITLE}\n{title}\n{kind} TIME SERIES IN UNITS OF {unit}\nNPTS= {len(samples)}, DT= {dt:.4f} SEC\n"
    path.write_text(header + rows + "\n")
    return path


def made(recording: int, component: int, factor: float = 1.0) -> np.ndarray:
    """Samples with the points, the peak and the other extreme of a component, and nothing else of it."""
    one = RECORDINGS[recording].components[component]
    assert one.samples and one.peak_g and one.peak_sample and one.opposite
    samples = np.zeros(one.samples)
    samples[one.peak_sample - 1] = one.peak_g
    samples[one.peak_sample + 40] = one.peak_g * one.opposite
    return factor * samples


def test_catalogue_is_the_table_of_the_paper() -> None:
    """Table 1 as printed: magnitude, distance and pulse period."""
    table = catalogue()
    printed = [
        (1, 1999, 7.1, 12.0, None),
        (2, 1989, 6.9, 13.0, 2.6),
        (3, 1979, 6.5, 10.0, 4.2),
        (4, 1999, 7.1, 4.0, None),
        (5, 1992, 6.7, 4.0, None),
        (6, 1940, 7.0, 6.0, 2.6),
        (7, 1995, 6.9, 1.0, None),
    ]
    assert table.select("number", "year", "magnitude", "distance_km", "pulse_period").rows() == printed
    assert table["rsn"].to_list() == [1787, 767, 161, 1612, 821, 6, 1108]
    assert all(f"RSN{row['rsn']}_" in row["files"][0] for row in table.iter_rows(named=True))
    assert all(len(files) == 3 for files in table["files"])
    assert "1611 is Lamont 1058" in table["remark"][3]
    assert all(f"RSN {rsn}," in how for rsn, how in table.select("rsn", "how_to_get").rows())


def test_catalogue_has_the_numbers_of_the_flatfile(shared: Path) -> None:
    flatfile = pl.read_csv(shared / "records" / "reference" / "nga_w2_selected.csv", infer_schema=False)
    at_hand = 0
    for row in catalogue().iter_rows(named=True):
        found = flatfile.filter(pl.col("Record Sequence Number") == str(row["rsn"]))
        if found.is_empty():
            assert row["nga_magnitude"] is None
            continue
        at_hand += 1
        line = found.row(0, named=True)
        assert row["nga_magnitude"] == float(line["Earthquake Magnitude"])
        assert row["nga_distance_km"] == float(line["ClstD (km)"])
        assert row["nga_vs30"] == float(line["Vs30 (m/s) selected for analysis"])
        # The paper rounds; both agree within that.
        assert abs(row["magnitude"] - row["nga_magnitude"]) < 0.051
        assert abs(row["distance_km"] - row["nga_distance_km"]) < 0.51
        horizontals = [line[f"File Name (Horizontal {i})"].replace("\\", "_") for i in (1, 2)]
        assert [f"RSN{row['rsn']}_{name}" for name in horizontals] == row["files"][:2]
    assert at_hand == 3


def test_what_is_known_of_each_component_is_so(shared: Path) -> None:
    """Points, steps and peaks of the catalogue against the files; peaks of the horizontals are in their list too."""
    checked = 0
    folder = shared / "records"
    for recording in (*RECORDINGS, *SUBSTITUTES):
        for component in recording.components:
            files = list(folder.glob(f"0*/{component.file.removesuffix('.AT2')}*"))
            if not files:
                assert component.samples is None
                continue
            record = sm.read_record(files[0])
            peak = int(np.argmax(np.abs(record.acceleration)))
            assert (record.samples, record.dt, peak + 1) == (
                component.samples,
                component.dt,
                component.peak_sample,
            )
            assert record.acceleration[peak] / 9.80665 == pytest.approx(component.peak_g, rel=1e-5)
            assert record.azimuth == component.azimuth
            checked += 1
    assert checked == 21


def test_the_seven_are_found(shared: Path) -> None:
    found = find_catalogue(shared / "records")
    assert found.complete == (1, 2, 3, 4, 5, 6)
    assert found.missing == (7,)
    table = found.table()
    assert table.height == 21
    assert (table["judged"] == "header and content").all()
    assert table.filter("substitute")["record"].to_list() == ["Kobe Japan, KJMA", *["Kobe Japan, Nishi-Akashi"] * 2]
    assert table.filter(pl.col("direction") == "vertical").height == 6
    assert found.summary()["substitutes"][6] == (
        "KJMA (RSN1106): one horizontal; Nishi-Akashi (RSN1111): both horizontals"
    )
    assert (table["remarks"] == "").all()
    far_field = find_catalogue(shared / "records" / "fema_p695_far_field")
    assert far_field.files == ()
    assert far_field.missing == (1, 2, 3, 4, 5, 6, 7)
    assert "may not be passed on" in far_field.text


def test_renamed_copies_are_found_and_told_apart(shared: Path, tmp_path: Path) -> None:
    source = shared / "records" / "06_Imperial_Valley_1940_El_Centro_Array_9" / "RSN6_IMPVALL.I_I-ELC180-hor1.AT2"
    shutil.copy(source, tmp_path / "1.AT2")
    shutil.copy(source, tmp_path / "RSN1787_HECTOR_HEC000.AT2")
    numbers = " ".join(source.read_text().splitlines()[4:]).split()
    (tmp_path / "column.txt").write_text("\n".join(numbers) + "\n")  # neither header, unit nor step
    scaled = "\n".join(f"{9.80665 * float(number):.7e}" for number in numbers)
    (tmp_path / "scaled.csv").write_text("acceleration (m/s2)\n" + scaled + "\n")
    found = find_catalogue(tmp_path)
    by_name = {one.file.name: one for one in found.files}
    assert set(by_name) == {"1.AT2", "RSN1787_HECTOR_HEC000.AT2", "column.txt", "scaled.csv"}
    assert {one.recording.rsn for one in found.files} == {6}
    assert by_name["1.AT2"].judged == "header and content"
    assert by_name["1.AT2"].remarks == ()
    assert any("its name says RSN1787" in remark for remark in by_name["RSN1787_HECTOR_HEC000.AT2"].remarks)
    assert any("the same component as 1.AT2" in remark for remark in by_name["RSN1787_HECTOR_HEC000.AT2"].remarks)
    assert by_name["column.txt"].judged == "content"
    assert by_name["column.txt"].dt is None
    assert found.summary()["horizontals"].to_list() == [0, 0, 0, 0, 0, 1, 0]


@pytest.mark.parametrize("recording", RECORDINGS[:6], ids=lambda one: one.station)
def test_headers_name_the_recording(tmp_path: Path, recording: sm.records.catalogue_report.Recording) -> None:
    """As NGA-West2 and as the files before it wrote event and station."""
    older = {
        1787: "HECTOR MINE OCT 16, 1999  02:47, HEC, 000",
        767: "LOMA PRIETA 10/18/89 00:05, GILROY ARRAY #3, 000 (CDMG STATION 47381)",
        161: "IMPERIAL VALLEY 10/15/79 2316, BRAWLEY AIRPORT, 225 (USGS STATION 5060)",
        1612: "DUZCE 11/12/99, LAMONT STATION 1059, N",
        821: "ERZINCAN 03/13/92 1719, ERZINCAN, NS",
        6: "IMPERIAL VALLEY 05/19/40 0439, EL CENTRO ARRAY #9, 180 (USGS STATION 117)",
    }[recording.rsn]
    samples = made(recording.number - 1, 0)
    dt = recording.components[0].dt
    assert dt is not None
    at2(tmp_path / "a.AT2", f"{recording.event}, 1/2/{recording.year}, {recording.station}, 0", samples[:-7], dt)
    at2(tmp_path / "b.AT2", older, samples, dt)
    first, second = find_catalogue(tmp_path).files
    assert first.recording is recording
    assert first.judged == "header"  # seven points are missing
    assert any("not the samples of" in remark or "none of those recorded" in remark for remark in first.remarks)
    assert second.recording is recording
    assert second.judged == "header and content"
    assert all(remark == "the same component as a.AT2" for remark in second.remarks)


@pytest.mark.parametrize(
    "title",
    [
        "Imperial Valley-06, 10/15/1979, El Centro Array #4, 230",
        "Imperial Valley-06, 10/15/1979, El Centro Array #9, 180",
        "Imperial Valley-02, 5/19/1940, El Centro Array #19, 180",
        "Loma Prieta, 10/18/1989, Gilroy Array #2, 0",
        "Duzce Turkey, 11/12/1999, Lamont 1058, E",
        "Duzce Turkey, 11/12/1999, Bolu, 0",
        "Hector Mine, 10/16/1999, Amboy, 90",
        "Big Bear-01, 6/28/1992, Hector, 90",
        "Kobe Japan, 1/16/1995, Shin-Osaka, 0",
    ],
)
def test_neighbours_are_not_taken_for_the_seven(tmp_path: Path, title: str) -> None:
    at2(tmp_path / "a.AT2", title, np.sin(np.arange(500.0)))
    assert find_catalogue(tmp_path).files == ()


def test_a_name_alone_is_not_counted(tmp_path: Path) -> None:
    at2(tmp_path / "RSN767_LOMAP_G03000.AT2", "Elsewhere, 1/2/2003, Some Station, 0", np.sin(np.arange(500.0)))
    found = find_catalogue(tmp_path)
    (file,) = found.files
    assert (file.judged, file.usable) == ("name", False)
    assert 2 in found.missing
    assert "its name says RSN767; neither header nor content does: not counted" in found.text


def test_scaled_cut_and_other_files_are_said_to_be_so(tmp_path: Path) -> None:
    title = "Hector Mine, 10/16/1999, Hector, 0"
    at2(tmp_path / "scaled.AT2", title, made(0, 0, factor=1.5))
    cut = at2(tmp_path / "cut.AT2", title, made(0, 0))
    cut.write_text(cut.read_text()[:-2000])
    at2(tmp_path / "velocity.VT2", title, made(0, 0), unit="CM/S")
    at2(tmp_path / "normal.AT2", "Hector Mine, 10/16/1999, Hector, FN", made(0, 0)[::-1])
    files = {one.file.name: one for one in find_catalogue(tmp_path).files}
    assert any("1.5 times those recorded" in remark for remark in files["scaled.AT2"].remarks)
    assert files["cut.AT2"].samples is None
    assert not files["cut.AT2"].usable
    assert "cut off" in files["cut.AT2"].remarks[0]
    assert not files["velocity.VT2"].usable
    assert "velocity" in files["velocity.VT2"].remarks[0]
    assert files["normal.AT2"].component is None
    assert files["normal.AT2"].direction == "unknown"


def test_kobe_university_would_be_known(tmp_path: Path) -> None:
    """Its files were not at hand: header alone, which is said."""
    for azimuth in (0, 90):
        at2(tmp_path / f"{azimuth}.AT2", f"Kobe Japan, 1/16/1995, Kobe University, {azimuth}", np.sin(np.arange(500.0)))
    found = find_catalogue(tmp_path)
    assert found.complete == (7,)
    assert all("cannot be checked" in one.remarks[-1] for one in found.files)


def test_what_is_no_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RecordFormatError, match=r"folder of catalogue search must be a directory; got .*nowhere"):
        find_catalogue(tmp_path / "nowhere")
    assert find_catalogue(tmp_path).looked_at == 0


def test_command_reports(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    at2(tmp_path / "a.AT2", "Hector Mine, 10/16/1999, Hector, 0", made(0, 0))
    assert main(["records", "--find", str(tmp_path)]) == 0
    printed = capsys.readouterr().out
    assert "1  1999 Hector Mine, Hector (RSN1787): one horizontal" in printed
    assert "PGA 0.26547 g; by header and content" in printed
    assert "7  1995 Kobe, Kobe University (RSN1108): not here" in printed
    assert "search for RSN 1108" in printed
    assert main(["records", "--find", str(tmp_path), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["missing"] == [2, 3, 4, 5, 6, 7]
    assert document["files"][0]["samples"] == 4531
    assert main(["records"]) == 0
    printed = capsys.readouterr().out
    assert "6  1940 Imperial Valley, El Centro: M 7, 6 km, pulse of 2.6 s; RSN6" in printed
    assert main(["records", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)[3]["rsn"] == 1612


def test_command_lists_records(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A sine of 1 m/s2 and 1 Hz over 10 s: PGA, PGV 2 / (2 pi), Arias pi / (2 g) times 5, by hand."""
    time = np.arange(1001) * 0.01
    at2(tmp_path / "a.AT2", "Some Event, 1/2/2003, Some Station, 90", np.sin(2.0 * np.pi * time) / 9.80665)
    at2(tmp_path / "b.AT2", "Some Event, 1/2/2003, Some Station, UP", np.sin(2.0 * np.pi * time) / 9.80665)
    (tmp_path / "notes.md").write_text("nothing of interest\n")
    (tmp_path / ".hidden.AT2").write_text("")
    assert main(["records", str(tmp_path), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    first, second = document["records"]
    assert (first["component"], second["component"], first["azimuth"]) == ("90", "UP", 90.0)
    assert first["pga_g"] == pytest.approx(1.0 / 9.80665, rel=1e-6)
    assert first["pgv"] == pytest.approx(1.0 / np.pi, rel=1e-3)  # the step of 0.01 s rounds the peaks by 3e-4
    assert first["arias"] == pytest.approx(5.0 * np.pi / (2.0 * 9.80665), rel=1e-3)
    assert [one["file"] for one in document["not_read"]] == [str(tmp_path / "notes.md")]
    assert main(["records", str(tmp_path)]) == 0
    printed = capsys.readouterr().out
    assert "  1 a  " in printed
    assert "not read: 1 file\n  notes.md: " in printed
    assert main(["records", str(tmp_path / "b.AT2")]) == 0
    assert "b: 1 record\n" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["records", "{0}", "--find", "{0}"], "PATH of records must be left out where --find is given"),
        (["records", "--dt", "0.1"], "--dt of records must be left out for a look without PATH; got 0.1"),
        (["records", "{0}", "--unit", "g"], "must be left out for a folder of records; got g"),
        (["records", "{0}"], "must be at least one; got 0 files that are none"),
        (["records", "{0}/no.AT2"], "record file must be a file that can be read"),
        (["records", "--find", "{0}/no"], "folder of catalogue search must be a directory"),
    ],
)
def test_command_refuses(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], message: str
) -> None:
    assert main([argument.format(tmp_path) for argument in arguments]) == 2
    assert message in capsys.readouterr().err
