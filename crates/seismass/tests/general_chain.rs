//! The general engine on shear buildings, where it must equal the chain engine.

#![allow(clippy::unwrap_used)]

mod common;
mod fixture;
mod general_compare;
mod maximum;
mod references;

use std::num::NonZeroUsize;
use std::sync::Arc;

use common::read;
use fixture::{Parts, motion};
use general_compare::{ENERGY, EVENT_TIME, Entry, OPTIONS, PEAK, compare_events, deviation, events, values};
use maximum::larger;
use references::reference_files;
use seismass::{
    Block, Building, Damping, Energy, GeneralEnergy, GeneralPeaks, GeneralResponse, GeneralScene, GeneralStatus,
    Histories, Motion, Options, Peak, Peaks, Response, Scene, Status, Storey, simulate, simulate_general,
};

fn logged(chain: &Response) -> Vec<Entry> {
    let logged = chain.events.as_ref().unwrap().iter();
    logged.map(|e| (e.time, format!("{} {} {} {}", e.kind.name(), e.number, e.sign, e.element))).collect()
}

#[test]
fn shear_buildings_equal_the_chain_engine() {
    let mut failures = Vec::new();
    for path in reference_files("") {
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
        let of_events = compare_events(events(&general), logged(&chain));
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

/// So many storeys of unequal numbers that yield, with a block on every other floor.
fn tall(storeys: usize, damping: Damping) -> Scene {
    let part = |i: usize| i as f64 / storeys as f64;
    let mass = (0..storeys).map(|i| 1130.0 - 317.0 * part(i) + 13.7 * (i % 3) as f64).collect();
    let spring = |i: usize| Storey {
        overstrength: 1.47 + 0.31 * part(i),
        second_slope: 0.313 - 0.107 * part(i),
        third_slope: 0.0193,
        ..Storey::yielding(
            4.37e5 * (1.3 - part(i)) * storeys as f64 / 3.0,
            2170.0 * (1.3 - part(i)) * (storeys as f64).sqrt(),
        )
    };
    let building = Building::new(mass, (0..storeys).map(spring).collect(), damping).unwrap();
    let block = |i: usize| Block { mu_k: 0.149 + 0.031 * part(i), ..Block::new(i + 1, 431.0 + 97.0 * part(i), 0.197) };
    Scene::new(Some(Arc::new(building)), (0..storeys).step_by(2).map(block).collect()).unwrap()
}

/// How many fields a struct has, as `Debug` prints it.
fn fields(value: &impl std::fmt::Debug) -> usize {
    format!("{value:#?}")
        .lines()
        .filter(|line| line.starts_with("    ") && !line[4..].starts_with([' ', '}', ']', ')']))
        .count()
}

/// All that both engines give back, each quantity with the other's.
fn assert_equal(name: &str, scene: &Scene, motion: &Motion) {
    let options = Options { histories: NonZeroUsize::new(1), ..OPTIONS };
    let chain = simulate(scene, motion, &options).unwrap();
    let general = simulate_general(&GeneralScene::from(scene), motion, &options).unwrap();
    assert!(compare_events(events(&general), logged(&chain)).unwrap() < EVENT_TIME, "{name}");
    // The names of both lists below: a field that is added is to be compared too.
    assert_eq!((fields(&chain), fields(&general)), (11, 13));
    let Response {
        status,
        end_time,
        peaks,
        residual_drift,
        residual_slip,
        slip_path,
        floor_force: _, // the general engine has none
        events: _,
        histories,
        energy,
        statistics,
        ..
    } = chain;
    let GeneralResponse {
        storeys,
        levels,
        status: found_status,
        end_time: found_end,
        peaks: found_peaks,
        residual_drift: found_drift,
        residual_slip: found_slip,
        slip_path: found_path,
        base,
        events: _,
        histories: found_histories,
        energy: found_energy,
        statistics: found_statistics,
        ..
    } = general;
    assert_eq!((storeys, levels.len(), base), (scene.storeys(), 0, None));
    assert_eq!(found_statistics.events, statistics.events);
    match (found_status, status) {
        (GeneralStatus::Completed, Status::Completed) => {}
        (GeneralStatus::Collapsed { number, time }, Status::Collapsed { storey, time: expected }) => {
            assert!(number == storey && (time - expected).abs() < EVENT_TIME);
        }
        other => panic!("{name}: {other:?}"),
    }
    assert!((found_end - end_time).abs() < EVENT_TIME);
    let Peaks { drift, slip, floor_acceleration, storey_shear } = peaks;
    let GeneralPeaks {
        drift: of_drift,
        acceleration,
        shear,
        base_shear,
        slip: of_slip,
        contact_force,
        contact_velocity,
    } = found_peaks;
    assert!(contact_force.iter().chain(&contact_velocity).all(|peak| peak.value == 0.0));
    let times = |peaks: &[Peak]| peaks.iter().map(|peak| peak.time).collect::<Vec<_>>();
    for (what, found, expected) in [
        ("drift", &of_drift, &drift),
        ("acceleration", &acceleration, &floor_acceleration),
        ("shear", &shear, &storey_shear),
        ("base shear", &vec![base_shear], &vec![storey_shear[0]]),
        ("slip", &of_slip, &slip),
    ] {
        assert!(deviation(&values(found), &values(expected)) < PEAK, "{name}, {what}: {found:?} for {expected:?}");
        // A flat top is known to the root of rounding.
        assert!(deviation(&times(found), &times(expected)) < 1e-6, "{name}, {what}: {found:?} for {expected:?}");
    }
    assert!(deviation(&found_drift, &residual_drift) < PEAK);
    assert!(deviation(&found_slip, &residual_slip) < PEAK);
    // Of the general engine it is the path in contact.
    assert!(motion.vertical().is_some() || deviation(&found_path, &slip_path) < PEAK);
    let [found, expected] = [found_histories, histories].map(|histories| {
        let histories = histories.unwrap();
        let Histories { every, rows, drift, slip, floor_velocity, block_velocity, floor_acceleration, storey_force } =
            histories;
        ((every, rows), [drift, slip, floor_velocity, block_velocity, floor_acceleration, storey_force])
    });
    assert_eq!(found.0, expected.0);
    for (which, (found, expected)) in found.1.iter().zip(&expected.1).enumerate() {
        // After a collapse there are no numbers.
        let reached = |values: &[f64]| values.iter().copied().take_while(|value| !value.is_nan()).collect::<Vec<_>>();
        assert!(deviation(&reached(found), &reached(expected)) < PEAK, "{name}, history {which}");
    }
    let Energy { initial, input, kinetic, elastic, viscous, hysteretic, friction, relative_residual } = energy.unwrap();
    let found = found_energy.unwrap();
    let of_general = GeneralEnergy {
        initial,
        input,
        kinetic,
        elastic,
        viscous,
        hysteretic,
        friction,
        contact: 0.0,
        relative_residual: found.relative_residual,
    };
    let list =
        |e: GeneralEnergy| [e.initial, e.input, e.kinetic, e.elastic, e.viscous, e.hysteretic, e.friction, e.contact];
    assert!(deviation(&list(found), &list(of_general)) < ENERGY, "{name}: {found:?} for {of_general:?}");
    assert!(relative_residual.abs() < ENERGY && found.relative_residual.abs() < ENERGY, "{name}");
}

#[test]
fn every_quantity_is_that_of_the_chain_engine() {
    let both = motion();
    let horizontal = Motion::new(both.acceleration(), both.dt(), None).unwrap();
    let scene = Parts::new().scene();
    assert_equal("three storeys", &scene, &horizontal);
    assert_equal("three storeys under both components", &scene, &both);
    let collapse_drift = Some(vec![0.0191, 0.0161, 0.0137]);
    assert_equal("a collapse", &Parts { collapse_drift, ..Parts::new() }.scene(), &horizontal);
    for storeys in [1, 6, 20] {
        let modal = Damping::Modal { ratio: 0.0413 };
        assert_equal(&format!("{storeys} storeys"), &tall(storeys, modal), &horizontal);
    }
    let rayleigh = Damping::Rayleigh { ratio: 0.0413, modes: [1, 3] };
    assert_equal("24 storeys, Rayleigh damping", &tall(24, rayleigh), &both);
}
