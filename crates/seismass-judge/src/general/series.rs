//! The Taylor series of everything over a stretch of time in one regime, as polynomials on [0, 1].

use super::base::BaseSeries;
use super::model::Model;
use super::state::{State, Stopped};
use crate::model::Terms;
use crate::polynomial::{Polynomial, term};
use crate::real::Real;
use crate::series::{integrate, orders};
use crate::springs::{Course, Part};
use crate::state::{BlockState, Contact, Drive};

/// The length of a stretch times the norm of the system is at most this: the longer the stretch, the fewer terms in all.
pub(super) const MAX_PHASE: f64 = 2.0;

/// The solution over `length`, which starts at the state it was made from.
pub(super) struct Series<R> {
    pub(super) length: R,
    pub(super) ground: Polynomial<R>,
    /// g + a_v.
    pub(super) contact: Polynomial<R>,
    pub(super) drift: Vec<Polynomial<R>>,
    pub(super) rate: Vec<Polynomial<R>>,
    /// Forces of the parts of each spring.
    pub(super) force: Vec<Vec<Polynomial<R>>>,
    /// Absolute acceleration of the ground or the slab on it (index 0) and of each node.
    pub(super) acceleration: Vec<Polynomial<R>>,
    /// Velocity of each block relative to its node.
    pub(super) velocity: Vec<Polynomial<R>>,
    pub(super) slip: Vec<Polynomial<R>>,
    /// Force of each block's stop on its node, constant zero where it does not press.
    pub(super) push: Vec<Polynomial<R>>,
    /// Friction of each block on its node, constant zero where it does not slide.
    pub(super) friction: Vec<Polynomial<R>>,
    /// Of the slab.
    pub(super) base: Option<BaseSeries<R>>,
    /// Slopes of the parts of each spring.
    tangent: Vec<Vec<R>>,
}

/// Index of a node's acceleration.
pub(super) fn place(node: Option<usize>) -> usize {
    node.map_or(0, |node| node + 1)
}

impl<R: Real> Series<R> {
    /// c_(k+1) = (A c_k + load_k) / (k + 1), from the state at `tau` over `length`.
    pub(super) fn new(model: &Model<R>, state: &State<R>, drive: &Drive<R>, tau: R, length: R) -> Self {
        let mut series = Self::at_start(model, state, drive, tau, length);
        let mass = state.mass_with_stuck(model);
        for order in 0..orders::<R>(MAX_PHASE) {
            let (mut pull, mut on_block) = series.forces(model, state, order);
            let contact = term(&series.contact, order);
            for (j, (block, data)) in state.blocks.iter().zip(&model.goods).enumerate() {
                let Contact::Sliding(sign) = block.contact else { continue };
                let friction = sign.times(block.mu_k * data.mass) * contact;
                series.friction[j].0.push(friction);
                on_block[j] = on_block[j] - friction;
                if let Some(node) = data.node {
                    pull[node] = pull[node] + friction;
                }
            }
            let acceleration: Vec<R> = pull.into_iter().zip(&mass).map(|(force, &mass)| force / mass).collect();
            series.extend(model, state, order, &acceleration, &on_block);
        }
        series
    }

    /// What is known at the start: values, and the motion.
    pub(super) fn at_start(model: &Model<R>, state: &State<R>, drive: &Drive<R>, tau: R, length: R) -> Self {
        let starts = |values: &[R]| values.iter().map(|&v| Polynomial::constant(v)).collect::<Vec<_>>();
        let m = model.goods.len();
        let parts: Vec<Vec<Part<R>>> = state.springs.iter().map(|spring| spring.parts()).collect();
        let friction = |block: &BlockState<R>| match block.contact {
            Contact::Sliding(_) => Polynomial(Vec::new()),
            _ => Polynomial::constant(R::zero()),
        };
        Self {
            length,
            ground: Polynomial(vec![drive.ground_at(tau), drive.ground[1] * length]),
            contact: Polynomial(vec![drive.contact_at(tau), drive.contact[1] * length]),
            drift: starts(&state.drift),
            rate: starts(&state.rate),
            force: parts.iter().map(|s| starts(&s.iter().map(|part| part.force).collect::<Vec<_>>())).collect(),
            acceleration: vec![Polynomial(Vec::new()); model.mass.len() + 1],
            velocity: starts(&state.blocks.iter().map(|b| b.velocity).collect::<Vec<_>>()),
            slip: starts(&state.blocks.iter().map(|b| b.slip).collect::<Vec<_>>()),
            push: starts(&(0..m).map(|j| state.push(model, j)).collect::<Vec<_>>()),
            friction: state.blocks.iter().map(friction).collect(),
            base: state.base.as_ref().map(BaseSeries::at_start),
            tangent: parts.iter().map(|s| s.iter().map(|part| part.tangent).collect()).collect(),
        }
    }

    /// Coefficients of this order of the forces of the springs.
    pub(super) fn spring_terms(&self, state: &State<R>, order: usize) -> Vec<R> {
        let spring = |p: usize| {
            let parts = self.force[p].iter().fold(R::zero(), |sum, part| sum + term(part, order));
            parts + state.springs[p].linear() * term(&self.drift[p], order)
        };
        (0..state.springs.len()).map(spring).collect()
    }

    /// Sizes of the terms of the forces of the springs over the stretch.
    pub(super) fn spring_sizes(&self, state: &State<R>) -> Vec<R> {
        let spring = |p: usize| {
            let parts = self.force[p].iter().fold(R::zero(), |sum, part| sum + part.size());
            parts + state.springs[p].linear() * self.drift[p].size()
        };
        (0..state.springs.len()).map(spring).collect()
    }

    /// Coefficients of this order of the forces on each node and on each block, without friction; those of lower orders are
    /// known. A block that sticks has none of its own.
    pub(super) fn forces(&mut self, model: &Model<R>, state: &State<R>, order: usize) -> (Vec<R>, Vec<R>) {
        let springs = self.spring_terms(state, order);
        let terms = |list: &[Polynomial<R>]| list.iter().map(|p| term(p, order)).collect::<Vec<R>>();
        let mut pull = model.pull(&springs, &terms(&self.drift), &terms(&self.rate), Terms::Signed);
        let mut on_block = vec![R::zero(); model.goods.len()];
        for (j, (block, data)) in state.blocks.iter().zip(&model.goods).enumerate() {
            if block.contact == Contact::Stuck {
                continue;
            }
            if let (Stopped::Pressing(_), Some(stops), true) = (state.stopped[j], &data.stops, order > 0) {
                let force = stops.stiffness * term(&self.slip[j], order);
                self.push[j].0.push(force + stops.damping * term(&self.velocity[j], order));
            }
            let push = term(&self.push[j], order);
            on_block[j] = -push;
            if let Some(node) = data.node {
                pull[node] = pull[node] + push;
            }
        }
        (pull, on_block)
    }

    /// Takes in the accelerations of the nodes of this order and the forces on the blocks, and goes on to the next.
    pub(super) fn extend(
        &mut self,
        model: &Model<R>,
        state: &State<R>,
        order: usize,
        acceleration: &[R],
        on_block: &[R],
    ) {
        let (length, one) = (self.length, R::of(1.0));
        let below = self.below(model, state, order);
        self.acceleration[0].0.push(below);
        for (of_node, &value) in self.acceleration[1..].iter_mut().zip(acceleration) {
            of_node.0.push(value);
        }
        for p in 0..acceleration.len() {
            let below = self.acceleration[place(model.parent[p])].0[order];
            self.rate[p].0.push(length * (acceleration[p] - below) / R::of((order + 1) as f64));
            integrate(&self.rate[p], one, length, &mut self.drift[p]);
            for (force, &tangent) in self.force[p].iter_mut().zip(&self.tangent[p]).filter(|(_, t)| **t != R::zero()) {
                integrate(&self.rate[p], tangent, length, force);
            }
        }
        for (j, data) in model.goods.iter().enumerate() {
            if state.blocks[j].contact != Contact::Stuck {
                let relative = on_block[j] / data.mass - self.acceleration[place(data.node)].0[order];
                self.velocity[j].0.push(length * relative / R::of((order + 1) as f64));
                integrate(&self.velocity[j], one, length, &mut self.slip[j]);
            }
        }
    }

    /// Restricts the stretch to its first part, of this fraction.
    pub(super) fn shrink(&mut self, place: R) {
        self.length = self.length * place;
        let Self { ground, contact, drift, rate, force, acceleration, velocity, slip, push, friction, base, .. } = self;
        let of_base = base.iter_mut().flat_map(BaseSeries::polynomials);
        let lists = [drift, rate, acceleration, velocity, slip, push, friction].into_iter().flatten().chain(of_base);
        for polynomial in lists.chain(force.iter_mut().flatten()).chain([ground, contact]) {
            polynomial.shrink(place);
        }
    }

    /// Moves the state to the end of the stretch.
    pub(super) fn advance(&self, state: &mut State<R>) {
        for p in 0..state.drift.len() {
            state.springs[p].advance(&self.course(p));
            state.drift[p] = self.drift[p].end();
            state.rate[p] = self.rate[p].end();
        }
        if let (Some(own), Some(base)) = (&self.base, &mut state.base) {
            (base.velocity, base.slip) = (own.velocity.end(), own.slip.end());
            base.moved |= self.length > R::zero();
        }
        for (j, block) in state.blocks.iter_mut().enumerate() {
            block.velocity = self.velocity[j].end();
            block.slip = self.slip[j].end();
            block.moved |= self.length > R::zero();
        }
    }

    /// Adds what blocks that slide in their direction have slipped to their paths.
    pub(super) fn add_paths(&self, state: &mut State<R>) {
        for (j, block) in state.blocks.iter_mut().enumerate() {
            if let Contact::Sliding(sign) = block.contact {
                block.path = block.path + sign.times(self.slipped(j).end());
            }
        }
    }

    /// What a spring sees.
    pub(super) fn course(&self, node: usize) -> Course<'_, R> {
        let (drift, rate, forces) = (&self.drift[node], &self.rate[node], &self.force[node]);
        Course { length: self.length, drift, rate, forces }
    }

    /// Change of a block's slip since the beginning of the stretch, not as a difference of slips.
    pub(super) fn slipped(&self, block: usize) -> Polynomial<R> {
        let mut slipped = self.slip[block].clone();
        slipped.0[0] = R::zero();
        slipped
    }

    /// Size of the terms of each node's acceleration over the stretch (index 0: the ground or the slab): the measure of its
    /// rounding.
    pub(super) fn acceleration_sizes(&self, model: &Model<R>, state: &State<R>) -> Vec<R> {
        let sizes = |list: &[Polynomial<R>]| list.iter().map(Polynomial::size).collect::<Vec<R>>();
        let springs = self.spring_sizes(state);
        let mut force = model.pull(&springs, &sizes(&self.drift), &sizes(&self.rate), Terms::Sizes);
        let mass = state.mass_with_stuck(model);
        for (j, (block, data)) in state.blocks.iter().zip(&model.goods).enumerate() {
            let Some(node) = data.node else { continue };
            if block.contact != Contact::Stuck && matches!(state.stopped[j], Stopped::Pressing(_)) {
                force[node] = force[node] + self.push_size(model, j);
            }
            if block.contact != Contact::Stuck {
                force[node] = force[node] + block.mu_k * data.mass * self.contact.size();
            }
        }
        let of_nodes = force.into_iter().zip(mass).map(|(force, mass)| force / mass);
        let (slab, moved) = self.size_below(model, state);
        let below = if state.base_moves() { slab / moved } else { self.ground.size() };
        [below].into_iter().chain(of_nodes).collect()
    }

    /// Size of the terms of the force of a stop.
    pub(super) fn push_size(&self, model: &Model<R>, block: usize) -> R {
        let size = |stops: &super::model::StopData<R>| {
            stops.stiffness * self.slip[block].size() + stops.damping * self.velocity[block].size()
        };
        model.goods[block].stops.as_ref().map_or(R::zero(), size)
    }
}
