//! What must hold for every scene in two horizontal directions, and closed forms (`numerics`, sections 8 and 9.7).

#![allow(clippy::unwrap_used)]

#[allow(dead_code)] // Its scenes are of one direction.
mod general_random;
mod maximum;

use std::num::NonZeroUsize;
use std::sync::Arc;

use general_random::Draw;
use maximum::larger;
use seismass::{
    Block, Damping, EventKind, GeneralBuilding, GeneralScene, Goods, GravityEffect, Motion, Options, Peak, PlaneMotion,
    PlaneResponse, PlaneScene, Rack, STANDARD_GRAVITY, Stops, Storey, UniformBuilding, Wear, simulate_general,
    simulate_plane,
};

/// Rounding of peaks, as a part of the largest of their kind.
const ROUNDING: f64 = 1e-12;

/// Energies balance to this fraction of the input.
const ENERGY: f64 = 1e-11;

fn options() -> Options {
    Options { histories: NonZeroUsize::new(1), energy: true, events: true, ..Options::default() }
}

/// Three storeys with goods of one and of two friction coefficients; with a strength (N), a rack, and stops or without.
fn scene(yield_shear: f64, period: f64, stops: Option<Stops>, velocity: Option<f64>) -> GeneralScene {
    let uniform = UniformBuilding { storeys: 3, period, mass: 1000.0, ..Default::default() }.build().unwrap();
    let storeys: Vec<Storey> = uniform.storeys().iter().map(|s| Storey { yield_shear, ..s.clone() }).collect();
    let damping = seismass::Damping::Modal { ratio: 0.05 };
    let gravity = seismass::GravityEffect::None;
    let building = GeneralBuilding::new(uniform.mass().to_vec(), storeys, None, &damping, gravity).unwrap();
    let goods = vec![
        Goods { block: Block { mu_k: 0.2, velocity, ..Block::new(1, 600.0, 0.25) }, stops },
        Block::new(2, 400.0, 0.2).into(),
        Block { mu_k: 0.1, ..Block::new(2, 900.0, 0.2) }.into(),
        Block::new(0, 50.0, 0.15).into(),
        Block::new(3, 30.0, 0.0).into(),
    ];
    let rack = Rack {
        floor: 2,
        mass: vec![60.0, 60.0],
        levels: vec![Storey::elastic(4e4); 2],
        damping_ratio: 0.03,
        geometric_stiffness: Vec::new(),
        goods: vec![Block::new(2, 90.0, 0.3).into()],
    };
    GeneralScene::new(Some(Arc::new(building)), goods, vec![rack]).unwrap()
}

/// The same with P-Delta, wear, stops of this clearance, and goods that come to rest against them.
fn with_all(yield_shear: f64, period: f64, clearance: f64) -> GeneralScene {
    let of = scene(yield_shear, period, Some(Stops { damping: 200.0, ..Stops::new(clearance, 1e5) }), None);
    let mut goods = of.goods().to_vec();
    goods[1].block.wear = vec![Wear { path: 0.03, mu_s: 0.15, mu_k: 0.12 }, Wear { path: 0.2, mu_s: 0.18, mu_k: 0.18 }];
    goods[2].stops = Some(Stops::new(0.5 * clearance, 4e4));
    let bare = of.building().unwrap();
    let gravity = GravityEffect::GeometricStiffness(vec![4e3, 3e3, 2e3]);
    let damping = Damping::Modal { ratio: 0.05 };
    let building =
        GeneralBuilding::new(bare.mass().to_vec(), bare.storeys().to_vec(), None, &damping, gravity).unwrap();
    GeneralScene::new(Some(Arc::new(building)), goods, of.racks().to_vec()).unwrap()
}

/// Vertical motion that takes the goods off their floors twice.
fn vertical() -> Vec<f64> {
    let bumps = |t: f64| (-(40.0 * (t - 1.5)).powi(2)).exp() + (-(30.0 * (t - 3.1)).powi(2)).exp();
    (0..300).map(|i| 0.02 * f64::from(i)).map(|t| 2.0 * (7.0 * t).sin() - 13.0 * bumps(t)).collect()
}

fn divided(samples: &[f64]) -> Vec<f64> {
    let pairs = samples.windows(2);
    let parts = pairs.flat_map(|pair| (0..3).map(|part| pair[0] + (pair[1] - pair[0]) * f64::from(part) / 3.0));
    parts.chain(samples.last().copied()).collect()
}

fn samples(phase: f64) -> Vec<f64> {
    let sample = |i: u32| {
        let t = 0.02 * f64::from(i);
        3.0 * (4.1 * t + phase).sin() + 2.0 * (9.7 * t + 2.0 * phase).sin() + 1.5 * (2.3 * t).cos()
    };
    (0..300).map(sample).collect()
}

fn turned(x: &[f64], y: &[f64], angle: f64) -> PlaneMotion {
    let (c, s) = (angle.cos(), angle.sin());
    let of = |p: f64, q: f64| -> Vec<f64> { x.iter().zip(y).map(|(x, y)| p * x + q * y).collect() };
    PlaneMotion::new(Motion::new(of(c, -s), 0.02, None).unwrap(), of(s, c)).unwrap()
}

fn solve(scene: &PlaneScene, motion: &PlaneMotion) -> PlaneResponse {
    let response = simulate_plane(scene, motion, &options()).unwrap();
    let energy = response.energy.unwrap();
    for energy in energy.directions.iter().chain([&energy.total]) {
        assert!(energy.relative_residual.abs() < ENERGY, "{energy:?}");
    }
    response
}

fn apart(one: &[Peak], other: &[Peak]) -> f64 {
    let scale = one.iter().fold(0.0, |scale, peak| larger(scale, peak.value));
    one.iter().zip(other).fold(0.0, |worst, (a, b)| larger(worst, (a.value - b.value).abs() / scale))
}

fn vectors_apart(one: &PlaneResponse, other: &PlaneResponse) -> f64 {
    let (one, other) = (&one.peaks.vector, &other.peaks.vector);
    [
        apart(&one.drift, &other.drift),
        apart(&one.acceleration, &other.acceleration),
        apart(&one.shear, &other.shear),
        apart(&one.slip, &other.slip),
    ]
    .into_iter()
    .fold(0.0, larger)
}

/// Motion along a diagonal in a building equal in both directions is the run in one direction; where it yields, springs act
/// in x and y each by themselves, and the one direction has strengths sqrt 2 times larger.
#[test]
fn along_a_diagonal_it_is_the_run_in_one_direction() {
    let x = samples(0.0);
    let none = vec![0.0; x.len()];
    for (strength, angle) in [(f64::INFINITY, 0.7), (f64::INFINITY, -2.9), (3000.0, std::f64::consts::FRAC_PI_4)] {
        let of = |strength: f64| scene(strength, 0.6, None, None);
        let one =
            simulate_general(&of(strength * 2.0_f64.sqrt()), &Motion::new(x.clone(), 0.02, None).unwrap(), &options())
                .unwrap();
        let plane = solve(&PlaneScene::new(of(strength), of(strength)).unwrap(), &turned(&x, &none, angle));
        let (found, expected) = (&plane.peaks.vector, &one.peaks);
        for (kind, found, expected) in [
            ("drift", &found.drift, &expected.drift),
            ("acceleration", &found.acceleration, &expected.acceleration),
            ("slip", &found.slip, &expected.slip),
        ] {
            assert!(apart(expected, found) < ROUNDING, "{kind}: {found:?} for {expected:?}");
        }
        let slips = |kind: EventKind| (plane.statistics.events.of(kind), one.statistics.events.of(kind));
        let (stick, expected) = slips(EventKind::Stick);
        assert!(stick > 5 && stick == expected, "{stick} sticks for {expected}");
        for (path, expected) in plane.slip_path.iter().zip(&one.slip_path) {
            assert!((path - expected).abs() < ROUNDING * expected, "path {path} for {expected}");
        }
    }
}

/// Goods that are thrown against damped stops without clearance at t = 0 let the force on their floor jump as others begin to
/// slide there: these stick again, or start the other way, as in one direction. Nothing moves across.
#[test]
fn what_starts_where_a_force_jumps_starts_as_in_one_direction() {
    let (mut slips, mut touches) = (0, 0);
    for seed in 0..300u64 {
        let draw = &mut Draw(seed);
        let (mass, stiffness) = (draw.scale(100.0, 3000.0), draw.scale(1e4, 1e6));
        let damping = Damping::Modal { ratio: 0.05 };
        let storeys = vec![Storey::elastic(stiffness)];
        let building = GeneralBuilding::new(vec![mass], storeys, None, &damping, GravityEffect::None).unwrap();
        let building = Arc::new(building);
        let others = (0..1 + seed % 3).map(|_| {
            let mu_s = draw.scale(0.02, 0.5);
            let mu_k = mu_s * if seed % 2 == 0 { 1.0 } else { draw.scale(0.3, 1.0) };
            Goods::from(Block { mu_k, ..Block::new(1, mass * draw.scale(0.1, 10.0), mu_s) })
        });
        let others: Vec<Goods> = others.collect();
        // The spring exceeds what all of them stick to, and the damper pushes back by about as much.
        let held: f64 = others.iter().map(|goods| goods.block.mass * goods.block.mu_s * STANDARD_GRAVITY).sum();
        let (pull, velocity) =
            (held * draw.scale(1.0, 5.0), draw.scale(0.1, 1.0) * if seed % 4 < 2 { 1.0 } else { -1.0 });
        let drift = velocity.signum() * pull / stiffness;
        let stops =
            Stops { damping: pull * draw.scale(0.5, 1.5) / velocity.abs(), ..Stops::new(0.0, draw.scale(1e5, 1e6)) };
        let block = Block::new(1, draw.scale(100.0, 3000.0), draw.scale(0.02, 0.3));
        let thrown = |moves: bool| Goods {
            block: Block { velocity: moves.then_some(velocity), ..block.clone() },
            stops: moves.then_some(stops),
        };
        let goods = |moves: bool| std::iter::once(thrown(moves)).chain(others.iter().cloned()).collect::<Vec<_>>();
        let still = GeneralScene::new(Some(building.clone()), goods(false), Vec::new()).unwrap();
        let moving = GeneralScene::new(Some(building), goods(true), Vec::new()).unwrap();
        let moving = moving.with_initial(vec![drift], vec![0.0]).unwrap();
        let shaken = Motion::new(samples(0.3)[..60].to_vec(), 0.01, None).unwrap();
        let one = simulate_general(&moving, &shaken, &options()).unwrap();
        let quiet = Motion::new(vec![0.0; 60], 0.01, None).unwrap();
        let motion = PlaneMotion::new(quiet, shaken.acceleration().to_vec()).unwrap();
        let both = solve(&PlaneScene::new(still, moving).unwrap(), &motion);
        let largest = one.peaks.drift[0].value.abs();
        let found = both.residual_drift[0][1] - one.residual_drift[0];
        assert!(found.abs() <= 1e-9 * largest, "seed {seed}: {found:e} of {largest:e}");
        let slip = one.residual_slip.iter().zip(&both.residual_slip).map(|(one, both)| (both[1] - one).abs());
        assert!(
            slip.fold(0.0, larger)
                <= 1e-9 * one.peaks.slip.iter().fold(largest, |most, peak| larger(most, peak.value.abs()))
        );
        let at_once = |kind| {
            one.events.iter().flatten().filter(|entry| entry.event.kind == kind && entry.event.time == 0.0).count()
        };
        slips += at_once(EventKind::Slip);
        touches += at_once(EventKind::TouchStop);
    }
    assert!(slips > 200 && touches > 200, "{slips} {touches}");
}

/// An elastic building equal in both directions does not know them.
#[test]
fn the_motion_may_be_turned_by_any_angle() {
    let elastic = || scene(f64::INFINITY, 0.6, None, None);
    let scene = PlaneScene::new(elastic(), elastic()).unwrap();
    let (x, y) = (samples(0.0), samples(1.3));
    let one = solve(&scene, &turned(&x, &y, 0.0));
    for angle in [0.4, 1.9, -2.2] {
        let other = solve(&scene, &turned(&x, &y, angle));
        assert_eq!(one.statistics.events, other.statistics.events);
        assert!(vectors_apart(&one, &other) < ROUNDING);
    }
}

/// A quarter turn of scene and motion, and mirror images.
#[test]
fn quarter_turns_and_mirror_images() {
    let stops = Stops { damping: 200.0, ..Stops::new(0.02, 1e5) };
    let (of_x, of_y) = (scene(3000.0, 0.6, Some(stops), None), scene(2500.0, 0.8, None, None));
    let (x, y) = (samples(0.0), samples(1.3));
    let one = solve(&PlaneScene::new(of_x.clone(), of_y.clone()).unwrap(), &turned(&x, &y, 0.0));
    assert!(one.statistics.events.of(EventKind::TouchStop) > 0);
    let opposite: Vec<f64> = x.iter().map(|a| -a).collect();
    let mirrored = solve(&PlaneScene::new(of_x.clone(), of_y.clone()).unwrap(), &turned(&opposite, &y, 0.0));
    let swapped = solve(&PlaneScene::new(of_y, of_x).unwrap(), &turned(&y, &x, 0.0));
    for other in [mirrored, swapped] {
        assert_eq!(one.statistics.events, other.statistics.events);
        assert!(vectors_apart(&one, &other) < ROUNDING);
    }
}

/// To divide every sample interval by three changes the result by rounding: a wrong direction at a release would show.
#[test]
fn divided_steps_give_the_same() {
    let (of_x, of_y) = (scene(3000.0, 0.6, Some(Stops::new(0.02, 1e5)), None), scene(2500.0, 0.8, None, None));
    let scene = PlaneScene::new(of_x, of_y).unwrap();
    let (x, y) = (samples(0.0), samples(1.3));
    let one = solve(&scene, &turned(&x, &y, 0.0));
    let motion = Motion::new(divided(&x), 0.02 / 3.0, None).unwrap();
    let other = solve(&scene, &PlaneMotion::new(motion, divided(&y)).unwrap());
    assert_eq!(one.statistics.events, other.statistics.events);
    assert!(vectors_apart(&one, &other) < ROUNDING);
}

/// All at once: P-Delta, wear by path, stops in x and y, lift-off and landing. Division of steps, a quarter turn and a mirror
/// image change rounding alone.
#[test]
fn all_at_once_is_divided_turned_and_mirrored() {
    let (of_x, of_y) = (with_all(3000.0, 0.6, 0.02), with_all(2500.0, 0.8, 0.03));
    let plane = |x: &GeneralScene, y: &GeneralScene| PlaneScene::new(x.clone(), y.clone()).unwrap();
    let (x, y, up) = (samples(0.0), samples(1.3), vertical());
    let motion = |x: &[f64], y: &[f64], up: &[f64], dt: f64| {
        PlaneMotion::new(Motion::new(x.to_vec(), dt, Some(up.to_vec().into())).unwrap(), y.to_vec()).unwrap()
    };
    let one = solve(&plane(&of_x, &of_y), &motion(&x, &y, &up, 0.02));
    for (kind, least) in [
        (EventKind::Lift, 10),
        (EventKind::Land, 10),
        (EventKind::Wear, 2),
        (EventKind::TouchStop, 10),
        (EventKind::Slip, 15),
    ] {
        let count = one.statistics.events.of(kind);
        assert!(count >= least, "{count} {kind:?}");
    }
    let opposite: Vec<f64> = y.iter().map(|a| -a).collect();
    let parts = motion(&divided(&x), &divided(&y), &divided(&up), 0.02 / 3.0);
    for (name, other) in [
        ("divided", solve(&plane(&of_x, &of_y), &parts)),
        ("turned", solve(&plane(&of_y, &of_x), &motion(&y, &x, &up, 0.02))),
        ("mirrored", solve(&plane(&of_x, &of_y), &motion(&x, &opposite, &up, 0.02))),
    ] {
        assert_eq!(one.statistics.events, other.statistics.events, "{name}");
        let apart = vectors_apart(&one, &other);
        assert!(apart < ROUNDING, "{name}: {apart:e}");
    }
}

fn on_ground(mu: f64, velocity: [f64; 2]) -> PlaneScene {
    let of = |velocity: f64| {
        let block = Block { velocity: Some(velocity), ..Block::new(0, 3.0, mu) };
        GeneralScene::new(None, vec![block.into()], Vec::new()).unwrap()
    };
    PlaneScene::new(of(velocity[0]), of(velocity[1])).unwrap()
}

/// A block thrown across ground that accelerates at a right angle: rho sin(phi) = v tan(phi/2)^(beta/a), with phi the angle
/// between the relative velocity and what drives it.
#[test]
fn a_block_thrown_across_accelerated_ground_follows_the_pursuit_curve() {
    let (a, mu, v) = (1.2, 0.2, 0.9);
    let motion = PlaneMotion::new(Motion::new(vec![a; 60], 0.01, None).unwrap(), vec![0.0; 60]).unwrap();
    let response = solve(&on_ground(mu, [0.0, v]), &motion);
    let [x, y] = response.histories.unwrap();
    let mut compared = 0;
    for (x, y) in x.block_velocity.iter().zip(&y.block_velocity) {
        let phi = y.atan2(-x);
        let expected = v * (0.5 * phi).tan().powf(mu * STANDARD_GRAVITY / a);
        if x.hypot(*y) > 1e-3 {
            assert!((x.hypot(*y) * phi.sin() - expected).abs() < 1e-13 * v, "{phi}: {expected}");
            compared += 1;
        }
    }
    assert!(compared > 30);
}

/// A block on ground that accelerates by (a_x, a_y) from rest slides back along it by (|a| - mu g) t^2/2.
#[test]
fn a_block_on_accelerated_ground_slides_straight() {
    let (a, mu, t) = ([1.5, -2.0], 0.1, 0.5);
    let motion = PlaneMotion::new(Motion::new(vec![a[0]; 51], 0.01, None).unwrap(), vec![a[1]; 51]).unwrap();
    let response = solve(&on_ground(mu, [0.0, 0.0]), &motion);
    let slip = 0.5 * (2.5 - mu * STANDARD_GRAVITY) * t * t;
    let expected = [-0.6 * slip, 0.8 * slip];
    for (found, expected) in response.residual_slip[0].iter().zip(expected) {
        assert!((found - expected).abs() < 1e-14, "{found} for {expected}");
    }
    assert!((response.slip_path[0] - slip).abs() < 1e-14);
}

/// Light levels under heavy goods, whose directions are stiff, with equal and with different coefficients: division of steps
/// changes rounding alone, and a slip takes some hundred steps: 231 at 20 times the level's mass, 955 at 200 times.
#[test]
fn stiff_directions_are_divided() {
    let (x, y) = (samples(0.0), samples(1.3));
    for (mass, mu_k, steps) in [(20.0, 0.2, 300), (20.0, 0.18, 300), (2.0, 0.2, 1200)] {
        let goods = (1..=3).map(|level| Block { mu_k, ..Block::new(level, 400.0, 0.2) }.into()).collect();
        let bare = scene(3000.0, 0.4, None, None);
        let rack = Rack {
            floor: 1,
            mass: vec![mass; 3],
            levels: vec![Storey::elastic(3e5); 3],
            goods,
            ..bare.racks()[0].clone()
        };
        let of = GeneralScene::new(bare.building().cloned(), Vec::new(), vec![rack]).unwrap();
        let scene = PlaneScene::new(of.clone(), of).unwrap();
        let one = solve(&scene, &turned(&x, &y, 0.0));
        let motion = Motion::new(divided(&x), 0.02 / 3.0, None).unwrap();
        let other = solve(&scene, &PlaneMotion::new(motion, divided(&y)).unwrap());
        assert_eq!(one.statistics.events, other.statistics.events);
        let apart = vectors_apart(&one, &other);
        assert!(apart < ROUNDING, "{mass} kg: {apart:e}");
        let slips = one.statistics.events.of(EventKind::Slip) as u64;
        assert!(slips > 10 && (one.statistics.series_steps as u64) < steps * slips, "{mass} kg: {:?}", one.statistics);
    }
}
