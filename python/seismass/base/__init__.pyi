"""Modules that are named at the top of the package; `__init__.py` reads them here."""

from . import distributions, errors

__all__ = ["distributions", "errors"]
