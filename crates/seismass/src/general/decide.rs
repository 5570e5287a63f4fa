//! The decision of a node whose blocks press on their stops (`numerics`, section 9.3). Where none of those that decide does,
//! the decision is that of [`settle`](crate::machines::settle::settle).

use std::borrow::Cow;

use crate::general::state::GeneralState;
use crate::machines::block::BlockState;
use crate::machines::settle::{SettleCause, Transition, settle};
use crate::machines::sign::Sign;
use crate::response::{Event, EventKind};
use crate::tolerances::AT_STOPS_ROUNDING;
use crate::units::STANDARD_GRAVITY;

/// Most blocks of a node of which all states are tried.
const MOST_ENUMERATED: usize = 20;

/// A block with zero relative velocity.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    block: usize,
    mass: f64,
    /// Acceleration that its stop gives it (m/s2).
    drive: f64,
    /// mu_s N and mu_k N (m/s2).
    sticks_to: f64,
    slides_from: f64,
    /// Whether it has just reached its limit, and with which sign of the node's acceleration less the drive.
    fired: Option<Sign>,
}

/// A node at an instant, and the blocks that decide.
#[derive(Debug, Clone)]
struct Decision {
    /// Force on the node of springs, dampers, and blocks that move (N), and the node's mass; the ground has none.
    force: f64,
    mass: f64,
    /// Acceleration of the ground, where the node is the ground.
    ground: Option<f64>,
    candidates: Vec<Candidate>,
    /// What the limits of a near-zero contact force carry rounding of (m/s2).
    least_size: f64,
}

/// What a candidate does: sticks, or slides against this sign of the node's acceleration less its drive.
type Choice = Option<Sign>;

impl Decision {
    /// Acceleration of the node when the candidates do this.
    fn acceleration(&self, choices: &[Choice]) -> f64 {
        if let Some(ground) = self.ground {
            return ground;
        }
        let (mut force, mut mass) = (self.force, self.mass);
        for (candidate, choice) in self.candidates.iter().zip(choices) {
            match choice {
                None => mass += candidate.mass,
                Some(sign) => {
                    force -= candidate.mass * (sign.factor() * candidate.slides_from + candidate.drive);
                }
            }
        }
        force / mass
    }

    /// What a limit and an acceleration are known to.
    fn tolerance(&self, candidate: &Candidate, a: f64) -> f64 {
        let goods: f64 = self.candidates.iter().map(|candidate| candidate.mass).sum();
        let heavier = if self.ground.is_some() { 1.0 } else { (self.mass + goods) / self.mass };
        AT_STOPS_ROUNDING * (candidate.sticks_to.max(self.least_size) + a.abs() + candidate.drive.abs()) * heavier
    }

    /// The stuck candidate that exceeds its limit the most.
    fn to_release(&self, choices: &[Choice], a: f64) -> Option<(usize, Sign)> {
        let excess = |i: usize| (a - self.candidates[i].drive).abs() - self.candidates[i].sticks_to;
        let exceeds = |&i: &usize| choices[i].is_none() && excess(i) > self.tolerance(&self.candidates[i], a);
        let worst = (0..choices.len()).filter(exceeds).max_by(|&i, &j| excess(i).total_cmp(&excess(j)))?;
        Some((worst, Sign::of(a - self.candidates[worst].drive)))
    }

    /// The sliding candidate that is driven the least, if by less than its friction.
    fn to_stick(&self, choices: &[Choice], a: f64) -> Option<usize> {
        let lack =
            |i: usize, sign: Sign| self.candidates[i].slides_from - sign.factor() * (a - self.candidates[i].drive);
        let lacking = choices.iter().enumerate().filter_map(|(i, choice)| {
            let lack = lack(i, (*choice)?);
            (lack > self.tolerance(&self.candidates[i], a)).then_some((i, lack))
        });
        lacking.max_by(|one, other| one.1.total_cmp(&other.1)).map(|(i, _)| i)
    }

    /// What the candidates do: from those that were stuck before, release after release, and stick again what is released
    /// for nothing; where that does not end, the consistent state of fewest sliding blocks. None: there is none.
    fn choose(&self) -> Option<Vec<Choice>> {
        let mut choices: Vec<Choice> = self.candidates.iter().map(|candidate| candidate.fired).collect();
        for _ in 0..8 + 4 * choices.len() {
            let a = self.acceleration(&choices);
            if let Some((i, sign)) = self.to_release(&choices, a) {
                choices[i] = Some(sign);
            } else if let Some(i) = self.to_stick(&choices, a) {
                choices[i] = None;
            } else {
                return Some(choices);
            }
        }
        self.enumerate()
    }

    /// What the candidates come to from these choices where the acceleration moves away in this direction: each sticks up to
    /// mu_s N, and slides until it is driven by less than mu_k N. No change turns the acceleration back, so there are two of
    /// each candidate at most.
    fn go_on(&self, mut choices: Vec<Choice>, direction: Sign) -> Vec<Choice> {
        let away = direction.factor();
        loop {
            let a = self.acceleration(&choices);
            let passed = self.candidates.iter().zip(&choices).enumerate().filter_map(|(i, (candidate, choice))| {
                let limit = match choice {
                    None => away * candidate.drive + candidate.sticks_to,
                    Some(sign) if *sign != direction => away * candidate.drive - candidate.slides_from,
                    Some(_) => return None,
                };
                (away * a > limit + self.tolerance(candidate, a)).then_some((i, limit))
            });
            let Some((first, _)) = passed.min_by(|one, other| one.1.total_cmp(&other.1)) else { return choices };
            choices[first] = if choices[first].is_none() { Some(direction) } else { None };
        }
    }

    fn enumerate(&self) -> Option<Vec<Choice>> {
        let count = self.candidates.len();
        if count > MOST_ENUMERATED {
            return None;
        }
        let mut sets: Vec<u32> = (0..1 << count).collect();
        sets.sort_by_key(|set| set.count_ones());
        sets.into_iter().find_map(|sliding| self.consistent(sliding))
    }

    /// The consistent state in which just these blocks slide. The force that moves the node falls with its acceleration, so
    /// from one drive to the next there is at most one.
    fn consistent(&self, sliding: u32) -> Option<Vec<Choice>> {
        let mut released: Vec<usize> = (0..self.candidates.len()).filter(|i| sliding >> i & 1 == 1).collect();
        released.sort_by(|&i, &j| self.candidates[i].drive.total_cmp(&self.candidates[j].drive));
        (0..=released.len()).find_map(|above| {
            // The acceleration is above the drives of the first so many.
            let mut choices = vec![None; self.candidates.len()];
            for (position, &i) in released.iter().enumerate() {
                choices[i] = Some(if position < above { Sign::Positive } else { Sign::Negative });
            }
            let a = self.acceleration(&choices);
            let holds = self.to_release(&choices, a).is_none() && self.to_stick(&choices, a).is_none();
            holds.then_some(choices)
        })
    }
}

impl GeneralState<'_> {
    /// Lets a node decide which of its blocks with zero relative velocity stick. `fired` are those that have just reached
    /// their limits, by the sign of what drives them back. False where there is no consistent state.
    pub(super) fn decide(&mut self, node: usize, tau: f64, cause: SettleCause, log: &mut Vec<Event>) -> bool {
        if node == 0 && self.base_decides(cause) {
            return self.decide_base(tau, cause, None, log);
        }
        self.decide_goods(node, tau, cause, log)
    }

    /// The goods of a node that take part in its decision.
    pub(super) fn deciding(&self, node: usize, cause: SettleCause) -> Vec<usize> {
        let follows = cause != SettleCause::Other;
        self.system.on_node[node].iter().copied().filter(|&j| self.motions[j].decides(follows)).collect()
    }

    /// Lets the goods of a node decide.
    pub(super) fn decide_goods(&mut self, node: usize, tau: f64, cause: SettleCause, log: &mut Vec<Event>) -> bool {
        let blocks = self.deciding(node, cause);
        let mut transitions = Vec::new();
        let is_found = if blocks.iter().any(|&j| self.stop_force(j) != 0.0) {
            self.decide_at_stops(node, tau, cause, &blocks, &mut transitions)
        } else {
            let (demand, contact) = (self.demand(node, tau), self.contact_at(tau));
            let mut on_node = Cow::from(&self.system.on_node[node]);
            if on_node.iter().any(|&j| self.motions[j].slides_freely()) {
                on_node.to_mut().retain(|&j| !self.motions[j].slides_freely());
            }
            settle(demand, &self.system.blocks, &mut self.motions, &on_node, contact, cause, &mut transitions);
            true
        };
        self.log_transitions(tau, &transitions, log);
        is_found
    }

    /// Lets goods on the slab go on from what they `held` at the acceleration of the ground, as the slab moves away from it
    /// in this direction.
    pub(super) fn go_on(
        &mut self,
        tau: f64,
        blocks: &[usize],
        held: Vec<Option<Sign>>,
        direction: Sign,
        log: &mut Vec<Event>,
    ) {
        let driven = held.into_iter().map(|sign| sign.map(Sign::opposite)).collect();
        let choices = self.decision(0, tau, SettleCause::Other, blocks).go_on(driven, direction);
        let mut transitions = Vec::new();
        self.set(blocks, choices, &mut transitions);
        self.log_transitions(tau, &transitions, log);
    }

    fn log_transitions(&self, tau: f64, transitions: &[Transition], log: &mut Vec<Event>) {
        let time = self.interval.start + tau;
        let event = |t: &Transition| Event { time, kind: t.kind, number: t.block + 1, sign: t.sign, element: 0 };
        log.extend(transitions.iter().map(event));
    }

    fn decide_at_stops(
        &mut self,
        node: usize,
        tau: f64,
        cause: SettleCause,
        blocks: &[usize],
        log: &mut Vec<Transition>,
    ) -> bool {
        let decision = self.decision(node, tau, cause, blocks);
        let Some(choices) = decision.choose() else { return false };
        self.set(blocks, choices, log);
        true
    }

    /// Sets what blocks do that have decided.
    fn set(&mut self, blocks: &[usize], choices: Vec<Choice>, log: &mut Vec<Transition>) {
        for (&j, choice) in blocks.iter().zip(choices) {
            let before = self.motions[j].sliding().map(Sign::as_i8);
            self.motions[j].end_stretch();
            let now = choice.map(Sign::opposite);
            self.motions[j].state = now.map_or(BlockState::Stuck, BlockState::Sliding);
            let (kind, sign) = match (before, now.map(Sign::as_i8)) {
                (None, None) => continue,
                (None, Some(now)) => (EventKind::Slip, now),
                (Some(before), None) => (EventKind::Stick, before),
                (Some(before), Some(now)) if now == before => (EventKind::Touch, now),
                (Some(_), Some(now)) => (EventKind::Reverse, now),
            };
            log.push(Transition { block: j, kind, sign });
        }
    }

    fn decision(&self, node: usize, tau: f64, cause: SettleCause, blocks: &[usize]) -> Decision {
        let contact = self.contact_at(tau);
        let fired = |j: usize| match cause {
            SettleCause::Breakaway(fired, sign) => {
                let alike = self.stop_force(fired) == 0.0
                    && self.stop_force(j) == 0.0
                    && self.motions[j].mu_s == self.motions[fired].mu_s;
                (j == fired || alike).then_some(sign)
            }
            SettleCause::Together | SettleCause::Other => None,
        };
        let candidates = blocks.iter().map(|&j| Candidate {
            block: j,
            mass: self.system.blocks[j].mass,
            drive: self.stop_force(j) / self.system.blocks[j].mass,
            sticks_to: self.motions[j].mu_s * contact,
            slides_from: self.motions[j].mu_k * contact,
            fired: fired(j),
        });
        let candidates: Vec<Candidate> = candidates.collect();
        let others = self.system.on_node[node].iter().filter(|j| candidates.iter().all(|c| c.block != **j));
        let of_others =
            others.map(|&j| self.friction_coefficient(j) * self.system.blocks[j].mass * contact - self.stop_force(j));
        let weakest = candidates.iter().map(|c| self.motions[c.block].mu_s).fold(f64::INFINITY, f64::min);
        let of_base = if node == 0 { self.base_forces(tau).0 } else { 0.0 };
        Decision {
            force: self.node_forces().force[node] + of_others.sum::<f64>() + of_base,
            mass: self.system.mass[node],
            ground: (node == 0 && !self.base_moves()).then(|| self.interval.ground_at(tau)),
            least_size: weakest * STANDARD_GRAVITY,
            candidates,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn candidate(mass: f64, drive: f64, limit: f64) -> Candidate {
        Candidate { block: 0, mass, drive, sticks_to: limit, slides_from: limit, fired: None }
    }

    /// m = 1, mu N = 1, Q = 0, m_1 = 0.1 with C_1/m_1 = -1.2, m_2 = 10 with C_2/m_2 = 1.15: block 1 is released first, and
    /// only block 2 slides in the end, with A = -1.5/1.1.
    #[test]
    fn a_release_may_stick_another_block_again() {
        let decision = Decision {
            force: 0.0,
            mass: 1.0,
            ground: None,
            candidates: vec![candidate(0.1, -1.2, 1.0), candidate(10.0, 1.15, 1.0)],
            least_size: 0.0,
        };
        let choices = decision.choose().unwrap();
        assert_eq!(choices, [None, Some(Sign::Negative)]);
        assert!((decision.acceleration(&choices) + 1.5 / 1.1).abs() < 1e-14);
        assert_eq!(decision.enumerate().unwrap(), choices);
    }

    /// A block of 10 with mu_s N = 8 and mu_k N = 2 slides where A = 10, and would stick on a slab of 1 under a force of 40,
    /// with A = 3.6. From A = 10 on it slides: A = 20. Away in the other direction it sticks, and slides again.
    #[test]
    fn what_slides_at_the_acceleration_of_the_ground_goes_on() {
        let block = Candidate { sticks_to: 8.0, ..candidate(10.0, 0.0, 2.0) };
        let of = |force: f64| Decision { force, mass: 1.0, ground: None, candidates: vec![block], least_size: 0.0 };
        let slides = vec![Some(Sign::Positive)];
        assert_eq!(of(40.0).choose().unwrap(), [None]);
        assert_eq!(of(40.0).go_on(slides.clone(), Sign::Positive), slides);
        assert_eq!(of(40.0).acceleration(&slides), 20.0);
        assert_eq!(of(11.0).go_on(slides.clone(), Sign::Negative), [None]);
        assert_eq!(of(-110.0).go_on(slides, Sign::Negative), [Some(Sign::Negative)]);
    }

    /// With mu_s = mu_k the state is unique: releases and the enumeration of all states agree.
    #[test]
    fn the_decision_is_the_state_found_by_enumeration() {
        for step in -60..=60 {
            let force = 0.37 * f64::from(step);
            let candidates = vec![
                candidate(0.3, -2.0, 1.0),
                candidate(4.0, 1.5, 2.0),
                candidate(1.0, 0.0, 1.5),
                candidate(2.0, -0.4, 0.7),
            ];
            let decision = Decision { force, mass: 1.0, ground: None, candidates, least_size: 0.0 };
            assert_eq!(decision.choose(), decision.enumerate(), "force {force}");
        }
    }
}
