"""Spectral matching in the time domain: records adjusted to a target spectrum without drift."""

from seismass.motions.matching.match import match_spectrum, match_suite
from seismass.motions.matching.result import MatchedRecord, MatchedSuite, Misfit

__all__ = ["MatchedRecord", "MatchedSuite", "Misfit", "match_spectrum", "match_suite"]

__dir__ = __all__.copy  # for completion
