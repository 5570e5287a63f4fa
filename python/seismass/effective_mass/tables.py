"""Tables and remarks of an effective mass, from peaks of the real building and of the models."""

from __future__ import annotations

from typing import Final

import numpy as np
import polars as pl

from seismass.base.values import FloatArray
from seismass.effective_mass.curve import Kind, Statistic, interpolated_roots, is_below, kind_of, over_records
from seismass.effective_mass.runs import NamedMotions, Peaks

STOREY_REMARK: Final = 1.05
"""A storey that drifts more than so many times the model is named in the remarks."""


def curve_table(
    shares: FloatArray, model: Peaks, real: Peaks, band: FloatArray | None, statistic: Statistic
) -> pl.DataFrame:
    """Return drifts by share and storey, storey 0 being the largest of each run; see `EffectiveMass.curve`."""

    def by_storey(peaks: Peaks) -> FloatArray:
        every = np.concatenate([peaks.largest[:, :, None], peaks.drift], axis=2)
        return over_records(np.moveaxis(every, 1, -1), statistic)

    model_drift = by_storey(model)
    real_drift = np.broadcast_to(by_storey(real), model_drift.shape)
    columns = model_drift.shape[1]
    with np.errstate(invalid="ignore"):
        ratio = real_drift / model_drift
    ends = np.full((2, *ratio.shape), np.nan)
    if band is not None:
        ends[:, :, 0] = band
    return pl.DataFrame(
        {
            "fraction": np.repeat(shares, columns),
            "storey": np.tile(np.arange(columns, dtype=np.uint32), len(shares)),
            "model_drift": model_drift.ravel(),
            "real_drift": real_drift.ravel(),
            "ratio": ratio.ravel(),
            "ratio_low": pl.Series(ends[0].ravel(), nan_to_null=True),
            "ratio_high": pl.Series(ends[1].ravel(), nan_to_null=True),
        }
    )


def storey_table(real: Peaks, model: Peaks, grid: Peaks, statistic: Statistic) -> pl.DataFrame:
    """Return drifts by storey at the answer, beside those of the first and last model of the grid."""

    def by_storey(peaks: Peaks, index: int) -> FloatArray:
        return over_records(peaks.drift[index].T, statistic)

    real_drift, model_drift = by_storey(real, 0), by_storey(model, 0)
    bare, full = by_storey(grid, 0), by_storey(grid, -1)
    with np.errstate(invalid="ignore"):
        return pl.DataFrame(
            {
                "storey": np.arange(1, len(real_drift) + 1, dtype=np.uint32),
                "real": real_drift,
                "model": model_drift,
                "model_at_0": bare,
                "model_at_1": full,
                "ratio": real_drift / model_drift,
                "ratio_at_0": real_drift / bare,
                "ratio_at_1": real_drift / full,
                "envelope_ratio": real_drift / np.maximum(model_drift, bare),
            }
        )


def remarks_of(
    kind: Kind,
    roots: list[float],
    value: float,
    excess: float,
    interval: tuple[float, float] | None,
    storeys: pl.DataFrame,
    collapses: dict[str, int],
    motions: int,
) -> tuple[str, ...]:
    """Return what a user must know beside the numbers."""
    remarks = []
    if kind == "multiple":
        remarks.append(f"{len(roots)} shares give the same drift ({', '.join(f'{root:.3f}' for root in roots)})")
    if kind == "one":
        remarks.append(f"with sliding goods the building drifts {100.0 * excess:.2g} % more than with all attached")
    if kind == "beyond":
        remarks.append("the goods load the building more than all of them attached would: racks or stops pass on more")
    for name, count in (("building with sliding goods", collapses["real"]), ("model", collapses["model"])):
        if count:
            remarks.append(f"the {name} collapses under {count} of {motions} motions")
    if motions < 7:
        remarks.append(f"{motions} motions are few: codes ask for 7 or 11 where a mean is to be used")
    if interval is None and kind != "collapsed":
        remarks.append("there is no interval, as all motions are of one earthquake")
    for row in storeys.filter(pl.col("ratio").is_finite() & (pl.col("ratio") > STOREY_REMARK)).iter_rows(named=True):
        remarks.append(
            f"storey {row['storey']} drifts {row['ratio']:.2f} times the model at {value:.2f}; with a second analysis "
            f"without goods {row['envelope_ratio']:.2f} times the larger of the two"
        )
    return tuple(remarks)


def record_table(motions: NamedMotions, shares: FloatArray, real: Peaks, model: Peaks) -> pl.DataFrame:
    """Return one row per motion: its own kind and roots, by interpolation; see `EffectiveMass.records`."""
    rows = []
    real_largest, model_largest = real.largest, model.largest
    for index, (name, event) in enumerate(zip(motions.names, motions.events, strict=True)):
        slips, collapsed = bool(real.slides[-1, index]), bool(real.collapsed[-1, index])
        own = np.broadcast_to(real_largest[:, index], shares.shape)
        curve = model_largest[:, index]
        kind: Kind = "collapsed" if collapsed else kind_of(is_below(curve, own)) if slips else "stuck"
        roots = interpolated_roots(shares, curve, own) if slips and not collapsed else []
        rows.append(
            {
                "motion": index + 1,
                "record": name,
                "event": event or None,
                "slips": slips,
                "collapsed": collapsed,
                "real_drift": float(real_largest[-1, index]),
                "kind": kind,
                "first_root": roots[0] if roots else None,
                "last_root": roots[-1] if roots else None,
            }
        )
    schema = {"motion": pl.UInt32, "event": pl.String, "first_root": pl.Float64, "last_root": pl.Float64}
    return pl.DataFrame(rows, schema_overrides=schema)
