"""Figures of results: functions that return matplotlib figures and show nothing.

Each takes `ax`, axes to draw into. `figure_svg` and `inline_svg` give figures as text.
"""

from seismass.media.svg import DARK_CSS, figure_svg, inline_svg
from seismass.show.plots.batches import fragility, fragility_fit, ida, scatter
from seismass.show.plots.floor_plan import FloorPlan, Footprint, floor_paths
from seismass.show.plots.histories import acceleration, drift, energy, events, slip, slip_path
from seismass.show.plots.hysteresis import contacts, loops, pushover, rack_drift, rack_profile
from seismass.show.plots.profiles import drift_profiles, floor_spectra, profile

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

__dir__ = __all__.copy  # for completion
