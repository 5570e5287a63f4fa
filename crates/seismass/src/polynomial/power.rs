//! Polynomials on [0, 1] by their coefficients.

use crate::lanes::{Vector, WIDTH, load};

/// Highest degree: Taylor series of a step never need more terms.
pub(crate) const MAX_DEGREE: usize = 23;
/// Vectors of coefficients that short polynomials have, and the longest.
pub(crate) const FEW: usize = 4;
pub(crate) const MOST: usize = (MAX_DEGREE + 1) / WIDTH;

/// An expression in which `$count` is the number of vectors of a polynomial's coefficients, as a constant.
macro_rules! by_length {
    ($polynomial:expr, $count:ident => $call:expr) => {
        if $polynomial.is_short() {
            const $count: usize = crate::polynomial::power::FEW;
            $call
        } else {
            const $count: usize = crate::polynomial::power::MOST;
            $call
        }
    };
}

pub(crate) use by_length;

/// A polynomial on [0, 1] by its power coefficients, lowest first, and zeros beyond.
///
/// What the hot loops need is inlined into the code of their path and takes the path's fused operations (`V`).
#[derive(Clone, Copy)]
pub(crate) struct Polynomial {
    pub(crate) coefficients: [f64; MAX_DEGREE + 1],
    pub(crate) length: usize,
}

impl Polynomial {
    /// The polynomial with these coefficients.
    #[inline(always)]
    pub(crate) fn new(coefficients: impl IntoIterator<Item = f64>) -> Self {
        let mut p = Self { coefficients: [0.0; MAX_DEGREE + 1], length: 0 };
        for (out, c) in p.coefficients.iter_mut().zip(coefficients) {
            *out = c;
            p.length += 1;
        }
        p
    }

    /// Zeros, to be set: at least this many coefficients.
    #[inline(always)]
    pub(crate) fn zeros(length: usize) -> Self {
        Self { coefficients: [0.0; MAX_DEGREE + 1], length: Self::room(length) }
    }

    /// Coefficients that so many are made: one of two lengths, so that loops over them are no loops.
    #[inline(always)]
    pub(crate) fn room(length: usize) -> usize {
        if length <= WIDTH * FEW { WIDTH * FEW } else { WIDTH * MOST }
    }

    /// Whether the coefficients are no more than [`FEW`] vectors.
    #[inline(always)]
    pub(crate) fn is_short(&self) -> bool {
        self.length <= WIDTH * FEW
    }

    /// The first coefficients in whole vectors, to be changed in place.
    #[inline(always)]
    pub(crate) fn fours_mut<const F: usize>(&mut self) -> Option<&mut [[f64; WIDTH]; F]> {
        self.coefficients.as_chunks_mut().0.first_chunk_mut()
    }

    /// The coefficients, lowest first.
    #[inline(always)]
    pub(crate) fn coefficients(&self) -> &[f64] {
        &self.coefficients[..self.length.min(MAX_DEGREE + 1)]
    }

    /// The first coefficients, and zeros beyond, in vectors.
    #[inline(always)]
    pub(crate) fn fours<V: Vector, const F: usize>(&self) -> [V; F] {
        load(&self.coefficients[..])
    }

    /// Value at `s`.
    #[inline(always)]
    pub(crate) fn at<V: Vector>(&self, s: f64) -> f64 {
        let mut value = 0.0;
        for &c in self.coefficients().iter().rev() {
            value = V::fused(value, s, c);
        }
        value
    }

    /// Value and derivative at `s`: of every fourth power apart, then of all.
    #[inline(always)]
    pub(crate) fn at_with_rate<V: Vector>(&self, s: f64) -> (f64, f64) {
        by_length!(self, F => self.first_at_with_rate::<V, F>(s))
    }

    #[inline(always)]
    fn first_at_with_rate<V: Vector, const F: usize>(&self, s: f64) -> (f64, f64) {
        let squared = s * s;
        let (cubed, fourth) = (s * squared, V::splat(squared * squared));
        let fours = self.fours::<V, F>();
        let (mut value, mut rate) = (fours[F - 1], V::splat(0.0));
        for f in (0..F - 1).rev() {
            rate = rate.mul_add(fourth, value);
            value = value.mul_add(fourth, fours[f]);
        }
        let powers = V::of([1.0, s, squared, cubed]);
        let rates = V::of([0.0, 1.0, 2.0 * s, 3.0 * squared]);
        let rate = powers.mul(rate).mul_add(V::splat(4.0 * cubed), rates.mul(value));
        (powers.mul(value).sum(), rate.sum())
    }

    /// The derivative.
    #[inline(always)]
    pub(crate) fn derivative(&self) -> Self {
        // All of them, whatever the length, for whole vectors.
        let mut coefficients = [0.0; MAX_DEGREE + 1];
        for k in 0..MAX_DEGREE {
            coefficients[k] = ORDERS[k + 1] * self.coefficients[k + 1];
        }
        Self { coefficients, length: self.length.saturating_sub(1) }
    }
}

/// 0, 1, 2, ...
const ORDERS: [f64; MAX_DEGREE + 1] = {
    let mut table = [0.0; MAX_DEGREE + 1];
    let mut k = 1;
    while k <= MAX_DEGREE {
        table[k] = k as f64;
        k += 1;
    }
    table
};
