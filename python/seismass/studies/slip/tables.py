"""Tables and remarks of a slip demand, from the runs under all motions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import polars as pl
from numpy.typing import NDArray

from seismass.base.statistics import QUANTILES, bootstrap_counts, interval_of, quantile
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, counted
from seismass.effective_mass.rule import one_direction_of_slip
from seismass.model.plausibility import usage_remarks
from seismass.model.scene import Scene
from seismass.model.tipping import BlockSize
from seismass.runs.peaks import NamedMotions
from seismass.studies.slip.clearance import Clearance, place_columns, place_names, places_of
from seismass.studies.slip.runs import SlipRuns, log_ratio


def block_table(
    scene: Scene, motions: NamedMotions, runs: SlipRuns, confidence: float, resamples: int, seed: int
) -> pl.DataFrame:
    """Return one row per block: slips over the motions and on the ground, accelerations; see `SlipDemand.blocks`."""
    slip = runs.or_infinite(runs.peak)
    residual = runs.or_infinite(np.abs(runs.residual))
    weights = bootstrap_counts(motions.cluster_of, resamples, seed)
    rows = []
    places = places_of(scene)
    for number, block in enumerate(scene.goods):
        slips, ground = slip[:, number], runs.ground_peak[:, number]
        pooled, low, high = _pooled_ratio(slips, ground, weights, confidence)
        ratios = amplification(slips, ground)
        both = ratios[np.isfinite(ratios)]
        rows.append(
            {
                "block": number + 1,
                **{name: getattr(places[number], name) for name in place_names(scene)},
                "mu_s": block.mu_s,
                "mu_k": block.mu_k,
                "mean": _mean(slips),
                **_quantiles(slips),
                "largest": float(slips.max()),
                "slides": float((slips > 0.0).mean()),
                "residual_mean": _mean(residual[:, number]),
                **{f"residual_{name}": value for name, value in _quantiles(residual[:, number]).items()},
                "residual_largest": float(residual[:, number].max()),
                "path_mean": _mean(runs.or_infinite(runs.path)[:, number]),
                "ground_mean": _mean(ground),
                **{f"ground_{name}": value for name, value in _quantiles(ground).items()},
                "ground_largest": float(ground.max()),
                "ground_slides": float((ground > 0.0).mean()),
                "amplification": pooled,
                "amplification_low": low,
                "amplification_high": high,
                **{f"amplification_{name}": value for name, value in _quantiles(both).items()},
                "slides_on_floor_only": int(((slips > 0.0) & (ground == 0.0)).sum()),
                **{name: _mean(each[:, number]) / STANDARD_GRAVITY for name, each in _accelerations(runs).items()},
                "mu_over_attached": _mean(block.mu_s * STANDARD_GRAVITY / runs.full_acceleration[:, number]),
                **_contact(scene, runs, number),
                **_in_plane(runs, number),
            }
        )
    kinds = dict.fromkeys(("block", "slides_on_floor_only", *place_names(scene)), pl.UInt32)
    return _frame(rows, kinds)


def _accelerations(runs: SlipRuns) -> dict[str, FloatArray]:
    """Peak accelerations under the blocks (m/s2), by the columns that have them in g."""
    return {
        "floor_acceleration_g": runs.acceleration,
        "alone_acceleration_g": runs.alone_acceleration,
        "attached_acceleration_g": runs.full_acceleration,
    }


def has_stops(scene: Scene) -> bool:
    """Whether tables have the columns of stops: some goods have them."""
    return any(block.stops is not None or block.stops_y is not None for block in scene.goods)


def _contact(scene: Scene, runs: SlipRuns, number: int) -> dict[str, float]:
    """What a block does to its stops over the motions; nothing in a scene without stops."""
    if not has_stops(scene):
        return {}
    velocity, force = runs.contact_velocity[:, number], runs.contact_force[:, number]
    return {
        "touches": float((velocity > 0.0).mean()),
        "contact_velocity_p84": float(quantile(velocity, 0.84)),
        "contact_velocity_largest": float(velocity.max()),
        "contact_force_p84": float(quantile(force, 0.84)),
        "contact_force_largest": float(force.max()),
    }


def _in_plane(runs: SlipRuns, number: int) -> dict[str, float]:
    """Slip of a block by direction, and over that of one direction alone; nothing where there is one."""
    if runs.plane is None:
        return {}
    peaks, alone = (values[:, number] for values in (runs.plane.peak, runs.plane.alone))
    lost = runs.collapsed[:, None]
    valid = ~runs.collapsed
    pooled = float(alone[valid].sum())
    by_axis: dict[str, float] = {}
    for axis, values in zip("xy", np.where(lost, np.inf, peaks).T, strict=True):
        by_axis |= {f"{axis}_mean": _mean(values), f"{axis}_largest": float(values.max())}
    return {
        **by_axis,
        "one_direction_mean": _mean(alone[valid].ravel()),
        "over_one_direction": float(peaks[valid].sum()) / pooled if pooled > 0.0 else np.nan,
        "length_over_one_direction": 2.0 * float(runs.peak[valid, number].sum()) / pooled if pooled > 0.0 else np.nan,
    }


def amplification(floor: FloatArray, ground: FloatArray) -> FloatArray:
    """Return slip in the building over slip on the ground: infinite where the ground has none, NaN without either."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(floor / ground, dtype=np.float64)


def run_table(scene: Scene, motions: NamedMotions, runs: SlipRuns, sizes: tuple[BlockSize | None, ...]) -> pl.DataFrame:
    """Return one row per motion and block; see `SlipDemand.runs`."""
    count, blocks = len(motions), len(scene.goods)
    sliding = np.array([block.mu_s for block in scene.goods])
    uplift = np.array([np.nan if size is None else size.uplift_g for size in sizes])
    velocity = np.array(
        [np.nan if size is None or size.overturning_velocity is None else size.overturning_velocity for size in sizes]
    )
    rocks = (sliding > uplift) & (runs.demand > uplift)
    reached = rocks & (runs.velocity > velocity)
    columns: dict[str, Any] = {
        "motion": np.repeat(np.arange(1, count + 1, dtype=np.uint32), blocks),
        "record": [name for name in motions.names for _ in range(blocks)],
        "event": [event or None for event in motions.events for _ in range(blocks)],
        "block": np.tile(np.arange(1, blocks + 1, dtype=np.uint32), count),
        **place_columns(scene, count),
        "collapsed": np.repeat(runs.collapsed, blocks),
        "peak_slip": runs.peak.ravel(),
        "slip_plus": runs.plus.ravel(),
        "slip_minus": runs.minus.ravel(),
        "residual_slip": pl.Series(runs.residual.ravel(), nan_to_null=True),
        "slip_path": runs.path.ravel(),
        "moving_at_end": runs.moving.ravel(),
        "ground_slip": runs.ground_peak.ravel(),
        "ground_residual": runs.ground_residual.ravel(),
        "amplification": pl.Series(amplification(runs.peak, runs.ground_peak).ravel(), nan_to_null=True),
    }
    for name, values in _accelerations(runs).items():
        columns[name] = pl.Series(values.ravel() / STANDARD_GRAVITY, nan_to_null=True)
    mu_over_attached = sliding * STANDARD_GRAVITY / runs.full_acceleration
    columns["mu_over_attached"] = pl.Series(mu_over_attached.ravel(), nan_to_null=True)
    columns["floor_velocity"] = runs.velocity.ravel()
    columns["acceleration_over_weight"] = runs.demand.ravel()
    columns["uplift"] = _known(rocks, np.isfinite(uplift))
    columns["overturning_limits_exceeded"] = _known(reached, np.isfinite(velocity))
    if runs.plane is not None:
        for index, axis in enumerate("xy"):
            columns |= {
                f"peak_slip_{axis}": runs.plane.peak[:, :, index].ravel(),
                f"residual_slip_{axis}": pl.Series(runs.plane.residual[:, :, index].ravel(), nan_to_null=True),
                f"one_direction_{axis}": runs.plane.alone[:, :, index].ravel(),
            }
        of_y = (runs.plane.plus[:, :, 1].ravel(), runs.plane.minus[:, :, 1].ravel())
        columns |= dict(zip(("slip_plus_y", "slip_minus_y"), of_y, strict=True))
    if has_stops(scene):
        columns |= {"contact_velocity": runs.contact_velocity.ravel(), "contact_force": runs.contact_force.ravel()}
    return pl.DataFrame(columns, schema_overrides={"event": pl.String})


def _known(values: NDArray[np.bool_], known: NDArray[np.bool_]) -> pl.Series:
    """Values (motions, blocks) as a column, null for blocks of which they are not known."""
    column = [bool(value) if sure else None for row in values for value, sure in zip(row, known, strict=True)]
    return pl.Series(column, dtype=pl.Boolean)


def squat_table(scene: Scene, runs: pl.DataFrame, sizes: tuple[BlockSize | None, ...]) -> pl.DataFrame:
    """Return one row per block with a size: whether it slides or rocks, and under how many motions it would lift off;
    see `SlipDemand.squat`.
    """
    rows = []
    for number, (block, place, size) in enumerate(zip(scene.goods, places_of(scene), sizes, strict=True), start=1):
        if size is None:
            continue
        runs_of_block = runs.filter(block=number)
        static = max([block.mu_s, *(mu_s for _, mu_s, _ in block.wear)])
        limits = runs_of_block["overturning_limits_exceeded"]
        rows.append(
            {
                "block": number,
                "floor": place.floor,
                "mu_s": static,
                "width": size.width,
                "height": size.height,
                "centre_height": size.centre_height,
                "uplift_g": size.uplift_g,
                "rocks_first": size.rocks_first(static),
                "motions": runs_of_block.height,
                "uplift": int(runs_of_block["uplift"].sum()),
                "acceleration_over_weight": _mean(runs_of_block["acceleration_over_weight"].to_numpy()),
                "overturning_velocity": size.overturning_velocity,
                "overturning_limits_exceeded": None if limits.null_count() else int(limits.sum()),
            }
        )
    kinds = {
        "block": pl.UInt32,
        "floor": pl.UInt32,
        "mu_s": pl.Float64,
        "width": pl.Float64,
        "height": pl.Float64,
        "centre_height": pl.Float64,
        "uplift_g": pl.Float64,
        "rocks_first": pl.Boolean,
        "motions": pl.UInt32,
        "uplift": pl.UInt32,
        "acceleration_over_weight": pl.Float64,
        "overturning_velocity": pl.Float64,
        "overturning_limits_exceeded": pl.UInt32,
    }
    return pl.DataFrame(rows, schema=kinds)


def estimate_table(motions: NamedMotions, solved: Iterable[SlipRuns], scene: Scene) -> pl.DataFrame:
    """Return one row per motion, block, base and estimate; see `SlipDemand.estimate_runs`."""
    rows = []
    places = places_of(scene)
    for number, each in enumerate(solved):
        for row in each.estimates:
            exact = each.ground_peak if row.base == "ground" else each.peak
            lost = row.base == "floor" and each.collapsed
            for name, value in row.values.items():
                rows.append(
                    {
                        "motion": number + 1,
                        "record": motions.names[number],
                        "block": row.block + 1,
                        **{name: getattr(places[row.block], name) for name in place_names(scene)},
                        "base": row.base,
                        "estimate": name,
                        "slip": value,
                        "exact": None if lost else float(exact[row.block]),
                    }
                )
    kinds: dict[str, Any] = dict.fromkeys(("motion", "block", *place_names(scene)), pl.UInt32)
    return _frame(rows, kinds | {"exact": pl.Float64})


def estimate_summary(table: pl.DataFrame) -> pl.DataFrame:
    """Return one row per block, base and estimate: how it does over the motions; see `SlipDemand.estimates`."""
    rows = []
    keys = [name for name in ("block", "floor", "rack", "level", "base", "estimate") if name in table.columns]
    for key, group in table.group_by(keys, maintain_order=True):
        compared = group.drop_nulls("exact")
        slip, exact = compared["slip"].to_numpy(), compared["exact"].to_numpy()
        ratios = log_ratio(slip, exact)
        slid = exact > 0.0
        rows.append(
            {
                **dict(zip(keys, key, strict=True)),
                "motions": len(exact),
                "slide": int(slid.sum()),
                "compared": len(ratios),
                "mean": _mean(slip),
                "exact_mean": _mean(exact),
                "ratio": float(np.exp(ratios.mean())) if len(ratios) else None,
                "log_scatter": float(ratios.std()) if len(ratios) else None,
                "below": float((slip[slid] < exact[slid]).mean()) if slid.any() else None,
            }
        )
    kinds = {
        "motions": pl.UInt32,
        "slide": pl.UInt32,
        "compared": pl.UInt32,
        "ratio": pl.Float64,
        "log_scatter": pl.Float64,
        "below": pl.Float64,
    }
    return _frame(rows, kinds)


def demand_remarks(
    scene: Scene,
    motions: NamedMotions,
    runs: SlipRuns,
    squat: pl.DataFrame,
    clearances: tuple[Clearance | None, ...],
    fragilities: bool,
) -> tuple[str, ...]:
    """Return assumptions, and what a user must know beside the numbers."""
    sides = (side for each in clearances if each is not None for side in each.distances if side is not None)
    remarks = usage_remarks(scene.remarks, motions.components, (("clearance", side) for side in sides))
    where = "in one direction" if runs.plane is None else "in the plane"
    meeting = f"goods are rigid, slide {where} and meet no obstacle: slip beyond a clearance is notional"
    if has_stops(scene):
        meeting = (
            f"goods are rigid and slide {where}, between their stops where they have them; on the ground and "
            "in estimates they are free; slip beyond a clearance that is no stop is notional"
        )
    remarks.append(meeting)
    if runs.plane is not None:
        remarks.append(
            "slips, accelerations and velocities are lengths of vectors, + and - of clearances are sides of x; "
            "published estimates, which are of one direction, are left out"
        )
    elif (runs.peak > 0.0).any():
        remarks.append(one_direction_of_slip())
    if scene.racks:
        remarks.append(
            "goods on racks slide on their level, whose acceleration is set beside their friction; racks do not "
            "uplift, and goods do not fall"
        )
    if scene.base is not None:
        remarks.append(
            "floor 0 is the slab of the sliding base; the building alone and with all goods attached stand on a base "
            "of the same friction coefficients under their own weight"
        )
    if not (runs.peak > 0.0).any() and not runs.collapsed.any():
        remarks.append("no block slides under any motion")
    for row in squat.filter(pl.col("rocks_first")).iter_rows(named=True):
        remarks.append(
            f"block {row['block']} rocks before it slides (mu_s = {row['mu_s']:g} above b/(2 h_c) = "
            f"{row['uplift_g']:.3g}), and would lift off under {row['uplift']} of {row['motions']} motions: its slip "
            f"is of a model without rocking"
        )
    collapsed = int(runs.collapsed.sum())
    if collapsed:
        remarks.append(
            f"the building collapses under {counted(collapsed, 'motion')}: slip counts as infinite there, and every "
            f"clearance as exceeded"
        )
    moving = int(runs.moving.any(axis=1).sum())
    if moving:
        remarks.append(f"goods still slide at the end of {counted(moving, 'motion')}: the residual is that of the end")
    if fragilities and any(each is not None and each.one_sided for each in clearances):
        remarks.append(
            "fragilities are of the largest absolute slip and the smaller clearance, as if both sides had it; the "
            "probabilities at the given intensity are by side"
        )
    if any(motion.vertical is not None for motion in motions.motions):
        remarks.append("with vertical motion, uplift and the ratio of acceleration to weight are taken at the samples")
    if len(motions) < 7:
        remarks.append(f"{counted(len(motions), 'motion')}: few for a mean or a probability")
    if any(block.wear for block in scene.goods):
        remarks.append("estimates take the friction of blocks before any slip")
    return tuple(remarks)


def _pooled_ratio(
    slips: FloatArray, ground: FloatArray, weights: FloatArray, confidence: float
) -> tuple[float | None, float | None, float | None]:
    """Mean slip in the building over mean slip on the ground, with its bootstrap interval, both drawn together."""
    if not ground.any() or not np.isfinite(slips).all():
        return None, None, None
    with np.errstate(divide="ignore", invalid="ignore"):
        low, high = interval_of((weights @ slips) / (weights @ ground), confidence)
    return float(slips.sum() / ground.sum()), float(low), float(high)


def _quantiles(values: FloatArray) -> dict[str, float | None]:
    return {name: float(quantile(values, share)) if len(values) else None for name, share in QUANTILES.items()}


def _mean(values: FloatArray) -> float:
    """Mean of the values that are numbers; NaN without any."""
    known = values[~np.isnan(values)]
    return float(known.mean()) if len(known) else float("nan")


def _frame(rows: list[dict[str, Any]], kinds: dict[str, Any]) -> pl.DataFrame:
    """Rows as a frame; NaN is null."""
    frame = pl.DataFrame(rows, schema_overrides=kinds, infer_schema_length=None)
    return frame.with_columns(pl.selectors.float().fill_nan(None))
