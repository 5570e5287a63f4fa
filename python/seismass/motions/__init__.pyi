"""Modules that are named at the top of the package; `__init__.py` reads them here."""

from . import matching, pulses, records, spectra

__all__ = ["matching", "pulses", "records", "spectra"]
