//! Many runs: grouped so that they share propagators, solved in parallel, returned in the order asked for.

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use rayon::prelude::*;

use crate::error::{Domain, Error, Result};
use crate::model::Model;
use crate::propagator::RegimeCache;
use crate::response::Response;
use crate::scene::{Motion, Options, Scene};
use crate::simulate::run;

/// Runs that one task takes: enough to share propagators, few enough to balance threads.
const RUNS_PER_TASK: usize = 32;

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
/// One result per run, in the order of `runs`; a run that fails is an error in its place. Runs of equal scenes under
/// the same motion are solved once. Results do not depend on the number of threads nor on the order of runs, to the bit.
///
/// # Errors
/// [`Error::Interrupted`] when stopped, [`Error::Invalid`] when an index does not exist.
pub fn simulate_many(
    scenes: &[Scene],
    motions: &[Motion],
    runs: &[(usize, usize)],
    options: &Options,
    threads: Option<usize>,
    control: &Control,
) -> Result<Vec<Result<Response>>> {
    for (position, &(scene, motion)) in runs.iter().enumerate() {
        let owner = format!("run {}", position + 1);
        for (name, index, count) in [("scene index", scene, scenes.len()), ("motion index", motion, motions.len())] {
            if index >= count {
                let requirement = format!("below the number of them, {count}");
                return Err(Error::invalid(Domain::Options, name, owner, requirement, index));
            }
        }
    }
    let plan = Plan::new(scenes, motions, runs);
    let solved = in_pool(threads, || {
        plan.tasks
            .par_iter()
            .map(|task| {
                let mut cache: Option<(usize, RegimeCache)> = None;
                task.iter()
                    .map(|&unique| {
                        let (scene, motion) = plan.unique[unique];
                        let key = (plan.structure[scene], motions[motion].dt());
                        if cache.as_ref().is_none_or(|(structure, c)| *structure != key.0 || c.dt() != key.1) {
                            cache = Some((key.0, RegimeCache::new(key.1)));
                        }
                        let Some((_, cache)) = &mut cache else { return Err(Error::Interrupted) };
                        let (model, motion) = (&plan.models[scene], &motions[motion]);
                        let response = run(&scenes[scene], model, motion, options, cache, &control.stop);
                        control.done.fetch_add(plan.multiplicity[unique], Ordering::Relaxed);
                        response
                    })
                    .collect::<Vec<_>>()
            })
            .collect::<Vec<_>>()
    })?;
    if control.stop.load(Ordering::Relaxed) {
        return Err(Error::Interrupted);
    }
    let mut by_unique: Vec<Option<Result<Response>>> = vec![None; plan.unique.len()];
    for (task, results) in plan.tasks.iter().zip(solved) {
        for (&unique, result) in task.iter().zip(results) {
            by_unique[unique] = Some(result);
        }
    }
    let mut left = plan.multiplicity;
    Ok(plan
        .of_run
        .iter()
        .map(|&unique| {
            left[unique] -= 1;
            let slot = &mut by_unique[unique];
            if left[unique] == 0 { slot.take() } else { slot.clone() }.unwrap_or(Err(Error::Interrupted))
        })
        .collect())
}

/// Number of different (scene, motion) pairs by content among `runs`.
pub fn count_distinct(scenes: &[Scene], motions: &[Motion], runs: &[(usize, usize)]) -> usize {
    Plan::new(scenes, motions, runs).unique.len()
}

/// Runs `work` in a pool of `threads` threads, or in the global one.
pub(crate) fn in_pool<T: Send>(threads: Option<usize>, work: impl FnOnce() -> T + Send) -> Result<T> {
    match threads {
        None => Ok(work()),
        Some(count) => {
            let refuse = |reason: String| Error::invalid(Domain::Options, "threads", "batch", reason, count);
            if count == 0 {
                return Err(refuse("at least 1".into()));
            }
            let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
            Ok(pool.map_err(|error| refuse(format!("a number the system can start ({error})")))?.install(work))
        }
    }
}

/// Which runs are equal, which share a structure, and who solves what.
struct Plan {
    models: Vec<Model>,
    /// Structure of each scene.
    structure: Vec<usize>,
    /// Different (scene, motion) pairs.
    unique: Vec<(usize, usize)>,
    /// How many runs each of them stands for.
    multiplicity: Vec<usize>,
    /// The pair of each run.
    of_run: Vec<usize>,
    /// Indices into `unique`, grouped by structure and time step.
    tasks: Vec<Vec<usize>>,
}

impl Plan {
    fn new(scenes: &[Scene], motions: &[Motion], runs: &[(usize, usize)]) -> Self {
        let models: Vec<Model> = scenes.iter().map(Model::new).collect();
        let structure = classes(models.iter().map(Model::structure_key));
        let scene_class = classes(models.iter().zip(scenes).map(|(model, scene)| model.content_key(scene)));
        let motion_class = classes(motions.iter().map(motion_key));
        let mut known: HashMap<(usize, usize), usize> = HashMap::new();
        let (mut unique, mut multiplicity) = (Vec::new(), Vec::new());
        let of_run: Vec<usize> = runs
            .iter()
            .map(|&(scene, motion)| {
                let index = *known.entry((scene_class[scene], motion_class[motion])).or_insert_with(|| {
                    unique.push((scene, motion));
                    multiplicity.push(0);
                    unique.len() - 1
                });
                multiplicity[index] += 1;
                index
            })
            .collect();
        let group = |&index: &usize| {
            let (scene, motion): (usize, usize) = unique[index];
            (structure[scene], motions[motion].dt().to_bits())
        };
        let mut order: Vec<usize> = (0..unique.len()).collect();
        order.sort_by_key(group);
        let tasks = order
            .chunk_by(|a, b| group(a) == group(b))
            .flat_map(|same| same.chunks(RUNS_PER_TASK))
            .map(<[usize]>::to_vec)
            .collect();
        Self { models, structure, unique, multiplicity, of_run, tasks }
    }
}

/// Class numbers of equal keys, in order of first appearance.
fn classes<K: std::hash::Hash + Eq>(keys: impl Iterator<Item = K>) -> Vec<usize> {
    let mut known = HashMap::new();
    keys.map(|key| {
        let next = known.len();
        *known.entry(key).or_insert(next)
    })
    .collect()
}

fn motion_key(motion: &Motion) -> Vec<u64> {
    let vertical = motion.vertical().unwrap_or(&[]);
    std::iter::once(motion.dt())
        .chain(motion.acceleration().iter().chain(vertical).copied())
        .map(f64::to_bits)
        .collect()
}
