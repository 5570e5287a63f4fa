//! Many runs of the general engine at once: a batch as of the chain engine, and columns of racks, stops and bases.

use pyo3::prelude::*;
use seismass::{EventKind, GeneralResponse, GeneralStatus, Options, Peak, Run};

use crate::arrays::{Output, Table};
use crate::batch::{Batch, COLLAPSED, Row, count, pairs};
use crate::errors::from_kernel;
use crate::general_scene::GeneralScene;
use crate::interrupt::{checked_threads, run_watched};
use crate::scene::Motion;

/// Solves `runs`, rows of (index of scene, index of motion); `progress` is called with runs done and runs in all.
#[pyfunction]
#[pyo3(signature = (scenes, motions, runs, *, threads=None, progress=None))]
pub(crate) fn simulate_many_general(
    py: Python<'_>,
    scenes: Vec<PyRef<'_, GeneralScene>>,
    motions: Vec<PyRef<'_, Motion>>,
    runs: Table<i64>,
    threads: Option<usize>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<(Batch, RackColumns)> {
    let scenes: Vec<seismass::GeneralScene> = scenes.iter().map(|scene| scene.0.clone()).collect();
    let motions: Vec<seismass::Motion> = motions.iter().map(|motion| motion.0.clone()).collect();
    let runs = pairs(&runs).map_err(|error| from_kernel(py, &error))?;
    let threads = checked_threads(py, threads, "batch")?;
    let total = runs.len();
    let report = |done: usize| progress.as_ref().map_or(Ok(()), |call| call.call1((done, total)).map(drop));
    run_watched(py, report, move |control| {
        let runs: Vec<Run> = runs.iter().map(|&(scene, motion)| Run::new(scene, motion)).collect();
        let options = Options { events: false, ..Options::default() };
        let solved =
            seismass::simulate_general_each(&scenes, &motions, &runs, &options, threads, control, |response| {
                kept(&response)
            })?;
        Ok(gathered(solved))
    })
}

/// What a batch keeps of a run.
pub(crate) type Kept = (Row, OfRacks);

/// What a batch keeps of a response.
pub(crate) fn kept(response: &GeneralResponse) -> Kept {
    (row(response), OfRacks::new(response))
}

/// The columns of a batch, of what was kept of its runs in their order.
pub(crate) fn gathered(runs: Vec<seismass::Result<Kept>>) -> (Batch, RackColumns) {
    let mut columns = RackColumns::default();
    let mut of_run = |result: seismass::Result<Kept>| {
        let (row, racks) = match result {
            Ok((row, racks)) => (Ok(row), racks),
            Err(error) => (Err(error), OfRacks::none()),
        };
        columns.push(&racks);
        row
    };
    let rows: Vec<_> = runs.into_iter().map(&mut of_run).collect();
    let mut batch = Batch::with_room_for(&rows);
    for (run, row) in rows.into_iter().enumerate() {
        batch.push(run, row);
    }
    (batch, columns)
}

/// What storeys, floors and blocks have, as of a run of the chain engine.
fn row(response: &GeneralResponse) -> Row {
    let floors = response.storeys;
    let peaks = &response.peaks;
    let events = &response.statistics.events;
    let values = |peaks: &[Peak]| peaks.iter().map(|peak| peak.value).collect::<Vec<_>>();
    let (status, collapsed_storey) = match response.status {
        GeneralStatus::Completed => (0, 0),
        GeneralStatus::Collapsed { number, .. } => (COLLAPSED, count(number)),
    };
    Row {
        status,
        collapsed_storey,
        storeys: floors,
        blocks: peaks.slip.len(),
        events: count(events.total()),
        yields: count(events.of(EventKind::Yield)),
        slips: count(events.of(EventKind::Slip)),
        end_time: response.end_time,
        floor_force: Box::default(),
        peaks: [&peaks.drift[..floors], &peaks.slip].concat().into(),
        values: [
            &values(&peaks.acceleration[..floors])[..],
            &values(&peaks.shear[..floors]),
            &response.residual_drift[..floors],
            &response.residual_slip,
            &response.slip_path,
        ]
        .concat()
        .into(),
    }
}

/// Columns of a sliding base in a run without one.
const NO_BASE: [f64; 4] = [f64::NAN; 4];

/// What racks, stops and a sliding base of one run have.
#[derive(Default)]
pub(crate) struct OfRacks {
    base_shear: f64,
    /// Peak drift, acceleration and shear, and residual drift, of the levels of all racks.
    levels: [Vec<f64>; 4],
    /// Peak contact force and velocity of the blocks.
    contact: [Vec<f64>; 2],
    /// Peak slip, peak acceleration, slip at the end and path of a sliding base; NaN without one.
    base: [f64; 4],
}

impl OfRacks {
    fn new(response: &GeneralResponse) -> Self {
        let peaks = &response.peaks;
        let values = |peaks: &[Peak]| peaks.iter().map(|peak| peak.value).collect();
        let of_levels = |of: &[Peak]| values(&of[response.storeys..]);
        Self {
            base_shear: if response.storeys > 0 { peaks.base_shear.value } else { f64::NAN },
            levels: [
                of_levels(&peaks.drift),
                of_levels(&peaks.acceleration),
                of_levels(&peaks.shear),
                response.residual_drift[response.storeys..].to_vec(),
            ],
            contact: [values(&peaks.contact_force), values(&peaks.contact_velocity)],
            base: response
                .base
                .as_ref()
                .map_or(NO_BASE, |base| [base.slip.value, base.acceleration.value, base.residual_slip, base.slip_path]),
        }
    }

    /// Those of a run that failed.
    fn none() -> Self {
        Self { base: NO_BASE, ..Self::default() }
    }
}

/// Racks, stops and sliding bases of a batch. The list of run i is the next `levels[i]` values of a flat array over the
/// levels of its racks, one rack after the other, or as many as it has blocks; a run that failed has none.
#[pyclass(frozen, module = "seismass._kernel")]
#[derive(Default)]
pub(crate) struct RackColumns {
    base_shear: Vec<f64>,
    count: Vec<u32>,
    levels: [Vec<f64>; 4],
    contact: [Vec<f64>; 2],
    base: [Vec<f64>; 4],
}

impl RackColumns {
    fn push(&mut self, racks: &OfRacks) {
        self.base_shear.push(racks.base_shear);
        self.count.push(count(racks.levels[0].len()));
        self.levels.iter_mut().zip(&racks.levels).for_each(|(all, own)| all.extend(own));
        self.contact.iter_mut().zip(&racks.contact).for_each(|(all, own)| all.extend(own));
        self.base.iter_mut().zip(racks.base).for_each(|(all, own)| all.push(own));
    }
}

fn column(values: &[f64]) -> Output<f64> {
    Output::new(values.iter().copied())
}

getters! { RackColumns
    /// Number of rack levels of each run.
    levels(self) -> Output<u32> = Output::new(self.count.iter().copied());
    /// Peak base shear, the share of an elastic matrix included (N), of each run; NaN without a building.
    peak_base_shear(self) -> Output<f64> = column(&self.base_shear);
    /// Peak drift of rack levels (m), flat over runs and levels.
    peak_rack_drift(self) -> Output<f64> = column(&self.levels[0]);
    /// Peak absolute acceleration of rack levels (m/s2), flat over runs and levels.
    peak_rack_acceleration(self) -> Output<f64> = column(&self.levels[1]);
    /// Peak spring force of rack levels (N), flat over runs and levels.
    peak_rack_shear(self) -> Output<f64> = column(&self.levels[2]);
    /// Drift of rack levels at the end (m), flat over runs and levels.
    residual_rack_drift(self) -> Output<f64> = column(&self.levels[3]);
    /// Peak force of blocks on their stops (N), flat over runs and blocks.
    peak_contact_force(self) -> Output<f64> = column(&self.contact[0]);
    /// Peak relative velocity at which blocks come to their stops (m/s), flat over runs and blocks.
    peak_contact_velocity(self) -> Output<f64> = column(&self.contact[1]);
    /// Peak slip of the sliding base (m) of each run; NaN without one.
    peak_base_slip(self) -> Output<f64> = column(&self.base[0]);
    /// Peak absolute acceleration of the slab of the sliding base (m/s2) of each run; NaN without one.
    peak_base_acceleration(self) -> Output<f64> = column(&self.base[1]);
    /// Slip of the sliding base at the end (m) of each run; NaN without one.
    residual_base_slip(self) -> Output<f64> = column(&self.base[2]);
    /// Path slipped by the sliding base (m) of each run; NaN without one.
    base_slip_path(self) -> Output<f64> = column(&self.base[3]);
}
