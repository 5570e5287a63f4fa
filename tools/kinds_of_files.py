"""Kinds of files that stand beside records or are written in unusual ways: made here, read, and put into a table.

tools/pages/records.py puts the table into docs/records.md. The motion is a sum of decaying sines with its largest
value, 0.3 g, at sample 501 of 1200; nothing recorded is in the files. A test says whether each is read rightly or
refused for its cause, here and, where SEISMASS_SHARED names a folder, in files of the same kinds that others made.
"""

from __future__ import annotations

import math
import re
import runpy
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from seismass.base.errors import RecordFormatError
from seismass.base.values import printable
from seismass.motions.records import read_records

ROOT = Path(__file__).parents[1]
NETWORKS = runpy.run_path(str(ROOT / "tools" / "network_files.py"))
SMALL = runpy.run_path(str(ROOT / "tools" / "record_files.py"))

POINTS = 1200
DT = 0.01
PEAK_G = 0.3
G = 9.80665


@dataclass(frozen=True)
class Kind:
    """One kind: what is in the file, how it is read, and what should become of it.

    `refused` is a pattern of the message, or empty where it is read; then `dt` and `peak_g` are those of the first
    channel, `channels` how many there are, and `remark` a pattern of a remark.
    """

    content: bytes
    arguments: dict[str, object] = field(default_factory=dict)
    refused: str = ""
    channels: int = 1
    dt: float = DT
    peak_g: float = PEAK_G
    remark: str = ""
    points: int = POINTS


def motion(channel: int = 0) -> list[float]:
    """Return accelerations (g), small at both ends; of the first channel the largest is `PEAK_G`."""
    found = []
    for index in range(POINTS):
        time = index * DT
        envelope = math.exp(-(((time - 5.0) / 2.0) ** 2))
        found.append(envelope * (math.cos(8.0 * (time - 5.0)) + 0.3 * math.sin((20.0 + channel) * (time - 5.0))))
    largest = max(map(abs, found))
    return [value / largest * PEAK_G * (1.0 - 0.2 * channel) for value in found]


def _at2(title: str = "Example, 1/2/2003, Test Station, 0", dt: str = ".0100", points: int = POINTS) -> str:
    head = f"PEER NGA STRONG MOTION DATABASE RECORD\n{title}\nACCELERATION TIME SERIES IN UNITS OF G\n"
    return head + f"NPTS={points:6d}, DT=   {dt} SEC\n" + _five()


def _five(factor: float = 1.0) -> str:
    lines: str = NETWORKS["in_lines"]([f"{factor * value:15.7E}" for value in motion()], 5)
    return lines


def _table(head: str, factor: float = 1.0, time: Callable[[int], str] = lambda index: f"{index * DT:.2f}") -> bytes:
    rows = (f"{time(index)},{factor * value:.7f}\n" for index, value in enumerate(motion()))
    return (head + "\n" + "".join(rows)).encode()


def _column(head: str, factor: float = 1.0) -> bytes:
    return (head + "\n" + "".join(f"{factor * value:.6f}\n" for value in motion())).encode()


def _gal(channel: int) -> list[float]:
    return [100.0 * G * value for value in motion(channel)]


def _rotated() -> str:
    return (
        "Orig PEER filename = XX/H-XXX_233_FN.acc, Scale factor = 2.4072\n"
        "  H1 for rotation: EXAMPLE 01/02/03 0405, TEST STATION, 000 (XX STATION 1)\n"
        "  H2 for rotation: EXAMPLE 01/02/03 0405, TEST STATION, 270 (XX STATION 1)\n"
        "  rotation angle - clockwise   -37.0\n  FN component, azimuth =   233.0\n  Acceleration in g\n"
        f"{POINTS} 0.0100 NPTS, DT\n" + _five()
    )


def _blank_smc() -> str:
    return re.sub(
        r"(?m)^(?:NOW0A|     2000.*|Moment.*|station.*|epicentral.*|inst type.*)$", "*", SMALL["smc"](fixed=True)
    )


def _spectrum() -> bytes:
    return b"period (s),Sa (g)\n" + b"".join(
        f"{0.01 * (index + 1):.2f},{min(1.0, 0.6 / (0.01 * (index + 1))):.5f}\n".encode() for index in range(300)
    )


def kinds() -> dict[str, Kind]:
    """Return name and content of one file of each kind, and what should become of it."""
    components = "time(s),NS(gal),EW(gal),UD(gal)\n" + "".join(
        f"{index * DT:.2f},{n:.4f},{e:.4f},{u:.4f}\n"
        for index, (n, e, u) in enumerate(zip(_gal(0), _gal(1), _gal(2), strict=True))
    )
    commas = _table("t (s);a (m/s2)", G).decode().replace(",", ";").replace(".", ",").encode()
    rows = "\n".join(f"{1.0e-2 * at:.6e},{value:.6e}" for at, value in enumerate(motion()))
    exponents = "acceleration (g)\n" + "".join(f"{value:.6e}\n".replace("e", "") for value in motion())
    given = {"dt": DT, "unit": "g"}
    roof = SMALL["csmip"](channels=1).replace("CHAN  1:  90 DEG", "CHAN  1:  90 DEG   Location: Roof")
    small = {"points": SMALL["POINTS"], "dt": SMALL["DT"]}
    small_peak = max(map(abs, SMALL["motion"]())) / (100.0 * G)
    return {
        "target_spectrum_beside_records.csv": Kind(
            _spectrum(), refused=r"must be a motion; got period \(s\), Sa \(g\)"
        ),
        "velocity_column.csv": Kind(_table("Time (s),Velocity (cm/s)", 10.0), refused="acceleration; got velocity"),
        "displacement_unit.csv": Kind(_table("Time [sec],Displacement [m]"), refused="acceleration; got displacement"),
        "times_in_ms.csv": Kind(_table("Time (ms),Acceleration (g)", time=lambda at: str(10 * at))),
        "index_column.csv": Kind(
            _table("sample,acceleration (g)", time=str), {"dt": DT}, remark="first column counts the samples"
        ),
        "times_two_decimals.txt": Kind(
            _table("time (s) acceleration (g)", time=lambda at: f"{at * 0.005:.2f}"),
            {"dt": 0.005},
            dt=0.005,
            remark="times are rounded; they agree",
        ),
        "acc_then_time.csv": Kind(
            re.sub(rb"(?m)^([^,\n]*),([^,\n]*)$", rb"\2,\1", _table("time (s),acceleration (g)"))
        ),
        "pre_event.csv": Kind(
            _table("time (s),acceleration (g)", time=lambda at: f"{at * DT - 3.0:.2f}"), remark="first time is -3 s"
        ),
        "unit_ft_s2.csv": Kind(_table("Time (s),Acceleration (ft/s2)", G / 0.3048)),
        "unit_in_s2.csv": Kind(_table("Time (s),Acceleration (in/s2)", G / 0.0254)),
        "unit_mm_s2.csv": Kind(_table("Time (s),Acceleration (mm/s2)", G * 1000.0)),
        "unit_percent_g.csv": Kind(_table("Time (s),Acceleration (%g)", 100.0)),
        "unit_superscript.csv": Kind(_table("Time (s),Acceleration (cm/s\N{SUPERSCRIPT TWO})", 100.0 * G)),
        "ft_s2_given_as_g.txt": Kind(
            _column("Acceleration (ft/s2)", G / 0.3048), given, refused=r"unit of .* must be .* ft/s2; got g"
        ),
        "step_0024.AT2": Kind(_at2(dt=".0024").encode(), dt=0.0024, remark=r"between 0\.00235 and 0\.00245 s"),
        "rotated_scaled_FN.AT2": Kind(_rotated().encode(), remark="rotated: azimuth 233"),
        "chichi_N_operator.AT2": Kind(_at2("EXAMPLE 01/02/03, TST001, N (XXX)").encode()),
        "teaching_header.AT2": Kind(_at2("5E15.7, i.e., 5 points across in a row").encode()),
        "teaching_trailer.AT2": Kind(
            (_at2() + "*** End Data ***\n").encode(), remark="words behind the numbers left out"
        ),
        "csv_named.AT2": Kind(rows.encode(), {"unit": "g"}),
        "at2_as.dat": Kind(_at2().encode()),
        "column of peer, spaces (1).AT2": Kind(_at2().encode()),
        "cr_only.AT2": Kind(_at2().replace("\n", "\r").encode()),
        "npts_less.AT2": Kind(
            _at2(points=1205).encode(), refused=r"points of .* must be 1205, .*: the file is cut off"
        ),
        "npts_more.AT2": Kind(_at2(points=1195).encode(), refused=r"points of .* must be 1195, .*; got 1200"),
        "csmip_roof_channel.V2": Kind(roof.encode(), peak_g=small_peak, remark="", **small),
        "smc_corrected.smc": Kind(_blank_smc().encode(), peak_g=small_peak, **small),
        "resorce.cor.acc": Kind(NETWORKS["resorce"](_gal, DT).encode()),
        "csmnc.dat": Kind(NETWORKS["csmnc"](_gal, DT).encode()),
        "jma.csv": Kind(NETWORKS["jma"](_gal, DT).encode(), channels=3),
        "nied.csv": Kind(NETWORKS["nied"](_gal, DT).encode(), channels=3),
        "time_three_components.csv": Kind(components.encode(), channels=3),
        "no_header_five.g3": Kind(_five().encode(), given, remark="line after line, 5 in each"),
        "deepsoil.txt": Kind(
            f"{POINTS} {DT:.3f}\n".encode() + _table("", time=lambda at: f"{at * DT:.3f}").lstrip().replace(b",", b" "),
            {"unit": "g"},
            remark="number of points and step",
        ),
        "step_first.txt": Kind(_column(f"{DT:.3f}"), given, remark="taken as the step"),
        "decimal_comma_one_column.txt": Kind(
            _column("a (m/s2)", G).replace(b".", b","), {"dt": DT}, remark="decimal commas"
        ),
        "decimal_comma_semicolon.csv": Kind(commas, remark="decimal commas"),
        "fortran_exponent.txt": Kind(exponents.encode(), {"dt": DT}, remark="exponents are written without"),
        "bom.csv": Kind(b"\xef\xbb\xbf" + _table("time (s),acceleration (g)")),
        "utf16.csv": Kind(_table("time (s),acceleration (g)").decode().replace(",", "\t").encode("utf-16")),
        "nan.csv": Kind(
            re.sub(rb"(?m)^6\.00,.*$", b"6.00,NaN", _table("time (s),acceleration (g)")),
            refused="line 602 .*; got 'NaN'",
        ),
    }


def outcome(path: Path, arguments: dict[str, object]) -> str:
    """Return in words what becomes of a file."""
    try:
        records = read_records(path, **arguments)
    except RecordFormatError as error:
        return f"refused: {printable(str(error))}"
    first = records[0]
    several = f"{len(records)} channels, the first with " if len(records) > 1 else ""
    azimuth = "" if first.azimuth is None else f", azimuth {first.azimuth:g}"
    place = f", stands at {first.place}" if first.place else ""
    remarks = "; ".join(first.remarks)
    return f"{several}{first.samples} x {first.dt:g} s, PGA {first.pga_g:.3f} g{azimuth}{place}" + (
        f" ({remarks})" if remarks else ""
    )


def table() -> str:
    """Return the table of Markdown."""
    lines = ["| file | read with | outcome |", "| --- | --- | --- |"]
    with tempfile.TemporaryDirectory() as name:
        for file, kind in kinds().items():
            path = Path(name) / file
            path.write_bytes(kind.content)
            said = ", ".join(f"`{key}={value!r}`" for key, value in kind.arguments.items())
            lines.append(f"| `{file}` | {said} | {outcome(path, kind.arguments)} |".replace("'|", "'\\|"))
    return "\n".join(lines)
