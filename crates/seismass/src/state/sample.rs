//! The state at a sample, in vectors.

use crate::lanes::{Vector, load, store};
use crate::state::kinematics::Kinematics;

/// The state at a sample: drifts, drift rates, floor accelerations, their rates, and drift accelerations.
#[derive(Clone, Copy)]
pub(crate) struct Sample<V, const K: usize> {
    pub(crate) x: [V; K],
    pub(crate) v: [V; K],
    pub(crate) a: [V; K],
    pub(crate) jerk: [V; K],
    pub(crate) q: [V; K],
}

impl<V: Vector, const K: usize> Sample<V, K> {
    #[inline(always)]
    pub(crate) fn of(kinematics: &Kinematics) -> Self {
        Self {
            x: load(&kinematics.x),
            v: load(&kinematics.v),
            a: load(&kinematics.a),
            jerk: load(&kinematics.jerk),
            q: load(&kinematics.drift_acceleration),
        }
    }

    #[inline(always)]
    pub(crate) fn put_into(&self, kinematics: &mut Kinematics) {
        store(&self.x, &mut kinematics.x);
        store(&self.v, &mut kinematics.v);
        store(&self.a, &mut kinematics.a);
        store(&self.jerk, &mut kinematics.jerk);
        store(&self.q, &mut kinematics.drift_acceleration);
    }
}
