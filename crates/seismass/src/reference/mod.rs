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
mod leapfrog;
mod newmark;
mod roots;
mod scheme;
mod stepping;

use thiserror::Error;

use crate::error::Domain;
use crate::scene::{Motion, Scene, SpringLaw};

pub use history::History;

/// A method and its parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Two-stage Gauss-Legendre, the implicit Runge-Kutta method of order 4.
    Gauss {
        /// Steps per sample interval.
        substeps: usize,
        /// Where states are switched.
        events: Events,
    },
    /// Newmark's method with the average acceleration (beta = 1/4, gamma = 1/2), order 2.
    Newmark {
        /// Steps per sample interval.
        substeps: usize,
        /// Where states are switched.
        events: Events,
    },
    /// Newmark's method with the average acceleration and Newton iterations; in place of stick and slip, a stiff
    /// elastic-plastic spring between block and floor, as in finite element programs.
    FrictionSprings {
        /// Steps per sample interval.
        substeps: usize,
        /// Stiffness of a block's spring over that of the storey below its floor (storey 1 for the ground).
        stiffness_ratio: f64,
        /// Newton has converged when no residual force exceeds this fraction of the largest force.
        tolerance: f64,
        /// Newton iterations a step may take.
        max_iterations: usize,
    },
    /// Leapfrog with clipped friction impulses and return mapping of the storey springs, order 2.
    Leapfrog {
        /// Steps per sample interval.
        substeps: usize,
    },
}

/// Where a fixed-step method switches states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Events {
    /// At the end of the step in which a guard fell.
    AtStepEnds,
    /// At the root of the guard: the step is cut there.
    Located {
        /// Tolerance of the root, as a fraction of the step.
        tolerance: f64,
    },
}

/// What stops an integration.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Error {
    /// The scene, the motion or the method was refused, or the response left the range of numbers.
    #[error(transparent)]
    Kernel(#[from] crate::Error),
    /// Newton did not converge within its iterations.
    #[error(
        "Newton did not converge at t = {time} s in {iterations} iterations: residual force {residual} of the largest"
    )]
    NotConverged {
        /// End of the step (s).
        time: f64,
        /// Iterations done.
        iterations: usize,
        /// Largest residual force over the largest force.
        residual: f64,
    },
    /// The equations of an implicit step have no unique solution.
    #[error("the equations of the step from t = {time} s have no unique solution")]
    SingularStep {
        /// Start of the step (s).
        time: f64,
    },
    /// More events within one step than a run may have.
    #[error("more than {limit} events within one step at t = {time} s")]
    TooManyEvents {
        /// Time of the last event (s).
        time: f64,
        /// Bound on the number of events within one step.
        limit: usize,
    },
}

/// Integrates a scene under a motion.
///
/// # Errors
/// [`Error::Kernel`] with [`crate::Error::Invalid`] for a parameter out of its range or a scene the method does not
/// support; the others when the integration cannot go on.
pub fn integrate(scene: &Scene, motion: &Motion, method: &Method) -> Result<History, Error> {
    match *method {
        Method::Gauss { substeps, events } => {
            stepping::integrate(&gauss::Gauss, scene, motion, positive("substeps", substeps)?, checked(events)?)
        }
        Method::Newmark { substeps, events } => {
            stepping::integrate(&newmark::Newmark, scene, motion, positive("substeps", substeps)?, checked(events)?)
        }
        Method::FrictionSprings { substeps, stiffness_ratio, tolerance, max_iterations } => {
            require(
                stiffness_ratio.is_finite() && stiffness_ratio > 0.0,
                "stiffness_ratio",
                "positive",
                stiffness_ratio,
            )?;
            fraction("tolerance", tolerance)?;
            has_plain_laws(scene)?;
            let newton = friction_springs::Newton {
                substeps: positive("substeps", substeps)?,
                stiffness_ratio,
                tolerance,
                max_iterations: positive("max_iterations", max_iterations)?,
            };
            friction_springs::integrate(scene, motion, &newton)
        }
        Method::Leapfrog { substeps } => {
            has_plain_laws(scene)?;
            leapfrog::integrate(scene, motion, positive("substeps", substeps)?)
        }
    }
}

/// Refuses springs that are not trilinear and friction that changes with slip, which return mapping here does not know.
fn has_plain_laws(scene: &Scene) -> Result<(), Error> {
    let storeys = scene.building().map_or(&[][..], |building| building.storeys());
    let other = storeys.iter().position(|storey| storey.law != SpringLaw::Trilinear);
    let got = other.map_or(String::new(), |i| format!("another law in storey {}", i + 1));
    require(other.is_none(), "springs", "trilinear for a method with return mapping", got)?;
    let worn = scene.blocks().iter().position(|block| !block.wear.is_empty());
    let got = worn.map_or(String::new(), |j| format!("wear of block {}", j + 1));
    require(worn.is_none(), "friction", "without wear for a method with return mapping", got)
}

fn require(ok: bool, parameter: &str, requirement: &str, value: impl ToString) -> Result<(), Error> {
    if ok {
        return Ok(());
    }
    Err(crate::Error::invalid(Domain::Options, parameter, "reference integrator", requirement, value).into())
}

fn positive(parameter: &str, value: usize) -> Result<usize, Error> {
    require(value >= 1, parameter, "at least 1", value).map(|()| value)
}

fn fraction(parameter: &str, value: f64) -> Result<(), Error> {
    require(value > 0.0 && value < 1.0, parameter, "between 0 and 1, both excluded", value)
}

fn checked(events: Events) -> Result<Events, Error> {
    if let Events::Located { tolerance } = events {
        fraction("tolerance", tolerance)?;
    }
    Ok(events)
}
