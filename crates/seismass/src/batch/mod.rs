//! Many runs: grouped so that they share propagators, solved in parallel, returned in the order asked for.

pub(crate) mod checked;
pub(crate) mod general;
pub(crate) mod plan;
pub(crate) mod schedule;

use std::sync::OnceLock;
use std::sync::atomic::Ordering;

use rayon::prelude::*;

use crate::batch::checked::{check_indices, contained};
use crate::batch::plan::Plan;
use crate::batch::schedule::Schedule;
use crate::error::{Error, Result};
use crate::machines::model::Model;
use crate::response::Response;
use crate::run::run;
use crate::scene::{Motion, Options, Scene};
use crate::step::cache::RegimeCache;
use crate::threads::{Control, in_pool};

pub use crate::batch::general::{simulate_general_each, simulate_plane_each};
pub use crate::batch::plan::Run;

/// Solves `runs` on `threads` threads (default: all cores).
///
/// One result per run, in the order of `runs`; a run that fails is an error in its place, as is one whose motion leaves
/// the range of numbers when scaled. Equal runs (equal scenes under equal motions with equal factors) are solved once.
/// Results do not depend on the number of threads nor on the order of runs, to the bit. A scaled motion lives while
/// runs that share it are solved.
///
/// ```
/// use seismass::{Block, Control, Motion, Options, Run, Scene, simulate_many};
///
/// # fn main() -> seismass::Result<()> {
/// // A block on the ground, by its friction coefficient; a ground that accelerates by 4 m/s2 for a second.
/// let scenes = [0.3, 0.5].map(|mu| Scene::new(None, vec![Block::new(0, 1000.0, mu)]));
/// let scenes = scenes.into_iter().collect::<Result<Vec<_>, _>>()?;
/// let motion = Motion::new(vec![4.0; 101], 0.01, None)?;
/// let runs = [Run::new(0, 0), Run::new(1, 0), Run { scale: 2.0, ..Run::new(1, 0) }];
/// let responses = simulate_many(&scenes, &[motion], &runs, &Options::default(), None, &Control::default())?;
/// for (run, response) in runs.iter().zip(responses) {
///     println!("{run:?}: the block slips by {:.3} m", response?.peaks.slip[0].value);
/// }
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// [`Error::Interrupted`] when stopped, [`Error::Invalid`] when an index does not exist.
pub fn simulate_many(
    scenes: &[Scene],
    motions: &[Motion],
    runs: &[Run],
    options: &Options,
    threads: Option<usize>,
    control: &Control,
) -> Result<Vec<Result<Response>>> {
    simulate_each(scenes, motions, runs, options, threads, control, |response| response)
}

/// As [`simulate_many`], with what `keep` makes of each response in its place: a large batch holds no more than that.
/// Called on the threads that solve, once per different run.
///
/// # Errors
/// As [`simulate_many`].
pub fn simulate_each<T: Clone + Send + Sync>(
    scenes: &[Scene],
    motions: &[Motion],
    runs: &[Run],
    options: &Options,
    threads: Option<usize>,
    control: &Control,
    keep: impl Fn(Response) -> T + Sync,
) -> Result<Vec<Result<T>>> {
    check_indices(runs, scenes.len(), motions.len())?;
    let batch = Batch { scenes, motions, options, control, plan: Plan::new(scenes, motions, runs) };
    let mut results = in_pool(threads, "batch", || batch.solve(&keep))?;
    if control.stop.load(Ordering::Relaxed) {
        return Err(Error::Interrupted);
    }
    let Plan { mut multiplicity, of_run, .. } = batch.plan;
    if of_run.len() == results.len() {
        // All runs differ, and results are where they belong already: a large batch is not held twice.
        return Ok(results.into_iter().map(|slot| slot.into_inner().unwrap_or(Err(Error::Interrupted))).collect());
    }
    let result_of = |unique: usize| {
        multiplicity[unique] -= 1;
        let slot = &mut results[unique];
        if multiplicity[unique] == 0 { slot.take() } else { slot.get().cloned() }.unwrap_or(Err(Error::Interrupted))
    };
    Ok(of_run.into_iter().map(result_of).collect())
}

/// What the threads of a batch work on.
struct Batch<'a> {
    scenes: &'a [Scene],
    motions: &'a [Motion],
    options: &'a Options,
    control: &'a Control,
    plan: Plan,
}

impl Batch<'_> {
    /// One result per different run, on the threads of the present pool; none where the batch was stopped.
    fn solve<T: Send + Sync>(&self, keep: &(impl Fn(Response) -> T + Sync)) -> Vec<OnceLock<Result<T>>> {
        let results: Vec<_> = self.plan.unique.iter().map(|_| OnceLock::new()).collect();
        let threads = rayon::current_num_threads().min(results.len());
        let schedule = Schedule::new(&self.plan.groups, threads);
        (0..threads).into_par_iter().with_max_len(1).for_each(|thread| {
            self.work(|| schedule.next_of(thread), |index, result| drop(results[index].set(result.map(keep))));
        });
        results
    }

    /// What one thread does: solves the runs of the groups and places that it gets, and hands over their results.
    fn work(&self, next: impl Fn() -> Option<(usize, usize)>, hand_over: impl Fn(usize, Result<Response>)) {
        let Plan { unique, multiplicity, order, .. } = &self.plan;
        let mut shared: Option<(usize, RegimeCache)> = None;
        let mut scaled: Option<((usize, u64), Result<Motion>)> = None;
        while let Some((group, place)) = next() {
            if self.control.stop.load(Ordering::Relaxed) {
                return;
            }
            let index = order[place];
            let Run { scene, motion, scale } = unique[index];
            let wanted = (motion, scale.to_bits());
            let scaled_motion = match &mut scaled {
                Some((of, made)) if *of == wanted => made,
                _ => &mut scaled.insert((wanted, self.motions[motion].scaled(scale))).1,
            };
            // What was formed for a part of a group serves another part of it.
            let cache = match &mut shared {
                Some((of, cache)) if *of == group => cache,
                _ => &mut shared.insert((group, RegimeCache::new(self.motions[motion].dt()))).1,
            };
            let result = match scaled_motion {
                Ok(motion) => contained(|| {
                    // Made here and not kept, so that a large batch holds its scenes and responses alone.
                    let model = Model::new(&self.scenes[scene]);
                    run(&self.scenes[scene], &model, motion, self.options, cache, &self.control.stop)
                }),
                Err(error) => Err(error.clone()),
            };
            if matches!(result, Err(Error::Defect { .. })) {
                // What the run was forming when it stopped may be half of it.
                shared = None;
            }
            hand_over(index, result);
            self.control.done.fetch_add(multiplicity[index], Ordering::Relaxed);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_the_error_of_its_own_run() {
        let stopped: Vec<Result<usize>> = (0..3).map(|i| contained(|| Ok([1, 2][i]))).collect();
        assert_eq!(stopped[..2], [Ok(1), Ok(2)]);
        let reason = "index out of bounds: the len is 2 but the index is 2".to_owned();
        assert_eq!(stopped[2], Err(Error::Defect { reason }));
    }
}
