//! Runs of whole sample intervals of tall regimes: any number of storeys, at a cost that grows with it linearly by
//! banded steps, with its square by full ones.
//!
//! As in [`crate::plain_run`] each step is accepted only when bounds prove that no guard fell inside it. The loop looks
//! at each end with the cubic's margins. What this does not clear is looked at with the quintic through values and two
//! derivatives at both ends, which differs by at most h^6 / 46080 times the largest sixth derivative: the fourth of the
//! second, which the same norm bounds when it is taken of the second derivatives, of each storey's surroundings alone
//! ([`crate::tall_norms`]). Of a tall building some storey beats its peak in most steps: where one turns inside a step,
//! the series of that step gives the extreme, and the run goes on.

use crate::STANDARD_GRAVITY;
use crate::banded_step::{BandedStep, whole_blocks};
use crate::bernstein::{MAX_DEGREE, Polynomial};
use crate::bounds::{Set, members, signs};
use crate::events::NO_CONTACT;
use crate::full_step::{FullStep, Shears};
use crate::lanes::{Plain, Vector, WIDTH, at, filled_to, for_each_path, lanes, lanes_mut};
use crate::observe::Observer;
use crate::regime::Row;
use crate::scene::Motion;
use crate::sliding::{GroundBlock, Linear, SMALL_DIFFERENCE, move_on_ground};
use crate::state::{State, THIRD, off_cubic, range, ranges, turned};
use crate::storey::Sign;
use crate::symmetric::Symmetric;
use crate::tall_bounds::{Apart, Bounds};
use crate::tall_norms::{Norms, Rows, energy};
use crate::tall_step::TallStep;

/// Highest order of a series of floor accelerations; that of the drifts is two orders higher.
const HIGHEST_ORDER: usize = MAX_DEGREE - 2;
/// Order from which on its terms are looked at.
const LOWEST_ORDER: usize = 8;
/// What a series may leave out of a value, as a part of it.
const ROUNDING: f64 = 0.25 * f64::EPSILON;
/// The same as a part of the largest value in the building.
const FAR_BELOW: f64 = 1.0 / (1u64 << 60) as f64;

/// The state at a sample.
pub(crate) struct Sample {
    pub(crate) x: Vec<f64>,
    pub(crate) v: Vec<f64>,
    /// Floor accelerations, that of the ground before them.
    pub(crate) a: Vec<f64>,
    /// Their rates, after a place for that of the ground.
    pub(crate) jerk: Vec<f64>,
    /// Drift accelerations, with room for the band before and after them.
    pub(crate) q: Vec<f64>,
}

impl Sample {
    fn new(state: &State, length: usize, margin: usize) -> Self {
        let n = state.storeys();
        let lanes = |values: &[f64]| filled_to(length, values[..n].iter().copied(), 0.0);
        let mut q = vec![0.0; length + 2 * margin];
        q[margin..margin + n].copy_from_slice(&state.drift_acceleration[..n]);
        let floors =
            |values: &[f64]| filled_to(length + 1, std::iter::once(0.0).chain(values[..n].iter().copied()), 0.0);
        Self { x: lanes(&state.x), v: lanes(&state.v), a: floors(&state.a), jerk: floors(&state.jerk), q }
    }

    /// Puts the sample into the state.
    fn put(&self, state: &mut State, margin: usize) {
        let n = state.storeys();
        state.x[..n].copy_from_slice(&self.x[..n]);
        state.v[..n].copy_from_slice(&self.v[..n]);
        state.a[..n].copy_from_slice(&self.a[1..=n]);
        state.jerk[..n].copy_from_slice(&self.jerk[1..=n]);
        state.drift_acceleration[..n].copy_from_slice(&self.q[margin..margin + n]);
    }
}

/// The regime's system.
struct Operator<'a> {
    tangent: Vec<f64>,
    inverse_mass: Vec<f64>,
    /// Rayleigh damping of each storey and floor, zeros without it.
    storey_damping: Vec<f64>,
    floor_damping: Vec<f64>,
    /// Full damping matrix.
    full_damping: Option<&'a Symmetric<1>>,
    nothing: Vec<f64>,
}

impl<'a> Operator<'a> {
    fn new(state: &State<'a>, length: usize) -> Self {
        let (n, regime, model) = (state.storeys(), state.regime(), &state.model.lanes);
        let of_regime = |row: Row| filled_to(length, regime.row(row)[..n].iter().copied(), 0.0);
        let of_model = |values: &[f64]| filled_to(length, values.iter().copied().take(n), 0.0);
        Self {
            tangent: of_regime(Row::Tangent),
            inverse_mass: of_regime(Row::InverseMass),
            storey_damping: of_model(&model.storey_damping),
            floor_damping: of_model(&model.floor_damping),
            full_damping: state.model.symmetric_damping(),
            nothing: vec![0.0; length],
        }
    }

    /// Vectors of everything, as many as there are.
    #[inline(always)]
    fn lanes(&self) -> OperatorLanes<'_> {
        let count = self.tangent.len() / WIDTH;
        OperatorLanes {
            count,
            tangent: &lanes(&self.tangent)[..count],
            inverse_mass: &lanes(&self.inverse_mass)[..count],
            storey_damping: &lanes(&self.storey_damping)[..count],
            floor_damping: &lanes(&self.floor_damping)[..count],
        }
    }

    /// Floor accelerations from drifts, drift rates, floor velocities less that of the ground, and floor loads.
    #[inline(always)]
    fn accelerations<V: Vector>(&self, x: &[f64], v: &[f64], velocity: &[f64], load: &[f64], out: &mut [f64]) {
        if let Some(damping) = self.full_damping {
            return self.fully_damped::<V>(damping, x, V::splat(1.0), v, load, out);
        }
        let operator = self.lanes();
        let count = operator.count;
        let (x, v) = (&lanes(x)[..count], &lanes(v)[..count]);
        let (velocity, load, out) = (&lanes(velocity)[..count], &lanes(load)[..count], &mut lanes_mut(out)[..count]);
        let mut here = operator.force(0, V::load(&x[0]), V::load(&v[0]));
        for k in 1..count {
            let above = operator.force(k, V::load(&x[k]), V::load(&v[k]));
            let (floor, load) = (V::load(&velocity[k - 1]), V::load(&load[k - 1]));
            operator.acceleration(k - 1, [here, above], floor, load).store(&mut out[k - 1]);
            here = above;
        }
        let (floor, load) = (V::load(&velocity[count - 1]), V::load(&load[count - 1]));
        operator.acceleration(count - 1, [here, V::splat(0.0)], floor, load).store(&mut out[count - 1]);
    }

    /// A time derivative times a factor, of drift rates and of floor accelerations, from what it is the derivative of:
    /// `x`, drift rates; `a`, floor accelerations, that of the ground before them.
    #[inline(always)]
    fn derivatives<V: Vector>(
        &self,
        x: &[f64],
        a: &[f64],
        factor: V,
        load: &[f64],
        v_out: &mut [f64],
        a_out: &mut [f64],
    ) {
        if let Some(damping) = self.full_damping {
            for ((out, floor), below) in lanes_mut(v_out).iter_mut().zip(lanes(&a[1..])).zip(lanes(a)) {
                factor.mul(V::load(floor).sub(V::load(below))).store(out);
            }
            return self.fully_damped(damping, x, factor, v_out, load, a_out);
        }
        let operator = self.lanes();
        let count = operator.count;
        let (x, below, floors) = (&lanes(x)[..count], &lanes(a)[..count], &lanes(&a[1..])[..count]);
        let (load, v_out, a_out) =
            (&lanes(load)[..count], &mut lanes_mut(v_out)[..count], &mut lanes_mut(a_out)[..count]);
        let ground = V::splat(a[0]);
        let v = factor.mul(V::load(&floors[0]).sub(V::load(&below[0])));
        v.store(&mut v_out[0]);
        let mut here = operator.force(0, factor.mul(V::load(&x[0])), v);
        for k in 1..count {
            let v = factor.mul(V::load(&floors[k]).sub(V::load(&below[k])));
            v.store(&mut v_out[k]);
            let above = operator.force(k, factor.mul(V::load(&x[k])), v);
            let velocity = factor.mul(V::load(&floors[k - 1]).sub(ground));
            operator.acceleration(k - 1, [here, above], velocity, V::load(&load[k - 1])).store(&mut a_out[k - 1]);
            here = above;
        }
        let (velocity, load) = (factor.mul(V::load(&floors[count - 1]).sub(ground)), V::load(&load[count - 1]));
        operator.acceleration(count - 1, [here, V::splat(0.0)], velocity, load).store(&mut a_out[count - 1]);
    }

    /// Floor accelerations with a full damping matrix, from drifts times a factor, drift rates and floor loads.
    #[inline(always)]
    fn fully_damped<V: Vector>(
        &self,
        damping: &Symmetric<1>,
        x: &[f64],
        factor: V,
        v: &[f64],
        load: &[f64],
        out: &mut [f64],
    ) {
        let operator = self.lanes();
        let count = operator.count;
        let out = &mut out[..WIDTH * count];
        damping.multiply::<V>(v, out);
        let (x, load, out) = (&lanes(x)[..count], &lanes(load)[..count], &mut lanes_mut(out)[..count]);
        let mut here = V::load(&operator.tangent[0]).mul_add(factor.mul(V::load(&x[0])), V::load(&out[0]));
        for k in 0..count {
            let mut above = V::splat(0.0);
            if k + 1 < count {
                let springs = factor.mul(V::load(&x[k + 1]));
                above = V::load(&operator.tangent[k + 1]).mul_add(springs, V::load(&out[k + 1]));
            }
            let net = here.shifted_down(above).sub(here).add(V::load(&load[k]));
            net.mul(V::load(&operator.inverse_mass[k])).store(&mut out[k]);
            here = above;
        }
    }
}

/// An [`Operator`] in vectors.
struct OperatorLanes<'a> {
    count: usize,
    tangent: &'a [[f64; WIDTH]],
    inverse_mass: &'a [[f64; WIDTH]],
    storey_damping: &'a [[f64; WIDTH]],
    floor_damping: &'a [[f64; WIDTH]],
}

impl OperatorLanes<'_> {
    /// Storey forces of vector `k` from its drifts and drift rates.
    #[inline(always)]
    fn force<V: Vector>(&self, k: usize, x: V, v: V) -> V {
        V::load(&self.storey_damping[k]).mul_add(v, V::load(&self.tangent[k]).mul(x))
    }

    /// Floor accelerations of vector `k` from its storey forces and those above, floor velocities and loads.
    #[inline(always)]
    fn acceleration<V: Vector>(&self, k: usize, [here, above]: [V; 2], velocity: V, load: V) -> V {
        let net = here.shifted_down(above).sub(here).add(load);
        net.sub(V::load(&self.floor_damping[k]).mul(velocity)).mul(V::load(&self.inverse_mass[k]))
    }
}

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

/// A block that slides on a floor.
struct FloorBlock {
    block: usize,
    floor: usize,
    /// Sign times mu_k.
    friction: f64,
    sign: f64,
    velocity: f64,
    slip: f64,
    /// Velocity at the end of the step.
    velocity_after: f64,
}

/// Storeys and floors of a vector whose peaks a step beats, as bits of the lanes: at all; inside, where drifts and
/// accelerations turn.
struct Beaten {
    vector: usize,
    drifts: u32,
    accelerations: u32,
    drifts_inside: u32,
    accelerations_inside: u32,
}

impl Beaten {
    fn turns(&self) -> bool {
        self.drifts_inside | self.accelerations_inside != 0
    }
}

/// The quintic through values and two derivatives at both ends of a step stays between the least and the largest of its
/// Bezier points; what deviates from it by at most `margin` stays within these widened by it.
#[inline(always)]
fn quintic_range(start: [f64; 3], end: [f64; 3], h: f64, margin: f64) -> (f64, f64) {
    let (fifth, twentieth) = (h / 5.0, h * h / 20.0);
    let points = [
        start[0],
        start[0] + fifth * start[1],
        start[0] + 2.0 * fifth * start[1] + twentieth * start[2],
        end[0] - 2.0 * fifth * end[1] + twentieth * end[2],
        end[0] - fifth * end[1],
        end[0],
    ];
    let smaller = |a: f64, b: f64| if a < b { a } else { b };
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    (
        points.into_iter().fold(f64::INFINITY, smaller) - margin,
        points.into_iter().fold(f64::NEG_INFINITY, larger) + margin,
    )
}

/// [`quintic_range`] of several.
#[inline(always)]
fn quintic_ranges<V: Vector>(start: [V; 3], end: [V; 3], h: f64, margin: V) -> (V, V) {
    let (fifth, two_fifths, twentieth) = (V::splat(h / 5.0), V::splat(2.0 * h / 5.0), V::splat(h * h / 20.0));
    let points = [
        fifth.mul_add(start[1], start[0]),
        twentieth.mul_add(start[2], two_fifths.mul_add(start[1], start[0])),
        twentieth.mul_add(end[2], end[0].sub(two_fifths.mul(end[1]))),
        end[0].sub(fifth.mul(end[1])),
        end[0],
    ];
    let (mut low, mut high) = (start[0], start[0]);
    for point in points {
        (low, high) = (low.min(point), high.max(point));
    }
    (low.sub(margin), high.add(margin))
}

/// Second derivatives of floor and drift accelerations at both ends of a step, and the norm of the derivatives there.
struct Curvature {
    /// Of floor accelerations, after a zero for the ground.
    a: [Vec<f64>; 2],
    /// First derivatives of drift accelerations.
    q_rate: [Vec<f64>; 2],
    /// Second derivatives of drift accelerations, third ones of floor accelerations.
    q: Vec<f64>,
    jerk: Vec<f64>,
    /// The norms that bound sixth derivatives as [`crate::regime::Regime::liveliness_of`] does fourth ones.
    norms: Norms,
}

impl Curvature {
    fn new(length: usize) -> Self {
        let zero = || vec![0.0; length];
        let floors = || vec![0.0; length + 1];
        Self {
            a: [floors(), floors()],
            q_rate: [zero(), zero()],
            q: zero(),
            jerk: zero(),
            norms: Norms::new(length / WIDTH),
        }
    }

    #[inline(always)]
    fn form<V: Vector>(&mut self, operator: &Operator, rows: &Rows, samples: [&Sample; 2], margin: usize) {
        let (one, nothing) = (V::splat(1.0), &operator.nothing);
        for (which, sample) in samples.into_iter().enumerate() {
            let (q, jerk) = (&sample.q[margin..], &sample.jerk);
            operator.derivatives::<V>(q, jerk, one, nothing, &mut self.q_rate[which], &mut self.a[which][1..]);
        }
        operator.derivatives(&self.q_rate[0], &self.a[0], one, nothing, &mut self.q, &mut self.jerk);
        self.norms.form::<V>(rows, &self.jerk, &self.q);
    }
}

/// A vector of storeys and their floors of which some were not cleared: bits of the lanes.
struct Suspects {
    vector: usize,
    drifts: u32,
    rates: u32,
    accelerations: u32,
}

/// A step that the loop did not clear.
struct Closer<'a> {
    rows: &'a Rows,
    bounds: &'a Bounds,
    start: &'a Sample,
    end: &'a Sample,
    curvature: &'a Curvature,
    margin: usize,
    h: f64,
    contact: (f64, f64),
    /// Drifts and accelerations below rounding of the largest so far: a storey that no wave has reached yet knows its
    /// own no better.
    least: (f64, f64),
}

impl Closer<'_> {
    /// What the quintics of vector `k` may miss, per unit of the bounds of fourth derivatives.
    #[inline(always)]
    fn sixth(&self, k: usize) -> f64 {
        let h3 = self.h * self.h * self.h;
        self.curvature.norms.values[k] * (h3 * h3 / 46080.0)
    }

    /// Which peaks the suspect lanes of a vector of storeys and floors beat; nothing if a guard may fall inside the step.
    #[inline(always)]
    fn look<V: Vector>(&self, suspects: &Suspects) -> Option<Beaten> {
        let Suspects { vector, drifts, rates, accelerations } = *suspects;
        let (mut of_drifts, mut of_accelerations) = ((0, 0), (0, 0));
        if drifts | rates != 0 {
            of_drifts = self.look_at_drifts::<V>(vector, drifts, rates)?;
        }
        if accelerations != 0 {
            of_accelerations = self.look_at_accelerations::<V>(vector, accelerations)?;
        }
        Some(Beaten {
            vector,
            drifts: of_drifts.0,
            accelerations: of_accelerations.0,
            drifts_inside: of_drifts.1,
            accelerations_inside: of_accelerations.1,
        })
    }

    /// Lanes whose drifts beat a peak, and those of them where they turn.
    #[inline(always)]
    fn look_at_drifts<V: Vector>(&self, k: usize, drifts: u32, rates: u32) -> Option<(u32, u32)> {
        let (start, end, [q_rate, q_rate_end]) = (self.start, self.end, &self.curvature.q_rate);
        let (x, x_end) = (at::<V>(&start.x, k), at::<V>(&end.x, k));
        let (v, v_end) = (at::<V>(&start.v, k), at::<V>(&end.v, k));
        let (q, q_end) = (at::<V>(&start.q[self.margin..], k), at::<V>(&end.q[self.margin..], k));
        let (bounds, zero, sixth) = (&self.bounds.vectors[k], V::splat(0.0), V::splat(self.sixth(k)));
        let rate_margin = sixth.mul(at(&self.rows.fourth[1], k));
        let (from, to) = ([v, q, at(q_rate, k)], [v_end, q_end, at(q_rate_end, k)]);
        let (positive, negative) = signs(quintic_ranges(from, to, self.h, rate_margin));
        let sign = V::load(&bounds.sign);
        let (forward, backward) = (!zero.not_below(sign), !sign.not_below(zero));
        if (forward & !positive | backward & !negative) & rates != 0 {
            return None;
        }
        let margin = sixth.mul(at(&self.rows.fourth[0], k));
        let (low, high) = quintic_ranges([x, v, q], [x_end, v_end, q_end], self.h, margin);
        let (middle, reach) = (V::load(&bounds.middle), V::load(&bounds.reach));
        let outside = (high.not_below(middle.add(reach)) | middle.sub(reach).not_below(low)) & drifts;
        let (lower, upper) = self.bounds.guarded_drifts::<V>(k);
        if (high.not_below(upper) | lower.not_below(low)) & outside != 0 {
            return None;
        }
        let matters = x.abs().max(x_end.abs()).not_below(V::splat(self.least.0));
        Some((outside, outside & matters & !(positive | negative)))
    }

    /// Lanes whose floor accelerations beat a peak, and those of them where they turn.
    #[inline(always)]
    fn look_at_accelerations<V: Vector>(&self, k: usize, suspects: u32) -> Option<(u32, u32)> {
        let (start, end, [second, second_end]) = (self.start, self.end, &self.curvature.a);
        let (a, a_end) = (at::<V>(&start.a[1..], k), at::<V>(&end.a[1..], k));
        let (jerk, jerk_end) = (at::<V>(&start.jerk[1..], k), at::<V>(&end.jerk[1..], k));
        let (second, second_end) = (at::<V>(&second[1..], k), at::<V>(&second_end[1..], k));
        let margin = V::splat(self.sixth(k)).mul(at(&self.rows.fourth[2], k));
        let (low, high) = quintic_ranges([a, jerk, second], [a_end, jerk_end, second_end], self.h, margin);
        let size = high.max(V::splat(0.0).sub(low));
        let limit = V::load(&self.bounds.vectors[k].stuck_mu).mul(V::splat(self.contact.0.min(self.contact.1)));
        if size.not_below(limit) & suspects != 0 {
            return None;
        }
        let beats = size.not_below(self.bounds.acceleration_peaks(k)) & suspects;
        if beats == 0 {
            return Some((0, 0));
        }
        let fifth = V::splat(self.curvature.norms.values[k] * off_cubic(self.h)).mul(at(&self.rows.fourth[3], k));
        let third = V::splat(self.h * THIRD);
        let (positive, negative) = signs(ranges([jerk, second], [jerk_end, second_end], third, fifth));
        let matters = a.abs().max(a_end.abs()).not_below(V::splat(self.least.1));
        Some((beats, beats & matters & !(positive | negative)))
    }

    /// Whether the relative velocity of a block keeps its sign; `floor` is the change of its floor's velocity.
    fn keeps_sliding(&self, block: &FloorBlock, contact_slope: f64, floor: f64) -> bool {
        let i = block.floor;
        let at = |sample: &Sample, velocity: f64, contact: f64| {
            let pushed = (block.friction * contact, block.friction * contact_slope);
            [velocity, -pushed.0 - sample.a[i + 1], -pushed.1 - sample.jerk[i + 1]]
        };
        let (start, end) =
            (at(self.start, block.velocity, self.contact.0), at(self.end, block.velocity_after, self.contact.1));
        let (low, high) = quintic_range(start, end, self.h, self.sixth(i / WIDTH) * self.rows.fourth[3][i]);
        let least = SMALL_DIFFERENCE * floor.abs();
        if block.sign > 0.0 { low > least } else { high < -least }
    }
}

/// The extremes that a series of length `h` is formed for, in the vectors that turn.
struct Wanted<'a> {
    beaten: &'a [Beaten],
    start: &'a Sample,
    bounds: &'a Bounds,
    h: f64,
    /// Drifts and accelerations that are negligible anywhere.
    least: (f64, f64),
}

impl Wanted<'_> {
    /// Whether what a series leaves out of them after `order`, whose terms have these norms, is below rounding.
    #[inline(always)]
    fn is_known<V: Vector>(&self, rows: &Rows, norms: &Norms, order: usize) -> bool {
        let h = self.h;
        let next = h / (order + 1) as f64;
        let twice = next * h * h / ((order + 2) * (order + 3)) as f64;
        let rounding = V::splat(ROUNDING);
        for beaten in self.beaten.iter().filter(|beaten| beaten.turns()) {
            let (k, norm) = (beaten.vector, V::splat(norms.values[beaten.vector]));
            let of_drift = norm.mul(V::splat(twice)).mul(at(&rows.fourth[0], k));
            let of_acceleration = norm.mul(V::splat(next)).mul(at(&rows.second, k));
            let drift = rounding.mul(at::<V>(&self.start.x, k).abs()).max(V::splat(self.least.0));
            let acceleration = rounding.mul(self.bounds.acceleration_peaks(k)).max(V::splat(self.least.1));
            let unknown = of_drift.not_below(drift) & beaten.drifts_inside
                | of_acceleration.not_below(acceleration) & beaten.accelerations_inside;
            if unknown != 0 {
                return false;
            }
        }
        true
    }
}

/// The Taylor series of a step, or of half of it, from one of its ends on, to the order that the motion needs.
struct Series {
    /// Signed length (s): negative from the end on.
    h: f64,
    order: usize,
    /// Terms of the floor accelerations from order 2 on, after a zero for the ground, and of the drift rates.
    a: Vec<Vec<f64>>,
    v: Vec<Vec<f64>>,
    length: usize,
    norms: Norms,
}

impl Series {
    fn new(length: usize) -> Self {
        Self { h: 0.0, order: 0, a: Vec::new(), v: Vec::new(), length, norms: Norms::new(length / WIDTH) }
    }

    /// Forms the terms until what they leave out of what is `wanted` is negligible, not before the lowest order; false
    /// where that is never.
    #[inline(always)]
    fn form<V: Vector>(
        &mut self,
        operator: &Operator,
        rows: &Rows,
        (a_second, q_rate): (&[f64], &[f64]),
        h: f64,
        lowest: usize,
        wanted: Option<&Wanted>,
    ) -> bool {
        self.h = h;
        let half_square = V::splat(0.5 * h * h);
        for order in 2..=HIGHEST_ORDER {
            if self.a.len() + 2 <= order {
                self.a.push(vec![0.0; self.length + 1]);
                self.v.push(vec![0.0; self.length]);
            }
            let (a_below, a) = self.a.split_at_mut(order - 2);
            let (v_below, v) = self.v.split_at_mut(order - 2);
            if order == 2 {
                scale(&a_second[1..], half_square, &mut a[0][1..]);
                scale(q_rate, half_square, &mut v[0]);
            } else {
                let (factor, below) = (V::splat(h / order as f64), order - 3);
                let nothing = &operator.nothing;
                operator.derivatives(&v_below[below], &a_below[below], factor, nothing, &mut v[0], &mut a[0][1..]);
            }
            if order < lowest {
                continue;
            }
            if let Some(wanted) = wanted {
                self.norms.form::<V>(rows, &a[0][1..], &v[0]);
                if !wanted.is_known::<V>(rows, &self.norms, order) {
                    continue;
                }
            }
            self.order = order;
            return true;
        }
        false
    }

    /// Lanes of vector `k` whose drift rates are not known to keep their signs.
    #[inline(always)]
    fn drifts_that_turn<V: Vector>(&self, sample: &Sample, margin: usize, k: usize) -> u32 {
        let mut size = V::splat(0.0);
        for v in &self.v[1..self.order - 1] {
            size = size.add(at::<V>(v, k).abs());
        }
        let linear = V::splat(self.h).mul(at(&sample.q[margin..], k));
        may_change_sign([at(&sample.v, k), linear, at(&self.v[0], k)], size)
    }

    /// Lanes of vector `k` whose rates of accelerations are not known to keep their signs.
    #[inline(always)]
    fn accelerations_that_turn<V: Vector>(&self, sample: &Sample, k: usize) -> u32 {
        let term = |order: usize| V::splat(order as f64).mul(at(&self.a[order - 2][1..], k));
        let mut size = V::splat(0.0);
        for order in 4..=self.order {
            size = size.add(term(order).abs());
        }
        may_change_sign([V::splat(self.h).mul(at(&sample.jerk[1..], k)), term(2), term(3)], size)
    }

    /// Drift coordinate of storey `i` from its sample on.
    fn drift(&self, sample: &Sample, margin: usize, i: usize) -> Polynomial {
        let (h, order) = (self.h, self.order as f64);
        let first = [sample.x[i], h * sample.v[i], 0.5 * h * h * sample.q[margin + i]];
        let terms = self.v[..self.order - 1].iter().zip(3..).map(|(v, order)| h / f64::from(order) * v[i]);
        let a = &self.a[self.order - 2];
        let last = h * h / ((order + 1.0) * (order + 2.0)) * (a[i + 1] - a[i]);
        Polynomial::new(first.into_iter().chain(terms).chain(std::iter::once(last)))
    }

    /// Absolute acceleration of floor `i` from its sample on.
    fn floor_acceleration(&self, sample: &Sample, i: usize) -> Polynomial {
        let first = [sample.a[i + 1], self.h * sample.jerk[i + 1]];
        Polynomial::new(first.into_iter().chain(self.a[..self.order - 1].iter().map(|a| a[i + 1])))
    }

    /// Takes the extremes of the drift of storey `i`, and its value at the far end, into the peaks.
    #[inline(never)]
    fn take_drifts(&self, bounds: &mut Bounds, sample: &Sample, margin: usize, i: usize, from: f64) {
        let drift = self.drift(sample, margin, i);
        let (first, others) = drift.derivative().sign_changes::<Plain>();
        for s in first.into_iter().chain(others).chain([1.0]) {
            bounds.take_drift(i, drift.at::<Plain>(s), from + s * self.h);
        }
    }

    /// Takes the extremes of the acceleration of floor `i`, and its value at the far end, into the peaks.
    #[inline(never)]
    fn take_accelerations(&self, bounds: &mut Bounds, sample: &Sample, i: usize, from: f64) {
        let acceleration = self.floor_acceleration(sample, i);
        let (first, others) = acceleration.derivative().sign_changes::<Plain>();
        for s in first.into_iter().chain(others).chain([1.0]) {
            bounds.take_acceleration(i, acceleration.at::<Plain>(s), from + s * self.h);
        }
    }
}

/// What the last step with peaks inside has taken: into how many parts it was divided, and the order of their series.
/// The run keeps it, so that what the next one takes does not depend on where plain steps begin anew.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Effort {
    parts: usize,
    order: usize,
}

impl Default for Effort {
    fn default() -> Self {
        Self { parts: 1, order: LOWEST_ORDER }
    }
}

/// The series of a step with peaks inside: one from its start, or of each half from the sample that it touches.
struct StepSeries {
    of_parts: [Series; 2],
    effort: Effort,
}

impl StepSeries {
    fn new(length: usize, effort: Effort) -> Self {
        Self { of_parts: [Series::new(length), Series::new(length)], effort }
    }

    /// Forms the series until what they leave out of the values that may beat peaks is proved to be below rounding, of
    /// these or of the largest in the building; false where they cannot.
    #[inline(always)]
    fn form<V: Vector>(&mut self, operator: &Operator, rows: &Rows, closer: &Closer, beaten: &[Beaten]) -> bool {
        for parts in self.effort.parts..=2 {
            self.effort.parts = parts;
            if self.form_parts::<V>(operator, rows, closer, beaten) {
                return true;
            }
        }
        false
    }

    #[inline(always)]
    fn form_parts<V: Vector>(&mut self, operator: &Operator, rows: &Rows, closer: &Closer, beaten: &[Beaten]) -> bool {
        let h = closer.h / self.effort.parts as f64;
        let (least, curvature) = (closer.least, closer.curvature);
        // Of what is exactly zero nothing is left out.
        let least = (least.0.max(f64::MIN_POSITIVE), least.1.max(f64::MIN_POSITIVE));
        let wanted = Wanted { beaten, start: closer.start, bounds: closer.bounds, h, least };
        let [first, second] = &mut self.of_parts;
        let terms = |which: usize| (&*curvature.a[which], &*curvature.q_rate[which]);
        // Neighbouring steps need about as many terms.
        let lowest = LOWEST_ORDER.max(self.effort.order - 1);
        if !first.form::<V>(operator, rows, terms(0), h, lowest, Some(&wanted)) {
            return false;
        }
        // The norm at the start of the step bounds the second half too.
        self.effort.order = first.order;
        self.effort.parts == 1 || second.form::<V>(operator, rows, terms(1), -h, first.order, None)
    }

    /// Takes the extremes inside the step, which begins at `time`, into the peaks.
    #[inline(always)]
    fn take_extremes<V: Vector>(
        &self,
        bounds: &mut Bounds,
        samples: [&Sample; 2],
        margin: usize,
        time: f64,
        beaten: &[Beaten],
    ) {
        for (which, (series, sample)) in self.of_parts[..self.effort.parts].iter().zip(samples).enumerate() {
            let from = if which == 0 { time } else { time - 2.0 * series.h };
            for beaten in beaten.iter().filter(|beaten| beaten.turns()) {
                let k = beaten.vector;
                if beaten.drifts_inside != 0 {
                    let turn = beaten.drifts_inside & series.drifts_that_turn::<V>(sample, margin, k);
                    for lane in members(Set::from(turn)) {
                        series.take_drifts(bounds, sample, margin, WIDTH * k + lane, from);
                    }
                }
                if beaten.accelerations_inside != 0 {
                    let turn = beaten.accelerations_inside & series.accelerations_that_turn::<V>(sample, k);
                    for lane in members(Set::from(turn)) {
                        series.take_accelerations(bounds, sample, WIDTH * k + lane, from);
                    }
                }
            }
        }
    }
}

/// Lanes in which a quadratic, or what differs from it by at most `margin`, may change its sign in [0, 1].
#[inline(always)]
fn may_change_sign<V: Vector>([constant, linear, square]: [V; 3], margin: V) -> u32 {
    let (middle, end) = (V::splat(0.5).mul_add(linear, constant), constant.add(linear).add(square));
    let (low, high) = (constant.min(middle).min(end), constant.max(middle).max(end));
    margin.not_below(low) & margin.not_below(V::splat(0.0).sub(high))
}

/// Puts vectors into numbers.
#[inline(always)]
fn store_all<V: Vector>(vectors: [V; 3], out: &mut Apart) {
    for (vector, out) in vectors.into_iter().zip(out) {
        vector.store(out);
    }
}

/// out = values * factor.
#[inline(always)]
fn scale<V: Vector>(values: &[f64], factor: V, out: &mut [f64]) {
    for (out, value) in lanes_mut(out).iter_mut().zip(lanes(values)) {
        V::load(value).mul(factor).store(out);
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
        TallStep::Full(step) => Map::Full(step, Shears::new(state.regime(), n)),
    };
    let margin = if let TallStep::Banded(step) = step { step.half_width } else { 0 };
    let (third, per_second) = (V::splat(h * THIRD), 1.0 / h);
    let widening = off_cubic(h);
    let vertical = motion.vertical().filter(|_| state.vertical);
    let contact_at = |i: usize| STANDARD_GRAVITY + vertical.map_or(0.0, |vertical| vertical[i]);
    let rows = Rows::new(state, h, length);
    let operator = Operator::new(state, length);
    let has_floor_damping = operator.floor_damping.iter().any(|&damping| damping != 0.0);
    let mut bounds = Bounds::new(state, observer, length);
    let mut before = Sample::new(state, length, margin);
    let mut after = Sample::new(state, length, margin);
    let zero = || vec![0.0; length];
    let (mut dx, mut dv, mut floors) = (zero(), zero(), zero());
    let mut rate = vec![0.0; length + 2 * margin];
    let (mut load, mut load_slope) = (zero(), zero());
    let spring_load = filled_to(length, state.spring_load[..n].iter().copied(), 0.0);
    let friction = filled_to(length, state.friction[..n].iter().copied(), 0.0);
    let (mut apart_before, mut apart_after) =
        (vec![Apart::default(); length / WIDTH], vec![Apart::default(); length / WIDTH]);
    let (mut curvature, mut series) = (Curvature::new(length), StepSeries::new(length, state.effort));
    let (mut suspects, mut beaten): (Vec<Suspects>, Vec<Beaten>) = (Vec::new(), Vec::new());
    let (mut on_floors, mut on_ground) = sliding_blocks(state);
    let watches_ground = !on_ground.is_empty() || state.stuck_mu[0].is_finite();
    let mut blocks: Vec<(f64, f64)> = match observer.histories {
        Some(_) => state.motions.iter().map(|m| (m.velocity, m.slip)).collect(),
        None => Vec::new(),
    };
    let samples = motion.acceleration();
    let set_loads = |contact: f64, slope: f64, load: &mut [f64], load_slope: &mut [f64]| {
        for i in 0..length {
            (load[i], load_slope[i]) = (spring_load[i] + friction[i] * contact, friction[i] * slope);
        }
    };
    set_loads(contact_at(first), 0.0, &mut load, &mut load_slope);
    let mut slope_before = state.jerk_slope;
    for k in 0..length / WIDTH {
        bounds.update::<V>(k);
        store_all(bounds.apart::<V>(&before, margin, third, k), &mut apart_before[k]);
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
            for (k, apart) in apart_before.iter_mut().enumerate() {
                store_all(bounds.apart::<V>(&before, margin, third, k), apart);
            }
        }
        // The step.
        let ground_slope = V::splat(slope);
        for (rate, jerk) in lanes_mut(&mut rate[margin..]).iter_mut().zip(lanes(&before.jerk[1..])) {
            V::load(jerk).sub(ground_slope).store(rate);
        }
        match &mut map {
            Map::Banded(step) => step.advance::<V>(&before.q, &rate, &mut dx, &mut dv),
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
        let liveliness = energy::<V>(&rows, &rate[margin..], &before.q[margin..]).sqrt() * rows.growth;
        let least_contact = V::splat(if contact.0 < contact.1 { contact.0 } else { contact.1 });
        let fourth = V::splat(liveliness * widening);
        suspects.clear();
        for (k, (before, after_now)) in apart_before.iter().zip(&mut apart_after).enumerate() {
            let now = bounds.apart::<V>(&after, margin, third, k);
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
                suspects.push(Suspects { vector: k, drifts, rates, accelerations });
            }
        }
        let (ground, push) = (Linear { start: pair[0], end: pair[1] }, Linear { start: contact.0, end: contact.1 });
        let mut may_turn = false;
        if !on_floors.is_empty() {
            prefix_sums::<V>(&dv, &mut floors);
            for block in &mut on_floors {
                let (i, pushed) = (block.floor, block.friction * push.once(h) + ground.once(h));
                block.velocity_after = block.velocity - (pushed + floors[i]);
                let rates =
                    (-block.friction * contact.0 - before.a[i + 1], -block.friction * contact.1 - after.a[i + 1]);
                let fourth = liveliness * widening * rows.fourth[3][i];
                let (low, high) = range(block.velocity, rates.0, block.velocity_after, rates.1, h * THIRD, fourth);
                let least = SMALL_DIFFERENCE * floors[i].abs();
                may_turn |= !(if block.sign > 0.0 { low > least } else { high < -least });
            }
        }
        beaten.clear();
        let mut turns = false;
        if !suspects.is_empty() || may_turn {
            before.jerk[0] = slope;
            after.jerk[0] = slope;
            let largest = bounds.largest_peaks();
            let least = (FAR_BELOW * largest.0, FAR_BELOW * largest.1);
            curvature.form::<V>(&operator, &rows, [&before, &after], margin);
            let (start, end, curvature) = (&before, &after, &curvature);
            let step = Closer { rows: &rows, bounds: &bounds, start, end, curvature, margin, h, contact, least };
            let mut is_plain = true;
            for suspects in &suspects {
                let Some(looked) = step.look::<V>(suspects) else {
                    is_plain = false;
                    break;
                };
                if looked.drifts | looked.accelerations != 0 {
                    beaten.push(looked);
                }
            }
            turns = beaten.iter().any(Beaten::turns);
            if !is_plain
                || may_turn && !on_floors.iter().all(|b| step.keeps_sliding(b, contact_slope, floors[b.floor]))
                || turns && !series.form::<V>(&operator, &rows, &step, &beaten)
            {
                break;
            }
        }
        if vertical.is_some() && !(contact.0 > NO_CONTACT && contact.1 > NO_CONTACT)
            || watches_ground && !move_on_ground(&mut on_ground, ground, push, h, state.stuck_mu[0])
        {
            break;
        }
        if !on_floors.is_empty() {
            prefix_sums::<V>(&dx, &mut floors);
            for block in &mut on_floors {
                let moved = block.friction * push.twice(h) + ground.twice(h);
                block.slip += h * block.velocity - (moved + floors[block.floor]);
                block.velocity = block.velocity_after;
            }
        }
        if turns {
            let time = (next - 1) as f64 * h;
            series.take_extremes::<V>(&mut bounds, [&before, &after], margin, time, &beaten);
        }
        reached = next;
        std::mem::swap(&mut before, &mut after);
        std::mem::swap(&mut apart_before, &mut apart_after);
        let time = reached as f64 * h;
        for beaten in &beaten {
            let k = beaten.vector;
            if beaten.drifts != 0 {
                bounds.take_drifts::<V>(k, &lanes(&before.x)[k], time);
                bounds.update::<V>(k);
                bounds.apart::<V>(&before, margin, third, k)[0].store(&mut apart_before[k][0]);
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
        state.jerk_slope = slope_before;
        bounds.put_peaks(state, observer);
        for block in &on_floors {
            (state.motions[block.block].velocity, state.motions[block.block].slip) = (block.velocity, block.slip);
        }
        for block in &on_ground {
            (state.motions[block.block].velocity, state.motions[block.block].slip) = (block.velocity, block.slip);
        }
    }
    reached
}

/// The blocks that slide, on floors and on the ground.
fn sliding_blocks(state: &State) -> (Vec<FloorBlock>, Vec<GroundBlock>) {
    let (mut on_floors, mut on_ground) = (Vec::new(), Vec::new());
    for (block, (motion, law)) in state.motions.iter().zip(&state.model.blocks).enumerate() {
        let Some(sign) = motion.sliding().map(Sign::factor) else { continue };
        let (friction, velocity, slip) = (sign * law.mu_k, motion.velocity, motion.slip);
        match law.floor.checked_sub(1) {
            Some(floor) => {
                on_floors.push(FloorBlock { block, floor, friction, sign, velocity, slip, velocity_after: velocity })
            }
            None => on_ground.push(GroundBlock { block, friction, sign, velocity, slip }),
        }
    }
    (on_floors, on_ground)
}
