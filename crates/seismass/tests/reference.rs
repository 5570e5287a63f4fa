//! Every reference scene, solved by an independent 64-bit-mantissa solver: histories, peaks, events, energies.

#![allow(clippy::unwrap_used)]

mod common;
mod maximum;
mod references;

use std::num::NonZeroUsize;

use common::{floats, read};
use maximum::larger;
use references::reference_files;
use seismass::{Event, Options, simulate};
use serde_json::Value;

/// Histories agree to this fraction of the larger of the history's peak and a thousandth of the scene's largest.
const HISTORY: f64 = 1e-13;
/// Peaks agree to this fraction of the same.
const PEAK: f64 = 1e-13;
/// Event times agree to this (s).
const EVENT_TIME: f64 = 1e-13;
/// Events that are closer (s) are in one instant, where their order means nothing.
const INSTANT: f64 = 1e-10;
/// Energies balance to this fraction of the input.
const ENERGY: f64 = 1e-13;

/// Largest deviation of columns from a reference, relative to max(column peak, largest peak / 1000).
fn worst(found: &[f64], expected: &[Vec<f64>], peaks: &[f64]) -> f64 {
    let largest = peaks.iter().copied().fold(0.0, larger);
    let width = peaks.len();
    let mut worst = 0.0;
    for (row, values) in expected.iter().enumerate() {
        for (column, &value) in values.iter().enumerate() {
            let scale = peaks[column].max(1e-3 * largest);
            let error = (found[row * width + column] - value).abs();
            worst = larger(worst, if error == 0.0 { 0.0 } else { error / scale });
        }
    }
    worst
}

fn rows(value: &Value) -> Vec<Vec<f64>> {
    value.as_array().unwrap().iter().map(floats).collect()
}

/// Events of one instant may come in any order: compares after sorting within groups closer than the tolerance.
fn compare_events(found: &[Event], expected: &[Value]) -> Result<f64, String> {
    let mut expected: Vec<(f64, String)> = expected
        .iter()
        .map(|e| {
            let element = e.get("element").map_or(0, |v| v.as_i64().unwrap());
            let key = format!("{} {} {} {element}", e["kind"].as_str().unwrap(), e["number"], e["sign"]);
            (e["time"].as_f64().unwrap(), key)
        })
        .collect();
    let mut found: Vec<(f64, String)> =
        found.iter().map(|e| (e.time, format!("{} {} {} {}", e.kind.name(), e.number, e.sign, e.element))).collect();
    for list in [&mut expected, &mut found] {
        let mut start = 0;
        while start < list.len() {
            let mut end = start + 1;
            while end < list.len() && list[end].0 - list[end - 1].0 <= INSTANT {
                end += 1;
            }
            list[start..end].sort_by(|a, b| a.1.cmp(&b.1));
            start = end;
        }
    }
    let mut worst = 0.0;
    for (i, (f, e)) in found.iter().zip(&expected).enumerate() {
        if f.1 != e.1 {
            return Err(format!("event {i}: found {f:?}, expected {e:?}"));
        }
        worst = larger(worst, (f.0 - e.0).abs());
    }
    if found.len() != expected.len() {
        return Err(format!("{} events, expected {}", found.len(), expected.len()));
    }
    Ok(worst)
}

#[test]
fn reference_scenes() {
    let mut failures = Vec::new();
    println!(
        "{:26} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7}",
        "scene", "drift", "slip", "peaks", "event/s", "damping", "energy", "events"
    );
    for path in reference_files("") {
        let (scene, motion, file) = read(&path);
        let result = &file["result"];
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let every = NonZeroUsize::new(result["sample_every"].as_u64().unwrap() as usize);
        let options = Options { histories: every, events: true, energy: true, ..Options::default() };
        let response = simulate(&scene, &motion, &options).unwrap();
        let residual = response.energy.unwrap().relative_residual;
        let (peak_drift, peak_slip) = (floats(&result["peak_drift"]), floats(&result["peak_slip"]));
        let matrix = scene.building().unwrap().damping_matrix();
        let damping = rows(&result["damping_matrix"]);
        let damping = worst(matrix.transpose().as_slice(), &damping, &vec![matrix.amax(); matrix.nrows()]);
        let h = response.histories.as_ref().unwrap();
        let drift = worst(&h.drift, &rows(&result["drift"]), &peak_drift);
        let slip = worst(&h.slip, &rows(&result["slip"]), &peak_slip);
        let of = |peaks: &[seismass::Peak]| peaks.iter().map(|p| p.value).collect::<Vec<_>>();
        let peaks = [
            worst(&of(&response.peaks.drift), std::slice::from_ref(&peak_drift), &peak_drift),
            worst(&of(&response.peaks.slip), std::slice::from_ref(&peak_slip), &peak_slip),
            worst(&response.residual_drift, &[floats(&result["residual_drift"])], &peak_drift),
            worst(&response.residual_slip, &[floats(&result["residual_slip"])], &peak_slip),
        ];
        let peaks = peaks.into_iter().fold(0.0, larger);
        let events = compare_events(response.events.as_ref().unwrap(), result["events"].as_array().unwrap());
        let time = events.clone().unwrap_or(f64::NAN);
        let total = response.statistics.events.total();
        println!(
            "{:26} {drift:9.1e} {slip:9.1e} {peaks:9.1e} {time:9.1e} {damping:9.1e} {residual:9.1e} {total:7}",
            name
        );
        if let Err(message) = events {
            failures.push(format!("{name}: {message}"));
        }
        if !(drift <= HISTORY && slip <= HISTORY && peaks <= PEAK && time <= EVENT_TIME && damping <= 1e-14) {
            failures.push(format!("{name}: beyond tolerance"));
        }
        if !residual.is_finite() || residual.abs() > ENERGY {
            failures.push(format!("{name}: energy residual {residual:e}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
