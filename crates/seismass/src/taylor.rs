//! The Taylor series of the solution within one regime: exact to rounding, and dense output for guards and peaks.
//!
//! All coefficients belong to the normalised time s = tau / h in [0, 1].

use crate::bernstein::{MAX_DEGREE, Polynomial};
use crate::lanes::{MAX_LANES, Vector, WIDTH, columns_of, differences, for_each_path, load, padded, store};
use crate::model::Model;
use crate::propagator::Table;
use crate::regime::{Operator, Regime};

/// Longest step of one series, as frequency times time: longer intervals are split.
pub(crate) const MAX_PHASE: f64 = 1.0;

/// What drives the system in a step: ground acceleration and floor loads, linear in time.
#[derive(Debug, Clone, Default)]
pub(crate) struct Drive {
    /// Ground acceleration at the start (m/s2).
    pub(crate) ground: f64,
    /// Its slope (m/s3).
    pub(crate) ground_slope: f64,
    /// Force on each floor at the start, beside x, v and their products (N).
    pub(crate) load: Vec<f64>,
    /// Its slope (N/s).
    pub(crate) load_slope: Vec<f64>,
}

impl Drive {
    /// Term `k` of the ground acceleration over a step `h`.
    #[inline]
    fn ground_term(&self, k: usize, h: f64) -> f64 {
        match k {
            0 => self.ground,
            1 => self.ground_slope * h,
            _ => 0.0,
        }
    }
}

/// The state at the start of a step: drifts, drift rates, floor accelerations and their rates.
#[derive(Clone, Copy)]
pub(crate) struct Start<'a> {
    pub(crate) x: &'a [f64],
    pub(crate) v: &'a [f64],
    pub(crate) a: &'a [f64],
    pub(crate) jerk: &'a [f64],
}

/// Series of drifts, drift rates and absolute floor accelerations, stored order by order, padded to whole vectors.
#[derive(Debug, Clone, Default)]
pub(crate) struct Series {
    storeys: usize,
    stride: usize,
    order: usize,
    h: f64,
    x: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    /// Changes of drifts and drift rates over the step, floor accelerations and their rates at its end.
    end: [Vec<f64>; 4],
    load: [Vec<f64>; 2],
}

/// Largest phase at which the term of order 3, 4, ... is below 2^-60: phase^k / k! rounded down.
const PHASE_LIMITS: [f64; 26] = [
    0.0000, 0.0000, 0.0006, 0.0029, 0.0088, 0.0207, 0.0408, 0.0707, 0.1119, 0.1652, 0.2312, 0.3099, 0.4014, 0.5054,
    0.6215, 0.7493, 0.8883, 1.0380, 1.1978, 1.3672, 1.5458, 1.7329, 1.9282, 2.1311, 2.3412, 2.5582,
];

/// Order of the first term that is below rounding.
pub(crate) fn terms(phase: f64) -> usize {
    3 + PHASE_LIMITS.iter().position(|&limit| phase < limit).unwrap_or(PHASE_LIMITS.len() - 1)
}

impl Series {
    /// Forms the series over a step `h` from its start, whose accelerations must be those of the drive.
    pub(crate) fn form(&mut self, model: &Model, regime: &Regime, start: Start, drive: &Drive, h: f64) {
        let n = start.x.len();
        let (order, stride) = (terms(regime.frequency * h), padded(n));
        if self.stride != stride || self.storeys != n {
            let zero = || vec![0.0; stride];
            self.end = [zero(), zero(), zero(), zero()];
            self.load = [zero(), zero()];
            (self.x, self.v, self.a) = (zero(), zero(), zero());
        }
        (self.storeys, self.stride, self.order, self.h) = (n, stride, order, h);
        let length = (order + 1) * stride;
        for buffer in [&mut self.x, &mut self.v, &mut self.a] {
            if buffer.len() < length {
                buffer.resize(length, 0.0);
            }
        }
        self.x[..n].copy_from_slice(start.x);
        self.v[..n].copy_from_slice(start.v);
        match regime.steps.as_ref().and_then(|steps| steps.table.as_ref()) {
            Some(table) => {
                self.a[..n].copy_from_slice(start.a);
                self.end[3][..n].copy_from_slice(start.jerk);
                form_by_table(self, model, table, drive);
            }
            None if n <= MAX_LANES => {
                self.load[0].copy_from_slice(&drive.load);
                for (load, slope) in self.load[1].iter_mut().zip(&drive.load_slope) {
                    *load = slope * h;
                }
                form_by_recursion(self, model, regime, drive);
            }
            None => self.form_any(model, regime, drive),
        }
    }

    /// The coefficients of one order.
    #[inline(always)]
    fn put<V: Vector, const K: usize>(&mut self, k: usize, x: &[V; K], v: &[V; K], a: &[V; K]) {
        let at = k * WIDTH * K;
        store(x, &mut self.x[at..]);
        store(v, &mut self.v[at..]);
        store(a, &mut self.a[at..]);
    }

    /// From tables: floor accelerations from the second order on are products with drift accelerations and their rates.
    #[inline(always)]
    fn by_table<V: Vector, const K: usize>(&mut self, model: &Model, table: &Table, drive: &Drive) {
        let n = self.storeys;
        let inside: [V; K] = load(&model.lanes.inside);
        let h = V::splat(self.h);
        let (mut x, mut v): ([V; K], [V; K]) = (load(&self.x), load(&self.v));
        let (mut a, jerk): ([V; K], [V; K]) = (load(&self.a), load(&self.end[3]));
        let (first, rate) = (differences(&a, V::splat(drive.ground)), differences(&jerk, V::splat(drive.ground_slope)));
        let mut weights = [[[0.0; WIDTH]; K]; 2];
        for k in 0..K {
            first[k].store(&mut weights[0][k]);
            rate[k].store(&mut weights[1][k]);
        }
        let (ratio, mut power) = (self.h / table.h, 1.0);
        let zero = V::splat(0.0);
        let mut drift_acceleration = first;
        let mut end = [[zero; K]; 4];
        (end[2], end[3]) = (a, [zero; K]);
        let terms = columns_of::<K>(&table.terms);
        for order in 1..=self.order {
            let factor = V::splat(self.h * INVERSE[order]);
            let (mut next_x, mut next_v) = (x, v);
            for k in 0..K {
                next_x[k] = factor.mul(v[k]);
                next_v[k] = factor.mul(drift_acceleration[k]).mul(inside[k]);
            }
            (x, v) = (next_x, next_v);
            power *= ratio;
            if order == 1 {
                for k in 0..K {
                    a[k] = h.mul(jerk[k]);
                    drift_acceleration[k] = h.mul(rate[k]);
                }
            } else {
                let columns = &terms[(order - 2) * 2 * n..(order - 1) * 2 * n];
                let (mut even, mut odd) = ([zero; K], [zero; K]);
                for (c, (of_first, of_rate)) in columns[..n].iter().zip(&columns[n..]).enumerate() {
                    let (first, rate) =
                        (V::splat(weights[0].as_flattened()[c]), V::splat(weights[1].as_flattened()[c]));
                    for k in 0..K {
                        even[k] = V::load(&of_first[k]).mul_add(first, even[k]);
                        odd[k] = V::load(&of_rate[k]).mul_add(rate, odd[k]);
                    }
                }
                let power = V::splat(power);
                for k in 0..K {
                    a[k] = even[k].add(odd[k]).mul(power);
                }
                drift_acceleration = differences(&a, zero);
            }
            self.put(order, &x, &v, &a);
            let weight = V::splat(order as f64);
            for k in 0..K {
                end[0][k] = end[0][k].add(x[k]);
                end[1][k] = end[1][k].add(v[k]);
                end[2][k] = end[2][k].add(a[k]);
                end[3][k] = weight.mul_add(a[k], end[3][k]);
            }
        }
        self.put_end(&mut end);
    }

    #[inline(always)]
    fn put_end<V: Vector, const K: usize>(&mut self, end: &mut [[V; K]; 4]) {
        let per_second = V::splat(1.0 / self.h);
        for k in 0..K {
            end[3][k] = end[3][k].mul(per_second);
        }
        for (values, kept) in end.iter().zip(&mut self.end) {
            store(values, kept);
        }
    }

    /// By the recursion from order to order.
    #[inline(always)]
    fn by_recursion<V: Vector, const K: usize>(&mut self, model: &Model, regime: &Regime, drive: &Drive) {
        let operator = Operator::<V, K>::new(model, regime);
        let inside: [V; K] = load(&model.lanes.inside);
        let zero = V::splat(0.0);
        let (mut x, mut v): ([V; K], [V; K]) = (load(&self.x), load(&self.v));
        let mut end = [[zero; K]; 4];
        for order in 0..=self.order {
            let forces = if order < 2 { load(&self.load[order]) } else { [zero; K] };
            let a = operator.accelerations(&x, &v, forces);
            self.put(order, &x, &v, &a);
            let weight = V::splat(order as f64);
            for k in 0..K {
                if order > 0 {
                    end[0][k] = end[0][k].add(x[k]);
                    end[1][k] = end[1][k].add(v[k]);
                }
                end[2][k] = end[2][k].add(a[k]);
                end[3][k] = weight.mul_add(a[k], end[3][k]);
            }
            let factor = V::splat(self.h * INVERSE[order + 1]);
            let drift_acceleration = differences(&a, V::splat(drive.ground_term(order, self.h)));
            for k in 0..K {
                x[k] = factor.mul(v[k]);
                v[k] = factor.mul(drift_acceleration[k]).mul(inside[k]);
            }
        }
        self.put_end(&mut end);
    }

    /// By the recursion, for more storeys than vectors hold.
    fn form_any(&mut self, model: &Model, regime: &Regime, drive: &Drive) {
        let (n, stride) = (self.storeys, self.stride);
        self.end.iter_mut().for_each(|sums| sums.fill(0.0));
        let zero = vec![0.0; n];
        let slope: Vec<f64> = drive.load_slope.iter().map(|slope| slope * self.h).collect();
        for k in 0..=self.order {
            let at = k * stride;
            let load = [&drive.load, &slope, &zero][k.min(2)];
            let (xk, vk) = (&self.x[at..at + n], &self.v[at..at + n]);
            regime.accelerations(model, xk, vk, load, &mut self.a[at..at + n]);
            for i in 0..n {
                if k > 0 {
                    self.end[0][i] += self.x[at + i];
                    self.end[1][i] += self.v[at + i];
                }
                self.end[2][i] += self.a[at + i];
                self.end[3][i] += k as f64 * self.a[at + i];
            }
            if k == self.order {
                break;
            }
            let factor = self.h / (k + 1) as f64;
            let mut below = drive.ground_term(k, self.h);
            let next = at + stride;
            for i in 0..n {
                let a = self.a[at + i];
                self.v[next + i] = factor * (a - below);
                self.x[next + i] = factor * self.v[at + i];
                below = a;
            }
        }
        self.end[3].iter_mut().for_each(|jerk| *jerk /= self.h);
    }

    /// Length of the step (s).
    #[inline]
    pub(crate) fn h(&self) -> f64 {
        self.h
    }

    fn column(&self, data: &[f64], i: usize) -> Polynomial {
        Polynomial::new((0..=self.order).map(|k| data[k * self.stride + i]))
    }

    /// Drift coordinate of storey `i`.
    pub(crate) fn drift(&self, i: usize) -> Polynomial {
        self.column(&self.x, i)
    }

    /// Drift rate of storey `i`.
    pub(crate) fn drift_rate(&self, i: usize) -> Polynomial {
        self.column(&self.v, i)
    }

    /// Absolute acceleration of floor `i`.
    pub(crate) fn floor_acceleration(&self, i: usize) -> Polynomial {
        self.column(&self.a, i)
    }

    /// Order of the last term.
    #[inline]
    pub(crate) fn order(&self) -> usize {
        self.order
    }

    /// Term `k` of the absolute acceleration of floor `i`.
    #[inline]
    pub(crate) fn floor_acceleration_term(&self, k: usize, i: usize) -> f64 {
        self.a[k * self.stride + i]
    }

    /// Changes of drifts and drift rates over the step.
    #[inline]
    pub(crate) fn changes(&self) -> (&[f64], &[f64]) {
        (&self.end[0][..self.storeys], &self.end[1][..self.storeys])
    }

    /// Floor accelerations and their rates at the end of the step.
    #[inline]
    pub(crate) fn accelerations_at_end(&self) -> (&[f64], &[f64]) {
        (&self.end[2][..self.storeys], &self.end[3][..self.storeys])
    }

    /// Changes of drifts and drift rates up to `s`.
    pub(crate) fn changes_at(&self, s: f64, drifts: &mut [f64], rates: &mut [f64]) {
        self.evaluate(&self.x, s, 1, drifts);
        self.evaluate(&self.v, s, 1, rates);
    }

    /// Sum of the coefficients from order `from` times powers of `s`.
    fn evaluate(&self, data: &[f64], s: f64, from: usize, out: &mut [f64]) {
        match self.stride {
            4 => self.evaluate_lanes::<4>(data, s, from, out),
            8 => self.evaluate_lanes::<8>(data, s, from, out),
            _ => {
                for (block, out) in out.chunks_mut(16).enumerate() {
                    let mut sums = [0.0; 16];
                    for k in (from..=self.order).rev() {
                        let at = k * self.stride + 16 * block;
                        for (sum, c) in sums.iter_mut().zip(&data[at..]).take(out.len()) {
                            *sum = *sum * s + c;
                        }
                    }
                    let factor = if from == 1 { s } else { 1.0 };
                    out.iter_mut().zip(&sums).for_each(|(o, sum)| *o = sum * factor);
                }
            }
        }
    }

    fn evaluate_lanes<const N: usize>(&self, data: &[f64], s: f64, from: usize, out: &mut [f64]) {
        let mut sums = [0.0; N];
        for orders in data[from * N..(self.order + 1) * N].as_chunks::<N>().0.iter().rev() {
            for l in 0..N {
                sums[l] = sums[l] * s + orders[l];
            }
        }
        let factor = if from == 1 { s } else { 1.0 };
        out.iter_mut().zip(&sums).for_each(|(o, sum)| *o = sum * factor);
    }

    /// Drift rates at `s`.
    pub(crate) fn rates(&self, s: f64, out: &mut [f64]) {
        self.evaluate(&self.v, s, 0, out);
    }
}

/// 1 / k.
pub(crate) const INVERSE: [f64; MAX_DEGREE + 1] = {
    let mut table = [0.0; MAX_DEGREE + 1];
    let mut k = 1;
    while k <= MAX_DEGREE {
        table[k] = 1.0 / k as f64;
        k += 1;
    }
    table
};

for_each_path! {
    fn form_by_table(series: &mut Series, model: &Model, table: &Table, drive: &Drive) = by_table
}

#[inline(always)]
fn by_table<V: Vector>(series: &mut Series, model: &Model, table: &Table, drive: &Drive) {
    match series.stride {
        4 => series.by_table::<V, 1>(model, table, drive),
        _ => series.by_table::<V, 2>(model, table, drive),
    }
}

for_each_path! {
    fn form_by_recursion(series: &mut Series, model: &Model, regime: &Regime, drive: &Drive) = by_recursion
}

#[inline(always)]
fn by_recursion<V: Vector>(series: &mut Series, model: &Model, regime: &Regime, drive: &Drive) {
    match series.stride {
        4 => series.by_recursion::<V, 1>(model, regime, drive),
        8 => series.by_recursion::<V, 2>(model, regime, drive),
        16 => series.by_recursion::<V, 4>(model, regime, drive),
        _ => series.by_recursion::<V, { MAX_LANES / WIDTH }>(model, regime, drive),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The neglected term is below 2^-60, and the next guard polynomials still fit.
    #[test]
    fn series_are_long_enough() {
        for phase in [1e-9, 1e-3, 0.1, 0.3, 0.7, MAX_PHASE] {
            let order = terms(phase);
            let term = (1..=order).fold(1.0, |term, k| term * phase / k as f64);
            assert!(term <= (-60f64).exp2(), "phase {phase}: {term:e}");
        }
        assert!(2 + terms(f64::INFINITY) <= MAX_DEGREE);
    }
}
