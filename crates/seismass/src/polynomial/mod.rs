//! Polynomials: their ranges, first falls, and the orders of series.

pub(crate) mod bernstein;
pub(crate) mod enclosure;
pub(crate) mod orders;
