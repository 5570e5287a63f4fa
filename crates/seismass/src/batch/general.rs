//! Many runs of the general engine, each by itself, solved in parallel and returned in the order asked for.

use std::sync::atomic::Ordering;

use rayon::prelude::*;

use crate::batch::checked::{check_indices, contained};
use crate::batch::plan::Run;
use crate::error::{Error, Result};
use crate::general::{GeneralResponse, simulate_general_until};
use crate::scene::{GeneralScene, Motion, Options};
use crate::threads::{Control, in_pool};

/// As [`simulate_each`](crate::simulate_each), for scenes of the general engine; equal runs are each solved.
///
/// # Errors
/// [`Error::Interrupted`] when stopped, [`Error::Invalid`] when an index does not exist.
pub fn simulate_general_each<T: Send>(
    scenes: &[GeneralScene],
    motions: &[Motion],
    runs: &[Run],
    options: &Options,
    threads: Option<usize>,
    control: &Control,
    keep: impl Fn(GeneralResponse) -> T + Sync,
) -> Result<Vec<Result<T>>> {
    check_indices(runs, scenes.len(), motions.len())?;
    let solve = |&Run { scene, motion, scale }: &Run| {
        let solved = contained(|| {
            if scale == 1.0 {
                return simulate_general_until(&scenes[scene], &motions[motion], options, &control.stop);
            }
            simulate_general_until(&scenes[scene], &motions[motion].scaled(scale)?, options, &control.stop)
        });
        control.done.fetch_add(1, Ordering::Relaxed);
        solved.map(&keep)
    };
    let results = in_pool(threads, "batch", || runs.par_iter().with_max_len(1).map(solve).collect())?;
    if control.stop.load(Ordering::Relaxed) {
        return Err(Error::Interrupted);
    }
    Ok(results)
}
