//! Peaks of the forces of floors: of a floor's own mass and of the goods on it.

use crate::lanes::{FAR, Vector};
use crate::regime::Row;
use crate::response::Peak;
use crate::state::State;
use crate::units::STANDARD_GRAVITY;

/// Peaks of floor forces. Between events a force is linear in the acceleration of its floor.
pub(crate) struct FloorForces {
    peaks: Vec<Peak>,
}

/// Mass that moves with floor `i`, and the friction of its other blocks per unit of the contact force: the force is the
/// first times the acceleration less the second times the contact force.
fn terms(state: &State, i: usize) -> (f64, f64) {
    (state.regime.row(Row::Mass)[i], state.blocks.friction[i])
}

impl FloorForces {
    pub(crate) fn new(storeys: usize) -> Self {
        Self { peaks: vec![Peak::default(); storeys] }
    }

    pub(crate) fn peaks(&self) -> Vec<Peak> {
        self.peaks.clone()
    }

    /// Whether accelerations of floor `i` up to `a`, with all its blocks stuck, could beat its peak.
    pub(crate) fn may_peak(&self, state: &State, i: usize, a: f64) -> bool {
        a * state.regime.row(Row::Mass)[i] > self.peaks[i].value
    }

    /// Takes the present forces, `tau` into the interval.
    pub(crate) fn take(&mut self, state: &State, tau: f64) {
        let (contact, time) = (state.contact_at(tau), state.interval.start + tau);
        for (i, peak) in self.peaks.iter_mut().enumerate() {
            let (mass, friction) = terms(state, i);
            peak.take(mass * state.kinematics.a[i] - friction * contact, time);
        }
    }

    /// Takes the extremes inside the present series, whose ranges are formed, from `tau` to its place `end`, before the
    /// state is advanced.
    pub(crate) fn observe<V: Vector, const K: usize>(&mut self, state: &State, tau: f64, end: f64) {
        let (drive, h) = (&state.step.drive, state.step.series.h());
        let (contact, change) = (drive.contact, drive.contact_slope * h);
        for (i, peak) in self.peaks.iter_mut().enumerate() {
            let (mass, friction) = terms(state, i);
            let (low, high) = state.step.ranges.acceleration::<K>(i);
            let most = mass * low.abs().max(high.abs()) + friction.abs() * contact.max(contact + change);
            if most > peak.value {
                let mut force = state.step.series.zeros();
                let limit = [-friction * contact, -friction * change];
                state.step.series.acceleration::<V, K>(i + 1, mass, limit, &mut force);
                let (first, others) = force.derivative().sign_changes::<V>();
                for s in first.into_iter().chain(others).filter(|&s| s < end) {
                    let time = state.interval.start + tau + s * h;
                    peak.take(force.at::<V>(s), time);
                }
            }
        }
    }

    /// Takes an acceleration of floor `i` where nothing slides on it: the force is then in proportion to it. Tells whether
    /// it beats the peak.
    pub(crate) fn take_acceleration(&mut self, state: &State, i: usize, a: f64, time: f64) -> bool {
        let (mass, friction) = terms(state, i);
        friction == 0.0 && self.peaks[i].take(mass * a, time)
    }

    /// Narrows the bounds of accelerations of a state, so that those of floors on which nothing slides are taken where they
    /// beat the peak of the force, and a step is plain only where no other force can beat its peak; with vertical motion no
    /// step is.
    pub(crate) fn narrow(&self, state: &mut State) {
        for (i, peak) in self.peaks.iter().enumerate() {
            let (mass, friction) = terms(state, i);
            state.bounds.stuck_mu[i] = state.blocks.stuck_mu[i + 1].min(FAR);
            if friction == 0.0 {
                state.bounds.a_peak[i] = state.bounds.a_peak[i].min(peak.value / mass);
            } else {
                let least = (peak.value - friction.abs() * STANDARD_GRAVITY).max(0.0) / (mass * STANDARD_GRAVITY);
                let least = if state.vertical { 0.0 } else { least };
                state.bounds.stuck_mu[i] = state.bounds.stuck_mu[i].min(least);
            }
        }
    }
}
