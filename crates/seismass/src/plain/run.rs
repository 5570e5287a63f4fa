//! Runs of whole sample intervals by the propagator, each accepted only when bounds prove that no guard fell inside
//! it.
//!
//! Value and rate at both ends give the Bezier points of a cubic; the quantity differs from that cubic by at most
//! h^4 / 384 times its largest fourth derivative, which the regime bounds. The loop itself looks at each end once: a
//! value must keep the distance of h / 3 times its rate from its bound, and the margin of the fourth derivative, to
//! either side. Steps that this does not clear are checked once more ([`crate::plain::guard_check`]), by the Bezier points
//! themselves.
//!
//! The loop ([`clear_steps`]) is a function of its own whose steps call no other, so that what it needs stays in
//! registers; what is between two calls of it is kept in a [`PlainLoop`].

use std::mem::take;
use std::sync::Arc;

use crate::lanes::{
    FAR, Set, Vector, WIDTH, by_width, differences, first_members, for_each_path, load, numbers, prefix_sums, store,
};
use crate::plain::columns::{MARGINS, StepColumns, multiply, prepare_effects, small_step};
use crate::plain::guard_check::GuardCheck;
use crate::plain::plain_loop::{PlainLoop, wears};
use crate::plain::sliding::{BlockDrive, LayerInLanes, LinearInTime};
use crate::plain::tall;
use crate::polynomial::enclosure::{THIRD, off_cubic};
use crate::record::histories::{HistoryWriter, RowInLanes};
use crate::record::observer::Observer;
use crate::record::update::update_bounds;
use crate::regime::Row;
use crate::scene::Motion;
use crate::state::State;
use crate::state::limits::BoundsInLanes;
use crate::state::sample::Sample;
use crate::step::steps::Whole;
use crate::tolerances::{LARGEST_GROWTH, NO_CONTACT, SERIES_PHASE};
use crate::units::STANDARD_GRAVITY;

/// The larger of two separations, of the start and the end of a step, and a norm times the margin per unit of it.
#[inline(always)]
fn largest_separation<V: Vector>((before, after): (V, V), norm: V, margin: V) -> V {
    norm.mul_add(margin, before.max(after))
}

/// Contact force per unit mass at a sample.
#[inline(always)]
fn contact_at(vertical: &[f64], sample: usize) -> f64 {
    STANDARD_GRAVITY + vertical.get(sample).copied().unwrap_or(0.0)
}

for_each_path! {
    /// Takes plain steps from interval `first` until `end`, as long as one look at each end clears them; returns the
    /// interval reached. The step that was not cleared is left in `plain_loop`. `S` is the number of storeys where it is known,
    /// else 0; `SLIDING`: blocks may slide on floors.
    fn clear_steps[K: usize, S: usize, SLIDING: bool, VERTICAL: bool](
        state: &mut State, plain_loop: &mut PlainLoop, observer: &mut Observer, motion: &Motion, first: usize, end: usize,
    ) -> usize = clear_steps_in_lanes
}

#[inline(always)]
fn clear_steps_in_lanes<V: Vector, const K: usize, const S: usize, const SLIDING: bool, const VERTICAL: bool>(
    state: &mut State,
    plain_loop: &mut PlainLoop,
    observer: &mut Observer,
    motion: &Motion,
    first: usize,
    end: usize,
) -> usize {
    if take(&mut plain_loop.renews_bounds) {
        update_bounds::<V, K>(state, observer);
    }
    let mut writer = observer.histories.as_mut().map(HistoryWriter::new);
    prepare_effects::<V, K, VERTICAL>(state);
    let Some(step_columns) = StepColumns::<K>::new(state, motion.dt()) else { return first };
    let (Some(of_drifts), Some(of_rates)) =
        (step_columns.of_drift.first_chunk::<S>(), step_columns.of_rate.first_chunk::<S>())
    else {
        return first;
    };
    let few_columns = [of_drifts, of_rates];
    let h = step_columns.h;
    let (length, third, per_second) = (V::splat(h), V::splat(h * THIRD), 1.0 / h);
    let regime = step_columns.regime;
    let (mass, tangent): ([V; K], [V; K]) = (regime.lanes(Row::RootMass), regime.lanes(Row::RootTangent));
    let growth = regime.growth_over(h);
    // Over many radians of a regime that may grow the bound overflows, and clears nothing: series are shorter.
    if growth >= LARGEST_GROWTH {
        return first;
    }
    // Per unit of the norm at the start of a step.
    let widening = V::splat(growth * off_cubic(h));
    let mut margins = [[V::splat(0.0); K]; 4];
    for which in 0..4 {
        margins[which] = regime.lanes(MARGINS[which]);
        for k in 0..K {
            margins[which][k] = margins[which][k].mul(widening);
        }
    }
    let mut sample = Sample::<V, K>::of(&state.kinematics);
    let mut bounds = BoundsInLanes::<V, K>::of(&state.bounds);
    let samples = motion.acceleration();
    let vertical = motion.vertical().unwrap_or(&[]);
    // Rate of the floor accelerations per slope of the contact force: it turns at every sample.
    let mut jerk_per_slope: [V; K] = load(&state.blocks.friction);
    for (jerk, inverse_mass) in jerk_per_slope.iter_mut().zip(regime.lanes::<V, K>(Row::InverseMass)) {
        *jerk = jerk.mul(inverse_mass);
    }
    let mut slope_before = state.kinematics.jerk_slope;
    let mut separations_before = bounds.separations(&sample, third);
    let (mut lowest, others) = match plain_loop.layers[..plain_loop.used].split_first_mut() {
        Some((lowest, others)) if SLIDING => (Some(lowest), others),
        _ => (None, &mut [][..]),
    };
    let nothing = [V::splat(0.0); K];
    let mut layer = match &lowest {
        Some(lowest) => LayerInLanes::<V, K>::of(lowest),
        None => {
            let turn = [V::splat(FAR); K];
            LayerInLanes { friction: nothing, sign: nothing, turn, velocity: nothing, slip: nothing }
        }
    };
    let last = end.min(samples.len() - 1);
    let within = first_members(state.storeys());
    // What accelerations may not reach without vertical motion: formed where it changes.
    let mut of_accelerations = nothing;
    for k in 0..K {
        of_accelerations[k] = bounds.of_accelerations(k, V::splat(STANDARD_GRAVITY));
    }
    let mut reached = first;
    let mut open = None;
    for interval in samples.get(first..=last).unwrap_or(&[]).windows(2) {
        let &[before, after] = interval else { break };
        let change = after - before;
        let contact = match VERTICAL {
            true => (contact_at(vertical, reached), contact_at(vertical, reached + 1)),
            false => (STANDARD_GRAVITY, STANDARD_GRAVITY),
        };
        if VERTICAL {
            let slope = (vertical[reached + 1] - vertical[reached]) * per_second;
            for k in 0..K {
                sample.jerk[k] = jerk_per_slope[k].mul_add(V::splat(slope - slope_before), sample.jerk[k]);
                separations_before[2][k] = third.mul_add(sample.jerk[k].abs(), sample.a[k].abs());
            }
            slope_before = slope;
        }
        // The norm that bounds the fourth derivatives, itself bounded by the sum of its terms' sizes.
        let slope = V::splat(change * per_second);
        let mut sizes = V::splat(0.0);
        for k in 0..K {
            sizes = mass[k].mul_add(sample.jerk[k].sub(slope).abs(), sizes);
            sizes = tangent[k].mul_add(sample.q[k].abs(), sizes);
        }
        let norm = sizes.total();
        // The step.
        let mut rows = [[V::splat(0.0); K]; 4];
        if S > 0 {
            let drive = [before, change];
            rows = small_step::<V, K, S>(&step_columns, few_columns, drive, [&sample.x, &sample.v]);
        } else {
            let (ground, ramp) = (V::splat(before), V::splat(change));
            for r in 0..4 {
                for k in 0..K {
                    let constant = V::load(&step_columns.constant[r][k]);
                    let row = V::load(&step_columns.of_change[r][k]).mul_add(ramp, constant);
                    rows[r][k] = V::load(&step_columns.of_ground[r][k]).mul_add(ground, row);
                    if VERTICAL {
                        let friction = V::load(&step_columns.friction[r][k]).mul_add(V::splat(contact.0), rows[r][k]);
                        rows[r][k] = V::load(&step_columns.friction_ramp[r][k])
                            .mul_add(V::splat(contact.1 - contact.0), friction);
                    }
                }
            }
            multiply(&mut rows, step_columns.of_drift, &sample.x);
            multiply(&mut rows, step_columns.of_rate, &sample.v);
        }
        let [dx, dv, a, jerk] = rows;
        let mut taken = Sample { x: sample.x, v: sample.v, a, jerk, q: differences(&a, V::splat(after)) };
        for k in 0..K {
            taken.x[k] = sample.x[k].add(dx[k]);
            taken.v[k] = sample.v[k].add(dv[k]);
        }
        // The proof.
        let mut separations_after = bounds.separations(&taken, third);
        let least_contact = V::splat(if contact.0 < contact.1 { contact.0 } else { contact.1 });
        if VERTICAL {
            for k in 0..K {
                of_accelerations[k] = bounds.of_accelerations(k, least_contact);
            }
        }
        let mut marks = V::splat(0.0);
        for k in 0..K {
            let limits = [bounds.reach[k], bounds.turn[k], of_accelerations[k]];
            for which in 0..3 {
                let ends = (separations_before[which][k], separations_after[which][k]);
                let largest = largest_separation(ends, norm, margins[which][k]);
                marks = largest.mark_not_below(limits[which], marks);
            }
        }
        let is_near = marks.has_marks();
        let (mut layer_after, mut is_turning) = (layer, false);
        if SLIDING {
            let mut beyond = dx;
            let mut of_velocity = margins[3];
            for k in 0..K {
                beyond[k] = dx[k].sub(length.mul(sample.v[k]));
                of_velocity[k] = norm.mul(margins[3][k]);
            }
            let push = BlockDrive {
                h,
                ground: LinearInTime { start: before, end: after },
                contact: LinearInTime { start: contact.0, end: contact.1 },
                velocity: prefix_sums(&dv),
                displacement: prefix_sums(&beyond),
                a: [sample.a, taken.a],
                margin: of_velocity,
            };
            (layer_after, is_turning) = layer.pushed(&push);
            is_turning = is_turning && layer.turns(&layer_after.velocity, &push);
            for other in others.iter_mut() {
                let before = LayerInLanes::<V, K>::of(other);
                let (after, turning) = before.pushed(&push);
                let [velocity, slip] = &mut other.after;
                store(&after.velocity, velocity);
                store(&after.slip, slip);
                is_turning |= turning && before.turns(&after.velocity, &push);
            }
            if !plain_loop.wear_limits.is_empty() {
                is_turning |= wears(&plain_loop.wear_limits, numbers(&layer_after.slip).as_flattened(), others);
            }
        }
        let has_contact = !VERTICAL || contact.0 > NO_CONTACT && contact.1 > NO_CONTACT;
        if is_near || is_turning || !has_contact {
            let mut near_bound: [Set; 3] = [0; 3];
            for k in 0..K {
                let limits = [bounds.reach[k], bounds.turn[k], of_accelerations[k]];
                for which in 0..3 {
                    let ends = (separations_before[which][k], separations_after[which][k]);
                    let largest = largest_separation(ends, norm, margins[which][k]);
                    near_bound[which] |= Set::from(largest.not_below(limits[which])) << (WIDTH * k) & within;
                }
            }
            let samples = [&sample, &taken];
            let guard_check =
                GuardCheck::look(near_bound, &bounds, &state.bounds, samples, (norm, &margins), h, least_contact);
            let (fails, time) = (guard_check.fails || is_turning || !has_contact, (reached + 1) as f64 * h);
            let in_state = (&state.bounds, &mut bounds);
            if !plain_loop.beaten.note(&guard_check, fails, reached == first, samples, time, in_state) {
                open = (fails && has_contact).then_some((guard_check, norm));
                break;
            }
            separations_after = bounds.separations(&taken, third);
            for k in 0..K {
                of_accelerations[k] = bounds.of_accelerations(k, least_contact);
            }
        }
        (sample, separations_before, layer) = (taken, separations_after, layer_after);
        for other in others.iter_mut() {
            other.accept();
        }
        reached += 1;
        if let Some(writer) = &mut writer
            && writer.sample() == reached
        {
            let mut blocks = None;
            if SLIDING && writer.recorder().has_one_on_each() {
                blocks = Some(writer.recorder().blocks(&layer.taken(), &layer.velocity, &layer.slip));
            } else if SLIDING {
                let (velocity, slip) = (numbers(&layer.velocity), numbers(&layer.slip));
                for &(block, of_layer, lane) in &plain_loop.on_floors {
                    let (velocity, slip) = match of_layer.checked_sub(1).and_then(|other| others.get(other)) {
                        Some(other) => (&other.velocity[..], &other.slip[..]),
                        None => (velocity.as_flattened(), slip.as_flattened()),
                    };
                    writer.recorder().move_block(block, velocity[lane], slip[lane]);
                }
            }
            writer.append(state.model, &RowInLanes { x: &sample.x, v: &sample.v, a: &sample.a }, blocks);
        }
    }
    if let Some(writer) = writer {
        writer.lay_down();
    }
    if let Some(lowest) = &mut lowest {
        store(&layer.velocity, &mut lowest.velocity);
        store(&layer.slip, &mut lowest.slip);
    }
    state.kinematics.jerk_slope = slope_before;
    if plain_loop.beaten.any() {
        bounds.put_into(&mut state.bounds);
    }
    if let Some((guard_check, norm)) = open {
        let [norm, ..] = numbers(&[norm])[0];
        let ranges = &mut state.step.ranges;
        ranges.set_margins(norm * growth, h);
        ranges.keep(&guard_check.ranges, guard_check.near_bound);
        ranges.near_bound[0] |= plain_loop.beaten.followed();
        ranges.near_bound[1] |= plain_loop.beaten.followed();
        ranges.are_known = ranges.are_finite();
    }
    sample.put_into(&mut state.kinematics);
    reached
}

/// [`clear_steps`] of the present scene, of at most [`MAX_DENSE`](crate::lanes::MAX_DENSE) storeys.
fn clear_steps_of_scene(
    state: &mut State,
    plain_loop: &mut PlainLoop,
    observer: &mut Observer,
    motion: &Motion,
    first: usize,
    end: usize,
) -> usize {
    let steps = match (state.storeys(), plain_loop.used > 0, state.vertical) {
        (1, false, false) => clear_steps::<1, 1, false, false>,
        (2, false, false) => clear_steps::<1, 2, false, false>,
        (3, false, false) => clear_steps::<1, 3, false, false>,
        (4, false, false) => clear_steps::<1, 4, false, false>,
        (1, true, false) => clear_steps::<1, 1, true, false>,
        (2, true, false) => clear_steps::<1, 2, true, false>,
        (3, true, false) => clear_steps::<1, 3, true, false>,
        (4, true, false) => clear_steps::<1, 4, true, false>,
        #[cfg(feature = "tall-buildings")]
        (5, false, false) => clear_steps::<2, 5, false, false>,
        #[cfg(feature = "tall-buildings")]
        (6, false, false) => clear_steps::<2, 6, false, false>,
        #[cfg(feature = "tall-buildings")]
        (7, false, false) => clear_steps::<2, 7, false, false>,
        #[cfg(feature = "tall-buildings")]
        (8, false, false) => clear_steps::<2, 8, false, false>,
        #[cfg(feature = "tall-buildings")]
        (_, false, false) => clear_steps::<4, 0, false, false>,
        #[cfg(feature = "tall-buildings")]
        (5, true, false) => clear_steps::<2, 5, true, false>,
        #[cfg(feature = "tall-buildings")]
        (6, true, false) => clear_steps::<2, 6, true, false>,
        #[cfg(feature = "tall-buildings")]
        (7, true, false) => clear_steps::<2, 7, true, false>,
        #[cfg(feature = "tall-buildings")]
        (8, true, false) => clear_steps::<2, 8, true, false>,
        #[cfg(feature = "tall-buildings")]
        (_, true, false) => clear_steps::<4, 0, true, false>,
        (..=4, _, true) => clear_steps::<1, 0, true, true>,
        #[cfg(feature = "tall-buildings")]
        (5..=8, _, true) => clear_steps::<2, 0, true, true>,
        #[cfg(feature = "tall-buildings")]
        (_, _, true) => clear_steps::<4, 0, true, true>,
        // A scene has no more storeys.
        #[cfg(not(feature = "tall-buildings"))]
        (_, false, _) => clear_steps::<1, 4, false, false>,
        #[cfg(not(feature = "tall-buildings"))]
        (_, true, _) => clear_steps::<1, 4, true, false>,
    };
    steps(state, plain_loop, observer, motion, first, end)
}

/// Takes plain steps from interval `first` until `end`, or until one is not plain; returns the interval reached.
pub(crate) fn run(
    state: &mut State,
    plain_loop: &mut PlainLoop,
    observer: &mut Observer,
    motion: &Motion,
    first: usize,
    end: usize,
) -> usize {
    let h = motion.dt();
    let samples = motion.acceleration();
    let vertical = motion.vertical().filter(|_| state.vertical).unwrap_or(&[]);
    let contact = |sample: usize| contact_at(vertical, sample);
    let drive = |i: usize| {
        (
            LinearInTime { start: samples[i], end: samples[i + 1] },
            LinearInTime { start: contact(i), end: contact(i + 1) },
        )
    };
    by_width!(state.model.width, K => plain_loop.begin::<K>(state, first));
    if let Some(recorder) = &mut observer.histories {
        recorder.take_up(state);
    }
    let mut reached = first;
    while reached < end {
        let mut last = end;
        if plain_loop.on_ground.is_watched() {
            let sliding = !plain_loop.on_ground.sliding().is_empty();
            last = plain_loop.on_ground.go_ahead(reached, end, sliding && observer.histories.is_some(), h, drive);
            if last == reached {
                break;
            }
            for block in plain_loop.on_ground.sliding() {
                if let Some(recorder) = &mut observer.histories {
                    recorder.move_block(block.block, block.velocity, block.slip);
                }
            }
        }
        let first = reached;
        reached = clear_steps_of_scene(state, plain_loop, observer, motion, reached, last);
        plain_loop.beaten.take_steps(state, observer, (first + 1) as f64 * h);
        if reached > first {
            plain_loop.beaten.forget_turned();
        }
        if reached == last {
            continue;
        }
        let (turns, waits) = plain_loop.beaten.take_turns();
        if turns == [0; 2] {
            break;
        }
        plain_loop.beaten.take_followed(state, observer, reached as f64 * h);
        if waits {
            // Whether a step is plain must not depend on where its run began.
            plain_loop.renews_bounds = true;
            continue;
        }
        if state.regime.frequency * h > SERIES_PHASE {
            break;
        }
        // The series of the step gives the extremes; then the run goes on.
        state.begin_interval(motion, reached);
        plain_loop.beaten.turn(state, observer, h, turns);
        plain_loop.renews_bounds = true;
        plain_loop.series += 1;
        plain_loop.isolated += (turns[0].count_ones() + turns[1].count_ones()) as usize;
    }
    plain_loop.on_ground.go_back(reached, h, drive);
    by_width!(state.model.width, K => plain_loop.put_blocks::<K>(&mut state.blocks.motions));
    plain_loop.beaten.take_followed(state, observer, reached as f64 * h);
    reached
}

/// Takes plain steps from interval `first` until `end`, or until one is not plain, and records their histories;
/// returns the interval reached, whose start the state is then at.
pub(crate) fn plain_run(
    state: &mut State,
    plain_loop: &mut PlainLoop,
    observer: &mut Observer,
    motion: &Motion,
    first: usize,
    end: usize,
) -> usize {
    if state.blocks.airborne || !state.cache.visit(state.key.entry, state.model, state.vertical) {
        return first;
    }
    let reached = match state.regime.steps(state.vertical).map(|steps| &steps.whole) {
        Some(Whole::Tall(_)) if observer.forces.is_some() => first,
        Some(Whole::Tall(step)) => {
            let step = Arc::clone(step);
            tall::run::run(state, observer, motion, &step, first, end)
        }
        _ => run(state, plain_loop, observer, motion, first, end),
    };
    state.kinematics.is_formed |= reached > first;
    if state.blocks.is_sliding {
        observer.observe_slips(state, reached as f64 * motion.dt());
    }
    reached
}
