//! Where the general engine and its judge part: is it a grazing, or a sensitive scene? The judge is asked with its input
//! changed in the last digits, at random as for the chain engine, and where that shows nothing by the change that is sought.

use seismass::Event;

use super::backward_error::backward_error;
use super::before_stops::BeforeStops;
use super::slow_touches::without_slow_touches;
use super::subject::Subject;
use crate::general::{Budget, GeneralSolution, Scale, apart_by_machine};
use crate::stress::grazing::AMPLIFICATION;
use crate::stress::verdict::{AGREEMENT, LAST_DIGITS, TRIALS, Verdict};
use crate::{Comparison, DoubleDouble, JudgeError, Real};

/// Series of all solutions of one scene by the judge, one in double-double counted as thirty: some minutes. A scene in which
/// the two part and whose explanation takes more is not judged.
pub(super) const MAX_SERIES: usize = 2_000_000;

/// Different changes of each size for the judge in double-double.
const PRECISE_TRIALS: u64 = 2;

/// Compares a response with the judge in double precision; if they part, or `precisely`, in double-double; if they part
/// still, looks for a grazing.
///
/// # Errors
/// Why there is none, where the judge takes too many series. In double-double it takes more, and is not asked where it
/// fails in double precision; where it takes too many, agreement in double precision counts.
pub(super) fn judge<S: Subject>(subject: &S, response: &S::Response, precisely: bool) -> Result<Verdict, String> {
    let budget = &Budget::of(MAX_SERIES);
    let stops = &subject.before_stops(response);
    let Some(response) = S::as_solution(response) else {
        return Ok(Verdict::Unexplained("a response without events, histories or energies".into()));
    };
    let plain = subject.solve::<f64>(Scale::none(), budget);
    match &plain {
        Err(error) if takes_too_many(error) => return Err(error.to_string()),
        Ok(plain) if !precisely => {
            if let Some(verdict) = agreement::<S>(&response, plain, stops) {
                return Ok(verdict);
            }
        }
        _ => {}
    }
    let exact = match subject.solve::<DoubleDouble>(Scale::none(), budget) {
        Ok(exact) => exact,
        Err(error) if takes_too_many(&error) => {
            let agreed = plain.ok().and_then(|plain| agreement::<S>(&response, &plain, stops));
            return agreed.ok_or_else(|| error.to_string());
        }
        Err(error) => return Ok(Verdict::Unexplained(format!("the judge failed: {error}"))),
    };
    let agreed = agreement::<S>(&response, &exact, stops);
    agreed.map_or_else(|| explanation(subject, (&response, &exact), plain.ok(), budget), Ok)
}

fn takes_too_many(error: &JudgeError) -> bool {
    matches!(error, JudgeError::TooManySeries { .. } | JudgeError::TooDear { .. })
}

/// The verdict where a response agrees with a solution, but for accelerations just before stops.
fn agreement<S: Subject>(response: &S::Solution, exact: &S::Solution, stops: &BeforeStops) -> Option<Verdict> {
    let comparison = S::compare(response, exact);
    if comparison.agrees(AGREEMENT) {
        return Some(Verdict::Agrees(comparison));
    }
    let but_for_stops = S::compare(&S::with_accelerations_of(response, exact, stops), exact);
    let difference = difference(&comparison);
    but_for_stops.agrees(AGREEMENT).then_some(Verdict::BeforeStops { comparison: but_for_stops, difference })
}

/// How far a response is from a solution, where the two agree but for touches slower than rounding.
fn agreement_but_for_slow_touches<S: Subject>(response: &S::Solution, exact: &S::Solution) -> Option<Comparison> {
    let [found, exact] = [response, exact].map(without_slow_touches::<S>);
    Some(S::compare(&found, &exact)).filter(|comparison| comparison.agrees(AGREEMENT))
}

/// Looks for a grazing where a response parts from the judge in double-double.
///
/// # Errors
/// How they part, where the budget ends before one is found.
fn explanation<S: Subject>(
    subject: &S,
    (response, exact): (&S::Solution, &S::Solution),
    plain: Option<S::Solution>,
    budget: &Budget,
) -> Result<Verdict, String> {
    let comparison = S::compare(response, exact);
    let difference = difference(&comparison);
    if let Some(comparison) = agreement_but_for_slow_touches::<S>(response, exact) {
        return Ok(Verdict::SlowTouches { comparison, difference });
    }
    // All numbers agree, and the judge in double precision has the engine's events: they are those of its rounding.
    let of_rounding = |plain: &S::Solution| agreement_but_for_slow_touches::<S>(response, plain).is_some();
    if comparison.worst() <= AGREEMENT && plain.as_ref().is_some_and(of_rounding) {
        return Ok(Verdict::Sensitive { digits: 0.0, difference });
    }
    let same_events = comparison.mismatch.is_none();
    if same_events && plain.is_some_and(|plain| moves_as_far::<S>(response, exact, &plain)) {
        return Ok(Verdict::Sensitive { digits: 0.0, difference });
    }
    // In doubles first: the judge's own rounding, some last digits too, is cheaper than its precision.
    let changed = explain::<S, f64>(subject, (response, exact), TRIALS, budget);
    let precisely = || explain::<S, DoubleDouble>(subject, (response, exact), PRECISE_TRIALS, budget);
    match changed.or_else(precisely) {
        Some((true, digits)) => return Ok(Verdict::Grazing { digits, difference }),
        Some((false, digits)) => return Ok(Verdict::Sensitive { digits, difference }),
        None => {}
    }
    // A chaotic scene: no change at random follows the engine to the end, as the one sought does.
    if let Some(digits) = backward_error(subject, response, exact, budget) {
        return Ok(Verdict::Sensitive { digits: (100.0 * digits).round() / 100.0, difference });
    }
    budget.check().map_err(|error| format!("parts from the judge: {difference}; {error}"))?;
    Ok(Verdict::Unexplained(difference))
}

/// Whether the judge with its input changed in the last digits comes to the engine's events and numbers (true), or moves as
/// far from itself as the engine is from it (false), and the change in last digits that shows it. Where the events of the
/// unchanged judge are others, two changed ones that have the engine's are compared with each other.
fn explain<S: Subject, R: Real>(
    subject: &S,
    (response, exact): (&S::Solution, &S::Solution),
    trials: u64,
    budget: &Budget,
) -> Option<(bool, f64)> {
    let same_events = S::compare(response, exact).mismatch.is_none();
    let mut alike: Vec<S::Solution> = Vec::new();
    for digits in LAST_DIGITS {
        for trial in 0..trials {
            let Some(changed) = subject.changed(digits, trial) else { continue };
            let Ok(other) = changed.solve::<R>(Scale::none(), budget) else { continue };
            let left = S::compare(response, &other);
            if left.agrees(AGREEMENT) {
                return Some((true, digits));
            }
            let shown = match (same_events, &left.mismatch) {
                (true, _) => moves_as_far::<S>(response, exact, &other),
                (false, None) => {
                    let shown = alike.iter().any(|one| moves_as_far::<S>(response, one, &other));
                    alike.push(other);
                    shown
                }
                (false, Some(_)) => false,
            };
            if shown {
                return Some((false, digits));
            }
        }
    }
    None
}

fn difference(parted: &Comparison) -> String {
    let numbers = || format!("relative difference {:.1e}, of event times {:.1e}", parted.worst(), parted.worst_time());
    parted.mismatch.clone().unwrap_or_else(numbers)
}

/// Whether every spring and block has the judge's events in the engine's and in the changed judge's run, and numbers and the
/// times of each are as far from the judge's in the latter as in the former.
fn moves_as_far<S: Subject>(response: &S::Solution, exact: &S::Solution, other: &S::Solution) -> bool {
    let end = |solution: &S::Solution| S::directions(solution)[0].end_time;
    let times = |found: &S::Solution| {
        let logs: (Vec<Vec<Event>>, Vec<Vec<Event>>) = (S::logs(found), S::logs(exact));
        let apart = logs.0.iter().zip(&logs.1).map(|(found, own)| apart_by_machine(found, own));
        let mut times: Vec<f64> = apart.collect::<Option<Vec<_>>>()?.concat();
        times.push((end(found) - end(exact)).abs());
        Some(times)
    };
    let Some((kernel, changed)) = times(response).zip(times(other)) else { return false };
    let status = |solution: &S::Solution| {
        let first: &GeneralSolution = S::directions(solution)[0];
        std::mem::discriminant(&first.status)
    };
    let as_far = |rounding: f64, kernel: f64, changed: f64| {
        kernel <= rounding || kernel.is_finite() && kernel <= AMPLIFICATION * changed
    };
    status(response) == status(exact)
        && status(other) == status(exact)
        && as_far(AGREEMENT, S::compare(response, exact).worst(), S::compare(other, exact).worst())
        && kernel.iter().zip(changed).all(|(&kernel, changed)| as_far(AGREEMENT * end(exact), kernel, changed))
}
