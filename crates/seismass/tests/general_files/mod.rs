//! Reads the reference scenes of racks, walls and stops: the JSON format of scene files, as far as they use it.

use std::path::Path;
use std::sync::Arc;

use nalgebra::DMatrix;
use seismass::{
    Block, Damping, GeneralBuilding, GeneralScene, Goods, GravityEffect, Motion, PlaneMotion, PlaneScene, Rack,
    STANDARD_GRAVITY, Stops, Storey,
};
use serde_json::Value;

use super::common::floats;

fn number(value: &Value, default: f64) -> f64 {
    value.as_f64().unwrap_or(default)
}

/// A number or a list of numbers as a list of `n`; absent: the default.
fn list(value: &Value, n: usize, default: f64) -> Vec<f64> {
    match value {
        Value::Array(_) => floats(value),
        other => vec![number(other, default); n],
    }
}

/// Springs from the keys of a building or a rack. `weight` is what strengths over the weight count from.
fn storeys(table: &Value, stiffness: &[f64], weight: f64) -> Vec<Storey> {
    let n = stiffness.len();
    let over_weight = list(&table["yield_shear_over_weight"], n, f64::INFINITY);
    let yield_shear = match table.get("yield_shear") {
        Some(value) => list(value, n, f64::INFINITY),
        None => over_weight.iter().map(|ratio| ratio * weight).collect(),
    };
    let (omega, r2, r3) = (
        list(&table["overstrength"], n, Storey::DEFAULT_OVERSTRENGTH),
        list(&table["second_slope"], n, Storey::DEFAULT_SECOND_SLOPE),
        list(&table["third_slope"], n, Storey::DEFAULT_THIRD_SLOPE),
    );
    (0..n)
        .map(|i| Storey {
            overstrength: omega[i],
            second_slope: r2[i],
            third_slope: r3[i],
            ..Storey::yielding(stiffness[i], yield_shear[i])
        })
        .collect()
}

fn building(table: &Value) -> GeneralBuilding {
    let mass = floats(&table["mass"]);
    let n = mass.len();
    let stiffness = list(&table["stiffness"], n, f64::NAN);
    let matrix = table.get("stiffness_matrix").map(|rows| {
        let entries: Vec<f64> = rows.as_array().unwrap().iter().flat_map(floats).collect();
        DMatrix::from_row_slice(n, n, &entries)
    });
    let gravity = match table.get("geometric_stiffness") {
        Some(values) => GravityEffect::GeometricStiffness(list(values, n, 0.0)),
        None => GravityEffect::None,
    };
    let springs = storeys(table, &stiffness, mass.iter().sum::<f64>() * STANDARD_GRAVITY);
    let damping = Damping::Modal { ratio: table["damping"].as_f64().unwrap() };
    GeneralBuilding::new(mass, springs, matrix, &damping, gravity).unwrap()
}

fn stops(table: &Value) -> Stops {
    let clearance = match &table["clearance"] {
        Value::Array(pair) => [pair[0].as_f64().unwrap(), pair[1].as_f64().unwrap()],
        both => [both.as_f64().unwrap(); 2],
    };
    let stiffness = table["stiffness"].as_f64().unwrap();
    Stops { clearance, stiffness, damping: number(&table["damping"], 0.0) }
}

fn goods(table: &Value, place: &str) -> Goods {
    let at = |key: &str| table[key].as_f64().unwrap();
    let block =
        Block { mu_k: at("mu_k"), ..Block::new(table[place].as_u64().unwrap() as usize, at("mass"), at("mu_s")) };
    Goods { block, stops: table.get("stops").map(stops) }
}

fn rack(table: &Value) -> Rack {
    let n = table["levels"].as_u64().unwrap() as usize;
    let mut mass = list(&table["level_mass"], n, f64::NAN);
    let (mut sliding, mut weight) = (Vec::new(), 0.0);
    for entry in table["blocks"].as_array().unwrap() {
        weight += entry["mass"].as_f64().unwrap() * STANDARD_GRAVITY;
        if entry["fixed"] == true {
            mass[entry["level"].as_u64().unwrap() as usize - 1] += entry["mass"].as_f64().unwrap();
        } else {
            sliding.push(goods(entry, "level"));
        }
    }
    weight += list(&table["level_mass"], n, f64::NAN).iter().sum::<f64>() * STANDARD_GRAVITY;
    let mut rack = Rack {
        floor: table["floor"].as_u64().unwrap() as usize,
        mass,
        levels: Vec::new(),
        damping_ratio: number(&table["damping"], Rack::DEFAULT_DAMPING_RATIO),
        geometric_stiffness: Vec::new(),
        goods: sliding,
    };
    let stiffness = Rack::uniform_stiffness(&rack.mass_with_goods(), table["period"].as_f64().unwrap()).unwrap();
    rack.levels = storeys(table, &vec![stiffness; n], weight);
    rack
}

/// The result that belongs to a scene file.
pub fn read_result(path: &Path) -> Value {
    let result = path.with_file_name("results").join(path.file_name().unwrap());
    serde_json::from_str(&std::fs::read_to_string(result).unwrap()).unwrap()
}

/// A table with the keys of another put in.
fn with(table: &Value, other: &Value) -> Value {
    let mut all = table.clone();
    for (key, value) in other.as_object().into_iter().flatten() {
        all[key] = value.clone();
    }
    all
}

/// A table as it is in y.
fn in_y(table: &Value, other: &Value) -> Value {
    let mut table = with(table, other);
    match table.as_object_mut().unwrap().remove("stops_y") {
        Some(stops) => table["stops"] = stops,
        None => _ = table.as_object_mut().unwrap().remove("stops"),
    }
    table
}

fn samples(table: &Value) -> Vec<f64> {
    assert_eq!(table["unit"], "m/s2");
    let scale = number(&table["scale"], 1.0);
    floats(&table["acceleration"]).iter().map(|a| a * scale).collect()
}

fn scene(file: &Value, building_table: &Value, is_y: bool) -> GeneralScene {
    let each = |key: &str| file[key].as_array().cloned().unwrap_or_default();
    let table = |table: &Value| if is_y { in_y(table, &Value::Null) } else { table.clone() };
    let on_floors = each("blocks").iter().map(|entry| goods(&table(entry), "floor")).collect();
    let rack_of = |entry: &Value| {
        let mut of_rack = if is_y { with(entry, &entry["other_direction"]) } else { entry.clone() };
        let blocks: Vec<Value> = entry["blocks"].as_array().unwrap().iter().map(table).collect();
        of_rack["blocks"] = blocks.into();
        rack(&of_rack)
    };
    let racks = each("racks").iter().map(rack_of).collect();
    GeneralScene::new(Some(Arc::new(building(building_table))), on_floors, racks).unwrap()
}

/// Scene and motion of a file in one direction.
pub fn read_general(path: &Path) -> (GeneralScene, Motion) {
    let file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let motion = &file["motion"];
    let scene = scene(&file, &file["building"], false);
    (scene, Motion::new(samples(motion), motion["dt"].as_f64().unwrap(), None).unwrap())
}

/// Scene and motion of a file in two directions.
pub fn read_plane(path: &Path) -> (PlaneScene, PlaneMotion) {
    let file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let y = scene(&file, &with(&file["building"], &file["other_direction"]), true);
    let scene = PlaneScene::new(scene(&file, &file["building"], false), y).unwrap();
    let (x, y) = (samples(&file["motion"]), samples(&file["other_motion"]));
    let vertical = file.get("vertical_motion").map(|table| samples(table).into());
    let motion = Motion::new(x, file["motion"]["dt"].as_f64().unwrap(), vertical).unwrap();
    (scene, PlaneMotion::new(motion, y).unwrap())
}
