"""Writes docs/figures/film.webp: eight seconds of the built-in example, goods that slide beside the model of a code.

Usage: python tools/film.py. `seismass animate --example` shows all of it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

import numpy as np

from seismass import animate, read_scene
from seismass.runs.scene_file import example_scene
from seismass.show.animation.picture import Picture

FILM: Final = Path(__file__).parents[1] / "docs" / "figures" / "film.webp"
LENGTH: Final = 8.0
"""Length (s), of the run as of the film."""
PER_SECOND: Final = 20
"""Frames per second: 50 ms each, in the whole milliseconds that WebP counts in."""
BEFORE: Final = 0.6
"""Share of the film before the largest drift."""


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
    each = 1000 // PER_SECOND
    frames[0].save(
        FILM, save_all=True, append_images=frames[1:], duration=each, loop=0, lossless=True, minimize_size=True
    )
    print(f"{FILM.name}: {begin:.2f} to {begin + LENGTH:.2f} s, {FILM.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
