//! Scenes and motions changed in their last digits.

use std::sync::Arc;

use seismass::{
    Block, Damping, GeneralBuilding, GeneralScene, Goods, GravityEffect, Motion, Rack, SlidingBase, SpringLaw, Storey,
};

use crate::random_scene::Draw;

/// Factors of the numbers of each kind: what is equal stays equal.
pub(super) struct Factors {
    mass: f64,
    stiffness: f64,
    friction: f64,
    strength: f64,
    start: f64,
    clearance: f64,
}

/// The motion changed by up to `digits` in its last digit, and factors for the scene; none for trials 0 and 1, which change
/// the motion alone.
pub(super) fn changed_motion(motion: &Motion, digits: f64, trial: u64) -> Option<(Motion, Option<Factors>)> {
    let mut draw = Draw(trial);
    let size = digits * f64::EPSILON;
    let mut factor = || 1.0 + size * draw.one_of(&[-1.0, 1.0]) * if trial < 2 { 1.0 } else { draw.between(0.5, 1.0) };
    let (ground, vertical) = (factor(), factor());
    let ground = if trial == 0 { 1.0 + size } else { ground };
    let factors = (trial >= 2).then(|| Factors {
        mass: factor(),
        stiffness: factor(),
        friction: factor(),
        strength: factor(),
        start: factor(),
        clearance: factor(),
    });
    let of_ground = scaled(motion.acceleration(), ground);
    let vertical = motion.vertical().map(|v| scaled(v, vertical).into());
    Some((Motion::new(of_ground, motion.dt(), vertical).ok()?, factors))
}

fn scaled(values: &[f64], by: f64) -> Vec<f64> {
    values.iter().map(|v| v * by).collect()
}

impl Factors {
    pub(super) fn scene(&self, scene: &GeneralScene) -> Option<GeneralScene> {
        let building = match scene.building() {
            None => None,
            Some(building) => Some(Arc::new(self.building(building)?)),
        };
        let limits: Vec<f64> =
            building.as_ref().map_or(Vec::new(), |b| b.storeys().iter().map(Storey::elastic_drift).collect());
        let goods = scene.goods().iter().map(|goods| self.goods(goods)).collect();
        let racks = scene.racks().iter().map(|rack| self.rack(rack)).collect();
        let base = scene.base().map(|base| SlidingBase {
            mass: base.mass * self.mass,
            mu_s: base.mu_s * self.friction,
            mu_k: base.mu_k * self.friction,
            radius: base.radius * self.clearance,
        });
        let mut changed = GeneralScene::on_base(building, goods, racks, base).ok()?;
        let drift = scene.initial_drift().iter().zip(limits).map(|(d, limit)| (d * self.start).clamp(-limit, limit));
        changed = changed.with_initial(drift.collect(), scaled(scene.initial_velocity(), self.start)).ok()?;
        if let Some(drift) = scene.collapse_drift() {
            changed = changed.with_collapse_drift(drift.to_vec()).ok()?;
        }
        Some(changed)
    }

    fn building(&self, building: &GeneralBuilding) -> Option<GeneralBuilding> {
        let mass = building.mass().iter().map(|m| m * self.mass).collect();
        let storeys = building.storeys().iter().map(|storey| self.storey(storey)).collect();
        let matrix = building.stiffness_matrix().map(|k| k * self.stiffness);
        let damping = Damping::Matrix(building.damping_matrix() * self.stiffness);
        let gravity = match building.gravity() {
            GravityEffect::GeometricStiffness(values) => {
                GravityEffect::GeometricStiffness(values.iter().map(|v| v * self.stiffness).collect())
            }
            other => other.clone(),
        };
        GeneralBuilding::new(mass, storeys, matrix, &damping, gravity).ok()
    }

    fn storey(&self, storey: &Storey) -> Storey {
        let Self { stiffness, strength, .. } = self;
        if let SpringLaw::Multilinear { backbone } = &storey.law {
            let points: Vec<_> = backbone.iter().map(|[d, f]| [d * strength / stiffness, f * strength]).collect();
            return Storey::multilinear(points);
        }
        let (of_stiffness, of_strength) = (storey.stiffness * stiffness, storey.yield_shear * strength);
        Storey { stiffness: of_stiffness, yield_shear: of_strength, ..storey.clone() }
    }

    fn goods(&self, goods: &Goods) -> Goods {
        let block = &goods.block;
        let block = Block {
            mass: block.mass * self.mass,
            mu_s: block.mu_s * self.friction,
            mu_k: block.mu_k * self.friction,
            velocity: block.velocity.map(|v| v * self.start),
            ..block.clone()
        };
        let stops = goods.stops.map(|mut stops| {
            stops.clearance = stops.clearance.map(|c| c * self.clearance);
            stops.stiffness *= self.stiffness;
            stops
        });
        Goods { block, stops }
    }

    fn rack(&self, rack: &Rack) -> Rack {
        Rack {
            mass: rack.mass.iter().map(|m| m * self.mass).collect(),
            levels: rack.levels.iter().map(|level| self.storey(level)).collect(),
            goods: rack.goods.iter().map(|goods| self.goods(goods)).collect(),
            geometric_stiffness: rack.geometric_stiffness.iter().map(|g| g * self.stiffness).collect(),
            ..rack.clone()
        }
    }
}
