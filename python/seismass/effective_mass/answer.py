"""The effective fraction of a building's live load: for a given building, and for a rule that designs it.

Definition: the smallest share of the live load which, attached as mass to the building with its stiffness, strength,
damping matrix and gravity load unchanged, gives a mean over the motions of the largest storey drift not below that of
the building with sliding goods, there and at every larger share up to 1. Goods on racks, or that press on stops, may
load the building more than all of them attached: then the smallest share above 1 that gives the drift.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from numpy.typing import ArrayLike

from seismass.effective_mass.curve import Statistic
from seismass.effective_mass.models import SAME_DAMPING, ModelDamping, check_any_load
from seismass.effective_mass.plane_runs import LARGER, DriftMeasure
from seismass.effective_mass.result import EffectiveMass
from seismass.effective_mass.runs import Progress, named_motions
from seismass.effective_mass.search import OWNER, checked_options
from seismass.effective_mass.solved import solved_designs, solved_frictions
from seismass.model.block import Block
from seismass.model.building import Building
from seismass.model.motion import MotionLike
from seismass.model.rack import Rack
from seismass.model.scene import Scene
from seismass.model.sliding_base import SlidingBase
from seismass.runs.batch import MotionsLike


def effective_mass(
    scene: Scene,
    motions: MotionsLike,
    *,
    statistic: Statistic = "mean",
    drift: DriftMeasure = LARGER,
    damping: ModelDamping = SAME_DAMPING,
    fractions: ArrayLike | None = None,
    confidence: float = 0.90,
    resamples: int = 2000,
    seed: int = 0,
    threads: int | None = None,
    progress: Progress | None = None,
) -> EffectiveMass:
    """Return the share of a building's live load that acts as mass under a suite of motions.

    Parameters
    ----------
    scene : Scene
        The building with its goods as blocks, on floors and on racks; walls, stops and a base are those of the real
        building.
    motions : Motion, Record, Pair or iterable of them
        The suite, scaled as it is to act; a `Suite` is one. Records of one event are resampled together. A scene in two
        directions takes pairs.
    statistic : {"mean", "median"}
        What is taken of the largest drifts over the motions. With the median a collapsed run counts as infinite drift;
        with the mean one collapse of the real building leaves no value.
    drift : {"larger", "vector", "x", "y"}
        Of scenes in two directions, what is compared: the larger of a storey's peak drifts in x and in y; the peak
        length of its drift vector; the peak in one direction.
    damping : {"same", "ratio"}
        Damping of the models, see `attached_scene`.
    fractions : array_like, optional
        Shares at which models are solved before roots are refined, from 0 to 1; by default 0, 0.01, ..., 1, of
        vectors 0, 0.05, ..., 1.
    confidence : float, default 0.90
        Probability of the bootstrap interval.
    resamples : int, default 2000
        Bootstrap resamples; they need no runs.
    seed : int, default 0
        Seed of the resamples.
    threads : int, optional
        Number of threads; default all cores. The result does not depend on it.
    progress : callable, optional
        Called with (runs done, runs in all) while the models are solved.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption
        An argument is not what it must be, or the building has no goods on its floors.
    SimulationError
        A run could not be carried to its end.
    KeyboardInterrupt
        Ctrl-C was pressed.

    Notes
    -----
    Largest storey drift: drift ratio where the building has heights, else drift. Model and real building are solved
    exactly at every share of the grid; each sign change is refined on the exact model. A drift falls with added mass
    where the longer period meets a valley of the spectra, so that there may be several roots: the largest counts.

    With racks the live load is all goods, those on racks too, fixed or not; the frames of the racks are attached to
    their floors in every model. Where there are racks or stops and the model drifts less even with all goods attached,
    models go on to share 2, and the first that reaches the real drift counts (`kind` "beyond"): a rack whose period is
    near that of the building passes on more than the inertia of its goods. The rule by period in `estimate` is of goods
    on the floors of shear buildings, and a remark says so.

    In two directions the real building has friction on the circle, and models have the same share attached in both.
    Nothing couples the directions of a model, so that each is solved by itself; for the vector, as a run in two
    directions. The rule takes all components of the motions, the building in x, or in y where `drift` is that, and 0.8
    times mu_k (docs/two_directions.md).

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(3, 0.47, yield_shear_over_weight=[0.34, 0.27, 0.13])
    >>> scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2))
    >>> result = sm.effective_mass(scene, [record.scaled(2.0) for record in sm.builtin_suite("seven")])
    >>> result.kind
    'root'
    """
    checked = check_any_load(scene)
    named = named_motions(motions, OWNER, checked)
    options = checked_options(statistic, damping, fractions, confidence, resamples, seed, threads, progress, drift)
    return solved_frictions([checked], named, options)[0].answer()


def effective_mass_of_design(
    design: Callable[[float], Building],
    blocks: Iterable[Block],
    motions: MotionLike | Iterable[MotionLike],
    *,
    racks: Iterable[Rack] = (),
    base: SlidingBase | None = None,
    statistic: Statistic = "mean",
    damping: ModelDamping = SAME_DAMPING,
    fractions: ArrayLike | None = None,
    confidence: float = 0.90,
    resamples: int = 2000,
    seed: int = 0,
    threads: int | None = None,
    progress: Progress | None = None,
) -> EffectiveMass:
    """Return the share that a code would have to prescribe, where it sets the strength of the building too.

    The consistent share solves real(V_y(share)) = model(share, V_y(share)): `design` is asked for the building at every
    share, which is solved with sliding goods and with that share attached.

    Parameters
    ----------
    design : callable
        Takes a share from 0 to 1, returns the Building designed with it; floor masses without goods.
    blocks : iterable of Block
        The goods, the same for every design.
    racks : iterable of Rack
        Racks with goods, the same for every design; shares above 1 are not sought.
    base : SlidingBase, optional
        Base that slides under every design.
    motions, statistic, damping, fractions, confidence, resamples, seed, threads, progress
        As for `effective_mass`.

    Returns
    -------
    EffectiveMass
        With the drifts of the real building in `curve` changing with the share. `kind` "stuck": no goods slide in the
        building designed with share 1.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption, SimulationError, KeyboardInterrupt
        As for `effective_mass`.

    Examples
    --------
    >>> import seismass as sm
    >>> def design(share):
    ...     strength = [0.2 + 0.13 * share, 0.16 + 0.11 * share, 0.1 + 0.04 * share]
    ...     return sm.Building.uniform(3, 0.47, yield_shear_over_weight=strength)
    >>> goods = sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2)
    >>> suite = [record.scaled(2.0) for record in sm.builtin_suite()]
    >>> 0.0 <= sm.effective_mass_of_design(design, goods, suite).value <= 1.0
    True
    """
    named = named_motions(motions, OWNER)
    options = checked_options(statistic, damping, fractions, confidence, resamples, seed, threads, progress)
    return solved_designs(design, blocks, named, options, racks, base=base).answer()
