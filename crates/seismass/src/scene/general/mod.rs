//! Scenes of the general engine: a building that may have walls, racks on its floors, goods that may hit stops
//! (`numerics`, section 9).

mod building;
mod goods;
mod matrix;
mod plane;
mod rack;
mod structure;

pub use building::GeneralBuilding;
pub use goods::{Goods, Stops};
pub use plane::{PlaneMotion, PlaneScene};
pub use rack::Rack;
pub use structure::GeneralScene;
