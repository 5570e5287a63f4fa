//! The state of a run: drifts, drift rates, spring and block machines, and what one sample interval does to them.

pub(crate) mod effort;
pub(crate) mod interval;
pub(crate) mod limits;
pub(crate) mod ranges;
pub(crate) mod sample;

use std::mem::take;
use std::rc::Rc;

use crate::step::cache::KnownRegime;
use crate::lanes::{
    FAR, MAX_LANES, Padded, PaddedRows, Vector, WIDEST, WIDTH, at, by_width, differences, for_each_path, lanes,
    lanes_mut, load, numbers, store,
};
use crate::machines::block::{BlockMotion, BlockState};
use crate::machines::model::Model;
use crate::machines::settle::{Demand, Transition};
use crate::machines::storey::StoreySpring;
use crate::polynomial::enclosure::{THIRD, range};
use crate::regime::{Operator, Regime, Row};
use crate::scene::{Block, Motion, Scene, StoreyDamping};
use crate::state::effort::Effort;
use crate::state::interval::Interval;
use crate::state::limits::{Bounds, BoundsInLanes};
use crate::state::ranges::Ranges;
use crate::state::sample::Sample;
use crate::step::cache::RegimeCache;
use crate::step::drive::Drive;
use crate::step::drive::Start;
use crate::step::series::Series;

/// Bits of a word.
const WORD: usize = u64::BITS as usize;

/// Sets the bits of a mask, from bit `first` on, which do not lie across two words.
#[inline]
fn set_bits(words: &mut [u64], first: usize, mask: u64, bits: u64) {
    let (word, shift) = (&mut words[first / WORD], first % WORD);
    *word = *word & !(mask << shift) | bits << shift;
}

/// Effect of the floor loads of the present state on the step of the regime's propagator.
#[derive(Debug, Default)]
pub(crate) struct LoadEffects {
    pub(crate) valid: bool,
    /// Of the springs' base forces (and of friction, without vertical motion).
    pub(crate) constant: PaddedRows<4>,
    /// With vertical motion: of friction at unit contact force.
    pub(crate) friction: PaddedRows<4>,
    /// With vertical motion: of friction with the contact force growing from zero to one.
    pub(crate) friction_ramp: PaddedRows<4>,
}

/// The state of a run and its working space. Vectors of storeys and floors are padded to whole lanes with zeros, from
/// `x` to `drift_acceleration`, and those of `drive`, `spring_load`, `friction` and the springs' bases.
pub(crate) struct State<'a> {
    pub(crate) model: &'a Model,
    pub(crate) cache: &'a mut RegimeCache,
    pub(crate) vertical: bool,
    pub(crate) interval: Interval,
    /// Drift of each storey since its spring's base.
    pub(crate) x: Padded,
    /// Drift rate of each storey.
    pub(crate) v: Padded,
    /// Absolute acceleration of each floor.
    pub(crate) a: Padded,
    /// Its rate.
    pub(crate) jerk: Padded,
    /// Second derivative of each drift.
    pub(crate) drift_acceleration: Padded,
    /// With vertical motion: slope of the contact force that the rates of accelerations follow (m/s3).
    pub(crate) jerk_slope: f64,
    /// Whether accelerations and their rates were formed from drifts and drift rates, not taken from a series: that may
    /// be done once, for their errors would add up.
    pub(crate) is_formed: bool,
    pub(crate) springs: Vec<StoreySpring>,
    pub(crate) motions: Vec<BlockMotion>,
    /// Whether the blocks have lost contact.
    pub(crate) airborne: bool,
    /// Whether a block slides.
    pub(crate) is_sliding: bool,
    /// The regime, and its index in the cache.
    pub(crate) regime: Rc<KnownRegime>,
    pub(crate) entry: usize,
    /// Force of the springs at their bases on each floor (N).
    pub(crate) spring_load: Padded,
    /// Friction on each floor per unit contact force: sum of sign mu_k m over its sliding blocks (kg).
    pub(crate) friction: Padded,
    /// Smallest mu_s of the blocks stuck to the ground (0) and to each floor; infinite where none is.
    pub(crate) stuck_mu: Vec<f64>,
    /// Drift coordinates at which the segment of each storey's spring ends.
    pub(crate) segment_ends: Vec<(f64, f64)>,
    /// Drift coordinates at which each storey collapses.
    pub(crate) collapse_bounds: Vec<(f64, f64)>,
    /// Drift of each storey at its spring's base.
    pub(crate) base_drift: Padded,
    /// Spring force of each storey at its base (N).
    pub(crate) base_force: Padded,
    /// The same less P-Delta (N).
    pub(crate) base_load: Padded,
    pub(crate) effects: LoadEffects,
    pub(crate) drive: Drive,
    pub(crate) series: Series,
    pub(crate) bounds: Bounds,
    pub(crate) ranges: Ranges,
    /// What a step of a tall building with peaks inside takes.
    pub(crate) effort: Effort,
    /// Working space: what becomes of the blocks of a floor.
    pub(crate) transitions: Vec<Transition>,
    stuck_mass: Vec<f64>,
    /// Class of each storey's segment, in [`Model::class_bits`] each, and which blocks are stuck: the key of the regime.
    key: Vec<u64>,
    /// Different regimes entered by this run, and changes into a regime already known to it.
    pub(crate) regimes: (usize, usize),
}

impl<'a> State<'a> {
    /// The initial state of a scene; regime and accelerations are not formed yet.
    pub(crate) fn new(scene: &Scene, model: &'a Model, cache: &'a mut RegimeCache, vertical: bool) -> Self {
        let n = model.storeys();
        let velocity = scene.initial_velocity();
        let below = |i: usize| if i > 0 { velocity[i - 1] } else { 0.0 };
        let floor_velocity = |floor: usize| if floor > 0 { velocity[floor - 1] } else { 0.0 };
        let blocks = scene.blocks().len();
        let relative = |b: &Block| b.velocity.map_or(0.0, |w| w - floor_velocity(b.floor));
        let laws_of_blocks = model.blocks.iter().zip(scene.blocks());
        let motions = laws_of_blocks.map(|(law, block)| BlockMotion::new(law, relative(block))).collect();
        cache.begin_run();
        let zero = || Padded::new(model.width, 0.0);
        Self {
            model,
            cache,
            vertical,
            interval: Interval::default(),
            x: Padded::filled(scene.initial_drift().iter().copied(), n, 0.0),
            v: Padded::filled((0..n).map(|i| velocity[i] - below(i)), n, 0.0),
            a: zero(),
            jerk: zero(),
            drift_acceleration: zero(),
            jerk_slope: 0.0,
            is_formed: false,
            springs: model.laws.iter().map(StoreySpring::new).collect(),
            motions,
            airborne: false,
            is_sliding: false,
            regime: Rc::default(),
            entry: 0,
            spring_load: zero(),
            friction: zero(),
            stuck_mu: vec![f64::INFINITY; n + 1],
            segment_ends: vec![(f64::NEG_INFINITY, f64::INFINITY); n],
            collapse_bounds: vec![(f64::NEG_INFINITY, f64::INFINITY); n],
            base_drift: zero(),
            base_force: zero(),
            base_load: zero(),
            effects: LoadEffects {
                valid: false,
                constant: PaddedRows::zeros(model.width),
                friction: PaddedRows::zeros(model.width),
                friction_ramp: PaddedRows::zeros(model.width),
            },
            drive: Drive { load: zero(), load_slope: zero(), ..Drive::default() },
            series: Series::default(),
            bounds: Bounds::new(n),
            ranges: Ranges::new(n),
            effort: Effort::default(),
            transitions: Vec::new(),
            stuck_mass: vec![0.0; n],
            key: vec![0; (model.class_bits * n + blocks).div_ceil(WORD)],
            regimes: (0, 0),
        }
    }

    /// Number of storeys.
    #[inline]
    pub(crate) fn storeys(&self) -> usize {
        self.model.storeys()
    }

    /// Whether nothing moves and no spring is deformed.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.x.iter().chain(&self.v).all(|&value| value == 0.0) && self.motions.iter().all(BlockMotion::is_stuck)
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
        self.follow_springs::<V, K>();
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
        let (spring, law) = (&self.springs[i], &self.model.laws[i]);
        let segment = *spring.segment();
        self.segment_ends[i] = segment.ends;
        let (limit, base) = (law.collapse_drift, segment.base_drift);
        self.collapse_bounds[i] = (-limit - base, limit - base);
        self.base_drift.set_lane::<V, K>(i, base);
        self.base_force.set_lane::<V, K>(i, segment.base_force);
        self.base_load.set_lane::<V, K>(i, spring.base_load(law));
        self.bounds.follow_spring::<V, K>(i, self.guarded_drift(i), segment.rate_sign);
        let bits = self.model.class_bits;
        let class = if bits == WORD { segment.tangent.to_bits() } else { u64::from(segment.class) };
        set_bits(&mut self.key, bits * i, u64::MAX >> (WORD - bits), class);
    }

    #[inline(always)]
    fn follow_springs<V: Vector, const K: usize>(&mut self) {
        let mut above = V::splat(0.0);
        for k in (0..self.vectors::<K>()).rev() {
            let base = self.base_load.vector::<V, K>(k);
            self.spring_load.set_vector::<V, K>(k, base.shifted_down(above).sub(base));
            above = base;
        }
    }

    #[inline(always)]
    fn follow_blocks<V: Vector, const K: usize>(&mut self) {
        for k in 0..self.vectors::<K>() {
            self.friction.set_vector::<V, K>(k, V::splat(0.0));
            self.bounds.stuck_mu.set_vector::<V, K>(k, V::splat(FAR));
        }
        self.stuck_mass.fill(0.0);
        self.stuck_mu.fill(f64::INFINITY);
        self.is_sliding = false;
        let of_springs = self.model.class_bits * self.springs.len();
        for (j, (motion, law)) in self.motions.iter().zip(&self.model.blocks).enumerate() {
            let floor = law.floor;
            set_bits(&mut self.key, of_springs + j, 1, u64::from(motion.is_stuck()));
            match motion.state {
                BlockState::Stuck => {
                    let least = self.stuck_mu[floor].min(motion.mu_s);
                    self.stuck_mu[floor] = least;
                    if let Some(i) = floor.checked_sub(1) {
                        self.stuck_mass[i] += law.mass;
                        self.bounds.stuck_mu.set_lane::<V, K>(i, least.min(FAR));
                    }
                }
                BlockState::Sliding(sign) => {
                    self.is_sliding = true;
                    if let Some(i) = floor.checked_sub(1) {
                        let others = self.friction.numbers::<K>()[i];
                        self.friction.set_lane::<V, K>(i, others + sign.factor() * motion.mu_k * law.mass);
                    }
                }
                BlockState::Airborne => {}
            }
        }
    }

    fn find_regime(&mut self) {
        let (model, springs, stuck_mass) = (self.model, &self.springs, &self.stuck_mass);
        let form = || Regime::new(model, |i| springs[i].segment().tangent, stuck_mass);
        let known;
        (self.regime, self.entry, known) = self.cache.enter(&self.key, form);
        if known {
            self.regimes.1 += 1;
        } else {
            self.regimes.0 += 1;
        }
        self.effects.valid = false;
    }

    /// Contact force per unit mass as the blocks feel it: zero while airborne.
    #[inline]
    pub(crate) fn contact_at(&self, tau: f64) -> f64 {
        if self.airborne { 0.0 } else { self.interval.contact_at(tau).max(0.0) }
    }

    /// Sets the drive of a series that starts at `tau`.
    pub(crate) fn set_drive(&mut self, tau: f64) {
        self.set_ground_drive(tau);
        let Drive { contact, contact_slope, load, load_slope, .. } = &mut self.drive;
        let loads = load.iter_mut().zip(load_slope.iter_mut());
        for ((load, slope), (spring, friction)) in loads.zip(self.spring_load.iter().zip(&self.friction)) {
            *load = spring + friction * *contact;
            *slope = friction * *contact_slope;
        }
    }

    /// Sets the drive of a series that starts at `tau`, but for the loads, which tables do not need.
    #[inline]
    fn set_ground_drive(&mut self, tau: f64) {
        (self.drive.ground, self.drive.ground_slope) = (self.interval.ground_at(tau), self.interval.ground_slope);
        let slope = if self.airborne { 0.0 } else { self.interval.contact_slope };
        (self.drive.contact, self.drive.contact_slope) = (self.contact_at(tau), slope);
    }

    /// Forms accelerations and their rates at `tau` from the state.
    pub(crate) fn refresh_accelerations(&mut self, tau: f64) {
        by_width!(self.model.width, K => refresh::<K>(self, tau));
    }

    /// [`State::refresh_accelerations`] within the code of a path.
    #[inline(always)]
    pub(crate) fn refresh<V: Vector, const K: usize>(&mut self, tau: f64) {
        self.jerk_slope = self.interval.contact_slope;
        if self.storeys() <= MAX_LANES { refresh_lanes::<V, K>(self, tau) } else { self.refresh_singly(tau) }
    }

    /// [`State::refresh_accelerations`] for more storeys than vectors hold.
    #[inline(never)]
    fn refresh_singly(&mut self, tau: f64) {
        let n = self.storeys();
        self.set_drive(tau);
        self.regime.accelerations(self.model, &self.x, &self.v, &self.drive.load, &mut self.a[..n]);
        self.refresh_drift_accelerations(self.drive.ground);
        let slope = &self.drive.load_slope;
        self.regime.accelerations(self.model, &self.v, &self.drift_acceleration, slope, &mut self.jerk[..n]);
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
        let [drifts, rates] = self.series.changes().map(|changes| &changes[..n]);
        let (x, v) = (&mut self.x[..n], &mut self.v[..n]);
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

    /// Forms the drift accelerations from those of the floors and of the ground.
    pub(crate) fn refresh_drift_accelerations(&mut self, ground: f64) {
        let mut below = ground;
        let n = self.storeys();
        for (drift_acceleration, &a) in self.drift_acceleration[..n].iter_mut().zip(&self.a) {
            *drift_acceleration = a - below;
            below = a;
        }
    }

    /// Forms the series over `h` from `tau`, where accelerations and their rates must be those of the state.
    #[inline(always)]
    pub(crate) fn form_series<V: Vector, const K: usize>(&mut self, tau: f64, h: f64) {
        let by_table = self.cache.prepare_table(self.entry, self.model, self.vertical);
        if by_table {
            self.set_ground_drive(tau);
        } else {
            self.set_drive(tau);
        }
        let start = Start { x: &self.x, v: &self.v, a: &self.a, jerk: &self.jerk };
        let table = self.regime.steps(self.vertical).and_then(|steps| steps.table.as_ref()).filter(|_| by_table);
        self.series.form::<V, K>(self.model, (&self.regime, table), &start, &self.drive, h);
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
        if !take(&mut self.ranges.are_known) {
            ranges_in_lanes::<V, K>(self);
        }
    }

    /// Keeps what the bounds of the present series' higher derivatives are multiplied with, from the square of the norm
    /// that [`Regime::liveliness_of`] takes.
    #[inline]
    fn bound_derivatives(&mut self, square: f64) {
        let h = self.series.h();
        let liveliness = self.regime.liveliness_of(square, h);
        self.ranges.set_margins(liveliness, h);
    }

    /// [`State::form_ranges`] for more storeys than vectors hold.
    #[inline(never)]
    fn form_ranges_singly(&mut self) {
        let (n, slope) = (self.storeys(), self.drive.ground_slope);
        let (root_mass, root_tangent) = (self.regime.row(Row::RootMass), self.regime.row(Row::RootTangent));
        let (jerk, q) = (&self.jerk[..n], &self.drift_acceleration[..n]);
        let mut square = 0.0;
        for i in 0..n {
            let (jerk, q) = (root_mass[i] * (jerk[i] - slope), root_tangent[i] * q[i]);
            square += jerk * jerk + q * q;
        }
        self.bound_derivatives(square);
        let regime = &self.regime;
        let h = self.series.h();
        let margins = [Row::FourthOfDrift, Row::FourthOfRate, Row::FourthOfAcceleration].map(|row| regime.row(row));
        let [dx, dv] = self.series.changes().map(|changes| &changes[..n]);
        let [a_end, jerk_end] = self.series.accelerations_at_end().map(|values| &values[..n]);
        let [x, v, a] = [&self.x, &self.v, &self.a].map(|values| &values[..n]);
        let (jerk, q) = (&self.jerk[..n], &self.drift_acceleration[..n]);
        let remainder = self.ranges.remainder;
        let mut bounds = self.ranges.bounds.each_mut().map(|pair| pair.each_mut().map(|bounds| &mut bounds[..n]));
        let mut below = self.drive.ground + self.drive.ground_slope * h;
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
        let turn = V::splat(self.ranges.chord).mul(at(self.regime.row(Row::ThirdOfAcceleration), k));
        let (start, end): (V, V) =
            (self.jerk.vector::<V, K>(k), self.series.accelerations_at_end()[1].vector::<V, K>(k));
        !V::splat(0.0).not_below(start.mul(end)) & !turn.not_below(start.abs().min(end.abs()))
    }

    /// [`State::acceleration_size`] within the code of a path.
    #[inline(always)]
    pub(crate) fn size_in_lanes<V: Vector, const K: usize>(&self, floor: usize, contact: f64) -> f64 {
        if K == WIDEST || floor == 0 {
            return self.acceleration_size(floor, contact);
        }
        let operator = Operator::<V, K>::new(self.model, &self.regime);
        let (mut x, mut v): ([V; K], [V; K]) = (load(&self.x), load(&self.v));
        let (loads, mut forces): ([V; K], [V; K]) = (load(&self.base_load), load(&self.friction));
        for k in 0..K {
            (x[k], v[k]) = (x[k].abs(), v[k].abs());
            forces[k] = forces[k].abs().mul(V::splat(contact));
        }
        numbers(&operator.sizes(&x, &v, &loads, forces)).as_flattened()[floor - 1]
    }

    /// Sum of the sizes of the terms of a floor's acceleration: times rounding, its error.
    pub(crate) fn acceleration_size(&self, floor: usize, contact: f64) -> f64 {
        let Some(i) = floor.checked_sub(1) else { return self.drive.ground.abs() };
        let above = if i + 1 < self.storeys() { self.shear_size(i + 1) } else { 0.0 };
        (self.shear_size(i) + above + self.friction[i].abs() * contact) * self.regime.row(Row::InverseMass)[i]
            + self.mass_damping_size(i)
    }

    /// Sum of the sizes of the terms of a storey's force.
    fn shear_size(&self, i: usize) -> f64 {
        let elastic = (self.regime.row(Row::Tangent)[i] * self.x[i]).abs() + self.base_load[i].abs();
        let viscous = match self.model.damping() {
            StoreyDamping::None => 0.0,
            StoreyDamping::Rayleigh { stiffness_factor, .. } => {
                (stiffness_factor * self.model.stiffness[i] * self.v[i]).abs()
            }
            // The matrix is symmetric: a column is a row.
            StoreyDamping::Dense(d) => {
                let n = self.storeys();
                d.as_slice()[n * i..n * (i + 1)].iter().zip(&self.v).map(|(c, rate)| (c * rate).abs()).sum()
            }
        };
        elastic + viscous
    }

    /// Size of the mass-proportional damping in a floor's acceleration.
    fn mass_damping_size(&self, i: usize) -> f64 {
        let StoreyDamping::Rayleigh { mass_factor, .. } = self.model.damping() else { return 0.0 };
        let velocity: f64 = self.v[..=i].iter().map(|v| v.abs()).sum();
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
            force: self.a.numbers::<K>()[i] * mass - self.friction.numbers::<K>()[i] * contact,
            size: self.acceleration_size(floor, contact) * mass,
            mass: self.model.mass[i],
        }
    }

    /// Velocity of each floor relative to the ground, from the ground upwards.
    pub(crate) fn floor_velocities(&self) -> impl Iterator<Item = f64> {
        self.v.iter().scan(0.0, |velocity, rate| {
            *velocity += rate;
            Some(*velocity)
        })
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
            turn(self, self.interval.contact_slope - self.jerk_slope);
            self.jerk_slope = self.interval.contact_slope;
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
    state.follow_springs::<V, K>();
    state.follow_blocks::<V, K>();
}

for_each_path! {
    /// Has the rates of accelerations follow a change of the contact force's slope.
    fn turn(state: &mut State, change: f64) = turn_by_path
}

#[inline(always)]
fn turn_by_path<V: Vector>(state: &mut State, change: f64) {
    let inverse_mass = lanes(state.regime.row(Row::InverseMass));
    turned::<V>(&mut state.jerk, lanes(&state.friction), inverse_mass, change);
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
    let (x, v): ([V; K], [V; K]) = (load(&state.x), load(&state.v));
    let (mut forces, friction): ([V; K], [V; K]) = (load(&state.spring_load), load(&state.friction));
    let contact_slope = if state.airborne { 0.0 } else { state.interval.contact_slope };
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
    store(&a, &mut state.a);
    store(&drift_acceleration, &mut state.drift_acceleration);
    store(&jerk, &mut state.jerk);
    state.is_formed = true;
}

/// See [`State::take_changes`].
#[inline(always)]
fn changes_in_lanes<V: Vector, const K: usize>(state: &mut State, tau: Option<f64>) -> bool {
    let (mut x, mut v): ([V; K], [V; K]) = (load(&state.x), load(&state.v));
    let [drifts, rates] = state.series.changes();
    let (drifts, rates): ([V; K], [V; K]) = (load(drifts), load(rates));
    let mut zeros = V::splat(0.0);
    for k in 0..K {
        (x[k], v[k]) = (x[k].add(drifts[k]), v[k].add(rates[k]));
        // No number times zero is zero but a finite one.
        zeros = x[k].add(v[k]).mul_add(V::splat(0.0), zeros);
    }
    store(&x, &mut state.x);
    store(&v, &mut state.v);
    if let Some(tau) = tau {
        if state.is_formed {
            let [a, jerk] = state.series.accelerations_at_end();
            let (a, jerk): ([V; K], [V; K]) = (load(a), load(jerk));
            let inside: [V; K] = load(&state.model.lanes.inside);
            let mut drift_acceleration = differences(&a, V::splat(state.interval.ground_at(tau)));
            for k in 0..K {
                drift_acceleration[k] = drift_acceleration[k].mul(inside[k]);
            }
            store(&a, &mut state.a);
            store(&drift_acceleration, &mut state.drift_acceleration);
            store(&jerk, &mut state.jerk);
            state.is_formed = false;
        } else {
            refresh_lanes::<V, K>(state, tau);
        }
    }
    zeros.sum() == 0.0
}

/// See [`State::form_ranges`].
#[inline(always)]
fn ranges_in_lanes<V: Vector, const K: usize>(state: &mut State) {
    let start = Sample::<V, K>::of(state);
    let (mass, tangent) = (state.regime.lanes::<V, K>(Row::RootMass), state.regime.lanes::<V, K>(Row::RootTangent));
    let mut squares = V::splat(0.0);
    for k in 0..K {
        let kinetic = mass[k].mul(start.jerk[k].sub(V::splat(state.drive.ground_slope)));
        let elastic = tangent[k].mul(start.q[k]);
        squares = elastic.mul_add(elastic, kinetic.mul_add(kinetic, squares));
    }
    state.bound_derivatives(squares.sum());
    let h = state.series.h();
    let ([dx, dv], [a, jerk]) = (state.series.changes(), state.series.accelerations_at_end());
    let (dx, dv, a, jerk): ([V; K], [V; K], [V; K], [V; K]) = (load(dx), load(dv), load(a), load(jerk));
    let q = differences(&a, V::splat(state.drive.ground + state.drive.ground_slope * h));
    let mut end = Sample { x: start.x, v: start.v, a, jerk, q };
    for k in 0..K {
        end.x[k] = start.x[k].add(dx[k]);
        end.v[k] = start.v[k].add(dv[k]);
    }
    let contact = V::splat(state.drive.least_contact(h));
    let bounds = BoundsInLanes::of(state);
    state.ranges.form([&start, &end], (&state.regime, h), (&bounds, contact));
}
