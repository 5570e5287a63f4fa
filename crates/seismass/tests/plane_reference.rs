//! The general engine on scenes in two horizontal directions, solved by an independent 64-bit-mantissa solver.

#![allow(clippy::unwrap_used)]

#[allow(dead_code)] // Its reader is that of shear buildings.
mod common;
#[allow(dead_code)] // Logs of one direction are compared elsewhere.
mod general_compare;
#[allow(dead_code)] // Scenes in one direction are read elsewhere.
mod general_files;
mod maximum;
mod references;

use general_compare::{ENERGY, EVENT_TIME, OPTIONS, PEAK, compare_events, deviation, values};
use general_files::{read_plane, read_result};
use maximum::larger;
use references::reference_files;
use seismass::{Axis, EventKind, Peak, PlaneEvent, simulate_plane};
use serde_json::Value;

/// Angles at which blocks begin to slide agree to this (rad). Those of stops are printed alone: they are of a velocity that
/// vanishes and turns as a power of its size until then, so that they depend on when it counts as none.
const ANGLE: f64 = 1e-11;

/// Numbers of lists of [x, y, vector], or of one of these, one after the other.
fn numbers(result: &Value, keys: &[&str], which: usize) -> Vec<f64> {
    let lists = keys.iter().flat_map(|key| result[*key].as_array().into_iter().flatten());
    lists.map(|value| if value.is_array() { value[which].as_f64().unwrap() } else { value.as_f64().unwrap() }).collect()
}

fn entry(PlaneEvent { event, axis, .. }: &PlaneEvent) -> (f64, String) {
    let e = event.event;
    let kind = match e.kind {
        EventKind::TouchStop => "contact",
        EventKind::LeaveStop => "leave",
        kind => kind.name(),
    };
    let direction = match axis {
        Some(Axis::X) => "x",
        Some(Axis::Y) => "y",
        None => "circle",
    };
    (e.time, format!("{kind} {} {} {} {direction}", e.number, e.sign, e.element))
}

fn is_of_circle(kind: &str) -> bool {
    matches!(kind, "slip" | "stick" | "reverse" | "wear" | "lift" | "land")
}

fn expected(e: &Value) -> (f64, String) {
    let kind = e["kind"].as_str().unwrap();
    let element = e.get("element").map_or(0, |v| v.as_i64().unwrap());
    let (sign, direction) = if is_of_circle(kind) {
        ("0".to_owned(), "circle")
    } else {
        (e["sign"].to_string(), e["direction"].as_str().unwrap())
    };
    (e["time"].as_f64().unwrap(), format!("{kind} {} {sign} {element} {direction}", e["number"]))
}

/// Largest difference of the angles of slips, block by block in the order of their events.
fn angles_apart(found: &[PlaneEvent], expected: &Value) -> f64 {
    let mut worst = 0.0;
    let of_block = |number: usize| {
        let events = expected.as_array().unwrap().iter();
        let events = events.filter(move |e| e["kind"] == "slip" && e["number"] == number);
        events.map(|e| e["sign"].as_f64().unwrap()).collect::<Vec<f64>>()
    };
    for number in 1..20 {
        let angles = found.iter().filter(|e| e.event.event.kind == EventKind::Slip && e.event.event.number == number);
        for (angle, expected) in angles.map(|e| e.angle).zip(of_block(number)) {
            worst = larger(worst, (0.5 * (angle - expected)).sin().abs());
        }
    }
    2.0 * worst
}

#[test]
fn two_directions() {
    let mut failures = Vec::new();
    println!(
        "{:16} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7}",
        "scene", "peaks", "at end", "event/s", "angle", "energy", "events"
    );
    for path in reference_files("general") {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        if !name.contains("plane") {
            continue;
        }
        let (scene, motion) = read_plane(&path);
        let result = read_result(&path);
        let response = simulate_plane(&scene, &motion, &OPTIONS).unwrap();
        let (peaks, vector) = (&response.peaks, &response.peaks.vector);
        let mut of_peaks = Vec::new();
        let mut compare = |keys: &[&str], found: [&Vec<Peak>; 3]| {
            for (which, found) in found.into_iter().enumerate() {
                of_peaks.push(deviation(&values(found), &numbers(&result, keys, which)));
            }
        };
        let [x, y] = &peaks.directions;
        compare(&["peak_drift", "peak_rack_drift"], [&x.drift, &y.drift, &vector.drift]);
        compare(&["peak_shear", "peak_rack_shear"], [&x.shear, &y.shear, &vector.shear]);
        let of_acceleration = [&x.acceleration, &y.acceleration, &vector.acceleration];
        compare(&["peak_acceleration", "peak_rack_acceleration"], of_acceleration);
        compare(&["peak_slip"], [&x.slip, &y.slip, &vector.slip]);
        let base = [x.base_shear, y.base_shear, vector.base_shear].map(|peak| peak.value);
        of_peaks.push(deviation(&base, &numbers(&result, &["peak_base_shear"], 0)));
        of_peaks.push(deviation(&response.slip_path, &numbers(&result, &["path"], 0)));
        let mut at_end = 0.0;
        for a in 0..2 {
            if result.get("peak_contact_force").is_some() {
                let force = values(&peaks.directions[a].contact_force);
                of_peaks.push(deviation(&force, &numbers(&result, &["peak_contact_force"], a)));
            }
            let drift: Vec<f64> = response.residual_drift.iter().map(|pair| pair[a]).collect();
            let slip: Vec<f64> = response.residual_slip.iter().map(|pair| pair[a]).collect();
            let of_drift = deviation(&drift, &numbers(&result, &["residual_drift", "residual_rack_drift"], a));
            at_end = larger(at_end, larger(of_drift, deviation(&slip, &numbers(&result, &["residual_slip"], a))));
        }
        let log = response.events.as_ref().unwrap();
        let logged = result["events"].as_array().unwrap().iter().map(expected).collect();
        let of_events = compare_events(log.iter().map(entry).collect(), logged);
        let energy = response.energy.unwrap();
        for (found, key) in [
            (energy.total.input, "input"),
            (energy.total.kinetic, "kinetic"),
            (energy.total.elastic, "elastic"),
            (energy.total.viscous, "viscous"),
            (energy.total.hysteretic, "hysteretic"),
            (energy.total.friction, "friction"),
            (energy.total.contact, "contact"),
        ] {
            of_peaks.push((found - result["energy"][key].as_f64().unwrap()).abs() / energy.total.input);
        }
        let residuals = energy.directions.iter().chain([&energy.total]).map(|e| e.relative_residual.abs());
        let residual = residuals.fold(0.0, larger);
        let worst = of_peaks.iter().copied().fold(0.0, larger);
        let time = of_events.clone().unwrap_or(f64::NAN);
        let angle = angles_apart(log, &result["events"]);
        assert!(log.iter().all(|e| e.angle.is_nan() == (e.axis.is_some() || e.event.event.kind == EventKind::Stick)));
        let count = response.statistics.events.total();
        println!(
            "{name:16} {worst:9.1e} {at_end:9.1e} {time:9.1e} {angle:9.1e} {residual:9.1e} {count:7} {}",
            response.statistics.series_steps
        );
        if let Err(message) = of_events {
            failures.push(format!("{name}: {message}"));
        }
        if !(worst <= PEAK && at_end <= PEAK && time <= EVENT_TIME && angle <= ANGLE && residual <= ENERGY) {
            failures.push(format!("{name}: {of_peaks:?} {at_end:e}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
