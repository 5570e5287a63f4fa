//! The general engine in two horizontal directions, with friction on the circle (`numerics`, section 9.7).
//!
//! Each direction is a state of the general engine: its springs, dampers, stops and guards are those. What joins them is the
//! friction of blocks: decisions, starts, stops and breakaways are of vectors.

mod collocation;
mod decide;
mod energy;
mod guards;
mod huber;
mod last_way;
mod outcome;
mod peaks;
mod products;
mod response;
mod run;
mod series;
mod slide_series;
mod state;
mod stiff;
mod vector;

pub use response::{Axis, PlaneEnergy, PlaneEvent, PlanePeaks, PlaneResponse, VectorPeaks};
pub use run::{simulate_plane, simulate_plane_until};
