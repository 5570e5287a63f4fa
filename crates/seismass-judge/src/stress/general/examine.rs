//! One random scene of the general engine, in one direction or in two.

use std::num::NonZeroUsize;

use seismass::{Error, EventCounts, GeneralStatus, Options, Peak};

use super::before_stops::BeforeStops;
use super::subject::Subject;
use super::verdict::{MAX_SERIES, judge};
use crate::general::{Budget, Scale};
use crate::random_scene::Draw;
use crate::stress::grazing::AMPLIFICATION;
use crate::stress::random::LARGEST_RESIDUAL;
use crate::stress::verdict::{LAST_DIGITS, Verdict};
use crate::{Comparison, JudgeError, larger};

/// Largest change of numbers and times, relative as those to the judge are, by a division of the sample intervals; beyond,
/// changes of the input by some last digits must move the engine as far, or the judge is asked.
pub const LARGEST_DIVISION: f64 = 1e-9;

/// One scene in so many is solved with every sample interval divided, and without energies and histories. A judged one
/// always is.
const OTHERWISE: u64 = 5;
/// Parts of a divided interval.
const PARTS: usize = 4;
/// Different changes of each size.
const CHANGES: u64 = 4;

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
    /// Largest difference of peaks and paths to those of the scene's image, where the events are as many.
    pub(super) turn: Option<f64>,
    /// Beyond the limit in one of the two, and so by changes of the input in last digits.
    pub(super) moves_by_itself: bool,
    pub(super) verdict: Option<Verdict>,
    /// Why the judge could not follow.
    pub(super) not_followed: Option<String>,
    pub(super) defect: Option<String>,
}

/// Solves the scene of a seed; a judged one is compared with the judge, in double-double from the start if `precisely`.
pub(super) fn examine<S: Subject>(seed: u64, judged: bool, precisely: bool) -> Found {
    let mut found = Found { seed, ..Found::default() };
    let subject = match S::draw(seed) {
        Ok(drawn) => drawn,
        Err(error) => return found.without_response(format!("the scene was refused: {error}"), true),
    };
    let response = match subject.simulate(&options(1)) {
        Ok(response) => response,
        Err(error) => {
            // In doubles: where steps are short, double-double takes hours to say the same.
            let solution = subject.solve::<f64>(Scale::none(), &Budget::of(MAX_SERIES));
            let alike = solution.as_ref().is_err_and(|other| fail_alike(&error, other));
            let judge = solution.map_or_else(|other| format!("fails: {other}"), |_| "solves it".into());
            return found.without_response(format!("error: {error}; the judge {judge}"), !alike);
        }
    };
    let summary = S::summary(&response);
    found.collapsed = summary.status != GeneralStatus::Completed;
    found.events = summary.events;
    let residual = summary.residual;
    found.residual = Some(residual);
    found.defect = subject.check(&response).err();
    if residual > LARGEST_RESIDUAL || residual.is_nan() {
        found.defect.get_or_insert(format!("energy residual {residual:e}"));
    }
    let (mut asks_judge, mut beyond) = (judged, None);
    if judged || Draw(seed ^ 0x6469_7669).one_in(OTHERWISE) {
        if let Err(fault) = same_bits(&subject, &response) {
            found.defect.get_or_insert(fault);
        }
        let stops = subject.before_stops(&response);
        found.division = division(&subject, &response, &stops);
        found.turn = turn(&subject, &response, &stops);
        let largest =
            [found.division, found.turn].map(|apart| apart.unwrap_or(f64::INFINITY)).into_iter().fold(0.0, larger);
        if !judged && largest > LARGEST_DIVISION {
            found.moves_by_itself = changes_move_as_far(&subject, &response, largest);
            // A graze may fall either way: the judge says which of the two was right.
            asks_judge = !found.moves_by_itself;
            beyond = Some(largest);
        }
    }
    if asks_judge {
        match judge(&subject, &response, precisely) {
            Ok(verdict) => {
                if let Verdict::Unexplained(difference) = &verdict {
                    found.defect.get_or_insert(format!("parts from the judge: {difference}"));
                }
                found.verdict = Some(verdict);
            }
            Err(reason) => {
                let apart = beyond.map_or(String::new(), |apart| format!("; by division or image {apart:.1e} away"));
                found.not_followed = Some(format!("{reason}{apart}"));
            }
        }
    }
    found
}

fn options(every: usize) -> Options {
    Options { histories: NonZeroUsize::new(every), events: true, energy: true, ..Options::default() }
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
        (
            Error::TooManyEvents { .. },
            JudgeError::TooManyEvents { .. } | JudgeError::TooManySeries { .. } | JudgeError::TooDear { .. }
        ) | (Error::TooStiff { .. }, JudgeError::TooStiff { .. })
            | (Error::NotFinite { .. }, JudgeError::NotFinite { .. })
    )
}

/// Whether peaks, residuals and paths have the same bits where nothing else is asked for.
fn same_bits<S: Subject>(subject: &S, response: &S::Response) -> Result<(), String> {
    let other = subject.simulate(&Options::default()).map_err(|error| format!("peaks alone: {error}"))?;
    let same = S::same_bits(response, &other);
    if same { Ok(()) } else { Err("other bits without energies, events and histories".into()) }
}

/// Whether changes of the input by some last digits move the engine as far; where the events differ it is infinitely far.
fn changes_move_as_far<S: Subject>(subject: &S, response: &S::Response, apart: f64) -> bool {
    let Some(own) = S::as_solution(response) else { return false };
    let changes = LAST_DIGITS.iter().flat_map(|&digits| (0..CHANGES).map(move |trial| (digits, trial)));
    let mut moved = changes.filter_map(|(digits, trial)| {
        let other = subject.changed(digits, trial)?.simulate(&options(1)).ok()?;
        Some(largest_of(&S::compare(&S::as_solution(&other)?, &own)).unwrap_or(f64::INFINITY))
    });
    moved.any(|moved| apart <= AMPLIFICATION * moved)
}

/// How far the run is from one with every sample interval divided, but for accelerations just before stops; nothing where
/// the events differ.
fn division<S: Subject>(subject: &S, response: &S::Response, stops: &BeforeStops) -> Option<f64> {
    let other = subject.divided(PARTS).ok()?.simulate(&options(PARTS)).ok()?;
    let (other, own) = (S::as_solution(&other)?, S::as_solution(response)?);
    largest_of(&S::compare(&S::with_accelerations_of(&other, &own, stops), &own))
}

/// The largest difference of numbers and times; nothing where the events differ.
fn largest_of(comparison: &Comparison) -> Option<f64> {
    comparison.mismatch.is_none().then(|| larger(comparison.worst(), comparison.worst_time()))
}

/// How far peaks and paths are from those of the scene's image, over the largest of their kind, but for accelerations just
/// before stops; nothing where the events are not as many.
fn turn<S: Subject>(subject: &S, response: &S::Response, stops: &BeforeStops) -> Option<f64> {
    let other = subject.image().ok()?.simulate(&Options::default()).ok()?;
    let (own, of_image) = (S::peaks(response, false), S::peaks(&other, true));
    let apart = own.iter().zip(&of_image).enumerate().map(|(list, (own, image))| {
        let largest = own.iter().fold(f64::MIN_POSITIVE, |largest, peak| largest.max(peak.value));
        let counts =
            |at: usize, own: Peak, image: Peak| !(S::ACCELERATIONS.contains(&list) && stops.part(at, own, image));
        own.iter()
            .zip(image)
            .enumerate()
            .filter(|(at, (own, image))| counts(*at, **own, **image))
            .fold(0.0, |worst, (_, (own, image))| larger(worst, (own.value - image.value).abs() / largest))
    });
    let same_events = S::summary(response).events == S::summary(&other).events;
    same_events.then(|| apart.fold(0.0, larger))
}
