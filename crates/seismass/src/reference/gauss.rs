//! Two-stage Gauss-Legendre, order 4: the paper's "implicit 4th-order Runge-Kutta method".
//!
//! Nodes 1/2 -+ sqrt(3)/6, Hairer, Lubich & Wanner, Geometric Numerical Integration (2006), Table II.1.1 (Kuntzmann
//! 1961, Butcher 1964); Hairer & Wanner, Solving Ordinary Differential Equations II (1996), section IV.5.

use nalgebra::DMatrix;

use super::scheme::{Columns, Scheme, SteppedSystem};

/// sqrt(3)/6.
const OFFSET: f64 = 0.288_675_134_594_812_9;
const NODES: [f64; 2] = [0.5 - OFFSET, 0.5 + OFFSET];
const STAGES: [[f64; 2]; 2] = [[0.25, 0.25 - OFFSET], [0.25 + OFFSET, 0.25]];

/// The method.
pub(super) struct Gauss;

impl Scheme for Gauss {
    /// The stages' drift accelerations g_s solve g_s = L y_s + q(c_s h), with L the lower half of A and y_s the stage:
    /// v_s = v + h sum a_st g_t, x_s = x + h c_s v + h^2 sum (a a)_st g_t.
    fn change(&self, system: &SteppedSystem, h: f64, columns: &Columns) -> Option<DMatrix<f64>> {
        let n = system.storeys();
        let width = columns.state.ncols();
        let stiffness = system.lower.columns(0, n);
        let damping = system.lower.columns(n, n);
        let v = columns.state.rows(n, n);
        let mut equations = DMatrix::identity(2 * n, 2 * n);
        let mut right = DMatrix::zeros(2 * n, width);
        let at_start = &system.lower * &columns.state;
        let of_velocity = stiffness * v;
        for s in 0..2 {
            let c = NODES[s];
            let load = &columns.start * (1.0 - c) + &columns.end * c;
            right.rows_mut(s * n, n).copy_from(&(&at_start + &of_velocity * (h * c) + load));
            for t in 0..2 {
                let square = STAGES[s][0] * STAGES[0][t] + STAGES[s][1] * STAGES[1][t];
                let mut part = equations.view_mut((s * n, t * n), (n, n));
                part -= damping * (h * STAGES[s][t]) + stiffness * (h * h * square);
            }
        }
        if !equations.lu().solve_mut(&mut right) {
            return None;
        }
        let mut change = DMatrix::zeros(2 * n, width);
        let (first, second) = (right.rows(0, n), right.rows(n, n));
        // Weights 1/2 for rates; 1/2 (1 - c) for displacements.
        change.rows_mut(n, n).copy_from(&((first + second) * (0.5 * h)));
        let displacement = (first * (1.0 - NODES[0]) + second * (1.0 - NODES[1])) * (0.5 * h * h);
        change.rows_mut(0, n).copy_from(&(v * h + displacement));
        Some(change)
    }

    /// Exact for an acceleration linear in time.
    fn displacement_weights(&self) -> [f64; 2] {
        [1.0 / 3.0, 1.0 / 6.0]
    }
}
