//! The Taylor series of the solution within one regime: exact to rounding, and dense output for guards and peaks.
//!
//! All coefficients belong to the normalised time s = tau / h in [0, 1].

use crate::bernstein::Polynomial;
use crate::lanes::{InstructionSet, first_lanes, padded};
use crate::model::Model;
use crate::regime::{LaneOperator, Regime};

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
    /// Sums of the absolute coefficients of x, v and a beside the first.
    excursion: [Vec<f64>; 3],
    load: Vec<f64>,
}

/// Largest phase at which the term of order 3, 4, ... is below 2^-60: phase^k / k! rounded down.
const PHASE_LIMITS: [f64; 26] = [
    0.0000, 0.0000, 0.0006, 0.0029, 0.0088, 0.0207, 0.0408, 0.0707, 0.1119, 0.1652, 0.2312, 0.3099, 0.4014, 0.5054,
    0.6215, 0.7493, 0.8883, 1.0380, 1.1978, 1.3672, 1.5458, 1.7329, 1.9282, 2.1311, 2.3412, 2.5582,
];

/// Order of the first term that is below rounding.
fn terms(phase: f64) -> usize {
    3 + PHASE_LIMITS.iter().position(|&limit| phase < limit).unwrap_or(PHASE_LIMITS.len() - 1)
}

impl Series {
    /// Forms the series over a step `h` from the state (x, v).
    pub(crate) fn form(&mut self, model: &Model, regime: &Regime, x: &[f64], v: &[f64], drive: &Drive, h: f64) {
        let n = x.len();
        let (order, stride) = (terms(regime.frequency * h), padded(n));
        (self.storeys, self.stride, self.order, self.h) = (n, stride, order, h);
        let length = (order + 1) * stride;
        for buffer in [&mut self.x, &mut self.v, &mut self.a] {
            if buffer.len() < length {
                buffer.resize(length, 0.0);
            }
        }
        if self.load.len() != stride {
            self.load = vec![0.0; stride];
            self.excursion = [vec![0.0; stride], vec![0.0; stride], vec![0.0; stride]];
        }
        self.x[..stride].fill(0.0);
        self.v[..stride].fill(0.0);
        self.x[..n].copy_from_slice(x);
        self.v[..n].copy_from_slice(v);
        match InstructionSet::in_use() {
            // SAFETY: `in_use` returns only what this machine has.
            #[cfg(target_arch = "x86_64")]
            #[allow(unsafe_code)]
            InstructionSet::Avx512 | InstructionSet::Avx2 => unsafe { form_avx2(self, model, regime, drive) },
            _ => form_baseline(self, model, regime, drive),
        }
    }

    /// Sets the load to term `k` of the floor loads over the step.
    #[inline(always)]
    fn set_load(&mut self, drive: &Drive, k: usize) {
        match k {
            0 => self.load[..self.storeys].copy_from_slice(&drive.load),
            1 => self.load.iter_mut().zip(&drive.load_slope).for_each(|(load, slope)| *load = slope * self.h),
            2 => self.load.fill(0.0),
            _ => {}
        }
    }

    /// Forms the orders above the first, with `N` lanes.
    #[inline(always)]
    fn form_lanes<const N: usize, const FUSED: bool>(&mut self, model: &Model, regime: &Regime, drive: &Drive) {
        let operator = LaneOperator::<N>::new(model, regime);
        let inside: [f64; N] = first_lanes(&model.lanes.inside);
        let (mut x, mut v): ([f64; N], [f64; N]) = (first_lanes(&self.x), first_lanes(&self.v));
        let mut excursion = [[0.0; N]; 3];
        for k in 0..=self.order {
            self.set_load(drive, k);
            let a = operator.accelerations::<FUSED>(&x, &v, first_lanes(&self.load));
            let at = k * N;
            self.x[at..at + N].copy_from_slice(&x);
            self.v[at..at + N].copy_from_slice(&v);
            self.a[at..at + N].copy_from_slice(&a);
            if k > 0 {
                for l in 0..N {
                    excursion[0][l] += x[l].abs();
                    excursion[1][l] += v[l].abs();
                    excursion[2][l] += a[l].abs();
                }
            }
            let factor = self.h / (k + 1) as f64;
            for l in 0..N {
                x[l] = factor * v[l];
            }
            v[0] = factor * (a[0] - drive.ground_term(k, self.h));
            for l in 1..N {
                v[l] = factor * (a[l] - a[l - 1]) * inside[l];
            }
        }
        for (kept, formed) in self.excursion.iter_mut().zip(&excursion) {
            kept.copy_from_slice(formed);
        }
    }

    /// Forms the orders above the first, for more storeys than lanes are compiled for.
    fn form_any(&mut self, model: &Model, regime: &Regime, drive: &Drive) {
        let (n, stride) = (self.storeys, self.stride);
        self.excursion.iter_mut().for_each(|sums| sums.fill(0.0));
        for k in 0..=self.order {
            let at = k * stride;
            self.set_load(drive, k);
            let (xk, vk) = (&self.x[at..at + n], &self.v[at..at + n]);
            regime.accelerations(model, xk, vk, &self.load[..n], &mut self.a[at..at + n]);
            if k > 0 {
                for (sums, data) in self.excursion.iter_mut().zip([&self.x, &self.v, &self.a]) {
                    sums.iter_mut().zip(&data[at..at + n]).for_each(|(sum, c)| *sum += c.abs());
                }
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

    /// Bounds |x - x(0)|.
    pub(crate) fn drift_excursion(&self, i: usize) -> f64 {
        self.excursion[0][i]
    }

    /// Bounds |v - v(0)|.
    pub(crate) fn rate_excursion(&self, i: usize) -> f64 {
        self.excursion[1][i]
    }

    /// Bounds |a - a(0)|.
    pub(crate) fn acceleration_excursion(&self, i: usize) -> f64 {
        self.excursion[2][i]
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
        for orders in data[from * N..(self.order + 1) * N].chunks_exact(N).rev() {
            for l in 0..N {
                sums[l] = sums[l] * s + orders[l];
            }
        }
        let factor = if from == 1 { s } else { 1.0 };
        out.iter_mut().zip(&sums).for_each(|(o, sum)| *o = sum * factor);
    }

    /// Change of the drifts up to `s`.
    pub(crate) fn drift_changes(&self, s: f64, out: &mut [f64]) {
        self.evaluate(&self.x, s, 1, out);
    }

    /// Change of the drift rates up to `s`.
    pub(crate) fn rate_changes(&self, s: f64, out: &mut [f64]) {
        self.evaluate(&self.v, s, 1, out);
    }

    /// Appends rows, padded to whole vectors: changes of drifts and drift rates over the step, floor accelerations and
    /// their rates at its end.
    pub(crate) fn push_rows_at_end(&self, out: &mut Vec<f64>) {
        let from = out.len();
        out.resize(from + 4 * self.stride, 0.0);
        let rows = &mut out[from..];
        match self.stride {
            4 => self.rows_at_end::<4>(rows),
            8 => self.rows_at_end::<8>(rows),
            stride => {
                for block in 0..stride / 8 {
                    let mut part = [0.0; 32];
                    self.rows_of_block::<8>(8 * block, &mut part);
                    for (row, values) in rows.chunks_exact_mut(stride).zip(part.chunks_exact(8)) {
                        row[8 * block..8 * block + 8].copy_from_slice(values);
                    }
                }
            }
        }
    }

    fn rows_at_end<const N: usize>(&self, rows: &mut [f64]) {
        self.rows_of_block::<N>(0, rows);
    }

    /// Rows of the `N` storeys from `first`.
    fn rows_of_block<const N: usize>(&self, first: usize, rows: &mut [f64]) {
        let mut sums = [[0.0; N]; 4];
        let orders =
            |data: &[f64], k: usize| data[k * self.stride + first..].first_chunk::<N>().copied().unwrap_or([0.0; N]);
        for k in (1..=self.order).rev() {
            let (x, v, a) = (orders(&self.x, k), orders(&self.v, k), orders(&self.a, k));
            for l in 0..N {
                sums[0][l] += x[l];
                sums[1][l] += v[l];
                sums[2][l] += a[l];
                sums[3][l] += k as f64 * a[l];
            }
        }
        let a = orders(&self.a, 0);
        for l in 0..N {
            sums[2][l] += a[l];
            sums[3][l] /= self.h;
        }
        for (row, sums) in rows.chunks_exact_mut(N).zip(&sums) {
            row.copy_from_slice(sums);
        }
    }

    /// Drift rates at `s`.
    pub(crate) fn rates(&self, s: f64, out: &mut [f64]) {
        self.evaluate(&self.v, s, 0, out);
    }
}

macro_rules! form_for {
    ($name:ident, $fused:literal $(, $feature:literal)?) => {
        $(#[target_feature(enable = $feature)])?
        fn $name(series: &mut Series, model: &Model, regime: &Regime, drive: &Drive) {
            match series.stride {
                4 => series.form_lanes::<4, $fused>(model, regime, drive),
                8 => series.form_lanes::<8, $fused>(model, regime, drive),
                16 => series.form_lanes::<16, $fused>(model, regime, drive),
                _ => series.form_any(model, regime, drive),
            }
        }
    };
}

form_for!(form_baseline, false);
#[cfg(target_arch = "x86_64")]
form_for!(form_avx2, true, "avx2,fma");

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bernstein::MAX_DEGREE;

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
