//! The block as a state machine: sticking, sliding, lifted (`numerics`, section 2).

use crate::machines::sign::Sign;
use crate::scene::{Block, Wear};

/// The constant data of a block.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BlockLaw {
    pub(crate) floor: usize,
    pub(crate) mass: f64,
    pub(crate) mu_s: f64,
    pub(crate) mu_k: f64,
    /// Coefficients that follow, by the path slipped in contact.
    pub(crate) wear: Vec<Wear>,
}

impl BlockLaw {
    pub(crate) fn new(block: &Block) -> Self {
        let &Block { floor, mass, mu_s, mu_k, ref wear, .. } = block;
        Self { floor, mass, mu_s, mu_k, wear: wear.clone() }
    }
}

/// What a block does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BlockState {
    /// Moves with its floor.
    Stuck,
    /// Slides, with this sign of its velocity relative to the floor.
    Sliding(Sign),
    /// Has lost contact: no friction.
    Airborne,
}

/// A block in motion, relative to its floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BlockMotion {
    pub(crate) state: BlockState,
    /// Velocity relative to the floor (m/s); exactly zero while stuck.
    pub(crate) velocity: f64,
    /// Displacement relative to the floor (m).
    pub(crate) slip: f64,
    /// Friction coefficients now in force.
    pub(crate) mu_s: f64,
    pub(crate) mu_k: f64,
    /// Changes of the coefficients so far.
    stage: usize,
    /// Path slipped in contact at the next change (m); infinite: none.
    next_wear: f64,
    /// Path of finished flights, less, during one, the path at its start (m).
    flown: f64,
    /// Path slipped up to the last turn of the relative velocity (m).
    path: f64,
    /// Slip at that turn (m).
    turn: f64,
}

impl BlockMotion {
    /// A block at slip zero with a relative velocity.
    pub(crate) fn new(law: &BlockLaw, velocity: f64) -> Self {
        let state = if velocity == 0.0 { BlockState::Stuck } else { BlockState::Sliding(Sign::of(velocity)) };
        let &BlockLaw { mu_s, mu_k, .. } = law;
        let next_wear = law.wear.first().map_or(f64::INFINITY, |next| next.path);
        Self { state, velocity, slip: 0.0, mu_s, mu_k, stage: 0, next_wear, flown: 0.0, path: 0.0, turn: 0.0 }
    }

    /// Whether the block moves with its floor.
    #[inline]
    pub(crate) fn is_stuck(&self) -> bool {
        self.state == BlockState::Stuck
    }

    /// Whether the block slides without friction, in whichever direction: it takes part in no decision.
    pub(crate) fn slides_freely(&self) -> bool {
        self.mu_s == 0.0 && self.sliding().is_some()
    }

    /// Whether it takes part in a decision of its node, or only if it sticks, where that `follows` from another release.
    pub(crate) fn decides(&self, follows: bool) -> bool {
        let is_at_rest = self.velocity == 0.0 && self.state != BlockState::Airborne;
        is_at_rest && (self.is_stuck() || !follows && !self.slides_freely())
    }

    /// Turns what slides without friction and has come to rest; returns the new sign, and whether it has ever moved.
    pub(crate) fn turn(&mut self) -> (Sign, bool) {
        let has_moved = self.velocity != 0.0 || self.slip != 0.0;
        let sign = self.sliding().map_or(Sign::Positive, Sign::opposite);
        self.end_stretch();
        (self.velocity, self.state) = (0.0, BlockState::Sliding(sign));
        (sign, has_moved)
    }

    /// Sign of the relative velocity while sliding.
    #[inline]
    pub(crate) fn sliding(&self) -> Option<Sign> {
        match self.state {
            BlockState::Sliding(sign) => Some(sign),
            _ => None,
        }
    }

    /// Sign of the relative velocity, 0 for none.
    pub(crate) fn velocity_sign(&self) -> i8 {
        if self.velocity == 0.0 { 0 } else { Sign::of(self.velocity).as_i8() }
    }

    /// Changes velocity and slip.
    #[inline]
    pub(crate) fn move_by(&mut self, (velocity, slip): (f64, f64)) {
        self.velocity += velocity;
        self.slip += slip;
    }

    /// Closes a monotonic stretch of the slip path at `slip`.
    pub(crate) fn turn_at(&mut self, slip: f64) {
        self.path += (slip - self.turn).abs();
        self.turn = slip;
    }

    /// Closes a monotonic stretch of the slip path here.
    pub(crate) fn end_stretch(&mut self) {
        self.turn_at(self.slip);
    }

    /// Path slipped so far (m).
    pub(crate) fn path(&self) -> f64 {
        self.path + (self.slip - self.turn).abs()
    }

    /// Path slipped so far in contact (m).
    pub(crate) fn path_in_contact(&self) -> f64 {
        if self.state == BlockState::Airborne { -self.flown } else { self.path() - self.flown }
    }

    /// Leaves contact: the path from here on does not wear it.
    pub(crate) fn lift(&mut self) {
        self.state = BlockState::Airborne;
        self.flown -= self.path();
    }

    /// Is in contact again.
    pub(crate) fn land(&mut self) {
        self.state =
            if self.velocity == 0.0 { BlockState::Stuck } else { BlockState::Sliding(Sign::of(self.velocity)) };
        self.flown += self.path();
    }

    /// Path to be slipped in contact until the coefficients change (m); infinite: they do not.
    #[inline]
    pub(crate) fn path_to_wear(&self) -> f64 {
        if self.next_wear == f64::INFINITY { self.next_wear } else { self.next_wear - (self.path() - self.flown) }
    }

    /// What the slip times its sign does not reach before the coefficients change.
    #[inline]
    pub(crate) fn wear_limit(&self, sign: f64) -> f64 {
        sign * self.slip + self.path_to_wear()
    }

    /// The coefficients change; returns how often they have.
    pub(crate) fn wear(&mut self, law: &BlockLaw) -> u8 {
        if let Some(&Wear { mu_s, mu_k, .. }) = law.wear.get(self.stage) {
            (self.mu_s, self.mu_k) = (mu_s, mu_k);
            self.stage += 1;
            self.next_wear = law.wear.get(self.stage).map_or(f64::INFINITY, |next| next.path);
        }
        self.stage as u8
    }

    /// Name of the state, for errors.
    pub(crate) fn state_name(&self) -> &'static str {
        match self.state {
            BlockState::Stuck => "stuck",
            BlockState::Sliding(Sign::Positive) => "sliding forwards",
            BlockState::Sliding(Sign::Negative) => "sliding backwards",
            BlockState::Airborne => "airborne",
        }
    }
}
