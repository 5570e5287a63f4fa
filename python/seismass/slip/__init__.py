"""Slip demand: how far goods slide, what that means at edges and walls, and whether they slide or rock."""

from seismass.slip.clearance import Clearance, exceedance_table, signed_peaks, wilson_interval
from seismass.slip.demand import slip_demand
from seismass.slip.estimates import Base, asce43, newmark_bound, newmark_pulse
from seismass.slip.result import SlipDemand
from seismass.slip.squat import BlockSize, parse_size

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


def __dir__() -> list[str]:
    """Return the public names, for completion."""
    return list(__all__)
