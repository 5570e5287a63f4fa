"""Tables and numbers in plain text: cells to the left or to the right of their columns, one way to write a number."""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Iterable, Sequence


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
    """Return a number times `scale` as text; `missing` stands for None, and `infinite`, if given, for a number that is
    not finite.
    """
    if value is None:
        return missing
    if infinite is not None and not math.isfinite(value):
        return infinite
    return f"{scale * value:{form}}"


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
    return [missing if value is None else f"{value:{form}}{unit}" for value in scaled]


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
    return "-" if percent is None else f"{round(percent):+d} %".replace("+0 %", "0 %")


def numbers_text(values: Iterable[float]) -> str:
    """Return numbers side by side, in four digits; one of them where all are written alike."""
    numbers = [f"{value:.4g}" for value in values]
    return numbers[0] if len(set(numbers)) == 1 else " ".join(numbers)
