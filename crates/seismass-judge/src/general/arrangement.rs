//! A run's machines at an instant.

use seismass::{Event, EventKind, GeneralEvent};

use super::model::Model;
use super::state::{State, Stopped};
use crate::real::Real;
use crate::state::{Contact, Drive};

/// A run's machines at an instant.
pub(super) struct Machines<'a, R> {
    pub(super) model: &'a Model<R>,
    pub(super) state: &'a mut State<R>,
    pub(super) drive: Drive<R>,
    pub(super) airborne: &'a mut bool,
    /// Length of a whole piece: velocities carry the rounding of accelerations over this time.
    pub(super) piece: R,
    /// Beginning of the sample interval (s).
    pub(super) start: R,
    pub(super) log: &'a mut Vec<GeneralEvent>,
    /// Energy that stops have lost where they parted.
    pub(super) parted: &'a mut R,
}

impl<R: Real> Machines<'_, R> {
    pub(super) fn on_node(&self, node: Option<usize>) -> Vec<usize> {
        (0..self.model.goods.len()).filter(|&j| self.model.goods[j].node == node).collect()
    }

    pub(super) fn presses(&self, block: usize) -> bool {
        matches!(self.state.stopped[block], Stopped::Pressing(_))
    }

    pub(super) fn is_stuck(&self, block: usize) -> bool {
        self.state.blocks[block].contact == Contact::Stuck
    }

    pub(super) fn note(&mut self, tau: R, kind: EventKind, index: usize, sign: i8, element: u8) {
        let moves = [EventKind::TouchStop, EventKind::LeaveStop, EventKind::Wear, EventKind::Lift, EventKind::Land];
        let velocity = if moves.contains(&kind) { self.state.blocks[index].velocity.to_f64() } else { 0.0 };
        let time = (self.start + tau).to_f64();
        self.log.push(GeneralEvent { event: Event { time, kind, number: index + 1, sign, element }, velocity });
    }
}
