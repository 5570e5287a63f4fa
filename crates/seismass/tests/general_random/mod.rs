//! Random scenes with racks, walls and stops, of fixed seeds.

use std::sync::Arc;

use nalgebra::DMatrix;
use seismass::{
    Block, Damping, GeneralBuilding, GeneralScene, Goods, GravityEffect, Motion, PeakOriented, Rack, STANDARD_GRAVITY,
    SpringLaw, Stops, Storey, Wear,
};

/// The SplitMix64 generator (Steele, Lea and Flood, 2014).
pub struct Draw(pub u64);

impl Draw {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A number of a range, all ratios alike.
    #[allow(dead_code)] // Not all tests draw so.
    pub fn scale(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.between(0.0, 1.0))
    }

    fn one_in(&mut self, n: u64) -> bool {
        self.bits().is_multiple_of(n)
    }

    fn up_to(&mut self, n: u64) -> usize {
        (self.bits() % (n + 1)) as usize
    }

    fn stops(&mut self, mass: f64) -> Option<Stops> {
        if self.one_in(2) {
            return None;
        }
        let stiffness = mass * 10f64.powf(self.between(1.0, 4.0));
        let damping = if self.one_in(2) { 0.0 } else { self.between(0.02, 1.0) * (stiffness * mass).sqrt() };
        let clearance = [0.0, self.between(1e-3, 0.02)];
        let clearance = if self.one_in(4) { clearance } else { [clearance[1], self.between(1e-3, 0.02)] };
        Some(Stops { clearance, stiffness, damping })
    }

    fn goods(&mut self, place: usize, of_node: f64) -> Goods {
        let mass = of_node * self.between(0.1, 3.0);
        let mu_s = self.between(0.03, 0.4);
        let mu_k = if self.one_in(2) { mu_s } else { mu_s * self.between(0.6, 1.0) };
        let wear = if self.one_in(8) { vec![Wear { path: 0.02, mu_s: 0.8 * mu_s, mu_k: 0.7 * mu_k }] } else { vec![] };
        Goods { block: Block { mu_s, mu_k, wear, ..Block::new(place, mass, mu_s) }, stops: self.stops(mass) }
    }

    fn spring(&mut self, stiffness: f64, strength: f64) -> Storey {
        let yield_shear = if self.one_in(3) { f64::INFINITY } else { strength };
        let storey = Storey { second_slope: self.between(0.0, 0.5), ..Storey::yielding(stiffness, yield_shear) };
        match self.bits() % 6 {
            0 => Storey { law: SpringLaw::PeakOriented(PeakOriented::default()), ..storey },
            1 => Storey { law: SpringLaw::FlagShaped { flag_height: 0.8 }, ..storey },
            _ => storey,
        }
    }

    fn building(&mut self, floors: usize) -> GeneralBuilding {
        let mass: Vec<f64> = (0..floors).map(|_| self.between(600.0, 1500.0)).collect();
        let stiffness = 2e5 * self.between(0.5, 3.0) * floors as f64;
        let walled = self.one_in(2);
        let mut storeys: Vec<Storey> = (0..floors).map(|_| self.spring(stiffness, 1000.0 * floors as f64)).collect();
        let matrix = walled.then(|| {
            let factor = DMatrix::from_fn(floors, floors, |_, _| self.between(-300.0, 300.0));
            let k = &factor * factor.transpose();
            k + DMatrix::identity(floors, floors) * 1e3
        });
        if walled && self.one_in(3) {
            storeys[floors - 1] = Storey::elastic(0.0);
        }
        let gravity = match self.bits() % 4 {
            0 if matrix.is_none() => GravityEffect::GeometricStiffness(vec![0.01 * stiffness; floors]),
            _ => GravityEffect::None,
        };
        let damping = match self.bits() % 3 {
            0 if floors > 1 => Damping::Rayleigh { ratio: 0.03, modes: [1, 2] },
            _ => Damping::Modal { ratio: 0.04 },
        };
        GeneralBuilding::new(mass, storeys, matrix, &damping, gravity).unwrap()
    }

    fn rack(&mut self, floors: usize) -> Rack {
        let (floor, levels) = (self.up_to(floors as u64), 1 + self.up_to(2));
        let goods = (1..=levels).flat_map(|level| {
            let count = self.up_to(2);
            (0..count).map(|_| self.goods(level, 200.0)).collect::<Vec<_>>()
        });
        let mut rack = Rack {
            goods: goods.collect(),
            floor,
            mass: (0..levels).map(|_| self.between(20.0, 150.0)).collect(),
            levels: Vec::new(),
            damping_ratio: 0.03,
            geometric_stiffness: Vec::new(),
        };
        let stiffness = Rack::uniform_stiffness(&rack.mass_with_goods(), self.between(0.1, 1.0)).unwrap();
        let weight = STANDARD_GRAVITY * rack.mass_with_goods().iter().sum::<f64>();
        rack.levels = (0..levels).map(|_| self.spring(stiffness, 0.3 * weight)).collect();
        rack
    }

    fn samples(&mut self, count: usize, peak: f64) -> Vec<f64> {
        let waves: Vec<[f64; 3]> =
            (0..5).map(|_| [self.between(0.02, 0.6), self.between(0.0, 6.3), self.between(0.1, 1.0)]).collect();
        let at = |i: usize| waves.iter().map(|[w, phase, size]| size * (w * i as f64 + phase).sin()).sum::<f64>();
        (0..count).map(|i| 0.4 * peak * at(i)).collect()
    }
}

/// A scene and a motion of a seed.
pub fn random_general(seed: u64) -> (GeneralScene, Motion) {
    let mut draw = Draw(seed);
    let floors = draw.up_to(4);
    let building = (floors > 0).then(|| Arc::new(draw.building(floors)));
    let mut goods = Vec::new();
    for floor in 0..=floors {
        for _ in 0..draw.up_to(2) {
            goods.push(draw.goods(floor, 800.0));
        }
    }
    let racks: Vec<Rack> = (0..1 + draw.up_to(1)).map(|_| draw.rack(floors)).collect();
    let scene = GeneralScene::new(building, goods, racks).unwrap();
    let peak = draw.between(1.0, 6.0);
    let samples = draw.samples(300, peak);
    let vertical = draw.one_in(3).then(|| Arc::from(draw.samples(300, 2.0 * peak)));
    (scene, Motion::new(samples, 0.01, vertical).unwrap())
}
