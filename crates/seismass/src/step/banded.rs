//! The exact step of a tall regime over one sample interval, as a band: of damping that couples neighbours only.
//!
//! With linear loads the drift accelerations q and the rates J of the floor accelerations against the ground obey the
//! homogeneous system, in which a floor knows only its neighbours. What a step adds to drifts beyond the first order is
//! the second integral of q: linear in (q, J) at its start, and falls off faster than exponentially with the distance
//! between storeys, (w h)^2d / (2d + 2)! and smaller. Rows of the two matrices therefore end a few storeys away from the
//! diagonal. In (q, J) this holds for Rayleigh damping too: its mass-proportional part acts on each floor's own velocity.
//! (q', J') obey the same system: their second integral is what the step adds to drift rates beyond h q.

use crate::lanes::{Aligned, Vector, WIDTH, for_each_path};
use crate::machines::model::Model;
use crate::regime::{Regime, Row};
use crate::scene::StoreyDamping;
use crate::tolerances::{BANDED_PHASE, BELOW_ROUNDING, NEGLIGIBLE};

/// Rows of a block of the matrices: two vectors.
const BLOCK: usize = 2 * WIDTH;

/// Storeys padded to whole blocks of rows.
pub(crate) fn whole_blocks(storeys: usize) -> usize {
    storeys.next_multiple_of(BLOCK)
}

/// The step of a regime: dx - h v of (q, J), which is dv - h q of (q', J').
pub(crate) struct BandedStep {
    h: f64,
    /// Diagonals on each side of the main one.
    pub(crate) half_width: usize,
    /// By block of rows, by column from the lowest that one of them reaches: rows by q, rows by J.
    entries: Aligned,
}

/// What a step acts on, each with [`BandedStep::half_width`] more values before the first storey and after the last block.
#[derive(Clone, Copy)]
pub(crate) struct BandedStart<'a> {
    /// Drift accelerations and their rates.
    pub(crate) q: [&'a [f64]; 2],
    /// Rates of the floor accelerations against the ground, and their rates.
    pub(crate) jerk: [&'a [f64]; 2],
}

/// A band matrix by diagonals, each with a zero at both ends.
struct Band {
    storeys: usize,
    reach: usize,
    diagonals: Aligned,
}

impl Band {
    fn zeros(storeys: usize, reach: usize) -> Self {
        Self { storeys, reach, diagonals: Aligned::zeros((2 * reach + 1) * (storeys + 2)) }
    }

    fn unit(storeys: usize, reach: usize) -> Self {
        let mut unit = Self::zeros(storeys, reach);
        unit.inside_mut(0).fill(1.0);
        unit
    }

    /// Diagonal `d` of row i and column i + d, with its ends.
    #[inline(always)]
    fn diagonal(&self, d: isize) -> &[f64] {
        let length = self.storeys + 2;
        let from = (d + self.reach as isize) as usize * length;
        &self.diagonals[from..from + length]
    }

    #[inline(always)]
    fn inside(&self, d: isize) -> &[f64] {
        &self.diagonal(d)[1..=self.storeys]
    }

    #[inline(always)]
    fn inside_mut(&mut self, d: isize) -> &mut [f64] {
        let length = self.storeys + 2;
        let from = (d + self.reach as isize) as usize * length + 1;
        &mut self.diagonals[from..from + self.storeys]
    }

    /// Offsets of the diagonals.
    fn offsets(&self) -> std::ops::RangeInclusive<isize> {
        -(self.reach as isize)..=self.reach as isize
    }

    /// Adds `other` times a factor; it must not reach farther.
    #[inline(always)]
    fn add(&mut self, other: &Self, factor: f64) {
        for d in other.offsets() {
            for (sum, entry) in self.inside_mut(d).iter_mut().zip(other.inside(d)) {
                *sum += factor * entry;
            }
        }
    }

    /// Reach beyond which all entries are negligible beside the largest of their rows.
    fn needed_reach(&self) -> usize {
        let mut largest = vec![0.0f64; self.storeys];
        for d in self.offsets() {
            for (largest, entry) in largest.iter_mut().zip(self.inside(d)) {
                *largest = largest.max(entry.abs());
            }
        }
        let matters = |d: isize| self.inside(d).iter().zip(&largest).any(|(e, most)| e.abs() > NEGLIGIBLE * most);
        (1..=self.reach).rev().find(|&d| matters(d as isize) || matters(-(d as isize))).unwrap_or(0)
    }

    /// The same matrix without what is negligible.
    fn trimmed(self) -> Self {
        let reach = self.needed_reach();
        let mut out = Self::zeros(self.storeys, reach);
        for d in out.offsets() {
            out.inside_mut(d).copy_from_slice(self.inside(d));
        }
        out
    }
}

/// first * left + second * right.
#[inline(always)]
fn sum_of_products(first: &Band, left: &Band, second: &Band, right: &Band) -> Band {
    let n = first.storeys;
    let reach = (first.reach + left.reach).max(second.reach + right.reach).min(n - 1);
    let mut out = Band::zeros(n, reach);
    for (a, b) in [(first, left), (second, right)] {
        for d in a.offsets() {
            // Rows whose column of `a` exists.
            let (from, to) = ((-d).max(0) as usize, (n as isize - d.max(0)).max(0) as usize);
            for e in b.offsets().filter(|e| (d + e).unsigned_abs() <= reach && from < to) {
                let b = &b.inside(e)[(from as isize + d) as usize..];
                let rows = out.inside_mut(d + e)[from..to].iter_mut();
                for ((sum, a), b) in rows.zip(&a.inside(d)[from..to]).zip(b) {
                    *sum += a * b;
                }
            }
        }
    }
    out.trimmed()
}

/// What a regime's system is made of, without padding.
pub(crate) struct BandedSystem<'a> {
    tangent: &'a [f64],
    inverse_mass: &'a [f64],
    storey_damping: Vec<f64>,
    floor_damping: Vec<f64>,
}

impl<'a> BandedSystem<'a> {
    fn new(model: &Model, regime: &'a Regime) -> Self {
        let n = model.storeys();
        let (mass_factor, stiffness_factor) = match model.damping() {
            StoreyDamping::Rayleigh { mass_factor, stiffness_factor } => (*mass_factor, *stiffness_factor),
            _ => (0.0, 0.0),
        };
        Self {
            tangent: &regime.row(Row::Tangent)[..n],
            inverse_mass: &regime.row(Row::InverseMass)[..n],
            storey_damping: model.stiffness.iter().map(|k| stiffness_factor * k).collect(),
            floor_damping: model.mass.iter().map(|m| mass_factor * m).collect(),
        }
    }
}

/// Drifts and floor velocities against the ground, of a unit each.
struct Term {
    drift: Band,
    velocity: Band,
}

impl Term {
    /// Time derivatives times a factor.
    #[inline(always)]
    fn next(&self, system: &BandedSystem, factor: f64) -> Self {
        let (n, reach) = (self.drift.storeys, self.drift.reach as isize);
        let far = (reach + 1).min(n as isize - 1);
        let (mut drift, mut velocity) = (Band::zeros(n, far as usize), Band::zeros(n, far as usize));
        let mut force = Band::zeros(n, reach as usize + 2);
        for d in -reach - 1..=reach {
            let rate = force.inside_mut(d);
            if d >= -reach {
                rate.copy_from_slice(self.velocity.inside(d));
            }
            if d < reach {
                // The floor below has the same column one diagonal up.
                for (rate, below) in rate.iter_mut().zip(self.velocity.diagonal(d + 1)) {
                    *rate -= below;
                }
            }
            if d.abs() <= far {
                drift.inside_mut(d).iter_mut().zip(&*rate).for_each(|(out, rate)| *out = factor * rate);
            }
            for (force, damping) in rate.iter_mut().zip(&system.storey_damping) {
                *force *= damping;
            }
            if d >= -reach {
                for ((force, x), tangent) in rate.iter_mut().zip(self.drift.inside(d)).zip(system.tangent) {
                    *force += tangent * x;
                }
            }
        }
        for d in -far..=far {
            let out = velocity.inside_mut(d);
            for ((out, above), force) in out.iter_mut().zip(&force.diagonal(d - 1)[2..]).zip(force.inside(d)) {
                *out = above - force;
            }
            if d.abs() <= reach {
                for ((out, v), damping) in out.iter_mut().zip(self.velocity.inside(d)).zip(&system.floor_damping) {
                    *out -= damping * v;
                }
            }
            out.iter_mut().zip(system.inverse_mass).for_each(|(out, inverse_mass)| *out *= factor * inverse_mass);
        }
        Self { drift, velocity }
    }
}

/// The step of the homogeneous system in one of (q, J): their values after it, and the first and second integrals of q.
struct Effect {
    after: [Band; 2],
    integrals: [Band; 2],
}

impl Effect {
    /// By series over `h`, to the first term below rounding at frequency times time `phase`; unless it is to be prolonged,
    /// nothing but second integrals.
    #[inline(always)]
    fn by_series(system: &BandedSystem, start: Term, h: f64, phase: f64, is_prolonged: bool) -> Self {
        let n = start.drift.storeys;
        let mut order = 0;
        let mut size = 1.0;
        while size > BELOW_ROUNDING {
            order += 1;
            size *= phase / order as f64;
        }
        let reach = order.min(n - 1);
        let zero = || Band::zeros(n, if is_prolonged { reach } else { 0 });
        let (mut after, mut integrals) = ([zero(), zero()], [zero(), Band::zeros(n, reach)]);
        let mut term = start;
        for k in 0..=order {
            let once = h / (k + 1) as f64;
            if is_prolonged {
                after[0].add(&term.drift, 1.0);
                after[1].add(&term.velocity, 1.0);
                integrals[0].add(&term.drift, once);
            }
            integrals[1].add(&term.drift, once * h / (k + 2) as f64);
            if k < order {
                term = term.next(system, once);
            }
        }
        Self { after: after.map(Band::trimmed), integrals: integrals.map(Band::trimmed) }
    }
}

/// What bands, of q and of J at the middle, make of an effect over the first half.
#[inline(always)]
fn then([of_q, of_j]: [&Band; 2], first: &Effect) -> Band {
    sum_of_products(of_q, &first.after[0], of_j, &first.after[1])
}

/// The integral of q over twice `h`, the first (0) or the second.
#[inline(always)]
fn integral(which: usize, [of_q, of_j]: [&Effect; 2], first: &Effect, h: f64) -> Band {
    let more = then([&of_q.integrals[which], &of_j.integrals[which]], first);
    let reach = more.reach.max(first.integrals[0].reach).max(first.integrals[1].reach);
    let mut sum = Band::zeros(more.storeys, reach);
    sum.add(&more, 1.0);
    sum.add(&first.integrals[which], 1.0);
    if which == 1 {
        sum.add(&first.integrals[0], h);
    }
    sum
}

/// One of the effects of q and of J, `first`, over twice `h`.
#[inline(always)]
fn prolonged(effects: [&Effect; 2], first: &Effect, h: f64) -> Effect {
    let [of_q, of_j] = effects;
    Effect {
        after: [then([&of_q.after[0], &of_j.after[0]], first), then([&of_q.after[1], &of_j.after[1]], first)],
        integrals: [integral(0, effects, first, h), integral(1, effects, first, h)],
    }
}

/// The effects of q and of J over twice `h`.
#[inline(always)]
fn doubled([of_q, of_j]: [Effect; 2], h: f64) -> [Effect; 2] {
    let effects = [&of_q, &of_j];
    [prolonged(effects, &of_q, h), prolonged(effects, &of_j, h)]
}

for_each_path! {
    fn effects(model: &Model, regime: &Regime, dt: f64) -> [Effect; 2] = effects_by_path
}

/// The compiler makes vectors of the path's width.
#[inline(always)]
fn effects_by_path<V: Vector>(model: &Model, regime: &Regime, dt: f64) -> [Effect; 2] {
    let (n, system) = (model.storeys(), BandedSystem::new(model, regime));
    let halvings = libm::log2(regime.frequency * dt / BANDED_PHASE).ceil().max(0.0);
    let mut h = dt * libm::exp2(-halvings);
    let phase = regime.frequency * h;
    let (unit, zero) = (|| Band::unit(n, 0), || Band::zeros(n, 0));
    let of = |start: Term| Effect::by_series(&system, start, h, phase, halvings > 0.0);
    let mut effects = [of(Term { drift: unit(), velocity: zero() }), of(Term { drift: zero(), velocity: unit() })];
    for _ in 0..halvings as usize {
        effects = doubled(effects, h);
        h *= 2.0;
    }
    effects
}

impl BandedStep {
    /// The step of a regime over `dt`.
    pub(crate) fn new(model: &Model, regime: &Regime, dt: f64) -> Self {
        let n = model.storeys();
        let bands = effects(model, regime, dt).map(|Effect { integrals: [_, twice], .. }| twice);
        let half_width = bands.iter().map(Band::needed_reach).max().unwrap_or(0);
        let width = Self::columns(half_width);
        let mut entries = Aligned::zeros(whole_blocks(n) * width * bands.len());
        for (which, band) in bands.iter().enumerate() {
            for d in band.offsets().filter(|d| d.unsigned_abs() <= half_width) {
                for (i, &entry) in band.inside(d).iter().enumerate() {
                    let (block, row) = (i / BLOCK, i % BLOCK);
                    let column = (row as isize + d + half_width as isize) as usize;
                    entries[((block * width + column) * bands.len() + which) * BLOCK + row] = entry;
                }
            }
        }
        Self { h: dt, half_width, entries }
    }

    /// Columns that a block of rows reaches.
    fn columns(half_width: usize) -> usize {
        2 * half_width + BLOCK
    }

    /// Memory taken (bytes).
    pub(crate) fn bytes(&self) -> usize {
        8 * self.entries.len()
    }

    /// Forms (dx - h v, dv), of whole blocks of rows.
    #[inline(always)]
    pub(crate) fn advance<V: Vector>(&self, start: BandedStart, dx: &mut [f64], dv: &mut [f64]) {
        let width = Self::columns(self.half_width);
        let blocks = self.entries.as_chunks::<WIDTH>().0.as_chunks::<2>().0.as_chunks::<2>().0.chunks_exact(width);
        let [dx, dv] = [dx, dv].map(|rows| rows.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<2>().0);
        let out = dx.iter_mut().zip(dv);
        for (block, (columns, (dx, dv))) in blocks.zip(out).enumerate() {
            let within = BLOCK * block..BLOCK * block + width;
            let (q, q_rates) = (&start.q[0][within.clone()], &start.q[1][within.clone()]);
            let (jerk, jerk_rates) = (&start.jerk[0][within.clone()], &start.jerk[1][within]);
            // Of q and its rate, of J and its rate.
            let mut of_q = [[V::splat(0.0); 2]; 2];
            let mut of_jerk = of_q;
            let weights = q.iter().zip(jerk).zip(q_rates.iter().zip(jerk_rates));
            for (entries, ((&q, &jerk), (&q_rate, &jerk_rate))) in columns.iter().zip(weights) {
                let (q, jerk) = ([V::splat(q), V::splat(q_rate)], [V::splat(jerk), V::splat(jerk_rate)]);
                for k in 0..2 {
                    let (by_q, by_jerk) = (V::load(&entries[0][k]), V::load(&entries[1][k]));
                    for r in 0..2 {
                        of_q[r][k] = by_q.mul_add(q[r], of_q[r][k]);
                        of_jerk[r][k] = by_jerk.mul_add(jerk[r], of_jerk[r][k]);
                    }
                }
            }
            let here = &q[self.half_width..].as_chunks::<WIDTH>().0;
            for k in 0..2 {
                of_q[0][k].add(of_jerk[0][k]).store(&mut dx[k]);
                let more = of_q[1][k].add(of_jerk[1][k]);
                V::splat(self.h).mul_add(V::load(&here[k]), more).store(&mut dv[k]);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::sync::Arc;

    use super::*;
    use crate::lanes::Plain;
    use crate::scene::{Building, Damping, Scene, Storey};

    const STOREYS: usize = 21;

    /// Against the Taylor series of the whole building, for steps with and without halvings.
    #[test]
    fn steps_are_those_of_the_series() {
        let wave = |i: usize, step: f64| 1.0 + 0.6 * (step * i as f64).sin();
        let mass = (0..STOREYS).map(|i| 1000.0 * wave(i, 0.7)).collect();
        let storeys = (0..STOREYS).map(|i| Storey::elastic(1e6 * wave(i, 1.3))).collect();
        let building = Building::new(mass, storeys, Damping::Rayleigh { ratio: 0.05, modes: [1, 5] }).unwrap();
        let model = Model::new(&Scene::new(Some(Arc::new(building)), Vec::new()).unwrap());
        let regime = Regime::new(&model, |i| model.laws[i].spring.law().largest_tangent(), &[0.0; STOREYS]);
        let rates = |x: &[f64], v: &[f64]| {
            let mut a = vec![0.0; STOREYS];
            regime.accelerations(&model, x, v, &[0.0; STOREYS], &mut a);
            let differences = (0..STOREYS).map(|i| a[i] - if i > 0 { a[i - 1] } else { 0.0 }).collect::<Vec<_>>();
            (a, differences)
        };
        for phase in [0.3, 1.9, 3.7, 7.9] {
            let h = phase / regime.frequency;
            let step = BandedStep::new(&model, &regime, h);
            // Every storey its own way, and a single one that moves.
            for only in [None, Some(7)] {
                let start = |seed: f64, scale: f64| -> Vec<f64> {
                    let is_still = |i: usize| only.is_some_and(|storey| storey != i);
                    (0..STOREYS).map(|i| if is_still(i) { 0.0 } else { scale * (seed * i as f64).cos() }).collect()
                };
                let (q, q_rate) = (start(2.3, 1.0), start(1.7, regime.frequency));
                let (mut drifts, mut rates_expected) = ([0.0; STOREYS], [0.0; STOREYS]);
                let (mut term, mut next, mut once) = (q.clone(), q_rate.clone(), h);
                for k in 1..40 {
                    for i in 0..STOREYS {
                        rates_expected[i] += once * term[i];
                        drifts[i] += once * h / (k + 1) as f64 * term[i];
                    }
                    let (_, after) = rates(&term, &next);
                    (term, next, once) = (next, after, once * h / (k + 1) as f64);
                }
                let jerk: Vec<f64> = (1..=STOREYS).map(|storeys| q_rate[..storeys].iter().sum()).collect();
                let (jerk_rate, _) = rates(&q, &q_rate);
                let (length, margin) = (whole_blocks(STOREYS), step.half_width);
                let with_margin = |values: &[f64]| {
                    let mut out = vec![0.0; length + 2 * margin];
                    out[margin..margin + STOREYS].copy_from_slice(values);
                    out
                };
                let [q, q_rate, jerk, jerk_rate] = [&q, &q_rate, &jerk, &jerk_rate].map(|values| with_margin(values));
                let start = BandedStart { q: [&q, &q_rate], jerk: [&jerk, &jerk_rate] };
                let (mut dx, mut dv) = (vec![0.0; length], vec![0.0; length]);
                step.advance::<Plain>(start, &mut dx, &mut dv);
                for i in 0..STOREYS {
                    let (of_drift, of_rate) = ((dx[i] - drifts[i]).abs(), (dv[i] - rates_expected[i]).abs());
                    assert!(of_drift <= 1e-14 * h * h && of_rate <= 2e-14 * h, "{phase}: {of_drift:e}, {of_rate:e}");
                }
            }
        }
    }
}
