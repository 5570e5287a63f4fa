//! What an event in the plane does to the state.

use crate::general::guards::Guard;
use crate::general::outcome::{Happening, Outcome};
use crate::general::plane::decide::{Cause, Choice};
use crate::general::plane::guards::PlaneGuard;
use crate::general::plane::response::{Axis, PlaneEvent};
use crate::general::plane::state::{PlaneState, SLIDING};
use crate::general::plane::vector::{angle, length};
use crate::general::response::GeneralEvent;
use crate::general::stops::{Contact, StopMotion, place_of};
use crate::machines::block::BlockState;
use crate::machines::sign::Sign;
use crate::response::{Event, EventKind};
use crate::tolerances::FALL_ROUNDING;

/// Both directions, in order.
const AXES: [Axis; 2] = [Axis::X, Axis::Y];

/// An event that the state has been advanced to.
pub(super) struct PlaneHappening<'a, 'b> {
    pub(super) state: &'b mut PlaneState<'a>,
    pub(super) tau: f64,
    pub(super) log: &'b mut Vec<PlaneEvent>,
    /// Energy that stops of each direction have dissipated where they parted (J).
    pub(super) lost_at_stops: &'b mut [f64; 2],
}

impl PlaneHappening<'_, '_> {
    /// Carries out the event of a guard.
    pub(super) fn carry_out(&mut self, guard: PlaneGuard) -> Outcome {
        let outcome = match guard {
            PlaneGuard::Collapse { node } => return Outcome::Collapse(node),
            PlaneGuard::Breakaway { block } => {
                self.decide(self.state.system().blocks[block].floor, Cause::Breakaway(block), &[])
            }
            PlaneGuard::Wear { block } => self.wear_with(block),
            PlaneGuard::Along { guard: Guard::Contact, .. } => self.change_contact(),
            PlaneGuard::Along { axis, guard: Guard::Touch { block, side } } => self.touch(axis, block, side),
            PlaneGuard::Along { axis, guard } => {
                let mut log = Vec::new();
                let (state, lost_at_stops) = (&mut self.state.axes[axis], &mut self.lost_at_stops[axis]);
                let outcome = Happening { state, tau: self.tau, log: &mut log, lost_at_stops }.carry_out(guard);
                let of_axis = |event| PlaneEvent { event, axis: Some(AXES[axis]), angle: f64::NAN };
                self.log.extend(log.into_iter().map(of_axis));
                outcome
            }
        };
        self.state.follow();
        outcome
    }

    fn time(&self) -> f64 {
        self.state.axes[0].interval.start + self.tau
    }

    fn event(&self, block: usize, kind: EventKind, sign: i8, element: u8, velocity: f64) -> GeneralEvent {
        GeneralEvent { event: Event { time: self.time(), kind, number: block + 1, sign, element }, velocity }
    }

    /// Logs an event of a vector.
    fn note(&mut self, block: usize, kind: EventKind, angle: f64, element: u8) {
        let event = self.event(block, kind, 0, element, length(self.state.velocity(block)));
        self.log.push(PlaneEvent { event, axis: None, angle });
    }

    /// Lets a node decide at which blocks have started that are at rest still: they go on together, each in the direction of
    /// this instant.
    pub(super) fn renew_starts(&mut self, node: usize) -> Outcome {
        let outcome = self.decide(node, Cause::Young, &[]);
        self.state.follow();
        outcome
    }

    /// Lets a node decide; `arrived` are blocks that slid until now.
    fn decide(&mut self, node: usize, cause: Cause, arrived: &[usize]) -> Outcome {
        let Some(choices) = self.state.decide(node, self.tau, cause) else { return Outcome::Undecided(node) };
        for (block, choice) in choices {
            let had_started = self.state.slides[block].start.is_some();
            let (kind, angle) = match (had_started || arrived.contains(&block), choice) {
                (false, Choice::Sticks) => continue,
                (false, Choice::Starts(direction)) => {
                    self.state.start(block, direction);
                    (EventKind::Slip, angle(direction))
                }
                (true, Choice::Sticks) => {
                    self.state.set(block, BlockState::Stuck);
                    (EventKind::Stick, f64::NAN)
                }
                (true, Choice::Starts(direction)) => {
                    self.state.start(block, direction);
                    if had_started {
                        continue;
                    }
                    (EventKind::Reverse, angle(direction))
                }
            };
            self.note(block, kind, angle, 0);
        }
        Outcome::Continue
    }

    /// Blocks of a node have come to rest.
    pub(super) fn arrive(&mut self, node: usize, blocks: &[usize]) -> Outcome {
        blocks.iter().for_each(|&j| self.state.bring_to_rest(j));
        let outcome = self.decide(node, Cause::Other, blocks);
        self.state.follow();
        outcome
    }

    /// A block that has broken away grazes its limit: it sticks again.
    pub(super) fn graze(&mut self, block: usize) {
        self.state.set(block, BlockState::Stuck);
        self.note(block, EventKind::Stick, f64::NAN, 0);
        self.state.follow();
    }

    /// Changes the friction coefficients of a block, and of those on its node that come to a change at the same instant,
    /// within rounding.
    fn wear_with(&mut self, block: usize) -> Outcome {
        let system = self.state.system();
        let node = system.blocks[block].floor;
        for &j in &system.on_node[node] {
            let slide = &self.state.slides[j];
            if j == block || self.state.slides(j) && slide.path_to_wear() <= FALL_ROUNDING * slide.path {
                let element = self.state.wear(j);
                self.note(j, EventKind::Wear, self.state.heading(j), element);
            }
        }
        self.decide(node, Cause::Other, &[])
    }

    /// All blocks leave or regain contact with their nodes.
    fn change_contact(&mut self) -> Outcome {
        let lands = self.state.axes[0].airborne;
        for j in 0..self.state.slides.len() {
            let slides = self.state.velocity(j) != [0.0; 2] || self.state.is_frictionless(j);
            let on_node = if slides { SLIDING } else { BlockState::Stuck };
            self.state.set(j, if lands { on_node } else { BlockState::Airborne });
            self.note(j, if lands { EventKind::Land } else { EventKind::Lift }, self.state.heading(j), 0);
        }
        self.state.axes.iter_mut().for_each(|axis| axis.airborne = !lands);
        if !lands {
            return Outcome::Continue;
        }
        self.state.follow();
        self.decide_all()
    }

    /// Lets every node decide, at the start of a run or at a landing.
    pub(super) fn decide_all(&mut self) -> Outcome {
        for node in 0..self.state.system().on_node.len() {
            let outcome = self.decide(node, Cause::Other, &[]);
            if outcome != Outcome::Continue {
                return outcome;
            }
        }
        Outcome::Continue
    }

    /// A block comes to a stop of a direction. Where the stop has a damper the force jumps, and the node decides again.
    fn touch(&mut self, a: usize, block: usize, side: Sign) -> Outcome {
        let Some(stops) = self.state.axes[a].system.stops[block] else { return Outcome::Continue };
        let axis = &mut self.state.axes[a];
        axis.motions[block].slip = place_of(&stops, side);
        axis.stops[block] = StopMotion { contact: Contact::Touching(side), beyond: 0.0 };
        let velocity = axis.motions[block].velocity;
        let event = self.event(block, EventKind::TouchStop, side.as_i8(), 0, velocity);
        self.log.push(PlaneEvent { event, axis: Some(AXES[a]), angle: f64::NAN });
        if stops.damping > 0.0 && velocity != 0.0 && !self.state.axes[a].airborne {
            self.state.follow();
            return self.decide(self.state.system().blocks[block].floor, Cause::Other, &[]);
        }
        Outcome::Continue
    }
}
