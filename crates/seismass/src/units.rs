//! Physical constants.

/// Standard gravity (m/s2), the g of every number in this crate.
pub const STANDARD_GRAVITY: f64 = 9.806_65;
