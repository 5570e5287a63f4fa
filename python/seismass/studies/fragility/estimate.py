"""Fragilities of one limit from the runs of an analysis, with the same bootstrap draws of motions for every model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seismass.base.values import FloatArray
from seismass.studies.fragility.fragility import BootstrapOptions, Fragility, as_curves, cloud_remarks, fragility_of
from seismass.studies.fragility.likelihood import capacity_fits, cloud_fits, probit_fits


@dataclass(frozen=True, slots=True)
class Draws:
    """How often each bootstrap resample has each motion, shape (resamples, motions); no rows where all motions are of
    one earthquake, as motions of one earthquake are drawn together.
    """

    weights: FloatArray
    confidence: float


def draws_of(cluster_of: NDArray[np.int64], options: BootstrapOptions, number: int = 0) -> Draws:
    """Return the draws of motions whose clusters are given; `number` distinguishes the draws of several levels."""
    _, which = np.unique(cluster_of, return_inverse=True)
    count = int(which.max()) + 1
    if count == 1 or not options.resamples:
        return Draws(np.empty((0, len(cluster_of))), options.confidence)
    generator = np.random.default_rng([options.seed, number])
    drawn = generator.multinomial(count, np.full(count, 1.0 / count), size=options.resamples)
    return Draws(drawn[:, which].astype(np.float64), options.confidence)


def of_capacities(capacity: FloatArray, exceeded: NDArray[np.bool_], draws: Draws) -> Fragility:
    """Return the fragility of capacities, or of the intensities up to which motions did not exceed the limit."""
    fits = capacity_fits(capacity, exceeded, np.ones((1, len(capacity))))
    samples = as_curves(capacity_fits(capacity, exceeded, draws.weights))
    return fragility_of(
        as_curves(fits)[0],
        samples,
        fits.kind[0],
        "capacities",
        draws.confidence,
        runs=len(capacity),
        exceeding=int(exceeded.sum()),
        intensities=capacity,
    )


def of_stripes(levels: FloatArray, exceeded: Sequence[FloatArray], draws: Sequence[Draws]) -> Fragility:
    """Return the fragility of counts by level: `exceeded` (levels,) is 1 where a motion exceeds, `draws` as many."""
    rows = min(len(draw.weights) for draw in draws)  # none where the motions of a level are of one earthquake
    hits, runs = (np.array([[f(each) for each in exceeded]], dtype=np.float64) for f in (np.sum, np.size))
    fits = probit_fits(levels, hits, runs)
    drawn_hits = np.stack([draw.weights[:rows] @ each for draw, each in zip(draws, exceeded, strict=True)], axis=1)
    drawn_runs = np.stack([draw.weights[:rows].sum(axis=1) for draw in draws], axis=1)
    return fragility_of(
        as_curves(fits)[0],
        as_curves(probit_fits(levels, drawn_hits, drawn_runs)),
        fits.kind[0],
        "counts",
        draws[0].confidence,
        runs=int(runs.sum()),
        exceeding=int(hits.sum()),
        intensities=levels,
    )


def of_cloud(
    levels: FloatArray, demand: FloatArray, collapsed: NDArray[np.bool_], limit: float, draws: Draws
) -> Fragility:
    """Return the fragility of demands of motions as they are."""
    curves, kinds = cloud_fits(levels, demand, collapsed, limit, np.ones((1, len(levels))))
    samples, _ = cloud_fits(levels, demand, collapsed, limit, draws.weights)
    return fragility_of(
        curves[0],
        samples,
        kinds[0],
        "cloud",
        draws.confidence,
        runs=len(levels),
        exceeding=int((collapsed | (demand > limit)).sum()),
        intensities=levels,
        remarks=cloud_remarks(demand, collapsed, curves[0]),
    )


def of_occurrences(levels: FloatArray, occurred: NDArray[np.bool_], draws: Draws) -> Fragility:
    """Return the fragility of what occurs or not in each run, each at its own intensity: a probit regression."""
    every = np.ones((1, len(levels)))
    fits = probit_fits(levels, every * occurred, every)
    return fragility_of(
        as_curves(fits)[0],
        as_curves(probit_fits(levels, draws.weights * occurred, draws.weights)),
        fits.kind[0],
        "counts",
        draws.confidence,
        runs=len(levels),
        exceeding=int(occurred.sum()),
        intensities=levels,
    )
