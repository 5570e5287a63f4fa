//! Random scenes of the general engine: every run checked by itself, some of them against its judge, and random shear
//! buildings solved by both engines; in two directions the same of scenes in the plane.

mod backward_error;
mod before_stops;
mod chains;
mod changed;
mod examine;
mod invariants;
mod one_direction;
mod plane_invariants;
mod report;
mod slow_touches;
mod subject;
mod tally;
mod tally_file;
mod two_directions;
mod verdict;

pub use chains::{Chains, compare_engines};
pub use examine::LARGEST_DIVISION;
pub use report::{distribution, page};
pub use tally::{Directions, GeneralTally};
