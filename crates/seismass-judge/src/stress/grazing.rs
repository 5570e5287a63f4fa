//! Where kernel and judge part: is it a true grazing? The judge is asked with its input changed in the last digits.
//! And where the kernel's energies do not balance: does the input carry the digits that are missing?

use std::collections::BTreeSet;
use std::sync::Arc;

use seismass::{
    Block, Building, Damping, Event, GravityEffect, Motion, Response, STANDARD_GRAVITY, Scene, SpringLaw, Status,
    Storey,
};

use super::pairs;
use super::verdict::{AGREEMENT, LAST_DIGITS, TRIALS, Verdict};
use crate::compare::compare_endings;
use crate::random_scene::Draw;
use crate::{Comparison, DoubleDouble, Solution, compare, compare_events, larger, solve};

/// Powers of ten by which a friction that takes the place of none may be less than the last digits.
const POWERS: f64 = 40.0;
/// With the same events, the kernel may be this many times as far from the judge as the judge is from itself under a
/// change of its input in the last digits.
pub(super) const AMPLIFICATION: f64 = 100.0;

/// Compares the kernel's response with the judge in double precision; if they part, with the judge in double-double;
/// if they part still, looks for a grazing.
pub fn judge(scene: &Scene, motion: &Motion, response: &Response) -> Verdict {
    if let Ok(plain) = solve::<f64>(scene, motion, 1) {
        let comparison = compare(response, &plain);
        if comparison.agrees(AGREEMENT) {
            return Verdict::Agrees(comparison);
        }
    }
    judge_precisely(scene, motion, response)
}

/// As [`judge`], with the judge in double-double from the start.
pub fn judge_precisely(scene: &Scene, motion: &Motion, response: &Response) -> Verdict {
    let exact = match solve::<DoubleDouble>(scene, motion, 1) {
        Ok(exact) => exact,
        Err(error) => return Verdict::Unexplained(format!("the judge failed: {error}")),
    };
    let comparison = compare(response, &exact);
    if comparison.agrees(AGREEMENT) {
        return Verdict::Agrees(comparison);
    }
    explain(scene, motion, response, &exact, &comparison)
}

fn explain(scene: &Scene, motion: &Motion, response: &Response, exact: &Solution, parted: &Comparison) -> Verdict {
    if let Some(verdict) = pairs::explain(scene, motion, response, exact, parted) {
        return verdict;
    }
    let difference = parted.mismatch.clone().unwrap_or_else(|| {
        format!("relative difference {:.1e}, of event times {:.1e}", parted.worst(), parted.worst_time())
    });
    // What double precision itself leaves open: the judge's own rounding.
    if parted.mismatch.is_none()
        && solve::<f64>(scene, motion, 1).is_ok_and(|plain| moves_as_far(response, exact, &plain))
    {
        return Verdict::Sensitive { digits: 0.0, difference };
    }
    for digits in LAST_DIGITS {
        for trial in 0..TRIALS {
            let Some((scene, motion, other)) = changed_judge(scene, motion, digits, trial) else { continue };
            let left = compare(response, &other);
            if left.agrees(AGREEMENT) {
                return Verdict::Grazing { digits, difference };
            }
            // A changed judge that does not come to the kernel's events shows nothing of what follows their first.
            let shown = match (&parted.mismatch, &left.mismatch) {
                (None, _) => moves_as_far(response, exact, &other),
                (Some(_), None) => is_sensitive(&scene, &motion, response, &other),
                (Some(_), Some(_)) => false,
            };
            if shown {
                return Verdict::Sensitive { digits, difference };
            }
        }
    }
    Verdict::Unexplained(difference)
}

/// Whether some change of the judge's input in the last digits moves it as far as the kernel is from it.
fn is_sensitive(scene: &Scene, motion: &Motion, response: &Response, exact: &Solution) -> bool {
    LAST_DIGITS.into_iter().any(|digits| {
        let mut others = (0..TRIALS).filter_map(|trial| changed_judge(scene, motion, digits, trial));
        others.any(|(.., other)| moves_as_far(response, exact, &other))
    })
}

/// Whether every storey and block has the judge's events in the kernel's and in the changed judge's run, and numbers and
/// the times of each are as far from the judge's in the latter as in the former.
fn moves_as_far(response: &Response, exact: &Solution, other: &Solution) -> bool {
    let times = |status: &Status, log: &[Event]| {
        let ending = compare_endings(status, &exact.status).ok()?;
        let mut times = apart_by_machine(log, &exact.events)?;
        times.push(ending);
        Some(times)
    };
    let kernel = times(&response.status, response.events.as_deref().unwrap_or_default());
    let Some((kernel, changed)) = kernel.zip(times(&other.status, &other.events)) else { return false };
    let as_far = |rounding: f64, kernel: f64, changed: f64| kernel <= rounding || kernel <= AMPLIFICATION * changed;
    as_far(AGREEMENT, compare(response, exact).worst(), exact.judge(other).worst())
        && kernel.iter().zip(changed).all(|(&kernel, changed)| as_far(AGREEMENT * exact.end_time, kernel, changed))
}

/// For each storey and block that has events, how far apart their times are (s); nothing if one has not the same events
/// in both logs. What happens to different ones may have changed places.
fn apart_by_machine(found: &[Event], expected: &[Event]) -> Option<Vec<f64>> {
    let machines: BTreeSet<_> = found.iter().chain(expected).map(pairs::machine).collect();
    let apart = |machine| {
        let of_machine = |log: &[Event]| -> Vec<Event> {
            log.iter().filter(|event| pairs::machine(event) == machine).copied().collect()
        };
        compare_events(&of_machine(found), &of_machine(expected)).ok()
    };
    machines.into_iter().map(apart).collect()
}

/// The judge with its input changed, and that input.
fn changed_judge(scene: &Scene, motion: &Motion, digits: f64, trial: u64) -> Option<(Scene, Motion, Solution)> {
    let (scene, motion) = changed(scene, motion, digits, trial)?;
    let other = solve::<DoubleDouble>(&scene, &motion, 1).ok()?;
    Some((scene, motion, other))
}

/// The energy residual that the last digits of g and a_v explain, relative as the residual is; nothing if the
/// kernel's is larger, or if its events or numbers are not those of the judge in double-double.
///
/// The contact force is the sum of g and a_v, and where they nearly cancel it is known to the last digit of g, not to
/// its own. The judge finds by how much the work of friction along its motion changes with one last digit (2^-52) of
/// g and of the samples of a_v. No balance of energies in doubles, of which this work is a part, can be better than
/// that; nothing else is granted to it.
pub fn explained_residual(scene: &Scene, motion: &Motion, response: &Response) -> Option<f64> {
    let residual = response.energy?.relative_residual.abs();
    let exact = solve::<DoubleDouble>(scene, motion, 1).ok()?;
    let explained = f64::EPSILON * exact.contact_condition;
    (compare(response, &exact).agrees(AGREEMENT) && residual <= explained).then_some(explained)
}

/// The scene and motion with every number changed by up to `digits` in its last digit. Numbers of one kind change
/// together (all masses, all friction coefficients), so that what is equal stays equal; trial 0 scales the motion. No
/// friction becomes one whose limit is in the last digits of the ground's acceleration, as floors accelerate that no wave
/// has reached yet, or by many powers of ten less, as they do the further up they are.
fn changed(scene: &Scene, motion: &Motion, digits: f64, trial: u64) -> Option<(Scene, Motion)> {
    let mut draw = Draw(trial);
    let size = digits * f64::EPSILON;
    let mut factor = || 1.0 + size * draw.one_of(&[-1.0, 1.0]) * if trial < 2 { 1.0 } else { draw.between(0.5, 1.0) };
    let (ground, vertical) = (factor(), factor());
    let (mass, stiffness, friction, strength, start, less) = if trial < 2 {
        (1.0, 1.0, 1.0, 1.0, 1.0, 1.0)
    } else {
        (factor(), factor(), factor(), factor(), factor(), 10f64.powf(-draw.between(0.0, POWERS)))
    };
    let largest = motion.acceleration().iter().fold(0.0, |most, a| larger(most, a.abs()));
    let least = size * largest / STANDARD_GRAVITY * less;
    let scaled = |values: &[f64], by: f64| values.iter().map(|v| v * by).collect::<Vec<f64>>();
    let ground = if trial == 0 { 1.0 + size } else { ground };
    let motion = Motion::new(
        scaled(motion.acceleration(), ground),
        motion.dt(),
        motion.vertical().map(|v| scaled(v, vertical).into()),
    )
    .ok()?;
    let block = |b: &Block| Block {
        mass: b.mass * mass,
        mu_s: if b.mu_s > 0.0 { b.mu_s * friction } else { least },
        mu_k: b.mu_k * friction,
        velocity: b.velocity.map(|v| v * start),
        ..b.clone()
    };
    let building = match scene.building() {
        None => None,
        Some(building) => Some(Arc::new(changed_building(building, mass, stiffness, strength)?)),
    };
    let limits = building.as_ref().map(|b| b.storeys().to_vec()).unwrap_or_default();
    let mut changed = Scene::new(building, scene.blocks().iter().map(block).collect()).ok()?;
    if scene.initial_drift().iter().chain(scene.initial_velocity()).any(|&value| value != 0.0) {
        let drift = scene.initial_drift().iter().zip(limits).map(|(d, storey)| {
            let limit = storey.elastic_drift();
            (d * start).clamp(-limit, limit)
        });
        changed = changed.with_initial(drift.collect(), scaled(scene.initial_velocity(), start)).ok()?;
    }
    if let Some(drift) = scene.collapse_drift() {
        changed = changed.with_collapse_drift(drift.to_vec()).ok()?;
    }
    Some((changed, motion))
}

fn changed_building(building: &Building, mass: f64, stiffness: f64, strength: f64) -> Option<Building> {
    let masses = building.mass().iter().map(|m| m * mass).collect();
    let mut storeys = building.storeys().to_vec();
    for storey in &mut storeys {
        if let SpringLaw::Multilinear { backbone } = &storey.law {
            let points: Vec<_> = backbone.iter().map(|[d, f]| [d * strength / stiffness, f * strength]).collect();
            *storey = Storey::multilinear(points);
        } else {
            storey.stiffness *= stiffness;
            storey.yield_shear *= strength;
        }
    }
    let damping = match building.damping() {
        Damping::Matrix(c) => Damping::Matrix(c * stiffness),
        other => other.clone(),
    };
    let gravity = match building.gravity() {
        GravityEffect::GeometricStiffness(values) => {
            GravityEffect::GeometricStiffness(values.iter().map(|v| v * stiffness).collect())
        }
        other => other.clone(),
    };
    Building::new(masses, storeys, damping).ok()?.with_gravity(gravity).ok()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use seismass::EventKind;

    use super::*;
    use crate::stress::random::{LARGEST_RESIDUAL, solve_checked};
    use crate::stress::{Family, scene_of};

    /// The kernel's response, as if its energies did not balance by this.
    fn with_residual(response: &Response, relative_residual: f64) -> Response {
        let mut response = response.clone();
        response.energy.as_mut().unwrap().relative_residual = relative_residual;
        response
    }

    /// Seed 700482: a block slips by 1e-24 m while g + a_v is below 1e-6 m/s2, so that one last digit of g is 1e-9 of
    /// the contact force and more.
    #[test]
    fn a_residual_of_cancelled_gravity_is_explained_and_a_larger_one_is_not() {
        let (scene, motion) = scene_of(700_482).unwrap();
        let response = solve_checked(&scene, &motion).unwrap();
        let residual = response.energy.unwrap().relative_residual;
        let explained = explained_residual(&scene, &motion, &response).unwrap();
        assert!(residual.abs() <= explained && explained < 1e-7, "{residual:e} {explained:e}");
        for planted in [3e-5, -3e-5, f64::NAN] {
            assert_eq!(explained_residual(&scene, &motion, &with_residual(&response, planted)), None);
        }
        let mut elsewhere = response;
        elsewhere.residual_slip[0] *= 1.0 + 1e-6;
        assert_eq!(explained_residual(&scene, &motion, &elsewhere), None);
    }

    /// Where g and a_v do not cancel, no residual beyond the limit is explained.
    #[test]
    fn a_residual_of_an_ordinary_scene_is_not_explained() {
        for seed in 0..20 {
            let (scene, motion) = Family::Usual.scene(seed).unwrap();
            let response = solve_checked(&scene, &motion).unwrap();
            let planted = with_residual(&response, 2.0 * LARGEST_RESIDUAL);
            assert_eq!(explained_residual(&scene, &motion, &planted), None, "seed {seed}");
        }
    }

    /// A block on the ground with mu_s > mu_k whose demand reaches its limit at one sample: within the last digits it
    /// slips or stays, and a kernel that stays is explained; not so one that then moves in a way of its own.
    #[test]
    fn a_graze_explains_its_own_branch_alone() {
        let block = Block { mu_k: 0.1, ..Block::new(0, 1.0, 0.2) };
        let scene = Scene::new(None, vec![block]).unwrap();
        let motion = |excess: f64| {
            let peak = 0.2 * STANDARD_GRAVITY * (1.0 + excess);
            Motion::new(
                (0..=20).map(|i| peak * f64::from(10 - (i - 10i32).abs()) / 10.0).collect::<Vec<_>>(),
                0.01,
                None,
            )
        };
        let (above, below) = (motion(4.0 * f64::EPSILON).unwrap(), motion(-4.0 * f64::EPSILON).unwrap());
        let stays = solve_checked(&scene, &below).unwrap();
        assert_eq!(stays.statistics.events.total(), 0);
        assert!(!solve::<DoubleDouble>(&scene, &above, 1).unwrap().events.is_empty());
        assert!(matches!(judge_precisely(&scene, &above, &stays), Verdict::Grazing { .. }));
        let mut errs = stays;
        errs.events = Some(vec![Event { time: 0.15, kind: EventKind::Slip, number: 1, sign: -1, element: 0 }]);
        assert!(matches!(judge_precisely(&scene, &above, &errs), Verdict::Unexplained(_)));
        errs.events = Some(Vec::new());
        errs.residual_slip[0] = 1e-3;
        assert!(matches!(judge_precisely(&scene, &above, &errs), Verdict::Unexplained(_)));
    }
}
