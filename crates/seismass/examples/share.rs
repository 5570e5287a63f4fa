//! The share of goods whose attached mass gives the drift of sliding goods, for one building under one motion.

use std::sync::Arc;

use seismass::{Block, Building, Damping, Motion, Options, Scene, UniformBuilding, simulate};

/// Largest drift (m) of a building of three storeys with a share of its goods attached as mass, and the others sliding.
fn largest_drift(attached: f64, slide: bool) -> seismass::Result<f64> {
    let (floor, goods) = (1e5, 1e5);
    let bare = UniformBuilding { storeys: 3, period: 0.5, mass: floor, ..Default::default() }.build()?;
    let mass = vec![floor + attached * goods, floor + attached * goods, floor];
    let damping = Damping::Matrix(bare.damping_matrix());
    let building = Building::new(mass, bare.storeys().to_vec(), damping)?;
    let blocks = if slide { vec![Block::new(1, goods, 0.2), Block::new(2, goods, 0.2)] } else { Vec::new() };
    let scene = Scene::new(Some(Arc::new(building)), blocks)?;
    let samples: Vec<f64> = (0..2000).map(|i| 3.0 * (0.06 * f64::from(i)).sin()).collect();
    let response = simulate(&scene, &Motion::new(samples, 0.01, None)?, &Options::default())?;
    Ok(response.peaks.drift.iter().map(|peak| peak.value).fold(0.0, f64::max))
}

fn main() -> seismass::Result<()> {
    let real = largest_drift(0.0, true)?;
    println!("goods slide      {:.3} mm", 1e3 * real);
    for percent in (0..=100).step_by(25) {
        let model = largest_drift(0.01 * f64::from(percent), false)?;
        println!("{percent:3} % attached   {:.3} mm, real over model {:.3}", 1e3 * model, real / model);
    }
    Ok(())
}
