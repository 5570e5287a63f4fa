"""Storey tables of other programs, and the building files that are made of them: shapes, units, orders, refusals."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import seismass as sm
from seismass.assessment import read_building, read_storey_table
from seismass.assessment.table_file import system_of, unit_factor
from seismass.cli import main

KIP = 4448.2216152605  # N, 1000 lbf
INCH = 0.0254  # m


def table(tmp_path: Path, text: str, name: str = "storeys.csv") -> Path:
    file = tmp_path / name
    file.write_text(text, encoding="utf-8")
    return file


def test_elevations_masses_and_stiffnesses_with_a_row_of_units(tmp_path: Path) -> None:
    """A title, the head, units below it, the roof first, thousands with commas, the base, and columns of y beside x."""
    file = table(
        tmp_path,
        "TABLE:  Story Response,,,,,\n"
        "Story,Elevation,Mass X,Mass Y,Stiffness X,Stiffness Y\n"
        ",mm,kg,kg,kN/m,kN/m\n"
        "Roof,7800,90000,90001,1.5E5,1.0E5\n"
        'Story1,4200,"150,000",150001,300000,250000\n'
        "Base,200,,,,\n",
    )
    found = read_storey_table(file)
    assert found.names == ("Story1", "Roof")
    assert found.heights is not None
    assert found.heights.tolist() == pytest.approx([4.0, 3.6])
    assert found.mass is not None
    assert found.mass.tolist() == [150000.0, 90000.0]
    assert found.stiffness is not None
    assert found.stiffness.tolist() == [3.0e8, 1.5e8]
    assert found.remarks == (
        "row Base is the ground and no storey: left out",
        "heights are differences of elevations, over a base at 0.2 m",
        "direction x is read, and not Mass Y, Stiffness Y: --direction y reads y",
    )
    assert "2       Roof" in found.text
    other = read_storey_table(file, direction="y")
    assert other.mass is not None
    assert other.mass.tolist() == [150001.0, 90001.0]
    assert other.stiffness is not None
    assert other.stiffness.tolist() == [2.5e8, 1.0e8]


def test_kips_and_inches_stated_for_the_table(tmp_path: Path) -> None:
    """Masses of a model in kip and inch are in kip s2/in: 1 of them weighs 386.09 kip."""
    file = table(tmp_path, "Level;Height;UX;Stiff X\nL3;144;0.9;500\nL2;144;1,0;600\nL1;180;1,1;700\n")
    found = read_storey_table(file, units="Kip-in-F")
    assert found.names == ("L1", "L2", "L3")
    assert found.heights is not None
    assert found.heights.tolist() == pytest.approx([180 * INCH, 144 * INCH, 144 * INCH])
    assert found.mass is not None
    assert found.mass.tolist() == pytest.approx([mass * KIP / INCH for mass in (1.1, 1.0, 0.9)], rel=1e-12)
    assert found.mass[1] * sm.STANDARD_GRAVITY == pytest.approx(386.0886 * KIP, rel=1e-6)
    assert found.stiffness is not None
    assert found.stiffness.tolist() == pytest.approx([k * KIP / INCH for k in (700, 600, 500)], rel=1e-12)


def test_weights_shears_and_drift_ratios(tmp_path: Path) -> None:
    """Stiffness is shear over drift times height: 900 kN over 0.003 times 4 m are 75 000 kN/m."""
    file = table(
        tmp_path,
        "Storey [-]\tWeight (kgf)\tHeight (m)\tShear X (tonf)\tDrift X\n1\t100000\t4.0\t91.7745\t0.003\n"
        "2\t80000\t3.5\t50\t0.002\n",
    )
    found = read_storey_table(file)
    assert found.names == ("1", "2")
    assert found.mass is not None
    assert found.mass.tolist() == pytest.approx([1.0e5, 8.0e4])
    assert found.stiffness is not None
    assert found.stiffness[0] == pytest.approx(91.7745e3 * sm.STANDARD_GRAVITY / 0.012)
    assert found.stiffness[0] == pytest.approx(7.5e7, rel=1e-5)
    assert found.remarks == (
        "masses are weights over g",
        "stiffnesses are shears over drifts, which are ratios of the heights",
    )


def test_a_workbook_is_read_as_the_same_table(tmp_path: Path) -> None:
    openpyxl = pytest.importorskip("openpyxl", reason="openpyxl is not installed: no workbook is read")
    rows = [
        ("Story", "Height (m)", "Mass (t)", "Yield Shear (kN)"),
        ("Roof", 3.0, 100, 900),
        ("Story 1", 4.0, 120, 1500),
    ]
    book = openpyxl.Workbook()
    for row in rows:
        book.active.append(row)
    book.save(tmp_path / "storeys.xlsx")
    found = read_storey_table(tmp_path / "storeys.xlsx")
    text = "\n".join(",".join(map(str, row)) for row in rows)
    same = read_storey_table(table(tmp_path, text))
    assert found.text.splitlines()[1:] == same.text.splitlines()[1:]
    assert found.strength is not None
    assert found.strength.tolist() == [1.5e6, 9.0e5]


@pytest.mark.parametrize(
    ("text", "options", "message"),
    [
        ("a,b\n1,2\n", {}, "rows of storeys.csv must be below a head with a column story"),
        ("Story,Mass\nS1,3\n", {}, "unit of the column mass of storeys.csv must be stated: in its head"),
        ("Story,Mass (stone)\nS1,3\n", {}, "must be one of kg, t, lb, or force-s2/length such as kip-s2/in; got"),
        ("Story,Mass (t)\nS1,3\nS1,4\n", {}, "one for each storey; got S1 in 2 rows: keep one load case"),
        ("Story,Mass (t)\nA,3\nB,4\n", {}, "order of the storeys of storeys.csv must be stated by --order"),
        ("Story,Mass (t)\nS2,x\nS1,4\n", {}, "mass of storey S2 of storeys.csv must be a number; got 'x'"),
        ("Story,Mass (t)\nS2,-3\nS1,4\n", {}, "mass of storey S2 of storeys.csv must be a positive number; got -3000"),
        (
            "Story,Mass (t),Height (m)\nS2,3,\nS1,4,3\n",
            {},
            "height of storey S2 of storeys.csv must be a positive number",
        ),
        ("Story,Mass\nS1,3\n", {"units": "m-kN"}, "units of storeys.csv must be a force and a length such as kN-m"),
        ("Story,Shear (kN),Drift\nS1,3,0.1\n", {}, "height of storeys.csv must be given with drift ratios; got none"),
    ],
)
def test_what_is_not_said_is_refused(tmp_path: Path, text: str, options: dict[str, str], message: str) -> None:
    with pytest.raises(sm.errors.InvalidBuildingFile) as raised:
        read_storey_table(table(tmp_path, text), units=options.get("units"))
    assert message in str(raised.value)


def test_order_can_be_stated(tmp_path: Path) -> None:
    file = table(tmp_path, "Story,Mass (t)\nA,3\nB,4\n")
    assert read_storey_table(file, order="roof-first").names == ("B", "A")
    assert read_storey_table(file, order="ground-first").names == ("A", "B")


def test_units_by_hand() -> None:
    assert unit_factor("kN-s2/m", "mass", "unit", "table") == 1e3
    assert unit_factor("kgf/cm", "stiffness", "unit", "table") == pytest.approx(980.665)
    assert unit_factor("Kip-s²/ft", "mass", "unit", "table") == pytest.approx(KIP / 0.3048)
    assert system_of("Tonf, m, C", "table") == pytest.approx((9806.65, 1.0))
    # The foot of 1959 is 0.3048 m, its pound 0.45359237 kg; g = 9.80665 m/s2.
    factors = {
        "length": {"m": 1.0, "cm": 0.01, "mm": 0.001, "ft": 0.3048, "in": 0.0254},
        "mass": {"kg": 1.0, "t": 1e3, "tonne": 1e3, "lb": 0.45359237, "lbm": 0.45359237},
        "force": {"N": 1.0, "kN": 1e3, "MN": 1e6, "kgf": 9.80665, "tonf": 9806.65, "lbf": 0.45359237 * 9.80665},
        "stiffness": {"kN/mm": 1e6, "kip/in": 453.59237 * 9.80665 / 0.0254, "lb/ft": 0.45359237 * 9.80665 / 0.3048},
    }
    for quantity, units in factors.items():
        for unit, factor in units.items():
            assert unit_factor(unit, quantity, "unit", "table") == pytest.approx(factor, rel=1e-14), unit


ANSWERS = ["--area", "300", "--sds", "1.0", "--sd1", "0.6", "--live-load", "6", "--friction", "0.3"]


def test_from_a_table_to_a_building_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = table(tmp_path, "Story,Height (ft),Weight (kip),Stiffness (kip/in)\nRoof,12,250,400\nStory1,14,320,600\n")
    out = tmp_path / "own.toml"
    assert main(["new", str(out), "--from", str(file), "--name", 'a "b"', *ANSWERS]) == 0
    printed = capsys.readouterr().out
    assert "read from storeys.csv" in printed
    assert f"seismass building {out}" in printed
    building = read_building(out)
    assert building.name == 'a "b"'
    assert building.storey_names == ("Story1", "Roof")
    assert building.stiffness.tolist() == pytest.approx([600 * KIP / INCH, 400 * KIP / INCH], rel=1e-9)
    assert building.mass.tolist() == pytest.approx([320 * KIP / sm.STANDARD_GRAVITY, 250 * KIP / sm.STANDARD_GRAVITY])
    assert building.live_load.tolist() == pytest.approx([6000 * 300 / sm.STANDARD_GRAVITY, 0.0])
    assert building.design is not None
    assert building.design.R == 3.0
    # What is there is not replaced.
    assert main(["new", str(out), "--from", str(file), *ANSWERS]) == 2
    assert "one that does not exist" in capsys.readouterr().err


def test_options_that_the_tables_answer_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = table(tmp_path, "Story,Height (ft),Weight (kip),Stiffness (kip/in)\nRoof,12,250,400\nStory1,14,320,600\n")
    command = ["new", str(tmp_path / "own.toml"), "--from", str(file), *ANSWERS]
    for option, value in (("storeys", "7"), ("height", "9"), ("dead-load", "3"), ("period", "0.5")):
        assert main([*command, f"--{option}", value]) == 2
        words = f"--{option} of new must be left out where the tables or curves have it; got {value}"
        assert words in capsys.readouterr().err
    alone = ["new", str(tmp_path / "own.toml"), *ANSWERS]
    for option, value in (("case", "x"), ("units", "kN-m"), ("order", "roof-first"), ("pushover-case", "x")):
        assert main([*alone, f"--{option}", value]) == 2
        assert f"--{option} of new must be left out where " in capsys.readouterr().err
    assert not (tmp_path / "own.toml").exists()


@pytest.mark.skipif(os.name != "posix", reason="a terminal of its own is asked for as POSIX has it")
def test_ctrl_c_ends_a_question(tmp_path: Path) -> None:
    import fcntl
    import pty
    import termios

    own, terminal = pty.openpty()
    command = [sys.executable, "-m", "seismass", "new", str(tmp_path / "own.toml")]
    process = subprocess.Popen(
        command,
        stdin=terminal,
        stdout=terminal,
        stderr=terminal,
        start_new_session=True,
        preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0),
    )
    os.close(terminal)
    try:
        shown = b""
        while b"called?" not in shown:
            shown += os.read(own, 1000)
        os.write(own, b"\x03")
        assert process.wait(timeout=30) == 130
    finally:
        process.kill()
        os.close(own)


def test_without_a_table_and_what_is_missing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "own.toml"
    command = ["new", str(out), "--storeys", "3", "--height", "4.5", "--dead-load", "6", "--period", "0.5", *ANSWERS]
    assert main(command) == 0
    building = read_building(out)
    assert building.storeys == 3
    assert building.stated_period == 0.5
    assert building.live_load[2] == 0.0
    capsys.readouterr()
    assert main(["new", str(tmp_path / "other.toml"), "--storeys", "3"]) == 2
    assert "height of new building must be given, by --height" in capsys.readouterr().err
    assert main(["new", str(tmp_path / "other.toml"), "--storeys", "many"]) == 2
    assert "storeys of new building must be a whole number from 1 to 200; got 'many'" in capsys.readouterr().err
    assert main(["new", str(tmp_path / "other.txt")]) == 2
    assert not (tmp_path / "other.toml").exists()


def test_questions_are_asked_on_a_terminal(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """An answer that cannot be read is asked for again; an empty one takes the default."""
    given = iter(
        ["", "2", "4", "500", "-5", "5", "0.4", "1.0", "0.6", "", "6", "0.8", "timber-on-steel", "1x2@3", "0.8x2.0"]
    )
    asked: list[str] = []

    def answer(question: str) -> str:
        asked.append(question)
        return next(given)

    monkeypatch.setattr("builtins.input", answer)
    monkeypatch.setattr("sys.stdin.isatty", lambda: True)
    out = tmp_path / "own.toml"
    assert main(["new", str(out)]) == 0
    assert len(asked) == 15
    assert "a positive number, please" in capsys.readouterr().out
    building = read_building(out)
    assert building.name == "my building"
    assert building.kinds[0].contact == "timber-on-steel"
    assert [kind.occupied for kind in building.kinds] == [0.8, 0.8]
    size = building.kinds[0].size
    assert size is not None
    assert (size.width, size.height) == (0.8, 2.0)
