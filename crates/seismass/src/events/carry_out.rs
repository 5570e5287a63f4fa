//! What an event does to the state.

use crate::lanes::{Vector, by_width, for_each_path};
use crate::machines::block::{BlockMotion, BlockState};
use crate::machines::guard::{Guard, Outcome};
use crate::machines::segment::Crossing;
use crate::machines::settle::{SettleCause, settle};
use crate::machines::sign::Sign;
use crate::response::{Event, EventKind};
use crate::state::State;
use crate::tolerances::{ARRIVED, FALL_ROUNDING};
use crate::units::STANDARD_GRAVITY;

/// The entry of the log for an event of a storey, counted from 0.
fn of_storey(crossing: Crossing, storey: usize, time: f64) -> Event {
    let Crossing { kind, sign, element } = crossing;
    Event { time, kind, number: storey + 1, sign, element }
}

for_each_path! {
    /// [`carry_out_in_lanes`] for what is not compiled for a path.
    pub(crate) fn carry_out[K: usize](state: &mut State, guard: Guard, tau: f64, log: &mut Vec<Event>) -> Outcome
        = carry_out_in_lanes
}

/// Carries out an event at `tau`, to which the state has been advanced, accelerations included where blocks decide.
/// What happened is appended to `log`; accelerations are those before it.
#[inline(always)]
pub(crate) fn carry_out_in_lanes<V: Vector, const K: usize>(
    state: &mut State,
    guard: Guard,
    tau: f64,
    log: &mut Vec<Event>,
) -> Outcome {
    let time = state.interval.start + tau;
    match guard {
        Guard::Collapse { storey } => return Outcome::Collapse(storey),
        Guard::SegmentEnd { storey, sign } => {
            let x = state.kinematics.x.take_lane::<V, K>(storey);
            let crossing = state.springs.machines[storey].end(x, sign);
            log.push(of_storey(crossing, storey, time));
        }
        Guard::Turn { storey } => {
            let x = state.kinematics.x.take_lane::<V, K>(storey);
            let crossing = state.springs.machines[storey].turn(x);
            state.kinematics.v.set_lane::<V, K>(storey, 0.0);
            log.push(of_storey(crossing, storey, time));
        }
        Guard::Breakaway { floor, sign } => break_away::<K>(state, floor, sign, tau, log),
        Guard::Arrival { block } => {
            arrive_with::<K>(state, block, tau);
            settle_floor::<K>(state, state.model.blocks[block].floor, tau, SettleCause::Other, log);
        }
        Guard::Wear { block } => {
            let floor = state.model.blocks[block].floor;
            wear_with(state, block, time, log);
            settle_floor::<K>(state, floor, tau, SettleCause::Other, log);
        }
        Guard::Contact => change_contact(state, tau, log),
    }
    match guard {
        Guard::SegmentEnd { storey, .. } | Guard::Turn { storey } => state.enter_regime_of_spring::<V, K>(storey),
        Guard::Breakaway { floor, .. } => state.enter_regime_of_blocks::<V, K>(floor),
        Guard::Arrival { block } | Guard::Wear { block } => {
            state.enter_regime_of_blocks::<V, K>(state.model.blocks[block].floor);
        }
        Guard::Contact | Guard::Collapse { .. } => state.enter_regime(),
    }
    Outcome::Continue
}

/// Has the weakest block stuck to a floor break away, and lets the floor decide.
fn break_away<const K: usize>(state: &mut State, floor: usize, sign: Sign, tau: f64, log: &mut Vec<Event>) {
    let weakest = state.model.on_floor[floor]
        .iter()
        .copied()
        .filter(|&j| state.blocks.motions[j].is_stuck())
        .min_by(|&i, &j| state.blocks.motions[i].mu_s.total_cmp(&state.blocks.motions[j].mu_s));
    if let Some(weakest) = weakest {
        settle_floor::<K>(state, floor, tau, SettleCause::Breakaway(weakest, sign), log);
    }
}

/// Brings a block to rest, and those on its floor that arrive at the same instant: within rounding, or because they
/// have moved as it does.
fn arrive_with<const K: usize>(state: &mut State, block: usize, tau: f64) {
    let arriving = state.blocks.motions[block];
    let (floor, mu_k) = (state.model.blocks[block].floor, arriving.mu_k);
    let contact = state.contact_at(tau);
    let a = if floor > 0 { state.kinematics.a.numbers::<K>()[floor - 1] } else { state.interval.ground_at(tau) };
    for position in 0..state.model.on_floor[floor].len() {
        let j = state.model.on_floor[floor][position];
        let BlockMotion { state: motion, velocity, mu_k: friction, .. } = state.blocks.motions[j];
        let BlockState::Sliding(sign) = motion else { continue };
        let alike = velocity == arriving.velocity && motion == arriving.state && friction == mu_k;
        let slowing = sign.factor() * a + friction * contact;
        let size = a.abs() + friction * contact.max(STANDARD_GRAVITY);
        let arrives = slowing >= -ARRIVED * size && velocity.abs() <= ARRIVED * size * state.interval.h;
        if j == block || alike || velocity != 0.0 && arrives {
            state.blocks.motions[j].velocity = 0.0;
        }
    }
}

/// Changes the friction coefficients of a block, and of those on its floor that come to a change at the same instant,
/// within rounding.
fn wear_with(state: &mut State, block: usize, time: f64, log: &mut Vec<Event>) {
    let model = state.model;
    for &j in &model.on_floor[model.blocks[block].floor] {
        let motion = &mut state.blocks.motions[j];
        if j == block || motion.sliding().is_some() && motion.path_to_wear() <= FALL_ROUNDING * motion.path() {
            let (sign, element) = (motion.velocity_sign(), motion.wear(&model.blocks[j]));
            log.push(Event { time, kind: EventKind::Wear, number: j + 1, sign, element });
        }
    }
}

fn settle_floor<const K: usize>(state: &mut State, floor: usize, tau: f64, cause: SettleCause, log: &mut Vec<Event>) {
    let (demand, contact, model) = (state.demand::<K>(floor, tau), state.contact_at(tau), state.model);
    let transitions = &mut state.blocks.transitions;
    transitions.clear();
    settle(demand, &model.blocks, &mut state.blocks.motions, &model.on_floor[floor], contact, cause, transitions);
    let time = state.interval.start + tau;
    log.extend(transitions.iter().map(|t| Event { time, kind: t.kind, number: t.block + 1, sign: t.sign, element: 0 }));
}

/// All blocks leave or regain contact.
fn change_contact(state: &mut State, tau: f64, log: &mut Vec<Event>) {
    let time = state.interval.start + tau;
    let kind = if state.blocks.airborne { EventKind::Land } else { EventKind::Lift };
    for (j, motion) in state.blocks.motions.iter_mut().enumerate() {
        // An arrival that a lift forestalls, by rounding of time.
        if motion.sliding().is_some_and(|sign| sign.factor() * motion.velocity < 0.0) {
            motion.velocity = 0.0;
        }
        log.push(Event { time, kind, number: j + 1, sign: motion.velocity_sign(), element: 0 });
        if kind == EventKind::Lift { motion.lift() } else { motion.land() }
    }
    state.blocks.airborne = !state.blocks.airborne;
    if kind == EventKind::Land {
        // Contact has only just returned: the accelerations decide, with no friction yet.
        state.enter_regime();
        state.refresh_accelerations(tau);
        settle_all(state, tau, log);
    }
}

/// Lets every floor decide, at the start of a run or at a landing.
pub(crate) fn settle_all(state: &mut State, tau: f64, log: &mut Vec<Event>) {
    for floor in 0..state.model.on_floor.len() {
        if state.model.on_floor[floor].iter().any(|&j| state.blocks.motions[j].is_stuck()) {
            by_width!(state.model.width, K => settle_floor::<K>(state, floor, tau, SettleCause::Other, log));
        }
    }
}
