//! Guards of all state machines as polynomials, the first that falls, and what it does (`numerics`, section 5).

use crate::events::first::First;
use crate::lanes::{FAR, Set, Vector, WIDTH, members, spread};
use crate::machines::guard::Guard;
use crate::machines::sign::Sign;
use crate::polynomial::enclosure::{THIRD, stays_above_zero};
use crate::polynomial::power::Polynomial;
use crate::regime::Row;
use crate::state::State;
use crate::state::relative::{block_change, relative_velocity, slip_change};
use crate::tolerances::{DECISION_ROUNDING, FALL_ROUNDING, NO_CONTACT, SAME_DRIFT};
use crate::units::STANDARD_GRAVITY;

/// The first guard that falls within the present series, which starts at `tau` and whose ranges are formed.
///
/// `isolated` counts the guards that could not be cleared by a bound.
#[inline(always)]
pub(crate) fn first_event<V: Vector, const K: usize>(state: &State, tau: f64, isolated: &mut usize) -> First {
    let mut first = First::none();
    let h = state.step.series.h();
    storey_guards::<V, K>(state, &mut first, isolated);
    if !state.blocks.motions.is_empty() {
        if state.vertical || state.blocks.airborne {
            first.consider(Guard::Contact, &contact_guard(state, tau), NO_CONTACT);
        }
        if !state.blocks.airborne && (state.step.ranges.near_bound[2] != 0 || state.blocks.stuck_mu[0] < f64::INFINITY)
        {
            breakaway_guards::<V, K>(state, &mut first, isolated);
        }
        if state.blocks.is_sliding {
            arrival_guards::<V, K>(state, &mut first, isolated);
            if state.model.wears {
                wear_guards::<K>(state, &mut first, isolated);
            }
        }
    }
    // A block whose floor's acceleration is below rounding lifts off stuck.
    if state.vertical
        && let Some(Guard::Breakaway { .. }) = first.guard()
        && let Some(lift) = contact_guard(state, tau).first_fall::<V>(NO_CONTACT)
        && state.interval.contact_at(tau + first.place() * h) <= NO_CONTACT
    {
        return First::at(lift, Guard::Contact);
    }
    first
}

/// The contact force per unit mass while there is contact, its negative while there is none. Contact that is none all
/// along the series has been lost at its start, though the force never falls below zero.
fn contact_guard(state: &State, tau: f64) -> Polynomial {
    let sign = if state.blocks.airborne { -1.0 } else { 1.0 };
    let change = state.interval.contact_slope * state.step.series.h();
    let start = state.interval.contact_at(tau);
    if !state.blocks.airborne && start <= NO_CONTACT && start + change <= NO_CONTACT {
        return Polynomial::new([-STANDARD_GRAVITY]);
    }
    Polynomial::new([sign * start, sign * change])
}

#[inline(always)]
fn storey_guards<V: Vector, const K: usize>(state: &State, first: &mut First, isolated: &mut usize) {
    let [drifts, rates, _] = state.step.ranges.near_bound;
    if drifts | rates == 0 {
        return;
    }
    for k in 0..state.vectors::<K>() {
        if state.step.ranges.near_bound_in::<K>(0, k) != 0 {
            for side in members(drifts_at_guards::<V, K>(state, k)) {
                drift_guards::<V, K>(state, WIDTH * k + side / 2, side % 2 == 0, first, isolated);
            }
        }
        for lane in members(state.step.ranges.near_bound_in::<K>(1, k)) {
            rate_guard::<V, K>(state, WIDTH * k + lane, first, isolated);
        }
    }
}

/// Considers the guards of a storey's drift on one side.
#[inline(always)]
fn drift_guards<V: Vector, const K: usize>(
    state: &State,
    i: usize,
    is_positive: bool,
    first: &mut First,
    isolated: &mut usize,
) {
    let (low, high) = state.step.ranges.drift::<K>(i);
    let (yields, collapses) = (state.springs.segment_ends[i], state.springs.collapse_bounds[i]);
    let (sign, reached, of_yield, of_collapse) = match is_positive {
        true => (Sign::Positive, high, yields.1, collapses.1),
        false => (Sign::Negative, -low, -yields.0, -collapses.0),
    };
    // A backbone without residual strength may end where the storey collapses, which then is all that happens.
    let rounding = SAME_DRIFT * (of_collapse.abs() + state.springs.machines[i].segment().range);
    if of_collapse == f64::INFINITY || of_yield < of_collapse - rounding {
        let yields = Guard::SegmentEnd { storey: i, sign };
        drift_guard::<V, K>(state, yields, (i, sign), reached, of_yield, first, isolated);
    }
    drift_guard::<V, K>(state, Guard::Collapse { storey: i }, (i, sign), reached, of_collapse, first, isolated);
}

/// Considers the turn of a storey's rate, if its segment does not allow it.
#[inline(always)]
fn rate_guard<V: Vector, const K: usize>(state: &State, i: usize, first: &mut First, isolated: &mut usize) {
    let Some(sign) = state.springs.machines[i].rate_sign() else { return };
    let (low, high) = state.step.ranges.rate::<K>(i);
    if if sign == Sign::Positive { low > 0.0 } else { high < 0.0 } {
        return;
    }
    *isolated += 1;
    let mut p = state.step.series.zeros();
    let size = state.step.series.drift_rate::<V, K>(i, sign.factor(), &mut p);
    let contact = state.step.drive.contact;
    let sizes = state.size_in_lanes::<V, K>(i + 1, contact) + state.size_in_lanes::<V, K>(i, contact);
    let tolerance = FALL_ROUNDING * (size + state.step.series.h() * sizes);
    first.consider(Guard::Turn { storey: i }, &p, tolerance);
}

/// Storeys of vector `k` whose drifts may come to a guard over the present series: each storey has two bits, of its
/// positive and of its negative side.
#[inline(always)]
fn drifts_at_guards<V: Vector, const K: usize>(state: &State, k: usize) -> Set {
    let [lowest, highest] = &state.bounds.guarded;
    let (low, high) = state.step.ranges.drifts::<V, K>(k);
    spread(high.not_below(highest.vector::<V, K>(k))) | spread(lowest.vector::<V, K>(k).not_below(low)) << 1
}

/// Whether a drift coordinate, times `sign`, stays below a limit over the present series, but for its start.
#[inline(always)]
fn stays_below<const K: usize>(state: &State, i: usize, limit: f64, sign: Sign) -> bool {
    let (factor, third) = (sign.factor(), state.step.series.h() * THIRD);
    let [dx, dv] = state.step.series.changes().map(|changes| changes.numbers::<K>()[i]);
    let (x, v) = (state.kinematics.x.numbers::<K>()[i], state.kinematics.v.numbers::<K>()[i]);
    let margin = state.step.ranges.remainder * state.regime.row(Row::FourthOfDrift)[i];
    let of = |x: f64, v: f64| [limit - factor * x, -factor * v];
    stays_above_zero(of(x, v), of(x + dx, v + dv), third, margin, 0.0)
}

/// Considers the guard of a storey's drift coordinate that, times `sign`, must stay below `limit`, if it may have
/// reached that.
#[inline(always)]
fn drift_guard<V: Vector, const K: usize>(
    state: &State,
    guard: Guard,
    (i, sign): (usize, Sign),
    reached: f64,
    limit: f64,
    first: &mut First,
    isolated: &mut usize,
) {
    if reached < limit || limit == f64::INFINITY || stays_below::<K>(state, i, limit, sign) {
        return;
    }
    *isolated += 1;
    let mut p = state.step.series.zeros();
    let size = state.step.series.drift::<V, K>(i, -sign.factor(), limit, &mut p);
    let range = state.springs.machines[i].segment().range;
    first.consider(guard, &p, FALL_ROUNDING * (limit.abs() + size + range));
}

#[inline(always)]
fn breakaway_guards<V: Vector, const K: usize>(state: &State, first: &mut First, isolated: &mut usize) {
    let least_contact = state.step.drive.least_contact(state.step.series.h());
    if state.blocks.stuck_mu[0] < f64::INFINITY {
        breakaway_guard::<V, K>(state, 0, least_contact, first, isolated);
    }
    for k in 0..state.vectors::<K>() {
        for lane in members(accelerations_at_guards::<V, K>(state, k, least_contact)) {
            breakaway_guard::<V, K>(state, WIDTH * k + lane + 1, least_contact, first, isolated);
        }
    }
}

/// Considers the limits of the blocks stuck to a floor, or to the ground (0), if its acceleration may come to them.
#[inline(always)]
fn breakaway_guard<V: Vector, const K: usize>(
    state: &State,
    floor: usize,
    least_contact: f64,
    first: &mut First,
    isolated: &mut usize,
) {
    let contact_change = state.step.drive.contact_slope * state.step.series.h();
    let (contact, mu) = (state.step.drive.contact, state.blocks.stuck_mu[floor]);
    let (low, high) = acceleration_range::<K>(state, floor);
    let reached = [(Sign::Positive, high), (Sign::Negative, -low)];
    if reached.iter().all(|&(_, size)| size < mu * least_contact) {
        return;
    }
    *isolated += 1;
    let limit = mu * contact;
    let sizes = (mu * contact_change).abs() + state.size_in_lanes::<V, K>(floor, contact);
    for (sign, size) in reached {
        if size < mu * least_contact {
            continue;
        }
        let mut p = state.step.series.zeros();
        let size = state.step.series.acceleration::<V, K>(floor, -sign.factor(), [limit, mu * contact_change], &mut p);
        // Not below what a decision takes as equal: what has just stuck must not break away for that.
        let tolerance = DECISION_ROUNDING * (limit.max(mu * STANDARD_GRAVITY) + size + sizes);
        first.consider(Guard::Breakaway { floor, sign }, &p, tolerance);
    }
}

/// Floors of vector `k`, as bits, whose accelerations may come to the limit of blocks stuck to them over the present
/// series.
#[inline(always)]
fn accelerations_at_guards<V: Vector, const K: usize>(state: &State, k: usize, least_contact: f64) -> Set {
    let (low, high) = state.step.ranges.accelerations::<V, K>(k);
    let mu: V = state.bounds.stuck_mu.vector::<V, K>(k);
    let reached = high.max(V::splat(0.0).sub(low)).not_below(mu.mul(V::splat(least_contact)));
    Set::from(reached & !mu.not_below(V::splat(FAR)))
}

#[inline(always)]
fn arrival_guards<V: Vector, const K: usize>(state: &State, first: &mut First, isolated: &mut usize) {
    for &j in &state.blocks.moving {
        let motion = &state.blocks.motions[j];
        let Some(sign) = motion.sliding() else { continue };
        if keeps_sliding::<K>(state, j, sign.factor()) {
            continue;
        }
        *isolated += 1;
        let mut p = state.step.series.zeros();
        let size = relative_velocity::<V, K>(state, j, sign.factor(), &mut p);
        let law = &state.model.blocks[j];
        let rates = state.size_in_lanes::<V, K>(law.floor, state.step.drive.contact) + motion.mu_k * STANDARD_GRAVITY;
        first.consider(Guard::Arrival { block: j }, &p, FALL_ROUNDING * (size + state.step.series.h() * rates));
    }
}

/// Considers the changes of the friction coefficients of sliding blocks: slips grow until a block arrives.
#[inline(never)]
fn wear_guards<const K: usize>(state: &State, first: &mut First, isolated: &mut usize) {
    for &j in &state.blocks.moving {
        let motion = &state.blocks.motions[j];
        let Some(sign) = motion.sliding().map(Sign::factor) else { continue };
        let rest = motion.path_to_wear();
        if rest == f64::INFINITY {
            continue;
        }
        let change = sign * block_change::<K>(state, j).1;
        let size = motion.wear_limit(1.0).abs() + motion.path() + rest.abs() + change.abs();
        let tolerance = FALL_ROUNDING * size;
        if rest - change > tolerance && keeps_sliding::<K>(state, j, sign) {
            continue;
        }
        *isolated += 1;
        let slip = slip_change(state, j);
        let terms = slip.coefficients().iter().skip(1).map(|c| -sign * c);
        first.consider(Guard::Wear { block: j }, &Polynomial::new(std::iter::once(rest).chain(terms)), tolerance);
    }
}

/// Range of the absolute acceleration of a floor, or of the ground (0), over the present series.
fn acceleration_range<const K: usize>(state: &State, floor: usize) -> (f64, f64) {
    match floor.checked_sub(1) {
        Some(i) => state.step.ranges.acceleration::<K>(i),
        None => {
            let (start, end) = (
                state.step.drive.ground,
                state.step.drive.ground + state.step.drive.ground_slope * state.step.series.h(),
            );
            (start.min(end), start.max(end))
        }
    }
}

/// Whether the relative velocity of a sliding block keeps its sign over the present series.
#[inline(always)]
fn keeps_sliding<const K: usize>(state: &State, block: usize, sign: f64) -> bool {
    let (motion, law) = (&state.blocks.motions[block], &state.model.blocks[block]);
    let h = state.step.series.h();
    let friction = sign * motion.mu_k;
    // Linear up to the end, also where contact is lost before: as the change below is.
    let contact = (state.step.drive.contact, state.step.drive.contact + state.step.drive.contact_slope * h);
    let (a, margin) = match law.floor.checked_sub(1) {
        Some(i) => {
            let margin = state.step.ranges.remainder * state.regime.row(Row::ThirdOfAcceleration)[i];
            (
                (state.kinematics.a.numbers::<K>()[i], state.step.series.accelerations_at_end()[0].numbers::<K>()[i]),
                margin,
            )
        }
        None => ((state.step.drive.ground, state.step.drive.ground + state.step.drive.ground_slope * h), 0.0),
    };
    let (velocity, _) = block_change::<K>(state, block);
    let rates = (-friction * contact.0 - a.0, -friction * contact.1 - a.1);
    let (start, end) = ([motion.velocity, rates.0], [motion.velocity + velocity, rates.1]);
    // A block that breaks away where both coefficients are the same starts without relative acceleration.
    let least = FALL_ROUNDING * motion.mu_k * STANDARD_GRAVITY;
    stays_above_zero(start.map(|value| sign * value), end.map(|value| sign * value), h * THIRD, margin, least)
}
