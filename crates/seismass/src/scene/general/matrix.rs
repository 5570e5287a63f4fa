//! Symmetric matrices over the floors: their form between storeys, their factor, and damping in the modes that springs and
//! a matrix have together.

use nalgebra::DMatrix;

use crate::error::{Domain, Error, Result};
use crate::scene::damping::orthogonalise;
use crate::tolerances::{SAME_ENTRY, SEMI_DEFINITE};

/// Checks an elastic matrix over the floors and makes it symmetric to the bit.
///
/// # Errors
/// [`Error::Invalid`] when its shape is wrong, a value is not finite, or it is not symmetric or not positive semi-definite.
pub(super) fn checked(matrix: &DMatrix<f64>, floors: usize) -> Result<DMatrix<f64>> {
    let refuse = |requirement: String, value: String| {
        Err(Error::invalid(Domain::Scene, "stiffness_matrix", "building", requirement, value))
    };
    if matrix.shape() != (floors, floors) {
        let requirement = format!("{floors} x {floors}, one row per floor");
        return refuse(requirement, format!("{} x {}", matrix.nrows(), matrix.ncols()));
    }
    if matrix.iter().any(|value| !value.is_finite()) {
        return refuse("finite".into(), "a value that is not".into());
    }
    for (i, j) in (0..floors).flat_map(|i| (0..i).map(move |j| (i, j))) {
        let (one, other) = (matrix[(i, j)], matrix[(j, i)]);
        if (one - other).abs() > SAME_ENTRY * (matrix[(i, i)].abs() + matrix[(j, j)].abs()) {
            return refuse("symmetric".into(), format!("{one} and {other} at ({}, {})", i + 1, j + 1));
        }
    }
    let symmetric = (matrix + matrix.transpose()) * 0.5;
    if factor(&symmetric).is_none() {
        return refuse("positive semi-definite".into(), "a matrix that gives energy".into());
    }
    Ok(symmetric)
}

/// L with L L^T = `matrix`, by Cholesky's method with pivots on the diagonal; none where the matrix is not positive
/// semi-definite.
fn factor(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let n = matrix.nrows();
    let mut rest = matrix.clone();
    let mut columns = DMatrix::zeros(n, n);
    let least = SEMI_DEFINITE * (0..n).map(|i| matrix[(i, i)].abs()).fold(0.0, f64::max);
    for rank in 0..n {
        let pivot = (0..n).max_by(|&i, &j| rest[(i, i)].total_cmp(&rest[(j, j)]))?;
        if rest[(pivot, pivot)] <= least {
            break;
        }
        let root = rest[(pivot, pivot)].sqrt();
        for i in 0..n {
            columns[(i, rank)] = rest[(i, pivot)] / root;
        }
        for i in 0..n {
            for j in 0..n {
                rest[(i, j)] -= columns[(i, rank)] * columns[(j, rank)];
            }
        }
    }
    rest.iter().all(|value| value.abs() <= least).then_some(columns)
}

/// T^T `matrix` T, with T the lower triangle of ones: from floor displacements to storey drifts.
pub(super) fn between_storeys(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let n = matrix.nrows();
    let mut sums = matrix.clone();
    for i in (0..n.saturating_sub(1)).rev() {
        for j in 0..n {
            sums[(i, j)] += sums[(i + 1, j)];
        }
    }
    for j in (0..n.saturating_sub(1)).rev() {
        for i in 0..n {
            sums[(i, j)] += sums[(i, j + 1)];
        }
    }
    sums
}

/// Frequencies and modes of a chain of springs beside an elastic matrix over its floors.
pub(super) struct Modes {
    /// Circular frequencies (rad/s), in no order.
    pub(super) frequencies: Vec<f64>,
    /// T^T M^(1/2) V, with V the orthogonal modes in coordinates scaled by the roots of the masses.
    columns: DMatrix<f64>,
}

impl Modes {
    /// One-sided Jacobi on the factors K^(1/2) B and L^T, times M^(-1/2), one above the other.
    pub(super) fn new(mass: &[f64], stiffness: &[f64], matrix: &DMatrix<f64>) -> Self {
        let n = mass.len();
        let root: Vec<f64> = mass.iter().map(|m| m.sqrt()).collect();
        let mut stacked = DMatrix::zeros(2 * n, n);
        for i in 0..n {
            stacked[(i, i)] = stiffness[i].sqrt() / root[i];
            if i > 0 {
                stacked[(i, i - 1)] = -stiffness[i].sqrt() / root[i - 1];
            }
        }
        if let Some(factor) = factor(matrix) {
            for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                stacked[(n + i, j)] = factor[(j, i)] / root[j];
            }
        }
        let mut modes = DMatrix::identity(n, n);
        orthogonalise(&mut stacked, Some(&mut modes));
        let frequencies = stacked.column_iter().map(|column| column.norm()).collect();
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            modes[(i, j)] *= root[i];
        }
        for i in (0..n.saturating_sub(1)).rev() {
            for j in 0..n {
                modes[(i, j)] += modes[(i + 1, j)];
            }
        }
        Self { frequencies, columns: modes }
    }

    /// The damping matrix between drift rates and storey forces with a ratio in every mode.
    pub(super) fn damping(&self, ratio: f64) -> DMatrix<f64> {
        let n = self.frequencies.len();
        DMatrix::from_fn(n, n, |i, j| {
            let (low, high) = (i.min(j), i.max(j));
            (0..n).map(|k| 2.0 * ratio * self.frequencies[k] * self.columns[(low, k)] * self.columns[(high, k)]).sum()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall() -> DMatrix<f64> {
        DMatrix::from_row_slice(2, 2, &[16.0, -5.0, -5.0, 2.0])
    }

    #[test]
    fn what_is_no_stiffness_is_refused() {
        assert!(checked(&wall(), 2).is_ok());
        assert!(checked(&DMatrix::from_row_slice(2, 2, &[1.0, 1.0, 1.0, 1.0]), 2).is_ok());
        assert!(checked(&DMatrix::zeros(2, 2), 2).is_ok());
        for entries in [[1.0, 2.0, 2.0, 1.0], [0.0, 1.0, 1.0, 0.0], [-1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.5, 1.0]] {
            assert!(checked(&DMatrix::from_row_slice(2, 2, &entries), 2).is_err(), "{entries:?}");
        }
        assert!(checked(&wall(), 3).is_err());
    }

    /// C M^-1 C = (2 zeta)^2 K: the damping of every mode is the root of its stiffness.
    #[test]
    fn modal_damping_has_the_ratio_in_the_modes_of_springs_and_matrix() {
        let (mass, stiffness, ratio) = ([2.0, 3.0], [7.0, 0.0], 0.1);
        let d = Modes::new(&mass, &stiffness, &wall()).damping(ratio);
        // C = B^T D B, with B the differences.
        let b = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, -1.0, 1.0]);
        let c = b.transpose() * d * &b;
        let inverse = DMatrix::from_row_slice(2, 2, &[0.5, 0.0, 0.0, 1.0 / 3.0]);
        let square = &c * inverse * &c;
        let k = wall() + DMatrix::from_row_slice(2, 2, &[7.0, 0.0, 0.0, 0.0]);
        assert!((square - 4.0 * ratio * ratio * k).amax() < 1e-14);
    }
}
