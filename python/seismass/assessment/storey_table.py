"""Storey tables as other programs export them: names, heights, masses, stiffnesses and strengths, in SI units.

Columns are recognised by their names, as in tables of ETABS and SAP2000; units stand in the head, in a row below it, or
are stated for the whole table.
"""

from __future__ import annotations

import csv
import io
import os
import re
import unicodedata
import zipfile
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, Literal

import numpy as np

from seismass.base.errors import InvalidBuildingFile, MissingPackage
from seismass.base.files import MOST_BYTES, read_file
from seismass.base.units import FOOT, INCH, KIP, POUND, STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_path, brief, printable, refusal, short
from seismass.base.views import Card
from seismass.media.text_table import text_table

Quantity = Literal["length", "force", "mass", "stiffness"]

LENGTHS: Final = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "ft": FOOT, "in": INCH}
"""Metres."""
FORCES: Final = {
    "n": 1.0,
    "kn": 1e3,
    "mn": 1e6,
    "kgf": STANDARD_GRAVITY,
    "tonf": 1e3 * STANDARD_GRAVITY,
    **dict.fromkeys(("lb", "lbf"), 1e-3 * KIP),
    **dict.fromkeys(("kip", "kips"), KIP),
}
"""Newtons; tonf is the metric one, as these programs have it, and a kip 1000 lbf."""
MASSES: Final = {"kg": 1.0, "t": 1e3, "tonne": 1e3, "tonnes": 1e3, "lb": POUND, "lbm": POUND}
"""Kilograms."""

_MASS: Final = re.compile(r"([a-z]+)[-*.·]?s(?:ec)?\^?[2²]/([a-z]+)")
_STIFFNESS: Final = re.compile(r"([a-z]+)/([a-z]+)")


def unit_factor(unit: str, quantity: Quantity, what: str, owner: str) -> float:
    """Return the factor to SI units of a unit such as "kN/m" or "kip-s2/in" of a length, force, mass or stiffness."""
    text = unit.strip().lower().replace(" ", "")
    if quantity == "length" and text in LENGTHS:
        return LENGTHS[text]
    if quantity == "force" and text in FORCES:
        return FORCES[text]
    if quantity == "mass" and text in MASSES:
        return MASSES[text]
    pattern = {"mass": _MASS, "stiffness": _STIFFNESS}.get(quantity)
    matched = pattern.fullmatch(text) if pattern is not None else None
    if matched and matched[1] in FORCES and matched[2] in LENGTHS:
        return FORCES[matched[1]] / LENGTHS[matched[2]]
    known = {
        "length": ", ".join(LENGTHS),
        "force": "N, kN, kgf, tonf, lb, kip",
        "mass": "kg, t, lb, or force-s2/length such as kip-s2/in",
        "stiffness": "force/length such as kN/m or kip/in",
    }[quantity]
    raise refusal(InvalidBuildingFile, what, owner, f"one of {known}", brief(unit))


def system_of(units: str, owner: str) -> tuple[float, float]:
    """Return the units of force (N) and of length (m) of a system such as "kN-m" or "kip-in"."""
    force, _, length = units.strip().lower().replace(" ", "").replace(",", "-").partition("-")
    length = length.partition("-")[0]  # a third word is that of temperatures
    if force not in FORCES or length not in LENGTHS:
        need = "a force and a length such as kN-m, N-mm, kip-in, kip-ft, lb-in, kgf-m or tonf-m"
        raise refusal(InvalidBuildingFile, "units", owner, need, brief(units))
    return FORCES[force], LENGTHS[length]


Names = Mapping[str, tuple[str, ...]]
"""Names of columns by what they hold, in small letters; x stands for the direction that is asked for."""
_HEAD: Final = re.compile(r"^(?P<name>[^([,]*)(?:[(\[,]\s*(?P<unit>[^)\]]*)[)\]]?)?\s*$")


@dataclass(frozen=True)
class Sheet:
    """Rows below a head that is known: the place of each column found, its unit as stated in the head or in a row below
    (empty: none), and the rows that are not empty.
    """

    path: Path
    columns: dict[str, int]
    units: dict[str, str]
    body: list[list[str]]

    def texts(self, kind: str) -> list[str]:
        """Return the cells of a column, with what cannot be printed as escapes."""
        return [printable(row[self.columns[kind]].strip()) for row in self.body]

    def numbers(
        self, kind: str, factor: float, owners: Sequence[str], *, left_out: Collection[int] = ()
    ) -> list[float]:
        """Return a column of numbers times a factor, NaN where a cell is empty; `owners` name its rows in errors. A
        cell without a number is an error but in rows of `left_out`.
        """
        place, values = self.columns[kind], []
        for number, (row, owner) in enumerate(zip(self.body, owners, strict=True)):
            try:
                values.append(factor * _number(row[place], f"{kind} of {owner}", self.path))
            except InvalidBuildingFile:
                if number not in left_out:
                    raise
                values.append(float("nan"))
        return values

    def factor(self, kind: str, quantity: Quantity, system: tuple[float, float] | None) -> float:
        """Return the factor of a column towards SI units, by its own unit or else by a system (N, m)."""
        unit = self.units[kind]
        if unit:
            return unit_factor(unit, quantity, f"unit of the column {kind}", self.path.name)
        if system is None:
            need = "stated: in its head, as in Mass (kg), in a row below, or for the table by --units, such as kN-m"
            raise refusal(InvalidBuildingFile, f"unit of the column {kind}", self.path.name, need, "none")
        force, length = system
        return {"length": length, "force": force, "stiffness": force / length, "mass": force / length}[quantity]


def read_sheet(path: Path, names: Names, *, needed: tuple[str, ...], need: str, direction: str = "x") -> Sheet:
    """Read a CSV (comma, semicolon or tab) or XLSX whose columns are known by `names`. The columns `needed` must be
    there beside another one; `need` is what errors say of the head.
    """
    rows = _rows(path)
    head, columns = _head(rows, path, names, needed, need, direction)
    body = rows[head + 1 :]
    units = {kind: _unit_in(rows[head][place]) for kind, place in columns.items()}
    if body and _is_unit_row(body[0], columns):
        units = {kind: body[0][place].strip() or units[kind] for kind, place in columns.items()}
        body = body[1:]
    body = [row for row in body if any(row[columns[kind]].strip() for kind in needed)]
    return Sheet(path, columns, units, body)


def _rows(path: Path) -> list[list[str]]:
    """Cells of the file as text, in rows of equal length."""
    try:
        content = read_file(path)
    except OSError as error:
        raise InvalidBuildingFile(
            f"table must be a file that can be read; got {path} ({error.strerror or error})"
        ) from error
    if path.suffix.lower() in (".xlsx", ".xlsm"):
        rows = _sheet(content, path)
    else:
        text = content.decode("utf-8-sig", errors="replace")
        lines = [line for line in text.splitlines() if line.strip()][:50]
        separator = max(";\t,", key=lambda each: sum(line.count(each) for line in lines))
        rows = [list(row) for row in csv.reader(io.StringIO(text), delimiter=separator)]
        if separator == ";":  # then a comma is decimal
            rows = [[re.sub(r"^(\s*[+-]?\d+),(\d+)", r"\1.\2", cell) for cell in row] for row in rows]
    width = max(map(len, rows), default=0)
    return [[*row, *([""] * (width - len(row)))] for row in rows]


def _sheet(content: bytes, path: Path) -> list[list[str]]:
    """Cells of the first sheet of a workbook."""
    try:
        from openpyxl import load_workbook
    except ImportError:
        needed = "openpyxl, which reads XLSX, must be installed (pip install seismass[xlsx]); or save the table as CSV"
        raise MissingPackage(needed) from None
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            size = sum(item.file_size for item in archive.infolist())
        if size > MOST_BYTES:
            raise refusal(InvalidBuildingFile, "size", path.name, f"at most {MOST_BYTES} bytes unpacked", str(size))
        book = load_workbook(io.BytesIO(content), read_only=True, data_only=True)
        rows = book.worksheets[0].iter_rows(values_only=True)
        return [["" if cell is None else str(cell) for cell in row] for row in rows]
    except (zipfile.BadZipFile, KeyError, IndexError, ValueError, OSError) as error:
        raise refusal(InvalidBuildingFile, "content", path.name, "a workbook", short(str(error))) from error


def _name_of(cell: str, direction: str) -> str:
    """Name of a column in small letters without its unit; one of the other direction is unknown."""
    matched = _HEAD.match(cell.strip())
    name = re.sub(r"[^a-z0-9%]+", " ", (matched["name"] if matched else cell).lower()).strip()
    words = name.split()
    other = "y" if direction == "x" else "x"
    if words and (words[-1] == other or words[-1] in (f"u{other}", f"k{other}", f"v{other}")):
        return ""
    words = [{f"u{direction}": "ux", f"k{direction}": "kx", f"v{direction}": "vx"}.get(word, word) for word in words]
    if words and words[-1] == direction:
        words[-1] = "x"
    return " ".join(words)


def _unit_in(cell: str) -> str:
    """Unit of a head such as "Mass (kg)" or "Mass, kg"."""
    matched = _HEAD.match(cell.strip())
    return (matched["unit"] or "").strip() if matched else ""


def _head(
    rows: list[list[str]], path: Path, names: Names, needed: tuple[str, ...], need: str, direction: str
) -> tuple[int, dict[str, int]]:
    """Row of the head, and the column of each kind."""
    for number, row in enumerate(rows[:50]):
        names_in_row = [_name_of(cell, direction) for cell in row]
        places = {
            kind: min((names_in_row.index(name) for name in known if name in names_in_row), default=-1)
            for kind, known in names.items()
        }
        columns = {kind: place for kind, place in places.items() if place >= 0}
        if len(columns) > 1 and all(kind in columns for kind in needed):
            return number, columns
    first = next((", ".join(cell for cell in row if cell) for row in rows if any(row)), "no rows")
    raise refusal(InvalidBuildingFile, "rows", path.name, f"below {need}", short(first))


def _is_unit_row(row: list[str], columns: dict[str, int]) -> bool:
    """Whether a row below the head states units."""
    cells = [row[place].strip() for kind, place in columns.items() if kind != "storey"]
    return (
        ("storey" not in columns or not row[columns["storey"]].strip())
        and any(cells)
        and not any(re.fullmatch(r"[+-]?[\d.].*", cell) for cell in cells)
    )


def _number(cell: str, what: str, path: Path) -> float:
    text = cell.strip().replace(" ", "")
    if text == "":
        return float("nan")
    if re.fullmatch(r"[+-]?\d{1,3}(,\d{3})+(\.\d+)?", text):
        text = text.replace(",", "")
    try:
        number = float(text)
    except ValueError:
        raise refusal(InvalidBuildingFile, what, path.name, "a number", brief(cell)) from None
    return number


# In English, German, Spanish, Portuguese, Italian, French and Turkish, without accents.
_SUMMARY: Final = frozenset(
    (
        *("total", "totals", "subtotal", "sum", "sums", "average", "averages", "avg", "mean", "max", "maximum", "min"),
        *("minimum", "note", "notes", "remark", "remarks", "summe", "summen", "gesamt", "gesamtsumme", "zwischensumme"),
        *("insgesamt", "mittelwert", "durchschnitt", "hinweis", "anmerkung", "bemerkung", "totales", "suma"),
        *("sumatoria", "promedio", "maximo", "minimo", "nota", "notas", "observacion", "observaciones", "totais"),
        *("soma", "somatorio", "observacao", "observacoes", "totale", "totali", "subtotale", "somma", "massimo"),
        *("totaux", "somme", "moyenne", "remarque", "remarques", "toplam", "toplami", "ortalama", "maksimum", "azami"),
        *("asgari", "notlar"),
    )
)
_SUMMARY_ALONE: Final = frozenset({"media", "medio", "mittel", "moyen", "not"})
"""Words that are those of a mean or of a note only where nothing else is in the cell: a storey may be for media."""
_NEED: Final = "that of a storey: remove it, or where it is a storey name it with its number, as Story 1"
_LIKE_SUM: Final = 1e-3
"""Masses of a table are rounded; a total of rounded masses is met within this part of itself."""


def _words(name: str) -> list[str]:
    """Words of a name, without case, accents, digits and punctuation."""
    letters = unicodedata.normalize("NFKD", name.casefold().replace("\u0131", "i"))
    return re.findall(r"[^\W\d_]+", "".join(each for each in letters if not unicodedata.combining(each)))


def is_base(name: str) -> bool:
    """Whether a row is the ground level by the name that ETABS gives it."""
    return _words(name) == ["base"] and not re.search(r"\d", name)


def refuse_summaries(names: Sequence[str], file: str) -> None:
    """Refuse rows whose names are those of totals, means, extremes and notes."""
    for name in names:
        words = _words(name)
        if not _SUMMARY.isdisjoint(words) or (len(words) == 1 and words[0] in _SUMMARY_ALONE):
            raise refusal(InvalidBuildingFile, f"row {short(name)}", file, _NEED, "a total, a mean or a note")


def refuse_sums(names: Sequence[str], masses: Sequence[float], file: str) -> None:
    """Refuse a row without a number in its name whose mass (or weight) is the sum of all others."""
    # With the base or without it.
    storeys = {name: mass for name, mass in zip(names, masses, strict=True) if not is_base(name)}
    whole, base = sum(storeys.values()), sum(masses) - sum(storeys.values())
    if len(storeys) < 3:  # two equal floors are each the sum of the others
        return
    for name, value in storeys.items():
        is_sum = any(abs(value - total) <= _LIKE_SUM * total for total in (whole - value, whole - value + base))
        if is_sum and len(re.findall(r"\d+", name)) != 1:
            raise refusal(InvalidBuildingFile, f"row {short(name)}", file, _NEED, "the sum of the other rows' masses")


Order = Literal["roof-first", "ground-first"]

COLUMNS: Final[dict[str, tuple[str, ...]]] = {
    "storey": ("story", "storey", "level", "floor", "name", "story name", "storey name", "floor level"),
    "elevation": ("elevation", "elev", "story elevation", "storey elevation", "z"),
    "height": ("height", "story height", "storey height", "h"),
    "mass": ("mass", "mass x", "ux", "mass ux", "floor mass", "story mass", "storey mass", "m"),
    "weight": ("weight", "floor weight", "story weight", "storey weight", "seismic weight", "w"),
    "stiffness": ("stiffness", "stiffness x", "stiff x", "kx", "k", "story stiffness", "storey stiffness"),
    "strength": ("yield shear", "yield strength", "shear strength", "strength", "vy", "yield shear x"),
    "shear": ("shear", "shear x", "vx", "v", "story shear", "storey shear", "base shear"),
    "drift": ("drift", "drift x", "story drift", "storey drift", "drift ratio"),
}
"""Names of columns, in small letters; x stands for the direction that is asked for."""
_QUANTITIES: Final[dict[str, Quantity]] = {
    "elevation": "length",
    "height": "length",
    "mass": "mass",
    "weight": "force",
    "stiffness": "stiffness",
    "strength": "force",
    "shear": "force",
    "drift": "length",
}
_BASE: Final = re.compile(r"base|ground|foundation|0", re.IGNORECASE)
_ROOF: Final = re.compile(r"roof|top", re.IGNORECASE)


@dataclass(frozen=True)
class StoreyTable(Card):
    """Storeys of another program's model in SI units, storey 1 first: heights (m), floor masses (kg), stiffnesses (N/m)
    and yield shears (N), None where the table has none; `remarks` tell what was inferred.
    """

    source: str
    names: tuple[str, ...]
    heights: FloatArray | None
    mass: FloatArray | None
    stiffness: FloatArray | None
    strength: FloatArray | None
    remarks: tuple[str, ...] = field(default=())

    @property
    def text(self) -> str:
        """What was read, as a table with the roof at its top."""
        columns = {
            "height m": (self.heights, 1.0),
            "mass t": (self.mass, 1e-3),
            "weight kN": (self.mass, 1e-3 * STANDARD_GRAVITY),
            "stiffness kN/m": (self.stiffness, 1e-3),
            "yield shear kN": (self.strength, 1e-3),
        }
        shown = {name: (values, unit) for name, (values, unit) in columns.items() if values is not None}
        rows = [["storey", "name", *shown]]
        for i in reversed(range(len(self.names))):
            cells = [f"{unit * float(values[i]):.6g}" for values, unit in shown.values()]
            rows.append([str(i + 1), self.names[i], *cells])
        lines = [f"read from {printable(self.source)}", *text_table(rows, left=2)]
        return "\n".join([*lines, *(f"  {remark}" for remark in self.remarks)])


def read_storey_table(
    source: str | os.PathLike[str],
    *,
    units: str | None = None,
    order: Order | None = None,
    direction: Literal["x", "y"] = "x",
) -> StoreyTable:
    r"""Read a storey table.

    Parameters
    ----------
    source : path-like
        CSV (comma, semicolon or tab) or XLSX. The head is the first row with a column of storeys and another known one.
    units : str, optional
        Force and length of numbers whose column states no unit, as these programs have them: "kN-m", "kip-in", "kgf-m".
        Masses are then in force times s2 over length.
    order : {"roof-first", "ground-first"}, optional
        Order of the rows, where neither elevations nor names say it.
    direction : {"x", "y"}, default "x"
        Which of the columns "Stiffness X" and "Stiffness Y" is read; the same of masses, shears and drifts.

    Returns
    -------
    StoreyTable
        The storeys, in SI units.

    Raises
    ------
    InvalidBuildingFile
        The file cannot be read, has no head that is known, a cell that is no number, a storey twice, a row of totals,
        means or notes, or a unit or an order that has to be stated.
    MissingPackage
        openpyxl is needed for XLSX.

    Examples
    --------
    >>> import tempfile, pathlib
    >>> from seismass.assessment import read_storey_table
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "storeys.csv"
    ...     _ = file.write_text("Story,Height (m),Mass (t),Stiffness X (kN/m)\nRoof,3.5,120,2e5\nStory1,4,150,3e5\n")
    ...     table = read_storey_table(file)
    >>> table.names, table.mass.tolist(), table.stiffness.tolist()
    (('Story1', 'Roof'), [150000.0, 120000.0], [300000000.0, 200000000.0])
    """
    path = as_path(source, "storey table", InvalidBuildingFile)
    need = "a head with a column story and others such as elevation, height, mass, weight, stiffness"
    sheet = read_sheet(path, COLUMNS, needed=("storey",), need=need, direction=direction)
    names = sheet.texts("storey")
    refuse_summaries(names, path.name)
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated:
        got = f"{short(repeated[0])} in {names.count(repeated[0])} rows: keep one load case and one diaphragm"
        raise refusal(InvalidBuildingFile, "rows", path.name, "one for each storey", got)
    system = None if units is None else system_of(units, path.name)
    owners = [f"storey {short(name)}" for name in names]
    base_rows = [i for i, name in enumerate(names) if is_base(name)]
    ratio = "drift" in sheet.columns and not sheet.units["drift"]
    values: dict[str, list[float]] = {}
    for kind in sheet.columns:
        if kind != "storey":
            factor = 1.0 if kind == "drift" and ratio else sheet.factor(kind, _QUANTITIES[kind], system)
            values[kind] = sheet.numbers(kind, factor, owners, left_out=base_rows)
    for kind in ("mass", "weight"):
        if kind in values:
            refuse_sums(names, values[kind], path.name)
    return _ordered(sheet, names, values, order, ratio=ratio)


def _ordered(
    sheet: Sheet, names: list[str], values: dict[str, list[float]], order: Order | None, *, ratio: bool
) -> StoreyTable:
    """Storeys from the ground up, without the row of the base."""
    path = sheet.path
    remarks: list[str] = []
    rows = list(range(len(names)))
    elevation = values.get("elevation")
    if elevation is not None:
        for name, number in zip(names, elevation, strict=True):
            if np.isnan(number) and not is_base(name):
                what = f"elevation of storey {short(name)}"
                raise refusal(InvalidBuildingFile, what, path.name, "a number", "nothing")
        rows.sort(key=lambda i: -np.inf if np.isnan(elevation[i]) else elevation[i])
    elif is_roof_first(names, order, path):
        rows.reverse()
    base = 0.0
    loads = [values[kind] for kind in ("mass", "weight", "stiffness", "height") if kind in values]
    ground = [i for i in rows if is_base(names[i])]
    if not ground and rows and _BASE.fullmatch(names[rows[0]]) and all(not each[rows[0]] > 0.0 for each in loads):
        ground = rows[:1]
    for row in ground:
        rows.remove(row)
        base = 0.0 if elevation is None else float(np.nan_to_num(elevation[row]))
        remarks.append(f"row {short(names[row])} is the ground and no storey: left out{_carried(sheet, row)}")
    if not rows:
        raise refusal(InvalidBuildingFile, "rows", path.name, "a storey at least", "none")

    def column(kind: str) -> FloatArray | None:
        return np.array([values[kind][i] for i in rows]) if kind in values else None

    heights = column("height")
    if heights is None and elevation is not None:
        heights = np.diff([elevation[i] for i in rows], prepend=base)
        remarks.append(f"heights are differences of elevations, over a base at {base:g} m")
    mass, weight = column("mass"), column("weight")
    if mass is None and weight is not None:
        mass = weight / STANDARD_GRAVITY
        remarks.append("masses are weights over g")
    stiffness, shear, drift = column("stiffness"), column("shear"), column("drift")
    if stiffness is None and shear is not None and drift is not None:
        if ratio and heights is None:
            raise refusal(InvalidBuildingFile, "height", path.name, "given with drift ratios", "none")
        length = drift * heights if ratio and heights is not None else drift
        stiffness = np.abs(shear) / np.abs(length)
        remarks.append(f"stiffnesses are shears over drifts{', which are ratios of the heights' if ratio else ''}")
    columns = {"height": heights, "mass": mass, "stiffness": stiffness, "strength": column("strength")}
    for kind, numbers in columns.items():
        if numbers is None:
            continue
        for i, number in enumerate(numbers):
            if not 0.0 < number < np.inf:
                got = "nothing" if np.isnan(number) else f"{number:g}"
                what = f"{kind} of storey {short(names[rows[i]])}"
                raise refusal(InvalidBuildingFile, what, path.name, "a positive number", got)
    return StoreyTable(
        source=path.name,
        names=tuple(names[i] for i in rows),
        heights=heights,
        mass=mass,
        stiffness=stiffness,
        strength=columns["strength"],
        remarks=tuple(remarks),
    )


def _carried(sheet: Sheet, row: int) -> str:
    """What a row that is left out has in the columns that are read, as the table has it."""
    cells = {kind: sheet.body[row][place].strip() for kind, place in sheet.columns.items()}
    sentences = [
        f"{kind} {short(printable(cell))} {printable(sheet.units[kind])}".rstrip()
        for kind, cell in cells.items()
        if kind not in ("storey", "elevation") and cell.strip("0.,-")
    ]
    return f", with {', '.join(sentences)}" if sentences else ""


def is_roof_first(names: list[str], order: Order | None, path: Path) -> bool:
    """Whether the first row is the highest storey: by what is stated, else by names."""
    if order is not None:
        return order == "roof-first"
    if len(names) < 2:
        return False
    first, last = names[0], names[-1]
    if _ROOF.search(first) or _BASE.fullmatch(last):
        return True
    if _ROOF.search(last) or _BASE.fullmatch(first):
        return False
    numbers = [re.findall(r"\d+", name) for name in names]
    if all(len(digits) == 1 for digits in numbers):
        counted = [int(digits[0]) for digits in numbers]
        if counted == sorted(counted, reverse=True):
            return True
        if counted == sorted(counted):
            return False
    need = "stated by --order, roof-first or ground-first, where names and elevations do not say it"
    raise refusal(InvalidBuildingFile, "order of the storeys", path.name, need, f"{short(first)} first")
