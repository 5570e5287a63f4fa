//! The general engine on shear buildings, where it must equal the chain engine.

#![allow(clippy::unwrap_used)]

mod common;
mod general_compare;
mod maximum;

use std::path::{Path, PathBuf};

use common::{read, shared};
use general_compare::{ENERGY, EVENT_TIME, OPTIONS, PEAK, compare_events, deviation, events, values};
use maximum::larger;
use seismass::{GeneralScene, simulate, simulate_general};

fn files(folder: &Path) -> Vec<PathBuf> {
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = paths.filter(|path| path.extension().is_some_and(|e| e == "json")).collect();
    files.sort();
    assert!(!files.is_empty());
    files
}

#[test]
fn shear_buildings_equal_the_chain_engine() {
    let Some(shared) = shared() else { return };
    let mut failures = Vec::new();
    for path in files(&shared.join("reference")) {
        let (scene, motion, _) = read(&path);
        let chain = simulate(&scene, &motion, &OPTIONS).unwrap();
        let general = simulate_general(&GeneralScene::from(&scene), &motion, &OPTIONS).unwrap();
        let peaks = [
            deviation(&values(&general.peaks.drift), &values(&chain.peaks.drift)),
            deviation(&values(&general.peaks.slip), &values(&chain.peaks.slip)),
            deviation(&values(&general.peaks.acceleration), &values(&chain.peaks.floor_acceleration)),
            deviation(&values(&general.peaks.shear), &values(&chain.peaks.storey_shear)),
            deviation(&general.residual_drift, &chain.residual_drift),
            deviation(&general.residual_slip, &chain.residual_slip),
        ];
        let logged = chain.events.as_ref().unwrap().iter();
        let expected =
            logged.map(|e| (e.time, format!("{} {} {} {}", e.kind.name(), e.number, e.sign, e.element))).collect();
        let of_events = compare_events(events(&general), expected);
        let worst = peaks.into_iter().fold(0.0, larger);
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let (time, residual) = (of_events.clone().unwrap_or(f64::NAN), general.energy.unwrap().relative_residual);
        println!("{name:26} {worst:9.1e} {time:9.1e} {residual:9.1e} {:7}", general.statistics.events.total());
        if let Err(message) = of_events {
            failures.push(format!("{name}: {message}"));
        }
        if !(worst <= PEAK && time <= EVENT_TIME && residual.abs() <= ENERGY) {
            failures.push(format!("{name}: {peaks:?}, times {time:e}"));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
