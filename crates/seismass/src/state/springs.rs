//! The springs of a state, and what the present segments give to the hot loops.

use crate::lanes::{Padded, Vector};
use crate::machines::model::Model;
use crate::machines::storey::StoreySpring;

/// The machines of the storey springs, and the numbers of their present segments, padded with zeros.
pub(crate) struct Springs {
    pub(crate) machines: Vec<StoreySpring>,
    /// Drift coordinates at which the segment of each storey's spring ends.
    pub(crate) segment_ends: Vec<(f64, f64)>,
    /// Drift coordinates at which each storey collapses.
    pub(crate) collapse_bounds: Vec<(f64, f64)>,
    /// Drift of each storey at its spring's base.
    pub(crate) base_drift: Padded,
    /// Spring force of each storey at its base (N).
    pub(crate) base_force: Padded,
    /// The same less P-Delta (N).
    pub(crate) base_load: Padded,
    /// Force of the springs at their bases on each floor (N).
    pub(crate) load: Padded,
}

impl Springs {
    /// Virgin springs; the numbers of their segments are not formed yet.
    pub(crate) fn new(model: &Model) -> Self {
        let (n, zero) = (model.storeys(), || Padded::new(model.width, 0.0));
        let far = || vec![(f64::NEG_INFINITY, f64::INFINITY); n];
        Self {
            machines: model.laws.iter().map(StoreySpring::new).collect(),
            segment_ends: far(),
            collapse_bounds: far(),
            base_drift: zero(),
            base_force: zero(),
            base_load: zero(),
            load: zero(),
        }
    }

    /// Follows the spring of storey `i` onto its present segment.
    #[inline(always)]
    pub(crate) fn follow<V: Vector, const K: usize>(&mut self, model: &Model, i: usize) {
        let (spring, law) = (&self.machines[i], &model.laws[i]);
        let segment = *spring.segment();
        self.segment_ends[i] = segment.ends;
        let (limit, base) = (law.collapse_drift, segment.base_drift);
        self.collapse_bounds[i] = (-limit - base, limit - base);
        self.base_drift.set_lane::<V, K>(i, base);
        self.base_force.set_lane::<V, K>(i, segment.base_force);
        self.base_load.set_lane::<V, K>(i, spring.base_load(law));
    }

    /// Forms the loads of the floors from the forces at the bases, of `vectors` vectors.
    #[inline(always)]
    pub(crate) fn form_loads<V: Vector, const K: usize>(&mut self, vectors: usize) {
        let mut above = V::splat(0.0);
        for k in (0..vectors).rev() {
            let base = self.base_load.vector::<V, K>(k);
            self.load.set_vector::<V, K>(k, base.shifted_down(above).sub(base));
            above = base;
        }
    }

    /// Drift coordinates of a storey between which it does not yield or collapse.
    #[inline]
    pub(crate) fn guarded_drift(&self, i: usize) -> (f64, f64) {
        let (yields, collapses) = (self.segment_ends[i], self.collapse_bounds[i]);
        (yields.0.max(collapses.0), yields.1.min(collapses.1))
    }
}
