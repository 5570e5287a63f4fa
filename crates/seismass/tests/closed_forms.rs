//! Closed forms of blocks, oscillators and buildings: each derived from the equations of motion alone.
//!
//! Section numbers are those of the verification notes the tables come from. Their numbers use g = 9.81, so friction
//! coefficients are scaled to the kernel's g. A sine or a jump is not piecewise linear: tests show the table's digits
//! at a fine step and second-order convergence to the closed form.

#![allow(clippy::unwrap_used)]
// Tables hold what they hold.
#![allow(clippy::approx_constant)]

mod maximum;

use std::f64::consts::{PI, TAU};
use std::num::NonZeroUsize;
use std::sync::Arc;

use maximum::larger;
use nalgebra::{DMatrix, SymmetricEigen};
use seismass::{
    Block, Building, Damping, EventKind, Motion, Options, Response, STANDARD_GRAVITY, Scene, Storey, UniformBuilding,
    simulate,
};

const G: f64 = 9.81;
/// Scales a friction coefficient of the tables to the kernel's g.
const FRICTION: f64 = G / STANDARD_GRAVITY;

fn events() -> Options {
    Options { events: true, ..Options::default() }
}

fn every(samples: usize) -> Options {
    Options { histories: NonZeroUsize::new(samples), ..events() }
}

fn on_ground(mu_s: f64, mu_k: f64) -> Scene {
    let block = Block { mu_k: mu_k * FRICTION, ..Block::new(0, 1.0, mu_s * FRICTION) };
    Scene::new(None, vec![block]).unwrap()
}

/// Floors of unit mass with 5 % of critical damping in every mode.
fn uniform(storeys: usize, period: f64) -> Building {
    UniformBuilding { storeys, period, mass: 1.0, ..Default::default() }.build().unwrap()
}

/// A single storey of unit mass with a block on it.
fn oscillator(period: f64, damping: f64, alpha: f64, mu: f64, velocity: Option<f64>) -> Scene {
    let damping = Damping::Modal { ratio: damping };
    let building = UniformBuilding { storeys: 1, period, mass: 1.0, damping, ..Default::default() }.build().unwrap();
    Scene::new(Some(Arc::new(building)), vec![Block { velocity, ..Block::new(1, alpha, mu * FRICTION) }]).unwrap()
}

fn sampled(duration: f64, dt: f64, a: impl Fn(f64) -> f64) -> Motion {
    let samples: Vec<f64> = (0..=(duration / dt).round() as usize).map(|i| a(i as f64 * dt)).collect();
    Motion::new(samples, dt, None).unwrap()
}

fn last_event(response: &Response, kind: EventKind) -> f64 {
    response.events.as_ref().unwrap().iter().rev().find(|e| e.kind == kind).unwrap().time
}

fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance, "{what}: {found} against {expected}");
}

/// Section 6.1: slip V^2 / (2 mu g) (1 - mu g / A), stop at A td / (mu g).
#[test]
fn rectangular_pulse() {
    let (a, td) = (0.5 * G, 0.4);
    let solve = |mu_s: f64, steps: f64| {
        let dt = td / steps;
        // Half the jump at its sample.
        let pulse = |t: f64| {
            if t < td - 0.5 * dt {
                a
            } else if t < td + 0.5 * dt {
                0.5 * a
            } else {
                0.0
            }
        };
        simulate(&on_ground(mu_s, 0.2), &sampled(1.2, dt, pulse), &events()).unwrap()
    };
    for mu_s in [0.2, 0.3] {
        let response = solve(mu_s, 20_000.0);
        close(response.residual_slip[0].abs(), 0.5886, 1e-8, "slip");
        close(last_event(&response, EventKind::Stick), 1.0, 1e-8, "stop");
    }
    let error = |steps| (solve(0.2, steps).residual_slip[0].abs() - 0.5886).abs();
    close(error(100.0) / error(200.0), 4.0, 0.05, "order");
    assert_eq!(solve(0.51, 100.0).peaks.slip[0].value, 0.0);
}

/// Section 6.2.
#[test]
fn half_sine_pulse() {
    let (a, td) = (0.5 * G, 0.4);
    let solve = |mu: f64, steps: f64| {
        let pulse = |t: f64| if t < td { a * (PI * t / td).sin() } else { 0.0 };
        simulate(&on_ground(mu, mu), &sampled(0.8, td / steps, pulse), &events()).unwrap()
    };
    for (mu, slip, stop) in [
        (0.20, 0.1798045, 0.6624417),
        (0.30, 0.0637652, 0.4639050),
        (0.40, 0.0149328, 0.3675848),
        (0.45, 0.0036526, 0.3160732),
    ] {
        let response = solve(mu, 20_000.0);
        close(response.residual_slip[0].abs(), slip, 6e-8, "slip");
        close(last_event(&response, EventKind::Stick), stop, 6e-8, "stop");
    }
    // Closed form at mu = 0.2, where the block slides beyond the pulse.
    let (mu_g, s) = (0.2 * G, td / PI);
    let t1 = s * 0.4f64.asin();
    let cosine = (t1 / s).cos();
    let v = a * s * (cosine + 1.0) - mu_g * (td - t1);
    let exact =
        a * s * cosine * (td - t1) + a * s * s * (t1 / s).sin() - 0.5 * mu_g * (td - t1).powi(2) + v * v / (2.0 * mu_g);
    let error = |steps| (solve(0.2, steps).residual_slip[0].abs() - exact).abs();
    close(error(200.0) / error(400.0), 4.0, 0.1, "order");
}

/// A block thrown at rest ground stops after V / (mu g), here at a sample but for rounding. Whichever side of the sample
/// rounding puts the event, a row at or after the time in the log is that of a block at rest.
#[test]
fn rows_at_the_time_of_an_event_are_those_after_it() {
    let (dt, samples) = (0.005, 41);
    let motion = sampled(dt * f64::from(samples - 1), dt, |_| 0.0);
    let mut at_samples = 0;
    for step in 0..2000 {
        let mu = 0.05 + 1e-4 * f64::from(step);
        let velocity = mu * STANDARD_GRAVITY * (dt * f64::from(1 + step % (samples - 2)));
        let block = Block { velocity: Some(velocity), ..Block::new(0, 1.0, mu) };
        let response = simulate(&Scene::new(None, vec![block]).unwrap(), &motion, &every(1)).unwrap();
        let stop = last_event(&response, EventKind::Stick);
        for (row, &velocity) in response.histories.unwrap().block_velocity.iter().enumerate() {
            let time = row as f64 * dt;
            at_samples += i32::from(time == stop);
            assert!(
                time < stop || velocity == 0.0,
                "mu = {mu}: {velocity:e} m/s at {time} s, at rest from {stop} s on"
            );
        }
    }
    assert!(at_samples > 100, "{at_samples}");
}

/// Section 6.3: peak-to-peak slip in the steady state, continuous and stick-slip.
#[test]
fn harmonic_base() {
    let (a, w) = (4.0, TAU);
    let per_cycle = 20_000;
    for (eta, expected) in [
        (0.1, 1.9751719),
        (0.3, 1.7640112),
        (0.5, 1.2379818),
        (0.6, 0.7883721),
        (0.8, 0.1877945),
        (0.9, 0.0459352),
        (0.95, 0.0113646),
    ] {
        let cycles = if eta < 0.2 { 120 } else { 30 };
        let motion = sampled(f64::from(cycles), 1.0 / f64::from(per_cycle), |t| a * (w * t).sin());
        let scene = on_ground(eta * a / G, eta * a / G);
        let response = simulate(&scene, &motion, &every(1)).unwrap();
        let slip = &response.histories.as_ref().unwrap().slip;
        let last = &slip[slip.len() - per_cycle as usize..];
        let farthest = |sign: f64| last.iter().fold(f64::NEG_INFINITY, |most, slip| larger(most, sign * slip));
        close((farthest(1.0) + farthest(-1.0)) * w * w / a, expected, 7e-8, &format!("eta {eta}"));
    }
}

/// Section 6.4: step base acceleration, exactly piecewise linear: the closed form to rounding.
#[test]
fn step_gives_the_exact_effective_mass() {
    let table = [
        (0.5, [0.228970, 0.422604, 0.586920, 0.724745, 0.836920, 0.922604, 0.978970, 1.0]),
        (1.0, [0.224479, 0.411438, 0.570971, 0.707107, 0.820971, 0.911438, 0.974479, 1.0]),
        (1.5, [0.220651, 0.402579, 0.558736, 0.693713, 0.808736, 0.902579, 0.970651, 1.0]),
    ];
    let (period, a): (f64, f64) = (0.5, 0.4 * G);
    let w = TAU / period;
    for (alpha, row) in table {
        for (column, expected) in row.into_iter().enumerate() {
            let eta = 0.25 * (column + 1) as f64;
            let scene = oscillator(period, 0.0, alpha, eta * a / G, None);
            // Up to just beyond the first peak, which no later one beats without slip.
            let response = simulate(&scene, &sampled(0.55 * period * (1.0 + alpha).sqrt(), 0.001, |_| a), &events());
            let u = response.unwrap().peaks.drift[0].value;
            let exact = a / (w * w) * (1.0 + alpha * eta + (1.0 + alpha * (2.0 * eta - eta * eta)).sqrt());
            close(u, exact, 1e-13, &format!("drift, alpha {alpha}, eta {eta}"));
            let lambda = (u * w * w / (2.0 * a) - 1.0) / alpha;
            close(lambda, expected, 6e-7, &format!("lambda, alpha {alpha}, eta {eta}"));
        }
    }
    let u = 0.4 * G / (w * w) * (2.0 + 2f64.sqrt());
    close(u, 0.0848399, 5e-8, "example");
}

/// Section 6.5: a stuck block is added mass; it slips under steady harmonic motion iff mu < mu_0.
#[test]
fn slip_onset_on_the_stuck_steady_state() {
    let (period, zeta, alpha, base_period): (f64, f64, f64, f64) = (0.5, 0.05, 1.0, 0.6);
    let a = 0.2 * G;
    let (w, z) = (TAU / period / (1.0 + alpha).sqrt(), zeta / (1.0 + alpha).sqrt());
    let wg = TAU / base_period;
    let r = wg / w;
    let onset = a / G * ((1.0 + (2.0 * z * r).powi(2)) / ((1.0 - r * r).powi(2) + (2.0 * z * r).powi(2))).sqrt();
    close(onset, 0.504613, 5e-7, "mu_0");
    // u = p sin(wg t) + q cos(wg t) solves u'' + 2 z w u' + w^2 u = -a sin(wg t).
    let (d, c) = (w * w - wg * wg, 2.0 * z * w * wg);
    let (p, q) = (-a * d / (d * d + c * c), a * c / (d * d + c * c));
    for (factor, slips) in [(0.995, true), (1.005, false)] {
        let scene = oscillator(period, zeta, alpha, factor * onset, None).with_initial(vec![q], vec![p * wg]).unwrap();
        let motion = sampled(6.0, base_period / 1000.0, |t| a * (wg * t).sin());
        let response = simulate(&scene, &motion, &events()).unwrap();
        assert_eq!(response.peaks.slip[0].value > 0.0, slips, "mu = {factor} mu_0");
    }
}

/// Section 6.5: free vibration with the block at rest; it re-slips at once in the opposite sense.
#[test]
fn free_vibration_reverses_the_slip() {
    let (period, alpha, mu, v0): (f64, f64, f64, f64) = (0.5, 1.0, 0.2, 0.5);
    let w = TAU / period;
    let d = alpha * mu * G / (w * w);
    // v0 cos(wt) - d w sin(wt) = mu g t by Newton.
    let mut t = 0.0775;
    for _ in 0..20 {
        let f = v0 * (w * t).cos() - d * w * (w * t).sin() - mu * G * t;
        let rate = -v0 * w * (w * t).sin() - d * w * w * (w * t).cos() - mu * G;
        t -= f / rate;
    }
    close(t, 0.0774823, 5e-8, "t1");
    let u = -d * (1.0 - (w * t).cos()) + v0 / w * (w * t).sin();
    close(u, 0.0274649, 5e-8, "u");
    let scene = oscillator(period, 0.0, alpha, mu, Some(0.0)).with_initial(vec![0.0], vec![v0]).unwrap();
    let solve = |samples: usize| {
        let motion = Motion::new(vec![0.0; samples], t / 50.0, None).unwrap();
        simulate(&scene, &motion, &every(1)).unwrap()
    };
    let long = solve(60);
    let event = long.events.as_ref().unwrap()[0];
    assert_eq!((event.kind, event.sign), (EventKind::Reverse, 1));
    close(event.time, t, 1e-14, "time of reversal");
    let h = long.histories.unwrap();
    close(h.drift[50], u, 1e-14, "drift");
    close(h.floor_velocity[50], mu * G * t, 1e-13, "velocity");
    close(h.floor_velocity[50], 0.1520203, 5e-8, "velocity");
    close(h.slip[50], 0.5 * mu * G * t * t - u, 1e-14, "slip");
    close(h.slip[50], -0.0215755, 5e-8, "slip");
}

/// Section 6.6: Den Hartog's continuous motion, the block an inertial wall.
#[test]
fn den_hartog() {
    let (period, x, alpha): (f64, f64, f64) = (1.0, 0.1, 1e7);
    let w = TAU / period;
    for (beta, force_ratio, expected) in [(2.0 / 3.0, 0.3, 1.7428425), (1.5, 0.3, 0.7211103), (2.0, 0.2, 0.3179797)] {
        let base = beta * w;
        let (v, u): (f64, f64) = (1.0 / (1.0 - beta * beta), (PI / beta).sin() / (beta * (1.0 + (PI / beta).cos())));
        let exact = (v * v - (force_ratio * u).powi(2)).sqrt();
        close(exact, expected, 6e-8, "closed form");
        let per_cycle = 10_000;
        let (cycles, dt) = (150.0, TAU / base / f64::from(per_cycle));
        // F = alpha mu g m with F / (k x) given; k = w^2 for unit mass.
        let mu = force_ratio * w * w * x / (alpha * G);
        let scene = oscillator(period, 0.0, alpha, mu, Some(-x * base));
        let motion = sampled(cycles * TAU / base, dt, |t| -x * base * base * (base * t).sin());
        let response = simulate(&scene, &motion, &every(1)).unwrap();
        let drift = &response.histories.as_ref().unwrap().drift;
        let amplitude = (drift.len() - per_cycle as usize..drift.len())
            .map(|i| (drift[i] + x * (base * i as f64 * dt).sin()).abs())
            .fold(0.0, larger);
        close(amplitude / x, expected, 1.5e-7, &format!("beta {beta}"));
    }
}

/// Section 6.8: fundamental periods with the blocks stuck, roof bare, and of the validation building.
#[test]
fn periods_with_blocks_stuck() {
    let table = [
        (2, 0.38, [0.3866, 0.3933, 0.4000, 0.4068, 0.4340, 0.4609]),
        (3, 0.47, [0.4833, 0.4965, 0.5095, 0.5223, 0.5715, 0.6176]),
        (4, 0.57, [0.5900, 0.6096, 0.6286, 0.6472, 0.7175, 0.7821]),
    ];
    for (n, period, row) in table {
        let bare = uniform(n, period);
        close(bare.periods()[0], period, 1e-14, "bare");
        for (alpha, expected) in [0.125, 0.25, 0.375, 0.5, 1.0, 1.5].into_iter().zip(row) {
            let mut mass = vec![1.0 + alpha; n];
            mass[n - 1] = 1.0;
            let stuck = Building::new(mass, bare.storeys().to_vec(), Damping::default()).unwrap();
            close(stuck.periods()[0], expected, 5e-5, &format!("{n} storeys, alpha {alpha}"));
        }
    }
    let validation = uniform(3, 0.6 * 2f64.sqrt()).periods();
    for (found, expected) in validation.into_iter().zip([0.84853, 0.30284, 0.20957]) {
        close(found, expected, 5e-6, "validation building, blocks stuck");
    }
}

/// Section 6.8: modal damping matrix of the validation building.
#[test]
fn damping_matrix_of_the_validation_building() {
    let c = uniform(3, 0.6).damping_matrix();
    let expected = [[3.1873, -0.9345, -0.2030], [-0.9345, 2.9843, -1.1375], [-0.2030, -1.1375, 2.0498]];
    for (i, row) in expected.iter().enumerate() {
        for (j, &value) in row.iter().enumerate() {
            close(c[(i, j)], value, 5e-5, "C/m");
        }
    }
}

/// Section 6.8: energy is input = kinetic + strain + viscous + hysteretic + sum of mu m g times the slip path.
#[test]
fn friction_energy_is_the_slip_path() {
    let storeys = vec![Storey::yielding(4e5, 3000.0), Storey::yielding(4e5, 2000.0)];
    let building = Building::new(vec![1000.0; 2], storeys, Damping::Modal { ratio: 0.05 }).unwrap();
    let blocks = vec![Block::new(1, 800.0, 0.15), Block::new(2, 500.0, 0.25)];
    let scene = Scene::new(Some(Arc::new(building)), blocks.clone()).unwrap();
    let motion = sampled(12.0, 0.01, |t| 5.0 * (5.0 * t).sin() * (0.26 * t).sin());
    let response = simulate(&scene, &motion, &Options { energy: true, ..events() }).unwrap();
    let energy = response.energy.unwrap();
    let path: f64 = blocks.iter().zip(&response.slip_path).map(|(b, p)| b.mu_k * b.mass * STANDARD_GRAVITY * p).sum();
    assert!(energy.hysteretic > 0.0 && energy.friction > 0.0);
    close(energy.friction, path, 1e-12 * energy.input, "friction energy");
    close(energy.relative_residual, 0.0, 1e-13, "residual");
}

/// Section 6.8: slip where |a_h| passes mu (g + a_v); without contact the block keeps its velocity.
#[test]
fn contact_under_vertical_motion() {
    let mu = 0.3;
    let scene = Scene::new(None, vec![Block::new(0, 1.0, mu)]).unwrap();
    let dt = 0.1;
    let ramp: Vec<f64> = (0..=20).map(|i| 2.0 * f64::from(i) * dt).collect();
    for vertical_slope in [0.0, 1.5, -1.5] {
        let vertical: Vec<f64> = (0..=20).map(|i| -2.0 + vertical_slope * f64::from(i) * dt).collect();
        let motion = Motion::new(ramp.clone(), dt, Some(vertical.into())).unwrap();
        let event = simulate(&scene, &motion, &events()).unwrap().events.unwrap()[0];
        let expected = mu * (STANDARD_GRAVITY - 2.0) / (2.0 - mu * vertical_slope);
        assert_eq!((event.kind, event.sign), (EventKind::Slip, -1));
        close(event.time, expected, 1e-14, "breakaway");
    }
    // Constant 3 m/s2 from 0.3 s; contact lost while g + a_v < 0: the ground runs away under the block.
    let level = |i: i32| if i < 3 { 0.0 } else { 3.0 };
    let horizontal: Vec<f64> = (0..=40).map(level).collect();
    let vertical: Vec<f64> =
        (0..=40).map(|i| if (5..=15).contains(&i) { -2.0 * STANDARD_GRAVITY } else { 0.0 }).collect();
    let frictionless = Scene::new(None, vec![Block::new(0, 1.0, 100.0)]).unwrap();
    let motion = Motion::new(horizontal, dt, Some(vertical.into())).unwrap();
    let response = simulate(&frictionless, &motion, &every(1)).unwrap();
    let log: Vec<_> = response.events.as_ref().unwrap().iter().map(|e| e.kind).collect();
    assert_eq!(&log[..3], &[EventKind::Slip, EventKind::Lift, EventKind::Land]);
    let (lift, land) = (response.events.as_ref().unwrap()[1].time, response.events.as_ref().unwrap()[2].time);
    close(lift, 0.45, 1e-14, "lift");
    close(land, 1.55, 1e-14, "land");
    let velocity = &response.histories.as_ref().unwrap().block_velocity;
    close(velocity[15] - velocity[5], -3.0 * 1.0, 1e-13, "free flight");
}

/// Blocks that move alike come to rest together, also without friction and acceleration, where nothing but rounding is left
/// of their velocities: one by one, each arrival would decide all that came before it once more.
#[test]
fn blocks_that_move_alike_arrive_together() {
    let count = 20;
    let scene = Scene::new(None, (1..=count).map(|j| Block::new(0, j as f64, 0.0)).collect()).unwrap();
    let saw = |i: i32| if (i / 8) % 2 == 0 { 0.7 } else { -0.7 } * f64::from(i % 8) / 8.0;
    let motion = Motion::new((0..240).map(saw).collect::<Vec<_>>(), 2f64.powi(-7), None).unwrap();
    let log = simulate(&scene, &motion, &events()).unwrap().events.unwrap();
    let of_block = |j| log.iter().filter(|e| e.number == j).map(|e| (e.time, e.kind, e.sign)).collect::<Vec<_>>();
    for j in 2..=count {
        assert_eq!(of_block(j), of_block(1));
    }
    let most = log.chunk_by(|a, b| a.time == b.time).map(<[_]>::len).max().unwrap();
    assert!(most <= 2 * count, "{most} events at one instant");
}

/// A block in flight is overtaken by the ground at the very time of a sample: the turn counts in its path.
#[test]
fn slip_path_of_a_turn_at_a_sample() {
    let (v0, a, dt, samples) = (0.25, 4.0, 2f64.powi(-7), 17);
    let block = Block { velocity: Some(v0), ..Block::new(0, 1.0, 0.2) };
    let scene = Scene::new(None, vec![block]).unwrap();
    let motion = Motion::new(vec![a; samples], dt, Some(vec![-STANDARD_GRAVITY; samples].into())).unwrap();
    let response = simulate(&scene, &motion, &events()).unwrap();
    let (turn, peak) = (v0 / a, v0 * v0 / (2.0 * a));
    assert_eq!(turn / dt, 8.0);
    assert_eq!((response.peaks.slip[0].value, response.peaks.slip[0].time), (peak, turn));
    // It is back where it began.
    assert_eq!((response.residual_slip[0], response.slip_path[0]), (0.0, 2.0 * peak));
}

/// Contact that grows from zero on a floor that moves without acceleration: every block is at its limit at once, and rates
/// decide, block by block. Two slide and the third sticks; the floor is driven on by friction that grows with time.
#[test]
fn contact_that_grows_from_zero_is_decided_by_rates() {
    let (m, k, v0, slope, dt) = (1000.0, 4e4, 0.45, 40.0, 0.02);
    let blocks = [(300.0, 0.1), (500.0, 0.17), (700.0, 0.3)];
    let building = Building::new(vec![m], vec![Storey::elastic(k)], Damping::Modal { ratio: 0.0 }).unwrap();
    // In every order in which they may be listed.
    for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
        let listed = order.map(|j| Block::new(1, blocks[j].0, blocks[j].1));
        let scene = Scene::new(Some(Arc::new(building.clone())), listed.to_vec()).unwrap();
        let scene = scene.with_initial(vec![0.0], vec![v0]).unwrap();
        let vertical = vec![-STANDARD_GRAVITY, slope * dt - STANDARD_GRAVITY];
        let motion = Motion::new(vec![0.0; 2], dt, Some(vertical.into())).unwrap();
        let response = simulate(&scene, &motion, &every(1)).unwrap();
        let at = |j: usize| order.iter().position(|&o| o == j).unwrap();
        let log: Vec<_> = response.events.unwrap().iter().map(|e| (e.time, e.kind, e.number, e.sign)).collect();
        assert_eq!(log, [0, 1].map(|j| (0.0, EventKind::Slip, at(j) + 1, 1)), "{order:?}");

        let friction: f64 = blocks[..2].iter().map(|(mass, mu)| mu * mass * slope).sum();
        let frequency = (k / (m + blocks[2].0)).sqrt();
        let drift = friction / k * dt + (v0 - friction / k) / frequency * (frequency * dt).sin();
        let histories = response.histories.unwrap();
        close(histories.drift[1], drift, 1e-16, "drift");
        let slips = [0, 1].map(|j| v0 * dt - blocks[j].1 * slope * dt.powi(3) / 6.0 - drift);
        for (j, slip) in [slips[0], slips[1], 0.0].into_iter().enumerate() {
            assert!(j == 2 || slip > 1e-7);
            close(histories.slip[3 + at(j)], slip, 1e-17, "slip");
        }
    }
}

/// No block, no yielding: modal superposition with the exact recurrence of each mode (Nigam & Jennings 1969).
#[test]
fn elastic_building_equals_modal_recurrence() {
    let mass = [1400.0, 1200.0, 1000.0, 700.0];
    let stiffness = [1.9e6, 1.5e6, 1.1e6, 0.6e6];
    let (zeta, dt, n) = (0.05, 0.01, mass.len());
    let motion = sampled(20.0, dt, |t| 3.0 * (7.0 * t).sin() * (0.16 * t).sin() + (23.0 * t).cos());
    let building =
        Building::new(mass.to_vec(), stiffness.map(Storey::elastic).to_vec(), Damping::Modal { ratio: zeta }).unwrap();
    let scene = Scene::new(Some(Arc::new(building)), Vec::new()).unwrap();
    let response = simulate(&scene, &motion, &every(1)).unwrap();
    let found = &response.histories.as_ref().unwrap().drift;

    let k = |i: usize| if i < n { stiffness[i] } else { 0.0 };
    let symmetric = DMatrix::from_fn(n, n, |i, j| {
        let value = match (i as i64) - (j as i64) {
            0 => k(i) + k(i + 1),
            1 => -k(i),
            -1 => -k(j),
            _ => 0.0,
        };
        value / (mass[i] * mass[j]).sqrt()
    });
    let eigen = SymmetricEigen::new(symmetric);
    let samples = motion.acceleration();
    let mut displacement = vec![vec![0.0; n]; samples.len()];
    for mode in 0..n {
        let w = eigen.eigenvalues[mode].sqrt();
        let shape: Vec<f64> = (0..n).map(|i| eigen.eigenvectors[(i, mode)] / mass[i].sqrt()).collect();
        let participation: f64 = (0..n).map(|i| shape[i] * mass[i]).sum();
        let wd = w * (1.0 - zeta * zeta).sqrt();
        let (decay, s, c) = ((-zeta * w * dt).exp(), (wd * dt).sin(), (wd * dt).cos());
        let (mut q, mut rate) = (0.0, 0.0);
        for (i, pair) in samples.windows(2).enumerate() {
            let (load, slope) = (-participation * pair[0], -participation * (pair[1] - pair[0]) / dt);
            // Particular solution p0 + p1 t, then the damped free vibration of the rest.
            let p1 = slope / (w * w);
            let p0 = (load - 2.0 * zeta * w * p1) / (w * w);
            let (free, free_rate) = (q - p0, rate - p1);
            let b = (free_rate + zeta * w * free) / wd;
            let next = decay * (free * c + b * s);
            let next_rate = decay * ((b * wd - zeta * w * free) * c - (free * wd + zeta * w * b) * s);
            (q, rate) = (next + p0 + p1 * dt, next_rate + p1);
            for (u, phi) in displacement[i + 1].iter_mut().zip(&shape) {
                *u += phi * q;
            }
        }
    }
    let peak = found.iter().fold(0.0, |most, d| larger(most, d.abs()));
    for (row, u) in displacement.iter().enumerate() {
        for i in 0..n {
            let drift = u[i] - if i > 0 { u[i - 1] } else { 0.0 };
            close(found[row * n + i], drift, 1e-12 * peak, "drift");
        }
    }
}

/// P/h is the gravity load of a floor and of all above, each with the weight of its blocks, over the storey's height;
/// blocks on the ground load no storey.
#[test]
fn p_delta_has_the_weight_of_the_blocks() {
    let (heights, floor_loads) = (vec![4.3, 3.7, 3.1], vec![11.0, 7.0, 5.0]);
    let gravity = seismass::GravityEffect::Loads { heights, floor_loads };
    let building = Arc::new(uniform(3, 0.5).with_gravity(gravity).unwrap());
    let blocks = [(1, 0.31), (1, 0.17), (3, 0.23), (0, 0.71)].map(|(floor, mass)| Block::new(floor, mass, 0.3));
    let with_goods = |weight: f64| {
        let (third, second) = (5.0 + 0.23 * weight, 7.0);
        let first = 11.0 + (0.31 + 0.17) * weight;
        [(first + second + third) / 4.3, (second + third) / 3.7, third / 3.1]
    };
    for (blocks, weight) in [(blocks.to_vec(), STANDARD_GRAVITY), (Vec::new(), 0.0)] {
        let scene = Scene::new(Some(Arc::clone(&building)), blocks).unwrap();
        for (found, expected) in scene.geometric_stiffness().iter().zip(with_goods(weight)) {
            close(*found, expected, 1e-12 * expected, "P/h");
        }
    }
}
