//! Runs of whole sample intervals of tall regimes: any number of storeys, at a cost that grows with it linearly by
//! banded steps, with its square by full ones.
//!
//! As in [`crate::plain_run`] each step is accepted only when bounds prove that no guard fell inside it. The loop looks
//! at each end with the cubic's margins. What this does not clear is looked at with the quintic through values and two
//! derivatives at both ends, which differs by at most h^6 / 46080 times the largest sixth derivative: the fourth of the
//! second, which the same norm bounds when it is taken of the second derivatives. Of a tall building some storey beats
//! its peak in most steps: where one turns inside a step, the series of that step gives the extreme, and the run goes on.

use crate::STANDARD_GRAVITY;
use crate::banded_step::{BandedStep, whole_blocks};
use crate::bernstein::{MAX_DEGREE, Polynomial};
use crate::bounds::{Set, members};
use crate::full_step::{FullStep, Shears};
use crate::lanes::{FAR, Plain, Vector, WIDTH, filled_to, for_each_path};
use crate::observe::Observer;
use crate::plain_run::MARGINS;
use crate::regime::Row;
use crate::response::Peak;
use crate::scene::Motion;
use crate::sliding::{GroundBlock, Linear, SMALL_DIFFERENCE, move_on_ground};
use crate::state::{State, range, ranges};
use crate::storey::Sign;
use crate::symmetric::Symmetric;
use crate::tall_step::TallStep;

/// Highest order of a series of floor accelerations; that of the drifts is two orders higher.
const HIGHEST_ORDER: usize = MAX_DEGREE - 2;
/// Order from which on its terms are looked at.
const LOWEST_ORDER: usize = 8;
/// What a series may leave out of a value, as a part of it.
const ROUNDING: f64 = 0.25 * f64::EPSILON;
/// The same as a part of the largest value in the building.
const FAR_BELOW: f64 = 1.0 / (1u64 << 60) as f64;

/// Vectors of padded values.
#[inline(always)]
fn lanes(values: &[f64]) -> &[[f64; WIDTH]] {
    values.as_chunks::<WIDTH>().0
}

#[inline(always)]
fn lanes_mut(values: &mut [f64]) -> &mut [[f64; WIDTH]] {
    values.as_chunks_mut::<WIDTH>().0
}

/// Vector `k` of padded values.
#[inline(always)]
fn at<V: Vector>(values: &[f64], k: usize) -> V {
    V::load(&lanes(values)[k])
}

/// The state at a sample.
struct Sample {
    x: Vec<f64>,
    v: Vec<f64>,
    /// Floor accelerations, that of the ground before them.
    a: Vec<f64>,
    /// Their rates, after a place for that of the ground.
    jerk: Vec<f64>,
    /// Drift accelerations, with room for the band before and after them.
    q: Vec<f64>,
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

/// Sum of (root_mass rate)^2 + (root_tangent q)^2.
#[inline(always)]
fn energy<V: Vector>(root_mass: &[f64], rate: &[f64], root_tangent: &[f64], q: &[f64]) -> f64 {
    let mut sums = [V::splat(0.0); 2];
    let floors = lanes(root_mass).iter().zip(lanes(rate));
    for ((mass, rate), (tangent, q)) in floors.zip(lanes(root_tangent).iter().zip(lanes(q))) {
        let (kinetic, elastic) = (V::load(mass).mul(V::load(rate)), V::load(tangent).mul(V::load(q)));
        sums[0] = kinetic.mul_add(kinetic, sums[0]);
        sums[1] = elastic.mul_add(elastic, sums[1]);
    }
    sums[0].add(sums[1]).sum()
}

/// The bounds of [`crate::bounds::Bounds`], of all storeys however many there are.
struct Bounds {
    middle: Vec<f64>,
    reach: Vec<f64>,
    sign: Vec<f64>,
    turn: Vec<f64>,
    stuck_mu: Vec<f64>,
    a_peak: Vec<f64>,
}

impl Bounds {
    fn new(state: &State, observer: &Observer, length: usize) -> Self {
        let n = state.storeys();
        let (middle, reach): (Vec<f64>, Vec<f64>) = (0..n).map(|i| state.quiet_middle_and_reach(observer, i)).unzip();
        let sign: Vec<f64> = state.springs.iter().map(|s| s.plastic().map_or(0.0, Sign::factor)).collect();
        Self {
            middle: filled_to(length, middle, 0.0),
            reach: filled_to(length, reach, FAR),
            turn: filled_to(length, sign.iter().map(|&sign| if sign == 0.0 { FAR } else { 0.0 }), FAR),
            sign: filled_to(length, sign, 0.0),
            stuck_mu: filled_to(length, state.stuck_mu[1..].iter().map(|mu| mu.min(FAR)), FAR),
            a_peak: filled_to(length, observer.peaks.floor_acceleration.iter().map(|peak| peak.value), FAR),
        }
    }

    /// How far values are from their middles after h / 3 at their rates, to either side: of drifts, of the negative of
    /// plastic storeys' rates, of accelerations.
    #[inline(always)]
    fn apart<V: Vector>(&self, sample: &Sample, margin: usize, third: V, out: &mut [Vec<f64>; 3]) {
        let [drifts, rates, accelerations] = out.each_mut().map(|values| lanes_mut(values));
        let (x, v, q) = (lanes(&sample.x), lanes(&sample.v), lanes(&sample.q[margin..]));
        for (k, ((out, x), v)) in drifts.iter_mut().zip(x).zip(v).enumerate() {
            let from_middle = V::load(x).sub(V::load(&lanes(&self.middle)[k])).abs();
            third.mul_add(V::load(v).abs(), from_middle).store(out);
        }
        for (((out, v), q), sign) in rates.iter_mut().zip(v).zip(q).zip(lanes(&self.sign)) {
            third.mul(V::load(q).abs()).sub(V::load(sign).mul(V::load(v))).store(out);
        }
        for ((out, a), jerk) in accelerations.iter_mut().zip(lanes(&sample.a[1..])).zip(lanes(&sample.jerk[1..])) {
            third.mul_add(V::load(jerk).abs(), V::load(a).abs()).store(out);
        }
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

/// Storeys and floors whose peaks a step beats: at its end; inside, where drifts and accelerations turn.
#[derive(Default)]
struct Beaten {
    drifts: Vec<usize>,
    accelerations: Vec<usize>,
    drifts_inside: Vec<usize>,
    accelerations_inside: Vec<usize>,
}

impl Beaten {
    fn turns(&self) -> bool {
        !(self.drifts_inside.is_empty() && self.accelerations_inside.is_empty())
    }

    fn clear(&mut self) {
        self.drifts.clear();
        self.accelerations.clear();
        self.drifts_inside.clear();
        self.accelerations_inside.clear();
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

/// Lanes that are above zero, and those that are below it.
#[inline(always)]
fn signs<V: Vector>((low, high): (V, V)) -> (u32, u32) {
    let zero = V::splat(0.0);
    (!zero.not_below(low), !high.not_below(zero))
}

/// What a run reads of its regime.
struct Rows {
    root_mass: Vec<f64>,
    root_tangent: Vec<f64>,
    /// Bounds of fourth derivatives of drifts, drift rates, floor accelerations and block velocities.
    fourth: [Vec<f64>; 4],
    /// Bounds of second derivatives of floor accelerations.
    second: Vec<f64>,
    growth: f64,
}

impl Rows {
    fn new(state: &State, h: f64, length: usize) -> Self {
        let (n, regime) = (state.storeys(), state.regime());
        let row = |row: Row| filled_to(length, regime.row(row)[..n].iter().copied(), 0.0);
        Self {
            root_mass: row(Row::RootMass),
            root_tangent: row(Row::RootTangent),
            fourth: MARGINS.map(row),
            second: row(Row::SecondOfAcceleration),
            growth: regime.growth_over(h),
        }
    }
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
    /// The norm that bounds sixth derivatives as [`Regime::liveliness_of`] does fourth ones.
    liveliness: f64,
}

impl Curvature {
    fn new(length: usize) -> Self {
        let zero = || vec![0.0; length];
        let floors = || vec![0.0; length + 1];
        Self { a: [floors(), floors()], q_rate: [zero(), zero()], q: zero(), jerk: zero(), liveliness: 0.0 }
    }

    #[inline(always)]
    fn form<V: Vector>(&mut self, operator: &Operator, rows: &Rows, samples: [&Sample; 2], margin: usize) {
        let (one, nothing) = (V::splat(1.0), &operator.nothing);
        for (which, sample) in samples.into_iter().enumerate() {
            let (q, jerk) = (&sample.q[margin..], &sample.jerk);
            operator.derivatives::<V>(q, jerk, one, nothing, &mut self.q_rate[which], &mut self.a[which][1..]);
        }
        operator.derivatives(&self.q_rate[0], &self.a[0], one, nothing, &mut self.q, &mut self.jerk);
        self.liveliness = energy::<V>(&rows.root_mass, &self.jerk, &rows.root_tangent, &self.q).sqrt() * rows.growth;
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
    state: &'a State<'a>,
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
    /// What the quintics may miss, per unit of the bounds of fourth derivatives.
    #[inline(always)]
    fn sixth(&self) -> f64 {
        let h3 = self.h * self.h * self.h;
        self.curvature.liveliness * (h3 * h3 / 46080.0)
    }

    /// Whether no guard falls inside the step in the suspect lanes of a vector of storeys and floors; notes the peaks
    /// that are beaten.
    #[inline(always)]
    fn look<V: Vector>(&self, suspects: &Suspects, beaten: &mut Beaten) -> bool {
        let Suspects { vector, drifts, rates, accelerations } = *suspects;
        (drifts | rates == 0 || self.look_at_drifts::<V>(vector, drifts, rates, beaten))
            && (accelerations == 0 || self.look_at_accelerations::<V>(vector, accelerations, beaten))
    }

    #[inline(always)]
    fn look_at_drifts<V: Vector>(&self, k: usize, drifts: u32, rates: u32, beaten: &mut Beaten) -> bool {
        let (start, end, [q_rate, q_rate_end]) = (self.start, self.end, &self.curvature.q_rate);
        let (x, x_end) = (at::<V>(&start.x, k), at::<V>(&end.x, k));
        let (v, v_end) = (at::<V>(&start.v, k), at::<V>(&end.v, k));
        let (q, q_end) = (at::<V>(&start.q[self.margin..], k), at::<V>(&end.q[self.margin..], k));
        let sixth = V::splat(self.sixth());
        let rate_margin = sixth.mul(at(&self.rows.fourth[1], k));
        let (from, to) = ([v, q, at(q_rate, k)], [v_end, q_end, at(q_rate_end, k)]);
        let (positive, negative) = signs(quintic_ranges(from, to, self.h, rate_margin));
        for lane in members(Set::from(rates)) {
            let sign = self.bounds.sign[WIDTH * k + lane];
            let kept = if sign > 0.0 { positive } else { negative };
            if sign != 0.0 && kept >> lane & 1 == 0 {
                return false;
            }
        }
        let margin = sixth.mul(at(&self.rows.fourth[0], k));
        let (low, high) = quintic_ranges([x, v, q], [x_end, v_end, q_end], self.h, margin);
        let (middle, reach) = (at::<V>(&self.bounds.middle, k), at::<V>(&self.bounds.reach, k));
        let outside = high.not_below(middle.add(reach)) | middle.sub(reach).not_below(low);
        let matters = x.abs().max(x_end.abs()).not_below(V::splat(self.least.0));
        let (mut lows, mut highs) = ([0.0; WIDTH], [0.0; WIDTH]);
        low.store(&mut lows);
        high.store(&mut highs);
        for lane in members(Set::from(drifts & outside)) {
            let i = WIDTH * k + lane;
            let (lower, upper) = self.state.guarded_drift(i);
            if !(highs[lane] < upper && lows[lane] > lower) {
                return false;
            }
            let turns = (matters & !(positive | negative)) >> lane & 1 != 0;
            if turns { &mut beaten.drifts_inside } else { &mut beaten.drifts }.push(i);
        }
        true
    }

    #[inline(always)]
    fn look_at_accelerations<V: Vector>(&self, k: usize, suspects: u32, beaten: &mut Beaten) -> bool {
        let (start, end, [second, second_end]) = (self.start, self.end, &self.curvature.a);
        let (a, a_end) = (at::<V>(&start.a[1..], k), at::<V>(&end.a[1..], k));
        let (jerk, jerk_end) = (at::<V>(&start.jerk[1..], k), at::<V>(&end.jerk[1..], k));
        let (second, second_end) = (at::<V>(&second[1..], k), at::<V>(&second_end[1..], k));
        let margin = V::splat(self.sixth()).mul(at(&self.rows.fourth[2], k));
        let (low, high) = quintic_ranges([a, jerk, second], [a_end, jerk_end, second_end], self.h, margin);
        let size = high.max(V::splat(0.0).sub(low));
        let limit = at::<V>(&self.bounds.stuck_mu, k).mul(V::splat(self.contact.0.min(self.contact.1)));
        if size.not_below(limit) & suspects != 0 {
            return false;
        }
        let beats = size.not_below(at(&self.bounds.a_peak, k)) & suspects;
        if beats == 0 {
            return true;
        }
        let h2 = self.h * self.h;
        let fifth = V::splat(self.curvature.liveliness * (h2 * h2 / 384.0)).mul(at(&self.rows.fourth[3], k));
        let third = V::splat(self.h / 3.0);
        let (positive, negative) = signs(ranges([jerk, second], [jerk_end, second_end], third, fifth));
        let matters = a.abs().max(a_end.abs()).not_below(V::splat(self.least.1));
        let turn = matters & !(positive | negative);
        for lane in members(Set::from(beats)) {
            let turns = turn >> lane & 1 != 0;
            if turns { &mut beaten.accelerations_inside } else { &mut beaten.accelerations }.push(WIDTH * k + lane);
        }
        true
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
        let (low, high) = quintic_range(start, end, self.h, self.sixth() * self.rows.fourth[3][i]);
        let least = SMALL_DIFFERENCE * floor.abs();
        if block.sign > 0.0 { low > least } else { high < -least }
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
}

impl Series {
    fn new(length: usize) -> Self {
        Self { h: 0.0, order: 0, a: Vec::new(), v: Vec::new(), length }
    }

    /// Forms the terms until `suffices(norm, order)`, not before the lowest order; false where that is never. The norm
    /// of the terms of one order is that of [`crate::regime::Regime::liveliness_of`].
    #[inline(always)]
    fn form<V: Vector>(
        &mut self,
        operator: &Operator,
        rows: &Rows,
        (a_second, q_rate): (&[f64], &[f64]),
        h: f64,
        lowest: usize,
        suffices: impl Fn(f64, usize) -> bool,
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
            let norm = energy::<V>(&rows.root_mass, &a[0][1..], &rows.root_tangent, &v[0]).sqrt() * rows.growth;
            if suffices(norm, order) {
                self.order = order;
                return true;
            }
        }
        false
    }

    /// Whether the drift rate of storey `i` keeps its sign.
    fn drift_keeps_direction(&self, sample: &Sample, margin: usize, i: usize) -> bool {
        let size: f64 = self.v[1..self.order - 1].iter().map(|v| v[i].abs()).sum();
        let (at, q) = (sample.v[i], self.v[0][i]);
        keeps_sign([at, self.h * sample.q[margin + i], q], size)
    }

    /// Whether the rate of the acceleration of floor `i` keeps its sign.
    fn acceleration_keeps_direction(&self, sample: &Sample, i: usize) -> bool {
        let a = |order: usize| order as f64 * self.a[order - 2][i + 1];
        let size: f64 = (4..=self.order).map(|order| a(order).abs()).sum();
        keeps_sign([self.h * sample.jerk[i + 1], a(2), a(3)], size)
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
}

/// The series of a step with peaks inside: one from its start, or of each half from the sample that it touches.
struct StepSeries {
    of_parts: [Series; 2],
    parts: usize,
}

impl StepSeries {
    fn new(length: usize) -> Self {
        Self { of_parts: [Series::new(length), Series::new(length)], parts: 1 }
    }

    /// Forms the series until what they leave out of the values that may beat peaks is proved to be below rounding, of
    /// these or of the largest in the building; false where they cannot.
    #[inline(always)]
    fn form<V: Vector>(&mut self, operator: &Operator, rows: &Rows, closer: &Closer, beaten: &Beaten) -> bool {
        for parts in self.parts..=2 {
            self.parts = parts;
            if self.form_parts::<V>(operator, rows, closer, beaten) {
                return true;
            }
        }
        false
    }

    #[inline(always)]
    fn form_parts<V: Vector>(&mut self, operator: &Operator, rows: &Rows, closer: &Closer, beaten: &Beaten) -> bool {
        let h = closer.h / self.parts as f64;
        let (start, bounds, curvature) = (closer.start, closer.bounds, closer.curvature);
        let suffices = |norm: f64, order: usize| {
            let next = h / (order + 1) as f64;
            let of_drift = norm * next * h * h / ((order + 2) * (order + 3)) as f64;
            let enough = |value: f64, least: f64| (ROUNDING * value).max(least);
            let drift_is_known = |&i: &usize| of_drift * rows.fourth[0][i] <= enough(start.x[i].abs(), closer.least.0);
            let acceleration_is_known =
                |&i: &usize| norm * next * rows.second[i] <= enough(bounds.a_peak[i], closer.least.1);
            beaten.drifts_inside.iter().all(drift_is_known)
                && beaten.accelerations_inside.iter().all(acceleration_is_known)
        };
        let [first, second] = &mut self.of_parts;
        let terms = |which: usize| (&*curvature.a[which], &*curvature.q_rate[which]);
        // Neighbouring steps need about as many terms.
        let lowest = LOWEST_ORDER.max(first.order.saturating_sub(1));
        if !first.form::<V>(operator, rows, terms(0), h, lowest, suffices) {
            return false;
        }
        // The norm at the start of the step bounds the second half too.
        let order = first.order;
        self.parts == 1 || second.form::<V>(operator, rows, terms(1), -h, order, |_, _| true)
    }

    /// Takes the extremes inside the step, which begins at `time`, into the peaks.
    fn take_extremes(
        &self,
        state: &State,
        observer: &mut Observer,
        samples: [&Sample; 2],
        margin: usize,
        time: f64,
        beaten: &Beaten,
    ) {
        for (which, (series, sample)) in self.of_parts[..self.parts].iter().zip(samples).enumerate() {
            let from = if which == 0 { time } else { time - 2.0 * series.h };
            let time = |s: f64| from + s * series.h;
            for &i in &beaten.drifts_inside {
                if series.drift_keeps_direction(sample, margin, i) {
                    continue;
                }
                let drift = series.drift(sample, margin, i);
                let (first, others) = drift.derivative().sign_changes::<Plain>();
                for s in first.into_iter().chain(others).chain([1.0]) {
                    observer.take_drift(state, i, drift.at::<Plain>(s), time(s));
                }
            }
            for &i in &beaten.accelerations_inside {
                if series.acceleration_keeps_direction(sample, i) {
                    continue;
                }
                let acceleration = series.floor_acceleration(sample, i);
                let (first, others) = acceleration.derivative().sign_changes::<Plain>();
                for s in first.into_iter().chain(others).chain([1.0]) {
                    observer.take_acceleration(i, acceleration.at::<Plain>(s), time(s));
                }
            }
        }
    }
}

/// Whether a quadratic, and what differs from it by at most `margin`, keeps its sign in [0, 1].
fn keeps_sign([constant, linear, square]: [f64; 3], margin: f64) -> bool {
    let points = [constant, constant + 0.5 * linear, constant + linear + square];
    points.iter().all(|&point| point > margin) || points.iter().all(|&point| point < -margin)
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
    let (third, per_second) = (V::splat(h / 3.0), 1.0 / h);
    let widening = h * h * h * h / 384.0;
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
    let (mut apart_before, mut apart_after) = ([zero(), zero(), zero()], [zero(), zero(), zero()]);
    let (mut curvature, mut series) = (Curvature::new(length), StepSeries::new(length));
    let (mut suspects, mut beaten) = (Vec::new(), Beaten::default());
    let (mut on_floors, mut on_ground) = sliding_blocks(state);
    let watches_ground = !on_ground.is_empty() || state.stuck_mu[0].is_finite();
    let mut blocks: Vec<(f64, f64)> = match observer.histories {
        Some(_) => state.motions.iter().map(|m| (m.velocity, m.slip)).collect(),
        None => Vec::new(),
    };
    let mut slope_before =
        if vertical.is_some() { (contact_at(first + 1) - contact_at(first)) * per_second } else { 0.0 };
    for ((load, spring), friction) in load.iter_mut().zip(&spring_load).zip(&friction) {
        *load = spring + friction * STANDARD_GRAVITY;
    }
    bounds.apart(&before, margin, third, &mut apart_before);
    let samples = motion.acceleration();
    let mut reached = first;
    for (pair, next) in samples[first..=end].windows(2).zip(first + 1..) {
        let slope = (pair[1] - pair[0]) * per_second;
        let contact = (contact_at(next - 1), contact_at(next));
        let contact_slope = (contact.1 - contact.0) * per_second;
        if vertical.is_some() {
            let inverse_mass = &operator.inverse_mass;
            for ((jerk, friction), inverse_mass) in before.jerk[1..].iter_mut().zip(&friction).zip(inverse_mass) {
                *jerk += friction * (contact_slope - slope_before) * inverse_mass;
            }
            slope_before = contact_slope;
            for i in 0..length {
                load[i] = spring_load[i] + friction[i] * contact.1;
                load_slope[i] = friction[i] * contact_slope;
            }
            bounds.apart(&before, margin, third, &mut apart_before);
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
        let liveliness =
            energy::<V>(&rows.root_mass, &rate[margin..], &rows.root_tangent, &before.q[margin..]).sqrt() * rows.growth;
        bounds.apart(&after, margin, third, &mut apart_after);
        let least_contact = V::splat(if contact.0 < contact.1 { contact.0 } else { contact.1 });
        let fourth = V::splat(liveliness * widening);
        suspects.clear();
        for k in 0..length / WIDTH {
            let limit = at::<V>(&bounds.stuck_mu, k).mul(least_contact).min(at(&bounds.a_peak, k));
            let mut bits = [0; 3];
            for (which, bound) in [(0, at::<V>(&bounds.reach, k)), (1, at(&bounds.turn, k)), (2, limit)] {
                let most = at::<V>(&apart_before[which], k).max(at(&apart_after[which], k));
                bits[which] = fourth.mul_add(at(&rows.fourth[which], k), most).not_below(bound);
            }
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
                let (low, high) = range(block.velocity, rates.0, block.velocity_after, rates.1, h / 3.0, fourth);
                let least = SMALL_DIFFERENCE * floors[i].abs();
                may_turn |= !(if block.sign > 0.0 { low > least } else { high < -least });
            }
        }
        beaten.clear();
        if !suspects.is_empty() || may_turn {
            before.jerk[0] = slope;
            after.jerk[0] = slope;
            let largest = |peaks: &[Peak]| peaks.iter().fold(0.0, |most: f64, peak| most.max(peak.value));
            let peaks = &observer.peaks;
            let least = (FAR_BELOW * largest(&peaks.drift), FAR_BELOW * largest(&peaks.floor_acceleration));
            curvature.form::<V>(&operator, &rows, [&before, &after], margin);
            let (start, end, curvature) = (&before, &after, &curvature);
            let step = Closer { state, rows: &rows, bounds: &bounds, start, end, curvature, margin, h, contact, least };
            let mut is_plain = true;
            for suspects in &suspects {
                is_plain = is_plain && step.look::<V>(suspects, &mut beaten);
            }
            if !is_plain
                || may_turn && !on_floors.iter().all(|b| step.keeps_sliding(b, contact_slope, floors[b.floor]))
                || beaten.turns() && !series.form::<V>(&operator, &rows, &step, &beaten)
            {
                break;
            }
        }
        if vertical.is_some() && !(contact.0 > 0.0 && contact.1 > 0.0)
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
        if beaten.turns() {
            let time = (next - 1) as f64 * h;
            series.take_extremes(state, observer, [&before, &after], margin, time, &beaten);
        }
        reached = next;
        std::mem::swap(&mut before, &mut after);
        std::mem::swap(&mut apart_before, &mut apart_after);
        let time = reached as f64 * h;
        for &i in beaten.drifts.iter().chain(&beaten.drifts_inside) {
            observer.take_drift(state, i, before.x[i], time);
            (bounds.middle[i], bounds.reach[i]) = state.quiet_middle_and_reach(observer, i);
            apart_before[0][i] = h / 3.0 * before.v[i].abs() + (before.x[i] - bounds.middle[i]).abs();
        }
        for &i in beaten.accelerations.iter().chain(&beaten.accelerations_inside) {
            observer.take_acceleration(i, before.a[i + 1], time);
            bounds.a_peak[i] = observer.peaks.floor_acceleration[i].value;
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
    if reached > first {
        before.put(state, margin);
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
