"""Ground motion records: reading them, gathering them to suites, and the built-in synthetic suite."""

from seismass.records.builtin import builtin_record, builtin_suite
from seismass.records.read import read_record
from seismass.records.record import Record
from seismass.records.suite import Excluded, Suite, read_suite
from seismass.records.synthetic import NearFaultPulse, SyntheticParameters, synthetic_motion

__all__ = [
    "Excluded",
    "NearFaultPulse",
    "Record",
    "Suite",
    "SyntheticParameters",
    "builtin_record",
    "builtin_suite",
    "read_record",
    "read_suite",
    "synthetic_motion",
]
