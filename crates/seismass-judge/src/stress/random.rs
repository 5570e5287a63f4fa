//! Random scenes by the million: every run checked by itself, some of them against the judge.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};

use rayon::prelude::*;
use seismass::{Error, EventCounts, EventKind, Motion, Options, Response, Scene, Status, simulate};

use super::consistency;
use super::family::Family;
use super::grazing::{explained_residual, judge};
use super::verdict::Verdict;
use crate::JudgeError;
use crate::random_scene::Draw;

/// Largest energy residual that rounding explains.
pub const LARGEST_RESIDUAL: f64 = 1e-11;
/// The judge is not asked where its series would need more pieces than this.
const AFFORDABLE_PIECES: f64 = 3e5;
/// One scene in so many has its energies balanced and is solved in other ways too: without them, and for peaks alone. A
/// judged one always is.
const ENERGIES: u64 = 10;

/// What one scene came to.
#[derive(Debug, Clone, Default)]
struct Found {
    seed: u64,
    family: Family,
    collapsed: bool,
    /// Why there is no response.
    failed: Option<String>,
    events: EventCounts,
    residual: Option<f64>,
    /// The residual beyond the limit that the contact force explains.
    explained_residual: Option<f64>,
    verdict: Option<Verdict>,
    defect: Option<String>,
}

fn examine(seed: u64, family: Family, judged: bool) -> Found {
    let mut draw = Draw(seed.wrapping_mul(31).wrapping_add(7));
    let mut found = Found { seed, family, ..Found::default() };
    let (scene, motion) = match family.scene(seed) {
        Ok(drawn) => drawn,
        Err(error) => return found.without_response(format!("the scene was refused: {error}"), true),
    };
    let energy = judged || draw.one_in(ENERGIES);
    let options = Options { histories: NonZeroUsize::new(1), events: true, energy, ..Options::default() };
    let response = match simulate(&scene, &motion, &options) {
        Ok(response) => response,
        Err(error) => {
            let solution = crate::solve::<crate::DoubleDouble>(&scene, &motion, 1);
            let alike = solution.as_ref().is_err_and(|other| fail_alike(&error, other));
            let judge = solution.map_or_else(|other| format!("fails: {other}"), |_| "solves it".into());
            return found.without_response(format!("error: {error}; the judge {judge}"), !alike);
        }
    };
    found.collapsed = response.status != Status::Completed;
    found.events = response.statistics.events;
    found.residual = response.energy.map(|e| e.relative_residual.abs());
    found.defect = consistency::check(&scene, &motion, &response).err();
    if energy && found.defect.is_none() {
        let others = consistency::check_others(&scene, &motion, &response);
        found.defect = others.and_then(|()| consistency::check_peaks_alone(&scene, &motion)).err();
    }
    if let Some(residual) = found.residual.filter(|r| *r > LARGEST_RESIDUAL || r.is_nan()) {
        found.explained_residual = explained_residual(&scene, &motion, &response);
        if found.explained_residual.is_none() {
            found.defect.get_or_insert(format!("energy residual {residual:e}"));
        }
    }
    if judged && affordable(&scene, &motion) {
        let verdict = judge(&scene, &motion, &response);
        if let Verdict::Unexplained(difference) = &verdict {
            found.defect.get_or_insert(format!("parts from the judge: {difference}"));
        }
        found.verdict = Some(verdict);
    }
    found
}

impl Found {
    /// A run that failed; whether that is a defect.
    fn without_response(self, reason: String, is_defect: bool) -> Self {
        Self { defect: is_defect.then(|| reason.clone()), failed: Some(reason), ..self }
    }
}

/// Whether kernel and judge cannot go on for the same reason.
fn fail_alike(kernel: &Error, judge: &JudgeError) -> bool {
    matches!(
        (kernel, judge),
        (Error::TooManyEvents { .. }, JudgeError::TooManyEvents { .. })
            | (Error::TooStiff { .. }, JudgeError::TooStiff { .. })
            | (Error::NotFinite { .. }, JudgeError::NotFinite { .. })
    )
}

fn affordable(scene: &Scene, motion: &Motion) -> bool {
    let shortest = scene.building().map_or(f64::INFINITY, |b| b.periods().into_iter().fold(f64::INFINITY, f64::min));
    let phase = std::f64::consts::TAU * motion.dt() / shortest;
    2.0 * phase * motion.acceleration().len() as f64 * (1.0 + scene.storeys() as f64) < AFFORDABLE_PIECES
}

/// The distribution of a random run.
#[derive(Debug, Clone, Default)]
pub struct Tally {
    /// Seed of the first scene.
    pub first: u64,
    /// Scenes run, of one seed after the other.
    pub scenes: u64,
    /// Of them, of each family.
    pub families: [u64; Family::ALL.len()],
    /// Of them, ended by collapse.
    pub collapsed: u64,
    /// Of them, failed: seed, reason. Where the judge does not fail for the same reason it is a defect too.
    pub failed: Vec<(u64, String)>,
    /// Of them, compared with the judge.
    pub judged: u64,
    /// Of them, with energies.
    pub balanced: u64,
    /// Largest energy residual of each family, and its seed.
    pub worst_residual: [(f64, u64); Family::ALL.len()],
    /// Largest difference of each family to the judge where the events agree, and its seed.
    pub worst_difference: [(f64, u64); Family::ALL.len()],
    /// Largest difference of event times, relative to the duration, and its seed.
    pub worst_time: [(f64, u64); Family::ALL.len()],
    /// How many runs had so many events.
    pub events: BTreeMap<u64, u64>,
    /// Events by kind.
    pub kinds: [u64; EventKind::ALL.len()],
    /// Grazings, explained: seed, change in last digits, difference.
    pub grazing: Vec<(u64, f64, String)>,
    /// Sensitive scenes, explained: seed, change in last digits, difference.
    pub sensitive: Vec<(u64, f64, String)>,
    /// Logs that differ by pairs of events at grazes alone, each shown to be one: seed, change in last digits,
    /// difference.
    pub pairs: Vec<(u64, f64, String)>,
    /// Energy residuals beyond the limit, explained: seed, the residual that the last digits of g and a_v explain, the
    /// residual found.
    pub cancelled: Vec<(u64, f64, f64)>,
    /// Defects: seed, what is wrong.
    pub defects: Vec<(u64, String)>,
}

impl Tally {
    /// An empty tally of scenes from this seed on.
    pub fn from_seed(first: u64) -> Self {
        Self { first, ..Self::default() }
    }

    /// Runs more scenes in parallel, of which this share is compared with the judge.
    pub fn run(&mut self, scenes: u64, judged: f64) {
        let next = self.first + self.scenes;
        let found: Vec<Found> = (next..next + scenes)
            .into_par_iter()
            .map(|seed| {
                let family = Family::of(seed);
                let judged = Draw(seed).between(0.0, 1.0) < judged * family.judged();
                let panicked = |_| Found { seed, family, ..Found::default() }.without_response("panic".into(), true);
                catch_unwind(AssertUnwindSafe(|| examine(seed, family, judged))).unwrap_or_else(panicked)
            })
            .collect();
        found.into_iter().for_each(|found| self.add(found));
    }

    fn add(&mut self, found: Found) {
        let family = found.family as usize;
        let raise = |worst: &mut (f64, u64), value: f64| {
            if value > worst.0 || value.is_nan() {
                *worst = (value, found.seed);
            }
        };
        self.scenes += 1;
        self.families[family] += 1;
        self.collapsed += u64::from(found.collapsed);
        self.balanced += u64::from(found.residual.is_some());
        self.judged += u64::from(found.verdict.is_some());
        raise(&mut self.worst_residual[family], found.residual.unwrap_or(0.0));
        match found.failed {
            Some(reason) => self.failed.push((found.seed, reason)),
            None => *self.events.entry(found.events.total() as u64).or_default() += 1,
        }
        for (sum, kind) in self.kinds.iter_mut().zip(EventKind::ALL) {
            *sum += found.events.of(kind) as u64;
        }
        match found.verdict {
            Some(Verdict::Agrees(comparison)) => {
                raise(&mut self.worst_difference[family], comparison.worst());
                raise(&mut self.worst_time[family], comparison.worst_time());
            }
            Some(Verdict::Grazing { digits, difference }) => self.grazing.push((found.seed, digits, difference)),
            Some(Verdict::Sensitive { digits, difference }) => self.sensitive.push((found.seed, digits, difference)),
            Some(Verdict::GrazingPairs { digits, difference }) => self.pairs.push((found.seed, digits, difference)),
            Some(Verdict::Unexplained(_) | Verdict::BeforeStops { .. } | Verdict::SlowTouches { .. }) | None => {}
        }
        if let (Some(explained), Some(residual)) = (found.explained_residual, found.residual) {
            self.cancelled.push((found.seed, explained, residual));
        }
        if let Some(defect) = found.defect {
            self.defects.push((found.seed, defect));
        }
    }

    /// Least, median and greatest number of events of a run.
    pub fn event_quantiles(&self) -> [u64; 3] {
        quantiles(&self.events)
    }
}

/// Least, median and greatest number of a distribution of runs by events.
pub(super) fn quantiles(events: &BTreeMap<u64, u64>) -> [u64; 3] {
    let all: u64 = events.values().sum();
    let mut below = 0;
    let median = events.iter().find(|(_, runs)| {
        below += **runs;
        2 * below >= all
    });
    let number = |entry: Option<(&u64, &u64)>| entry.map_or(0, |(events, _)| *events);
    [number(events.first_key_value()), number(median), number(events.last_key_value())]
}

/// The kernel's response with everything that can be checked.
///
/// # Errors
/// The kernel's error, or the first fault that the response shows by itself.
pub fn solve_checked(scene: &Scene, motion: &Motion) -> Result<Response, String> {
    let options = Options { histories: NonZeroUsize::new(1), events: true, energy: true, ..Options::default() };
    let response = simulate(scene, motion, &options).map_err(|e| e.to_string())?;
    consistency::check(scene, motion, &response)?;
    Ok(response)
}
