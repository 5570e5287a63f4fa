"""Names of the module, imported when they are first used; `__init__.py` reads them here."""

from .builtin import builtin_pairs, builtin_record, builtin_suite
from .catalogue import CatalogueSearch, FoundFile, catalogue
from .catalogue_search import find_catalogue
from .counts import read_counts
from .pair import Pair, Pairs, find_pairs, read_pair
from .read import read_record, read_records
from .record import Record
from .rotd import RotD, intensity_table, rotd
from .suite import Excluded, Suite, read_suite
from .synthetic import NearFaultPulse, SyntheticParameters, synthetic_motion

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
