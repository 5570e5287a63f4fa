//! Checks of input, and how they name what they refuse.

use std::fmt::{Display, Formatter};

use crate::error::{Domain, Error, Result};

/// A storey, floor or block by its index, named by its number where an error is written: a grid has a scene per row,
/// and names formed in advance would cost more than its checks.
#[derive(Clone, Copy)]
pub(crate) struct Nth(pub(crate) &'static str, pub(crate) usize);

impl Display for Nth {
    fn fmt(&self, out: &mut Formatter) -> std::fmt::Result {
        write!(out, "{} {}", self.0, self.1 + 1)
    }
}

pub(crate) fn check(
    ok: bool,
    parameter: &str,
    owner: impl Display,
    requirement: impl Display,
    value: f64,
) -> Result<()> {
    if ok { Ok(()) } else { Err(refusal(parameter, &owner, &requirement, value)) }
}

#[cold]
fn refusal(parameter: &str, owner: &dyn Display, requirement: &dyn Display, value: f64) -> Error {
    Error::invalid(Domain::Scene, parameter, owner.to_string(), requirement.to_string(), value)
}

pub(crate) fn check_length(parameter: &str, owner: &str, expected: usize, of: &str, got: usize) -> Result<()> {
    if expected == got {
        Ok(())
    } else {
        Err(Error::invalid(
            Domain::Scene,
            parameter,
            owner,
            format!("a list of {expected} values, one per {of}"),
            format!("{got} values"),
        ))
    }
}
