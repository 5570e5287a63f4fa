//! Reads the reference scenes: the JSON format of scene files, as far as the references use it.

use std::path::Path;
use std::sync::Arc;

use nalgebra::DMatrix;
use seismass::{Block, Building, Damping, Event, EventKind, GravityEffect, Motion, STANDARD_GRAVITY, Scene, Storey};
use serde_json::Value;

/// A number, null for infinity.
fn number(value: &Value) -> f64 {
    if value.is_null() { f64::INFINITY } else { value.as_f64().unwrap() }
}

/// A list of numbers.
pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

/// A table of numbers, row after row.
pub fn table(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().flat_map(numbers).collect()
}

/// One number for all of `n`, or one each.
fn each(value: &Value, n: usize) -> Vec<f64> {
    if value.is_array() { numbers(value) } else { vec![number(value); n] }
}

/// Values (g) and time step (s) of an AT2 file: four header lines, the last with DT.
fn read_at2(path: &Path) -> (Vec<f64>, f64) {
    let text = std::fs::read_to_string(path).unwrap();
    let header = text.lines().nth(3).unwrap();
    let after = header.split("DT=").nth(1).unwrap().trim_start();
    let dt: String = after.chars().take_while(|c| c.is_ascii_digit() || ".eE+-".contains(*c)).collect();
    let values = text.lines().skip(4).flat_map(str::split_whitespace).map(|word| word.parse().unwrap());
    (values.collect(), dt.trim_end_matches(['E', 'e']).parse().unwrap())
}

/// Samples (m/s2) and time step (s) of a motion.
fn samples(motion: &Value, folder: &Path) -> (Vec<f64>, f64) {
    let (values, dt) = match motion["file"].as_str() {
        Some(file) => read_at2(&folder.join(file)),
        None => (numbers(&motion["acceleration"]), number(&motion["dt"])),
    };
    let unit = match motion["unit"].as_str() {
        Some("g") => STANDARD_GRAVITY,
        _ => 1.0,
    };
    let factor = unit * motion["scale"].as_f64().unwrap_or(1.0);
    (values.iter().map(|v| v * factor).collect(), dt * motion["dt_scale"].as_f64().unwrap_or(1.0))
}

fn damping(value: &Value, n: usize) -> Damping {
    match value["kind"].as_str().unwrap() {
        "modal" => Damping::Modal { ratio: number(&value["ratio"]) },
        "rayleigh" => {
            let modes = numbers(&value["modes"]);
            Damping::Rayleigh { ratio: number(&value["ratio"]), modes: [modes[0] as usize, modes[1] as usize] }
        }
        kind => {
            assert_eq!(kind, "matrix");
            Damping::Matrix(DMatrix::from_row_slice(n, n, &table(&value["matrix"])))
        }
    }
}

/// Scene, motion and the reference result.
pub fn read_reference(path: &Path) -> (Scene, Motion, Value) {
    let mut file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let b = &file["building"];
    let mass = numbers(&b["mass"]);
    let n = mass.len();
    let column = |key: &str| each(&b[key], n);
    let (k, vy, omega) = (column("stiffness"), column("yield_shear"), column("overstrength"));
    let (r2, r3) = (column("second_slope"), column("third_slope"));
    let storey = |i: usize| Storey {
        overstrength: omega[i],
        second_slope: r2[i],
        third_slope: r3[i],
        ..Storey::yielding(k[i], vy[i])
    };
    let mut building = Building::new(mass, (0..n).map(storey).collect(), damping(&b["damping"], n)).unwrap();
    if !b["geometric_stiffness"].is_null() {
        let geometric = each(&b["geometric_stiffness"], n);
        building = building.with_gravity(GravityEffect::GeometricStiffness(geometric)).unwrap();
    }
    let block = |value: &Value| Block {
        mu_k: number(&value["mu_k"]),
        ..Block::new(value["floor"].as_u64().unwrap() as usize, number(&value["mass"]), number(&value["mu_s"]))
    };
    let blocks = file["blocks"].as_array().unwrap().iter().map(block).collect();
    let scene = Scene::new(Some(Arc::new(building)), blocks).unwrap();
    let folder = path.parent().unwrap();
    let (mut acceleration, dt) = samples(&file["motion"], folder);
    let vertical = (!file["vertical_motion"].is_null()).then(|| {
        let mut vertical = samples(&file["vertical_motion"], folder).0;
        let length = vertical.len().min(acceleration.len());
        vertical.truncate(length);
        acceleration.truncate(length);
        Arc::from(vertical)
    });
    (scene, Motion::new(acceleration, dt, vertical).unwrap(), file["result"].take())
}

/// The event log of a reference result.
pub fn read_events(result: &Value) -> Vec<Event> {
    let kind = |name: &str| *EventKind::ALL.iter().find(|kind| kind.name() == name).unwrap();
    let event = |e: &Value| Event {
        time: number(&e["time"]),
        kind: kind(e["kind"].as_str().unwrap()),
        number: e["number"].as_u64().unwrap() as usize,
        sign: e["sign"].as_i64().unwrap() as i8,
        element: e["element"].as_u64().unwrap_or(0) as u8,
    };
    result["events"].as_array().unwrap().iter().map(event).collect()
}
