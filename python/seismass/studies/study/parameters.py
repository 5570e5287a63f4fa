"""What a parametric study varies and what it fixes; every choice has a name, a default and a range."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import asdict, dataclass
from itertools import product
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np

from seismass.base.arguments import as_word
from seismass.base.errors import InvalidOption
from seismass.base.statistics import DRIFT_CAP
from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, as_count, as_number, as_one_of, brief, refusal, short_repr
from seismass.base.views import Card
from seismass.design import Combination, SpectrumAnalysis, response_spectrum_analysis, vibration_modes
from seismass.model.block import blocks_on_floors
from seismass.model.building import DEFAULT_DAMPING, Building
from seismass.model.codes import CodeFraction, code_fraction
from seismass.model.scene import Scene
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
    drift_cap : float
        Drift over height above which a drift counts as it in means and their ratios.

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
    drift_cap: float = DRIFT_CAP

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
            "drift_cap": _within("drift_cap", self.drift_cap, _TINY, _HUGE, "a positive number"),
        }
        self._unique("buildings", buildings)
        for name, choices in (("combination", get_args(Combination)), ("damping_base", get_args(DampingBase))):
            as_word(getattr(self, name), choices, name, "study")
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

    def _tuples(self, name: str, kind: str, lengths: tuple[int, ...]) -> tuple[Any, ...]:
        for item in self._listed(name):
            if not isinstance(item, tuple) or len(item) not in lengths:
                raise refusal(InvalidOption, name, "study", f"a tuple of {kind}", f"{brief(item)} in it")
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
    fractions = {"storage": code_fraction(code, "storage")}
    with suppress(InvalidOption):
        fractions["commercial"] = code_fraction(code, "ordinary")
    return fractions


def _of_code(code: str) -> tuple[tuple[str, float, float], ...]:
    return tuple((name, row.fraction, row.fraction) for name, row in code_fractions(code).items())


def _within(name: str, value: Any, low: float, high: float, requirement: str) -> float:
    number = as_number(value, name, "study", InvalidOption)
    if not low <= number <= high:
        raise refusal(InvalidOption, name, "study", requirement, f"{number:g}")
    return number


Model: TypeAlias = Literal["real", "code", "attached"]
"""Goods that may slide; the code's share of their mass attached and no block; all of it attached and no block."""
MODELS: Final = get_args(Model)

KEYS: Final = (
    "building",
    "occupancy",
    "lambda_design",
    "lambda_analysis",
    "storeys",
    "period",
    "R",
    "alpha",
    "mu",
)
"""Columns that identify a building in every table."""


@dataclass(frozen=True, eq=False)
class StudyBuilding(Card):
    """One building of the grid with its models.

    Attributes
    ----------
    labels : dict
        building (number from 1), occupancy, lambda_design, lambda_analysis, storeys, period, R, alpha, mu: the key
        columns of the tables.
    analysis : SpectrumAnalysis
        Response spectrum analysis of the design model, with V_e.
    design_mass : ndarray, shape (storeys,)
        Floor masses of the design model (kg).
    yield_shear : ndarray, shape (storeys,)
        V_y (N, for floor masses of 1 kg); infinite where the building stays elastic.
    scenes : dict of Model to Scene
        The models.
    """

    labels: dict[str, Any]
    analysis: SpectrumAnalysis
    design_mass: FloatArray
    yield_shear: FloatArray
    scenes: dict[Model, Scene]

    __repr__ = short_repr


def study_buildings(
    parameters: StudyParameters, spectrum: Callable[[FloatArray], FloatArray]
) -> Iterator[StudyBuilding]:
    """Yield the buildings of the grid, designed for a pseudo-acceleration spectrum (m/s2 at periods in s).

    Floor masses are 1 kg: drifts do not depend on them. Strengths come from the model that the code prescribes, the
    building with the share lambda alpha of its floor mass attached to every floor but the roof. Friction changes
    slowest: the first buildings are those of the first coefficient.
    """
    as_one_of(parameters, StudyParameters, "parameters", "study", InvalidOption)
    if not callable(spectrum):
        raise refusal(InvalidOption, "spectrum", "study", "a function of periods", brief(spectrum))
    bare = {(storeys, period): _bare(parameters, storeys, period) for storeys, period in parameters.buildings}
    analyses = _analyses(parameters, bare, spectrum)
    scenes: dict[tuple[float | str, ...], Scene] = {}
    grid = product(
        parameters.mu,
        parameters.fractions,
        parameters.buildings,
        parameters.response_modification,
        parameters.mass_ratios,
    )
    for number, (mu, (occupancy, design, counted), (storeys, period), reduction, ratio) in enumerate(grid, start=1):
        goods_mass = _on_floors(ratio, storeys)
        analysis = analyses[storeys, period, design * ratio]
        elastic = reduction == 1.0 and not parameters.yield_at_r1
        yield_shear = np.full(storeys, np.inf) if elastic else analysis.storey_shear / reduction
        strength = (reduction, np.inf if elastic else design * ratio)
        models: dict[Model, Scene] = {}
        # A scene is made once for all buildings that differ in what it does not depend on.
        options: dict[Model, tuple[float | str, ...]] = {"real": (mu,), "code": (counted,), "attached": ()}
        for model, further in options.items():
            name = (model, storeys, period, ratio, *strength, *further)
            if name not in scenes:
                scenes[name] = _scene(model, bare[storeys, period], yield_shear, goods_mass, counted, mu, parameters)
            models[model] = scenes[name]
        yield StudyBuilding(
            labels=dict(
                zip(KEYS, (number, occupancy, design, counted, storeys, period, reduction, ratio, mu), strict=True)
            ),
            analysis=analysis,
            design_mass=1.0 + design * goods_mass,
            yield_shear=yield_shear,
            scenes=models,
        )


def _bare(parameters: StudyParameters, storeys: int, period: float) -> Building:
    return Building.uniform(
        storeys,
        period,
        mass=1.0,
        overstrength=parameters.overstrength,
        second_slope=parameters.second_slope,
        third_slope=parameters.third_slope,
        damping=parameters.damping,
        heights=parameters.height,
        gravity_load=STANDARD_GRAVITY if parameters.p_delta else None,
    )


def _on_floors(ratio: float, storeys: int) -> FloatArray:
    """Goods of every floor (kg): none on the roof."""
    goods_mass = np.full(storeys, ratio)
    goods_mass[-1] = 0.0
    return goods_mass


def _analyses(
    parameters: StudyParameters,
    bare: dict[tuple[int, float], Building],
    spectrum: Callable[[FloatArray], FloatArray],
) -> dict[tuple[int, float, float], SpectrumAnalysis]:
    """Analyses of all design models, by storeys, period and lambda alpha; the spectrum is asked once, for all modes."""
    shares = {fraction * ratio for _, fraction, _ in parameters.fractions for ratio in parameters.mass_ratios}
    models = {
        (*key, share): (building.mass + _on_floors(share, building.storeys), building.stiffness)
        for key, building in bare.items()
        for share in sorted(shares)
    }
    periods = [vibration_modes(*model).periods for model in models.values()]
    ordinates = np.split(spectrum(np.concatenate(periods)), np.cumsum([len(each) for each in periods])[:-1])
    return {
        key: response_spectrum_analysis(
            *model,
            lambda _, known=known: known,  # type: ignore[misc]
            combination=parameters.combination,
            damping=parameters.damping,
        )
        for (key, model), known in zip(models.items(), ordinates, strict=True)
    }


def _scene(
    model: Model,
    bare: Building,
    yield_shear: FloatArray,
    goods_mass: FloatArray,
    counted: float,
    mu: float,
    parameters: StudyParameters,
) -> Scene:
    """A model of a building: goods that slide on it, or a share of their mass attached to it."""
    limit = parameters.collapse_drift_ratio
    collapse = None if limit is None else limit * parameters.height
    attached = {"real": 0.0, "code": counted, "attached": 1.0}[model] * goods_mass
    changes: dict[str, Any] = {"yield_shear": yield_shear}
    if parameters.damping_base == "loaded":
        changes["damping"] = bare.replace(mass=bare.mass + goods_mass).damping_matrix
    elif parameters.damping_base == "bare" and attached.any():
        changes["damping"] = bare.damping_matrix
    if model == "real":
        return Scene(bare.replace(**changes), blocks_on_floors(goods_mass, mu), collapse_drift=collapse)
    if parameters.p_delta:
        # The goods' whole weight acts, whatever share of their mass is counted.
        changes["gravity_load"] = None
        changes["geometric_stiffness"] = Scene(bare, blocks_on_floors(goods_mass, mu)).geometric_stiffness
    return Scene(bare.replace(mass=bare.mass + attached, **changes), collapse_drift=collapse)
