"""What the public value classes share: immutability, comparison by content, pickling, and reading of arguments.

Arguments are only converted here (their kind and shape); their ranges are judged by the kernel.
"""

from __future__ import annotations

import difflib
import numbers
from collections.abc import Hashable, Sequence
from pathlib import Path
from typing import Any, Self, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import InvalidOption, SeismassError

FloatArray: TypeAlias = NDArray[np.float64]
"""Array of doubles; every array that a value class holds is a read-only copy."""

_V = TypeVar("_V", bound="Value")


class Value:
    """An immutable object that is equal to another of its class when their contents are."""

    __slots__ = ("_hash",)
    _hash: int

    def _arguments(self) -> dict[str, Any]:
        """Keyword arguments that make an equal object."""
        raise NotImplementedError

    def _content(self) -> Hashable:
        """What equality compares; labels that change no result may be left out."""
        return tuple(hashable(value) for value in self._arguments().values())

    def _set(self, **attributes: Any) -> None:
        for name, value in attributes.items():
            object.__setattr__(self, name, value)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"{type(self).__name__} cannot be changed; make another, as with replace()")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"{type(self).__name__} cannot be changed; make another, as with replace()")

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return self is other or (hash(self) == hash(other) and self._content() == other._content())

    def __hash__(self) -> int:
        try:
            return self._hash
        except AttributeError:
            self._set(_hash=hash((type(self).__name__, self._content())))
            return self._hash

    def __reduce__(self) -> tuple[Any, ...]:
        return (_rebuild, (type(self), self._arguments()))

    def __copy__(self) -> Self:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        return self

    def replace(self, **changes: Any) -> Self:
        """Return another object, with these arguments changed."""
        return _rebuild(type(self), self._arguments() | changes)


def _rebuild(cls: type[_V], arguments: dict[str, Any]) -> _V:
    return cls(**arguments)


def hashable(value: Any) -> Hashable:
    """Content of an argument; -0.0 and 0.0 are the same."""
    if isinstance(value, np.ndarray):
        return (value.shape, (value + 0.0).tobytes())
    return value if isinstance(value, Hashable) else tuple(value)


def brief(value: Any) -> str:
    """Return a value as an error message shows it."""
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


def printable(name: str) -> str:
    """Return a part of a path as text: bytes of it that are no UTF-8 become escapes."""
    return name.encode("utf-8", "backslashreplace").decode("utf-8")


def refusal(kind: type[SeismassError], parameter: str, owner: str, requirement: str, got: str) -> SeismassError:
    """Return the error of the one form: *parameter* of *owner* must be *requirement*; got *value*."""
    return kind(f"{parameter} of {owner} must be {requirement}; got {got}")


def as_path(value: Any, owner: str, kind: type[SeismassError]) -> Path:
    """Return a path of a file or folder."""
    try:
        path = Path(value)
    except TypeError:
        path = None
    if path is None or "\0" in str(path):
        raise refusal(kind, "path", owner, "a path", brief(value))
    return path


def as_number(value: Any, parameter: str, owner: str, kind: type[SeismassError]) -> float:
    """Return a real number as a float."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value[()]
    if isinstance(value, bool | np.bool_) or not isinstance(value, numbers.Real):
        raise refusal(kind, parameter, owner, "a number", brief(value))
    try:
        return float(value)
    except OverflowError:
        raise refusal(kind, parameter, owner, "a number that a double can hold", brief(value)) from None


def as_positive(
    value: Any, parameter: str, owner: str, kind: type[SeismassError], *, or_infinite: bool = False
) -> float:
    """Return a positive number as a float; infinity only where `or_infinite` allows it."""
    number = as_number(value, parameter, owner, kind)
    if not 0.0 < number < np.inf and not (or_infinite and number == np.inf):
        raise refusal(kind, parameter, owner, "a positive number", f"{number:g}")
    return number


def as_count(value: Any, parameter: str, owner: str, kind: type[SeismassError], *, least: int = 0) -> int:
    """Return an integer of at least `least`."""
    requirement = f"a whole number of at least {least}"
    if isinstance(value, bool | np.bool_) or not isinstance(value, numbers.Integral):
        raise refusal(kind, parameter, owner, requirement, brief(value))
    if not least <= int(value) < 2**53:
        raise refusal(kind, parameter, owner, requirement, brief(int(value)))
    return int(value)


def as_array(
    value: Any, parameter: str, owner: str, kind: type[SeismassError], *, dimensions: int = 1, or_number: bool = False
) -> FloatArray:
    """Return numbers as a contiguous read-only copy; one number only where `or_number` allows it (shape ())."""
    what = {1: "a list of numbers", 2: "a table of numbers, rows by columns"}[dimensions]
    requirement = f"a number or {what}" if or_number else what
    try:
        given = np.asarray(value)
    except (TypeError, ValueError):
        raise refusal(kind, parameter, owner, requirement, brief(value)) from None
    if (given.dtype.kind not in "iuf" and given.size) or np.ma.is_masked(value):
        raise refusal(kind, parameter, owner, requirement, brief(value))
    if given.ndim != dimensions and not (or_number and given.ndim == 0):
        got = brief(value) if given.ndim == 0 else f"an array of shape {given.shape}"
        raise refusal(kind, parameter, owner, requirement, got)
    return frozen(given)


def frozen(values: Any) -> FloatArray:
    """Return a contiguous read-only copy as doubles."""
    array = np.array(values, dtype=np.float64, order="C", copy=True)
    array.setflags(write=False)
    return array


def known_id(value: Any, known: Sequence[str], owner: str, *, hints: int = 1) -> str:
    """Return the id of a row of a table, in any case; an unknown one is refused, with the closest ids as hints."""
    wanted = str(value).strip().lower()
    if wanted not in known:
        close = difflib.get_close_matches(wanted, known, n=hints, cutoff=0.5)
        hint = f" (did you mean {' or '.join(close)}?)" if close else ""
        raise refusal(InvalidOption, "id", owner, f"one of {', '.join(known)}{hint}", brief(value))
    return wanted


def counted(number: int, one: str, several: str | None = None) -> str:
    """Return a number with its noun: 1 pass, 2 passes."""
    return f"{number} {one if number == 1 else several or one + 's'}"
