"""Assessment of one's own building: how much of its live load to count as mass, and what its drifts and slips are."""

from seismass.assess.result import Assessment
from seismass.assess.run import assess

__all__ = ["Assessment", "assess"]
