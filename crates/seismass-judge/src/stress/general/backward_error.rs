//! The backward error of a chaotic run: the change of the motion with which the judge comes to the engine's events and
//! numbers.
//!
//! Where small differences grow tenfold every few events, the rounding of doubles becomes a difference of whole events
//! before a run ends. No two implementations agree to its end then, nor does one with itself when its intervals are divided,
//! and changes of the input at random lead to yet other runs. But what rounding does along the way, a change of the motion
//! does too that grows as it does. So that change is sought, to a small part of a last digit, which double-double resolves:
//! the one with which the judge agrees with the engine from the first sample to the last. An engine whose run is the exact
//! one of a motion that differs by some last digits makes no error but rounding.

use seismass::{Event, GeneralStatus};

use super::subject::Subject;
use crate::compare::{scales, values};
use crate::general::{Budget, GeneralSolution, Scale, apart_by_machine};
use crate::stress::grazing::AMPLIFICATION;
use crate::stress::verdict::AGREEMENT;
use crate::{DoubleDouble, Real};

/// Corrections of a change: each leads the judge along the engine's run for some longer.
const CORRECTIONS: usize = 12;
/// The largest change that counts as one of last digits: goods that are thrown to and fro hardly feel it, and their own
/// rounding as they go from event to event may need some hundred.
const LARGEST_CHANGE: f64 = 1e-12;
/// Relative differences of drifts and slips up to this are proportional to the change, to its square.
const PROPORTIONAL: f64 = 1e-6;
/// A correction that does not part the two later leaves this part of what they were apart.
const WINS: f64 = 0.5;
/// Smaller and smaller changes tried, to measure what one does.
const MEASURES: usize = 10;

/// What is scaled by a factor just beside 1.
#[derive(Debug, Clone, Copy)]
enum Scaled {
    Ground,
    Contact,
}

/// The change of the ground acceleration, or of g + a_v, in last digits (2^-52), with which the judge in double-double agrees
/// with a response that has histories at every sample and events. `exact` is the unchanged judge.
pub(super) fn backward_error<S: Subject>(
    subject: &S,
    response: &S::Solution,
    exact: &S::Solution,
    budget: &Budget,
) -> Option<f64> {
    [Scaled::Ground, Scaled::Contact].into_iter().find_map(|scaled| {
        let judge = |change: DoubleDouble| {
            let (one, factor) = (DoubleDouble::of(1.0), DoubleDouble::of(1.0) + change);
            let scale = match scaled {
                Scaled::Ground => Scale { ground: factor, contact: one },
                Scaled::Contact => Scale { ground: one, contact: factor },
            };
            subject.solve(scale, budget).ok()
        };
        seek::<S>(response, exact, judge)
    })
}

/// Seeks the change by Newton's method, at the first row at which the two are apart by more than is proportional to it:
/// beyond, the differences have grown too large to tell how far the change is off.
///
/// Where differences grow by more than double-double has digits, no change leads to the end. Then one counts with which the
/// judge follows the engine, with the same events, to the row at which its own last digit moves it as far.
fn seek<S: Subject>(
    response: &S::Solution,
    exact: &S::Solution,
    judge: impl Fn(DoubleDouble) -> Option<S::Solution>,
) -> Option<f64> {
    let rows = Rows::new(S::directions(response), &S::directions(exact));
    let last_digit = DoubleDouble::of(f64::EPSILON);
    let in_digits = |change: DoubleDouble| (change / last_digit).to_f64().abs();
    let (mut change, mut step) = (DoubleDouble::zero(), last_digit);
    let mut solution = exact.clone();
    let mut before = (0, f64::INFINITY);
    for _ in 0..CORRECTIONS {
        let row = rows.parting(&S::directions(&solution))?;
        let apart = rows.apart(row, &S::directions(&solution));
        // Neither later nor less apart: what is left is not of a change.
        if row < before.0 || row == before.0 && size(&apart) > before.1 {
            break;
        }
        before = (row, WINS * size(&apart));
        let Some(moved) = rows.moved::<S>((row, &apart), change, &mut step, &judge) else { break };
        // The least squares of what is left.
        let squares: f64 = moved.iter().map(|m| m * m).sum();
        let product: f64 = moved.iter().zip(&apart).map(|(m, a)| m * a).sum();
        let next = change + step * DoubleDouble::of(product / squares);
        // No change where nothing moved: the quotient is no number.
        if in_digits(next).is_nan() {
            break;
        }
        if next.to_f64().abs() > LARGEST_CHANGE {
            return None;
        }
        (change, solution) = (next, judge(next)?);
        if S::compare(response, &solution).agrees(AGREEMENT) {
            return Some(in_digits(change));
        }
    }
    let row = rows.parting(&S::directions(&solution))?;
    let apart = rows.apart(row, &S::directions(&solution));
    let own = judge(change + DoubleDouble::of(DoubleDouble::EPSILON))?;
    let moved = difference(&apart, &rows.apart(row, &S::directions(&own)));
    let is_own = size(&apart) > PROPORTIONAL && size(&apart) <= AMPLIFICATION * size(&moved);
    (is_own && rows.same_events::<S>(row, response, &solution)).then(|| in_digits(change))
}

fn difference(one: &[f64], other: &[f64]) -> Vec<f64> {
    one.iter().zip(other).map(|(one, other)| one - other).collect()
}

fn size(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// Drifts and slips of a response, sample by sample, and the peaks that differences count relative to, by direction.
struct Rows<'a> {
    response: Vec<&'a GeneralSolution>,
    drift_scales: Vec<Vec<f64>>,
    slip_scales: Vec<Vec<f64>>,
    count: usize,
}

impl<'a> Rows<'a> {
    fn new(response: Vec<&'a GeneralSolution>, exact: &[&GeneralSolution]) -> Self {
        let drift_scales: Vec<Vec<f64>> = exact.iter().map(|of| scales(&values(&of.peaks.drift))).collect();
        let slip_scales: Vec<Vec<f64>> = exact.iter().map(|of| scales(&values(&of.peaks.slip))).collect();
        let rows = |values: &[f64], scales: &[f64]| values.len().checked_div(scales.len()).unwrap_or(0);
        let count = rows(&response[0].drift, &drift_scales[0]).max(rows(&response[0].slip, &slip_scales[0]));
        Self { response, drift_scales, slip_scales, count }
    }

    /// How far the response is from a solution in a row, each drift and slip by its scale; zero beyond the end of one.
    fn apart(&self, row: usize, solution: &[&GeneralSolution]) -> Vec<f64> {
        let of = |found: &[f64], expected: &[f64], scales: &[f64]| {
            let first = row * scales.len();
            let differences = scales.iter().enumerate().map(|(i, scale)| {
                let difference = (found[first + i] - expected[first + i]) / scale;
                if difference.is_finite() { difference } else { 0.0 }
            });
            differences.collect::<Vec<f64>>()
        };
        let scales = self.drift_scales.iter().zip(&self.slip_scales);
        let lists = self.response.iter().zip(solution).zip(scales).map(|((found, expected), (drift, slip))| {
            [of(&found.drift, &expected.drift, drift), of(&found.slip, &expected.slip, slip)].concat()
        });
        lists.collect::<Vec<_>>().concat()
    }

    /// How a step of a change, made smaller until differences are proportional to it, moves the judge in a row, in which it
    /// is apart by so much without the step.
    fn moved<S: Subject>(
        &self,
        (row, apart): (usize, &[f64]),
        change: DoubleDouble,
        step: &mut DoubleDouble,
        judge: &impl Fn(DoubleDouble) -> Option<S::Solution>,
    ) -> Option<Vec<f64>> {
        for _ in 0..MEASURES {
            let moved = difference(apart, &self.apart(row, &S::directions(&judge(change + *step)?)));
            if size(&moved) <= PROPORTIONAL {
                return Some(moved);
            }
            // Well within, as growth may not be even.
            *step = *step * DoubleDouble::of(0.1 * PROPORTIONAL / size(&moved));
        }
        None
    }

    /// Whether every spring and block has the same events in two solutions before the row ahead of this one. Without a
    /// collapse the last row is at the end.
    fn same_events<S: Subject>(&self, row: usize, response: &S::Solution, solution: &S::Solution) -> bool {
        let of_solution = S::directions(solution)[0];
        if of_solution.status != GeneralStatus::Completed {
            return false;
        }
        let until = of_solution.end_time * (row.saturating_sub(1) as f64) / (self.count - 1) as f64;
        let before = |log: &[Event]| log.iter().filter(|event| event.time < until).copied().collect::<Vec<Event>>();
        let logs = S::logs(response).into_iter().zip(S::logs(solution));
        logs.map(|(own, other)| apart_by_machine(&before(&own), &before(&other))).all(|apart| apart.is_some())
    }

    /// The first row in which a solution is apart from the response by more than is proportional to a change; the one most
    /// apart where there is none.
    fn parting(&self, solution: &[&GeneralSolution]) -> Option<usize> {
        let apart: Vec<f64> = (0..self.count).map(|row| size(&self.apart(row, solution))).collect();
        let first = apart.iter().position(|&apart| apart > PROPORTIONAL);
        first.or_else(|| (0..self.count).max_by(|&one, &other| apart[one].total_cmp(&apart[other])))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::num::NonZeroUsize;

    use seismass::{Block, GeneralResponse, GeneralScene, Goods, Motion, Options, Stops, simulate_general};

    use super::*;
    use crate::general::{compare_general, solution_of, solve_general};
    use crate::random_scene::{Draw, samples_of};

    /// Samples of the motion.
    const SAMPLES: usize = 1000;

    /// A block thrown to and fro between two stiff stops on shaking ground: rounding grows at every touch, until engine and
    /// judge come to other events. A last digit or two of the motion lead the judge to the engine's run to the end.
    ///
    /// An engine that errs once is not led to: by 1e-6 of one sample of the motion at mid-run, or by its last event. Nor one
    /// under a motion that differs by more than last digits.
    #[test]
    fn a_chaotic_run_is_the_exact_one_of_a_motion_changed_by_last_digits_and_an_error_is_not() {
        let stops = Stops { clearance: [0.002; 2], stiffness: 4e7, damping: 0.0 };
        let goods = Goods { block: Block::new(0, 1000.0, 0.005), stops: Some(stops) };
        let scene = GeneralScene::new(None, vec![goods], Vec::new()).unwrap();
        let samples = samples_of(&mut Draw(1), SAMPLES, 0.01, 4.0);
        let changed = |change: &dyn Fn(usize) -> f64| {
            let samples: Vec<f64> = samples.iter().enumerate().map(|(i, a)| a * (1.0 + change(i))).collect();
            Motion::new(samples, 0.01, None).unwrap()
        };
        let options = Options { histories: NonZeroUsize::new(1), events: true, energy: true, ..Options::default() };
        let run = |motion: &Motion| simulate_general(&scene, motion, &options).unwrap();
        let motion = changed(&|_| 0.0);
        let exact = solve_general::<DoubleDouble>(&scene, &motion, 1).unwrap();
        let subject = (scene.clone(), motion);
        let found = |response: &GeneralResponse| {
            backward_error(&subject, &solution_of(response).unwrap(), &exact, &Budget::of(usize::MAX))
        };

        let mut response = run(&subject.1);
        assert!(compare_general(&response, &exact).mismatch.is_some());
        let digits = found(&response).unwrap();
        assert!(digits < 4.0, "{digits}");
        assert_eq!(found(&run(&changed(&|i| if i == SAMPLES / 2 { 1e-6 } else { 0.0 }))), None);
        assert_eq!(found(&run(&changed(&|_| 1e-11))), None);
        response.events.as_mut().unwrap().last_mut().unwrap().event.sign *= -1;
        assert_eq!(found(&response), None);
    }
}
