//! Random scenes with the further spring laws and with wear, in the fast kernel and in double-double.

#![allow(clippy::unwrap_used)]

use std::num::NonZeroUsize;

use rayon::prelude::*;
use seismass::{Energy, Event, EventKind, Options, Response, Status, simulate};
use seismass_judge::law_scene::law_scene;
use seismass_judge::{Comparison, DoubleDouble, Solution, compare, larger, solve};

/// As for other random scenes: they agree far better, or they part at an event that one implementation missed.
const AGREEMENT: f64 = 1e-9;
/// Energy residual that rounding explains, as in the stress suite.
const LARGEST_RESIDUAL: f64 = 1e-11;
/// Event times are not resolved below this (s).
const TIME_ROUNDING: f64 = 1e-12;

/// Seeds of a run of the tests; `SEISMASS_JUDGE_SCENES` sets another number.
fn seeds() -> std::ops::Range<u64> {
    let first = std::env::var("SEISMASS_JUDGE_FIRST").map_or(0, |n| n.parse().unwrap());
    first..first + std::env::var("SEISMASS_JUDGE_SCENES").map_or(150, |n| n.parse::<u64>().unwrap())
}

/// Largest difference of energies, relative to the largest of them.
fn energies_apart(found: &Energy, expected: &Energy) -> f64 {
    let values = |e: &Energy| [e.initial, e.input, e.kinetic, e.elastic, e.viscous, e.hysteretic, e.friction];
    let scale = values(expected).into_iter().fold(0.0, |scale, value| larger(scale, value.abs()));
    let pairs = values(found).into_iter().zip(values(expected));
    pairs.fold(0.0, |worst, (f, e)| larger(worst, if f == e { 0.0 } else { (f - e).abs() / scale }))
}

/// Leaves out the yield at which a softening spring without residual strength comes to zero force: that is where its storey
/// collapses without P-Delta, and rounding decides which comes first.
fn without_yield_at_collapse(events: &mut Vec<Event>, status: &Status) {
    if let &Status::Collapsed { storey, time } = status {
        let at_once = |e: &Event| e.kind == EventKind::Yield && e.number == storey && time - e.time <= TIME_ROUNDING;
        events.retain(|event| !at_once(event));
    }
}

struct Found {
    seed: u64,
    response: Response,
    exact: Solution,
    comparison: Comparison,
    energies: f64,
}

impl Found {
    fn of(seed: u64) -> Self {
        let (scene, motion) = law_scene(seed).unwrap();
        let options = Options { histories: NonZeroUsize::new(3), events: true, energy: true, ..Options::default() };
        let mut response = simulate(&scene, &motion, &options).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        let mut exact = solve::<DoubleDouble>(&scene, &motion, 3).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        without_yield_at_collapse(response.events.as_mut().unwrap(), &response.status);
        without_yield_at_collapse(&mut exact.events, &exact.status);
        let comparison = compare(&response, &exact);
        let energies = energies_apart(response.energy.as_ref().unwrap(), &exact.energy);
        Self { seed, response, exact, comparison, energies }
    }

    fn agrees(&self) -> bool {
        self.comparison.agrees(AGREEMENT) && self.energies <= AGREEMENT
    }
}

#[test]
fn the_fast_kernel_agrees_with_the_judge() {
    let found: Vec<Found> = seeds().into_par_iter().map(Found::of).collect();
    let (mut worst, mut worst_time, mut energies, mut residual, mut exact_residual) = (0.0, 0.0, 0.0, 0.0, 0.0);
    let mut counts = [0; EventKind::ALL.len()];
    let mut apart = Vec::new();
    for run in &found {
        exact_residual = larger(exact_residual, run.exact.energy.relative_residual.abs());
        run.exact.events.iter().for_each(|event| counts[event.kind as usize] += 1);
        if run.agrees() {
            worst = larger(worst, run.comparison.worst());
            worst_time = larger(worst_time, run.comparison.worst_time());
            energies = larger(energies, run.energies);
            residual = larger(residual, run.response.energy.as_ref().unwrap().relative_residual.abs());
        } else {
            apart.push(format!("seed {}: energies {:.1e}, {:?}", run.seed, run.energies, run.comparison));
        }
    }
    let collapsed = found.iter().filter(|run| run.exact.status != Status::Completed).count();
    println!("{} of {} agree, {collapsed} collapse", found.len() - apart.len(), found.len());
    println!("worst {worst:.1e}, event times {worst_time:.1e}, energies {energies:.1e}");
    println!("energy residuals {residual:.1e} and {exact_residual:.1e}");
    for (kind, count) in EventKind::ALL.iter().zip(counts) {
        println!("  {}: {count}", kind.name());
        // A touch, which is rare, needs a graze; these scenes have no stops.
        let absent = matches!(kind, EventKind::Touch | EventKind::TouchStop | EventKind::LeaveStop);
        assert!(count > 0 || found.len() < 100 || absent, "no event {}", kind.name());
    }
    apart.iter().for_each(|line| println!("{line}"));
    assert!(apart.is_empty());
    assert!(residual < LARGEST_RESIDUAL && exact_residual < 1e-26);
}
