//! The judge of two horizontal directions: friction on the circle, written a second time from `numerics`, section 9.

mod carry_out;
mod compare;
mod decide;
mod guards;
mod path;
mod record;
mod series;
mod solve;
mod state;

pub use compare::{compare_plane, plane_solution_of};
pub use record::PlaneSolution;
pub use solve::solve_plane;
pub(crate) use solve::solve_plane_scaled;
