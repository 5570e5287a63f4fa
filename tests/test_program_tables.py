"""Storey tables as programs and people write them, made at random with right answers: read right, or refused with a
sentence that says what to do.
"""

from __future__ import annotations

import os
import random
import zipfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from xml.sax.saxutils import escape

import pytest

import seismass as sm
from seismass.assessment import read_storey_table

G = 9.80665  # m/s2
LBF = 0.45359237 * G  # N
FORCES = {"kN": 1e3, "N": 1.0, "kgf": G, "tonf": 1e3 * G, "kip": 1e3 * LBF, "lb": LBF, "MN": 1e6}
LENGTHS = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "ft": 0.3048, "in": 0.0254}
SYSTEMS = (("kN", "m"), ("kN", "mm"), ("tonf", "m"), ("kgf", "cm"), ("kip", "in"), ("kip", "ft"), ("lb", "in"))
SPELLINGS = {"s2": ("{f}-s2/{l}", "{f}-s²/{l}", "{f}-sec2/{l}", "{f}*s^2/{l}")}

# What each program and language calls storey, height, elevation, mass, stiffness, shear, drift and load case.
ETABS16 = ("Story", "Height", "Elevation", "UX", "Stiffness X", "Shear X", "Drift X", "Load Case")
HEADS = {
    "etabs 16": ETABS16,
    "etabs 18": ("Story", "Height", "Elevation", "UX", "Stiff X", "Shear X", "Drift X", "Output Case"),
    "etabs 9": ("STORY", "HEIGHT", "ELEVATION", "MassX", "StiffX", "VX", "DriftX", "LOAD"),
    "sap2000": ("Story", "Height", "Elev", "MassX", "StiffX", "ShearX", "DriftX", "OutputCase"),
    "english": ("Level", "h", "Elevation", "Floor mass", "k", "Story shear", "Story drift", "Case"),
    "spanish": ("Nivel", "Altura", "Elevación", "Masa", "Rigidez", "Cortante", "Deriva", "Caso de carga"),
    "portuguese": (
        *("Pavimento", "Altura", "Elevação", "Massa", "Rigidez", "Força cortante", "Deslocamento relativo"),
        "Combinação",
    ),
    "italian": (
        *("Livello", "Altezza", "Quota", "Massa", "Rigidezza", "Taglio", "Spostamento relativo"),
        "Caso di carico",
    ),
    "french": (
        *("Étage", "Hauteur d'étage", "Cote", "Masse", "Rigidité", "Effort tranchant", "Déplacement relatif"),
        "Cas de charge",
    ),
    "german": ("Geschoss", "Höhe", "Kote", "Masse", "Steifigkeit", "Querkraft", "Relativverschiebung", "Lastfall"),
    "turkish": ("Kat", "Yükseklik", "Kot", "Kütle", "Rijitlik", "Kesme kuvveti", "Kat ötelemesi", "Yükleme"),
}
WINDOWS = {"turkish": "cp1254"}
ROOFS = {
    "spanish": "Azotea",
    "portuguese": "Cobertura",
    "italian": "Copertura",
    "french": "Toiture",
    "german": "Dach",
    "turkish": "Çat\u0131",
}
MARKS = ((".", ""), (".", ","), (",", ""), (",", "."), (",", " "), (".", "'"), (",", "\u00a0"), (".", " "))
ENCODINGS = ("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "windows")
LAYOUTS = (",", ";", "\t", "fixed", "xlsx", "xlsx text", "s2k")
EXTRAS = ("none", "base", "total", "note", "unnamed", "title")


@dataclass
class Case:
    """A table as it is drawn, its files, the options that it is read with, and what has to come out (SI units)."""

    program: str
    layout: str
    mark: tuple[str, str]
    encoding: str
    extra: str
    options: dict[str, str] = field(default_factory=dict)
    files: list[Path] = field(default_factory=list)
    truth: dict[str, list[float]] = field(default_factory=dict)
    refused: str = ""


def text_of(value: float, digits: int, mark: tuple[str, str]) -> str:
    """A number with its decimal mark and groups of three."""
    whole, _, part = f"{value:.{digits}f}".partition(".")
    if mark[1]:
        sign, whole = ("-", whole[1:]) if whole.startswith("-") else ("", whole)
        groups = []
        while len(whole) > 3:
            groups.insert(0, whole[-3:])
            whole = whole[:-3]
        whole = sign + mark[1].join([whole, *groups])
    return f"{whole}{mark[0]}{part}" if part else whole


def shows(numbers: list[str]) -> set[str]:
    """Decimal marks that numbers show: a mark twice, two marks, or other than three digits behind it are clear."""
    found = set()
    for number in numbers:
        marks = [each for each in number if each in ".,"]
        if not marks:
            continue
        last = marks[-1]
        behind = len(number) - number.rindex(last) - 1
        before = number[: number.index(marks[0])].lstrip("-")
        spaced = any(each in number for each in " '\u00a0")
        if len(marks) > 1 and len(set(marks)) == 1:
            found.add("," if last == "." else ".")
        elif len(set(marks)) == 2 or behind != 3 or spaced or len(before) > 3 or before in ("0", ""):
            found.add(last)
    return found


def workbook(path: Path, sheets: dict[str, list[list[str | float]]], shared: bool) -> None:
    """An XLSX by hand: texts in the cells or shared, numbers as numbers."""
    strings: list[str] = []

    def cell(place: str, value: str | float) -> str:
        if isinstance(value, float):
            return f'<c r="{place}"><v>{value!r}</v></c>'
        if shared:
            strings.append(value)
            return f'<c r="{place}" t="s"><v>{len(strings) - 1}</v></c>'
        return f'<c r="{place}" t="inlineStr"><is><t>{escape(value)}</t></is></c>'

    name_space = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
    relations = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        listed, links = "", ""
        for number, (title, rows) in enumerate(sheets.items(), start=1):
            body = "".join(
                f'<row r="{y}">'
                + "".join(cell(f"{chr(65 + x)}{y}", value) for x, value in enumerate(row) if value != "")
                + "</row>"
                for y, row in enumerate(rows, start=1)
            )
            archive.writestr(
                f"xl/worksheets/sheet{number}.xml",
                f'<worksheet xmlns="{name_space}"><sheetData>{body}</sheetData></worksheet>',
            )
            listed += f'<sheet name="{escape(title)}" sheetId="{number}" r:id="rId{number}"/>'
            links += f'<Relationship Id="rId{number}" Type="t" Target="worksheets/sheet{number}.xml"/>'
        archive.writestr(
            "xl/workbook.xml",
            f'<workbook xmlns="{name_space}" xmlns:r="{relations}"><sheets>{listed}</sheets></workbook>',
        )
        archive.writestr("xl/_rels/workbook.xml.rels", f"<Relationships>{links}</Relationships>")
        texts = "".join(f"<si><t>{escape(text)}</t></si>" for text in strings)
        archive.writestr("xl/sharedStrings.xml", f'<sst xmlns="{name_space}">{texts}</sst>')


def table_text(rows: list[list[str]], layout: str, title: str) -> str:
    """Rows as text in a layout, the head first and the row of units (or none) behind it."""
    if layout == "s2k":
        head, *body = rows
        lines = [f'TABLE:  "{title.upper()}"']
        for row in body:
            pairs = [(key.replace(" ", ""), value) for key, value in zip(head, row, strict=False) if value]
            lines.append("   " + "   ".join(f'{key}="{v}"' if " " in v else f"{key}={v}" for key, v in pairs))
        return "\n".join(lines) + "\n \nEND TABLE DATA\n"
    if layout == "fixed":
        widths = [max(len(row[i]) if i < len(row) else 0 for row in rows) + 3 for i in range(len(rows[0]))]
        return "\n".join("".join(c.ljust(w) for c, w in zip(row, widths, strict=False)).rstrip() for row in rows) + "\n"
    quoted = [[f'"{c}"' if layout in c else c for c in row] for row in rows]
    return "\n".join(layout.join(row) for row in quoted) + "\n"


def drawn(chooser: random.Random, folder: Path) -> Case:
    """A random table with its right answer."""
    program = chooser.choice(list(HEADS))
    case = Case(
        program, chooser.choice(LAYOUTS), chooser.choice(MARKS), chooser.choice(ENCODINGS), chooser.choice(EXTRAS)
    )
    storey, height, elevation, mass, stiffness, shear, drift, load = HEADS[program]
    force, length = chooser.choice(SYSTEMS)
    count = chooser.randint(2, 9)
    names = [f"{chooser.choice(('L', 'Piso ', 'N'))}1"]
    names = [names[0][:-1] + str(i) for i in range(1, count)] + [ROOFS.get(program, "ROOF")]
    digits = {kind: chooser.choice((0, 1, 2, 3, 3, 4)) for kind in ("length", "mass", "stiffness", "force", "drift")}
    if case.layout == "fixed":
        case.mark = (case.mark[0], "" if case.mark[1] in (" ", "\u00a0") else case.mark[1])
    if case.layout == "s2k":
        case.mark = (case.mark[0], "" if case.mark[1] in (" ", "\u00a0", "'") else case.mark[1])

    def number(value: float, kind: str) -> tuple[str, float]:
        least = {"m": 2, "ft": 1, "mm": 0, "cm": 0, "in": 1}[length] if kind in ("length", "drift") else 0
        places = max(digits[kind], least + (3 if kind == "drift" else 0))
        return text_of(value, places, case.mark), float(f"{value:.{places}f}")

    unit_mass = chooser.choice(("kg", "t", "s2"))
    mass_text = chooser.choice(SPELLINGS["s2"]).format(f=force, l=length) if unit_mass == "s2" else unit_mass
    mass_factor = {"kg": 1.0, "t": 1e3, "s2": FORCES[force] / LENGTHS[length]}[unit_mass]
    if unit_mass == "s2" and mass_factor > 1e4:
        digits["mass"] = max(digits["mass"], 4)
    by_shear = chooser.random() < 0.3
    with_elevation = chooser.random() < 0.3
    cases = chooser.choice((["EQX"], ["EQX", "EQY"], ["EQX", "EQY", "Sismo Z"]))
    # Where the units stand; s2k has them nowhere but in --units, or in a table of its own.
    place = "option" if case.layout == "s2k" else chooser.choice(("row", "head", "option"))
    if place == "option":
        unit_mass, mass_factor = "s2", FORCES[force] / LENGTHS[length]
        digits["mass"] = 4 if mass_factor > 1e4 else digits["mass"]
        case.options["units"] = f"{force}-{length}"
    f, metre = FORCES[force], LENGTHS[length]
    rows_a: list[list[str]] = []  # heights and masses
    rows_b: list[list[str]] = []  # stiffnesses by load case
    truth: dict[str, list[float]] = {"heights": [], "mass": [], "stiffness": []}
    numbers: list[str] = []
    level = 0.0
    level_text, base_text = "", number(0.0, "length")[0]
    for name in names:
        h_text, h = number(chooser.uniform(3.0, 4.4) / metre, "length")
        m_text, m = number(chooser.uniform(2e5, 2e6) / mass_factor, "mass")
        level_text, level = number(level + h, "length")
        rows_a.append([name, level_text if with_elevation else h_text, m_text])
        numbers += [rows_a[-1][1], m_text]
        truth["heights"].append(h * metre)
        truth["mass"].append(m * mass_factor)
        for case_name in cases:
            k_text, k = number(chooser.uniform(5e7, 9e8) / (f / metre), "stiffness")
            if f / metre > 1e7:
                k_text, k = text_of(k := float(f"{chooser.uniform(5e7, 9e8) / (f / metre):.4f}"), 4, case.mark), k
            v_text, v = number(chooser.uniform(5e5, 9e6) / f, "force")
            d_text, d = number(chooser.uniform(2e-3, 2e-2) / metre, "drift")
            cells = [v_text, d_text] if by_shear else [k_text]
            rows_b.append([name, case_name, *cells])
            numbers += cells
            if case_name == "EQX":
                truth["stiffness"].append(v * f / (d * metre) if by_shear else k * f / metre)
    if with_elevation:
        truth["heights"] = [
            float(f"{b:.9g}") * metre for b in [each / metre for each in truth["heights"]]
        ]  # levels are rounded as heights are: their differences are the heights
    if len(cases) > 1:
        case.options["case"] = "EQX"
    head_a = [storey, elevation if with_elevation else height, mass]
    head_b = [storey, load, *([shear, drift] if by_shear else [stiffness])]
    units_a = ["", length, mass_text]
    units_b = ["", "", *([force, length] if by_shear else [f"{force}/{length}"])]
    if case.extra in ("base", "total", "note", "unnamed"):
        total = text_of(sum(truth["mass"]) / mass_factor, digits["mass"], case.mark)
        rows = {
            "base": ["Base", base_text if with_elevation else "", number(8e4 / mass_factor, "mass")[0]],
            "total": [chooser.choice(("Total", "Suma", "Summe", "Toplam", "TOTALE")), "", total],
            "note": ["Note: masses of 3 March", "", ""],
            "unnamed": ["", "", total],
        }[case.extra]
        rows_a.insert(0, rows)
        numbers += [cell for cell in rows[1:] if cell] if case.extra == "base" else []
        case.refused = {"total": "remove it", "note": "remove it", "unnamed": "the name of a storey"}.get(
            case.extra, ""
        )
        if case.layout in ("fixed", "s2k") and case.extra == "unnamed":
            case.refused = "any"
    if chooser.random() < 0.6 or case.extra == "base":
        rows_a.reverse()
        groups = [rows_b[i : i + len(cases)] for i in range(0, len(rows_b), len(cases))]
        rows_b = [row for group in groups[::-1] for row in group]
    merged = len(cases) > 1 and chooser.random() < 0.4 and case.layout not in ("fixed", "s2k")
    if merged:
        for number_of, row in enumerate(rows_b):
            row[0] = row[0] if number_of % len(cases) == 0 else ""
    tables = []
    for head, units, rows in ((head_a, units_a, rows_a), (head_b, units_b, rows_b)):
        shown = [f"{h} ({u})" if u and place == "head" else h for h, u in zip(head, units, strict=True)]
        tables.append([shown, *([units] if place == "row" else []), *rows])
    if place == "row" and case.layout == "fixed":
        for table in tables:  # columns of fixed width have no empty cells at their beginning
            table[1] = [cell or "Text" for cell in table[1]]
    titles = ("Story Definitions", "Story Stiffness")
    if case.layout.startswith("xlsx"):
        as_number = case.layout == "xlsx"
        sheets: dict[str, list[list[str | float]]] = {}
        if chooser.random() < 0.5:
            sheets["Program Control"] = [["TABLE:  Program Control"], ["ProgramName", "Version"], ["ETABS", "20.3.0"]]
        for title, table in zip(titles, tables, strict=True):
            kept: list[list[str | float]] = [[f"TABLE:  {title}"]] if case.extra == "title" else []
            for row in table:
                kept.append([value_of(c, case.mark) if as_number and c in numbers else c for c in row])
            sheets[title] = kept
        case.files = [folder / "model.xlsx"]
        workbook(case.files[0], sheets, chooser.random() < 0.5)
        if as_number:
            numbers = []
    else:
        encoding = WINDOWS.get(program, "cp1252") if case.encoding == "windows" else case.encoding
        for title, table in zip(titles, tables, strict=True):
            text = table_text(table, case.layout, title)
            if case.extra == "title" and case.layout != "s2k":
                text = f"TABLE:  {title}\n{text}"
            if chooser.random() < 0.3:
                text = text.replace("\n", chooser.choice(("\r\n", "\r")))
            file = folder / f"{title.split()[1].lower()}.txt"
            file.write_bytes(text.encode(encoding, "replace"))
            case.files.append(file)
    # Each file is judged by its own numbers; a workbook is one file.
    parts = (
        [numbers]
        if len(case.files) == 1
        else [[c for row in rows for c in row[1:] if any(x.isdigit() for x in c)] for rows in (rows_a, rows_b)]
    )
    parts = [[c for c in part if c in numbers] for part in parts]
    unknown = [
        part for part in parts if len(shows(part)) != 1 and any(each in number for number in part for each in ".,")
    ]
    if by_shear and place == "option" and not case.refused:
        case.refused = "Drift (mm), or Drift Ratio"  # nothing says whether a drift is a length
    if unknown and not case.refused:
        case.refused = "--decimal"
    elif unknown:
        case.refused = "any"
    case.truth = truth
    return case


def value_of(text: str, mark: tuple[str, str]) -> float:
    return float((text.replace(mark[1], "") if mark[1] else text).replace(mark[0], "."))


def check(case: Case, read: Callable[..., object] = read_storey_table) -> str:
    """Read a case; return what came of it: read, or refused."""
    told = f"{case}\n" + "\n".join(repr(file.read_bytes()[:600]) for file in case.files if file.suffix != ".xlsx")
    if case.refused:
        with pytest.raises(sm.errors.InvalidBuildingFile) as raised:
            read_storey_table(case.files, **case.options)  # type: ignore[arg-type]
        assert case.refused == "any" or case.refused in str(raised.value), f"{raised.value}\n{told}"
        if case.refused != "--decimal":
            return "refused"
        case.options["decimal"] = "point" if case.mark[0] == "." else "comma"
    try:
        found = read_storey_table(case.files, **case.options)  # type: ignore[arg-type]
    except sm.errors.SeismassError as error:
        raise AssertionError(f"{error}\n{told}") from error
    for name, expected in case.truth.items():
        values = getattr(found, name)
        assert values is not None, f"{name}\n{told}"
        # The printed numbers are exact; levels above ground are sums of rounded heights.
        assert values.tolist() == pytest.approx(expected, rel=1e-9), f"{name}\n{told}"
    if case.extra == "base":
        assert any("row Base is the ground and no storey: left out" in remark for remark in found.remarks), told
    if len(case.options) > 0 and "case" in case.options:
        few = {name: value for name, value in case.options.items() if name != "case"}
        with pytest.raises(sm.errors.InvalidBuildingFile, match="state it by --case"):
            read_storey_table(case.files, **few)  # type: ignore[arg-type]
    return "read"


def test_tables_of_programs_are_read_right_or_refused(tmp_path: Path) -> None:
    chooser = random.Random(59)
    outcomes = [check(drawn(chooser, tmp_path)) for _ in range(40)]
    assert outcomes.count("read") > 15


def test_hundreds_of_tables_of_programs(tmp_path: Path) -> None:
    chooser = random.Random(int(os.environ.get("SEISMASS_SEED", "1959")))
    outcomes = [check(drawn(chooser, tmp_path)) for _ in range(600)]
    assert outcomes.count("read") > 250
