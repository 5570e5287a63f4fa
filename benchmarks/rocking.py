"""Rocking blocks on a yielding floor by small steps, beside what stands for them: split, sliding with b/h, attached.

    python benchmarks/rocking.py [--motions N] [--step S] [--falls | --warehouse]

The block is rigid and rectangular, of any angle. It turns about an edge of a floor that carries it, an impact conserves
the angular momentum about the next edge and the horizontal momentum of block and floor, and the floor feels the block's
horizontal force. Nothing of the kernel is used: the equations are stepped by the leapfrog method, which is the same for
thousands of cases at once. Motions are the built-in forty, or recordings of the folder that SEISMASS_SHARED names.

The first table holds drifts of cases in which the block rocks and does not fall; `--falls` counts falls at the design
level, and how many of them are below Ishiyama's two limits; `--warehouse` has lambda of the example by b/h and model.
"""

from __future__ import annotations

import argparse
import itertools
import os
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import polars as pl

import seismass as sm
from seismass.assessment.building_file import example_file
from seismass.assessment.checks import TAKEN, WORDS
from seismass.model.tipping import staying_part

GRAVITY = 9.80665
HARDENING = 0.02
DAMPING = 0.05
STEP = 5e-4
FALLEN = 1.2
"""Angle (rad) beyond which a block counts as fallen; it then stays where it is and moves with the floor."""
TARGET = {"sds": 1.0, "sd1": 0.6}


@dataclass(frozen=True)
class Blocks:
    """Cases, one per lane: block of half diagonal `radius` (m) and ratio b/h on the floor of a storey of unit mass,
    with stiffness (1/s2), yield drift (m) and damping (1/s) per mass of the floor, and `goods` times that as a block.
    """

    ratio: np.ndarray
    radius: np.ndarray
    goods: np.ndarray
    stiffness: np.ndarray
    yield_drift: np.ndarray
    damping: np.ndarray


@dataclass
class Peaks:
    """Largest drift (m), acceleration (m/s2) and velocity (m/s) of the floor, whether the block lifted and fell, and
    its angle at the end (rad).
    """

    drift: np.ndarray
    acceleration: np.ndarray
    velocity: np.ndarray
    lifted: np.ndarray
    fallen: np.ndarray
    angle: np.ndarray


def restitution(angle: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Return the ratio of angular velocities of an impact; `share` is block over block and floor, 0 on fixed ground,
    where it is Housner's 1 - 1.5 sin^2.
    """
    recoil = share * np.cos(angle) ** 2
    ratio: np.ndarray = (4.0 / 3.0 - 2.0 * np.sin(angle) ** 2 - recoil) / (4.0 / 3.0 - recoil)
    return ratio


def stepped(blocks: Blocks, ground: np.ndarray, step: float, start: np.ndarray | float = 0.0) -> Peaks:
    """Return the peaks of all cases under samples of the ground (m/s2, samples x motions): lanes are cases, each under
    every motion, the motion changing fastest. `start` is the angle (rad) at the start.
    """
    angle, lanes = np.arctan(blocks.ratio), len(blocks.ratio)
    whole = 1.0 + blocks.goods
    impact = restitution(angle, blocks.goods / whole)
    theta, rate = np.zeros(lanes) + start, np.zeros(lanes)
    drift, velocity, plastic = np.zeros(lanes), np.zeros(lanes), np.zeros(lanes)
    rocks, fallen = theta != 0.0, np.zeros(lanes, dtype=bool)
    peaks = Peaks(np.zeros(lanes), np.zeros(lanes), np.zeros(lanes), rocks.copy(), fallen, theta)
    ground_velocity, cases_in_all = np.zeros(lanes), lanes // ground.shape[1]
    square = 0.75 * GRAVITY / blocks.radius
    for row in ground:
        sample = np.tile(row, cases_in_all)
        force = -blocks.damping * velocity - blocks.stiffness * (
            HARDENING * drift + (1.0 - HARDENING) * (drift - plastic)
        )
        acceleration = force / whole
        lifts = ~rocks & ~fallen & (np.abs(acceleration) > GRAVITY * blocks.ratio)
        side = np.where(lifts, -np.sign(acceleration), np.sign(theta))
        rocks |= lifts
        peaks.lifted |= lifts
        phi = angle - np.abs(theta)
        sine, cosine = np.sin(phi), np.cos(phi)
        push = blocks.goods * side * sine * (0.75 * GRAVITY * cosine - blocks.radius * rate * rate)
        acceleration = np.where(rocks, (force + push) / (whole - 0.75 * blocks.goods * cosine**2), acceleration)
        turn = np.where(rocks, -square * (side * sine + acceleration / GRAVITY * cosine), 0.0)
        velocity = velocity + step * (acceleration - sample)
        drift = drift + step * velocity
        plastic = np.clip(plastic, drift - blocks.yield_drift, drift + blocks.yield_drift)
        rate = rate + step * turn
        moved = theta + step * rate
        lands = rocks & ~lifts & (moved * side < 0.0)
        # The floor keeps the momentum that the block loses.
        recoil = np.where(lands, blocks.goods / whole * blocks.radius * np.cos(angle) * rate * (1.0 - impact), 0.0)
        velocity = velocity + recoil
        rate = np.where(lands, impact * rate, rate)
        theta = np.where(lands, step * rate * 0.5, moved)
        rests = lands & (np.abs(rate) < 2.0 * step * square * blocks.ratio)
        theta, rate, rocks = np.where(rests, 0.0, theta), np.where(rests, 0.0, rate), rocks & ~rests
        falls = rocks & (np.abs(theta) > FALLEN)
        fallen |= falls
        rocks &= ~falls
        rate = np.where(falls, 0.0, rate)
        ground_velocity = ground_velocity + step * sample
        np.maximum(peaks.drift, np.abs(drift), out=peaks.drift)
        np.maximum(peaks.acceleration, np.abs(acceleration), out=peaks.acceleration)
        np.maximum(peaks.velocity, np.abs(velocity + ground_velocity), out=peaks.velocity)
    peaks.angle = theta
    return peaks


def suite(motions: int | None) -> list[sm.Record]:
    """Return the motions: recordings where SEISMASS_SHARED is set, else the built-in forty, scaled as the others."""
    shared = os.environ.get("SEISMASS_SHARED")
    if shared:
        listed = list(sm.records.read_suite(Path(shared) / "records" / "fema_p695_far_field"))
    else:
        listed = list(sm.builtin_suite("forty"))
    return listed[: motions or len(listed)]


def scaled(record: sm.Record) -> sm.Record:
    """Return a record scaled so that its spectrum is the target in the geometric mean of 0.1 to 2 s."""
    periods = np.geomspace(0.1, 2.0, 40)
    target = sm.TargetSpectrum.asce7(TARGET["sds"], TARGET["sd1"])(periods)
    spectrum = sm.spectra.response_spectrum(record.motion, periods, DAMPING)[0]
    return record.scaled(float(np.exp(np.mean(np.log(target / spectrum)))))


def sampled(records: Sequence[sm.Record], step: float) -> np.ndarray:
    """Return samples at equal steps, linear between those of the records, samples x records, zero after their ends."""
    ends = [(record.samples - 1) * record.dt for record in records]
    times = np.arange(0.0, max(ends), step)
    return np.stack([np.interp(times, np.arange(r.samples) * r.dt, r.acceleration, right=0.0) for r in records], axis=1)


def cases(
    periods: Sequence[float], strengths: Sequence[float], goods: Sequence[float], *sizes: Sequence[float]
) -> pl.DataFrame:
    """Return all combinations: T (s) with all goods, R, goods over floor, b/h, half diagonal (m)."""
    rows = list(itertools.product(periods, strengths, goods, *sizes))
    return pl.DataFrame(rows, schema=["T", "R", "alpha", "ratio", "radius"], orient="row")


def blocks_of(table: pl.DataFrame, copies: int) -> Blocks:
    """Return the lanes of cases, each so many times."""
    period, strength, goods, ratio, radius = (np.repeat(table[name].to_numpy(), copies) for name in table.columns[:5])
    stiffness = (2.0 * np.pi / period) ** 2 * (1.0 + goods)
    elastic = sm.TargetSpectrum.asce7(TARGET["sds"], TARGET["sd1"])(period) * (1.0 + goods) / stiffness
    limit = np.where(strength > 1.0, elastic / strength, np.inf)
    damping = 2.0 * DAMPING * np.sqrt(stiffness)
    return Blocks(ratio, radius, goods, stiffness, limit, damping)


def kernel_drifts(table: pl.DataFrame, records: Sequence[sm.Record]) -> dict[str, np.ndarray]:
    """Return drifts by the kernel, cases x motions: goods split, sliding with mu = b/h, all of them attached."""
    scenes: dict[str, list[sm.Scene]] = {"split": [], "slide": [], "attached": []}
    lanes = blocks_of(table, 1)
    for number, row in enumerate(table.iter_rows(named=True)):
        building = sm.Building(
            [1.0],
            float(lanes.stiffness[number]),
            yield_shear=float(lanes.stiffness[number] * lanes.yield_drift[number]),
            overstrength=1e6,
            second_slope=HARDENING,
            third_slope=HARDENING,
            damping=DAMPING,
        )
        goods, part, mu = row["alpha"], staying_part(row["ratio"]), row["ratio"]
        scenes["split"].append(
            sm.Scene(building, [sm.Block(1, mass=goods * (1.0 - part), mu=mu)], fixed_goods=[goods * part])
        )
        scenes["slide"].append(sm.Scene(building, [sm.Block(1, mass=goods, mu=mu)]))
        scenes["attached"].append(sm.Scene(building, fixed_goods=[goods]))
    shape = (table.height, len(records))
    return {
        name: sm.simulate_many(listed, list(records))["peak_drift"].list.first().to_numpy().reshape(shape)
        for name, listed in scenes.items()
    }


def compared(table: pl.DataFrame, records: Sequence[sm.Record], step: float) -> pl.DataFrame:
    """Return a row per case: drift of rocking goods over that of each model in the mean of the motions under which the
    block lifts and does not fall, and how many these are.
    """
    blocks = blocks_of(table, len(records))
    peaks = stepped(blocks, sampled(records, step), step)
    shape = (table.height, len(records))
    drift, lifted, fallen = (each.reshape(shape) for each in (peaks.drift, peaks.lifted, peaks.fallen))
    counts = lifted & ~fallen
    columns = {"lifted": lifted.sum(axis=1), "fallen": fallen.sum(axis=1)}
    for name, of_model in kernel_drifts(table, records).items():
        with np.errstate(invalid="ignore", divide="ignore"):
            columns[name] = (drift * counts).sum(axis=1) / (of_model * counts).sum(axis=1)
    return table.with_columns(**columns)


def by_class(rows: pl.DataFrame) -> pl.DataFrame:
    """Return the median and 5 and 95 % of the drift ratios of cases that rock under at least four motions without a
    fall, whole and by each parameter.
    """
    known = rows.filter((pl.col("lifted") >= 4) & (pl.col("fallen") == 0))
    parts = []
    for name in (None, "T", "R", "alpha", "ratio"):
        groups = [(("",), known)] if name is None else known.group_by(name, maintain_order=True)
        for (value,), group in groups:
            row = {"class": "all" if name is None else f"{name} {value:g}", "cases": group.height}
            for model in ("split", "slide", "attached"):
                for label, share in (("5 %", 0.05), ("median", 0.5), ("95 %", 0.95)):
                    row[f"{model} {label}"] = group[model].quantile(share, "linear")
            parts.append(row)
    return pl.DataFrame(parts)


def falls(records: Sequence[sm.Record], step: float) -> pl.DataFrame:
    """Return the share of blocks that lift off which fall, by b/h and height (m), with the range over the storeys, and
    how many of those fell below both limits of Ishiyama.
    """
    table = cases((0.3, 0.8), (1.0, 4.0), (0.25, 1.0), (0.1, 0.15, 0.2, 0.3, 0.4), (0.5, 1.0, 2.0, 3.0))
    blocks = blocks_of(table, len(records))
    peaks = stepped(blocks, sampled(records, step), step)
    angle = np.arctan(blocks.ratio)
    width, height = 2.0 * blocks.radius * np.sin(angle), 2.0 * blocks.radius * np.cos(angle)
    above = (peaks.acceleration > GRAVITY * blocks.ratio) & (peaks.velocity > width / np.sqrt(height))
    lanes = pl.DataFrame(
        {
            "ratio": blocks.ratio,
            "height": np.where(blocks.radius < 1.5, "1 to 2 m", "4 to 6 m"),
            "storey": np.repeat(np.arange(table.height) // 20, len(records)),
            "lifted": peaks.lifted,
            "fallen": peaks.fallen,
            "below": peaks.fallen & ~above,
            "above": above & peaks.lifted,
        }
    ).filter("lifted")
    storeys = lanes.group_by("ratio", "height", "storey").agg(pl.col("fallen").mean())
    ends = storeys.group_by("ratio", "height").agg(low=pl.col("fallen").min(), high=pl.col("fallen").max())
    counts = lanes.group_by("ratio", "height", maintain_order=True).agg(
        pl.len().alias("lifted"),
        share=pl.col("fallen").mean(),
        below_limits=pl.col("below").sum(),
        above_limits=pl.col("above").sum(),
    )
    return counts.join(ends, on=("ratio", "height"), how="left").sort("height", "ratio")


def warehouse() -> pl.DataFrame:
    """Return lambda of the example with mu = 0.5 by b/h of goods 1.5 m high: the model that is taken, the part that
    stays, and lambda with the other models and with mu = b/h in place of the size.
    """
    tables = tomllib.loads(example_file().read_text(encoding="utf-8"))
    del tables["goods"]["friction"]
    rows = []
    for ratio in (0.1, 0.2, 0.3, 0.4, 0.5, 0.6):
        size = {"mu": 0.5, "width_m": 1.5 * ratio, "height_m": 1.5}
        result = sm.assess(tables | {"goods": tables["goods"] | size}, resamples=1)
        model, staying = ("slide", 0.0)
        if result.tipping.height:
            model, staying = result.tipping.select("model", "staying").row(0)
        shares = {one.floors.removeprefix(TAKEN): one.advised for one in result.answer.tipping}
        alone = sm.assess(tables | {"goods": tables["goods"] | {"mu": ratio, "mu_factors": [1.0, 1.0]}}, resamples=1)
        row = {"b/h": ratio, "model": model, "staying": staying, "lambda": result.advised}
        row |= {name: shares.get(words) for name, words in WORDS.items()}
        rows.append(row | {"mu = b/h": alone.advised})
    return pl.DataFrame(rows)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--motions", type=int, help="how many of the motions; default all")
    parser.add_argument("--step", type=float, default=STEP, help="step (s)")
    parser.add_argument("--falls", action="store_true", help="count falls instead")
    parser.add_argument("--warehouse", action="store_true", help="the example by b/h instead")
    args = parser.parse_args()
    records = [scaled(record) for record in suite(args.motions)]
    with pl.Config(
        tbl_formatting="MARKDOWN",
        tbl_hide_dataframe_shape=True,
        tbl_hide_column_data_types=True,
        tbl_rows=-1,
        tbl_cols=-1,
        float_precision=2,
        tbl_width_chars=200,
    ):
        if args.warehouse:
            print(warehouse())
            return
        if args.falls:
            print(falls(records, args.step))
            return
        table = cases((0.15, 0.3, 0.5, 1.0), (1.0, 2.0, 4.0), (0.25, 1.0, 2.0), (0.15, 0.2, 0.3, 0.4, 0.5), (1.0, 3.0))
        print(by_class(compared(table, records, args.step)))


if __name__ == "__main__":
    main()
