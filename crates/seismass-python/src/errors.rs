//! Kernel errors as the exceptions of `seismass.base.errors`.

use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;
use seismass::{Domain, Error};

/// An exception of `seismass.base.errors` with a message.
fn exception(py: Python<'_>, cell: &'static PyOnceLock<Py<PyType>>, name: &str, message: String) -> PyErr {
    match cell.import(py, "seismass.base.errors", name) {
        Ok(class) => PyErr::from_type(class.clone(), (message,)),
        Err(import_error) => import_error,
    }
}

/// The exception for a kernel error.
pub(crate) fn from_kernel(py: Python<'_>, error: &Error) -> PyErr {
    static SCENE: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    static MOTION: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    static OPTION: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    let message = error.to_string();
    match error {
        Error::Invalid { domain: Domain::Scene, .. } => exception(py, &SCENE, "InvalidScene", message),
        Error::Invalid { domain: Domain::Motion, .. } => exception(py, &MOTION, "InvalidMotion", message),
        Error::Invalid { domain: Domain::Options, .. } => exception(py, &OPTION, "InvalidOption", message),
        Error::Interrupted => PyKeyboardInterrupt::new_err(()),
        // The scene was accepted, and its run could not be finished.
        _ => simulation_error(py, message),
    }
}

/// The error of a building that Python described and the kernel does not know.
pub(crate) fn refuse(parameter: &str, requirement: &str, value: &str) -> Error {
    Error::invalid(Domain::Scene, parameter, "building", requirement, value)
}

/// The exception for a panic of the kernel, which is a defect of seismass and never the user's fault.
pub(crate) fn from_panic(py: Python<'_>, payload: &(dyn std::any::Any + Send)) -> PyErr {
    from_kernel(py, &Error::of_panic(payload))
}

/// The exception for a run that was accepted and could not be finished.
pub(crate) fn simulation_error(py: Python<'_>, message: String) -> PyErr {
    static SIMULATION: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    exception(py, &SIMULATION, "SimulationError", message)
}
