"""Reading records: every header vintage, columns of text, suites. Recordings where SEISMASS_SHARED has them."""

import csv
import math
import pickle
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from seismass.base.errors import InvalidMotion, RecordFormatError
from seismass.base.units import STANDARD_GRAVITY, stated_unit, unknown_unit
from seismass.commands.options import left_out
from seismass.motions.motion import Motion
from seismass.motions.records import Record, Suite, builtin_suite, read_record, read_suite
from seismass.motions.records.formats.common import NO_COUNT, is_cut_off, split_touching

VALUES_G = [0.001, -0.25, 0.125, 1.5e-4, -3.0e-3, 0.0, 0.0625]
FIELDS = "".join(f"{value:15.7E}" for value in VALUES_G)


def at2(
    counts: str = "NPTS=      7, DT=   .0100 SEC", body: str = FIELDS, title: str = "Quake, 1/1/2000, Town, 90"
) -> str:
    first, third = "PEER NGA STRONG MOTION DATABASE RECORD", "ACCELERATION TIME SERIES IN UNITS OF G"
    return f"{first}\n{title}\n{third}\n{counts}\n{body}\n"


@pytest.mark.parametrize(
    "counts",
    [
        "NPTS=      7, DT=   .0100 SEC",
        "NPTS=      7  DT=   .0100 SEC,     ",
        "NPTS=  7, DT= 0.0100",
        "NPTS=  7, dt=   .0100 SEC",
        "npts = 7 , dt = 1.0E-02 sec",
        "NPTS=   7, DT=   .01000 SEC,  -5 POLE @      .06000 HZ,   0 POLE @      .00000",
        "    7    0.0100    NPTS, DT",
        "NPTS=7,DT=.01SEC",
    ],
)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_every_style_of_counts(tmp_path: Path, counts: str, end: str) -> None:
    file = tmp_path / "a.AT2"
    file.write_bytes(at2(counts).replace("\n", end).encode())
    record = read_record(file)
    assert record.dt == 0.01
    np.testing.assert_allclose(record.acceleration, np.array(VALUES_G) * STANDARD_GRAVITY, rtol=1e-15)


@pytest.mark.parametrize(
    "body",
    [
        "\n".join(f"{value:.7E}" for value in VALUES_G),
        "".join(f"{value:+.7E}" for value in VALUES_G),  # fields touch at their signs
        "".join(f"{value:.7E}" for value in VALUES_G),  # and where there is no sign, at their exponents
        " ".join(f"{value:.7E}".replace("E", "D") for value in VALUES_G),
        FIELDS + "\n" + f"{0:15.7E}" * 3,  # zeros that fill the last line
        FIELDS + "\n\n\x1a",
    ],
)
def test_every_layout_of_numbers(tmp_path: Path, body: str) -> None:
    file = tmp_path / "a.at2"
    file.write_text(at2(body=body))
    np.testing.assert_allclose(read_record(file).acceleration, np.array(VALUES_G) * STANDARD_GRAVITY, rtol=1e-15)


def test_header_labels(tmp_path: Path) -> None:
    file = tmp_path / "RSN1_QUAKE_TWN090.AT2"
    file.write_text(at2())
    record = read_record(file)
    assert (record.name, record.event, record.station, record.component) == (
        "RSN1_QUAKE_TWN090",
        "Quake, 1/1/2000",
        "Town",
        "90",
    )
    assert (record.source, record.file_unit, record.synthetic, record.remarks) == (file, "g", False, ())
    assert record.duration == pytest.approx(0.06)
    assert record.pga_g == pytest.approx(0.25, rel=1e-15)


def test_rounded_step_is_remarked_and_can_be_given(tmp_path: Path) -> None:
    file = tmp_path / "a.AT2"
    file.write_text(at2("NPTS=      7, DT=   .0039 SEC"))
    as_written = read_record(file)
    assert as_written.dt == 0.0039
    assert "1/256" in as_written.remarks[0]
    assert read_record(file, dt=1 / 256).dt == 1 / 256


@given(st.lists(st.floats(-9.0, 9.0).filter(lambda x: x == 0.0 or abs(x) > 1e-98), min_size=1, max_size=8))
def test_touching_fields_come_apart(values: list[float]) -> None:
    fields = [f"{value:.7E}" for value in values]
    assert split_touching("".join(fields)) == fields


@pytest.mark.parametrize("token", ["0.1234560.234567", "1.0-", "2020-11-12", "--1.0", "1.2.3", "nan", "0x1p3"])
def test_ambiguous_runs_are_not_split(token: str) -> None:
    assert split_touching(token) is None


def test_cut_off_is_seen_in_fixed_formats_only() -> None:
    fixed = [f"{math.sin(i):.6E}" for i in range(100)]
    assert not is_cut_off(fixed)
    assert all(is_cut_off([*fixed, fixed[1][:-n]]) for n in (1, 4, 5, 9))
    free = [repr(math.sin(i)) for i in range(100)] + ["0.5"]
    assert not is_cut_off([*free, "0.25"])


def test_a_number_with_its_exponent_is_whole() -> None:
    """Python prints short exponents' mantissas short; a cut takes the exponent before it takes decimals."""
    for scale in (1.0, 1e-5):  # few exponents, and one in every number
        free = [repr(scale * math.sin(i)) for i in range(1, 100)]
        assert not is_cut_off([*free, "1e-05"])
        assert not is_cut_off([*free, "1.5e-05"])
    assert is_cut_off([*free, free[0].partition("e")[0]])


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("ACCELERATION TIME SERIES IN UNITS OF G", "g"),
        ("# Time (s),Acceleration (g's)", "g"),
        ("UNITS: cm/s^2", "cm/s2"),
        ("acceleration, cm/sec/sec", "cm/s2"),
        ("acc (gal)", "cm/s2"),
        ("time in s, acceleration in g", "g"),
        ("acc. in G's", "g"),
        ("acceleration in good order", None),
        ("acceleration in g/10", None),
        ("acceleration (m/s2)", "m/s2"),
        ("a in m/s**2", "m/s2"),
        ("ground motion at Big Gorge", None),
        ("(g) or (m/s2)", None),
        ("IN UNITS OF G. FILTER POINTS: HP=0.1 Hz", "g"),
        ("cm/s\N{SUPERSCRIPT TWO}", "cm/s2"),
        ("Velocity in m/s\n2000 points", None),
        ("m/s 2000 points", None),
        ("units: g/10", None),
        ("UNITS OF MG", "mg"),
        ("ACCELERATION (MG)", "mg"),
        ("accel in %g", "%g"),
        ("acceleration (% of g)", "%g"),
        ("FT/S/S", "ft/s2"),
        ("IN/SEC/SEC", "in/s2"),
        ("(mm/s2)", "mm/s2"),
    ],
)
def test_unit_stated_in_a_header(text: str, unit: str | None) -> None:
    assert stated_unit(text) == unit


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("UNITS OF 0.1 G", "0.1 G"),
        ("UNITS OF .02 M/S2", ".02 M/S2"),
        ("UNITS OF .01 M/S2", None),  # that is cm/s2
        ("units: g/10", "g/10"),
        ("(g) or (m/s2)", "g and m/s2"),
        ("UNITS OF G", None),
        ("UNITS:\nVS30_M/S: 2", None),
    ],
)
def test_unknown_unit_of_a_header(text: str, unit: str | None) -> None:
    assert unknown_unit(text) == unit


TWO_COLUMNS = "0.00 0.1\n0.02 -0.3\n0.04 0.2\n0.06 0.0\n"


@pytest.mark.parametrize(
    ("text", "arguments", "dt", "samples"),
    [
        ("0.1\n-0.3\n0.2\n0.0\n", {"dt": 0.02, "unit": "m/s2"}, 0.02, [0.1, -0.3, 0.2, 0.0]),
        ("# dt = 0.02\n# units: m/s2\n0.1\n-0.3\n0.2\n0.0\n", {}, 0.02, [0.1, -0.3, 0.2, 0.0]),
        (TWO_COLUMNS, {"unit": "m/s2"}, 0.02, [0.1, -0.3, 0.2, 0.0]),
        (TWO_COLUMNS, {"unit": "m/s2", "dt": 0.02}, 0.02, [0.1, -0.3, 0.2, 0.0]),
        (TWO_COLUMNS.replace(" ", ","), {"unit": "cm/s2"}, 0.02, [0.001, -0.003, 0.002, 0.0]),
        ("t;a (m/s2)\n" + TWO_COLUMNS.replace(" ", ";"), {}, 0.02, [0.1, -0.3, 0.2, 0.0]),
        ("4 0.02\n" + TWO_COLUMNS, {"unit": "m/s2"}, 0.02, [0.1, -0.3, 0.2, 0.0]),  # count and step
        ("4 0.02\n0.1\n-0.3\n0.2\n0.0\n", {"unit": "m/s2"}, 0.02, [0.1, -0.3, 0.2, 0.0]),
        ("1\n0.02\n0.1\n-0.3\n0.2\n0.0\n", {"unit": "m/s2"}, 0.02, [0.1, -0.3, 0.2, 0.0]),  # scale and step
        ("4\n0.02\n0.1\n-0.3\n0.2\n0.0\n", {"unit": "m/s2", "dt": 0.02}, 0.02, [0.1, -0.3, 0.2, 0.0]),
        ("9.81\n0.02\n0.1\n-0.3\n0.2\n0.0\n", {"unit": "m/s2", "dt": 0.02, "skip": 2}, 0.02, [0.1, -0.3, 0.2, 0.0]),
        ("1\n0.02\n0.1\n-0.3\n", {"unit": "m/s2", "dt": 0.05, "skip": 0}, 0.05, [1.0, 0.02, 0.1, -0.3]),
        ("0.3\n0.02\n0.1\n-0.3\n0.2\n0.0\n", {"unit": "m/s2", "dt": 0.1}, 0.1, [0.3, 0.02, 0.1, -0.3, 0.2, 0.0]),
    ],
)
def test_columns(tmp_path: Path, text: str, arguments: dict[str, object], dt: float, samples: list[float]) -> None:
    file = tmp_path / "motion.txt"
    file.write_text(text)
    record = read_record(file, **arguments)
    assert record.dt == dt
    np.testing.assert_allclose(record.acceleration, samples, rtol=1e-15)


@pytest.mark.parametrize("dt", [0.01, 0.005, 1 / 256, 0.0025, 1 / 3])
def test_step_from_printed_times_is_the_short_decimal(tmp_path: Path, dt: float) -> None:
    file = tmp_path / "motion.csv"
    file.write_text("".join(f"{i * dt:.10f}, {math.sin(i):.6f}\n" for i in range(3000)))
    assert read_record(file, unit="g").dt == pytest.approx(dt, rel=1e-12 if dt < 0.3 else 1e-9)


@pytest.mark.parametrize("form", ["{!r}", "{:g}", "{:.4f}", "{:.6e}"])
@pytest.mark.parametrize("start", [0, 1])
def test_step_gives_every_time_back_to_its_last_digit(tmp_path: Path, form: str, start: int) -> None:
    """The last of 5121 times is 40.0 or 40: that it is round says nothing of the others."""
    file = tmp_path / "motion.csv"
    file.write_text("".join(f"{form.format(i / 128)},{math.sin(i)!r}\n" for i in range(start, 5121)))
    record = read_record(file, unit="g")
    assert record.dt == pytest.approx(1 / 128, rel=1e-6)
    if start == 0:
        assert (record.dt, record.duration) == (1 / 128, 40.0)
    assert read_record(file, unit="g", dt=1 / 128).dt == 1 / 128


@pytest.mark.parametrize(
    ("header", "dt"),
    [
        ("dt = 10 ms", 0.01),
        ("dt (msec): 7", 0.007),
        ("Delta T = .02 s, 4 points", 0.02),
        ("time step [s] = 0.02 seconds", 0.02),
        ("dt=0.02 npts=4", 0.02),
        ("dt = 0.02 (sec).", 0.02),
        ("dt = 20 ms: four points", 0.02),
        ("DT: 2D-2", 0.02),
        ("SAMPLING_INTERVAL_S: 0.020000\nNDATA: 4", 0.02),
    ],
)
def test_step_stated_in_a_header(tmp_path: Path, header: str, dt: float) -> None:
    file = tmp_path / "motion.txt"
    file.write_text(header + "\n0.1\n-0.3\n0.2\n0.0\n")
    assert read_record(file, unit="m/s2").dt == dt


def test_step_of_an_at2_header_has_its_unit(tmp_path: Path) -> None:
    file = tmp_path / "a.AT2"
    for written, dt in ((".5 MSEC", 0.0005), ("10 ms", 0.01), (".0100 SEC.", 0.01), (".0100 s", 0.01)):
        file.write_text(at2(f"NPTS=      7, DT=   {written}"))
        assert read_record(file).dt == dt


def test_of_two_units_of_an_at2_header_the_caller_says_which(tmp_path: Path) -> None:
    file = tmp_path / "a.AT2"
    file.write_text(at2().replace("UNITS OF G", "(G) OR (FT/S/S)"))
    assert read_record(file, unit="g").pga_g == pytest.approx(0.25, rel=1e-15)
    with pytest.raises(RecordFormatError, match=r"unit of a\.AT2 must be that of its header, ft/s2 and g; got m/s2"):
        read_record(file, unit="m/s2")


def test_a_header_may_speak_of_velocity_beside_acceleration(tmp_path: Path) -> None:
    file = tmp_path / "motion.txt"
    for header in ("Acceleration (m/s2), velocity corrected", "(m/s2), shear wave velocity of the site: 300 m/s"):
        file.write_text(header + "\n0.1\n0.2\n")
        assert read_record(file, dt=0.01).pga == 0.2


def test_record_is_immutable_and_scaling_makes_new_ones() -> None:
    samples = np.array([0.0, 1.0, -2.0])
    record = Record(samples, 0.01, vertical=[0.0, 0.5, 0.0])
    samples[0] = 9.0
    assert record.acceleration[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        record.acceleration[0] = 1.0
    scaled = record.scaled(-3.0)
    assert scaled.acceleration.tolist() == [0.0, -3.0, 6.0]
    assert scaled.vertical is not None
    assert scaled.vertical.tolist() == [0.0, -1.5, 0.0]
    assert record.time_scaled(0.5).dt == 0.005
    assert (record.pga, record.samples, record.dt) == (2.0, 3, 0.01)


def test_record_has_the_times_and_durations_of_its_motion() -> None:
    record = Record([1.0, 2.0, 3.0], 0.01, "x", vertical=[4.0, 5.0, 6.0], remarks=("cut",))
    np.testing.assert_array_equal(record.time, record.motion.time)
    assert record.time.tolist() == [0.0, 0.01, 0.02]
    for duration in (0.0, 0.012, 0.05):
        changed = record.with_duration(duration)
        assert changed.motion == record.motion.with_duration(duration)
        assert (changed.name, changed.remarks) == ("x", ("cut",))


def test_records_and_suites_are_equal_by_content() -> None:
    record = Record([0.0, 1.0], 0.01, "x", vertical=[0.0, 2.0])
    same = Record(np.array([-0.0, 1.0]), 0.01, "x", vertical=(0.0, 2.0))
    assert record == same and hash(record) == hash(same) and record is not same
    assert {record: 1}[same] == 1
    changes = ({"name": "y"}, {"dt": 0.02}, {"acceleration": [0.0, 2.0]}, {"vertical": None}, {"synthetic": True})
    assert all(record != record.replace(**change) for change in changes)
    assert record != record.motion
    assert record.replace(remarks=["cut"]) == record.replace(remarks=("cut",))
    again = pickle.loads(pickle.dumps(record))
    assert again == record and not again.acceleration.flags.writeable
    assert builtin_suite() == builtin_suite() and hash(builtin_suite()) == hash(builtin_suite())
    assert Suite("a", (record,)) == Suite("a", [same]) != Suite("b", (record,))


def test_vertical_cuts_both_to_the_shorter() -> None:
    record = Record([1.0, 2.0, 3.0], 0.01).with_vertical(Record([4.0, 5.0], 0.01))
    assert record.acceleration.tolist() == [1.0, 2.0]
    assert record.vertical is not None
    assert record.vertical.tolist() == [4.0, 5.0]
    assert "3 horizontal, 2 vertical" in record.remarks[0]
    with pytest.raises(InvalidMotion, match="dt of vertical record"):
        Record([1.0], 0.01).with_vertical(Record([1.0], 0.02))


def test_directory_takes_horizontals_and_lists_the_rest(tmp_path: Path) -> None:
    horizontal = ["b/RSN2_B_STA000.AT2", "a_STA090.at2", "b/c/RIVERSIDE-E.At2", "RSN6_I-ELC180-hor1.AT2"]
    by_name = ["a_STA-UP.AT2", "a_STAUP.AT2", "a_HECVER.at2", "b/1059-V.AT2", "b/ERZ-UP__copy.AT2", "b/X_VERT.AT2"]
    by_header = {"6.AT2": "UP", "7.AT2": "VER", "8.AT2": "VERTICAL COMP", "9.AT2": "V", "10.AT2": "up (CDMG STATION 1)"}
    others = {
        "notes.txt": "not read: .txt files are read by name or from a list, where their units can be given",
        "b/RSN2_B_STA000.VT2": "not read: .VT2 files hold velocities",
        "b/RSN2_B_STA000.dt2": "not read: .dt2 files hold displacements",
        "README": "not read: files without a suffix are read by name or from a list, where their units can be given",
    }
    for name in (*horizontal, *by_name, *by_header, *others, ".hidden.AT2", ".git/config"):
        file = tmp_path / name
        file.parent.mkdir(parents=True, exist_ok=True)
        no_record = "Notes on the records (g)\n0.1 to 0.2\n" if name in ("notes.txt", "README") else None
        file.write_text(no_record or at2(title=f"Quake, 1/1/2000, Town, {by_header.get(name, '90')}"))
    suite = read_suite(tmp_path)
    taken = [record.source.relative_to(tmp_path).as_posix() for record in suite if record.source]
    assert taken == sorted(horizontal)
    reasons = {item.file.relative_to(tmp_path).as_posix(): item.reason for item in suite.excluded}
    assert list(reasons) == sorted([*by_name, *by_header, *others])
    assert {name: reasons[name] for name in others} == others
    assert all("vertical component by its" in reasons[name] for name in (*by_name, *by_header))
    table = suite.table()
    assert table["taken"].sum() == len(horizontal) == len(suite)
    assert table.height == len(horizontal) + len(by_name) + len(by_header) + len(others)
    lines = left_out(suite)
    # More than eight files are counted by reason; vertical components are one reason by name and one by header.
    assert "left out 5 files, 10.AT2 and others: vertical component by its header" in lines
    assert "left out 1 file, b/RSN2_B_STA000.VT2".replace("b/", "") + ": not read: .VT2 files hold velocities" in lines
    assert len(lines) == 6
    assert sum(int(line.split()[2]) for line in lines) == len(suite.excluded)


def test_directory_without_records_says_what_is_there(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("0.1\n0.2\n")
    with pytest.raises(
        RecordFormatError, match=r"got 0 vertical components and 1 other files, a\.txt not read: \.txt files"
    ):
        read_suite(tmp_path)


def test_list_of_files_keeps_order_and_labels(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "a.AT2").write_text(at2())
    (tmp_path / "b.txt").write_text("0.1\n0.2\n")
    (tmp_path / "list.csv").write_text(
        "\ufeffnumber,file,station,dt,unit,note\n2,b.txt,Here,0.02,m/s2,\n1,in/a.AT2,,,,a substitute\n",
        encoding="utf-8",
    )
    suite = read_suite(tmp_path / "list.csv")
    assert [record.name for record in suite] == ["b", "a"]
    assert [record.station for record in suite] == ["Here", "Town"]
    assert (suite[0].dt, suite[0].pga, suite[1].remarks) == (0.02, 0.2, ("a substitute",))


def test_a_scale_of_a_list_is_applied_and_other_columns_are_named(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("0.1\n-0.2\n")
    (tmp_path / "list.csv").write_text("number,file,dt,unit,scale,magnitude,Vs30\n1,a.txt,0.02,m/s2,1.5,7.1,300\n")
    suite = read_suite(tmp_path / "list.csv")
    assert suite[0].acceleration.tolist() == [0.1 * 1.5, -0.2 * 1.5]
    assert suite[0].remarks == (NO_COUNT, "scaled by 1.5 as listed")
    assert suite.remarks == ("columns of list.csv that are not used: magnitude, Vs30",)
    assert left_out(suite) == list(suite.remarks)
    (tmp_path / "list.csv").write_text("file,dt,unit,scale\na.txt,0.02,m/s2,\n")
    plain = read_suite(tmp_path / "list.csv")
    assert (plain[0].pga, plain[0].remarks, plain.remarks) == (0.2, (NO_COUNT,), ())
    for cell in ("nan", "inf", "twice"):
        (tmp_path / "list.csv").write_text(f"file,dt,unit,scale\na.txt,0.02,m/s2,{cell}\n")
        with pytest.raises(RecordFormatError, match=r"scale of list\.csv, row 1, must be a"):
            read_suite(tmp_path / "list.csv")


def test_list_says_that_a_name_is_not_of_a_vertical(tmp_path: Path) -> None:
    (tmp_path / "river.AT2").write_text(at2())  # ends as HECVER does
    (tmp_path / "list.csv").write_text("file,component\nriver.AT2,H1\n")
    assert read_suite(tmp_path / "list.csv")[0].component == "H1"


# What the sources of the recordings say: file, step (s), points, PGA (g) to five decimals.
RECORDINGS = [
    ("01_Hector_Mine_1999_Hector/RSN1787_HECTOR_HEC000.AT2", 0.01, 4531, 0.26547),
    ("01_Hector_Mine_1999_Hector/RSN1787_HECTOR_HEC090.AT2", 0.01, 4531, 0.32819),
    ("02_Loma_Prieta_1989_Gilroy_Array_3/RSN767_LOMAP_G03000.AT2", 0.005, 7997, 0.55912),
    ("02_Loma_Prieta_1989_Gilroy_Array_3/RSN767_LOMAP_G03090.AT2", 0.005, 7998, 0.36823),
    ("03_Imperial_Valley_1979_Brawley_Airport/RSN161_IMPVALL.H_H-BRA225.AT2", 0.005, 7576, 0.16261),
    ("03_Imperial_Valley_1979_Brawley_Airport/RSN161_IMPVALL.H_H-BRA315.AT2", 0.005, 7575, 0.21952),
    ("04_Duzce_1999_Lamont_1059/RSN1612_DUZCE_1059-E.AT2", 0.01, 4067, 0.13665),
    ("04_Duzce_1999_Lamont_1059/RSN1612_DUZCE_1059-N.AT2", 0.01, 4067, 0.15235),
    ("05_Erzincan_1992_Erzincan/RSN821_ERZINCAN_ERZ-EW__was_NearWithPulse_11.AT2", 0.005, 4156, 0.49618),
    ("05_Erzincan_1992_Erzincan/RSN821_ERZINCAN_ERZ-NS__was_NearWithPulse_12.AT2", 0.005, 4262, 0.38671),
    ("06_Imperial_Valley_1940_El_Centro_Array_9/RSN6_IMPVALL.I_I-ELC180-hor1.AT2", 0.01, 5372, 0.28080),
    ("06_Imperial_Valley_1940_El_Centro_Array_9/RSN6_IMPVALL.I_I-ELC270-hor2.AT2", 0.01, 5346, 0.21074),
]


@pytest.mark.parametrize(("file", "dt", "points", "pga_g"), RECORDINGS)
def test_recordings(shared: Path, file: str, dt: float, points: int, pga_g: float) -> None:
    record = read_record(shared / "records" / file)
    assert (record.dt, record.samples) == (dt, points)
    assert record.pga_g == pytest.approx(pga_g, abs=0.51e-5)  # the table rounds to five decimals


def test_all_recordings_are_a_suite(shared: Path) -> None:
    suite = read_suite(shared / "records")
    files = [file for file in (shared / "records").rglob("*.AT2") if file.is_file()]
    vertical = [item for item in suite.excluded if item.reason.startswith("vertical component")]
    assert len(suite) + len(vertical) == len(files)
    assert len(vertical) == 6  # one vertical for each of the paper's records 1 to 6
    assert all(item in vertical or item.reason.startswith("not read: ") for item in suite.excluded)
    assert not any(record.synthetic for record in suite)


def test_peaks_agree_with_the_flatfile(shared: Path) -> None:
    """RotD50 is a median over directions, so it lies between the components as recorded, or close to them."""
    with (shared / "records/reference/nga_w2_selected.csv").open(encoding="utf-8", errors="replace") as file:
        rotd50 = {row["Record Sequence Number"]: float(row["PGA (g)"]) for row in csv.DictReader(file)}
    peaks: dict[str, list[float]] = {}
    for record in read_suite(shared / "records"):
        peaks.setdefault(record.name.partition("_")[0].removeprefix("RSN"), []).append(record.pga_g)
    pairs = {number: pair for number, pair in peaks.items() if len(pair) == 2 and number in rotd50}
    assert len(pairs) >= 12
    for number, pair in pairs.items():
        # A polarised motion |cos| has its median direction 0.707 of the largest; noise can only bring them closer.
        assert 0.7 * max(pair) < rotd50[number] < 1.05 * math.hypot(*pair), number


@pytest.mark.parametrize(
    ("file", "dt", "points"),
    [
        ("crlf/RSN1616_DUZCE_362-E.AT2", 0.01, 4316),
        ("crlf_and_missing_comma/RSN6953_DARFIELD_PRPCS.AT2", 0.005, 10800),
        ("lower_case_dt/PBFEAS.AT2", 0.01, 2364),
        ("no_SEC_in_header/42.AT2", 0.02, 2676),
        ("old_header_pacific_engineering/ALH360.AT2", 0.02, 3000),
        ("one_value_per_line/GM11.AT2", 0.005, 8000),
    ],
)
def test_header_vintages_of_real_files(shared: Path, file: str, dt: float, points: int) -> None:
    record = read_record(shared / "record_formats/at2_variants" / file)
    assert (record.dt, record.samples) == (dt, points)
    assert record.event and record.station and record.component


def test_real_columns(shared: Path) -> None:
    formats = shared / "record_formats"
    hector = read_record(formats / "single_column/4_HECTOR000.txt", unit="g")
    assert (hector.dt, hector.samples) == (0.01, 4531)
    column = np.loadtxt(formats / "single_column/4_HECTOR000.txt")
    np.testing.assert_array_equal(hector.acceleration, column[2:] * STANDARD_GRAVITY)
    assert "not as samples" in hector.remarks[0]
    el_centro = read_record(formats / "single_column/el_centro.th", unit="g", dt=0.02)
    assert (el_centro.samples, el_centro.remarks) == (1560, (NO_COUNT,))
    assert el_centro.pga_g == pytest.approx(0.3188, abs=1e-4)  # El Centro 1940 NS as widely used
    esm = read_record(formats / "esm/HI.ARS1..HNE.D.20190728.160908.C.ACC.ASC")
    assert (esm.dt, esm.samples, esm.file_unit) == (0.005, 19128, "cm/s2")
    assert esm.pga == pytest.approx(0.300022e-2, rel=1e-9)
    chi_chi = read_record(formats / "two_column/ChiChi.txt", unit="g")
    assert (chi_chi.dt, chi_chi.samples) == (0.005, 11800)
    duzce = read_record(formats / "two_column/Duzce_1999_375-090.csv")  # its header says g
    assert (duzce.dt, duzce.samples) == (0.01, 3077)


@pytest.mark.parametrize(
    ("unit", "factor"), [("m/s2", 1.0), ("g", 9.80665), ("cm/s2", 0.01), ("Gal", 0.01), ("m/s/s", 1.0)]
)
def test_a_unit_converts_wherever_it_stands(unit: str, factor: float) -> None:
    """Samples given, of records and of motions, horizontal and vertical; what is kept is in m/s2 and converts once."""
    samples, up = [0.0, 0.398, -0.1], [0.0, 0.2, 0.1]
    record = Record(samples, 0.01, unit=unit, vertical=up)
    motion = Motion(samples, 0.01, up, unit=unit)
    for one in (record, motion, record.replace(name="again"), pickle.loads(pickle.dumps(record))):
        np.testing.assert_allclose(one.acceleration, factor * np.array(samples), rtol=1e-15)
        np.testing.assert_allclose(one.vertical, factor * np.array(up), rtol=1e-15)
    assert not record.acceleration.flags.writeable
    assert record.scaled(2.0).pga == pytest.approx(2.0 * 0.398 * factor, rel=1e-15)


def test_a_unit_that_is_none_is_refused() -> None:
    for made in (Record, Motion):
        with pytest.raises(InvalidMotion, match=r"unit of .* must be one of g, m/s2, cm/s2, gal, .*; got 'bananas'"):
            made([0.0, 1.0], 0.01, unit="bananas")


def test_suites_slice_and_scale() -> None:
    suite = builtin_suite("eleven")
    part = suite[2:5]
    assert isinstance(part, Suite)
    assert (part.name, part.records) == (suite.name, suite.records[2:5])
    assert suite[-1] is suite.records[-1]
    doubled = part.scaled(2.0)
    for before, after in zip(part, doubled, strict=True):
        np.testing.assert_array_equal(after.acceleration, 2.0 * before.acceleration)
        assert after.name == before.name
    with pytest.raises(InvalidMotion, match="factor of scaled record must be"):
        suite.scaled(np.nan)
