"""Spectra of the motions of an assessment, beside the site spectrum."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

import numpy as np
import polars as pl

from seismass.base.quantiles import QUANTILES
from seismass.base.values import FloatArray
from seismass.scaling.asce7 import spectra_of
from seismass.spectra import TargetSpectrum

PERIODS: Final[FloatArray] = np.round(np.geomspace(0.05, 5.0, 81), 4)
"""Periods (s) of the table."""
DAMPING: Final = 0.05


def spectra_table(motions: Sequence[Any], target: TargetSpectrum | None, *, threads: int | None = None) -> pl.DataFrame:
    """Return the period (s) and, in m/s2, the target and the mean, p16, median and p84 of the pseudo-acceleration of
    scaled motions, 5 % damped; of a pair the geometric mean. The target is null outside its range.
    """
    spectra = spectra_of(list(motions), PERIODS, DAMPING, threads=threads)
    wanted = np.full(len(PERIODS), np.nan)
    if target is not None:
        within = (target.shortest <= PERIODS) & (target.longest >= PERIODS)
        wanted[within] = target(PERIODS[within])
    columns = {"period": PERIODS, "target": wanted, "mean": spectra.mean(axis=0)}
    columns |= {name: np.quantile(spectra, share, axis=0) for name, share in QUANTILES.items()}
    return pl.DataFrame(columns).with_columns(pl.col("target").fill_nan(None))
