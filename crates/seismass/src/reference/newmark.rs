//! Newmark's method with the average acceleration, beta = 1/4 and gamma = 1/2, order 2.
//!
//! Newmark, A method of computation for structural dynamics, J. Eng. Mech. Div. ASCE 85 (1959) 67-94.

use nalgebra::DMatrix;

use super::scheme::{Columns, Scheme, SteppedSystem};

/// The method.
pub(super) struct Newmark;

impl Scheme for Newmark {
    /// The drift accelerations g_1 at the end solve g_1 = L y_1 + q_1 with v_1 = v + h/2 (g_0 + g_1) and
    /// x_1 = x + h v + h^2/4 (g_0 + g_1); g_0 is that of the equation of motion at the start.
    fn change(&self, system: &SteppedSystem, h: f64, columns: &Columns) -> Option<DMatrix<f64>> {
        let n = system.storeys();
        let stiffness = system.lower.columns(0, n);
        let damping = system.lower.columns(n, n);
        let v = columns.state.rows(n, n);
        let at_start = &system.lower * &columns.state;
        let effective = damping * (0.5 * h) + stiffness * (0.25 * h * h);
        // (I - effective) (g_0 + g_1) = 2 L y + q_0 + q_1 + h K v.
        let mut sum = at_start * 2.0 + &columns.start + &columns.end + stiffness * v * h;
        if !(DMatrix::identity(n, n) - effective).lu().solve_mut(&mut sum) {
            return None;
        }
        let mut change = DMatrix::zeros(2 * n, columns.state.ncols());
        change.rows_mut(0, n).copy_from(&(v * h + &sum * (0.25 * h * h)));
        change.rows_mut(n, n).copy_from(&(sum * (0.5 * h)));
        Some(change)
    }

    /// The average acceleration over the step.
    fn displacement_weights(&self) -> [f64; 2] {
        [0.25, 0.25]
    }
}
