//! A shear building: floor masses, storey springs, damping, P-Delta.

use nalgebra::DMatrix;

use crate::error::{Domain, Error, Result};
use crate::scene::check::{Nth, check, check_length};
use crate::scene::damping::{Damping, StoreyDamping, natural_frequencies};
use crate::scene::storey::Storey;

/// Most storeys of a building: a full damping matrix takes 8 MB. Without the feature `tall-buildings`: 4.
#[cfg(feature = "tall-buildings")]
pub const MAX_STOREYS: usize = 1000;

/// Most storeys of a building: one vector holds them. With the feature `tall-buildings`: 1000.
#[cfg(not(feature = "tall-buildings"))]
pub const MAX_STOREYS: usize = 4;

/// Where the P-Delta effect comes from.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
pub enum GravityEffect {
    /// No P-Delta.
    #[default]
    None,
    /// P/h of each storey (N/m), finished.
    GeometricStiffness(Vec<f64>),
    /// P of a storey is the gravity load of all floors above it, the weight of their blocks included.
    Loads {
        /// Height of each storey (m).
        heights: Vec<f64>,
        /// Gravity load of each floor without blocks (N).
        floor_loads: Vec<f64>,
    },
}

impl GravityEffect {
    /// The same, if it suits a building of so many storeys.
    ///
    /// # Errors
    /// [`Error::Invalid`] when a list has the wrong length or a number is out of its range.
    pub(super) fn checked(self, storeys: usize) -> Result<Self> {
        let n = storeys;
        match &self {
            Self::None => {}
            Self::GeometricStiffness(values) => {
                check_length("geometric_stiffness", "building", n, "storey", values.len())?;
                for (i, &value) in values.iter().enumerate() {
                    let owner = Nth("storey", i);
                    check(value.is_finite() && value >= 0.0, "geometric_stiffness", owner, "zero or positive", value)?;
                }
            }
            Self::Loads { heights, floor_loads } => {
                check_length("heights", "building", n, "storey", heights.len())?;
                check_length("gravity_load", "building", n, "floor", floor_loads.len())?;
                for (i, (&height, &load)) in heights.iter().zip(floor_loads).enumerate() {
                    let (storey, floor) = (Nth("storey", i), Nth("floor", i));
                    check(height.is_finite() && height > 0.0, "heights", storey, "a positive number", height)?;
                    check(load.is_finite() && load >= 0.0, "gravity_load", floor, "zero or positive", load)?;
                }
            }
        }
        Ok(self)
    }
}

/// A shear building: lumped floor masses, storey springs, damping.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "BuildingForm"))]
pub struct Building {
    mass: Vec<f64>,
    storeys: Vec<Storey>,
    damping: Damping,
    gravity: GravityEffect,
    #[cfg_attr(feature = "serde", serde(skip))]
    storey_damping: StoreyDamping,
}

/// What is read of one with the feature `serde`: the fields of the same names.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct BuildingForm {
    mass: Vec<f64>,
    storeys: Vec<Storey>,
    #[serde(default)]
    damping: Damping,
    #[serde(default)]
    gravity: GravityEffect,
}

#[cfg(feature = "serde")]
impl TryFrom<BuildingForm> for Building {
    type Error = Error;

    fn try_from(form: BuildingForm) -> Result<Self> {
        Self::new(form.mass, form.storeys, form.damping)?.with_gravity(form.gravity)
    }
}

impl Building {
    /// A building of `mass.len()` floors.
    ///
    /// # Errors
    /// [`Error::Invalid`] when a list has the wrong length or a number is out of its range.
    pub fn new(mass: Vec<f64>, storeys: Vec<Storey>, damping: Damping) -> Result<Self> {
        if mass.is_empty() {
            return Err(Error::invalid(Domain::Scene, "mass", "building", "a list of at least one floor mass", "none"));
        }
        check_storeys(mass.len())?;
        check_length("stiffness", "building", mass.len(), "storey", storeys.len())?;
        for (i, (&m, storey)) in mass.iter().zip(&storeys).enumerate() {
            check(m.is_finite() && m > 0.0, "mass", Nth("floor", i), "a positive number", m)?;
            storey.validate(Nth("storey", i))?;
        }
        let stiffness: Vec<f64> = storeys.iter().map(|s| s.stiffness).collect();
        let storey_damping = StoreyDamping::new(&mass, &stiffness, &damping)?;
        Ok(Self { mass, storeys, damping, gravity: GravityEffect::None, storey_damping })
    }

    /// The same building with other springs; its damping is made again from their initial stiffness.
    ///
    /// # Errors
    /// [`Error::Invalid`] as for [`Building::new`].
    pub fn with_storeys(self, storeys: Vec<Storey>) -> Result<Self> {
        let gravity = self.gravity;
        Self::new(self.mass, storeys, self.damping)?.with_gravity(gravity)
    }

    /// The same building with P-Delta.
    ///
    /// # Errors
    /// [`Error::Invalid`] when a list has the wrong length or a number is out of its range.
    pub fn with_gravity(mut self, gravity: GravityEffect) -> Result<Self> {
        self.gravity = gravity.checked(self.mass.len())?;
        Ok(self)
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

    /// P-Delta as given.
    pub fn gravity(&self) -> &GravityEffect {
        &self.gravity
    }

    /// How damping was given.
    pub fn damping(&self) -> &Damping {
        &self.damping
    }

    /// The damping operator in storey coordinates.
    pub fn storey_damping(&self) -> &StoreyDamping {
        &self.storey_damping
    }

    /// Damping matrix C in floor coordinates (N s/m).
    pub fn damping_matrix(&self) -> DMatrix<f64> {
        self.storey_damping.floor_matrix(&self.mass, &self.stiffness())
    }

    /// No circular frequency of the bare building, elastic, is above this (rad/s).
    pub fn frequency_bound(&self) -> f64 {
        let stiffest = self.storeys.iter().map(Storey::largest_stiffness).fold(0.0, f64::max);
        let lightest = self.mass.iter().copied().fold(f64::INFINITY, f64::min);
        2.0 * (stiffest / lightest).sqrt()
    }

    /// Natural periods of the bare building (s), longest first, without P-Delta.
    pub fn periods(&self) -> Vec<f64> {
        let frequencies = natural_frequencies(&self.mass, &self.stiffness());
        frequencies.iter().map(|w| 2.0 * std::f64::consts::PI / w).collect()
    }

    fn stiffness(&self) -> Vec<f64> {
        self.storeys.iter().map(|s| s.stiffness).collect()
    }
}

pub(crate) fn check_storeys(count: usize) -> Result<()> {
    check(count <= MAX_STOREYS, "storeys", "building", format_args!("at most {MAX_STOREYS}"), count as f64)
}
