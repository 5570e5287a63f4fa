//! What follows from a guard that has fallen (`numerics`, sections 2, 5 and 9.3).

use seismass::{Event, EventKind, GeneralEvent};

use super::arrangement::Machines;
use super::base::contact_after;
use super::decide::Cause;
use super::guards::{Guard, ROUNDING};
use super::series::Series;
use super::state::{State, Stopped};
use crate::model::{Stage, Terms};
use crate::real::Real;
use crate::sign::Sign;
use crate::springs::SpringGuard;
use crate::state::{BlockState, Contact};

impl<R: Real> Machines<'_, R> {
    /// Carries out an event at `tau`, which the state has reached at the end of `series`. Collapse ends a run and is not
    /// for here.
    pub(super) fn carry_out(&mut self, guard: Guard, series: &Series<R>, tau: R) {
        match guard {
            Guard::Collapse { .. } => {}
            Guard::Contact => self.change_contact(tau),
            Guard::Spring { node, guard } => {
                if let SpringGuard::Turn(_) = guard {
                    self.state.rate[node] = R::zero();
                }
                for crossing in self.state.springs[node].cross(guard, self.state.drift[node]) {
                    self.note(tau, crossing.kind, node, crossing.sign.as_i8(), crossing.element);
                }
            }
            Guard::Breakaway { block, sign } => {
                self.settle(self.model.goods[block].node, tau, Cause::Breakaway(block, sign));
            }
            Guard::Arrival { block } => {
                if self.arrive_together(block, series, tau) {
                    self.settle(self.model.goods[block].node, tau, Cause::Arrival);
                }
            }
            Guard::BaseBreakaway { sign } => self.settle(None, tau, Cause::Base(sign)),
            Guard::BaseArrival => {
                let Some(base) = &mut self.state.base else { return };
                if base.slides_freely() {
                    let turned = base.turn_back();
                    self.note_turn(0, tau, turned);
                    return;
                }
                (base.velocity, base.moved) = (R::zero(), true);
                self.settle(None, tau, Cause::Arrival);
            }
            Guard::Wear { block } => self.wear(block, tau),
            Guard::Touch { block, side } => {
                if self.touch(block, side, tau) && !*self.airborne {
                    self.settle(self.model.goods[block].node, tau, Cause::Jump);
                }
            }
            Guard::Leave { block } => self.leave(block, tau),
            Guard::Within { block } => self.set_at_stop(block, Stopped::Free),
            Guard::Again { block, side } => {
                *self.parted = *self.parted - self.state.stop_energy(self.model, block);
                self.state.stopped[block] = Stopped::Pressing(side);
                self.note(tau, EventKind::TouchStop, block, side.as_i8(), 0);
            }
        }
    }

    /// A block comes to its stop; whether the force jumps, as with a damper, so that the node decides again.
    pub(super) fn touch(&mut self, block: usize, side: Sign, tau: R) -> bool {
        self.state.stopped[block] = Stopped::Pressing(side);
        self.set_at_stop(block, Stopped::Pressing(side));
        self.note(tau, EventKind::TouchStop, block, side.as_i8(), 0);
        self.state.push(self.model, block) != R::zero()
    }

    /// The force of a stop has come to zero: at its clearance, or beyond it where a damper holds the stop back.
    fn leave(&mut self, block: usize, tau: R) {
        let Stopped::Pressing(side) = self.state.stopped[block] else { return };
        let (place, stops) = (State::place_of_stop(self.model, block, side), &self.model.goods[block].stops);
        let (Some(place), Some(stops)) = (place, stops) else { return };
        let slip = self.state.blocks[block].slip;
        let beyond = side.times(slip - place);
        if stops.damping == R::zero() || beyond <= R::of(ROUNDING) * R::epsilon() * (slip.abs() + place.abs()) {
            self.set_at_stop(block, Stopped::Free);
        } else {
            self.state.stopped[block] = Stopped::Parted(side);
            *self.parted = *self.parted + self.state.stop_energy(self.model, block);
        }
        self.note(tau, EventKind::LeaveStop, block, side.as_i8(), 0);
    }

    /// Sets the slip to exactly the place of the stop that the block is at.
    fn set_at_stop(&mut self, block: usize, stopped: Stopped) {
        if let Stopped::Pressing(side) | Stopped::Parted(side) = self.state.stopped[block] {
            let place = State::place_of_stop(self.model, block, side);
            self.state.blocks[block].slip = place.unwrap_or(self.state.blocks[block].slip);
        }
        self.state.stopped[block] = stopped;
    }

    /// The block, and those on its node that do so at this instant, have come to their next stage of wear: they slide on,
    /// and the node decides about the others.
    fn wear(&mut self, block: usize, tau: R) {
        let node = self.model.goods[block].node;
        for j in self.on_node(node) {
            let (data, state) = (&self.model.goods[j], &mut self.state.blocks[j]);
            let Some(&Stage { path, mu_s, mu_k }) = data.stages.get(state.stage + 1) else { continue };
            let slides = matches!(state.contact, Contact::Sliding(_));
            let comes = slides && path - state.path <= R::of(ROUNDING) * R::epsilon() * path;
            if j == block || comes {
                state.stage += 1;
                (state.path, state.mu_s, state.mu_k) = (path, mu_s, mu_k);
                let (sign, stage) = (state.velocity_sign(), state.stage);
                self.note(tau, EventKind::Wear, j, sign, stage as u8);
            }
        }
        self.settle(node, tau, Cause::Wear(block));
    }

    /// What slides without friction has turned to this sign. If it has never moved, its release was in this direction.
    fn note_turn(&mut self, number: usize, tau: R, (sign, had_moved): (Sign, bool)) {
        let (time, sign) = ((self.start + tau).to_f64(), sign.as_i8());
        if had_moved {
            let event = Event { time, kind: EventKind::Reverse, number, sign, element: 0 };
            self.log.push(GeneralEvent { event, velocity: 0.0 });
            return;
        }
        let mut events = self.log.iter_mut().rev().map(|entry| &mut entry.event);
        if let Some(release) = events.find(|event| event.number == number && event.kind == EventKind::Slip) {
            release.sign = sign;
        }
    }

    /// Sets the relative velocity to exactly zero: of `block`, and of all on its node that arrive at this instant. Those
    /// without friction turn. Whether another is among them, so that the node has to decide.
    fn arrive_together(&mut self, block: usize, series: &Series<R>, tau: R) -> bool {
        let node = self.model.goods[block].node;
        let size = self.state.acceleration(self.model, node, &self.drive, tau, Terms::Sizes);
        let BlockState { velocity, mu_k, .. } = self.state.blocks[block];
        let on_stop = |state: &State<R>, j: usize| state.push(self.model, j) / self.model.goods[j].mass;
        let pushed = on_stop(self.state, block);
        let mut decides = false;
        for j in self.on_node(node) {
            let Contact::Sliding(sign) = self.state.blocks[j].contact else { continue };
            let own = on_stop(self.state, j);
            let limit = size + own.abs() + self.state.blocks[j].mu_k * self.model.gravity;
            let rounding = R::of(ROUNDING) * R::epsilon() * self.piece * limit;
            let approaching = sign.times(series.velocity[j].derivative().end()) <= R::zero();
            // In the loop, `block` itself may have come to rest already: its velocity and force are those of before.
            let moves_alike =
                self.state.blocks[j].mu_k == mu_k && self.state.blocks[j].velocity == velocity && own == pushed;
            let state = &mut self.state.blocks[j];
            if !(j == block || state.moved && (moves_alike || approaching && state.velocity.abs() <= rounding)) {
                continue;
            }
            if state.slides_freely() {
                let turned = state.turn_back();
                self.note_turn(j + 1, tau, turned);
            } else {
                state.velocity = R::zero();
                state.moved = true;
                decides = true;
            }
        }
        decides
    }

    /// All blocks leave the ground and the nodes, or come back.
    fn change_contact(&mut self, tau: R) {
        *self.airborne = !*self.airborne;
        let kind = if *self.airborne { EventKind::Lift } else { EventKind::Land };
        for j in 0..self.state.blocks.len() {
            let block = &mut self.state.blocks[j];
            block.contact = contact_after(kind, block.velocity);
            let sign = block.velocity_sign();
            self.note(tau, kind, j, sign, 0);
        }
        self.change_contact_of_base(kind, tau);
        if kind == EventKind::Land {
            self.settle_all(tau);
        }
    }
}
