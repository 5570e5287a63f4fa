//! The tall family of random scenes: buildings whose number of storeys the kernel treats in its own way.

use std::sync::Arc;

use seismass::{
    Block, Building, Damping, GravityEffect, Motion, Result, STANDARD_GRAVITY, Scene, Storey, UniformBuilding,
};

use crate::law_scene::draw_laws;
use crate::random_scene::{Draw, mass_above, samples_of, spring};

/// Largest product of the highest frequency and the time step: beyond, the kernel has no step of a whole interval. One
/// scene in ten goes beyond.
const LARGEST_PHASE: f64 = 6.0;

/// A scene and a motion drawn from a seed: 13 to 64 storeys, equal, tapered, on a soft storey, or with contrasts of mass
/// and stiffness up to 1e4; modal and Rayleigh damping, from none to a fifth of critical; P-Delta up to half
/// of the elastic stiffness; storeys that yield here and there, blocks on some floors; large initial drifts and velocities
/// of some storeys alone, so that a disturbance runs through storeys nearly at rest: not quite, for where it has not yet
/// come nothing but rounding would decide what blocks do; short motions with zeros and plateaus.
///
/// # Errors
/// None for any seed, as the stress suite asserts; validation is the scene's own.
pub fn tall_scene(seed: u64) -> Result<(Scene, Motion)> {
    let mut draw = Draw(seed ^ 0x7461_6c6c);
    let draw = &mut draw;
    let storeys = draw.one_of(&[13, 16, 17, 18, 20, 23, 24, 32, 40, 49, 64]);
    let samples = 30 + (draw.bits() % 170) as usize;
    let pga = STANDARD_GRAVITY * draw.scale(0.03, 1.5);
    let mass = masses(draw, storeys);
    let mut blocks = blocks(draw, &mass, pga);
    let building = building(draw, seed, mass, &mut blocks, pga)?;
    let shortest = building.periods().into_iter().fold(f64::INFINITY, f64::min);
    let largest_phase = if draw.one_in(10) { 3.0 * LARGEST_PHASE } else { LARGEST_PHASE };
    let dt = draw.one_of(&[0.0025, 0.005, 0.01, 0.02, 0.05f64]).min(largest_phase * shortest / std::f64::consts::TAU);
    let shaken = draw.one_in(3);
    let ambient = draw.scale(1e-7, 1e-3);
    let mut at_storey = |storey: &Storey| {
        let limit = storey.elastic_drift().min(0.02);
        let drift = if shaken { draw.one_of(&[-1.0, 0.0, 0.0, 0.0, 0.5]) * limit } else { 0.0 };
        let velocity = if shaken { draw.one_of(&[0.0, 0.0, 0.0, 0.1, -0.3]) } else { 0.0 };
        (drift, velocity + draw.between(-ambient, ambient))
    };
    let (drift, velocity) = building.storeys().iter().map(&mut at_storey).unzip();
    let scene = Scene::new(Some(Arc::new(building)), blocks)?.with_initial(drift, velocity)?;
    let acceleration = if draw.one_in(8) { vec![0.0; samples] } else { samples_of(draw, samples, dt, pga) };
    let vertical = draw.one_in(6).then(|| {
        let peak = STANDARD_GRAVITY * draw.one_of(&[0.3, 1.3]);
        samples_of(draw, samples, dt, peak).into()
    });
    Ok((scene, Motion::new(acceleration, dt, vertical)?))
}

fn masses(draw: &mut Draw, storeys: usize) -> Vec<f64> {
    let contrast = draw.one_of(&[1.0, 1.0, 2.0, 100.0, 1e4f64]).sqrt();
    (0..storeys).map(|_| 1000.0 * draw.scale(1.0 / contrast, contrast)).collect()
}

fn building(draw: &mut Draw, seed: u64, mass: Vec<f64>, blocks: &mut [Block], pga: f64) -> Result<Building> {
    let n = mass.len();
    let k =
        UniformBuilding { storeys: n, period: draw.scale(0.3, 8.0), mass: 1000.0, ..Default::default() }.stiffness()?;
    let contrast = draw.one_of(&[1.0, 1.0, 2.0, 100.0, 1e4f64]).sqrt();
    let taper = draw.one_of(&[0.0, 0.5, 0.95]);
    let soft = draw.one_in(5).then(|| (draw.bits() % n as u64) as usize);
    let strength = draw.scale(0.003, 1.0);
    let (elastic, law) = (draw.one_in(3), draw.one_in(2).then(|| spring(draw)));
    let mut storeys = Vec::new();
    for i in 0..n {
        let above = mass_above(i, &mass, blocks);
        let mut stiffness = k * (1.0 - taper * i as f64 / n as f64) * draw.scale(1.0 / contrast, contrast);
        if soft == Some(i) {
            stiffness *= 1e-3;
        }
        let (overstrength, second_slope, third_slope) = law.unwrap_or_else(|| spring(draw));
        let yield_shear = if elastic || draw.one_in(3) { f64::INFINITY } else { strength * above * pga };
        storeys.push(Storey { overstrength, second_slope, third_slope, ..Storey::yielding(stiffness, yield_shear) });
    }
    draw_laws(seed, &mut storeys, blocks);
    let ratio = draw.one_of(&[0.0, 0.01, 0.05, 0.05, 0.2]);
    let damping = match draw.bits() % 4 {
        0 => Damping::Modal { ratio },
        // Between modes far apart, the highest would be damped so much that the judge took minutes.
        1 | 2 if contrast <= 2.0 && ratio < 0.1 => Damping::Rayleigh { ratio, modes: [1, 2] },
        _ => Damping::Rayleigh { ratio, modes: [1, n] },
    };
    let gravity = if draw.one_in(4) {
        let fraction = draw.one_of(&[0.01, 0.1, 0.5]);
        GravityEffect::GeometricStiffness(storeys.iter().map(|s| fraction * s.stiffness).collect())
    } else {
        GravityEffect::None
    };
    Building::new(mass, storeys, damping)?.with_gravity(gravity)
}

fn blocks(draw: &mut Draw, mass: &[f64], pga: f64) -> Vec<Block> {
    let typical = (pga / STANDARD_GRAVITY).clamp(0.05, 1.0);
    let share = draw.one_of(&[0, 1, 3]);
    let mut blocks = Vec::new();
    for floor in 1..=mass.len() {
        if draw.bits() % 6 < share {
            let mu_s = if draw.one_in(20) { 0.0 } else { typical * draw.scale(0.1, 3.0) };
            let mu_k = mu_s * draw.one_of(&[1.0, 1.0, 0.9, 0.5]);
            let velocity = draw.one_in(12).then(|| draw.between(-0.5, 0.5));
            blocks.push(Block { mu_k, velocity, ..Block::new(floor, mass[floor - 1] * draw.scale(0.05, 5.0), mu_s) });
        }
    }
    blocks
}
