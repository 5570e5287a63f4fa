//! Accelerations of the present state, its series, and what they do to it.

use crate::lanes::{MAX_LANES, Vector, WIDTH, by_width, differences, for_each_path, lanes, lanes_mut, load, store};
use crate::regime::{RegimeOperator, Row};
use crate::scene::Motion;
use crate::state::State;
use crate::step::drive::{Drive, StepStart};

impl State<'_> {
    /// Sets the drive of a series that starts at `tau`.
    pub(crate) fn set_drive(&mut self, tau: f64) {
        self.set_ground_drive(tau);
        let Drive { contact, contact_slope, load, load_slope, .. } = &mut self.step.drive;
        let loads = load.iter_mut().zip(load_slope.iter_mut());
        for ((load, slope), (spring, friction)) in loads.zip(self.springs.load.iter().zip(&self.blocks.friction)) {
            *load = spring + friction * *contact;
            *slope = friction * *contact_slope;
        }
    }

    /// Sets the drive of a series that starts at `tau`, but for the loads, which tables do not need.
    #[inline]
    fn set_ground_drive(&mut self, tau: f64) {
        (self.step.drive.ground, self.step.drive.ground_slope) =
            (self.interval.ground_at(tau), self.interval.ground_slope);
        let slope = if self.blocks.airborne { 0.0 } else { self.interval.contact_slope };
        (self.step.drive.contact, self.step.drive.contact_slope) = (self.contact_at(tau), slope);
    }

    /// Forms accelerations and their rates at `tau` from the state.
    pub(crate) fn refresh_accelerations(&mut self, tau: f64) {
        by_width!(self.model.width, K => refresh::<K>(self, tau));
    }

    /// [`State::refresh_accelerations`] within the code of a path.
    #[inline(always)]
    pub(crate) fn refresh<V: Vector, const K: usize>(&mut self, tau: f64) {
        self.kinematics.jerk_slope = self.interval.contact_slope;
        if self.storeys() <= MAX_LANES { refresh_lanes::<V, K>(self, tau) } else { self.refresh_singly(tau) }
    }

    /// [`State::refresh_accelerations`] for more storeys than vectors hold.
    #[inline(never)]
    fn refresh_singly(&mut self, tau: f64) {
        let n = self.storeys();
        self.set_drive(tau);
        self.regime.accelerations(
            self.model,
            &self.kinematics.x,
            &self.kinematics.v,
            &self.step.drive.load,
            &mut self.kinematics.a[..n],
        );
        self.kinematics.form_drift_accelerations(n, self.step.drive.ground);
        let slope = &self.step.drive.load_slope;
        self.regime.accelerations(
            self.model,
            &self.kinematics.v,
            &self.kinematics.drift_acceleration,
            slope,
            &mut self.kinematics.jerk[..n],
        );
    }

    /// Adds the changes of the present series to drifts and drift rates; if the time of its end, `tau`, is given,
    /// accelerations follow: as the series ends, or formed anew where those at its start were taken so. Returns whether all
    /// is finite.
    #[inline(always)]
    pub(crate) fn take_changes<V: Vector, const K: usize>(&mut self, tau: Option<f64>) -> bool {
        let n = self.storeys();
        if n <= MAX_LANES {
            return changes_in_lanes::<V, K>(self, tau);
        }
        let [drifts, rates] = self.step.series.changes().map(|changes| &changes[..n]);
        let (x, v) = (&mut self.kinematics.x[..n], &mut self.kinematics.v[..n]);
        let mut zeros = 0.0;
        for i in 0..n {
            x[i] += drifts[i];
            v[i] += rates[i];
            zeros += 0.0 * (x[i] + v[i]);
        }
        if let Some(tau) = tau {
            self.refresh::<V, K>(tau);
        }
        zeros == 0.0
    }

    /// Forms the series over `h` from `tau`, where accelerations and their rates must be those of the state.
    #[inline(always)]
    pub(crate) fn form_series<V: Vector, const K: usize>(&mut self, tau: f64, h: f64) {
        let by_table = self.cache.prepare_table(self.key.entry, self.model, self.vertical);
        if by_table {
            self.set_ground_drive(tau);
        } else {
            self.set_drive(tau);
        }
        let start = StepStart {
            x: &self.kinematics.x,
            v: &self.kinematics.v,
            a: &self.kinematics.a,
            jerk: &self.kinematics.jerk,
        };
        let table = self.regime.steps(self.vertical).and_then(|steps| steps.table.as_ref()).filter(|_| by_table);
        self.step.series.form::<V, K>(self.model, (&self.regime, table), &start, &self.step.drive, h);
    }

    /// Moves on to the interval between samples `i` and `i + 1` of a motion, at whose start the state is: with vertical
    /// motion, the rates of accelerations turn there, as they do within a run of plain steps.
    #[inline(always)]
    pub(crate) fn begin_interval(&mut self, motion: &Motion, i: usize) {
        self.set_interval(motion, i);
        if self.vertical {
            turn(self, self.interval.contact_slope - self.kinematics.jerk_slope);
            self.kinematics.jerk_slope = self.interval.contact_slope;
        }
    }
}

for_each_path! {
    /// Has the rates of accelerations follow a change of the contact force's slope.
    fn turn(state: &mut State, change: f64) = turn_by_path
}

#[inline(always)]
fn turn_by_path<V: Vector>(state: &mut State, change: f64) {
    let inverse_mass = lanes(state.regime.row(Row::InverseMass));
    turned::<V>(&mut state.kinematics.jerk, lanes(&state.blocks.friction), inverse_mass, change);
}

/// Rates of accelerations once the slope of the contact force has changed.
#[inline(always)]
pub(crate) fn turned<V: Vector>(
    jerk: &mut [f64],
    friction: &[[f64; WIDTH]],
    inverse_mass: &[[f64; WIDTH]],
    change: f64,
) {
    for (jerk, (friction, inverse_mass)) in lanes_mut(jerk).iter_mut().zip(friction.iter().zip(inverse_mass)) {
        V::load(friction).mul(V::load(inverse_mass)).mul_add(V::splat(change), V::load(jerk)).store(jerk);
    }
}

for_each_path! {
    /// See [`State::refresh_accelerations`].
    fn refresh[K: usize](state: &mut State, tau: f64) = refresh_by_path
}

#[inline(always)]
fn refresh_by_path<V: Vector, const K: usize>(state: &mut State, tau: f64) {
    state.refresh::<V, K>(tau);
}

#[inline(always)]
fn refresh_lanes<V: Vector, const K: usize>(state: &mut State, tau: f64) {
    let operator = RegimeOperator::<V, K>::new(state.model, &state.regime);
    let inside: [V; K] = load(&state.model.lanes.inside);
    let (x, v): ([V; K], [V; K]) = (load(&state.kinematics.x), load(&state.kinematics.v));
    let (mut forces, friction): ([V; K], [V; K]) = (load(&state.springs.load), load(&state.blocks.friction));
    let contact_slope = if state.blocks.airborne { 0.0 } else { state.interval.contact_slope };
    let (contact, contact_slope) = (V::splat(state.contact_at(tau)), V::splat(contact_slope));
    let mut slopes = friction;
    for k in 0..K {
        forces[k] = friction[k].mul(contact).add(forces[k]);
        slopes[k] = friction[k].mul(contact_slope);
    }
    let a = operator.accelerations(&x, &v, &operator.floor_velocities(&v), forces);
    let ground = V::splat(state.interval.ground_at(tau));
    let (mut drift_acceleration, mut floors) = (differences(&a, ground), a);
    for k in 0..K {
        drift_acceleration[k] = drift_acceleration[k].mul(inside[k]);
        floors[k] = a[k].sub(ground);
    }
    let jerk = operator.accelerations(&v, &drift_acceleration, &floors, slopes);
    store(&a, &mut state.kinematics.a);
    store(&drift_acceleration, &mut state.kinematics.drift_acceleration);
    store(&jerk, &mut state.kinematics.jerk);
    state.kinematics.is_formed = true;
}

/// See [`State::take_changes`].
#[inline(always)]
fn changes_in_lanes<V: Vector, const K: usize>(state: &mut State, tau: Option<f64>) -> bool {
    let (mut x, mut v): ([V; K], [V; K]) = (load(&state.kinematics.x), load(&state.kinematics.v));
    let [drifts, rates] = state.step.series.changes();
    let (drifts, rates): ([V; K], [V; K]) = (load(drifts), load(rates));
    let mut zeros = V::splat(0.0);
    for k in 0..K {
        (x[k], v[k]) = (x[k].add(drifts[k]), v[k].add(rates[k]));
        // No number times zero is zero but a finite one.
        zeros = x[k].add(v[k]).mul_add(V::splat(0.0), zeros);
    }
    store(&x, &mut state.kinematics.x);
    store(&v, &mut state.kinematics.v);
    if let Some(tau) = tau {
        if state.kinematics.is_formed {
            let [a, jerk] = state.step.series.accelerations_at_end();
            let (a, jerk): ([V; K], [V; K]) = (load(a), load(jerk));
            let inside: [V; K] = load(&state.model.lanes.inside);
            let mut drift_acceleration = differences(&a, V::splat(state.interval.ground_at(tau)));
            for k in 0..K {
                drift_acceleration[k] = drift_acceleration[k].mul(inside[k]);
            }
            store(&a, &mut state.kinematics.a);
            store(&drift_acceleration, &mut state.kinematics.drift_acceleration);
            store(&jerk, &mut state.kinematics.jerk);
            state.kinematics.is_formed = false;
        } else {
            refresh_lanes::<V, K>(state, tau);
        }
    }
    zeros.sum() == 0.0
}
