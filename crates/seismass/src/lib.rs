//! Exact simulation of yielding shear buildings whose floors carry rigid blocks that stick and slide by friction.
//!
#![doc = include_str!("../README.md")]
//!
//! # Model
//!
//! Floor i has mass m_i and velocity v_i relative to the ground, storey i the spring force F_i; block j on it has mass
//! m_j, velocity w_j and friction f_j (Smith-Pardo, Reyes et al., 16WCEE, Eq. 1):
//!
//! ```text
//! floor i:  m_i (v_i' + a_g) = -(C v)_i - (F_i - F_(i+1)) + sum of f_j over its blocks
//! block j:  m_j (w_j' + a_g) = -f_j
//! ```
//!
//! A sliding block has f_j = mu_k m_j (g + a_v) sign(w_j - v_i); a stuck one moves with its floor while the floor's
//! absolute acceleration is at most mu_s (g + a_v) (Eq. 2, read with absolute values). Springs are piecewise linear:
//! trilinear with Masing unloading (Fig. 3), or of another [`SpringLaw`]. SI units throughout; g is [`STANDARD_GRAVITY`];
//! floors, storeys and blocks count from 1 in everything a user reads, and from 0 in arrays.
//!
//! # Method
//!
//! Each storey spring and each block is a small state machine. While none of them changes state, the system is linear
//! and the motion is linear between samples, so the step is solved in closed form: by a propagator of the regime (the
//! tuple of states) over a whole sample interval, or by the Taylor series of the solution, taken to rounding. A plain
//! step is accepted only when bounds prove that no guard of any machine fell inside it; otherwise the guards'
//! polynomials are searched by their Bernstein coefficients, and the first root over all of them is refined to rounding.
//!
//! # Limitation
//!
//! Blocks slide and do not rock; motion is in one horizontal direction; contact is lost and regained with the sign of
//! g + a_v, without flight. Where two guards fall closer together than rounding, or a guard only just touches zero, the
//! branch taken is decided by rounding, as it would be in nature by less.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod batch;
mod classes;
pub mod error;
mod events;
mod lanes;
mod machines;
mod memory;
mod plain;
mod polynomial;
mod record;
pub mod reference;
mod regime;
pub mod response;
mod run;
pub mod scene;
pub mod spectrum;
mod state;
mod step;
mod threads;
mod tolerances;
mod units;

pub use batch::{Run, simulate_each, simulate_many};
pub use error::{Domain, Error, Result};
pub use lanes::InstructionSet;
pub use machines::spring_path::{SpringEvent, SpringPath, spring_path};
pub use response::{
    Energy, Event, EventCounts, EventKind, Histories, Peak, Peaks, Response, Skipped, Statistics, Status,
};
pub use run::{simulate, simulate_until};
pub use scene::{
    Block, Building, Damping, GravityEffect, MAX_SAMPLES, MAX_STOREYS, Motion, Options, PeakOriented, Scene,
    SceneColumns, SpringLaw, Storey, UniformBuilding, Wear,
};
pub use threads::Control;
pub use units::STANDARD_GRAVITY;

/// The crate of linear algebra whose matrices stand in [`Damping`], [`StoreyDamping`](scene::StoreyDamping) and
/// [`Building::damping_matrix`], in the version that they are of.
pub use nalgebra;
