//! How far the fast kernel's response is from a solution, in the measures of the reference scenes.

use seismass::{Event, EventKind, Peak, Response, Status};

use crate::record::Solution;

/// Events this close (s) may be logged in any order.
const ONE_INSTANT: f64 = 1e-10;
/// Peaks count relative to this part of the largest of their kind at least.
pub(crate) const LEAST_PART: f64 = 1e-3;
/// Event times are not resolved below this (s).
const TIME_ROUNDING: f64 = 1e-13;

/// Largest differences. Drifts, slips, accelerations and shears are relative to the larger of the peak of the same
/// storey or block and a thousandth of the largest peak of the kind; NaN where only one of two is a number.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Drift histories, if the response has them.
    pub drift: f64,
    /// Slip histories, if the response has them.
    pub slip: f64,
    /// Peaks of drift, slip, floor acceleration and storey shear.
    pub peaks: f64,
    /// Residual drifts and slips.
    pub residuals: f64,
    /// Slip paths, relative to themselves.
    pub slip_path: f64,
    /// Event times, that of a collapse among them (s); NaN if the events differ.
    pub event_time: f64,
    /// How long the run lasts (s).
    pub duration: f64,
    /// The first difference between the event logs, or between the ways the runs ended.
    pub mismatch: Option<String>,
}

impl Comparison {
    /// The largest relative difference of numbers other than times; NaN if something is missing.
    pub fn worst(&self) -> f64 {
        [self.drift, self.slip, self.peaks, self.residuals, self.slip_path].into_iter().fold(0.0, larger)
    }

    /// Event times, relative to the duration; NaN if the events differ.
    pub fn worst_time(&self) -> f64 {
        if self.event_time == 0.0 { 0.0 } else { self.event_time / self.duration }
    }

    /// Whether the same events happened, and numbers and times agree to this relative difference.
    ///
    /// # Limitation
    /// Where a guard but grazes zero, the time of its fall is known to the root of what rounding leaves of its depth: a
    /// run right to rounding may then fail this.
    pub fn agrees(&self, tolerance: f64) -> bool {
        self.mismatch.is_none() && self.worst() <= tolerance && self.worst_time() <= tolerance
    }
}

/// The larger of two, NaN if one is: a maximum that cannot lose what is no number.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// Largest difference of values in rows as wide as `scales`, each relative to its column's scale.
pub(crate) fn difference(found: &[f64], expected: &[f64], scales: &[f64]) -> f64 {
    if found.len() != expected.len() {
        return f64::NAN;
    }
    let scales = scales.iter().cycle();
    found.iter().zip(expected).zip(scales).fold(0.0, |worst, ((&f, &e), &scale)| {
        let same = f == e || f.is_nan() && e.is_nan();
        larger(worst, if same { 0.0 } else { (f - e).abs() / scale })
    })
}

pub(crate) fn values(peaks: &[Peak]) -> Vec<f64> {
    peaks.iter().map(|p| p.value).collect()
}

pub(crate) fn scales(peaks: &[f64]) -> Vec<f64> {
    let largest = peaks.iter().copied().fold(0.0, f64::max);
    peaks.iter().map(|&p| p.max(LEAST_PART * largest)).collect()
}

/// The log without the breakaways that no double can tell from the lift that follows: where a floor has hardly begun
/// to accelerate, a stuck block reaches its limit within the rounding of time before the contact force vanishes.
fn without_breakaways_at_lift(log: &[Event]) -> Vec<Event> {
    let pair = |slip: &Event, lift: &Event| {
        slip.kind == EventKind::Slip
            && lift.kind == EventKind::Lift
            && slip.number == lift.number
            && (0.0..=TIME_ROUNDING).contains(&(lift.time - slip.time))
    };
    let is_lost = |slip: &Event| log.iter().any(|lift| pair(slip, lift));
    let mut kept = Vec::new();
    for event in log.iter().filter(|event| event.kind != EventKind::Slip || !is_lost(event)) {
        let stuck = event.kind == EventKind::Lift && log.iter().any(|slip| pair(slip, event));
        kept.push(Event { sign: if stuck { 0 } else { event.sign }, ..*event });
    }
    kept
}

/// Compares event logs, those of one instant in any order: the largest time difference (s), or the first mismatch.
///
/// A breakaway within the rounding of time before a lift counts as part of it.
///
/// # Errors
/// The first event that only one of the logs has.
pub fn compare_events(found: &[Event], expected: &[Event]) -> Result<f64, String> {
    let key = |e: &Event| (e.kind as usize, e.number, e.sign, e.element);
    let sorted = |log: &[Event]| {
        let mut log = without_breakaways_at_lift(log);
        log.sort_by(|a, b| a.time.total_cmp(&b.time));
        let mut start = 0;
        for i in 1..=log.len() {
            if i == log.len() || log[i].time - log[i - 1].time > ONE_INSTANT {
                log[start..i].sort_by_key(key);
                start = i;
            }
        }
        log
    };
    let (found, expected) = (sorted(found), sorted(expected));
    let pairs = found.iter().zip(&expected).enumerate();
    let mut worst = 0.0;
    for (i, (f, e)) in pairs {
        if key(f) != key(e) {
            return Err(format!("event {}: {f:?} for {e:?}", i + 1));
        }
        worst = larger(worst, (f.time - e.time).abs());
    }
    if found.len() != expected.len() {
        return Err(format!("{} events for {}", found.len(), expected.len()));
    }
    Ok(worst)
}

/// Compares how two runs ended: the difference in time (s), or the mismatch.
pub(crate) fn compare_endings(found: &Status, expected: &Status) -> Result<f64, String> {
    match (found, expected) {
        (Status::Completed, Status::Completed) => Ok(0.0),
        (Status::Collapsed { storey: a, time: s }, Status::Collapsed { storey: b, time: t }) if a == b => {
            Ok((s - t).abs())
        }
        _ => Err(format!("{found:?} for {expected:?}")),
    }
}

impl Solution {
    /// Compares another solution with this one, taken as exact.
    pub fn judge(&self, other: &Solution) -> Comparison {
        self.judge_parts(
            &other.status,
            [&other.peaks.drift, &other.peaks.slip, &other.peaks.floor_acceleration, &other.peaks.storey_shear],
            [&other.residual_drift, &other.residual_slip, &other.slip_path],
            Some((&other.drift, &other.slip)),
            Some(&other.events),
        )
    }

    fn judge_parts(
        &self,
        status: &Status,
        peaks: [&[Peak]; 4],
        [residual_drift, residual_slip, slip_path]: [&[f64]; 3],
        histories: Option<(&[f64], &[f64])>,
        events: Option<&[Event]>,
    ) -> Comparison {
        let own = [&self.peaks.drift, &self.peaks.slip, &self.peaks.floor_acceleration, &self.peaks.storey_shear];
        let own = own.map(|p| values(p));
        let [drift_scale, slip_scale, ..] = own.clone().map(|p| scales(&p));
        let peaks = peaks.iter().zip(&own).map(|(found, own)| difference(&values(found), own, &scales(own)));
        let residuals = [
            difference(residual_drift, &self.residual_drift, &drift_scale),
            difference(residual_slip, &self.residual_slip, &slip_scale),
        ];
        let (drift, slip) = histories.map_or((0.0, 0.0), |(drift, slip)| {
            (difference(drift, &self.drift, &drift_scale), difference(slip, &self.slip, &slip_scale))
        });
        let events = events.map_or(Ok(0.0), |events| compare_events(events, &self.events));
        let ending = compare_endings(status, &self.status);
        let event_time = larger(*events.as_ref().unwrap_or(&f64::NAN), *ending.as_ref().unwrap_or(&f64::NAN));
        Comparison {
            drift,
            slip,
            peaks: peaks.fold(0.0, larger),
            residuals: residuals.into_iter().fold(0.0, larger),
            slip_path: difference(slip_path, &self.slip_path, &scales(&self.slip_path)),
            event_time,
            duration: self.end_time,
            mismatch: ending.err().or(events.err()),
        }
    }
}

/// Compares the fast kernel's response with a solution, which is taken as exact.
///
/// Histories need the same decimation; what the response was not asked for is not compared.
pub fn compare(response: &Response, solution: &Solution) -> Comparison {
    solution.judge_parts(
        &response.status,
        [&response.peaks.drift, &response.peaks.slip, &response.peaks.floor_acceleration, &response.peaks.storey_shear],
        [&response.residual_drift, &response.residual_slip, &response.slip_path],
        response.histories.as_ref().map(|h| (&h.drift[..], &h.slip[..])),
        response.events.as_deref(),
    )
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::num::NonZeroUsize;

    use seismass::{Options, simulate};

    use super::*;
    use crate::random_scene::random_scene;
    use crate::{DoubleDouble, solve};

    /// Random scenes with events, of which seed 10 collapses: what is changed in the kernel's response is seen, be it a
    /// time or no number.
    #[test]
    fn what_is_changed_is_seen() {
        for seed in [1, 10] {
            let (scene, motion) = random_scene(seed).unwrap();
            let exact = solve::<DoubleDouble>(&scene, &motion, 1).unwrap();
            let options = Options { histories: NonZeroUsize::new(1), events: true, ..Options::default() };
            let response = simulate(&scene, &motion, &options).unwrap();
            assert!(compare(&response, &exact).agrees(1e-12), "seed {seed}");
            let seen = |change: fn(&mut Response)| {
                let mut response = response.clone();
                change(&mut response);
                !compare(&response, &exact).agrees(1e-9)
            };
            assert!(seen(|r| r.events.as_mut().unwrap().last_mut().unwrap().time += 1e-7), "seed {seed}");
            assert!(seen(|r| r.events.as_mut().unwrap().last_mut().unwrap().time = f64::NAN), "seed {seed}");
            assert!(seen(|r| r.histories.as_mut().unwrap().drift[1] = f64::NAN), "seed {seed}");
            assert!(seen(|r| r.peaks.drift[0].value = f64::NAN), "seed {seed}");
            assert!(seen(|r| r.peaks.drift[0].value *= 1.0 + 1e-8), "seed {seed}");
            let collapses = response.status != Status::Completed;
            let delay = |r: &mut Response| {
                if let Status::Collapsed { time, .. } = &mut r.status {
                    *time += 1e-7;
                }
            };
            assert_eq!((collapses, seen(delay)), (seed == 10, seed == 10), "seed {seed}");
        }
    }
}
