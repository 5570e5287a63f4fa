//! Exact steps of a regime.

pub(crate) mod banded;
pub(crate) mod dense;
pub(crate) mod few;
pub(crate) mod full;
pub(crate) mod series;
pub(crate) mod tall;
