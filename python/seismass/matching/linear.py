"""Products and systems of the size of a spectral matching, in pieces for which the library beneath has one thread.

Its threads wait for each other on a busy machine, a hundred times as long as the work takes, and sum in another order
on another number of cores.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from seismass._values import FloatArray

SINGLE_THREAD: Final = 64**3
"""Multiplications of a product up to which OpenBLAS has one thread: 4 times its least, 65536."""
TILE: Final = 64
"""Rows and columns of a piece of a product."""
LARGEST_RIDGE: Final = 1e-3
"""Share of the largest diagonal element that is added to an indefinite matrix at most."""
BLOCK: Final = 32
"""Rows of a block of a factorisation."""


def product(left: FloatArray, right: FloatArray) -> FloatArray:
    """Return the matrix product of shapes (rows, inner) and (inner, columns)."""
    (rows, inner), columns = left.shape, right.shape[1]
    height, width = min(rows, TILE), min(columns, TILE)
    depth = SINGLE_THREAD // max(height * width, 1)
    result = np.zeros((rows, columns))
    for top in range(0, rows, TILE):
        for start in range(0, columns, TILE):
            tile = result[top : top + TILE, start : start + TILE]
            for first in range(0, inner, depth):
                tile += (
                    left[top : top + TILE, first : first + depth] @ right[first : first + depth, start : start + TILE]
                )
    return result


def solved(matrix: FloatArray, right: FloatArray) -> FloatArray:
    """Return the solution of a symmetric positive definite system, by Cholesky's factors block by block.

    Where rounding has made it indefinite, as little as it takes is added to the diagonal.

    Raises
    ------
    numpy.linalg.LinAlgError
        The matrix is far from positive definite, or holds values that are not finite.
    """
    largest = float(np.max(np.abs(np.diag(matrix))))
    ridge = 0.0
    while True:
        try:
            return _by_cholesky(matrix + ridge * np.eye(len(right)) if ridge > 0.0 else matrix, right)
        except np.linalg.LinAlgError:
            ridge = max(10.0 * ridge, 1e-15 * largest)
            if not ridge < LARGEST_RIDGE * largest:
                raise


def _by_cholesky(matrix: FloatArray, right: FloatArray) -> FloatArray:
    rest, solution = matrix.copy(), right.copy()
    factors = []
    for start in range(0, len(right), BLOCK):
        own, below = slice(start, start + BLOCK), slice(start + BLOCK, None)
        inverse = np.linalg.inv(np.linalg.cholesky(rest[own, own]))
        panel = rest[below, own] @ inverse.T
        rest[below, below] -= product(panel, panel.T)
        solution[own] = inverse @ solution[own]
        solution[below] -= panel @ solution[own]
        factors.append((own, below, inverse, panel))
    for own, below, inverse, panel in reversed(factors):
        solution[own] = inverse.T @ (solution[own] - panel.T @ solution[below])
    return solution
