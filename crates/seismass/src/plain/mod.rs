//! Runs of whole sample intervals without events.

pub(crate) mod columns;
pub(crate) mod guard_check;
pub(crate) mod new_peaks;
pub(crate) mod plain_loop;
pub(crate) mod run;
pub(crate) mod sliding;
pub(crate) mod tall;
