//! Reads the reference scenes: the JSON format of scene files, as far as the references use it.

use std::path::Path;
use std::sync::Arc;

use nalgebra::DMatrix;
use seismass::{Block, Building, Damping, GravityEffect, Motion, STANDARD_GRAVITY, Scene, Storey};
use serde_json::Value;

/// A number, or a list of numbers with null for infinity, as a list of `n`.
fn list(value: &Value, n: usize) -> Vec<f64> {
    let number = |v: &Value| v.as_f64().unwrap_or(f64::INFINITY);
    match value {
        Value::Array(values) => values.iter().map(number).collect(),
        other => vec![number(other); n],
    }
}

pub fn floats(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

fn at2(path: &Path) -> (Vec<f64>, f64) {
    let text = std::fs::read_to_string(path).unwrap();
    let header = text.lines().nth(3).unwrap().to_uppercase();
    let dt = header.split("DT=").nth(1).unwrap().split_whitespace().next().unwrap().trim_end_matches("SEC");
    let values = text.lines().skip(4).flat_map(str::split_whitespace).map(|t| t.parse().unwrap()).collect();
    (values, dt.parse().unwrap())
}

fn samples(spec: &Value, folder: &Path) -> (Vec<f64>, f64) {
    let (values, dt) = match spec.get("file") {
        Some(file) => at2(&folder.join(file.as_str().unwrap())),
        None => (floats(&spec["acceleration"]), spec["dt"].as_f64().unwrap()),
    };
    let unit = if spec["unit"] == "g" { STANDARD_GRAVITY } else { 1.0 };
    let scale = unit * spec.get("scale").map_or(1.0, |s| s.as_f64().unwrap());
    let dt = dt * spec.get("dt_scale").map_or(1.0, |s| s.as_f64().unwrap());
    (values.iter().map(|a| a * scale).collect(), dt)
}

/// Scene, motion, and the whole file.
pub fn read(path: &Path) -> (Scene, Motion, Value) {
    let file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let b = &file["building"];
    let mass = floats(&b["mass"]);
    let n = mass.len();
    let get = |key: &str| list(&b[key], n);
    let (k, vy, omega, r2, r3) =
        (get("stiffness"), get("yield_shear"), get("overstrength"), get("second_slope"), get("third_slope"));
    let storeys = (0..n)
        .map(|i| Storey {
            overstrength: omega[i],
            second_slope: r2[i],
            third_slope: r3[i],
            ..Storey::yielding(k[i], vy[i])
        })
        .collect();
    let d = &b["damping"];
    let damping = match d["kind"].as_str().unwrap() {
        "modal" => Damping::Modal { ratio: d["ratio"].as_f64().unwrap() },
        "rayleigh" => Damping::Rayleigh {
            ratio: d["ratio"].as_f64().unwrap(),
            modes: [0, 1].map(|i| d["modes"][i].as_u64().unwrap() as usize),
        },
        _ => {
            let rows: Vec<f64> = d["matrix"].as_array().unwrap().iter().flat_map(floats).collect();
            Damping::Matrix(DMatrix::from_row_slice(n, n, &rows))
        }
    };
    let mut building = Building::new(mass, storeys, damping).unwrap();
    if let Some(p) = b.get("geometric_stiffness") {
        building = building.with_gravity(GravityEffect::GeometricStiffness(list(p, n))).unwrap();
    }
    let blocks = file["blocks"]
        .as_array()
        .unwrap()
        .iter()
        .map(|b| Block {
            mu_k: b["mu_k"].as_f64().unwrap(),
            ..Block::new(
                b["floor"].as_u64().unwrap() as usize,
                b["mass"].as_f64().unwrap(),
                b["mu_s"].as_f64().unwrap(),
            )
        })
        .collect();
    let folder = path.parent().unwrap();
    let (mut acceleration, dt) = samples(&file["motion"], folder);
    let vertical = file.get("vertical_motion").map(|v| {
        let (mut vertical, _) = samples(v, folder);
        let length = vertical.len().min(acceleration.len());
        vertical.truncate(length);
        acceleration.truncate(length);
        Arc::from(vertical)
    });
    let scene = Scene::new(Some(Arc::new(building)), blocks).unwrap();
    (scene, Motion::new(acceleration, dt, vertical).unwrap(), file)
}
