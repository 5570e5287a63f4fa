//! Runs without events of buildings whose steps are not one matrix.

pub(crate) mod bounds;
pub(crate) mod look;
pub(crate) mod norms;
pub(crate) mod run;
pub(crate) mod sample;
pub(crate) mod series;
