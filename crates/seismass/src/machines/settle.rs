//! The decision of a floor at an instant, which of its blocks stick and which slide (`numerics`, section 2), and what
//! becomes of them.
//!
//! The mass matrix is diagonal, so a floor's acceleration depends on the rest of the building only through drifts and
//! velocities, which are continuous: each floor decides alone.

use crate::machines::block::{BlockLaw, BlockMotion, BlockState};
use crate::machines::sign::Sign;
use crate::response::EventKind;
use crate::tolerances::DECISION_ROUNDING;
use crate::units::STANDARD_GRAVITY;

/// What a floor asks of the blocks on it.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Demand {
    /// A floor of the building: the force of springs and damping on it, the sum of its terms' sizes, its mass.
    Floor { force: f64, size: f64, mass: f64 },
    /// The ground, whose acceleration the blocks do not change.
    Ground { acceleration: f64 },
}

impl Demand {
    /// Floor acceleration, and the size of its terms, with this stuck mass and friction force.
    fn acceleration(&self, stuck_mass: f64, friction: f64, friction_size: f64) -> (f64, f64) {
        match *self {
            Self::Floor { force, size, mass } => {
                ((force + friction) / (mass + stuck_mass), (size + friction_size) / (mass + stuck_mass))
            }
            Self::Ground { acceleration } => (acceleration, acceleration.abs()),
        }
    }
}

/// A block's change of state: what the log says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Transition {
    pub(crate) block: usize,
    pub(crate) kind: EventKind,
    pub(crate) sign: i8,
}

/// Why a floor decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SettleCause {
    /// This stuck block has reached its limit, with this sign of the floor acceleration.
    Breakaway(usize, Sign),
    /// What the floor stands on has reached its limit: blocks that have broken away at this instant go on.
    Together,
    /// Something else: a block has arrived or landed, or the run starts.
    Other,
}

/// Decides which of a floor's blocks with zero relative velocity stick, with contact force `contact` (g + a_v) per
/// unit mass: all are taken as stuck, then those whose limit is exceeded are released until none is.
///
/// A release never lowers the floor acceleration nor turns its sign, so the order does not matter, and the result is
/// the consistent state with the fewest sliding blocks.
///
/// Blocks that have broken away at this very instant go on sliding when another follows them. That happens where contact
/// force and floor acceleration are both zero: every limit is then reached at once, and their rates, which the guards
/// see, release one block after the other.
pub(crate) fn settle(
    demand: Demand,
    laws: &[BlockLaw],
    motions: &mut [BlockMotion],
    blocks: &[usize],
    contact: f64,
    cause: SettleCause,
    log: &mut Vec<Transition>,
) {
    let first_logged = log.len();
    let follows = cause != SettleCause::Other;
    for &j in blocks {
        if motions[j].velocity == 0.0 && (motions[j].is_stuck() || !follows) {
            // The sign field holds the state before until the decision is made.
            let before = match motions[j].state {
                BlockState::Sliding(sign) => sign.as_i8(),
                _ => 0,
            };
            motions[j].end_stretch();
            log.push(Transition { block: j, kind: EventKind::Slip, sign: before });
            motions[j].state = BlockState::Stuck;
        }
    }
    let mut breakaway = cause;
    loop {
        let (mut stuck_mass, mut friction, mut friction_size) = (0.0, 0.0, 0.0);
        for &j in blocks {
            match motions[j].state {
                BlockState::Stuck => stuck_mass += laws[j].mass,
                BlockState::Sliding(sign) => {
                    let force = motions[j].mu_k * laws[j].mass * contact;
                    friction += sign.factor() * force;
                    friction_size += force;
                }
                BlockState::Airborne => {}
            }
        }
        let (acceleration, size) = demand.acceleration(stuck_mass, friction, friction_size);
        let direction = match cause {
            // Without friction a block breaks away where the acceleration is zero still.
            SettleCause::Breakaway(_, sign) if acceleration.abs() <= DECISION_ROUNDING * size => sign.opposite(),
            _ => Sign::of(acceleration).opposite(),
        };
        let mut released = false;
        for &j in blocks {
            if !motions[j].is_stuck() {
                continue;
            }
            let limit = motions[j].mu_s * contact;
            // Near N = 0 the limit carries the rounding of mu g.
            let rounding = DECISION_ROUNDING * (size + limit.max(motions[j].mu_s * STANDARD_GRAVITY));
            let exceeds = match breakaway {
                // Equal blocks break away together; near N = 0 every limit is within rounding of every other.
                SettleCause::Breakaway(fired, _) => motions[j].mu_s == motions[fired].mu_s,
                SettleCause::Together | SettleCause::Other => acceleration.abs() > limit + rounding,
            };
            if exceeds {
                motions[j].state = BlockState::Sliding(direction);
                released = true;
            }
        }
        if !released {
            break;
        }
        breakaway = SettleCause::Other;
    }
    let mut kept = first_logged;
    for entry in first_logged..log.len() {
        let Transition { block, sign: before, .. } = log[entry];
        let outcome = match (before, motions[block].sliding().map(Sign::as_i8)) {
            (0, None) => None,
            (0, Some(now)) => Some((EventKind::Slip, now)),
            (before, None) => Some((EventKind::Stick, before)),
            (before, Some(now)) if now == before => Some((EventKind::Touch, now)),
            (_, Some(now)) => Some((EventKind::Reverse, now)),
        };
        if let Some((kind, sign)) = outcome {
            log[kept] = Transition { block, kind, sign };
            kept += 1;
        }
    }
    log.truncate(kept);
}

#[cfg(test)]
mod tests {
    use super::*;

    const G: f64 = 9.80665;

    fn laws(spec: &[(f64, f64, f64)]) -> Vec<BlockLaw> {
        spec.iter().map(|&(mass, mu_s, mu_k)| BlockLaw { floor: 1, mass, mu_s, mu_k, wear: Vec::new() }).collect()
    }

    fn decide(force: f64, mass: f64, laws: &[BlockLaw], velocity: &[f64]) -> Vec<BlockMotion> {
        let mut motions: Vec<_> = laws.iter().zip(velocity).map(|(law, &v)| BlockMotion::new(law, v)).collect();
        let blocks: Vec<usize> = (0..laws.len()).collect();
        let demand = Demand::Floor { force, size: force.abs(), mass };
        settle(demand, laws, &mut motions, &blocks, G, SettleCause::Other, &mut Vec::new());
        motions
    }

    /// A single block sticks iff |Q| <= mu_s g (m + m_b).
    #[test]
    fn single_block_sticks_within_its_limit() {
        let laws = laws(&[(2.0, 0.3, 0.2)]);
        let limit = 0.3 * G * 5.0;
        assert!(decide(0.999 * limit, 3.0, &laws, &[0.0])[0].is_stuck());
        assert_eq!(decide(1.001 * limit, 3.0, &laws, &[0.0])[0].sliding(), Some(Sign::Negative));
        assert_eq!(decide(-1.001 * limit, 3.0, &laws, &[0.0])[0].sliding(), Some(Sign::Positive));
    }

    /// Against enumeration of all stick/slip states of three blocks with mu_s = mu_k, where the state is unique.
    #[test]
    fn the_decision_is_the_consistent_state_found_by_enumeration() {
        let laws = laws(&[(1.0, 0.1, 0.1), (2.0, 0.25, 0.25), (1.5, 0.4, 0.4)]);
        for step in -400..=400 {
            let force = f64::from(step) * 0.1 + 0.013;
            let found = decide(force, 3.0, &laws, &[0.0; 3]);
            let mut consistent = Vec::new();
            for state in 0u8..8 {
                let stuck = |j: usize| state & (1 << j) != 0;
                for sign in [1.0, -1.0] {
                    let stuck_mass: f64 = (0..3).filter(|&j| stuck(j)).map(|j| laws[j].mass).sum();
                    let slipping: f64 =
                        (0..3).filter(|&j| !stuck(j)).map(|j| sign * laws[j].mu_k * laws[j].mass * G).sum();
                    let a = (force + slipping) / (3.0 + stuck_mass);
                    let holds = (0..3).all(|j| {
                        let limit = laws[j].mu_s * G;
                        if stuck(j) { a.abs() <= limit } else { -a * sign > limit }
                    });
                    if holds {
                        consistent.push(state);
                    }
                }
            }
            consistent.dedup();
            let state = (0..3).filter(|&j| found[j].is_stuck()).fold(0u8, |s, j| s | (1 << j));
            assert_eq!(consistent, vec![state], "force {force}");
        }
    }

    #[test]
    fn equal_blocks_break_away_together() {
        let laws = laws(&[(1.0, 0.3, 0.3), (2.0, 0.3, 0.3)]);
        let mut motions: Vec<_> = laws.iter().map(|law| BlockMotion::new(law, 0.0)).collect();
        let force = 0.3 * G * 6.0;
        let demand = Demand::Floor { force, size: force, mass: 3.0 };
        let mut log = Vec::new();
        settle(demand, &laws, &mut motions, &[0, 1], G, SettleCause::Breakaway(1, Sign::Positive), &mut log);
        assert!(motions.iter().all(|m| m.sliding() == Some(Sign::Negative)));
        assert_eq!(log.len(), 2);
    }
}
