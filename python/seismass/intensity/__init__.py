"""Fragility of buildings with sliding goods, and what a code's model makes of it: intensities, limit states, fits."""

from seismass.intensity.fragility import Fragility, fit_capacities, fit_cloud, fit_counts
from seismass.intensity.limits import LimitState, parse_limit
from seismass.intensity.measures import IntensityMeasure, intensity_of
from seismass.intensity.models import compared_models
from seismass.intensity.run import solve_grid

__all__ = [
    "Fragility",
    "IntensityMeasure",
    "LimitState",
    "compared_models",
    "fit_capacities",
    "fit_cloud",
    "fit_counts",
    "intensity_of",
    "parse_limit",
    "solve_grid",
]
