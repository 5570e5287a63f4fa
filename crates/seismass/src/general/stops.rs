//! The contact of a block with its stops as a state machine (`numerics`, section 9.3).

use crate::machines::sign::Sign;
use crate::scene::Stops;

/// Where a block is between its stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Contact {
    /// Within the clearance.
    Free,
    /// At the stop of this side: the contact force k e + c e' is not negative.
    Touching(Sign),
    /// Beyond the clearance without a force: the damper would have to pull.
    Parted(Sign),
}

/// A contact in motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StopMotion {
    pub(super) contact: Contact,
    /// Slip beyond the clearance (m), with the sign of the side; zero while free.
    pub(super) beyond: f64,
}

impl StopMotion {
    pub(super) fn free() -> Self {
        Self { contact: Contact::Free, beyond: 0.0 }
    }

    /// The side that touches.
    #[inline]
    pub(super) fn touching(&self) -> Option<Sign> {
        match self.contact {
            Contact::Touching(side) => Some(side),
            _ => None,
        }
    }

    /// Force of the stop on the block at a relative velocity (N).
    #[inline]
    pub(super) fn force(&self, stops: Option<&Stops>, velocity: f64) -> f64 {
        match (self.contact, stops) {
            (Contact::Touching(_), Some(stops)) => -(stops.stiffness * self.beyond + stops.damping * velocity),
            _ => 0.0,
        }
    }

    /// Energy that the stop stores (J).
    pub(super) fn stored(&self, stops: Option<&Stops>) -> f64 {
        match (self.contact, stops) {
            (Contact::Touching(_), Some(stops)) => 0.5 * stops.stiffness * self.beyond * self.beyond,
            _ => 0.0,
        }
    }

    /// Changes the penetration, where there is one.
    #[inline]
    pub(super) fn move_by(&mut self, slip: f64) {
        if self.contact != Contact::Free {
            self.beyond += slip;
        }
    }
}

/// Slip at which the stop of a side touches, with its sign (m).
#[inline]
pub(super) fn place_of(stops: &Stops, side: Sign) -> f64 {
    match side {
        Sign::Positive => stops.clearance[1],
        Sign::Negative => -stops.clearance[0],
    }
}
