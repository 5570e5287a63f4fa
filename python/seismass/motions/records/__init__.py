"""Ground motion records: reading them, gathering them to suites and pairs, and the built-in synthetic suite."""

from seismass.motions.records.builtin import builtin_pairs, builtin_record, builtin_suite
from seismass.motions.records.catalogue import CatalogueSearch, FoundFile, catalogue
from seismass.motions.records.catalogue_search import find_catalogue
from seismass.motions.records.counts import read_counts
from seismass.motions.records.measures import intensity_table
from seismass.motions.records.pair import Pair, Pairs, find_pairs, read_pair
from seismass.motions.records.read import read_record, read_records
from seismass.motions.records.record import Record
from seismass.motions.records.rotd import RotD, rotd
from seismass.motions.records.suite import Excluded, Suite, read_suite
from seismass.motions.records.synthetic import NearFaultPulse, SyntheticParameters, synthetic_motion

__all__ = [
    "CatalogueSearch",
    "Excluded",
    "FoundFile",
    "NearFaultPulse",
    "Pair",
    "Pairs",
    "Record",
    "RotD",
    "Suite",
    "SyntheticParameters",
    "builtin_pairs",
    "builtin_record",
    "builtin_suite",
    "catalogue",
    "find_catalogue",
    "find_pairs",
    "intensity_table",
    "read_counts",
    "read_pair",
    "read_record",
    "read_records",
    "read_suite",
    "rotd",
    "synthetic_motion",
]


def __dir__() -> list[str]:
    """Return the public names, for completion."""
    return list(__all__)
