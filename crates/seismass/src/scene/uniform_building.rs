//! A building of equal floors and storeys, described by its first period.

use crate::error::Result;
use crate::scene::building::{Building, check_storeys};
use crate::scene::check::{check, check_length};
use crate::scene::damping::Damping;
use crate::scene::storey::Storey;
use crate::units::STANDARD_GRAVITY;

/// What a [`Building`] of equal floor masses and storey stiffnesses is made of, by name.
///
/// `storeys`, `period` and `mass` must be given: their defaults are refused. The storeys are elastic and damped by 5 % in
/// every mode unless something else is said.
///
/// ```
/// use seismass::UniformBuilding;
///
/// # fn main() -> seismass::Result<()> {
/// let frame = UniformBuilding { storeys: 3, period: 0.6, mass: 1e5, ..Default::default() };
/// assert!((frame.build()?.periods()[0] - 0.6).abs() < 1e-14);
/// let yielding = UniformBuilding { yield_shear_over_weight: vec![0.24, 0.20, 0.12], ..frame }.build()?;
/// assert_eq!(yielding.storeys()[2].yield_shear, 0.12 * (3.0 * 1e5) * seismass::STANDARD_GRAVITY);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct UniformBuilding {
    /// Number of storeys.
    pub storeys: usize,
    /// First period of the elastic building (s).
    pub period: f64,
    /// Mass of each floor (kg).
    pub mass: f64,
    /// First yield shear of each storey over the weight of all floors, from the lowest storey up; empty: elastic. Other
    /// numbers of the springs are those of [`Storey::yielding`].
    pub yield_shear_over_weight: Vec<f64>,
    /// Damping; default: 5 % in every mode.
    pub damping: Damping,
}

impl Default for UniformBuilding {
    /// Nothing but damping: no storeys, and a period and a mass that are not numbers.
    fn default() -> Self {
        let (storeys, period, mass) = (0, f64::NAN, f64::NAN);
        Self { storeys, period, mass, yield_shear_over_weight: Vec::new(), damping: Damping::default() }
    }
}

impl UniformBuilding {
    /// Stiffness of each storey (N/m), from w_1 = 2 sqrt(k/m) sin(pi / (2 (2 n + 1))).
    ///
    /// # Errors
    /// [`Error::Invalid`](crate::Error::Invalid) when storeys, period or mass are out of their range.
    pub fn stiffness(&self) -> Result<f64> {
        let &Self { storeys, period, mass, .. } = self;
        check(storeys >= 1, "storeys", "building", "at least 1", storeys as f64)?;
        check_storeys(storeys)?;
        check(period.is_finite() && period > 0.0, "period", "building", "a positive number", period)?;
        check(mass.is_finite() && mass > 0.0, "mass", "building", "a positive number", mass)?;
        let angle = std::f64::consts::PI / (2.0 * (2 * storeys + 1) as f64);
        let root = std::f64::consts::PI / (period * libm::sin(angle));
        Ok(mass * root * root)
    }

    /// The building.
    ///
    /// # Errors
    /// [`Error::Invalid`](crate::Error::Invalid) when a number is out of its range, or there are not as many yield shears
    /// as storeys.
    pub fn build(&self) -> Result<Building> {
        let stiffness = self.stiffness()?;
        let (n, over_weight) = (self.storeys, &self.yield_shear_over_weight);
        let storeys = if over_weight.is_empty() {
            vec![Storey::elastic(stiffness); n]
        } else {
            check_length("yield_shear_over_weight", "building", n, "storey", over_weight.len())?;
            let weight = STANDARD_GRAVITY * (n as f64 * self.mass);
            over_weight.iter().map(|share| Storey::yielding(stiffness, share * weight)).collect()
        };
        Building::new(vec![self.mass; n], storeys, self.damping.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame() -> UniformBuilding {
        UniformBuilding { storeys: 2, period: 0.4, mass: 1000.0, ..Default::default() }
    }

    fn refused(building: &UniformBuilding) -> String {
        building.build().unwrap_err().to_string()
    }

    #[test]
    fn storeys_period_and_mass_must_be_given() {
        let nothing = UniformBuilding::default();
        assert_eq!(refused(&nothing), "storeys of building must be at least 1; got 0");
        let no_period = UniformBuilding { period: nothing.period, ..frame() };
        assert_eq!(refused(&no_period), "period of building must be a positive number; got NaN");
        let no_mass = UniformBuilding { mass: nothing.mass, ..frame() };
        assert_eq!(refused(&no_mass), "mass of building must be a positive number; got NaN");
    }

    #[test]
    fn there_is_one_yield_shear_per_storey() {
        let one = UniformBuilding { yield_shear_over_weight: vec![0.2], ..frame() };
        let message = "yield_shear_over_weight of building must be a list of 2 values, one per storey; got 1 values";
        assert_eq!(refused(&one), message);
    }

    /// The weight is that of all floors, whatever the storey carries: W = 2 m g.
    #[test]
    fn yield_shears_are_shares_of_the_whole_weight() {
        let building = UniformBuilding { yield_shear_over_weight: vec![0.3, 0.1], ..frame() }.build().unwrap();
        let weight = 2.0 * 1000.0 * STANDARD_GRAVITY;
        for (storey, share) in building.storeys().iter().zip([0.3, 0.1]) {
            assert!((storey.yield_shear / (share * weight) - 1.0).abs() < 1e-15, "two roundings");
        }
    }
}
