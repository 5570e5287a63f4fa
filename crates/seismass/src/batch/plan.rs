//! What a batch has in common: which runs are equal, and which share regimes.

use std::cmp::Reverse;
use std::collections::HashMap;
use std::hash::{BuildHasher, Hash, Hasher};
use std::mem::discriminant;
use std::ops::Range;
use std::sync::Arc;

use rustc_hash::{FxBuildHasher, FxHashMap};

use crate::classes::Classes;
use crate::machines::storey::StoreyLaw;
use crate::scene::{Block, Building, Damping, Motion, Scene, StoreyDamping, Wear};

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

/// The different runs of a batch, in an order in which they share most.
pub(crate) struct Plan {
    /// Different runs.
    pub(crate) unique: Vec<Run>,
    /// How many runs each of them stands for.
    pub(crate) multiplicity: Vec<usize>,
    /// Index into `unique` of each run.
    pub(crate) of_run: Vec<usize>,
    /// Indices into `unique`, grouped by structure and time step; within a group, runs that share a scaled motion follow
    /// each other.
    pub(crate) order: Vec<usize>,
    /// The groups, as ranges of `order`: those that promise most work come first.
    pub(crate) groups: Vec<Range<usize>>,
}

impl Plan {
    pub(crate) fn new(scenes: &[Scene], motions: &[Motion], runs: &[Run]) -> Self {
        let (structure, scene_class): (Vec<usize>, Vec<usize>) = classes_of(scenes).into_iter().unzip();
        let mut shakings = Classes::default();
        let motion_class: Vec<usize> =
            motions.iter().map(|motion| shakings.number_owned(MotionContent(motion))).collect();
        let mut known = Classes::default();
        let (mut unique, mut multiplicity) = (Vec::new(), Vec::new());
        let of_run: Vec<usize> = runs
            .iter()
            .map(|&run| {
                let index = known.number_owned((scene_class[run.scene], motion_class[run.motion], run.scale.to_bits()));
                if index == unique.len() {
                    unique.push(run);
                    multiplicity.push(0);
                }
                multiplicity[index] += 1;
                index
            })
            .collect();
        let group_of = |run: &Run| (structure[run.scene], motions[run.motion].dt().to_bits());
        let mut order: Vec<_> = (0..unique.len())
            .map(|index| {
                let run: &Run = &unique[index];
                (group_of(run), run.motion, run.scale.to_bits(), index)
            })
            .collect();
        order.sort_unstable();
        let mut groups: Vec<Range<usize>> = Vec::new();
        for same in order.chunk_by(|a, b| a.0 == b.0) {
            let start = groups.last().map_or(0, |group| group.end);
            groups.push(start..start + same.len());
        }
        let work = |group: &Range<usize>| -> usize {
            let of_run = |run: &Run| (1 + scenes[run.scene].storeys()) * motions[run.motion].acceleration().len();
            order[group.clone()].iter().map(|&(.., index)| of_run(&unique[index])).sum()
        };
        groups.sort_by_cached_key(|group| Reverse(work(group)));
        let order = order.into_iter().map(|(.., index)| index).collect();
        Self { unique, multiplicity, of_run, order, groups }
    }
}

/// Two classes of each scene, bit for bit: of what its regimes depend on, and of what its response depends on. Scenes
/// equal in the first share propagators, scenes equal in the second have equal responses.
fn classes_of(scenes: &[Scene]) -> Vec<(usize, usize)> {
    let (mut structures, mut contents) = (Classes::default(), Classes::default());
    let mut buildings = BuildingClasses::default();
    // Many scenes share a building: it is looked at once.
    let mut known: FxHashMap<*const Building, (usize, usize)> = HashMap::default();
    let mut key = Vec::new();
    let of_scene = |scene: &Scene| {
        let building = scene.building().map(|b| *known.entry(Arc::as_ptr(b)).or_insert_with(|| buildings.of(b)));
        key.clear();
        // The number of storeys follows from the class of the building, that of blocks from the length.
        key.push(building.map_or(u64::MAX, |(structure, _)| structure as u64));
        key.extend(scene.geometric_stiffness().iter().map(|value| value.to_bits()));
        // Blocks are taken apart field by field: a new field does not compile until it is a part of a key.
        for &Block { floor, mass, mu_s: _, mu_k: _, velocity: _, wear: _ } in scene.blocks() {
            key.extend([floor as u64, mass.to_bits()]);
        }
        let structure = structures.number(&key);
        key.clear();
        key.extend([structure as u64, building.map_or(u64::MAX, |(_, content)| content as u64)]);
        for &Block { floor: _, mass: _, mu_s, mu_k, velocity, ref wear } in scene.blocks() {
            key.extend([mu_s, mu_k, velocity.unwrap_or(f64::NAN)].map(f64::to_bits));
            key.push(wear.len() as u64);
            key.extend(wear.iter().flat_map(|&Wear { path, mu_s, mu_k }| [path, mu_s, mu_k]).map(f64::to_bits));
        }
        let initial = scene.initial_drift().iter().chain(scene.initial_velocity());
        key.extend(initial.chain(scene.collapse_drift().into_iter().flatten()).map(|value| value.to_bits()));
        (structure, contents.number(&key))
    };
    scenes.iter().map(of_scene).collect()
}

#[derive(Default)]
struct BuildingClasses {
    structures: Classes<Box<[u64]>>,
    contents: Classes<Box<[u64]>>,
}

impl BuildingClasses {
    /// The two classes of a building, as [`classes_of`] scenes.
    fn of(&mut self, building: &Building) -> (usize, usize) {
        let laws = || building.storeys().iter().map(|storey| StoreyLaw::new(storey, 0.0, None));
        let mut key = vec![building.len() as u64];
        let mut push = |value: f64| key.push(value.to_bits());
        for ((law, storey), &mass) in laws().zip(building.storeys()).zip(building.mass()) {
            push(mass);
            push(storey.stiffness);
            push(law.spring.law().largest_tangent());
            // How many there are tells a list from the next one; -1: any.
            let tangents = law.spring.law().tangents();
            push(tangents.as_ref().map_or(-1.0, |tangents| tangents.len() as f64));
            tangents.into_iter().flatten().for_each(&mut push);
        }
        match building.storey_damping() {
            StoreyDamping::None => {}
            StoreyDamping::Rayleigh { mass_factor, stiffness_factor } => {
                push(*mass_factor);
                push(*stiffness_factor);
            }
            StoreyDamping::Dense(matrix) => matrix.iter().for_each(|&value| push(value)),
        }
        // A matrix of the user's own need not dissipate, which the bounds of a regime account for.
        key.push(u64::from(matches!(building.damping(), Damping::Matrix(_))));
        let structure = self.structures.number(&key);
        key = vec![structure as u64];
        for law in laws() {
            // Laws of different kinds may have equal tangents and parameters.
            let parameters = law.spring.law().parameters();
            key.push(FxBuildHasher.hash_one(discriminant(&law.spring)));
            key.push(parameters.len() as u64);
            key.extend(parameters.into_iter().map(f64::to_bits));
        }
        (structure, self.contents.number(&key))
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
        self.bits().for_each(|bits| hasher.write_u64(bits));
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::scene::Storey;

    fn scene(mu: f64) -> Scene {
        Scene::new(None, vec![Block::new(0, 1.0, mu)]).unwrap()
    }

    fn motion(samples: &[f64], vertical: Option<&[f64]>) -> Motion {
        Motion::new(samples, 0.01, vertical.map(Into::into)).unwrap()
    }

    fn building(yield_shear: f64, damping: Damping) -> Building {
        Building::new(vec![1.0; 2], vec![Storey::yielding(100.0, yield_shear); 2], damping).unwrap()
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
    fn a_factor_makes_another_run_of_the_same_group() {
        let runs = [1.0, 2.0, 1.0].map(|scale| Run { scale, ..Run::new(0, 0) });
        let plan = Plan::new(&[scene(0.2)], &[motion(&[1.0, 2.0], None)], &runs);
        assert_eq!(plan.of_run, [0, 1, 0]);
        assert_eq!(plan.groups.len(), 1);
    }

    #[test]
    fn vertical_samples_are_not_taken_for_horizontal_ones() {
        let motions = [motion(&[1.0, 2.0, 3.0, 4.0], None), motion(&[1.0, 2.0], Some(&[3.0, 4.0]))];
        let plan = Plan::new(&[scene(0.2)], &motions, &[Run::new(0, 0), Run::new(0, 1)]);
        assert_eq!(plan.unique.len(), 2);
    }

    #[test]
    fn groups_hold_equal_structures_and_begin_with_most_work() {
        let heavy = Scene::new(None, vec![Block::new(0, 2.0, 0.2)]).unwrap();
        let runs = [Run::new(0, 0), Run::new(1, 0), Run::new(2, 0)];
        let plan = Plan::new(&[heavy, scene(0.2), scene(0.3)], &[motion(&[1.0, 2.0], None)], &runs);
        assert_eq!(plan.groups, [1..3, 0..1]);
        assert_eq!(plan.order, [0, 1, 2]);
    }

    #[test]
    fn buildings_are_equal_by_content_and_structures_by_their_tangents() {
        let modal = || Damping::Modal { ratio: 0.05 };
        let scenes: Vec<Scene> = [building(1.0, modal()), building(1.0, modal()), building(2.0, modal())]
            .map(|building| Scene::new(Some(Arc::new(building)), Vec::new()).unwrap())
            .into();
        assert_eq!(classes_of(&scenes), [(0, 0), (0, 0), (0, 1)]);
        let collapsing = scenes[0].clone().with_collapse_drift(vec![1.0; 2]).unwrap();
        let moving = scenes[0].clone().with_initial(vec![0.0; 2], vec![1.0; 2]).unwrap();
        assert_eq!(classes_of(&[scenes[0].clone(), collapsing, moving]), [(0, 0), (0, 1), (0, 2)]);
    }

    #[test]
    fn a_matrix_that_may_feed_energy_shares_no_regimes_with_one_that_does_not() {
        let modal = building(1.0, Damping::Modal { ratio: 0.05 });
        let matrix = building(1.0, Damping::Matrix(modal.damping_matrix()));
        let scenes = [modal, matrix].map(|b| Scene::new(Some(Arc::new(b)), Vec::new()).unwrap());
        assert_eq!(classes_of(&scenes).iter().map(|classes| classes.0).collect::<Vec<_>>(), [0, 1]);
    }
}
