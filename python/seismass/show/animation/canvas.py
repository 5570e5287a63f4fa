"""Lines, boxes and words of a frame, drawn by Pillow at twice the size, and its colours."""

from __future__ import annotations

from typing import Final, TypeAlias

from matplotlib import get_data_path
from PIL import ImageDraw, ImageFont

FINER: Final = 2
"""Frames are drawn so many times as large, and reduced, which smooths their edges."""
PAPER, INK, SOFT, LINE = "#ffffff", "#1c1c1c", "#595959", "#c8c8c8"
SLAB, PALE_YIELD, PALE_SLIDE = "#6b6b6b", "#e9c4d8", "#bcdcee"

Point: TypeAlias = tuple[float, float]
Box: TypeAlias = tuple[float, float, float, float]


class Canvas:
    """Draws in pixels of the frame."""

    def __init__(self) -> None:
        self._fonts = {size: _font(size * FINER, bold=False) for size in (11, 12)}
        self._bold = _font(14 * FINER, bold=True)

    def _text(
        self, draw: ImageDraw.ImageDraw, at: Point, words: str, colour: str, size: int = 12, anchor: str = "la"
    ) -> None:
        font = self._bold if size > 12 else self._fonts[size]
        draw.text((at[0] * FINER, at[1] * FINER), words, fill=colour, font=font, anchor=anchor)

    def _line(self, draw: ImageDraw.ImageDraw, points: list[Point], colour: str, width: float) -> None:
        draw.line([(FINER * x, FINER * y) for x, y in points], fill=colour, width=round(FINER * width), joint="curve")

    def _box(self, draw: ImageDraw.ImageDraw, box: Box, fill: str | None, edge: str | None = None) -> None:
        x0, y0, x1, y1 = (FINER * value for value in box)
        draw.rectangle((x0, y0, max(x0, x1), max(y0, y1)), fill=fill, outline=edge, width=3)


def _font(size: int, *, bold: bool) -> ImageFont.FreeTypeFont:
    """DejaVu Sans, as Matplotlib carries it."""
    return ImageFont.truetype(f"{get_data_path()}/fonts/ttf/DejaVuSans{'-Bold' if bold else ''}.ttf", size)
