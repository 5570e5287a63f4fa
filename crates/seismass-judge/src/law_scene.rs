//! Random scenes whose storeys have the further spring laws, and whose blocks wear.

use std::sync::Arc;

use seismass::{
    Block, Building, Damping, GravityEffect, Motion, PeakOriented, Result, STANDARD_GRAVITY, Scene, SpringLaw, Storey,
    UniformBuilding, Wear,
};

use crate::random_scene::{Draw, blocks, mass_above, samples_of, spring};

/// A scene and a motion drawn from a seed.
///
/// 1 to 4 storeys, each with a law of its own or all with one: backbones of 1 to 6 points, some of them on a line or flat
/// at the end; gaps before and after yield; peak-oriented springs with and without Takeda's exponent, cyclic loss,
/// softening and residual strength; flags of any height; P-Delta; initial drifts and velocities; no blocks, or up to three
/// per floor and on the ground, whose friction falls or grows with the path they slip; sines, noise and steps, with and
/// without vertical motion.
///
/// # Errors
/// None for any seed, as tests of this crate assert; validation is the scene's own.
pub fn law_scene(seed: u64) -> Result<(Scene, Motion)> {
    let mut draw = Draw(seed);
    let draw = &mut draw;
    let storeys = draw.one_of(&[1, 1, 2, 3, 4]);
    let dt = draw.one_of(&[0.005, 0.01, 0.02]);
    let samples = 80 + (draw.bits() % 160) as usize;
    let pga = STANDARD_GRAVITY * draw.scale(0.05, 1.5);
    let bare = draw.one_in(3);
    let mut blocks = if bare { Vec::new() } else { blocks(draw, storeys, pga) };
    blocks.iter_mut().for_each(|block| block.wear = wear(draw, block));
    let building = building(draw, storeys, pga, &blocks)?;
    let limits: Vec<f64> = building.storeys().iter().map(|storey| storey.elastic_drift().min(0.05)).collect();
    let mut scene = Scene::new(Some(Arc::new(building)), blocks)?;
    if draw.one_in(5) {
        let drift = limits.iter().map(|limit| draw.between(-1.0, 1.0) * limit).collect();
        let velocity = limits.iter().map(|_| draw.between(-0.5, 0.5)).collect();
        scene = scene.with_initial(drift, velocity)?;
    }
    let acceleration = samples_of(draw, samples, dt, pga);
    let vertical = draw.one_in(4).then(|| {
        let peak = STANDARD_GRAVITY * draw.one_of(&[0.3, 0.8, 1.3]);
        samples_of(draw, samples, dt, peak).into()
    });
    Ok((scene, Motion::new(acceleration, dt, vertical)?))
}

/// In one scene of three, gives about half of the storeys that yield a further law, and every block wear.
pub(crate) fn draw_laws(seed: u64, storeys: &mut [Storey], blocks: &mut [Block]) {
    let mut draw = Draw(seed ^ 0x6c61_7773);
    let draw = &mut draw;
    if !draw.one_in(3) {
        return;
    }
    for storey in storeys.iter_mut().filter(|storey| storey.yield_shear.is_finite()) {
        if draw.one_in(2) {
            let law = draw.bits();
            *storey = of_law(draw, law, storey.clone());
        }
    }
    blocks.iter_mut().for_each(|block| block.wear = wear(draw, block));
}

/// Up to three changes of friction, by paths of the order of those that blocks slip.
pub(crate) fn wear(draw: &mut Draw, block: &Block) -> Vec<Wear> {
    let mut path = 0.0;
    let stages = draw.one_of(&[0, 1, 1, 2, 3]);
    (0..stages)
        .map(|_| {
            path += draw.scale(1e-3, 0.2);
            let mu_s = block.mu_s * draw.one_of(&[0.0, 0.5, 0.8, 1.0, 1.3]);
            Wear { path, mu_s, mu_k: mu_s * draw.one_of(&[1.0, 1.0, 0.8, 0.0]) }
        })
        .collect()
}

fn building(draw: &mut Draw, n: usize, pga: f64, blocks: &[Block]) -> Result<Building> {
    let period = draw.scale(0.15, 1.5);
    let k = UniformBuilding { storeys: n, period, mass: 1000.0, ..Default::default() }.stiffness()?;
    let equal = draw.one_in(3);
    let mass: Vec<f64> = (0..n).map(|_| if equal { 1000.0 } else { draw.between(500.0, 2000.0) }).collect();
    let strength = draw.scale(0.05, 0.6);
    let first = draw.bits();
    let mut storeys = Vec::new();
    for i in 0..n {
        let stiffness = if equal { k } else { k * draw.between(0.4, 2.0) };
        let yield_shear = strength * mass_above(i, &mass, blocks) * pga.max(1.0);
        let law = if equal { first } else { draw.bits() };
        storeys.push(storey(draw, law, stiffness, yield_shear));
    }
    let ratio = draw.one_of(&[0.0, 0.01, 0.05]);
    let damping = if n > 1 && draw.one_in(2) {
        Damping::Rayleigh { ratio, modes: [1, n.min(3)] }
    } else {
        Damping::Modal { ratio }
    };
    let gravity = if draw.one_in(4) {
        let fraction = draw.one_of(&[0.01, 0.05, 0.15]);
        GravityEffect::GeometricStiffness(storeys.iter().map(|s| fraction * s.stiffness).collect())
    } else {
        GravityEffect::None
    };
    Building::new(mass, storeys, damping)?.with_gravity(gravity)
}

/// The laws of a random storey, those drawn more often several times: what they make of a trilinear one.
const LAWS: [fn(&mut Draw, Storey) -> Storey; 7] =
    [multilinear, gap, peak_oriented, peak_oriented, peak_oriented, flag_shaped, flag_shaped];

fn storey(draw: &mut Draw, law: u64, stiffness: f64, yield_shear: f64) -> Storey {
    let (overstrength, second_slope, third_slope) = spring(draw);
    let trilinear = Storey { overstrength, second_slope, third_slope, ..Storey::yielding(stiffness, yield_shear) };
    of_law(draw, law, trilinear)
}

/// What one of the laws, by a random number, makes of a trilinear storey.
pub(crate) fn of_law(draw: &mut Draw, law: u64, trilinear: Storey) -> Storey {
    LAWS[(law % LAWS.len() as u64) as usize](draw, trilinear)
}

fn multilinear(draw: &mut Draw, trilinear: Storey) -> Storey {
    Storey::multilinear(backbone(draw, trilinear.stiffness, trilinear.yield_shear))
}

fn gap(draw: &mut Draw, trilinear: Storey) -> Storey {
    let clearance = trilinear.yield_shear / trilinear.stiffness * draw.scale(0.3, 4.0);
    let stop_stiffness = trilinear.stiffness * draw.scale(0.1, 10.0);
    let yield_shear = if draw.one_in(5) { f64::INFINITY } else { trilinear.yield_shear };
    Storey { yield_shear, law: SpringLaw::Gap { clearance, stop_stiffness }, ..trilinear }
}

fn peak_oriented(draw: &mut Draw, trilinear: Storey) -> Storey {
    let takeda = draw.one_in(2);
    let third_slope = match draw.one_in(2) {
        true => -draw.scale(0.01, 0.5),
        false => trilinear.third_slope,
    };
    let law = SpringLaw::PeakOriented(PeakOriented {
        unloading_exponent: if takeda { draw.between(0.1, 0.95) } else { 0.0 },
        energy_capacity: if draw.one_in(2) { f64::INFINITY } else { draw.scale(2.0, 200.0) },
        residual_strength: if draw.one_in(2) { 0.0 } else { draw.between(0.05, 1.0) },
    });
    Storey { third_slope, law, ..trilinear }
}

fn flag_shaped(draw: &mut Draw, trilinear: Storey) -> Storey {
    let between = draw.between(0.02, 0.98);
    let flag_height = draw.one_of(&[0.0, 1.0, between, between, between]);
    Storey { law: SpringLaw::FlagShaped { flag_height }, ..trilinear }
}

fn backbone(draw: &mut Draw, stiffness: f64, yield_shear: f64) -> Vec<[f64; 2]> {
    let (mut drift, mut force, mut slope) = (0.0, 0.0, stiffness);
    let points = 1 + draw.bits() % 6;
    (0..points)
        .map(|i| {
            let length = yield_shear / stiffness * draw.scale(0.3, 2.0);
            if i > 0 {
                // Equal slopes, up to rounding, are drawn on purpose: a little less, so that they never increase.
                slope *= if draw.one_in(6) { 1.0 - 1e-12 } else { draw.between(0.1, 0.8) };
            }
            if i > 0 && i + 1 == points && draw.one_in(3) {
                slope = 0.0;
            }
            drift += length;
            force += slope * length;
            [drift, force]
        })
        .collect()
}
