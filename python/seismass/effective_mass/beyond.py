"""Shares above 1: goods on racks, or that press on stops, may load a building more than all of them attached would."""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass.base.values import FloatArray
from seismass.effective_mass.curve import is_below
from seismass.effective_mass.runs import Peaks
from seismass.model.scene import Scene

LARGEST_SHARE: Final = 2.0
"""Up to which share models are solved where the real building may drift more than the fully attached one."""
SHARES_BEYOND: Final = np.linspace(1.0, LARGEST_SHARE, 41)[1:]
"""Shares above 1 at which models are solved before the first crossing is refined."""
FROM_ONE: Final = np.concatenate([[1.0], SHARES_BEYOND])
"""The same with 1 before them."""


def goes_beyond(scene: Scene) -> bool:
    """Whether shares above 1 are sought: there are racks on floors, or goods with stops."""
    return any(rack.floor > 0 for rack in scene.racks) or any(
        (block.stops is not None or block.stops_y is not None) and block.floor > 0 for block in scene.blocks
    )


def joined(first: Peaks, second: Peaks) -> Peaks:
    """Return the peaks of the scenes of both, one after the other."""
    return Peaks(
        np.concatenate([first.drift, second.drift]),
        np.concatenate([first.base_shear, second.base_shear]),
        np.concatenate([first.slides, second.slides]),
        np.concatenate([first.collapsed, second.collapsed]),
    )


def first_bracket(shares: FloatArray, model: FloatArray, real: float) -> tuple[float, float] | None:
    """Return the shares, from 1 on, between which the model first reaches the real drift; None where it does not."""
    below = is_below(model, np.full(model.shape, real))
    reached = np.flatnonzero(~below)
    if not len(reached):
        return None
    index = int(reached[0])
    return float(shares[max(index - 1, 0)]), float(shares[index])


def extended(values: FloatArray, shares: FloatArray, model: FloatArray, real: FloatArray) -> FloatArray:
    """Return the smallest share above 1 at which the model has the real drift, by linear interpolation, for curves
    whose model drifts less at 1; the largest share where there is none. `model` has shape (curves, beyond).
    """
    below = is_below(model, np.broadcast_to(real[:, None], model.shape))
    found = values.copy()
    short = np.flatnonzero(below[:, 0])
    never = below[short].all(axis=1)
    found[short[never]] = shares[-1]
    for curve in short[~never]:
        k = int(np.argmin(below[curve])) - 1
        low, high = model[curve, k] - real[curve], model[curve, k + 1] - real[curve]
        weight = -low / (high - low) if np.isfinite(high) else 0.0
        found[curve] = shares[k] + weight * (shares[k + 1] - shares[k])
    return found
