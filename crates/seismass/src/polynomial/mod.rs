//! Polynomials: their ranges and first falls.

pub(crate) mod bernstein;
