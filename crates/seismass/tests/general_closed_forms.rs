//! Closed forms of racks, walls and stops (`numerics`, section 9).

#![allow(clippy::unwrap_used)]

#[allow(dead_code)] // Only numbers are drawn.
mod general_random;

use std::f64::consts::PI;
use std::sync::Arc;

use general_random::Draw;
use nalgebra::DMatrix;
use seismass::{
    Block, Damping, EventKind, GeneralBuilding, GeneralResponse, GeneralScene, Goods, GravityEffect, Motion, Options,
    Rack, STANDARD_GRAVITY, Stops, Storey, UniformBuilding, simulate_general,
};

fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{what}: {found} for {expected}");
}

fn solve(scene: &GeneralScene, motion: &Motion) -> GeneralResponse {
    let options = Options { energy: true, events: true, ..Options::default() };
    let response = simulate_general(scene, motion, &options).unwrap();
    assert!(response.energy.unwrap().relative_residual.abs() < 1e-12);
    response
}

fn times(response: &GeneralResponse, kind: EventKind) -> Vec<f64> {
    let events = response.events.as_ref().unwrap().iter();
    events.filter(|entry| entry.event.kind == kind).map(|entry| entry.event.time).collect()
}

fn still(duration: f64) -> Motion {
    Motion::new(vec![0.0; (duration / 0.01) as usize + 1], 0.01, None).unwrap()
}

fn waves() -> Motion {
    Motion::new((0..500).map(|i| 3.0 * (0.09 * f64::from(i)).sin()).collect::<Vec<f64>>(), 0.01, None).unwrap()
}

/// A block without friction, thrown at a stop on the ground.
fn thrown(velocity: f64, mass: f64, stops: Stops) -> GeneralScene {
    let block = Block { velocity: Some(velocity), ..Block::new(0, mass, 0.0) };
    GeneralScene::new(None, vec![Goods { block, stops: Some(stops) }], Vec::new()).unwrap()
}

/// Half a period in contact, the largest force v sqrt(k m), and back as fast as it came; then the other stop.
#[test]
fn an_elastic_stop_turns_a_block_round() {
    let (v, m, k) = (0.4_f64, 3.0_f64, 1200.0_f64);
    let stops = Stops { clearance: [0.3, 0.1], ..Stops::new(0.0, k) };
    let response = solve(&thrown(v, m, stops), &still(3.0));
    let (touch, leave) = (times(&response, EventKind::TouchStop), times(&response, EventKind::LeaveStop));
    let half = PI * (m / k).sqrt();
    close(touch[0], 0.25, 1e-14, "first touch");
    close(leave[0], 0.25 + half, 1e-13, "first leave");
    close(touch[1], 0.25 + half + 1.0, 1e-13, "touch of the other stop");
    close(response.peaks.contact_force[0].value, v * (k * m).sqrt(), 1e-13, "largest force");
    close(response.peaks.contact_velocity[0].value, v, 1e-13, "velocity at contact");
    close(response.peaks.slip[0].value, 0.3 + v * (m / k).sqrt(), 1e-13, "largest slip");
}

/// Kelvin and Voigt's contact that does not pull: it parts where e'' = 0, and the block goes on at the velocity it has.
#[test]
fn a_damped_stop_parts_before_it_would_pull() {
    let (v, m, k, c) = (0.4_f64, 3.0_f64, 1200.0_f64, 30.0_f64);
    let (w2, a) = (k / m, 0.5 * c / m);
    let wd = (w2 - a * a).sqrt();
    // e = v/wd exp(-a t) sin(wd t); e'' = 0 at tan(wd t) = 2 a wd / (a^2 - wd^2).
    let t = (PI - (2.0 * a * wd / (wd * wd - a * a)).atan()) / wd;
    let e = v / wd * (-a * t).exp() * (wd * t).sin();
    let back = v * (-a * t).exp() * ((wd * t).cos() - a / wd * (wd * t).sin());
    let stops = Stops { clearance: [f64::INFINITY, 0.1], stiffness: k, damping: c };
    let response = solve(&thrown(v, m, stops), &still(2.0));
    let (touch, leave) = (times(&response, EventKind::TouchStop), times(&response, EventKind::LeaveStop));
    assert_eq!((touch.len(), leave.len()), (1, 1));
    close(leave[0], 0.25 + t, 1e-13, "leave");
    close(response.residual_slip[0], 0.1 + e + back * (2.0 - 0.25 - t), 1e-12, "slip at the end");
    close(response.energy.unwrap().contact, 0.5 * m * (v * v - back * back), 1e-12, "energy of the contact");
    // The force jumps to c v at the touch; its largest value is later, where c e'' + k e' = 0: with e'' = -2 a e' - w^2 e
    // there is e'/e = c w^2 / (k - 2 a c), which is wd / tan(wd t) - a.
    let t = (wd / (a + c * w2 / (k - 2.0 * a * c))).atan() / wd;
    let (sine, cosine) = (wd * t).sin_cos();
    let force = v / wd * (-a * t).exp() * (k * sine + c * (wd * cosine - a * sine));
    close(response.peaks.contact_force[0].value, force, 1e-13, "largest force");
    close(response.peaks.contact_force[0].time, 0.25 + t, 1e-7, "time of a flat top");
}

/// With c^2 > k m the force c v of the touch is the largest: it falls by k v - c^2 v/m from there on.
#[test]
fn a_strong_damper_pushes_hardest_at_the_touch() {
    let (v, m, k) = (0.4_f64, 3.0_f64, 1200.0_f64);
    for (c, towards) in [(61.0, 1.0), (150.0, 1.0), (150.0, -1.0)] {
        let stops = Stops { clearance: [0.1, 0.1], stiffness: k, damping: c };
        let peaks = solve(&thrown(towards * v, m, stops), &still(1.0)).peaks;
        close(peaks.contact_force[0].value, c * v, 1e-13, "largest force");
        close(peaks.contact_force[0].time, 0.25, 1e-13, "its time");
        close(peaks.contact_velocity[0].value, v, 1e-13, "velocity at contact");
    }
}

/// A constant push against a stop damped at 200 times the critical: the block creeps by the slow mode long after the fast one,
/// exp(-t/0.46 ms), has decayed, and steps are as long as the sample intervals.
#[test]
fn a_block_creeps_into_a_heavily_damped_stop() {
    let (push, gap, m, k) = (0.8_f64, 0.1_f64, 3.0_f64, 90.0_f64);
    let (w, zeta) = ((k / m).sqrt(), 200.0);
    let stops = Stops { clearance: [gap, gap], stiffness: k, damping: 2.0 * zeta * m * w };
    let samples = 301;
    let motion = Motion::new(vec![-push; samples], 0.01, None).unwrap();
    let response = solve(&thrown(0.0, m, stops), &motion);
    let (fast, touch) = (w * (zeta + (zeta * zeta - 1.0).sqrt()), (2.0 * gap / push).sqrt());
    let slow = w * w / fast;
    // e = rest + a exp(-fast t) + b exp(-slow t), from e = 0 at the velocity of the touch.
    let (rest, velocity, t) = (push * m / k, (2.0 * gap * push).sqrt(), 3.0 - touch);
    let a = (slow * rest - velocity) / (fast - slow);
    let b = -rest - a;
    let e = a * (-fast * t).exp() - rest * (-slow * t).exp_m1() - a * (-slow * t).exp();
    close(times(&response, EventKind::TouchStop)[0], touch, 1e-14, "touch");
    close(response.residual_slip[0] - gap, e, 1e-12, "creep");
    close(response.peaks.contact_force[0].value, stops.damping * velocity, 1e-13, "force at the touch");
    let lost = m * push * (gap + e) - 0.5 * k * e * e - 0.5 * m * (b * slow * (-slow * t).exp()).powi(2);
    close(response.energy.unwrap().contact, lost, 1e-12, "energy of the contact");
    assert!(response.statistics.series_steps < samples + 40, "{} steps", response.statistics.series_steps);
}

/// A motion, and the same with each interval divided: steps of other lengths in which other modes count as decayed.
fn divided(motion: &Motion, parts: usize) -> Motion {
    let samples = motion.acceleration();
    let of_pair = |pair: &[f64]| -> Vec<f64> {
        (0..parts).map(|i| pair[0] + (pair[1] - pair[0]) * i as f64 / parts as f64).collect()
    };
    let inner = samples.windows(2).flat_map(of_pair).chain(samples.last().copied());
    Motion::new(inner.collect::<Vec<f64>>(), motion.dt() / parts as f64, None).unwrap()
}

/// Dampers of a building and of two stops over six decades, from rest and from blocks that move: peaks are those of a motion
/// with sixteen times as many samples, and where all is strongly damped steps are few.
#[test]
fn decayed_modes_of_many_dampers_change_no_peak() {
    let motion =
        Motion::new((0..200).map(|i| 2.0 * (0.11 * f64::from(i) + 0.7).sin()).collect::<Vec<f64>>(), 0.01, None);
    let motion = motion.unwrap();
    let powers: Vec<f64> = (-1..=2).map(|power| 10.0_f64.powi(2 * power)).collect();
    let stiffness = DMatrix::from_row_slice(2, 2, &[5e5, -2e5, -2e5, 2e5]);
    for &of_building in &powers {
        for (of_first, of_second) in powers.iter().flat_map(|first| powers.iter().map(move |second| (first, second))) {
            let damping = Damping::Matrix(&stiffness * (1e-3 * of_building));
            let storeys = vec![Storey::elastic(3e5), Storey::elastic(2e5)];
            let building =
                GeneralBuilding::new(vec![900.0, 700.0], storeys, None, &damping, GravityEffect::None).unwrap();
            let goods = |floor: usize, damping: f64| Goods {
                block: Block { velocity: Some(0.3), ..Block::new(floor, 80.0, 0.02) },
                stops: Some(Stops { clearance: [0.004, 0.003], stiffness: 9e3, damping: 2.0 * damping * 848.5 }),
            };
            let goods = vec![goods(1, *of_first), goods(2, *of_second), Block::new(2, 110.0, 0.1).into()];
            let scene = GeneralScene::new(Some(Arc::new(building)), goods, Vec::new()).unwrap();
            let (one, other) = (solve(&scene, &motion), solve(&scene, &divided(&motion, 16)));
            let peaks = |response: &GeneralResponse| -> Vec<f64> {
                let peaks = &response.peaks;
                let all = peaks.drift.iter().chain(&peaks.slip).chain(&peaks.contact_force);
                all.map(|peak| peak.value).collect()
            };
            let what = format!("dampers {of_building:e}, {of_first:e}, {of_second:e}");
            for (a, b) in peaks(&one).into_iter().zip(peaks(&other)) {
                close(a, b, 1e-9, &what);
            }
            assert_eq!(one.statistics.events.total(), other.statistics.events.total(), "{what}");
        }
    }
    let damping = Damping::Matrix(&stiffness * 1e3);
    let storeys = vec![Storey::elastic(3e5), Storey::elastic(2e5)];
    let building = GeneralBuilding::new(vec![900.0, 700.0], storeys, None, &damping, GravityEffect::None).unwrap();
    let scene = GeneralScene::new(Some(Arc::new(building)), Vec::new(), Vec::new()).unwrap();
    let steps = solve(&scene, &motion).statistics.series_steps;
    assert!(steps < 20 * 200, "{steps} steps of a building that starts from rest");
}

/// A block held by friction against its stop keeps k e: it is at rest where the spring force is below mu m g.
#[test]
fn a_block_sticks_at_its_stop() {
    let (v, m, k, mu) = (0.5_f64, 2.0_f64, 100.0_f64, 0.3_f64);
    let block = Block { velocity: Some(v), ..Block::new(0, m, mu) };
    let goods = Goods { block, stops: Some(Stops::new(0.01, k)) };
    let response = solve(&GeneralScene::new(None, vec![goods], Vec::new()).unwrap(), &still(2.0));
    // From the stop on: m v1^2/2 = k e^2/2 + mu m g e, with v1^2 = v^2 - 2 mu g c.
    let friction = mu * m * STANDARD_GRAVITY;
    let kinetic = 0.5 * m * v * v - friction * 0.01;
    let e = (-friction + (friction * friction + 2.0 * k * kinetic).sqrt()) / k;
    assert!(k * e < friction);
    close(response.residual_slip[0], 0.01 + e, 1e-13, "slip");
    close(response.energy.unwrap().elastic, 0.5 * k * e * e, 1e-12, "energy in the stop");
    assert_eq!(response.statistics.events.of(EventKind::LeaveStop), 0);
}

/// Goods that are fixed, and goods that never slide, are mass of their level; the damping is that with goods attached.
#[test]
fn fixed_goods_are_mass() {
    let building = || {
        let building = UniformBuilding { storeys: 2, period: 0.4, mass: 1000.0, ..Default::default() }.build().unwrap();
        Some(Arc::new(GeneralBuilding::from(&building)))
    };
    let rack = |mass: f64, goods: Vec<Goods>| Rack {
        floor: 1,
        mass: vec![mass; 2],
        levels: vec![Storey::elastic(5e4); 2],
        damping_ratio: 0.03,
        geometric_stiffness: Vec::new(),
        goods,
    };
    let fixed = GeneralScene::new(building(), Vec::new(), vec![rack(350.0, Vec::new())]).unwrap();
    let stuck = (1..=2).map(|level| Block::new(level, 300.0, 50.0).into()).collect();
    let stuck = GeneralScene::new(building(), Vec::new(), vec![rack(50.0, stuck)]).unwrap();
    let [one, other] = [fixed, stuck].map(|scene| solve(&scene, &waves()));
    for (a, b) in one.peaks.drift.iter().zip(&other.peaks.drift) {
        close(a.value, b.value, 1e-13, "drift");
    }
}

/// The first period of a rack of equal levels: w = 2 sqrt(k/m) sin(pi/10) with two of them.
#[test]
fn the_period_of_a_rack_gives_its_stiffness() {
    let k = Rack::uniform_stiffness(&[3.0, 3.0], 0.5).unwrap();
    close(2.0 * PI / (2.0 * (k / 3.0).sqrt() * (0.1 * PI).sin()), 0.5, 1e-14, "period");
}

/// The stiffness of the storeys as a matrix over the floors, in part or altogether: the same building.
#[test]
fn a_matrix_stands_for_springs() {
    let (mass, stiffness) = (vec![1000.0, 1500.0, 800.0], [6e5, 4e5, 3e5]);
    let b = DMatrix::from_row_slice(3, 3, &[1.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, -1.0, 1.0]);
    let peaks = |share: f64| {
        let storeys = stiffness.map(|k| Storey::elastic((1.0 - share) * k)).to_vec();
        let springs = DMatrix::from_diagonal(&nalgebra::DVector::from_vec(stiffness.map(|k| share * k).to_vec()));
        let matrix = (share > 0.0).then(|| b.transpose() * springs * &b);
        let damping = Damping::Modal { ratio: 0.05 };
        let building = GeneralBuilding::new(mass.clone(), storeys, matrix, &damping, GravityEffect::None).unwrap();
        let goods = (1..=3).map(|floor| Block::new(floor, 700.0, 0.2).into()).collect();
        let scene = GeneralScene::new(Some(Arc::new(building)), goods, Vec::new()).unwrap();
        solve(&scene, &waves()).peaks
    };
    let chain = peaks(0.0);
    for share in [0.3, 1.0] {
        let of_matrix = peaks(share);
        for (a, b) in of_matrix.drift.iter().chain(&of_matrix.slip).zip(chain.drift.iter().chain(&chain.slip)) {
            close(a.value, b.value, 1e-11, "drift or slip");
        }
        close(of_matrix.base_shear.value, chain.base_shear.value, 1e-11, "base shear");
    }
}

/// Goods without friction between damped stops without clearance, at rest on a light rack as a motion begins that is no zero:
/// what their damper holds has decayed at once, and the force of the stop begins at zero. They come to their stop once.
#[test]
fn goods_at_damped_stops_without_clearance_start_once() {
    for seed in 0..500 {
        let draw = &mut Draw(seed);
        let samples: Vec<f64> = [0.27, 0.23, 0.18, 0.14].map(|mean| mean * draw.scale(0.3, 3.0)).to_vec();
        let (mass, levels) = (draw.scale(10.0, 3000.0), 4);
        let stiffness = mass * draw.scale(1e3, 1e5);
        let damping = 2.0 * draw.scale(0.5, 10.0) * (stiffness * mass).sqrt();
        let stops = Stops { clearance: [0.0, 0.0], stiffness, damping };
        let rack = Rack {
            floor: 0,
            mass: (0..levels).map(|_| draw.scale(10.0, 100.0)).collect(),
            levels: (0..levels).map(|_| Storey::elastic(draw.scale(1e4, 1e7))).collect(),
            damping_ratio: 0.05 * (seed % 2) as f64,
            geometric_stiffness: Vec::new(),
            goods: vec![Goods { block: Block::new(levels, mass, 0.0), stops: Some(stops) }],
        };
        let scene = GeneralScene::new(None, Vec::new(), vec![rack]).unwrap();
        let response = solve(&scene, &Motion::new(samples, 0.005, None).unwrap());
        let at_start = times(&response, EventKind::TouchStop).iter().filter(|&&time| time < 1e-9).count();
        assert_eq!(at_start, 1, "seed {seed}");
    }
}
