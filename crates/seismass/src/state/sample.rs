//! The state at a sample, in vectors.

use crate::lanes::{Vector, load, store};
use crate::state::State;

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
    pub(crate) fn of(state: &State) -> Self {
        Self {
            x: load(&state.x),
            v: load(&state.v),
            a: load(&state.a),
            jerk: load(&state.jerk),
            q: load(&state.drift_acceleration),
        }
    }

    #[inline(always)]
    pub(crate) fn put_into(&self, state: &mut State) {
        store(&self.x, &mut state.x);
        store(&self.v, &mut state.v);
        store(&self.a, &mut state.a);
        store(&self.jerk, &mut state.jerk);
        store(&self.q, &mut state.drift_acceleration);
    }
}
