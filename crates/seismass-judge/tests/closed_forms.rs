//! Closed forms: Newmark's block under a pulse, an elastic storey with a block under a step, free vibration with a
//! block that slides. Numbers of the literature use g = 9.81 and the kernel 9.80665, so mu is multiplied by their ratio.

#![allow(clippy::unwrap_used)]

use std::cmp::Ordering;
use std::sync::Arc;

use seismass::{
    Block, Building, Damping, EventKind, GravityEffect, Motion, STANDARD_GRAVITY, Scene, Status, Storey,
    UniformBuilding,
};
use seismass_judge::{DoubleDouble, Real, Solution, solve};

/// Acceleration of gravity of the tabulated numbers (m/s2).
const G: f64 = 9.81;

/// The coefficient that gives the kernel's g the same mu g.
fn mu(value: f64) -> f64 {
    value * G / STANDARD_GRAVITY
}

fn ground_block(mu_s: f64, mu_k: f64) -> Scene {
    let block = Block { mu_k: mu(mu_k), ..Block::new(0, 1.0, mu(mu_s)) };
    Scene::new(None, vec![block]).unwrap()
}

fn run<R: Real>(scene: &Scene, motion: &Motion) -> Solution {
    let solution = solve::<R>(scene, motion, 1).unwrap();
    assert!(solution.energy.relative_residual.abs() < 1e4 * R::EPSILON, "{:?}", solution.energy);
    solution
}

/// Newmark (1965): a rectangular pulse A for t_d slips a block V^2 / (2 mu g) (1 - mu g / A), V = A t_d, until
/// V / (mu g): 0.5886 m and 1 s. Sampled with half the jump at its sample the edge is a ramp of the same area, which
/// takes A dt^2 / 6 off the displacement and nothing off the velocity.
#[test]
fn rectangular_pulse() {
    let a = 0.5 * G;
    for mu_s in [0.2, 0.3] {
        for dt in [0.02, 0.004] {
            let edge = (0.4f64 / dt).round() as usize;
            let sample = |i: usize| match i.cmp(&edge) {
                Ordering::Less => a,
                Ordering::Equal => 0.5 * a,
                Ordering::Greater => 0.0,
            };
            let motion = Motion::new((0..=3 * edge).map(sample).collect::<Vec<_>>(), dt, None).unwrap();
            let solution = run::<DoubleDouble>(&ground_block(mu_s, 0.2), &motion);
            let [_, stop] = solution.events[..] else { panic!("{:?}", solution.events) };
            let slip = -0.5886 + a * dt * dt / 6.0;
            assert!((solution.residual_slip[0] - slip).abs() < 1e-15, "{:?} {slip}", solution.residual_slip);
            assert!((stop.time - 1.0).abs() < 1e-15 && stop.kind == EventKind::Stick, "{stop:?}");
        }
    }
    // At the limit itself the block does not move.
    let motion = Motion::new(vec![0.2 * G; 50], 0.01, None).unwrap();
    let solution = run::<f64>(&ground_block(0.2, 0.2), &motion);
    assert_eq!((solution.events.len(), solution.residual_slip[0]), (0, 0.0));
}

/// Along a given motion friction's work is proportional to g + a_v, and changes with g and a_v by their sizes: relative
/// to the energy it is (g + |a_v|) / (g + a_v) times the share of friction in the only input.
#[test]
fn condition_of_the_energy_balance() {
    let scene = ground_block(0.2, 0.2);
    for vertical in [0.0, 1.0, -5.0, 1e-6 - STANDARD_GRAVITY] {
        let motion = Motion::new(vec![5.0; 101], 0.01, Some(vec![vertical; 101].into())).unwrap();
        let solution = run::<DoubleDouble>(&scene, &motion);
        let share = solution.energy.friction / solution.energy.input;
        let condition = share * (STANDARD_GRAVITY + vertical.abs()) / (STANDARD_GRAVITY + vertical);
        assert!((solution.contact_condition / condition - 1.0).abs() < 1e-8, "{vertical}: {condition:e}");
    }
}

/// The half-sine pulse of 0.5 g and 0.4 s: slip and time of stopping, seven digits tabulated.
#[test]
fn half_sine_pulse() {
    let dt = 0.4 / 20_000.0;
    let sine = |i: usize| if i < 20_000 { (std::f64::consts::PI * i as f64 / 20_000.0).sin() } else { 0.0 };
    let motion = Motion::new((0..35_000).map(|i| 0.5 * G * sine(i)).collect::<Vec<_>>(), dt, None).unwrap();
    let table = [
        (0.2, 0.1798045, 0.6624417),
        (0.3, 0.0637652, 0.4639050),
        (0.4, 0.0149328, 0.3675848),
        (0.45, 0.0036526, 0.3160732),
    ];
    for (coefficient, slip, stop) in table {
        let solution = run::<f64>(&ground_block(coefficient, coefficient), &motion);
        assert!((solution.peaks.slip[0].value - slip).abs() < 6e-8, "{coefficient}: {}", solution.peaks.slip[0].value);
        let last = solution.events.last().unwrap();
        assert!((last.time - stop).abs() < 6e-8 && last.kind == EventKind::Stick, "{coefficient}: {last:?}");
    }
}

fn storey(mass: f64, period: f64, ratio: f64) -> Building {
    UniformBuilding { storeys: 1, period, mass, damping: Damping::Modal { ratio }, ..Default::default() }
        .build()
        .unwrap()
}

/// Step of ground acceleration A on an undamped storey with a block of alpha times its mass and mu g = eta A:
/// |u|max = A / w^2 (1 + alpha eta + sqrt(1 + alpha (2 eta - eta^2))).
#[test]
fn step_on_an_elastic_storey() {
    let (period, a) = (0.5, 0.4 * G);
    let w = 2.0 * std::f64::consts::PI / period;
    for alpha in [0.5, 1.0, 1.5] {
        for eta in [0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 1.75] {
            let block = Block::new(1, alpha, eta * a / STANDARD_GRAVITY);
            let scene = Scene::new(Some(Arc::new(storey(1.0, period, 0.0))), vec![block]).unwrap();
            let motion = Motion::new(vec![a; 100], 0.005, None).unwrap();
            let solution = run::<DoubleDouble>(&scene, &motion);
            let root = (1.0 + alpha * (2.0 * eta - eta * eta)).sqrt();
            let expected = a / (w * w) * (1.0 + alpha * eta + root);
            assert!((solution.peaks.drift[0].value / expected - 1.0).abs() < 1e-14, "alpha {alpha}, eta {eta}");
            assert_eq!(solution.events[0].kind, EventKind::Slip);
        }
    }
}

/// Free vibration, floor with v0 = 0.5 m/s, block at rest: the relative velocity passes zero at t1 = 0.0774823 s
/// without sticking, where u = 0.0274649 m and the block has slipped -0.0215755 m.
#[test]
fn free_vibration_reverses_without_sticking() {
    let block = Block { velocity: Some(0.0), ..Block::new(1, 1.0, mu(0.2)) };
    let scene = Scene::new(Some(Arc::new(storey(1.0, 0.5, 0.0))), vec![block]).unwrap();
    let scene = scene.with_initial(vec![0.0], vec![0.5]).unwrap();
    let end = 0.0774823;
    let motion = Motion::new(vec![0.0; 11], end / 10.0, None).unwrap();
    let solution = run::<DoubleDouble>(&scene, &motion);
    assert!((solution.residual_drift[0] - 0.0274649).abs() < 6e-8, "{:?}", solution.residual_drift);
    assert!((solution.residual_slip[0] + 0.0215755).abs() < 6e-8, "{:?}", solution.residual_slip);
    let motion = Motion::new(vec![0.0; 11], 0.009, None).unwrap();
    let solution = run::<DoubleDouble>(&scene, &motion);
    let [event] = solution.events[..] else { panic!("{:?}", solution.events) };
    assert_eq!((event.kind, event.sign), (EventKind::Reverse, 1));
    assert!((event.time - end).abs() < 6e-8, "{event:?}");
    // u = -d (1 - cos w t) + v0 / w sin w t with d = alpha mu g / w^2 up to then.
    let w = 4.0 * std::f64::consts::PI;
    let d = 0.2 * G / (w * w);
    let drift = |t: f64| -d * (1.0 - (w * t).cos()) + 0.5 / w * (w * t).sin();
    for i in 0..9 {
        assert!((solution.drift[i] - drift(0.009 * i as f64)).abs() < 1e-15, "sample {i}");
    }
}

/// Stuck blocks are mass: T sqrt(1 + alpha), zeta / sqrt(1 + alpha).
#[test]
fn a_stuck_block_is_mass() {
    let block = Block::new(1, 1500.0, 100.0);
    let building = storey(1000.0, 0.5, 0.05);
    let c = building.damping_matrix();
    let k = building.storeys()[0].stiffness;
    let heavy = Building::new(vec![2500.0], vec![Storey::elastic(k)], Damping::Matrix(c)).unwrap();
    let motion = Motion::new((0..400).map(|i| (0.1 * i as f64).sin()).collect::<Vec<_>>(), 0.02, None).unwrap();
    let with_block = run::<f64>(&Scene::new(Some(Arc::new(building)), vec![block]).unwrap(), &motion);
    let with_mass = run::<f64>(&Scene::new(Some(Arc::new(heavy)), vec![]).unwrap(), &motion);
    for (a, b) in with_block.drift.iter().zip(&with_mass.drift) {
        assert!((a - b).abs() <= 1e-14 * with_mass.peaks.drift[0].value);
    }
}

/// V(d) = 20 N beyond 1.1 m (k = 100 N/m, V_y = 10 N, Omega = 2, r2 = 0.1, r3 = 0) meets P/h d at 5 m for 4 N/m,
/// and V(d) = 9 + 10 d meets 40 d at 0.3 m.
#[test]
fn collapse_is_where_the_backbone_meets_p_delta() {
    for (geometric, drift) in [(4.0, 5.0), (40.0, 0.3)] {
        let storey = Storey { overstrength: 2.0, second_slope: 0.1, third_slope: 0.0, ..Storey::yielding(100.0, 10.0) };
        let building = Building::new(vec![1.0], vec![storey], Damping::Modal { ratio: 0.05 }).unwrap();
        let building = building.with_gravity(GravityEffect::GeometricStiffness(vec![geometric])).unwrap();
        let scene = Scene::new(Some(Arc::new(building)), vec![]).unwrap();
        let motion = Motion::new(vec![-30.0; 1000], 0.01, None).unwrap();
        let solution = run::<DoubleDouble>(&scene, &motion);
        let Status::Collapsed { storey: 1, time } = solution.status else { panic!("{:?}", solution.status) };
        assert!((solution.residual_drift[0] - drift).abs() < 1e-14 * drift, "{:?}", solution.residual_drift);
        assert!((solution.peaks.drift[0].value - drift).abs() < 1e-14 * drift && solution.end_time == time);
        assert!(solution.drift[solution.rows - 1].is_nan() && solution.drift[0] == 0.0);
    }
}
