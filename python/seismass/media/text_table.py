"""Tables and numbers in plain text: cells to the left or to the right of their columns, one way to write a number."""

from __future__ import annotations

import math
import re
import textwrap
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from itertools import pairwise
from typing import Final

from seismass.base.values import signed


def text_line(cells: Iterable[str], widths: Iterable[int], *, indent: int = 2, gap: int = 0) -> str:
    """Return cells as one line of columns; a cell wider than its column moves what follows. Cells are aligned to the
    right, or to the left where the width is negative, as in "%-12s".
    """
    placed = []
    for cell, width in zip(cells, widths, strict=True):
        room = " " * max(0, abs(width) - shown_width(cell))
        placed.append(cell + room if width < 0 else room + cell)
    return (" " * indent + (" " * gap).join(placed)).rstrip()


def shown_width(text: str) -> int:
    """Return how many columns of a terminal a text takes: two for wide letters, none for marks on letters."""
    if text.isascii():
        return len(text)
    return sum(
        0 if unicodedata.combining(letter) else 2 if unicodedata.east_asian_width(letter) in "WF" else 1
        for letter in text
    )


def text_table(rows: Sequence[Sequence[str]], *, left: int = 1, indent: int = 2) -> list[str]:
    """Return rows of cells, the head first, as lines with columns as wide as their widest cell and two spaces apart.
    The first `left` columns are aligned to the left, the others to the right.
    """
    sizes = (max(map(shown_width, column)) for column in zip(*rows, strict=True))
    widths = [-size if number < left else size for number, size in enumerate(sizes)]
    return [text_line(row, widths, indent=indent, gap=2) for row in rows]


def number_text(
    value: float | None, form: str = ".2f", *, scale: float = 1.0, missing: str = "-", infinite: str | None = None
) -> str:
    """Return a number times `scale` as text; `missing` for None, `infinite`, where given, for infinity and NaN."""
    if value is None:
        return missing
    if infinite is not None and not math.isfinite(value):
        return infinite
    text = signed(scale * value, f"#{form}" if form.endswith("g") else form)
    return text.removesuffix(".")  # of 120. and 3.00e-05, the digits that a form asks for


def column_texts(
    values: Sequence[float | None], *, digits: int = 3, scale: float = 1.0, unit: str = "", missing: str = "-"
) -> list[str]:
    """Return numbers of a column, times `scale`, as texts whose decimal points align. The largest has `digits` digits;
    powers of ten where it is below 1e-4 or above 1e9. `missing` stands for None and NaN.
    """
    scaled = [None if value is None or math.isnan(value) else scale * value for value in values]
    largest = max((abs(value) for value in scaled if value is not None and math.isfinite(value)), default=0.0)
    if 0.0 < largest < 1e-4 or largest >= 1e9:
        form = f".{digits - 1}e"
    else:
        before = math.floor(math.log10(largest)) + 1 if largest > 0.0 else 1
        form = f".{min(max(digits - before, 0), 6)}f"
        if largest > 0.0 and float(f"{largest:{form}}") >= 10.0**before:  # 9.996 is 10.00 in four digits
            form = f".{min(max(digits - before - 1, 0), 6)}f"
    return [missing if value is None else signed(value, form) + unit for value in scaled]


def ends_text(
    low: float | None, high: float | None, form: str = ".2f", *, scale: float = 1.0, infinite: str | None = None
) -> str:
    """Return the ends of an interval as they follow their number: " [0.21, 0.34]"; empty where there are none."""
    if low is None or high is None:
        return ""
    return f" [{', '.join(number_text(end, form, scale=scale, infinite=infinite) for end in (low, high))}]"


def interval_text(value: float | None, low: float | None, high: float | None, form: str = ".2f") -> str:
    """Return a number with the ends of its interval: "0.27 [0.21, 0.34]"; "-" where it is None."""
    return "-" if value is None else number_text(value, form) + ends_text(low, high, form)


def change_text(percent: float | None) -> str:
    """Return a change in whole percent with its sign: "+12 %", "0 %"; "-" where it is None."""
    return "-" if percent is None else f"{signed(percent)} %"


def numbers_text(values: Iterable[float]) -> str:
    """Return numbers side by side, in four digits; one of them where all are written alike."""
    numbers = [f"{value:.4g}" for value in values]
    return numbers[0] if len(set(numbers)) == 1 else " ".join(numbers)


FILLED: Final = 108
"""Width to which texts are filled where they are made: a line that has no room for the next word goes on in it."""
MOST_FILLED: Final = 120
"""Width of the widest of them; a longer line was not filled, and goes on in no other."""
NARROWEST: Final = 40
"""No text is fitted to less."""
_FILLER: Final = "\0"
_wrapped: Final = partial(textwrap.wrap, break_on_hyphens=False, break_long_words=False)
_QUOTED: Final = re.compile(r"'[^'\n]*'|\"[^\"\n]*\"|`[^`\n]*`")
_LABEL: Final = re.compile(r" *(?:- )?(?:\S+(?: \S+)* {2,})?")
"""Indentation of a line, with its dash or its label where it has one."""
_GAP: Final = re.compile(r"\S( {2,})(?=\S)")


def fit_text(text: str, width: int) -> str:
    """Return a text whose lines fit a width where words allow. A table (columns two spaces apart) that is too wide goes
    on in parts below, each with its first column; a column that is too wide is wrapped.
    """
    return "\n".join(line for _, fitted in fitted_blocks(text, width) for line in fitted)


def folded(text: str, width: int | None) -> str:
    """Return a message whose lines go on below where a width has no room; words and what is quoted stay whole."""
    if width is None:
        return text
    whole = _QUOTED.sub(lambda match: match[0].replace(" ", _FILLER), text)
    lines = ("\n".join(_wrapped(line, width, subsequent_indent="  ")) for line in whole.split("\n"))
    return "\n".join(lines).replace(_FILLER, " ")


def fitted_blocks(text: str, width: int) -> Iterator[tuple[list[str], list[str]]]:
    """Give each table, each sentence and each other line of a text as it is, and in lines that fit; as `fit_text`."""
    for block in _blocks(_spread(text).split("\n")):
        lines = _fitted(block, max(width, NARROWEST))
        yield [line.replace(_FILLER, "") for line in block], [line.replace(_FILLER, "") for line in lines]


def _spread(text: str) -> str:
    """A text with so many letters in a line as it takes columns: fillers follow wide letters."""
    if text.isascii():
        return text
    return "".join(letter + _FILLER * (shown_width(letter) - 1) for letter in text)


def is_row(line: str) -> bool:
    """Whether a line is a row of a table: it has several columns beside its label."""
    return len(_GAP.findall(line)) > 1


def _blocks(lines: list[str]) -> Iterator[list[str]]:
    """Tables, sentences with the lines on which they go on, and other lines one by one."""
    block: list[str] = []
    for line in lines:
        if block and not _goes_on(block, line):
            yield block
            block = []
        block.append(line)
    if block:
        yield block


def _goes_on(block: list[str], line: str) -> bool:
    last = block[-1]
    if not line.strip() or not last.strip():
        return False
    if is_row(block[0]):
        # Rows have a common indentation; one of them may have no more than a cell or two.
        return is_row(line) or (_indent(line) >= _indent(block[0]) and bool(_GAP.search(line)))
    if is_row(line) or _GAP.search(line):
        return False
    start = _start(block[0])
    full = len(last) <= MOST_FILLED and len(last) + 1 + len(line.split()[0]) > FILLED
    return full and start > 0 and _indent(line) == start


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


def _start(line: str) -> int:
    """Where the words of a line begin, after its label."""
    match = _LABEL.match(line)
    return match.end() if match else 0


def _fitted(block: list[str], width: int) -> Iterator[str]:
    if all(len(line) <= width for line in block):
        yield from block
    elif is_row(block[0]):
        yield from _table(block, width)
    else:
        start = _start(block[0])
        if start > width // 2:  # a label that leaves no room is a part of the sentence
            start = _indent(block[0])
        words = " ".join([block[0][start:], *(line.strip() for line in block[1:])])
        yield from _wrapped(words, width, initial_indent=block[0][:start], subsequent_indent=" " * start)


def _table(rows: list[str], width: int) -> Iterator[str]:
    """A table in parts that fit, each with the columns that tell its rows apart."""
    cells = _columns(rows)
    count = next((n for n in range(1, len(cells)) if len(set(zip(*cells[:n], strict=True))) == len(rows)), 1)
    first = ["".join(row) for row in zip(*cells[:count], strict=True)]
    room = width - len(first[0])
    if room < NARROWEST // 2:
        yield from rows
        return
    parts: list[list[list[str]]] = [[]]
    for column in cells[count:]:
        longest = max(len(cell.rstrip()) for cell in column)
        if parts[-1] and sum(len(each[0]) for each in parts[-1]) + longest > room:
            parts.append([])
        parts[-1].append(column)
    for number, part in enumerate(parts):
        if number:
            yield ""
        for label, *row in zip(first, _moved(part[0]), *part[1:], strict=True):
            yield from _row(label + "".join(row[:-1]), row[-1], width)


def _moved(column: list[str]) -> list[str]:
    """A column as it follows another first column: two spaces from it."""
    indent = min((_indent(cell) for cell in column if cell.strip()), default=0)
    return [f"  {cell[indent:]}" for cell in column]


def _row(head: str, last: str, width: int) -> Iterator[str]:
    """A row; its last cell is filled where there is no room for it."""
    if len((head + last).rstrip()) <= width:
        yield (head + last).rstrip()
        return
    pieces = _wrapped(last.strip(), max(width - len(head), NARROWEST // 2))
    indent = " " * _indent(last)
    head = head + indent if len(head + indent) + max(map(len, pieces)) <= width else head
    yield head + pieces[0]
    for piece in pieces[1:]:
        yield " " * len(head) + piece


def _columns(rows: list[str]) -> list[list[str]]:
    """Cells of each column, all of one width with the spaces after them: cut where no row has a letter."""
    length = max(map(len, rows))
    padded = [row.ljust(length) for row in rows]
    empty = [all(row[column] == " " for row in padded) for column in range(length)]
    start = next(column for column in range(length) if not empty[column])
    cuts = [0]
    column = start
    while column < length:
        if empty[column]:
            end = column
            while end < length and empty[end]:
                end += 1
            # Numbers stand at the right of their columns: the spaces before them belong to them.
            if end - column >= 2 and end < length:
                cuts.append(column)
            column = end
        else:
            column += 1
    return [[row[first:last] for row in padded] for first, last in pairwise([*cuts, length])]
