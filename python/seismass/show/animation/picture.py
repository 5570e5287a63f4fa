"""Frames of a GIF or film: the same picture as in the page, drawn by Pillow at twice the size and reduced."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import Counter, defaultdict
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias

import numpy as np
from matplotlib import get_data_path
from PIL import Image, ImageDraw, ImageFont

from seismass.base.values import FloatArray, signed
from seismass.media.roles import ATTACHED, BARE, BLOCK_COLOURS, CODE, SLIDE, YIELDS, Role, lettered
from seismass.model.scene import rack_levels
from seismass.show.animation.animation import GROUND_HEIGHT, Good, Run, standing_goods

if TYPE_CHECKING:
    from seismass.show.animation.animation import Animation, PlaneAnimation, Shown


FINER: Final = 2
"""Frames are drawn so many times as large, and reduced, which smooths their edges."""
PAPER, INK, SOFT, LINE = "#ffffff", "#1c1c1c", "#595959", "#c8c8c8"
SLAB, PALE_YIELD, PALE_SLIDE = "#6b6b6b", "#e9c4d8", "#bcdcee"
WIDTH: Final = 720
SCENES: Final = 330
PANEL: Final = 84
FOOT: Final = 26
"""Sizes (pixels): of a frame, of the pictures of buildings, of each history, of the axis of time."""
CURVES: Final = (SLIDE.text, *BLOCK_COLOURS[1:4])
"""Colours of blocks, of floors and of levels, in their order."""

Point: TypeAlias = tuple[float, float]
Box: TypeAlias = tuple[float, float, float, float]


class Canvas:
    """Draws in pixels of the frame."""

    def __init__(self) -> None:
        self._fonts = {size: _font(size * FINER, bold=False) for size in (11, 12)}
        self._bold = _font(14 * FINER, bold=True)

    def _text(
        self, draw: ImageDraw.ImageDraw, place: Point, words: str, colour: str, size: int = 12, anchor: str = "la"
    ) -> None:
        font = self._bold if size > 12 else self._fonts[size]
        draw.text((place[0] * FINER, place[1] * FINER), words, fill=colour, font=font, anchor=anchor)

    def _line(self, draw: ImageDraw.ImageDraw, points: list[Point], colour: str, width: float) -> None:
        draw.line([(FINER * x, FINER * y) for x, y in points], fill=colour, width=round(FINER * width), joint="curve")

    def _box(self, draw: ImageDraw.ImageDraw, box: Box, fill: str | None, edge: str | None = None) -> None:
        x0, y0, x1, y1 = (FINER * value for value in box)
        draw.rectangle((x0, y0, max(x0, x1), max(y0, y1)), fill=fill, outline=edge, width=3)


class Frames(Canvas, ABC):
    """Draws frames with buildings above and histories, `panels`, below, over one axis of time."""

    def __init__(self, shown: Shown | PlaneAnimation, panels: int) -> None:
        super().__init__()
        self.panels, self.played = panels, shown.played
        self._duration = (shown.rows - 1) * shown.step

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
        frame = self.frame(0.5 * self._duration)
        draw = ImageDraw.Draw(frame)
        for place, colour in enumerate(self.colours):
            draw.rectangle((20 * place, 0, 20 * place + 19, 39), fill=colour)
        return frame

    def _time_at(self, time: float) -> float:
        """Where a time stands along the axis."""
        return 52.0 + (WIDTH - 64.0) * time / max(self._duration, 1e-9)

    def _cursor(self, draw: ImageDraw.ImageDraw, time: float) -> None:
        x = self._time_at(time)
        self._line(draw, [(x, SCENES + 14.0), (x, self.size[1] - FOOT)], INK, 1.5)
        self._text(draw, (WIDTH - 8, SCENES + 2), f"{time:.2f} s", INK, 12, "ra")

    def _curve(self, draw: ImageDraw.ImageDraw, across: FloatArray, last: int, colour: str) -> None:
        """A history, row by row at the heights `across`; the axis ends at row `last`."""
        along = 52.0 + (WIDTH - 64.0) * np.linspace(0.0, (len(across) - 1) / max(last, 1), len(across))
        self._line(draw, list(zip(along.tolist(), across.tolist(), strict=True)), colour, 1.5)

    def _time_axis(self, draw: ImageDraw.ImageDraw) -> None:
        seconds = next((one for one in (1, 2, 5, 10, 20, 50, 100) if self._duration / one <= 14.0), 200)
        for second in range(0, int(self._duration) + 1, seconds):
            place = (self._time_at(second), self.size[1] - FOOT + 2)
            self._text(draw, place, f"{second}", SOFT, 11, "ma")
        self._text(draw, (WIDTH - 6, self.size[1] - 2), "time (s)", SOFT, 11, "rs")


def _font(size: int, *, bold: bool) -> ImageFont.FreeTypeFont:
    """DejaVu Sans, as Matplotlib carries it."""
    return ImageFont.truetype(f"{get_data_path()}/fonts/ttf/DejaVuSans{'-Bold' if bold else ''}.ttf", size)


FLASH: Final = 0.35
"""How long an event is to be seen (s)."""
MOST_CURVES: Final = 4
"""Most blocks whose slips are drawn."""

ROLES: Final = (SLIDE, CODE, ATTACHED, BARE, YIELDS)

Curve: TypeAlias = tuple[FloatArray, str, str]
"""Values at the rows, colour and name."""

_STATES: Final = {"yield": True, "unload": False, "reload": False, "slip": True, "reverse": True, "stick": False}
"""State that begins with an event: of a storey whether it yields, of a block whether it slides."""
_OF_STOREY: Final = frozenset({"yield", "unload", "reload"})


def _role(run: Run) -> Role:
    """Role of a run: goods slide, or none, all, or the code's share of them attached."""
    if run.attached is None:
        return SLIDE
    return {0.0: BARE, 1.0: ATTACHED}.get(run.attached, CODE)


def _name(run: Run) -> str:
    """What a history calls a run."""
    return SLIDE.name if run.attached is None else "model"


class Sizes(NamedTuple):
    """Sizes that the drawing of a building shares: pixels, the scale in pixels a metre, and how long an event flashes;
    `half` width, `total` height and `aloft`, the room of racks on the roof (m), `thin`, a column.
    """

    half: float
    scale: float
    total: float
    aloft: float
    thin: float
    flash: float


class Picture(Frames):
    """Draws an animation at any time."""

    def __init__(self, animation: Animation) -> None:
        scene = animation.scene
        super().__init__(animation.shown, 1 + sum(map(bool, (scene.storeys, scene.base, scene.racks, scene.goods))))
        self._animation = animation
        self._shown = animation.shown
        self._standing = standing_goods(scene)
        self._changes = [_changes(run) for run in self._shown.runs]
        self._still = self._histories()

    @property
    def colours(self) -> tuple[str, ...]:
        """Every colour of a frame."""
        return (PAPER, INK, SOFT, LINE, *(role.text for role in ROLES), SLAB, PALE_YIELD, PALE_SLIDE, *CURVES)

    def frame(self, time: float, lasting: float = 0.0) -> Image.Image:
        """Return the frame at a time (s) that lasts `lasting` (s); an event shows in at least one frame."""
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
        interpolated: FloatArray = (1.0 - part) * values[row] + part * values[min(row + 1, run.rows - 1)]
        return interpolated

    def _state(self, number: int, what: tuple[str, int], time: float) -> tuple[bool, float]:
        """Whether a storey yields or a block slides, and for how long it has."""
        times, states = self._changes[number].get(what, ([], []))
        place = int(np.searchsorted(times, time, side="right")) - 1
        return (False, np.inf) if place < 0 else (states[place], time - times[place])

    def _building(
        self, draw: ImageDraw.ImageDraw, number: int, run: Run, left: float, width: float, time: float, flash: float
    ) -> None:
        """One building with its goods, and what has become of it so far."""
        heights, storeys = self._shown.heights, len(self._shown.heights)
        scene = self._animation.scene
        racked = bool(storeys) and any(rack.floor == storeys for rack in scene.racks)
        aloft = 0.8 * (SCENES - 100.0) / (storeys + 0.8) if racked else 0.0
        roof = any(block.floor == storeys for block in scene.blocks) and storeys
        top = 66.0 + (aloft or (min(46.0, 90.0 / storeys) if roof else 0.0))
        total = float(heights.sum()) or GROUND_HEIGHT
        scale = (SCENES - top - 24.0) / total
        middle, ground = left + 0.5 * width, SCENES - 24.0
        half = min(0.27 * width, max((0.42 if storeys else 1.5) * total * scale, 40.0))
        colour = _role(run).text
        self._text(draw, (middle, 4), run.label[:1].upper() + run.label[1:], colour, 14, "ma")
        self._text(draw, (middle, 23), run.what, SOFT, 12, "ma")
        if storeys:
            rows = slice(0, min(int(time / self._shown.step), run.rows - 1) + 1)
            storey = self._shown.storey
            scale_of_drift, unit, digits = self._drifts()
            so = scale_of_drift * float(np.abs(run.response.drift[rows, storey]).max())
            words = f"largest drift of storey {storey + 1} so far {so:.{digits}f} {unit}"
            if run.response.collapsed_storey is not None and time >= run.response.end_time:
                words = f"storey {run.response.collapsed_storey} collapsed at {run.response.end_time:.2f} s"
            self._text(draw, (middle, 39), words, SOFT, 12, "ma")
        slab, on_base = min(6.0, max(1.5, scale * total / max(storeys, 1) / 10.0)), scene.base is not None
        soil = ground + 1.0 + (slab if on_base else 0.0)
        self._line(draw, [(left + 0.06 * width, soil), (left + 0.94 * width, soil)], SOFT, 2)
        enlarged = self._shown.factor * scale
        xs, ys = [middle + enlarged * float(self._at(run.base_slip, run, time))], [ground]
        for edge in (-half, half) if on_base else ():  # the first place of the slab
            self._line(draw, [(middle + edge, soil), (middle + edge, soil + 5.0)], SOFT, 2)
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
                self._line(draw, curve, YIELDS.text if yields else colour, 2.0 * thin + 1.0 if yields else thin)
        if scene.building is not None and scene.building.stiffness_matrix is not None:
            wall = [(x - 0.97 * half, y) for x, y in zip(xs, ys, strict=True)]
            self._line(draw, wall, SLAB, 2.0 * thin + 2.0)
        first = 0 if on_base else 1
        for x, y in zip(xs[first:], ys[first:], strict=True):
            self._box(draw, (x - half, y, x + half, y + slab), SLAB)
        self._goods(draw, number, run, (xs, ys), Sizes(half, scale, total, aloft, thin, flash), time)

    def _goods(
        self,
        draw: ImageDraw.ImageDraw,
        number: int,
        run: Run,
        floors: tuple[list[float], list[float]],
        sizes: Sizes,
        time: float,
    ) -> None:
        """Blocks and racks of one building, side by side on their floors, blocks first."""
        (xs, ys), scene = floors, self._animation.scene
        on_floor = Counter([*scene.block_floor, *(rack.floor for rack in scene.racks)])
        taken: Counter[int] = Counter()
        slips = self._at(run.response.slip, run, time) if run.attached is None else np.zeros(len(scene.goods))

        def slot_of(floor: int) -> tuple[float, float, float]:
            """Width of a place on a floor, height of the storey above, and the middle of the next place."""
            slot = 1.7 * sizes.half / on_floor[floor]
            storey = self._shown.heights[min(floor, scene.storeys - 1)] if scene.storeys else sizes.total
            taken[floor] += 1
            return slot, float(storey) * sizes.scale, xs[floor] - 0.85 * sizes.half + slot * (taken[floor] - 0.5)

        loose = [good for good in self._standing if not good.fixed]
        for block, (good, slip) in enumerate(zip(loose, slips.tolist(), strict=True), start=1):
            if good.rack or (run.attached is not None and good.level == 0):
                continue
            slot, storey, home = slot_of(good.level)
            size = 0.4 + 0.6 * good.size
            wide = max(6.0, min(0.62 * slot, 0.9 * sizes.half) * size)
            high = max(4.0, min(0.5 * storey, 0.8 * wide, 46.0 if scene.storeys else 100.0) * size)
            self._block(draw, number, run, good, (block, slip), (home, ys[good.level], wide, high), sizes, time)
        drifts = np.split(self._at(run.level_drift, run, time), np.cumsum([rack.levels for rack in scene.racks])[:-1])
        first = scene.storeys + 1
        for place, rack in enumerate(scene.racks, start=1):
            if run.attached is None or rack.floor:
                slot, storey, home = slot_of(rack.floor)
                high = sizes.aloft if sizes.aloft and rack.floor == scene.storeys else 0.84 * storey
                frame = home, ys[rack.floor], min(0.82 * slot, 0.9 * sizes.half), high
                sways = drifts[place - 1].tolist() if run.attached is None else [0.0] * rack.levels
                self._rack(draw, number, run, (place, first), sways, slips, frame, sizes, time)
            first += rack.levels

    def _rack(
        self,
        draw: ImageDraw.ImageDraw,
        number: int,
        run: Run,
        which: tuple[int, int],
        drifts: list[float],
        slips: FloatArray,
        frame: Box,
        sizes: Sizes,
        time: float,
    ) -> None:
        """A rack with its goods; `which` is its number and that of its lowest level among the springs."""
        (place, first), (home, base, wide, high) = which, frame
        colour, each = _role(run).text, high / (len(drifts) + 0.72)
        fine, enlarged = min(2.2, max(1.0, 0.6 * sizes.thin)), self._shown.factor * sizes.scale
        xs = [home, *(home + enlarged * np.cumsum(drifts)).tolist()]
        ys = [base - each * level for level in range(len(drifts) + 1)]
        for level in range(len(drifts)):
            yields, age = self._state(number, ("storey", first + level), time)
            for side in (-0.5 * wide, 0.5 * wide):
                post = [(xs[level] + side, ys[level]), (xs[level + 1] + side, ys[level + 1])]
                if yields and age < sizes.flash:
                    self._line(draw, post, PALE_YIELD, fine + 8.0)
                self._line(draw, post, YIELDS.text if yields else colour, 2.0 * fine + 1.0 if yields else fine)
            self._box(
                draw, (xs[level + 1] - 0.5 * wide, ys[level + 1], xs[level + 1] + 0.5 * wide, ys[level + 1] + 2), SLAB
            )
        of_rack = [good for good in self._standing if good.rack == place]
        loose = [good for good in self._standing if not good.fixed]
        for level in range(1, len(drifts) + 1):
            goods = sorted((good for good in of_rack if good.level == level), key=lambda good: good.fixed)
            for position, good in enumerate(goods):
                slot = 0.96 * wide / len(goods)
                broad = max(4.0, 0.62 * slot * (0.4 + 0.6 * good.size))
                tall = max(3.0, min(0.66 * each, 0.9 * broad, 46.0) * (0.5 + 0.5 * good.size))
                box = xs[level] - 0.48 * wide + slot * (position + 0.5), ys[level], broad, tall
                block = 0 if good.fixed else 1 + next(n for n, one in enumerate(loose) if one is good)
                slip = 0.0 if good.fixed else float(slips[block - 1])
                self._block(draw, number, run, good, (block, slip), box, sizes, time)

    def _block(
        self,
        draw: ImageDraw.ImageDraw,
        number: int,
        run: Run,
        good: Good,
        which: tuple[int, float],
        box: Box,
        sizes: Sizes,
        time: float,
    ) -> None:
        """Goods at their first place: they slide, are fixed, or a share of them is part of the floor."""
        (block, slip), (home, base, wide, high) = which, box
        colour = _role(run).text
        whole = (home - 0.5 * wide, base - high, home + 0.5 * wide, base)
        if run.attached is not None:
            self._box(draw, whole, None, colour)
            self._box(draw, (whole[0], base - high * run.attached, whole[2], base), colour)
            return
        if good.fixed:
            self._box(draw, whole, SLAB)
            return
        slides, age = self._state(number, ("block", block), time)
        x, enlarged = home + self._shown.factor * sizes.scale * slip, self._shown.factor * sizes.scale
        moved = (x - 0.5 * wide, base - high, x + 0.5 * wide, base)
        if slides and age < sizes.flash:
            self._box(draw, (moved[0] - 5, moved[1] - 5, moved[2] + 5, moved[3]), PALE_SLIDE)
        self._line(draw, [(home, base + 1), (home, base + 6)], INK, 1.5)
        self._box(draw, moved, colour if slides else PAPER, colour)
        self._line(draw, [(x, base), (x, base - min(6.0, high))], PAPER if slides else colour, 1.5)
        for side, clearance in zip((-1.0, 1.0), good.stops or (np.inf, np.inf), strict=True):
            if enlarged * clearance <= 2.0 * sizes.half:
                rail = home + side * (0.5 * wide + enlarged * clearance + 1.0)
                self._line(draw, [(rail, base), (rail, base - min(10.0, max(5.0, 0.6 * high)))], INK, 2.0)

    def _histories(self) -> Image.Image:
        """What does not move: the histories and their axes."""
        image = Image.new("RGB", (FINER * WIDTH, FINER * self.size[1]), PAPER)
        draw = ImageDraw.Draw(image)
        for place, (title, curves) in enumerate(self._curves()):
            top, low = SCENES + place * PANEL + 18.0, SCENES + (place + 1) * PANEL - 8.0
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
                    words = lettered(signed(value, ".3g"))
                    self._text(draw, (46, y), words, SOFT, 11, "rm")
            for values, colour, _ in curves:
                across: FloatArray = low - (values - ends[0]) / (ends[1] - ends[0]) * (low - top)
                self._curve(draw, across, self._shown.rows - 1, colour)
        self._time_axis(draw)
        return image

    def _drifts(self) -> tuple[float, str, int]:
        """Factor, unit and digits of the drift that is compared, as on the page: of a height where it is known."""
        building = self._animation.scene.building
        if building is None or building.heights is None:
            return 1e3, "mm", 1
        return 100.0 / float(self._shown.heights[self._shown.storey]), "%", 2

    def _curves(self) -> list[tuple[str, list[Curve]]]:
        """Each history's title and curves; of the ground the larger end of its range."""
        shown, scene = self._shown, self._animation.scene
        sliding = shown.runs[0]
        larger = np.where(np.abs(shown.ground_low) > np.abs(shown.ground_high), shown.ground_low, shown.ground_high)
        panels: list[tuple[str, list[Curve]]] = [("ground acceleration (g)", [(larger, INK, "")])]
        if scene.storeys:
            scale, unit, _ = self._drifts()
            drifts = [
                (scale * run.response.drift[: run.rows, shown.storey], _role(run).text, _name(run))
                for run in shown.runs
            ]
            unit = unit.replace("%", "% of height")
            panels.append((f"drift of storey {shown.storey + 1} ({unit})", drifts))
        if scene.base is not None:
            bases = [(1e3 * run.base_slip, _role(run).text, _name(run)) for run in shown.runs]
            panels.append(("slip of the base (mm)", bases))
        if scene.racks:
            peaks = np.concatenate(sliding.response.peak_rack_drift)
            places = rack_levels(scene)
            swaying = np.sort(np.argsort(-peaks, kind="stable")[:MOST_CURVES])
            racks = [
                (1e3 * sliding.level_drift[:, level], colour, f"rack {places[level][0]} level {places[level][1]}")
                for level, colour in zip(swaying.tolist(), CURVES, strict=False)
            ]
            panels.append(("drift (mm)", racks))
        if scene.goods:
            most = np.sort(np.argsort(-sliding.response.peak_slip, kind="stable")[:MOST_CURVES])
            slips = [
                (1e3 * sliding.response.slip[: sliding.rows, block], colour, f"block {block + 1}")
                for block, colour in zip(most.tolist(), CURVES, strict=False)
            ]
            panels.append(("slip (mm)", slips))
        return panels


def _column(foot: Point, head: Point) -> list[Point]:
    """A column that is upright at both ends, as of a shear building."""
    part = np.linspace(0.0, 1.0, 13)
    x = foot[0] + (head[0] - foot[0]) * part * part * (3.0 - 2.0 * part)
    y = foot[1] + (head[1] - foot[1]) * part
    return list(zip(x.tolist(), y.tolist(), strict=True))


def _changes(run: Run) -> dict[tuple[str, int], tuple[list[float], list[bool]]]:
    """Times at which storeys begin and cease to yield, and blocks to slide."""
    changes: dict[tuple[str, int], tuple[list[float], list[bool]]] = defaultdict(lambda: ([], []))
    log = run.response.event_log
    for time, kind, number in zip(log["time"].tolist(), log["kind"].tolist(), log["number"].tolist(), strict=True):
        if kind in _STATES:
            times, states = changes["storey" if kind in _OF_STOREY else "block", number]
            times.append(time)
            states.append(_STATES[kind])
    return dict(changes)
