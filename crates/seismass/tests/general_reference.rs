//! The general engine on scenes with racks, walls and stops, solved by an independent 64-bit-mantissa solver.

#![allow(clippy::unwrap_used)]

#[allow(dead_code)] // Its reader is that of shear buildings.
mod common;
mod general_compare;
#[allow(dead_code)] // Scenes in two directions are read elsewhere.
mod general_files;
mod maximum;
mod references;

use common::floats;
use general_compare::{ENERGY, EVENT_TIME, OPTIONS, PEAK, compare_events, deviation, events, values};
use general_files::{read_general, read_result};
use maximum::larger;
use references::reference_files;
use seismass::simulate_general;
use serde_json::Value;

/// The first numbers of lists of lists, one for each storey and then for each rack level.
fn of_nodes(result: &Value, floors: &str, racks: &str) -> Vec<f64> {
    let first = |value: &Value| value[0].as_f64().unwrap();
    let lists = [floors, racks].into_iter().flat_map(|key| result[key].as_array().into_iter().flatten());
    lists.map(first).collect()
}

#[test]
fn racks_walls_and_stops() {
    let mut failures = Vec::new();
    println!("{:20} {:>9} {:>9} {:>9} {:>9} {:>7}", "scene", "peaks", "at end", "event/s", "energy", "events");
    for path in reference_files("general") {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        if name.contains("plane") {
            continue;
        }
        let (scene, motion) = read_general(&path);
        let result = read_result(&path);
        let response = simulate_general(&scene, &motion, &OPTIONS).unwrap();
        let peaks = &response.peaks;
        let of_goods = |key: &str| -> Vec<f64> {
            result[key]
                .as_array()
                .unwrap()
                .iter()
                .map(|v| v.as_f64().unwrap_or_else(|| v[0].as_f64().unwrap()))
                .collect()
        };
        let mut of_peaks = vec![
            deviation(&values(&peaks.drift), &of_nodes(&result, "peak_drift", "peak_rack_drift")),
            deviation(&values(&peaks.shear), &of_nodes(&result, "peak_shear", "peak_rack_shear")),
            deviation(&values(&peaks.acceleration), &of_nodes(&result, "peak_acceleration", "peak_rack_acceleration")),
            deviation(&[peaks.base_shear.value], &floats(&result["peak_base_shear"])),
            deviation(&values(&peaks.slip), &of_goods("peak_slip")),
            deviation(&response.slip_path, &of_goods("path")),
        ];
        if result.get("peak_contact_force").is_some() {
            of_peaks.push(deviation(&values(&peaks.contact_force), &of_goods("peak_contact_force")));
        }
        let at_end = larger(
            deviation(&response.residual_drift, &of_nodes(&result, "residual_drift", "residual_rack_drift")),
            deviation(&response.residual_slip, &of_goods("residual_slip")),
        );
        let expected = result["events"].as_array().unwrap().iter().map(|e| {
            let element = e.get("element").map_or(0, |v| v.as_i64().unwrap());
            let entry = format!("{} {} {} {element}", e["kind"].as_str().unwrap(), e["number"], e["sign"]);
            (e["time"].as_f64().unwrap(), entry)
        });
        let of_events = compare_events(events(&response), expected.collect());
        let energy = response.energy.unwrap();
        for (found, key) in [
            (energy.input, "input"),
            (energy.elastic, "elastic"),
            (energy.viscous, "viscous"),
            (energy.hysteretic, "hysteretic"),
            (energy.friction, "friction"),
            (energy.contact, "contact"),
        ] {
            of_peaks.push((found - result["energy"][key].as_f64().unwrap()).abs() / energy.input);
        }
        let worst = of_peaks.iter().copied().fold(0.0, larger);
        let time = of_events.clone().unwrap_or(f64::NAN);
        let (residual, count) = (energy.relative_residual, response.statistics.events.total());
        println!("{name:20} {worst:9.1e} {at_end:9.1e} {time:9.1e} {residual:9.1e} {count:7}");
        if let Err(message) = of_events {
            failures.push(format!("{name}: {message}"));
        }
        if !(worst <= PEAK && at_end <= PEAK && time <= EVENT_TIME && residual.abs() <= ENERGY) {
            failures.push(format!("{name}: {of_peaks:?} {at_end:e}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
