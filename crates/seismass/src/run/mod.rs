//! A run: from the first sample to the last, interval by interval.

mod advance;
mod at_rest;
mod exact_run;
mod interval;
pub(crate) mod limits;
mod simulate;

pub use simulate::{simulate, simulate_until};

pub(crate) use simulate::run;
