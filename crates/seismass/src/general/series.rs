//! The Taylor series of the solution over a step: dense output of all that guards and peaks are formed of
//! (`numerics`, sections 4.3 and 9.2).

use crate::general::state::GeneralState;
use crate::general::terms::Terms;
use crate::lanes::Plain;
use crate::polynomial::orders::terms;
use crate::polynomial::power::{MAX_DEGREE, Polynomial};
use crate::tolerances::SERIES_ROUNDING;

/// Coefficients of a block's relative velocity and slip since the start of the step, lowest first.
#[derive(Debug, Clone, Copy, Default)]
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
    /// Size of the ground's terms by which accelerations are corrected, where modes have decayed (m/s2).
    pub(super) of_ground: f64,
    /// Nodes with the ground, and the length of a row: that, padded to fours.
    width: usize,
    row: usize,
    /// Highest order of accelerations; rates have one more, drifts two.
    order: usize,
    acceleration: Vec<f64>,
    rate: Vec<f64>,
    drift: Vec<f64>,
    /// Bounds of the sums of all terms but the first, by node.
    pub(super) acceleration_change: Vec<f64>,
    pub(super) rate_change: Vec<f64>,
    pub(super) drift_change: Vec<f64>,
    /// Of the blocks that move, in their order.
    pub(super) blocks: Vec<BlockSeries>,
    /// Force of the ground that holds a stuck slab (N).
    holding: [f64; MAX_DEGREE + 1],
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

/// The place up to which the last two terms of all accelerations are below rounding of the largest term: what is left out is
/// less, as the phase is far below the order.
fn own_end(terms: &Terms<1>) -> f64 {
    let (order, row) = (terms.order, terms.row);
    let of_order = |k: usize| {
        let of_nodes = terms.acceleration[k * row..(k + 1) * row].iter().map(|[term]| *term);
        let of_blocks = terms.blocks.iter().map(|block| (k + 1) as f64 / terms.h * block.velocity[k + 1][0]);
        of_nodes.chain(of_blocks).fold(0.0, |most: f64, term| most.max(term.abs()))
    };
    let largest = (0..=order).map(of_order).fold(0.0, f64::max);
    let allowed = [order - 1, order].map(|k| (SERIES_ROUNDING * largest / of_order(k), 1.0 / k as f64));
    let too_long = allowed.into_iter().filter(|(part, _)| *part < 1.0);
    too_long.map(|(part, root)| libm::pow(part, root)).fold(1.0, f64::min)
}

impl Series {
    /// Forms the series of a step of `h`, so many radians, from `tau`, on which the fastest modes have decayed; where it is
    /// asked for the series ends by its terms. These are formed in the working space `own`.
    pub(super) fn form(
        &mut self,
        own: &mut Terms<1>,
        state: &GeneralState,
        tau: f64,
        (h, phase): (f64, f64),
        decayed: usize,
        ends_by_terms: bool,
    ) {
        own.begin_sliding(state, tau, h, terms::<Plain>(phase));
        let modes = state.regime.decaying.get().map_or(&[][..], |modes| &modes[..decayed]);
        for k in 0..=own.order {
            own.form_order([state], k);
            modes.iter().for_each(|mode| mode.correct(state, own, k));
        }
        let end = if ends_by_terms { own_end(own) } else { 1.0 };
        self.take(own, 0, end, own.order);
        let ground = &state.interval;
        self.of_ground =
            if modes.is_empty() { 0.0 } else { ground.ground_at(tau).abs() + h * ground.ground_slope.abs() };
    }

    /// Takes terms of direction `d` up to their place `end`, which is the new 1, and to an order; bounds all changes.
    pub(super) fn take<const D: usize>(&mut self, terms: &Terms<D>, d: usize, end: f64, order: usize) {
        let (width, row) = (terms.width, terms.row);
        (self.tau, self.h, self.width, self.row, self.order) = (terms.tau, terms.h * end, width, row, order);
        let mut powers = [1.0; MAX_DEGREE + 1];
        for k in 1..=MAX_DEGREE {
            powers[k] = end * powers[k - 1];
        }
        let take_rows = |rows: &mut Vec<f64>, sums: &mut Vec<f64>, terms: &[[f64; D]], last: usize| {
            rows.resize((MAX_DEGREE + 1) * row, 0.0);
            sums.resize(row, 0.0);
            let (rows, terms, in_row) = (rows.as_chunks_mut::<4>().0, terms.as_chunks::<4>().0, row / 4);
            for (i, total) in sums.as_chunks_mut::<4>().0.iter_mut().enumerate() {
                let mut sum = [0.0; 4];
                for (k, power) in powers.iter().enumerate().take(last + 1) {
                    let term: [f64; 4] = terms[k * in_row + i].map(|term| power * term[d]);
                    rows[k * in_row + i] = term;
                    if k > 0 {
                        (0..4).for_each(|l| sum[l] += term[l].abs());
                    }
                }
                *total = sum;
            }
        };
        take_rows(&mut self.acceleration, &mut self.acceleration_change, &terms.acceleration, order);
        take_rows(&mut self.rate, &mut self.rate_change, &terms.rate, order + 1);
        take_rows(&mut self.drift, &mut self.drift_change, &terms.drift, order + 2);
        self.holding = std::array::from_fn(|k| powers[k] * terms.holding[k]);
        self.blocks.resize(terms.blocks.len(), BlockSeries::default());
        for (own, block) in self.blocks.iter_mut().zip(&terms.blocks) {
            let last = (order + 2).min(MAX_DEGREE);
            let take = |own: &mut [f64; MAX_DEGREE + 1], terms: &[[f64; D]; MAX_DEGREE + 1]| {
                for k in 0..=last {
                    own[k] = powers[k] * terms[k][d];
                }
                own[last + 1..].fill(0.0);
            };
            take(&mut own.velocity, &block.velocity);
            take(&mut own.slip, &block.slip);
            take(&mut own.friction, &block.friction);
            let size = |terms: &[f64]| terms.iter().map(|term| term.abs()).sum();
            (own.velocity_change, own.slip_change) =
                (size(&own.velocity[1..=order + 1]), size(&own.slip[1..=order + 2]));
        }
    }

    /// The force that holds a stuck slab, as a polynomial with this factor and constant, and the size of its terms.
    pub(super) fn holding_polynomial(&self, factor: f64, constant: f64) -> (Polynomial, f64) {
        let mut polynomial = Polynomial::new(self.holding[..=self.order].iter().map(|c| factor * c));
        let size = polynomial.coefficients().iter().map(|c| c.abs()).sum();
        polynomial.coefficients[0] += constant;
        (polynomial, size)
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
        rows.chunks_exact(self.row).take(last + 1)
    }

    /// `constant` + `factor` times a quantity of a node as a polynomial, and the sum of the sizes of its terms.
    pub(super) fn polynomial(&self, quantity: Quantity, node: usize, factor: f64, constant: f64) -> (Polynomial, f64) {
        let (rows, last) = self.rows(quantity);
        let mut polynomial = Polynomial::new((0..=last).map(|k| factor * rows[k * self.row + node]));
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
        // Four sums at a time stay in registers.
        let (rows, in_row) = (rows.as_chunks::<4>().0, self.row / 4);
        sums.resize(self.row, 0.0);
        for (i, total) in sums.as_chunks_mut().0.iter_mut().enumerate() {
            let mut sum = [0.0; 4];
            for k in (1..=last).rev() {
                let terms = &rows[k * in_row + i];
                (0..4).for_each(|l| sum[l] = (sum[l] + terms[l]) * s);
            }
            *total = sum;
        }
        sums.truncate(self.width);
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
        let (mut ended, mut formed, mut terms) = (Series::default(), Series::default(), Terms::default());
        let phase_of = |h: f64| (h, state.regime.frequency * h);
        ended.form(&mut terms, &state, 0.0, phase_of(0.01), 0, true);
        assert!(ended.h > 0.004 && ended.h < 0.008, "{} s", ended.h);
        formed.form(&mut terms, &state, 0.0, phase_of(ended.h), 0, false);
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
