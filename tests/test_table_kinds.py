"""Buildings that are no plain stack in storey tables, workbooks within limits, and files that were handed out."""

from __future__ import annotations

import io
import random
import zipfile
from pathlib import Path
from typing import Any

import pytest

import seismass as sm
from seismass.assessment import read_building, read_storey_table
from seismass.assessment.new_file import bare_floors, live_share
from seismass.assessment.table_file import readings
from seismass.base.limits import MOST_TABLE
from seismass.cli import main

ASK = "base level of .* must be stated by --base-level"
FEW = ["--area", "1200", "--sds", "1", "--sd1", "0.6", "--live-load", "7.2", "--friction", "0.3"]


def write(folder: Path, text: str, name: str = "t.csv") -> Path:
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


def levels(below: int, above: int, ground: float, chooser: random.Random) -> list[tuple[str, float]]:
    """Names and elevations (m) of floors from below: basements B2, B1, GF at `ground`, L1 and so on, and a roof."""
    names = [f"B{i}" for i in range(below, 0, -1)] + ["GF"] * (below > 0) + [f"L{i}" for i in range(1, above)]
    names.append("Roof")
    first = ground - 3.0 * below
    return [(name, round(first + 3.0 * (i + (below == 0)), 3)) for i, name in enumerate(names)]


def test_basements_and_elevations_above_the_sea_are_asked_for_and_read_as_stated(tmp_path: Path) -> None:
    """Every storey is 3 m high; what is at the base level or below it is left out."""
    chooser = random.Random(4)
    for _ in range(60):
        below, above = chooser.randint(0, 3), chooser.randint(2, 6)
        ground = chooser.choice((0.0, 0.0, 143.0, 12.5, 1200.0, -20.0))
        floors = levels(below, above, ground, chooser)
        text = "\n".join(f"{name},{level:.2f},100.5" for name, level in reversed(floors))
        file = write(tmp_path, f"Story,Elevation (m),Mass (t)\n{text}\n")
        if ground or below:
            with pytest.raises(sm.errors.InvalidBuildingFile, match=ASK):
                read_storey_table(file)
        found = read_storey_table(file, base_level=chooser.choice((ground, str(ground))) if not below else "gf")
        assert found.heights is not None
        assert found.heights.tolist() == pytest.approx([3.0] * above, abs=1e-9)
        assert found.names[0] == ("L1" if above > 1 else "Roof")
        if below:
            assert any("GF: at the base level or below, left out" in remark for remark in found.remarks)
        with_base = write(tmp_path, f"Story,Elevation (m),Mass (t)\n{text}\nBase,{floors[0][1] - 3.0:.2f},7\n")
        whole = read_storey_table(with_base)
        assert len(whole.names) == len(floors)
        assert whole.heights is not None
        assert whole.heights.tolist() == pytest.approx([3.0] * len(floors), abs=1e-9)
        shown = any("unless --base-level leaves them out" in remark for remark in whole.remarks)
        assert shown == (below > 0 or ground < 0.0)


@pytest.mark.parametrize(
    "name", ["B1", "Basement 1", "Sótano 1", "UG1", "Keller", "Sous-sol", "Bodrum", "Seminterrato", "Lower ground"]
)
def test_basements_by_name_without_elevations(tmp_path: Path, name: str) -> None:
    file = write(tmp_path, f"Story,Height (m),Mass (t)\nRoof,3,90\nL2,3,100\nL1,3,100\n{name},3,200\n")
    with pytest.raises(sm.errors.InvalidBuildingFile, match=f"{ASK}.*got {name} below ground"):
        read_storey_table(file)
    assert read_storey_table(file, base_level=name).names == ("L1", "L2", "Roof")
    assert read_storey_table(file, base_level="lowest").names == (name, "L1", "L2", "Roof")
    with pytest.raises(sm.errors.InvalidBuildingFile, match=f"{ASK}.*the tables have no elevations"):
        read_storey_table(file, base_level=0.0)


@pytest.mark.parametrize(
    ("text", "options", "message"),
    [
        (
            "Story,Elevation (m),Mass (t)\nUpper Roof,12,9\nLower Roof,12,9\nL2,8,9\nL1,4,9\n",
            {},
            "make one row of parts",
        ),
        ("Tower,Story,Height (m)\nT1,L2,4\nT1,L1,4\nT2,L2,4\nT2,L1,4\n", {}, "of one tower: keep the rows of one"),
        ("Story,Height (m),Mass (t),Weight (kN)\nL2,4,10,98\nL1,4,10,150\n", {}, "masses of .* the weights over g"),
        ("Story,Mass (t),Floor mass (t)\nL2,4,5\nL1,4,6\n", {}, "columns of mass of .* one: remove the others"),
        ("Story,Height (m),VY (kN)\nL2,4,5\nL1,4,6\n", {}, "called Yield Shear, or Shear Y"),
        ("Story,Height (m),Mass (t)\nL2,4,5,512,3\nL1,4,5,100\n", {}, "is the comma decimal, too"),
        ("Story,Height (m),Mass (t)\nL2,4,5\nL1,4,5\nChecked by AB,,\n", {}, "row Checked by AB .* no number in it"),
        ("Story,Height (m),Mass (t)\nL2,4,5\nL1,4,5\n,8,10\n", {}, "the name of a storey in each"),
        ("Story;Height (m)\nL2;4,500\nL1;4,500\n", {}, "state it by --decimal"),
        ("Story,Height (m),Shear (kN),Drift\nL2,4,5,12.5\nL1,4,5,11\n", {}, "unit of the column drift .* Drift Ratio"),
        ("Story;Height (m)\nL2;4.5\nL1;4.5\n", {"decimal": "comma"}, "a number with a decimal comma; got '4.5'"),
        ("Story,Case,Stiffness (kN/m)\nL1,EQX,5\nL1,EQY,6\n", {"case": "EQZ"}, "load case of .* one of EQX, EQY; got"),
        ("Story,Mass (t)\nL1,5\n", {"case": "EQX"}, "load case of .* left out: no quantity of a load case"),
        ("Story,Mass (t)\nL1,5\n", {"base_level": "L9"}, ASK),
        ("Story,Elevation (m)\nL2,8\nL1,4\n", {"base_level": 9}, "got 9, above all floors"),
    ],
)
def test_what_has_two_readings_is_asked_for(tmp_path: Path, text: str, options: dict[str, Any], message: str) -> None:
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        read_storey_table(write(tmp_path, text), **options)


@pytest.mark.parametrize("symbol", [" V_y", ", Vy", " (V_y)", " [Vy]"])
@pytest.mark.parametrize("unit", [" (kN)", " [kN]", ", kN"])
def test_the_symbol_of_a_yield_shear_is_no_direction(tmp_path: Path, symbol: str, unit: str) -> None:
    for name in ("Yield Shear", "Flie\N{LATIN SMALL LETTER SHARP S}kraft"):
        for direction in ("x", "y"):
            path = write(tmp_path, f"Story;Height (m);{name}{symbol}{unit}\nL2;4;500\nL1;4;600\n")
            found = read_storey_table(path, direction=direction)
            assert found.strength is not None
            assert found.strength.tolist() == [6e5, 5e5]
    of_both = f"Story;Yield Shear Vx{unit};Yield Shear{symbol}{unit}\nL2;5;50\nL1;6;60\n"
    assert read_storey_table(write(tmp_path, of_both)).strength == pytest.approx([6e3, 5e3])


def test_numbers_with_every_mark() -> None:
    """Both readings where both are possible; groups of three have one mark between them and begin with no zero."""
    for text, point, comma in (
        ("1,204", 1204.0, 1.204),
        ("1.204", 1.204, 1204.0),
        ("0,204", None, 0.204),
        ("12345,678", None, 12345.678),
        ("1,204,418", 1204418.0, None),
        ("1.204,4", None, 1204.4),
        ("1 204,500", None, 1204.5),
        ("1'204'418", 1204418.0, 1204418.0),
        ("-4,5", None, -4.5),
        ("1.204E+03", 1204.0, None),
        ("1,2e3", None, 1200.0),
        ("12,04,418", 1204418.0, None),
        ("\u22125", -5.0, -5.0),
        ("1 20", None, None),
        ("1,20,3", None, None),
        ("20.3.0", None, None),
        ("nan", None, None),
        ("", None, None),
    ):
        expected = {mark: value for mark, value in ((".", point), (",", comma)) if value is not None}
        assert readings(text) == expected, text


def test_heads_in_two_rows_and_a_mezzanine(tmp_path: Path) -> None:
    """Stiffness above X and Y, merged; a storey whose name says that it is a part of a floor."""
    file = write(
        tmp_path,
        "Story;Height (m);Stiffness (kN/mm);\n;;X;Y\nRoof;3,1;250,5;150,5\nMezz 1;2,5;300,5;200,5\n1F;4,1;350;250\n",
    )
    said = read_storey_table(write(tmp_path, "Story,Height (m),Elevation (m)\nL2,4,8\nL1,3,3\n", "b.csv")).text
    assert "heights are not the differences of elevations (4 m of L2 over 5 m): is a storey missing?" in said
    found = read_storey_table(file, direction="y")
    assert found.stiffness is not None
    assert found.stiffness.tolist() == pytest.approx([250e6, 200.5e6, 150.5e6], rel=1e-12)
    assert "Mezz 1 is taken as a whole floor" in found.text


def test_tables_beside_others_and_two_of_one_quantity(tmp_path: Path) -> None:
    """Of a whole model the tables of storeys are read; a summary of masses goes before those of diaphragms."""
    text = (
        "TABLE:  Joint Displacements\nStory,Label,Output Case,Ux\n,,,mm\nL2,1,EQX,5.1\nL1,1,EQX,2.2\n\n"
        "TABLE:  Story Definitions\nTower,Name,Height\n,,m\nT1,L2,4.5\nT1,L1,5.5\n\n"
        "TABLE:  Centers Of Mass And Rigidity\nStory,Diaphragm,Mass X\n,,kg\nL2,D1,90000\nL1,D1,95000\n\n"
        "TABLE:  Mass Summary by Story\nStory,UX,UY\n,kg,kg\nL2,100000.5,100000.5\nL1,110000,110000\nBase,500,500\n"
    )
    found = read_storey_table(write(tmp_path, text))
    assert found.mass is not None
    assert found.mass.tolist() == [110000.0, 100000.5]
    assert any("are not read: Joint Displacements" in remark for remark in found.remarks)
    assert found.live_mass  # a summary of masses is a program's, and masses under another title are the user's
    assert not read_storey_table(write(tmp_path, "TABLE:  Story Data\nStory,Mass\n,kg\nL2,9.1e4\nL1,9.7e4\n")).live_mass
    one = write(tmp_path, "Story,Height (m),Mass (t)\nL2,4,5\nL1,4,5\n", "a.csv")
    other = write(tmp_path, "Story,Mass (t)\nL2,7\nL1,5\n", "b.csv")
    with pytest.raises(sm.errors.InvalidBuildingFile, match=r"mass of storey L2 of b.csv must be that of a.csv"):
        read_storey_table([one, other])


def test_files_of_several_tables_replace_and_name_each_other(tmp_path: Path) -> None:
    """Stiffnesses of one file go before shears over drifts of others, whatever their load cases; towers are merged."""
    heights = write(tmp_path, "Tower,Name,Height (m)\nT1,L2,4.5\n,L1,5.5\n", "a.csv")
    forces = write(tmp_path, "Story,Load,Location,VX (kN)\nL2,W,Top,5.5\nL2,W,Bottom,6.5\nL1,W,Bottom,9\n", "b.csv")
    drifts = write(tmp_path, "Story,Load,Direction,Drift Ratio\nL2,W,X,0.001\nL2,W,Y,0.003\nL1,W,X,0.002\n", "c.csv")
    stiffness = write(tmp_path, "Story,Output Case,Stiff X (kN/mm)\nL2,EQX,100.5\nL1,EQX,200\n", "d.csv")
    found = read_storey_table([heights, forces, drifts])
    assert found.stiffness is not None
    assert found.stiffness.tolist() == pytest.approx([9e3 / (0.002 * 5.5), 6.5e3 / (0.001 * 4.5)])
    assert "are of the load case W" in found.text
    found = read_storey_table([heights, forces, drifts, stiffness])
    assert found.stiffness is not None
    assert found.stiffness.tolist() == pytest.approx([200e6, 100.5e6])
    assert "are of the load case EQX" in found.text


def test_e2k_storeys_and_units_of_the_file(tmp_path: Path) -> None:
    """As ETABS writes them: storeys from the top with heights, the base with its elevation, units in CONTROLS."""
    text = (
        '$ File C:\\m.e2k\n\n$ CONTROLS\n  UNITS  "KIP"  "IN"  "F"  \n\n$ STORIES - IN SEQUENCE FROM TOP\n'
        '  STORY "Roof"  HEIGHT 144 MASTERSTORY "Yes"  \n  STORY "Story 1"  HEIGHT 180.5 SIMILARTO "Roof"  \n'
        '  STORY "Base"  ELEV 12 \n\n$ GRIDS\n'
    )
    found = read_storey_table(write(tmp_path, text, "m.e2k"))
    assert found.heights is not None
    assert found.heights.tolist() == pytest.approx([180.5 * 0.0254, 144 * 0.0254])
    controls = 'TABLE:  "PROGRAM CONTROL"\n   ProgramName=SAP2000   CurrUnits="KN, cm, C"\n \n'
    file = write(
        tmp_path, f'{controls}TABLE:  "STORY DATA"\n   Story=L2   Height=300\n   Story=L1   Height=400.5\n', "m.s2k"
    )
    again = read_storey_table(file)
    assert again.heights is not None
    assert again.heights.tolist() == pytest.approx([4.005, 3.0])


# Forms of a head of a column; its names and units, with the size of each in SI units.
FORMS = (
    "{name} ({unit})",
    "{name} [{unit}]",
    "{name}, {unit}",
    "{name} - {unit}",
    "{name} / ({unit})",
    "{name} in {unit}",
    "{name} {unit}",
    "{name}_{unit}",
    "{name} {symbol} ({unit})",
    "{name}, {symbol} [{unit}]",
    "{name} ({symbol}) ({unit})",
)
NAMES = {
    "height": (
        "Height",
        "Storey height",
        "story height",
        "Altura de piso",
        "Altezza di interpiano",
        "Geschosshöhe",
        "hi",
    ),
    "mass": ("Mass", "Floor mass", "Masa de piso", "Massa", "Masse", "Geschossmasse", "Kat kütlesi"),
    "stiffness": ("Stiffness", "Lateral stiffness", "Rigidez lateral", "Rigidezza di piano", "Kat rijitliği", "Stiff"),
}
SYMBOLS = {"height": "h", "mass": "m", "stiffness": "k"}
KILO = 453.59237
UNIT_NAMES = {
    "height": {"m": 1.0, "metres": 1.0, "cm": 0.01, "ft": 0.3048, "feet": 0.3048, "inches": 0.0254},
    "mass": {
        "t": 1e3,
        "kg": 1.0,
        "tonnes": 1e3,
        "Mg": 1e3,
        "ton": 1e3,
        "slugs": KILO * 9.80665e-3 / 0.3048,
        "kN·s²/m": 1e3,
        "tf-s2/m": 9806.65,
        "t.s²/m": 9806.65,
        "kip-sec^2/in": KILO * 9.80665 / 0.0254,
        "k-s2/ft": KILO * 9.80665 / 0.3048,
        "kN s2/m": 1e3,
        "kN⋅s²/m": 1e3,
    },
    "stiffness": {
        "kN/m": 1e3,
        "MN/m": 1e6,
        "N/mm": 1e3,
        "tf/cm": 980665.0,
        "t/m": 9806.65,
        "kg/cm": 980.665,
        "tn/m": 9806.65,
        "k/in": KILO * 9.80665 / 0.0254,
        "kips/in.": KILO * 9.80665 / 0.0254,
        "daN/cm": 1e3,
    },
}
AXES = ("", " X", " x-dir", " in X direction", " (X)")


def test_names_and_units_of_columns_in_every_form(tmp_path: Path) -> None:
    """Every name with every unit in the head, or below it bare or in brackets; what stands for y is not that of x."""
    chooser = random.Random(12)
    for _ in range(150):
        columns, below, truth = [["Level", "", "Roof", "1"]], chooser.choice(("", "", "{}", "({})", "[{}]")), {}
        for kind, names in NAMES.items():
            unit, name = chooser.choice(list(UNIT_NAMES[kind])), chooser.choice(names)
            unit = "t" if unit == "ton" and truth["height"][1] in ("ft", "feet", "inches") else unit  # a short one
            form = "{name}" if below else chooser.choice(FORMS)
            axis = chooser.choice(AXES) if kind == "stiffness" and "symbol" not in form else ""
            values = [f"{chooser.uniform(3.0, 4.0):.2f}" for _ in range(2)]
            truth[kind] = ([float(value) * UNIT_NAMES[kind][unit] for value in values], unit)
            for each in (axis, axis.replace("x", "y").replace("X", "Y"))[: 1 + bool(axis)]:
                head = form.format(name=name + each, unit=unit, symbol=SYMBOLS[kind])
                columns.append([head, below.format(unit), *(values if each == axis else ["77.77", "77.77"])])
        rows = [row for row in zip(*columns, strict=True) if any(row)]
        found = read_storey_table(write(tmp_path, "\n".join(";".join(row) for row in rows) + "\n"))
        for values, (expected, _) in zip((found.heights, found.mass, found.stiffness), truth.values(), strict=True):
            assert values is not None, rows
            assert values.tolist() == pytest.approx(expected[::-1], rel=1e-9), rows


@pytest.mark.parametrize("text", [
    "Level (m),Story,Mass (t)\n8.1,Roof,50.5\n4.5,2F,80\n",
    "Story;Level [m];Mass [t]\nRoof;8,1;50,5\n2F;4,5;80\n",
    "Level,Level,Mass\n,m,t\nRoof,8.1,50.5\n2F,4.5,80\n",
    "No,Story,Höhe über Gelände (m),Mass (t)\n1,Roof,8.1,50.5\n2,2F,4.5,80\n",
    "Level,hx (m),wx (t)\nRoof,8.1,50.5\n2F,4.5,80\n",
    "| Level | Elevation (m) | Mass (t) |\n|---|---|---|\n| Roof | 8.1 | 50.5 |\n| 2F | 4.5 | 80 |\n",
    "Level Elevation Mass\n- m t\nRoof 8.1 50.5\n2F 4.5 80\n",
    "Level,Cota (m),Mass (t)\nRoof,8.1,50.5\n2F,4.5,80\nLevel 00,0.00,\n",
    "Level,Cota (m)\nRoof,8.1\n2F,4.5\n\nMasses of 3 March\nLevel,Mass (t)\nRoof,50.5\n2F,80\n",
    "Units: tonf, m\nLevel,Cota,Peso\nRoof,8.1,50.5\n2F,4.5,80\n",
])  # fmt: skip
def test_levels_above_the_ground_beside_names_and_tables_below_one_another(tmp_path: Path, text: str) -> None:
    found = read_storey_table(write(tmp_path, text))
    assert (found.names, found.heights is not None and found.heights.tolist()) == (
        ("2F", "Roof"),
        pytest.approx([4.5, 3.6]),
    )
    assert found.mass is not None
    assert found.mass.tolist() == pytest.approx([80e3, 50.5e3])


def test_the_ground_below_storeys_carries_nothing(tmp_path: Path) -> None:
    for name in ("Level 0", "G.L.", "Ground floor", "Planta baja", "EG", "RDC", "Zemin kat", "0", "Piano terra"):
        found = read_storey_table(write(tmp_path, f"Story,Height (m),Mass (t)\nRoof,3,50\nL1,4,60\n{name},0,0\n"))
        assert found.names == ("L1", "Roof"), name
        found = read_storey_table(write(tmp_path, f"Story,Height (m),Mass (t)\nRoof,3,50\nL1,4,60\n{name},5,70\n"))
        assert found.names == (name, "L1", "Roof")
    for name in ("1", "Level 10", "Lobby"):  # what was forgotten of a storey is no ground
        with pytest.raises(sm.errors.InvalidBuildingFile, match="must be a positive number"):
            read_storey_table(write(tmp_path, f"Story,Height (m),Mass (t)\nRoof,3,50\nL11,4,60\n{name},0,0\n"))


def test_heights_that_grow_from_storey_to_storey_are_asked_for(tmp_path: Path) -> None:
    chooser = random.Random(5)
    for _ in range(60):
        steps = [chooser.uniform(2.8, 4.5) for _ in range(chooser.randint(2, 9))]
        levels = [sum(steps[: i + 1]) for i in range(len(steps))]
        lines = "".join(f"L{i + 1},{level:.3f},9.5\n" for i, level in enumerate(levels))
        with pytest.raises(sm.errors.InvalidBuildingFile, match="call the column Elevation"):
            read_storey_table(write(tmp_path, f"Story,Height (m),Mass (t)\n{lines}"))
        found = read_storey_table(write(tmp_path, f"Story,Height above ground (m),Mass (t)\n{lines}"))
        assert found.heights is not None
        assert found.heights.tolist() == pytest.approx(steps, abs=2e-3)


@pytest.mark.parametrize("levels", [("N-3.00", "N+3.00", "N+6.50"), ("NPT -3.50", "NPT +3.50", "NPT +7.00")])
def test_levels_of_one_tower_may_differ_by_their_signs(tmp_path: Path, levels: tuple[str, ...]) -> None:
    rows = "".join(f"{name},3.5,{600 - number}\n" for number, name in enumerate(reversed(levels)))
    table = read_storey_table(write(tmp_path, f"Story,Height (m),Mass (t)\n{rows}"), order="roof-first")
    assert table.names == levels


@pytest.mark.parametrize("head", ["Roof Drift (mm)", "Top drift (m)", "Deriva techo (mm)"])
def test_drifts_of_a_roof_are_none_of_storeys(tmp_path: Path, head: str) -> None:
    text = f"Story,Height (m),Mass (t),Story Shear (kN),{head}\nRoof,3,300,200,4\nL1,3.5,400,300,7\n"
    try:
        table = read_storey_table(write(tmp_path, text))
    except sm.errors.InvalidBuildingFile as error:
        assert "those of storeys, called Story Drift" in str(error)
    else:
        assert table.stiffness is None


@pytest.mark.parametrize("name", ["Tower A L{}", "T1-L{}", "North wing Level {}", "A Piso {}"])
def test_floors_of_two_towers_by_their_names(tmp_path: Path, name: str) -> None:
    other = name.translate(str.maketrans({"A": "B", "1": "2", "N": "S"}))
    lines = "".join(f"{each.format(i)},3.5,9\n" for each in (name, other) for i in (3, 2, 1))
    with pytest.raises(sm.errors.InvalidBuildingFile, match="of one tower: keep the rows of one"):
        read_storey_table(write(tmp_path, f"Story,Height (m),Mass (t)\n{lines}"))


@pytest.mark.parametrize("name", ["Displacement (mm)", "Force (mm)", "Verschiebung (mm)", "Spostamento (mm)"])
def test_displacements_of_floors_are_no_drifts(tmp_path: Path, name: str) -> None:
    found = read_storey_table(write(tmp_path, f"Story,Height (m),Shear (kN),{name}\nL2,3,9,5.5\nL1,3,9,3\n"))
    assert found.stiffness is None


def xlsx(parts: dict[str, bytes]) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    return buffer.getvalue()


SHEET = '<worksheet><sheetData><row r="1">{}</row></sheetData></worksheet>'
BOOK = {
    "xl/_rels/workbook.xml.rels": b'<R><Relationship Id="r1" Target="/xl/worksheets/a.xml"/></R>',
    "xl/workbook.xml": b'<w xmlns:r="q"><sheets><sheet name="A" r:id="r1"/></sheets></w>',
}


@pytest.mark.parametrize(
    ("sheet", "message"),
    [
        (
            b"<worksheet><sheetData>" + b'<row><c r="A1"><v>1</v></c></row>' * 10_001,
            "not well|no element|mismatched|workbook",
        ),
        (
            b"<worksheet><sheetData>" + b"<row><c><v>1</v></c></row>" * 10_001 + b"</sheetData></worksheet>",
            "rows of a sheet of t.xlsx must be at most 10000",
        ),
        (SHEET.format('<c r="XFD1"><v>1</v></c>').encode(), "columns of t.xlsx must be at most 200; got 16384"),
        (b" " * (MOST_TABLE + 1), "at most 16 MB unpacked"),
        (b'<!DOCTYPE w [<!ENTITY a "b">]><worksheet>&a;</worksheet>', "a document type"),
        (b'<!DOCTYPE w SYSTEM "file:///etc/passwd"><worksheet/>', "a document type"),
        (SHEET.format('<c t="s"><v>7</v></c>').encode(), "must be a workbook"),
        (SHEET.format("<c><v>x</v></c>").encode(), "must be a workbook"),
        (SHEET.format('<c r="XFD1"/>').encode(), "must be below a head"),
    ],
)
def test_workbooks_beyond_limits_are_refused(tmp_path: Path, sheet: bytes, message: str) -> None:
    file = tmp_path / "t.xlsx"
    file.write_bytes(xlsx({**BOOK, "xl/worksheets/a.xml": sheet}))
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        read_storey_table(file)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"PK\x03\x04 no archive", "must be a workbook"),
        (xlsx({"a": b""}), "must be a workbook"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1", "an older workbook"),
        (b"\xef\xbb\xbfStory\xff", "damaged text"),
        (b"Story,Height (m)\n" + b"x" * 200_000, "must be a table"),
        (b"Story,Height (m)" + b",a" * 300 + b"\nL1,4\n", "columns of t.xlsx must be at most 200; got 302"),
        (b"Story,Height (m)\n" + b"L1,4\n" * 10_001, "rows of t.xlsx must be at most 10000"),
        (b"", "must be below a head"),
        (b"a" * 100_000 + b"=" + b"(" * 100_000, "must be below a head|must be a table"),
    ],
)
def test_files_that_are_no_tables(tmp_path: Path, content: bytes, message: str) -> None:
    (tmp_path / "t.xlsx").write_bytes(content)
    with pytest.raises(sm.errors.InvalidBuildingFile, match=message):
        read_storey_table(tmp_path / "t.xlsx")


def test_trailing_separators_take_no_memory(tmp_path: Path) -> None:
    head = "Story,Height (m),Mass (t)" + "," * 200_000
    found = read_storey_table(write(tmp_path, head + "\n" + "".join(f"L{i},3.1,100\n" for i in range(1, 900)), "t.csv"))
    assert len(found.names) == 899


def test_mass_sources_in_words() -> None:
    for text, share in (
        ("0.25", 0.25),
        ("1.0 D + 0.25 L", 0.25),
        ("D + 0.3Q", 0.3),
        ("Dead 1; Live 0.5", 0.5),
        ("1.0*DEAD + 1.0*SDL + 0.25*LIVE + 0.1 LL", 0.35),
        ("D", 0.0),
        ("0", 0.0),
    ):
        assert live_share(text) == pytest.approx(share), text
    for text in ("0.25 S", "L + L", "2", "-0.1", "", "a quarter", "1,0 D + 0,25 L"):
        with pytest.raises(ValueError):
            live_share(text)


def test_roofs_and_penthouses_carry_no_goods() -> None:
    for names, bare in (
        (("1F", "MEZZ", "9F", "10F", "RF", "PH-1", "PH-2"), "..  ..rrr"),
        (("L1", "L2", "L3"), "..r"),
        (("L1",), "."),
        (("L1", "Podium Roof", "L3", "L4", "L5", "L6", "L7"), ".r....r"),
        (("Nivel 1", "Nivel 2", "Azotea", "Cuarto de máquinas"), "..rr"),
        (("1. Geschoss", "Dach"), ".r"),
        (("", "", ""), "..r"),
    ):
        expected = [each == "r" for each in bare.replace(" ", "")]
        assert bare_floors(names) == expected, names
    assert bare_floors(("L1", "RF", "PH"), ("RF",)) == [False, False, True]
    with pytest.raises(sm.errors.InvalidOption, match="loaded of new building must be one of L1, RF; got L9"):
        bare_floors(("L1", "RF"), ("L9",))


NEEDED = ("--area", "--sds", "--sd1", "--live-load", "--friction")


@pytest.mark.parametrize("given", range(2 ** len(NEEDED)))
def test_a_table_that_is_refused_and_all_missing_answers_are_one_error(
    given: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Whichever options are given, the message about the units names the others, and with these the file is written."""
    file = write(tmp_path, "Story,Height,UX,Stiff X\nROOF,4.5,512.3,444082\nL1,6,1251.1,719618\n")
    options = [(name, "0.4") for place, name in enumerate(NEEDED) if given >> place & 1]
    words = ["new", str(tmp_path / "own.toml"), "--from", str(file), *(word for pair in options for word in pair)]
    assert main(words) == 2
    said = capsys.readouterr().err
    assert "must be stated" in said and "--mass-includes where there are masses" in said
    missing = [name for name in NEEDED if f"{name}" in said.partition("to be given too")[2]]
    assert missing == [name for name in NEEDED if name not in dict(options)]
    more = [word for name in missing for word in (name, "0.4")]
    assert main([*words, *more, "--units", "kN-m", "--mass-includes", "0"]) == 0


def test_new_takes_the_live_load_off_and_says_what_it_doubts(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """0.25 of 7.2 kPa on 1200 m2 are 220.259 t; the roof has no goods and keeps its mass."""
    file = write(tmp_path, "Story,Height,UX,Stiff X\n,m,kg,kN/m\nROOF,4.5,512340.5,444082\nL1,6,1251102.9,719618\n")
    out = tmp_path / "own.toml"
    assert main(["new", str(out), "--from", str(file), *FEW]) == 2
    assert "mass_includes of new building must be given, by --mass-includes" in capsys.readouterr().err
    assert main(["new", str(out), "--from", str(file), "--mass-includes", "1.0 D + 0.25 L", *FEW]) == 0
    assert "is taken off the masses of each loaded floor" in capsys.readouterr().out
    taken = 0.25 * 7200.0 * 1200.0 / sm.STANDARD_GRAVITY
    assert read_building(out).mass.tolist() == pytest.approx([1251102.9 - taken, 512340.5], rel=1e-9)
    # A hand-made table is taken as it is, which is said; a share can be stated all the same.
    by_hand = write(tmp_path, "Story,Height (mm),Mass (t),k (kN/mm)\nRoof,4500.5,512,444\nL1,6000,1251,720\n", "h.csv")
    assert main(["new", str(out), "--force", "--from", str(by_hand), "--decimal", "point", *FEW]) == 0
    printed = capsys.readouterr().out
    assert "masses are taken as those without live load" in printed
    assert "DOUBTFUL INPUT" not in printed
    small = ["--area", "120", *FEW[2:]]
    assert main(["new", str(out), "--force", "--from", str(by_hand), "--mass-includes", "0", *small]) == 0
    assert "DOUBTFUL INPUT: weight over the area of floor 1, L1, is 102.2 kPa" in capsys.readouterr().out
    assert main(["new", str(out), "--force", "--from", str(by_hand), "--mass-includes", "1", *FEW]) == 0
    few = ["--area", "9000", *FEW[2:]]
    assert main(["new", str(out), "--force", "--from", str(by_hand), "--mass-includes", "1", *few]) == 2
    assert "mass of storey L1 of h.csv must be more than the 6608 t" in capsys.readouterr().err


# What the files that were handed out must give: kilograms, metres, N/m of storey 1, and the number of storeys; or a
# part of what is said, and what options give it then.
HANDED_OUT: dict[str, tuple[Any, ...]] = {
    "basements.csv": ({}, 5, 3.5, 1904418.0, 12745493e3),
    "basements_no_base.csv": ("--base-level", {"base_level": 0.0}, 3, 4.5, 1204418.0, 745493e3),
    "centers.csv": ({}, 4, None, 1220000.0, None),
    "comma_in_stiffness_only.csv": ("--decimal", {"decimal": "comma"}, 3, 6.0, 1251e3, 719618e3),
    "cp1252_unit.csv": ({}, 3, 6.0, 1251100.0, None),
    "crlf_spanish_names.txt": ({}, 4, 6.0, 1251102.9, 719618e3),
    "dup.csv": ("got L1 in 2 rows", None),
    "elevation_above_sea.csv": ("--base-level", {"base_level": 138.5}, 3, 4.5, 1251100.0, None),
    "empty_stiff.csv": ({}, 4, 6.0, 1251102.9, 7233.6e3 / (0.001675 * 6)),
    "etabs9_text.txt": ("--units", {"units": "kN-m"}, 2, 6.0, None, None),
    "etabs_workbook.xlsx": ({}, 4, 6.0, 1251102.9, 719618e3),
    "german_semicolon_thousands.csv": ({}, 3, 6.0, 1251100.0, 719618e3),
    "german_tab.txt": ("--decimal", {"decimal": "comma"}, 3, 6.0, 951103.0, 719618e3),
    "key_value.s2k": ("--units", {"units": "kN-m"}, 2, 6.0, None, None),
    "mass_in_kn.csv": ("the column called Weight", None),
    "mass_summary.csv": ({}, 4, None, 1251102.9, None),
    "merged_by_hand.csv": ({}, 4, 6.0, 1251102.9, 719618e3),
    "merged_cases.xlsx": ("--case", {"case": "EQX"}, 3, 6.0, None, 719618e3),
    "neg_vy.csv": ("strength of storey Roof", None),
    "no_units.csv": ("--units", {"units": "kN-mm"}, "Drift (mm), or Drift Ratio"),
    "odd_names.csv": ({}, 7, 5.0, 500e3, None),
    "shear_drift_ratio.csv": ({}, 4, 6.0, 1251102.9, 7233.6e3 / (0.001675 * 6)),
    "spanish.csv": ({}, 3, 3.0, 20.4 * 9806.65, None),
    "split_roof.csv": ("make one row of parts", None),
    "story_definitions.csv": ({}, 4, 6.0, None, None),
    "story_stiffness.csv": ("--case", {"case": "EQX"}, 4, None, None, 719618e3),
    "text_numbers.xlsx": ({}, 2, 6.0, 1204418.0, None),
    "text_numbers2.xlsx": ({}, 2, 6.0, 1204418.5, None),
    "ton.csv": ({}, 3, 6.0, 127 * 9806.65, None),
    "total_row.csv": ("row Total", None),
    "total_row_removed.csv": ({}, 3, 6.0, 1251100.0, 719.6e6),
    "us_thousands_semicolon.csv": ({}, 3, 6.0, 1251102.0, 719618e3),
    "us_thousands_semicolon2.csv": ({}, 3, 6.0, 1251e3, 720e6),
    "us_units.csv": ({}, 3, 19.67 * 0.3048, 85727 * 4.4482216152605 / 0.3048, 4109 * 4448.2216152605 / 0.0254),
    "vx.csv": ({}, 3, 6.0, 1251e3, None),
    "vy_is_shear_in_y.csv": ({}, 3, 6.0, 1251e3, None),
    "weight_in_t.csv": ({}, 3, 6.0, 1251e3, None),
}


@pytest.mark.parametrize("name", HANDED_OUT)
def test_files_that_were_handed_out(name: str, shared: Path) -> None:
    first, *rest = HANDED_OUT[name]
    file = shared / "findings" / "tables" / name
    if not file.exists():
        pytest.skip(f"{name} is not in SEISMASS_SHARED")
    if isinstance(first, str):
        with pytest.raises(sm.errors.InvalidBuildingFile) as raised:
            read_storey_table(file)
        assert first in str(raised.value)
        options, *rest = rest
        if options is None:
            return
    else:
        options = first
    if len(rest) == 1:
        with pytest.raises(sm.errors.InvalidBuildingFile) as raised:
            read_storey_table(file, **options)
        assert rest[0] in str(raised.value)
        return
    found = read_storey_table(file, **options)
    count, *expected = rest
    assert len(found.names) == count
    for values, value in zip((found.heights, found.mass, found.stiffness), expected, strict=True):
        assert (values is None) == (value is None)
        if values is not None:
            assert values[0] == pytest.approx(value, rel=1e-9)


ETABS = {
    "definitions.csv": (
        "TABLE:  Story Definitions\nTower,Name,Height,Master Story,Similar To,Splice Story,Splice Height,Color\n"
        ",,m,,,,m,\nT1,ROOF,4.5,No,None,No,0,Yellow\nT1,L3,4.5,Yes,None,No,0,Gray8Dark\nT1,L2,4.4,No,L3,No,0,Blue\n"
        "T1,L1,6,No,None,No,0,Green\n"
    ),
    "masses.csv": (
        "TABLE:  Mass Summary by Story\nStory,UX,UY,UZ\n,kg,kg,kg\nROOF,512340.5,512340.5,0\nL3,1204418.2,1204418.2,0\n"
        "L2,1214418.2,1214418.2,0\nL1,1251102.9,1251102.9,0\nBase,83412.4,83412.4,0\n"
    ),
    "stiffness.csv": (
        "TABLE:  Story Stiffness\nStory,Output Case,Case Type,Shear X,Drift X,Stiff X,Shear Y,Drift Y,Stiff Y\n"
        ",,,kN,mm,kN/m,kN,mm,kN/m\nROOF,EQX,LinStatic,1512.1,3.405,444082,0,0.04,0\n"
        "ROOF,EQY,LinStatic,0,0.02,0,1512.1,4.1,368805\nL3,EQX,LinStatic,4300.4,7.012,613292,0,0.09,0\n"
        "L3,EQY,LinStatic,0,0.03,0,4300.4,8.3,518120\nL2,EQX,LinStatic,6210.7,8.331,745493,0,0.11,0\n"
        "L2,EQY,LinStatic,0,0.03,0,6210.7,9.9,627343\nL1,EQX,LinStatic,7233.6,10.052,719618,0,0.12,0\n"
        "L1,EQY,LinStatic,0,0.03,0,7233.6,12.4,583355\n"
    ),
}


def test_from_three_tables_of_etabs_to_the_page_by_the_lines_of_the_documentation(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The lines of docs/building_file.md: the page is there after at most three of them."""
    page = (Path(__file__).parents[1] / "docs" / "building_file.md").read_text(encoding="utf-8")
    block = page.partition("```console\n")[2].partition("```")[0]
    lines = block.replace("\\\n", " ").strip().splitlines()
    assert len(lines) <= 3
    monkeypatch.chdir(tmp_path)
    for name, text in ETABS.items():
        write(tmp_path, text, name)
    for line in lines:
        program, *words = line.split()
        assert program == "seismass"
        assert main(words) == 0
    building = read_building("own.toml")
    # 0.25 of 7.2 kPa on 1200 m2, over g, is taken off each floor but the roof.
    taken = 0.25 * 7200.0 * 1200.0 / sm.STANDARD_GRAVITY
    expected = [1251102.9 - taken, 1214418.2 - taken, 1204418.2 - taken, 512340.5]
    assert building.mass.tolist() == pytest.approx(expected, rel=1e-9)
    assert building.stiffness.tolist() == pytest.approx([719618e3, 745493e3, 613292e3, 444082e3])
    assert (tmp_path / "own" / "index.html").exists() or list((tmp_path / "own").glob("*.html"))
