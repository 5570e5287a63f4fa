//! One run of the general engine, and how its response is split into floors and rack levels.

use std::num::NonZeroUsize;

use pyo3::prelude::*;
use seismass::{GeneralBase, GeneralEvent, Options, Peak, simulate_general_until};

use crate::arrays::Output;
use crate::general_scene::GeneralScene;
use crate::interrupt::run_watched;
use crate::scene::Motion;

/// Solves one scene of the general engine under one motion; arguments as of `simulate`.
#[pyfunction]
#[pyo3(signature = (scene, motion, every, displacements_only, energy, events))]
pub(crate) fn simulate_general(
    py: Python<'_>,
    scene: PyRef<'_, GeneralScene>,
    motion: PyRef<'_, Motion>,
    every: usize,
    displacements_only: bool,
    energy: bool,
    events: bool,
) -> PyResult<GeneralResponse> {
    let histories = NonZeroUsize::new(every);
    let options = Options { histories, displacements_only, energy, events, ..Options::default() };
    let (scene, motion) = (scene.0.clone(), motion.0.clone());
    let run =
        run_watched(py, |_| Ok(()), move |control| simulate_general_until(&scene, &motion, &options, &control.stop));
    Ok(GeneralResponse(run?))
}

/// The response of one run of the general engine.
#[pyclass(frozen, module = "seismass._kernel")]
pub(crate) struct GeneralResponse(pub(crate) seismass::GeneralResponse);

impl GeneralResponse {
    /// Of storeys and floors, or of rack levels, one value each.
    pub(crate) fn part<T: Copy>(&self, of_nodes: &[T], racks: bool) -> Vec<T> {
        let (floors, levels) = of_nodes.split_at(self.0.storeys);
        if racks { levels.to_vec() } else { floors.to_vec() }
    }

    pub(crate) fn peaks(&self, of_nodes: &[Peak], racks: bool) -> Output<f64> {
        Output::new(self.part(of_nodes, racks).into_iter().map(|peak| peak.value))
    }

    pub(crate) fn times(&self, of_nodes: &[Peak], racks: bool) -> Output<f64> {
        Output::new(self.part(of_nodes, racks).into_iter().map(|peak| peak.time))
    }

    /// Columns of storeys and floors, or of rack levels, of a history.
    pub(crate) fn history(&self, of: impl Fn(&seismass::Histories) -> &Vec<f64>, racks: bool) -> Option<Output<f64>> {
        let histories = self.0.histories.as_ref()?;
        let (nodes, storeys, rows) = (self.0.residual_drift.len(), self.0.storeys, histories.rows);
        let values = of(histories);
        if values.len() != rows * nodes {
            return None;
        }
        let columns = if racks { storeys..nodes } else { 0..storeys };
        let taken = (0..rows).flat_map(|row| values[row * nodes..][columns.clone()].to_vec()).collect();
        Some(Output::shaped(&[rows, columns.len()], taken))
    }

    pub(crate) fn of_blocks(&self, of: impl Fn(&seismass::Histories) -> &Vec<f64>) -> Option<Output<f64>> {
        let histories = self.0.histories.as_ref()?;
        let (rows, blocks) = (histories.rows, self.0.residual_slip.len());
        let values = of(histories);
        (values.len() == rows * blocks).then(|| Output::shaped(&[rows, blocks], values.clone()))
    }

    /// A history of a sliding base; None without one, or where it was not kept.
    pub(crate) fn of_base(&self, of: impl Fn(&GeneralBase) -> &Vec<f64>) -> Option<Output<f64>> {
        let (histories, values) = (self.0.histories.as_ref()?, of(self.0.base.as_ref()?));
        (values.len() == histories.rows).then(|| Output::new(values.iter().copied()))
    }

    pub(crate) fn event_column<T>(&self, of: impl Fn(&GeneralEvent) -> T) -> Option<Output<T>> {
        self.0.events.as_ref().map(|events| Output::new(events.iter().map(of)))
    }
}

/// A getter of a list of blocks' peaks: its values and its times.
pub(crate) fn values(peaks: &[Peak]) -> Output<f64> {
    Output::new(peaks.iter().map(|peak| peak.value))
}
