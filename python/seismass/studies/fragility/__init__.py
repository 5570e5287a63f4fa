"""Fragility of buildings with sliding goods, and what a code's model makes of it: intensities, limit states, fits."""

from seismass.studies.fragility.analysis import cloud_analysis, incremental_dynamic_analysis, multiple_stripes
from seismass.studies.fragility.estimate import fit_capacities, fit_cloud, fit_counts
from seismass.studies.fragility.fragility import Fragility
from seismass.studies.fragility.hunt import HuntAndFill
from seismass.studies.fragility.limits import IntensityMeasure, LimitState, intensity_of, parse_limit
from seismass.studies.fragility.result import FragilityAnalysis
from seismass.studies.fragility.run import compared_models, solve_grid

__all__ = [
    "Fragility",
    "FragilityAnalysis",
    "HuntAndFill",
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

__dir__ = __all__.copy  # for completion
