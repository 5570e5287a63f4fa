"""Slip demand: how far goods slide, what that means at edges and walls, and whether they slide or rock."""

from seismass.model.tipping import BlockSize, parse_size
from seismass.studies.slip.clearance import Clearance, exceedance_table, signed_peaks, wilson_interval
from seismass.studies.slip.demand import SlipDemand, slip_demand
from seismass.studies.slip.runs import Base, asce43, newmark_bound, newmark_pulse

__all__ = [
    "Base",
    "BlockSize",
    "Clearance",
    "SlipDemand",
    "asce43",
    "exceedance_table",
    "newmark_bound",
    "newmark_pulse",
    "parse_size",
    "signed_peaks",
    "slip_demand",
    "wilson_interval",
]

__dir__ = __all__.copy  # for completion
