"""Modules that are named at the top of the package; `__init__.py` reads them here."""

from . import codes, friction, occupancy

__all__ = ["codes", "friction", "occupancy"]
