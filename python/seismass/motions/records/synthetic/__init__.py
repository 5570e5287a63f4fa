"""Synthetic motions: the site-based stochastic model for motions of your own, and what makes the built-in suite.

No instrument recorded any of them. They stand in where no recordings are at hand; they are no substitute for them.
`python -m seismass.motions.records.synthetic DIRECTORY` writes the files of the built-in suite again.
"""

from seismass.motions.records.synthetic.process import NearFaultPulse, SyntheticParameters, synthetic_motion

__all__ = ["NearFaultPulse", "SyntheticParameters", "synthetic_motion"]
