//! Runs without events of buildings whose steps are not one matrix.

pub(crate) mod bounds;
pub(crate) mod norms;
pub(crate) mod quintic_check;
pub(crate) mod run;
pub(crate) mod sample;
pub(crate) mod series;
