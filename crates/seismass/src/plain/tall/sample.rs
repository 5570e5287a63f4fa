//! The state of a tall building at a sample.

use crate::lanes::filled_to;
use crate::state::State;

/// The state at a sample.
pub(crate) struct TallSample {
    pub(crate) x: Vec<f64>,
    pub(crate) v: Vec<f64>,
    /// Floor accelerations, that of the ground before them.
    pub(crate) a: Vec<f64>,
    /// Their rates, after a place for that of the ground.
    pub(crate) jerk: Vec<f64>,
    /// Drift accelerations, with room for the band before and after them.
    pub(crate) q: Vec<f64>,
}

impl TallSample {
    pub(crate) fn new(state: &State, length: usize, margin: usize) -> Self {
        let n = state.storeys();
        let lanes = |values: &[f64]| filled_to(length, values[..n].iter().copied(), 0.0);
        let mut q = vec![0.0; length + 2 * margin];
        q[margin..margin + n].copy_from_slice(&state.kinematics.drift_acceleration[..n]);
        let floors =
            |values: &[f64]| filled_to(length + 1, std::iter::once(0.0).chain(values[..n].iter().copied()), 0.0);
        Self {
            x: lanes(&state.kinematics.x),
            v: lanes(&state.kinematics.v),
            a: floors(&state.kinematics.a),
            jerk: floors(&state.kinematics.jerk),
            q,
        }
    }

    /// Puts the sample into the state.
    pub(crate) fn put(&self, state: &mut State, margin: usize) {
        let n = state.storeys();
        state.kinematics.x[..n].copy_from_slice(&self.x[..n]);
        state.kinematics.v[..n].copy_from_slice(&self.v[..n]);
        state.kinematics.a[..n].copy_from_slice(&self.a[1..=n]);
        state.kinematics.jerk[..n].copy_from_slice(&self.jerk[1..=n]);
        state.kinematics.drift_acceleration[..n].copy_from_slice(&self.q[margin..margin + n]);
    }
}
