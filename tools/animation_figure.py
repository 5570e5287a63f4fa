"""Writes docs/figures/animation.png: the built-in example at a time when it shows what an animation is for.

Usage: python tools/animation_figure.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from seismass import animate, read_scene
from seismass.runs.scene_file import example_scene
from seismass.show.animation.animation import Run
from seismass.show.animation.picture import Picture

FIGURE = Path(__file__).parents[1] / "docs" / "figures" / "animation.png"


def is_on(run: Run, begins: str, ends: str, times: np.ndarray) -> np.ndarray:
    """Whether storey 1 yields, or block 1 slides, at each time."""
    log = run.response.event_log
    log = log[(log["number"] == 1) & ((log["kind"] == begins) | (log["kind"] == ends))]
    last = np.searchsorted(log["time"], times, side="right") - 1
    return (last >= 0) & (log["kind"][last] == begins)


def main() -> None:
    """Storey 1 of the real building yields and block 1 slides, while the model does not yield; where it drifts most."""
    file = read_scene(example_scene())
    animation = animate(file.scene, file.motion)
    real, model = animation.shown.runs
    times = np.arange(0.0, file.motion.duration, 0.02)
    fitting = is_on(real, "yield", "unload", times) & is_on(real, "slip", "stick", times)
    fitting &= ~is_on(model, "yield", "unload", times)
    drift = np.interp(times, real.response.time, np.abs(real.response.drift[:, 0]))
    time = float(times[np.argmax(np.where(fitting, drift, -1.0))])
    Picture(animation).frame(time).save(FIGURE)
    print(f"{FIGURE.name}: {time:.2f} s")


if __name__ == "__main__":
    main()
