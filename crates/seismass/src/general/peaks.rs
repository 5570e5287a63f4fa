//! Peaks in continuous time (`numerics`, section 5.5).

use crate::general::response::GeneralPeaks;
use crate::general::series::{Quantity, Series};
use crate::general::state::GeneralState;
use crate::lanes::Plain;
use crate::machines::block::BlockState;
use crate::polynomial::power::Polynomial;
use crate::response::Peak;

/// Peaks so far. Lists by node have an entry for the ground, or for the slab of a sliding base.
pub(super) struct Observer {
    drift: Vec<Peak>,
    shear: Vec<Peak>,
    acceleration: Vec<Peak>,
    base_shear: Peak,
    slip: Vec<Peak>,
    contact_force: Vec<Peak>,
    contact_velocity: Vec<Peak>,
    /// The first node that moves: the slab of a sliding base, or floor 1.
    first: usize,
}

/// Places in (0, `end`) where a polynomial changes sign.
pub(super) fn turns(polynomial: &Polynomial, end: f64) -> impl Iterator<Item = f64> {
    let (first, others) = polynomial.sign_changes::<Plain>();
    first.into_iter().chain(others).filter(move |&s| s < end)
}

impl Observer {
    pub(super) fn new(state: &GeneralState) -> Self {
        let none = |count: usize| vec![Peak::default(); count];
        let (width, goods) = (state.system.nodes + 1, state.motions.len());
        Self {
            drift: none(width),
            shear: none(width),
            acceleration: none(width),
            base_shear: Peak::default(),
            slip: none(goods),
            contact_force: none(goods),
            contact_velocity: none(goods),
            first: usize::from(state.base.is_none()),
        }
    }

    /// Peaks of slip and acceleration of the slab.
    pub(super) fn of_base(&self) -> (Peak, Peak) {
        (self.drift[0], self.acceleration[0])
    }

    pub(super) fn finish(self) -> GeneralPeaks {
        let of_nodes = |peaks: &[Peak]| peaks[1..].to_vec();
        GeneralPeaks {
            drift: of_nodes(&self.drift),
            acceleration: of_nodes(&self.acceleration),
            shear: of_nodes(&self.shear),
            base_shear: self.base_shear,
            slip: self.slip,
            contact_force: self.contact_force,
            contact_velocity: self.contact_velocity,
        }
    }

    /// Takes the present drifts, slips and contact forces.
    pub(super) fn take_values(&mut self, state: &GeneralState, time: f64) {
        for p in 1..=state.system.nodes {
            self.drift[p].take(state.drift(p), time);
            self.shear[p].take(state.spring_force(p), time);
        }
        self.drift[0].take(state.x[0], time);
        self.base_shear.take(base_shear(state, &state.x), time);
        for (j, motion) in state.motions.iter().enumerate() {
            self.slip[j].take(motion.slip, time);
            self.contact_force[j].take(state.stop_force(j), time);
        }
    }

    /// Takes accelerations of all nodes, that of the ground first.
    pub(super) fn take_accelerations(&mut self, accelerations: &[f64], time: f64) {
        for (peak, &a) in self.acceleration.iter_mut().zip(accelerations).skip(self.first) {
            peak.take(a, time);
        }
    }

    /// Takes the acceleration of a node.
    pub(super) fn take_node(&mut self, node: usize, acceleration: f64, time: f64) {
        self.acceleration[node].take(acceleration, time);
    }

    /// Takes the velocity at which a block comes to its stop.
    pub(super) fn take_contact_velocity(&mut self, block: usize, velocity: f64, time: f64) {
        self.contact_velocity[block].take(velocity, time);
    }

    /// Takes the extremes inside a series up to its place `end`, before the state is advanced; returns how many quantities
    /// could not be cleared by a bound.
    pub(super) fn observe(&mut self, state: &mut GeneralState, series: &Series, end: f64) -> usize {
        let start = state.interval.start + series.tau;
        let time = |s: f64| start + s * series.h;
        let mut isolated = 0;
        for p in 1..=state.system.nodes {
            let (low, high) = series.range(Quantity::Rate, p);
            if low <= 0.0 && high >= 0.0 && self.drift_may_peak(state, series, p) {
                isolated += 1;
                let (rate, _) = series.polynomial(Quantity::Rate, p, 1.0, 0.0);
                let (drift, _) = series.polynomial(Quantity::Drift, p, 1.0, 0.0);
                for s in turns(&rate, end) {
                    let x = drift.at::<Plain>(s);
                    self.drift[p].take(state.base_drift[p] + x, time(s));
                    self.shear[p].take(state.springs[p - 1].segment().force(x), time(s));
                }
            }
        }
        if state.base.is_some_and(|motion| motion.state == BlockState::Airborne) {
            isolated += 1;
            let (rate, _) = series.polynomial(Quantity::Rate, 0, 1.0, 0.0);
            let (slip, _) = series.polynomial(Quantity::Drift, 0, 1.0, 0.0);
            for s in turns(&rate, end) {
                self.drift[0].take(slip.at::<Plain>(s), time(s));
            }
        }
        for p in self.first..=state.system.nodes {
            let (low, high) = series.range(Quantity::Acceleration, p);
            if low.abs().max(high.abs()) > self.acceleration[p].value {
                isolated += 1;
                let (a, _) = series.polynomial(Quantity::Acceleration, p, 1.0, 0.0);
                for s in turns(&a.derivative(), end) {
                    self.acceleration[p].take(a.at::<Plain>(s), time(s));
                }
            }
        }
        isolated += self.observe_base_shear(state, series, end);
        for position in 0..state.moving.len() {
            isolated += self.observe_block(state, series, position, end);
        }
        isolated
    }

    fn drift_may_peak(&self, state: &GeneralState, series: &Series, p: usize) -> bool {
        let (low, high) = series.range(Quantity::Drift, p);
        let segment = state.springs[p - 1].segment();
        let beats = |values: [f64; 2], peak: &Peak| values[0].abs().max(values[1].abs()) > peak.value;
        beats([low, high].map(|x| segment.base_drift + x), &self.drift[p])
            || beats([low, high].map(|x| segment.force(x)), &self.shear[p])
    }

    /// The base shear has extremes of its own where an elastic matrix takes part.
    fn observe_base_shear(&mut self, state: &GeneralState, series: &Series, end: f64) -> usize {
        let Some(part) = state.system.parts.first().filter(|part| !part.elastic.is_empty()) else {
            if state.system.storeys > 0 && self.shear[1].value > self.base_shear.value {
                self.base_shear = self.shear[1];
            }
            return 0;
        };
        let count = part.count;
        let shear = base_shear_terms(state, series, Quantity::Drift, count);
        let base = base_shear(state, &vec![0.0; state.x.len()]);
        let reach: f64 = shear.coefficients().iter().map(|c| c.abs()).sum();
        if base.abs() + reach <= self.base_shear.value {
            return 0;
        }
        for s in turns(&base_shear_terms(state, series, Quantity::Rate, count), end) {
            self.base_shear.take(base + shear.at::<Plain>(s), state.interval.start + series.tau + s * series.h);
        }
        1
    }

    /// Slips turn in flight alone between events; contact forces may turn wherever a block moves at its stop.
    fn observe_block(&mut self, state: &mut GeneralState, series: &Series, position: usize, end: f64) -> usize {
        let block = state.moving[position];
        let start = state.interval.start + series.tau;
        let mut isolated = 0;
        if state.motions[block].state == BlockState::Airborne {
            isolated += 1;
            let (at_start, slip) = (state.motions[block].slip, series.slip_of(position));
            for s in turns(&series.velocity_of(position), end) {
                self.slip[block].take(at_start + slip.at::<Plain>(s), start + s * series.h);
            }
        }
        if let (Some(_), Some(stops)) = (state.stops[block].touching(), &state.system.stops[block]) {
            let (beyond, velocity, slip) =
                (state.stops[block].beyond, series.velocity_of(position), series.slip_of(position));
            let terms = slip.coefficients().iter().enumerate().map(|(k, slip)| {
                let slip = if k == 0 { beyond } else { *slip };
                stops.stiffness * slip + stops.damping * velocity.coefficients[k]
            });
            let force = Polynomial::new(terms);
            self.contact_force[block].take(force.coefficients[0], start);
            if force.coefficients().iter().map(|c| c.abs()).sum::<f64>() > self.contact_force[block].value {
                isolated += 1;
                for s in turns(&force.derivative(), end) {
                    self.contact_force[block].take(force.at::<Plain>(s), start + s * series.h);
                }
            }
        }
        isolated
    }
}

/// The base shear over a step as a polynomial, or its rate, without what it is at the bases of the segments.
fn base_shear_terms(state: &GeneralState, series: &Series, quantity: Quantity, count: usize) -> Polynomial {
    let stiffness = base_stiffness(state, count);
    let of_order = |row: &[f64]| stiffness.iter().zip(&row[1..]).fold(0.0, |sum, (k, value)| sum + k * value);
    Polynomial::new(series.orders(quantity).map(of_order))
}

/// The base shear over a step as a polynomial.
pub(super) fn base_shear_series(state: &GeneralState, series: &Series) -> Polynomial {
    let count = if state.system.parts[0].elastic.is_empty() { 1 } else { state.system.parts[0].count };
    let mut shear = base_shear_terms(state, series, Quantity::Drift, count);
    shear.coefficients[0] += base_shear(state, &vec![0.0; state.x.len()]);
    shear
}

/// Stiffnesses by which drifts from the bases of their segments enter the base shear.
fn base_stiffness(state: &GeneralState, count: usize) -> Vec<f64> {
    // The first column of the symmetric matrix is its first row.
    let mut stiffness = state.system.parts[0].elastic.iter().copied().take(count).collect::<Vec<f64>>();
    stiffness.resize(count, 0.0);
    stiffness[0] += state.springs[0].segment().tangent;
    stiffness
}

/// Spring force of storey 1 and the share of the elastic matrix at drifts from the bases of the segments.
pub(super) fn base_shear(state: &GeneralState, x: &[f64]) -> f64 {
    if state.system.storeys == 0 {
        return 0.0;
    }
    let of_spring = state.springs[0].segment().force(x[1]);
    let part = &state.system.parts[0];
    let of_matrix = part.elastic.iter().take(part.count).enumerate();
    of_spring + of_matrix.map(|(i, k)| k * (state.base_drift[i + 1] + x[i + 1])).sum::<f64>()
}
