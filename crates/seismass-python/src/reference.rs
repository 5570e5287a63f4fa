//! The reference integrators, for the benchmarks: private to the project, no part of the package's interface.

use pyo3::prelude::*;
use seismass::reference::{self, Error, Events, Method};
use seismass::{Domain, Status};

use crate::arrays::Output;
use crate::errors::{from_kernel, simulation_error};
use crate::interrupt::run_inline;
use crate::scene::{Motion, Scene};

/// What a reference integrator gives back.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct ReferenceRun {
    history: reference::History,
    storeys: usize,
    blocks: usize,
}

getters! { ReferenceRun
    /// Whether the run reached the last sample; otherwise a storey collapsed.
    completed(self) -> bool = matches!(self.history.status, Status::Completed);
    /// Storey drift (m) at the samples, samples x storeys.
    drift(self) -> Output<f64> = Output::shaped(&[self.history.rows, self.storeys], self.history.drift.clone());
    /// Slip (m) at the samples, samples x blocks.
    slip(self) -> Output<f64> = Output::shaped(&[self.history.rows, self.blocks], self.history.slip.clone());
    /// Largest absolute drift of each storey at the ends of steps (m).
    peak_drift(self) -> Output<f64> = Output::new(self.history.peak_drift.iter().copied());
    /// Largest absolute slip of each block at the ends of steps (m).
    peak_slip(self) -> Output<f64> = Output::new(self.history.peak_slip.iter().copied());
    /// Steps taken, those tried while locating events and Newton iterations included.
    steps(self) -> usize = self.history.steps;
    /// Changes of state; 0 for methods without events.
    events(self) -> usize = self.history.events;
}

/// Newton of the friction springs has converged at this residual, over the largest force; and gives up after so many
/// iterations.
const NEWTON_TOLERANCE: f64 = 1e-10;
const NEWTON_ITERATIONS: usize = 100;

/// Integrate by steps, `substeps` per sample interval: method is gauss, newmark, friction_springs or leapfrog.
///
/// States of gauss and newmark switch at step ends, or where `event_tolerance` (over the step) is given, at the located
/// events. Friction springs have `stiffness_ratio` times the stiffness of their storey.
#[pyfunction]
#[pyo3(signature = (scene, motion, method, substeps, *, event_tolerance=None, stiffness_ratio=None))]
pub(crate) fn integrate_reference(
    py: Python<'_>,
    scene: PyRef<'_, Scene>,
    motion: PyRef<'_, Motion>,
    method: &str,
    substeps: usize,
    event_tolerance: Option<f64>,
    stiffness_ratio: Option<f64>,
) -> PyResult<ReferenceRun> {
    let events = event_tolerance.map_or(Events::AtStepEnds, |tolerance| Events::Located { tolerance });
    let method = match (method, stiffness_ratio) {
        ("gauss", None) => Method::Gauss { substeps, events },
        ("newmark", None) => Method::Newmark { substeps, events },
        ("leapfrog", None) => Method::Leapfrog { substeps },
        ("friction_springs", Some(stiffness_ratio)) => Method::FrictionSprings {
            substeps,
            stiffness_ratio,
            tolerance: NEWTON_TOLERANCE,
            max_iterations: NEWTON_ITERATIONS,
        },
        _ => {
            let requirement = "gauss, newmark, leapfrog, or friction_springs with a stiffness ratio";
            let error =
                seismass::Error::invalid(Domain::Options, "method", "reference integrator", requirement, method);
            return Err(from_kernel(py, &error));
        }
    };
    let (scene, motion) = (scene.0.clone(), motion.0.clone());
    let (storeys, blocks) = (scene.storeys(), scene.blocks().len());
    match run_inline(py, move || Ok(reference::integrate(&scene, &motion, &method)))? {
        Ok(history) => Ok(ReferenceRun { history, storeys, blocks }),
        Err(Error::Kernel(error)) => Err(from_kernel(py, &error)),
        Err(error) => Err(simulation_error(py, error.to_string())),
    }
}
