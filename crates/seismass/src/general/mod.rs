//! The general engine: any tree of springs beside an elastic matrix, with blocks on every node, stops on their slip, and a
//! base that may slide (`numerics`, section 9).
//!
//! It solves what the chain engine of the other modules does not take, with the same machines and the same exactness: the
//! Taylor series of the solution from event to event, guards as polynomials, the first root of all refined to rounding.

mod base;
mod base_guards;
mod base_law;
mod block_guards;
mod decay;
mod decide;
mod energy;
mod forces;
mod guards;
mod histories;
mod outcome;
mod peaks;
mod plane;
mod regime;
mod response;
mod run;
mod series;
mod state;
mod stops;
mod system;
mod terms;

pub use plane::{
    Axis, PlaneEnergy, PlaneEvent, PlanePeaks, PlaneResponse, VectorPeaks, simulate_plane, simulate_plane_until,
};
pub use response::{GeneralBase, GeneralEnergy, GeneralEvent, GeneralPeaks, GeneralResponse, GeneralStatus};
pub use run::{simulate_general, simulate_general_until};
