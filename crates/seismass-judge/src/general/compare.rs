//! How far the general engine's response is from a solution, and from the chain engine's response.

use std::collections::BTreeSet;

use seismass::{
    Event, EventKind, GeneralBase, GeneralEvent, GeneralPeaks, GeneralResponse, GeneralStatus, Peak, Peaks, Response,
    Status,
};

use super::record::GeneralSolution;
use crate::compare::{Comparison, LEAST_PART, compare_endings, compare_events, difference, larger, scales, values};

/// Velocities at stops and of events count relative to the largest, and to this at least (m/s).
const LEAST_VELOCITY: f64 = 1e-3;
/// Kinds of peaks.
pub(crate) const KINDS: usize = 9;
/// Of them, those of forces.
const FORCES: std::ops::Range<usize> = 3..6;
/// Of them, that of velocities at stops.
const VELOCITIES: usize = 6;
/// Of them, the slip of the base.
const BASE_SLIP: usize = 7;

/// Drift, slip, acceleration, shear and base shear, contact force, contact velocity, slip and acceleration of the base.
fn lists(peaks: &GeneralPeaks, base: Option<&GeneralBase>) -> [Vec<f64>; KINDS] {
    let GeneralPeaks { drift, acceleration, shear, base_shear, slip, contact_force, contact_velocity } = peaks;
    let own = |list: &[Peak]| values(list);
    let [shear_at_base, contact, velocity] = [&[*base_shear][..], contact_force, contact_velocity].map(own);
    let [of_slip, of_acceleration] = [|base: &GeneralBase| base.slip, |base: &GeneralBase| base.acceleration]
        .map(|peak| own(base.map(peak).as_slice()));
    [own(drift), own(slip), own(acceleration), own(shear), shear_at_base, contact, velocity, of_slip, of_acceleration]
}

/// The ending as one of the chain engine.
fn ending(status: GeneralStatus) -> Status {
    match status {
        GeneralStatus::Completed => Status::Completed,
        GeneralStatus::Collapsed { number, time } => Status::Collapsed { storey: number, time },
    }
}

/// The events alone.
fn events_of(log: &[GeneralEvent]) -> Vec<Event> {
    log.iter().map(|entry| entry.event).collect()
}

/// For each spring and block that has events, how far apart their times are (s); nothing if one has not the same events in
/// both logs. What happens to different ones may have changed places.
pub(crate) fn apart_by_machine(found: &[Event], expected: &[Event]) -> Option<Vec<f64>> {
    use EventKind::{Close, Open, Reload, Unload, Yield};
    let of_spring = |kind| matches!(kind, Yield | Unload | Reload | Close | Open);
    let machine = |event: &Event| (of_spring(event.kind), event.number);
    let machines: BTreeSet<_> = found.iter().chain(expected).map(machine).collect();
    let apart = |one| {
        let of_one = |log: &[Event]| log.iter().filter(|event| machine(event) == one).copied().collect::<Vec<Event>>();
        compare_events(&of_one(found), &of_one(expected)).ok()
    };
    machines.into_iter().map(apart).collect()
}

/// What is compared of a response or a solution.
struct Parts<'a> {
    status: GeneralStatus,
    peaks: &'a GeneralPeaks,
    residual_drift: &'a [f64],
    residual_slip: &'a [f64],
    slip_path: &'a [f64],
    histories: Option<(&'a [f64], &'a [f64])>,
    base: Option<&'a GeneralBase>,
    events: Option<&'a [GeneralEvent]>,
}

impl GeneralSolution {
    /// Compares another solution with this one, taken as exact.
    pub fn judge(&self, other: &Self) -> Comparison {
        self.judge_beside(other, [0.0; KINDS])
    }

    /// Compares another solution with this one, with least scales by kind of peak.
    pub(crate) fn judge_beside(&self, other: &Self, least: [f64; KINDS]) -> Comparison {
        let found = Parts {
            status: other.status,
            peaks: &other.peaks,
            residual_drift: &other.residual_drift,
            residual_slip: &other.residual_slip,
            slip_path: &other.slip_path,
            histories: Some((&other.drift, &other.slip)),
            base: other.base.as_ref(),
            events: Some(&other.events),
        };
        self.judge_parts(&found, least)
    }

    /// What counts at least of a peak that is compared beside those of this solution, by kind. Forces are of one kind: a stop
    /// may be touched in one direction alone.
    pub(crate) fn least_scales(&self) -> [f64; KINDS] {
        let mut least =
            lists(&self.peaks, self.base.as_ref()).map(|peaks| LEAST_PART * peaks.into_iter().fold(0.0, f64::max));
        let largest = least[FORCES].iter().copied().fold(0.0, f64::max);
        least[FORCES].fill(largest);
        least
    }

    fn judge_parts(&self, found: &Parts, mut least: [f64; KINDS]) -> Comparison {
        let own = lists(&self.peaks, self.base.as_ref());
        let peaks = lists(found.peaks, found.base);
        // A stop that is touched at rest has no velocity but rounding.
        least[VELOCITIES] = least[VELOCITIES].max(LEAST_VELOCITY);
        let scales_of = |(own, least): (&Vec<f64>, f64)| scales(own).into_iter().map(move |s| s.max(least)).collect();
        let all: Vec<Vec<f64>> = own.iter().zip(least).map(scales_of).collect();
        let (drift_scale, slip_scale) = (&all[0], &all[1]);
        let peaks = peaks.iter().zip(&own).zip(&all).map(|((found, own), scales)| difference(found, own, scales));
        let of_base = |value: fn(&GeneralBase) -> &[f64], scales: &[f64]| {
            let [found, own] = [found.base, self.base.as_ref()].map(|base| base.map_or(&[][..], value));
            difference(found, own, scales)
        };
        let residual_of_base = of_base(|base| std::slice::from_ref(&base.residual_slip), &all[BASE_SLIP]);
        let residuals = [
            difference(found.residual_drift, &self.residual_drift, drift_scale),
            difference(found.residual_slip, &self.residual_slip, slip_scale),
            residual_of_base,
        ];
        let (drift, slip) = found.histories.map_or((0.0, 0.0), |(drift, slip)| {
            let slip_of_base = of_base(|base| &base.history, &all[BASE_SLIP]);
            let slip = larger(difference(slip, &self.slip, slip_scale), slip_of_base);
            (difference(drift, &self.drift, drift_scale), slip)
        });
        let own_path = self.base.as_ref().map_or(0.0, |base| base.slip_path);
        let path_of_base = of_base(|base| std::slice::from_ref(&base.slip_path), &[own_path]);
        let slip_path = difference(found.slip_path, &self.slip_path, &scales(&self.slip_path));
        let expected = events_of(&self.events);
        let events = found.events.map_or(Ok(0.0), |events| {
            let found = events_of(events);
            // What happens to different springs and blocks within the tolerance of times has no order.
            compare_events(&found, &expected).or_else(|mismatch| {
                let times = apart_by_machine(&found, &expected).ok_or(mismatch)?;
                Ok(times.into_iter().fold(0.0, larger))
            })
        });
        let ending = compare_endings(&ending(found.status), &ending(self.status));
        let event_time = larger(*events.as_ref().unwrap_or(&f64::NAN), *ending.as_ref().unwrap_or(&f64::NAN));
        let velocities = match (&events, found.events) {
            (Ok(_), Some(log)) => self.velocities(log),
            _ => 0.0,
        };
        Comparison {
            drift,
            slip,
            peaks: peaks.fold(velocities, larger),
            residuals: residuals.into_iter().fold(0.0, larger),
            slip_path: larger(slip_path, path_of_base),
            event_time,
            duration: self.end_time,
            mismatch: ending.err().or(events.err()),
        }
    }

    /// Largest difference of the velocities of events, block by block and kind by kind in order, over the largest.
    fn velocities(&self, log: &[GeneralEvent]) -> f64 {
        let sorted = |log: &[GeneralEvent]| {
            let mut log = log.to_vec();
            log.sort_by_key(|entry| (entry.event.number, entry.event.kind as usize));
            log.iter().map(|entry| entry.velocity).collect::<Vec<f64>>()
        };
        let (found, own) = (sorted(log), sorted(&self.events));
        let largest = own.iter().fold(0.0f64, |most, v| larger(most, v.abs())).max(LEAST_VELOCITY);
        difference(&found, &own, &[largest])
    }
}

/// Compares the general engine's response with a solution, which is taken as exact. Histories need the same decimation;
/// what the response was not asked for is not compared.
pub fn compare_general(response: &GeneralResponse, solution: &GeneralSolution) -> Comparison {
    compare_beside(response, solution, [0.0; KINDS])
}

/// As [`compare_general`], with least scales by kind of peak.
pub(crate) fn compare_beside(
    response: &GeneralResponse,
    solution: &GeneralSolution,
    least: [f64; KINDS],
) -> Comparison {
    let found = Parts {
        status: response.status,
        peaks: &response.peaks,
        residual_drift: &response.residual_drift,
        residual_slip: &response.residual_slip,
        slip_path: &response.slip_path,
        histories: response.histories.as_ref().map(|h| (&h.drift[..], &h.slip[..])),
        base: response.base.as_ref(),
        events: response.events.as_deref(),
    };
    solution.judge_parts(&found, least)
}

/// A response with events, histories and energies as a solution, to compare another with.
pub fn solution_of(response: &GeneralResponse) -> Option<GeneralSolution> {
    let histories = response.histories.as_ref()?;
    Some(GeneralSolution {
        status: response.status,
        end_time: response.end_time,
        every: histories.every,
        drift: histories.drift.clone(),
        slip: histories.slip.clone(),
        peaks: response.peaks.clone(),
        residual_drift: response.residual_drift.clone(),
        residual_slip: response.residual_slip.clone(),
        slip_path: response.slip_path.clone(),
        base: response.base.clone(),
        events: response.events.clone()?,
        energy: response.energy?,
    })
}

/// The response of the general engine to a shear building in the place of one of the chain engine; paths are those in contact
/// alone.
pub fn as_chain(general: GeneralResponse, chain: &Response) -> Response {
    let (peaks, mut response) = (general.peaks, chain.clone());
    response.status = ending(general.status);
    response.end_time = general.end_time;
    response.peaks = Peaks {
        drift: peaks.drift,
        slip: peaks.slip,
        floor_acceleration: peaks.acceleration,
        storey_shear: peaks.shear,
    };
    (response.residual_drift, response.residual_slip) = (general.residual_drift, general.residual_slip);
    response.slip_path = general.slip_path;
    response.events = general.events.map(|events| events_of(&events));
    (response.histories, response.energy) = (general.histories, None);
    response.statistics = general.statistics;
    response
}
