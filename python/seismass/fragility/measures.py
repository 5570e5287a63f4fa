"""Intensity measures of ground motions: the scale factor, PGA, Sa(T1), and the average of Sa over a range of periods.

Each of them is proportional to the scale factor, so that one value per motion describes all its scalings.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np

from seismass.base.errors import InvalidMotion, InvalidOption
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_count, as_number, as_positive, brief, is_one_of, refusal
from seismass.effective_mass.runs import named_motions
from seismass.model.motion import MotionLike
from seismass.model.scene import Scene
from seismass.spectra import response_spectrum

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
        if not is_one_of(self.name, get_args(MeasureName)):
            raise refusal(InvalidOption, "name", owner, f"one of {', '.join(get_args(MeasureName))}", brief(self.name))
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
        found: FloatArray = spectra[:, 0] if self.name == "sa_t1" else np.exp(np.log(spectra).mean(axis=1))
        return found

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
    measure : {"scale", "pga", "sa_t1", "sa_avg"} or IntensityMeasure
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
