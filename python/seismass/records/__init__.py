"""Ground motion records: reading them, gathering them to suites and pairs, and the built-in synthetic suite."""

from seismass.records.builtin import builtin_pairs, builtin_record, builtin_suite
from seismass.records.catalogue import catalogue
from seismass.records.catalogue_report import CatalogueSearch, FoundFile
from seismass.records.catalogue_search import find_catalogue
from seismass.records.counts import read_counts
from seismass.records.measures import intensity_table
from seismass.records.pair import Pair, read_pair
from seismass.records.pair_search import Pairs, find_pairs
from seismass.records.read import read_record, read_records
from seismass.records.record import Record
from seismass.records.rotd import RotD, rotd
from seismass.records.suite import Excluded, Suite, read_suite
from seismass.records.synthetic import NearFaultPulse, SyntheticParameters, synthetic_motion

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
