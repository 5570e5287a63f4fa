"""Limit states: a quantity of a run, the value that must not be exceeded, and what a collapsed run counts as."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np
import polars as pl

from seismass.base.arguments import as_word, is_one_of
from seismass.base.errors import InvalidMotion, InvalidOption, InvalidScene
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import (
    FloatArray,
    as_array,
    as_count,
    as_list,
    as_number,
    as_one_of,
    as_positive,
    brief,
    refusal,
)
from seismass.model.scene import Scene
from seismass.motions.motion import MotionLike
from seismass.motions.spectra import response_spectrum
from seismass.runs.peaks import named_motions

Quantity: TypeAlias = Literal[
    "drift_ratio",
    "drift",
    "residual_drift_ratio",
    "residual_drift",
    "slip",
    "residual_slip",
    "floor_acceleration_g",
    "collapse",
]
"""What a limit is set on; see `LimitState`."""
CollapsedRun: TypeAlias = Literal["exceeds", "peak"]
"""What a collapsed run counts as: infinite demand, or its peak up to the collapse."""

_SOURCE: Final[dict[Quantity, str]] = {
    "drift_ratio": "peak_drift_ratio",
    "drift": "peak_drift",
    "residual_drift_ratio": "residual_drift",
    "residual_drift": "residual_drift",
    "slip": "peak_slip",
    "residual_slip": "residual_slip",
    "floor_acceleration_g": "peak_floor_acceleration",
}
_RATIOS: Final = ("drift_ratio", "residual_drift_ratio")
_OF_BLOCKS: Final = ("slip", "residual_slip")
_WITH_PEAK: Final = ("slip", "floor_acceleration_g")
_LABELS: Final[dict[Quantity, tuple[str, str, float]]] = {
    "drift_ratio": ("drift ratio", "%", 1e2),
    "drift": ("drift", "mm", 1e3),
    "residual_drift_ratio": ("residual drift ratio", "%", 1e2),
    "residual_drift": ("residual drift", "mm", 1e3),
    "slip": ("slip", "mm", 1e3),
    "residual_slip": ("residual slip", "mm", 1e3),
    "floor_acceleration_g": ("floor acceleration", "g", 1.0),
    "collapse": ("collapse", "", 1.0),
}


@dataclass(frozen=True)
class LimitState:
    """A limit of a quantity of a run; a run exceeds it where its demand is larger than the value.

    Attributes
    ----------
    quantity : str
        "drift_ratio" or "drift": peak storey drift over the height, or in m. "residual_drift_ratio" or
        "residual_drift": absolute drift at the end. "slip" or "residual_slip": peak or final slip of a block on its
        floor (m), absolute. "floor_acceleration_g": peak absolute floor acceleration (g). "collapse": the run
        collapsed.
    value : float
        The limit, zero or positive: a ratio, m or g. Left out for "collapse".
    storey : int or None
        Storey, or floor of an acceleration, counted from 1; None: the largest over all of them.
    block : int or None
        Block, counted from 1 as the scene lists them; None: the largest over all of them.
    collapsed : {"exceeds", "peak"}
        "exceeds": a collapsed run exceeds the limit, whatever it is. "peak": the peak up to the collapse counts, for
        slip and floor acceleration; drifts and residuals have no value after a collapse, so that it exceeds them.

    Raises
    ------
    InvalidOption
        An attribute is not what it must be.

    Examples
    --------
    >>> import seismass as sm
    >>> sm.fragility.LimitState("drift_ratio", 0.02).text
    'drift ratio above 2 %'
    >>> sm.fragility.LimitState("slip", 0.1, block=1).column
    'slip_block_1'
    """

    quantity: Quantity
    value: float = 0.0
    storey: int | None = None
    block: int | None = None
    collapsed: CollapsedRun = "exceeds"

    def __post_init__(self) -> None:
        owner = "limit state"
        as_word(self.quantity, get_args(Quantity), "quantity", owner)
        value = as_number(self.value, "value", owner, InvalidOption)
        if not 0.0 <= value < np.inf:
            raise refusal(InvalidOption, "value", owner, "zero or positive, and finite", f"{value:g}")
        if self.quantity == "collapse":
            for name, entry in (("value", self.value or None), ("storey", self.storey), ("block", self.block)):
                if entry is not None:
                    raise refusal(InvalidOption, name, "limit state of collapse", "left out", brief(entry))
        elif value == 0.0 and self.quantity not in _OF_BLOCKS:
            raise refusal(InvalidOption, "value", owner, "positive for what is no slip", "0")
        if self.storey is not None:
            as_count(self.storey, "storey", owner, InvalidOption, least=1)
            if self.quantity in _OF_BLOCKS:
                raise refusal(
                    InvalidOption, "storey", owner, "left out for a slip, which has a block", f"{self.storey}"
                )
        if self.block is not None:
            as_count(self.block, "block", owner, InvalidOption, least=1)
            if self.quantity not in _OF_BLOCKS:
                raise refusal(InvalidOption, "block", owner, "left out for what is no slip", f"{self.block}")
        as_word(self.collapsed, get_args(CollapsedRun), "collapsed", owner)
        if self.collapsed == "peak" and self.quantity not in _WITH_PEAK:
            requirement = f"exceeds for {self.quantity}, which has no value after a collapse"
            raise refusal(InvalidOption, "collapsed", owner, requirement, "peak")

    @property
    def column(self) -> str:
        """Column of its demand; limits of the same quantity share one."""
        place = f"_storey_{self.storey}" if self.storey else f"_block_{self.block}" if self.block else ""
        return self.quantity + place + ("_up_to_collapse" if self.collapsed == "peak" else "")

    @property
    def name(self) -> str:
        """Short name, by which results have it: "drift_ratio=0.02", "slip_block_1=0.1", "collapse"."""
        return self.column if self.quantity == "collapse" else f"{self.column}={self.value:.12g}"

    @property
    def place(self) -> str:
        """What axes and texts call the quantity."""
        where = f" of storey {self.storey}" if self.storey else f" of block {self.block}" if self.block else ""
        return _LABELS[self.quantity][0] + where

    @property
    def text(self) -> str:
        """The limit in words, in the unit that engineers use."""
        _, unit, scale = _LABELS[self.quantity]
        return "collapse" if self.quantity == "collapse" else f"{self.place} above {scale * self.value:.4g} {unit}"

    @property
    def label(self) -> str:
        """Label of an axis of the demand."""
        _, unit, _ = _LABELS[self.quantity]
        return f"{self.place} ({unit})" if unit else self.place

    @property
    def shown_scale(self) -> float:
        """Factor from SI to the unit of `label`."""
        return _LABELS[self.quantity][2]

    @property
    def needs_residual(self) -> bool:
        """Whether runs must be carried to their end."""
        return self.quantity.startswith("residual")

    def applies(self, scene: Scene) -> bool:
        """Whether a model has the quantity: one without goods that slide has no slip."""
        blocks = len(as_one_of(scene, Scene, "scene", "limit state", InvalidScene).blocks)
        return self.quantity not in _OF_BLOCKS or (blocks > 0 if self.block is None else self.block <= blocks)

    def check(self, scene: Scene, owner: str) -> None:
        """Refuse a limit that a scene cannot have.

        Raises
        ------
        InvalidOption
            Its storey is missing.
        InvalidScene
            It is one of ratios, and the building has no heights, or there is no building.
        """
        as_one_of(scene, Scene, "scene", owner, InvalidScene)
        if self.quantity in _OF_BLOCKS:
            return
        if scene.building is None:
            raise refusal(InvalidScene, "building", owner, f"given for a limit of {self.quantity}", "None")
        if self.storey is not None and self.storey > scene.storeys:
            raise refusal(InvalidOption, "storey", "limit state", f"from 1 to {scene.storeys}", f"{self.storey}")
        if self.quantity in _RATIOS and scene.building.heights is None:
            raise refusal(InvalidScene, "heights", "building", f"given for a limit of {self.quantity}", "None")

    def demand(self, table: pl.DataFrame, heights: FloatArray | None = None) -> FloatArray:
        """Return the demand of each run.

        Parameters
        ----------
        table : polars.DataFrame
            Rows of `simulate_many`, all of scenes with as many storeys.
        heights : ndarray, shape (storeys,), optional
            Storey heights (m), which residual drift ratios need.

        Returns
        -------
        ndarray, shape (runs,)
            Demand: ratio, m or g; 1 or 0 for a collapse. Infinite in a collapsed run unless `collapsed` is "peak", NaN
            in a failed one and where the scene has no such block.
        """
        status = as_one_of(table, pl.DataFrame, "table", "limit state", InvalidOption)["status"]
        collapsed = (status == "collapsed").to_numpy()
        if self.quantity == "collapse":
            return np.where((status == "failed").to_numpy(), np.nan, collapsed.astype(np.float64))
        column = pl.col(_SOURCE[self.quantity])
        place = self.storey or self.block
        if self.quantity == "residual_drift_ratio":
            taken = self._over_heights(column, heights)
        elif place is None:
            taken = column.list.eval(pl.element().abs()).list.max()
        else:
            taken = column.list.get(place - 1, null_on_oob=True).abs()
        values = table.select(taken.cast(pl.Float64)).to_series().fill_null(np.nan).to_numpy().copy()
        if self.quantity == "floor_acceleration_g":
            values /= STANDARD_GRAVITY
        if self.collapsed == "exceeds":
            there = table.select(pl.col(_SOURCE[self.quantity]).list.len().fill_null(0)).to_series().to_numpy()
            values[collapsed & (there >= (place or 1))] = np.inf
        return values

    def _over_heights(self, column: pl.Expr, heights: FloatArray | None) -> pl.Expr:
        """Absolute residual drift over the height of the storey, the largest where none is named."""
        if heights is None:
            raise refusal(InvalidScene, "heights", "building", f"given for a limit of {self.quantity}", "None")
        storeys = range(len(heights)) if self.storey is None else [self.storey - 1]
        return pl.max_horizontal([column.list.get(k, null_on_oob=True).abs() / heights[k] for k in storeys])

    def exceeded(self, demand: FloatArray) -> FloatArray:
        """Return 1 where a demand exceeds the limit, 0 where not, NaN where it is NaN."""
        values = as_array(demand, "demand", "limit state", InvalidOption, or_number=True)
        return np.where(np.isnan(values), np.nan, (values > self.value).astype(np.float64))

    def to_dict(self) -> dict[str, Any]:
        """Return what defines it, with its name and text."""
        return {**asdict(self), "name": self.name, "text": self.text}


def as_limits(limits: Any, owner: str) -> tuple[LimitState, ...]:
    """Return limit states, or those of their names: at least one, and none twice."""
    listed = [limits] if isinstance(limits, LimitState | str) else limits
    items = tuple(as_list(listed, "limits", owner, InvalidOption, "LimitStates"))
    items = tuple(parse_limit(item) if isinstance(item, str) else item for item in items)
    if not items:
        raise refusal(InvalidOption, "limits", owner, "at least one LimitState", "none")
    for number, limit in enumerate(items, start=1):
        if not isinstance(limit, LimitState):
            raise refusal(InvalidOption, f"limit {number}", owner, "a LimitState", brief(limit))
    if len({limit.name for limit in items}) < len(items):
        raise refusal(InvalidOption, "limits", owner, "different from each other", brief([each.name for each in items]))
    return items


def parse_limit(text: str) -> LimitState:
    """Return a limit from its name, as the command line takes it.

    Parameters
    ----------
    text : str
        ``drift_ratio=0.02``; with a storey, floor or block ``drift_ratio@1=0.02``, ``slip@2=0.1``; or ``collapse``.

    Raises
    ------
    InvalidOption
        It cannot be read.

    Examples
    --------
    >>> from seismass.studies.fragility import parse_limit
    >>> parse_limit("slip@2=0.1")
    LimitState(quantity='slip', value=0.1, storey=None, block=2, collapsed='exceeds')
    """
    head, equals, number = as_one_of(text, str, "text", "limit state", InvalidOption).partition("=")
    quantity, sign, place = head.strip().partition("@")
    requirement = "QUANTITY=VALUE, QUANTITY@STOREY=VALUE, slip@BLOCK=VALUE or collapse"
    try:
        value = float(number) if equals else 0.0
        where = int(place) if sign else None
    except ValueError:
        raise refusal(InvalidOption, "limit", "limit state", requirement, brief(text)) from None
    if not equals and quantity != "collapse":
        raise refusal(InvalidOption, "limit", "limit state", requirement, brief(text))
    return LimitState(quantity, value, **{"block" if quantity in _OF_BLOCKS else "storey": where})  # type: ignore[arg-type]


MeasureName: TypeAlias = Literal["scale", "pga", "sa_t1", "sa_avg"]
"""Name of an intensity measure; see `IntensityMeasure`."""

DEFAULT_RANGE: Final = (0.2, 3.0)
"""Range of periods of the average of Sa, over T1: Eads, Miranda and Lignos (2015)."""
DEFAULT_POINTS: Final = 100
"""Periods of the average of Sa, equally spaced over the range."""

_COLUMNS: Final[dict[MeasureName, str]] = {
    "scale": "scale",
    "pga": "pga_g",
    "sa_t1": "sa_t1_g",
    "sa_avg": "sa_avg_g",
}


@dataclass(frozen=True)
class IntensityMeasure:
    """An intensity measure with what it is taken from.

    Attributes
    ----------
    name : {"scale", "pga", "sa_t1", "sa_avg"}
        "scale": the factor of the motion as it was given. "pga": peak ground acceleration (g). "sa_t1":
        pseudo-acceleration at `period` (g), exact. "sa_avg": geometric mean of the pseudo-acceleration (g) at `points`
        periods equally spaced from `low` to `high` times `period`.
    period : float or None
        T1 (s); None where the measure has none.
    damping : float
        Ratio of critical damping of the spectra.
    low, high : float
        Range of periods of "sa_avg" over T1.
    points : int
        Number of periods of "sa_avg".

    Notes
    -----
    Average of Sa: Eads, Miranda and Lignos (2015), Earthquake Eng. Struct. Dyn. 44:2057-2073, who find 0.2 T1 to 3 T1
    good for collapse; Kohrangi, Bazzurro, Vamvatsikos and Spillatura (2017), Earthquake Eng. Struct. Dyn. 46:1397-1421.
    """

    name: MeasureName
    period: float | None = None
    damping: float = 0.05
    low: float = DEFAULT_RANGE[0]
    high: float = DEFAULT_RANGE[1]
    points: int = DEFAULT_POINTS

    def __post_init__(self) -> None:
        owner = "intensity measure"
        as_word(self.name, get_args(MeasureName), "name", owner)
        if self.name in ("sa_t1", "sa_avg"):
            if self.period is None:
                raise refusal(InvalidOption, "period", owner, f"given for {self.name}", "None")
            as_positive(self.period, "period", owner, InvalidOption)
        if not 0.0 <= as_number(self.damping, "damping", owner, InvalidOption) < 1.0:
            raise refusal(InvalidOption, "damping", owner, "at least 0 and below 1", f"{self.damping:g}")
        low = as_positive(self.low, "low", owner, InvalidOption)
        if not low < as_positive(self.high, "high", owner, InvalidOption):
            raise refusal(InvalidOption, "high", owner, f"above low, {low:g}", f"{self.high:g}")
        as_count(self.points, "points", owner, InvalidOption, least=2)

    @property
    def column(self) -> str:
        """Name of a column of it, with its unit: scale, pga_g, sa_t1_g or sa_avg_g."""
        return _COLUMNS[self.name]

    @property
    def unit(self) -> str:
        """Unit: "g", or nothing for the scale factor."""
        return "" if self.name == "scale" else "g"

    @property
    def label(self) -> str:
        """What axes and texts call it."""
        if self.name == "scale":
            return "scale factor"
        if self.name == "pga":
            return "PGA"
        if self.name == "sa_t1":
            return f"Sa({self.period:.3g} s)"
        return f"Sa,avg({self.low * (self.period or 0.0):.3g} to {self.high * (self.period or 0.0):.3g} s)"

    def of(self, motions: MotionLike | Iterable[MotionLike], *, threads: int | None = None) -> FloatArray:
        """Return the measure of motions as they are, shape (motions,).

        Raises
        ------
        InvalidMotion
            No motion, something else, or a motion that is zero throughout.
        """
        named = named_motions(motions, "intensity measure")
        for name, motion in zip(named.names, named.motions, strict=True):
            if not motion.acceleration.any():
                raise refusal(InvalidMotion, "acceleration", name, "other than zero somewhere", "zero throughout")
        if self.name == "scale":
            return np.ones(len(named))
        if self.name == "pga":
            return np.array([motion.pga_g for motion in named.motions])
        assert self.period is not None
        periods = np.array([self.period])
        if self.name == "sa_avg":
            periods = self.period * np.linspace(self.low, self.high, self.points)
        spectra = response_spectrum(named.motions, periods, self.damping, threads=threads) / STANDARD_GRAVITY
        intensities: FloatArray = spectra[:, 0] if self.name == "sa_t1" else np.exp(np.log(spectra).mean(axis=1))
        return intensities

    def to_dict(self) -> dict[str, Any]:
        """Return what defines it, with its column and label."""
        return {**asdict(self), "column": self.column, "label": self.label}


def intensity_of(
    motion: MotionLike,
    measure: MeasureName | IntensityMeasure = "sa_t1",
    *,
    period: float | None = None,
    damping: float = 0.05,
    low: float = DEFAULT_RANGE[0],
    high: float = DEFAULT_RANGE[1],
    points: int = DEFAULT_POINTS,
) -> float:
    """Return the intensity of one motion as it is.

    Parameters
    ----------
    motion : Motion or Record
        The motion.
    measure : {"scale", "pga", "sa_t1", "sa_avg"} or IntensityMeasure, default "sa_t1"
        The measure; the remaining arguments are those of `IntensityMeasure` and are left out where one is given.
    period, damping, low, high, points
        As for `IntensityMeasure`.

    Raises
    ------
    InvalidOption, InvalidMotion
        An argument is not what it must be.

    Examples
    --------
    >>> import seismass as sm
    >>> motion = sm.Motion([0.0, sm.STANDARD_GRAVITY, 0.0], dt=0.01)
    >>> sm.fragility.intensity_of(motion, "pga")
    1.0
    """
    if not isinstance(measure, IntensityMeasure):
        measure = IntensityMeasure(measure, period, damping, low, high, points)
    return float(measure.of([motion])[0])


def measure_for(measure: MeasureName | IntensityMeasure, scene: Scene, period: float | None = None) -> IntensityMeasure:
    """Return a measure for the models of a scene. T1 is `period`, or else the first period of the building without live
    load, so that a motion has one intensity whatever model it acts on.
    """
    if isinstance(measure, IntensityMeasure):
        if period is not None and period != measure.period:
            requirement = f"left out, or that of the measure, {measure.period}"
            raise refusal(InvalidOption, "period", "intensity measure", requirement, brief(period))
        return measure
    if not is_one_of(measure, ("sa_t1", "sa_avg")):
        return IntensityMeasure(measure)
    if period is None and scene.building is not None:
        period = float(scene.building.periods[0])
    return IntensityMeasure(measure, period)
