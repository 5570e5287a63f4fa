"""What it costs a family of settings to reach an error: the lower envelope of its points, straight in log-log."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Final

import polars as pl

LEVELS: Final = tuple(10.0**-power for power in range(2, 13))
"""Errors at which contestants are compared."""

Point = tuple[float, float]
"""Error and time (s)."""


def points(table: pl.DataFrame, scene: str, measure: str, families: Iterable[str]) -> list[Point]:
    """Return the points of families on a scene that have this error, coarsest first; an error of 0 is rounding."""
    chosen = table.filter(
        (pl.col("scene") == scene)
        & pl.col("family").is_in(list(families))
        & (pl.col("status") == "ok")
        & pl.col(measure).is_not_null()
    )
    rows = zip(chosen[measure], chosen["time"], strict=True)
    return sorted(((max(error, 1e-17), time) for error, time in rows), reverse=True)


def envelope(found: list[Point]) -> list[Point]:
    """Return the points that no other beats in both, coarsest first."""
    front: list[Point] = []
    for error, time in sorted(found):
        if not front or time < front[-1][1]:
            front.append((error, time))
    return front[::-1]


def time_at(found: list[Point], level: float) -> float | None:
    """Return the time at which the envelope passes an error level; None where no point reaches it."""
    front = envelope(found)
    for number, (error, time) in enumerate(front):
        if error <= level:
            if number == 0:
                return time
            above, before = front[number - 1]
            share = math.log(above / level) / math.log(above / error)
            return float(before * (time / before) ** share)
    return None
