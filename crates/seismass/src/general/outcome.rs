//! What an event does to the state.

use crate::general::guards::Guard;
use crate::general::response::GeneralEvent;
use crate::general::state::GeneralState;
use crate::general::stops::{Contact, StopMotion, place_of};
use crate::machines::block::{BlockMotion, BlockState};
use crate::machines::segment::Crossing;
use crate::machines::settle::SettleCause;
use crate::machines::sign::Sign;
use crate::response::{Event, EventKind};
use crate::tolerances::{ARRIVED, FALL_ROUNDING};
use crate::units::STANDARD_GRAVITY;

/// What an event leads to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Outcome {
    /// The run goes on.
    Continue,
    /// The spring of a node has collapsed.
    Collapse(usize),
    /// A node has no consistent state.
    Undecided(usize),
}

/// An event that the state has been advanced to.
pub(super) struct Happening<'a, 'b> {
    pub(super) state: &'b mut GeneralState<'a>,
    pub(super) tau: f64,
    pub(super) log: &'b mut Vec<GeneralEvent>,
    /// Energy that stops have dissipated so far (J): what is left in one where it parts is lost.
    pub(super) lost_at_stops: &'b mut f64,
}

impl Happening<'_, '_> {
    /// Carries out the event of a guard.
    pub(super) fn carry_out(&mut self, guard: Guard) -> Outcome {
        let mut outcome = Outcome::Continue;
        match guard {
            Guard::Collapse { node } => return Outcome::Collapse(node),
            Guard::SegmentEnd { node, sign } => {
                let x = std::mem::take(&mut self.state.x[node]);
                let crossing = self.state.springs[node - 1].end(x, sign);
                self.note_spring(node, crossing);
            }
            Guard::Turn { node } => {
                let x = std::mem::take(&mut self.state.x[node]);
                self.state.v[node] = 0.0;
                let crossing = self.state.springs[node - 1].turn(x);
                self.note_spring(node, crossing);
            }
            Guard::Breakaway { node, sign } => {
                let state = &self.state;
                let blocks = state.system.on_node[node].iter().copied();
                let free = blocks.filter(|&j| state.motions[j].is_stuck() && state.stop_force(j) == 0.0);
                if let Some(weakest) = free.min_by(|&i, &j| state.motions[i].mu_s.total_cmp(&state.motions[j].mu_s)) {
                    outcome = self.decide(node, SettleCause::Breakaway(weakest, sign));
                }
            }
            Guard::BreakawayAtStop { block, sign } => {
                outcome = self.decide(self.state.system.blocks[block].floor, SettleCause::Breakaway(block, sign));
            }
            Guard::BaseBreakaway { sign } => outcome = self.release_base(sign),
            Guard::BaseArrival => outcome = self.base_arrives(),
            Guard::Arrival { block } => {
                if self.arrive_with(block) {
                    outcome = self.decide(self.state.system.blocks[block].floor, SettleCause::Other);
                }
            }
            Guard::Wear { block } => {
                self.wear_with(block);
                outcome = self.decide(self.state.system.blocks[block].floor, SettleCause::Other);
            }
            Guard::Contact => outcome = self.change_contact(),
            Guard::Touch { block, side } => outcome = self.touch(block, side),
            Guard::Leave { block } => self.leave(block),
            Guard::Clear { block } => self.set_free(block),
            Guard::TouchAgain { block } => self.touch_again(block),
        }
        self.state.follow();
        outcome
    }

    fn time(&self) -> f64 {
        self.state.interval.start + self.tau
    }

    fn note_spring(&mut self, node: usize, Crossing { kind, sign, element }: Crossing) {
        let event = Event { time: self.time(), kind, number: node, sign, element };
        self.log.push(GeneralEvent { event, velocity: 0.0 });
    }

    fn note_block(&mut self, block: usize, kind: EventKind, sign: i8, element: u8) {
        let event = Event { time: self.time(), kind, number: block + 1, sign, element };
        self.log.push(GeneralEvent { event, velocity: self.state.motions[block].velocity });
    }

    fn decide(&mut self, node: usize, cause: SettleCause) -> Outcome {
        let mut events = Vec::new();
        let is_found = self.state.decide(node, self.tau, cause, &mut events);
        self.note_decision(node, is_found, events)
    }

    fn note_decision(&mut self, node: usize, is_found: bool, events: Vec<Event>) -> Outcome {
        self.log.extend(events.into_iter().map(|event| GeneralEvent { event, velocity: 0.0 }));
        if is_found { Outcome::Continue } else { Outcome::Undecided(node) }
    }

    /// The base breaks away, with this sign of the force that held it.
    fn release_base(&mut self, sign: Sign) -> Outcome {
        let mut events = Vec::new();
        let is_found = self.state.decide_base(self.tau, SettleCause::Together, Some(sign), &mut events);
        self.note_decision(0, is_found, events)
    }

    /// Brings the base to rest.
    fn base_arrives(&mut self) -> Outcome {
        self.state.v[0] = 0.0;
        let Some(base) = &mut self.state.base else { return Outcome::Continue };
        if base.slides_freely() {
            let turned = base.turn();
            self.note_turn(0, turned);
            return Outcome::Continue;
        }
        base.velocity = 0.0;
        self.decide(0, SettleCause::Other)
    }

    /// Logs that what slides without friction has turned, to this sign. What has not moved yet broke away at this very
    /// instant: it did so with this sign, and has not slid the other way.
    fn note_turn(&mut self, number: usize, (sign, has_moved): (Sign, bool)) {
        let event = Event { time: self.time(), kind: EventKind::Reverse, number, sign: sign.as_i8(), element: 0 };
        if has_moved {
            self.log.push(GeneralEvent { event, velocity: 0.0 });
            return;
        }
        let slips = |entry: &&mut GeneralEvent| entry.event.number == number && entry.event.kind == EventKind::Slip;
        if let Some(entry) = self.log.iter_mut().rev().find(slips) {
            entry.event.sign = event.sign;
        }
    }

    /// Brings a block to rest, and those on its node that arrive at the same instant: within rounding, or because they have
    /// moved as it does. True if one of them has friction. The others turn, which changes no force.
    fn arrive_with(&mut self, block: usize) -> bool {
        let state = &mut *self.state;
        let (arriving, is_free) = (state.motions[block], state.stops[block].touching().is_none());
        let node = state.system.blocks[block].floor;
        let contact = state.contact_at(self.tau);
        let a = state.accelerations(self.tau)[node];
        let (mut turned, mut decides) = (Vec::new(), false);
        for &j in &state.system.on_node[node] {
            let BlockMotion { state: motion, velocity, mu_k: friction, .. } = state.motions[j];
            let BlockState::Sliding(sign) = motion else { continue };
            let drive = state.stop_force(j) / state.system.blocks[j].mass;
            let alike = is_free
                && state.stops[j].touching().is_none()
                && velocity == arriving.velocity
                && motion == arriving.state
                && friction == arriving.mu_k;
            let slowing = sign.factor() * (a - drive) + friction * contact;
            let size = a.abs() + drive.abs() + friction * contact.max(STANDARD_GRAVITY);
            let arrives = slowing >= -ARRIVED * size && velocity.abs() <= ARRIVED * size * state.interval.h;
            if !(j == block || alike || velocity != 0.0 && arrives) {
                continue;
            }
            if state.motions[j].slides_freely() {
                turned.push((j + 1, state.motions[j].turn()));
            } else {
                state.motions[j].velocity = 0.0;
                decides = true;
            }
        }
        turned.into_iter().for_each(|(number, turned)| self.note_turn(number, turned));
        decides
    }

    /// Changes the friction coefficients of a block, and of those on its node that come to a change at the same instant,
    /// within rounding.
    fn wear_with(&mut self, block: usize) {
        let system = self.state.system;
        for &j in &system.on_node[system.blocks[block].floor] {
            let motion = &mut self.state.motions[j];
            if j == block || motion.sliding().is_some() && motion.path_to_wear() <= FALL_ROUNDING * motion.path() {
                let (sign, element) = (motion.velocity_sign(), motion.wear(&system.blocks[j]));
                self.note_block(j, EventKind::Wear, sign, element);
            }
        }
    }

    /// All blocks leave or regain contact with their nodes.
    fn change_contact(&mut self) -> Outcome {
        let lands = self.state.airborne;
        for j in 0..self.state.motions.len() {
            let motion = &mut self.state.motions[j];
            // An arrival that a lift forestalls, by rounding of time.
            if motion.sliding().is_some_and(|sign| sign.factor() * motion.velocity < 0.0) {
                motion.velocity = 0.0;
            }
            motion.end_stretch();
            if lands {
                motion.land()
            } else {
                motion.lift()
            }
            let sign = motion.velocity_sign();
            self.note_block(j, if lands { EventKind::Land } else { EventKind::Lift }, sign, 0);
        }
        self.change_contact_of_base(lands);
        self.state.airborne = !lands;
        if !lands {
            return Outcome::Continue;
        }
        self.state.follow();
        self.decide_all()
    }

    fn change_contact_of_base(&mut self, lands: bool) {
        let Some(base) = &mut self.state.base else { return };
        if base.sliding().is_some_and(|sign| sign.factor() * base.velocity < 0.0) {
            (base.velocity, self.state.v[0]) = (0.0, 0.0);
        }
        base.end_stretch();
        if lands {
            base.land()
        } else {
            base.lift()
        }
        let (kind, sign) = (if lands { EventKind::Land } else { EventKind::Lift }, base.velocity_sign());
        let (event, velocity) = (Event { time: self.time(), kind, number: 0, sign, element: 0 }, self.state.v[0]);
        self.log.push(GeneralEvent { event, velocity });
    }

    /// Lets every node decide, at the start of a run or at a landing.
    pub(super) fn decide_all(&mut self) -> Outcome {
        for node in 0..self.state.system.on_node.len() {
            let base_decides = node == 0 && self.state.base_decides(SettleCause::Other);
            if base_decides || self.state.system.on_node[node].iter().any(|&j| self.state.motions[j].is_stuck()) {
                let outcome = self.decide(node, SettleCause::Other);
                if outcome != Outcome::Continue {
                    return outcome;
                }
            }
        }
        Outcome::Continue
    }

    /// A block comes to its stop. Where the stop has a damper the force jumps, and the node decides again.
    fn touch(&mut self, block: usize, side: Sign) -> Outcome {
        let Some(stops) = self.state.system.stops[block] else { return Outcome::Continue };
        self.state.motions[block].slip = place_of(&stops, side);
        self.state.stops[block] = StopMotion { contact: Contact::Touching(side), beyond: 0.0 };
        self.note_block(block, EventKind::TouchStop, side.as_i8(), 0);
        let jumps = stops.damping > 0.0 && self.state.motions[block].velocity != 0.0 && !self.state.airborne;
        if jumps {
            self.state.follow();
            let logged = self.log.len();
            let outcome = self.decide(self.state.system.blocks[block].floor, SettleCause::Other);
            // A block that broke away at this instant has not come back to rest: that it goes on is no event.
            let events = self.log.split_off(logged);
            self.log.extend(events.into_iter().filter(|entry| entry.event.kind != EventKind::Touch));
            return outcome;
        }
        Outcome::Continue
    }

    /// The force of a stop has vanished: the block is free, or parted where it is beyond its clearance still.
    fn leave(&mut self, block: usize) {
        let Some(side) = self.state.stops[block].touching() else { return };
        self.note_block(block, EventKind::LeaveStop, side.as_i8(), 0);
        let stops = self.state.system.stops[block];
        let is_damped = stops.is_some_and(|stops| stops.damping > 0.0);
        if is_damped && side.factor() * self.state.stops[block].beyond > 0.0 {
            *self.lost_at_stops += self.state.stops[block].stored(stops.as_ref());
            self.state.stops[block].contact = Contact::Parted(side);
        } else {
            self.free_at(block, side);
        }
    }

    fn set_free(&mut self, block: usize) {
        if let Contact::Parted(side) = self.state.stops[block].contact {
            self.free_at(block, side);
        }
    }

    fn free_at(&mut self, block: usize, side: Sign) {
        if let Some(stops) = &self.state.system.stops[block] {
            self.state.motions[block].slip = place_of(stops, side);
            self.state.stops[block] = StopMotion::free();
        }
    }

    fn touch_again(&mut self, block: usize) {
        if let Contact::Parted(side) = self.state.stops[block].contact {
            self.state.stops[block].contact = Contact::Touching(side);
            *self.lost_at_stops -= self.state.stops[block].stored(self.state.system.stops[block].as_ref());
            self.note_block(block, EventKind::TouchStop, side.as_i8(), 0);
        }
    }
}
