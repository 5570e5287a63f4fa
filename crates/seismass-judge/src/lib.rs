//! The judge of the fast kernel: the same model written a second time, plainly, in any precision.
//!
//! Nothing is cached, skipped or carried over from one step to the next but the state. Every sample interval is cut
//! into pieces on which the Taylor series of the linear system converges to rounding; the series are polynomials, so
//! every guard is one, and its first fall is isolated in Bernstein form. Only the numbers of the scene (damping
//! operator, P/h) are taken from the kernel, so that both solve the same problem.
//!
//! # Example
//! ```
//! use seismass::{Block, Motion, Scene};
//! use seismass_judge::{DoubleDouble, solve};
//!
//! // 5 m/s2 for one second under a block with mu g = 1.96133 m/s2: its slip is -(5 - mu g) / 2.
//! let scene = Scene::new(None, vec![Block::new(0, 1.0, 0.2)]).unwrap();
//! let motion = Motion::new(vec![5.0; 101], 0.01, None).unwrap();
//! let solution = solve::<DoubleDouble>(&scene, &motion, 1).unwrap();
//! assert!((solution.residual_slip[0] + 0.5 * (5.0 - 0.2 * 9.80665)).abs() < 1e-15);
//! ```

mod compare;
mod events;
pub mod general;
pub mod general_scene;
pub mod law_scene;
mod model;
pub mod plane_scene;
mod polynomial;
pub mod portable_scene;
pub mod random_scene;
mod real;
mod record;
pub mod scene_text;
mod series;
mod sign;
mod solve;
mod springs;
mod state;
pub mod stress;

pub use compare::{Comparison, compare, compare_events, larger};
pub use real::{DoubleDouble, Real};
pub use record::Solution;
pub use solve::{JudgeError, solve};
