//! Building and blocks, with their initial state.

use std::sync::Arc;

use crate::error::{Domain, Error, Result};
use crate::scene::block::Block;
use crate::scene::building::{Building, GravityEffect};
use crate::scene::check::{Nth, check, check_length};
use crate::units::STANDARD_GRAVITY;

/// Building and blocks, with their initial state.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "SceneForm"))]
pub struct Scene {
    building: Option<Arc<Building>>,
    blocks: Vec<Block>,
    initial_drift: Vec<f64>,
    initial_velocity: Vec<f64>,
    #[cfg_attr(feature = "serde", serde(skip))]
    geometric_stiffness: Vec<f64>,
    #[cfg_attr(feature = "serde", serde(with = "crate::scene::form"))]
    collapse_drift: Option<Vec<f64>>,
}

/// What is read of one with the feature `serde`: the fields of the same names.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct SceneForm {
    building: Option<Arc<Building>>,
    #[serde(default)]
    blocks: Vec<Block>,
    #[serde(default)]
    initial_drift: Vec<f64>,
    #[serde(default)]
    initial_velocity: Vec<f64>,
    #[serde(default, with = "crate::scene::form")]
    collapse_drift: Option<Vec<f64>>,
}

#[cfg(feature = "serde")]
impl TryFrom<SceneForm> for Scene {
    type Error = Error;

    fn try_from(form: SceneForm) -> Result<Self> {
        let scene = Self::new(form.building, form.blocks)?;
        let or_zero = |list: Vec<f64>| if list.is_empty() { vec![0.0; scene.storeys()] } else { list };
        let (drift, velocity) = (or_zero(form.initial_drift), or_zero(form.initial_velocity));
        let scene = scene.with_initial(drift, velocity)?;
        match form.collapse_drift {
            None => Ok(scene),
            Some(limits) => scene.with_collapse_drift(limits),
        }
    }
}

impl Scene {
    /// A scene at rest. Without a building, all blocks stand on the ground.
    ///
    /// # Errors
    /// [`Error::Invalid`] when there is nothing in the scene, a block is invalid, or P/h reaches a storey's stiffness.
    pub fn new(building: Option<Arc<Building>>, blocks: Vec<Block>) -> Result<Self> {
        let n = building.as_ref().map_or(0, |b| b.len());
        if n == 0 && blocks.is_empty() {
            return Err(Error::invalid(
                Domain::Scene,
                "blocks",
                "scene",
                "at least one where there is no building",
                "none",
            ));
        }
        for (j, block) in blocks.iter().enumerate() {
            block.validate(Nth("block", j), n)?;
        }
        let geometric_stiffness = building.as_ref().map_or(Ok(Vec::new()), |b| geometric_stiffness(b, &blocks))?;
        Ok(Self {
            building,
            blocks,
            initial_drift: vec![0.0; n],
            initial_velocity: vec![0.0; n],
            geometric_stiffness,
            collapse_drift: None,
        })
    }

    /// The same scene from an initial state: storey drifts (m, within the elastic range) and floor velocities
    /// relative to the ground (m/s).
    ///
    /// # Errors
    /// [`Error::Invalid`] when a list has the wrong length or a drift exceeds the first yield drift.
    pub fn with_initial(mut self, drift: Vec<f64>, velocity: Vec<f64>) -> Result<Self> {
        let storeys = self.building.as_ref().map_or(&[][..], |b| b.storeys());
        check_length("drift", "initial state", storeys.len(), "storey", drift.len())?;
        check_length("velocity", "initial state", storeys.len(), "floor", velocity.len())?;
        for (i, ((&d, &v), storey)) in drift.iter().zip(&velocity).zip(storeys).enumerate() {
            let limit = storey.elastic_drift();
            check(
                d.is_finite() && d.abs() <= limit,
                "initial drift",
                Nth("storey", i),
                format_args!("within {limit} m, its elastic range"),
                d,
            )?;
            check(v.is_finite(), "initial velocity", Nth("floor", i), "a finite number", v)?;
        }
        self.initial_drift = drift;
        self.initial_velocity = velocity;
        self.check_collapse()?;
        Ok(self)
    }

    /// The same scene with another collapse drift per storey (m; infinite: never).
    ///
    /// # Errors
    /// [`Error::Invalid`] when the list has the wrong length or a drift is not positive.
    pub fn with_collapse_drift(mut self, collapse_drift: Vec<f64>) -> Result<Self> {
        check_length("collapse_drift", "scene", self.storeys(), "storey", collapse_drift.len())?;
        self.collapse_drift = Some(collapse_drift);
        self.check_collapse()?;
        Ok(self)
    }

    fn check_collapse(&self) -> Result<()> {
        for (i, (&limit, &start)) in self.collapse_drift.iter().flatten().zip(&self.initial_drift).enumerate() {
            let (owner, requirement) = (Nth("storey", i), format_args!("below the collapse drift {limit} m"));
            check(limit > 0.0, "collapse_drift", owner, "a positive number", limit)?;
            check(start.abs() < limit, "initial drift", owner, requirement, start)?;
        }
        Ok(())
    }

    /// Number of storeys (0 without a building).
    pub fn storeys(&self) -> usize {
        self.initial_drift.len()
    }

    /// The building, if any.
    pub fn building(&self) -> Option<&Arc<Building>> {
        self.building.as_ref()
    }

    /// The blocks, in the order given.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// Initial storey drifts (m).
    pub fn initial_drift(&self) -> &[f64] {
        &self.initial_drift
    }

    /// Initial floor velocities relative to the ground (m/s).
    pub fn initial_velocity(&self) -> &[f64] {
        &self.initial_velocity
    }

    /// P/h of each storey (N/m): zero without P-Delta.
    pub fn geometric_stiffness(&self) -> &[f64] {
        &self.geometric_stiffness
    }

    /// Collapse drift per storey as given (m).
    pub fn collapse_drift(&self) -> Option<&[f64]> {
        self.collapse_drift.as_deref()
    }
}

/// P/h of each storey (N/m): the gravity load above it over its height.
fn geometric_stiffness(building: &Building, blocks: &[Block]) -> Result<Vec<f64>> {
    let n = building.len();
    let values = match building.gravity() {
        GravityEffect::None => vec![0.0; n],
        GravityEffect::GeometricStiffness(values) => values.clone(),
        GravityEffect::Loads { heights, floor_loads } => {
            let mut load = floor_loads.clone();
            for block in blocks.iter().filter(|b| b.floor > 0) {
                load[block.floor - 1] += block.mass * STANDARD_GRAVITY;
            }
            for i in (0..n - 1).rev() {
                load[i] += load[i + 1];
            }
            load.iter().zip(heights).map(|(p, h)| p / h).collect()
        }
    };
    for (i, (&value, storey)) in values.iter().zip(building.storeys()).enumerate() {
        let requirement = format_args!("below its stiffness {} N/m", storey.stiffness);
        check(value < storey.stiffness, "geometric stiffness P/h", Nth("storey", i), requirement, value)?;
    }
    Ok(values)
}
