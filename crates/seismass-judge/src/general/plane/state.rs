//! The state of a run in the plane: two directions with blocks in common.

use seismass::{GeneralEvent, PlaneEvent, PlaneMotion, PlaneScene};

use crate::general::arrangement::Machines;
use crate::general::model::Model;
use crate::general::solve::Scale;
use crate::general::state::State;
use crate::general::stretches::Stretches;
use crate::model::Terms;
use crate::real::Real;
use crate::state::{Contact, Drive};

/// What is of one direction. Contact, friction and path of blocks are those of the first.
pub(super) struct Direction<R> {
    pub(super) model: Model<R>,
    pub(super) state: State<R>,
    pub(super) drive: Drive<R>,
    pub(super) log: Vec<GeneralEvent>,
    /// Energy that stops have lost where they parted.
    pub(super) parted: R,
    pub(super) stretches: Stretches,
}

pub(super) struct Plane<R> {
    pub(super) directions: [Direction<R>; 2],
    /// Direction in which a block begins to slide that has no relative velocity.
    pub(super) heads: Vec<[R; 2]>,
    /// Blocks that have started from rest and whose relative velocity is none still.
    pub(super) young: Vec<bool>,
    /// Drifts in x and y that are the axes of the ellipse at which a spring collapses.
    pub(super) collapse: Vec<[Option<R>; 2]>,
    /// The largest velocity so far, of a node or of a block relative to its own.
    pub(super) fastest: R,
    pub(super) airborne: bool,
    pub(super) piece: R,
    /// Beginning of the present sample interval.
    pub(super) start: R,
    /// Series made so far.
    pub(super) series: usize,
    /// Events of vectors.
    pub(super) log: Vec<PlaneEvent>,
}

impl<R: Real> Plane<R> {
    pub(super) fn new(scene: &PlaneScene, motion: &PlaneMotion, scale: Scale<R>) -> Self {
        let directions = [0, 1].map(|a| {
            let scene = &scene.directions()[a];
            let model = Model::new(scene);
            let state = State::new(scene, &model);
            let drive = scale.drive(&motion.directions()[a], 0);
            Direction { model, state, drive, log: Vec::new(), parted: R::zero(), stretches: Stretches::default() }
        });
        let none = vec![[R::zero(); 2]; directions[0].model.goods.len()];
        let nodes = directions[0].model.mass.len();
        let mut plane = Self {
            young: vec![false; none.len()],
            heads: none,
            collapse: (0..nodes).map(|p| [0, 1].map(|a| directions[a].model.springs[p].collapse_drift)).collect(),
            directions,
            fastest: R::zero(),
            airborne: false,
            piece: R::zero(),
            start: R::zero(),
            series: 0,
            log: Vec::new(),
        };
        // The vector of drifts decides.
        for spring in plane.directions.iter_mut().flat_map(|direction| &mut direction.model.springs) {
            spring.collapse_drift = None;
        }
        plane
    }

    pub(super) fn machines(&mut self, a: usize) -> Machines<'_, R> {
        let Self { directions, airborne, piece, start, .. } = self;
        let Direction { model, state, drive, log, parted, .. } = &mut directions[a];
        Machines { model, state, drive: *drive, airborne, piece: *piece, start: *start, log, parted }
    }

    /// Velocity of a block relative to its node.
    pub(super) fn velocity(&self, block: usize) -> [R; 2] {
        [0, 1].map(|a| self.directions[a].state.blocks[block].velocity)
    }

    /// Whether a block slides and has friction, or may stick.
    pub(super) fn has_friction(&self, block: usize) -> bool {
        let state = &self.directions[0].state.blocks[block];
        matches!(state.contact, Contact::Sliding(_)) && state.mu_s > R::zero()
    }

    pub(super) fn set_contact(&mut self, block: usize, contact: Contact) {
        self.directions.iter_mut().for_each(|direction| direction.state.blocks[block].contact = contact);
    }

    pub(super) fn look_at_velocities(&mut self) {
        let length = |x: R, y: R| (x * x + y * y).sqrt();
        let nodes =
            [0, 1].map(|a| self.directions[a].model.displacements(&self.directions[a].state.rate, Terms::Signed));
        let of_nodes = nodes[0].iter().zip(&nodes[1]).map(|(&x, &y)| length(x, y));
        let of_blocks = (0..self.heads.len()).map(|j| self.velocity(j)).map(|[x, y]| length(x, y));
        self.fastest = of_nodes.chain(of_blocks).fold(self.fastest, R::max);
    }
}
