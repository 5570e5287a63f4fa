//! A whole sample interval by the propagator, accepted only when bounds prove that no guard fell inside it and no peak
//! was beaten at a turn.
//!
//! Value and rate at both ends give the Bezier points of a cubic; the quantity differs from that cubic by at most
//! h^4 / 384 times its largest fourth derivative, which the regime bounds.

use crate::friction::BlockState;
use crate::observe::Observer;
use crate::state::State;

/// Range of the cubic through values and rates at both ends, widened by `margin`.
#[inline]
fn range(start: f64, start_rate: f64, end: f64, end_rate: f64, third: f64, margin: f64) -> (f64, f64) {
    let (first, second) = (start + third * start_rate, end - third * end_rate);
    let low = start.min(end).min(first.min(second));
    let high = start.max(end).max(first.max(second));
    (low - margin, high + margin)
}

/// Whether a range excludes zero.
#[inline]
fn one_signed((low, high): (f64, f64)) -> bool {
    low > 0.0 || high < 0.0
}

impl State<'_> {
    /// Forms the present interval as one step, and tells whether it may be accepted.
    pub(crate) fn step_is_plain(&mut self, observer: &Observer) -> bool {
        if !self.propagate() {
            return false;
        }
        let h = self.interval.h;
        let ground_slope = self.interval.slope(self.interval.ground_change);
        for (relative, jerk) in self.scratch.iter_mut().zip(&self.jerk) {
            *relative = jerk - ground_slope;
        }
        let liveliness = self.regime().liveliness(&self.drift_acceleration, &self.scratch, h);
        liveliness.is_finite()
            && self.storeys_are_clear(liveliness, observer)
            && self.floors_are_clear(liveliness, observer)
            && self.blocks_are_clear(liveliness)
    }

    /// Forms the step; false where the regime has no propagator.
    fn propagate(&mut self) -> bool {
        let regime = self.cache.regime(self.regime);
        let Some(propagator) = regime.propagator.as_deref() else { return false };
        if !self.effects.valid {
            propagator.of_load(&self.spring_load, &mut self.effects.constant);
            propagator.of_load(&self.friction, &mut self.effects.friction);
            if self.vertical {
                propagator.of_ramp(&self.friction, &mut self.effects.friction_ramp);
            } else {
                for (constant, friction) in self.effects.constant.iter_mut().zip(&self.effects.friction) {
                    *constant += friction * self.interval.contact;
                }
            }
            self.effects.valid = true;
        }
        self.step.copy_from_slice(&self.effects.constant);
        if self.vertical {
            let (contact, change) = (self.interval.contact, self.interval.contact_change);
            let effects = self.effects.friction.iter().zip(&self.effects.friction_ramp);
            for (step, (friction, ramp)) in self.step.iter_mut().zip(effects) {
                *step += friction * contact + ramp * change;
            }
        }
        propagator.advance(&self.x, &self.v, self.interval.ground, self.interval.ground_change, &mut self.step);
        true
    }

    /// Guards and peaks of the storeys.
    fn storeys_are_clear(&self, liveliness: f64, observer: &Observer) -> bool {
        let n = self.storeys();
        let regime = self.regime();
        let h = self.interval.h;
        let (third, remainder) = (h / 3.0, liveliness * h * h * h * h / 384.0);
        let [second, higher, _] = &regime.derivative_bounds;
        let (mut below_second, mut below_third) = (0.0, 0.0);
        let mut below_end = self.interval.ground + self.interval.ground_change;
        for i in 0..n {
            let (x, v) = (self.x[i], self.v[i]);
            let (x_end, v_end, a_end) = (x + self.step[i], v + self.step[n + i], self.step[2 * n + i]);
            let drift = range(x, v, x_end, v_end, third, remainder * (second[i] + below_second));
            let rate_margin = remainder * (higher[i] + below_third);
            let acceleration_end = a_end - below_end;
            (below_second, below_third, below_end) = (second[i], higher[i], a_end);
            let (low, high) = drift;
            let inside = |(lower, upper): (f64, f64)| high < upper && low > lower;
            if !(inside(self.yield_bounds[i]) && inside(self.collapse_bounds[i])) {
                return false;
            }
            let rate = || range(v, self.drift_acceleration[i], v_end, acceleration_end, third, rate_margin);
            if let Some(sign) = self.springs[i].plastic() {
                let (low, high) = rate();
                if !(if sign.factor() > 0.0 { low > 0.0 } else { high < 0.0 }) {
                    return false;
                }
            } else if observer.drift_may_peak(self, i, low, high) && !one_signed(rate()) {
                return false;
            }
        }
        true
    }

    /// Guards and peaks of the floor accelerations.
    fn floors_are_clear(&self, liveliness: f64, observer: &Observer) -> bool {
        let n = self.storeys();
        let regime = self.regime();
        let h = self.interval.h;
        let (third, remainder) = (h / 3.0, liveliness * h * h * h * h / 384.0);
        for i in 0..n {
            let (a, jerk) = (self.a[i], self.jerk[i]);
            let (a_end, jerk_end) = (self.step[2 * n + i], self.step[3 * n + i]);
            let (low, high) = range(a, jerk, a_end, jerk_end, third, remainder * regime.derivative_bounds[2][i]);
            let mu = self.stuck_mu[i + 1];
            if mu.is_finite() {
                let contact = self.interval.contact.min(self.interval.contact + self.interval.contact_change);
                if !(high < mu * contact && -low < mu * contact) {
                    return false;
                }
            }
            if observer.acceleration_may_peak(i, low, high) {
                let turn = 0.5 * h * liveliness * regime.derivative_bounds[0][i];
                if !(jerk * jerk_end > 0.0 && jerk.abs().min(jerk_end.abs()) > turn) {
                    return false;
                }
            }
        }
        let mu = self.stuck_mu[0];
        if mu.is_finite() {
            let Ends { start, end } = Ends::of(self);
            if !(start.0.abs() < mu * start.1 && end.0.abs() < mu * end.1) {
                return false;
            }
        }
        true
    }

    /// Guards of the sliding blocks.
    fn blocks_are_clear(&self, liveliness: f64) -> bool {
        if self.motions.is_empty() {
            return true;
        }
        let n = self.storeys();
        let h = self.interval.h;
        let (third, remainder) = (h / 3.0, liveliness * h * h * h * h / 384.0);
        let Ends { start, end } = Ends::of(self);
        if self.vertical && !(start.1 > 0.0 && end.1 > 0.0) {
            return false;
        }
        let mean_ground = 0.5 * (start.0 + end.0);
        let mean_contact = 0.5 * (start.1 + end.1);
        for (motion, law) in self.motions.iter().zip(&self.model.blocks) {
            let Some(sign) = motion.sliding() else { continue };
            let friction = sign.factor() * law.mu_k;
            let (mut change, mut margin) = (mean_ground * h, 0.0);
            let (mut a, mut a_end) = (start.0, end.0);
            if law.floor > 0 {
                let i = law.floor - 1;
                change += self.step[n..n + law.floor].iter().sum::<f64>();
                margin = remainder * self.regime().derivative_bounds[1][i];
                (a, a_end) = (self.a[i], self.step[2 * n + i]);
            }
            let velocity_end = motion.velocity - friction * mean_contact * h - change;
            let rate = -friction * start.1 - a;
            let rate_end = -friction * end.1 - a_end;
            let (low, high) = range(motion.velocity, rate, velocity_end, rate_end, third, margin);
            if !(if sign.factor() > 0.0 { low > 0.0 } else { high < 0.0 }) {
                return false;
            }
        }
        true
    }

    /// Takes over the step that was found plain.
    pub(crate) fn accept_step(&mut self, observer: &mut Observer) {
        let n = self.storeys();
        let Ends { start, end } = Ends::of(self);
        let h = self.interval.h;
        let ground_velocity = 0.5 * h * (start.0 + end.0);
        let ground_displacement = h * h * (2.0 * start.0 + end.0) / 6.0;
        let contact_velocity = 0.5 * h * (start.1 + end.1);
        let contact_displacement = h * h * (2.0 * start.1 + end.1) / 6.0;
        for (motion, law) in self.motions.iter_mut().zip(&self.model.blocks) {
            let BlockState::Sliding(sign) = motion.state else { continue };
            let friction = sign.factor() * law.mu_k;
            // Floor displacement beyond that at its initial velocity, and change of its velocity.
            let below = law.floor;
            let velocity: f64 = self.v[..below].iter().sum();
            let moved: f64 = self.step[..below].iter().sum::<f64>() - velocity * h + ground_displacement;
            let change: f64 = self.step[n..n + below].iter().sum::<f64>() + ground_velocity;
            motion.slip += motion.velocity * h - friction * contact_displacement - moved;
            motion.velocity -= friction * contact_velocity + change;
        }
        let mut below = end.0;
        for i in 0..n {
            self.x[i] += self.step[i];
            self.v[i] += self.step[n + i];
            self.a[i] = self.step[2 * n + i];
            self.jerk[i] = self.step[3 * n + i];
            self.drift_acceleration[i] = self.a[i] - below;
            below = self.a[i];
        }
        observer.observe_values(self, self.interval.start + h);
    }
}

/// (ground acceleration, contact force) at both ends of the present interval.
struct Ends {
    start: (f64, f64),
    end: (f64, f64),
}

impl Ends {
    fn of(state: &State) -> Self {
        let i = &state.interval;
        Self { start: (i.ground, i.contact), end: (i.ground + i.ground_change, i.contact + i.contact_change) }
    }
}
