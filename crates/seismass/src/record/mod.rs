//! What is kept of a run.

pub(crate) mod histories;
pub(crate) mod observer;
