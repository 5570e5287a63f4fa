"""Names of the module, imported when they are first used; `__init__.py` reads them here."""

from . import scaling
from .archetype import DesignedBuilding, designed_building
from .code_design import CodeDesign, DesignEntry, design_by_code
from .lateral_force import (
    DISTRIBUTION_CODES,
    DistributionRule,
    LateralForces,
    distribution_table,
    equivalent_lateral_forces,
    exponent_k,
    seismic_response_coefficient,
)
from .limits import (
    DRIFT_LIMIT_CODES,
    THETA_CAP,
    THETA_THRESHOLD,
    DriftLimit,
    SystemFactors,
    drift_limit,
    drift_limit_table,
    importance_factor,
    stability_coefficient,
    stability_limit,
    storey_checks,
    system_factors,
    system_table,
)
from .modes import (
    MODAL_BASE_SHEAR_SHARE,
    Combination,
    DesignDemand,
    Modes,
    SpectrumAnalysis,
    combined_modes,
    modal_correlation,
    response_spectrum_analysis,
    vibration_modes,
)
from .periods import (
    PERIOD_CODES,
    CodePeriod,
    PeriodRule,
    code_period,
    period_table,
    upper_limit_coefficient,
)
from .pushover import Pattern, Pushover, pushover
from .pushover_fit import PushoverFit, fit_pushover
from .rules import CodeRule, rules_table
from .walls import Wall
from .weight import FloorUse, SeismicWeight, effective_seismic_weight

__all__ = [
    "DISTRIBUTION_CODES",
    "DRIFT_LIMIT_CODES",
    "MODAL_BASE_SHEAR_SHARE",
    "PERIOD_CODES",
    "THETA_CAP",
    "THETA_THRESHOLD",
    "CodeDesign",
    "CodePeriod",
    "CodeRule",
    "Combination",
    "DesignDemand",
    "DesignEntry",
    "DesignedBuilding",
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
    "design_by_code",
    "designed_building",
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
    "rules_table",
    "scaling",
    "seismic_response_coefficient",
    "stability_coefficient",
    "stability_limit",
    "storey_checks",
    "system_factors",
    "system_table",
    "upper_limit_coefficient",
    "vibration_modes",
]
