//! What a run of the general engine gives back.

use crate::response::{Event, Histories, Peak, Statistics};

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "snake_case"))]
pub enum GeneralStatus {
    /// The motion ended.
    Completed,
    /// A spring reached its collapse drift: the run stops there, later history is NaN.
    Collapsed {
        /// Storey, counted from 1; levels of racks are counted on from the storeys, rack by rack.
        number: usize,
        /// Time (s).
        time: f64,
    },
}

/// Peaks in continuous time. Storeys and floors in order, then the levels of each rack; goods on floors, then those of
/// racks.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct GeneralPeaks {
    /// Drift of each storey, and of each rack level relative to the one below or to what the rack stands on (m).
    pub drift: Vec<Peak>,
    /// Absolute acceleration; where it jumps both one-sided limits count (m/s2).
    pub acceleration: Vec<Peak>,
    /// Spring force of each storey and rack level, without damping and P-Delta (N).
    pub shear: Vec<Peak>,
    /// Spring of storey 1 with the matrix's share of the base shear (N).
    pub base_shear: Peak,
    /// Slip, block displacement minus that of its node (m).
    pub slip: Vec<Peak>,
    /// Force of a block on its stop (N).
    pub contact_force: Vec<Peak>,
    /// Relative velocity at which a block comes to its stop (m/s).
    pub contact_velocity: Vec<Peak>,
}

/// What the sliding base did.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct GeneralBase {
    /// Peak slip of the slab on the ground (m).
    pub slip: Peak,
    /// Peak absolute acceleration of the slab; where it jumps both one-sided limits count (m/s2).
    pub acceleration: Peak,
    /// Slip at the end (m).
    pub residual_slip: f64,
    /// Path slipped in contact with the ground (m).
    pub slip_path: f64,
    /// History of the slip (m), if histories were asked for.
    pub history: Vec<f64>,
    /// History of the velocity over the ground (m/s), if histories of more than displacements were asked for.
    pub velocity_history: Vec<f64>,
    /// History of the absolute acceleration (m/s2), if histories of more than displacements were asked for.
    pub acceleration_history: Vec<f64>,
}

/// An event with the relative velocity of its block.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct GeneralEvent {
    /// The event. Numbers of springs count storeys, then rack levels; numbers of blocks the goods on floors, then those of
    /// racks; the sliding base has number 0 where blocks have theirs.
    pub event: Event,
    /// Relative velocity of the block, or of the base, where it comes to its stop or leaves it, wears, lifts or lands (m/s); otherwise zero.
    pub velocity: f64,
}

/// Energies at the end of the run, relative to the moving ground (J).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct GeneralEnergy {
    /// Kinetic plus elastic energy at the start.
    pub initial: f64,
    /// Input, -int (sum m v) a_g dt over floors, levels and goods; with a pendulum that which a vertical motion does along
    /// its slope, too.
    pub input: f64,
    /// Kinetic energy.
    pub kinetic: f64,
    /// Stored in springs, matrix and stops, and in the height of a pendulum, less the work of P-Delta.
    pub elastic: f64,
    /// Dissipated by viscous damping of building and racks.
    pub viscous: f64,
    /// Dissipated by yielding.
    pub hysteretic: f64,
    /// Dissipated by friction.
    pub friction: f64,
    /// Dissipated by stops, what is left in one where it parts included.
    pub contact: f64,
    /// (initial + input - all others), relative to the initial energy plus the largest input so far.
    pub relative_residual: f64,
}

/// The result of one run of the general engine. Lists by node and by goods are as in [`GeneralPeaks`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct GeneralResponse {
    /// Number of storeys of the building.
    pub storeys: usize,
    /// Number of levels of each rack.
    pub levels: Vec<usize>,
    /// How the run ended.
    pub status: GeneralStatus,
    /// Time reached (s): the last sample, or the collapse.
    pub end_time: f64,
    /// Peaks in continuous time.
    pub peaks: GeneralPeaks,
    /// Drift of each storey and rack level at the end (m).
    pub residual_drift: Vec<f64>,
    /// Slip of each block at the end (m).
    pub residual_slip: Vec<f64>,
    /// Path slipped by each block in contact with its node (m).
    pub slip_path: Vec<f64>,
    /// What the sliding base did, if there is one.
    pub base: Option<GeneralBase>,
    /// Event log, if asked for.
    pub events: Option<Vec<GeneralEvent>>,
    /// Histories, if asked for: columns of storeys and floors have the rack levels after them.
    pub histories: Option<Histories>,
    /// Energies, if asked for.
    pub energy: Option<GeneralEnergy>,
    /// Work done.
    pub statistics: Statistics,
}
