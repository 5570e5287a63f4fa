"""Tables of other programs as cells: rows of CSV or XLSX, the head with its columns and units, numbers."""

from __future__ import annotations

import csv
import io
import re
import zipfile
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from seismass.assessment.storey_units import Quantity, unit_factor
from seismass.base.errors import InvalidBuildingFile, MissingPackage
from seismass.base.files import MOST_BYTES, read_file
from seismass.base.values import brief, printable, refusal, short

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
        found = book.worksheets[0].iter_rows(values_only=True)
        return [["" if cell is None else str(cell) for cell in row] for row in found]
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
        given = [_name_of(cell, direction) for cell in row]
        found = {
            kind: min((given.index(name) for name in known if name in given), default=-1)
            for kind, known in names.items()
        }
        columns = {kind: place for kind, place in found.items() if place >= 0}
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
