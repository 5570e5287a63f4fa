//! Roots of polynomials on [0, 1] with proof: Bernstein coefficients bound a polynomial, so no sign change means no
//! root and one sign change means exactly one (Descartes' rule).

use crate::polynomial::power::{MAX_DEGREE, Polynomial};

/// Halvings after which an interval is a point.
pub(crate) const MAX_DEPTH: u32 = 60;
/// 1 / C(n, k), by degree n and order k.
const INVERSE_BINOMIALS: [[f64; MAX_DEGREE + 1]; MAX_DEGREE + 1] = {
    let mut table = [[1.0; MAX_DEGREE + 1]; MAX_DEGREE + 1];
    let mut n = 1;
    while n <= MAX_DEGREE {
        let mut binomial = 1u64;
        let mut k = 1;
        while k <= n {
            binomial = binomial * (n + 1 - k) as u64 / k as u64;
            table[n][k] = 1.0 / binomial as f64;
            k += 1;
        }
        n += 1;
    }
    table
};

/// A polynomial on a part of [0, 1] by its Bernstein coefficients.
#[derive(Clone, Copy)]
pub(crate) struct Bernstein {
    coefficients: [f64; MAX_DEGREE + 1],
    length: usize,
}

impl Bernstein {
    /// b_j = sum_k C(j, k) / C(n, k) c_k, formed by repeated summation of the scaled coefficients.
    pub(crate) fn new(polynomial: &Polynomial) -> Self {
        let length = polynomial.length;
        let mut b = polynomial.coefficients;
        let weights = &INVERSE_BINOMIALS[length - 1];
        for k in 1..length {
            b[k] *= weights[k];
        }
        for pass in 1..length {
            for j in (pass..length).rev() {
                b[j] += b[j - 1];
            }
        }
        Self { coefficients: b, length }
    }

    fn as_slice(&self) -> &[f64] {
        &self.coefficients[..self.length]
    }

    fn sign_changes(&self) -> usize {
        let mut changes = 0;
        let mut last = 0.0;
        for &b in self.as_slice() {
            if b != 0.0 {
                if b * last < 0.0 {
                    changes += 1;
                }
                last = b.signum();
            }
        }
        changes
    }

    /// De Casteljau at the middle.
    fn split(&self) -> (Self, Self) {
        let mut right = *self;
        let mut left = *self;
        for level in 1..self.length {
            for j in 0..self.length - level {
                right.coefficients[j] = 0.5 * (right.coefficients[j] + right.coefficients[j + 1]);
            }
            left.coefficients[level] = right.coefficients[0];
        }
        (left, right)
    }

    /// The first interval with exactly one root, a fall.
    pub(crate) fn first_sign_change(&self, left: f64, right: f64, depth: u32) -> Option<(f64, f64)> {
        match self.sign_changes() {
            0 => None,
            1 => Some((left, right)),
            _ if depth == 0 => Some((left, right)),
            _ => {
                let middle = 0.5 * (left + right);
                let (first, second) = self.split();
                first
                    .first_sign_change(left, middle, depth - 1)
                    .or_else(|| second.first_sign_change(middle, right, depth - 1))
            }
        }
    }

    /// Every interval with exactly one root, in order; a root at a middle is an interval without length. Two roots closer
    /// than rounding are none.
    pub(crate) fn all_sign_changes(&self, left: f64, right: f64, depth: u32, visit: &mut impl FnMut(f64, f64)) {
        match self.sign_changes() {
            0 => {}
            1 => visit(left, right),
            _ if depth == 0 => {}
            _ => {
                let middle = 0.5 * (left + right);
                let (first, second) = self.split();
                first.all_sign_changes(left, middle, depth - 1, visit);
                // A zero that both halves share counts in neither.
                let before = first.as_slice().iter().rev().find(|&&b| b != 0.0);
                let after = second.as_slice().iter().find(|&&b| b != 0.0);
                if second.coefficients[0] == 0.0
                    && let (Some(before), Some(after)) = (before, after)
                    && before * after < 0.0
                {
                    visit(middle, middle);
                }
                second.all_sign_changes(middle, right, depth - 1, visit);
            }
        }
    }
}
