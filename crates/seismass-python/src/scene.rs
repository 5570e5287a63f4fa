//! Building, Scene, Motion: validated input that the kernel holds for Python.

use std::collections::BTreeMap;
use std::sync::Arc;

use nalgebra::DMatrix;
use pyo3::prelude::*;
use seismass::{Damping, GravityEffect, UniformBuilding, Wear};

use crate::arrays::{Output, Table, Values};
use crate::errors::{from_kernel, refuse};
use crate::interrupt::{run_inline, run_watched};
use crate::springs::{self, SpringPath};

/// Runs work that finds the frequencies of so many storeys, watched for Ctrl-C where it takes longer than milliseconds: it
/// grows like their cube.
pub(crate) fn find_frequencies<T: Send + 'static>(
    py: Python<'_>,
    storeys: usize,
    work: impl FnOnce() -> seismass::Result<T> + Send + 'static,
) -> PyResult<T> {
    const MOST_UNWATCHED: usize = 64;
    if storeys <= MOST_UNWATCHED { run_inline(py, work) } else { run_watched(py, |_| Ok(()), |_| work()) }
}

/// Building held by the kernel.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct Building(pub(crate) Arc<seismass::Building>);

getters! { Building
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
    /// Lists have one value per storey; `springs` has one by the name of each of a spring's numbers that is not the
    /// default. A backbone is a table of drift (m) and force (N); a storey without one is trilinear. `hysteresis` names
    /// that of each storey, Masing's without it. Damping is
    /// `damping_ratio` in every mode, or in two modes, or a matrix.
    #[new]
    #[pyo3(signature = (mass, springs, *, backbones=None, hysteresis=None, damping_ratio=None, rayleigh_modes=None, damping_matrix=None, heights=None,
        gravity_load=None, geometric_stiffness=None))]
    #[allow(clippy::too_many_arguments)]
    fn new(
        py: Python<'_>,
        mass: Values<f64>,
        springs: BTreeMap<String, Values<f64>>,
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
        find_frequencies(py, count, move || seismass::Building::new(mass.0, storeys?, damping?)?.with_gravity(gravity?))
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

/// How damping was given.
pub(crate) fn damping(
    ratio: Option<f64>,
    rayleigh_modes: Option<(usize, usize)>,
    matrix: Option<Table<f64>>,
) -> seismass::Result<Damping> {
    match (ratio, rayleigh_modes, matrix) {
        (Some(ratio), None, None) => Ok(Damping::Modal { ratio }),
        (Some(ratio), Some((first, second)), None) => Ok(Damping::Rayleigh { ratio, modes: [first, second] }),
        (None, None, Some(matrix)) => square(&matrix, "damping").map(Damping::Matrix),
        _ => Err(refuse("damping", "a ratio, a ratio in two modes or a matrix", "another combination")),
    }
}

/// How P-Delta was given.
pub(crate) fn gravity(
    heights: Option<Values<f64>>,
    gravity_load: Option<Values<f64>>,
    geometric_stiffness: Option<Values<f64>>,
) -> seismass::Result<GravityEffect> {
    match (heights, gravity_load, geometric_stiffness) {
        (None, None, Some(values)) => Ok(GravityEffect::GeometricStiffness(values.0)),
        (Some(heights), Some(loads), None) => Ok(GravityEffect::Loads { heights: heights.0, floor_loads: loads.0 }),
        (None, None, None) => Ok(GravityEffect::None),
        _ => Err(refuse("P-Delta", "geometric_stiffness, or heights and gravity_load", "another combination")),
    }
}

pub(crate) fn square(matrix: &Table<f64>, name: &str) -> seismass::Result<DMatrix<f64>> {
    if matrix.rows != matrix.columns {
        let shape = format!("{} x {}", matrix.rows, matrix.columns);
        return Err(refuse(name, "a square matrix", &shape));
    }
    Ok(DMatrix::from_row_slice(matrix.rows, matrix.columns, &matrix.values))
}

/// Building and blocks held by the kernel.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct Scene(pub(crate) seismass::Scene);

/// Floor, mass (kg), mu_s, mu_k, initial velocity (m/s), and stages of wear: slip path (m), mu_s, mu_k.
type BlockTuple = (usize, f64, f64, f64, Option<f64>, Vec<(f64, f64, f64)>);

fn block((floor, mass, mu_s, mu_k, velocity, wear): BlockTuple) -> seismass::Block {
    let wear = wear.into_iter().map(|(path, mu_s, mu_k)| Wear { path, mu_s, mu_k }).collect();
    seismass::Block { floor, mass, mu_s, mu_k, velocity, wear }
}

getters! { Scene
    /// P/h of each storey (N/m), the weight of the blocks included; zero without P-Delta.
    geometric_stiffness(self) -> Output<f64> = Output::new(self.0.geometric_stiffness().iter().copied());
    ;
    /// Blocks are tuples of floor, mass, mu_s, mu_k, initial velocity (None: that of the floor), and
    /// stages of wear, tuples of slip path, mu_s and mu_k.
    #[new]
    #[pyo3(signature = (building, blocks, *, initial_drift=None, initial_velocity=None, collapse_drift=None))]
    fn new(
        py: Python<'_>,
        building: Option<PyRef<'_, Building>>,
        blocks: Vec<BlockTuple>,
        initial_drift: Option<Values<f64>>,
        initial_velocity: Option<Values<f64>>,
        collapse_drift: Option<Values<f64>>,
    ) -> PyResult<Self> {
        let blocks = blocks.into_iter().map(block).collect();
        let build = || {
            let mut scene = seismass::Scene::new(building.map(|b| Arc::clone(&b.0)), blocks)?;
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

/// Ground motion held by the kernel.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct Motion(pub(crate) seismass::Motion);

getters! { Motion
    /// Horizontal samples (m/s2).
    acceleration(self) -> Output<f64> = Output::new(self.0.acceleration().iter().copied());
    /// Vertical samples (m/s2), up positive.
    vertical(self) -> Option<Output<f64>> = self.0.vertical().map(|samples| Output::new(samples.iter().copied()));
    /// Time step (s).
    dt(self) -> f64 = self.0.dt();
    ;
    /// Samples in m/s2 at step dt (s); vertical samples (up positive) are as many.
    #[new]
    #[pyo3(signature = (acceleration, dt, vertical=None))]
    fn new(py: Python<'_>, acceleration: Values<f64>, dt: f64, vertical: Option<Values<f64>>) -> PyResult<Self> {
        seismass::Motion::new(acceleration.0, dt, vertical.map(|values| values.0.into()))
            .map(Self)
            .map_err(|error| from_kernel(py, &error))
    }

    /// The motion up to the sample nearest to `duration` (s): cut, or continued at zero.
    fn with_duration(&self, py: Python<'_>, duration: f64) -> PyResult<Self> {
        self.0.with_duration(duration).map(Self).map_err(|error| from_kernel(py, &error))
    }

    /// The motion with both components multiplied by `factor`.
    fn scaled(&self, py: Python<'_>, factor: f64) -> PyResult<Self> {
        self.0.scaled(factor).map(Self).map_err(|error| from_kernel(py, &error))
    }
}

/// Storey stiffness (N/m) of a uniform building with the given first period (s) and floor mass (kg).
#[pyfunction]
pub(crate) fn uniform_stiffness(py: Python<'_>, storeys: usize, period: f64, mass: f64) -> PyResult<f64> {
    let uniform = UniformBuilding { storeys, period, mass, ..Default::default() };
    uniform.stiffness().map_err(|error| from_kernel(py, &error))
}
