"""Wrong records: each is refused by a named exception whose message says what of what must be what, and what it was."""

from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from seismass.base.errors import InvalidMotion, RecordFormatError, SeismassError
from seismass.motions.motion import Motion
from seismass.motions.records import Record, Suite, read_record, read_suite
from seismass.motions.records.formats.at2 import parse_at2
from seismass.motions.records.formats.columns import parse_columns

HEADER = "PEER NGA STRONG MOTION DATABASE RECORD\nQuake, 1/1/2000, Town, 90\nACCELERATION TIME SERIES IN UNITS OF G\n"
FIVE = "  -.1000000E-03   .2000000E-03   .3000000E-03  -.4000000E-03   .5000000E-03\n"
GOOD = HEADER + "NPTS=     60, DT=   .0100 SEC\n" + 12 * FIVE
CUT = GOOD[:-5] + "\n"
COLUMN = "".join(f"{0.01 * (-1) ** i * (1 + i % 7):.4f}\n" for i in range(60))
TABLE = "".join(f"{0.01 * i:.2f} 0.1\n" for i in range(60))

# file name, its content, arguments of read_record, message
FILES: list[tuple[str, str | bytes, dict[str, object], str]] = [
    ("a.AT2", "", {}, r"content of a.AT2 must be a record; got an empty file"),
    ("a.AT2", " \n\n", {}, r"content of a.AT2 must be a record; got an empty file"),
    ("a.AT2", b"\x89PNG\0\0", {}, r"content of a.AT2 must be text; got binary data"),
    ("a.AT2", HEADER + 12 * FIVE, {}, r"header of a.AT2 must give NPTS and DT .*; got '-.1000000E-03"),
    (
        "a.AT2",
        GOOD.replace("     60", "     65"),
        {},
        r"points of a.AT2 must be 65, as its header says; got 60: .*cut off",
    ),
    ("a.AT2", GOOD.replace("     60", "     59"), {}, r"points of a.AT2 must be 59, as its header says; got 60"),
    ("a.AT2", GOOD.replace("     60", "     65")[:-8], {}, r"got 60: .* its last number '.5000' looks cut off"),
    ("a.AT2", CUT, {}, r"last number of a.AT2 must be written as the others are; got '.5000000'"),
    ("a.AT2", HEADER + "NPTS= 0, DT= .01 SEC\n", {}, r"points of a.AT2 must be at least 1; got 0"),
    ("a.AT2", GOOD.replace(".0100 SEC", ".0000 SEC"), {}, r"DT of a.AT2 must be a step between .* s; got .0000"),
    ("a.AT2", GOOD.replace(".3000000E-03", "******* "), {}, r"line 5 of a.AT2 must be numbers; got '\*+'"),
    ("a.AT2", GOOD.replace(".3000000E-03", "nan "), {}, r"line 5 of a.AT2 must be numbers; got 'nan'"),
    (
        "a.AT2",
        GOOD.replace(".3000000E-03", ".3000000E+999"),
        {},
        r"numbers of a.AT2 must be finite; got '.3000000E\+999'",
    ),
    ("a.AT2", GOOD.replace("ACCELERATION", "VELOCITY"), {}, r"quantity of a.AT2 must be acceleration; got velocity"),
    (
        "a.AT2",
        GOOD.replace("ACCELERATION", "VELOCITY").replace("NPTS", "\nNPTS"),
        {},
        r"quantity of a.AT2 must be acceleration; got velocity",
    ),
    ("a.AT2", GOOD.replace(".0100 SEC", ".0100 USEC"), {}, r"DT of a.AT2 must be in s or ms; got .0100 USEC"),
    ("a.AT2", GOOD.replace(".0100 SEC", "1/200 SEC"), {}, r"DT of a.AT2 must be in s or ms; got 1/200"),
    ("a.AT2", GOOD.replace(".0100 SEC", ".0010 MS"), {}, r"DT of a.AT2 must be a step between .* s; got .0010 MS"),
    ("a.AT2", GOOD, {"unit": "m/s2"}, r"unit of a.AT2 must be that of its header, g; got m/s2"),
    ("a.AT2", GOOD, {"unit": "ft/s2"}, r"unit of a.AT2 must be that of its header, g; got ft/s2"),
    ("a.AT2", GOOD, {"unit": "km/s2"}, r"unit of a.AT2 must be one of g, m/s2, cm/s2, gal, .*; got 'km/s2'"),
    ("a.AT2", GOOD, {"dt": 0.02}, r"dt of a.AT2 must agree with its header, .0100 s; got 0.02 s"),
    ("a.AT2", GOOD, {"dt": -0.01}, r"dt of a.AT2 must be a positive number; got -0.01"),
    ("a.AT2", GOOD, {"dt": "fast"}, r"dt of a.AT2 must be a number; got 'fast'"),
    ("a.AT2", GOOD, {"skip": 2}, r"skip of a.AT2 must be left out for an .AT2 file; got 2"),
    ("a.AT2", GOOD, {"format": "v2"}, r"format of a.AT2 must be one of knet, .*, at2, columns; got 'v2'"),
    *(
        (
            "a.AT2",
            GOOD.replace("UNITS OF G", unit),
            {},
            rf"unit of a.AT2 must be one of g, m/s2, .*, or be given; got '{unit}'",
        )
        for unit in ("km/s2",)
    ),
    ("a.AT2", GOOD.replace("OF G", "OF G/10"), {}, r"unit of a.AT2 must be one of .*, or be given; got 'G/10' in its"),
    ("a.txt", "dt = 10 us\n" + COLUMN, {"unit": "g"}, r"DT of a.txt must be in s or ms; got 10 us"),
    ("a.txt", "dt = 1/200 s\n" + COLUMN, {"unit": "g"}, r"DT of a.txt must be in s or ms; got 1/200"),
    ("a.txt", "dt = 0,00 s\n" + COLUMN, {"unit": "g"}, r"DT of a.txt must be .*; got 0"),
    ("a.txt", "dt (min) = 1\n" + COLUMN, {"unit": "g"}, r"DT of a.txt must be in s or ms; got 1 min"),
    ("a.txt", "dt = 10\n" + COLUMN, {"unit": "g"}, r"DT of a.txt must be a step between 1e-05 and 1 s; got 10"),
    (
        "a.txt",
        "SAMPLING_INTERVAL_S: 0.005\n" + COLUMN,
        {"unit": "g", "dt": 0.01},
        r"dt of a.txt must agree .* its header, 0.005 s; got 0.01 s",
    ),
    ("a.txt", "NDATA: 61\n" + COLUMN, {"unit": "g", "dt": 0.01}, r"points of a.txt must be 61, .*; got 60"),
    ("a.txt", "Velocity (m/s2)\n" + COLUMN, {"dt": 0.01}, r"quantity of a.txt must be acceleration; got velocity"),
    ("a.txt", "displacements\n" + COLUMN, {"dt": 0.01, "unit": "g"}, r"quantity of a.txt .*; got displacement"),
    ("a.txt", "units: g/10\n" + COLUMN, {"dt": 0.01}, r"unit of a.txt must be given .* states g/10: unit= says which"),
    ("a.txt", COLUMN, {"unit": "g"}, r"dt of a.txt must be given, .*; got none"),
    ("a.txt", COLUMN, {"dt": 0.01}, r"unit of a.txt must be given .*; got none"),
    (
        "a.txt",
        "dt=0.01\n" + COLUMN,
        {"dt": 0.02, "unit": "g"},
        r"dt of a.txt must agree .* its header, 0.01 s; got 0.02 s",
    ),
    (
        "a.txt",
        "(cm/s2)\n" + COLUMN,
        {"dt": 0.02, "unit": "g"},
        r"unit of a.txt must be that of its header, cm/s2; got g",
    ),
    (
        "a.txt",
        "9.81\n0.01\n" + COLUMN,
        {"unit": "g"},
        r"first numbers of a.txt must be samples, or .*; got 9.81 and 0.01",
    ),
    (
        "a.txt",
        "1\n0.01\n" + COLUMN,
        {"unit": "g", "dt": 0.02},
        r"dt of a.txt must agree .* first numbers, 0.01 s; got 0.02",
    ),
    ("a.txt", COLUMN, {"unit": "g", "dt": 0.02, "skip": 60}, r"skip of a.txt must be between 0 and 59; got 60"),
    ("a.txt", COLUMN, {"unit": "g", "dt": 0.02, "skip": "a"}, r"skip of a.txt must be a whole number .*; got 'a'"),
    ("a.txt", COLUMN, {"unit": "g", "dt": 0.02, "skip": 1.0}, r"skip of a.txt must be a whole number .*; got 1.0"),
    ("a.txt", COLUMN, {"unit": ["g"], "dt": 0.02}, r"unit of a.txt must be one of g, m/s2, .*; got \['g'\]"),
    ("a.txt", COLUMN + "oops\n", {"unit": "g", "dt": 0.02}, r"line 61 of a.txt must be numbers; got 'oops'"),
    ("a.txt", COLUMN + "1e999\n", {"unit": "g", "dt": 0.02}, r"line 61 of a.txt must be finite; got infinity"),
    (
        "a.txt",
        COLUMN + "0.2",
        {"unit": "g", "dt": 0.02},
        r"last number of a.txt must be written as the others are; got '0.2'",
    ),
    (
        "a.txt",
        "Dear reader,\nno data\n",
        {},
        r"content of a.txt must be lines of numbers behind a header; got 'Dear reader,'",
    ),
    (
        "a.txt",
        "0.1 0.2 0.3\n" * 9,
        {"unit": "g"},
        r"columns of a.txt must have labels, times first, .*; got 3 numbers a line",
    ),
    ("a.txt", TABLE + "0.1\n", {"unit": "g"}, r"line 1 of a.txt must be 1 number, as the last line is; got 2"),
    (
        "a.txt",
        TABLE.replace("0.30 ", "0.31 "),
        {"unit": "g"},
        r"times of a.txt must be uniform, .*; got 0.31 s in line 31",
    ),
    ("a.txt", TABLE.replace("0.30 0.1\n", ""), {"unit": "g"}, r"times of a.txt must be uniform"),
    ("a.txt", "0.0 0.1\n0.0 0.1\n0.0 0.1\n", {"unit": "g"}, r"times of a.txt must increase; got 0 s first, 0 s last"),
    (
        "a.txt",
        TABLE,
        {"unit": "g", "dt": 0.02},
        r"dt of a.txt must agree with the step of its times, 0.01 s; got 0.02 s",
    ),
]


@pytest.mark.parametrize(("name", "content", "arguments", "message"), FILES)
def test_file_is_refused(
    tmp_path: Path, name: str, content: str | bytes, arguments: dict[str, object], message: str
) -> None:
    file = tmp_path / name
    file.write_bytes(content.encode() if isinstance(content, str) else content)
    with pytest.raises(RecordFormatError, match=message):
        read_record(file, **arguments)


def a_list(text: str) -> Callable[[Path], object]:
    def read(folder: Path) -> object:
        (folder / "a.AT2").write_text(GOOD)
        (folder / "up.AT2").write_text(GOOD.replace("Town, 90", "Town, UP"))
        (folder / "x-UP.AT2").write_text(GOOD)
        (folder / "list.csv").write_text(text)
        return read_suite(folder / "list.csv")

    return read


def only_verticals(folder: Path) -> object:
    (folder / "6.AT2").write_text(GOOD.replace("Town, 90", "Town, UP"))
    return read_suite(folder)


def a_damaged_file(folder: Path) -> object:
    (folder / "a.AT2").write_text(GOOD)
    (folder / "b.AT2").write_text(CUT)
    return read_suite(folder)


# what is done in an empty folder, exception, message
CALLS: list[tuple[Callable[[Path], object], type[SeismassError], str]] = [
    (lambda folder: read_record(folder / "no.AT2"), RecordFormatError, r"record file must be a file .*; got .*no.AT2"),
    (lambda folder: read_record(folder), RecordFormatError, r"record file must be a file that can be read; got"),
    (
        lambda folder: read_suite(folder),
        RecordFormatError,
        r"must be at least one horizontal record; got no file$",
    ),
    (
        lambda folder: read_suite(folder / "no"),
        RecordFormatError,
        r"must be a directory, a ZIP archive or a .csv file; got .*no",
    ),
    (lambda folder: read_suite(folder / "no.csv"), RecordFormatError, r"must be a file that can be read; got .*no.csv"),
    (only_verticals, RecordFormatError, r"must be at least one horizontal record; got 1 vertical components$"),
    (a_damaged_file, RecordFormatError, r"last number of b.AT2 must be written as the others are"),
    (a_list("path\na.AT2\n"), RecordFormatError, r"columns of list.csv must include `file`, .*; got path"),
    (
        a_list("file\n"),
        RecordFormatError,
        r"columns of list.csv must include `file`, with at least one row; got no row",
    ),
    (a_list("file,number\n,1\n"), RecordFormatError, r"file of list.csv, row 1, must be a path; got an empty cell"),
    (a_list("file\na.AT2\n./a.AT2\n"), RecordFormatError, r"file of list.csv, row 2, must be listed once; got ./a.AT2"),
    (a_list("file\nup.AT2\n"), RecordFormatError, r"row 1, must be a horizontal component; got up.AT2, component UP"),
    (
        a_list("file,component\nup.AT2,90\n"),
        RecordFormatError,
        r"row 1, must be a horizontal component; got up.AT2, component UP",
    ),
    (
        a_list("file,component\na.AT2,Z\n"),
        RecordFormatError,
        r"row 1, must be a horizontal component; got a.AT2, component Z",
    ),
    (
        a_list("file,component\na.AT2,\nx-UP.AT2,\n"),
        RecordFormatError,
        r"row 2, must be a horizontal component, or have its `component` given; got x-UP.AT2, vertical by its name",
    ),
    (
        a_list("file,note\na.AT2," + "x" * 200_000 + "\n"),
        RecordFormatError,
        r"content of list.csv must be a table in CSV; got field larger than field limit",
    ),
    (a_list("file\nb.AT2\n"), RecordFormatError, r"record file must be a file that can be read; got .*b.AT2"),
    (a_list("file,dt\na.AT2,soon\n"), RecordFormatError, r"dt of list.csv, row 1, must be a number; got 'soon'"),
    (lambda _: Record([], 0.01), InvalidMotion, r"acceleration of record must be a list of at least one sample; got"),
    (
        lambda _: Record([[0.0]], 0.01),
        InvalidMotion,
        r"acceleration of record must be a list of numbers; got an array of shape \(1, 1\)",
    ),
    (
        lambda _: Record([0.0, float("nan")], 0.01),
        InvalidMotion,
        r"must be finite at every sample; got nan at sample 1",
    ),
    (lambda _: Record(["a"], 0.01), InvalidMotion, r"acceleration of record must be a list of numbers; got \['a'\]"),
    (lambda _: Record([0.0], 0.0, name="x"), InvalidMotion, r"dt of record x must be a positive number; got 0.0"),
    (lambda _: Record([0.0], float("inf")), InvalidMotion, r"dt of record must be a positive number; got inf"),
    (lambda _: Record([0.0], 0.01, vertical=[0.0, 1.0]), InvalidMotion, r"vertical of record must be as long as"),
    (
        lambda _: Record([0.0], 0.01, name="x", remarks="abc"),
        InvalidMotion,
        r"remarks of record x must be a tuple of strings; got 'abc'",
    ),
    (lambda _: Record([0.0], 0.01, remarks=(1,)), InvalidMotion, r"remarks of record must be a tuple of strings; got"),
    (lambda _: Record([0.0], 0.01).scaled(float("nan")), InvalidMotion, r"factor of scaled record must be a finite"),
    (lambda _: Record([0.0], 0.01).time_scaled(-1), InvalidMotion, r"factor of time-scaled record must be a positive"),
    (
        lambda _: Record([9.0], 0.01).scaled(1e308),
        InvalidMotion,
        r"must be finite at every sample; got inf at sample 0",
    ),
    (lambda _: Record([9.0], 0.01).with_duration(-1.0), InvalidMotion, r"duration of motion must be between 0 and"),
    (
        lambda _: Record([0.0], 0.01, name="x").with_vertical(None),
        InvalidMotion,
        r"vertical of record x must be a Record; got None",
    ),
    (lambda _: Suite("x", 5), InvalidMotion, r"records of suite x must be a tuple of Record objects; got 5"),
    (
        lambda _: Suite("x", (Record([0.0], 0.01), Motion([0.0], 0.01))),
        InvalidMotion,
        r"record 2 of suite x must be of class Record; got Motion\(",
    ),
    (
        lambda _: Suite("x", (), ("a",)),
        InvalidMotion,
        r"excluded file 1 of suite x must be of class Excluded; got 'a'",
    ),
    (lambda _: Suite(None, ()), InvalidMotion, r"name of suite must be a string; got None"),
]


@pytest.mark.parametrize(("call", "exception", "message"), CALLS)
def test_call_is_refused(
    tmp_path: Path, call: Callable[[Path], object], exception: type[SeismassError], message: str
) -> None:
    with pytest.raises(exception, match=message):
        call(tmp_path)


PIECES = [
    "NPTS=",
    "DT=",
    " 3",
    ", ",
    " .01",
    "\n",
    " 1",
    "-.5E-03",
    "0.02",
    "\t",
    "#",
    "nan",
    "9e999",
    "dt=0",
    "E",
    "(g)",
]


@given(st.one_of(st.text(), st.lists(st.sampled_from(PIECES)).map("".join)))
def test_any_text_is_a_record_or_a_format_error(text: str) -> None:
    for parse in (parse_at2, parse_columns):
        for arguments in ({}, {"unit": "g", "dt": 0.01}):
            try:
                record = parse(text, Path("a.txt"), **arguments)
            except RecordFormatError:
                continue
            assert record.samples > 0


def test_truncated_recording_is_refused(shared: Path) -> None:
    with pytest.raises(RecordFormatError, match=r"must be 4531, .* got 1621: .* last number '0.4751' looks cut off"):
        read_record(shared / "record_formats/at2_variants/truncated_files/43.AT2")
