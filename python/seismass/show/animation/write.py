"""An animation as a file: a page, a GIF or a film, by the suffix."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from seismass.base.errors import InvalidOption
from seismass.base.files import written_whole
from seismass.base.values import as_path, brief, refusal

if TYPE_CHECKING:
    from seismass.animation.animation import Animation
    from seismass.animation.plane import PlaneAnimation

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
        with written_whole(target) as temporary:
            temporary.write_text(animation.html(), encoding="utf-8")
        return
    from seismass.show.animation.film import write_film  # Pillow and matplotlib, which a page does not need
    from seismass.show.animation.picture import Picture

    write_film(Picture(animation), target, frames_per_second, speed)


def write_plane_animation(
    animation: PlaneAnimation, path: str | Path, *, frames_per_second: float | None = None, speed: float = 1.0
) -> None:
    """Write an animation in two directions; see `PlaneAnimation.write`."""
    from seismass.show.animation.film import write_film  # Pillow and matplotlib
    from seismass.show.animation.plane_picture import PlanePicture

    target = as_path(path, "animation", InvalidOption)
    if target.suffix.lower() not in SUFFIXES[1:]:
        requirement = f"one of {', '.join(SUFFIXES[1:])} in two directions"
        raise refusal(InvalidOption, "suffix", "animation", requirement, brief(target.suffix))
    write_film(PlanePicture(animation), target, frames_per_second, speed)
