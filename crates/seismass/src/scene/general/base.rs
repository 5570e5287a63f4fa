//! A sliding base: a slab that carries the building and slides on the ground.

use crate::error::Result;
use crate::scene::block::check_friction;
use crate::scene::check::check;

/// A rigid slab between the ground and all that stands in the scene: building, racks and goods. It sticks to the ground or
/// slides by Coulomb friction, under the weight of everything; a spherical sliding surface brings it back.
///
/// Floor 0 of the scene is the slab: storey 1, and goods and racks on floor 0, stand on it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct SlidingBase {
    /// Mass of the slab (kg).
    pub mass: f64,
    /// Static friction coefficient.
    pub mu_s: f64,
    /// Kinetic friction coefficient, at most the static one.
    pub mu_k: f64,
    /// Effective radius of a pendulum (m): the contact force over it is the restoring stiffness. Infinite: a flat slider.
    #[cfg_attr(feature = "serde", serde(with = "crate::scene::form"))]
    pub radius: f64,
}

impl SlidingBase {
    /// A flat slider with equal friction coefficients.
    pub fn new(mass: f64, mu: f64) -> Self {
        Self { mass, mu_s: mu, mu_k: mu, radius: f64::INFINITY }
    }

    pub(super) fn validate(&self) -> Result<()> {
        let &Self { mass, mu_s, mu_k, radius } = self;
        check(mass.is_finite() && mass > 0.0, "mass", "base", "a positive number", mass)?;
        check_friction(mu_s, mu_k, "base")?;
        check(radius > 0.0, "radius", "base", "a positive number (infinite: flat)", radius)
    }
}
