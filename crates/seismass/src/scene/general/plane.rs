//! Scenes and motions in two horizontal directions.

use std::sync::Arc;

use crate::error::{Domain, Error, Result};
use crate::scene::check::{Nth, check, check_length};
use crate::scene::general::structure::GeneralScene;
use crate::scene::motion::Motion;

/// A structure in two horizontal directions, x and y: the same masses and goods, with springs, damping, elastic matrices,
/// stops and initial states of each direction. Friction is of the circle.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "PlaneSceneForm"))]
pub struct PlaneScene {
    directions: [GeneralScene; 2],
}

/// What is read of one with the feature `serde`: the fields of the same names.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct PlaneSceneForm {
    directions: [GeneralScene; 2],
}

#[cfg(feature = "serde")]
impl TryFrom<PlaneSceneForm> for PlaneScene {
    type Error = Error;

    fn try_from(PlaneSceneForm { directions: [x, y] }: PlaneSceneForm) -> Result<Self> {
        Self::new(x, y)
    }
}

impl PlaneScene {
    /// A scene from what it is in x and in y; stops of a block in y stand across y.
    ///
    /// # Errors
    /// [`Error::Invalid`] when masses, racks or goods of the two differ, or there is a sliding base.
    pub fn new(x: GeneralScene, y: GeneralScene) -> Result<Self> {
        if x.base().is_some() || y.base().is_some() {
            let requirement = "absent where there are two directions";
            return Err(Error::invalid(Domain::Scene, "base", "scene", requirement, "one"));
        }
        let masses = |scene: &GeneralScene| scene.building().map_or(Vec::new(), |b| b.mass().to_vec());
        same_masses(&masses(&x), &masses(&y), "scene in y", "floor")?;
        check_length("racks", "scene in y", x.racks().len(), "rack", y.racks().len())?;
        for (r, (one, other)) in x.racks().iter().zip(y.racks()).enumerate() {
            let owner = format!("{} in y", Nth("rack", r));
            if one.floor != other.floor {
                return Err(Error::invalid(
                    Domain::Scene,
                    "floor",
                    owner,
                    format!("{}, as in x", one.floor),
                    other.floor,
                ));
            }
            same_masses(&one.mass, &other.mass, &owner, "level")?;
            check_length("blocks", &owner, one.goods.len(), "block", other.goods.len())?;
        }
        check_length("blocks", "scene in y", x.all_goods().count(), "block", y.all_goods().count())?;
        for (j, (one, other)) in x.all_goods().zip(y.all_goods()).enumerate() {
            let (one, other) = (&one.block, &other.block);
            let of = |block: &crate::scene::block::Block| (block.floor as f64, block.mass, block.mu_s, block.mu_k);
            let (of_one, of_other) = (of(one), of(other));
            for (parameter, expected, value) in [
                ("floor", of_one.0, of_other.0),
                ("mass", of_one.1, of_other.1),
                ("mu_s", of_one.2, of_other.2),
                ("mu_k", of_one.3, of_other.3),
            ] {
                let owner = format!("{} in y", Nth("block", j));
                check(value == expected, parameter, owner, format_args!("{expected}, as in x"), value)?;
            }
            if one.wear != other.wear {
                let owner = format!("{} in y", Nth("block", j));
                return Err(Error::invalid(Domain::Scene, "wear", owner, "that of x", "another"));
            }
        }
        Ok(Self { directions: [x, y] })
    }

    /// The scene in x and in y.
    pub fn directions(&self) -> &[GeneralScene; 2] {
        &self.directions
    }
}

fn same_masses(expected: &[f64], masses: &[f64], owner: &str, element: &str) -> Result<()> {
    check_length("mass", owner, expected.len(), element, masses.len())?;
    for (&expected, &mass) in expected.iter().zip(masses) {
        check(mass == expected, "mass", owner, format_args!("{expected} kg, as in x"), mass)?;
    }
    Ok(())
}

/// Ground acceleration in two horizontal directions on the same samples, perhaps with a vertical one.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneMotion {
    directions: [Motion; 2],
}

impl PlaneMotion {
    /// A motion in x, which may have a vertical component, and its samples in y (m/s2).
    ///
    /// # Errors
    /// [`Error::Invalid`] when lengths differ or a sample is not finite.
    pub fn new(x: Motion, y: impl Into<Arc<[f64]>>) -> Result<Self> {
        let y = Motion::new(y, x.dt(), x.vertical().map(Arc::from))?;
        Ok(Self { directions: [x, y] })
    }

    /// The motion in x and in y, each with the vertical component.
    pub fn directions(&self) -> &[Motion; 2] {
        &self.directions
    }
}
