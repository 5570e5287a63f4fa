//! The judge of the general engine: racks, walls and stops, written a second time from `numerics`, section 9.

mod arrangement;
mod base;
mod carry_out;
mod compare;
mod decide;
mod divide;
mod guards;
mod modal;
mod model;
mod plane;
mod record;
mod series;
mod slab;
mod solve;
mod state;
mod stretches;

pub(crate) use compare::apart_by_machine;
pub use compare::{as_chain, compare_general, solution_of};
pub use divide::{divided, divided_plane};
pub(crate) use model::Model;
pub(crate) use plane::solve_plane_scaled;
pub use plane::{PlaneSolution, compare_plane, plane_solution_of, solve_plane};
pub use record::GeneralSolution;
pub use solve::solve_general;
pub(crate) use solve::{Budget, Scale, solve_scaled};
