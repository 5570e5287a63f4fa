"""What the public value classes share: immutability, comparison by content, pickling, and reading of arguments.

Arguments are only converted here (their kind and shape); their ranges are judged by the kernel.
"""

from __future__ import annotations

import numbers
import os
from collections.abc import Hashable, Iterable, Iterator, Sequence
from dataclasses import fields, is_dataclass
from itertools import islice
from pathlib import Path
from typing import Any, Final, Self, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import SeismassError

FloatArray: TypeAlias = NDArray[np.float64]
"""Array of doubles; every array that a value class holds is a read-only copy."""

_S = TypeVar("_S", bound=np.generic)
_K = TypeVar("_K")
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


def same(one: Any, other: Any) -> bool:
    """Return whether two values have the same type and content: arrays and tables element by element, NaN as NaN."""
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        alike = one.dtype == other.dtype and one.shape == other.shape
        return alike and bool(np.array_equal(one, other, equal_nan=one.dtype.kind in "fc"))
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(value, other[key]) for key, value in one.items())
    if isinstance(one, tuple | list):
        return len(one) == len(other) and all(same(mine, its) for mine, its in zip(one, other, strict=True))
    if isinstance(one, float):
        return one == other or (one != one and other != other)
    if is_dataclass(one):
        return all(same(getattr(one, each.name), getattr(other, each.name)) for each in fields(one))
    if hasattr(one, "equals"):  # a table of Polars
        return bool(one.equals(other))
    return bool(one == other)


def same_content(self: Any, other: object) -> bool:
    """`__eq__` of results, which hold arrays and tables: the same class and the same content."""
    if type(other) is not type(self):
        return NotImplemented  # type: ignore[no-any-return]  # as an operator does
    return all(same(getattr(self, name), getattr(other, name)) for name in _names(self))


def content_hash(self: Any) -> int:
    """`__hash__` beside `same_content`: of what is short, as arrays and tables are compared but not hashed."""
    values = [getattr(self, name) for name in _names(self)]
    short = [value for value in values if isinstance(value, str | bool | int) or value is None]
    return hash((type(self).__name__, *short))


def _names(value: Any) -> Iterator[str]:
    return (each.name for each in fields(value)) if is_dataclass(value) else iter(type(value).__slots__)


def hashable(value: Any) -> Hashable:
    """Content of an argument; -0.0 and 0.0 are the same."""
    if isinstance(value, np.ndarray):
        return (value.shape, (value + 0.0).tobytes())
    return value if isinstance(value, Hashable) else tuple(value)


_BRIEF: Final = 60
_SHORT: Final = 200
_MOST_BITS: Final = 4096
"""Python writes no number as text that has many more."""


def brief(value: Any) -> str:
    """Return a value as an error message shows it."""
    # Of what is long, only a beginning is made to text: each item gives a character at least.
    if isinstance(value, str | bytes | list | tuple) and len(value) > _BRIEF:
        value = value[:_BRIEF]
    elif isinstance(value, dict) and len(value) > _BRIEF:
        value = dict(islice(value.items(), _BRIEF))
    elif isinstance(value, int) and value.bit_length() > _MOST_BITS:
        return f"a number of {value.bit_length()} bits"
    text = repr(value)
    return text if len(text) <= _BRIEF else text[: _BRIEF - 3] + "..."


def short_repr(self: Any) -> str:
    """`__repr__` of results, which hold arrays and tables: their fields in few words each."""
    shown = ", ".join(f"{each.name}={_in_short(getattr(self, each.name))}" for each in fields(self) if each.repr)
    return f"{type(self).__name__}({shown})"


def _in_short(value: Any) -> str:
    """A field of a result: numbers and words as they are, of the rest its kind and size."""
    if isinstance(value, np.ndarray):
        return f"<array {' x '.join(map(str, value.shape))}>"
    if hasattr(value, "equals"):  # a table of Polars
        return f"<table {value.height} x {value.width}>"
    if is_dataclass(value) and not isinstance(value, type):
        return f"<{type(value).__name__}>"
    if isinstance(value, tuple | list | dict) and len(value) > 3:
        return f"<{len(value)} items>"
    if isinstance(value, tuple | list) and any(is_dataclass(one) or isinstance(one, np.ndarray) for one in value):
        return f"<{len(value)} items>"
    return brief(value)


class FieldValue:
    """A value that is its fields: equal to one of its class whose fields are, and printed in few words. A dataclass
    says `eq=False`, and `repr=False` where its own words are too long.
    """

    __slots__ = ()
    __eq__ = same_content
    __hash__ = content_hash
    __repr__ = short_repr


_SHOWN_AS_ESCAPES: Final = {
    code: f"\\x{code:02x}" if code < 256 else f"\\u{code:04x}"
    for code in (*range(32), *range(127, 160), *range(0x2028, 0x202F), *range(0x2066, 0x206A))
}
"""Control characters, ends of lines and overrides of the direction of writing, which change what stands around them."""
_OF_LINES: Final = {ord("\n"): "\n", ord("\t"): "\t"}


def printable(text: str, *, lines: bool = False) -> str:
    """Return a name or path as text that can be shown and written: invalid bytes, lone surrogates, control characters
    and overrides of direction become escapes. With `lines`, ends of lines and tabs stay.
    """
    shown = text.encode("utf-8", "backslashreplace").decode("utf-8")
    return shown.translate({**_SHOWN_AS_ESCAPES, **_OF_LINES} if lines else _SHOWN_AS_ESCAPES)


def short(text: str) -> str:
    """Return words of a file as a message shows them: printable, and their beginning where they are long."""
    return printable(text if len(text) <= _SHORT else text[: _SHORT - 3] + "...")


def as_name(value: Any, parameter: str, owner: str, kind: type[SeismassError], *, lines: bool = False) -> str:
    """Return a text that people see as `printable` has it."""
    if not isinstance(value, str):
        raise refusal(kind, parameter, owner, "text", brief(value))
    return printable(value, lines=lines)


def refusal(kind: type[SeismassError], parameter: str, owner: str, requirement: str, got: str) -> SeismassError:
    """Return the error of the one form: *parameter* of *owner* must be *requirement*; got *value*."""
    return kind(f"{parameter} of {owner} must be {requirement}; got {got}")


def as_path(value: Any, owner: str, kind: type[SeismassError]) -> Path:
    """Return a path of a file or folder."""
    try:
        path = Path(value)
        os.fsencode(path)
    except (TypeError, UnicodeError):
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


def is_list(value: Any) -> bool:
    """Return whether a value is a list, a tuple or an array with an axis, and no text."""
    return not isinstance(value, str) and (isinstance(value, Sequence) or getattr(value, "shape", ()) != ())


def as_list(value: Any, parameter: str, owner: str, kind: type[SeismassError], requirement: str) -> list[Any]:
    """Return the things of a list or another iterable, which no text and no array without an axis is."""
    if isinstance(value, str) or not isinstance(value, Iterable) or getattr(value, "shape", (0,)) == ():
        raise refusal(kind, parameter, owner, requirement, brief(value))
    return list(value)


def as_one_of(
    value: Any, kinds: type[_K] | tuple[type[_K], ...], parameter: str, owner: str, kind: type[SeismassError]
) -> _K:
    """Return a value that is of a class, or of one of several."""
    if not isinstance(value, kinds):
        names = " or ".join(each.__name__ for each in (kinds if isinstance(kinds, tuple) else (kinds,)))
        raise refusal(kind, parameter, owner, f"a {names}", brief(value))
    return value


def as_flag(value: Any, parameter: str, owner: str, kind: type[SeismassError]) -> bool:
    """Return true or false."""
    if not isinstance(value, bool | np.bool_):
        raise refusal(kind, parameter, owner, "True or False", brief(value))
    return bool(value)


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
        array = np.asarray(value)
    except (TypeError, ValueError):
        raise refusal(kind, parameter, owner, requirement, brief(value)) from None
    masked = hasattr(value, "_mask") and np.ma.is_masked(value)  # numpy.ma is slow to import
    if (array.dtype.kind not in "iuf" and array.size) or masked:
        raise refusal(kind, parameter, owner, requirement, brief(value))
    if array.ndim != dimensions and not (or_number and array.ndim == 0):
        got = brief(value) if array.ndim == 0 else f"an array of shape {array.shape}"
        raise refusal(kind, parameter, owner, requirement, got)
    return frozen(array)


def frozen(values: Any) -> FloatArray:
    """Return a contiguous copy as doubles that cannot be changed, nor made to be."""
    return read_only(np.asarray(values, dtype=np.float64))


def read_only(array: NDArray[_S]) -> NDArray[_S]:
    """Return a contiguous copy whose memory cannot be changed: `setflags(write=True)` is an error, as of bytes."""
    if array.size == 0:
        empty = array.copy()
        empty.setflags(write=False)
        return empty
    return np.frombuffer(array.tobytes(), dtype=array.dtype).reshape(array.shape)


def signed(value: float, form: str = "+.0f") -> str:
    """Return a number in a format of Python's; what is written as zero has no sign."""
    text = f"{value:{form}}"
    return text if text.strip("+-0.e%") else text.lstrip("+-")


def counted(number: int, one: str, several: str | None = None) -> str:
    """Return a number with its noun: 1 pass, 2 passes."""
    return f"{number} {one if number == 1 else several or one + 's'}"
