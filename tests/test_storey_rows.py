"""Rows of storey tables that are no storeys: refused by name, or the base left out; and names that stay storeys."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

import seismass as sm
from seismass.assessment import read_building, read_pushover, read_storey_table
from seismass.cli import main

# Words that programs and people write below a column, by language, as dictionaries have them.
WORDS = {
    "English": ["Total", "Totals", "Subtotal", "Sum", "Average", "Mean", "Max", "Maximum", "Min", "Note", "Remarks"],
    "German": ["Summe", "Gesamt", "Gesamtsumme", "Mittelwert", "Mittel", "Durchschnitt", "Hinweis", "Anmerkung"],
    "Spanish": ["Suma", "Totales", "Promedio", "Media", "Máximo", "Mínimo", "Nota", "Observación"],
    "Portuguese": ["Soma", "Totais", "Média", "Máximo", "Observações"],
    "Italian": ["Totale", "Somma", "Media", "Massimo", "Minimo", "Note"],
    "French": ["Totaux", "Somme", "Moyenne", "Maximum", "Remarque"],
    "Turkish": ["Toplam", "TOPLAMI", "Ortalama", "Maksimum", "MİNİMUM", "Not", "Asgari"],
}
ALONE = ("Mittel", "Media", "Média", "Not")  # words of storeys too, where others stand beside them
FORMS = ("{}", "{}:", "{}.", "({})", " {} ", "*{}*", "{}  -", "{} 1")
WITH_OTHERS = ("Grand {}", "{} MASS", "Sub-{}", "{}: of all floors", "{}_t")
STOREYS = {"Roof": (3.0, 90.0, 150.0), "L2": (3.0, 120.0, 250.0), "L1": (4.0, 130.0, 300.0)}
"""Height (m), mass (t), stiffness (kN/mm) of storeys, the roof first."""
UNITS = {"t": ("Height (m)", "Mass (t)", "Stiffness (kN/mm)", 1.0), "kg": ("Height (mm)", "UX (kg)", "KX (N/m)", 1e3)}
SEPARATORS = ",;\t"


def rows_of(storeys: dict[str, tuple[float, float, float]], units: str) -> list[list[str]]:
    """Cells of storeys in some units."""
    scale = UNITS[units][3]
    return [
        [name, f"{height * scale:g}", f"{mass * scale:g}", f"{stiffness * scale**2:.10g}"]
        for name, (height, mass, stiffness) in storeys.items()
    ]


def carried(what: str, units: str) -> list[str]:
    """What a row below, above or between storeys has in its columns."""
    scale = UNITS[units][3]
    height, mass, stiffness = (sum(column) for column in zip(*STOREYS.values(), strict=True))
    whole = [f"{number:.10g}" for number in (scale * height, scale * mass, scale**2 * stiffness)]
    return {
        "sums": whole,
        "mass": ["", whole[1], ""],
        "means": [f"{float(cell) / 3.0:.10g}" for cell in whole],
        "nothing": ["", "", ""],
        "zeros": ["0", "0", "0"],
        "text": ["see drawing", "-", "n/a"],
    }[what]


def written(folder: Path, units: str, rows: list[list[str]], separator: str = ",") -> Path:
    file = folder / "storeys.csv"
    text = "\n".join(separator.join(row) for row in [["Story", *UNITS[units][:3]], *rows])
    file.write_text(text + "\n", encoding="utf-8")
    return file


def cased(word: str, chooser: random.Random) -> str:
    return chooser.choice((word, word.upper(), word.lower(), word.swapcase()))


def test_totals_means_and_notes_are_refused_by_name(tmp_path: Path) -> None:
    """Every word in every form, where the row stands and what it carries drawn at random."""
    chooser = random.Random(20)
    for words in WORDS.values():
        for word in words:
            for form in (*FORMS, *(() if word in ALONE else WITH_OTHERS)):
                name = form.format(cased(word, chooser))
                units = chooser.choice(list(UNITS))
                rows = rows_of(STOREYS, units)
                carries = carried(chooser.choice(("sums", "mass", "means", "nothing", "zeros", "text")), units)
                rows.insert(chooser.randint(0, len(rows)), [name, *carries])
                if chooser.random() < 0.5:
                    rows.append(["Base", "", "", ""])
                file = written(tmp_path, units, rows, chooser.choice(SEPARATORS))
                with pytest.raises(sm.errors.InvalidBuildingFile) as raised:
                    read_storey_table(file)
                said = str(raised.value)
                assert said.startswith(f"row {name.strip()} of storeys.csv must be that of a storey: remove it"), said
                assert said.endswith("got a total, a mean or a note"), said


# Their letters hold such words, but their words are others; those of ALONE stand beside others; numbers name storeys.
NAMES = [
    *("Summit", "Story Maximus", "Maxwell", "Minster", "Notary", "Meanwhile", "Minimarket", "Totem", "Sumatra"),
    *("Summit Level", "Level Mint", "Planta media", "Media Level", "Mittelgeschoss", "Not used", "Gesamtschule"),
    *("Notenraum", "Maxi", "Basement", "Base 1", "Basement 2", "B1", "Baseball", "Totalitas", "Sommer", "Averageville"),
]


def test_names_that_only_look_like_totals_stay_storeys(tmp_path: Path) -> None:
    chooser = random.Random(21)
    for name in NAMES:
        for place in range(4):
            units = chooser.choice(list(UNITS))
            rows = rows_of(STOREYS, units)
            rows.insert(place, rows_of({cased(name, chooser): (3.5, 101.0, 270.0)}, units)[0])
            found = read_storey_table(written(tmp_path, units, rows), order="roof-first", base_level="lowest")
            assert found.mass is not None
            # The masses of STOREYS from the ground up, and 101 t.
            expected = [90e3, 120e3, 130e3]
            expected.insert(place, 101e3)
            assert found.mass.tolist() == pytest.approx(expected[::-1], rel=1e-12)  # one product each
            assert found.remarks == ()


@pytest.mark.parametrize("column", ["Mass (t)", "Weight (tonf)"])
@pytest.mark.parametrize("name", ["All", "Building", "Итого", "合計", "-", "1-3", "Levels 1 to 3", "Roof + Floors"])
@pytest.mark.parametrize("with_base", [None, "in the sum", "beside it"])
def test_a_row_that_is_the_sum_of_the_others_is_refused(
    tmp_path: Path, name: str, column: str, with_base: str | None
) -> None:
    """Whatever it is called; masses as printed, to 0.1 t, and their sum rounded by itself."""
    chooser = random.Random(f"{name} {column} {with_base}")
    for count in (2, 3, 7, 40):
        masses = [chooser.uniform(50.0, 2000.0) for _ in range(count)]
        base = chooser.uniform(5.0, 300.0) if with_base else 0.0
        rows = [[f"L{i}", f"{mass:.1f}"] for i, mass in enumerate(masses, start=1)][::-1]
        total = sum(masses) + (base if with_base == "in the sum" else 0.0)
        rows.insert(chooser.choice((0, 1, len(rows))), [name, f"{total:.1f}"])
        if with_base:
            rows.append(["Base", f"{base:.1f}"])
        file = tmp_path / "storeys.csv"
        file.write_text("\n".join(",".join(row) for row in [["Story", column], *rows]), encoding="utf-8")
        with pytest.raises(sm.errors.InvalidBuildingFile) as raised:
            read_storey_table(file, order="roof-first")
        assert str(raised.value).startswith(f"row {name} of storeys.csv must be that of a storey: remove it")
        assert str(raised.value).endswith("got the sum of the other rows' masses")


@pytest.mark.parametrize(
    ("names", "masses"),
    [
        (("Upper", "Lower"), (100, 100)),  # each is the sum of the other
        (("L3", "L2", "L1"), (100, 100, 200)),  # named by its number
        (("Roof", "2nd", "1st"), (50, 150, 200)),
        (("Roof", "Upper", "Lower"), (100, 100, 201)),  # 0.5 % from the sum
    ],
)
def test_storeys_whose_masses_add_up_by_chance_stay(
    tmp_path: Path, names: tuple[str, ...], masses: tuple[int, ...]
) -> None:
    text = "\n".join(["Story,Mass (t)", *(f"{name},{mass}" for name, mass in zip(names, masses, strict=True))])
    file = tmp_path / "storeys.csv"
    file.write_text(text, encoding="utf-8")
    found = read_storey_table(file, order="roof-first")
    assert found.mass is not None
    assert found.mass.tolist() == [1e3 * mass for mass in reversed(masses)]


@pytest.mark.parametrize("name", ["Base", "BASE", "base", "Base ", "Base.", " Base:"])
@pytest.mark.parametrize("what", ["sums", "mass", "means", "nothing", "zeros", "text"])
def test_the_base_is_left_out_whatever_it_carries_and_that_is_said(tmp_path: Path, name: str, what: str) -> None:
    """Storeys are those of the table without that row; a mass that goes with it is told."""
    for units in UNITS:
        rows = rows_of(STOREYS, units)
        without = read_storey_table(written(tmp_path, units, rows))
        for place in (0, 2, 3):
            given = [*rows]
            given.insert(place, [name, *carried(what, units)])
            found = read_storey_table(written(tmp_path, units, given), order="roof-first")
            assert found.names == without.names == ("L1", "L2", "Roof")
            for one, other in ((found.heights, without.heights), (found.mass, without.mass)):
                assert one is not None
                assert other is not None
                assert one.tolist() == other.tolist()
            (remark,) = found.remarks
            assert remark.startswith(f"row {name.strip()} is the ground and no storey: left out")
            told = carried(what, units)[0 if what == "text" else 1]
            assert (f" {told} " in remark) == (what not in ("nothing", "zeros"))
            assert remark in found.text


def test_the_base_of_a_mass_summary_and_its_elevation(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A basement: elevations -7 and -3.5 m give storeys of 3.5 m; the output of the command has the row left out."""
    file = tmp_path / "storeys.csv"
    head = "Story,Elevation,UX,Stiff X\n,m,kg,kN/m\n"
    storeys = "ROOF,4.5,512340,444082\nGF,0,1804418,9745493\nB1,-3.5,1904418,12745493\n"
    file.write_text(head + storeys + "Base,-7,83412.4,0\n", encoding="utf-8")
    found = read_storey_table(file)
    assert found.heights is not None
    assert found.heights.tolist() == [3.5, 3.5, 4.5]
    out = tmp_path / "own.toml"
    answers = ["--area", "300", "--sds", "1.0", "--sd1", "0.6", "--live-load", "6", "--friction", "0.3"]
    answers += ["--mass-includes", "0"]
    assert main(["new", str(out), "--from", str(file), *answers]) == 0
    assert "row Base is the ground and no storey: left out, with mass 83412.4 kg\n" in capsys.readouterr().out
    assert read_building(out).storey_names == ("B1", "GF", "ROOF")
    file.write_text(head + storeys + "Total,,4221176,\n", encoding="utf-8")
    assert main(["new", str(out), "--force", "--from", str(file), *answers]) == 2
    assert "row Total of storeys.csv must be that of a storey: remove it" in capsys.readouterr().err
    # A storey without an elevation has no place among the others.
    file.write_text(head + storeys.replace("GF,0", "GF,"), encoding="utf-8")
    with pytest.raises(
        sm.errors.InvalidBuildingFile, match=r"elevation of storey GF of .* must be a number; got nothing"
    ):
        read_storey_table(file)


def test_curves_of_storeys_have_no_totals_and_no_base_either(tmp_path: Path) -> None:
    file = tmp_path / "push.csv"
    curves = "Story,Story Drift (mm),Story Shear (kN)\nL2,0,0\nL2,20,400\nL1,0,0\nL1,15,700\n"
    file.write_text(f"{curves}Max,20,700\n", encoding="utf-8")
    with pytest.raises(sm.errors.InvalidBuildingFile, match=r"row Max of push.csv must be that of a storey: remove it"):
        read_pushover(file)
    file.write_text(f"{curves}Base,0,700\n", encoding="utf-8")
    found = read_pushover(file)
    assert found.names == ("L1", "L2")
    assert found.remarks == ("row Base is the ground and no storey: left out",)
