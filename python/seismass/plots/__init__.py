"""Figures of results: functions that return matplotlib figures and show nothing.

Each takes `ax`, axes to draw into. `figure_svg` and `inline_svg` give figures as text.
"""

from seismass.media.svg import DARK_CSS, figure_svg, inline_svg
from seismass.plots.batches import fragility, fragility_fit, ida, scatter
from seismass.plots.contacts import contacts
from seismass.plots.drift_profiles import drift_profiles
from seismass.plots.floor_plan import FloorPlan, Footprint, floor_paths
from seismass.plots.growth import energy, slip_path
from seismass.plots.histories import acceleration, drift, slip
from seismass.plots.hysteresis import loops
from seismass.plots.profiles import floor_spectra, profile
from seismass.plots.pushover import pushover
from seismass.plots.racks import rack_drift, rack_profile
from seismass.plots.timeline import events

__all__ = [
    "DARK_CSS",
    "FloorPlan",
    "Footprint",
    "acceleration",
    "contacts",
    "drift",
    "drift_profiles",
    "energy",
    "events",
    "figure_svg",
    "floor_paths",
    "floor_spectra",
    "fragility",
    "fragility_fit",
    "ida",
    "inline_svg",
    "loops",
    "profile",
    "pushover",
    "rack_drift",
    "rack_profile",
    "scatter",
    "slip",
    "slip_path",
]


def __dir__() -> list[str]:
    """Return the public names, for completion."""
    return list(__all__)
