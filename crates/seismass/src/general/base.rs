//! The sliding base: a slab at node 0 between the ground and all that the scene has (`numerics`, section 9.6).
//!
//! Its friction is one more Coulomb element at the slab, beside the goods that lie on it, and all of them decide at the same
//! instant. With A the acceleration of the slab, Q the force of springs and dampers on it, and equal coefficients, A is the
//! minimum of
//!
//! ```text
//! m A^2 / 2 - Q A + sum over goods of m_j (A^2 / 2 up to |A| = mu_j N, then straight) + mu W N/g |A - a_g|,
//! ```
//!
//! which is strictly convex: A is unique. The base sticks where A = a_g is the minimum, that is where the force that holds it
//! there is within its limit. The goods know A then: they decide as on the ground. Otherwise the base slides, its friction is
//! a load, and the goods decide as on a floor. The slab then moves as it was released: were A not on that side of a_g, the
//! forces of the goods, none of which falls with A, would hold the base at a_g. With mu_s > mu_k the same order is kept:
//! first the goods at A = a_g, then the base beside them.
//!
//! With mu_s > mu_k of goods the force of one falls where it is released. What slides at A = a_g and would stick beside the
//! released base may then draw A to the other side. There the goods go on from what they do at a_g while A moves away from it
//! as the base was released: each sticks up to mu_s N and slides until it is driven by less than mu_k N. The force that is
//! left falls with A but where goods are released, and there it rises. So A is found before it comes back to a_g.

use crate::general::state::GeneralState;
use crate::machines::block::{BlockMotion, BlockState};
use crate::machines::settle::SettleCause;
use crate::machines::sign::Sign;
use crate::response::{Event, EventKind};
use crate::tolerances::{AT_STOPS_ROUNDING, DECISION_ROUNDING};
use crate::units::STANDARD_GRAVITY;

impl GeneralState<'_> {
    /// Whether the slab has an acceleration of its own.
    pub(super) fn base_moves(&self) -> bool {
        self.base.is_some_and(|motion| !motion.is_stuck())
    }

    /// Restoring force and friction on the slab now, and their size (N).
    pub(super) fn base_forces(&self, tau: f64) -> (f64, f64) {
        let Some(base) = &self.system.base else { return (0.0, 0.0) };
        let contact = self.contact_at(tau);
        let restoring = -base.restoring * contact * self.x[0];
        let friction = -self.base_friction() * base.carried * contact;
        (restoring + friction, restoring.abs() + friction.abs())
    }

    /// mu_k of the base with the sign of its velocity; zero where it does not slide.
    pub(super) fn base_friction(&self) -> f64 {
        match &self.base {
            Some(BlockMotion { state: BlockState::Sliding(sign), mu_k, .. }) => sign.factor() * mu_k,
            _ => 0.0,
        }
    }

    /// Whether the base takes part in the next decision: it has no velocity and does not follow from another release.
    pub(super) fn base_decides(&self, cause: SettleCause) -> bool {
        self.base.is_some_and(|motion| motion.decides(cause != SettleCause::Other))
    }

    /// Force of the ground that holds the slab at the ground's acceleration, and the size of its terms (N).
    pub(super) fn holding_force(&self, tau: f64) -> (f64, f64) {
        let forces = self.node_forces();
        let (of_blocks, blocks_size) = self.block_forces(0, tau);
        let (of_base, base_size) = self.base_forces(tau);
        let mut mass = self.system.mass[0];
        for &j in &self.system.on_node[0] {
            if self.motions[j].is_stuck() {
                mass += self.system.blocks[j].mass;
            }
        }
        let inertia = mass * self.interval.ground_at(tau);
        let pushed = forces.force[0] + of_blocks + of_base;
        (inertia - pushed, inertia.abs() + forces.size[0] + blocks_size + base_size)
    }

    /// Lets slab and goods on it decide. `fired`: the base has just reached its limit, with this sign of the holding force.
    /// False where there is no consistent state.
    pub(super) fn decide_base(
        &mut self,
        tau: f64,
        cause: SettleCause,
        fired: Option<Sign>,
        log: &mut Vec<Event>,
    ) -> bool {
        let (Some(base), Some(before)) = (&self.system.base, self.base) else { return true };
        let saved: Vec<(usize, BlockMotion)> = self.system.on_node[0].iter().map(|&j| (j, self.motions[j])).collect();
        let restore = |state: &mut Self| saved.iter().for_each(|&(j, motion)| state.motions[j] = motion);
        let blocks = self.deciding(0, cause);
        let logged = log.len();
        let mut motion = before;
        motion.end_stretch();
        motion.state = BlockState::Stuck;
        self.base = Some(motion);
        let mut is_found = self.decide_goods(0, tau, cause, log);
        let (force, size) = self.holding_force(tau);
        let contact = self.contact_at(tau);
        let limit = motion.mu_s * base.carried * contact;
        let least = motion.mu_s * base.carried * STANDARD_GRAVITY;
        let exceeds = force.abs() > limit + DECISION_ROUNDING * (size + limit.max(least));
        if exceeds || fired.is_some() || !is_found {
            let away = fired.unwrap_or(Sign::of(force)).opposite();
            let held = blocks.iter().map(|&j| self.motions[j].sliding()).collect();
            motion.state = BlockState::Sliding(away);
            self.base = Some(motion);
            restore(self);
            log.truncate(logged);
            is_found = self.decide_goods(0, tau, cause, log);
            // Mass times what A falls short of the acceleration of the ground.
            let (short, size) = self.holding_force(tau);
            if away.factor() * short > AT_STOPS_ROUNDING * size {
                restore(self);
                log.truncate(logged);
                self.go_on(tau, &blocks, held, away, log);
            }
        }
        let (was, now) = (before.sliding().map(Sign::as_i8), motion.sliding().map(Sign::as_i8));
        let (kind, sign) = match (was, now) {
            (None, None) => return is_found,
            (None, Some(now)) => (EventKind::Slip, now),
            (Some(was), None) => (EventKind::Stick, was),
            (Some(was), Some(now)) if was == now => (EventKind::Touch, now),
            (Some(_), Some(now)) => (EventKind::Reverse, now),
        };
        let event = Event { time: self.interval.start + tau, kind, number: 0, sign, element: 0 };
        log.insert(logged, event);
        is_found
    }
}
