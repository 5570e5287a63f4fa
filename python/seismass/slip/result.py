"""What `slip_demand` gives back: slip by block with its scatter, beside the ground, estimates, clearances and size."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Final

import polars as pl

from seismass.base.values import content_hash, same_content
from seismass.base.views import view
from seismass.fragility.fragility import Fragility
from seismass.media.result import Result, finite_values

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SCHEMA_VERSION: Final = 2
"""Version of the tables and of the JSON of a slip demand."""


@dataclass(frozen=True, eq=False)
class SlipDemand(Result):
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

    __eq__ = same_content
    __hash__ = content_hash

    @property
    @view
    def text(self) -> str:
        """The result as lines: slip and its scatter, the ground, clearances, size, estimates, remarks."""
        raise NotImplementedError

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
        """Return everything but the rows of single runs as plain values; null for what is not finite."""
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
        finite: dict[str, Any] = finite_values(document)
        return finite

    @property
    def figure_names(self) -> tuple[str, ...]:
        """slip_demand: slip of every block and motion in the building, on the ground, and its limits."""
        return ("slip_demand",)

    @view
    def plot(self, name: str | None = None) -> Figure:
        """Return the figure of the slip of every block and motion in the building, on the ground, and its limits.

        Raises
        ------
        InvalidOption
            `name` is given and is not "slip_demand".
        """
        raise NotImplementedError
