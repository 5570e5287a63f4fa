//! The sliding base: closed forms, and what must hold for every scene (`numerics`, section 9.6).

#![allow(clippy::unwrap_used)]

#[allow(dead_code)] // What agrees with references is measured elsewhere.
mod general_compare;
mod general_random;
mod maximum;

use std::f64::consts::PI;
use std::sync::Arc;

use general_compare::{ENERGY, OPTIONS, compare_events, deviation, events, values};
use general_random::{Draw, random_general};
use maximum::larger;
use seismass::{
    Block, Damping, EventKind, GeneralBuilding, GeneralResponse, GeneralScene, GravityEffect, Motion, STANDARD_GRAVITY,
    Scene, SlidingBase, Storey, simulate, simulate_general,
};

const G: f64 = STANDARD_GRAVITY;

fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{what}: {found} for {expected}");
}

fn solve(scene: &GeneralScene, motion: &Motion) -> GeneralResponse {
    let response = simulate_general(scene, motion, &OPTIONS).unwrap();
    let residual = response.energy.unwrap().relative_residual;
    assert!(residual.abs() < 1e-12, "{residual:e}");
    response
}

/// Times of events of the base.
fn times(response: &GeneralResponse, kind: EventKind) -> Vec<f64> {
    let events = response.events.as_ref().unwrap().iter().map(|entry| entry.event);
    events.filter(|event| event.kind == kind && event.number == 0).map(|event| event.time).collect()
}

fn waves() -> Motion {
    let samples: Vec<f64> =
        (0..1500).map(|i| 4.0 * (0.05 * f64::from(i)).sin() * (0.002 * f64::from(i)).sin()).collect();
    let vertical: Vec<f64> = (0..1500).map(|i| 6.0 * (0.11 * f64::from(i)).sin()).collect();
    Motion::new(samples, 0.01, Some(vertical.into())).unwrap()
}

/// A pulse of 0.1 s, then rest.
fn pulse(acceleration: f64, duration: f64) -> Motion {
    let samples: Vec<f64> =
        (0..=(duration * 100.0) as usize).map(|i| if i < 10 { acceleration } else { 0.0 }).collect();
    Motion::new(samples, 0.01, None).unwrap()
}

fn storey(mass: f64, stiffness: f64, damping: f64) -> Option<Arc<GeneralBuilding>> {
    let storeys = vec![Storey::elastic(stiffness)];
    let damping = Damping::Modal { ratio: damping };
    Some(Arc::new(GeneralBuilding::new(vec![mass], storeys, None, &damping, GravityEffect::None).unwrap()))
}

/// Newmark's block: a slab alone, or with goods that never slide on it, is a block on the ground, vertical motion included.
#[test]
fn a_slab_is_a_block_on_the_ground() {
    let (mu_s, mu_k) = (0.15, 0.1);
    let block = Block { mu_s, mu_k, ..Block::new(0, 700.0, 0.0) };
    let of_chain = simulate(&Scene::new(None, vec![block]).unwrap(), &waves(), &OPTIONS).unwrap();
    for goods in [Vec::new(), vec![Block::new(0, 400.0, 50.0).into()]] {
        let base = SlidingBase { mass: 300.0, mu_s, mu_k, radius: f64::INFINITY };
        let response = solve(&GeneralScene::on_base(None, goods, Vec::new(), Some(base)).unwrap(), &waves());
        let base = response.base.as_ref().unwrap();
        close(base.slip.value, of_chain.peaks.slip[0].value, 1e-13, "slip");
        close(base.residual_slip, of_chain.residual_slip[0], 1e-12, "slip at the end");
        close(base.slip_path, of_chain.slip_path[0], 1e-13, "path");
        for (kind, count) in
            [EventKind::Slip, EventKind::Stick, EventKind::Lift].map(|k| (k, of_chain.statistics.events.of(k)))
        {
            assert_eq!(times(&response, kind).len(), count, "{kind}");
            assert!(count > 0 || kind == EventKind::Lift);
        }
    }
}

/// Without friction a pendulum turns after each half period pi sqrt(R/g), whatever it carries.
#[test]
fn the_period_of_a_pendulum_is_that_of_its_radius() {
    for mass in [10.0, 3000.0] {
        let radius = 2.2;
        let base = SlidingBase { radius, ..SlidingBase::new(mass, 0.0) };
        let scene = GeneralScene::on_base(None, Vec::new(), Vec::new(), Some(base)).unwrap();
        let turns = times(&solve(&scene, &pulse(5.0, 10.0)), EventKind::Reverse);
        assert!(turns.len() >= 6);
        for pair in turns.windows(2) {
            close(pair[1] - pair[0], PI * (radius / G).sqrt(), 1e-13, "half a period");
        }
    }
}

/// A pendulum with friction loses 2 mu R of its amplitude in each half period, and stops where mu_s R holds it.
#[test]
fn friction_takes_two_mu_r_from_each_half_period() {
    let (radius, mu) = (3.0, 0.01);
    let base = SlidingBase { radius, ..SlidingBase::new(500.0, mu) };
    let scene = GeneralScene::on_base(None, Vec::new(), Vec::new(), Some(base)).unwrap();
    let response = solve(&scene, &pulse(3.0, 30.0));
    let base = response.base.unwrap();
    let (mut amplitude, mut path, mut sign) = (base.slip.value, base.slip.value, -1.0);
    while amplitude > mu * radius {
        path += 2.0 * (amplitude - mu * radius);
        amplitude -= 2.0 * mu * radius;
        sign = -sign;
    }
    close(base.slip_path, path, 1e-12, "path");
    close(base.residual_slip, sign * amplitude, 1e-11, "slip at the end");
    close(response.energy.unwrap().friction, mu * 500.0 * G * path, 1e-12, "energy");
}

/// A storey pulls at its slab: it sticks until k d = mu (m + m_0) g, slides while d'' + k (1/m + 1/m_0) d = mu (m + m_0) g / m_0,
/// and stops where its velocity, by the momentum of both, is zero.
#[test]
fn a_storey_draws_its_slab_along() {
    let (m, slab, k, mu, v) = (800.0, 500.0, 3e5, 0.1, 0.15);
    let scene = GeneralScene::on_base(storey(m, k, 0.0), Vec::new(), Vec::new(), Some(SlidingBase::new(slab, mu)));
    let scene = scene.unwrap().with_initial(vec![0.0], vec![v]).unwrap();
    let response = solve(&scene, &Motion::new(vec![0.0; 41], 0.005, None).unwrap());
    let (w, limit) = ((k / m).sqrt(), mu * (m + slab) * G / k);
    let start = (limit * w / v).asin() / w;
    // What is left of the vibration does not move the slab again.
    assert_eq!(times(&response, EventKind::Slip).len(), 1);
    close(times(&response, EventKind::Slip)[0], start, 1e-13, "slip");
    // Drift about the place that friction shifts it to.
    let (rate, shift) = (v * (w * start).cos(), limit * m / (m + slab));
    let fast = (k / m + k / slab).sqrt();
    let (c, s) = (limit - shift, rate / fast);
    let drift_rate = |t: f64| fast * (s * (fast * t).cos() - c * (fast * t).sin());
    let slab_velocity = |t: f64| (m * rate - mu * (m + slab) * G * t - m * drift_rate(t)) / (m + slab);
    let (mut low, mut high) = (0.02, 0.5 * PI / fast);
    while slab_velocity(high) > 0.0 {
        (low, high) = (high, high + 0.002);
    }
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if slab_velocity(middle) > 0.0 { low = middle } else { high = middle }
    }
    close(times(&response, EventKind::Stick)[0], start + low, 1e-12, "stick");
    let drift = |t: f64| shift + c * (fast * t).cos() + s * (fast * t).sin();
    let slip = (m * rate * low - 0.5 * mu * (m + slab) * G * low * low - m * (drift(low) - limit)) / (m + slab);
    close(response.base.unwrap().slip.value, slip, 1e-11, "slip");
}

/// Goods and slab decide at one instant: goods of mu below that of the base keep the slab from sliding, since what they can
/// press it with is theirs alone.
#[test]
fn goods_that_slide_on_the_slab_unload_it() {
    let block = |mu| vec![Block::new(0, 900.0, mu).into()];
    let solve_with = |mu| {
        let base = SlidingBase::new(100.0, 0.2);
        solve(&GeneralScene::on_base(None, block(mu), Vec::new(), Some(base)).unwrap(), &pulse(3.0, 3.0))
    };
    // Held at a_g = 3 the slab needs 100 * 3 + 0.1 * 900 g = 1183 N, below 0.2 * 1000 g.
    let slippery = solve_with(0.1);
    assert_eq!(slippery.base.unwrap().slip.value, 0.0);
    assert!(slippery.peaks.slip[0].value > 0.0);
    // With goods that stick it needs 3000 N.
    let rough = solve_with(0.5);
    assert!(rough.base.unwrap().slip.value > 0.0);
    assert_eq!(rough.peaks.slip[0].value, 0.0);
}

/// The slab takes part in neither the periods nor the damping of the structure: stuck for good it is the ground.
#[test]
fn a_base_that_never_slides_is_the_ground() {
    for seed in 0..30 {
        let (scene, motion) = random_general(seed);
        let (building, goods, racks) = (scene.building().cloned(), scene.goods().to_vec(), scene.racks().to_vec());
        let base = SlidingBase::new(100.0, 1e6);
        let on_base = GeneralScene::on_base(building.clone(), goods.clone(), racks.clone(), Some(base)).unwrap();
        // In flight a slab moves.
        if motion.vertical().is_some_and(|a| a.iter().any(|&a| a <= -G)) {
            continue;
        }
        let [one, other] = [on_base, GeneralScene::new(building, goods, racks).unwrap()]
            .map(|scene| simulate_general(&scene, &motion, &OPTIONS).unwrap());
        assert_eq!(one.peaks, other.peaks, "seed {seed}");
        assert_eq!(one.events, other.events, "seed {seed}");
    }
}

/// A slab without friction, and goods without friction on it and on a light storey, far below goods that are thrown: what
/// moves them at t = 0 begins with a high power of time, and every force is zero at first. They break away once and never
/// stick again, and those on the slab stay where they are in space, whatever the mass of each.
#[test]
fn nothing_without_friction_sticks_again() {
    let motion = Motion::new(&waves().acceleration()[..300], 0.01, None).unwrap();
    let (mut ground, mut velocity, mut largest) = (0.0, 0.0, 0.0);
    for pair in motion.acceleration().windows(2) {
        ground += motion.dt() * velocity + motion.dt().powi(2) * (2.0 * pair[0] + pair[1]) / 6.0;
        velocity += 0.5 * motion.dt() * (pair[0] + pair[1]);
        largest = larger(largest, f64::abs(ground));
    }
    let mut turns = 0;
    for seed in 0..200u64 {
        let draw = &mut Draw(seed);
        let storeys = 1 + (seed % 4) as usize;
        let springs = (0..storeys).map(|_| Storey::elastic(draw.scale(1e4, 1e7))).collect();
        let damping = Damping::Modal { ratio: 0.02 * (seed % 3) as f64 };
        let masses = vec![draw.scale(10.0, 1000.0); storeys];
        let building = GeneralBuilding::new(masses, springs, None, &damping, GravityEffect::None).unwrap();
        let thrown = Block { velocity: Some(-0.1), ..Block::new(storeys, draw.scale(10.0, 1000.0), 0.05) };
        let mut goods = vec![Block::new(0, draw.scale(10.0, 1e4), 0.0).into(), thrown.into()];
        goods.extend((0..seed % 3).map(|i| Block::new(1 + i as usize % storeys, draw.scale(1.0, 1e4), 0.0).into()));
        let mu_s = if seed % 5 == 0 { 0.02 } else { 0.0 };
        let base = SlidingBase { mass: draw.scale(30.0, 3000.0), mu_s, mu_k: mu_s, radius: f64::INFINITY };
        let scene = GeneralScene::on_base(Some(Arc::new(building)), goods, Vec::new(), Some(base)).unwrap();
        let response = solve(&scene, &motion);
        let of_number = |number: usize, kind: EventKind| {
            let events = response.events.as_ref().unwrap().iter().map(|entry| entry.event);
            events.filter(|event| event.number == number && event.kind == kind).count()
        };
        for (j, goods) in scene.goods().iter().enumerate().filter(|(_, goods)| goods.block.mu_s == 0.0) {
            assert_eq!(of_number(j + 1, EventKind::Slip), 1, "seed {seed}, block {j} on {}", goods.block.floor);
            assert_eq!(of_number(j + 1, EventKind::Stick), 0, "seed {seed}, block {j}");
            turns += of_number(j + 1, EventKind::Reverse);
        }
        if mu_s == 0.0 {
            assert_eq!((of_number(0, EventKind::Slip), of_number(0, EventKind::Stick)), (1, 0), "seed {seed}");
        }
        let in_space = ground + response.base.as_ref().unwrap().residual_slip + response.residual_slip[0];
        assert!(in_space.abs() < 1e-12 * largest, "seed {seed}: {in_space:e}");
    }
    assert!(turns > 500, "{turns}");
}

/// A random scene on a base: flat or a pendulum, weak or strong.
fn random_on_base(seed: u64) -> (GeneralScene, Motion) {
    let (scene, motion) = random_general(seed);
    let share =
        |salt: u64| (seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(salt << 40) >> 40) as f64 / 16_777_216.0;
    let of_floors: f64 = scene.building().map_or(1000.0, |building| building.mass()[0]);
    let mu_k = 0.02 + 0.2 * share(77);
    let base = SlidingBase {
        mass: of_floors * (0.05 + share(1_234)),
        mu_s: if share(5_555) < 0.5 { mu_k } else { 1.3 * mu_k },
        mu_k,
        radius: if share(99_999) < 0.5 { f64::INFINITY } else { 0.5 + 3.0 * share(31_337) },
    };
    let (building, goods, racks) = (scene.building().cloned(), scene.goods().to_vec(), scene.racks().to_vec());
    (GeneralScene::on_base(building, goods, racks, Some(base)).unwrap(), motion)
}

fn apart(one: &GeneralResponse, other: &GeneralResponse) -> f64 {
    let [a, b] = [one, other].map(|response| response.base.clone().unwrap());
    [
        deviation(&values(&one.peaks.drift), &values(&other.peaks.drift)),
        deviation(&values(&one.peaks.acceleration), &values(&other.peaks.acceleration)),
        deviation(&values(&one.peaks.slip), &values(&other.peaks.slip)),
        deviation(&[a.slip.value, a.slip_path], &[b.slip.value, b.slip_path]),
    ]
    .into_iter()
    .fold(0.0, larger)
}

fn changed(motion: &Motion, parts: usize, factor: f64) -> Motion {
    let change = |samples: &[f64], factor: f64| -> Vec<f64> {
        let between = |pair: &[f64], part: usize| pair[0] + (pair[1] - pair[0]) * (part as f64 / parts as f64);
        let inner = samples.windows(2).flat_map(|pair| (0..parts).map(move |part| between(pair, part)));
        inner.chain(samples.last().copied()).map(|a| factor * a).collect()
    };
    let vertical = motion.vertical().map(|samples| change(samples, 1.0).into());
    Motion::new(change(motion.acceleration(), factor), motion.dt() / parts as f64, vertical).unwrap()
}

/// Energies balance, divided steps give the same events, and the opposite motion the opposite response.
#[test]
fn what_holds_for_every_scene_holds_on_a_base() {
    let (mut worst, mut balance, mut slips, mut jumps) = (0.0, 0.0, 0, 0);
    for seed in 0..200 {
        let (scene, motion) = random_on_base(seed);
        let one = simulate_general(&scene, &motion, &OPTIONS).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let residual = one.energy.unwrap().relative_residual.abs();
        assert!(residual < ENERGY, "seed {seed}: {residual:e}");
        balance = larger(balance, residual);
        slips += times(&one, EventKind::Slip).len();
        jumps += times(&one, EventKind::Reverse).len() + times(&one, EventKind::Touch).len();
        let parts = simulate_general(&scene, &changed(&motion, 4, 1.0), &OPTIONS).unwrap();
        let found = compare_events(events(&parts), events(&one));
        assert!(found.is_ok(), "seed {seed}: {found:?}");
        let difference = apart(&parts, &one);
        assert!(difference <= 1e-9, "seed {seed}: {difference:e}");
        worst = larger(worst, difference);
        if scene.all_goods().all(|goods| goods.stops.is_none_or(|stops| stops.clearance[0] == stops.clearance[1])) {
            let other = simulate_general(&scene, &changed(&motion, 1, -1.0), &OPTIONS).unwrap();
            assert_eq!(one.statistics.events, other.statistics.events, "seed {seed}");
            assert!(apart(&one, &other) <= 1e-9, "seed {seed}");
        }
    }
    println!("balance {balance:.1e}, division {worst:.1e}, {slips} slips and {jumps} reversals of the base");
    assert!(slips > 500);
}
