//! Comparison of responses of the general engine with others.

use seismass::{EventKind, GeneralResponse, Options, Peak};

use super::maximum::larger;

/// Peaks agree to this fraction of the largest of their kind.
pub const PEAK: f64 = 1e-12;
/// Event times agree to this (s).
pub const EVENT_TIME: f64 = 1e-11;
/// Events that are closer (s) are in one instant, where their order means nothing.
const INSTANT: f64 = 1e-10;
/// Energies balance to this fraction of the input.
pub const ENERGY: f64 = 1e-11;

/// What the comparison needs of a run.
pub const OPTIONS: Options = Options { energy: true, events: true, peaks_only: false, ..Options::PEAKS };

/// An event by its time and what it says.
pub type Entry = (f64, String);

/// Largest deviation over the largest expected value.
pub fn deviation(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let scale = expected.iter().fold(0.0, |scale, value| larger(scale, value.abs()));
    let worst = found.iter().zip(expected).fold(0.0, |worst, (f, e)| larger(worst, (f - e).abs()));
    if worst == 0.0 { 0.0 } else { worst / scale }
}

pub fn values(peaks: &[Peak]) -> Vec<f64> {
    peaks.iter().map(|peak| peak.value).collect()
}

/// Largest difference of times of two logs, whose events of one instant may come in any order.
pub fn compare_events(mut found: Vec<Entry>, mut expected: Vec<Entry>) -> Result<f64, String> {
    for list in [&mut expected, &mut found] {
        let mut start = 0;
        while start < list.len() {
            let mut end = start + 1;
            while end < list.len() && list[end].0 - list[end - 1].0 <= INSTANT {
                end += 1;
            }
            list[start..end].sort_by(|a, b| a.1.cmp(&b.1));
            start = end;
        }
    }
    let mut worst = 0.0;
    for (i, (f, e)) in found.iter().zip(&expected).enumerate() {
        if f.1 != e.1 {
            return Err(format!("event {i}: found {f:?}, expected {e:?}"));
        }
        worst = larger(worst, (f.0 - e.0).abs());
    }
    if found.len() == expected.len() {
        return Ok(worst);
    }
    Err(format!("{} events, expected {}", found.len(), expected.len()))
}

pub fn events(response: &GeneralResponse) -> Vec<Entry> {
    let name = |kind: EventKind| match kind {
        EventKind::TouchStop => "contact",
        EventKind::LeaveStop => "leave",
        kind => kind.name(),
    };
    let logged = response.events.as_ref().unwrap().iter().map(|entry| entry.event);
    logged.map(|e| (e.time, format!("{} {} {} {}", name(e.kind), e.number, e.sign, e.element))).collect()
}
