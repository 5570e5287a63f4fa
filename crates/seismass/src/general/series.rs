//! The Taylor series of the solution over a step: dense output of all that guards and peaks are formed of
//! (`numerics`, sections 4.3 and 9.2).

use crate::general::base_law::Base;
use crate::general::state::GeneralState;
use crate::lanes::Plain;
use crate::polynomial::orders::{INVERSE, terms};
use crate::polynomial::power::{MAX_DEGREE, Polynomial};
use crate::tolerances::SERIES_ROUNDING;

/// Combines rows with sums, entry by entry and one row after the other. Four sums at a time stay in registers.
#[inline(always)]
fn fold_rows<'a, T: Copy>(
    sums: &mut [f64],
    rows: impl Iterator<Item = (&'a [f64], T)> + Clone,
    combine: impl Fn(f64, f64, T) -> f64,
) {
    let (fours, rest) = sums.as_chunks_mut::<4>();
    let first = 4 * fours.len();
    for (i, four) in fours.iter_mut().enumerate() {
        let mut sum = *four;
        for (row, with) in rows.clone() {
            let entries = &row.as_chunks::<4>().0[i];
            for j in 0..4 {
                sum[j] = combine(sum[j], entries[j], with);
            }
        }
        *four = sum;
    }
    for (row, with) in rows {
        for (sum, entry) in rest.iter_mut().zip(&row[first..]) {
            *sum = combine(*sum, *entry, with);
        }
    }
}

/// Coefficients of a block's relative velocity and slip since the start of the step, lowest first.
#[derive(Debug, Clone, Copy)]
pub(super) struct BlockSeries {
    pub(super) velocity: [f64; MAX_DEGREE + 1],
    pub(super) slip: [f64; MAX_DEGREE + 1],
    /// Friction over mass (m/s2), positive where the node is dragged along.
    pub(super) friction: [f64; MAX_DEGREE + 1],
    /// Bounds of the sums of all terms but the first.
    pub(super) velocity_change: f64,
    pub(super) slip_change: f64,
}

/// The series in s = t / h on [0, 1], from `tau` on. Rows of one order by node.
#[derive(Default)]
pub(super) struct Series {
    pub(super) tau: f64,
    pub(super) h: f64,
    pub(super) width: usize,
    /// Highest order of accelerations; rates have one more, drifts two.
    order: usize,
    pub(super) acceleration: Vec<f64>,
    pub(super) rate: Vec<f64>,
    pub(super) drift: Vec<f64>,
    /// Bounds of the sums of all terms but the first, by node.
    pub(super) acceleration_change: Vec<f64>,
    pub(super) rate_change: Vec<f64>,
    pub(super) drift_change: Vec<f64>,
    /// Of the blocks that move, in their order.
    pub(super) blocks: Vec<BlockSeries>,
    /// Force of the ground that holds a stuck slab (N).
    pub(super) holding: [f64; MAX_DEGREE + 1],
    shear: Vec<f64>,
}

/// Which of a node's quantities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Quantity {
    /// Drift from the base of the segment (m).
    Drift,
    /// Drift rate (m/s).
    Rate,
    /// Absolute acceleration (m/s2).
    Acceleration,
}

impl Series {
    /// Forms the series of a step of `h`, so many radians, from `tau`, on which the fastest modes have decayed; changes are
    /// not bounded yet.
    pub(super) fn form(&mut self, state: &GeneralState, tau: f64, (h, phase): (f64, f64), decayed: usize) {
        self.begin_sliding(state, tau, h, terms::<Plain>(phase));
        let modes = state.regime.decaying.get().map_or(&[][..], |modes| &modes[..decayed]);
        for k in 0..=self.order {
            self.form_order(state, k);
            modes.iter().for_each(|mode| mode.correct(state, self, k));
        }
    }

    /// The first terms of a series of accelerations to an order, and friction, which is known in one direction.
    pub(super) fn begin_sliding(&mut self, state: &GeneralState, tau: f64, h: f64, order: usize) {
        self.begin(state, tau, h, order);
        let contact = [state.contact_at(tau), state.interval.contact_slope * h];
        for (block, &j) in self.blocks.iter_mut().zip(&state.moving) {
            let coefficient = state.friction_coefficient(j);
            (block.friction[0], block.friction[1]) = (coefficient * contact[0], coefficient * contact[1]);
        }
    }

    /// The first terms of a series of accelerations to an order, without friction.
    pub(super) fn begin(&mut self, state: &GeneralState, tau: f64, h: f64, order: usize) {
        let width = state.system.nodes + 1;
        (self.tau, self.h, self.width, self.order) = (tau, h, width, order);
        self.acceleration.resize((MAX_DEGREE + 1) * width, 0.0);
        self.rate.resize((MAX_DEGREE + 1) * width, 0.0);
        self.drift.resize((MAX_DEGREE + 1) * width, 0.0);
        self.shear.resize(width, 0.0);
        self.drift[..width].copy_from_slice(&state.x);
        self.rate[..width].copy_from_slice(&state.v);
        for p in 0..width {
            self.drift[width + p] = h * state.v[p];
        }
        let none = [0.0; MAX_DEGREE + 1];
        self.blocks.clear();
        self.blocks.extend(state.moving.iter().map(|&j| {
            let (mut velocity, mut slip) = (none, none);
            velocity[0] = state.motions[j].velocity;
            slip[1] = h * velocity[0];
            BlockSeries { velocity, slip, friction: none, velocity_change: 0.0, slip_change: 0.0 }
        }));
    }

    /// Terms of order k of accelerations, and those of rates, drifts and blocks that follow.
    pub(super) fn form_order(&mut self, state: &GeneralState, k: usize) {
        let (system, width, h) = (state.system, self.width, self.h);
        let row = k * width;
        self.form_shear(state, k);
        let force = &mut self.acceleration[row..row + width];
        force.fill(0.0);
        for (block, &j) in self.blocks.iter().zip(&state.moving) {
            let law = &system.blocks[j];
            force[law.floor] += law.mass * block.friction[k];
        }
        for contact in &state.moving_contacts {
            let (node, of_stop) = (system.blocks[contact.block].floor, self.stop_term(state, contact.block, k));
            self.acceleration[row + node] -= of_stop;
        }
        let force = &mut self.acceleration[row..row + width];
        let (shears, inverse_mass) = (&self.shear[..width], &state.regime.inverse_mass[..width]);
        // First what springs above do: sums of one node wait for each other, those of all nodes need not.
        for p in (1..width).rev() {
            force[system.parent[p]] += shears[p];
        }
        for p in 1..width {
            force[p] = (force[p] - shears[p]) * inverse_mass[p];
        }
        let ground = match k {
            0 => state.interval.ground_at(self.tau),
            1 => state.interval.ground_slope * h,
            _ => 0.0,
        };
        let (of_rate, of_drift) = (h * INVERSE[k + 1], h * INVERSE[k + 2]);
        let mut of_slab = ground;
        if let Some(base) = &system.base {
            let pushed = force[0] - base_term(state, base, &self.drift, (width, self.tau, h), k);
            if state.base_moves() {
                of_slab = pushed * state.regime.inverse_mass[0];
                self.rate[row + width] = of_rate * (of_slab - ground);
                self.drift[row + 2 * width] = of_drift * self.rate[row + width];
            } else {
                self.holding[k] = state.regime.slab_mass * ground - pushed;
                (self.rate[row + width], self.drift[row + 2 * width]) = (0.0, 0.0);
            }
        }
        force[0] = of_slab;
        let rates = &mut self.rate[row + width..row + 2 * width];
        let drifts = &mut self.drift[row + 2 * width..row + 3 * width];
        for p in 1..width {
            rates[p] = of_rate * (force[p] - force[system.parent[p]]);
            drifts[p] = of_drift * rates[p];
        }
        let touches = !state.moving_contacts.is_empty();
        for (position, &j) in state.moving.iter().enumerate() {
            let law = &system.blocks[j];
            let of_stop = if touches { self.stop_term(state, j, k) / law.mass } else { 0.0 };
            let own = of_stop - self.blocks[position].friction[k];
            let velocity = of_rate * (own - self.acceleration[row + law.floor]);
            let block = &mut self.blocks[position];
            block.velocity[k + 1] = velocity;
            block.slip[k + 2] = of_drift * velocity;
        }
    }

    /// Terms of order k of the forces of springs, dampers and elastic matrices between drifts.
    fn form_shear(&mut self, state: &GeneralState, k: usize) {
        let row = k * self.width..(k + 1) * self.width;
        let (drift, rate) = (&self.drift[row.clone()], &self.rate[row]);
        let of_springs = self.shear.iter_mut().zip(&state.regime.tangent).zip(drift);
        of_springs.for_each(|((shear, tangent), drift)| *shear = tangent * drift);
        if k == 0 {
            self.shear.iter_mut().zip(&state.base_load).for_each(|(shear, load)| *shear += load);
        }
        for part in &state.system.parts {
            let nodes = part.first..part.first + part.count;
            for (matrix, values) in [(&part.damping, rate), (&part.elastic, drift)] {
                let columns = matrix.chunks_exact(part.count).zip(values[nodes.clone()].iter().copied());
                fold_rows(&mut self.shear[nodes.clone()], columns, |sum, entry, value| sum + entry * value);
            }
        }
    }

    /// Ends the series where its last two terms of all accelerations are below rounding of the largest term: what is left out
    /// is less, as the phase is far below the order.
    pub(super) fn end_by_terms(&mut self) {
        let (order, width) = (self.order, self.width);
        let of_order = |k: usize| {
            let of_nodes = self.acceleration[k * width..(k + 1) * width].iter().copied();
            let of_blocks = self.blocks.iter().map(|block| (k + 1) as f64 / self.h * block.velocity[k + 1]);
            of_nodes.chain(of_blocks).fold(0.0, |most: f64, term| most.max(term.abs()))
        };
        let largest = (0..=order).map(of_order).fold(0.0, f64::max);
        let allowed = [order - 1, order].map(|k| (SERIES_ROUNDING * largest / of_order(k), 1.0 / k as f64));
        let too_long = allowed.into_iter().filter(|(part, _)| *part < 1.0);
        let end = too_long.map(|(part, root)| libm::pow(part, root)).fold(1.0, f64::min);
        if end < 1.0 {
            self.shorten(end, order);
        }
    }

    /// The force that holds a stuck slab, as a polynomial with this factor and constant, and the size of its terms.
    pub(super) fn holding_polynomial(&self, factor: f64, constant: f64) -> (Polynomial, f64) {
        let mut polynomial = Polynomial::new(self.holding[..=self.order].iter().map(|c| factor * c));
        let size = polynomial.coefficients().iter().map(|c| c.abs()).sum();
        polynomial.coefficients[0] += constant;
        (polynomial, size)
    }

    /// Term of order k of the force of its stop on a block (N).
    fn stop_term(&self, state: &GeneralState, block: usize, k: usize) -> f64 {
        let (Some(_), Some(stops)) = (state.stops[block].touching(), &state.system.stops[block]) else { return 0.0 };
        let Some(position) = state.moving.iter().position(|&j| j == block) else { return 0.0 };
        let terms = &self.blocks[position];
        let beyond = if k == 0 { state.stops[block].beyond } else { terms.slip[k] };
        -(stops.stiffness * beyond + stops.damping * terms.velocity[k])
    }

    /// Ends the series at its place `end`, which is the new 1, and after the terms of an order.
    pub(super) fn shorten(&mut self, end: f64, order: usize) {
        self.order = order;
        self.h *= end;
        let mut power = 1.0;
        for k in 1..=order + 2 {
            power *= end;
            for rows in [&mut self.acceleration, &mut self.rate, &mut self.drift] {
                rows[k * self.width..(k + 1) * self.width].iter_mut().for_each(|term| *term *= power);
            }
            self.holding[k] *= power;
            for block in &mut self.blocks {
                block.velocity[k] *= power;
                block.slip[k] *= power;
                block.friction[k] *= power;
            }
        }
    }

    /// Bounds all changes, once all terms are formed.
    pub(super) fn bound_changes(&mut self) {
        let (width, order) = (self.width, self.order);
        let bound = |rows: &[f64], sums: &mut Vec<f64>, last: usize| {
            sums.clear();
            sums.resize(width, 0.0);
            let rows = rows[width..(last + 1) * width].chunks_exact(width).map(|row| (row, ()));
            fold_rows(sums, rows, |sum, term, ()| sum + term.abs());
        };
        bound(&self.acceleration, &mut self.acceleration_change, order);
        bound(&self.rate, &mut self.rate_change, order + 1);
        bound(&self.drift, &mut self.drift_change, order + 2);
        for block in &mut self.blocks {
            block.velocity_change = block.velocity[1..=order + 1].iter().map(|term| term.abs()).sum();
            block.slip_change = block.slip[1..=order + 2].iter().map(|term| term.abs()).sum();
        }
    }

    fn rows(&self, quantity: Quantity) -> (&[f64], usize) {
        match quantity {
            Quantity::Drift => (&self.drift, self.order + 2),
            Quantity::Rate => (&self.rate, self.order + 1),
            Quantity::Acceleration => (&self.acceleration, self.order),
        }
    }

    /// Terms of a quantity by node, order by order.
    pub(super) fn orders(&self, quantity: Quantity) -> impl Iterator<Item = &[f64]> {
        let (rows, last) = self.rows(quantity);
        rows.chunks_exact(self.width).take(last + 1)
    }

    /// `constant` + `factor` times a quantity of a node as a polynomial, and the sum of the sizes of its terms.
    pub(super) fn polynomial(&self, quantity: Quantity, node: usize, factor: f64, constant: f64) -> (Polynomial, f64) {
        let (rows, last) = self.rows(quantity);
        let mut polynomial = Polynomial::new((0..=last).map(|k| factor * rows[k * self.width + node]));
        let size = polynomial.coefficients().iter().map(|c| c.abs()).sum();
        polynomial.coefficients[0] += constant;
        (polynomial, size)
    }

    /// Range of a quantity of a node over the step.
    #[inline]
    pub(super) fn range(&self, quantity: Quantity, node: usize) -> (f64, f64) {
        let (start, change) = match quantity {
            Quantity::Drift => (self.drift[node], self.drift_change[node]),
            Quantity::Rate => (self.rate[node], self.rate_change[node]),
            Quantity::Acceleration => (self.acceleration[node], self.acceleration_change[node]),
        };
        (start - change, start + change)
    }

    /// Change of a quantity of all nodes from the start of the step to its place `s`.
    pub(super) fn changes(&self, quantity: Quantity, s: f64, sums: &mut Vec<f64>) {
        let (rows, last) = self.rows(quantity);
        sums.clear();
        sums.extend(&rows[last * self.width..(last + 1) * self.width]);
        let lower = rows[self.width..last * self.width].chunks_exact(self.width).rev().map(|row| (row, ()));
        fold_rows(sums, lower, |sum, term, ()| sum * s + term);
        sums.iter_mut().for_each(|sum| *sum *= s);
    }

    /// Value of a quantity of all nodes at the place `s`.
    pub(super) fn values(&self, quantity: Quantity, s: f64, values: &mut Vec<f64>) {
        let start = &self.rows(quantity).0[..self.width];
        if s == 0.0 {
            values.clear();
            values.extend(start);
            return;
        }
        self.changes(quantity, s, values);
        values.iter_mut().zip(start).for_each(|(value, start)| *value += start);
    }

    /// Relative velocity of the moving block at `position` as a polynomial.
    pub(super) fn velocity_of(&self, position: usize) -> Polynomial {
        Polynomial::new(self.blocks[position].velocity[..=self.order + 1].iter().copied())
    }

    /// Its friction over mass as a polynomial.
    pub(super) fn friction_of(&self, position: usize) -> Polynomial {
        Polynomial::new(self.blocks[position].friction[..=self.order].iter().copied())
    }

    /// Its slip since the start of the step.
    pub(super) fn slip_of(&self, position: usize) -> Polynomial {
        Polynomial::new(self.blocks[position].slip[..=self.order + 2].iter().copied())
    }

    /// Changes of its relative velocity and slip from the start of the step to its place `s`.
    pub(super) fn block_changes(&self, position: usize, s: f64) -> (f64, f64) {
        let block = &self.blocks[position];
        let sum = |terms: &[f64]| terms.iter().skip(1).rev().fold(0.0, |sum, term| (sum + term) * s);
        (sum(&block.velocity[..=self.order + 1]), sum(&block.slip[..=self.order + 2]))
    }
}

/// Term of order k of the restoring force and friction against the slab of a sliding base (N). The contact force is linear in
/// time, so the restoring force has products of two terms.
fn base_term(state: &GeneralState, base: &Base, drift: &[f64], (width, tau, h): (usize, f64, f64), k: usize) -> f64 {
    if state.airborne {
        return 0.0;
    }
    let (contact, change) = (state.interval.contact_at(tau), state.interval.contact_slope * h);
    let before = if k > 0 { change * drift[(k - 1) * width] } else { 0.0 };
    let friction = match k {
        0 => contact,
        1 => change,
        _ => 0.0,
    };
    base.restoring * (contact * drift[k * width] + before) + state.base_friction() * base.carried * friction
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::general::system::System;
    use crate::scene::{Block, Damping, GeneralBuilding, GeneralScene, GravityEffect, Motion, SlidingBase, Storey};
    use crate::state::interval::interval;

    /// A series that is ended by its terms is that of the step that is left, of everything in it: nodes, a block that slides, and
    /// the force that holds a slab. 2.85 radians of one storey, which moves at full size.
    #[test]
    fn an_ended_series_is_that_of_a_shorter_step() {
        let storeys = vec![Storey::elastic(9e7)];
        let damping = Damping::Modal { ratio: 0.02 };
        let building = GeneralBuilding::new(vec![1000.0], storeys, None, &damping, GravityEffect::None).unwrap();
        let goods = vec![Block { velocity: Some(0.8), ..Block::new(1, 300.0, 0.2) }.into()];
        let base = SlidingBase::new(500.0, 50.0);
        let scene = GeneralScene::on_base(Some(Arc::new(building)), goods, Vec::new(), Some(base)).unwrap();
        let scene = scene.with_initial(vec![2e-4], vec![0.05]).unwrap();
        let motion = Motion::new(vec![1.0, 2.0], 0.01, None).unwrap();
        let system = System::new(&scene, &motion).unwrap();
        let mut state = GeneralState::new(&scene, &system, false);
        state.interval = interval(&motion, None, 0);
        state.follow();
        let (mut ended, mut formed) = (Series::default(), Series::default());
        let phase_of = |h: f64| (h, state.regime.frequency * h);
        ended.form(&state, 0.0, phase_of(0.01), 0);
        ended.end_by_terms();
        assert!(ended.h > 0.004 && ended.h < 0.008, "{} s", ended.h);
        formed.form(&state, 0.0, phase_of(ended.h), 0);
        let everything = |series: &Series| -> Vec<f64> {
            let (velocity, slip) = series.block_changes(0, 1.0);
            let of_nodes = [Quantity::Drift, Quantity::Rate, Quantity::Acceleration].map(|q| {
                let mut values = Vec::new();
                series.values(q, 1.0, &mut values);
                values[1]
            });
            let holding = series.holding_polynomial(1.0, 0.0).0.at::<Plain>(1.0);
            of_nodes.into_iter().chain([velocity, slip, series.friction_of(0).at::<Plain>(1.0), holding]).collect()
        };
        for (found, expected) in everything(&ended).into_iter().zip(everything(&formed)) {
            // Some rounding of terms that are twice as large as their sums.
            assert!((found - expected).abs() < 32.0 * f64::EPSILON * expected.abs(), "{found} for {expected}");
        }
    }
}
