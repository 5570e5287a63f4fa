"""Lines, boxes and words of a frame, drawn by Pillow at twice the size, and its colours."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Final, TypeAlias

import numpy as np
from matplotlib import get_data_path
from PIL import Image, ImageDraw, ImageFont

from seismass.base.values import FloatArray
from seismass.media.roles import ATTACHED, CODE, SLIDE

FINER: Final = 2
"""Frames are drawn so many times as large, and reduced, which smooths their edges."""
PAPER, INK, SOFT, LINE = "#ffffff", "#1c1c1c", "#595959", "#c8c8c8"
SLAB, PALE_YIELD, PALE_SLIDE = "#6b6b6b", "#e9c4d8", "#bcdcee"
WIDTH: Final = 720
SCENES: Final = 330
PANEL: Final = 84
FOOT: Final = 26
"""Sizes (pixels): of a frame, of the pictures of buildings, of each history, of the axis of time."""
CURVES: Final = (SLIDE.text, CODE.text, ATTACHED.text, INK)
"""Colours of blocks, of floors and of levels, in their order."""

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


class Frames(Canvas, ABC):
    """Draws frames with buildings above and histories below, over one axis of time."""

    @property
    @abstractmethod
    def panels(self) -> int:
        """Number of histories."""

    @property
    @abstractmethod
    def duration(self) -> float:
        """Time of the last row (s)."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height (pixels), both even, as films need them."""
        return WIDTH, SCENES + self.panels * PANEL + FOOT

    @abstractmethod
    def frame(self, time: float, lasting: float = 0.0) -> Image.Image:
        """Return the frame at a time (s), which lasts until the next one (s)."""

    @property
    @abstractmethod
    def colours(self) -> tuple[str, ...]:
        """Every colour of a frame."""

    def sample(self) -> Image.Image:
        """Return a frame in which every colour is to be seen."""
        frame = self.frame(0.5 * self.duration)
        draw = ImageDraw.Draw(frame)
        for place, colour in enumerate(self.colours):
            draw.rectangle((20 * place, 0, 20 * place + 19, 39), fill=colour)
        return frame

    def _time_at(self, time: float) -> float:
        """Where a time stands along the axis."""
        return 52.0 + (WIDTH - 64.0) * time / max(self.duration, 1e-9)

    def _cursor(self, draw: ImageDraw.ImageDraw, time: float) -> None:
        x = self._time_at(time)
        self._line(draw, [(x, SCENES + 14.0), (x, self.size[1] - FOOT)], INK, 1.5)
        self._text(draw, (WIDTH - 8, SCENES + 2), f"{time:.2f} s", INK, 12, "ra")

    def _curve(self, draw: ImageDraw.ImageDraw, across: FloatArray, last: int, colour: str) -> None:
        """A history, row by row at the heights `across`; the axis ends at row `last`."""
        along = 52.0 + (WIDTH - 64.0) * np.linspace(0.0, (len(across) - 1) / max(last, 1), len(across))
        self._line(draw, list(zip(along.tolist(), across.tolist(), strict=True)), colour, 1.5)

    def _time_axis(self, draw: ImageDraw.ImageDraw) -> None:
        seconds = next((one for one in (1, 2, 5, 10, 20, 50, 100) if self.duration / one <= 14.0), 200)
        for second in range(0, int(self.duration) + 1, seconds):
            at = (self._time_at(second), self.size[1] - FOOT + 2)
            self._text(draw, at, f"{second}", SOFT, 11, "ma")
        self._text(draw, (WIDTH - 6, self.size[1] - 2), "time (s)", SOFT, 11, "rs")


def _font(size: int, *, bold: bool) -> ImageFont.FreeTypeFont:
    """DejaVu Sans, as Matplotlib carries it."""
    return ImageFont.truetype(f"{get_data_path()}/fonts/ttf/DejaVuSans{'-Bold' if bold else ''}.ttf", size)
