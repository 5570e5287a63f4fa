//! Many runs of the general engine, each by itself, solved in parallel and returned in the order asked for.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use crate::batch::checked::{check_indices, contained};
use crate::batch::plan::Run;
use crate::error::{Error, Result};
use crate::general::{GeneralResponse, PlaneResponse, simulate_general_until, simulate_plane_until};
use crate::scene::{GeneralScene, Motion, Options, PlaneMotion, PlaneScene};
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
    solve_each(runs, threads, control, |&Run { scene, motion, scale }, stop| {
        let solved = if scale == 1.0 {
            simulate_general_until(&scenes[scene], &motions[motion], options, stop)
        } else {
            simulate_general_until(&scenes[scene], &motions[motion].scaled(scale)?, options, stop)
        };
        solved.map(&keep)
    })
}

/// As [`simulate_general_each`], for scenes in two horizontal directions; a factor is that of all components.
///
/// # Errors
/// As [`simulate_general_each`].
pub fn simulate_plane_each<T: Send>(
    scenes: &[PlaneScene],
    motions: &[PlaneMotion],
    runs: &[Run],
    options: &Options,
    threads: Option<usize>,
    control: &Control,
    keep: impl Fn(PlaneResponse) -> T + Sync,
) -> Result<Vec<Result<T>>> {
    check_indices(runs, scenes.len(), motions.len())?;
    solve_each(runs, threads, control, |&Run { scene, motion, scale }, stop| {
        let solved = if scale == 1.0 {
            simulate_plane_until(&scenes[scene], &motions[motion], options, stop)
        } else {
            let [x, y] = motions[motion].directions();
            let scaled = PlaneMotion::new(x.scaled(scale)?, y.scaled(scale)?.acceleration())?;
            simulate_plane_until(&scenes[scene], &scaled, options, stop)
        };
        solved.map(&keep)
    })
}

/// Solves each run by itself, in parallel; a panic is the error of its own run.
fn solve_each<T: Send>(
    runs: &[Run],
    threads: Option<usize>,
    control: &Control,
    solve: impl Fn(&Run, &AtomicBool) -> Result<T> + Sync,
) -> Result<Vec<Result<T>>> {
    let one = |run: &Run| {
        let solved = contained(|| solve(run, &control.stop));
        control.done.fetch_add(1, Ordering::Relaxed);
        solved
    };
    let results = in_pool(threads, "batch", || runs.par_iter().with_max_len(1).map(one).collect())?;
    if control.stop.load(Ordering::Relaxed) {
        return Err(Error::Interrupted);
    }
    Ok(results)
}
