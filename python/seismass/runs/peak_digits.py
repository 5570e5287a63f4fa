"""How many digits of a run's peaks stand: a second run, of ground motion that is changed in its last digit."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import polars as pl

from seismass.base.errors import InvalidOption
from seismass.base.values import as_count, as_list, as_one_of
from seismass.model.scene import Scene
from seismass.motions.motion import Motion, MotionLike
from seismass.runs.peaks import named_motions
from seismass.runs.plane import MotionPair, PlaneResponse
from seismass.runs.response import Response
from seismass.runs.simulate import simulate

OWNER: Final = "digits"
PEAKS: Final = ("peak_drift", "peak_slip", "peak_floor_acceleration", "peak_storey_shear")
MOST: Final = 15
"""Digits of a double."""
FEW: Final = 6
"""Fewer digits are remarked on."""
TRIED: Final = 3
"""Motions of a suite under which a scene is solved twice."""


def digits(response: Response | PlaneResponse, *, seed: int = 0) -> int:
    """Return how many leading digits of the peaks stand when the ground motion changes in its last digit.

    Runs with blocks between stops can be chaotic: a difference of rounding grows until the peaks are others. The scene
    is solved once more, with every sample of the ground acceleration moved to a neighbouring double, up or down at
    random; that costs as much as the run. Digits are those of the largest difference of storey drifts, slips, floor
    accelerations and storey shears, each relative to the largest of its quantity.

    Parameters
    ----------
    response : Response or PlaneResponse
        A run.
    seed : int, default 0
        Of the directions.

    Returns
    -------
    int
        From 0 (another end, or peaks that share no digit) to 15.

    Raises
    ------
    InvalidOption
        `response` is no response.
    SimulationError
        The second run could not be carried to its end.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(2, 0.4, yield_shear_over_weight=[0.3, 0.2])
    >>> scene = sm.Scene(building, sm.blocks_on_floors([0.5, 0.0], 0.2))
    >>> sm.runs.digits(sm.simulate(scene, sm.builtin_record("synthetic-1"))) >= 12
    True
    """
    as_one_of(response, (Response, PlaneResponse), "response", OWNER, InvalidOption)
    generator = np.random.default_rng(as_count(seed, "seed", OWNER, InvalidOption))
    if isinstance(response, PlaneResponse):
        first, second = (_neighbour(motion, generator) for motion in response.motions)
        other: Any = simulate(response.scene, (first, second), events=False)
    else:
        other = simulate(response.scene, _neighbour(response.motion, generator), events=False)
    if other.status != response.status:
        return 0
    return min(_alike(getattr(response, name), getattr(other, name)) for name in PEAKS)


def digits_of_batch(
    scenes: Any, motions: Sequence[MotionLike | MotionPair], *, every: int = 100, seed: int = 0
) -> pl.DataFrame:
    """Return the digits that stand of one run in so many of a batch, see `digits`.

    Parameters
    ----------
    scenes, motions
        As for `simulate_many`: lists, or a grid or a `SceneProduct` of scenes.
    every : int, default 100
        One run in so many is solved twice, from the first on.
    seed : int, default 0
        As for `digits`.

    Returns
    -------
    polars.DataFrame
        Columns scene, motion (from 1) and digits. Scenes with fewer than 6 are chaotic: their peaks are one of many.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption, SimulationError
        As for `simulate`.
    """
    step = as_count(every, "every", OWNER, InvalidOption, least=1)
    listed = as_list(motions, "motions", OWNER, InvalidOption, "a list of motions")
    grid = scenes if hasattr(scenes, "scene") else None
    of_batch = scenes if grid else as_list(scenes, "scenes", OWNER, InvalidOption, "a list of scenes, or a grid")
    rows = []
    for number in range(0, len(of_batch) * len(listed), step):
        scene, motion = divmod(number, len(listed))
        solved = grid.scene(scene + 1) if grid else of_batch[scene]
        response = simulate(as_one_of(solved, Scene, "scenes", OWNER, InvalidOption), listed[motion], events=False)
        rows.append((scene + 1, motion + 1, digits(response, seed=seed)))
    return pl.DataFrame(rows, schema={"scene": pl.UInt64, "motion": pl.UInt32, "digits": pl.UInt8}, orient="row")


def digits_remarks(response: Response | PlaneResponse) -> tuple[str, ...]:
    """Return the remark on a run of which few digits stand."""
    number = digits(response)
    if number >= FEW:
        return ()
    return (
        f"this run is chaotic: {number or 'no'} digits of its peaks stand when the ground motion changes in its last "
        "digit; take such peaks over many motions",
    )


def chaos_remarks(scenes: Sequence[Scene], motions: Sequence[Any]) -> tuple[str, ...]:
    """Return the remark on scenes of which few digits stand under some of three motions spread over a suite."""
    of_runs = named_motions(motions, OWNER, scenes[0]).of_runs[:: -(-len(motions) // TRIED)]
    runs = digits_of_batch(scenes, of_runs, every=1)
    chaotic = runs.filter(pl.col("digits") < FEW)
    if chaotic.is_empty():
        return ()
    return (
        f"runs with goods that slide are chaotic: of {runs.height} that were solved twice, {chaotic.height} keep "
        f"fewer than {FEW} digits of their peaks when the ground motion changes in its last digit; such peaks are "
        "examples, and quantiles of few motions move with them",
    )


def _neighbour(motion: Motion, generator: np.random.Generator) -> Motion:
    """Return the motion with each sample moved to a neighbouring double; zeros stay."""
    ground = motion.acceleration
    moved = np.nextafter(ground, np.where(generator.random(len(ground)) < 0.5, np.inf, -np.inf))
    return motion.replace(acceleration=np.where(ground == 0.0, 0.0, moved))


def _alike(one: Any, other: Any) -> int:
    """Digits of the largest difference of two arrays, relative to the largest value."""
    largest = float(np.max(np.abs(one), initial=0.0))
    difference = float(np.max(np.abs(one - other), initial=0.0))
    if difference <= 10.0**-MOST * largest:
        return MOST
    return max(0, int(-np.log10(difference / largest)) if largest > 0.0 else 0)
