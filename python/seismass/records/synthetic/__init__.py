"""Synthetic motions: the site-based stochastic model for motions of your own, and what makes the built-in suite.

No instrument recorded any of them. They stand in where no recordings are at hand; they are no substitute for them.
`python -m seismass.records.synthetic DIRECTORY` writes the files of the built-in suite again.
"""

from seismass.records.synthetic.near_fault import NearFaultPulse
from seismass.records.synthetic.process import SyntheticParameters, synthetic_motion

__all__ = ["NearFaultPulse", "SyntheticParameters", "synthetic_motion"]
