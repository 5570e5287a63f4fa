//! Where the logs of kernel and judge differ by pairs of events at a graze alone: each pair is shown to be one.
//!
//! A spring that turns at its yield force within rounding either yields and unloads at once or does neither, and so
//! do other guards that only just touch zero. An undamped storey may do so in every cycle of its vibration whatever
//! the input is: yielding has cut the vibration down to the elastic range, so that a change of the input changes both
//! alike. What decides each of these grazes is the rounding of the state on the way there. So the judge is run in
//! double-double with its state changed, just before the pair, in the last digits of a double: the input of the step
//! in which it happens. The pair is a graze if the judge thus comes to have it, or to lack it.
//!
//! The criterion, in full:
//!
//! 1. Both runs end alike and agree in all numbers, and without the pairs both logs have the same events at the same
//!    times.
//! 2. Each pair leaves its storey or block as it was, within a thousandth of a sample interval.
//! 3. For each pair there is a changed run of the judge, with the numbers of the unchanged one, that differs from the
//!    unchanged one by this pair. The pairs need not all come or go in the same changed run, since rounding decides
//!    each of them anew.
//!
//! A pair whose excursion is beyond some tens of last digits stays, and an event by itself is no pair: both are
//! defects.

use seismass::{Event, EventKind, Motion, Response, Scene};

use super::verdict::{AGREEMENT, LAST_DIGITS, TRIALS, Verdict};
use crate::compare::compare_endings;
use crate::random_scene::Draw;
use crate::solve::solve_disturbed;
use crate::state::State;
use crate::{Comparison, DoubleDouble, Real, Solution, compare_events};

/// Events of the same kind this close, in sample intervals, are the same event; a pair lasts no longer.
const SAME: f64 = 1e-3;
/// A pair that has moved by less than this, in sample intervals, has not gone.
const NEAR: f64 = 1e-2;

/// Two events of a storey or block, one right after the other, that leave it as it was.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Pair {
    opening: Event,
    closing: Event,
}

/// The pairs that only one of two logs has.
#[derive(Debug, Clone, Default)]
struct Pairs {
    extra: Vec<Pair>,
    missing: Vec<Pair>,
    /// How far apart the other events are (s).
    apart: f64,
}

/// The verdict if kernel and judge differ by pairs of events at a graze alone.
pub(super) fn explain(
    scene: &Scene,
    motion: &Motion,
    response: &Response,
    exact: &Solution,
    parted: &Comparison,
) -> Option<Verdict> {
    let rounding = AGREEMENT * exact.end_time;
    let endings = compare_endings(&response.status, &exact.status).ok()?;
    let pairs = differing_pairs(response.events.as_deref()?, &exact.events, motion.dt())?;
    if !(parted.worst() <= AGREEMENT && endings <= rounding && pairs.apart <= rounding) {
        return None;
    }
    let digits = shown(scene, motion, exact, pairs.clone())?;
    let all = || pairs.extra.iter().chain(&pairs.missing);
    let longest = all().fold(0.0, |most, pair| f64::max(most, pair.closing.time - pair.opening.time));
    let first = all().fold(f64::INFINITY, |first, pair| first.min(pair.opening.time));
    let difference = format!(
        "pairs of events that only the kernel has: {}, only the judge: {}; the first at {first} s, the longest {longest:.1e} s; \
         all numbers agree to {:.0e}, all other times to {:.0e} s",
        pairs.extra.len(),
        pairs.missing.len(),
        parted.worst(),
        pairs.apart,
    );
    Some(Verdict::GrazingPairs { digits, difference })
}

/// The change of the state, in last digits, within which each pair comes or goes.
fn shown(scene: &Scene, motion: &Motion, exact: &Solution, mut left: Pairs) -> Option<f64> {
    let dt = motion.dt();
    for digits in LAST_DIGITS {
        for trial in 0..TRIALS {
            let before = |pair: &Pair| (pair.opening.time - SAME * dt).max(0.0);
            let instants: Vec<f64> = left.extra.iter().chain(&left.missing).map(before).collect();
            let Some(other) = changed_run(scene, motion, &instants, digits, trial) else { continue };
            let same_numbers = exact.judge(&other).worst() <= AGREEMENT;
            if !same_numbers || compare_endings(&other.status, &exact.status).is_err() {
                continue;
            }
            left.extra.retain(|pair| !has(&other.events, &exact.events, pair, dt));
            left.missing.retain(|pair| !lacks(&other.events, pair, dt));
            if left.extra.is_empty() && left.missing.is_empty() {
                return Some(digits);
            }
        }
    }
    None
}

/// The judge with its state changed by up to `digits` in its last digit at the beginning of the pieces that contain
/// these instants (s).
fn changed_run(scene: &Scene, motion: &Motion, instants: &[f64], digits: f64, trial: u64) -> Option<Solution> {
    // Of two trials, one changes everything the opposite way: whatever a graze hangs on, one of them helps it.
    let mut draw = Draw((trial / 2).wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ digits.to_bits());
    let size = if trial.is_multiple_of(2) { digits } else { -digits } * f64::EPSILON;
    let mut factor = || DoubleDouble::of(1.0) + DoubleDouble::of(draw.between(-size, size));
    let disturb = |[begin, end]: [f64; 2], state: &mut State<DoubleDouble>| {
        if instants.iter().any(|&instant| begin <= instant && instant < end) {
            state.scale(&mut factor);
        }
    };
    solve_disturbed(scene, motion, 1, disturb).ok()
}

/// The pairs that only one of two logs has, if there are any and the logs are the same without them.
fn differing_pairs(found: &[Event], expected: &[Event], dt: f64) -> Option<Pairs> {
    let (extra, found_rest) = split(found, expected, dt)?;
    let (missing, expected_rest) = split(expected, found, dt)?;
    let differ = !extra.is_empty() || !missing.is_empty();
    let apart = compare_events(&found_rest, &expected_rest).ok()?;
    differ.then_some(Pairs { extra, missing, apart })
}

/// The pairs of events that the other log has not, and the log without them; nothing if it has other events that the
/// other log has not.
fn split(log: &[Event], other: &[Event], dt: f64) -> Option<(Vec<Pair>, Vec<Event>)> {
    let alone = alone(log, other, SAME * dt);
    let mut pairs = Vec::new();
    let mut paired = vec![false; log.len()];
    for opening in (0..log.len()).filter(|&i| alone[i]) {
        if paired[opening] {
            continue;
        }
        let of_machine = |i: &usize| machine(&log[*i]) == machine(&log[opening]);
        let closing = (opening + 1..log.len()).find(of_machine).filter(|&i| alone[i])?;
        let before = (0..opening).rfind(of_machine).map(|i| &log[i]);
        let pair = Pair { opening: log[opening], closing: log[closing] };
        if !restores(before, &pair) || pair.closing.time - pair.opening.time > SAME * dt {
            return None;
        }
        paired[opening] = true;
        paired[closing] = true;
        pairs.push(pair);
    }
    let rest = log.iter().zip(&paired).filter(|(_, paired)| !**paired).map(|(event, _)| *event).collect();
    Some((pairs, rest))
}

/// Storey or block, and its number.
pub(super) fn machine(event: &Event) -> (bool, usize) {
    (matches!(event.kind, EventKind::Yield | EventKind::Unload), event.number)
}

/// Whether a pair leaves its machine as it was after the event `before`.
fn restores(before: Option<&Event>, Pair { opening, closing }: &Pair) -> bool {
    let first_yield = |e: &Event| e.kind == EventKind::Yield && e.element == 1;
    let restores = match (opening.kind, closing.kind) {
        (EventKind::Yield, EventKind::Unload) => first_yield(opening),
        (EventKind::Unload, EventKind::Yield) => first_yield(closing) && before.is_some_and(first_yield),
        (EventKind::Slip, EventKind::Stick) | (EventKind::Stick, EventKind::Slip) => true,
        _ => false,
    };
    restores && opening.sign == closing.sign
}

fn same_kind(a: &Event, b: &Event) -> bool {
    (a.kind, a.number, a.sign, a.element) == (b.kind, b.number, b.sign, b.element)
}

/// For each event whether the other log lacks it: an event of the other log stands for one at most.
fn alone(log: &[Event], other: &[Event], tolerance: f64) -> Vec<bool> {
    let mut taken = vec![false; other.len()];
    let mut is_alone = |event: &Event| {
        let from = other.partition_point(|e| e.time < event.time - tolerance);
        let within = other[from..].iter().take_while(|e| e.time <= event.time + tolerance);
        let free = within.zip(from..).find(|(e, i)| !taken[*i] && same_kind(e, event)).map(|(_, i)| i);
        if let Some(i) = free {
            taken[i] = true;
        }
        free.is_none()
    };
    log.iter().map(&mut is_alone).collect()
}

/// Whether a log has the pair in its place, as two events that the other log has not.
fn has(log: &[Event], other: &[Event], pair: &Pair, dt: f64) -> bool {
    let is = |(found, alone): (&Event, bool), event: &Event| {
        alone && same_kind(found, event) && (found.time - event.time).abs() <= SAME * dt
    };
    let with_alone = log.iter().zip(alone(log, other, SAME * dt));
    let of_machine: Vec<_> = with_alone.filter(|(e, _)| machine(e) == machine(&pair.opening)).collect();
    of_machine.windows(2).any(|e| is(e[0], &pair.opening) && is(e[1], &pair.closing))
}

/// Whether a log has neither event of the pair, nor any like them nearby.
fn lacks(log: &[Event], pair: &Pair, dt: f64) -> bool {
    let is = |found: &Event, event: &Event| same_kind(found, event) && (found.time - event.time).abs() <= NEAR * dt;
    !log.iter().any(|e| is(e, &pair.opening) || is(e, &pair.closing))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::num::NonZeroUsize;
    use std::sync::Arc;

    use seismass::{Building, Damping, Options, Storey, simulate};

    use super::*;
    use crate::stress::Family;
    use crate::{compare, solve};

    fn kernel(scene: &Scene, motion: &Motion) -> Response {
        let options = Options { histories: NonZeroUsize::new(1), events: true, ..Options::default() };
        simulate(scene, motion, &options).unwrap()
    }

    fn exact(scene: &Scene, motion: &Motion) -> Solution {
        solve::<DoubleDouble>(scene, motion, 1).unwrap()
    }

    /// An undamped, elastic-plastic oscillator of 8 rad/s that starts at so many times the velocity that takes it to
    /// its yield force, in t = pi / 16 = 0.196 s.
    fn oscillator(velocity: f64, samples: usize) -> (Scene, Motion) {
        let storey = Storey { overstrength: 1.0, second_slope: 0.0, third_slope: 0.0, ..Storey::yielding(64.0, 1.0) };
        let building = Building::new(vec![1.0], vec![storey], Damping::Modal { ratio: 0.0 }).unwrap();
        let scene = Scene::new(Some(Arc::new(building)), Vec::new()).unwrap();
        let scene = scene.with_initial(vec![0.0], vec![0.125 * velocity]).unwrap();
        (scene, Motion::new(vec![0.0; samples], 0.01, None).unwrap())
    }

    /// The verdict on a kernel that has this log in place of its own.
    fn with_log((scene, motion): &(Scene, Motion), log: Vec<Event>) -> Option<Verdict> {
        let exact = exact(scene, motion);
        let mut response = kernel(scene, motion);
        response.events = Some(log);
        explain(scene, motion, &response, &exact, &compare(&response, &exact))
    }

    fn pair_at(time: f64, sign: i8) -> [Event; 2] {
        let event = |kind, element| Event { time, kind, number: 1, sign, element };
        [event(EventKind::Yield, 1), event(EventKind::Unload, 0)]
    }

    /// Past its yield force by a fraction e of it, the spring yields and unloads after sqrt(2 e) / 8 s.
    #[test]
    fn a_dropped_pair_is_a_graze_only_within_the_last_digits() {
        for (excess, grazes) in [(4.0 * f64::EPSILON, true), (1e-12, false), (1e-10, false), (1e-4, false)] {
            let drawn = oscillator(1.0 + excess, 40);
            let judge = exact(&drawn.0, &drawn.1);
            assert_eq!(judge.events.len(), 2, "{excess}");
            let lasts = judge.events[1].time - judge.events[0].time;
            assert!((lasts - (2.0 * excess).sqrt() / 8.0).abs() < 0.01 * lasts, "{excess}: {lasts}");
            assert_eq!(with_log(&drawn, Vec::new()).is_some(), grazes, "{excess}");
        }
    }

    #[test]
    fn an_invented_pair_is_a_graze_only_within_the_last_digits() {
        let peak = std::f64::consts::PI / 16.0;
        for (shortfall, grazes) in [(4.0 * f64::EPSILON, true), (1e-12, false), (1e-4, false)] {
            let drawn = oscillator(1.0 - shortfall, 40);
            assert!(exact(&drawn.0, &drawn.1).events.is_empty());
            assert_eq!(with_log(&drawn, pair_at(peak, 1).to_vec()).is_some(), grazes, "{shortfall}");
        }
        // At another time the spring does not turn.
        let drawn = oscillator(1.0 - 4.0 * f64::EPSILON, 40);
        assert_eq!(with_log(&drawn, pair_at(0.5 * peak, 1).to_vec()), None);
        assert_eq!(with_log(&drawn, pair_at(peak, -1).to_vec()), None);
    }

    /// Once cut down to the elastic range, the vibration turns at the yield force in every cycle.
    #[test]
    fn every_turn_of_a_vibration_cut_by_yielding_is_a_graze() {
        let drawn = oscillator(1.5, 200);
        let log = exact(&drawn.0, &drawn.1).events;
        assert_eq!(log.len(), 2);
        let half_period = std::f64::consts::PI / 8.0;
        let turn = |i: i8| pair_at(log[1].time + f64::from(i) * half_period, if i % 2 == 0 { 1 } else { -1 });
        let Some(Verdict::GrazingPairs { .. }) = with_log(&drawn, [&log[..], &turn(1), &turn(2), &turn(3)].concat())
        else {
            panic!("not explained");
        };
        // Without the yield that is no graze, or its unload, the same log is defective.
        for event in 0..2 {
            let mut defective = [&log[..], &turn(1), &turn(2), &turn(3)].concat();
            defective.remove(event);
            assert_eq!(with_log(&drawn, defective), None);
        }
    }

    /// Seed 900235, an undamped building: without its shortest pairs the judge's log is explained, but not with any one
    /// event less beside them, nor with numbers that differ.
    #[test]
    fn a_defect_beside_grazes_is_reported() {
        let (scene, motion) = Family::Usual.scene(900_235).unwrap();
        let exact = exact(&scene, &motion);
        let mut log = exact.events.clone();
        let opens_short = |w: &[Event]| w[0].kind == EventKind::Yield && w[1].time - w[0].time < 1e-10;
        while let Some(at) = log.windows(2).position(opens_short) {
            log.drain(at..at + 2);
        }
        let number = (exact.events.len() - log.len()) / 2;
        let pairs = differing_pairs(&log, &exact.events, motion.dt()).unwrap();
        assert!(number > 5 && pairs.extra.is_empty() && pairs.missing.len() == number);
        for dropped in 0..log.len() {
            let mut log = log.clone();
            log.remove(dropped);
            assert!(differing_pairs(&log, &exact.events, motion.dt()).is_none(), "event {dropped}");
        }
        let mut response = kernel(&scene, &motion);
        response.events = Some(log);
        let verdict = |response: &Response| explain(&scene, &motion, response, &exact, &compare(response, &exact));
        assert!(matches!(verdict(&response), Some(Verdict::GrazingPairs { .. })));
        response.peaks.drift[0].value *= 1.0 + 1e-8;
        assert_eq!(verdict(&response), None);
    }
}
