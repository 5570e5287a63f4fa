//! The run: a scene and a motion in, a response out.

use crate::error::Result;
use crate::response::Response;
use crate::scene::{Motion, Options, Scene};

/// Solves one scene under one motion.
///
/// # Errors
/// [`crate::Error`] when a run has more events than it may have, or leaves the range of numbers.
pub fn simulate(_scene: &Scene, _motion: &Motion, _options: &Options) -> Result<Response> {
    unimplemented!()
}
