"""Products and systems of the size of a spectral matching, with the same bits from any linear algebra library.

The sums in a matrix product may be taken in any order, with and without fused multiply-add, and by any number of
threads: the factors have so few bits that no sum is rounded (the splitting of Ozaki, Ogita, Oishi and Rump 2012, Numer.
Algor. 59:95-118). The rest is elementwise.

Products are taken in pieces for which the library beneath has one thread; its threads wait for each other on a busy
machine, a hundred times as long as the work takes.
"""

from __future__ import annotations

import math
from typing import Final, TypeAlias

import numpy as np

from seismass.base.values import FloatArray
from seismass.matching.stopping import end_if_stopped

Halves: TypeAlias = tuple[FloatArray, FloatArray]

SINGLE_THREAD: Final = 64**3
"""Multiplications of a product up to which OpenBLAS has one thread: 4 times its least, 65536."""
TILE: Final = 64
"""Rows and columns of a piece of a product."""
LARGEST_RIDGE: Final = 1e-3
"""Share of the largest diagonal element that is added to an indefinite matrix at most."""
LEAST_RIDGE: Final = 1e-14
"""The same, at first."""
BLOCK: Final = 32
"""Rows of a block of a factorisation."""
REFINED: Final = 2
"""Times that the factors are used, again on what is left: they have 48 bits."""
HALVED: Final = 16
"""Rows of a matrix that are split at a time."""
BITS: Final = 53
"""Bits of a double."""
UPPER: Final = 1.5 * 2.0 ** (BITS - 1 - 24)
"""Added to a number up to 1 and subtracted, it leaves 24 bits, of which 32 products have an exact sum."""
LOWER: Final = 1.5 * 2.0 ** (BITS - 1 - 48)
"""The same for the next 24 bits."""


def coarse(matrix: FloatArray, bits: int = BITS // 2) -> FloatArray:
    """Return a matrix whose rows are rounded to `bits` bits, whole multiples of 2^-bits of a power of two above the
    norm. By Cauchy-Schwarz sums of products of such rows are exact if their bits are 52 together.
    """
    _, exponent = np.frexp(np.sqrt(np.einsum("ij,ij->i", matrix, matrix)))
    large = np.ldexp(1.5, exponent + (BITS - 1 - bits))[:, None]  # its last bit is that multiple
    rounded = matrix + large
    rounded -= large
    return np.asarray(rounded)


def halves(matrix: FloatArray, bits: int = BITS // 2) -> Halves:
    """Return two `coarse` matrices whose sum has twice as many bits of a matrix."""
    upper, lower = np.empty_like(matrix), np.empty_like(matrix)
    for start in range(0, len(matrix), HALVED):  # as many rows as a cache holds
        rows = slice(start, start + HALVED)
        upper[rows] = coarse(matrix[rows], bits)
        lower[rows] = coarse(matrix[rows] - upper[rows], bits)
    return upper, lower


def exact_product(left: FloatArray, right: FloatArray) -> FloatArray:
    """Return the product of `coarse` matrices of shapes (rows, inner) and (inner, columns), without rounding. The right
    one is coarse by column.
    """
    (rows, inner), columns = left.shape, right.shape[1]
    height, depth = max(min(rows, TILE), 1), max(min(inner, SINGLE_THREAD // TILE // min(max(columns, 1), TILE)), 1)
    width = SINGLE_THREAD // (height * depth)
    result = np.zeros((rows, columns))
    for top in range(0, rows, height):
        end_if_stopped()
        for start in range(0, columns, width):
            tile = result[top : top + height, start : start + width]
            for first in range(0, inner, depth):
                tile += (
                    left[top : top + height, first : first + depth]
                    @ right[first : first + depth, start : start + width]
                )
    return result


def product(left: Halves, right: Halves) -> FloatArray:
    """Return the product, shape (rows, columns), of a matrix of shape (rows, inner) and a transposed one of shape
    (columns, inner), whose `halves` are given.
    """
    (upper, lower), (above, below) = left, right
    small = exact_product(upper, below.T) + exact_product(lower, above.T)
    return np.asarray(small + exact_product(upper, above.T))


def solved(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Return the solution of a symmetric positive definite system, by Cholesky's factors block by block. Where rounding
    has made it indefinite, as little as it takes is added to the diagonal.
    """
    largest = float(np.max(np.abs(np.diag(matrix))))
    ridge = 0.0
    while True:
        try:
            return _by_cholesky(matrix + ridge * np.eye(len(right)) if ridge > 0.0 else matrix, right)
        except np.linalg.LinAlgError:
            ridge = max(10.0 * ridge, LEAST_RIDGE * largest)
            if not ridge < LARGEST_RIDGE * largest:
                raise


def _by_cholesky(matrix: FloatArray, right: FloatArray) -> FloatArray:
    diagonal = np.diag(matrix)
    if not ((diagonal > 0.0) & np.isfinite(diagonal)).all():
        raise np.linalg.LinAlgError("matrix must be positive definite")
    # By powers of two, so that the diagonal is from 1/4 to 1. No element of the factor, nor of what is left of the
    # matrix, is larger than 1 then.
    scale = np.ldexp(1.0, -np.frexp(np.sqrt(diagonal))[1])
    rest = matrix * scale * scale[:, None]
    factors = []
    for start in range(0, len(right), BLOCK):
        own, below = slice(start, start + BLOCK), slice(start + BLOCK, None)
        inverse = _inverse_factor(rest[own, own])
        panel = product(_halves_below_1(rest[below, own]), halves(inverse))
        _subtract_square(rest[below, below], _halves_below_1(panel))
        factors.append((own, below, inverse, panel))
    solution = np.zeros(len(right))
    for _ in range(REFINED):
        change = (right - np.einsum("ij,j->i", matrix, solution)) * scale
        for own, below, inverse, panel in factors:
            change[own] = np.einsum("ij,j->i", inverse, change[own])
            change[below] -= np.einsum("ij,j->i", panel, change[own])
        for own, below, inverse, panel in reversed(factors):
            moved = change[own] - np.einsum("ij,i->j", panel, change[below])
            change[own] = np.einsum("ij,i->j", inverse, moved)
        solution += change * scale
    return solution


def _halves_below_1(matrix: FloatArray) -> Halves:
    """The `halves` of a matrix of up to `BLOCK` columns and of numbers up to 1."""
    upper = (matrix + UPPER) - UPPER
    return upper, ((matrix - upper) + LOWER) - LOWER


def _subtract_square(matrix: FloatArray, parts: Halves) -> None:
    """Subtract from a symmetric matrix, on and below its diagonal, the product of another with its transpose."""
    upper, lower = parts
    for top in range(0, len(matrix), TILE):
        rows, columns = slice(top, top + TILE), slice(0, top + TILE)
        matrix[rows, columns] -= product((upper[rows], lower[rows]), (upper[columns], lower[columns]))


def _inverse_factor(matrix: FloatArray) -> FloatArray:
    """The inverse of Cholesky's lower factor of a small matrix, of which the part on and below the diagonal is read."""
    size = len(matrix)
    rows = np.zeros((size, 2 * size))
    lower = np.tri(size, dtype=bool)
    rows[:, :size] = np.where(lower, matrix, matrix.T)
    rows[:, size:].flat[:: size + 1] = 1.0
    for number in range(size):
        pivot = float(rows[number, number])
        if not 0.0 < pivot < math.inf:
            raise np.linalg.LinAlgError("matrix must be positive definite")
        row = rows[number] / math.sqrt(pivot)
        rows[number + 1 :] -= row[number + 1 : size, None] * row
        rows[number] = row
    return np.ascontiguousarray(rows[:, size:])
