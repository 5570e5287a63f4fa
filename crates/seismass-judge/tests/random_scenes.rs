//! Random scenes in double and in double-double, and the fast kernel beside them.

#![allow(clippy::unwrap_used)]

use std::num::NonZeroUsize;

use seismass::{Options, simulate};
use seismass_judge::random_scene::random_scene;
use seismass_judge::{Comparison, DoubleDouble, compare, larger, solve};

/// Seeds of a run of the tests; `SEISMASS_JUDGE_SCENES` sets another number.
fn seeds(usual: u64) -> std::ops::Range<u64> {
    0..std::env::var("SEISMASS_JUDGE_SCENES").map_or(usual, |n| n.parse().unwrap())
}

/// Rounding grows along a motion, and more in a collapse: scenes agree to 1e-12 and better (5000 seeds), or they part
/// at an event that one implementation missed.
const AGREEMENT: f64 = 1e-9;

struct Tally {
    what: &'static str,
    scenes: usize,
    worst: f64,
    worst_time: f64,
    apart: Vec<String>,
}

impl Tally {
    fn new(what: &'static str) -> Self {
        Self { what, scenes: 0, worst: 0.0, worst_time: 0.0, apart: Vec::new() }
    }

    fn add(&mut self, seed: u64, comparison: &Comparison) {
        self.scenes += 1;
        if comparison.agrees(AGREEMENT) {
            self.worst = larger(self.worst, comparison.worst());
            self.worst_time = larger(self.worst_time, comparison.worst_time());
        } else {
            self.apart.push(format!("seed {seed}: {comparison:?}"));
        }
    }

    fn report(&self) {
        let agree = self.scenes - self.apart.len();
        let (numbers, times) = (self.worst, self.worst_time);
        println!("{}: {agree} of {} agree, worst {numbers:.1e}, event times {times:.1e}", self.what, self.scenes);
        self.apart.iter().for_each(|line| println!("  {line}"));
    }
}

#[test]
fn double_agrees_with_double_double() {
    let mut tally = Tally::new("double and double-double");
    let (mut energy, mut energy_double_double, mut events) = (0.0, 0.0, 0);
    for seed in seeds(60) {
        let (scene, motion) = random_scene(seed).unwrap();
        let exact = solve::<DoubleDouble>(&scene, &motion, 3).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let double = solve::<f64>(&scene, &motion, 3).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        energy = larger(energy, double.energy.relative_residual.abs());
        energy_double_double = larger(energy_double_double, exact.energy.relative_residual.abs());
        events += exact.events.len();
        tally.add(seed, &exact.judge(&double));
    }
    tally.report();
    println!("{events} events; energy residuals {energy:.1e} and {energy_double_double:.1e}");
    assert!(energy < 1e-11 && energy_double_double < 1e-27);
    assert!(tally.apart.is_empty());
}

/// Where the judge in double parts from the kernel, the judge in double-double decides: in double it may find a
/// frictionless block to slip a piece late, on a floor whose acceleration begins below rounding.
#[test]
fn the_fast_kernel_agrees_with_the_judge() {
    let mut tally = Tally::new("kernel and judge");
    let options = Options { histories: NonZeroUsize::new(3), events: true, ..Options::default() };
    for seed in seeds(300) {
        let (scene, motion) = random_scene(seed).unwrap();
        let judge = solve::<f64>(&scene, &motion, 3).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let response = simulate(&scene, &motion, &options).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let mut comparison = compare(&response, &judge);
        if !comparison.agrees(AGREEMENT) {
            let exact = solve::<DoubleDouble>(&scene, &motion, 3).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
            comparison = compare(&response, &exact);
        }
        tally.add(seed, &comparison);
    }
    tally.report();
    assert!(tally.apart.is_empty());
}
