//! Every reference scene, solved by an independent 64-bit-mantissa solver, in double and in double-double.

#![allow(clippy::unwrap_used)]

mod common;
#[path = "../../seismass/tests/references/mod.rs"]
mod references;

use common::{numbers, read_events, read_reference, table};
use references::reference_files;
use seismass_judge::{DoubleDouble, Real, Solution, compare_events, larger, solve};
use serde_json::Value;

/// Demanded of any implementation in doubles: histories and peaks, relative to the larger of the peak and a
/// thousandth of the scene's largest.
const HISTORY: f64 = 1e-11;
const PEAK: f64 = 1e-12;
/// In double-double what is left is the rounding of the damping matrix, a double here, amplified by the motion.
const DOUBLE_DOUBLE: f64 = 2e-13;
/// Event times (s).
const EVENT_TIME: f64 = 1e-10;

fn worst(found: &[f64], expected: &[f64], peaks: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let largest = peaks.iter().copied().fold(0.0, larger);
    let scales = peaks.iter().map(|p| p.max(1e-3 * largest)).cycle();
    let errors = found.iter().zip(expected).zip(scales);
    errors.map(|((f, e), scale)| if f == e { 0.0 } else { (f - e).abs() / scale }).fold(0.0, larger)
}

/// Errors of drift, slip, peaks and residuals, and event times.
fn errors(solution: &Solution, result: &Value) -> [f64; 4] {
    let (peak_drift, peak_slip) = (numbers(&result["peak_drift"]), numbers(&result["peak_slip"]));
    let drift = worst(&solution.drift, &table(&result["drift"]), &peak_drift);
    let slip = worst(&solution.slip, &table(&result["slip"]), &peak_slip);
    let values = |peaks: &[seismass::Peak]| peaks.iter().map(|p| p.value).collect::<Vec<f64>>();
    let peaks = [
        worst(&values(&solution.peaks.drift), &peak_drift, &peak_drift),
        worst(&values(&solution.peaks.slip), &peak_slip, &peak_slip),
        worst(&solution.residual_drift, &numbers(&result["residual_drift"]), &peak_drift),
        worst(&solution.residual_slip, &numbers(&result["residual_slip"]), &peak_slip),
    ];
    let time = compare_events(&solution.events, &read_events(result)).unwrap_or_else(|difference| {
        println!("    {difference}");
        f64::INFINITY
    });
    [drift, slip, peaks.into_iter().fold(0.0, larger), time]
}

fn check<R: Real>(limits: [f64; 4], residual: f64) {
    println!(
        "{:26} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7} {:>7}",
        "scene", "drift", "slip", "peaks", "event/s", "energy", "events", "time/s"
    );
    let mut failed = Vec::new();
    for path in reference_files("") {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let (scene, motion, result) = read_reference(&path);
        let every = result["sample_every"].as_u64().unwrap() as usize;
        let clock = std::time::Instant::now();
        let solution = solve::<R>(&scene, &motion, every).unwrap();
        let seconds = clock.elapsed().as_secs_f64();
        let found = errors(&solution, &result);
        let energy = solution.energy.relative_residual;
        let [drift, slip, peaks, time] = found;
        let events = solution.events.len();
        println!("{name:26} {drift:9.1e} {slip:9.1e} {peaks:9.1e} {time:9.1e} {energy:9.1e} {events:7} {seconds:7.2}");
        let good = found.iter().zip(limits).all(|(&error, limit)| error <= limit) && energy.abs() <= residual;
        if !good {
            failed.push(name);
        }
    }
    assert!(failed.is_empty(), "beyond tolerance: {failed:?}");
}

#[test]
fn reference_scenes_in_double() {
    check::<f64>([HISTORY, HISTORY, PEAK, EVENT_TIME], 1e-13);
}

#[test]
fn reference_scenes_in_double_double() {
    check::<DoubleDouble>([DOUBLE_DOUBLE, DOUBLE_DOUBLE, DOUBLE_DOUBLE, EVENT_TIME], 1e-29);
}
