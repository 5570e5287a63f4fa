"""Frames of an animation in two directions: from the side on the left, from above on the right, histories below."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from functools import partial
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, Final

import numpy as np
from PIL import Image, ImageDraw

from seismass.base.errors import InvalidOption, MissingPackage
from seismass.base.files import check_files, open_regular, temporary_folder, write_file
from seismass.base.values import FloatArray, as_path, as_positive, brief, refusal
from seismass.media.roles import SLIDE
from seismass.show.animation.picture import (
    CURVES,
    FINER,
    INK,
    LINE,
    PALE_SLIDE,
    PANEL,
    PAPER,
    SCENES,
    SLAB,
    SOFT,
    WIDTH,
    Frames,
)

if TYPE_CHECKING:
    from seismass.show.animation.animation import Animation, PlaneAnimation


SIDE: Final = 6.0
"""Side (m) of the floor as drawn."""
GOODS: Final = 0.9
"""Side (m) of goods as drawn, where they have room."""


class PlanePicture(Frames):
    """Draws an animation in two directions at any time."""

    def __init__(self, animation: PlaneAnimation) -> None:
        super().__init__(animation, 2)
        self._animation = animation
        self._sway = animation.floor_displacement
        self._slip = animation.response.slip[: animation.rows]
        self._still = self._histories()

    @property
    def colours(self) -> tuple[str, ...]:
        """Every colour of a frame."""
        return (PAPER, INK, SOFT, LINE, SLAB, PALE_SLIDE, *CURVES)

    def frame(self, time: float, lasting: float = 0.0) -> Image.Image:
        """Return the frame at a time (s); `lasting` is of no effect, as no event flashes."""
        image = self._still.copy()
        draw = ImageDraw.Draw(image)
        place = min(time / self._animation.step, self._animation.rows - 1.0)
        row, part = int(place), place - int(place)
        after = min(row + 1, self._animation.rows - 1)
        sway, slip = ((1.0 - part) * each[row] + part * each[after] for each in (self._sway, self._slip))
        self._from_the_side(draw, sway, slip)
        self._from_above(draw, sway, slip, row)
        self._cursor(draw, time)
        return image.reduce(FINER)

    def _goods(self, floor: int) -> list[tuple[int, float, float]]:
        """Index, place along x and along y (m, from the middle of the floor) of the goods on a floor."""
        on_floor = [index for index, level in enumerate(self._animation.response.scene.block_floor) if level == floor]
        columns = max(1, int(np.ceil(np.sqrt(len(on_floor)))))
        rows = max(1, -(-len(on_floor) // columns))
        return [
            (index, SIDE * ((place % columns + 0.5) / columns - 0.5), SIDE * (0.5 - (place // columns + 0.5) / rows))
            for place, index in enumerate(on_floor)
        ]

    def _from_the_side(self, draw: ImageDraw.ImageDraw, sway: FloatArray, slip: FloatArray) -> None:
        """Displacements in x of floors and goods."""
        animation = self._animation
        heights, middle, ground = animation.heights, 0.25 * WIDTH, SCENES - 24.0
        total = float(heights.sum()) or 3.0
        scale = min((ground - 84.0) / total, 0.3 * WIDTH / SIDE)
        half = 0.5 * SIDE * min(scale, 0.3 * WIDTH / SIDE)
        self._text(draw, (middle, 4), "From the side, x", SLIDE.text, 14, "ma")
        self._line(draw, [(0.03 * WIDTH, ground + 1), (0.47 * WIDTH, ground + 1)], SOFT, 2)
        xs = [middle, *(middle + animation.factor * scale * sway[:, 0]).tolist()]
        ys = [ground, *(ground - scale * np.cumsum(heights)).tolist()]
        for number in range(len(heights)):
            for side in (-0.88 * half, 0.88 * half):
                foot, head = (xs[number] + side, ys[number]), (xs[number + 1] + side, ys[number + 1])
                self._line(draw, [foot, head], SLIDE.text, 2.0)
            self._box(draw, (xs[number + 1] - half, ys[number + 1], xs[number + 1] + half, ys[number + 1] + 5.0), SLAB)
        size = scale * GOODS
        for floor in range(len(xs)):
            for index, along, _ in self._goods(floor):
                x = xs[floor] + scale * along * half / (0.5 * SIDE * scale) + animation.factor * scale * slip[index, 0]
                box = (x - 0.5 * size, ys[floor] - size, x + 0.5 * size, ys[floor])
                self._box(draw, box, PALE_SLIDE, CURVES[index % len(CURVES)])

    def _from_above(self, draw: ImageDraw.ImageDraw, sway: FloatArray, slip: FloatArray, row: int) -> None:
        """The floor over the ground, with its goods and their paths so far."""
        animation, floor = self._animation, self._animation.floor
        scale, x0, y0 = 228.0 / (1.35 * SIDE), 0.75 * WIDTH, 0.5 * SCENES + 22.0
        name = "The ground from above" if floor == 0 else f"Floor {floor} from above"
        self._text(draw, (x0, 4), name, SLIDE.text, 14, "ma")
        words = f"displacements {animation.factor:g} times, paths of goods on their floor"
        self._text(draw, (0.5 * WIDTH, 23), words, SOFT, 12, "ma")
        half = 0.5 * SIDE * scale
        self._box(draw, (x0 - half, y0 - half, x0 + half, y0 + half), None, LINE)
        moved = sway[floor - 1] if floor else np.zeros(2)
        x = x0 + animation.factor * scale * moved[0]
        y = y0 - animation.factor * scale * moved[1]
        self._box(draw, (x - half, y - half, x + half, y + half), None, SLAB)
        size = scale * min(GOODS, 0.5 * SIDE / max(1.0, np.sqrt(len(self._goods(floor)))))
        for index, along, across in self._goods(floor):
            colour = CURVES[index % len(CURVES)]
            path = animation.factor * scale * self._slip[: row + 1, index] * [1.0, -1.0]
            home = np.array([x + scale * along, y - scale * across])
            centre = home + animation.factor * scale * slip[index] * [1.0, -1.0]
            self._box(draw, (*(centre - 0.5 * size), *(centre + 0.5 * size)), PALE_SLIDE, colour)
            points = [(float(one), float(other)) for one, other in [*(home + path), centre]]
            self._line(draw, points, colour, 1.5)
        self._text(draw, (x0 + half + 14.0, y0 + half + 6.0), "x", SOFT, 12, "mm")
        self._text(draw, (x0 - half - 12.0, y0 - half - 4.0), "y", SOFT, 12, "mm")

    def _histories(self) -> Image.Image:
        """Lengths of drift and slip vectors over time, behind every frame."""
        image = Image.new("RGB", (WIDTH * FINER, self.size[1] * FINER), PAPER)
        draw = ImageDraw.Draw(image)
        drift = self._animation.response.drift[: self._animation.rows]
        storeys = [
            (1e3 * np.hypot(*drift[:, number].T), f"storey {number + 1}") for number in range(min(4, drift.shape[1]))
        ]
        blocks = [
            (1e3 * np.hypot(*self._slip[:, number].T), f"block {number + 1}")
            for number in range(min(4, self._slip.shape[1]))
        ]
        for place, (title, curves) in enumerate((("length of drift (mm)", storeys), ("length of slip (mm)", blocks))):
            top, low = SCENES + place * PANEL + 18.0, SCENES + (place + 1) * PANEL - 6.0
            self._text(draw, (52, top - 14), title, INK, 12)
            high = max((float(values.max()) for values, _ in curves), default=0.0) or 1.0
            for value, words in ((0.0, "0"), (high, f"{high:.3g}")):
                y = low - value / high * (low - top)
                self._line(draw, [(52, y), (WIDTH - 12, y)], LINE, 1)
                self._text(draw, (46, y), words, SOFT, 11, "rm")
            left = 190
            for (values, named), colour in zip(curves, CURVES, strict=False):
                self._curve(draw, low - values / high * (low - top), len(values) - 1, colour)
                self._text(draw, (left, top - 14), named, colour, 12)
                left += 80
        self._time_axis(draw)
        return image


GIF_FRAMES: Final = 12.5
"""Default frames per second of a GIF, whose unit of time is 10 ms."""
FILM_FRAMES: Final = 25.0
"""Default frames per second of a film."""
MOST_FRAMES: Final = 50.0
"""Most frames per second: players show no more of a GIF."""
COLOURS: Final = 32
"""Colours of a GIF."""


def write_film(picture: Frames, path: Path, frames_per_second: float | None, speed: float) -> None:
    """Write a GIF or an MP4, by the suffix of the path; see `Animation.write`."""
    gif = path.suffix.lower() == ".gif"
    default = GIF_FRAMES if gif else FILM_FRAMES
    frame_rate = default if frames_per_second is None else frames_per_second
    rate = as_positive(frame_rate, "frames_per_second", "animation", InvalidOption)
    if rate > MOST_FRAMES:
        raise refusal(InvalidOption, "frames_per_second", "animation", f"at most {MOST_FRAMES:g}", f"{rate:g}")
    pace = as_positive(speed, "speed", "animation", InvalidOption)
    ffmpeg = None if gif else shutil.which("ffmpeg")
    if not gif and ffmpeg is None:
        raise MissingPackage(
            "ffmpeg of a film must be on the path (Debian, Ubuntu: apt-get install ffmpeg), or the file a .gif or "
            ".html; got none"
        )
    check_files(path)
    if ffmpeg is None:
        write_file(path, partial(_write_gif, picture, rate, pace))
    else:
        with temporary_folder(Path(tempfile.gettempdir())) as folder:
            film = folder.path / "film.mp4"
            _write_mp4(picture, film, rate, pace, ffmpeg)
            with open_regular(film) as whole:
                write_file(path, partial(shutil.copyfileobj, whole))


def _frames(picture: Frames, rate: float, speed: float) -> Iterator[Image.Image]:
    """Frames from the start to the end, which is one of them."""
    first, last = picture.played
    for number in range(ceil((last - first) * rate / speed - 1e-6) + 1):
        yield picture.frame(min(first + number * speed / rate, last), lasting=speed / rate)


def _write_gif(picture: Frames, rate: float, speed: float, file: BinaryIO) -> None:
    # One palette for all frames, of one in which everything is to be seen.
    palette = picture.sample().quantize(COLOURS, dither=Image.Dither.NONE)
    frames = (frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in _frames(picture, rate, speed))
    first = next(frames)
    each = max(20, round(100.0 / rate) * 10)
    first.save(file, format="GIF", save_all=True, append_images=frames, duration=each, loop=0, optimize=True)


def _write_mp4(picture: Frames, path: Path, rate: float, speed: float, ffmpeg: str) -> None:
    width, height = picture.size
    command = [ffmpeg, "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}"]
    command += ["-r", f"{rate:g}", "-i", "-", "-an", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"]
    # A protocol and a whole path: a name that begins with "-" is an option, and one with ":" another protocol.
    with subprocess.Popen(
        [*command, f"file:{path.absolute()}"], stdin=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        assert process.stdin is not None
        assert process.stderr is not None
        try:
            for frame in _frames(picture, rate, speed):
                process.stdin.write(frame.tobytes())
            process.stdin.close()
        except BrokenPipeError:
            pass  # ffmpeg has ended, and says why
        except BaseException:
            process.kill()
            raise
        message = process.stderr.read().decode(errors="replace").strip()
    if process.returncode != 0:
        raise OSError(f"ffmpeg of a film must end well; got {message or process.returncode}")


SUFFIXES: Final = (".html", ".gif", ".mp4")
"""Kinds of files that an animation is written as."""


def write_animation(
    animation: Animation, path: str | Path, *, frames_per_second: float | None = None, speed: float = 1.0
) -> None:
    """Write an animation; see `Animation.write`."""
    target = as_path(path, "animation", InvalidOption)
    suffix = target.suffix.lower()
    if suffix not in SUFFIXES:
        raise refusal(InvalidOption, "suffix", "animation", f"one of {', '.join(SUFFIXES)}", brief(target.suffix))
    if suffix == ".html":
        if frames_per_second is not None or speed != 1.0:
            requirement = "left out for a page, which has a choice of speeds"
            raise refusal(InvalidOption, "frames_per_second or speed", "animation", requirement, "a number")
        write_file(target, animation.html())
        return
    from seismass.show.animation.picture import Picture

    write_film(Picture(animation), target, frames_per_second, speed)


def write_plane_animation(
    animation: PlaneAnimation, path: str | Path, *, frames_per_second: float | None = None, speed: float = 1.0
) -> None:
    """Write an animation in two directions; see `PlaneAnimation.write`."""
    target = as_path(path, "animation", InvalidOption)
    if target.suffix.lower() not in SUFFIXES[1:]:
        requirement = f"one of {', '.join(SUFFIXES[1:])} in two directions"
        raise refusal(InvalidOption, "suffix", "animation", requirement, brief(target.suffix))
    write_film(PlanePicture(animation), target, frames_per_second, speed)
