//! What must hold for every valid scene (specification, section 8), on random scenes.

#![allow(clippy::unwrap_used)]

use std::num::NonZeroUsize;
use std::sync::Arc;

use proptest::prelude::*;
use proptest::test_runner::FileFailurePersistence;
use seismass::{
    Block, Building, Control, Damping, GravityEffect, Motion, Options, Response, Run, STANDARD_GRAVITY, Scene, Storey,
    simulate, simulate_many,
};

/// Two ways to the same response differ by rounding, amplified by the motion: this fraction of the largest value.
const TOLERANCE: f64 = 1e-9;
const ENERGY: f64 = 1e-11;

/// A random scene and motion as plain numbers, so that an invariant can change them.
#[derive(Debug, Clone)]
struct Case {
    mass: Vec<f64>,
    storeys: Vec<Storey>,
    damping: Damping,
    geometric: Vec<f64>,
    blocks: Vec<Block>,
    acceleration: Vec<f64>,
    vertical: Option<Vec<f64>>,
    dt: f64,
}

impl Case {
    fn building(&self) -> Building {
        Building::new(self.mass.clone(), self.storeys.clone(), self.damping.clone())
            .unwrap()
            .with_gravity(GravityEffect::GeometricStiffness(self.geometric.clone()))
            .unwrap()
    }

    fn scene(&self) -> Scene {
        Scene::new(Some(Arc::new(self.building())), self.blocks.clone()).unwrap()
    }

    fn motion(&self) -> Motion {
        Motion::new(self.acceleration.clone(), self.dt, self.vertical.clone().map(Into::into)).unwrap()
    }

    fn solve(&self) -> Response {
        let options = Options { histories: NonZeroUsize::new(1), events: true, energy: true, ..Options::default() };
        let series = simulate(&self.scene(), &self.motion(), &options).unwrap();
        let mut plain = simulate(&self.scene(), &self.motion(), &Options { energy: false, ..options }).unwrap();
        plain.energy = series.energy;
        assert!(same_bits(&series, &plain), "energies change nothing else");
        let without = simulate(&self.scene(), &self.motion(), &Options { histories: None, energy: false, ..options });
        plain.histories = None;
        plain.energy = None;
        assert!(same_bits(&plain, &without.unwrap()), "histories change nothing else");
        series
    }

    /// A bare copy in which the damping matrix is given, so that masses can change without changing it.
    fn with_fixed_damping(&self) -> Self {
        Self { damping: Damping::Matrix(self.building().damping_matrix()), ..self.clone() }
    }
}

fn largest(values: &[f64]) -> f64 {
    values.iter().filter(|v| v.is_finite()).fold(0.0, |m, v| m.max(v.abs()))
}

/// Histories of `b` are `factor` times those of `a`, and the events are the same.
fn assert_same(a: &Response, b: &Response, factor: f64, what: &str) {
    let (ha, hb) = (a.histories.as_ref().unwrap(), b.histories.as_ref().unwrap());
    for (name, x, y) in [("drift", &ha.drift, &hb.drift), ("slip", &ha.slip, &hb.slip)] {
        assert_eq!(x.len(), y.len(), "{what}");
        let scale = largest(x).max(1e-6);
        for (i, (x, y)) in x.iter().zip(y.iter()).enumerate() {
            let equal = x.is_nan() && y.is_nan() || (x * factor - y).abs() <= TOLERANCE * scale * factor.abs();
            assert!(equal, "{what}: {name} {i}: {x} times {factor} against {y}");
        }
    }
    assert_eq!(a.statistics.events.total(), b.statistics.events.total(), "{what}: events");
}

fn storeys(n: usize) -> impl Strategy<Value = Vec<Storey>> {
    let storey = (0.3..3.0f64, prop_oneof![Just(f64::INFINITY), 0.05..0.6f64], 1.0..2.5f64, 0.0..1.0f64, 0.0..1.0f64)
        .prop_map(|(k, vy, overstrength, r2, fraction)| Storey {
            stiffness: k * 1e6,
            yield_shear: vy * 1000.0 * 9.80665,
            overstrength: if overstrength < 1.2 { 1.0 } else { overstrength },
            second_slope: if r2 < 0.1 { 0.0 } else { r2 },
            third_slope: if r2 < 0.1 || fraction < 0.5 { 0.0 } else { r2 * fraction },
            law: Default::default(),
        });
    prop::collection::vec(storey, n)
}

fn blocks(n: usize) -> impl Strategy<Value = Vec<Block>> {
    let block = (0..=n, 0.1..2.0f64, 0.02..0.5f64, prop_oneof![Just(1.0), 0.5..1.0f64])
        .prop_map(|(floor, mass, mu, ratio)| Block { mu_k: mu * ratio, ..Block::new(floor, mass * 1000.0, mu) });
    // Some blocks have a twin: equal ones must move as one.
    (prop::collection::vec(block, 0..5), any::<bool>()).prop_map(|(mut blocks, twin)| {
        if twin && let Some(first) = blocks.first().cloned() {
            blocks.push(first);
        }
        blocks
    })
}

/// A sum of sines under an envelope, peaks up to `size` g.
fn motion(size: f64) -> impl Strategy<Value = Vec<f64>> {
    let wave = (0.5..8.0f64, 0.0..std::f64::consts::TAU, 0.1..1.0f64);
    (prop::collection::vec(wave, 1..5), 0.1..1.0f64, 200usize..500).prop_map(move |(waves, level, samples)| {
        let sum: f64 = waves.iter().map(|w| w.2).sum();
        (0..samples)
            .map(|i| {
                let (t, s) = (i as f64 * 0.02, i as f64 / samples as f64);
                let wave: f64 =
                    waves.iter().map(|(f, phase, a)| a * (std::f64::consts::TAU * f * t + phase).sin()).sum();
                size * level * 9.80665 * wave / sum * (std::f64::consts::PI * s).sin()
            })
            .collect()
    })
}

prop_compose! {
    fn case()(n in 1usize..5)(
        mass in prop::collection::vec(500.0..2000.0f64, n),
        storeys in storeys(n),
        kind in 0..3u8,
        ratio in 0.0..0.1f64,
        p_delta in prop_oneof![Just(0.0), 0.0..0.02f64],
        blocks in blocks(n),
        acceleration in motion(1.0),
        vertical in prop::option::of(motion(0.8)),
    ) -> Case {
        let n = mass.len();
        let damping = match kind {
            0 if n > 1 => Damping::Rayleigh { ratio, modes: [1, n] },
            _ => Damping::Modal { ratio },
        };
        let geometric = storeys.iter().map(|s| p_delta * s.stiffness).collect();
        let mut acceleration = acceleration;
        let vertical = vertical.map(|mut v| {
            let length = v.len().min(acceleration.len());
            v.truncate(length);
            acceleration.truncate(length);
            v
        });
        Case { mass, storeys, damping, geometric, blocks, acceleration, vertical, dt: 0.02 }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("proptest-regressions"))),
        ..ProptestConfig::default()
    })]

    #[test]
    fn energy_is_balanced(case in case()) {
        let response = case.solve();
        let energy = response.energy.unwrap();
        prop_assert!(energy.relative_residual.abs() < ENERGY, "{:e}", energy.relative_residual);
        if case.vertical.is_none() {
            let paths = case.blocks.iter().zip(&response.slip_path);
            let spent: f64 = paths.map(|(b, path)| b.mu_k * b.mass * STANDARD_GRAVITY * path).sum();
            prop_assert!((spent - energy.friction).abs() <= ENERGY * (energy.friction + energy.input.abs()), "slip path");
        }
    }

    #[test]
    fn scaling_masses_stiffness_and_strength_changes_nothing(case in case(), factor in 0.01..100.0f64) {
        let mut scaled = case.clone();
        scaled.mass.iter_mut().for_each(|m| *m *= factor);
        scaled.geometric.iter_mut().for_each(|p| *p *= factor);
        scaled.blocks.iter_mut().for_each(|b| b.mass *= factor);
        for s in &mut scaled.storeys {
            s.stiffness *= factor;
            s.yield_shear *= factor;
        }
        assert_same(&case.solve(), &scaled.solve(), 1.0, "masses, stiffness and strength scaled");
    }

    #[test]
    fn scaling_motion_friction_and_strength_scales_displacements(case in case(), factor in 0.1..10.0f64) {
        let mut scaled = case.clone();
        scaled.acceleration.iter_mut().for_each(|a| *a *= factor);
        scaled.storeys.iter_mut().for_each(|s| s.yield_shear *= factor);
        for b in &mut scaled.blocks {
            b.mu_s *= factor;
            b.mu_k *= factor;
        }
        assert_same(&case.solve(), &scaled.solve(), factor, "motion, friction and strength scaled");
    }

    #[test]
    fn flipping_the_motion_flips_the_response(case in case()) {
        let mut flipped = case.clone();
        flipped.acceleration.iter_mut().for_each(|a| *a = -*a);
        let (a, b) = (case.solve(), flipped.solve());
        prop_assert_eq!(&a.peaks, &b.peaks);
        assert_same(&a, &b, -1.0, "motion flipped");
    }

    #[test]
    fn splitting_each_interval_in_four_changes_nothing(case in case()) {
        let split = |samples: &[f64]| -> Vec<f64> {
            let mut fine = Vec::new();
            for pair in samples.windows(2) {
                fine.extend((0..4).map(|k| pair[0] + (pair[1] - pair[0]) * f64::from(k) / 4.0));
            }
            fine.extend(samples.last());
            fine
        };
        let mut fine = case.clone();
        fine.acceleration = split(&case.acceleration);
        fine.vertical = case.vertical.as_deref().map(split);
        fine.dt = case.dt / 4.0;
        let coarse = case.solve();
        let options = Options { histories: NonZeroUsize::new(4), events: true, ..Options::default() };
        let fine = simulate(&fine.scene(), &fine.motion(), &options).unwrap();
        assert_same(&coarse, &fine, 1.0, "intervals split");
    }

    #[test]
    fn without_slip_blocks_are_added_mass(case in case()) {
        let mut stuck = case.with_fixed_damping();
        stuck.vertical = None;
        stuck.blocks.iter_mut().for_each(|b| (b.mu_s, b.mu_k) = (1e3, 1e3));
        let mut added = stuck.clone();
        for b in added.blocks.drain(..).filter(|b| b.floor > 0) {
            added.mass[b.floor - 1] += b.mass;
        }
        let (a, b) = (stuck.solve(), added.solve());
        prop_assert!(a.peaks.slip.iter().all(|p| p.value == 0.0));
        let mut a_bare = a;
        a_bare.histories.as_mut().unwrap().slip.clear();
        assert_same(&a_bare, &b, 1.0, "stuck blocks");
    }

    #[test]
    fn without_friction_blocks_are_absent(case in case()) {
        let mut loose = case;
        loose.blocks.iter_mut().for_each(|b| (b.mu_s, b.mu_k) = (0.0, 0.0));
        let mut bare = loose.clone();
        bare.blocks.clear();
        let (a, b) = (loose.solve(), bare.solve());
        let (da, db) = (&a.histories.as_ref().unwrap().drift, &b.histories.as_ref().unwrap().drift);
        let scale = largest(da).max(1e-6);
        for (x, y) in da.iter().zip(db) {
            prop_assert!(x.is_nan() && y.is_nan() || (x - y).abs() <= TOLERANCE * scale, "{x} {y}");
        }
    }

    #[test]
    fn the_order_of_blocks_does_not_matter(case in case()) {
        let mut reversed = case.clone();
        reversed.blocks.reverse();
        let (a, mut b) = (case.solve(), reversed.solve());
        if !case.blocks.is_empty() {
            let slip = &mut b.histories.as_mut().unwrap().slip;
            slip.chunks_mut(case.blocks.len()).for_each(<[f64]>::reverse);
        }
        assert_same(&a, &b, 1.0, "blocks reversed");
    }

    #[test]
    fn threads_order_and_company_change_no_bit(cases in prop::collection::vec(case(), 2..5)) {
        let scenes: Vec<Scene> = cases.iter().map(Case::scene).collect();
        let motions: Vec<Motion> = cases.iter().map(Case::motion).collect();
        let mut runs: Vec<Run> =
            (0..scenes.len()).flat_map(|s| (0..motions.len()).map(move |m| Run::new(s, m))).collect();
        let options = Options { events: true, ..Options::default() };
        let batch = |runs: &[Run], threads| {
            simulate_many(&scenes, &motions, runs, &options, Some(threads), &Control::default()).unwrap()
        };
        let one = batch(&runs, 1);
        let three = batch(&runs, 3);
        prop_assert!(one.iter().zip(&three).all(|(a, b)| same_bits(a.as_ref().unwrap(), b.as_ref().unwrap())));
        for (run, response) in runs.iter().zip(&one) {
            let alone = simulate(&scenes[run.scene], &motions[run.motion], &options).unwrap();
            prop_assert!(same_bits(response.as_ref().unwrap(), &alone));
        }
        runs.reverse();
        let reversed = batch(&runs, 2);
        prop_assert!(one.iter().rev().zip(&reversed).all(|(a, b)| same_bits(a.as_ref().unwrap(), b.as_ref().unwrap())));
    }
}

/// Equal to the bit (the debug form prints every digit, and NaN as NaN).
fn same_bits(a: &Response, b: &Response) -> bool {
    format!("{a:?}") == format!("{b:?}")
}
