"""Modules that are named at the top of the package; `__init__.py` reads them here."""

from . import campaign, evidence, fragility, risk, slip, study, validation

__all__ = ["campaign", "evidence", "fragility", "risk", "slip", "study", "validation"]
