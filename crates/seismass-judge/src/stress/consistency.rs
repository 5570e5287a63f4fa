//! What must hold for any response by itself: numbers, legal sequences of events, and states that fit the histories.

use std::num::NonZeroUsize;

use seismass::{
    Error, Event, EventKind, Histories, Motion, Options, Peaks, Response, STANDARD_GRAVITY, Scene, SpringLaw, Status,
    simulate,
};

use crate::larger;

/// Rounding of floor accelerations and relative velocities in the histories, as a fraction of their peaks.
pub(super) const ROUNDING: f64 = 1e-9;

/// What an event log says about a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Contact {
    Stuck,
    Sliding(i8),
    Airborne,
    /// Landed at rest: sticks unless a slip follows at once.
    Landed,
}

/// Checks a response that has events and histories at every sample; the first fault found.
///
/// # Errors
/// The fault, in one line.
pub fn check(scene: &Scene, motion: &Motion, response: &Response) -> Result<(), String> {
    numbers(response)?;
    let log = response.events.as_deref().ok_or("no event log")?;
    if log.len() != response.statistics.events.total() {
        return Err(format!("{} events in the log, {} counted", log.len(), response.statistics.events.total()));
    }
    order(log, last_instant(response))?;
    springs(&laws(scene), log)?;
    blocks(scene, motion, response, log)?;
    peaks(scene, response)
}

/// Whether what else is asked for changes a bit of a run with energies: without them plain steps are taken many at a time,
/// and without histories blocks on the ground run ahead of them.
pub fn check_others(scene: &Scene, motion: &Motion, response: &Response) -> Result<(), String> {
    let options = Options { histories: NonZeroUsize::new(1), events: true, ..Options::default() };
    for (histories, without) in [(true, "energies"), (false, "energies and histories")] {
        let options = if histories { options } else { Options { histories: None, ..options } };
        let other = simulate(scene, motion, &options).map_err(|error| format!("without {without}: {error}"))?;
        let same = bits(&other.residual_drift) == bits(&response.residual_drift)
            && bits(&other.residual_slip) == bits(&response.residual_slip)
            && (&other.peaks, &other.slip_path, other.end_time)
                == (&response.peaks, &response.slip_path, response.end_time)
            && (&other.events, other.status) == (&response.events, response.status);
        if !same || histories && !same_histories(&other, response) {
            return Err(format!("other bits without {without}"));
        }
    }
    Ok(())
}

/// Whether peaks are the same to the bit where they alone are asked for, under the motion with as long a quiet tail, in
/// which a run for peaks alone may stop.
pub fn check_peaks_alone(scene: &Scene, motion: &Motion) -> Result<(), String> {
    let fault = |error: Error| format!("with a quiet tail: {error}");
    let duration = 2.0 * motion.acceleration().len() as f64 * motion.dt();
    let motion = motion.with_duration(duration).map_err(fault)?;
    let run = |peaks_only| simulate(scene, &motion, &Options { peaks_only, ..Options::default() });
    let (whole, short) = (run(false).map_err(fault)?, run(true).map_err(fault)?);
    same_peaks(&short.peaks, &whole.peaks)?;
    if short.status == whole.status { Ok(()) } else { Err("another ending for peaks alone".into()) }
}

/// The first peak that is not the same for peaks alone, be it in its value or its time.
fn same_peaks(found: &Peaks, expected: &Peaks) -> Result<(), String> {
    let lists =
        |of: &Peaks| [of.drift.clone(), of.slip.clone(), of.floor_acceleration.clone(), of.storey_shear.clone()];
    let names = ["drift", "slip", "floor acceleration", "storey shear"];
    for (name, (found, expected)) in names.iter().zip(lists(found).iter().zip(&lists(expected))) {
        if let Some(i) = (0..expected.len()).find(|&i| found[i] != expected[i]) {
            return Err(format!("for peaks alone {name} {} is {:?} for {:?}", i + 1, found[i], expected[i]));
        }
    }
    Ok(())
}

fn same_histories(one: &Response, other: &Response) -> bool {
    let (Some(one), Some(other)) = (&one.histories, &other.histories) else { return false };
    let all = |of: &Histories| {
        let lists =
            [&of.drift, &of.slip, &of.floor_velocity, &of.block_velocity, &of.floor_acceleration, &of.storey_force];
        lists.map(|values| bits(values))
    };
    all(one) == all(other)
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

fn numbers(response: &Response) -> Result<(), String> {
    let peaks = &response.peaks;
    let lists = [&peaks.drift, &peaks.slip, &peaks.floor_acceleration, &peaks.storey_shear];
    for (name, list) in ["drift", "slip", "floor acceleration", "storey shear"].iter().zip(lists) {
        for (i, peak) in list.iter().enumerate() {
            let in_time = peak.time >= 0.0 && peak.time <= last_instant(response);
            if !(peak.value.is_finite() && in_time) {
                return Err(format!("peak {name} {}: {peak:?}", i + 1));
            }
        }
    }
    let lists = [&response.residual_drift, &response.residual_slip, &response.slip_path];
    for (name, list) in ["residual drift", "residual slip", "slip path"].iter().zip(lists) {
        if let Some(i) = list.iter().position(|value| !value.is_finite()) {
            return Err(format!("{name} {}: {}", i + 1, list[i]));
        }
    }
    let Some(h) = &response.histories else { return Ok(()) };
    let lists = [&h.drift, &h.slip, &h.floor_velocity, &h.block_velocity, &h.floor_acceleration, &h.storey_force];
    let finite = lists.iter().all(|list| list.iter().all(|value| value.is_finite()));
    if finite || response.status != Status::Completed { Ok(()) } else { Err("histories that are not finite".into()) }
}

/// The end of the run; the last sample's time is a product, an event's a sum.
fn last_instant(response: &Response) -> f64 {
    response.end_time * (1.0 + 4.0 * f64::EPSILON)
}

pub(super) fn order(log: &[Event], end: f64) -> Result<(), String> {
    let mut before = 0.0;
    for event in log {
        if !(event.time >= before && event.time <= end) {
            return Err(format!("out of order in time: {event:?} after {before} s"));
        }
        before = event.time;
    }
    Ok(())
}

/// What an event log says about a storey.
#[derive(Debug, Clone, Copy, Default)]
struct Storey {
    /// Elements that yield, or 1 on a branch of the backbone and on the way to it; 0 where the spring unloads.
    loaded: u8,
    /// Direction of loading.
    sign: i8,
    /// Direction of the stop that touches.
    closed: i8,
    /// Whether the spring has left the line through the origin.
    has_yielded: bool,
}

fn laws(scene: &Scene) -> Vec<&SpringLaw> {
    scene.building().map_or(Vec::new(), |building| building.storeys().iter().map(|storey| &storey.law).collect())
}

/// Whether an event is of a storey, not of a block.
pub(super) fn is_of_storey(kind: EventKind) -> bool {
    use EventKind::{Close, Open, Reload, Unload, Yield};
    matches!(kind, Yield | Unload | Reload | Close | Open)
}

/// Per storey: elements yield one after the other with one sign, and unload together; stops touch and are left in turn;
/// a peak-oriented spring unloads from where it is loaded, and reloads from where it unloads.
pub(super) fn springs(laws: &[&SpringLaw], log: &[Event]) -> Result<(), String> {
    let mut storeys = vec![Storey::default(); laws.len()];
    for event in log.iter().filter(|event| is_of_storey(event.kind)) {
        let (i, sign) = (event.number - 1, event.sign);
        let storey = &mut storeys[i];
        let law = laws[i];
        let legal = match (event.kind, law) {
            (_, SpringLaw::FlagShaped { .. }) => sign != 0,
            (EventKind::Close, SpringLaw::Gap { .. }) => std::mem::replace(&mut storey.closed, sign) == 0 && sign != 0,
            (EventKind::Open, SpringLaw::Gap { .. }) => std::mem::replace(&mut storey.closed, 0) == sign && sign != 0,
            (EventKind::Yield, SpringLaw::PeakOriented(_)) => {
                let legal = !storey.has_yielded || storey.loaded > 0 && storey.sign == sign;
                *storey = Storey { loaded: 1, sign, has_yielded: true, ..*storey };
                legal
            }
            (EventKind::Reload, SpringLaw::PeakOriented(_)) => {
                let legal = storey.has_yielded && storey.loaded == 0;
                *storey = Storey { loaded: 1, sign, ..*storey };
                legal
            }
            (EventKind::Yield, _) => {
                let follows = event.element == storey.loaded + 1 && (storey.loaded == 0 || storey.sign == sign);
                *storey = Storey { loaded: event.element, sign, has_yielded: true, ..*storey };
                follows
            }
            (EventKind::Unload, _) => std::mem::take(&mut storey.loaded) > 0 && storey.sign == sign,
            _ => false,
        };
        if !legal {
            return Err(format!("storey machine: {event:?}"));
        }
    }
    Ok(())
}

fn at_start(scene: &Scene, motion: &Motion) -> Vec<Contact> {
    let contact = motion
        .vertical()
        .map_or([STANDARD_GRAVITY; 2], |v| [STANDARD_GRAVITY + v[0], STANDARD_GRAVITY + v[1.min(v.len() - 1)]]);
    let airborne = contact[0] < 0.0 || contact[0] == 0.0 && contact[1] <= contact[0];
    let relative = |floor: usize| if floor > 0 { scene.initial_velocity()[floor - 1] } else { 0.0 };
    let state = |b: &seismass::Block| match b.velocity.map_or(0.0, |w| w - relative(b.floor)) {
        _ if airborne => Contact::Airborne,
        0.0 => Contact::Stuck,
        v => Contact::Sliding(if v > 0.0 { 1 } else { -1 }),
    };
    scene.blocks().iter().map(state).collect()
}

pub(super) fn step(before: Contact, event: &Event) -> Option<Contact> {
    let sign = event.sign;
    match (event.kind, before) {
        (EventKind::Slip, Contact::Stuck | Contact::Landed) if sign != 0 => Some(Contact::Sliding(sign)),
        (EventKind::Stick, Contact::Sliding(old)) if old == sign => Some(Contact::Stuck),
        (EventKind::Reverse, Contact::Sliding(old)) if old == -sign => Some(Contact::Sliding(sign)),
        (EventKind::Touch, Contact::Sliding(old)) if old == sign => Some(Contact::Sliding(sign)),
        (EventKind::Lift, Contact::Stuck | Contact::Landed) if sign == 0 => Some(Contact::Airborne),
        (EventKind::Lift, Contact::Sliding(old)) if sign == old || sign == 0 => Some(Contact::Airborne),
        (EventKind::Land, Contact::Airborne) if sign == 0 => Some(Contact::Landed),
        (EventKind::Land, Contact::Airborne) => Some(Contact::Sliding(sign)),
        (EventKind::Wear, Contact::Sliding(old)) if old == sign => Some(before),
        _ => None,
    }
}

/// Per block: the sequence of events, and at every sample what its state demands.
fn blocks(scene: &Scene, motion: &Motion, response: &Response, log: &[Event]) -> Result<(), String> {
    let mut state = at_start(scene, motion);
    let Some(h) = &response.histories else { return Ok(()) };
    let (n, m) = (scene.storeys(), scene.blocks().len());
    let fastest = h.block_velocity.iter().chain(&h.floor_velocity).fold(0.0, |most, v| larger(most, v.abs()));
    let mut events = log.iter().filter(|event| !is_of_storey(event.kind)).peekable();
    let mut last_change = vec![f64::NEG_INFINITY; m];
    let mut mu_s: Vec<f64> = scene.blocks().iter().map(|block| block.mu_s).collect();
    for row in 0..h.rows {
        let time = row as f64 * motion.dt();
        if time > response.end_time || row * h.every >= motion.acceleration().len() {
            break;
        }
        while let Some(event) = events.next_if(|e| e.time <= time) {
            let j = event.number - 1;
            state[j] = step(state[j], event).ok_or_else(|| format!("block machine: {event:?} while {:?}", state[j]))?;
            last_change[j] = event.time;
            if event.kind == EventKind::Wear {
                mu_s[j] = scene.blocks()[j].wear[usize::from(event.element) - 1].mu_s;
            }
        }
        for (j, block) in scene.blocks().iter().enumerate() {
            let (velocity, acceleration, largest) = if block.floor > 0 {
                let at = row * n + block.floor - 1;
                let peak = response.peaks.floor_acceleration[block.floor - 1].value;
                (h.floor_velocity[at], h.floor_acceleration[at], peak)
            } else {
                let a = motion.acceleration()[row];
                (0.0, a, a.abs())
            };
            let relative = h.block_velocity[row * m + j] - velocity;
            let sample = |message: String| Err(format!("block {} at t = {time} s: {message}", j + 1));
            match state[j] {
                Contact::Stuck | Contact::Landed => {
                    if relative != 0.0 {
                        return sample(format!("stuck with relative velocity {relative:e}"));
                    }
                    if row > 0 && last_change[j] < time - motion.dt() {
                        let slip = [h.slip[(row - 1) * m + j], h.slip[row * m + j]];
                        if slip[0] != slip[1] {
                            return sample(format!("creeps from {} to {}", slip[0], slip[1]));
                        }
                    }
                    let contact = STANDARD_GRAVITY + motion.vertical().map_or(0.0, |v| v[row]);
                    let limit = mu_s[j] * contact;
                    if acceleration.abs() > limit + ROUNDING * (limit.abs() + mu_s[j] * STANDARD_GRAVITY + largest) {
                        return sample(format!("stuck at {acceleration:e}, limit {limit:e} m/s2"));
                    }
                }
                Contact::Sliding(sign) => {
                    if f64::from(sign) * relative < -ROUNDING * fastest {
                        return sample(format!("slides with sign {sign} at {relative:e} m/s"));
                    }
                }
                Contact::Airborne => {}
            }
        }
    }
    for event in events {
        let j = event.number - 1;
        state[j] = step(state[j], event).ok_or_else(|| format!("block machine: {event:?} while {:?}", state[j]))?;
    }
    Ok(())
}

/// No sample may beat a peak of continuous time.
fn peaks(scene: &Scene, response: &Response) -> Result<(), String> {
    let Some(h) = &response.histories else { return Ok(()) };
    let (n, m) = (scene.storeys(), scene.blocks().len());
    let lists = [
        ("drift", &h.drift, &response.peaks.drift, n),
        ("slip", &h.slip, &response.peaks.slip, m),
        ("floor acceleration", &h.floor_acceleration, &response.peaks.floor_acceleration, n),
        ("storey shear", &h.storey_force, &response.peaks.storey_shear, n),
    ];
    for (name, values, peaks, width) in lists {
        for (i, value) in values.iter().enumerate() {
            let peak = peaks[i % width].value;
            if value.abs() > peak * (1.0 + ROUNDING) {
                return Err(format!("{name} {} is {value:e} at sample {}, peak {peak:e}", i % width + 1, i / width));
            }
        }
    }
    Ok(())
}
