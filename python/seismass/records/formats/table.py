"""The rows of numbers of a text and the words around them: where they begin, decimal commas, numbers and lines."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice, pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError
from seismass.records.formats.numbers import is_number, split_touching, to_float

EARLY: Final = 22
"""Rows that are looked at to tell first numbers from samples."""

HEADER_CHARACTERS: Final = 10_000
"""A header says what it has to say in so much text."""

DECIMAL_COMMAS: Final = "decimal commas are read as points"

_COMMENT = ("#", "%", "//", "!")
_SEPARATORS: Final = str.maketrans(",;", "  ")
_CHARACTERS: Final = frozenset("+-.0123456789Ee")
_COMMA_NUMBER = re.compile(r"[+-]?(?:\d+(?:,\d*)?|,\d+)(?:[EeDd][+-]?\d+)?")
_BARE_EXPONENT = re.compile(r"([+-]?\d*\.\d+)([+-]\d{2,3})(?=[\s,;]|$)")
_END: Final = re.compile(r"[^\w\d]*(?:end|eof|fin)\b.*", re.IGNORECASE)


@dataclass(frozen=True)
class Table:
    """The rows of numbers of a file as lines, the text around them, and where they begin in the file."""

    file: str
    header: list[str]
    rows: list[str]
    lines: list[str]
    start: int
    left_out: int = 0

    @property
    def text(self) -> str:
        """The words of the header."""
        return "\n".join(self.header)[:HEADER_CHARACTERS]

    def row(self, index: int) -> list[str]:
        """Return the numbers of a row as written."""
        return split(self.rows[index])

    def line_number(self, index: int) -> int:
        """Return the line of a row, as editors count them."""
        numbered = (number for number, line in enumerate(self.lines, start=1) if number > self.start and _is_row(line))
        return next(islice(numbered, index + self.left_out, None))

    def without(self, count: int) -> Table:
        """Return the table without its first rows."""
        return Table(self.file, self.header, self.rows[count:], self.lines, self.start, self.left_out + count)


def split(line: str) -> list[str]:
    """Return what stands between blanks, commas and semicolons."""
    return line.translate(_SEPARATORS).split()


def _is_row(line: str) -> bool:
    return not line.lstrip().startswith(_COMMENT) and bool(line.translate(_SEPARATORS).strip())


def is_row_of_numbers(line: str) -> bool:
    """Whether a line is one of numbers alone, which ends a header; fields may touch."""
    return _is_row(line) and all(is_number(token) or split_touching(token) for token in split(line))


def read_table(text: str, file: str, remarks: list[str]) -> Table:
    """Return the table of a text: header lines (no numbers, or marked #, %, // or !), then rows of numbers. `remarks`
    gets what was interpreted: decimal commas, a line that marks the end.
    """
    lines = text.splitlines()
    if _has_bare_exponents(lines):
        remarks.append("exponents are written without their letter")
        lines = [_BARE_EXPONENT.sub(r"\1E\2", line) for line in lines]
    header: list[str] = []
    start = len(lines)
    for index, line in enumerate(lines):
        if is_row_of_numbers(line):
            start = index
            break
        if line.strip():
            header.append(line.strip())
    body = lines[start:]
    if any(mark in line for line in body for mark in "#%/!"):
        rows = [line for line in body if _is_row(line)]
        header.extend(line.strip() for line in body if line.lstrip().startswith(_COMMENT))
    else:
        rows = [line for line in body if line and not line.isspace()]
    if not rows:
        got = f"{header[0][:60]!r}" if header else "an empty file"
        raise RecordFormatError(f"content of {file} must be lines of numbers behind a header; got {got}")
    if len(rows) > 1 and _END.fullmatch(rows[-1]):
        remarks.append(f"the last line, {rows[-1].strip()[:30]!r}, left out")
        rows = rows[:-1]
    if has_decimal_commas(rows):
        remarks.append(DECIMAL_COMMAS)
        rows = [line.replace(",", ".") for line in rows]
    table = Table(file, header, rows, lines, start)
    for index in range(min(len(rows), EARLY)):
        _check_row(table, index)
    return table


def has_decimal_commas(rows: Sequence[str]) -> bool:
    """Whether commas in rows are decimal points: no point anywhere, and no number without them. "0,00413" alone may be
    time and sample; it is one number where a decimal part begins with 0 or times would not increase.
    """
    if "," not in rows[0] or any("." in line for line in rows):
        return False
    alone = True
    for line in rows:
        tokens = line.replace(";", " ").split()
        if not all(_COMMA_NUMBER.fullmatch(token) for token in tokens):
            return False
        alone = alone and len(tokens) == 1
    if not alone:
        # "0, 5" is two numbers, "0,1 0,5" are two as well, but with decimals.
        return not any(token.endswith(",") for token in rows[-1].split())
    parts = [line.strip().partition(",") for line in rows]
    if any(decimals.startswith("0") and len(decimals) > 1 for _, _, decimals in parts):
        return True
    return any(float(after or 0) <= float(before or 0) for (before, _, _), (after, _, _) in pairwise(parts))


def _has_bare_exponents(lines: Sequence[str]) -> bool:
    """Whether the last lines of a text are of numbers as 4.2-04, every one of them with an exponent."""
    tokens = [token for line in lines[-EARLY:] for token in split(line)]
    return bool(tokens) and all(_BARE_EXPONENT.fullmatch(token) for token in tokens)


def _check_row(table: Table, index: int) -> None:
    wrong = next((token for token in table.row(index) if not (is_number(token) or split_touching(token))), None)
    if wrong is not None:
        raise RecordFormatError(f"line {table.line_number(index)} of {table.file} must be numbers; got {wrong[:40]!r}")


def numbers_of(table: Table) -> tuple[list[str], NDArray[np.float64], list[int]]:
    """Return all numbers as written and as values, and how many each row has."""
    rows = [split(line) for line in table.rows]
    tokens = [token for row in rows for token in row]
    values: NDArray[np.float64] | None = None
    if set("".join(tokens)) <= _CHARACTERS:
        try:
            values = np.fromiter(map(float, tokens), np.float64, len(tokens))
        except ValueError:
            values = None
    if values is None:
        for index, row in enumerate(rows):
            _check_row(table, index)
            if not all(map(is_number, row)):
                rows[index] = [field for token in row for field in (split_touching(token) or [token])]
        tokens = [token for row in rows for token in row]
        values = np.fromiter(map(to_float, tokens), np.float64, len(tokens))
    counts = [len(row) for row in rows]
    wrong = np.flatnonzero(~np.isfinite(values))
    if len(wrong):
        at = int(np.searchsorted(np.cumsum(counts), wrong[0], side="right"))
        raise RecordFormatError(f"line {table.line_number(at)} of {table.file} must be finite; got infinity")
    return tokens, values, counts
