//! A rack: a chain of levels that stands on a floor or on the ground.

use std::f64::consts::PI;

use crate::error::{Domain, Error, Result};
use crate::scene::check::{Nth, check, check_length};
use crate::scene::damping::{Damping, StoreyDamping, natural_frequencies};
use crate::scene::general::goods::Goods;
use crate::scene::storey::Storey;

/// A rack with goods on its levels. Its drifts are relative to what it stands on.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Rack {
    /// Floor of the building that it stands on, from 1; 0: the ground.
    pub floor: usize,
    /// Mass of each level, from the lowest up: of the frame, and of goods that are fixed to it (kg).
    pub mass: Vec<f64>,
    /// Spring of each level.
    pub levels: Vec<Storey>,
    /// Damping ratio in every mode of the rack alone, fixed at its base, with frame and all goods attached.
    pub damping_ratio: f64,
    /// P/h of each level (N/m); empty: no P-Delta.
    #[cfg_attr(feature = "serde", serde(default))]
    pub geometric_stiffness: Vec<f64>,
    /// Goods that may slide; the floor of a block is the level, from 1.
    #[cfg_attr(feature = "serde", serde(default))]
    pub goods: Vec<Goods>,
}

impl Rack {
    /// Usual damping ratio of a rack.
    pub const DEFAULT_DAMPING_RATIO: f64 = 0.03;

    /// Stiffness of equally stiff levels (N/m) that gives the first period (s) to levels of these masses (kg), the goods
    /// included.
    ///
    /// # Errors
    /// [`Error::Invalid`] when there is no level, or a number is not positive.
    pub fn uniform_stiffness(mass: &[f64], period: f64) -> Result<f64> {
        check_levels(mass.len(), "rack")?;
        for (i, &m) in mass.iter().enumerate() {
            check(m.is_finite() && m > 0.0, "mass", format_args!("{} of the rack", Nth("level", i)), POSITIVE, m)?;
        }
        check(period.is_finite() && period > 0.0, "period", "rack", POSITIVE, period)?;
        let unit = natural_frequencies(mass, &vec![1.0; mass.len()]);
        let root = 2.0 * PI / (period * unit[0]);
        Ok(root * root)
    }

    /// Mass of each level with all goods attached (kg).
    pub fn mass_with_goods(&self) -> Vec<f64> {
        let mut mass = self.mass.clone();
        for goods in &self.goods {
            if let Some(of_level) = goods.block.floor.checked_sub(1).and_then(|level| mass.get_mut(level)) {
                *of_level += goods.block.mass;
            }
        }
        mass
    }

    /// Damping between the drift rates of the levels and their forces.
    pub(crate) fn damping(&self) -> Result<StoreyDamping> {
        let stiffness: Vec<f64> = self.levels.iter().map(|level| level.stiffness).collect();
        StoreyDamping::new(&self.mass_with_goods(), &stiffness, &Damping::Modal { ratio: self.damping_ratio })
    }

    pub(super) fn validate(&self, name: &str, floors: usize) -> Result<()> {
        let n = self.mass.len();
        check_levels(n, name)?;
        if self.floor > floors {
            let requirement = format!("0, the ground, or a floor of the building, which has {floors}");
            return Err(Error::invalid(Domain::Scene, "floor", name, requirement, self.floor));
        }
        check_length("stiffness", name, n, "level", self.levels.len())?;
        for (i, (&m, level)) in self.mass.iter().zip(&self.levels).enumerate() {
            let owner = format!("{} of {name}", Nth("level", i));
            check(m.is_finite() && m > 0.0, "mass", &owner, POSITIVE, m)?;
            level.validate(owner.as_str())?;
        }
        let ratio = self.damping_ratio;
        check(ratio.is_finite() && ratio >= 0.0, "damping ratio", name, "zero or positive", ratio)?;
        if !self.geometric_stiffness.is_empty() {
            check_length("geometric_stiffness", name, n, "level", self.geometric_stiffness.len())?;
        }
        for (i, (&value, level)) in self.geometric_stiffness.iter().zip(&self.levels).enumerate() {
            let owner = format!("{} of {name}", Nth("level", i));
            let requirement = format_args!("zero or positive and below its stiffness {} N/m", level.stiffness);
            check(value >= 0.0 && value < level.stiffness, "geometric_stiffness", owner, requirement, value)?;
        }
        for (j, goods) in self.goods.iter().enumerate() {
            let owner = format!("{} of {name}", Nth("block", j));
            if goods.block.floor == 0 {
                return Err(Error::invalid(Domain::Scene, "level", owner, format!("between 1 and {n}"), 0));
            }
            goods.validate(owner.as_str(), n)?;
        }
        Ok(())
    }
}

const POSITIVE: &str = "a positive number";

fn check_levels(count: usize, name: &str) -> Result<()> {
    if count > 0 { Ok(()) } else { Err(Error::invalid(Domain::Scene, "levels", name, "at least 1", count)) }
}
