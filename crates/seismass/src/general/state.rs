//! The state of a run: drifts, springs, blocks and the present regime.

use std::rc::Rc;

use crate::general::regime::{Key, MovingContact, Regime, Regimes};
use crate::general::stops::StopMotion;
use crate::general::system::System;
use crate::machines::block::{BlockMotion, BlockState};
use crate::machines::storey::StoreySpring;
use crate::scene::GeneralScene;
use crate::state::interval::Interval;

/// The state. Lists by node have an entry for the ground, which stays zero, or for the slab of a sliding base: its
/// displacement and velocity relative to the ground.
pub(super) struct GeneralState<'a> {
    pub(super) system: &'a System,
    /// Drift of each spring from the base of its segment (m), and drift rate (m/s).
    pub(super) x: Vec<f64>,
    pub(super) v: Vec<f64>,
    /// Spring of node p, at p - 1.
    pub(super) springs: Vec<StoreySpring>,
    /// Drift at the base of each segment (m).
    pub(super) base_drift: Vec<f64>,
    /// Force at the base: of the spring less P-Delta, and of the elastic matrix (N).
    pub(super) base_load: Vec<f64>,
    pub(super) motions: Vec<BlockMotion>,
    pub(super) stops: Vec<StopMotion>,
    /// The sliding base, with the slip and velocity that node 0 has.
    pub(super) base: Option<BlockMotion>,
    /// All blocks have lost contact with their nodes.
    pub(super) airborne: bool,
    /// Whether the contact force changes in time.
    pub(super) vertical: bool,
    pub(super) interval: Interval,
    pub(super) regime: Rc<Regime>,
    pub(super) regimes: Regimes,
    /// Time until which the fastest mode that decays has a part in the motion still, if that is known (s).
    pub(super) decays_until: f64,
    key: Key,
    /// Blocks that move, and those of them at a stop.
    pub(super) moving: Vec<usize>,
    pub(super) moving_contacts: Vec<MovingContact>,
}

impl<'a> GeneralState<'a> {
    /// A scene at its start, with virgin springs; no regime is entered yet.
    pub(super) fn new(scene: &GeneralScene, system: &'a System, vertical: bool) -> Self {
        let width = system.nodes + 1;
        let (mut x, mut v) = (vec![0.0; width], vec![0.0; width]);
        let mut below = 0.0;
        for (i, (&drift, &velocity)) in scene.initial_drift().iter().zip(scene.initial_velocity()).enumerate() {
            (x[i + 1], v[i + 1]) = (drift, velocity - below);
            below = velocity;
        }
        let mut velocity = vec![0.0; width];
        for p in 1..width {
            velocity[p] = velocity[system.parent[p]] + v[p];
        }
        let motions: Vec<BlockMotion> = scene
            .all_goods()
            .zip(&system.blocks)
            .map(|(goods, law)| BlockMotion::new(law, goods.block.velocity.map_or(0.0, |w| w - velocity[law.floor])))
            .collect();
        Self {
            x,
            v,
            springs: system.laws.iter().map(StoreySpring::new).collect(),
            base_drift: vec![0.0; width],
            base_load: vec![0.0; width],
            stops: vec![StopMotion::free(); motions.len()],
            motions,
            base: system.base.as_ref().map(|base| BlockMotion::new(&base.law, 0.0)),
            airborne: false,
            vertical,
            interval: Interval::default(),
            regime: Rc::new(Regime::default()),
            regimes: Regimes::default(),
            decays_until: 0.0,
            key: Key::default(),
            moving: Vec::new(),
            moving_contacts: Vec::new(),
            system,
        }
    }

    /// Contact force per unit mass at `tau`, zero in flight.
    pub(super) fn contact_at(&self, tau: f64) -> f64 {
        if self.airborne { 0.0 } else { self.interval.contact_at(tau) }
    }

    /// Velocities of all nodes relative to the ground.
    pub(super) fn node_velocities(&self, rates: &[f64]) -> Vec<f64> {
        let mut velocity = vec![rates[0]; rates.len()];
        for p in 1..rates.len() {
            velocity[p] = velocity[self.system.parent[p]] + rates[p];
        }
        velocity
    }

    /// Drift of a node's spring (m).
    pub(super) fn drift(&self, node: usize) -> f64 {
        self.base_drift[node] + self.x[node]
    }

    /// Force of a node's spring (N).
    pub(super) fn spring_force(&self, node: usize) -> f64 {
        self.springs[node - 1].segment().force(self.x[node])
    }

    /// Follows machines that have changed: base loads, and the regime.
    pub(super) fn follow(&mut self) {
        let system = self.system;
        for p in 1..=system.nodes {
            let (spring, law) = (&self.springs[p - 1], &system.laws[p - 1]);
            self.base_drift[p] = spring.segment().base_drift;
            self.base_load[p] = spring.base_load(law);
        }
        for part in system.parts.iter().filter(|part| !part.elastic.is_empty()) {
            let nodes = part.first..part.first + part.count;
            for (column, drift) in part.elastic.chunks_exact(part.count).zip(&self.base_drift[nodes.clone()]) {
                for (load, k) in self.base_load[nodes.clone()].iter_mut().zip(column) {
                    *load += k * drift;
                }
            }
        }
        self.enter_regime();
    }

    /// Enters the regime of the present machines.
    fn enter_regime(&mut self) {
        let system = self.system;
        self.decays_until = 0.0;
        let tangent =
            |p: usize, springs: &[StoreySpring]| springs[p - 1].segment().tangent - system.laws[p - 1].geometric;
        self.moving.clear();
        self.moving_contacts.clear();
        let base_moves = self.base_moves();
        let words = &mut self.key.0;
        words.clear();
        words.extend((1..=system.nodes).map(|p| tangent(p, &self.springs).to_bits()));
        let mut bits = u64::from(base_moves);
        for (j, motion) in self.motions.iter().enumerate() {
            if j % 32 == 31 {
                words.push(std::mem::take(&mut bits));
            }
            bits <<= 2;
            if motion.state == BlockState::Stuck {
                bits |= 1;
                continue;
            }
            self.moving.push(j);
            if let (Some(_), Some(stops)) = (self.stops[j].touching(), system.stops[j]) {
                bits |= 2;
                let (position, stiffness, damping) = (self.moving.len() - 1, stops.stiffness, stops.damping);
                self.moving_contacts.push(MovingContact { block: j, position, stiffness, damping });
            }
        }
        words.push(bits);
        let (springs, motions, contacts) = (&self.springs, &self.motions, &self.moving_contacts);
        self.regime = self.regimes.enter(&self.key, || {
            let tangents = std::iter::once(0.0).chain((1..=system.nodes).map(|p| tangent(p, springs))).collect();
            Regime::new(system, tangents, |j| motions[j].is_stuck(), contacts, base_moves)
        });
    }
}
