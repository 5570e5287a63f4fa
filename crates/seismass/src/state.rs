//! The state of a run: drifts, drift rates, spring and block machines, and what one sample interval does to them.

use crate::STANDARD_GRAVITY;
use crate::damping::StoreyDamping;
use crate::friction::{BlockMotion, BlockState, Demand};
use crate::lanes::padded;
use crate::model::Model;
use crate::propagator::RegimeCache;
use crate::regime::Regime;
use crate::scene::Scene;
use crate::storey::StoreySpring;
use crate::taylor::{Drive, Series};

/// Ground motion between two samples, linear in time.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Interval {
    /// Time of the first sample (s).
    pub(crate) start: f64,
    /// Length (s).
    pub(crate) h: f64,
    /// Ground acceleration at the start (m/s2).
    pub(crate) ground: f64,
    /// Its change over the interval (m/s2).
    pub(crate) ground_change: f64,
    /// Contact force per unit mass g + a_v at the start (m/s2).
    pub(crate) contact: f64,
    /// Its change over the interval (m/s2).
    pub(crate) contact_change: f64,
}

impl Interval {
    /// Ground acceleration at `tau` from the start (m/s2).
    #[inline]
    pub(crate) fn ground_at(&self, tau: f64) -> f64 {
        if self.h > 0.0 { self.ground + self.ground_change * (tau / self.h) } else { self.ground }
    }

    /// Contact force per unit mass at `tau` from the start (m/s2).
    #[inline]
    pub(crate) fn contact_at(&self, tau: f64) -> f64 {
        if self.h > 0.0 { self.contact + self.contact_change * (tau / self.h) } else { self.contact }
    }

    /// Slope of a quantity with this change over the interval.
    #[inline]
    pub(crate) fn slope(&self, change: f64) -> f64 {
        if self.h > 0.0 { change / self.h } else { 0.0 }
    }
}

/// Effect of the floor loads of the present state on the step of the regime's propagator.
#[derive(Debug, Default)]
pub(crate) struct LoadEffects {
    pub(crate) valid: bool,
    /// Of the springs' base forces (and of friction, without vertical motion).
    pub(crate) constant: Vec<f64>,
    /// Of friction at unit contact force.
    pub(crate) friction: Vec<f64>,
    /// Of friction with the contact force growing from zero to one.
    pub(crate) friction_ramp: Vec<f64>,
}

/// The state of a run and its working space.
pub(crate) struct State<'a> {
    pub(crate) model: &'a Model,
    pub(crate) cache: &'a mut RegimeCache,
    pub(crate) vertical: bool,
    pub(crate) interval: Interval,
    /// Drift of each storey since its spring's base.
    pub(crate) x: Vec<f64>,
    /// Drift rate of each storey.
    pub(crate) v: Vec<f64>,
    /// Absolute acceleration of each floor.
    pub(crate) a: Vec<f64>,
    /// Its rate.
    pub(crate) jerk: Vec<f64>,
    /// Second derivative of each drift.
    pub(crate) drift_acceleration: Vec<f64>,
    pub(crate) springs: Vec<StoreySpring>,
    pub(crate) motions: Vec<BlockMotion>,
    /// Whether the blocks have lost contact.
    pub(crate) airborne: bool,
    /// Index of the regime in the cache.
    pub(crate) regime: usize,
    /// Force of the springs at their bases on each floor (N).
    pub(crate) spring_load: Vec<f64>,
    /// Friction on each floor per unit contact force: sum of sign mu_k m over its sliding blocks (kg).
    pub(crate) friction: Vec<f64>,
    /// Smallest mu_s of the blocks stuck to the ground (0) and to each floor; infinite where none is.
    pub(crate) stuck_mu: Vec<f64>,
    /// Drift coordinates at which each storey yields next.
    pub(crate) yield_bounds: Vec<(f64, f64)>,
    /// Drift coordinates at which each storey collapses.
    pub(crate) collapse_bounds: Vec<(f64, f64)>,
    /// Spring force of each storey at its base (N).
    pub(crate) base_force: Vec<f64>,
    pub(crate) effects: LoadEffects,
    pub(crate) drive: Drive,
    pub(crate) series: Series,
    pub(crate) scratch: Vec<f64>,
    stuck_mass: Vec<f64>,
    key: Vec<u8>,
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
        let motions = scene
            .blocks()
            .iter()
            .map(|b| BlockMotion::new(b.velocity.map_or(0.0, |w| w - floor_velocity(b.floor))))
            .collect();
        cache.begin_run();
        Self {
            model,
            cache,
            vertical,
            interval: Interval::default(),
            x: scene.initial_drift().to_vec(),
            v: (0..n).map(|i| velocity[i] - below(i)).collect(),
            a: vec![0.0; n],
            jerk: vec![0.0; n],
            drift_acceleration: vec![0.0; n],
            springs: vec![StoreySpring::new(); n],
            motions,
            airborne: false,
            regime: 0,
            spring_load: vec![0.0; n],
            friction: vec![0.0; n],
            stuck_mu: vec![f64::INFINITY; n + 1],
            yield_bounds: vec![(f64::NEG_INFINITY, f64::INFINITY); n],
            collapse_bounds: vec![(f64::NEG_INFINITY, f64::INFINITY); n],
            base_force: vec![0.0; n],
            effects: LoadEffects {
                valid: false,
                constant: vec![0.0; 4 * padded(n)],
                friction: vec![0.0; 4 * padded(n)],
                friction_ramp: vec![0.0; 4 * padded(n)],
            },
            drive: Drive { load: vec![0.0; n], load_slope: vec![0.0; n], ..Drive::default() },
            series: Series::default(),
            scratch: vec![0.0; n],
            stuck_mass: vec![0.0; n],
            key: Vec::new(),
            regimes: (0, 0),
        }
    }

    /// Number of storeys.
    #[inline]
    pub(crate) fn storeys(&self) -> usize {
        self.x.len()
    }

    /// The present regime.
    #[inline]
    pub(crate) fn regime(&self) -> &Regime {
        self.cache.regime(self.regime)
    }

    /// Whether nothing moves and no spring is deformed.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.x.iter().chain(&self.v).all(|&value| value == 0.0) && self.motions.iter().all(BlockMotion::is_stuck)
    }

    /// Whether the series of a full damping matrix has to be formed.
    pub(crate) fn has_full_damping(&self) -> bool {
        matches!(self.model.damping(), StoreyDamping::Dense(_))
    }

    /// Follows a change of any state machine: bounds, loads, and the regime.
    pub(crate) fn enter_regime(&mut self) {
        let n = self.storeys();
        self.key.clear();
        for (i, (spring, law)) in self.springs.iter().zip(&self.model.laws).enumerate() {
            self.key.push(spring.yielded());
            self.yield_bounds[i] = spring.yield_bounds(law);
            let (limit, base) = (law.collapse_drift, spring.drift(0.0));
            self.collapse_bounds[i] = (-limit - base, limit - base);
            self.base_force[i] = spring.base_force(law);
        }
        for i in 0..n {
            let above = if i + 1 < n { self.springs[i + 1].base_load(&self.model.laws[i + 1]) } else { 0.0 };
            self.spring_load[i] = above - self.springs[i].base_load(&self.model.laws[i]);
        }
        self.friction.fill(0.0);
        self.stuck_mass.fill(0.0);
        self.stuck_mu.fill(f64::INFINITY);
        for (motion, law) in self.motions.iter().zip(&self.model.blocks) {
            let floor = law.floor;
            self.key.push(u8::from(motion.is_stuck()));
            match motion.state {
                BlockState::Stuck => {
                    self.stuck_mu[floor] = self.stuck_mu[floor].min(law.mu_s);
                    if floor > 0 {
                        self.stuck_mass[floor - 1] += law.mass;
                    }
                }
                BlockState::Sliding(sign) if floor > 0 => {
                    self.friction[floor - 1] += sign.factor() * law.mu_k * law.mass;
                }
                _ => {}
            }
        }
        let (model, springs, stuck_mass) = (self.model, &self.springs, &self.stuck_mass);
        let form = || Regime::new(model, |i| springs[i].yielded(), stuck_mass);
        let (regime, known) = self.cache.enter(&self.key, form);
        self.regime = regime;
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
        let contact = self.contact_at(tau);
        let contact_slope = if self.airborne { 0.0 } else { self.interval.slope(self.interval.contact_change) };
        self.drive.ground = self.interval.ground_at(tau);
        self.drive.ground_slope = self.interval.slope(self.interval.ground_change);
        for i in 0..self.storeys() {
            self.drive.load[i] = self.spring_load[i] + self.friction[i] * contact;
            self.drive.load_slope[i] = self.friction[i] * contact_slope;
        }
    }

    /// Forms accelerations and their rates at `tau` from the state.
    pub(crate) fn refresh_accelerations(&mut self, tau: f64) {
        self.set_drive(tau);
        let regime = self.cache.regime(self.regime);
        regime.accelerations(self.model, &self.x, &self.v, &self.drive.load, &mut self.a);
        let mut below = self.drive.ground;
        for (drift_acceleration, &a) in self.drift_acceleration.iter_mut().zip(&self.a) {
            *drift_acceleration = a - below;
            below = a;
        }
        let slope = &self.drive.load_slope;
        regime.accelerations(self.model, &self.v, &self.drift_acceleration, slope, &mut self.jerk);
    }

    /// Sum of the sizes of the terms of each floor's acceleration: times rounding, its error.
    pub(crate) fn acceleration_sizes(&self, contact: f64, out: &mut [f64]) {
        let n = self.storeys();
        let regime = self.regime();
        for i in 0..n {
            let law = &self.model.laws[i];
            out[i] = (regime.tangent[i] * self.x[i]).abs() + self.springs[i].base_load(law).abs();
        }
        match self.model.damping() {
            StoreyDamping::None => {}
            StoreyDamping::Rayleigh { mass_factor, stiffness_factor } => {
                for i in 0..n {
                    let velocity = self.v[i].abs() * mass_factor * self.model.mass[i];
                    out[i] += (stiffness_factor * self.model.stiffness[i] * self.v[i]).abs() + velocity;
                }
            }
            StoreyDamping::Dense(d) => {
                for (column, &rate) in d.as_slice().chunks_exact(n).zip(&self.v) {
                    for (o, c) in out.iter_mut().zip(column) {
                        *o += (c * rate).abs();
                    }
                }
            }
        }
        for i in 0..n {
            let above = if i + 1 < n { out[i + 1] } else { 0.0 };
            out[i] = (out[i] + above + self.friction[i].abs() * contact) * regime.inverse_mass[i];
        }
    }

    /// What floor `floor` (0: the ground) asks of its blocks at `tau`.
    pub(crate) fn demand(&mut self, floor: usize, tau: f64) -> Demand {
        if floor == 0 {
            return Demand::Ground { acceleration: self.interval.ground_at(tau) };
        }
        let i = floor - 1;
        let contact = self.contact_at(tau);
        self.refresh_accelerations(tau);
        let mut sizes = std::mem::take(&mut self.scratch);
        self.acceleration_sizes(contact, &mut sizes);
        let mass = self.regime().mass[i];
        let demand = Demand::Floor {
            force: self.a[i] * mass - self.friction[i] * contact,
            size: sizes[i] * mass,
            mass: self.model.mass[i],
        };
        self.scratch = sizes;
        demand
    }

    /// Velocity of each floor relative to the ground, from the ground upwards.
    pub(crate) fn floor_velocities(&self) -> impl Iterator<Item = f64> {
        self.v.iter().scan(0.0, |velocity, rate| {
            *velocity += rate;
            Some(*velocity)
        })
    }

    /// Moves on to another sample interval.
    pub(crate) fn set_interval(&mut self, interval: Interval) {
        self.interval = interval;
    }
}

/// The interval between samples `i` and `i + 1` of a motion, or a point at the last sample.
pub(crate) fn interval(motion: &crate::scene::Motion, i: usize) -> Interval {
    let last = motion.acceleration().len() - 1;
    let pair = |samples: &[f64]| (samples[i], samples[(i + 1).min(last)] - samples[i]);
    let (ground, ground_change) = pair(motion.acceleration());
    let (vertical, contact_change) = motion.vertical().map_or((0.0, 0.0), pair);
    Interval {
        start: i as f64 * motion.dt(),
        h: if i < last { motion.dt() } else { 0.0 },
        ground,
        ground_change,
        contact: STANDARD_GRAVITY + vertical,
        contact_change,
    }
}
