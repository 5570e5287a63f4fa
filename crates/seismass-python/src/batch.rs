//! Many runs at once, and their peaks as flat columns: no Python object is made per run.

use std::sync::Arc;

use pyo3::prelude::*;
use seismass::{Domain, Error, EventKind, Options, Peak, Peaks, Response, Run, SceneColumns};

use crate::arrays::{Output, Table, Values};
use crate::errors::from_kernel;
use crate::interrupt::{checked_threads, run_inline, run_watched};
use crate::response::{collapsed_storey, status_name};
use crate::scene::{Building, Motion, Scene};

/// Solves `runs`, rows of (index of scene, index of motion); with `peaks_only` residuals may be NaN, with `floor_force`
/// there are peaks of it. `progress` is called with runs done and runs in all.
#[pyfunction]
#[pyo3(signature = (scenes, motions, runs, *, peaks_only=false, floor_force=false, threads=None, progress=None))]
#[allow(clippy::too_many_arguments)]
pub(crate) fn simulate_many(
    py: Python<'_>,
    scenes: Vec<PyRef<'_, Scene>>,
    motions: Vec<PyRef<'_, Motion>>,
    runs: Table<i64>,
    peaks_only: bool,
    floor_force: bool,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Batch> {
    let scenes: Vec<seismass::Scene> = scenes.iter().map(|scene| scene.0.clone()).collect();
    let runs = pairs(&runs).map_err(|error| from_kernel(py, &error))?;
    let options = Options { peaks_only, floor_force, ..Options::default() };
    solve(py, motions, runs.len(), options, threads, progress, move || {
        Ok((scenes, runs.iter().map(|&(scene, motion)| Run::new(scene, motion)).collect()))
    })
}

/// Solves `runs`, rows of (row of the columns, index of motion), with the motion of run i multiplied by `scale[i]`;
/// otherwise as `simulate_many`.
#[pyfunction]
#[pyo3(signature = (columns, motions, runs, scale, *, peaks_only=false, floor_force=false, threads=None, progress=None))]
#[allow(clippy::too_many_arguments)]
pub(crate) fn simulate_columns(
    py: Python<'_>,
    columns: PyRef<'_, Columns>,
    motions: Vec<PyRef<'_, Motion>>,
    runs: Table<i64>,
    scale: Values<f64>,
    peaks_only: bool,
    floor_force: bool,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<Batch> {
    let columns = Arc::clone(&columns.0);
    let runs = pairs(&runs).map_err(|error| from_kernel(py, &error))?;
    if scale.0.len() != runs.len() {
        let (requirement, got) = (format!("one factor per run, {}", runs.len()), format!("{} values", scale.0.len()));
        return Err(from_kernel(py, &Error::invalid(Domain::Options, "scale", "batch", requirement, got)));
    }
    let options = Options { peaks_only, floor_force, ..Options::default() };
    solve(py, motions, runs.len(), options, threads, progress, move || {
        let (scenes, of_row) = columns.scenes()?;
        let run = |(&(row, motion), &scale): (&(usize, usize), &f64)| match of_row.get(row) {
            Some(&scene) => Ok(Run { scene, motion, scale }),
            None => {
                let requirement = format!("below the number of them, {}", of_row.len());
                Err(Error::invalid(Domain::Options, "row", "batch", requirement, row))
            }
        };
        let runs = runs.iter().zip(&scale.0).map(run).collect::<Result<_, _>>()?;
        Ok((scenes, runs))
    })
}

/// Solves what `prepare` gives, away from the calling thread: scenes, and `total` runs of them.
fn solve(
    py: Python<'_>,
    motions: Vec<PyRef<'_, Motion>>,
    total: usize,
    options: Options,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
    prepare: impl FnOnce() -> seismass::Result<(Vec<seismass::Scene>, Vec<Run>)> + Send + 'static,
) -> PyResult<Batch> {
    let motions: Vec<seismass::Motion> = motions.iter().map(|motion| motion.0.clone()).collect();
    let threads = checked_threads(py, threads, "batch")?;
    let report = |done: usize| progress.as_ref().map_or(Ok(()), |call| call.call1((done, total)).map(drop));
    run_watched(py, report, move |control| {
        let (scenes, runs) = prepare()?;
        let rows = seismass::simulate_each(&scenes, &motions, &runs, &options, threads, control, Row::new)?;
        let mut batch = Batch::with_room_for(&rows);
        batch.peak_floor_force = options.floor_force.then(Vec::new);
        for (run, row) in rows.into_iter().enumerate() {
            batch.push(run, row);
        }
        Ok(batch)
    })
}

pub(crate) fn pairs(runs: &Table<i64>) -> seismass::Result<Vec<(usize, usize)>> {
    let refuse = |value: String| {
        let requirement = "pairs of (index of scene, index of motion)";
        Error::invalid(Domain::Options, "pairs", "batch", requirement, value)
    };
    if runs.columns != 2 {
        return Err(refuse(format!("{} x {} numbers", runs.rows, runs.columns)));
    }
    runs.values
        .chunks_exact(2)
        .map(|pair| match (usize::try_from(pair[0]), usize::try_from(pair[1])) {
            (Ok(scene), Ok(motion)) => Ok((scene, motion)),
            _ => Err(refuse(format!("({}, {})", pair[0], pair[1]))),
        })
        .collect()
}

/// Scenes as columns, one row each: the index of a building, and tables of rows x blocks; a block of mass ratio 0 is
/// absent.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct Columns(Arc<SceneColumns>);

#[pymethods]
impl Columns {
    #[new]
    #[pyo3(signature = (buildings, floors, building, mass_ratio, mu_s, mu_k, *, collapse_drift=None))]
    #[allow(clippy::too_many_arguments)]
    fn new(
        py: Python<'_>,
        buildings: Vec<PyRef<'_, Building>>,
        floors: Vec<usize>,
        building: Values<i64>,
        mass_ratio: Table<f64>,
        mu_s: Table<f64>,
        mu_k: Table<f64>,
        collapse_drift: Option<f64>,
    ) -> PyResult<Self> {
        let index = |&index: &i64| {
            usize::try_from(index).map_err(|_| {
                let error = Error::invalid(Domain::Scene, "building index", "scene columns", "0 or more", index);
                from_kernel(py, &error)
            })
        };
        Ok(Self(Arc::new(SceneColumns {
            buildings: buildings.iter().map(|building| Arc::clone(&building.0)).collect(),
            floors,
            building: building.0.iter().map(index).collect::<PyResult<_>>()?,
            mass_ratio: mass_ratio.values,
            mu_s: mu_s.values,
            mu_k: mu_k.values,
            collapse_drift,
        })))
    }

    /// Raises what is wrong with the first row that describes no valid scene, called by its number of those given.
    fn check(&self, py: Python<'_>, numbers: Values<i64>) -> PyResult<()> {
        let columns = &self.0;
        run_inline(py, || {
            (0..columns.rows()).zip(&numbers.0).try_for_each(|(row, number)| match columns.scene(row) {
                Err(Error::Invalid { domain, parameter, owner, requirement, value }) => {
                    let owner = format!("{owner} of scene {number}");
                    Err(Error::Invalid { domain, parameter, owner, requirement, value })
                }
                other => other.map(drop),
            })
        })
    }
}

/// Results of a batch. A list per storey (or block) of run i is the next `storeys[i]` (or `blocks[i]`) values of a
/// flat array; a run that failed has none.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct Batch {
    status: Vec<u8>,
    failures: Vec<(usize, String)>,
    end_time: Vec<f64>,
    collapsed_storey: Vec<u32>,
    storeys: Vec<u32>,
    blocks: Vec<u32>,
    peak_drift: Vec<Peak>,
    residual_drift: Vec<f64>,
    peak_floor_acceleration: Vec<f64>,
    peak_storey_shear: Vec<f64>,
    peak_floor_force: Option<Vec<f64>>,
    peak_slip: Vec<Peak>,
    residual_slip: Vec<f64>,
    slip_path: Vec<f64>,
    events: Vec<u32>,
    yields: Vec<u32>,
    slips: Vec<u32>,
}

/// What a batch keeps of a run, in little memory: lists one after the other.
#[derive(Clone)]
pub(crate) struct Row {
    pub(crate) status: u8,
    pub(crate) collapsed_storey: u32,
    pub(crate) storeys: usize,
    pub(crate) blocks: usize,
    pub(crate) events: u32,
    pub(crate) yields: u32,
    pub(crate) slips: u32,
    pub(crate) end_time: f64,
    /// Of drift by storey, then of slip by block.
    pub(crate) peaks: Box<[Peak]>,
    /// Peak floor acceleration, peak storey shear and residual drift by storey, then residual slip and path slipped by block.
    pub(crate) values: Box<[f64]>,
    /// Peak floor force by storey, if asked for.
    pub(crate) floor_force: Box<[f64]>,
}

impl Row {
    fn new(response: Response) -> Self {
        let Peaks { drift, slip, floor_acceleration, storey_shear } = &response.peaks;
        let events = &response.statistics.events;
        let values = |peaks: &[Peak]| peaks.iter().map(|peak| peak.value).collect::<Vec<_>>();
        let (floor_acceleration, storey_shear) = (values(floor_acceleration), values(storey_shear));
        Self {
            status: u8::from(status_name(response.status) == STATUS_NAMES[1]),
            collapsed_storey: collapsed_storey(response.status).map_or(0, count),
            storeys: drift.len(),
            blocks: slip.len(),
            events: count(events.total()),
            yields: count(events.of(EventKind::Yield)),
            slips: count(events.of(EventKind::Slip)),
            end_time: response.end_time,
            peaks: [&drift[..], slip].concat().into(),
            values: [
                &floor_acceleration,
                &storey_shear,
                &response.residual_drift,
                &response.residual_slip,
                &response.slip_path,
            ]
            .map(|values| &values[..])
            .concat()
            .into(),
            floor_force: values(response.floor_force.as_deref().unwrap_or_default()).into(),
        }
    }
}

/// A count as it is stored; no run has 2^32 storeys, blocks or events.
pub(crate) fn count(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

/// Index of a status in `Batch.status_names`.
const FAILED: u8 = 2;
pub(crate) const COLLAPSED: u8 = 1;
const STATUS_NAMES: [&str; 3] = ["completed", "collapsed", "failed"];

impl Batch {
    /// No results yet, with room for those of so many runs.
    pub(crate) fn with_room_for(rows: &[seismass::Result<Row>]) -> Self {
        let (runs, solved) = (rows.len(), rows.iter().flatten());
        let (storeys, blocks) = solved.fold((0, 0), |(n, m), row| (n + row.storeys, m + row.blocks));
        Self {
            status: Vec::with_capacity(runs),
            end_time: Vec::with_capacity(runs),
            collapsed_storey: Vec::with_capacity(runs),
            storeys: Vec::with_capacity(runs),
            blocks: Vec::with_capacity(runs),
            events: Vec::with_capacity(runs),
            yields: Vec::with_capacity(runs),
            slips: Vec::with_capacity(runs),
            peak_drift: Vec::with_capacity(storeys),
            peak_floor_acceleration: Vec::with_capacity(storeys),
            peak_storey_shear: Vec::with_capacity(storeys),
            peak_floor_force: None,
            residual_drift: Vec::with_capacity(storeys),
            peak_slip: Vec::with_capacity(blocks),
            residual_slip: Vec::with_capacity(blocks),
            slip_path: Vec::with_capacity(blocks),
            failures: Vec::new(),
        }
    }

    pub(crate) fn push(&mut self, run: usize, result: seismass::Result<Row>) {
        let row = match result {
            Ok(row) => row,
            Err(error) => {
                self.failures.push((run, error.to_string()));
                self.status.push(FAILED);
                self.end_time.push(f64::NAN);
                for column in [
                    &mut self.collapsed_storey,
                    &mut self.storeys,
                    &mut self.blocks,
                    &mut self.events,
                    &mut self.yields,
                    &mut self.slips,
                ] {
                    column.push(0);
                }
                return;
            }
        };
        self.status.push(row.status);
        self.end_time.push(row.end_time);
        self.collapsed_storey.push(row.collapsed_storey);
        self.storeys.push(count(row.storeys));
        self.blocks.push(count(row.blocks));
        self.events.push(row.events);
        self.yields.push(row.yields);
        self.slips.push(row.slips);
        let mut peaks = &row.peaks[..];
        for (column, length) in [(&mut self.peak_drift, row.storeys), (&mut self.peak_slip, row.blocks)] {
            column.extend(peaks.split_off(..length).unwrap_or_default());
        }
        if let Some(forces) = &mut self.peak_floor_force {
            forces.extend(&row.floor_force);
        }
        let mut values = &row.values[..];
        for (column, length) in [
            (&mut self.peak_floor_acceleration, row.storeys),
            (&mut self.peak_storey_shear, row.storeys),
            (&mut self.residual_drift, row.storeys),
            (&mut self.residual_slip, row.blocks),
            (&mut self.slip_path, row.blocks),
        ] {
            column.extend(values.split_off(..length).unwrap_or_default());
        }
    }
}

fn values(peaks: &[Peak]) -> Output<f64> {
    Output::new(peaks.iter().map(|peak| peak.value))
}

fn times(peaks: &[Peak]) -> Output<f64> {
    Output::new(peaks.iter().map(|peak| peak.time))
}

fn column<T: Copy>(values: &[T]) -> Output<T> {
    Output::new(values.iter().copied())
}

getters! { Batch
    /// Status of each run, as index of `status_names`.
    status(self) -> Output<u8> = column(&self.status);
    /// Runs that failed: index and reason.
    failures(self) -> Vec<(usize, String)> = self.failures.clone();
    /// Time reached by each run (s).
    end_time(self) -> Output<f64> = column(&self.end_time);
    /// Storey that collapsed in each run, counted from 1; 0: none.
    collapsed_storey(self) -> Output<u32> = column(&self.collapsed_storey);
    /// Number of storeys of each run.
    storeys(self) -> Output<u32> = column(&self.storeys);
    /// Number of blocks of each run.
    blocks(self) -> Output<u32> = column(&self.blocks);
    /// Peak drift (m), flat over runs and storeys.
    peak_drift(self) -> Output<f64> = values(&self.peak_drift);
    /// Time of the peak drift (s), flat over runs and storeys.
    peak_drift_time(self) -> Output<f64> = times(&self.peak_drift);
    /// Drift at the end (m), flat over runs and storeys.
    residual_drift(self) -> Output<f64> = column(&self.residual_drift);
    /// Peak absolute floor acceleration (m/s2), flat over runs and floors.
    peak_floor_acceleration(self) -> Output<f64> = column(&self.peak_floor_acceleration);
    /// Peak storey shear (N), flat over runs and storeys.
    peak_storey_shear(self) -> Output<f64> = column(&self.peak_storey_shear);
    /// Peak floor force (N), flat over runs and floors, if asked for.
    peak_floor_force(self) -> Option<Output<f64>> = self.peak_floor_force.as_deref().map(column);
    /// Peak slip (m), flat over runs and blocks.
    peak_slip(self) -> Output<f64> = values(&self.peak_slip);
    /// Time of the peak slip (s), flat over runs and blocks.
    peak_slip_time(self) -> Output<f64> = times(&self.peak_slip);
    /// Slip at the end (m), flat over runs and blocks.
    residual_slip(self) -> Output<f64> = column(&self.residual_slip);
    /// Path slipped (m), flat over runs and blocks.
    slip_path(self) -> Output<f64> = column(&self.slip_path);
    /// Number of events of each run.
    events(self) -> Output<u32> = column(&self.events);
    /// Number of yields of each run.
    yields(self) -> Output<u32> = column(&self.yields);
    /// Number of breakaways of each run.
    slips(self) -> Output<u32> = column(&self.slips);
    ;
    /// Names of the statuses.
    #[staticmethod]
    fn status_names() -> Vec<&'static str> {
        STATUS_NAMES.to_vec()
    }
}
