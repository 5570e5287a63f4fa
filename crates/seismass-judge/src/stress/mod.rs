//! The stress suite: named cases with a stated expectation each, and random scenes by the million.

pub mod cases;
mod consistency;
mod grazing;
mod hard_scene;
mod pairs;
pub mod random;
pub mod report;
mod tally_file;

pub use hard_scene::hard_scene;
