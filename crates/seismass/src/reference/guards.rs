//! The guards of all state machines as numbers, and how a stepping method carries out their events.

use super::method::Events;
use crate::lanes::by_width;
use crate::machines::guard::{Guard, Outcome};
use crate::machines::sign::Sign;
use crate::response::Event;
use crate::state::State;

/// Value of a guard `tau` after the last sample: it has fallen when this is negative.
pub(super) fn value(state: &State, guard: Guard, tau: f64) -> f64 {
    match guard {
        Guard::SegmentEnd { storey, sign } => {
            let (lower, upper) = state.springs.segment_ends[storey];
            let bound = if sign == Sign::Positive { upper } else { lower };
            sign.factor() * (bound - state.kinematics.x[storey])
        }
        Guard::Collapse { storey } => {
            let (lower, upper) = state.springs.collapse_bounds[storey];
            (upper - state.kinematics.x[storey]).min(state.kinematics.x[storey] - lower)
        }
        Guard::Turn { storey } => state.springs.machines[storey]
            .rate_sign()
            .map_or(f64::INFINITY, |sign| sign.factor() * state.kinematics.v[storey]),
        Guard::Breakaway { floor, sign } => {
            let acceleration = if floor > 0 { state.kinematics.a[floor - 1] } else { state.interval.ground_at(tau) };
            state.blocks.stuck_mu[floor] * state.contact_at(tau) - sign.factor() * acceleration
        }
        Guard::Arrival { block } => {
            let motion = &state.blocks.motions[block];
            motion.sliding().map_or(f64::INFINITY, |sign| sign.factor() * motion.velocity)
        }
        Guard::Wear { block } => {
            let motion = &state.blocks.motions[block];
            if motion.sliding().is_some() { motion.path_to_wear() } else { f64::INFINITY }
        }
        Guard::Contact => {
            let sign = if state.blocks.airborne { -1.0 } else { 1.0 };
            sign * state.interval.contact_at(tau)
        }
    }
}

/// The first guard, in the order in which one instant is worked off, that has fallen; `known` is passed over.
pub(super) fn fallen(state: &State, tau: f64, known: Option<Guard>) -> Option<Guard> {
    let fell = |guard: &Guard| value(state, *guard, tau) < 0.0 && known != Some(*guard);
    if state.vertical && fell(&Guard::Contact) {
        return Some(Guard::Contact);
    }
    let both = [Sign::Positive, Sign::Negative];
    let storeys = (0..state.storeys()).flat_map(|storey| {
        [
            Guard::Collapse { storey },
            Guard::SegmentEnd { storey, sign: Sign::Positive },
            Guard::SegmentEnd { storey, sign: Sign::Negative },
            Guard::Turn { storey },
        ]
    });
    if let Some(guard) = storeys.into_iter().find(fell) {
        return Some(guard);
    }
    if state.blocks.airborne {
        return None;
    }
    let floors = (0..state.blocks.stuck_mu.len()).filter(|&floor| state.blocks.stuck_mu[floor].is_finite());
    let breakaway = floors.flat_map(|floor| both.map(|sign| Guard::Breakaway { floor, sign })).find(fell);
    let of_blocks = (0..state.blocks.motions.len()).flat_map(|block| [Guard::Arrival { block }, Guard::Wear { block }]);
    breakaway.or_else(|| of_blocks.into_iter().find(fell))
}

/// Carries out an event at the present state. Blocks of one floor that have arrived are decided together.
///
/// At the end of a step a velocity that has turned is kept: made zero, as it is where its turn was located, it would
/// take momentum from the building.
pub(super) fn carry_out(state: &mut State, guard: Guard, tau: f64, events: Events, log: &mut Vec<Event>) -> Outcome {
    if let Guard::Arrival { block } = guard {
        let floor = state.model.blocks[block].floor;
        for &j in &state.model.on_floor[floor] {
            if value(state, Guard::Arrival { block: j }, tau) <= 0.0 {
                state.blocks.motions[j].velocity = 0.0;
            }
        }
    }
    let overshoot = match (guard, events) {
        (Guard::Turn { storey }, Events::AtStepEnds) => Some((storey, state.kinematics.v[storey])),
        _ => None,
    };
    let outcome = by_width!(state.model.width, K => crate::events::carry_out::carry_out::<K>(state, guard, tau, log));
    if let Some((storey, rate)) = overshoot {
        state.kinematics.v[storey] = rate;
    }
    if outcome == Outcome::Continue {
        state.refresh_accelerations(tau);
    }
    outcome
}
