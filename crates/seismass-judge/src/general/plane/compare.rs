//! How far a response in the plane is from a solution.

use seismass::{Axis, Event, EventKind, PlaneEvent, PlaneResponse, VectorPeaks};

use super::record::PlaneSolution;
use crate::compare::{Comparison, difference, larger, scales, values};
use crate::compare_events;
use crate::general::compare::{apart_by_machine, compare_beside, solution_of};
use crate::general::record::GeneralSolution;

/// Directions, vectors and events of a run in the plane.
struct Parts<'a> {
    vector: &'a VectorPeaks,
    slip_path: &'a [f64],
    events: Option<&'a [PlaneEvent]>,
}

/// The events of vectors alone.
fn of_vectors(log: &[PlaneEvent]) -> Vec<PlaneEvent> {
    log.iter().filter(|entry| entry.axis.is_none()).copied().collect()
}

/// Compares a response in the plane with a solution, which is taken as exact: by direction, and of vectors peaks, paths and
/// events. Numbers of a direction count relative to a thousandth of the largest peak of their kind in the other one at least.
/// Angles count where sliding begins; that of a stop depends on when a velocity counts as none.
pub fn compare_plane(response: &PlaneResponse, solution: &PlaneSolution) -> Comparison {
    let of = |axis: Axis, exact: &GeneralSolution, other: &GeneralSolution| {
        let mut direction = response.direction(axis);
        // The path is of the vector.
        direction.slip_path.clone_from(&exact.slip_path);
        compare_beside(&direction, exact, other.least_scales())
    };
    let [x, y] = &solution.directions;
    let events = response.events.as_deref().map(of_vectors);
    let parts = Parts { vector: &response.peaks.vector, slip_path: &response.slip_path, events: events.as_deref() };
    solution.judge_vectors(&parts, of(Axis::X, x, y), of(Axis::Y, y, x))
}

/// A response with events, histories and energies as a solution, to compare another with.
pub fn plane_solution_of(response: &PlaneResponse) -> Option<PlaneSolution> {
    Some(PlaneSolution {
        directions: [solution_of(&response.direction(Axis::X))?, solution_of(&response.direction(Axis::Y))?],
        vector: response.peaks.vector.clone(),
        slip_path: response.slip_path.clone(),
        events: of_vectors(response.events.as_deref()?),
    })
}

fn lists(peaks: &VectorPeaks) -> [Vec<f64>; 5] {
    let VectorPeaks { drift, acceleration, shear, base_shear, slip } = peaks;
    [values(drift), values(slip), values(acceleration), values(shear), vec![base_shear.value]]
}

/// Largest difference of the velocities of events, and of the angles at which sliding begins, block by block in order.
fn events_apart(found: &[PlaneEvent], expected: &[PlaneEvent]) -> f64 {
    let sorted = |log: &[PlaneEvent]| {
        let mut log = log.to_vec();
        log.sort_by_key(|entry| (entry.event.event.number, entry.event.event.kind as usize));
        log
    };
    let (found, expected) = (sorted(found), sorted(expected));
    let largest = expected.iter().fold(1e-3f64, |most, entry| most.max(entry.event.velocity));
    found.iter().zip(&expected).fold(0.0, |worst, (f, e)| {
        let begins = matches!(e.event.event.kind, EventKind::Slip | EventKind::Reverse);
        let turn = if begins { (f.angle - e.angle).sin().abs() } else { 0.0 };
        larger(worst, larger(turn, (f.event.velocity - e.event.velocity).abs() / largest))
    })
}

impl PlaneSolution {
    /// Compares another solution with this one, taken as exact.
    pub fn judge(&self, other: &Self) -> Comparison {
        let parts = Parts { vector: &other.vector, slip_path: &other.slip_path, events: Some(&other.events) };
        let of = |a: usize| {
            let mut direction = other.directions[a].clone();
            direction.slip_path.clone_from(&self.directions[a].slip_path);
            self.directions[a].judge_beside(&direction, self.directions[1 - a].least_scales())
        };
        self.judge_vectors(&parts, of(0), of(1))
    }

    fn judge_vectors(&self, found: &Parts, x: Comparison, y: Comparison) -> Comparison {
        let own = lists(&self.vector);
        let peaks = lists(found.vector);
        let peaks = peaks.iter().zip(&own).map(|(found, own)| difference(found, own, &scales(own))).fold(0.0, larger);
        let expected: Vec<Event> = self.events.iter().map(|entry| entry.event.event).collect();
        let mut of_events = 0.0;
        let events = found.events.map_or(Ok(0.0), |log| {
            let events: Vec<Event> = log.iter().map(|entry| entry.event.event).collect();
            let times = compare_events(&events, &expected).or_else(|mismatch| {
                let times = apart_by_machine(&events, &expected).ok_or(mismatch)?;
                Ok(times.into_iter().fold(0.0, larger))
            });
            if times.is_ok() {
                of_events = events_apart(log, &self.events);
            }
            times
        });
        let both = |of: fn(&Comparison) -> f64| larger(of(&x), of(&y));
        Comparison {
            drift: both(|c| c.drift),
            slip: both(|c| c.slip),
            peaks: larger(both(|c| c.peaks), larger(peaks, of_events)),
            residuals: both(|c| c.residuals),
            slip_path: difference(found.slip_path, &self.slip_path, &scales(&self.slip_path)),
            event_time: larger(both(|c| c.event_time), *events.as_ref().unwrap_or(&f64::NAN)),
            duration: x.duration,
            mismatch: events.err().or(x.mismatch).or(y.mismatch),
        }
    }
}
