"""Judgements that the kinds of target spectra share; their errors name the target spectrum."""

from __future__ import annotations

from typing import Any

from seismass.base.errors import InvalidOption
from seismass.base.values import as_positive, brief, refusal

OWNER = "target spectrum"


def positive(value: Any, name: str) -> float:
    """Return a positive number."""
    return as_positive(value, name, OWNER, InvalidOption)


def one_of(value: Any, name: str, choices: tuple[Any, ...]) -> Any:
    """Return a value that is among the choices."""
    if isinstance(value, bool) or not isinstance(value, str | int) or value not in choices:
        raise refusal(InvalidOption, name, OWNER, "one of " + ", ".join(map(str, choices)), brief(value))
    return value
