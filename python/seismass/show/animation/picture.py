"""Frames of a GIF or film: the same picture as in the page, drawn by Pillow at twice the size and reduced."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING, Final, TypeAlias

import numpy as np
from matplotlib import get_data_path
from PIL import Image, ImageDraw, ImageFont

from seismass.animation.shown import GROUND_HEIGHT, Run
from seismass.base.values import FloatArray

if TYPE_CHECKING:
    from seismass.animation.animation import Animation

WIDTH: Final = 720
BUILDINGS: Final = 330
PANEL: Final = 84
FOOT: Final = 26
"""Sizes (pixels): of a frame, of the pictures of the buildings, of each history, of the axis of time."""
FINER: Final = 2
"""Frames are drawn so many times as large, and reduced, which smooths their edges."""
FLASH: Final = 0.35
"""How long an event is to be seen (s)."""
MOST_CURVES: Final = 4
"""Most blocks whose slips are drawn."""

PAPER, INK, SOFT, LINE = "#ffffff", "#1c1c1c", "#595959", "#c8c8c8"
REAL, MODEL, YIELD, SLAB = "#0072b2", "#b34700", "#a4276f", "#6b6b6b"
PALE_YIELD, PALE_REAL = "#e9c4d8", "#bcdcee"
CURVES: Final = (REAL, "#00765a", YIELD, INK)

_COLOUR_AND_NAME: Final = {True: (REAL, "real"), False: (MODEL, "model")}

Point: TypeAlias = tuple[float, float]
Curve: TypeAlias = tuple[FloatArray, str, str]
"""Values at the rows, colour and name."""

_STATES: Final = {"yield": True, "unload": False, "reload": False, "slip": True, "reverse": True, "stick": False}
"""State that begins with an event: of a storey whether it yields, of a block whether it slides."""
_OF_STOREY: Final = frozenset({"yield", "unload", "reload"})


class Picture:
    """Draws an animation at any time.

    Parameters
    ----------
    animation : Animation
        What is drawn.
    """

    def __init__(self, animation: Animation) -> None:
        self._animation = animation
        self._shown = animation.shown
        self._panels = 1 + bool(animation.scene.storeys) + bool(animation.scene.blocks)
        self._fonts = {size: _font(size * FINER, bold=False) for size in (11, 12)}
        self._bold = _font(14 * FINER, bold=True)
        self._changes = [_changes(run) for run in self._shown.runs]
        self._still = self._histories()

    @property
    def size(self) -> tuple[int, int]:
        """Width and height (pixels), both even, as films need them."""
        return WIDTH, BUILDINGS + self._panels * PANEL + FOOT

    @property
    def duration(self) -> float:
        """Time of the last row (s)."""
        return (self._shown.rows - 1) * self._shown.step

    def sample(self) -> Image.Image:
        """Return a frame in which every colour is to be seen."""
        frame = self.frame(0.5 * self.duration)
        draw = ImageDraw.Draw(frame)
        for place, colour in enumerate(
            (PAPER, INK, SOFT, LINE, REAL, MODEL, YIELD, SLAB, PALE_YIELD, PALE_REAL, *CURVES)
        ):
            draw.rectangle((20 * place, 0, 20 * place + 19, 39), fill=colour)
        return frame

    def frame(self, time: float, lasting: float = 0.0) -> Image.Image:
        """Return the frame at a time.

        Parameters
        ----------
        time : float
            Time of the run (s).
        lasting : float
            How long until the next frame; an event shows in one frame at least.
        """
        image = self._still.copy()
        draw = ImageDraw.Draw(image)
        width = WIDTH / len(self._shown.runs)
        for number, run in enumerate(self._shown.runs):
            self._building(draw, number, run, number * width, width, time, max(FLASH, lasting))
        self._cursor(draw, time)
        return image.reduce(FINER)

    def _at(self, values: FloatArray, run: Run, time: float) -> FloatArray:
        """A row of a history between those that are kept."""
        place = min(time / self._shown.step, run.rows - 1.0)
        row = int(place)
        part = place - row
        between: FloatArray = (1.0 - part) * values[row] + part * values[min(row + 1, run.rows - 1)]
        return between

    def _state(self, number: int, what: tuple[str, int], time: float) -> tuple[bool, float]:
        """Whether a storey yields or a block slides, and for how long it has."""
        times, states = self._changes[number].get(what, ([], []))
        place = int(np.searchsorted(times, time, side="right")) - 1
        return (False, np.inf) if place < 0 else (states[place], time - times[place])

    def _text(
        self, draw: ImageDraw.ImageDraw, at: Point, words: str, colour: str, size: int = 12, anchor: str = "la"
    ) -> None:
        font = self._bold if size > 12 else self._fonts[size]
        draw.text((at[0] * FINER, at[1] * FINER), words, fill=colour, font=font, anchor=anchor)

    def _line(self, draw: ImageDraw.ImageDraw, points: list[Point], colour: str, width: float) -> None:
        draw.line([(FINER * x, FINER * y) for x, y in points], fill=colour, width=round(FINER * width), joint="curve")

    def _box(
        self, draw: ImageDraw.ImageDraw, box: tuple[float, float, float, float], fill: str | None, edge: str | None
    ) -> None:
        x0, y0, x1, y1 = (FINER * value for value in box)
        draw.rectangle((x0, y0, max(x0, x1), max(y0, y1)), fill=fill, outline=edge, width=3)

    def _building(
        self, draw: ImageDraw.ImageDraw, number: int, run: Run, left: float, width: float, time: float, flash: float
    ) -> None:
        """One building with its goods, and what has become of it so far."""
        heights, storeys = self._shown.heights, len(self._shown.heights)
        roof = any(block.floor == storeys for block in self._animation.scene.blocks) and storeys
        top = 66.0 + (min(46.0, 90.0 / storeys) if roof else 0.0)
        total = float(heights.sum()) or GROUND_HEIGHT
        scale = (BUILDINGS - top - 24.0) / total
        middle, ground = left + 0.5 * width, BUILDINGS - 24.0
        half = min(0.27 * width, max((0.42 if storeys else 1.5) * total * scale, 40.0))
        colour = REAL if run.attached is None else MODEL
        self._text(draw, (middle, 4), run.label[:1].upper() + run.label[1:], colour, 14, "ma")
        self._text(draw, (middle, 23), run.what, SOFT, 12, "ma")
        if storeys:
            rows = slice(0, min(int(time / self._shown.step), run.rows - 1) + 1)
            storey = self._shown.storey
            so = 1e3 * float(np.abs(run.response.drift[rows, storey]).max())
            words = f"largest drift of storey {storey + 1} so far {so:.1f} mm"
            if run.response.collapsed_storey is not None and time >= run.response.end_time:
                words = f"storey {run.response.collapsed_storey} collapsed at {run.response.end_time:.2f} s"
            self._text(draw, (middle, 39), words, SOFT, 12, "ma")
        self._line(draw, [(left + 0.06 * width, ground + 1), (left + 0.94 * width, ground + 1)], SOFT, 2)
        enlarged = self._shown.factor * scale
        xs, ys = [middle], [ground]
        drifts = self._at(run.response.drift, run, time)
        for drift, height in zip(drifts.tolist(), heights, strict=True):
            xs.append(xs[-1] + enlarged * drift)
            ys.append(ys[-1] - float(height) * scale)
        thin = min(3.0, max(1.0, scale * total / max(storeys, 1) / 24.0))
        for storey in range(storeys):
            yields, age = self._state(number, ("storey", storey + 1), time)
            for side in (-0.88 * half, 0.88 * half):
                curve = _column((xs[storey] + side, ys[storey]), (xs[storey + 1] + side, ys[storey + 1]))
                if yields and age < flash:
                    self._line(draw, curve, PALE_YIELD, thin + 12.0)
                self._line(draw, curve, YIELD if yields else colour, 2.0 * thin + 1.0 if yields else thin)
        slab = min(6.0, max(1.5, scale * total / max(storeys, 1) / 10.0))
        for x, y in zip(xs[1:], ys[1:], strict=True):
            self._box(draw, (x - half, y, x + half, y + slab), SLAB, None)
        self._blocks(draw, number, run, (xs, ys), (half, scale, total), time, flash)

    def _blocks(
        self,
        draw: ImageDraw.ImageDraw,
        number: int,
        run: Run,
        floors: tuple[list[float], list[float]],
        sizes: tuple[float, float, float],
        time: float,
        flash: float,
    ) -> None:
        """The goods of one building: they slide, or a share of them is part of the floors."""
        (xs, ys), (half, scale, total) = floors, sizes
        scene, colour = self._animation.scene, REAL if run.attached is None else MODEL
        count: dict[int, int] = defaultdict(int)
        for block in scene.blocks:
            count[block.floor] += 1
        taken: dict[int, int] = defaultdict(int)
        mass = np.sqrt(scene.block_mass / scene.block_mass.max()) if scene.blocks else []
        slips = self._at(run.response.slip, run, time)
        for place, (block, ratio) in enumerate(zip(scene.blocks, mass, strict=True)):
            if run.attached is not None and block.floor == 0:
                continue
            size = 0.4 + 0.6 * float(ratio)
            slot = 1.7 * half / count[block.floor]
            storey = (self._shown.heights[min(block.floor, scene.storeys - 1)] if scene.storeys else total) * scale
            wide = max(6.0, min(0.62 * slot, 0.9 * half) * size)
            high = max(4.0, min(0.5 * storey, 0.8 * wide, 46.0 if scene.storeys else 100.0) * size)
            home = xs[block.floor] - 0.85 * half + slot * (taken[block.floor] + 0.5)
            taken[block.floor] += 1
            base = ys[block.floor]
            if run.attached is not None:
                self._box(draw, (home - 0.5 * wide, base - high, home + 0.5 * wide, base), None, colour)
                self._box(draw, (home - 0.5 * wide, base - high * run.attached, home + 0.5 * wide, base), colour, None)
                continue
            slides, age = self._state(number, ("block", place + 1), time)
            x = home + self._shown.factor * scale * float(slips[place])
            box = (x - 0.5 * wide, base - high, x + 0.5 * wide, base)
            if slides and age < flash:
                self._box(draw, (box[0] - 5, box[1] - 5, box[2] + 5, box[3]), PALE_REAL, None)
            self._line(draw, [(home, base + 1), (home, base + 6)], INK, 1.5)
            self._box(draw, box, colour if slides else PAPER, colour)
            self._line(draw, [(x, base), (x, base - min(6.0, high))], PAPER if slides else colour, 1.5)

    def _histories(self) -> Image.Image:
        """What does not move: the histories and their axes."""
        image = Image.new("RGB", (FINER * WIDTH, FINER * self.size[1]), PAPER)
        draw = ImageDraw.Draw(image)
        for place, (title, curves) in enumerate(self._curves()):
            top, low = BUILDINGS + place * PANEL + 18.0, BUILDINGS + (place + 1) * PANEL - 8.0
            x = 52.0
            for words, colour in ((title, INK), *((name, colour) for _, colour, name in curves)):
                self._text(draw, (x, top - 16), words, colour)
                x += self._fonts[12].getlength(words) / FINER + 10.0
            ends = [min(0.0, *(float(values.min()) for values, _, _ in curves))]
            ends.append(max(0.0, *(float(values.max()) for values, _, _ in curves)))
            if ends[0] == ends[1]:
                ends = [-1.0, 1.0]
            for value in (ends[0], 0.0, ends[1]):
                y = low - (value - ends[0]) / (ends[1] - ends[0]) * (low - top)
                self._line(draw, [(52, y), (WIDTH - 12, y)], LINE, 1)
                if value == 0.0 or abs(value) > 0.2 * (ends[1] - ends[0]):
                    words = "0" if value == 0.0 else f"{value:.3g}".replace("-", "\N{MINUS SIGN}")
                    self._text(draw, (46, y), words, SOFT, 11, "rm")
            for values, colour, _ in curves:
                along: FloatArray = 52.0 + (WIDTH - 64.0) * np.linspace(
                    0.0, (len(values) - 1) / self._last, len(values)
                )
                across: FloatArray = low - (values - ends[0]) / (ends[1] - ends[0]) * (low - top)
                self._line(draw, list(zip(along.tolist(), across.tolist(), strict=True)), colour, 1.5)
        seconds = next((one for one in (1, 2, 5, 10, 20, 50, 100) if self.duration / one <= 14.0), 200)
        for second in range(0, int(self.duration) + 1, seconds):
            x = 52.0 + (WIDTH - 64.0) * second / max(self.duration, 1e-9)
            self._text(draw, (x, self.size[1] - FOOT + 2), f"{second}", SOFT, 11, "ma")
        self._text(draw, (WIDTH - 6, self.size[1] - 2), "time (s)", SOFT, 11, "rs")
        return image

    @property
    def _last(self) -> int:
        return max(self._shown.rows - 1, 1)

    def _curves(self) -> list[tuple[str, list[Curve]]]:
        """Each history's title and curves; of the ground the larger end of its range."""
        shown, scene = self._shown, self._animation.scene
        real = shown.runs[0]
        larger = np.where(np.abs(shown.ground_low) > np.abs(shown.ground_high), shown.ground_low, shown.ground_high)
        panels: list[tuple[str, list[Curve]]] = [("ground acceleration (g)", [(larger, INK, "")])]
        if scene.storeys:
            drifts = [
                (1e3 * run.response.drift[: run.rows, shown.storey], *_COLOUR_AND_NAME[run.attached is None])
                for run in shown.runs
            ]
            panels.append((f"drift of storey {shown.storey + 1} (mm)", drifts))
        if scene.blocks:
            most = np.sort(np.argsort(-real.response.peak_slip, kind="stable")[:MOST_CURVES])
            slips = [
                (1e3 * real.response.slip[: real.rows, block], colour, f"block {block + 1}")
                for block, colour in zip(most.tolist(), CURVES, strict=False)
            ]
            panels.append(("slip (mm)", slips))
        return panels

    def _cursor(self, draw: ImageDraw.ImageDraw, time: float) -> None:
        x = 52.0 + (WIDTH - 64.0) * time / max(self.duration, 1e-9)
        self._line(draw, [(x, BUILDINGS + 14.0), (x, self.size[1] - FOOT)], INK, 1.5)
        self._text(draw, (WIDTH - 8, BUILDINGS + 2), f"{time:.2f} s", INK, 12, "ra")


def _font(size: int, *, bold: bool) -> ImageFont.FreeTypeFont:
    """DejaVu Sans, as Matplotlib carries it."""
    return ImageFont.truetype(f"{get_data_path()}/fonts/ttf/DejaVuSans{'-Bold' if bold else ''}.ttf", size)


def _column(foot: Point, head: Point) -> list[Point]:
    """A column that is upright at both ends, as of a shear building."""
    part = np.linspace(0.0, 1.0, 13)
    x = foot[0] + (head[0] - foot[0]) * part * part * (3.0 - 2.0 * part)
    y = foot[1] + (head[1] - foot[1]) * part
    return list(zip(x.tolist(), y.tolist(), strict=True))


def _changes(run: Run) -> dict[tuple[str, int], tuple[list[float], list[bool]]]:
    """Times at which storeys begin and cease to yield, and blocks to slide."""
    found: dict[tuple[str, int], tuple[list[float], list[bool]]] = defaultdict(lambda: ([], []))
    log = run.response.event_log
    for time, kind, number in zip(log["time"].tolist(), log["kind"].tolist(), log["number"].tolist(), strict=True):
        if kind in _STATES:
            times, states = found["storey" if kind in _OF_STOREY else "block", number]
            times.append(time)
            states.append(_STATES[kind])
    return dict(found)
