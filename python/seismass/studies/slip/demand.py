"""How far goods slide in a building, beside the same goods on the ground and published estimates."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any, ClassVar, Final

import polars as pl

from seismass.base.arguments import Progress, ProgressLike, as_bootstrap
from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.stored_results import metadata_head, motion_contents
from seismass.base.values import FieldValue, as_flag, brief, refusal
from seismass.effective_mass.models import SAME_DAMPING, ModelDamping, check_damping
from seismass.media.result import Result, finite_values
from seismass.model.scene import Scene
from seismass.model.tipping import BlockSize, as_sizes
from seismass.motions.motion import HasMotion, Motion
from seismass.motions.records.pair import Pair
from seismass.runs.batch import MotionsLike
from seismass.runs.peaks import named_motions
from seismass.studies.fragility.analysis import incremental_dynamic_analysis
from seismass.studies.fragility.fragility import Fragility
from seismass.studies.fragility.hunt import HuntAndFill
from seismass.studies.fragility.limits import IntensityMeasure, LimitState, MeasureName, measure_for
from seismass.studies.fragility.run import SLIDING
from seismass.studies.slip.clearance import Clearance, as_clearances, exceedance_table
from seismass.studies.slip.runs import SlipModels, SlipRuns, solve_motion
from seismass.studies.slip.tables import (
    block_table,
    demand_remarks,
    estimate_summary,
    estimate_table,
    run_table,
    squat_table,
)

TOLERANCE: Final = 1e-3
"""Relative width to which the intensity is located at which a block reaches its clearance."""


def slip_fragilities(
    scene: Scene,
    motions: Any,
    clearances: tuple[Clearance | None, ...],
    measure: IntensityMeasure,
    *,
    confidence: float,
    resamples: int,
    seed: int,
    threads: int | None,
) -> tuple[dict[int, Fragility], tuple[str, ...]]:
    """Return the fragility of each block with a clearance, by its number, and remarks of the analysis. The limit of the
    largest absolute slip is the smaller clearance, as if both sides had it.
    """
    limits = {
        number: LimitState("slip", each.smallest, block=number)
        for number, each in enumerate(clearances, start=1)
        if each is not None
    }
    analysis = incremental_dynamic_analysis(
        {SLIDING: scene},
        motions,
        list(limits.values()),
        measure=measure,
        hunt=HuntAndFill(tolerance=TOLERANCE),
        confidence=confidence,
        resamples=resamples,
        seed=seed,
        threads=threads,
    )
    return {number: analysis.fragility(limit, SLIDING) for number, limit in limits.items()}, analysis.remarks


SCHEMA_VERSION: Final = 2
"""Version of the tables and of the JSON of a slip demand."""


@dataclass(frozen=True, eq=False)
class SlipDemand(FieldValue, Result):
    """Slip of the goods of a scene over a suite of motions.

    Lengths are in m, accelerations in g where the name says so. Slip is relative to the block's own floor; peaks are
    of its absolute value and exact in continuous time. In a run that collapsed it counts as infinite in all
    statistics.

    Attributes
    ----------
    blocks : polars.DataFrame
        One row per block. block, floor, mu_s, mu_k; of the peak slip over the motions `mean`, `p16`, `median`, `p84`,
        `largest`, and `slides`, the share of motions under which it slides; `residual_...` of the absolute slip at the
        end; `path_mean`; `ground_...` of the same block on the ground. `amplification`: mean slip over mean slip on the
        ground, with its bootstrap interval `amplification_low` and `amplification_high` (both drawn together);
        `amplification_p16`, `_median`, `_p84` of the ratio motion by motion, where the block slides on the ground;
        `slides_on_floor_only`: motions under which it slides in the building alone. `floor_acceleration_g`: mean peak
        acceleration of its floor while goods slide; `alone_acceleration_g` without goods, `attached_acceleration_g`
        with all of them attached; `mu_over_attached`: mean of mu_s g over the latter, below 1 where it slides. With
        racks `rack` and `level` follow `floor`, 0 where the block stands on the floor itself, and "floor" is the level
        in the names of what follows. With stops: `touches`, the share of motions under which it meets one, and of the
        velocity at contact (m/s) and of the contact force (N) `..._p84` and `..._largest`. In two directions slips are
        lengths of vectors; `x_mean`, `x_largest`, `y_mean`, `y_largest` are of the peaks in each; `one_direction_mean`
        of the peaks of each direction under its motion alone, `over_one_direction` the peaks in each over these (sums
        over motions and directions), `length_over_one_direction` the lengths over their mean.
    runs : polars.DataFrame
        One row per motion and block: motion, record, event, block, floor, collapsed, peak_slip, slip_plus, slip_minus
        (to each side; see `seismass.slip.signed_peaks`), residual_slip (signed), slip_path, moving_at_end, ground_slip,
        ground_residual, amplification, floor_acceleration_g, alone_acceleration_g, attached_acceleration_g,
        mu_over_attached, floor_velocity (m/s), acceleration_over_weight (largest abs(a)/(g + a_v)), uplift and
        overturning_limits_exceeded (null without a size), and with stops contact_velocity (m/s) and contact_force (N).
        In two directions slip_plus and slip_minus are sides of x; besides peak_slip_x, residual_slip_x,
        one_direction_x, these in y, slip_plus_y and slip_minus_y.
    exceedance : polars.DataFrame
        Probability of reaching the clearances at the given intensity; see `seismass.slip.exceedance_table`.
    squat : polars.DataFrame
        One row per block with a size: block, floor, mu_s (the largest), width, height, centre_height, uplift_g,
        rocks_first, motions, uplift (motions under which it would lift off), acceleration_over_weight (mean),
        overturning_velocity (m/s) and overturning_limits_exceeded (motions); see `seismass.slip.BlockSize`.
    estimates : polars.DataFrame
        One row per block, base ("ground", "floor") and estimate: motions, slide (motions under which the block slides),
        compared (those in which estimate and exact slip are positive), mean, exact_mean, ratio (geometric mean of
        estimate over exact), log_scatter, below (share of the sliding cases that the estimate falls short of). On the
        floor, exact is the slip in the building.
    estimate_runs : polars.DataFrame
        motion, record, block, floor, base, estimate, slip, exact.
    fragilities : dict of int to Fragility
        Probability of reaching the smaller clearance by intensity, by the number of the block; empty unless asked for.
    confidence : float
        Probability that intervals are made for.
    remarks : tuple of str
        Assumptions, and what a user must know beside the numbers.
    metadata : dict
        Versions, digest of the inputs, seed, conventions, counts.
    """

    document: ClassVar[str] = "slip_demand"

    blocks: pl.DataFrame = field(repr=False)
    runs: pl.DataFrame = field(repr=False)
    exceedance: pl.DataFrame = field(repr=False)
    squat: pl.DataFrame = field(repr=False)
    estimates: pl.DataFrame = field(repr=False)
    estimate_runs: pl.DataFrame = field(repr=False)
    fragilities: dict[int, Fragility] = field(repr=False)
    confidence: float
    remarks: tuple[str, ...] = field(repr=False)
    metadata: dict[str, Any] = field(repr=False)

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name; those without rows are left out."""
        every = {
            "slip_blocks": self.blocks,
            "slip_runs": self.runs,
            "slip_exceedance": self.exceedance,
            "slip_squat": self.squat,
            "slip_estimates": self.estimates,
            "slip_estimate_runs": self.estimate_runs,
        }
        return {name: table for name, table in every.items() if table.height}

    def to_dict(self) -> dict[str, Any]:
        """Return everything but the rows of single runs as plain values; null for non-finite values."""
        document = {
            "schema_version": SCHEMA_VERSION,
            "blocks": self.blocks.to_dicts(),
            "exceedance": self.exceedance.to_dicts(),
            "squat": self.squat.to_dicts(),
            "estimates": self.estimates.to_dicts(),
            "fragilities": {str(block): fit.to_dict() for block, fit in self.fragilities.items()},
            "confidence": self.confidence,
            "remarks": self.remarks,
            "metadata": self.metadata,
        }
        return finite_values(document)

    @property
    def figure_names(self) -> tuple[str, ...]:
        """slip_demand: slip of every block and motion in the building, on the ground, and its limits."""
        return ("slip_demand",)


OWNER: Final = "slip demand"


def slip_demand(
    scene: Scene,
    motions: MotionsLike,
    *,
    sizes: BlockSize | Iterable[BlockSize | None] | None = None,
    clearance: float | Clearance | Iterable[float | Clearance | None] | None = None,
    fragility: bool = False,
    measure: MeasureName | IntensityMeasure = "sa_t1",
    period: float | None = None,
    damping: ModelDamping = SAME_DAMPING,
    confidence: float = 0.90,
    resamples: int = 2000,
    seed: int = 0,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> SlipDemand:
    """Return how far the goods of a scene slide, beside the same goods on the ground and published estimates.

    Parameters
    ----------
    scene : Scene
        Building and goods; goods on the ground slab, or without any building, are allowed, and those on racks.
    motions : Motion, Record, Pair or iterable of them
        The suite, scaled as it is to act. Records of one event are resampled together. A scene in two directions takes
        pairs.
    sizes : BlockSize, or list with one per block or None, optional
        Widths and heights, for the check whether a block slides or rocks. One size is that of all blocks.
    clearance : float, Clearance, or list with one per block or None, optional
        How far each block may slide (m); a number counts on both sides, in two directions on all four. A Clearance may
        have a `reach` in any direction.
    fragility : bool, default False
        Also scale every motion until each block reaches its clearance, and fit the probability by intensity. Needs a
        clearance.
    measure, period
        Intensity measure of fragilities, as for `seismass.fragility.measure_for`: by default Sa (g) at the first period
        of the building without goods.
    damping : {"same", "ratio"}, default "same"
        Damping of the models of the building alone and with all goods attached, see `attached_scene`; "same" with racks
        and on a sliding base.
    confidence : float, default 0.90
        Probability of intervals.
    resamples, seed : int, optional
        Bootstrap resamples over the motions, and their seed.
    threads : int, optional
        Number of threads of the runs for fragilities; default all cores. The result does not depend on it.
    progress : callable, optional
        Called with (motions done, motions in all).

    Returns
    -------
    SlipDemand
        Statistics by block, and one row per motion and block.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption
        An argument is not what it must be, or the scene has no block.
    SimulationError
        A run could not be carried to its end.

    Notes
    -----
    On the ground: each block alone, with its friction, from rest, under the same motion, solved exactly. The building
    alone has the mass of the floors, and all goods attached their whole mass too; both keep stiffness, strength and
    P/h. No goods slide if and only if mu_s g is not below the peak floor acceleration of the building with all goods
    attached (without vertical motion), so that this one is set beside mu_s.

    The published estimates use peaks or the spectrum of the ground motion, and of the motion of the floor of the
    building alone, as where the building is analysed first and the goods afterwards. "rigid_block" is
    the exact slip on that motion: on the ground it is the ground slip itself; on the floor it differs from the slip in
    the building by what the goods do to the building.

    With racks, what goods stand on is the level of their rack: its acceleration is set beside mu_s, and the building
    alone and with all goods attached have the racks in them, empty or with the goods fixed to their levels. Stops act
    in the building; on the ground and in the estimates the goods are free. Fragilities are of scenes without racks,
    walls, stops and a sliding base.

    On a sliding base floor 0 is its slab. The building alone and with all goods attached, those on the slab too, stand
    on a base of the same friction coefficients under their own weight.

    In two directions friction is of the circle. Slips, accelerations and velocities are lengths of vectors; the tables
    have slips by direction and side too, and those of each direction under its own motion alone, which an analysis of
    one direction gives. The published estimates are of one direction and left out, as are fragilities.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(3, 0.47, yield_shear_over_weight=[0.34, 0.27, 0.13])
    >>> scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0, 0.0], mu=0.2))
    >>> result = sm.slip.slip_demand(scene, [record.scaled(2.0) for record in sm.builtin_suite("seven")], clearance=0.1)
    >>> result.blocks.select("block", "floor", "slides").rows()
    [(1, 1, 1.0), (2, 2, 1.0)]
    """
    if not isinstance(scene, Scene):
        raise refusal(InvalidScene, "scene", OWNER, "a Scene", brief(scene))
    if not scene.goods:
        raise refusal(InvalidScene, "blocks", OWNER, "at least one", "none")
    listed: Any = motions
    if not isinstance(motions, Motion | HasMotion | Pair) and isinstance(motions, Iterator):
        listed = list(motions)
    named = named_motions(listed, OWNER, scene)
    count, in_plane = len(scene.goods), scene.other_direction is not False
    measured, limits = as_sizes(sizes, count), as_clearances(clearance, count, plane=in_plane)
    probability, draws, start = as_bootstrap(confidence, resamples, seed, OWNER)
    whole, fragility = Progress(progress, len(named), OWNER), as_flag(fragility, "fragility", OWNER, InvalidOption)
    if fragility and not any(limits):
        raise refusal(InvalidOption, "clearance", OWNER, "given for a fragility", "None")
    if check_damping(damping, OWNER) != SAME_DAMPING and (scene.racks or scene.base is not None):
        raise refusal(InvalidOption, "damping", OWNER, f"{SAME_DAMPING!r} with racks or a sliding base", brief(damping))
    models = SlipModels.of(scene, damping)
    solved = []
    if fragility:
        scene.require_chain("slip_demand with a fragility")
    others: list[Any] = [None] * len(named) if named.others is None else list(named.others)
    for motion, other in zip(named.motions, others, strict=True):
        solved.append(solve_motion(models, motion, other))
        whole.tell()
    runs = SlipRuns.of(solved)
    settings: dict[str, Any] = {
        "damping": damping,
        "confidence": probability,
        "resamples": draws,
        "seed": start,
        "sizes": [None if size is None else [size.width, size.height, size.centre_height] for size in measured],
        "clearances": [None if each is None else each.distances[: 5 if in_plane else 2] for each in limits],
    }
    if scene.base is not None:
        settings["floor_0"] = "slab"
    fragilities: dict[int, Fragility] = {}
    of_fragilities: tuple[str, ...] = ()
    if fragility:
        measure_used = measure_for(measure, scene, period)
        settings["measure"] = measure_used.to_dict()
        fragilities, of_fragilities = slip_fragilities(
            scene,
            listed,
            limits,
            measure_used,
            confidence=probability,
            resamples=draws,
            seed=start,
            threads=threads,
        )
    by_run = run_table(scene, named, runs, measured)
    squat = squat_table(scene, by_run, measured)
    compared = estimate_table(named, solved, scene)
    plus, minus = runs.or_infinite(runs.plus), runs.or_infinite(runs.minus)
    of_y = None
    if runs.plane is not None:
        sides = (runs.plane.plus[:, :, 1], runs.plane.minus[:, :, 1], runs.peak)
        in_y, against_y, length = (runs.or_infinite(values) for values in sides)
        of_y = (in_y, against_y, length)
    return SlipDemand(
        blocks=block_table(scene, named, runs, probability, draws, start),
        runs=by_run,
        exceedance=exceedance_table(plus, minus, limits, probability, of_y),
        squat=squat,
        estimates=estimate_summary(compared),
        estimate_runs=compared,
        fragilities=fragilities,
        confidence=probability,
        remarks=(*demand_remarks(scene, named, runs, squat, limits, bool(fragilities)), *of_fragilities),
        metadata={
            **metadata_head(SCHEMA_VERSION, scene, motion_contents(named.components), settings),
            "motions": len(named),
            "clusters": named.clusters,
            **settings,
        },
    )
