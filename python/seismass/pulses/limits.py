"""Limits of the two methods: indicators, peak velocity, and shares of energy in the tests of arrival."""

from __future__ import annotations

from typing import Final

from seismass.pulses.result import BAKER, SHAHI_BAKER

PULSE_ABOVE: Final = 0.85
"""Baker (2007): a pulse has an indicator above this."""
NO_PULSE_BELOW: Final = 0.15
"""Baker (2007): no pulse where the indicator is below this; between the two it is ambiguous."""
LEAST_PGV: Final = 0.30
"""Baker (2007): peak velocity (m/s) that a pulse-like record is above."""
ARRIVAL: Final = {BAKER: (0.10, 0.20), SHAHI_BAKER: (0.05, 0.17)}
"""Early arrival, by method: when the pulse has the first share of its energy, the record has less than the second."""
