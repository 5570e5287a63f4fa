//! `seismass`: exact simulation of yielding shear buildings whose floors carry sliding rigid blocks.

pub mod batch;
mod bernstein;
pub mod damping;
pub mod error;
mod events;
mod friction;
mod model;
mod observe;
mod plain_step;
mod propagator;
mod regime;
pub mod response;
pub mod scene;
pub mod simulate;
pub mod spectrum;
mod state;
mod storey;
mod taylor;

pub use batch::{Control, simulate_many};
pub use error::{Domain, Error, Result};
pub use response::{
    Energy, Event, EventCounts, EventKind, Histories, Peak, Peaks, Response, Skipped, Statistics, Status,
};
pub use scene::{Block, Building, Damping, GravityEffect, Motion, Options, Scene, Storey};
pub use simulate::{simulate, simulate_until};

/// Standard gravity (m/s2), the g of every number in this crate.
pub const STANDARD_GRAVITY: f64 = 9.806_65;
