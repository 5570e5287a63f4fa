"""Design of shear buildings and walls: modes, spectrum analysis, lateral forces, weights, limits of codes, pushover.

Numbers of codes have their clause and say how they were checked, in the words of `seismass.codes.code_table`.
"""

from seismass.design.lateral_force import (
    DISTRIBUTION_CODES,
    DistributionRule,
    LateralForces,
    distribution_table,
    equivalent_lateral_forces,
    exponent_k,
    seismic_response_coefficient,
)
from seismass.design.limits import (
    DRIFT_LIMIT_CODES,
    THETA_CAP,
    THETA_THRESHOLD,
    DriftLimit,
    drift_limit,
    drift_limit_table,
    stability_coefficient,
    stability_limit,
    storey_checks,
)
from seismass.design.modes import Combination, Modes, combined_modes, modal_correlation, vibration_modes
from seismass.design.periods import (
    PERIOD_CODES,
    CodePeriod,
    PeriodRule,
    code_period,
    period_table,
    upper_limit_coefficient,
)
from seismass.design.pushover import Pattern, Pushover, pushover
from seismass.design.pushover_fit import PushoverFit, fit_pushover
from seismass.design.spectrum_analysis import (
    MODAL_BASE_SHEAR_SHARE,
    DesignDemand,
    SpectrumAnalysis,
    response_spectrum_analysis,
)
from seismass.design.systems import SystemFactors, importance_factor, system_factors, system_table
from seismass.design.walls import Wall
from seismass.design.weight import FloorUse, SeismicWeight, effective_seismic_weight

__all__ = [
    "DISTRIBUTION_CODES",
    "DRIFT_LIMIT_CODES",
    "MODAL_BASE_SHEAR_SHARE",
    "PERIOD_CODES",
    "THETA_CAP",
    "THETA_THRESHOLD",
    "CodePeriod",
    "Combination",
    "DesignDemand",
    "DistributionRule",
    "DriftLimit",
    "FloorUse",
    "LateralForces",
    "Modes",
    "Pattern",
    "PeriodRule",
    "Pushover",
    "PushoverFit",
    "SeismicWeight",
    "SpectrumAnalysis",
    "SystemFactors",
    "Wall",
    "code_period",
    "combined_modes",
    "distribution_table",
    "drift_limit",
    "drift_limit_table",
    "effective_seismic_weight",
    "equivalent_lateral_forces",
    "exponent_k",
    "fit_pushover",
    "importance_factor",
    "modal_correlation",
    "period_table",
    "pushover",
    "response_spectrum_analysis",
    "seismic_response_coefficient",
    "stability_coefficient",
    "stability_limit",
    "storey_checks",
    "system_factors",
    "system_table",
    "upper_limit_coefficient",
    "vibration_modes",
]


def __dir__() -> list[str]:
    """Return the public names, for completion."""
    return list(__all__)
