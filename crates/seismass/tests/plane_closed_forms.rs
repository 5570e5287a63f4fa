//! Closed forms in two horizontal directions: wear, lift-off, grazes, collapse and stops (`numerics`, section 9.7).

#![allow(clippy::unwrap_used)]

#[allow(dead_code)] // Only numbers are drawn.
mod general_random;

use std::sync::Arc;

use general_random::Draw;
use seismass::{
    Block, Damping, EventKind, GeneralBuilding, GeneralScene, GeneralStatus, Goods, GravityEffect, Motion, Options,
    PlaneMotion, PlaneResponse, PlaneScene, STANDARD_GRAVITY, Stops, Storey, Wear, simulate_general, simulate_plane,
};

const G: f64 = STANDARD_GRAVITY;

/// What rounding leaves of numbers of size 1.
const ROUNDING: f64 = 1e-13;

/// Ground accelerates by this vector (m/s2), of length 2.5.
const PUSH: [f64; 2] = [1.5, -2.0];

fn solve(scene: &PlaneScene, motion: &PlaneMotion) -> PlaneResponse {
    let options = Options { energy: true, events: true, ..Options::default() };
    let response = simulate_plane(scene, motion, &options).unwrap();
    assert!(response.energy.unwrap().total.relative_residual.abs() < 1e-11);
    response
}

fn times(response: &PlaneResponse, kind: EventKind) -> Vec<f64> {
    let events = response.events.as_ref().unwrap().iter();
    events.filter(|e| e.event.event.kind == kind).map(|e| e.event.event.time).collect()
}

/// The same goods in x and in y, but for their velocities.
fn on_ground(goods: impl Fn(usize) -> Goods) -> PlaneScene {
    let of = |axis: usize| GeneralScene::new(None, vec![goods(axis)], Vec::new()).unwrap();
    PlaneScene::new(of(0), of(1)).unwrap()
}

fn constant(push: [f64; 2], samples: usize, dt: f64) -> PlaneMotion {
    PlaneMotion::new(Motion::new(vec![push[0]; samples], dt, None).unwrap(), vec![push[1]; samples]).unwrap()
}

/// A block slides straight from rest by (a - mu g) t^2/2. At a path p, which it reaches at t = sqrt(2 p/(a - mu g)), its
/// coefficient changes.
#[test]
fn a_straight_path_wears() {
    let (before, after, path, end) = (2.5 - 0.1 * G, 2.5 - 0.22 * G, 0.05, 0.5);
    let wear = vec![Wear { path, mu_s: 0.22, mu_k: 0.22 }];
    let scene = on_ground(|_| Block { wear: wear.clone(), ..Block::new(0, 3.0, 0.1) }.into());
    let response = solve(&scene, &constant(PUSH, 51, 0.01));
    let worn = (2.0 * path / before).sqrt();
    let rest = end - worn;
    let slip = path + before * worn * rest + 0.5 * after * rest * rest;
    assert!((times(&response, EventKind::Wear)[0] - worn).abs() < ROUNDING);
    assert!((response.slip_path[0] - slip).abs() < ROUNDING);
    for (found, expected) in response.residual_slip[0].iter().zip([-0.6 * slip, 0.8 * slip]) {
        assert!((found - expected).abs() < ROUNDING, "{found} for {expected}");
    }
}

/// The path of wear is that along a curve: a run that ends where another block wears has slipped just that path.
#[test]
fn a_curved_path_wears_by_its_length() {
    let path = 0.1;
    let thrown = |wear: Vec<Wear>| {
        on_ground(|axis| {
            Block { velocity: Some([0.0, 0.9][axis]), wear: wear.clone(), ..Block::new(0, 3.0, 0.2) }.into()
        })
    };
    let worn = solve(&thrown(vec![Wear { path, mu_s: 0.1, mu_k: 0.1 }]), &constant([1.2, 0.0], 60, 0.01));
    let end = times(&worn, EventKind::Wear)[0];
    let response = solve(&thrown(Vec::new()), &constant([1.2, 0.0], 31, end / 30.0));
    assert!((response.slip_path[0] - path).abs() < ROUNDING);
    let straight = response.residual_slip[0][0].hypot(response.residual_slip[0][1]);
    assert!(straight < 0.999 * path, "{straight}: the path is curved");
}

/// Vertical motion falls in a straight line from 0 to -2 g within T and rises again: contact is lost from T/2 to 3 T/2. With
/// w the time from the ends, N = g (1 - 2 w/T), which gives all integrals.
#[test]
fn a_block_that_slides_lifts_off_and_lands() {
    let (t, a, friction, parts) = (0.4, 2.5, 0.1 * G, 40);
    let fall = |i: usize| 2.0 * G * (i as f64 / parts as f64 - 1.0).abs() - 2.0 * G;
    let vertical: Vec<f64> = (0..=2 * parts).map(fall).collect();
    let samples = vec![PUSH[0]; 2 * parts + 1];
    let motion = Motion::new(samples, t / parts as f64, Some(vertical.into())).unwrap();
    let motion = PlaneMotion::new(motion, vec![PUSH[1]; 2 * parts + 1]).unwrap();
    let response = solve(&on_ground(|_| Block::new(0, 3.0, 0.1).into()), &motion);
    for (kind, expected) in [(EventKind::Lift, 0.5 * t), (EventKind::Land, 1.5 * t)] {
        let found = times(&response, kind);
        assert!(found.len() == 1 && (found[0] - expected).abs() < ROUNDING, "{kind:?}: {found:?}");
    }
    let at_lift = (a / 8.0 - friction / 12.0) * t * t;
    let in_air = (a - 0.25 * friction) * t * t;
    let slip = (2.0 * a - 0.5 * friction) * t * t;
    for (found, expected) in response.residual_slip[0].iter().zip([-0.6 * slip, 0.8 * slip]) {
        assert!((found - expected).abs() < ROUNDING, "{found} for {expected}");
    }
    assert!((response.slip_path[0] - (slip - in_air)).abs() < ROUNDING, "the path of slip counts contact only");
    assert!(at_lift < slip - in_air);
}

/// A storey without damping, period 0.5 s, in both directions, with a block of half the floor's mass.
fn oscillator(mu: f64, drift: [f64; 2], velocity: [f64; 2], collapse: Option<[f64; 2]>) -> [GeneralScene; 2] {
    let stiffness = 1.5e3 * (4.0 * std::f64::consts::PI).powi(2);
    let damping = Damping::Modal { ratio: 0.0 };
    let storeys = vec![Storey::elastic(stiffness)];
    let building = GeneralBuilding::new(vec![1e3], storeys, None, &damping, GravityEffect::None).unwrap();
    let building = Arc::new(building);
    [0, 1].map(|axis: usize| {
        let goods = vec![Block::new(1, 500.0, mu).into()];
        let scene = GeneralScene::new(Some(building.clone()), goods, Vec::new()).unwrap();
        let scene = scene.with_initial(vec![drift[axis]], vec![velocity[axis]]).unwrap();
        match collapse {
            Some(limits) => scene.with_collapse_drift(vec![limits[axis]]).unwrap(),
            None => scene,
        }
    })
}

/// With its block stuck the floor goes round an ellipse, and |A| = w^2 |u| is largest at the ends of its long axis, where
/// d|A|/dt = 0. Friction that is less by a part e lets the block slide for a time of the order of sqrt(e)/w, with an excess
/// of at most e |A|: the slip is of the order of e^2. Where e is rounding, nothing but grazes may come of it.
#[test]
fn grazes_of_an_ellipse() {
    let (omega, long, short) = (4.0 * std::f64::consts::PI, 0.02, 0.012);
    let limit = omega * omega * long / G;
    let still = PlaneMotion::new(Motion::new(vec![0.0; 151], 0.01, None).unwrap(), vec![0.0; 151]).unwrap();
    for part in [-1e-9, -1e-15, 0.0, 1e-15, 1e-13, 1e-11, 1e-9, 1e-7, 1e-5] {
        let [x, y] = oscillator(limit * (1.0 - part), [long, 0.0], [0.0, omega * short], None);
        let response = solve(&PlaneScene::new(x, y).unwrap(), &still);
        let slip = response.peaks.vector.slip[0].value;
        assert!(slip <= long * (100.0 * part * part + 1e-15), "{part:e}: {slip:e}");
        let peak = response.peaks.vector.drift[0].value;
        assert!((peak - long).abs() < long * (part.abs() + 1e-12), "{part:e}: {peak}");
        let slips = response.statistics.events.of(EventKind::Slip);
        assert!(part > 1e-12 || slips <= 12, "{part:e}: {slips} slips");
        assert!(part < 1e-8 || slips > 0, "{part:e}: it slides");
    }
}

/// The limit of the drift vector is the ellipse of both collapse drifts. Along a direction the run is that in one direction,
/// with the radius of the ellipse there.
#[test]
fn the_drift_vector_collapses() {
    let samples: Vec<f64> = (0..200).map(|i| 4.0 * (0.13 * f64::from(i)).sin()).collect();
    for (angle, limits) in [(0.6_f64, [0.05, 0.05]), (0.6, [0.04, 0.07]), (-2.0, [0.06, 0.03])] {
        let (c, s) = (angle.cos(), angle.sin());
        let radius = 1.0 / (c / limits[0]).hypot(s / limits[1]);
        let of = |factor: f64| -> Vec<f64> { samples.iter().map(|a| factor * a).collect() };
        let motion = PlaneMotion::new(Motion::new(of(c), 0.01, None).unwrap(), of(s)).unwrap();
        let [x, y] = oscillator(0.2, [0.0; 2], [0.0; 2], Some(limits));
        let plane = solve(&PlaneScene::new(x, y).unwrap(), &motion);
        let [one, _] = oscillator(0.2, [0.0; 2], [0.0; 2], Some([radius; 2]));
        let one = simulate_general(&one, &Motion::new(of(1.0), 0.01, None).unwrap(), &Options::default()).unwrap();
        let (GeneralStatus::Collapsed { number, time }, GeneralStatus::Collapsed { time: expected, .. }) =
            (plane.status, one.status)
        else {
            panic!("{:?} and {:?}: both collapse", plane.status, one.status)
        };
        assert!(number == 1 && (time - expected).abs() < 1e-12, "{time} for {expected}");
        assert!((plane.peaks.vector.drift[0].value - radius).abs() < ROUNDING);
    }
}

/// Stops stand across x and across y. A block without friction knows nothing of the other direction: the run in the plane
/// is the two in one direction.
#[test]
fn stops_of_both_directions_by_themselves() {
    let stops = [Stops { damping: 30.0, ..Stops::new(0.03, 2e4) }, Stops::new(0.05, 1e4)];
    let goods = |axis: usize| Goods { block: Block::new(0, 20.0, 0.0), stops: Some(stops[axis]) };
    let wave = |w: f64| -> Vec<f64> { (0..300).map(|i| 3.0 * (w * f64::from(i)).sin()).collect() };
    let waves = [wave(0.11), wave(0.17)];
    let motion = |axis: usize| Motion::new(waves[axis].clone(), 0.01, None).unwrap();
    let plane = solve(&on_ground(goods), &PlaneMotion::new(motion(0), waves[1].clone()).unwrap());
    let mut touched = 0;
    for axis in 0..2 {
        let scene = GeneralScene::new(None, vec![goods(axis)], Vec::new()).unwrap();
        let one = simulate_general(&scene, &motion(axis), &Options::default()).unwrap();
        let (found, expected) = (&plane.peaks.directions[axis], &one.peaks);
        assert!((found.slip[0].value - expected.slip[0].value).abs() < ROUNDING);
        let force = expected.contact_force[0].value;
        assert!((found.contact_force[0].value - force).abs() < 1e-12 * force);
        assert!((plane.residual_slip[0][axis] - one.residual_slip[0]).abs() < ROUNDING);
        touched += one.statistics.events.of(EventKind::TouchStop);
    }
    assert!(touched > 8);
    assert_eq!(plane.statistics.events.of(EventKind::TouchStop), touched);
}

/// A block rests at a damped stop that it has pressed in by less than a last digit, beside a fast one. Ground accelerates so
/// that it starts away from the stop: the stop lets go while the block counts as at rest, and lets go for good. It slides
/// straight, by c t^3/6 from where the ramp c t reaches its friction, then by v t + (a - mu g) t^2/2.
#[test]
fn a_block_leaves_a_stop_that_it_hardly_presses_once() {
    let (dt, samples) = (0.01, 60);
    for seed in 0..500 {
        let draw = &mut Draw(seed);
        let (mass, mu) = (draw.scale(10.0, 3000.0), draw.scale(0.05, 0.3));
        let stiffness = mass * draw.scale(1e3, 1e6);
        let damping = 2.0 * draw.scale(0.02, 2.0) * (stiffness * mass).sqrt();
        let stops = Stops { clearance: [f64::INFINITY, 0.0], stiffness, damping };
        let (towards, fast) = (draw.scale(1e-11, 1e-7), draw.scale(0.1, 10.0));
        let of = |axis: usize| {
            let resting = Block { velocity: Some([towards, 0.0][axis]), ..Block::new(0, mass, mu) };
            let other = Block { velocity: Some([0.0, fast][axis]), ..Block::new(0, 1.0, mu) };
            let stops = (axis == 0).then_some(stops);
            GeneralScene::new(None, vec![Goods { block: resting, stops }, other.into()], Vec::new()).unwrap()
        };
        // Nothing for one sample, then a ramp to a push beyond friction, away from the stop.
        let (push, angle) = (mu * G * draw.scale(1.2, 3.0), draw.scale(0.05, 1.5));
        let ground = |part: f64| (0..samples).map(|i| [0.0, part * push][usize::from(i > 1)]).collect::<Vec<f64>>();
        let motion = Motion::new(ground(angle.cos()), dt, None).unwrap();
        let motion = PlaneMotion::new(motion, ground(angle.sin())).unwrap();
        let response = solve(&PlaneScene::new(of(0), of(1)).unwrap(), &motion);
        let leaves = times(&response, EventKind::LeaveStop);
        assert_eq!(leaves.len(), 1, "seed {seed}: {leaves:?}");
        let (rate, ramp) = (push / dt, dt * (1.0 - mu * G / push));
        let then = (samples - 3) as f64 * dt;
        let slip = rate * ramp.powi(3) / 6.0 + 0.5 * rate * ramp * ramp * then + 0.5 * (push - mu * G) * then * then;
        let expected = [-slip * angle.cos(), -slip * angle.sin()];
        for (found, expected) in response.residual_slip[0].iter().zip(expected) {
            // What the stop holds is some 1e-8 of the friction at most.
            assert!((found - expected).abs() < 1e-7 * slip, "seed {seed}: {found} for {expected}");
        }
    }
}

/// A block starts almost along a stop that it hardly presses, and is driven into it from then on: it touches as soon as what
/// drives it has turned, wherever the steps of the series end. The push across the stop is c (e - s) in the second sample
/// interval, with s from 0 to 1; where along it friction is reached at s = 1/2, it starts there, and is driven back from s = e.
#[test]
fn a_block_that_is_turned_into_its_stop_touches_as_it_is_turned() {
    let (dt, samples) = (0.01, 60);
    for seed in 0..200 {
        let draw = &mut Draw(seed);
        let (mass, mu) = (draw.scale(10.0, 3000.0), draw.scale(0.05, 0.3));
        let stiffness = mass * draw.scale(1e3, 1e6);
        let damping = 2.0 * draw.scale(0.02, 2.0) * (stiffness * mass).sqrt();
        let stops = Stops { clearance: [f64::INFINITY, 0.0], stiffness, damping };
        let (towards, fast, late) = (draw.scale(1e-13, 1e-10), draw.scale(1.0, 10.0), draw.scale(1e-6, 1e-4));
        let of = |axis: usize| {
            let resting = Block { velocity: Some([towards, 0.0][axis]), mu_k: 0.5 * mu, ..Block::new(0, mass, mu) };
            let other = Block { velocity: Some([0.0, fast][axis]), ..Block::new(0, 1.0, mu) };
            let stops = (axis == 0).then_some(stops);
            GeneralScene::new(None, vec![Goods { block: resting, stops }, other.into()], Vec::new()).unwrap()
        };
        let ramp = |first: f64, then: f64| -> Vec<f64> {
            (0..samples).map(|i| [0.0, first, then][usize::min(i, 2)]).collect()
        };
        let (across, along) = (ramp(mu * G * (0.5 + late), mu * G * (late - 0.5)), ramp(0.0, 2.0 * mu * G));
        let motion = PlaneMotion::new(Motion::new(across, dt, None).unwrap(), along).unwrap();
        let response = solve(&PlaneScene::new(of(0), of(1)).unwrap(), &motion);
        let after = times(&response, EventKind::TouchStop).into_iter().find(|&time| time > dt).unwrap();
        // It was at rest at s = 1/2; driven away until s = 1/2 + e, it is back at s = 1/2 + 2 e at the latest.
        let (turned, back) = (dt * (1.5 + 0.9 * late), dt * (1.5 + 2.5 * late) + 1e-11);
        assert!(turned - 1e-11 < after && after < back, "seed {seed}: {after} for {turned} to {back}");
    }
}

/// Without friction the slip is s = v t - a t^2/2. Its length turns where s v = 0 with the velocity v - a t: at the roots of
/// |v|^2 - 3/2 (v a) t + |a|^2 t^2/2, of which the first is a peak, wherever samples lie. Between v and a are 10 degrees.
#[test]
fn the_length_of_a_slip_peaks_inside_a_step() {
    let (speed, push) = (0.83, 1.9);
    for heading in 0..24 {
        let heading = 0.3 + 0.25 * f64::from(heading);
        let of = |size: f64, angle: f64| [size * angle.cos(), size * angle.sin()];
        let (v, a) = (of(speed, heading), of(push, heading + 10_f64.to_radians()));
        let along = v[0] * a[0] + v[1] * a[1];
        let root = (2.25 * along * along - 2.0 * (speed * push).powi(2)).sqrt();
        let time = (1.5 * along - root) / (push * push);
        let slip = |axis: usize| v[axis] * time - 0.5 * a[axis] * time * time;
        let scene = on_ground(|axis| Block { velocity: Some(v[axis]), ..Block::new(0, 3.1, 0.0) }.into());
        // The second root is at 0.83 s.
        for samples in [2, 4, 11] {
            let peaks = solve(&scene, &constant(a, samples, 0.6 / (samples - 1) as f64)).peaks;
            let found = peaks.vector.slip[0];
            assert!((found.value - slip(0).hypot(slip(1))).abs() < ROUNDING, "{heading}: {found:?}");
            // A flat top is known to the root of rounding.
            assert!((found.time - time).abs() < 1e-7, "{heading}: {found:?} for {time}");
        }
    }
}
