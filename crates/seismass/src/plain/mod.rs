//! Runs of whole sample intervals without events.

pub(crate) mod beaten;
pub(crate) mod closer;
pub(crate) mod columns;
pub(crate) mod run;
pub(crate) mod sliding;
pub(crate) mod tall;
pub(crate) mod walk;
