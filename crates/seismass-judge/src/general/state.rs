//! The state of a run between and at events: drifts, springs, blocks and their stops.

use seismass::GeneralScene;

use super::base::BaseData;
use super::model::Model;
use crate::model::{Stage, Terms};
use crate::real::Real;
use crate::sign::Sign;
use crate::springs::Spring;
use crate::state::{BlockState, Contact, Drive};

/// A block and its stops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stopped {
    /// Beyond no clearance.
    Free,
    /// Presses on the stop of this side.
    Pressing(Sign),
    /// Beyond the clearance of this side, without a force.
    Parted(Sign),
}

/// Everything that changes in a run.
#[derive(Debug)]
pub(crate) struct State<R> {
    pub(super) drift: Vec<R>,
    pub(super) rate: Vec<R>,
    pub(super) springs: Vec<Box<dyn Spring<R>>>,
    pub(super) blocks: Vec<BlockState<R>>,
    pub(super) stopped: Vec<Stopped>,
    /// The slab on the ground.
    pub(super) base: Option<BlockState<R>>,
}

impl<R: Real> State<R> {
    /// The initial state: springs virgin, slips zero, racks at rest on what they stand on, blocks without relative velocity
    /// taken as stuck.
    pub(super) fn new(scene: &GeneralScene, model: &Model<R>) -> Self {
        let n = model.mass.len();
        let value = |values: &[f64], p: usize| values.get(p).map_or(R::zero(), |&v| R::of(v));
        let drift: Vec<R> = (0..n).map(|p| value(scene.initial_drift(), p)).collect();
        let velocity = scene.initial_velocity();
        let storeys = scene.storeys();
        let rate = |p: usize| match p {
            p if p >= storeys => R::zero(),
            0 => value(velocity, 0),
            p => value(velocity, p) - value(velocity, p - 1),
        };
        let rate: Vec<R> = (0..n).map(rate).collect();
        let springs = model.springs.iter().zip(&drift).map(|(data, &d)| {
            let mut spring = data.spring.copied();
            spring.start(d);
            spring
        });
        // A level moves as the floor that its rack stands on.
        let mut floors: Vec<R> = Vec::new();
        for p in 0..n {
            let below = model.parent[p].map_or(R::zero(), |parent| floors[parent]);
            floors.push(if p < storeys { value(velocity, p) } else { below });
        }
        let blocks = scene.all_goods().zip(&model.goods).map(|(goods, data)| {
            let node = data.node.map_or(R::zero(), |node| floors[node]);
            let velocity = goods.block.velocity.map_or(R::zero(), |w| R::of(w) - node);
            let contact = if velocity == R::zero() { Contact::Stuck } else { Contact::Sliding(Sign::of(velocity)) };
            let Stage { path, mu_s, mu_k } = data.stages[0];
            BlockState { contact, velocity, slip: R::zero(), moved: true, path, stage: 0, mu_s, mu_k }
        });
        Self {
            springs: springs.collect(),
            blocks: blocks.collect(),
            stopped: vec![Stopped::Free; model.goods.len()],
            base: model.base.as_ref().map(BaseData::at_rest),
            drift,
            rate,
        }
    }

    /// Spring force of each spring, without P-Delta and damping, or the size of its terms.
    pub(super) fn spring_forces(&self, terms: Terms) -> Vec<R> {
        let force = |(spring, drift): (&dyn Spring<R>, R)| {
            let parts = spring.parts().into_iter().fold(R::zero(), |sum, part| sum + terms.of(part.force));
            parts + terms.of(spring.linear() * drift)
        };
        self.springs.iter().zip(&self.drift).map(|(spring, &drift)| force((spring.as_ref(), drift))).collect()
    }

    /// Mass of each node with the blocks that stick to it.
    pub(super) fn mass_with_stuck(&self, model: &Model<R>) -> Vec<R> {
        let mut mass = model.mass.clone();
        for (_, data) in self.blocks.iter().zip(&model.goods).filter(|(b, _)| b.contact == Contact::Stuck) {
            if let Some(node) = data.node {
                mass[node] = mass[node] + data.mass;
            }
        }
        mass
    }

    /// Slip at which a block comes to the stop of this side.
    pub(super) fn place_of_stop(model: &Model<R>, block: usize, side: Sign) -> Option<R> {
        let clearance = model.goods[block].stops.as_ref()?.clearance[usize::from(side == Sign::Positive)]?;
        Some(side.times(clearance))
    }

    /// Force of a block's stop on its node, k e + c e' in the direction of the side: minus that on the block.
    pub(super) fn push(&self, model: &Model<R>, block: usize) -> R {
        let Stopped::Pressing(side) = self.stopped[block] else { return R::zero() };
        let (Some(stops), Some(place)) = (&model.goods[block].stops, Self::place_of_stop(model, block, side)) else {
            return R::zero();
        };
        stops.stiffness * (self.blocks[block].slip - place) + stops.damping * self.blocks[block].velocity
    }

    /// Energy stored in the stop that a block presses on, or has parted from.
    pub(super) fn stop_energy(&self, model: &Model<R>, block: usize) -> R {
        let (Stopped::Pressing(side) | Stopped::Parted(side)) = self.stopped[block] else { return R::zero() };
        let (Some(stops), Some(place)) = (&model.goods[block].stops, Self::place_of_stop(model, block, side)) else {
            return R::zero();
        };
        let beyond = self.blocks[block].slip - place;
        R::of(0.5) * stops.stiffness * beyond * beyond
    }

    /// Absolute acceleration of a node (none: the ground or the slab) in the present regime, or the size of its terms.
    pub(super) fn acceleration(
        &self,
        model: &Model<R>,
        node: Option<usize>,
        drive: &Drive<R>,
        tau: R,
        terms: Terms,
    ) -> R {
        let Some(node) = node else {
            let (force, mass) = self.on_slab(model, drive, tau, terms);
            return if self.base_moves() { force / mass } else { terms.of(drive.ground_at(tau)) };
        };
        let mut force = model.pull(&self.spring_forces(terms), &self.drift, &self.rate, terms)[node];
        let mut mass = model.mass[node];
        for (j, (block, data)) in self.blocks.iter().zip(&model.goods).enumerate() {
            if data.node != Some(node) {
                continue;
            }
            match block.contact {
                Contact::Stuck => {
                    mass = mass + data.mass;
                    continue;
                }
                Contact::Sliding(sign) => {
                    force = force + terms.of(sign.times(block.mu_k * data.mass * drive.contact_at(tau)));
                }
                Contact::Airborne => {}
            }
            force = force + terms.of(self.push(model, j));
        }
        force / mass
    }

    /// Kinetic energy of nodes and blocks, relative to the ground.
    pub(super) fn kinetic_energy(&self, model: &Model<R>) -> R {
        let below = self.base_velocity();
        let of_nodes = model.displacements(&self.rate, Terms::Signed);
        let velocity: Vec<R> = of_nodes.into_iter().map(|v| below + v).collect();
        let slab = model.base.as_ref().map_or(R::zero(), |base| base.mass * below * below);
        let nodes = model.mass.iter().zip(&velocity).fold(slab, |sum, (&m, &v)| sum + m * v * v);
        let blocks = model.goods.iter().zip(&self.blocks).fold(R::zero(), |sum, (data, block)| {
            let v = data.node.map_or(below, |node| velocity[node]) + block.velocity;
            sum + data.mass * v * v
        });
        R::of(0.5) * (nodes + blocks)
    }

    /// Energy stored in springs, matrix and stops, and in the height of a pendulum, less the work of P-Delta.
    pub(super) fn elastic_energy(&self, model: &Model<R>) -> R {
        let half = R::of(0.5);
        let mut energy = R::zero();
        for (p, data) in model.springs.iter().enumerate() {
            energy = energy + self.springs[p].stored(self.drift[p]);
            energy = energy - half * data.geometric * self.drift[p] * self.drift[p];
        }
        let displacement = model.displacements(&self.drift, Terms::Signed);
        for (u, force) in displacement.iter().zip(model.matrix_forces(&displacement, Terms::Signed)) {
            energy = energy + half * *u * force;
        }
        if let (Some(data), Some(base)) = (&model.base, &self.base) {
            energy = energy + half * data.restoring * model.gravity * base.slip * base.slip;
        }
        let pressing = (0..self.blocks.len()).filter(|&j| matches!(self.stopped[j], Stopped::Pressing(_)));
        pressing.fold(energy, |sum, j| sum + self.stop_energy(model, j))
    }

    /// The blocks that press on a stop and are not stuck.
    pub(super) fn moving_at_stops(&self) -> Vec<usize> {
        let moves = |j: &usize| self.blocks[*j].contact != Contact::Stuck;
        let presses = |j: &usize| matches!(self.stopped[*j], Stopped::Pressing(_));
        (0..self.blocks.len()).filter(moves).filter(presses).collect()
    }

    pub(super) fn is_finite(&self) -> bool {
        let blocks = self.blocks.iter().chain(&self.base).flat_map(|b| [b.velocity, b.slip]);
        self.drift.iter().chain(&self.rate).copied().chain(blocks).all(|x| x.to_f64().is_finite())
    }
}
