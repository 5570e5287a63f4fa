//! Integrators of the same scenes and motions by time steps, for comparison with the exact solution and never the
//! default: what engineers run, and what locating events is worth.
//!
//! # Method
//!
//! [`Method::Gauss`] and [`Method::Newmark`] use the state machines of the exact solution and differ from it in the
//! integration alone; they switch states at the ends of steps, or where they locate events on the solution of the step.
//! [`Method::FrictionSprings`] and [`Method::Leapfrog`] know no events. All steps are equal: the record's step over a
//! whole number, so that the motion is linear inside each.
//!
//! ```
//! use seismass::reference::{Events, Method, integrate};
//! use seismass::{Block, Motion, Scene};
//!
//! # fn main() -> Result<(), seismass::reference::Error> {
//! let scene = Scene::new(None, vec![Block::new(0, 1000.0, 0.3)])?;
//! let motion = Motion::new(vec![4.0; 101], 0.01, None)?;
//! let slip = 0.5 * (4.0 - 0.3 * seismass::STANDARD_GRAVITY);
//! let gauss = Method::Gauss { substeps: 1, events: Events::Located { tolerance: 1e-12 } };
//! assert!((integrate(&scene, &motion, &gauss)?.peak_slip[0] - slip).abs() < 1e-12);
//! let leapfrog = integrate(&scene, &motion, &Method::Leapfrog { substeps: 10 })?;
//! assert!((leapfrog.peak_slip[0] - slip).abs() < 1e-12);
//! # Ok(())
//! # }
//! ```
//!
//! # Limitation
//!
//! Two guards that fall and recover within one step are not seen. The springs of [`Method::FrictionSprings`] need
//! mu_s = mu_k, and a building. [`Method::Leapfrog`] needs steps below its limit of stability.

mod clipping;
mod friction_springs;
mod gauss;
mod guards;
mod history;
mod integrate;
mod leapfrog;
mod method;
mod newmark;
mod roots;
mod scheme;
mod stepping;

pub use history::History;
pub use integrate::integrate;
pub use method::{Error, Events, Method};
