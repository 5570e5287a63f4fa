//! The blocks of a state, and what they give to the floors.

use crate::lanes::Padded;
use crate::machines::block::BlockMotion;
use crate::machines::model::Model;
use crate::machines::settle::Transition;

/// The machines of the blocks, and what follows from them for each floor.
pub(crate) struct Blocks {
    pub(crate) motions: Vec<BlockMotion>,
    /// Those that do not stick, in order: all that a step or an event elsewhere looks at.
    pub(crate) moving: Vec<usize>,
    /// Whether the blocks have lost contact.
    pub(crate) airborne: bool,
    /// Whether a block slides.
    pub(crate) is_sliding: bool,
    /// Friction on each floor per unit contact force: sum of sign mu_k m over its sliding blocks (kg), padded.
    pub(crate) friction: Padded,
    /// Smallest mu_s of the blocks stuck to the ground (0) and to each floor; infinite where none is.
    pub(crate) stuck_mu: Vec<f64>,
    /// Mass of the blocks stuck to each floor (kg).
    pub(crate) stuck_mass: Vec<f64>,
    /// Working space: what becomes of the blocks of a floor.
    pub(crate) transitions: Vec<Transition>,
}

impl Blocks {
    /// Blocks with these motions; what follows from them is not formed yet.
    pub(crate) fn new(model: &Model, motions: Vec<BlockMotion>) -> Self {
        let n = model.storeys();
        Self {
            motions,
            moving: Vec::new(),
            airborne: false,
            is_sliding: false,
            friction: Padded::new(model.width, 0.0),
            stuck_mu: vec![f64::INFINITY; n + 1],
            stuck_mass: vec![0.0; n],
            transitions: Vec::new(),
        }
    }
}
