"""Ground motion records: reading them, gathering them to suites, and the built-in synthetic suite."""

from seismass.records.builtin import builtin_suite
from seismass.records.read import read_record, read_records
from seismass.records.record import Record
from seismass.records.suite import Excluded, Suite, read_suite

__all__ = ["Excluded", "Record", "Suite", "builtin_suite", "read_record", "read_records", "read_suite"]
