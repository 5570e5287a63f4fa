//! Which blocks of a node stick (`numerics`, section 9.7).

use crate::general::plane::huber::{Carried, acceleration};
use crate::general::plane::state::PlaneState;
use crate::general::plane::vector::{Vector2, length, minus, plus, times, unit};
use crate::machines::block::BlockState;
use crate::tolerances::{AT_STOPS_ROUNDING, DECISION_ROUNDING};
use crate::units::STANDARD_GRAVITY;

/// Most blocks of a node of which all states are tried.
const MOST_ENUMERATED: usize = 20;

/// A block with zero relative velocity.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    block: usize,
    mass: f64,
    drive: Vector2,
    /// mu_s N and mu_k N (m/s2).
    sticks_to: f64,
    slides_from: f64,
    /// What the limit of a near-zero contact force carries rounding of (m/s2).
    least_size: f64,
    is_released: bool,
}

/// A node at an instant, and the blocks that decide.
struct Decision {
    /// Force on the node of springs, dampers, and blocks that move (N), the size of its terms, and the node's mass.
    force: Vector2,
    size: f64,
    mass: f64,
    /// Acceleration of the ground, where the node is the ground.
    ground: Option<Vector2>,
    candidates: Vec<Candidate>,
}

impl Decision {
    fn goods(&self) -> f64 {
        self.candidates.iter().map(|candidate| candidate.mass).sum()
    }

    /// Acceleration of the node in the present state of the candidates. Without stops it is parallel to the force, whatever
    /// the state: it is never found by iteration.
    fn acceleration(&self) -> Vector2 {
        if let Some(ground) = self.ground {
            return ground;
        }
        if self.candidates.iter().any(|candidate| candidate.drive != [0.0; 2]) {
            let carried = self.candidates.iter().map(|candidate| Carried {
                mass: candidate.mass,
                drive: candidate.drive,
                limit: if candidate.is_released { candidate.slides_from } else { f64::INFINITY },
            });
            let carried: Vec<Carried> = carried.collect();
            let of_stops = carried.iter().fold([0.0; 2], |sum, block| plus(sum, times(block.mass, block.drive)));
            return acceleration(self.mass, minus(self.force, of_stops), &carried);
        }
        let (mut mass, mut friction) = (self.mass, 0.0);
        for candidate in &self.candidates {
            if candidate.is_released {
                friction += candidate.mass * candidate.slides_from;
            } else {
                mass += candidate.mass;
            }
        }
        unit(self.force).map_or([0.0; 2], |direction| times((length(self.force) - friction) / mass, direction))
    }

    fn tolerance(&self, candidate: &Candidate, a: Vector2) -> f64 {
        let goods = self.goods();
        let heavier = if self.ground.is_some() { 1.0 } else { (self.mass + goods) / self.mass };
        let of_force = if self.ground.is_some() { 0.0 } else { self.size / (self.mass + goods) };
        let size = candidate.sticks_to.max(candidate.least_size) + length(a) + length(candidate.drive);
        (AT_STOPS_ROUNDING * size * heavier).max(DECISION_ROUNDING * of_force * heavier)
    }

    /// The stuck candidates that exceed their limits: all of them without stops, the worst alone with them.
    fn to_release(&self, a: Vector2) -> Vec<usize> {
        let excess = |c: &Candidate| length(minus(a, c.drive)) - c.sticks_to;
        let exceeds = |i: &usize| {
            let candidate = &self.candidates[*i];
            !candidate.is_released && excess(candidate) > self.tolerance(candidate, a)
        };
        let all = (0..self.candidates.len()).filter(exceeds);
        if self.candidates.iter().all(|candidate| candidate.drive == [0.0; 2]) {
            return all.collect();
        }
        all.max_by(|&i, &j| excess(&self.candidates[i]).total_cmp(&excess(&self.candidates[j]))).into_iter().collect()
    }

    /// The released candidate that is driven the least, if by less than its friction.
    fn to_stick(&self, a: Vector2) -> Option<usize> {
        let lack = |c: &Candidate| c.slides_from - length(minus(a, c.drive));
        let lacks = |i: &usize| {
            let candidate = &self.candidates[*i];
            candidate.is_released && lack(candidate) > self.tolerance(candidate, a)
        };
        let lacking = (0..self.candidates.len()).filter(lacks);
        lacking.max_by(|&i, &j| lack(&self.candidates[i]).total_cmp(&lack(&self.candidates[j])))
    }

    /// Releases and, where stops press, sticks until all is consistent. False: there is no consistent state.
    fn choose(&mut self) -> bool {
        let has_drive = self.candidates.iter().any(|candidate| candidate.drive != [0.0; 2]);
        for _ in 0..8 + 4 * self.candidates.len() {
            let a = self.acceleration();
            let to_release = self.to_release(a);
            if !to_release.is_empty() {
                to_release.into_iter().for_each(|i| self.candidates[i].is_released = true);
            } else if has_drive && let Some(i) = self.to_stick(a) {
                self.candidates[i].is_released = false;
            } else {
                return true;
            }
        }
        self.enumerate()
    }

    /// Takes the consistent state of fewest sliding blocks.
    fn enumerate(&mut self) -> bool {
        let count = self.candidates.len();
        if count > MOST_ENUMERATED {
            return false;
        }
        let mut sets: Vec<u32> = (0..1 << count).collect();
        sets.sort_by_key(|set| set.count_ones());
        sets.into_iter().any(|released| {
            for (i, candidate) in self.candidates.iter_mut().enumerate() {
                candidate.is_released = released >> i & 1 == 1;
            }
            let a = self.acceleration();
            self.to_release(a).is_empty() && self.to_stick(a).is_none()
        })
    }
}

/// Why a node decides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Cause {
    /// This stuck block has reached its limit.
    Breakaway(usize),
    /// Blocks that have started have not moved yet, as far as is seen: they go on.
    Young,
    /// Something else: a force may have jumped at the instant at which they started, and all decide anew.
    Other,
}

/// What becomes of a block with zero relative velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Choice {
    Sticks,
    Starts(Vector2),
}

impl PlaneState<'_> {
    /// Decides which of a node's blocks with zero relative velocity stick. None: no consistent state.
    pub(super) fn decide(&self, node: usize, tau: f64, cause: Cause) -> Option<Vec<(usize, Choice)>> {
        let mut decision = self.decision(node, tau, cause);
        if decision.candidates.is_empty() {
            return Some(Vec::new());
        }
        if !decision.choose() {
            return None;
        }
        let a = decision.acceleration();
        let choices = decision.candidates.iter().map(|candidate| {
            let choice = match unit(minus(a, candidate.drive)) {
                Some(against) if candidate.is_released => Choice::Starts(times(-1.0, against)),
                _ => Choice::Sticks,
            };
            (candidate.block, choice)
        });
        Some(choices.collect())
    }

    fn decision(&self, node: usize, tau: f64, cause: Cause) -> Decision {
        let contact = self.axes[0].contact_at(tau);
        let is_candidate = |j: usize| {
            self.velocity(j) == [0.0; 2]
                && self.axes[0].motions[j].state != BlockState::Airborne
                && !self.is_frictionless(j)
        };
        let on_node = &self.system().on_node[node];
        let fires = |j: usize| match cause {
            Cause::Breakaway(fired) => {
                let is_free = |j: usize| self.drive(j) == [0.0; 2];
                // Blocks that have broken away at this instant go on sliding.
                !self.is_stuck(j)
                    || j == fired
                    || is_free(j) && is_free(fired) && self.friction(j).0 == self.friction(fired).0
            }
            Cause::Young => self.slides[j].is_young,
            Cause::Other => false,
        };
        let candidates = on_node.iter().copied().filter(|&j| is_candidate(j)).map(|j| Candidate {
            block: j,
            mass: self.system().blocks[j].mass,
            drive: self.drive(j),
            sticks_to: self.friction(j).0 * contact,
            slides_from: self.friction(j).1 * contact,
            least_size: self.friction(j).0 * STANDARD_GRAVITY,
            is_released: fires(j),
        });
        let candidates = candidates.collect();
        let (mut force, mut size) = self.node_force(node);
        for &j in on_node.iter().filter(|&&j| !is_candidate(j)) {
            let of_block = self.force_on_node(j, tau);
            force = plus(force, of_block);
            size += length(of_block);
        }
        let ground = (node == 0).then(|| self.axes.each_ref().map(|axis| axis.interval.ground_at(tau)));
        Decision { force, size, mass: self.system().mass[node], ground, candidates }
    }
}
