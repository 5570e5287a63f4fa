//! The state of a run between and at events: drifts, drift rates, springs, blocks (`numerics`, sections 2, 3).

use seismass::Scene;

use crate::model::{Model, Stage, Terms, floor_velocities};
use crate::real::Real;
use crate::sign::Sign;
use crate::springs::Spring;

/// What a block does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Contact {
    /// Moves with its floor: relative velocity exactly zero.
    Stuck,
    /// Slides, with this sign of its relative velocity.
    Sliding(Sign),
    /// Has lost contact.
    Airborne,
}

/// A block relative to its floor.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BlockState<R> {
    pub(crate) contact: Contact,
    pub(crate) velocity: R,
    pub(crate) slip: R,
    /// Has moved since it broke away: a relative velocity of zero is then an arrival.
    pub(crate) moved: bool,
    /// Path slipped in contact.
    pub(crate) path: R,
    /// How often the friction coefficients have changed.
    pub(crate) stage: usize,
    /// The friction coefficients now.
    pub(crate) mu_s: R,
    pub(crate) mu_k: R,
}

impl<R: Real> BlockState<R> {
    /// Whether it slides without friction: its direction then changes no force, and it sticks no more.
    pub(crate) fn slides_freely(&self) -> bool {
        self.mu_s == R::zero() && matches!(self.contact, Contact::Sliding(_))
    }

    /// Slides the other way from rest; returns the sign, and whether it has moved at any time.
    pub(crate) fn turn_back(&mut self) -> (Sign, bool) {
        let sign = if self.contact == Contact::Sliding(Sign::Positive) { Sign::Negative } else { Sign::Positive };
        let had_moved = self.moved || self.slip != R::zero();
        (self.velocity, self.moved, self.contact) = (R::zero(), false, Contact::Sliding(sign));
        (sign, had_moved)
    }

    /// Sign of the relative velocity, 0 for none, as in event logs.
    pub(crate) fn velocity_sign(&self) -> i8 {
        if self.velocity == R::zero() { 0 } else { Sign::of(self.velocity).as_i8() }
    }
}

/// Everything that changes in a run.
#[derive(Debug)]
pub(crate) struct State<R> {
    pub(crate) drift: Vec<R>,
    pub(crate) rate: Vec<R>,
    pub(crate) springs: Vec<Box<dyn Spring<R>>>,
    pub(crate) blocks: Vec<BlockState<R>>,
}

/// Ground acceleration and contact acceleration g + a_v over a stretch of a sample interval, in time `tau` from its
/// beginning: both are linear.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Drive<R> {
    pub(crate) ground: [R; 2],
    pub(crate) contact: [R; 2],
}

impl<R: Real> Drive<R> {
    pub(crate) fn ground_at(&self, tau: R) -> R {
        self.ground[0] + self.ground[1] * tau
    }

    pub(crate) fn contact_at(&self, tau: R) -> R {
        self.contact[0] + self.contact[1] * tau
    }
}

impl<R: Real> State<R> {
    /// The initial state: springs virgin, slips zero, blocks without relative velocity taken as stuck.
    pub(crate) fn new(scene: &Scene, model: &Model<R>) -> Self {
        let drift: Vec<R> = scene.initial_drift().iter().map(|&d| R::of(d)).collect();
        let velocity: Vec<R> = scene.initial_velocity().iter().map(|&v| R::of(v)).collect();
        let rate = (0..velocity.len()).map(|i| if i > 0 { velocity[i] - velocity[i - 1] } else { velocity[0] });
        let springs = model.storeys.iter().zip(&drift).map(|(storey, &d)| {
            let mut spring = storey.spring.copied();
            spring.start(d);
            spring
        });
        let blocks = scene.blocks().iter().zip(&model.blocks).map(|(block, data)| {
            let floor = if block.floor > 0 { velocity[block.floor - 1] } else { R::zero() };
            let velocity = block.velocity.map_or(R::zero(), |w| R::of(w) - floor);
            let contact = if velocity == R::zero() { Contact::Stuck } else { Contact::Sliding(Sign::of(velocity)) };
            let Stage { path, mu_s, mu_k } = data.stages[0];
            BlockState { contact, velocity, slip: R::zero(), moved: true, path, stage: 0, mu_s, mu_k }
        });
        Self { rate: rate.collect(), springs: springs.collect(), blocks: blocks.collect(), drift }
    }

    /// Spring force of each storey, without P-Delta and damping, or the size of its terms.
    pub(crate) fn storey_forces(&self, terms: Terms) -> Vec<R> {
        let size = |f: R| if terms == Terms::Sizes { f.abs() } else { f };
        let force = |(spring, drift): (&dyn Spring<R>, R)| {
            let parts = spring.parts().into_iter().fold(R::zero(), |sum, part| sum + size(part.force));
            parts + size(spring.linear() * drift)
        };
        self.springs.iter().zip(&self.drift).map(|(spring, &drift)| force((spring.as_ref(), drift))).collect()
    }

    /// Absolute acceleration of a floor (0: the ground) in the present regime, or the size of its terms.
    pub(crate) fn acceleration(&self, model: &Model<R>, floor: usize, drive: &Drive<R>, tau: R, terms: Terms) -> R {
        let size = |x: R| if terms == Terms::Sizes { x.abs() } else { x };
        if floor == 0 {
            return size(drive.ground_at(tau));
        }
        let pull = model.pull(&self.storey_forces(terms), &self.drift, &self.rate, terms)[floor - 1];
        let (mut force, mut mass) = (pull, model.mass[floor - 1]);
        for (block, data) in self.blocks.iter().zip(&model.blocks).filter(|(_, data)| data.floor == floor) {
            match block.contact {
                Contact::Stuck => mass = mass + data.mass,
                Contact::Sliding(sign) => {
                    force = force + size(sign.times(block.mu_k * data.mass * drive.contact_at(tau)));
                }
                Contact::Airborne => {}
            }
        }
        force / mass
    }

    /// Kinetic energy of floors and blocks, relative to the ground.
    pub(crate) fn kinetic_energy(&self, model: &Model<R>) -> R {
        let velocity = floor_velocities(&self.rate);
        let floors = model.mass.iter().zip(&velocity).fold(R::zero(), |sum, (&m, &v)| sum + m * v * v);
        let blocks = model.blocks.iter().zip(&self.blocks).fold(R::zero(), |sum, (data, block)| {
            let floor = if data.floor > 0 { velocity[data.floor - 1] } else { R::zero() };
            let v = floor + block.velocity;
            sum + data.mass * v * v
        });
        R::of(0.5) * (floors + blocks)
    }

    /// Energy stored in the springs, less the work of P-Delta.
    pub(crate) fn elastic_energy(&self, model: &Model<R>) -> R {
        let mut energy = R::zero();
        for (i, storey) in model.storeys.iter().enumerate() {
            let gravity = R::of(0.5) * storey.geometric * self.drift[i] * self.drift[i];
            energy = energy + self.springs[i].stored(self.drift[i]) - gravity;
        }
        energy
    }

    /// Multiplies the numbers of the state by factors, each storey's drift, rate and forces by its own. All blocks
    /// share theirs, so that those that move together still do. Forces that are no result of rounding stay.
    pub(crate) fn scale(&mut self, mut factor: impl FnMut() -> R) {
        for number in self.drift.iter_mut().chain(&mut self.rate) {
            *number = *number * factor();
        }
        for spring in &mut self.springs {
            spring.scale(&mut factor);
        }
        let (velocity, slip) = (factor(), factor());
        for block in &mut self.blocks {
            block.velocity = block.velocity * velocity;
            block.slip = block.slip * slip;
        }
    }

    pub(crate) fn is_finite(&self) -> bool {
        let blocks = self.blocks.iter().flat_map(|b| [b.velocity, b.slip]);
        self.drift.iter().chain(&self.rate).copied().chain(blocks).all(|x| x.to_f64().is_finite())
    }
}
