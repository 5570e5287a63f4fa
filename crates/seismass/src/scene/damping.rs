//! Natural frequencies and damping of the bare building, to high relative accuracy.
//!
//! With G = K^(1/2) B M^(-1/2) (B takes floor velocities to drift rates, K and M diagonal), the natural frequencies
//! are the singular values of the bidiagonal G; one-sided Jacobi finds all of them, and the left singular vectors,
//! to high relative accuracy however different the storeys are. Modal damping C = M Phi diag(2 zeta w) Phi^T M is
//! then C = B^T D B with the storey matrix D = 2 zeta K^(1/2) U diag(1/w) U^T K^(1/2).

use nalgebra::DMatrix;

use crate::error::{Domain, Error, Result};
use crate::tolerances::ORTHOGONAL;

/// Jacobi converges quadratically; more sweeps than this never help.
const MAX_SWEEPS: usize = 60;

/// How the damping matrix C of the bare building is made; it stays constant through yielding and sliding.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
pub enum Damping {
    /// This ratio of critical damping in every vibration mode.
    Modal {
        /// Damping ratio, 0 to 1: 0.05 for 5 %.
        ratio: f64,
    },
    /// C = a M + b K with this ratio in two modes.
    Rayleigh {
        /// Damping ratio in both modes, 0 to 1.
        ratio: f64,
        /// The two modes, counted from 1.
        modes: [usize; 2],
    },
    /// A symmetric matrix in floor coordinates (N s/m).
    Matrix(#[cfg_attr(feature = "serde", serde(with = "crate::scene::form"))] DMatrix<f64>),
}

impl Default for Damping {
    /// 5 % in every mode.
    fn default() -> Self {
        Self::Modal { ratio: 0.05 }
    }
}

/// Damping as it acts between drift rates and storey forces.
#[derive(Debug, Clone, PartialEq)]
pub enum StoreyDamping {
    /// No damping.
    None,
    /// C = a M + b K: linear cost in the number of storeys.
    Rayleigh {
        /// Factor of the mass matrix (1/s).
        mass_factor: f64,
        /// Factor of the stiffness matrix (s).
        stiffness_factor: f64,
    },
    /// Symmetric matrix D from drift rates to storey damping forces (N s/m); C = B^T D B.
    Dense(DMatrix<f64>),
}

impl StoreyDamping {
    /// The damping operator of a building.
    ///
    /// # Errors
    /// [`Error::Invalid`] when the ratio is not from 0 to 1, a mode does not exist, or the matrix is not symmetric.
    pub fn new(mass: &[f64], stiffness: &[f64], damping: &Damping) -> Result<Self> {
        let refuse = |parameter: &str, requirement: String, value: String| {
            Err(Error::invalid(Domain::Scene, parameter, "building", requirement, value))
        };
        let n = mass.len();
        match damping {
            Damping::Modal { ratio } | Damping::Rayleigh { ratio, .. } if !(0.0..=1.0).contains(ratio) => {
                // What is above 1 was meant in per cent.
                let requirement =
                    if *ratio > 1.0 { "a ratio of at most 1 (0.05 for 5 %)" } else { "a ratio from 0 to 1" };
                refuse("damping", requirement.into(), ratio.to_string())
            }
            Damping::Modal { ratio } if *ratio == 0.0 => Ok(Self::None),
            Damping::Modal { ratio } => Ok(Self::Dense(modal_storey_matrix(mass, stiffness, *ratio))),
            Damping::Rayleigh { ratio, modes: [first, second] } => {
                if first == second || [first, second].iter().any(|&&mode| mode == 0 || mode > n) {
                    let requirement = format!("two different modes from 1 to {n}");
                    return refuse("damping modes", requirement, format!("{first} and {second}"));
                }
                let w = natural_frequencies(mass, stiffness);
                let (wi, wj) = (w[first - 1], w[second - 1]);
                let stiffness_factor = 2.0 * ratio / (wi + wj);
                Ok(Self::Rayleigh { mass_factor: stiffness_factor * wi * wj, stiffness_factor })
            }
            Damping::Matrix(c) => {
                if c.shape() != (n, n) {
                    let requirement = format!("{n} x {n}, one row per floor");
                    return refuse("damping matrix", requirement, format!("{} x {}", c.nrows(), c.ncols()));
                }
                if c.iter().any(|value| !value.is_finite()) {
                    return refuse("damping matrix", "finite".into(), "a value that is not".into());
                }
                for (i, j) in (0..n).flat_map(|i| (0..i).map(move |j| (i, j))) {
                    let tolerance = 1e-12 * (c[(i, i)].abs() + c[(j, j)].abs());
                    if (c[(i, j)] - c[(j, i)]).abs() > tolerance {
                        let value = format!("{} and {} at ({}, {})", c[(i, j)], c[(j, i)], i + 1, j + 1);
                        return refuse("damping matrix", "symmetric".into(), value);
                    }
                }
                let symmetric = (c + c.transpose()) * 0.5;
                // D = T^T C T with T the lower triangle of ones: sums over the floors from a storey upwards.
                let mut d = symmetric;
                for i in (0..n).rev() {
                    for j in (0..n).rev() {
                        let below = if i + 1 < n { d[(i + 1, j)] } else { 0.0 };
                        d[(i, j)] += below;
                    }
                }
                for i in 0..n {
                    for j in (0..n.saturating_sub(1)).rev() {
                        d[(i, j)] += d[(i, j + 1)];
                    }
                }
                Ok(Self::Dense(d))
            }
        }
    }

    /// Damping matrix C in floor coordinates (N s/m).
    pub fn floor_matrix(&self, mass: &[f64], stiffness: &[f64]) -> DMatrix<f64> {
        let n = mass.len();
        let storey = match self {
            Self::None => DMatrix::zeros(n, n),
            Self::Dense(d) => d.clone(),
            Self::Rayleigh { stiffness_factor, .. } => {
                DMatrix::from_fn(n, n, |i, j| if i == j { stiffness_factor * stiffness[i] } else { 0.0 })
            }
        };
        let mass_factor = if let Self::Rayleigh { mass_factor, .. } = self { *mass_factor } else { 0.0 };
        let at = |i: usize, j: usize| if i < n && j < n { storey[(i, j)] } else { 0.0 };
        DMatrix::from_fn(n, n, |i, j| {
            let diagonal = if i == j { mass_factor * mass[i] } else { 0.0 };
            at(i, j) - at(i + 1, j) - at(i, j + 1) + at(i + 1, j + 1) + diagonal
        })
    }
}

/// Natural frequencies of the bare building (rad/s), lowest first.
pub fn natural_frequencies(mass: &[f64], stiffness: &[f64]) -> Vec<f64> {
    let columns = orthogonal_columns(mass, stiffness);
    let mut w: Vec<f64> = columns.column_iter().map(|c| c.norm()).collect();
    w.sort_by(f64::total_cmp);
    w
}

fn modal_storey_matrix(mass: &[f64], stiffness: &[f64], ratio: f64) -> DMatrix<f64> {
    // Columns w u; so U diag(1/w) U^T is the sum of c c^T / w^3.
    let columns = orthogonal_columns(mass, stiffness);
    let n = mass.len();
    let mut d = DMatrix::zeros(n, n);
    for c in columns.column_iter() {
        let w = c.norm();
        let scale = 2.0 * ratio / w;
        for i in 0..n {
            let left = scale * (c[i] / w) * stiffness[i].sqrt();
            for j in 0..=i {
                d[(i, j)] += left * (c[j] / w) * stiffness[j].sqrt();
            }
        }
    }
    d.fill_upper_triangle_with_lower_triangle();
    d
}

/// G V with orthogonal columns: one-sided Jacobi on G = K^(1/2) B M^(-1/2).
fn orthogonal_columns(mass: &[f64], stiffness: &[f64]) -> DMatrix<f64> {
    let n = mass.len();
    let mut g = DMatrix::zeros(n, n);
    for i in 0..n {
        g[(i, i)] = (stiffness[i] / mass[i]).sqrt();
        if i > 0 {
            g[(i, i - 1)] = -(stiffness[i] / mass[i - 1]).sqrt();
        }
    }
    orthogonalise(&mut g, None);
    g
}

/// Makes columns orthogonal by rotations (one-sided Jacobi), which another matrix follows.
pub(super) fn orthogonalise(g: &mut DMatrix<f64>, mut follower: Option<&mut DMatrix<f64>>) {
    let n = g.ncols();
    for _ in 0..MAX_SWEEPS {
        let mut rotated = false;
        for p in 0..n {
            for q in p + 1..n {
                let (cp, cq) = (g.column(p), g.column(q));
                let (pp, qq, pq) = (cp.norm_squared(), cq.norm_squared(), cp.dot(&cq));
                if pq.abs() <= ORTHOGONAL * pp.sqrt() * qq.sqrt() {
                    continue;
                }
                rotated = true;
                let zeta = (qq - pp) / (2.0 * pq);
                let t = 1.0f64.copysign(zeta) / (zeta.abs() + libm::hypot(zeta, 1.0));
                let cosine = 1.0 / libm::hypot(t, 1.0);
                let sine = cosine * t;
                rotate(g, [p, q], cosine, sine);
                if let Some(follower) = &mut follower {
                    rotate(follower, [p, q], cosine, sine);
                }
            }
        }
        if !rotated {
            break;
        }
    }
}

/// Rotates two columns.
fn rotate(g: &mut DMatrix<f64>, [p, q]: [usize; 2], cosine: f64, sine: f64) {
    for r in 0..g.nrows() {
        let (x, y) = (g[(r, p)], g[(r, q)]);
        g[(r, p)] = cosine * x - sine * y;
        g[(r, q)] = sine * x + cosine * y;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// w_j = 2 sqrt(k/m) sin((2 j - 1) pi / (2 (2 n + 1))) of a uniform shear building.
    #[test]
    fn uniform_building_has_its_closed_form_frequencies() {
        for n in [1, 2, 5, 40] {
            let w = natural_frequencies(&vec![3.0; n], &vec![7.0; n]);
            for (j, &w) in w.iter().enumerate() {
                let angle = std::f64::consts::PI * (2 * j + 1) as f64 / (2 * (2 * n + 1)) as f64;
                let expected = 2.0 * (7.0f64 / 3.0).sqrt() * angle.sin();
                assert!((w / expected - 1.0).abs() < 1e-14, "n {n}, mode {}: {w} {expected}", j + 1);
            }
        }
    }

    /// C^2 = (2 zeta)^2 K for unit masses: C = 2 zeta (M^(-1/2) K M^(-1/2))^(1/2).
    #[test]
    fn modal_damping_is_the_square_root_of_the_stiffness() {
        let (mass, stiffness) = ([1.0, 1.0, 1.0], [5.0, 3.0, 2.0]);
        let d = StoreyDamping::new(&mass, &stiffness, &Damping::Modal { ratio: 0.05 }).unwrap();
        let c = d.floor_matrix(&mass, &stiffness);
        let square = &c * &c;
        let k = [[8.0, -3.0, 0.0], [-3.0, 5.0, -2.0], [0.0, -2.0, 2.0]];
        for i in 0..3 {
            for j in 0..3 {
                assert!((square[(i, j)] - 0.01 * k[i][j]).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn a_ratio_out_of_range_is_refused() {
        let refused = |damping| StoreyDamping::new(&[1.0; 2], &[1.0; 2], &damping).unwrap_err().to_string();
        let per_cent = "damping of building must be a ratio of at most 1 (0.05 for 5 %); got 5";
        assert_eq!(refused(Damping::Modal { ratio: 5.0 }), per_cent);
        assert_eq!(refused(Damping::Rayleigh { ratio: 5.0, modes: [1, 2] }), per_cent);
        for ratio in [-0.05, f64::NAN] {
            let message = format!("damping of building must be a ratio from 0 to 1; got {ratio}");
            assert_eq!(refused(Damping::Modal { ratio }), message);
        }
        assert!(StoreyDamping::new(&[1.0], &[1.0], &Damping::Modal { ratio: 1.0 }).is_ok());
    }

    #[test]
    fn matrix_damping_round_trips_through_storey_coordinates() {
        let c = DMatrix::from_row_slice(3, 3, &[4.0, -1.0, 0.5, -1.0, 3.0, -0.5, 0.5, -0.5, 2.0]);
        let (mass, stiffness) = ([1.0; 3], [1.0; 3]);
        let d = StoreyDamping::new(&mass, &stiffness, &Damping::Matrix(c.clone())).unwrap();
        assert!((d.floor_matrix(&mass, &stiffness) - c).amax() < 1e-14);
    }

    #[test]
    fn wide_stiffness_contrast_keeps_relative_accuracy() {
        // A soft storey under a stiff one: w_1^2 -> k_1 / (m_1 + m_2) with a correction of order k_1 / k_2.
        let w = natural_frequencies(&[1.0, 1.0], &[1.0, 1e12]);
        assert!((w[0] * w[0] - 0.5).abs() < 1e-12, "{}", w[0] * w[0]);
    }
}
