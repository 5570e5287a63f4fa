//! What follows from a guard that has fallen, in the plane.

use seismass::{Event, EventKind, GeneralEvent, PlaneEvent};

use super::record::PlaneRecorder;
use super::series::PlaneSeries;
use super::state::Plane;
use crate::general::decide::Cause;
use crate::general::guards::{Guard, ROUNDING};
use crate::model::Stage;
use crate::real::Real;
use crate::sign::Sign;
use crate::state::Contact;

impl<R: Real> Plane<R> {
    /// Carries out an event at `tau`, which the state has reached at the end of `series`. Collapse ends a run and is not
    /// for here.
    pub(super) fn carry_out(&mut self, (a, guard): (usize, Guard), series: &PlaneSeries<R>, tau: R) {
        let node = |plane: &Self, block: usize| plane.directions[0].model.goods[block].node;
        match guard {
            Guard::Collapse { .. } | Guard::Arrival { .. } | Guard::BaseBreakaway { .. } | Guard::BaseArrival => {}
            Guard::Contact => self.change_contact(tau),
            Guard::Breakaway { block, .. } => {
                self.settle(node(self, block), tau, Cause::Breakaway(block, Sign::Positive))
            }
            Guard::Wear { block } => self.wear(block, tau),
            Guard::Touch { block, side } => {
                if self.machines(a).touch(block, side, tau) && !self.airborne {
                    self.settle(node(self, block), tau, Cause::Jump);
                }
            }
            Guard::Spring { .. } | Guard::Leave { .. } | Guard::Within { .. } | Guard::Again { .. } => {
                self.machines(a).carry_out(guard, &series.directions[a], tau);
            }
        }
    }

    /// A block has come to rest on its node, and others with it.
    pub(super) fn arrive(&mut self, block: usize, tau: R, recorder: &mut PlaneRecorder<R>) {
        let arriving = self.arrive_with(block);
        if let Some(node) = self.directions[0].model.goods[block].node
            && let Some(acceleration) = self.at_stop(&arriving, tau)
        {
            recorder.at_stop(node, acceleration, self.start + tau);
        }
        for j in arriving {
            for direction in &mut self.directions {
                direction.state.blocks[j].velocity = R::zero();
                direction.state.blocks[j].moved = true;
            }
        }
        self.settle(self.directions[0].model.goods[block].node, tau, Cause::Arrival);
    }

    /// The block, and those on its node that do so at this instant, have come to their next stage of wear.
    fn wear(&mut self, block: usize, tau: R) {
        let node = self.directions[0].model.goods[block].node;
        for j in 0..self.heads.len() {
            let data = &self.directions[0].model.goods[j];
            let state = self.directions[0].state.blocks[j];
            let Some(&Stage { path, mu_s, mu_k }) = data.stages.get(state.stage + 1) else { continue };
            let slides = data.node == node && matches!(state.contact, Contact::Sliding(_));
            if j == block || slides && path - state.path <= R::of(ROUNDING) * R::epsilon() * path {
                for direction in &mut self.directions {
                    let state = &mut direction.state.blocks[j];
                    state.stage += 1;
                    (state.path, state.mu_s, state.mu_k) = (path, mu_s, mu_k);
                }
                let velocity = self.velocity(j);
                self.note(tau, EventKind::Wear, j, velocity, (state.stage + 1) as u8);
            }
        }
        self.settle(node, tau, Cause::Wear(block));
    }

    /// All blocks leave the ground and the nodes, or come back.
    fn change_contact(&mut self, tau: R) {
        self.airborne = !self.airborne;
        self.place_blocks();
        for j in 0..self.heads.len() {
            let kind = if self.airborne { EventKind::Lift } else { EventKind::Land };
            let velocity = self.velocity(j);
            self.note(tau, kind, j, velocity, 0);
        }
        if !self.airborne {
            self.settle_all(tau);
        }
    }

    /// Blocks are in the air, rest or slide as the contact and their relative velocities say.
    pub(super) fn place_blocks(&mut self) {
        for j in 0..self.heads.len() {
            let contact = match self.airborne {
                true => Contact::Airborne,
                false if self.is_still(j) => Contact::Stuck,
                false => Contact::Sliding(Sign::Positive),
            };
            self.set_contact(j, contact);
            self.young[j] = false;
        }
    }

    /// Logs an event of a vector, whose length counts where an event has a velocity.
    pub(super) fn note(&mut self, tau: R, kind: EventKind, block: usize, [x, y]: [R; 2], element: u8) {
        let [x, y] = [x, y].map(R::to_f64);
        let has_velocity = matches!(kind, EventKind::Wear | EventKind::Lift | EventKind::Land);
        let velocity = if has_velocity { x.hypot(y) } else { 0.0 };
        let angle = if x == 0.0 && y == 0.0 { f64::NAN } else { y.atan2(x) };
        let time = (self.start + tau).to_f64();
        let event = Event { time, kind, number: block + 1, sign: 0, element };
        self.log.push(PlaneEvent { event: GeneralEvent { event, velocity }, axis: None, angle });
    }
}
