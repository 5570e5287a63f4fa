"""Cells of XLSX workbooks, by the standard library, within limits and without document types."""

from __future__ import annotations

import io
import posixpath
import re
import zipfile
import zlib
from typing import Final, TypeAlias
from xml.etree import ElementTree

from seismass.base.errors import InvalidBuildingFile
from seismass.base.limits import MOST_COLUMNS, MOST_ROWS, MOST_TABLE
from seismass.base.values import refusal, short

Cell: TypeAlias = str | float
"""A cell as text, or as the number that a workbook has."""
Rows: TypeAlias = list[list[Cell]]

_BROKEN: Final = (zipfile.BadZipFile, zlib.error, ElementTree.ParseError, KeyError, IndexError, ValueError, EOFError)


class _Plain(ElementTree.TreeBuilder):
    """Elements of XML without a document type, which could define entities."""

    def doctype(self, *_: object) -> None:
        raise ValueError("XML with a document type")


def sheets_of(content: bytes, name: str) -> dict[str, Rows]:
    """Return the rows of every visible sheet that are not empty, by the sheet's name."""
    left = MOST_TABLE

    def part(archive: zipfile.ZipFile, place: str) -> ElementTree.Element:
        nonlocal left
        with archive.open(place) as file:
            text = file.read(left + 1)
        left -= len(text)
        if left < 0:
            need = f"at most {MOST_TABLE // 2**20} MB unpacked"
            raise refusal(InvalidBuildingFile, "size", name, need, "more")
        return ElementTree.fromstring(text, ElementTree.XMLParser(target=_Plain()))

    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            links = {link.get("Id"): link.get("Target", "") for link in part(archive, "xl/_rels/workbook.xml.rels")}
            sheets = [
                (sheet.get("name", ""), next((value for key, value in sheet.items() if key.endswith("}id")), ""))
                for sheet in part(archive, "xl/workbook.xml").iterfind("{*}sheets/{*}sheet")
                if sheet.get("state", "visible") == "visible"
            ]
            texts: list[str] = []
            if "xl/sharedStrings.xml" in archive.namelist():
                texts = [_text(item) for item in part(archive, "xl/sharedStrings.xml")]
            places = {
                title: posixpath.normpath(posixpath.join("/xl", links[link])).lstrip("/") for title, link in sheets
            }
            return {title: _rows(part(archive, place), texts, name) for title, place in places.items()}
    except (*_BROKEN, RuntimeError) as error:  # RuntimeError: encrypted, or packed in a way that is not known
        if isinstance(error, InvalidBuildingFile):
            raise
        raise refusal(InvalidBuildingFile, "content", name, "a workbook", short(str(error))) from error


def _text(item: ElementTree.Element) -> str:
    """Text of a cell or a shared string, in pieces or whole, without phonetic readings."""
    return "".join(piece.text or "" for piece in (*item.iterfind("{*}t"), *item.iterfind("{*}r/{*}t"))).strip()


def _rows(sheet: ElementTree.Element, texts: list[str], name: str) -> Rows:
    """Rows of a sheet that are not empty; text in a cell, numbers that are text among it, stays text."""
    rows: Rows = []
    for row in sheet.iterfind("{*}sheetData/{*}row"):
        cells: list[Cell] = []
        column = -1
        for cell in row.iterfind("{*}c"):
            letters = re.match("[A-Z]{1,3}", cell.get("r", ""))
            column = column + 1 if letters is None else _column(letters[0])
            kind, value = cell.get("t", "n"), (cell.findtext("{*}v") or "").strip()
            inline = cell.find("{*}is")
            entry: Cell = value if inline is None else _text(inline)
            if kind == "s" and value:
                entry = texts[int(value)]
            elif kind == "n" and value:
                entry = float(value)
            if entry == "":
                continue
            if column >= MOST_COLUMNS:
                raise refusal(InvalidBuildingFile, "columns", name, f"at most {MOST_COLUMNS}", f"{column + 1}")
            cells += [""] * (column - len(cells))
            cells.append(entry)
        if cells:
            rows.append(cells)
        if len(rows) > MOST_ROWS:
            raise refusal(InvalidBuildingFile, "rows of a sheet", name, f"at most {MOST_ROWS}", "more")
    return rows


def _column(letters: str) -> int:
    place = 0
    for letter in letters:
        place = 26 * place + ord(letter) - ord("A") + 1
    return place - 1
