//! Storeys as lanes of vectors, and the instructions the hot loops may use for them.

mod aligned;
mod arrays;
pub(crate) mod instructions;
mod padded;
pub(crate) mod plain;
mod set;
mod symmetric;
pub(crate) mod vector;
pub(crate) mod width;
#[cfg(target_arch = "x86_64")]
pub(crate) mod x86;

pub(crate) use aligned::{Aligned, OnLine};
pub(crate) use arrays::{at, columns_of, differences, lanes, lanes_mut, load, numbers, prefix_sums, store, unit};
pub use instructions::InstructionSet;
pub(crate) use instructions::for_each_path;
pub(crate) use padded::{OfStorey, Padded, PaddedRows, vector_of};
pub(crate) use plain::Plain;
pub(crate) use set::{Set, first_members, members, spread};
pub(crate) use symmetric::Symmetric;
pub(crate) use vector::{ALL_LANES, Vector, WIDTH};
pub(crate) use width::{FAR, MAX_DENSE, MAX_LANES, WIDEST, by_dense_width, by_width, filled, filled_to, padded};
