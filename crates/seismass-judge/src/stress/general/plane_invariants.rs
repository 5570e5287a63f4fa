//! What must hold for any response in two directions by itself: that of each direction, and friction within its circle.

use std::collections::BTreeMap;

use seismass::{
    Axis, Event, EventKind, GeneralResponse, PlaneEvent, PlaneMotion, PlaneResponse, PlaneScene, STANDARD_GRAVITY,
    VectorPeaks,
};

use super::invariants::{Walk, energies, laws, numbers, peaks, slips};
use crate::stress::consistency::{ROUNDING, is_of_storey, order, springs};

/// What an event log says about a block.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Contact {
    Stuck,
    Sliding,
    Airborne,
}

/// Checks a response that has events, energies and histories at every sample; the first fault found.
///
/// # Errors
/// The fault, in one line.
pub(super) fn check(scene: &PlaneScene, motion: &PlaneMotion, response: &PlaneResponse) -> Result<(), String> {
    let log = response.events.as_deref().ok_or("no event log")?;
    if log.len() != response.statistics.events.total() {
        return Err(format!("{} events in the log, {} counted", log.len(), response.statistics.events.total()));
    }
    let events: Vec<Event> = log.iter().map(|entry| entry.event.event).collect();
    order(&events, response.end_time * (1.0 + 4.0 * f64::EPSILON))?;
    chatter(log)?;
    let directions = [Axis::X, Axis::Y].map(|axis| response.direction(axis));
    for (a, of) in directions.iter().enumerate() {
        let scene = &scene.directions()[a];
        let fault = |message: String| format!("{}: {message}", ["x", "y"][a]);
        let histories = of.histories.as_ref().ok_or("no histories")?;
        numbers(of, histories).map_err(fault)?;
        let own: Vec<Event> = of.events.iter().flatten().map(|entry| entry.event).collect();
        springs(&laws(scene), &own).map_err(fault)?;
        energies(of).map_err(fault)?;
        peaks(scene, of, histories).map_err(fault)?;
        slips(scene, of).map_err(fault)?;
    }
    vectors(&response.peaks.vector, &directions)?;
    Circles::new(scene, motion, &directions)?.check(response)
}

/// Most events of sliding of one block, and touches of its stops of one direction, within an instant (s): that it starts or
/// stops may release others, once, and a block without clearance goes from stop to stop as what drives it passes through zero.
const MOST_IN_AN_INSTANT: usize = 3;
const INSTANT: f64 = 1e-9;

/// No block starts and stops, or touches, time and again within an instant.
fn chatter(log: &[PlaneEvent]) -> Result<(), String> {
    let mut times: BTreeMap<(usize, Option<bool>), Vec<f64>> = BTreeMap::new();
    for PlaneEvent { event, axis, .. } in log {
        let direction = match event.event.kind {
            EventKind::Slip | EventKind::Stick | EventKind::Reverse => None,
            EventKind::TouchStop => Some(*axis == Some(Axis::Y)),
            _ => continue,
        };
        times.entry((event.event.number, direction)).or_default().push(event.event.time);
    }
    for ((number, direction), times) in times {
        if let Some(several) = times.windows(MOST_IN_AN_INSTANT + 1).find(|w| w[MOST_IN_AN_INSTANT] - w[0] <= INSTANT) {
            let what = if direction.is_none() { "starts and stops" } else { "touches a stop" };
            return Err(format!("block {number} {what} more than {MOST_IN_AN_INSTANT} times at {} s", several[0]));
        }
    }
    Ok(())
}

/// No component at its peak, and no vector at a sample, is longer than the peak of its vector.
fn vectors(vector: &VectorPeaks, [x, y]: &[GeneralResponse; 2]) -> Result<(), String> {
    let (Some(of_x), Some(of_y)) = (&x.histories, &y.histories) else { return Ok(()) };
    for (name, peaks, own, rows) in [
        ("drift", &vector.drift, [&x.peaks.drift, &y.peaks.drift], [&of_x.drift, &of_y.drift]),
        ("slip", &vector.slip, [&x.peaks.slip, &y.peaks.slip], [&of_x.slip, &of_y.slip]),
        (
            "acceleration",
            &vector.acceleration,
            [&x.peaks.acceleration, &y.peaks.acceleration],
            [&of_x.floor_acceleration, &of_y.floor_acceleration],
        ),
        ("shear", &vector.shear, [&x.peaks.shear, &y.peaks.shear], [&of_x.storey_force, &of_y.storey_force]),
    ] {
        for (i, peak) in peaks.iter().enumerate() {
            let (a, b) = (own[0][i].value, own[1][i].value);
            let within = peak.value >= a.max(b) * (1.0 - ROUNDING) && peak.value <= a.hypot(b) * (1.0 + ROUNDING);
            if !within {
                return Err(format!("{name} {} of the vector is {:e} for {a:e} and {b:e}", i + 1, peak.value));
            }
        }
        let values = rows[0].iter().zip(rows[1]).enumerate();
        for (at, (x, y)) in values {
            let peak = peaks[at % peaks.len()].value;
            if x.hypot(*y) > peak * (1.0 + ROUNDING) {
                return Err(format!("{name} {} is ({x:e}, {y:e}), peak {peak:e}", at % peaks.len() + 1));
            }
        }
    }
    Ok(())
}

/// The states of all blocks from sample to sample, and those of their stops in each direction.
struct Circles<'a> {
    scene: &'a PlaneScene,
    motion: &'a PlaneMotion,
    directions: &'a [GeneralResponse; 2],
    stops: [Walk<'a>; 2],
    contact: Vec<Contact>,
    last_change: Vec<f64>,
    mu_s: Vec<f64>,
}

impl<'a> Circles<'a> {
    fn new(
        scene: &'a PlaneScene,
        motion: &'a PlaneMotion,
        directions: &'a [GeneralResponse; 2],
    ) -> Result<Self, String> {
        let walk = |a: usize| {
            let of = &directions[a];
            let histories = of.histories.as_ref().ok_or("no histories")?;
            Ok::<_, String>(Walk::new(&scene.directions()[a], &motion.directions()[a], of, histories))
        };
        let stops = [walk(0)?, walk(1)?];
        let vertical = motion.directions()[0].vertical().map_or([0.0; 2], |v| [v[0], v[1.min(v.len() - 1)]]);
        let at_start = vertical.map(|v| STANDARD_GRAVITY + v);
        let airborne = at_start[0] < 0.0 || at_start[0] == 0.0 && at_start[1] <= 0.0;
        let mu_s: Vec<f64> = scene.directions()[0].all_goods().map(|goods| goods.block.mu_s).collect();
        let contact = |j: usize| match stops.each_ref().map(|walk| walk.relative(j, 0)) {
            _ if airborne => Contact::Airborne,
            // What has no friction is never held.
            [0.0, 0.0] if mu_s[j] > 0.0 => Contact::Stuck,
            _ => Contact::Sliding,
        };
        let contact: Vec<Contact> = (0..mu_s.len()).map(contact).collect();
        let last_change = vec![f64::NEG_INFINITY; mu_s.len()];
        Ok(Self { scene, motion, directions, stops, contact, last_change, mu_s })
    }

    fn check(&mut self, response: &PlaneResponse) -> Result<(), String> {
        let log = response.events.as_deref().unwrap_or_default();
        let mut events = log.iter().filter(|entry| !is_of_storey(entry.event.event.kind)).peekable();
        let motion = &self.motion.directions()[0];
        let rows = response.histories.as_ref().map_or(0, |histories| histories[0].rows);
        for row in 0..rows {
            let time = row as f64 * motion.dt();
            if time > response.end_time || row >= motion.acceleration().len() {
                break;
            }
            while let Some(entry) = events.next_if(|entry| entry.event.event.time <= time) {
                self.carry_out(entry)?;
            }
            for j in 0..self.contact.len() {
                let fault = |message: String| format!("block {} at t = {time} s: {message}", j + 1);
                self.friction(j, row).map_err(fault)?;
                for (walk, scene) in self.stops.iter().zip(self.scene.directions()) {
                    let stops = scene.all_goods().nth(j).and_then(|goods| goods.stops.as_ref());
                    stops.map_or(Ok(()), |stops| walk.stop(j, row, stops)).map_err(fault)?;
                }
            }
        }
        events.try_for_each(|entry| self.carry_out(entry))
    }

    fn carry_out(&mut self, entry: &PlaneEvent) -> Result<(), String> {
        let event = &entry.event.event;
        let j = event.number - 1;
        self.last_change[j] = event.time;
        if let Some(axis) = entry.axis {
            return self.stops[usize::from(axis == Axis::Y)].carry_out(event);
        }
        let before = self.contact[j];
        self.contact[j] = match (event.kind, before) {
            (EventKind::Slip, Contact::Stuck) | (EventKind::Reverse, Contact::Sliding) => Contact::Sliding,
            (EventKind::Stick, Contact::Sliding) => Contact::Stuck,
            (EventKind::Lift, Contact::Stuck | Contact::Sliding) => Contact::Airborne,
            // At rest it sticks unless a slip follows at once.
            (EventKind::Land, Contact::Airborne) if entry.event.velocity == 0.0 && self.mu_s[j] > 0.0 => Contact::Stuck,
            (EventKind::Land, Contact::Airborne) => Contact::Sliding,
            (EventKind::Wear, Contact::Sliding) => {
                let stage = usize::from(event.element) - 1;
                let goods = self.scene.directions()[0].all_goods().nth(j).ok_or("an event of no block")?;
                self.mu_s[j] = goods.block.wear[stage].mu_s;
                Contact::Sliding
            }
            _ => return Err(format!("block machine: {event:?} while {before:?}")),
        };
        Ok(())
    }

    /// A stuck block does not move, nor creep, nor is it driven by more than friction holds.
    fn friction(&self, j: usize, row: usize) -> Result<(), String> {
        if self.contact[j] != Contact::Stuck {
            return Ok(());
        }
        let relative = self.stops.each_ref().map(|walk| walk.relative(j, row));
        if relative != [0.0; 2] {
            return Err(format!("stuck with relative velocity {relative:?}"));
        }
        let of_time = &self.motion.directions()[0];
        let time = row as f64 * of_time.dt();
        if row > 0 && self.last_change[j] < time - of_time.dt() {
            let slip = [row - 1, row].map(|row| self.stops.each_ref().map(|walk| walk.slip(j, row)));
            if slip[0] != slip[1] {
                return Err(format!("creeps from {:?} to {:?}", slip[0], slip[1]));
            }
        }
        let limit = self.mu_s[j] * (STANDARD_GRAVITY + of_time.vertical().map_or(0.0, |v| v[row]));
        let (mut driven, mut size) = ([0.0; 2], limit.abs() + self.mu_s[j] * STANDARD_GRAVITY);
        for a in 0..2 {
            let walk = &self.stops[a];
            let ground = self.motion.directions()[a].acceleration()[row];
            let of_node = |node: usize| {
                let response = &self.directions[a];
                let histories = response.histories.as_ref()?;
                let at = row * self.scene.directions()[0].nodes() + node;
                Some((histories.floor_acceleration[at], response.peaks.acceleration[node].value))
            };
            let (acceleration, largest) = walk.node[j].and_then(of_node).unwrap_or((ground, ground.abs()));
            let push = walk.push(j, row);
            driven[a] = acceleration + push;
            size += largest + push.abs();
        }
        let driven = driven[0].hypot(driven[1]);
        if driven > limit + ROUNDING * size {
            Err(format!("stuck at {driven:e}, limit {limit:e} m/s2"))
        } else {
            Ok(())
        }
    }
}
