//! Building, racks and goods, with their initial state.

use std::sync::Arc;

use crate::error::{Domain, Error, Result};
use crate::scene::building::{GravityEffect, MAX_STOREYS};
use crate::scene::building_and_blocks::Scene;
use crate::scene::check::{Nth, check, check_length};
use crate::scene::general::base::SlidingBase;
use crate::scene::general::building::GeneralBuilding;
use crate::scene::general::goods::Goods;
use crate::scene::general::rack::Rack;
use crate::units::STANDARD_GRAVITY;

/// A building, racks on its floors, and goods, with their initial state.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "GeneralSceneForm"))]
pub struct GeneralScene {
    building: Option<Arc<GeneralBuilding>>,
    goods: Vec<Goods>,
    racks: Vec<Rack>,
    base: Option<SlidingBase>,
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
struct GeneralSceneForm {
    building: Option<Arc<GeneralBuilding>>,
    #[serde(default)]
    goods: Vec<Goods>,
    #[serde(default)]
    racks: Vec<Rack>,
    base: Option<SlidingBase>,
    #[serde(default)]
    initial_drift: Vec<f64>,
    #[serde(default)]
    initial_velocity: Vec<f64>,
    #[serde(default, with = "crate::scene::form")]
    collapse_drift: Option<Vec<f64>>,
}

#[cfg(feature = "serde")]
impl TryFrom<GeneralSceneForm> for GeneralScene {
    type Error = Error;

    fn try_from(form: GeneralSceneForm) -> Result<Self> {
        let scene = Self::on_base(form.building, form.goods, form.racks, form.base)?;
        let or_zero = |list: Vec<f64>| if list.is_empty() { vec![0.0; scene.storeys()] } else { list };
        let (drift, velocity) = (or_zero(form.initial_drift), or_zero(form.initial_velocity));
        let scene = scene.with_initial(drift, velocity)?;
        match form.collapse_drift {
            None => Ok(scene),
            Some(limits) => scene.with_collapse_drift(limits),
        }
    }
}

impl GeneralScene {
    /// A scene at rest. Without a building, goods and racks stand on the ground.
    ///
    /// # Errors
    /// [`Error::Invalid`] when there is nothing in the scene, something in it is invalid, or P/h takes all stiffness.
    pub fn new(building: Option<Arc<GeneralBuilding>>, goods: Vec<Goods>, racks: Vec<Rack>) -> Result<Self> {
        Self::on_base(building, goods, racks, None)
    }

    /// A scene at rest on a sliding base, which may carry nothing but itself; None: on the ground.
    ///
    /// # Errors
    /// As [`Self::new`], and when the base is invalid.
    pub fn on_base(
        building: Option<Arc<GeneralBuilding>>,
        goods: Vec<Goods>,
        racks: Vec<Rack>,
        base: Option<SlidingBase>,
    ) -> Result<Self> {
        let n = building.as_ref().map_or(0, |building| building.len());
        base.map_or(Ok(()), |base| base.validate())?;
        if n == 0 && goods.is_empty() && racks.is_empty() && base.is_none() {
            let requirement = "at least one where there is no building and no rack";
            return Err(Error::invalid(Domain::Scene, "blocks", "scene", requirement, "none"));
        }
        for (j, goods) in goods.iter().enumerate() {
            goods.validate(Nth("block", j), n)?;
        }
        for (r, rack) in racks.iter().enumerate() {
            rack.validate(&Nth("rack", r).to_string(), n)?;
        }
        let nodes = n + racks.iter().map(|rack| rack.mass.len()).sum::<usize>();
        let requirement = format_args!("at most {MAX_STOREYS}");
        check(nodes <= MAX_STOREYS, "number of floors and rack levels", "scene", requirement, nodes as f64)?;
        let geometric_stiffness = building.as_ref().map_or(Vec::new(), |b| geometric_stiffness(b, &goods, &racks));
        if let Some(building) = &building {
            building.check_geometric(&geometric_stiffness)?;
        }
        let at_rest = vec![0.0; n];
        Ok(Self {
            building,
            goods,
            racks,
            base,
            initial_drift: at_rest.clone(),
            initial_velocity: at_rest,
            geometric_stiffness,
            collapse_drift: None,
        })
    }

    /// The same scene from storey drifts (m, within the elastic range) and floor velocities relative to the ground (m/s);
    /// racks move with what they stand on.
    ///
    /// # Errors
    /// [`Error::Invalid`] when a list has the wrong length or a drift exceeds the first yield drift.
    pub fn with_initial(mut self, drift: Vec<f64>, velocity: Vec<f64>) -> Result<Self> {
        let storeys = self.building.as_ref().map_or(&[][..], |b| b.storeys());
        check_length("drift", "initial state", storeys.len(), "storey", drift.len())?;
        check_length("velocity", "initial state", storeys.len(), "floor", velocity.len())?;
        for (i, ((&d, &v), storey)) in drift.iter().zip(&velocity).zip(storeys).enumerate() {
            let limit = storey.elastic_drift();
            let requirement = format_args!("within {limit} m, its elastic range");
            check(d.is_finite() && d.abs() <= limit, "initial drift", Nth("storey", i), requirement, d)?;
            check(v.is_finite(), "initial velocity", Nth("floor", i), "a finite number", v)?;
        }
        (self.initial_drift, self.initial_velocity) = (drift, velocity);
        self.check_collapse()?;
        Ok(self)
    }

    /// The same scene with another collapse drift per storey (m; infinite: never). Without it, a storey of a building
    /// without a matrix collapses where its backbone meets P/h; beside a matrix none does.
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

    /// Number of floors and rack levels.
    pub fn nodes(&self) -> usize {
        self.storeys() + self.racks.iter().map(|rack| rack.mass.len()).sum::<usize>()
    }

    /// The building, if any.
    pub fn building(&self) -> Option<&Arc<GeneralBuilding>> {
        self.building.as_ref()
    }

    /// Goods on the floors and on the ground.
    pub fn goods(&self) -> &[Goods] {
        &self.goods
    }

    /// The racks.
    pub fn racks(&self) -> &[Rack] {
        &self.racks
    }

    /// The sliding base, if any.
    pub fn base(&self) -> Option<&SlidingBase> {
        self.base.as_ref()
    }

    /// All goods that may slide: those on floors, then those of each rack.
    pub fn all_goods(&self) -> impl Iterator<Item = &Goods> {
        self.goods.iter().chain(self.racks.iter().flat_map(|rack| &rack.goods))
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

impl From<&Scene> for GeneralScene {
    /// A shear building with blocks on its floors.
    fn from(scene: &Scene) -> Self {
        Self {
            building: scene.building().map(|building| Arc::new(GeneralBuilding::from(&**building))),
            goods: scene.blocks().iter().cloned().map(Goods::from).collect(),
            racks: Vec::new(),
            base: None,
            initial_drift: scene.initial_drift().to_vec(),
            initial_velocity: scene.initial_velocity().to_vec(),
            geometric_stiffness: scene.geometric_stiffness().to_vec(),
            collapse_drift: scene.collapse_drift().map(<[f64]>::to_vec),
        }
    }
}

/// P/h of each storey (N/m): the gravity load above it, goods and racks included, over its height.
fn geometric_stiffness(building: &GeneralBuilding, goods: &[Goods], racks: &[Rack]) -> Vec<f64> {
    let n = building.len();
    match building.gravity() {
        GravityEffect::None => vec![0.0; n],
        GravityEffect::GeometricStiffness(values) => values.clone(),
        GravityEffect::Loads { heights, floor_loads } => {
            let mut load = floor_loads.clone();
            let of_blocks = goods.iter().map(|goods| (goods.block.floor, goods.block.mass));
            let of_racks = racks.iter().map(|rack| (rack.floor, rack.mass_with_goods().iter().sum()));
            for (floor, mass) in of_blocks.chain(of_racks).filter(|&(floor, _)| floor > 0) {
                load[floor - 1] += mass * STANDARD_GRAVITY;
            }
            for i in (0..n - 1).rev() {
                load[i] += load[i + 1];
            }
            load.iter().zip(heights).map(|(p, h)| p / h).collect()
        }
    }
}
