//! The hard family of random scenes: every number drawn from a range far wider than buildings have. And those among them
//! that are stiff, with heavy goods.

use std::sync::Arc;

use seismass::{
    Block, Building, Damping, GravityEffect, Motion, Result, STANDARD_GRAVITY, Scene, Storey, UniformBuilding,
};

use crate::law_scene::draw_laws;
use crate::random_scene::{Draw, mass_above, samples_of, spring};

/// Largest product of the highest frequency and the time step: beyond, one interval has hundreds of vibrations.
const LARGEST_PHASE: f64 = 200.0;

/// What is drawn of a hard scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Everything.
    Any,
    /// Steps in which the stiffest mode turns by 50 to 1000 radians, under goods 10 to 10000 times as heavy as their floor.
    Stiff,
}

/// A scene and a motion drawn from a seed: periods of 1e-3 to 100 s, stiffness contrasts up to 1e6, floor masses over
/// four decades, block masses 1e-9 to 1e6 of their floor's, mu from 0 to 100, strengths from 1e-9 W to infinity, peaks of
/// 1e-6 to 1e3 m/s2, steps of 1e-3 to 0.1 s (shorter for the stiffest), vertical motion of up to 3 g.
///
/// # Errors
/// None for any seed, as the stress suite asserts; validation is the scene's own.
pub fn hard_scene(seed: u64) -> Result<(Scene, Motion)> {
    scene_of_kind(seed, Kind::Any)
}

/// As [`hard_scene`], with steps in which the stiffest mode turns by 50 to 1000 radians, and goods 10 to 10000 times as
/// heavy as their floor: such motions are not divided into substeps where goods are heavier than that than the lightest
/// floor.
///
/// # Errors
/// As there.
pub fn stiff_scene(seed: u64) -> Result<(Scene, Motion)> {
    scene_of_kind(seed, Kind::Stiff)
}

fn scene_of_kind(seed: u64, kind: Kind) -> Result<(Scene, Motion)> {
    let mut draw = Draw(seed ^ 0x6861_7264);
    let draw = &mut draw;
    let any = [0, 1, 1, 1, 2, 2, 3, 4, 6, 10];
    let storeys = draw.one_of(if kind == Kind::Any { &any } else { &any[1..] });
    let pga = draw.scale(1e-6, 1e3);
    // Few, so that the judge can follow stiff ones.
    let [least, others] = if kind == Kind::Any { [40, 160] } else { [10, 40] };
    let samples = (least + draw.bits() % others) as usize;
    let mut dt = draw.one_of(&[0.001, 0.005, 0.01, 0.02, 0.05, 0.1]);
    let mut scene = if storeys == 0 {
        Scene::new(None, blocks(draw, kind, &[], pga))?
    } else {
        let mass: Vec<f64> = (0..storeys).map(|_| 1000.0 * draw.scale(0.01, 100.0)).collect();
        let mut blocks = blocks(draw, kind, &mass, pga);
        let building = building(draw, seed, mass, &mut blocks, pga)?;
        let shortest = building.periods().into_iter().fold(f64::INFINITY, f64::min);
        let longest_step = LARGEST_PHASE * shortest / std::f64::consts::TAU;
        dt = match kind {
            Kind::Any => f64::min(dt, longest_step * if draw.one_in(30) { 1.0 } else { 0.03 }),
            Kind::Stiff => longest_step * draw.scale(0.25, 5.0),
        };
        Scene::new(Some(Arc::new(building)), blocks)?
    };
    if let Some(building) = scene.building().cloned().filter(|_| draw.one_in(5)) {
        let limit = |storey: &Storey| storey.elastic_drift().min(1.0);
        let drift = building.storeys().iter().map(|s| draw.one_of(&[-1.0, -0.5, 0.0, 0.5, 1.0]) * limit(s)).collect();
        let velocity = (0..storeys).map(|_| draw.between(-1.0, 1.0) * pga * dt).collect();
        scene = scene.with_initial(drift, velocity)?;
    }
    let acceleration = samples_of(draw, samples, dt, pga);
    let vertical = draw.one_in(4).then(|| {
        let peak = STANDARD_GRAVITY * draw.one_of(&[1e-6, 0.5, 1.0, 3.0]);
        samples_of(draw, samples, dt, peak).into()
    });
    Ok((scene, Motion::new(acceleration, dt, vertical)?))
}

fn building(draw: &mut Draw, seed: u64, mass: Vec<f64>, blocks: &mut [Block], pga: f64) -> Result<Building> {
    let n = mass.len();
    let k = UniformBuilding { storeys: n, period: draw.scale(1e-3, 100.0), mass: 1000.0, ..Default::default() }
        .stiffness()?;
    let contrast = draw.one_of(&[1.0, 10.0, 1e3, 1e6f64]).sqrt();
    let strength = draw.scale(1e-3, 10.0) * if draw.one_in(10) { 1e-6 } else { 1.0 };
    let mut storeys = Vec::new();
    for i in 0..n {
        let above = mass_above(i, &mass, blocks);
        let stiffness = k * draw.scale(1.0 / contrast, 2.0 * contrast);
        let (overstrength, second_slope, third_slope) = spring(draw);
        let yield_shear = if draw.one_in(4) { f64::INFINITY } else { strength * above * pga };
        storeys.push(Storey { overstrength, second_slope, third_slope, ..Storey::yielding(stiffness, yield_shear) });
    }
    draw_laws(seed, &mut storeys, blocks);
    let ratio = draw.one_of(&[0.0, 1e-4, 0.05, 0.5, 2.0]);
    let is_rayleigh = n > 1 && draw.one_in(3);
    let damping =
        |ratio| if is_rayleigh { Damping::Rayleigh { ratio, modes: [1, n] } } else { Damping::Modal { ratio } };
    // A ratio above 1 has no name but its matrix.
    let damping = if ratio <= 1.0 {
        damping(ratio)
    } else {
        Damping::Matrix(ratio * Building::new(mass.clone(), storeys.clone(), damping(1.0))?.damping_matrix())
    };
    let gravity = if draw.one_in(5) {
        let fraction = draw.one_of(&[1e-6, 0.05, 0.5, 0.99]);
        GravityEffect::GeometricStiffness(storeys.iter().map(|s| fraction * s.stiffness).collect())
    } else {
        GravityEffect::None
    };
    Building::new(mass, storeys, damping)?.with_gravity(gravity)
}

fn blocks(draw: &mut Draw, kind: Kind, mass: &[f64], pga: f64) -> Vec<Block> {
    let typical = (pga / STANDARD_GRAVITY).min(50.0);
    let mut blocks = Vec::new();
    for floor in 0..=mass.len() {
        let number =
            if floor == 0 && !mass.is_empty() { draw.one_of(&[0, 0, 0, 1]) } else { draw.one_of(&[0, 1, 1, 2]) };
        for _ in 0..number {
            let mu_s = match draw.bits() % 8 {
                0 => 0.0,
                1 => draw.scale(1e-4, 100.0),
                _ => typical * draw.scale(0.05, 2.0),
            };
            let mu_k = mu_s * draw.one_of(&[1.0, 1.0, 0.9, 0.1, 0.0]);
            let floor_mass = if floor > 0 { mass[floor - 1] } else { 1000.0 };
            let alpha = match kind {
                Kind::Stiff => draw.scale(10.0, 1e4),
                Kind::Any if draw.one_in(3) => draw.scale(1e-9, 1e6),
                Kind::Any => draw.scale(0.05, 20.0),
            };
            let velocity = draw.one_in(12).then(|| draw.between(-1.0, 1.0) * pga * 0.1);
            blocks.push(Block { mu_k, velocity, ..Block::new(floor, alpha * floor_mass, mu_s) });
        }
    }
    if mass.is_empty() && blocks.is_empty() {
        blocks.push(Block::new(0, 1000.0, 0.5 * typical));
    }
    blocks
}
