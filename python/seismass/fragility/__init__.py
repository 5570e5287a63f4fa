"""Fragility of buildings with sliding goods, and what a code's model makes of it: intensities, limit states, fits."""

from seismass.fragility.analysis import cloud_analysis, incremental_dynamic_analysis, multiple_stripes
from seismass.fragility.fits import fit_capacities, fit_cloud, fit_counts
from seismass.fragility.fragility import Fragility
from seismass.fragility.hunt import HuntAndFill
from seismass.fragility.limits import LimitState, parse_limit
from seismass.fragility.measures import IntensityMeasure, intensity_of
from seismass.fragility.models import compared_models
from seismass.fragility.result import FragilityAnalysis
from seismass.fragility.run import solve_grid

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


def __dir__() -> list[str]:
    """Return the public names, for completion."""
    return list(__all__)
