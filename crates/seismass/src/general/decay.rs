//! Modes that decay so fast that they follow their loads (`numerics`, section 9.2).
//!
//! A real mode exp(-r t) of a regime has a shape f with r^2 M f - r C f + K f = 0. The matrices are symmetric, so that
//! f . (M v + K u/r) decays at the rate r whatever else moves. Where it has, f . (M u'' + K v/r) = f . p'/r, with the loads'
//! rate p', which is constant over a step: a condition for every term of the series. Terms that obey it do not pass their
//! rounding on r h times larger, and steps may be as long as the other modes allow.

use std::rc::Rc;

use nalgebra::{DMatrix, DVector};

use crate::general::regime::DecayingMode;
use crate::general::state::GeneralState;
use crate::general::terms::Terms;
use crate::polynomial::orders::INVERSE;
use crate::tolerances::{DECISION_ROUNDING, GENERAL_PHASE};

/// Least decay over a step, in powers of e, of modes that are looked for: it saves three series of a step.
const LEAST_DECAY: f64 = 4.0 * GENERAL_PHASE;

/// Least ratio of a mode's rate to that of the slow motion of its shape: beyond, the two are one mode that is hardly damped
/// more than critically.
const LEAST_RATIO: f64 = 16.0;

/// Rates converge with the square of their error.
const ITERATIONS: usize = 12;

impl DecayingMode {
    /// By how much terms of order k miss the condition.
    fn excess(&self, state: &GeneralState, terms: &Terms<1>, k: usize) -> f64 {
        let width = terms.width;
        let row = k * terms.row..k * terms.row + width;
        let (acceleration, rates) = (terms.acceleration[row.clone()].as_flattened(), terms.rate[row].as_flattened());
        let mut excess = if k == 0 { -self.load_rate(state, terms) / self.rate } else { 0.0 };
        for p in 1..width {
            excess += self.momentum[p] * (acceleration[p] - acceleration[0]) + self.stiffness[p] * rates[p];
        }
        for (contact, i) in state.moving_contacts.iter().zip(width..) {
            let velocity = &terms.blocks[contact.position].velocity;
            let of_node = acceleration[state.system.blocks[contact.block].floor] - acceleration[0];
            let relative = (k + 1) as f64 / terms.h * velocity[k + 1][0];
            excess += self.momentum[i] * (of_node + relative) + self.stiffness[i] * velocity[k][0];
        }
        excess
    }

    /// Rate f . p' of the loads: the ground's acceleration, and friction under vertical motion.
    fn load_rate(&self, state: &GeneralState, terms: &Terms<1>) -> f64 {
        let mut rate = -state.interval.ground_slope * self.momentum.iter().sum::<f64>();
        let of_friction = |position: usize| {
            let mass = state.system.blocks[state.moving[position]].mass;
            mass * terms.blocks[position].friction[1][0] / terms.h
        };
        for (position, &j) in state.moving.iter().enumerate() {
            rate += self.shape[state.system.blocks[j].floor] * of_friction(position);
        }
        for (contact, i) in state.moving_contacts.iter().zip(terms.width..) {
            rate -= self.shape[i] * of_friction(contact.position);
        }
        rate
    }

    /// Takes what terms of order k miss out of them.
    pub(super) fn correct(&self, state: &GeneralState, terms: &mut Terms<1>, k: usize) {
        let (system, width) = (state.system, terms.width);
        let excess = self.excess(state, terms, k);
        let (of_rate, of_drift) = (terms.h * INVERSE[k + 1], terms.h * INVERSE[k + 2]);
        let accelerations = terms.acceleration[k * terms.row..][..width].as_flattened_mut();
        let rates = terms.rate[(k + 1) * terms.row..][..width].as_flattened_mut();
        let drifts = terms.drift[(k + 2) * terms.row..][..width].as_flattened_mut();
        for p in 1..width {
            accelerations[p] -= excess * self.shape[p];
            let rate = of_rate * excess * (self.shape[p] - self.shape[system.parent[p]]);
            rates[p] -= rate;
            drifts[p] -= of_drift * rate;
        }
        let mut add = |position: usize, acceleration: f64| {
            let block = &mut terms.blocks[position];
            block.velocity[k + 1][0] += of_rate * acceleration;
            block.slip[k + 2][0] += of_drift * (of_rate * acceleration);
        };
        for (position, &j) in state.moving.iter().enumerate() {
            add(position, excess * self.shape[system.blocks[j].floor]);
        }
        for (contact, i) in state.moving_contacts.iter().zip(width..) {
            add(contact.position, -excess * self.shape[i]);
        }
    }

    /// Size of the terms of the condition: times rounding, what they may miss it by.
    fn size(&self, state: &GeneralState, sizes: &[f64], tau: f64) -> f64 {
        let of_nodes: f64 = sizes.iter().zip(&self.momentum).map(|(size, momentum)| size * momentum.abs()).sum();
        let of_contacts = state.moving_contacts.iter().zip(sizes.len()..).map(|(contact, i)| {
            let (j, mass) = (contact.block, state.system.blocks[contact.block].mass);
            let of_stop =
                contact.stiffness * state.stops[j].beyond.abs() + contact.damping * state.motions[j].velocity.abs();
            let friction = state.motions[j].mu_k * state.contact_at(tau);
            self.momentum[i].abs() * (of_stop / mass + friction)
        });
        of_nodes + of_contacts.sum::<f64>()
    }
}

/// How many modes, the fastest first, have decayed at `tau`, where a step of h may follow. What rounding leaves of them is
/// taken out of velocities, but of those that are exactly zero.
pub(super) fn decayed(state: &mut GeneralState, terms: &mut Terms<1>, tau: f64, h: f64) -> usize {
    let regime = Rc::clone(&state.regime);
    let time = state.interval.start + tau;
    if regime.damping * h < LEAST_DECAY || time < state.decays_until {
        return 0;
    }
    let modes = regime.decaying.get_or_init(|| modes(state));
    if modes.is_empty() {
        return 0;
    }
    terms.begin_sliding(state, tau, h, 0);
    terms.form_order([state], 0);
    let sizes = state.acceleration_sizes(tau);
    let mut left = Vec::with_capacity(modes.len());
    for mode in modes {
        let excess = mode.excess(state, terms, 0);
        let most = DECISION_ROUNDING * mode.size(state, &sizes, tau);
        if excess.abs() > most {
            // At rest nothing has a size yet: it is looked at again after the next step.
            if left.is_empty() && most > 0.0 {
                state.decays_until = time + libm::log(excess.abs() / most) / mode.rate;
            }
            break;
        }
        left.push((mode, excess));
    }
    let system = state.system;
    let add = |velocity: &mut f64, change: f64| {
        if *velocity != 0.0 {
            *velocity += change;
        }
    };
    for (mode, excess) in &left {
        let change = excess / mode.rate;
        for p in 1..=system.nodes {
            add(&mut state.v[p], change * (mode.shape[p] - mode.shape[system.parent[p]]));
        }
        for &j in &state.moving {
            add(&mut state.motions[j].velocity, -change * mode.shape[system.blocks[j].floor]);
        }
        for (contact, i) in state.moving_contacts.iter().zip(system.nodes + 1..) {
            add(&mut state.motions[contact.block].velocity, change * mode.shape[i]);
        }
    }
    left.len()
}

/// The modes of the present regime that decay fast within a sample interval.
fn modes(state: &GeneralState) -> Vec<DecayingMode> {
    let (system, contacts, width) = (state.system, &state.moving_contacts, state.system.nodes + 1);
    let mut modes = Vec::new();
    if state.base_moves() {
        return modes;
    }
    let of_blocks = contacts.iter().map(|contact| 1.0 / system.blocks[contact.block].mass);
    let root: Vec<f64> = state.regime.inverse_mass.iter().copied().chain(of_blocks).map(f64::sqrt).collect();
    let size = root.len();
    let of_nodes = |entries: &[f64]| DMatrix::from_row_slice(width, width, entries).resize(size, size, 0.0);
    let (mut c, mut k) = (of_nodes(&system.damping), of_nodes(&system.elastic));
    let add = |matrix: &mut DMatrix<f64>, p: usize, q: usize, value: f64| {
        matrix[(p, p)] += value;
        matrix[(q, q)] += value;
        matrix[(p, q)] -= value;
        matrix[(q, p)] -= value;
    };
    for p in 1..width {
        add(&mut k, p, system.parent[p], state.regime.tangent[p]);
    }
    for (contact, i) in contacts.iter().zip(width..) {
        let node = system.blocks[contact.block].floor;
        add(&mut c, i, node, contact.damping);
        add(&mut k, i, node, contact.stiffness);
    }
    for (i, j) in (0..size).flat_map(|i| (0..size).map(move |j| (i, j))) {
        c[(i, j)] *= root[i] * root[j];
        k[(i, j)] *= root[i] * root[j];
    }
    let unscaled = |values: &DVector<f64>, factor: f64| -> Vec<f64> {
        values.iter().zip(&root).map(|(y, root)| if *root > 0.0 { factor * y / root } else { 0.0 }).collect()
    };
    let (mut others, mut slow) = (DMatrix::identity(size, size), 0.0_f64);
    for n in 0..size {
        let Some((rate, y)) = mode(&c, &k, n, LEAST_DECAY / state.interval.h) else { break };
        let shape = y.iter().zip(&root).map(|(y, root)| y * root).collect();
        let force = &k * &y;
        let mut stiffness = unscaled(&force, 1.0 / rate);
        for (contact, i) in contacts.iter().zip(width..) {
            stiffness[system.blocks[contact.block].floor] += stiffness[i];
        }
        for p in (1..width).rev() {
            stiffness[system.parent[p]] += stiffness[p];
        }
        let across: DVector<f64> = (&others * &y).normalize();
        others -= &across * across.transpose();
        slow = slow.max(force.norm() / rate);
        let bound = |matrix: &DMatrix<f64>| {
            let rest = &others * matrix * &others;
            rest.row_iter().map(|row| row.lp_norm(1)).fold(0.0, f64::max)
        };
        let (kappa, sigma) = (bound(&c), bound(&k));
        let left = 0.5 * kappa + (0.25 * kappa * kappa + sigma).sqrt() + slow;
        modes.push(DecayingMode { rate, shape, momentum: unscaled(&y, 1.0), stiffness, left });
    }
    modes
}

/// Rate and shape, in coordinates scaled by the roots of the masses, of the n-th fastest real mode: the n-th eigenvalue r of
/// c - k/r. None where it is slower than `least`, or no faster than the slow motion of its shape.
fn mode(c: &DMatrix<f64>, k: &DMatrix<f64>, n: usize, least: f64) -> Option<(f64, DVector<f64>)> {
    let (mut rate, mut y, mut faster) = (f64::INFINITY, DVector::zeros(0), DMatrix::zeros(0, 0));
    for _ in 0..ITERATIONS {
        let eigen = (c - k / rate).symmetric_eigen();
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
        y = eigen.eigenvectors.column(order[n]).into_owned();
        faster = eigen.eigenvectors.select_columns(&order[..n]);
        let (half, stiffness) = (0.5 * (c * &y).dot(&y), (k * &y).dot(&y));
        let last = rate;
        rate = half + (half * half - stiffness).sqrt();
        if !(rate >= least && rate * rate >= LEAST_RATIO * stiffness) {
            return None;
        }
        if (rate - last).abs() <= 4.0 * f64::EPSILON * rate {
            break;
        }
    }
    // Small components as exact as the entries of their rows, but for those of faster modes, which would grow.
    for _ in 0..2 {
        y = (c * &y - k * &y / rate) / rate;
        y -= &faster * faster.tr_mul(&y);
        y.normalize_mut();
    }
    Some((rate, y))
}
