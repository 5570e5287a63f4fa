//! Response spectra of many motions at once.

use pyo3::prelude::*;

use crate::arrays::{Output, Values};
use crate::interrupt::{checked_threads, run_watched};
use crate::scene::Motion;

/// Peak relative displacement (m) of linear oscillators from rest: motions x damping ratios x periods.
#[pyfunction]
#[pyo3(signature = (motions, periods, damping, threads=None))]
pub(crate) fn response_spectra(
    py: Python<'_>,
    motions: Vec<PyRef<'_, Motion>>,
    periods: Values<f64>,
    damping: Values<f64>,
    threads: Option<usize>,
) -> PyResult<Output<f64>> {
    let motions: Vec<seismass::Motion> = motions.iter().map(|motion| motion.0.clone()).collect();
    let threads = checked_threads(py, threads, "spectrum")?;
    let shape = [motions.len(), damping.0.len(), periods.0.len()];
    let peaks = run_watched(
        py,
        |_| Ok(()),
        move |control| seismass::spectrum::response_spectra(&motions, &periods.0, &damping.0, threads, control),
    )?;
    Ok(Output::shaped(&shape, peaks))
}

/// What `oscillator_peaks` gives back: displacement, its time, absolute acceleration.
type Peaks = (Output<f64>, Output<f64>, Output<f64>);

/// Peaks of linear oscillators from rest, each motions x damping ratios x periods: relative displacement (m) with its
/// sign, its time (s), and absolute acceleration (m/s2).
#[pyfunction]
#[pyo3(signature = (motions, periods, damping, threads=None))]
pub(crate) fn oscillator_peaks(
    py: Python<'_>,
    motions: Vec<PyRef<'_, Motion>>,
    periods: Values<f64>,
    damping: Values<f64>,
    threads: Option<usize>,
) -> PyResult<Peaks> {
    let motions: Vec<seismass::Motion> = motions.iter().map(|motion| motion.0.clone()).collect();
    let threads = checked_threads(py, threads, "spectrum")?;
    let shape = [motions.len(), damping.0.len(), periods.0.len()];
    let peaks = run_watched(
        py,
        |_| Ok(()),
        move |control| seismass::spectrum::oscillator_peaks(&motions, &periods.0, &damping.0, threads, control),
    )?;
    let of = |value: fn(&seismass::spectrum::OscillatorPeak) -> f64| {
        Output::shaped(&shape, peaks.iter().map(value).collect::<Vec<f64>>())
    };
    Ok((of(|peak| peak.displacement), of(|peak| peak.time), of(|peak| peak.acceleration)))
}
