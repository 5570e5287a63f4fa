//! Runs of whole sample intervals by the propagator, each accepted only when bounds prove that no guard fell inside it
//! and no peak was beaten at a turn.
//!
//! Value and rate at both ends give the Bezier points of a cubic; the quantity differs from that cubic by at most
//! h^4 / 384 times its largest fourth derivative, which the regime bounds. Storeys are lanes of fixed-size arrays, so
//! that the compiler makes vectors of them; the widest vectors of the machine are chosen at run time.

use crate::STANDARD_GRAVITY;
use crate::lanes::{InstructionSet, MAX_LANES, multiply_add, padded};
use crate::observe::Observer;
use crate::regime::Regime;
use crate::scene::Motion;
use crate::state::State;

/// A block that slides, as the loop needs it.
struct Sliding {
    block: usize,
    floor: usize,
    friction: f64,
    positive: bool,
    velocity: f64,
    slip: f64,
}

/// Rows (dx, dv, a, j) of a column of the step.
type Column<const N: usize> = [[f64; N]; 4];

/// What a run of plain steps reads.
struct Course<'a, const N: usize> {
    regime: &'a Regime,
    h: f64,
    /// Columns of the step: of each drift, of each drift rate, of the ground acceleration and of its change.
    of_drift: &'a [Column<N>],
    of_rate: &'a [Column<N>],
    of_ground: &'a Column<N>,
    of_change: &'a Column<N>,
    /// Effect of constant floor loads; with vertical motion, of friction at unit contact force and at a unit ramp.
    constant: &'a Column<N>,
    friction: &'a Column<N>,
    friction_ramp: &'a Column<N>,
    is_vertical: bool,
    /// Smallest mu_s of the blocks stuck to the ground.
    ground_mu: f64,
}

impl<'a, const N: usize> Course<'a, N> {
    /// None where the regime has no propagator of this width.
    fn new(state: &'a State, h: f64) -> Option<Self> {
        let regime = state.regime();
        let propagator = regime.propagator.as_deref()?;
        let (of_drift, of_rate) = columns(propagator.state_columns()).split_at_checked(state.storeys())?;
        let (of_ground, of_change) = propagator.motion_columns();
        let first = |values: &'a [f64]| columns(values).first();
        Some(Self {
            regime,
            h,
            of_drift,
            of_rate,
            of_ground: first(of_ground)?,
            of_change: first(of_change)?,
            constant: first(&state.effects.constant)?,
            friction: first(&state.effects.friction)?,
            friction_ramp: first(&state.effects.friction_ramp)?,
            is_vertical: state.vertical,
            ground_mu: state.stuck_mu[0],
        })
    }
}

/// Values as columns of four rows of lanes.
fn columns<const N: usize>(values: &[f64]) -> &[Column<N>] {
    values.as_chunks::<N>().0.as_chunks::<4>().0
}

/// State and bounds of the storeys in lanes; lanes beyond the last storey hold zeros and no bounds.
struct Lanes<const N: usize> {
    x: [f64; N],
    v: [f64; N],
    a: [f64; N],
    jerk: [f64; N],
    /// Second derivative of the drifts.
    q: [f64; N],
    mass: [f64; N],
    tangent: [f64; N],
    /// Bounds of fourth derivatives per unit of liveliness: of drift, drift rate and floor acceleration.
    drift_margin: [f64; N],
    rate_margin: [f64; N],
    acceleration_margin: [f64; N],
    /// Drift coordinates between which no storey yields or collapses, and which beat no peak.
    x_low: [f64; N],
    x_high: [f64; N],
    /// Drift rates between which plastic storeys do not unload.
    v_low: [f64; N],
    v_high: [f64; N],
    /// Smallest mu_s of the blocks stuck to each floor; infinite where none is.
    stuck_mu: [f64; N],
    /// Peak of the floor acceleration.
    a_peak: [f64; N],
}

/// A step that is formed but not taken yet.
struct Step<const N: usize> {
    x: [f64; N],
    v: [f64; N],
    a: [f64; N],
    jerk: [f64; N],
    q: [f64; N],
    ground: (f64, f64),
    contact: (f64, f64),
    liveliness: f64,
}

#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Range of the cubic through values and rates at both ends, widened by `margin`.
#[inline(always)]
fn range(start: f64, start_rate: f64, end: f64, end_rate: f64, third: f64, margin: f64) -> (f64, f64) {
    let (first, second) = (start + third * start_rate, end - third * end_rate);
    let low = smaller(smaller(start, end), smaller(first, second));
    let high = larger(larger(start, end), larger(first, second));
    (low - margin, high + margin)
}

impl<const N: usize> Lanes<N> {
    fn load(state: &State, observer: &Observer) -> Self {
        let n = state.storeys();
        let regime = state.regime();
        let fill = |values: &[f64]| {
            let mut lanes = [0.0; N];
            lanes[..n].copy_from_slice(values);
            lanes
        };
        let differences = |bounds: &[f64]| {
            let mut lanes = [0.0; N];
            for i in 0..n {
                lanes[i] = bounds[i] + if i > 0 { bounds[i - 1] } else { 0.0 };
            }
            lanes
        };
        let mut lanes = Self {
            x: fill(&state.x),
            v: fill(&state.v),
            a: fill(&state.a),
            jerk: fill(&state.jerk),
            q: fill(&state.drift_acceleration),
            mass: fill(&regime.mass),
            tangent: fill(&regime.tangent).map(f64::abs),
            drift_margin: differences(&regime.derivative_bounds[0]),
            rate_margin: differences(&regime.derivative_bounds[1]),
            acceleration_margin: fill(&regime.derivative_bounds[2]),
            x_low: [f64::NEG_INFINITY; N],
            x_high: [f64::INFINITY; N],
            v_low: [f64::NEG_INFINITY; N],
            v_high: [f64::INFINITY; N],
            stuck_mu: [f64::INFINITY; N],
            a_peak: [f64::INFINITY; N],
        };
        lanes.stuck_mu[..n].copy_from_slice(&state.stuck_mu[1..]);
        for i in 0..n {
            match state.springs[i].plastic().map(|sign| sign.factor()) {
                Some(1.0) => lanes.v_low[i] = 0.0,
                Some(_) => lanes.v_high[i] = 0.0,
                None => {}
            }
            lanes.set_bounds(i, state, observer);
        }
        lanes
    }

    /// Bounds of storey and floor `i` from its guards and peaks.
    fn set_bounds(&mut self, i: usize, state: &State, observer: &Observer) {
        let (yields, collapses) = (state.yield_bounds[i], state.collapse_bounds[i]);
        let quiet = observer.quiet_drift(state, i);
        self.x_low[i] = yields.0.max(collapses.0).max(quiet.0);
        self.x_high[i] = yields.1.min(collapses.1).min(quiet.1);
        self.a_peak[i] = observer.peaks.floor_acceleration[i].value;
    }

    fn store(&self, state: &mut State) {
        let n = state.storeys();
        state.x.copy_from_slice(&self.x[..n]);
        state.v.copy_from_slice(&self.v[..n]);
        state.a.copy_from_slice(&self.a[..n]);
        state.jerk.copy_from_slice(&self.jerk[..n]);
        state.drift_acceleration.copy_from_slice(&self.q[..n]);
    }

    /// Forms the step over an interval, whose samples are given.
    #[inline(always)]
    fn step<const FUSED: bool>(&self, course: &Course<N>, ground: (f64, f64), contact: (f64, f64)) -> Step<N> {
        let h = course.h;
        let change = ground.1 - ground.0;
        let slope = change / h;
        let mut square = [0.0; N];
        for l in 0..N {
            let jerk = self.jerk[l] - slope;
            square[l] = multiply_add::<FUSED>(self.mass[l] * jerk, jerk, self.tangent[l] * self.q[l] * self.q[l]);
        }
        let liveliness = course.regime.liveliness_of(square.iter().sum::<f64>(), h);
        let mut rows = *course.constant;
        for (row, (of_ground, of_change)) in rows.iter_mut().zip(course.of_ground.iter().zip(course.of_change)) {
            for l in 0..N {
                row[l] = multiply_add::<FUSED>(of_ground[l], ground.0, row[l]);
                row[l] = multiply_add::<FUSED>(of_change[l], change, row[l]);
            }
        }
        if course.is_vertical {
            for (row, (friction, ramp)) in rows.iter_mut().zip(course.friction.iter().zip(course.friction_ramp)) {
                for l in 0..N {
                    row[l] += friction[l] * contact.0 + ramp[l] * (contact.1 - contact.0);
                }
            }
        }
        for (columns, weights) in [(course.of_drift, &self.x), (course.of_rate, &self.v)] {
            for (column, &weight) in columns.iter().zip(weights) {
                for (row, entries) in rows.iter_mut().zip(column) {
                    for l in 0..N {
                        row[l] = multiply_add::<FUSED>(entries[l], weight, row[l]);
                    }
                }
            }
        }
        let [dx, dv, a, jerk] = rows;
        let (mut x, mut v, mut q) = (self.x, self.v, a);
        for l in 0..N {
            x[l] += dx[l];
            v[l] += dv[l];
        }
        q[0] -= ground.1;
        for l in 1..N {
            q[l] -= a[l - 1];
        }
        Step { x, v, a, jerk, q, ground, contact, liveliness }
    }

    /// How far the step is from being plain: negative when all storeys and floors are clear of guards and peaks.
    #[inline(always)]
    fn nearest(&self, step: &Step<N>, course: &Course<N>, remainder: f64) -> f64 {
        let third = course.h / 3.0;
        let contact = smaller(step.contact.0, step.contact.1);
        let mut nearest = [f64::NEG_INFINITY; N];
        for l in 0..N {
            let (low, high) =
                range(self.x[l], self.v[l], step.x[l], step.v[l], third, remainder * self.drift_margin[l]);
            let drift = larger(high - self.x_high[l], self.x_low[l] - low);
            let (low, high) = range(self.v[l], self.q[l], step.v[l], step.q[l], third, remainder * self.rate_margin[l]);
            let rate = larger(high - self.v_high[l], self.v_low[l] - low);
            let margin = remainder * self.acceleration_margin[l];
            let (low, high) = range(self.a[l], self.jerk[l], step.a[l], step.jerk[l], third, margin);
            let limit = smaller(self.stuck_mu[l] * contact, self.a_peak[l]);
            let acceleration = larger(high, -low) - limit;
            nearest[l] = larger(larger(drift, rate), acceleration);
        }
        nearest.into_iter().fold(f64::NEG_INFINITY, larger)
    }

    /// Whether all guards are clear, and peaks that may be beaten are beaten at the end of the step.
    fn is_clear_but_for_peaks(&self, step: &Step<N>, course: &Course<N>, state: &State) -> bool {
        let third = course.h / 3.0;
        let remainder = remainder(step, course);
        let contact = step.contact.0.min(step.contact.1);
        let one_signed = |(low, high): (f64, f64)| low > 0.0 || high < 0.0;
        (0..state.storeys()).all(|l| {
            let drift = range(self.x[l], self.v[l], step.x[l], step.v[l], third, remainder * self.drift_margin[l]);
            let rate = range(self.v[l], self.q[l], step.v[l], step.q[l], third, remainder * self.rate_margin[l]);
            let margin = remainder * self.acceleration_margin[l];
            let (low, high) = range(self.a[l], self.jerk[l], step.a[l], step.jerk[l], third, margin);
            let inside = |(lower, upper): (f64, f64)| drift.1 < upper && drift.0 > lower;
            let keeps_plastic = rate.0 > self.v_low[l] && rate.1 < self.v_high[l];
            let monotonic = inside((self.x_low[l], self.x_high[l])) || one_signed(rate);
            let size = high.max(-low);
            // Between its ends the jerk differs from its chord by at most h^2 / 8 times its second derivative.
            let turn = 0.125 * course.h * course.h * step.liveliness * course.regime.derivative_bounds[1][l];
            let (jerk, jerk_end) = (self.jerk[l], step.jerk[l]);
            let steady = jerk * jerk_end > 0.0 && jerk.abs().min(jerk_end.abs()) > turn;
            inside(state.yield_bounds[l])
                && inside(state.collapse_bounds[l])
                && keeps_plastic
                && monotonic
                && size < self.stuck_mu[l] * contact
                && (size < self.a_peak[l] || steady)
        })
    }

    fn take(&mut self, step: &Step<N>) {
        (self.x, self.v, self.a, self.jerk, self.q) = (step.x, step.v, step.a, step.jerk, step.q);
    }
}

/// h^4 / 384 times the liveliness: what a fourth derivative's bound is multiplied with.
#[inline(always)]
fn remainder<const N: usize>(step: &Step<N>, course: &Course<N>) -> f64 {
    let h2 = course.h * course.h;
    step.liveliness * (h2 * h2 / 384.0)
}

/// Moves the sliding blocks over the step; false, and nothing is moved, when one may have turned.
#[inline(always)]
fn move_blocks<const N: usize>(
    lanes: &Lanes<N>,
    step: &Step<N>,
    course: &Course<N>,
    remainder: f64,
    sliding: &mut [Sliding],
    moved: &mut [(f64, f64)],
) -> bool {
    let (ground, contact, h) = (step.ground, step.contact, course.h);
    if course.is_vertical && !(contact.0 > 0.0 && contact.1 > 0.0) {
        return false;
    }
    if course.ground_mu.is_finite()
        && !(ground.0.abs() < course.ground_mu * contact.0 && ground.1.abs() < course.ground_mu * contact.1)
    {
        return false;
    }
    let (ground_velocity, ground_displacement) = integrals(ground, h);
    let (contact_velocity, contact_displacement) = integrals(contact, h);
    for (block, moved) in sliding.iter().zip(moved.iter_mut()) {
        let (mut velocity, mut displacement, mut start) = (ground_velocity, ground_displacement, 0.0);
        let (mut a, mut margin) = (ground, 0.0);
        for l in 0..block.floor {
            velocity += step.v[l] - lanes.v[l];
            displacement += step.x[l] - lanes.x[l];
            start += lanes.v[l];
        }
        if block.floor > 0 {
            let l = block.floor - 1;
            a = (lanes.a[l], step.a[l]);
            margin = remainder * course.regime.derivative_bounds[1][l];
        }
        let end = block.velocity - block.friction * contact_velocity - velocity;
        let rate = (-block.friction * contact.0 - a.0, -block.friction * contact.1 - a.1);
        let (low, high) = range(block.velocity, rate.0, end, rate.1, h / 3.0, margin);
        if !(if block.positive { low > 0.0 } else { high < 0.0 }) {
            return false;
        }
        let slip = block.velocity * h - block.friction * contact_displacement - (displacement - start * h);
        *moved = (end, block.slip + slip);
    }
    for (block, &(velocity, slip)) in sliding.iter_mut().zip(moved.iter()) {
        (block.velocity, block.slip) = (velocity, slip);
    }
    true
}

/// First and second integral over `h` of a quantity that is linear between two values.
#[inline(always)]
fn integrals(ends: (f64, f64), h: f64) -> (f64, f64) {
    (0.5 * h * (ends.0 + ends.1), h * h * (2.0 * ends.0 + ends.1) / 6.0)
}

/// Takes plain steps from interval `first` until `end`, or until one is not plain; returns the interval reached.
#[inline(always)]
fn run_lanes<const N: usize, const FUSED: bool>(
    state: &mut State,
    observer: &mut Observer,
    motion: &Motion,
    first: usize,
    end: usize,
) -> usize {
    let mut lanes = Lanes::<N>::load(state, observer);
    let mut sliding: Vec<Sliding> = Vec::new();
    for (block, (motion, law)) in state.motions.iter().zip(&state.model.blocks).enumerate() {
        if let Some(sign) = motion.sliding() {
            sliding.push(Sliding {
                block,
                floor: law.floor,
                friction: sign.factor() * law.mu_k,
                positive: sign.factor() > 0.0,
                velocity: motion.velocity,
                slip: motion.slip,
            });
        }
    }
    let mut moved = vec![(0.0, 0.0); sliding.len()];
    // Velocity and slip of all blocks, as histories have them.
    let mut blocks: Vec<(f64, f64)> = state.motions.iter().map(|m| (m.velocity, m.slip)).collect();
    let watches_blocks = !sliding.is_empty() || state.stuck_mu[0].is_finite() || state.vertical;
    let Some(course) = Course::<N>::new(state, motion.dt()) else { return first };
    let samples = motion.acceleration();
    let gravity = (STANDARD_GRAVITY, STANDARD_GRAVITY);
    let mut i = first;
    for (pair, i_next) in samples[first..=end].windows(2).zip(first + 1..) {
        let contact = match motion.vertical() {
            Some(vertical) if course.is_vertical => (gravity.0 + vertical[i], gravity.1 + vertical[i_next]),
            _ => gravity,
        };
        let step = lanes.step::<FUSED>(&course, (pair[0], pair[1]), contact);
        let remainder = remainder(&step, &course);
        let plain = lanes.nearest(&step, &course, remainder) < 0.0 && remainder.is_finite();
        if !(plain || remainder.is_finite() && lanes.is_clear_but_for_peaks(&step, &course, state)) {
            break;
        }
        if watches_blocks && !move_blocks(&lanes, &step, &course, remainder, &mut sliding, &mut moved) {
            break;
        }
        lanes.take(&step);
        i = i_next;
        if !plain {
            let time = i as f64 * course.h;
            for l in 0..state.storeys() {
                if observer.take_floor(state, l, lanes.x[l], lanes.a[l], time) {
                    lanes.set_bounds(l, state, observer);
                }
            }
        }
        if observer.records(i) {
            sliding.iter().for_each(|b| blocks[b.block] = (b.velocity, b.slip));
            observer.record_row(state, &lanes.x, &lanes.v, &lanes.a, blocks.iter().copied());
        }
        if course.is_vertical {
            // The slope of the contact force turns at the sample, and the rates of the accelerations with it.
            break;
        }
    }
    if i > first {
        lanes.store(state);
        for block in &sliding {
            let motion = &mut state.motions[block.block];
            (motion.velocity, motion.slip) = (block.velocity, block.slip);
        }
    }
    i
}

macro_rules! for_lanes {
    ($name:ident, $fused:literal $(, $feature:literal)?) => {
        $(#[target_feature(enable = $feature)])?
        fn $name(state: &mut State, observer: &mut Observer, motion: &Motion, first: usize, end: usize) -> usize {
            match padded(state.storeys()) {
                4 => run_lanes::<4, $fused>(state, observer, motion, first, end),
                8 => run_lanes::<8, $fused>(state, observer, motion, first, end),
                16 => run_lanes::<16, $fused>(state, observer, motion, first, end),
                _ => run_lanes::<MAX_LANES, $fused>(state, observer, motion, first, end),
            }
        }
    };
}

for_lanes!(run_baseline, false);
#[cfg(target_arch = "x86_64")]
for_lanes!(run_avx2, true, "avx2,fma");
#[cfg(target_arch = "x86_64")]
for_lanes!(run_avx512, true, "avx2,fma,avx512f,avx512vl");

impl State<'_> {
    #[allow(unsafe_code)]
    /// Takes plain steps from interval `first` until `end`, or until one is not plain, and records their histories;
    /// returns the interval reached, whose start the state is then at.
    pub(crate) fn plain_run(&mut self, observer: &mut Observer, motion: &Motion, first: usize, end: usize) -> usize {
        let full_damping = self.has_full_damping();
        if self.airborne || !self.cache.visit(self.regime, self.model, full_damping, self.vertical) {
            return first;
        }
        self.prepare_effects();
        let reached = match InstructionSet::in_use() {
            #[cfg(target_arch = "x86_64")]
            // SAFETY: `in_use` returns only what this machine has.
            InstructionSet::Avx512 => unsafe { run_avx512(self, observer, motion, first, end) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: as above.
            InstructionSet::Avx2 => unsafe { run_avx2(self, observer, motion, first, end) },
            _ => run_baseline(self, observer, motion, first, end),
        };
        let time = reached as f64 * motion.dt();
        for (peak, motion) in observer.peaks.slip.iter_mut().zip(&self.motions) {
            peak.take(motion.slip, time);
        }
        reached
    }

    /// Forms the effect of the floor loads on the step, if they have changed.
    fn prepare_effects(&mut self) {
        if self.effects.valid {
            return;
        }
        let Some(propagator) = self.cache.regime(self.regime).propagator.as_deref() else { return };
        let effects = &mut self.effects;
        propagator.of_load(&self.spring_load, &mut effects.constant);
        propagator.of_load(&self.friction, &mut effects.friction);
        if self.vertical {
            propagator.of_ramp(&self.friction, &mut effects.friction_ramp);
        } else {
            for (constant, friction) in effects.constant.iter_mut().zip(&effects.friction) {
                *constant += friction * STANDARD_GRAVITY;
            }
        }
        effects.valid = true;
    }
}
