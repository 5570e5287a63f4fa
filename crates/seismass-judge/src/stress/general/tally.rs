//! The distribution of a random run of the general engine, in one direction or in two.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;
use seismass::{EventKind, GeneralScene, Motion, PlaneMotion, PlaneScene};

use super::chains::{Chains, compare_engines};
use super::examine::{Found, LARGEST_DIVISION, examine};
use crate::random_scene::Draw;
use crate::stress::verdict::Verdict;

/// One judged scene in so many is compared with the judge in double-double from the start.
const PRECISELY: u64 = 10;

/// In how many directions the scenes are drawn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Directions {
    /// Racks, walls and stops in one.
    #[default]
    One,
    /// Friction on the circle.
    Two,
}

/// The distribution of a random run.
#[derive(Debug, Clone, Default)]
pub struct GeneralTally {
    /// What is drawn.
    pub directions: Directions,
    /// Seed of the first scene.
    pub first: u64,
    /// Scenes run, of one seed after the other.
    pub scenes: u64,
    /// Of them, ended by collapse.
    pub collapsed: u64,
    /// Of them, compared with the judge.
    pub judged: u64,
    /// Of them, solved with divided intervals too, with the same events.
    pub divided: u64,
    /// Of them, solved as their images too, with as many events.
    pub turned: u64,
    /// Of them, beyond the limit there, and so by changes of the input in last digits.
    pub moved_by_themselves: u64,
    /// Largest energy residual, and its seed.
    pub worst_residual: (f64, u64),
    /// Largest change by a division of the intervals within the limit, and its seed.
    pub worst_division: (f64, u64),
    /// Largest difference to the image within the limit, and its seed.
    pub worst_turn: (f64, u64),
    /// Largest difference to the judge where the events agree, and its seed.
    pub worst_difference: (f64, u64),
    /// Largest difference of event times, relative to the duration, and its seed.
    pub worst_time: (f64, u64),
    /// How many runs had so many events.
    pub events: BTreeMap<u64, u64>,
    /// Events by kind.
    pub kinds: [u64; EventKind::ALL.len()],
    /// Grazings, explained: seed, change in last digits, difference.
    pub grazing: Vec<(u64, f64, String)>,
    /// Sensitive scenes, explained: seed, change in last digits, difference.
    pub sensitive: Vec<(u64, f64, String)>,
    /// Scenes that part in accelerations just before stops alone: seed, difference.
    pub before_stops: Vec<(u64, String)>,
    /// Scenes that part in touches of stops slower than rounding alone: seed, difference.
    pub slow_touches: Vec<(u64, String)>,
    /// Scenes whose judge takes too many series: seed, reason.
    pub not_followed: Vec<(u64, String)>,
    /// Failed runs: seed, reason. Where the judge does not fail for the same reason it is a defect too.
    pub failed: Vec<(u64, String)>,
    /// Defects: seed, what is wrong.
    pub defects: Vec<(u64, String)>,
    /// Random shear buildings by both engines.
    pub chains: Chains,
}

impl GeneralTally {
    /// An empty tally of scenes from this seed on.
    pub fn from_seed(directions: Directions, first: u64) -> Self {
        Self { directions, first, ..Self::default() }
    }

    /// Runs more scenes in parallel, of which this share is compared with the judge.
    pub fn run(&mut self, scenes: u64, judged: f64) {
        let examine = match self.directions {
            Directions::One => examine::<(GeneralScene, Motion)>,
            Directions::Two => examine::<(PlaneScene, PlaneMotion)>,
        };
        let next = self.first + self.scenes;
        let seeds: Vec<u64> = (next..next + scenes).collect();
        let found: Vec<Found> = seeds
            .into_par_iter()
            // A scene may take a thousand times as long as its neighbours: no thread holds others back behind it.
            .with_max_len(1)
            .map(|seed| {
                let is_judged = Draw(seed).between(0.0, 1.0) < judged;
                let precisely = Draw(seed ^ 0x6464).one_in(PRECISELY);
                let panicked = |_| Found { seed, ..Found::default() }.without_response("panic".into(), true);
                catch_unwind(AssertUnwindSafe(|| examine(seed, is_judged, precisely))).unwrap_or_else(panicked)
            })
            .collect();
        found.into_iter().for_each(|found| self.add(found));
    }

    /// Solves so many random shear buildings with both engines.
    pub fn run_chains(&mut self, scenes: u64) {
        self.chains = compare_engines(0..scenes);
    }

    fn add(&mut self, found: Found) {
        let raise = |worst: &mut (f64, u64), value: f64| {
            if value > worst.0 || value.is_nan() {
                *worst = (value, found.seed);
            }
        };
        self.scenes += 1;
        self.collapsed += u64::from(found.collapsed);
        self.judged += u64::from(found.verdict.is_some());
        self.divided += u64::from(found.division.is_some());
        self.turned += u64::from(found.turn.is_some());
        self.moved_by_themselves += u64::from(found.moves_by_itself);
        raise(&mut self.worst_turn, found.turn.filter(|&d| d <= LARGEST_DIVISION).unwrap_or(0.0));
        raise(&mut self.worst_residual, found.residual.unwrap_or(0.0));
        raise(&mut self.worst_division, found.division.filter(|&d| d <= LARGEST_DIVISION).unwrap_or(0.0));
        match found.failed {
            Some(reason) => self.failed.push((found.seed, reason)),
            None => *self.events.entry(found.events.total() as u64).or_default() += 1,
        }
        for (sum, kind) in self.kinds.iter_mut().zip(EventKind::ALL) {
            *sum += found.events.of(kind) as u64;
        }
        if let Some(reason) = found.not_followed {
            self.not_followed.push((found.seed, reason));
        }
        match found.verdict {
            Some(Verdict::Agrees(comparison)) => {
                raise(&mut self.worst_difference, comparison.worst());
                raise(&mut self.worst_time, comparison.worst_time());
            }
            Some(Verdict::BeforeStops { comparison, difference }) => {
                raise(&mut self.worst_difference, comparison.worst());
                raise(&mut self.worst_time, comparison.worst_time());
                self.before_stops.push((found.seed, difference));
            }
            Some(Verdict::SlowTouches { comparison, difference }) => {
                raise(&mut self.worst_difference, comparison.worst());
                raise(&mut self.worst_time, comparison.worst_time());
                self.slow_touches.push((found.seed, difference));
            }
            Some(Verdict::Grazing { digits, difference }) => self.grazing.push((found.seed, digits, difference)),
            Some(Verdict::Sensitive { digits, difference } | Verdict::GrazingPairs { digits, difference }) => {
                self.sensitive.push((found.seed, digits, difference));
            }
            Some(Verdict::Unexplained(_)) | None => {}
        }
        if let Some(defect) = found.defect {
            self.defects.push((found.seed, defect));
        }
    }

    /// Least, median and greatest number of events of a run.
    pub fn event_quantiles(&self) -> [u64; 3] {
        crate::stress::random::quantiles(&self.events)
    }
}
