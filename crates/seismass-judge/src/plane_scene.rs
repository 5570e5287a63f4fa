//! Random scenes in two horizontal directions.

use std::sync::Arc;

use seismass::{
    Block, Damping, GeneralBuilding, GeneralScene, Goods, GravityEffect, Motion, PlaneMotion, PlaneScene, Rack, Result,
    STANDARD_GRAVITY, Stops, Storey, UniformBuilding,
};

use crate::general_scene::{building, levels_of, rack, some_goods, stops, with_states};
use crate::random_scene::{Draw, samples_of};

/// Seeds from here on draw twins: equal goods that start within 1e-8 s of each other.
pub const TWINS: u64 = 1 << 40;

/// A scene in two directions and a motion drawn from a seed.
///
/// No building, or 1 to 3 storeys, with springs, walls, damping, P-Delta, initial states and collapse drifts drawn for each
/// direction, or the same in both; in a third of the scenes a rack. Up to three blocks per floor, level and on the ground, as
/// in one direction: equal ones, mu_s > mu_k, mu = 0, wear, goods much heavier than their node, initial velocities in any
/// direction; stops across x, across y, or both. Motions of 40 to 100 samples: of their own in each direction, along a line,
/// or in one direction alone, with and without a vertical component.
///
/// # Errors
/// None for any seed, as the stress suite asserts; validation is the scene's own.
pub fn plane_scene(seed: u64) -> Result<(PlaneScene, PlaneMotion)> {
    if seed >= TWINS {
        return twins(seed);
    }
    let mut draw = Draw(seed ^ 0x706c_616e);
    let draw = &mut draw;
    let storeys: usize = draw.one_of(&[0, 1, 1, 1, 2, 2, 3]);
    let dt = draw.one_of(&[0.005, 0.01, 0.02]);
    let samples = 40 + (draw.bits() % 60) as usize;
    let pga = STANDARD_GRAVITY * draw.scale(0.05, 1.5);
    let mass: Vec<f64> = (0..storeys).map(|_| draw.between(500.0, 2000.0)).collect();
    let mut goods = Vec::new();
    for floor in 0..=storeys {
        let node = floor.checked_sub(1).map_or(1000.0, |f| mass[f]);
        let most: &[usize] = if floor == 0 && storeys > 0 { &[0, 0, 0, 1] } else { &[0, 1, 1, 2, 3] };
        some_goods(draw, floor, node, most, pga, &mut goods);
    }
    let racks: Vec<Rack> = if draw.one_in(3) { vec![rack(draw, &mass, pga)?] } else { Vec::new() };
    if storeys == 0 && goods.is_empty() && racks.is_empty() {
        goods.push(Block::new(0, 1000.0, 0.5 * pga / STANDARD_GRAVITY).into());
    }
    let goods_in_y: Vec<Goods> = goods.iter().map(|goods| in_y(draw, goods)).collect();
    let mut racks_in_y = racks.clone();
    let same = draw.one_in(4);
    for rack in &mut racks_in_y {
        rack.goods = rack.goods.iter().map(|goods| in_y(draw, goods)).collect();
        if !same {
            levels_of(draw, rack, pga)?;
            rack.geometric_stiffness.clear();
        }
    }
    let mut of_building = || {
        let drawn = (storeys > 0).then(|| building(draw, mass.clone(), &goods, &racks, pga)).transpose();
        drawn.map(|building| building.map(Arc::new))
    };
    let building_in_x = of_building()?;
    let building_in_y = if same { building_in_x.clone() } else { of_building()? };
    let x = with_states(draw, GeneralScene::new(building_in_x, goods, racks)?)?;
    let y = with_states(draw, GeneralScene::new(building_in_y, goods_in_y, racks_in_y)?)?;
    let of_x = samples_of(draw, samples, dt, pga);
    let of_y = match draw.bits() % 10 {
        0 => vec![0.0; samples],
        1 => {
            let slope = draw.between(-1.0, 1.0);
            of_x.iter().map(|a| slope * a).collect()
        }
        _ => {
            let peak = pga * draw.between(0.3, 1.2);
            samples_of(draw, samples, dt, peak)
        }
    };
    let vertical = draw.one_in(4).then(|| {
        let peak = STANDARD_GRAVITY * draw.one_of(&[0.3, 0.8, 1.3]);
        samples_of(draw, samples, dt, peak).into()
    });
    Ok((PlaneScene::new(x, y)?, PlaneMotion::new(Motion::new(of_x, dt, vertical)?, of_y)?))
}

/// Equal goods of one floor at equal stops across x, damped, which differ across x in nothing and in y by a start velocity or a
/// stop alone: they come to their limits within 1e-8 s to rounding of each other. Two or three on the last floor of a
/// building of one or two storeys, in half of the scenes one that yields; mu_s = mu_k but in one of four.
///
/// # Errors
/// None for any seed; validation is the scene's own.
fn twins(seed: u64) -> Result<(PlaneScene, PlaneMotion)> {
    let mut draw = Draw(seed ^ 0x7477_696e);
    let draw = &mut draw;
    let (storeys, dt) = (draw.one_of(&[1, 1, 2]), draw.one_of(&[0.005, 0.01]));
    let samples = 100 + (draw.bits() % 100) as usize;
    let mass: Vec<f64> = (0..storeys).map(|_| draw.between(700.0, 1300.0)).collect();
    let uniform = UniformBuilding { storeys: 1, period: draw.between(0.1, 0.5), mass: 1000.0, ..Default::default() };
    let (k, yields) = (uniform.stiffness()?, draw.one_in(2));
    let strength = STANDARD_GRAVITY * mass.iter().sum::<f64>() / draw.one_of(&[3.0, 6.0]);
    let springs = (0..storeys).map(|_| {
        let stiffness = k * draw.between(0.6, 1.4);
        let storey = Storey { overstrength: 1.5, second_slope: 0.2, third_slope: 0.02, ..Storey::elastic(stiffness) };
        if yields { Storey { yield_shear: strength, ..storey } } else { Storey::elastic(stiffness) }
    });
    let springs: Vec<Storey> = springs.collect();
    let damping = Damping::Modal { ratio: 0.02 };
    let building = Arc::new(GeneralBuilding::new(mass, springs, None, &damping, GravityEffect::None)?);
    let mu_s = draw.between(0.02, 0.4);
    let (of_block, frequency) = (1000.0 * draw.scale(0.1, 3.0), draw.between(20.0, 300.0));
    let clearance = if draw.one_in(3) { draw.scale(1e-4, 1e-2) } else { 0.0 };
    let damping = 2.0 * draw.one_of(&[0.02, 0.3, 2.0]) * of_block * frequency;
    let stops = Stops { damping, ..Stops::new(clearance, of_block * frequency * frequency) };
    let mu_k = mu_s * draw.one_of(&[1.0, 1.0, 1.0, 0.9]);
    let block = Block { mu_k, ..Block::new(storeys, of_block, mu_s) };
    let in_x = vec![Goods { block, stops: Some(stops) }; draw.one_of(&[2, 2, 3])];
    let mut in_y: Vec<Goods> = in_x.iter().map(|goods| Goods { stops: None, ..goods.clone() }).collect();
    let mut in_x = in_x;
    if draw.one_in(2) {
        in_y[0].block.velocity = Some(draw.between(-0.3, 0.3));
        in_x[0].block.velocity = Some(0.0);
    } else {
        let frequency = draw.between(20.0, 300.0);
        in_y[0].stops = Some(Stops::new(draw.scale(1e-4, 1e-2), of_block * frequency * frequency));
    }
    let peak = draw.between(2.0, 8.0);
    let of_x = Motion::new(samples_of(draw, samples, dt, peak), dt, None)?;
    let of_y = samples_of(draw, samples, dt, peak);
    let scene = |goods| GeneralScene::new(Some(Arc::clone(&building)), goods, Vec::new());
    Ok((PlaneScene::new(scene(in_x)?, scene(in_y)?)?, PlaneMotion::new(of_x, of_y)?))
}

/// A block as it is in y: with stops of its own, and a velocity of its own where it has one.
fn in_y(draw: &mut Draw, goods: &Goods) -> Goods {
    let mut block = goods.block.clone();
    block.velocity = block.velocity.map(|_| draw.between(-0.5, 0.5));
    let stops = draw.one_in(2).then(|| stops(draw, block.mass));
    Goods { block, stops }
}
