//! Methods, their options, and what they refuse.

use thiserror::Error;

use crate::error::Domain;
use crate::scene::{Scene, SpringLaw};

/// A method and its parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
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
#[non_exhaustive]
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

/// Refuses springs that are not trilinear and friction that changes with slip, which return mapping here does not know.
pub(super) fn has_plain_laws(scene: &Scene) -> Result<(), Error> {
    let storeys = scene.building().map_or(&[][..], |building| building.storeys());
    let other = storeys.iter().position(|storey| storey.law != SpringLaw::Trilinear);
    let got = other.map_or(String::new(), |i| format!("another law in storey {}", i + 1));
    require(other.is_none(), "springs", "trilinear for a method with return mapping", got)?;
    let worn = scene.blocks().iter().position(|block| !block.wear.is_empty());
    let got = worn.map_or(String::new(), |j| format!("wear of block {}", j + 1));
    require(worn.is_none(), "friction", "without wear for a method with return mapping", got)
}

pub(super) fn require(ok: bool, parameter: &str, requirement: &str, value: impl ToString) -> Result<(), Error> {
    if ok {
        return Ok(());
    }
    Err(crate::Error::invalid(Domain::Options, parameter, "reference integrator", requirement, value).into())
}

pub(super) fn positive(parameter: &str, value: usize) -> Result<usize, Error> {
    require(value >= 1, parameter, "at least 1", value).map(|()| value)
}

pub(super) fn fraction(parameter: &str, value: f64) -> Result<(), Error> {
    require(value > 0.0 && value < 1.0, parameter, "between 0 and 1, both excluded", value)
}

pub(super) fn checked(events: Events) -> Result<Events, Error> {
    if let Events::Located { tolerance } = events {
        fraction("tolerance", tolerance)?;
    }
    Ok(events)
}
