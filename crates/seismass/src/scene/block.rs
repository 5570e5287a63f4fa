//! A rigid block and its friction.

use std::fmt::Display;

use crate::error::{Domain, Error, Result};
use crate::scene::check::check;

/// Most changes of a block's friction coefficients over its slip path.
pub const MAX_WEAR_STAGES: usize = 100;

/// Friction coefficients of a block from a slip path on.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Wear {
    /// Path slipped in contact (m) from which they hold.
    pub path: f64,
    /// Static friction coefficient.
    pub mu_s: f64,
    /// Kinetic friction coefficient, at most the static one.
    pub mu_k: f64,
}

/// A rigid block that sticks to its floor or slides on it by Coulomb friction.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Block {
    /// Floor that carries it, counted from 1; 0 is the ground slab.
    pub floor: usize,
    /// Mass (kg).
    pub mass: f64,
    /// Static friction coefficient.
    pub mu_s: f64,
    /// Kinetic friction coefficient, at most the static one.
    pub mu_k: f64,
    /// Initial velocity relative to the ground (m/s); default: its floor's.
    pub velocity: Option<f64>,
    /// Coefficients that follow those above, by the path slipped; paths increase. Empty: they stay as they are.
    #[cfg_attr(feature = "serde", serde(default))]
    pub wear: Vec<Wear>,
}

impl Block {
    /// A block with equal friction coefficients, at rest on its floor.
    pub fn new(floor: usize, mass: f64, mu: f64) -> Self {
        Self { floor, mass, mu_s: mu, mu_k: mu, velocity: None, wear: Vec::new() }
    }

    pub(crate) fn validate(&self, owner: impl Display + Copy, floors: usize) -> Result<()> {
        let &Self { floor, mass, mu_s, mu_k, velocity, ref wear } = self;
        if floor > floors {
            let requirement = match floors {
                0 => "0, the ground, where there is no building".to_string(),
                _ => format!("a floor of the building, 1 to {floors}, or 0 for the ground"),
            };
            return Err(Error::invalid(Domain::Scene, "floor", owner.to_string(), requirement, floor));
        }
        check(mass.is_finite() && mass > 0.0, "mass", owner, "a positive number", mass)?;
        check_friction(mu_s, mu_k, owner)?;
        velocity.map_or(Ok(()), |v| check(v.is_finite(), "velocity", owner, "a finite number", v))?;
        if wear.is_empty() { Ok(()) } else { check_wear(wear, &owner) }
    }
}

pub(super) fn check_friction(mu_s: f64, mu_k: f64, owner: impl Display + Copy) -> Result<()> {
    check(mu_s.is_finite() && mu_s >= 0.0, "mu_s", owner, "finite and not negative", mu_s)?;
    check(mu_k >= 0.0, "mu_k", owner, "finite and not negative", mu_k)?;
    check(mu_k <= mu_s, "mu_k", owner, format_args!("at most mu_s = {mu_s}"), mu_k)
}

fn check_wear(wear: &[Wear], block: &dyn Display) -> Result<()> {
    let requirement = format_args!("at most {MAX_WEAR_STAGES}");
    check(wear.len() <= MAX_WEAR_STAGES, "number of wear stages", block, requirement, wear.len() as f64)?;
    let mut before = 0.0;
    for (stage, &Wear { path, mu_s, mu_k }) in wear.iter().enumerate() {
        let owner = format!("wear stage {} of {block}", stage + 1);
        let requirement = format_args!("finite and above {before} m");
        check(path.is_finite() && path > before, "path", &owner, requirement, path)?;
        check_friction(mu_s, mu_k, &owner)?;
        before = path;
    }
    Ok(())
}
