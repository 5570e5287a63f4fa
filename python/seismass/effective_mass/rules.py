"""Simple rules for the share of the live load, and how their models compare with the real drift on a map's cases."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import pairwise
from typing import Any, Final, TypeAlias

import numpy as np
import polars as pl

from seismass.base.values import FloatArray
from seismass.effective_mass.estimate import RULE, SAFE_RULE, best_estimate, conservative_estimate

Rule: TypeAlias = Callable[[pl.DataFrame], FloatArray]
"""Takes the table of cases of a map, returns a share of the live load for each."""

BY_HAND: Final = f"{RULE}, C1 by hand"
"""The rule with the base shear coefficient of `base_shear_by_hand`."""


def _constant(share: float) -> Rule:
    return lambda cases: np.full(cases.height, share)


def _numbers(cases: pl.DataFrame, *names: str) -> Iterator[FloatArray]:
    return (cases[name].to_numpy() for name in names)


def _best(cases: pl.DataFrame) -> FloatArray:
    return best_estimate(*_numbers(cases, "eta", "exponent", "height_ratio"))


def _safe(cases: pl.DataFrame) -> FloatArray:
    return conservative_estimate(*_numbers(cases, "eta", "height_ratio"))


def _by_hand(cases: pl.DataFrame) -> FloatArray:
    mu, coefficient, power, heights = _numbers(
        cases, "mu", "base_shear_coefficient_by_hand", "exponent", "height_ratio"
    )
    return best_estimate(mu / coefficient, power, heights)


def _power_of_eta(power: float) -> Rule:
    return lambda cases: np.minimum(1.0, cases["eta"].to_numpy() ** power)


RULES: Final[Mapping[str, Rule]] = {
    RULE: _best,
    SAFE_RULE: _safe,
    BY_HAND: _by_hand,
    "min(1, eta^2), earlier": _power_of_eta(2.0),
    "min(1, eta), earlier": _power_of_eta(1.0),
    "none, 0": _constant(0.0),
    "ASCE 61, 0.10": _constant(0.10),
    "ASCE 7 storage, 0.25": _constant(0.25),
    "IS 1893, 0.5": _constant(0.50),
    "NBC and NZS 1170.5, 0.6": _constant(0.60),
    "MH16.1 racks, 0.67": _constant(0.67),
    "Eurocode 8, 0.8": _constant(0.80),
    "all, 1": _constant(1.0),
}
"""Rules that are compared. The two of earlier versions of this project know neither period nor place of the goods."""

CLOSED_FORMS: Final = tuple(RULES)[:5]
"""Those of them that depend on friction."""

UNSAFE: Final = 1.05
"""A rule counts as unsafe for a case where the real building drifts more than so many times its model."""
PERIOD_EDGES: Final = (0.0, 0.225, 0.435, 0.7, 0.9, np.inf)
"""Edges of the classes of the bare building's period (s): on the default grid 0.2; 0.25 to 0.4; 0.47 to 0.6; 0.8; 1.0
to 1.6."""


def compared(ratio: FloatArray) -> dict[str, Any]:
    """Return how model over real drift is distributed: geometric mean (bias), standard deviation of the logarithm,
    share of cases below 1/1.05 (unsafe), 5 and 95 %, and the least (worst).
    """
    logarithm = np.log(ratio)
    return {
        "cases": len(ratio),
        "bias": float(np.exp(logarithm.mean())),
        "log_scatter": float(logarithm.std()),
        "unsafe": float(np.mean(1.0 / ratio > UNSAFE)),
        "low": float(np.percentile(ratio, 5.0)),
        "high": float(np.percentile(ratio, 95.0)),
        "worst": float(ratio.min()),
    }


def by_period(name: str, ratio: FloatArray, period: FloatArray) -> list[dict[str, Any]]:
    """Return a row of `compared` for each class of period that has cases; the last class is open (null)."""
    rows = []
    for low, high in pairwise(PERIOD_EDGES):
        inside = ratio[(low <= period) & (period < high)]
        if len(inside):
            upper = None if np.isinf(high) else high
            rows.append({"period_from": low, "period_to": upper, "rule": name, **compared(inside)})
    return rows
