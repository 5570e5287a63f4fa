//! The state of a run between and at events: drifts, drift rates, element forces, blocks (`numerics`, sections 2, 3).

use seismass::Scene;

use crate::model::{Model, Terms, floor_velocities};
use crate::real::Real;

/// Direction of a force or a velocity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Sign {
    Positive,
    Negative,
}

impl Sign {
    /// Sign of a value; zero counts as positive.
    pub(crate) fn of<R: Real>(value: R) -> Self {
        if value < R::zero() { Self::Negative } else { Self::Positive }
    }

    pub(crate) fn times<R: Real>(self, value: R) -> R {
        match self {
            Self::Positive => value,
            Self::Negative => -value,
        }
    }

    pub(crate) fn opposite(self) -> Self {
        match self {
            Self::Positive => Self::Negative,
            Self::Negative => Self::Positive,
        }
    }

    pub(crate) fn as_i8(self) -> i8 {
        match self {
            Self::Positive => 1,
            Self::Negative => -1,
        }
    }
}

/// An element of a storey spring. Its force is integrated with the state, so it never comes from the difference of
/// two large drifts, and while plastic it is exact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ElementState<R> {
    pub(crate) force: R,
    /// Sign of the yield force while plastic.
    pub(crate) plastic: Option<Sign>,
}

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
}

impl<R: Real> BlockState<R> {
    /// Sign of the relative velocity, 0 for none, as in event logs.
    pub(crate) fn velocity_sign(&self) -> i8 {
        if self.velocity == R::zero() { 0 } else { Sign::of(self.velocity).as_i8() }
    }
}

/// Everything that changes in a run.
#[derive(Debug, Clone)]
pub(crate) struct State<R> {
    pub(crate) drift: Vec<R>,
    pub(crate) rate: Vec<R>,
    pub(crate) elements: Vec<Vec<ElementState<R>>>,
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
        let elements = model.storeys.iter().zip(&drift).map(|(storey, &d)| {
            storey.elements.iter().map(|e| ElementState { force: e.stiffness * d, plastic: None }).collect()
        });
        let blocks = scene.blocks().iter().map(|block| {
            let floor = if block.floor > 0 { velocity[block.floor - 1] } else { R::zero() };
            let velocity = block.velocity.map_or(R::zero(), |w| R::of(w) - floor);
            let contact = if velocity == R::zero() { Contact::Stuck } else { Contact::Sliding(Sign::of(velocity)) };
            BlockState { contact, velocity, slip: R::zero(), moved: true }
        });
        Self { rate: rate.collect(), elements: elements.collect(), blocks: blocks.collect(), drift }
    }

    /// Sum of the element forces of each storey.
    pub(crate) fn element_forces(&self, terms: Terms) -> Vec<R> {
        let size = |f: R| if terms == Terms::Sizes { f.abs() } else { f };
        self.elements.iter().map(|storey| storey.iter().fold(R::zero(), |sum, e| sum + size(e.force))).collect()
    }

    /// Spring force of each storey, without P-Delta and damping.
    pub(crate) fn storey_forces(&self, model: &Model<R>) -> Vec<R> {
        let elements = self.element_forces(Terms::Signed);
        (0..elements.len()).map(|i| elements[i] + model.storeys[i].linear * self.drift[i]).collect()
    }

    /// Absolute acceleration of a floor (0: the ground) in the present regime, or the size of its terms.
    pub(crate) fn acceleration(&self, model: &Model<R>, floor: usize, drive: &Drive<R>, tau: R, terms: Terms) -> R {
        let size = |x: R| if terms == Terms::Sizes { x.abs() } else { x };
        if floor == 0 {
            return size(drive.ground_at(tau));
        }
        let pull = model.pull(&self.element_forces(terms), &self.drift, &self.rate, terms)[floor - 1];
        let (mut force, mut mass) = (pull, model.mass[floor - 1]);
        for (block, data) in self.blocks.iter().zip(&model.blocks).filter(|(_, data)| data.floor == floor) {
            match block.contact {
                Contact::Stuck => mass = mass + data.mass,
                Contact::Sliding(sign) => {
                    force = force + size(sign.times(data.mu_k * data.mass * drive.contact_at(tau)));
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
        let mut twice = R::zero();
        for (i, storey) in model.storeys.iter().enumerate() {
            twice = twice + (storey.linear - storey.geometric) * self.drift[i] * self.drift[i];
            for (element, data) in self.elements[i].iter().zip(&storey.elements) {
                twice = twice + element.force * element.force / data.stiffness;
            }
        }
        R::of(0.5) * twice
    }

    /// Multiplies the numbers of the state by factors, each storey's drift, rate and elastic forces by its own. All
    /// blocks share theirs, so that those that move together still do. Plastic forces, which are no result of
    /// rounding, stay.
    pub(crate) fn scale(&mut self, mut factor: impl FnMut() -> R) {
        for number in self.drift.iter_mut().chain(&mut self.rate) {
            *number = *number * factor();
        }
        for element in self.elements.iter_mut().flatten().filter(|e| e.plastic.is_none()) {
            element.force = element.force * factor();
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
