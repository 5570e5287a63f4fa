//! Exact steps of a regime: over a whole sample interval, and as Taylor series.

pub(crate) mod banded;
pub(crate) mod cache;
pub(crate) mod dense;
pub(crate) mod drive;
pub(crate) mod few;
pub(crate) mod full;
mod polynomials;
pub(crate) mod series;
pub(crate) mod steps;
mod stop;
pub(crate) mod table;
pub(crate) mod tall;
