//! The maximum of the tests: `f64::max` would lose what is no number.

/// The larger of two, NaN if one is.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}
