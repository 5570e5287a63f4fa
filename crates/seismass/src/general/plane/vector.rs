//! Vectors in the plane.

use std::ops::Range;

/// A vector with its parts in x and y.
pub(super) type Vector2 = [f64; 2];

/// Sums of squares in this range have all their digits: a part that underflows is less than rounding of the other.
const SAFE_SQUARES: Range<f64> = 1e-250..1e250;

#[inline]
pub(super) fn dot(a: Vector2, b: Vector2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[inline]
pub(super) fn length(a: Vector2) -> f64 {
    let squares = dot(a, a);
    if SAFE_SQUARES.contains(&squares) { squares.sqrt() } else { libm::hypot(a[0], a[1]) }
}

#[inline]
pub(super) fn times(factor: f64, a: Vector2) -> Vector2 {
    [factor * a[0], factor * a[1]]
}

#[inline]
pub(super) fn plus(a: Vector2, b: Vector2) -> Vector2 {
    [a[0] + b[0], a[1] + b[1]]
}

#[inline]
pub(super) fn minus(a: Vector2, b: Vector2) -> Vector2 {
    [a[0] - b[0], a[1] - b[1]]
}

/// The vector turned by a quarter, from x to y.
#[inline]
pub(super) fn across(a: Vector2) -> Vector2 {
    [-a[1], a[0]]
}

/// The direction of a vector; none of zero.
pub(super) fn unit(a: Vector2) -> Option<Vector2> {
    let size = length(a);
    (size > 0.0).then(|| [a[0] / size, a[1] / size])
}

/// Its angle from x towards y (rad).
pub(super) fn angle(a: Vector2) -> f64 {
    libm::atan2(a[1], a[0])
}
