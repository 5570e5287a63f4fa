//! Validated input of a run: building, blocks, scene, motion and options. What exists is valid.

mod block;
mod building;
mod building_and_blocks;
mod check;
mod columns;
mod damping;
#[cfg(feature = "serde")]
mod form;
mod general;
mod motion;
mod options;
mod storey;
mod uniform_building;

pub use block::{Block, MAX_WEAR_STAGES, Wear};
pub use building::{Building, GravityEffect, MAX_STOREYS};
pub use building_and_blocks::Scene;
pub use columns::SceneColumns;
pub use damping::{Damping, StoreyDamping, natural_frequencies};
pub use general::{GeneralBuilding, GeneralScene, Goods, PlaneMotion, PlaneScene, Rack, SlidingBase, Stops};
pub use motion::{MAX_SAMPLES, Motion};
pub use options::Options;
pub use storey::{MAX_BACKBONE_POINTS, PeakOriented, SpringLaw, Storey};
pub use uniform_building::UniformBuilding;
