//! Extension module `seismass._kernel`: converts between Python and the kernel, releases the interpreter while the
//! kernel works, listens for Ctrl-C and maps errors. It holds no engineering and no numerics.

#[macro_use]
mod getters;

mod arrays;
mod batch;
mod errors;
mod general_batch;
mod general_response;
mod general_run;
mod general_scene;
mod interrupt;
mod plane;
mod plane_batch;
mod reference;
mod response;
mod scene;
mod spectrum;
mod springs;

/// The kernel as Python sees it; use it through the package `seismass`.
#[pyo3::pymodule]
mod _kernel {
    /// Version of the kernel and of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    /// Standard gravity (m/s2).
    #[pymodule_export]
    const STANDARD_GRAVITY: f64 = seismass::STANDARD_GRAVITY;
    /// Most storeys of a building.
    #[pymodule_export]
    const MAX_STOREYS: usize = seismass::MAX_STOREYS;
    /// Most samples of a motion.
    #[pymodule_export]
    const MAX_SAMPLES: usize = seismass::MAX_SAMPLES;
    /// Most threads of a batch or spectrum.
    #[pymodule_export]
    const MAX_THREADS: usize = crate::interrupt::MAX_THREADS;
    /// Shortest period of an oscillator over the time step of its motion.
    #[pymodule_export]
    const SHORTEST_PERIOD_OVER_STEP: f64 = seismass::spectrum::PERIOD_RANGE[0];
    /// Default overstrength of a storey.
    #[pymodule_export]
    const DEFAULT_OVERSTRENGTH: f64 = seismass::Storey::DEFAULT_OVERSTRENGTH;
    /// Default second slope of a storey over the first.
    #[pymodule_export]
    const DEFAULT_SECOND_SLOPE: f64 = seismass::Storey::DEFAULT_SECOND_SLOPE;
    /// Default third slope of a storey over the first.
    #[pymodule_export]
    const DEFAULT_THIRD_SLOPE: f64 = seismass::Storey::DEFAULT_THIRD_SLOPE;

    #[pymodule_export]
    use crate::batch::{Batch, Columns, simulate_columns, simulate_many};
    #[pymodule_export]
    use crate::general_batch::{RackColumns, simulate_many_general};
    #[pymodule_export]
    use crate::general_run::{GeneralResponse, simulate_general};
    #[pymodule_export]
    use crate::general_scene::{GeneralBuilding, GeneralScene, Rack};
    #[pymodule_export]
    use crate::plane::{PlaneResponse, PlaneScene, simulate_plane};
    #[pymodule_export]
    use crate::plane_batch::simulate_many_plane;
    #[pymodule_export]
    use crate::reference::{ReferenceRun, integrate_reference};
    #[pymodule_export]
    use crate::response::{Response, instruction_set, simulate};
    #[pymodule_export]
    use crate::scene::{Building, Motion, Scene, uniform_stiffness};
    #[pymodule_export]
    use crate::spectrum::{oscillator_peaks, response_spectra};
    #[pymodule_export]
    use crate::springs::SpringPath;
}
