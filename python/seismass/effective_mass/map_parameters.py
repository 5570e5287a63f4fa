"""What a map of effective fractions varies and what it holds fixed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import as_count, as_number, brief, refusal
from seismass.design import Combination
from seismass.effective_mass.curve import DEFAULT_FRACTIONS
from seismass.effective_mass.models import SAME_DAMPING, ModelDamping, check_damping
from seismass.model.damping import DEFAULT_DAMPING
from seismass.model.springs import DEFAULT_OVERSTRENGTH, DEFAULT_SECOND_SLOPE, DEFAULT_THIRD_SLOPE

Roof: TypeAlias = Literal["bare", "loaded"]
"""Whether the roof carries goods as the other floors do."""
MapBuilding: TypeAlias = tuple[int, float, Roof]
"""Number of storeys, first period of the bare building (s), and roof."""

DEFAULT_BUILDINGS: Final[tuple[MapBuilding, ...]] = (
    (1, 0.2, "loaded"),
    (1, 0.4, "loaded"),
    (1, 0.8, "loaded"),
    (1, 1.6, "loaded"),
    (2, 0.2, "bare"),
    (2, 0.38, "bare"),
    (2, 0.8, "bare"),
    (3, 0.25, "bare"),
    (3, 0.47, "bare"),
    (3, 1.0, "bare"),
    (3, 0.6, "loaded"),
    (4, 0.3, "bare"),
    (4, 0.57, "bare"),
    (4, 1.2, "bare"),
    (6, 0.6, "bare"),
    (6, 1.2, "bare"),
)


@dataclass(frozen=True)
class EffectiveMassParameters:
    """What a map varies and what it holds fixed.

    Attributes
    ----------
    buildings : tuple of (int, float, {"bare", "loaded"})
        Number of storeys, first period of the bare building (s), roof.
    mass_ratios : tuple of float
        Mass of the goods over that of their floor, alpha, the same on every loaded floor.
    response_modification : tuple of float
        R; V_y = V_e/R of the building designed with `design_fraction`. R = 1 is elastic unless `yield_at_r1`.
    mus : tuple of float
        Friction coefficients, static and kinetic.
    intensities : tuple of float
        Factors of the scaled motions, strengths unchanged. Intensity s with V_y and mu is exactly intensity 1 with
        V_y/s and mu/s.
    design_fraction : float
        Share of the live load in the design of the strengths.
    overstrength, second_slope, third_slope, damping
        Of all buildings; the slopes are inferences.
    scaling_period : float
        Period (s) for which motions are scaled.
    combination : {"srss", "cqc"}
        Modal combination of the design.
    yield_at_r1 : bool
        Let R = 1 yield at V_e.
    model_damping : {"same", "ratio"}
        Damping of the models, see `attached_scene`.
    confidence, resamples, seed
        Of the bootstrap intervals.
    shares : int
        Number of shares from 0 to 1 at which models are solved; crossings are interpolated between them.

    Raises
    ------
    InvalidOption
        A parameter is out of its range or of another kind.
    """

    buildings: tuple[MapBuilding, ...] = DEFAULT_BUILDINGS
    mass_ratios: tuple[float, ...] = (0.25, 0.5, 1.0, 1.5)
    response_modification: tuple[float, ...] = (1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0)
    mus: tuple[float, ...] = (0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1.2)
    intensities: tuple[float, ...] = (1.0,)
    design_fraction: float = 0.25
    overstrength: float = DEFAULT_OVERSTRENGTH
    second_slope: float = DEFAULT_SECOND_SLOPE
    third_slope: float = DEFAULT_THIRD_SLOPE
    damping: float = DEFAULT_DAMPING
    scaling_period: float = 1.0
    combination: Combination = "srss"
    yield_at_r1: bool = False
    model_damping: ModelDamping = SAME_DAMPING
    confidence: float = 0.90
    resamples: int = 500
    seed: int = 0
    shares: int = len(DEFAULT_FRACTIONS)

    def __post_init__(self) -> None:
        """Judge the axes and keep numbers as Python's own; building, design and scaling judge the rest."""
        owner = "effective mass map"
        buildings = []
        for building in _listed(self.buildings, "buildings"):
            if not isinstance(building, tuple) or len(building) != 3 or building[2] not in get_args(Roof):
                requirement = 'a tuple of (storeys, period, "bare" or "loaded")'
                raise refusal(InvalidOption, "buildings", owner, requirement, f"{brief(building)} in it")
            storeys = as_count(building[0], "storeys", owner, InvalidOption, least=1)
            if storeys == 1 and building[2] == "bare":
                raise refusal(InvalidOption, "roof", owner, "loaded where it is the only floor", "bare")
            buildings.append((storeys, _number(building[1], "period", above=0.0), building[2]))
        checked: dict[str, Any] = {"buildings": tuple(buildings)}
        above, least = {"mass_ratios": 0.0, "intensities": 0.0}, {"response_modification": 1.0, "mus": 0.0}
        for name in (*above, *least):
            values = _listed(getattr(self, name), name)
            checked[name] = tuple(
                _number(value, name, above=above.get(name), least=least.get(name)) for value in values
            )
        for name, values in checked.items():
            if len(set(values)) != len(values):
                raise refusal(InvalidOption, name, owner, "a tuple of values, none twice", brief(values))
        for name in ("design_fraction", "confidence"):
            checked[name] = _number(getattr(self, name), name, least=0.0)
            if checked[name] > 1.0:
                raise refusal(InvalidOption, name, owner, "between 0 and 1", f"{checked[name]:g}")
        if not 0.0 < checked["confidence"] < 1.0:
            raise refusal(InvalidOption, "confidence", owner, "above 0 and below 1", f"{checked['confidence']:g}")
        for name in ("overstrength", "second_slope", "third_slope", "damping", "scaling_period"):
            checked[name] = _number(getattr(self, name), name, least=0.0)
        checked["resamples"] = as_count(self.resamples, "resamples", owner, InvalidOption, least=1)
        checked["shares"] = as_count(self.shares, "shares", owner, InvalidOption, least=2)
        checked["seed"] = as_count(self.seed, "seed", owner, InvalidOption)
        check_damping(self.model_damping, owner)
        for name, value in checked.items():
            object.__setattr__(self, name, value)


def _listed(values: Any, name: str) -> tuple[Any, ...]:
    if not isinstance(values, tuple) or not values:
        raise refusal(InvalidOption, name, "effective mass map", "a tuple of at least one value", brief(values))
    return values


def _number(value: Any, name: str, *, above: float | None = None, least: float | None = None) -> float:
    number = as_number(value, name, "effective mass map", InvalidOption)
    if not np.isfinite(number) or (above is not None and number <= above) or (least is not None and number < least):
        requirement = f"above {above:g}" if above is not None else f"at least {least:g}"
        raise refusal(InvalidOption, name, "effective mass map", requirement, f"{number:g}")
    return number
