//! The Taylor terms of a step in D directions at once, order by order (`numerics`, sections 4.3, 9.2 and 9.7).
//!
//! What belongs to one node or block is kept together for all directions, so that these are the lanes of a vector.

use crate::general::base_law::Base;
use crate::general::state::GeneralState;
use crate::general::system::Part;
use crate::polynomial::orders::INVERSE;
use crate::polynomial::power::MAX_DEGREE;

/// Entries that are taken at once: they stay in registers.
type Four = [f64; 4];

/// A value of each direction, all formed before any is stored: they are one vector.
#[inline(always)]
fn each<const D: usize>(of: impl Fn(usize) -> f64) -> [f64; D] {
    std::array::from_fn(of)
}

/// Damping and elastic matrix of a part in all directions; empty where all are zero.
struct Matrices<const D: usize> {
    first: usize,
    count: usize,
    damping: Vec<Four>,
    elastic: Vec<Four>,
}

impl<const D: usize> Matrices<D> {
    fn new(parts: [&Part; D]) -> Self {
        let (first, count) = (parts[0].first, parts[0].count);
        // Of the entries of a column, node by node, the first four of all columns, then the next.
        let of = |matrices: [&Vec<f64>; D]| -> Vec<Four> {
            if matrices.iter().all(|matrix| matrix.is_empty()) {
                return Vec::new();
            }
            let entry = |column: usize, i: usize| match matrices[i % D].get(column * count + i / D) {
                Some(entry) if i < count * D => *entry,
                _ => 0.0,
            };
            let fours = (0..(count * D).div_ceil(4)).flat_map(|four| (0..count).map(move |column| (column, 4 * four)));
            fours.map(|(column, first)| std::array::from_fn(|l| entry(column, first + l))).collect()
        };
        Self {
            first,
            count,
            damping: of(parts.map(|part| &part.damping)),
            elastic: of(parts.map(|part| &part.elastic)),
        }
    }

    /// Adds the columns of one of them, each times a value, to sums.
    #[inline(always)]
    fn add(&self, matrix: &[Four], values: &[[f64; D]], sums: &mut [[f64; D]]) {
        let values = &values[..self.count];
        let (whole, rest) = sums.as_flattened_mut().as_chunks_mut::<4>();
        let mut fours = matrix;
        for sums in whole {
            let Some((columns, others)) = fours.split_at_checked(self.count) else { return };
            fours = others;
            *sums = added(*sums, columns, values);
        }
        if !rest.is_empty() && !fours.is_empty() {
            // At most three, one by one: a copy of unknown length would be a call.
            let of_rest = std::array::from_fn(|l| rest.get(l).copied().unwrap_or(0.0));
            let sums = added(of_rest, fours, values);
            for l in 0..3 {
                if let Some(sum) = rest.get_mut(l) {
                    *sum = sums[l];
                }
            }
        }
    }
}

/// Four sums with four entries of each column, times its value, added.
#[inline(always)]
fn added<const D: usize>(mut four: Four, columns: &[Four], values: &[[f64; D]]) -> Four {
    for (entries, value) in columns.iter().zip(values) {
        (0..4).for_each(|l| four[l] += entries[l] * value[l % D]);
    }
    four
}

/// Terms of a block that moves.
#[derive(Clone, Copy)]
pub(super) struct BlockTerms<const D: usize> {
    node: usize,
    mass: f64,
    pub(super) velocity: [[f64; D]; MAX_DEGREE + 1],
    pub(super) slip: [[f64; D]; MAX_DEGREE + 1],
    /// Friction over mass (m/s2), positive where the node is dragged along.
    pub(super) friction: [[f64; D]; MAX_DEGREE + 1],
}

/// Terms in s = t / h from `tau` on. Rows of one order by node.
#[derive(Default)]
pub(super) struct Terms<const D: usize> {
    pub(super) tau: f64,
    pub(super) h: f64,
    /// Nodes with the ground, and the length of a row: that, padded to fours with zeros.
    pub(super) width: usize,
    pub(super) row: usize,
    /// Highest order of accelerations; rates have one more, drifts two.
    pub(super) order: usize,
    pub(super) acceleration: Vec<[f64; D]>,
    pub(super) rate: Vec<[f64; D]>,
    pub(super) drift: Vec<[f64; D]>,
    /// Of the blocks that move, in their order.
    pub(super) blocks: Vec<BlockTerms<D>>,
    /// Force of the ground that holds a stuck slab (N).
    pub(super) holding: [f64; MAX_DEGREE + 1],
    shear: Vec<[f64; D]>,
    tangent: Vec<[f64; D]>,
    matrices: Vec<Matrices<D>>,
}

impl Terms<1> {
    /// The first terms of a series of accelerations to an order, and friction, which is known in one direction.
    pub(super) fn begin_sliding(&mut self, state: &GeneralState, tau: f64, h: f64, order: usize) {
        self.begin([state], tau, h, order);
        let contact = [state.contact_at(tau), state.interval.contact_slope * h];
        for (block, &j) in self.blocks.iter_mut().zip(&state.moving) {
            let coefficient = state.friction_coefficient(j);
            (block.friction[0], block.friction[1]) = ([coefficient * contact[0]], [coefficient * contact[1]]);
        }
    }
}

impl<const D: usize> Terms<D> {
    /// The first terms of a series of accelerations to an order, without friction.
    pub(super) fn begin(&mut self, states: [&GeneralState; D], tau: f64, h: f64, order: usize) {
        let width = states[0].system.nodes + 1;
        let row = width.next_multiple_of(4);
        (self.tau, self.h, self.width, self.row, self.order) = (tau, h, width, row, order);
        if self.shear.is_empty() {
            for rows in [&mut self.acceleration, &mut self.rate, &mut self.drift] {
                rows.resize((MAX_DEGREE + 1) * row, [0.0; D]);
            }
            (self.shear, self.tangent) = (vec![[0.0; D]; width], vec![[0.0; D]; width]);
            let parts = 0..states[0].system.parts.len();
            self.matrices = parts.map(|part| Matrices::new(states.map(|state| &state.system.parts[part]))).collect();
        }
        for p in 0..width {
            let velocity = states.map(|state| state.v[p]);
            (self.drift[p], self.rate[p]) = (states.map(|state| state.x[p]), velocity);
            self.drift[row + p] = velocity.map(|v| h * v);
            self.tangent[p] = states.map(|state| state.regime.tangent[p]);
        }
        let none = [[0.0; D]; MAX_DEGREE + 1];
        let of_block = BlockTerms { node: 0, mass: 0.0, velocity: none, slip: none, friction: none };
        self.blocks.resize(states[0].moving.len(), of_block);
        for (block, &j) in self.blocks.iter_mut().zip(&states[0].moving) {
            (block.node, block.mass) = (states[0].system.blocks[j].floor, states[0].system.blocks[j].mass);
            for terms in [&mut block.velocity, &mut block.slip, &mut block.friction] {
                terms.fill([0.0; D]);
            }
            block.velocity[0] = states.map(|state| state.motions[j].velocity);
            block.slip[1] = block.velocity[0].map(|v| h * v);
        }
    }

    /// Terms of order k of accelerations, and those of rates, drifts and blocks that follow.
    #[inline]
    pub(super) fn form_order(&mut self, states: [&GeneralState; D], k: usize) {
        let (system, width, h) = (states[0].system, self.width, self.h);
        self.form_shear(states, k);
        let row = k * self.row;
        let force = &mut self.acceleration[row..row + width];
        force.iter_mut().for_each(|of_node| *of_node = [0.0; D]);
        for block in &self.blocks {
            let (force, friction) = (&mut force[block.node], &block.friction[k]);
            *force = each(|d| force[d] + block.mass * friction[d]);
        }
        let touches = states.iter().any(|state| !state.moving_contacts.is_empty());
        if touches {
            for (position, &block) in states[0].moving.iter().enumerate() {
                let of_stop = self.stop_term(states, position, block, k);
                let force = &mut self.acceleration[row + self.blocks[position].node];
                (0..D).for_each(|d| force[d] -= of_stop[d]);
            }
        }
        let force = &mut self.acceleration[row..row + width];
        let (shears, parents) = (&self.shear[..width], &system.parent[..width]);
        // First what springs above do: sums of one node wait for each other, those of all nodes need not.
        for (shear, &parent) in shears.iter().zip(parents).skip(1).rev() {
            let of_parent = &mut force[parent];
            *of_parent = each(|d| of_parent[d] + shear[d]);
        }
        let inverse_mass = &states[0].regime.inverse_mass[..width];
        for ((force, shear), inverse_mass) in force[1..].iter_mut().zip(&shears[1..]).zip(&inverse_mass[1..]) {
            *force = each(|d| (force[d] - shear[d]) * inverse_mass);
        }
        let ground = states.map(|state| match k {
            0 => state.interval.ground_at(self.tau),
            1 => state.interval.ground_slope * h,
            _ => 0.0,
        });
        let (of_rate, of_drift) = (h * INVERSE[k + 1], h * INVERSE[k + 2]);
        let (mut of_slab, mut rate_of_slab) = (ground, [0.0; D]);
        if let Some(base) = &system.base {
            for (d, state) in states.into_iter().enumerate() {
                let pushed = self.acceleration[row][d] - self.base_term(state, base, d, k);
                if state.base_moves() {
                    of_slab[d] = pushed * state.regime.inverse_mass[0];
                    rate_of_slab[d] = of_rate * (of_slab[d] - ground[d]);
                } else {
                    self.holding[k] = state.regime.slab_mass * ground[d] - pushed;
                }
            }
        }
        let force = &mut self.acceleration[row..row + width];
        let rates = &mut self.rate[row + self.row..][..width];
        let drifts = &mut self.drift[row + 2 * self.row..][..width];
        (force[0], rates[0], drifts[0]) = (of_slab, rate_of_slab, rate_of_slab.map(|rate| of_drift * rate));
        let of_nodes = force[1..].iter().zip(&parents[1..]).zip(rates[1..].iter_mut().zip(&mut drifts[1..]));
        for ((own, &parent), (rate, drift)) in of_nodes {
            let of_parent = &force[parent];
            let of_order: [f64; D] = each(|d| of_rate * (own[d] - of_parent[d]));
            (*rate, *drift) = (of_order, each(|d| of_drift * of_order[d]));
        }
        for position in 0..self.blocks.len() {
            let mut own = [0.0; D];
            if touches {
                let of_stop = self.stop_term(states, position, states[0].moving[position], k);
                own = of_stop.map(|force| force / self.blocks[position].mass);
            }
            let block = &mut self.blocks[position];
            let of_node = &self.acceleration[row + block.node];
            let velocity: [f64; D] = each(|d| of_rate * (own[d] - block.friction[k][d] - of_node[d]));
            (block.velocity[k + 1], block.slip[k + 2]) = (velocity, each(|d| of_drift * velocity[d]));
        }
    }

    /// Terms of order k of the forces of springs, dampers and elastic matrices between drifts.
    #[inline]
    fn form_shear(&mut self, states: [&GeneralState; D], k: usize) {
        let row = k * self.row..k * self.row + self.width;
        let (drift, rate) = (&self.drift[row.clone()], &self.rate[row]);
        for ((shear, tangent), drift) in self.shear.iter_mut().zip(&self.tangent).zip(drift) {
            *shear = each(|d| tangent[d] * drift[d]);
        }
        if k == 0 {
            for (p, shear) in self.shear.iter_mut().enumerate() {
                (0..D).for_each(|d| shear[d] += states[d].base_load[p]);
            }
        }
        for part in &self.matrices {
            let nodes = part.first..part.first + part.count;
            let shear = &mut self.shear[nodes.clone()];
            part.add(&part.damping, &rate[nodes.clone()], shear);
            part.add(&part.elastic, &drift[nodes], shear);
        }
    }

    /// Terms of order k of the forces of its stops on a block (N).
    fn stop_term(&self, states: [&GeneralState; D], position: usize, block: usize, k: usize) -> [f64; D] {
        let terms = &self.blocks[position];
        std::array::from_fn(|d| {
            let stop = &states[d].stops[block];
            let (Some(_), Some(stops)) = (stop.touching(), &states[d].system.stops[block]) else { return 0.0 };
            let beyond = if k == 0 { stop.beyond } else { terms.slip[k][d] };
            -(stops.stiffness * beyond + stops.damping * terms.velocity[k][d])
        })
    }

    /// Term of order k of the restoring force and friction against the slab of a sliding base (N). The contact force is linear
    /// in time, so the restoring force has products of two terms.
    fn base_term(&self, state: &GeneralState, base: &Base, d: usize, k: usize) -> f64 {
        if state.airborne {
            return 0.0;
        }
        let drift = |k: usize| self.drift[k * self.row][d];
        let (contact, change) = (state.interval.contact_at(self.tau), state.interval.contact_slope * self.h);
        let before = if k > 0 { change * drift(k - 1) } else { 0.0 };
        let friction = match k {
            0 => contact,
            1 => change,
            _ => 0.0,
        };
        base.restoring * (contact * drift(k) + before) + state.base_friction() * base.carried * friction
    }

    /// Relative velocity of the moving block at `position` at the place `s`.
    pub(super) fn velocity_at(&self, position: usize, s: f64) -> [f64; D] {
        let mut sum = [0.0; D];
        for term in self.blocks[position].velocity[..=self.order + 1].iter().rev() {
            sum = each(|d| sum[d] * s + term[d]);
        }
        sum
    }
}
