"""Risk: annual rates of exceeding a limit under a hazard curve, and the share of the live load that keeps them."""

from seismass.studies.risk.annual_rate import AnnualRate, annual_rate, run_rates, stripe_rates, stripe_weights
from seismass.studies.risk.hazard import HazardCurve
from seismass.studies.risk.targeted_share import RiskTargetedShare, risk_targeted_share

__all__ = [
    "AnnualRate",
    "HazardCurve",
    "RiskTargetedShare",
    "annual_rate",
    "risk_targeted_share",
    "run_rates",
    "stripe_rates",
    "stripe_weights",
]

__dir__ = __all__.copy  # for completion
