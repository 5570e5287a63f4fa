//! A building of the general engine: storey springs beside an elastic matrix over the floors.

use nalgebra::{Cholesky, DMatrix};

use crate::error::{Domain, Error, Result};
use crate::scene::building::{Building, GravityEffect, MAX_STOREYS};
use crate::scene::check::{Nth, check, check_length};
use crate::scene::damping::{Damping, StoreyDamping};
use crate::scene::general::matrix::{Modes, between_storeys, checked};
use crate::scene::storey::Storey;

/// Floor masses, storey springs, and an elastic matrix over the floors that stands for walls, braces over several storeys or
/// a condensed model.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "GeneralBuildingForm"))]
pub struct GeneralBuilding {
    mass: Vec<f64>,
    storeys: Vec<Storey>,
    #[cfg_attr(feature = "serde", serde(rename = "stiffness_matrix", with = "crate::scene::form"))]
    matrix: Option<DMatrix<f64>>,
    gravity: GravityEffect,
    damping: Damping,
    /// Symmetric matrix from drift rates to storey damping forces (N s/m).
    #[cfg_attr(feature = "serde", serde(skip))]
    storey_damping: DMatrix<f64>,
    /// The elastic matrix between storey drifts (N/m).
    #[cfg_attr(feature = "serde", serde(skip))]
    elastic: Option<DMatrix<f64>>,
}

/// What is read of one with the feature `serde`: the fields of the same names.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct GeneralBuildingForm {
    mass: Vec<f64>,
    storeys: Vec<Storey>,
    #[serde(default, with = "crate::scene::form")]
    stiffness_matrix: Option<DMatrix<f64>>,
    #[serde(default)]
    gravity: GravityEffect,
    #[serde(default)]
    damping: Damping,
}

#[cfg(feature = "serde")]
impl TryFrom<GeneralBuildingForm> for GeneralBuilding {
    type Error = Error;

    fn try_from(form: GeneralBuildingForm) -> Result<Self> {
        Self::new(form.mass, form.storeys, form.stiffness_matrix, &form.damping, form.gravity)
    }
}

impl GeneralBuilding {
    /// A building; with a matrix (N/m, floors x floors, symmetric, positive semi-definite), storeys may have a spring of
    /// stiffness 0. Damping is formed with springs and matrix together; gravity is as of [`Building::with_gravity`].
    ///
    /// # Errors
    /// [`Error::Invalid`] when a list has the wrong length or a number is out of its range.
    pub fn new(
        mass: Vec<f64>,
        storeys: Vec<Storey>,
        matrix: Option<DMatrix<f64>>,
        damping: &Damping,
        gravity: GravityEffect,
    ) -> Result<Self> {
        let n = mass.len();
        let Some(matrix) = matrix else {
            let building = Building::new(mass, storeys, damping.clone())?.with_gravity(gravity)?;
            return Ok(Self::from(&building));
        };
        check(n >= 1, "mass", "building", "a list of at least one floor mass", n as f64)?;
        check(n <= MAX_STOREYS, "storeys", "building", format_args!("at most {MAX_STOREYS}"), n as f64)?;
        check_length("stiffness", "building", n, "storey", storeys.len())?;
        for (i, (&m, storey)) in mass.iter().zip(&storeys).enumerate() {
            check(m.is_finite() && m > 0.0, "mass", Nth("floor", i), "a positive number", m)?;
            if storey.stiffness == 0.0 {
                let vy = storey.yield_shear;
                check(vy == f64::INFINITY, "yield_shear", Nth("storey", i), "absent where the stiffness is 0", vy)?;
            } else {
                storey.validate(Nth("storey", i))?;
            }
        }
        let gravity = gravity.checked(n)?;
        let matrix = checked(&matrix, n)?;
        let elastic = between_storeys(&matrix);
        let storey_damping = damping_between_storeys(&mass, &storeys, &matrix, damping)?;
        let (damping, matrix, elastic) = (damping.clone(), Some(matrix), Some(elastic));
        Ok(Self { mass, storeys, matrix, gravity, damping, storey_damping, elastic })
    }

    /// Number of storeys.
    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether the building has no storeys: never.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Floor masses (kg).
    pub fn mass(&self) -> &[f64] {
        &self.mass
    }

    /// Storey springs.
    pub fn storeys(&self) -> &[Storey] {
        &self.storeys
    }

    /// The elastic matrix over the floors (N/m).
    pub fn stiffness_matrix(&self) -> Option<&DMatrix<f64>> {
        self.matrix.as_ref()
    }

    /// P-Delta as given.
    pub fn gravity(&self) -> &GravityEffect {
        &self.gravity
    }

    /// How damping was given.
    pub fn damping(&self) -> &Damping {
        &self.damping
    }

    /// Symmetric matrix D from drift rates to storey damping forces (N s/m).
    pub fn storey_damping(&self) -> &DMatrix<f64> {
        &self.storey_damping
    }

    /// Damping matrix C in floor coordinates (N s/m).
    pub fn damping_matrix(&self) -> DMatrix<f64> {
        let n = self.len();
        let at = |i: usize, j: usize| if i < n && j < n { self.storey_damping[(i, j)] } else { 0.0 };
        DMatrix::from_fn(n, n, |i, j| at(i, j) - at(i + 1, j) - at(i, j + 1) + at(i + 1, j + 1))
    }

    /// The elastic matrix between storey drifts (N/m).
    pub(crate) fn elastic(&self) -> Option<&DMatrix<f64>> {
        self.elastic.as_ref()
    }

    /// Natural periods of the bare building (s), longest first, without P-Delta.
    pub fn periods(&self) -> Vec<f64> {
        let none = DMatrix::zeros(self.len(), self.len());
        let stiffness: Vec<f64> = self.storeys.iter().map(|storey| storey.stiffness).collect();
        let mut frequencies = Modes::new(&self.mass, &stiffness, self.matrix.as_ref().unwrap_or(&none)).frequencies;
        frequencies.sort_by(f64::total_cmp);
        frequencies.iter().map(|w| 2.0 * std::f64::consts::PI / w).collect()
    }

    /// Whether the building keeps a positive stiffness against P/h of its storeys (N/m).
    ///
    /// # Errors
    /// [`Error::Invalid`] where it does not.
    pub(super) fn check_geometric(&self, geometric: &[f64]) -> Result<()> {
        let Some(elastic) = &self.elastic else {
            for (i, (&value, storey)) in geometric.iter().zip(&self.storeys).enumerate() {
                let requirement = format_args!("below its stiffness {} N/m", storey.stiffness);
                let of_storey = value < storey.stiffness;
                check(of_storey, "geometric stiffness P/h", Nth("storey", i), requirement, value)?;
            }
            return Ok(());
        };
        let mut total = elastic.clone();
        for (i, (&value, storey)) in geometric.iter().zip(&self.storeys).enumerate() {
            total[(i, i)] += storey.stiffness - value;
        }
        let requirement = "positive definite with the storeys' springs, less P/h";
        match Cholesky::new(total) {
            Some(_) => Ok(()),
            None => Err(Error::invalid(Domain::Scene, "stiffness_matrix", "building", requirement, "one that is not")),
        }
    }
}

impl From<&Building> for GeneralBuilding {
    /// A shear building.
    fn from(building: &Building) -> Self {
        let n = building.len();
        let storey_damping = match building.storey_damping() {
            StoreyDamping::None => DMatrix::zeros(n, n),
            StoreyDamping::Dense(d) => d.clone(),
            StoreyDamping::Rayleigh { .. } => between_storeys(&building.damping_matrix()),
        };
        Self {
            mass: building.mass().to_vec(),
            storeys: building.storeys().to_vec(),
            matrix: None,
            gravity: building.gravity().clone(),
            damping: building.damping().clone(),
            storey_damping,
            elastic: None,
        }
    }
}

/// Damping between drift rates and storey forces.
fn damping_between_storeys(
    mass: &[f64],
    storeys: &[Storey],
    matrix: &DMatrix<f64>,
    damping: &Damping,
) -> Result<DMatrix<f64>> {
    let n = mass.len();
    let stiffness: Vec<f64> = storeys.iter().map(|storey| storey.stiffness).collect();
    let refuse = |parameter: &str, requirement: String, value: String| {
        Err(Error::invalid(Domain::Scene, parameter, "building", requirement, value))
    };
    match damping {
        Damping::Modal { ratio } | Damping::Rayleigh { ratio, .. } if !(ratio.is_finite() && *ratio >= 0.0) => {
            refuse("damping ratio", "zero or positive".into(), ratio.to_string())
        }
        Damping::Modal { ratio } => Ok(Modes::new(mass, &stiffness, matrix).damping(*ratio)),
        &Damping::Rayleigh { ratio, modes: [first, second] } => {
            if first == second || [first, second].iter().any(|&mode| mode == 0 || mode > n) {
                let requirement = format!("two different modes from 1 to {n}");
                return refuse("damping modes", requirement, format!("{first} and {second}"));
            }
            let mut w = Modes::new(mass, &stiffness, matrix).frequencies;
            w.sort_by(f64::total_cmp);
            let (wi, wj) = (w[first - 1], w[second - 1]);
            let of_stiffness = 2.0 * ratio / (wi + wj);
            let mass = DMatrix::from_fn(n, n, |i, j| if i == j { of_stiffness * wi * wj * mass[i] } else { 0.0 });
            let mut total = between_storeys(&(mass + matrix * of_stiffness));
            for i in 0..n {
                total[(i, i)] += of_stiffness * stiffness[i];
            }
            Ok(total)
        }
        Damping::Matrix(_) => match StoreyDamping::new(mass, &vec![1.0; n], damping)? {
            StoreyDamping::Dense(d) => Ok(d),
            _ => Ok(DMatrix::zeros(n, n)),
        },
    }
}
