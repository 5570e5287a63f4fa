//! What a run need not solve: heads of zeros, and tails in which nothing can happen any more.

use crate::machines::block::BlockMotion;
use crate::regime::Row;
use crate::run::exact_run::ExactRun;
use crate::scene::Motion;
use crate::tolerances::SAME_PEAK;

impl ExactRun<'_> {
    /// The first interval in which anything can move: before it, zeros drive a scene at rest.
    pub(crate) fn skip_head_at_rest(&mut self, motion: &Motion) -> usize {
        if self.state.vertical || !self.state.is_at_rest() {
            return 0;
        }
        let samples = motion.acceleration();
        let at_rest = samples.iter().position(|&a| a != 0.0).unwrap_or(samples.len());
        let first = at_rest.saturating_sub(1);
        for sample in 1..=first {
            self.observer.record(&self.state, sample);
        }
        self.statistics.skipped.head_samples = first;
        first
    }

    /// Whether in a motionless tail the energy left bounds everything below its peak and its guard.
    pub(crate) fn no_peak_can_be_beaten(&self) -> bool {
        let state = &self.state;
        let regime = &state.regime;
        let tangent = &regime.row(Row::Tangent)[..state.storeys()];
        let settled = state.blocks.motions.iter().all(BlockMotion::is_stuck)
            && state.springs.machines.iter().all(|s| s.rate_sign().is_none())
            && tangent.iter().all(|&k| k > 0.0);
        if !settled || state.vertical || !regime.is_passive() {
            return false;
        }
        let rest: Vec<f64> = (0..state.storeys())
            .map(|i| -state.springs.machines[i].base_load(&state.model.laws[i]) / tangent[i])
            .collect();
        let kinetic: f64 =
            regime.row(Row::Mass).iter().zip(state.kinematics.floor_velocities()).map(|(m, v)| m * v * v).sum();
        let elastic: f64 = (0..rest.len()).map(|i| tangent[i] * (state.kinematics.x[i] - rest[i]).powi(2)).sum();
        // Wider than rounding: without damping the same peak comes back in each cycle.
        let derivative_norm = (kinetic + elastic).sqrt() * (1.0 + SAME_PEAK);
        let contact = state.interval.contact;
        (0..rest.len()).all(|i| {
            let reach = derivative_norm / tangent[i].sqrt();
            let (low, high) = (rest[i] - reach, rest[i] + reach);
            let (lower, upper) = state.springs.segment_ends[i];
            let a = derivative_norm * regime.row(Row::SecondOfAcceleration)[i];
            // What beats no peak does not collapse either.
            (high < upper && low > lower)
                && !self.observer.drift_may_peak(state, i, low, high)
                && !self.observer.acceleration_may_peak(i, -a, a)
                && !self.observer.forces.as_ref().is_some_and(|forces| forces.may_peak(state, i, a))
                && a < state.blocks.stuck_mu[i + 1] * contact
        })
    }
}
