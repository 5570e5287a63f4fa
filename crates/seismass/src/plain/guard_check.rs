//! The check of the guards of a step that the loop of plain steps does not clear.
//!
//! A step in which no guard falls is plain whatever peaks it beats: those at its end are kept, in vectors, until they are
//! taken; where a drift or an acceleration turns beyond its peak inside the step, the step's series gives the extreme.

use crate::lanes::{ALL_LANES, Set, Vector, WIDTH, load};
use crate::polynomial::enclosure::{THIRD, distance_against, largest_distance, off_cubic, ranges, signs};
use crate::state::limits::{Bounds, BoundsInLanes};
use crate::state::sample::Sample;

/// What the check of a step finds that the loop did not clear.
pub(crate) struct GuardCheck<V, const K: usize> {
    /// Whether a guard may fall.
    pub(crate) fails: bool,
    /// Storeys and floors whose peaks of drift or shear and of acceleration the end of the step may beat.
    pub(crate) beaten: [Set; 2],
    /// Those that may turn beyond their peaks inside the step.
    pub(crate) turns: [Set; 2],
    /// Storeys and floors whose drifts, drift rates and accelerations come to their bounds, and the ranges of these.
    pub(crate) near_bound: [Set; 3],
    pub(crate) ranges: [[[V; K]; 2]; 3],
}

impl<V: Vector, const K: usize> GuardCheck<V, K> {
    /// Looks at what the loop did not clear in a step by the Bezier points themselves. Margins are per unit of `norm`;
    /// `bounds` are those of the run, `in_state` those that the state has.
    #[inline(always)]
    pub(crate) fn look(
        near_bound: [Set; 3],
        bounds: &BoundsInLanes<V, K>,
        in_state: &Bounds,
        [before, after]: [&Sample<V, K>; 2],
        (norm, margins): (V, &[[V; K]; 4]),
        h: f64,
        least_contact: V,
    ) -> Self {
        let (zero, third) = (V::splat(0.0), V::splat(h * THIRD));
        let (lowest, highest): ([V; K], [V; K]) = (load(&in_state.guarded[0]), load(&in_state.guarded[1]));
        // Between its ends a jerk differs from its chord by at most h^2 / 8 times its second derivative.
        let chord = V::splat(0.125 * h * h / off_cubic(h));
        let mut guard_check =
            Self { fails: false, beaten: [0; 2], turns: [0; 2], near_bound: [0; 3], ranges: [[[zero; K]; 2]; 3] };
        for k in 0..K {
            let lanes = WIDTH * k;
            let of = [near_bound[0] >> lanes, near_bound[1] >> lanes, near_bound[2] >> lanes];
            let of = [of[0] as u32 & ALL_LANES, of[1] as u32 & ALL_LANES, of[2] as u32 & ALL_LANES];
            // Rates keep the signs that they must keep: those of plastic storeys, and where a peak is followed.
            let (start, end) = ([before.v[k], before.q[k]], [after.v[k], after.q[k]]);
            let rate = ranges(start, end, third, norm.mul(margins[1][k]));
            let turning = of[1] & distance_against(rate, bounds.sign[k]).not_below(bounds.turn[k]);
            // Drifts come to no guard; they beat no peak, or at the end of the step.
            let (start, end) = ([before.x[k], before.v[k]], [after.x[k], after.v[k]]);
            let drift = ranges(start, end, third, norm.mul(margins[0][k]));
            let beaten = of[0] & largest_distance(drift, bounds.middle[k]).not_below(bounds.reach[k]);
            let guarded = drift.1.not_below(highest[k]) | lowest[k].not_below(drift.0);
            let (forward, backward) = signs(rate);
            let steady = forward | backward;
            let plastic = in_state.plastic_in::<V, K>(k);
            guard_check.fails |= (beaten | turning) & guarded | turning & plastic != 0;
            guard_check.beaten[0] |= Set::from(beaten) << lanes;
            guard_check.turns[0] |= Set::from(turning & !plastic | beaten & !steady) << lanes;
            // The same of accelerations.
            let (start, end) = ([before.a[k], before.jerk[k]], [after.a[k], after.jerk[k]]);
            let (low, high) = ranges(start, end, third, norm.mul(margins[2][k]));
            let size = high.max(zero.sub(low));
            let breaks = size.not_below(bounds.stuck_mu[k].mul(least_contact));
            let beaten = of[2] & size.not_below(bounds.a_peak[k]);
            let (jerk, jerk_after) = (before.jerk[k], after.jerk[k]);
            let turn = norm.mul(margins[3][k]).mul(chord);
            let steady = !zero.not_below(jerk.mul(jerk_after)) & !turn.not_below(jerk.abs().min(jerk_after.abs()));
            guard_check.fails |= of[2] & breaks != 0;
            guard_check.beaten[1] |= Set::from(beaten) << lanes;
            guard_check.turns[1] |= Set::from(beaten & !steady) << lanes;
            guard_check.near_bound[1] |= Set::from(turning) << lanes;
            guard_check.near_bound[2] |= Set::from(beaten | of[2] & breaks) << lanes;
            for (out, (low, high)) in guard_check.ranges.iter_mut().zip([drift, rate, (low, high)]) {
                (out[0][k], out[1][k]) = (low, high);
            }
        }
        guard_check.near_bound[0] = guard_check.beaten[0];
        guard_check
    }
}
