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
//! # Racks, walls and stops
//!
//! What a chain of storeys does not describe is a [`GeneralScene`]: racks on floors, an elastic matrix beside the storeys,
//! stops on the slip of goods. [`simulate_general`] solves it by an engine of its own, as exactly.
//!
//! ```
//! use std::sync::Arc;
//! use seismass::{
//!     Block, GeneralBuilding, GeneralScene, Goods, Motion, Options, Stops, UniformBuilding, simulate_general,
//! };
//!
//! # fn main() -> seismass::Result<()> {
//! let building = UniformBuilding { storeys: 3, period: 0.60, mass: 1000.0, ..Default::default() }.build()?;
//! let goods = Goods { block: Block::new(3, 500.0, 0.1), stops: Some(Stops::new(0.01, 1e5)) };
//! let scene = GeneralScene::new(Some(Arc::new(GeneralBuilding::from(&building))), vec![goods], Vec::new())?;
//! let samples: Vec<f64> = (0..1000).map(|i| 4.0 * (0.1 * f64::from(i)).sin()).collect();
//! let response = simulate_general(&scene, &Motion::new(samples, 0.01, None)?, &Options::default())?;
//! assert!(response.peaks.contact_force[0].value > 0.0);
//! # Ok(())
//! # }
//! ```
//!
//! # Two horizontal directions
//!
//! A [`PlaneScene`] is what a scene is in x and in y, a [`PlaneMotion`] the motion in both. [`simulate_plane`] solves it with
//! friction on the circle, as exactly.
//!
//! ```
//! use seismass::{Block, GeneralScene, Motion, Options, PlaneMotion, PlaneScene, simulate_plane};
//!
//! # fn main() -> seismass::Result<()> {
//! let crate_on_ground = GeneralScene::new(None, vec![Block::new(0, 100.0, 0.1).into()], Vec::new())?;
//! let scene = PlaneScene::new(crate_on_ground.clone(), crate_on_ground)?;
//! let motion = PlaneMotion::new(Motion::new(vec![3.0; 11], 0.01, None)?, vec![4.0; 11])?;
//! let response = simulate_plane(&scene, &motion, &Options::default())?;
//! // Against an acceleration of 5 m/s2 along (3, 4), by (5 - mu g) t^2 / 2.
//! let slip = 0.5 * (5.0 - 0.980665) * 0.01;
//! assert!((response.peaks.vector.slip[0].value - slip).abs() < 1e-15);
//! # Ok(())
//! # }
//! ```
//!
//! # Limitation
//!
//! Blocks slide and do not rock; contact is lost and regained with the sign of
//! g + a_v, without flight. Where two guards fall closer together than rounding, or a guard only just touches zero, the
//! branch taken is decided by rounding, as it would be in nature by less.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod batch;
mod classes;
pub mod error;
mod events;
mod general;
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

pub use batch::{Run, simulate_each, simulate_general_each, simulate_many, simulate_plane_each};
pub use error::{Domain, Error, Result};
pub use general::{
    Axis, GeneralBase, GeneralEnergy, GeneralEvent, GeneralPeaks, GeneralResponse, GeneralStatus, PlaneEnergy,
    PlaneEvent, PlanePeaks, PlaneResponse, VectorPeaks, simulate_general, simulate_general_until, simulate_plane,
    simulate_plane_until,
};
pub use lanes::InstructionSet;
pub use machines::spring_path::{SpringEvent, SpringPath, spring_path};
pub use response::{
    Energy, Event, EventCounts, EventKind, Histories, Peak, Peaks, Response, Skipped, Statistics, Status,
};
pub use run::{simulate, simulate_until};
pub use scene::{
    Block, Building, Damping, GeneralBuilding, GeneralScene, Goods, GravityEffect, MAX_SAMPLES, MAX_STOREYS, Motion,
    Options, PeakOriented, PlaneMotion, PlaneScene, Rack, Scene, SceneColumns, SlidingBase, SpringLaw, Stops, Storey,
    UniformBuilding, Wear,
};
pub use threads::Control;
pub use units::STANDARD_GRAVITY;

/// The crate of linear algebra whose matrices stand in [`Damping`], [`StoreyDamping`](scene::StoreyDamping) and
/// [`Building::damping_matrix`], in the version that they are of.
pub use nalgebra;
