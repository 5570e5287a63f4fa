//! What a run in the plane gives back.

use crate::general::response::{GeneralEnergy, GeneralEvent, GeneralPeaks, GeneralResponse, GeneralStatus};
use crate::response::{Histories, Peak, Statistics};

/// A horizontal direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "snake_case"))]
pub enum Axis {
    /// The first.
    X,
    /// The other.
    Y,
}

/// Peaks of the lengths of vectors in continuous time.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct VectorPeaks {
    /// Drift vector of each storey and rack level (m).
    pub drift: Vec<Peak>,
    /// Absolute acceleration; where it jumps both one-sided limits count (m/s2).
    pub acceleration: Vec<Peak>,
    /// Spring force of each storey and rack level (N).
    pub shear: Vec<Peak>,
    /// Base shear with the share of elastic matrices (N).
    pub base_shear: Peak,
    /// Slip (m).
    pub slip: Vec<Peak>,
}

/// Peaks by direction and of vectors.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PlanePeaks {
    /// Peaks in x and in y.
    pub directions: [GeneralPeaks; 2],
    /// Peaks of the vectors.
    pub vector: VectorPeaks,
}

/// An event in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PlaneEvent {
    /// The event. Its sign is zero where it is of a vector; its velocity is then the length of the relative velocity.
    pub event: GeneralEvent,
    /// The direction to which it belongs: that of a spring or of a stop. None: it is of a vector.
    pub axis: Option<Axis>,
    /// Angle from x towards y (rad) of the vector: slip and reverse, of the relative velocity that follows; wear, lift and
    /// land, of the one then. NaN where there is none, as at a stick.
    pub angle: f64,
}

/// Energies by direction, each of which balances by itself.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PlaneEnergy {
    /// Energies of x and of y (J).
    pub directions: [GeneralEnergy; 2],
    /// Their sums; the residual is relative to the sum of initial energies and largest inputs.
    pub total: GeneralEnergy,
}

/// The result of one run in the plane. Lists are as in [`GeneralPeaks`]; pairs are of x and y.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PlaneResponse {
    /// Number of storeys of the building.
    pub storeys: usize,
    /// Number of levels of each rack.
    pub levels: Vec<usize>,
    /// How the run ended.
    pub status: GeneralStatus,
    /// Time reached (s): the last sample, or the collapse.
    pub end_time: f64,
    /// Peaks in continuous time.
    pub peaks: PlanePeaks,
    /// Drift of each storey and rack level at the end (m).
    pub residual_drift: Vec<[f64; 2]>,
    /// Slip of each block at the end (m).
    pub residual_slip: Vec<[f64; 2]>,
    /// Path slipped by each block in contact with its node (m).
    pub slip_path: Vec<f64>,
    /// Event log, if asked for.
    pub events: Option<Vec<PlaneEvent>>,
    /// Histories of both directions, if asked for.
    pub histories: Option<[Histories; 2]>,
    /// Energies, if asked for.
    pub energy: Option<PlaneEnergy>,
    /// Work done.
    pub statistics: Statistics,
}

impl PlaneResponse {
    /// The response in one direction: its peaks, residuals, histories and energies, with the events of its springs and
    /// stops. Path and statistics are of the run.
    pub fn direction(&self, axis: Axis) -> GeneralResponse {
        let a = usize::from(axis == Axis::Y);
        let of_axis = |events: &Vec<PlaneEvent>| {
            events.iter().filter(|entry| entry.axis == Some(axis)).map(|entry| entry.event).collect()
        };
        GeneralResponse {
            storeys: self.storeys,
            levels: self.levels.clone(),
            status: self.status,
            end_time: self.end_time,
            peaks: self.peaks.directions[a].clone(),
            residual_drift: self.residual_drift.iter().map(|pair| pair[a]).collect(),
            residual_slip: self.residual_slip.iter().map(|pair| pair[a]).collect(),
            slip_path: self.slip_path.clone(),
            events: self.events.as_ref().map(of_axis),
            base: None,
            histories: self.histories.as_ref().map(|histories| histories[a].clone()),
            energy: self.energy.map(|energy| energy.directions[a]),
            statistics: self.statistics,
        }
    }
}
