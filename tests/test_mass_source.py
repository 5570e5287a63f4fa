"""Lines of mass sources for ETABS and SAP2000: multipliers and floor masses come back when the lines are read."""

from __future__ import annotations

import random
import re
from pathlib import Path

import pytest

import seismass as sm
from seismass.assessment.answer import Analysis, Answer
from seismass.assessment.building import OwnBuilding
from seismass.assessment.mass_source import NAMES, mass_source_lines
from seismass.assessment.models import ADVISED, BARE
from seismass.assessment.table_file import _keyed
from seismass.cli import main


def drawn(chooser: random.Random) -> tuple[Answer, OwnBuilding, list[list[float]]]:
    """An answer of a random building with a bare roof, whose floors have up to three multipliers in analysis 1."""
    count = chooser.randint(1, 6)
    storeys = [{"name": f"L{i}", "live_load_kpa": chooser.choice((2.0, 5.0))} for i in range(1, count + 1)]
    building = sm.read_building(
        {
            "site": {"sds_g": 1.0, "sd1_g": 0.6},
            "building": {"period_s": 0.4, "height_m": 4, "area_m2": 500, "dead_load_kpa": 5, "design": True, "R": 3},
            "goods": {"mu": 0.3},
            "storeys": [*storeys, {"name": "Roof", "live_load_kpa": 0.0}],
        }
    )
    few = [round(chooser.uniform(0.05, 1.0), 3) for _ in range(chooser.randint(1, 3))]
    first = [*(chooser.choice(few) for _ in range(count)), 0.0]
    second = [*[chooser.choice((0.0, 0.1))] * count, 0.0]
    analyses = []
    for number, (model, multipliers) in enumerate(((ADVISED, first), (BARE, second)), start=1):
        mass = building.mass + multipliers * building.live_load
        analyses.append(Analysis(number, model, 0.0, 0.0, tuple(mass), (), tuple(multipliers), ""))
    return Answer("", None, (), tuple(analyses)), building, [first, second]


def floors_of(words: str) -> dict[str, list[str]]:
    """Floors of each load pattern, as the lines say it."""
    found = re.findall(r"The load pattern (\S+) is the design live load of (.*?), and of no other floor", words)
    return {pattern: floors.split(", ") for pattern, floors in found}


@pytest.mark.parametrize("suffix", [".e2k", ".s2k"])
def test_multipliers_come_back_by_floor_and_source(suffix: str) -> None:
    chooser = random.Random(suffix)
    for _ in range(60):
        answer, building, multipliers = drawn(chooser)
        text = mass_source_lines(answer, building, suffix, "Storage")
        floors = floors_of(text)
        read: dict[tuple[str, str], float] = {}
        if suffix == ".s2k":
            ((title, (head, *rows)),) = _keyed(text.partition("\n")[2])
            assert title == "MASS SOURCE"
            cells = [dict(zip(head, row, strict=True)) for row in rows]
            for row in cells:
                if row.get("LoadPat"):
                    read[row["MassSource"], row["LoadPat"]] = float(row["Multiplier"])
            assert {row["MassSource"]: row["IsDefault"] for row in cells if row["IsDefault"]} == {
                NAMES[0]: "Yes",
                NAMES[1]: "No",
            }
        else:
            for name, pattern, factor in re.findall(r'  MASSSOURCELOAD  "(\S+)"  "(\S+)"  (\S+)', text):
                read[name, pattern] = float(factor)
            assert re.findall(r'ISDEFAULT "(\w+)"', text) == ["Yes", "No"]
            loads = [any(each > 0.0 for each in multipliers[i]) for i in range(2)]
            assert re.findall(r'INCLUDELOADS "(\w+)"', text) == ["Yes" if each else "No" for each in loads]
        for place, source in enumerate(NAMES):
            for floor, name in enumerate(building.storey_names[:-1]):
                (pattern,) = [each for each, of in floors.items() if name in of]
                assert read.get((source, pattern), 0.0) == pytest.approx(multipliers[place][floor])
        assert not any("Roof" in of for of in floors.values())
        for floor, name in enumerate(building.storey_names):
            told = re.search(rf"Mass of {name}: (\S+) t in analysis 1, (\S+) t in analysis 2\.", text)
            assert told is not None
            for one, number in zip(answer.analyses, told.groups(), strict=True):
                assert float(number) == pytest.approx(1e-3 * one.mass[floor], rel=1e-5)


def test_the_command_refuses_what_it_cannot_write(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, building, _ = drawn(random.Random(1))
    with pytest.raises(sm.errors.InvalidOption, match="that of an answer; got none: no goods"):
        mass_source_lines(Answer("", "no goods", ()), building, ".e2k")
    file = tmp_path / "a.toml"
    for options, message in (
        (["--mass-source", str(tmp_path / "m.txt")], "must be a file with the suffix .e2k or .s2k"),
        (["--mass-source", str(tmp_path / "no" / "m.e2k")], "No such folder"),
        (["--live-pattern", "L"], "--live-pattern of building must be left out"),
    ):
        assert main(["building", str(file), *options]) == 2
        assert message in capsys.readouterr().err
