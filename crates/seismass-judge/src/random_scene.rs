//! Random scenes of fixed seeds that draw every feature of the model, for comparing implementations.

use std::sync::Arc;

use nalgebra::DMatrix;
use seismass::{
    Block, Building, Damping, GravityEffect, Motion, Result, STANDARD_GRAVITY, Scene, Storey, UniformBuilding,
};

/// The SplitMix64 generator (Steele, Lea and Flood, 2014): one 64-bit seed, the same numbers everywhere.
pub(crate) struct Draw(pub(crate) u64);

impl Draw {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform between two numbers.
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in the logarithm.
    pub(crate) fn scale(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub(crate) fn one_in(&mut self, n: u64) -> bool {
        self.bits().is_multiple_of(n)
    }

    pub(crate) fn one_of<T: Copy>(&mut self, values: &[T]) -> T {
        values[(self.bits() % values.len() as u64) as usize]
    }
}

/// A scene and a motion drawn from a seed.
///
/// No building, or 1 to 12 storeys, equal or not; storeys elastic, with one element and with two, all ends of
/// 0 <= r3 <= r2 <= 1 and Omega = 1; every kind of damping; P-Delta, negative tangents and collapse drifts; initial
/// drifts and velocities; up to three blocks per floor and on the ground, equal ones, mu_s > mu_k, mu = 0, with an
/// initial velocity; motions with exact zeros, plateaus and a first sample that is not zero; vertical motion with and
/// without loss of contact.
///
/// # Errors
/// None for any seed, as tests of this crate assert; validation is the scene's own.
pub fn random_scene(seed: u64) -> Result<(Scene, Motion)> {
    let mut draw = Draw(seed);
    let draw = &mut draw;
    let storeys = draw.one_of(&[0, 1, 1, 2, 2, 3, 3, 3, 4, 4, 5, 6, 12]);
    let dt = draw.one_of(&[0.005, 0.01, 0.02, 0.04]);
    let samples = 80 + (draw.bits() % 320) as usize;
    let pga = STANDARD_GRAVITY * draw.scale(0.03, 1.5);
    let blocks = blocks(draw, storeys, pga);
    let mut scene = if storeys > 0 {
        let building = building(draw, storeys, pga, &blocks)?;
        Scene::new(Some(Arc::new(building)), blocks)?
    } else {
        Scene::new(None, blocks)?
    };
    if let Some(building) = scene.building().cloned().filter(|_| draw.one_in(5)) {
        let limit = |storey: &Storey| (storey.yield_shear / storey.stiffness).min(0.05);
        let drift = building.storeys().iter().map(|s| draw.between(-1.0, 1.0) * limit(s)).collect();
        let velocity = (0..storeys).map(|_| draw.between(-0.5, 0.5)).collect();
        scene = scene.with_initial(drift, velocity)?;
    }
    if let Some(building) = scene.building().cloned().filter(|_| draw.one_in(8)) {
        let ductility = draw.between(1.5, 8.0);
        let limit = |s: &Storey| (ductility * s.yield_shear / s.stiffness).min(0.1);
        scene = scene.with_collapse_drift(building.storeys().iter().map(limit).collect())?;
    }
    let acceleration = samples_of(draw, samples, dt, pga);
    let vertical = draw.one_in(3).then(|| {
        let peak = STANDARD_GRAVITY * draw.one_of(&[0.3, 0.8, 1.3, 2.0]);
        samples_of(draw, samples, dt, peak).into()
    });
    Ok((scene, Motion::new(acceleration, dt, vertical)?))
}

fn building(draw: &mut Draw, n: usize, pga: f64, blocks: &[Block]) -> Result<Building> {
    let period = draw.scale(0.15, 2.0);
    let k = UniformBuilding { storeys: n, period, mass: 1000.0, ..Default::default() }.stiffness()?;
    let equal = draw.one_in(3);
    let mass: Vec<f64> = (0..n).map(|_| if equal { 1000.0 } else { draw.between(500.0, 2000.0) }).collect();
    let elastic = draw.one_in(5);
    let strength = draw.scale(0.03, 0.8);
    let law = spring(draw);
    let mut storeys = Vec::new();
    for i in 0..n {
        let above = mass_above(i, &mass, blocks);
        let stiffness = if equal { k } else { k * draw.between(0.4, 2.0) };
        let yield_shear = if elastic || draw.one_in(8) { f64::INFINITY } else { strength * above * pga.max(1.0) };
        let (overstrength, second_slope, third_slope) = if equal { law } else { spring(draw) };
        storeys.push(Storey { overstrength, second_slope, third_slope, ..Storey::yielding(stiffness, yield_shear) });
    }
    let ratio = draw.one_of(&[0.0, 0.01, 0.05, 0.2]);
    let damping = match draw.bits() % 4 {
        0 if n > 1 => Damping::Rayleigh { ratio, modes: [1, n.min(3)] },
        1 => {
            let c = 2.0 * 0.03 * (k * 1000.0).sqrt();
            let tilt = draw.between(-0.3, 0.3);
            Damping::Matrix(DMatrix::from_fn(n, n, |i, j| {
                if i == j { c * (1.0 + i as f64) } else { c * tilt / (1 + i.abs_diff(j)) as f64 }
            }))
        }
        _ => Damping::Modal { ratio },
    };
    let gravity = match draw.bits() % 8 {
        0 => {
            let fraction = draw.one_of(&[0.01, 0.05, 0.15]);
            GravityEffect::GeometricStiffness(storeys.iter().map(|s| fraction * s.stiffness).collect())
        }
        1 => {
            let load = STANDARD_GRAVITY * (mass.iter().sum::<f64>() + blocks.iter().map(|b| b.mass).sum::<f64>());
            let softest = storeys.iter().map(|s| s.stiffness).fold(f64::INFINITY, f64::min);
            let height = (20.0 * load / softest).max(3.0);
            let floor_loads = mass.iter().map(|m| STANDARD_GRAVITY * m).collect();
            GravityEffect::Loads { heights: vec![height; n], floor_loads }
        }
        _ => GravityEffect::None,
    };
    Building::new(mass, storeys, damping)?.with_gravity(gravity)
}

/// Mass that storey `i` carries: of the floors above it and of the blocks on them.
pub(crate) fn mass_above(i: usize, mass: &[f64], blocks: &[Block]) -> f64 {
    mass[i..].iter().sum::<f64>() + blocks.iter().filter(|b| b.floor > i).map(|b| b.mass).sum::<f64>()
}

/// Overstrength, second and third slope, with all their special cases.
pub(crate) fn spring(draw: &mut Draw) -> (f64, f64, f64) {
    let overstrength = if draw.one_in(5) { 1.0 } else { draw.between(1.05, 2.5) };
    let r2 = match draw.bits() % 8 {
        0 => 0.0,
        1 => 1.0,
        2 | 3 => 0.05,
        _ => draw.between(0.02, 0.9),
    };
    let r3 = match draw.bits() % 4 {
        0 => r2,
        1 => r2 * draw.between(0.0, 1.0),
        _ => 0.0,
    };
    (overstrength, r2, r3)
}

pub(crate) fn blocks(draw: &mut Draw, storeys: usize, pga: f64) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    let typical = (pga / STANDARD_GRAVITY).clamp(0.05, 1.0);
    for floor in 0..=storeys {
        let number = if floor == 0 && storeys > 0 { draw.one_of(&[0, 0, 0, 1]) } else { draw.one_of(&[0, 1, 1, 2, 3]) };
        for position in 0..number {
            let before = blocks.last().cloned().filter(|_| position > 0 && draw.one_in(2));
            let mut block = before.unwrap_or_else(|| {
                let mu_s = if draw.one_in(25) { 0.0 } else { typical * draw.scale(0.1, 2.0) };
                let mu_k = mu_s * draw.one_of(&[1.0, 1.0, 1.0, 0.9, 0.6, 0.0]);
                Block { mu_k, ..Block::new(floor, draw.scale(50.0, 3000.0), mu_s) }
            });
            if draw.one_in(12) {
                block.velocity = Some(draw.between(-0.5, 0.5));
            }
            blocks.push(block);
        }
    }
    if storeys == 0 && blocks.is_empty() {
        blocks.push(Block::new(0, 1000.0, 0.5 * typical));
    }
    blocks
}

/// Samples with a largest absolute value of `peak`: sines, filtered noise, or steps; then zeros and plateaus cut in.
pub(crate) fn samples_of(draw: &mut Draw, samples: usize, dt: f64, peak: f64) -> Vec<f64> {
    let duration = samples as f64 * dt;
    let envelope = !draw.one_in(4);
    let mut values: Vec<f64> = match draw.bits() % 4 {
        0 => {
            let mut filtered = 0.0;
            let memory = draw.between(0.0, 0.95);
            let mut next = || {
                filtered = memory * filtered + draw.between(-1.0, 1.0);
                filtered
            };
            (0..samples).map(|_| next()).collect()
        }
        1 => {
            let length = 3 + (draw.bits() % 30) as usize;
            let levels: Vec<f64> = (0..=samples / length).map(|_| draw.between(-1.0, 1.0)).collect();
            (0..samples).map(|i| levels[i / length]).collect()
        }
        _ => {
            let waves: Vec<[f64; 3]> = (0..1 + draw.bits() % 4)
                .map(|_| [draw.scale(0.5, 6.0), draw.between(0.0, std::f64::consts::TAU), draw.between(0.2, 1.0)])
                .collect();
            let at = |t: f64| waves.iter().map(|[f, phase, a]| a * (std::f64::consts::TAU * f * t + phase).sin()).sum();
            (0..samples).map(|i| at(i as f64 * dt)).collect()
        }
    };
    if envelope {
        for (i, value) in values.iter_mut().enumerate() {
            *value *= (std::f64::consts::PI * i as f64 * dt / duration).sin();
        }
    }
    let largest = values.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    values.iter_mut().for_each(|v| *v *= peak / largest);
    if draw.one_in(3) {
        let from = (draw.bits() % samples as u64) as usize;
        let to = (from + (draw.bits() % 60) as usize).min(samples);
        let level = if draw.one_in(2) { 0.0 } else { values[from] };
        values[from..to].fill(level);
    }
    values
}
