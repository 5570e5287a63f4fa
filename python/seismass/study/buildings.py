"""The buildings of a study, each designed by the code and with its three models: real, code, attached."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any, Final, Literal, TypeAlias, get_args

import numpy as np

from seismass.base.units import STANDARD_GRAVITY
from seismass.base.values import FloatArray, short_repr
from seismass.base.views import Card
from seismass.design import SpectrumAnalysis, response_spectrum_analysis, vibration_modes
from seismass.model.block import blocks_on_floors
from seismass.model.building import Building
from seismass.model.scene import Scene
from seismass.study.parameters import StudyParameters

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
        goods = _on_floors(ratio, storeys)
        analysis = analyses[storeys, period, design * ratio]
        elastic = reduction == 1.0 and not parameters.yield_at_r1
        yield_shear = np.full(storeys, np.inf) if elastic else analysis.storey_shear / reduction
        strength = (reduction, np.inf if elastic else design * ratio)
        models: dict[Model, Scene] = {}
        # A scene is made once for all buildings that differ in what it does not depend on.
        own: dict[Model, tuple[float | str, ...]] = {"real": (mu,), "code": (counted,), "attached": ()}
        for model, further in own.items():
            name = (model, storeys, period, ratio, *strength, *further)
            if name not in scenes:
                scenes[name] = _scene(model, bare[storeys, period], yield_shear, goods, counted, mu, parameters)
            models[model] = scenes[name]
        yield StudyBuilding(
            labels=dict(
                zip(KEYS, (number, occupancy, design, counted, storeys, period, reduction, ratio, mu), strict=True)
            ),
            analysis=analysis,
            design_mass=1.0 + design * goods,
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
    goods = np.full(storeys, ratio)
    goods[-1] = 0.0
    return goods


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
    goods: FloatArray,
    counted: float,
    mu: float,
    parameters: StudyParameters,
) -> Scene:
    """A model of a building: goods that slide on it, or a share of their mass attached to it."""
    limit = parameters.collapse_drift_ratio
    collapse = None if limit is None else limit * parameters.height
    attached = {"real": 0.0, "code": counted, "attached": 1.0}[model] * goods
    changes: dict[str, Any] = {"yield_shear": yield_shear}
    if parameters.damping_base == "loaded":
        changes["damping"] = bare.replace(mass=bare.mass + goods).damping_matrix
    elif parameters.damping_base == "bare" and attached.any():
        changes["damping"] = bare.damping_matrix
    if model == "real":
        return Scene(bare.replace(**changes), blocks_on_floors(goods, mu), collapse_drift=collapse)
    if parameters.p_delta:
        # The goods' whole weight acts, whatever share of their mass is counted.
        changes["gravity_load"] = None
        changes["geometric_stiffness"] = Scene(bare, blocks_on_floors(goods, mu)).geometric_stiffness
    return Scene(bare.replace(mass=bare.mass + attached, **changes), collapse_drift=collapse)
