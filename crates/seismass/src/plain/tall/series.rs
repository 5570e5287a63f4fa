//! The series of a step of a tall regime with peaks inside, which gives the extremes.

use crate::lanes::{Plain, Set, Vector, WIDTH, at, lanes, lanes_mut, members};
use crate::plain::tall::bounds::TallBounds;
use crate::plain::tall::norms::{Norms, RegimeRows};
use crate::plain::tall::quintic_check::{NewPeaksOfVector, QuinticCheck};
use crate::plain::tall::sample::TallSample;
use crate::polynomial::power::{MAX_DEGREE, Polynomial};
use crate::regime::operator_long::LongOperator;
use crate::state::effort::{Effort, LOWEST_ORDER};
use crate::tolerances::SERIES_ROUNDING;

/// Highest order of a series of floor accelerations; that of the drifts is two orders higher.
const HIGHEST_ORDER: usize = MAX_DEGREE - 2;

/// The extremes that a series of length `h` is formed for, in the vectors that turn.
struct Wanted<'a> {
    beaten: &'a [NewPeaksOfVector],
    start: &'a TallSample,
    bounds: &'a TallBounds,
    h: f64,
    /// Drifts and accelerations that are negligible anywhere.
    least: (f64, f64),
}

impl Wanted<'_> {
    /// Whether what a series leaves out of them after `order`, whose terms have these norms, is below rounding.
    #[inline(always)]
    fn is_known<V: Vector>(&self, rows: &RegimeRows, norms: &Norms, order: usize) -> bool {
        let h = self.h;
        let next = h / (order + 1) as f64;
        let twice = next * h * h / ((order + 2) * (order + 3)) as f64;
        let rounding = V::splat(SERIES_ROUNDING);
        for beaten in self.beaten.iter().filter(|beaten| beaten.turns()) {
            let (k, norm) = (beaten.vector, V::splat(norms.values[beaten.vector]));
            let of_drift = norm.mul(V::splat(twice)).mul(at(&rows.fourth[0], k));
            let of_acceleration = norm.mul(V::splat(next)).mul(at(&rows.second, k));
            let drift = rounding.mul(at::<V>(&self.start.x, k).abs()).max(V::splat(self.least.0));
            let acceleration = rounding.mul(self.bounds.acceleration_peaks(k)).max(V::splat(self.least.1));
            let unknown = of_drift.not_below(drift) & beaten.drifts_inside
                | of_acceleration.not_below(acceleration) & beaten.accelerations_inside;
            if unknown != 0 {
                return false;
            }
        }
        true
    }
}

/// The Taylor series of a step, or of half of it, from one of its ends on, to the order that the motion needs.
pub(crate) struct PartSeries {
    /// Signed length (s): negative from the end on.
    pub(crate) h: f64,
    pub(crate) order: usize,
    /// Terms of the floor accelerations from order 2 on, after a zero for the ground, and of the drift rates.
    pub(crate) a: Vec<Vec<f64>>,
    pub(crate) v: Vec<Vec<f64>>,
    length: usize,
    norms: Norms,
}

impl PartSeries {
    fn new(length: usize) -> Self {
        Self { h: 0.0, order: 0, a: Vec::new(), v: Vec::new(), length, norms: Norms::new(length / WIDTH) }
    }

    /// Forms the terms until what they leave out of what is `wanted` is negligible, not before the lowest order; false
    /// where that is never.
    #[inline(always)]
    fn form<V: Vector>(
        &mut self,
        operator: &LongOperator,
        rows: &RegimeRows,
        (a_second, q_rate): (&[f64], &[f64]),
        h: f64,
        lowest: usize,
        wanted: Option<&Wanted>,
    ) -> bool {
        self.h = h;
        let half_square = V::splat(0.5 * h * h);
        for order in 2..=HIGHEST_ORDER {
            if self.a.len() + 2 <= order {
                self.a.push(vec![0.0; self.length + 1]);
                self.v.push(vec![0.0; self.length]);
            }
            let (a_below, a) = self.a.split_at_mut(order - 2);
            let (v_below, v) = self.v.split_at_mut(order - 2);
            if order == 2 {
                scale(&a_second[1..], half_square, &mut a[0][1..]);
                scale(q_rate, half_square, &mut v[0]);
            } else {
                let (factor, below) = (V::splat(h / order as f64), order - 3);
                let nothing = &operator.nothing;
                operator.derivatives(&v_below[below], &a_below[below], factor, nothing, &mut v[0], &mut a[0][1..]);
            }
            if order < lowest {
                continue;
            }
            if let Some(wanted) = wanted {
                self.norms.form::<V>(rows, &a[0][1..], &v[0]);
                if !wanted.is_known::<V>(rows, &self.norms, order) {
                    continue;
                }
            }
            self.order = order;
            return true;
        }
        false
    }

    /// Lanes of vector `k` whose drift rates are not known to keep their signs.
    #[inline(always)]
    fn drifts_that_turn<V: Vector>(&self, sample: &TallSample, margin: usize, k: usize) -> u32 {
        let mut size = V::splat(0.0);
        for v in &self.v[1..self.order - 1] {
            size = size.add(at::<V>(v, k).abs());
        }
        let linear = V::splat(self.h).mul(at(&sample.q[margin..], k));
        may_change_sign([at(&sample.v, k), linear, at(&self.v[0], k)], size)
    }

    /// Lanes of vector `k` whose rates of accelerations are not known to keep their signs.
    #[inline(always)]
    fn accelerations_that_turn<V: Vector>(&self, sample: &TallSample, k: usize) -> u32 {
        let term = |order: usize| V::splat(order as f64).mul(at(&self.a[order - 2][1..], k));
        let mut size = V::splat(0.0);
        for order in 4..=self.order {
            size = size.add(term(order).abs());
        }
        may_change_sign([V::splat(self.h).mul(at(&sample.jerk[1..], k)), term(2), term(3)], size)
    }

    /// Drift coordinate of storey `i` from its sample on.
    fn drift(&self, sample: &TallSample, margin: usize, i: usize) -> Polynomial {
        let (h, order) = (self.h, self.order as f64);
        let first = [sample.x[i], h * sample.v[i], 0.5 * h * h * sample.q[margin + i]];
        let terms = self.v[..self.order - 1].iter().zip(3..).map(|(v, order)| h / f64::from(order) * v[i]);
        let a = &self.a[self.order - 2];
        let last = h * h / ((order + 1.0) * (order + 2.0)) * (a[i + 1] - a[i]);
        Polynomial::new(first.into_iter().chain(terms).chain(std::iter::once(last)))
    }

    /// Absolute acceleration of floor `i` from its sample on.
    fn floor_acceleration(&self, sample: &TallSample, i: usize) -> Polynomial {
        let first = [sample.a[i + 1], self.h * sample.jerk[i + 1]];
        Polynomial::new(first.into_iter().chain(self.a[..self.order - 1].iter().map(|a| a[i + 1])))
    }

    /// Takes the extremes of the drift of storey `i`, and its value at the far end, into the peaks.
    #[inline(never)]
    fn take_drifts(&self, bounds: &mut TallBounds, sample: &TallSample, margin: usize, i: usize, from: f64) {
        let drift = self.drift(sample, margin, i);
        let (first, others) = drift.derivative().sign_changes::<Plain>();
        for s in first.into_iter().chain(others).chain([1.0]) {
            bounds.take_drift(i, drift.at::<Plain>(s), from + s * self.h);
        }
    }

    /// Takes the extremes of the acceleration of floor `i`, and its value at the far end, into the peaks.
    #[inline(never)]
    fn take_accelerations(&self, bounds: &mut TallBounds, sample: &TallSample, i: usize, from: f64) {
        let acceleration = self.floor_acceleration(sample, i);
        let (first, others) = acceleration.derivative().sign_changes::<Plain>();
        for s in first.into_iter().chain(others).chain([1.0]) {
            bounds.take_acceleration(i, acceleration.at::<Plain>(s), from + s * self.h);
        }
    }
}

/// The series of a step with peaks inside: one from its start, or of each half from the sample that it touches.
pub(crate) struct StepSeries {
    of_parts: [PartSeries; 2],
    pub(crate) effort: Effort,
}

impl StepSeries {
    pub(crate) fn new(length: usize, effort: Effort) -> Self {
        Self { of_parts: [PartSeries::new(length), PartSeries::new(length)], effort }
    }

    /// Forms the series until what they leave out of the values that may beat peaks is proved to be below rounding, of
    /// these or of the largest in the building; false where they cannot.
    #[inline(always)]
    pub(crate) fn form<V: Vector>(
        &mut self,
        operator: &LongOperator,
        rows: &RegimeRows,
        guard_check: &QuinticCheck,
        beaten: &[NewPeaksOfVector],
    ) -> bool {
        for parts in self.effort.parts..=2 {
            self.effort.parts = parts;
            if self.form_parts::<V>(operator, rows, guard_check, beaten) {
                return true;
            }
        }
        false
    }

    #[inline(always)]
    fn form_parts<V: Vector>(
        &mut self,
        operator: &LongOperator,
        rows: &RegimeRows,
        guard_check: &QuinticCheck,
        beaten: &[NewPeaksOfVector],
    ) -> bool {
        let h = guard_check.h / self.effort.parts as f64;
        let (least, curvature) = (guard_check.least, guard_check.curvature);
        // Of what is exactly zero nothing is left out.
        let least = (least.0.max(f64::MIN_POSITIVE), least.1.max(f64::MIN_POSITIVE));
        let wanted = Wanted { beaten, start: guard_check.start, bounds: guard_check.bounds, h, least };
        let [first, second] = &mut self.of_parts;
        let terms = |which: usize| (curvature.a(which), curvature.q_rate(which));
        // Neighbouring steps need about as many terms.
        let lowest = LOWEST_ORDER.max(self.effort.order - 1);
        if !first.form::<V>(operator, rows, terms(0), h, lowest, Some(&wanted)) {
            return false;
        }
        // The norm at the start of the step bounds the second half too.
        self.effort.order = first.order;
        self.effort.parts == 1 || second.form::<V>(operator, rows, terms(1), -h, first.order, None)
    }

    /// Takes the extremes inside the step, which begins at `time`, into the peaks.
    #[inline(always)]
    pub(crate) fn take_extremes<V: Vector>(
        &self,
        bounds: &mut TallBounds,
        samples: [&TallSample; 2],
        margin: usize,
        time: f64,
        beaten: &[NewPeaksOfVector],
    ) {
        for (which, (series, sample)) in self.of_parts[..self.effort.parts].iter().zip(samples).enumerate() {
            let from = if which == 0 { time } else { time - 2.0 * series.h };
            for beaten in beaten.iter().filter(|beaten| beaten.turns()) {
                let k = beaten.vector;
                if beaten.drifts_inside != 0 {
                    let turn = beaten.drifts_inside & series.drifts_that_turn::<V>(sample, margin, k);
                    for lane in members(Set::from(turn)) {
                        series.take_drifts(bounds, sample, margin, WIDTH * k + lane, from);
                    }
                }
                if beaten.accelerations_inside != 0 {
                    let turn = beaten.accelerations_inside & series.accelerations_that_turn::<V>(sample, k);
                    for lane in members(Set::from(turn)) {
                        series.take_accelerations(bounds, sample, WIDTH * k + lane, from);
                    }
                }
            }
        }
    }
}

/// Lanes in which a quadratic, or what differs from it by at most `margin`, may change its sign in [0, 1].
#[inline(always)]
fn may_change_sign<V: Vector>([constant, linear, square]: [V; 3], margin: V) -> u32 {
    let (middle, end) = (V::splat(0.5).mul_add(linear, constant), constant.add(linear).add(square));
    let (low, high) = (constant.min(middle).min(end), constant.max(middle).max(end));
    margin.not_below(low) & margin.not_below(V::splat(0.0).sub(high))
}

/// out = values * factor.
#[inline(always)]
fn scale<V: Vector>(values: &[f64], factor: V, out: &mut [f64]) {
    for (out, value) in lanes_mut(out).iter_mut().zip(lanes(values)) {
        V::load(value).mul(factor).store(out);
    }
}
