//! Polynomials: their ranges, first falls, and the orders of series.

mod bernstein;
pub(crate) mod enclosure;
pub(crate) mod orders;
pub(crate) mod power;
pub(crate) mod quadrature;
mod roots;
