//! What every batch does with its runs: indices are judged before any is solved, and a panic stays with its own run.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::batch::plan::Run;
use crate::error::{Domain, Error, Result};

/// Refuses runs of scenes or motions that do not exist.
pub(crate) fn check_indices(runs: &[Run], scenes: usize, motions: usize) -> Result<()> {
    for (position, &Run { scene, motion, .. }) in runs.iter().enumerate() {
        let owner = || format!("run {}", position + 1);
        for (name, index, count) in [("scene index", scene, scenes), ("motion index", motion, motions)] {
            if index >= count {
                let requirement = format!("below the number of them, {count}");
                return Err(Error::invalid(Domain::Options, name, owner(), requirement, index));
            }
        }
    }
    Ok(())
}

/// What `work` returns, its panic as the error of its own run: the others go on.
pub(crate) fn contained<T>(work: impl FnOnce() -> Result<T>) -> Result<T> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|payload| Err(Error::of_panic(payload.as_ref())))
}
