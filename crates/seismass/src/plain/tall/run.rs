//! Runs of whole sample intervals of tall regimes: any number of storeys, at a cost that grows with it linearly by
//! banded steps, with its square by full ones.
//!
//! As in [`crate::plain::run`] each step is accepted only when bounds prove that no guard fell inside it. The loop looks
//! at each end with the cubic's margins. What this does not clear is looked at with the quintic through values and two
//! derivatives at both ends, which differs by at most h^6 / 46080 times the largest sixth derivative: the fourth of the
//! second, which the same norm bounds when it is taken of the second derivatives, of each storey's surroundings alone
//! ([`crate::plain::tall::norms`]). Of a tall building some storey beats its peak in most steps: where one turns inside a step,
//! the series of that step gives the extreme, and the run goes on.

use crate::lanes::{Vector, WIDTH, at, filled_to, for_each_path, lanes, lanes_mut};
use crate::machines::sign::Sign;
use crate::plain::sliding::{FloorBlock, GroundBlock, LinearInTime, move_on_ground};
use crate::plain::tall::bounds::{Separations, TallBounds};
use crate::plain::tall::norms::{RegimeRows, energy};
use crate::plain::tall::quintic_check::{Curvature, NearBound, NewPeaksOfVector, QuinticCheck};
use crate::plain::tall::sample::TallSample;
use crate::plain::tall::series::StepSeries;
use crate::polynomial::enclosure::{THIRD, off_cubic, range};
use crate::record::observer::Observer;
use crate::regime::operator_long::LongOperator;
use crate::scene::Motion;
use crate::state::State;
use crate::state::accelerations::turned;
use crate::step::banded::{BandedStart, BandedStep, whole_blocks};
use crate::step::full::{FullStep, Shears};
use crate::step::tall::TallStep;
use crate::tolerances::{BELOW_ROUNDING, NO_CONTACT, SMALL_DIFFERENCE};
use crate::units::STANDARD_GRAVITY;

/// Sums of each value and all below it.
#[inline(always)]
fn prefix_sums<V: Vector>(values: &[f64], out: &mut [f64]) {
    let zero = V::splat(0.0);
    let mut below = zero;
    for (out, values) in lanes_mut(out).iter_mut().zip(lanes(values)) {
        let values = V::load(values);
        let pairs = values.add(values.shifted_up(zero));
        let sums = pairs.add(pairs.shifted_up(zero).shifted_up(zero));
        sums.add(below).store(out);
        below = below.add(sums.broadcast(WIDTH - 1));
    }
}

/// Puts vectors into numbers.
#[inline(always)]
fn store_all<V: Vector>(vectors: [V; 3], out: &mut Separations) {
    for (vector, out) in vectors.into_iter().zip(out) {
        vector.store(out);
    }
}

/// What takes the state over a step, with its working space.
enum Map<'a> {
    Banded(&'a BandedStep),
    Full(&'a FullStep, Shears),
}

for_each_path! {
    /// Takes plain steps from interval `first` until `end`, or until one is not plain; returns the interval reached.
    pub(crate) fn run(
        state: &mut State,
        observer: &mut Observer,
        motion: &Motion,
        step: &TallStep,
        first: usize,
        end: usize,
    ) -> usize = run_lanes
}

#[inline(always)]
fn run_lanes<V: Vector>(
    state: &mut State,
    observer: &mut Observer,
    motion: &Motion,
    step: &TallStep,
    first: usize,
    end: usize,
) -> usize {
    let (n, h) = (state.storeys(), motion.dt());
    let length = whole_blocks(n);
    let mut map = match step {
        TallStep::Banded(step) => Map::Banded(step),
        TallStep::Full(step) => Map::Full(step, Shears::new(&state.regime, n)),
    };
    let margin = if let TallStep::Banded(step) = step { step.half_width } else { 0 };
    let (third, per_second) = (V::splat(h * THIRD), 1.0 / h);
    let widening = off_cubic(h);
    let vertical = motion.vertical().filter(|_| state.vertical);
    let contact_at = |i: usize| STANDARD_GRAVITY + vertical.map_or(0.0, |vertical| vertical[i]);
    let rows = RegimeRows::new(state, h, length);
    let operator = LongOperator::new(state.model, &state.regime, length);
    let has_floor_damping = operator.floor_damping.iter().any(|&damping| damping != 0.0);
    let mut bounds = TallBounds::new(state, observer, length);
    let mut before = TallSample::new(state, length, margin);
    let mut after = TallSample::new(state, length, margin);
    let zero = || vec![0.0; length];
    let (mut dx, mut dv, mut floors) = (zero(), zero(), zero());
    let mut rate = vec![0.0; length + 2 * margin];
    let (mut load, mut load_slope) = (zero(), zero());
    let spring_load = filled_to(length, state.springs.load[..n].iter().copied(), 0.0);
    let friction = filled_to(length, state.blocks.friction[..n].iter().copied(), 0.0);
    let (mut separations_before, mut separations_after) =
        (vec![Separations::default(); length / WIDTH], vec![Separations::default(); length / WIDTH]);
    let (mut curvature, mut series) = (Curvature::new(length, margin), StepSeries::new(length, state.effort));
    let (mut near_bound, mut beaten): (Vec<NearBound>, Vec<NewPeaksOfVector>) = (Vec::new(), Vec::new());
    let (mut on_floors, mut on_ground) = sliding_blocks(state);
    let watches_ground = !on_ground.is_empty() || state.blocks.stuck_mu[0].is_finite();
    let mut blocks: Vec<(f64, f64)> = match observer.histories {
        Some(_) => state.blocks.motions.iter().map(|m| (m.velocity, m.slip)).collect(),
        None => Vec::new(),
    };
    let samples = motion.acceleration();
    let set_loads = |contact: f64, slope: f64, load: &mut [f64], load_slope: &mut [f64]| {
        for i in 0..length {
            (load[i], load_slope[i]) = (spring_load[i] + friction[i] * contact, friction[i] * slope);
        }
    };
    set_loads(contact_at(first), 0.0, &mut load, &mut load_slope);
    let mut slope_before = state.kinematics.jerk_slope;
    for k in 0..length / WIDTH {
        bounds.update::<V>(k);
        store_all(bounds.separations::<V>(&before, margin, third, k), &mut separations_before[k]);
    }
    let mut reached = first;
    for (pair, next) in samples[first..=end].windows(2).zip(first + 1..) {
        let slope = (pair[1] - pair[0]) * per_second;
        let contact = (contact_at(next - 1), contact_at(next));
        let contact_slope = vertical.map_or(0.0, |vertical| (vertical[next] - vertical[next - 1]) * per_second);
        if vertical.is_some() {
            let change = contact_slope - slope_before;
            turned::<V>(&mut before.jerk[1..], lanes(&friction), lanes(&operator.inverse_mass), change);
            slope_before = contact_slope;
            set_loads(contact.1, contact_slope, &mut load, &mut load_slope);
            for (k, separations) in separations_before.iter_mut().enumerate() {
                store_all(bounds.separations::<V>(&before, margin, third, k), separations);
            }
        }
        // The step.
        let ground_slope = V::splat(slope);
        for (rate, jerk) in lanes_mut(&mut rate[margin..]).iter_mut().zip(lanes(&before.jerk[1..])) {
            V::load(jerk).sub(ground_slope).store(rate);
        }
        before.jerk[0] = slope;
        match &mut map {
            Map::Banded(step) => {
                curvature.form_end::<V>(&operator, 0, &before, margin);
                let [q_rate, jerk_rate] = curvature.with_margin(margin);
                let start = BandedStart { q: [&before.q, q_rate], jerk: [&rate, jerk_rate] };
                step.advance::<V>(start, &mut dx, &mut dv);
            }
            Map::Full(step, shears) => {
                let load_slope = vertical.map(|_| &load_slope[..]);
                shears.form::<V>(&before.a[1..], &before.v, load_slope);
                step.advance::<V>(shears, [pair[0], slope], &mut dx, &mut dv);
            }
        }
        let starts = lanes(&before.x).iter().zip(lanes(&before.v));
        let ends = lanes_mut(&mut after.x).iter_mut().zip(lanes_mut(&mut after.v));
        for (((x, v), (x_end, v_end)), (dx, dv)) in starts.zip(ends).zip(lanes(&dx).iter().zip(lanes(&dv))) {
            let v = V::load(v);
            V::load(x).add(V::splat(h).mul_add(v, V::load(dx))).store(x_end);
            v.add(V::load(dv)).store(v_end);
        }
        if has_floor_damping {
            prefix_sums::<V>(&after.v, &mut floors);
        }
        operator.accelerations::<V>(&after.x, &after.v, &floors, &load, &mut after.a[1..]);
        after.a[0] = pair[1];
        let q = &mut after.q[margin..margin + length];
        operator.derivatives(&after.v, &after.a, V::splat(1.0), &load_slope, q, &mut after.jerk[1..]);
        // The proof.
        let derivative_norm = energy::<V>(&rows, &rate[margin..], &before.q[margin..]).sqrt() * rows.growth;
        let least_contact = V::splat(if contact.0 < contact.1 { contact.0 } else { contact.1 });
        let fourth = V::splat(derivative_norm * widening);
        near_bound.clear();
        for (k, (before, after_now)) in separations_before.iter().zip(&mut separations_after).enumerate() {
            let now = bounds.separations::<V>(&after, margin, third, k);
            let of_vector = &bounds.vectors[k];
            let limit = V::load(&of_vector.stuck_mu).mul(least_contact).min(bounds.acceleration_peaks(k));
            let limits = [V::load(&of_vector.reach), V::load(&of_vector.turn), limit];
            let mut bits = [0; 3];
            for which in 0..3 {
                let most = V::load(&before[which]).max(now[which]);
                bits[which] = fourth.mul_add(at(&rows.fourth[which], k), most).not_below(limits[which]);
            }
            store_all(now, after_now);
            let [drifts, rates, accelerations] = bits;
            if drifts | rates | accelerations != 0 {
                near_bound.push(NearBound { vector: k, drifts, rates, accelerations });
            }
        }
        let (ground, push) =
            (LinearInTime { start: pair[0], end: pair[1] }, LinearInTime { start: contact.0, end: contact.1 });
        let mut may_turn = false;
        if !on_floors.is_empty() {
            prefix_sums::<V>(&dv, &mut floors);
            for block in &mut on_floors {
                let (i, pushed) = (block.floor, block.friction * push.once(h) + ground.once(h));
                block.velocity_after = block.velocity - (pushed + floors[i]);
                let rates =
                    (-block.friction * contact.0 - before.a[i + 1], -block.friction * contact.1 - after.a[i + 1]);
                let fourth = derivative_norm * widening * rows.fourth[3][i];
                let (low, high) = range(block.velocity, rates.0, block.velocity_after, rates.1, h * THIRD, fourth);
                let least = SMALL_DIFFERENCE * floors[i].abs();
                may_turn |= !(if block.sign > 0.0 { low > least } else { high < -least });
            }
        }
        beaten.clear();
        let mut turns = false;
        if !near_bound.is_empty() || may_turn {
            after.jerk[0] = slope;
            let largest = bounds.largest_peaks();
            let least = (BELOW_ROUNDING * largest.0, BELOW_ROUNDING * largest.1);
            if matches!(map, Map::Full(..)) {
                curvature.form_end::<V>(&operator, 0, &before, margin);
            }
            curvature.form_end::<V>(&operator, 1, &after, margin);
            curvature.form_norms::<V>(&operator, &rows);
            let (start, end, curvature) = (&before, &after, &curvature);
            let step = QuinticCheck { rows: &rows, bounds: &bounds, start, end, curvature, margin, h, contact, least };
            let mut is_plain = true;
            for near_bound in &near_bound {
                let Some(looked) = step.look::<V>(near_bound) else {
                    is_plain = false;
                    break;
                };
                if looked.drifts | looked.accelerations != 0 {
                    beaten.push(looked);
                }
            }
            turns = beaten.iter().any(NewPeaksOfVector::turns);
            if !is_plain
                || may_turn && !on_floors.iter().all(|b| step.keeps_sliding(b, contact_slope, floors[b.floor]))
                || turns && !series.form::<V>(&operator, &rows, &step, &beaten)
            {
                break;
            }
        }
        let mut wears = false;
        if !on_floors.is_empty() {
            prefix_sums::<V>(&dx, &mut floors);
            for block in &mut on_floors {
                let moved = block.friction * push.twice(h) + ground.twice(h);
                block.slip_after = block.slip + (h * block.velocity - (moved + floors[block.floor]));
                wears |= block.sign * block.slip_after >= block.limit;
            }
        }
        if wears
            || vertical.is_some() && !(contact.0 > NO_CONTACT && contact.1 > NO_CONTACT)
            || watches_ground && !move_on_ground(&mut on_ground, ground, push, h, state.blocks.stuck_mu[0])
        {
            break;
        }
        for block in &mut on_floors {
            (block.slip, block.velocity) = (block.slip_after, block.velocity_after);
        }
        if turns {
            let time = (next - 1) as f64 * h;
            series.take_extremes::<V>(&mut bounds, [&before, &after], margin, time, &beaten);
        }
        reached = next;
        std::mem::swap(&mut before, &mut after);
        std::mem::swap(&mut separations_before, &mut separations_after);
        let time = reached as f64 * h;
        for beaten in &beaten {
            let k = beaten.vector;
            if beaten.drifts != 0 {
                bounds.take_drifts::<V>(k, &lanes(&before.x)[k], time);
                bounds.update::<V>(k);
                bounds.separations::<V>(&before, margin, third, k)[0].store(&mut separations_before[k][0]);
            }
            if beaten.accelerations != 0 {
                bounds.take_accelerations::<V>(k, &lanes(&before.a[1..])[k], time);
            }
        }
        if let Some(recorder) = observer.recorder_at(reached) {
            for block in &on_floors {
                blocks[block.block] = (block.velocity, block.slip);
            }
            for block in &on_ground {
                blocks[block.block] = (block.velocity, block.slip);
            }
            recorder.append_row(state, &before.x, &before.v, &before.a[1..], blocks.iter().copied());
        }
    }
    state.effort = series.effort;
    if reached > first {
        before.put(state, margin);
        state.kinematics.jerk_slope = slope_before;
        bounds.put_peaks(state, observer);
        for block in &on_floors {
            (state.blocks.motions[block.block].velocity, state.blocks.motions[block.block].slip) =
                (block.velocity, block.slip);
        }
        for block in &on_ground {
            (state.blocks.motions[block.block].velocity, state.blocks.motions[block.block].slip) =
                (block.velocity, block.slip);
        }
    }
    reached
}

/// The blocks that slide, on floors and on the ground.
fn sliding_blocks(state: &State) -> (Vec<FloorBlock>, Vec<GroundBlock>) {
    let (mut on_floors, mut on_ground) = (Vec::new(), Vec::new());
    for (block, (motion, law)) in state.blocks.motions.iter().zip(&state.model.blocks).enumerate() {
        let Some(sign) = motion.sliding().map(Sign::factor) else { continue };
        let (friction, velocity, slip) = (sign * motion.mu_k, motion.velocity, motion.slip);
        let limit = motion.wear_limit(sign);
        match law.floor.checked_sub(1) {
            Some(floor) => on_floors.push(FloorBlock {
                block,
                floor,
                friction,
                sign,
                velocity,
                slip,
                limit,
                velocity_after: velocity,
                slip_after: slip,
            }),
            None => on_ground.push(GroundBlock { block, friction, sign, velocity, slip, limit }),
        }
    }
    (on_floors, on_ground)
}
