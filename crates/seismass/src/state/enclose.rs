//! Ranges over the present series.

use std::mem::take;

use crate::lanes::{MAX_LANES, Vector, at, differences, load};
use crate::polynomial::enclosure::{THIRD, range};
use crate::regime::Row;
use crate::state::State;
use crate::state::limits::BoundsInLanes;
use crate::state::sample::Sample;

impl State<'_> {
    /// Forms the ranges over the present series, whose start is the state, unless the plain step before it has left them,
    /// and tells which come to their bounds.
    #[inline(always)]
    pub(crate) fn form_ranges<V: Vector, const K: usize>(&mut self) {
        if self.storeys() > MAX_LANES {
            return self.form_ranges_singly();
        }
        if !take(&mut self.step.ranges.are_known) {
            ranges_in_lanes::<V, K>(self);
        }
    }

    /// Keeps what the bounds of the present series' higher derivatives are multiplied with, from the square of the norm
    /// that [`Regime::derivative_norm_of`](crate::regime::Regime::derivative_norm_of) takes.
    #[inline]
    fn bound_derivatives(&mut self, square: f64) {
        let h = self.step.series.h();
        let derivative_norm = self.regime.derivative_norm_of(square, h);
        self.step.ranges.set_margins(derivative_norm, h);
    }

    /// [`State::form_ranges`] for more storeys than vectors hold.
    #[inline(never)]
    fn form_ranges_singly(&mut self) {
        let (n, slope) = (self.storeys(), self.step.drive.ground_slope);
        let (root_mass, root_tangent) = (self.regime.row(Row::RootMass), self.regime.row(Row::RootTangent));
        let (jerk, q) = (&self.kinematics.jerk[..n], &self.kinematics.drift_acceleration[..n]);
        let mut square = 0.0;
        for i in 0..n {
            let (jerk, q) = (root_mass[i] * (jerk[i] - slope), root_tangent[i] * q[i]);
            square += jerk * jerk + q * q;
        }
        self.bound_derivatives(square);
        let regime = &self.regime;
        let h = self.step.series.h();
        let margins = [Row::FourthOfDrift, Row::FourthOfRate, Row::FourthOfAcceleration].map(|row| regime.row(row));
        let [dx, dv] = self.step.series.changes().map(|changes| &changes[..n]);
        let [a_end, jerk_end] = self.step.series.accelerations_at_end().map(|values| &values[..n]);
        let [x, v, a] = [&self.kinematics.x, &self.kinematics.v, &self.kinematics.a].map(|values| &values[..n]);
        let (jerk, q) = (&self.kinematics.jerk[..n], &self.kinematics.drift_acceleration[..n]);
        let remainder = self.step.ranges.remainder;
        let mut bounds = self.step.ranges.bounds.each_mut().map(|pair| pair.each_mut().map(|bounds| &mut bounds[..n]));
        let mut below = self.step.drive.ground + self.step.drive.ground_slope * h;
        for i in 0..n {
            let q_end = a_end[i] - std::mem::replace(&mut below, a_end[i]);
            let ends = [
                (x[i], v[i], x[i] + dx[i], v[i] + dv[i]),
                (v[i], q[i], v[i] + dv[i], q_end),
                (a[i], jerk[i], a_end[i], jerk_end[i]),
            ];
            for (which, (start, start_rate, end, end_rate)) in ends.into_iter().enumerate() {
                let [low, high] = &mut bounds[which];
                let margin = remainder * margins[which][i];
                (low[i], high[i]) = range(start, start_rate, end, end_rate, h * THIRD, margin);
            }
        }
    }

    /// Floors of vector `k`, as bits, whose jerks keep their signs over the present series: between its ends a jerk differs
    /// from its chord by at most h^2 / 8 times its largest second derivative.
    #[inline(always)]
    pub(crate) fn steady<V: Vector, const K: usize>(&self, k: usize) -> u32 {
        let turn = V::splat(self.step.ranges.chord).mul(at(self.regime.row(Row::ThirdOfAcceleration), k));
        let (start, end): (V, V) =
            (self.kinematics.jerk.vector::<V, K>(k), self.step.series.accelerations_at_end()[1].vector::<V, K>(k));
        !V::splat(0.0).not_below(start.mul(end)) & !turn.not_below(start.abs().min(end.abs()))
    }
}

/// See [`State::form_ranges`].
#[inline(always)]
fn ranges_in_lanes<V: Vector, const K: usize>(state: &mut State) {
    let start = Sample::<V, K>::of(&state.kinematics);
    let (mass, tangent) = (state.regime.lanes::<V, K>(Row::RootMass), state.regime.lanes::<V, K>(Row::RootTangent));
    let mut squares = V::splat(0.0);
    for k in 0..K {
        let kinetic = mass[k].mul(start.jerk[k].sub(V::splat(state.step.drive.ground_slope)));
        let elastic = tangent[k].mul(start.q[k]);
        squares = elastic.mul_add(elastic, kinetic.mul_add(kinetic, squares));
    }
    state.bound_derivatives(squares.sum());
    let h = state.step.series.h();
    let ([dx, dv], [a, jerk]) = (state.step.series.changes(), state.step.series.accelerations_at_end());
    let (dx, dv, a, jerk): ([V; K], [V; K], [V; K], [V; K]) = (load(dx), load(dv), load(a), load(jerk));
    let q = differences(&a, V::splat(state.step.drive.ground + state.step.drive.ground_slope * h));
    let mut end = Sample { x: start.x, v: start.v, a, jerk, q };
    for k in 0..K {
        end.x[k] = start.x[k].add(dx[k]);
        end.v[k] = start.v[k].add(dv[k]);
    }
    let contact = V::splat(state.step.drive.least_contact(h));
    let bounds = BoundsInLanes::of(&state.bounds);
    state.step.ranges.form([&start, &end], (&state.regime, h), (&bounds, contact));
}
