//! Products of the polynomials of a step. What they leave out, above the highest degree, is below rounding: both factors
//! are series whose last terms are.

use crate::general::plane::vector::length;
use crate::general::series::{Quantity, Series};
use crate::polynomial::power::{MAX_DEGREE, Polynomial};

/// Adds `factor` times the product of two polynomials.
pub(super) fn add_product(sum: &mut Polynomial, factor: f64, one: &Polynomial, other: &Polynomial) {
    for (i, a) in one.coefficients().iter().enumerate() {
        for (j, b) in other.coefficients().iter().enumerate().take(MAX_DEGREE + 1 - i) {
            sum.coefficients[i + j] += factor * a * b;
        }
    }
    sum.length = sum.length.max((one.length + other.length - 1).min(MAX_DEGREE + 1));
}

/// A polynomial that is a constant.
pub(super) fn constant(value: f64) -> Polynomial {
    Polynomial::new([value])
}

/// Half the rate of the square of a vector, from its parts and their rates.
pub(super) fn half_square_rate(values: [&Polynomial; 2], rates: [&Polynomial; 2]) -> Polynomial {
    let mut sum = constant(0.0);
    for (value, rate) in values.into_iter().zip(rates) {
        add_product(&mut sum, 1.0, value, rate);
    }
    sum
}

/// The largest length that a vector of a node's quantities can have over a step, and `offset` added to its parts.
pub(super) fn reach(axes: &[Series; 2], quantity: Quantity, node: usize, offset: [f64; 2]) -> f64 {
    let of_axis = |a: usize| {
        let (low, high) = axes[a].range(quantity, node);
        (low + offset[a]).abs().max((high + offset[a]).abs())
    };
    length([of_axis(0), of_axis(1)])
}
