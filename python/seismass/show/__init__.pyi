"""Modules that are named at the top of the package; `__init__.py` reads them here."""

from . import animation, explore, plots

VIEWS: dict[str, str]

__all__ = ["animation", "explore", "plots"]
