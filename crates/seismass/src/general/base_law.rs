//! What a sliding base is in a run.

use crate::machines::block::BlockLaw;
use crate::scene::{GeneralScene, Motion};
use crate::units::STANDARD_GRAVITY;

/// The constant data of a base.
pub(super) struct Base {
    /// The slab as a block on the ground.
    pub(super) law: BlockLaw,
    /// Mass of the slab and of all it carries (kg): its contact force per unit of g + a_v.
    pub(super) carried: f64,
    /// `carried` over the radius of the pendulum (kg/m): its restoring stiffness per unit of g + a_v.
    pub(super) restoring: f64,
    /// No restoring stiffness of the run, with what it changes by in a sample interval, is above this (N/m).
    pub(super) most_stiffness: f64,
}

impl Base {
    pub(super) fn new(scene: &GeneralScene, motion: &Motion) -> Option<Self> {
        let base = scene.base()?;
        let of_floors: f64 = scene.building().map_or(0.0, |building| building.mass().iter().sum());
        let of_racks: f64 = scene.racks().iter().flat_map(|rack| &rack.mass).sum();
        let of_goods: f64 = scene.all_goods().map(|goods| goods.block.mass).sum();
        let carried = base.mass + of_floors + of_racks + of_goods;
        let restoring = carried / base.radius;
        let most_vertical = motion.vertical().map_or(0.0, |a| a.iter().fold(0.0, |most: f64, a| most.max(a.abs())));
        let law = BlockLaw { floor: 0, mass: base.mass, mu_s: base.mu_s, mu_k: base.mu_k, wear: Vec::new() };
        Some(Self { law, carried, restoring, most_stiffness: restoring * (STANDARD_GRAVITY + 3.0 * most_vertical) })
    }
}
