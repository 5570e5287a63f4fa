"""Elementary functions with the same bits on every processor, for results that an iteration would drive apart.

NumPy takes sin, cos, exp, log and powers from another library where the processor has AVX-512, and from the C library
elsewhere, which has variants with and without fused multiply-add; its products of complex numbers are fused or not. The
last digit differs. Here are sums, products, quotients and square roots of real numbers alone, each rounded once by
IEEE 754, in a fixed order. Where nothing else is said, the results are within 3 units of the last digit.
"""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seismass.base.values import FloatArray

ComplexArray = NDArray[np.complex128]

# ln 2 and pi/2 in parts: all but the last have so few bits that a product with a whole number below 2^20 is exact.
_LN2: Final = (float.fromhex("0x1.62e42feep-1"), float.fromhex("0x1.a39ef35793c76p-33"))
_HALF_PI: Final = (
    float.fromhex("0x1.921fb544p+0"),
    float.fromhex("0x1.0b4611a6p-34"),
    float.fromhex("0x1.3198a2e037073p-69"),
)
# Taylor coefficients from the highest: of exp(x) for |x| <= ln(2)/2, of cos and sin(x)/x in x^2 for |x| <= pi/4, of
# sinh(x)/x in x^2 for |x| <= 1, of atanh(x)/x in x^2 for |x| <= 3 - sqrt(8). What is left out is below 1e-17.
_EXP: Final = tuple(1.0 / math.factorial(power) for power in range(14, 1, -1))
_COS: Final = tuple((-1.0) ** half / math.factorial(2 * half) for half in range(9, 1, -1))
_SIN: Final = tuple((-1.0) ** half / math.factorial(2 * half + 1) for half in range(8, 0, -1))
_SINH: Final = tuple(1.0 / math.factorial(2 * half + 1) for half in range(9, 0, -1))
_ATANH: Final = tuple(1.0 / (2 * half + 1) for half in range(11, 0, -1))
_LEAST, _MOST = -745.0, 709.7
BLOCK: Final = 64
"""Terms of a series between which the exponential is evaluated again."""


def exp(x: ArrayLike) -> FloatArray:
    """Return e to the power x, of the same shape; 0 below -745. An x above 709.7 or a NaN is an error."""
    values = np.asarray(x, dtype=np.float64)
    if not (values <= _MOST).all():
        raise ValueError(f"x of exp must be up to {_MOST}; got {np.max(values):g}")
    clipped = np.maximum(values, _LEAST)
    number = np.rint(clipped / _LN2[0])
    rest = (clipped - number * _LN2[0]) - number * _LN2[1]
    value = np.ldexp(1.0 + (rest + rest * rest * _polynomial(_EXP, rest)), number.astype(np.int64))
    return np.asarray(np.where(values < _LEAST, 0.0, value))


def log(x: ArrayLike) -> FloatArray:
    """Return the natural logarithm of positive finite numbers, of the same shape."""
    values = np.asarray(x, dtype=np.float64)
    if not ((values > 0.0) & np.isfinite(values)).all():
        wrong = values[~((values > 0.0) & np.isfinite(values))].flat[0]
        raise ValueError(f"x of log must be positive and finite; got {wrong:g}")
    share, number = np.frexp(values)
    low = share < math.sqrt(0.5)
    share, number = np.where(low, 2.0 * share, share), np.where(low, number - 1, number).astype(np.float64)
    # With f = share - 1 and s = f/(2 + f): log(share) = 2 atanh(s) = f - s (f - 2 s^2 (atanh(s)/s - 1)/s^2).
    excess = share - 1.0
    s = excess / (2.0 + excess)
    square = s * s
    small = s * (excess - 2.0 * square * _polynomial(_ATANH, square))
    return np.asarray(number * _LN2[0] + (excess - (small - number * _LN2[1])))


def power(x: ArrayLike, exponent: float) -> FloatArray:
    """Return numbers of at least 0 to a power, of the same shape; the error grows with the logarithm of the result."""
    values = np.asarray(x, dtype=np.float64)
    if exponent > 0.0:
        positive = np.where(values == 0.0, 1.0, values)
        return np.asarray(np.where(values == 0.0, 0.0, exp(exponent * log(positive))))
    return exp(exponent * log(values))


def cos_sin(x: ArrayLike) -> tuple[FloatArray, FloatArray]:
    """Return the cosine and the sine of angles (rad), of the same shape. Beyond 1e6 the error is that of a change of
    the angle in its last digit.
    """
    quarter, square, rest = _reduced(x)
    cosine, sine = _cos(square), rest + rest * (square * _polynomial(_SIN, square))
    swapped = (quarter & 1) == 1
    first, second = np.where(swapped, sine, cosine), np.where(swapped, cosine, sine)
    return np.where(((quarter + 1) & 2) == 2, -first, first), np.where((quarter & 2) == 2, -second, second)


def cos(x: ArrayLike) -> FloatArray:
    """Return the cosine of angles (rad), as `cos_sin`."""
    return cos_sin(x)[0]


def sinh(x: ArrayLike) -> FloatArray:
    """Return the hyperbolic sine, of the same shape."""
    values = np.asarray(x, dtype=np.float64)
    near = np.clip(values, -1.0, 1.0)
    square = near * near
    up = exp(np.abs(values))
    far = np.copysign(0.5 * (up - 1.0 / up), values)
    return np.asarray(np.where(np.abs(values) <= 1.0, near + near * (square * _polynomial(_SINH, square)), far))


def complex_exp(x: ComplexArray) -> ComplexArray:
    """Return e to the power of complex numbers, of the same shape."""
    size = exp(x.real)
    cosine, sine = cos_sin(x.imag)
    return joined(size * cosine, size * sine)


def complex_sinh(x: ComplexArray) -> ComplexArray:
    """Return the hyperbolic sine of complex numbers, of the same shape."""
    cosine, sine = cos_sin(x.imag)
    up = exp(x.real)
    return joined(sinh(x.real) * cosine, 0.5 * (up + 1.0 / up) * sine)


def complex_series(start: ComplexArray, rate: ComplexArray, count: int) -> tuple[ComplexArray, ComplexArray]:
    """Return factors of exp(start + rate k), k = 0, ..., `count` - 1 or more, shapes (series, blocks) and (series,
    `BLOCK`): term `BLOCK` i + j is the product of column i of the first and column j of the second.
    """
    blocks = -(-count // BLOCK)
    return (
        complex_exp(start[:, None] + scaled(rate[:, None], BLOCK * np.arange(blocks))),
        complex_exp(scaled(rate[:, None], np.arange(BLOCK))),
    )


def series_real(far: ComplexArray, near: ComplexArray) -> FloatArray:
    """Return the real parts of one series from its rows of `complex_series`, shape (blocks times `BLOCK`,): at least
    the number of terms asked for.
    """
    return np.asarray(far.real[:, None] * near.real - far.imag[:, None] * near.imag).ravel()


def series_imaginary(far: ComplexArray, near: ComplexArray) -> FloatArray:
    """Return the imaginary parts, as `series_real`."""
    return np.asarray(far.real[:, None] * near.imag + far.imag[:, None] * near.real).ravel()


def times(left: ComplexArray, right: ComplexArray) -> ComplexArray:
    """Return the product of complex numbers, of the shape that both broadcast to."""
    real_part = left.real * right.real - left.imag * right.imag
    return joined(real_part, left.real * right.imag + left.imag * right.real)


def scaled(numbers: ComplexArray, factor: ArrayLike) -> ComplexArray:
    """Return complex numbers times real ones, of the shape that both broadcast to."""
    factors = np.asarray(factor, dtype=np.float64)
    return joined(numbers.real * factors, numbers.imag * factors)


def joined(real_part: ArrayLike, imaginary: ArrayLike) -> ComplexArray:
    """Return complex numbers of the shape that their parts broadcast to."""
    result = np.empty(np.broadcast(real_part, imaginary).shape, dtype=np.complex128)
    result.real, result.imag = real_part, imaginary
    return result


def geomspace(start: float, end: float, count: int) -> FloatArray:
    """Return `count` numbers in geometric spacing from `start` to `stop`, both positive, as `numpy.geomspace`."""
    if count == 1:
        return np.array([start], dtype=np.float64)
    first, last = log(start), log(end)
    values = exp(first + (last - first) * (np.arange(count) / (count - 1)))
    values[0], values[-1] = start, end
    return values


def rounded(x: ArrayLike, bits: int) -> FloatArray:
    """Return numbers rounded to so many significant bits, of the same shape."""
    share, exponent = np.frexp(np.asarray(x, dtype=np.float64))
    return np.asarray(np.ldexp(np.rint(np.ldexp(share, bits)), exponent - bits))


def _reduced(x: ArrayLike) -> tuple[NDArray[np.int64], FloatArray, FloatArray]:
    """Multiples of pi/2, and the rest with its square before it."""
    values = np.asarray(x, dtype=np.float64)
    number = np.rint(values / (_HALF_PI[0] + _HALF_PI[1]))
    rest = ((values - number * _HALF_PI[0]) - number * _HALF_PI[1]) - number * _HALF_PI[2]
    return number.astype(np.int64), rest * rest, rest


def _cos(square: FloatArray) -> FloatArray:
    """The cosine by the square of an angle up to pi/4, with what 1 - x^2/2 loses by rounding."""
    half = 0.5 * square
    start = 1.0 - half
    return np.asarray(start + (((1.0 - start) - half) + square * square * _polynomial(_COS, square)))


def _polynomial(coefficients: tuple[float, ...], x: FloatArray) -> Any:
    """The polynomial by Horner's scheme, coefficients from the highest."""
    value: Any = coefficients[0]
    for coefficient in coefficients[1:]:
        value = value * x + coefficient
    return value
