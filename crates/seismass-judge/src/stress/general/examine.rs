//! One random scene of the general engine.

use std::num::NonZeroUsize;

use seismass::{Error, EventCounts, GeneralResponse, GeneralScene, GeneralStatus, Motion, Options, simulate_general};

use super::invariants;
use super::verdict::judge;
use crate::general::{compare_general, divided, solution_of, solve_general};
use crate::general_scene::general_scene;
use crate::random_scene::Draw;
use crate::stress::random::LARGEST_RESIDUAL;
use crate::stress::verdict::Verdict;
use crate::{DoubleDouble, JudgeError};

/// Largest change of numbers and times, relative as those to the judge are, by a division of the sample intervals; beyond,
/// the judge is asked.
pub const LARGEST_DIVISION: f64 = 1e-9;

/// One scene in so many is solved with every sample interval divided, and without energies and histories. A judged one
/// always is.
const OTHERWISE: u64 = 5;
/// Parts of a divided interval.
const PARTS: usize = 4;

/// What one scene came to.
#[derive(Debug, Clone, Default)]
pub(super) struct Found {
    pub(super) seed: u64,
    pub(super) collapsed: bool,
    /// Why there is no response.
    pub(super) failed: Option<String>,
    pub(super) events: EventCounts,
    pub(super) residual: Option<f64>,
    /// Largest difference that dividing every sample interval makes, where the events stay the same.
    pub(super) division: Option<f64>,
    pub(super) verdict: Option<Verdict>,
    pub(super) defect: Option<String>,
}

/// Solves the scene of a seed; a judged one is compared with the judge, in double-double from the start if `precisely`.
pub(super) fn examine(seed: u64, judged: bool, precisely: bool) -> Found {
    let mut found = Found { seed, ..Found::default() };
    let (scene, motion) = match general_scene(seed) {
        Ok(drawn) => drawn,
        Err(error) => return found.without_response(format!("the scene was refused: {error}"), true),
    };
    let options = Options { histories: NonZeroUsize::new(1), events: true, energy: true, ..Options::default() };
    let response = match simulate_general(&scene, &motion, &options) {
        Ok(response) => response,
        Err(error) => {
            let solution = solve_general::<DoubleDouble>(&scene, &motion, 1);
            let alike = solution.as_ref().is_err_and(|other| fail_alike(&error, other));
            let judge = solution.map_or_else(|other| format!("fails: {other}"), |_| "solves it".into());
            return found.without_response(format!("error: {error}; the judge {judge}"), !alike);
        }
    };
    found.collapsed = response.status != GeneralStatus::Completed;
    found.events = response.statistics.events;
    let residual = response.energy.map_or(f64::NAN, |energy| energy.relative_residual.abs());
    found.residual = Some(residual);
    found.defect = invariants::check(&scene, &motion, &response).err();
    if residual > LARGEST_RESIDUAL || residual.is_nan() {
        found.defect.get_or_insert(format!("energy residual {residual:e}"));
    }
    let mut asks_judge = judged;
    if judged || Draw(seed ^ 0x6469_7669).one_in(OTHERWISE) {
        if let Err(fault) = same_bits(&scene, &motion, &response) {
            found.defect.get_or_insert(fault);
        }
        found.division = division(&scene, &motion, &response);
        // A graze may fall either way: the judge says which of the two was right.
        asks_judge |= found.division.is_none_or(|difference| difference > LARGEST_DIVISION);
    }
    if asks_judge {
        let verdict = judge(&scene, &motion, &response, precisely);
        if let Verdict::Unexplained(difference) = &verdict {
            found.defect.get_or_insert(format!("parts from the judge: {difference}"));
        }
        found.verdict = Some(verdict);
    }
    found
}

impl Found {
    /// A run that failed; whether that is a defect.
    pub(super) fn without_response(self, reason: String, is_defect: bool) -> Self {
        Self { defect: is_defect.then(|| reason.clone()), failed: Some(reason), ..self }
    }
}

/// Whether engine and judge cannot go on for the same reason.
fn fail_alike(engine: &Error, judge: &JudgeError) -> bool {
    matches!(
        (engine, judge),
        (Error::TooManyEvents { .. }, JudgeError::TooManyEvents { .. })
            | (Error::TooStiff { .. }, JudgeError::TooStiff { .. })
            | (Error::NotFinite { .. }, JudgeError::NotFinite { .. })
    )
}

/// Whether peaks, residuals and paths have the same bits where nothing else is asked for.
fn same_bits(scene: &GeneralScene, motion: &Motion, response: &GeneralResponse) -> Result<(), String> {
    let other =
        simulate_general(scene, motion, &Options::default()).map_err(|error| format!("peaks alone: {error}"))?;
    let same = (&other.peaks, &other.residual_drift, &other.residual_slip, &other.slip_path, other.status)
        == (&response.peaks, &response.residual_drift, &response.residual_slip, &response.slip_path, response.status);
    if same { Ok(()) } else { Err("other bits without energies, events and histories".into()) }
}

/// How far the run is from one with every sample interval divided; nothing where the events differ.
fn division(scene: &GeneralScene, motion: &Motion, response: &GeneralResponse) -> Option<f64> {
    let motion = divided(motion, PARTS).ok()?;
    let options = Options { histories: NonZeroUsize::new(PARTS), events: true, energy: true, ..Options::default() };
    let other = simulate_general(scene, &motion, &options).ok()?;
    let comparison = compare_general(&other, &solution_of(response)?);
    comparison.mismatch.is_none().then(|| comparison.worst().max(comparison.worst_time()))
}
