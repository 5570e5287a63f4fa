"""What is unlikely about the scenes and motions of a batch, said as a warning, since a table has no place for it."""

from __future__ import annotations

import warnings
from typing import Any, Final

from seismass.base.errors import DoubtfulInput, SeismassError
from seismass.model.plausibility import motion_remarks
from seismass.model.scene import Scene
from seismass.runs.grid.grid import Grid
from seismass.runs.plane_motion import is_motion_pair

MOST_LOOKED_AT: Final = 100
"""Scenes and motions of a batch that are looked at, from the first on."""


def warn_of_doubts(scenes: Any, motions: Any) -> None:
    """Warn (`DoubtfulInput`) at the caller's line of the first doubtful scene (of a grid: if its first is) and the
    first doubtful motion of a batch. An iterator of motions is not looked at: it can be read only once.
    """
    doubtful = [(number, scene.remarks) for number, scene in enumerate(_listed(scenes), start=1) if scene.remarks]
    if doubtful:
        number, remarks = doubtful[0]
        others = f" (and {len(doubtful) - 1} more scenes)" if len(doubtful) > 1 else ""
        warnings.warn(f"scene {number}: {'; '.join(remarks)}{others}", DoubtfulInput, stacklevel=3)
    given = [motions] if hasattr(motions, "acceleration") else motions if hasattr(motions, "__len__") else ()
    first = list(given)[:MOST_LOOKED_AT]
    alone = [each for one in first for each in (one if is_motion_pair(one) else (one,))]
    strong = motion_remarks([each for each in alone if hasattr(each, "acceleration")])
    if strong:
        others = f" (and {len(strong) - 1} more motions)" if len(strong) > 1 else ""
        warnings.warn(f"{strong[0]}{others}", DoubtfulInput, stacklevel=3)


def _listed(scenes: Any) -> list[Scene]:
    """The first scenes of a batch; what is not a scene is refused elsewhere."""
    if isinstance(scenes, Grid):
        try:
            return [scenes.scene(1)]
        except SeismassError:
            return []
    given = [scenes] if isinstance(scenes, Scene) else scenes if isinstance(scenes, list | tuple) else []
    return [scene for scene in given[:MOST_LOOKED_AT] if isinstance(scene, Scene)]
