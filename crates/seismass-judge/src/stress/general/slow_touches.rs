//! Touches and leaves of stops that are slower than rounding.
//!
//! Goods between stops of hardly any clearance tremble there, ever less, while they slide along the stops or fly. What a
//! velocity lost of its digits when it was large, the time of a touch lacks when it is small: how many touches follow, and
//! when, differs between two implementations, and in each with the precision. No number feels them.

use std::collections::BTreeMap;

use seismass::{EventKind, GeneralEvent};

use super::subject::Subject;
use crate::general::GeneralSolution;

/// Touches slower than this part of the largest velocity of a run are rounding: some thousand last digits, of as many steps.
const SLOW: f64 = 1e-12;

/// The largest velocity that is known of a solution: of its events, and the mean between two samples of drifts and slips.
fn fastest(solution: &GeneralSolution) -> f64 {
    let of_events = solution.events.iter().fold(0.0f64, |most, event| most.max(event.velocity.abs()));
    let of_samples = |values: &[f64], width: usize| {
        // Not a number after a collapse.
        let steps = values.chunks(width.max(1)).filter(|row| row[0].is_finite()).count().max(2) - 1;
        let changes = values.iter().zip(values.iter().skip(width)).map(|(one, next)| (next - one).abs());
        changes.fold(0.0, f64::max) * steps as f64 / solution.end_time
    };
    let of_drifts = of_samples(&solution.drift, solution.residual_drift.len());
    of_events.max(of_drifts).max(of_samples(&solution.slip, solution.residual_slip.len()))
}

/// A solution without the touches and leaves with which a block ends that are slower than that part of the largest velocity.
/// Those at rest, as a block starts at a stop without clearance, are known.
pub(super) fn without_slow_touches<S: Subject>(solution: &S::Solution) -> S::Solution {
    let least = SLOW * S::directions(solution).into_iter().map(fastest).fold(0.0, f64::max);
    let mut solution = solution.clone();
    for direction in S::directions_mut(&mut solution) {
        let is_of_stop = |entry: &GeneralEvent| matches!(entry.event.kind, EventKind::TouchStop | EventKind::LeaveStop);
        let mut last: BTreeMap<usize, f64> = BTreeMap::new();
        for entry in direction.events.iter().filter(|entry| is_of_stop(entry) && entry.velocity.abs() >= least) {
            last.insert(entry.event.number, entry.event.time);
        }
        direction.events.retain(|entry| {
            let is_slow = entry.velocity != 0.0 && entry.velocity.abs() < least;
            !(is_of_stop(entry) && is_slow && last.get(&entry.event.number).is_none_or(|last| entry.event.time > *last))
        });
    }
    solution
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::num::NonZeroUsize;

    use seismass::{Event, GeneralScene, Motion, Options};

    use super::*;

    type One = (GeneralScene, Motion);

    /// In scenes without slow touches the last one of a block that is made slow is gone; one before others, or at rest, is not.
    #[test]
    fn slow_touches_at_the_end_are_gone_and_nothing_else() {
        let options = Options { histories: NonZeroUsize::new(1), events: true, energy: true, ..Options::default() };
        let mut made = 0;
        for seed in 0..100 {
            let Ok(response) = One::draw(seed).unwrap().simulate(&options) else { continue };
            let solution = <One as Subject>::as_solution(&response).unwrap();
            let of_stop = |entry: &GeneralEvent| {
                matches!(entry.event.kind, EventKind::TouchStop | EventKind::LeaveStop) && entry.velocity != 0.0
            };
            let Some(last) = solution.events.iter().rposition(of_stop) else { continue };
            let Event { number, time, .. } = solution.events[last].event;
            let is_before = |entry: &GeneralEvent| of_stop(entry) && entry.event.number == number;
            // What leaves one stop and touches the other at one instant does both at one velocity.
            if solution.events[..last].iter().any(|entry| is_before(entry) && entry.event.time == time) {
                continue;
            }
            let Some(first) = solution.events[..last].iter().position(is_before) else { continue };
            if without_slow_touches::<One>(&solution).events != solution.events {
                continue;
            }
            let slow = 0.1 * SLOW * fastest(&solution);
            for (at, velocity, is_gone) in [(last, slow, true), (last, 0.0, false), (first, slow, false)] {
                let mut changed = solution.clone();
                changed.events[at].velocity = velocity;
                let mut expected = changed.events.clone();
                if is_gone {
                    expected.remove(at);
                }
                assert_eq!(without_slow_touches::<One>(&changed).events, expected, "seed {seed}, event {at}");
            }
            made += 1;
        }
        assert!(made > 20, "{made}");
    }
}
