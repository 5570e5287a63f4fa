//! Long runs: residual drift far beyond the elastic drift, decades of records, an hour of shaking.

use seismass::{Block, Options, STANDARD_GRAVITY, Scene, Storey, UniformBuilding, simulate};

use super::{
    Case, Outcome, building, checked, judged, largest, motion, on_ground, oscillator, record, require, residual,
    standing, text,
};
use crate::DoubleDouble;

const THEME: &str = "long";

pub(super) const CASES: &[Case] = &[
    Case {
        theme: THEME,
        name: "residual drift far larger than the elastic drift",
        expectation: "more than 1e4 yield drifts to one side; events of the judge, numbers to 1e-9",
        run: ratchet,
    },
    Case {
        theme: THEME,
        name: "ten records in one run",
        expectation: "energy residual below 1e-11; events of the judge, numbers to 1e-9",
        run: ten_records,
    },
    Case {
        theme: THEME,
        name: "a decade of records in one run: one a month, 120 in all, 80 min",
        expectation: "energy residual below 1e-10; drift and slip at rest at the end",
        run: decade,
    },
    Case {
        theme: THEME,
        name: "a block must not creep: one hour at 200 Hz up to 0.999999 mu g, on the ground and on a floor",
        expectation: "no event, slip and slip path exactly 0",
        run: no_creep,
    },
    Case {
        theme: THEME,
        name: "one hour at 200 Hz, yielding and sliding, with vertical motion",
        expectation: "energy residual below 1e-10",
        run: one_hour,
    },
];

fn ratchet() -> Outcome {
    let (stiffness, strength) = (150.0, 0.02);
    let storey = Storey { second_slope: 0.0, ..Storey::yielding(stiffness, strength) };
    let scene = standing(building(vec![1.0], vec![storey], 0.02)?, vec![Block::new(1, 0.5, 0.3)])?;
    // Pushed to one side by pulses, with shaking on top.
    let shaking = record(51, 3000, 0.01, 2.0);
    let samples = shaking.iter().enumerate().map(|(i, a)| a - if i % 500 < 60 { 1.0 } else { 0.0 }).collect();
    let motion = motion(samples, 0.01)?;
    let response = checked(&scene, &motion)?;
    let ratio = response.residual_drift[0].abs() / (strength / stiffness);
    require(ratio > 1e4, || format!("only {ratio:.0} yield drifts"))?;
    let worst = judged::<DoubleDouble>(&scene, &motion, &response, 1e-9)?;
    let events = response.statistics.events.total();
    Ok(format!("{ratio:.0} yield drifts, {events} events, residual {:.0e}, judge {worst:.0e}", residual(&response)))
}

fn frame() -> Result<Scene, String> {
    let uniform = text(UniformBuilding { storeys: 3, period: 0.6, mass: 1.0, ..Default::default() }.build())?;
    let springs = uniform.storeys().iter().zip([0.24, 0.20, 0.12]);
    let springs = springs.map(|(s, v)| Storey::yielding(s.stiffness, 3.0 * v * STANDARD_GRAVITY)).collect();
    standing(text(uniform.with_storeys(springs))?, (1..=3).map(|i| Block::new(i, 1.0, 0.3)).collect())
}

/// Records of 20 s, each followed by as long a silence.
fn records(number: u64, dt: f64) -> Vec<f64> {
    let samples = (20.0 / dt) as usize;
    (0..number).flat_map(|i| [record(60 + i, samples, dt, 7.0), vec![0.0; samples]].concat()).collect()
}

fn ten_records() -> Outcome {
    let (scene, motion) = (frame()?, motion(records(10, 0.02), 0.02)?);
    let response = checked(&scene, &motion)?;
    let worst = judged::<f64>(&scene, &motion, &response, 1e-9)?;
    let events = response.statistics.events.total();
    Ok(format!("{events} events, residual {:.0e}, judge (double) {worst:.0e}", residual(&response)))
}

fn decade() -> Outcome {
    let options = Options { energy: true, ..Options::default() };
    let response = text(simulate(&frame()?, &motion(records(120, 0.01), 0.01)?, &options))?;
    let residual = residual(&response);
    require(residual < 1e-10, || format!("energy residual {residual:.1e}"))?;
    let kinetic = response.energy.map_or(f64::NAN, |e| e.kinetic / e.input);
    require(kinetic < 1e-9, || format!("kinetic energy left: {kinetic:.1e} of the input"))?;
    let events = response.statistics.events.total();
    Ok(format!("{} intervals, {events} events, residual {residual:.0e}", response.statistics.intervals))
}

const HOUR: usize = 720_001;

fn no_creep() -> Outcome {
    let dt = 0.005;
    let samples = record(71, HOUR, dt, 0.999_999 * 0.3 * STANDARD_GRAVITY);
    let motion = motion(samples, dt)?;
    let options = Options::default();
    let still = |scene: &Scene, what: &str| {
        let response = text(simulate(scene, &motion, &options))?;
        let slipped = response.slip_path[0] != 0.0 || response.residual_slip[0] != 0.0;
        let events = response.statistics.events.total();
        require(!slipped && events == 0, || format!("{what}: {events} events, path {:e}", response.slip_path[0]))
    };
    still(&on_ground(Block::new(0, 1.0, 0.3))?, "ground")?;
    // On a floor the limit is set just above the largest demand that the hour brings.
    let rough = oscillator(0.5, 0.05, vec![Block::new(1, 1.0, 1e3)])?;
    let demand = text(simulate(&rough, &motion, &options))?.peaks.floor_acceleration[0].value;
    let mu = demand / STANDARD_GRAVITY * (1.0 + 1e-9);
    still(&oscillator(0.5, 0.05, vec![Block::new(1, 1.0, mu)])?, "floor")?;
    Ok(format!("0 events, slip 0; floor demand {demand:.6} m/s2"))
}

fn one_hour() -> Outcome {
    let dt = 0.005;
    let vertical = record(73, HOUR, dt, 0.6 * STANDARD_GRAVITY);
    let motion = text(seismass::Motion::new(record(72, HOUR, dt, 7.0), dt, Some(vertical.into())))?;
    let options = Options { energy: true, ..Options::default() };
    let response = text(simulate(&frame()?, &motion, &options))?;
    let residual = residual(&response);
    require(residual < 1e-10, || format!("energy residual {residual:.1e}"))?;
    require(largest(&response.residual_slip).is_finite(), || "not finite".into())?;
    let events = response.statistics.events.total();
    Ok(format!("{} intervals, {events} events, residual {residual:.0e}", response.statistics.intervals))
}
