//! Storeys padded to whole vectors.

use crate::lanes::vector::WIDTH;

/// Most storeys that the hot loops hold in vectors.
pub(crate) const MAX_LANES: usize = 48;

/// Most storeys whose step over a sample interval is one matrix without zeros.
pub(crate) const MAX_DENSE: usize = 16;
/// As many vectors.
pub(crate) const WIDEST: usize = MAX_LANES / WIDTH;

/// Stands for a bound that is never reached in lanes: finite, so that the middle between two of them is.
pub(crate) const FAR: f64 = 1e300;

/// Storeys padded to whole vectors.
pub(crate) fn padded(storeys: usize) -> usize {
    match storeys {
        0..=4 => 4,
        5..=8 => 8,
        9..=16 => 16,
        17..=32 => 32,
        33..=MAX_LANES => MAX_LANES,
        _ => storeys.next_multiple_of(8),
    }
}

/// Values padded to whole vectors of a scene with `storeys`.
pub(crate) fn filled(values: impl IntoIterator<Item = f64>, storeys: usize, padding: f64) -> Vec<f64> {
    filled_to(padded(storeys), values, padding)
}

/// Values padded to a length.
pub(crate) fn filled_to(length: usize, values: impl IntoIterator<Item = f64>, padding: f64) -> Vec<f64> {
    let mut out = Vec::with_capacity(length);
    out.extend(values);
    out.resize(length, padding);
    out
}

/// An expression in which `$count` is the number of vectors in a padded width of at most [`MAX_LANES`], as a constant.
#[cfg(feature = "tall-buildings")]
macro_rules! by_width {
    ($width:expr, $count:ident => $call:expr) => {
        match $width {
            4 => {
                const $count: usize = 1;
                $call
            }
            8 => {
                const $count: usize = 2;
                $call
            }
            16 => {
                const $count: usize = 4;
                $call
            }
            32 => {
                const $count: usize = 8;
                $call
            }
            _ => {
                const $count: usize = crate::lanes::width::WIDEST;
                $call
            }
        }
    };
}

/// One vector holds all storeys.
#[cfg(not(feature = "tall-buildings"))]
macro_rules! by_width {
    ($width:expr, $count:ident => $call:expr) => {{
        let _ = $width;
        const $count: usize = 1;
        $call
    }};
}

pub(crate) use by_width;

/// [`by_width`] of widths that hold at most [`MAX_DENSE`] storeys.
#[cfg(feature = "tall-buildings")]
macro_rules! by_dense_width {
    ($width:expr, $count:ident => $call:expr) => {
        match $width {
            4 => {
                const $count: usize = 1;
                $call
            }
            8 => {
                const $count: usize = 2;
                $call
            }
            _ => {
                const $count: usize = crate::lanes::width::MAX_DENSE / crate::lanes::vector::WIDTH;
                $call
            }
        }
    };
}

/// One vector holds all storeys.
#[cfg(not(feature = "tall-buildings"))]
macro_rules! by_dense_width {
    ($width:expr, $count:ident => $call:expr) => {{
        let _ = $width;
        const $count: usize = 1;
        $call
    }};
}

pub(crate) use by_dense_width;
