//! Runs of whole sample intervals by the propagator, each accepted only when bounds prove that no guard fell inside it
//! and no peak was beaten at a turn.
//!
//! Value and rate at both ends give the Bezier points of a cubic; the quantity differs from that cubic by at most
//! h^4 / 384 times its largest fourth derivative, which the regime bounds. The loop itself looks at each end once: a
//! value must keep the distance of h / 3 times its rate from its bound, and the margin of the fourth derivative, to
//! either side. Steps that this does not clear are looked at closer, by the Bezier points themselves.

use std::sync::Arc;

use crate::STANDARD_GRAVITY;
use crate::bounds::{self, Set, members, middle_and_reach};
use crate::lanes::{
    FAR, MAX_LANES, Vector, WIDTH, columns_of, differences, for_each_path, load, numbers, prefix_sums, store,
};
use crate::observe::Observer;
use crate::propagator::Whole;
use crate::regime::{Regime, Row};
use crate::scene::Motion;
use crate::state::{State, range};
use crate::storey::Sign;
use crate::tall_run;

/// A relative velocity below this fraction of the change of its floor's in a step has lost too many digits.
pub(crate) const SMALL_DIFFERENCE: f64 = 1e-6;

/// What bounds the fourth derivatives of drifts, drift rates, floor accelerations and block velocities.
pub(crate) const MARGINS: [Row; 4] =
    [Row::FourthOfDrift, Row::FourthOfRate, Row::FourthOfAcceleration, Row::ThirdOfAcceleration];

/// Rows (dx, dv, a, j) of a column of the step.
type Column<const K: usize> = [[[f64; WIDTH]; K]; 4];

/// What a run of plain steps reads.
struct Course<'a, const K: usize> {
    regime: &'a Regime,
    h: f64,
    /// Columns of the step: of each drift, of each drift rate, of the ground acceleration and of its change.
    of_drift: &'a [Column<K>],
    of_rate: &'a [Column<K>],
    of_ground: &'a Column<K>,
    of_change: &'a Column<K>,
    /// Effect of constant floor loads; with vertical motion, of friction at unit contact force and at a unit ramp.
    constant: &'a Column<K>,
    friction: &'a Column<K>,
    friction_ramp: &'a Column<K>,
}

impl<'a, const K: usize> Course<'a, K> {
    /// None where the regime has no propagator of this width.
    #[inline(always)]
    fn new(state: &'a State, h: f64) -> Option<Self> {
        let regime = state.regime();
        let Whole::Dense(propagator) = &regime.steps.as_deref()?.whole else { return None };
        let (of_drift, others) = four_rows(propagator.state_and_motion_columns()).split_at_checked(state.storeys())?;
        let (of_rate, others) = others.split_at_checked(state.storeys())?;
        let [of_ground, of_change, ..] = others else { return None };
        let first = |values: &'a [f64]| four_rows(values).first();
        Some(Self {
            regime,
            h,
            of_drift,
            of_rate,
            of_ground,
            of_change,
            constant: first(&state.effects.constant)?,
            friction: first(&state.effects.friction)?,
            friction_ramp: first(&state.effects.friction_ramp)?,
        })
    }
}

#[inline(always)]
fn four_rows<const K: usize>(values: &[f64]) -> &[Column<K>] {
    columns_of::<K>(values).as_chunks::<4>().0
}

/// The state at a sample: drifts, drift rates, floor accelerations, their rates, and drift accelerations.
#[derive(Clone, Copy)]
struct Sample<V, const K: usize> {
    x: [V; K],
    v: [V; K],
    a: [V; K],
    jerk: [V; K],
    q: [V; K],
}

impl<V: Vector, const K: usize> Sample<V, K> {
    #[inline(always)]
    fn of(state: &State) -> Self {
        Self {
            x: load(&state.x),
            v: load(&state.v),
            a: load(&state.a),
            jerk: load(&state.jerk),
            q: load(&state.drift_acceleration),
        }
    }

    #[inline(always)]
    fn values(&self) -> Values<K> {
        let zero = [[0.0; WIDTH]; K];
        let mut values = Values { x: zero, v: zero, a: zero, jerk: zero, q: zero };
        for k in 0..K {
            self.x[k].store(&mut values.x[k]);
            self.v[k].store(&mut values.v[k]);
            self.a[k].store(&mut values.a[k]);
            self.jerk[k].store(&mut values.jerk[k]);
            self.q[k].store(&mut values.q[k]);
        }
        values
    }
}

/// A [`Sample`] as numbers.
struct Values<const K: usize> {
    x: [[f64; WIDTH]; K],
    v: [[f64; WIDTH]; K],
    a: [[f64; WIDTH]; K],
    jerk: [[f64; WIDTH]; K],
    q: [[f64; WIDTH]; K],
}

/// The same, of any width.
#[derive(Clone, Copy)]
struct SampleValues<'a> {
    x: &'a [f64],
    v: &'a [f64],
    a: &'a [f64],
    jerk: &'a [f64],
    q: &'a [f64],
}

impl<const K: usize> Values<K> {
    fn as_slices(&self) -> SampleValues<'_> {
        SampleValues {
            x: self.x.as_flattened(),
            v: self.v.as_flattened(),
            a: self.a.as_flattened(),
            jerk: self.jerk.as_flattened(),
            q: self.q.as_flattened(),
        }
    }
}

/// The bounds of [`crate::bounds::Bounds`] in vectors.
struct BoundsInLanes<V, const K: usize> {
    middle: [V; K],
    reach: [V; K],
    sign: [V; K],
    turn: [V; K],
    stuck_mu: [V; K],
    a_peak: [V; K],
}

impl<V: Vector, const K: usize> BoundsInLanes<V, K> {
    #[inline(always)]
    fn of(state: &State) -> Self {
        let bounds = &state.bounds;
        Self {
            middle: load(&bounds.middle),
            reach: load(&bounds.reach),
            sign: load(&bounds.sign),
            turn: load(&bounds.turn),
            stuck_mu: load(&bounds.stuck_mu),
            a_peak: load(&bounds.a_peak),
        }
    }

    /// How far values are from their middles after h / 3 at their rates, to either side: of drifts, of the negative of
    /// plastic storeys' rates, of accelerations.
    #[inline(always)]
    fn apart(&self, sample: &Sample<V, K>, third: V) -> [[V; K]; 3] {
        let mut out = [sample.x, sample.v, sample.a];
        for k in 0..K {
            out[0][k] = third.mul_add(sample.v[k].abs(), sample.x[k].sub(self.middle[k]).abs());
            out[1][k] = third.mul(sample.q[k].abs()).sub(self.sign[k].mul(sample.v[k]));
            out[2][k] = third.mul_add(sample.jerk[k].abs(), sample.a[k].abs());
        }
        out
    }

    /// Follows peaks that are beaten from here on: accelerations are taken at each sample; drifts at the end of the run,
    /// up to which their rates must keep their signs.
    #[inline(always)]
    fn follow(
        &mut self,
        peaks: &BeatenPeaks,
        state: &State,
        observer: &mut Observer,
        sample: &Sample<V, K>,
        time: f64,
    ) {
        if peaks.acceleration != 0 {
            let (a, mut a_peak) = (numbers(&sample.a), numbers(&self.a_peak));
            for i in members(peaks.acceleration) {
                observer.take_acceleration(i, a.as_flattened()[i], time);
                a_peak.as_flattened_mut()[i] = observer.peaks.floor_acceleration[i].value;
            }
            self.a_peak = load(a_peak.as_flattened());
        }
        if peaks.drift != 0 {
            let v = numbers(&sample.v);
            let (mut middle, mut reach) = (numbers(&self.middle), numbers(&self.reach));
            let (mut sign, mut turn) = (numbers(&self.sign), numbers(&self.turn));
            for i in members(peaks.drift) {
                (middle.as_flattened_mut()[i], reach.as_flattened_mut()[i]) = middle_and_reach(state.guarded_drift(i));
                (sign.as_flattened_mut()[i], turn.as_flattened_mut()[i]) = (v.as_flattened()[i].signum(), 0.0);
            }
            self.middle = load(middle.as_flattened());
            self.reach = load(reach.as_flattened());
            self.sign = load(sign.as_flattened());
            self.turn = load(turn.as_flattened());
        }
    }
}

/// Storeys and floors, as bits, whose peaks a step beats.
#[derive(Default)]
struct BeatenPeaks {
    drift: Set,
    acceleration: Set,
}

/// Blocks that slide, at most one of each floor.
struct Layer<V, const K: usize> {
    /// Of each floor its block, if there is one.
    block: [[Option<usize>; WIDTH]; K],
    /// Sign times mu_k.
    friction: [V; K],
    sign: [V; K],
    /// What the negative of sign times velocity may not reach: 0; far where there is no block.
    turn: [V; K],
    velocity: [V; K],
    slip: [V; K],
    /// h / 3 times the size of the relative acceleration, less sign times velocity.
    approach: [V; K],
    /// Velocity and approach at the end of the step.
    velocity_after: [V; K],
    approach_after: [V; K],
}

/// A block that slides on the ground.
pub(crate) struct GroundBlock {
    pub(crate) block: usize,
    pub(crate) friction: f64,
    pub(crate) sign: f64,
    pub(crate) velocity: f64,
    pub(crate) slip: f64,
}

/// Values at both ends of an interval of what is linear between them.
#[derive(Clone, Copy)]
pub(crate) struct Linear {
    pub(crate) start: f64,
    pub(crate) end: f64,
}

impl Linear {
    /// Integral over the length `h`.
    #[inline(always)]
    pub(crate) fn once(self, h: f64) -> f64 {
        0.5 * h * (self.start + self.end)
    }

    /// Second integral over the length `h`.
    #[inline(always)]
    pub(crate) fn twice(self, h: f64) -> f64 {
        (1.0 / 6.0) * h * h * (2.0 * self.start + self.end)
    }
}

/// The blocks that slide on floors, in layers, and those on the ground. Most often there is one layer: it needs no
/// allocation.
#[inline(always)]
fn layers<V: Vector, const K: usize>(state: &State) -> (Layers<V, K>, Vec<GroundBlock>) {
    let mut places: Vec<[[Option<usize>; WIDTH]; K]> = Vec::new();
    let mut lowest = [[None; WIDTH]; K];
    let mut on_ground = Vec::new();
    for (block, (motion, law)) in state.motions.iter().zip(&state.model.blocks).enumerate() {
        let Some(sign) = motion.sliding().map(Sign::factor) else { continue };
        let Some(i) = law.floor.checked_sub(1) else {
            on_ground.push(GroundBlock {
                block,
                friction: sign * law.mu_k,
                sign,
                velocity: motion.velocity,
                slip: motion.slip,
            });
            continue;
        };
        let taken = |place: &[[Option<usize>; WIDTH]; K]| place.as_flattened()[i].is_some();
        if !taken(&lowest) {
            lowest.as_flattened_mut()[i] = Some(block);
        } else if let Some(place) = places.iter_mut().find(|place| !taken(place)) {
            place.as_flattened_mut()[i] = Some(block);
        } else {
            let mut place = [[None; WIDTH]; K];
            place.as_flattened_mut()[i] = Some(block);
            places.push(place);
        }
    }
    let others = if places.is_empty() { Vec::new() } else { places.into_iter().map(|p| layer(state, p)).collect() };
    (Layers { lowest: layer(state, lowest), others }, on_ground)
}

#[inline(always)]
fn layer<V: Vector, const K: usize>(state: &State, block: [[Option<usize>; WIDTH]; K]) -> Layer<V, K> {
    let zero = [[0.0; WIDTH]; K];
    let (mut friction, mut sign, mut turn) = (zero, zero, [[FAR; WIDTH]; K]);
    let (mut velocity, mut slip) = (zero, zero);
    for (i, &j) in block.as_flattened().iter().enumerate() {
        let Some(j) = j else { continue };
        let motion = &state.motions[j];
        let factor = motion.sliding().map_or(0.0, Sign::factor);
        friction.as_flattened_mut()[i] = factor * state.model.blocks[j].mu_k;
        sign.as_flattened_mut()[i] = factor;
        turn.as_flattened_mut()[i] = 0.0;
        velocity.as_flattened_mut()[i] = motion.velocity;
        slip.as_flattened_mut()[i] = motion.slip;
    }
    let nothing = [V::splat(0.0); K];
    Layer {
        block,
        friction: load(friction.as_flattened()),
        sign: load(sign.as_flattened()),
        turn: load(turn.as_flattened()),
        velocity: load(velocity.as_flattened()),
        slip: load(slip.as_flattened()),
        approach: nothing,
        velocity_after: nothing,
        approach_after: nothing,
    }
}

/// Layers of sliding blocks.
struct Layers<V, const K: usize> {
    lowest: Layer<V, K>,
    others: Vec<Layer<V, K>>,
}

impl<V, const K: usize> Layers<V, K> {
    #[inline(always)]
    fn iter(&self) -> impl Iterator<Item = &Layer<V, K>> {
        std::iter::once(&self.lowest).chain(&self.others)
    }

    #[inline(always)]
    fn get(&mut self, which: usize) -> &mut Layer<V, K> {
        if which == 0 { &mut self.lowest } else { &mut self.others[which - 1] }
    }
}

impl<V: Vector, const K: usize> Layer<V, K> {
    #[inline(always)]
    fn approach_at(&self, velocity: &[V; K], a: &[V; K], contact: f64, third: V) -> [V; K] {
        let mut out = *velocity;
        for k in 0..K {
            let rate = self.friction[k].mul(V::splat(contact)).add(a[k]);
            out[k] = third.mul(rate.abs()).sub(self.sign[k].mul(velocity[k]));
        }
        out
    }
}

/// Changes of floor velocities over a step, and of floor displacements beyond those of the velocities at its start.
struct FloorMotion<V, const K: usize> {
    velocity: [V; K],
    displacement: [V; K],
}

/// rows += column * weight.
#[inline(always)]
fn add<V: Vector, const K: usize>(rows: &mut [[V; K]; 4], column: &Column<K>, weight: V) {
    for r in 0..4 {
        for k in 0..K {
            rows[r][k] = V::load(&column[r][k]).mul_add(weight, rows[r][k]);
        }
    }
}

/// rows += columns * weights.
#[inline(always)]
fn multiply<V: Vector, const K: usize, const S: usize>(
    rows: &mut [[V; K]; 4],
    columns: &[Column<K>],
    weights: &[V; K],
) {
    if S > 0 {
        let Some(columns) = columns.first_chunk::<S>() else { return };
        for c in 0..S {
            add(rows, &columns[c], weights[0].broadcast(c));
        }
    } else {
        // Two rows at a time: more would not stay in the registers of every path.
        let values = numbers(weights);
        for pair in [[0, 1], [2, 3]] {
            for (column, &weight) in columns.iter().zip(values.as_flattened()) {
                let weight = V::splat(weight);
                for r in pair {
                    for k in 0..K {
                        rows[r][k] = V::load(&column[r][k]).mul_add(weight, rows[r][k]);
                    }
                }
            }
        }
    }
}

/// Lanes, as bits, in which the larger of two values and a margin times its factor are not below a bound.
#[inline(always)]
fn not_clear<V: Vector>((before, after): (V, V), margin: V, factor: V, bound: V) -> Set {
    Set::from(margin.mul_add(factor, before.max(after)).not_below(bound))
}

/// Takes plain steps from interval `first` until `end`, or until one is not plain; returns the interval reached. `S` is
/// the number of storeys where it is known, else 0; `SLIDING`: blocks may slide on floors.
#[inline(always)]
fn run_lanes<V: Vector, const K: usize, const S: usize, const SLIDING: bool, const VERTICAL: bool>(
    state: &mut State,
    observer: &mut Observer,
    motion: &Motion,
    first: usize,
    end: usize,
) -> usize {
    let Some(course) = Course::<K>::new(state, motion.dt()) else { return first };
    let h = course.h;
    let (length, third, per_second) = (V::splat(h), V::splat(h / 3.0), 1.0 / h);
    let regime = course.regime;
    let (mass, tangent): ([V; K], [V; K]) = (regime.lanes(Row::RootMass), regime.lanes(Row::RootTangent));
    let mut margins = [[V::splat(0.0); K]; 4];
    for which in 0..4 {
        margins[which] = regime.lanes(MARGINS[which]);
    }
    let growth = course.regime.growth_over(h);
    let widening = h * h * h * h / 384.0;
    let mut sample = Sample::<V, K>::of(state);
    let mut bounds = BoundsInLanes::<V, K>::of(state);
    let (mut layers, mut on_ground) = layers::<V, K>(state);
    let watches_ground = !on_ground.is_empty() || state.stuck_mu[0].is_finite();
    let samples = motion.acceleration();
    let vertical = motion.vertical().unwrap_or(&[]);
    let contact_at = |i: usize| if VERTICAL { STANDARD_GRAVITY + vertical[i] } else { STANDARD_GRAVITY };
    // Rate of the floor accelerations per slope of the contact force: it turns at every sample.
    let mut turning: [V; K] = load(&state.friction);
    for (turning, inverse_mass) in turning.iter_mut().zip(regime.lanes::<V, K>(Row::InverseMass)) {
        *turning = turning.mul(inverse_mass);
    }
    let mut slope_before = if VERTICAL { (contact_at(first + 1) - contact_at(first)) * per_second } else { 0.0 };
    let mut apart_before = bounds.apart(&sample, third);
    for which in 0..=layers.others.len() {
        let layer = layers.get(which);
        layer.approach = layer.approach_at(&layer.velocity, &sample.a, contact_at(first), third);
    }
    // Velocity and slip of all blocks, as histories have them.
    let mut blocks: Vec<(f64, f64)> = match observer.histories {
        Some(_) => state.motions.iter().map(|m| (m.velocity, m.slip)).collect(),
        None => Vec::new(),
    };
    let within = bounds::first(state.storeys());
    let mut follows_drifts = false;
    let mut reached = first;
    for (pair, next) in samples[first..=end].windows(2).zip(first + 1..) {
        let (before, after) = (pair[0], pair[1]);
        let change = after - before;
        let contact = (contact_at(next - 1), contact_at(next));
        if VERTICAL {
            let slope = (contact.1 - contact.0) * per_second;
            for k in 0..K {
                sample.jerk[k] = turning[k].mul_add(V::splat(slope - slope_before), sample.jerk[k]);
                apart_before[2][k] = third.mul_add(sample.jerk[k].abs(), sample.a[k].abs());
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
        let liveliness = sizes.sum() * growth;
        let margin = V::splat(liveliness * widening);
        // The step.
        let mut rows = [[V::splat(0.0); K]; 4];
        let (ground, ramp) = (V::splat(before), V::splat(change));
        for r in 0..4 {
            for k in 0..K {
                let constant = V::load(&course.constant[r][k]);
                let row = V::load(&course.of_change[r][k]).mul_add(ramp, constant);
                rows[r][k] = V::load(&course.of_ground[r][k]).mul_add(ground, row);
                if VERTICAL {
                    let friction = V::load(&course.friction[r][k]).mul_add(V::splat(contact.0), rows[r][k]);
                    rows[r][k] =
                        V::load(&course.friction_ramp[r][k]).mul_add(V::splat(contact.1 - contact.0), friction);
                }
            }
        }
        multiply::<V, K, S>(&mut rows, course.of_drift, &sample.x);
        if S > 0 {
            // Two sums: half the latency of one, which is what a small step waits for.
            let mut of_rates = [[V::splat(0.0); K]; 4];
            multiply::<V, K, S>(&mut of_rates, course.of_rate, &sample.v);
            for r in 0..4 {
                for k in 0..K {
                    rows[r][k] = rows[r][k].add(of_rates[r][k]);
                }
            }
        } else {
            multiply::<V, K, S>(&mut rows, course.of_rate, &sample.v);
        }
        let [dx, dv, a, jerk] = rows;
        let mut taken = Sample { x: sample.x, v: sample.v, a, jerk, q: differences(&a, V::splat(after)) };
        for k in 0..K {
            taken.x[k] = sample.x[k].add(dx[k]);
            taken.v[k] = sample.v[k].add(dv[k]);
        }
        // The proof.
        let apart_after = bounds.apart(&taken, third);
        let least_contact = V::splat(if contact.0 < contact.1 { contact.0 } else { contact.1 });
        let (mut drifts, mut rates, mut accelerations): (Set, Set, Set) = (0, 0, 0);
        let mut turning_blocks = 0;
        for k in 0..K {
            let most = |which: usize| (apart_before[which][k], apart_after[which][k]);
            let limit = bounds.stuck_mu[k].mul(least_contact).min(bounds.a_peak[k]);
            drifts |= not_clear(most(0), margin, margins[0][k], bounds.reach[k]) << (WIDTH * k);
            rates |= not_clear(most(1), margin, margins[1][k], bounds.turn[k]) << (WIDTH * k);
            accelerations |= not_clear(most(2), margin, margins[2][k], limit) << (WIDTH * k);
        }
        let (ground, push) = (Linear { start: before, end: after }, Linear { start: contact.0, end: contact.1 });
        let mut floors = FloorMotion { velocity: dv, displacement: dx };
        if SLIDING {
            floors.velocity = prefix_sums(&dv);
            let displacement = V::splat(push.once(h));
            let shift = V::splat(ground.once(h));
            for which in 0..=layers.others.len() {
                let layer = layers.get(which);
                for k in 0..K {
                    let pushed = layer.friction[k].mul_add(displacement, shift);
                    layer.velocity_after[k] = layer.velocity[k].sub(pushed.add(floors.velocity[k]));
                }
                layer.approach_after = layer.approach_at(&layer.velocity_after, &taken.a, contact.1, third);
                // A velocity that is a small difference of large ones is left to the series.
                let digits = V::splat(-SMALL_DIFFERENCE);
                for k in 0..K {
                    let most = layer.approach[k].max(layer.approach_after[k]);
                    let bound = digits.mul_add(floors.velocity[k].abs(), layer.turn[k]);
                    turning_blocks |= margin.mul_add(margins[3][k], most).not_below(bound);
                }
            }
        }
        let mut beaten = BeatenPeaks::default();
        if drifts | rates | accelerations != 0 || SLIDING && turning_blocks != 0 {
            let (at_start, at_end) = (sample.values(), taken.values());
            let (middle, reach, sign) = (numbers(&bounds.middle), numbers(&bounds.reach), numbers(&bounds.sign));
            let mut step = Closer {
                state,
                observer,
                start: at_start.as_slices(),
                end: at_end.as_slices(),
                h,
                contact,
                liveliness,
                middle: middle.as_flattened(),
                reach: reach.as_flattened(),
                sign: sign.as_flattened(),
                beaten: BeatenPeaks::default(),
            };
            if !step.look([drifts, rates, accelerations], within)
                || SLIDING && turning_blocks != 0 && layers.iter().any(|layer| step.may_turn(layer))
            {
                break;
            }
            beaten = step.beaten;
        }
        if VERTICAL && !(contact.0 > 0.0 && contact.1 > 0.0)
            || watches_ground && !move_on_ground(&mut on_ground, ground, push, h, state.stuck_mu[0])
        {
            break;
        }
        if SLIDING {
            for k in 0..K {
                floors.displacement[k] = dx[k].sub(length.mul(sample.v[k]));
            }
            floors.displacement = prefix_sums(&floors.displacement);
            let (push, ground) = (V::splat(push.twice(h)), V::splat(ground.twice(h)));
            for which in 0..=layers.others.len() {
                let layer = layers.get(which);
                for k in 0..K {
                    let pushed = layer.friction[k].mul_add(push, ground);
                    let own = length.mul(layer.velocity[k]).sub(pushed.add(floors.displacement[k]));
                    layer.slip[k] = layer.slip[k].add(own);
                }
                (layer.velocity, layer.approach) = (layer.velocity_after, layer.approach_after);
            }
        }
        (sample, apart_before) = (taken, apart_after);
        reached = next;
        if beaten.drift | beaten.acceleration != 0 {
            follows_drifts |= beaten.drift != 0;
            bounds.follow(&beaten, state, observer, &sample, reached as f64 * h);
            apart_before = bounds.apart(&sample, third);
        }
        if observer.records(reached) {
            let values = sample.values();
            let values = values.as_slices();
            block_values(&layers, &on_ground, |block, velocity, slip| blocks[block] = (velocity, slip));
            observer.record_row(state, values.x, values.v, values.a, blocks.iter().copied());
        }
    }
    if reached > first {
        store(&sample.x, &mut state.x);
        store(&sample.v, &mut state.v);
        store(&sample.a, &mut state.a);
        store(&sample.jerk, &mut state.jerk);
        store(&sample.q, &mut state.drift_acceleration);
        let motions = &mut state.motions;
        block_values(&layers, &on_ground, |block, velocity, slip| {
            (motions[block].velocity, motions[block].slip) = (velocity, slip);
        });
        if follows_drifts {
            observer.observe_values(state, reached as f64 * h);
        }
    }
    reached
}

/// Calls `visit(block, velocity, slip)` for all sliding blocks.
#[inline(always)]
fn block_values<V: Vector, const K: usize>(
    layers: &Layers<V, K>,
    on_ground: &[GroundBlock],
    mut visit: impl FnMut(usize, f64, f64),
) {
    for which in 0..=layers.others.len() {
        let layer = if which == 0 { &layers.lowest } else { &layers.others[which - 1] };
        let (velocity, slip) = (numbers(&layer.velocity), numbers(&layer.slip));
        let (velocity, slip) = (velocity.as_flattened(), slip.as_flattened());
        for (i, &block) in layer.block.as_flattened().iter().enumerate() {
            if let Some(block) = block {
                visit(block, velocity[i], slip[i]);
            }
        }
    }
    on_ground.iter().for_each(|b| visit(b.block, b.velocity, b.slip));
}

/// Moves the blocks that slide on the ground over a step; false when one may have turned, or one that is stuck broken
/// away: then nothing is moved.
#[inline(never)]
pub(crate) fn move_on_ground(
    blocks: &mut [GroundBlock],
    ground: Linear,
    contact: Linear,
    h: f64,
    stuck_mu: f64,
) -> bool {
    if stuck_mu.is_finite()
        && !(ground.start.abs() < stuck_mu * contact.start && ground.end.abs() < stuck_mu * contact.end)
    {
        return false;
    }
    let end = |b: &GroundBlock| b.velocity - b.friction * contact.once(h) - ground.once(h);
    let keeps = |b: &GroundBlock| {
        let rate = (-b.friction * contact.start - ground.start, -b.friction * contact.end - ground.end);
        let (low, high) = range(b.velocity, rate.0, end(b), rate.1, h / 3.0, 0.0);
        if b.sign > 0.0 { low > 0.0 } else { high < 0.0 }
    };
    if !blocks.iter().all(keeps) {
        return false;
    }
    for block in blocks {
        block.slip += block.velocity * h - block.friction * contact.twice(h) - ground.twice(h);
        block.velocity = end(block);
    }
    true
}

/// A step that the loop did not clear.
struct Closer<'a, 'b> {
    state: &'a State<'b>,
    observer: &'a Observer,
    start: SampleValues<'a>,
    end: SampleValues<'a>,
    h: f64,
    contact: (f64, f64),
    liveliness: f64,
    /// Middles of the drifts' bounds, and how far they may go from them.
    middle: &'a [f64],
    reach: &'a [f64],
    /// Signs that drift rates must keep: of plastic storeys, and where a peak is followed; 0 elsewhere.
    sign: &'a [f64],
    /// Peaks that may be beaten, at the end of the step.
    beaten: BeatenPeaks,
}

impl Closer<'_, '_> {
    /// h^4 / 384 times the liveliness: what bounds of fourth derivatives are multiplied with.
    fn remainder(&self) -> f64 {
        let h2 = self.h * self.h;
        self.liveliness * (h2 * h2 / 384.0)
    }

    /// Whether no guard of these storeys and floors fell and no peak was beaten inside the step. Suspects are those whose
    /// drifts, drift rates and accelerations the loop did not clear.
    #[inline(never)]
    fn look(&mut self, [drifts, rates, accelerations]: [Set; 3], within: Set) -> bool {
        members(rates & within).all(|i| self.keeps_direction(i))
            && members(drifts & within).all(|i| self.stays_in_bounds(i))
            && members(accelerations & within).all(|i| self.holds_blocks(i))
    }

    #[inline]
    fn rate_range(&self, i: usize) -> (f64, f64) {
        let (start, end) = (self.start, self.end);
        let margin = self.remainder() * self.state.regime().row(Row::FourthOfRate)[i];
        range(start.v[i], start.q[i], end.v[i], end.q[i], self.h / 3.0, margin)
    }

    /// Whether the drift rate of a storey keeps the sign that it must keep.
    #[inline]
    fn keeps_direction(&self, i: usize) -> bool {
        let (low, high) = self.rate_range(i);
        match self.sign[i] {
            0.0 => true,
            sign if sign > 0.0 => low > 0.0,
            _ => high < 0.0,
        }
    }

    /// Whether a storey neither yields nor collapses, and beats no peak, or at the end of the step.
    #[inline]
    fn stays_in_bounds(&mut self, i: usize) -> bool {
        let (start, end) = (self.start, self.end);
        let margin = self.remainder() * self.state.regime().row(Row::FourthOfDrift)[i];
        let (low, high) = range(start.x[i], start.v[i], end.x[i], end.v[i], self.h / 3.0, margin);
        if high < self.middle[i] + self.reach[i] && low > self.middle[i] - self.reach[i] {
            return true;
        }
        let (lower, upper) = self.state.guarded_drift(i);
        let rate = self.rate_range(i);
        self.beaten.drift |= 1 << i;
        high < upper && low > lower && (rate.0 > 0.0 || rate.1 < 0.0)
    }

    /// Whether no block breaks away from a floor, and its acceleration beats no peak, or at the end of the step.
    #[inline]
    fn holds_blocks(&mut self, i: usize) -> bool {
        let (start, end) = (self.start, self.end);
        let regime = self.state.regime();
        let margin = self.remainder() * regime.row(Row::FourthOfAcceleration)[i];
        let (low, high) = range(start.a[i], start.jerk[i], end.a[i], end.jerk[i], self.h / 3.0, margin);
        let size = high.max(-low);
        let below_limit = size < self.state.stuck_mu[i + 1] * self.contact.0.min(self.contact.1);
        if !below_limit || size < self.observer.peaks.floor_acceleration[i].value {
            return below_limit;
        }
        // Between its ends the jerk differs from its chord by at most h^2 / 8 times its second derivative.
        let turn = 0.125 * self.h * self.h * self.liveliness * regime.row(Row::ThirdOfAcceleration)[i];
        let (jerk, jerk_end) = (start.jerk[i], end.jerk[i]);
        self.beaten.acceleration |= 1 << i;
        jerk * jerk_end > 0.0 && jerk.abs().min(jerk_end.abs()) > turn
    }

    /// Whether the relative velocity of a block may have turned.
    #[inline(never)]
    fn may_turn<V: Vector, const K: usize>(&self, layer: &Layer<V, K>) -> bool {
        let (before, after) = (numbers(&layer.velocity), numbers(&layer.velocity_after));
        let (before, after) = (before.as_flattened(), after.as_flattened());
        let margins = self.state.regime().row(Row::ThirdOfAcceleration);
        layer.block.as_flattened().iter().enumerate().filter_map(|(i, &block)| Some((i, block?))).any(|(i, block)| {
            let sign = self.state.motions[block].sliding().map_or(0.0, Sign::factor);
            let friction = sign * self.state.model.blocks[block].mu_k;
            let rates = (-friction * self.contact.0 - self.start.a[i], -friction * self.contact.1 - self.end.a[i]);
            let margin = self.remainder() * margins[i];
            let (low, high) = range(before[i], rates.0, after[i], rates.1, self.h / 3.0, margin);
            let floor: f64 = self.end.v[..=i].iter().zip(self.start.v).map(|(end, start)| end - start).sum();
            let least = SMALL_DIFFERENCE * floor.abs();
            !(if sign > 0.0 { low > least } else { high < -least })
        })
    }
}

for_each_path! {
    fn run(state: &mut State, observer: &mut Observer, motion: &Motion, first: usize, end: usize) -> usize = run_by_width
}

#[inline(always)]
fn run_by_width<V: Vector>(
    state: &mut State,
    observer: &mut Observer,
    motion: &Motion,
    first: usize,
    end: usize,
) -> usize {
    const WIDEST: usize = MAX_LANES / WIDTH;
    let sliding = state.motions.iter().zip(&state.model.blocks).any(|(m, law)| law.floor > 0 && m.sliding().is_some());
    match (state.storeys(), sliding, state.vertical) {
        (1, false, false) => run_lanes::<V, 1, 1, false, false>(state, observer, motion, first, end),
        (2, false, false) => run_lanes::<V, 1, 2, false, false>(state, observer, motion, first, end),
        (3, false, false) => run_lanes::<V, 1, 3, false, false>(state, observer, motion, first, end),
        (4, false, false) => run_lanes::<V, 1, 4, false, false>(state, observer, motion, first, end),
        (1, true, false) => run_lanes::<V, 1, 1, true, false>(state, observer, motion, first, end),
        (2, true, false) => run_lanes::<V, 1, 2, true, false>(state, observer, motion, first, end),
        (3, true, false) => run_lanes::<V, 1, 3, true, false>(state, observer, motion, first, end),
        (4, true, false) => run_lanes::<V, 1, 4, true, false>(state, observer, motion, first, end),
        (5..=8, _, false) => run_lanes::<V, 2, 0, true, false>(state, observer, motion, first, end),
        (9..=16, _, false) => run_lanes::<V, 4, 0, true, false>(state, observer, motion, first, end),
        (17..=32, _, false) => run_lanes::<V, 8, 0, true, false>(state, observer, motion, first, end),
        (_, _, false) => run_lanes::<V, WIDEST, 0, true, false>(state, observer, motion, first, end),
        (..=4, _, true) => run_lanes::<V, 1, 0, true, true>(state, observer, motion, first, end),
        (5..=8, _, true) => run_lanes::<V, 2, 0, true, true>(state, observer, motion, first, end),
        (9..=16, _, true) => run_lanes::<V, 4, 0, true, true>(state, observer, motion, first, end),
        (17..=32, _, true) => run_lanes::<V, 8, 0, true, true>(state, observer, motion, first, end),
        (_, _, true) => run_lanes::<V, WIDEST, 0, true, true>(state, observer, motion, first, end),
    }
}

impl State<'_> {
    /// Takes plain steps from interval `first` until `end`, or until one is not plain, and records their histories;
    /// returns the interval reached, whose start the state is then at.
    pub(crate) fn plain_run(&mut self, observer: &mut Observer, motion: &Motion, first: usize, end: usize) -> usize {
        if self.airborne || !self.cache.visit(self.regime, self.model, self.vertical) {
            return first;
        }
        let reached = match self.regime().steps.as_deref().map(|steps| &steps.whole) {
            Some(Whole::Tall(step)) => {
                let step = Arc::clone(step);
                tall_run::run(self, observer, motion, &step, first, end)
            }
            _ => {
                self.prepare_effects();
                self.update_bounds(observer);
                run(self, observer, motion, first, end)
            }
        };
        observer.observe_slips(self, reached as f64 * motion.dt());
        reached
    }

    /// Forms the effect of the floor loads on the step, if they have changed.
    fn prepare_effects(&mut self) {
        if self.effects.valid {
            return;
        }
        let Some(steps) = self.cache.regime(self.regime).steps.as_deref() else { return };
        let Whole::Dense(propagator) = &steps.whole else { return };
        let effects = &mut self.effects;
        if self.vertical {
            propagator.of_load(&self.spring_load, &mut effects.constant);
            propagator.of_load(&self.friction, &mut effects.friction);
            propagator.of_ramp(&self.friction, &mut effects.friction_ramp);
        } else {
            let loads = &mut self.loads;
            for ((load, spring), friction) in loads.iter_mut().zip(&self.spring_load).zip(&self.friction) {
                *load = spring + friction * STANDARD_GRAVITY;
            }
            propagator.of_load(loads, &mut effects.constant);
        }
        effects.valid = true;
    }
}
