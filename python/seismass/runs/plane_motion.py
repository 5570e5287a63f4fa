"""Motions in two horizontal directions: a pair of records, or two motions, brought to one length."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np

from seismass.base.errors import InvalidMotion
from seismass.base.values import brief, refusal
from seismass.model.motion import Motion, MotionLike, as_motion
from seismass.records.pair import Pair

MotionPair: TypeAlias = Pair | tuple[MotionLike, MotionLike]
"""Motions in two directions: a pair of records, or two motions of one step."""
PlaneMotion: TypeAlias = tuple[Motion, Motion]
"""The motions in x, with the vertical one, and in y, equally long."""


def is_motion_pair(motion: Any) -> bool:
    """Whether something is a Pair, or stands for one: a tuple of two."""
    return isinstance(motion, Pair) or (isinstance(motion, tuple) and len(motion) == 2)


def motions_in_plane(pair: Any, parameter: str = "motion", owner: str = "simulate") -> PlaneMotion:
    """Return the motions in x (with the vertical one, of the pair or of the first) and in y, equally long; `parameter`
    and `owner` name them in errors.
    """
    vertical = None
    if isinstance(pair, Pair):
        x, y = pair.first.motion, pair.second.motion
        vertical = None if pair.vertical is None else pair.vertical.acceleration
    elif isinstance(pair, tuple | list) and len(pair) == 2:
        x, y = (as_motion(each, parameter, owner) for each in pair)
        vertical = x.vertical
    else:
        requirement = "a Pair, or two motions, for a scene in two directions"
        raise refusal(InvalidMotion, parameter, owner, requirement, brief(pair))
    if y.vertical is not None:
        raise refusal(InvalidMotion, "vertical", "motion in y", "left out: it is that of the motion in x", "a motion")
    if not np.isclose(y.dt, x.dt, rtol=1e-9, atol=0.0):
        raise refusal(InvalidMotion, "dt", "motion in y", f"that of the motion in x, {x.dt:g} s", f"{y.dt:g} s")
    count = max(x.samples, y.samples) if vertical is None else len(vertical)
    of_x, of_y = (np.pad(each.acceleration, (0, max(0, count - each.samples)))[:count] for each in (x, y))
    return Motion(of_x, x.dt, vertical), Motion(of_y, x.dt)
