//! Elastic storey shears of a response spectrum analysis, by which the page designs the strengths of a building.

use nalgebra::{DMatrix, SymmetricEigen};
use seismass::spectrum::response_spectra;
use seismass::{Control, Motion, Result};

use crate::case::{Case, refuse};

/// Damping ratio of the design spectrum, whatever that of the building.
const DAMPING: f64 = 0.05;

/// Returns V_e of each storey over the weight of the building without goods, with a share of the goods counted, for the mean
/// spectrum of a suite. The shears of all modes are combined by SRSS.
pub(crate) fn elastic_shear_over_weight(case: &Case, counted: f64, suite: &[Motion]) -> Result<Vec<f64>> {
    if !(counted.is_finite() && counted >= 0.0) {
        return Err(refuse("counted", "zero or positive", counted));
    }
    if suite.is_empty() {
        return Err(refuse("motions", "at least one, for the spectrum of the design", "none"));
    }
    let shears = storey_shears(&case.mass_with(counted), &case.stiffness()?, |periods| mean_spectrum(suite, periods))?;
    Ok(shears.iter().map(|shear| shear / case.weight()).collect())
}

/// Mean pseudo-acceleration (m/s2) of the suite at periods (s).
fn mean_spectrum(suite: &[Motion], periods: &[f64]) -> Result<Vec<f64>> {
    let peaks = response_spectra(suite, periods, &[DAMPING], None, &Control::default())?;
    let mean = |(place, period): (usize, &f64)| {
        let frequency = 2.0 * std::f64::consts::PI / period;
        let of_motion = |motion: usize| peaks[motion * periods.len() + place] * (frequency * frequency);
        (0..suite.len()).map(of_motion).sum::<f64>() / suite.len() as f64
    };
    Ok(periods.iter().enumerate().map(mean).collect())
}

/// Combined storey shears (N) of a building: V_in = sum over floors j >= i of Gamma_n m_j
/// phi_jn A_n (Chopra, Dynamics of Structures, chapter 13).
fn storey_shears(
    mass: &[f64],
    stiffness: &[f64],
    spectrum: impl FnOnce(&[f64]) -> Result<Vec<f64>>,
) -> Result<Vec<f64>> {
    let n = mass.len();
    // M^(-1/2) K M^(-1/2), whose vectors are M^(1/2) phi.
    let modes = SymmetricEigen::new(DMatrix::from_fn(n, n, |i, j| {
        let entry = match i.abs_diff(j) {
            0 => stiffness[i] + stiffness.get(i + 1).unwrap_or(&0.0),
            1 => -stiffness[i.max(j)],
            _ => 0.0,
        };
        entry / (mass[i] * mass[j]).sqrt()
    }));
    let periods: Vec<f64> = modes.eigenvalues.iter().map(|square| 2.0 * std::f64::consts::PI / square.sqrt()).collect();
    let ordinates = spectrum(&periods)?;
    let mut squares = vec![0.0; n];
    for (vector, ordinate) in modes.eigenvectors.column_iter().zip(ordinates) {
        let participation: f64 = vector.iter().zip(mass).map(|(y, m)| y * m.sqrt()).sum();
        let mut shear = 0.0;
        for floor in (0..n).rev() {
            shear += participation * mass[floor].sqrt() * vector[floor] * ordinate;
            squares[floor] += shear * shear;
        }
    }
    Ok(squares.iter().map(|square| square.sqrt()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two equal floors: w^2 = (3 -+ sqrt 5)/2 k/m, modal base shears A_n Gamma_n^2 with Gamma_n^2 = (1 +- 2/sqrt 5) m, and
    /// roof forces that leave Gamma_n phi_2n m A_n = (1/2 +- 3/(2 sqrt 5)) m A_n, -(...) in the second mode.
    #[test]
    fn shears_of_two_equal_floors_have_a_closed_form() {
        let (k, ordinates) = (300.0, [2.0, 5.0]);
        let root = 5.0f64.sqrt();
        let found = storey_shears(&[1.0, 1.0], &[k, k], |periods| {
            let long = 2.0 * std::f64::consts::PI / ((3.0 - root) / 2.0 * k).sqrt();
            Ok(periods.iter().map(|t| ordinates[usize::from((t / long - 1.0).abs() > 1e-12)]).collect())
        })
        .unwrap();
        let base = [(1.0 + 2.0 / root) * ordinates[0], (1.0 - 2.0 / root) * ordinates[1]];
        let roof = [(0.5 + 1.5 / root) * ordinates[0], (0.5 - 1.5 / root) * ordinates[1]];
        for (found, modal) in found.iter().zip([base, roof]) {
            let expected = (modal[0] * modal[0] + modal[1] * modal[1]).sqrt();
            assert!((found / expected - 1.0).abs() < 1e-13, "{found} {expected}");
        }
    }

    /// A step of 1 m/s2 has the pseudo-acceleration 1 + exp(-zeta pi / sqrt(1 - zeta^2)) at every short period.
    #[test]
    fn spectrum_is_that_of_the_suite() {
        let step = Motion::new(vec![1.0; 400], 0.01, None).unwrap();
        let thrice = Motion::new(vec![3.0; 400], 0.01, None).unwrap();
        let found = mean_spectrum(&[step, thrice], &[0.5, 1.0]).unwrap();
        let expected = 2.0 * (1.0 + (-DAMPING * std::f64::consts::PI / (1.0 - DAMPING * DAMPING).sqrt()).exp());
        assert!(found.iter().all(|found| (found / expected - 1.0).abs() < 1e-12), "{found:?} {expected}");
    }

    #[test]
    fn what_is_no_design_is_refused() {
        let step = Motion::new(vec![1.0; 400], 0.01, None).unwrap();
        let one = [1.0, 1.2, 0.05, 0.0, 0.3, 1.0, 0.2, 0.2, 1.0, 1.0, 3.0, 2.0, 0.05, 0.0];
        let refused = |counted: f64, suite: &[Motion]| {
            elastic_shear_over_weight(&Case::new(&one).unwrap(), counted, suite).unwrap_err().to_string()
        };
        assert_eq!(refused(-1.0, &[step]), "counted of case must be zero or positive; got -1");
        let none = "motions of case must be at least one, for the spectrum of the design; got none";
        assert_eq!(refused(0.5, &[]), none);
    }
}
