//! Three storeys with sliding goods on the lower two, under a decaying sine: peak drifts and slips.

use std::sync::Arc;

use seismass::{Block, Motion, Options, Scene, UniformBuilding, simulate};

fn main() -> seismass::Result<()> {
    let yield_shear_over_weight = vec![0.24, 0.20, 0.12];
    let building =
        UniformBuilding { storeys: 3, period: 0.6, mass: 1e5, yield_shear_over_weight, ..Default::default() };
    let goods = vec![Block::new(1, 1e5, 0.3), Block::new(2, 1e5, 0.3)];
    let scene = Scene::new(Some(Arc::new(building.build()?)), goods)?;

    let samples: Vec<f64> =
        (0..1000).map(|i| 5.0 * (0.1 * f64::from(i)).sin() * (-0.002 * f64::from(i)).exp()).collect();
    let response = simulate(&scene, &Motion::new(samples, 0.01, None)?, &Options::default())?;

    for (storey, peak) in response.peaks.drift.iter().enumerate() {
        println!("storey {}  drift {:.6} mm at {:.4} s", storey + 1, 1e3 * peak.value, peak.time);
    }
    for (block, peak) in response.peaks.slip.iter().enumerate() {
        println!("block {}   slip {:.6} mm", block + 1, 1e3 * peak.value);
    }
    Ok(())
}
