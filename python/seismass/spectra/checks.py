"""Judgements that the kinds of target spectra share; their errors name the target spectrum."""

from __future__ import annotations

from typing import Any

import numpy as np

from seismass._values import as_number, brief, refusal
from seismass.errors import InvalidOption

OWNER = "target spectrum"


def positive(value: Any, name: str) -> float:
    """Return a positive number."""
    number = as_number(value, name, OWNER, InvalidOption)
    if not (np.isfinite(number) and number > 0.0):
        raise refusal(InvalidOption, name, OWNER, "a positive number", f"{number:g}")
    return number


def one_of(value: Any, name: str, choices: tuple[Any, ...]) -> Any:
    """Return a value that is among the choices."""
    if isinstance(value, bool) or not isinstance(value, str | int) or value not in choices:
        raise refusal(InvalidOption, name, OWNER, "one of " + ", ".join(map(str, choices)), brief(value))
    return value
