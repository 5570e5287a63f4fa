//! The stress suite: named cases with a stated expectation each, and random scenes by the million.

pub mod cases;
mod consistency;
mod family;
pub mod general;
mod grazing;
mod hard_scene;
mod pairs;
pub mod random;
pub mod report;
mod tall_scene;
mod tally_file;
mod verdict;

pub use family::{Family, scene_of};
pub use hard_scene::hard_scene;
pub use tall_scene::tall_scene;
pub use tally_file::program;
