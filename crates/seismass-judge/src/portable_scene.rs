//! Random scenes of fixed seeds that are the same on every machine: drawn without any function that the C library computes.

use std::sync::Arc;

use nalgebra::DMatrix;
use seismass::{Block, Building, Damping, GravityEffect, Motion, Result, STANDARD_GRAVITY, Scene, Storey};

use crate::random_scene::Draw;

/// Floor masses (kg) lie around it.
const MASS: f64 = 1000.0;
/// Samples of a motion.
const SAMPLES: usize = 200;

/// A scene and a motion drawn from a seed: 1 to 64 storeys, soft and stiff ones, whose shortest period takes from many
/// sample intervals to a small part of one; every kind of damping, P-Delta beyond the strength of a yielding storey, blocks
/// on floors and on the ground, vertical motion.
///
/// # Errors
/// None for any seed, as the test of the programme `bits` asserts; validation is the scene's own.
pub fn portable_scene(seed: u64) -> Result<(Scene, Motion)> {
    let mut draw = Draw(seed);
    let draw = &mut draw;
    let storeys = draw.one_of(&[1, 2, 3, 3, 4, 4, 5, 6, 8, 12, 16, 24, 40, 64]);
    let dt = draw.one_of(&[0.005, 0.01, 0.02]);
    let building = building(draw, storeys, dt)?;
    let mut blocks = Vec::new();
    for floor in 0..=storeys {
        if draw.one_in(2) {
            blocks.push(Block::new(floor, MASS * draw.between(0.2, 2.0), draw.between(0.0, 0.5)));
        }
    }
    let peak = STANDARD_GRAVITY * draw.between(0.1, 1.5);
    let acceleration = samples(draw, peak);
    let vertical = draw.one_in(4).then(|| samples(draw, 1.3 * STANDARD_GRAVITY).into());
    Ok((Scene::new(Some(Arc::new(building)), blocks)?, Motion::new(acceleration, dt, vertical)?))
}

fn building(draw: &mut Draw, storeys: usize, dt: f64) -> Result<Building> {
    let mass: Vec<f64> = (0..storeys).map(|_| MASS * draw.between(0.5, 1.5)).collect();
    // Radians of a storey with its floor alone in a sample interval.
    let phase = draw.one_of(&[0.1, 0.3, 0.6, 0.9, 1.5, 3.0]);
    let stiffness: Vec<f64> =
        (0..storeys).map(|_| MASS * (phase / dt) * (phase / dt) * draw.between(0.5, 1.5)).collect();
    let laws = stiffness.iter().zip(0..).map(|(&stiffness, storey)| Storey {
        second_slope: draw.one_of(&[0.0, 0.05, 0.5]),
        third_slope: 0.0,
        ..Storey::yielding(stiffness, MASS * (storeys - storey) as f64 * draw.between(0.5, 3.0))
    });
    let laws: Vec<Storey> = laws.collect();
    let damping = match draw.bits() % 5 {
        0 => Damping::Modal { ratio: 0.0 },
        1 if storeys > 1 => Damping::Rayleigh { ratio: 0.05, modes: [1, storeys.min(3)] },
        2 => Damping::Matrix(DMatrix::from_diagonal_element(storeys, storeys, MASS * draw.between(0.1, 1.0))),
        _ => Damping::Modal { ratio: 0.05 },
    };
    let building = Building::new(mass, laws, damping)?;
    if draw.one_in(4) {
        let geometric = stiffness.iter().map(|stiffness| stiffness * draw.between(0.0, 0.1)).collect();
        return building.with_gravity(GravityEffect::GeometricStiffness(geometric));
    }
    Ok(building)
}

/// Noise, each sample the mean of some draws that follow each other, which rises from zero and falls to it.
fn samples(draw: &mut Draw, peak: f64) -> Vec<f64> {
    let memory = 1 + (draw.bits() % 8) as usize;
    let noise: Vec<f64> = (0..SAMPLES + memory).map(|_| draw.between(-1.0, 1.0)).collect();
    let mean = |i: usize| noise[i..i + memory].iter().sum::<f64>() / memory as f64;
    let rise = |i: usize| 4.0 * (i * (SAMPLES - 1 - i)) as f64 / ((SAMPLES - 1) * (SAMPLES - 1)) as f64;
    (0..SAMPLES).map(|i| 2.0 * peak * rise(i) * mean(i)).collect()
}
