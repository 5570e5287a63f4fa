"""What the rule by hand says of one building under one suite, beside the numbers that it takes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seismass.base.values import FloatArray
from seismass.design import response_spectrum_analysis
from seismass.effective_mass.estimate import base_shear_by_hand, best_estimate, exponent, height_ratio
from seismass.effective_mass.models import building_of, frame_mass, friction, full_weight, goods_mass
from seismass.effective_mass.plane_runs import LARGER, DriftMeasure
from seismass.effective_mass.runs import NamedMotions, Peaks
from seismass.effective_mass.two_directions import friction_factor
from seismass.model.building import Building
from seismass.model.scene import Scene
from seismass.spectra import corner_period, mean_spectrum


@dataclass(frozen=True, slots=True)
class ByHand:
    """The rule for one building and one suite.

    Attributes
    ----------
    period : float
        First period of the building without goods (s).
    corner_period : float
        T_c of the motions (s), see `seismass.spectra.corner_period`.
    yields : bool
        Whether a storey of the building with all goods attached yields: its mean peak drift over the motions is above
        that of its yield force.
    height_ratio : float
        Mean height of the goods by mass, over that of building and goods together.
    exponent : float
        p of the rule.
    base_shear_coefficient : float
        C1 without a run, see `seismass.effective_mass.estimate.base_shear_by_hand`.
    eta : float
        mu_k over that coefficient.
    estimate : float
        The best estimate with that eta.
    """

    period: float
    corner_period: float
    yields: bool
    height_ratio: float
    exponent: float
    base_shear_coefficient: float
    eta: float
    estimate: float


def by_hand(scene: Scene, motions: NamedMotions, full: Peaks, drift: DriftMeasure = LARGER) -> ByHand:
    """Return what the rule says of the building of a scene; `full` has the peaks of the fully attached model. Goods on
    racks count on the floor of the rack; in two directions it is that in y if `drift` is, else in x.
    """
    if drift == "y" and isinstance(scene.other_direction, Building):
        scene = scene.replace(building=scene.other_direction, other_direction=True)
    yields = bool((full.drift.mean(axis=1)[-1] > yield_drift(building_of(scene))).any())
    return rule_by_hand(scene, motions, yields)


def rule_by_hand(scene: Scene, motions: NamedMotions, yields: bool) -> ByHand:
    """Return what the rule says of the building of a scene that yields, or does not, with all goods attached."""
    building, goods = building_of(scene), goods_mass(scene)
    mass, walls = building.mass + frame_mass(scene), building.stiffness_matrix

    components = motions.components

    def spectrum(periods: FloatArray) -> FloatArray:
        return mean_spectrum(components, np.ones(len(components)), periods)

    elastic = response_spectrum_analysis(mass + goods, building.stiffness, spectrum, stiffness_matrix=walls)
    weight = full_weight(scene)
    corner, period = corner_period(spectrum), float(building.periods[0])
    heights = height_ratio(goods, mass, building.heights)
    # Elastic walls set no limit to the base shear.
    strength = building.yield_shear[0] if walls is None else np.inf
    power = float(exponent(period, corner, yields))
    coefficient = float(
        base_shear_by_hand(
            strength / weight,
            elastic.storey_shear[0] / weight,
            elastic.modes.periods[0],
            corner,
            building.second_slope[0],
            building.overstrength[0],
        )
    )
    eta = friction(scene) / coefficient
    estimate = float(best_estimate(friction_factor(scene) * eta, power, heights))
    return ByHand(period, corner, yields, heights, power, coefficient, eta, estimate)


def yield_drift(building: Building) -> FloatArray:
    """Return the drift of each storey at V_y, in the measure of `Peaks.drift`: a ratio where heights are known."""
    with np.errstate(divide="ignore"):  # beside walls a storey may be without a spring
        drift = building.yield_shear / building.stiffness
    found: FloatArray = drift if building.heights is None else drift / building.heights
    return found
