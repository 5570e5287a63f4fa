//! Scenes of the general engine that the kernel holds for Python: buildings with a matrix, racks, goods with stops.

use std::collections::BTreeMap;
use std::sync::Arc;

use pyo3::prelude::*;
use seismass::{Block, SlidingBase, Stops, Wear};

use crate::arrays::{Output, Table, Values};
use crate::errors::from_kernel;
use crate::errors::refuse;
use crate::scene::{Building, damping, find_frequencies, gravity, square};
use crate::springs::{self, SpringPath};

/// Building with an elastic matrix held by the kernel.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct GeneralBuilding(Arc<seismass::GeneralBuilding>);

getters! { GeneralBuilding
    /// Natural periods of the bare building without P-Delta (s), longest first.
    periods(self, py) -> PyResult<Output<f64>> = {
        let building = Arc::clone(&self.0);
        find_frequencies(py, self.0.mass().len(), move || Ok(building.periods())).map(Output::new)
    };
    /// Damping matrix C in floor coordinates (N s/m).
    damping_matrix(self) -> Output<f64> = {
        let matrix = self.0.damping_matrix();
        Output::shaped(&[matrix.nrows(), matrix.ncols()], matrix.transpose().as_slice().to_vec())
    };
    ;
    /// As `Building`, with an elastic matrix over the floors (N/m); storeys may have a spring of stiffness 0.
    #[new]
    #[pyo3(signature = (mass, springs, *, stiffness_matrix, backbones=None, hysteresis=None, damping_ratio=None, rayleigh_modes=None,
        damping_matrix=None, heights=None, gravity_load=None, geometric_stiffness=None))]
    #[allow(clippy::too_many_arguments)]
    fn new(
        py: Python<'_>,
        mass: Values<f64>,
        springs: BTreeMap<String, Values<f64>>,
        stiffness_matrix: Table<f64>,
        backbones: Option<Vec<Option<Table<f64>>>>,
        hysteresis: Option<Vec<String>>,
        damping_ratio: Option<f64>,
        rayleigh_modes: Option<(usize, usize)>,
        damping_matrix: Option<Table<f64>>,
        heights: Option<Values<f64>>,
        gravity_load: Option<Values<f64>>,
        geometric_stiffness: Option<Values<f64>>,
    ) -> PyResult<Self> {
        let damping = damping(damping_ratio, rayleigh_modes, damping_matrix);
        let gravity = gravity(heights, gravity_load, geometric_stiffness);
        let count = mass.0.len();
        let storeys = springs::storeys(count, &springs, backbones.as_deref(), hysteresis.as_deref());
        let matrix = square(&stiffness_matrix, "stiffness_matrix");
        find_frequencies(py, count, move || {
            seismass::GeneralBuilding::new(mass.0, storeys?, Some(matrix?), &damping?, gravity?)
        })
        .map(|building| Self(Arc::new(building)))
    }

    /// Drives the spring of a storey, given by its index, from one drift (m) to the next.
    fn spring_path(&self, py: Python<'_>, storey: usize, drifts: Values<f64>) -> PyResult<SpringPath> {
        let path = match self.0.storeys().get(storey) {
            Some(storey) => SpringPath::new(storey, &drifts.0),
            None => Err(refuse("storey", "one of those of the building", &storey.to_string())),
        };
        path.map_err(|error| from_kernel(py, &error))
    }
}

/// Clearances towards minus and towards plus (m), stiffness (N/m) and damper (N s/m) of stops.
type StopsTuple = (f64, f64, f64, f64);

/// Floor or level, mass (kg), mu_s, mu_k, initial velocity (m/s), stages of wear: slip path (m), mu_s, mu_k; and stops.
type GoodsTuple = (usize, f64, f64, f64, Option<f64>, Vec<(f64, f64, f64)>, Option<StopsTuple>);

fn goods((floor, mass, mu_s, mu_k, velocity, wear, stops): GoodsTuple) -> seismass::Goods {
    let wear = wear.into_iter().map(|(path, mu_s, mu_k)| Wear { path, mu_s, mu_k }).collect();
    let stops = stops.map(|(minus, plus, stiffness, damping)| Stops { clearance: [minus, plus], stiffness, damping });
    seismass::Goods { block: Block { floor, mass, mu_s, mu_k, velocity, wear }, stops }
}

/// Rack held by the kernel.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct Rack(seismass::Rack);

#[pymethods]
impl Rack {
    /// Lists have one value per level, from the lowest up; springs as those of `Building`. Masses are of the frame
    /// with the goods that are fixed to it; other goods are tuples of level, mass, mu_s, mu_k, initial velocity, stages
    /// of wear, and stops or None.
    #[new]
    #[pyo3(signature = (floor, mass, springs, *, backbones=None, hysteresis=None, damping_ratio, geometric_stiffness=None, blocks))]
    #[allow(clippy::too_many_arguments)]
    fn new(
        py: Python<'_>,
        floor: usize,
        mass: Values<f64>,
        springs: BTreeMap<String, Values<f64>>,
        backbones: Option<Vec<Option<Table<f64>>>>,
        hysteresis: Option<Vec<String>>,
        damping_ratio: f64,
        geometric_stiffness: Option<Values<f64>>,
        blocks: Vec<GoodsTuple>,
    ) -> PyResult<Self> {
        let levels = springs::storeys(mass.0.len(), &springs, backbones.as_deref(), hysteresis.as_deref());
        Ok(Self(seismass::Rack {
            floor,
            mass: mass.0,
            levels: levels.map_err(|error| from_kernel(py, &error))?,
            damping_ratio,
            geometric_stiffness: geometric_stiffness.map_or_else(Vec::new, |values| values.0),
            goods: blocks.into_iter().map(goods).collect(),
        }))
    }

    /// Stiffness of equally stiff levels (N/m) that gives the first period (s) to levels of these masses (kg), the
    /// goods included.
    #[staticmethod]
    fn uniform_stiffness(py: Python<'_>, mass: Values<f64>, period: f64) -> PyResult<f64> {
        seismass::Rack::uniform_stiffness(&mass.0, period).map_err(|error| from_kernel(py, &error))
    }
}

/// A building of either engine.
#[derive(FromPyObject)]
enum AnyBuilding<'py> {
    Chain(PyRef<'py, Building>),
    General(PyRef<'py, GeneralBuilding>),
}

/// Scene of the general engine held by the kernel.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct GeneralScene(pub(crate) seismass::GeneralScene);

getters! { GeneralScene
    /// P/h of each storey (N/m), the weight of goods and racks included; zero without P-Delta.
    geometric_stiffness(self) -> Output<f64> = Output::new(self.0.geometric_stiffness().iter().copied());
    ;
    /// As `Scene`; blocks have stops or None at the end of their tuples. A sliding base has the mass of its slab (kg),
    /// mu_s, mu_k and the radius of its pendulum (m; infinite: flat).
    #[new]
    #[pyo3(signature = (building, blocks, racks, *, base=None, initial_drift=None, initial_velocity=None, collapse_drift=None))]
    #[allow(clippy::too_many_arguments)]
    fn new(
        py: Python<'_>,
        building: Option<AnyBuilding<'_>>,
        blocks: Vec<GoodsTuple>,
        racks: Vec<PyRef<'_, Rack>>,
        base: Option<(f64, f64, f64, f64)>,
        initial_drift: Option<Values<f64>>,
        initial_velocity: Option<Values<f64>>,
        collapse_drift: Option<Values<f64>>,
    ) -> PyResult<Self> {
        let building = building.map(|building| match building {
            AnyBuilding::Chain(building) => Arc::new(seismass::GeneralBuilding::from(&*building.0)),
            AnyBuilding::General(building) => Arc::clone(&building.0),
        });
        let blocks = blocks.into_iter().map(goods).collect();
        let racks: Vec<seismass::Rack> = racks.iter().map(|rack| rack.0.clone()).collect();
        let build = || {
            let base = base.map(|(mass, mu_s, mu_k, radius)| SlidingBase { mass, mu_s, mu_k, radius });
            let mut scene = seismass::GeneralScene::on_base(building, blocks, racks, base)?;
            let at_rest = vec![0.0; scene.storeys()];
            if initial_drift.is_some() || initial_velocity.is_some() {
                let drift = initial_drift.map_or_else(|| at_rest.clone(), |values| values.0);
                let velocity = initial_velocity.map_or_else(|| at_rest.clone(), |values| values.0);
                scene = scene.with_initial(drift, velocity)?;
            }
            match collapse_drift {
                Some(limits) => scene.with_collapse_drift(limits.0),
                None => Ok(scene),
            }
        };
        build().map(Self).map_err(|error| from_kernel(py, &error))
    }
}
