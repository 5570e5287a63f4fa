//! Order of convergence of the reference integrators towards the exact solution, and what events do to it.

#![allow(clippy::unwrap_used)]

mod maximum;

use std::num::NonZeroUsize;
use std::sync::Arc;

use maximum::larger;
use seismass::reference::{Error, Events, History, Method, integrate};
use seismass::{
    Block, Building, Damping, Domain, EventKind, GravityEffect, Motion, Options, Response, Scene, Status, Storey,
    UniformBuilding, simulate,
};

const G: f64 = 9.80665;
const LOCATED: Events = Events::Located { tolerance: 1e-12 };

fn storey(yield_over_weight: f64, r2: f64) -> Storey {
    let stiffness =
        UniformBuilding { storeys: 3, period: 0.6, mass: 1000.0, ..Default::default() }.stiffness().unwrap();
    Storey { second_slope: r2, ..Storey::yielding(stiffness, yield_over_weight * 3000.0 * G) }
}

fn scene(yield_over_weight: f64, r2: f64, mu: f64) -> Scene {
    let building =
        Building::new(vec![1000.0; 3], vec![storey(yield_over_weight, r2); 3], Damping::Modal { ratio: 0.05 }).unwrap();
    let blocks = (1..=3).map(|floor| Block::new(floor, 600.0, mu)).collect();
    Scene::new(Some(Arc::new(building)), blocks).unwrap()
}

/// Sines of 0.9, 1.7 and 3.1 Hz under an envelope, 0.5 g.
fn motion(dt: f64, seconds: f64) -> Motion {
    let samples = (seconds / dt).round() as usize;
    let wave = |i: usize| {
        let t = i as f64 * dt;
        let envelope = (std::f64::consts::PI * t / seconds).sin();
        let sum: f64 = [(0.9, 1.0), (1.7, 0.8), (3.1, 0.6)].iter().map(|(f, a)| a * (6.3 * f * t + f).sin()).sum();
        0.25 * G * envelope * sum
    };
    Motion::new((0..=samples).map(wave).collect::<Vec<_>>(), dt, None).unwrap()
}

fn exact(scene: &Scene, motion: &Motion) -> Response {
    simulate(scene, motion, &Options { histories: NonZeroUsize::new(1), events: true, ..Options::default() }).unwrap()
}

/// Largest deviation over a history, relative to its largest value.
fn deviation(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let largest = expected.iter().fold(0.0, |most, v| larger(most, v.abs()));
    found.iter().zip(expected).fold(0.0, |worst, (f, e)| larger(worst, (f - e).abs())) / largest
}

type Make = fn(usize) -> Method;

const GAUSS: Make = |substeps| Method::Gauss { substeps, events: Events::AtStepEnds };
const GAUSS_LOCATED: Make = |substeps| Method::Gauss { substeps, events: LOCATED };
const NEWMARK: Make = |substeps| Method::Newmark { substeps, events: Events::AtStepEnds };
const NEWMARK_LOCATED: Make = |substeps| Method::Newmark { substeps, events: LOCATED };
const LEAPFROG: Make = |substeps| Method::Leapfrog { substeps };

/// Errors of drift and slip histories for these substeps, printed, and the observed order over all of them.
fn study(name: &str, scene: &Scene, motion: &Motion, method: Make, substeps: &[usize]) -> (Vec<f64>, f64) {
    let reference = exact(scene, motion);
    let expected = reference.histories.as_ref().unwrap();
    let mut errors = Vec::new();
    for &m in substeps {
        let found = integrate(scene, motion, &method(m)).unwrap();
        let drift = deviation(&found.drift, &expected.drift);
        let slip = if found.peak_slip.iter().any(|&s| s != 0.0) { deviation(&found.slip, &expected.slip) } else { 0.0 };
        println!("{name:32} {m:4} drift {drift:8.1e} slip {slip:8.1e} events {:4}", found.events);
        errors.push(larger(drift, slip));
    }
    let halvings = (substeps[substeps.len() - 1] as f64 / substeps[0] as f64).log2();
    let order = (errors[0] / errors[errors.len() - 1]).log2() / halvings;
    if substeps.len() > 1 {
        println!("{name:32} order {order:.2}");
    }
    (errors, order)
}

fn assert_order(name: &str, scene: &Scene, motion: &Motion, method: Make, substeps: &[usize], order: f64, within: f64) {
    let (_, found) = study(name, scene, motion, method, substeps);
    assert!((found - order).abs() <= within, "{name}: order {found}, expected {order} within {within}");
}

/// Orders of the literature: 4 (Hairer & Wanner II, section IV.5), 2 (Newmark 1959), 2 (Stoermer-Verlet).
#[test]
fn smooth_scenes_have_the_order_of_the_method() {
    let stuck = scene(f64::INFINITY, 0.05, 10.0);
    let bare = Scene::new(stuck.building().cloned(), Vec::new()).unwrap();
    let motion = motion(0.02, 10.0);
    let thrown = bare.clone().with_initial(vec![0.0; 3], vec![0.31, -0.17, 0.43]).unwrap();
    for (name, scene) in [("stuck blocks", &stuck), ("no blocks", &bare), ("initial velocities", &thrown)] {
        for (label, method, order) in [
            ("Gauss", GAUSS, 4.0),
            ("Gauss located", GAUSS_LOCATED, 4.0),
            ("Newmark", NEWMARK, 2.0),
            ("Newmark located", NEWMARK_LOCATED, 2.0),
            ("leapfrog", LEAPFROG, 2.0),
        ] {
            assert_order(&format!("{name}, {label}"), scene, &motion, method, &[2, 4, 8, 16], order, 0.1);
        }
    }
    let newton: Make = |substeps| springs(1.0, substeps);
    assert_order("no blocks, springs", &bare, &motion, newton, &[2, 4, 8, 16], 2.0, 0.1);
}

/// Yielding, sticking, sliding and reversing: 210 events in 10 s. Without location the order is that of the jumps of
/// the accelerations, 1; its errors scatter with the places of the events in their steps, hence the wide bands. The
/// leapfrog takes these jumps as impulses and keeps its order.
#[test]
fn location_restores_the_order_on_stick_slip_scenes() {
    let motion = motion(0.02, 10.0);
    for (name, scene) in [("yield and slip", scene(0.2, 0.05, 0.15)), ("slip", scene(f64::INFINITY, 0.05, 0.15))] {
        let coarse = [8, 16, 32, 64, 128, 256];
        for (label, method, order, within) in [
            ("Gauss", GAUSS, 1.0, 0.3),
            ("Gauss located", GAUSS_LOCATED, 4.0, 0.1),
            ("Newmark", NEWMARK, 1.0, 0.3),
            ("Newmark located", NEWMARK_LOCATED, 2.0, 0.1),
            ("leapfrog", LEAPFROG, 2.0, 0.3),
        ] {
            let substeps = if order == 4.0 { &coarse[..4] } else { &coarse };
            assert_order(&format!("{name}, {label}"), &scene, &motion, method, substeps, order, within);
        }
    }
}

fn springs(stiffness_ratio: f64, substeps: usize) -> Method {
    Method::FrictionSprings { substeps, stiffness_ratio, tolerance: 1e-9, max_iterations: 30 }
}

/// Blocks that break away once and slide on: the elastic slip x = mu m g / (kappa k) comes on top of the exact slip,
/// and so does what its rate at breakaway adds later. On the ground under 0.6 g t^2 with mu = 0.15, that is at
/// t = 0.5 s, with the rate 2 x / t, and the run ends at 1 s: 3 x in all, for any kappa.
#[test]
fn friction_springs_slip_too_far_by_one_over_kappa() {
    let floors = scene(f64::INFINITY, 0.05, 0.15);
    let mut blocks = floors.blocks().to_vec();
    blocks.push(Block::new(0, 600.0, 0.15));
    let scene = Scene::new(floors.building().cloned(), blocks).unwrap();
    let ramp: Vec<f64> = (0..=400).map(|i| 0.6 * G * (f64::from(i) / 400.0).powi(2)).collect();
    let motion = Motion::new(ramp, 0.0025, None).unwrap();
    let reference = exact(&scene, &motion);
    let k = scene.building().unwrap().storeys()[0].stiffness;
    let excess = |kappa: f64| -> Vec<f64> {
        let found = integrate(&scene, &motion, &springs(kappa, 50)).unwrap();
        let elastic = 0.15 * 600.0 * G / (kappa * k);
        let last = &found.slip[(found.rows - 1) * 4..];
        let over = |j: usize| (last[j] - reference.residual_slip[j]) * reference.residual_slip[j].signum() / elastic;
        (0..4).map(over).collect()
    };
    for kappa in [100.0, 1000.0] {
        let found = excess(kappa);
        println!("kappa {kappa}: excess over the elastic slip {found:.3?}");
        assert!((found[3] - 3.0).abs() < 0.02);
        assert!(found[..3].iter().all(|factor| (3.0..3.5).contains(factor)));
    }
}

/// A contact force that grows: under the ramp of the test above with v = 0.3 g t at twice its size, slips are those of the
/// exact run but for some elastic slips.
#[test]
fn friction_springs_follow_the_contact_force() {
    let floors = scene(f64::INFINITY, 0.05, 0.15);
    let ramp: Vec<f64> = (0..=400).map(|i| 1.2 * G * (f64::from(i) / 400.0).powi(2)).collect();
    let vertical: Vec<f64> = (0..=400).map(|i| 0.3 * G * f64::from(i) / 400.0).collect();
    let motion = Motion::new(ramp, 0.0025, Some(vertical.into())).unwrap();
    let reference = exact(&floors, &motion);
    let found = integrate(&floors, &motion, &springs(1e4, 50)).unwrap();
    for (found, expected) in found.slip[(found.rows - 1) * 3..].iter().zip(&reference.residual_slip) {
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} for {expected}");
    }
}

/// Where blocks stick again they vibrate on their springs, undamped, with velocities of order 1 / sqrt(kappa): so does
/// the error of a history with many events. The sign of the peaks' error is then that of no law.
#[test]
fn friction_springs_err_by_one_over_the_root_of_kappa_when_blocks_stick_again() {
    let scene = scene(0.2, 0.05, 0.15);
    let motion = motion(0.02, 10.0);
    let reference = exact(&scene, &motion);
    let expected = reference.histories.as_ref().unwrap();
    let mut last: Option<[f64; 2]> = None;
    for kappa in [1e2, 1e3, 1e4] {
        let found = integrate(&scene, &motion, &springs(kappa, 256)).unwrap();
        let error = [deviation(&found.drift, &expected.drift), deviation(&found.slip, &expected.slip)];
        println!("kappa {kappa:6}: drift {:.1e}, slip {:.1e}", error[0], error[1]);
        for (last, error) in last.iter().flatten().zip(error) {
            assert!((2.2..4.5).contains(&(last / error)), "{last} {error}");
        }
        last = Some(error);
    }
}

#[test]
fn newton_that_does_not_converge_is_an_error() {
    let error = integrate(&scene(0.2, 0.05, 0.15), &motion(0.02, 10.0), &springs(1e5, 1)).unwrap_err();
    assert!(matches!(error, Error::NotConverged { iterations: 30, residual, .. } if residual > 1e-9), "{error}");
}

/// Everything at once: several blocks per floor, on the ground, mu_s > mu_k, vertical motion with loss of contact,
/// P-Delta, Rayleigh damping, an initial state.
fn rich() -> (Scene, Motion) {
    let damping = Damping::Rayleigh { ratio: 0.03, modes: [1, 2] };
    let building = Building::new(vec![1000.0, 1200.0, 700.0], vec![storey(0.15, 0.1); 3], damping)
        .unwrap()
        .with_gravity(GravityEffect::GeometricStiffness(vec![9e3, 6e3, 3e3]))
        .unwrap();
    let block = |floor, mass, mu_s, mu_k| Block { mu_k, ..Block::new(floor, mass, mu_s) };
    let blocks = vec![
        block(1, 300.0, 0.25, 0.2),
        block(3, 500.0, 0.3, 0.3),
        block(1, 400.0, 0.15, 0.15),
        block(0, 100.0, 0.1, 0.08),
        Block { velocity: Some(0.3), ..block(2, 200.0, 0.2, 0.2) },
    ];
    let scene = Scene::new(Some(Arc::new(building)), blocks)
        .unwrap()
        .with_initial(vec![0.001, -0.002, 0.001], vec![0.1, 0.0, -0.1])
        .unwrap();
    let horizontal = motion(0.01, 6.0);
    let vertical: Vec<f64> = (0..=600).map(|i| 1.2 * G * (0.11 * f64::from(i)).sin()).collect();
    (scene, Motion::new(horizontal.acceleration(), 0.01, Some(vertical.into())).unwrap())
}

#[test]
fn all_features_converge_to_the_exact_solution() {
    let (scene, motion) = rich();
    let response = exact(&scene, &motion);
    let kinds = &response.statistics.events;
    println!("{kinds:?}");
    use EventKind::{Land, Lift, Reverse, Slip, Stick, Unload, Yield};
    for kind in [Yield, Unload, Slip, Stick, Reverse, Lift, Land] {
        assert!(kinds.of(kind) > 0, "{kind:?}: {kinds:?}");
    }
    for (name, method, substeps, limit) in [
        ("rich, Gauss", GAUSS, 512, 3e-3),
        ("rich, Gauss located", GAUSS_LOCATED, 32, 1e-9),
        ("rich, Newmark", NEWMARK, 512, 3e-3),
        ("rich, Newmark located", NEWMARK_LOCATED, 128, 1e-5),
        ("rich, leapfrog", LEAPFROG, 512, 3e-3),
    ] {
        let (errors, _) = study(name, &scene, &motion, method, &[substeps]);
        assert!(errors[0] < limit, "{name}: {}", errors[0]);
    }
}

/// Peaks over the method's own steps are those of continuous time from below, but for its error.
#[test]
fn peaks_are_taken_over_all_steps() {
    let (scene, motion) = (scene(0.2, 0.05, 0.15), motion(0.02, 10.0));
    let reference = exact(&scene, &motion);
    let found: History = integrate(&scene, &motion, &GAUSS_LOCATED(32)).unwrap();
    for i in 0..3 {
        for (found, exact) in
            [(found.peak_drift[i], reference.peaks.drift[i].value), (found.peak_slip[i], reference.peaks.slip[i].value)]
        {
            assert!(found <= exact * (1.0 + 1e-9) && found > exact * (1.0 - 1e-5), "{found} {exact}");
        }
    }
}

#[test]
fn a_collapse_ends_the_run() {
    let scene = scene(0.2, 0.05, 0.15).with_collapse_drift(vec![0.01, f64::INFINITY, f64::INFINITY]).unwrap();
    let motion = motion(0.02, 10.0);
    let Status::Collapsed { storey: 1, time } = exact(&scene, &motion).status else { panic!("no collapse") };
    for method in [GAUSS(64), GAUSS_LOCATED(64), NEWMARK(64), NEWMARK_LOCATED(64), LEAPFROG(64), springs(100.0, 64)] {
        let found = integrate(&scene, &motion, &method).unwrap();
        let Status::Collapsed { storey: 1, time: at } = found.status else { panic!("{method:?}: {:?}", found.status) };
        assert!((at - time).abs() < 0.002, "{method:?}: {at} {time}");
        assert!(found.drift[found.drift.len() - 1].is_nan() && found.peak_drift[0] >= 0.00999);
    }
}

#[test]
fn what_a_method_does_not_support_is_refused() {
    let (scene, motion) = (scene(0.2, 0.05, 0.15), motion(0.02, 1.0));
    let (rich, rich_motion) = rich();
    let ground = Scene::new(None, vec![Block::new(0, 1.0, 0.1)]).unwrap();
    let refused = |scene: &Scene, motion: &Motion, method: Method, message: &str| {
        let error = integrate(scene, motion, &method).unwrap_err();
        assert!(matches!(error, Error::Kernel(seismass::Error::Invalid { domain: Domain::Options, .. })), "{error:?}");
        assert!(error.to_string().starts_with(message), "{error}");
    };
    refused(&scene, &motion, GAUSS(0), "substeps of reference integrator must be at least 1; got 0");
    refused(&scene, &motion, LEAPFROG(0), "substeps of");
    let events = Events::Located { tolerance: 0.0 };
    refused(&scene, &motion, Method::Newmark { substeps: 1, events }, "tolerance of");
    refused(&scene, &motion, springs(-1.0, 1), "stiffness_ratio of");
    refused(&rich, &rich_motion, springs(10.0, 1), "mu_s of");
    refused(&ground, &motion, springs(10.0, 1), "scene of");
    let slow = Motion::new(vec![0.0; 3], 0.2, None).unwrap();
    refused(&scene, &slow, LEAPFROG(1), "substeps of");
    assert!(integrate(&scene, &slow, &LEAPFROG(5)).is_ok());
}

/// A block on the ground alone slides and arrives: events are located without a building.
#[test]
fn events_of_blocks_on_the_ground_are_located() {
    let scene = Scene::new(None, vec![Block::new(0, 1.0, 0.2)]).unwrap();
    let samples: Vec<f64> = (0..100).map(|i| 4.0 * (0.1 * f64::from(i)).sin()).collect();
    let motion = Motion::new(samples, 0.01, None).unwrap();
    let reference = exact(&scene, &motion);
    assert!(reference.statistics.events.total() >= 2);
    for method in [GAUSS_LOCATED(1), NEWMARK_LOCATED(8)] {
        let slip = integrate(&scene, &motion, &method).unwrap().peak_slip[0];
        assert!((slip / reference.peaks.slip[0].value - 1.0).abs() < 1e-2, "{method:?}: {slip}");
    }
}

/// Damping lowers the limit of the leapfrog: what passes stays bounded, what would not is refused.
#[test]
fn a_damped_leapfrog_needs_shorter_steps() {
    let motion = motion(0.02, 4.0);
    for damping in [Damping::Modal { ratio: 0.6 }, Damping::Rayleigh { ratio: 0.6, modes: [1, 2] }] {
        let building = Building::new(vec![1000.0; 3], vec![storey(100.0, 0.5); 3], damping).unwrap();
        let highest = std::f64::consts::TAU / building.periods()[2];
        let scene = Scene::new(Some(Arc::new(building)), vec![]).unwrap();
        let run = |substeps| integrate(&scene, &motion, &LEAPFROG(substeps));
        let least = (1..).find(|&substeps| run(substeps).is_ok()).unwrap();
        assert!(least as f64 > 0.02 * highest / 2.0 * 1.2, "{least}");
        let found = run(least).unwrap().peak_drift;
        for (found, exact) in found.iter().zip(&exact(&scene, &motion).peaks.drift) {
            assert!((found / exact.value - 1.0).abs() < 0.2, "{found} {}", exact.value);
        }
    }
}
