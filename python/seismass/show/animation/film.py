"""An animation as a GIF, by Pillow alone, or as a film, by frames piped to ffmpeg."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterator
from math import ceil
from pathlib import Path
from typing import Final, Protocol

from PIL import Image

from seismass.base.errors import InvalidOption, MissingPackage
from seismass.base.files import written_whole
from seismass.base.values import as_positive, refusal

GIF_FRAMES: Final = 12.5
"""Default frames per second of a GIF, whose unit of time is 10 ms."""
FILM_FRAMES: Final = 25.0
"""Default frames per second of a film."""
MOST_FRAMES: Final = 50.0
"""Most frames per second: players show no more of a GIF."""
COLOURS: Final = 32
"""Colours of a GIF."""


class Pictured(Protocol):
    """What draws frames at any time."""

    @property
    def size(self) -> tuple[int, int]:
        """Width and height (pixels), both even."""

    @property
    def duration(self) -> float:
        """Time of the last frame (s)."""

    def sample(self) -> Image.Image:
        """Return a frame in which every colour is to be seen."""

    def frame(self, time: float, lasting: float = 0.0) -> Image.Image:
        """Return the frame at a time (s), shown for `lasting`."""


def write_film(picture: Pictured, path: Path, frames_per_second: float | None, speed: float) -> None:
    """Write a GIF or an MP4, by the suffix of the path; see `Animation.write`."""
    gif = path.suffix.lower() == ".gif"
    default = GIF_FRAMES if gif else FILM_FRAMES
    given = default if frames_per_second is None else frames_per_second
    rate = as_positive(given, "frames_per_second", "animation", InvalidOption)
    if rate > MOST_FRAMES:
        raise refusal(InvalidOption, "frames_per_second", "animation", f"at most {MOST_FRAMES:g}", f"{rate:g}")
    pace = as_positive(speed, "speed", "animation", InvalidOption)
    ffmpeg = None if gif else shutil.which("ffmpeg")
    if not gif and ffmpeg is None:
        raise MissingPackage(
            "ffmpeg of a film must be on the path (Debian, Ubuntu: apt-get install ffmpeg), or the file a .gif or "
            ".html; got none"
        )
    with written_whole(path) as temporary:
        if ffmpeg is None:
            _write_gif(picture, temporary, rate, pace)
        else:
            _write_mp4(picture, temporary, rate, pace, ffmpeg)


def _frames(picture: Pictured, rate: float, speed: float) -> Iterator[Image.Image]:
    """Frames from the start to the end, which is one of them."""
    count = ceil(picture.duration * rate / speed - 1e-6)
    for number in range(count + 1):
        yield picture.frame(min(number * speed / rate, picture.duration), lasting=speed / rate)


def _write_gif(picture: Pictured, path: Path, rate: float, speed: float) -> None:
    # One palette for all frames, of one in which everything is to be seen.
    palette = picture.sample().quantize(COLOURS, dither=Image.Dither.NONE)
    frames = (frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in _frames(picture, rate, speed))
    first = next(frames)
    each = max(20, round(100.0 / rate) * 10)
    first.save(path, format="GIF", save_all=True, append_images=frames, duration=each, loop=0, optimize=True)


def _write_mp4(picture: Pictured, path: Path, rate: float, speed: float, ffmpeg: str) -> None:
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
        said = process.stderr.read().decode(errors="replace").strip()
    if process.returncode != 0:
        raise OSError(f"ffmpeg of a film must end well; got {said or process.returncode}")
