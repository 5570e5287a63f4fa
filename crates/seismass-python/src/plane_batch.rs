//! Many runs in two horizontal directions at once: a batch of the vectors, and one of each direction.

use pyo3::prelude::*;
use seismass::{Axis, GeneralPeaks, GeneralResponse, Options, Peak, PlaneMotion, Run};

use crate::arrays::{Table, Values};
use crate::batch::{Batch, pairs};
use crate::errors::from_kernel;
use crate::general_batch::{Kept, RackColumns, gathered, kept};
use crate::interrupt::{checked_threads, run_watched};
use crate::plane::PlaneScene;
use crate::scene::Motion;

/// Batches of the vectors, of x and of y.
type Batches = [(Batch, RackColumns); 3];

/// Solves `runs`, rows of (index of scene, index of motion), of scenes in two directions: a batch of the lengths of
/// vectors, one of x and one of y. `others` are the samples of the motions in y (m/s2); `progress` is called with runs
/// done and runs in all. The residuals of the first are lengths too, its contacts the larger of both directions.
#[pyfunction]
#[pyo3(signature = (scenes, motions, others, runs, *, threads=None, progress=None))]
pub(crate) fn simulate_many_plane(
    py: Python<'_>,
    scenes: Vec<PyRef<'_, PlaneScene>>,
    motions: Vec<PyRef<'_, Motion>>,
    others: Vec<Values<f64>>,
    runs: Table<i64>,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Batches> {
    let scenes: Vec<seismass::PlaneScene> = scenes.iter().map(|scene| scene.0.clone()).collect();
    let both = |(x, y): (&PyRef<'_, Motion>, Values<f64>)| PlaneMotion::new(x.0.clone(), y.0);
    let motions: seismass::Result<Vec<PlaneMotion>> = motions.iter().zip(others).map(both).collect();
    let motions = motions.map_err(|error| from_kernel(py, &error))?;
    let runs = pairs(&runs).map_err(|error| from_kernel(py, &error))?;
    let threads = checked_threads(py, threads, "batch")?;
    let total = runs.len();
    let report = |done: usize| progress.as_ref().map_or(Ok(()), |call| call.call1((done, total)).map(drop));
    run_watched(py, report, move |control| {
        let runs: Vec<Run> = runs.iter().map(|&(scene, motion)| Run::new(scene, motion)).collect();
        let options = Options { events: false, ..Options::default() };
        let solved = seismass::simulate_plane_each(&scenes, &motions, &runs, &options, threads, control, |response| {
            [vector(&response), response.direction(Axis::X), response.direction(Axis::Y)].map(|each| kept(&each))
        })?;
        let mut parts: [Vec<seismass::Result<Kept>>; 3] = Default::default();
        for run in solved {
            let each = match run {
                Ok(each) => each.map(Ok),
                Err(error) => [Err(error.clone()), Err(error.clone()), Err(error)],
            };
            parts.iter_mut().zip(each).for_each(|(part, one)| part.push(one));
        }
        Ok(parts.map(gathered))
    })
}

/// A response with the lengths of vectors in place of values in one direction.
fn vector(response: &seismass::PlaneResponse) -> GeneralResponse {
    let [mut x, y] = [Axis::X, Axis::Y].map(|axis| response.direction(axis));
    let of = &response.peaks.vector;
    let larger =
        |x: &[Peak], y: &[Peak]| x.iter().zip(y).map(|(x, y)| if y.value > x.value { *y } else { *x }).collect();
    x.peaks = GeneralPeaks {
        drift: of.drift.clone(),
        acceleration: of.acceleration.clone(),
        shear: of.shear.clone(),
        base_shear: of.base_shear,
        slip: of.slip.clone(),
        contact_force: larger(&x.peaks.contact_force, &y.peaks.contact_force),
        contact_velocity: larger(&x.peaks.contact_velocity, &y.peaks.contact_velocity),
    };
    let length = |pairs: &[[f64; 2]]| pairs.iter().map(|[x, y]| x.hypot(*y)).collect();
    x.residual_drift = length(&response.residual_drift);
    x.residual_slip = length(&response.residual_slip);
    x
}
