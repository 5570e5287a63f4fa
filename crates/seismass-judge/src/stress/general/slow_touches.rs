//! Touches and leaves of stops that are slower than rounding.
//!
//! Goods between stops of hardly any clearance tremble there, ever less, while they slide along the stops or fly. What a
//! velocity lost of its digits when it was large, the time of a touch lacks when it is small: how many touches follow, and
//! when, differs between two implementations, and in each with the precision. No number feels them.

use seismass::EventKind;

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

/// A solution without the touches and leaves slower than that part of the largest velocity.
pub(super) fn without_slow_touches<S: Subject>(solution: &S::Solution) -> S::Solution {
    let least = SLOW * S::directions(solution).into_iter().map(fastest).fold(0.0, f64::max);
    let mut solution = solution.clone();
    for direction in S::directions_mut(&mut solution) {
        direction.events.retain(|entry| {
            let is_of_stop = matches!(entry.event.kind, EventKind::TouchStop | EventKind::LeaveStop);
            !is_of_stop || entry.velocity.abs() >= least
        });
    }
    solution
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::num::NonZeroUsize;

    use seismass::{GeneralEvent, GeneralScene, Motion, Options};

    use super::*;

    type One = (GeneralScene, Motion);

    /// In scenes without slow touches one that is made slow is gone, and nothing else.
    #[test]
    fn slow_touches_are_gone_and_nothing_else() {
        let options = Options { histories: NonZeroUsize::new(1), events: true, energy: true, ..Options::default() };
        let mut made = 0;
        for seed in 0..100 {
            let Ok(response) = One::draw(seed).unwrap().simulate(&options) else { continue };
            let mut solution = <One as Subject>::as_solution(&response).unwrap();
            let is_touch = |entry: &GeneralEvent| entry.event.kind == EventKind::TouchStop;
            let Some(touch) = solution.events.iter().position(is_touch) else { continue };
            if without_slow_touches::<One>(&solution).events != solution.events {
                continue;
            }
            let mut others = solution.events.clone();
            others.remove(touch);
            solution.events[touch].velocity = 0.1 * SLOW * fastest(&solution);
            assert_eq!(without_slow_touches::<One>(&solution).events, others, "seed {seed}");
            made += 1;
        }
        assert!(made > 20, "{made}");
    }
}
