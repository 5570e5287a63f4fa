//! How long a stretch may be while blocks that move press on stops.

use std::collections::HashMap;

use super::model::Model;
use super::series::MAX_PHASE;
use super::state::State;
use crate::real::Real;

/// The longest stretches, by the blocks that press.
#[derive(Default)]
pub(super) struct Stretches {
    known: HashMap<Vec<usize>, f64>,
}

impl Stretches {
    /// The longest stretch in a state; none where no block that moves presses on a stop, and a whole piece will do.
    pub(super) fn longest<R: Real>(&mut self, model: &Model<R>, state: &State<R>) -> Option<R> {
        let pressing = state.moving_at_stops();
        if pressing.is_empty() {
            return None;
        }
        if let Some(&length) = self.known.get(&pressing) {
            return Some(R::of(length));
        }
        let bound = model.frequency_bound(|j| pressing.contains(&j));
        let length = MAX_PHASE / bound.max(f64::MIN_POSITIVE);
        self.known.insert(pressing, length);
        Some(R::of(length))
    }
}
