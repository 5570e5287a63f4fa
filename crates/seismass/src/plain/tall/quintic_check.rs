//! The check of a step of a tall regime that the loop does not clear, by quintics.

use crate::lanes::{Vector, WIDTH, at};
use crate::plain::sliding::FloorBlock;
use crate::plain::tall::bounds::TallBounds;
use crate::plain::tall::norms::{Norms, RegimeRows};
use crate::plain::tall::sample::TallSample;
use crate::polynomial::enclosure::{THIRD, off_cubic, off_quintic, quintic_range, quintic_ranges, ranges, signs};
use crate::regime::operator_long::LongOperator;
use crate::tolerances::SMALL_DIFFERENCE;

/// Storeys and floors of a vector whose peaks a step beats, as bits of the lanes: at all; inside, where drifts and
/// accelerations turn.
pub(crate) struct NewPeaksOfVector {
    pub(crate) vector: usize,
    pub(crate) drifts: u32,
    pub(crate) accelerations: u32,
    pub(crate) drifts_inside: u32,
    pub(crate) accelerations_inside: u32,
}

impl NewPeaksOfVector {
    pub(crate) fn turns(&self) -> bool {
        self.drifts_inside | self.accelerations_inside != 0
    }
}

/// Second derivatives of floor accelerations and first ones of drift accelerations at both ends of a step, and the norm of
/// the derivatives there.
pub(crate) struct Curvature {
    /// Of floor accelerations, and of drift accelerations: with room for the band before the first storey and after the
    /// last, at least a zero for the ground.
    a: [Vec<f64>; 2],
    q_rate: [Vec<f64>; 2],
    room: usize,
    /// Second derivatives of drift accelerations, third ones of floor accelerations.
    q: Vec<f64>,
    jerk: Vec<f64>,
    /// The norms that bound sixth derivatives as [`crate::regime::Regime::derivative_norm_of`] does fourth ones.
    norms: Norms,
}

impl Curvature {
    /// For a band of so many values before and after the storeys.
    pub(crate) fn new(length: usize, margin: usize) -> Self {
        let room = margin.max(1);
        let zero = || vec![0.0; length];
        let with_room = || [vec![0.0; length + 2 * room], vec![0.0; length + 2 * room]];
        let norms = Norms::new(length / WIDTH);
        Self { a: with_room(), q_rate: with_room(), room, q: zero(), jerk: zero(), norms }
    }

    /// Second derivatives of the floor accelerations at the start (0) or the end (1), after a zero for the ground.
    #[inline(always)]
    pub(crate) fn a(&self, which: usize) -> &[f64] {
        &self.a[which][self.room - 1..]
    }

    /// First derivatives of the drift accelerations.
    #[inline(always)]
    pub(crate) fn q_rate(&self, which: usize) -> &[f64] {
        &self.q_rate[which][self.room..]
    }

    /// Derivatives at the start of drift accelerations and of the rates of floor accelerations, with so many values before
    /// the first storey.
    #[inline(always)]
    pub(crate) fn with_margin(&self, margin: usize) -> [&[f64]; 2] {
        let from = self.room - margin;
        [&self.q_rate[0][from..], &self.a[0][from..]]
    }

    /// Forms the derivatives at one end.
    #[inline(always)]
    pub(crate) fn form_end<V: Vector>(
        &mut self,
        operator: &LongOperator,
        which: usize,
        sample: &TallSample,
        margin: usize,
    ) {
        let (q, jerk, nothing) = (&sample.q[margin..], &sample.jerk, &operator.nothing);
        let (q_rate, a) = (&mut self.q_rate[which][self.room..], &mut self.a[which][self.room..]);
        operator.derivatives::<V>(q, jerk, V::splat(1.0), nothing, q_rate, a);
    }

    /// Forms the norms, from the derivatives at the start.
    #[inline(always)]
    pub(crate) fn form_norms<V: Vector>(&mut self, operator: &LongOperator, rows: &RegimeRows) {
        let (q_rate, a) = (&self.q_rate[0][self.room..], &self.a[0][self.room - 1..]);
        operator.derivatives(q_rate, a, V::splat(1.0), &operator.nothing, &mut self.q, &mut self.jerk);
        self.norms.form::<V>(rows, &self.jerk, &self.q);
    }
}

/// A vector of storeys and their floors of which some were not cleared: bits of the lanes.
pub(crate) struct NearBound {
    pub(crate) vector: usize,
    pub(crate) drifts: u32,
    pub(crate) rates: u32,
    pub(crate) accelerations: u32,
}

/// A step that the loop did not clear.
pub(crate) struct QuinticCheck<'a> {
    pub(crate) rows: &'a RegimeRows,
    pub(crate) bounds: &'a TallBounds,
    pub(crate) start: &'a TallSample,
    pub(crate) end: &'a TallSample,
    pub(crate) curvature: &'a Curvature,
    pub(crate) margin: usize,
    pub(crate) h: f64,
    pub(crate) contact: (f64, f64),
    /// Drifts and accelerations below rounding of the largest so far: a storey that no wave has reached yet knows its
    /// own no better.
    pub(crate) least: (f64, f64),
}

impl QuinticCheck<'_> {
    /// What the quintics of vector `k` may miss, per unit of the bounds of fourth derivatives.
    #[inline(always)]
    fn sixth(&self, k: usize) -> f64 {
        self.curvature.norms.values[k] * off_quintic(self.h)
    }

    /// Which peaks the lanes of a vector that are near their bounds beat; nothing if a guard may fall inside the step.
    #[inline(always)]
    pub(crate) fn look<V: Vector>(&self, near_bound: &NearBound) -> Option<NewPeaksOfVector> {
        let NearBound { vector, drifts, rates, accelerations } = *near_bound;
        let (mut of_drifts, mut of_accelerations) = ((0, 0), (0, 0));
        if drifts | rates != 0 {
            of_drifts = self.look_at_drifts::<V>(vector, drifts, rates)?;
        }
        if accelerations != 0 {
            of_accelerations = self.look_at_accelerations::<V>(vector, accelerations)?;
        }
        Some(NewPeaksOfVector {
            vector,
            drifts: of_drifts.0,
            accelerations: of_accelerations.0,
            drifts_inside: of_drifts.1,
            accelerations_inside: of_accelerations.1,
        })
    }

    /// Lanes whose drifts beat a peak, and those of them where they turn.
    #[inline(always)]
    fn look_at_drifts<V: Vector>(&self, k: usize, drifts: u32, rates: u32) -> Option<(u32, u32)> {
        let (start, end) = (self.start, self.end);
        let (q_rate, q_rate_end) = (self.curvature.q_rate(0), self.curvature.q_rate(1));
        let (x, x_end) = (at::<V>(&start.x, k), at::<V>(&end.x, k));
        let (v, v_end) = (at::<V>(&start.v, k), at::<V>(&end.v, k));
        let (q, q_end) = (at::<V>(&start.q[self.margin..], k), at::<V>(&end.q[self.margin..], k));
        let (bounds, zero, sixth) = (&self.bounds.vectors[k], V::splat(0.0), V::splat(self.sixth(k)));
        let rate_margin = sixth.mul(at(&self.rows.fourth[1], k));
        let (from, to) = ([v, q, at(q_rate, k)], [v_end, q_end, at(q_rate_end, k)]);
        let (positive, negative) = signs(quintic_ranges(from, to, self.h, rate_margin));
        let sign = V::load(&bounds.sign);
        let (forward, backward) = (!zero.not_below(sign), !sign.not_below(zero));
        if (forward & !positive | backward & !negative) & rates != 0 {
            return None;
        }
        let margin = sixth.mul(at(&self.rows.fourth[0], k));
        let (low, high) = quintic_ranges([x, v, q], [x_end, v_end, q_end], self.h, margin);
        let (middle, reach) = (V::load(&bounds.middle), V::load(&bounds.reach));
        let outside = (high.not_below(middle.add(reach)) | middle.sub(reach).not_below(low)) & drifts;
        let (lower, upper) = self.bounds.guarded_drifts::<V>(k);
        if (high.not_below(upper) | lower.not_below(low)) & outside != 0 {
            return None;
        }
        let matters = x.abs().max(x_end.abs()).not_below(V::splat(self.least.0));
        Some((outside, outside & matters & !(positive | negative)))
    }

    /// Lanes whose floor accelerations beat a peak, and those of them where they turn.
    #[inline(always)]
    fn look_at_accelerations<V: Vector>(&self, k: usize, near_bound: u32) -> Option<(u32, u32)> {
        let (start, end) = (self.start, self.end);
        let (second, second_end) = (self.curvature.a(0), self.curvature.a(1));
        let (a, a_end) = (at::<V>(&start.a[1..], k), at::<V>(&end.a[1..], k));
        let (jerk, jerk_end) = (at::<V>(&start.jerk[1..], k), at::<V>(&end.jerk[1..], k));
        let (second, second_end) = (at::<V>(&second[1..], k), at::<V>(&second_end[1..], k));
        let margin = V::splat(self.sixth(k)).mul(at(&self.rows.fourth[2], k));
        let (low, high) = quintic_ranges([a, jerk, second], [a_end, jerk_end, second_end], self.h, margin);
        let size = high.max(V::splat(0.0).sub(low));
        let limit = V::load(&self.bounds.vectors[k].stuck_mu).mul(V::splat(self.contact.0.min(self.contact.1)));
        if size.not_below(limit) & near_bound != 0 {
            return None;
        }
        let beats = size.not_below(self.bounds.acceleration_peaks(k)) & near_bound;
        if beats == 0 {
            return Some((0, 0));
        }
        let fifth = V::splat(self.curvature.norms.values[k] * off_cubic(self.h)).mul(at(&self.rows.fourth[3], k));
        let third = V::splat(self.h * THIRD);
        let (positive, negative) = signs(ranges([jerk, second], [jerk_end, second_end], third, fifth));
        let matters = a.abs().max(a_end.abs()).not_below(V::splat(self.least.1));
        Some((beats, beats & matters & !(positive | negative)))
    }

    /// Whether the relative velocity of a block keeps its sign; `floor` is the change of its floor's velocity.
    pub(crate) fn keeps_sliding(&self, block: &FloorBlock, contact_slope: f64, floor: f64) -> bool {
        let i = block.floor;
        let at = |sample: &TallSample, velocity: f64, contact: f64| {
            let pushed = (block.friction * contact, block.friction * contact_slope);
            [velocity, -pushed.0 - sample.a[i + 1], -pushed.1 - sample.jerk[i + 1]]
        };
        let (start, end) =
            (at(self.start, block.velocity, self.contact.0), at(self.end, block.velocity_after, self.contact.1));
        let (low, high) = quintic_range(start, end, self.h, self.sixth(i / WIDTH) * self.rows.fourth[3][i]);
        let least = SMALL_DIFFERENCE * floor.abs();
        if block.sign > 0.0 { low > least } else { high < -least }
    }
}
