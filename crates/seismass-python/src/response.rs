//! One run, and its response as arrays.

use std::num::NonZeroUsize;

use pyo3::prelude::*;
use seismass::simulate_until;
use seismass::{EventKind, InstructionSet, Options, Peak, Status};

use crate::arrays::{Kept, Named, Output};
use crate::interrupt::{run_inline, run_watched};
use crate::scene::{Motion, Scene};

/// Bound on samples x (1 + storeys + blocks)^2 of a run that is short enough (tens of milliseconds) to need no watch
/// for Ctrl-C; starting a thread would cost more than many such runs. Samples count for each radian of the stiffest
/// vibration between them.
const SHORT_RUN: usize = 4_000_000;

/// Solves one scene under one motion; histories at every so many samples (0: none), of drifts and
/// slips alone if asked for.
#[pyfunction]
#[allow(clippy::too_many_arguments)]
#[pyo3(signature = (scene, motion, every, displacements_only, energy, events, *, floor_force=false))]
pub(crate) fn simulate(
    py: Python<'_>,
    scene: PyRef<'_, Scene>,
    motion: PyRef<'_, Motion>,
    every: usize,
    displacements_only: bool,
    energy: bool,
    events: bool,
    floor_force: bool,
) -> PyResult<Response> {
    let histories = NonZeroUsize::new(every);
    let options = Options { histories, displacements_only, energy, floor_force, events, peaks_only: false };
    let (scene, motion) = (&scene.0, &motion.0);
    let size = 1 + scene.storeys() + scene.blocks().len();
    let phase = scene.building().map_or(0.0, |building| building.frequency_bound() * motion.dt());
    let work = motion.acceleration().len().saturating_mul(size * size).saturating_mul(phase.max(1.0) as usize);
    let response = if work <= SHORT_RUN {
        run_inline(py, || seismass::simulate(scene, motion, &options))
    } else {
        let (scene, motion) = (scene.clone(), motion.clone());
        run_watched(py, |_| Ok(()), move |control| simulate_until(&scene, &motion, &options, &control.stop))
    }?;
    Response::new(py, response)
}

/// The response of one run. Its histories are the memory that the run wrote; other arrays are made when asked for.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct Response {
    /// Without its histories.
    run: seismass::Response,
    histories: Option<Histories>,
}

/// The histories as arrays, where they are kept.
struct Histories {
    every: usize,
    drift: Option<Kept<f64>>,
    slip: Option<Kept<f64>>,
    floor_velocity: Option<Kept<f64>>,
    block_velocity: Option<Kept<f64>>,
    floor_acceleration: Option<Kept<f64>>,
    storey_force: Option<Kept<f64>>,
}

impl Histories {
    fn new(py: Python<'_>, histories: seismass::Histories, storeys: usize, blocks: usize) -> PyResult<Self> {
        let rows = histories.rows;
        let kept = |values: Vec<f64>, columns: usize| {
            let is_kept = values.len() == rows * columns;
            is_kept.then(|| Output::shaped(&[rows, columns], values).keep(py)).transpose()
        };
        Ok(Self {
            every: histories.every,
            drift: kept(histories.drift, storeys)?,
            slip: kept(histories.slip, blocks)?,
            floor_velocity: kept(histories.floor_velocity, storeys)?,
            block_velocity: kept(histories.block_velocity, blocks)?,
            floor_acceleration: kept(histories.floor_acceleration, storeys)?,
            storey_force: kept(histories.storey_force, storeys)?,
        })
    }
}

/// Name of the instruction set that the hot loops use: "baseline", "avx2" or "avx512".
#[pyfunction]
pub(crate) fn instruction_set() -> &'static str {
    InstructionSet::in_use().name()
}

/// "completed" or "collapsed".
pub(crate) fn status_name(status: Status) -> &'static str {
    match status {
        Status::Completed => "completed",
        Status::Collapsed { .. } => "collapsed",
    }
}

/// Storey that collapsed, counted from 1.
pub(crate) fn collapsed_storey(status: Status) -> Option<usize> {
    match status {
        Status::Completed => None,
        Status::Collapsed { storey, .. } => Some(storey),
    }
}

fn values(peaks: &[Peak]) -> Output<f64> {
    Output::new(peaks.iter().map(|peak| peak.value))
}

fn times(peaks: &[Peak]) -> Output<f64> {
    Output::new(peaks.iter().map(|peak| peak.time))
}

impl Response {
    fn new(py: Python<'_>, mut run: seismass::Response) -> PyResult<Self> {
        let (storeys, blocks) = (run.peaks.drift.len(), run.peaks.slip.len());
        let histories = run.histories.take().map(|histories| Histories::new(py, histories, storeys, blocks));
        Ok(Self { run, histories: histories.transpose()? })
    }

    fn history(&self, py: Python<'_>, of: impl Fn(&Histories) -> &Option<Kept<f64>>) -> Option<Kept<f64>> {
        self.histories.as_ref().and_then(|histories| of(histories).as_ref()).map(|kept| kept.again(py))
    }

    fn event_column<T>(&self, of: impl Fn(&seismass::Event) -> T) -> Option<Output<T>> {
        self.run.events.as_ref().map(|events| Output::new(events.iter().map(of)))
    }
}

getters! { Response
    /// "completed" or "collapsed".
    status(self) -> &'static str = status_name(self.run.status);
    /// Time reached (s).
    end_time(self) -> f64 = self.run.end_time;
    /// Storey that collapsed, counted from 1.
    collapsed_storey(self) -> Option<usize> = collapsed_storey(self.run.status);
    /// Peak storey drift (m).
    peak_drift(self) -> Output<f64> = values(&self.run.peaks.drift);
    /// Time of the peak drift (s).
    peak_drift_time(self) -> Output<f64> = times(&self.run.peaks.drift);
    /// Peak slip of each block (m).
    peak_slip(self) -> Output<f64> = values(&self.run.peaks.slip);
    /// Time of the peak slip (s).
    peak_slip_time(self) -> Output<f64> = times(&self.run.peaks.slip);
    /// Peak absolute floor acceleration (m/s2).
    peak_floor_acceleration(self) -> Output<f64> = values(&self.run.peaks.floor_acceleration);
    /// Time of the peak floor acceleration (s).
    peak_floor_acceleration_time(self) -> Output<f64> = times(&self.run.peaks.floor_acceleration);
    /// Peak storey shear, the spring force alone (N).
    peak_storey_shear(self) -> Output<f64> = values(&self.run.peaks.storey_shear);
    /// Time of the peak storey shear (s).
    peak_storey_shear_time(self) -> Output<f64> = times(&self.run.peaks.storey_shear);
    /// Peak floor force (N), if asked for.
    peak_floor_force(self) -> Option<Output<f64>> = self.run.floor_force.as_deref().map(values);
    /// Time of the peak floor force (s).
    peak_floor_force_time(self) -> Option<Output<f64>> = self.run.floor_force.as_deref().map(times);
    /// Drift at the end (m).
    residual_drift(self) -> Output<f64> = Output::new(self.run.residual_drift.iter().copied());
    /// Slip at the end (m).
    residual_slip(self) -> Output<f64> = Output::new(self.run.residual_slip.iter().copied());
    /// Path slipped (m).
    slip_path(self) -> Output<f64> = Output::new(self.run.slip_path.iter().copied());
    /// Samples per row of the histories; None without histories.
    every(self) -> Option<usize> = self.histories.as_ref().map(|histories| histories.every);
    /// Drift history (m), rows x storeys.
    drift(self, py) -> Option<Kept<f64>> = self.history(py, |h| &h.drift);
    /// Slip history (m), rows x blocks.
    slip(self, py) -> Option<Kept<f64>> = self.history(py, |h| &h.slip);
    /// Floor velocity relative to the ground (m/s), rows x storeys.
    floor_velocity(self, py) -> Option<Kept<f64>> = self.history(py, |h| &h.floor_velocity);
    /// Block velocity relative to the ground (m/s), rows x blocks.
    block_velocity(self, py) -> Option<Kept<f64>> = self.history(py, |h| &h.block_velocity);
    /// Absolute floor acceleration (m/s2), rows x storeys.
    floor_acceleration(self, py) -> Option<Kept<f64>> = self.history(py, |h| &h.floor_acceleration);
    /// Spring force (N), rows x storeys.
    storey_force(self, py) -> Option<Kept<f64>> = self.history(py, |h| &h.storey_force);
    /// Times of the events (s).
    event_time(self) -> Option<Output<f64>> = self.event_column(|event| event.time);
    /// Kinds of the events, as indices of `event_kinds`.
    event_kind(self) -> Option<Output<u8>> = self.event_column(|event| event.kind as u8);
    /// Storey or block of each event, counted from 1.
    event_number(self) -> Option<Output<u32>> = self.event_column(|event| u32::try_from(event.number).unwrap_or(u32::MAX));
    /// Sign of each event.
    event_sign(self) -> Option<Output<i8>> = self.event_column(|event| event.sign);
    /// Segments of the backbone left at each yield, 1 at the first; stage of wear that begins; otherwise 0.
    event_element(self) -> Option<Output<u8>> = self.event_column(|event| event.element);
    /// Number of events of each kind, in the order of `event_kinds`.
    event_counts(self) -> Vec<usize> = self.run.statistics.events.0.to_vec();
    /// Energies (J) and their relative residual, if asked for.
    energy(self) -> Option<Named<f64, 8>> = self.run.energy.map(|energy| {
        Named([
            ("initial", energy.initial),
            ("input", energy.input),
            ("kinetic", energy.kinetic),
            ("viscous", energy.viscous),
            ("elastic", energy.elastic),
            ("hysteretic", energy.hysteretic),
            ("friction", energy.friction),
            ("relative_residual", energy.relative_residual),
        ])
    });
    /// Name of the instruction set that solved it.
    instructions(self) -> &'static str = instruction_set();
    /// Work done and skipped.
    statistics(self) -> Named<usize, 12> = statistics(&self.run.statistics);
    ;
    /// Names of the kinds of events.
    #[staticmethod]
    fn event_kinds() -> Vec<&'static str> {
        EventKind::ALL.iter().map(|kind| kind.name()).collect()
    }
}

/// Work done and skipped, by name.
pub(crate) fn statistics(statistics: &seismass::Statistics) -> Named<usize, 12> {
    let skipped = &statistics.skipped;
    Named([
        ("intervals", statistics.intervals),
        ("substeps", statistics.substeps),
        ("plain_steps", statistics.plain_steps),
        ("series_steps", statistics.series_steps),
        ("guards_isolated", statistics.guards_isolated),
        ("events", statistics.events.total()),
        ("regimes", statistics.regimes),
        ("regime_hits", statistics.regime_hits),
        ("skipped_elastic_storeys", skipped.elastic_storeys),
        ("skipped_bare_floors", skipped.bare_floors),
        ("skipped_head_samples", skipped.head_samples),
        ("skipped_tail_samples", skipped.tail_samples),
    ])
}
