//! Errors of the kernel, as data: which parameter of what must be what, or what happened when and where.

use std::any::Any;

use thiserror::Error;

/// What an invalid parameter belongs to; decides which exception Python raises.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Domain {
    /// Building, blocks and their initial state.
    Scene,
    /// Ground motion samples and time step.
    Motion,
    /// Options of a run, a batch or a spectrum.
    Options,
}

/// Everything that can go wrong in the kernel.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// An input was refused before anything ran.
    #[error("{parameter} of {owner} must be {requirement}; got {value}")]
    Invalid {
        /// What the parameter belongs to.
        domain: Domain,
        /// Name of the parameter, as the user wrote it.
        parameter: String,
        /// The thing that has the parameter: "block 2", "storey 1", "motion".
        owner: String,
        /// What the parameter must be.
        requirement: String,
        /// What it was.
        value: String,
    },
    /// More events within one sample interval than a run may have: the run was stopped.
    #[error(
        "more than {limit} events between two samples at t = {time} s; the last was {event} of {element} ({state})"
    )]
    TooManyEvents {
        /// Time of the last event (s).
        time: f64,
        /// Bound on the number of events within one sample interval.
        limit: usize,
        /// Kind of the last event.
        event: &'static str,
        /// "storey 2" or "block 1".
        element: String,
        /// Its state after the event.
        state: String,
    },
    /// The stiffest vibration turns far too often between two samples: the run was not begun, or stopped.
    #[error(
        "{phase:.3e} radians of the stiffest vibration between two samples at t = {time} s, of which {limit} can be \
         solved: take a shorter time step or softer storeys"
    )]
    TooStiff {
        /// Start of the sample interval, or of the substep of it (s).
        time: f64,
        /// Circular frequency times sample interval.
        phase: f64,
        /// Most that is solved.
        limit: f64,
    },
    /// The state grew beyond what a double can hold.
    #[error("the response left the range of numbers at t = {time} s in {element}")]
    NotFinite {
        /// Time at which a value was found not to be finite (s).
        time: f64,
        /// "storey 2", "block 1" or "the building".
        element: String,
    },
    /// The kernel stopped on a defect of its own: never the user's fault.
    #[error("the kernel stopped on a defect of seismass, please report it: {reason}")]
    Defect {
        /// What the panic said.
        reason: String,
    },
    /// The caller asked to stop.
    #[error("interrupted")]
    Interrupted,
}

impl Error {
    /// The defect that a panic's payload tells of.
    pub fn of_panic(payload: &(dyn Any + Send)) -> Self {
        let reason = payload
            .downcast_ref::<String>()
            .map(String::as_str)
            .or_else(|| payload.downcast_ref::<&str>().copied())
            .unwrap_or("no message");
        Self::Defect { reason: reason.to_owned() }
    }

    /// An invalid parameter: *parameter* of *owner* must be *requirement*; got *value*.
    pub fn invalid(
        domain: Domain,
        parameter: impl Into<String>,
        owner: impl Into<String>,
        requirement: impl Into<String>,
        value: impl ToString,
    ) -> Self {
        Self::Invalid {
            domain,
            parameter: parameter.into(),
            owner: owner.into(),
            requirement: requirement.into(),
            value: value.to_string(),
        }
    }
}

/// Result of the kernel.
pub type Result<T> = std::result::Result<T, Error>;
