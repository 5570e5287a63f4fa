"""The exceptions of the package: one base class, each kind also the built-in error that a caller would expect.

Messages have one form: *parameter* of *what* must be *what*; got *value*.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

__all__ = [
    "DoubtfulInput",
    "InvalidBuildingFile",
    "InvalidCampaignFile",
    "InvalidMotion",
    "InvalidOption",
    "InvalidScene",
    "InvalidSceneFile",
    "MissingPackage",
    "RecordFormatError",
    "SeismassError",
    "SimulationError",
]

__dir__ = __all__.copy  # for completion


class SeismassError(Exception):
    """Base class of every error that seismass raises on purpose."""


class InvalidScene(SeismassError, ValueError):
    """A building, block or scene that cannot exist: a negative mass, mu_k above mu_s, a block on a missing floor."""


class InvalidMotion(SeismassError, ValueError):
    """Accelerations that are not a ground motion: empty, not finite, a time step that is not positive."""


class InvalidOption(SeismassError, ValueError):
    """An option of a run, a spectrum, a scaling or a study outside its range."""


class RecordFormatError(SeismassError, ValueError):
    """A record file that is missing, damaged, cut off, contradicts itself or is in a format that is not read."""


class InvalidSceneFile(SeismassError, ValueError):
    """A scene file with an unknown, missing or contradicting key, or that is not TOML or JSON."""


class InvalidBuildingFile(SeismassError, ValueError):
    """A building file with an unknown, missing or contradicting key, or that is not TOML or JSON."""


class InvalidCampaignFile(SeismassError, ValueError):
    """A campaign file with an unknown, missing or contradicting key, or that is not TOML or JSON."""


class MissingPackage(SeismassError, ImportError):
    """A package that an optional part needs and that is not installed; the message says how to install it."""


class SimulationError(SeismassError, RuntimeError):
    """A run that could not be carried to its end; carries the time and the storey or block concerned in its message."""


class DoubtfulInput(UserWarning):
    """A warning: an input that is valid, but so unlikely that a wrong unit is the usual cause."""


def did_you_mean(
    value: Any, known: Iterable[str], hints: int = 1, *, cutoff: float = 0.6, shown: Callable[[str], str] = str
) -> str:
    """Return a hint at the words that a value is like, in brackets; empty where there is none."""
    import difflib

    like = value[:100] if isinstance(value, str) else ""
    close = difflib.get_close_matches(like, list(known), n=hints, cutoff=cutoff)
    return f" (did you mean {' or '.join(map(shown, close))}?)" if close else ""
