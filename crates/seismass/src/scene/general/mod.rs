//! Scenes of the general engine: a building that may have walls and slide on its base, racks on its floors, goods that may
//! hit stops
//! (`numerics`, section 9).

mod base;
mod building;
mod goods;
mod matrix;
mod plane;
mod rack;
mod structure;

pub use base::SlidingBase;
pub use building::GeneralBuilding;
pub use goods::{Goods, Stops};
pub use plane::{PlaneMotion, PlaneScene};
pub use rack::Rack;
pub use structure::GeneralScene;
