"""Spectral matching in the time domain: records adjusted to a target spectrum without drift."""

from seismass.motions.matching.match import match_spectrum, match_suite
from seismass.motions.matching.result import MatchedRecord, MatchedSuite, Misfit

__all__ = ["MatchedRecord", "MatchedSuite", "Misfit", "match_spectrum", "match_suite"]


def __dir__() -> list[str]:
    """Return the public names, for completion."""
    return list(__all__)
