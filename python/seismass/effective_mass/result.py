"""What `effective_mass` gives back: the share, how it came about, its scatter, and the tables behind it."""

from __future__ import annotations

import math
import textwrap
from dataclasses import asdict, dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar, Final

import numpy as np
import polars as pl

from seismass.base.statistics import CAPPED_MEAN, Statistic, over_records
from seismass.base.values import FieldValue, FloatArray
from seismass.base.views import view
from seismass.effective_mass.rule import ByHand
from seismass.effective_mass.share import Kind, interpolated_roots, is_below, kind_of
from seismass.media.result import Result, finite_values
from seismass.runs.peaks import NamedMotions, Peaks

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.figure import Figure


SCHEMA_VERSION: Final = 4
"""Version of the tables and of the JSON of an effective mass."""

SUITE_SCATTER: Final = 0.05
"""By how much an interval is widened at each end for another suite of motions of the same kind.

How often the wider interval holds the fraction under other recordings stands by use in docs/effective_mass.md;
`benchmarks/effective_mass.py --coverage` measures it. Suites of seven differ by more.
"""

KIND_TEXTS: Final[dict[Kind, str]] = {
    "stuck": "no goods slide under any motion, so that all of them act as mass",
    "root": "one share gives the drift with sliding goods",
    "multiple": "several shares give the drift with sliding goods, the largest counts",
    "zero": "no share drifts less than with sliding goods, so that none needs to be attached",
    "one": "even with all goods attached the model drifts less than with sliding goods",
    "beyond": "with all goods attached the model drifts less than with sliding goods, a larger share gives their drift",
    "collapsed": "with sliding goods the building collapses under more than a tenth of the motions (median: half)",
}
"""What each kind means."""


@dataclass(frozen=True, eq=False)
class EffectiveMass(FieldValue, Result):
    """The effective fraction of the live load of a building under a suite of motions.

    Attributes
    ----------
    value : float
        The smallest share of the live load which, attached as mass, gives a statistic over the motions of the largest
        storey drift not below that of the building with sliding goods, there and at every larger share up to 1. NaN
        where `kind` is "collapsed".
    kind : {"stuck", "root", "multiple", "zero", "one", "collapsed"}
        "stuck": no goods slide, the value is exactly 1. "root", "multiple": the model crosses the real drift once or
        several times, the value is the largest crossing. "zero": the model nowhere drifts less, the value is 0 (also
        where all goods are without friction). "one": the model drifts less even at 1, the value is 1 and
        `excess` says by how much. "beyond": with racks or stops, a share above 1 gives the drift. "collapsed": the
        real building collapses under more than a tenth of the motions (with the median: more than half).
    roots : tuple of float
        All crossings on [0, 1]; where `kind` is "beyond" the one above 1 too.
    interval : tuple of float or None
        Percentile bootstrap interval over the records, real and model drawn together; None with one earthquake alone
        or without a value.
    suite_interval : tuple of float or None
        `interval` with the scatter between suites: `SUITE_SCATTER` further at each end, within the shares looked at.
    confidence : float
        Probability that the interval is made for.
    statistic : {"mean", "median"}
        What is taken over the motions, of drifts that are at most the drift cap (`metadata["drift_cap"]` times the
        storey height; none without heights). The mean is continuous where a run begins to collapse.
    real, model : float
        Statistic of the largest drift of the real building, and of the model at `value`: m, or drift ratio where the
        building has heights (`unit`).
    unit : {"m", "ratio"}
        Unit of drifts.
    excess : float
        real / model - 1: by how much the real building drifts more than the model at `value`; zero except for rounding
        where the value is a root.
    eta : float
        mu_k over `base_shear_coefficient`, mu_k averaged over the goods by mass.
    base_shear_coefficient : float
        Mean over the motions of the peak base shear of the fully attached model in the runs, over the weight of
        building and goods.
    by_hand : ByHand
        The rule 1.35 mu/C1 - 0.15 without any run, with all that it takes; in two directions 0.8 mu in place of
        mu.
    curve : polars.DataFrame
        One row per share and storey (0: the largest over the storeys of each run): fraction, storey, model_drift,
        real_drift, ratio (real over model), ratio_low and ratio_high (its bootstrap interval, for storey 0).
    storeys : polars.DataFrame
        One row per storey: storey, real, model, model_at_0, model_at_1, ratio, ratio_at_0, ratio_at_1, and
        envelope_ratio, real over the larger of `model` and `model_at_0`.
    records : polars.DataFrame
        One row per motion: motion, record, event, slips (whether goods slide), collapsed, real_drift, kind,
        first_root, last_root (null where there is none), and value_without, the value of all other motions; by
        interpolation on the grid of shares.
    collapses : dict of str to int
        Number of collapsed runs of the real building ("real") and of the model at `value` ("model"), at 0
        ("model_at_0") and at 1 ("model_at_1").
    remarks : tuple of str
        What a user must know beside the numbers.
    metadata : dict
        Schema and package version, digest of the inputs, seed, conventions, counts.
    """

    document: ClassVar[str] = "effective_mass"

    value: float
    kind: Kind
    roots: tuple[float, ...]
    interval: tuple[float, float] | None
    confidence: float
    statistic: str
    real: float
    model: float
    unit: str
    excess: float
    eta: float
    base_shear_coefficient: float
    by_hand: ByHand
    curve: pl.DataFrame = field(repr=False)
    storeys: pl.DataFrame = field(repr=False)
    records: pl.DataFrame = field(repr=False)
    collapses: dict[str, int] = field(repr=False)
    remarks: tuple[str, ...] = field(repr=False)
    metadata: dict[str, Any] = field(repr=False)

    @property
    def text(self) -> str:
        """The answer in a few lines, its scatter and the rule by hand beside it."""
        suites = self.suite_interval
        scatter = (
            "no interval"
            if self.interval is None or suites is None
            else f"{100.0 * self.confidence:g} % interval over the records {self.interval[0]:.2f} to "
            f"{self.interval[1]:.2f}, over suites too {suites[0]:.2f} to {suites[1]:.2f}"
        )
        scale, unit = (1e3, "mm") if self.unit == "m" else (1e2, "% of the height")
        drifts = f"real {scale * self.real:.4g}, model {scale * self.model:.4g} {unit}"
        statistic = CAPPED_MEAN if self.statistic == "mean" else "median"
        lines = [
            f"effective fraction  {self.value_text} ({scatter})",
            f"                    {KIND_TEXTS[self.kind]}",
            f"largest drift       {statistic}, {self.records.height} motions: {drifts}",
            *self.rule_lines,
        ]
        return "\n".join([*lines, *(f"remark              {remark}" for remark in self.remarks)])

    @property
    def value_text(self) -> str:
        """The value in three decimals; "no value" where there is none."""
        return f"{self.value:.3f}" if math.isfinite(self.value) else "no value"

    @property
    def suite_interval(self) -> tuple[float, float] | None:
        """Interval over records and suites; that over the records alone where goods stick, or have no friction."""
        if self.interval is None or self.kind == "stuck" or self.eta == 0.0:
            return self.interval
        low, high = self.interval
        largest = self.metadata.get("largest_share", 1.0)
        return max(0.0, low - SUITE_SCATTER), min(largest, high + SUITE_SCATTER)

    @property
    def rule_lines(self) -> tuple[str, ...]:
        """The friction beside the mean peak base shear of the runs, and the rule by hand."""
        wrapped = textwrap.wrap(self.by_hand.words, 96)
        return (
            f"eta                 {self.eta:.3f}, mu_k over {self.base_shear_coefficient:.4f}, the mean peak base "
            "shear of the runs with all goods attached over the weight",
            *(f"{'' if number else 'by hand':20}{line}" for number, line in enumerate(wrapped)),
        )

    def to_dict(self) -> dict[str, Any]:
        """Return everything but the curve as plain values; null for non-finite values."""
        names = ["value", "kind", "roots", "interval", "confidence", "statistic", "real", "model", "unit", "excess"]
        names += ["suite_interval"]
        names += ["eta", "base_shear_coefficient", "collapses", "remarks"]
        document = {"schema_version": SCHEMA_VERSION, **{name: getattr(self, name) for name in names}}
        document |= {"by_hand": asdict(self.by_hand)}
        document |= {"storeys": self.storeys.to_dicts(), "records": self.records.to_dicts(), "metadata": self.metadata}
        return finite_values(document)

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name: curve, storeys, records."""
        return {"curve": self.curve, "storeys": self.storeys, "records": self.records}

    @property
    def figure_names(self) -> tuple[str, ...]:
        """curve: real over model drift against the share attached; storeys: by storey, at 0, at the value, at 1."""
        return ("curve", "storeys")

    @view
    def plot(self, name: str | None = None, *, codes: Mapping[str, float] | None = None) -> Figure:
        """Return a figure of `figure_names`, by default real over model drift against the share, with its band.

        Parameters
        ----------
        name : str, optional
            "curve" or "storeys".
        codes : mapping of str to float, optional
            Shares of codes to mark in the curve, by name; by default those of four codes for storage.

        Raises
        ------
        InvalidOption
            There is no such figure.
        """
        raise NotImplementedError


def stored_fraction(document: dict[str, Any], curve: pl.DataFrame) -> EffectiveMass:
    """Return an effective fraction of its `to_dict`, in which what is not finite is null, and of its curve."""
    numbers = ("value", "real", "model", "excess", "eta", "base_shear_coefficient")
    known = {name: document[name] for name in ("kind", "confidence", "statistic", "unit", "collapses", "metadata")}
    known |= {name: _number(document[name]) for name in numbers}
    rule, ends = document["by_hand"], document["interval"]
    return EffectiveMass(
        **known,
        roots=tuple(document["roots"]),
        interval=None if ends is None else (_number(ends[0]), _number(ends[1])),
        by_hand=ByHand(**rule | {"friction": _number(rule["friction"]), "exceptions": tuple(rule["exceptions"])}),
        curve=curve,
        storeys=pl.DataFrame(document["storeys"], schema_overrides={"storey": pl.UInt32}, infer_schema_length=None),
        records=pl.DataFrame(document["records"], schema_overrides=RECORDS, infer_schema_length=None),
        remarks=tuple(document["remarks"]),
    )


def _number(value: float | None) -> float:
    return math.nan if value is None else float(value)


STOREY_REMARK: Final = 1.05
"""A storey that drifts more than so many times the model is named in the remarks."""


def curve_table(
    shares: FloatArray, model: Peaks, sliding: Peaks, band: FloatArray | None, statistic: Statistic
) -> pl.DataFrame:
    """Return drifts by share and storey, storey 0 being the largest of each run; see `EffectiveMass.curve`."""

    def by_storey(peaks: Peaks) -> FloatArray:
        every = np.concatenate([peaks.largest[:, :, None], peaks.capped], axis=2)
        return over_records(np.moveaxis(every, 1, -1), statistic)

    model_drift = by_storey(model)
    sliding_drift = np.broadcast_to(by_storey(sliding), model_drift.shape)
    columns = model_drift.shape[1]
    with np.errstate(invalid="ignore"):
        ratio = sliding_drift / model_drift
    ends = np.full((2, *ratio.shape), np.nan)
    if band is not None:
        ends[:, :, 0] = band
    return pl.DataFrame(
        {
            "fraction": np.repeat(shares, columns),
            "storey": np.tile(np.arange(columns, dtype=np.uint32), len(shares)),
            "model_drift": model_drift.ravel(),
            "real_drift": sliding_drift.ravel(),
            "ratio": ratio.ravel(),
            "ratio_low": pl.Series(ends[0].ravel(), nan_to_null=True),
            "ratio_high": pl.Series(ends[1].ravel(), nan_to_null=True),
        }
    )


def storey_drifts(sliding: Peaks, model: Peaks, grid: Peaks, statistic: Statistic) -> pl.DataFrame:
    """Return drifts by storey at the answer, beside those of the first and last model of the grid."""

    def by_storey(peaks: Peaks, index: int) -> FloatArray:
        return over_records(peaks.capped[index].T, statistic)

    sliding_drift, model_drift = by_storey(sliding, 0), by_storey(model, 0)
    bare, full = by_storey(grid, 0), by_storey(grid, -1)
    with np.errstate(invalid="ignore"):
        return pl.DataFrame(
            {
                "storey": np.arange(1, len(sliding_drift) + 1, dtype=np.uint32),
                "real": sliding_drift,
                "model": model_drift,
                "model_at_0": bare,
                "model_at_1": full,
                "ratio": sliding_drift / model_drift,
                "ratio_at_0": sliding_drift / bare,
                "ratio_at_1": sliding_drift / full,
                "envelope_ratio": sliding_drift / np.maximum(model_drift, bare),
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
        listed = ", ".join(f"{root:.3f}" for root in roots)
        remarks.append(f"{len(roots)} shares from {roots[0]:.2f} to {value:.2f} give the same drift ({listed})")
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


RECORDS: Final[dict[str, type[pl.DataType]]] = {
    "motion": pl.UInt32,
    "event": pl.String,
    **dict.fromkeys(("first_root", "last_root", "value_without"), pl.Float64),
}
"""Types of the columns of `EffectiveMass.records` that may be without a value, or are narrower than Python's own."""


def record_table(
    motions: NamedMotions, shares: FloatArray, sliding: Peaks, model: Peaks, without: FloatArray | None
) -> pl.DataFrame:
    """Return one row per motion: its own kind and roots, by interpolation; see `EffectiveMass.records`."""
    rows = []
    sliding_largest, model_largest = sliding.largest, model.largest
    for index, (name, event) in enumerate(zip(motions.names, motions.events, strict=True)):
        slips, collapsed = bool(sliding.slides[-1, index]), bool(sliding.collapsed[-1, index])
        drift = np.broadcast_to(sliding_largest[:, index], shares.shape)
        curve = model_largest[:, index]
        kind: Kind = "collapsed" if collapsed else kind_of(is_below(curve, drift)) if slips else "stuck"
        roots = interpolated_roots(shares, curve, drift) if slips and not collapsed else []
        rows.append(
            {
                "motion": index + 1,
                "record": name,
                "event": event or None,
                "slips": slips,
                "collapsed": collapsed,
                "real_drift": float(sliding_largest[-1, index]),
                "kind": kind,
                "first_root": roots[0] if roots else None,
                "last_root": roots[-1] if roots else None,
                "value_without": None if without is None else float(without[index]),
            }
        )
    return pl.DataFrame(rows, schema_overrides=RECORDS)
