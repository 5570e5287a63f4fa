"""Fragility of buildings with sliding goods, and what a code's model makes of it: intensities, limit states, fits."""

from seismass.intensity.analysis import cloud_analysis, incremental_dynamic_analysis, multiple_stripes
from seismass.intensity.fragility import Fragility, fit_capacities, fit_cloud, fit_counts
from seismass.intensity.hunt import HuntAndFill
from seismass.intensity.limits import LimitState, parse_limit
from seismass.intensity.measures import IntensityMeasure, intensity_of
from seismass.intensity.models import compared_models
from seismass.intensity.result import IntensityAnalysis
from seismass.intensity.run import solve_grid

__all__ = [
    "Fragility",
    "HuntAndFill",
    "IntensityAnalysis",
    "IntensityMeasure",
    "LimitState",
    "cloud_analysis",
    "compared_models",
    "fit_capacities",
    "fit_cloud",
    "fit_counts",
    "incremental_dynamic_analysis",
    "intensity_of",
    "multiple_stripes",
    "parse_limit",
    "solve_grid",
]
