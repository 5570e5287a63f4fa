//! Many runs: grouped so that they share propagators, solved in parallel, returned in the order asked for.

use std::collections::HashMap;
use std::hash::{Hash, Hasher};
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

/// One run of a batch: a scene under a motion whose accelerations are multiplied by a factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    /// Index of the scene.
    pub scene: usize,
    /// Index of the motion.
    pub motion: usize,
    /// Factor of both components of the motion.
    pub scale: f64,
}

impl Run {
    /// A scene under a motion as it is.
    pub fn new(scene: usize, motion: usize) -> Self {
        Self { scene, motion, scale: 1.0 }
    }
}

/// Solves `runs` on `threads` threads (default: all cores).
///
/// One result per run, in the order of `runs`; a run that fails is an error in its place, as is one whose motion leaves
/// the range of numbers when scaled. Equal runs (equal scenes under equal motions with equal factors) are solved once.
/// Results do not depend on the number of threads nor on the order of runs, to the bit. A scaled motion lives while
/// runs that share it are solved.
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
    for (position, &Run { scene, motion, .. }) in runs.iter().enumerate() {
        let owner = || format!("run {}", position + 1);
        for (name, index, count) in [("scene index", scene, scenes.len()), ("motion index", motion, motions.len())] {
            if index >= count {
                let requirement = format!("below the number of them, {count}");
                return Err(Error::invalid(Domain::Options, name, owner(), requirement, index));
            }
        }
    }
    let plan = Plan::new(scenes, motions, runs);
    let solved = in_pool(threads, || {
        plan.tasks.par_iter().map(|task| plan.solve(task, scenes, motions, options, control)).collect::<Vec<_>>()
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
    /// Different runs.
    unique: Vec<Run>,
    /// How many runs each of them stands for.
    multiplicity: Vec<usize>,
    /// Index into `unique` of each run.
    of_run: Vec<usize>,
    /// Indices into `unique`, grouped by structure and time step.
    tasks: Vec<Vec<usize>>,
}

impl Plan {
    fn new(scenes: &[Scene], motions: &[Motion], runs: &[Run]) -> Self {
        let (mut structures, mut contents, mut shakings) = (Classes::default(), Classes::default(), Classes::default());
        let of_scene = |scene: &Scene| {
            let model = Model::new(scene);
            (structures.number(model.structure_key()), contents.number(model.content_key(scene)))
        };
        let (structure, scene_class): (Vec<usize>, Vec<usize>) = scenes.iter().map(of_scene).unzip();
        let motion_class: Vec<usize> = motions.iter().map(|motion| shakings.number(MotionContent(motion))).collect();
        let mut known: HashMap<(usize, usize, u64), usize> = HashMap::new();
        let (mut unique, mut multiplicity) = (Vec::new(), Vec::new());
        let of_run: Vec<usize> = runs
            .iter()
            .map(|&run| {
                let content = (scene_class[run.scene], motion_class[run.motion], run.scale.to_bits());
                let index = *known.entry(content).or_insert_with(|| {
                    unique.push(run);
                    multiplicity.push(0);
                    unique.len() - 1
                });
                multiplicity[index] += 1;
                index
            })
            .collect();
        let group_key = |&index: &usize| {
            let run: Run = unique[index];
            (structure[run.scene], motions[run.motion].dt().to_bits())
        };
        let mut order: Vec<usize> = (0..unique.len()).collect();
        // Runs that share a scaled motion follow each other.
        order.sort_by_key(|index| (group_key(index), unique[*index].motion, unique[*index].scale.to_bits()));
        let tasks = order
            .chunk_by(|a, b| group_key(a) == group_key(b))
            .flat_map(|same| same.chunks(RUNS_PER_TASK))
            .map(<[usize]>::to_vec)
            .collect();
        Self { unique, multiplicity, of_run, tasks }
    }

    /// One result per run of a task.
    fn solve(
        &self,
        task: &[usize],
        scenes: &[Scene],
        motions: &[Motion],
        options: &Options,
        control: &Control,
    ) -> Vec<Result<Response>> {
        let Some(&first) = task.first() else { return Vec::new() };
        let mut cache = RegimeCache::new(motions[self.unique[first].motion].dt());
        let mut scaled: Option<((usize, u64), Result<Motion>)> = None;
        let results = task.iter().map(|&unique| {
            let Run { scene, motion, scale } = self.unique[unique];
            let wanted = (motion, scale.to_bits());
            let motion = match &scaled {
                Some((of, made)) if *of == wanted => made.clone(),
                _ => scaled.insert((wanted, motions[motion].scaled(scale))).1.clone(),
            };
            let response = motion.and_then(|motion| {
                debug_assert!(cache.dt().to_bits() == motion.dt().to_bits(), "a task has one time step");
                // Made here and not kept, so that a large batch holds its scenes and responses alone.
                let model = Model::new(&scenes[scene]);
                run(&scenes[scene], &model, &motion, options, &mut cache, &control.stop)
            });
            control.done.fetch_add(self.multiplicity[unique], Ordering::Relaxed);
            response
        });
        results.collect()
    }
}

/// Numbers equal keys alike, in order of first appearance.
struct Classes<K>(HashMap<K, usize>);

impl<K> Default for Classes<K> {
    fn default() -> Self {
        Self(HashMap::new())
    }
}

impl<K: Hash + Eq> Classes<K> {
    fn number(&mut self, key: K) -> usize {
        let next = self.0.len();
        *self.0.entry(key).or_insert(next)
    }
}

/// A motion as a key: its numbers of samples, time step and samples, bit for bit.
struct MotionContent<'a>(&'a Motion);

impl MotionContent<'_> {
    fn bits(&self) -> impl Iterator<Item = u64> {
        let (horizontal, vertical) = (self.0.acceleration(), self.0.vertical().unwrap_or(&[]));
        let lengths = [horizontal.len() as u64, vertical.len() as u64];
        let samples = horizontal.iter().chain(vertical).map(|sample| sample.to_bits());
        lengths.into_iter().chain([self.0.dt().to_bits()]).chain(samples)
    }
}

impl PartialEq for MotionContent<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.bits().eq(other.bits())
    }
}

impl Eq for MotionContent<'_> {}

impl Hash for MotionContent<'_> {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        self.bits().for_each(|bits| bits.hash(hasher));
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::scene::Block;

    fn scene(mu: f64) -> Scene {
        Scene::new(None, vec![Block::new(0, 1.0, mu)]).unwrap()
    }

    fn motion(samples: &[f64], vertical: Option<&[f64]>) -> Motion {
        Motion::new(samples, 0.01, vertical.map(Into::into)).unwrap()
    }

    #[test]
    fn runs_are_equal_by_content() {
        let scenes = [scene(0.2), scene(0.3), scene(0.2)];
        let motions = [motion(&[1.0, 2.0], None), motion(&[1.0, 2.0], None)];
        let runs: Vec<Run> = (0..3).flat_map(|s| [Run::new(s, 0), Run::new(s, 1)]).collect();
        let plan = Plan::new(&scenes, &motions, &runs);
        assert_eq!(plan.unique, [Run::new(0, 0), Run::new(1, 0)]);
        assert_eq!(plan.multiplicity, [4, 2]);
        assert_eq!(plan.of_run, [0, 0, 1, 1, 0, 0]);
    }

    #[test]
    fn a_factor_makes_another_run_of_the_same_task() {
        let runs = [1.0, 2.0, 1.0].map(|scale| Run { scale, ..Run::new(0, 0) });
        let plan = Plan::new(&[scene(0.2)], &[motion(&[1.0, 2.0], None)], &runs);
        assert_eq!(plan.of_run, [0, 1, 0]);
        assert_eq!(plan.tasks.len(), 1);
    }

    #[test]
    fn vertical_samples_are_not_taken_for_horizontal_ones() {
        let motions = [motion(&[1.0, 2.0, 3.0, 4.0], None), motion(&[1.0, 2.0], Some(&[3.0, 4.0]))];
        let plan = Plan::new(&[scene(0.2)], &motions, &[Run::new(0, 0), Run::new(0, 1)]);
        assert_eq!(plan.unique.len(), 2);
    }
}
