//! One run of a case, its peaks, events and histories as lists of numbers.

use std::num::NonZeroUsize;

use seismass::{Event, EventKind, Motion, Options, Peak, Response, Result, Scene, Status, simulate};

use crate::sections::sections;

/// Solves a scene with events, and with histories at every so many samples (0: none).
pub(crate) fn run(scene: &Scene, motion: &Motion, every: usize) -> Result<Vec<f64>> {
    let histories = NonZeroUsize::new(every);
    let options = Options { histories, events: true, ..Options::default() };
    Ok(lists(&simulate(scene, motion, &options)?))
}

/// In order: end time and collapsed storey (0: none); peak and its time of drift, slip, floor acceleration and storey
/// shear; residual drift, residual slip and slip path; number of events of each kind; time, kind, number and sign of each
/// event; histories of drift, slip and storey force, row by row.
fn lists(response: &Response) -> Vec<f64> {
    let collapsed = match response.status {
        Status::Completed => 0.0,
        Status::Collapsed { storey, .. } => storey as f64,
    };
    let peaks = &response.peaks;
    let both = |peaks: &[Peak]| {
        let values: Vec<f64> = peaks.iter().map(|peak| peak.value).collect();
        (values, peaks.iter().map(|peak| peak.time).collect::<Vec<f64>>())
    };
    let [drift, slip, acceleration, shear] =
        [&peaks.drift, &peaks.slip, &peaks.floor_acceleration, &peaks.storey_shear].map(|list| both(list));
    let counts: Vec<f64> = EventKind::ALL.iter().map(|&kind| response.statistics.events.of(kind) as f64).collect();
    let event = |event: &Event| [event.time, f64::from(event.kind as u8), event.number as f64, f64::from(event.sign)];
    let events: Vec<f64> = response.events.iter().flatten().flat_map(event).collect();
    let none = seismass::Histories::default();
    let histories = response.histories.as_ref().unwrap_or(&none);
    sections(&[
        &[response.end_time, collapsed],
        &drift.0,
        &drift.1,
        &slip.0,
        &slip.1,
        &acceleration.0,
        &acceleration.1,
        &shear.0,
        &shear.1,
        &response.residual_drift,
        &response.residual_slip,
        &response.slip_path,
        &counts,
        &events,
        &histories.drift,
        &histories.slip,
        &histories.storey_force,
    ])
}
