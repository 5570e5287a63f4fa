"""Scaling by least squares alone: each motion as close to the target as one factor can bring it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Literal, TypeAlias, get_args

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import FloatArray, brief, is_one_of, refusal
from seismass.scaling.result import ScalingResult
from seismass.scaling.suite import suite_spectra
from seismass.spectra import GroundMotion, TargetSpectrum

Space: TypeAlias = Literal["log", "linear"]
"""Whether the squares are of ln A_t - ln SF A or of A_t - SF A."""


def scale_least_squares(
    records: Iterable[GroundMotion],
    target: TargetSpectrum,
    period: float = 1.0,
    *,
    space: Space = "log",
    damping: float = 0.05,
    period_range: tuple[float, float] = (0.2, 1.5),
    count: int = 100,
    threads: int | None = None,
) -> ScalingResult:
    """Return for each motion the factor of least squares between its spectrum and the target.

    Parameters
    ----------
    records, target, period, damping, period_range, count, threads
        As for `scale_asce7_10`; one motion is enough.
    space : {"log", "linear"}
        Differences of logarithms, or of ordinates, which weigh the periods of large ordinates.

    Raises
    ------
    InvalidOption, InvalidMotion
        As for `scale_asce7_10`, or another space.

    Notes
    -----
    In the logarithm ln SF_i = mean over T_j of ln A_t - ln A_i; else SF_i = sum A_i A_t / sum A_i^2. The mean of the
    suite may be below the target.
    """
    choice: Any = space
    if not is_one_of(choice, get_args(Space)):
        raise refusal(InvalidOption, "space", "scaling", "one of " + ", ".join(get_args(Space)), brief(space))
    suite = suite_spectra(
        records, target, period, damping=damping, period_range=period_range, count=count, threads=threads
    )
    if space == "log":
        factors = suite.log_factors()
    else:
        squares: FloatArray = np.sum(suite.spectra**2, axis=1)
        factors = suite.spectra @ suite.target / squares
    note = "each motion is fitted by itself: nothing keeps the mean of the suite above the target"
    return suite.result(f"least squares, {space}", factors, notes=(note,))
