"""What a parametric study varies and what it fixes; every choice has a name, a default and a range."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import asdict, dataclass
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np

from seismass.base.errors import InvalidOption
from seismass.base.values import as_count, as_number, brief, refusal
from seismass.design import Combination
from seismass.model.codes import CodeFraction, code_fraction
from seismass.model.damping import DEFAULT_DAMPING
from seismass.model.springs import DEFAULT_OVERSTRENGTH, DEFAULT_SECOND_SLOPE, DEFAULT_THIRD_SLOPE

DampingBase: TypeAlias = Literal["bare", "loaded", "own"]
"""The building in whose modes the damping ratio holds: bare, with all its goods attached, or each model's own."""

DEFAULT_CODE: Final = "asce7-10"
"""The code of the paper."""
DEFAULT_HEIGHT: Final = 3.5
"""Storey height (m): usual for a storage building; the paper gives none."""

_LISTED: Final = "a tuple of at least one value, none twice"
_OCCUPANCY: Final = "(name, lambda) or (name, lambda of the design, lambda of the analysis)"
_TINY: Final = float(np.nextafter(0.0, 1.0))
_HUGE: Final = float(np.finfo(np.float64).max)


@dataclass(frozen=True)
class StudyParameters:
    """What is varied and what is fixed; the defaults are the paper's, or inferred where it says nothing.

    Attributes
    ----------
    buildings : tuple of (int, float)
        Number of storeys and first period of the bare building (s).
    response_modification : tuple of float
        Factors R; V_y = V_e/R. R = 1 is elastic unless `yield_at_r1`.
    mass_ratios : tuple of float
        Block mass over floor mass, alpha, the same on every floor but the roof, which is bare.
    occupancies : tuple of (str, float) or (str, float, float), or None
        Name, no two the same, with the fraction lambda of the block mass that the code counts. Two fractions are that
        of the design, which sets the strength, and that of the analysis, the mass of the code model; one is both. None
        (default): storage and commercial buildings with the fractions of `code`.
    code : str
        Code whose fractions are compared, an identifier of `seismass.model.codes`.
    mu : tuple of float
        Friction coefficients, static and kinetic.
    overstrength, second_slope, third_slope : float
        Omega, r2, r3 of the storeys. The paper states none of them for its study: Omega is that of its section 4,
        r2 = 0.05 and r3 = 0 are inferred.
    damping : float
        Ratio of critical in every mode of the building that `damping_base` names. Also that of the spectra.
    damping_base : {"bare", "loaded", "own"}
        Whose modes have that ratio. "bare": the building without goods, whose matrix C all models have; "loaded": the
        building with all its goods attached, whose C all models have; "own": each model has a C of its own, with the
        ratio in the modes of its own masses. The paper does not say; its equation 1 has the masses of the bare
        building only.
    scaling_period : float
        Fundamental period T (s) for which motions are scaled, from 0.2 T to 1.5 T.
    combination : {"srss", "cqc"}
        Modal combination of the response spectrum analysis.
    yield_at_r1 : bool
        Let R = 1 yield at V_e.
    height : float
        Height of every storey (m), for drift ratios, P-Delta and the limit of collapse.
    p_delta : bool
        Second-order effect of the weight of building and goods. All models of a building have the same P/h, that of
        the real one: a code counts mass, and the goods weigh what they weigh.
    collapse_drift_ratio : float, optional
        Drift over height at which a storey counts as collapsed and the run ends.

    Raises
    ------
    InvalidOption
        A parameter is out of its range or of another kind.
    """

    buildings: tuple[tuple[int, float], ...] = ((2, 0.38), (3, 0.47), (4, 0.57))
    response_modification: tuple[float, ...] = (1.0, 2.0, 4.0, 6.0)
    mass_ratios: tuple[float, ...] = (0.5, 1.0, 1.5)
    occupancies: tuple[tuple[str, float] | tuple[str, float, float], ...] | None = None
    code: str = DEFAULT_CODE
    mu: tuple[float, ...] = (0.4,)
    overstrength: float = DEFAULT_OVERSTRENGTH
    second_slope: float = DEFAULT_SECOND_SLOPE
    third_slope: float = DEFAULT_THIRD_SLOPE
    damping: float = DEFAULT_DAMPING
    damping_base: DampingBase = "bare"
    scaling_period: float = 1.0
    combination: Combination = "srss"
    yield_at_r1: bool = False
    height: float = DEFAULT_HEIGHT
    p_delta: bool = False
    collapse_drift_ratio: float | None = None

    def __post_init__(self) -> None:
        """Keep numbers as Python's own, so that equal parameters have the same digest."""
        buildings = [
            (
                as_count(storeys, "storeys", "study", InvalidOption, least=1),
                _within("period", period, _TINY, _HUGE, "a positive number"),
            )
            for storeys, period in self._tuples("buildings", "(storeys, period)", (2,))
        ]
        second_slope = _within("second_slope", self.second_slope, 0.0, 1.0, "between 0 and 1")
        limit = self.collapse_drift_ratio
        checked = {
            "buildings": tuple(buildings),
            "response_modification": self._numbers("response_modification", 1.0, "at least 1"),
            "mass_ratios": self._numbers("mass_ratios", _TINY, "positive"),
            "occupancies": self._occupancies(),
            "mu": self._numbers("mu", 0.0, "zero or positive"),
            "overstrength": _within("overstrength", self.overstrength, 1.0, _HUGE, "a number of at least 1"),
            "second_slope": second_slope,
            "third_slope": _within(
                "third_slope", self.third_slope, 0.0, second_slope, "between 0 and the second slope"
            ),
            "damping": _within("damping", self.damping, _TINY, np.nextafter(1.0, 0.0), "above 0 and below 1"),
            "scaling_period": _within("scaling_period", self.scaling_period, _TINY, _HUGE, "a positive number"),
            "height": _within("height", self.height, _TINY, _HUGE, "a positive number"),
            "collapse_drift_ratio": None
            if limit is None
            else _within("collapse_drift_ratio", limit, _TINY, _HUGE, "a positive number"),
        }
        self._unique("buildings", buildings)
        for name, choices in (("combination", get_args(Combination)), ("damping_base", get_args(DampingBase))):
            if getattr(self, name) not in choices:
                requirement = f"{', '.join(choices[:-1])} or {choices[-1]}"
                raise refusal(InvalidOption, name, "study", requirement, brief(getattr(self, name)))
        for name in ("yield_at_r1", "p_delta"):
            if not isinstance(getattr(self, name), bool):
                raise refusal(InvalidOption, name, "study", "True or False", brief(getattr(self, name)))
        for name, value in checked.items():
            object.__setattr__(self, name, value)

    @property
    def fractions(self) -> tuple[tuple[str, float, float], ...]:
        """Each occupancy with the lambda of the design and that of the analysis."""
        if self.occupancies is None:
            return _of_code(self.code)
        return tuple((row[0], row[1], row[-1]) for row in self.occupancies)

    @property
    def follows_code(self) -> bool:
        """Whether the occupancies have the fractions of `code`."""
        return self.fractions == _of_code(self.code)

    def _listed(self, name: str) -> tuple[Any, ...]:
        values = getattr(self, name)
        if not isinstance(values, tuple) or not values:
            raise refusal(InvalidOption, name, "study", _LISTED, brief(values))
        return values

    def _unique(self, name: str, keys: list[Any]) -> None:
        if len(set(keys)) != len(keys):
            raise refusal(InvalidOption, name, "study", _LISTED, brief(getattr(self, name)))

    def _numbers(self, name: str, low: float, requirement: str) -> tuple[float, ...]:
        numbers = [_within(name, value, low, _HUGE, requirement) for value in self._listed(name)]
        self._unique(name, numbers)
        return tuple(numbers)

    def _tuples(self, name: str, of: str, lengths: tuple[int, ...]) -> tuple[Any, ...]:
        for item in self._listed(name):
            if not isinstance(item, tuple) or len(item) not in lengths:
                raise refusal(InvalidOption, name, "study", f"a tuple of {of}", f"{brief(item)} in it")
        return self._listed(name)

    def content(self) -> dict[str, Any]:
        """Return all parameters by name, the occupancies with the fractions of design and analysis."""
        return {**asdict(self), "occupancies": self.fractions}

    def _occupancies(self) -> tuple[tuple[str, float, float], ...] | None:
        _of_code(self.code)
        if self.occupancies is None:
            return None
        rows = []
        for name, *fractions in self._tuples("occupancies", _OCCUPANCY, (2, 3)):
            if not isinstance(name, str):
                raise refusal(InvalidOption, "occupancy name", "study", "a string", brief(name))
            design, analysis = (_within("lambda", fractions[end], 0.0, 1.0, "between 0 and 1") for end in (0, -1))
            rows.append((name, design, analysis))
        self._unique("occupancies", [row[0] for row in rows])
        return tuple(rows)


def code_fractions(code: str) -> dict[str, CodeFraction]:
    """Return what a code counts for each occupancy of the paper, those that it says nothing of left out."""
    found = {"storage": code_fraction(code, "storage")}
    with suppress(InvalidOption):
        found["commercial"] = code_fraction(code, "ordinary")
    return found


def _of_code(code: str) -> tuple[tuple[str, float, float], ...]:
    return tuple((name, row.fraction, row.fraction) for name, row in code_fractions(code).items())


def _within(name: str, value: Any, low: float, high: float, requirement: str) -> float:
    number = as_number(value, name, "study", InvalidOption)
    if not low <= number <= high:
        raise refusal(InvalidOption, name, "study", requirement, f"{number:g}")
    return number
