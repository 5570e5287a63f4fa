"""Tables and numbers in plain text: cells to the left or to the right of their columns, one way to write a number."""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Iterable, Sequence


def text_line(cells: Iterable[str], widths: Iterable[int], *, indent: int = 2, gap: int = 0) -> str:
    """Return cells as one line of columns of given widths; a cell that is wider than its column moves what follows.

    Parameters
    ----------
    cells : iterable of str
        The cells.
    widths : iterable of int
        Width of each column, in characters; a cell stands to the right of its column, and to the left where the width
        is negative, as in "%-12s".
    indent, gap : int
        Spaces before the first column, and between columns.

    Examples
    --------
    >>> text_line(["floor 1", "0.40"], (-10, 8))
    '  floor 1       0.40'
    """
    placed = []
    for cell, width in zip(cells, widths, strict=True):
        room = " " * max(0, abs(width) - shown_width(cell))
        placed.append(cell + room if width < 0 else room + cell)
    return (" " * indent + (" " * gap).join(placed)).rstrip()


def shown_width(text: str) -> int:
    """Return how many columns of a terminal a text takes: two for wide letters, none for marks on letters.

    Examples
    --------
    >>> from seismass.media.text_table import shown_width
    >>> shown_width("2 \u5009\u5eab"), shown_width("roof")
    (6, 4)
    """
    if text.isascii():
        return len(text)
    return sum(
        0 if unicodedata.combining(letter) else 2 if unicodedata.east_asian_width(letter) in "WF" else 1
        for letter in text
    )


def text_table(rows: Sequence[Sequence[str]], *, left: int = 1, indent: int = 2) -> list[str]:
    """Return rows of cells as lines, each column as wide as its widest cell and two spaces from the next.

    Parameters
    ----------
    rows : sequence of sequences of str
        The cells, the head first.
    left : int
        How many columns, from the first, are written to the left; the others are written to the right.
    indent : int
        Spaces before the first column.
    """
    sizes = (max(map(shown_width, column)) for column in zip(*rows, strict=True))
    widths = [-size if number < left else size for number, size in enumerate(sizes)]
    return [text_line(row, widths, indent=indent, gap=2) for row in rows]


def number_text(
    value: float | None, form: str = ".2f", *, scale: float = 1.0, missing: str = "-", infinite: str | None = None
) -> str:
    """Return a number as text.

    Parameters
    ----------
    value : float or None
        The number.
    form : str
        Its format.
    scale : float
        What it is multiplied by, as 1000 for m in mm.
    missing : str
        What stands for None.
    infinite : str, optional
        What stands for a number that is not finite.
    """
    if value is None:
        return missing
    if infinite is not None and not math.isfinite(value):
        return infinite
    return f"{scale * value:{form}}"


def column_texts(
    values: Sequence[float | None], *, digits: int = 3, scale: float = 1.0, unit: str = "", missing: str = "-"
) -> list[str]:
    """Return numbers of a column as texts whose decimal points stand below one another.

    Parameters
    ----------
    values : sequence of float or None
        The numbers.
    digits : int
        Digits of the largest; the others have its decimals. A column whose largest number is below 1e-4 or above 1e9
        has powers of ten.
    scale : float
        What they are multiplied by.
    unit : str
        What follows each number.
    missing : str
        What stands for None, and for what is not a number.

    Examples
    --------
    >>> column_texts([0.06374, 0.00812, 3.296e-6], digits=4, scale=1e3, unit=" mm")
    ['63.74 mm', '8.12 mm', '0.00 mm']
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
