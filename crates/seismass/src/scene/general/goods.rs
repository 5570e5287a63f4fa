//! A rigid block with the stops that limit its slip.

use std::fmt::Display;

use crate::error::Result;
use crate::scene::block::Block;
use crate::scene::check::check;

/// Stops on either side of a block, fixed to what carries it: an elastic spring and a viscous damper in parallel, which act
/// while the block is beyond its clearance and their force is not negative.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Stops {
    /// Slip at which the stop on the negative and on the positive side touches, from the block's first place (m); not
    /// negative, infinite: none on that side.
    #[cfg_attr(feature = "serde", serde(with = "crate::scene::form"))]
    pub clearance: [f64; 2],
    /// Stiffness of the contact (N/m).
    pub stiffness: f64,
    /// Viscous damper of the contact (N s/m).
    pub damping: f64,
}

impl Stops {
    /// Elastic stops with the same clearance (m) on both sides and a contact stiffness (N/m).
    pub fn new(clearance: f64, stiffness: f64) -> Self {
        Self { clearance: [clearance; 2], stiffness, damping: 0.0 }
    }

    fn validate(&self, owner: impl Display) -> Result<()> {
        let &Self { clearance, stiffness, damping } = self;
        let owner = format!("stops of {owner}");
        for (value, side) in clearance.into_iter().zip(["towards minus", "towards plus"]) {
            check(value >= 0.0, &format!("clearance {side}"), &owner, "zero or positive (infinite: none)", value)?;
        }
        check(stiffness.is_finite() && stiffness > 0.0, "stiffness", &owner, "a positive number", stiffness)?;
        check(damping.is_finite() && damping >= 0.0, "damping", &owner, "zero or positive", damping)
    }
}

/// A rigid block that sticks or slides by Coulomb friction, between stops or without.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct Goods {
    /// The block. Its floor is that of the building (0: the ground) or, in a rack, the rack's level from 1.
    pub block: Block,
    /// Its stops.
    pub stops: Option<Stops>,
}

impl Goods {
    pub(crate) fn validate(&self, owner: impl Display + Copy, floors: usize) -> Result<()> {
        self.block.validate(owner, floors)?;
        self.stops.as_ref().map_or(Ok(()), |stops| stops.validate(owner))
    }
}

impl From<Block> for Goods {
    /// A block without stops.
    fn from(block: Block) -> Self {
        Self { block, stops: None }
    }
}
