//! Extension module `seismass._kernel`: converts between Python and the kernel, releases the interpreter while the
//! kernel works, listens for Ctrl-C and maps errors. It holds no engineering and no numerics.

mod arrays;
mod batch;
mod errors;
mod interrupt;
mod reference;
mod response;
mod scene;
mod spectrum;

/// The kernel as Python sees it; use it through the package `seismass`.
#[pyo3::pymodule]
mod _kernel {
    /// Version of the kernel and of the package.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    #[pymodule_export]
    use crate::batch::{Batch, Columns, simulate_columns, simulate_many};
    #[pymodule_export]
    use crate::reference::{ReferenceRun, integrate_reference};
    #[pymodule_export]
    use crate::response::{Response, instruction_set, simulate};
    #[pymodule_export]
    use crate::scene::{Building, Motion, Scene, uniform_stiffness};
    #[pymodule_export]
    use crate::spectrum::{oscillator_peaks, response_spectra};
}
