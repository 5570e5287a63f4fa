"""Polynomials with coefficients of forty digits: values, products, and their roots in an interval.

A list holds coefficients by rising power. Roots are isolated by the signs of Bernstein coefficients and refined by
bisection with Newton steps.
"""

from __future__ import annotations

from decimal import Decimal
from itertools import pairwise
from math import comb
from operator import mul

Series = list[Decimal]

ZERO = Decimal(0)
DEEPEST = 50
"""Halvings after which two roots count as one that does not change the sign."""


def at(p: Series, t: Decimal) -> Decimal:
    """Value at t."""
    value = ZERO
    for c in reversed(p):
        value = value * t + c
    return value


def product(p: Series, q: Series) -> Series:
    """Product of two polynomials."""
    turned = q[::-1]
    n, m = len(p), len(q)
    terms = []
    for k in range(n + m - 1):
        low, high = max(0, k - m + 1), min(k, n - 1)
        terms.append(sum(map(mul, p[low : high + 1], turned[m - 1 - k + low :]), ZERO))
    return terms


def derivative(p: Series) -> Series:
    """Derivative."""
    return [k * c for k, c in enumerate(p)][1:]


def scaled(p: Series, h: Decimal) -> Series:
    """The polynomial in s = t / h, without the last terms that are nothing beside the others."""
    power, terms = Decimal(1), []
    for c in p:
        terms.append(c * power)
        power *= h
    least = max((abs(c) for c in terms), default=ZERO) * Decimal("1e-60")
    while terms and abs(terms[-1]) <= least:
        terms.pop()
    return terms


def _bernstein(p: Series) -> Series:
    n = len(p) - 1
    parts = [c / comb(n, k) for k, c in enumerate(p)]
    return [sum((comb(i, k) * parts[k] for k in range(i + 1)), ZERO) for i in range(n + 1)]


def _halves(b: Series) -> tuple[Series, Series]:
    left, right, row = [b[0]], [b[-1]], b
    half = Decimal("0.5")
    while len(row) > 1:
        row = [(x + y) * half for x, y in pairwise(row)]
        left.append(row[0])
        right.append(row[-1])
    return left, right[::-1]


def _changes(b: Series) -> int:
    signs = [c > 0 for c in b if c]
    return sum(one != other for one, other in pairwise(signs))


def _refined(p: Series, slope: Series, low: Decimal, high: Decimal) -> Decimal:
    """The root between two places of different signs."""
    falls = at(p, low) > 0
    s = (low + high) / 2
    for _ in range(200):
        value = at(p, s)
        if value == 0:
            return s
        low, high = (s, high) if (value > 0) == falls else (low, s)
        rate = at(slope, s)
        newton = s - value / rate if rate else low
        after = newton if low < newton < high else (low + high) / 2
        if abs(after - s) <= Decimal("1e-38"):
            return after
        s = after
    return s


def _roots(p: Series, slope: Series, b: Series, low: Decimal, high: Decimal, depth: int, *, first: bool) -> Series:
    changes = _changes(b)
    if changes == 0 or depth == DEEPEST:
        return []
    if changes == 1 and b[0] and b[-1]:
        return [_refined(p, slope, low, high)]
    middle = (low + high) / 2
    left, right = _halves(b)
    found = _roots(p, slope, left, low, middle, depth + 1, first=first)
    if found and first:
        return found
    return found + _roots(p, slope, right, middle, high, depth + 1, first=first)


def roots(p: Series, h: Decimal, *, first: bool = False) -> Series:
    """Return the times in (0, h) at which a polynomial changes its sign, or the first of them alone."""
    terms = scaled(p, h)
    if len(terms) < 2 or abs(terms[0]) > sum((abs(c) for c in terms[1:]), ZERO):
        return []
    places = _roots(terms, derivative(terms), _bernstein(terms), ZERO, Decimal(1), 0, first=first)
    return [h * s for s in places]
