"""Numbers as record files write them: Fortran fields that touch, and the marks of a file that was cut off."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from seismass.base.errors import RecordFormatError

NUMBER: Final = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[EeDd][+-]?\d+)?"

_FIELD = re.compile(r"[+-]?\d*\.\d+(?:[EeDd][+-]\d\d)?")
_PARTS = re.compile(r"[+-]?\d*\.?(?P<decimals>\d*)(?:[EeDd][+-]?(?P<exponent>\d*))?")
_NUMBER = re.compile(NUMBER)
_NO_EXPONENT: Final = frozenset("+-.0123456789")
_CHARACTERS: Final = frozenset("+-.0123456789Ee")

FEWEST_TO_JUDGE_BY: Final = 50
"""Below so many numbers the last one may be shorter than all others by chance."""


def is_number(token: str) -> bool:
    """Whether the token is one finite decimal number, Fortran's D exponent included."""
    return _NUMBER.fullmatch(token) is not None


def to_float(token: str) -> float:
    """Return the value of a token for which `is_number` holds."""
    return float(token.replace("D", "E").replace("d", "e"))


def last_digit(token: str) -> float:
    """Return the unit of the last digit of a number: 0.01 for 1.20, 1e-05 for 1.2E-04."""
    mantissa, _, exponent = token.upper().replace("D", "E").partition("E")
    return float(10.0 ** min(float(exponent or 0) - len(mantissa.partition(".")[2]), 300.0))


def last_digits(tokens: Sequence[str]) -> NDArray[np.float64]:
    """Return the unit of the last digit of each number, shape (len(tokens),)."""
    if set("".join(tokens)) <= _NO_EXPONENT:
        return 10.0 ** -np.array([len(token) - 1 - token.find(".") if "." in token else 0.0 for token in tokens])
    return np.array([last_digit(token) for token in tokens])


def split_touching(token: str) -> list[str] | None:
    """Return the fields of fixed width that touch in `token` ("-.24E-03-.23E-03"), or None. They are told apart by a
    sign of the second or an exponent of the first (sign and two digits); all else is ambiguous.
    """
    fields: list[str] = []
    end = 0
    while end < len(token):
        match = _FIELD.match(token, end)
        if match is None or (end and token[end] not in "+-" and not re.search("[EeDd]", fields[-1])):
            return None
        fields.append(match.group())
        end = match.end()
    return fields


def parse_numbers(lines: Iterable[tuple[int, str]], file: str) -> tuple[list[str], NDArray[np.float64]]:
    """Read all numbers of numbered lines: as written, and as values."""
    numbered = list(lines)
    tokens: list[str] = []
    for _, line in numbered:
        tokens.extend(line.split())
    try:
        # The set of characters leaves out what float() takes beside numbers: nan, inf, 1_000.
        plain = set("".join(tokens)) <= _CHARACTERS
        values = np.array(list(map(float, tokens)) if plain else [], dtype=np.float64)
    except ValueError:
        plain = False
    if not plain:
        tokens = _split_fields(numbered, file)
        values = np.array([to_float(token) for token in tokens], dtype=np.float64)
    wrong = np.flatnonzero(~np.isfinite(values))
    if len(wrong):
        raise RecordFormatError(f"numbers of {file} must be finite; got {tokens[wrong[0]]!r}")
    return tokens, values


def _split_fields(lines: Iterable[tuple[int, str]], file: str) -> list[str]:
    tokens: list[str] = []
    for number, line in lines:
        for token in line.split():
            if is_number(token):
                tokens.append(token)
                continue
            fields = split_touching(token)
            if not fields:
                raise RecordFormatError(f"line {number} of {file} must be numbers; got {token[:40]!r}")
            tokens.extend(fields)
    return tokens


def is_cut_off(tokens: Sequence[str], *, short_zero: bool = True) -> bool:
    """Whether the last number has fewer decimals or exponent digits than all others: of "0.4751E-01" the first half is
    a false peak. With an exponent decimals are complete; a last zero may be short if `short_zero`.
    """
    if len(tokens) <= FEWEST_TO_JUDGE_BY or (short_zero and to_float(tokens[-1]) == 0.0):
        return False
    (last_decimals, last_exponent) = _shape(tokens[-1])
    before = tokens[:-1]
    too_few_decimals = last_exponent == 0 and all(last_decimals < _shape(token)[0] for token in before)
    return too_few_decimals or all(last_exponent < _shape(token)[1] for token in before)


def _shape(token: str) -> tuple[int, int]:
    match = _PARTS.fullmatch(token)
    return (len(match["decimals"]), len(match["exponent"] or "")) if match else (0, 0)
