//! Random scenes with racks, walls and stops.

use std::sync::Arc;

use nalgebra::DMatrix;
use seismass::{
    Block, Damping, GeneralBuilding, GeneralScene, Goods, GravityEffect, Motion, Rack, Result, STANDARD_GRAVITY,
    SlidingBase, Stops, Storey, UniformBuilding,
};

use crate::law_scene::{of_law, wear};
use crate::random_scene::{Draw, samples_of, spring};

/// Seeds from here on draw slabs whose goods lose most of their friction as they slide.
pub const SLABS: u64 = 1 << 40;

/// Part of its trace by which a matrix that bears the building alone must exceed a singular one.
const SINGULAR: f64 = 1e-9;

/// A scene and a motion drawn from a seed.
///
/// No building, or 1 to 6 storeys; their springs elastic, trilinear or of a further law, of stiffness 0 beside a wall; in
/// half of the buildings an elastic matrix: a cantilever in bending, a brace over some storeys, a random one of full or of
/// lower rank; every kind of damping; P-Delta by loads and by P/h; initial drifts and velocities; collapse drifts. Up to
/// three racks of 1 to 4 levels, on floors and on the ground, several on a floor, light and heavy, stiff and soft, elastic
/// and yielding, with goods that are fixed to their frames and P/h of their levels. Up to three blocks per floor, level
/// and on the ground: equal ones, mu_s > mu_k, mu = 0, wear, an initial velocity; stops on one side, on both or on none,
/// clearances down to 0, contacts soft and stiff, with a damper and without. Sines, noise and steps, with and without
/// vertical motion. In a sixth of the scenes all of it stands on a sliding base. Beside a wall, P-Delta comes with collapse drifts.
///
/// # Errors
/// None for any seed, as the stress suite asserts; validation is the scene's own.
pub fn general_scene(seed: u64) -> Result<(GeneralScene, Motion)> {
    if seed >= SLABS {
        return slabs(seed);
    }
    let mut draw = Draw(seed ^ 0x7261_636b);
    let draw = &mut draw;
    let storeys: usize = draw.one_of(&[0, 1, 1, 2, 2, 3, 3, 4, 6]);
    let dt = draw.one_of(&[0.005, 0.01, 0.02]);
    let samples = 80 + (draw.bits() % 160) as usize;
    let pga = STANDARD_GRAVITY * draw.scale(0.05, 1.5);
    let racks = if draw.one_in(4) { 0 } else { draw.one_of(&[1, 1, 2, 3]) };
    let mass: Vec<f64> = (0..storeys).map(|_| draw.between(500.0, 2000.0)).collect();
    let mut goods = Vec::new();
    for floor in 0..=storeys {
        let node = floor.checked_sub(1).map_or(1000.0, |f| mass[f]);
        let most: &[usize] = if floor == 0 && storeys > 0 { &[0, 0, 0, 1, 2] } else { &[0, 1, 1, 2, 3] };
        some_goods(draw, floor, node, most, pga, &mut goods);
    }
    let racks: Vec<Rack> = (0..racks).map(|_| rack(draw, &mass, pga)).collect::<Result<_>>()?;
    if storeys == 0 && goods.is_empty() && racks.is_empty() {
        goods.push(Block::new(0, 1000.0, 0.5 * pga / STANDARD_GRAVITY).into());
    }
    let building = (storeys > 0).then(|| building(draw, mass, &goods, &racks, pga)).transpose()?;
    let base = base(seed, building.as_ref(), pga);
    let scene = with_states(draw, GeneralScene::on_base(building.map(Arc::new), goods, racks, base)?)?;
    let acceleration = samples_of(draw, samples, dt, pga);
    let vertical = draw.one_in(4).then(|| {
        let peak = STANDARD_GRAVITY * draw.one_of(&[0.3, 0.8, 1.3, 2.0]);
        samples_of(draw, samples, dt, peak).into()
    });
    Ok((scene, Motion::new(acceleration, dt, vertical)?))
}

/// A sliding base, alone or below a storey, and goods on it of up to thirty times its mass with mu_k of nine tenths of mu_s down
/// to none, half of them between stops: some that slide at the acceleration of the ground would stick on the released slab.
fn slabs(seed: u64) -> Result<(GeneralScene, Motion)> {
    let draw = &mut Draw(seed ^ 0x0073_6c61_6273);
    let (samples, dt) = (80 + (draw.bits() % 80) as usize, draw.one_of(&[0.005, 0.01]));
    let pga = STANDARD_GRAVITY * draw.scale(0.1, 1.5);
    let goods = (0..draw.one_of(&[1, 1, 2, 3])).map(|_| {
        let (mass, mu_s) = (1000.0 * draw.scale(0.1, 30.0), pga / STANDARD_GRAVITY * draw.scale(0.1, 1.5));
        let block = Block { mu_k: mu_s * draw.one_of(&[0.0, 0.2, 0.5, 0.9]), ..Block::new(0, mass, mu_s) };
        Goods { block, stops: draw.one_in(2).then(|| stops(draw, mass)) }
    });
    let goods: Vec<Goods> = goods.collect();
    let has_storey = draw.one_in(2);
    let building = has_storey.then(|| building(draw, vec![1000.0], &goods, &[], pga)).transpose()?;
    let mu_s = pga / STANDARD_GRAVITY * draw.scale(0.1, 1.5);
    let mu_k = mu_s * draw.one_of(&[1.0, 1.0, 0.8]);
    let radius = if draw.one_in(2) { f64::INFINITY } else { draw.scale(0.2, 5.0) };
    let base = SlidingBase { mass: 1000.0 * draw.scale(0.03, 3.0), mu_s, mu_k, radius };
    let scene = GeneralScene::on_base(building.map(Arc::new), goods, Vec::new(), Some(base))?;
    let acceleration = samples_of(draw, samples, dt, pga);
    let vertical = draw.one_in(4).then(|| {
        let peak = STANDARD_GRAVITY * draw.one_of(&[0.8, 1.3]);
        samples_of(draw, samples, dt, peak).into()
    });
    Ok((scene, Motion::new(acceleration, dt, vertical)?))
}

/// In a sixth of the scenes a sliding base, flat or a pendulum, light and heavy. It is drawn by itself: other scenes do not
/// depend on it.
fn base(seed: u64, building: Option<&GeneralBuilding>, pga: f64) -> Option<SlidingBase> {
    let draw = &mut Draw(seed ^ 0x0062_6173_6520);
    if !draw.one_in(6) {
        return None;
    }
    let of_floor = building.map_or(1000.0, |building| building.mass()[0]);
    let mu_s = if draw.one_in(20) { 0.0 } else { (pga / STANDARD_GRAVITY).clamp(0.02, 1.0) * draw.scale(0.1, 1.5) };
    let mu_k = mu_s * draw.one_of(&[1.0, 1.0, 1.0, 0.8, 0.3]);
    let radius = if draw.one_in(2) { f64::INFINITY } else { draw.scale(0.2, 5.0) };
    Some(SlidingBase { mass: of_floor * draw.scale(0.03, 5.0), mu_s, mu_k, radius })
}

/// In some scenes initial drifts and velocities, and collapse drifts, which a wall that leans has always.
pub(crate) fn with_states(draw: &mut Draw, mut scene: GeneralScene) -> Result<GeneralScene> {
    let limits: Vec<f64> = scene
        .building()
        .map_or(Vec::new(), |b| b.storeys().iter().map(|storey| storey.elastic_drift().min(0.05)).collect());
    if !limits.is_empty() && draw.one_in(5) {
        let drift = limits.iter().map(|limit| draw.between(-1.0, 1.0) * limit).collect();
        let velocity = limits.iter().map(|_| draw.between(-0.5, 0.5)).collect();
        scene = scene.with_initial(drift, velocity)?;
    }
    // Beside a wall no storey collapses by itself, however far P-Delta takes it.
    let has_wall = scene.building().is_some_and(|b| b.stiffness_matrix().is_some());
    let leans = has_wall && scene.geometric_stiffness().iter().any(|&g| g > 0.0);
    if !limits.is_empty() && (leans || draw.one_in(10)) {
        let ductility = draw.between(1.5, 8.0);
        scene = scene.with_collapse_drift(limits.iter().map(|limit| ductility * limit).collect())?;
    }
    Ok(scene)
}

/// Blocks on a node of this mass, as many as one of `numbers`.
pub(crate) fn some_goods(
    draw: &mut Draw,
    place: usize,
    node: f64,
    numbers: &[usize],
    pga: f64,
    goods: &mut Vec<Goods>,
) {
    let typical = (pga / STANDARD_GRAVITY).clamp(0.05, 1.0);
    for position in 0..draw.one_of(numbers) {
        if position > 0 && draw.one_in(3) {
            goods.extend(goods.last().cloned());
            continue;
        }
        let mu_s = if draw.one_in(25) { 0.0 } else { typical * draw.scale(0.1, 2.0) };
        let mu_k = mu_s * draw.one_of(&[1.0, 1.0, 1.0, 0.9, 0.6, 0.0]);
        let largest = if draw.one_in(8) { 100.0 } else { 4.0 };
        let mass = node * draw.scale(0.03, largest);
        let mut block = Block { mu_k, ..Block::new(place, mass, mu_s) };
        if draw.one_in(6) {
            block.wear = wear(draw, &block);
        }
        if draw.one_in(12) {
            block.velocity = Some(draw.between(-0.5, 0.5));
        }
        let stops = draw.one_in(2).then(|| stops(draw, mass));
        goods.push(Goods { block, stops });
    }
}

pub(crate) fn stops(draw: &mut Draw, mass: f64) -> Stops {
    let clearance = draw.scale(1e-4, 0.1);
    let other = draw.scale(1e-4, 0.1);
    let clearance = draw.one_of(&[
        [clearance, clearance],
        [clearance, other],
        [0.0, clearance],
        [0.0, 0.0],
        [clearance, f64::INFINITY],
        [f64::INFINITY, 0.0],
    ]);
    // The block on the contact alone: from a second to some thousandths of one.
    let frequency = draw.scale(6.0, 600.0);
    let stiffness = mass * frequency * frequency;
    let ratio = draw.one_of(&[0.0, 0.0, 0.02, 0.3, 2.0]);
    Stops { clearance, stiffness, damping: 2.0 * ratio * mass * frequency }
}

/// An elastic or yielding spring, of the laws of the other families too.
fn level(draw: &mut Draw, stiffness: f64, strength: f64) -> Storey {
    if draw.one_in(3) {
        return Storey::elastic(stiffness);
    }
    let (overstrength, second_slope, third_slope) = spring(draw);
    let storey = Storey { overstrength, second_slope, third_slope, ..Storey::yielding(stiffness, strength) };
    let law = draw.bits();
    if draw.one_in(2) { of_law(draw, law, storey) } else { storey }
}

pub(crate) fn rack(draw: &mut Draw, floors: &[f64], pga: f64) -> Result<Rack> {
    let floor = (draw.bits() % (floors.len() as u64 + 1)) as usize;
    let levels = draw.one_of(&[1, 2, 2, 3, 4]);
    let of_floor = floor.checked_sub(1).map_or(1000.0, |f| floors[f]);
    let frame = of_floor * draw.scale(0.005, 0.3);
    let mut goods = Vec::new();
    let mut mass = Vec::new();
    for level in 1..=levels {
        // Goods that are fixed add to the frame.
        let fixed = if draw.one_in(4) { frame * draw.between(0.5, 5.0) } else { 0.0 };
        mass.push(frame * draw.between(0.7, 1.5) + fixed);
        some_goods(draw, level, of_floor * 0.2, &[0, 1, 1, 2], pga, &mut goods);
    }
    let mut rack = Rack { floor, mass, levels: Vec::new(), damping_ratio: 0.0, geometric_stiffness: Vec::new(), goods };
    rack.damping_ratio = draw.one_of(&[0.0, Rack::DEFAULT_DAMPING_RATIO, Rack::DEFAULT_DAMPING_RATIO, 0.2]);
    levels_of(draw, &mut rack, pga)?;
    if draw.one_in(5) {
        let fraction = draw.one_of(&[0.005, 0.03]);
        rack.geometric_stiffness = rack.levels.iter().map(|level| fraction * level.stiffness).collect();
    }
    Ok(rack)
}

/// Draws the springs of a rack.
pub(crate) fn levels_of(draw: &mut Draw, rack: &mut Rack, pga: f64) -> Result<()> {
    let with_goods = rack.mass_with_goods();
    rack.levels.clear();
    let stiffness = Rack::uniform_stiffness(&with_goods, draw.scale(0.08, 2.0))?;
    let weight = STANDARD_GRAVITY * with_goods.iter().sum::<f64>();
    let strength = weight * draw.scale(0.05, 1.0) * (pga / STANDARD_GRAVITY).max(0.1);
    for _ in 0..rack.mass.len() {
        let of_level = stiffness * draw.between(0.5, 2.0);
        rack.levels.push(level(draw, of_level, strength));
    }
    Ok(())
}

pub(crate) fn building(
    draw: &mut Draw,
    mass: Vec<f64>,
    goods: &[Goods],
    racks: &[Rack],
    pga: f64,
) -> Result<GeneralBuilding> {
    let n = mass.len();
    let uniform = UniformBuilding { storeys: n, period: draw.scale(0.15, 1.5), mass: 1000.0, ..Default::default() };
    let k = uniform.stiffness()?;
    let loads = floor_masses(&mass, goods, racks);
    let strength = draw.scale(0.03, 0.6) * pga.max(1.0);
    let mut storeys: Vec<Storey> = (0..n)
        .map(|i| {
            let stiffness = k * draw.between(0.4, 2.0);
            level(draw, stiffness, strength * loads[i..].iter().sum::<f64>())
        })
        .collect();
    let matrix = draw.one_in(2).then(|| wall(draw, n, k));
    if let Some(matrix) = &matrix {
        // Beyond rounding: a matrix of less than full rank may have a factor.
        let rounding = DMatrix::identity(n, n) * (SINGULAR * matrix.trace());
        let bears_alone = (matrix - rounding).cholesky().is_some();
        for storey in &mut storeys {
            if bears_alone && draw.one_in(5) {
                *storey = Storey::elastic(0.0);
            }
        }
    }
    let least = storeys.iter().map(|storey| storey.stiffness).fold(f64::INFINITY, f64::min);
    let gravity = match draw.bits() % 6 {
        0 => {
            let fraction = draw.one_of(&[0.01, 0.05]);
            GravityEffect::GeometricStiffness(storeys.iter().map(|s| fraction * s.stiffness).collect())
        }
        1 if least > 0.0 => {
            let weight = STANDARD_GRAVITY * loads.iter().sum::<f64>();
            let floor_loads = mass.iter().map(|m| STANDARD_GRAVITY * m).collect();
            GravityEffect::Loads { heights: vec![(20.0 * weight / least).max(3.0); n], floor_loads }
        }
        _ => GravityEffect::None,
    };
    GeneralBuilding::new(mass, storeys, matrix, &damping(draw, n, k), gravity)
}

/// Mass of each floor with its goods and racks.
fn floor_masses(mass: &[f64], goods: &[Goods], racks: &[Rack]) -> Vec<f64> {
    let mut sums = mass.to_vec();
    let of_goods = goods.iter().map(|goods| (goods.block.floor, goods.block.mass));
    let of_racks = racks.iter().map(|rack| (rack.floor, rack.mass_with_goods().iter().sum()));
    for (floor, mass) in of_goods.chain(of_racks).filter(|&(floor, _)| floor > 0) {
        sums[floor - 1] += mass;
    }
    sums
}

fn damping(draw: &mut Draw, n: usize, k: f64) -> Damping {
    let ratio = draw.one_of(&[0.0, 0.02, 0.05]);
    match draw.bits() % 4 {
        0 if n > 1 => Damping::Rayleigh { ratio, modes: [1, n.min(3)] },
        1 => {
            let c = 2.0 * 0.03 * (k * 1000.0).sqrt();
            let tilt = draw.between(-0.3, 0.3);
            Damping::Matrix(DMatrix::from_fn(n, n, |i, j| {
                if i == j { c * (1.0 + i as f64) } else { c * tilt / (1 + i.abs_diff(j)) as f64 }
            }))
        }
        _ => Damping::Modal { ratio },
    }
}

/// An elastic matrix over n floors, about as stiff as storeys of stiffness `k`.
fn wall(draw: &mut Draw, n: usize, k: f64) -> DMatrix<f64> {
    let size = k * draw.scale(0.05, 3.0);
    match draw.bits() % 4 {
        // A cantilever in bending, by its flexibility: a load at one floor and the displacement at another.
        0 => {
            let flexibility = DMatrix::from_fn(n, n, |i, j| {
                let (low, high) = ((i.min(j) + 1) as f64, (i.max(j) + 1) as f64);
                low * low * (3.0 * high - low) / 6.0
            });
            let stiffness = flexibility.try_inverse().unwrap_or_else(|| DMatrix::identity(n, n));
            (&stiffness + stiffness.transpose()) * (0.5 * size)
        }
        // A brace between two floors, or a floor and the ground.
        1 => {
            let (low, high) = (draw.bits() as usize % n, draw.bits() as usize % n);
            let end = |i: usize| f64::from(i == high) - if low < high { f64::from(i == low) } else { 0.0 };
            DMatrix::from_fn(n, n, |i, j| size * end(i) * end(j))
        }
        rank => {
            let columns = if rank == 2 { n } else { 1 + draw.bits() as usize % n };
            let factor = DMatrix::from_fn(n, columns, |_, _| draw.between(-1.0, 1.0));
            &factor * factor.transpose() * size
        }
    }
}
