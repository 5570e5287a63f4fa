"""What is no motion never becomes one, and what a header says of units, steps, places and directions is held to."""

from __future__ import annotations

import io
import math
import runpy
import threading
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seismass as sm
from seismass import cli
from seismass.base.errors import RecordFormatError
from seismass.base.units import ACCELERATION_UNITS, STANDARD_GRAVITY
from seismass.motions.matching import match
from seismass.motions.matching.linear import Stopped
from seismass.motions.records import Record, find_pairs, read_record, read_records, read_suite
from seismass.motions.records.formats import NotRead
from seismass.motions.records.formats.common import NO_COUNT
from seismass.motions.records.formats.labels import azimuth_of
from seismass.motions.records.read import is_archive, off_ground
from seismass.motions.records.suite import suite_of_file
from seismass.motions.spectra.target import target_remarks

ROOT = Path(__file__).parents[1]
MADE = runpy.run_path(str(ROOT / "tools" / "record_files.py"))
FILES: dict[str, bytes] = dict(MADE["files"]())
SAMPLES = [0.1 * math.sin(0.35 * index) * math.sin(math.pi * index / 300) ** 2 for index in range(300)]


def rows(head: str, values: list[float] | None = None, step: float = 0.01, time: str = "{:.3f}") -> str:
    """Return a table of times and values below a header."""
    found = SAMPLES if values is None else values
    lines = (time.format(step * at) + f",{value:.6f}\n" for at, value in enumerate(found))
    return f"{head}\n" + "".join(lines)


def put(folder: Path, name: str, text: str | bytes) -> Path:
    """Write a file."""
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


SPECTRUM = [0.9 / (1.0 + 0.01 * at) for at in range(300)]
NO_MOTIONS = [
    rows("period (s),Sa (g)", SPECTRUM),
    rows("T,SA(g)", SPECTRUM),
    rows("T (s),S (g)", SPECTRUM),
    rows("Period [sec],PSA [g]", SPECTRUM),
    rows("T (s);Se (m/s2)", SPECTRUM).replace(",", ";"),
    rows("Frequency (Hz)  FAS (g)", SPECTRUM).replace(",", "  "),
    rows("f (Hz),Fourier amplitude (g-s)", SPECTRUM),
    rows("# Uniform hazard spectrum (g)\n# x y", SPECTRUM),
    rows("PGA (g),annual frequency of exceedance", SPECTRUM),
    rows("Sa (g),annual rate", SPECTRUM),
    rows("iml (g),poe", SPECTRUM),
    rows("RSN,scale factor (g)", SPECTRUM),
    rows("depth (m),PGA (g)", SPECTRUM),
    rows("Period (s),Target (g)", SPECTRUM),
    "Sa (g)\n" + "".join(f"{value:.5f}\n" for value in SPECTRUM),
]


@pytest.mark.parametrize("text", NO_MOTIONS)
def test_a_spectrum_a_curve_or_a_list_is_refused_by_name(tmp_path: Path, text: str) -> None:
    file = put(tmp_path, "a.csv", text)
    for arguments in ({}, {"unit": "g", "dt": 0.01}, {"format": "columns", "unit": "g", "dt": 0.01}):
        with pytest.raises(NotRead, match=r"content of a\.csv must be a motion; got "):
            read_record(file, **arguments)  # type: ignore[arg-type]


QUANTITIES = ["Time [s],Disp (cm)", "t (s),d (mm)", "t (s),x [m]", "Time [s], V [cm/s]", "time,velocity", "Time,U [cm]"]


@pytest.mark.parametrize("head", QUANTITIES)
def test_another_quantity_is_refused_by_label_or_unit(tmp_path: Path, head: str) -> None:
    with pytest.raises(NotRead, match=r"must be acceleration; got (?:velocity|displacement)"):
        read_record(put(tmp_path, "a.csv", rows(head)), unit="g")


def test_what_stands_beside_records_is_no_motion_of_the_suite(tmp_path: Path) -> None:
    """Nor is a table whose samples have one sign, or of which no word says that it holds accelerations."""
    put(tmp_path, "made.AT2", FILES["made.AT2"])
    put(tmp_path, "good.csv", rows("time (s),acceleration (g)"))
    for number, text in enumerate(NO_MOTIONS):
        put(tmp_path, f"no{number}.csv", text)
    put(tmp_path, "positive.csv", rows("time (s),acceleration (g)", SPECTRUM))
    put(tmp_path, "what.csv", rows("first,second (g)"))
    suite = read_suite(tmp_path)
    assert [record.name for record in suite] == ["good", "made"]
    reasons = {item.file.name: item.reason for item in suite.excluded}
    assert len(reasons) == len(NO_MOTIONS) + 2
    assert "samples have one sign" in reasons["positive.csv"]
    assert any("samples have one sign" in one for one in read_record(tmp_path / "positive.csv").remarks)


@pytest.mark.parametrize(
    ("unit", "per"), [("s", 1.0), ("sec", 1.0), ("ms", 1e3), ("us", 1e6), ("min", 1 / 60.0), ("hours", 1 / 3600.0)]
)
def test_times_have_the_unit_of_their_label(tmp_path: Path, unit: str, per: float) -> None:
    text = rows(f"Time ({unit}),Acceleration (g)", step=0.01 * per, time="{!r}")
    assert read_record(put(tmp_path, "a.csv", text)).dt == pytest.approx(0.01, rel=1e-6)


def test_times_of_no_or_another_unit(tmp_path: Path) -> None:
    file = put(tmp_path, "a.csv", rows("Time (days),Acceleration (g)"))
    with pytest.raises(RecordFormatError, match=r"unit of the times of a\.csv must be s, ms, us, min or h; got 'days'"):
        read_record(file)
    put(tmp_path, "a.csv", rows("Time,Acceleration (g)", step=10.0))
    with pytest.raises(RecordFormatError, match=r"step of a\.csv must be between .*; got 10 s .* Say dt"):
        read_record(file)
    record = read_record(file, dt=0.01)  # 10 ms
    assert (record.dt, "the times are ms by the step that was given" in record.remarks) == (0.01, True)
    with pytest.raises(RecordFormatError, match=r"step of a\.csv must be between"):
        read_record(file, dt=0.02)
    for head in ("sample,acceleration (g)", "No.,acceleration (g)", "i,acceleration (g)", "x,acceleration (g)"):
        put(tmp_path, "a.csv", rows(head, step=1.0, time="{:.0f}"))
        with pytest.raises(RecordFormatError, match=r"dt of a\.csv must be given"):
            read_record(file)
        assert read_record(file, dt=0.005).dt == 0.005
    put(tmp_path, "a.csv", rows("Time (s),Acceleration (g)", step=0.2))
    assert "step 0.2 s is outside 0.0005 to 0.1 s" in " ".join(read_record(file).remarks)


@pytest.mark.parametrize("dt", [1 / 409.6, 0.005, 1 / 256, 0.0025])
@pytest.mark.parametrize("form", ["{:.2f}", "{:.4g}", "{:.5g}", "{:.3f}"])
def test_the_right_step_of_rounded_times_is_never_refused(tmp_path: Path, dt: float, form: str) -> None:
    values = SAMPLES * 5
    file = put(tmp_path, "a.csv", rows("time (s),acceleration (g)", values, dt, form))
    assert read_record(file, dt=dt).dt == pytest.approx(dt, rel=2e-3)
    with pytest.raises(RecordFormatError, match=r"of a\.csv must"):
        read_record(file, dt=1.1 * dt)


def test_a_step_that_is_not_given_lies_between_bounds(tmp_path: Path) -> None:
    """1499 steps of 5 ms to 7.495 s, written as 7.49 or 7.50: 0.005 s lies within (7.49 to 7.51 s) / 1499."""
    file = put(tmp_path, "a.csv", rows("time (s),acceleration (g)", SAMPLES * 5, 0.005, "{:.2f}"))
    with pytest.raises(RecordFormatError, match=r"times rounded to 0\.01 s: give dt, .* between 0\.0049\d+ and 0\.005"):
        read_record(file)


def test_a_rounded_step_of_a_header_is_refined_and_remarked(tmp_path: Path) -> None:
    column = "dt = .0024 s, acceleration (g)\n" + "".join(f"{value:.6f}\n" for value in SAMPLES)
    file = put(tmp_path, "a.txt", column)
    assert "between 0.00235 and 0.00245 s" in " ".join(read_record(file).remarks)
    assert read_record(file, dt=1 / 409.6).dt == 1 / 409.6
    with pytest.raises(RecordFormatError, match=r"dt of a\.txt must agree with the step of its header, 0\.0024 s"):
        read_record(file, dt=0.0025)
    whole = read_record(put(tmp_path, "b.txt", column.replace(".0024", ".005")))
    assert not any("step" in remark for remark in whole.remarks)


@pytest.mark.parametrize("unit", [name for name in ACCELERATION_UNITS if name != "gal"])
def test_every_unit_is_read_and_contradicts_every_other(tmp_path: Path, unit: str) -> None:
    file = put(tmp_path, "a.csv", rows(f"Time (s),Acceleration ({unit})"))
    record = read_record(file)
    assert record.file_unit == unit
    assert record.pga == pytest.approx(max(map(abs, SAMPLES)) * ACCELERATION_UNITS[unit], rel=1e-4)
    assert read_record(file, unit=unit).pga == record.pga
    for other in ACCELERATION_UNITS:
        if ACCELERATION_UNITS[other] != ACCELERATION_UNITS[unit]:
            with pytest.raises(RecordFormatError, match=r"unit of a\.csv must be that of its header"):
                read_record(file, unit=other)


def test_a_unit_that_is_not_known_contradicts_any(tmp_path: Path) -> None:
    for said in ("counts/s2", "units: g/10", "km/s2"):
        file = put(tmp_path, "a.txt", f"Acceleration, {said}\n" + "".join(f"{value:.6f}\n" for value in SAMPLES))
        with pytest.raises(RecordFormatError, match=r"unit of a\.txt must be that of its header, "):
            read_record(file, unit="g", dt=0.01)
    words = put(tmp_path, "b.txt", "units: see below\n" + "".join(f"{value:.6f}\n" for value in SAMPLES))
    assert read_record(words, unit="g", dt=0.01).file_unit == "g"


def test_a_unit_that_is_off_by_a_large_factor_is_a_doubt(tmp_path: Path) -> None:
    """Percent of g called g: 3 g; m/s2 called g: 2.9 g; and a PGV of some m/s, below 5 g both."""
    for factor in (29.0, 30.0):
        file = put(tmp_path, "a.csv", rows("Time (s),Acceleration (g)", [factor * value for value in SAMPLES]))
        assert any("above 2 g" in one for one in read_record(file).remarks)
    slow = [19.0 * 0.1 * math.sin(0.05 * at) * math.sin(math.pi * at / 300) ** 2 for at in range(300)]
    file = put(tmp_path, "b.csv", rows("Time (s),Acceleration (g)", slow))
    assert any("PGV" in one and "doubtful" in one for one in read_record(file).remarks)


def test_labels_of_components_say_their_direction(tmp_path: Path) -> None:
    head = "Tiempo (s);N00E (gal);N90W (gal);V (gal);velocidad (cm/s)"
    body = "".join(f"{0.01 * at:.2f};{v:.4f};{2 * v:.4f};{3 * v:.4f};0\n" for at, v in enumerate(SAMPLES))
    file = put(tmp_path, "a.csv", f"{head}\n{body}".replace(".", ","))
    north, west, up = read_records(file)
    assert [one.component for one in (north, west, up)] == ["N00E", "N90W", "V"]
    assert (north.azimuth, west.azimuth, up.azimuth) == (0.0, 270.0, None)
    assert west.pga == pytest.approx(2.0 * north.pga, rel=1e-3)
    assert any("not read: velocidad" in remark for remark in north.remarks)
    assert [record.component for record in suite_of_file(file)] == ["N00E", "N90W"]
    assert read_record(file, channel="N90W") == read_record(file, channel=3) == west
    with pytest.raises(RecordFormatError, match=r"channel of a\.csv must be given, the file has 3"):
        read_record(file)


def test_columns_of_which_nothing_says_what_they_are(tmp_path: Path) -> None:
    plain = "".join(f"{0.01 * at:.2f} {v:.4f} {2 * v:.4f}\n" for at, v in enumerate(SAMPLES))
    first, second = read_records(put(tmp_path, "a.txt", plain), unit="g")
    assert (first.dt, second.pga) == (0.01, pytest.approx(2.0 * first.pga, rel=1e-3))
    assert any("no label says what the columns are" in remark for remark in first.remarks)
    components = "".join(f"{v:.4f} {2 * v:.4f} {-v:.4f} {3 * v:.4f} {v / 2:.4f}\n" for v in SAMPLES)
    with pytest.raises(RecordFormatError, match=r"columns of b\.txt must have labels, .* got 5 numbers a line"):
        read_record(put(tmp_path, "b.txt", components), unit="g", dt=0.01)


@pytest.mark.parametrize("per_line", [3, 5, 6, 8, 10])
def test_samples_line_after_line(tmp_path: Path, per_line: int) -> None:
    """Fields of ten characters may touch; the last line may be short."""
    fields = [f"{value:10.3E}" for value in SAMPLES[:-1]]
    file = put(tmp_path, "a.g3", MADE["rows"](fields, per_line))
    record = read_record(file, unit="g", dt=0.02)
    assert (record.samples, record.dt) == (299, 0.02)
    np.testing.assert_allclose(record.acceleration, [float(one) * STANDARD_GRAVITY for one in fields], rtol=1e-12)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be", "utf-8-sig"])
def test_encodings_of_sheets(tmp_path: Path, encoding: str) -> None:
    text = rows("time (s),acceleration (g)").replace(",", "\t").replace("\n", "\r\n")
    put(tmp_path, "a.txt", text.encode(encoding))
    assert read_record(tmp_path / "a.txt").samples == 300
    assert len(read_suite(tmp_path)) == 1


@pytest.mark.parametrize(
    ("line", "numbers"),
    [("0,5;0,25", [0.25]), ("0,5 0,25", [0.25]), ("0,5\t-0,25", [-0.25]), ("0.5,0.25", [0.25]), ("0, 25", [25.0])],
)
def test_decimal_commas_are_told_from_separators(tmp_path: Path, line: str, numbers: list[float]) -> None:
    text = f"t (s);a (m/s2)\n{line}\n" + line.replace("5", "6", 1).replace("0", "1", 1)
    try:
        record = read_record(put(tmp_path, "a.txt", text), dt=None)
    except RecordFormatError as error:
        assert "step of a.txt" in str(error) or "times of a.txt" in str(error) or "dt of a.txt" in str(error)
        return
    assert record.acceleration[0] == numbers[0]


def test_where_a_sensor_stands(tmp_path: Path) -> None:
    for place, off in (
        ("Roof", True),
        ("Middle Bent: Top of Column", True),
        ("3rd Floor, East Wall", True),
        ("Basement", True),
        ("Ground Floor", True),
        ("Free Field", False),
        ("Free-field, 30 m from bridge deck", False),
        ("Ground level", False),
        ("borehole", True),
        ("Geotechnical array, depth 30 m", True),
        ("", False),
    ):
        assert (off_ground(Record([0.0, 1.0], 0.01, place=place)) is not None) is off, place
    roof = MADE["csmip"](channels=2).replace("CHAN  1:  90 DEG", "CHAN  1:  90 DEG                  Location: Roof")
    put(tmp_path, "roof.V2", roof)
    put(tmp_path, "deep.EW1", MADE["knet"](direction="2"))
    put(tmp_path, "top.EW2", MADE["knet"](direction="5"))
    cosmos = MADE["cosmos"](channels=1).replace("Location:", "Location: Deck, mid-span")
    put(tmp_path, "deck.V2c", cosmos)
    suite = read_suite(tmp_path)
    assert [record.component for record in suite] == ["EW2"]
    reasons = {item.file.name: item.reason for item in suite.excluded}
    assert reasons["deck.V2c"] == ("in a structure, or not said to be of the ground, by its header: Deck, mid-span")
    assert reasons["deep.EW1"] == "below the surface by its header: borehole"
    first = read_records(tmp_path / "roof.V2")[0]
    assert (first.place, first.component, first.azimuth) == ("Roof", "90 DEG", 90.0)
    with pytest.raises(RecordFormatError, match=r"1 vertical and 1 in a structure or below the surface: say which"):
        suite_of_file(tmp_path / "roof.V2")
    put(tmp_path, "list.csv", "file,channel\nroof.V2,1\n")
    assert read_suite(tmp_path / "list.csv")[0].place == "Roof"


@pytest.mark.parametrize(
    ("direction", "component", "azimuth", "deep"),
    [
        ("1", "NS1", 0.0, True),
        ("2", "EW1", 90.0, True),
        ("3", "UD1", None, True),
        ("4", "NS2", 0.0, False),
        ("5", "EW2", 90.0, False),
        ("6", "UD2", None, False),
    ],
)
def test_directions_of_kik_net(
    tmp_path: Path, direction: str, component: str, azimuth: float | None, deep: bool
) -> None:
    """NIED: 1 to 3 are N-S, E-W and U-D of the borehole, 4 to 6 of the surface."""
    found = read_record(put(tmp_path, f"made.{component}", MADE["knet"](direction=direction)))
    assert (found.component, found.azimuth, found.network) == (component, azimuth, "KiK-net")
    assert found.place == ("borehole" if deep else "")
    told = [remark for remark in found.remarks if "borehole" in remark]
    assert told == ([f"component {component} is that of the borehole sensor, not of the surface"] if deep else [])


def test_compass_letters_before_the_operator(tmp_path: Path) -> None:
    assert [azimuth_of(one) for one in ("N (CWB)", "E (CWB)", "360 (CDMG STATION 1)")] == [0.0, 90.0, 0.0]
    text = FILES["made.AT2"].decode()
    for name, end in (("a_N.AT2", "TST002, N, (CWB)"), ("a_E.AT2", "TST002, E, (CWB)")):
        put(tmp_path, name, text.replace("Nowhere, 90", end))
    record = read_record(tmp_path / "a_E.AT2")
    assert (record.station, record.component, record.azimuth) == ("TST002", "E (CWB)", 90.0)
    (pair,) = find_pairs(tmp_path)
    assert {pair.first.azimuth, pair.second.azimuth} == {0.0, 90.0}


def test_a_zip_archive_is_read_as_a_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w", zipfile.ZIP_DEFLATED) as archive:
        # Another direction than that of the .V2, whose motion it has: one motion in two formats counts once.
        archive.writestr("event/RSN1_90.AT2", FILES["made.AT2"].replace(b"Nowhere, 90", b"Nowhere, 0"))
        archive.writestr("../../escape.V2", FILES["made.V2"])
        archive.writestr("__MACOSX/._RSN1_90.AT2", b"\0\0")
        archive.writestr("_SearchResults.csv", "a,b\n1,2\n")
    path = put(tmp_path, "peer.zip", held.getvalue())
    assert is_archive(path)
    suite = read_suite(path)
    assert sorted(record.name for record in suite) == ["RSN1_90", "escape channel 1"]
    assert {str(record.source) for record in suite} == {
        str(path / "event/RSN1_90.AT2"),
        str(path / "../../escape.V2"),
    }
    assert [item.file.name for item in suite.excluded].count("escape.V2") == 1
    assert sorted(file.name for file in tmp_path.iterdir()) == ["peer.zip"]
    assert cli.main(["records", str(path)]) == 0
    assert "RSN1_90" in capsys.readouterr().out
    damaged = put(tmp_path, "cut.zip", held.getvalue()[:-40])
    assert not is_archive(damaged)
    with pytest.raises(RecordFormatError, match=r"must be a directory, a ZIP archive or a \.csv file"):
        read_suite(damaged)


def test_options_of_one_file_on_the_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    components = put(tmp_path, "made.csv", FILES["made_components.csv"])
    assert cli.main(["records", str(components), "--channel", "EW"]) == 0
    assert "made channel 3" in capsys.readouterr().out
    named = put(tmp_path, "a.AT2", rows("time (s),acceleration (g)"))
    assert cli.main(["records", str(named)]) == 2
    assert "NPTS and DT" in capsys.readouterr().err
    assert cli.main(["records", str(named), "--format", "columns"]) == 0
    assert cli.main(["records", str(named), "--format", "v9"]) == 2
    scaled = put(tmp_path, "b.txt", "9.81\n0.01\n" + "".join(f"{value:.6f}\n" for value in SAMPLES))
    assert cli.main(["records", str(scaled), "--unit", "g", "--dt", "0.01", "--skip", "2"]) == 0
    assert cli.main(["spectrum", str(components), "--channel", "NS", "--period", "1"]) == 0
    capsys.readouterr()
    assert cli.main(["records", str(tmp_path), "--format", "columns"]) == 2
    assert "--format of" in capsys.readouterr().err


def test_parameters_of_codes_out_of_their_tables_are_doubts() -> None:
    assert "z of the target spectrum is 40" in target_remarks(sm.TargetSpectrum.nzs1170("D", z=40.0))[0]
    assert "agr_g of the target spectrum is 2.94" in target_remarks(sm.TargetSpectrum.eurocode8(agr_g=2.94))[-1]
    assert target_remarks(sm.TargetSpectrum.nzs1170("D", z=0.4, r=1.8)) == ()
    assert target_remarks(sm.TargetSpectrum.eurocode8(agr_g=0.3, importance=1.4)) == ()


def test_a_matched_suite_that_is_interrupted_ends_its_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    """The record that is being matched stops within a part of a pass, and those that wait are not begun."""
    ends: list[str] = []
    real: Any = match.adjust
    begun = threading.Event()

    def watched(*given: Any, **named: Any) -> Any:
        begun.set()
        try:
            found = real(*given, **named)
        except Stopped:
            ends.append("stopped")
            raise
        ends.append("done")
        return found

    def interrupt(done: int, _: int) -> None:
        if done == 0:
            return
        raise KeyboardInterrupt

    monkeypatch.setattr(match, "adjust", watched)
    records = sm.builtin_suite().records
    short = records[0].with_duration(3.0)
    hard = {"tolerance": 1e-4, "max_iterations": 10}
    suite = [short, records[1], records[2], records[3]]
    with pytest.raises(KeyboardInterrupt):
        sm.matching.match_suite(suite, sm.TargetSpectrum.asce7(), progress=interrupt, **hard)
    assert begun.is_set()
    assert ends.count("done") <= 2
    assert len(ends) < len(suite)
    assert "stopped" in ends


@pytest.mark.parametrize(
    ("header", "counted"),
    [("dt = 0.01", False), ("NPTS = 40, dt = 0.01", True), ("NDATA: 40\ndt = 0.01", True), ("40 0.01", True)],
)
def test_that_a_file_counts_no_samples_is_remarked_where_it_does_not(
    tmp_path: Path, header: str, counted: bool
) -> None:
    samples = "\n".join(f"{0.01 * (-1.0) ** place:.4f}" for place in range(40))
    record = read_record(put(tmp_path, "a.txt", f"{header}\n{samples}\n"), unit="g")
    assert (record.samples, record.dt) == (40, 0.01)
    assert record.remarks.count(NO_COUNT) == (0 if counted else 1)
