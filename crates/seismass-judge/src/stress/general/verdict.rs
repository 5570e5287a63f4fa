//! Where the general engine and its judge part: is it a grazing, or a sensitive scene? The judge is asked with its input
//! changed in the last digits, at random as for the chain engine, and where that shows nothing by the change that is sought.

use std::sync::Arc;

use seismass::{
    Block, Damping, Event, GeneralBuilding, GeneralResponse, GeneralScene, Goods, GravityEffect, Motion, Rack,
    SpringLaw, Storey,
};

use super::backward_error::backward_error;
use crate::general::{GeneralSolution, apart_by_machine, compare_general, solve_general};
use crate::random_scene::Draw;
use crate::stress::grazing::AMPLIFICATION;
use crate::stress::verdict::{AGREEMENT, LAST_DIGITS, TRIALS, Verdict};
use crate::{Comparison, DoubleDouble, Real};

/// Different changes of each size for the judge in double-double.
const PRECISE_TRIALS: u64 = 2;

/// Compares a response with the judge in double precision; if they part, or `precisely`, in double-double; if they part
/// still, looks for a grazing.
pub(super) fn judge(scene: &GeneralScene, motion: &Motion, response: &GeneralResponse, precisely: bool) -> Verdict {
    let plain = solve_general::<f64>(scene, motion, 1);
    if let (Ok(plain), false) = (&plain, precisely) {
        let comparison = compare_general(response, plain);
        if comparison.agrees(AGREEMENT) {
            return Verdict::Agrees(comparison);
        }
    }
    let exact = match solve_general::<DoubleDouble>(scene, motion, 1) {
        Ok(exact) => exact,
        Err(error) => return Verdict::Unexplained(format!("the judge failed: {error}")),
    };
    let comparison = compare_general(response, &exact);
    if comparison.agrees(AGREEMENT) {
        return Verdict::Agrees(comparison);
    }
    let difference = difference(&comparison);
    let same_events = comparison.mismatch.is_none();
    if same_events && plain.is_ok_and(|plain| moves_as_far(response, &exact, &plain)) {
        return Verdict::Sensitive { digits: 0.0, difference };
    }
    // In doubles first: the judge's own rounding, some last digits too, is cheaper than its precision.
    let changed = explain::<f64>(scene, motion, response, &exact, TRIALS);
    let changed = changed.or_else(|| explain::<DoubleDouble>(scene, motion, response, &exact, PRECISE_TRIALS));
    match changed {
        Some((true, digits)) => Verdict::Grazing { digits, difference },
        Some((false, digits)) => Verdict::Sensitive { digits, difference },
        // A chaotic scene: no change at random follows the engine to the end, as the one sought does.
        None => match backward_error(scene, motion, response, &exact) {
            Some(digits) => Verdict::Sensitive { digits: (100.0 * digits).round() / 100.0, difference },
            None => Verdict::Unexplained(difference),
        },
    }
}

/// Whether the judge with its input changed in the last digits comes to the engine's events and numbers (true), or moves as
/// far from itself as the engine is from it (false), and the change in last digits that shows it. Where the events of the
/// unchanged judge are others, two changed ones that have the engine's are compared with each other.
fn explain<R: Real>(
    scene: &GeneralScene,
    motion: &Motion,
    response: &GeneralResponse,
    exact: &GeneralSolution,
    trials: u64,
) -> Option<(bool, f64)> {
    let same_events = compare_general(response, exact).mismatch.is_none();
    let mut alike: Vec<GeneralSolution> = Vec::new();
    for digits in LAST_DIGITS {
        for trial in 0..trials {
            let Some(other) = changed_judge::<R>(scene, motion, digits, trial) else { continue };
            let left = compare_general(response, &other);
            if left.agrees(AGREEMENT) {
                return Some((true, digits));
            }
            let shown = match (same_events, &left.mismatch) {
                (true, _) => moves_as_far(response, exact, &other),
                (false, None) => {
                    let shown = alike.iter().any(|one| moves_as_far(response, one, &other));
                    alike.push(other);
                    shown
                }
                (false, Some(_)) => false,
            };
            if shown {
                return Some((false, digits));
            }
        }
    }
    None
}

fn difference(parted: &Comparison) -> String {
    let numbers = || format!("relative difference {:.1e}, of event times {:.1e}", parted.worst(), parted.worst_time());
    parted.mismatch.clone().unwrap_or_else(numbers)
}

/// Whether every spring and block has the judge's events in the engine's and in the changed judge's run, and numbers and the
/// times of each are as far from the judge's in the latter as in the former.
fn moves_as_far(response: &GeneralResponse, exact: &GeneralSolution, other: &GeneralSolution) -> bool {
    let events = |log: &[seismass::GeneralEvent]| log.iter().map(|entry| entry.event).collect::<Vec<Event>>();
    let own = events(&exact.events);
    let times = |log: &[seismass::GeneralEvent], end: f64| {
        let mut times = apart_by_machine(&events(log), &own)?;
        times.push((end - exact.end_time).abs());
        Some(times)
    };
    let kernel = times(response.events.as_deref().unwrap_or_default(), response.end_time);
    let Some((kernel, changed)) = kernel.zip(times(&other.events, other.end_time)) else { return false };
    let alike = |a: &seismass::GeneralStatus| std::mem::discriminant(a) == std::mem::discriminant(&exact.status);
    let as_far = |rounding: f64, kernel: f64, changed: f64| {
        kernel <= rounding || kernel.is_finite() && kernel <= AMPLIFICATION * changed
    };
    alike(&response.status)
        && alike(&other.status)
        && as_far(AGREEMENT, compare_general(response, exact).worst(), exact.judge(other).worst())
        && kernel.iter().zip(changed).all(|(&kernel, changed)| as_far(AGREEMENT * exact.end_time, kernel, changed))
}

/// The judge with its input changed.
fn changed_judge<R: Real>(scene: &GeneralScene, motion: &Motion, digits: f64, trial: u64) -> Option<GeneralSolution> {
    let (scene, motion) = changed(scene, motion, digits, trial)?;
    solve_general::<R>(&scene, &motion, 1).ok()
}

/// Factors of the numbers of each kind: what is equal stays equal.
struct Factors {
    mass: f64,
    stiffness: f64,
    friction: f64,
    strength: f64,
    start: f64,
    clearance: f64,
}

/// The scene and motion with every number changed by up to `digits` in its last digit; trials 0 and 1 change the motion
/// alone.
fn changed(scene: &GeneralScene, motion: &Motion, digits: f64, trial: u64) -> Option<(GeneralScene, Motion)> {
    let mut draw = Draw(trial);
    let size = digits * f64::EPSILON;
    let mut factor = || 1.0 + size * draw.one_of(&[-1.0, 1.0]) * if trial < 2 { 1.0 } else { draw.between(0.5, 1.0) };
    let (ground, vertical) = (factor(), factor());
    let ground = if trial == 0 { 1.0 + size } else { ground };
    let mut of_scene = || if trial < 2 { 1.0 } else { factor() };
    let by = Factors {
        mass: of_scene(),
        stiffness: of_scene(),
        friction: of_scene(),
        strength: of_scene(),
        start: of_scene(),
        clearance: of_scene(),
    };
    let scaled = |values: &[f64], by: f64| values.iter().map(|v| v * by).collect::<Vec<f64>>();
    let ground = scaled(motion.acceleration(), ground);
    let motion = Motion::new(ground, motion.dt(), motion.vertical().map(|v| scaled(v, vertical).into())).ok()?;
    if trial < 2 {
        return Some((scene.clone(), motion));
    }
    let building = match scene.building() {
        None => None,
        Some(building) => Some(Arc::new(by.building(building)?)),
    };
    let limits: Vec<f64> =
        building.as_ref().map_or(Vec::new(), |b| b.storeys().iter().map(Storey::elastic_drift).collect());
    let goods = scene.goods().iter().map(|goods| by.goods(goods)).collect();
    let racks = scene.racks().iter().map(|rack| by.rack(rack)).collect();
    let mut changed = GeneralScene::new(building, goods, racks).ok()?;
    let drift = scene.initial_drift().iter().zip(limits).map(|(d, limit)| (d * by.start).clamp(-limit, limit));
    changed = changed.with_initial(drift.collect(), scaled(scene.initial_velocity(), by.start)).ok()?;
    if let Some(drift) = scene.collapse_drift() {
        changed = changed.with_collapse_drift(drift.to_vec()).ok()?;
    }
    Some((changed, motion))
}

impl Factors {
    fn building(&self, building: &GeneralBuilding) -> Option<GeneralBuilding> {
        let mass = building.mass().iter().map(|m| m * self.mass).collect();
        let storeys = building.storeys().iter().map(|storey| self.storey(storey)).collect();
        let matrix = building.stiffness_matrix().map(|k| k * self.stiffness);
        let damping = Damping::Matrix(building.damping_matrix() * self.stiffness);
        let gravity = match building.gravity() {
            GravityEffect::GeometricStiffness(values) => {
                GravityEffect::GeometricStiffness(values.iter().map(|v| v * self.stiffness).collect())
            }
            other => other.clone(),
        };
        GeneralBuilding::new(mass, storeys, matrix, &damping, gravity).ok()
    }

    fn storey(&self, storey: &Storey) -> Storey {
        let Self { stiffness, strength, .. } = self;
        if let SpringLaw::Multilinear { backbone } = &storey.law {
            let points: Vec<_> = backbone.iter().map(|[d, f]| [d * strength / stiffness, f * strength]).collect();
            return Storey::multilinear(points);
        }
        let (of_stiffness, of_strength) = (storey.stiffness * stiffness, storey.yield_shear * strength);
        Storey { stiffness: of_stiffness, yield_shear: of_strength, ..storey.clone() }
    }

    fn goods(&self, goods: &Goods) -> Goods {
        let block = &goods.block;
        let block = Block {
            mass: block.mass * self.mass,
            mu_s: block.mu_s * self.friction,
            mu_k: block.mu_k * self.friction,
            velocity: block.velocity.map(|v| v * self.start),
            ..block.clone()
        };
        let stops = goods.stops.map(|mut stops| {
            stops.clearance = stops.clearance.map(|c| c * self.clearance);
            stops.stiffness *= self.stiffness;
            stops
        });
        Goods { block, stops }
    }

    fn rack(&self, rack: &Rack) -> Rack {
        Rack {
            mass: rack.mass.iter().map(|m| m * self.mass).collect(),
            levels: rack.levels.iter().map(|level| self.storey(level)).collect(),
            goods: rack.goods.iter().map(|goods| self.goods(goods)).collect(),
            geometric_stiffness: rack.geometric_stiffness.iter().map(|g| g * self.stiffness).collect(),
            ..rack.clone()
        }
    }
}
