"""One motion counts once: volumes, formats, archives; and what is known of a record from headers and flatfiles."""

from __future__ import annotations

import io
import re
import runpy
import zipfile
from pathlib import Path

import numpy as np
import pytest

import seismass as sm
from seismass import cli
from seismass.base.errors import RecordFormatError
from seismass.motions.records import Record, find_pairs, read_record, read_records, read_suite
from seismass.motions.records.known import band_remarks, known_of_header, known_words

MADE = runpy.run_path(str(Path(__file__).parents[1] / "tools" / "record_files.py"))
FILES: dict[str, bytes] = dict(MADE["files"]())
POINTS = 1200
TIME = 0.01 * np.arange(POINTS)


def motion(seed: int = 0) -> np.ndarray:
    """Return a motion of 12 s (m/s2) with a peak of 2.9 m/s2, another one for each seed."""
    rng = np.random.default_rng(seed)
    noise = np.convolve(rng.normal(size=POINTS), np.hanning(9), "same") * np.exp(-(((TIME - 5.0) / 2.0) ** 2))
    return 2.9 * noise / np.max(np.abs(noise))


def at2(values: np.ndarray, title: str = "Somewhere, 1/1/2000, Town, 90", dt: float = 0.01) -> str:
    """Return an .AT2 file."""
    rows = "".join(f"{value / 9.80665:15.7E}\n" for value in values)
    return f"PEER\n{title}\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {len(values)}, DT= {dt:.4f} SEC\n{rows}"


def smc(
    values: np.ndarray,
    kind: str,
    component: str = "90",
    station: str = "Town",
    rate: float = 100.0,
    filters: tuple[float, ...] = (),
) -> str:
    """Return an SMC file of volume 1 or 2 with no more in its header than asked; `filters` are reals 33 to 36."""
    text = "\n".join(
        [
            f"{2 if kind == 'corrected' else 1} {kind.upper()} ACCELEROGRAM",
            "*",
            "TOWN",
            "     2000  1  1  0000 Somewhere" if station else "*",
            "Moment Mag=      6.5",
            f"station = {station}      component= {component}" if station else "*",
            "epicentral dist =   12.0       pk     =",
            "inst type=X  data source = X",
            *"***",
        ]
    )
    whole = [-32768] * 48
    whole[15], whole[16] = 0, len(values)
    reals = [1.7e38] * 50
    reals[1] = rate
    reals[32 : 32 + len(filters)] = filters
    head = "\n".join("".join(f"{one:10d}" for one in whole[at : at + 8]) for at in range(0, 48, 8))
    head += "\n" + "\n".join("".join(f"{one:15.7E}" for one in reals[at : at + 5]) for at in range(0, 50, 5))
    cells = [f"{100.0 * value:10.4f}" for value in values]
    rows = "\n".join("".join(cells[at : at + 8]) for at in range(0, len(cells), 8))
    return f"{text}\n{head}\n{rows}\n"


def column(values: np.ndarray, head: str = "dt = 0.01 s, acceleration (m/s2)") -> str:
    """Return a column of accelerations."""
    return head + "\n" + "".join(f"{value:.5f}\n" for value in values)


def raw(values: np.ndarray) -> np.ndarray:
    """Return the motion as it is before it is corrected: with a slow drift and some noise, no offset."""
    return values + 0.12 * np.sin(0.4 * TIME[: len(values)]) + 0.02 * np.sin(90.0 * TIME[: len(values)])


@pytest.mark.parametrize("station", ["Town", ""])
@pytest.mark.parametrize("names", [("tst_u.smc", "tst_a.smc"), ("a.smc", "z.smc"), ("V1/x.smc", "V2/x.smc")])
def test_of_two_volumes_the_corrected_one_counts(tmp_path: Path, station: str, names: tuple[str, str]) -> None:
    """With the same labels in their headers or with none, whatever the files are called."""
    for name, values, kind in zip(names, (raw(motion()), motion()), ("uncorrected", "corrected"), strict=True):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(smc(values, kind, station=station), encoding="utf-8")
    (record,) = read_suite(tmp_path)
    assert not any("uncorrected" in remark for remark in record.remarks)
    (left,) = read_suite(tmp_path).excluded
    assert left.reason.startswith("uncorrected; the corrected record of the same motion is taken, ")


def test_pairs_are_of_corrected_components(tmp_path: Path) -> None:
    for component, seed in (("90", 1), ("360", 2)):
        for kind, values in (("uncorrected", raw(motion(seed))), ("corrected", motion(seed))):
            (tmp_path / f"{kind[:2]}{component}.smc").write_text(smc(values, kind, component), encoding="utf-8")
    (pair,) = find_pairs(tmp_path)
    assert {pair.first.name[:2], pair.second.name[:2]} == {"co"}
    assert len(read_suite(tmp_path)) == 2


def test_other_motions_of_one_folder_all_count(tmp_path: Path) -> None:
    """Uncorrected ones without a corrected one, other motions, and components of one recording are no doubles."""
    for seed in range(4):
        (tmp_path / f"a{seed}.smc").write_text(smc(raw(motion(seed)), "uncorrected", "90", ""), encoding="utf-8")
        (tmp_path / f"b{seed}.smc").write_text(smc(motion(10 + seed), "corrected", "90", ""), encoding="utf-8")
    assert len(read_suite(tmp_path)) == 8


WRITERS = {
    "a.AT2": at2,
    "b.smc": lambda values: smc(values, "corrected"),
    "c.txt": column,
    "d.csv": lambda values: (
        "time (s),acceleration E (gal)\n"
        + "".join(f"{time:.2f},{100.0 * value:.4f}\n" for time, value in zip(TIME, values, strict=True))
    ),
    "e.dat": lambda values: column(values / 9.80665, "dt = 0.01 s\nAcceleration in g"),
}


@pytest.mark.parametrize("first", WRITERS)
@pytest.mark.parametrize("second", WRITERS)
def test_the_same_recording_in_two_formats_counts_once(tmp_path: Path, first: str, second: str) -> None:
    for name in {first, second}:
        (tmp_path / name).write_text(WRITERS[name](motion()), encoding="utf-8")
    suite = read_suite(tmp_path)
    assert [record.source.name for record in suite if record.source] == [min(first, second)]
    reasons = [one.reason for one in suite.excluded]
    assert reasons == ([f"the same recording as {min(first, second)}, in another format"] if first != second else [])


LEFT_OUT = {
    "vertical": smc(motion(1), "corrected", "UP"),
    "an offset": smc(motion(1) + 1.8, "uncorrected"),
    "not read": "a word\n",
    "an empty file": "",
}


@pytest.mark.parametrize("where", ["folder", "archive", "archive in an archive"])
@pytest.mark.parametrize("reason", LEFT_OUT)
def test_a_suite_is_never_empty_and_its_place_is_named(tmp_path: Path, reason: str, where: str) -> None:
    """Whatever leaves the last record out, the error says where it was looked for and why; no temporary folder."""
    place = tmp_path / ("records" if where == "folder" else "records.zip")
    if where == "folder":
        place.mkdir()
        (place / "a.smc").write_text(LEFT_OUT[reason], encoding="utf-8")
    else:
        inner = io.BytesIO()
        with zipfile.ZipFile(inner, "w") as packed:
            packed.writestr("a.smc", LEFT_OUT[reason])
        content = inner.getvalue()
        if where != "archive":
            with zipfile.ZipFile(place, "w") as packed:
                packed.writestr("inner.zip", content)
        else:
            place.write_bytes(content)
    with pytest.raises(RecordFormatError, match=rf"^records of \w+ \S*records\S* must be .*{reason}") as error:
        read_suite(place)
    assert ".seismass" not in str(error.value)


def test_an_uncorrected_record_with_an_offset_is_left_out(tmp_path: Path) -> None:
    (tmp_path / "a.smc").write_text(smc(motion(1) + 1.8, "uncorrected"), encoding="utf-8")
    (tmp_path / "b.smc").write_text(smc(motion(2), "corrected", "180"), encoding="utf-8")
    suite = read_suite(tmp_path)
    assert [record.name for record in suite] == ["b"]
    assert "uncorrected, and its mean is" in suite.excluded[0].reason


def zipped(content: dict[str, str | bytes]) -> bytes:
    """Return a ZIP archive."""
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in content.items():
            archive.writestr(name, text)
    return held.getvalue()


@pytest.mark.parametrize("depth", [0, 1, 2])
def test_pairs_and_suites_of_archives_in_archives(tmp_path: Path, depth: int) -> None:
    inside: dict[str, str | bytes] = {
        "station/RSN1_TST000.AT2": at2(motion(1), "Somewhere, 1/1/2000, Town, 0"),
        "station/RSN1_TST090.AT2": at2(motion(2), "Somewhere, 1/1/2000, Town, 90"),
    }
    for level in range(depth):
        inside = {f"level{level}.zip": zipped(inside), "README.txt": "no record"}
    archive = tmp_path / "peer.zip"
    archive.write_bytes(zipped(inside))
    assert len(read_suite(archive)) == 2
    (pair,) = find_pairs(archive)
    assert pair.azimuths == (0.0, 90.0)
    assert pair.first.source is not None
    assert str(pair.first.source).startswith(str(archive))
    assert sorted(file.name for file in tmp_path.iterdir()) == ["peer.zip"]


def test_an_archive_that_never_ends_is_a_file_that_is_not_read(tmp_path: Path) -> None:
    inside: dict[str, str | bytes] = {"a.AT2": at2(motion())}
    for level in range(12):
        inside = {f"{level}.zip": zipped(inside)}
    (tmp_path / "deep.zip").write_bytes(zipped(inside))
    with pytest.raises(RecordFormatError, match="must be at least one horizontal record"):
        read_suite(tmp_path / "deep.zip")


def test_channels_of_one_file_are_a_pair(tmp_path: Path) -> None:
    head = "# Sim stat=s001\n#    time(sec)      N-S(cm/s/s)      E-W(cm/s/s)      U-D(cm/s/s)\n"
    for seed, name in enumerate(("s1.acc.bbp", "s2.acc.bbp")):
        columns = [TIME, *(100.0 * motion(3 * seed + at) for at in range(3))]
        rows = "".join("  ".join(f"{value:.6e}" for value in row) + "\n" for row in zip(*columns, strict=True))
        (tmp_path / name).write_text(head + rows, encoding="utf-8")
    pairs = find_pairs(tmp_path)
    assert len(pairs) == 2
    assert all(pair.azimuths == (0.0, 90.0) and pair.vertical is not None for pair in pairs)


@pytest.mark.parametrize("per_line", [2, 3, 4, 5])
@pytest.mark.parametrize("dt", [0.01, 0.005, 0.02])
def test_pairs_of_time_and_sample_several_a_line(tmp_path: Path, per_line: int, dt: float) -> None:
    """As ETABS and SAP2000 write functions; the last line may be short."""
    values = motion()[:1199]
    cells = [f"{dt * at:.3f} {value:.6f}" for at, value in enumerate(values)]
    text = "\n".join(" ".join(cells[at : at + per_line]) for at in range(0, len(cells), per_line)) + "\n"
    (tmp_path / "a.txt").write_text(text, encoding="utf-8")
    record = read_record(tmp_path / "a.txt", unit="m/s2")
    assert (record.samples, record.dt) == (1199, dt)
    np.testing.assert_allclose(record.acceleration, values, atol=1e-6)


def test_unusual_ways_to_write_a_motion(tmp_path: Path) -> None:
    """RSPMatch's three first numbers, quoted numbers, a block of velocities behind, a factor that is only stated."""
    values = motion()
    block = "".join("".join(f"{one:15.6E}" for one in values[at : at + 5]) + "\n" for at in range(0, POINTS, 5))
    file = tmp_path / "a.acc"
    file.write_text(f"Matched acceleration\n    {POINTS}    0.0100   656\n{block}", encoding="utf-8")
    matched = read_record(file, unit="m/s2")
    assert (matched.samples, matched.dt) == (POINTS, 0.01)
    quoted = "".join(f'"{time:.2f}","{value:.6f}"\n' for time, value in zip(TIME, values, strict=True))
    file.write_text(f'"time (s)","acceleration (m/s2)"\n{quoted}', encoding="utf-8")
    assert read_record(file).samples == POINTS
    file.write_text(f"Acceleration (m/s2), time step 0.010 s\n{block}Velocity (m/s)\n{block}", encoding="utf-8")
    first = read_record(file)
    assert (first.samples, any("'Velocity (m/s)' is not read" in one for one in first.remarks)) == (POINTS, True)
    file.write_text(f"Acceleration NS (m/s2), dt = 0.01\n{block}Acceleration EW (m/s2)\n{block}", encoding="utf-8")
    with pytest.raises(RecordFormatError, match=r"line 242 of a\.acc must be numbers; got a second block"):
        read_record(file)
    file.write_text(column(values, "Scale factor: 0.5\ndt = 0.01 s, acceleration (m/s2)"), encoding="utf-8")
    assert any("scale factor of 0.5" in one for one in read_record(file).remarks)


def test_lines_that_stand_twice_are_refused(tmp_path: Path) -> None:
    lines = [f"{time:.2f},{value:.6f}" for time, value in zip(TIME, motion(), strict=True)]
    file = tmp_path / "a.csv"
    head = "time (s),acceleration (m/s2)"
    file.write_text("\n".join([head, *(line for one in lines for line in (one, one))]) + "\n", encoding="utf-8")
    for given in ({}, {"dt": 0.005}):
        with pytest.raises(
            RecordFormatError, match=r"line \d+ of a\.csv must differ from the one before; got lines twice"
        ):
            read_record(file, **given)
    file.write_text("\n".join([head, *lines[:600], lines[599], *lines[600:]]) + "\n", encoding="utf-8")
    with pytest.raises(RecordFormatError, match=r"times of a\.csv must be uniform"):
        read_record(file)


def test_rows_behind_those_that_are_counted(tmp_path: Path) -> None:
    """A file of UNAM with two rows more than its header counts is read with a remark; with many more it is refused."""
    name = next(name for name in FILES if "unam" in name)
    text = FILES[name].decode("latin-1").rstrip("\n")
    last = text.splitlines()[-1]
    plain = read_records(put(tmp_path, name, text + "\n"))
    more = read_records(put(tmp_path, name, f"{text}\n{last}\n{last}\n"))
    assert [one.samples for one in more] == [one.samples for one in plain]
    assert any("2 repetitions of the last row" in remark for remark in more[0].remarks)
    with pytest.raises(RecordFormatError, match="points of"):
        read_records(put(tmp_path, name, "\n".join([text, *[last] * 2000]) + "\n"))


def put(folder: Path, name: str, text: str) -> Path:
    """Write a file."""
    (folder / name).write_text(text, encoding="latin-1")
    return folder / name


def told(folder: Path, name: str, text: str) -> list[str]:
    """Return the remarks on peaks of a file."""
    return [
        remark
        for record in read_records(put(folder, name, text))
        for remark in record.remarks
        if remark.startswith("the peak is")
    ]


def test_a_header_with_both_extremes_is_no_doubt(tmp_path: Path) -> None:
    name = next(name for name in FILES if "cwa" in name)
    text = FILES[name].decode("latin-1")
    assert told(tmp_path, name, text) == []
    wrong = re.sub(r"(AmplitudeMAX\. N:\s*)[-\d.]+(~\s*)[-\d.]+", r"\g<1>900.0\g<2>-900.0", text)
    with pytest.raises(RecordFormatError, match=r"peak of .* must be"):
        read_records(put(tmp_path, name, wrong))


@pytest.mark.parametrize("lead", [0.0, 1.0, 2.0])
def test_peaks_are_counted_from_where_headers_count(tmp_path: Path, lead: float) -> None:
    """GeoNet's corrected files have some seconds before the record, by their 62nd number; RENADIC counts from the
    trigger. Neither is a doubt, and a peak elsewhere still is one.
    """
    lines = FILES["made.V2A"].decode().splitlines()
    lines[22] = f"{lines[22][:8]}{lead:8.2f}{lines[22][16:]}"
    geonet = "\n".join(lines).replace("at  2.22 s", f"at {2.22 - lead:5.2f} s") + "\n"
    assert not any("2.22" in one for one in told(tmp_path, "a.V2A", geonet))
    assert any(
        "2.22" in one for one in told(tmp_path, "a.V2A", geonet.replace(f"at {2.22 - lead:5.2f} s", "at  3.50 s"))
    )
    lines = FILES["made_pairs.V1"].decode().splitlines()
    lines[2] = "01/01/2000 3:53:52 (GMT)                (ORIGIN: 01/01/2000 3:53:52 GMT)"
    lines[3] = f"                                   TRIGGER TIME: 1/1/2000 3:53:{52 + lead:06.3f} GMT"
    lines[7] = "UNIVERSIDAD DE CHILE - RENADIC"
    renadic = "\n".join(lines).replace("AT   2.220 SEC", f"AT   {2.22 - lead:.3f} SEC") + "\n"
    assert told(tmp_path, "a.V1", renadic) == []
    assert told(tmp_path, "a.V1", renadic.replace(f"AT   {2.22 - lead:.3f} SEC", "AT   3.500 SEC")) != []


HEADERS = [
    ("MAGNITUDE_W: 6.5\nMAGNITUDE_L: 6.1\n", {"magnitude": 6.5}),
    ("HYPOCENTER: 36.25N,120.28W, H=9KM. ML=6.5(BRK)", {"magnitude": 6.5}),
    ("Hypocenter: 61.34640 -149.95520 H= 46km Mw=7.0", {"magnitude": 7.0}),
    ("Moment Mag=      7.1 Ms=      7.1", {"magnitude": 7.1}),
    ("#Magnitude(Ml): 6.0", {"magnitude": 6.0}),
    ("Mag.              6.2", {"magnitude": 6.2}),
    ("MAGNITUD(ES)  : /Ms=7.1", {"magnitude": 7.1}),
    ("Hypocenter: To be determined.  ML:  To be determined.", {}),
    ("ML= 0.00", {}),
    ("EPICENTRAL_DISTANCE_KM: 88.1", {"distance_km": 88.1}),
    ("epicentral dist =     89.0       pk     =    104.4", {"distance_km": 89.0}),
    ("Bearing S18W  Dist    9km  Depth   15km Mw 7.82", {"distance_km": 9.0, "magnitude": 7.82}),
    ("Free field, distance 30 m from the bridge", {}),
    ("VS30_M/S: 420", {"vs30": 420.0}),
    ("Vs30 (m/s): 380.5", {"vs30": 380.5}),
    ("VS30_M/S: \nSITE: B", {}),
    ("FOCAL_MECHANISM: strike slip", {"mechanism": "strike slip"}),
    ("LOW_CUT_FREQUENCY_HZ: 0.100\nHIGH_CUT_FREQUENCY_HZ: 30.000", {"lowest_hz": 0.125, "highest_hz": 30.0}),
    ("Filter Cut-off Frequency (Hz) : 1.500 - 50.000", {"lowest_hz": 1.875, "highest_hz": 50.0}),
    ("bandpass filtered with 3 dB pts at   .30 and 40.00 cyc/sec", {"lowest_hz": 0.375, "highest_hz": 40.0}),
    ("FILTERED WITH RAMPS AT  .050- .100 AND 23.00-25.00 CYC/SEC", {"lowest_hz": 0.1, "highest_hz": 23.0}),
    ("transition bands are .10-.25 Hz and 24.50-25.50 Hz", {"lowest_hz": 0.25, "highest_hz": 24.5}),
    ("filtered below  0.03 Hz (periods over 33.33 secs), and above 20.0 Hz", {"lowest_hz": 0.0375, "highest_hz": 20.0}),
    ("Data is unfiltered", {}),
]  # fmt: skip


@pytest.mark.parametrize(("header", "expected"), HEADERS)
def test_what_headers_say_of_event_path_site_and_band(header: str, expected: dict[str, object]) -> None:
    """A corner is 0.8 of the lowest usable frequency; behind a ramp all passes."""
    found = known_of_header(header)
    assert found == {
        name: pytest.approx(value) if isinstance(value, float) else value for name, value in expected.items()
    }


@pytest.mark.parametrize("kind", ["corrected", "uncorrected"])
@pytest.mark.parametrize(
    ("filters", "band"),
    [
        ((), (None, None)),
        ((0.1, -4.0), (0.125, None)),
        ((0.08, -2.0, 75.0, 80.0), (0.1, 75.0)),
        ((1.7e38, 1.7e38, 23.0, 25.0), (None, 23.0)),
        ((0.0, 0.0, 0.0, 0.0), (None, None)),
        ((30.0, -4.0, 23.0, 25.0), (None, None)),
    ],
)
def test_smc_states_the_filter_of_corrected_records(
    kind: str, filters: tuple[float, ...], band: tuple[float | None, float | None], tmp_path: Path
) -> None:
    """What is missing, zero or in the wrong order is no corner; an uncorrected record has none."""
    (tmp_path / "a.smc").write_text(smc(motion(1), kind, filters=filters), encoding="utf-8")
    record = sm.read_record(tmp_path / "a.smc")
    assert (record.lowest_hz, record.highest_hz) == (pytest.approx(band) if kind == "corrected" else (None, None))


def test_epicentral_distance_of_coordinates() -> None:
    """A degree of latitude is 6371 pi/180 = 111.2 km."""
    text = "Lat.              41.0\nLong.             142.5\nStation Lat.      42.0\nStation Long.     142.5\n"
    assert known_of_header(text) == {"distance_km": pytest.approx(111.2, abs=0.05)}


SEARCH = (
    " PEER Ground Motion Database\n\nResult ID, Record Sequence Number, Scale Factor, Magnitude, Mechanism, Rjb (km), "
    "Rrup (km), Vs30 (m/sec), Lowest Useable Frequency (Hz), Horizontal-1 Acc. Filename, Horizontal-2 Acc. Filename\n"
    "1, 7, 1.8, 6.7, strike slip, 12.1, 12.4, 380.0, 0.25, RSN7_TST000.AT2, RSN7_TST090.AT2\n"
)
FLATFILE = (
    "Record Sequence Number,Earthquake Magnitude,Mechanism Based on Rake Angle,ClstD (km),"
    "Vs30 (m/s) selected for analysis,Lowest Usable Freq - Ave. Component (Hz),File Name (Horizontal 1)\n"
    "7,6.7,0,12.4,380.0,0.25,RSN7\\RSN7_TST000.AT2\n8,-999,2,-999,500,-999,RSN8\\RSN8_TST000.AT2\n"
)


@pytest.mark.parametrize("table", [SEARCH, FLATFILE])
def test_tables_beside_the_files(tmp_path: Path, table: str) -> None:
    (tmp_path / "_SearchResults.csv").write_text(table, encoding="utf-8")
    for name, component, seed in (("RSN7_TST000", "0", 1), ("RSN7_TST090", "90", 2), ("RSN9_TST000", "0", 3)):
        (tmp_path / f"{name}.AT2").write_text(at2(motion(seed), f"A, 1/1/2000, B, {component}"), encoding="utf-8")
    suite = read_suite(tmp_path)
    assert [record.magnitude for record in suite] == [6.7, 6.7, None]
    first = suite[0]
    assert (first.distance_km, first.vs30, first.mechanism, first.lowest_hz) == (12.4, 380.0, "strike slip", 0.25)
    row = suite.table().row(0, named=True)
    assert [row[name] for name in ("magnitude", "distance_km", "vs30", "mechanism", "lowest_hz")] == [
        6.7, 12.4, 380.0, "strike slip", 0.25,
    ]  # fmt: skip
    pair = next(pair for pair in find_pairs(tmp_path) if pair.first.magnitude)
    assert known_words(pair.first) == "M 6.7, 12.4 km, Vs30 380 m/s, strike slip, usable from 0.25 Hz"


def test_use_beyond_the_band_is_a_remark(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Usable to 1/0.25 = 4 s; at T = 1 s the range ends at 1.5 s, at T = 3 s at 4.5 s."""
    (tmp_path / "_SearchResults.csv").write_text(SEARCH, encoding="utf-8")
    for name, component, seed in (("RSN7_TST000", "0", 1), ("RSN7_TST090", "90", 2), ("RSN9_TST000", "0", 3)):
        (tmp_path / f"{name}.AT2").write_text(at2(motion(seed), f"A, 1/1/2000, B, {component}"), encoding="utf-8")
    suite, target = read_suite(tmp_path), sm.TargetSpectrum.asce7(1.0, 0.6)
    said = "the suite is used beyond the band of its records: RSN7_TST000 is usable to 4 s and used to 4.5 s"
    assert any(remark.startswith(said) for remark in sm.scaling.scale_asce7_10(suite, target, 3.0).remarks)
    assert not any("beyond" in remark for remark in sm.scaling.scale_asce7_10(suite, target, 1.0).remarks)
    assert cli.main(["records", str(tmp_path)]) == 0
    assert "usable from 0.25 Hz" in capsys.readouterr().out
    assert band_remarks([Record([0.0, 1.0], 0.01, name="a", highest_hz=25.0)], 0.02, 1.0) == [
        "the suite is used beyond the band of its records: a is usable from 0.04 s and used from 0.02 s"
    ]


def test_columns_of_factors_stand_apart() -> None:
    """Factors above a thousand have ten characters: their columns widen."""
    from seismass.show.motions import factor_lines

    weak = [sm.Record(1e-4 * motion(seed), 0.01, name=f"m{seed}") for seed in range(3)]
    scaling = sm.scaling.scale_asce7_10(weak, sm.TargetSpectrum.asce7(1.0, 0.6))
    assert scaling.factors.max() > 1000.0
    for line, factor in zip(factor_lines(scaling)[1:4], scaling.factors, strict=True):
        assert f" {factor:.5f} " in line
