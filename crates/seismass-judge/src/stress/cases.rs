//! Named cases: each a scene, an expectation in one line, and the check that it holds.

mod extremes;
mod friction;
mod grazing;
mod long;
mod ranges;
mod simultaneous;

use std::panic::catch_unwind;
use std::sync::Arc;

use rayon::prelude::*;
use seismass::{Block, Building, Damping, EventKind, Motion, Response, Scene, Storey};

use super::random::{LARGEST_RESIDUAL, solve_checked};
use crate::random_scene::{Draw, samples_of};
use crate::{Comparison, Real, compare, larger, solve};

/// What came out, or what is wrong.
pub type Outcome = Result<String, String>;

/// A named case.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// What kind of stress it is.
    pub theme: &'static str,
    /// Name.
    pub name: &'static str,
    /// What must come out.
    pub expectation: &'static str,
    /// Runs it.
    pub run: fn() -> Outcome,
}

/// A case and what came of it.
#[derive(Debug, Clone)]
pub struct Finding {
    /// The case.
    pub case: Case,
    /// What came out, or what is wrong.
    pub outcome: Outcome,
}

/// All cases, by theme.
pub fn all() -> Vec<Case> {
    [grazing::CASES, simultaneous::CASES, friction::CASES, extremes::CASES, ranges::CASES, long::CASES].concat()
}

/// Runs cases in parallel.
pub fn run(cases: &[Case]) -> Vec<Finding> {
    let outcome = |case: &Case| catch_unwind(case.run).unwrap_or_else(|_| Err("panic".into()));
    cases.par_iter().map(|case| Finding { case: *case, outcome: outcome(case) }).collect()
}

/// The kernel's response with events, histories and energies, checked by itself.
fn checked(scene: &Scene, motion: &Motion) -> Result<Response, String> {
    let response = solve_checked(scene, motion)?;
    let residual = residual(&response);
    require(residual <= LARGEST_RESIDUAL, || format!("energy residual {residual:.1e}"))?;
    Ok(response)
}

fn residual(response: &Response) -> f64 {
    response.energy.map_or(f64::NAN, |e| e.relative_residual.abs())
}

/// Largest relative difference to the judge, of numbers and of times; the judge must have the same events.
fn judged<R: Real>(scene: &Scene, motion: &Motion, response: &Response, tolerance: f64) -> Result<f64, String> {
    let comparison = compared::<R>(scene, motion, response)?;
    let worst = larger(comparison.worst(), comparison.worst_time());
    require(worst <= tolerance, || format!("differs from the judge by {worst:.1e}"))?;
    Ok(worst)
}

/// How far from the judge, which must have the same events.
fn compared<R: Real>(scene: &Scene, motion: &Motion, response: &Response) -> Result<Comparison, String> {
    let exact = text(solve::<R>(scene, motion, 1))?;
    let comparison = compare(response, &exact);
    match comparison.mismatch {
        Some(mismatch) => Err(format!("parts from the judge: {mismatch}")),
        None => Ok(comparison),
    }
}

fn require(holds: bool, fault: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(fault()) }
}

fn close(what: &str, found: f64, expected: f64, tolerance: f64) -> Result<(), String> {
    require((found - expected).abs() <= tolerance, || format!("{what} {found:e} for {expected:e}"))
}

fn expect_count(response: &Response, kind: EventKind, expected: usize) -> Result<(), String> {
    let found = response.statistics.events.of(kind);
    require(found == expected, || format!("{found} {} for {expected}", kind.name()))
}

fn expect_no_event(response: &Response) -> Result<(), String> {
    let found = response.statistics.events.total();
    require(found == 0, || format!("{found} events for none: {:?}", response.events.as_ref().and_then(|e| e.first())))?;
    require(response.slip_path.iter().all(|&path| path == 0.0), || format!("slip path {:?}", response.slip_path))
}

fn times(response: &Response, kind: EventKind) -> Vec<f64> {
    response.events.iter().flatten().filter(|e| e.kind == kind).map(|e| e.time).collect()
}

fn text<T, E: ToString>(result: Result<T, E>) -> Result<T, String> {
    result.map_err(|e| e.to_string())
}

fn motion(samples: Vec<f64>, dt: f64) -> Result<Motion, String> {
    text(Motion::new(samples, dt, None))
}

/// A random record of the generator's kinds.
fn record(seed: u64, samples: usize, dt: f64, peak: f64) -> Vec<f64> {
    samples_of(&mut Draw(seed), samples, dt, peak)
}

fn on_ground(block: Block) -> Result<Scene, String> {
    text(Scene::new(None, vec![Block { floor: 0, ..block }]))
}

/// A building with these floor masses and springs.
fn building(mass: Vec<f64>, storeys: Vec<Storey>, damping: f64) -> Result<Building, String> {
    text(Building::new(mass, storeys, Damping::Modal { ratio: damping }))
}

fn standing(building: Building, blocks: Vec<Block>) -> Result<Scene, String> {
    text(Scene::new(Some(Arc::new(building)), blocks))
}

/// One storey of unit mass and this period.
fn oscillator(period: f64, damping: f64, blocks: Vec<Block>) -> Result<Scene, String> {
    let stiffness = (std::f64::consts::TAU / period).powi(2);
    standing(building(vec![1.0], vec![Storey::elastic(stiffness)], damping)?, blocks)
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| larger(most, value.abs()))
}

/// Largest difference of two lists, relative to the largest value of the second.
fn difference(found: &[f64], expected: &[f64]) -> f64 {
    let apart = found.iter().zip(expected).fold(0.0, |worst, (f, e)| larger(worst, (f - e).abs()));
    if found.len() == expected.len() { apart / largest(expected).max(f64::MIN_POSITIVE) } else { f64::INFINITY }
}
