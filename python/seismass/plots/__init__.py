"""Figures of results: functions that return matplotlib figures and show nothing.

Each takes `ax`, axes to draw into. `figure_svg` and `inline_svg` give figures as text.
"""

from seismass.plots.histories import acceleration, drift, slip
from seismass.plots.pushover import pushover
from seismass.plots.svg import DARK_CSS, figure_svg, inline_svg
from seismass.plots.timeline import events

__all__ = ["DARK_CSS", "acceleration", "drift", "events", "figure_svg", "inline_svg", "pushover", "slip"]
