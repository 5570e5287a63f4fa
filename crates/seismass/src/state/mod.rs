//! The state of a run: drifts, drift rates, spring and block machines, and what one sample interval does to them.

pub(crate) mod blocks;
pub(crate) mod effort;
pub(crate) mod interval;
pub(crate) mod key;
pub(crate) mod kinematics;
pub(crate) mod limits;
pub(crate) mod ranges;
pub(crate) mod relative;
pub(crate) mod sample;
pub(crate) mod springs;
pub(crate) mod step;

use std::mem::take;
use std::rc::Rc;

use crate::lanes::{
    FAR, MAX_LANES, Padded, Vector, WIDEST, WIDTH, at, by_width, differences, for_each_path, lanes, lanes_mut, load,
    numbers, store,
};
use crate::machines::block::{BlockMotion, BlockState};
use crate::machines::model::Model;
use crate::machines::settle::Demand;
use crate::polynomial::enclosure::{THIRD, range};
use crate::regime::{Operator, Regime, Row};
use crate::scene::{Block, Motion, Scene, StoreyDamping};
use crate::state::blocks::Blocks;
use crate::state::effort::Effort;
use crate::state::interval::Interval;
use crate::state::key::RegimeKey;
use crate::state::key::WORD;
use crate::state::kinematics::Kinematics;
use crate::state::limits::{Bounds, BoundsInLanes};
use crate::state::sample::Sample;
use crate::state::springs::Springs;
use crate::state::step::Step;
use crate::step::cache::KnownRegime;
use crate::step::cache::RegimeCache;
use crate::step::drive::Drive;
use crate::step::drive::Start;

/// The state of a run and its working space. Vectors of storeys and floors are padded to whole lanes with zeros: those of
/// the kinematics, of the drive, and of loads and bases.
pub(crate) struct State<'a> {
    pub(crate) model: &'a Model,
    pub(crate) cache: &'a mut RegimeCache,
    pub(crate) vertical: bool,
    pub(crate) interval: Interval,
    pub(crate) kinematics: Kinematics,
    pub(crate) springs: Springs,
    pub(crate) blocks: Blocks,
    pub(crate) regime: Rc<KnownRegime>,
    pub(crate) key: RegimeKey,
    pub(crate) bounds: Bounds,
    pub(crate) step: Step,
    /// What a step of a tall building with peaks inside takes.
    pub(crate) effort: Effort,
}

impl<'a> State<'a> {
    /// The initial state of a scene; regime and accelerations are not formed yet.
    pub(crate) fn new(scene: &Scene, model: &'a Model, cache: &'a mut RegimeCache, vertical: bool) -> Self {
        let n = model.storeys();
        let velocity = scene.initial_velocity();
        let below = |i: usize| if i > 0 { velocity[i - 1] } else { 0.0 };
        let floor_velocity = |floor: usize| if floor > 0 { velocity[floor - 1] } else { 0.0 };
        let relative = |b: &Block| b.velocity.map_or(0.0, |w| w - floor_velocity(b.floor));
        let laws_of_blocks = model.blocks.iter().zip(scene.blocks());
        let motions = laws_of_blocks.map(|(law, block)| BlockMotion::new(law, relative(block))).collect();
        cache.begin_run();
        Self {
            model,
            cache,
            vertical,
            interval: Interval::default(),
            kinematics: Kinematics::new(
                model.width,
                Padded::filled(scene.initial_drift().iter().copied(), n, 0.0),
                Padded::filled((0..n).map(|i| velocity[i] - below(i)), n, 0.0),
            ),
            springs: Springs::new(model),
            blocks: Blocks::new(model, motions),
            regime: Rc::default(),
            key: RegimeKey::new(model),
            bounds: Bounds::new(n),
            step: Step::new(model),
            effort: Effort::default(),
        }
    }

    /// Number of storeys.
    #[inline]
    pub(crate) fn storeys(&self) -> usize {
        self.model.storeys()
    }

    /// Whether nothing moves and no spring is deformed.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.kinematics.x.iter().chain(&self.kinematics.v).all(|&value| value == 0.0)
            && self.blocks.motions.iter().all(BlockMotion::is_stuck)
    }

    /// Follows all state machines: bounds, loads, and the regime.
    pub(crate) fn enter_regime(&mut self) {
        by_width!(self.model.width, K => follow_machines::<K>(self));
        self.find_regime();
    }

    /// Follows a change of one storey's spring.
    #[inline(always)]
    pub(crate) fn enter_regime_of_spring<V: Vector, const K: usize>(&mut self, i: usize) {
        self.follow_spring::<V, K>(i);
        self.springs.form_loads::<V, K>(self.vectors::<K>());
        self.find_regime();
    }

    /// Follows changes of blocks.
    #[inline(always)]
    pub(crate) fn enter_regime_of_blocks<V: Vector, const K: usize>(&mut self) {
        self.follow_blocks::<V, K>();
        self.find_regime();
    }

    #[inline(always)]
    fn follow_spring<V: Vector, const K: usize>(&mut self, i: usize) {
        self.springs.follow::<V, K>(self.model, i);
        let segment = self.springs.machines[i].segment();
        self.bounds.follow_spring::<V, K>(i, self.springs.guarded_drift(i), segment.rate_sign);
        let bits = self.model.class_bits;
        let class = if bits == WORD { segment.tangent.to_bits() } else { u64::from(segment.class) };
        self.key.set_class(bits, i, class);
    }

    #[inline(always)]
    fn follow_blocks<V: Vector, const K: usize>(&mut self) {
        for k in 0..self.vectors::<K>() {
            self.blocks.friction.set_vector::<V, K>(k, V::splat(0.0));
            self.bounds.stuck_mu.set_vector::<V, K>(k, V::splat(FAR));
        }
        self.blocks.stuck_mass.fill(0.0);
        self.blocks.stuck_mu.fill(f64::INFINITY);
        self.blocks.is_sliding = false;
        let of_springs = self.model.class_bits * self.springs.machines.len();
        for (j, (motion, law)) in self.blocks.motions.iter().zip(&self.model.blocks).enumerate() {
            let floor = law.floor;
            self.key.set_stuck(of_springs, j, motion.is_stuck());
            match motion.state {
                BlockState::Stuck => {
                    let least = self.blocks.stuck_mu[floor].min(motion.mu_s);
                    self.blocks.stuck_mu[floor] = least;
                    if let Some(i) = floor.checked_sub(1) {
                        self.blocks.stuck_mass[i] += law.mass;
                        self.bounds.stuck_mu.set_lane::<V, K>(i, least.min(FAR));
                    }
                }
                BlockState::Sliding(sign) => {
                    self.blocks.is_sliding = true;
                    if let Some(i) = floor.checked_sub(1) {
                        let others = self.blocks.friction.numbers::<K>()[i];
                        self.blocks.friction.set_lane::<V, K>(i, others + sign.factor() * motion.mu_k * law.mass);
                    }
                }
                BlockState::Airborne => {}
            }
        }
    }

    fn find_regime(&mut self) {
        let (model, springs, stuck_mass) = (self.model, &self.springs.machines, &self.blocks.stuck_mass);
        let form = || Regime::new(model, |i| springs[i].segment().tangent, stuck_mass);
        let known;
        (self.regime, self.key.entry, known) = self.cache.enter(&self.key.words, form);
        if known {
            self.key.entered.1 += 1;
        } else {
            self.key.entered.0 += 1;
        }
        self.step.effects.valid = false;
    }

    /// Contact force per unit mass as the blocks feel it: zero while airborne.
    #[inline]
    pub(crate) fn contact_at(&self, tau: f64) -> f64 {
        if self.blocks.airborne { 0.0 } else { self.interval.contact_at(tau).max(0.0) }
    }

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
        let start =
            Start { x: &self.kinematics.x, v: &self.kinematics.v, a: &self.kinematics.a, jerk: &self.kinematics.jerk };
        let table = self.regime.steps(self.vertical).and_then(|steps| steps.table.as_ref()).filter(|_| by_table);
        self.step.series.form::<V, K>(self.model, (&self.regime, table), &start, &self.step.drive, h);
    }

    /// Vectors of storeys: `K`, or as many as there are where the most do not hold them.
    #[inline(always)]
    pub(crate) fn vectors<const K: usize>(&self) -> usize {
        if K < WIDEST { K } else { self.model.width / WIDTH }
    }

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
    /// that [`Regime::liveliness_of`] takes.
    #[inline]
    fn bound_derivatives(&mut self, square: f64) {
        let h = self.step.series.h();
        let liveliness = self.regime.liveliness_of(square, h);
        self.step.ranges.set_margins(liveliness, h);
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

    /// [`State::acceleration_size`] within the code of a path.
    #[inline(always)]
    pub(crate) fn size_in_lanes<V: Vector, const K: usize>(&self, floor: usize, contact: f64) -> f64 {
        if K == WIDEST || floor == 0 {
            return self.acceleration_size(floor, contact);
        }
        let operator = Operator::<V, K>::new(self.model, &self.regime);
        let (mut x, mut v): ([V; K], [V; K]) = (load(&self.kinematics.x), load(&self.kinematics.v));
        let (loads, mut forces): ([V; K], [V; K]) = (load(&self.springs.base_load), load(&self.blocks.friction));
        for k in 0..K {
            (x[k], v[k]) = (x[k].abs(), v[k].abs());
            forces[k] = forces[k].abs().mul(V::splat(contact));
        }
        numbers(&operator.sizes(&x, &v, &loads, forces)).as_flattened()[floor - 1]
    }

    /// Sum of the sizes of the terms of a floor's acceleration: times rounding, its error.
    pub(crate) fn acceleration_size(&self, floor: usize, contact: f64) -> f64 {
        let Some(i) = floor.checked_sub(1) else { return self.step.drive.ground.abs() };
        let above = if i + 1 < self.storeys() { self.shear_size(i + 1) } else { 0.0 };
        (self.shear_size(i) + above + self.blocks.friction[i].abs() * contact) * self.regime.row(Row::InverseMass)[i]
            + self.mass_damping_size(i)
    }

    /// Sum of the sizes of the terms of a storey's force.
    fn shear_size(&self, i: usize) -> f64 {
        let elastic = (self.regime.row(Row::Tangent)[i] * self.kinematics.x[i]).abs() + self.springs.base_load[i].abs();
        let viscous = match self.model.damping() {
            StoreyDamping::None => 0.0,
            StoreyDamping::Rayleigh { stiffness_factor, .. } => {
                (stiffness_factor * self.model.stiffness[i] * self.kinematics.v[i]).abs()
            }
            // The matrix is symmetric: a column is a row.
            StoreyDamping::Dense(d) => {
                let n = self.storeys();
                d.as_slice()[n * i..n * (i + 1)].iter().zip(&self.kinematics.v).map(|(c, rate)| (c * rate).abs()).sum()
            }
        };
        elastic + viscous
    }

    /// Size of the mass-proportional damping in a floor's acceleration.
    fn mass_damping_size(&self, i: usize) -> f64 {
        let StoreyDamping::Rayleigh { mass_factor, .. } = self.model.damping() else { return 0.0 };
        let velocity: f64 = self.kinematics.v[..=i].iter().map(|v| v.abs()).sum();
        velocity * mass_factor * self.model.mass[i] * self.regime.row(Row::InverseMass)[i]
    }

    /// What floor `floor` (0: the ground) asks of its blocks at `tau`, where its acceleration must be that of the state.
    pub(crate) fn demand<const K: usize>(&self, floor: usize, tau: f64) -> Demand {
        if floor == 0 {
            return Demand::Ground { acceleration: self.interval.ground_at(tau) };
        }
        let i = floor - 1;
        let contact = self.contact_at(tau);
        let mass = self.regime.row(Row::Mass)[i];
        Demand::Floor {
            force: self.kinematics.a.numbers::<K>()[i] * mass - self.blocks.friction.numbers::<K>()[i] * contact,
            size: self.acceleration_size(floor, contact) * mass,
            mass: self.model.mass[i],
        }
    }

    /// Moves on to the interval between samples `i` and `i + 1` of a motion, or to a point at the last sample.
    #[inline(always)]
    pub(crate) fn set_interval(&mut self, motion: &Motion, i: usize) {
        let vertical = motion.vertical().filter(|_| self.vertical);
        self.interval = interval::interval(motion, vertical, i);
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
    /// Follows all springs and blocks.
    fn follow_machines[K: usize](state: &mut State) = machines_by_path
}

#[inline(always)]
fn machines_by_path<V: Vector, const K: usize>(state: &mut State) {
    for i in 0..state.storeys() {
        state.follow_spring::<V, K>(i);
    }
    state.springs.form_loads::<V, K>(state.vectors::<K>());
    state.follow_blocks::<V, K>();
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
    let operator = Operator::<V, K>::new(state.model, &state.regime);
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
