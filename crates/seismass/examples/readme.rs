//! The example of the crate's README; `tests/readme.rs` calls its `main`.

use std::sync::Arc;

use seismass::{Block, Motion, Options, Scene, UniformBuilding, simulate};

pub(crate) fn main() -> seismass::Result<()> {
    // Three storeys that yield at 24, 20 and 12 % of the weight, with 50 t of goods on each floor of 100 t, mu = 0.2.
    let yield_shear_over_weight = vec![0.24, 0.20, 0.12];
    let frame = UniformBuilding { storeys: 3, period: 0.6, mass: 100e3, yield_shear_over_weight, ..Default::default() };
    let goods = (1..=3).map(|floor| Block::new(floor, 50e3, 0.2)).collect();
    let scene = Scene::new(Some(Arc::new(frame.build()?)), goods)?;

    // Ground acceleration (m/s2) every 0.01 s: a sine of 0.63 s that dies away.
    let samples: Vec<f64> = (0..1000).map(f64::from).map(|i| 3.0 * (0.1 * i).sin() * (-0.002 * i).exp()).collect();
    let response = simulate(&scene, &Motion::new(samples, 0.01, None)?, &Options::default())?;

    for (i, (drift, slip)) in response.peaks.drift.iter().zip(&response.peaks.slip).enumerate() {
        println!("storey {}: drift {:5.1} mm, goods slip {:5.1} mm", i + 1, 1e3 * drift.value, 1e3 * slip.value);
    }
    println!("{} events, each at its instant", response.statistics.events.total());
    Ok(())
}
