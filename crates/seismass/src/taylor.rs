//! The Taylor series of the solution within one regime: exact to rounding, and dense output for guards and peaks.
//!
//! All coefficients belong to the normalised time s = tau / h in [0, 1].

use crate::bernstein::{MAX_DEGREE, Polynomial};
use crate::lanes::{MAX_LANES, Vector, WIDTH, columns_of, differences, for_each_path, load, numbers, padded, store};
use crate::model::Model;
use crate::propagator::{MAX_TABLE, Table};
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
const PHASE_LIMITS: [f64; 19] = [
    0.0000, 0.0000, 0.0006, 0.0029, 0.0088, 0.0207, 0.0408, 0.0707, 0.1119, 0.1652, 0.2312, 0.3099, 0.4014, 0.5054,
    0.6215, 0.7493, 0.8883, 1.0380, 1.1978,
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
            None => form_any(self, model, regime, drive),
        }
    }

    /// From tables: floor accelerations from the second order on are products with drift accelerations and their rates.
    /// `S` is the number of storeys where it is known, else 0, and `D` its double.
    #[inline(always)]
    fn by_table<V: Vector, const K: usize, const S: usize, const D: usize>(
        &mut self,
        model: &Model,
        table: &Table,
        drive: &Drive,
    ) {
        let (n, h, order) = (self.storeys, self.h, self.order);
        let inside: [V; K] = load(&model.lanes.inside);
        let zero = V::splat(0.0);
        let v: [V; K] = load(&self.v);
        let (a, jerk): ([V; K], [V; K]) = (load(&self.a), load(&self.end[3]));
        let (first, rate) = (differences(&a, V::splat(drive.ground)), differences(&jerk, V::splat(drive.ground_slope)));
        // Powers of the step over that of the table.
        let (ratio, mut power) = (h / table.h, h / table.h);
        let terms = &columns_of::<K>(&table.terms)[..(order - 1) * 2 * n];
        let of_floors = &mut columns_mut::<K>(&mut self.a)[1..=order];
        for k in 0..K {
            V::splat(h).mul(jerk[k]).store(&mut of_floors[0][k]);
        }
        if S > 0 {
            let (mut firsts, mut rates) = ([zero; S], [zero; S]);
            for c in 0..S {
                (firsts[c], rates[c]) = (first[0].broadcast(c), rate[0].broadcast(c));
            }
            for (columns, out) in terms.as_chunks::<D>().0.iter().zip(&mut of_floors[1..]) {
                let (mut even, mut odd) = (zero, zero);
                for c in 0..S {
                    even = V::load(&columns[c][0]).mul_add(firsts[c], even);
                    odd = V::load(&columns[S + c][0]).mul_add(rates[c], odd);
                }
                power *= ratio;
                even.add(odd).mul(V::splat(power)).store(&mut out[0]);
            }
        } else {
            let weights = [numbers(&first), numbers(&rate)];
            let weights = || weights[0].as_flattened()[..n].iter().chain(&weights[1].as_flattened()[..n]);
            for (columns, out) in terms.chunks_exact(2 * n).zip(&mut of_floors[1..]) {
                let mut sums = [zero; K];
                for (column, &weight) in columns.iter().zip(weights()) {
                    let weight = V::splat(weight);
                    for k in 0..K {
                        sums[k] = V::load(&column[k]).mul_add(weight, sums[k]);
                    }
                }
                power *= ratio;
                for k in 0..K {
                    sums[k].mul(V::splat(power)).store(&mut out[k]);
                }
            }
        }
        // Drift rates and drifts by integration.
        let mut end = [[zero; K]; 4];
        end[2] = a;
        let (mut rates, mut drift_acceleration) = (v, first);
        // The ground's acceleration is linear.
        let mut bottom = V::splat(drive.ground_slope * h);
        let of_drifts = columns_mut::<K>(&mut self.x)[1..=order].iter_mut();
        let of_rates = columns_mut::<K>(&mut self.v)[1..=order].iter_mut();
        for (((x_out, v_out), a), weights) in of_drifts.zip(of_rates).zip(&*of_floors).zip(&WEIGHTS) {
            let (factor, weight) = (V::splat(h * weights[1]), V::splat(weights[0]));
            let mut floors = [zero; K];
            for k in 0..K {
                let drifts = factor.mul(rates[k]);
                rates[k] = factor.mul(drift_acceleration[k]).mul(inside[k]);
                floors[k] = V::load(&a[k]);
                drifts.store(&mut x_out[k]);
                rates[k].store(&mut v_out[k]);
                end[0][k] = end[0][k].add(drifts);
                end[1][k] = end[1][k].add(rates[k]);
                end[2][k] = end[2][k].add(floors[k]);
                end[3][k] = weight.mul_add(floors[k], end[3][k]);
            }
            drift_acceleration = differences(&floors, bottom);
            bottom = zero;
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
        let (zero, h) = (V::splat(0.0), self.h);
        let (mut x, mut v): ([V; K], [V; K]) = (load(&self.x), load(&self.v));
        let mut end = [[zero; K]; 4];
        let terms = columns_mut::<K>(&mut self.x).iter_mut().zip(columns_mut::<K>(&mut self.v));
        let terms = terms.zip(columns_mut::<K>(&mut self.a)).take(self.order + 1);
        for (order, ((x_term, v_term), a_term)) in terms.enumerate() {
            let forces = if order < 2 { load(&self.load[order]) } else { [zero; K] };
            let a = operator.accelerations(&x, &v, forces);
            put(&x, x_term);
            put(&v, v_term);
            put(&a, a_term);
            let weight = V::splat(order as f64);
            for k in 0..K {
                if order > 0 {
                    end[0][k] = end[0][k].add(x[k]);
                    end[1][k] = end[1][k].add(v[k]);
                }
                end[2][k] = end[2][k].add(a[k]);
                end[3][k] = weight.mul_add(a[k], end[3][k]);
            }
            let factor = V::splat(h * INVERSE[order + 1]);
            let drift_acceleration = differences(&a, V::splat(drive.ground_term(order, h)));
            for k in 0..K {
                x[k] = factor.mul(v[k]);
                v[k] = factor.mul(drift_acceleration[k]).mul(inside[k]);
            }
        }
        self.put_end(&mut end);
    }

    /// By the recursion, for more storeys than vectors hold.
    #[inline(always)]
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

    /// The same, with floor accelerations and their rates at the end of the step, padded.
    #[inline]
    pub(crate) fn ends(&self) -> &[Vec<f64>; 4] {
        &self.end
    }

    /// Floor accelerations and their rates at the end of the step.
    #[inline]
    pub(crate) fn accelerations_at_end(&self) -> (&[f64], &[f64]) {
        (&self.end[2][..self.storeys], &self.end[3][..self.storeys])
    }

    /// Changes of drifts and drift rates up to `s`.
    pub(crate) fn changes_at(&self, s: f64, drifts: &mut [f64], rates: &mut [f64]) {
        if self.stride <= MAX_TABLE {
            return changes_by_path(self, s, drifts, rates);
        }
        self.evaluate(&self.x, s, 1, drifts);
        self.evaluate(&self.v, s, 1, rates);
    }

    #[inline(always)]
    fn changes_in_lanes<V: Vector, const K: usize>(&self, s: f64, drifts: &mut [f64], rates: &mut [f64]) {
        let place = V::splat(s);
        let mut sums = [[V::splat(0.0); K]; 2];
        let (x, v) = (columns_of::<K>(&self.x), columns_of::<K>(&self.v));
        for (x, v) in x[1..=self.order].iter().zip(&v[1..=self.order]).rev() {
            for k in 0..K {
                sums[0][k] = sums[0][k].mul_add(place, V::load(&x[k]));
                sums[1][k] = sums[1][k].mul_add(place, V::load(&v[k]));
            }
        }
        for (sum, out) in sums.iter_mut().zip([drifts, rates]) {
            for k in 0..K {
                sum[k] = sum[k].mul(place);
            }
            for (out, value) in out.iter_mut().zip(numbers(sum).as_flattened()) {
                *out = *value;
            }
        }
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

/// Orders from the first on, and 1 over each.
const WEIGHTS: [[f64; 2]; MAX_DEGREE] = {
    let mut table = [[0.0; 2]; MAX_DEGREE];
    let mut k = 0;
    while k < MAX_DEGREE {
        table[k] = [(k + 1) as f64, INVERSE[k + 1]];
        k += 1;
    }
    table
};

/// Terms of a series, order by order.
#[inline(always)]
fn columns_mut<const K: usize>(values: &mut [f64]) -> &mut [[[f64; WIDTH]; K]] {
    values.as_chunks_mut::<WIDTH>().0.as_chunks_mut::<K>().0
}

#[inline(always)]
fn put<V: Vector, const K: usize>(vectors: &[V; K], term: &mut [[f64; WIDTH]; K]) {
    for k in 0..K {
        vectors[k].store(&mut term[k]);
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
    match series.storeys {
        1 => series.by_table::<V, 1, 1, 2>(model, table, drive),
        2 => series.by_table::<V, 1, 2, 4>(model, table, drive),
        3 => series.by_table::<V, 1, 3, 6>(model, table, drive),
        4 => series.by_table::<V, 1, 4, 8>(model, table, drive),
        _ => series.by_table::<V, 2, 0, 0>(model, table, drive),
    }
}

for_each_path! {
    fn changes_by_path(series: &Series, s: f64, drifts: &mut [f64], rates: &mut [f64]) = changes_by_width
}

#[inline(always)]
fn changes_by_width<V: Vector>(series: &Series, s: f64, drifts: &mut [f64], rates: &mut [f64]) {
    match series.stride {
        4 => series.changes_in_lanes::<V, 1>(s, drifts, rates),
        _ => series.changes_in_lanes::<V, 2>(s, drifts, rates),
    }
}

for_each_path! {
    fn form_any(series: &mut Series, model: &Model, regime: &Regime, drive: &Drive) = any_by_path
}

/// The compiler makes vectors of the path's width.
#[inline(always)]
fn any_by_path<V: Vector>(series: &mut Series, model: &Model, regime: &Regime, drive: &Drive) {
    series.form_any(model, regime, drive);
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
        32 => series.by_recursion::<V, 8>(model, regime, drive),
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
