//! Many runs: grouped so that they share propagators, solved in parallel, returned in the order asked for.

use std::sync::atomic::{AtomicBool, AtomicUsize};

use crate::error::Result;
use crate::response::Response;
use crate::scene::{Motion, Options, Scene};

/// Shared with the caller while a batch runs.
#[derive(Debug, Default)]
pub struct Control {
    /// Set by the caller to stop the batch.
    pub stop: AtomicBool,
    /// Number of runs finished so far.
    pub done: AtomicUsize,
}

/// Solves `runs`, pairs of (index of scene, index of motion), on `threads` threads (default: all cores).
///
/// One result per run, in the order of `runs`; a run that fails is an error in its place.
///
/// # Errors
/// [`crate::Error::Interrupted`] when stopped, [`crate::Error::Invalid`] when an index does not exist.
pub fn simulate_many(
    _scenes: &[Scene],
    _motions: &[Motion],
    _runs: &[(usize, usize)],
    _options: &Options,
    _threads: Option<usize>,
    _control: &Control,
) -> Result<Vec<Result<Response>>> {
    unimplemented!()
}
