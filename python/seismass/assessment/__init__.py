"""Assessment of one's own building: how much of its live load to count as mass, and what its drifts and slips are."""

from seismass.assessment.result import Assessment
from seismass.assessment.run import assess

__all__ = ["Assessment", "assess"]
