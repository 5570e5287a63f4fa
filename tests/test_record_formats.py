"""Formats of record files: each read as its rules say, by content, with labels, channels, header peaks and refusals.

The files are made up by tools/record_files.py from the formats' rules; recordings are in test_record_readings.py.
"""

from __future__ import annotations

import gzip
import hashlib
import io
import math
import os
import re
import runpy
import struct
import time
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from seismass.base.errors import RecordFormatError
from seismass.base.units import STANDARD_GRAVITY, unit_by_name
from seismass.motions.records import Record, read_record, read_records, read_suite
from seismass.motions.records.formats import FORMATS, NotRead, recognise
from seismass.motions.records.formats.labels import azimuth_of, is_vertical
from seismass.motions.records.formats.table import layout_of
from seismass.motions.records.read import suspicions
from seismass.motions.records.suite import suite_of_file

ROOT = Path(__file__).parents[1]
MADE = runpy.run_path(str(ROOT / "tools" / "record_files.py"))
FILES: dict[str, bytes] = dict(MADE["files"]())
FUZZ = runpy.run_path(str(ROOT / "tools" / "fuzz_records.py"))
POINTS: int = MADE["POINTS"]
DT: float = MADE["DT"]

NORTH_EAST_UP = (("NS", 0.0), ("EW", 90.0), ("UD", None))

# file, unit in it, resolution of its samples (m/s2), and component, azimuth, network, station of each channel
READ: list[tuple[str, str, float, list[tuple[str, float | None, str, str]]]] = [
    ("made.AT2", "g", 1e-7, [("90", 90.0, "", "Nowhere")]),
    ("made_v2.cosmos", "cm/s2", 1e-7, [("90 deg", 90.0, "XX", "NOW, Nowhere"), ("Up", None, "XX", "NOW, Nowhere")]),
    ("made_v1.cosmos", "cm/s2", 1e-7, [("90 deg", 90.0, "XX", "NOW, Nowhere")]),
    ("made.V2", "cm/s2", 1e-5, [("90 DEG", 90.0, "CGS", "00001, NOWHERE"), ("UP", None, "CGS", "00001, NOWHERE")]),
    ("made.V1", "g", 1e-5, [("90 DEG", 90.0, "CGS", "00001, NOWHERE"), ("UP", None, "CGS", "00001, NOWHERE")]),
    ("made_pairs.V1", "g", 1e-3, [("90 DEG", 90.0, "CGS", "00001, NOWHERE")]),
    ("made.ASC", "cm/s2", 1e-8, [("HNE", 90.0, "XX", "NOW, Nowhere")]),
    ("made.EW", "cm/s2", 1e-5, [("E-W", 90.0, "K-NET", "NOW001")]),
    ("made.UD2", "cm/s2", 1e-5, [("UD2", None, "KiK-net", "NOW001")]),
    ("made.smc", "cm/s2", 1e-4, [("45", 45.0, "XXXX", "NOW0A, Nowhere")]),
    ("made_fixed.smc", "cm/s2", 1e-7, [("45", 45.0, "XXXX", "NOW0A, Nowhere")]),
    ("made_pairs.smc", "cm/s2", 1e-4, [("45", 45.0, "XXXX", "NOW0A, Nowhere")]),
    ("made.txt", "cm/s2", 1e-7, [("", None, "", "")]),
    ("made.csv", "g", 1e-5, [("", None, "", "")]),
    ("made_components.csv", "cm/s2", 1e-7, [("NS", 0.0, "", ""), ("EW", 90.0, "", ""), ("UD", None, "", "")]),
    ("made_block.g3", "g", 1e-7, [("", None, "", "")]),
    ("made.cor.acc", "m/s2", 1e-7, [("NS", 0.0, "XX", "0001 / Nowhere")]),
    ("made_csmnc.dat", "cm/s2", 1e-6, [("EW", 90.0, "CSMNC", "NOW00")]),
    ("made_jma.csv", "cm/s2", 1e-5, [(name, at, "JMA", "00000NOW") for name, at in NORTH_EAST_UP]),
    ("made_nied.csv", "cm/s2", 1e-5, [(name, at, "NIED", "NOW001") for name, at in NORTH_EAST_UP]),
    (
        "made_cwa.txt",
        "cm/s2",
        1e-5,
        [("U", None, "CWA", "NOW001"), ("N", 0.0, "CWA", "NOW001"), ("E", 90.0, "CWA", "NOW001")],
    ),
    (
        "made_afad.txt",
        "cm/s2",
        1e-8,
        [("N-S", 0.0, "AFAD", "0001"), ("E-W", 90.0, "AFAD", "0001"), ("U-D", None, "AFAD", "0001")],
    ),
    ("made.V2A", "mm/s2", 6e-5, [("S14E", 166.0, "GeoNet", "NOWS, Nowhere"), ("Up", None, "GeoNet", "NOWS, Nowhere")]),
    ("made.V1A", "mm/s2", 6e-5, [("S14E", 166.0, "GeoNet", "NOWS, Nowhere"), ("Up", None, "GeoNet", "NOWS, Nowhere")]),
    (
        "made_unam.191",
        "cm/s2",
        1e-6,
        [(name, at, "UNAM", "NOWS, NOWHERE") for name, at in (("V", None), ("N00E", 0.0), ("N90E", 90.0))],
    ),
    (
        "made_bhrc.V1",
        "g",
        1e-5,
        [(name, at, "BHRC", "Nowhere") for name, at in (("L", 316.0), ("V", None), ("T", 46.0))],
    ),
]


def put(folder: Path, name: str, content: str | bytes | None = None) -> Path:
    """Write one of the made files, or a content, under a name."""
    path = folder / name
    path.write_bytes(FILES[name] if content is None else content if isinstance(content, bytes) else content.encode())
    return path


@pytest.mark.parametrize(("name", "unit", "resolution", "channels"), READ, ids=[row[0] for row in READ])
@pytest.mark.parametrize("suffix", ["", ".txt", ".dat"])
def test_a_format_is_read_whatever_its_suffix(
    tmp_path: Path,
    name: str,
    unit: str,
    resolution: float,
    channels: list[tuple[str, float | None, str, str]],
    suffix: str,
) -> None:
    file = put(tmp_path, name + suffix, FILES[name])
    records = read_records(file)
    assert [(r.component, r.azimuth, r.network, r.station) for r in records] == channels
    for number, record in enumerate(records):
        points = 200 if name in ("made.EW", "made.UD2") else POINTS
        assert (record.samples, record.file_unit, record.source) == (points, unit, file)
        assert record.dt == pytest.approx(DT, rel=1e-12)
        assert record.sha256 == hashlib.sha256(FILES[name]).hexdigest()
        expected = np.array(MADE["motion"](number, points)) * 0.01
        if "removed" in " ".join(record.remarks):  # K-NET's mean
            expected -= expected.mean()
        assert np.max(np.abs(record.acceleration - expected)) <= resolution


def test_every_format_has_a_made_file_and_knows_no_other() -> None:
    known: dict[str, set[str]] = {}
    for name, content in FILES.items():
        found = recognise(content.decode()[:8192])
        assert not isinstance(found, tuple), name
        known.setdefault(found.name if found else "columns", set()).add(name)
        others = [one.name for one in FORMATS[:-1] if one is not found and one.recognises(content.decode()[:8192])]
        assert others == [], name
    assert set(known) == {one.name for one in FORMATS}


def test_labels_of_events(tmp_path: Path) -> None:
    events = {name: read_records(put(tmp_path, name))[0].event for name in FILES}
    assert events["made.AT2"] == "Made Up, 1/1/2000"
    assert events["made_v2.cosmos"] == "Made Up Earthquake of Sat Jan 1, 2000 00:00 UTC"
    assert events["made.V2"] == events["made.V1"] == "MADE UP EARTHQUAKE, JAN 1, 2000 00:00 UTC"
    assert events["made.ASC"] == "MADE_UP, 20000101 000000"
    assert events["made.EW"] == "2000/01/01 00:00:00, M 6.0"
    assert events["made.smc"] == "2000 01 01 0000 MADE UP"


def test_channels_are_asked_for_by_number_or_component(tmp_path: Path) -> None:
    for name, label in (("made_v2.cosmos", "90 deg"), ("made.V2", "90 DEG"), ("made.V1", "90 DEG")):
        file = put(tmp_path, name)
        with pytest.raises(RecordFormatError, match=rf"channel of {name} must be given, .* 2: 1 \({label}\), 2 \(U"):
            read_record(file)
        first, second = read_records(file)
        assert (
            read_record(file, channel=1) == read_record(file, channel="1") == read_record(file, channel=label) == first
        )
        assert read_record(file, channel="up") == read_record(file, channel=2) == second
        assert first.name == f"{file.stem} channel 1"
        for wrong in (0, 3, "N", True, 1.5):
            with pytest.raises(RecordFormatError, match=rf"channel of {name} must be one of 2: .*; got"):
                read_record(file, channel=wrong)  # type: ignore[arg-type]
    assert read_record(put(tmp_path, "made.ASC"), channel="HNE").component == "HNE"


def test_velocities_beside_accelerations_are_passed_over(tmp_path: Path) -> None:
    both = MADE["cosmos"](channels=1).encode() + NAMED[-1][1]
    records = read_records(put(tmp_path, "both.V2c", both))
    assert [(record.component, record.samples) for record in records] == [("90 deg", POINTS)]


def test_the_place_in_a_building_is_no_part_of_a_direction(tmp_path: Path) -> None:
    placed = FILES["made.V2"].replace(b"CHAN  1:  90 DEG\n", b"CHAN  1:  90 DEG                  ROOF - EAST WALL\n", 1)
    first = read_records(put(tmp_path, "made.V2", placed))[0]
    assert (first.component, first.azimuth) == ("90 DEG", 90.0)


def test_a_damaged_channel_refuses_the_file(tmp_path: Path) -> None:
    lines = FILES["made.V2"].decode().splitlines(keepends=True)
    second = next(at for at, line in enumerate(lines) if at > 10 and line.startswith("CORRECTED"))
    broken = [
        line.replace("POINTS OF ACCEL", "POINTS OF ACC.") if at > second else line for at, line in enumerate(lines)
    ]
    with pytest.raises(RecordFormatError, match=r"must give the points, step and unit of its accelerations"):
        read_records(put(tmp_path, "made.V2", "".join(broken)))


def swapped(old: str, new: str) -> Callable[[str], str]:
    """Return a change of the first place where `old` stands."""

    def change(text: str) -> str:
        assert old in text
        return text.replace(old, new, 1)

    return change


def without_line(start: str) -> Callable[[str], str]:
    """Return a change that leaves out the first line with this beginning."""

    def change(text: str) -> str:
        lines = text.splitlines(keepends=True)
        at = next(index for index, line in enumerate(lines) if line.lstrip().startswith(start))
        return "".join(lines[:at] + lines[at + 1 :])

    return change


def with_last_line(text: str) -> Callable[[str], str]:
    return lambda content: content + text


WRONG: list[tuple[str, Callable[[str], str], str]] = [
    ("made_v2.cosmos", swapped("pts, approx    4", "pts, approx    9"), r"points of .* must last 9 s, .*; got 203"),
    (
        "made_v2.cosmos",
        swapped("     203 accel", "     204 accel"),
        r"line \d+ of .* must be 4 numbers of 10 characters",
    ),
    ("made_v2.cosmos", swapped("(04)", "(02)"), r"unit of .* must be stated alike .*; got codes \[2, 4\]"),
    (
        "made_v2.cosmos",
        swapped("units=cm/sec2", "units=g"),
        r"unit of .* stated alike by word and code; got g and cm/s2",
    ),
    ("made_v2.cosmos", swapped("(8F10.5)", "(8X10.5)"), r"format of the numbers of .* must be one as \(8F10.3\)"),
    ("made_v2.cosmos", swapped("(8F10.5)", "(7F10.5)"), r"line \d+ of .* must be 7 numbers of 10 characters; got 80"),
    ("made_v2.cosmos", swapped("    -999\n", "    xxxx\n"), r"value 10 of the integer header .* must be a number"),
    ("made_v2.cosmos", swapped(" 100 Integer", "  70 Integer"), r"integer header of .* must be at least 76 values, 70"),
    ("made_v2.cosmos", without_line("|<SCNL>"), r"comments of .* must be 1 lines that start with \|"),
    ("made_v2.cosmos", with_last_line("1.0\n"), r"line \d+ of .* must begin a channel"),
    ("made_v2.cosmos", swapped("   20.000000", "   40.000000"), r"points of .* must last 4.06 s"),
    (
        "made.V2",
        swapped("-169.204", "-168.204"),
        r"peak of made.V2 must be -168.204 at 2.22 s, .*; got -169.204 at 2.22",
    ),
    (
        "made.V2",
        swapped("   203 POINTS OF INSTR", "   204 POINTS OF INSTR"),
        r"points of .* must be 204, .*; got 203 before",
    ),
    ("made.V2", swapped("SEC.  (UNITS: CM/SEC/SEC)", "SEC.  (UNITS: FT/SEC2)"), r"unit of made.V2 must be cm/s2 or g"),
    ("made.V2", swapped("AT  .020 SEC", "AT  .010 SEC"), r"record length of made.V2 must be 4.040 s"),
    ("made.V2", without_line("203 POINTS OF VELOC"), r"must begin its VELOC data"),
    (
        "made.V2",
        swapped("203 POINTS OF DISPL", "190 POINTS OF DISPL"),
        r"points of made.V2 must be 203 of each quantity",
    ),
    ("made.V1", swapped("NO. OF POINTS =    203", "NO. OF POINTS =    302"), r"points of made.V1 must be 302"),
    ("made.V1", swapped("MAX  =   -.173", "MAX  =    .153"), r"peak of made.V1 must be .153 at 2.22 s.*; got -0.17254"),
    ("made_pairs.V1", swapped("  .060", "  .065"), r"times of made_pairs.V1 must be uniform.*read its corrected file"),
    ("made.ASC", swapped("NDATA: 203", "NDATA: 230"), r"points of made.ASC must be 230"),
    ("made.ASC", swapped("DURATION_S: 4.040", "DURATION_S: 9.040"), r"duration of made.ASC must be 9.040 s"),
    ("made.ASC", swapped("UNITS: cm/s^2", "UNITS: cm/s"), r"UNITS of made.ASC must be an acceleration"),
    ("made.ASC", swapped("UNITS: cm/s^2", "UNITS: m/s^2"), r"peak of made.ASC must be -169.*"),
    (
        "made.ASC",
        swapped("INTERVAL_S: 0.02", "INTERVAL_S: soon"),
        r"SAMPLING_INTERVAL_S of .* must be a number; got 'soon",
    ),
    ("made.ASC", without_line("NDATA:"), r"header of made.ASC must have STATION_CODE, .*; got none of NDATA"),
    ("made.EW", swapped("3920(gal)", "3290(gal)"), r"peak of made.EW must be 167.696, .*; got"),
    ("made.EW", swapped("50Hz", "100Hz"), r"points of made.EW must last 4 s, .*; got 200, which last 2 s"),
    ("made.EW", swapped("50Hz", "50kHz"), r"Sampling Freq\(Hz\) of made.EW must be as 100Hz; got '50kHz'"),
    ("made.EW", swapped("E-W", "W-E"), r"Dir. of made.EW must be one of N-S, .*; got 'W-E'"),
    ("made.EW", swapped("(gal)/", "(mgal)/"), r"Scale Factor of made.EW must be as"),
    ("made.EW", without_line("Mag."), r"line 5 of made.EW must be its 'Mag.'"),
    ("made.smc", swapped("203", "202"), r"line \d+ of made.smc must be 2 numbers of 10 characters; got 30"),
    ("made.smc", swapped("    -32768         2\n", "    -32768         3\n"), r"comments of made.smc must be 3 lines"),
    (
        "made.smc",
        swapped("    -32768         2\n", "    -32768         1\n"),
        r"comments of made.smc must be 1, .* more",
    ),
    ("made.smc", with_last_line(" 1.0000E+0\n"), r"points of made.smc must be 203, as its header says; got more"),
    ("made_pairs.smc", swapped(" 2.0000E-2", " 2.5000E-2"), r"times of made_pairs.smc must be uniform.*volume 2"),
    (
        "made_unam.191",
        swapped(": /203/203/203", ": /202/202/202"),
        r"points of .* must be 202, .*; got 203",
    ),
    (
        "made_unam.191",
        swapped(": /203/203/203", ": /204/204/204"),
        r"points of .* must be 204, .*; got 203",
    ),
    ("made_unam.191", swapped(": /203/203", ": /203/302"), r"MUESTRAS, C1-C6 of .* must be one for each of 3 channels"),
    ("made_unam.191", swapped("/0.02/0.02", "/0.02/0.01"), r"MUESTREO, C1-C6 .* must be one for each of 3 channels"),
    ("made_unam.191", swapped("/0.02/0.02/0.02", "/0.04/0.04/0.04"), r"record length of .* must be 4.06 s"),
    ("made_unam.191", swapped("3F10.4", "4F10.4"), r"format of the numbers of .* must be 3 a line; got 4F10.4"),
    ("made_unam.191", swapped(": /-169.2039", ": /-168.2039"), r"peak of .* must be -168.2039 at 2.22 s"),
    ("made_unam.191", swapped("Gal (cm/s/s)", "cuentas"), r"unit of .* must be one of g, .*; got 'cuentas'"),
    ("made_bhrc.V1", swapped("POINTS =  203", "POINTS =  302"), r"points of made_bhrc.V1 must be stated alike twice"),
    (
        "made_bhrc.V1",
        swapped("=  4.060", "=  8.120"),
        r"record length of .* must be 8.120 s, .*; got 203 points of 0.02",
    ),
    ("made_bhrc.V1", swapped("AND G/10", "AND COUNTS"), r"line 12 of made_bhrc.V1 must be UNITS ARE SECONDS AND G/10"),
    ("made_bhrc.V1", swapped("/&", "1.0"), r"line \d+ of made_bhrc.V1 must begin a component, as '\* VOL1DS'"),
    ("made.txt", swapped("npts: 203", "npts: 205"), r"points of made.txt must be 205, as its header says; got 203"),
]


@pytest.mark.parametrize(("name", "change", "message"), WRONG)
def test_a_file_that_contradicts_itself_is_refused(
    tmp_path: Path, name: str, change: Callable[[str], str], message: str
) -> None:
    file = put(tmp_path, name, change(FILES[name].decode()))
    with pytest.raises(RecordFormatError, match=message):
        read_records(file)


@pytest.mark.parametrize("peak", [700.0, 799.9, 800.1, 1102.6, 3215.3])
def test_geonet_drops_the_decimals_of_more_than_a_g(peak: float, tmp_path: Path) -> None:
    """Numbers from 10 000 mm/s2 on stand there without a point, as strong records have them; smaller ones may not."""
    wave = [peak * math.sin(0.3 * step) for step in range(200)]
    text = runpy.run_path(str(ROOT / "tools" / "network_files.py"))["geonet"](lambda _: wave, 0.01)

    def without_point(least: float) -> str:
        lines = text.splitlines()
        for number, line in enumerate(lines):
            fields = [line[edge : edge + 8] for edge in range(0, len(line), 8)]
            if re.fullmatch(r"( *-?\d+\.\d){10}", line):
                short = [f"{one[:-2]:>8}" if abs(float(one)) >= least else one for one in fields]
                lines[number] = "".join(short)
        return "\n".join(lines) + "\n"

    expected = read_records(put(tmp_path, "a.V2A", text))[0].acceleration
    found = read_records(put(tmp_path, "b.V2A", without_point(1e4)))[0].acceleration
    np.testing.assert_allclose(found, expected, atol=1e-3)
    assert (without_point(1e4) != text) == (peak > 800.0)
    with pytest.raises(RecordFormatError, match="must be numbers with a point"):
        read_records(put(tmp_path, "c.V2A", without_point(1e3)))


UNAM_KEYS = re.findall(r"^([A-Z].{3,37}?) *: ", FILES["made_unam.191"].decode(), re.MULTILINE)
OTHER_SIGNS = {
    "a comma more": lambda key: key.replace(" (", ", ("),
    "no commas": lambda key: key.replace(",", " "),
    "accents": lambda key: key.replace("ION", "I\u00d3N").replace("NUM", "N\u00daM"),
    "small letters": str.lower,
    "words behind": lambda key: " ".join(reversed(key.split())) if "," in key else key,
    "blanks": lambda key: key.replace(" ", "  ", 1),
}


@pytest.mark.parametrize("change", OTHER_SIGNS)
def test_institutions_differ_in_the_signs_of_unam_keys(change: str, tmp_path: Path) -> None:
    """The words of a key count. One at a time, then all; the samples a second stand for the step."""
    text = FILES["made_unam.191"].decode()
    plain = read_records(put(tmp_path, "plain.191", text))
    whole = text
    assert len(UNAM_KEYS) > 10
    for number, key in enumerate([*UNAM_KEYS, ""]):
        other = text.replace(f"\n{key} ", f"\n{OTHER_SIGNS[change](key)} ", 1) if key else whole
        whole = whole.replace(f"\n{key} ", f"\n{OTHER_SIGNS[change](key)} ", 1) if key else whole
        records = read_records(put(tmp_path, f"{number}.191", other))
        for one, expected in zip(records, plain, strict=True):
            assert (one.dt, one.component, one.event, one.station) == (
                expected.dt, expected.component, expected.event, expected.station
            )  # fmt: skip
            assert one.acceleration.tolist() == expected.acceleration.tolist()
    rate = text.replace("INTERVALO DE MUESTREO, C1-C6 (s)", "VEL. DE MUESTREO, C1-C6 (muestras/s)")
    rate = rate.replace("/0.02/0.02/0.02", "/50/50/50").replace("FECHA", "INSTITUCION RESPONSABLE : CICESE\nFECHA")
    assert [(one.dt, one.network) for one in read_records(put(tmp_path, "rate.191", rate))] == [(0.02, "CICESE")] * 3


def test_numbers_of_unam_and_bhrc_by_hand(tmp_path: Path) -> None:
    """Four values written by hand: gal are 0.01 m/s2, and g/10 are 0.980665 m/s2; 200 samples a second."""
    unam = without_line("ACEL. MAX.(Gal)")(FILES["made_unam.191"].decode()).partition("N90E\n---")[0]
    unam = unam.replace("/203/203/203", "/4/4/4").replace("/0.02/0.02/0.02", "/0.005/0.005/0.005")
    unam = unam.replace("/4.06/4.06/4.06", "/0.02/0.02/0.02") + "N90E\n---------+---\n"
    unam += "   -0.0083   -0.0214    0.0000\n   25.6114   58.7394  -42.3377\n" * 2
    records = read_records(put(tmp_path, "hand.191", unam))
    assert [record.acceleration.tolist() for record in records] == [
        pytest.approx([-0.000083, 0.256114] * 2, rel=1e-12),
        pytest.approx([-0.000214, 0.587394] * 2, rel=1e-12),
        pytest.approx([0.0, -0.423377] * 2, rel=1e-12),
    ]
    assert {record.dt for record in records} == {0.005}

    lines = FILES["made_bhrc.V1"].decode().splitlines()[:27]
    lines[10] = "NO. OF POINTS =      4      DURATION =   .020"
    lines[14] = "    0" * 11 + "    4    0    0"
    lines[21] = "  .200000E+03" + "  .000000E+00" * 5
    hand = "\n".join([*lines, "  .648367E-03 -.496995E-02  .104140E-01  .100000E+01", "/&"])
    (record,) = read_records(put(tmp_path, "hand.V1", hand))
    expected = [0.0006358308, -0.0048738560, 0.0102126453, 0.980665]
    assert record.acceleration.tolist() == pytest.approx(expected, rel=1e-7)
    assert (record.dt, record.azimuth, record.event) == (0.005, 316.0, "2000/01/01 00:00:00")


def test_arguments_must_agree_with_a_header(tmp_path: Path) -> None:
    for name in ("made_v2.cosmos", "made.V2", "made.ASC", "made.EW", "made.smc"):
        file = put(tmp_path, name)
        assert read_records(file, dt=DT, unit="gal") == read_records(file)
        with pytest.raises(RecordFormatError, match=rf"dt of {name} must agree with its header, .*; got 0.01 s"):
            read_records(file, dt=0.01)
        with pytest.raises(RecordFormatError, match=rf"unit of {name} must be that of its header, cm/s2; got g"):
            read_records(file, unit="g")
        with pytest.raises(RecordFormatError, match=rf"skip of {name} must be left out for an? .* file; got 1"):
            read_records(file, skip=1)
        with pytest.raises(RecordFormatError):
            read_records(file, format="at2")


def test_the_time_of_a_peak_that_differs_is_remarked(tmp_path: Path) -> None:
    file = put(tmp_path, "made.V2", FILES["made.V2"].replace(b"AT    2.220   SEC", b"AT    3.220   SEC", 1))
    assert "the peak is at 2.22 s; the header gives 3.22 s" in read_records(file)[0].remarks


def test_a_short_line_amid_an_at2_file_is_remarked(tmp_path: Path) -> None:
    lines = FILES["made.AT2"].decode().splitlines()
    lines[8], lines[-1] = lines[-1], lines[8]
    remarks = read_record(put(tmp_path, "made.AT2", "\n".join(lines))).remarks
    assert remarks == ("line 9 has another number of values than the others: lines may be missing or moved",)


def test_a_blank_line_amid_a_column_is_remarked(tmp_path: Path) -> None:
    file = put(tmp_path, "made.txt", FILES["made.txt"].replace(b"\n", b"\n\n", 30))
    assert read_record(file).remarks == ("blank lines stand among the numbers: some may be missing or moved",)


def test_a_header_of_esm_with_other_keys_is_remarked(tmp_path: Path) -> None:
    file = put(tmp_path, "made.ASC", without_line("USER3:")(FILES["made.ASC"].decode()))
    assert read_record(file).remarks == ("header has 63 keys, where DYNA 1.x has 64",)


def test_a_peak_without_its_sign_is_remarked(tmp_path: Path) -> None:
    file = put(tmp_path, "made.V2", FILES["made.V2"].replace(b"=  -169.204", b"=   169.204", 1))
    assert any("the peak is negative" in remark for remark in read_records(file)[0].remarks)


def test_remarks_say_what_a_reader_did(tmp_path: Path) -> None:
    remarks = {name: " ".join(read_records(put(tmp_path, name))[0].remarks) for name in FILES}
    assert "mean of" in remarks["made.EW"] and "removed" in remarks["made.EW"]
    assert "pairs of time and acceleration" in remarks["made_pairs.smc"]
    for name in ("made.V1", "made_pairs.V1", "made_v1.cosmos", "made_pairs.smc"):
        assert "uncorrected" in remarks[name]
    for name in ("made.AT2", "made_v2.cosmos", "made.V2", "made.ASC", "made.smc", "made.txt"):
        assert remarks[name] == ""


@pytest.mark.parametrize("name", sorted(FILES))
def test_no_prefix_of_a_file_is_accepted_in_silence(tmp_path: Path, name: str) -> None:
    """A cut file is refused, gives the whole record, or has a remark; rows of times or components have no count."""
    content = FILES[name]
    whole = read_records(put(tmp_path, name))
    ends = sorted({*range(1, len(content), 97), *(at + 1 for at, byte in enumerate(content) if byte == 10)})
    accepted = 0
    for end in ends[-120:] + ends[:-120:5]:
        try:
            records = read_records(put(tmp_path, name, content[:end]))
        except RecordFormatError:
            continue
        same = len(records) == len(whole) and all(
            np.array_equal(a.acceleration, b.acceleration) for a, b in zip(records, whole, strict=True)
        )
        accepted += not same
        assert same or any(r.remarks for r in records), end
    if name in ("made.csv", "made_components.csv", "made_jma.csv", "made_nied.csv"):
        assert accepted > 100
    else:  # whole channels of the files with two; K-NET says whole seconds, so that a line less has a remark
        assert accepted <= 3 * (len(whole) - 1) + 20 * (name in ("made.EW", "made.UD2"))


def test_mutated_files_have_no_defect() -> None:
    """A small run of tools/fuzz_records.py on the made files; the large one is in docs/records.md."""
    tally = FUZZ["fuzz"](1500, 3, None)
    assert tally.total == 1500
    assert [(source, outcome) for source, outcome, _ in tally.defects] == []
    outcomes = {outcome for _, outcome in tally.counts}
    assert {"refused", "same", "remark", "value", "order"} <= outcomes


NAMED: list[tuple[str, bytes, str]] = [
    (
        "a.VT2",
        MADE["at2"](quantity="VELOCITY").encode(),
        r"quantity of a.VT2 must be acceleration; got velocity: read the",
    ),
    (
        "a.dt2",
        MADE["at2"]().encode(),
        r"quantity of a.dt2 must be acceleration; got a .dt2 file, which holds displacement",
    ),
    (
        "a.mseed",
        b"000001D AB12 00HNZCE\x07\xe2\x00\xf1" + bytes(600),
        r"content of a.mseed must be text; got miniSEED: read it by seismass.motions.records.read_counts with",
    ),
    ("a.ms", b"MS\x03\x00" + bytes(60), r"got miniSEED 3"),
    ("a.seed", b"000001V 010009402.3121970,001" + b" " * 60, r"got SEED"),
    ("a.sac", bytes(304) + struct.pack("<i", 6) + bytes(400), r"got SAC"),
    ("b.sac", bytes(304) + struct.pack(">i", 6) + bytes(400), r"got SAC"),
    ("a.gse", b"BEGIN GSE2.0\nMSG_TYPE DATA\n", r"got GSE2"),
    ("b.gse", b"WID2 1990/04/07 00:07:33.000 CRLZ  HHZ\n", r"got GSE2"),
    ("a.h5", b"\x89HDF\r\n\x1a\n" + bytes(64), r"got HDF5 \(ASDF"),
    ("a.mat", b"MATLAB 5.0 MAT-file, Platform: GLNXA64" + bytes(90), r"got MATLAB"),
    ("a.xls", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(64), r"got Excel \(.xls\): save the sheet as CSV"),
    ("a.gz", gzip.compress(FILES["made.AT2"]), r"got gzip: unpack it"),
    ("a.pdf", b"%PDF-1.4\n", r"got PDF: read the data file"),
    (
        "a.AT2",
        b"<!DOCTYPE html>\n<html><body>Sign in</body></html>",
        r"got HTML page: download the file itself, signed in",
    ),
    ("a.xml", b'<?xml version="1.0"?>\n<a/>', r"got XML"),
    ("a.json", b'{\n "a": 1}', r"got JSON"),
    ("b.V1", FILES["made_bhrc.V1"].replace(b"VOL1DS", b"VOL2DS"), r"volume of b.V1 must be 1, uncorrected"),
    ("a.s0a", b"CORRECTED ACCELEROGRAM  IIBB127  94.610.0 COMP N08W   FILE   0  CORRESPONDING T\n", r"got USC volume"),
    ("a.y0a", b"FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:\n", r"got USC volume"),
    (
        "a.V3",
        b"RESPONSE AND FOURIER AMPLITUDE SPECTRA OF\nCORRECTED ACCELEROGRAM\n",
        r"got CSMIP V3 \(spectra\): read its V1",
    ),
    ("a.lfs", b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n", r"got Git LFS pointer"),
    ("a.smc", MADE["smc"](kind="3 VELOCITY").encode(), r"quantity of a.smc must be an .* accelerogram; got velocity"),
    ("a.ASC", MADE["esm"](DATA_TYPE="VELOCITY").encode(), r"quantity of a.ASC must be acceleration; got velocity"),
    (
        "a.v0c",
        MADE["cosmos"](channels=1)
        .replace("units=cm/sec2(04)", "units=counts(50)")
        .replace("       4     120", "      50     120")
        .encode(),
        r"unit of a.v0c must be that of an acceleration; got counts \(V0\)",
    ),
    (
        "a.vel",
        MADE["cosmos"](channels=1)
        .replace("Corrected acceleration", "Corrected velocity    ")
        .replace("       2       1       4", "       2       2       5")
        .replace("acceleration pts", "velocity pts")
        .replace("cm/sec2(04)", "cm/sec(05)")
        .encode(),
        r"quantity of a.vel must be acceleration; got corrected velocity",
    ),
]


@pytest.mark.parametrize(("name", "content", "message"), NAMED, ids=[row[0] for row in NAMED])
def test_a_known_kind_is_refused_by_its_name(tmp_path: Path, name: str, content: bytes, message: str) -> None:
    with pytest.raises(NotRead, match=message):
        read_records(put(tmp_path, name, content))


def test_archives_and_sheets_are_told_apart(tmp_path: Path) -> None:
    sheet = r"got Excel \(.xlsx\): save"
    for member, message in (("a.AT2", "got ZIP: unpack it"), ("[Content_Types].xml", sheet), ("xl/book.xml", sheet)):
        held = io.BytesIO()
        with zipfile.ZipFile(held, "w") as archive:
            archive.writestr(member, "x")
        with pytest.raises(NotRead, match=message):
            read_record(put(tmp_path, "a.zip", held.getvalue()))


def test_units_are_understood_in_their_spellings(tmp_path: Path) -> None:
    for name, known in (
        ("gal", "cm/s2"),
        ("Gal", "cm/s2"),
        ("cm/s^2", "cm/s2"),
        ("cm/sec/sec", "cm/s2"),
        ("CM/SEC**2", "cm/s2"),
        ("m/s²", "m/s2"),
        ("m/sec2", "m/s2"),
        ("G", "g"),
        ("mg", "mg"),
        ("ft/s2", "ft/s2"),
        ("inch/sec^2", "in/s2"),
        ("mm/s/s", "mm/s2"),
        ("% g", "%g"),
        ("cm s-2", "cm/s2"),
        ("cm/seg/seg", "cm/s2"),
        ("kN", None),
        ("cm/s", None),
        ("g m/s2", None),
        ("", None),
    ):
        assert unit_by_name(name) == known, name
    file = put(tmp_path, "a.txt", "0.1\n-0.2\n0.3\n")
    for unit in ("gal", "cm/s2", "Gals"):
        record = read_record(file, dt=0.01, unit=unit)
        assert (record.file_unit, record.pga) == ("cm/s2", pytest.approx(0.003, rel=1e-15))
    assert read_record(put(tmp_path, "b.txt", "acceleration (gal)\n1\n2\n"), dt=0.01).pga == pytest.approx(
        0.02, rel=1e-15
    )


@pytest.mark.parametrize(
    ("component", "azimuth", "vertical"),
    [
        ("90", 90.0, False),
        ("000", 0.0, False),
        ("360 (CDMG STATION 24461)", 0.0, False),
        (" 90 DEG", 90.0, False),
        ("361", None, False),
        ("N36E", 36.0, False),
        ("S16W", 196.0, False),
        ("N10W", 350.0, False),
        ("S80E", 100.0, False),
        ("EAST", 90.0, False),
        ("N-S", 0.0, False),
        ("HNE", 90.0, False),
        ("BHN00", 0.0, False),
        ("HN1", None, False),
        ("H1", None, False),
        ("LONGITUDINAL", None, False),
        ("UP", None, True),
        ("U-D", None, True),
        ("UD1", None, True),
        ("HNZ", None, True),
        ("BHZ10", None, True),
        ("VERTICAL COMP", None, True),
        ("", None, False),
    ],
)
def test_directions(component: str, azimuth: float | None, vertical: bool) -> None:
    assert azimuth_of(component) == azimuth
    assert is_vertical(component) is vertical


@pytest.mark.parametrize(
    ("edit", "columns", "width"),
    [("(8F10.3)", 8, 10), ("(1E15.6)", 1, 15), ("(10I8)", 10, 8), ("8(1pe10.4e1)", 8, 10), ("(1P,5E14.6)", 5, 14)],
)
def test_formats_of_fortran(edit: str, columns: int, width: int) -> None:
    layout = layout_of(edit, "a")
    assert (layout.columns, layout.width, layout.integers) == (columns, width, "I" in edit)


def noise(samples: int = 2000, dt: float = 0.01) -> Record:
    """Return an enveloped noise of some Hz with its peak inside."""
    rng = np.random.default_rng(1)
    smooth = np.convolve(rng.normal(size=samples + 6), np.ones(7) / 7.0, mode="valid")
    return Record(smooth * np.sin(np.linspace(0.0, np.pi, samples)) ** 2, dt)


def test_suspicious_samples_are_remarked() -> None:
    sound = noise()
    assert suspicions(sound, unit_is_stated=True) == ()
    a = sound.acceleration

    def remark(samples: np.ndarray, unit_is_stated: bool = False) -> str:
        return " ".join(suspicions(Record(samples, 0.01), unit_is_stated=unit_is_stated))

    assert "the largest acceleration is the last sample" in remark(np.append(a, -1.2 * sound.pga))
    assert "PGA 6 g is above 5 g: the unit, m/s2, is doubtful" in remark(a * 6.0 * STANDARD_GRAVITY / sound.pga)
    assert "is very small" in remark(a * 1e-4, unit_is_stated=True)
    assert remark(a * 1e-4) == ""
    assert "an offset was not removed" in remark(a + 0.3 * sound.pga)
    assert remark(0.0 * a) == "every sample is zero"
    spiked = a.copy()
    spiked[700] = 10.0 * sound.pga
    assert "sample 701 (t = 7 s) stands out" in remark(spiked)
    displacement = np.cumsum(np.cumsum(a - a.mean())) * 1e-4
    assert "velocity or displacement in place of acceleration" in remark(displacement)


def test_a_folder_takes_every_format_and_says_what_it_leaves_out(tmp_path: Path) -> None:
    """All files are of one motion: each is read in a folder of its own, and together it counts once for a direction."""
    taken = set()
    for name in FILES:
        (tmp_path / name).mkdir()
        put(tmp_path / name, name)
        try:
            taken |= {record.name for record in read_suite(tmp_path / name)}
        except RecordFormatError as error:
            assert "must be at least one horizontal record" in str(error)
    assert taken == {
        "made", "made channel 1", "made.EW", "made_fixed", "made_pairs", "made_v1", "made_v2 channel 1",
        "made_components channel 2", "made_components channel 3", "made_block", "made.cor", "made_csmnc",
        "made_jma channel 1", "made_jma channel 2", "made_nied channel 1", "made_nied channel 2",
        "made_cwa channel 2", "made_cwa channel 3", "made_afad channel 1", "made_afad channel 2",
        "made_unam channel 2", "made_unam channel 3", "made_bhrc channel 1", "made_bhrc channel 3",
    }  # fmt: skip
    put(tmp_path, "copy.AT2", FILES["made.AT2"])
    put(tmp_path, "page.AT2.html", "<html></html>")
    put(tmp_path, "a.vel", NAMED[-1][1])
    put(tmp_path, "list.csv", "file,dt\nmade.AT2,0.02\n")
    put(tmp_path, "unknown.txt", FILES["made.txt"].replace(b"gal", b"counts/s2"))
    suite = read_suite(tmp_path)
    reasons = {item.reason for item in suite.excluded}
    assert "uncorrected; the corrected record of the same motion is taken, copy.AT2" in reasons
    assert "the same recording as copy.AT2, in another format" in reasons
    left = {item.file.name: item.reason for item in suite.excluded}
    assert left["made_cwa.txt"] == "made_cwa channel 1: vertical component by its header: U"
    assert "made channel 2: vertical component by its header: UP" in reasons
    assert left["made.UD2"] == "vertical component by its header: UD2"
    assert "got HTML page" in left["page.AT2.html"]
    assert "got corrected velocity" in left["a.vel"]
    assert left["list.csv"].startswith("not read: .csv files are read by name or from a list")
    assert left["unknown.txt"].startswith("not read: unit of unknown.txt must be given")
    copies = [record for record in suite if any("the same file as" in remark for remark in record.remarks)]
    assert [(record.name, record.remarks[-1]) for record in copies] == [("made", "the same file as copy.AT2")]
    put(tmp_path, "broken.V2", FILES["made.V2"][:9000])
    with pytest.raises(RecordFormatError, match=r"of broken.V2 must"):
        read_suite(tmp_path)


def test_a_list_names_the_channel(tmp_path: Path) -> None:
    put(tmp_path, "made.V2")
    put(tmp_path, "list.csv", "file,channel\nmade.V2,1\n")
    suite = read_suite(tmp_path / "list.csv")
    assert (len(suite), suite[0].azimuth, suite.remarks) == (1, 90.0, ())
    put(tmp_path, "list.csv", "file,channel\nmade.V2,2\n")
    with pytest.raises(RecordFormatError, match=r"must be a horizontal component; got made.V2, component UP"):
        read_suite(tmp_path / "list.csv")


def test_a_file_of_several_channels_gives_its_horizontals(tmp_path: Path) -> None:
    suite = suite_of_file(put(tmp_path, "made.V2"))
    assert [record.component for record in suite] == ["90 DEG"]
    assert suite.excluded[0].reason == "made channel 2: vertical component by its header: UP"
    assert len(suite_of_file(put(tmp_path, "made.UD2"))) == 1
    vertical = FILES["made.V2"].replace(b" 90 DEG", b"UP     ")
    with pytest.raises(RecordFormatError, match=r"channels of up.V2 must be at least one horizontal; got 2 vertical"):
        suite_of_file(put(tmp_path, "up.V2", vertical))


def test_large_foreign_files_cost_a_folder_nothing(tmp_path: Path) -> None:
    """Files of 4 GB (sparse) are known by their first bytes; the limit of 2 s leaves room for a loaded machine."""
    put(tmp_path, "made.AT2")
    for name, head in (("a.bin", b"\0" * 9), ("a.txt", b"1 2 3\n" * 2000), ("a.log", b"words (g)\n" * 2000)):
        file = put(tmp_path, name, head)
        os.truncate(file, 4 * 2**30)
    start = time.process_time()
    suite = read_suite(tmp_path)
    assert time.process_time() - start < 2.0
    assert len(suite) == 1
    assert {item.file.name for item in suite.excluded} == {"a.bin", "a.txt", "a.log"}
    with pytest.raises(RecordFormatError, match=r"size of a.txt must be at most \d+ bytes; got 4294967296"):
        read_record(tmp_path / "a.txt", unit="g", dt=0.01)


def test_reading_time_grows_with_the_size_only(tmp_path: Path) -> None:
    """Ten times the samples take about ten times as long; 40 would show a quadratic part on any machine."""
    times = []
    for points in (8000, 80_000):
        values = "".join(f"{0.01 * np.sin(0.37 * index):.7f}\n" for index in range(points))
        file = put(tmp_path, "a.txt", "# acceleration (g)\n" + values)
        best = min(_seconds(file) for _ in range(3))
        times.append(best)
    assert times[1] < 40.0 * times[0]


def _seconds(file: Path) -> float:
    start = time.process_time()
    read_record(file, dt=0.01)
    return time.process_time() - start


def test_any_file_under_any_format_is_a_record_or_a_format_error(tmp_path: Path) -> None:
    for name, content in {**FILES, "empty": b"\n", "word": b"x", "star": b"*\n*\n" * 9}.items():
        file = put(tmp_path, name, content)
        for one in FORMATS:
            for cut in (len(content), len(content) // 2, len(content) // 9, 1):
                put(tmp_path, name, content[:cut])
                try:
                    records = read_records(file, format=one.name)  # type: ignore[arg-type]
                except RecordFormatError:
                    continue
                assert all(record.samples > 0 for record in records)


@given(st.sampled_from(sorted(FILES)), st.data())
@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_pieces_in_a_file_are_a_record_or_a_format_error(tmp_path: Path, name: str, data: st.DataObject) -> None:
    content = FILES[name]
    at = data.draw(st.integers(0, len(content)))
    pieces = [
        "1e308",
        "9" * 5000,
        "-",
        " ",
        "\n",
        "1e-999",
        "0" * 400 + ".5",
        "\x0b",
        "٣",
        "NaN",
        "(8F10.3)",
        "\x85",
        "E",
    ]
    piece = data.draw(st.one_of(st.sampled_from(pieces), st.text(max_size=20)))
    left_out = data.draw(st.integers(0, 30))
    try:
        records = read_records(put(tmp_path, name, content[:at] + piece.encode() + content[at + left_out :]))
    except RecordFormatError:
        return
    assert all(np.isfinite(record.acceleration).all() for record in records)


@pytest.mark.parametrize(
    "line",
    [
        "NPTS" + " " * 300_000,
        "a" * 300_000,
        "dt(" * 100_000,
        " " * 300_000 + "x",
        "PEAK ACCELERATION =" + " " * 300_000,
    ],
)
@pytest.mark.parametrize(
    "name", ["made.AT2", "made_v2.cosmos", "made.V2", "made.smc", "made.ASC", "made.EW", "made.txt"]
)
def test_long_lines_take_no_time(tmp_path: Path, name: str, line: str) -> None:
    """No pattern searches a long line again and again; a quadratic one would need minutes."""
    lines = FILES[name].decode().splitlines()
    start = time.process_time()
    for at in (0, 1, 3, 20, 45, 46):
        text = "\n".join([*lines[:at], line, *lines[at:]])
        try:
            read_records(put(tmp_path, name, text))
        except RecordFormatError:
            continue
    assert time.process_time() - start < 5.0


def test_numbers_too_large_for_a_motion_are_refused(tmp_path: Path) -> None:
    file = put(tmp_path, "a.txt", "acceleration (g)\n" + "1e308\n" * 9)
    with pytest.raises(RecordFormatError, match=r"samples of a.txt must be those of a motion; got: .*inf at sample 0"):
        read_record(file, dt=0.01)
    large = read_record(put(tmp_path, "a.txt", "acceleration (cm/s2)\n" + "1e300\n-1e300\n" * 200), dt=0.01)
    assert "is above 5 g" in large.remarks[1]
