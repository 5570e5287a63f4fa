//! What moves: drifts, drift rates and floor accelerations.

use crate::lanes::Padded;

/// Drifts, drift rates, floor accelerations and their rates at an instant, padded with zeros.
#[derive(Debug, Clone)]
pub(crate) struct Kinematics {
    /// Drift of each storey since its spring's base.
    pub(crate) x: Padded,
    /// Drift rate of each storey.
    pub(crate) v: Padded,
    /// Absolute acceleration of each floor.
    pub(crate) a: Padded,
    /// Its rate.
    pub(crate) jerk: Padded,
    /// Second derivative of each drift.
    pub(crate) drift_acceleration: Padded,
    /// With vertical motion: slope of the contact force that the rates of accelerations follow (m/s3).
    pub(crate) jerk_slope: f64,
    /// Whether accelerations and their rates were formed from drifts and drift rates, not taken from a series: that may
    /// be done once, for their errors would add up.
    pub(crate) is_formed: bool,
}

impl Kinematics {
    /// From drifts and drift rates; accelerations are not formed yet.
    pub(crate) fn new(width: usize, x: Padded, v: Padded) -> Self {
        let zero = || Padded::new(width, 0.0);
        Self { x, v, a: zero(), jerk: zero(), drift_acceleration: zero(), jerk_slope: 0.0, is_formed: false }
    }

    /// Velocity of each floor relative to the ground, from the ground upwards.
    pub(crate) fn floor_velocities(&self) -> impl Iterator<Item = f64> {
        self.v.iter().scan(0.0, |velocity, rate| {
            *velocity += rate;
            Some(*velocity)
        })
    }

    /// Forms the drift accelerations of `storeys` from those of the floors and of the ground.
    pub(crate) fn form_drift_accelerations(&mut self, storeys: usize, ground: f64) {
        let mut below = ground;
        for (drift_acceleration, &a) in self.drift_acceleration[..storeys].iter_mut().zip(&self.a) {
            *drift_acceleration = a - below;
            below = a;
        }
    }
}
