//! What a reference integrator gives back, and its recording.

use crate::response::Status;

/// Histories at the samples and peaks over the integrator's own steps.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct History {
    /// How the run ended.
    pub status: Status,
    /// Number of rows: one per sample of the motion.
    pub rows: usize,
    /// Storey drift (m), row-major, rows x storeys; NaN after a collapse.
    pub drift: Vec<f64>,
    /// Slip (m), row-major, rows x blocks; NaN after a collapse. With friction springs their elastic part is included.
    pub slip: Vec<f64>,
    /// Largest absolute drift of each storey at the ends of steps and at located events (m).
    pub peak_drift: Vec<f64>,
    /// Largest absolute slip of each block at the ends of steps and at located events (m).
    pub peak_slip: Vec<f64>,
    /// Steps taken; steps tried while locating events count, and each Newton iteration.
    pub steps: usize,
    /// Changes of state of storeys and blocks; 0 for methods without events.
    pub events: usize,
}

impl History {
    /// An empty history; rows not recorded stay NaN.
    pub(super) fn new(rows: usize, storeys: usize, blocks: usize) -> Self {
        Self {
            status: Status::Completed,
            rows,
            drift: vec![f64::NAN; rows * storeys],
            slip: vec![f64::NAN; rows * blocks],
            peak_drift: vec![0.0; storeys],
            peak_slip: vec![0.0; blocks],
            steps: 0,
            events: 0,
        }
    }

    /// Takes the drifts and slips at a sample.
    pub(super) fn record(
        &mut self,
        row: usize,
        drift: impl ExactSizeIterator<Item = f64>,
        slip: impl ExactSizeIterator<Item = f64>,
    ) {
        let (n, blocks) = (drift.len(), slip.len());
        self.drift[row * n..][..n].iter_mut().zip(drift).for_each(|(to, from)| *to = from);
        self.slip[row * blocks..][..blocks].iter_mut().zip(slip).for_each(|(to, from)| *to = from);
    }

    /// Raises the peaks.
    pub(super) fn observe(&mut self, drift: impl Iterator<Item = f64>, slip: impl Iterator<Item = f64>) {
        raise(&mut self.peak_drift, drift);
        raise(&mut self.peak_slip, slip);
    }
}

fn raise(peaks: &mut [f64], values: impl Iterator<Item = f64>) {
    for (peak, value) in peaks.iter_mut().zip(values) {
        *peak = peak.max(value.abs());
    }
}

/// Refuses a row with a value that is not finite.
pub(super) fn check_finite(
    time: f64,
    mut drift: impl Iterator<Item = f64>,
    mut slip: impl Iterator<Item = f64>,
) -> crate::Result<()> {
    let element = match (drift.position(|d| !d.is_finite()), slip.position(|s| !s.is_finite())) {
        (Some(i), _) => format!("storey {}", i + 1),
        (None, Some(j)) => format!("block {}", j + 1),
        (None, None) => return Ok(()),
    };
    Err(crate::Error::NotFinite { time, element })
}
