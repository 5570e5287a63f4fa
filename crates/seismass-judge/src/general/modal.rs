//! Modal damping, from the eigenvalues of the stiffness in coordinates scaled by the roots of the masses.

use crate::real::Real;

/// Sweeps of Jacobi's method: it converges quadratically, and double-double needs some ten.
const SWEEPS: usize = 60;

/// C = M^(1/2) 2 zeta S^(1/2) M^(1/2) with S = M^(-1/2) K M^(-1/2): the ratio in every mode. Matrices are lists of rows.
pub(crate) fn modal_damping<R: Real>(mass: &[R], stiffness: &[Vec<R>], ratio: R) -> Vec<Vec<R>> {
    let n = mass.len();
    let root: Vec<R> = mass.iter().map(|&m| square_root(m)).collect();
    let scaled = (0..n).map(|i| (0..n).map(|j| stiffness[i][j] / (root[i] * root[j])).collect()).collect();
    let (squares, modes) = eigen(scaled);
    let frequencies: Vec<R> = squares.into_iter().map(square_root).collect();
    let entry = |i: usize, j: usize| {
        let sum = (0..n).fold(R::zero(), |sum, k| sum + modes[i][k] * frequencies[k] * modes[j][k]);
        R::of(2.0) * ratio * root[i] * root[j] * sum
    };
    (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
}

/// The square root of a number; zero where rounding has left less.
fn square_root<R: Real>(x: R) -> R {
    if x > R::zero() { x.sqrt() } else { R::zero() }
}

/// Eigenvalues of a symmetric matrix and its orthogonal eigenvectors, in columns: cyclic Jacobi rotations.
fn eigen<R: Real>(mut a: Vec<Vec<R>>) -> (Vec<R>, Vec<Vec<R>>) {
    let n = a.len();
    let one = R::of(1.0);
    let mut v: Vec<Vec<R>> = (0..n).map(|i| (0..n).map(|j| if i == j { one } else { R::zero() }).collect()).collect();
    for _ in 0..SWEEPS {
        let mut rotated = false;
        for (p, q) in (0..n).flat_map(|q| (0..q).map(move |p| (p, q))) {
            let size = R::epsilon() * (a[p][p].abs() + a[q][q].abs());
            if a[p][q].abs() <= size * R::of(1e-3) {
                continue;
            }
            rotated = true;
            let theta = (a[q][q] - a[p][p]) / (R::of(2.0) * a[p][q]);
            let tangent = one / (theta.abs() + square_root(theta * theta + one));
            let tangent = if theta < R::zero() { -tangent } else { tangent };
            let cosine = one / square_root(tangent * tangent + one);
            let sine = tangent * cosine;
            for row in a.iter_mut().chain(&mut v) {
                let (x, y) = (row[p], row[q]);
                (row[p], row[q]) = (cosine * x - sine * y, sine * x + cosine * y);
            }
            for column in 0..n {
                let (x, y) = (a[p][column], a[q][column]);
                (a[p][column], a[q][column]) = (cosine * x - sine * y, sine * x + cosine * y);
            }
        }
        if !rotated {
            break;
        }
    }
    ((0..n).map(|i| a[i][i]).collect(), v)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use nalgebra::DMatrix;
    use seismass::{Damping, GeneralBuilding, GravityEffect, Storey};

    use super::*;
    use crate::real::DoubleDouble;

    /// C M^-1 C = (2 zeta)^2 K for modal damping, of a chain of three masses.
    fn squares_to_the_stiffness<R: Real>() {
        let mass = [2.0, 5.0, 3.0].map(R::of);
        let k = [[7.0, -3.0, 0.0], [-3.0, 4.0, -1.0], [0.0, -1.0, 1.0]].map(|row| row.map(R::of).to_vec());
        let c = modal_damping(&mass, &k, R::of(0.25));
        for i in 0..3 {
            for j in 0..3 {
                let square = (0..3).fold(R::zero(), |sum, p| sum + c[i][p] * c[p][j] / mass[p]);
                let error = (square - R::of(0.25) * k[i][j]).abs();
                assert!(error <= R::of(200.0) * R::epsilon(), "{error:?}");
            }
        }
    }

    #[test]
    fn modal_damping_squares_to_the_stiffness() {
        squares_to_the_stiffness::<f64>();
        squares_to_the_stiffness::<DoubleDouble>();
    }

    /// The kernel forms the dampers of a building, which the judge takes from it, of springs and matrix together: to 1e-13
    /// of the largest entry, with storeys a thousand times as stiff as others and one that only the wall bears.
    #[test]
    fn the_kernels_dampers_of_a_wall_frame_are_modal() {
        let mass = [1200.0, 700.0, 2100.0];
        let springs = [4e5, 0.0, 6e8];
        let wall = DMatrix::from_row_slice(3, 3, &[5e5, -3e5, 1e5, -3e5, 4e5, -2e5, 1e5, -2e5, 2e5]);
        let storeys = springs.map(Storey::elastic).to_vec();
        let modal = Damping::Modal { ratio: 0.05 };
        let building =
            GeneralBuilding::new(mass.to_vec(), storeys, Some(wall.clone()), &modal, GravityEffect::None).unwrap();
        let mut k = wall;
        for (i, spring) in springs.into_iter().enumerate() {
            k[(i, i)] += spring;
            if i > 0 {
                k[(i - 1, i - 1)] += spring;
                k[(i, i - 1)] -= spring;
                k[(i - 1, i)] -= spring;
            }
        }
        let rows = (0..3).map(|i| (0..3).map(|j| DoubleDouble::of(k[(i, j)])).collect()).collect::<Vec<Vec<_>>>();
        let own = modal_damping(&mass.map(DoubleDouble::of), &rows, DoubleDouble::of(0.05));
        let found = building.damping_matrix();
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let error = (found[(i, j)] - own[i][j].to_f64()).abs();
            assert!(error <= 1e-13 * found.amax(), "{i} {j} {error:e}");
        }
    }
}
