//! The linear system of one tuple of machine states, and the bound of its frequencies.

use std::cell::OnceCell;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use crate::general::system::System;

/// Regimes that are kept; beyond, the cache starts afresh.
const MOST_REGIMES: usize = 4096;

/// What of the machines affects the system: tangents, and which blocks are stuck or at a stop.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Default)]
pub(super) struct Key(pub(super) Vec<u64>);

/// A mode that decays fast (`decay`). Lists are by node, then by block at a stop.
pub(super) struct DecayingMode {
    /// Rate of decay (1/s).
    pub(super) rate: f64,
    /// Displacements relative to the ground, so that the modal mass is 1.
    pub(super) shape: Vec<f64>,
    /// Masses times displacements.
    pub(super) momentum: Vec<f64>,
    /// Weights K f/r of drift rates and relative velocities.
    pub(super) stiffness: Vec<f64>,
    /// Bound of the frequencies that are left where this mode and those before it have decayed (rad/s).
    pub(super) left: f64,
}

/// A regime. Lists are by node.
#[derive(Default)]
pub(super) struct Regime {
    /// Tangents of the springs less P/h (N/m).
    pub(super) tangent: Vec<f64>,
    /// 1 / (mass with the goods that are stuck) (1/kg); 0 for the ground, and for a slab that is stuck to it.
    pub(super) inverse_mass: Vec<f64>,
    /// Mass of a slab with the goods that are stuck to it (kg).
    pub(super) slab_mass: f64,
    /// No frequency of the system, damped as it is, is above this (rad/s).
    pub(super) frequency: f64,
    /// No rate of decay is above this (1/s).
    pub(super) damping: f64,
    /// Modes that decay fast, the fastest first, once they are asked for.
    pub(super) decaying: OnceCell<Vec<DecayingMode>>,
}

/// A block that moves at its stop.
#[derive(Debug, Clone, Copy)]
pub(super) struct MovingContact {
    pub(super) block: usize,
    /// Its place among the blocks that move.
    pub(super) position: usize,
    pub(super) stiffness: f64,
    pub(super) damping: f64,
}

impl Regime {
    pub(super) fn new(
        system: &System,
        tangent: Vec<f64>,
        is_stuck: impl Fn(usize) -> bool,
        contacts: &[MovingContact],
        base_moves: bool,
    ) -> Self {
        let mut mass = system.mass.clone();
        for (j, block) in system.blocks.iter().enumerate() {
            if is_stuck(j) {
                mass[block.floor] += block.mass;
            }
        }
        let slab_mass = mass[0];
        if !base_moves {
            mass[0] = 0.0;
        }
        let inverse_mass: Vec<f64> = mass.iter().map(|&m| if m > 0.0 { 1.0 / m } else { 0.0 }).collect();
        let (frequency, damping) = frequency(system, &tangent, &inverse_mass, contacts);
        Self { tangent, inverse_mass, slab_mass, frequency, damping, decaying: OnceCell::new() }
    }
}

/// w = kappa/2 + sqrt(kappa^2/4 + sigma) with Gershgorin's bounds kappa and sigma of damping and stiffness in coordinates
/// scaled by the roots of the masses (`numerics`, section 4.3), and kappa. A block at its stop is a mass of its own.
fn frequency(system: &System, tangent: &[f64], inverse_mass: &[f64], contacts: &[MovingContact]) -> (f64, f64) {
    let width = system.nodes + 1;
    let root: Vec<f64> = inverse_mass.iter().map(|inverse| inverse.sqrt()).collect();
    let (mut kappa, mut sigma) = (vec![0.0; width], vec![0.0; width]);
    if let Some(base) = &system.base {
        sigma[0] += base.most_stiffness * inverse_mass[0];
    }
    for p in 0..width {
        let row = p * width..(p + 1) * width;
        let of = |entries: &[f64]| -> f64 {
            root[p] * entries.iter().zip(&root).map(|(entry, root)| entry.abs() * root).sum::<f64>()
        };
        kappa[p] += of(&system.damping[row.clone()]);
        sigma[p] += of(&system.elastic[row]);
        let (size, parent) = (tangent[p].abs(), system.parent[p]);
        sigma[p] += size * root[p] * (root[p] + root[parent]);
        sigma[parent] += size * root[parent] * (root[p] + root[parent]);
    }
    let (mut of_blocks, mut damping_of_blocks) = (0.0_f64, 0.0_f64);
    for &MovingContact { block, stiffness, damping, .. } in contacts {
        let (node, own) = (system.blocks[block].floor, 1.0 / system.blocks[block].mass.sqrt());
        of_blocks = of_blocks.max(stiffness * own * (own + root[node]));
        damping_of_blocks = damping_of_blocks.max(damping * own * (own + root[node]));
        sigma[node] += stiffness * root[node] * (own + root[node]);
        kappa[node] += damping * root[node] * (own + root[node]);
    }
    let largest = |list: &[f64], other: f64| list.iter().copied().fold(other, f64::max);
    let (kappa, sigma) = (largest(&kappa, damping_of_blocks), largest(&sigma, of_blocks));
    (0.5 * kappa + (0.25 * kappa * kappa + sigma).sqrt(), kappa)
}

/// Regimes that a run has met.
#[derive(Default)]
pub(super) struct Regimes {
    known: FxHashMap<Key, Rc<Regime>>,
    /// Different regimes entered, and entries that found the regime known.
    pub(super) entered: (usize, usize),
}

impl Regimes {
    /// The regime of a key, formed if it is not known.
    pub(super) fn enter(&mut self, key: &Key, form: impl FnOnce() -> Regime) -> Rc<Regime> {
        if let Some(regime) = self.known.get(key) {
            self.entered.1 += 1;
            return Rc::clone(regime);
        }
        self.entered.0 += 1;
        if self.known.len() == MOST_REGIMES {
            self.known.clear();
        }
        let regime = Rc::new(form());
        self.known.insert(key.clone(), Rc::clone(&regime));
        regime
    }
}
