//! What drives a step, and the state at its start.

use crate::lanes::Padded;

/// What drives the system in a step, linear in time: ground acceleration, contact force and floor loads.
#[derive(Debug, Clone, Default)]
pub(crate) struct Drive {
    /// Ground acceleration at the start (m/s2).
    pub(crate) ground: f64,
    /// Its slope (m/s3).
    pub(crate) ground_slope: f64,
    /// Contact force per unit mass at the start as the blocks feel it (m/s2): zero while airborne.
    pub(crate) contact: f64,
    /// Its slope (m/s3).
    pub(crate) contact_slope: f64,
    /// Force on each floor at the start, beside x, v and their products (N).
    pub(crate) load: Padded,
    /// Its slope (N/s).
    pub(crate) load_slope: Padded,
}

impl Drive {
    /// The least contact force per unit mass within `h` (m/s2).
    #[inline]
    pub(crate) fn least_contact(&self, h: f64) -> f64 {
        self.contact.min(self.contact + self.contact_slope * h).max(0.0)
    }
}

/// The state at the start of a step: drifts, drift rates, floor accelerations and their rates, padded.
#[derive(Clone, Copy)]
pub(crate) struct StepStart<'a> {
    pub(crate) x: &'a Padded,
    pub(crate) v: &'a Padded,
    pub(crate) a: &'a Padded,
    pub(crate) jerk: &'a Padded,
}
