//! The Taylor series of everything over a stretch of time in one regime, as polynomials on [0, 1].

use super::model::Model;
use super::state::{State, Stopped};
use crate::model::Terms;
use crate::polynomial::Polynomial;
use crate::real::Real;
use crate::series::{integrate, orders};
use crate::springs::{Course, Part};
use crate::state::{Contact, Drive};

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
    /// Absolute acceleration of the ground (index 0) and of each node.
    pub(super) acceleration: Vec<Polynomial<R>>,
    /// Velocity of each block relative to its node.
    pub(super) velocity: Vec<Polynomial<R>>,
    pub(super) slip: Vec<Polynomial<R>>,
    /// Force of each block's stop on its node, constant zero where it does not press.
    pub(super) push: Vec<Polynomial<R>>,
}

/// Index of a node's acceleration.
pub(super) fn place(node: Option<usize>) -> usize {
    node.map_or(0, |node| node + 1)
}

fn term<R: Real>(p: &Polynomial<R>, order: usize) -> R {
    p.0.get(order).copied().unwrap_or(R::zero())
}

impl<R: Real> Series<R> {
    /// c_(k+1) = (A c_k + load_k) / (k + 1), from the state at `tau` over `length`.
    pub(super) fn new(model: &Model<R>, state: &State<R>, drive: &Drive<R>, tau: R, length: R) -> Self {
        let starts = |values: &[R]| values.iter().map(|&v| Polynomial::constant(v)).collect::<Vec<_>>();
        let (n, m) = (model.mass.len(), model.goods.len());
        let one = R::of(1.0);
        let parts: Vec<Vec<Part<R>>> = state.springs.iter().map(|spring| spring.parts()).collect();
        let mut series = Self {
            length,
            ground: Polynomial(vec![drive.ground_at(tau), drive.ground[1] * length]),
            contact: Polynomial(vec![drive.contact_at(tau), drive.contact[1] * length]),
            drift: starts(&state.drift),
            rate: starts(&state.rate),
            force: parts.iter().map(|s| starts(&s.iter().map(|part| part.force).collect::<Vec<_>>())).collect(),
            acceleration: vec![Polynomial(Vec::new()); n + 1],
            velocity: starts(&state.blocks.iter().map(|b| b.velocity).collect::<Vec<_>>()),
            slip: starts(&state.blocks.iter().map(|b| b.slip).collect::<Vec<_>>()),
            push: starts(&(0..m).map(|j| state.push(model, j)).collect::<Vec<_>>()),
        };
        let mut mass = model.mass.clone();
        for (block, data) in state.blocks.iter().zip(&model.goods).filter(|(b, _)| b.contact == Contact::Stuck) {
            if let Some(node) = data.node {
                mass[node] = mass[node] + data.mass;
            }
            debug_assert!(block.velocity == R::zero());
        }
        for order in 0..orders::<R>(MAX_PHASE) {
            let spring = |p: usize| {
                let parts = series.force[p].iter().fold(R::zero(), |sum, part| sum + term(part, order));
                parts + state.springs[p].linear() * term(&series.drift[p], order)
            };
            let springs: Vec<R> = (0..n).map(spring).collect();
            let terms = |list: &[Polynomial<R>]| list.iter().map(|p| term(p, order)).collect::<Vec<R>>();
            let mut pull = model.pull(&springs, &terms(&series.drift), &terms(&series.rate), Terms::Signed);
            let (ground, contact) = (term(&series.ground, order), term(&series.contact, order));
            // Force on each block, that on its node being the opposite one.
            let mut on_block = vec![R::zero(); m];
            for (j, (block, data)) in state.blocks.iter().zip(&model.goods).enumerate() {
                if block.contact == Contact::Stuck {
                    continue;
                }
                if let (Stopped::Pressing(_), Some(stops), true) = (state.stopped[j], &data.stops, order > 0) {
                    let force = stops.stiffness * term(&series.slip[j], order);
                    series.push[j].0.push(force + stops.damping * term(&series.velocity[j], order));
                }
                let friction = match block.contact {
                    Contact::Sliding(sign) => sign.times(block.mu_k * data.mass) * contact,
                    _ => R::zero(),
                };
                on_block[j] = -(friction + term(&series.push[j], order));
                if let Some(node) = data.node {
                    pull[node] = pull[node] - on_block[j];
                }
            }
            series.acceleration[0].0.push(ground);
            for p in 0..n {
                series.acceleration[p + 1].0.push(pull[p] / mass[p]);
            }
            for p in 0..n {
                let below = series.acceleration[place(model.parent[p])].0[order];
                let difference = series.acceleration[p + 1].0[order] - below;
                series.rate[p].0.push(length * difference / R::of((order + 1) as f64));
                integrate(&series.rate[p], one, length, &mut series.drift[p]);
                for (force, part) in series.force[p].iter_mut().zip(&parts[p]).filter(|(_, p)| p.tangent != R::zero()) {
                    integrate(&series.rate[p], part.tangent, length, force);
                }
            }
            for (j, data) in model.goods.iter().enumerate() {
                if state.blocks[j].contact != Contact::Stuck {
                    let relative = on_block[j] / data.mass - series.acceleration[place(data.node)].0[order];
                    series.velocity[j].0.push(length * relative / R::of((order + 1) as f64));
                    integrate(&series.velocity[j], one, length, &mut series.slip[j]);
                }
            }
        }
        series
    }

    /// Restricts the stretch to its first part, of this fraction.
    pub(super) fn shrink(&mut self, place: R) {
        self.length = self.length * place;
        let Self { ground, contact, drift, rate, force, acceleration, velocity, slip, push, .. } = self;
        let lists = [drift, rate, acceleration, velocity, slip, push].into_iter().flatten();
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
        for (j, block) in state.blocks.iter_mut().enumerate() {
            block.velocity = self.velocity[j].end();
            block.slip = self.slip[j].end();
            if let Contact::Sliding(sign) = block.contact {
                block.path = block.path + sign.times(self.slipped(j).end());
            }
            block.moved |= self.length > R::zero();
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

    /// Size of the terms of each node's acceleration over the stretch (index 0: the ground): the measure of its rounding.
    pub(super) fn acceleration_sizes(&self, model: &Model<R>, state: &State<R>) -> Vec<R> {
        let sizes = |list: &[Polynomial<R>]| list.iter().map(Polynomial::size).collect::<Vec<R>>();
        let spring = |p: usize| {
            let parts = self.force[p].iter().fold(R::zero(), |sum, part| sum + part.size());
            parts + state.springs[p].linear() * self.drift[p].size()
        };
        let springs: Vec<R> = (0..model.springs.len()).map(spring).collect();
        let mut force = model.pull(&springs, &sizes(&self.drift), &sizes(&self.rate), Terms::Sizes);
        let mut mass = model.mass.clone();
        for (j, (block, data)) in state.blocks.iter().zip(&model.goods).enumerate() {
            let Some(node) = data.node else { continue };
            if block.contact != Contact::Stuck && matches!(state.stopped[j], Stopped::Pressing(_)) {
                force[node] = force[node] + self.push_size(model, j);
            }
            match block.contact {
                Contact::Stuck => mass[node] = mass[node] + data.mass,
                _ => force[node] = force[node] + block.mu_k * data.mass * self.contact.size(),
            }
        }
        let of_nodes = force.into_iter().zip(mass).map(|(force, mass)| force / mass);
        [self.ground.size()].into_iter().chain(of_nodes).collect()
    }

    /// Size of the terms of the force of a stop.
    pub(super) fn push_size(&self, model: &Model<R>, block: usize) -> R {
        let size = |stops: &super::model::StopData<R>| {
            stops.stiffness * self.slip[block].size() + stops.damping * self.velocity[block].size()
        };
        model.goods[block].stops.as_ref().map_or(R::zero(), size)
    }
}
