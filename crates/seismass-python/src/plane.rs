//! Scenes in two horizontal directions, their runs and responses.

use std::num::NonZeroUsize;

use pyo3::prelude::*;
use seismass::{Axis, GeneralStatus, Options, Peak, PlaneMotion, simulate_plane_until};

use crate::arrays::{Named, Output, Values};
use crate::errors::from_kernel;
use crate::general_response::energies;
use crate::general_run::GeneralResponse;
use crate::general_scene::GeneralScene;
use crate::interrupt::run_watched;
use crate::scene::Motion;

/// Scene in two horizontal directions held by the kernel.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct PlaneScene(pub(crate) seismass::PlaneScene);

#[pymethods]
impl PlaneScene {
    /// What a scene is in x and in y: equal masses and goods; stops in y stand across y.
    #[new]
    fn new(py: Python<'_>, x: PyRef<'_, GeneralScene>, y: PyRef<'_, GeneralScene>) -> PyResult<Self> {
        let scene = seismass::PlaneScene::new(x.0.clone(), y.0.clone());
        scene.map(Self).map_err(|error| from_kernel(py, &error))
    }
}

/// Solves one scene in two horizontal directions under a motion in x and the samples of one in y (m/s2); other
/// arguments as of `simulate`.
#[pyfunction]
#[pyo3(signature = (scene, motion, other, every, displacements_only, energy, events))]
#[allow(clippy::too_many_arguments)]
pub(crate) fn simulate_plane(
    py: Python<'_>,
    scene: PyRef<'_, PlaneScene>,
    motion: PyRef<'_, Motion>,
    other: Values<f64>,
    every: usize,
    displacements_only: bool,
    energy: bool,
    events: bool,
) -> PyResult<PlaneResponse> {
    let histories = NonZeroUsize::new(every);
    let options = Options { histories, displacements_only, energy, events, ..Options::default() };
    let motion = PlaneMotion::new(motion.0.clone(), other.0).map_err(|error| from_kernel(py, &error))?;
    let scene = scene.0.clone();
    let run =
        run_watched(py, |_| Ok(()), move |control| simulate_plane_until(&scene, &motion, &options, &control.stop));
    Ok(PlaneResponse(run?))
}

/// The response of one run in two horizontal directions: what is of vectors, and the response in each direction.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct PlaneResponse(seismass::PlaneResponse);

impl PlaneResponse {
    /// Of storeys and floors, or of rack levels.
    fn part(&self, of_nodes: &[Peak], racks: bool) -> Output<f64> {
        let (floors, levels) = of_nodes.split_at(self.0.storeys);
        Output::new(if racks { levels } else { floors }.iter().map(|peak| peak.value))
    }

    fn event_column<T>(&self, of: impl Fn(&seismass::PlaneEvent) -> T) -> Option<Output<T>> {
        self.0.events.as_ref().map(|events| Output::new(events.iter().map(of)))
    }
}

getters! { PlaneResponse
    /// The responses in x and in y; path and statistics are of the run.
    directions(self) -> (GeneralResponse, GeneralResponse) = (GeneralResponse(self.0.direction(Axis::X)), GeneralResponse(self.0.direction(Axis::Y)));
    /// "completed" or "collapsed".
    status(self) -> &'static str = match self.0.status {
        GeneralStatus::Completed => "completed",
        GeneralStatus::Collapsed { .. } => "collapsed",
    };
    /// Peak length of the drift vector of each storey (m).
    peak_drift(self) -> Output<f64> = self.part(&self.0.peaks.vector.drift, false);
    /// Peak length of the drift vector of rack levels (m).
    peak_rack_drift(self) -> Output<f64> = self.part(&self.0.peaks.vector.drift, true);
    /// Peak length of the absolute acceleration of each floor (m/s2).
    peak_floor_acceleration(self) -> Output<f64> = self.part(&self.0.peaks.vector.acceleration, false);
    /// Peak length of the absolute acceleration of rack levels (m/s2).
    peak_rack_acceleration(self) -> Output<f64> = self.part(&self.0.peaks.vector.acceleration, true);
    /// Peak length of the shear vector of each storey, the spring force alone (N).
    peak_storey_shear(self) -> Output<f64> = self.part(&self.0.peaks.vector.shear, false);
    /// Peak length of the shear vector of rack levels, the spring force alone (N).
    peak_rack_shear(self) -> Output<f64> = self.part(&self.0.peaks.vector.shear, true);
    /// Peak length of the base shear vector, with the share of matrices (N); NaN without a building.
    peak_base_shear(self) -> f64 = if self.0.storeys > 0 { self.0.peaks.vector.base_shear.value } else { f64::NAN };
    /// Peak length of the slip of each block (m).
    peak_slip(self) -> Output<f64> = Output::new(self.0.peaks.vector.slip.iter().map(|peak| peak.value));
    /// Path slipped in contact with what carries the block (m).
    slip_path(self) -> Output<f64> = Output::new(self.0.slip_path.iter().copied());
    /// Times of the events (s).
    event_time(self) -> Option<Output<f64>> = self.event_column(|entry| entry.event.event.time);
    /// Kinds of the events, as indices of `Response.event_kinds`.
    event_kind(self) -> Option<Output<u8>> = self.event_column(|entry| entry.event.event.kind as u8);
    /// Storey (levels of racks count on) or block of each event, counted from 1.
    event_number(self) -> Option<Output<u32>> = self.event_column(|entry| u32::try_from(entry.event.event.number).unwrap_or(u32::MAX));
    /// Direction of each event: 1 in x, 2 in y; 0: it is of a vector.
    event_direction(self) -> Option<Output<u8>> = self.event_column(|entry| match entry.axis {
        None => 0,
        Some(Axis::X) => 1,
        Some(Axis::Y) => 2,
    });
    /// Sign of each event of a direction; 0 for one of a vector.
    event_sign(self) -> Option<Output<i8>> = self.event_column(|entry| entry.event.event.sign);
    /// Angle of each event of a vector, from x towards y (rad); NaN for others.
    event_angle(self) -> Option<Output<f64>> = self.event_column(|entry| entry.angle);
    /// Segments of the backbone left at each yield, 1 at the first; stage of wear that begins; otherwise 0.
    event_element(self) -> Option<Output<u8>> = self.event_column(|entry| entry.event.event.element);
    /// Energies of both directions together (J) and their relative residual, if asked for.
    energy(self) -> Option<Named<f64, 9>> = self.0.energy.map(|energy| energies(&energy.total));
}
