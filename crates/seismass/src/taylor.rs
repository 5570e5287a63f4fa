//! The Taylor series of the solution within one regime: exact to rounding, and dense output for guards and peaks.
//!
//! All coefficients belong to the normalised time s = tau / h in [0, 1].

use crate::bernstein::{MAX_DEGREE, Polynomial};
use crate::model::Model;
use crate::regime::Regime;

/// Longest step of one series, as frequency times time: longer intervals are split.
pub(crate) const MAX_PHASE: f64 = 1.0;
/// Relative size of the first neglected term.
const TRUNCATION: f64 = 1.0 / (1u64 << 60) as f64;

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

/// Series of drifts, drift rates and absolute floor accelerations, stored order by order.
#[derive(Debug, Clone, Default)]
pub(crate) struct Series {
    storeys: usize,
    order: usize,
    h: f64,
    x: Vec<f64>,
    v: Vec<f64>,
    a: Vec<f64>,
    scratch: Vec<f64>,
}

/// Number of terms so that the first neglected one is below rounding.
fn terms(phase: f64) -> usize {
    let mut term = 1.0;
    for k in 1..MAX_DEGREE - 3 {
        term *= phase / k as f64;
        if term < TRUNCATION {
            return k.max(3);
        }
    }
    MAX_DEGREE - 3
}

impl Series {
    /// Forms the series over a step `h` from the state (x, v).
    pub(crate) fn form(&mut self, model: &Model, regime: &Regime, x: &[f64], v: &[f64], drive: &Drive, h: f64) {
        let n = x.len();
        let order = terms(regime.frequency * h);
        (self.storeys, self.order, self.h) = (n, order, h);
        for buffer in [&mut self.x, &mut self.v, &mut self.a] {
            buffer.clear();
            buffer.resize((order + 1) * n, 0.0);
        }
        self.scratch.clear();
        self.scratch.resize(n, 0.0);
        self.x[..n].copy_from_slice(x);
        self.v[..n].copy_from_slice(v);
        for k in 0..=order {
            let at = k * n;
            match k {
                0 => self.scratch.copy_from_slice(&drive.load),
                1 => self.scratch.iter_mut().zip(&drive.load_slope).for_each(|(s, slope)| *s = slope * h),
                2 => self.scratch.fill(0.0),
                _ => {}
            }
            let (xk, vk) = (&self.x[at..at + n], &self.v[at..at + n]);
            regime.accelerations(model, xk, vk, &self.scratch, &mut self.a[at..at + n]);
            if k == order {
                break;
            }
            let factor = h / (k + 1) as f64;
            let mut below = match k {
                0 => drive.ground,
                1 => drive.ground_slope * h,
                _ => 0.0,
            };
            let next = at + n;
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
        Polynomial::new((0..=self.order).map(|k| data[k * self.storeys + i]))
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

    fn bound(&self, data: &[f64], i: usize, from: usize) -> f64 {
        (from..=self.order).map(|k| data[k * self.storeys + i].abs()).sum()
    }

    /// Bounds |x - x(0)|.
    pub(crate) fn drift_excursion(&self, i: usize) -> f64 {
        self.bound(&self.x, i, 1)
    }

    /// Bounds |v - v(0)|.
    pub(crate) fn rate_excursion(&self, i: usize) -> f64 {
        self.bound(&self.v, i, 1)
    }

    /// Bounds |a - a(0)|.
    pub(crate) fn acceleration_excursion(&self, i: usize) -> f64 {
        self.bound(&self.a, i, 1)
    }

    fn evaluate(&self, data: &[f64], s: f64, from: usize, out: &mut [f64]) {
        let n = self.storeys;
        out.fill(0.0);
        for k in (from..=self.order).rev() {
            for i in 0..n {
                out[i] = out[i] * s + data[k * n + i];
            }
        }
        if from == 1 {
            out.iter_mut().for_each(|value| *value *= s);
        }
    }

    /// Change of the drifts up to `s`.
    pub(crate) fn drift_changes(&self, s: f64, out: &mut [f64]) {
        self.evaluate(&self.x, s, 1, out);
    }

    /// Change of the drift rates up to `s`.
    pub(crate) fn rate_changes(&self, s: f64, out: &mut [f64]) {
        self.evaluate(&self.v, s, 1, out);
    }

    /// Drift rates at `s`.
    pub(crate) fn rates(&self, s: f64, out: &mut [f64]) {
        self.evaluate(&self.v, s, 0, out);
    }
}
