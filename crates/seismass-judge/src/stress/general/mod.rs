//! Random scenes of the general engine: every run checked by itself, some of them against its judge, and random shear
//! buildings solved by both engines.

mod backward_error;
mod chains;
mod examine;
mod invariants;
mod report;
mod tally;
mod tally_file;
mod verdict;

pub use chains::{Chains, compare_engines};
pub use examine::LARGEST_DIVISION;
pub use report::{distribution, page};
pub use tally::GeneralTally;
