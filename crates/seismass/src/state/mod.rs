//! The state of a run: drifts, drift rates, spring and block machines, and what one sample interval does to them.

pub(crate) mod accelerations;
pub(crate) mod blocks;
pub(crate) mod effort;
mod enclose;
mod follow;
pub(crate) mod interval;
pub(crate) mod key;
pub(crate) mod kinematics;
pub(crate) mod limits;
pub(crate) mod ranges;
pub(crate) mod relative;
pub(crate) mod sample;
mod sizes;
pub(crate) mod springs;
pub(crate) mod step;

use std::rc::Rc;

use crate::lanes::{Padded, WIDEST, WIDTH};
use crate::machines::block::BlockMotion;
use crate::machines::model::Model;
use crate::scene::{Block, Motion, Scene};
use crate::state::blocks::Blocks;
use crate::state::effort::Effort;
use crate::state::interval::Interval;
use crate::state::key::RegimeKey;
use crate::state::kinematics::Kinematics;
use crate::state::limits::Bounds;
use crate::state::springs::Springs;
use crate::state::step::StepSpace;
use crate::step::cache::{KnownRegime, RegimeCache};

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
    pub(crate) step: StepSpace,
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
            step: StepSpace::new(model),
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

    /// Contact force per unit mass as the blocks feel it: zero while airborne.
    #[inline]
    pub(crate) fn contact_at(&self, tau: f64) -> f64 {
        if self.blocks.airborne { 0.0 } else { self.interval.contact_at(tau).max(0.0) }
    }

    /// Vectors of storeys: `K`, or as many as there are where the most do not hold them.
    #[inline(always)]
    pub(crate) fn vectors<const K: usize>(&self) -> usize {
        if K < WIDEST { K } else { self.model.width / WIDTH }
    }

    /// Moves on to the interval between samples `i` and `i + 1` of a motion, or to a point at the last sample.
    #[inline(always)]
    pub(crate) fn set_interval(&mut self, motion: &Motion, i: usize) {
        let vertical = motion.vertical().filter(|_| self.vertical);
        self.interval = interval::interval(motion, vertical, i);
    }
}
