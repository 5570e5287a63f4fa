//! One step of an implicit method in one regime, where the system is linear: y' = A y + (0, q), with y the drifts and
//! drift rates and q linear in time. The step is affine, and its map is formed once per regime and step length.

use nalgebra::DMatrix;

use crate::regime::{Regime, Row};
use crate::state::State;

/// The linear system of a regime.
pub(super) struct SteppedSystem {
    /// Drift accelerations from drifts and drift rates: the lower half of A.
    pub(super) lower: DMatrix<f64>,
}

impl SteppedSystem {
    pub(super) fn new(state: &State) -> Self {
        let n = state.storeys();
        let regime = &state.regime;
        let mut unit = vec![0.0; 2 * n];
        let (mut a, load) = (vec![0.0; n], vec![0.0; n]);
        let mut lower = DMatrix::zeros(n, 2 * n);
        for column in 0..2 * n {
            unit[column] = 1.0;
            let (x, v) = unit.split_at(n);
            regime.accelerations(state.model, x, v, &load, &mut a);
            for i in 0..n {
                lower[(i, column)] = if i > 0 { a[i] - a[i - 1] } else { a[0] };
            }
            unit[column] = 0.0;
        }
        Self { lower }
    }

    /// Number of storeys.
    pub(super) fn storeys(&self) -> usize {
        self.lower.nrows()
    }
}

/// Columns of states and loads to be taken over one step together.
pub(super) struct Columns {
    /// Drifts and drift rates at the start, 2 n rows.
    pub(super) state: DMatrix<f64>,
    /// q at the start, n rows.
    pub(super) start: DMatrix<f64>,
    /// q at the end, n rows.
    pub(super) end: DMatrix<f64>,
}

impl Columns {
    /// Unit columns of the state, then of q at the start, then of q at the end.
    fn units(n: usize) -> Self {
        let unit = |rows: usize, offset: usize| {
            DMatrix::from_fn(rows, 4 * n, |row, column| f64::from(u8::from(column == row + offset)))
        };
        Self { state: unit(2 * n, 0), start: unit(n, 2 * n), end: unit(n, 3 * n) }
    }
}

/// An implicit one-step method.
pub(super) trait Scheme {
    /// Change of drifts and drift rates over a step of length `h`, 2 n rows; none where the equations are singular.
    fn change(&self, system: &SteppedSystem, h: f64, columns: &Columns) -> Option<DMatrix<f64>>;

    /// Weights of a block's acceleration at both ends in its displacement: h w + h^2 (first b_0 + second b_1).
    fn displacement_weights(&self) -> [f64; 2];
}

/// The map of a step, by columns: drifts, drift rates, q at the start, q at the end.
pub(super) struct StepMap {
    columns: Vec<f64>,
    tangent: Vec<f64>,
    mass: Vec<f64>,
}

impl StepMap {
    pub(super) fn new(scheme: &impl Scheme, system: &SteppedSystem, regime: &Regime, h: f64) -> Option<Self> {
        let columns = scheme.change(system, h, &Columns::units(system.storeys()))?;
        let columns = columns.as_slice().to_vec();
        Some(Self { columns, tangent: regime.row(Row::Tangent).to_vec(), mass: regime.row(Row::Mass).to_vec() })
    }

    /// Whether this is the map of a regime.
    pub(super) fn belongs_to(&self, regime: &Regime) -> bool {
        self.tangent == regime.row(Row::Tangent) && self.mass == regime.row(Row::Mass)
    }

    /// `change` = map of (x, v, q at the start, q at the end).
    #[inline]
    pub(super) fn apply(&self, x: &[f64], v: &[f64], start: &[f64], end: &[f64], change: &mut [f64]) {
        change.fill(0.0);
        let weights = x.iter().chain(v).chain(start).chain(end);
        for (column, &weight) in self.columns.chunks_exact(change.len().max(1)).zip(weights) {
            for (to, c) in change.iter_mut().zip(column) {
                *to += c * weight;
            }
        }
    }
}
