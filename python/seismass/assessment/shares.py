"""The shares of an assessment: effective fractions at each friction, and that of a design of the strengths."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from seismass.assessment.answer import DesignShare, deciding, rounded_up
from seismass.assessment.own_building import OwnBuilding
from seismass.assessment.tables import few_collapses
from seismass.base.values import FloatArray
from seismass.effective_mass import EffectiveMass
from seismass.effective_mass.models import SAME_DAMPING
from seismass.effective_mass.runs import named_motions
from seismass.effective_mass.search import OWNER, checked_options
from seismass.effective_mass.solved import Designed, solved_designs, solved_frictions
from seismass.spectra import TargetSpectrum

DESIGN_SHARES: Final = np.linspace(0.0, 1.0, 21)
"""Shares at which that of a design of strengths is looked for before its root is refined; each takes two models."""
DESIGN_SHARES_IN_PLANE: Final = np.linspace(0.0, 1.0, 6)
"""The same in two directions, where a building with goods that slide takes a hundred times as long."""
SHARES: Final = 101
"""Shares at which each effective fraction is looked for; the models of all frictions are the same."""

Progress = Callable[[int, int], object]


def fractions_by_friction(
    building: OwnBuilding,
    target: TargetSpectrum | None,
    frictions: dict[str, float],
    motions: list[Any],
    bootstrap: dict[str, Any],
    threads: int | None,
    progress: Progress | None,
) -> dict[str, EffectiveMass]:
    """Return the effective fraction at each friction (a factor for each model) by the mean; by the median, where the
    building collapses.
    """
    if not frictions:
        return {}
    scenes = [building.scene(target, mu_factor=factor) for factor in frictions.values()]
    drawn = (bootstrap["confidence"], bootstrap["resamples"], bootstrap["seed"])
    options = checked_options("mean", SAME_DAMPING, None, *drawn, threads, progress)
    found = {}
    named = named_motions(motions, OWNER, scenes[0])
    for name, solved in zip(frictions, solved_frictions(scenes, named, options), strict=True):
        found[name] = solved.answer("median" if solved.real.collapsed.any() else "mean")
    return found


def advised_share(effective: dict[str, EffectiveMass]) -> float | None:
    """Return the largest effective fraction, rounded up to 0.05; None without goods, or where many runs collapse."""
    many = (not few_collapses(each.collapses["real"], each.records.height) for each in effective.values())
    if not effective or any(many):
        return None
    return rounded_up(effective[deciding(effective)].value)


def design_shares(building: OwnBuilding) -> FloatArray:
    """Return the shares at which that of a design of strengths is looked for."""
    return DESIGN_SHARES if building.other is None else DESIGN_SHARES_IN_PLANE


def design_share(
    building: OwnBuilding,
    target: TargetSpectrum | None,
    factor: float,
    motions: list[Any],
    threads: int | None,
    progress: Progress | None,
) -> DesignShare:
    """Return the share that goes into the design of the strengths and is attached, at one factor of friction, without a
    bootstrap.
    """

    def designed(share: float) -> Designed:
        attached, other = share * building.goods, building.other
        in_x = building.structure(target, attached)
        return in_x if other is None else (in_x, other.structure(target, attached))

    scene = building.scene(target, mu_factor=factor)
    shares = design_shares(building)
    options = checked_options("mean", SAME_DAMPING, shares, 0.9, 1, 0, threads, progress)
    named = named_motions(motions, OWNER, scene)
    solved = solved_designs(designed, scene.blocks, named, options, scene.racks, scene.collapse_drift, scene.base)
    fallen = solved.real.collapsed.sum(axis=1)
    if not few_collapses(int(fallen.max()), len(motions)):
        return DesignShare(None, _collapsing(shares, fallen, len(motions)))
    return DesignShare(solved.answer("median" if fallen.any() else "mean"), "")


def _collapsing(shares: FloatArray, fallen: NDArray[np.int64], motions: int) -> str:
    """Which designs collapse under how many motions."""
    many = shares[[not few_collapses(int(count), motions) for count in fallen]]
    of = f"{many[0]:.2f}" if len(many) == 1 else f"{many[0]:.2f} to {many[-1]:.2f}"
    whole = "every share" if len(many) == len(shares) else f"shares of {of} of the goods present"
    return f"the building designed with {whole} collapses under up to {int(fallen.max())} of {motions} motions"
