"""Tables and numbers in plain text: cells to the left or to the right of their columns, one way to write a number."""

from __future__ import annotations

import math
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
    placed = (cell.ljust(-width) if width < 0 else cell.rjust(width) for cell, width in zip(cells, widths, strict=True))
    return (" " * indent + (" " * gap).join(placed)).rstrip()


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
    sizes = (max(map(len, column)) for column in zip(*rows, strict=True))
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
