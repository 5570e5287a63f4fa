"""Writes docs/figures/film.webp: eight seconds of the built-in example, goods that slide beside the model of a code,
and its dark twin.

Usage: python tools/film.py. `seismass animate --example` shows all of it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

import numpy as np
from PIL import Image

from seismass import animate, read_scene
from seismass.runs.scene_file import example_scene
from seismass.show.animation.picture import Picture

FILM: Final = Path(__file__).parents[1] / "docs" / "figures" / "film.webp"
LENGTH: Final = 8.0
"""Length (s), of the run as of the film."""
PER_SECOND: Final = 12.5
"""Frames per second: 80 ms each, in the whole milliseconds that WebP counts in."""
BEFORE: Final = 0.6
"""Share of the film before the largest drift."""


INVERTED: Final = 0.902
"""How far lightness is turned round on dark pages, and then hues back by half a turn: `svg.inverts` of page.css."""
HALF_TURN: Final = np.array([[-0.574, 1.43, 0.144], [0.426, 0.43, 0.144], [0.426, 1.43, -0.856]])


def dark(frame: Image.Image) -> Image.Image:
    """Return a frame in the colours of dark pages."""
    share = np.asarray(frame.convert("RGB")) / 255.0
    turned = (INVERTED + (1.0 - 2.0 * INVERTED) * share) @ HALF_TURN.T
    return Image.fromarray(np.rint(255.0 * turned.clip(0.0, 1.0)).astype(np.uint8))


def main() -> None:
    """Write the film around the largest drift of the building whose goods slide."""
    file = read_scene(example_scene())
    animation = animate(file.scene, file.motion)
    real = animation.shown.runs[0].response
    largest = float(real.time[np.abs(real.drift).max(axis=1).argmax()])
    begin = largest - BEFORE * LENGTH
    picture = Picture(animation)
    frames = [
        picture.frame(begin + number / PER_SECOND, lasting=1.0 / PER_SECOND)
        for number in range(round(LENGTH * PER_SECOND))
    ]
    each = round(1000 / PER_SECOND)
    for file, shown in ((FILM, frames), (FILM.with_stem("film_dark"), [dark(frame) for frame in frames])):
        shown[0].save(
            file, save_all=True, append_images=shown[1:], duration=each, loop=0, lossless=True, minimize_size=True
        )
        print(f"{file.name}: {begin:.2f} to {begin + LENGTH:.2f} s, {file.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
